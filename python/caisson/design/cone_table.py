# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a file of a cone penetration test comes to in any format: rows of text, and
columns that are quantities with units; and their numbers.

What is wrong is said with the row, and naming() puts the name of the file before it.
"""
import contextlib
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf, isfinite, nan
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson.disk import InputError
from caisson.design.cone_words import CUSTOMARY, INSTEAD, LENGTH, NEEDED, QUANTITIES
from caisson.design.cone_words import unit_in

EMPTY = frozenset(("", "-", "--", "n/a", "#n/a", "na", "nan", "none", "null", "void"))
# what programs write where nothing was measured; no cone measures it in any unit
VOIDS = frozenset((-999.0, -999.25, -9999.0, -99999.0, -999999.0, -32768.0))
STRESSES = "Pa, kPa, MPa, kN/m2, MN/m2, N/mm2, bar, kgf/cm2, tsf, ksf or psi"
COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")  # a number with a decimal comma
BEGIN = re.compile(r"[+-]?[.,]?\d")  # of a number
Rows = list[tuple[int, list[str]]]  # the number of a row in the file, and its cells


class Head(NamedTuple):
    """A column as the file has it: its place, its name there, the quantity that this
    means ("" for none), its unit as written, and the row that says so."""

    place: int
    text: str
    quantity: str
    unit: str
    row: int

    @property
    def factor(self) -> float | None:
        """What its numbers are multiplied with for m or Pa, None if that is not
        known."""
        return QUANTITIES[self.quantity].units.get(unit_in(self.unit))


class Facts(NamedTuple):
    """What a file says of the whole test: the net area ratio of the cone, and depths
    (m) of a hole above the test and of the water; None where it says nothing."""

    area_ratio: float | None = None
    predrilled: float | None = None
    water: float | None = None


@dataclass
class Table:
    """The rows of a test, and its columns as the file has them.

    units_are: where the units stand; advice: how the file would name depth and cone
    resistance; pushes: the name of the push of each row, where a test has several;
    is_register: whether the rows have no order, and the columns always are the same;
    begins_with_heads: whether it is a text that does.
    """

    heads: Sequence[Head]
    rows: Rows
    units_are: str
    advice: str
    facts: Facts = Facts()
    remarks: list[str] = field(default_factory=list)
    pushes: Sequence[str] = ()
    is_register: bool = False
    begins_with_heads: bool = False


@contextlib.contextmanager
def naming(path: Path) -> Iterator[None]:
    """Put the name of a file before what is wrong with it, or with its row."""
    try:
        yield
    except InputError as error:
        link = ", " if str(error).startswith("row ") else ": "
        raise InputError(f"{path}{link}{error}") from error


def refuse(wrong: Sequence[tuple[int, str]]) -> None:
    """Raise InputError with the first row that is wrong, and the numbers of others, if
    there are some."""
    if not wrong:
        return
    (row, why), *others = wrong
    more = ""
    if others:
        rows = ", ".join(str(row) for row, _ in others[:4])
        rows_are = "row is" if len(others) == 1 else "rows are"
        dots = ", ..." if len(others) > 4 else ""
        more = f" ({len(others)} more {rows_are} wrong: {rows}{dots})"
    raise InputError(f"row {row}: {why}{more}")


# --------------------------------------------------------------- the cells


def cell_of(cells: Sequence[str], place: int) -> str:
    """Return the text of a cell, "" for none."""
    text = cells[place].strip() if place < len(cells) else ""
    return "" if text.casefold() in EMPTY else text


def value_of(text: str) -> float:
    """Return a number with a decimal point or comma, nan of an empty cell and of one
    that stands for no value. Raises ValueError."""
    if not text:
        return nan
    try:
        value = float(text.replace(",", ".") if COMMA.fullmatch(text) else text)
    except ValueError:
        value = inf
    if not isfinite(value):
        raise ValueError(f"{text!r} is no number; leave a cell empty that has no value")
    return nan if value in VOIDS else value


def is_number(text: str) -> bool:
    """Return whether a cell is a number."""
    try:
        return isfinite(value_of(text.strip()))
    except ValueError:
        return False


def lines_of_text(texts: Sequence[Sequence[str]], depth: int) -> list[int]:
    """Return the places of the rows of cells that are lines of text, as heads on a new
    page or "End of test". depth: the place of that."""
    numbers = (i for i, cells in enumerate(texts) if is_number(cells[depth]))
    end = max(numbers, default=-1)

    def is_text(i: int) -> bool:
        if i > end:
            try:
                value_of(texts[i][depth])
            except ValueError:
                return True
        return any(texts[i]) and not any(map(BEGIN.match, texts[i]))

    return [i for i in range(len(texts)) if is_text(i)]


def numbers_of(
    table: Table, columns: Mapping[str, Head]
) -> tuple[np.ndarray, dict[str, np.ndarray], np.ndarray]:
    """Return the rows of a table without lines of text, which are named: the number of
    each in the file, its values by quantity in m and Pa, nan for none, and the name of
    its push, [n] each. Raises InputError."""
    heads = columns.values()
    texts = [[cell_of(cells, head.place) for head in heads] for _, cells in table.rows]
    depth = "depth" if "depth" in columns else INSTEAD["depth"]
    words = lines_of_text(texts, [*columns].index(depth))
    if words:
        row, cells = table.rows[words[0]]
        table.remarks.append(
            f"lines of text between and below the rows, left out: {len(words)}, the"
            f" first is row {row}, {' '.join(cells).strip()[:40]!r}"
        )
    kept = sorted({*range(len(texts))} - {*words})
    if len(kept) < 2:
        raise InputError(
            "a cone test needs two rows with a depth and a cone resistance; there are"
            f" {len(kept)}"
        )
    has_points = any("." in text for i in kept for text in texts[i])
    values, wrong = list[list[float]](), list[tuple[int, str]]()
    for i in kept:
        comma = next(filter(COMMA.fullmatch, texts[i]), "")
        try:
            if comma and has_points:
                raise ValueError(
                    f"{comma!r} has a comma where other rows have a decimal point;"
                    " write all numbers with a point"
                )
            values.append(list(map(value_of, texts[i])))
        except ValueError as error:
            wrong.append((table.rows[i][0], str(error)))
    refuse(wrong)
    with np.errstate(over="ignore"):  # what is too large is refused in a moment
        array = np.array(values) * [head.factor for head in heads]
    row_of = np.array([table.rows[i][0] for i in kept])
    push = np.array([table.pushes[i] if table.pushes else "" for i in kept])
    return row_of, dict(zip(columns, array.T)), push


# ------------------------------------------------------------- the columns


def column_cells(rows: Rows, place: int) -> list[str]:
    """Return the texts of a column."""
    return [cell_of(cells, place) for _, cells in rows]


def columns_of(table: Table, wanted: Sequence[str]) -> dict[str, Head]:
    """Return the columns of the quantities that are wanted and there. A quantity
    without values in most rows gives way to the one that may stand for it. Raises
    InputError."""
    found: dict[str, Head] = {}
    cells = {
        h.place: column_cells(table.rows, h.place) for h in table.heads if h.quantity
    }
    most = len(table.rows) / 2
    filled = {
        place for place, texts in cells.items() if sum(map(is_number, texts)) > most
    }
    for name in wanted:
        some = [h for h in table.heads if h.quantity in (name, INSTEAD.get(name, name))]
        for is_better in (
            lambda h: h.place in filled,
            lambda h: h.quantity == name,
            lambda h: h.factor is not None,
            lambda h: unit_in(h.unit) not in CUSTOMARY,
        ):
            some = list(filter(is_better, some)) or some
        if name == "rf":  # only where it is needed, and can be read
            is_needed = "fs" not in found or found["fs"].place not in filled
            some = [h for h in some if is_needed and h.factor is not None][:1]
        if len({(unit_in(h.unit), *cells[h.place]) for h in some[1:] and some}) > 1:
            raise InputError(
                f"row {some[1].row}: two columns are the"
                f" {QUANTITIES[some[0].quantity].name}, {some[0].text!r} and"
                f" {some[1].text!r}; leave out one"
            )
        if not some and name in NEEDED:
            raise InputError(
                f"no column is the {QUANTITIES[name].name}; {table.advice}"
            )
        for head in some[:1]:  # others are the same, as beside results
            quantity = QUANTITIES[head.quantity]
            if head.factor is None:
                known = "m, cm, mm or ft" if quantity.units is LENGTH else STRESSES
                raise InputError(
                    f"row {head.row}: the column {head.text!r}, the {quantity.name},"
                    f" has no unit that is known, but {head.unit or 'none'!r}; write"
                    f" one of {known}"
                )
            found[head.quantity] = head
    rods = [h for h in table.heads if h.quantity == "rods" and h.factor is not None]
    if rods and "depth" in found:  # it checks a corrected depth
        found["rods"] = rods[-1]
    return found
