# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sections of scripts/speed on the whole program."""
import numpy as np

from speed_report import Report, panels
from speed_runs import (INSTRUCTION_SETS, ROOT, Measured, Run, interleave,
                        largest_difference, median, median_ratio)

OUTPUT = ["output"]
NO_RECORDS = {"Output/Record interval": 1000}
FORCES = ["tip_force_N", "inner_friction_N", "outer_friction_N",
          "total_force_N"]
ENERGIES = ["kinetic_energy_J", "external_work_J", "gravity_work_J",
            "stress_work_J", "friction_heat_J"]


def sets_of_this_cpu():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        flags = file.read().split()
    return [s for s, flag in zip(INSTRUCTION_SETS,
                                 ("sse2", "avx2", "avx512dq"))
            if flag in flags]


# ------------------------------------------------------------ one step

def draw_step(shares):
    """@p shares: ns per point-step by section, by instruction set."""
    figure, (axes,) = panels(1, width=7.5, height=3.6)
    names = list(next(iter(shares.values())))
    left = dict.fromkeys(shares, 0.)
    for i, name in enumerate(names):
        values = [shares[s][name] for s in shares]
        axes.barh(list(shares), values, left=list(left.values()), label=name,
                  color=f"C{i}")
        for s in shares:
            left[s] += shares[s][name]
    for s, total in left.items():
        axes.text(total, s, f" {total:.0f}", va="center")
    axes.set_xlabel("ns per point and step")
    axes.margins(x=0.08)
    axes.legend(fontsize=8, ncols=4, loc="upper center",
                bbox_to_anchor=(.5, -.2))
    return figure


def measure_step(options):
    report = Report("step", "The whole step")
    until = 0.6 if options.quick else 4.
    sets = sets_of_this_cpu()
    results = interleave([Run(s, {"Method/Instruction set": s}, until=until)
                          for s in sets], options.repeats)
    one = results[sets[0]][0]
    report.say(f"`prm/jack.prm` with two cells across the wall and {one.points:,} "
               "points, all from the start, "
               f"pushed for {until:g} s ({one.steps} steps), one core, medians "
               f"of the rounds ({options.repeats}).")
    report.table(
        "step", ["instruction set", "ns per point-step",
                 "million point-steps/s", "the same with set-up",
                 f"{sets[0]} / this"],
        [[s, median(results[s], Measured.ns_per_point_step),
          1e3 / median(results[s], Measured.ns_per_point_step),
          1e-6 * median(results[s], lambda r:
                        r.summary["point_steps_per_second"]),
          1 / median_ratio(results[s], results[sets[0]],
                           Measured.ns_per_point_step)] for s in sets])
    shares = {s: {name: median(results[s], lambda r, name=name:
                               1e9 * r.sections[name] / r.steps / r.points)
                  for name in one.sections} for s in sets}
    report.table("step_sections", ["ns per point-step"] + sets
                 + [f"share, {sets[-1]} (%)"],
                 [[name] + [shares[s][name] for s in sets]
                  + [100 * shares[sets[-1]][name]
                     / sum(shares[sets[-1]].values())]
                  for name in one.sections])
    report.picture(draw_step(shares), "Sections of a step")
    report.write()


# ------------------------------------------------------------ size

def size_run(name, entries, seconds, **more):
    """prm/jack.prm with a thicker wall, and so fewer points, without
    records."""
    return Run(name, {"Rigid body/Wall thickness": 0.2, **NO_RECORDS,
                      **entries}, seconds=seconds, **more)


def draw_size(rows):
    figure, (axes,) = panels(1, width=6.5)
    axes.semilogx([r[0] for r in rows], [r[2] for r in rows], "o-")
    axes.margins(y=0.15)
    axes.set_xlabel("material points")
    axes.set_ylabel("ns per point and step")
    axes.set_ylim(bottom=0)
    return figure


def measure_size(options):
    report = Report("size", "Size")
    refinements = [1, 2] if options.quick else [1, 2, 3, 4, 6, 9]
    runs = [size_run("size, wall 0.4 m", {"Rigid body/Wall thickness": 0.4},
                     .5 if options.quick else 2)]
    for r in refinements:  # some hundred steps, or nearly
        runs.append(size_run(f"size, refinement {r}", {"Grid/Refinement": r},
                             .5 if options.quick else max(2., .1 * r * r)))
    results = interleave(runs, min(options.repeats, 3))
    base = results[runs[1].name]
    cost = lambda r: r.ns_per_point_step(OUTPUT)
    rows = [[results[run.name][0].points, results[run.name][0].steps,
             median(results[run.name], cost),
             median_ratio(results[run.name], base, cost),
             1e-6 * median(results[run.name],
                           lambda r: r.summary["peak_memory_bytes"])]
            for run in runs]
    report.say("`prm/jack.prm` with two cells across a wall of 0.2 m (the "
               "smallest: 0.4 m) and "
               "`Grid/Refinement` from 1, so that points per cell stay the "
               "same; the beginning of the push, without records; time of the "
               "steps only, set-up left out. The largest costs per point "
               f"{rows[-1][3]:.2f} times what {base[0].points:,} points do.")
    report.table("size", ["points", "steps", "ns per point-step",
                          f"over that of {base[0].points:,} points",
                          "peak memory (MB)"], rows)
    say_memory(report, 2 if options.quick else 6)
    report.picture(draw_size(rows), "Cost against size")
    report.write()


