# SPDX-License-Identifier: LGPL-2.1-or-later
"""Divides the ground of a cone test into layers.

Boundaries are where the mean of x changes: log10 Q_tn and half of log10 F_r. x is taken
each 5 cm and smoothed by the median over 2 d, which keeps steps and takes away what is
thinner than d. Of all divisions into at most n layers that are not thinner than d, the
one is taken that makes

    sum of |x - mean of x in its layer|^2 + (number of layers) m s^2 / 2

smallest, with m points in a layer of thickness d. The second part is what it takes to
justify a boundary: between two layers of thickness d their means must differ by s, and
by less between thicker ones. The minimum is found exactly, by dynamic programming.

Soil of another kind within a layer, of which 0.1 m and more lie together, is a lens. A
cone feels a layer before it reaches it, so that thin ones look thicker and less
different than they are.
"""
from collections.abc import Sequence
from dataclasses import dataclass, field
from math import inf

import numpy as np
from scipy.ndimage import median_filter
from caisson.design.ground import Ground

SPACING = 0.05  # m
STEP = 0.2  # in log10 Q_tn: a factor of 1.6
SHARE = 0.5  # of log10 F_r, which scatters more
THINNEST = 0.5  # m
MOST = 20  # layers; each is at least THINNEST thick
TRANSITION = 0.1  # m at a boundary, whose rows do not count
THINNEST_LENS = 0.1  # m
BAND = 3.0  # times the median of Q_tn of a layer, or less than the median over this


@dataclass(frozen=True)
class Layer:
    """Soil from top to bottom (m) with its kind, and whether this is given; the rows of
    the test that count [n_rows of the test]; lenses: top, bottom and kind of other soil
    in it; bands: the same of "hard" and "soft" soil of its own kind."""

    top: float
    bottom: float
    kind: str
    rows: np.ndarray
    lenses: list[tuple[float, float, str]] = field(default_factory=list)
    bands: list[tuple[float, float, str]] = field(default_factory=list)
    is_given: bool = False


def costs(x: np.ndarray, shortest: int) -> np.ndarray:
    """Return the sum of squares about the mean of x [n] or [n, n_x] from i to j,
    [n + 1, n + 1], inf where it is shorter than shortest."""
    n = len(x)
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    count, found = np.maximum(j - i, 1), np.zeros((n + 1, n + 1))
    for column in x.reshape(n, -1).T:
        sums = np.concatenate([[0.0], np.cumsum(column)])
        squares = np.concatenate([[0.0], np.cumsum(column**2)])
        found += squares[j] - squares[i] - (sums[j] - sums[i]) ** 2 / count
    return np.where(j - i >= shortest, np.maximum(found, 0.0), inf)


def divide(x: np.ndarray, shortest: int, most: int) -> list[int]:
    """Return where the layers of x begin."""
    cost, n = costs(x, shortest), len(x)
    best, before = [cost[0]], [np.zeros(n + 1, dtype=int)]
    for _ in range(1, most):
        total = best[-1][:, None] + cost  # up to i so, and one more layer to j
        before.append(np.argmin(total, axis=0))
        best.append(np.min(total, axis=0))
    price = shortest * STEP**2 / 2
    sums = [row[n] + price * (k + 1) for k, row in enumerate(best)]
    number = int(np.argmin(sums))
    starts, end = [], n
    for k in range(number, -1, -1):
        end = int(before[k][end]) if k else 0
        starts.append(end)
    return starts[::-1]


def tops_of(
    ground: Ground, thinnest: float = THINNEST, most: int = MOST
) -> list[float]:
    """Return the tops of the layers (m), the first at 0."""
    first, last = ground.measured_from, ground.depth[-1]
    spacing = max(SPACING, last / 800)
    z = np.arange(first + spacing / 2, last, spacing)
    profiles = [np.log10(ground.normalized)]
    if not np.isnan(ground.friction_ratio).all():
        profiles.append(SHARE * np.log10(ground.friction_ratio))
    shortest = max(int(round(thinnest / spacing)), 1)
    if len(z) < 2 * shortest:
        return [0.0]
    x = np.stack(
        [
            median_filter(
                np.interp(z, ground.depth, p), 2 * shortest - 1, mode="nearest"
            )
            for p in profiles
        ],
        axis=1,
    )
    starts = divide(x, shortest, most)[1:]
    return [0.0, *(round((first + k * spacing) / 0.05) * 0.05 for k in starts)]


def with_edges(
    tops: list[float], edges: Sequence[float], nearest: float, last: float
) -> list[float]:
    """Return tops of layers that begin at edges, too; others that are nearer than
    nearest to an edge give way. last: end of the test (m)."""
    inside = [edge for edge in edges if 0 < edge < last]
    kept = [t for t in tops if all(abs(t - edge) >= nearest for edge in inside)]
    return sorted({0.0, *kept, *inside})


def stretches_of(
    ground: Ground, rows: np.ndarray, names: np.ndarray, usual: str
) -> list[tuple[float, float, str]]:
    """Return top, bottom and name where the names [n] of rows [n] are not the usual
    one for THINNEST_LENS and more."""
    found: list[tuple[float, float, str]] = []
    places = np.flatnonzero(rows)
    begin = 0
    for i in range(1, len(places) + 1):
        if i < len(places) and names[places[i]] == names[places[begin]]:
            continue
        first, last = places[begin], places[i - 1]
        top, bottom = float(ground.depth[first]), float(ground.depth[last])
        if names[first] != usual and bottom - top > THINNEST_LENS - 1e-6:
            found.append((top, bottom, str(names[first])))
        begin = i
    return found


def bands_of(ground: Ground, rows: np.ndarray) -> list[tuple[float, float, str]]:
    """Return where rows [n] of one kind of soil differ much from their median."""
    ratio = ground.normalized / np.median(ground.normalized[rows])
    names = np.select([ratio > BAND, ratio < 1 / BAND], ["hard", "soft"], "")
    return stretches_of(ground, rows, names, "")


def layers_of(ground: Ground, tops: list[float], given: np.ndarray) -> list[Layer]:
    """Return the layers with these tops. given: the kind of soil of each row [n] that
    is not to be judged by the test, else "". Raises ValueError where a layer has no row
    or no kind."""
    kinds = np.where(given != "", given, ground.kinds)
    bottoms = [*tops[1:], float(ground.depth[-1])]
    found = []
    for top, bottom in zip(tops, bottoms):
        edge = TRANSITION if bottom - top >= 5 * TRANSITION else 0.0
        upper = top + (edge if top > 0 else 0.0)
        lower = bottom - (edge if bottom < bottoms[-1] else 0.0)
        rows = (ground.depth >= upper) & (ground.depth <= lower)
        rows &= ground.effective_stress > 0
        measured = rows & (ground.depth >= ground.measured_from)
        rows = measured if measured.any() else rows
        where = f"the layer from {top:g} to {bottom:g} m"
        if not rows.any():
            raise ValueError(f"no row of the test lies in {where}")
        words, count = np.unique(given[rows], return_counts=True)
        kind = str(words[count.argmax()])
        is_given = kind != ""
        if not is_given and np.isnan(ground.index[rows]).all():
            raise ValueError(
                f"without sleeve friction nothing tells the soil of {where}"
            )
        kind = kind or ground.kind(rows)
        lenses = stretches_of(ground, rows, kinds, kind)
        if (rows & (kinds == kind)).any():
            rows = rows & (kinds == kind)
        bands = bands_of(ground, rows)
        found.append(Layer(top, bottom, kind, rows, lenses, bands, is_given))
    return found
