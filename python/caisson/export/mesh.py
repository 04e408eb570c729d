# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of the soil for other programs: a regular grid around the wall, and sets of
nodes of any mesh. The wall itself is no part of the mesh."""
from dataclasses import dataclass, field

import numpy as np

from caisson.results import ResultsError
from caisson.export.state import TOLERANCE, State, Wall

CLOSE = 0.1  # of the shortest edge: a node so near to the wall is on it
MOST_CELLS = 200_000  # of a regular grid: some GB of memory


@dataclass
class Mesh:
    """Quadrilaterals, and triangles as quadrilaterals whose last two corners are one.

    nodes [n, 2]: r and z (m); cells [m, 4]: numbers of nodes, counterclockwise. sets:
    numbers of nodes by name; groups [m]: the names of the physical groups of a file;
    remark: what of the file is left out.
    """

    nodes: np.ndarray
    cells: np.ndarray
    sets: dict[str, np.ndarray] = field(default_factory=dict)
    groups: np.ndarray | None = None
    remark: str = ""

    @property
    def centers(self) -> np.ndarray:
        """The means of the corners: [m, 2]."""
        corners = self.nodes[self.cells]
        three = self.is_triangle[:, np.newaxis]
        return np.where(three, corners[:, :3].mean(axis=1), corners.mean(axis=1))

    @property
    def is_triangle(self) -> np.ndarray:
        """Whether cells have three corners: [m]."""
        return self.cells[:, 2] == self.cells[:, 3]

    @property
    def areas(self) -> np.ndarray:
        """The areas of the cells (m2), negative where they are clockwise: [m]."""
        return self._products().sum(axis=1) / 2

    @property
    def volumes(self) -> np.ndarray:
        """The volumes of the whole circumference (m3): [m]."""
        r = self.nodes[self.cells, 0]
        products = (r + np.roll(r, -1, axis=1)) * self._products()
        return np.pi / 3 * products.sum(axis=1)

    def _products(self) -> np.ndarray:
        """Return the cross products of the corners and those after them: [m, 4]."""
        x, y = np.moveaxis(self.nodes[self.cells], 2, 0)
        return x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y

    def edges(self) -> np.ndarray:
        """Return the edges that only one cell has: [k, 2], with the soil on their
        left."""
        pairs = np.stack([self.cells, np.roll(self.cells, -1, axis=1)], axis=2)
        pairs = pairs.reshape(-1, 2)
        pairs = pairs[pairs[:, 0] != pairs[:, 1]]
        _, which, count = np.unique(
            np.sort(pairs, axis=1), axis=0, return_index=True, return_counts=True
        )
        return pairs[which[count == 1]]


@dataclass
class Window:
    """What a regular grid covers, down to and out to (m), and its spacing (m)."""

    radius: float
    depth: float
    spacing: float


def default_window(state: State) -> Window:
    """Return twice the diameter in radius, and a diameter below the tip, within the
    domain of the run; a spacing of a fortieth of the diameter."""
    depth, wall = -state.bottom, state.wall
    if wall is None:
        return Window(state.outer_radius, depth, min(state.outer_radius, depth) / 40)
    width = 2 * wall.outer
    radius = min(2 * width, state.outer_radius)
    return Window(radius, min(depth, width - wall.tip), width / 40)


def steps(begin: float, end: float, spacing: float) -> np.ndarray:
    """Return equal steps of at most the spacing from begin to end, with both."""
    n = max(1, int(np.ceil(abs(end - begin) / spacing - 1e-9)))
    found = np.linspace(begin, end, n + 1)
    found[1:-1] = found[1:-1].round(6)  # the same in all parts of a mesh
    return found


def surface_of(state: State, r: np.ndarray, spacing: float) -> np.ndarray:
    """Return the height of the soil's surface at radii of one side of the wall (m):
    that of the uppermost points, and what was above them at the start."""
    low, high = r.min(), r.max()
    inside = (state.position[:, 0] >= low) & (state.position[:, 0] <= high)
    size = np.sqrt(state.volume / (2 * np.pi * state.position[:, 0]))
    start = state.position[:, 1] - state.displacement[:, 1]
    above = np.where((start < 0) & (-start < 2 * size), -start, 0.5 * size)
    at, top = [], []
    edge = low
    while edge < high:
        column = inside & (state.position[:, 0] >= edge)
        width = max(spacing, 2 * float(np.median(size[column])) if column.any() else 0)
        column &= state.position[:, 0] < edge + width
        if column.any():
            heights = np.where(column, state.position[:, 1] + above, -np.inf)
            at.append(float(state.position[np.argmax(heights), 0]))
            top.append(float(heights.max()))
        edge += width
    if not at:
        return np.zeros(len(r))
    padded = np.concatenate([top[:1], top, top[-1:]])
    smooth = np.median([padded[:-2], padded[1:-1], padded[2:]], axis=0)
    return np.interp(r, at, smooth)


def lattice(r: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return nodes and cells of columns at r [n] with rows at z [m] or [n, m]."""
    z = np.broadcast_to(z, (len(r), z.shape[-1]))
    nodes = np.stack([np.broadcast_to(r[:, np.newaxis], z.shape), z], axis=2)
    number = np.arange(z.size).reshape(z.shape)
    cells = np.stack(
        [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], axis=2
    )
    return nodes.reshape(-1, 2), cells.reshape(-1, 4)


