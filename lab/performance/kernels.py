# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sections of the report on speed on the kernels alone: build/release's
kernel_benchmark, and what bounds it."""
import csv
import math
import statistics
import subprocess
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from caisson.paths import BUILD, ROOT
from caisson.study import Study
from lab.outcome import INSTRUCTION_SETS
from lab.performance.report import COLORS, Report, panels

KERNELS = BUILD / "kernel_benchmark"
# by instruction set, points per cell, shear rate, kernel
Key = tuple[str, int, float, str]
Rates = dict[Key, float]  # million points per second
POINTS_PER_CELL = [4, 9, 16, 25]
AT_REST, YIELDING = 0.0, 10000.0  # shear rates of kernel_benchmark
SAND = {AT_REST: "elastic", YIELDING: "yielding"}
PLAIN = {
    "points_to_grid": "points to grid",
    "grid_to_points": "grid to points",
    "both_transfers": "both transfers",
    "apply_mass": "mass matrix",
}

# Bytes that come and go, from kernels/layout.h. A lane of a block: twelve
# fields are read and eleven written, all in lines that were read before.
STREAM_BYTES = 8 * (12 + 11)
# A cell: its moments read and written, two geometries, corners, three fields.
GRID_TO_POINTS_BYTES_PER_CELL = 2 * 320 + 2 * 48 + 16 + 3 * 16
# A cell: its moments read, the fit written, geometry, corners, a node's sums.
POINTS_TO_GRID_BYTES_PER_CELL = 320 + 96 + 48 + 16 + 2 * 64

# Additions and multiplications, counted in the source; a division or a root
# counts as one, comparisons and selections as none. Full cells, B-bar, stress
# filter, elastic step of Mohr-Coulomb. Per lane:
GRID_TO_POINTS_OPERATIONS = (
    11  # CellMap::at_position
    + 23  # VelocityGradient
    + 17  # strain increment, B-bar, spin, 1/r
    + 31  # stress filter
    + 30  # rotation, half before and half after the law
    + 26  # elastic step and check of the yield function
    + 19  # volume and work
    + 7  # sums of the work
    + 28  # new velocity and displacement
    + 11  # new place, and whether it is in the cell
    + 74
)  # sum_points: place 11, moments 34, sums of the fit 29
# ... and per cell: mean divergence 180, fields 30, sums over lanes 240
GRID_TO_POINTS_OPERATIONS_PER_CELL = 450
# fit 125, Gauss points 250, stiffness 50, corners 75
POINTS_TO_GRID_OPERATIONS_PER_CELL = 500


def lanes_per_point(points_per_cell: int) -> float:
    """Return the lanes for each point, with those that are empty."""
    return 8 * math.ceil(points_per_cell / 8) / points_per_cell


def build() -> None:
    """Build the benchmark."""
    subprocess.run(
        ["cmake", "--build", str(KERNELS.parent), "--target", "kernel_benchmark"],
        check=True,
        stdout=subprocess.DEVNULL,
    )


def run_benchmark(
    points: int, repetitions: int, rounds: int
) -> tuple[Rates, dict[Key, list[float]]]:
    """Return the medians of some rounds, and all rounds."""
    found: dict[Key, list[float]] = {}
    for _ in range(rounds):
        text = subprocess.run(
            [str(KERNELS), str(points), str(repetitions)],
            capture_output=True,
            text=True,
            check=True,
            cwd=ROOT,
        ).stdout
        for row in csv.DictReader(text.splitlines()):
            key = (
                row["instruction_set"],
                int(row["points_per_cell"]),
                float(row["shear_rate_per_s"]),
                row["kernel"],
            )
            found.setdefault(key, []).append(float(row["million_points_per_s"]))
    return {key: statistics.median(v) for key, v in found.items()}, found


def sets_in(rates: Rates) -> list[str]:
    """Return the instruction sets that were measured."""
    return [s for s in INSTRUCTION_SETS if any(key[0] == s for key in rates)]


def cost_of_cell_and_block(
    rates: Rates, s: str, shear: float, kernel: str
) -> tuple[float, float]:
    """Return ns, by least squares of the time per cell over its number of blocks."""
    blocks = [math.ceil(n / 8) for n in POINTS_PER_CELL]
    per_cell = [1e3 * n / rates[s, n, shear, kernel] for n in POINTS_PER_CELL]
    per_block, rest = np.polyfit(blocks, per_cell, 1)
    return float(rest), float(per_block)


def draw_kernels(rates: Rates) -> Figure:
    """Draw the speed over the points per cell."""
    figure, axes = panels(3)
    names = ["points_to_grid", "grid_to_points", "both_transfers"]
    for a, kernel in zip(axes, names):
        for s in sets_in(rates):
            for shear, line in ((AT_REST, "o-"), (YIELDING, "s:")):
                a.plot(
                    POINTS_PER_CELL,
                    [rates[s, n, shear, kernel] for n in POINTS_PER_CELL],
                    line,
                    color=COLORS[s],
                    label=f"{s}, {SAND[shear]}",
                )
        a.set_title(PLAIN[kernel])
        a.set_xlabel("points per cell")
        a.set_xticks(POINTS_PER_CELL)
        a.set_ylim(bottom=0)
    axes[0].set_ylabel("million points per second")
    axes[1].legend(fontsize=8)
    return figure


def measure_kernels(studies: dict[str, Study], report: Report) -> None:
    """Measure the kernels by points per cell and instruction set."""
    build()
    keys = studies["kernels"].keys
    points, repeats = keys["points"], keys["repeats"]
    rates, rounds = run_benchmark(points, keys["repetitions"], repeats)
    sets = sets_in(rates)
    rows: list[list[Any]] = []
    for kernel in ("points_to_grid", "grid_to_points", "both_transfers"):
        for shear in (AT_REST, YIELDING):
            for n in POINTS_PER_CELL:
                value = [rounds[s, n, shear, kernel] for s in sets]
                medians = [statistics.median(v) for v in value]
                ratios = [
                    statistics.median(a / b for a, b in zip(v, value[0]))
                    for v in value[1:]
                ]
                rows.append([PLAIN[kernel], SAND[shear], n, *medians, *ratios])
    report.say(
        f"`kernel_benchmark {points}`: million points per second on one core, medians"
        f" of the rounds ({repeats}) of its best times. Mohr-Coulomb sand, at rest or"
        " sheared so that every point yields in every step. Moments that the last step"
        " has left make points to grid cheap: it does not touch the points."
    )
    heads = ["kernel", "sand", "points per cell", *sets]
    report.table("kernels", heads + [f"{s} / {sets[0]}" for s in sets[1:]], rows)
    say_cell_and_block(report, rates, sets)
    report.picture(draw_kernels(rates), "Kernels")


def say_cell_and_block(report: Report, rates: Rates, sets: Sequence[str]) -> None:
    """Tell what a cell costs and what each of its blocks."""
    report.say(
        "Time per cell as that of the cell itself and of each of its blocks of eight,"
        " by least squares over the four numbers of points (ns):"
    )
    rows = []
    for shear, sand in SAND.items():
        costs = [
            cost_of_cell_and_block(rates, s, shear, "both_transfers") for s in sets
        ]
        rows.append([sand, *[cost for pair in costs for cost in pair]])
    heads = [f"{s}, {what}" for s in sets for what in ("cell", "block")]
    report.table("kernels_cell_and_block", ["both transfers", *heads], rows)


def bounds(
    rates: Rates, name: str, n: int, s: str, bandwidth: float
) -> tuple[float, float, float, float]:
    """Return bytes per point, and million points per second: measured, as memory and
    arithmetic would allow."""
    if name == "grid_to_points":
        size = STREAM_BYTES * lanes_per_point(n) + GRID_TO_POINTS_BYTES_PER_CELL / n
        work = (
            GRID_TO_POINTS_OPERATIONS * lanes_per_point(n)
            + GRID_TO_POINTS_OPERATIONS_PER_CELL / n
        )
    else:
        size = POINTS_TO_GRID_BYTES_PER_CELL / n
        work = POINTS_TO_GRID_OPERATIONS_PER_CELL / n
    peak = 2 * rates[s, 0, 0.0, "multiply_and_add"]
    return size, rates[s, n, AT_REST, name], 1e3 * bandwidth / size, peak / work


def bandwidth_of(rates: Rates, s: str) -> float:
    """Return GB/s of the stream over the blocks, without empty lanes."""
    return 1e-3 * STREAM_BYTES * rates[s, 16, AT_REST, "stream"]


def draw_roofline(rates: Rates, sets: Sequence[str], memory: float) -> Figure:
    """Draw the speed over the bytes per point, with its bounds."""
    figure, (axes,) = panels(1, width=7.5, height=5)
    for s in sets:
        for name, marker in (("grid_to_points", "o"), ("points_to_grid", "^")):
            found = sorted(
                (*bounds(rates, name, n, s, memory), n) for n in POINTS_PER_CELL
            )
            size, measured, _, arithmetic, cells = zip(*found)
            axes.loglog(
                size,
                measured,
                marker + "-",
                color=COLORS[s],
                label=f"{s}, {PLAIN[name]}",
            )
            axes.loglog(size, arithmetic, "--", color=COLORS[s], linewidth=1)
            for x, y, n in zip(size, measured, cells):
                if s == sets[-1]:
                    axes.annotate(
                        str(n),
                        (x, y),
                        fontsize=8,
                        xytext=(0, 7),
                        textcoords="offset points",
                        ha="center",
                    )
    x = [15, 800]
    axes.loglog(
        x,
        [1e3 * memory / v for v in x],
        color="black",
        linewidth=1.5,
        label=f"bound by memory, {memory:.0f} GB/s",
    )
    axes.plot(
        [],
        [],
        "--",
        color="0.4",
        linewidth=1,
        label="bound by arithmetic of each instruction set",
    )
    axes.set_xticks([20, 50, 100, 200, 500], [20, 50, 100, 200, 500])
    axes.set_xlabel("bytes per point (numbers: points per cell)")
    axes.set_ylabel("million points per second")
    axes.set_ylim(bottom=2)
    axes.legend(fontsize=8, loc="lower left")
    return figure


def measure_roofline(studies: dict[str, Study], report: Report) -> None:
    """Measure what memory and arithmetic would allow, beside the kernels."""
    build()
    keys = studies["roofline"].keys
    sizes = keys["sizes"]
    by_size = {size: run_benchmark(size, 10, keys["repeats"])[0] for size in sizes}
    middle = by_size[sizes[1]]
    sets = sets_in(middle)
    memory = max(bandwidth_of(middle, s) for s in sets)
    report.say(
        "Measured with the kernels' flags: a loop over the blocks that reads the twelve"
        " and writes the eleven fields which grid to points does and computes nothing"
        " (GB/s, 16 points per cell, by number of points), and multiplications with an"
        " addition each in registers (thousand million operations per second)."
    )
    limits = []
    for s in sets:
        bandwidths = [bandwidth_of(by_size[n], s) for n in sizes]
        limits.append([s, *bandwidths, 2e-3 * middle[s, 0, 0.0, "multiply_and_add"]])
    heads = ["instruction set", *[f"{n:,} points" for n in sizes], "arithmetic"]
    report.table("limits", heads, limits)
    say_bounds(report, middle, memory, sizes[1])
    report.picture(draw_roofline(middle, sets, memory), "Bounds of the kernels")


def say_bounds(report: Report, rates: Rates, memory: float, points: int) -> None:
    """Tell the speed of the kernels beside their bounds."""
    rows = []
    for name in ("grid_to_points", "points_to_grid"):
        for s in sets_in(rates):
            for n in POINTS_PER_CELL:
                size, *rate = bounds(rates, name, n, s, memory)
                share = rate[0] / min(rate[1:])
                rows.append([PLAIN[name], s, n, size, *rate, share])
    report.say(
        f"The kernels at {points:,} points, elastic, in million points per second."
        " Bytes and operations per point are counted in the source"
        " (lab/performance/kernels.py lists them), with empty lanes and what a"
        " cell adds; the bound by memory takes the fastest of these loops. The bounds"
        " suppose that nothing waits: no latency, division, root, shuffle or look-up,"
        " and as many multiplications as additions."
    )
    heads = ["kernel", "instruction set", "points per cell", "bytes per point"]
    heads += ["measured", "bound by memory", "bound by arithmetic"]
    report.table("roofline", [*heads, "measured / lower bound"], rows)
