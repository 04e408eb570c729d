# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the runs of a study of parameters have left, at common depths."""
import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from caisson import curves, run_error_bar, units
from caisson.evaluation import rest_of_run
from caisson.uncertain.entry import Parameter, Sample, read_all
from caisson.uncertain.sampling import numbers_of, sampling_of
from caisson.results import ResultsError, Table, read_table
from caisson.runs import COMPLETE, FAILED, StudyRun
from caisson.study import Study, StudyError
from caisson.verdict import run_review

DEPTH, REQUIRED = "penetration_m", "required_suction_Pa"
# what is observed unless the study says it: the first that all runs have
OBSERVED = (
    "required_suction_Pa",
    "total_force_with_water_N",
    "total_force_N",
    "cavity_pressure_Pa",
)
SHOWN = {"N": ("kN", 1e-3), "Pa": ("kPa", 1e-3), "m": ("m", 1.0), "m3": ("m³", 1.0)}


@dataclass
class Outcome:
    """One run: how it ended, and what it has computed. status: COMPLETE, FAILED or why
    there is nothing; why: of a failure."""

    run: StudyRun
    status: str
    why: str
    history: Table | None

    @property
    def name(self) -> str:
        """The name of the run."""
        return self.run.name

    @property
    def is_reference(self) -> bool:
        """Whether it is the scene as it is."""
        return "sample" not in self.run.settings

    @property
    def sample(self) -> Sample:
        """What was varied."""
        return dict(self.run.settings.get("sample", {}))

    @functools.cached_property
    def warnings(self) -> list[str]:
        """What speaks against its results."""
        try:
            found = run_review.warnings_of(self.run.results) if self.history else {}
        except ResultsError:
            return []
        return list(found.get("result", []))

    @property
    def is_complete(self) -> bool:
        """Whether it counts."""
        return self.status == COMPLETE

    @property
    def trouble(self) -> str:
        """Its name, how it ended, and why."""
        return f"{self.name}: {self.status}, {self.why}".rstrip(", ")

    @property
    def rest(self) -> float | None:
        """The penetration by weight alone (m), where suction follows it: where the mean
        of the required suction passes 0, as single rows pass it again and again."""
        if self.history is None or REQUIRED not in self.history:
            return None
        rest = rest_of_run(self.history)
        if rest is None:
            return None
        depth = curve_of(self.history, REQUIRED)[0]
        mean = values_at(self.history, REQUIRED, depth)
        above = np.flatnonzero((mean[:-1] <= 0) & (mean[1:] > 0))
        shares = mean[above] / (mean[above] - mean[above + 1])
        passes: np.ndarray = depth[above] + shares * (depth[above + 1] - depth[above])
        if not len(passes):
            return rest
        return float(passes[np.argmin(np.abs(passes - rest))])


def outcome_of(run: StudyRun) -> Outcome:
    """Return what a run has left."""
    status, why = run.outcome
    history = None
    if status in (COMPLETE, FAILED):
        try:
            history = run.results.history
            if DEPTH not in history or np.ptp(history[DEPTH]) < curves.EDGE:
                raise ResultsError("the body does not move")
        except ResultsError as error:
            status, why, history = FAILED, str(error), None
    return Outcome(run, status, why, history)


def curve_of(history: Table, column: str) -> tuple[np.ndarray, np.ndarray]:
    """Return depths and values [n] of the way down, of a body that is only pulled of
    the way up."""
    rows = curves.main_way(history[DEPTH])
    return history[DEPTH][rows], history[column][rows]


def values_at(history: Table, column: str, depths: np.ndarray) -> np.ndarray:
    """Return the means at depths [n], nan beyond the ends."""
    return curves.smoothed_within(*curve_of(history, column), depths)


def unit_of(column: str) -> tuple[str, float]:
    """Return the unit in which a column of history.csv is shown, and what its values
    are multiplied by."""
    return SHOWN.get(units.unit_of(column), ("", 1.0))


def words_of(column: str) -> str:
    """Return a column of history.csv in words, without its unit."""
    name, unit = units.split(column)
    return (name if unit in SHOWN else column).replace("_", " ")


def title_of(column: str) -> str:
    """Return a column of history.csv in words, with the unit in which it is shown."""
    unit, _ = unit_of(column)
    return f"{words_of(column)} ({unit})" if unit else words_of(column)


