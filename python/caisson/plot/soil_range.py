# SPDX-License-Identifier: LGPL-2.1-or-later
"""The range between low and high resistance of the soil, over penetration."""
import numpy as np
from matplotlib.axes import Axes

from caisson.verdict.outcome import depth_of
from caisson import curves
from caisson.band import band_of
from caisson.results import Results

LABEL = "low to high resistance"
POINTS = 200
Range = tuple[np.ndarray, np.ndarray, np.ndarray]  # depth (m), least, most: each [n]


def curve_of(run: Results, column: str, at: np.ndarray) -> np.ndarray:
    """Return the means of a column on the way down at depths [n] (m), nan where the run
    has not been, or is not feasible: [n]."""
    rows = curves.way_down(run.history["penetration_m"])[1:]
    depth = run.history["penetration_m"][rows]
    if len(depth) < 2 or column not in run.history:
        return np.full(len(at), np.nan)
    values = curves.smoothed_within(depth, run.history[column][rows], at)
    return np.where(at <= (depth_of(run) or np.inf), values, np.nan)


def range_of(run: Results, column: str) -> Range | None:
    """Return the range of a column (kN or kPa, and none below 0) among the estimates of
    a run, as deep as all of them go; None without any but the best one."""
    members = list(band_of(run).values())
    if len(members) < 2:
        return None
    depth = run.history["penetration_m"]
    at = np.linspace(float(depth.min()), float(depth.max()), POINTS)
    values = np.array([curve_of(member, column, at) / 1e3 for member in members])
    known = np.isfinite(values).all(axis=0)
    if not known.any():
        return None
    values = np.maximum(values[:, known], 0)
    return at[known], values.min(axis=0), values.max(axis=0)


def draw(axes: Axes, run: Results, column: str, name: str) -> list[np.ndarray]:
    """Draw the range of a column as an area; return its ends, of which there are none
    without a band."""
    found = range_of(run, column)
    if found is None:
        return []
    style = {"facecolor": "black", "alpha": 0.13, "linewidth": 0}
    axes.fill_betweenx(*found, label=f"{name}, {LABEL}", **style)
    return list(found[1:])
