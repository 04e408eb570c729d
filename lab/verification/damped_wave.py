# SPDX-License-Identifier: LGPL-2.1-or-later
"""The frequency of the standing radial wave, and what is left of it after two periods.

The wave is c + exp(-g t) (a cos(w t) + b sin(w t)), fitted by least squares to the
observation a of radial_wave.prm.
"""
import math
from typing import Any

import numpy as np
from scipy.optimize import curve_fit

from caisson.results import Results

EXACT = {"frequency a": 3.831705970 * 366.8998, "amplitude a": 1.0}  # rad/s, none
TOLERANCE = {"frequency a": 3e-4, "amplitude a": 1e-3}


def wave(t: np.ndarray, w: float, g: float, a: float, b: float, c: float) -> np.ndarray:
    """Return the wave at times t (s): [n]. w is in rad/s, g in 1/s."""
    return c + np.exp(-g * t) * (a * np.cos(w * t) + b * np.sin(w * t))


def fit(t: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """Return w (rad/s) and g (1/s) of the wave that fits a series of at least one
    period best: [n], [n]."""
    t = t - t[0]
    mean = values.mean()
    crossings = np.count_nonzero(np.diff(values > mean))
    start = (math.pi * crossings / t[-1], 0, values[0] - mean, 0, mean)
    (w, g, *_), _ = curve_fit(wave, t, values, start)
    return float(w), float(g)


def checks(results: Results) -> dict[str, dict[str, Any]]:
    """Return the checks of frequency and amplitude of a run, as those of
    lab.checks."""
    table = results.observations
    w, g = fit(table["time_s"], table["a"])
    computed = {"frequency a": w, "amplitude a": math.exp(-g * 4 * math.pi / w)}
    return {
        head: {
            "mode": head.split()[0],
            "computed": computed[head],
            "exact": exact,
            "relative_error": abs(computed[head] - exact) / exact,
            "tolerance": TOLERANCE[head],
        }
        for head, exact in EXACT.items()
    }
