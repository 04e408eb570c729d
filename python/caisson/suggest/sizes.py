# SPDX-License-Identifier: LGPL-2.1-or-later
"""What mesh, points and inertia tolerance a caisson needs for an error that is wanted.

The far mesh follows the diameter, as in prm/jack.prm, and the mesh at the tip the
wall: its lines are as far apart as the wall is thick, and cells around the tip are
halved until the wanted number lies across the wall, as in prm/jack_thin.prm. The
error is of first order in both, so that half of it takes half of all cell sizes. What
it is was measured (doc/how_to/own_caisson.md).

Below the zone that moves with the tip the rows are compressed by the travel T, all by
the same share 1 - T/A of a zone A deep. Its points, for so many in each compressed
row, are in proportion to A^2/(A - T), which is least for A = 2 T and 1/8 more for
1.5 T. The mesh is at least so deep: a row is never compressed to less than a third.

SI units; depths are positive below the surface.
"""
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, floor, log10, pi

from caisson.suggest.entry import SuggestError


@dataclass(frozen=True)
class Level:
    """The numerics of an error of the total force, in percent.

    levels: how often cells at the tip are halved; inertia_tolerance: of the others.
    """

    error: int
    cells: int
    levels: int
    inertia_tolerance: float


LEVELS = {
    level.error: level
    for level in (
        Level(20, cells=2, levels=1, inertia_tolerance=0.8),
        Level(10, cells=4, levels=2, inertia_tolerance=1.6),
        Level(5, cells=4, levels=2, inertia_tolerance=0.4),
        Level(2, cells=8, levels=3, inertia_tolerance=0.2),
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
    fine: float
    moving_zone: float
    levels: int
    near_distance: float
    smallest_row: float


DEFAULT_ROW = 0.01  # m, the program's Grid/Smallest row height
DEPTH_OF_TRAVEL = 1.5  # least height of the compressing zone, as a multiple of T
FINE_WALLS = 5  # rows so far from the tip are as high as the wall is thick
REACH_WALLS = 10  # beyond the fine rows, within which rows grow slowly
GROWTH, FAR_GROWTH = 0.15, 0.45  # m of height per m of distance
MARGIN = 0.9  # of the flattest row, for Grid/Smallest row height
FLATTEST = 0.25  # of the smallest cell: a flatter row takes more steps than the tip
DIAMETERS = 0.01, 100.0  # m
THINNEST = 1 / 5000  # wall, of the diameter
STEEL = 66.9e3  # N/m3 in water
WEIGHTS = 0.05, 1000.0  # that may be meant, of that of a skirt of steel
DEEPEST = 12e3  # m, of the sea
ROUNDING = 1e-9  # of a ratio of numbers that are written in decimals
SAMPLES = 1000  # of an integral over a part of the mesh


def check(body: Body, weight: float | None) -> None:
    """Refuse sizes (m) and a weight in water (N) that cannot be meant, such as those
    that miss their unit. Raises SuggestError."""
    d, mm = body.diameter, "; append mm to a length in millimeters"
    if not DIAMETERS[0] <= d <= DIAMETERS[1]:
        ends = " to ".join(f"{x:g}" for x in DIAMETERS)
        raise SuggestError(f"--diameter {d:g} m is not from {ends} m{mm}")
    if not is_between(THINNEST, body.wall / d, 0.1):
        what = "more than a tenth" if body.wall > d / 10 else "below 1/5000"
        raise SuggestError(
            f"--wall {body.wall:g} m is {what} of the diameter {d:g} m{mm}"
        )
    if not is_between(0.1, body.skirt / d, 10):
        raise SuggestError(
            f"--skirt {body.skirt:g} m does not go with --diameter {d:g} m: their ratio"
            " must be from 0.1 to 10"
        )
    if weight is None:
        return
    if weight <= 0:
        raise SuggestError("--weight must be positive")
    steel = pi * (d - body.wall) * body.wall * body.skirt * STEEL
    if not WEIGHTS[0] < weight / steel < WEIGHTS[1]:
        raise SuggestError(
            f"--weight {weight:g} N cannot be meant: the skirt alone weighs"
            f" {to_two_digits(steel / 1e3):g} kN in water if it is of steel; give the"
            " unit, as in 2500kN"
        )


def is_between(least: float, ratio: float, most: float) -> bool:
    """Return whether a ratio is within bounds, which are allowed."""
    return least * (1 - ROUNDING) <= ratio <= most * (1 + ROUNDING)


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


def zone_of(body: Body, start: float, cell: float, tops: Sequence[float]) -> float:
    """Return the height of the moving zone below the tip. Where it would end close to
    the top of a layer it ends there: the boundary of a layer is a line of the mesh, and
    a row between the two would be thin, which costs points and a short step. cell:
    height of the cells there (m)."""
    d = body.diameter
    zone = to_two_digits(max(d / 4, min(1.0, d / 2)))
    for top in tops:
        if abs(top - start - zone) < cell / 2:
            return round(top - start, 6)
    return zone


def cell_height_of(body: Body) -> float:
    """Return the height of the cells far away (m)."""
    return to_two_digits(body.diameter / 15)


def bottom_of(body: Body, start: float, end: float, zone: float) -> float:
    """Return the depth of the end of the mesh (m). zone: that moves below the tip."""
    d, travel = body.diameter, end - start
    depth = max(3 * d, end + 1.5 * d, start + zone + DEPTH_OF_TRAVEL * travel)
    return rounded_up(depth, step_of(d, 1.0))


def deepest_top(body: Body, start: float, end: float) -> float:
    """Return the depth (m) below which no layer of a mesh begins: it has two rows at
    least above the end."""
    row = max(cell_height_of(body), body.wall)
    return bottom_of(body, start, end, zone_of(body, start, 0.0, [])) - 2 * row


def row_at(distance: float, wall: float, cell: float) -> float:
    """Return the height of the rows at a distance from the tip (m) with the program's
    Grid/Growth ratio = auto. cell: height far away."""
    x = max(distance - FINE_WALLS * wall, 0.0)
    near = min(x, REACH_WALLS * wall)
    return min(cell, wall + GROWTH * near + FAR_GROWTH * (x - near))


def rows_between(lines: Sequence[float], wall: float, cell: float) -> list[float]:
    """Return the height of the flattest row between each two lines of the mesh (m), at
    the start. lines: distances below the tip; cell: height far away."""
    found = []
    for top, bottom in zip(lines, lines[1:]):
        step = (bottom - top) / SAMPLES
        sizes = [row_at(top + (k + 0.5) * step, wall, cell) for k in range(SAMPLES)]
        number = sum(step / size for size in sizes)
        found.append(sizes[0] * number / max(1, ceil(number - 1e-6)))
    return found


def refuse_thin(tops: Sequence[float], least: float, shares: Sequence[float]) -> None:
    """Refuse a layer that is too thin for the mesh. least: height of a row (m); shares:
    of their heights that is left at the end, of all layers. Raises SuggestError."""
    for top, bottom, share in zip(tops, tops[1:], shares):
        if (bottom - top) * share < least * (1 - 1e-9):
            raise SuggestError(
                f"the layer from {top:g} to {bottom:g} m is thinner than"
                f" {to_two_digits(least / share):g} m, the least for this wall and"
                " error: it would take more steps than the tip. Leave it out, or make"
                " it thicker"
            )


def mesh_of(
    body: Body, start: float, end: float, level: Level, tops: Sequence[float]
) -> Mesh:
    """Return the mesh for a travel between two depths in layers with these tops. Raises
    SuggestError where one is too thin for it."""
    d, travel, step = body.diameter, end - start, step_of(body.diameter, 1.0)
    cell_height = cell_height_of(body)
    cell = max(cell_height, body.wall)
    zone = zone_of(body, start, cell, tops)
    bottom = bottom_of(body, start, end, zone)
    share = 1 - travel / (bottom - start - zone)
    shares = [share if top > start + zone - 1e-9 else 1.0 for top in tops]
    refuse_thin(tops, FLATTEST * body.wall / level.cells, shares)
    lines = [t - start for t in tops if start + zone + 1e-9 < t < bottom]
    rows = rows_between([zone, *lines, bottom - start], body.wall, cell)
    return Mesh(
        outer_radius=2.5 * d,
        bottom=-bottom,
        top=rounded_up(body.skirt + step, step),
        cell_width=to_two_digits(d / 5),
        cell_height=cell_height,
        fine=FINE_WALLS * body.wall,
        moving_zone=zone,
        levels=level.levels,
        near_distance=to_two_digits(d / 10),
        smallest_row=to_two_digits(MARGIN * share * min(rows)),
    )


def start_of(skirt: float) -> float:
    """Return the depth at which the caisson is wished in place: 6 % of the skirt."""
    return rounded(0.06 * skirt, step_of(skirt, 1.0) / 20)


def frames_of(start: float, end: float) -> list[float]:
    """Return four depths of which pictures are made."""
    step = step_of(end, 1.0) / 10
    between = [rounded(end * share, step) for share in (1 / 3, 2 / 3)]
    return [start, *(depth for depth in between if start < depth < end), end]