def joined(parts: list[tuple[np.ndarray, np.ndarray]]) -> Mesh:
    """Return one mesh of parts that share nodes."""
    offset = np.cumsum([0] + [len(nodes) for nodes, _ in parts])
    nodes = np.concatenate([nodes for nodes, _ in parts])
    cells = np.concatenate([cells + o for (_, cells), o in zip(parts, offset)])
    _, first, number = np.unique(
        nodes.round(8), axis=0, return_index=True, return_inverse=True
    )
    return Mesh(nodes[first], number[cells])


def rising(shoulder: float, surface: np.ndarray, spacing: float) -> np.ndarray:
    """Return rows from the shoulder to the surface of each column: [n, m]."""
    share = steps(0, 1, spacing / max(spacing, abs(shoulder)))
    return shoulder + (surface[:, np.newaxis] - shoulder) * share


def regular(state: State, window: Window) -> Mesh:
    """Return the regular grid of a window. Above the tip its rows follow the surface of
    the soil. Raises ResultsError where the window has no place."""
    wall, spacing = state.wall, window.spacing
    if wall is None:
        r = steps(0, window.radius, spacing)
        z = rising(-window.depth, surface_of(state, r, spacing), spacing)
        return with_sets(joined([lattice(r, z)]), wall)
    if window.radius <= wall.outer or -window.depth >= wall.tip:
        raise ResultsError(
            f"the window of {window.radius:g} m x {window.depth:g} m does not reach"
            f" beyond the wall: take more than {wall.outer:g} m x {-wall.tip:g} m"
        )
    shoulder = wall.shoulder
    outside = steps(wall.outer, window.radius, spacing)
    inside = steps(0, wall.inner, spacing) if wall.inner > 0 else np.zeros(0)
    knots = wall.profile_r if wall.inner > 0 else steps(0, wall.outer, spacing)
    corners = np.unique([wall.inner, wall.middle, wall.outer])
    beneath = corners if wall.inner > 0 else knots
    parts = []
    for r in (inside, outside):
        if len(r):
            top = surface_of(state, r, spacing)
            parts.append(lattice(r, rising(shoulder, top, spacing)))
    columns = np.unique(np.concatenate([inside, beneath, outside]))
    rows = steps(-window.depth, shoulder, spacing)
    depth = np.broadcast_to(rows, (len(columns), len(rows))).copy()
    under = (columns >= wall.inner - 1e-9) & (columns <= wall.outer + 1e-9)
    bend = np.where(under, wall.lower_end(columns), shoulder) - shoulder
    low = wall.tip - 2 * spacing  # rows above it follow the tip
    share = np.clip((rows - low) / (shoulder - low), 0, 1)
    depth += bend[:, np.newaxis] * share
    parts.append(lattice(columns, depth))
    return with_sets(joined(parts), wall)


