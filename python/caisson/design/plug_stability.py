# SPDX-License-Identifier: LGPL-2.1-or-later
"""The suction that a plug of clay bears: how far suction may go in ground with clay.

Undrained clay fails as a whole where the soil below the tip flows into the caisson,
the reverse of bearing capacity, with the adhesion of the inner wall against it. What
fails need not begin at the tip: the plug and a block of the clay below it, with the
diameter of the inside, rise together, and the clay at the depth z below the block flows
in. So the suction is the least one of all depths z from the tip down,

    s = (F_i + pi D_i int_h^z s_u dz) / A_i + N_c s_u(z),
    N_c = 6 (1 + 0.2 d / D_o), at most 9.

With z = h these are the terms of DNV-RP-E303 and API RP 2SK; N_c is that of a circle
(Skempton 1951, as in clay), and 6.2 to 9 elsewhere. The side of the block is that of
Brown and Meyerhof (1969) for a footing that punches through a stiff layer into a soft
one. Where the least z is below the tip, the soft layer below governs. The clay outside,
which has to sink, is left out, on the safe side.

The depth d of N_c is that of z. If the strength grows by a step above z, however, clay
above the step counts with its share of the strength at z: soft clay does not hold down
the stiff clay below it.

Sand below the clay keeps the pressure of the open water, which lifts what is above it:
the soil down to the bottom z_b of the clay, with all of its submerged weight, against
the adhesion and, where the tip has not yet reached the sand, the strength of the clay
between tip and sand on a cylinder with the diameter of the inside:

    s = sum of gamma' dz + (F_i + pi D_i sum of s_u dz from h to z_b) / A_i.

F_i = pi D_i sum of a_i dz is the adhesion of clay alone. The friction of sand on the
inner wall is left out, on the safe side; so is the loss of pressure in sand below the
clay of the plug. No safety factor is in any of this.

J.D. Brown, G.G. Meyerhof (1969), Experimental study of bearing capacity in layered
clays. Proc. 7th ICSMFE, Mexico, 2, 45-51.

SI units; h is the embedment of the tip (m), s is above the pressure of the open water.
"""
from collections.abc import Sequence
from math import nan
from operator import itemgetter

import numpy as np

from caisson.design.clay import ALIKE, Layer, strength_at, tip_layer
from caisson.design.cone import Skirt
from caisson.design.method import between, vertical_stress

REVERSE_BEARING = "reverse bearing of the plug"
LIFT = "clay plug lifted by water below"


def bearing_factor(h: float, diameter: float) -> float:
    """Return N_c of a circle at a depth."""
    return min(6 * (1 + 0.2 * h / diameter), 9.0)


def adhesion(skirt: Skirt, layers: Sequence[Layer], h: float) -> float:
    """Return that of the inner wall over the area inside (Pa)."""
    stresses = [layer.inner_adhesion for layer in layers]
    return 4 / skirt.inner_diameter * float(stresses @ between(layers, 0.0, h))


def depth_in_clay(layers: Sequence[Layer], z: float, strength: float) -> float:
    """Return the depth d (m) for N_c at z, where the strength (Pa) is this one; above a
    step, clay counts with its share of it."""
    found, share, below, bottom = 0.0, 1.0, strength, z
    for layer in layers[tip_layer(layers, z) :: -1]:
        if layer.strength:
            if share < 1 or layer.strength < below - ALIKE * strength:
                share = min(share, layer.strength / strength)
            below = layer.strength
        found += share * (bottom - layer.top)
        bottom = layer.top
    return found


def softer_below(layers: Sequence[Layer], h: float, strength: float) -> list[Layer]:
    """Return the layers of clay that begin at or below a tip and above sand, each of
    which is softer than all clay above it from the tip down. strength: at the tip (Pa).
    """
    found = list[Layer]()
    for layer in layers[tip_layer(layers, h) + 1 :]:
        if not layer.strength:
            break
        if layer.strength < strength:
            strength = layer.strength
            found.append(layer)
    return found


def failure(skirt: Skirt, layers: Sequence[Layer], h: float) -> tuple[float, float]:
    """Return the suction of reverse bearing (Pa), nan where the tip is in sand, and the
    top of the layer below that governs it (m), nan where the clay at the tip does."""
    at_tip = strength_at(layers, h)
    if not at_tip:
        return nan, nan
    strengths = np.array([layer.strength for layer in layers])
    found = list[tuple[float, float]]()
    softer = [(x.top, x.top, x.strength) for x in softer_below(layers, h, at_tip)]
    for z, top, s_u in [(h, nan, at_tip), *softer]:
        side = 4 / skirt.inner_diameter * float(strengths @ between(layers, h, z))
        n_c = bearing_factor(depth_in_clay(layers, z, s_u), skirt.outer_diameter)
        found.append((side + n_c * s_u, top))
    least, top = min(found, key=itemgetter(0))
    return least + adhesion(skirt, layers, h), top


def reverse_bearing(skirt: Skirt, layers: Sequence[Layer], h: float) -> float:
    """Return the suction at which the plug fails; nan where the tip is in sand."""
    return failure(skirt, layers, h)[0]


def soft_below(skirt: Skirt, layers: Sequence[Layer], depth: np.ndarray) -> np.ndarray:
    """Return the top of the layer below the tip that governs reverse bearing (m), [n]
    at embedments depth [n] (m); nan where the clay at the tip does."""
    return np.array([failure(skirt, layers, float(h))[1] for h in depth])


def uncovered(skirt: Skirt, layers: Sequence[Layer], depth: np.ndarray) -> list[float]:
    """Return the tops (m) of the clay within a diameter below a tip in sand, at any of
    embedments depth [n] (m): no limit covers its reverse bearing."""
    sand = [h for h in depth if not layers[tip_layer(layers, float(h))].strength]
    return [
        layer.top
        for above, layer in zip(layers, layers[1:])
        if layer.strength
        and not above.strength
        and any(h <= layer.top < h + skirt.outer_diameter for h in sand)
    ]


def bottom_of_clay(layers: Sequence[Layer], h: float) -> float:
    """Return the top of the sand below the clay in which the tip is or, with the tip in
    sand, below the clay that it has passed; nan without such sand or clay."""
    is_sand, tip = [not layer.strength for layer in layers], tip_layer(layers, h)
    if not is_sand[tip]:
        return min(
            (x.top for x, s in zip(layers[tip:], is_sand[tip:]) if s), default=nan
        )
    last = max([i for i in range(tip) if not is_sand[i]], default=-1)
    return layers[last + 1].top if last >= 0 else nan


def lift(skirt: Skirt, layers: Sequence[Layer], h: float) -> float:
    """Return the suction that lifts the clay off the sand below; nan where there is
    none."""
    bottom = bottom_of_clay(layers, h)
    if np.isnan(bottom):
        return nan
    strengths = [layer.strength for layer in layers]
    below = 4 / skirt.inner_diameter * float(strengths @ between(layers, h, bottom))
    weight = vertical_stress(layers, bottom)
    return weight + adhesion(skirt, layers, min(h, bottom)) + below


def allowable(
    skirt: Skirt, layers: Sequence[Layer], depth: np.ndarray
) -> dict[str, np.ndarray]:
    """Return the suctions (Pa) at which the plug gives way, [n] at embedments depth [n]
    (m), nan where a mechanism is none; only those that there are. layers: from the
    mudline down."""
    found = {
        name: np.array([of(skirt, layers, float(h)) for h in depth])
        for name, of in ((REVERSE_BEARING, reverse_bearing), (LIFT, lift))
    }
    return {name: values for name, values in found.items() if np.isfinite(values).any()}
