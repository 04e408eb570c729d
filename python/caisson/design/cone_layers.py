# SPDX-License-Identifier: LGPL-2.1-or-later
"""Divides the ground of a cone test into layers.

Boundaries are where the mean of x changes: log10 Q_tn and half of log10 F_r. x is taken
each 5 cm where something was measured, and smoothed by the median over 2 d, which keeps
steps and takes away what is thinner than d. Of all divisions into at most n layers that
are not thinner than d, the one is taken that makes

    sum of |x - mean of x in its layer|^2 + (number of layers) m s^2 / 2

smallest, with m points in a layer of thickness d. The second part is what it takes to
justify a boundary: between two layers of thickness d their means must differ by s, and
by less between thicker ones. The minimum is found exactly, by dynamic programming.

The strength of clay grows with depth, and Q_tn of one clay need not be the same
everywhere. Where layers of clay lie on each other, they are divided again in the same
way: a straight line over the depth takes the place of the mean, the net resistance that
of x, and its difference from the line, as a share of the resistance nearby, that of the
difference.

A seam of clay in sand becomes a layer. The cone feels the sand before it reaches the
clay, and after it has left it, so that the readings of a seam fall and rise again: its
kind and its estimates are those of the trough between, of their lowest quarter. Other
soil within a layer, of which 0.1 m and more lie together, is a lens, and does not count
for the layer; thinner strips do. A cone feels a layer before it reaches it, so that
thin ones look thicker and less different than they are.

Where nothing was measured, there is no layer: those above and below meet in the middle.
"""
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import groupby
from math import inf

import numpy as np
from scipy.ndimage import median_filter
from caisson.design.ground import CLAY, SAND, SILT, Ground

SPACING = 0.05  # m
STEP = 0.2  # in log10 Q_tn: a factor of 1.6
SHARE = 0.5  # of log10 F_r, which scatters more
THINNEST = 0.5  # m
MOST = 20  # layers; each is at least THINNEST thick
TRANSITION = 0.1  # m at a boundary, whose rows do not count
THINNEST_LENS = 0.1  # m
THINNEST_SEAM, THICKEST_SEAM = 0.1, 1.0  # m
SOFTER = 0.5  # of the net resistance around a seam, at most
THIN, TROUGH = 0.7, 1 / 4  # m of a seam, and the share of its rows, that count
LEAST_NET = 20e3  # Pa of net resistance nearby, of which a difference is a share
BAND = 3.0  # times the median of Q_tn of a layer, or less than the median over this


@dataclass(frozen=True)
class Layer:
    """Soil from top to bottom (m) with its kind, and whether this is given; the rows of
    the test that count [n_rows of the test]; lenses: top, bottom and kind of other soil
    in it; bands: the same of "hard" and "soft" soil of its own kind; is_seam: whether
    it is a seam of soft soil, of which the trough counts."""

    top: float
    bottom: float
    kind: str
    rows: np.ndarray
    lenses: list[tuple[float, float, str]] = field(default_factory=list)
    bands: list[tuple[float, float, str]] = field(default_factory=list)
    is_given: bool = False
    is_seam: bool = False


def between(values: np.ndarray) -> np.ndarray:
    """Return the sums of values [n] from i to j, [n + 1, n + 1]."""
    total = np.concatenate([[0.0], np.cumsum(values)])
    return np.asarray(total - total[:, np.newaxis])


def costs(x: np.ndarray, shortest: int) -> np.ndarray:
    """Return the sum of squares about the mean of x [n] or [n, n_x] from i to j,
    [n + 1, n + 1], inf where it is shorter than shortest."""
    number = between(np.ones(len(x)))
    columns, count = x.reshape(len(x), -1).T, np.maximum(number, 1)
    found = sum(between(c**2) - between(c) ** 2 / count for c in columns)
    return np.where(number >= shortest, np.maximum(found, 0.0), inf)


