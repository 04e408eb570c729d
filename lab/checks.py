# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares the results of runs with the exact solutions that their scenes state.

    scripts/lab checks results/column

The entry Verification/Checks has the checks, separated by semicolons. A check of the
material points at the end of a run is written as MODE QUANTITY : EXACT : TOLERANCE, or
as spread QUANTITY : TOLERANCE; "where REGION" may follow the quantity. With the
computed values v and the exact ones e, and the mean <.> over the volume:

    max         max |v - e| / max |e|
    pointwise   max (|v - e| / |e|)
    mean        |<v> - <e>| / |<e>|
    rms         sqrt <(v - e)^2> / max |e|
    spread      (max v - min v) / |<v>|

A check of a series, which is an observation or a column of history.csv, is written in
the same way; "from T", "to T" and "until OTHER VALUE" may follow the series, the last
one for the time when another series first reaches a value. <.> is the mean over the
records:

    trace       max |v - e| / max |e|
    final       |v - e| / |e| of the last record
    average     |<v> - <e>| / |<e>|
    drift       max |v - v(first)| / max |v|, with a tolerance alone
    below, above, between   by how much the last v is outside one bound, or two

An error is absolute where it would be divided by 0. Exact values and regions are
expressions in the initial coordinates r and z (m), the time t (s), and pi.
"""
import argparse
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from caisson.results import Results, ResultsError

Values = np.ndarray  # [n_points] or [n_records]
Comparison = tuple[float, float, float]  # computed, exact, error
ENTRY = "Verification/Checks"
LINE = "{line} (computed {computed:.8g}, exact {exact:.8g}, error {relative_error:.3g})"
# a check of these is compared with no exact solution
TOLERANCE_ALONE = ("spread", "drift")
FUNCTIONS: dict[str, Callable[..., Any]] = {
    name: getattr(np, name) for name in "exp log sqrt sin cos abs rint".split()
} | {"if_": np.where, "max": np.maximum, "min": np.minimum}


class CheckError(ResultsError):
    """A check that cannot be understood, or that finds nothing to compare."""


@dataclass
class Samples:
    """What is compared: values, their weights in a mean, and for between a second
    bound."""

    computed: Values
    exact: Values
    weight: Values
    upper: Values

    def mean(self, values: Values) -> float:
        """Return the mean over volume or records."""
        return float(np.average(values, weights=self.weight))

    @property
    def largest(self) -> float:
        """The largest exact value."""
        return float(np.abs(self.exact).max())


def over(scale: Any, difference: Any) -> Any:
    """Return the difference over the scale, or itself where the scale is 0."""
    divisor = np.where(scale == 0, 1.0, np.abs(scale))
    return difference / divisor


def compared(computed: float, exact: float) -> Comparison:
    """Return two values and their relative difference."""
    return computed, exact, float(over(exact, abs(computed - exact)))


def worst(computed: Values, exact: Values, scale: Any) -> Comparison:
    """Return the values with the largest error; one that is no number is the worst."""
    errors = over(scale, np.abs(computed - exact))
    i = int(np.argmax(errors))
    return float(computed[i]), float(exact[i]), float(errors[i])


def rms(s: Samples) -> Comparison:
    """Return the root of the mean square of the error."""
    error = s.mean((s.computed - s.exact) ** 2) ** 0.5
    return error, 0.0, float(over(s.largest, error))


def spread(s: Samples) -> Comparison:
    """Return the largest difference between two values."""
    width = float(np.ptp(s.computed))
    return width, 0.0, float(over(s.mean(s.computed), width))


def drift(s: Samples) -> Comparison:
    """Return the largest change since the first record."""
    start = np.full_like(s.computed, s.computed[0])
    return worst(s.computed, start, float(np.abs(s.computed).max()))


def outside(value: float, lower: float, upper: float) -> Comparison:
    """Return how far a value lies outside its bounds; 0 inside."""
    bound = lower if abs(value - lower) < abs(value - upper) else upper
    return (value, bound, 0.0) if lower <= value <= upper else compared(value, bound)


OF_POINTS: dict[str, Callable[[Samples], Comparison]] = {
    "max": lambda s: worst(s.computed, s.exact, s.largest),
    "pointwise": lambda s: worst(s.computed, s.exact, s.exact),
    "mean": lambda s: compared(s.mean(s.computed), s.mean(s.exact)),
    "rms": rms,
    "spread": spread,
}
BOUNDS: dict[str, Callable[[Samples], Comparison]] = {
    "below": lambda s: outside(s.computed[-1], -np.inf, s.exact[-1]),
    "above": lambda s: outside(s.computed[-1], s.exact[-1], np.inf),
    "between": lambda s: outside(s.computed[-1], s.exact[-1], s.upper[-1]),
}
OF_SERIES: dict[str, Callable[[Samples], Comparison]] = {
    "trace": OF_POINTS["max"],
    "final": lambda s: compared(s.computed[-1], s.exact[-1]),
    "average": OF_POINTS["mean"],
    "drift": drift,
} | BOUNDS


@dataclass
class Check:
    """One check, as read from its text."""

    head: str  # what stands before the first colon
    mode: str
    name: str  # of a quantity or a series
    words: str  # that follow the name
    exact: str = "0"
    upper: str = "0"
    tolerance: float = 0.0

    @property
    def demand(self) -> str:
        """What is asked, behind the head."""
        if self.mode not in BOUNDS:
            return f": within {self.tolerance:.6g}"
        return f" {self.exact}" + f" and {self.upper}" * (self.mode == "between")


def parse(text: str) -> Check:
    """Return a check. Raises CheckError where it cannot be understood."""
    head, *values = (part.strip() for part in text.split(":"))
    mode, name, words = (*head.split(maxsplit=2), "", "", "")[:3]
    if mode not in OF_POINTS | OF_SERIES:
        known = ", ".join(OF_POINTS | OF_SERIES)
        raise CheckError(f"{ENTRY}: {text!r}: there is no mode {mode!r}, only {known}")
    n_values = 1 if mode in (*TOLERANCE_ALONE, "below", "above") else 2
    if not name or len(values) != n_values:
        raise CheckError(
            f"{ENTRY}: {text!r}: a check is written as mode quantity : exact solution :"
            " tolerance, for instance max displacement_z : -0.01*z : 1e-3"
        )
    if mode in BOUNDS:
        return Check(head, mode, name, words, values[0], values[-1])
    try:
        tolerance = float(values[-1])
    except ValueError:
        tolerance = 0.0
    if not 0 < tolerance < np.inf:
        raise CheckError(
            f"{ENTRY}: {text!r}: the tolerance {values[-1]!r} must be a positive number"
        )
    exact = "0" if mode in TOLERANCE_ALONE else values[0]
    return Check(head, mode, name, words, exact, tolerance=tolerance)


def value_of(text: str, r: Any, z: Any, t: Any) -> Values:
    """Return an expression at initial positions (m) and times (s): [n]. Raises
    CheckError where it is none."""
    code = re.sub(r"\bif\(", "if_(", text.replace("^", "**"))
    names = {**FUNCTIONS, "r": r, "z": z, "t": t, "pi": np.pi}
    try:
        with np.errstate(all="ignore"):
            found = eval(code, {"__builtins__": {}}, names)  # noqa: S307
    except (SyntaxError, NameError, TypeError) as error:
        raise CheckError(f"{ENTRY}: {text!r} is no expression: {error}") from error
    return np.broadcast_to(np.asarray(found, float), np.shape(t))


def sample_points(check: Check, results: Results) -> Samples:
    """Return the values at the points of the region at the end of a run."""
    table = results.table("points.csv", "time_s")
    place = table["initial_position_r"], table["initial_position_z"], table["time_s"]
    computed = table[check.name]
    within = np.full(computed.shape, True)
    if check.words:
        word, _, region = check.words.partition(" ")
        if word != "where":
            raise CheckError(f"{ENTRY}: {check.head!r}: only where REGION may follow")
        within = value_of(region, *place) != 0
    if check.name.startswith("statev_"):  # of the laws that keep it
        within &= ~np.isnan(computed)
    if not within.any():
        raise CheckError(f"{ENTRY}: {check.head!r}: there is no material point")
    exact = value_of(check.exact, *place)[within]
    return Samples(computed[within], exact, table["volume"][within], exact)


def series_of(check: Check, name: str, results: Results) -> Values:
    """Return an observation, or a column of history.csv: [n_records]."""
    known = dict(results.history)
    if results.entry("Verification/Observations"):
        known |= results.observations
    if name not in known:
        raise CheckError(
            f"{ENTRY}: {check.head!r}: there is no observation or column of history.csv"
            f" {name!r}, only {', '.join(known)}"
        )
    return known[name]


def records_of(check: Check) -> tuple[float, float, str, float]:
    """Return from when to when (s) a check looks at a series, and the other series that
    ends it with its value. Raises CheckError for other words."""
    begin, end, other, reached = 0.0, np.inf, "", np.inf
    words = iter(check.words.split())
    try:
        for word in words:
            if word == "from":
                begin = float(next(words))
            elif word == "to":
                end = float(next(words))
            elif word == "until":
                other, reached = next(words), float(next(words))
            else:
                raise ValueError(word)
    except (ValueError, StopIteration) as error:
        raise CheckError(
            f"{ENTRY}: {check.head!r}: only from T, to T and until SERIES VALUE may"
            " follow a series"
        ) from error
    return begin, end, other, reached


def cut(limit: Values, reached: float, x: Values) -> Values:
    """End a series between the records where another one, which does so, reaches a
    value first."""
    i = int(np.flatnonzero(limit[1:] >= reached)[0])
    share = (reached - limit[i]) / (limit[i + 1] - limit[i])
    return np.append(x[: i + 1], x[i] + share * (x[i + 1] - x[i]))


def sample_records(check: Check, results: Results) -> Samples:
    """Return the values of the series at the records that the check asks for."""
    begin, end, other, reached = records_of(check)
    time = results.history["time_s"]
    within = (time >= begin * (1 - 1e-9)) & (time <= end * (1 + 1e-9))
    time, computed = time[within], series_of(check, check.name, results)[within]
    if other:
        limit = series_of(check, other, results)[within]
        if not (limit[1:] >= reached).any():
            raise CheckError(f"{ENTRY}: {check.head!r}: the value is not reached")
        time, computed = (cut(limit, reached, x) for x in (time, computed))
    if not time.size:
        raise CheckError(f"{ENTRY}: {check.head!r}: there is no record")
    exact, upper = (value_of(x, 0.0, 0.0, time) for x in (check.exact, check.upper))
    return Samples(computed, exact, np.ones_like(time), upper)


def compare(text: str, results: Results) -> dict[str, Any]:
    """Return what a check finds in the results of a run that has finished."""
    check = parse(text)
    of_points = check.mode in OF_POINTS
    sample = sample_points if of_points else sample_records
    mode = (OF_POINTS if of_points else OF_SERIES)[check.mode]
    computed, exact, error = map(float, mode(sample(check, results)))
    passed = error <= check.tolerance
    return {
        "check": check.head,
        "mode": check.mode,
        "quantity": check.name,
        "computed": computed,
        "exact": exact,
        "relative_error": error,
        "tolerance": check.tolerance,
        "pass": passed,
        "line": f"{check.head}{check.demand}: {'yes' if passed else 'no'}",
    }


def checks_of(results: Results) -> list[dict[str, Any]]:
    """Return what all checks of a run find, in their order. Raises CheckError where one
    cannot be made, as in a run that has not finished."""
    texts = list(filter(None, map(str.strip, results.entry(ENTRY).split(";"))))
    if texts and (status := results.summary["status"]) != "finished":
        raise CheckError(f"{results.directory} is of a run that is {status}")
    return [compare(text, results) for text in texts]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab checks`."""
    parser.add_argument("directory", type=Path, nargs="+", help="results of a run")


def main(options: argparse.Namespace) -> int:
    """Print the checks of runs; return 1 where one fails."""
    found = [c for path in options.directory for c in checks_of(Results(path))]
    for check in found:
        print(LINE.format(**check))
    return int(not all(check["pass"] for check in found))
