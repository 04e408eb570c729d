# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a log means, in sentences: where it leaves the band, what fits it, and how far
the caisson goes."""
from typing import NamedTuple

import numpy as np

from caisson.log.expected import Expected
from caisson.log.forecast import Bins, Fit, Forecast
from caisson.log.measured import Log, hangs, least_suction

FEWEST = 3  # steps in a row that are outside of the band


class Outcome(NamedTuple):
    """The depths (m) where the upper end, the middle and the lower end of a forecast
    reach the allowable suction; None where they do not."""

    first: float | None
    middle: float | None
    last: float | None


def meets(depth: np.ndarray, needed: np.ndarray, limit: np.ndarray) -> float | None:
    """Return the depth (m) where a suction [n] reaches its limit [n], None where it
    does not."""
    beyond = (needed >= limit) & (needed > 0)
    if not beyond.any():
        return None
    i = int(np.argmax(beyond))
    if i == 0 or not np.isfinite(limit[i - 1 : i + 1]).all():
        return float(depth[i])
    return float(np.interp(0, (needed - limit)[i - 1 : i + 1], depth[i - 1 : i + 1]))


def outcome_of(expected: Expected, forecast: Forecast) -> Outcome:
    """Return where a forecast reaches the allowable suction."""
    limit = np.interp(forecast.depth, expected.depth, expected.allowable)
    lines = (forecast.high, forecast.best, forecast.low)
    return Outcome(*(meets(forecast.depth, line, limit) for line in lines))


def outside(expected: Expected, bins: Bins) -> list[tuple[str, float, float]]:
    """Return (estimate that is passed, from, to) of where a log is out of the band by
    more than its error."""
    low, high = (
        np.interp(bins.depth, expected.depth, side)
        for side in (expected.low, expected.high)
    )
    where = np.where(bins.resistance * (1 - bins.error) > high, 1, 0)
    where[bins.resistance * (1 + bins.error) < low] = -1
    ends = np.flatnonzero(np.diff(where)) + 1
    found = []
    for rows in np.split(np.arange(len(where)), ends):
        if where[rows[0]] and len(rows) >= FEWEST:
            name = "above the high" if where[rows[0]] > 0 else "below the low"
            found.append(
                (name, float(bins.depth[rows[0]]), float(bins.depth[rows[-1]]))
            )
    return found


def of_band(expected: Expected, bins: Bins) -> str:
    """Return where a log leaves the band."""
    place, last = expected.run.shown.place, float(bins.depth[-1])
    parts = []
    for name, begin, end in outside(expected, bins):
        way = "on" if end == last else f"to {place(end, 1)}"
        parts.append(f"from {place(begin, 1)} {way} {name} estimate")
    if not parts:
        return f"The log is within the band, down to {place(last)}."
    return f"The log, down to {place(last)}, is {' and '.join(parts)}."


def of_allowable(expected: Expected, bins: Bins, weight: float) -> str:
    """Return where a measured suction is above the allowable one; weight: in kN."""
    shown = expected.run.shown
    measured = expected.suction(bins.resistance, weight)
    limit = np.interp(bins.depth, expected.depth, expected.allowable)
    begin = meets(bins.depth, measured, limit)
    if begin is None:
        return ""
    i = int(np.nanargmax(measured / limit))
    most, least = (shown.words(side[i], "kPa", ".3g") for side in (measured, limit))
    return (
        f"The measured suction is above the allowable one from {shown.place(begin, 1)}"
        f" on: {most} at {shown.place(float(bins.depth[i]), 1)}, where {least} is"
        " allowed."
    )


def of_fit(fit: Fit) -> str:
    """Return what fits a log."""
    value, low, high = fit.factor
    share = fit.share[0]
    side = "high" if share > 0 else "low"
    return (
        f"So far the resistance is {value:.2f} times the best estimate ({low:.2f} to"
        f" {high:.2f}), {100 * abs(share):.0f} % of the way from best to {side}."
    )


def of_source(expected: Expected) -> list[str]:
    """Return what low and high are, and what of the band is extrapolated."""
    beyond = expected.extrapolations()
    more = f"Extrapolated, as the run has ended there: {beyond}." if beyond else ""
    return [f"Low and high: {expected.source}.", *filter(None, [more])]


def of_forecast(expected: Expected, forecast: Forecast) -> str:
    """Return how far the caisson goes, and what of that rests on extrapolation."""
    text = reach_of(expected, forecast)
    last = outcome_of(expected, forecast).last
    beyond = expected.extrapolations(np.inf if last is None else last)
    return f"{text} This rests on extrapolation: {beyond}." if beyond else text


def reach_of(expected: Expected, forecast: Forecast) -> str:
    """Return how far the caisson goes."""
    shown, end = expected.run.shown, float(forecast.depth[-1])
    first, middle, last = outcome_of(expected, forecast)
    place = shown.place
    factor, unit = shown.factor("kPa"), shown.name("kPa")
    low, high = (f"{factor * side[-1]:.3g}" for side in (forecast.low, forecast.high))
    needs = f"at {low} to {high} {unit}" if forecast.high[-1] > 0 else "by its weight"
    if first is None:
        limit = np.interp(forecast.depth, expected.depth, expected.allowable)
        share = 100 * float(np.max(forecast.high / limit))
        of_limit = f", at most {share:.0f} % of the allowable one" if share > 0 else ""
        return f"Forecast: it reaches {place(end)} {needs}{of_limit}."
    likely = f", most likely at {place(middle, 1)}" if middle is not None else ""
    if last is None:
        return (
            f"Forecast: refusal is possible from {place(first, 1)} on{likely}; at best"
            f" it reaches {place(end)} at {low} {unit}."
        )
    return f"Forecast: refusal between {place(first, 1)} and {place(last, 1)}{likely}."


def of_end(expected: Expected) -> str:
    """Return that the runs end before the scene does, if so."""
    place, end = expected.run.shown.place, float(expected.depth[-1])
    if end >= expected.planned - 1e-3 * expected.planned:
        return ""
    return (
        f"The runs end at {place(end)}, short of the planned {place(expected.planned)}:"
        ' nothing is known below. `caisson run FILE.prm --set "Installation/End where'
        ' infeasible=never"` goes on.'
    )


def left_out(log: Log, expected: Expected, bins: Bins) -> list[str]:
    """Return what a fit does not use."""
    place, found = expected.run.shown.place, list(log.remarks)
    if n := int(hangs(log, expected).sum()):
        found.append(
            f"{n} rows with a suction of at most {least_suction(log, expected):.2g} kPa"
            " are left out, as the weight may hang on a crane; a column weight_kN tells"
        )
    if bins.stops:
        where = ", ".join(place(x, 1) for x in bins.stops)
        found.append(f"steps with a stop are left out of the fit: at {where}")
    return [f"{text[0].upper()}{text[1:]}." for text in found]


def of_gauges(log: Log) -> list[str]:
    """Return what flow, tilt and weight have been."""
    found = []
    if np.isfinite(log.flow).any():
        found.append(f"Largest flow {np.nanmax(log.flow):.3g} m³/h.")
    if np.isfinite(log.tilt).any():
        i = int(np.nanargmax(np.abs(log.tilt)))
        found.append(f"Largest tilt {log.tilt[i]:.2g}° at {log.depth[i]:.3g} m.")
    if np.isfinite(log.weight).any():
        last = log.weight[np.isfinite(log.weight)][-1]
        found.append(
            f"Weight in water at the end {last:.4g} kN, taken for the forecast."
        )
    return found


def said(expected: Expected, bins: Bins, fit: Fit, forecast: Forecast) -> list[str]:
    """Return the sentences, that of the forecast first."""
    lines = (
        of_forecast(expected, forecast),
        of_allowable(expected, bins, forecast.weight),
        of_band(expected, bins),
        of_fit(fit),
        of_end(expected),
    )
    return list(filter(None, lines))
