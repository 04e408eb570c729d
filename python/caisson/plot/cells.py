# SPDX-License-Identifier: LGPL-2.1-or-later
"""Material points in the cells of the background grid.

The sides of all cells are vertical, and the cells between two neighboring lines lie
on top of each other, so that a count of the cell bottoms below a point gives its
cell; cells that are halved have more lines beside them. A picture paints each cell
with the mean of its points, or with values between the means of neighbors; where the
soil ends in a cell, the cell is cut to the part that its points fill, and neighbors
meet at the mean of their heights.
"""
import numpy as np


def cell_of(position: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return the index [n_points] of the cell that each point lies in; points out of
    all cells to the left or right get -1, those above or below the last or first
    cell there.

    position: [n_points, 2]; corners: [n_cells, 4, 2] as vtu.corners_of gives them.
    """
    result = np.full(len(position), -1)
    left, right = corners[:, 0, 0], corners[:, 1, 0]
    lines = np.unique(np.concatenate([left, right]))
    strip = np.searchsorted(lines, position[:, 0], side="right") - 1
    for i in np.unique(strip[(strip >= 0) & (strip < len(lines) - 1)]):
        cells = np.flatnonzero((left <= lines[i]) & (right >= lines[i + 1]))
        cells = cells[np.argsort(corners[cells, 0, 1] + corners[cells, 1, 1])]
        points = np.flatnonzero(strip == i)
        x = position[points, :1]
        xi = (x - left[cells]) / (right[cells] - left[cells])
        bottoms = (1 - xi) * corners[cells, 0, 1] + xi * corners[cells, 1, 1]
        row = (position[points, 1:] >= bottoms).sum(axis=1) - 1
        result[points] = cells[np.maximum(row, 0)]
    return result


class CellMeans:
    """The cells that hold soil, as polygons, and means over their points."""

    def __init__(
        self,
        position: np.ndarray,
        volume: np.ndarray,
        corners: np.ndarray,
        rigid: np.ndarray,
        axisymmetric: bool = True,
    ) -> None:
        """position [n_points, 2], volume [n_points]: of the whole circumference, or of
        1 m in plane strain; of the grid corners [n_cells, 4, 2] and rigid [n_cells]."""
        n = len(corners)
        self.cell = cell_of(position, corners)
        self.cell[self.cell >= 0] = np.where(
            rigid[self.cell[self.cell >= 0]], -1, self.cell[self.cell >= 0]
        )  # written in single precision
        self.known = self.cell >= 0
        self.position = position
        self.volume = volume
        self.total = self._sum(volume, n)
        width = corners[:, 1, 0] - corners[:, 0, 0]
        height = (
            corners[:, 3, 1] + corners[:, 2, 1] - corners[:, 0, 1] - corners[:, 1, 1]
        ) / 2
        radius = (corners[:, 0, 0] + corners[:, 1, 0]) / 2
        length = 2 * np.pi * radius if axisymmetric else np.ones_like(radius)
        self.axisymmetric = axisymmetric
        self.area = volume / np.where(self.known, length[self.cell], 1)
        self.used = np.flatnonzero(self.total > 0)
        self.row = np.searchsorted(self.used, self.cell).clip(max=len(self.used) - 1)
        fill = self.total / (width * height * length)
        self.polygons = self._cut_surface(corners, rigid, fill)[self.used]

    def _sum(self, weights: np.ndarray, n: int) -> np.ndarray:
        return np.bincount(self.cell[self.known], weights[self.known], n)

    def _cut_surface(
        self, corners: np.ndarray, rigid: np.ndarray, fill: np.ndarray
    ) -> np.ndarray:
        """Lower the top of cells with soil that have only void above."""
        result = corners.copy()
        soil = np.flatnonzero(self.total > 0)
        middles, tops = corners[soil].mean(axis=1), corners[soil, 2:].mean(axis=1)
        above = cell_of(tops + 1e-3 * (tops - middles), corners)
        is_open = (above == soil) | ~(rigid[above] | (self.total[above] > 0))
        ends = soil[is_open]
        for top, bottom in ((3, 0), (2, 1)):
            low, high = corners[ends, bottom], corners[ends, top]
            share = np.minimum(fill[ends], 1.0)[:, None]
            result[ends, top] = low + share * (high - low)
        return self._meeting(result, corners, ends)

    @staticmethod
    def _meeting(
        result: np.ndarray, corners: np.ndarray, ends: np.ndarray
    ) -> np.ndarray:
        """Let the tops of cells at the surface meet where neighbors have a side in
        common that is not much higher at one of them. ends: those cells [n]."""
        height = corners[ends, 3, 1] - corners[ends, 0, 1]
        by_left = {round(float(corners[i, 0, 0]), 6): k for k, i in enumerate(ends)}
        for k, i in enumerate(ends):
            beside = by_left.get(round(float(corners[i, 1, 0]), 6))
            if beside is None:
                continue
            j = ends[beside]
            left, right = result[i, 2, 1], result[j, 3, 1]
            if abs(left - right) <= 2 * max(height[k], height[beside]):
                result[i, 2, 1] = result[j, 3, 1] = (left + right) / 2
        return result

    def at_corners(self, means: np.ndarray) -> np.ndarray:
        """Return a field at the corners of the polygons [n_used, 4]: the mean of the
        cells [n_used] that meet there and have a value."""
        corner = np.round(self.polygons.reshape(-1, 2), 6)
        node = np.unique(corner, axis=0, return_inverse=True)[1].ravel()
        known = np.repeat(np.isfinite(means), 4)
        sums = np.bincount(node, np.where(known, np.repeat(means, 4), 0))
        count = np.bincount(node, known)
        found = np.divide(sums, count, out=np.full(len(sums), np.nan), where=count > 0)
        return found[node].reshape(-1, 4)

    def of(self, values: np.ndarray) -> np.ndarray:
        """Return the means of a field [n_points] over the polygons, by volume. Points
        at which it is nan are left out; nan where there is no other."""
        n, known = len(self.total), np.isfinite(values)
        sums = self._sum(np.where(known, self.volume * values, 0), n)[self.used]
        total = self._sum(np.where(known, self.volume, 0), n)[self.used]
        return np.divide(sums, total, out=np.full(len(sums), np.nan), where=total > 0)

    def gradients(self, values: np.ndarray) -> np.ndarray:
        """Return the gradients [n_used, 2] of the affine fit of a field [n_points] to
        the points of each cell that know it; nan where too few of them, or a line, give
        none."""
        positions = np.where(np.isfinite(values), self.position.T, np.nan)
        place = [self.of(x)[self.row] for x in positions]
        off_r, off_z = (x - mean for x, mean in zip(positions, place))
        rr, rz, zz, fr, fz = (
            self.of(product)
            for product in (
                *(off_r * off_r, off_r * off_z, off_z * off_z),
                *(off_r * values, off_z * values),
            )
        )
        determinant = rr * zz - rz * rz
        known = determinant > 1e-6 * rr * zz
        determinant[~known] = np.nan
        return np.column_stack([zz * fr - rz * fz, rr * fz - rz * fr]) / (
            determinant[:, np.newaxis]
        )
