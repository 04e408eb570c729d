# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exported states as tables and pictures: .csv of cells, points or zones, and .vtu."""
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from caisson.table import write_csv
from caisson import disk
from caisson.export.exported import Exported
from caisson.export.interpolate import Values
from caisson.export.state import STRESS, State
from caisson.export.text import POINTS, about, about_state

Columns = dict[str, np.ndarray]
# of the soil above the tip; below it the zones are as high; none is lower than a cell
ZONE_ROWS = 12


def write_table(path: Path, lines: Sequence[str], columns: Columns) -> None:
    """Write columns with remarks before them."""
    rows = [[f"{value:.9g}" for value in row] for row in zip(*columns.values())]
    write_csv(path, list(columns), rows, lines)


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


def of_cells(state: Exported) -> Columns:
    """Return the values of the cells of a mesh."""
    result = columns_of(
        state.state, state.values, state.values.stress, state.mesh.centers[:, 1]
    )
    result |= {"unit_weight_N_m3": state.unit_weight, "volume_m3": state.mesh.volumes}
    return result | tensor("scatter", state.values.scatter)


def write_cells(path: Path, state: Exported) -> None:
    """Write one row for each cell."""
    place = dict(zip(("r_m", "z_m"), state.mesh.centers.T))
    numbers = {"cell": np.arange(1, len(state.values.stress) + 1)}
    write_table(path, about(state), numbers | place | of_cells(state))


def write_points(path: Path, state: State, at: np.ndarray, values: Values) -> None:
    """Write the interpolated values at points [n, 2]."""
    columns = dict(zip(("r_m", "z_m"), at.T))
    columns |= columns_of(state, values, values.stress, at[:, 1])
    columns |= tensor("scatter", values.scatter)
    write_table(path, [*about_state(state), POINTS], columns)


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
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.WriteToOutputStringOn()
    writer.Write()
    head, body = writer.GetOutputString().split("\n", 1)
    # an array of strings would say it too, but only to VTK
    text = "\n".join(disk.remarks(" ", about(state))).replace("--", "- -")
    disk.write(path, f"{head}\n<!--\n{text}\n-->\n{body}")


@dataclass
class Zone:
    """A ring of soil: its name, its radii and heights (m), and its cells [n]."""

    name: str
    inner: float
    outer: float
    low: float
    high: float
    cells: np.ndarray


def rings_of(state: Exported) -> list[tuple[str, float, float, float]]:
    """Return the rings of the zones: name, radii, and height of the upper end (m),
    which is the mean of the surface of the ground, or the tip below it."""
    r, z = state.mesh.nodes.T
    wall, far = state.state.wall, float(r.max())
    if wall is None:
        rings = [("soil", 0.0, far)]
    else:
        near = min(wall.outer * 1.5, far)
        rings = [("outside_near", wall.outer, near), ("outside", near, far)]
        if wall.inner > 0:
            rings = [("inside", 0.0, wall.inner), *rings]
    found = []
    for name, inner, outer in rings:
        on_top = state.mesh.sets["SURFACE"]
        if wall is not None:  # not that of the other side of the wall
            on_top = on_top[(r[on_top] > wall.middle) == (inner > 0)]
        # the window may end at a ring, and the mesh of a file have no plug
        if outer > inner and len(on_top):
            on_top = on_top[np.argsort(r[on_top])]
            at = np.linspace(inner, outer, 101)
            top = np.interp(at, r[on_top], z[on_top]).mean()
            found.append((name, inner, outer, float(top)))
    if wall is not None:
        found.append(("below_tip", wall.inner, wall.outer, wall.tip))
    return found


def steps_of(low: float, high: float, height: float) -> np.ndarray:
    """Return equal steps of about a height from low to high, with both (m)."""
    return np.linspace(low, high, max(1, round((high - low) / height)) + 1)


