# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pressure of a spherical cavity that grows from nothing in sand by density and
stress: a model of one dimension beside the cones, which takes seconds.

The field depends on r/a alone, a the radius of the cavity, so that all points pass
through the same states and one material point is integrated. With the velocity
v = s (r/a) da/dt and tau = ln a, compression positive,

    d eps_t = -s dtau,   d sig_r = 2 (sig_r - sig_t) (1 - s) dtau,
    ds = (1 - s) (d eps_r + s dtau),

from s = 0 far away to s = 1 at the wall. In each step the strain of the radius and the
plastic multiplier follow from the equilibrium and the yield condition, which are linear
in both while stiffness and strength are those of its beginning.

The law is that of doc/theory.md, "Mohr-Coulomb by density and stress".
"""
from typing import NamedTuple

import numpy as np

from caisson.design.assumed_cone import LEAST_OF_STRENGTH
from caisson.design.density import CRITICAL_ANGLE, bolton_angle
from caisson.suggest.sand import KARLSRUHE
from caisson.units import ATMOSPHERE

DENSEST, LOOSEST = KARLSRUHE  # void ratios of the relative densities 1 and 0
PER_INDEX, DILATION = 3.0, 0.3  # degrees of friction, and strain, of I
POISSON, EXPONENT = 0.3, 0.5
LEAST_MEAN = 1e3  # Pa, of the stiffness
STRAIN, STEP, FIRST, LAST = 5e-4, 0.01, 1e-6, 1e-4  # of a step; 1 - s at the end


class Sand(NamedTuple):
    """Relative densities, moduli at 100 kPa (Pa) and mean effective stresses at rest
    (Pa), [n] each."""

    density: np.ndarray
    modulus: np.ndarray
    stress: np.ndarray


def hardin(void_ratio: np.ndarray) -> np.ndarray:
    """Return how the stiffness follows the void ratio (Hardin & Richart 1963)."""
    return np.maximum(2.17 - void_ratio, 0.1) ** 2 / (1 + void_ratio)


def strength(void_ratio: np.ndarray, stress: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return (1 + sin)/(1 - sin) of the friction angle, and of the dilatancy angle."""
    density = (LOOSEST - void_ratio) / (LOOSEST - DENSEST)
    angle = bolton_angle(density, np.maximum(stress, LEAST_OF_STRENGTH))
    index, sine = (angle - CRITICAL_ANGLE) / PER_INDEX, np.sin(np.radians(angle))
    return (1 + sine) / (1 - sine), 1 + DILATION * index


def limit_pressure(sand: Sand) -> np.ndarray:
    """Return the pressure of the cavity (Pa) [n]."""
    start = LOOSEST - sand.density * (LOOSEST - DENSEST)
    void, radial, hoop = start.copy(), sand.stress.copy(), sand.stress.copy()
    s = np.full(len(start), FIRST)
    while ((1 - s) > LAST).any():
        dtau = np.where(1 - s > LAST, np.minimum(STEP, STRAIN / s), 0.0)
        mean = np.maximum((radial + 2 * hoop) / 3, LEAST_MEAN)
        growth = (mean / ATMOSPHERE) ** EXPONENT * hardin(void) / hardin(start)
        modulus = sand.modulus * growth
        bulk, shear = modulus / 3 / (1 - 2 * POISSON), modulus / 2 / (1 + POISSON)
        a, b = bulk + 4 * shear / 3, bulk - 2 * shear / 3
        n, d = strength(void, mean)
        around = -s * dtau
        target = radial + 2 * (radial - hoop) * (1 - s) * dtau
        # elastic: the strain of the radius follows from the equilibrium alone
        strain = (target - radial - 2 * b * around) / a
        trial = hoop + b * strain + (a + b) * around
        # plastic: a strain of 2 m along the radius, and of -m d around
        drop_r, drop_t = 2 * (a - b * d), 2 * b - (a + b) * d
        missing = target - radial - 2 * b * around
        # a strain - drop_r m = missing; target = n (hoop + b strain + ... - drop_t m)
        plastic = (target / n - hoop - (a + b) * around - b * missing / a) / (
            b * drop_r / a - drop_t
        )
        plastic = np.where(target > n * trial, plastic, 0.0)
        strain = (missing + drop_r * plastic) / a
        hoop = hoop + b * strain + (a + b) * around - drop_t * plastic
        radial = target
        void = void - (strain + 2 * around) * (1 + void)
        s = s + (1 - s) * (strain + s * dtau)
    return radial