def costs_of_lines(z: np.ndarray, y: np.ndarray, shortest: int) -> np.ndarray:
    """Return the sum of squares about the best straight line of y over z [n] from i to
    j, [n + 1, n + 1], as a share of y nearby and in log10; inf where it is shorter than
    shortest."""
    width = 2 * int(round(THICKEST_SEAM / SPACING)) + 1
    nearby = np.maximum(median_filter(y, width, mode="nearest"), LEAST_NET)
    weight = (nearby * np.log(10.0)) ** -2
    z = z - z.mean()
    one, of_z, of_zz, of_y, of_zy, of_yy = (
        between(weight * x) for x in (z**0, z, z * z, y, z * y, y * y)
    )
    one = np.where(one > 0, one, 1.0)
    spread, common = of_zz - of_z**2 / one, of_zy - of_z * of_y / one
    found = of_yy - of_y**2 / one
    found -= np.where(spread > 0, common**2 / np.maximum(spread, 1e-30), 0.0)
    is_long = between(np.ones(len(z))) >= shortest
    return np.where(is_long, np.maximum(found, 0.0), inf)


def divide(cost: np.ndarray, shortest: int, most: int = MOST) -> list[int]:
    """Return where the layers begin that cost least. cost: of a layer from i to j,
    [n + 1, n + 1]."""
    n = len(cost) - 1
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


@dataclass(frozen=True)
class Points:
    """Depths z [n] (m) at an even spacing (m) where a test has measured; shortest: the
    points in the thinnest layer."""

    ground: Ground
    z: np.ndarray
    spacing: float
    shortest: int

    def profile(self, values: np.ndarray) -> np.ndarray:
        """Return values of the rows at the points [n], without what is thin."""
        found = np.interp(self.z, self.ground.depth, values)
        size = 2 * self.shortest - 1
        return np.asarray(median_filter(found, size, mode="nearest"))

    def top(self, k: int) -> float:
        """Return the depth of a boundary above point k: the middle of a gap that is
        within two points of it."""
        place = self.z[k] - self.spacing / 2
        for a, b in self.ground.gaps:
            if a - 2.5 * self.spacing < place < b + 2.5 * self.spacing:
                return round((a + b) / 2, 2)
        return nearest(place)


def tops_of(ground: Ground, thinnest: float = THINNEST) -> list[float]:
    """Return the tops of the layers (m), the first at 0."""
    first, last = max(ground.measured_from, ground.depth[0]), ground.depth[-1]
    spacing = max(SPACING, last / 800)
    z = np.arange(first + spacing / 2, last, spacing)
    for a, b in ground.gaps:
        z = z[(z <= a) | (z >= b)]
    points = Points(ground, z, spacing, max(int(round(thinnest / spacing)), 1))
    profiles = [np.log10(ground.normalized)]
    has_kinds = not np.isnan(ground.friction_ratio).all()
    if has_kinds:
        profiles.append(SHARE * np.log10(ground.friction_ratio))
    if len(points.z) < 2 * points.shortest:
        return [0.0]
    x = np.stack([points.profile(p) for p in profiles], axis=1)
    starts = divide(costs(x, points.shortest), points.shortest)
    if has_kinds:
        starts = with_lines(points, starts)
    found = sorted({0.0, *(points.top(k) for k in starts[1:])})
    return with_rows(ground, with_seams(ground, found) if has_kinds else found)


def with_lines(points: Points, starts: list[int]) -> list[int]:
    """Return where layers begin if those of clay that lie on each other are divided
    again, by lines of their net resistance."""
    ground, ends = points.ground, [*starts[1:], len(points.z)]
    edges = [*points.z[starts] - points.spacing / 2, points.ground.depth[-1]]
    is_clay = []
    for top, bottom in zip(edges, edges[1:]):
        rows = (ground.depth >= top) & (ground.depth <= bottom)
        is_clay.append(bool(rows.any()) and ground.kind(rows) == CLAY)
    net, found, begin = points.profile(ground.net), list[int](), 0
    for i, end in enumerate(ends):
        if is_clay[i] and i + 1 < len(ends) and is_clay[i + 1]:
            continue
        first = starts[begin]
        if i > begin:
            cost = costs_of_lines(points.z[first:end], net[first:end], points.shortest)
            found += [first + k for k in divide(cost, points.shortest)]
        else:
            found.append(first)
        begin = i + 1
    return found


