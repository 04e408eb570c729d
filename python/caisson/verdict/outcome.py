# SPDX-License-Identifier: LGPL-2.1-or-later
"""What came out of a run: where suction ends, the numbers at depths, the largest force
and suction, the margins and the largest pull.

Suction ends at the depth where the required one reaches the allowable one. What a run
has behind it belongs to a plug that is lifted, or to a pump that nobody has: it stands
in no card, maximum or margin. All follows from history.csv and run.json of the program.
"""
import functools
from pathlib import Path
from typing import Any

import numpy as np

from caisson import curves, evaluation
from caisson.evaluation import DEPTH, GRADIENT, ROOM, SUCTION, TOTAL, Way, is_pull
from caisson.results import Results, ResultsError
from caisson.verdict import installation, limits, suction_methods, theory
from caisson.verdict.installation import NOTHING, Installation, Rate
from caisson.verdict.limits import BOILING, COMPUTED, PIPING

REASONS = {
    COMPUTED: "piping",
    PIPING: "piping by Houlsby & Byrne",
    BOILING: "boiling below the lid",
}
PIPING_IN_RUN = "piping"  # a reason of run.json
IN_PROGRAM = {"boiling": REASONS[BOILING]}  # reasons of run.json by other names
FINER = 21  # rows between two of the tables


def reached(found: Installation, limit: np.ndarray) -> tuple[float, int] | None:
    """Return the depth (m) where the required suction reaches a limit [n] (kPa), or
    wall or lid hold the caisson up without any, and the row at or below it; None where
    nothing does."""
    beyond = (found.required >= limit) & (found.required > NOTHING)
    beyond |= found.held_up & (limit <= 0)
    if not beyond.any():
        return None
    i = int(np.argmax(beyond))
    if i and np.isfinite(limit[i - 1]) and limit[i] > 0:  # 0 is the lid
        excess = (found.required - limit)[i - 1 : i + 1]
        return float(np.interp(0, excess, found.depth[i - 1 : i + 1])), i
    return float(found.depth[i]), i


def end_by_program(run: Results) -> tuple[float, str] | None:
    """Return the depth (m) where the program itself found that suction ends, and why;
    None where it did not."""
    if not (ended := run.scene.get("infeasible")):
        return None
    reason, first = str(ended["reason"]), float(run.history["penetration_m"][0])
    depth = max(limits.rounded_down(ended["penetration_m"]), first)
    return depth, IN_PROGRAM.get(reason, reason)


def end_of_suction(run: Results, found: Installation) -> tuple[float, str] | None:
    """Return the depth (m) where the required suction reaches the allowable one, and
    why; None where it does not."""
    if not found.has_suction and not found.held_up.any():
        return None
    if (end := reached(found, found.allowable)) is None:
        return end_by_program(run)
    # by hand the forces are known above the first row, too
    i, first = end[1], float((run.history[DEPTH] if run.by_hand else found.depth)[0])
    if i or found.depth[0] > first:  # rows are far apart where another layer begins
        above = found.depth[i - 1] if i else first
        between = np.linspace(above, found.depth[i], FINER)
        finer = installation.installation_of(run, Rate(), between)
        if finer and (sharper := reached(finer, finer.allowable)):
            found, end = finer, sharper
    name = found.governing(end[1])
    words = found.named(name).replace(name, REASONS.get(name, name))
    # it rests without suction, unless wall or lid hold it up above
    at_rest = 0.0 if found.held_up[end[1]] else found.rest or 0.0
    depth = max(limits.rounded_down(end[0]), first, at_rest)
    return depth, words + found.remark(name, end[1])


@functools.lru_cache(maxsize=16)
def whole_way(run: Results, rate: Rate = Rate()) -> Installation | None:
    """Return the installation of a run at the depths of the tables, to be read only."""
    return installation.installation_of(run, rate)


@functools.lru_cache(maxsize=16)
def end_of(run: Results) -> tuple[float, str] | None:
    """Return the depth (m) where suction ends in a run, and why; None where it does
    not, and of a body without a weight or on its way out."""
    if is_pull(run) or not run.weight:
        return None
    found = whole_way(run)
    return end_of_suction(run, found) if found and len(found.required) else None


def depth_of(run: Results) -> float | None:
    """Return the depth (m) where suction ends in a run, None where it does not."""
    found = end_of(run)
    return found[0] if found else None


