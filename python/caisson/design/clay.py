# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance in clay by its undrained strength.

The walls bear the adhesion, and the tip N_c times the strength and the weight of the
soil above it:

    R = pi (D_o int a_o dz + D_i int a_i dz) + A (gamma' h + N_c s_u).

With the adhesion s_u over the sensitivity, this is what is used for skirts and suction
anchors (Andersen et al. 2005; DNV-RP-E303). The tip is a strip in the lower case,
N_c = 7.5, and a circle in the upper one, N_c = 9, both at depth (Skempton 1951). Ledges
bear as the tip does, at their depth z; there N_c grows with 1 + 0.2 z / B up to a depth
of 2.5 widths B (Skempton 1951). Above the lowest ring the inner wall has the adhesion
only in the upper case: clay may stand, and leave a gap (custom).

K.H. Andersen, J.D. Murff, M.F. Randolph, E.C. Clukey, C.T. Erbrich, H.P. Jostad,
B. Hansen, C. Aubeny, P. Sharma, C. Supachawarote (2005), Suction anchors for deepwater
applications. Proc. ISFOG, Perth, 3-30.
A.W. Skempton (1951), The bearing capacity of clays. Building Research Congress,
London, 180-189.
"""
from collections.abc import Sequence
from math import inf, pi
from typing import NamedTuple

import numpy as np

from caisson.design.cone import Skirt
from caisson.design.method import Forces, between, vertical_stress, with_ledges
from caisson.ledges import Ledge

CASES = ("strip", "circle")
THIN, ALIKE = 1.0, 0.3  # m, and of s_u: parts of a profile
N_C = dict(zip(CASES, (7.5, 9.0)))
DEEP = 2.5  # widths, from where on N_c is that at depth


class Layer(NamedTuple):
    """Clay down to the top of the next layer; of sand strength and adhesion are 0."""

    top: float  # m below the mudline
    unit_weight: float  # effective, N/m3
    strength: float  # s_u, Pa
    inner_adhesion: float  # Pa
    outer_adhesion: float


def tip_layer(layers: Sequence[Layer], h: float) -> int:
    """Return the number of the layer in which a tip at an embedment h (m) is, at a
    boundary the upper one."""
    return max([i for i, layer in enumerate(layers) if layer.top < h], default=0)


def strength_at(layers: Sequence[Layer], h: float) -> float:
    """Return s_u at a tip (Pa): on the line between the middles of the layers around,
    where these are thin and so alike that they are parts of one profile."""
    i = tip_layer(layers, h)
    ends = [layer.top for layer in layers] + [inf]
    middles = [(top + bottom) / 2 for top, bottom in zip(ends, ends[1:])]
    j = i + 1 if h > middles[i] else i - 1
    own, pair = layers[i].strength, sorted((i, j))
    if not 0 <= j < len(layers) - 1 or i == len(layers) - 1:
        return own
    if max(ends[k + 1] - ends[k] for k in pair) > THIN:
        return own
    if abs(layers[j].strength - own) > ALIKE * max(layers[j].strength, own):
        return own
    values = [layers[k].strength for k in pair]
    return float(np.interp(h, [middles[k] for k in pair], values))


class Clay:
    """The method for one caisson."""

    cases = CASES

    def __init__(self, skirt: Skirt, layers: Sequence[Layer]) -> None:
        """layers: from the mudline down."""
        self.skirt = skirt
        self.layers = sorted(layers, key=lambda layer: layer.top)

    def forces(self, h: float, case: str) -> Forces:
        """Return the forces at an embedment."""

        def pressure(ledge: Ledge, z: float) -> float:
            return self.pressure(z, case, ledge.width)

        return with_ledges(self.plain_forces(h, case), self.skirt.ledges, h, pressure)

    def pressure(self, z: float, case: str, width: float = 0.0) -> float:
        """Return what bears on a face that looks down at a depth (Pa); 0 in sand.
        width: of the face (m)."""
        if not (strength := strength_at(self.layers, z)):
            return 0.0
        share = 1.0
        if z < DEEP * width:
            share = (1 + 0.2 * z / width) / (1 + 0.2 * DEEP)
        return vertical_stress(self.layers, z) + share * N_C[case] * strength

    def plain_forces(self, h: float, case: str) -> Forces:
        """Return the forces on the tip and on the walls at an embedment."""
        adhesions = np.array(
            [(x.inner_adhesion, x.outer_adhesion) for x in self.layers]
        )
        rings = [x.height for x in self.skirt.ledges if x.steel < inf]
        gap = max(h - min(rings), 0.0) if rings and case == CASES[0] else 0.0
        inner = float(between(self.layers, gap, h) @ adhesions[:, 0])
        outer = float(between(self.layers, 0.0, h) @ adhesions[:, 1])
        return Forces(
            self.skirt.tip_area * self.pressure(h, case),
            pi * self.skirt.inner_diameter * inner,
            pi * self.skirt.outer_diameter * outer,
        )
