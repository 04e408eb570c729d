# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many trials side by side, each made from a seed and its number."""
import random
import shutil
import time
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from caisson.paths import short
from caisson_workshop.faults.process import Outcome


@dataclass(frozen=True)
class Result:
    """What became of a trial."""

    kind: str  # of what went well, for the table
    complaint: str = ""  # nothing where all is well
    calls: tuple[Outcome, ...] = ()


class Part(ABC):
    """A kind of trial. Trials are made by several threads at once, after
    prepare()."""

    name = ""

    def __init__(self, seed: int, directory: Path) -> None:
        """directory: where all files of this part go; it is made."""
        self.seed, self.directory = seed, directory
        directory.mkdir(parents=True, exist_ok=True)

    def random(self, number: int) -> random.Random:
        """Return the source of all that is random in a trial."""
        return random.Random(f"{self.name} {self.seed} {number}")

    @abstractmethod
    def prepare(self) -> None:
        """Make what all trials share."""

    @abstractmethod
    def attempt(self, number: int, directory: Path) -> Result:
        """Make a trial, with its files in an empty directory of its own."""


class Campaign:
    """The trials of a part, and what became of them."""

    def __init__(self, part: Part, keep: bool) -> None:
        """keep: the files of every trial, and not only of those that went wrong."""
        self.part, self.keep = part, keep
        self.kinds, self.complaints = Counter[str](), list[str]()
        self.slowest, self.largest, self.seconds = 0.0, 0, 0.0

    def run(self, numbers: Iterable[int], n_workers: int) -> None:
        """Make these trials, and print what goes wrong at once."""
        begin = time.monotonic()
        self.part.prepare()
        with ThreadPoolExecutor(n_workers) as pool:
            for number, result in pool.map(self.attempt, numbers):
                self.count(number, result)
        self.seconds = time.monotonic() - begin

    def attempt(self, number: int) -> tuple[int, Result]:
        """Make a trial; its files stay where something is wrong."""
        directory = self.place(number)
        shutil.rmtree(directory, ignore_errors=True)
        directory.mkdir(parents=True)
        result = self.part.attempt(number, directory)
        for i, outcome in enumerate(result.calls):
            (directory / f"words_{i}.txt").write_text(outcome.words, encoding="utf-8")
        if not result.complaint and not self.keep:
            shutil.rmtree(directory)
        return number, result

    def place(self, number: int) -> Path:
        """Return the directory of a trial."""
        return self.part.directory / str(number)

    def count(self, number: int, result: Result) -> None:
        """Add a trial to the table."""
        self.kinds["wrong" if result.complaint else result.kind] += 1
        self.slowest = max([self.slowest, *(c.processor_s for c in result.calls)])
        self.largest = max([self.largest, *(c.memory for c in result.calls)])
        if result.complaint:
            words = f"{self.part.name} {number}: {result.complaint}"
            self.complaints.append(words)
            print(f"{words}; {short(self.place(number))}", flush=True)
        elif self.keep:
            print(f"{self.part.name} {number}: {result.kind}")
            print(f"  {short(self.place(number))}", flush=True)

    def summary(self) -> str:
        """Return the line of the table."""
        kinds = ", ".join(f"{n} {kind}" for kind, n in sorted(self.kinds.items()))
        return (
            f"{self.part.name:12} {sum(self.kinds.values()):6} in"
            f" {self.seconds / 60:.1f} min: {kinds};"
            f" slowest call {self.slowest:.1f} s, largest {self.largest / 1e9:.2f} GB"
        )