def observed_column(keys: dict[str, Any], histories: Sequence[Table]) -> str:
    """Return the column that the study observes. Raises StudyError."""
    common = set.intersection(*(set(history) for history in histories))
    if "observe" in keys:
        column = keys["observe"]
        if column not in common:
            raise StudyError(
                f"observe = {column!r}: no column of history.csv that all runs have;"
                f" choose one of {', '.join(n for n in histories[0] if n in common)}"
            )
        return str(column)
    for column in OBSERVED:
        if column in common and any(np.any(h[column] != 0) for h in histories):
            return column
    raise StudyError(
        "observe is missing: all forces are 0; name a column of history.csv"
    )


class Outcomes:
    """The outcomes of all runs of a study, at common depths.

    depths [n_depths]: of the table; grid [n_grid]: of the curves, finer. Values of a
    run are nan where it has not been.
    """

    def __init__(self, study: Study) -> None:
        """Raises StudyError where no run has anything to show."""
        self.study = study
        self.parameters: list[Parameter] = read_all(study.keys.get("parameters"))
        self.sampling = sampling_of(study.keys, self.parameters)
        outcomes = [outcome_of(run) for run in study.runs]
        self.all = [o for o in outcomes if not o.is_reference]
        self.reference = next((o for o in outcomes if o.is_reference), None)
        histories = [o.history for o in outcomes if o.history is not None]
        if not histories:
            first = next((o for o in outcomes if o.why), outcomes[0])
            why = f": {first.why}" if first.why else ""
            raise StudyError(f"{study.id}: no run has results ({first.status}{why})")
        self.column = observed_column(study.keys, histories)
        ways = [curve_of(history, self.column)[0] for history in histories]
        self.depths = self.table_depths(ways)
        span = max(float(np.ptp(way)) for way in ways)
        step = 10.0 ** math.floor(math.log10(span / 20) + 1e-9)
        self.grid = curves.common_depths(ways, step)

    def table_depths(self, ways: Sequence[np.ndarray]) -> np.ndarray:
        """Return the depths of the table: those of the study, or each meter and the
        last depth that all runs have reached."""
        if "depths" in self.study.keys:
            return np.array(numbers_of(self.study.keys, "depths"))
        found = curves.round_depths(np.concatenate(ways))
        end = min(float(way.max()) for way in ways)
        return np.append(found, end) if len(found) and end > found[-1] + 1e-3 else found

    @property
    def free(self) -> list[Parameter]:
        """The parameters without a formula."""
        return [p for p in self.parameters if p.formula is None]

    @property
    def complete(self) -> list[Outcome]:
        """The runs that count."""
        return [o for o in self.all if o.is_complete]

    def values(self, outcome: Outcome, depths: np.ndarray) -> np.ndarray:
        """Return what is observed in one run, [n_depths]."""
        if outcome.history is None:
            return np.full(len(depths), math.nan)
        return values_at(outcome.history, self.column, depths)

    def matrix(self, depths: np.ndarray) -> np.ndarray:
        """Return what is observed in the runs that count, [n_runs, n_depths]."""
        rows = [self.values(outcome, depths) for outcome in self.complete]
        return np.array(rows).reshape(len(rows), len(depths))

    def tornado_depth(self) -> float | None:
        """Return the depth (m) of the tornado: that of the study, or the deepest of
        the table that as many runs as possible reach; None where no run counts.
        Raises StudyError where none has been there."""
        if not self.complete:
            return None
        if "tornado_depth" in self.study.keys:
            depth = numbers_of(self.study.keys, "tornado_depth")[0]
            if not np.isfinite(self.matrix(np.array([depth]))).any():
                raise StudyError(f"tornado_depth = {depth:g} m: no run has been there")
            return depth
        reached = np.isfinite(self.matrix(self.depths)).sum(axis=0)
        if not reached.any():
            raise StudyError("no run passes a depth of the table; set depths")
        return float(self.depths[reached == reached.max()].max())

    def error(self, depths: np.ndarray, values: np.ndarray) -> np.ndarray | None:
        """Return how far the truth may lie below and above [2, n_depths], by the error
        bar beside the scene, for its numerics; None where there is none. values: of
        what is observed."""
        every = run_error_bar.QUANTITIES.values()
        named = [q for q in every if q.column() == self.column]
        outcome = next(o for o in [*self.all, self.reference] if o and o.history)
        if not named:
            return None
        try:
            bar = read_table(run_error_bar.beside(outcome.run.run.scene))
            sides = [bar[named[0].bar_column(side)] for side in ("below", "above")]
        except ResultsError:
            return None
        nan = math.nan
        error = np.array(
            [np.interp(depths, bar[DEPTH], s, left=nan, right=nan) for s in sides]
        )
        return error * np.abs(values) if named[0].is_relative else error
