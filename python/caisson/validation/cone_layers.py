# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cone through thin layers of clay in sand, measured and computed.

Depths of a cone test are those of the base of the cone (ISO 22476-1); those of a run
are of its point.
"""
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from caisson.results import read_table
from caisson.study import Study, StudyRun
from caisson.validation.verdict import Row

DIAMETER = 0.036  # m
HEIGHT = DIAMETER / 2 * 3**0.5  # m, of the cone
PRESSURE = 0.05  # MPa, which the forces of a run leave out
MEAN = 0.02  # m, over which the measurement is a mean
CLAY = ((0.343, 0.398), (0.455, 0.514), (0.571, 0.626), (0.684, 0.741))  # m
HOMOGENEOUS = {"sand": 1.92, "clay": 0.258}  # MPa
# between layers of clay, and in them: share of the true resistance
IN_SAND, IN_CLAY = (0.52, 0.08), (1.9, 0.3)
LOSSES = (0.05, 0.5)
TOO_LOW = "too low in thin clay, see doc/validation.md"
TO_CLAY = {
    "Soil/Layer 1/Youngs modulus": 4.8e6,
    "Soil/Layer 1/Poisson ratio": 0.45,
    "Soil/Layer 1/Friction angle": 0,
    "Soil/Layer 1/Cohesion": 16.5e3,
}


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return the run in layers, and those in one soil."""
    one = {"Soil/Number of layers": 1, "Time/End penetration": 0.45}
    return [
        {"name": "layers", "seconds": 90, "set": {}},
        {"name": "sand", "seconds": 30, "set": one},
        {"name": "clay", "seconds": 30, "set": {**one, **TO_CLAY}},
    ]


def resistance(run: StudyRun, depth: np.ndarray) -> np.ndarray:
    """Return q_c (MPa) at depths of the base of the cone [n] (m), as it is
    measured."""
    history = run.results.history
    base = history["penetration_m"] - HEIGHT
    q_c = history["tip_force_N"] / (pi * DIAMETER**2 / 4) / 1e6 + PRESSURE
    fine = np.linspace(-MEAN / 2, MEAN / 2, 21)
    return np.array([np.interp(h + fine, base, q_c).mean() for h in depth])


def depth_of_loss(depth: np.ndarray, q_c: np.ndarray, loss: float) -> float:
    """Return where q_c has fallen by a share from its plateau above the first clay."""
    above = (depth > 0.15) & (depth < CLAY[0][1])
    z, q = depth[above], q_c[above]
    plateau = q[z < 0.22].max()
    first = int(np.argmax((q <= (1 - loss) * plateau) & (z > z[np.argmax(q)])))
    return float(
        np.interp(
            (1 - loss) * plateau, [q[first], q[first - 1]], [z[first], z[first - 1]]
        )
    )


def extremes(depth: np.ndarray, q_c: np.ndarray) -> tuple[list[float], list[float]]:
    """Return the largest q_c between the layers of clay, and the smallest about
    each."""
    peaks = []
    for (_, above), (below, _) in zip(CLAY, CLAY[1:]):
        between = (depth > above - 0.03) & (depth < below + 0.01)
        peaks.append(float(q_c[between].max()))
    lows = [
        float(q_c[(depth > top - 0.01) & (depth < bottom + 0.01)].min())
        for top, bottom in CLAY
    ]
    return peaks, lows


def compare(study: Study, measured: Path, figure: Figure) -> list[Row]:
    """Draw, and return the rows: how far ahead the clay is felt, and extremes."""
    table = read_table(measured)
    depth = np.arange(0.04, 0.965, 0.005)
    q_c = resistance(study.run("layers"), depth)
    rows = []
    truth = {}
    for soil, wanted in HOMOGENEOUS.items():
        inside = np.linspace(0.3, 0.4, 11)
        truth[soil] = float(resistance(study.run(soil), inside).mean())
        name = f"q_c in {soil} alone (MPa), fitted to {wanted:g}"
        rows.append(Row(study.id, name, truth[soil]))
    for loss in LOSSES:
        found = depth_of_loss(depth, q_c, loss)
        known = depth_of_loss(table["depth_m"], table["qc_MPa"], loss)
        name = f"depth of {100 * loss:g} % loss less the measured one, in diameters"
        rows.append(Row(study.id, name, (found - known) / DIAMETER, -0.5, 0.5))
    peaks, lows = extremes(depth, q_c)
    for i, value in enumerate(peaks, 1):
        name = f"sand {i} between clay, over sand alone"
        share, margin = IN_SAND
        value /= truth["sand"]
        rows.append(Row(study.id, name, value, share - margin, share + margin))
    for i, value in enumerate(lows, 1):
        share, margin = IN_CLAY
        value /= truth["clay"]
        name = f"clay {i}, over clay alone"
        bounds = share - margin, share + margin
        rows.append(Row(study.id, name, value, *bounds, known=TOO_LOW))
    draw(figure, (depth, q_c), (table["depth_m"], table["qc_MPa"]))
    return rows


Curve = tuple[np.ndarray, np.ndarray]


def draw(figure: Figure, computed: Curve, measured: Curve) -> None:
    """Draw q_c over depth."""
    figure.set_size_inches(5, 6)
    axes = figure.subplots()
    for top, bottom in CLAY:
        axes.axhspan(top, bottom, color="0.88")
    axes.plot(computed[1], computed[0], color="C0", label="computed")
    axes.plot(measured[1], measured[0], "k.-", lw=0.8, label="measured")
    for value in HOMOGENEOUS.values():
        axes.axvline(value, color="0.6", lw=0.8, ls="--")
    axes.set(xlabel="q$_c$ (MPa)", ylabel="depth of the base of the cone (m)")
    axes.set(xlim=(0, 2.4), ylim=(1, 0), title="gray: clay; dashed: in one soil alone")
    axes.title.set_fontsize(9)
    axes.legend()
