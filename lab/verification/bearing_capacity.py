# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact bearing capacity of strip and circular footings, by characteristics.

A rigid footing of half-width or radius 1 m stands on soil of Mohr-Coulomb's
law with associated flow, with cohesion c, friction angle phi and unit weight
gamma, and with a surcharge q beside it. At yield the stress follows from two
numbers: the mean p of the largest and the smallest principal stress in the
plane, and the angle psi of the largest from the vertical, towards the outside.
With R = p sin phi + c cos phi, and z downwards,

    sigma_z = p + R cos 2 psi,  sigma_r = p - R cos 2 psi,  tau = R sin 2 psi,

and around a circle sigma_t = p - R (Haar and von Karman 1909). Equilibrium then
has two families of characteristics (Sokolovskii 1965; Cox, Eason and Hopkins
1961), at the angles psi +- e from the vertical, e = 45 degrees - phi / 2:

    A, at psi + e:  cos phi dp + 2 R dpsi = -(k 2 R sin psi sin e / r
                                              + gamma sin(psi - e)) ds
    B, at psi - e:  cos phi dp - 2 R dpsi = -(k 2 R sin psi sin e / r
                                              - gamma sin(psi + e)) ds

with k = 1 for a circle and 0 for a strip. Where phi = 0 and the cohesion grows with
depth by c' per meter, the right-hand sides gain -c' cos(psi - e) ds and
-c' cos(psi + e) ds. The net is that of Martin (2005),
Exact bearing capacity calculations using the method of characteristics, Proc.
11th IACMAG, Turin: A-lines start on the surface, pass beneath the edge, where
rays of family B spread as a fan, and come up to the footing or to the ray that
bounds the soil which moves with a rough footing and meets the axis upright.

Differences are centered, so that the error is of second order in the number of
lines. The mean of R is the logarithmic one, (p2 - p1) / ln(p2 / p1): this keeps
both the passive zone under weight and the fan without weight exact.

