# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exported states as input of finite element programs: Abaqus, CalculiX, OpenSees.

The lines of a file are in its template; here are its data, and what differs between
programs.
"""
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from caisson import disk
from caisson.export.exported import Exported
from caisson.units import GRAVITY
from caisson.export.text import TOTAL, about
from caisson.template import template

POISSON = 0.3  # of the elastic soil in the files, which stands for the user's
HALF_ANGLE = np.radians(1)  # of the sector of bricks for OpenSees
NEAR_AXIS = 1e-3  # of the shortest radius: nodes of bricks do not lie on the axis
# program: its template, and what it has in the place of others
PROGRAMS: dict[str, tuple[str, dict[str, Any]]] = {
    "abaqus": (
        "deck.inp.jinja",
        {
            "stress": "S11 = rr, S22 = zz, S33 = tt, S12 = rz",
            "step": ("*STEP, NAME=GEOSTATIC, NLGEOM=NO", "*GEOSTATIC"),
            "output": ("*OUTPUT, FIELD, VARIABLE=PRESELECT",),
        },
    ),
    "calculix": (
        "deck.inp.jinja",
        {
            "stress": "point, rr, zz, tt, rz, 0, 0",
            "step": ("*STEP", "*STATIC"),
            "output": ("*NODE PRINT, NSET=ALL_NODES", "U, RF")
            + ("*EL PRINT, ELSET=SOIL", "S"),
            # of the brick or wedge into which it expands an element
            "points": {"CAX4": 8, "CAX3": 2},
        },
    ),
    "opensees": ("opensees.py.jinja", {}),
}


def texts(values: np.ndarray) -> list[str]:
    """Return stresses as text."""
    return [f"{value:.9g}" for value in values]


def sets_of(state: Exported) -> Iterator[tuple[str, str, np.ndarray]]:
    """Yield the kind, the name and the numbers of sets of elements and nodes."""
    for i, layer in enumerate(state.state.layers):
        yield "ELSET", f"LAYER_{layer.number}", np.flatnonzero(state.values.layer == i)
    groups = state.mesh.groups
    for group in [] if groups is None else np.unique(groups):
        yield "ELSET", f"GROUP_{group}", np.flatnonzero(groups == group)
    for name, nodes in state.mesh.sets.items():
        yield "NSET", name, nodes


def stresses_of(state: Exported, points: dict[str, int]) -> Iterator[tuple[str, list]]:
    """Yield the place and the stress of each element, or of all its points."""
    for cell, stress in enumerate(state.total):
        if not points:
            yield f"{cell + 1}", texts(stress)
        kind = "CAX3" if state.mesh.is_triangle[cell] else "CAX4"
        for point in range(points.get(kind, 0)):
            yield f"{cell + 1}, {point + 1}", [*texts(stress), "0", "0"]


def kinds_of(state: Exported) -> dict[str, list[tuple[int, list[int]]]]:
    """Return number and corners of the elements of each kind."""
    mesh, found = state.mesh, {}
    for kind, size, of_kind in (
        ("CAX4", 4, ~mesh.is_triangle),
        ("CAX3", 3, mesh.is_triangle),
    ):
        pairs = zip(np.flatnonzero(of_kind) + 1, mesh.cells[of_kind, :size] + 1)
        found[kind] = [(number, cell.tolist()) for number, cell in pairs]
    return {kind: cells for kind, cells in found.items() if cells}


def held_sets(state: Exported) -> list[tuple[str, int]]:
    """Return the sets of nodes, and the component that all of them hold."""
    return [
        (name, component + 1)
        for name, nodes in state.mesh.sets.items()
        for component in (0, 1)
        if name != "SURFACE" and state.held[nodes, component].all()
    ]


def write(path: Path, state: Exported, program: str) -> None:
    """Write the input of a program."""
    name, words = PROGRAMS[program]
    layers = state.state.layers
    loads = state.applied * ~state.held
    r = state.mesh.nodes[:, 0]
    text = template(Path(__file__).with_name(name)).render(
        about=map(disk.one_line, [*about(state), TOTAL]),
        words=words,
        mesh=state.mesh,
        kinds=kinds_of(state),
        sets=[(kind, name, n + 1) for kind, name, n in sets_of(state)],
        layers=[layers[i] for i in np.unique(state.values.layer)],
        stresses=stresses_of(state, words.get("points", {})),
        elements=zip(
            state.mesh.cells + 1,
            [layers[i] for i in state.values.layer],
            map(texts, state.total),
        ),
        held_sets=held_sets(state),
        held=[(n + 1, *map(int, h)) for n, h in enumerate(state.held) if h.any()],
        loads=[(n + 1, c + 1, loads[n, c]) for n, c in zip(*np.nonzero(loads))],
        poisson=POISSON,
        gravity=GRAVITY,
        half_angle=HALF_ANGLE,
        least=NEAR_AXIS * r[r > 1e-9].min(),
    )
    disk.write(path, text)
