# SPDX-License-Identifier: LGPL-2.1-or-later
"""The points of a table at which values are asked for: numbers within the soil."""
from pathlib import Path

import numpy as np

from caisson.design import cone_grid
from caisson.design.cone_table import value_of
from caisson.results import ResultsError
from caisson import disk
from caisson.export.mesh import default_window, steps, surface_of
from caisson.export.state import TOLERANCE, State

COLUMNS = ("r_m", "z_m")


@disk.reads
def read_table(path: Path) -> tuple[np.ndarray, list[int]]:
    """Return the points [n, 2] (m) of a table, and the line of each. Its cells are as
    those of a cone test: any divider, and a decimal point or comma. Raises ResultsError
    where a row has no two numbers."""
    points, numbers = [], []
    lines = disk.read_text(path, ResultsError).splitlines()
    rows, _ = cone_grid.grid_of_text(lines)
    names = [name.strip() for name in rows[0][1]] if rows else []
    if not set(COLUMNS) <= set(names):
        raise ResultsError(f"{path} has no columns r_m and z_m")
    for n, cells in rows[1:]:
        try:
            point = [value_of(cells[names.index(name)]) for name in COLUMNS]
        except (ValueError, IndexError):
            point = [np.nan]
        if not np.isfinite(point).all():
            raise ResultsError(
                f"{path}, line {n}: {','.join(cells)!r} has no numbers r_m and z_m"
            )
        points.append(point)
        numbers.append(n)
    if not points:
        raise ResultsError(f"{path} has no point")
    return np.array(points), numbers


def surface_at(state: State, r: np.ndarray) -> np.ndarray:
    """Return the height of the ground at radii [n] (m)."""
    spacing, wall = default_window(state).spacing, state.wall
    sides = [(0.0, state.outer_radius)]
    if wall is not None:
        sides = [(0.0, wall.inner), (wall.outer, state.outer_radius)]
    result = np.full(len(r), np.inf)
    for low, high in sides:
        here = (r >= low) & (r <= high)
        if here.any() and high > low:
            edges = steps(low, high, spacing)
            result[here] = np.interp(r[here], edges, surface_of(state, edges, spacing))
    return result


def read_places(path: Path, state: State) -> np.ndarray:
    """Return the points [n, 2] (m) of a table. Raises ResultsError with the line of
    the first one that is not in the soil; half of the usual spacing above the ground
    counts as in it, since the surface is not known better."""
    points, numbers = read_table(path)
    r, z = points.T
    surface = surface_at(state, r)
    domain = "the domain of the run, which ends at"
    outside = {
        "beyond the axis: r is at least 0": r < 0,
        f"beyond {domain} r = {state.outer_radius:g} m": (
            r > state.outer_radius + TOLERANCE
        ),
        f"below {domain} z = {state.bottom:g} m": z < state.bottom - TOLERANCE,
        "in the wall": state.wall is not None and state.wall.contains(points),
        "above the ground, whose surface is at z = {:.3g} m there": (
            z > surface + default_window(state).spacing / 2
        ),
    }
    for words, are in outside.items():
        if np.any(are):
            i = int(np.argmax(are))
            raise ResultsError(
                f"{path}, line {numbers[i]}: the point r = {r[i]:g} m, z = {z[i]:g} m"
                f" lies {words.format(surface[i])}"
            )
    return points
