# SPDX-License-Identifier: LGPL-2.1-or-later
"""Divides the ground of a cone test into layers.

Boundaries are where the mean of x = log10 Q_tn changes. x is taken each 5 cm and
smoothed by the median over 2 d, which keeps steps and takes away what is thinner than
d. Of all divisions into at most n layers that are not thinner than d, the one is taken
that makes

    sum of (x - mean of x in its layer)^2 + (number of layers) m s^2 / 2

smallest, with m points in a layer of thickness d. The second part is what it takes to
justify a boundary: between two layers of thickness d their means must differ by s, and
by less between thicker ones. The minimum is found exactly, by dynamic programming.

Soil of another kind within a layer, of which 0.1 m and more lie together, is a lens. A
cone feels a layer before it reaches it, so that thin ones look thicker and less
different than they are.
"""
from dataclasses import dataclass, field
from math import inf

import numpy as np
from scipy.ndimage import median_filter
from caisson_design.ground import Ground, kind_of


SPACING = 0.05  # m
STEP = 0.2  # in log10 Q_tn: a factor of 1.6
THINNEST = 0.5  # m
MOST = 20  # layers; each is at least THINNEST thick
TRANSITION = 0.1  # m at a boundary, whose rows do not count
THINNEST_LENS = 0.1  # m
BAND = 3.0  # times the median of Q_tn of a layer, or less than the median over this


@dataclass(frozen=True)
class Layer:
    """Soil from top to bottom (m) with its kind, the rows of the test that count
    [n_rows of the test]; lenses: top, bottom and kind of other soil in it; bands: the
    same of "hard" and "soft" soil of its own kind."""

    top: float
    bottom: float
    kind: str
    rows: np.ndarray
    lenses: list[tuple[float, float, str]] = field(default_factory=list)
    bands: list[tuple[float, float, str]] = field(default_factory=list)


def costs(x: np.ndarray, shortest: int) -> np.ndarray:
    """Return the sum of squares about the mean of x from i to j, [n + 1, n + 1], inf
    where it is shorter than shortest."""
    n = len(x)
    sums = np.concatenate([[0.0], np.cumsum(x)])
    squares = np.concatenate([[0.0], np.cumsum(x**2)])
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    count = np.maximum(j - i, 1)
    found = squares[j] - squares[i] - (sums[j] - sums[i]) ** 2 / count
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
    last = ground.depth[-1]
    spacing = max(SPACING, last / 800)
    z = np.arange(spacing / 2, last, spacing)
    x = np.interp(z, ground.depth, np.log10(ground.normalized))
    shortest = max(int(round(thinnest / spacing)), 1)
    x = median_filter(x, 2 * shortest - 1, mode="nearest")
    if len(x) < 2 * shortest:
        return [0.0]
    return [round(start * spacing / 0.05) * 0.05 for start in divide(x, shortest, most)]


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


def layers_of(ground: Ground, tops: list[float], given_kind: str = "") -> list[Layer]:
    """Return the layers with these tops. given_kind: of all soil, where the test does
    not show it. Raises ValueError where a layer has no row."""
    kinds = np.array([given_kind or kind_of(index) for index in ground.index])
    bottoms = [*tops[1:], float(ground.depth[-1])]
    found = []
    for top, bottom in zip(tops, bottoms):
        edge = TRANSITION if bottom - top >= 5 * TRANSITION else 0.0
        upper = top + (edge if top > 0 else 0.0)
        lower = bottom - (edge if bottom < bottoms[-1] else 0.0)
        rows = (ground.depth >= upper) & (ground.depth <= lower)
        rows &= ground.effective_stress > 0
        if not rows.any():
            raise ValueError(
                f"no row of the test lies in the layer from {top:g} to {bottom:g} m"
            )
        kind = given_kind or kind_of(float(np.median(ground.index[rows])))
        lenses = stretches_of(ground, rows, kinds, kind)
        if (rows & (kinds == kind)).any():
            rows = rows & (kinds == kind)
        bands = bands_of(ground, rows)
        found.append(Layer(top, bottom, kind, rows, lenses, bands))
    return found
