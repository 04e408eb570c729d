# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of a study beside the design methods: methods.csv and methods.png.

Each method answers for the soil of each run, so that a band goes from the smallest to
the largest of both cases in all runs.
"""
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.parameters.effects import order
from caisson.parameters.entry import text_of
from caisson.parameters.outcome import DEPTH, Outcome, Outcomes, values_at
from caisson.verdict import design, theory
from caisson.plot.small import over_depth, with_note, write_beside
from caisson.table import write_columns
from caisson import disk

TOTAL = "total_force_N"
INTERVAL = 0.1  # m
FEW = 5  # runs that a legend names one by one
STEPS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)  # m, between depths at which methods are shown
MOST_BARS = 7
SPREAD = 0.5  # of the bars about their depth, over the least distance of depths
WIDEST = 1.5  # of the axis, over the largest computed force


class Answers(NamedTuple):
    """What runs and methods say: the runs, embedments [n_depths] (m), the total force
    of each run [n_runs, n_depths] (N), and the answers of each run."""

    runs: list[Outcome]
    names: list[str]
    depth: np.ndarray
    computed: np.ndarray
    answers: list[list[theory.Answer]]

    def band(self, method: int) -> tuple[np.ndarray, np.ndarray] | None:
        """Return smallest and largest total force [n_depths] by a method, None where
        it has no answer."""
        forces = [
            force
            for of_run in self.answers
            if of_run[method].forces
            for force in of_run[method].band("total")
        ]
        if not forces:
            return None
        table = np.array(forces)
        known = np.isfinite(table).all(axis=0)
        if not known.any():
            return None
        table[:, ~known] = math.nan
        return table.min(axis=0), table.max(axis=0)


def answers_of(outcomes: Outcomes) -> Answers:
    """Return what the complete runs and the methods say at common depths. Raises
    ResultsError where a cone test of a run cannot be read."""
    runs = list(outcomes.complete)
    if len(outcomes.free) == 1:
        parameter = outcomes.free[0]
        runs.sort(key=lambda run: order(parameter, run.sample[parameter.name]))
        names = [text_of(run.sample[parameter.name]) for run in runs]
    else:
        names = [run.name for run in runs]
    histories = [run.history for run in runs if run.history is not None]
    deepest = max(float(history[DEPTH].max()) for history in histories)
    depth = np.arange(int(deepest / INTERVAL + 1e-6) + 1) * INTERVAL
    if deepest - depth[-1] > 1e-6:  # a short way may lie between two of them
        depth = np.append(depth, deepest)
    computed = np.array([values_at(history, TOTAL, depth) for history in histories])
    sites = [theory.site_of(run.run.results) for run in runs]
    answers = [theory.answers_of(site, depth) for site in sites]
    return Answers(runs, names, depth, computed, answers)


def write(path: Path, found: Answers) -> Path:
    """Write the total force (N) of each run, and by each case of each method with the
    soil of each run, at each 0.1 m
    and the last depth; cells without an answer are empty."""
    columns: dict[str, np.ndarray] = {DEPTH: found.depth}
    for name, force in zip(found.names, found.computed):
        columns[f"{TOTAL} [{name}]"] = force
    for i in range(len(theory.METHODS)):
        for name, of_run in zip(found.names, found.answers):
            for case, parts in of_run[i].forces.items():
                head = design.column_of(of_run[i], case, "total")
                columns[f"{head} [{name}]"] = parts["total"]
    return write_columns(path, columns)


def depths_of_bars(deepest: float) -> np.ndarray:
    """Return the depths (m) at which methods are shown: round ones, and the last."""
    step = next((s for s in STEPS if deepest / s <= MOST_BARS), STEPS[-1])
    round_ones = np.arange(1, int(deepest / step + 1e-6) + 1) * step
    return np.append(round_ones[round_ones < deepest - step / 2], deepest)


def draw_methods(axes: Axes, found: Answers, limit: float) -> None:
    """Draw the range of each method as a bar at some depths, side by side about them;
    of what goes beyond the axis (kN) the end is written."""
    depths = depths_of_bars(float(found.depth[-1]))
    methods = [i for i in range(len(theory.METHODS)) if found.band(i) is not None]
    spread = SPREAD * float(np.diff([0.0, *depths]).min())
    for depth in depths:
        around = depth - spread / 2, depth + spread / 2
        axes.axhspan(*around, color="0.95", linewidth=0, zorder=0)
        axes.axhline(depth, color="0.6", linewidth=0.8, zorder=1)
    axes.set_ylim(depths[-1] + 0.55 * spread, 0)
    for place, i in enumerate(methods):
        band, method = found.band(i), theory.METHODS[i]
        assert band is not None
        low, high = (np.interp(depths, found.depth, end) / 1e3 for end in band)
        where = depths + spread * ((place + 0.5) / len(methods) - 0.5)
        ends = np.minimum(high, limit)
        axes.errorbar(
            (low + ends) / 2,
            where,
            xerr=np.maximum(ends - low, 0) / 2,
            fmt="none",
            ecolor=method.color,
            elinewidth=2.4,
            capsize=3.5,
            capthick=2.0,
            label=f"{method.name}: {' to '.join(method.cases)}",
            zorder=3,
        )
        for y, end in zip(where[high > limit], high[high > limit]):
            style = {"fontsize": 7, "color": method.color, "zorder": 5}
            box = {"color": "white", "pad": 0.5}
            write_beside(axes, f"to {end:,.0f} >", (limit, y), -1, bbox=box, **style)


def draw_runs(axes: Axes, found: Answers) -> None:
    """Draw the total force of each run."""
    n = len(found.runs)
    shades = colormaps["viridis"](np.linspace(0, 0.8, n)) if n > FEW else None
    styles = ("--", "-", ":") if n == 3 else ("-",) * n
    for k, (name, force) in enumerate(zip(found.names, found.computed)):
        is_middle = n == 3 and k == 1
        axes.plot(
            force / 1e3,
            found.depth,
            color="black" if shades is None else shades[k],
            linestyle=styles[k],
            linewidth=2.4 if is_middle else 1.6,
            label=f"computed, {name}" if n <= FEW else None,
            zorder=4,
        )


def draw(path: Path, found: Answers, outcomes: Outcomes) -> Path:
    """Write the picture."""
    figure = Figure(figsize=(8.5, 8.5))
    axes = figure.subplots()
    largest = float(found.computed[np.isfinite(found.computed)].max()) / 1e3
    bands = [found.band(i) for i in range(len(theory.METHODS))]
    tops = [float(np.nanmax(band[1])) / 1e3 for band in bands if band is not None]
    limit = 1.05 * max(largest, min(max(tops, default=0.0), WIDEST * largest))
    axes.set_xlim(0, limit)
    draw_methods(axes, found, limit)
    draw_runs(axes, found)
    over_depth(axes, "Total force (kN)", "Penetration of the skirt tip (m)", "x")
    axes.legend(fontsize=8, framealpha=0.9, loc="upper right")
    figure.suptitle(outcomes.study.title, fontsize=11)
    note = "bars, beside the line of their depth: both cases with the soil of all runs"
    byrne = theory.assumptions_in_words(found.runs[0].run.results.scene)
    if found.band(0) is None:
        byrne = ""
    reasons = theory.reasons_in_words(found.answers[0])
    with_note(figure, "\n".join(filter(None, [note, byrne, reasons])))
    return disk.save(figure, path)
