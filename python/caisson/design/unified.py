# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance by the unified method for driven piles, from a cone test in
sand.

Lehane et al. (2020), named by ISO 19901-4:2025 and API RP 2A: at the height h above the
tip a wall bears

    tau = q_c/44 A_re^0.3 max(1, h/D)^-0.4 tan(delta),   A_re = 1 - (D_i/D)^2 PLR,

and the ring at the end half of q_c, which is what q_b = (0.12 + 0.38 A_re) q_c leaves
beside a plug of 0.12 q_c. A caisson is less than a diameter long and its plug grows as
fast as it sinks, so that both are coefficients: max(1, h/D) = 1 and PLR = 1. The stress
from dilation, q_c/10 (q_c/sigma'_v)^-0.33 d/D with the diameter d of a cone, is 1 % of
the other one at a diameter of 8 m, and left out. Inside the wall bears as much.

It is made for the capacity of piles long after driving and not for installation. The
method has delta = 29 degrees; low and high have one standard deviation of 2.5 degrees
less and more than the mean of 29.6 of 44 ring shear tests of sand on steel (Liu et al.
2019). The formulas were read in K. Duffy, Offshore Geotechnics, lecture notes of Delft
University of Technology, section 4.3, and the tests in a figure there.
"""
from math import radians, tan

from caisson.design.cone import Coefficients, ConeMethod, Layer, Profile, Skirt

CASES = ("low", "high")
TIP = 0.5  # k_p
ANGLES = {"low": 27.1, "high": 32.1}  # degrees, of steel and sand


def method(skirt: Skirt, profile: Profile) -> ConeMethod:
    """Return the method for sand, whose layers follow from q_c."""
    area_ratio = 1 - (skirt.inner_diameter / skirt.outer_diameter) ** 2
    walls = {c: area_ratio**0.3 * tan(radians(a)) / 44 for c, a in ANGLES.items()}
    k = {case: Coefficients(TIP, wall, wall) for case, wall in walls.items()}
    return ConeMethod(CASES, skirt, profile, [Layer(0.0, k)])
