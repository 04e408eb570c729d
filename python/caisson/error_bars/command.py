# SPDX-License-Identifier: LGPL-2.1-or-later
"""Computes the error bar of a scene: runs it on similar meshes, and with other mass
scaling, steps, points and boundaries, and writes the file beside it that the
report reads.

The budget is the time of all runs on one core. The coarsest mesh, with two cells across
the wall, costs little: it has the runs with other numerics. The error by the mesh comes
from all meshes that the budget allows; with two of them the bar is wide, because
nothing confirms it. The scene itself is not changed.
"""
import argparse
import dataclasses
import json
import math
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from caisson import disk, run_error_bar, study_command
from caisson.paths import PROGRAM, RESULTS, scene_or_study
from caisson.progress import duration
from caisson.ranks import Size
from caisson.runner import Entries, Run, RunError, Status, read_parameters
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError
from caisson.units import SECONDS
from caisson.error_bars import bar_study
from caisson.error_bars.windows import NUMBERS, Window, windows_of, write_means

TIMES_THE_SCENE = 2  # the budget, if none is given
DEFAULT = "default"  # the run that has the error bar
SIZE = "size.json"  # of the scene, beside the runs
ROUNDED = 1.05  # over the budget: not worth a word
CELLS = [1, 2, 3, 4, 6, 8, 12, 16, 24]  # across the wall
PLAIN = [0.5, 0.75, 1.0, 1.5, 2.0, 3.0]  # of a body without cells across
QUIET = {"Output/Frame interval": "never", "Output/Frame penetrations": ""}
# runs with other numerics on the coarsest mesh, and their cost over one without
INERTIA, STEP, POINTS, SIDES = "inertia", "time step", "points", "boundaries"
COST = {INERTIA: 2.0, STEP: 2.0, POINTS: 1.8, SIDES: 1.5}
COST_OF_CHANGES = sum(COST.values())
SHORTEST_WAY = 0.4  # m
TOO_SHORT = (
    f"the body is pushed by less than {SHORTEST_WAY} m, and the depths of an error bar"
    " are 0.1 m apart: such a scene has none"
)


def seconds_of(text: str) -> float:
    """Return a duration such as 90s, 30min or 2h in seconds. Raises
    ArgumentTypeError."""
    found = re.fullmatch(r"(\d+(?:\.\d*)?) *(s|min|h)", text.strip())
    if found is None or not float(found[1]):
        raise argparse.ArgumentTypeError(
            f"{text!r} is not a duration such as 90s, 30min or 2h"
        )
    return float(found[1]) * SECONDS[found[2]]


