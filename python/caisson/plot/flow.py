# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flow lines of the pore water, found from the excess pore pressure of the points.

Water flows against the gradient of the excess pressure (Darcy). Lines through
equal shares of what rises at one level need no permeability but there, and that only as
a factor. Where no water is stored, the flow between two of them is the same all along;
where soil stores water or gives it off, lines end or begin within the soil. The
permeability is taken to be the same in all directions.
"""
import numpy as np

from caisson.plot.cells import CellMeans, cell_of

MOST_STEPS = 4000  # of a line
STEP = 0.3  # of the size of a cell
PIECES = 4  # of the width of a cell in the mudline


class Flow:
    """The flow through the soil, in the unit of the pressure per meter, linear in
    each cell and continuous."""

    def __init__(self, means: CellMeans, pressure: np.ndarray) -> None:
        """pressure: excess at the points, nan of those in which no water flows. Cells
        that such points share with others have no lines either: they conduct along the
        boundary, but not across it."""
        self.corners, self.axisymmetric = means.polygons, means.axisymmetric
        flow = -means.gradients(pressure)
        no_flow = means.of(np.isnan(pressure).astype(float)) > 0
        flow[no_flow] = np.nan
        corners = [means.at_corners(part) for part in flow.T]
        self.at_corners = np.nan_to_num(np.stack(corners, axis=-1))
        self.at_corners[no_flow] = np.nan

    def heights(
        self, cell: np.ndarray, r: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return the place of r in the width of its cell, from 0 to 1, and bottom
        and top of the cell there."""
        corners = self.corners[cell]
        left, right = corners[:, 0, 0], corners[:, 1, 0]
        xi = (r - left) / (right - left)
        bottom = (1 - xi) * corners[:, 0, 1] + xi * corners[:, 1, 1]
        return xi, bottom, (1 - xi) * corners[:, 3, 1] + xi * corners[:, 2, 1]

    def at(self, position: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the flow [n, 2] at positions [n, 2], nan out of the soil, and the
        sizes of their cells."""
        cell = cell_of(position, self.corners)
        xi, bottom, top = self.heights(cell, position[:, 0])
        eta = (position[:, 1] - bottom) / np.maximum(top - bottom, 1e-12)
        shares = [(1 - xi) * (1 - eta), xi * (1 - eta), xi * eta, (1 - xi) * eta]
        result = np.einsum("kn,nkc->nc", np.stack(shares), self.at_corners[cell])
        result[(cell < 0) | ~((eta > -1e-6) & (eta < 1 + 1e-6))] = np.nan
        corners = self.corners[cell]
        width = corners[:, 1, 0] - corners[:, 0, 0]
        return result, np.minimum(width, np.maximum(top - bottom, 0.2 * width))

    def pieces(self) -> tuple[np.ndarray, np.ndarray]:
        """Return the radii of the middles of some pieces of each column of cells, from
        the axis outward, and the widths of the pieces."""
        lines = np.unique(np.round(self.corners[:, :2, 0], 6))
        share = np.arange(PIECES) / PIECES
        ends = np.append(lines[:-1, None] + np.diff(lines)[:, None] * share, lines[-1])
        return (ends[:-1] + ends[1:]) / 2, np.diff(ends)

    def mudline(self, body: np.ndarray) -> list[np.ndarray]:
        """Return the parts of the mudline, each [n, 2], from the axis outward, between
        which a body stands in the soil. body: its cells [n, 4, 2]."""
        r, width = self.pieces()
        cell = cell_of(np.column_stack([r, np.full(len(r), np.inf)]), self.corners)
        xi, _, top = self.heights(cell, r)
        above = (
            (body[..., 0].min(axis=1) < r[:, None])
            & (body[..., 0].max(axis=1) > r[:, None])
            & (body[..., 1].min(axis=1) < top[:, None] + 1e-3)
        ).any(axis=1)
        soil = (cell >= 0) & (xi >= 0) & (xi <= 1) & ~above
        place, width = np.column_stack([r, top])[soil], width[soil]
        gap = np.diff(place[:, 0]) > 0.6 * (width[1:] + width[:-1])
        return np.split(place, np.flatnonzero(gap) + 1)

    def starts(self, n: int, level: float, radius: float) -> np.ndarray:
        """Return places [n, 2] at a level, within a radius, in the middles of n equal
        shares of the water that rises there, or that sinks where more does."""
        r, width = self.pieces()
        r, width = r[r < radius], width[r < radius]
        place = np.column_stack([r, np.full(len(r), level)])
        rising = np.nan_to_num(self.at(place)[0][:, 1]) * width
        rising *= r if self.axisymmetric else 1
        up, down = np.maximum(rising, 0), np.maximum(-rising, 0)
        most = up if up.sum() >= 0.9 * down.sum() else down
        if most.sum() <= 0:
            return np.empty((0, 2))
        through = np.append(0, np.cumsum(most))
        ends = np.append(r - width / 2, r[-1] + width[-1] / 2)
        goals = (np.arange(n) + 0.5) / n * through[-1]
        return np.column_stack([np.interp(goals, through, ends), np.full(n, level)])

    def lines(self, starts: np.ndarray) -> list[np.ndarray]:
        """Return the flow line through each start [n, 2] as [points, 2], downstream."""
        both = [self._followed(starts, direction) for direction in (-1, 1)]
        return [np.concatenate([up[:0:-1], down]) for up, down in zip(*both)]

    def _followed(self, position: np.ndarray, direction: int) -> list[np.ndarray]:
        """Return the lines from some positions on, along the flow or against it."""
        if len(position) == 0:
            return []
        paths, before = [position], np.zeros_like(position)
        for _ in range(MOST_STEPS):
            way = self._way(position, direction)
            way[(way * before).sum(axis=1) < 0] = np.nan  # to and fro at a source
            position, before = position + way, way
            if not np.isfinite(position).any():
                break
            paths.append(position)
        whole = np.stack(paths, axis=1)
        return [line[np.isfinite(line[:, 0])] for line in whole]

    def _way(self, position: np.ndarray, direction: int) -> np.ndarray:
        """Return a step along the flow: midpoint rule, a share of a cell long."""
        flow, size = self.at(position)
        length = STEP * size[:, None]
        half = direction * length / 2 * unit(flow)
        return direction * length * unit(self.at(position + half)[0])


def unit(vectors: np.ndarray) -> np.ndarray:
    """Return vectors of length 1; nan for those of length 0."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(length > 0, length, np.nan)
