# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exported states as files: .csv of cells or points, .vtu, and input of Abaqus and
CalculiX, of which deck.inp.jinja has the lines."""
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from caisson.table import write_csv
from caisson import disk
from caisson.export.exported import Exported
from caisson.export.interpolate import Values, interpolate
from caisson.export.state import POISSON, STRESS, State
from caisson.export.text import POINTS, TOTAL, about, about_state
from caisson.template import template
from caisson.units import GRAVITY

Columns = dict[str, np.ndarray]
# elements, and the points of the wedge or brick into which CalculiX expands them
TRIANGLE, QUADRILATERAL = ("CAX3", 3, 2), ("CAX4", 4, 8)


def write_table(path: Path, lines: Sequence[str], columns: Columns) -> None:
    """Write columns with remarks before them."""
    rows = [[f"{value:.9g}" for value in row] for row in zip(*columns.values())]
    write_csv(path, list(columns), rows, lines)


def tensor(name: str, values: np.ndarray) -> Columns:
    """Return the components of stresses [n, 4] by name."""
    return {f"{name}_{c}_Pa": values[:, i] for i, c in enumerate(STRESS)}


def columns_of(state: State, values: Values, z: np.ndarray) -> Columns:
    """Return stress, pore pressure, displacement and state variables at heights z."""
    stress = values.stress
    result = tensor("stress", stress)
    before = state.at_rest(z)
    result["vertical_effective_stress_kPa"] = -stress[:, 1] / 1e3
    result["vertical_stress_over_stress_at_rest"] = np.divide(
        -stress[:, 1], before, out=np.full(len(z), np.nan), where=before > 0
    )
    result["pore_pressure_Pa"] = values.pressure
    result["displacement_r_m"], result["displacement_z_m"] = values.displacement.T
    numbers = np.array([layer.number for layer in state.layers])
    return result | values.fields | {"layer": numbers[values.layer]}


def of_cells(state: Exported) -> Columns:
    """Return the values of the cells of a mesh."""
    result = columns_of(state.state, state.values, state.mesh.centers[:, 1])
    result |= {"unit_weight_N_m3": state.unit_weight, "volume_m3": state.mesh.volumes}
    return result | tensor("scatter", state.values.scatter)


def write_cells(path: Path, state: Exported) -> None:
    """Write one row for each cell."""
    place = dict(zip(("r_m", "z_m"), state.mesh.centers.T))
    numbers = {"cell": np.arange(1, len(state.values.stress) + 1)}
    write_table(path, about(state), numbers | place | of_cells(state))


def write_points(path: Path, state: State, at: np.ndarray) -> list[str]:
    """Write the interpolated values at points [n, 2]; return what is said of them."""
    values, said = interpolate(state, at), [*about_state(state), POINTS]
    columns = dict(zip(("r_m", "z_m"), at.T)) | columns_of(state, values, at[:, 1])
    write_table(path, said, columns | tensor("scatter", values.scatter))
    return said


def write_vtu(path: Path, state: Exported) -> None:
    """Write the mesh with the values of its cells; what it is stands in a comment."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import (
        VTK_QUAD,
        VTK_TRIANGLE,
        vtkUnstructuredGrid,
    )
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    grid, points, mesh = vtkUnstructuredGrid(), vtkPoints(), state.mesh
    points.SetData(numpy_to_vtk(np.pad(mesh.nodes, ((0, 0), (0, 1))), deep=True))
    grid.SetPoints(points)
    for cell, is_triangle in zip(mesh.cells.tolist(), mesh.is_triangle):
        kind, size = (VTK_TRIANGLE, 3) if is_triangle else (VTK_QUAD, 4)
        grid.InsertNextCell(kind, size, cell[:size])
    for name, values in of_cells(state).items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        grid.GetCellData().AddArray(array)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.WriteToOutputStringOn()
    writer.Write()
    head, body = writer.GetOutputString().split("\n", 1)
    # an array of strings would say it too, but only to VTK
    text = "\n".join(disk.remarks(" ", about(state))).replace("--", "- -")
    disk.write(path, f"{head}\n<!--\n{text}\n-->\n{body}")


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


def write_deck(path: Path, state: Exported, program: str) -> None:
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