SI units, angles in degrees at the interface and in radians inside; stresses are
positive in compression.
"""
import argparse
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import cos, exp, isnan, log, pi, radians, sin, tan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Footing:
    """A footing of half-width or radius 1 m, and the soil under it."""

    phi: float  # friction angle (degrees)
    circular: bool
    rough: bool
    cohesion: float = 0.0  # Pa
    surcharge: float = 0.0  # Pa
    weight: float = 0.0  # of the soil (N/m3)
    gradient: float = 0.0  # of the cohesion over depth, where phi = 0 (Pa/m)

    @property
    def friction(self) -> float:
        """The friction angle in radians."""
        return radians(self.phi)

    @property
    def between(self) -> float:
        """The angle e between the largest stress and a characteristic."""
        return pi / 4 - self.friction / 2

    @property
    def shift(self) -> float:
        """c cot phi, which is added to p so that R = p sin phi; 0 in clay."""
        return self.cohesion / tan(self.friction) if self.phi > 0 else 0.0

    @property
    def surface_p(self) -> float:
        """p + c cot phi at the free surface, where psi = 90 degrees."""
        if self.phi == 0:
            return self.surcharge + self.cohesion
        return (self.surcharge + self.shift) / (1 - sin(self.friction))

    def radius(self, p: Array, z: Array) -> Array:
        """Return R where the shifted p is this."""
        if self.phi == 0:
            return self.cohesion + self.gradient * z
        return p * sin(self.friction)

    def mean_radius(self, p: Array, q: Array, z: Array) -> Array:
        """Return the logarithmic mean of R; z: the mean depth."""
        if self.phi == 0:
            return self.cohesion + self.gradient * z
        x = np.log(np.maximum(q / p, 1e-300))  # below 0 only while iterating
        small = np.abs(x) < 1e-3
        mean = (q - p) / np.where(small, 1.0, x)
        near = 0.5 * (p + q) * (1 - x * x / 12)
        return np.where(small, near, mean) * sin(self.friction)

    def fan_p(self, psi: Array) -> Array:
        """Return the shifted p at the edge, where rays leave with psi."""
        turn = pi / 2 - psi
        if self.phi == 0:
            return self.surface_p + 2 * self.cohesion * turn
        return self.surface_p * np.exp(2 * tan(self.friction) * turn)


class Front(NamedTuple):
    """Points of the net, each field [n]: place (m), shifted p (Pa), psi."""

    r: Array
    z: Array
    p: Array
    psi: Array

    def part(self, which: slice) -> "Front":
        """Return some of the points, as views."""
        return Front(*(field[which] for field in self))

    def copy(self) -> "Front":
        """Return the points with fields of their own."""
        return Front(*(field.copy() for field in self))


def meeting(
    footing: Footing, a: Front, b: Front, p: Array, psi: Array
) -> tuple[Array, Array, Array, Array]:
    """Return where lines from a and b meet if p and psi are these there, and
    what is left of the equations along both lines (Pa)."""
    e, c = footing.between, cos(footing.friction)
    psi_a, psi_b = 0.5 * (a.psi + psi), 0.5 * (b.psi + psi)
    sin_a, cos_a = np.sin(psi_a + e), np.cos(psi_a + e)
    sin_b, cos_b = np.sin(psi_b - e), np.cos(psi_b - e)
    across_a = a.r * cos_a - a.z * sin_a
    across_b = b.r * cos_b - b.z * sin_b
    det = cos_b * sin_a - cos_a * sin_b
    r = (across_b * sin_a - across_a * sin_b) / det
    z = (across_b * cos_a - across_a * cos_b) / det
    ds_a = (r - a.r) * sin_a + (z - a.z) * cos_a
    ds_b = (r - b.r) * sin_b + (z - b.z) * cos_b
    turn_a, turn_b = 2 * (psi - a.psi), 2 * (psi - b.psi)
    if footing.circular:
        turn_a = turn_a + 4 * sin(e) * np.sin(psi_a) / (a.r + r) * ds_a
        turn_b = turn_b - 4 * sin(e) * np.sin(psi_b) / (b.r + r) * ds_b
    radius_a = footing.mean_radius(a.p, p, 0.5 * (a.z + z))
    radius_b = footing.mean_radius(b.p, p, 0.5 * (b.z + z))
    left_a = c * (p - a.p) + radius_a * turn_a
    left_b = c * (p - b.p) - radius_b * turn_b
    if footing.weight > 0:
        left_a = left_a + footing.weight * np.sin(psi_a - e) * ds_a
        left_b = left_b - footing.weight * np.sin(psi_b + e) * ds_b
    if footing.gradient > 0:
        left_a = left_a + footing.gradient * np.cos(psi_a - e) * ds_a
        left_b = left_b + footing.gradient * np.cos(psi_b + e) * ds_b
    return r, z, left_a, left_b


def bounded(x: Array, low: float, high: float) -> Array:
    """Return x within bounds: numpy's clip, which takes longer for few numbers."""
    return np.minimum(np.maximum(x, low), high)


def next_points(footing: Footing, a: Front, b: Front) -> Front:
    """Return the points that A-lines from a and B-lines from b meet in.

    Newton's method for p and psi. A point is nan where a line has passed the
    axis.
    """
    distance = np.hypot(a.r - b.r, a.z - b.z)
    p = 0.5 * (a.p + b.p) + 0.5 * footing.weight * distance
    psi = 0.5 * (a.psi + b.psi)
    small = 1e-7
    # at the point, and with a small change of p and of psi: all at once
    of_p, of_psi = np.array([[1], [1 + small], [1]]), np.array([[0], [0], [small]])
    for _ in range(40):
        _, _, at_a, at_b = meeting(footing, a, b, p * of_p, psi + of_psi)
        (left_a, p_a, psi_a), (left_b, p_b, psi_b) = at_a, at_b
        p_a, p_b = (p_a - left_a) / small, (p_b - left_b) / small
        psi_a, psi_b = (psi_a - left_a) / small, (psi_b - left_b) / small
        det = p_a * psi_b - p_b * psi_a
        change = bounded((psi_a * left_b - psi_b * left_a) / det, -0.7, 2.0)
        turn = bounded((p_b * left_a - p_a * left_b) / det, -0.3, 0.3)
        p, psi = p * (1 + change), psi + turn
        largest = np.fmax.reduce(np.abs((change, turn)), axis=None, initial=0.0)
        if not largest > 1e-7:
            break  # the change after it is of the order of its square
    r, z, _, _ = meeting(footing, a, b, p, psi)
    lost = ~((r > 0) & np.isfinite(p) & np.isfinite(psi))
    return Front(*(np.where(lost, np.nan, x) for x in (r, z, p, psi)))


