# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a log means, in sentences: where it leaves the band, what fits it, and how far
the caisson goes."""
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson.vessel_log.expected import Expected
from caisson.vessel_log.forecast import Bins, Fit, Forecast
from caisson.vessel_log.measured import Log, hangs, least_suction
from caisson.template import say, say_rows

SENTENCES = Path(__file__).with_name("words.jinja")
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
    found = []
    for side, rows in groupby(range(len(where)), lambda i: int(where[i])):
        depth = bins.depth[list(rows)]
        if side and len(depth) >= FEWEST:
            name = "above the high" if side > 0 else "below the low"
            found.append((name, float(depth[0]), float(depth[-1])))
    return found


def of_band(expected: Expected, bins: Bins) -> str:
    """Return where a log leaves the band."""
    parts, last = outside(expected, bins), float(bins.depth[-1])
    return say(SENTENCES, "band", expected.run.shown, parts, last)


def measured_and_allowable(
    expected: Expected, bins: Bins, weight: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return both suctions [n] (kPa) at the steps of a log; weight: in kN."""
    limit = np.interp(bins.depth, expected.depth, expected.allowable)
    return expected.suction(bins.resistance, weight), limit


def of_allowable(expected: Expected, bins: Bins, weight: float) -> str:
    """Return where a measured suction is above the allowable one; weight: in kN."""
    measured, limit = measured_and_allowable(expected, bins, weight)
    if (begin := meets(bins.depth, measured, limit)) is None:
        return ""
    i = int(np.nanargmax(measured / limit))
    worst = bins.depth[i], measured[i], limit[i]
    return say(SENTENCES, "allowable", expected.run.shown, begin, *worst)


def of_source(expected: Expected) -> str:
    """Return what low and high are, and what of the band is extrapolated."""
    return say(SENTENCES, "source", expected.source, extrapolations(expected))


def extrapolations(expected: Expected, upto: float = np.inf) -> str:
    """Return which of low, best and high are extrapolated above a depth (m), and from
    where on, in words; "" for none."""
    parts = expected.extrapolations(upto)
    return say(SENTENCES, "extrapolations", expected.run.shown, parts)


def of_forecast(expected: Expected, bins: Bins, forecast: Forecast) -> str:
    """Return how far the caisson goes, and not where it is refused of a log that ends
    with more than the allowable suction."""
    measured, allowable = measured_and_allowable(expected, bins, forecast.weight)
    if measured[-1] > allowable[-1]:
        return say(SENTENCES, "is_above", expected.run.shown, float(bins.depth[-1]))
    met = outcome_of(expected, forecast)
    limit = np.interp(forecast.depth, expected.depth, expected.allowable)
    share = float(np.max(forecast.high / limit)) if met.first is None else 0.0
    beyond = extrapolations(expected, np.inf if met.last is None else met.last)
    shown = expected.run.shown
    return say(SENTENCES, "forecast", shown, forecast, met, share, beyond)


def of_end(expected: Expected) -> str:
    """Return that the runs end before the scene does, if so."""
    end, planned = float(expected.depth[-1]), expected.planned
    if end >= planned - 1e-3 * planned:
        return ""
    return say(SENTENCES, "end", expected.run.shown, end, planned)


def left_out(log: Log, expected: Expected, bins: Bins) -> list[str]:
    """Return what a fit does not use."""
    hanging = int(hangs(log, expected).sum())
    what = hanging, least_suction(log, expected), bins.stops
    found = say_rows(SENTENCES, "left_out", expected.run.shown, *what)
    remarks = [f"{text[0].upper()}{text[1:]}." for text in log.remarks]
    return remarks + [text for _, text in found]


def of_gauges(log: Log) -> list[str]:
    """Return what flow, tilt and weight have been."""
    flow, weight = (x[np.isfinite(x)] for x in (log.flow, log.weight))
    tilts = np.flatnonzero(np.isfinite(log.tilt))
    i = max(tilts, key=lambda row: abs(log.tilt[row]), default=None)
    found = say_rows(
        SENTENCES,
        "gauges",
        flow.max() if len(flow) else None,
        None if i is None else (log.tilt[i], log.depth[i]),
        weight[-1] if len(weight) else None,
    )
    return [text for _, text in found]


def said(expected: Expected, bins: Bins, fit: Fit, forecast: Forecast) -> list[str]:
    """Return the sentences, that of the forecast first."""
    lines = (
        of_forecast(expected, bins, forecast),
        of_allowable(expected, bins, forecast.weight),
        of_band(expected, bins),
        say(SENTENCES, "fit", fit.factor, fit.share[0]),
        of_end(expected),
    )
    return list(filter(None, lines))
