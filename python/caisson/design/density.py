# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the relative density of silica sand says of its cone resistance and strength.

Jamiolkowski, Lo Presti & Manassero (2003), ASCE GSP 119, p. 201, from chamber tests
under a vertical effective stress of 50 to 400 kPa:

    q_c = 24.94 p_a (sigma'_m / p_a)^0.46 exp(2.96 D_r),      p_a = 100 kPa.

Bolton (1986), doi 10.1680/geot.1986.36.1.65, with the mean stress p' in kPa:

    phi = phi_c + 3 I_R,    I_R = D_r (10 - ln p') - 1, from 0 to 4.

Brinkgreve, Engin & Engin (2010), Numerical Methods in Geotechnical Engineering, p. 137,
the secant modulus E_50 of a drained triaxial test under p_a:

    E_50 = 60 MPa D_r.

Under a tip, p' = sqrt(q_c sigma'_v) (Randolph, Dolwin & Beck 1994; quoted, and
unconfirmed). Formulas are as two published programs and manuals quote them.

SI units; D_r is a share of 1, angles are in degrees. All functions take arrays [n].
"""
from typing import Any

import numpy as np

from caisson.units import ATMOSPHERE

CRITICAL_ANGLE = 33.0  # of quartz
MOST_INDEX = 4.0  # of I_R
LEAST_OF_MODULUS = 0.05  # D_r below which the modulus falls no further: 3 MPa
ROUNDS = 40  # of D_r and the stress at the tip; each leaves a third of the error


def density_of_resistance(resistance: Any, mean_stress: Any) -> Any:
    """Return D_r by Jamiolkowski et al., which may be outside of 0 to 1."""
    stress = (mean_stress / ATMOSPHERE) ** 0.46
    relative = np.maximum(resistance / ATMOSPHERE, 1e-9)
    return np.log(relative / (24.94 * stress)) / 2.96


def cone_resistance(density: Any, mean_stress: Any) -> Any:
    """Return q_c by Jamiolkowski et al. (Pa)."""
    stress = (mean_stress / ATMOSPHERE) ** 0.46
    return 24.94 * ATMOSPHERE * stress * np.exp(2.96 * density)


def reference_modulus(density: Any) -> Any:
    """Return E_50 by Brinkgreve et al. (Pa)."""
    return 60e6 * np.maximum(density, LEAST_OF_MODULUS)


def bolton_angle(density: Any, mean_stress: Any, critical: Any = CRITICAL_ANGLE) -> Any:
    """Return phi by Bolton."""
    index = density * (10 - np.log(mean_stress / 1e3)) - 1
    return critical + 3 * np.clip(index, 0.0, MOST_INDEX)


def density_of_angle(angle: Any, stress: Any, mean_stress: Any) -> Any:
    """Return the D_r, at most 1, of quartz sand with this phi under a tip, by both
    formulas. stress: sigma'_v (Pa). With phi_c or less it is the largest possible."""
    index = np.clip((angle - CRITICAL_ANGLE) / 3, 0.0, MOST_INDEX)
    density = np.full(np.shape(stress), 0.5)
    for _ in range(ROUNDS):
        under_tip = np.sqrt(cone_resistance(density, mean_stress) * stress)
        density = (index + 1) / np.maximum(10 - np.log(under_tip / 1e3), 1.0)
        density = np.minimum(density, 1.0)
    return density