def check_spacing(state: State, window: Window) -> None:
    """Raise ResultsError where a regular grid has too many cells, or where its cells
    are too large for the wall."""
    spacing, wall = window.spacing, state.wall
    across, down = window.radius / spacing, window.depth / spacing
    if (across + 2) * (down + 2) > MOST_CELLS:
        fits = 1.05 * np.sqrt(window.radius * window.depth / MOST_CELLS)
        raise ResultsError(
            f"--spacing {spacing:g} m gives {across * down:.3g} cells, more than"
            f" {MOST_CELLS}: take {fits:.2g} m or more, or a smaller --radius or"
            " --depth"
        )
    if wall is None:
        return
    widest = min(wall.inner or wall.outer, -wall.tip) / 2
    widest = max(widest, default_window(state).spacing)
    if spacing > widest + TOLERANCE:
        raise ResultsError(
            f"--spacing {spacing:g} m does not resolve the wall of {wall.outer:g} m in"
            f" radius and {-wall.tip:g} m in depth: take at most {widest:.4g} m"
        )


def length_of_edges(mesh: Mesh) -> np.ndarray:
    """Return the shortest edge at each node (m): [n]."""
    shortest = np.full(len(mesh.nodes), np.inf)
    for i in range(4):
        a, b = mesh.cells[:, i], mesh.cells[:, (i + 1) % 4]
        length = np.hypot(*(mesh.nodes[a] - mesh.nodes[b]).T)
        length[a == b] = np.inf
        np.minimum.at(shortest, a, length)
        np.minimum.at(shortest, b, length)
    return shortest


def with_sets(mesh: Mesh, wall: Wall | None) -> Mesh:
    """Set the nodes on the sides, on the wall and on the surface. Raises ResultsError
    where a wall is in the ground and not in the mesh."""
    r, z = mesh.nodes.T
    edge = np.zeros(len(r), dtype=bool)
    edge[mesh.edges()] = True
    close = CLOSE * length_of_edges(mesh)
    masks = {
        "AXIS": edge & (r < close),
        "BOTTOM": edge & (z < z.min() + close),
        "OUTER": edge & (r > r.max() - close),
    }
    held = masks["BOTTOM"] | masks["OUTER"]
    on_wall = np.zeros(len(r), dtype=bool)
    if wall is not None:
        around = edge & (r > wall.inner - close) & (r < wall.outer + close)
        # a mesh may have a flat tip where that of the body has a bevel
        masks["TIP"] = around & ~held & (z < wall.shoulder + close)
        masks["TIP"] &= z > wall.tip - close
        free = around & ~masks["TIP"] & (z > wall.shoulder)
        masks["OUTER_WALL"] = free & (abs(r - wall.outer) < close)
        masks["INNER_WALL"] = free & (abs(r - wall.inner) < close) & (wall.inner > 0)
        on_wall = masks["TIP"] | masks["OUTER_WALL"] | masks["INNER_WALL"]
        if not masks["TIP"].any() or not masks["OUTER_WALL"].any():
            raise ResultsError(
                f"the mesh has no edges on the wall, {wall.inner:g} m <= r <="
                f" {wall.outer:g} m down to z = {wall.tip:g} m: cut the section of the"
                " body out of it"
            )
    other = masks["AXIS"] | held | on_wall
    masks["SURFACE"] = edge & ~other
    a, b = mesh.edges().T  # its ends are on other sides too
    ends = np.concatenate([a[other[a] & ~other[b]], b[other[b] & ~other[a]]])
    masks["SURFACE"][ends] = True
    if (
        wall is not None
        and masks["SURFACE"].any()
        and z[masks["SURFACE"]].min() < wall.tip
    ):
        lowest = np.argmin(np.where(masks["SURFACE"], z, np.inf))
        raise ResultsError(
            f"the mesh has an edge at r = {r[lowest]:g} m, z = {z[lowest]:g} m that is"
            " neither on the axis, the wall or the surface, nor on a level bottom or a"
            " vertical side"
        )
    mesh.sets = {name: np.flatnonzero(mask) for name, mask in masks.items()}
    mesh.sets = {name: numbers for name, numbers in mesh.sets.items() if len(numbers)}
    return mesh
