# SPDX-License-Identifier: LGPL-2.1-or-later
"""Expansion of a cylindrical cavity in plane strain, from a0 to a.

Mohr-Coulomb: Yu and Houlsby (1991), Finite cavity expansion in dilatant soils:
loading analysis, Geotechnique 41, 173-183, doi:10.1680/geot.1991.41.2.173:
small strains in the elastic part, large ones in the plastic, sigma_zz
intermediate. Tresca: an incompressible soil, elastic beyond the plastic radius.

Usage: cavity_expansion.py          checks itself against four limit pressures
       cavity_expansion.py HISTORY ...   compares cavity_pressure_Pa of a run
                                    with the exact pressure, row by row
SI units, angles in degrees; pressures positive in compression.
"""
import argparse
import csv
import sys
from math import cos, exp, inf, log, radians, sin


class MohrCoulomb:
    def __init__(self, p0, youngs, nu, cohesion, phi, psi):
        phi, psi = radians(phi), radians(psi)
        alpha = (1 + sin(phi)) / (1 - sin(phi))
        beta = (1 + sin(psi)) / (1 - sin(psi))
        self.p0, self.alpha, self.beta = p0, alpha, beta
        self.shear = youngs / (2 * (1 + nu))
        self.strength = 2 * cohesion * cos(phi) / (1 - sin(phi))
        load = self.strength + (alpha - 1) * p0
        self.delta = load / (2 * (1 + alpha) * self.shear)
        self.gamma = alpha * (beta + 1) / ((alpha - 1) * beta)
        self.eta = exp((beta + 1) * (1 - 2 * nu) * (1 + nu) * load /
                       (youngs * (alpha - 1) * beta))
        self.xi = ((1 - nu ** 2) * 2 * self.delta /
                   ((1 + nu) * (alpha - 1) * beta) *
                   (alpha * beta + 1 - nu * (alpha + beta) / (1 - nu)))

    def ratio(self, pressure):
        """a / a0 at this pressure beyond first yield; inf above the limit."""
        load = self.strength + (self.alpha - 1) * pressure
        r = ((1 + self.alpha) * load /
             (2 * self.alpha * (self.strength + (self.alpha - 1) * self.p0)))
        total, factor = 0.0, 1.0
        for n in range(80):
            factor *= self.xi / n if n > 0 else 1.0
            power = n - self.gamma
            total += factor * (log(r) if abs(power) < 1e-9 else
                               (r ** power - 1) / power)
        exponent = (self.beta + 1) / self.beta
        rest = ((1 - self.delta) ** exponent -
                self.gamma / self.eta * total)
        if rest <= 0:
            return inf
        return (r ** -self.gamma / rest) ** (1 / exponent)

    def pressure(self, ratio):
        """The pressure at this a / a0."""
        yields = self.p0 + 2 * self.shear * self.delta
        if ratio <= self.ratio(yields):  # elastic, small strain
            return self.p0 + 2 * self.shear * (ratio - 1)
        low, high = yields, 2 * yields
        while self.ratio(high) < ratio:
            high *= 2
        for _ in range(200):
            middle = (low + high) / 2
            low, high = ((middle, high) if self.ratio(middle) < ratio else
                         (low, middle))
        return low


class Tresca:
    """Incompressible: p - p0 = su (1 + ln(G/su (1 - (a0/a)^2)))."""

    def __init__(self, p0, shear, strength):
        self.p0, self.shear, self.strength = p0, shear, strength

    def pressure(self, ratio):
        strain = self.shear / self.strength * (1 - ratio ** -2)
        elastic = strain <= 1  # logarithmic strain, to its first order
        return self.p0 + self.strength * (strain if elastic else
                                          1 + log(strain))


def check():
    """Against limit pressures over p0, computed independently."""
    table = {(50, 0): 6.312, (50, 30): 11.641,
             (100, 0): 7.914, (100, 30): 16.194}
    return max(abs(MohrCoulomb(1, 2.6 * stiffness, .3, 0, 30, psi)
                   .pressure(1e9) / limit - 1)
               for (stiffness, psi), limit in table.items())


def compare(arguments):
    if arguments.su > 0:
        exact = Tresca(arguments.p0, arguments.youngs / (2 + 2 * arguments.nu),
                       arguments.su)
    else:
        exact = MohrCoulomb(arguments.p0, arguments.youngs, arguments.nu,
                            arguments.cohesion, arguments.phi, arguments.psi)
    with open(arguments.history, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    print("    a/a0    computed/p0    exact/p0   difference")
    for before, row in zip(rows, rows[1:]):
        growth = .5 * (float(before["penetration_m"]) +
                       float(row["penetration_m"]))  # forces are means
        ratio = 1 + growth / arguments.radius
        found = float(row["cavity_pressure_Pa"])
        value = exact.pressure(ratio)
        print(f"{ratio:8.4f} {found / arguments.p0:14.4f} "
              f"{value / arguments.p0:11.4f} {100 * (found / value - 1):10.2f} %")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("history", nargs="?", help="history.csv of a run")
    parser.add_argument("--radius", type=float, default=.5, help="a0")
    parser.add_argument("--p0", type=float, default=1e5)
    parser.add_argument("--youngs", type=float, default=13e6)
    parser.add_argument("--nu", type=float, default=.3)
    parser.add_argument("--phi", type=float, default=30)
    parser.add_argument("--psi", type=float, default=0)
    parser.add_argument("--cohesion", type=float, default=0)
    parser.add_argument("--su", type=float, default=0, help="Tresca's law")
    arguments = parser.parse_args()
    if arguments.history:
        compare(arguments)
        return 0
    difference = check()
    print(f"Cavity expansion: {'OK' if difference < 2e-4 else 'FAILED'} "
          f"(largest difference {100 * difference:.3f} %)")
    return 0 if difference < 2e-4 else 1


if __name__ == "__main__":
    sys.exit(main())
