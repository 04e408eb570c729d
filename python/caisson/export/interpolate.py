# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values of material points anywhere in the soil, by moving least squares.

A value is that of the plane a + b (r - r0) + c (z - z0) that fits the nearest points,
weighted by volume and distance, so that a state linear in r and z is met exactly.
Points behind the wall, and of another layer, do not count. The scatter is the
weighted standard deviation of the points from the plane.
Reference: Lancaster and Salkauskas (1981), Math. Comp. 37, 141-158.
"""
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from caisson.export.state import State, Wall

NEIGHBORS = (24, 96, 384)  # more where the nearest are on one line
LOOKED_AT = 4  # times as many: some are behind the wall
FEWEST = 8
POOR = 0.1  # spread of the neighbors in one direction over that in the other
FARTHEST = 1.5  # of their mean from the place, over their spread
AT_ONCE = 4000  # places


@dataclass
class Neighbors:
    """Points near some places: numbers and weights, [n, k], the latter with the sum 1;
    a weight of 0 is no neighbor. step: from the places to them, [n, k, 2] (m); layer:
    that of the nearest point, [n]."""

    index: np.ndarray
    weight: np.ndarray
    step: np.ndarray
    layer: np.ndarray


def hidden(places: np.ndarray, points: np.ndarray, wall: Wall) -> np.ndarray:
    """Return whether the wall stands between places [n, 2] and points [n, k, 2]: the
    line between them crosses the middle of the wall above the tip."""
    r, z = places[:, np.newaxis, 0], places[:, np.newaxis, 1]
    across = (r - wall.middle) * (points[..., 0] - wall.middle) < 0
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (wall.middle - r) / (points[..., 0] - r)
        height = z + share * (points[..., 1] - z)
    return across & (height > wall.tip)


def found(
    state: State, tree: cKDTree, places: np.ndarray, looked_at: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return distance, number and whether it counts of the nearest points."""
    distance, index = tree.query(places, min(looked_at, len(state.position)))
    counts = np.ones(index.shape, dtype=bool)
    if state.wall is not None and state.wall.inner > 0:
        counts = ~hidden(places, state.position[index], state.wall)
    nearest = np.argmax(counts, axis=1)[:, np.newaxis]
    layer = np.take_along_axis(state.layer[index], nearest, 1)
    alike = counts & (state.layer[index] == layer)
    enough = alike.sum(axis=1, keepdims=True) >= FEWEST
    return distance, index, np.where(enough, alike, counts)


def neighbors(state: State, tree: cKDTree, places: np.ndarray, n: int) -> Neighbors:
    """Return the n nearest neighbors of places [m, 2]."""
    distance, index, counts = found(state, tree, places, LOOKED_AT * n)
    if counts.sum(axis=1).min() < n:
        distance, index, counts = found(state, tree, places, 8 * LOOKED_AT * n)
    order = np.argsort(~counts, axis=1, kind="stable")[:, :n]
    distance, index, counts = (
        np.take_along_axis(x, order, 1) for x in (distance, index, counts)
    )
    support = 1.01 * np.max(np.where(counts, distance, 0), axis=1, keepdims=True)
    kernel = np.maximum(1 - (distance / support) ** 2, 0) ** 2 * counts
    weight = kernel * state.volume[index]
    weight = weight / weight.sum(axis=1, keepdims=True)
    step = state.position[index] - places[:, np.newaxis]
    return Neighbors(index, weight, step, state.layer[index[:, 0]])


def is_poor(near: Neighbors) -> np.ndarray:
    """Return whether the neighbors are almost on one line, or far to one side of the
    place: [n]."""
    step, weight = near.step, near.weight[..., np.newaxis]
    mean = (weight * step).sum(axis=1)
    spread = np.sqrt((weight * (step - mean[:, np.newaxis]) ** 2).sum(axis=1))
    beside = (abs(mean) > FARTHEST * spread).any(axis=1)
    return beside | (spread.min(axis=1) < POOR * spread.max(axis=1))


