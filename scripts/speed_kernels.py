# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sections of scripts/speed on the kernels alone: build/release's
kernel_benchmark, and what bounds it."""
import csv
import math
import statistics
import subprocess

import numpy as np

from speed_report import COLORS, Report, panels
from speed_runs import INSTRUCTION_SETS, KERNELS, ROOT

POINTS_PER_CELL = [4, 9, 16, 25]
AT_REST, YIELDING = 0., 10000.  # shear rates of kernel_benchmark
PLAIN = {"points_to_grid": "points to grid", "grid_to_points": "grid to points",
         "both_transfers": "both transfers", "apply_mass": "mass matrix"}

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
    11      # CellMap::at_position
    + 23    # VelocityGradient
    + 17    # strain increment, B-bar, spin, 1/r
    + 31    # stress filter
    + 7     # rotation
    + 26    # elastic step and check of the yield function
    + 19    # volume and work
    + 7     # sums of the work
    + 28    # new velocity and displacement
    + 11    # new place, and whether it is in the cell
    + 74)   # sum_points: place 11, moments 34, sums of the fit 29
# ... and per cell: mean divergence 180, fields 30, sums over lanes 240
GRID_TO_POINTS_OPERATIONS_PER_CELL = 450
# fit 125, Gauss points 250, stiffness 50, corners 75
POINTS_TO_GRID_OPERATIONS_PER_CELL = 500


def lanes_per_point(points_per_cell):
    """With those that are empty."""
    return 8 * math.ceil(points_per_cell / 8) / points_per_cell


def build():
    subprocess.run(["cmake", "--build", str(KERNELS.parent),
                    "--target", "kernel_benchmark"], check=True,
                   stdout=subprocess.DEVNULL)


def run_benchmark(points, repetitions, rounds):
    """Million points per second, the medians of some rounds: by instruction
    set, points per cell, shear rate and kernel; and all rounds."""
    found = {}
    for _ in range(rounds):
        text = subprocess.run([str(KERNELS), str(points), str(repetitions)],
                              capture_output=True, text=True, check=True,
                              cwd=ROOT).stdout
        for row in csv.DictReader(text.splitlines()):
            key = (row["instruction_set"], int(row["points_per_cell"]),
                   float(row["shear_rate_per_s"]), row["kernel"])
            found.setdefault(key, []).append(
                float(row["million_points_per_s"]))
    return {key: statistics.median(v) for key, v in found.items()}, found


def sets_in(rates):
    return [s for s in INSTRUCTION_SETS if any(key[0] == s for key in rates)]


def cost_of_cell_and_block(rates, s, shear, kernel):
    """ns, by least squares of the time per cell over its number of blocks."""
    blocks = [math.ceil(n / 8) for n in POINTS_PER_CELL]
    per_cell = [1e3 * n / rates[s, n, shear, kernel] for n in POINTS_PER_CELL]
    per_block, rest = np.polyfit(blocks, per_cell, 1)
    return float(rest), float(per_block)


def draw_kernels(rates):
    figure, axes = panels(3)
    names = ["points_to_grid", "grid_to_points", "both_transfers"]
    for a, kernel in zip(axes, names):
        for s in sets_in(rates):
            for shear, line in ((AT_REST, "o-"), (YIELDING, "s:")):
                a.plot(POINTS_PER_CELL,
                       [rates[s, n, shear, kernel] for n in POINTS_PER_CELL],
                       line, color=COLORS[s],
                       label=f"{s}, {'elastic' if shear == 0 else 'yielding'}")
        a.set_title(PLAIN[kernel])
        a.set_xlabel("points per cell")
        a.set_xticks(POINTS_PER_CELL)
        a.set_ylim(bottom=0)
    axes[0].set_ylabel("million points per second")
    axes[1].legend(fontsize=8)
    return figure


def measure_kernels(options):
    build()
    report = Report("kernels", "Kernels alone")
    points = 5000 if options.quick else 50000
    rates, rounds = run_benchmark(points, 3 if options.quick else 20,
                                  options.repeats)
    sets = sets_in(rates)
    rows = []
    for kernel in ("points_to_grid", "grid_to_points", "both_transfers"):
        for shear in (AT_REST, YIELDING):
            for n in POINTS_PER_CELL:
                value = [rounds[s, n, shear, kernel] for s in sets]
                rows.append(
                    [PLAIN[kernel], "elastic" if shear == 0 else "yielding", n]
                    + [statistics.median(v) for v in value]
                    + [statistics.median(a / b for a, b in zip(v, value[0]))
                       for v in value[1:]])
    report.say(f"`kernel_benchmark {points}`: million points per second on one "
               f"core, medians of the rounds ({options.repeats}) of its best "
               "times. "
               "Mohr-Coulomb sand, at rest or sheared so that every point "
               "yields in every step. Moments that the last step has left make "
               "points to grid cheap: it does not touch the points.")
    report.table("kernels",
                 ["kernel", "sand", "points per cell"] + sets
                 + [f"{s} / {sets[0]}" for s in sets[1:]], rows)
    report.say("Time per cell as that of the cell itself and of each of its "
               "blocks of eight, by least squares over the four numbers of "
               "points (ns):")
    report.table("kernels_cell_and_block",
                 ["both transfers"] + [f"{s}, {what}" for s in sets
                                       for what in ("cell", "block")],
                 [[sand] + [cost for s in sets for cost in
                            cost_of_cell_and_block(rates, s, shear,
                                                   "both_transfers")]
                  for sand, shear in (("elastic", AT_REST),
                                      ("yielding", YIELDING))])
    report.picture(draw_kernels(rates), "Kernels")
    report.write()


def bounds(rates, name, n, s, bandwidth):
    """Bytes per point, and million points per second: measured, as memory and
    arithmetic would allow."""
    if name == "grid_to_points":
        size = (STREAM_BYTES * lanes_per_point(n)
                + GRID_TO_POINTS_BYTES_PER_CELL / n)
        work = (GRID_TO_POINTS_OPERATIONS * lanes_per_point(n)
                + GRID_TO_POINTS_OPERATIONS_PER_CELL / n)
    else:
        size = POINTS_TO_GRID_BYTES_PER_CELL / n
        work = POINTS_TO_GRID_OPERATIONS_PER_CELL / n
    peak = 2 * rates[s, 0, 0., "multiply_and_add"]
    return size, rates[s, n, AT_REST, name], 1e3 * bandwidth / size, peak / work


def bandwidth_of(rates, s):
    """GB/s of the stream over the blocks, without empty lanes."""
    return 1e-3 * STREAM_BYTES * rates[s, 16, AT_REST, "stream"]


def draw_roofline(rates, sets, memory):
    figure, (axes,) = panels(1, width=7.5, height=5)
    for s in sets:
        for name, marker in (("grid_to_points", "o"), ("points_to_grid", "^")):
            found = sorted((*bounds(rates, name, n, s, memory), n)
                           for n in POINTS_PER_CELL)
            size, measured, _, arithmetic, cells = zip(*found)
            axes.loglog(size, measured, marker + "-", color=COLORS[s],
                        label=f"{s}, {PLAIN[name]}")
            axes.loglog(size, arithmetic, "--", color=COLORS[s], linewidth=1)
            for x, y, n in zip(size, measured, cells):
                if s == sets[-1]:
                    axes.annotate(str(n), (x, y), fontsize=8, xytext=(0, 7),
                                  textcoords="offset points", ha="center")
    x = [15, 800]
    axes.loglog(x, [1e3 * memory / v for v in x], color="black", linewidth=1.5,
                label=f"bound by memory, {memory:.0f} GB/s")
    axes.plot([], [], "--", color="0.4", linewidth=1,
              label="bound by arithmetic of each instruction set")
    axes.set_xticks([20, 50, 100, 200, 500], [20, 50, 100, 200, 500])
    axes.set_xlabel("bytes per point (numbers: points per cell)")
    axes.set_ylabel("million points per second")
    axes.set_ylim(bottom=2)
    axes.legend(fontsize=8, loc="lower left")
    return figure


def measure_roofline(options):
    build()
    report = Report("roofline", "What bounds the kernels")
    rounds = min(options.repeats, 3)
    sizes = [5000, 20000] if options.quick else [5000, 50000, 500000]
    by_size = {points: run_benchmark(points, 10, rounds)[0]
               for points in sizes}
    middle = by_size[sizes[1]]
    sets = sets_in(middle)
    memory = max(bandwidth_of(middle, s) for s in sets)
    report.say("Measured with the kernels' flags: a loop over the blocks that "
               "reads the twelve and writes the eleven fields which grid to "
               "points does and computes nothing (GB/s, 16 points per cell, by "
               "number of points), and multiplications with an addition each "
               "in registers (thousand million operations per second).")
    report.table("limits", ["instruction set"]
                 + [f"{n:,} points" for n in sizes] + ["arithmetic"],
                 [[s] + [bandwidth_of(by_size[n], s) for n in sizes]
                  + [2e-3 * middle[s, 0, 0., "multiply_and_add"]]
                  for s in sets])
    rows = []
    for name in ("grid_to_points", "points_to_grid"):
        for s in sets:
            for n in POINTS_PER_CELL:
                size, *rate = bounds(middle, name, n, s, memory)
                rows.append([PLAIN[name], s, n, size] + rate
                            + [rate[0] / min(rate[1:])])
    report.say(f"The kernels at {sizes[1]:,} points, elastic, in million points "
               "per second. Bytes and operations per point are counted in the "
               "source (scripts/speed_kernels.py lists them), with empty lanes "
               "and what a cell adds; the bound by memory takes the fastest of "
               "these loops. The bounds suppose that nothing waits: "
               "no latency, division, root, shuffle or look-up, and as many "
               "multiplications as additions.")
    report.table("roofline",
                 ["kernel", "instruction set", "points per cell",
                  "bytes per point", "measured", "bound by memory",
                  "bound by arithmetic", "measured / lower bound"], rows)
    report.picture(draw_roofline(middle, sets, memory), "Bounds of the kernels")
    report.write()
