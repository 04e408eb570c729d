# SPDX-License-Identifier: LGPL-2.1-or-later
"""The log of a vessel: a table of text or a workbook with a row for each reading.

Heads name a quantity and its unit, as depth_m, "suction (kPa)" or "pump flow [m3/h]".
Needed are the depth of the tip and the suction, or the resistance; time, flow, tilt and
the weight in water that rests on the soil are read where they are there. The cells are
those of a cone test: any divider, and a decimal point or comma.
"""
import contextlib
import datetime
import re
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.ndimage import median_filter

from caisson.design import cone_file, cone_grid
from caisson.design.cone_table import Rows, cell_of, is_number, value_of
from caisson.design.cone_words import BRACKETS, plain
from caisson import disk
from caisson.disk import InputError
from caisson.terminal import printable


class Quantity(NamedTuple):
    """A column: its units as factors, that without one ("" for none: it is refused),
    the unit that its numbers have here, and its names without blanks."""

    units: dict[str, float]
    usual: str
    unit: str
    words: str

    def factor(self, unit: str) -> float | None:
        """Return what numbers in a unit, in small letters, are multiplied by; None
        where it is not known."""
        return {plain(name): x for name, x in self.units.items()}.get(unit)


FILE = tomllib.loads(Path(__file__).with_name("quantities.toml").read_text("utf-8"))
UNITS = FILE.pop("units")
QUANTITIES = {k: Quantity(**q | {"units": UNITS[q["units"]]}) for k, q in FILE.items()}
EXAMPLE = "time_s, depth_m, suction_kPa, flow_m3/h, tilt_deg, weight_kN"
NEEDED = {"depth", "suction", "weight", "resistance"}  # if there, to be understood
AROUND = 9  # readings whose median is the level at the middle one
SPIKE = 3  # readings at most; a longer pulse is one of the pump or of the soil
JUMP = 2.0  # times all readings around, above which a few are a spike
END_JUMP = 4.0  # the same for the first and last, behind which no reading is normal
QUIET = 0.1  # of the usual level, below which the pump may have stopped
UPWARD = 2.0  # times the way up of the rows, by which an order of times is wrong
MOST = 1e12  # in the unit of a quantity, beyond which a number means none
# a day, and the time of the first one, on which clocks without dates count (s)
DAY, CLOCKS = 86400.0, datetime.datetime(2000, 1, 1, tzinfo=datetime.UTC).timestamp()
NAMED = 5  # spikes that are named one by one

# places of the cells, and what their numbers are multiplied by
Columns = dict[str, tuple[tuple[int, ...], float]]


class Log(NamedTuple):
    """The readings in the order of time, [n] each, nan where there is none: time (s),
    depth (m), suction (kPa), flow (m3/h), tilt (degrees), weight and resistance (kN);
    and what was left out, in words."""

    time: np.ndarray
    depth: np.ndarray
    suction: np.ndarray
    flow: np.ndarray
    tilt: np.ndarray
    weight: np.ndarray
    resistance: np.ndarray
    remarks: tuple[str, ...]


def head_of(text: str) -> tuple[str, list[str]]:
    """Return the quantity of a head, "" where it is not known, and what may be its
    unit: that in brackets, or the last words, as of flow_m3_h."""
    low = plain(text).replace("δ", "d").replace("∆", "d")
    inside = [re.sub(r"[^a-z0-9/°%]", "", unit) for unit in BRACKETS.findall(low)]
    words = re.findall(r"[a-z0-9/°]+", BRACKETS.sub(" ", low))
    for n in range(len(words), 0, -1):
        for quantity, known in QUANTITIES.items():
            if "".join(words[:n]) in known.words.split():
                ends = ["/".join(words[i:]) for i in range(n, len(words))]
                return quantity, [*filter(None, inside), *ends]
    return "", []


