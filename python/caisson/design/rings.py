# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether a ring inside the wall of a caisson divides the part that buckles, by
DNV-RP-C202 (October 2010, formulas from secondary sources).

The ring is a flat bar of width w and height b. It needs the area

    A >= (2 / Z^2 + 0.06) l t,              Z = l^2 / (r t) sqrt(1 - nu^2),

l the mean of the lengths on both sides, and, with the part of the wall that helps it,
l_ef = 1.56 sqrt(r t) / (1 + 12 t / r) <= l, the moment of inertia

    I >= sigma_a t r_0^4 / (500 E l)
       + p r r_0^2 l / (3 E) (1.5 + 3 E z_t 0.005 r / (r_0^2 (f_y / 2 - sigma_hR))).

r_0 is the radius of the centroid of both, z_t the distance from it to the inner edge of
the ring, and sigma_hR = (p r / t - nu sigma_a) / (1 + A / (l_e0 t)) r / (r - t/2 - w)
the hoop stress of this edge; l_e0 = l / beta (cosh 2 beta - cos 2 beta) / (sinh 2 beta
+ sin 2 beta), beta = l / (1.56 sqrt(r t)). f_y counts in full, as the flat bar does not
trip, if w <= 0.4 b sqrt(E / f_y). Shear and wall stiffeners along the axis are none.
"""
from math import cos, exp, inf, pi, sin, sqrt
from typing import NamedTuple

OUT_OF_ROUND = 0.005  # of the radius


class Ring(NamedTuple):
    """Its middle below the lid, its width towards the axis, and its height (m)."""

    below_lid: float
    width: float
    height: float

    @property
    def area(self) -> float:
        """The area of its section (m2)."""
        return self.width * self.height


class Shell(NamedTuple):
    """The wall at a ring: radius of its middle, thickness and the mean of the lengths
    on both sides (m), and the steel (Pa)."""

    radius: float
    thickness: float
    length: float
    yield_strength: float
    youngs_modulus: float
    poisson_ratio: float

    def needed_area(self) -> float:
        """Return the area that a ring needs (m2)."""
        r, t, length, nu = *self[:3], self.poisson_ratio
        z = length**2 / (r * t) * sqrt(1 - nu**2)
        return (2 / z**2 + 0.06) * length * t

    def section(self, ring: Ring) -> tuple[float, float]:
        """Return the moment of inertia of the ring with its part of the wall (m4), and
        how far the centroid lies within the middle of the wall (m)."""
        r, t = self[:2]
        plate = t * min(1.56 * sqrt(r * t) / (1 + 12 * t / r), self.length)
        arm = (t + ring.width) / 2
        inward = ring.area * arm / (ring.area + plate)
        own = (ring.area * ring.width**2 + plate * t**2) / 12
        return own + ring.area * (arm - inward) ** 2 + plate * inward**2, inward

    def edge_stress(self, ring: Ring, pressure: float, along: float) -> float:
        """Return the hoop stress of the inner edge of a ring (Pa) under a pressure from
        outside and an axial stress (Pa)."""
        r, t = self[:2]
        beta = self.length / (1.56 * sqrt(r * t))
        down = exp(-4 * beta)  # over cosh and sinh, times 2 exp(-2 beta)
        high = 1 + down - 2 * exp(-2 * beta) * cos(2 * beta)
        low = 1 - down + 2 * exp(-2 * beta) * sin(2 * beta)
        beside = self.length / beta * high / low
        hoop = pressure * r / t - self.poisson_ratio * along
        return hoop / (1 + ring.area / (beside * t)) * r / (r - t / 2 - ring.width)

    def needed_inertia(self, ring: Ring, pressure: float, axial: float) -> float:
        """Return the moment of inertia that a ring needs (m4) under a pressure from
        outside (Pa) and an axial force of compression (N); infinite where its edge
        yields."""
        r, t, length, yields, e = self[:5]
        along = axial / (2 * pi * r * t)
        left = yields / 2 - abs(self.edge_stress(ring, pressure, along))
        if left <= 0:
            return inf
        _, inward = self.section(ring)
        r_0, edge = r - inward, t / 2 + ring.width - inward
        bent = 3 * e * edge * OUT_OF_ROUND * r / (r_0**2 * left)
        axially = max(along, 0.0) * t * r_0**4 / (500 * e * length)
        by_pressure = (
            max(pressure, 0.0) * r * r_0**2 * length / (3 * e) * (1.5 + bent)
        )
        return axially + by_pressure

    def demand(self, ring: Ring, pressure: float, axial: float) -> float:
        """Return what a ring needs over what it has, the largest of area, moment of
        inertia and slenderness: it divides the wall up to 1."""
        slender = 0.4 * sqrt(self.youngs_modulus / self.yield_strength)
        return max(
            self.needed_area() / ring.area,
            self.needed_inertia(ring, pressure, axial) / self.section(ring)[0],
            ring.width / (slender * ring.height),
        )
