# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tries whether the tests notice faults: each mutant of mutants.toml is one wrong
expression of the program or of the package, and one of its tests must fail with it.

The sources are copied to a folder and built there once, with a switch at each
expression of C++ that a mutant changes; the environment variable CAISSON_MPM_MUTANT
turns one on. A mutant of Python is written into the copy for its tests. All tests must
pass without any mutant first. The exit status is 1 if fewer than LEAST_NOTICED of the
mutants are noticed.
"""
import argparse
import os
import subprocess
import tomllib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from caisson.paths import ROOT

LIST = Path(__file__).resolve().with_name("mutants.toml")
LEAST_NOTICED = 0.9  # of all mutants
SWITCH = "CAISSON_MPM_MUTANT"
HEADER = f"""#pragma once
#ifdef __cplusplus
#  include <cstdlib>
inline bool is_mutant(const int number)
{{
  static const char *const text = std::getenv("{SWITCH}");
  static const int active = text == nullptr ? 0 : std::atoi(text);
  return number == active;
}}
#endif
"""


class MutantError(Exception):
    """The list does not fit the sources, or a test fails without a mutant."""


@dataclass(frozen=True)
class Mutant:
    """A fault: what it means, its file, the text that stands there once, what replaces
    that, and the names of the tests that should know."""

    number: int
    what: str
    file: str
    old: str
    new: str
    tests: list[str]

    @property
    def is_cpp(self) -> bool:
        """Whether the file must be compiled."""
        return not self.file.endswith(".py")

    def applied_to(self, text: str) -> str:
        """Return the text of the file with the fault, or with its switch. Raises
        MutantError where the text to replace does not stand there once."""
        if text.count(self.old) != 1:
            raise MutantError(
                f"{LIST.name}: {self.what!r}: {self.old!r} must stand once in"
                f" {self.file}, and not {text.count(self.old)} times: correct the entry"
            )
        switched = f"(is_mutant({self.number}) ? ({self.new}) : ({self.old}))"
        return text.replace(self.old, switched if self.is_cpp else self.new)


def read_list(path: Path = LIST) -> list[Mutant]:
    """Return the mutants of a file, numbered from 1."""
    entries = tomllib.loads(path.read_text("utf-8"))["mutant"]
    return [Mutant(number, **entry) for number, entry in enumerate(entries, 1)]


def copy_sources(mutants: Sequence[Mutant], copy: Path) -> None:
    """Bring the files of this checkout to the copy, C++ with the switches of its
    mutants; what is the same there keeps its time, and is not compiled again."""
    names = ["git", "ls-files", "-co", "--exclude-standard"]
    listed = subprocess.run(names, cwd=ROOT, check=True, capture_output=True, text=True)
    texts = {copy / "mutant.h": HEADER.encode()}
    for name in filter(
        lambda name: (ROOT / name).is_file(), listed.stdout.splitlines()
    ):
        text = (ROOT / name).read_bytes()
        for mutant in mutants:
            if mutant.is_cpp and mutant.file == name:
                text = mutant.applied_to(text.decode()).encode()
        texts[copy / name] = text
    for path in copy.glob("[!.b]*/**/*"):  # what was there before; not the build
        if path.is_file() and path not in texts:
            path.unlink()
    for path, text in texts.items():
        if not path.is_file() or path.read_bytes() != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text)
        path.chmod(0o755 if text.startswith(b"#!") else 0o644)


def build(copy: Path) -> None:
    """Build the program and the tests of the copy."""
    flags = f"-DCMAKE_CXX_FLAGS=-include{copy / 'mutant.h'}"
    options = f"{os.environ.get('CMAKE_OPTIONS', '')} {flags}"
    environment = {**os.environ, "CMAKE_OPTIONS": options}
    for command in (["scripts/build"], ["scripts/build", "build_tests"]):
        subprocess.run(command, cwd=copy, env=environment, check=True)


def failed(copy: Path, tests: Sequence[str], number: int = 0) -> bool:
    """Return whether one of the tests fails, with the mutant of C++ of this number."""
    names = "|".join(sorted(set(tests)))
    script = '. ../../tools/caisson_workshop/test_environment.sh && exec "$@"'
    cores = str(len(os.sched_getaffinity(0)))
    ctest = ["ctest", "-j", cores, "--no-tests=error", "-R", f"^({names})$"]
    done = subprocess.run(
        ["bash", "-c", script, "bash", *ctest],
        cwd=copy / "build/release",
        env={**os.environ, SWITCH: str(number)},
        stdout=subprocess.DEVNULL,
    )
    return done.returncode != 0


@contextmanager
def fault_in(copy: Path, mutant: Mutant) -> Iterator[int]:
    """Have a mutant in the copy; yield the number of its switch, 0 for Python."""
    if mutant.is_cpp:
        yield mutant.number
        return
    file = copy / mutant.file
    right = file.read_text("utf-8")
    try:
        file.write_text(mutant.applied_to(right), "utf-8")
        yield 0
    finally:
        file.write_text(right, "utf-8")


def try_all(mutants: Sequence[Mutant], copy: Path) -> list[Mutant]:
    """Return the mutants that no test notices. Raises MutantError where a test fails
    without any."""
    if failed(copy, [test for mutant in mutants for test in mutant.tests]):
        raise MutantError("a test fails without any mutant: see scripts/test")
    survivors = []
    for mutant in mutants:
        with fault_in(copy, mutant) as number:
            noticed = failed(copy, mutant.tests, number)
        print(f"{'noticed' if noticed else 'SURVIVES':9} {mutant.what}", flush=True)
        if not noticed:
            survivors.append(mutant)
    return survivors


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop mutate`."""
    parser.add_argument("--directory", type=Path, default=ROOT / "build/mutants")
    parser.add_argument("--only", metavar="TEXT", default="", help="of what or file")


def main(options: argparse.Namespace) -> int:
    """Try the mutants; return 1 where too many survive."""
    copy = options.directory.resolve()
    everything = read_list()
    mutants = [
        x for x in everything if options.only in x.what or options.only in x.file
    ]
    copy_sources(everything, copy)
    build(copy)
    survivors = try_all(mutants, copy)
    noticed = len(mutants) - len(survivors)
    print(f"mutants: {noticed} of {len(mutants)} noticed")
    return int(noticed < LEAST_NOTICED * len(mutants))
