# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tip of a wall bears between unequal surcharges, by characteristics.

A rigid strip of the width t, the flat and rough tip of a wall, goes down without
moving sideways or turning. The soil obeys Mohr-Coulomb's law with associated flow.
At the level of the tip it carries the vertical stress sigma_o outside and a smaller
one, sigma_i = a sigma_o, inside; the unit weights of the two sides may differ, as
they do where water flows down outside and up inside.

**Heavy soil.** On each side a net of characteristics (bearing_capacity.py) fails
around the edge of the tip. Both end on the soil that moves with the tip, the wedge
between the last rays of both fans, which meet below the tip in C. At C both nets
have the same p and the same psi, mirrored: this finds the two rays. Where the inner
ray would rise above the tip, the soil slips along the tip on that side.

**Weightless soil.** All of the wedge has one stress, so that

    q = sqrt(sigma_o sigma_i) N_q (1 + sin phi cos 2 psi) / (1 + sin phi),
    psi = ln(1/a) / (4 tan phi),       as long as psi <= 45 degrees + phi / 2,

with c cot phi added to all three stresses. Beyond, all soil below the tip slips
inwards around its inner edge and the outer side no longer matters:

    q = sigma_i (1 + sin phi) exp((3 pi / 2 + phi) tan phi).

These loads are upper bounds, because the velocity of the mechanism is known: a wedge
that goes down, and two fans whose dissipation is zero. The stress is known inside the
mechanism; that it can be continued below, which makes them lower bounds as well, is
not proven here. A smooth strip bears sigma_i N_q, which is both bounds: Prandtl's
field holds for all sigma_o between sigma_i and N_q sigma_i, because admissible
loads form a convex cone that has sigma_o at both ends.

**A wedge in weightless soil**, with faces at the angle beta below the horizontal and
wall friction delta. Each face that slips bears, over its width,

    f = (1 + sin phi cos 2 omega) (1 + tan delta tan beta) / (1 - sin phi)
        exp(2 tan phi (pi / 2 - beta + omega)),
    2 omega = delta + arcsin(sin delta / sin phi),

times its own surcharge. This holds on the outer face while psi <= beta - omega; for a
smaller a the soil flows around the point of the wedge, and the outer face has the
stress of the wedge of soil above.