def plane_weights(near: Neighbors) -> np.ndarray:
    """Return what the value of each neighbor counts in the plane at the place:
    [n, k], sum 1; of the mean where the points do not span a plane."""
    weight, step = near.weight, near.step
    size = abs(step).max(axis=1, keepdims=True)
    basis = np.concatenate([np.ones((*step.shape[:2], 1)), step / size], axis=2)
    moments = np.einsum("nk,nki,nkj->nij", weight, basis, basis)
    poor = np.linalg.cond(moments) > 1e4
    moments[poor] = np.eye(3)
    first = np.linalg.solve(moments, np.tile(np.eye(3)[:, :1], (len(moments), 1, 1)))
    shares = weight * np.einsum("nki,ni->nk", basis, first[:, :, 0])
    shares[poor] = weight[poor]
    return shares


def within(values: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Return values [n, m], not further beyond those of the neighbors [n, k, m] than
    half of their range."""
    low, high = near.min(axis=1), near.max(axis=1)
    return np.clip(values, 1.5 * low - 0.5 * high, 1.5 * high - 0.5 * low)


@dataclass
class Values:
    """What is interpolated at n places: stress and its scatter [n, 4] (Pa), pressure
    [n] (Pa), displacement [n, 2] (m), fields [n] by name, layer [n]."""

    stress: np.ndarray
    scatter: np.ndarray
    pressure: np.ndarray
    displacement: np.ndarray
    fields: dict[str, np.ndarray]
    layer: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """The stress less the excess pore pressure where that is known: [n, 4] (Pa). It
        is the total stress less the hydrostatic pressure, which balances buoyant
        weight."""
        return self.stress - self.pressure[:, np.newaxis] * [1, 1, 1, 0]

    def put(self, places: np.ndarray, of: "Values") -> None:
        """Take the values of others at some places, by their numbers."""
        for name in ("stress", "scatter", "pressure", "displacement", "layer"):
            getattr(self, name)[places] = getattr(of, name)
        for name, values in of.fields.items():
            self.fields[name][places] = values


def mean_of(values: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Return the weighted mean of neighbors [n, k], without those that are not a
    number."""
    known = np.isfinite(values) & (weight > 0)
    total = np.where(known, weight, 0).sum(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(known, weight * values, 0).sum(axis=1) / total


def interpolate_some(state: State, near: Neighbors) -> Values:
    """Return the values at the places of some neighbors."""
    shares, weight, step = plane_weights(near), near.weight, near.step
    pressure = np.zeros(len(state.position))
    if state.pressure is not None:
        pressure = state.pressure
    linear = np.column_stack([state.stress, pressure, state.displacement])[near.index]
    # a neighbor that does not count must not widen the range
    shown = np.where(near.weight[..., np.newaxis] > 0, linear, linear[:, :1])
    at = within(np.einsum("nk,nkm->nm", shares, linear), shown)
    moments = np.einsum("nk,nki,nkj->nij", weight, step, step)
    away = state.stress[near.index] - at[:, np.newaxis, :4]
    slope = np.linalg.pinv(moments) @ np.einsum("nk,nki,nkm->nim", weight, step, away)
    rest = away - np.einsum("nki,nim->nkm", step, slope)
    scatter = np.sqrt(np.einsum("nk,nkm->nm", weight, rest**2))
    fields = {
        name: mean_of(values[near.index], weight)
        for name, values in state.fields.items()
    }
    return Values(at[:, :4], scatter, at[:, 4], at[:, 5:], fields, near.layer)


def interpolate(state: State, places: np.ndarray) -> Values:
    """Return the values at places [n, 2] (m)."""
    tree = cKDTree(state.position)
    n, m = len(places), len(state.position)
    result = Values(
        np.zeros((n, 4)),
        np.zeros((n, 4)),
        np.zeros(n),
        np.zeros((n, 2)),
        {name: np.zeros(n) for name in state.fields},
        np.zeros(n, dtype=int),
    )
    left = np.arange(n)
    for count in NEIGHBORS:
        poor = []
        for begin in range(0, len(left), AT_ONCE):
            some = left[begin : begin + AT_ONCE]
            near = neighbors(state, tree, places[some], min(count, m))
            result.put(some, interpolate_some(state, near))
            poor.append(some[is_poor(near)])
        left = np.concatenate(poor)
        if not len(left):
            break
    return result
