# SPDX-License-Identifier: LGPL-2.1-or-later
"""Windows: short ways shortly above some depths, instead of the whole way of a scene.

In a window the body begins wished in place, and is pushed by WIDTHS thicknesses of its
wall until it is at one of the depths. The mean of a number over the last third counts.
The inertia is that of the scene at this depth: where the tolerance grows with the way
(theory, section 12), the window has a larger one.

A window does not see what the way above it did to the soil, as to the friction of the
walls. So it is for differences between runs, relative to their values. Errors of the
suction and of what follows from it are absolute, so windows give none.
"""
import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from caisson import curves, disk, table
from caisson.results import Results
from caisson.runner import Entries, Run, query, set_options
from caisson.run_error_bar import SUCTION

WIDTHS, SHARE_OF_MEAN = 10.0, 1 / 3
NUMBERS = 4, 3, 2, 1  # of windows, the first as a rule
MOST = 0.5  # of the way of the scene: else its whole way costs little more
LEAST_WAY = 6 * curves.FORCE_WINDOW  # m: the means of two depths must not overlap
ROWS = 20  # of history.csv in a mean
# Simulation::stress_over_inertia_at_tip(): the tolerance over the way in radii
FIRST_SHARE, WHOLE_AFTER = 0.15, 1 / 3
LARGEST_TOLERANCE = 10.0


@dataclass(frozen=True)
class Window:
    """The way to a depth, in m."""

    start: float
    depth: float

    @property
    def name(self) -> str:
        """The directory of its run."""
        return f"to_{self.depth:.4g}_m"

    @property
    def length(self) -> float:
        """The way (m)."""
        return self.depth - self.start

    @property
    def averaged(self) -> float:
        """The length of the mean (m)."""
        return SHARE_OF_MEAN * self.length

    def entries(self, scene: Entries) -> dict[str, Any]:
        """Return what the window changes in the entries of the scene."""
        speed = float(scene["Rigid body/Velocity"])
        changed = {
            "Rigid body/Initial penetration": self.start,
            "Time/End penetration": self.depth,
            "Output/Record interval": self.averaged / ROWS / speed,
        }
        if (tolerance := scene["Time/Inertia tolerance"]) != "none":
            radius = float(scene["Rigid body/Outer diameter"]) / 2
            counted = self.depth - self.averaged / 2
            start = float(scene["Rigid body/Initial penetration"])
            factor = share_of_tolerance(counted - start, radius) / share_of_tolerance(
                counted - self.start, radius
            )
            changed["Time/Inertia tolerance"] = min(
                LARGEST_TOLERANCE, factor * float(tolerance)
            )
        return changed


def share_of_tolerance(way: float, radius: float) -> float:
    """Return what part of the inertia tolerance acts after a way (m)."""
    return min(1.0, max(FIRST_SHARE, way / radius / WHOLE_AFTER))


def windows_of(scene: Entries, number: int) -> list[Window]:
    """Return so many windows of a scene, the last one at the end of its
    way, or a single one in the middle: none of a body without a wall
    or with another way than one down to a depth at one speed, and of a way that is
    short or hardly longer than they are."""
    names = ["Rigid body/Wall thickness", "Rigid body/Velocity"]
    names += ["Rigid body/Initial penetration", "Time/End penetration"]
    try:
        thickness, speed, start, end = (float(scene[name]) for name in names)
    except ValueError:
        return []
    length = WIDTHS * thickness
    prescribed = scene["Rigid body/Motion"] == "prescribed" and speed > 0
    prescribed &= scene["Rigid body/Velocity table"] == ""
    hollow = scene["Rigid body/Kind"] == "caisson"
    is_long = end - start >= max(LEAST_WAY, number * length / MOST)
    if not (hollow and prescribed and is_long):
        return []
    shares = np.arange(1, number + 1) / number if number > 1 else [0.5] * number
    depths = start + (end - start) * np.array(shares)
    return [Window(float(depth) - length, float(depth)) for depth in depths]


def write_means(
    run: Run,
    windows: Sequence[Window],
    depths: Sequence[float],
    results: Sequence[Results],
) -> None:
    """Write the means of a scene in its windows as the results of a run: history.csv
    without the suction, in which each depth (m) has the means of the nearest window,
    constant about it, and run.json with the fingerprint of the scene. Raises
    RunError."""
    absolute = {quantity.column() for quantity in SUCTION}
    columns = [name for name in results[0].history if name not in absolute]
    means = []
    for history, window in zip((r.history for r in results), windows):
        depth = history["penetration_m"]
        last = depth > depth[-1] - window.averaged
        means.append({name: float(np.mean(x[last])) for name, x in history.items()})
    centers = np.array([window.depth for window in windows])
    half = curves.FORCE_WINDOW / 2
    # the first row of a history is no mean
    places = [depths[0] - 2 * half]
    places += [depth + side for depth in depths for side in (-half, half)]
    rows = []
    for place in places:
        mean = means[int(np.argmin(abs(centers - place)))]
        rows.append([{**mean, "penetration_m": place}[c] for c in columns])
    table.write_csv(run.directory / "history.csv", columns, rows)
    # by which the scene knows its error bar
    words = [str(run.scene), *set_options(run.entries), "--print-parameters"]
    _, _, fingerprint = query(words, run.program).rpartition("# fingerprint: ")
    found = {
        "entries": {**results[0].summary["entries"], **run.entry_texts()},
        "fingerprint": fingerprint,
        "wall_time_s": sum(r.summary["wall_time_s"] for r in results),
    }
    disk.write(run.directory / "run.json", json.dumps(found))
