# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of a study of parameters: fan.png and tornado.png."""
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.uncertain import effects
from caisson.uncertain.effects import Effect
from caisson.uncertain.entry import text_of
from caisson.uncertain.outcome import Outcome, Outcomes, title_of, unit_of, words_of
from caisson.uncertain.sampling import BASE, LATIN, ONE
from caisson import disk
from caisson.plot.small import over_depth, with_note, write_beside

BLUE, RED = "#2166ac", "#c0392b"
STYLES = ("-", "--", ":", "-.")
MANY = 12  # curves that a legend can name
NO_BAR = "without the error of mesh and method: the scene names no error bar"
BAR = "error bar of the scene: mesh and method"


def draw_quantiles(axes: Axes, outcomes: Outcomes, scale: float) -> np.ndarray | None:
    """Draw bands between quantiles over the curves they come from; return the median
    [n_grid]."""
    matrix = outcomes.matrix(outcomes.grid) * scale
    for curve in matrix:
        axes.plot(curve, outcomes.grid, color="0.8", linewidth=0.5, zorder=1)
    if len(matrix) == 0:
        return None
    names, found = effects.spread(matrix)
    for outer, alpha in ((0, 0.22), (1, 0.35)):
        last = len(names) - 1 - outer
        style = {"color": BLUE, "alpha": alpha, "linewidth": 0, "zorder": 2}
        label = f"{names[outer]} to {names[last]}"
        axes.fill_betweenx(
            outcomes.grid, found[outer], found[last], label=label, **style
        )
    middle: np.ndarray = found[len(names) // 2]
    axes.plot(middle, outcomes.grid, color="black", linewidth=1.8, label="median")
    return middle


# the curve of a run and its style; its label is None where another one has it
Line = tuple[Outcome, dict[str, Any]]


def lines_of_grid(outcomes: Outcomes) -> tuple[str, list[Line]]:
    """Return the title of the legend and the lines of a grid or a list, dark to light
    by the values of the parameter that matters most."""
    runs, parameter = outcomes.complete, outcomes.free[0]
    if len(outcomes.free) > 1:
        _, found = effects.effects_of(outcomes, outcomes.tornado_depth())
        parameter = found[0].parameter if found else parameter
    values = {run.sample[parameter.name] for run in runs}
    ordered = sorted(values, key=lambda value: effects.order(parameter, value))
    colors = dict(zip(ordered, colormaps["viridis"](np.linspace(0, 0.8, len(values)))))
    lines = list[Line]()
    for value in ordered:
        of_value = [run for run in runs if run.sample[parameter.name] == value]
        for run, label in zip(of_value, [text_of(value), *[None] * len(of_value)]):
            lines.append((run, {"color": colors[value], "label": label}))
    return parameter.label, lines


def lines_of_one(outcomes: Outcomes) -> tuple[str, list[Line]]:
    """Return the title of the legend and the lines where one parameter changes at a
    time: a color for each, and a style for each of its values."""
    base, lines = outcomes.all[0].sample, list[Line]()
    for color, parameter in enumerate(outcomes.free):
        name = parameter.name
        runs = [r for r in outcomes.complete if r.sample[name] != base[name]]
        runs.sort(key=lambda r: effects.order(parameter, r.sample[name]))
        for i, run in enumerate(runs):
            label: str | None = f"{parameter.label} {text_of(run.sample[name])}"
            style = STYLES[i % len(STYLES)]
            if len(outcomes.all) > MANY:
                label, style = None if i else parameter.label, "-"
            how: dict[str, Any] = {"color": f"C{color % 10}", "linestyle": style}
            how["label"] = label
            lines.append((run, how))
    if outcomes.all[0].is_complete:
        how = {"color": "black", "label": BASE, "linewidth": 2}
        lines.append((outcomes.all[0], how))
    return "", lines


def draw_curves(axes: Axes, outcomes: Outcomes, scale: float) -> np.ndarray | None:
    """Draw the curves of a list or a grid; return that of the base, or the one in the
    middle, [n_grid]."""
    is_one = outcomes.sampling == ONE
    title, lines = (lines_of_one if is_one else lines_of_grid)(outcomes)
    drawn = []
    for outcome, how in lines:
        drawn.append(outcomes.values(outcome, outcomes.grid) * scale)
        axes.plot(drawn[-1], outcomes.grid, **{"linewidth": 1.3, **how})
    axes.legend(title=title)  # the title is kept when the legend is made again
    return drawn[-1 if is_one else len(drawn) // 2] if drawn else None


def draw_error(
    axes: Axes, outcomes: Outcomes, middle: np.ndarray | None, scale: float
) -> str:
    """Draw the error bar of the scene on a curve at the depths of the table; return
    what the caption says of it."""
    if middle is None:
        return NO_BAR
    values = np.interp(outcomes.depths, outcomes.grid, middle / scale)
    error = outcomes.error(outcomes.depths, values)
    if error is None:
        return NO_BAR
    style = {"fmt": "none", "ecolor": "black", "capsize": 3, "linewidth": 1}
    at = values * scale, outcomes.depths
    axes.errorbar(*at, xerr=error * scale, zorder=4, label=BAR, **style)
    return "the error bar is that of the scene with its own entries"


def caption(outcomes: Outcomes, text: str) -> str:
    """Return what the runs are, and what is left out."""
    complete, n = len(outcomes.complete), len(outcomes.all)
    words = [f"{complete} runs" if complete == n else f"{complete} of {n} runs"]
    if len(outcomes.free) > 1 or outcomes.sampling == LATIN:
        words[0] += f", {outcomes.sampling}"
    if complete < n:
        words[0] += f"; failed or missing: {n - complete}"
    if outcomes.sampling == LATIN and complete:
        whole = np.isfinite(outcomes.matrix(outcomes.grid)).all(axis=0)
        if not whole.all() and whole.any():
            last = outcomes.grid[whole].max()
            words.append(f"quantiles as far as all runs reach, {last:.4g} m")
    if doubtful := [run.name for run in outcomes.all if run.warnings]:
        names = "; ".join(doubtful)
        if len(names) > 60:
            names = f"{len(doubtful)} of {n} runs"
        words.append(f"with a warning about the result, see table.csv: {names}")
    return "\n".join([*words, text])


def draw_fan(path: Path, outcomes: Outcomes) -> Path:
    """Write what is observed over depth, of all runs."""
    _, scale = unit_of(outcomes.column)
    figure = Figure(figsize=(7.5, 7.5))
    axes = figure.subplots()
    is_latin = outcomes.sampling == LATIN
    middle = (draw_quantiles if is_latin else draw_curves)(axes, outcomes, scale)
    reference = outcomes.reference
    if reference is not None and reference.is_complete:
        values = outcomes.values(reference, outcomes.grid) * scale
        style = {"color": RED, "linewidth": 1.3, "linestyle": "--"}
        axes.plot(values, outcomes.grid, label="the scene as it is", **style)
    text = draw_error(axes, outcomes, middle, scale)
    old = axes.get_legend()
    title = old.get_title().get_text() if old is not None else ""
    axes.legend(fontsize=8, framealpha=0.9, title=title, title_fontsize=8)
    axes.invert_yaxis()
    over_depth(axes, title_of(outcomes.column), "penetration (m)")
    figure.suptitle(outcomes.study.title, fontsize=11)
    with_note(figure, caption(outcomes, text))
    return disk.save(figure, path)


def draw_correlations(axes: Axes, found: list[Effect], n: int) -> None:
    """Draw the rank correlations of n runs, the largest on top."""
    for i, effect in enumerate(found):
        color = RED if effect.high > 0 else BLUE
        axes.barh(i, effect.high, color=color, height=0.6)
        side = 1 if effect.high >= 0 else -1
        write_beside(axes, f"{effect.high:+.2f}", (effect.high, i), side, fontsize=9)
    limit = effects.chance(n)
    axes.axvspan(-limit, limit, color="0.85", zorder=0, label="range of chance (95 %)")
    axes.set_xlim(-1.18, 1.18)
    axes.set_xlabel("rank correlation (Spearman)")


def draw_swings(axes: Axes, found: list[Effect], base: float, scale: float) -> None:
    """Draw the results at both ends of each parameter, with its values there."""
    shown = set()
    for i, effect in enumerate(found):
        ends = zip(
            (effect.low, effect.high), effect.ends, (not effect.rises, effect.rises)
        )
        for result, value, is_larger in ends:
            name = f"{'larger' if is_larger else 'smaller'} value"
            color, label = RED if is_larger else BLUE, None if name in shown else name
            style = {"left": base * scale, "height": 0.6, "color": color}
            axes.barh(i, (result - base) * scale, label=label, **style)
            shown.add(name)
            side = -1 if result == effect.low else 1
            at = (result * scale, i)
            write_beside(axes, text_of(value), at, side, fontsize=9)
    results = np.array([(e.low, e.high) for e in found]).ravel() * scale
    span = max(float(np.ptp([*results, base * scale])), 1e-9)
    low, high = min(*results, base * scale), max(*results, base * scale)
    axes.set_xlim(low - 0.2 * span, high + 0.2 * span)
    axes.axvline(base * scale, color="black", linewidth=1)
    axes.ticklabel_format(axis="x", style="plain", useOffset=False)


def draw_tornado(path: Path, outcomes: Outcomes, depth: float | None) -> Path | None:
    """Write the effects of several parameters at a depth (m); return the path, None
    where there are none."""
    base, found = effects.effects_of(outcomes, depth)
    if depth is None or len(found) < 2:
        return None
    found = found[::-1]  # the largest on top
    _, scale = unit_of(outcomes.column)
    figure = Figure(figsize=(8, 2.6 + 0.5 * len(found)))
    axes = figure.subplots()
    notes = [f"{len(outcomes.complete)} runs, {outcomes.sampling}"]
    if outcomes.sampling == LATIN:
        draw_correlations(axes, found, len(outcomes.complete))
    else:
        draw_swings(axes, found, base, scale)
        axes.set_xlabel(title_of(outcomes.column))
        error = outcomes.error(np.array([depth]), np.array([base]))
        if error is not None and np.isfinite(error).all():
            ends = (base - error[0, 0]) * scale, (base + error[1, 0]) * scale
            axes.axvspan(*ends, color="0.85", zorder=0, label=BAR)
        line = "base" if outcomes.sampling == ONE else "mean of all runs"
        notes[0] += f"; black line: {line}; numbers: values of the parameter"
        notes += [NO_BAR] if error is None else []
    axes.set_yticks(range(len(found)), [effect.parameter.label for effect in found])
    axes.grid(color="0.9", axis="x")
    axes.set_axisbelow(True)
    title = f"{outcomes.study.title}\n{words_of(outcomes.column)} at {depth:.4g} m"
    figure.suptitle(title, fontsize=11)
    axes.legend(
        fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1), ncol=3, frameon=False
    )
    with_note(figure, "\n".join(notes))
    return disk.save(figure, path)
