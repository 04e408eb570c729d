# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws doc/pictures/blocks.png: how points lie in blocks, and what is in the
lanes while the kernels compute.
"""
import argparse
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch, Rectangle

from caisson.paths import PICTURES

PICTURE = PICTURES / "blocks.png"
Place = tuple[float, float]
CELLS = [
    "#f4a261",
    "#2a9d8f",
    "#e9c46a",
    "#8ab17d",
    "#457b9d",
    "#c97c9d",
    "#b5838d",
    "#6d6875",
]
EMPTY = "#e6e6e6"
SIZE = 0.42
LANES = 8


def squares(
    axes: Axes,
    x: float,
    y: float,
    colors: Sequence[str],
    texts: Sequence[str] = (),
) -> None:
    """Draw a row of lanes."""
    for i, color in enumerate(colors):
        axes.add_patch(
            Rectangle((x + i * SIZE, y), SIZE, SIZE, facecolor=color, edgecolor="white")
        )
        if texts:
            axes.text(
                x + (i + 0.5) * SIZE,
                y + 0.5 * SIZE,
                texts[i],
                ha="center",
                va="center",
                fontsize=8,
            )


def label(axes: Axes, x: float, y: float, text: str, **style: Any) -> None:
    """Write a text."""
    axes.text(x, y, text, fontsize=style.pop("fontsize", 9), va="center", **style)


def arrow(
    axes: Axes,
    start: Place,
    end: Place,
    text: str = "",
    offset: Place = (0, 0),
    ha: str = "center",
    **style: Any,
) -> None:
    """Draw an arrow with a text at its middle."""
    axes.annotate(
        "",
        xy=end,
        xytext=start,
        arrowprops={"arrowstyle": "-|>", "color": "0.25", "linewidth": 1.4, **style},
    )
    if text:
        label(
            axes,
            (start[0] + end[0]) / 2 + offset[0],
            (start[1] + end[1]) / 2 + offset[1],
            text,
            ha=ha,
        )


def title(axes: Axes, x: float, y: float, text: str) -> None:
    """Write the title of a part."""
    label(axes, x, y, text, fontsize=11, weight="bold")


def draw_cell(axes: Axes, x: float, y: float) -> None:
    """Draw a cell with thirteen points."""
    axes.add_patch(
        Rectangle((x, y), 2, 2, facecolor="white", edgecolor="0.3", linewidth=1.5)
    )
    for i in range(13):
        axes.plot(
            x + 0.3 + 0.47 * (i % 4) + 0.04 * (i // 4),
            y + 1.7 - 0.47 * (i // 4),
            "o",
            color=CELLS[0],
            markersize=9,
        )
        axes.text(
            x + 0.3 + 0.47 * (i % 4) + 0.04 * (i // 4),
            y + 1.69 - 0.47 * (i // 4),
            str(i),
            fontsize=6,
            ha="center",
            va="center",
        )
    label(axes, x + 1, y - 0.25, "a cell with 13 points", ha="center")


def draw_blocks(axes: Axes, x: float, y: float) -> None:
    """Draw the two blocks of this cell: a row for each field."""
    fields = [
        "r",
        "z",
        "velocity r",
        "velocity z",
        "stress, 4 rows",
        "mass",
        "volume",
        "plastic strains, 2",
    ]
    for b, count in enumerate([8, 5]):
        left = x + b * 4.1
        colors = [CELLS[0]] * count + [EMPTY] * (LANES - count)
        numbers = [str(8 * b + i) for i in range(count)] + [""] * (LANES - count)
        for i in range(len(fields)):
            squares(axes, left, y - i * SIZE, colors, numbers if i == 0 else ())
        label(axes, left + 4 * SIZE, y + 0.75, f"block, count {count}", ha="center")
    for i, field in enumerate(fields):
        label(axes, x - 0.12, y + (0.5 - i) * SIZE, field, ha="right", fontsize=8)
    label(
        axes,
        x,
        y - (len(fields) - 0.4) * SIZE,
        "state of the law, initial"
        " place, size, id: in the PointHistory of each block",
        fontsize=8,
    )
    arrow(axes, (x + 8 * SIZE, y + 0.75), (x + 4.1 + 0.35, y + 0.75))
    label(
        axes,
        x + 4.1 + 8 * SIZE + 0.15,
        y - 2.2 * SIZE,
        "empty lanes:\na valid point\nof mass and\nvolume 0",
        fontsize=8,
    )


def draw_sums(axes: Axes, x: float, y: float) -> None:
    """Draw eight cells: sums over points, transposed to cells in the lanes."""
    for cell in range(LANES):
        row = y - cell * SIZE * 1.15
        squares(axes, x, row, [CELLS[cell]] * LANES)
        arrow(
            axes,
            (x + 8 * SIZE + 0.1, row + SIZE / 2),
            (x + 8 * SIZE + 0.75, row + SIZE / 2),
        )
        squares(axes, x + 8 * SIZE + 0.85, row, [CELLS[cell]] * 4)
        label(axes, x - 0.12, row + SIZE / 2, f"cell {cell}", ha="right", fontsize=8)
    label(axes, x + 4 * SIZE, y + 0.72, "lanes = points", ha="center", weight="bold")
    label(
        axes,
        x + 10 * SIZE + 0.85,
        y + 0.78,
        "33 sums of\neach cell",
        ha="center",
        fontsize=8,
    )
    middle = y - 3.4 * SIZE * 1.15
    turned = x + 8 * SIZE + 0.85 + 4 * SIZE + 1.7
    arrow(
        axes, (turned - 1.55, middle), (turned - 0.15, middle), "transpose", (0, 0.25)
    )
    for i in range(4):
        squares(axes, turned, middle + (1.2 - i) * SIZE, CELLS)
    label(
        axes, turned + 4 * SIZE, y + 0.72, "lanes = cells", ha="center", weight="bold"
    )
    label(
        axes,
        turned + 4 * SIZE,
        middle - 1.65,
        "stress fit, Gauss points,\nstiffness, mean divergence,\n"
        "work, sums at the corners",
        ha="center",
        fontsize=8,
    )
    nodes = turned + 8 * SIZE + 1.5
    arrow(
        axes,
        (turned + 8 * SIZE + 0.1, middle),
        (nodes - 0.1, middle),
        "scatter",
        (0, 0.25),
    )
    label(axes, nodes, middle, "nodes")


def box(axes: Axes, x: float, y: float, width: float, text: str, color: str) -> None:
    """Draw a box with a text."""
    axes.add_patch(
        FancyBboxPatch(
            (x, y - 0.5),
            width,
            1,
            boxstyle="round,pad=0.08",
            facecolor=color,
            edgecolor="0.3",
        )
    )
    label(axes, x + width / 2, y, text, ha="center")


def draw_steps(axes: Axes, x: float, y: float) -> None:
    """Draw how the moments of one step serve the next."""
    box(axes, x, y, 3.1, "points to grid\nmoments to nodes", "#dbe9f6")
    box(axes, x + 4.2, y, 2.5, "nodes: contact,\nboundaries, XPIC", "#f1f1f1")
    box(
        axes,
        x + 7.8,
        y,
        4.3,
        "grid to points: update a cell's\npoints, then sum its moments",
        "#dbe9f6",
    )
    arrow(axes, (x + 3.25, y), (x + 4.05, y))
    arrow(axes, (x + 6.85, y), (x + 7.65, y))
    arrow(
        axes, (x + 10, y - 0.65), (x + 1.5, y - 0.65), connectionstyle="arc3,rad=-0.22"
    )
    label(
        axes,
        x + 5.8,
        y - 2.05,
        "moments for the next step, made while the points are in the cache;\n"
        "again in points to grid only for cells that points have left or "
        "entered",
        ha="center",
        fontsize=8,
    )


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop draw-blocks`: none."""


