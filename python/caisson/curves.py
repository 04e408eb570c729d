# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a curve: every mean over a window is taken here.

The rows of history.csv are means since the row before, so a force is averaged
over a window of penetration before it is shown or compared. One definition
holds for all of them:

    The window of width w about x holds the rows whose position lies between
    x - w/2 and x + w/2, both ends included; a distance that exceeds w/2 by no
    more than EDGE still counts, so that rounding in the tenth digit does not
    decide whether a row at the end is in. The mean is that of the values of
    these rows, each with the same weight. It is nan where the window reaches
    beyond the first or the last position of the curve, and where it holds no
    finite value.

Positions are metres of penetration or of travelled path.
"""
import math
from collections.abc import Sequence

import numpy as np

from caisson.results import Table

EDGE = 1e-9  # m
FORCE_WINDOW = 0.2  # m, of the forces of a caisson
# with excess pressure on the tip and beneath a sealed lid, where a run has such
WITH_WATER = "total_force_with_water_N"
FROM = 1.0  # m, of roughness and energy ratio: the start is left out


def in_window(position: np.ndarray, at: float, width: float) -> np.ndarray:
    """Return which of the positions [n] lie in the window about at: [n]."""
    return np.abs(position - at) <= width / 2 + EDGE


def is_whole(position: np.ndarray, at: float, width: float) -> bool:
    """Return whether the window about at lies within the positions [n]."""
    low, high = at - width / 2 + EDGE, at + width / 2 - EDGE
    return bool(position.min() <= low and high <= position.max())


def window_mean(
    position: np.ndarray, values: np.ndarray, at: float, width: float
) -> float:
    """Return the mean of values [n] in the window about at, or nan."""
    chosen = values[in_window(position, at, width)]
    chosen = chosen[np.isfinite(chosen)]
    if len(chosen) == 0 or not is_whole(position, at, width):
        return float("nan")
    return float(chosen.mean())


def window_means(
    position: np.ndarray, values: np.ndarray, at: np.ndarray, width: float
) -> np.ndarray:
    """Return the means in windows about each of at [m]: [m]."""
    return np.array([window_mean(position, values, x, width) for x in at])


def window_rms(position: np.ndarray, values: np.ndarray, width: float) -> np.ndarray:
    """Return the root of the mean square of values [n] about each position [n];
    at the ends over the part of the window that there is."""
    near = [in_window(position, at, width) for at in position]
    return np.array([np.sqrt(np.mean(values[rows] ** 2)) for rows in near])


def smoothed_at(position: np.ndarray, values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return the means over FORCE_WINDOW about each of at [m]: [m]; near the ends of
    the positions [n], which grow, over as much as fits, beyond them the last value, and
    at the end itself that of a line through the last FORCE_WINDOW."""
    means = window_means(position, values, at, FORCE_WINDOW)
    short = means_to_the_ends(position, values, at, FORCE_WINDOW)
    short = np.where(np.isfinite(short), short, np.interp(at, position, values))
    last = (position >= position[-1] - FORCE_WINDOW - EDGE) & np.isfinite(values)
    if last.sum() > 2:
        line = np.polyfit(position[last] - position[-1], values[last], 1)
        short = np.where(np.abs(at - position[-1]) < 1e-3, line[1], short)
    return np.where(np.isfinite(means), means, short)


def integral(position: np.ndarray, values: np.ndarray, to: np.ndarray) -> np.ndarray:
    """Return the integral of a curve [n], linear between its rows, from its first
    position, which must be the smallest of rising ones, to each of to [m]: [m]."""
    pieces = np.diff(position) * (values[1:] + values[:-1]) / 2
    at_rows = np.concatenate([[0.0], np.cumsum(pieces)])
    row = np.clip(np.searchsorted(position, to) - 1, 0, len(position) - 2)
    ends = np.interp(to, position, values)
    return at_rows[row] + (to - position[row]) * (values[row] + ends) / 2


