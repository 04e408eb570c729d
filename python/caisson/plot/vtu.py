# SPDX-License-Identifier: LGPL-2.1-or-later
"""Material points and cells of .vtu and .pvtu files as arrays."""
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkIOXML import (
    vtkXMLPUnstructuredGridReader,
    vtkXMLUnstructuredGridReader,
)

from caisson.units import split


def read_grid(file: Path) -> Any:
    """Return the vtkUnstructuredGrid of a .vtu or .pvtu file."""
    reader = (
        vtkXMLPUnstructuredGridReader()
        if file.suffix == ".pvtu"
        else vtkXMLUnstructuredGridReader()
    )
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def joined(grids: Sequence[Any]) -> Any:
    """Return one vtkUnstructuredGrid of those of a frame, of which old runs have
    written one for each rank."""
    if len(grids) == 1:
        return grids[0]
    append = vtkAppendFilter()
    for grid in grids:
        append.AddInputData(grid)
    append.Update()
    return append.GetOutput()


def named_arrays(data: Any) -> dict[str, np.ndarray]:
    """Return the arrays of point or cell data by name, as they are there."""
    return {
        data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
        for i in range(data.GetNumberOfArrays())
        if data.GetArray(i) is not None
    }


def arrays_of(data: Any) -> dict[str, np.ndarray]:
    """Return the arrays of point or cell data by the names of their quantities, as
    observations have them: stress_zz for stress_zz_Pa."""
    return {split(name)[0]: values for name, values in named_arrays(data).items()}


def positions_of(grid: Any) -> np.ndarray:
    """Return r and z of the points of a grid (m): [n, 2]."""
    return vtk_to_numpy(grid.GetPoints().GetData())[:, :2].astype(float)


def quads_of(grid: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return the numbers of the quadrilaterals among the cells of a grid, [n], and of
    the points at their corners, [n, 4]."""
    start = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
    quads = np.flatnonzero(np.diff(start) == 4)
    corner = vtk_to_numpy(grid.GetCells().GetConnectivityArray())[
        start[quads][:, np.newaxis] + np.arange(4)
    ]
    return quads, corner


def corners_of(grid: Any) -> np.ndarray:
    """Return the corners of the quadrilaterals of a grid: [n, 4, 2] in the order
    lower left, lower right, upper right, upper left."""
    return sorted_corners(positions_of(grid)[quads_of(grid)[1]])


def with_cell_data(grid: Any) -> Any:
    """Return a grid of quadrilaterals whose point data have become its cell data.

    deal.II gives every cell corners of its own and writes cell data there, as point
    data: the value of a cell is that of its first corner.
    """
    corner = quads_of(grid)[1]
    for name, values in named_arrays(grid.GetPointData()).items():
        array = numpy_to_vtk(values[corner[:, 0]], deep=True)
        array.SetName(name)
        grid.GetCellData().AddArray(array)
    grid.GetPointData().Initialize()
    return grid


def read_points(files: Sequence[Path]) -> dict[str, np.ndarray]:
    """Return the fields of all material points, [n] or [n, components]; "position"
    [n, 2] (m) is among them. Raises OSError where there is no point."""
    parts = []
    for grid in map(read_grid, files):
        if grid.GetNumberOfPoints() > 0:
            parts.append(arrays_of(grid.GetPointData()))
            parts[-1]["position"] = positions_of(grid)
    if not parts:
        raise OSError(f"no material points can be read from {files[0]}")
    names = set.intersection(*[set(part) for part in parts])
    return {name: np.concatenate([part[name] for part in parts]) for name in names}


def read_cells(files: Sequence[Path]) -> tuple[np.ndarray, np.ndarray]:
    """Return the cells of the background grid: corners [n_cells, 4, 2] as of
    corners_of, and material [n_cells], 1 in the rigid body."""
    corners, material = [np.empty((0, 4, 2))], [np.empty(0)]
    for grid in map(read_grid, files):
        quads, corner = quads_of(grid)
        corners.append(corners_of(grid))
        values = arrays_of(grid.GetCellData()).get("material_id")
        at_corners = arrays_of(grid.GetPointData()).get("material_id")
        if values is not None:
            material.append(values[quads])
        elif at_corners is not None:
            material.append(at_corners[corner[:, 0]])
        else:
            material.append(np.zeros(len(quads)))
    return np.concatenate(corners), np.concatenate(material)


def sorted_corners(corners: np.ndarray) -> np.ndarray:
    """Return the corners of cells with vertical sides in the order of read_cells."""
    order = np.lexsort((corners[..., 1], corners[..., 0]))
    return np.take_along_axis(corners, order[:, [0, 2, 3, 1], np.newaxis], 1)
