# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is assumed of undrained clay from its strength s_u.

Youngs modulus is that of `caisson cpt`, a multiple of s_u, and the walls have half of
s_u, as clay of sensitivity 2 that the wall has remoulded. The rest follows from s_u
and the vertical effective stress sigma'_v in the middle of the layer, as far as the
skirt reaches into it:

    OCR = (s_u/sigma'_v / 0.22)^(1/0.8), at least 1
        Ladd (1991), J. Geotech. Eng. 117
    K0 = (1 - sin phi') OCR^(sin phi'), phi' = 24 degrees, at most 1.5
        Mayne & Kulhawy (1982), J. Geotech. Eng. Div. 108
    gamma of Robertson & Cabal (2010) for q_t = sigma_v + 14 s_u and a sleeve friction
        of s_u/2, the adhesion; at least 15 kN/m3

so that soft clay has 5 to 7 kN/m3 in water and a K0 of about 0.6, and stiff clay more.
SI units.
"""
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from caisson import density_law as names
from caisson.units import GRAVITY, QUARTZ_DENSITY, WATER
from caisson.suggest.entry import ASSUMPTION, Entry, Layer, number_in
from caisson.design.correlations import CLAY_POISSON, CLAY_RATIOS
from caisson.design.correlations import RESTS_OF_CLAY
from caisson.design.expression import value_at
from caisson.design import ground

POISSON = f"{CLAY_POISSON:g}"
ADHESION_FACTOR = "0.5"
MODULUS_REMARK = f"{ASSUMPTION}: {CLAY_RATIOS[1]:g} s_u (Duncan & Buchignani 1976)"
NORMAL_RATIO, EXPONENT = 0.22, 0.8  # s_u/sigma'_v at OCR 1, and of OCR
SINE = math.sin(math.radians(24))
LIGHTEST = 15e3  # N/m3, of the wet clay
MOBILIZED = 0.95  # of the strength, at most, by K0
USUAL_WEIGHT = 9.7e3  # N/m3 in water, of a layer above whose weight is no number
RATIO = "Overconsolidation ratio"
STATES = ("Porosity", "Void ratio", names.DENSITY, "Dry density")
ROUNDS = 5
DEPTHS = 40  # of a layer, at which K0 is held against the strength


def is_undrained(layer: Layer) -> bool:
    """Return whether a layer has an undrained strength as its cohesion."""
    return bool(layer.value("Cohesion")) and layer.value("Friction angle") == "0"


def modulus_of(strength: str) -> Entry:
    """Return Youngs modulus for a strength (Pa)."""
    ratio, number = CLAY_RATIOS[1], number_in(strength)
    value = f"{ratio:g}*({strength})" if number is None else f"{ratio * number:.10g}"
    return Entry("Youngs modulus", value, MODULUS_REMARK)


def number_of(layer: Layer, name: str, depth: float) -> float | None:
    """Return an entry at a depth, None where it is not known."""
    text = layer.value(name)
    return value_at(text, depth, USUAL_WEIGHT * depth) if text else None


def weight_of(layer: Layer, depth: float) -> float:
    """Return the unit weight in water (N/m3) at a depth."""
    grains = number_of(layer, "Solid density", depth) or QUARTZ_DENSITY
    porosity = number_of(layer, "Porosity", depth)
    void_ratio = number_of(layer, "Void ratio", depth)
    density = number_of(layer, names.DENSITY, depth)
    densest = number_of(layer, names.DENSEST, depth)
    loosest = number_of(layer, names.LOOSEST, depth)
    if density is not None and densest is not None and loosest is not None:
        void_ratio = loosest - density * (loosest - densest)
    if void_ratio is not None:
        porosity = void_ratio / (1 + void_ratio)
    if porosity is None:
        return USUAL_WEIGHT
    return (1 - porosity) * (grains * GRAVITY - WATER)


@dataclass(frozen=True)
class Reach:
    """Where a layer counts: depths of its top, of the middle of what the skirt reaches,
    and of its bottom (m); above: sigma'_v at its top (Pa)."""

    top: float
    middle: float
    bottom: float
    above: float

    def stress(self, depth: float, weight: float) -> float:
        """Return sigma'_v (Pa) for a unit weight in water (N/m3)."""
        return self.above + (depth - self.top) * weight


def strength_of(layer: Layer, depth: float, stress: float) -> float:
    """Return s_u (Pa); 0 where the form of an expression is not known."""
    return value_at(layer.value("Cohesion"), depth, stress) or 0.0


def unit_weight_of_clay(layer: Layer, reach: Reach) -> tuple[float, list[Entry]]:
    """Return the unit weight in water (N/m3), and the porosity if it is not given."""
    weight = weight_of(layer, reach.middle)
    if any(map(layer.value, STATES)):
        return weight, []
    for _ in range(ROUNDS):
        stress = reach.stress(reach.middle, weight)
        strength = strength_of(layer, reach.middle, stress)
        tip = ground.CONE_FACTOR * strength + stress + WATER * reach.middle
        sleeve = np.array([float(ADHESION_FACTOR) * strength])
        wet = ground.unit_weight_of(np.array([tip]), sleeve)
        weight = max(float(wet[0]), LIGHTEST) - WATER
    grains = number_of(layer, "Solid density", reach.middle) or QUARTZ_DENSITY
    porosity = ground.porosity_of(weight / 1e3, grains, False)
    why = f"{weight / 1e3:.2g} kN/m3 in water by s_u (Robertson & Cabal 2010)"
    return weight, [Entry("Porosity", f"{porosity:.3f}", f"{ASSUMPTION}: {why}")]


def held(k0: float, strength: str, points: Iterable[tuple[float, float]]) -> str:
    """Return K0 as an entry, within what a strength (Pa) bears. points: depths (m) and
    vertical effective stresses (Pa) of the layer."""
    bound = f"{2 * MOBILIZED:g}*({strength})/s"
    for depth, stress in points:
        bearable = 2 * MOBILIZED * (value_at(strength, depth, stress) or 0.0)
        if abs(1 - k0) * stress > bearable:
            if k0 < 1:
                return f"max({k0:.2g}, 1 - {bound})"
            return f"min({k0:.2g}, 1 + {bound})"
    return f"{k0:.2g}"


def at_rest(layer: Layer, reach: Reach, weight: float, weakest: float) -> Entry:
    """Return K0, within what the strength bears in all of the layer, times the factor
    of the weakest soil of a study."""
    stress = reach.stress(reach.middle, weight)
    ratio = strength_of(layer, reach.middle, stress) / max(stress, 1.0)
    given = number_of(layer, RATIO, reach.middle)
    ocr = given or max(ratio / NORMAL_RATIO, 1.0) ** (1 / EXPONENT)
    k0 = float(np.clip((1 - SINE) * ocr**SINE, *RESTS_OF_CLAY))
    by = "" if given else f" by s_u/sigma'_v = {ratio:.2g} (Ladd 1991)"
    why = f"OCR {ocr:.2g}{by}, Mayne & Kulhawy (1982)"
    depths = np.linspace(reach.top, reach.bottom, DEPTHS)
    points = ((depth, reach.stress(depth, weight)) for depth in map(float, depths))
    strength = layer.value("Cohesion")
    if weakest < 1:
        strength = f"{weakest:g}*({strength})"
    return Entry("K0", held(k0, strength, points), f"{ASSUMPTION}: {why}")


def with_states(
    layers: Sequence[Layer], end: float, floor: float, weakest: float = 1.0
) -> list[Layer]:
    """Return the layers, where undrained clay has porosity and K0. end: of the skirt,
    floor: of the mesh (m); weakest: the least factor of the strength in a study."""
    found, above = list[Layer](), 0.0
    bottoms = [layer.top for layer in layers[1:]] + [max(floor, layers[-1].top)]
    for layer, bottom in zip(layers, bottoms):
        deepest = min(bottom, end) if layer.top < end else bottom
        reach = Reach(layer.top, (layer.top + deepest) / 2, bottom, above)
        weight = weight_of(layer, reach.middle)
        if is_undrained(layer):
            weight, added = unit_weight_of_clay(layer, reach)
            entries = list(layer.entries)
            if not layer.value("K0"):
                entries = [entry for entry in entries if entry.name != RATIO]
                added.append(at_rest(layer, reach, weight, weakest))
            layer = Layer(layer.top, [*entries, *added], layer.warning)
        found.append(layer)
        above = reach.stress(bottom, weight)
    return found
