# SPDX-License-Identifier: LGPL-2.1-or-later
"""What mesh, points and inertia tolerance a caisson needs for an error that is wanted.

The far mesh follows the diameter, as in prm/jack.prm, and the mesh at the tip the
wall: its lines are as far apart as the wall is thick, and cells around the tip are
halved until the wanted number lies across the wall, as in prm/jack_thin.prm. The
error is of first order in both, so that half of it takes half of all cell sizes. What
it is was measured (doc/how_to/own_caisson.md).

SI units; depths are positive below the surface.
"""
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10


@dataclass(frozen=True)
class Level:
    """The numerics of an error of the total force, in percent.

    levels: how often cells at the tip are halved; far: size of the cells far away, as
    a multiple of those for 10 %.
    """

    error: int
    cells: int
    levels: int
    inertia_tolerance: float
    far: float
    growth: float


LEVELS = {
    level.error: level
    for level in (
        Level(20, cells=2, levels=1, inertia_tolerance=1.6, far=1, growth=1.2),
        Level(10, cells=4, levels=2, inertia_tolerance=0.8, far=1, growth=1.2),
        Level(5, cells=8, levels=3, inertia_tolerance=0.4, far=0.5, growth=1.1),
        Level(2, cells=16, levels=4, inertia_tolerance=0.2, far=0.25, growth=1.05),
    )
}


@dataclass(frozen=True)
class Body:
    """A caisson: outer diameter, length of the skirt and thickness of the wall (m)."""

    diameter: float
    skirt: float
    wall: float


@dataclass(frozen=True)
class Mesh:
    """Entries of section Grid, and the near distance of the points (m)."""

    outer_radius: float
    bottom: float
    top: float
    cell_width: float
    cell_height: float
    growth: float
    fine: float
    moving_zone: float
    levels: int
    refined_distance: float
    near_distance: float
    smallest_row: float


DEFAULT_ROW = 0.01  # m, the program's Grid/Smallest row height


def to_two_digits(value: float) -> float:
    """Return a size that reads well."""
    return float(f"{value:.2g}")


def step_of(size: float, most: float) -> float:
    """Return the step to which a length of a body of this size is rounded (m): the
    power of ten below it, at most the one given."""
    return float(min(most, 10.0 ** floor(log10(size) + 1e-9)))


def rounded(length: float, step: float) -> float:
    """Return a length as a multiple of a step."""
    return round(round(length / step) * step, 9)


def rounded_up(length: float, step: float) -> float:
    """Return the least multiple of a step that is no smaller than a length."""
    return rounded(ceil(length / step - 1e-9) * step, step)


def zone_of(
    body: Body, start: float, cell_height: float, tops: Sequence[float]
) -> float:
    """Return the height of the moving zone below the tip. Where it would end close to
    the top of a layer it ends there: the boundary of a layer is a line of the mesh, and
    a row between the two would be thin, which costs points and a short step."""
    d = body.diameter
    zone = to_two_digits(max(d / 4, min(1.0, d / 2)))
    for top in tops:
        if abs(top - start - zone) < cell_height / 2:
            return round(top - start, 6)
    return zone


def mesh_of(
    body: Body, start: float, end: float, level: Level, tops: Sequence[float]
) -> Mesh:
    """Return the mesh for a travel between two depths in layers with these tops."""
    d = body.diameter
    cell_height = to_two_digits(level.far * d / 15)
    step = step_of(d, 1.0)
    return Mesh(
        outer_radius=2.5 * d,
        bottom=-rounded_up(max(3 * d, end + 1.5 * d), step),
        top=rounded_up(body.skirt + step, step),
        cell_width=to_two_digits(level.far * d / 5),
        cell_height=cell_height,
        growth=level.growth,
        fine=5 * body.wall,
        moving_zone=zone_of(body, start, cell_height, tops),
        levels=level.levels,
        refined_distance=3 * body.wall,
        near_distance=to_two_digits(d / 10),
        smallest_row=to_two_digits(body.wall / 2),
    )


def start_of(skirt: float) -> float:
    """Return the depth at which the caisson is wished in place: 6 % of the skirt."""
    return rounded(0.06 * skirt, step_of(skirt, 1.0) / 20)


def frames_of(start: float, end: float) -> list[float]:
    """Return four depths of which pictures are made."""
    step = step_of(end, 1.0) / 10
    between = [rounded(end * share, step) for share in (1 / 3, 2 / 3)]
    return [start, *(depth for depth in between if start < depth < end), end]