def point_on_base(footing: Footing, a: Front, psi: float) -> Front:
    """Return where the A-line from the one point a meets the footing."""
    e = footing.between
    middle = 0.5 * (a.psi + psi)
    r = a.r - a.z * np.tan(middle + e)
    ds = (r - a.r) * np.sin(middle + e) - a.z * np.cos(middle + e)
    turn = 2 * (psi - a.psi)
    if footing.circular:
        turn = turn + 4 * sin(e) * np.sin(middle) / (a.r + r) * ds
    weight = footing.weight * np.sin(middle - e) * ds
    weight = weight + footing.gradient * np.cos(middle - e) * ds
    p = a.p
    for _ in range(80):
        radius = footing.mean_radius(a.p, p, 0.5 * a.z)
        new = a.p - (radius * turn + weight) / cos(footing.friction)
        done = not abs(new[0] / p[0] - 1) > 1e-14
        p = new
        if done:
            break
    lost = ~((r > 0) & (p > 0))
    fields = (r, np.zeros(1), p, np.full(1, psi))
    return Front(*(np.where(lost, np.nan, x) for x in fields))


class Net(NamedTuple):
    """The points of the net that bound the soil beneath the footing."""

    base: Front  # on the footing, from the edge to the axis
    ray: Front  # on the last ray of the fan, from the footing to the axis


def join(points: list[Front]) -> Front:
    """Return all points in one, up to the first that is lost."""
    fields = [np.concatenate(field) for field in zip(*points, strict=True)]
    n = next((i for i, r in enumerate(fields[0]) if isnan(r)), len(fields[0]))
    return Front(*(field[:n] for field in fields))


