# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cone in clay and one in sand on coarse meshes: the quick form of cone_clay and
cone_sand, each at one state and in a wider band."""
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from caisson.study import Study
from lab import scene_of
from lab.validation.cone_clay import cone_clay
from lab.validation.cone_sand import cone_sand
from lab.validation import Row

CELLS = 2  # across the radius
CLAY = cone_clay.Case()
DENSITY, VERTICAL = 0.77, 100.0  # of the sand; kPa
# of the factor in clay, beyond the formulas: two cells are 4 % above the limit, and
# long steps add 2 %
MARGIN = 0.06
LONG_STEPS: dict[str, Any] = {
    "Time/Courant number": 0.8,
    "Time/Mass scaling": 1,
    "Time/Inertia tolerance": 1.6,
}


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return both runs."""
    coarse: dict[str, Any] = {"Rigid body/Cells across the wall": CELLS}
    clay = {**CLAY.entries(), **coarse, **LONG_STEPS, "Verification/Checks": ""}
    sand = {
        **cone_sand.entries_of(DENSITY, VERTICAL),
        **coarse,
        **LONG_STEPS,
        "Grid/Cell width": 0.09,
        "Grid/Cell height": 0.09,
        "Grid/Fine width": 0.03,
        "Grid/Fine height": 0.06,
        "Time/End penetration": 0.35,
    }
    scene = str(scene_of("verification", "cone_tresca"))
    return [
        {"name": "clay", "seconds": 15, "scene": scene, "set": clay},
        {"name": "sand", "seconds": 30, "set": sand},
    ]


def compare(study: Study, _: Path, figure: Figure) -> list[Row]:
    """Draw both curves, and return a row for each."""
    formulas = [formula(CLAY) for formula in cone_clay.FORMULAS.values()]
    low, high = (1 - MARGIN) * min(formulas), (1 + MARGIN) * max(formulas)
    factor = cone_clay.factor_of(study.run("clay"))
    rows = [Row(study.id, "cone factor in clay, two cells", factor, low, high)]
    published = list(cone_sand.fits(DENSITY, VERTICAL).values())
    band = (cone_sand.BAND[0] * min(published), cone_sand.BAND[1] * max(published))
    found = cone_sand.resistance(study.run("sand"), VERTICAL)
    rows.append(Row(study.id, "q_c in sand (MPa), two cells", found, *band))
    figure.set_size_inches(8, 3.5)
    for axes, name in zip(figure.subplots(1, 2), ("clay", "sand")):
        history = study.run(name).results.history
        axes.plot(history["tip_force_N"] / 1e3, history["penetration_m"])
        axes.set(xlabel="force on the cone (kN)", ylabel="depth (m)", title=name)
        axes.invert_yaxis()
    return rows
