# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the coarsest mesh with which a scene reaches the error that is wanted, for
`caisson run --error`.

Similar meshes are run from the coarsest on. With two of them and more the finest has an
error bar. The first whose bar of the total force is small enough at nine tenths of the
depths is the one that is wanted; the scene then runs on it, with its bar.
"""
import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from caisson.paths import PROGRAM
from caisson.progress import duration
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError
from caisson.error import command, error_bar

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


class Search:
    """The meshes of a scene, from the coarsest on."""

    def __init__(self, scene: Path, budget: float, directory: Path) -> None:
        """Ask the program for the scene. directory: of the runs. Raises RunError,
        StudyError and OSError."""
        directory.parent.mkdir(parents=True, exist_ok=True)
        self.plan = command.Plan(
            argparse.Namespace(
                scene=scene,
                program=PROGRAM,
                results=directory,
                output=directory.parent / f"{directory.name}.csv",
                budget=np.inf,
                whole=False,
            )
        )
        self.left = budget
        self.names: dict[float, str] = {}  # of the meshes so far, by refinement
        self.runs: list[StudyRun] = []
        self.errors: list[dict[str, Any]] = [{"name": "mesh"}]

    def cost(self, r: float) -> float:
        """Return how long the next mesh takes on one core (s)."""
        return (
            self.plan.seconds
            * r**3
            * (1 if self.runs else 1 + self.plan.cost_of_changes)
        )

    def add_mesh(self, r: float) -> None:
        """Run a mesh; the first one also with other numerics. Raises StudyError."""
        self.left -= self.cost(r)
        self.names[r] = f"refinement {r:g}"
        runs = [self.plan.run_on(r, self.names[r])]
        if not self.runs:
            changed, terms = self.plan.changed(r, self.names[r])
            runs += changed
            self.errors += terms
        self.plan.execute(runs, False)
        self.runs += runs

    def study(self) -> Study:
        """Return the study whose default is the finest mesh so far."""
        plan, finest = self.plan, self.names[max(self.names)]
        self.errors[0]["meshes"] = [
            "default" if name == finest else name for name in self.names.values()
        ]
        runs = [
            replace(run, name="default") if run.name == finest else run
            for run in self.runs
        ]
        keys = {"errors": self.errors, "output": str(self.bar_file)}
        study = Study(plan.scene.stem, plan.scene.stem, plan.scene, runs, keys)
        command.set_depths(study, plan.depths)
        return study

    @property
    def bar_file(self) -> Path:
        """The error bar of the mesh that is wanted."""
        return (self.plan.results / "error_bar.csv").resolve()

    def errors_by_term(self) -> dict[str, float]:
        """Return the errors of the total force on the finest mesh so far that are not
        exceeded at nine tenths of the depths: by term, of all terms, and of all but the
        mesh."""
        study = self.study()
        depths = error_bar.depths_of(study)
        terms = [error_bar.term_errors(t, study, depths) for t in self.errors]
        bars = {term["name"]: bar for term, bar in zip(self.errors, terms)}
        bars[ALL] = error_bar.combined(terms)
        bars[NOT_MESH] = error_bar.combined(terms[1:])
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
    search = Search(scene, budget, directory)
    reached = ""
    for r in search.plan.chosen:
        if search.left < (cost := search.cost(r)):
            more = command.in_units(budget - search.left + cost)
            raise StudyError(
                f"the error bar needs {more} on one core; the budget is"
                f" {duration(budget)}{reached}. Set --budget {more}: runs that are"
                " complete are not repeated"
            )
        search.add_mesh(r)
        if len(search.names) < 2:
            continue
        errors = search.errors_by_term()
        print(f"refinement {r:g}: error of the total force {in_percent(errors[ALL])}")
        if errors[ALL] <= wanted:
            error_bar.evaluate([search.study()], Options(), 0)
            return search.plan.mesh(r), search.bar_file
        check_mesh_matters(errors, wanted)
        reached = f"; {in_percent(errors[ALL])} are reached"
    raise StudyError(f"no finer mesh is known here{reached}")
