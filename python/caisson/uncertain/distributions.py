# SPDX-License-Identifier: LGPL-2.1-or-later
"""Distributions of an uncertain entry, as a study gives them.

    normal       mean, standard_deviation
    lognormal    mean, standard_deviation     of the quantity, not of its logarithm
    uniform      min, max
    log-uniform  min, max                     the logarithm is uniform
    triangular   min, mode, max
    beta         min, max, mean, standard_deviation

In the place of standard_deviation coefficient_of_variation may stand: its ratio to the
mean. A normal and a lognormal distribution may be cut off at min, max or both; what is
cut off goes to the rest, and mean and standard deviation are those before the cut.

Quantities have the units of their entry.
"""
import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from scipy import stats

from caisson.study import StudyError

# name: the keys that must be there, and those that may
SPREAD = "standard_deviation"
VARIATION = "coefficient_of_variation"
KEYS: dict[str, tuple[set[str], set[str]]] = {
    "normal": ({"mean", SPREAD}, {"min", "max"}),
    "lognormal": ({"mean", SPREAD}, {"min", "max"}),
    "uniform": ({"min", "max"}, set()),
    "log-uniform": ({"min", "max"}, set()),
    "triangular": ({"min", "mode", "max"}, set()),
    "beta": ({"min", "max", "mean", SPREAD}, set()),
}
ALL_KEYS = {VARIATION}.union(*(must | may for must, may in KEYS.values()))
LEAST = 1e-6  # share of a distribution that must be left between min and max


def require(holds: bool, text: str) -> None:
    """Raise StudyError unless the condition holds."""
    if not holds:
        raise StudyError(text)


def is_number(value: object) -> bool:
    """Return whether a value of a study is a finite number, and no truth value."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return abs(value) < 1e300  # an int may be larger than any float


def numbers_of(name: str, given: Mapping[str, Any]) -> dict[str, float]:
    """Return the keys of a distribution, all of them numbers that it takes, with a
    standard deviation in the place of a coefficient of variation."""
    require(
        isinstance(name, str) and name in KEYS,
        f"distribution is {name!r}, not one of {', '.join(KEYS)}",
    )
    must, may = KEYS[name]
    for key, value in given.items():
        require(is_number(value), f"{key} is {value!r}, not a number")
    found = {key: float(value) for key, value in given.items()}
    if VARIATION in found and SPREAD in must:
        require(SPREAD not in found, f"give {SPREAD} or {VARIATION}, not both")
        require("mean" in found, f"{VARIATION} needs mean")
        found[SPREAD] = found.pop(VARIATION) * abs(found["mean"])
    missing, unknown = sorted(must - set(found)), sorted(set(found) - must - may)
    require(not missing, f"a {name} distribution needs {', '.join(missing)}")
    require(not unknown, f"a {name} distribution has no {', '.join(unknown)}")
    return found


def check(name: str, of: Mapping[str, float]) -> None:
    """Raise StudyError where no distribution has these numbers."""
    low, high = of.get("min", -math.inf), of.get("max", math.inf)
    require(low < high, f"min is {low:g} and must be below max, {high:g}")
    if SPREAD in of:
        require(of[SPREAD] > 0, f"{SPREAD} is {of[SPREAD]:g} and must be above 0")
    if name == "lognormal":
        require(of["mean"] > 0, f"mean is {of['mean']:g} and must be above 0")
    if name == "log-uniform":
        require(low > 0, f"min is {low:g} and must be above 0")
    if name == "triangular":
        inside = low <= of["mode"] <= high
        require(inside, f"mode is {of['mode']:g}, not between {low:g} and {high:g}")
    if name == "beta":
        inside = low < of["mean"] < high
        require(inside, f"mean is {of['mean']:g}, not between {low:g} and {high:g}")
        most = math.sqrt((of["mean"] - low) * (high - of["mean"]))
        text = f"{SPREAD} is {of[SPREAD]:g}, and must be below {most:g} for this mean"
        require(of[SPREAD] < most, text)


def law_of(name: str, of: Mapping[str, float]) -> Any:
    """Return the distribution of scipy.stats before it is cut off."""
    if name == "normal":
        return stats.norm(of["mean"], of[SPREAD])
    if name == "lognormal":
        log_spread = math.sqrt(math.log1p((of[SPREAD] / of["mean"]) ** 2))
        median = of["mean"] * math.exp(-(log_spread**2) / 2)
        return stats.lognorm(log_spread, scale=median)
    low, high = of["min"], of["max"]
    if name == "uniform":
        return stats.uniform(low, high - low)
    if name == "log-uniform":
        return stats.loguniform(low, high)
    if name == "triangular":
        return stats.triang((of["mode"] - low) / (high - low), low, high - low)
    mean, spread = (of["mean"] - low) / (high - low), of[SPREAD] / (high - low)
    both = mean * (1 - mean) / spread**2 - 1  # the sum of both exponents
    return stats.beta(mean * both, (1 - mean) * both, low, high - low)


class Distribution:
    """A distribution, cut off where that is asked for."""

    def __init__(self, name: str, given: Mapping[str, Any]) -> None:
        """given: the keys of the study but "distribution". Raises StudyError."""
        of = numbers_of(name, given)
        check(name, of)
        self.law = law_of(name, of)
        self.is_logarithmic = name.startswith("log")
        self.low = float(self.law.cdf(of.get("min", -math.inf)))
        self.high = float(self.law.cdf(of.get("max", math.inf)))
        require(
            self.high - self.low > LEAST,
            "hardly any of the distribution lies between min and max",
        )

    def quantiles(self, shares: np.ndarray) -> np.ndarray:
        """Return the values [n] below which these shares [n] of all values are."""
        return self.law.ppf(self.low + shares * (self.high - self.low))
