# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies: many runs of scenes with entries changed, and what they are for.

All studies have one format. A file (TOML) says what it is for,

    kind = "parameters"     # or one of the laboratory: verification, validation,
                            # accuracy, error bar, stability, forces, drainage,
                            # tension, speed

and holds studies, or is one itself if it holds none (its id is then its name):

    [[study]]
    id = "name"             # of its results: results/KIND/ID/RUN
    title = "text"          # for tables and pictures
    scene = "wave.prm"      # relative to the file
    set = {"Section/Entry" = value}   # entries of all its runs
    seconds = 2             # about how long a run takes; the longest start first.
                            # Without it the program is asked
    quick = true            # taken with --quick; or a table of the keys that
                            # replace those of the study then
    runs = [{...}]          # one run of the scene as it is, if left out
    variants = ["name"]     # each run with each of these choices, "" being none;
                            # a run may have its own list
    meshes = {"name" = {"Section/Entry" = value}}   # ... and on each mesh
    reference = {"Section/Entry" = value}   # one more run, called reference, of the
                            # scene with these entries

A run has the keys

    name        default: its number, from 0
    scene, set, seconds     as above, for this run
    h           size of a cell, for orders of convergence
    ranks       default: what is fastest for all runs; binding = "core" or "none"
                            # (default)
    until       stops the run at this time of the scene (s), and
    stop_after  after these seconds of stepping (kind "speed"); all four also for
                all runs of a study

Tables at the head of the file serve all studies: `set`, and [variants], which
gives the choices their names: NAME = {"Section/Entry" = value}. Entries of a run
are set in the order file, study, run, mesh, variant; the last one counts. The
name of a run is made of its variant, mesh and own name, as far as it has them.

A file that is one study takes all of its [variants].

What a study is for takes further keys, of the study or its runs; the module of each
kind says which (caisson.study_command and lab.study_command name it). A kind may make
the runs of a study itself, from keys of its own. A key that is not known is an error,
so that no misspelled one is left out in silence.

