# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of the program that are timed.

A run is stopped by its stop file once it has come as far as asked, so that the
whole path of the caisson is seeded with points whatever piece of it is run. Its
cost is the sum of the sections of its steps (run.json): set-up, the first
frame and the checkpoint at the end do not count.
"""
import statistics
import subprocess
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from caisson.paths import ROOT
from caisson.results import Results, Table
from caisson.runner import Status, environment
from caisson.runs import StudyRun
from caisson.study import Study, StudyError

POLL = 0.1  # s


class Measured:
    """What a run has left behind; kept, because the next round overwrites it."""

    def __init__(self, directory: Path) -> None:
        results = Results(directory)
        self.summary: dict[str, Any] = results.summary
        self.history: Table = results.history
        self.points: int = self.summary["material_points"]
        self.steps: int = self.summary["steps"]
        self.sections: dict[str, float] = self.summary["sections"]

    def seconds(self, without: Sequence[str] = ()) -> float:
        """Return the time of all steps, without some sections."""
        return sum(
            seconds for name, seconds in self.sections.items() if name not in without
        )

    def seconds_per_step(self, without: Sequence[str] = ()) -> float:
        """Return the mean time of a step."""
        return self.seconds(without) / self.steps

    def ns_per_point_step(self, without: Sequence[str] = ()) -> float:
        """Return the time of a step over the number of points, in ns."""
        return 1e9 * self.seconds_per_step(without) / self.points


Value = Callable[[Measured], float]


def last_time(history: Path) -> float | None:
    """Return the time of the last complete row, None where there is none yet."""
    if not history.exists():
        return None
    rows = history.read_text(encoding="utf-8").split("\n")[1:-1]
    return float(rows[-1].split(",")[0]) if rows else None


def stop_in_time(process: "subprocess.Popen[bytes]", run: StudyRun) -> None:
    """Wait until the run has come far enough, then ask it to stop."""
    directory, begin = run.run.directory, 0.0
    after = run.settings.get("stop_after")
    while process.poll() is None:
        time.sleep(POLL)
        now = last_time(directory / "history.csv")
        if now is None:
            continue
        begin = begin or time.monotonic()
        come = now if after is None else time.monotonic() - begin
        if come >= (run.settings["until"] if after is None else after):
            (directory / "stop").touch()
            return


def execute(run: StudyRun) -> Measured:
    """Make the run and return what it measured. Raises StudyError."""
    directory = run.run.directory
    directory.mkdir(parents=True, exist_ok=True)
    (directory / "stop").unlink(missing_ok=True)  # of a run that ended before it
    command = [*run.run.command(), "--overwrite"]
    with open(directory / "log", "w", encoding="utf-8") as log:
        process = subprocess.Popen(
            command, stdout=log, stderr=log, cwd=ROOT, env=environment()
        )
        if run.settings.keys() & {"until", "stop_after"}:
            stop_in_time(process, run)
    if process.wait() not in (Status.SUCCESS, Status.STOPPED):
        raise StudyError(f"speed: {run.name} failed, see {directory / 'log'}")
    for checkpoint in directory.glob("checkpoint*"):
        checkpoint.unlink()
    return Measured(directory)


def interleave(study: Study, runs: Sequence[StudyRun] | None = None) -> "Rounds":
    """Return the results of each run of a study: rounds of all of them, A B C A B C."""
    chosen = study.runs if runs is None else runs
    repeats = study.keys.get("repeats", 1)
    results: Rounds = {run.name: [] for run in chosen}
    for i in range(repeats):
        for run in chosen:
            start = time.monotonic()
            results[run.name].append(execute(run))
            seconds = time.monotonic() - start
            print(
                f"{study.id}, {run.name}, round {i + 1} of {repeats}: {seconds:.1f} s"
            )
    return results


Rounds = dict[str, list[Measured]]  # the results of each round by name of the run


def median(results: Sequence[Measured], value: Value) -> float:
    """Return the median of a value over the rounds."""
    return statistics.median(value(result) for result in results)


def median_ratio(
    results: Sequence[Measured], base: Sequence[Measured], value: Value
) -> float:
    """Return the median of the ratios to the result of the base in the same round."""
    return statistics.median(value(a) / value(b) for a, b in zip(results, base))
