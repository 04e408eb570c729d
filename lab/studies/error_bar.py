# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "error bar": of the forces of an installation, and of its suction
where it has one, from runs with changed numerics.

Keys of the study beside the usual ones:

    output    the file to write, relative to the study: Output/Error bar of the scene
    depths    first, last, step (m of penetration)
    [[errors]]
    name = "mesh"      each term compares two runs:
    from = "default"
    to = "refined"
    factor = 1         extrapolates to the limit: 2 from a halved quantity on which
                       the error depends linearly, 1 from a refined mesh
    depths = [1, 4]    where the term counts, if not everywhere (m)

The error of a term at a depth is

    factor * rms (F_from - F_to) / F_from    over 0.5 m about it

with forces averaged over 0.2 m. Errors of the suction, the exit gradient and the
heave are absolute, without the division, because these cross zero. The half-width of
the error bar is the root of the sum of the squares of all terms. One run must be
called "default".
"""
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from caisson import curves, table
from caisson.paths import short
from caisson.results import ResultsError, Table
from caisson.study import Options, Study, StudyError, StudyRun
from lab.curves import window_rms

NAME = "error bar"
STUDY_KEYS = {"output", "depths", "errors"}
RUN_KEYS = set[str]()
ERROR_WINDOW = 0.5  # m


@dataclass(frozen=True)
class Quantity:
    """A column of history.csv that has an error bar.

    name and unit make the names of columns in the file, unit being that of its error;
    scale and digits are those of the printed tables, for values in shown_unit.
    """

    name: str
    column: str
    is_relative: bool
    unit: str
    shown_unit: str
    scale: float
    digits: int

    def named(self, *parts: str) -> str:
        """Return the name of a column of the file."""
        return "_".join(filter(None, [self.name, *parts, self.unit]))

    @property
    def half_width(self) -> str:
        """The column with the half-width."""
        return self.named("error" if self.is_relative else "half_width")

    def text(self, value: float) -> str:
        """Return a value for a printed table."""
        return f"{value * self.scale:.{self.digits}f}"


FORCES = [
    Quantity(name, column, True, "", "kN", 1e-3, 0)
    for name, column in {
        "tip": "tip_force_N",
        "inner": "inner_friction_N",
        "outer": "outer_friction_N",
        "total": "total_force_N",
    }.items()
]
SUCTION = [
    Quantity("required_suction", "required_suction_Pa", False, "Pa", "kPa", 1e-3, 2),
    Quantity("exit_gradient_axis", "exit_gradient_axis", False, "", "", 1, 3),
    Quantity("plug_heave", "plug_heave_m", False, "m", "mm", 1e3, 1),
]
QUANTITIES = {quantity.name: quantity for quantity in FORCES + SUCTION}
TABLE_DEPTHS = [(FORCES, [1, 2, 4, 6]), (SUCTION, [2, 3, 4, 5, 6])]  # m

Errors = dict[str, np.ndarray]  # by name of the quantity: [n_depths]


def quantities_of(history: Table) -> list[Quantity]:
    """Return what a run with this history has: forces, and suction if it acts."""
    return [q for q in FORCES + SUCTION if q.column in history]


def term_errors(term: dict[str, Any], study: Study, depths: np.ndarray) -> Errors:
    """Return the errors of all quantities by one term, 0 where it does not count.
    Raises StudyError where a run does not reach that far."""
    a, b = [study.run(term[key]).results.history for key in ("from", "to")]
    first, last = term.get("depths", (depths[0], depths[-1]))
    counts = (depths > first - curves.EDGE) & (depths < last + curves.EDGE)
    at = depths[counts]
    errors = {}
    for quantity in quantities_of(a):
        column = quantity.column
        from_a, from_b = [curves.forces_at(h, column, at) for h in (a, b)]
        difference = from_a - from_b
        if not np.all(np.isfinite(difference)):
            raise StudyError(
                f"the error {term['name']!r} counts to {last:.4g} m, and one of its"
                " runs ends before; set its depths"
            )
        if quantity.is_relative:
            difference /= from_a
        errors[quantity.name] = np.zeros(len(depths))
        errors[quantity.name][counts] = term["factor"] * window_rms(
            at, difference, ERROR_WINDOW
        )
    return errors


def combined(terms: Sequence[Errors]) -> Errors:
    """Return the half-widths: the roots of the sums of the squares of all terms."""
    return {
        name: np.sqrt(np.sum([term[name] ** 2 for term in terms], axis=0))
        for name in terms[0]
    }


def file_columns(
    study: Study, depths: np.ndarray, half: Errors, terms: list[Errors]
) -> dict[str, list[str]]:
    """Return the columns of the file as text: relative half-widths of the forces with
    their terms, then the values, half-widths and terms of the suction."""
    history = study.run("default").results.history
    names = [term["name"].replace(" ", "_") for term in study.keys["errors"]]
    columns = {"penetration_m": [f"{depth:.2f}" for depth in depths]}
    for group in (FORCES, SUCTION):
        present = [q for q in group if q.name in half]
        text = ".5f" if group is FORCES else ".5g"
        values = {
            q.column: curves.forces_at(history, q.column, depths)
            for q in present
            if not q.is_relative
        }
        values |= {q.half_width: half[q.name] for q in present}
        for name, term in zip(names, terms):
            values |= {q.named(name): term[q.name] for q in present}
        columns |= {n: [f"{value:{text}}" for value in v] for n, v in values.items()}
    return columns


def write_file(
    path: Path, study: Study, depths: np.ndarray, half: Errors, terms: list[Errors]
) -> None:
    """Write the file that the program reads."""
    base = study.run("default")
    columns = file_columns(study, depths, half, terms)
    of = "forces and suction" if len(half) > len(FORCES) else "forces"
    lines = [
        f"# Errors of the {of} of {base.run.scene.name},"
        f" by scripts/lab study {short(study.file)}",
        f"# fingerprint: {base.results.summary['fingerprint']}",
        ",".join(columns),
        *map(",".join, zip(*columns.values())),
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def minutes(run: StudyRun) -> str:
    """Return the time of a run."""
    seconds = run.results.summary.get("wall_time_s")
    return "broke off" if seconds is None else f"{seconds / 60:.1f} min"


def print_table(
    study: Study, depths: np.ndarray, named: list[tuple[str, Errors]], q: Quantity
) -> None:
    """Print a quantity of all runs, and its errors by all terms, at depths [m]."""
    heads = [f"{depth:.0f} m" for depth in depths]
    unit = f" ({q.shown_unit})" if q.shown_unit else ""
    rows = []
    for run in study.runs:
        values = curves.forces_at(run.results.history, q.column, depths)
        rows.append([run.name, *map(q.text, values), minutes(run)])
    print(table.markdown([f"{q.column}{unit}", *heads, "time"], rows) + "\n")
    rows = [
        [name, *(f"{100 * e:.1f} %" if q.is_relative else q.text(e) for e in errors)]
        for name, errors in ((name, errors[q.name]) for name, errors in named)
    ]
    print(table.markdown(["error", *heads], rows) + "\n")


def print_tables(
    study: Study, depths: np.ndarray, half: Errors, terms: list[Errors]
) -> None:
    """Print all quantities of all runs, and the errors of all terms, at some depths."""
    for group, table_depths in TABLE_DEPTHS:
        wanted = [d for d in table_depths if depths[0] <= d <= depths[-1]]
        at = [int(np.argmin(abs(depths - d))) for d in wanted]
        names = [*(term["name"] for term in study.keys["errors"]), "all"]
        for q in (q for q in group if q.name in half):
            chosen = [{q.name: errors[q.name][at]} for errors in [*terms, half]]
            print_table(study, depths[at], list(zip(names, chosen)), q)


def evaluate(studies: Sequence[Study], _: Options, __: float) -> int:
    """Write the file of each study and print its tables. Raises StudyError where a
    run is missing."""
    for study in studies:
        first, last, step = study.keys["depths"]
        depths = np.arange(first, last + step / 2, step)
        try:
            terms = [term_errors(t, study, depths) for t in study.keys["errors"]]
            half = combined(terms)
            path = study.file.parent / str(study.keys["output"])
            write_file(path, study, depths, half, terms)
            print_tables(study, depths, half, terms)
            print(f"error bar: {short(path)}")
        except ResultsError as error:
            raise StudyError(str(error)) from error
    return 0
