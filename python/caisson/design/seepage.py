# SPDX-License-Identifier: LGPL-2.1-or-later
"""Suction in a caisson in sand: the pressure at its tip, and the critical suction.

With the suction s beneath the lid, the pore pressure at the tip falls by a s. At
the critical suction the sand inside loses its weight, or water breaks through it.

    Houlsby and Byrne (2005), Design procedures for installation of suction
    caissons in sand, doi:10.1680/geng.2005.158.3.135:  a, and s = gamma' h / (1 - a).
    Senders and Randolph (2009), CPT-based method for the installation of suction
    caissons in sand, J. Geotech. Geoenviron. Eng. 135(1).

Both fits are functions of h / D, the embedment of the tip over the diameter; here
D is the outer one. SI units; unit weights are effective ones.
"""
from math import atan, exp, pi


def pressure_factor(slenderness: float, permeability_ratio: float = 1.0) -> float:
    """Return a, the pressure at the tip over the suction.

    slenderness: h / D; permeability_ratio: of the sand inside to that outside.
    """
    a1 = 0.45 - 0.36 * (1 - exp(-slenderness / 0.48))
    return a1 * permeability_ratio / (1 - a1 + a1 * permeability_ratio)


def houlsby_byrne(
    unit_weight: float, h: float, diameter: float, permeability_ratio: float = 1.0
) -> float:
    """Return the suction whose mean gradient inside bears the sand (Pa)."""
    return unit_weight * h / (1 - pressure_factor(h / diameter, permeability_ratio))


def senders_randolph(unit_weight: float, h: float, diameter: float) -> float:
    """Return the critical suction (Pa)."""
    angle = atan(5 * (h / diameter) ** 0.85)
    return unit_weight * h * (pi - angle * (2 - 2 / pi))
