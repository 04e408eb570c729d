# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces on the caisson against its penetration, depth downward."""
import textwrap
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson import curves, disk
from caisson.plot import charts
from caisson.plot.charts import CAPTIONS, COLORS, Curve, column_of, line, smooth
from caisson.plot.small import fade, in_units, legend_below, over_depth, with_note
from caisson.results import Results, Table
from caisson.template import say_rows
from caisson.verdict import theory
from caisson.verdict.outcome import depth_of

# axis of a panel: with what the names of its curves begin; of the first one, all that
# are seen at first
PANELS = {
    "force (kN)": tuple(COLORS),
    "wall friction (kN)": ("inner friction", "outer friction"),
    "total force, and by design methods (kN)": ("total",),
}
INNER = "inner friction"
# where the penetration of a body is measured
LOWEST = {"caisson": "skirt tip", "pile": "pile base", "box": "base"}


def curves_of(run: Results) -> list[Curve]:
    """Return the curves of the page, and the limits of the meshes; those of an inner
    wall of a caisson only."""
    found, bounds = charts.force_curves(run, depth_of(run)), run.error_bounds
    for name in ("total", "tip"):
        if (limit := bounds.get(f"{name}_force_limit_N")) is not None:
            mean = smooth(bounds["penetration_m"], limit)
            label = f"{name}, best estimate from the meshes"
            found.append(line(label, COLORS[name], mean, bounds["penetration_m"]))
    is_seen = run.body == "caisson"
    return [c for c in found if is_seen or not c["label"].startswith(INNER)]


def set_limits(axes: Axes, shown: list[Curve], depth: np.ndarray) -> None:
    """Set limits from the running means, so that no spike of a raw line hides them,
    and from the methods up to half as much again."""

    def values(is_mean: bool) -> list[float]:
        some = [
            c for c in shown if bool(c.get("thick")) is is_mean and not c.get("far")
        ]
        every = (x for c in some for x in (*c["x"], *c.get("to", [])))
        return [0.0, *(x for x in every if x is not None)]

    means, others = values(True), values(False)
    most = max(max(means), min(max(others), 1.5 * max(means)))
    least = min(means + others)
    span = max(most - least, 1e-3)
    axes.set_xlim(least - 0.02 * span, most + 0.08 * span)
    axes.set_ylim(1.02 * max(depth.max(), 0), min(depth.min(), 0))


def draw_panel(axes: Axes, run: Results, shown: list[Curve], label: str) -> None:
    """Draw the curves of a panel over the penetration, and thin raw lines."""
    history, depth, names = run.history, run.history["penetration_m"], PANELS[label]
    some = [c for c in shown if c["label"].startswith(names)]
    if len(names) == len(COLORS):
        some = [c for c in some if not c.get("hidden")]
    for name in filter({c["label"] for c in some}.__contains__, COLORS):
        raw = history[column_of(name)] / 1e3
        axes.plot(raw, depth, color=COLORS[name], linewidth=0.5, alpha=0.35)
    charts.draw(axes, some)
    set_limits(axes, some, depth)
    fade(axes, depth_of(run))
    over_depth(axes, label, f"penetration of the {LOWEST.get(run.body, 'tip')} (m)")
    legend_below(axes)


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


def caption(run: Results, depth: np.ndarray) -> str:
    """Return what the lines mean, and which methods have none."""
    words = "", "", ""
    if not charts.has_suction(run):
        site, deepest = theory.site_of(run), max(float(depth.max()), 0.0)
        answers = theory.answers_of(site, np.array([deepest]))
        words = (
            theory.assumptions_in_words(site.scene) if answers[0].forces else "",
            theory.reasons_in_words(answers),
            theory.about_cone(site, deepest),
        )
    how = run.shown, charts.window_of(depth), *words
    texts = [text for _, text in say_rows(CAPTIONS, "forces", *how)]
    texts = [text.replace(" = ", "\u00a0=\u00a0") for text in texts]
    return "\n".join(textwrap.fill(text, 150) for text in texts)


def draw_over_depth(run: Results, depth: np.ndarray) -> Figure:
    """Return the figure of a body that penetrates; a panel of all methods is added
    where there is one besides Houlsby and Byrne."""
    shown = list(filter(charts.has_points, curves_of(run)))
    others = [c for c in shown if c.get("hidden") and c["label"].startswith("total")]
    labels = list(PANELS)[: 3 if others else 2]
    figure = Figure(figsize=(5.5 * len(labels), 7.5))
    figure.suptitle(run.title, fontsize=10)
    for axes, label in zip(figure.subplots(1, len(labels)), labels):
        draw_panel(axes, run, shown, label)
    with_note(figure, caption(run, depth))
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
