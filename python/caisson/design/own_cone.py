# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sand in which a cone pushed with the program meets the resistance that was measured.

Correlations of strength and of stiffness are fitted to different tests, so that a cone
in the ground of a scene need not meet the resistance from which the ground was derived.
Here the modulus is the one with which it does. The resistance of the law by density and
stress was computed with the program (computed_cones.csv, `scripts/lab validate --only
cone_density`): a cone of 35.7 mm, with 10.4 degrees of friction, deep in uniform ground
whose side and bottom do not matter, over

    the relative density D_r, the mean effective stress p, and the modulus as a multiple
    of that by Brinkgreve, Engin & Engin (2010), E / (60 MPa D_r).

Between the computed cones the logarithm of q_c is interpolated, linearly over D_r and
over the other logarithms, and so it goes on outside of them. Where no modulus
within a factor of MOST_RATIO of that by density has the resistance, the density changes
as well.

SI units; D_r is a share of 1.
"""
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import brentq

from caisson.design.density import reference_modulus

FILE = Path(__file__).with_name("computed_cones.csv")
AXES = ["relative_density", "mean_stress_kPa", "modulus_ratio"]
# of q_c: four companies in one clay, Onsoy; a cone in the ground of a scene over the
# table, doc/how_to/cpt.md
ERRORS = 0.04, 0.10
MOST_RATIO = 2.5  # of the modulus to that by density, and its inverse
DENSITIES = 0.05, 1.0
EXACT = 1e-6  # of ln q_c
STEPS = 41  # of the ratio, between which it is interpolated for a row
DIAMETER, FRICTION = 0.0357, 10.4  # m and degrees, of the computed cones
DEEP = 1.07  # m, 30 diameters, above which a cone is not deep


class Sand(NamedTuple):
    """Sand by relative density, and its modulus over that by density."""

    density: float
    ratio: float

    @property
    def modulus(self) -> float:
        """E (Pa) at a mean effective stress of 100 kPa."""
        return float(self.ratio * reference_modulus(self.density))


class Rows(NamedTuple):
    """Rows of a cone test in a layer, [n] each: the mean effective stress and the
    resistance (Pa); share: of the modulus there to that of the sand."""

    stress: np.ndarray
    resistance: np.ndarray
    share: np.ndarray

    def excess(self, density: float, ratio: float) -> np.ndarray:
        """Return ln of the computed over the measured resistance [n]."""
        found = computed(density, self.stress, ratio * self.share)
        return np.log(found / np.maximum(self.resistance, 1.0))

    def middle(self, density: float, ratio: float) -> float:
        """Return its median."""
        return float(np.median(self.excess(density, ratio)))

    def ratios(self) -> tuple[float, float]:
        """Return the least and the largest ratio with which the modulus of all rows is
        within MOST_RATIO of that by density."""
        return 1 / MOST_RATIO / float(self.share.min()), MOST_RATIO / float(
            self.share.max()
        )

    def times(self, factor: float) -> "Rows":
        """Return the rows with another resistance."""
        return self._replace(resistance=factor * self.resistance)


@lru_cache
def table() -> tuple[RegularGridInterpolator, tuple[np.ndarray, ...]]:
    """Return what interpolates ln q_c (Pa), and its axes: D_r, ln p (Pa), ln ratio."""
    rows = np.loadtxt(FILE, delimiter=",", skiprows=1)  # in the order of AXES
    density, stress, ratio = (np.unique(column) for column in rows.T[:3])
    axes = density, np.log(1e3 * stress), np.log(ratio)
    grid = np.log(1e6 * rows[:, 3]).reshape([len(axis) for axis in axes])
    # bounds_error and fill_value: it goes on beyond the table
    return (
        RegularGridInterpolator(axes, grid, bounds_error=False, fill_value=None),
        axes,
    )


def computed(
    density: float | np.ndarray, stress: np.ndarray, ratio: float | np.ndarray
) -> np.ndarray:
    """Return the resistance (Pa) [n] that a computed cone meets. stress: mean effective
    (Pa); ratio: of the modulus to that by density; both [n] or of a form that fits."""
    where = np.broadcast_arrays(density, np.log(stress), np.log(ratio))
    return np.asarray(np.exp(table()[0](np.stack(where, axis=-1))))


def deep(rows: np.ndarray, depth: np.ndarray) -> np.ndarray:
    """Return which rows [n] of a layer count: those in which a cone is deep."""
    return rows & (depth >= DEEP)


def is_known(density: float, stress: float) -> bool:
    """Return whether cones were computed about this density and mean stress (Pa)."""
    axes = table()[1]
    inside = axes[1][0] <= np.log(stress) <= axes[1][-1]
    return bool(inside and axes[0][0] <= density <= axes[0][-1])


def zero_of(function: Callable[[float], float], least: float, most: float) -> float:
    """Return where a function that grows is 0, within bounds: the nearer one if it is
    nowhere."""
    if function(least) >= 0:
        return least
    if function(most) <= 0:
        return most
    return float(brentq(function, least, most))


def ratios_of_rows(density: float, rows: Rows) -> np.ndarray:
    """Return the ratio of the modulus, within MOST_RATIO, with which each row [n] would
    be answered."""
    steps = np.geomspace(1 / MOST_RATIO, MOST_RATIO, STEPS)
    found = computed(density, rows.stress[:, np.newaxis], steps)
    logs = zip(np.log(found), np.log(np.maximum(rows.resistance, 1.0)))
    return np.exp([np.interp(row, every, np.log(steps)) for every, row in logs])


def ratio_for(density: float, rows: Rows) -> float:
    """Return the ratio of the modulus, within MOST_RATIO, for a relative density."""
    ends = rows.ratios()
    return float(
        np.exp(zero_of(lambda x: rows.middle(density, np.exp(x)), *np.log(ends)))
    )


def density_for(ratio: float, rows: Rows) -> float:
    """Return the relative density, within DENSITIES, for a ratio of the modulus."""
    return zero_of(lambda density: rows.middle(density, ratio), *DENSITIES)


def fitted(density: float, rows: Rows) -> Sand:
    """Return the sand in which a computed cone meets the measured resistance in the
    middle of the rows. density: D_r, which stays as it is where a modulus within
    MOST_RATIO does."""
    density = min(max(density, DENSITIES[0]), DENSITIES[1])
    ratio = ratio_for(density, rows)
    if abs(rows.middle(density, ratio)) > EXACT:
        density = density_for(ratio, rows)
    return Sand(density, ratio)


def changed(sand: Sand, rows: Rows) -> Sand:
    """Return the sand that answers other rows: of another density, whose modulus has
    the same ratio to that by density, as far as there is one."""
    density = density_for(sand.ratio, rows)
    ratio = ratio_for(density, rows) if density in DENSITIES else sand.ratio
    return Sand(density, ratio)