def columns_of(path: Path, row: int, cells: Sequence[str]) -> tuple[Columns, list[str]]:
    """Return places and factor of each quantity that the heads in a row name, and the
    heads that are not read. Raises InputError where one that is needed has no unit."""
    found: Columns = {}
    unread = []
    for place, text in enumerate(map(str.strip, cells)):
        name, units = head_of(text)
        if not name:
            unread += [text] if text else []
            continue
        quantity = QUANTITIES[name]
        usual = [] if units else [plain(quantity.usual)]
        factors = [quantity.factor(unit) for unit in (*units, *usual)]
        factor = next((x for x in factors if x is not None), None)
        if name == "time":
            places = found.get(name, ((), 1.0))[0]
            found[name] = (*places, place), factor or 1.0
        elif factor is not None and name not in found:
            found[name] = (place,), factor
        else:
            known = ", ".join(quantity.units)
            what = "has no unit that is known"
            if units:
                unit = units[0 if BRACKETS.search(text) else -1]
                what = f"has the unit {unit!r}, which is not known"
            what = "is another one" if factor is not None else what
            if name in NEEDED:
                raise InputError(
                    f"{path}, row {row}: the column {text!r} {what}; there is to be one"
                    f" column of {name}, in one of {known}"
                )
            unread.append(f"{text} ({what}; one of {name} in {known} is read)")
    return found, unread


def seconds_of(text: str, factor: float) -> float:
    """Return a time in s: a number, a date with a time of the day, or the latter.
    Raises ValueError."""
    try:
        return scaled(text, factor)
    except ValueError:
        day = text if re.search(r"\d[-T ]\d", text) else f"2000-01-01T{text}"
        when = datetime.datetime.fromisoformat(day.replace("Z", "+00:00"))
        return when.replace(tzinfo=when.tzinfo or datetime.timezone.utc).timestamp()


def rows_of(path: Path) -> tuple[Rows, int]:
    """Return the rows of a file, and the place of that with the heads. Raises
    InputError."""
    content = disk.read_bytes(path)
    if content.startswith(cone_file.ARCHIVE):
        rows = cone_grid.grid_of_workbook(path, "", True)
    else:
        rows = cone_grid.grid_of_text(cone_file.lines_of(path, content))[0]
    for i, (_, cells) in enumerate(rows):
        known = {head_of(cell)[0] for cell in cells if not is_number(cell)}
        if "depth" in known and known & {"suction", "resistance"}:
            return rows, i
    texts = (cells for _, cells in rows if not any(map(is_number, cells)))
    heads = next(texts, list[str]())
    there = f", only {', '.join(filter(None, heads))}" if any(heads) else ""
    raise InputError(
        f"{path}: no row names a column of depth and one of suction or resistance"
        f"{disk.one_line(there)[:200]}; the heads are to be as {EXAMPLE}, or suction as"
        " underpressure, vacuum, differential pressure or dp"
    )


@disk.reads
def read(path: Path) -> Log:
    """Return the log of a file. Raises InputError."""
    rows, head = rows_of(path)
    columns, unread = columns_of(path, *rows[head])
    needed = "suction" if "suction" in columns else "resistance"
    found, left_out, lost = list[list[float]](), list[int](), 0
    for row, cells in rows[head + 1 :]:
        values = dict.fromkeys(QUANTITIES, np.nan)
        for name, (places, factor) in columns.items():
            text = " ".join(filter(None, (cell_of(cells, i) for i in places)))
            with contextlib.suppress(ValueError):
                read_one = seconds_of if name == "time" and text else scaled
                values[name] = read_one(text, factor)
        if np.isfinite(values["depth"]) and np.isfinite(values[needed]):
            found.append(list(values.values()))
            lost = 0
        else:
            left_out.append(row)
            lost += int(np.isfinite(values["depth"]))
    if len(found) <= len(left_out):
        first = f"; the first is row {left_out[0]}" if left_out else ""
        raise InputError(
            f"{path}: {len(found)} rows have a number for depth and {needed}, and"
            f" {len(left_out)} have none{first}"
        )
    remarks = [f"columns that were not read: {', '.join(unread)}"] if unread else []
    if left_out:
        remarks.append(
            f"{len(left_out)} rows without depth and {needed} are left out; the first"
            f" is row {left_out[0]}"
        )
    if lost:
        remarks.append(
            f"the last {lost} rows have a depth, and no {needed} that is a number: is"
            " it out of the range of the gauge?"
        )
    return ordered(path, np.array(found), remarks)


def scaled(text: str, factor: float) -> float:
    """Return a number times a factor. Raises ValueError where it is none."""
    value = value_of(text) * factor
    if abs(value) > MOST:
        raise ValueError(f"{text} is no reading")
    return value