def means_to_the_ends(
    position: np.ndarray, values: np.ndarray, at: np.ndarray, width: float
) -> np.ndarray:
    """Return the means over windows about each of at [m], which near the ends of the
    curve are as wide as fits about them: [m].

    position [n] only grows or only falls. The curve is linear between its rows, and
    each part of a window has the same weight, so that rows which lie closer together,
    as where a body is slow, do not count more. Beyond the ends the mean is nan.
    """
    known = np.isfinite(values)
    order = np.argsort(position[known])
    position, values = position[known][order], values[known][order]
    if len(position) < 2:
        return np.full(len(at), np.nan)
    room = np.minimum(at - position[0], position[-1] - at)
    half = np.clip(room, 0.0, width / 2)
    low, high = [integral(position, values, at + side * half) for side in (-1, 1)]
    exact = np.interp(at, position, values)
    wide = half > EDGE
    means = np.where(wide, (high - low) / np.where(wide, 2 * half, 1.0), exact)
    return np.where(room < -EDGE, np.nan, means)


def way_down(position: np.ndarray) -> np.ndarray:
    """Return the numbers of the rows that are deeper than all before them."""
    before = np.maximum.accumulate(position)[:-1]
    return np.flatnonzero(np.concatenate([[True], position[1:] > before]))


def way_up(position: np.ndarray) -> np.ndarray:
    """Return the numbers of the rows, from the deepest on, that are less deep than
    all between it and them."""
    deepest = int(np.argmax(position))
    return deepest + way_down(-position[deepest:])


def common_depths(positions: Sequence[np.ndarray], interval: float) -> np.ndarray:
    """Return the multiples of the interval (m) that at least one of the curves, each
    [n_rows], passes."""
    low = min(float(position.min()) for position in positions)
    high = max(float(position.max()) for position in positions)
    first = math.ceil(low / interval - 1e-6)
    last = math.floor(high / interval + 1e-6)
    return np.round(interval * np.arange(first, last + 1), 9)


def round_depths(position: np.ndarray) -> np.ndarray:
    """Return each meter that a curve passes, or finer steps of a short one; none of
    a curve that stays where it is."""
    span = float(np.ptp(position))
    if span == 0:
        return np.empty(0)
    step = 1.0 if span >= 2 else 10.0 ** math.floor(math.log10(span / 2))
    first = math.floor(position.min() / step + 1e-9) + 1
    last = math.floor(position.max() / step + 1e-9)
    return np.array([i * step for i in range(first, last + 1)])


def path_of(position: np.ndarray) -> np.ndarray:
    """Return the travelled path [n] at each position [n], which may go back."""
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(position)))])


def running_mean(position: np.ndarray, values: np.ndarray, width: float) -> np.ndarray:
    """Return the mean in the window of travelled path about each row: [n]. The
    first and the last half window are nan."""
    path = path_of(position)
    return window_means(path, values, path, width)


def roughness(position: np.ndarray, force: np.ndarray) -> float:
    """Return the standard deviation of a force about its running mean over the
    mean of the latter, from FROM on (a share of 1)."""
    mean = running_mean(position, force, FORCE_WINDOW)
    used = (position >= FROM) & np.isfinite(mean)
    if not used.any():
        return float("nan")
    return float(np.std(force[used] - mean[used]) / np.mean(mean[used]))


def largest_energy_ratio(history: Table) -> float:
    """Return the largest kinetic energy over external work, from FROM on (a
    share of 1)."""
    work = history["external_work_J"] + history.get("water_work_J", 0.0)
    deep = (history["penetration_m"] >= FROM) & (work != 0)
    if not deep.any():
        return float("nan")
    ratio = history["kinetic_energy_J"][deep] / work[deep]
    return float(ratio.max())


def forces_at(history: Table, column: str, depths: np.ndarray) -> np.ndarray:
    """Return the means of a force over FORCE_WINDOW about some depths [m] (m of
    penetration): [m]."""
    return window_means(history["penetration_m"], history[column], depths, FORCE_WINDOW)


def depth_at(time: float, history: Table) -> float:
    """Return the penetration at a time (m)."""
    return float(np.interp(time, history["time_s"], history["penetration_m"]))
