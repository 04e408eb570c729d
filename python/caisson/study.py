# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies: many runs of a scene with entries changed, and what they are for.

A file (TOML) says what it is for, kind = "parameters", and holds studies, or is one
itself if it holds none (its id is then its name):

    [[study]]
    id = "name"             # of its results: results/KIND/ID/RUN
    title = "text"          # for tables and pictures
    scene = "wave.prm"      # relative to the file
    set = {"Section/Entry" = value}   # entries of all its runs
    seconds = 2             # about how long a run takes; the longest start first.
                            # Without it the program is asked
    ranks = 4               # default: what is fastest for all runs; binding = "core"
                            # or "none" (default)
    reference = {"Section/Entry" = value}   # one more run, called reference, of the
                            # scene with these entries

The table `set` at the head of the file serves all studies. Entries of a run are set in
the order file, study, run; the last one counts.

The runs are made by the kind, from keys of its own, which its module names
(caisson.study_command has the modules). A key that is not known is an error, so that no
misspelled one is left out in silence. Studies of the laboratory may list their runs:
lab.study.

A run that is complete is not repeated while the program, all entries in effect
and the ranks are the same (caisson.runner.Run). One of a user's study that was stopped
goes on from its checkpoint.
"""
import collections
import re
import tomllib
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from caisson.paths import PROGRAM
from caisson.runner import Entries, Run
from caisson.runs import StudyRun
from caisson import disk
from caisson.disk import InputError

# makes the runs, as lists of their keys, of a study's keys, scene and entries
MakeRuns = Callable[[dict[str, Any], Run], list[dict[str, Any]]]
REFERENCE = "reference"


class StudyError(InputError):
    """What is wrong with a study file; the text is for the user."""


@dataclass
class Study:
    """One study: its runs, and the keys of its kind."""

    id: str
    title: str
    file: Path
    runs: list[StudyRun]
    keys: dict[str, Any] = field(default_factory=dict)

    def run(self, name: str) -> StudyRun:
        """Return the run of this name. Raises StudyError."""
        for run in self.runs:
            if run.name == name:
                return run
        names = ", ".join(run.name for run in self.runs)
        raise StudyError(f"{self.id} has no run {name!r}, only {names}")


@dataclass(frozen=True)
class Options:
    """What makes the runs, and where."""

    program: Path = PROGRAM
    results: Path = Path()


class Reader:
    """Makes studies of a file."""

    file_keys = {"kind", "set", "study"}
    study_keys = set("id title scene set seconds reference".split())
    shared_keys = {"ranks", "binding"}  # of the runs, too

    def __init__(
        self,
        file: Path,
        options: Options,
        own_keys: set[str],
        make_runs: MakeRuns | None = None,
    ) -> None:
        """own_keys: of a study of the kind, beside those that all have; make_runs:
        makes the runs of a study."""
        self.file, self.options = file, options
        self.known = self.study_keys | self.shared_keys | own_keys
        self.own_keys, self.make_runs = own_keys, make_runs
        self.content = read_toml(file)
        self.set: Entries = self.content.get("set", {})

    def tables(self) -> list[dict[str, Any]]:
        """Return the keys of each study. Raises StudyError."""
        if "study" in self.content:
            self.refuse_unknown(self.content, self.file_keys, "the file")
            return list(self.content["study"])
        one = {k: v for k, v in self.content.items() if k not in ("kind", "set")}
        return [{"id": self.file.stem, "title": self.file.stem, **one}]

    def studies(self) -> list[Study]:
        """Return the studies. Raises StudyError."""
        found = [self.study(table) for table in self.tables()]
        places = collections.Counter(run.run.directory for s in found for run in s.runs)
        for place, count in places.items():
            if count > 1:
                raise StudyError(f"{self.file}: {count} runs would write into {place}")
        return found

    def refuse_unknown(self, table: dict[str, Any], known: set[str], of: str) -> None:
        """Raise StudyError for a key that is not known."""
        unknown = sorted(set(table) - known)
        if unknown:
            names = ", ".join(unknown)
            raise StudyError(
                f"{self.file}: {of} has no key {names}; known: "
                + ", ".join(sorted(known))
            )

    def study(self, table: dict[str, Any]) -> Study:
        """Return one study."""
        name = table.get("id")
        if not isinstance(name, str) or not name or not name.isprintable():
            raise StudyError(f"{self.file}: a study has no id, or not one line of text")
        entries = {**self.set, **table.get("set", {})}
        runs = self.runs_of(table, entries)
        if REFERENCE in table:
            entries = {**entries, **table[REFERENCE]}
            runs.append(self.one_run(table, {}, REFERENCE, entries))
        keys = {k: v for k, v in table.items() if k in self.own_keys}
        title = disk.one_line(str(table.get("title", name)))
        return Study(name, title, self.file, runs, keys)

    def runs_of(self, study: dict[str, Any], entries: Entries) -> list[StudyRun]:
        """Return the runs that the kind makes for a study with these entries."""
        self.refuse_unknown(study, self.known, f"study {study['id']}")
        scene = self.one_run(study, {}, "", entries).run
        assert self.make_runs is not None
        try:
            made = self.make_runs(study, scene)
        except StudyError as error:
            raise StudyError(f"{self.file}: study {study['id']}: {error}") from error
        return [
            self.one_run(study, run, run["name"], {**entries, **run.get("set", {})})
            for run in made
        ]

    def one_run(
        self, study: dict[str, Any], run: dict[str, Any], name: str, entries: Entries
    ) -> StudyRun:
        """Return one run with its directory."""
        scene = run.get("scene", study.get("scene"))
        if scene is None:
            raise StudyError(f"{self.file}: a run of {study['id']} has no scene")
        directory = self.options.results / file_name(study["id"]) / file_name(name)
        both = {**study, **run}
        settings = {k: v for k, v in both.items() if k not in self.study_keys}
        made = Run(
            (self.file.parent / scene).resolve(),
            entries,
            directory.resolve(),
            ranks=settings.get("ranks", 1),
            binding=settings.get("binding", "none"),
            program=self.options.program,
        )
        seconds = both.get("seconds", 0)
        return StudyRun(study["id"], name, made, settings, seconds=seconds)


@disk.reads
def read_toml(file: Path) -> dict[str, Any]:
    """Return the content of a study file. Raises StudyError."""
    try:
        return tomllib.loads(disk.read_text(file, StudyError))
    except (ValueError, RecursionError) as error:
        raise StudyError(f"{file}: {error}") from error


def file_name(text: str) -> str:
    """Return a text as the name of a file or directory. Raises StudyError where it
    would be another directory, as .. is."""
    name = re.sub(r"[^\w.-]+", "_", text)
    if text and not name.strip("."):
        raise StudyError(f"{text!r} is no name for a directory: use letters or digits")
    return name
