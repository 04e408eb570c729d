# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "stability": hard scenes that must come to their end.

A run passes if the program ends with status 0, no row of history.csv holds
anything but finite numbers, no point lies in the body at any record, and the
energy residual at the end is below 1 % of the work put in. Each scene is a study;
its further keys:

    must_fail = true          it must not pass
    largest_residual = 0.05   the known limit of the residual, as a share
    largest_lean = 0.1        by how much the normal stress on the inner wall near the
                              tip may differ from that on the outer one, as a share
    why = "limitations.md"    where that is explained
"""
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson import table
from caisson.results import Results, ResultsError, Table
from caisson.runner import Status
from caisson.runs import StudyRun
from caisson.study import Options, Study
from caisson import disk
from lab.checks import checks_of

NAME = "stability"
STUDY_KEYS = {"must_fail", "largest_residual", "largest_lean", "why"}
TIME_LIMIT = 600.0  # s, of a run
RESIDUAL = 0.01
REASONS = re.compile("left the mesh|no longer finite|not finite|stability limit")
COLUMNS = [
    "scene",
    "verdict",
    "steps",
    "energy residual",
    "limiter firings",
    "added mass share",
    "points in body",
    "note",
]


class Seen(NamedTuple):
    """What is judged of a run; nan where there is no row."""

    steps: float
    residual: float  # a share of the work put in
    limiter: float
    added_mass: float  # a share of the mass of the soil
    in_body: int
    finite: bool


def last(history: Table, column: str) -> float:
    """Return the last value of a column."""
    return float(history[column][-1])


def see(results: Results) -> Seen:
    """Return what is judged. Raises ResultsError."""
    history = results.history
    try:
        mass = results.summary.get("soil_mass_kg", math.nan)
    except ResultsError:  # a run that failed leaves none
        mass = math.nan
    return Seen(
        steps=last(history, "step"),
        # at the end: the first rows have done little work
        residual=last(history, "energy_residual"),
        limiter=last(history, "limiter_count"),
        added_mass=float(history["added_mass_kg"].max()) / mass,
        in_body=int(np.max(history.get("points_in_body", 0))),  # a scene without one
        finite=all(bool(np.isfinite(column).all()) for column in history.values()),
    )


def reason_in(log: Path) -> str:
    """Return why a run failed, in the words of the program, or nothing."""
    match = REASONS.search(log.read_text(encoding="utf-8")) if log.exists() else None
    return match.group() if match else ""


def lean_of(results: Results) -> float:
    """Return the mean normal stress on the inner wall over that on the outer one, less
    1, from 0.05 to 0.25 m above the tip and over the last 0.15 m of the way."""
    walls = results.walls
    above_tip = walls["penetration_m"] - walls["depth_m"]
    used = (above_tip > 0.05) & (above_tip < 0.25)
    used &= walls["penetration_m"] > walls["penetration_m"].max() - 0.15
    inner, outer = (
        np.average(
            walls[f"{side}_normal_stress_Pa"], weights=used * walls[f"{side}_area_m2"]
        )
        for side in ("inner", "outer")
    )
    return float(inner / outer - 1)


def faults_of(run: StudyRun, seen: Seen | None) -> list[str]:
    """Return all that does not pass."""
    reason = reason_in(run.run.directory / "log")
    faults = [reason] if reason else []
    if run.status != Status.SUCCESS and not reason:
        faults.append(run.trouble or f"status {run.status}")
    elif not reason:
        found = checks_of(run.results)
        faults += [check["line"] for check in found if not check["pass"]]
    if seen is None:
        return faults + ["no results"]
    if not seen.finite:
        faults.append("not finite")
    if seen.in_body > 0:
        faults.append("points in the body")
    if not abs(seen.residual) <= run.settings.get("largest_residual", RESIDUAL):
        faults.append("energy")
    if "largest_lean" in run.settings:
        lean = lean_of(run.results)
        if not abs(lean) <= run.settings["largest_lean"]:
            faults.append(f"leans by {100 * lean:.0f} %")
    return faults


def judge(run: StudyRun) -> tuple[list[str], bool]:
    """Return a line of the table, and whether the run does what it must."""
    try:
        seen = see(run.results)
    except ResultsError:
        seen = None
    faults = faults_of(run, seen)
    must_fail = run.settings.get("must_fail", False)
    good = bool(faults) == must_fail
    notes = [", ".join(faults)] if faults else []
    if "largest_residual" in run.settings:
        notes.append(f"limit {100 * run.settings['largest_residual']:g} %")
    if must_fail:
        notes = ["must fail: " + (", ".join(notes) or "it did not")]
    verdict = "FAILS" if not good else "fails, as it must" if must_fail else "passes"
    line = [run.study, verdict, *numbers(seen), ", ".join(notes)]
    return line, good


def numbers(seen: Seen | None) -> list[str]:
    """Return the numbers of a line."""
    if seen is None:
        return ["-", "-", "-", "-", "-"]
    return [
        f"{seen.steps:.0f}",
        f"{100 * seen.residual:.2g} %",
        f"{seen.limiter:.0f}",
        f"{100 * seen.added_mass:.2g} %",
        str(seen.in_body),
    ]


def evaluate(studies: Sequence[Study], options: Options, _: float) -> int:
    """Write table.md and print it; return 1 if a scene does not do what it must."""
    judged = [judge(run) for study in studies for run in study.runs]
    text = table.markdown(COLUMNS, [line for line, _ in judged])
    disk.write(options.results / "table.md", text + "\n")
    print(text)
    return 0 if all(good for _, good in judged) else 1