def in_units(seconds: float) -> str:
    """Return a duration as seconds_of() reads it, rounded up."""
    unit = "s" if seconds < 60 else "min" if seconds < 5400 else "h"
    return f"{math.ceil(seconds / SECONDS[unit])}{unit}"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson error-bar`."""
    add = parser.add_argument
    add("scene", type=scene_or_study, metavar="FILE.prm")
    text = "time of all runs on one core, such as 30min or 2h; default: twice"
    add("--budget", type=seconds_of, metavar="TIME", help=f"{text} that of the scene")
    text = "run the whole way of the scene, also where windows at some depths would do"
    add("--whole", action="store_true", help=text)
    text = "the file to write, default: FILE_error_bar.csv, which the report finds"
    add("--output", type=Path, metavar="CSV", help=text)
    add("--overwrite", action="store_true", help="replace the file if it is there")
    add("--list", action="store_true", help="print the runs, and run nothing")
    study_command.add_running_arguments(parser)
    text = "directory of the runs, default: results/error_bar/FILE"
    add("--results", type=Path, help=text)


def refinements(cells: int, even: bool, least: int) -> list[float]:
    """Return the numbers for Grid/Refinement of a body with so many cells across its
    wall, which must be even for a triangular tip; 0: a body without a wall. least:
    cells across the wall of the coarsest mesh, if it is not that of the scene."""
    if not cells:
        return PLAIN
    wanted = sorted({*CELLS, cells, *(cells * n for n in (2, 3, 4))})
    return [
        n / cells for n in wanted if n == cells or n >= least and not (even and n % 2)
    ]


def chosen_meshes(
    known: list[float], seconds: float, budget: float, changes: float
) -> list[float]:
    """Return the refinements that the budget (s) allows, where a run of the scene takes
    some seconds: a run costs the cube of its refinement; changes: the cost of those
    with other numerics over that of the coarsest."""
    chosen = [r for r in known if r <= 1]
    left = budget - seconds * (sum(r**3 for r in chosen) + changes * min(chosen) ** 3)
    for r in (r for r in known if r > 1):
        left -= seconds * r**3
        if left < 0:
            break
        chosen.append(r)
    return chosen


def changes_of(entries: dict[str, str]) -> dict[str, tuple[dict[str, Any], float]]:
    """Return the runs with other numerics: what they change in the entries of the
    scene, and the factor that extrapolates to the limit."""
    found: dict[str, tuple[dict[str, Any], float]] = {}
    tolerance = entries["Time/Inertia tolerance"]
    if tolerance != "none":
        quarter = {"Time/Inertia tolerance": float(tolerance) / 4}
        found[INERTIA] = quarter, 4 / 3
    elif (scaling := float(entries["Time/Mass scaling"])) > 1:
        less = max(1.0, scaling / 4)
        found[INERTIA] = {"Time/Mass scaling": less}, scaling / (scaling - less)
    courant = float(entries["Time/Courant number"])
    found[STEP] = {"Time/Courant number": courant / 2}, 1
    points = [f"Material points/Per direction {zone}" for zone in ("in path", "near")]
    points.append("Material points/Per direction far")
    found[POINTS] = {name: int(entries[name]) + 1 for name in points}, 1
    sides = ("Grid/Outer radius", "Grid/Bottom")
    found[SIDES] = {name: 1.5 * float(entries[name]) for name in sides}, 1
    return found


def check_entries(entries: Entries) -> None:
    """Raise StudyError where a scene cannot have other meshes."""
    if entries["Installation/Directory"]:
        raise StudyError(
            "the scene goes on from an installation, and has its mesh. Only the scene"
            " of the installation can have an error bar"
        )
    if entries["Time/Time step"] != "auto":
        raise StudyError(
            "a finer mesh needs shorter steps. Set Time/Time step = auto, so that they"
            " follow from the mesh"
        )


class Plan:
    """The runs for the error bar of a scene."""

    def __init__(
        self,
        scene: Path,
        results: Path,
        output: Path,
        budget: float | None = None,
        is_whole: bool = False,
        program: Path = PROGRAM,
    ) -> None:
        """Ask the program for the scene. results: the folder of the runs; output: the
        file of the bar; budget (s): None for twice the scene; is_whole: without
        windows. Raises RunError and StudyError."""
        self.scene, self.program = scene.resolve(), program.resolve()
        if self.scene.suffix == ".toml":
            raise StudyError(
                f"{self.scene.name} is a study. Give the scene, a .prm file, or call"
                " caisson study"
            )
        self.results, self.output = results, output
        self.entries = read_parameters([str(self.scene)], self.program)
        check_entries(self.entries)
        self.check_way()
        self.check_output()
        self.size = self.size_of_scene()
        self.budget = budget or TIMES_THE_SCENE * self.size.seconds
        known = self.choose((0,) if is_whole else NUMBERS)
        self.next = next((r for r in known if r not in self.chosen), 0.0)
        if len(self.chosen) < 2:
            needed = self.seconds * (1 + self.cost_of_changes + self.next**3)
            self.keep_size()  # so that the budget of this message is enough
            raise StudyError(
                f"{duration(self.budget)} is not enough for a second mesh. Set --budget"
                f" {in_units(needed)}, or more cells across the wall: the coarser"
                " meshes then cost little."
            )

    def choose(self, numbers: Sequence[int]) -> list[float]:
        """Choose the meshes that the budget allows and the first of these numbers of
        windows that leaves a part of it for a second mesh. Where none does, the bar
        has a mesh with one cell across the wall, and two others if it can. Return the
        refinements that there are."""
        for cells, least in ((2, 2), (1, 3), (1, 2)):
            known = self.meshes(cells)
            for number in numbers:
                self.windows = windows_of(self.entries, number)
                self.seconds = self.size.seconds * self.share_of_way()
                changes = self.cost_of_changes
                self.chosen = chosen_meshes(known, self.seconds, self.budget, changes)
                if len(self.chosen) >= least:
                    return known
        return known

    def share_of_way(self) -> float:
        """Return the share of the way of the scene that a run takes."""
        if not self.windows:
            return 1.0
        start = float(self.entries["Rigid body/Initial penetration"])
        way = float(self.entries["Time/End penetration"]) - start
        return len(self.windows) * self.windows[0].length / way

    @property
    def depths(self) -> list[float]:
        """The depths (m) at which windows give a bar: where they end. That of a single
        one holds for all of the way but its first part, which is as long as itself."""
        if len(self.windows) != 1:
            return [window.depth for window in self.windows]
        start = float(self.entries["Rigid body/Initial penetration"])
        end = float(self.entries["Time/End penetration"])
        return [start + self.windows[0].length, end]

    @property
    def cost_of_changes(self) -> float:
        """The cost of all runs with other numerics over that of one without. Windows
        have them at one depth."""
        return COST_OF_CHANGES / max(1, len(self.windows))

    def check_way(self) -> None:
        """Raise StudyError where the body is not pushed far enough."""
        if self.entries["Rigid body/Velocity"].startswith("-"):
            raise StudyError("the body is pulled out: error bars are for its way down")
        try:
            end = float(self.entries["Time/End penetration"])
        except ValueError:  # another end: a short way is seen after the runs
            return
        if end - float(self.entries["Rigid body/Initial penetration"]) < SHORTEST_WAY:
            raise StudyError(TOO_SHORT)

    def check_output(self) -> None:
        """Raise StudyError where the file cannot be written."""
        folder = self.output.resolve().parent
        if not os.access(folder, os.W_OK):
            raise StudyError(f"{folder} cannot be written. Choose --output")
        if self.output.is_dir():
            raise StudyError(f"{self.output} is a directory. Choose --output")
        if self.output.resolve() == self.scene:
            raise StudyError(f"{self.output} is the scene. Choose another --output")

    def size_of_scene(self) -> Size:
        """Return the points of the scene and how long it takes on one core: as an
        earlier call has found it, so that the same budget allows the same runs, or as
        the program says. It does not where its first steps took no time that it could
        measure."""
        run = self.run(DEFAULT, {}).run
        try:
            found = json.loads((self.results / SIZE).read_text("utf-8"))
            if found.pop("key") == run.key:
                return Size(**found)
        except (OSError, ValueError, TypeError, KeyError, AttributeError):
            pass  # there is none, or a broken one
        for _ in range(3):
            size = run.validate()
            if size.seconds:
                return size
        raise StudyError("the time of the scene is not known; repeat the command")

    def keep_size(self) -> None:
        """Write the size of the scene for later calls."""
        disk.make_directory(self.results)
        key = self.run(DEFAULT, {}).run.key
        content = {"key": key, **dataclasses.asdict(self.size)}
        disk.write(self.results / SIZE, json.dumps(content))

    def sized(self, r: float, cost: float = 1.0) -> Size:
        """Return the size of a run on a mesh, where a step costs more by a factor."""
        seconds = cost * self.seconds * r**3
        least = seconds * self.size.least / self.size.seconds
        return Size(round(self.size.points * r**2), seconds, least)

    def run(
        self,
        name: str,
        entries: dict[str, Any],
        size: Size = Size(),
        windows: Sequence[Window] = (),
    ) -> StudyRun:
        """Return a run of the scene, in windows if there are any."""
        directory = (self.results / name.replace(" ", "_")).resolve()
        run = Run(self.scene, {**QUIET, **entries}, directory, program=self.program)
        known = {"windows": windows}
        return StudyRun(self.scene.stem, name, run, known, size=size)

    def parts_of(self, run: StudyRun) -> list[StudyRun]:
        """Return the runs that are made for a run: of its windows, or itself."""
        parts, n = [], len(windows := run.settings["windows"])
        for window in windows:
            changed = window.entries(self.entries | run.run.entries)
            part = Run(
                self.scene,
                {**run.run.entries, **changed},
                run.run.directory / window.name,
                program=self.program,
            )
            size = Size(run.size.points, run.size.seconds / n, run.size.least / n)
            name = f"{run.name} {window.name}"
            parts.append(dataclasses.replace(run, name=name, run=part, size=size))
        return parts or [run]

    def meshes(self, least: int) -> list[float]:
        """Return the refinements that fit the body and that the program accepts; see
        refinements()."""
        kind = self.entries["Rigid body/Kind"]
        if kind not in ("caisson", "box", "cone", "pile"):
            raise StudyError("the scene has no body that is pushed into the soil")
        has_wall = kind != "box"
        cells = 0
        if has_wall:
            refined = float(self.entries["Grid/Refinement"])
            cells = round(
                int(self.entries["Rigid body/Cells across the wall"]) * refined
            )
        even = kind == "caisson" and self.entries["Rigid body/Tip"] == "triangular"
        return [r for r in refinements(cells, even, least) if self.fits(r, cells)]

    def fits(self, r: float, cells: int) -> bool:
        """Return whether a mesh can be made: the program is asked for coarse ones."""
        name = "Grid/Refinement levels"
        levels = int({**self.entries, **self.mesh(r)}[name])
        if round(cells * r) % 2**levels:
            return False
        try:
            if r < 1:
                self.run("", self.mesh(r)).run.validate()
        except RunError:
            return False
        return True

    def mesh(self, r: float) -> dict[str, Any]:
        """Return the entries of a mesh, none of that of the scene. Cells that are
        halved at the tip are halved less often on a coarser one: lines of the mesh
        cannot be wider apart than the wall."""
        if r == 1:
            return {}
        found: dict[str, Any] = {
            "Grid/Refinement": r * float(self.entries["Grid/Refinement"])
        }
        less = math.ceil(-math.log2(r)) if r < 1 else 0
        for name in ("Grid/Refinement levels", "Grid/Refinement levels along wall"):
            if levels := int(self.entries[name]):
                found[name] = max(0, levels - less)
        return found

    def changed(self, r: float, of: str) -> tuple[list[StudyRun], list[dict[str, Any]]]:
        """Return the runs with other numerics on a mesh, and their terms of the error
        bar; of: the name of the run of the mesh itself."""
        runs, terms = [], []
        middle = len(self.windows) // 2
        one = self.windows[middle : middle + 1]
        share = 1 / max(1, len(self.windows))
        # a single window has its means at the ends of the way
        at = {"at": one[0].depth if middle else self.depths[0]} if one else {}
        for name, (entries, factor) in changes_of(self.entries).items():
            size = self.sized(r, COST[name] * share)
            runs.append(self.run(name, {**entries, **self.mesh(r)}, size, one))
            term = {"name": name, "from": of, "to": name, "factor": factor}
            terms.append({**term, **at})
        return runs, terms

    def cost_of(self, r: float, is_first: bool) -> float:
        """Return how long a mesh takes on one core (s), the first one also with other
        numerics."""
        more = self.cost_of_changes if is_first else 0.0
        return self.seconds * r**3 * (1 + more)

    def study(self, names: Mapping[float, str], default: str = DEFAULT) -> Study:
        """Return the runs on meshes, which have names by refinement, and the terms of
        the error bar. default: the name of the run that has it, and is called so."""
        runs = [
            self.run(name, self.mesh(r), self.sized(r), self.windows)
            for r, name in names.items()
        ]
        called = {r: name if name != default else DEFAULT for r, name in names.items()}
        for run, name in zip(runs, called.values()):
            run.name = name
        coarsest = min(names)
        changed, terms = self.changed(coarsest, called[coarsest])
        errors = [{"name": "mesh", "meshes": list(called.values())}, *terms]
        keys = {"errors": errors, "output": str(self.output.resolve())}
        return Study(self.scene.stem, self.scene.stem, self.scene, runs + changed, keys)

    def run_missing(self, study: Study, options: argparse.Namespace) -> int | None:
        """Make what is not complete, and write the means of windows; return the exit
        status of a part of the runs, else None. Raises StudyError where a run has no
        result, or a window does not reach its depth."""
        self.keep_size()
        parts = {run.name: self.parts_of(run) for run in study.runs}
        every = [part for of_run in parts.values() for part in of_run]
        status = study_command.run_missing(every, options, needs_all=True)
        if status is not None:
            return status
        if missing := [run for run in every if not run.run.is_complete()]:
            cause = next((run for run in missing if run.trouble), missing[0])
            raise StudyError(f"{cause.name}: {cause.words}")
        for run in study.runs:
            if windows := run.settings["windows"]:
                for part in parts[run.name]:
                    if part.status != Status.SUCCESS:
                        raise StudyError(f"{part.name} ended early, see {part.log}")
                found = [part.results for part in parts[run.name]]
                write_means(run.run, windows, self.depths, found)
        return None


def set_depths(study: Study, windowed: Sequence[float]) -> None:
    """Set the depths of the bar: those of windows (m), or all that the run of the scene
    passes on its way down, without half a window at both ends and without the first
    0.3 m."""
    if windowed:
        first, second, *_, last = *windowed, windowed[-1]
        study.keys["depths"] = [first, last, second - first]
        return
    depth = study.run(DEFAULT).results.history["penetration_m"]
    first, last = depth[0] + 0.3, depth.max() - 0.1
    if last < first:
        raise StudyError(TOO_SHORT)
    study.keys["depths"] = [round(first, 1), round(last, 6), 0.1]


def advise(plan: Plan, study: Study) -> None:
    """Print how the report finds the bar, what it does not hold, and what the next
    finer mesh would cost."""
    suction = study.run(DEFAULT).results.history.get("suction_Pa", np.zeros(1))
    if plan.windows and suction.any():
        print(
            "Suction moves soil on the way to a depth, and windows do not see this: the"
            " bar may be wrong where the flow is strong. --whole runs all of the way."
        )
    if len(plan.windows) == 1:
        print(
            "The budget allowed one window: its error stands for the whole way. More"
            " --budget gives more windows."
        )
    if plan.output.resolve() != run_error_bar.beside(plan.scene).resolve():
        print(f"Give it to the report: caisson report --error-bar {plan.output} DIR.")
    if plan.next:
        cost = duration(plan.seconds * plan.next**3)
        what = (
            "With it the safety factor of the error by the mesh is 1.25 instead of 3,"
            " where the meshes agree."
            if len(plan.chosen) < 3
            else "If the scene used it, its error by the mesh would be about"
            f" {1 / plan.next:.2f} times the one above, where the meshes have an order."
        )
        print(
            f"The next finer mesh, {plan.next:g} times as fine as that of the scene,"
            f" takes about {cost} on one core. {what}"
        )


def main(arguments: argparse.Namespace) -> int:
    """Run and write the file."""
    scene: Path = arguments.scene
    plan = Plan(
        scene,
        arguments.results or RESULTS / "error_bar" / scene.stem,
        arguments.output or run_error_bar.beside(scene.resolve()),
        arguments.budget,
        arguments.whole,
        arguments.program,
    )
    names = {r: f"refinement {r:g}" if r != 1 else DEFAULT for r in plan.chosen}
    study = plan.study(names)
    total = sum(run.duration for run in study.runs)
    for run in study.runs:
        print(f"{run.name}: about {duration(run.duration)}")
    print(f"all runs: about {duration(total)} on one core", flush=True)
    if total > ROUNDED * plan.budget:
        print(f"This is more than the budget, {duration(plan.budget)}.")
    if arguments.list:
        return 0
    parts = (part for run in study.runs for part in plan.parts_of(run))
    is_kept = not (arguments.overwrite or arguments.part) and plan.output.exists()
    if is_kept and not all(part.run.is_complete() for part in parts):
        raise StudyError(
            f"{plan.output} exists. Choose --output, or replace it by --overwrite"
        )
    if (status := plan.run_missing(study, arguments)) is not None:
        return status
    set_depths(study, plan.depths)
    with disk.all_or_none(arguments.overwrite):
        bar_study.evaluate([study], Options(), 0)
    advise(plan, study)
    return 0