def rows_of_ring(edges: np.ndarray, z: np.ndarray, tip: float) -> np.ndarray:
    """Return the heights among the edges [n] that divide a ring into rows with centers
    z of cells: where a row has none, those beside it meet in the middle or at the
    tip."""
    filled = np.flatnonzero(np.histogram(z, edges)[0])
    rows = [edges[0]]
    for below, above in zip(filled[:-1], filled[1:]):
        between = edges[below + 1 : above + 1]
        at_tip = between[between == tip]
        rows.append(at_tip[0] if len(at_tip) else between[len(between) // 2])
    return np.array([*rows, edges[-1]])


def zones_of(state: Exported) -> list[Zone]:
    """Return zones that cover the ground without a gap, but for the soil beside the
    slope of a tip, whose cells count in the zone below it."""
    mesh, wall = state.mesh, state.state.wall
    (r, z), low = mesh.centers.T, float(mesh.nodes[:, 1].min())
    tip = low if wall is None else wall.tip
    cells = np.ptp(mesh.nodes[mesh.cells, 1], axis=1)
    height = max((mesh.nodes[:, 1].max() - tip) / ZONE_ROWS, float(np.median(cells)))
    zones = []
    for name, inner, outer, top in rings_of(state):
        ring = (r >= inner) & (r < outer)
        if not ring.any():  # of a mesh whose cells are wider than the wall
            radii = mesh.nodes[mesh.cells, 0]
            ring = (radii.min(axis=1) < outer) & (radii.max(axis=1) > inner)
            ring &= z < top
        below, above = steps_of(low, tip, height), steps_of(tip, top, height)
        at = np.clip(z, low, np.nextafter(top, low))
        rows = rows_of_ring(np.unique([*below, *above]), at[ring], tip)
        for begin, end in zip(rows[:-1], rows[1:]):
            row = ring & (at >= begin) & (at < end)
            zones.append(Zone(name, inner, outer, begin, end, row))
    return zones


def line_of(state: Exported, zone: Zone) -> dict[str, float | str]:
    """Return the row of a zone: means by volume over its cells. The past vertical
    stress is that of yielding, where it is known, or else that of the ground at rest,
    and at least the present one."""
    cells, fields = zone.cells, state.values.fields
    volume = state.mesh.volumes[cells]

    def mean(values: np.ndarray) -> float:
        """Return the mean of the cells whose value is known."""
        known = np.isfinite(values[cells])
        if not known.any():
            return np.nan
        return float(np.average(values[cells][known], weights=volume[known]))

    unknown = np.full(len(state.values.stress), np.nan)
    yielding = fields.get("vertical_yield_stress_Pa", unknown)
    at_rest = state.state.at_rest(state.mesh.centers[:, 1])
    past = np.where(np.isfinite(yielding), yielding, at_rest)
    rr, zz, tt, rz = map(mean, state.values.stress.T)
    before, known = max(mean(past), -zz), zz < 0
    return {
        "zone": zone.name,
        "r_min_m": zone.inner,
        "r_max_m": zone.outer,
        "z_top_m": zone.high,
        "z_bottom_m": zone.low,
        "unit_weight_kN_m3": mean(state.unit_weight) / 1e3,
        "vertical_stress_kPa": -zz / 1e3,
        "K0_radial": rr / zz if known else np.nan,
        "K0_hoop": tt / zz if known else np.nan,
        "OCR": before / -zz if known else np.nan,
        "POP_kPa": (before + zz) / 1e3,
        "shear_stress_kPa": rz / 1e3,
        "pore_pressure_kPa": mean(state.values.pressure) / 1e3,
        "void_ratio": mean(fields.get("void_ratio", unknown)),
        "yield_stress_kPa": mean(fields.get("yield_stress_Pa", unknown)) / 1e3,
    }


def write_plaxis(path: Path, state: Exported) -> None:
    """Write zones of soil, each with its weight, K0 and OCR."""
    zones = [line_of(state, zone) for zone in zones_of(state)]
    rows = [
        [value if isinstance(value, str) else f"{value:.8g}" for value in zone.values()]
        for zone in zones
    ]
    write_csv(path, list(zones[0]), rows, [*about(state), *PLAXIS])


PLAXIS = (
    "Zones for PLAXIS: clusters in axisymmetry with x = r, y = z, submerged unit"
    " weight, K0 and OCR for the K0 procedure. Pressures of this table are positive in"
    " compression, in kPa.",
    "OCR and POP compare the vertical stress with a past one. In modified Cam clay this"
    " is the vertical stress that has p_c in normal consolidation, with K0 ="
    " 1 - sin(phi_c). With other laws it is the larger one of the ground at rest and"
    " now: OCR and POP are lower bounds. yield_stress_kPa is p_c, or p_i of NorSand.",
    "K0 has no shear stress: PLAXIS needs a plastic step with no load (nil step) after"
    " the K0 procedure, and loses the friction on the wall there.",
)
