# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section of scripts/speed on meshes: error of the tip force against time
of graded and uniform meshes."""
import numpy as np

from speed_report import Report, panels
from speed_runs import ROOT, Run

SCENE = ROOT / "tests/jack.prm"
WALL = 0.2  # m
START = 0.5  # m of penetration
PARTS = np.array([.3, .5, .7, .9])  # of the way, where forces are compared
KINDS = {
    "graded": lambda h: {},
    "graded, points split and merge":
        lambda h: {"Material points/Split and merge": "true"},
    "uniform": lambda h: {"Grid/Cell width": h, "Grid/Cell height": h,
                          "Grid/Growth ratio": 1.001,
                          "Material points/Per direction near": 3,
                          "Material points/Per direction far": 3}}


def mesh_run(kind, across, end):
    entries = {"Rigid body/Cells across the wall": across,
               "Time/End penetration": end, "Output/Record interval": 0.05,
               **KINDS[kind](WALL / across)}
    return Run(f"{kind}, t/{across}", entries, scene=SCENE)


def tip_forces(result):
    """Means over a fifth of the way."""
    h = result.history
    way = h["penetration_m"][-1] - START
    return np.array([h["tip_force_N"][abs(h["penetration_m"] - START
                                          - part * way) <= .1 * way].mean()
                     for part in PARTS])


def power_law(points):
    """Slope and constant of log time over log error, by least squares."""
    seconds, errors = zip(*points)
    return np.polyfit(np.log(errors), np.log(seconds), 1)


def ratio_at_equal_error(a, b):
    """The time of a over that of b at the error in the middle of what both
    reach, from the power laws through both; and this error."""
    low = max(min(e for _, e in a), min(e for _, e in b))
    high = min(max(e for _, e in a), max(e for _, e in b))
    error = np.sqrt(low * high)
    log_time = [np.polyval(power_law(x), np.log(error)) for x in (a, b)]
    return float(np.exp(log_time[0] - log_time[1])), float(error)


def draw(curves):
    figure, (axes,) = panels(1, width=7, height=4.6)
    for (kind, points), style in zip(curves.items(), ("o-", "^-", "s--")):
        axes.loglog(*zip(*[(s, e) for s, e, _ in points]), style, label=kind)
        for seconds, error, across in points:
            axes.annotate(f"t/{across}", (seconds, error), fontsize=8,
                          xytext=(5, 4), textcoords="offset points")
    axes.set_xlabel("time of all steps on one core (s)")
    axes.set_ylabel("relative error of the tip force")
    axes.legend(fontsize=8)
    return figure


def whole_caisson(quick):
    """Points and milliseconds per step of prm/jack.prm, graded and uniform."""
    fine = 0.05
    uniform = {**KINDS["uniform"](fine), "Output/Record interval": 100}
    if quick:
        uniform["Grid/Outer radius"] = 4
    return [[kind, result.points, 1e3 * result.seconds_per_step()]
            for kind, result in
            (("graded", Run("jack, graded", {"Output/Record interval": 100},
                            seconds=2).execute()),
             ("uniform", Run("jack, uniform", uniform,
                             seconds=2 if quick else 10).execute()))]


def measure_refinement(options):
    report = Report("refinement", "Refinement")
    end = 0.55 if options.quick else 1.
    meshes = [2, 4] if options.quick else [2, 4, 6]
    finest = meshes[-1] + 2
    reference = tip_forces(mesh_run("graded", finest, end).execute())
    curves, rows = {}, []
    for kind in KINDS:
        curves[kind] = []
        for across in meshes:
            result = mesh_run(kind, across, end).execute()
            error = float(np.sqrt(np.mean(
                (tip_forces(result) / reference - 1) ** 2)))
            curves[kind].append((result.seconds(), error, across))
            rows.append([kind, f"t/{across}", result.points, result.steps,
                         result.seconds(), 100 * error])
            print(*rows[-1], flush=True)
    report.say(f"The caisson of `tests/jack.prm` (wall t = {WALL} m, "
               f"domain 7 m x 5 m), pushed from {START} to {end} m. Uniform: "
               "cells of one size and 3 x 3 points in each, in the same "
               "domain. Error: rms over four parts of the way, of the tip "
               "forces averaged over a fifth of it, against the graded mesh "
               f"t/{finest}. One run each; the forces scatter by some percent.")
    report.table("refinement", ["mesh", "cells", "points", "steps",
                                "seconds of all steps", "error (%)"], rows)
    report.picture(draw(curves), "Error against time of the meshes")
    short = {k: [(s, e) for s, e, _ in c] for k, c in curves.items()}
    ratios = []
    for kind in list(KINDS)[1:]:
        ratio, error = ratio_at_equal_error(short[kind], short["graded"])
        ratios.append([f"{kind} / graded"]
                      + [a[0] / b[0]
                         for a, b in zip(short[kind], short["graded"])]
                      + [ratio, 100 * error])
    report.say("Time over that of the graded mesh, with equal cells, and at "
               "equal error (power laws through each curve, in the middle of "
               "the errors that both reach):")
    report.table("refinement_ratios",
                 ["meshes"] + [f"at t/{across}" for across in meshes]
                 + ["at equal error", "error (%)"], ratios)
    report.say("The whole installation, `prm/jack.prm` with two cells across the "
               "wall, with uniform cells of "
               "0.05 m and 3 x 3 points would cost per step, of which there are "
               "about as many:")
    report.table("refinement_jack", ["mesh", "points", "ms per step"],
                 whole_caisson(options.quick))
    report.write()
