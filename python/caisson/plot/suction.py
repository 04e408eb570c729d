# SPDX-License-Identifier: LGPL-2.1-or-later
"""Suction, exit gradient and heave of the plug over penetration, depth downward."""
import textwrap
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.verdict.outcome import depth_of
from caisson.evaluation import rest_of_run
from caisson.plot import soil_range
from caisson.verdict import limits, suction_methods as methods, theory
from caisson.curves import error_band, way_down
from caisson.plot.forces import COLORS, draw_error_bar
from caisson.plot.small import CAPTIONS, fade, in_units, legend_below
from caisson.plot.small import over_depth, with_note
from caisson.results import Results, Table
from caisson.template import say_rows
from caisson import curves, disk

BLUE, GREEN, RED = (
    COLORS[name] for name in ("inner friction", "outer friction", "tip")
)
COLOR_OF = {methods.HOULSBY_BYRNE: BLUE} | {m.name: m.color for m in methods.BY_CONE}
# column of design.csv: label and line of a critical suction; a required one is a band
CRITICAL_COLOR = "#b35806"
ALLOWABLE, WIDE_COLOR = "allowable, the least of the limits", "#f4b6b6"
CRITICAL = {
    methods.PIPING: ("Houlsby & Byrne (2005)", "-"),  # drawn as a limit
    methods.CRITICAL_SENDERS_RANDOLPH: ("Senders & Randolph (2009)", "--"),
    methods.CRITICAL_IBSEN_THILSTED: ("Ibsen & Thilsted (2011)", (0, (6, 6))),
    methods.CRITICAL_FELD: ("Feld (2001)", ":"),
}
ERROR_BAR = "error bar"  # its name in the legends
WHITE = {"facecolor": "white", "edgecolor": "0.8"}  # behind a text


def from_rest_on(suction: np.ndarray) -> np.ndarray:
    """Return a suction in kPa, nan where it is 0, but for the last such row."""
    needed = suction != 0
    needed[:-1] |= needed[1:]
    return np.where(needed, suction / 1e3, np.nan)


def has_line(*suctions: np.ndarray) -> bool:
    """Return whether there is anything to draw of suctions [n]."""
    return any(np.isfinite(values).any() for values in suctions)


def color_of(name: str) -> str:
    """Return the color of a required suction by the name of its method."""
    return COLOR_OF.get(name.removesuffix(theory.ASSUMED_CONE), GREEN)


def draw_required(axes: Axes, answers: methods.Answers) -> None:
    """Draw the ranges of the required suction of the methods, in kPa, from where the
    weight no longer suffices."""
    for method in answers.required:
        color = color_of(method.name)
        low, high = (end / 1e3 for end in method.band)
        lines = [from_rest_on(values) for values in method.cases.values()]
        bounds = [from_rest_on(values) for values in method.bounds.values()]
        if has_line(*lines):
            label = f"required, {method.name}"
            style = {"facecolor": color, "alpha": 0.18, "linewidth": 0}
            axes.fill_betweenx(answers.depth, low, high, label=label, **style)
            for line, dashes in zip(lines, ("--", ":")):
                axes.plot(line, answers.depth, dashes, color=color, linewidth=0.8)
        for line in filter(has_line, bounds):
            label = f"required, {theory.LOWER_BOUND}"
            axes.plot(line, answers.depth, "-.", color=color, lw=0.6, label=label)


def draw_critical(axes: Axes, answers: methods.Answers) -> None:
    """Draw the critical suctions as thin lines of one color, in kPa."""
    for column, (name, line) in CRITICAL.items():
        values = answers.suctions.get(column, np.empty(0))
        if column == methods.PIPING or not has_line(values):
            continue
        axes.plot(
            values / 1e3,
            answers.depth,
            color=CRITICAL_COLOR,
            linewidth=0.9,
            linestyle=line,
            label=f"critical, {name}",
        )


def draw_rest(axes: Axes, history: Table, answers: methods.Answers) -> None:
    """Mark the penetrations by weight alone at zero suction."""
    marks = [(h, BLUE, answers.rest_by) for h in answers.rest.values()]
    computed = rest_of_run(history)
    if computed is not None:
        marks.append((computed, "black", "computed"))
    known = set()
    for h, color, name in marks:
        label = f"penetration by weight, {name}"
        axes.plot(
            0,
            h,
            marker=">",
            markersize=8,
            color=color,
            linestyle="none",
            clip_on=False,
            zorder=3,
            label=None if label in known else label,
        )
        known.add(label)


