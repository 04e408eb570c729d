# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a cone and a skirt feel in the same ground: k_p and k_f.

k_p is the stress on the tip of a skirt over the cone resistance at the same depth, and
k_f the friction on a wall over the integral of the cone resistance along it. Design
methods take both from experience; here both are computed.

The error bar of each is that of both meshes: the difference from a coarser mesh, over
the ratio of the cell sizes less 1, as for an error of first order; of cone and skirt it
is the root of the sum of squares.
"""
from math import pi
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.ndimage import uniform_filter1d

from caisson import curves
from caisson.paths import SCENES
from caisson.runs import StudyRun
from caisson.study import Study
from caisson.design import dnv
from caisson.design.cone import Profile
from lab.validation import Row

CONE_AREA = pi * 0.1**2  # m2, of lab/validation/cone_in_sand/cone_in_sand.prm
DIAMETER = 6.0  # m, of prm/jack.prm
DEPTHS = (1.0, 2.0, 4.0, 6.0)
WALLS = (0.05, 0.1, 0.2)  # m
COARSE = "_coarse"  # ends the name of a run on a coarser mesh
SMOOTHED = 11  # rows, 1 m, over which an error is a mean


def mesh_of(cells: int, size: float) -> dict[str, Any]:
    """Return entries with the cells across the wall, or the radius of the cone, and the
    size of the other cells over that of prm/jack.prm."""
    return {
        "Rigid body/Cells across the wall": cells,
        "Grid/Cell width": 1.2 * size,
        "Grid/Cell height": 0.4 * size,
        "Grid/Fine width": 0.15 * size,
        "Grid/Fine height": 0.15 * size,
    }


# of skirts 4 cells are 2, of cones 3 are 2
SKIRT_RATIO, CONE_RATIO = 2.0, 1.5


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
        name, entries = f"{sand.name}_cone", sand.entries()
        runs.append({"name": name, "seconds": 50, "set": entries})
        coarse = {**entries, **mesh_of(2, CONE_RATIO)}
        runs.append({"name": name + COARSE, "seconds": 15, "set": coarse})
        for wall in WALLS:
            entries = {
                **sand.entries(),
                "Rigid body/Wall thickness": wall,
                "Output/Frame interval": "never",
                "Output/Frame penetrations": "",
            }
            name = f"{sand.name}_wall_{wall:g}"
            seconds = 60 * (0.1 / wall) ** 2
            skirt = {"scene": str(SCENES / "jack.prm"), "seconds": seconds}
            runs.append({**skirt, "name": name, "set": entries})
            coarse = {**entries, **mesh_of(2, SKIRT_RATIO)}
            skirt["seconds"] = seconds / 8
            runs.append({**skirt, "name": name + COARSE, "set": coarse})
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


def estimate(
    study: Study, sand: Sand, wall: float, depth: np.ndarray
) -> tuple[Coefficients, Coefficients]:
    """Return the coefficients at depths [n], 0.1 m apart, and their error bars."""
    of_cone, of_skirt = f"{sand.name}_cone", f"{sand.name}_wall_{wall:g}"

    def found(cone: str, skirt: str) -> Coefficients:
        profile = cone_profile(study.run(cone))
        return coefficients(study.run(skirt), profile, wall, depth)

    fine = found(of_cone, of_skirt)
    others = found(of_cone, of_skirt + COARSE), found(of_cone + COARSE, of_skirt)
    errors = [
        np.hypot((k - skirt) / (SKIRT_RATIO - 1), (k - cone) / (CONE_RATIO - 1))
        for k, skirt, cone in zip(fine, *others)
    ]
    return fine, Coefficients(*(uniform_filter1d(e, SMOOTHED) for e in errors))


def compare(study: Study, _: Path, figure: Figure) -> list[Row]:
    """Draw, and return the coefficients at some depths; nothing is asked of them."""
    figure.set_size_inches(10, 4.2)
    axes = figure.subplots(1, 2)
    rows = []
    depth = np.arange(0.8, 6.4, 0.1)
    for i, sand in enumerate(SANDS):
        for j, wall in enumerate(WALLS):
            k, error = estimate(study, sand, wall, depth)
            label = f"{sand.name}, wall {1e3 * wall:g} mm"
            style = {"color": f"C{i}", "ls": ("-", "--", ":")[j]}
            draw(axes[0], depth, (k.tip, error.tip), style, label)
            draw(axes[1], depth, (1e3 * k.outer, 1e3 * error.outer), style, label)
            names = ("k_p", 1), ("1000 k_f inner", 1e3), ("1000 k_f outer", 1e3)
            for (name, factor), value, bar in zip(names, k, error):
                for h in DEPTHS:
                    at, within = (
                        factor * float(np.interp(h, depth, y)) for y in (value, bar)
                    )
                    where = f"{name}, {label}, {h:g} m"
                    rows.append(Row(study.id, where, at))
                    rows.append(Row(study.id, f"error bar of {where}", within))
    for panel, index, factor in ((axes[0], 0, 1), (axes[1], 1, 1e3)):
        low, high = [pair[index] * factor for pair in dnv.COEFFICIENTS["sand"]]
        panel.axvspan(low, high, color="0.9", label="DNV, sand")
        panel.invert_yaxis()
        panel.grid(color="0.95")
    axes[0].set(xlabel="$k_p$", ylabel="depth (m)", xlim=(0, 1.6))
    axes[1].set(xlabel="1000 $k_f$, outer wall", xlim=(0, 25))
    axes[0].legend(fontsize=8)
    return rows


def draw(
    axes: Axes,
    depth: np.ndarray,
    found: tuple[np.ndarray, np.ndarray],
    style: dict[str, str],
    label: str,
) -> None:
    """Draw a coefficient with its error bar over depth."""
    value, error = found
    axes.plot(value, depth, label=label, **style)
    axes.fill_betweenx(
        depth, value - error, value + error, color=style["color"], alpha=0.12, lw=0
    )
