# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sections of the report on speed that run the whole program."""
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from caisson import curves
from caisson.results import Table
from caisson.study import Study
from lab.outcome import instruction_sets
from lab.performance.report import Report, bars, panels
from lab.performance.timed import Measured, Rounds, execute, interleave, median
from lab.performance.timed import median_ratio

OUTPUT = ["output"]
FORCES = ["tip_force_N", "inner_friction_N", "outer_friction_N", "total_force_N"]
ENERGIES = """kinetic_energy_J external_work_J gravity_work_J stress_work_J
    friction_heat_J""".split()

Studies = dict[str, Study]
Rows = list[list[Any]]


def per_step(result: Measured) -> float:
    """Return the time of a step without output, in s."""
    return result.seconds_per_step(OUTPUT)


def per_point(result: Measured) -> float:
    """Return the time of a step without output over its points, in ns."""
    return result.ns_per_point_step(OUTPUT)


def rate(result: Measured) -> float:
    """Return thousand million point-steps per second, without output."""
    return 1 / per_point(result)


def memory(result: Measured) -> float:
    """Return the peak memory in MB."""
    return 1e-6 * float(result.summary["peak_memory_bytes"])


# ------------------------------------------------------------ one step


def draw_step(shares: dict[str, dict[str, float]]) -> Figure:
    """Draw the ns per point-step by section [name] of each instruction set."""
    figure, (axes,) = panels(1, width=7.5, height=3.6)
    names = list(next(iter(shares.values())))
    left = dict.fromkeys(shares, 0.0)
    for i, name in enumerate(names):
        values = [shares[s][name] for s in shares]
        sets, starts = list(shares), list(left.values())
        axes.barh(sets, values, left=starts, label=name, color=f"C{i}")
        for s in shares:
            left[s] += shares[s][name]
    for s, total in left.items():
        axes.text(total, s, f" {total:.0f}", va="center")
    axes.set_xlabel("ns per point and step")
    axes.margins(x=0.08)
    axes.legend(fontsize=8, ncols=4, loc="upper center", bbox_to_anchor=(0.5, -0.2))
    return figure


def shares_of(results: Sequence[Measured]) -> dict[str, float]:
    """Return the ns per point-step by section, medians of the rounds."""

    def share(name: str) -> float:
        return median(results, lambda r: 1e9 * r.sections[name] / r.steps / r.points)

    return {name: share(name) for name in results[0].sections}


def measure_step(studies: Studies, report: Report) -> None:
    """Measure the whole step by instruction set."""
    study, sets = studies["step"], instruction_sets()
    results = interleave(study, [study.run(s) for s in sets])
    one = results[sets[0]][0]
    cost = Measured.ns_per_point_step
    report.say(
        f"`prm/jack.prm` with two cells across the wall and {one.points:,} points, all"
        f" from the start, pushed to t = {one.history['time_s'][-1]:.3g} s"
        f" ({one.steps} steps), one core, medians of the rounds"
        f" ({study.keys['repeats']})."
    )
    rows: Rows = []
    for s in sets:
        ns = median(results[s], cost)
        whole = median(results[s], lambda r: 1e-6 * r.summary["point_steps_per_second"])
        faster = 1 / median_ratio(results[s], results[sets[0]], cost)
        rows.append([s, ns, 1e3 / ns, whole, faster])
    heads = ["instruction set", "ns per point-step", "million point-steps/s"]
    heads += ["the same with set-up", f"{sets[0]} / this"]
    report.table("step", heads, rows)
    shares = {s: shares_of(results[s]) for s in sets}
    last = shares[sets[-1]]
    report.table(
        "step_sections",
        ["ns per point-step", *sets, f"share, {sets[-1]} (%)"],
        [
            [name, *[shares[s][name] for s in sets], 100 * ns / sum(last.values())]
            for name, ns in last.items()
        ],
    )
    report.picture(draw_step(shares), "Sections of a step")


# ------------------------------------------------------------ size


