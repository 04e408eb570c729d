# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a curve, and their error bars: every mean over a window of history.csv is
taken here.

The rows of history.csv are means since the row before, so a number is averaged over a
window of penetration before it is shown or compared. smoothed_at() has the definition.

Positions are metres of penetration or of travelled path.
"""
import math
from collections.abc import Iterable, Sequence

import numpy as np

from caisson.results import Table

EDGE = 1e-9  # m, by which a row may lie outside of a window and still count
FORCE_WINDOW = 0.2  # m, of a way of 2 m and more; see window_of()
# with excess pressure on the tip and beneath a sealed lid, where a run has such
WITH_WATER = "total_force_with_water_N"
FROM, FEWEST = 1.0, 10  # of a roughness: m of the start that are left out, and rows


def penetration(history: Table) -> np.ndarray | None:
    """Return the penetration of each row, or None where it does not change."""
    depth = history.get("penetration_m")
    if depth is None or not np.all(np.isfinite(depth)) or np.ptp(depth) < 1e-9:
        return None
    return depth


def window_of(way: float) -> float:
    """Return the width of the window on a way of this length (m): a tenth of a short
    one. A mean of h^2 about h is too high by (window / h)^2 / 12."""
    return min(FORCE_WINDOW, way / 10)


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
    """Return the means of a curve [n], which only grows or only falls, at each of at
    [m]: [m]; beyond its ends those at the ends.

    A mean is that of the rows in the window of window_of() about a position. A window
    that would reach beyond an end of the curve begins or ends there, and a straight
    line of least squares through its rows gives the value at the position. With fewer
    than three rows in it, the value lies on the line between the two rows around.
    """
    order = np.argsort(position)
    order = order[np.isfinite(values[order])]
    x, y = position[order], values[order]
    if len(x) < 2:
        return np.full(len(at), y[0] if len(y) else np.nan)
    half = window_of(x[-1] - x[0]) / 2
    at = np.clip(at, x[0], x[-1])
    centers = np.clip(at, x[0] + half, x[-1] - half)
    first = np.searchsorted(x, centers - half - EDGE)
    last = np.searchsorted(x, centers + half + EDGE, "right")
    is_known = last - first >= 3
    ends = np.column_stack([first, last]).ravel()
    sums = np.add.reduceat(np.append(y, 0.0), ends)[::2]
    means = sums / np.maximum(last - first, 1)
    found: np.ndarray = np.where(is_known, means, np.interp(at, x, y))
    for i in np.flatnonzero(is_known & (abs(at - centers) >= EDGE)):
        rows = slice(first[i], last[i])
        found[i] = line_at(x[rows], y[rows], at[i])
    return found


def line_at(x: np.ndarray, y: np.ndarray, at: float) -> float:
    """Return the value at a position on the straight line of least squares through
    values y at x, [n] each."""
    distance = x - x.mean()
    slope = distance @ y / (distance @ distance)
    return float(y.mean() + slope * (at - x.mean()))


def down_at(history: Table, names: Iterable[str], at: np.ndarray) -> Table:
    """Return the same means of columns on the way down at depths at [m] (m). The first
    row of a history is zero, as no time has passed, and is left out."""
    rows = way_down(history["penetration_m"])[1:]
    depth = history["penetration_m"][rows]
    return {name: smoothed_at(depth, history[name][rows], at) for name in names}


def smoothed_within(
    position: np.ndarray, values: np.ndarray, at: np.ndarray
) -> np.ndarray:
    """Return the same means, [m], and nan beyond the ends of the curve."""
    low, high = position.min() - EDGE, position.max() + EDGE
    inside = (at >= low) & (at <= high)
    return np.where(inside, smoothed_at(position, values, at), np.nan)


def way_down(position: np.ndarray) -> np.ndarray:
    """Return the numbers of the rows that are deeper than all before them."""
    before = np.maximum.accumulate(position)[:-1]
    return np.flatnonzero(np.concatenate([[True], position[1:] > before]))


def way_up(position: np.ndarray) -> np.ndarray:
    """Return the numbers of the rows, from the deepest on, that are less deep than
    all between it and them."""
    deepest = int(np.argmax(position))
    return deepest + way_down(-position[deepest:])


def main_way(position: np.ndarray) -> np.ndarray:
    """Return the numbers of the rows of the way down, or of the way up where that is
    ten times as long, as of a body that is pulled; without the row where it begins,
    over which there is no mean."""
    down, up = (way[1:] for way in (way_down(position), way_up(position)))
    fall, rise = position.max() - position[0], position.max() - position[-1]
    return up if 10 * fall <= rise and rise > 0 else down


def common_depths(positions: Sequence[np.ndarray], interval: float) -> np.ndarray:
    """Return the multiples of the interval (m) that at least one of the curves, each
    [n_rows], passes."""
    low = min(float(position.min()) for position in positions)
    high = max(float(position.max()) for position in positions)
    first = math.ceil(low / interval - 1e-6)
    last = math.floor(high / interval + 1e-6)
    return np.round(interval * np.arange(first, last + 1), 9)


def down_to(end: float | None, depths: np.ndarray) -> np.ndarray:
    """Return the depths [n] above an end, and the end; all where there is none."""
    if end is None or end >= depths[-1]:
        return depths
    return np.append(depths[depths < 0.999 * end], end)


def round_depths(position: np.ndarray) -> np.ndarray:
    """Return each meter that a curve passes, or finer steps of a short one; none of
    a curve that stays where it is."""
    span = float(np.ptp(position))
    if span == 0:
        return np.empty(0)
    step = 1.0 if span >= 2 else 10.0 ** math.floor(math.log10(span / 2))
    first = math.floor(position.min() / step + 1e-9) + 1
    last = math.floor(position.max() / step + 1e-9)
    return np.round(step * np.arange(first, last + 1), 9)


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
    mean of the latter, from FROM on (a share of 1), nan of few rows."""
    way = float(np.ptp(position))
    mean = running_mean(position, force, window_of(way))
    used = (position >= min(FROM, position.min() + way / 2)) & np.isfinite(mean)
    if used.sum() <= FEWEST:
        return float("nan")
    return float(np.std(force[used] - mean[used]) / np.mean(mean[used]))


