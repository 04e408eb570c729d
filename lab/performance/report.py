# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a section of the report on speed says; and `scripts/lab publish-speed`, which
copies the tables of results/speed into lab/performance/speed.md, and the picture of the
manual into doc/pictures."""
import argparse
import re
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson import disk, table
from caisson.paths import PICTURES, RESULTS, ROOT
from lab.outcome import machine

DOCUMENT = ROOT / "lab/performance/speed.md"
PICTURE = "speed_step.png"  # of benchmarks.md
BEGIN, END = "<!-- speed: begin -->", "<!-- speed: end -->"
COLORS = {"SSE2": "#8c8c8c", "AVX2": "#3b7dd8", "AVX-512": "#d1495b"}


class Report:
    """Text, tables and pictures of one section, also as files."""

    def __init__(self, name: str, title: str, results: Path) -> None:
        """results: the directory of the files."""
        self.name, self.results = name, results
        self.parts = [f"### {title}"]

    def say(self, text: str) -> None:
        """Add a paragraph."""
        self.parts.append(text)

    def table(
        self, name: str, columns: Sequence[str], rows: Sequence[Sequence[Any]]
    ) -> None:
        """Add a table, also as NAME.csv. Numbers are rounded where they are shown
        only."""
        table.write_csv(self.results / f"{name}.csv", columns, rows)
        self.parts.append(table.markdown(columns, rows))

    def picture(self, figure: Figure, caption: str) -> None:
        """Add the picture of the section."""
        name = f"speed_{self.name}.png"
        disk.save(figure, self.results / name, dpi=130)
        self.parts.append(f"![{caption}](pictures/{name})")

    def write(self) -> None:
        """Write NAME.md and print it."""
        line = machine()
        text = "\n\n".join([*self.parts, f"{line[0].upper()}{line[1:]}."]) + "\n"
        disk.write(self.results / f"{self.name}.md", text)
        print(text, flush=True)


def panels(
    n: int, width: float = 4.2, height: float = 4.0
) -> tuple[Figure, list[Axes]]:
    """Return a figure of n panels beside each other."""
    figure = Figure(figsize=(width * n, height), layout="constrained")
    axes = list(figure.subplots(1, n, squeeze=False)[0])
    for panel in axes:
        panel.grid(color="0.9", which="both")
        panel.set_axisbelow(True)
    return figure, axes


def bars(axes: Axes, names: Sequence[str], values: Sequence[float]) -> None:
    """Draw bars from top to bottom with their values."""
    axes.barh(names, values, color="#3b7dd8")
    for i, value in enumerate(values):
        axes.text(value, i, f" {value:.2f}", va="center", fontsize=8)
    axes.margins(x=0.12)
    axes.invert_yaxis()


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab publish-speed`: none."""


def main(_: argparse.Namespace) -> int:
    """Replace what stands between the two marks."""
    before, rest = DOCUMENT.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    table = (RESULTS / "speed/table.md").read_text(encoding="utf-8")
    table = re.sub(r"!\[.*?\]\(pictures/.*?\)\n\n", "", table)
    disk.write(DOCUMENT, f"{before}{BEGIN}\n{table}\n{END}{after}")
    shutil.copy(RESULTS / "speed" / PICTURE, PICTURES)
    return 0
