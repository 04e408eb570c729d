# SPDX-License-Identifier: LGPL-2.1-or-later
"""Spoilt scenes, which the program must accept, or refuse with a message of its own."""
import math
import random
import shutil
from pathlib import Path

from caisson.paths import PROGRAM, ROOT
from caisson.runner import Status, read_parameters, set_options
from caisson_workshop.faults.campaign import Part, Result
from caisson_workshop.faults.mutations import GENTLE, ROUGH, Material, mutate
from caisson_workshop.faults.process import call

WALL_TIME_LIMIT = 1.5  # s, of a run
KINDS = {
    Status.SUCCESS: "valid",
    Status.BAD_INPUT: "refused",
    Status.FAILURE: "failed in order",
    Status.STOPPED: "stopped",
}


# A million cells take longer to set up than a hang may take, and are none.
LIMITS = {
    "Grid/Largest number of cells": 100000,
    "Material points/Largest number of points": 1000000,
}


# of the scenes
FOLDERS = ("prm", "lab", "tests")


class Fuzz(Part):
    """Scenes that are only validated."""

    name = "fuzz"
    options = ["--validate", *set_options(LIMITS)]

    def prepare(self) -> None:
        """Copy all scenes, so that those that they include are beside them."""
        self.tree = self.directory / "scenes"
        shutil.rmtree(self.tree, ignore_errors=True)
        for file in sorted(
            file for folder in FOLDERS for file in (ROOT / folder).rglob("*")
        ):
            if file.suffix in (".prm", ".csv"):
                copy = self.tree / file.relative_to(ROOT)
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(file, copy)
        self.scenes = {
            str(file.relative_to(self.tree)): file.read_bytes()
            for file in sorted(self.tree.rglob("*.prm"))
        }
        entries = read_parameters([str(ROOT / "prm/column.prm")])
        self.material = Material(self.scenes, entries)

    def attempt(self, number: int, directory: Path) -> Result:
        """Spoil a scene and pass it to the program."""
        source = self.random(number)
        name = source.choice(sorted(self.scenes))
        text = self.spoil(self.scenes[name], source)
        (directory / "input.prm").write_bytes(text)
        file = (self.tree / name).with_name(f"{self.name}_{number}.prm")
        file.write_bytes(text)
        words = [PROGRAM, file.relative_to(self.tree), *self.options]
        words += ["--output-directory", directory / "results"]
        outcome = call(words, self.tree)
        file.unlink()
        complaint = outcome.complaint() or self.complaint(outcome.status, directory)
        kind = KINDS.get(Status(outcome.status), "") if not complaint else ""
        return Result(kind, complaint, (outcome,))

    def spoil(self, text: bytes, source: random.Random) -> bytes:
        """Return the text with something wrong in it."""
        return mutate(text, source, self.material, ROUGH)

    def complaint(self, status: int, directory: Path) -> str:
        """Return what else is wrong."""
        if status not in (Status.SUCCESS, Status.BAD_INPUT):
            return f"exit status {status} of --validate"
        return "--validate leaves results" if (directory / "results").exists() else ""


class FuzzedRuns(Fuzz):
    """Scenes that are run for a moment, most of them with milder changes, so that
    many get that far."""

    name = "fuzzed runs"
    options = set_options(
        {
            **LIMITS,
            "Run control/Wall time limit": WALL_TIME_LIMIT,
            "Output/Checkpoint interval": 0.5,
        }
    )

    def spoil(self, text: bytes, source: random.Random) -> bytes:
        """Return the text with other numbers in it, or spoilt."""
        kinds = GENTLE if source.random() < 0.8 else ROUGH
        return mutate(text, source, self.material, kinds)

    def complaint(self, status: int, directory: Path) -> str:
        """Return whether a run that ended in order has numbers that are not."""
        file = directory / "results/history.csv"
        if status in (Status.BAD_INPUT, Status.FAILURE) or not file.exists():
            return ""
        _, *rows = file.read_text(encoding="utf-8").splitlines()
        for row in rows:
            if not all(map(math.isfinite, map(float, row.split(",")))):
                return f"a row that is not finite: {row}"
        return ""