def build_net(footing: Footing, surface: Array, fan: Array, n_base: int) -> Net:
    """Build the net of the A-lines from these places of the surface.

    surface: distances from the edge (m), from 0 on; fan: psi of the rays at the
    edge, from 90 degrees on. The first n_base lines end on the footing, where
    psi is that of the last ray; they emit further rays. The others end on the
    last of all rays.

    Point (i, j) is on line i and ray j; the rays of the surface have j <= 0.
    It follows from (i, j - 1) and (i - 1, j), so that points with the same
    i + j do not depend on each other.
    """
    n, n_fan = len(surface) - 1, len(fan) - 1
    last = n_fan + n_base
    edge_p = footing.fan_p(fan)
    front = Front(
        1 + surface,
        np.zeros(n + 1),
        np.full(n + 1, footing.surface_p),
        np.full(n + 1, pi / 2),
    ).copy()

    def edge(j: int) -> Front:
        fields = (1.0, 0.0, float(edge_p[j]), float(fan[j]))
        return Front(*(np.full(1, x) for x in fields))

    base, ray = [edge(n_fan)], [edge(n_fan)] if n_base == 0 else []
    for wave in range(1, n + max(last, n_fan + n_base) + 1):
        # lines that have ended: on the footing, or on the last ray
        first = max(1, -((n_fan - wave) // 2), wave - last)
        if first > n:
            break
        old = front.part(slice(first - 1, n)).copy()
        if first == 1 and wave - 1 <= n_fan:
            for field, value in zip(old, edge(wave - 1), strict=True):
                field[:1] = value
        if wave - first == n_fan + first and first <= n_base:
            here = front.part(slice(first, first + 1))
            base.append(point_on_base(footing, here, float(fan[-1])))
            for field, value in zip(here, base[-1], strict=True):
                field[:] = value
            if first == n_base:
                ray.append(base[-1])
            if isnan(base[-1].r[0]):
                break  # the lines after it pass the axis, too
            old, first = old.part(slice(1, None)), first + 1
        here = front.part(slice(first, n + 1))
        if len(here.r) == 0:
            continue
        for field, value in zip(here, next_points(footing, here, old), strict=True):
            field[:] = value
        if wave - first == last and first > n_base:
            ray.append(here.part(slice(0, 1)).copy())
            if isnan(ray[-1].r[0]):
                break
    return Net(join(base), join(ray) if ray else join(base[:1]))


def spread(n: int, length: float, finest: float) -> Array:
    """Return n + 1 places from 0 to length (m): with steps that grow from the
    finest in proportion to the distance, and equal steps in the end."""
    if finest >= length:
        return np.linspace(0, length, n + 1)
    place = np.append(0, np.geomspace(1e-3 * finest, length, 4000))
    share = np.log1p(place / finest) / log(1 + length / finest) + place / length
    return np.interp(np.linspace(0, 1, n + 1), share / 2, place)


def integral(weight: Array, x: Array) -> float:
    """Return the integral of weight dx by the trapezoidal rule."""
    return float(np.sum(0.5 * (weight[1:] + weight[:-1]) * np.diff(x)))


def load_on_base(footing: Footing, base: Front) -> float:
    """Return the load on this part of the footing, per pi or per half strip."""
    normal = base.p - footing.shift
    normal = normal + footing.radius(base.p, base.z) * np.cos(2 * base.psi)
    return -integral(normal * (2 * base.r if footing.circular else 1.0), base.r)


def load_on_ray(footing: Footing, ray: Front) -> float:
    """Return what the soil below a ray bears, less the soil above it."""
    radius = footing.radius(ray.p, ray.z)
    vertical = ray.p - footing.shift + radius * np.cos(2 * ray.psi)
    shear = radius * np.sin(2 * ray.psi)
    ring = 2 * ray.r if footing.circular else np.ones_like(ray.r)
    borne = integral(shear * ring, ray.z) - integral(vertical * ring, ray.r)
    return borne + footing.weight * integral(ray.z * ring, ray.r)


def to_the_axis(footing: Footing, ray: Front) -> Front:
    """Return the ray up to the axis, where the largest stress is upright.

    A ray whose start is a little off leaves the solution near the axis: it is
    followed while psi grows towards 0. Raises ValueError where it ends before.
    """
    if not (ray.r < 0.15).any():
        raise ValueError("the net does not reach the axis: take a longer surface")
    near = np.where(ray.r < 0.15, ray.psi, -np.inf)
    ray = Front(*(x[: int(np.argmax(near)) + 1] for x in ray))
    depth = ray.z[-1] + ray.r[-1] / tan(footing.between - ray.psi[-1] / 2)
    end = (0.0, depth, ray.p[-1], 0.0)
    return Front(*(np.append(x, y) for x, y in zip(ray, end, strict=True)))


class Mesh(NamedTuple):
    """How fine a net is."""

    lines: int
    length: float  # of the surface that A-lines start from (m)
    finest: float  # first step on the surface (m)


def smooth_pressure(footing: Footing, mesh: Mesh) -> float:
    """Return the mean pressure on a smooth footing (Pa)."""
    fan = np.linspace(pi / 2, 0, mesh.lines // 2 + 1)
    base = build_net(footing, spread(*mesh), fan, mesh.lines).base
    if len(base.r) > mesh.lines:
        raise ValueError("the net does not reach the axis: take a longer surface")
    # on the last bit to the axis, p is linear in the area
    x = base.r**2 if footing.circular else base.r
    p = base.p[-1] + (base.p[-1] - base.p[-2]) / (x[-2] - x[-1]) * x[-1]
    end = (0.0, 0.0, p, 0.0)
    return load_on_base(
        footing, Front(*(np.append(f, g) for f, g in zip(base, end, strict=True)))
    )


class RoughNet:
    """Nets under a rough footing, of which one has a ray that ends upright.

    That ray bounds the soil that moves with the footing. It starts at the edge,
    with a psi to be found; if even the ray along the footing turns upright too
    early, it starts at a point of the footing, up to which the soil slips.
    """

    def __init__(self, footing: Footing, mesh: Mesh) -> None:
        """mesh: its number of lines is divided in two if soil slips."""
        self.footing, self.mesh = footing, mesh
        self.along = -(pi / 4 + footing.friction / 2)  # psi of that ray

    def from_edge(self, psi: float) -> Net:
        """Return the net whose last ray leaves the edge with this psi."""
        fan = np.linspace(pi / 2, psi, self.mesh.lines // 2 + 1)
        return build_net(self.footing, spread(*self.mesh), fan, 0)

    def from_base(self, length: float) -> Net:
        """Return the net in which the lines of this length of surface end on
        the footing."""
        n, n_base = self.mesh.lines, self.mesh.lines // 2
        first = spread(n_base, length, self.mesh.finest)
        rest = spread(n - n_base, self.mesh.length - length, 2 * length / n_base)
        fan = np.linspace(pi / 2, self.along, n // 2 + 1)
        surface = np.append(first, length + rest[1:])
        return build_net(self.footing, surface, fan, n_base)

    @staticmethod
    def turns_upright_early(net: Net) -> bool:
        """Whether psi becomes 0 before the axis."""
        return bool((net.ray.psi > 0).any())

    def find(self) -> Net:
        """Return the net whose last ray turns upright on the axis."""
        if self.turns_upright_early(self.from_edge(self.along)):
            low, high = log(self.mesh.finest), log(0.99 * self.mesh.length)
            return self.bisect(lambda x: self.from_base(exp(x)), high, low)
        return self.bisect(self.from_edge, self.along, 0.3)

    def bisect(self, make: Callable[[float], Net], late: float, early: float) -> Net:
        """Return the last net that does not turn upright early, within 1e-6 of
        the one that does not at all; this moves the load by 1e-8."""
        found = None
        while abs(early - late) > 1e-6:
            middle = 0.5 * (early + late)
            net = make(middle)
            if self.turns_upright_early(net):
                early = middle
            else:
                late, found = middle, net
        if found is None or len(found.ray.r) < 3:
            raise ValueError("no net meets the axis: take a longer surface")
        return found

    def pressure(self) -> float:
        """Return the mean pressure on the footing (Pa)."""
        net = self.find()
        load = load_on_ray(self.footing, to_the_axis(self.footing, net.ray))
        return load + load_on_base(self.footing, net.base)


def pressure(footing: Footing, n_lines: int) -> float:
    """Return the mean pressure that the footing bears (Pa), with this many
    lines of the net."""
    mesh = Mesh(n_lines, surface_length(footing), np.inf)
    if footing.weight > 0:
        finest = footing.surface_p / footing.weight
        mesh = mesh._replace(finest=finest)
    if footing.gradient > 0:
        mesh = mesh._replace(finest=min(footing.cohesion / footing.gradient, 1.0))
    if footing.rough:
        return RoughNet(footing, mesh).pressure()
    return smooth_pressure(footing, mesh)


def surface_length(footing: Footing) -> float:
    """Return a length of the surface that is long enough (m)."""
    e = footing.between
    half = exp(pi / 2 * tan(footing.friction)) / tan(e)  # Prandtl, smooth strip
    # weight makes the net smaller, where it is much of the load
    share = 0.6 if footing.weight > 10 * footing.surface_p else 1.0
    if footing.circular:
        share *= 0.75
    if footing.rough:
        share *= 2.0
    return 1.05 * share * half


def converged(footing: Footing, n_lines: int) -> float:
    """Return the pressure of nets with n_lines / 2 and n_lines lines,
    extrapolated with the second order of the differences (Pa)."""
    coarse, fine = pressure(footing, n_lines // 2), pressure(footing, n_lines)
    return fine + (fine - coarse) / 3


SMALL = 1e-6  # surcharge over gamma R that stands for none


def factors(
    footing: Footing, n_lines: int, with_weight: bool = True
) -> dict[str, float]:
    """Return Nc, Nq and Ngamma of a footing without loads. The pressure is c Nc
    in weightless soil without surcharge, q Nq in weightless soil without
    cohesion, and gamma R Ngamma in soil that has nothing but weight, where R is
    the radius or the half-width."""
    if footing.phi == 0:
        nc = converged(replace(footing, cohesion=1.0), n_lines)
        return {"Nc": nc, "Nq": 1.0, "Ngamma": 0.0}
    nq = converged(replace(footing, surcharge=1.0), n_lines)
    # by Caquot, cohesion is a pressure c cot phi on all sides
    found = {"Nc": (nq - 1) / tan(footing.friction), "Nq": nq}
    if with_weight:
        heavy = replace(footing, surcharge=SMALL, weight=1.0)
        found["Ngamma"] = converged(heavy, n_lines)
    return found


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of scripts/lab capacity."""
    parser.add_argument(
        "--phi", type=float, nargs="+", default=[30], help="friction angles (degrees)"
    )
    parser.add_argument(
        "--lines", type=int, default=200, help="lines of the finest net (none)"
    )
    parser.add_argument(
        "--without-weight", action="store_true", help="leave out Ngamma, which is slow"
    )


def main(options: argparse.Namespace) -> int:
    """Print the factors of strip and circle, smooth and rough."""
    print("  phi  footing             Nc          Nq      Ngamma")
    for phi in options.phi:
        for circular in (False, True):
            for rough in (False, True):
                footing = Footing(phi, circular, rough)
                found = factors(footing, options.lines, not options.without_weight)
                name = f"{'circle' if circular else 'strip'}, "
                name += "rough" if rough else "smooth"
                columns = "".join(
                    f"{found[key]:12.4f}" if key in found else f"{'-':>12}"
                    for key in ("Nc", "Nq", "Ngamma")
                )
                print(f"{phi:5g}  {name:14}{columns}", flush=True)
    return 0
