# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "verification": problems with exact solutions, and what is asked.

Each problem is a study; a row of the table is one of its

    [[study.checks]]
    check = "rms stress_zz"   # as before the first colon in Verification/Checks
    what = "text"             # for the table, otherwise the check
    run = 0                   # number of the run; the last one, if left out
    error = 0.01              # asked for, otherwise the tolerance of the check
    asked = "text"            # instead of the mode, of checks that ask for a range
    order = 1.8               # or the order: the slope of log error over log h of
                              # all runs, by least squares
    known_error = 0.02        # how far the row falls short at present, which is
    known_order = 1.3         # reported and must not become worse
    why = "limitations.md"    # where a shortfall is explained

or states the half-width of the error bar of an installation, over the quantity itself:

    error_bar = "../jack_error_bar.csv"   # of a study of kind "error bar"
    quantity = "tip"                      # as caisson.run_error_bar names it
    depth = 2                             # m
"""
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from caisson import run_error_bar
from caisson.results import ResultsError, read_table
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError
from caisson.table import number
from caisson.error_bars import bar_study
from lab import outcome
from lab.checks import checks_of
from lab.verification import damped_wave

NAME = "verification"
STUDY_KEYS = {"checks"}
ROW_KEYS = set(
    "check what run error asked order known_error known_order why error_bar quantity"
    " depth".split()
)
COLUMNS = ["problem", "computed", "exact", "error", "asked", "verdict"]
PASS, KNOWN, FAIL = "pass", "short, as known", "FAIL"
# a shortfall may vary this much, from machine to machine and with rounding
SAME = 1.02
NEAR = 0.06  # m, of the depths in a file of an error bar

Row = dict[str, Any]


def slope(x: Sequence[float], y: Sequence[float]) -> float:
    """Return the slope of the line through the points (x, y), by least squares."""
    return float(np.polyfit(x, y, 1)[0])


def find_check(run: StudyRun, head: str) -> dict[str, Any]:
    """Return a check of a run. Raises StudyError where there is none."""
    if run.status is None or run.trouble:
        raise StudyError(str(run.trouble))
    try:
        checks = {check["check"]: check for check in checks_of(run.results)}
        if head in damped_wave.EXACT:
            checks.update(damped_wave.checks(run.results))
    except ResultsError as error:
        raise StudyError(str(error)) from error
    if head not in checks:
        known = ", ".join(checks)
        raise StudyError(f'{run.run.scene.name} has no check "{head}", only {known}')
    return checks[head]


def judge(
    value: float | None, asked: float, known: float | None, at_least: bool
) -> str:
    """Return the verdict on a value of which at least or at most this is asked."""
    if value is None or not math.isfinite(value):
        return FAIL
    sign = -1 if at_least else 1
    if sign * value <= sign * asked:
        return PASS
    if known is None:
        return FAIL
    limit = known / SAME if at_least else known * SAME
    return KNOWN if sign * value <= sign * limit else FAIL


def error_row(row: Row, runs: Sequence[StudyRun]) -> Row:
    """Return what the table says of the error of one run."""
    check = find_check(runs[row.get("run", len(runs) - 1)], row["check"])
    asked = row.get("error", check["tolerance"])
    error = check["relative_error"]
    text = f"<= {number(asked, 3)}"
    if check["mode"] in ("below", "above", "between"):
        text = row.get("asked", check["mode"])
    return {
        "computed": number(check["computed"]),
        "exact": number(check["exact"]),
        "error": number(error, 3),
        "asked": text,
        "verdict": judge(error, asked, row.get("known_error"), False),
    }


def error_bar_row(row: Row, study: Study) -> Row:
    """Return what the table says of the longer side of an error bar, over the
    quantity itself. Raises StudyError where the file has no such quantity or depth."""
    path = (study.file.parent / row["error_bar"]).resolve()
    bars = read_table(path)
    nearest = int(np.argmin(np.abs(bars["penetration_m"] - row["depth"])))
    if abs(bars["penetration_m"][nearest] - row["depth"]) > NEAR:
        raise StudyError(f"{path.name} has no depth {row['depth']} m")
    quantity = run_error_bar.QUANTITIES.get(row["quantity"])
    if quantity is None or quantity.bar_column("below") not in bars:
        raise StudyError(f"{path.name} has no quantity {row['quantity']!r}")
    bar = max(float(bars[quantity.bar_column(s)][nearest]) for s in bar_study.SIDES)
    if not quantity.is_relative:
        bar /= abs(float(bars[quantity.column()][nearest]))
    return {
        "computed": number(bar, 3),
        "exact": "",
        "error": number(bar, 3),
        "asked": f"<= {number(row['error'], 3)}",
        "verdict": judge(bar, row["error"], row.get("known_error"), False),
    }


def order_row(row: Row, runs: Sequence[StudyRun]) -> Row:
    """Return what the table says of the order of convergence over the runs."""
    errors = [find_check(run, row["check"])["relative_error"] for run in runs]
    order = None
    if all(e is not None and e > 0 for e in errors) and len(errors) > 1:
        order = slope(
            [math.log(run.settings["h"]) for run in runs], [math.log(e) for e in errors]
        )
    return {
        "computed": f"order {number(order, 3)}",
        "exact": "",
        "error": ", ".join(number(e, 2) for e in errors),
        "asked": f"order >= {row['order']}",
        "verdict": judge(order, row["order"], row.get("known_order"), True),
    }


def table_row(study: Study, row: Row) -> Row:
    """Return one row of the table; a run that failed makes a row that fails."""
    title = f"{study.title}: {row.get('what') or row.get('check')}"
    try:
        unknown = sorted(set(row) - ROW_KEYS)
        if unknown:
            raise StudyError(f"a check has no key {', '.join(unknown)}")
        if "error_bar" in row:
            result = error_bar_row(row, study)
        elif "order" in row:
            result = order_row(row, study.runs)
        else:
            result = error_row(row, study.runs)
    except (StudyError, ResultsError, KeyError, IndexError, TypeError) as error:
        failed = {"computed": str(error), "verdict": FAIL}
        result = {**dict.fromkeys(COLUMNS, ""), **failed}
    if result["verdict"] != PASS and "why" in row:
        result["verdict"] += f" ({row['why']})"
    return {**result, "problem": title}


def evaluate(studies: Sequence[Study], options: Options, minutes: float) -> int:
    """Write table.md and table.csv and print the table; return 0 where every row
    passes or falls short no more than the file says, otherwise 1."""
    found = [table_row(study, row) for study in studies for row in study.keys["checks"]]
    rows = [[row[column] for column in COLUMNS] for row in found]
    heading = f"`scripts/lab verify`, {outcome.machine()}, {minutes:.0f} minutes."
    heading = f"# Verification\n\n{heading}\n\n"
    outcome.write_table(options.results, COLUMNS, rows, heading)
    n_failed = sum(row["verdict"].startswith(FAIL) for row in found)
    n_known = sum(row["verdict"].startswith(KNOWN) for row in found)
    n_passed = len(rows) - n_failed - n_known
    print(
        f"{len(rows)} rows: {n_passed} pass, {n_known} fall short as known,"
        f" {n_failed} fail"
    )
    return 1 if n_failed else 0
