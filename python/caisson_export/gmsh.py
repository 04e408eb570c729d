# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of Gmsh: text files of triangles and quadrilaterals with r = x and z = y."""
from pathlib import Path

import numpy as np

from caisson.results import ResultsError
from caisson_export.mesh import Mesh, with_sets
from caisson_export.state import Wall

CORNERS = {2: 3, 3: 4}  # types of elements of Gmsh: triangles and quadrilaterals


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
