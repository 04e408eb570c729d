# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that are killed at any moment and continued: their results must be those of
the undisturbed run, to the last bit."""
import shutil
from pathlib import Path

from caisson.paths import PROGRAM
from caisson.runner import Status, set_options
from caisson_workshop.faults.campaign import Part, Result
from caisson_workshop.faults.process import Outcome, call
from caisson_workshop.faults.states import CASES, Case, difference, state_of

MOST_RUNS = 30  # of a trial, then something is wrong with it
KILL = -9


class Kills(Part):
    """Each case in turn. Some of the runs that go on are killed, too.

    Trials run side by side, and are slower than the undisturbed run.
    """

    name = "kills"

    def prepare(self) -> None:
        """Make the undisturbed runs."""
        self.whole: dict[str, tuple[Path, float]] = {}
        for case in CASES:
            path = self.directory / f"whole_{case.name}"
            shutil.rmtree(path, ignore_errors=True)
            outcome = self.run(case, path)
            assert outcome.status == Status.SUCCESS, outcome.words
            self.whole[case.name] = path, outcome.wall_s

    def run(
        self,
        case: Case,
        path: Path,
        restart: bool = False,
        kill_after: float | None = None,
    ) -> Outcome:
        """Run a case."""
        words = [PROGRAM, case.scene, "--output-directory", path]
        words += set_options(
            case.entries | {"Output/Checkpoint interval": case.interval}
        )
        words += ["--restart"] * restart
        return call(words, self.directory, kill_after=kill_after)

    def attempt(self, number: int, directory: Path) -> Result:
        """Kill a run until it is finished, or has been killed twice."""
        source, case = self.random(number), CASES[number % len(CASES)]
        whole, seconds = self.whole[case.name]
        path = directory / "results"
        n_kills = source.choice((1, 1, 2))
        calls: list[Outcome] = []
        kind = "went on"
        restart = False
        while len(calls) < MOST_RUNS:
            kill = source.uniform(0.5, 1.2) * seconds if len(calls) < n_kills else None
            calls.append(self.run(case, path, restart, kill))
            last = calls[-1]
            if last.status == KILL and kill is not None:
                restart = True
                continue
            if last.complaint():
                return Result("", last.complaint(), tuple(calls))
            if last.status == Status.SUCCESS:
                break
            if last.status != Status.BAD_INPUT or state_of(path):
                return Result("", f"exit status {last.status}", tuple(calls))
            kind, restart = "begun again, without a checkpoint", False
            n_kills = 0
        if not any(c.status == KILL for c in calls):
            kind = "finished before"
        return Result(kind, difference(whole, path), tuple(calls))
