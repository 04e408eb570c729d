# SPDX-License-Identifier: LGPL-2.1-or-later
"""Three or four buckets under a rigid frame, in soil that differs from one to the next:
the differential of their suctions that keeps the frame level, and its tilt if all have
the same suction (custom, by equilibrium).

Each bucket has the resistance k_i R(h), and bears the same share V' of the weight. It
stays level with its own suctions

    s_i = (k_i R - V') / A_i >= 0.

With one suction for all, the pull P = V' + s A_i = R(h_0) acts on each bucket, and
the frame turns until force and both moments are balanced. With R linear near h_0,

    sum [P - k_i (R + R' d_i)] (1, x_i, y_i) = 0,     d_i = a + b x_i + c y_i,

which are three equations for the plane of the frame; its tilt is that of (b, c). A
bucket turns without a moment, on the safe side. SI units.
"""
from collections.abc import Sequence
from itertools import product
from math import atan, degrees, hypot, inf, pi

import numpy as np

NUMBERS = 3, 4  # of buckets
# least and largest k of each bucket, [n, 2]
Ends = Sequence[tuple[float, float]] | np.ndarray


def places(number: int, distance: float) -> np.ndarray:
    """Return x and y (m) of buckets on a regular triangle or a square with a side:
    [number, 2]."""
    angles = 2 * pi * np.arange(number) / number
    radius = distance / (2 * np.sin(pi / number))
    return radius * np.column_stack([np.cos(angles), np.sin(angles)])


def differential(ends: Ends, resistance: float, weight: float, area: float) -> float:
    """Return the largest difference of the suctions of two buckets (Pa) that keeps the
    frame level. resistance: R (N); weight: of a bucket (N); area: inside (m2)."""

    def suction(share: float) -> float:
        return max(share * resistance - weight, 0.0) / area

    pairs = product(enumerate(ends), enumerate(ends))
    return max(
        suction(one[1]) - suction(other[0]) for (i, one), (j, other) in pairs if i != j
    )


def tilt(at: np.ndarray, shares: np.ndarray, resistance: float, slope: float) -> float:
    """Return the tilt (degrees) under one suction of buckets at places [n, 2] (m) with
    shares k [n] of a resistance (N), which grows by a slope (N/m)."""
    plane = np.column_stack([np.ones(len(at)), at])
    stiffness = (plane * (shares * slope)[:, np.newaxis]).T @ plane
    missing = plane.T @ (resistance * (1 - shares))
    _, b, c = np.linalg.solve(stiffness, missing)
    return degrees(atan(hypot(b, c)))


def largest_tilt(ends: Ends, distance: float, resistance: float, slope: float) -> float:
    """Return the largest tilt (degrees) with any bucket at either end of its range;
    infinite where the resistance (N) does not grow with depth."""
    if slope <= 0:
        return inf
    at = places(len(ends), distance)
    return max(tilt(at, np.array(s), resistance, slope) for s in product(*ends))
