# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stresses in the ground and the type of soil, over the depth of a cone test.

    q_t = q_c + (1 - a) u_2                          a: net area ratio of the cone
    gamma = gamma_w (0.27 log R_f + 0.36 log(q_t/p_a) + 1.236),     R_f = 100 f_s / q_t
    sigma_v = integral of gamma dz,    sigma'_v = sigma_v - gamma_w z
    Q_tn = (q_t - sigma_v)/p_a (p_a/sigma'_v)^n,     F_r = 100 f_s / (q_t - sigma_v)
    n = 0.381 I_c + 0.05 sigma'_v/p_a - 0.15,        at most 1
    I_c = sqrt((3.47 - log Q_tn)^2 + (log F_r + 1.22)^2)
    I_B = 100 (Q_tn + 10) / (Q_tn F_r + 70)
    B_q = (u_2 - gamma_w z) / (q_t - sigma_v)

with logarithms of base 10, R_f and F_r in percent, and p_a = 100 kPa. The unit weight
is that of Robertson & Cabal (2010, "Estimating soil unit weight from CPT", CPT'10,
Huntington Beach), the index that of Robertson (2009, doi 10.1139/T09-065). I_c and n
depend on each other and are found by iteration. Both formulas have been compared with
two published programs, not with the papers themselves. Under low stress the first one
gives loose sand a weight that no sand has: that of sand (I_c < 2.6) is held at 17.5
kN/m3 and more, a void ratio of 1.1, for which stress and I_c are found again.

The kind of soil is that of I_c, unless the friction or the pore pressure is against it.
I_c takes stiff clay for sand where Q_tn and F_r are both large: clay is also what has
an I_B below 22, clay-like in the chart of Robertson (2016, doi 10.1139/cgj-2016-0044).
In the chart of Q_t and B_q of Robertson (1990, doi 10.1139/t90-014) sand has a B_q of
about 0: the limits of 0.1 for sand, of 0.2 for what does not drain, and of 0.4 for
what does not drain whatever its I_c are assumed. An excess pressure counts from 20 kPa.

The ground is below water: stresses are those above the pressure of the water at the
mudline, and u_2 counts from there.

SI units: m, Pa, N/m3.
"""
from dataclasses import dataclass

import numpy as np

from caisson.design.cone_file import Test
from caisson.units import ATMOSPHERE, GRAVITY, WATER

LEAST_STRESS = 1e3  # of sigma'_v where something is divided by it: some 0.1 m of depth
WEIGHTS = 14e3, 22e3  # between which the formula is held
LEAST_OF_SAND = 17.5e3
ROUNDS = 3  # of weight, stress and kind of soil
FRICTION_RATIOS = 0.1, 10.0  # %, the ends of the chart of soil types
SAND, SILT, CLAY = "sand", "silt", "clay"
# I_c below which soil is sand-like, and above which it is clay-like (Robertson 2009)
SAND_BELOW, CLAY_ABOVE = 2.60, 2.95
CLAY_LIKE = 22.0  # I_B, below which soil is clay-like (Robertson 2016)
DRAINED, UNDRAINED = 0.1, 0.2  # B_q, below and above which soil drains or does not
CLEARLY_UNDRAINED = 0.4
LEAST_EXCESS = 20e3  # Pa
CONE_FACTOR = 14.0  # N_kt


@dataclass(frozen=True, kw_only=True)
class Ground(Test):
    """A test with what follows from it: [n] each, from the mudline down.

    friction_ratio is F_r in percent, index I_c; both are nan where the file has no
    sleeve friction. tip is q_t, normalized Q_tn.
    """

    tip: np.ndarray
    unit_weight: np.ndarray
    total_stress: np.ndarray
    effective_stress: np.ndarray
    normalized: np.ndarray
    friction_ratio: np.ndarray
    index: np.ndarray
    cone_factor: float = CONE_FACTOR

    @property
    def behavior(self) -> np.ndarray:
        """I_B."""
        return behavior_of(self.normalized, self.friction_ratio)

    @property
    def excess(self) -> np.ndarray:
        """u_2 above that of water at rest (Pa), 0 where there is none."""
        if self.pore_pressure is None:
            return np.zeros(len(self.depth))
        return self.pore_pressure - WATER * self.depth

    @property
    def pressure_ratio(self) -> np.ndarray:
        """B_q, 0 where the excess pressure does not count."""
        counts = np.abs(self.excess) >= LEAST_EXCESS
        return np.where(counts, self.excess / np.maximum(self.net, 1.0), 0.0)

    @property
    def kinds(self) -> np.ndarray:
        """The kind of soil of each row."""
        return kinds_of(self.index, self.behavior, self.pressure_ratio)

    def median(self, values: np.ndarray, rows: np.ndarray) -> float:
        """Return the median of values [n] over rows [n]."""
        return float(np.median(values[rows]))

    def kind(self, rows: np.ndarray) -> str:
        """Return the kind of soil of rows [n] together, by their medians."""
        every = self.index, self.behavior, self.pressure_ratio
        return str(kinds_of(*(np.array(self.median(x, rows)) for x in every)))

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


def behavior_of(normalized: np.ndarray, friction_ratio: np.ndarray) -> np.ndarray:
    """Return I_B [n] of Q_tn and F_r (%)."""
    return 100 * (normalized + 10) / (normalized * friction_ratio + 70)


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
    if test.pore_pressure is not None and not test.is_corrected:
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
        **vars(test),
        tip=tip,
        unit_weight=weight,
        total_stress=total,
        effective_stress=effective,
        normalized=normalized,
        friction_ratio=ratio,
        index=index,
    )


def kind_of(index: float) -> str:
    """Return whether soil of this I_c behaves like sand, like clay or between."""
    return str(kinds_of(np.array(index), np.array(np.inf), np.array(0.0)))


def kinds_of(
    index: np.ndarray, behavior: np.ndarray, pressure: np.ndarray
) -> np.ndarray:
    """Return the kinds of soil [n] of I_c, I_B and B_q; nan says nothing."""
    is_fine = index >= SAND_BELOW
    is_clay = (index > CLAY_ABOVE) | (behavior < CLAY_LIKE)
    is_clay |= is_fine & (pressure >= UNDRAINED) | (pressure >= CLEARLY_UNDRAINED)
    return np.select([is_clay, is_fine | (pressure >= DRAINED)], [CLAY, SILT], SAND)


def porosity_of(weight: float, grains: float, is_wet: bool) -> float:
    """Return the porosity of soil with a unit weight (kN/m3), of the wet soil or in
    water, and grains of a density (kg/m3)."""
    in_water = 1e3 * weight - (WATER if is_wet else 0.0)
    return 1 - in_water / (grains * GRAVITY - WATER)
