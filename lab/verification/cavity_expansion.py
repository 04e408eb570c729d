# SPDX-License-Identifier: LGPL-2.1-or-later
"""Expansion of a cylindrical cavity in plane strain, from a0 to a, and the contraction
that follows.

Mohr-Coulomb: Yu and Houlsby (1991), Finite cavity expansion in dilatant soils:
loading analysis, Geotechnique 41, 173-183, doi:10.1680/geot.1991.41.2.173:
small strains in the elastic part, large ones in the plastic, sigma_zz
intermediate. Contraction: derived here for small strains, about the stress that the
expansion has left. Tresca: an incompressible soil, elastic beyond the plastic radius.

SI units, angles in degrees; pressures positive in compression.
"""
import argparse
from math import cos, exp, inf, log, radians, sin
from pathlib import Path
from typing import Protocol

import numpy as np
from scipy.integrate import trapezoid
from scipy.optimize import brentq

from caisson.results import Table, read_table


class Cavity(Protocol):
    """A soil with the exact pressure in the cavity."""

    def pressure(self, ratio: float) -> float:
        """Return the pressure at this a / a0."""

    def contracted(self, pressure: float, share: float) -> float:
        """Return the pressure after a contraction by a share of the radius, from the
        pressure of the expansion."""


class MohrCoulomb:
    """The solution of Yu and Houlsby; its symbols are those of the paper."""

    def __init__(
        self,
        p0: float,
        youngs: float,
        nu: float,
        cohesion: float,
        phi: float,
        psi: float,
    ) -> None:
        """p0: pressure in the undisturbed soil; youngs, nu: elastic; phi, psi:
        friction and dilatancy angle."""
        phi, psi = radians(phi), radians(psi)
        alpha = (1 + sin(phi)) / (1 - sin(phi))
        beta = (1 + sin(psi)) / (1 - sin(psi))
        self.p0, self.alpha, self.beta = p0, alpha, beta
        self.shear, self.nu = youngs / (2 * (1 + nu)), nu
        self.strength = 2 * cohesion * cos(phi) / (1 - sin(phi))
        load = self.strength + (alpha - 1) * p0
        self.delta = load / (2 * (1 + alpha) * self.shear)
        self.gamma = alpha * (beta + 1) / ((alpha - 1) * beta)
        self.eta = exp(
            (beta + 1) * (1 - 2 * nu) * (1 + nu) * load / (youngs * (alpha - 1) * beta)
        )
        self.xi = (
            (1 - nu**2)
            * 2
            * self.delta
            / ((1 + nu) * (alpha - 1) * beta)
            * (alpha * beta + 1 - nu * (alpha + beta) / (1 - nu))
        )

    def ratio(self, pressure: float) -> float:
        """Return a / a0 at this pressure beyond first yield; inf above the limit."""
        load = self.strength + (self.alpha - 1) * pressure
        r = (
            (1 + self.alpha)
            * load
            / (2 * self.alpha * (self.strength + (self.alpha - 1) * self.p0))
        )
        total, factor = 0.0, 1.0
        for n in range(80):
            factor *= self.xi / n if n > 0 else 1.0
            power = n - self.gamma
            total += factor * (
                log(r) if abs(power) < 1e-9 else (r**power - 1) / power
            )
        exponent = (self.beta + 1) / self.beta
        rest = (1 - self.delta) ** exponent - self.gamma / self.eta * total
        if rest <= 0:
            return inf
        return (r**-self.gamma / rest) ** (1 / exponent)

    def pressure(self, ratio: float) -> float:
        """Return the pressure at this a / a0."""
        yields = self.p0 + 2 * self.shear * self.delta
        if ratio <= self.ratio(yields):  # elastic, small strain
            return self.p0 + 2 * self.shear * (ratio - 1)
        low, high = yields, 2 * yields
        while self.ratio(high) < ratio:
            high *= 2
        for _ in range(200):
            middle = (low + high) / 2
            low, high = (middle, high) if self.ratio(middle) < ratio else (low, middle)
        return low

    def contracted(self, pressure: float, share: float) -> float:
        """Return the pressure after a contraction by a share of the radius, from the
        pressure of the expansion, where the whole way is within its plastic zone.

        With c cot(phi) added to all stresses, sigma_r = p (a/r)^(1 - 1/alpha) and
        sigma_t = sigma_r/alpha at first. The soil unloads elastically, by -A/r^2 and
        A/r^2, until sigma_t = alpha sigma_r; inside a radius R it then yields again:
        sigma_r grows as r^(alpha - 1), and u' + beta u/r is that of elastic strains.
        """
        shift = self.strength / (self.alpha - 1)
        alpha, beta, start = self.alpha, self.beta, pressure + shift

        def state(radius: float) -> tuple[float, float]:
            """Return pressure and share where soil yields again to radius/a."""
            r = np.linspace(1, radius, 2001)
            before = start * r ** (1 / alpha - 1)
            now = before[-1] / alpha * (r / radius) ** (alpha - 1)
            radial, around = now - before, alpha * now - before / alpha
            # compression positive, sigma_zz = nu (sigma_r + sigma_t) beyond its start
            mean = self.nu * (radial + around)
            strain = (radial - mean + beta * (around - mean)) / (2 * self.shear)
            edge = before[-1] * (1 - 1 / alpha) / (2 * self.shear)
            inward = edge * radius ** (beta + 1) - trapezoid(strain * r**beta, r)
            return float(now[0]) - shift, float(inward)

        if share <= start * (1 - 1 / alpha) / (2 * self.shear):
            return pressure - 2 * self.shear * share
        radius = brentq(lambda x: state(x)[1] - share, 1, 100)
        return state(radius)[0]


