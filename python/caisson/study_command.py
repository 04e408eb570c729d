# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a study and evaluates it: tables, pictures and a verdict.

The format of the file: the module caisson.study. Results, and the log of each run,
go to results/KIND. Runs that are complete there are not repeated while program,
entries and ranks are the same.
"""
import argparse
import importlib
import sys
import time
from pathlib import Path
from types import ModuleType

from caisson.paths import INSTALLED, PROGRAM, RESULTS, SCENES, scene_or_study, short
from caisson.study import Options, Reader, Study, StudyError, execute, read_toml

# the studies of the project that have a command of their own
OWN = {
    "verify": SCENES / "verification/ladder.toml",
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
    "accuracy": "caisson.accuracy",
    "stability": "caisson.stability",
    "error bar": "caisson.error_bar",
    "forces": "caisson.forces",
    "drainage": "caisson.drainage",
    "speed": "caisson.speed",
}
if INSTALLED:  # speed is measured on what a build directory has
    del OWN["speed"], KINDS["speed"]


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
    add("--jobs", type=int, default=2, metavar="N", help="runs at a time")
    add("--program", type=Path, default=PROGRAM, help="caisson_mpm")
    add("--results", type=Path, help="directory of the results")


def module_of(file: Path) -> ModuleType:
    """Return the module of the kind of study. Raises StudyError."""
    kind = read_toml(file).get("kind")
    if kind not in KINDS:
        kinds = ", ".join(KINDS)
        raise StudyError(f"{file}: kind is {kind!r}, not one of {kinds}")
    return importlib.import_module(KINDS[kind])


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
        reader = Reader(
            words.file,
            options,
            module.STUDY_KEYS,
            module.RUN_KEYS,
        )
        studies = reader.studies()
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
        return int(module.measure(studies, options, words.evaluate))
    if not words.evaluate:
        runs = [run for study in studies for run in study.runs]
        limit = getattr(module, "TIME_LIMIT", None)
        execute(runs, words.jobs, words.again, limit)
    minutes = (time.monotonic() - begin) / 60
    return int(module.evaluate(studies, options, minutes))