SI units, angles in degrees at the interface and in radians inside; stresses are
positive in compression.
"""
import argparse
from dataclasses import dataclass
from math import asin, cos, exp, inf, log, pi, radians, sin, sqrt, tan

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, root

from lab.verification.bearing_capacity import (
    Array,
    Footing,
    Front,
    Mesh,
    Net,
    RoughNet,
    load_on_base,
    load_on_ray,
)
from lab.verification.options import declare

# the width of the tip in the net, whose edge is at r = 1: beyond the other edge there
# must be room for C
WIDTH = 0.5


@dataclass(frozen=True)
class Side:
    """The soil on one side of the tip."""

    surcharge: float  # vertical effective stress at the level of the tip (Pa)
    weight: float = 0.0  # effective unit weight (N/m3), flow included


@dataclass(frozen=True)
class Tip:
    """A flat and rough tip of the width t, and the soil around it."""

    phi: float  # friction angle (degrees)
    outer: Side
    inner: Side  # the one with the smaller surcharge
    width: float = 1.0  # m
    cohesion: float = 0.0  # Pa

    def footing(self, side: Side) -> Footing:
        """Return the soil of one side, in lengths of the net."""
        weight = side.weight * self.width / WIDTH
        return Footing(
            self.phi, False, True, self.cohesion, side.surcharge, weight=weight
        )


def prandtl(phi: float) -> float:
    """Return N_q. phi: degrees."""
    angle = radians(phi)
    return exp(pi * tan(angle)) * tan(pi / 4 + angle / 2) ** 2


def tilt(phi: float, ratio: float) -> float:
    """Return psi (radians) of the soil below the tip; ratio: sigma_i / sigma_o."""
    return -log(ratio) / (4 * tan(radians(phi))) if ratio > 0 else inf


def one_sided_factor(phi: float) -> float:
    """Return q / sigma_i where all the soil slips inwards along the rough tip."""
    angle = radians(phi)
    return (1 + sin(angle)) * exp((1.5 * pi + angle) * tan(angle))


def weightless_tip(phi: float, outer: float, inner: float) -> float:
    """Return the pressure on a flat rough tip (Pa), c = 0. outer, inner: sigma (Pa),
    inner the smaller one."""
    if inner <= 0:
        return 0.0
    sine, psi = sin(radians(phi)), tilt(phi, inner / outer)
    if psi > pi / 4 + radians(phi) / 2:
        return inner * one_sided_factor(phi)
    shape = (1 + sine * cos(2 * psi)) / (1 + sine)
    return sqrt(outer * inner) * prandtl(phi) * shape


def weightless_wedge(
    phi: float, delta: float, beta: float, outer: float, inner: float
) -> float:
    """Return the force on a wedge over its width (Pa), c = 0, symmetric. delta: of
    its faces; beta: angle of the faces below the horizontal (degrees)."""
    if inner <= 0:
        return 0.0
    angle, slope, sine = radians(phi), radians(beta), sin(radians(phi))
    arc = asin(sin(radians(delta)) / sine)
    omega = 0.5 * (radians(delta) + arc)
    turned = exp(2 * tan(angle) * (pi / 2 - slope + omega))
    shape = (1 + sine * cos(2 * omega)) * (1 + tan(radians(delta)) * tan(slope))
    factor = shape * turned / (1 - sine)
    psi = tilt(phi, inner / outer)
    if psi <= slope - omega:
        return 0.5 * factor * (outer + inner)
    # the outer face slips the other way at the latest when psi is this
    psi = min(psi, slope + omega)
    p = inner / (1 - sine) * exp(2 * tan(angle) * (pi / 2 + psi))
    face = p * (1 + sine * cos(2 * psi) + sine * sin(2 * psi) * tan(slope))
    return 0.5 * (factor * inner + face)


class HalfNet:
    """The nets of one side, by a number x: psi of the last ray, less that of the ray
    along the tip, if it is positive; otherwise -x is the length of the surface from
    which lines reach the tip, in widths of it."""

    def __init__(self, footing: Footing, lines: int) -> None:
        """lines: of the net."""
        self.footing, self.lines = footing, lines
        self.along = -(pi / 4 + footing.friction / 2)

    def net(self, x: float) -> Net:
        """Return a net."""
        footing = self.footing
        finest = footing.surface_p / footing.weight if footing.weight > 0 else inf
        slope = min(max(x, 0.0), pi / 2)  # of the last ray
        turn = 0.75 * pi + footing.friction / 2 - slope
        spread = exp(turn * tan(footing.friction))
        length = 2.6 * WIDTH * spread * cos(pi / 4 - footing.friction / 2)
        rough = RoughNet(footing, Mesh(self.lines, length, finest))
        if x < 0:
            return rough.from_base(-x * WIDTH)
        return rough.from_edge(self.along + x)

    def ray(self, x: float) -> CubicSpline:
        """Return (r, z, p, psi) of the last ray over the number of the point."""
        ray = self.net(x).ray
        return CubicSpline(np.arange(len(ray.r)), np.array(ray).T)


def meeting_of(inner: CubicSpline, outer: CubicSpline) -> tuple[float, float]:
    """Return the numbers of the points at which two rays meet."""

    def apart(x: Array) -> Array:
        r, z = inner(x[0])[:2]
        s, y = outer(x[1])[:2]
        return np.array([(r - 1) + (s - 1) + WIDTH, z - y])

    def polyline(ray: CubicSpline) -> Array:
        return np.array(ray(ray.x)[:, :2])

    a, b = polyline(inner), polyline(outer)
    b = np.column_stack([2 - WIDTH - b[:, 0], b[:, 1]])
    distance = np.hypot(*(a[:, None] - b[None]).transpose(2, 0, 1))
    start = np.unravel_index(np.argmin(distance), distance.shape)
    found = root(apart, np.array(start, dtype=float), tol=1e-12)
    return float(found.x[0]), float(found.x[1])


def cut(ray: CubicSpline, end: float) -> Front:
    """Return a ray up to its meeting with the other one."""
    numbers = np.linspace(0, end, 8 * len(ray.x))
    return Front(*ray(numbers).T)


class TwoSided:
    """The two nets of a tip below which soil moves with it."""

    def __init__(self, tip: Tip, lines: int) -> None:
        """lines: of each net."""
        self.tip = tip
        self.inner = HalfNet(tip.footing(tip.inner), lines)
        self.outer = HalfNet(tip.footing(tip.outer), lines)

    def mismatch(self, x: Array) -> Array:
        """Return the differences of log p and of psi where the last rays meet."""
        inner, outer = self.inner.ray(x[0]), self.outer.ray(x[1])
        at_inner, at_outer = meeting_of(inner, outer)
        p, psi = inner(at_inner)[2:]
        other_p, other_psi = outer(at_outer)[2:]
        return np.array([log(abs(p / other_p)), psi + other_psi])

    def start(self) -> Array:
        """Return x of both sides in weightless soil."""
        shift, along = self.inner.footing.shift, -self.inner.along
        inner, outer = (shift + s.surcharge for s in (self.tip.inner, self.tip.outer))
        psi = min(tilt(self.tip.phi, inner / outer), 0.95 * along)
        return np.array([along - psi, along + psi])

    def find(self) -> Array | None:
        """Return x of the two rays that meet with one stress, or None. The weight
        lowers the rays: the search starts from those of weightless soil and below."""
        for part in (1.0, 0.8, 0.6, 0.4, 0.2, 0.1):
            try:
                found = root(
                    self.mismatch, part * self.start(), tol=1e-10, options={"eps": 1e-6}
                )
            except ValueError:  # of a net that has no ray
                continue
            if np.max(np.abs(found.fun)) < 1e-7:
                return np.array(found.x)
        return None

    def pressure(self) -> float | None:
        """Return the mean pressure on the tip (Pa), None if the rays do not meet."""
        x = self.find()
        if x is None:
            return None
        inner, outer = self.inner.ray(x[0]), self.outer.ray(x[1])
        at_inner, at_outer = meeting_of(inner, outer)
        load = load_on_ray(self.inner.footing, cut(inner, at_inner))
        load += load_on_ray(self.outer.footing, cut(outer, at_outer))
        for half, at in zip((self.inner, self.outer), x):
            if at < 0:
                load += load_on_base(half.footing, half.net(at).base)
        return load / WIDTH


def one_sided(tip: Tip, lines: int) -> float:
    """Return the pressure where all soil slips inwards along the tip (Pa)."""
    half = HalfNet(tip.footing(tip.inner), lines)

    def beyond(x: float) -> float:
        return float(half.net(x).base.r[-1] - (1 - WIDTH))

    x = brentq(beyond, -1e-3, -12.0, xtol=1e-10)
    return load_on_base(half.footing, half.net(x).base) / WIDTH


def tip_pressure(tip: Tip, lines: int) -> float:
    """Return the mean pressure on a flat rough tip (Pa), by nets of this many
    lines."""
    found = TwoSided(tip, lines).pressure()
    return one_sided(tip, lines) if found is None else found


def converged(tip: Tip, lines: int) -> float:
    """Return the pressure of nets with lines / 2 and with this many lines,
    extrapolated with the second order of the differences (Pa)."""
    coarse, fine = tip_pressure(tip, lines // 2), tip_pressure(tip, lines)
    return fine + (fine - coarse) / 3


def flowing(phi: float, depth: float, gradient: float) -> Tip:
    """Return a tip in soil of unit weight 1, whose width is 1: water flows down
    outside and up inside. depth: of the tip over its width; gradient: over the
    critical one."""
    outer, inner = (
        Side(depth * (1 + sign * gradient), 1 + sign * gradient) for sign in (1, -1)
    )
    return Tip(phi, outer, inner)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of scripts/lab tip-capacity."""
    declare(
        parser,
        phi=(30.0, "friction angle (degrees)"),
        delta=(20.0, "wall friction of a wedge (degrees)"),
        beta=(45.0, "angle of its faces (degrees)"),
        depth=(5.0, "of the tip under flow, over its width"),
        lines=(40, "lines of the finest net (none)"),
    )


def main(options: argparse.Namespace) -> int:
    """Print what tips bear in weightless soil and under flow."""
    phi = options.phi
    print("weightless soil, q / sigma_o")
    print("sigma_i/sigma_o  flat, rough  smooth       wedge")
    for ratio in (1, 0.7, 0.5, 0.3, 0.2, 0.1, 0.07):
        wedge = weightless_wedge(phi, options.delta, options.beta, 1.0, ratio)
        flat, smooth = weightless_tip(phi, 1.0, ratio), ratio * prandtl(phi)
        print(f"{ratio:15g}{flat:13.4f}{smooth:8.4f}{wedge:12.4f}")
    print(f"\nflat rough tip, {options.depth:g} t deep: q / (gamma' t)")
    print("gradient/critical  with weight  surcharge alone")
    for gradient in (0, 0.5, 0.8):
        tip = flowing(phi, options.depth, gradient)
        alone = weightless_tip(phi, tip.outer.surcharge, tip.inner.surcharge)
        heavy = converged(tip, options.lines)
        print(f"{gradient:17g}{heavy:13.3f}{alone:17.3f}", flush=True)
    return 0
