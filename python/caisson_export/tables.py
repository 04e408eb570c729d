# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exported states as tables and pictures: .csv of cells, points or zones, and .vtu."""
import csv
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from caisson_export.balance import Balanced
from caisson_export.interpolate import Values
from caisson_export.state import STRESS, State
from caisson_export.text import about, about_points

Columns = dict[str, np.ndarray]
ZONE_ROWS = 12  # of the soil above the tip; below it the zones are as high


def write_table(path: Path, lines: Iterable[str], columns: Columns) -> None:
    """Write columns with remarks before them."""
    with path.open("w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {line}\n" for line in lines)
        writer = csv.writer(file)
        writer.writerow(columns)
        for row in zip(*columns.values()):
            writer.writerow([f"{value:.9g}" for value in row])


def tensor(name: str, values: np.ndarray) -> Columns:
    """Return the components of stresses [n, 4] by name."""
    return {f"{name}_{c}_Pa": values[:, i] for i, c in enumerate(STRESS)}


def columns_of(
    state: State, values: Values, stress: np.ndarray, z: np.ndarray
) -> Columns:
    """Return stress, pore pressure, displacement and state variables at heights z."""
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


def of_cells(state: Balanced) -> Columns:
    """Return the values of the cells of a mesh."""
    result = columns_of(
        state.state, state.values, state.stress, state.mesh.centers[:, 1]
    )
    result |= {"unit_weight_N_m3": state.unit_weight, "volume_m3": state.volume}
    result |= tensor("correction", state.correction)
    result |= tensor("scatter", state.values.scatter)
    return result | {"correction_exceeds_scatter": state.exceeds.astype(int)}


def write_csv(path: Path, state: Balanced) -> None:
    """Write one row for each cell."""
    place = dict(zip(("r_m", "z_m"), state.mesh.centers.T))
    numbers = {"cell": np.arange(1, len(state.stress) + 1)}
    write_table(path, about(state), numbers | place | of_cells(state))


def write_points(path: Path, state: State, at: np.ndarray, values: Values) -> None:
    """Write the interpolated values at points [n, 2]."""
    columns = dict(zip(("r_m", "z_m"), at.T))
    columns |= columns_of(state, values, values.stress, at[:, 1])
    columns |= tensor("scatter", values.scatter)
    write_table(path, about_points(state), columns)


def write_vtu(path: Path, state: Balanced) -> None:
    """Write the mesh with the values of its cells."""
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
    from vtkmodules.vtkCommonDataModel import (
        VTK_QUAD,
        VTK_TRIANGLE,
        vtkUnstructuredGrid,
    )
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    grid, points = vtkUnstructuredGrid(), vtkPoints()
    nodes = np.column_stack([state.mesh.nodes, np.zeros(len(state.mesh.nodes))])
    points.SetData(numpy_to_vtk(nodes, deep=True))
    grid.SetPoints(points)
    for cell, is_triangle in zip(state.mesh.cells.tolist(), state.mesh.is_triangle):
        if is_triangle:
            grid.InsertNextCell(VTK_TRIANGLE, 3, cell[:3])
        else:
            grid.InsertNextCell(VTK_QUAD, 4, cell)
    for name, values in of_cells(state).items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        grid.GetCellData().AddArray(array)
    text = vtkStringArray()
    text.SetName("about")
    for line in about(state):
        text.InsertNextValue(line)
    grid.GetFieldData().AddArray(text)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    if not writer.Write():
        raise OSError(f"{path} cannot be written")


def zone_edges(state: Balanced) -> tuple[list[tuple[str, float, float]], np.ndarray]:
    """Return the rings of the zones, with names and radii, and their heights (m)."""
    r, z = state.mesh.nodes.T
    wall, outer, low, high = state.state.wall, r.max(), z.min(), max(z.max(), 0.0)
    if wall is None:
        return [("soil", 0.0, outer)], np.linspace(low, high, ZONE_ROWS + 1)
    tip, near = wall.tip, min(wall.outer * 1.5, outer)
    rings = [("outside_near", wall.outer, near), ("outside", near, outer)]
    if wall.inner > 0:
        rings = [("inside", 0.0, wall.inner), *rings]
    rows = np.linspace(tip, high, ZONE_ROWS + 1)
    n = max(1, round((tip - low) / (rows[1] - rows[0])))
    return rings, np.unique(np.concatenate([np.linspace(low, tip, n + 1), rows]))


def write_plaxis(path: Path, state: Balanced) -> None:
    """Write zones of soil, each with its weight, K0 and OCR, means by volume."""
    rings, rows = zone_edges(state)
    r, z = state.mesh.centers.T
    geostatic = state.state.at_rest(z)
    lines: list[dict[str, float | str]] = []
    for name, inner, outer in rings:
        for low, high in zip(rows[:-1], rows[1:]):
            cells = (r >= inner) & (r < outer) & (z >= low) & (z < high)
            if not cells.any():
                continue
            volume = state.volume[cells]
            mean = volume @ state.stress[cells] / volume.sum()
            before = max(float(volume @ geostatic[cells] / volume.sum()), -mean[1])
            void = state.values.fields.get("void_ratio")
            known = mean[1] < 0
            lines.append(
                {
                    "zone": name,
                    "r_min_m": inner,
                    "r_max_m": outer,
                    "z_top_m": high,
                    "z_bottom_m": low,
                    "unit_weight_kN_m3": volume
                    @ state.unit_weight[cells]
                    / 1e3
                    / volume.sum(),
                    "vertical_stress_kPa": -mean[1] / 1e3,
                    "K0_radial": mean[0] / mean[1] if known else np.nan,
                    "K0_hoop": mean[2] / mean[1] if known else np.nan,
                    "OCR": before / -mean[1] if known else np.nan,
                    "POP_kPa": (before + mean[1]) / 1e3,
                    "shear_stress_kPa": mean[3] / 1e3,
                    "pore_pressure_kPa": volume
                    @ state.values.pressure[cells]
                    / 1e3
                    / volume.sum(),
                    "void_ratio": np.nan
                    if void is None
                    else np.average(void[cells], weights=volume),
                }
            )
    with path.open("w", newline="", encoding="utf-8") as file:
        file.writelines(f"# {line}\n" for line in [*about(state), *PLAXIS])
        writer = csv.DictWriter(file, lines[0])
        writer.writeheader()
        for line in lines:
            numbers = {k: f"{v:.6g}" for k, v in line.items() if not isinstance(v, str)}
            writer.writerow({**line, **numbers})


PLAXIS = (
    "Zones for PLAXIS: clusters in axisymmetry with x = r, y = z, submerged unit"
    " weight, K0 and OCR for the K0 procedure. Pressures of this table are positive in"
    " compression, in kPa.",
    "OCR and POP compare the vertical stress with that of the ground at rest, the"
    " larger of both being the past one: a lower bound.",
    "K0 has no shear stress: PLAXIS needs a plastic step with no load (nil step) after"
    " the K0 procedure, and loses the friction on the wall there.",
)
