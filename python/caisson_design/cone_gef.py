# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests in GEF, the Dutch Geotechnical Exchange Format (GEF-CPT-Report).

A file begins with lines #KEY = VALUE: #COLUMNINFO has number, unit, name and quantity
of a column, #COLUMNVOID what stands where a column has no value, and #COLUMNSEPARATOR
and #RECORDSEPARATOR what divides cells (default: blanks) and ends rows (default: the
line). The table begins below #EOH.
"""
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from caisson_design import InputError
from caisson_design.cone_table import NAMES, NEEDED, Column, Table, unit_of

AREA_RATIO = 3  # of #MEASUREMENTVAR

# the numbers of quantities; the first one that a file has counts. 11 is the depth,
# corrected for the inclination, and 1 the length of the rods
QUANTITIES = {"depth": (11, 1), "qc": (2,), "fs": (3,), "u2": (6,)}
Heads = list[tuple[int, str, list[str]]]  # row, key and value, divided at its commas


def is_in(lines: Sequence[str]) -> bool:
    """Return whether the lines of a file are in GEF."""
    return any(re.match(r"#\s*(GEFID|COLUMNINFO)\b", line, re.I) for line in lines)


def heads_of(path: Path, lines: Sequence[str]) -> tuple[Heads, int]:
    """Return the lines above the table, and the number of the last one. Raises
    InputError."""
    found: Heads = []
    for row, line in enumerate(lines, 1):
        match = re.match(r"#\s*(\w+)\s*=?(.*)", line)
        if not match:
            continue
        key, value = match[1].upper(), match[2]
        if key == "EOH":
            return found, row
        found.append((row, key, [part.strip() for part in value.split(",")]))
    raise InputError(f"{path}: there is no line #EOH=, below which the table begins")


def place_of(text: str) -> int:
    """Return the place of a column, from 0, by its number, from 1. Raises
    ValueError."""
    number = int(text)
    if number < 1:
        raise ValueError(f"the first column has the number 1, not {number}")
    return number - 1


def decimal_of(parts: Sequence[str]) -> float:
    """Return the number at the beginning of a value that was divided at its commas, one
    of which may be a decimal comma. Raises ValueError or IndexError."""
    has_comma = len(parts) > 1 and re.fullmatch(r"[+-]?\d+", parts[0])
    if has_comma and re.fullmatch(r"\d+([eE][+-]?\d+)?", parts[1]):
        return float(f"{parts[0]}.{parts[1]}")
    return float(parts[0])


class Info(NamedTuple):
    """A line #COLUMNINFO: its row, and place, unit, name and quantity of a column."""

    row: int
    place: int
    unit: str
    name: str
    quantity: int


def infos_of(path: Path, heads: Heads) -> list[Info]:
    """Return what the file says of its columns. Raises InputError."""
    found: list[Info] = []
    for row, key, value in heads:
        if key != "COLUMNINFO":
            continue
        try:
            unit, name = value[1], ", ".join(value[2:-1])
            found.append(Info(row, place_of(value[0]), unit, name, int(value[-1])))
        except (ValueError, IndexError) as error:
            raise InputError(
                f"{path}, row {row}: #COLUMNINFO must have number (from 1), unit, name"
                f" and quantity of a column; it is {', '.join(value)!r}"
            ) from error
    return found


def columns_of(
    path: Path, infos: Sequence[Info], wanted: Sequence[str], filled: set[int]
) -> dict[str, Column]:
    """Return the columns of the quantities that are wanted and there. filled: places of
    columns with values in most rows, which come first. Raises InputError."""
    found = {}
    for name in wanted:
        numbers = QUANTITIES[name]
        some = [i for number in numbers for i in infos if i.quantity == number]
        some.sort(key=lambda info: info.place not in filled)
        if not some and name in NEEDED:
            text = " or ".join(map(str, numbers))
            raise InputError(
                f"{path}: no #COLUMNINFO has the quantity {text}, the {NAMES[name]}"
            )
        if len(some) > 1 and some[1].quantity == some[0].quantity:
            raise InputError(
                f"{path}, row {some[1].row}: a second column of the quantity"
                f" {some[1].quantity}, {some[1].name!r}; leave out one"
            )
        if some:
            info = some[0]
            unit = unit_of(path, info.row, repr(info.name), name, info.unit)
            found[name] = Column(info.place, unit)
    return found


def voids_of(path: Path, heads: Heads) -> dict[int, float]:
    """Return what stands in a column, by its place, where it has no value. Raises
    InputError."""
    found = {}
    for row, key, value in heads:
        if key == "COLUMNVOID":
            try:
                found[place_of(value[0])] = decimal_of(value[1:])
            except (ValueError, IndexError) as error:
                raise InputError(
                    f"{path}, row {row}: #COLUMNVOID must have the number of a column,"
                    f" from 1, and a number; it is {', '.join(value)!r}"
                ) from error
    return found


def area_ratio_of(heads: Heads) -> float | None:
    """Return the net area ratio of the cone, None where the file has none."""
    for _, key, value in heads:
        if key == "MEASUREMENTVAR" and value[0] == str(AREA_RATIO):
            try:
                return decimal_of(value[1:])
            except (ValueError, IndexError):
                return None
    return None


def separator_of(lines: Sequence[str], key: str) -> str:
    """Return what divides cells or ends rows, "" where nothing is said."""
    for line in lines:
        if match := re.match(rf"#\s*{key}\s*=\s*(\S*)", line, re.I):
            return match[1]
    return ""


def is_void(text: str, void: float | None) -> bool:
    """Return whether a cell has no value."""
    try:
        value = float(text.replace(",", "."))
        return void is not None and abs(value - void) <= 1e-6 * abs(void)
    except ValueError:
        return False


def table_of(path: Path, lines: Sequence[str], wanted: Sequence[str]) -> Table:
    """Return the table of a file. Raises InputError."""
    heads, last = heads_of(path, lines)
    for row, key, value in heads:
        if key in ("REPORTCODE", "PROCEDURECODE") and "BORE" in value[0].upper():
            raise InputError(
                f"{path}, row {row}: {value[0]} is a borehole, no cone test"
            )
    infos, voids = infos_of(path, heads), voids_of(path, heads)
    if not infos:
        raise InputError(f"{path}: no line #COLUMNINFO says what a column is")
    divider = separator_of(lines[:last], "COLUMNSEPARATOR") or None
    end = separator_of(lines[:last], "RECORDSEPARATOR")
    n_cells = max(info.place for info in infos) + 1
    rows = []
    for row, line in enumerate(lines[last:], last + 1):
        for record in line.split(end) if end else [line]:
            if not record.strip():
                continue
            record = record.strip().removesuffix(divider or "\n")
            cells = [cell.strip() for cell in record.split(divider)]
            for place, void in voids.items():
                if place < len(cells) and is_void(cells[place], void):
                    cells[place] = ""
            rows.append((row, cells))
    count = Counter(i for _, cells in rows for i, cell in enumerate(cells) if cell)
    filled = {place for place, number in count.items() if number > len(rows) / 2}
    columns = columns_of(path, infos, wanted, filled)
    places = {column.place for column in columns.values()}
    unread = tuple(info.name for info in infos if info.place not in places)
    return Table(
        columns,
        rows,
        n_cells,
        unread,
        "#COLUMNINFO",
        "each column needs a line #COLUMNINFO",
        may_be_empty=True,
        area_ratio=area_ratio_of(heads),
    )