def say_memory(report, refinement):
    """The memory of points, by a run on the same mesh with few of them."""
    def memory(name, entries):
        result = size_run(name, {"Grid/Refinement": refinement, **entries},
                          .1).execute()
        return result.points, result.summary["peak_memory_bytes"]
    points, much = memory("memory", {})
    few, base = memory("memory, few points", {"Material points/Region top": -17})
    report.say(f"Peak memory of {points:,} points: {1e-6 * much:.0f} MB, "
               f"{(much - base) / (points - few):.0f} bytes per point above a "
               f"run on the same mesh with {few:,} ({1e-6 * base:.0f} MB). The "
               "peak includes a frame and a checkpoint.")


# ------------------------------------------------------------ ranks

def draw_ranks(rows):
    figure, (axes,) = panels(1, width=7, height=3.2)
    axes.barh([r[0] for r in rows], [r[-1] for r in rows], color="#3b7dd8")
    for i, row in enumerate(rows):
        axes.text(row[-1], i, f" {row[-1]:.2f}", va="center")
    axes.axvline(2, color="black", linewidth=1)
    axes.set_xlim(0, 2.3)
    axes.invert_yaxis()
    axes.set_xlabel("point-steps per second over those of one rank")
    return figure


def measure_ranks(options):
    report = Report("ranks", "Ranks")
    seconds = 1 if options.quick else 5
    sizes = [1, 2] if options.quick else [3, 4, 6]
    entries = {r: {"Grid/Refinement": r} for r in sizes}
    runs = []
    for r in sizes:
        runs.append(size_run(f"1 rank, refinement {r}", entries[r], seconds))
        runs += [size_run(f"2 ranks, refinement {r}, bound to {binding}",
                          entries[r], seconds, ranks=2, binding=binding)
                 for binding in ("none", "core")]
    results = interleave(runs, min(options.repeats, 3))
    rate = lambda r: 1 / r.ns_per_point_step(OUTPUT)
    rows = []
    for r in sizes:
        one = results[f"1 rank, refinement {r}"]
        for binding in ("none", "core"):
            two = results[f"2 ranks, refinement {r}, bound to {binding}"]
            rows.append([f"{one[0].points:,} points, 2 ranks, {binding}",
                         1e3 * median(one, rate), 1e3 * median(two, rate),
                         median_ratio(two, one, rate)])
    report.say("The scene of section Size at its beginning, without records, "
               "on one rank and on two (`mpirun --bind-to none` or `core`), "
               "medians of the ratios in each round. The time is that of the "
               "first rank, which waits for the other in every step.")
    report.table("ranks", ["strong scaling", "1 rank (million point-steps/s)",
                           "2 ranks", "ratio"], rows)
    say_weak(report, results, sizes, rate)
    report.picture(draw_ranks(rows), "Speed of two ranks")
    report.write()


def say_weak(report, results, sizes, rate):
    """Each size on one rank, the next larger on two."""
    rows = []
    for small, large in zip(sizes, sizes[1:]):
        one = results[f"1 rank, refinement {small}"]
        two = results[f"2 ranks, refinement {large}, bound to core"]
        rows.append([f"{one[0].points:,} on 1, {two[0].points:,} on 2",
                     two[0].points / (2 * one[0].points),
                     median_ratio(two, one, rate) / 2])
    report.table("ranks_weak", ["weak scaling (points)",
                                "points per rank, 2 / 1",
                                "speed of each rank, 2 / 1"], rows)


# ------------------------------------------------------------ agreement

def first_steps(result, n):
    return result.history[result.history["step"] <= n]


def agreement_run(name, **more):
    return Run(name, {"Output/Record interval": 0, "Time/End penetration": 1,
                      **more.pop("entries", {})},
               scene=ROOT / "tests/jack.prm", **more)


def tip_force_by_depth(result):
    h = result.history
    depths = np.arange(1., h["penetration_m"][-1], 1.)
    return np.array([h["tip_force_N"][abs(h["penetration_m"] - d)
                                      <= .1 + 1e-9].mean() for d in depths])


