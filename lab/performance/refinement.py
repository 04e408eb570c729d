# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section of the report on speed on meshes: error of the tip force against time
of graded meshes, of those with halved cells, and of uniform ones."""
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from caisson import curves
from caisson.study import Study
from lab.curves import relative_error
from lab.performance.report import Report, panels
from lab.performance.timed import Measured, execute

WALL = 0.2  # m
START = 0.5  # m of penetration
PARTS = np.array([0.3, 0.5, 0.7, 0.9])  # of the way, where forces are compared

Curve = list[tuple[float, float, str]]  # time (s), error, mesh


def tip_forces(result: Measured) -> np.ndarray:
    """Return the means over a fifth of the way: [n_parts]."""
    depth = result.history["penetration_m"]
    way = depth[-1] - START
    tip = result.history["tip_force_N"]
    return curves.window_means(depth, tip, START + PARTS * way, 0.2 * way)


def power_law(curve: Curve) -> np.ndarray:
    """Return slope and constant of log time over log error, by least squares."""
    seconds, errors, _ = zip(*curve)
    return np.polyfit(np.log(errors), np.log(seconds), 1)


def ratio_at_equal_error(a: Curve, b: Curve) -> tuple[float, float]:
    """Return the time of a over that of b at the error in the middle of what both
    reach, from the power laws through both; and this error."""
    low = max(min(e for _, e, _ in a), min(e for _, e, _ in b))
    high = min(max(e for _, e, _ in a), max(e for _, e, _ in b))
    error = np.sqrt(low * high)
    log_time = [np.polyval(power_law(x), np.log(error)) for x in (a, b)]
    return float(np.exp(log_time[0] - log_time[1])), float(error)


def draw(by_kind: dict[str, Curve]) -> Figure:
    """Draw error against time, a line for each kind of mesh."""
    figure, (axes,) = panels(1, width=7, height=4.6)
    for (kind, curve), style in zip(by_kind.items(), ("o-", "^-", "d-", "s--")):
        axes.loglog([p[0] for p in curve], [p[1] for p in curve], style, label=kind)
        for seconds, error, mesh in curve:
            place = {"xytext": (5, 4), "textcoords": "offset points"}
            axes.annotate(mesh, (seconds, error), fontsize=8, **place)
    axes.set_xlabel("time of all steps on one core (s)")
    axes.set_ylabel("relative error of the tip force")
    axes.legend(fontsize=8)
    return figure


def curves_of(study: Study) -> tuple[dict[str, Curve], list[list[Any]]]:
    """Return error and time of all meshes by kind, and the rows of the table."""
    reference = tip_forces(execute(study.run("reference")))
    by_kind: dict[str, Curve] = {}
    rows = []
    for run in study.runs:
        if run.name == "reference":
            continue
        kind, mesh = run.name.rsplit(", ", 1)
        result = execute(run)
        error = relative_error(tip_forces(result), reference)
        by_kind.setdefault(kind, []).append((result.seconds(), error, mesh))
        seconds, percent = result.seconds(), 100 * error
        rows.append([kind, mesh, result.points, result.steps, seconds, percent])
        print(*rows[-1], flush=True)
    return by_kind, rows


def ratios(by_kind: dict[str, Curve]) -> list[list[Any]]:
    """Return the times over those of the first kind: mesh by mesh, and at equal
    error (%)."""
    (first, base), *others = by_kind.items()
    rows = []
    for kind, curve in others:
        equal_cells = [a[0] / b[0] for a, b in zip(curve, base)]
        ratio, error = ratio_at_equal_error(curve, base)
        rows.append([f"{kind} / {first}", *equal_cells, ratio, 100 * error])
    return rows


def measure_refinement(studies: dict[str, Study], report: Report) -> None:
    """Measure graded meshes, those with halved cells, and uniform ones."""
    study = studies["refinement"]
    end = study.run("reference").run.entries["Time/End penetration"]
    across = study.run("reference").run.entries["Rigid body/Cells across the wall"]
    by_kind, rows = curves_of(study)
    report.say(
        f"The caisson of `tests/simulation/jack.prm` (wall t = {WALL} m, domain 7 m x"
        f" 5 m), pushed from {START} to {end} m. Halved at the tip: lines are wider"
        " apart, cells around the tip are halved once or twice, and points split and"
        " merge. Uniform: cells of one size and 3 x 3 points in each, in the same"
        " domain. Error: rms over four parts of the way, of the tip forces averaged"
        f" over a fifth of it, against the graded mesh t/{across}. One run each; the"
        " forces scatter by some percent."
    )
    heads = "mesh,cells,points,steps,seconds of all steps,error (%)".split(",")
    report.table("refinement", heads, rows)
    report.picture(draw(by_kind), "Error against time of the meshes")
    report.say(
        "Time over that of the graded mesh, with equal cells, and at equal error (power"
        " laws through each curve, in the middle of the errors that both reach):"
    )
    meshes = [mesh for _, _, mesh in next(iter(by_kind.values()))]
    heads = [
        "meshes",
        *[f"at {mesh}" for mesh in meshes],
        "at equal error",
        "error (%)",
    ]
    report.table("refinement_ratios", heads, ratios(by_kind))
    if "refinement_whole" in studies:
        say_whole(studies["refinement_whole"], report)


def say_whole(study: Study, report: Report) -> None:
    """Tell the cost of a step of the whole installation, graded and uniform."""
    report.say(
        "The whole installation, `prm/jack.prm` with two cells across the wall, with"
        " uniform cells of 0.05 m and 3 x 3 points would cost per step, of which there"
        " are about as many:"
    )
    results = [(run.name, execute(run)) for run in study.runs]
    rows = [[name, r.points, 1e3 * r.seconds_per_step()] for name, r in results]
    report.table("refinement_jack", ["mesh", "points", "ms per step"], rows)
