# SPDX-License-Identifier: LGPL-2.1-or-later
"""What suction leaves of the forces of a caisson: over those of a jacked run of the
same caisson and soil or, without one, what the run alone can say.

Senders & Randolph leave 1 - s / s_cr of tip and inner friction, and all of the outer
friction. A run under suction does not know what it would bear at this depth without.
Alone it can only compare its tip with what the tip bore under the weight, before there
was suction, both over the vertical stress of undisturbed ground: this ratio rises and
falls with depth without any suction, too.
"""
from pathlib import Path
from typing import Any

import numpy as np

from caisson.evaluation import rest_of_run
from caisson.verdict import design, suction_methods, theory
from caisson.results import Results, ResultsError
from caisson import disk
from caisson.design.houlsby_byrne import UNDISTURBED
from caisson.design.suction_installation import mean_unit_weight

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


def table_of(run: Results, at: np.ndarray) -> tuple[dict[str, Any], float | None]:
    """Return the columns of the table at depths [n] (m) where there is suction, and
    the depth (m) at which the caisson rested, None beside a jacked run; no columns
    without suction, or where no critical one is known."""
    history, path = run.history, run.directory / NAME
    found = suction_methods.answers_of(theory.site_of(run), at).suctions
    rest = rest_of_run(history)
    if not found or not set(design.FORCES) <= set(history):
        return {}, None
    suction = design.suction_at(history, at)
    rows = (suction > 0) & (at > (rest or 0))
    if not rows.any():
        return {}, None
    critical = found[suction_methods.CRITICAL_SENDERS_RANDOLPH]
    at, share = at[rows], (suction / critical)[rows]
    mine = design.forces_at(history, at)
    columns = {"depth (m)": at, SHARE: share, f"1 - {SHARE}": 1 - share}
    if path.is_file():
        twin = design.forces_at(run.table(NAME, "time_s"), at)
        deepest = run.table(NAME, "time_s")["penetration_m"].max()
        for column, name in PARTS.items():
            ratio = mine[column] / np.maximum(twin[column], 1.0)
            columns[f"{name} / jacked"] = np.where(at <= deepest, ratio, np.nan)
        return columns, None
    if rest is None:
        return {}, None
    both = np.array([rest, *at])
    byrne = theory.houlsby_byrne_of(theory.site_of(run), float(both.max()))
    ground, _ = byrne.by_name[UNDISTURBED]
    stress = np.array([h * mean_unit_weight(ground, h) for h in map(float, both)])
    ratio = design.forces_at(history, both)["tip_force_N"] / stress
    columns["tip (estimate from one run)"] = ratio[1:] / ratio[0]
    return columns, rest
