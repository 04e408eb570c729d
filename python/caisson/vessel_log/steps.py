# SPDX-License-Identifier: LGPL-2.1-or-later
"""The readings of a log in steps of depth, what becomes of each of them, and logs that
cannot be of the caisson of a run.

The resistance of a step is the median of its readings. A step that takes much longer
than those around has a stop. It is left out where the pump rested, and kept where the
caisson rested under more than the ground has held around: then its resistance is the
largest that the ground has held.
"""
from pathlib import Path

import numpy as np
from scipy.ndimage import median_filter

from caisson.disk import InputError
from caisson.vessel_log.expected import Expected
from caisson.vessel_log.forecast import LEAST_NOISE, Bins
from caisson.vessel_log.measured import Log, level_of

SHARE = 0.01  # of the way: the length of a step
LONG = 3.0  # times as slow as its neighbors is a step with a stop
AROUND = 2  # steps to either side that a step is compared with
HELD = 1.1  # times the resistance around, which the ground has held in a stop
HELD_SHARE = 0.95  # quantile of the resistances of a stop
LEAST_SUCTION = 0.03  # of the largest one, below which the weight may hang on a crane
FEWEST = 3  # steps of a fit
FAR = 10.0  # times the best resistance: no ground is so far from that of the runs
FAR_SUCTION = 50.0  # times the expected suction, where this is not small
SMALL = 0.2  # of the largest suction that is expected
FAR_WEIGHT = 3.0  # times the weight of the scene
BELOW_SKIRT = 1.02  # times the length of the skirt, which a tip may have in a log
AGREE = 0.1  # share by which two columns may differ that tell the same


def progress_of(log: Log) -> np.ndarray:
    """Return the depth [n] that the tip has reached up to each row, without the noise
    of single readings."""
    if not np.isfinite(log.time).all() or len(log.depth) < 5:
        return log.depth
    return np.maximum.accumulate(median_filter(log.depth, 5, mode="nearest"))


def weight_of(log: Log, expected: Expected) -> float:
    """Return the weight in water (kN) at the end of a log, that of the scene where none
    is measured."""
    known = log.weight[np.isfinite(log.weight)]
    return float(known[-1]) if len(known) else expected.weight


def least_suction(log: Log, expected: Expected) -> float:
    """Return the suction (kPa) below which the weight may hang on a crane: a share of
    the largest one, or of the largest that is expected where that is less."""
    known = log.suction[np.isfinite(log.suction)]
    largest = level_of(known).max() if len(known) else 0.0
    high = expected.suction(expected.high).max()
    return LEAST_SUCTION * float(min(largest, high) if high > 0 else largest)


def hangs(log: Log, expected: Expected) -> np.ndarray:
    """Return in which rows [n] the weight may hang on a crane, so that the suction does
    not tell the resistance."""
    with np.errstate(invalid="ignore"):
        is_low = log.suction <= least_suction(log, expected)
        is_weighed = np.isfinite(log.weight) & (log.suction >= 0)
    return np.asarray(is_low & ~is_weighed & ~np.isfinite(log.resistance))


def resistance_of(log: Log, expected: Expected) -> np.ndarray:
    """Return the resistance (kN) of each row [n]: that measured, or suction on the area
    inside and the weight, that of the scene where none is measured; nan where the
    weight alone may hang on a crane."""
    weight = np.where(np.isfinite(log.weight), log.weight, expected.weight)
    found = log.suction * expected.area + weight
    found = np.where(hangs(log, expected), np.nan, found)
    found = np.where(np.isfinite(log.resistance), log.resistance, found)
    return np.where(found > 0, found, np.nan)


def suction_of(log: Log, expected: Expected) -> np.ndarray:
    """Return the suction (kPa) of each row [n]: that measured, or what the resistance
    takes beyond the weight where none is."""
    computed = expected.suction(resistance_of(log, expected), weight_of(log, expected))
    return np.where(np.isfinite(log.suction), log.suction, computed)


def width_of(expected: Expected) -> float:
    """Return the length of a step (m)."""
    return SHARE * expected.planned


def below_runs(log: Log, expected: Expected) -> np.ndarray:
    """Return in which rows [n] the tip is below the end of the runs."""
    return progress_of(log) > expected.depth[-1] + width_of(expected)


