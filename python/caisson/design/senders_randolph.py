# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance by Senders and Randolph, from a cone test in sand.

Senders and Randolph (2009), CPT-based method for the installation of suction caissons
in sand, J. Geotech. Geoenviron. Eng. 135(1): the tip bears k_p q_c with k_p = 0.2, and
each wall k_f q_c with

    k_f = C (1 - (D_i / D_o)^2)^0.3 tan(delta).

This is the shaft friction of piles by UWA-05 (Lehane, Schneider and Xu 2005; also in
API RP 2GEO),

    tau = 0.03 A_r^0.3 max(h / D, 2)^-0.5 q_c tan(delta),   A_r = 1 - (D_i / D_o)^2,

where the wall is less than two diameters above the tip, as on all of a caisson:
C = 0.03 / sqrt(2) = 0.021, the upper case. The lower case has C = 0.012, which is
quoted for caissons. The paper was not at hand: k_p = 0.2 and C = 0.012 are as others
quote them, and have not been checked against it.

What suction takes from these forces: suction_installation.
"""
from collections.abc import Collection, Sequence
from math import radians, sqrt, tan

from caisson.design.cone import Coefficients, ConeMethod, Layer, Profile, Skirt

CASES = ("low", "high")
TIP = 0.2  # k_p
WALL = {"low": 0.012, "high": 0.03 / sqrt(2)}  # C


def wall_coefficient(skirt: Skirt, case: str, angle: float) -> float:
    """Return k_f of a wall."""
    area_ratio = 1 - (skirt.inner_diameter / skirt.outer_diameter) ** 2
    return WALL[case] * area_ratio**0.3 * tan(radians(angle))


def coefficients(skirt: Skirt, case: str, own: float | None) -> Coefficients:
    """Return k_p and k_f of both walls in sand with its own friction angle of the walls
    (degrees), None where it is that of the skirt."""
    walls = skirt.inner_friction_angle, skirt.outer_friction_angle
    angles = walls if own is None else (own, own)
    return Coefficients(TIP, *(wall_coefficient(skirt, case, x) for x in angles))


def method(
    skirt: Skirt,
    profile: Profile,
    walls: Sequence[tuple[float, float | None]] = ((0.0, None),),
    clay: Collection[float] = (),
) -> ConeMethod:
    """Return the method for sand, whose strength follows from q_c. walls: the tops of
    the layers (m) from the mudline down, and their own friction angle of the walls;
    clay: the tops of those that another method treats."""
    nothing = dict.fromkeys(CASES, Coefficients(0.0, 0.0, 0.0))
    layers = [
        Layer(
            top,
            nothing if top in clay else {x: coefficients(skirt, x, own) for x in CASES},
        )
        for top, own in walls
    ]
    return ConeMethod(CASES, skirt, profile, layers)
