# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces on the caisson against its penetration, depth downward."""
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.curves import FORCE_WINDOW, path_of, running_mean
from caisson.plot import theory
from caisson.results import Results, Table

COLORS = {
    "total": "black",
    "tip": "#c0392b",
    "inner friction": "#2166ac",
    "outer friction": "#2e8b57",
}
FRICTION = ("inner friction", "outer friction")


def column_of(force: str) -> str:
    """Return the column of history.csv with a force."""
    return {"total": "total_force_N", "tip": "tip_force_N"}.get(
        force, force.replace(" ", "_") + "_N"
    )


def penetration(history: Table) -> np.ndarray | None:
    """Return the penetration of each row, or None where it does not change."""
    depth = history.get("penetration_m")
    if depth is None or not np.all(np.isfinite(depth)) or np.ptp(depth) < 1e-9:
        return None
    return depth


def smooth(depth: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Return the running mean of a force in kN; short runs have a window of a
    quarter of their path."""
    return running_mean(depth, force, window_of(depth)) / 1e3


def window_of(depth: np.ndarray) -> float:
    """Return the width of the window in m."""
    return min(FORCE_WINDOW, float(path_of(depth)[-1]) / 4)


def draw_curve(axes: Axes, depth: np.ndarray, force: np.ndarray, name: str) -> None:
    """Draw a thin raw line and its running mean, in kN."""
    color = COLORS[name]
    axes.plot(force / 1e3, depth, color=color, linewidth=0.5, alpha=0.35)
    axes.plot(smooth(depth, force), depth, color=color, linewidth=1.8, label=name)


def draw_bands(axes: Axes, bands: theory.Bands, names: tuple[str, ...]) -> None:
    """Draw the range between plain and enhanced stress of Houlsby and Byrne."""
    for name in names:
        if name not in bands.forces:
            continue
        plain, enhanced = [force / 1e3 for force in bands.forces[name]]
        color, hatch = COLORS[name], "////" if name == "outer friction" else None
        axes.fill_betweenx(
            bands.depth,
            plain,
            enhanced,
            facecolor="none" if hatch else color,
            edgecolor=color if hatch else "none",
            hatch=hatch,
            alpha=0.3 if hatch else 0.15,
            linewidth=0,
            label=f"{name}, Houlsby & Byrne (2005)",
        )
        axes.plot(plain, bands.depth, color=color, linewidth=0.8, linestyle="--")
        axes.plot(enhanced, bands.depth, color=color, linewidth=0.8, linestyle=":")


def error_band(
    bounds: Table, name: str, unit: str = ""
) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Return depths and running means of the lower and the upper bound of a quantity,
    [n_rows] each, or None where the run has none."""
    low, high = ["_".join(filter(None, [name, s, unit])) for s in ("low", "high")]
    if low not in bounds or high not in bounds:
        return None
    depth = bounds["penetration_m"]
    window = window_of(depth)
    means = [running_mean(depth, bounds[column], window) for column in (low, high)]
    return depth, means[0], means[1]


def draw_error_bar(
    axes: Axes,
    band: tuple[np.ndarray, np.ndarray, np.ndarray] | None,
    scale: float | np.ndarray,
    color: str,
    label: str,
) -> None:
    """Draw an error_band() times scale (one factor, or [n_rows]), if there is one."""
    if band is None:
        return
    depth, low, high = band
    axes.fill_betweenx(
        depth, low * scale, high * scale, color=color, alpha=0.3, lw=0, label=label
    )


def draw_error_bars(axes: Axes, bounds: Table) -> None:
    """Draw the bounds of total and tip force."""
    for name in ("total", "tip"):
        band = error_band(bounds, f"{name}_force", "N")
        draw_error_bar(axes, band, 1e-3, COLORS[name], f"{name}, error bar")


def set_limits(axes: Axes, depth: np.ndarray) -> None:
    """Set limits from the running means and the theory, so that no spike of a raw
    line hides them."""
    lines = [line for line in axes.lines if line.get_linewidth() > 0.5]
    values = np.concatenate([line.get_xdata() for line in lines] + [np.zeros(1)])
    values = values[np.isfinite(values)]
    span = max(np.ptp(values), 1e-3)
    axes.set_xlim(values.min() - 0.02 * span, values.max() + 0.08 * span)
    axes.set_ylim(1.02 * max(depth.max(), 0), min(depth.min(), 0))


def draw_panel(
    axes: Axes, run: Results, names: tuple[str, ...], bands: theory.Bands
) -> None:
    """Draw some forces over the penetration."""
    history, depth = run.history, run.history["penetration_m"]
    for name in names:
        if column_of(name) in history:
            draw_curve(axes, depth, history[column_of(name)], name)
    friction_only = names == FRICTION
    draw_bands(axes, bands, names if friction_only else ("tip",))
    if not friction_only:
        draw_error_bars(axes, run.error_bounds)
    set_limits(axes, depth)
    axes.xaxis.set_label_position("top")
    axes.xaxis.tick_top()
    axes.set_xlabel("wall friction (kN)" if friction_only else "force (kN)")
    axes.set_ylabel("penetration of the skirt tip (m)")
    axes.legend(fontsize=8, framealpha=0.9, loc="upper right")


def draw_over_time(axes: Axes, history: Table) -> None:
    """Draw what forces there are against time, where nothing penetrates."""
    for name, color in COLORS.items():
        if column_of(name) in history:
            force = history[column_of(name)] / 1e3
            axes.plot(history["time_s"], force, color=color, label=name)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("force (kN)")
    axes.legend(fontsize=8)


def caption(depth: np.ndarray, bands: theory.Bands) -> str:
    """Return what the lines mean."""
    window = window_of(depth)
    text = (
        f"thin: raw, thick: mean over {window:.3g} m, which ends {window / 2:.3g} m"
        " before the ends of the curve"
    )
    if bands.forces:
        return text + (
            "\nband: Houlsby & Byrne (2005), dashed without, dotted with stress"
            " enhancement (m = 1.5)"
        )
    return text + f"\nno band of Houlsby & Byrne (2005): {bands.why_not}"


def draw(path: Path, run: Results, title: str) -> Path | None:
    """Write the picture; return its path, or None without any force."""
    history = run.history
    if not any(column_of(name) in history for name in COLORS):
        print("plot: no forces in history.csv, so no forces.png")
        return None
    depth = penetration(history)
    figure = Figure(figsize=(7, 4) if depth is None else (11, 6.5))
    axes = figure.subplots(1, 1 if depth is None else 2, squeeze=False)[0]
    for panel in axes:
        panel.grid(color="0.9")
        panel.set_axisbelow(True)
    figure.suptitle(title, fontsize=10)
    if depth is None:
        draw_over_time(axes[0], history)
    else:
        bands = theory.bands_of(run.scene, max(depth.max(), 0))
        draw_panel(axes[0], run, tuple(COLORS), bands)
        draw_panel(axes[1], run, FRICTION, bands)
        text = caption(depth, bands)
        figure.text(0.5, 0.008, text, ha="center", fontsize=8, color="0.3")
    figure.tight_layout(rect=(0, 0 if depth is None else 0.045, 1, 1))
    figure.savefig(path, dpi=150)
    return path
