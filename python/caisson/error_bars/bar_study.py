# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "error bar": of the forces of an installation, and of its suction
where it has one, from runs with changed numerics.

Keys of the study beside the usual ones:

    output    the file to write, relative to the study
    depths    first, last, step (m of penetration)
    [[errors]]
    name = "mesh"
    meshes = ["coarse", "default", "fine"]   # runs with other Grid/Refinement

    [[errors]]
    name = "points"    each other term compares two runs:
    from = "default"
    to = "many_points"
    factor = 1         extrapolates to the limit: 2 from a halved quantity on which
                       the error depends linearly, 1 from a refined one
    depths = [1, 4]    where the term counts, if not everywhere (m)
    at = 2             the only depth at which the runs are compared, if one is (m)

What the meshes make of it: caisson.error_bars.mesh_error. The error of another term at
a depth is

    factor * rms (F_from - F_to) / F_from    over 0.5 m about it

with forces averaged over 0.2 m, on both sides. Errors of the suction, the exit gradient
and the heave are absolute, without the division, because these cross zero. Each side of
the error bar is the root of the sum of the squares of all terms; that of a force is at
least 1 %. One run must be called "default".
"""
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from caisson import curves, table
from caisson.paths import short
from caisson.progress import duration
from caisson.results import ResultsError, Table
from caisson.run_error_bar import FORCES, SUCTION, Quantity
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError
from caisson.error_bars.mesh_error import MeshError, mesh_error

NAME = "error bar"
STUDY_KEYS = {"output", "depths", "errors"}
ERROR_WINDOW = 0.5  # m
LEAST = 0.01  # of a force: less is chance
SIDES = ("below", "above")
MOST_SHOWN = 6  # depths in a table, about


# by name of the quantity: how far the truth may lie below and above, [2, n_depths]
Errors = dict[str, np.ndarray]


def quantities_of(history: Table) -> list[Quantity]:
    """Return what a run with this history has: forces that are not zero throughout, as
    friction without a wall, and suction if it acts."""
    return [q for q in FORCES + SUCTION if np.any(history.get(q.column(), 0))]


def values_of(run: StudyRun, quantity: Quantity, depths: np.ndarray) -> np.ndarray:
    """Return the means of a quantity about depths [n] (m) in a run: [n]."""
    return curves.forces_at(run.results.history, quantity.column(), depths)


def refinement_of(run: StudyRun) -> float:
    """Return the Grid/Refinement in effect in a finished run."""
    given = run.run.entries.get("Grid/Refinement")
    return float(given or run.results.entry("Grid/Refinement") or 1)


def relative(part: np.ndarray, whole: np.ndarray) -> np.ndarray:
    """Return part / whole, and 0 where there is nothing, as without friction."""
    return np.divide(part, whole, out=np.zeros_like(part), where=whole != 0)


def mesh_error_of(
    study: Study, names: Sequence[str], quantity: Quantity, depths: np.ndarray
) -> MeshError:
    """Return the error of the run called default, from these runs on similar meshes;
    nan at the depths [n] that not all of them reach."""
    runs = [study.run(name) for name in names]
    sizes = [1 / refinement_of(run) for run in runs]
    values = np.array([values_of(run, quantity, depths) for run in runs])
    default, is_force = list(names).index("default"), quantity.name.endswith("force")
    return mesh_error(np.array(sizes), values, default, is_force)


def error_of_change(
    term: dict[str, Any], study: Study, quantity: Quantity, depths: np.ndarray
) -> np.ndarray:
    """Return the error by a term that compares two runs at depths [n]: [n]."""
    at = np.full_like(depths, term["at"]) if "at" in term else depths
    changed, other = [
        values_of(study.run(term[key]), quantity, at) for key in ("from", "to")
    ]
    difference = changed - other
    if quantity.is_relative:
        difference = relative(difference, changed)
    return term["factor"] * curves.window_rms(depths, difference, ERROR_WINDOW)


def sides_of(
    term: dict[str, Any], study: Study, quantity: Quantity, depths: np.ndarray
) -> np.ndarray:
    """Return the error of a quantity by one term below and above it, [2, n_depths]."""
    if "meshes" not in term:
        return np.array([error_of_change(term, study, quantity, depths)] * 2)
    error = mesh_error_of(study, term["meshes"], quantity, depths)
    sides = np.array([error.below, error.above])
    if not quantity.is_relative:
        return sides
    values = values_of(study.run("default"), quantity, depths)
    return np.array([relative(side, np.abs(values)) for side in sides])


def where_it_counts(term: dict[str, Any], depths: np.ndarray) -> np.ndarray:
    """Return at which of the depths [n] a term counts: [n]."""
    first, last = term.get("depths", (depths[0], depths[-1]))
    return (depths > first - curves.EDGE) & (depths < last + curves.EDGE)


def term_errors(term: dict[str, Any], study: Study, depths: np.ndarray) -> Errors:
    """Return the errors of all quantities by one term, 0 where it does not count.
    Raises StudyError where a run does not reach that far."""
    counts = where_it_counts(term, depths)
    errors = {}
    for quantity in quantities_of(study.run("default").results.history):
        sides = sides_of(term, study, quantity, depths[counts])
        if not np.all(np.isfinite(sides)):
            raise StudyError(
                f"the error {term['name']!r} counts to {depths[counts][-1]:.4g} m, and"
                " one of its runs ends before; set its depths"
            )
        errors[quantity.bar] = np.zeros((2, len(depths)))
        errors[quantity.bar][:, counts] = sides
    return errors


def combined(terms: Sequence[Errors]) -> Errors:
    """Return the error bars: the roots of the sums of the squares of all terms."""
    bars = {
        name: np.sqrt(np.sum([term[name] ** 2 for term in terms], axis=0))
        for name in terms[0]
    }
    for quantity in (q for q in FORCES if q.bar in bars):
        bars[quantity.bar] = np.maximum(bars[quantity.bar], LEAST)
    return bars


def shift_to_limit(
    study: Study, depths: np.ndarray, quantity: Quantity
) -> dict[str, np.ndarray]:
    """Return the column with what leads from the default mesh to the limit of all
    meshes, if there are such runs: relative for a force, and 0 where they have no order
    or do not all reach that far."""
    for names in (term["meshes"] for term in study.keys["errors"] if "meshes" in term):
        values = values_of(study.run("default"), quantity, depths)
        error = mesh_error_of(study, names, quantity, depths)
        shift = np.where(error.failed, 0.0, error.limit - values)
        if quantity.is_relative:
            shift = relative(shift, values)
        return {quantity.bar_column("shift"): np.nan_to_num(shift)}
    return {}


def file_columns(
    study: Study, depths: np.ndarray, bars: Errors, terms: list[Errors]
) -> dict[str, list[str]]:
    """Return the columns of the file as text: relative errors of the forces on both
    sides, with their terms, then the values, errors and terms of the suction."""
    history = study.run("default").results.history
    names = [term["name"].replace(" ", "_") for term in study.keys["errors"]]
    columns = {"penetration_m": [f"{depth:.2f}" for depth in depths]}
    for group in (FORCES, SUCTION):
        present = [q for q in group if q.bar in bars]
        text = ".5f" if group is FORCES else ".5g"
        values = {
            q.column(): curves.forces_at(history, q.column(), depths)
            for q in present
            if not q.is_relative
        }
        for q in present:
            values |= {q.bar_column(s): bars[q.bar][i] for i, s in enumerate(SIDES)}
            values |= shift_to_limit(study, depths, q)
        for name, term in zip(names, terms):
            for i, side in enumerate(SIDES):
                values |= {q.bar_column(name, side): term[q.bar][i] for q in present}
        columns |= {n: [f"{value:{text}}" for value in v] for n, v in values.items()}
    return columns


def write_file(
    path: Path, study: Study, depths: np.ndarray, bars: Errors, terms: list[Errors]
) -> None:
    """Write the file that caisson.run_error_bar reads."""
    base = study.run("default")
    columns = file_columns(study, depths, bars, terms)
    of = "forces and suction" if len(bars) > len(FORCES) else "forces"
    remarks = [
        f"Errors of the {of} of {base.run.scene.name}, by caisson error-bar",
        f"fingerprint: {base.results.summary['fingerprint']}",
    ]
    table.write_csv(path, list(columns), list(zip(*columns.values())), remarks)


def print_table(
    study: Study, depths: np.ndarray, named: list[tuple[str, Errors]], q: Quantity
) -> None:
    """Print a quantity of all runs, and its errors by all terms, at depths [m]."""
    heads = [f"{depth:.4g} m" for depth in depths]
    unit = f" ({q.shown_unit})" if q.shown_unit else ""
    rows = []
    for run in study.runs:
        values = curves.forces_at(run.results.history, q.column(), depths)
        seconds = run.results.summary.get("wall_time_s")
        time = "broke off" if seconds is None else duration(seconds)
        rows.append([run.name, *map(q.text, values), time])
    print(table.markdown([f"{q.column()}{unit}", *heads, "time"], rows) + "\n")
    rows = []
    for name, errors in named:
        below, above = errors[q.bar]
        rows.append([name, *(in_words(q, *sides) for sides in zip(below, above))])
    print(table.markdown(["error", *heads], rows) + "\n")


def in_words(quantity: Quantity, below: float, above: float) -> str:
    """Return the error on both sides."""
    if quantity.is_relative:
        texts, unit = [f"{100 * error:.1f}" for error in (below, above)], " %"
    else:
        texts, unit = [quantity.text(error) for error in (below, above)], ""
    if texts[0] == texts[1]:
        return f"+-{texts[0]}{unit}"
    return f"-{texts[0]} +{texts[1]}{unit}"


def share_in_bar(
    study: Study, finest: StudyRun, names: Sequence[str], depths: np.ndarray
) -> dict[str, float]:
    """Return the share of the depths where a run on the finest mesh lies in the error
    bar that is made from the other meshes, by quantity; nothing where these are less
    than two, or without that of the scene."""
    others = [name for name in names if name != finest.name]
    if len(others) < 2 or "default" not in others:
        return {}
    terms = [
        {**term, "meshes": others} if "meshes" in term else term
        for term in study.keys["errors"]
    ]
    bars = combined([term_errors(term, study, depths) for term in terms])
    shares = {}
    for q in (q for q in FORCES + SUCTION if q.bar in bars):
        value = values_of(study.run("default"), q, depths)
        rise = values_of(finest, q, depths) - value
        if q.is_relative:
            rise = relative(rise, value)
        below, above = bars[q.bar]
        shares[q.bar] = float(np.mean((rise >= -below) & (rise <= above)))
    return shares


def print_meshes(study: Study, depths: np.ndarray, names: Sequence[str]) -> None:
    """Print what the similar meshes say of themselves: their order, and the finest
    one as the test of a bar that is made without it."""
    runs = [study.run(name) for name in names]
    if len(runs) < 3:
        print("Two meshes: nothing confirms the error by the mesh.\n")
        return
    finest = max(runs, key=refinement_of)
    shares = share_in_bar(study, finest, names, depths)
    rows = []
    for q in quantities_of(study.run("default").results.history):
        error = mesh_error_of(study, names, q, depths)
        order = f"{np.mean(error.order):.1f}"
        failed = f"{100 * np.mean(error.failed):.0f} %"
        held = f"{100 * shares[q.bar]:.0f} %" if q.bar in shares else "-"
        rows.append([q.bar, order, failed, held])
    heads = ["meshes", "order", "not of order 1", f"{finest.name} in bar of the others"]
    print(table.markdown(heads, rows) + "\n")
    print(
        "Order: in the mean over the depths. Not of order 1: the share of the depths"
        " where the meshes go to and fro, or have an order below 0.5. There, the bar is"
        " three times their spread. Last column: the share of the depths where the"
        " finest mesh lies in a bar that is made without it. A dash: not known.\n"
    )


def print_tables(
    study: Study, depths: np.ndarray, bars: Errors, terms: list[Errors]
) -> None:
    """Print all quantities of all runs, and the errors of all terms, at some depths."""
    names = [*(term["name"] for term in study.keys["errors"]), "all"]
    for q in (q for q in FORCES + SUCTION if q.bar in bars):
        at = chosen_depths(depths)
        chosen = [{q.bar: errors[q.bar][:, at]} for errors in [*terms, bars]]
        print_table(study, depths[at], list(zip(names, chosen)), q)
    for term in study.keys["errors"]:
        if "meshes" in term:
            print_meshes(study, depths[where_it_counts(term, depths)], term["meshes"])


def chosen_depths(depths: np.ndarray) -> list[int]:
    """Return the numbers of some round depths [n] for a table, or of the few that there
    are."""
    if len(depths) <= MOST_SHOWN:
        return list(range(len(depths)))
    wanted = curves.round_depths(depths)
    wanted = wanted[:: max(1, round(len(wanted) / MOST_SHOWN))]
    return sorted({int(np.argmin(abs(depths - depth))) for depth in wanted})


def depths_of(study: Study) -> np.ndarray:
    """Return the depths of the bar: [n] (m)."""
    first, last, step = study.keys["depths"]
    return np.arange(first, last + step / 2, step)


def evaluate(studies: Sequence[Study], _: Options, __: float) -> int:
    """Write the file of each study and print its tables. Raises StudyError where a
    run is missing."""
    for study in studies:
        depths = depths_of(study)
        try:
            terms = [term_errors(t, study, depths) for t in study.keys["errors"]]
            bars = combined(terms)
            path = study.file.parent / str(study.keys["output"])
            write_file(path, study, depths, bars, terms)
            print_tables(study, depths, bars, terms)
            print(f"error bar: {short(path)}")
        except ResultsError as error:
            raise StudyError(str(error)) from error
    return 0