def measure_size(studies: Studies, report: Report) -> None:
    """Measure the cost per point against their number."""
    study = studies["size"]
    results = interleave(study)
    base = results[study.keys["base"]]
    rows: Rows = [
        [
            rounds[0].points,
            rounds[0].steps,
            median(rounds, per_point),
            median_ratio(rounds, base, per_point),
            median(rounds, memory),
        ]
        for rounds in results.values()
    ]
    report.say(
        "`prm/jack.prm` with two cells across a wall of 0.2 m (the smallest: 0.4 m) and"
        " `Grid/Refinement` from 1, so that points per cell stay the same; the"
        " beginning of the push, without records; time of the steps only, set-up left"
        f" out. The largest costs per point {rows[-1][3]:.2f} times what"
        f" {base[0].points:,} points do."
    )
    heads = ["points", "steps", "ns per point-step"]
    heads += [f"over that of {base[0].points:,} points", "peak memory (MB)"]
    report.table("size", heads, rows)
    if "size_memory" in studies:
        say_memory(studies["size_memory"], report)
    figure, (axes,) = panels(1, width=6.5)
    axes.semilogx([r[0] for r in rows], [r[2] for r in rows], "o-")
    axes.margins(y=0.15)
    axes.set_xlabel("material points")
    axes.set_ylabel("ns per point and step")
    axes.set_ylim(bottom=0)
    report.picture(figure, "Cost against size")


def say_memory(study: Study, report: Report) -> None:
    """Tell the memory of points, by a run on the same mesh with few of them."""
    many, few = [execute(study.run(f"{which} points")) for which in ("many", "few")]
    more = 1e6 * (memory(many) - memory(few)) / (many.points - few.points)
    report.say(
        f"Peak memory of {many.points:,} points: {memory(many):.0f} MB, {more:.0f}"
        f" bytes per point above a run on the same mesh with {few.points:,}"
        f" ({memory(few):.0f} MB). The peak includes a frame and a checkpoint."
    )


# ------------------------------------------------------------ ranks


def measure_ranks(studies: Studies, report: Report) -> None:
    """Measure two ranks against one, bound to cores or not."""
    study = studies["ranks"]
    results = interleave(study)
    meshes = list(dict.fromkeys(run.mesh for run in study.runs))
    rows: Rows = []
    for mesh in meshes:
        one = results[f"{mesh}_1 rank"]
        for binding in ("none", "core"):
            two = results[f"{mesh}_{binding}"]
            rows.append(
                [
                    f"{one[0].points:,} points, 2 ranks, {binding}",
                    1e3 * median(one, rate),
                    1e3 * median(two, rate),
                    median_ratio(two, one, rate),
                ]
            )
    report.say(
        "The scene of section Size at its beginning, without records, on one rank and"
        " on two (`mpirun --bind-to none` or `core`), medians of the ratios in each"
        " round. The time is that of the first rank, which waits for the other in every"
        " step."
    )
    heads = ["strong scaling", "1 rank (million point-steps/s)", "2 ranks", "ratio"]
    report.table("ranks", heads, rows)
    say_weak(report, results, meshes)
    figure, (axes,) = panels(1, width=7, height=3.2)
    bars(axes, [r[0] for r in rows], [r[-1] for r in rows])
    axes.axvline(2, color="black", linewidth=1)
    axes.set_xlim(0, 2.3)
    axes.set_xlabel("point-steps per second over those of one rank")
    report.picture(figure, "Speed of two ranks")


def say_weak(report: Report, results: Rounds, meshes: list[str]) -> None:
    """Add a table of each size on one rank, the next larger on two."""
    rows: Rows = []
    for small, large in zip(meshes, meshes[1:]):
        one, two = results[f"{small}_1 rank"], results[f"{large}_core"]
        points = two[0].points
        rows.append(
            [
                f"{one[0].points:,} on 1, {points:,} on 2",
                points / (2 * one[0].points),
                median_ratio(two, one, rate) / 2,
            ]
        )
    heads = ["weak scaling (points)", "points per rank, 2 / 1"]
    report.table("ranks_weak", [*heads, "speed of each rank, 2 / 1"], rows)


