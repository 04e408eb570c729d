# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of cone penetration tests: the only reader of them.

A file is a table of text (caisson_design.cone_csv), AGS 4 (cone_ags) or GEF (cone_gef),
which its content tells and not its name. Numbers have a decimal point, or all of them a
decimal comma. What is wrong is reported for each row.
"""
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import isfinite, nan
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson_design import InputError, cone_ags, cone_csv, cone_gef, disk
from caisson_design.cone_table import NAMES, NEEDED, UNITS, Column, Table, refuse

# Pa; more and less than any test has
RANGES = {"qc": (0.0, 200e6), "fs": (0.0, 5e6), "u2": (-0.5e6, 20e6)}
WEAKEST = 20e3  # Pa; the largest resistance of a test is more
WEAK = 200e3  # Pa; less is doubtful
THOUSANDS = re.compile(r"[1-9]\d{0,2}([.,])\d{3}")  # 1,424 for 1424
WATER = 9.81e3  # N/m3, unit weight
SMOOTHEST = 2e-4  # f_s / q_c; the median of a test is more
HIGHEST_START = 1.0  # m, of the first row
DEEPEST = 200.0  # m
COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")  # a number with a decimal comma


class Test(NamedTuple):
    """A test: depth (m), cone resistance, sleeve friction and pore pressure (Pa), [n]
    each, the last two None where the file has none; what was not read, in words; and
    the net area ratio of the cone, None where the file has none."""

    depth: np.ndarray
    resistance: np.ndarray
    friction: np.ndarray | None
    pore_pressure: np.ndarray | None
    remarks: tuple[str, ...]
    area_ratio: float | None = None

    def down_to(self, deepest: float) -> "Test":
        """Return the rows down to a depth (m), at least two."""
        n = max(int(np.searchsorted(self.depth, deepest, "right")), 2)
        pressure = self.pore_pressure
        return self._replace(
            depth=self.depth[:n],
            resistance=self.resistance[:n],
            friction=None if self.friction is None else self.friction[:n],
            pore_pressure=None if pressure is None else pressure[:n],
        )


def number_of(text: str, unit: float, has_points: bool) -> float:
    """Return a cell in m or Pa. has_points: numbers of the file have a decimal point,
    so that a comma is none. Raises ValueError with what is wrong."""
    if COMMA.fullmatch(text):
        if has_points:
            raise ValueError(
                f"{text!r} has a comma where other rows have a decimal point; write all"
                " numbers with a point"
            )
        text = text.replace(",", ".")
    try:
        value = float(text)
    except ValueError:
        value = nan
    if not isfinite(value):
        raise ValueError(f"{text!r} is no number; leave out rows without one")
    return value * unit


def check_depth(z: float, above: float | None) -> None:
    """Refuse a depth that cannot be meant. above: that of the row before, None for the
    first, nan where all before are wrong. Raises ValueError."""
    if above is None and z < 0:
        raise ValueError(
            f"the test begins at a depth of {z:g} m; depth must be positive downward,"
            " from 0 at the mudline"
        )
    if above is None and z > HIGHEST_START:
        raise ValueError(
            f"the test begins at a depth of {z:g} m, so that nothing is known of the"
            " soil above, as after predrilling. The first row must be"
            f" {HIGHEST_START:g} m deep or less: add rows above it with the cone"
            " resistance to be expected there"
        )
    if above is not None and z <= above:
        raise ValueError(
            f"the depth of {z:g} m is not below that of the row before, {above:g} m"
        )
    if z > DEEPEST:
        raise ValueError(f"a depth of {z:g} m is no length in meters of a cone test")


def check_stresses(values: Mapping[str, float], units_are: str) -> None:
    """Refuse stresses (Pa) that cannot be meant. units_are: where the units stand.
    Raises ValueError."""
    for quantity, (low, high) in RANGES.items():
        value = values.get(quantity, low)
        if not low <= value <= high:
            raise ValueError(
                f"the {NAMES[quantity]} is {value / 1e6:g} MPa, which is not between"
                f" {low / 1e6:g} and {high / 1e6:g} MPa; check the unit in"
                f" {units_are}"
            )
    friction = values.get("fs", 0.0)
    if friction > values["qc"]:
        raise ValueError(
            f"the sleeve friction of {friction / 1e3:g} kPa is more than the cone"
            f" resistance of {values['qc'] / 1e3:g} kPa; check both units in"
            f" {units_are}"
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
    cells: Sequence[str], table: Table, above: float | None, has_points: bool
) -> dict[str, float]:
    """Return the values of a row in m and Pa. Raises ValueError."""
    if any(cell.strip() for cell in cells[table.n_cells :]):
        raise ValueError(
            f"{len(cells)} cells, and {table.n_cells} columns; {table.advice}"
        )
    values = {
        name: number_of(cell_of(cells, column), column.unit, has_points)
        for name, column in table.columns.items()
        if not (table.may_be_empty and name == "u2" and not cell_of(cells, column))
    }
    check_depth(values["depth"], above)
    check_stresses(values, table.units_are)
    return values


def cell_of(cells: Sequence[str], column: Column) -> str:
    """Return the text of a cell, "" for none."""
    return cells[column.place].strip() if column.place < len(cells) else ""


def lines_of(path: Path) -> list[str]:
    """Return the lines of a file: in UTF-8, or as Western European programs write it.
    Raises InputError."""
    content = disk.read_bytes(path)
    if content.startswith(b"PK") or b"\0" in content:
        raise InputError(
            f"{path} cannot be read as a cone test: it is no text, or in UTF-16; save"
            " it as CSV in UTF-8"
        )
    try:
        return content.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        return content.decode("latin-1").splitlines()


def table_of(path: Path, wanted: Sequence[str], location: str) -> Table:
    """Return the table of a file; location: of the test, where a file has several.
    Raises InputError."""
    lines = lines_of(path)
    if cone_ags.is_in(lines):
        return cone_ags.table_of(path, lines, wanted, location)
    if location:
        raise InputError(f"--location is for AGS 4, which {path} is not")
    if cone_gef.is_in(lines):
        return cone_gef.table_of(path, lines, wanted)
    return cone_csv.table_of(path, lines, wanted)


def is_a_table(path: Path) -> bool:
    """Return whether a file is a table of text, and not AGS or GEF."""
    lines = lines_of(path)
    return not (cone_ags.is_in(lines) or cone_gef.is_in(lines))


def with_values(path: Path, table: Table) -> tuple[Table, tuple[str, ...]]:
    """Return the rows and columns that have values, and in words those without any:
    cells may be empty in AGS and GEF. Raises InputError."""
    if not table.may_be_empty:
        return table, ()
    short = [(row, cells) for row, cells in table.rows if len(cells) < table.n_cells]
    refuse(
        path, [(n, f"{len(c)} cells, and {table.n_cells} columns") for n, c in short]
    )
    columns = {
        name: column
        for name, column in table.columns.items()
        if name in NEEDED or any(cell_of(cells, column) for _, cells in table.rows)
    }
    full: list[tuple[int, list[str]]] = []
    empty: list[tuple[int, list[str]]] = []
    for row, cells in table.rows:
        is_full = all(cell_of(cells, c) for name, c in columns.items() if name != "u2")
        (full if is_full else empty).append((row, cells))
    if len(full) < 2:
        raise InputError(
            f"{path}: a cone test needs two rows with a depth and a cone resistance;"
            f" there are {len(full)}"
        )
    found = [
        f"the column of {NAMES[name]} has no values"
        for name in table.columns
        if name not in columns
    ]
    if empty:
        text = ", ".join(str(row) for row, _ in empty[:5])
        found.append(
            f"rows without a value, which were left out: {len(empty)}, those of number"
            f" {text}{', ...' if len(empty) > 5 else ''}"
        )
    return replace(table, columns=columns, rows=full), tuple(found)


def refuse_thousands(path: Path, table: Table, largest: float) -> None:
    """Refuse cone resistances that are thousands with separators, which would be read
    as decimals. largest: of all (Pa), as read. Raises InputError."""
    column = table.columns["qc"]
    cells = [(row, cell_of(row_cells, column)) for row, row_cells in table.rows]
    divided = [(row, text) for row, text in cells if re.search("[.,]", text)]
    if column.unit >= 1e6 or not divided:
        return
    if not all(THOUSANDS.fullmatch(text) for _, text in divided):
        return
    has_hundreds = any(re.fullmatch(r"\d{3}", text) for _, text in cells)
    most = max(float(text.replace(",", ".")) for _, text in divided) * column.unit
    if most < WEAK and (largest < WEAK or has_hundreds):
        row, text = divided[0]
        raise InputError(
            f"{path}, row {row}: the cone resistance {text!r} seems to have a separator"
            f" of thousands, with which the largest one is {largest / 1e3:g} kPa: write"
            f" {re.sub('[.,]', '', text)}; if decimals are meant, write the column in"
            f" MPa. The unit is that in {table.units_are}"
        )


def with_hydrostatic(
    depth: np.ndarray, pressure: np.ndarray
) -> tuple[np.ndarray, tuple[str, ...]]:
    """Return the pore pressure (Pa) [n], hydrostatic where it is nan, and in words how
    often it is."""
    missing = np.isnan(pressure)
    if not missing.any():
        return pressure, ()
    return np.where(missing, WATER * depth, pressure), (
        f"rows without a pore pressure, which is taken as hydrostatic there:"
        f" {missing.sum()}, the first at {depth[missing][0]:g} m",
    )


def read(path: Path, with_friction: bool = True, location: str = "") -> Test:
    """Return the test of a file; location: which one of a file of AGS. Without friction
    only depth and q_c are read, and nothing else is looked at. Raises InputError, with
    the rows."""
    wanted = list(UNITS) if with_friction else list(NEEDED)
    table, remarks = with_values(path, table_of(path, wanted, location))
    texts = [cell_of(row, c) for _, row in table.rows for c in table.columns.values()]
    has_points = any("." in text for text in texts)
    found: dict[str, list[float]] = {name: [] for name in table.columns}
    wrong = []
    for place, (row, cells) in enumerate(table.rows):
        above = found["depth"][-1] if found["depth"] else nan if place else None
        try:
            values = row_of(cells, table, above, has_points)
        except ValueError as error:
            wrong.append((row, str(error)))
            continue
        for name, of_all in found.items():
            of_all.append(values.get(name, nan))
    refuse(path, wrong)
    arrays = {name: np.array(values) for name, values in found.items()}
    largest = float(arrays["qc"].max())
    refuse_thousands(path, table, largest)
    if largest < WEAKEST:
        raise InputError(
            f"{path}: the largest cone resistance is {largest:g} Pa, less than any soil"
            f" has; check the unit in {table.units_are}"
        )
    if largest < WEAK:
        remarks += (
            f"the largest cone resistance is only {largest / 1e3:g} kPa: check the unit"
            f" in {table.units_are}",
        )
    if "fs" in arrays:
        check_friction(path, arrays["fs"], arrays["qc"])
    if "u2" in arrays:
        arrays["u2"], said = with_hydrostatic(arrays["depth"], arrays["u2"])
        remarks += said
    if table.unread:
        remarks += (f"columns that were not read: {', '.join(table.unread)}",)
    return Test(
        arrays["depth"],
        arrays["qc"],
        arrays.get("fs"),
        arrays.get("u2"),
        remarks,
        table.area_ratio,
    )


def text_of(test: Test) -> str:
    """Return a test as a table of text."""
    columns = {
        "depth_m": test.depth,
        "qc_kPa": test.resistance / 1e3,
        "fs_kPa": None if test.friction is None else test.friction / 1e3,
        "u2_kPa": None if test.pore_pressure is None else test.pore_pressure / 1e3,
    }
    there = {head: values for head, values in columns.items() if values is not None}
    rows = [",".join(f"{x:.8g}" for x in row) for row in zip(*there.values())]
    return "\n".join([",".join(there), *rows, ""])
