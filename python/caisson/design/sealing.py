# SPDX-License-Identifier: LGPL-2.1-or-later
"""The seal of a skirt in sand, and the grout beneath its lid.

A suction s beneath the lid drives water down the outside of the skirt and up its
inside, over a path of twice the embedment h. Houlsby and Byrne (2005),
doi:10.1680/geng.2005.158.3.135, have the fall a s of the pressure at the tip, so that
the mean gradient inside is

    i = (1 - a) s / (gamma_w h),        critical at gamma' / gamma_w.

The least embedment for a seal is that at which the critical suction is the one that is
applied. Grout with the excess pressure p beneath the lid turns the flow round (custom):
water rises outside, where the mean gradient is a p / (gamma_w h), and sand loses its
weight at

    p = gamma' h / a = s_cr (1 - a) / a,        s_cr = gamma' h / (1 - a).

The caisson itself is lifted at p = V' / A_i; what holds it by friction is left out, on
the safe side. SI units.
"""
from math import nan, radians, tan

import numpy as np

from caisson.units import WATER


def exit_gradient(suction: float, h: float, pressure_factor: float) -> float:
    """Return the mean gradient inside at an embedment (m) under a suction (Pa)."""
    return (1 - pressure_factor) * suction / (WATER * h)


def least_embedment(depth: np.ndarray, critical: np.ndarray, suction: float) -> float:
    """Return the embedment (m) from which critical suctions [n] (Pa) at embedments [n]
    (m) are at least a suction; nan where they are not."""
    enough = np.flatnonzero(critical >= suction)
    if not len(enough):
        return nan
    ends = slice(max(int(enough[0]) - 1, 0), int(enough[0]) + 1)
    return float(np.interp(suction, critical[ends], depth[ends]))


def grout_pressure(critical: float, pressure_factor: float) -> float:
    """Return the excess pressure of the grout (Pa) at which sand outside loses its
    weight; critical: the suction at which the sand inside does."""
    return critical * (1 - pressure_factor) / pressure_factor


def gaps(mean: float, inner_diameter: float, tilt: float) -> tuple[float, float]:
    """Return the least and the largest gap (m) between a level plug and a lid that is
    tilted (degrees) about its middle."""
    change = inner_diameter / 2 * tan(radians(tilt))
    return mean - change, mean + change
