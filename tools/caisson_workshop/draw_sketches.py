# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the sketches of the manual: the floors of the program and one time step
(doc/pictures/architecture.svg), and the zones of the mesh (doc/pictures/zones.svg).
"""
import argparse

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch, Rectangle

from caisson.paths import PICTURES

# From the top to the bottom: floor, color, what it is, its classes.
FLOORS = [
    (
        "simulation",
        "#d9dcd6",
        "the run: set-up, step, end",
        "Simulation, Schedule, Recorder",
    ),
    ("restart", "#cfd8dc", "checkpoints", "write_checkpoint, PointFile"),
    (
        "output",
        "#cfd8dc",
        "files and observations",
        "Visualization, Observations, RowFile",
    ),
    (
        "water",
        "#a2c4e0",
        "models of the pore water",
        "PoreWater, SteadySeepage, CoupledWater,\nLidCompartment",
    ),
    (
        "operators",
        "#f6bd60",
        "what happens at the nodes",
        "NodalMotion, NodalForces, Contact,\nBoundaryConditions, TimeStep",
    ),
    (
        "domain",
        "#84a59d",
        "grid and points, spread over the ranks",
        "GridLines, BackgroundGrid, MaterialPoints,\nPointGenerator, PointExchange",
    ),
    (
        "bodies",
        "#c9ada7",
        "the rigid body",
        "RigidBody = BodyShape + BodyMotion + BodySurface",
    ),
    ("materials", "#f5cac3", "layers of soil", "Soil"),
    (
        "kernels",
        "#f28482",
        "loops over points, pure templates",
        "points_to_grid, grid_to_points, the laws",
    ),
    (
        "base",
        "#e8e8e4",
        "what the user wrote, terminal, errors, totals",
        "read_parameters, Expression, Console, RunTotals",
    ),
]
COLORS = {name: color for name, color, *_ in FLOORS}

# A step: the floor that works, what it does, the function and what it touches.
STEP = [
    ("operators", "choose the step", "TimeStep, Schedule"),
    ("water", "begin the step of the pore water", "PoreWater::begin_step"),
    ("bodies", "move the body", "BodyMotion::advance"),
    ("kernels", "points to grid", "sums of each cell: mass, momentum, force"),
    ("operators", "add the nodal forces", "NodalForces"),
    ("operators", "equation of motion", "v = p / m,   v+ = v + dt f / m"),
    ("water", "correct v+ by implicit forces", "NodalForce::solve"),
    ("operators", "contact, boundary conditions", "constrain v+"),
    ("operators", "prepare the transfer", "fields of FLIP, XPIC and MUSL; works"),
    ("domain", "move the mesh", "BackgroundGrid::prepare_motion"),
    (
        "kernels",
        "grid to points",
        "velocity, strain, law, place; sums for the next step",
    ),
    ("domain", "relocate", "points walk to their cells and ranks; split, merge"),
    ("operators", "add up the energies", "EnergyBalance"),
    ("output", "record what is due", "Recorder: history, frames, checkpoint"),
]


def rounded_box(
    axes: Axes, place: tuple[float, float, float, float], color: str
) -> None:
    """A box with its left and lower edge, width and height."""
    left, low, width, height = place
    style = "round,pad=0,rounding_size=0.08"
    patch = FancyBboxPatch((left, low), width, height, boxstyle=style)
    patch.set(facecolor=color, edgecolor="#444444", linewidth=0.8)
    axes.add_patch(patch)


def draw_floors(axes: Axes) -> None:
    """The floors, the lowest at the bottom."""
    axes.text(0, 12.35, "Floors: each uses those below it", fontsize=12, weight="bold")
    for i, (name, color, what, classes) in enumerate(FLOORS):
        low = 12.0 - 1.2 * (i + 1)
        rounded_box(axes, (0, low, 7.3, 1.08), color)
        axes.text(0.15, low + 0.77, name, fontsize=10.5, weight="bold", va="center")
        axes.text(1.75, low + 0.77, what, fontsize=9.5, va="center")
        axes.text(
            1.75, low + 0.33, classes, fontsize=8, va="center", family="monospace"
        )


def draw_step(axes: Axes) -> None:
    """The parts of a step, with an arrow back to the first."""
    axes.text(
        7.6, 12.35, "One step, in the colors of the floors", fontsize=12, weight="bold"
    )
    for i, (floor, what, how) in enumerate(STEP):
        low = 12.0 - 1.0 * (i + 1)
        rounded_box(axes, (8.3, low + 0.14, 5.3, 0.74), COLORS[floor])
        axes.text(8.45, low + 0.66, f"{i + 1}. {what}", fontsize=10, va="center")
        axes.text(8.8, low + 0.34, how, fontsize=8.5, va="center")
        if i > 0:
            arrow = {"arrowstyle": "->", "color": "#444444"}
            axes.annotate("", (10.9, low + 0.88), (10.9, low + 1.14), arrowprops=arrow)
    back = {
        "arrowstyle": "->",
        "color": "#444444",
        "connectionstyle": "bar,fraction=0.05",
    }
    last = 12.5 - len(STEP)
    axes.annotate("", (13.65, 11.5), (13.65, last), arrowprops=back)


SAND, PATH, NEAR, FINE, STEEL = "#f3e6cf", "#e0a458", "#efcd95", "#419d78", "#555b6e"
# Sizes of the sketch, not to scale: radius, bottom, top, wall, tip, zone below it.
RADIUS, BOTTOM, TOP, INSIDE, OUTSIDE, TIP, ZONE = 12.0, -10.0, 4.0, 3.6, 4.2, -2.2, -5.4


def box(
    axes: Axes, left: float, low: float, right: float, high: float, color: str
) -> None:
    """A filled rectangle."""
    size = right - left, high - low
    axes.add_patch(Rectangle((left, low), *size, facecolor=color, edgecolor="none"))


def size(axes: Axes, a: tuple[float, float], b: tuple[float, float]) -> None:
    """An arrow with two heads from a to b."""
    style = {"arrowstyle": "<->", "shrinkA": 0, "shrinkB": 0, "color": "#222222"}
    axes.annotate("", a, b, arrowprops=style)


def words(axes: Axes, r: float, z: float, text: str, **options: object) -> None:
    """Some words, with their left edge at r."""
    axes.text(r, z, text, va="center", fontsize=10, **options)


def soil(axes: Axes) -> None:
    """The soil with its zones of points, and the fine cells."""
    box(axes, 0, BOTTOM, RADIUS, 0, SAND)
    box(axes, INSIDE - 1.3, -8.4, OUTSIDE + 1.3, 0, NEAR)
    box(axes, INSIDE - 0.4, -7.4, OUTSIDE + 0.4, 0, PATH)
    frame = Rectangle((INSIDE - 0.8, TIP - 0.8), 2.2, 1.6, fill=False)
    frame.set(edgecolor=FINE, linewidth=2, hatch="++", zorder=2)
    axes.add_patch(frame)
    box(axes, INSIDE, TIP, OUTSIDE, 2.6, STEEL)
    box(axes, 0, 2.2, OUTSIDE, 2.6, STEEL)
    axes.plot([0, RADIUS], [0, 0], color="#7a5c2e", linewidth=1.5)


def mesh(axes: Axes) -> None:
    """The border of the domain and of the moving zone."""
    axes.add_patch(Rectangle((0, BOTTOM), RADIUS, TOP - BOTTOM, fill=False))
    axes.plot([0, RADIUS], [ZONE, ZONE], "--", color="#22577a", linewidth=1.5)
    axes.plot([0, 0], [BOTTOM - 0.6, TOP + 0.6], "-.", color="#222222", linewidth=1)
    words(axes, 0.15, BOTTOM - 0.5, "axis")
    words(axes, 6.1, TOP - 0.5, "empty cells above the soil")
    words(axes, 6.1, -3.6, "moving zone:\nfollows the body", color="#22577a")
    words(axes, 6.1, -6.9, "compressing zone:\nis squeezed", color="#22577a")
    words(axes, 0.3, -1.2, "plug")
    words(axes, 0.3, -9.2, "far")


def names(axes: Axes) -> None:
    """The entries of section Grid and Material points, with the sizes they set."""
    size(axes, (0, TOP + 0.5), (RADIUS, TOP + 0.5))
    words(axes, 5, TOP + 0.9, "Outer radius")
    size(axes, (RADIUS + 0.4, 0), (RADIUS + 0.4, TOP))
    words(axes, RADIUS + 0.6, TOP / 2, "Top")
    size(axes, (RADIUS + 0.4, 0), (RADIUS + 0.4, BOTTOM))
    words(axes, RADIUS + 0.6, -5, "Bottom\n(negative)")
    size(axes, (INSIDE + 1.0, TIP), (INSIDE + 1.0, ZONE))
    words(axes, 6.1, -4.7, "Moving zone below tip")
    axes.plot([4.65, 6.0], [-4.7, -4.7], color="#222222", linewidth=0.6)
    size(axes, (OUTSIDE, TIP + 0.4), (OUTSIDE + 0.8, TIP + 0.4))
    axes.plot([4.9, 6.0], [-1.65, -1.2], color="#222222", linewidth=0.6)
    words(axes, 6.1, -1.2, "Fine width")
    size(axes, (INSIDE - 0.6, TIP), (INSIDE - 0.6, TIP - 0.8))
    axes.plot([2.9, 2.2], [-2.7, -2.9], color="#222222", linewidth=0.6)
    words(axes, 0.2, -2.9, "Fine height")
    size(axes, (OUTSIDE, -7.0), (OUTSIDE + 0.4, -7.0))
    axes.plot([4.4, 6.0], [-7.05, -8.1], color="#222222", linewidth=0.6)
    words(axes, 6.1, -8.1, "Path margin")
    size(axes, (OUTSIDE, -8.0), (OUTSIDE + 1.3, -8.0))
    axes.plot([5.2, 6.0], [-8.05, -9.0], color="#222222", linewidth=0.6)
    words(axes, 6.1, -9.0, "Near distance")
    words(axes, INSIDE - 0.3, -6.5, "path")
    words(axes, INSIDE - 1.25, -7.9, "near")


def save(figure: Figure, axes: Axes, name: str) -> None:
    """Write a picture, the same bytes each time."""
    matplotlib.rcParams["svg.hashsalt"] = "caisson_mpm"
    axes.axis("off")
    figure.savefig(PICTURES / name, bbox_inches="tight", metadata={"Date": None})


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop draw-sketches`: none."""


def main(_: argparse.Namespace) -> int:
    """Write both pictures."""
    figure = Figure(figsize=(12, 11.7))
    axes = figure.add_subplot()
    draw_floors(axes)
    draw_step(axes)
    axes.set(xlim=(-0.1, 14.5), ylim=(11.9 - len(STEP), 12.7))
    save(figure, axes, "architecture.svg")

    figure = Figure(figsize=(8.6, 8))
    axes = figure.add_subplot()
    for part in (soil, mesh, names):
        part(axes)
    axes.set(xlim=(-0.3, 15), ylim=(BOTTOM - 0.9, TOP + 1.2), aspect="equal")
    save(figure, axes, "zones.svg")
    return 0
