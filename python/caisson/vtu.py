# SPDX-License-Identifier: LGPL-2.1-or-later
"""Material points and cells of .vtu files as arrays."""
import os
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkFiltersCore import vtkAppendFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from caisson.results import ResultsError
from caisson import disk

BROKEN = "the frame is broken: {} {}. Take another frame, or run the scene again"
COUNTS = ("NumberOfPoints", "NumberOfCells", "NumberOfTuples")
MOST_COMPONENTS = 9  # of a tensor
MOST_PER_BYTE = 2000  # what a compressed byte can stand for


def check(file: Path) -> None:
    """Raise ResultsError unless a .vtu file is whole and its counts are possible: VTK
    would try to allocate them."""
    data = disk.read_bytes(file, ResultsError)
    try:
        tags = list(ElementTree.fromstring(data).iter())
        components = [int(tag.get("NumberOfComponents", 1)) for tag in tags]
        counts = [int(tag.get(name, 0)) for tag in tags for name in COUNTS]
    except (ElementTree.ParseError, LookupError, ValueError) as error:
        raise ResultsError(BROKEN.format(file, f"is not complete ({error})")) from error
    for found, most in (components, MOST_COMPONENTS), (
        counts,
        MOST_PER_BYTE * len(data),
    ):
        if not 0 <= min(found, default=0) <= max(found, default=0) <= most:
            raise ResultsError(
                BROKEN.format(file, f"says that it has {max(found)} values")
            )


@disk.reads
def read_grid(file: Path) -> Any:
    """Return the vtkUnstructuredGrid of a .vtu file. Raises ResultsError."""
    check(file)
    said, usual = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(said)
    try:
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(os.fsencode(file))
        reader.Update()
        grid = reader.GetOutput()
    finally:
        vtkOutputWindow.SetInstance(usual)
    if "ERROR" in said.GetOutput():
        raise ResultsError(BROKEN.format(file, "has arrays that cannot be read"))
    return grid


def joined(grids: Sequence[Any]) -> Any:
    """Return one vtkUnstructuredGrid of those of a frame."""
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


def positions_of(grid: Any) -> np.ndarray:
    """Return r and z of the points of a grid (m): [n, 2]."""
    return vtk_to_numpy(grid.GetPoints().GetData())[:, :2].astype(float)


def corners_of(grid: Any) -> np.ndarray:
    """Return the corners of the cells of a grid of quadrilaterals: [n, 4, 2] in the
    order lower left, lower right, upper right, upper left."""
    corner = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    corners = positions_of(grid)[corner]
    order = np.lexsort((corners[..., 1], corners[..., 0]))
    return np.take_along_axis(corners, order[:, [0, 2, 3, 1], np.newaxis], 1)
