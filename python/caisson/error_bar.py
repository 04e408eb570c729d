# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "error bar": of the forces of an installation, from runs with
changed numerics.

Keys of the study beside the usual ones:

    output    the file to write, relative to the study: Output/Error bar of the scene
    depths    first, last, step (m of penetration)
    [[errors]]
    name = "mesh"      each term compares two runs:
    from = "default"
    to = "refined"
    factor = 1         extrapolates to the limit: 2 from a halved quantity on which
                       the error depends linearly, 1 from a refined mesh

The relative error of a term at a depth is

    factor * rms |F_from - F_to| / |F_from|    over 0.5 m about it

with forces averaged over 0.2 m. The half-width of the error bar is the root of
the sum of the squares of all terms. One run must be called "default".
"""
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from caisson import curves, table
from caisson.paths import short
from caisson.results import ResultsError
from caisson.study import Options, Study, StudyError, StudyRun

NAME = "error bar"
STUDY_KEYS = {"output", "depths", "errors"}
RUN_KEYS = set[str]()
ERROR_WINDOW = 0.5  # m
TABLE_DEPTHS = [1, 2, 4, 6]  # m
FORCES = {
    "tip": "tip_force_N",
    "inner": "inner_friction_N",
    "outer": "outer_friction_N",
    "total": "total_force_N",
}

Errors = dict[str, np.ndarray]  # by force: [n_depths]


def term_errors(term: dict[str, Any], study: Study, depths: np.ndarray) -> Errors:
    """Return the relative errors of all forces by one term."""
    a, b = [study.run(term[key]).results.history for key in ("from", "to")]
    errors = {}
    for name, column in FORCES.items():
        from_a, from_b = [curves.forces_at(h, column, depths) for h in (a, b)]
        difference = (from_a - from_b) / from_a
        errors[name] = term["factor"] * curves.window_rms(
            depths, difference, ERROR_WINDOW
        )
    return errors


def write_file(
    path: Path, study: Study, depths: np.ndarray, half: Errors, terms: list[Errors]
) -> None:
    """Write the file that the program reads."""
    base = study.run("default")
    names = [term["name"].replace(" ", "_") for term in study.keys["errors"]]
    columns = [f"{force}_{name}" for name in names for force in FORCES]
    lines = [
        f"# Relative errors of the forces of {base.run.scene.name},"
        f" by scripts/caisson study {short(study.file)}",
        f"# fingerprint: {base.results.summary['fingerprint']}",
        ",".join(["penetration_m", *[f"{f}_error" for f in FORCES], *columns]),
    ]
    for i, depth in enumerate(depths):
        values = [errors[force][i] for errors in [half, *terms] for force in FORCES]
        lines.append(f"{depth:.2f}," + ",".join(f"{value:.5f}" for value in values))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def minutes(run: StudyRun) -> str:
    """Return the time of a run."""
    seconds = run.results.summary.get("wall_time_s")
    return "broke off" if seconds is None else f"{seconds / 60:.1f} min"


def print_tables(
    study: Study, depths: np.ndarray, half: Errors, terms: list[Errors]
) -> None:
    """Print the forces of all runs, and the errors of all terms, at some depths."""
    wanted = [d for d in TABLE_DEPTHS if depths[0] <= d <= depths[-1]]
    at = [int(np.argmin(abs(depths - d))) for d in wanted]
    heads = [f"{force} at {depths[i]:.0f} m" for force in FORCES for i in at]
    rows = []
    for run in study.runs:
        history = run.results.history
        forces = [curves.forces_at(history, c, depths[at]) for c in FORCES.values()]
        values = [f"{force / 1e3:.0f}" for force in np.concatenate(forces)]
        rows.append([run.name, *values, minutes(run)])
    print(table.markdown(["forces (kN)", *heads, "time"], rows) + "\n")
    named = [(term["name"], e) for term, e in zip(study.keys["errors"], terms)]
    rows = [
        [name, *[f"{100 * errors[force][i]:.1f}" for force in FORCES for i in at]]
        for name, errors in [*named, ("all", half)]
    ]
    print(table.markdown(["error (%)", *heads], rows))


def evaluate(studies: Sequence[Study], _: Options, __: float) -> int:
    """Write the file of each study and print its tables. Raises StudyError where a
    run is missing."""
    for study in studies:
        first, last, step = study.keys["depths"]
        depths = np.arange(first, last + step / 2, step)
        try:
            terms = [term_errors(t, study, depths) for t in study.keys["errors"]]
            half = {f: np.sqrt(sum(t[f] ** 2 for t in terms)) for f in FORCES}
            path = study.file.parent / study.keys["output"]
            write_file(path, study, depths, half, terms)
            print_tables(study, depths, half, terms)
        except ResultsError as error:
            raise StudyError(str(error)) from error
    return 0