def end_before(run: Results) -> tuple[float, str] | None:
    """Return the depth (m) where suction ends in an installation after which a run
    begins, and why; None where it does not, or where that is not there any more."""
    if not (folder := run.entry("Installation/Directory").strip()):
        return None
    before = Results(Path(folder))
    times = [str(x.known.get("written", "")) for x in (before, run)]
    sizes = [x.scene.get("diameter_m") for x in (before, run)]
    if times[0] >= times[1] or sizes[0] != sizes[1]:
        return None
    try:
        return end_of(before) or end_before(before)
    except ResultsError:
        return None


def feasible_to(run: Results) -> float:
    """Return the depth (m) where suction ends in a run, inf where it does not."""
    end = depth_of(run)
    return np.inf if end is None else end


def feasible_part(
    run: Results, found: Installation, end: float | None, rate: Rate = Rate()
) -> Installation:
    """Return the installation down to a depth (m), with a row there; else all of it."""
    if end is None:
        return found
    at = curves.down_to(end, found.depth)
    return installation.installation_of(run, rate, at) or found


def feasible(run: Results, way: Way) -> Way:
    """Return a way down to where suction ends."""
    rows = way.depth <= feasible_to(run)
    if rows.sum() < 2:
        return way
    return Way(way.depth[rows], {k: x[rows] for k, x in way.columns.items()})


def margins_of(run: Results, way: Way) -> dict[str, Any]:
    """Return the least margins to piping, boiling and the largest suction of the pump,
    as shares of 1, and the least room below the lid (m). Piping is that by the computed
    exit gradient or by Houlsby & Byrne, whichever leaves less."""
    required = np.maximum(way.columns[SUCTION], 0)

    def margin(ratio: np.ndarray) -> dict[str, float]:
        most, depth = way.largest(ratio)
        return {"least": 1 - most, DEPTH: depth}

    found: dict[str, Any] = {}
    _, critical = suction_methods.flow_above_clay(theory.site_of(run), way.depth)
    shares = [required / np.where(critical > 0, critical, np.nan)]
    shares += [way.columns[GRADIENT]] if GRADIENT in way.columns else []
    piping = np.fmax.reduce(shares)
    if np.isfinite(piping).any():
        found["piping"] = margin(np.nan_to_num(piping))
    if (boils := way.columns.get(evaluation.BOILING)) is not None:
        share = np.divide(required, boils, out=np.ones(len(boils)), where=boils > 0)
        found["boiling"] = margin(share)
    if limit := evaluation.pump_limit(run):
        found["pump"] = margin(required / (1e3 * limit))
    if ROOM in way.columns:
        found[ROOM] = -way.largest(-way.columns[ROOM])[0]
    return found


def results_of_way_down(run: Results, way: Way) -> dict[str, Any]:
    """Return the results of a way down; maxima and margins of what is feasible."""
    deepest, way = float(way.depth[-1]), feasible(run, way)

    def largest(name: str) -> dict[str, float]:
        most, depth = way.largest(way.columns[name])
        return {name: most, DEPTH: depth}

    total = curves.WITH_WATER if curves.WITH_WATER in way.columns else TOTAL
    found: dict[str, Any] = {DEPTH: deepest, "largest_force": largest(total)}
    if SUCTION in way.columns:
        if (rest := evaluation.rest_of(run)) is not None:
            found["rest_penetration_m"] = rest
        found["largest_suction"] = largest(SUCTION)
        found["margins"] = margins_of(run, way)
    return found | {"at_depths": evaluation.rows_of(evaluation.at_depths(run))}


@functools.lru_cache(maxsize=16)
def results_of(run: Results) -> dict[str, Any]:
    """Return the results of a run, by names that the manual lists
    (doc/how_to/results.md); empty of a run without forces."""
    history = run.history
    if TOTAL not in history:
        return {}
    found: dict[str, Any] = {}
    if len((way := evaluation.way_down(run)).depth) > 1:
        found = results_of_way_down(run, way)
    if pull := evaluation.largest_pull(history):
        found["largest_pull"] = pull
    up = evaluation.way_of(run, curves.way_up(history[DEPTH])[1:])
    if len(up.depth) > 1 and np.ptp(up.depth) > evaluation.LEAST_RISE:
        at = -evaluation.multiples_of(-up.depth)
        means = {name: up.mean(name, at) for name in up.columns}
        found["at_depths_up"] = evaluation.rows_of({DEPTH: at, **means})
    return found