def gradient_share(history: Table) -> np.ndarray:
    """Return the larger exit gradient over the critical one, [n_rows]."""
    larger = np.maximum(history["exit_gradient_wall"], history["exit_gradient_axis"])
    critical = history["critical_gradient"]
    nothing = np.zeros(len(critical))
    return np.divide(np.maximum(larger, 0), critical, out=nothing, where=critical > 0)


def forces_at(history: Table, column: str, depths: np.ndarray) -> np.ndarray:
    """Return the means of a column on the way down at some depths [m] (m): [m]. nan
    where the window is not whole."""
    rows = way_down(history["penetration_m"])[1:]
    depth = history["penetration_m"][rows]
    width = window_of(float(np.ptp(depth))) if len(depth) else FORCE_WINDOW
    return window_means(depth, history[column][rows], depths, width)


def depth_at(time: float, history: Table) -> float:
    """Return the penetration at a time (m)."""
    return float(np.interp(time, history["time_s"], history["penetration_m"]))


def error_band(
    bounds: Table, name: str, unit: str = ""
) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Return depths and running means of the lower and the upper bound of a quantity,
    [n_rows] each, or None where the run has none."""
    low, high = ["_".join(filter(None, [name, s, unit])) for s in ("low", "high")]
    if low not in bounds or high not in bounds:
        return None
    depth = bounds["penetration_m"]
    window = window_of(float(path_of(depth)[-1]))
    means = [running_mean(depth, bounds[column], window) for column in (low, high)]
    return depth, means[0], means[1]
