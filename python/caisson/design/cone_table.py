# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a file of a cone penetration test comes to in any format: rows of text, and
columns that are quantities with units."""
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite, nan
from pathlib import Path
from typing import NamedTuple

from caisson.disk import InputError
from caisson.design.cone_words import CUSTOMARY, INSTEAD, LENGTH, NEEDED, QUANTITIES
from caisson.design.cone_words import unit_in

EMPTY = frozenset(("", "-", "--", "n/a", "#n/a", "na", "nan", "none", "null", "void"))
# what programs write where nothing was measured; no cone measures it in any unit
STRESSES = "Pa, kPa, MPa, kN/m2, MN/m2, N/mm2, bar, kgf/cm2, tsf, ksf or psi"
VOIDS = frozenset((-999.0, -999.25, -9999.0, -99999.0, -999999.0, -32768.0))
COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")  # a number with a decimal comma
Rows = list[tuple[int, list[str]]]  # the number of a row in the file, and its cells


class Head(NamedTuple):
    """A column as the file has it: its place, its name there, the quantity that this
    means ("" for none), its unit as written, and the row that says so."""

    place: int
    text: str
    quantity: str
    unit: str
    row: int


class Column(NamedTuple):
    """Where a quantity is, its unit in m or Pa, and its name in the file."""

    place: int
    unit: float
    text: str


class Facts(NamedTuple):
    """What a file says of the whole test: the net area ratio of the cone, and depths
    (m) of a hole above the test and of the water; None where it says nothing."""

    area_ratio: float | None = None
    predrilled: float | None = None
    water: float | None = None


@dataclass
class Table:
    """The rows of a test, and its columns by quantity.

    unread: heads that were not read; units_are: where the units stand; pushes: the name
    of the push of each row, where a test has several; is_sorted: whether the order of
    the rows is that of the depths.
    """

    columns: Mapping[str, Column]
    rows: Rows
    unread: tuple[str, ...]
    units_are: str
    facts: Facts = Facts()
    remarks: list[str] = field(default_factory=list)
    pushes: list[str] = field(default_factory=list)
    is_sorted: bool = True


def cell_of(cells: Sequence[str], place: int) -> str:
    """Return the text of a cell, "" for none."""
    text = cells[place].strip() if place < len(cells) else ""
    return "" if text.casefold() in EMPTY else text


def value_of(text: str) -> float:
    """Return a number with a decimal point or comma, nan of an empty cell and of one
    that stands for no value. Raises ValueError."""
    if not text:
        return nan
    value = float(text.replace(",", ".") if COMMA.fullmatch(text) else text)
    if not isfinite(value):
        raise ValueError(f"{text!r} is no number")
    return nan if value in VOIDS else value


def is_number(text: str) -> bool:
    """Return whether a cell is a number."""
    try:
        return isfinite(value_of(text.strip()))
    except ValueError:
        return False


def refuse(path: Path, wrong: Sequence[tuple[int, str]]) -> None:
    """Raise InputError with the first row that is wrong, and the numbers of others, if
    there are some."""
    if wrong:
        row, why = wrong[0]
        raise InputError(f"{path}, row {row}: {why}{more(wrong[1:])}")


def more(wrong: Sequence[tuple[int, str]]) -> str:
    """Return in words how many rows are wrong besides the first."""
    if not wrong:
        return ""
    rows = ", ".join(str(row) for row, _ in wrong[:4])
    dots = ", ..." if len(wrong) > 4 else ""
    rows_are = "row is" if len(wrong) == 1 else "rows are"
    return f" ({len(wrong)} more {rows_are} wrong: {rows}{dots})"


def unit_of(path: Path, head: Head) -> float:
    """Return the unit of a column in m or Pa. Raises InputError."""
    quantity = QUANTITIES[head.quantity]
    word = unit_in(head.unit)
    if word not in quantity.units:
        known = "m, cm, mm or ft" if quantity.units is LENGTH else STRESSES
        raise InputError(
            f"{path}, row {head.row}: the column {head.text!r}, the {quantity.name},"
            f" has no unit that is known, but {head.unit or 'none'!r}; write one of"
            f" {known}"
        )
    return quantity.units[word]


def columns_of(
    path: Path, heads: Sequence[Head], rows: Rows, wanted: Sequence[str], advice: str
) -> dict[str, Column]:
    """Return the columns of the quantities that are wanted and there. A quantity
    without values in most rows gives way to the one that may stand for it. advice: how
    the file would name depth and cone resistance. Raises InputError."""
    found: dict[str, Column] = {}
    for name in wanted:
        some = [h for h in heads if h.quantity == name]
        other = [h for h in heads if h.quantity == INSTEAD.get(name)]
        filled = [head for head in some or other if is_filled(rows, head.place)]
        if not filled and some and other and is_filled(rows, other[0].place):
            some = other
        some = filled or some or other
        known = [h for h in some if unit_in(h.unit) in QUANTITIES[h.quantity].units]
        metric = [head for head in known if unit_in(head.unit) not in CUSTOMARY]
        some = metric or known or some
        if name == "rf":  # only where it is needed, and can be read
            is_needed = "fs" not in found or not is_filled(rows, found["fs"].place)
            some = known[:1] if is_needed else []
        if len({(unit_in(h.unit), *column_cells(rows, h.place)) for h in some}) == 1:
            some = some[:1]  # the same twice, as beside results
        if len(some) > 1:
            raise InputError(
                f"{path}, row {some[1].row}: two columns are the"
                f" {QUANTITIES[some[0].quantity].name}, {some[0].text!r} and"
                f" {some[1].text!r}; leave out one"
            )
        if not some and name in NEEDED:
            raise InputError(
                f"{path}: no column is the {QUANTITIES[name].name}; {advice}"
            )
        for head in some:
            found[head.quantity] = Column(head.place, unit_of(path, head), head.text)
    for head in heads:  # the length of the rods checks a corrected depth
        is_known = head.quantity == "rods" and unit_in(head.unit) in LENGTH
        if is_known and "depth" in found:
            found["rods"] = Column(head.place, unit_of(path, head), head.text)
    return found


def column_cells(rows: Rows, place: int) -> list[str]:
    """Return the texts of a column."""
    return [cell_of(cells, place) for _, cells in rows]


def is_filled(rows: Rows, place: int) -> bool:
    """Return whether a column has values in most rows."""
    return sum(map(is_number, column_cells(rows, place))) > len(rows) / 2


def table_of(
    path: Path,
    heads: Sequence[Head],
    rows: Rows,
    wanted: Sequence[str],
    units_are: str,
    advice: str,
) -> Table:
    """Return the table of a file. Raises InputError."""
    columns = columns_of(path, heads, rows, wanted, advice)
    places = {column.place for column in columns.values()}
    unknown = [h for h in heads if h.place not in places and h.text]
    unread = tuple(h.text for h in unknown if h.quantity in ("", *wanted))
    return Table(columns, rows, unread, units_are)
