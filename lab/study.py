# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of the laboratory: as those of users (caisson.study), but a study may list
its runs, each with several variants and on several meshes.

Kinds are verification, validation, accuracy, error bar, stability, forces, drainage,
tension, surface and speed. Beside the keys that all studies have, one of them has

    runs = [{...}]          # one run of the scene as it is, if left out
    variants = ["name"]     # each run with each of these choices, "" being none;
                            # a run may have its own list
    meshes = {"name" = {"Section/Entry" = value}}   # ... and on each mesh
    quick = true            # taken with --quick; or a table of the keys that
                            # replace those of the study then

A run has the keys

    name        default: its number, from 0
    scene, set, seconds     as those of the study, for this run
    h           size of a cell, for orders of convergence
    ranks, binding
    until       stops the run at this time of the scene (s), and
    stop_after  after these seconds of stepping (kind "speed"); all but the first two
                also for all runs of a study

The table [variants] at the head of the file gives the choices their names: NAME =
{"Section/Entry" = value}. Entries of a run are set in the order file, study, run, mesh,
variant; the last one counts. The name of a run is made of its variant, mesh and own
name, as far as it has them. A file that is one study takes all of its [variants].

A kind may make the runs of a study itself, as those of users do; runs, variants and
meshes then are no keys of it.
"""
import itertools
import re
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

from caisson.runner import Entries
from caisson.runs import StudyRun
from caisson import study
from caisson.study import Reader, StudyError


LISTED = {"runs", "variants", "meshes"}


@dataclass(frozen=True)
class Options(study.Options):
    """What is asked of the command line, too."""

    only: str = ""  # regular expression for id and title
    quick: bool = False


class LabReader(Reader):
    """Makes studies of a file of the laboratory."""

    file_keys = Reader.file_keys | {"variants"}
    study_keys = Reader.study_keys | LISTED | {"quick"}
    shared_keys = Reader.shared_keys | {"h", "until", "stop_after"}
    run_keys = set("name scene set seconds variants".split())

    def __init__(self, file: Path, options: Options, module: ModuleType) -> None:
        """module: of the kind."""
        make_runs = getattr(module, "make_runs", None)
        super().__init__(file, options, module.STUDY_KEYS, make_runs)
        self.asked = options
        self.variants: dict[str, Entries] = {"": {}, "default": {}}
        self.variants |= self.content.get("variants", {})

    def is_asked_for(self, table: dict[str, Any]) -> bool:
        """Return whether the study fits the options."""
        if self.asked.quick and not table.get("quick", False):
            return False
        texts = (table.get("id", ""), table.get("title", ""))
        return any(re.search(self.asked.only, str(text)) for text in texts)

    def tables(self) -> list[dict[str, Any]]:
        """Return the keys of each study that is asked for."""
        found = [table for table in super().tables() if self.is_asked_for(table)]
        if not self.asked.quick:
            return found
        return [t | t["quick"] if isinstance(t["quick"], dict) else t for t in found]

    def runs_of(self, study: dict[str, Any], entries: Entries) -> list[StudyRun]:
        """Return the runs of a study: those that it lists, with each variant and on
        each mesh, or those that its kind makes."""
        found, of = list[StudyRun](), f"study {study['id']}"
        if self.make_runs is not None:
            self.refuse_unknown(study, self.known - LISTED, of)
            return super().runs_of(study, entries)
        self.refuse_unknown(study, self.known, of)
        for number, run in enumerate(study.get("runs", [{}])):
            self.refuse_unknown(run, self.run_keys | self.shared_keys, f"a run of {of}")
            own = {"name": str(number), **run} if "runs" in study else run
            names = own.get("variants", study.get("variants", [""]))
            meshes = study.get("meshes", {"": {}}).items()
            for variant, (mesh, on_mesh) in itertools.product(names, meshes):
                if variant not in self.variants:
                    text = f"{self.file}: {study['id']}: no variant {variant!r}"
                    raise StudyError(text)
                every = entries, own.get("set", {}), on_mesh, self.variants[variant]
                merged = {k: v for some in every for k, v in some.items()}
                name = "_".join(filter(None, (variant, mesh, own.get("name", ""))))
                one = self.one_run(study, own, name, merged)
                found.append(replace(one, variant=variant, mesh=mesh))
        return found
