# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks the body forces and exact stresses of the manufactured solutions in
lab/verification against first principles, at some places and times.

Only the motion and the elastic constants are taken from here. The stress comes
from the rate law (Jaumann rate) integrated in time along the path of a point,
its divergence in the deformed state and the acceleration from differences:

    b = x_tt - J / rho0 div sigma.

`scripts/lab manufactured` prints the largest difference of each scene over the
largest value, and ends with status 1 where one exceeds 1e-4.
"""
import argparse
import math
from collections.abc import Callable, Sequence

from caisson.runner import read_parameters
from lab.checks import value_of
from lab import scene_of

Pair = tuple[float, float]
Vector = list[float]
Motion = Callable[[float, float, float], Pair]  # (r, z) at (R, Z, t)
LARGEST = 1e-4
PLACES = {
    "expanding_ring": [(0.42, -0.01), (0.5, -0.01), (0.58, -0.01)],
    "two_fields": [(0.05, -0.1), (0.4, -0.33), (0.9, -0.8)],
    "two_fields_shear": [(0.05, -0.1), (0.4, -0.33), (0.9, -0.8)],
}


def ring(R: float, Z: float, t: float) -> Pair:
    """Return where a point of expanding_ring.prm is."""
    f = 20 / 3 * R - 125 / 9 * R**2 + 250 / 27 * R**3
    return R + 0.1 * math.sin(100 * math.pi * t) * f, Z


def two_fields(R: float, Z: float, t: float) -> Pair:
    """Return where a point of two_fields.prm is."""
    s = 0.15 * math.sin(50 * t)
    return R + s * R * (1 - R * R), Z + s * math.sin(2 * math.pi * Z) / (2 * math.pi)


def shear(R: float, Z: float, t: float) -> Pair:
    """Return where a point of two_fields_shear.prm is."""
    s = 1e-6 * math.sin(50 * t)
    return (
        R + s * R * (1 - R * R) * math.cos(math.pi * Z),
        Z + s * (1 - R * R) ** 2 * math.sin(math.pi * Z),
    )


def derivative(f: Callable[[float], Sequence[float]], h: float) -> Vector:
    """Return the derivative at 0, of fourth order."""
    return [
        (8 * (b - a) - (d - c)) / (12 * h)
        for a, b, c, d in zip(f(-h), f(h), f(-2 * h), f(2 * h))
    ]


class Problem:
    """A motion in an elastic soil, and what follows from both."""

    def __init__(
        self, motion: Motion, youngs: float, nu: float, density: float, end: float
    ) -> None:
        """density: at the start; end: time (s)."""
        self.motion, self.density, self.end = motion, density, end
        self.lame = youngs * nu / (1 + nu) / (1 - 2 * nu)
        self.shear = youngs / 2 / (1 + nu)

    def gradient(self, R: float, Z: float, t: float) -> Vector:
        """Return F_rr, F_rz, F_zr, F_zz, F_tt."""
        h, motion = 1e-3, self.motion
        by_R = derivative(lambda d: motion(R + d, Z, t), h)
        by_Z = derivative(lambda d: motion(R, Z + d, t), h)
        return [by_R[0], by_Z[0], by_R[1], by_Z[1], motion(R, Z, t)[0] / R]

    def stress_rate(self, R: float, Z: float, t: float, s: Vector) -> Vector:
        """Return the Jaumann rate law's rate of rr, zz, tt, rz."""
        F = self.gradient(R, Z, t)
        G = derivative(lambda d: self.gradient(R, Z, t + d), 2e-4)
        det = F[0] * F[3] - F[1] * F[2]
        rr = (G[0] * F[3] - G[1] * F[2]) / det
        rz = (G[1] * F[0] - G[0] * F[1]) / det
        zr = (G[2] * F[3] - G[3] * F[2]) / det
        zz = (G[3] * F[0] - G[2] * F[1]) / det
        tt = G[4] / F[4]
        spin, volume = 0.5 * (rz - zr), self.lame * (rr + zz + tt)
        return [
            volume + 2 * self.shear * rr + 2 * spin * s[3],
            volume + 2 * self.shear * zz - 2 * spin * s[3],
            volume + 2 * self.shear * tt,
            self.shear * (rz + zr) + spin * (s[1] - s[0]),
        ]

    def stress(self, R: float, Z: float, t: float, n: int = 60) -> Vector:
        """Return rr, zz, tt, rz by the rate law, with n steps of Runge and Kutta."""

        def rate(time: float, s: Vector) -> Vector:
            return self.stress_rate(R, Z, time, s)

        s, dt = [0.0] * 4, t / n
        for i in range(n):
            k1 = rate(i * dt, s)
            k2 = rate((i + 0.5) * dt, [a + 0.5 * dt * b for a, b in zip(s, k1)])
            k3 = rate((i + 0.5) * dt, [a + 0.5 * dt * b for a, b in zip(s, k2)])
            k4 = rate((i + 1) * dt, [a + dt * b for a, b in zip(s, k3)])
            s = [
                a + dt / 6 * (b + 2 * c + 2 * d + e)
                for a, b, c, d, e in zip(s, k1, k2, k3, k4)
            ]
        return s

    def divergence(self, R: float, Z: float, t: float) -> Vector:
        """Return the divergence of the stress in the deformed state: r, z."""
        F, h = self.gradient(R, Z, t), 1e-2
        det = F[0] * F[3] - F[1] * F[2]
        by_R = derivative(lambda d: self.stress(R + d, Z, t), h)
        by_Z = derivative(lambda d: self.stress(R, Z + d, t), h)
        by_r = [(a * F[3] - b * F[2]) / det for a, b in zip(by_R, by_Z)]
        by_z = [(b * F[0] - a * F[1]) / det for a, b in zip(by_R, by_Z)]
        s, r = self.stress(R, Z, t), self.motion(R, Z, t)[0]
        return [by_r[0] + by_z[3] + (s[0] - s[2]) / r, by_r[3] + by_z[1] + s[3] / r]

    def body_force(self, R: float, Z: float, t: float) -> Vector:
        """Return the body force per mass that the motion needs: r, z."""
        F = self.gradient(R, Z, t)
        volume = (F[0] * F[3] - F[1] * F[2]) * F[4]
        divergence = self.divergence(R, Z, t)
        h = 2e-4 if t > 1e-3 else t / 4
        x = [self.motion(R, Z, t + k * h) for k in (-2, -1, 0, 1, 2)]
        weights = (-1, 16, -30, 16, -1)
        return [
            sum(w * place[d] for w, place in zip(weights, x)) / (12 * h * h)
            - volume / self.density * divergence[d]
            for d in (0, 1)
        ]


