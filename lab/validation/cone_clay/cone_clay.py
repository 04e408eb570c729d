# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cone factor of clay over rigidity, roughness and stress, beside three published
formulas.

Each case is a run on several meshes, whose factors are extrapolated in the size of the
cells by a straight line. The formulas:

C.I. Teh, G.T. Houlsby (1991), An analytical study of the cone penetration test in clay.
Geotechnique 41, 17-34.
H.S. Yu, L.R. Herrmann, R.W. Boulanger (2000), Analysis of steady cone penetration in
clay. J. Geotech. Geoenviron. Eng. 126, 594-605.
Q. Lu, M.F. Randolph, Y. Hu, I.C. Bugarski (2004), A numerical study of cone penetration
in clay. Geotechnique 54, 257-267.
"""
from collections.abc import Callable
from math import log, pi, sqrt
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from caisson.runs import StudyRun
from caisson.study import Study
from lab.curves import final_mean
from lab.validation import Row

STRENGTH = 10e3  # Pa, of lab/verification/cone_tresca.prm
RADIUS = 0.01785  # m
POISSON = 0.45
MARGIN = 0.03  # beyond the formulas


class Case(NamedTuple):
    """What a cone is pushed into."""

    rigidity: float = 100.0  # G / s_u
    roughness: float = 0.0  # adhesion of the cone over s_u
    stress: float = 0.0  # (vertical - horizontal) / (2 s_u)

    @property
    def name(self) -> str:
        """Of its runs, without the mesh."""
        return f"I{self.rigidity:g}_a{self.roughness:g}_D{self.stress:g}"

    def entries(self) -> dict[str, Any]:
        """Return what differs from the scene. Lengths grow with the plastic zone; where
        the stress is not the same in all directions, the cone needs a longer way."""
        size = max(1.0, sqrt(self.rigidity / 100))
        end = 0.7 if self.stress else 0.5  # m
        radial = 2 * self.stress * STRENGTH  # tension is positive
        return {
            "Soil/Layer 1/Youngs modulus": 2 * (1 + POISSON) * self.rigidity * STRENGTH,
            "Soil/Initial stress": "uniform",
            "Soil/Uniform stress": f"{radial:g}, 0, {radial:g}, 0",
            "Rigid body/Adhesion of the tip": self.roughness * STRENGTH,
            "Rigid body/Initial penetration": 0.12 * size,
            "Rigid body/Skirt length": (end + 0.2) * size,
            "Time/End penetration": end * size,
            "Grid/Outer radius": 0.5 * size,
            "Grid/Bottom": -(end + 0.5) * size,
            "Grid/Top": (end + 0.2) * size,
        }


RIGIDITIES = (33.0, 50.0, 100.0, 200.0, 500.0)
CASES = (
    *(Case(rigidity) for rigidity in RIGIDITIES),
    Case(roughness=0.5),
    Case(roughness=1.0),
    Case(stress=-0.5),
    Case(stress=0.5),
)
MESHES = (2, 3)  # cells across the radius
FINE = 4  # more of the case that the others are compared with

# by rigidity, roughness and stress
FORMULAS: dict[str, Callable[[Case], float]] = {
    "Teh & Houlsby (1991)": lambda c: 4
    / 3
    * (1 + log(c.rigidity))
    * (1.25 + c.rigidity / 2000)
    + 2.4 * c.roughness
    - 1.8 * c.stress,
    "Lu et al. (2004)": lambda c: 3.4
    + 1.6 * log(c.rigidity)
    + 1.3 * c.roughness
    - 1.9 * c.stress,
    "Yu et al. (2000)": lambda c: 0.33
    + 2 * log(c.rigidity)
    + 2.37 * c.roughness
    - 1.83 * c.stress,
}


def meshes_of(case: Case) -> tuple[int, ...]:
    """Return the meshes of a case."""
    return (*MESHES, FINE) if case == Case() else MESHES


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return a run for each case and mesh."""
    return [
        {
            "name": f"{case.name}_R{n}",
            "seconds": 10 * n**2 * case.rigidity / 100,
            "set": {**case.entries(), "Rigid body/Cells across the wall": n},
        }
        for case in CASES
        for n in meshes_of(case)
    ]


def factor_of(run: StudyRun) -> float:
    """Return N = (q_c - vertical stress) / s_u at the end of a run, the mean over two
    radii; the vertical stress is none."""
    history = run.results.history
    force = final_mean(history["penetration_m"], history["tip_force_N"], 2 * RADIUS)
    return force / (pi * RADIUS**2 * STRENGTH)


def limit_of(study: Study, case: Case) -> tuple[float, list[float]]:
    """Return the factor at zero cell size, and those of the meshes."""
    meshes = meshes_of(case)
    found = [factor_of(study.run(f"{case.name}_R{n}")) for n in meshes]
    line = np.polyfit([1 / n for n in meshes], found, 1)
    return float(line[1]), found


def compare(study: Study, _: Path, figure: Figure) -> list[Row]:
    """Draw, and return the rows: each case between the formulas, and slopes."""
    limits = {case: limit_of(study, case) for case in CASES}
    rows = []
    for case, (limit, found) in limits.items():
        formulas = [formula(case) for formula in FORMULAS.values()]
        name = f"G/su {case.rigidity:g}, roughness {case.roughness:g}"
        name += f", stress {case.stress:g}"
        low, high = (1 - MARGIN) * min(formulas), (1 + MARGIN) * max(formulas)
        rows.append(Row(study.id, f"cone factor, {name}", limit, low, high))
    factors = {case: limit for case, (limit, _) in limits.items()}
    rough = np.polyfit(
        [0, 0.5, 1], [factors[Case(roughness=a)] for a in (0, 0.5, 1)], 1
    )
    anisotropic = [factors[Case(stress=d)] for d in (-0.5, 0, 0.5)]
    stress = np.polyfit([-0.5, 0, 0.5], anisotropic, 1)
    rows.append(Row(study.id, "slope in roughness", float(rough[0]), 1.3, 2.4))
    rows.append(Row(study.id, "slope in stress", float(stress[0]), -1.9, -1.8))
    draw(figure, limits)
    return rows


def draw(figure: Figure, limits: dict[Case, tuple[float, list[float]]]) -> None:
    """Draw the factor over rigidity, roughness and stress."""
    figure.set_size_inches(11, 3.8)
    panels = (
        ("rigidity", "G / s$_u$", [Case(rigidity=x) for x in RIGIDITIES]),
        ("roughness", "roughness", [Case(roughness=x) for x in (0, 0.5, 1)]),
        ("stress", "stress", [Case(stress=x) for x in (-0.5, 0, 0.5)]),
    )
    for axes, (key, label, cases) in zip(figure.subplots(1, 3), panels):
        x = [getattr(case, key) for case in cases]
        for (name, formula), style in zip(FORMULAS.items(), ("-", "--", ":")):
            values = [formula(case) for case in cases]
            axes.plot(x, values, style, color="0.4", label=name)
        for i, n in enumerate(MESHES):
            values = [limits[case][1][i] for case in cases]
            axes.plot(x, values, ".", color="C1", alpha=0.4 + 0.3 * i, label=f"R/{n}")
        values = [limits[case][0] for case in cases]
        axes.plot(x, values, "o", color="C0", label="extrapolated")
        axes.set(xlabel=label)
        axes.grid(color="0.9")
        if key == "rigidity":
            axes.set_xscale("log")
    figure.axes[0].set_ylabel("cone factor")
    figure.axes[0].legend(fontsize=7)
