# SPDX-License-Identifier: LGPL-2.1-or-later
"""Springs of a caisson as a table and a picture of t-z curves, and what is said of
them."""
from pathlib import Path

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson import disk, table
from caisson.export.springs import SMALL, STILL_GROWS, WALLS, Springs
from caisson.export.text import WORDS, lines
from caisson.template import say

ROWS = 25  # of a curve in the table
SIGNS = (
    "t of a wall and q of the tip: the resistance is the change of the stress since the"
    " displacement began, against the motion; stress_kPa is the stress itself, upward"
    " on the caisson. Both are effective. The ultimate is the largest of the curve.",
)
SAME_DEPTH = 0.03  # of the depth, by which two runs beside each other may differ


def about_springs(found: Springs) -> list[str]:
    """Return what run and motion it is, and what the whole body does."""
    parts = []
    for wall in WALLS:
        if of_wall := [spring for spring in found.springs if spring.place == wall]:
            area, depths = sum(s.area for s in of_wall), [s.depth for s in of_wall]
            parts.append((wall, len(of_wall), area, depths))
    stiffness = [(share, found.stiffness(share)) for share in SMALL]
    is_missing = found.missing > 0.02 * found.force.max()
    said = lines("springs", found, parts, stiffness, is_missing, STILL_GROWS)
    return [f"caisson_mpm: {found.title}", *said, *about_waves(found)]


def about_waves(found: Springs) -> list[str]:
    """Return a warning where the waves have not gone far at the smallest displacement
    whose stiffness is stated, or where this is not known."""
    reach, needed = found.reach_at_first, found.needed_reach
    first = 1e3 * SMALL[0] * found.diameter
    if reach >= needed or first > 1e3 * found.displacement[-1]:
        return []
    far = found.reach >= needed
    end = 1e3 * found.displacement[np.argmax(far)] if far.any() else None
    return [say(WORDS, "waves", first, reach, needed, end)]


def about_both(found: Springs, other: Springs | None) -> list[str]:
    """Return what the run is, and the one beside it."""
    said = about_springs(found)
    if other is None:
        return said
    said += ["Beside it:", *about_springs(other)]
    if abs(other.depth - found.depth) > SAME_DEPTH * found.depth:
        said.append(
            f"WARNING: the tips are at {found.depth:.4g} m and {other.depth:.4g} m: a"
            " part of these differences is that of the depths."
        )
    return said


def beside(found: Springs, other: Springs, number: int) -> np.ndarray:
    """Return the resistance of the other run's nearest spring at the displacements
    [n] (Pa); nan where it has none, or ends before."""
    mine = found.springs[number]
    near = [s for s in other.springs if s.place == mine.place]
    if not near:
        return np.full(len(found.displacement), np.nan)
    nearest = min(near, key=lambda s: abs(s.depth - mine.depth))
    at = found.displacement
    values = np.interp(at, other.displacement, nearest.resistance)
    return np.where(at <= other.displacement[-1], values, np.nan)


def write_csv(path: Path, found: Springs, other: Springs | None) -> None:
    """Write one row for each spring and displacement."""
    names = ["place", "depth_m", "area_m2", "displacement_mm"]
    names += ["displacement_over_diameter", "resistance_kPa"]
    names += ["resistance_over_ultimate", "stress_kPa"]
    names += ["beside_resistance_kPa"] * (other is not None)
    # close to each other where the curves begin
    wanted = np.linspace(0, 1, ROWS) ** 2 * found.displacement[-1]
    picks = np.searchsorted(found.displacement, wanted)
    picks, rows = np.unique(np.minimum(picks, len(found.displacement) - 1)), []
    for number, spring in enumerate(found.springs):
        compared = None if other is None else beside(found, other, number)
        for row in picks:
            z, t = found.displacement[row], spring.resistance[row]
            values = [spring.depth, spring.area, 1e3 * z, z / found.diameter]
            values.append(t / 1e3)
            values.append(t / spring.ultimate if spring.ultimate else np.nan)
            values.append((spring.before + found.direction * t) / 1e3)
            if compared is not None:
                values.append(compared[row] / 1e3)
            rows.append([spring.place, *(f"{v:.6g}" for v in values)])
    table.write_csv(path, names, rows, [*about_both(found, other), *SIGNS])


def draw_force(axes: Axes, found: Springs, style: str, name: str) -> None:
    """Draw the resistance of the whole body and of tip and lid."""
    at = 1e3 * found.displacement
    axes.plot(at, found.force / 1e3, style, color="black", label=f"total{name}")
    for place, color in (("tip", "#c0392b"), ("lid", "#b9770e")):
        for spring in found.springs:
            if spring.place == place:
                force = spring.area * spring.resistance / 1e3
                axes.plot(at, force, style, color=color, label=f"{place}{name}")


def draw_wall(axes: Axes, found: Springs, style: str, wall: str, name: str) -> None:
    """Draw the curves of a wall, each with the color of its depth."""
    for spring in found.springs:
        if spring.place == wall:
            color = colormaps["viridis"](1 - spring.depth / found.depth)
            label = None if name else f"{spring.depth:.2g} m"
            at = 1e3 * found.displacement
            axes.plot(at, spring.resistance / 1e3, style, color=color, label=label)


def draw(path: Path, found: Springs, other: Springs | None) -> None:
    """Write the picture; the curves of the other run are dashed."""
    figure = Figure(figsize=(13, 4.6), layout="constrained")
    axes = figure.subplots(1, 3)
    runs = [(found, "-", ""), (other, "--", ", beside")]
    for run, style, name in runs:
        if run is not None:
            draw_force(axes[0], run, style, name)
            for panel, wall in zip(axes[1:], WALLS):
                draw_wall(panel, run, style, wall, name)
    axes[0].set_ylabel("resistance (kN)")
    axes[0].set_title("whole caisson", fontsize=10)
    for panel, wall in zip(axes[1:], WALLS):
        panel.set_ylabel("change of the shear stress (kPa)")
        panel.set_title(f"{wall} wall", fontsize=10)
    for panel in axes:
        panel.set_xlabel("displacement (mm)")
        panel.grid(color="0.9")
        panel.legend(fontsize=8)
    lines = [f"{found.title} (full lines)"]
    if other is not None:
        lines.append(f"{other.title} (dashed)")
    figure.suptitle("\n".join(lines), fontsize=9)
    disk.save(figure, path)