def past_midnight(time: np.ndarray) -> np.ndarray:
    """Return times [n] (s), where those of clocks without dates go on on the next day:
    a clock that is half a day and more behind the row above has passed midnight."""
    if not ((CLOCKS <= time) & (time < CLOCKS + DAY)).all():
        return time
    return time + DAY * np.cumsum(np.diff(time, prepend=time[0]) < -DAY / 2)


def started_anew(time: np.ndarray, depth: np.ndarray, remarks: list[str]) -> np.ndarray:
    """Return times [n] (s), which go on where a clock has started anew: where the tip
    goes down in the order of the rows, and not in that of their times."""
    back = np.diff(time, prepend=time[0]) < 0
    in_time = way_up(depth[np.argsort(time, kind="stable")])
    if not back.any() or in_time <= UPWARD * way_up(depth):
        return time
    remarks.append(
        f"the clock starts anew at {back.sum()} of the rows, which stay in the order of"
        " the file"
    )
    return time + np.cumsum(np.where(back, -np.diff(time, prepend=time[0]), 0.0))


def smooth(depth: np.ndarray) -> np.ndarray:
    """Return depths [n] (m) without the noise of single rows."""
    return depth if len(depth) < 5 else median_filter(depth, 5, mode="nearest")


def way_up(depth: np.ndarray) -> float:
    """Return how far depths [n] (m) go up from row to row in all."""
    return float(-np.diff(smooth(depth)).clip(max=0).sum())


def times_of(table: np.ndarray, remarks: list[str]) -> np.ndarray:
    """Return the times [n] (s) of rows, with those between for cells that are empty or
    not understood; nan of all where few are understood."""
    time = table[:, 0]
    known = np.flatnonzero(np.isfinite(time))
    if len(known) == len(time):
        return time
    if 2 * len(known) <= len(time):
        if len(known):
            remarks.append("times are not understood: rows count as the time")
        return np.full(len(time), np.nan)
    remarks.append(f"{len(time) - len(known)} times are between those of other rows")
    return np.interp(np.arange(len(time)), known, time[known])


def carried_on(values: np.ndarray) -> np.ndarray:
    """Return values [n] where an empty cell has the last one before it; nan before the
    first."""
    rows = np.maximum.accumulate(
        np.where(np.isfinite(values), np.arange(len(values)), -1)
    )
    return np.where(rows < 0, np.nan, values[rows])


def ordered(path: Path, table: np.ndarray, remarks: list[str]) -> Log:
    """Return the rows [n, quantities] in the order of time, without those that are
    repeated and without spikes; without times in their own order. Where the tip goes up
    along the rows, the last one is first. Raises InputError where suction or depth is
    negative."""
    if way_up(table[::-1, 1]) < way_up(table[:, 1]) / UPWARD:  # the last row first
        table = table[::-1]
    once = table.copy()
    once[:, 0] = times_of(table, remarks)
    if np.isfinite(once[:, 0]).all():
        filled = np.nan_to_num(once, nan=-np.inf)  # an empty cell is like another
        once = once[np.sort(np.unique(filled, axis=0, return_index=True)[1])]
        if len(once) < len(table):
            remarks.append(f"{len(table) - len(once)} repeated rows are left out")
        once[:, 0] = started_anew(past_midnight(once[:, 0]), once[:, 1], remarks)
        if (np.diff(once[:, 0]) < 0).any():
            remarks.append("rows were not in the order of time, and were sorted")
        once = once[np.argsort(once[:, 0], kind="stable")]
    elif way_up(once[:, 1]) > np.ptp(once[:, 1]) / 2:
        remarks.append(
            "rows without times were not in the order of depth, and were sorted"
        )
        once = once[np.argsort(once[:, 1], kind="stable")]
    columns = without_spikes(dict(zip(QUANTITIES, once.T)), remarks)
    columns["flow"] = np.abs(columns["flow"])
    columns["weight"] = carried_on(columns["weight"])
    suction = columns["suction"][np.isfinite(columns["suction"])]
    if len(suction) and np.median(suction) < 0:
        raise InputError(
            f"{path}: the suction is negative in most rows; write by how much the"
            " pressure below the lid is under that outside, as a positive number"
        )
    if np.median(columns["depth"]) < 0:
        raise InputError(
            f"{path}: the depth is negative in most rows; write how far the tip is"
            " below the seabed, as a positive number"
        )
    columns["tilt"] = tilt_of(*(columns.pop(x) for x in ("tilt", "pitch", "roll")))
    return Log(**columns, remarks=tuple(map(printable, remarks)))


