# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws the zones of the mesh and what their sizes are called: doc/pictures/zones.svg.
"""
import argparse

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from caisson.paths import PICTURES

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


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop draw-zones`: none."""


def main(_: argparse.Namespace) -> int:
    """Write the picture."""
    matplotlib.rcParams["svg.hashsalt"] = "caisson_mpm"
    figure = Figure(figsize=(8.6, 8))
    axes = figure.add_subplot()
    for part in (soil, mesh, names):
        part(axes)
    axes.set(xlim=(-0.3, 15), ylim=(BOTTOM - 0.9, TOP + 1.2), aspect="equal")
    axes.axis("off")
    picture = PICTURES / "zones.svg"
    figure.savefig(picture, bbox_inches="tight", metadata={"Date": None})
    return 0
