# SPDX-License-Identifier: LGPL-2.1-or-later
"""The error of a quantity by the mesh, from runs on similar meshes.

At each depth F = F0 + a h is fitted to the runs by least squares, with cells of the
size h. The error of a run is F(h) - F0, and it has a sign. A bar holds it times a
safety factor: 1.25 with three meshes or more, 3 with two, and then on both sides
(Roache 1998, Verification and Validation in Computational Science and Engineering). Of
tip and total force, 1.5 on the side of F0 and 0.5 on the other hold a third mesh at 95
% of the depths (2, 4 and 8 cells across the wall of jack.prm and jack_sand.prm). The
standard deviation of the runs about the fit is added on both sides. Where the fit
fails, because the order that the runs show is below 0.5 or they oscillate, both sides
have at least three times the range of the runs over the ratio of their cells less one
(Eca and Hoekstra 2009, 4th Workshop on CFD Uncertainty Analysis).

The order is 1, that of the corner of a rigid body in soil. The order that the runs show
themselves is for diagnosis only: with a scatter of half a percent it has a standard
deviation of 0.5 to 0.9.

Of two meshes, half of the first-order error of the finer one leads to the best
estimate. On the tip in the sand of jack.prm, jack_sand.prm and its dense twin, at five
depths to 3 m, that estimate from 2 and 4 cells across the wall differs from 12 cells by
3.8 % (rms) and by 0.0 % in the mean. The whole error gives 7.1 % and -5.1 %, the run
with 4 cells 6.2 % and 5.0 % (lab/notes/2026-11-27_mesh_of_real_sand.md).
"""
from dataclasses import dataclass

import numpy as np

SAFETY, OF_TWO, OF_TWO_FORCES = (1.25, 0.0), (3.0, 3.0), (1.5, 0.5)  # to F0, away
SHARE_OF_TWO = 0.5  # of the first-order error of the finer mesh, to the best estimate
WHERE_IT_FAILS = 3.0
LEAST_ORDER = 0.5
ORDERS = np.linspace(0.05, 4.0, 80)


@dataclass(frozen=True)
class MeshError:
    """Of one run, in units of the quantity, each [n_depths].

    limit: F0, or the best estimate of two meshes; below, above: how far the limit may
    lie below and above the run; order: of the runs, nan of two; failed: where the order
    1 does not hold.
    """

    limit: np.ndarray
    below: np.ndarray
    above: np.ndarray
    order: np.ndarray
    failed: np.ndarray


def fitted(
    sizes: np.ndarray, values: np.ndarray, order: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return F0 and a of F0 + a h^order [n_depths], and the sums of the squares of what
    is left; sizes [n_runs], values [n_runs, n_depths]."""
    powers = np.column_stack([np.ones(len(sizes)), sizes**order])
    coefficients = np.linalg.lstsq(powers, values, rcond=None)[0]
    left = values - powers @ coefficients
    return coefficients[0], coefficients[1], np.sum(left**2, axis=0)


def observed_order(sizes: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the order with the best fit at each depth, nan of two runs."""
    if len(sizes) < 3:
        return np.full(values.shape[1], np.nan)
    left = [fitted(sizes, values, order)[2] for order in ORDERS]
    return ORDERS[np.argmin(left, axis=0)]


def oscillates(sizes: np.ndarray, values: np.ndarray, slack: np.ndarray) -> np.ndarray:
    """Return where the runs, from coarse to fine, go to and fro by more than a slack:
    [n_depths]."""
    steps = np.diff(values[np.argsort(-sizes)], axis=0)
    return (steps.max(axis=0) > slack) & (steps.min(axis=0) < -slack)


def mesh_error(
    sizes: np.ndarray, values: np.ndarray, run: int, is_force: bool = False
) -> MeshError:
    """Return the error of one of the runs. sizes [n_runs]: of cells, in any unit;
    values [n_runs, n_depths], n_runs at least 2; is_force: tip or total."""
    limit, slope, squares = fitted(sizes, values, 1.0)
    free = len(sizes) - 2
    scatter = np.sqrt(squares / free) if free else np.zeros_like(squares)
    error = slope * sizes[run]
    if not free:
        limit = limit + (1 - SHARE_OF_TWO) * slope * sizes.min()
    factors = SAFETY if free else OF_TWO_FORCES if is_force else OF_TWO
    below = np.where(error > 0, *factors) * np.abs(error) + scatter
    above = np.where(error < 0, *factors) * np.abs(error) + scatter
    order = observed_order(sizes, values)
    failed = (order < LEAST_ORDER) | oscillates(sizes, values, scatter)
    spread = np.ptp(values, axis=0) / (sizes.max() / sizes.min() - 1)
    below = np.where(failed, np.maximum(below, WHERE_IT_FAILS * spread), below)
    above = np.where(failed, np.maximum(above, WHERE_IT_FAILS * spread), above)
    return MeshError(limit, below, above, order, failed)
