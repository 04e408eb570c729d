# SPDX-License-Identifier: LGPL-2.1-or-later
"""The suction under which the wall of a caisson buckles, by DNV-RP-C202.

Between the lid, or a ring, and a point in the soil the wall is an unstiffened cylinder
of the length l, the free length above the mudline and a fixity depth below it. Its
stresses are those of a pressure p from outside, and of weight and suction on the lid:

    sigma_h = p r / t,          sigma_a = (V + s A_i) / (2 pi r t)      (compression).

The elastic strength for each of them alone is

    f_E = C pi^2 E / (12 (1 - nu^2)) (t / l)^2,     C = psi sqrt(1 + (rho xi / psi)^2),

                    psi   xi            rho
    axial stress    1     0.702 Z       0.5 / sqrt(1 + r / (150 t))
    pressure        4     1.04 sqrt(Z)  0.6             Z = l^2 / (r t) sqrt(1 - nu^2)

and 0.25 E (t / r)^2 under pressure where l / r > 2.25 sqrt(r / t). With the equivalent
stress sigma_j = sqrt(sigma_a^2 - sigma_a sigma_h + sigma_h^2) follow

    lambda^2 = f_y / sigma_j (sigma_a / f_Ea + sigma_h / f_Eh),
    f_d = f_y / sqrt(1 + lambda^4) / gamma_M,       unity check = sigma_j / f_d,

and gamma_M from 1.15 (lambda < 0.5) to 1.45 (lambda > 1). rho holds for walls within
the tolerances that the practice refers to (DNV-OS-C401); there are no classes of them.
The row for lateral pressure is taken, as the axial stress counts on its own.

A ring inside the wall, a flat bar of width w and height b, divides the part that
buckles (October 2010, formulas from secondary sources) if it has the area

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

p is the suction above the mudline. Below it, it is the difference of the normal stress
with the pore pressure outside and inside that a run computed (wall.csv); the mean over
l is weighted with the square of a half wave, as the work of the pressure is when the
wall buckles. SI units, but for columns; depths are below the mudline.
"""
from collections.abc import Callable, Sequence
from itertools import chain, combinations
from math import cos, exp, inf, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from caisson.results import Results, Table

POISSON_RATIO = 0.3
OUT_OF_ROUND = 0.005  # of the radius
LONG, OF_LONG = 2.25, 0.25
MANY = 1e6  # of a check, in place of infinity
Check = Callable[..., float]
SIDES = ("outer", "inner")


class Ring(NamedTuple):
    """Its middle below the lid, its width towards the axis, and its height (m)."""

    below_lid: float
    width: float
    height: float

    @property
    def area(self) -> float:
        """The area of its section (m2)."""
        return self.width * self.height


class Wall(NamedTuple):
    """The steel wall of a caisson: outer diameter, thickness and length (m), and the
    steel (Pa). fixity: depth of fixity over the diameter; rings: spacing (m) of those
    that are known to suffice; stiffeners: others, from the lid down; parts: of a wall
    with steps where each begins below the lid, and its thickness (m)."""

    diameter: float
    thickness: float
    length: float
    yield_strength: float
    youngs_modulus: float
    fixity: float
    rings: float = inf
    stiffeners: tuple[Ring, ...] = ()
    parts: tuple[tuple[float, float], ...] = ()

    @property
    def radius(self) -> float:
        """That of the middle of the wall (m)."""
        return (self.diameter - self.thickness) / 2

    @property
    def area_inside(self) -> float:
        """The area on which suction acts (m2)."""
        return pi / 4 * (self.diameter - 2 * self.thickness) ** 2

    def free_length(self, h: float) -> float:
        """Return the length above the mudline at an embedment (m)."""
        return max(self.length - h, 0.0)

    def buckling_length(self, h: float) -> float:
        """Return the length that buckles at an embedment (m), from the lid down."""
        fixed = min(self.fixity * self.diameter, h)
        return min(self.free_length(h) + fixed, self.rings)

    def at(self, h: float) -> "Wall":
        """Return it as thick as where it is thinnest in the part that buckles at an
        embedment (m), or that may be between rings of a spacing."""
        length = self.buckling_length(h) if self.rings == inf else self.length
        within = [thickness for begin, thickness in self.parts if begin < length]
        return self._replace(thickness=min(within, default=self.thickness))

    def stiffeners_at(self, h: float) -> list[Ring]:
        """Return those in the part that buckles at an embedment (m); none beside rings
        of a spacing, as the part between two of these decides."""
        if self.rings < inf:
            return []
        length = self.buckling_length(h)
        return [ring for ring in self.stiffeners if ring.below_lid < length]


