# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section of scripts/speed on meshes: error of the tip force against time of
graded and uniform meshes."""
import numpy as np

from speed_report import Report, panels
from speed_runs import ROOT, Run, knows_entry

SCENE = ROOT / "tests/jack.prm"
WALL = 0.2  # m
END = 1.    # m of penetration
WINDOW = 0.1
DEPTHS = [0.65, 0.75, 0.85, 0.95]
SPLIT = "Split and merge"
KINDS = {
    "graded": lambda h: {},
    "graded, points split and merge":
        lambda h: {f"Material points/{SPLIT}": "true"},
    "uniform": lambda h: {"Grid/Cell width": h, "Grid/Cell height": h,
                          "Grid/Growth ratio": 1.001,
                          "Material points/Per direction near": 3,
                          "Material points/Per direction far": 3}}


def mesh_run(kind, across, end):
    return Run(f"{kind}, t/{across}", {
        "Rigid body/Cells across the wall": across,
        "Time/End penetration": end, "Output/Record interval": 0.05,
        **KINDS[kind](WALL / across)}, scene=SCENE)


def tip_forces(result):
    h = result.history
    return np.array([h["tip_force_N"][abs(h["penetration_m"] - depth)
                                      <= WINDOW / 2 + 1e-9].mean()
                     for depth in DEPTHS
                     if depth <= h["penetration_m"][-1] + WINDOW / 2])


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
    end = 0.7 if options.quick else END
    meshes = {"graded": [2, 3] if options.quick else [2, 3, 4, 6],
              "uniform": [1, 2] if options.quick else [2, 3, 4]}
    finest = 4 if options.quick else 8
    kinds = [kind for kind in KINDS if "split" not in kind or
             knows_entry(SPLIT)]
    reference = tip_forces(mesh_run("graded", finest, end).execute())
    curves, rows = {}, []
    for kind in kinds:
        curves[kind] = []
        for across in meshes.get(kind, meshes["graded"]):
            result = mesh_run(kind, across, end).execute()
            error = float(np.sqrt(np.mean(
                (tip_forces(result) / reference - 1) ** 2)))
            curves[kind].append((result.seconds(), error, across))
            rows.append([kind, f"t/{across}", result.points, result.steps,
                         result.seconds(), 100 * error])
            print(*rows[-1], flush=True)
    report.say(f"The caisson of `tests/jack.prm` (wall t = {WALL} m, "
               f"domain 7 m x 5 m), pushed from 0.5 to {end} m. Uniform: cells "
               "of one size and 3 x 3 points in each, in the same domain. "
               f"Error: rms over depths of {DEPTHS[0]} to {DEPTHS[-1]} m, of "
               f"tip forces averaged over {WINDOW} m, against the graded mesh "
               f"t/{finest}. One run each; the forces scatter by some percent.")
    report.table("refinement", ["mesh", "cells", "points", "steps",
                                "seconds of all steps", "error (%)"], rows)
    report.picture(draw(curves), "Error against time of the meshes")
    short = {k: [(s, e) for s, e, _ in c] for k, c in curves.items()}
    ratios = []
    for kind in kinds[1:]:
        ratio, error = ratio_at_equal_error(short[kind], short["graded"])
        same = [[s for s, _, across in curves[k] if across == 2][0]
                for k in (kind, "graded")]
        ratios.append([f"{kind} / graded", same[0] / same[1], ratio,
                       100 * error])
    report.say("Time over that of the graded mesh, with cells of t/2, and at "
               "equal error (power laws through each curve, in the middle of "
               "the errors that both reach):")
    report.table("refinement_ratios", ["meshes", "at t/2", "at equal error",
                                       "error (%)"], ratios)
    report.say("The whole installation, `prm/jack.prm`, with uniform cells of "
               "0.05 m and 3 x 3 points would cost per step (the number of "
               "steps is the same):")
    report.table("refinement_jack", ["mesh", "points", "ms per step"],
                 whole_caisson(options.quick))
    report.write()
