# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a study and evaluates it: tables, pictures and a verdict.

The format of the file: the module caisson.study. Results, and the log of each run,
go to results/KIND. Runs that are complete there are not repeated while program,
entries and ranks are the same.
"""
import argparse
import importlib
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

from caisson import needed
from caisson.paths import INSTALLED, PROGRAM, RESULTS, SCENES, scene_or_study, short
from caisson.run import Status
from caisson.study import (
    Options,
    Reader,
    Study,
    StudyError,
    StudyRun,
    execute,
    read_toml,
)

# the studies of the project that have a command of their own
OWN = {
    "verify": SCENES / "verification/ladder.toml",
    "validate": SCENES / "validation/validation.toml",
    "accuracy": SCENES / "verification/accuracy.toml",
    "stability": SCENES / "stability/stability.toml",
    "error-bar": SCENES / "jack_study.toml",
    "suction-error-bar": SCENES / "suction_study.toml",
    "tip": SCENES / "tip_study.toml",
    "drainage": SCENES / "drainage_study.toml",
    "speed": SCENES / "speed.toml",
}
KINDS = {
    "verification": "caisson.verification",
    "validation": "caisson.validation",
    "accuracy": "caisson.accuracy",
    "stability": "caisson.stability",
    "error bar": "caisson.error_bar",
    "forces": "caisson.forces",
    "parameters": "caisson.parameters",
    "drainage": "caisson.drainage",
    "speed": "caisson.speed",
}
if INSTALLED:  # speed is measured on what a build directory has
    del OWN["speed"], KINDS["speed"]


def whole_number(text: str) -> int:
    """Return a number of the command line, 1 or more."""
    if int(text) < 1:
        raise ValueError
    return int(text)


def part_of(text: str) -> tuple[int, int]:
    """Return K and N of K/N."""
    number, of = map(int, text.split("/"))
    if not 1 <= number <= of:
        raise ValueError
    return number, of


def jobs_at_hand(studies: Sequence[Study]) -> int:
    """Return how many runs at a time the cores of this process bear."""
    ranks = max(run.run.ranks for study in studies for run in study.runs)
    return max(1, len(os.sched_getaffinity(0)) // ranks)


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of all studies."""
    own = OWN.get(parser.prog.split()[-1])
    if own is None:
        parser.add_argument("file", type=scene_or_study, help="the study, a .toml file")
    else:
        parser.set_defaults(file=own)
        parser.epilog = f"The study is {short(own)}."
    add = parser.add_argument
    add("--only", default="", metavar="REGEX", help="studies whose id or title fits")
    add("--quick", action="store_true", help="those of some seconds only")
    add("--list", action="store_true", help="say what there is, and run nothing")
    add("--evaluate", action="store_true", help="evaluate what is there, run nothing")
    add("--again", action="store_true", help="repeat also runs that are complete")
    text = "runs at a time, default one for each core, or its ranks"
    add("--jobs", type=whole_number, metavar="N", help=text)
    text = "run only the K-th of N parts, and evaluate nothing: for an array of jobs"
    add("--part", type=part_of, metavar="K/N", help=text)
    add("--program", type=Path, default=PROGRAM, help="caisson_mpm")
    add("--results", type=Path, help="directory of the results")


def module_of(file: Path) -> ModuleType:
    """Return the module of the kind of study. Raises StudyError."""
    kind = read_toml(file).get("kind")
    if kind not in KINDS:
        kinds = ", ".join(KINDS)
        raise StudyError(f"{file}: kind is {kind!r}, not one of {kinds}")
    try:
        return importlib.import_module(KINDS[kind])
    except ModuleNotFoundError as error:
        raise StudyError(needed.complaint() or str(error)) from error


def reader_of(file: Path, options: Options, module: ModuleType) -> Reader:
    """Return what reads a study of the kind of this module."""
    make_runs = getattr(module, "make_runs", None)
    return Reader(file, options, module.STUDY_KEYS, module.RUN_KEYS, make_runs)


def print_list(studies: list[Study]) -> None:
    """Print what there is."""
    for study in studies:
        seconds = sum(run.seconds for run in study.runs)
        print(f"{study.id}: {study.title}, {len(study.runs)} runs, {seconds:.0f} s")


def main(words: argparse.Namespace) -> int:
    """Run and evaluate."""
    try:
        module = module_of(words.file)
        options = Options(
            only=words.only,
            quick=words.quick,
            program=words.program.resolve(),
            results=words.results or RESULTS / module.NAME.replace(" ", "_"),
        )
        studies = reader_of(words.file, options, module).studies()
        if not studies:
            raise StudyError(f"{words.file}: no study fits")
        if words.list:
            print_list(studies)
            return 0
        options.results.mkdir(parents=True, exist_ok=True)
        return int(run_and_evaluate(module, studies, options, words))
    except StudyError as error:
        print(f"study: {error}", file=sys.stderr)
        return 1


def run_and_evaluate(
    module: ModuleType,
    studies: list[Study],
    options: Options,
    words: argparse.Namespace,
) -> int:
    """Run what is missing; return the status of the evaluation."""
    begin = time.monotonic()
    if hasattr(module, "measure"):  # its runs take turns
        if words.part:
            raise StudyError(f"studies of kind {module.NAME!r} have no parts")
        return int(module.measure(studies, options, words.evaluate))
    jobs = words.jobs or getattr(module, "JOBS", None) or jobs_at_hand(studies)
    if not words.evaluate:
        if hasattr(module, "check"):
            to_do = module.check(studies, jobs)
            if not words.part:
                print(to_do, flush=True)
        runs = [run for study in studies for run in study.runs]
        if words.part:
            runs = runs[words.part[0] - 1 :: words.part[1]]
        execute(runs, jobs, words.again, getattr(module, "TIME_LIMIT", None))
        if words.part:
            return tell_part(runs, words)
    minutes = (time.monotonic() - begin) / 60
    return int(module.evaluate(studies, options, minutes))


def tell_part(runs: Sequence[StudyRun], words: argparse.Namespace) -> int:
    """Say what has become of the runs of a part; return 1 where one is missing."""
    done = sum(run.status == Status.SUCCESS for run in runs)
    number, of = words.part
    print(f"part {number} of {of}: {done} of {len(runs)} runs are complete")
    for run in runs:
        if run.status != Status.SUCCESS:
            print(f"{run.study} {run.name}: {run.trouble or 'failed, see its log'}")
    return 0 if done == len(runs) else 1
