# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exported states as input of Abaqus and CalculiX. The template has the lines of a
file, and what differs between the programs; here are its data."""
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from caisson import disk
from caisson.export.exported import Exported
from caisson.export.state import POISSON
from caisson.units import GRAVITY
from caisson.export.text import TOTAL, about
from caisson.template import template

# elements, and the points of the wedge or brick into which CalculiX expands them
TRIANGLE, QUADRILATERAL = ("CAX3", 3, 2), ("CAX4", 4, 8)


def sets_of(state: Exported) -> Iterator[tuple[str, str, np.ndarray]]:
    """Yield the kind, the name and the numbers of sets of elements and nodes."""
    for i, layer in enumerate(state.state.layers):
        yield "ELSET", f"LAYER_{layer.number}", np.flatnonzero(state.values.layer == i)
    groups = state.mesh.groups
    for group in [] if groups is None else np.unique(groups):
        yield "ELSET", f"GROUP_{group}", np.flatnonzero(groups == group)
    for name, nodes in state.mesh.sets.items():
        yield "NSET", name, nodes


def elements_of(state: Exported) -> Iterator[tuple[str, list[tuple[int, list[int]]]]]:
    """Yield each kind of elements that the mesh has, with their numbers and corners."""
    mesh = state.mesh
    for (kind, size, _), of_kind in (
        (QUADRILATERAL, ~mesh.is_triangle),
        (TRIANGLE, mesh.is_triangle),
    ):
        corners = (mesh.cells[of_kind, :size] + 1).tolist()
        if corners:
            yield kind, list(zip(np.flatnonzero(of_kind) + 1, corners))


def stresses_of(state: Exported) -> Iterator[tuple[str, int]]:
    """Yield the stress of each element, and its number of points in CalculiX."""
    for stress, is_triangle in zip(state.values.total, state.mesh.is_triangle):
        *_, points = TRIANGLE if is_triangle else QUADRILATERAL
        yield ", ".join(f"{value:.9g}" for value in stress), points


def held_sets(state: Exported) -> list[tuple[str, int]]:
    """Return the sets of nodes, and the component that all of them hold."""
    return [
        (name, component + 1)
        for name, nodes in state.mesh.sets.items()
        for component in (0, 1)
        if name != "SURFACE" and state.held[nodes, component].all()
    ]


def write(path: Path, state: Exported, program: str) -> None:
    """Write the input of a program, "abaqus" or "calculix"."""
    layers = state.state.layers
    loads = state.applied * ~state.held
    text = template(Path(__file__).with_name("deck.inp.jinja")).render(
        program=program,
        about=map(disk.one_line, [*about(state), TOTAL]),
        nodes=state.mesh.nodes,
        elements=elements_of(state),
        sets=[(kind, name, n + 1) for kind, name, n in sets_of(state)],
        layers=[layers[i] for i in np.unique(state.values.layer)],
        stresses=stresses_of(state),
        held_sets=held_sets(state),
        loads=[(n + 1, c + 1, loads[n, c]) for n, c in zip(*np.nonzero(loads))],
        poisson=POISSON,
        gravity=GRAVITY,
    )
    disk.write(path, text)