def measure_agreement(options):
    report = Report("agreement", "Instruction sets and ranks agree")
    until, n_steps = (.4, 100) if options.quick else (2.5, 1000)
    sets = sets_of_this_cpu()
    runs = [agreement_run(s, entries={"Method/Instruction set": s}, until=until)
            for s in sets]
    runs += [agreement_run(f"{n} ranks", until=until, ranks=n) for n in (2, 4)]
    base = first_steps(runs[len(sets) - 1].execute(), n_steps)
    rows = []
    for run in runs[:len(sets) - 1] + runs[len(sets):]:
        other = first_steps(run.execute(), n_steps)
        rows.append([run.name, len(base) - 1]
                    + [largest_difference(base, other, columns)
                       for columns in (FORCES, ENERGIES)])
    report.say("`tests/jack.prm` with a row for each step: the largest "
               "difference of any force and any energy in these steps from "
               f"{sets[-1]} on one rank, over the largest value of its column "
               "(asked: 1e-9). history.csv has ten digits: 0 means that all of "
               "them agree. Four ranks share the cores: for agreement only.")
    report.table("agreement", ["run", "steps", "forces", "energies"], rows)
    say_coarse(report, options.quick)
    report.write()


def say_coarse(report, quick):
    """The tip force to the end of a coarse scene."""
    entries = {"Time/Mass scaling": 100}
    if quick:
        entries["Time/End penetration"] = 1.5
    forces = {n: tip_force_by_depth(Run(
        f"coarse, {n} ranks", entries, scene=ROOT / "prm/jack_coarse.prm",
        ranks=n).execute()) for n in (1, 2, 4)}
    differences = ", ".join(
        f"on {n} by {abs(forces[n] / forces[1] - 1).max():.1e}"
        for n in (2, 4))
    report.say("To the end of `prm/jack_coarse.prm` with mass scaling 100 "
               "rounding has time to grow: the tip force at each meter "
               "(averaged over 0.2 m) differs from that on one rank by at most "
               f"a share of: {differences}.")


# ------------------------------------------------------------ needs

NEEDS = {
    "linear elastic": {"Soil/Layer 1/Law": "linear elastic"},
    "FLIP only": {"Method/Velocity transfer": "FLIP"},
    "XPIC order 1": {"Method/XPIC order": 1},
    "USL": {"Method/Stress update": "USL"},
    "no mass floor": {"Method/Mass floor": "false"},
    "no mean volume change": {"Method/Mean volume change": "false"},
    "no stress filter": {"Method/Stress filter": 0},
    "no velocity limiter": {"Method/Velocity limiter": "false"},
    "forces from the points": {"Method/Integration": "material points"},
    "local damping 0.1": {"Method/Local damping": 0.1},
    "wall without friction": {f"Rigid body/Friction angle of the {part}": 0
                              for part in ("tip", "inner wall", "outer wall")},
    "points split and merge": {"Material points/Split and merge": "true"},
    "cells without points: Top = 20 m": {"Grid/Top": 20}}
LEFT_OUT_TOGETHER = ["linear elastic", "FLIP only", "no mass floor",
                     "no mean volume change", "no stress filter",
                     "no velocity limiter", "wall without friction"]
NEEDS["elastic, FLIP, no friction, all four \"no\""] = {
    entry: value for name in LEFT_OUT_TOGETHER
    for entry, value in NEEDS[name].items()}
NO_BODY = {"Rigid body/Kind": "none", "Grid/Cell width": 0.3,
           "Grid/Cell height": 0.3, "Material points/Per direction far": 4,
           "Time/End penetration": 0, "Time/End time": 1000}


def draw_needs(rows):
    figure, (axes,) = panels(1, width=7.5, height=4.6)
    names, values = [r[0] for r in rows], [r[3] for r in rows]
    axes.barh(names, values, color="#3b7dd8")
    for i, value in enumerate(values):
        axes.text(value, i, f"{value:.2f} ", va="center", ha="right",
                  fontsize=8, color="white")
    axes.axvline(1, color="black", linewidth=1)
    axes.invert_yaxis()
    axes.set_xlabel("time per step over that of the default")
    return figure


def measure_needs(options):
    report = Report("needs", "What a scene does not need")
    until = .3 if options.quick else 2.
    # without a body steps are longer, and until then they would be few
    runs = ([Run("default", until=until)]
            + [Run(name, entries, until=until)
               for name, entries in NEEDS.items()]
            + [Run("no body, about as many points", NO_BODY,
                   seconds=.5 if options.quick else 2.5)])
    results = interleave(runs, options.repeats)
    base = results["default"]
    step = lambda r: r.seconds_per_step(OUTPUT)
    point = lambda r: r.ns_per_point_step(OUTPUT)
    rows = [[name, r[0].points, 1e3 * median(r, step),
             median_ratio(r, base, step), median_ratio(r, base, point)]
            for name, r in results.items()]
    report.say("`prm/jack.prm` with two cells across the wall and one thing "
               "changed, without output, medians "
               f"of the ratios in each round ({options.repeats}). A scene pays "
               "only for what it takes: what it leaves out has a ratio below "
               "one, and cells without points one of one.")
    report.table("needs", ["changed", "points at the end", "ms per step",
                           "per step, over default",
                           "per point-step, over default"], rows)
    report.say("Output in addition, with records every 0.1 s as in the scene: "
               f"{100 * median(base, output_share):.1f} % of the step's time.")
    report.picture(draw_needs(rows), "Time of a step, over default")
    report.write()


def output_share(result):
    return result.sections["output"] / result.seconds(OUTPUT)
