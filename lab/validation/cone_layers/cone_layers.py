# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cone through thin layers of clay in sand, measured and computed.

Depths of a cone test are those of the base of the cone (ISO 22476-1); those of a run
are of its point.
"""
from dataclasses import replace
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from caisson.results import read_table
from caisson.runs import StudyRun
from caisson.study import Study
from lab.validation import Row

DIAMETER = 0.036  # m
HEIGHT = DIAMETER / 2 * 3**0.5  # m, of the cone
PRESSURE = 0.05  # MPa, which the forces of a run leave out
MEAN = 0.02  # m, over which the measurement is a mean
CLAY = ((0.343, 0.398), (0.455, 0.514), (0.571, 0.626), (0.684, 0.741))  # m
SAND, CLAY_ALONE = 1.92, 0.258  # q_c in one soil, MPa
# bounds of the share of it between layers of clay, and in them
IN_SAND, IN_CLAY = (0.44, 0.60), (1.6, 2.2)
LOSSES = (0.05, 0.5)
TOO_LOW = "grows as the rigidity index falls, see doc/validation.md"
EARLY = "soft clay is felt early, see doc/validation.md"
# rigidity index G/s_u of the clay: Young's modulus and strength (Pa), so that q_c in
# clay alone is the measured one
RIGIDITY = {100: (4.77e6, 16.0e3), 33: (2.0e6, 20.4e3), 20: (1.39e6, 23.2e3)}

Curve = tuple[np.ndarray, np.ndarray]  # depth (m) and q_c (MPa)


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return the run in sand, and those in layers and in clay for each rigidity."""
    one = {"Soil/Number of layers": 1, "Time/End penetration": 0.45}
    runs: list[dict[str, Any]] = [{"name": "sand", "seconds": 30, "set": one}]
    undrained = {"Soil/Layer 1/Poisson ratio": 0.49, "Soil/Layer 1/Friction angle": 0}
    for rigidity in RIGIDITY:
        in_layers: dict[str, Any] = {}
        for layer in (2, 4, 6, 8):
            in_layers.update(clay_in(layer, rigidity))
        alone = {**one, **undrained, **clay_in(1, rigidity)}
        runs.append({"name": f"layers_{rigidity}", "seconds": 120, "set": in_layers})
        runs.append({"name": f"clay_{rigidity}", "seconds": 30, "set": alone})
    return runs


def clay_in(layer: int, rigidity: int) -> dict[str, Any]:
    """Return the entries of stiffness and strength of a layer of clay."""
    modulus, strength = RIGIDITY[rigidity]
    return {
        f"Soil/Layer {layer}/Youngs modulus": modulus,
        f"Soil/Layer {layer}/Cohesion": strength,
    }


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
    """Draw, and return the rows of each rigidity of the clay.

    All are from means over 2 cm at the depths of the measurement, in which they are
    given.
    """
    table = read_table(measured)
    truth = table["depth_m"], table["qc_MPa"]
    sand = alone(study, "sand")
    rows = [Row(study.id, f"q_c (MPa) in sand alone, fitted to {SAND:g}", sand)]
    for rigidity in RIGIDITY:
        clay = alone(study, f"clay_{rigidity}")
        found = truth[0], resistance(study.run(f"layers_{rigidity}"), truth[0])
        quantities = [
            Row("", f"q_c (MPa) in clay alone, fitted to {CLAY_ALONE:g}", clay)
        ]
        quantities += losses(found, truth) + shares(found, sand, clay)
        for row in quantities:
            name = f"G/s_u = {rigidity}: {row.quantity}"
            rows.append(replace(row, comparison=study.id, quantity=name))
    depth = np.arange(0.04, 0.965, 0.005)
    curves = {r: resistance(study.run(f"layers_{r}"), depth) for r in RIGIDITY}
    draw(figure, depth, curves, truth)
    return rows


def losses(found: Curve, truth: Curve) -> list[Row]:
    """Return how far from the measured depths the loss ahead of the clay is felt."""
    rows = []
    for loss in LOSSES:
        ahead = (depth_of_loss(*found, loss) - depth_of_loss(*truth, loss)) / DIAMETER
        name = f"depth of {100 * loss:g} % loss less the measured, in diameters"
        known = EARLY if -0.6 < ahead < 0 else ""
        rows.append(Row("", name, ahead, -0.5, 0.5, known))
    return rows


def shares(found: Curve, sand: float, clay: float) -> list[Row]:
    """Return the extremes of q_c over those in each soil alone, sand and clay (MPa)."""
    peaks, lows = extremes(*found)
    rows = []
    for i, value in enumerate(peaks, 1):
        name = f"sand {i} between clay, over sand alone"
        rows.append(Row("", name, value / sand, *IN_SAND))
    for i, value in enumerate(lows, 1):
        share = value / clay
        known = TOO_LOW if share > 1.35 else ""
        rows.append(Row("", f"clay {i}, over clay alone", share, *IN_CLAY, known))
    return rows


def alone(study: Study, name: str) -> float:
    """Return q_c (MPa) in one soil."""
    return float(resistance(study.run(name), np.linspace(0.3, 0.4, 11)).mean())


def draw(
    figure: Figure,
    depth: np.ndarray,
    curves: dict[int, np.ndarray],
    measured: Curve,
) -> None:
    """Draw q_c over depth, for each rigidity of the clay."""
    figure.set_size_inches(5, 6)
    axes = figure.subplots()
    for top, bottom in CLAY:
        axes.axhspan(top, bottom, color="0.88")
    for (rigidity, q_c), color in zip(curves.items(), ("C0", "C2", "C1")):
        axes.plot(q_c, depth, color=color, label=f"computed, clay of G/sᵤ = {rigidity}")
    axes.plot(measured[1], measured[0], "k.-", lw=0.8, label="measured")
    for value in (SAND, CLAY_ALONE):
        axes.axvline(value, color="0.6", lw=0.8, ls="--")
    axes.set(xlabel="q$_c$ (MPa)", ylabel="depth of the base of the cone (m)")
    axes.set(xlim=(0, 2.4), ylim=(1, 0), title="gray: clay; dashed: in one soil alone")
    axes.title.set_fontsize(9)
    axes.legend()
