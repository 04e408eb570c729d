# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a study of the laboratory and evaluates it: tables, pictures and a verdict.

The format of the file: the module lab.study. Results, and the log of each run,
go to results/KIND. Runs that are complete there are not repeated while the program,
the entries and the ranks are the same.
"""
import argparse
import functools
import re
import time
from pathlib import Path
from types import ModuleType

from caisson import study_command
from caisson.paths import SCENES, short
from caisson.study import StudyError
from lab import LAB
from lab.study import LabReader, Options

KINDS = study_command.KINDS | {
    "error bar": "caisson.error_bars.bar_study",
    "verification": "lab.verification",
    "validation": "lab.validation",
    "accuracy": "lab.verification.accuracy",
    "stability": "lab.stability",
    "forces": "lab.studies.forces",
    "drainage": "lab.studies.drainage",
    "tension": "lab.studies.tension",
    "surface": "lab.studies.surface",
    "speed": "lab.performance",
}
# the studies that have a command of their own
STUDIES = {
    "verify": LAB / "verification/ladder.toml",
    "validate": LAB / "validation/validation.toml",
    "accuracy": LAB / "verification/accuracy.toml",
    "stability": LAB / "stability/stability.toml",
    "error-bar": SCENES / "jack_study.toml",
    "suction-error-bar": SCENES / "suction_study.toml",
    "tip": LAB / "studies/tip_study.toml",
    "drainage": LAB / "studies/drainage_study.toml",
    "tension": LAB / "studies/tension_study.toml",
    "surface": LAB / "studies/surface_study.toml",
    "speed": LAB / "performance/speed.toml",
}


def files() -> list[Path]:
    """Return all study files, of users and of the laboratory."""
    return sorted([*SCENES.rglob("*.toml"), *LAB.rglob("*.toml")])


def pattern(text: str) -> str:
    """Return a regular expression of the command line."""
    try:
        re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"{text!r}: {error}") from error
    return text


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of all studies."""
    study = STUDIES.get(parser.prog.split()[-1])
    study_command.add_arguments(parser, study)
    text = "studies whose id or title fits"
    parser.add_argument("--only", type=pattern, default="", metavar="REGEX", help=text)
    text = "those of some seconds only"
    parser.add_argument("--quick", action="store_true", help=text)
    if study is not None:
        parser.epilog = f"The study is {short(study)}."


def reader_of(file: Path, options: Options, module: ModuleType) -> LabReader:
    """Return what reads a study of a user or of the laboratory."""
    return LabReader(file, options, module)


def main(arguments: argparse.Namespace) -> int:
    """Run and evaluate."""
    module = study_command.module_of(arguments.file, KINDS)
    made = vars(study_command.options_of(arguments, module))
    options = Options(**made, only=arguments.only, quick=arguments.quick)
    studies = reader_of(arguments.file, options, module).studies()
    if study_command.is_list(arguments, studies):
        return 0
    options.results.mkdir(parents=True, exist_ok=True)
    if hasattr(module, "measure"):  # its runs take turns
        if arguments.part:
            raise StudyError(f"studies of kind {module.NAME!r} have no parts")
        return int(module.measure(studies, options, arguments.evaluate))
    begin, limit = time.monotonic(), getattr(module, "TIME_LIMIT", None)
    arguments.jobs = arguments.jobs or getattr(module, "JOBS", None)
    runs = [run for study in studies for run in study.runs]
    is_own, refuse = hasattr(module, "refuse"), lambda _: None
    if is_own:
        refuse = functools.partial(module.refuse, studies)
    status = study_command.run_missing(
        runs, arguments, is_own, refuse, time_limit=limit
    )
    if status is None:
        minutes = (time.monotonic() - begin) / 60
        status = int(module.evaluate(studies, options, minutes))
    return status
