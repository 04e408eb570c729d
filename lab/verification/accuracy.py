# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "accuracy": error against time over meshes and choices of the
method, one at a time.

Draws one picture per study, error against processor time of one core, and prints
the cheapest run for each error in ASKED. Runs with a uniform mass scaling, the default
until 2026-11, are gray. The best estimate from its meshes, which are similar, is
a point of its own. Keys of a study beside the usual ones:

    measure   what the relative error is of
    check     as before the first colon in Verification/Checks of the scene; or
    column, depths   a column of history.csv and the penetrations (m) at which its
              means over 0.2 m are compared with those of the reference run
"""
from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.figure import Figure

from caisson import curves, table
from caisson.paths import short
from caisson.results import ResultsError
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError
from caisson import disk
from caisson.error_bars.bar_study import refinement_of
from caisson.error_bars.mesh_error import mesh_error
from lab.curves import relative_error
from lab.verification import find_check

NAME = "accuracy"
STUDY_KEYS = set("measure check column depths".split())
JOBS = 2  # runs at a time: more would take each other's memory and change the times
ASKED = [0.01, 0.02, 0.03, 0.05, 0.1]
DEFAULT, REFERENCE = "default", "reference"
FORMER = "mass scaling"  # begins the names of variants that were the default
COLUMNS = ["problem", "variant", "mesh", "seconds", "relative_error"]

Found = list[tuple[StudyRun, float, float | None]]  # run, processor time (s), error


def seconds_of(run: StudyRun) -> float | None:
    """Return the processor time of a run, None where it failed."""
    record = run.run.completion_record()
    return None if record is None else float(record["cpu_s"])


def forces(study: Study, run: StudyRun) -> np.ndarray:
    """Return the means of the force that is compared: [n_depths]."""
    depths = np.array(study.keys["depths"])
    return curves.forces_at(run.results.history, study.keys["column"], depths)


def error_of(study: Study, run: StudyRun) -> float | None:
    """Return the relative error, from the check of the scene or against the forces
    of the finest run; None where there is none."""
    try:
        if "check" not in study.keys:
            reference = forces(study, study.run(REFERENCE))
            return relative_error(forces(study, run), reference)
        return float(find_check(run, study.keys["check"])["relative_error"])
    except (ResultsError, StudyError, KeyError, TypeError):
        return None


def extrapolated(study: Study, found: Found) -> tuple[float, float] | None:
    """Return processor time (s) and relative error of the best estimate from all
    meshes, None where there are less than two or no forces."""
    runs = [(run, s) for run, s, _ in found if run.variant == DEFAULT]
    if "check" in study.keys or len(runs) < 2:
        return None
    sizes = np.array([1 / refinement_of(run) for run, _ in runs])
    values = np.array([forces(study, run) for run, _ in runs])
    limit = mesh_error(sizes, values, 0).limit
    error = relative_error(limit, forces(study, study.run(REFERENCE)))
    return sum(seconds for _, seconds in runs), error


def find(study: Study) -> Found:
    """Return the runs of a study but its reference, with time and error."""
    found = []
    for run in study.runs:
        seconds = seconds_of(run)
        if run.name != REFERENCE and seconds is not None:
            found.append((run, seconds, error_of(study, run)))
    return found


def draw(study: Study, found: Found, options: Options) -> None:
    """Draw error against time, a line for each choice."""
    figure = Figure(figsize=(9, 5))
    axes = figure.subplots()
    for i, name in enumerate(dict.fromkeys(run.variant for run, _, _ in found)):
        shown = sorted((s, e) for run, s, e in found if run.variant == name and e)
        if not shown:
            continue
        if name == DEFAULT:
            style = dict(color="black", lw=2.5, marker="*", ms=11, zorder=5)
        elif name.startswith(FORMER):
            style = dict(color="0.6", lw=2.5, marker="s", ms=6, zorder=4)
        else:
            style = dict(color=f"C{i % 10}", lw=1, marker="osv^D<>Ph"[i % 9], ms=5)
        axes.loglog(*zip(*shown), label=name, **style)
    if point := extrapolated(study, found):
        style = dict(color="black", ls="", marker="*", ms=13, mfc="white", zorder=6)
        axes.loglog(*point, label="best estimate", **style)
    axes.set_xlabel("processor time on one core (s)")
    axes.set_ylabel(f"relative error: {study.keys['measure']}")
    axes.set_title(study.title, fontsize=10)
    axes.grid(color="0.9", which="both")
    axes.legend(fontsize=8, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    figure.set_layout_engine("tight")
    path = options.results / f"accuracy_{study.id}.png"
    disk.save(figure, path, dpi=130)
    print(f"accuracy: {short(path)}")


def cheapest(found: Found, asked: float, text: Callable[[StudyRun], str]) -> str:
    """Return what the table says of the run that reaches an error in least time."""
    fit = [(s, run) for run, s, e in found if e is not None and e <= asked]
    if not fit:
        return "not reached"
    seconds, run = min(fit, key=lambda pair: pair[0])
    return f"{text(run)}: {seconds:.1f} s"


def line_of(study: Study, found: Found) -> list[str]:
    """Return the line of a study: the cheapest of all and of the default."""
    of_default = [entry for entry in found if entry[0].variant == DEFAULT]
    cells = [study.title]
    for asked in ASKED:
        cells.append(cheapest(found, asked, lambda run: f"{run.variant}, {run.mesh}"))
        cells.append(cheapest(of_default, asked, lambda run: run.mesh))
    return cells


def evaluate(studies: Sequence[Study], options: Options, _: float) -> int:
    """Write the pictures, table.md and table.csv, and print the table."""
    rows, lines = [], []
    for study in studies:
        found = find(study)
        draw(study, found, options)
        lines.append(line_of(study, found))
        for run, seconds, error in found:
            shown = "failed" if error is None else f"{error:.3g}"
            rows.append([study.id, run.variant, run.mesh, f"{seconds:.2f}", shown])
    table.write_csv(options.results / "table.csv", COLUMNS, rows)
    whose = ("cheapest", "default")
    heads = [f"{100 * asked:.0f} %: {who}" for asked in ASKED for who in whose]
    text = table.markdown(["problem", *heads], lines)
    disk.write(options.results / "table.md", text + "\n")
    print(text)
    return 0
