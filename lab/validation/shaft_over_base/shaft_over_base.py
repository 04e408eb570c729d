# SPDX-License-Identifier: LGPL-2.1-or-later
"""Local stresses on the shaft of a jacked pile over its base resistance: shear stress
in sand, and in clay the radial stress, both without the hydrostatic pressure."""
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from caisson.runs import StudyRun
from caisson.study import Study
from lab.validation import Row

DIAMETER = 0.102  # m
AREA = pi * DIAMETER**2 / 4
ABOVE = (4, 14)  # diameters above the tip
NEAR = 0.5  # diameters, and m of penetration, over which a stress is a mean
DEEP = 4.0  # m, from which on the means are compared
FACTOR = 1.25  # either way
WATER = 9.81  # kN/m3, of the radial stress in the tests
SANDY, SOFT, STIFF = SITES = "Labenne", "Bothkennar", "Cowden"
NOT_COMPUTED = "strokes, pore water and fissures are not computed: doc/validation.md"
CLAY: dict[str, Any] = {
    "Law": "Mohr-Coulomb",
    "Friction angle": 0,
    "Dilatancy angle": 0,
    "Stiffness exponent": 0,
    "Poisson ratio": 0.49,
    "Porosity": 0.6,
    "K0": 0.6,
    "Adhesion factor of the walls": 0.5,
}
# undrained strength (Pa), from the base resistance; 300 times it is the modulus
STRENGTH = {SOFT: 17e3, STIFF: 130e3}


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return a run for each site."""
    runs: list[dict[str, Any]] = [{"name": SANDY, "seconds": 100, "set": {}}]
    for site, strength in STRENGTH.items():
        layer = CLAY | {"Cohesion": strength, "Tension cut-off": strength / 4}
        layer |= {"Youngs modulus": 300 * strength}
        entries = {f"Soil/Layer 1/{name}": value for name, value in layer.items()}
        entries |= {
            f"Rigid body/Friction angle of the {x}": 0 for x in ("tip", "outer wall")
        }
        runs.append({"name": site, "seconds": 90, "set": entries})
    return runs


def computed(run: StudyRun, column: str, depths: np.ndarray) -> pd.DataFrame:
    """Return the base resistance and the stresses of a column of wall.csv above the
    tip (kPa) at depths (m), as the tests have them."""
    walls, history = pd.DataFrame(run.results.walls), run.results.history
    above = (walls["penetration_m"] - walls["depth_m"]) / DIAMETER
    rows = []
    for depth in depths:
        near = (walls["penetration_m"] - depth).abs() <= NEAR / 2
        stresses = [
            walls[column][near & ((above - h).abs() <= NEAR)].abs().mean()
            for h in ABOVE
        ]
        here = np.abs(history["penetration_m"] - depth) <= NEAR / 2
        base = history["tip_force_N"][here].mean() / AREA
        rows.append([depth, base / 1e3, *(stress / 1e3 for stress in stresses)])
    return pd.DataFrame(rows, columns=["depth_m", "base_kPa", "at_4_kPa", "at_14_kPa"])


def shares(table: pd.DataFrame) -> pd.DataFrame:
    """Return the stresses over the base resistance."""
    found = table[["at_4_kPa", "at_14_kPa"]].div(table["base_kPa"], axis=0)
    return found.assign(depth_m=table["depth_m"])


def compare(study: Study, measured: Path, figure: Figure) -> list[Row]:
    """Draw, and return the means of deep rows beside those of the tests."""
    tests = pd.read_csv(measured, comment="#")
    figure.set_size_inches(11, 3.8)
    rows = []
    for axes, site in zip(figure.subplots(1, 3), SITES):
        test = tests[tests["site"] == site].copy()
        column = "outer_shear_stress_Pa" if site == SANDY else "outer_normal_stress_Pa"
        if site != SANDY:
            pressures = ["base_kPa", "at_4_kPa", "at_14_kPa"]
            test[pressures] = test[pressures].sub(WATER * test["depth_m"], axis=0)
        found = computed(study.run(site), column, np.arange(1.0, 5.3, 0.25))
        known, own = shares(test), shares(found)
        what = "shear" if site == SANDY else "radial"
        for i, h in enumerate(ABOVE):
            name = f"at_{h}_kPa"
            style = {"color": f"C{i}"}
            axes.plot(
                known[name], known["depth_m"], "o", ms=4, **style, label=f"h/D {h}"
            )
            axes.plot(own[name], own["depth_m"], "-", **style, label="computed")
            means = [x[name][x["depth_m"] >= DEEP].mean() for x in (known, own)]
            rows.append(
                Row(
                    study.id,
                    f"{site}, measured {what} stress over base, h/D {h}",
                    means[0],
                )
            )
            bounds = means[0] / FACTOR, means[0] * FACTOR
            reason = "" if site == SANDY else NOT_COMPUTED
            text = f"{site}, computed, h/D {h}"
            rows.append(Row(study.id, text, means[1], *bounds, known=reason))
        axes.set(
            title=site, xlabel=f"{what} stress over base resistance", xlim=(0, None)
        )
        axes.invert_yaxis()
        axes.grid(color="0.93")
        axes.legend(fontsize=7)
    figure.axes[0].set_ylabel("depth (m)")
    return rows
