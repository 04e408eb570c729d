# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cells, the material points and the body of a run at one time, as meshes of VTK
and as arrays of numpy."""
import functools
import importlib
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from caisson import needed
from caisson.curves import depth_at
from caisson.results import Read, Results, ResultsError
from caisson.units import unit_of

Arrays = dict[str, np.ndarray]


def reader() -> ModuleType:
    """Return what reads the files of frames. VTK, which takes a while, is loaded here.
    Raises ModuleNotFoundError, which names the command that installs it."""
    try:
        return importlib.import_module("caisson.vtu")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(needed.complaint() or str(error)) from error


class Frame:
    """The state of a run at one time that it has written.

    A file is read when one of its values is asked for, and once. Coordinates are
    r, z and 0 (m), z upward from the surface of the ground at the start. Stresses are
    positive in tension. They are effective, but total less the hydrostatic pressure in
    layers with "total_stress" in run.json, which are undrained clay. Pore pressures are
    excess and positive in compression, 0 in these layers, and missing where none is
    computed. Names of fields carry their units: "stress_zz_Pa".

    time: of the scene (s); penetration: of the body at that time (m), as history.csv
    has it; index: the number of the frame, from 0 on.

    The meshes need VTK (python3-vtk9): without it they raise ModuleNotFoundError.
    ResultsError is raised where a file is gone, or has no field of a name.

        frame = caisson.load("results/jack").frame(penetration=2.5)
        frame.cell_data["stress_Pa"]        # [n_cells, 6]
        frame.units["stress_Pa"]            # "Pa"
        pyvista.wrap(frame.mesh).plot(scalars="vertical_effective_stress_kPa")
    """

    def __init__(
        self,
        directory: Path,
        index: int,
        time: float,
        penetration: float,
        files: dict[str, list[Path]],
    ) -> None:
        """files: of each of the series "grid", "points" and "body" that the run has
        written at this time."""
        self.directory, self.index = directory, index
        self.time, self.penetration = time, penetration
        self.files = files

    def __repr__(self) -> str:
        """Say which frame it is."""
        where = f"time {self.time:.6g} s, penetration {self.penetration:.4g} m"
        return f"<frame {self.index} of {self.directory}: {where}>"

    def _read(self, series: str) -> Any:
        """Return the vtkUnstructuredGrid of a series. Raises ResultsError."""
        if series not in self.files:
            raise ResultsError(
                f"{self.directory} has no {series}_*.vtu at {self.time:.6g} s"
            )
        vtu = reader()
        return vtu.joined([vtu.read_grid(file) for file in self.files[series]])

    @functools.cached_property
    def mesh(self) -> Any:
        """The cells of the background grid: a vtkUnstructuredGrid of n_cells
        quadrilaterals, as pyvista.wrap() takes it.

        Its cell data are means over the material points of each cell, nan in a cell
        without any. "material_id" is 1 in the body, "material_points" their number in
        the cell. Raises ResultsError where the file is gone.
        """
        return self._read("grid")

    @functools.cached_property
    def points(self) -> Any:
        """The material points: a vtkUnstructuredGrid of n_points vertices with point
        data. Raises ResultsError where the file is gone."""
        return self._read("points")

    @functools.cached_property
    def body(self) -> Any:
        """The section of the body: a vtkUnstructuredGrid of polygons; None in a run
        without a body."""
        return self._read("body") if "body" in self.files else None

    @functools.cached_property
    def cell_data(self) -> Read:
        """The fields of the cells by name: [n_cells], and [n_cells, 6] of stress, as in
        point_data; nan in a cell without points. The arrays are those of mesh, so that
        what is written to one is in the other."""
        found = reader().named_arrays(self.mesh.GetCellData())
        return Read(self.files["grid"][0], found)

    @functools.cached_property
    def point_data(self) -> Read:
        """The fields of the material points by name: [n_points], [n_points, 3] of
        vectors, r, z and 0, and [n_points, 6] of stress, whose components are rr, zz,
        tt, rz, 0 and 0. The arrays are those of points."""
        found = reader().named_arrays(self.points.GetPointData())
        return Read(self.files["points"][0], found)

    @functools.cached_property
    def corners(self) -> np.ndarray:
        """The corners of the cells: [n_cells, 4, 2], r and z (m), in the order lower
        left, lower right, upper right, upper left."""
        return reader().corners_of(self.mesh)

    @functools.cached_property
    def positions(self) -> np.ndarray:
        """The material points: [n_points, 2], r and z (m)."""
        return reader().positions_of(self.points)

    @property
    def units(self) -> dict[str, str]:
        """The units of the fields of cells and points by name, "1" of numbers."""
        return {name: unit_of(name) for name in [*self.cell_data, *self.point_data]}


def frames_of(run: Results) -> list[Frame]:
    """Return all frames of a run in their order."""
    series = {name: dict(run.frames(name)) for name in ("grid", "points", "body")}
    times = sorted({time for files in series.values() for time in files})
    found = []
    for index, time in enumerate(times):
        files = {name: at[time] for name, at in series.items() if time in at}
        is_moved = "penetration_m" in run.history
        depth = depth_at(time, run.history) if is_moved else np.nan
        found.append(Frame(run.directory, index, time, depth, files))
    return found


def choose(
    frames: Sequence[Frame], quantity: str, value: float, tolerance: float
) -> Frame:
    """Return the frame whose "penetration" (m) or "time" (s) is nearest to a value, the
    first of several. Raises ResultsError, which names the nearest ones, where none is
    as near as the tolerance."""
    unit = {"penetration": "m", "time": "s"}[quantity]
    where = frames[0].directory
    known = [f for f in frames if np.isfinite(getattr(f, quantity))]
    if not known:
        raise ResultsError(f"{where} has no {quantity}: its history.csv lacks it")
    by_distance = sorted(known, key=lambda f: abs(getattr(f, quantity) - value))
    if abs(getattr(by_distance[0], quantity) - value) <= tolerance:
        return by_distance[0]
    nearest = " and ".join(
        f"{getattr(f, quantity):.6g} {unit} (index {f.index})"
        for f in sorted(by_distance[:2], key=lambda f: f.index)
    )
    raise ResultsError(
        f"{where} has no frame at a {quantity} of {value:g} {unit}: the nearest of its"
        f" {len(frames)} frames are at {nearest}. The entries Output/Frame penetrations"
        " and Output/Frame interval of the scene decide where a run writes frames"
    )
