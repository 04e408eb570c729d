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
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson.design import cone_file, cone_grid
from caisson.design.cone_table import Rows, cell_of, is_number, value_of
from caisson.design.cone_words import BRACKETS, LENGTH, STRESS, plain
from caisson.disk import InputError
from caisson.log.expected import Expected
from caisson.log.forecast import LEAST_NOISE, Bins
from caisson.terminal import printable

FORCE = {"n": 1e-3, "kn": 1.0, "mn": 1e3, "t": 9.81}
HOUR = 3600.0
FLOW = {"m3/h": 1.0, "m3/s": HOUR, "l/s": 3.6, "l/min": 0.06, "m3/min": 60.0}


class Quantity(NamedTuple):
    """A column: its units as factors, that without one ("" for none: it is refused),
    and its names without blanks."""

    units: dict[str, float]
    usual: str
    words: str


QUANTITIES = {
    "time": Quantity(
        {"s": 1.0, "sec": 1.0, "min": 60.0, "h": HOUR, "d": 24 * HOUR},
        "s",
        "time t clock timestamp datetime date utc elapsedtime",
    ),
    "depth": Quantity(
        LENGTH, "m", "depth z penetration tipdepth embedment skirtpenetration"
    ),
    "suction": Quantity(
        {**{k: v / 1e3 for k, v in STRESS.items()}, "mbar": 0.1},
        "",
        "suction s underpressure differentialpressure dp pressuredifference",
    ),
    "flow": Quantity(FLOW, "m3/h", "flow q pumpflow flowrate discharge"),
    "tilt": Quantity(
        {"deg": 1.0, "degree": 1.0, "degrees": 1.0, "°": 1.0},
        "deg",
        "tilt inclination heel",
    ),
    "weight": Quantity(
        FORCE, "", "weight weightinwater submergedweight weightonsoil ballast"
    ),
    "resistance": Quantity(
        FORCE, "", "resistance penetrationresistance soilresistance totalresistance"
    ),
}
EXAMPLE = "time_s, depth_m, suction_kPa, flow_m3/h, tilt_deg, weight_kN"
SHARE = 0.01  # of the way: the length of a step
NEEDED = {"depth", "suction", "weight", "resistance"}  # if there, to be understood
LONG = 3.0  # times as long as its neighbors is a step with a stop
LEAST_SUCTION = 0.03  # of the largest one, below which the weight may hang on a crane
JUMP = 4.0  # times the scatter, by which a step is off
FEWEST = 3  # steps of a fit

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
    low = plain(text)
    inside = [re.sub(r"\s", "", unit) for unit in BRACKETS.findall(low)]
    words = re.findall(r"[a-z0-9/°]+", BRACKETS.sub(" ", low))
    for n in range(len(words), 0, -1):
        for quantity, known in QUANTITIES.items():
            if "".join(words[:n]) in known.words.split():
                ends = ["/".join(words[i:]) for i in range(n, len(words))]
                return quantity, [*inside, *ends]
    return "", []


def columns_of(path: Path, row: int, cells: Sequence[str]) -> tuple[Columns, list[str]]:
    """Return places and factor of each quantity that the heads in a row name, and the
    heads that are not read. Raises InputError where one that is needed has no unit."""
    found: Columns = {}
    unread = []
    for place, text in enumerate(cells):
        quantity, units = head_of(text)
        known = QUANTITIES[quantity].units if quantity else {}
        usual = QUANTITIES[quantity].usual if quantity else ""
        unit = next((u for u in units if u in known), "" if units else usual)
        if quantity == "time":
            places = found.get(quantity, ((), 1.0))[0]
            found[quantity] = (*places, place), known.get(unit, 1.0)
        elif unit and quantity not in found:
            found[quantity] = (place,), known[unit]
        elif quantity in NEEDED:
            what = (
                "is another one" if quantity in found else "has no unit that is known"
            )
            raise InputError(
                f"{path}, row {row}: the column {text.strip()!r} {what}; there is to be"
                f" one column of {quantity}, in one of {', '.join(known)}"
            )
        elif text.strip():
            unread.append(text.strip())
    return found, unread


def seconds_of(text: str, factor: float) -> float:
    """Return a time in s: a number, a date with a time of the day, or the latter.
    Raises ValueError."""
    try:
        return value_of(text) * factor
    except ValueError:
        day = text if re.search(r"\d[-T ]\d", text) else f"2000-01-01T{text}"
        when = datetime.datetime.fromisoformat(day.replace("Z", "+00:00"))
        return when.replace(tzinfo=when.tzinfo or datetime.timezone.utc).timestamp()


def rows_of(path: Path) -> tuple[Rows, int]:
    """Return the rows of a file, and the place of that with the heads. Raises
    InputError."""
    content = cone_file.content_of(path)
    if content.startswith(cone_file.ARCHIVE):
        rows = cone_grid.grid_of_workbook(path, "", True)
    else:
        rows = cone_grid.grid_of_text(cone_file.lines_of(path, content))[0]
    for i, (_, cells) in enumerate(rows):
        known = {head_of(cell)[0] for cell in cells if not is_number(cell)}
        if "depth" in known and known & {"suction", "resistance"}:
            return rows, i
    raise InputError(
        f"{path}: no row names a column of depth and one of suction or resistance; the"
        f" heads are to be as {EXAMPLE}"
    )