PROBLEMS = {
    "expanding_ring": Problem(ring, 1e7, 0.0, 1000.0, 0.015),
    "two_fields": Problem(two_fields, 1e6, 0.3, 1000.0, 0.09424778),
    "two_fields_shear": Problem(shear, 1e6, 0.3, 1000.0, 0.09424778),
}


def read_scene(name: str) -> tuple[list[str], list[tuple[str, str]]]:
    """Return the two body forces, and the checks (quantity, expression)."""
    entries = read_parameters([str(scene_of("verification", name))])
    parts = [check.split(":") for check in entries["Verification/Checks"].split(";")]
    checks = [(part[0].split()[1], part[1].strip()) for part in parts]
    return entries["Loads/Body force"].split(";"), checks


def differences(name: str) -> dict[str, float]:
    """Return the largest difference by quantity, over its largest value."""
    problem = PROBLEMS[name]
    force, checks = read_scene(name)
    pairs: dict[str, list[Pair]] = {"body force": []}
    for R, Z in PLACES[name]:
        for t in (0.3 * problem.end, 0.7 * problem.end, problem.end):
            exact = problem.body_force(R, Z, t)
            pairs["body force"] += [
                (float(value_of(force[d], R, Z, t)), exact[d]) for d in (0, 1)
            ]
        stress = problem.stress(R, Z, problem.end)
        values = dict(zip([f"stress_{c}" for c in ("rr", "zz", "tt", "rz")], stress))
        x = problem.motion(R, Z, problem.end)
        values |= {"displacement_r": x[0] - R, "displacement_z": x[1] - Z}
        for quantity, expression in checks:
            found = float(value_of(expression, R, Z, problem.end))
            pairs.setdefault(quantity, []).append((found, values[quantity]))
    return {
        what: max(abs(a - b) for a, b in of) / max(abs(b) for _, b in of)
        for what, of in pairs.items()
    }


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab manufactured`: none."""


def main(_: argparse.Namespace) -> int:
    """Check all scenes."""
    worst = 0.0
    for name in PROBLEMS:
        for what, error in differences(name).items():
            print(f"{name}: {what}: {error:.1e}")
            worst = max(worst, error)
    return 1 if worst > LARGEST else 0
