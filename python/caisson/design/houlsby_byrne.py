# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance of a caisson in layers of sand, also under suction.

Houlsby and Byrne (2005), Design procedures for installation of suction
caissons in sand, doi:10.1680/geng.2005.158.3.135. Plain: vertical stress
gamma' z beside the wall. Enhanced: the friction on the wall adds to the
vertical stress beside it, inside over the whole plug, outside out to m times
the radius:

    d sigma'_v / dz = gamma' + sigma'_v / Z,   Z_i = D_i / (4 K tan(delta_i)),
                                               Z_o = D_o (m^2 - 1) / (4 K tan(delta_o)).

K tan(delta) is a number of its own. The authors fitted it to installations in dense
sand and found 0.45 to 0.8, because a wall pushes sand aside and so raises the stress on
it. K0 tan(delta), of ground that no wall has disturbed, is a lower bound. A smooth wall
has no friction.

The paper has one layer. With several, gamma' and K are those of the layer at the
depth, and the stress continues from layer to layer without a jump. The tip is a
strip footing, in the layer in which it is, under the (unequal) stress of both
sides; a ledge (not in the paper) is one, too, under the stress of its side.

Suction makes water flow down outside and up inside. The paper takes both
gradients as uniform over the embedment; so they are here, in layers too: flow
adds the same to the unit weight of all layers on one side of the wall. No unit
weight falls below 0. At the tip the unit weight is that of the inside.

