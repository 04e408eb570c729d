# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes over depth, notes below pictures, and the units of small bodies: N, Pa, mm."""
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.shown import Units


def fade(axes: Axes, end: float | None) -> None:
    """Draw gray what is deeper than suction reaches (m)."""
    if end is not None:
        bottom = max(axes.get_ylim())
        axes.axhspan(end, bottom, color="0.88", alpha=0.8, linewidth=0, zorder=2.5)
        if end < bottom:
            at = (0.5, (end + bottom) / 2)
            place = axes.get_yaxis_transform()
            style = {"ha": "center", "va": "center", "fontsize": 9, "zorder": 3}
            axes.text(*at, "not feasible", transform=place, color="0.3", **style)


def in_units(figure: Figure, shown: Units) -> None:
    """Let the axes of a figure, whose labels have kN, kPa or m in brackets, show their
    numbers in the units of a run."""
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            label = axis.get_label_text()
            if (factor := shown.factor_of(label)) != 1:
                axis.set_label_text(shown.named(label))
                axis.set_major_formatter(lambda x, _, f=factor: f"{f * x:g}")


def over_depth(axes: Axes, label: str, depth: str, grid: str = "both") -> None:
    """Name the axes of a panel over depth, the upper one with its unit."""
    axes.grid(color="0.9", axis=grid)
    axes.set_axisbelow(True)
    axes.xaxis.set_label_position("top")
    axes.xaxis.tick_top()
    axes.set_xlabel(label)
    axes.set_ylabel(depth)


def legend_below(axes: Axes, columns: int = 1) -> None:
    """Put the legend of axes over depth below them, where it covers no curve."""
    if axes.get_legend_handles_labels()[0]:
        at = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.01)}
        axes.legend(fontsize=8, frameon=False, ncols=columns, **at)


def write_beside(
    axes: Axes, text: str, at: tuple[float, float], side: int, **style: Any
) -> None:
    """Write a text to the left (-1) or right (1) of a place."""
    style = {"ha": "left" if side > 0 else "right", "va": "center", **style}
    axes.annotate(text, at, (4 * side, 0), textcoords="offset points", **style)


def with_note(figure: Figure, note: str) -> None:
    """Write a note below the panels of a figure."""
    figure.text(0.5, 0.008, note, ha="center", fontsize=8, color="0.3", wrap=True)
    room = 0.015 + 0.02 * len(note.splitlines())
    figure.set_layout_engine("tight", rect=(0, room, 1, 1))
