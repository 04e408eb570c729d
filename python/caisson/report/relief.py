# SPDX-License-Identifier: LGPL-2.1-or-later
"""What suction leaves of the forces of a caisson: over those of a jacked run of the
same caisson and soil.

Senders & Randolph leave 1 - s / s_cr of tip and inner friction, and all of the outer
friction. A run under suction alone does not know what it would bear without.
"""
from pathlib import Path
from typing import Any

import numpy as np

from caisson.evaluation import rest_of_run
from caisson.verdict import design, suction_methods, theory
from caisson.results import Results, ResultsError
from caisson import disk

NAME = "jacked.csv"  # of the jacked run in the directory of a run
SAME = ("diameter_m", "wall_thickness_m", "layers")  # in run.json of both
PARTS = dict(zip(design.FORCES[:3], ("tip", "inner friction", "outer friction")))
SHARE = "s / s_cr (Senders & Randolph)"


def adopt(jacked: Path, directory: Path) -> None:
    """Keep the history of a jacked run with a run under suction. Raises ResultsError
    where it is not the same caisson in the same soil, or has suction itself."""
    twin, run = Results(jacked), Results(directory)
    if design.SUCTION in twin.history:
        raise ResultsError(f"--jacked {jacked}: this run has suction, too")
    if design.SUCTION not in run.history:
        raise ResultsError(f"--jacked: the run in {directory} has no suction")
    for name in SAME:
        if twin.scene.get(name) != run.scene.get(name):
            raise ResultsError(
                f"--jacked {jacked}: {name} in its run.json is not that of {directory}:"
                " jack the same scene, --set Water/Level=drained"
            )
    disk.keep(directory / NAME, disk.read_bytes(jacked / "history.csv"))


def table_of(run: Results, at: np.ndarray) -> dict[str, Any]:
    """Return the columns of the table at depths [n] (m) where there is suction; none
    without a jacked run, or where no critical suction is known."""
    history, path = run.history, run.directory / NAME
    if not path.is_file() or not set(design.FORCES) <= set(history):
        return {}
    found = suction_methods.answers_of(theory.site_of(run), at).suctions
    suction = design.suction_at(history, at)
    rows = (suction > 0) & (at > (rest_of_run(history) or 0))
    if not found or not rows.any():
        return {}
    critical = found[suction_methods.CRITICAL_SENDERS_RANDOLPH]
    at, share = at[rows], (suction / critical)[rows]
    columns = {"depth (m)": at, SHARE: share, f"1 - {SHARE}": 1 - share}
    jacked = run.table(NAME, "time_s")
    mine, twin = (design.forces_at(table, at) for table in (history, jacked))
    for column, name in PARTS.items():
        ratio = mine[column] / np.maximum(twin[column], 1.0)
        columns[f"{name} / jacked"] = np.where(
            at <= jacked["penetration_m"].max(), ratio, np.nan
        )
    return columns
