# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of cone penetration tests: the only reader of them.

A file is a table. Its first row names quantity and unit of each column: depth_m, qc_MPa
(cone resistance), fs_kPa (sleeve friction) and u2_kPa (pore pressure behind the cone),
also as "depth (m)" or "qc [MPa]"; stresses may be in Pa, kPa or MPa. Cells are divided
by commas, semicolons or tabs. Rows that are empty or begin with "#" are left out, but
count. What is wrong is reported for each row.
"""
import csv
import io
import re
from collections.abc import Mapping, Sequence
from math import isfinite, nan
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson_design import InputError


PASCAL = {"pa": 1.0, "kpa": 1e3, "mpa": 1e6}
UNITS: dict[str, Mapping[str, float]] = {
    "depth": {"m": 1.0},
    "qc": PASCAL,
    "fs": PASCAL,
    "u2": PASCAL,
}
HEADS = "depth_m and qc_MPa (or qc_kPa, qc_Pa)"
MORE_HEADS = "fs_kPa and u2_kPa (or in Pa or MPa)"
NAMES = {
    "qc": "cone resistance",
    "fs": "sleeve friction",
    "u2": "pore pressure",
}
# Pa; more and less than any test has
RANGES = {"qc": (0.0, 200e6), "fs": (0.0, 5e6), "u2": (-0.5e6, 20e6)}
WEAKEST = 20e3  # Pa; the largest resistance of a test is more
SMOOTHEST = 2e-4  # f_s / q_c; the median of a test is more
HIGHEST_START = 1.0  # m, of the first row
DEEPEST = 200.0  # m
MOST = 10  # rows that a message names


class Test(NamedTuple):
    """A test: depth (m), cone resistance, sleeve friction and pore pressure (Pa), [n]
    each, the last two None where the file has none; and the heads that were not read.
    """

    depth: np.ndarray
    resistance: np.ndarray
    friction: np.ndarray | None
    pore_pressure: np.ndarray | None
    unread: tuple[str, ...]

    def down_to(self, deepest: float) -> "Test":
        """Return the rows down to a depth (m), at least two."""
        n = max(int(np.searchsorted(self.depth, deepest, "right")), 2)
        return Test(
            self.depth[:n],
            self.resistance[:n],
            None if self.friction is None else self.friction[:n],
            None if self.pore_pressure is None else self.pore_pressure[:n],
            self.unread,
        )


class Column(NamedTuple):
    """Where a quantity is, and its unit in m or Pa."""

    place: int
    unit: float


def head_of(text: str) -> tuple[str, str]:
    """Return quantity and unit of a head such as depth_m, "qc (MPa)" or qc [kPa]."""
    words = re.findall(r"[a-z][a-z0-9]*", text.lower())
    return ("".join(words[:-1]), words[-1]) if words else ("", "")


def columns_of(
    path: Path, heads: Sequence[str], wanted: Sequence[str]
) -> dict[str, Column]:
    """Return the columns of the quantities that are wanted and there; depth and q_c
    must be there."""
    found: dict[str, Column] = {}
    for place, head in enumerate(heads):
        quantity, unit = head_of(head)
        # a head of one word is a quantity without a unit
        quantity, unit = (quantity, unit) if quantity else (unit, "")
        if quantity not in wanted:
            continue
        if unit not in UNITS[quantity] and quantity in NAMES and wanted[2:]:
            raise InputError(
                f"{path}: the column {head!r} has no unit that is known; columns that"
                f" are read are {HEADS}, {MORE_HEADS}"
            )
        if unit not in UNITS[quantity]:
            continue
        if quantity in found:
            raise InputError(
                f"{path}: two columns of {quantity}; the first row must name one column"
                f" of depth and one of cone resistance, {HEADS}; it is"
                f" {', '.join(heads)!r}"
            )
        found[quantity] = Column(place, UNITS[quantity][unit])
    if not {"depth", "qc"} <= set(found):
        raise InputError(
            f"{path}: the first row must name one column of depth and one of cone"
            f" resistance, {HEADS}; it is {', '.join(heads)!r}"
        )
    return found


def number_of(cells: Sequence[str], column: Column) -> float:
    """Return a cell in m or Pa. Raises ValueError with what is wrong."""
    text = cells[column.place].strip() if column.place < len(cells) else ""
    try:
        value = float(text)
    except ValueError:
        value = nan
    if not isfinite(value):
        raise ValueError(
            f"{text!r} is no number; write numbers with a point and leave out rows"
            " without one"
        )
    return value * column.unit


def check_depth(z: float, above: float | None) -> None:
    """Refuse a depth that cannot be meant. above: that of the row before, None for the
    first, nan where all before are wrong. Raises ValueError."""
    if above is None and not 0 <= z <= HIGHEST_START:
        raise ValueError(
            f"the test begins at a depth of {z:g} m; it must begin between 0 and"
            f" {HIGHEST_START:g} m, with depth positive downward"
        )
    if above is not None and z <= above:
        raise ValueError(
            f"the depth of {z:g} m is not below that of the row before, {above:g} m"
        )
    if z > DEEPEST:
        raise ValueError(f"a depth of {z:g} m is no length in meters of a cone test")


def check_stresses(values: Mapping[str, float]) -> None:
    """Refuse stresses (Pa) that cannot be meant. Raises ValueError."""
    for quantity, (low, high) in RANGES.items():
        value = values.get(quantity, low)
        if not low <= value <= high:
            raise ValueError(
                f"the {NAMES[quantity]} is {value / 1e6:g} MPa, which is not between"
                f" {low / 1e6:g} and {high / 1e6:g} MPa; check the unit in the first"
                " row"
            )
    friction = values.get("fs", 0.0)
    if friction > values["qc"]:
        raise ValueError(
            f"the sleeve friction of {friction / 1e3:g} kPa is more than the cone"
            f" resistance of {values['qc'] / 1e3:g} kPa; check both units in the first"
            " row"
        )


def check_friction(path: Path, friction: np.ndarray, resistance: np.ndarray) -> None:
    """Refuse a sleeve friction (Pa) [n] that is 0, or in another unit than its column
    says. Raises InputError."""
    ratio = float(np.median(friction / np.maximum(resistance, 1.0)))
    if ratio < SMOOTHEST:
        raise InputError(
            f"{path}: the sleeve friction is {100 * ratio:.2g} % of the cone resistance"
            " in the median, less than in any soil; check its unit, or leave the column"
            " out and give --soil and --unit-weight"
        )


def row_of(
    cells: Sequence[str],
    columns: Mapping[str, Column],
    n_heads: int,
    above: float | None,
) -> dict[str, float]:
    """Return the values of a row in m and Pa. Raises ValueError."""
    if any(cell.strip() for cell in cells[n_heads:]):
        raise ValueError(
            f"{len(cells)} cells, and {n_heads} in the first row; write numbers with a"
            " point, not with a comma"
        )
    values = {name: number_of(cells, column) for name, column in columns.items()}
    check_depth(values["depth"], above)
    check_stresses(values)
    return values


def cells_of(path: Path) -> list[tuple[int, list[str]]]:
    """Return the numbers and cells of all rows that count, the heads first."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(
            f"{path} cannot be read as a cone test: it is not in UTF-8; save it so"
        ) from error
    except OSError as error:
        raise InputError(f"{path} cannot be read as a cone test: {error}") from error
    lines = [
        (row, line)
        for row, line in enumerate(text.splitlines(), 1)
        if line.strip(" \t,;") and not line.startswith("#")
    ]
    if len(lines) < 3:
        raise InputError(
            f"{path}: a cone test needs a row of heads, {HEADS}, and two rows of"
            " numbers"
        )
    divider = next((mark for mark in ";\t" if mark in lines[0][1]), ",")
    found = csv.reader(
        io.StringIO("\n".join(line for _, line in lines)), delimiter=divider
    )
    return list(zip((row for row, _ in lines), found))