def read(path: Path) -> Log:
    """Return the log of a file. Raises InputError."""
    rows, head = rows_of(path)
    columns, unread = columns_of(path, *rows[head])
    needed = "suction" if "suction" in columns else "resistance"
    found, left_out = list[list[float]](), list[int]()
    for row, cells in rows[head + 1 :]:
        values = dict.fromkeys(QUANTITIES, np.nan)
        for name, (places, factor) in columns.items():
            text = " ".join(filter(None, (cell_of(cells, i) for i in places)))
            with contextlib.suppress(ValueError):
                read_one = seconds_of if name == "time" and text else scaled
                values[name] = read_one(text, factor)
        if np.isfinite(values["depth"]) and np.isfinite(values[needed]):
            found.append(list(values.values()))
        else:
            left_out.append(row)
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
    return ordered(path, np.array(found), remarks)


def scaled(text: str, factor: float) -> float:
    """Return a number times a factor. Raises ValueError."""
    return value_of(text) * factor


def ordered(path: Path, table: np.ndarray, remarks: list[str]) -> Log:
    """Return the rows [n, quantities] in the order of time, without those that are
    repeated. Raises InputError where suction is negative."""
    filled = np.nan_to_num(table, nan=-np.inf)  # an empty cell is like another
    once = table[np.sort(np.unique(filled, axis=0, return_index=True)[1])]
    if len(once) < len(table):
        remarks.append(f"{len(table) - len(once)} repeated rows are left out")
    time = once[:, 0]
    order = np.argsort(time if np.isfinite(time).all() else once[:, 1], kind="stable")
    if np.isfinite(time).all() and (np.diff(time) < 0).any():
        remarks.append("rows were not in the order of time, and were sorted")
    columns = dict(zip(QUANTITIES, once[order].T))
    if np.nanmedian(columns["suction"]) < 0:
        raise InputError(
            f"{path}: the suction is negative in most rows; write by how much the"
            " pressure below the lid is under that outside, as a positive number"
        )
    return Log(**columns, remarks=tuple(map(printable, remarks)))


def progress_of(log: Log) -> np.ndarray:
    """Return the depth [n] that the tip has reached up to each row, without the noise
    of single readings."""
    if not np.isfinite(log.time).all() or len(log.depth) < 5:
        return log.depth
    ends = np.pad(log.depth, 2, mode="edge")
    middle = np.median(np.lib.stride_tricks.sliding_window_view(ends, 5), axis=1)
    return np.maximum.accumulate(middle)


def weight_of(log: Log, expected: Expected) -> float:
    """Return the weight in water (kN) at the end of a log, that of the scene where none
    is measured."""
    known = log.weight[np.isfinite(log.weight)]
    return float(known[-1]) if len(known) else expected.weight


def resistance_of(log: Log, expected: Expected) -> np.ndarray:
    """Return the resistance (kN) of each row [n]: that measured, or suction on the area
    inside and the weight, that of the scene where none is measured; nan where the
    weight alone may hang on a crane."""
    weight = np.where(np.isfinite(log.weight), log.weight, expected.weight)
    found = log.suction * expected.area + weight
    with np.errstate(invalid="ignore"):
        pulled = log.suction > LEAST_SUCTION * np.nanmax(
            np.append(log.suction, 0.0), initial=0.0
        )
    known = pulled | (np.isfinite(log.weight) & (log.suction >= 0))
    found = np.where(known, found, np.nan)
    found = np.where(np.isfinite(log.resistance), log.resistance, found)
    return np.where(found > 0, found, np.nan)


def bins_of(path: Path, log: Log, expected: Expected) -> Bins:
    """Return the log in steps of depth, without those that have a stop and those that
    are off from all around. Raises InputError where too little is left."""
    depth, force = progress_of(log), resistance_of(log, expected)
    width = SHARE * expected.planned
    number = np.floor(depth / width).astype(int)
    inside = np.isfinite(force) & (depth >= expected.depth[0])
    inside &= depth <= expected.depth[-1]
    found, times = list[tuple[float, float, float]](), list[float]()
    for k in np.unique(number[inside]):
        rows = inside & (number == k)
        logs = np.log(force[rows])
        middle = float(np.median(logs))
        scatter = 1.86 * float(np.median(np.abs(logs - middle))) / np.sqrt(len(logs))
        error = max(LEAST_NOISE, scatter) if len(logs) > 2 else 2 * LEAST_NOISE
        found.append((float(np.mean(depth[rows])), float(np.exp(middle)), error))
        times.append(float(np.ptp(log.time[number == k])))
    some = np.array(found).reshape(-1, 3)
    keep = ~has_stop(np.array(times)) & ~is_off(some)
    if keep.sum() < FEWEST:
        last = depth.max()
        raise InputError(
            f"{path}: too few rows with suction lie between {expected.depth[0]:.3g} and"
            f" {expected.depth[-1]:.3g} m, where the runs are, for a fit (the log goes"
            f" to {last:.3g} m); it takes {FEWEST} steps of {width:.2g} m"
        )
    return Bins(*some[keep].T)


def neighbors(values: np.ndarray) -> np.ndarray:
    """Return the median of the values [n] within two places of each."""
    near = (values[max(i - 2, 0) : i + 3] for i in range(len(values)))
    return np.array([np.median(x) for x in near])


def has_stop(times: np.ndarray) -> np.ndarray:
    """Return which steps took much longer than those around. times: [n] (s), nan of a
    log without."""
    if not np.isfinite(times).all():
        return np.zeros(len(times), dtype=bool)
    return np.asarray(times > LONG * neighbors(times) + 1e-9)


def is_off(some: np.ndarray) -> np.ndarray:
    """Return which steps [n, 3] have a resistance far from those around."""
    if len(some) < 5:
        return np.zeros(len(some), dtype=bool)
    logs = np.log(some[:, 1])
    away = np.abs(logs - neighbors(logs))
    return np.asarray(away > JUMP * np.maximum(some[:, 2], np.median(away)))
