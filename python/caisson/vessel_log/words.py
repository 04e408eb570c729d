# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a log means, in sentences: where it leaves the band, what fits it, and how far
the caisson goes."""
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson.vessel_log.expected import Expected
from caisson.vessel_log.forecast import Bins, Fit, Forecast
from caisson.vessel_log.measured import Log
from caisson.vessel_log.steps import (
    below_runs,
    disagreement,
    hangs,
    held_by,
    least_suction,
    progress_of,
    resistance_of,
    suction_of,
    weight_of,
    width_of,
)
from caisson.template import say, say_rows
from caisson.verdict import acceptance
from caisson.verdict.installation import Rate, installation_of

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
        is_last = depth[-1] == bins.depth[-1]
        is_clear = side > 0 and (is_last or bool(set(depth) & set(bins.held)))
        if side and (is_clear or len(depth) >= FEWEST):
            name = "above the high" if side > 0 else "below the low"
            found.append((name, float(depth[0]), float(depth[-1])))
    return found


def of_band(expected: Expected, bins: Bins) -> str:
    """Return where a log leaves the band."""
    parts, last = outside(expected, bins), float(bins.depth[-1])
    return say(SENTENCES, "band", expected.run.shown, parts, last)


def measured_and_allowable(
    expected: Expected, log: Log
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return depth (m), suction and allowable suction (kPa) of each reading [n] where
    all are known."""
    depth, suction = progress_of(log), suction_of(log, expected)
    limit = np.interp(depth, expected.depth, expected.allowable, left=np.nan)
    known = np.isfinite(suction) & np.isfinite(limit) & ~below_runs(log, expected)
    return depth[known], suction[known], limit[known]


def of_allowable(expected: Expected, log: Log) -> str:
    """Return which readings have more suction than is allowed."""
    depth, suction, limit = measured_and_allowable(expected, log)
    over = np.flatnonzero(suction > np.maximum(limit, 0))
    if not len(over):
        return ""
    i = over[np.argmax(suction[over] - limit[over])]
    counts, worst = (len(over), len(depth)), (depth[i], suction[i], limit[i])
    begin = float(depth[over[0]])
    return say(SENTENCES, "allowable", expected.run.shown, *counts, begin, *worst)


def ends_above(expected: Expected, log: Log) -> bool:
    """Return whether a reading in the last step of a log has more than the allowable
    suction."""
    depth, suction, limit = measured_and_allowable(expected, log)
    last = depth >= progress_of(log)[-1] - width_of(expected)
    return bool((suction > np.maximum(limit, 0))[last].any())


def of_source(expected: Expected) -> str:
    """Return what low and high are, and what of the band is extrapolated."""
    return say(SENTENCES, "source", expected.source, extrapolations(expected))


def extrapolations(expected: Expected, upto: float = np.inf) -> str:
    """Return which of low, best and high are extrapolated above a depth (m), and from
    where on, in words; "" for none."""
    parts = expected.extrapolations(upto)
    return say(SENTENCES, "extrapolations", expected.run.shown, parts)


def no_forecast(expected: Expected, log: Log) -> str:
    """Return why nothing can be said of what is to come: the log is deeper than the
    runs, or ends with a refusal; nothing where a forecast can be made."""
    shown, last = expected.run.shown, float(progress_of(log)[-1])
    if below_runs(log, expected).any():
        return say(SENTENCES, "is_below", shown, last, float(expected.depth[-1]))
    if ends_above(expected, log):
        return say(SENTENCES, "is_above", shown, last)
    held = held_by(log, expected)
    return say(SENTENCES, "is_held", shown, last, *held) if held else ""


def of_forecast(expected: Expected, forecast: Forecast) -> str:
    """Return how far the caisson goes."""
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


def of_readings(log: Log, expected: Expected, bins: Bins) -> list[str]:
    """Return what reading a log came to, what a fit does not use, and where columns
    contradict each other."""
    depth, last = progress_of(log), float(expected.depth[-1])
    above = int((depth < expected.depth[0]).sum()), float(expected.depth[0])
    below = int(below_runs(log, expected).sum()), last
    hanging = int(hangs(log, expected).sum()), least_suction(log, expected)
    differs = disagreement(log, expected)
    no_force = ~np.isfinite(resistance_of(log, expected)) & ~hangs(log, expected)
    what = above, below, hanging, int(no_force.sum()), bins.rests, bins.held, differs
    found = say_rows(SENTENCES, "readings", expected.run.shown, *what)
    remarks = [f"{text[0].upper()}{text[1:]}." for text in log.remarks]
    return remarks + [text for _, text in found]


def of_gauges(log: Log, expected: Expected) -> list[str]:
    """Return what flow, tilt and weight have been, beside what stops the vessel."""
    known = installation_of(expected.run, Rate())
    assert known is not None  # it has a required suction
    stop = acceptance.stop_of(expected.run, known, expected.planned)
    flow = log.flow[np.isfinite(log.flow)]
    tilts = np.flatnonzero(np.isfinite(log.tilt))
    i = max(tilts, key=lambda row: abs(log.tilt[row]), default=None)
    found = say_rows(
        SENTENCES,
        "gauges",
        expected.run.shown,
        flow.max() if len(flow) else None,
        None if i is None else (abs(log.tilt[i]), log.depth[i]),
        weight_of(log, expected) if np.isfinite(log.weight).any() else None,
        stop,
    )
    return [text for _, text in found]


def said(expected: Expected, log: Log, bins: Bins, fit: Fit) -> list[str]:
    """Return the sentences behind that of the forecast."""
    lines = (
        of_allowable(expected, log),
        of_band(expected, bins),
        say(SENTENCES, "fit", fit),
        of_end(expected),
        *of_gauges(log, expected),
        *of_readings(log, expected, bins),
    )
    return list(filter(None, lines))
