# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tables of a study of parameters: table.csv, fan.csv, and what is printed."""
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from caisson import table
from caisson.uncertain import effects, surface
from caisson.uncertain.entry import text_of
from caisson.uncertain.outcome import (
    DEPTH,
    Outcome,
    Outcomes,
    title_of,
    unit_of,
    words_of,
)
from caisson.uncertain.sampling import LATIN, ONE
from caisson.uncertain.surface import Spread, Surfaces

MOST_WARNINGS = 6  # that are printed
RANKS = (
    "Runs of one scene on different numbers of ranks differ by about 1 %, beside a thin"
    " wall by more (doc/limitations.md)."
)
PRINTED = 20  # rows of runs; of more runs the quantiles are printed


def largest(outcomes: Outcomes, outcome: Outcome) -> tuple[float, float]:
    """Return the largest value of what is observed, of a body that is pulled the
    largest pull, and its depth (m); nan where there is none."""
    values = outcomes.values(outcome, outcomes.grid)
    if not np.isfinite(values).any():
        return math.nan, math.nan
    is_pulled = np.nanmax(values) <= 0 and outcomes.column.endswith("_N")
    at = int(np.nanargmin(values) if is_pulled else np.nanargmax(values))
    return float(values[at]), float(outcomes.grid[at])


def row_of(outcomes: Outcomes, outcome: Outcome, has_rest: bool) -> list[str]:
    """Return the row of a run in table.csv."""
    sample = [outcome.sample.get(p.name, "") for p in outcomes.parameters]
    row = [outcome.name, outcome.status, *map(text_of, sample)]
    row += map(table.digits, outcomes.values(outcome, outcomes.depths))
    row += map(table.digits, largest(outcomes, outcome))
    history = outcome.history
    row.append(table.digits(None if history is None else float(history[DEPTH].max())))
    if has_rest:
        row.append(table.digits(outcome.rest))
    remark = "; ".join(filter(None, [outcome.why, *outcome.warnings]))
    record = outcome.run.run.completion_record() or {}
    return [*row, table.digits(record.get("wall_s")), remark]


def write_runs(path: Path, outcomes: Outcomes) -> Path:
    """Write table.csv: a row for each run."""
    column = outcomes.column
    runs = outcomes.all + ([outcomes.reference] if outcomes.reference else [])
    has_rest = any(run.rest is not None for run in runs)
    names = ["run", "status", *(p.name for p in outcomes.parameters)]
    names += [f"{column} at {depth:g} m" for depth in outcomes.depths]
    names += [f"largest_{column}", "depth_of_largest_m", "largest_penetration_m"]
    names += ["penetration_by_weight_m"] if has_rest else []
    names += ["wall_time_s", "remark"]
    rows = [row_of(outcomes, run, has_rest) for run in runs]
    return table.write_csv(path, names, rows)


def write_fan(path: Path, outcomes: Outcomes) -> Path:
    """Write fan.csv: what is observed over depth, in each run that counts, and of a
    Latin hypercube its quantiles first."""
    column, matrix = outcomes.column, outcomes.matrix(outcomes.grid)
    columns: dict[str, Any] = {DEPTH: outcomes.grid}
    if outcomes.sampling == LATIN and len(matrix):
        for name, values in zip(*effects.spread(matrix)):
            columns[f"{column} [{name}]"] = values
    for outcome, values in zip(outcomes.complete, matrix):
        columns[f"{column} [{outcome.name}]"] = values
    return table.write_columns(path, columns)


def of_surface(spreads: Sequence[Spread]) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows of what the surfaces say."""
    rows = []
    for spread in spreads:
        unit, scale = unit_of(spread.name)
        where = f" at {spread.depth:.4g} m" if math.isfinite(spread.depth) else ""
        name = f"{words_of(spread.name)}{where}"
        values = [
            "refused" if x == math.inf else cell(x * scale) for x in spread.quantiles
        ]
        values.append(cell(spread.error * scale))
        rows.append([name, unit, *values, str(spread.runs), spread.model])
    return ["result", "unit", *surface.NAMES, "error", "runs", "surface"], rows


def lines_of_surface(found: Surfaces) -> Iterator[str]:
    """Yield P5, P50 and P95, and the probability of refusal."""
    yield table.markdown(*of_surface(found.spreads))
    yield (
        f"by {surface.SAMPLES} samples of a response surface; error: with each run left"
        " out in turn"
    )
    if (refusal := found.refusal) is not None:
        yield surface.in_words(refusal)


def write_surface(path: Path, found: Surfaces) -> Path:
    """Write surface.csv: what the surfaces say, and as its last row the probability of
    refusal."""
    heads, rows = of_surface(found.spreads)
    if (refusal := found.refusal) is not None:
        share = f"{refusal.probability:.3g}"
        rows.append(["refusal", "", "", share, "", "", str(refusal.runs), "logistic"])
    return table.write_csv(path, heads, rows)


def lines(outcomes: Outcomes, depth: float | None) -> Iterator[str]:
    """Yield what is printed: runs or quantiles, effects, and what has failed."""
    unit, scale = unit_of(outcomes.column)
    heads = [f"{x:g} m" for x in outcomes.depths]
    yield f"{outcomes.study.title}: {title_of(outcomes.column)}"
    if len(outcomes.all) <= PRINTED:
        rows = [
            [o.name, *(cell(x * scale) for x in outcomes.values(o, outcomes.depths))]
            for o in outcomes.all
        ]
        yield table.markdown(["run", *heads], rows)
    if outcomes.sampling == LATIN and outcomes.complete:
        if found_by := surface.of_study(outcomes):
            yield from lines_of_surface(found_by)
        else:
            names, values = effects.spread(outcomes.matrix(outcomes.depths))
            rows = [[n, *(cell(x * scale) for x in v)] for n, v in zip(names, values)]
            yield table.markdown(["quantile", *heads], rows)
            yield surface.why_none(outcomes)
    base, found = effects.effects_of(outcomes, depth)
    if found and outcomes.sampling == LATIN:
        rows = [[e.parameter.label, f"{e.high:+.2f}"] for e in found]
        yield f"rank correlation (Spearman) at {depth:g} m; by chance below" + (
            f" {effects.chance(len(outcomes.complete)):.2f}:"
        )
        yield table.markdown(["parameter", "correlation"], rows)
    elif found:
        rows = [effects.text_of_effect(e, base, unit, scale) for e in found]
        of = "the base" if outcomes.sampling == ONE else "the mean of all runs"
        yield f"effects at {depth:g} m, beside {of}:"
        yield table.markdown(["parameter", "smallest", "largest"], rows)
    yield from (o.trouble for o in outcomes.all if not o.is_complete)
    warnings = [f"{o.name}: warning: {w}" for o in outcomes.all for w in o.warnings]
    yield from warnings[:MOST_WARNINGS]
    if len(warnings) > MOST_WARNINGS:
        yield f"{len(warnings) - MOST_WARNINGS} more warnings: see table.csv"
    yield RANKS


def cell(value: float) -> str:
    """Return a value for the printed tables: four digits, and no power of ten where it
    is large."""
    return f"{float(f'{value:.4g}'):.12g}" if math.isfinite(value) else "-"