def with_rows(ground: Ground, tops: list[float]) -> list[float]:
    """Return the tops of layers that have rows of the test; others join the layer below
    them, the last one that above."""
    counts = ground.effective_stress > 0
    found = [0.0]
    for top in tops[1:]:
        rows = counts & (ground.depth >= found[-1]) & (ground.depth < top)
        if rows.any():
            found.append(top)
    while len(found) > 1 and not (counts & (ground.depth >= found[-1])).any():
        found.pop()
    return found


def seams_of(ground: Ground) -> list[tuple[float, float]]:
    """Return top and bottom (m) of the seams of clay: soil that is no sand, in it clay,
    and sand on both sides that resists much more. They end where the resistance is the
    geometric mean of that in the trough and that of the sand."""
    depth, kinds = ground.depth, ground.kinds
    measured = depth >= ground.measured_from
    is_sand = kinds == SAND
    changes = np.flatnonzero(np.diff(is_sand)) + 1
    found = []
    for begin, end in zip(changes, changes[1:]):
        if is_sand[begin] or not measured[begin]:
            continue
        rows = np.zeros(len(depth), dtype=bool)
        rows[begin:end] = True
        core = [x for x in stretches_of(ground, rows, kinds, SILT) if x[2] == CLAY]
        top, bottom = float(depth[begin]), float(depth[end - 1])
        ends = float(depth[measured][0]) + THINNEST, float(depth[-1]) - THINNEST
        if (
            not core
            or bottom - top > THICKEST_SEAM
            or top < ends[0]
            or bottom > ends[1]
        ):
            continue
        level = float(np.quantile(ground.net[rows], TROUGH))
        above = is_sand & (depth < top) & (depth >= top - THICKEST_SEAM)
        below = is_sand & (depth > bottom) & (depth <= bottom + THICKEST_SEAM)
        if not above.any() or not below.any():
            continue
        sand = min(float(np.median(ground.net[x])) for x in (above, below))
        if level < SOFTER * sand:
            is_soft = ground.net < np.sqrt(max(level, 1.0) * sand)
            hard = np.flatnonzero(~is_soft)
            top = float(depth[hard[hard < begin].max(initial=0)])
            bottom = float(depth[hard[hard >= end].min(initial=len(depth) - 1)])
            found.append((nearest(top), nearest(bottom)))
    return [(a, b) for a, b in found if THINNEST_SEAM - 1e-9 <= b - a < THICKEST_SEAM]


def nearest(depth: float) -> float:
    """Return a depth of a boundary (m)."""
    return round(round(depth / SPACING) * SPACING, 2)