def elastic_strengths(wall: Wall, length: float) -> tuple[float, float]:
    """Return the axial stress, and the hoop stress of a pressure from outside, under
    which a perfect elastic part of this length (m) would buckle, with rho (Pa)."""
    r, t, e = wall.radius, wall.thickness, wall.youngs_modulus
    plate = pi**2 * e / (12 * (1 - POISSON_RATIO**2)) * (t / length) ** 2
    z = length**2 / (r * t) * sqrt(1 - POISSON_RATIO**2)

    def strength(psi: float, xi: float, rho: float) -> float:
        return psi * sqrt(1 + (rho * xi / psi) ** 2) * plate

    axial = strength(1.0, 0.702 * z, 0.5 / sqrt(1 + r / (150 * t)))
    if length / r > LONG * sqrt(r / t):
        return axial, OF_LONG * e * (t / r) ** 2
    return axial, strength(4.0, 1.04 * sqrt(z), 0.6)


def unity_check(wall: Wall, length: float, pressure: float, axial: float) -> float:
    """Return the equivalent stress over the design strength of a part of this length
    (m), under a pressure from outside (Pa) and an axial force of compression (N)."""
    r, t, yields = wall.radius, wall.thickness, wall.yield_strength
    hoop, along = pressure * r / t, axial / (2 * pi * r * t)
    stress = sqrt(along**2 - along * hoop + hoop**2)
    if not stress > 0:
        return 0.0
    elastic_axial, elastic_hoop = elastic_strengths(wall, length)
    share = max(along, 0.0) / elastic_axial + max(hoop, 0.0) / elastic_hoop
    slenderness = sqrt(yields / stress * share)
    material_factor = float(np.interp(slenderness, [0.5, 1.0], [1.15, 1.45]))
    strength = yields / sqrt(1 + slenderness**4) / material_factor
    return stress / strength


def needed_area(wall: Wall, length: float) -> float:
    """Return the area that a ring needs (m2). length: the mean of the lengths on both
    sides of it (m), as below."""
    r, t, nu = wall.radius, wall.thickness, POISSON_RATIO
    z = length**2 / (r * t) * sqrt(1 - nu**2)
    return (2 / z**2 + 0.06) * length * t


def section(wall: Wall, length: float, ring: Ring) -> tuple[float, float]:
    """Return the moment of inertia of a ring with its part of the wall (m4), and how
    far the centroid lies within the middle of the wall (m)."""
    r, t = wall.radius, wall.thickness
    plate = t * min(1.56 * sqrt(r * t) / (1 + 12 * t / r), length)
    arm = (t + ring.width) / 2
    inward = ring.area * arm / (ring.area + plate)
    own = (ring.area * ring.width**2 + plate * t**2) / 12
    return own + ring.area * (arm - inward) ** 2 + plate * inward**2, inward


def edge_stress(
    wall: Wall, length: float, ring: Ring, pressure: float, along: float
) -> float:
    """Return the hoop stress of the inner edge of a ring (Pa) under a pressure from
    outside and an axial stress (Pa)."""
    r, t = wall.radius, wall.thickness
    beta = length / (1.56 * sqrt(r * t))
    down = exp(-4 * beta)  # over cosh and sinh, times 2 exp(-2 beta)
    high = 1 + down - 2 * exp(-2 * beta) * cos(2 * beta)
    low = 1 - down + 2 * exp(-2 * beta) * sin(2 * beta)
    beside = length / beta * high / low
    hoop = pressure * r / t - POISSON_RATIO * along
    return hoop / (1 + ring.area / (beside * t)) * r / (r - t / 2 - ring.width)


def needed_inertia(
    wall: Wall, length: float, ring: Ring, pressure: float, axial: float
) -> float:
    """Return the moment of inertia that a ring needs (m4) under a pressure from outside
    (Pa) and an axial force of compression (N); infinite where its edge yields."""
    r, t, e = wall.radius, wall.thickness, wall.youngs_modulus
    along = axial / (2 * pi * r * t)
    stress = edge_stress(wall, length, ring, pressure, along)
    left = wall.yield_strength / 2 - abs(stress)
    if left <= 0:
        return inf
    _, inward = section(wall, length, ring)
    r_0, edge = r - inward, t / 2 + ring.width - inward
    bent = 3 * e * edge * OUT_OF_ROUND * r / (r_0**2 * left)
    axially = max(along, 0.0) * t * r_0**4 / (500 * e * length)
    by_pressure = max(pressure, 0.0) * r * r_0**2 * length / (3 * e) * (1.5 + bent)
    return axially + by_pressure


def demand(
    wall: Wall, length: float, ring: Ring, pressure: float, axial: float
) -> float:
    """Return what a ring needs over what it has, the largest of area, moment of inertia
    and slenderness: it divides the wall up to 1."""
    slender = 0.4 * sqrt(wall.youngs_modulus / wall.yield_strength)
    inertia = needed_inertia(wall, length, ring, pressure, axial)
    return max(
        needed_area(wall, length) / ring.area,
        inertia / section(wall, length, ring)[0],
        ring.width / (slender * ring.height),
    )


def check_at(
    wall: Wall, h: float, suction: float, weight: float, more: float = 0.0
) -> float:
    """Return the unity check at an embedment (m), of suction (Pa) and weight (N),
    without stiffeners; more: what the mean pressure has beyond the suction (Pa)."""
    axial = weight + suction * wall.area_inside
    return unity_check(wall, wall.buckling_length(h), suction + more, axial)


