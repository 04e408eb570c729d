# SPDX-License-Identifier: LGPL-2.1-or-later
"""cpt.png: the profile of a cone test beside the layers and their estimates."""
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from caisson.design import correlations
from caisson import disk
from caisson.design.cone_estimates import ENDS, INDEX, REFERENCE, RESISTANCE, Estimates
from caisson.design.cone_rules import ASSUMED
from caisson.design.correlations import ANGLE, BEST, DENSITY, MODULUS, STRENGTH
from caisson.units import WATER
from caisson.design.ground import CLAY, CLAY_ABOVE, SAND, SAND_BELOW, SILT, Ground

COLORS = {SAND: "#f3e2b3", SILT: "#d8d3c4", CLAY: "#c9b8a8"}
PROFILE = {"color": "0.35", "linewidth": 0.9}
BEST_LINE = {"color": "#2166ac", "linewidth": 2.2}
BAND = {"color": "#2166ac", "alpha": 0.22}
LENS = {"edgecolor": "0.3", "hatch": "...."}
UNKNOWN = {"facecolor": "none", "edgecolor": "0.55", "hatch": "//"}
WATER_LINE = {"color": "#4393c3", "linestyle": "--"}
TIP = {"color": "#b2182b", "linestyle": "--"}
PRESSURE = "$u_2$ (kPa)"
# title, scale, and correlation of what an estimate of soil shows beside its rows
OF_SOIL: dict[str, tuple[str, float, Any]] = {
    DENSITY: ("$D_r$ (%)", 100.0, correlations.densities_of),
    ANGLE: ("Friction angle (°)", 1.0, correlations.angles_of),
    REFERENCE: ("$E$ at 100 kPa (MPa)", 1e-6, None),
    MODULUS: ("$E$ (MPa)", 1e-6, None),
    STRENGTH: ("$s_u$ (kPa)", 1e-3, correlations.strengths_of),
}
WIDEST = 1.6  # of an axis over the largest estimate, so that no spike hides them


class Panel(NamedTuple):
    """A panel: title, profile [n] in the unit of the title, and the estimate to be
    drawn with its scale, "" for none."""

    title: str
    profile: np.ndarray
    estimate: str = ""
    scale: float = 1.0


def panels_of(
    ground: Ground, every: Sequence[Estimates], names: dict[str, str]
) -> list[Panel]:
    """Return the panels of a test."""
    found = [Panel("$q_c$ (MPa)", ground.resistance * 1e-6, RESISTANCE, 1e-6)]
    if ground.friction is not None:
        found.append(Panel("$f_s$ (kPa)", ground.friction * 1e-3))
    if ground.pore_pressure is not None:
        found.append(Panel(PRESSURE, ground.pore_pressure * 1e-3))
    if ground.friction is not None:
        found.append(Panel("$I_c$", ground.index, INDEX))
    for name, (title, scale, correlation) in OF_SOIL.items():
        profile = np.full(len(ground.depth), np.nan)
        layers = [e.layer for e in every if name in e.values]
        if layers and correlation:
            rows = np.any([layer.rows for layer in layers], axis=0)
            profile[rows] = scale * correlation(ground, names, BEST)[rows]
        if layers:
            found.append(Panel(title, profile, name, scale))
    return found


def draw_layers(axes: Axes, every: Sequence[Estimates]) -> None:
    """Draw the layers and their lenses."""
    for e in every:
        layer = e.layer
        axes.axhspan(
            layer.top, layer.bottom, color=COLORS[layer.kind], alpha=0.55, lw=0
        )
        axes.axhline(layer.top, color="0.45", linewidth=0.8)
        for top, bottom, kind in layer.lenses:
            axes.axhspan(top, bottom, facecolor=COLORS[kind], linewidth=0, **LENS)


