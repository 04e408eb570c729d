# SPDX-License-Identifier: LGPL-2.1-or-later
"""The chart of a log: the required suction that the runs expect and what is allowed,
the measured line, and the forecast, over depth downward."""
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson import disk
from caisson.band import BEST, HIGH, LOW
from caisson.vessel_log import words
from caisson.vessel_log.expected import Expected
from caisson.vessel_log.forecast import Bins, Forecast
from caisson.vessel_log.measured import Log
from caisson.vessel_log.steps import suction_in, suction_of
from caisson.plot.suction import WHITE
from caisson.plot.small import in_units, legend_below, over_depth, with_note
from caisson.template import ends

GRAY, RED, BLUE, ORANGE = "0.45", "#c0392b", "#2166ac", "#d95f02"
MARGIN = 1.15  # of the largest suction of the lines
FAR = 1.6  # times the largest required suction, beyond which a limit is only named


def draw_expected(axes: Axes, expected: Expected, most: float = 0.0) -> None:
    """Draw the band of the runs and the allowable suction (kPa). most: of others."""
    depth = expected.depth
    low, best, high = expected.suctions.values()
    axes.fill_betweenx(
        depth, low, high, color=GRAY, alpha=0.2, lw=0, label="expected, low to high"
    )
    draw_line(axes, expected, LOW, low, color=GRAY, lw=0.8)
    draw_line(axes, expected, HIGH, high, color=GRAY, lw=0.8)
    label = "expected, best estimate"
    draw_line(axes, expected, BEST, best, color="black", lw=1.2, label=label)
    if expected.extrapolations():
        axes.plot([], [], "--", color=GRAY, lw=1.2, label="extrapolated: no run there")
    most = max(most, float(high.max()), 1e-3)
    limit, name = expected.allowable, governing_of(expected)
    seen = limit[np.isfinite(limit)]
    if len(seen) and seen.min() < FAR * most:
        axes.plot(limit, depth, color=RED, lw=1.8, label=f"allowable: {name}")
        most = max(most, min(float(seen.max()), FAR * most))
    elif len(seen):
        factor, unit = expected.run.shown.factor("kPa"), expected.run.shown.name("kPa")
        text = ends([factor * seen.min(), factor * seen.max()], ".0f")
        text = f"allowable: {text} {unit} ({name})"
        axes.text(0.02, 0.02, text, transform=axes.transAxes, fontsize=8, bbox=WHITE)
    axes.set_xlim(0, MARGIN * most)
    axes.set_ylim(1.02 * max(expected.planned, depth[-1]), 0)
    over_depth(axes, "suction (kPa)", "penetration of the skirt tip (m)")


def draw_line(
    axes: Axes, expected: Expected, name: str, line: np.ndarray, **style: Any
) -> None:
    """Draw the suction [n] (kPa) of low, best or high over depth; dashed where it is
    extrapolated."""
    is_guess, depth = expected.extrapolated[name], expected.depth
    axes.plot(np.where(is_guess, np.nan, line), depth, **style)
    near = np.convolve(is_guess, np.ones(3), "same") > 0  # with what it goes on from
    style.pop("label", None)
    axes.plot(np.where(near, line, np.nan), depth, ls=(0, (4, 3)), **style)


def governing_of(expected: Expected) -> str:
    """Return what governs the allowable suction from the surface down."""
    return ", then ".join(dict.fromkeys(filter(None, expected.governing)))


def draw(
    path: Path, expected: Expected, log: Log, bins: Bins, forecast: Forecast | None
) -> Path:
    """Write the chart, with the readings and the steps that the fit takes; return its
    path."""
    figure = Figure(figsize=(7.5, 7.5))
    axes = figure.subplots()
    figure.suptitle(textwrap.fill(expected.title, 90), fontsize=9)
    measured = suction_in(bins, expected)
    readings = suction_of(log, expected)
    lines = [measured, readings, *([forecast.high] if forecast else [])]
    draw_expected(axes, expected, max(float(np.nanmax(line)) for line in lines))
    if forecast:
        depth, sides = forecast.depth, (forecast.low, forecast.high)
        style = {"facecolor": ORANGE, "alpha": 0.25, "linewidth": 0}
        axes.fill_betweenx(depth, *sides, label="forecast, nine in ten", **style)
        axes.plot(forecast.best, depth, "--", color=ORANGE, lw=1.5, label="forecast")
    axes.plot(readings, log.depth, ".", color=BLUE, ms=2, alpha=0.35)
    axes.plot(measured, bins.depth, color=BLUE, lw=2, label="measured")
    legend_below(axes, 2)
    with_note(figure, textwrap.fill(words.of_source(expected), 110))
    in_units(figure, expected.run.shown)
    return disk.save(figure, path)
