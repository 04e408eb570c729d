# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lower faces of a caisson's wall above its tip: those of rings inside, and of steps to
a thicker wall. Sizes are in m; the scene is that of run.json."""
from collections.abc import Mapping
from math import inf, pi
from typing import Any, NamedTuple

FLUSH = "flush_face"  # of the scene: the face that is plane at the steps


class Ledge(NamedTuple):
    """A lower face: its height above the tip, its inner and outer radius, and the
    height of the steel above it, which of a step goes on up to the lid."""

    height: float
    inner: float
    outer: float
    steel: float
    is_inside: bool

    @property
    def width(self) -> float:
        """The width of the face (m)."""
        return self.outer - self.inner

    @property
    def area(self) -> float:
        """The area of the face (m2)."""
        return pi * (self.outer**2 - self.inner**2)


def parts_of_wall(
    scene: Mapping[str, Any], name: str, *lengths: str
) -> list[tuple[float, ...]]:
    """Return lengths (m) of the rings or steps of a wall ("ring", "wall_step") from
    below, such as above_tip."""
    keys = [[f"{name}_{i}_{x}_m" for x in lengths] for i in range(1, 21)]
    known = [row for row in keys if row[0] in scene]
    return [tuple(float(scene[key]) for key in row) for row in known]


def ledges_of(scene: Mapping[str, Any]) -> tuple[Ledge, ...]:
    """Return the ledges of a caisson; none of another body."""
    diameter, wall = scene.get("diameter_m"), scene.get("wall_thickness_m")
    if not diameter or not wall:
        return ()
    found, grows_inside = list[Ledge](), scene.get(FLUSH) != "inner"
    plane = float(diameter) / 2 - (0.0 if grows_inside else float(wall))
    walls = [(0.0, float(wall))]
    for height, thickness in parts_of_wall(
        scene, "wall_step", "above_tip", "thickness"
    ):
        if (below := walls[-1][1]) < thickness:
            radii = plane - thickness, plane - below
            if not grows_inside:
                radii = plane + below, plane + thickness
            found.append(Ledge(height, *radii, inf, grows_inside))
        walls.append((height, thickness))
    for place, width, steel in parts_of_wall(
        scene, "ring", "above_tip", "width", "height"
    ):
        behind = [thickness for height, thickness in walls if height <= place][-1]
        inner = plane - behind if grows_inside else plane
        found.append(Ledge(place, inner - width, inner, steel, True))
    return tuple(found)
