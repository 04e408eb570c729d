# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance of a caisson that is pushed into sand.

Houlsby and Byrne (2005), Design procedures for installation of suction
caissons in sand, doi:10.1680/geng.2005.158.3.135. Plain: vertical stress
gamma' z beside the wall. Enhanced: the friction on the wall adds to the
vertical stress beside it, inside over the whole plug, outside out to m times
the radius. The tip is a strip footing under the (unequal) stress of both
sides.

Run as a program, it checks itself against values computed independently.
SI units, angles in degrees.
"""
import sys
from math import exp, pi, radians, tan

# N_gamma of a rough strip footing by the method of characteristics (Martin
# 2005, Exact bearing capacity calculations using the method of
# characteristics): {friction angle in degrees: N_gamma}.
N_GAMMA = {15: 1.181, 20: 2.839, 25: 6.491, 30: 14.754, 35: 34.476,
           40: 85.566, 45: 234.21}


def bearing_factor_surcharge(phi):
    """N_q of a strip footing (Reissner 1924)."""
    return exp(pi * tan(radians(phi))) * tan(radians(45 + phi / 2)) ** 2


def bearing_factor_weight(phi):
    """N_gamma; 0, on the safe side, outside the table of 15 to 45 degrees.

    Between two entries N_gamma / ((N_q - 1) tan(phi)), which hardly changes
    with phi, is interpolated.
    """
    def scale(angle):
        return (bearing_factor_surcharge(angle) - 1) * tan(radians(angle))
    if phi in N_GAMMA:
        return N_GAMMA[phi]
    below = [angle for angle in N_GAMMA if angle < phi]
    above = [angle for angle in N_GAMMA if angle > phi]
    if not below or not above:
        return 0.0
    low, high = max(below), min(above)
    weight = (phi - low) / (high - low)
    ratio = ((1 - weight) * N_GAMMA[low] / scale(low) +
             weight * N_GAMMA[high] / scale(high))
    return ratio * scale(phi)


class Caisson:
    """The resistance of one caisson; h is the embedment of its tip."""

    def __init__(self, diameter, wall_thickness, unit_weight, friction_angle,
                 wall_friction_angle, lateral_stress_ratio, spread=1.5):
        self.outer, self.t = diameter, wall_thickness
        self.inner = diameter - 2 * wall_thickness
        self.weight = unit_weight
        self.n_q = bearing_factor_surcharge(friction_angle)
        self.n_gamma = bearing_factor_weight(friction_angle)
        self.k_tan = lateral_stress_ratio * tan(radians(wall_friction_angle))
        # The depths over which the stress grows by the factor e.
        self.z_inner = self.inner / (4 * self.k_tan)
        self.z_outer = self.outer * (spread ** 2 - 1) / (4 * self.k_tan)

    def _stress(self, h, z):
        return self.weight * z * (exp(h / z) - 1)

    def _friction(self, h, diameter, z, enhanced):
        integral = z ** 2 * (exp(h / z) - 1 - h / z) if enhanced else h ** 2 / 2
        return self.weight * integral * self.k_tan * pi * diameter

    def inner_friction(self, h, enhanced):
        return self._friction(h, self.inner, self.z_inner, enhanced)

    def outer_friction(self, h, enhanced):
        return self._friction(h, self.outer, self.z_outer, enhanced)

    def tip(self, h, enhanced):
        """The force on the tip, with a flat end of the wall."""
        low = high = self.weight * h
        if enhanced:
            low, high = sorted([self._stress(h, self.z_inner),
                                self._stress(h, self.z_outer)])
        x = self.t  # the part of the tip where the soil flows to the low side
        if self.n_gamma > 0:
            x = self.t / 2 + (high - low) * self.n_q / (
                4 * self.weight * self.n_gamma)
        if high > low and x >= self.t:
            end = low * self.n_q + self.weight * self.t * self.n_gamma
        else:
            end = high * self.n_q + self.weight * self.n_gamma * (
                self.t - 2 * min(x, self.t) ** 2 / self.t)
        return end * pi * (self.outer - self.t) * self.t


def check():
    """Compares with a table in kN, D = 6 m: {h: (tip at each t, friction)}."""
    table = {2: ([307, 341, 614, 685, 1232, 1374], [60.6, 64.7]),
             5: ([762, 983, 1518, 1962, 3008, 3905], [378.6, 448]),
             6.5: ([990, 1382, 1969, 2752, 3896, 5459], [639.8, 799])}
    worst = 0
    for h, (tips, frictions) in table.items():
        caissons = [Caisson(6, t, 8829, 30, 20, 0.5) for t in (.05, .1, .2)]
        found = [c.tip(h, e) / 1e3 for c in caissons for e in (False, True)]
        found += [caissons[0].outer_friction(h, e) / 1e3 for e in (False, True)]
        for value, expected in zip(found, tips + frictions):
            worst = max(worst, abs(value / expected - 1))
    return worst


if __name__ == "__main__":
    difference = check()
    print(f"Houlsby and Byrne: {'OK' if difference < 2e-3 else 'FAILED'} "
          f"(largest difference {100 * difference:.2f} %)")
    sys.exit(0 if difference < 2e-3 else 1)
