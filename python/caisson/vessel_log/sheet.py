# SPDX-License-Identifier: LGPL-2.1-or-later
"""A blank log sheet to print: the chart of what is expected and allowed, to plot the
measured line on, a table to fill in by hand, and when to stop."""
import textwrap
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from caisson import disk, evaluation
from caisson.band import ESTIMATES
from caisson.vessel_log import picture, words
from caisson.vessel_log.expected import Expected, expected_of
from caisson.results import Results
from caisson.table import digits, write_csv
from caisson.template import say_rows
from caisson.verdict import acceptance
from caisson.verdict.installation import Rate, installation_of

PDF, TABLE = "log_sheet.pdf", "log_sheet.csv"
A4 = (8.27, 11.69)  # inches
ROWS = 32  # of a page
BLANK = ("time", "suction", "flow", "tilt", "weight", "remarks")
UNITS = {"suction": "kPa", "flow": "m³/h", "tilt": "°", "weight": "kN"}
SIGNED = "Vessel: ____________   Date: ____________   Position: ____________   Signed:"


def rows_of(expected: Expected) -> list[list[float]]:
    """Return (depth, low, best, high, allowable) at each half meter and at the planned
    end, in m and kPa, nan below the runs."""
    depth = expected.depth
    at = evaluation.depths_of(np.append(depth, max(expected.planned, depth[-1])))
    columns = [*expected.suctions.values(), expected.allowable]
    found = [np.interp(at, depth, column, right=np.nan) for column in columns]
    return [list(map(float, row)) for row in zip(at, *found)]


def criteria_of(expected: Expected) -> list[str]:
    """Return when to stop, and where the caisson should rest."""
    rest = None
    if expected.high[0] < expected.weight < expected.low[-1]:
        ends = (expected.high, expected.low)
        rest = [np.interp(expected.weight, line, expected.depth) for line in ends]
    limit, shown = picture.governing_of(expected), expected.run.shown
    known = installation_of(expected.run, Rate())
    assert known is not None  # it has a required suction
    stop = acceptance.stop_of(expected.run, known, expected.planned)
    what = shown, limit, expected.weight, rest, words.of_end(expected), stop
    found = say_rows(words.SENTENCES, "criteria", *what)
    return [f"  - {text}" if mark == "-" else text for mark, text in found]


def chart(expected: Expected) -> Figure:
    """Return the page with the chart."""
    figure = Figure(figsize=A4)
    axes = figure.add_axes((0.1, 0.17, 0.84, 0.68))
    picture.draw_expected(axes, expected)
    axes.minorticks_on()
    axes.grid(which="both", color="0.8", linewidth=0.4)
    axes.legend(fontsize=8, loc="lower left")
    title = "\n".join(textwrap.wrap(f"Log sheet: {expected.title}", 90))
    figure.text(0.1, 0.94, title, fontsize=10)
    figure.text(0.1, 0.91, SIGNED, fontsize=9)
    note = [*criteria_of(expected), words.of_source(expected)]
    lines = [
        line
        for text in note
        for line in textwrap.wrap(text, 118, drop_whitespace=False)
    ]
    figure.text(0.1, 0.14, "\n".join(lines), fontsize=8, va="top")
    return figure


def table(expected: Expected, rows: list[list[float]]) -> Figure:
    """Return a page with rows of the table."""
    figure = Figure(figsize=A4)
    axes = figure.add_axes((0.06, 0.06, 0.88, 0.86))
    axes.axis("off")
    shown = expected.run.shown
    heads = [shown.named(x) for x in ("depth\n(m)", "low\n(kPa)", "best\n(kPa)")]
    heads += [shown.named(x) for x in ("high\n(kPa)", "allowable\n(kPa)")]
    heads += [f"{name}\n({UNITS[name]})" if name in UNITS else name for name in BLANK]
    factors = [shown.factor("m"), *[shown.factor("kPa")] * 4]
    cells = [
        [*(digits(f * x, 3) for f, x in zip(factors, row)), *[""] * len(BLANK)]
        for row in rows
    ]
    for row, texts in zip(rows, cells):
        beyond = expected.extrapolated_at(row[0]).split()
        for place, name in enumerate(ESTIMATES, 1):
            texts[place] += "*" if texts[place] and name in beyond else ""
    height = (len(rows) + 2) / (ROWS + 2)
    found = axes.table(cells, colLabels=heads, bbox=(0, 1 - height, 1, height))
    found.auto_set_font_size(False)
    found.set_fontsize(8)
    figure.text(0.06, 0.95, SIGNED, fontsize=9)
    if expected.extrapolations():
        figure.text(0.06, 0.04, "* extrapolated, as no run has been there", fontsize=8)
    return figure


def write(directory: Path) -> list[Path]:
    """Write the blank sheet of a run into its directory; return the files. Raises
    InputError."""
    expected = expected_of(Results(directory))
    rows = rows_of(expected)
    pages = [chart(expected)]
    pages += [table(expected, rows[i : i + ROWS]) for i in range(0, len(rows), ROWS)]
    heads = ["depth_m", "low_kPa", "best_kPa", "high_kPa", "allowable_kPa"]
    heads += ["extrapolated", "time_s", "suction_kPa", "flow_m3/h", "tilt_deg"]
    heads += ["weight_kN", "remarks"]
    cells = [
        [*(digits(x, 4) for x in row), expected.extrapolated_at(row[0])]
        + [""] * len(BLANK)
        for row in rows
    ]
    write_csv(directory / TABLE, heads, cells)
    return [disk.save_pages(pages, directory / PDF), directory / TABLE]
