# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the floors of the program and one time step: doc/pictures/architecture.svg.
"""
import argparse

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

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
    ("checks", "#cfd8dc", "comparisons with exact values", "Verification"),
    (
        "output",
        "#cfd8dc",
        "files and observations",
        "Records, Visualization, Observations",
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


def box(axes: Axes, place: tuple[float, float, float, float], color: str) -> None:
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
        box(axes, (0, low, 7.3, 1.08), color)
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
        box(axes, (8.3, low + 0.14, 5.3, 0.74), COLORS[floor])
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


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop draw-architecture`: none."""


def main(_: argparse.Namespace) -> int:
    """Write the picture."""
    matplotlib.rcParams["svg.hashsalt"] = "caisson_mpm"
    figure = Figure(figsize=(12, 11.7))
    axes = figure.add_subplot()
    draw_floors(axes)
    draw_step(axes)
    axes.set(xlim=(-0.1, 14.5), ylim=(11.9 - len(STEP), 12.7))
    axes.axis("off")
    picture = PICTURES / "architecture.svg"
    figure.savefig(picture, bbox_inches="tight", metadata={"Date": None})
    return 0
