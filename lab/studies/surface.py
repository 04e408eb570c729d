# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "surface": are few runs enough for P5, P50 and P95?

The first study of the file has few runs, the second one many, of the same
distributions. The quantiles of both are those of their response surface
(caisson.uncertain.surface); those of the many runs are also counted, where a run that
does not reach a depth is above all others there. The keys of a study are those of kind
"parameters". Fails where a quantile of the few runs differs by more than 5 % from that
of the many.
"""
import math
from collections.abc import Sequence

import numpy as np

from caisson import table, uncertain
from caisson.uncertain import surface
from caisson.uncertain.outcome import Outcomes, unit_of, words_of
from caisson.uncertain.sampling import runs_of
from caisson.uncertain.surface import NAMES, SHARES, Spread
from caisson.study import Options, Study, StudyError

NAME = "surface"
STUDY_KEYS = uncertain.STUDY_KEYS
MOST = 0.05  # of a quantile of the many runs
LACKS = 1e200  # in place of a result that a run lacks
make_runs = runs_of


def of_runs(outcomes: Outcomes, spread: Spread) -> np.ndarray:
    """Return the quantiles of a result among the runs themselves, infinite where more
    runs lack it than are above."""
    if math.isfinite(spread.depth):
        values = outcomes.matrix(np.array([surface.NEARLY * spread.depth]))[:, 0]
    else:
        values = np.array([run.rest or math.nan for run in outcomes.complete])
    values = np.where(np.isfinite(values), np.maximum(values, 0), LACKS)
    found = np.quantile(values, SHARES)
    return np.where(found < np.sqrt(LACKS), found, np.inf)


def rows_of(
    few: Sequence[Spread], many: Sequence[Spread], runs: Outcomes
) -> tuple[list[list[str]], float]:
    """Return the rows of the table, and the largest difference, as a share of 1."""
    rows, worst = [], 0.0
    for own, other in zip(few, many, strict=True):
        unit, scale = unit_of(own.name)
        where = f" at {own.depth:g} m" if math.isfinite(own.depth) else ""
        counted = of_runs(runs, other)
        for i, name in enumerate(NAMES):
            both = own.quantiles[i], other.quantiles[i]
            share = 0.0 if both[0] == both[1] else both[0] / both[1] - 1
            worst = max(worst, abs(share))
            numbers = (own.quantiles[i], other.quantiles[i], counted[i], own.error)
            cells = [f"{x * scale:.3g}" for x in numbers]
            head = f"{words_of(own.name)}{where}, {name} ({unit})"
            rows.append([head, *cells[:2], f"{100 * share:+.1f} %", *cells[2:]])
    return rows, worst


def evaluate(studies: Sequence[Study], _: Options, __: float) -> int:
    """Print both; return 1 where they differ by more than MOST."""
    if len(studies) != 2:
        raise StudyError("a surface needs two studies: of few runs, and of many")
    outcomes = [Outcomes(study) for study in studies]
    few, many = map(surface.of_study, outcomes)
    if few is None or many is None:
        raise StudyError(surface.why_none(outcomes[0]))
    rows, worst = rows_of(few.spreads, many.spreads, outcomes[1])
    n_few, n_many = (f"{len(x.complete)} runs" for x in outcomes)
    heads = ["", n_few, n_many, "differ by", f"{n_many}, counted", f"error, {n_few}"]
    print(table.markdown(heads, rows))
    for found in (few, many):
        if found.refusal is not None:
            print(surface.in_words(found.refusal))
    print(f"largest difference: {100 * worst:.1f} %; {100 * MOST:.0f} % are allowed")
    return int(worst > MOST)
