# SPDX-License-Identifier: LGPL-2.1-or-later
"""Low, best and high estimates of the parameters of each layer.

The best estimate is the median of a correlation over the rows of a layer. Low and high
are about one standard deviation away: the quantiles of 16 and 84 % of the rows, and the
scatter of the correlation, as the root of the sum of their squares. They are estimates
of the mean of a layer from one test, not characteristic values of a code.

The strength of clay is a straight line over the depth where the rows of a layer are
nearer to one than to one value; then low, best and high are lines, too, and the
quantiles are those of the rows as shares of the line. The line has the least sum of
differences as shares of it, found by weighted least squares.

For the density of sand that answers its cone test (caisson.design.own_cone), and its
modulus, rows count where a cone is deep and a skirt feels them; others only where there
are none of these.

SI units; relative density is a share of 1, angles are in degrees.
"""
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import hypot, inf

import numpy as np

from caisson.design import correlations, own_cone
from caisson.design.cone_layers import Layer
from caisson.design.correlations import ANGLE, BEST, CLAY_RATIOS, DENSITY, HIGH, LOW
from caisson.design.correlations import MODULUS, RESTS_OF_CLAY, STRENGTH
from caisson.design.ground import CLAY, SAND, SILT, Ground
from caisson.units import GRAVITY, QUARTZ_DENSITY, WATER

