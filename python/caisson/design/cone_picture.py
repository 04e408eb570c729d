# SPDX-License-Identifier: LGPL-2.1-or-later
"""cpt.png: the profile of a cone test beside the layers and their estimates."""
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

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
LINE, BAND = "#2166ac", "#2166ac"
PROFILE, TIP, WATER_LINE = "0.35", "#b2182b", "#4393c3"
PRESSURE = "$u_2$ (kPa)"
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
        found.append(Panel("$I_c$", ground.index, INDEX))
    if ground.pore_pressure is not None:
        found.insert(2, Panel(PRESSURE, ground.pore_pressure * 1e-3))
    has = {name for e in every for name in e.values}
    sand = rows_with(every, ANGLE, len(ground.depth))
    if DENSITY in has:
        rows = rows_with(every, DENSITY, len(ground.depth))
        density = 100 * correlations.densities_of(ground, names, BEST)
        shown = np.where(rows, density, np.nan)
        found.append(Panel("$D_r$ (%)", shown, DENSITY, 100.0))
    if ANGLE in has:
        angle = correlations.angles_of(ground, names, BEST)
        found.append(Panel("Friction angle (°)", np.where(sand, angle, np.nan), ANGLE))
    nothing = np.full(len(ground.depth), np.nan)
    for name, head in ((REFERENCE, "$E$ at 100 kPa (MPa)"), (MODULUS, "$E$ (MPa)")):
        if name in has:
            found.append(Panel(head, nothing, name, 1e-6))
    if STRENGTH in has:
        fine = rows_with(every, STRENGTH, len(ground.depth))
        strength = correlations.strengths_of(ground, names, BEST) * 1e-3
        profile = np.where(fine, strength, np.nan)
        found.append(Panel("$s_u$ (kPa)", profile, STRENGTH, 1e-3))
    return found


def rows_with(every: Sequence[Estimates], name: str, n: int) -> np.ndarray:
    """Return which rows [n] count in layers that have a parameter."""
    found = np.zeros(n, dtype=bool)
    for e in every:
        if name in e.values:
            found |= e.layer.rows
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
            axes.axhspan(
                top,
                bottom,
                facecolor=COLORS[kind],
                edgecolor="0.3",
                hatch="....",
                linewidth=0,
            )


def curves_of(panel: Panel, e: Estimates) -> tuple[np.ndarray, list[np.ndarray]] | None:
    """Return depths, and low, best and high there, of what a panel shows of a layer;
    None where it has no such estimate."""
    where = np.array([e.layer.top, e.layer.bottom])
    estimate = e.values.get(panel.estimate)
    if estimate is None:
        return None
    factor = panel.scale * (1 + estimate.growth * (where - e.layer.top))
    return where, [estimate.at(end) * factor for end in ENDS]


def draw_panel(
    axes: Axes, panel: Panel, depth: np.ndarray, every: Sequence[Estimates]
) -> None:
    """Draw a profile with the estimates of each layer."""
    axes.plot(panel.profile, depth, color=PROFILE, linewidth=0.9, zorder=3)
    largest = 0.0
    for e in every:
        curves = curves_of(panel, e)
        if curves is None:
            continue
        where, (low, best, high) = curves
        axes.fill_betweenx(where, low, high, color=BAND, alpha=0.22, lw=0, zorder=2)
        axes.plot(best, where, color=LINE, linewidth=2.2, zorder=4)
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
        axes.plot(at_rest, depth, color=WATER_LINE, linestyle="--", linewidth=1.0)
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


def draw_unmeasured(columns: Sequence[Axes], ground: Ground) -> None:
    """Hatch the soil above the first row that was measured, and gaps."""
    above = [(0.0, ground.measured_from)] if ground.above else []
    style = {"facecolor": "none", "edgecolor": "0.55", "hatch": "//", "lw": 0}
    for axes in columns:
        for top, bottom in (*above, *ground.gaps):
            axes.axhspan(top, bottom, **style)


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
    dashed = {"linestyle": "--"}
    unknown = {"facecolor": "none", "edgecolor": "0.55", "hatch": "//"}
    lens = {"edgecolor": "0.3", "hatch": "...."}
    handles: list[Line2D | Patch] = [
        Line2D([], [], color=PROFILE, linewidth=0.9, label="test, by row"),
        Line2D([], [], color=LINE, linewidth=2.2, label="best estimate of the layer"),
        Patch(color=BAND, alpha=0.22, label="low to high"),
        *(Patch(color=COLORS[k], label=k) for k in COLORS if k in kinds),
        *(
            Patch(facecolor=COLORS[k], label=f"lens of {k}", **lens)
            for k in COLORS
            if k in lenses
        ),
    ]
    if ground.pore_pressure is not None:
        handles.append(
            Line2D([], [], color=WATER_LINE, label="water at rest", **dashed)
        )
    if ground.above or ground.gaps:
        label = f"not measured, {ground.above or ASSUMED}"
        handles.append(Patch(label=label, **unknown))
    if tip is not None:
        label = f"skirt tip at {tip:g} m"
        handles.append(Line2D([], [], color=TIP, label=label, **dashed))
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
    draw_unmeasured(columns, ground)
    if tip is not None:
        for axes in columns:
            axes.axhline(tip, color=TIP, linewidth=1.4, linestyle="--", zorder=5)
    figure.suptitle(title, fontsize=11)
    shown = [p.estimate for p in panels if p.estimate in names]
    if not any(e.layer.kind == SAND for e in every):  # whose modulus is one of s_u
        shown = [name for name in shown if name != MODULUS]
    note = "; ".join(names[quantity] for quantity in shown)
    legend_of(figure, ground, every, note, tip)
    figure.set_layout_engine("tight", rect=(0, 0.06, 1, 1))
    return disk.save(figure, path)