def with_seams(ground: Ground, tops: list[float]) -> list[float]:
    """Return the tops with those of seams, the thickest first, in place of others that
    are near."""
    seams = sorted(seams_of(ground), key=lambda seam: seam[0] - seam[1])
    for top, bottom in seams[: max(MOST - len(tops), 0) // 2]:
        near = [t for t in tops if top - THINNEST / 2 < t < bottom + THINNEST / 2]
        tops = sorted({t for t in tops if t not in near or t == 0} | {top, bottom})
    return tops


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
    found = list[tuple[float, float, str]]()
    for name, places in groupby(np.flatnonzero(rows), lambda i: str(names[i])):
        depth = ground.depth[list(places)]
        if name != usual and depth[-1] - depth[0] > THINNEST_LENS - 1e-6:
            found.append((float(depth[0]), float(depth[-1]), name))
    return found


def bands_of(
    ground: Ground, rows: np.ndarray, kind: str
) -> list[tuple[float, float, str]]:
    """Return where rows [n] of one kind of soil differ much from their median, those of
    clay from that nearby."""
    if kind == CLAY:
        spacing = float(np.median(np.diff(ground.depth)))
        width = 2 * max(int(round(THICKEST_SEAM / spacing)), 1) + 1
        ratio = ground.net / np.maximum(median_filter(ground.net, width), LEAST_NET)
    else:
        ratio = ground.normalized / np.median(ground.normalized[rows])
    names = np.select([ratio > BAND, ratio < 1 / BAND], ["hard", "soft"], "")
    return stretches_of(ground, rows, names, "")


def rows_of(ground: Ground, top: float, bottom: float) -> np.ndarray:
    """Return the rows [n] of a layer that count: those that were measured, and not near
    a boundary, if there are others. Raises ValueError where there are none."""
    depth, end = ground.depth, float(ground.depth[-1])
    edge = TRANSITION if bottom - top >= 5 * TRANSITION else 0.0
    inside = (depth >= top) & (depth <= bottom) & (ground.effective_stress > 0)
    upper, lower = top + edge * (top > 0), bottom - edge * (bottom < end)
    measured = depth >= ground.measured_from
    far = inside & (depth >= upper) & (depth <= lower)
    for rows in (far & measured, far, inside & measured, inside):
        if rows.any():
            return np.asarray(rows)
    raise ValueError(
        f"no row of the test lies in the layer from {top:g} to {bottom:g} m"
    )


def seams_among(ground: Ground, every: Sequence[np.ndarray]) -> list[bool]:
    """Return which layers are seams of soft soil, by the rows [n] of each layer: thin,
    and in the trough softer than both neighbors."""
    depth, found = ground.depth, [False] * len(every)
    levels = [float(np.quantile(ground.net[rows], TROUGH)) for rows in every]
    for i in range(1, len(every) - 1):
        is_thin = np.ptp(depth[every[i]]) < THIN
        around = [float(np.median(ground.net[every[k]])) for k in (i - 1, i + 1)]
        found[i] = bool(is_thin and levels[i] < SOFTER * min(around))
    return found


def layers_of(ground: Ground, tops: list[float], given: np.ndarray) -> list[Layer]:
    """Return the layers with these tops. given: the kind of soil of each row [n] that
    is not to be judged by the test, else "". Raises ValueError where a layer has no row
    or no kind."""
    kinds = np.where(given != "", given, ground.kinds)
    bottoms = [*tops[1:], float(ground.depth[-1])]
    every = [rows_of(ground, top, bottom) for top, bottom in zip(tops, bottoms)]
    found = []
    for top, bottom, rows, is_seam in zip(
        tops, bottoms, every, seams_among(ground, every)
    ):
        words, count = np.unique(given[rows], return_counts=True)
        kind = str(words[count.argmax()])
        is_given = kind != ""
        if not is_given and np.isnan(ground.index[rows]).all():
            raise ValueError(
                "without sleeve friction nothing tells the soil of the layer from"
                f" {top:g} to {bottom:g} m"
            )
        trough = rows & (ground.net <= np.quantile(ground.net[rows], TROUGH))
        is_seam &= (kind or ground.kind(trough)) == CLAY
        rows = trough if is_seam else rows
        kind = kind or ground.kind(rows)
        lenses = [] if is_seam else stretches_of(ground, rows, kinds, kind)
        is_lens = np.zeros(len(rows), dtype=bool)
        for a, b, _ in lenses:
            is_lens |= (ground.depth >= a) & (ground.depth <= b)
        if (rows & ~is_lens).any():
            rows = rows & ~is_lens
        bands = [] if is_seam else bands_of(ground, rows, kind)
        found.append(Layer(top, bottom, kind, rows, lenses, bands, is_given, is_seam))
    return found
