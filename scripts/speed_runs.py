# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program and of the kernels' benchmark that are timed, for
scripts/speed.

A run is stopped by its stop file once it has come as far as asked, so that the
whole path of the caisson is seeded with points whatever piece of it is run. Its
cost is the sum of the sections of its steps (run.json): set-up, the first
frame and the checkpoint at the end do not count.
"""
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/caisson_mpm"
KERNELS = ROOT / "build/release/kernel_benchmark"
RESULTS = ROOT / "results/speed"
JACK = ROOT / "prm/jack.prm"
INSTRUCTION_SETS = ["SSE2", "AVX2", "AVX-512"]
STOPPED = 3
# and all points from the start, so that their number does not change
QUIET = {"Material points/Split and merge": "false",
         "Output/Frame interval": 0, "Output/Frame penetrations": "",
         "Output/Error bar": "", "Output/Terminal": "plain"}
# half as many cells across the wall as prm/jack.prm has, and fewer points
FEWER_CELLS = {"Rigid body/Cells across the wall": 2,
               "Material points/Per direction in path": 5,
               "Material points/Per direction near": 2}


class Run:
    """A call of the program with some entries set, up to a time of the scene,
    for some seconds of stepping, or to its end."""

    def __init__(self, name, entries=None, scene=JACK, until=None, seconds=None,
                 ranks=1, binding="none"):
        self.name, self.scene, self.ranks = name, scene, ranks
        self.until, self.seconds, self.binding = until, seconds, binding
        self.entries = {**QUIET, **(FEWER_CELLS if scene == JACK else {}),
                        **(entries or {})}
        self.directory = RESULTS / "runs" / re.sub(r"[^\w.-]+", "_", name)

    def command(self):
        line = [str(PROGRAM), str(self.scene),
                "--output-directory", str(self.directory)]
        for entry, value in self.entries.items():
            line += ["--set", f"{entry}={value}"]
        if self.ranks == 1:
            return line
        start = ["mpirun", "-np", str(self.ranks)]
        if self.ranks > os.cpu_count():  # waiting ranks must let others compute
            start += ["--oversubscribe", "--bind-to", "none",
                      "--mca", "mpi_yield_when_idle", "1"]
        else:
            start += ["--bind-to", self.binding]
        return start + line

    def execute(self):
        shutil.rmtree(self.directory, ignore_errors=True)
        self.directory.mkdir(parents=True)
        log_file = self.directory / "log"
        with open(log_file, "w", encoding="utf-8") as log:
            process = subprocess.Popen(self.command(), stdout=log, stderr=log,
                                       cwd=ROOT, env=environment())
            if self.until is not None or self.seconds is not None:
                self.stop_in_time(process)
        if process.wait() not in (0, STOPPED):
            sys.exit(f"speed: {self.name} failed, see {log_file}")
        for checkpoint in self.directory.glob("checkpoint*"):
            checkpoint.unlink()
        return Measured(self.directory)

    def stop_in_time(self, process):
        """Waits until the run has come far enough, then asks it to stop."""
        first_row = None
        while process.poll() is None:
            time.sleep(0.1)
            now = last_time(self.directory / "history.csv")
            if now is not None and first_row is None:
                first_row = time.monotonic()
            if now is None:
                continue
            if (now >= self.until if self.seconds is None else
                    time.monotonic() - first_row >= self.seconds):
                (self.directory / "stop").touch()
                return


class Measured:
    """What a run has left behind."""

    def __init__(self, directory):
        self.summary = json.loads((directory / "run.json").read_text())
        self.points = self.summary["material_points"]
        self.steps = self.summary["steps"]
        self.sections = self.summary["sections"]
        self.history = np.genfromtxt(directory / "history.csv", delimiter=",",
                                     names=True)

    def seconds(self, without=()):
        """Of all steps."""
        return sum(seconds for name, seconds in self.sections.items()
                   if name not in without)

    def seconds_per_step(self, without=()):
        return self.seconds(without) / self.steps

    def ns_per_point_step(self, without=()):
        return 1e9 * self.seconds_per_step(without) / self.points


def environment():
    return {**os.environ, "OMP_NUM_THREADS": "1", "DEAL_II_NUM_THREADS": "1",
            "HWLOC_HIDE_ERRORS": "2", "OMPI_ALLOW_RUN_AS_ROOT": "1",
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def last_time(history):
    """Of the last complete row, or None where there is none yet."""
    if not history.exists():
        return None
    rows = history.read_text().split("\n")[1:-1]
    return float(rows[-1].split(",")[0]) if rows else None


def interleave(runs, repeats):
    """The results of each run, by name: rounds of all of them, A B C A B C."""
    results = {run.name: [] for run in runs}
    for i in range(repeats):
        for run in runs:
            start = time.monotonic()
            results[run.name].append(run.execute())
            print(f"{run.name}, round {i + 1} of {repeats}:"
                  f" {time.monotonic() - start:.1f} s", flush=True)
    return results


def median(results, value):
    return statistics.median(value(result) for result in results)


def median_ratio(results, base, value):
    """Of the ratios to the result of the base in the same round."""
    return statistics.median(value(a) / value(b)
                             for a, b in zip(results, base))


def largest_difference(a, b, columns):
    """Of two series of some quantities, over the largest value of each in a."""
    return max(float(abs(a[column] - b[column]).max() / abs(a[column]).max())
               for column in columns)


def machine():
    """The commit and the processor, which a number must stand with."""
    commit = subprocess.run(["git", "describe", "--always", "--dirty"],
                            cwd=ROOT, capture_output=True, text=True,
                            check=False).stdout.strip()
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        model = next((line.split(":")[1].strip() for line in file
                      if line.startswith("model name")), "unknown processor")
    return f"Commit {commit or 'unknown'}, {model}, {os.cpu_count()} cores"
