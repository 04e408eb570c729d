# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces on the caisson against its penetration, depth downward."""
import textwrap
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.verdict.outcome import depth_of
from caisson import curves, disk
from caisson.curves import error_band, path_of, running_mean
from caisson.plot import soil_range
from caisson.verdict import theory
from caisson.plot.small import CAPTIONS, fade, in_units, legend_below
from caisson.plot.small import over_depth, with_note
from caisson.results import Results, Table
from caisson.template import say_rows

COLORS = {
    "total": "black",
    "tip": "#c0392b",
    "inner friction": "#2166ac",
    "outer friction": "#2e8b57",
}
WITH_WATER = "total with water"
WATER_COLOR = "#7b3294"
FRICTION = ("inner friction", "outer friction")
# where the penetration of a body is measured
LOWEST = {"caisson": "skirt tip", "pile": "pile base", "box": "base"}
BARS = 12  # over the depth of an error bar
MEAN = 1.8  # width of the line of a running mean, and of no other


def column_of(force: str) -> str:
    """Return the column of history.csv with a force."""
    return {"total": "total_force_N", "tip": "tip_force_N"}.get(
        force, force.replace(" ", "_") + "_N"
    )


def smooth(depth: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Return the running mean of a force in kN; short runs have a window of a
    quarter of their path."""
    return running_mean(depth, force, window_of(depth)) / 1e3


def window_of(depth: np.ndarray) -> float:
    """Return the width of the window in m."""
    return curves.window_of(float(path_of(depth)[-1]))


def draw_curve(axes: Axes, depth: np.ndarray, force: np.ndarray, name: str) -> None:
    """Draw a thin raw line and its running mean, in kN."""
    color = COLORS.get(name, WATER_COLOR)
    axes.plot(force / 1e3, depth, color=color, linewidth=0.5, alpha=0.35)
    axes.plot(smooth(depth, force), depth, color=color, linewidth=MEAN, label=name)


def has_suction(run: Results) -> bool:
    """Return whether a run has suction: its forces are not those of jacking, beside
    which methods stand."""
    return "required_suction_Pa" in run.history


def draw_bands(axes: Axes, answer: theory.Answer, names: tuple[str, ...]) -> None:
    """Draw the range of Houlsby and Byrne, and the bound below it."""
    for name in names if answer.forces else ():
        low, high = [force / 1e3 for force in answer.band(name)]
        color, hatch = COLORS[name], "////" if name == "outer friction" else None
        axes.fill_betweenx(
            answer.depth,
            low,
            high,
            facecolor="none" if hatch else color,
            edgecolor=color if hatch else "none",
            hatch=hatch,
            alpha=0.3 if hatch else 0.15,
            linewidth=0,
            label=f"{name}, {answer.name}",
        )
        axes.plot(low, answer.depth, color=color, linewidth=0.8, linestyle="--")
        axes.plot(high, answer.depth, color=color, linewidth=0.8, linestyle=":")
        (bound,) = answer.method.bound
        axes.plot(
            answer.forces[bound][name] / 1e3,
            answer.depth,
            color=color,
            linewidth=0.6,
            linestyle="-.",
            label=theory.LOWER_BOUND if name == names[-1] else None,
        )


def draw_error_bar(
    axes: Axes,
    band: tuple[np.ndarray, np.ndarray, np.ndarray] | None,
    scale: float | np.ndarray,
    color: str,
    label: str,
) -> None:
    """Draw an error_band() times scale (one factor, or [n_rows]) as bars at some of its
    depths, if there is one; a band is for methods and estimates."""
    if band is None:
        return
    table = np.array([band[0], band[1] * scale, band[2] * scale])
    table = table[:, np.isfinite(table).all(axis=0)]
    at = np.unique(np.linspace(0, max(table.shape[1] - 1, 0), BARS).astype(int))
    depth, low, high = table[:, at[: table.shape[1]]]
    middle, half = (low + high) / 2, np.abs(high - low) / 2
    style = {"ecolor": color, "elinewidth": 1.2, "capsize": 2.5, "zorder": 2.1}
    axes.errorbar(middle, depth, xerr=half, fmt="none", label=label, **style)


def draw_error_bars(axes: Axes, bounds: Table) -> None:
    """Draw the bounds of total and tip force, and the limits of the meshes."""
    for name in ("total", "tip"):
        band = error_band(bounds, f"{name}_force", "N")
        draw_error_bar(axes, band, 1e-3, COLORS[name], f"{name}, error bar")
        if (limit := bounds.get(f"{name}_force_limit_N")) is not None:
            depth = bounds["penetration_m"]
            mean = running_mean(depth, limit, window_of(depth))
            label = "best estimate from the meshes" if name == "tip" else None
            axes.plot(
                mean / 1e3, depth, color=COLORS[name], ls=":", lw=1.2, label=label
            )


def set_limits(axes: Axes, depth: np.ndarray, end: float | None) -> None:
    """Set limits from the running means, so that no spike of a raw line hides them,
    and from the methods up to half as much again. end: the depth where suction ends
    (m), below which all is gray."""

    def values(is_mean: Callable[[float], bool]) -> np.ndarray:
        lines = [
            x.get_xdata()[x.get_ydata() <= (np.inf if end is None else end)]
            for x in axes.lines
            if is_mean(x.get_linewidth())
        ]
        found = np.concatenate([*lines, np.zeros(1)])
        return found[np.isfinite(found)]

    means, others = values(lambda w: w >= MEAN), values(lambda w: 0.5 < w < MEAN)
    most = max(means.max(), min(others.max(), 1.5 * means.max()))
    least = min(means.min(), others.min())
    span = max(most - least, 1e-3)
    axes.set_xlim(least - 0.02 * span, most + 0.08 * span)
    axes.set_ylim(1.02 * max(depth.max(), 0), min(depth.min(), 0))
    fade(axes, end)


def label_axes(axes: Axes, name: str, body: str) -> None:
    """Name the force of a panel, and place its axes and its legend."""
    depth = f"penetration of the {LOWEST.get(body, 'tip')} (m)"
    over_depth(axes, f"{name} (kN)", depth)
    legend_below(axes)


def draw_panel(
    axes: Axes, run: Results, names: tuple[str, ...], answer: theory.Answer
) -> None:
    """Draw some forces over the penetration, beside those of Houlsby and Byrne."""
    history, depth = run.history, run.history["penetration_m"]
    for name in names:
        has_wall = name != "inner friction" or run.body == "caisson"
        if column_of(name) in history and has_wall:
            draw_curve(axes, depth, history[column_of(name)], name)
    friction_only = names == FRICTION
    if not friction_only and (force := history.get(curves.WITH_WATER)) is not None:
        draw_curve(axes, depth, force, WITH_WATER)
    if not has_suction(run):
        draw_bands(axes, answer, names if friction_only else ("total", "tip"))
    if not friction_only:
        draw_error_bars(axes, run.error_bounds)
    set_limits(axes, depth, depth_of(run))
    for end in (
        [] if friction_only else soil_range.draw(axes, run, "total_force_N", "total")
    ):
        axes.set_xlim(right=max(1.05 * end.max(), axes.get_xlim()[1]))
    label_axes(axes, "wall friction" if friction_only else "force", run.body)


def has_line(answer: theory.Answer) -> bool:
    """Return whether a method has an answer at any depth."""
    return bool(answer.forces) and bool(np.isfinite(answer.band("total")[0]).any())


def draw_methods(axes: Axes, run: Results, answers: list[theory.Answer]) -> None:
    """Draw the total force beside those of all methods that have one."""
    history, depth = run.history, run.history["penetration_m"]
    if column_of("total") in history:
        draw_curve(axes, depth, history[column_of("total")], "total")
    for answer in filter(has_line, answers):
        method, (low, high) = answer.method, answer.band("total")
        style = {"facecolor": method.color, "alpha": 0.18, "linewidth": 0}
        label = f"{answer.name}, {' to '.join(method.cases)}"
        axes.fill_betweenx(answer.depth, low / 1e3, high / 1e3, label=label, **style)
        for line, force in zip(("--", ":"), (low, high)):
            edge = {"color": method.color, "linewidth": 0.9, "linestyle": line}
            axes.plot(force / 1e3, answer.depth, **edge)
    set_limits(axes, depth, depth_of(run))
    label_axes(axes, "total force, and by design methods", run.body)


def draw_over_time(axes: Axes, history: Table) -> None:
    """Draw what forces there are against time, where nothing penetrates."""
    for name, color in COLORS.items():
        if column_of(name) in history:
            force = history[column_of(name)] / 1e3
            axes.plot(history["time_s"], force, color=color, label=name)
    axes.grid(color="0.9")
    axes.set_xlabel("time (s)")
    axes.set_ylabel("force (kN)")
    axes.legend(fontsize=8)


def caption(run: Results, site: theory.Site, answers: list[theory.Answer]) -> str:
    """Return what the lines mean, and which methods have none."""
    depth = run.history["penetration_m"]
    words = "", "", ""
    if not has_suction(run):
        words = (
            theory.assumptions_in_words(site.scene) if answers[0].forces else "",
            theory.reasons_in_words(answers),
            theory.about_cone(site, float(depth.max())),
        )
    found = say_rows(CAPTIONS, "forces", run.shown, window_of(depth), *words)
    lines = [text.replace(" = ", "\u00a0=\u00a0") for _, text in found]
    return "\n".join(textwrap.fill(line, 150) for line in lines)


def draw_over_depth(run: Results, depth: np.ndarray) -> Figure:
    """Return the figure of a body that penetrates; a panel of all methods is added
    where there is one besides Houlsby and Byrne."""
    site = theory.site_of(run)
    answers = theory.answers_to(site, max(depth.max(), 0))
    with_methods = not has_suction(run) and any(map(has_line, answers[1:]))
    figure = Figure(figsize=(16.5 if with_methods else 11, 7.5))
    figure.suptitle(run.title, fontsize=10)
    panels = figure.subplots(1, 3 if with_methods else 2)
    draw_panel(panels[0], run, tuple(COLORS), answers[0])
    draw_panel(panels[1], run, FRICTION, answers[0])
    if with_methods:
        draw_methods(panels[2], run, answers)
    text = caption(run, site, answers)
    with_note(figure, text)
    return figure


def draw(path: Path, run: Results) -> Path | None:
    """Write the picture; return its path, or None without any force."""
    history = run.history
    if not any(column_of(name) in history for name in COLORS):
        print("plot: no forces in history.csv, so no forces.png")
        return None
    depth = curves.penetration(history)
    if depth is None:
        figure = Figure(figsize=(7, 4))
        figure.suptitle(run.title, fontsize=10)
        draw_over_time(figure.subplots(), history)
        figure.set_layout_engine("tight")
    else:
        figure = draw_over_depth(run, depth)
    in_units(figure, run.shown)
    return disk.save(figure, path)
