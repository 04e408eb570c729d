# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that belong to one scene, with their pages.

A band: the scene and those of low and high resistance, at the same time, one core each;
the page of the best one has all three. Phases (Installation/Phases): the scene, of a
band the best one, and what follows it; its page has a row for each phase.
"""
import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

from caisson import disk, phases, report
from caisson.band import BEST, ESTIMATES, HIGH, LOW, member_of
from caisson.command_line import Parser
from caisson.phases import END, ENTRY, Phase
from caisson.progress import span
from caisson.ranks import cores
from caisson.results import ResultsError
from caisson.runner import Run, RunError, Status
from caisson.runs import ENDED_EARLY, How, StudyRun, make, survey

AGAIN = "--overwrite computes the scene and its phases again"
QUERIES = {"--validate", "--print-parameters", "--explain", "--version", "--help", "-h"}
Draw = Callable[[Path, Path | None], None]
Reporting = Callable[[Path], AbstractContextManager[None]]


def options_of(
    words: Sequence[str], taker: str = "--band", further: Sequence[str] = ()
) -> argparse.Namespace:
    """Return the options of the program that several runs take, with further ones; set
    has the entries that they give. Raises RunError."""
    parser = Parser(prog="caisson run", add_help=False, allow_abbrev=False)
    for name in further:
        parser.add_argument(name)
    for name in ("--restart", "--overwrite"):
        parser.add_argument(name, action="store_true")
    parser.add_argument("--set", action="append", default=[])
    found, other = parser.parse_known_args(words)
    if other:
        raise RunError(
            f"{taker} takes {', '.join([*further, '--set'])}, --restart and"
            f" --overwrite, not {other[0]}. Write the entries that you change into the"
            " scenes"
        )
    pairs = (text.split("=", 1) for text in found.set if "=" in text)
    found.set = {name.strip(): value.strip() for name, value in pairs}
    return found


def what_becomes_of(member: StudyRun, is_to_do: bool) -> str:
    """Return in words whether a run is computed, and from where."""
    if not is_to_do:
        return "complete, and not repeated; --overwrite repeats it"
    size = member.size
    about = f", {span(size.least, size.seconds)}" if size.seconds else ""
    if member.run.restarts:
        return f"from its checkpoint{about}"
    return f"from its start{about}{hint_on(member)}"


def hint_on(member: StudyRun) -> str:
    """Return how a run goes on where it can."""
    return "; --restart resumes it" if member.run.has_checkpoint else ""


def status_of(member: StudyRun) -> Status:
    """Return the exit status of a run, a failure where it has left no record."""
    if member.is_stopped:
        return Status.STOPPED
    return Status.FAILURE if member.status is None else member.status


def scenes_of(best: Path) -> dict[str, Path]:
    """Return the scenes of a band by estimate, as far as there are such. Raises
    RunError without any beside the best one."""
    members = {estimate: member_of(best, estimate) for estimate in ESTIMATES}
    found = {e: path for e, path in members.items() if path.is_file()}
    if BEST not in found:
        raise RunError(f"there is no scene {best}")
    if len(found) == 1:
        raise RunError(
            f"beside {best} there is neither {members[LOW].name} nor"
            f" {members[HIGH].name}: caisson suggest --spread, or --low and --high,"
            " writes them"
        )
    return found


def compute_band(runs: dict[str, StudyRun], options: argparse.Namespace) -> None:
    """Compute what is missing, one core each. Raises RunError where the program refuses
    a run."""
    for member in runs.values():
        member.run.is_of_user, member.run.overwrites = True, options.overwrite
    to_do = survey(list(runs.values()), options.overwrite, asks_all=True)
    for member in to_do:
        if member.refusal:
            raise RunError(member.refusal)
        member.run.restarts = options.restart and member.run.has_checkpoint
    for member in runs.values():
        text = what_becomes_of(member, member in to_do)
        print(f"run: {member.name}: {text}", flush=True)
    make(to_do, How(again=True, jobs=min(3, cores())))


def run_band(
    words: Sequence[str],
    draw: Callable[[Path, None, bool], None],
    reporting: Reporting,
) -> int:
    """Run a band and draw it, the best run last and in full; return the largest exit
    status. words: the best scene, and options of the program; draw: draws a run;
    reporting: renews the page of the best one as long as it runs. Raises RunError."""
    best, options = Path(words[0]), options_of(words[1:])
    directory, runs = Run(best, options.set).directory, dict[str, StudyRun]()
    for estimate, scene in scenes_of(best).items():
        place = member_of(directory, estimate).resolve()
        runs[estimate] = StudyRun(
            "run:", scene.stem, Run(scene.resolve(), options.set, place)
        )
    with reporting(runs[BEST].run.directory):
        try:
            compute_band(runs, options)
        except KeyboardInterrupt:
            print("run: stopped; --restart resumes", file=sys.stderr)
            return Status.STOPPED
    for estimate in (LOW, HIGH, BEST):
        if estimate in runs and runs[estimate].status is not None:
            draw(runs[estimate].run.directory, None, estimate == BEST)
    for member in runs.values():
        if member.trouble:
            text = f"{member.trouble}{hint_on(member)}"
            print(f"run: {member.name}: {text}", file=sys.stderr)
    return max(map(status_of, runs.values()))


def phases_asked_for(words: Sequence[str], entries: Mapping[str, str]) -> list[Phase]:
    """Return the phases of a scene with these entries in effect; none where the words
    behind it only ask something. Raises RunError where the scene cannot have them."""
    found = phases.phases_in(entries.get(ENTRY, ""))
    phases.refuse_faults(found, entries)
    return [] if QUERIES & set(words) else found


class Chain:
    """The runs of a scene and its phases."""

    def __init__(
        self,
        words: Sequence[str],
        entries: Mapping[str, str],
        ranks: int | None,
        error_bar: Path | None,
    ) -> None:
        """words: the scene, and options of the program; entries: those in effect;
        error_bar: of the scene."""
        own = options_of(words[1:], ENTRY, ["--output-directory"])
        self.given, self.again, self.restarts = own.set, own.overwrite, own.restart
        self.scene, self.entries = Path(words[0]).resolve(), entries
        self.ranks, self.error_bar = ranks, error_bar
        place = own.output_directory or entries["Output/Directory"]
        self.directory = Path(place).resolve()
        self.title = entries.get("Title") or self.scene.stem
        self.phases = phases.phases_in(entries[ENTRY])

    def member(self, name: str, directory: Path, **more: object) -> StudyRun:
        """Return a run with further entries."""
        entries = {**self.given, **more}
        run = Run(self.scene, entries, directory, ranks=self.ranks or 1)
        run.is_of_user, run.overwrites = True, self.again
        return StudyRun("run:", name, run, {"ranks": self.ranks} if self.ranks else {})

    def refuse_way(self) -> None:
        """Refuse phases that go where the mesh of the scene does not, before anything
        is run. Raises RunError."""
        deepest = phases.refuse_faults(self.phases, self.entries)
        end = self.entries[END]
        if deepest > (0.0 if end == "never" else float(end)):
            try:
                Run(self.scene, {**self.given, END: deepest}, self.directory).validate()
            except RunError as error:
                said = str(error).rpartition("bad input: ")[2].splitlines()[0]
                raise RunError(f"{ENTRY} goes to {deepest:g} m: {said}") from error

    def phase(self, number: int, before: Path) -> StudyRun:
        """Return the run of a phase, of which the scene is number 1. Raises RunError
        where the run before it cannot be read."""
        part = self.phases[: number - 1]
        name = phases.folder_of(part[-1], number)
        try:
            entries = phases.entries_of(part, before, self.entries, self.title)
        except ResultsError as error:
            raise RunError(f"{error}; {AGAIN}") from error
        return self.member(name, self.directory / name, **entries)

    def make(self, draw: Draw, reporting: Reporting, has_scene: bool) -> Status:
        """Compute what is missing; return the status of the last run."""
        member = self.member(self.scene.stem, self.directory)
        for number in range(1, len(self.phases) + 2):
            if number > 1:
                member = self.phase(number, member.run.directory)
            again = self.again and (number > 1 or not has_scene)
            is_new = compute(member, again, self.restarts and number == 1, reporting)
            if number == 1 and self.directory.is_dir():
                text = ", ".join(phase.text for phase in self.phases)
                disk.write(self.directory / phases.LIST, f"{text}\n")
            if has_results(member) and (
                is_new or not report.is_up_to_date(member.run.directory)
            ):
                draw(member.run.directory, self.error_bar if number == 1 else None)
            if (status := status_of(member)) != Status.SUCCESS:
                say_end(member)
                break
        return status

    def main(self, draw: Draw, reporting: Reporting, has_scene: bool = False) -> int:
        """Compute what is missing, and renew the page of the scene; return the exit
        status of the last run. draw: draws a run, with an error bar; reporting: renews
        a page as long as its run goes on; has_scene: that one was computed before, in a
        band, and is not repeated."""
        if disk.is_locked(self.directory):
            raise RunError(
                f"another run computes in {self.directory}; wait for its end, or choose"
                " another folder with --output-directory"
            )
        self.refuse_way()
        status = self.make(draw, reporting, has_scene)
        if (self.directory / "history.csv").is_file():
            print(f"report: {report.write(self.directory)}")
        return status


def compute(
    member: StudyRun, again: bool, restarts: bool, reporting: Reporting
) -> bool:
    """Compute a run unless it is complete, from its checkpoint if it has one that is of
    the same run, or if it restarts; return whether that was done."""
    to_do = survey([member], again, resumes=True)
    member.run.restarts |= restarts and member.run.has_checkpoint
    is_said = restarts or not to_do
    words = f": {what_becomes_of(member, bool(to_do))}" if is_said else ""
    print(f"run: {member.name}{words}", flush=True)
    if to_do:
        try:
            with reporting(member.run.directory):
                make(to_do, How(again=True))
        except KeyboardInterrupt:
            member.is_stopped = True
    return bool(to_do)


def has_results(member: StudyRun) -> bool:
    """Return whether a run has left something to draw: one that was refused has not,
    though its folder may have what another one has left."""
    history = member.run.directory / "history.csv"
    return history.is_file() and (member.is_stopped or member.status is not None)


def say_end(member: StudyRun) -> None:
    """Say why no phase follows a run that has not succeeded."""
    why = member.trouble or f"{member.last_words}, see {member.log}"
    before = member.run.entries.get(Run.BEFORE)
    if member.is_stopped:
        why = "stopped; the same command goes on"
    elif before and not (Path(before) / Run.CHECKPOINT).is_file():
        why = f"{why}; {AGAIN}"
    elif why.startswith(ENDED_EARLY):
        why = f"{why}; the same command goes on"
    print(f"run: {member.name}: {why}", file=sys.stderr)
