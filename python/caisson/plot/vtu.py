# SPDX-License-Identifier: LGPL-2.1-or-later
"""Material points and cells of .vtu and .pvtu files as arrays."""
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import (
    vtkXMLPUnstructuredGridReader,
    vtkXMLUnstructuredGridReader,
)

UNITS = ("Pa", "m_s", "m3", "m")  # of the arrays of a frame


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


def without_unit(name: str) -> str:
    """Return the name of a quantity, as observations have it, from that of its array:
    stress_zz from stress_zz_Pa. Files of earlier versions have names without units."""
    for unit in UNITS:
        if name.endswith(f"_{unit}"):
            return name.removesuffix(f"_{unit}")
    return name


def arrays_of(data: Any) -> dict[str, np.ndarray]:
    """Return the arrays of point or cell data by the names of their quantities."""
    return {
        without_unit(data.GetArrayName(i)): vtk_to_numpy(data.GetArray(i))
        for i in range(data.GetNumberOfArrays())
        if data.GetArray(i) is not None
    }


def read_points(files: Sequence[Path]) -> dict[str, np.ndarray]:
    """Return the fields of all material points, [n] or [n, components]; "position"
    [n, 2] (m) is among them. Raises OSError where there is no point."""
    parts = []
    for grid in map(read_grid, files):
        if grid.GetNumberOfPoints() > 0:
            parts.append(arrays_of(grid.GetPointData()))
            parts[-1]["position"] = vtk_to_numpy(grid.GetPoints().GetData())[
                :, :2
            ].astype(float)
    if not parts:
        raise OSError(f"no material points can be read from {files[0]}")
    names = set.intersection(*[set(part) for part in parts])
    return {name: np.concatenate([part[name] for part in parts]) for name in names}


def read_cells(files: Sequence[Path]) -> tuple[np.ndarray, np.ndarray]:
    """Return the cells of the background grid: corners [n_cells, 4, 2] in the order
    lower left, lower right, upper right, upper left, and material [n_cells],
    1 in the rigid body. deal.II gives every cell corners of its own and writes
    cell data there, as point data."""
    corners, material = [np.empty((0, 4, 2))], [np.empty(0)]
    for grid in map(read_grid, files):
        start = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
        quads = np.flatnonzero(np.diff(start) == 4)
        corner = vtk_to_numpy(grid.GetCells().GetConnectivityArray())[
            start[quads][:, np.newaxis] + np.arange(4)
        ]
        position = vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
        corners.append(sorted_corners(position[corner].astype(float)))
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
