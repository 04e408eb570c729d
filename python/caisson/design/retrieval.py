# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far water may be pumped beneath the lid to push a caisson out of the ground.

The overpressure p acts on the area inside, A_i. It presses the plug down as much as it
lifts the caisson, so that nothing holds the plug but the ground:

- Clay: the plug is pushed out below the tip at p = N_c s_u + F_i / A_i, the terms of
  reverse bearing (plug_stability) without a weight, as the soil inside and outside is
  equally high.
- Clay: the ground cracks where the water bears more than its least stress at rest and
  its strength beside the tip, at p = min(K0, 1) sigma'_v + s_u (custom). The water is
  taken to reach the tip along the wall.
- Sand along all of the wall: water flows down in the plug and up outside, where it
  bears the weight of the sand at p = gamma' h / a, on average over the wall, with the
  share a of the overpressure that is left at the tip (Houlsby & Byrne 2005,
  seepage.pressure_factor).
- The wall yields in rings at p = f_y t / (1.15 r), 1.15 as in DNV-RP-C202.

The lid itself is not known here. SI units; h is the embedment of the tip (m).
"""
from collections.abc import Sequence
from math import nan

import numpy as np

from caisson.design.clay import Layer, strength_at, tip_layer
from caisson.design.cone import Skirt
from caisson.design.method import vertical_stress
from caisson.design.plug_stability import reverse_bearing
from caisson.design.sealing import grout_pressure
from caisson.design.seepage import houlsby_byrne, pressure_factor
from caisson.design.shell import Wall

PLUG, FRACTURE = "plug pushed out", "ground cracks beside the tip"
OUTWARD, HOOP = "piping outside", "wall yields in rings"
MATERIAL_FACTOR = 1.15


def has_clay(layers: Sequence[Layer], h: float) -> bool:
    """Return whether there is clay along the wall."""
    return any(layer.strength for layer in layers[: tip_layer(layers, h) + 1])


def fracture(layers: Sequence[Layer], ratios: Sequence[float], h: float) -> float:
    """Return the overpressure (Pa) that cracks the ground beside the tip; nan without
    clay along the wall. ratios: K0 of the layers."""
    if not has_clay(layers, h):
        return nan
    least = min(ratios[tip_layer(layers, h)], 1.0) * vertical_stress(layers, h)
    return least + strength_at(layers, h)


def outward(
    skirt: Skirt, layers: Sequence[Layer], h: float, permeability_ratio: float = 1.0
) -> float:
    """Return the overpressure (Pa) under which sand outside loses its weight; nan where
    there is clay along the wall. permeability_ratio: of the plug to the sand outside.
    """
    if h <= 0 or has_clay(layers, h):
        return nan
    weight, diameter = vertical_stress(layers, h) / h, skirt.outer_diameter
    inside = houlsby_byrne(weight, h, diameter, permeability_ratio)
    return grout_pressure(inside, pressure_factor(h / diameter, permeability_ratio))


def hoop(wall: Wall) -> float:
    """Return the overpressure (Pa) at which the wall yields where it is thinnest."""
    wall = wall.at(0.0)
    return wall.yield_strength * wall.thickness / wall.radius / MATERIAL_FACTOR


def allowable(
    skirt: Skirt,
    layers: Sequence[Layer],
    ratios: Sequence[float],
    wall: Wall,
    depth: np.ndarray,
    permeability_ratio: float = 1.0,
) -> dict[str, np.ndarray]:
    """Return the overpressures (Pa) at which something gives way, [n] at embedments
    depth [n] (m), nan where a mechanism is none; only those that there are. layers:
    from the mudline down; ratios: their K0; permeability_ratio: of the plug to the sand
    outside."""
    rows = [
        {
            PLUG: reverse_bearing(skirt, layers, h),
            FRACTURE: fracture(layers, ratios, h),
            OUTWARD: outward(skirt, layers, h, permeability_ratio),
            HOOP: hoop(wall),
        }
        for h in map(float, depth)
    ]
    found = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    return {name: x for name, x in found.items() if np.isfinite(x).any()}
