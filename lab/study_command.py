# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a study of the laboratory and evaluates it: tables, pictures and a verdict.

The format of the file: the module caisson.study. Results, and the log of each run,
go to results/KIND. Runs that are complete there are not repeated while the program,
the entries and the ranks are the same.
"""
import argparse
from pathlib import Path

from caisson import study_command
from caisson.paths import SCENES, short
from lab.paths import LAB

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


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of all studies."""
    study = STUDIES.get(parser.prog.split()[-1])
    study_command.add_arguments(parser, study)
    if study is not None:
        parser.epilog = f"The study is {short(study)}."


def main(options: argparse.Namespace) -> int:
    """Run and evaluate."""
    return study_command.main(options, KINDS)