SI units, angles in degrees.
"""
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import exp, inf, nan, pi, radians, tan
from typing import NamedTuple

import numpy as np

from caisson.design.method import Forces, with_ledges
from caisson.ledges import Ledge

# N_gamma of a rough strip footing by the method of characteristics (Martin
# 2005, Exact bearing capacity calculations using the method of
# characteristics), by friction angles in degrees.
ANGLES = (15, 20, 25, 30, 35, 40, 45)
N_GAMMA = (1.181, 2.839, 6.491, 14.754, 34.476, 85.566, 234.21)


def bearing_factor_surcharge(phi: float) -> float:
    """Return N_q of a strip footing (Reissner 1924)."""
    return exp(pi * tan(radians(phi))) * tan(radians(45 + phi / 2)) ** 2


@lru_cache(maxsize=256)
def bearing_factor_weight(phi: float) -> float:
    """Return N_gamma; 0, on the safe side, outside the table of 15 to 45 degrees.

    N_gamma / ((N_q - 1) tan(phi)), which hardly changes with phi, is interpolated.
    """

    def scale(angle: float) -> float:
        return (bearing_factor_surcharge(angle) - 1) * tan(radians(angle))

    ratios = [n / scale(angle) for angle, n in zip(ANGLES, N_GAMMA)]
    return float(np.interp(phi, ANGLES, ratios, 0.0, 0.0)) * scale(phi)


@dataclass(frozen=True)
class Layer:
    """A layer of sand, down to the top of the next one."""

    top: float  # m below the surface
    unit_weight: float  # effective, N/m3
    friction_angle: float
    lateral_stress_ratio: float  # K of undisturbed ground
    wall_friction_angle: float | None = None  # None: that of the wall
    permeability: float = 0.0  # m/s; 0: not known

    def weight_under(self, added: float) -> float:
        """Return the unit weight with what flow adds to it, but not below 0."""
        return max(self.unit_weight + added, 0.0)


@dataclass(frozen=True)
class Seepage:
    """What the flow of water adds to the unit weight on each side, N/m3."""

    outer: float = 0.0
    inner: float = 0.0


STILL = Seepage()


class Wall:
    """One side of the wall: the vertical stress beside it, and its friction."""

    def __init__(
        self,
        diameter: float,
        reach: float,
        friction_angle: float,
        k_tan_delta: float | None,
    ) -> None:
        """reach: Z K tan(delta), m: D/4 inside, D (m^2 - 1)/4 outside, inf without
        stress enhancement. k_tan_delta: of all layers, or None for that of undisturbed
        ground."""
        self.diameter, self.reach = diameter, reach
        self.tan_delta = tan(radians(friction_angle))
        self.k_tan_delta = k_tan_delta

    def step(
        self, layer: Layer, stress: float, thickness: float, added: float
    ) -> tuple[float, float]:
        """Return the vertical stress below a piece of a layer, from that above
        it, and the friction on the piece. added: to the unit weight, by flow."""
        weight = layer.weight_under(added)
        own = layer.wall_friction_angle
        tan_delta = self.tan_delta if own is None else tan(radians(own))
        k_tan = self.k_tan_delta
        if k_tan is None or tan_delta == 0:  # where the wall is smooth 0
            k_tan = layer.lateral_stress_ratio * tan_delta
        d, z = thickness, self.reach / k_tan if k_tan > 0 else inf
        if z < inf:
            growth = exp(d / z) - 1
            below = stress + (stress + weight * z) * growth
            integral = stress * z * growth + weight * z**2 * (growth - d / z)
        else:
            below = stress + weight * d
            integral = stress * d + weight * d**2 / 2
        return below, integral * k_tan * pi * self.diameter


class Caisson:
    """The resistance of one caisson; h is the embedment of its tip (m), and all
    forces are N."""

    def __init__(
        self,
        diameter: float,
        wall_thickness: float,
        layers: Sequence[Layer],
        inner_friction_angle: float,
        outer_friction_angle: float,
        spread: float | None = None,
        k_tan_delta: tuple[float, float] | None = None,
        ledges: Sequence[Ledge] = (),
        below: Sequence[tuple[float, float]] = (),
    ) -> None:
        """diameter: outer one; layers: from the surface down; spread: m, None without
        stress enhancement; k_tan_delta: K tan(delta) of the inner and the outer wall,
        None for undisturbed ground; below: (top, permeability) of the layers that go
        on below these."""
        self.outer_diameter, self.t = diameter, wall_thickness
        self.below = below
        self.ledges = ledges
        self.layers = sorted(layers, key=lambda layer: layer.top)
        self.enhanced = spread is not None
        inner = diameter - 2 * wall_thickness
        reach = inner / 4 if spread else inf, diameter * ((spread or inf) ** 2 - 1) / 4
        k_inner, k_outer = k_tan_delta or (None, None)
        self.inner = Wall(inner, reach[0], inner_friction_angle, k_inner)
        self.outer = Wall(diameter, reach[1], outer_friction_angle, k_outer)

    def pieces(self, h: float) -> list[tuple[Layer, float]]:
        """Return the layers down to h, with the thickness that counts."""
        bottoms = [layer.top for layer in self.layers[1:]] + [inf]
        pairs = zip(self.layers, bottoms)
        return [
            (layer, min(bottom, h) - layer.top)
            for layer, bottom in pairs
            if layer.top < h
        ]

    def _go_down(self, wall: Wall, h: float, added: float) -> tuple[float, float]:
        """Return the vertical stress at h and the friction down to it."""
        stress = friction = 0.0
        for layer, thickness in self.pieces(h):
            stress, part = wall.step(layer, stress, thickness, added)
            friction += part
        return stress, friction

    def k_tan_delta_of(self, friction: float, h: float, seepage: Seepage) -> float:
        """Return the K tan(delta) of a friction (N) on the outer wall: over the stress
        beside it without enhancement; nan at the mudline."""
        stress = integral = 0.0
        for layer, d in self.pieces(h):
            weight = layer.weight_under(seepage.outer)
            integral += stress * d + weight * d**2 / 2
            stress += weight * d
        whole = pi * self.outer.diameter * integral
        return friction / whole if whole > 0 else nan

    def _pressure_between(
        self, inner: float, outer: float, h: float, t: float, added: float
    ) -> float:
        """Return what bears on a strip of a width t (m), as the tip, from the vertical
        stresses beside it (Pa). added: to the unit weight, by flow."""
        low, high = sorted((inner, outer))
        layer = [layer for layer in self.layers if layer.top < h or layer.top <= 0][-1]
        if not layer.friction_angle:  # clay, which another method treats
            return 0.0
        n_q = bearing_factor_surcharge(layer.friction_angle)
        n_gamma = bearing_factor_weight(layer.friction_angle)
        weight = layer.weight_under(added)
        x = t  # the part of the tip where the soil flows to the low side
        if n_gamma > 0 and weight > 0:
            x = t / 2 + (high - low) * n_q / (4 * weight * n_gamma)
        if high > low and x >= t:
            return low * n_q + weight * t * n_gamma
        return high * n_q + weight * n_gamma * (t - 2 * min(x, t) ** 2 / t)

    def forces(self, h: float, seepage: Seepage = STILL) -> Forces:
        """Return the force on the tip, with a flat end of the wall, and the friction
        on both walls."""
        inner, inside = self._go_down(self.inner, h, seepage.inner)
        outer, outside = self._go_down(self.outer, h, seepage.outer)
        end = self._pressure_between(inner, outer, h, self.t, seepage.inner)
        tip = end * pi * (self.outer_diameter - self.t) * self.t

        def pressure(ledge: Ledge, z: float) -> float:
            wall, added = self.outer, seepage.outer
            if ledge.is_inside:
                wall, added = self.inner, seepage.inner
            beside, _ = self._go_down(wall, z, added)
            return self._pressure_between(beside, beside, z, ledge.width, added)

        return with_ledges(Forces(tip, inside, outside), self.ledges, h, pressure)

    def resistance(self, h: float, seepage: Seepage = STILL) -> float:
        """Return the friction on both walls and the force on the tip."""
        return self.forces(h, seepage).total


class Assumptions(NamedTuple):
    """What the method assumes, which no ground investigation gives. K tan(delta) is
    (low, high)."""

    k_tan_delta_inside: tuple[float, float] = (0.45, 0.8)
    k_tan_delta_outside: tuple[float, float] = (0.45, 0.8)
    plug_permeability_ratio: float = 1.0  # of the plug to the soil outside
    load_spread: float | None = 1.5  # m; None: no stress enhancement


UNDISTURBED = "undisturbed"


class HoulsbyByrne:
    """The forces of jacking as a method: a range of K tan(delta), and below it
    undisturbed ground without stress enhancement."""

    cases = ("low", "high")

    def __init__(
        self, by_name: Mapping[str, Caisson], permeability_ratio: float
    ) -> None:
        self.by_name, self.permeability_ratio = by_name, permeability_ratio

    def forces(self, h: float, case: str, flow: Seepage = STILL) -> Forces:
        """Return the forces at an embedment: of jacking, or under flow."""
        return self.by_name[case].forces(h, flow)


def method(
    diameter: float,
    wall_thickness: float,
    layers: Sequence[Layer],
    friction_angles: tuple[float, float],
    assumed: Assumptions,
    ledges: Sequence[Ledge] = (),
    below: Sequence[tuple[float, float]] = (),
) -> HoulsbyByrne:
    """Return the method for sand. friction_angles: of the inner and outer wall; below:
    (top, permeability) of layers below these."""
    geometry = diameter, wall_thickness, layers, *friction_angles
    ranges = zip(assumed.k_tan_delta_inside, assumed.k_tan_delta_outside)
    by_name = {
        name: Caisson(*geometry, assumed.load_spread, pair, ledges, below)
        for name, pair in zip(HoulsbyByrne.cases, ranges)
    }
    by_name[UNDISTURBED] = Caisson(*geometry, ledges=ledges, below=below)
    return HoulsbyByrne(by_name, assumed.plug_permeability_ratio)
