# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stresses in the ground and the type of soil, over the depth of a cone test.

    q_t = q_c + (1 - a) u_2                          a: net area ratio of the cone
    gamma = gamma_w (0.27 log R_f + 0.36 log(q_t/p_a) + 1.236),     R_f = 100 f_s / q_t
    sigma_v = integral of gamma dz,    sigma'_v = sigma_v - gamma_w z
    Q_tn = (q_t - sigma_v)/p_a (p_a/sigma'_v)^n,     F_r = 100 f_s / (q_t - sigma_v)
    n = 0.381 I_c + 0.05 sigma'_v/p_a - 0.15,        at most 1
    I_c = sqrt((3.47 - log Q_tn)^2 + (log F_r + 1.22)^2)

with logarithms of base 10, R_f and F_r in percent, and p_a = 100 kPa. The unit weight
is that of Robertson & Cabal (2010, "Estimating soil unit weight from CPT", CPT'10,
Huntington Beach), the index that of Robertson (2009, doi 10.1139/T09-065). I_c and n
depend on each other and are found by iteration. Both formulas have been compared with
two published programs, not with the papers themselves. Under low stress the first one
gives loose sand a weight that no sand has: that of sand (I_c < 2.6) is held at 17.5
kN/m3 and more, a void ratio of 1.1, for which stress and I_c are found again.

The ground is below water: stresses are those above the pressure of the water at the
mudline, and u_2 counts from there.

SI units: m, Pa, N/m3.
"""
from dataclasses import dataclass

import numpy as np

from caisson_design import cone_file
from caisson_design.cone_file import Test

ATMOSPHERE = 100e3
WATER = cone_file.WATER  # unit weight
GRAVITY = 9.81
LEAST_STRESS = 1e3  # of sigma'_v where something is divided by it: some 0.1 m of depth
WEIGHTS = 14e3, 22e3  # between which the formula is held
LEAST_OF_SAND = 17.5e3
ROUNDS = 3  # of weight, stress and kind of soil
FRICTION_RATIOS = 0.1, 10.0  # %, the ends of the chart of soil types
SAND, SILT, CLAY = "sand", "silt", "clay"
# I_c below which soil is sand-like, and above which it is clay-like (Robertson 2009)
SAND_BELOW, CLAY_ABOVE = 2.60, 2.95


@dataclass(frozen=True)
class Ground:
    """A test with what follows from it: [n] each, from the mudline down.

    friction_ratio is F_r in percent, index I_c; both are nan where the file has no
    sleeve friction. tip is q_t, normalized Q_tn.
    """

    depth: np.ndarray
    resistance: np.ndarray
    friction: np.ndarray | None
    tip: np.ndarray
    unit_weight: np.ndarray
    total_stress: np.ndarray
    effective_stress: np.ndarray
    normalized: np.ndarray
    friction_ratio: np.ndarray
    index: np.ndarray

    @property
    def net(self) -> np.ndarray:
        """q_t - sigma_v, at least 0."""
        return np.maximum(self.tip - self.total_stress, 0)

    @property
    def stress(self) -> np.ndarray:
        """sigma'_v, at least LEAST_STRESS."""
        return np.maximum(self.effective_stress, LEAST_STRESS)


def unit_weight_of(tip: np.ndarray, friction: np.ndarray) -> np.ndarray:
    """Return the unit weight [n] by Robertson & Cabal (2010)."""
    ratio = 100 * friction / np.maximum(tip, 1.0)
    ratio = np.clip(ratio, *FRICTION_RATIOS)
    relative = np.maximum(tip, 0.01 * ATMOSPHERE) / ATMOSPHERE
    found = WATER * (0.27 * np.log10(ratio) + 0.36 * np.log10(relative) + 1.236)
    return np.clip(found, *WEIGHTS)


def index_of(normalized: np.ndarray, friction_ratio: np.ndarray) -> np.ndarray:
    """Return I_c [n] of Q_tn and F_r (%)."""
    return np.hypot(3.47 - np.log10(normalized), np.log10(friction_ratio) + 1.22)


def normalize(
    net: np.ndarray, stress: np.ndarray, friction_ratio: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return Q_tn and I_c [n]. Where F_r is nan n = 0.5, as in sand, and I_c nan."""
    exponent = np.full(len(net), 0.5)
    while True:
        normalized = net / ATMOSPHERE * (ATMOSPHERE / stress) ** exponent
        normalized = np.maximum(normalized, 1.0)
        index = index_of(normalized, friction_ratio)
        new = np.minimum(0.381 * index + 0.05 * stress / ATMOSPHERE - 0.15, 1.0)
        new = np.where(np.isnan(new), 0.5, new)
        if np.abs(new - exponent).max() < 1e-6:
            return normalized, index
        exponent = (new + exponent) / 2  # converges for all of the chart


def ground_of(test: Test, area_ratio: float, unit_weight: float | None) -> Ground:
    """Return the ground of a test. unit_weight: of all the soil; None takes that of
    Robertson & Cabal, for which the test must have a sleeve friction."""
    tip = test.resistance
    if test.pore_pressure is not None:
        tip = tip + (1 - area_ratio) * test.pore_pressure
    if unit_weight is not None:
        return under(test, tip, np.full(len(tip), unit_weight))
    assert test.friction is not None
    weight = unit_weight_of(tip, test.friction)
    for _ in range(ROUNDS):
        found = under(test, tip, weight)
        is_light_sand = (found.index < SAND_BELOW) & (weight < LEAST_OF_SAND)
        weight = np.where(is_light_sand, LEAST_OF_SAND, weight)
    return under(test, tip, weight)


def under(test: Test, tip: np.ndarray, weight: np.ndarray) -> Ground:
    """Return the ground of a test with q_t and unit weight [n]."""
    depth = test.depth
    means = np.concatenate([weight[:1], (weight[1:] + weight[:-1]) / 2])
    total = np.cumsum(means * np.diff(depth, prepend=0.0))
    effective = total - WATER * depth
    net = np.maximum(tip - total, 1.0)
    if test.friction is None:
        ratio = np.full(len(depth), np.nan)
    else:
        ratio = np.clip(100 * test.friction / net, *FRICTION_RATIOS)
    normalized, index = normalize(net, np.maximum(effective, LEAST_STRESS), ratio)
    return Ground(
        depth,
        test.resistance,
        test.friction,
        tip,
        weight,
        total,
        effective,
        normalized,
        ratio,
        index,
    )


def kind_of(index: float) -> str:
    """Return whether soil of this I_c behaves like sand, like clay or between."""
    if index < SAND_BELOW:
        return SAND
    return CLAY if index > CLAY_ABOVE else SILT


def porosity_of(weight: float, grains: float, is_wet: bool) -> float:
    """Return the porosity of soil with a unit weight (kN/m3), of the wet soil or in
    water, and grains of a density (kg/m3)."""
    in_water = 1e3 * weight - (WATER if is_wet else 0.0)
    return 1 - in_water / (grains * GRAVITY - WATER)
