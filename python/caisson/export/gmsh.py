# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of Gmsh: text files of triangles and quadrilaterals with r = x and z = y."""
import re
from pathlib import Path

import numpy as np

from caisson.results import ResultsError
from caisson import disk
from caisson.export.mesh import CLOSE, Mesh, default_window, with_sets
from caisson.export.state import State, Wall

CORNERS = {2: 3, 3: 4}  # types of elements of Gmsh: triangles and quadrilaterals
Nodes = dict[int, list[float]]  # r, z and 0 by tag


def sections(text: str) -> dict[str, list[str]]:
    """Return the lines of a file of Gmsh between $Name and $EndName by name."""
    found = re.findall(r"^\$(?!End)(\w+)\s*\n(.*?)(?=^\$|\Z)", text, re.M | re.S)
    return {name: lines.splitlines() for name, lines in found}


def read_2(parts: dict[str, list[str]]) -> tuple[Nodes, list[list[int]]]:
    """Return nodes by their tags, and [tags of group and surface, corners...] of cells,
    of format 2.2."""
    lines = (line.split() for line in parts["Nodes"][1:])
    nodes, cells = {int(tag): list(map(float, x)) for tag, *x in lines}, []
    for line in parts["Elements"][1:]:
        numbers = [int(word) for word in line.split()]
        if numbers[1] in CORNERS:
            group, surface, *_ = [*numbers[3 : 3 + numbers[2]], 0, 0]
            cells.append([group, surface, *numbers[3 + numbers[2] :]])
    return nodes, cells


def read_4(parts: dict[str, list[str]]) -> tuple[Nodes, list[list[int]]]:
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
                cells.append([groups.get(entity, 0), entity, *numbers[1:]])
    return nodes, cells


@disk.reads
def parsed(path: Path) -> tuple[Mesh, np.ndarray, dict[int, str]]:
    """Return the mesh of a text file of Gmsh, format 2.2 or 4.1, with all of its
    triangles and quadrilaterals of first order, the surface of each [m], and the names
    of its groups. Raises ResultsError."""
    try:
        data = disk.read_bytes(path, ResultsError)
        version = data.split(b"$MeshFormat", 1)[1].split(maxsplit=2)[:2]
        if version[0] not in (b"2.2", b"4.1") or version[1] != b"0":
            kind = "is binary" if version[1] != b"0" else "has another version"
            raise ResultsError(
                f"{path} {kind} ({b' '.join(version).decode()}): save it as text by"
                f" gmsh {path} -save -format msh41 -o {path.stem}_text.msh"
            )
        parts = sections(disk.read_text(path, ResultsError))
        found, cells = (read_2 if version[0] == b"2.2" else read_4)(parts)
        words = [line.split(maxsplit=2) for line in parts.get("PhysicalNames", [])[1:]]
        names = {int(tag): name.strip('"') for kind, tag, name in words if kind == "2"}
    except (KeyError, ValueError, IndexError, StopIteration) as e:
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
    corners = np.array([cell[2:] + cell[-1:] * (6 - len(cell)) for cell in cells])
    if (missing := np.setdiff1d(corners, tags)).size:
        raise ResultsError(
            f"{path} has an element with the node {missing[0]}, which is not among its"
            " $Nodes"
        )
    mesh = Mesh(nodes[:, :2], np.searchsorted(tags, corners))
    mesh.groups, surfaces = np.array([cell[:2] for cell in cells]).T
    return mesh, surfaces, names


def read_gmsh(path: Path, state: State) -> Mesh:
    """Return the mesh of a file for a state of the soil, without the cells in the wall.
    Raises ResultsError."""
    mesh, surfaces, names = parsed(path)
    check_extent(mesh, state, path)
    kept = np.ones(len(mesh.cells), dtype=bool)
    if state.wall is not None:
        kept = ~in_wall(mesh, surfaces, state.wall)
    return with_sets(trimmed(mesh, kept, words_on(mesh, kept, names)), state.wall)


def check_extent(mesh: Mesh, state: State, path: Path) -> None:
    """Raise ResultsError where a mesh has other units than m, or another origin than
    the axis and the surface of the ground."""
    r, z = mesh.nodes[np.unique(mesh.cells)].T
    reach = f"{path} reaches to r = {r.max():g} m, and from z = {z.max():g} m to"
    reach += f" {z.min():g} m"
    ends = f"the run ends at r = {state.outer_radius:g} m, z = {state.bottom:g} m"
    if r.min() < -1e-9:
        raise ResultsError(f"{path} has nodes at r < 0: the axis is x = 0")
    size, whole = max(r.max(), np.ptp(z)), max(state.outer_radius, -state.bottom)
    least = state.wall.outer if state.wall else whole / 30
    for unit, factor in ("mm", 1e3), ("cm", 1e2):
        if r.max() > factor * least and size < 3 * factor * whole and size > 5 * whole:
            raise ResultsError(
                f"{reach}, and {ends}: it seems to be in {unit}; scale it to m"
            )
    if state.wall is not None and r.max() <= least:
        raise ResultsError(
            f"{reach}, and the wall stands at r = {least:g} m: the file must be in m,"
            " and reach beyond the wall"
        )
    far = float(z[r > r.max() - CLOSE * r.max()].max())
    if abs(far) > 2 * default_window(state).spacing:
        turned = ", or turn the sign of z if it points downward" if far > 0 else ""
        raise ResultsError(
            f"{reach}: the surface of the ground must be at z = 0, as in the run; move"
            f" the mesh by {-far:.4g} m{turned}"
        )


def in_wall(mesh: Mesh, surfaces: np.ndarray, wall: Wall) -> np.ndarray:
    """Return which cells are the wall: [m].

    They have their centers in it, or are of a surface of Gmsh of which more than half,
    below the ground's surface, lies between the radii of the wall and above its tip: so
    are the corners of a flat tip where that of the body has a bevel.
    """
    r, z = mesh.centers.T
    found = wall.contains(mesh.centers)
    around = (r > wall.inner) & (r < wall.outer) & (z > wall.tip)
    size, below = abs(mesh.areas), z < 0
    for surface in np.unique(surfaces[around & below]):
        here = surfaces == surface
        if 2 * size[here & below & around].sum() > size[here & below].sum():
            found |= here
    return found


def words_on(mesh: Mesh, kept: np.ndarray, names: dict[int, str]) -> str:
    """Return what is said of cells that are left out, and which groups are."""
    if kept.all():
        return ""
    assert mesh.groups is not None
    gone = np.setdiff1d(mesh.groups, mesh.groups[kept])
    groups = ", ".join(names.get(int(group), str(group)) for group in gone)
    whole = f", with all of group {groups}" if len(gone) else ""
    n = np.count_nonzero(~kept)
    return f"{n} cells of the mesh are the wall, and left out{whole}."


def trimmed(mesh: Mesh, kept: np.ndarray, remark: str) -> Mesh:
    """Return a mesh with the cells that are kept and their nodes only, and with all
    cells counterclockwise."""
    cells, area = mesh.cells[kept], mesh.areas[kept]
    turned = cells[:, [2, 1, 0, 3]]
    turned[cells[:, 2] == cells[:, 3]] = cells[cells[:, 2] == cells[:, 3]][
        :, [1, 0, 2, 2]
    ]
    cells = np.where(area[:, np.newaxis] < 0, turned, cells)
    used, number = np.unique(cells, return_inverse=True)
    groups = None if mesh.groups is None else mesh.groups[kept]
    return Mesh(mesh.nodes[used], number.reshape(cells.shape), {}, groups, remark)
