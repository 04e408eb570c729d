# SPDX-License-Identifier: LGPL-2.1-or-later
"""Springs of a caisson as a picture: the whole force, and the curves of each wall."""
from pathlib import Path

from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson import disk
from caisson.export.springs import WALLS, Springs


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