ENDS = {"low": LOW, "best": BEST, "high": HIGH}
QUANTILES = 0.16, 0.84
RESISTANCE, INDEX, WEIGHT, K0 = "resistance", "index", "unit weight", "K0"
REFERENCE = "modulus at 100 kPa"
Limits = tuple[float, float]
ANY: Limits = (0.0, inf)
LIMITS: dict[str, Limits] = {DENSITY: (0.0, 1.0), ANGLE: correlations.ANGLES}
THINNEST_LINE, FEWEST_ROWS = 1.0, 10  # m, and rows of a layer with a line
LEAST_GROWTH, LEAST_GAIN = 0.15, 0.9  # of the middle; of the difference without a line
LEAST_SHARE, NEAREST, TINY = 0.05, 1e-3, 1e-3  # of the middle; of a row; Pa
ROUNDS_OF_LINE = 20
# what a kind of soil has
HAS = {
    SAND: (DENSITY, ANGLE, REFERENCE, K0),
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
    """Low, best and high: of a layer or, with a growth, at its top; with each meter
    below it they grow by this share of themselves (1/m)."""

    low: float
    best: float
    high: float
    growth: float = 0.0

    def at(self, end: str) -> float:
        """Return one of low, best, high."""
        return float(getattr(self, end))

    def line(self, end: str, top: float) -> tuple[float, float]:
        """Return one of them as a line over the depth below the mudline: its value
        there and what is added with each m. top: of the layer (m)."""
        value = self.at(end)
        return value * (1 - self.growth * top), value * self.growth


@dataclass(frozen=True)
class Estimates:
    """A layer with the estimates of its parameters by name, and the rows [n] that count
    for the density of sand."""

    layer: Layer
    values: Mapping[str, Estimate]
    rows: np.ndarray

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


def line_of(depth: np.ndarray, values: np.ndarray) -> tuple[float, float]:
    """Return the value at depth 0 and the gradient of the line through values [n]."""
    line = np.full(len(depth), max(float(np.median(values)), TINY))
    gradient = value = 0.0
    for _ in range(ROUNDS_OF_LINE):
        floor = np.maximum(line, LEAST_SHARE * float(np.median(line)) + TINY)
        far = np.maximum(np.abs(values - line) / floor, NEAREST)
        weight = 1 / np.sqrt(far) / floor
        gradient, value = np.polyfit(depth, values, 1, w=weight)
        line = value + gradient * depth
    return float(value), float(gradient)


def growth_in(ground: Ground, layer: Layer, values: np.ndarray) -> float:
    """Return the growth of values [n] with depth, as a share of that at the top of a
    layer for each m; 0 where one value says as much as a line."""
    depth, values = ground.depth[layer.rows], values[layer.rows]
    thick = layer.bottom - layer.top
    if layer.is_seam or thick < THINNEST_LINE or len(depth) < FEWEST_ROWS:
        return 0.0
    value, gradient = line_of(depth, values)
    middle = value + gradient * (layer.top + layer.bottom) / 2
    if middle <= 0 or abs(gradient) * thick < LEAST_GROWTH * middle:
        return 0.0
    line = np.maximum(value + gradient * depth, TINY)
    far = [float(np.median(np.abs(values - x) / line)) for x in (line, middle)]
    is_last = layer.bottom >= ground.depth[-1]
    if far[0] > LEAST_GAIN * far[1] or gradient < 0 and is_last:
        return 0.0  # and no strength that falls below the test
    # of a line that would begin or end below 0, or nearly so, a part is taken
    most = (1 - LEAST_SHARE) * middle / (thick / 2)
    gradient = min(max(gradient, -most), most)
    return gradient / (middle - gradient * thick / 2)


# ground, names of correlations and an end to the values of a quantity [n]; K_0 of sand
# is high where the friction angle is low, and E of clay and silt is a multiple of the
# best strength
OF_SAND: dict[str, Callable[[Ground, dict[str, str], int], np.ndarray]] = {
    DENSITY: correlations.densities_of,
    ANGLE: correlations.angles_of,
    MODULUS: lambda g, n, end: CLAY_RATIOS[end + 1]
    * correlations.strengths_of(g, n, BEST),
    REFERENCE: correlations.reference_moduli,
    STRENGTH: correlations.strengths_of,
    K0: lambda g, n, end: correlations.at_rest(correlations.angles_of(g, n, -end)),
}
OF_CLAY = OF_SAND | {
    K0: lambda g, _, __: np.clip(0.1 * g.net / g.stress, *RESTS_OF_CLAY),
}
FUNCTIONS = {SAND: OF_SAND, SILT: OF_SAND, CLAY: OF_CLAY}
OF_STRENGTH = (STRENGTH, MODULUS)  # grow together
OF_CONE = (DENSITY, REFERENCE)  # answer the cone together


def rows_of(
    ground: Ground, layer: Layer, names: dict[str, str], deepest: float
) -> np.ndarray:
    """Return which rows [n] of a layer count for the density of sand: those down to the
    deepest (m), where a cone is deep, if it answers the cone."""
    if names[DENSITY] != correlations.OWN_CONE:
        return layer.rows
    deep = layer.rows & own_cone.is_deep(ground.depth)
    near = deep & (ground.depth <= deepest)
    return next((rows for rows in (near, deep) if rows.any()), layer.rows)


def estimates_of(
    ground: Ground,
    layers: Sequence[Layer],
    names: dict[str, str],
    deepest: float = inf,
) -> list[Estimates]:
    """Return the estimates of each layer. names: the correlation of each quantity;
    deepest: the depth (m) down to which the density of sand is to be right."""
    measured = {RESISTANCE: ground.resistance, WEIGHT: ground.unit_weight}
    if not np.isnan(ground.index).all():
        measured[INDEX] = ground.index
    every = {
        (kind, name): [
            FUNCTIONS[kind][name](ground, names, end) for end in ENDS.values()
        ]
        for kind in {layer.kind for layer in layers}
        for name in HAS[kind]
    }
    found = []
    for layer in layers:
        values, of_density = {}, rows_of(ground, layer, names, deepest)
        for name, column in measured.items():
            column = column[layer.rows]
            values[name] = combined(column, column, column, ANY)
        strength = correlations.strengths_of(ground, names, BEST)
        slope = growth_in(ground, layer, strength) if layer.kind == CLAY else 0.0
        for name in HAS[layer.kind]:
            growth = slope if name in OF_STRENGTH else 0.0
            rows = of_density if name in OF_CONE else layer.rows
            share = 1 + growth * (ground.depth[rows] - layer.top)  # of that at the top
            low, best, high = [x[rows] / share for x in every[layer.kind, name]]
            found_here = combined(best, low, high, LIMITS.get(name, ANY))
            values[name] = replace(found_here, growth=growth)
        found.append(Estimates(layer, values, of_density))
    return found


def is_answered(ground: Ground, e: Estimates, names: dict[str, str]) -> bool:
    """Return whether the density of a layer of sand answers rows of its cone."""
    is_own = e.layer.kind == SAND and names[DENSITY] == correlations.OWN_CONE
    return is_own and bool(own_cone.is_deep(ground.depth[e.rows]).any())


def answer_of(ground: Ground, e: Estimates) -> float:
    """Return the resistance that a computed cone meets in a layer of sand over the
    measured one, in the middle of the rows that count."""
    density, modulus = (e.values[name].best for name in OF_CONE)
    ratio = modulus / correlations.reference_modulus(density)
    found = own_cone.computed(density, mean_stress_of(ground, e), ratio)
    return float(np.median(found / ground.resistance[e.rows]))


def mean_stress_of(ground: Ground, e: Estimates) -> np.ndarray:
    """Return the mean effective stress (Pa) at the rows that count [n]."""
    k0 = np.full(len(ground.depth), e.values[K0].best)
    return correlations.mean_stress(ground, k0)[e.rows]
