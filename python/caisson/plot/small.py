# SPDX-License-Identifier: LGPL-2.1-or-later
"""Axes of pictures in the units of small bodies: N, Pa and mm."""
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from caisson.shown import Units


def in_units(figure: Figure, shown: Units) -> None:
    """Let the axes of a figure, whose labels have kN, kPa or m in brackets, show their
    numbers in the units of a run."""
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            label_in_units(axis, shown)


def label_in_units(axis: Axis, shown: Units) -> None:
    """Change the label and the numbers of an axis."""
    label = axis.get_label_text()
    if (factor := shown.factor_of(label)) != 1:
        axis.set_label_text(shown.named(label))
        axis.set_major_formatter(FuncFormatter(lambda x, _: f"{factor * x:g}"))