def check_between(
    wall: Wall, h: float, suction: float, weight: float, more: float = 0.0
) -> float:
    """Return the same of the longest length between stiffeners, or what one of these
    needs over what it has, if that is more: the least of any choice of stiffeners, as
    one that is too weak counts as none."""
    axial, pressure = weight + suction * wall.area_inside, suction + more

    def check(rings: Sequence[Ring]) -> float:
        edges = [0.0, *(ring.below_lid for ring in rings), wall.buckling_length(h)]
        found = [unity_check(wall, float(max(np.diff(edges))), pressure, axial)]
        for above, ring, below in zip(edges, rings, edges[2:]):
            found.append(demand(wall, (below - above) / 2, ring, pressure, axial))
        return max(found)

    rings = wall.stiffeners_at(h)
    choices = [combinations(rings, n + 1) for n in range(len(rings))]
    return min(MANY, *(check(some) for some in chain(*choices)))


def limits_at(
    wall: Wall, h: float, weight: float, more: float = 0.0, factor: float = 1.0
) -> list[float]:
    """Return the suction (Pa) at an embedment (m) at which the unity check is 1 under
    factored loads, 0 where it is under the weight alone: without stiffeners and, where
    there are any, between them."""
    wall = wall.at(h)
    yields = wall.yield_strength * wall.thickness / wall.radius
    most, found = 2 * (yields / factor + abs(more)), []
    for check in (check_at, check_between)[: 1 + bool(wall.stiffeners_at(h))]:

        def excess(suction: float, of: Check = check) -> float:
            return of(wall, h, *(factor * x for x in (suction, weight, more))) - 1

        is_none = excess(0.0) >= 0
        found.append(0.0 if is_none else float(brentq(excess, 0.0, most, rtol=1e-6)))
    return found


def limit_suction(
    wall: Wall, h: float, weight: float, more: float = 0.0, factor: float = 1.0
) -> float:
    """Return the suction (Pa) under which the wall buckles at an embedment (m), with
    stiffeners if these suffice for a larger one."""
    return max(limits_at(wall, h, weight, more, factor))


# -------------------------------------------------- what a run computed


def net_pressure(walls: Table) -> np.ndarray:
    """Return the pressure from outside less that from inside of rows of wall.csv, with
    the pore water, [n] (Pa)."""
    outer, inner = (
        walls[f"{side}_normal_stress_Pa"] + walls.get(f"{side}_pore_pressure_Pa", 0.0)
        for side in SIDES
    )
    return np.asarray(outer - inner)


def pressures_of(run: Results, wall: Wall) -> Table:
    """Return the pressure from outside along the wall at the frames of a run with
    suction, from the lid down to the tip: columns [n], whose names have the units;
    empty without such frames."""
    walls, history = run.walls, run.history
    if "suction_Pa" not in history or not {
        f"{side}_normal_stress_Pa" for side in SIDES
    } <= set(walls):
        return {}
    parts = list[np.ndarray]()
    for time in np.unique(walls["time_s"]):
        rows = walls["time_s"] == time
        at = {name: column[rows] for name, column in walls.items()}
        order = np.argsort(at["depth_m"])
        h = float(at["penetration_m"][0])
        s = float(np.interp(time, history["time_s"], history["suction_Pa"]))
        keep = (at["depth_m"][order] > 0) & np.isfinite(net_pressure(at)[order])
        z = np.concatenate([[-wall.free_length(h), 0.0], at["depth_m"][order][keep]])
        p = np.concatenate([[s, s], net_pressure(at)[order][keep]])
        same = np.ones(len(z))
        parts.append(np.array([time * same, h * same, z, z - z[0], s * same, p]))
    names = ("time_s", "penetration_m", "depth_m", "below_lid_m", "suction_Pa")
    columns = np.concatenate(parts, axis=1)
    return dict(zip((*names, "net_external_pressure_Pa"), columns))


def beyond_suction(
    pressures: Table, wall: Wall, depth: Sequence[float] | np.ndarray
) -> np.ndarray:
    """Return what the mean pressure on the part that buckles has beyond the suction
    (Pa) at embedments [n] (m): [n], linear between the frames; 0 without any. The mean
    is weighted with the square of a half wave."""
    if not pressures:
        return np.zeros(len(depth))
    found = []
    for time in np.unique(pressures["time_s"]):
        rows = pressures["time_s"] == time
        at = {name: column[rows] for name, column in pressures.items()}
        more = at["net_external_pressure_Pa"] - at["suction_Pa"]
        h = float(at["penetration_m"][0])
        places = np.linspace(0, wall.buckling_length(h), 401)
        more = np.interp(places, at["below_lid_m"], more)
        weights = np.sin(np.linspace(0, pi, 401)) ** 2
        found.append((h, float(weights @ more / weights.sum())))
    h, more = np.array(sorted(found)).T
    return np.interp(depth, h, more)
