# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the .pvd series of a run into numpy arrays."""
import xml.etree.ElementTree as ElementTree

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import (vtkXMLPUnstructuredGridReader,
                                 vtkXMLUnstructuredGridReader)


def read_series(path):
    """[(time in s, [files])] of a .pvd file, in order; files that are gone,
    as of a run that was stopped, are left out."""
    if not path.is_file():
        return []
    frames = {}
    for entry in ElementTree.parse(path).iter("DataSet"):
        file = path.parent / entry.get("file")
        if file.is_file():
            frames.setdefault(float(entry.get("timestep", 0)), []).append(file)
    return sorted(frames.items())


def read_grid(file):
    """The vtkUnstructuredGrid of a .vtu or .pvtu file."""
    reader = (vtkXMLPUnstructuredGridReader() if file.suffix == ".pvtu"
              else vtkXMLUnstructuredGridReader())
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def arrays_of(data):
    """The arrays of point or cell data by name."""
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
            for i in range(data.GetNumberOfArrays())
            if data.GetArray(i) is not None}


def read_points(files):
    """The fields of all material points; "position" [n, 2] is among them."""
    parts = []
    for grid in map(read_grid, files):
        if grid.GetNumberOfPoints() > 0:
            parts.append(arrays_of(grid.GetPointData()))
            parts[-1]["position"] = vtk_to_numpy(
                grid.GetPoints().GetData())[:, :2].astype(float)
    if not parts:
        raise OSError(f"no material points can be read from {files[0]}")
    names = set.intersection(*[set(part) for part in parts])
    return {name: np.concatenate([part[name] for part in parts])
            for name in names}


def read_rigid_cells(files):
    """The corners [n_cells, 4, 2] of the cells with material_id 1."""
    found = [np.empty((0, 4, 2))]
    for grid in map(read_grid, files):
        material = arrays_of(grid.GetCellData()).get("material_id")
        if material is None or not np.any(material == 1):
            continue
        position = vtk_to_numpy(grid.GetPoints().GetData())[:, :2]
        start = vtk_to_numpy(grid.GetCells().GetOffsetsArray())
        corner = vtk_to_numpy(grid.GetCells().GetConnectivityArray())
        for cell in np.flatnonzero(material == 1):
            if start[cell + 1] - start[cell] == 4:
                corners = corner[start[cell]:start[cell + 1]]
                found.append(position[corners][np.newaxis])
    return np.concatenate(found)
