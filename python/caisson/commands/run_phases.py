# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of a scene and of the phases that follow it (Installation/Phases), one after
the other, each with its page; that of the scene has a row for each phase."""
import sys
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

from caisson import disk, phases, report
from caisson.commands.run_band import options_of, status_of, what_becomes_of
from caisson.phases import END, ENTRY, Phase
from caisson.results import ResultsError
from caisson.runner import Run, RunError, Status
from caisson.runs import How, StudyRun, make, survey

AGAIN = "--overwrite computes the scene and its phases again"
QUERIES = {"--validate", "--print-parameters", "--explain", "--version", "--help", "-h"}
Draw = Callable[[Path, Path | None], None]
Reporting = Callable[[Path], AbstractContextManager[None]]


def asked_for(words: Sequence[str], entries: Mapping[str, str]) -> list[Phase]:
    """Return the phases of a scene with these entries in effect; none where the words
    behind it only ask something. Raises RunError where the scene cannot have them."""
    found = phases.phases_in(entries.get(ENTRY, ""))
    phases.refuse_faults(found, entries)
    return [] if QUERIES & set(words) else found


def compute(member: StudyRun, again: bool, resumes: bool, reporting: Reporting) -> bool:
    """Compute a run unless it is complete; return whether that was done. resumes: from
    a checkpoint, if there is one."""
    to_do = survey([member], again, resumes)
    if not to_do:
        print(f"run: {member.name}: {what_becomes_of(member, False)}", flush=True)
        return False
    print(f"run: {member.name}", flush=True)
    try:
        with reporting(member.run.directory):
            make(to_do, How(again=True))
    except KeyboardInterrupt:
        member.is_stopped = True
    return True


def has_results(member: StudyRun) -> bool:
    """Return whether a run has left something to draw: one that was refused has not,
    though its folder may have what another one has left."""
    history = member.run.directory / "history.csv"
    return history.is_file() and (member.is_stopped or member.status is not None)


def say_end(member: StudyRun) -> None:
    """Say why no phase follows a run that has not succeeded."""
    why = member.trouble or f"{member.last_words}, see {member.log}"
    if member.is_stopped:
        why = "stopped; the same command goes on"
    elif member.run.entries.get("Installation/Directory") and not has_results(member):
        why = f"{why} {AGAIN}"
    print(f"run: {member.name}: {why}", file=sys.stderr)


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
        pairs = (text.split("=", 1) for text in own.set if "=" in text)
        self.given = {name.strip(): value.strip() for name, value in pairs}
        self.scene, self.entries = Path(words[0]).resolve(), entries
        self.again: bool = own.overwrite
        self.ranks, self.error_bar = ranks, error_bar
        place = own.output_directory or entries["Output/Directory"]
        self.directory = Path(place).resolve()
        self.title = entries.get("Title") or self.scene.stem
        self.phases = phases.phases_in(entries[ENTRY])

    def member(self, name: str, directory: Path, **more: object) -> StudyRun:
        """Return a run with further entries."""
        entries = {**self.given, **more}
        run = Run(self.scene, entries, directory, ranks=self.ranks or 1)
        settings = {"ranks": self.ranks} if self.ranks else {}
        return StudyRun("run:", name, run, settings)

    def refuse_way(self) -> None:
        """Refuse phases that go where the mesh of the scene does not, before anything
        is run. Raises RunError."""
        deepest, end = (
            phases.refuse_faults(self.phases, self.entries),
            self.entries[END],
        )
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

    def make(self, draw: Draw, reporting: Reporting) -> Status:
        """Compute what is missing; return the status of the last run."""
        list_path = self.directory / phases.LIST
        member, was_made = self.member(self.scene.stem, self.directory), False
        for number in range(1, len(self.phases) + 2):
            if number > 1:
                member = self.phase(number, member.run.directory)
            again = self.again or was_made
            is_new = compute(member, again, not was_made, reporting)
            was_made = was_made or is_new
            if number == 1 and self.directory.is_dir():
                disk.write(list_path, ", ".join(x.text for x in self.phases) + "\n")
            page = member.run.directory / report.NAME
            if has_results(member) and (is_new or not page.is_file()):
                draw(member.run.directory, self.error_bar if number == 1 else None)
            if (status := status_of(member)) != Status.SUCCESS:
                say_end(member)
                break
        return status

    def main(self, draw: Draw, reporting: Reporting) -> int:
        """Compute what is missing, and renew the page of the scene; return the exit
        status of the last run. draw: draws a run, with an error bar; reporting: renews
        a page as long as its run goes on."""
        self.refuse_way()
        status = self.make(draw, reporting)
        if (self.directory / "history.csv").is_file():
            print(f"report: {report.write(self.directory)}")
        return status
