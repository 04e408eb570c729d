# SPDX-License-Identifier: LGPL-2.1-or-later
"""The suction that a plug of clay bears: how far suction may go in ground with clay.

Undrained clay fails as a whole where the soil below the tip flows into the caisson,
the reverse of bearing capacity, with the adhesion of the inner wall against it:

    s = N_c s_u(h) + F_i / A_i,        N_c = 6 (1 + 0.2 h / D_o), at most 9,

with the strength at the tip. DNV-RP-E303 and API RP 2SK have these terms; N_c is that
of a circle (Skempton 1951, as in clay), and 6.2 to 9 elsewhere.

Sand below the clay keeps the pressure of the open water, which lifts what is above it:
the soil down to the bottom z_b of the clay, with all of its submerged weight, against
the adhesion and, where the tip has not yet reached the sand, the strength of the clay
between tip and sand on a cylinder with the diameter of the inside:

    s = sum of gamma' dz + (F_i + pi D_i sum of s_u dz from h to z_b) / A_i.

F_i = pi D_i sum of a_i dz is the adhesion of clay alone. The friction of sand on the
inner wall is left out, on the safe side; so is the loss of pressure in sand below the
clay of the plug. No safety factor is in any of this.

SI units; h is the embedment of the tip (m), s is above the pressure of the open water.
"""
from collections.abc import Sequence
from math import inf, nan

import numpy as np

from caisson.design.clay import Layer, strength_at, tip_layer
from caisson.design.cone import Skirt

REVERSE_BEARING = "reverse bearing of the plug"
LIFT = "clay plug lifted by water below"


def bearing_factor(h: float, diameter: float) -> float:
    """Return N_c of a circle at a depth."""
    return min(6 * (1 + 0.2 * h / diameter), 9.0)


def between(layers: Sequence[Layer], top: float, bottom: float) -> np.ndarray:
    """Return how much of each layer is between two depths (m), [n]."""
    tops = np.array([layer.top for layer in layers])
    bottoms = np.append(tops[1:], inf)
    return np.maximum(np.minimum(bottoms, bottom) - np.maximum(tops, top), 0.0)


def adhesion(skirt: Skirt, layers: Sequence[Layer], h: float) -> float:
    """Return that of the inner wall over the area inside (Pa)."""
    stresses = [layer.inner_adhesion for layer in layers]
    return 4 / skirt.inner_diameter * float(stresses @ between(layers, 0.0, h))


def reverse_bearing(skirt: Skirt, layers: Sequence[Layer], h: float) -> float:
    """Return the suction at which the plug fails; nan where the tip is in sand."""
    strength = strength_at(layers, h)
    if not strength:
        return nan
    n_c = bearing_factor(h, skirt.outer_diameter)
    return n_c * strength + adhesion(skirt, layers, h)


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
    weights = [layer.unit_weight for layer in layers]
    strengths = [layer.strength for layer in layers]
    below = 4 / skirt.inner_diameter * float(strengths @ between(layers, h, bottom))
    weight = float(weights @ between(layers, 0.0, bottom))
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