def tilt_of(total: np.ndarray, pitch: np.ndarray, roll: np.ndarray) -> np.ndarray:
    """Return the tilt [n] (degrees): that measured, or the resultant of those about two
    axes, or the one about one axis; nan where there is none."""
    slopes = np.tan(np.radians([pitch, roll]))
    both = np.degrees(np.arctan(np.hypot(*slopes)))
    one = np.where(np.isfinite(pitch), pitch, roll)
    return np.where(np.isfinite(total), total, np.where(np.isfinite(both), both, one))


def level_of(values: np.ndarray) -> np.ndarray:
    """Return the median [n] of the AROUND values [n] about each of them; at the ends
    that of the first and the last ones."""
    width = min(AROUND, len(values) - 1 + len(values) % 2)
    windows = np.lib.stride_tricks.sliding_window_view(values, width)
    places = np.arange(len(values)) - width // 2
    return np.asarray(np.median(windows, axis=1)[places.clip(0, len(windows) - 1)])


def spikes_in(values: np.ndarray) -> np.ndarray:
    """Return which readings [n] in the order of time are spikes: a few ones that exceed
    all around them JUMP times, to whichever side, and behind which all is as before.

    A step or a ramp is none, as the level follows it. Where the pump rests, the level
    is the highest one of the log, or that of its pulses, so that a short pulse of the
    pump is no spike.
    """
    size, spikes = np.abs(values), np.zeros(len(values), dtype=bool)
    if len(size) < 2 * SPIKE - 1:
        return spikes
    level = level_of(size)
    usual, pulses = (
        float(np.median(x[x > 0])) if (x > 0).any() else 0.0 for x in (level, size)
    )
    level = np.where(level <= QUIET * usual, max(level.max(), pulses), level)
    off = size > JUMP * level + QUIET * usual
    edges = np.flatnonzero(np.diff(np.pad(off, 1).astype(int)))
    for begin, end in edges.reshape(-1, 2):
        first, last = begin == 0, end == len(size)
        near = slice(max(begin - AROUND // 2, 0), end + AROUND // 2)
        around = size[near][~off[near]].max(initial=float(level[begin]))
        if last:  # suction may rise for good
            around = max(around, float(level.max()) * JUMP / END_JUMP)
        jump = END_JUMP if first or last else JUMP
        is_short = end - begin <= min(SPIKE, (len(size) - 1) // 2)
        spikes[begin:end] = is_short and size[begin:end].min() > jump * around
    return spikes


def without_spikes(
    columns: dict[str, np.ndarray], remarks: list[str]
) -> dict[str, np.ndarray]:
    """Return columns [n] in the order of time, nan for a spike and without the rows of
    spikes in depth; what they were goes to the remarks."""
    depth, found = level_of(columns["depth"]), dict(columns)
    for name, values in columns.items():
        known = np.flatnonzero(np.isfinite(values))
        if name == "time" or not len(known):
            continue
        is_spike = spikes_in(values[known])
        if name == "suction":  # what rises at the end of a log may be a refusal
            is_spike[np.flatnonzero(~is_spike)[-1] + 1 :] = False
        spikes = known[is_spike]
        if not len(spikes):
            continue
        unit = QUANTITIES[name].unit
        texts = [f"{values[i]:.4g} {unit} at {depth[i]:.3g} m" for i in spikes[:NAMED]]
        more = f" and {len(spikes) - NAMED} more" if len(spikes) > NAMED else ""
        what = f"1 spike of {name} is" if len(spikes) == 1 else ""
        what = what or f"{len(spikes)} spikes of {name} are"
        remarks.append(f"{what} left out: {', '.join(texts)}{more}")
        found[name] = values.copy()
        found[name][spikes] = np.nan
    rows = np.isfinite(found["depth"])
    return {name: values[rows] for name, values in found.items()}