A run that is complete is not repeated while the program, all entries in effect
and the ranks are the same (caisson.runner.Run). One of a user's study that was stopped
goes on from its checkpoint.
"""
import collections
import re
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from caisson.paths import PROGRAM
from caisson.runner import Entries, Run
from caisson.runs import StudyRun
from caisson import disk
from caisson.disk import InputError

FILE_KEYS = {"kind", "set", "variants", "study"}
STUDY_KEYS = set(
    "id title scene set seconds quick runs variants meshes reference".split()
)
RUN_KEYS = set(
    "name scene set seconds variants h ranks binding until stop_after".split()
)
SHARED_KEYS = set("h ranks binding until stop_after".split())

# makes the runs, as lists of their keys, of a study's keys, scene and entries
MakeRuns = Callable[[dict[str, Any], Run], list[dict[str, Any]]]


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
    """What is asked of the command line."""

    only: str = ""  # regular expression for id and title
    quick: bool = False
    program: Path = PROGRAM
    results: Path = Path()


class Reader:
    """Makes studies of a file."""

    def __init__(
        self,
        file: Path,
        options: Options,
        study_keys: set[str],
        run_keys: set[str],
        make_runs: MakeRuns | None = None,
    ) -> None:
        """study_keys, run_keys: of the kind, beside those that all have; make_runs:
        where the kind makes the runs, which then are no key of the study."""
        self.file, self.options = file, options
        self.study_keys, self.run_keys = study_keys, run_keys
        self.make_runs = make_runs
        self.content = read_toml(file)
        self.set: Entries = self.content.get("set", {})
        self.variants: dict[str, Entries] = {"default": {}}
        self.variants |= self.content.get("variants", {})

    def studies(self) -> list[Study]:
        """Return the studies that are asked for. Raises StudyError."""
        content = dict(self.content)
        if "study" in content:
            self.refuse_unknown(content, FILE_KEYS, "the file")
            tables = content["study"]
        else:
            one = {k: v for k, v in content.items() if k not in ("kind", "set")}
            tables = [{"id": self.file.stem, "title": self.file.stem, **one}]
        found = [self.study(table) for table in tables if self.is_asked_for(table)]
        places = collections.Counter(run.run.directory for s in found for run in s.runs)
        for place, count in places.items():
            if count > 1:
                raise StudyError(f"{self.file}: {count} runs would write into {place}")
        return found

    def is_asked_for(self, table: dict[str, Any]) -> bool:
        """Return whether the study fits the options."""
        if self.options.quick and not table.get("quick", False):
            return False
        texts = (table.get("id", ""), table.get("title", ""))
        return any(re.search(self.options.only, str(text)) for text in texts)

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
        if self.options.quick and isinstance(table["quick"], dict):
            table = {**table, **table["quick"]}
        of = f"study {table['id']}"
        known = STUDY_KEYS | SHARED_KEYS | self.study_keys
        if self.make_runs is not None:
            known -= {"runs", "variants", "meshes"}
        self.refuse_unknown(table, known, of)
        if self.make_runs is not None:
            table = {**table, "runs": self.made_runs(table)}
        runs = []
        for number, run in enumerate(table.get("runs", [{}])):
            self.refuse_unknown(run, RUN_KEYS | self.run_keys, f"a run of {of}")
            runs += list(self.runs(table, {"name": str(number), **run}))
        if "reference" in table:
            entries = {**self.set, **table.get("set", {}), **table["reference"]}
            runs.append(self.one_run(table, {}, "", "reference", entries))
        keys = {k: v for k, v in table.items() if k in self.study_keys}
        title = disk.one_line(str(table.get("title", table["id"])))
        return Study(table["id"], title, self.file, runs, keys)

    def made_runs(self, study: dict[str, Any]) -> list[dict[str, Any]]:
        """Return the runs that the kind makes for a study."""
        entries = {**self.set, **study.get("set", {})}
        scene = self.one_run(study, {}, "", "", entries).run
        assert self.make_runs is not None
        try:
            return self.make_runs(study, scene)
        except StudyError as error:
            raise StudyError(f"{self.file}: study {study['id']}: {error}") from error

    def runs(self, study: dict[str, Any], run: dict[str, Any]) -> Iterator[StudyRun]:
        """Yield a run on each mesh with each variant."""
        for variant in run.get("variants", study.get("variants", [""])):
            if variant and variant not in self.variants:
                raise StudyError(f"{self.file}: {study['id']}: no variant {variant!r}")
            for mesh, on_mesh in study.get("meshes", {"": {}}).items():
                entries = {
                    **self.set,
                    **study.get("set", {}),
                    **run.get("set", {}),
                    **on_mesh,
                    **self.variants.get(variant, {}),
                }
                yield self.one_run(study, run, variant, mesh, entries)

    def one_run(
        self,
        study: dict[str, Any],
        run: dict[str, Any],
        variant: str,
        mesh: str,
        entries: Entries,
    ) -> StudyRun:
        """Return one run with its directory."""
        scene = run.get("scene", study.get("scene"))
        if scene is None:
            raise StudyError(f"{self.file}: a run of {study['id']} has no scene")
        parts = [part for part in (variant, mesh) if part]
        if "runs" in study and "name" in run:
            parts.append(run["name"])
        name = "_".join(parts)
        directory = self.options.results / file_name(study["id"]) / file_name(name)
        settings = {k: v for k, v in {**study, **run}.items() if k not in STUDY_KEYS}
        made = Run(
            (self.file.parent / scene).resolve(),
            entries,
            directory.resolve(),
            ranks=settings.get("ranks", 1),
            binding=settings.get("binding", "none"),
            program=self.options.program,
        )
        seconds = run.get("seconds", study.get("seconds", 0))
        return StudyRun(study["id"], name, made, settings, variant, mesh, seconds)


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
