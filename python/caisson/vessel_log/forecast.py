# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a log says so far, and what is to be expected below it.

The measured resistance is compared with the runs in shares of their band: -1 is the
low estimate, 0 the best one, and 1 the high one. A robust least-squares fit gives the
share, and the factor on the best estimate, that the log has so far.

The forecast takes the share as a Gaussian process over depth (Rasmussen & Williams
2006, chapter 2): one half of its variance is the same everywhere, the other half
changes over CORRELATION of the way, as layers do, and low and high are its quantiles of
5 and 95 %. The log fixes the process where it has been; below, it returns half the way
to the best estimate, and its band widens, as the soil that is still to come does not
show. The band is REACH standard deviations wide on either side: of 100 made-up
installations each in soil of layers, waves, trends, jumps and far outside of the band,
none of which is of this form, 100, 98, 97, 91 and 100 stayed within it over all of
their way (python/tests/test_log.py).
"""
from typing import NamedTuple

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import least_squares
from scipy.spatial.distance import cdist

from caisson.vessel_log.expected import Expected

QUANTILE = 1.645  # of the normal distribution, of low and high
REACH = 2.05  # standard deviations
COMMON = 0.5  # of the variance, the same at all depths
CORRELATION = 0.1  # of the way, over which the other half changes
NUGGET = 0.15  # of half a band, which no log tells
LAST = 0.05  # of the way, whose steps are the last ones
LEAST_NOISE = 0.02  # of the resistance of a step: gauges are not better


class Bins(NamedTuple):
    """A log in steps of depth, [n] each: depth (m), resistance (kN) and its error as a
    share of it; the weight on the soil (kN); how many steps are left out, as the pump
    rested; and the depths (m) of those where the caisson rested under more than above.
    """

    depth: np.ndarray
    resistance: np.ndarray
    error: np.ndarray
    weight: np.ndarray
    rests: int = 0
    held: tuple[float, ...] = ()


class Fit(NamedTuple):
    """The share of the band, and the factor on the best estimate, each with the ends of
    its interval of 90 %: (value, low, high); and the factor of the last steps alone."""

    share: tuple[float, float, float]
    factor: tuple[float, float, float]
    last: float


class Forecast(NamedTuple):
    """Columns [n] from the end of the log on: depth (m), and the required suction (kPa)
    with its band; the weight (kN)."""

    depth: np.ndarray
    low: np.ndarray
    best: np.ndarray
    high: np.ndarray
    weight: float


def fit_of(expected: Expected, bins: Bins) -> Fit:
    """Return what fits the log so far."""
    share = expected.share(bins.depth, bins.resistance)
    scale = noise_of(expected, bins)

    def residual(x: np.ndarray) -> np.ndarray:
        return np.asarray((share - x[0]) / scale)

    found = least_squares(residual, [np.median(share)], loss="soft_l1")
    middle = float(found.x[0])
    spread = 1.4826 * float(np.median(np.abs(share - middle)))
    # steps that are near to each other are alike
    independent = 1 + np.ptp(bins.depth) / (CORRELATION * expected.planned)
    error = QUANTILE * np.hypot(spread, NUGGET) / np.sqrt(independent)
    best = np.interp(bins.depth, expected.depth, expected.best)

    def factor(x: float) -> float:
        shares = np.full(len(best), x)
        return float(np.mean(expected.resistance(bins.depth, shares) / best))

    ends = (middle, middle - error, middle + error)
    near = bins.depth > bins.depth[-1] - LAST * expected.planned
    last = float(np.median((bins.resistance / best)[near]))
    return Fit(ends, (factor(ends[0]), factor(ends[1]), factor(ends[2])), last)


def noise_of(expected: Expected, bins: Bins) -> np.ndarray:
    """Return the error of each step in shares of the band, [n]."""
    width = np.mean(expected.halves(bins.depth), axis=0)
    return np.asarray(np.hypot(bins.error / width, NUGGET))


def covariance(a: np.ndarray, b: np.ndarray, length: float) -> np.ndarray:
    """Return the covariance of shares at depths [n] and [m] (m): [n, m]. length: over
    which they change (m)."""
    near = np.exp(-cdist(a[:, None], b[:, None]) / length)
    return np.asarray((COMMON + (1 - COMMON) * near) / QUANTILE**2)


def forecast_of(expected: Expected, bins: Bins, weight: float) -> Forecast:
    """Return the required suction from the end of the log on, under a weight (kN)."""
    length, seen = CORRELATION * expected.planned, bins.depth
    at = np.append(seen[-1], expected.depth[expected.depth > seen[-1]])
    share = expected.share(seen, bins.resistance)
    noise = np.diag(noise_of(expected, bins) ** 2)
    known = cho_factor(covariance(seen, seen, length) + noise)
    solved, across = cho_solve(known, share), covariance(at, seen, length)
    mean = across @ solved
    told = np.sum(across * cho_solve(known, across.T).T, axis=1)
    # a log that is rougher than the process makes all of it so
    rough = max(1.0, float(share @ solved) / len(share))
    left = rough * (1 / QUANTILE**2 - told).clip(0)
    reach = REACH * np.sqrt(left + NUGGET**2)
    low, best, high = (
        expected.suction(expected.resistance(at, x), weight)
        for x in (mean - reach, mean, mean + reach)
    )
    return Forecast(at, low, best, high, weight)