def bins_of(path: Path, log: Log, expected: Expected) -> Bins:
    """Return the log in steps of depth. Raises InputError where too little is left, or
    where the log cannot be of the caisson of the run."""
    depth, force, width = (
        progress_of(log),
        resistance_of(log, expected),
        width_of(expected),
    )
    refuse_depth(path, depth, expected)
    number = np.floor(depth / width)
    inside = np.isfinite(force) & (depth >= expected.depth[0])
    inside &= ~below_runs(log, expected)
    depth = depth.clip(max=expected.depth[-1])
    places = np.unique(number[inside])
    slow = {
        k
        for k, is_slow in zip(np.unique(number), has_stop(log, number, width))
        if is_slow
    }
    found, held, stops = list[tuple[float, float, float]](), list[int](), list[int]()
    for i, k in enumerate(places):
        rows = inside & (number == k)
        logs = np.log(force[rows])
        middle = float(np.median(logs))
        if k in slow:
            near = [x for x in places[max(i - AROUND, 0) : i + AROUND + 1] if x != k]
            around = force[inside & np.isin(number, [x for x in near if x not in slow])]
            most = float(np.quantile(force[rows], HELD_SHARE))
            is_held = len(around) > 0 and most > HELD * float(np.median(around))
            (held if is_held else stops).append(i)
            middle = np.log(most) if is_held else middle
        scatter = 1.86 * float(np.median(np.abs(logs - np.median(logs))))
        error = max(LEAST_NOISE, scatter / np.sqrt(len(logs)))
        error = error if len(logs) > 2 else 2 * LEAST_NOISE
        found.append((float(np.mean(depth[rows])), float(np.exp(middle)), error))
    some = np.array(found).reshape(-1, 3)
    keep = ~np.isin(np.arange(len(some)), stops)
    if keep.sum() < FEWEST:
        raise InputError(
            f"{path}: too few rows with suction lie between {expected.depth[0]:.3g} and"
            f" {expected.depth[-1]:.3g} m, where the runs are, for a fit (the log goes"
            f" to {progress_of(log).max():.3g} m); it takes {FEWEST} steps of"
            f" {width:.2g} m"
        )
    stopped, resting = (tuple(map(float, some[x, 0])) for x in (stops, held))
    depths, forces, errors = some[keep].T
    bins = Bins(depths, forces, errors, stopped, resting)
    refuse_force(path, log, bins, expected)
    return bins


def has_stop(log: Log, number: np.ndarray, width: float) -> np.ndarray:
    """Return which steps [m] were much slower than those around. number: that of the
    step of each row [n], growing; width: of a step (m)."""
    first = np.unique(number, return_index=True)[1]
    if not np.isfinite(log.time).all():
        return np.zeros(len(first), dtype=bool)
    end = np.append(first[1:], len(number) - 1)
    progress = progress_of(log)
    spent = log.time[end] - log.time[first]
    gone = (progress[end] - progress[first]).clip(min=width)
    steps = np.diff(log.time)
    tick = float(steps[steps > 0].min(initial=np.inf))
    pace = spent / gone
    near = (pace[max(i - AROUND, 0) : i + AROUND + 1] for i in range(len(pace)))
    usual = np.array(list(map(np.median, near)))
    return np.asarray(spent > LONG * (usual * gone + tick))


def refuse_depth(path: Path, depth: np.ndarray, expected: Expected) -> None:
    """Raise InputError where a log [n] (m) is deeper than the skirt is long."""
    length = float(expected.run.scene["skirt_length_m"])
    if (last := float(depth.max())) > BELOW_SKIRT * length:
        raise InputError(
            f"{path}: the tip goes to {last:.4g} m, and the skirt is {length:.4g} m"
            " long; check the unit of the depth, its datum, which is the seabed, and"
            " whether the log is of this caisson"
        )


def refuse_force(path: Path, log: Log, bins: Bins, expected: Expected) -> None:
    """Raise InputError where weights, suctions or resistances are so far from those of
    the runs that a unit is wrong, or the log is of another caisson."""
    best = np.interp(bins.depth, expected.depth, expected.best)
    ahead = expected.suction(best)
    is_clear = ahead > SMALL * expected.suction(expected.best).max()
    measured = expected.suction(bins.resistance, weight_of(log, expected))
    ratios = {
        "weight": (np.nanmax(log.weight, initial=0.0) / expected.weight, FAR_WEIGHT),
        "resistance": (float(np.median(bins.resistance / best)), FAR),
    }
    if is_clear.any() and np.isfinite(log.suction).any():
        ratio = float(np.median(measured[is_clear] / ahead[is_clear]))
        ratios["suction"] = ratio, FAR_SUCTION
    for name, (ratio, far) in ratios.items():
        if ratio > 0 and not 1 / far < ratio < far:
            raise InputError(
                f"{path}: the {name} is {ratio:.2g} times that of the run, which no"
                f" ground explains; check the unit of the {name}, the weight of the"
                " scene, and whether the log is of this caisson"
            )


def disagreement(log: Log, expected: Expected) -> float:
    """Return how far a measured resistance is from suction and weight, as a share of
    the latter; 0 where a log does not have both, or where they agree."""
    weight = np.where(np.isfinite(log.weight), log.weight, expected.weight)
    ratio = log.resistance / (log.suction * expected.area + weight)
    ratio = ratio[np.isfinite(ratio) & (log.suction > 0)]
    share = float(np.median(ratio)) - 1 if len(ratio) else 0.0
    return share if abs(share) > AGREE else 0.0