class Tresca:
    """Incompressible: p - p0 = su (1 + ln(G/su (1 - (a0/a)^2)))."""

    def __init__(self, p0: float, shear: float, strength: float) -> None:
        """shear: modulus; strength: undrained."""
        self.p0, self.shear, self.strength = p0, shear, strength

    def pressure(self, ratio: float) -> float:
        """Return the pressure at this a / a0."""
        strain = self.shear / self.strength * (1 - ratio**-2)
        elastic = strain <= 1  # logarithmic strain, to its first order
        return self.p0 + self.strength * (strain if elastic else 1 + log(strain))

    def contracted(self, pressure: float, share: float) -> float:
        """Return the pressure after a contraction; see MohrCoulomb."""
        strain = self.shear / self.strength * share
        change = strain if strain <= 1 else 1 + log(strain)
        return pressure - 2 * self.strength * change


def comparison(history: Table, soil: Cavity, radius: float) -> list[list[float]]:
    """Return the rows a/a0, pressure computed, exact, and their difference (a
    share of the exact one).

    history: of a cylinder of this radius a0 that grows, and may shrink at last.
    """
    growth = history["penetration_m"]
    widest = 1 + growth.max() / radius
    rows = []
    # a row is the mean since the row before
    for i, found in enumerate(history["cavity_pressure_Pa"][1:]):
        ratio = 1 + 0.5 * (growth[i] + growth[i + 1]) / radius
        exact = soil.pressure(ratio)
        if i + 1 > growth.argmax():
            exact = soil.contracted(soil.pressure(widest), log(widest / ratio))
        rows.append([ratio, float(found), exact, float(found / exact - 1)])
    return rows


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab cavity-expansion`."""
    parser.add_argument("history", type=Path, help="history.csv of a run")
    parser.add_argument("--radius", type=float, default=0.5, help="a0 (m)")
    parser.add_argument("--p0", type=float, default=1e5, help="Pa")
    parser.add_argument("--youngs", type=float, default=13e6, help="Pa")
    parser.add_argument("--nu", type=float, default=0.3)
    parser.add_argument("--phi", type=float, default=30, help="degrees")
    parser.add_argument("--psi", type=float, default=0, help="degrees")
    parser.add_argument("--cohesion", type=float, default=0, help="Pa")
    parser.add_argument("--su", type=float, default=0, help="Pa: Tresca's law")


def main(options: argparse.Namespace) -> int:
    """Print the pressure of a run beside the exact one, row by row."""
    soil: Cavity = MohrCoulomb(
        options.p0,
        options.youngs,
        options.nu,
        options.cohesion,
        options.phi,
        options.psi,
    )
    if options.su > 0:
        shear = options.youngs / (2 + 2 * options.nu)
        soil = Tresca(options.p0, shear, options.su)
    print("    a/a0    computed/p0    exact/p0   difference")
    history = read_table(options.history)
    for ratio, found, exact, error in comparison(history, soil, options.radius):
        print(
            f"{ratio:8.4f} {found / options.p0:14.4f} {exact / options.p0:11.4f}"
            f" {100 * error:10.2f} %"
        )
    return 0