def allowable_of(run: Results, found: Table, depth: np.ndarray) -> np.ndarray:
    """Return the least of limits [n] where suction is needed (kPa), nan elsewhere."""
    needed = np.interp(depth, *columns_of(run.history, "required_suction_Pa")) > 0
    least = limits.least_of(found, len(depth))
    return np.where(needed & np.isfinite(least), least, np.nan)


def columns_of(history: Table, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Return depth and a column on the way down."""
    rows = way_down(history["penetration_m"])
    return history["penetration_m"][rows], history[name][rows]


def draw_limits(axes: Axes, run: Results, depth: np.ndarray, found: Table) -> list[str]:
    """Draw the limits of the suction [n] (kPa) at depths [n] (m), each by its factor,
    over their least; return those that are out of the range, in words."""
    factors, beyond = limits.factors_of(run), list[str]()
    for name, limit in found.items():
        label, known = limits.with_factor(name, factors[name]), limit[limit < np.inf]
        if name == limits.REVERSE_BEARING:
            tops = theory.soft_below(theory.site_of(run), depth)
            words = limits.soft_in_words(tops, run.shown)
            label = "\n".join(filter(None, (label, words)))
        if name == limits.LID:
            for h in depth[limit <= 0][:1]:
                color = limits.LIMITS[name].color
                axes.axhline(h, color=color, linewidth=1.2, label=label)
        elif np.nanmin(known) < axes.get_xlim()[1]:
            color = limits.LIMITS[name].color
            axes.plot(limit, depth, color=color, linewidth=1.2, label=label)
        else:
            ends = (np.nanmin(known), np.nanmax(known))
            texts = dict.fromkeys(f"{v:.0f}" for v in ends)
            beyond.append(f"{label} at {' to '.join(texts)} kPa")
    return beyond


def draw_suction(axes: Axes, run: Results, answers: methods.Answers) -> str:
    """Draw the suction of the run, of the methods, and its limits; return which limits
    are out of the range."""
    history = run.history
    depth, applied = history["penetration_m"], history["suction_Pa"] / 1e3
    required = np.maximum(history["required_suction_Pa"], 0) / 1e3
    at = np.linspace(max(depth[0], 0.0), depth.max(), 60)
    found = limits.limits_of(run, at)
    allowable = allowable_of(run, found, at)
    style = {"color": WIDE_COLOR, "linewidth": 6, "solid_capstyle": "butt"}
    if has_line(allowable):
        axes.plot(allowable, at, label=ALLOWABLE, **style)
    axes.plot(applied, depth, color="black", linewidth=1.8, label="applied, computed")
    axes.plot(
        required,
        depth,
        color="black",
        linewidth=0.5,
        alpha=0.5,
        label="required, computed",
    )
    band = error_band(run.error_bounds, "required_suction", "Pa")
    draw_error_bar(axes, band, 1e-3, "black", ERROR_BAR)
    lines = [applied[depth <= (depth_of(run) or np.inf)]]
    lines += soil_range.draw(axes, run, "required_suction_Pa", "required")
    draw_required(axes, answers)
    draw_critical(axes, answers)
    known = [*answers.suctions.values()]
    known += [s for method in answers.required for s in method.cases.values()]
    lines += [s / 1e3 for s in known if has_line(s)]
    most = max(np.nanmax(line, initial=1e-3) for line in [*lines, allowable])
    axes.set_xlim(-0.02 * most, 1.08 * most)
    beyond = draw_limits(axes, run, at, found)
    draw_rest(axes, history, answers)
    axes.set_xlabel("suction (kPa)")
    return f"Beyond the picture: {'; '.join(beyond)}." if beyond else ""


def draw_gradients(axes: Axes, run: Results) -> None:
    """Draw the exit gradients over the one at which soil has no weight."""
    history = run.history
    depth, critical = history["penetration_m"], history["critical_gradient"]
    for place, color, width in (("wall", "black", 1.8), ("axis", BLUE, 1.2)):
        gradient = history[f"exit_gradient_{place}"] / critical
        label = f"at the {'inner wall' if place == 'wall' else place}"
        axes.plot(gradient, depth, color=color, linewidth=width, label=label)
    band = error_band(run.error_bounds, "exit_gradient_axis")
    if band is not None:
        scale = 1 / np.interp(band[0], depth, critical)
        draw_error_bar(axes, band, scale, BLUE, f"at the axis, {ERROR_BAR}")
    axes.axvline(1, color=RED, linewidth=1.2, linestyle="--", label="no weight left")
    axes.set_xlim(left=-0.02)
    axes.set_xlabel("exit gradient / critical gradient")


def draw_heave(axes: Axes, run: Results) -> None:
    """Draw the heave of the plug and write the seepage at the end; what a pump takes
    besides depends on the rate of penetration, and a run is faster than a caisson."""
    history = run.history
    axes.plot(
        history["plug_heave_m"],
        history["penetration_m"],
        color="black",
        linewidth=1.8,
        label="mean over the plug",
    )
    band = error_band(run.error_bounds, "plug_heave", "m")
    draw_error_bar(axes, band, 1.0, "black", ERROR_BAR)
    axes.axvline(0, color="0.6", linewidth=0.8)
    if "seepage_flow_m3_s" in history:
        depth = history["penetration_m"]
        last = np.flatnonzero(depth <= (depth_of(run) or np.inf))[-1]
        flow = 3600 * history["seepage_flow_m3_s"][last]
        place = run.shown.depth(depth[last])
        text = f"seepage into the plug at {place}: {flow:.2g} m³/h"
        axes.text(0.04, 0.03, text, transform=axes.transAxes, fontsize=8, bbox=WHITE)
    axes.set_xlabel("heave of the plug (m)")


def ends_early(answers: methods.Answers, names: list[str], site: theory.Site) -> bool:
    """Return whether a method has no suction at a depth where it has forces."""
    known = answers.depth <= (site.cone.depth[-1] if site.cone else np.inf)
    lines = [answers.suctions[name] for name in names]
    return any(
        np.isnan(line[known] if "cone" in name else line).any()
        for name, line in zip(names, lines)
    )


def caption(answers: methods.Answers, site: theory.Site) -> str:
    """Return what the lines of the methods mean, or why there are none."""
    if not answers.suctions:
        return answers.words or f"no design methods: {answers.why_not}"
    known, assumed = answers.suctions, theory.assumptions_of(site.scene)
    required, cones = list(methods.CASES), methods.CONE_COLUMNS.values()
    by_cone = [column for columns in cones for column in columns]
    of_byrne = has_line(*[from_rest_on(known[name]) for name in required])
    words = theory.assumptions_in_words(site.scene) if of_byrne else ""
    with_cone = has_line(*[known[name] for name in by_cone])
    required += by_cone if with_cone else []
    deepest = None if answers.rest else answers.depth.max()
    ends = ends_early(answers, required, site)
    what = words, assumed.plug_permeability_ratio, with_cone, deepest, ends
    return "\n".join(text for _, text in say_rows(CAPTIONS, "suction", *what))


def draw(directory: Path, run: Results) -> list[Path]:
    """Write suction.png; return its path, none without a pump or without
    penetration."""
    history = run.history
    if "required_suction_Pa" not in history:
        return []
    depth = curves.penetration(history)
    if depth is None:
        print("plot: no penetration, so no suction.png")
        return []
    site, deepest = theory.site_of(run), max(depth.max(), 0)
    answers = methods.answers_of(site, np.linspace(0, deepest, 200))
    seeps = "critical_gradient" in history  # not in clay
    figure = Figure(figsize=(14 if seeps else 10, 7.5))
    panels = figure.subplots(1, 2 + seeps, width_ratios=[1.7, 1, 1][: 2 + seeps])
    figure.suptitle(run.title, fontsize=10)
    beyond = draw_suction(panels[0], run, answers)
    if seeps:
        draw_gradients(panels[1], run)
    draw_heave(panels[-1], run)
    for axes in panels:
        over_depth(axes, axes.get_xlabel(), "")
        axes.set_ylim(1.02 * max(depth.max(), 0), min(depth.min(), 0))
        fade(axes, depth_of(run))
        legend_below(axes, 2 if axes is panels[0] else 1)
    panels[0].set_ylabel("penetration of the skirt tip (m)")
    about = textwrap.fill(theory.about_cone(site, deepest), 200)
    text = "\n".join(filter(None, [beyond, caption(answers, site), about]))
    with_note(figure, text)
    picture = directory / "suction.png"
    in_units(figure, run.shown)
    return [disk.save(figure, picture)]
