# SPDX-License-Identifier: LGPL-2.1-or-later
"""Low, best and high estimates of the parameters of each layer.

The best estimate is the median of a correlation over the rows of a layer. Low and high
are about one standard deviation away: the quantiles of 16 and 84 % of the rows, and the
scatter of the correlation, as the root of the sum of their squares. They are estimates
of the mean of a layer from one test, not characteristic values of a code.

SI units; relative density is a share of 1, angles are in degrees.
"""
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import hypot, inf

import numpy as np

from caisson.design import correlations
from caisson.design.cone_layers import Layer
from caisson.design.correlations import (
    RESTS_OF_CLAY,
    ANGLE,
    BEST,
    DENSITY,
    HIGH,
    LOW,
    MODULUS,
    STRENGTH,
)
from caisson.design.ground import CLAY, SAND, SILT, Ground
from caisson.nature import GRAVITY, QUARTZ_DENSITY, WATER

ENDS = {"low": LOW, "best": BEST, "high": HIGH}
QUANTILES = 0.16, 0.84
RESISTANCE, INDEX, WEIGHT, K0 = "resistance", "index", "unit weight", "K0"
REFERENCE = "modulus at 100 kPa"
# E / s_u of clay, for the low, the best and the high estimate. Duncan & Buchignani
# (1976) have about 300 for a plasticity of 30 to 50 % and an OCR below 3, and less for
# more of either; quoted from memory, not checked against the report
CLAY_RATIOS = (150.0, 300.0, 600.0)
Limits = tuple[float, float]
ANY: Limits = (0.0, inf)
LIMITS: dict[str, Limits] = {DENSITY: (0.0, 1.0), ANGLE: correlations.ANGLES}
# what a kind of soil has
HAS = {
    SAND: (DENSITY, ANGLE, MODULUS, REFERENCE, K0),
    SILT: (ANGLE, MODULUS, STRENGTH, K0),
    CLAY: (MODULUS, STRENGTH, K0),
}
CAN = {
    SAND: "drained, or with seepage under suction",
    SILT: "drains in part: --soil takes it as sand, drained, or as clay, undrained",
    CLAY: "undrained: s_u as cohesion, no friction angle",
}


@dataclass(frozen=True)
class Estimate:
    """Low, best and high."""

    low: float
    best: float
    high: float

    def at(self, end: str) -> float:
        """Return one of low, best, high."""
        return float(getattr(self, end))


@dataclass(frozen=True)
class Estimates:
    """A layer with the estimates of its parameters by name."""

    layer: Layer
    values: Mapping[str, Estimate]

    def porosity(self) -> float:
        """Return the porosity at which water and quartz have the unit weight."""
        solid, weight = QUARTZ_DENSITY * GRAVITY, self.values[WEIGHT].best
        return (solid - weight) / (solid - WATER)


def combined(
    rows: np.ndarray, low: np.ndarray, high: np.ndarray, limits: Limits
) -> Estimate:
    """Return the estimate of values [n] whose ends of scatter are low and high [n],
    within limits."""
    best = float(np.median(rows))
    below, above = np.quantile(rows, QUANTILES)
    return Estimate(
        max(best - hypot(best - below, best - float(np.median(low))), limits[0]),
        best,
        min(best + hypot(above - best, float(np.median(high)) - best), limits[1]),
    )


def clay_moduli(ground: Ground, names: dict[str, str], end: int) -> np.ndarray:
    """Return E (Pa) [n] of clay and silt as a multiple of the best strength."""
    strength = correlations.strengths_of(ground, names, BEST)
    return CLAY_RATIOS[end + 1] * strength


def growth_of(ground: Ground, names: dict[str, str]) -> np.ndarray:
    """Return the stiffness of sand at rest [n] over that at a mean effective stress of
    100 kPa, if it grows with the square root of the stress."""
    k0 = correlations.at_rest(correlations.angles_of(ground, names, BEST))
    return np.sqrt(correlations.mean_stress(ground, k0) / correlations.ATMOSPHERE)


def reference_moduli(ground: Ground, names: dict[str, str], end: int) -> np.ndarray:
    """Return E (Pa) [n] of sand at a mean effective stress of 100 kPa."""
    return correlations.moduli_of(ground, names, end) / growth_of(ground, names)


# ground, names of correlations and an end to the values of a quantity [n]; K_0 of sand
# is high where the friction angle is low
OF_SAND: dict[str, Callable[[Ground, dict[str, str], int], np.ndarray]] = {
    DENSITY: correlations.densities_of,
    ANGLE: correlations.angles_of,
    MODULUS: correlations.moduli_of,
    REFERENCE: reference_moduli,
    STRENGTH: correlations.strengths_of,
    K0: lambda g, n, end: correlations.at_rest(correlations.angles_of(g, n, -end)),
}
OF_CLAY = OF_SAND | {
    MODULUS: clay_moduli,
    K0: lambda g, _, __: np.clip(0.1 * g.net / g.stress, *RESTS_OF_CLAY),
}


def estimates_of(
    ground: Ground, layers: Sequence[Layer], names: dict[str, str]
) -> list[Estimates]:
    """Return the estimates of each layer. names: the correlation of each quantity."""
    measured = {RESISTANCE: ground.resistance, WEIGHT: ground.unit_weight}
    if not np.isnan(ground.index).all():
        measured[INDEX] = ground.index
    found = []
    for layer in layers:
        rows, values = layer.rows, {}
        for name, column in measured.items():
            values[name] = combined(column[rows], column[rows], column[rows], ANY)
        functions = OF_CLAY if layer.kind == CLAY else OF_SAND
        for name in HAS[layer.kind]:
            low, best, high = [
                functions[name](ground, names, end)[rows] for end in ENDS.values()
            ]
            limits = LIMITS.get(name, ANY)
            values[name] = combined(best, low, high, limits)
        found.append(Estimates(layer, values))
    return found