def draw_panel(
    axes: Axes, panel: Panel, depth: np.ndarray, every: Sequence[Estimates]
) -> None:
    """Draw a profile with the estimates of each layer."""
    axes.plot(panel.profile, depth, zorder=3, **PROFILE)
    largest = 0.0
    for e in every:
        if (estimate := e.values.get(panel.estimate)) is None:
            continue
        where = np.array([e.layer.top, e.layer.bottom])
        factor = panel.scale * (1 + estimate.growth * (where - e.layer.top))
        low, best, high = (estimate.at(end) * factor for end in ENDS)
        axes.fill_betweenx(where, low, high, lw=0, zorder=2, **BAND)
        axes.plot(best, where, zorder=4, **BEST_LINE)
        largest = max(largest, float(high.max()))
    if panel.estimate == INDEX:
        for limit in (SAND_BELOW, CLAY_ABOVE):
            axes.axvline(limit, color="0.5", linewidth=0.8, linestyle=":")
        axes.set_xlim(1, 4)
    elif panel.estimate == ANGLE:
        axes.set_xlim(*correlations.ANGLES)
    elif panel.estimate == DENSITY:
        axes.set_xlim(0, 105)
    elif panel.title == PRESSURE:
        at_rest = WATER * depth * 1e-3
        axes.plot(at_rest, depth, linewidth=1.0, **WATER_LINE)
        ends = [*panel.profile, at_rest[-1], 0.0]
        axes.set_xlim(1.05 * min(ends), 1.05 * max(ends))
    else:
        shown = panel.profile[np.isfinite(panel.profile)]
        top = 1.05 * float(max(shown, default=0.0)) or 1.0
        if largest:
            top = max(1.05 * largest, min(top, WIDEST * largest))
        axes.set_xlim(0, top)
    axes.xaxis.set_label_position("top")
    axes.xaxis.tick_top()
    axes.set_xlabel(panel.title)
    axes.grid(color="0.85", linewidth=0.6)
    axes.set_axisbelow(True)


def name_layers(axes: Axes, every: Sequence[Estimates]) -> None:
    """Write the number and the kind of each layer into the first panel."""
    for number, e in enumerate(every, 1):
        axes.annotate(
            f"{number} {e.layer.kind}",
            (0.97, e.layer.top),
            (0, -3),
            xycoords=("axes fraction", "data"),
            textcoords="offset points",
            ha="right",
            va="top",
            fontsize=8,
            fontweight="bold",
            color="0.2",
            zorder=6,
        )


def legend_of(
    figure: Figure,
    ground: Ground,
    every: Sequence[Estimates],
    note: str,
    tip: float | None,
) -> None:
    """Draw the legend below the panels, with a note."""
    lenses = {kind for e in every for _, _, kind in e.layer.lenses}
    kinds = {e.layer.kind for e in every}
    handles: list[Line2D | Patch] = [
        Line2D([], [], label="test, by row", **PROFILE),
        Line2D([], [], label="best estimate of the layer", **BEST_LINE),
        Patch(label="low to high", **BAND),
        *(Patch(color=COLORS[k], label=k) for k in COLORS if k in kinds),
        *(
            Patch(facecolor=COLORS[k], label=f"lens of {k}", **LENS)
            for k in COLORS
            if k in lenses
        ),
    ]
    if ground.pore_pressure is not None:
        handles.append(Line2D([], [], label="water at rest", **WATER_LINE))
    if ground.above or ground.gaps:
        label = f"not measured, {ground.above or ASSUMED}"
        handles.append(Patch(label=label, **UNKNOWN))
    if tip is not None:
        handles.append(Line2D([], [], label=f"skirt tip at {tip:g} m", **TIP))
    figure.legend(
        handles=handles,
        loc="lower center",
        bbox_to_anchor=(0.5, 0.03),
        ncol=len(handles),
        fontsize=8,
        frameon=False,
    )
    figure.text(0.5, 0.012, note, ha="center", fontsize=8, color="0.3")


def draw(
    path: Path,
    title: str,
    ground: Ground,
    every: Sequence[Estimates],
    names: dict[str, str],
    tip: float | None = None,
) -> Path:
    """Write the picture. names: the correlation of each quantity; tip: the depth to
    which a skirt goes (m)."""
    panels = panels_of(ground, every, names)
    figure = Figure(figsize=(2.0 + 2.3 * len(panels), 7.5))
    columns = list(figure.subplots(1, len(panels), sharey=True, squeeze=False)[0])
    for axes, panel in zip(columns, panels):
        draw_layers(axes, every)
        draw_panel(axes, panel, ground.depth, every)
    columns[0].set_ylim(every[-1].layer.bottom, 0)
    columns[0].set_ylabel("Depth below the mudline (m)")
    name_layers(columns[0], every)
    above = [(0.0, ground.measured_from)] if ground.above else []
    for axes in columns:
        for top, bottom in (*above, *ground.gaps):  # where nothing was measured
            axes.axhspan(top, bottom, lw=0, **UNKNOWN)
        if tip is not None:
            axes.axhline(tip, linewidth=1.4, zorder=5, **TIP)
    figure.suptitle(title, fontsize=11)
    shown = [p.estimate for p in panels if p.estimate in names]
    if not any(e.layer.kind == SAND for e in every):  # whose modulus is one of s_u
        shown = [name for name in shown if name != MODULUS]
    note = "; ".join(names[quantity] for quantity in shown)
    legend_of(figure, ground, every, note, tip)
    figure.set_layout_engine("tight", rect=(0, 0.06, 1, 1))
    return disk.save(figure, path)