# ------------------------------------------------------------ agreement


def first_steps(result: Measured, n: int) -> Table:
    """Return the rows of the first n steps."""
    chosen = result.history["step"] <= n
    return {name: values[chosen] for name, values in result.history.items()}


def largest_difference(a: Table, b: Table, columns: Sequence[str]) -> float:
    """Return the largest difference of some columns, over the largest value of each
    in a."""
    return max(float(abs(a[c] - b[c]).max() / abs(a[c]).max()) for c in columns)


def measure_agreement(studies: Studies, report: Report) -> None:
    """Compare instruction sets and ranks, row by row."""
    study, sets = studies["agreement"], instruction_sets()
    n_steps = study.keys["steps"]
    base = first_steps(execute(study.run(sets[-1])), n_steps)
    rows: Rows = []
    for run in study.runs:
        if run.name != sets[-1] and (run.name in sets or "ranks" in run.name):
            other = first_steps(execute(run), n_steps)
            differences = [
                largest_difference(base, other, c) for c in (FORCES, ENERGIES)
            ]
            rows.append([run.name, len(base["step"]) - 1, *differences])
    report.say(
        "`tests/simulation/jack.prm` with a row for each step: the largest difference"
        f" of any force and any energy in these steps from {sets[-1]} on one rank, over"
        " the largest value of its column (allowed: 1e-9). history.csv has ten digits:"
        " 0 means that all of them agree. Four ranks share the cores: for agreement"
        " only."
    )
    report.table("agreement", ["run", "steps", "forces", "energies"], rows)
    if "agreement_coarse" in studies:
        say_coarse(studies["agreement_coarse"], report)


def tip_force_by_meter(result: Measured) -> np.ndarray:
    """Return the tip force at each meter of penetration but the last."""
    depths = np.arange(1.0, result.history["penetration_m"][-1] - 0.1, 1.0)
    return curves.forces_at(result.history, "tip_force_N", depths)


def say_coarse(study: Study, report: Report) -> None:
    """Tell the differences of the tip force to the end of a coarse scene."""
    forces = {run.name: tip_force_by_meter(execute(run)) for run in study.runs}
    differences = ", ".join(
        f"on {n} by {abs(forces[n] / forces['1'] - 1).max():.1e}" for n in ("2", "4")
    )
    report.say(
        "To the end of `prm/jack_coarse.prm` with mass scaling 100 rounding has time to"
        " grow: the tip force at each meter (averaged over 0.2 m) differs from that on"
        f" one rank by at most a share of: {differences}."
    )


# ------------------------------------------------------------ needs


def measure_needs(studies: Studies, report: Report) -> None:
    """Measure what each part of the method costs."""
    study = studies["needs"]
    results = interleave(study)
    base = results["default"]
    rows: Rows = [
        [
            name,
            rounds[0].points,
            1e3 * median(rounds, per_step),
            median_ratio(rounds, base, per_step),
            median_ratio(rounds, base, per_point),
        ]
        for name, rounds in results.items()
    ]
    report.say(
        "`prm/jack.prm` with two cells across the wall and one thing changed, without"
        f" output, medians of the ratios in each round ({study.keys['repeats']}). A"
        " scene pays only for what it takes: what it leaves out has a ratio below one,"
        " and cells without points one of one."
    )
    heads = ["changed", "points at the end", "ms per step", "per step, over default"]
    report.table("needs", [*heads, "per point-step, over default"], rows)
    share = median(base, lambda r: r.sections["output"] / r.seconds(OUTPUT))
    report.say(
        "Output in addition, with records every 0.1 s as in the scene:"
        f" {100 * share:.1f} % of the step's time."
    )
    figure, (axes,) = panels(1, width=7.5, height=4.6)
    bars(axes, [r[0] for r in rows], [r[3] for r in rows])
    axes.axvline(1, color="black", linewidth=1)
    axes.set_xlabel("time per step over that of the default")
    report.picture(figure, "Time of a step, over default")
