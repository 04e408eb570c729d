# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables and pictures of scripts/speed."""
import csv

from matplotlib.figure import Figure

from speed_runs import RESULTS, machine

COLORS = {"SSE2": "#8c8c8c", "AVX2": "#3b7dd8", "AVX-512": "#d1495b"}


class Report:
    """What one section says: text, tables and pictures, also as files."""

    def __init__(self, name, title):
        self.name, self.parts = name, [f"### {title}"]

    def say(self, text):
        self.parts.append(text)

    def table(self, name, columns, rows):
        """Also as NAME.csv. Numbers are rounded where they are shown only."""
        with open(RESULTS / f"{name}.csv", "w", encoding="utf-8",
                  newline="") as file:
            csv.writer(file).writerows([columns] + rows)
        lines = [" | ".join(columns), " | ".join("---" for _ in columns)]
        lines += [" | ".join(shown(cell) for cell in row) for row in rows]
        self.parts.append("\n".join(f"| {line} |" for line in lines))

    def picture(self, figure, caption):
        name = f"speed_{self.name}.png"
        figure.savefig(RESULTS / name, dpi=130)
        self.parts.append(f"![{caption}](pictures/{name})")

    def write(self):
        text = "\n\n".join(self.parts + [f"{machine()}."]) + "\n"
        (RESULTS / f"{self.name}.md").write_text(text, encoding="utf-8")
        print(text, flush=True)


def shown(cell):
    """Three digits, and all digits before the point."""
    if not isinstance(cell, float):
        return str(cell)
    if abs(cell) >= 100:
        return f"{cell:.0f}"
    return f"{cell:.2e}" if 0 < abs(cell) < 1e-3 else f"{cell:.3g}"


def panels(n, width=4.2, height=4.):
    figure = Figure(figsize=(width * n, height), layout="constrained")
    axes = figure.subplots(1, n, squeeze=False)[0]
    for a in axes:
        a.grid(color="0.9", which="both")
        a.set_axisbelow(True)
    return figure, axes