def refuse(path: Path, wrong: Sequence[tuple[int, str]]) -> None:
    """Raise InputError with all rows that are wrong, if there are some."""
    if not wrong:
        return
    texts = [f"{path}, row {row}: {why}" for row, why in wrong[:MOST]]
    if len(wrong) > MOST:
        rows = ", ".join(str(row) for row, _ in wrong[MOST : 3 * MOST])
        more = ", ..." if len(wrong) > 3 * MOST else ""
        texts.append(f"{path}: {len(wrong) - MOST} more rows are wrong: {rows}{more}")
    raise InputError("\n".join(texts))


def read(path: Path, with_friction: bool = True) -> Test:
    """Return the test of a file. Without friction only depth and q_c are read, and
    nothing else is looked at. Raises InputError, with the rows."""
    wanted = list(UNITS) if with_friction else ["depth", "qc"]
    heads, *rows = cells_of(path)
    columns = columns_of(path, heads[1], wanted)
    table: dict[str, list[float]] = {name: [] for name in columns}
    wrong = []
    for place, (row, cells) in enumerate(rows):
        above = table["depth"][-1] if table["depth"] else nan if place else None
        try:
            values = row_of(cells, columns, len(heads[1]), above)
        except ValueError as error:
            wrong.append((row, str(error)))
            continue
        for name, value in values.items():
            table[name].append(value)
    refuse(path, wrong)
    arrays = {name: np.array(values) for name, values in table.items()}
    if arrays["qc"].max() < WEAKEST:
        raise InputError(
            f"{path}: the largest cone resistance is {arrays['qc'].max():g} Pa, less"
            " than any soil has; check the unit in the first row"
        )
    if "fs" in arrays:
        check_friction(path, arrays["fs"], arrays["qc"])
    places = {column.place for column in columns.values()}
    unread = tuple(h.strip() for i, h in enumerate(heads[1]) if i not in places)
    return Test(
        arrays["depth"], arrays["qc"], arrays.get("fs"), arrays.get("u2"), unread
    )
