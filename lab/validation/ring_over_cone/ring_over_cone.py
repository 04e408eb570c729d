# SPDX-License-Identifier: LGPL-2.1-or-later
"""The stress on the ring of a jacked open tube and on the base of its plug, over the
resistance of a cone in the same ground, against the filling ratio: by how much the plug
grows while the tube sinks. No property of the soil of the tests is needed. Of each way
between two frames, 0.1 m long, there is one value.
"""
from math import pi
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

import caisson
from caisson.results import Table
from caisson.runs import StudyRun
from caisson.study import Study
from lab.validation import Row

TUBE, WALL, CONE = 0.2, 0.008, 0.0357  # m, diameters and thickness
RING_AREA = pi * (TUBE - WALL) * WALL
PLUG_RADIUS = TUBE / 2 - WALL
CONE_AREA = pi * CONE**2 / 4
RINGS = 5  # of the plug, over which its surface is a mean
FIRST = 0.2  # m, from which on a tube counts
GROWING = 0.9, 1.1  # filling ratios of a plug that grows with the tube, as in a caisson
# bounds of the means there, from the scatter of the tests
ASKED = {"medium": (0.84, 1.06), "dense": (0.84, 1.06), "clay": (1.07, 1.23)}
PLUG_ASKED = (0.06, 0.18)
CLAY_SHORT = "0.2 % short over the first diameter, see doc/validation.md"
CLAY = {
    "Law": "Mohr-Coulomb",
    "Friction angle": 0,
    "Dilatancy angle": 0,
    "Cohesion": 10e3,
    "Tension cut-off": 2.5e3,
    "Youngs modulus": 3e6,
    "Stiffness exponent": 0,
    "Poisson ratio": 0.45,
    "Porosity": 0.679,
    "K0": 1,
    "Adhesion factor of the walls": 0.5,
}
SOILS: dict[str, dict[str, Any]] = {
    "medium": {},
    "dense": {
        "Relative density": 0.75,
        "Youngs modulus": 45e6,
        "Reference void ratio": 0.6075,
    },
    "clay": CLAY,
}
SMOOTH = {  # adhesion stands in the place of friction
    f"Rigid body/Friction angle of the {part}": 0
    for part in ("tip", "inner wall", "outer wall")
}


class Ways(NamedTuple):
    """Of each way of a tube [n]: its end (m), the filling ratio, and the stresses on
    ring and plug over the cone resistance."""

    depth: np.ndarray
    filling: np.ndarray
    ring: np.ndarray
    plug: np.ndarray

    @property
    def growing(self) -> np.ndarray:
        """Where the plug grows with the tube [n]."""
        return (self.filling >= GROWING[0]) & (self.filling <= GROWING[1])


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return a tube and a cone in each soil."""
    cone, runs = str(Path(__file__).with_name("cone.prm")), []
    for soil, layer in SOILS.items():
        entries = {f"Soil/Layer 1/{name}": value for name, value in layer.items()}
        entries |= SMOOTH if soil == "clay" else {}
        runs.append({"name": f"{soil}_tube", "seconds": 300, "set": entries})
        inner = "Rigid body/Friction angle of the inner wall"
        without = {name: value for name, value in entries.items() if name != inner}
        of_cone = {"scene": cone, "seconds": 20, "set": without}
        runs.append({"name": f"{soil}_cone", **of_cone})
    return runs


def mean_between(history: Table, column: str, ends: np.ndarray) -> np.ndarray:
    """Return the means of a column [n_ends - 1] between depths (m)."""
    depth, values = history["penetration_m"], history[column]
    pairs = zip(ends[:-1], ends[1:])
    return np.array([values[(depth > a) & (depth <= b)].mean() for a, b in pairs])


def surface_of_plug(positions: np.ndarray) -> float:
    """Return the mean height (m) of the highest points in rings of the plug."""
    radius, height = positions[:, 0], positions[:, 1]
    edges = np.linspace(0, PLUG_RADIUS, RINGS + 1)
    tops = [
        height[(radius >= a) & (radius < b)].max() for a, b in zip(edges, edges[1:])
    ]
    return float(np.average(tops, weights=edges[1:] ** 2 - edges[:-1] ** 2))


def ways_of(tube: StudyRun, cone: StudyRun) -> Ways:
    """Return what a tube and a cone meet in the same ground."""
    frames = caisson.load(str(tube.run.directory)).frames
    ends = np.array([frame.penetration for frame in frames])
    heights = np.array([surface_of_plug(frame.positions) for frame in frames])
    filling = 1 + np.diff(heights) / np.diff(ends)
    history = tube.results.history
    force = mean_between(cone.results.history, "tip_force_N", ends)
    resistance = force / CONE_AREA
    ring = mean_between(history, "tip_force_N", ends) / RING_AREA / resistance
    plug = mean_between(history, "inner_friction_N", ends) / (pi * PLUG_RADIUS**2)
    counts = ends[:-1] >= FIRST - 1e-3
    columns = ends[1:], filling, ring, plug / resistance
    return Ways(*(column[counts] for column in columns))


def compare(study: Study, measured: Path, figure: Figure) -> list[Row]:
    """Draw all ways beside the tests, and return the means where the plug grows."""
    rows, found = [], {}
    for soil, bounds in ASKED.items():
        ways = ways_of(study.run(f"{soil}_tube"), study.run(f"{soil}_cone"))
        found[soil], grows = ways, ways.growing
        known = CLAY_SHORT if soil == "clay" else ""
        name, mean = f"ring over q_c, {soil}", float(ways.ring[grows].mean())
        rows.append(Row(study.id, name, mean, *bounds, known=known))
        if soil != "clay":
            name = f"plug over q_c, {soil} sand"
            mean = float(ways.plug[grows].mean())
            rows.append(Row(study.id, name, mean, *PLUG_ASKED))
        for end, filling, ring in zip(ways.depth, ways.filling, ways.ring):
            where = f"{soil}, over 0.1 m to {end:.1f} m"
            rows.append(Row(study.id, f"filling ratio, {where}", filling))
            rows.append(Row(study.id, f"ring over q_c, {where}", ring))
    draw(figure, found, pd.read_csv(measured, comment="#"))
    return rows


def draw(figure: Figure, found: dict[str, Ways], tests: pd.DataFrame) -> None:
    """Draw ring and plug over the filling ratio."""
    figure.set_size_inches(11, 3.8)
    panels = {
        "ring in sand": (["medium", "dense"], "ring"),
        "ring in clay": (["clay"], "ring"),
        "plug in sand": (["medium", "dense"], "plug"),
    }
    for axes, (name, (soils, part)) in zip(figure.subplots(1, 3), panels.items()):
        here = tests[tests["quantity"] == name]
        style = {"color": "0.6", "label": "measured"}
        axes.plot(here["filling_ratio"], here["over_qc"], "o", ms=4, **style)
        for soil in soils:
            ways = found[soil]
            values = ways.ring if part == "ring" else ways.plug
            axes.plot(ways.filling, values, "s-", ms=5, label=f"computed, {soil}")
        axes.set(title=name, xlabel="filling ratio", xlim=(0, 1.6), ylim=(0, None))
        axes.grid(color="0.93")
        axes.legend(fontsize=8)
    figure.axes[0].set_ylabel("stress over $q_c$")
