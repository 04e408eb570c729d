# SPDX-License-Identifier: LGPL-2.1-or-later
"""Suction, exit gradient and heave of the plug over penetration, depth downward."""
import textwrap
from dataclasses import replace
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson import curves, disk
from caisson.evaluation import rest_of
from caisson.plot import charts
from caisson.plot.charts import BLUE, CAPTIONS, RED, bars, line
from caisson.plot.small import fade, in_units, legend_below, over_depth, with_note
from caisson.results import Results
from caisson.template import number, say, say_rows
from caisson.verdict import suction_methods as methods, theory
from caisson.verdict.installation import Installation, Rate, installation_of
from caisson.verdict.outcome import depth_of, feasible_to

WHITE = {"facecolor": "white", "edgecolor": "0.8"}  # behind a text


def draw_rest(axes: Axes, run: Results, answers: methods.Answers) -> None:
    """Mark the penetrations by weight alone at zero suction."""
    marks = {answers.rest_by: (BLUE, list(answers.rest.values()))}
    if (computed := rest_of(run)) is not None:
        marks["computed"] = "black", [computed]
    for name, (color, places) in marks.items():
        style = {"color": color, "markersize": 8, "clip_on": False, "zorder": 3}
        label = f"penetration by weight, {name}" if places else None
        axes.plot(np.zeros(len(places)), places, ">", label=label, **style)


def draw_suction(
    axes: Axes, run: Results, found: Installation | None, answers: methods.Answers
) -> str:
    """Draw the curves of the page, and the suction that acts; return which limits are
    out of the range."""
    history, end = run.history, depth_of(run)
    # draw_rest() marks where the caisson rests
    found = replace(found, rest=None) if found and found.has_suction else None
    shown = charts.suction_curves(run, found, end, answers)
    applied = history["suction_Pa"] / 1e3
    shown.append(line("applied, computed", "black", applied, history["penetration_m"]))
    most, beyond = charts.axis_end(shown) or 1e-3, charts.limits_beyond(found, shown)
    seen = (x for x in shown if any([*x["x"], *x.get("to", [])]))  # not those of 0
    charts.draw(axes, [x for x in seen if x["label"] not in beyond])
    axes.set_xlim(-0.02 * most, most)
    draw_rest(axes, run, answers)
    axes.set_xlabel("suction (kPa)")
    bottom = float(history["penetration_m"].max())
    return charts.beyond_the_chart(found, shown, bottom) if found else ""


def draw_gradients(axes: Axes, run: Results) -> None:
    """Draw the exit gradients over the one at which soil has no weight."""
    history = run.history
    depth, critical = history["penetration_m"], history["critical_gradient"]
    for place, color, width in (("wall", "black", 1.8), ("axis", BLUE, 1.2)):
        gradient = history[f"exit_gradient_{place}"] / critical
        label = f"at the {'inner wall' if place == 'wall' else place}"
        axes.plot(gradient, depth, color=color, linewidth=width, label=label)

    def share(at: np.ndarray) -> np.ndarray:
        return 1 / np.interp(at, depth, critical)

    curve = "at the axis", BLUE
    charts.draw(axes, bars(run, ("exit_gradient_axis", ""), curve, scale=share))
    axes.axvline(1, color=RED, linewidth=1.2, linestyle="--", label="no weight left")
    axes.set_xlim(left=-0.02)
    axes.set_xlabel("exit gradient / critical gradient")


def draw_heave(axes: Axes, run: Results, found: Installation | None) -> None:
    """Draw the heave of the plug, and the one expected where it is more, and write the
    seepage at the end; what a pump takes besides depends on the rate of penetration,
    and a run is faster than a caisson."""
    history, depth = run.history, run.history["penetration_m"]
    name, color = curve = "mean over the plug", "black"
    heave = line(name, color, history["plug_heave_m"], depth, thick=True)
    bar = bars(run, ("plug_heave", "m"), curve, scale=np.ones_like)
    more = []
    if found and found.expects_more:
        label = "half of the wall by weight, all of it under suction"
        more = [line(label, RED, found.expected, found.depth)]
    charts.draw(axes, [heave, *bar, *more])
    axes.axvline(0, color="0.6", linewidth=0.8)
    if "seepage_flow_m3_s" in history:
        last = np.flatnonzero(depth <= feasible_to(run))[-1]
        flow = 3600 * history["seepage_flow_m3_s"][last]
        place = run.shown.depth(depth[last])
        text = f"seepage into the plug at {place}: {number(flow, 2)} m³/h"
        axes.text(0.04, 0.03, text, transform=axes.transAxes, fontsize=8, bbox=WHITE)
    axes.set_xlabel("heave of the plug (m)")


def caption(answers: methods.Answers, site: theory.Site) -> str:
    """Return what the lines of the methods mean, or why there are none."""
    if clay := answers.in_clay:
        return say(CAPTIONS, "in_clay", clay.name, *clay.cases)
    if not answers.suctions:
        return f"no design methods: {answers.why_not}"
    assumed = theory.assumptions_of(site.scene)
    byrne, *by_cone = answers.every
    of_byrne = [*byrne.cases.values(), *byrne.bounds.values()]
    has_byrne = any(np.nan_to_num(x).any() for x in of_byrne)
    words = theory.assumptions_in_words(site.scene) if has_byrne else ""
    with_cone = any(method.is_known for method in by_cone)
    reached = answers.depth <= (site.cone.depth[-1] if site.cone else np.inf)
    cases = [x[reached] for method in by_cone for x in method.cases.values()]
    ends = any(np.isnan(x).any() for x in of_byrne + cases * with_cone)
    deepest = None if answers.rest else answers.depth.max()
    what = words, assumed.plug_permeability_ratio, with_cone, deepest, ends
    return "\n".join(text for _, text in say_rows(CAPTIONS, "suction", *what))


def draw(directory: Path, run: Results) -> list[Path]:
    """Write suction.png; return its path, none without a pump or without
    penetration."""
    history = run.history
    if not charts.has_suction(run):
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
    at = np.linspace(max(float(depth[0]), 0.0), deepest, 60)
    found = installation_of(run, Rate(), at)
    beyond = draw_suction(panels[0], run, found, answers)
    if seeps:
        draw_gradients(panels[1], run)
    draw_heave(panels[-1], run, found)
    for axes in panels:
        over_depth(axes, axes.get_xlabel(), "")
        axes.set_ylim(1.02 * max(depth.max(), 0), min(depth.min(), 0))
        fade(axes, depth_of(run))
        legend_below(axes, 2 if axes is panels[0] else 1)
    panels[0].set_ylabel("penetration of the skirt tip (m)")
    about = theory.about_cone(site, deepest)
    texts = [beyond, *caption(answers, site).splitlines(), about]
    with_note(figure, "\n".join(textwrap.fill(x, 200) for x in texts if x))
    in_units(figure, run.shown)
    return [disk.save(figure, directory / "suction.png")]
