# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the coarsest mesh with which a scene reaches the error that is wanted, for
`caisson run --error`.

Similar meshes are run from the coarsest on. With two of them and more each has an error
bar. The coarsest whose bar of the total force is small enough at nine tenths of the
depths is the one that is wanted; the scene then runs on it, with its bar.
"""
import argparse
from pathlib import Path
from typing import Any

import numpy as np

from caisson import run_error_bar, study_command
from caisson.error_bars import command, bar_study
from caisson.progress import duration
from caisson.study import Options, Study, StudyError

BUDGET = 7200.0  # s of all runs on one core, if none is given
SHARE = 90  # percent of the depths at which the error must be small enough
ALL, NOT_MESH = "all", "all but the mesh"
REMEDIES = {
    command.INERTIA: "a quarter of Time/Inertia tolerance, or of Time/Mass scaling",
    command.STEP: "half of Time/Courant number",
    command.POINTS: "one more of Material points/Per direction in path, near and far",
    command.SIDES: "Grid/Outer radius and Grid/Bottom 1.5 times as far away",
}


def error_of(text: str) -> float:
    """Return an error such as 5% as a share. Raises ArgumentTypeError."""
    try:
        percent = float(text.strip().removesuffix("%"))
    except ValueError:
        percent = 0.0
    if not 0 < percent < 100:
        raise argparse.ArgumentTypeError(f"{text!r} is not an error such as 5%")
    return percent / 100


def errors_by_term(study: Study) -> dict[str, float]:
    """Return the errors of the total force that are not exceeded at nine tenths of the
    depths: by term, of all terms, and of all but the mesh."""
    depths, errors = bar_study.depths_of(study), study.keys["errors"]
    terms = [bar_study.term_errors(term, study, depths) for term in errors]
    bars = {term["name"]: bar for term, bar in zip(errors, terms)}
    bars[ALL] = bar_study.combined(terms)
    bars[NOT_MESH] = bar_study.combined(terms[1:])
    return {
        name: float(np.percentile(bar["total"].max(axis=0), SHARE))
        for name, bar in bars.items()
    }


def in_percent(share: float) -> str:
    """Return an error for a message."""
    return f"{100 * share:.1f} %"


def check_mesh_matters(errors: dict[str, float], wanted: float) -> None:
    """Raise StudyError where no mesh reaches the error that is wanted."""
    if errors[NOT_MESH] <= wanted:
        return
    largest = max(REMEDIES, key=lambda name: errors.get(name, 0))
    raise StudyError(
        f"no mesh reaches {in_percent(wanted)}: the other numerics of the scene have"
        f" an error of {in_percent(errors[NOT_MESH])}, and {largest} alone"
        f" {in_percent(errors[largest])}. Set {REMEDIES[largest]}"
    )


def mesh_for(
    scene: Path, wanted: float, budget: float, directory: Path
) -> tuple[dict[str, Any], Path]:
    """Return the entries of the mesh with which the error of a scene is at most the one
    that is wanted, and its error bar. Prints the errors of the meshes, whose
    runs go to the directory. Raises RunError and StudyError, also where the budget (s)
    ends before."""
    directory.mkdir(parents=True, exist_ok=True)
    bar = (directory / run_error_bar.NAME).resolve()
    plan = command.Plan(scene, directory, bar, np.inf)
    left, names, reached = budget, dict[float, str](), ""
    for r in plan.chosen:
        if left < (cost := plan.cost_of(r, is_first=not names)):
            more = command.in_units(budget - left + cost)
            raise StudyError(
                f"the error bar needs {more} on one core; the budget is"
                f" {duration(budget)}{reached}. Set --budget {more}: runs that are"
                " complete are not repeated"
            )
        left -= cost
        names[r] = f"refinement {r:g}"
        plan.run_missing(plan.study(names), study_command.ALL)
        if len(names) < 2:
            continue
        for mesh, name in names.items():
            study = plan.study(names, name)
            command.set_depths(study, plan.depths)
            errors = errors_by_term(study)
            print(f"{name}: error of the total force {in_percent(errors[ALL])}")
            if errors[ALL] <= wanted:
                bar_study.evaluate([study], Options(), 0)
                return plan.mesh(mesh), bar
        check_mesh_matters(errors, wanted)
        reached = f"; {in_percent(errors[ALL])} are reached"
    raise StudyError(f"no finer mesh is known here{reached}")
