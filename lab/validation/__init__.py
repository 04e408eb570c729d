# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "validation": runs beside measurements, with what is asked of them.

A study of this kind has keys of its own,

    compare = "triaxial"       # the comparison, one of COMPARISONS
    measured = "triaxial.csv"  # what was measured, in a file beside the scene
    every = 2                  # run every second test only

and its runs are made by that module. It writes a picture and rows of a table; each row
is a quantity, what was computed, what is asked, and whether that is met. A shortfall
that is known has its reason, and does not count as a failure.
"""
import importlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from matplotlib.figure import Figure

from caisson.runner import Run
from caisson.study import Options, Study, StudyError
from caisson.table import number
from lab import outcome

NAME = "validation"
STUDY_KEYS = {"compare", "measured", "every"}
COLUMNS = ["comparison", "quantity", "computed", "asked", "verdict"]
# each is the module of this name in the folder of a case
COMPARISONS = {
    "triaxial": "triaxial",
    "cone_clay": "cone_clay",
    "cone_coefficients": "cone_in_sand",
    "cone_density": "cone_density",
    "cone_layers": "cone_layers",
    "cone_quick": "cone_sand",
    "cone_sand": "cone_sand",
    "model_caisson": "model_caisson",
    "pile": "pile",
    "pile_quick": "pile",
    "ring_over_cone": "ring_over_cone",
    "shaft_over_base": "shaft_over_base",
}


@dataclass(frozen=True)
class Row:
    """A row of the table: a quantity, which should lie between two bounds."""

    comparison: str
    quantity: str
    computed: float
    least: float = -math.inf
    largest: float = math.inf
    known: str = ""  # why it falls short, if that is known

    @property
    def is_met(self) -> bool:
        """Whether it lies within its bounds; false for nan."""
        return self.least <= self.computed <= self.largest

    @property
    def fails(self) -> bool:
        """Whether it falls short, and the reason is not known."""
        return not self.is_met and not self.known

    def asked(self) -> str:
        """Return the bounds in words."""
        if math.isinf(self.least) and math.isinf(self.largest):
            return "shown"
        if math.isinf(self.least):
            return f"at most {number(self.largest)}"
        if math.isinf(self.largest):
            return f"at least {number(self.least)}"
        return f"{number(self.least)} to {number(self.largest)}"

    def texts(self) -> list[str]:
        """Return the cells of the table."""
        verdict = "met" if self.is_met else f"short: {self.known or 'NOT KNOWN WHY'}"
        if self.asked() == "shown":
            verdict = ""
        computed = number(self.computed)
        return [self.comparison, self.quantity, computed, self.asked(), verdict]


class Comparison(Protocol):
    """A module that compares."""

    def runs_of(self, measured: Path) -> list[dict[str, Any]]:
        """Return the runs, as a study file has them."""

    def compare(self, study: Study, measured: Path, figure: Figure) -> list[Row]:
        """Draw, and return the rows of the table."""


def comparison_of(keys: Mapping[str, Any]) -> Comparison:
    """Return the module of a study. Raises StudyError."""
    name = keys.get("compare", "")
    if name not in COMPARISONS:
        names = ", ".join(COMPARISONS)
        raise StudyError(f"compare is {name!r}, not one of {names}")
    module: Any = importlib.import_module(f"{__name__}.{COMPARISONS[name]}.{name}")
    return module


def measured_of(directory: Path, keys: Mapping[str, Any]) -> Path:
    """Return the file of measurements, the directory where there is none. Raises
    StudyError."""
    path = directory / keys.get("measured", "")
    if "measured" in keys and not path.is_file():
        raise StudyError(f"measured: there is no file {path}")
    return path


def make_runs(study: Mapping[str, Any], scene: Run) -> list[dict[str, Any]]:
    """Return the runs of a study, in the directory of whose scene the measurements
    are."""
    runs = comparison_of(study).runs_of(measured_of(scene.scene.parent, study))
    return runs[:: study.get("every", 1)]


def evaluate(studies: Sequence[Study], options: Options, minutes: float) -> int:
    """Write a picture of each study, table.md and table.csv; print the table. Return 1
    where something is not met and not known."""
    rows: list[Row] = []
    for study in studies:
        for run in study.runs:
            if run.status is None or run.trouble:
                raise StudyError(f"{study.id} {run.name}: {run.trouble}")
        figure = Figure(figsize=(9, 4), layout="constrained")
        folder = study.runs[0].run.scene.parent
        measured = measured_of(folder, study.keys)
        rows += comparison_of(study.keys).compare(study, measured, figure)
        path = options.results / f"{study.id}.png"
        outcome.write_picture(NAME, path, figure)
    texts = [row.texts() for row in rows]
    outcome.write_table(options.results, COLUMNS, texts)
    print(f"validation: {len(rows)} rows, {minutes:.1f} minutes")
    return int(any(row.fails for row in rows))
