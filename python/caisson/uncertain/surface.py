# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the runs of a Latin hypercube say of all soil that its distributions allow: P5,
P50 and P95, and the probability of refusal, by a response surface.

A surface is fitted to a result of the runs over their parameters: a polynomial of the
second degree (ridge regression), or a Gaussian process, whichever predicts each run
better from the others. The error that is stated is that of this leave-one-out, as the
root of the mean square. The surface is then taken at 10,000 samples of the
distributions. Refusal is a caisson that does not reach the planned penetration, or not
feasibly; its probability is that of a logistic regression.

scikit-learn has all of them (Pedregosa et al. 2011, J. Mach. Learn. Res. 12).
"""
import functools
import math
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from caisson import needed
from caisson.uncertain import effects
from caisson.uncertain.entry import Parameter, Sample
from caisson.uncertain.outcome import Outcome, Outcomes
from caisson.uncertain.sampling import latin
from caisson.results import ResultsError

FEWEST = 10  # runs, below which there is no surface
SAMPLES = 10_000
SHARES = (0.05, 0.5, 0.95)
NAMES = ("P5", "P50", "P95")
QUARTERS = (0.25, 0.5, 0.75, 1.0)
NEARLY = 0.999  # of a depth, which a run may miss by its last step
MANY, TENTH = 40, 10  # of more runs a tenth is left out at a time
END = "Time/End penetration"
REST = "penetration_by_weight_m"


@dataclass(frozen=True)
class Spread:
    """P5, P50 and P95 of a result at a depth (m; nan of none), in its SI unit; error:
    of the surface, by leave-one-out; runs: that have the result; model: its name."""

    name: str
    depth: float
    quantiles: tuple[float, float, float]
    error: float
    runs: int
    model: str


@dataclass(frozen=True)
class Refusal:
    """The probability that the planned penetration (m) is not reached; refused: runs
    that did not; wrong: runs of which leave-one-out says the opposite, None where all
    of them, or none, have reached it, and most is only a bound (95 %)."""

    probability: float
    refused: int
    runs: int
    wrong: int | None


@dataclass(frozen=True)
class Surfaces:
    """What the surfaces of a study say; refusal: of suction only."""

    spreads: list[Spread]
    refusal: Refusal | None


def why_none(outcomes: Outcomes) -> str:
    """Return why a study has no surface, "" where it has one."""
    if not needed.is_there("sklearn"):
        return needed.sentence(needed.SURFACES, "pictures")
    fewest = max(FEWEST, len(outcomes.free) + 2)
    if (n := len(outcomes.complete)) < fewest:
        return f"{n} runs are too few for a response surface: {fewest} or more"
    return ""


def numbers_of(parameters: Sequence[Parameter], samples: Sequence[Sample]) -> Any:
    """Return samples as numbers [n_samples, n_parameters]: logarithms where the
    distribution is one of them."""

    def number(parameter: Parameter, value: Any) -> float:
        law = parameter.distribution
        if law is None:
            return effects.order(parameter, value)
        return math.log(value) if law.is_logarithmic else float(value)

    return np.array([[number(p, s[p.name]) for p in parameters] for s in samples])


def models(n_parameters: int) -> dict[str, Any]:
    """Return the surfaces to choose from, by name."""
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel
    from sklearn.linear_model import RidgeCV
    from sklearn.pipeline import make_pipeline
    from sklearn.preprocessing import PolynomialFeatures, StandardScaler

    ranges = RBF(np.full(n_parameters, 3.0), (0.3, 100.0))
    kernel = ConstantKernel(1.0, (1e-2, 1e3)) * ranges + WhiteKernel(0.1, (1e-6, 1.0))
    return {
        "ridge, 2nd degree": make_pipeline(
            StandardScaler(),
            PolynomialFeatures(2, include_bias=False),
            StandardScaler(),
            RidgeCV(np.logspace(-4, 2, 19)),
        ),
        "Gaussian process": make_pipeline(
            StandardScaler(), GaussianProcessRegressor(kernel, normalize_y=True)
        ),
    }


def fitted(points: np.ndarray, values: np.ndarray) -> tuple[Any, str, float]:
    """Return the surface through values [n] at points [n, n_parameters] that predicts
    best what is left out, its name, and its error."""
    from sklearn.model_selection import KFold, cross_val_predict

    parts = len(values) if len(values) <= MANY else TENTH
    split = KFold(parts, shuffle=True, random_state=0)
    best: tuple[Any, str, float] = (None, "", math.inf)
    for name, model in models(points.shape[1]).items():
        with warnings.catch_warnings():  # of a range at its limit
            warnings.simplefilter("ignore")
            left_out = cross_val_predict(model, points, values, cv=split)
            error = float(np.sqrt(np.mean((left_out - values) ** 2)))
            if error < best[2]:
                best = model.fit(points, values), name, error
    return best


def spread_of(
    name: str,
    depth: float,
    points: np.ndarray,
    values: np.ndarray,
    everywhere: np.ndarray,
    least: float = -math.inf,
    reached: float = 1.0,
) -> Spread | None:
    """Return P5, P50 and P95 of values [n_runs], nan where a run has none, over the
    points [n_samples, n_parameters] everywhere; None of too few. least: below it a
    value counts as that; reached: the share of all soil in which there is a value, the
    lower ones, beyond which a quantile is infinite."""
    known = np.isfinite(values)
    if known.sum() < max(FEWEST, points.shape[1] + 2):
        return None
    surface, model, error = fitted(points[known], values[known])
    found = np.maximum(surface.predict(everywhere), least)
    ends = [
        float(x) if s <= reached else math.inf
        for s, x in zip(SHARES, np.quantile(found, SHARES))
    ]
    return Spread(
        name, depth, (ends[0], ends[1], ends[2]), error, int(known.sum()), model
    )


def planned_of(outcomes: Outcomes) -> float:
    """Return where the runs are to end (m): by their scene, or as deep as one goes."""
    for outcome in outcomes.complete:
        try:
            return float(outcome.run.results.summary["entries"][END])
        except (ResultsError, KeyError, ValueError):
            continue
    return float(outcomes.grid[-1])


def is_refused(outcome: Outcome, depth: float) -> bool:
    """Return whether a run does not reach a depth (m) feasibly."""
    assert outcome.history is not None
    ended = outcome.run.results.scene.get("infeasible") or {}
    reached = ended.get("penetration_m", float(outcome.history["penetration_m"].max()))
    return bool(reached < depth * (1 - 2e-3))


def refusal_of(
    points: np.ndarray, refused: np.ndarray, everywhere: np.ndarray
) -> Refusal:
    """Return the probability of refusal over the points everywhere, from the runs that
    are refused [n_runs]."""
    n, count = len(refused), int(refused.sum())
    if count in (0, n):
        bound = 1 - 0.05 ** (1 / n)  # as likely as 5 % that none of n is
        return Refusal(bound if count == 0 else 1 - bound, count, n, None)
    from sklearn.linear_model import LogisticRegression
    from sklearn.model_selection import KFold, cross_val_predict
    from sklearn.pipeline import make_pipeline
    from sklearn.preprocessing import StandardScaler

    model = make_pipeline(StandardScaler(), LogisticRegression(C=10.0))
    wrong = None
    if 1 < count < n - 1:
        left_out = cross_val_predict(model, points, refused, cv=KFold(n))
        wrong = int((left_out != refused).sum())
    chances = model.fit(points, refused).predict_proba(everywhere)
    return Refusal(float(chances[:, 1].mean()), count, n, wrong)


@functools.lru_cache(maxsize=4)
def of_study(outcomes: Outcomes) -> Surfaces | None:
    """Return the spread of the penetration by weight and of what is observed at the
    quarters of the planned penetration, and of suction the probability of refusal; None
    where there is no surface."""
    if why_none(outcomes):
        return None
    runs, planned = outcomes.complete, planned_of(outcomes)
    points = numbers_of(outcomes.free, [run.sample for run in runs])
    samples = latin({**outcomes.study.keys, "samples": SAMPLES}, outcomes.free)
    everywhere = numbers_of(outcomes.free, list(samples))
    depths = planned * np.array(QUARTERS)
    has_suction = outcomes.column == "required_suction_Pa"
    rests = np.array([math.nan if r.rest is None else r.rest for r in runs])
    found = [spread_of(REST, math.nan, points, rests, everywhere, 0.0)]
    least = 0.0 if has_suction else -math.inf
    for depth, values in zip(depths, outcomes.matrix(NEARLY * depths).T):
        refused = np.array([is_refused(run, depth) for run in runs])
        chance = refusal_of(points, refused, everywhere) if has_suction else None
        reached = 1 - chance.probability if chance and refused.any() else 1.0
        spread = outcomes.column, depth, points, values, everywhere, least, reached
        found.append(spread_of(*spread))
    return Surfaces([spread for spread in found if spread], chance)


def in_words(refusal: Refusal) -> str:
    """Return the probability of refusal in a sentence."""
    share, runs = 100 * refusal.probability, f"{refusal.refused} of {refusal.runs} runs"
    what = "refusal, or infeasible above the planned end"
    if refusal.wrong is None and refusal.refused in (0, refusal.runs):
        bound = "at most" if refusal.refused == 0 else "at least"
        return f"{what}: {runs}; a probability of {bound} {share:.0f} % (95 % sure)"
    left = "; one of a kind is too few to check it by leaving it out"
    if refusal.wrong is not None:
        left = f"; left out in turn, {refusal.wrong} of the runs are predicted wrong"
    return f"{what}: probability {share:.0f} %; {runs}{left}"
