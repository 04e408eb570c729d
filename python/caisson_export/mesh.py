# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of the soil for other programs: a regular grid around the wall, or a file of
Gmsh. The wall itself is no part of the mesh."""
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from caisson.results import ResultsError
from caisson_export.state import TOLERANCE, State, Wall

CLOSE = 0.1  # of the shortest edge: a node so near to the wall is on it
MOST_CELLS = 200_000  # of a regular grid: some GB of memory
CORNERS = {2: 3, 3: 4}  # types of elements of Gmsh: triangles and quadrilaterals


@dataclass
class Mesh:
    """Quadrilaterals, and triangles as quadrilaterals whose last two corners are one.

    nodes [n, 2]: r and z (m); cells [m, 4]: numbers of nodes, counterclockwise. sets:
    numbers of nodes by name; groups [m]: the names of the physical groups of a file.
    """

    nodes: np.ndarray
    cells: np.ndarray
    sets: dict[str, np.ndarray] = field(default_factory=dict)
    groups: np.ndarray | None = None

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
        masks["TIP"] = around & ~held & (z < wall.lower_end(r) + close)
        masks["TIP"] &= z > wall.lower_end(r) - close
        free = around & ~masks["TIP"] & (z > wall.lower_end(r))
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


def sections(lines: list[str]) -> dict[str, list[str]]:
    """Return the lines of a file of Gmsh between $Name and $EndName by name."""
    result: dict[str, list[str]] = {}
    name = ""
    for line in lines:
        if line.startswith("$End"):
            name = ""
        elif line.startswith("$"):
            name = line[1:].strip()
            result[name] = []
        elif name:
            result[name].append(line)
    return result


def read_2(
    parts: dict[str, list[str]]
) -> tuple[dict[int, list[float]], list[list[int]]]:
    """Return nodes by their tags, and [tag of the group, corners...] of cells, of
    format 2.2."""
    nodes = {}
    for line in parts["Nodes"][1:]:
        tag, *x = line.split()
        nodes[int(tag)] = [float(value) for value in x]
    cells = []
    for line in parts["Elements"][1:]:
        numbers = [int(word) for word in line.split()]
        if numbers[1] in CORNERS:
            group = numbers[3] if numbers[2] else 0
            cells.append([group, *numbers[3 + numbers[2] :]])
    return nodes, cells


def read_4(
    parts: dict[str, list[str]]
) -> tuple[dict[int, list[float]], list[list[int]]]:
    """Return the same of format 4.1."""
    groups = {}
    if "Entities" in parts:
        n = [int(word) for word in parts["Entities"][0].split()]
        for line in parts["Entities"][1 + n[0] + n[1] :][: n[2]]:
            words = line.split()
            groups[int(words[0])] = int(words[8]) if int(words[7]) else 0
    nodes, lines = {}, iter(parts["Nodes"])
    for _ in range(int(next(lines).split()[0])):
        n_nodes = int(next(lines).split()[3])
        tags = [int(next(lines)) for _ in range(n_nodes)]
        for tag in tags:
            nodes[tag] = [float(word) for word in next(lines).split()[:3]]
    cells, lines = [], iter(parts["Elements"])
    for _ in range(int(next(lines).split()[0])):
        _, entity, kind, n_cells = (int(word) for word in next(lines).split())
        for _ in range(n_cells):
            numbers = [int(word) for word in next(lines).split()]
            if kind in CORNERS:
                cells.append([groups.get(entity, 0), *numbers[1:]])
    return nodes, cells


def read_gmsh(path: Path, wall: Wall | None) -> Mesh:
    """Return the mesh of a text file of Gmsh, format 2.2 or 4.1, of triangles and
    quadrilaterals of first order with r = x and z = y, without the cells in the wall.
    Raises ResultsError."""
    try:
        parts = sections(path.read_text(encoding="utf-8").splitlines())
        version = parts["MeshFormat"][0].split()
        if version[0] not in ("2.2", "4.1") or version[1] != "0":
            raise ResultsError(
                f"{path} has the format {' '.join(version[:2])}: save it as text of"
                " version 2.2 or 4.1 (gmsh -format msh41 -bin 0)"
            )
        read = read_2 if version[0] == "2.2" else read_4
        found, cells = read(parts)
    except (
        OSError,
        UnicodeError,
        KeyError,
        ValueError,
        IndexError,
        StopIteration,
    ) as e:
        raise ResultsError(
            f"{path} is no text file of Gmsh that can be read: {e}"
        ) from e
    if not cells:
        raise ResultsError(f"{path} has no triangles or quadrilaterals of first order")
    tags = np.array(sorted(found))
    nodes = np.array([found[tag] for tag in tags])
    if np.ptp(nodes[:, 2]) > 0:
        raise ResultsError(
            f"{path} is not in the plane x = r, y = z of an axisymmetric"
        )
    corners = np.array([cell[1:] + cell[-1:] * (5 - len(cell)) for cell in cells])
    if (missing := np.setdiff1d(corners, tags)).size:
        raise ResultsError(
            f"{path} has an element with the node {missing[0]}, which is not among its"
            " $Nodes"
        )
    mesh = Mesh(nodes[:, :2], np.searchsorted(tags, corners))
    mesh.groups = np.array([cell[0] for cell in cells])
    return with_sets(trimmed(mesh, wall, path), wall)


def trimmed(mesh: Mesh, wall: Wall | None, path: Path) -> Mesh:
    """Return a mesh without the cells in the wall and nodes of no cell, and with all
    cells counterclockwise."""
    if mesh.nodes[:, 0].min() < -1e-9:
        raise ResultsError(f"{path} has nodes at r < 0: the axis is x = 0")
    kept = np.ones(len(mesh.cells), dtype=bool)
    if wall is not None:
        kept = ~wall.contains(mesh.centers)
    cells = mesh.cells[kept]
    x, y = np.moveaxis(mesh.nodes[cells], 2, 0)
    area = (x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1)
    turned = cells[:, [2, 1, 0, 3]]
    turned[cells[:, 2] == cells[:, 3]] = cells[cells[:, 2] == cells[:, 3]][
        :, [1, 0, 2, 2]
    ]
    cells = np.where(area[:, np.newaxis] < 0, turned, cells)
    used, number = np.unique(cells, return_inverse=True)
    groups = None if mesh.groups is None else mesh.groups[kept]
    return Mesh(mesh.nodes[used], number.reshape(cells.shape), {}, groups)
