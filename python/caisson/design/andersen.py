# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance by Andersen, Jostad and Dyvik, from a cone test in sand.

Andersen, Jostad and Dyvik (2008), Penetration resistance of offshore skirted
foundations and anchors in dense sand, J. Geotech. Geoenviron. Eng. 134(1), 106-116.
They fit k_p and k_f to prototypes and to tests in the field and in the laboratory, all
in dense sand: with k_f = 0.0015, k_p lies between 0.01 and 0.55. This range is the
scatter of what was measured and not a band of design; the abstract says that bearing
capacity with friction angles from the laboratory agrees better with the measurements.

The paper was not at hand: the three numbers are as others quote them, and have not
been checked against it. Its bearing-capacity model is left out for that reason.
"""
from caisson.design.cone import Coefficients, ConeMethod, Layer, Profile, Skirt

CASES = ("low", "high")
TIP = {"low": 0.01, "high": 0.55}  # k_p
WALL = 0.0015  # k_f


def method(skirt: Skirt, profile: Profile) -> ConeMethod:
    """Return the method for dense sand, whose layers follow from q_c."""
    k = {case: Coefficients(TIP[case], WALL, WALL) for case in CASES}
    return ConeMethod(CASES, skirt, profile, [Layer(0.0, k)])
