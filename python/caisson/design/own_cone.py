# SPDX-License-Identifier: LGPL-2.1-or-later
"""The density of sand in which a cone pushed with the program meets the resistance that
was measured.

A correlation of the density is fitted to tests in chambers, so that a cone in the
ground of a scene need not meet the resistance from which the ground was derived. Here
the density is the one with which it does, with the modulus by density of Brinkgreve,
Engin & Engin (2010), 60 MPa D_r. The resistance of the law by density and stress was
computed with the program (computed_cones.csv, `scripts/lab validate --only
cone_density`): a cone of 35.7 mm, with 20 degrees of friction, deep in uniform ground
whose side and bottom do not matter, over the relative density D_r, the mean effective
stress p, and the modulus as a multiple of that by density.

The density is fitted and not the modulus, because the stress on the ring of an open
tube hardly follows the modulus, and that on a cone does: with 0.4 times the modulus
their ratio is 1.0 to 1.7 in place of the measured 0.95. The friction is that of the tip
of a caisson, with which their ratio is the measured one (doc/validation.md).

Between the computed cones the logarithm of q_c is interpolated, linearly over D_r and
over the other logarithms, and so it goes on outside of them. Where the densest or the
loosest sand does not answer, the modulus changes as well, by a factor of at most
MOST_RATIO.

SI units; D_r is a share of 1; all functions take arrays [n].
"""
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import RegularGridInterpolator

FILE = Path(__file__).with_name("computed_cones.csv")
AXES = ["relative_density", "mean_stress_kPa", "modulus_ratio"]
# of q_c: four companies in one clay, Onsoy; a cone in the ground of a scene over the
# table, doc/how_to/cpt.md
ERRORS = 0.04, 0.10
MOST_RATIO = 2.5  # of the modulus to that by density, and its inverse
DENSITIES = 0.05, 1.0
STEPS = 77  # of density and modulus, between which they are interpolated
DIAMETER, FRICTION = 0.0357, 20.0  # m and degrees, of the computed cones
DEEP = 1.07  # m, 30 diameters, above which a cone is not deep


@lru_cache
def table() -> RegularGridInterpolator:
    """Return what interpolates ln q_c (Pa) over D_r, ln p (Pa) and ln ratio."""
    rows = np.loadtxt(FILE, delimiter=",", skiprows=1)  # in the order of AXES
    density, stress, ratio = (np.unique(column) for column in rows.T[:3])
    axes = density, np.log(1e3 * stress), np.log(ratio)
    grid = np.log(1e6 * rows[:, 3]).reshape([len(axis) for axis in axes])
    # bounds_error and fill_value: it goes on beyond the table
    return RegularGridInterpolator(axes, grid, bounds_error=False, fill_value=None)


def computed(density: Any, stress: Any, ratio: Any) -> np.ndarray:
    """Return the resistance (Pa) that a computed cone meets. stress: mean effective
    (Pa); ratio: of the modulus to that by density; all of forms that fit."""
    where = np.broadcast_arrays(density, np.log(stress), np.log(ratio))
    return np.asarray(np.exp(table()(np.stack(where, axis=-1))))


def answers(
    resistance: np.ndarray, found: np.ndarray, values: np.ndarray
) -> np.ndarray:
    """Return which of values [n_values] has each resistance [n]: the nearest one if
    none has. found: the resistances of the values, [n, n_values], which grow."""
    logs = zip(np.log(np.maximum(resistance, 1.0)), np.log(found))
    return np.array([np.interp(q, every, values) for q, every in logs])


def densities(resistance: np.ndarray, stress: np.ndarray) -> np.ndarray:
    """Return the relative density, within DENSITIES, in which a computed cone meets a
    resistance (Pa) at a mean effective stress (Pa)."""
    steps = np.linspace(*DENSITIES, STEPS)
    return answers(resistance, computed(steps, stress[:, np.newaxis], 1.0), steps)


def ratios(
    density: np.ndarray, resistance: np.ndarray, stress: np.ndarray
) -> np.ndarray:
    """Return the ratio of the modulus to that by density with which it is met: 1 but
    where the density is the first or the last of DENSITIES."""
    steps = np.geomspace(1 / MOST_RATIO, MOST_RATIO, STEPS)
    found = computed(density[:, np.newaxis], stress[:, np.newaxis], steps)
    is_end = np.isin(density, DENSITIES)
    return np.where(is_end, answers(resistance, found, steps), 1.0)


def is_deep(depth: np.ndarray) -> np.ndarray:
    """Return at which depths (m) a cone is deep."""
    return np.asarray(depth >= DEEP)


def is_known(density: float, stress: float) -> bool:
    """Return whether cones were computed about this density and mean stress (Pa)."""
    shares, stresses, _ = table().grid
    inside = stresses[0] <= np.log(stress) <= stresses[-1]
    return bool(inside and shares[0] <= density <= shares[-1])
