# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a cone and a skirt feel in the same ground: k_p and k_f.

k_p is the stress on the tip of a skirt over the cone resistance at the same depth, and
k_f the friction on a wall over the integral of the cone resistance along it. Design
methods take both from experience; here both are computed.
"""
from math import pi
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from caisson import curves
from caisson.design import dnv
from caisson.design.cone import Profile
from caisson.study import Study, StudyRun
from caisson.validation.verdict import Row

CONE_AREA = pi * 0.1**2  # m2, of prm/validation/cone_in_sand.prm
DIAMETER = 6.0  # m, of prm/jack.prm
DEPTHS = (1.0, 2.0, 4.0, 6.0)
WALLS = (0.05, 0.1, 0.2)  # m


class Sand(NamedTuple):
    """A sand of the law of Mohr-Coulomb."""

    name: str
    friction_angle: float  # degrees
    modulus: float  # Pa

    def entries(self) -> dict[str, Any]:
        """Return its entries."""
        return {
            "Soil/Layer 1/Friction angle": self.friction_angle,
            "Soil/Layer 1/Youngs modulus": self.modulus,
        }


SANDS = (Sand("loose", 30, 5e6), Sand("dense", 37, 20e6))


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return a cone and a skirt of each thickness in each sand."""
    runs = []
    for sand in SANDS:
        cone = {"name": f"{sand.name}_cone", "seconds": 50, "set": sand.entries()}
        runs.append(cone)
        for wall in WALLS:
            entries = {
                **sand.entries(),
                "Rigid body/Wall thickness": wall,
                "Output/Frame interval": "never",
                "Output/Frame penetrations": "",
                "Output/Error bar": "",
            }
            name = f"{sand.name}_wall_{wall:g}"
            seconds = 60 * (0.1 / wall) ** 2
            skirt = {"scene": "../jack.prm", "name": name, "set": entries}
            runs.append({**skirt, "seconds": seconds})
    return runs


def cone_profile(run: StudyRun) -> Profile:
    """Return the cone resistance of a run, from its first depth on."""
    history = run.results.history
    rows = curves.way_down(history["penetration_m"])[1:]
    depth = history["penetration_m"][rows]
    force = curves.smoothed_at(depth, history["tip_force_N"][rows], depth)
    # from 0 at the surface
    return Profile([0.0, *depth], [0.0, *(force / CONE_AREA)])


class Coefficients(NamedTuple):
    """Over depths [n]."""

    tip: np.ndarray
    inner: np.ndarray
    outer: np.ndarray


def coefficients(
    run: StudyRun, cone: Profile, wall: float, depth: np.ndarray
) -> Coefficients:
    """Return k_p, and k_f of both walls, at depths [n] (m)."""
    history = run.results.history
    rows = curves.way_down(history["penetration_m"])[1:]
    known = history["penetration_m"][rows]

    def force(name: str) -> np.ndarray:
        return curves.smoothed_at(known, history[name][rows], depth)

    area = pi * (DIAMETER - wall) * wall
    q_c = np.array([cone.at(h) for h in depth])
    integral = np.array([cone.integral(h) for h in depth])
    inner, outer = pi * (DIAMETER - 2 * wall), pi * DIAMETER
    return Coefficients(
        force("tip_force_N") / area / q_c,
        force("inner_friction_N") / inner / integral,
        force("outer_friction_N") / outer / integral,
    )


def compare(study: Study, _: Path, figure: Figure) -> list[Row]:
    """Draw, and return the coefficients at some depths; nothing is asked of them."""
    figure.set_size_inches(10, 4.2)
    axes = figure.subplots(1, 2)
    rows = []
    depth = np.arange(0.8, 6.4, 0.1)
    for i, sand in enumerate(SANDS):
        cone = cone_profile(study.run(f"{sand.name}_cone"))
        for j, wall in enumerate(WALLS):
            run = study.run(f"{sand.name}_wall_{wall:g}")
            k = coefficients(run, cone, wall, depth)
            label = f"{sand.name}, wall {1e3 * wall:g} mm"
            style = {"color": f"C{i}", "ls": ("-", "--", ":")[j]}
            axes[0].plot(k.tip, depth, label=label, **style)
            axes[1].plot(1e3 * k.outer, depth, **style)
            at = coefficients(run, cone, wall, np.array(DEPTHS))
            for h, p, inner, outer in zip(DEPTHS, *at):
                where = f"{label}, {h:g} m"
                rows.append(Row(study.id, f"k_p, {where}", float(p)))
                rows.append(
                    Row(study.id, f"1000 k_f inner, {where}", float(1e3 * inner))
                )
                rows.append(
                    Row(study.id, f"1000 k_f outer, {where}", float(1e3 * outer))
                )
    for panel, index, factor in ((axes[0], 0, 1), (axes[1], 1, 1e3)):
        low, high = [pair[index] * factor for pair in dnv.COEFFICIENTS["sand"]]
        panel.axvspan(low, high, color="0.9", label="DNV, sand")
        panel.invert_yaxis()
        panel.grid(color="0.95")
    axes[0].set(xlabel="$k_p$", ylabel="depth (m)")
    axes[1].set(xlabel="1000 $k_f$, outer wall")
    axes[0].legend(fontsize=8)
    return rows
