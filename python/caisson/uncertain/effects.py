# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much each parameter matters, and how results spread.

Of runs in which one parameter changes at a time, the effect of a parameter is what is
observed at the values that make it smallest and largest, beside the base. Of a grid it
is the same for means over all other parameters, beside the mean of all runs. Of a Latin
hypercube it is the rank correlation of Spearman between parameter and result, from -1
to 1; words count in the order of their list.
"""
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from caisson.uncertain.distributions import is_number
from caisson.uncertain.entry import Parameter, Value, text_of
from caisson.uncertain.outcome import Outcome, Outcomes
from caisson.uncertain.sampling import LATIN, ONE

SHARES = (0.05, 0.25, 0.5, 0.75, 0.95)
ENOUGH = 20  # runs, of which the lowest is the quantile of 5 %
CHANCE = 0.05  # of a correlation beyond the limit where there is none


@dataclass(frozen=True)
class Effect:
    """The effect of one parameter: ends are its values at the smallest and the
    largest result, low and high these results; of a Latin hypercube low is 0 and high
    the correlation."""

    parameter: Parameter
    low: float
    high: float
    ends: tuple[Value, Value] = ("", "")

    @property
    def size(self) -> float:
        """What the parameters are sorted by."""
        return abs(self.high - self.low)

    @property
    def rises(self) -> bool:
        """Whether the result is larger at the larger value of the parameter, or at
        that which stands later in its list."""
        first, last = (order(self.parameter, end) for end in self.ends)
        return first <= last


def order(parameter: Parameter, value: Value) -> float:
    """Return a number by which the values of a parameter are sorted."""
    if is_number(value) and all(is_number(v) for v in parameter.values):
        return float(value)
    return parameter.values.index(value) if value in parameter.values else -1.0


def correlation(
    parameter: Parameter, outcomes: Sequence[Outcome], results: np.ndarray
) -> float:
    """Return the rank correlation of a parameter with results [n_runs], 0 where one
    of them does not change."""
    values = [order(parameter, o.sample[parameter.name]) for o in outcomes]
    if len(values) < 3 or np.ptp(values) == 0 or np.ptp(results) == 0:
        return 0.0
    return float(stats.spearmanr(values, results)[0])


def chance(n: int) -> float:
    """Return the correlation that n runs exceed by chance in CHANCE of all cases."""
    if n < 4:
        return 1.0
    t = stats.t.ppf(1 - CHANCE / 2, n - 2)
    return float(t / math.sqrt(n - 2 + t**2))


def levels(
    outcomes: Outcomes,
    runs: Sequence[Outcome],
    results: np.ndarray,
    parameter: Parameter,
) -> dict[Value, float]:
    """Return the result at each value of a parameter: its mean over the others, of one
    at a time where all others have their base."""
    base, name = runs[0].sample, parameter.name
    found: dict[Value, list[float]] = {}
    for run, result in zip(runs, results):
        others = [p.name for p in outcomes.free if p.name != name]
        at_base = all(run.sample[other] == base[other] for other in others)
        if outcomes.sampling != ONE or at_base:
            found.setdefault(run.sample[name], []).append(float(result))
    return {value: float(np.mean(results)) for value, results in found.items()}


def effects_of(outcomes: Outcomes, depth: float | None) -> tuple[float, list[Effect]]:
    """Return what effects are beside and the effects at a depth (m), the largest
    first; nothing where the base has no result there, or no run counts."""
    if depth is None:
        return math.nan, []
    at = outcomes.matrix(np.array([depth]))[:, 0]
    known = np.isfinite(at)
    runs = [run for run, is_known in zip(outcomes.complete, known) if is_known]
    results, effects = at[known], []
    if outcomes.sampling == ONE and (not runs or runs[0].name != outcomes.all[0].name):
        return math.nan, []
    for parameter in outcomes.free:
        if outcomes.sampling == LATIN:
            found = correlation(parameter, runs, results)
            effects.append(Effect(parameter, 0.0, found))
            continue
        by_value = levels(outcomes, runs, results, parameter)
        ordered = sorted(by_value, key=by_value.__getitem__)
        ends = ordered[0], ordered[-1]
        effects.append(Effect(parameter, by_value[ends[0]], by_value[ends[1]], ends))
    effects.sort(key=lambda effect: -effect.size)
    if outcomes.sampling == LATIN:
        return 0.0, effects
    base = results[0] if outcomes.sampling == ONE else np.mean(results)
    return float(base), effects


def spread(matrix: np.ndarray) -> tuple[list[str], np.ndarray]:
    """Return names and values [n_quantiles, n_depths] of quantiles of results
    [n_runs, n_depths], nan where a run is missing. Of few runs the outer ones are the
    smallest and the largest result."""
    names = [f"{100 * share:.0f} %" for share in SHARES]
    shares = list(SHARES)
    if len(matrix) < ENOUGH:
        names[0], names[-1] = "smallest", "largest"
        shares[0], shares[-1] = 0.0, 1.0
    return names, np.quantile(matrix, shares, axis=0)


def text_of_effect(effect: Effect, base: float, unit: str, scale: float) -> list[str]:
    """Return the cells of an effect of a list or a grid, with its share of what it is
    beside."""
    cells = [effect.parameter.label]
    for result, end in zip((effect.low, effect.high), effect.ends):
        value = f"{float(f'{result * scale:.4g}'):.12g} {unit}".strip()
        share = f" ({100 * (result / base - 1):+.0f} %)" if base else ""
        cells.append(f"{value}{share} at {text_of(end)}")
    return cells
