# SPDX-License-Identifier: LGPL-2.1-or-later
"""A model caisson pushed into sand at 1 g: measured and computed force over depth.

The friction of the wall was not measured; two runs bound it.
"""
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from caisson import curves
from caisson.plot import theory
from caisson.results import read_table
from caisson.study import Study, StudyRun
from caisson.validation.verdict import Row

ANGLES = (25, 40)  # of friction of the wall, degrees; 40: as rough as the sand
SURFACES = ("outer wall", "inner wall", "tip")
FACTOR = 1.5
# why the wall that is as rough as the sand may miss
GROWTH = "0.03 low, see doc/validation.md"
JAMS = "the plug jams behind so rough a wall, see doc/validation.md"
EXPONENT = (2.2, 2.8)


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return a run for each friction of the wall."""
    return [
        {
            "name": f"wall_{angle}",
            "seconds": 230,
            "set": {f"Rigid body/Friction angle of the {s}": angle for s in SURFACES},
        }
        for angle in ANGLES
    ]


def force_at(run: StudyRun, depth: np.ndarray) -> np.ndarray:
    """Return the total force (N) at depths (m), [n], smoothed over 4 mm."""
    history = run.results.history
    known = history["penetration_m"]
    rows = curves.way_down(known)[1:]
    total = history["total_force_N"][rows]
    near = [np.abs(known[rows] - h) <= 0.002 for h in depth]
    return np.array([total[rows_near].mean() for rows_near in near])


def exponent(depth: np.ndarray, force: np.ndarray) -> float:
    """Return n of force ~ depth^n from the first depth to the last."""
    return float(np.log(force[-1] / force[0]) / np.log(depth[-1] / depth[0]))


def compare(study: Study, measured: Path, figure: Figure) -> list[Row]:
    """Draw, and return the rows: ratios at each depth and the growth."""
    table = read_table(measured)
    depth, force = table["depth_m"], table["force_N"]
    rows = [Row(study.id, "growth exponent, measured", exponent(depth, force))]
    for run, angle in zip(study.runs, ANGLES):
        found = force_at(run, depth)
        known = JAMS if angle == max(ANGLES) else ""
        for h, ratio in zip(depth, found / force):
            name = f"force at {h:g} m over measured, wall {angle} degrees"
            bounds = 1 / FACTOR, FACTOR
            rows.append(Row(study.id, name, float(ratio), *bounds, known=known))
        name = f"growth exponent, wall {angle} degrees"
        growth = exponent(depth, found)
        nearly = GROWTH if growth > 2.15 else ""
        rows.append(Row(study.id, name, growth, *EXPONENT, known=known or nearly))
    draw(figure, study, depth, force)
    return rows


def draw(figure: Figure, study: Study, depth: np.ndarray, force: np.ndarray) -> None:
    """Draw force over depth, with Houlsby & Byrne for each friction of the wall."""
    figure.set_size_inches(6, 5)
    axes = figure.subplots()
    for i, (run, angle) in enumerate(zip(study.runs, ANGLES)):
        history = run.results.history
        label = f"computed, wall {angle} degrees"
        axes.plot(
            history["total_force_N"][1:],
            history["penetration_m"][1:],
            color=f"C{i}",
            label=label,
        )
        answer = theory.answers_to(theory.site_of(run.results), 0.24)[0]
        low, high = answer.band("total")
        for values, style, case in ((low, ":", "plain"), (high, "--", "enhanced")):
            label = f"Houlsby & Byrne, {case}, wall {angle} degrees"
            axes.plot(values, answer.depth, style, color=f"C{i}", lw=1, label=label)
    axes.plot(force, depth, "ks", label="measured")
    axes.set(xlabel="force (N)", ylabel="penetration (m)", xlim=(0, 2 * force[-1]))
    axes.invert_yaxis()
    axes.grid(color="0.9")
    axes.legend(fontsize=7)