def main(_: argparse.Namespace) -> int:
    """Write the picture."""
    figure = Figure(figsize=(13, 12.45))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_xlim(0, 15.6)
    axes.set_ylim(-2.7, 12.24)
    axes.axis("off")
    title(axes, 0.3, 11.9, "1. In memory: blocks of eight points of one cell")
    draw_cell(axes, 0.5, 8.6)
    arrow(axes, (2.7, 9.6), (3.5, 9.6))
    draw_blocks(axes, 5.1, 10.6)
    title(axes, 0.3, 6.25, "2. In registers: points, then cells")
    draw_sums(axes, 1.1, 5.1)
    title(axes, 0.3, 0.8, "3. In a step")
    draw_steps(axes, 2.2, -0.3)
    axes.text(
        14.3,
        7.5,
        "one source,\nthree objects:\n\nSSE2: 2 lanes,\n"
        "four times a block\n\nAVX2: 4 lanes,\ntwice a block\n\n"
        "AVX-512: 8 lanes,\nonce a block",
        fontsize=9,
        ha="center",
        va="center",
        bbox={"boxstyle": "round,pad=0.5", "facecolor": "#f7f3e8", "edgecolor": "0.6"},
    )
    figure.savefig(PICTURE, dpi=110)
    print(f"draw_blocks: {PICTURE}")
    return 0
