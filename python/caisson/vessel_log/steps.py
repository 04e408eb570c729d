# SPDX-License-Identifier: LGPL-2.1-or-later
"""The readings of a log in steps of depth, whether the caisson rests under growing
suction where it ends, and logs that cannot be of the caisson of a run.

The resistance of a step is the median of its readings or, where this is clearly more,
the largest that readings in a row have had: so much the ground has held while the tip
was in the step, whatever came before or after, as where the pump rested, or where the
caisson rested under growing suction.
"""
from pathlib import Path

import numpy as np

from caisson.disk import InputError
from caisson.vessel_log.expected import Expected
from caisson.vessel_log.forecast import LEAST_NOISE, Bins
from caisson.table import NOTHING
from caisson.vessel_log.measured import AROUND, Log, level_of, smooth

SHARE = 0.01  # of the way: the length of a step
LONG = 3.0  # times as long as usual the tip is in a step, where the caisson rests
BEFORE = 3  # steps above it, whose suction is that before
RISE = 1.15  # times the suction before, as it grows with depth: growing suction
IN_A_ROW = 3  # readings at least, whose median counts
HELD = 1.1  # times the median of a step: clearly more
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
    return np.maximum.accumulate(smooth(log.depth))


def weight_of(log: Log, expected: Expected) -> float:
    """Return the weight in water (kN) at the end of a log, that of the scene where none
    is measured, or where less is as a crane still holds it: before any suction."""
    known = log.weight[np.isfinite(log.weight)]
    if not len(known):
        return expected.weight
    return float(known[-1] if is_pumped(log) else max(known[-1], expected.weight))


def weights_of(log: Log, expected: Expected) -> np.ndarray:
    """Return the weight in water (kN) of each row [n], that of the scene where none is
    measured."""
    return np.where(np.isfinite(log.weight), log.weight, expected.weight)


def is_pumped(log: Log) -> bool:
    """Return whether a log has any suction."""
    return bool(np.nanmax(log.suction, initial=0.0) > NOTHING)


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
    found = log.suction * expected.area + weights_of(log, expected)
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


