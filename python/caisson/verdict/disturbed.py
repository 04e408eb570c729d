# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an installation does to the ground, by the last frame of a run: the normal
stress on the walls over that at rest, and void ratio and vertical stress beside the
walls and below the tip."""
from typing import NamedTuple

import numpy as np

from caisson.frame import Frame, frames_of
from caisson.results import Results, ResultsError, Table

NEAR = 4.0  # wall thicknesses, which a zone reaches
# radii, and heights above the mudline, between which a ring of soil lies (m)
Zone = tuple[float, float, float, float]
RATIO, VOIDS = "vertical_stress_over_stress_at_rest", "void_ratio"


class Disturbed(NamedTuple):
    """At a depth (m): normal stress on inner and outer wall over that at rest, the void
    ratio before and after in each zone, and the vertical stress below the tip over that
    at rest, nan where it is not known."""

    depth: float
    walls: tuple[float, float]
    voids: dict[str, tuple[float, float]]
    below_tip: float


def last_rows(walls: Table, end: float) -> Table:
    """Return the rows of wall.csv below the mudline at the deepest frame above an end
    (m); empty without any."""
    reached = walls.get("penetration_m", np.empty(0))
    rows = reached <= end + 1e-3
    if not rows.any():
        return {}
    rows &= reached == reached[rows].max()
    rows &= walls["depth_m"] > 0
    return {name: column[rows] for name, column in walls.items()}


def stress_over_rest(rows: Table, side: str) -> float:
    """Return the mean normal stress on a wall over the horizontal one at rest."""
    area, stress = (rows[f"{side}_{x}"] for x in ("area_m2", "normal_stress_Pa"))
    known = np.isfinite(stress)
    at_rest = float(area[known] @ rows["horizontal_stress_at_rest_Pa"][known])
    return float(area[known] @ stress[known]) / at_rest if at_rest > 0 else np.nan


def zones_of(run: Results, depth: float) -> dict[str, Zone]:
    """Return the zones outside, inside and below the tip at a depth (m)."""
    diameter, wall = (float(run.scene[x]) for x in ("diameter_m", "wall_thickness_m"))
    radius, near = diameter / 2, NEAR * wall
    inner = radius - wall
    return {
        "outside": (radius, radius + near, -depth, 0.0),
        "inside": (inner - near, inner, -depth, 0.0),
        "below the tip": (inner, radius, -depth - near, -depth),
    }


def mean_in(frame: Frame, name: str, zone: Zone) -> float:
    """Return the mean of a field over the volume of the material points in a zone; nan
    where it is not known."""
    if (values := frame.point_data.get(name)) is None:
        return np.nan
    (r, z), volume = frame.positions.T, frame.point_data["whole_volume_m3"]
    inner, outer, bottom, top = zone
    rows = (inner < r) & (r < outer) & (bottom < z) & (z < top) & np.isfinite(values)
    if not rows.any():
        return np.nan
    return float(values[rows] @ volume[rows] / volume[rows].sum())


def of_frames(
    run: Results, depth: float
) -> tuple[dict[str, tuple[float, float]], float]:
    """Return the void ratios before and after in each zone, and the vertical stress
    below the tip over that at rest; nothing where frames are missing."""
    zones = zones_of(run, depth)
    try:
        found = [f for f in frames_of(run) if f.penetration <= depth + 0.01]
        if len(found) < 2:
            return {}, np.nan
        first, last = found[0], found[-1]
        voids = {
            name: (mean_in(first, VOIDS, zone), mean_in(last, VOIDS, zone))
            for name, zone in zones.items()
        }
        below = mean_in(last, RATIO, zones["below the tip"])
    except (ResultsError, OSError):
        return {}, np.nan
    return {
        name: ends for name, ends in voids.items() if np.isfinite(ends).all()
    }, below


def disturbed_of(run: Results, end: float) -> Disturbed | None:
    """Return the effect of the installation down to an end (m); None where the run has
    no stresses on the walls, or goes on, or where these contain the suction."""
    is_total = any(layer.get("total_stress") for layer in run.scene.get("layers", []))
    if run.is_running or is_total or not (rows := last_rows(run.walls, end)):
        return None
    depth = float(rows["penetration_m"][0])
    walls = stress_over_rest(rows, "inner"), stress_over_rest(rows, "outer")
    return Disturbed(depth, walls, *of_frames(run, depth))
