# SPDX-License-Identifier: LGPL-2.1-or-later
"""A model caisson pushed into sand at 1 g: measured and computed force over depth.

The friction of the wall was not measured; two runs bound it. With the smoother wall the
force is extrapolated, from three meshes, to zero cell size.
"""
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from caisson import curves
from caisson.verdict import theory
from caisson.results import read_table
from caisson.runs import StudyRun
from caisson.study import Study
from lab.validation import Row

ANGLES = (25, 40)  # of friction of the wall, degrees; 40: as rough as the sand
SURFACES = ("outer wall", "inner wall", "tip")
FACTOR = 1.5
CELLS = 4  # across the wall, of the scene
MESHES = (3, CELLS, 6)  # of the smoother wall
# why the wall that is as rough as the sand may miss
JAMS = "the plug jams behind so rough a wall, see doc/validation.md"
EXPONENT = (2.2, 2.8)


def name_of(angle: int, cells: int = CELLS) -> str:
    """Return the name of a run."""
    return f"wall_{angle}" + ("" if cells == CELLS else f"_{cells}")


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return a run for each friction of the wall, and for each mesh."""
    runs = []
    for angle in ANGLES:
        friction = {f"Rigid body/Friction angle of the {s}": angle for s in SURFACES}
        for cells in MESHES if angle == min(ANGLES) else (CELLS,):
            entries = friction if cells == CELLS else {**friction, **mesh_of(cells)}
            seconds = 230 * (cells / CELLS) ** 3
            runs.append(
                {"name": name_of(angle, cells), "seconds": seconds, "set": entries}
            )
    return runs


def mesh_of(cells: int) -> dict[str, Any]:
    """Return the entries of a mesh with so many cells across the wall."""
    size = CELLS / cells
    return {
        "Rigid body/Cells across the wall": cells,
        "Grid/Cell width": 0.025 * size,
        "Grid/Cell height": 0.0083 * size,
        "Grid/Fine width": 0.003 * size,
        "Grid/Fine height": 0.003 * size,
    }


def force_at(run: StudyRun, depth: np.ndarray) -> np.ndarray:
    """Return the total force (N) at depths (m), [n], smoothed over 4 mm."""
    history = run.results.history
    known = history["penetration_m"]
    rows = curves.way_down(known)[1:]
    total = history["total_force_N"][rows]
    near = [np.abs(known[rows] - h) <= 0.002 for h in depth]
    return np.array([total[rows_near].mean() for rows_near in near])


def limit_of(study: Study, depth: np.ndarray) -> np.ndarray:
    """Return the total force (N) at depths (m), [n], with the smoother wall,
    extrapolated to zero cell size: the line in the size through three meshes."""
    names = [name_of(min(ANGLES), cells) for cells in MESHES]
    forces = np.array([force_at(study.run(name), depth) for name in names])
    return np.asarray(np.polyfit([1 / cells for cells in MESHES], forces, 1)[1])


def exponent(depth: np.ndarray, force: np.ndarray) -> float:
    """Return n of force ~ depth^n from the first depth to the last."""
    return float(np.log(force[-1] / force[0]) / np.log(depth[-1] / depth[0]))


def compare(study: Study, measured: Path, figure: Figure) -> list[Row]:
    """Draw, and return the rows: ratios at each depth and the growth."""
    table = read_table(measured)
    depth, force = table["depth_m"], table["force_N"]
    rows = [Row(study.id, "growth exponent, measured", exponent(depth, force))]
    limit = limit_of(study, depth)
    for angle in ANGLES:
        smooth = angle == min(ANGLES)
        found = force_at(study.run(name_of(angle)), depth)
        rows += [
            Row(study.id, f"force at {h:g} m (N), wall {angle} degrees", float(f))
            for h, f in zip(depth, found)
        ]
        if smooth:
            found = limit
        known = "" if smooth else JAMS
        for h, ratio in zip(depth, found / force):
            name = f"force at {h:g} m over measured, wall {angle} degrees"
            name += ", extrapolated" if smooth else ""
            bounds = 1 / FACTOR, FACTOR
            rows.append(Row(study.id, name, float(ratio), *bounds, known=known))
        name = f"growth exponent, wall {angle} degrees"
        name += ", extrapolated" if smooth else ""
        growth = exponent(depth, found)
        rows.append(Row(study.id, name, growth, *EXPONENT, known=known))
    draw(figure, study, depth, force, limit)
    return rows


def draw(
    figure: Figure,
    study: Study,
    depth: np.ndarray,
    force: np.ndarray,
    limit: np.ndarray,
) -> None:
    """Draw force over depth, with Houlsby & Byrne, whose range does not depend on the
    friction of the wall; limit: the extrapolated force."""
    figure.set_size_inches(6, 5)
    axes = figure.subplots()
    for i, angle in enumerate(ANGLES):
        run = study.run(name_of(angle))
        history = run.results.history
        label = f"computed, wall {angle} degrees"
        axes.plot(
            history["total_force_N"][1:],
            history["penetration_m"][1:],
            color=f"C{i}",
            label=label,
        )
    site = theory.site_of(study.run(name_of(ANGLES[0])).results)
    answer = theory.answers_to(site, 0.24)[0]
    for values, style, case in zip(answer.band("total"), ("--", ":"), ("low", "high")):
        label = f"Houlsby & Byrne, {case}"
        axes.plot(values, answer.depth, style, color="0.4", lw=1, label=label)
    axes.plot(
        limit, depth, "C0o", mfc="none", label="computed, wall 25 degrees, extrapolated"
    )
    axes.plot(force, depth, "ks", label="measured")
    axes.set(xlabel="force (N)", ylabel="penetration (m)", xlim=(0, 2 * force[-1]))
    axes.invert_yaxis()
    axes.grid(color="0.9")
    axes.legend(fontsize=7)