def largest_in_a_row(values: np.ndarray) -> float:
    """Return the largest median of values [n] that follow each other: of IN_A_ROW and,
    where they are many, of up to AROUND; values that are nan are none."""
    known = values[np.isfinite(values)]
    width = int(np.clip(len(known) // 4, min(IN_A_ROW, len(known)), AROUND))
    windows = np.lib.stride_tricks.sliding_window_view(known, width)
    return float(np.median(windows, axis=1).max())


def bins_of(path: Path, log: Log, expected: Expected, fewest: int = FEWEST) -> Bins:
    """Return the log in steps of depth. Raises InputError where fewer are left, or
    where the log cannot be of the caisson of the run."""
    depth, force = progress_of(log), resistance_of(log, expected)
    refuse_depth(path, depth, expected)
    width = width_of(expected)
    number = np.floor(depth / width)
    inside = np.isfinite(force) & (depth >= expected.depth[0])
    inside &= ~below_runs(log, expected)
    clock, usual = clock_of(log, width)
    found, rests, held = list[tuple[float, float, float, float]](), 0, list[float]()
    weight = weights_of(log, expected)
    for k in np.unique(number[inside]):
        rows = inside & (number == k)
        logs = np.log(force[rows])
        middle, most = float(np.median(logs)), largest_in_a_row(logs)
        is_clear = most > middle + np.log(HELD)
        force_of_step = float(np.exp(most if is_clear else middle))
        above = [row[1] for row in found[-BEFORE:]]
        is_long = np.ptp(clock[number == k]) > LONG * usual
        if above and is_long and HELD * force_of_step < np.median(above):
            rests += 1  # the pump rested, and the ground bears more
            continue
        scatter = 1.86 * float(np.median(np.abs(logs - middle))) / np.sqrt(len(logs))
        error = max(LEAST_NOISE, 0.0 if is_clear else scatter)
        error = error if len(logs) > 2 else 2 * LEAST_NOISE
        place = min(float(np.mean(depth[rows])), float(expected.depth[-1]))
        if above and is_long and force_of_step > HELD * np.median(above):
            held.append(place)
        found.append((place, force_of_step, error, float(np.median(weight[rows]))))
    if len(found) < fewest:
        raise InputError(
            f"{path}: too few rows with suction lie between {expected.depth[0]:.3g} and"
            f" {expected.depth[-1]:.3g} m, where the runs are, for a fit (the log goes"
            f" to {depth.max():.3g} m); it takes {fewest} steps of {width:.2g} m"
        )
    depths, forces, errors, weights = np.array(found).T
    bins = Bins(depths, forces, errors, weights, rests, tuple(held))
    refuse_force(path, log, bins, expected)
    return bins


def suction_in(bins: Bins, expected: Expected) -> np.ndarray:
    """Return the suction [n] (kPa) of the steps of a log, under the weight there."""
    return np.maximum((bins.resistance - bins.weight) / expected.area, 0.0)


def held_by(log: Log, expected: Expected) -> tuple[float, float] | None:
    """Return the suction (kPa) under which a caisson rests where a log ends, and that
    of high resistance there, if it has been long in its last step with clearly more
    suction than before, or with more resistance than the high estimate; None
    otherwise, and where it has come to the planned depth."""
    depth, width = progress_of(log), width_of(expected)
    last, (clock, usual) = float(depth[-1]), clock_of(log, width)
    end = depth > last - width
    is_down = last > expected.planned - width
    is_long = np.ptp(clock[end]) > LONG * usual
    if np.isnan(usual):  # a short log
        is_long = 2 * np.ptp(clock[end]) > np.ptp(clock)
    if is_down or not is_long:
        return None
    force, suction = resistance_of(log, expected), suction_of(log, expected)
    if not np.isfinite(suction[end]).any():
        return None
    most = largest_in_a_row(suction[end])
    high = float(np.interp(last, expected.depth, expected.high))
    found = most, float(expected.suction(np.array(high), weight_of(log, expected)))
    if np.isfinite(force[end]).any() and largest_in_a_row(force[end]) > high:
        return found
    before = (depth > last - (BEFORE + 1) * width) & ~end & np.isfinite(suction)
    if not before.any():
        return None
    less, middle = float(np.median(suction[before])), float(np.median(depth[before]))
    best = np.interp([middle, last], expected.depth, expected.best)
    above, here = expected.suction(best)
    growth = max(float(here / above), 1.0) if above > 0 else np.inf
    is_more = most > RISE * growth * less and less > least_suction(log, expected)
    return found if is_more else None


def clock_of(log: Log, width: float) -> tuple[np.ndarray, float]:
    """Return the time of each row [n] (s), its number where there are no times; and
    what the tip usually takes for a step (m), nan in a log of few steps."""
    depth = progress_of(log)
    clock = log.time if np.isfinite(log.time).all() else np.arange(float(len(depth)))
    places, rows = np.unique(depth, return_index=True)
    at = np.arange(depth[0], depth[-1], width)
    spent = np.diff(np.interp(at, places, clock[rows]))
    return clock, float(np.median(spent)) if len(spent) >= FEWEST else np.nan


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
    measured = suction_in(bins, expected)
    ratios = {
        "weight": (np.nanmax(log.weight, initial=0.0) / expected.weight, FAR_WEIGHT),
    }
    what = "resistance" if np.isfinite(log.resistance).any() else "suction"
    ratios[what] = float(np.median(bins.resistance / best)), FAR
    if is_clear.any() and np.isfinite(log.suction).any():
        ratio = float(np.median(measured[is_clear] / ahead[is_clear]))
        ratios["suction"] = ratio, FAR_SUCTION
    for name, (ratio, far) in ratios.items():
        # before any suction a crane may hold most of a weight
        least = 0.0 if name == "weight" and not is_pumped(log) else 1 / far
        if ratio > 0 and not least < ratio < far:
            raise InputError(
                f"{path}: the {name} is {ratio:.2g} times that of the run, which no"
                f" ground explains; check the unit of the {name}, the weight of the"
                " scene, and whether the log is of this caisson"
            )


def disagreement(log: Log, expected: Expected) -> float:
    """Return how far a measured resistance is from suction and weight, as a share of
    the latter; 0 where a log does not have both, or where they agree."""
    driving = log.suction * expected.area + weights_of(log, expected)
    ratio = log.resistance / driving
    ratio = ratio[np.isfinite(ratio) & (log.suction > 0)]
    share = float(np.median(ratio)) - 1 if len(ratio) else 0.0
    return share if abs(share) > AGREE else 0.0
