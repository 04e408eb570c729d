# SPDX-License-Identifier: LGPL-2.1-or-later
"""What came out of a run: the numbers at depths, the largest force and suction, the
margins and the largest pull. The same before and after a report: they follow from
history.csv and run.json, as the program wrote them."""
import functools
from typing import Any

import numpy as np

from caisson import curves, evaluation
from caisson.evaluation import BOILING, DEPTH, GRADIENT, ROOM, SUCTION, TOTAL, Way
from caisson.results import Results
from caisson.verdict.end import depth_of


def feasible(run: Results, way: Way) -> Way:
    """Return a way down to where suction ends."""
    rows = way.depth <= (depth_of(run) or np.inf)
    if rows.sum() < 2:
        return way
    return Way(way.depth[rows], {k: x[rows] for k, x in way.columns.items()})


def margins_of(run: Results, way: Way) -> dict[str, Any]:
    """Return the least margins to piping, boiling and the largest suction of the pump,
    as shares of 1, and the least room below the lid (m)."""
    required = np.maximum(way.columns[SUCTION], 0)

    def margin(ratio: np.ndarray) -> dict[str, float]:
        most, depth = way.largest(ratio)
        return {"least": 1 - most, DEPTH: depth}

    found: dict[str, Any] = {}
    if GRADIENT in way.columns:
        found["piping"] = margin(way.columns[GRADIENT])
    if (boils := way.columns.get(BOILING)) is not None:
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
        if (rest := evaluation.rest_of_run(run.history)) is not None:
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
