# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of cone penetration tests: the only reader of them, with one set of rules.

A file is GEF, AGS 4 or BRO-XML (caisson.design.cone_formats), a table of text or a
workbook (cone_grid), which its content tells and not its name. Numbers have a decimal
point, or all of them a decimal comma. What a cone cannot have measured is left out and
counted where it is little, and refused in a line where it is much.
"""
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson import disk
from caisson.design import cone_formats, cone_grid
from caisson.disk import InputError
from caisson.terminal import printable
from caisson.design.cone_options import How
from caisson.design.cone_rules import RANGES, Readings
from caisson.design.cone_table import cell_of, COMMA, refuse, Rows, Table, value_of
from caisson.design.cone_words import NEEDED, QUANTITIES
from caisson.design.quantity import NUMBER, parts_of, value_of as quantity_of

EVERY = ("depth", "qc", "fs", "u2", "rf")  # the last in place of fs
DEEPEST_WATER = 5000.0  # m
ARCHIVE = b"PK\x03\x04"  # a workbook begins with


class Test(NamedTuple):
    """A test: depth (m), cone resistance, sleeve friction and pore pressure (Pa), [n]
    each, the last two None where the file has none; what was not read, in words; the
    net area ratio of the cone, None where the file has none; the depth (m) above which
    rows were not measured, with how they are known ("ASSUMED" or "GIVEN"); whether the
    resistance is q_t, which has the pore pressure in it; top and bottom (m) of the gaps
    between rows; and whether readings were set to 0 on deck, and are no more."""

    depth: np.ndarray
    resistance: np.ndarray
    friction: np.ndarray | None
    pore_pressure: np.ndarray | None
    remarks: tuple[str, ...]
    area_ratio: float | None = None
    measured_from: float = 0.0
    above: str = ""
    is_corrected: bool = False
    gaps: tuple[tuple[float, float], ...] = ()
    was_zeroed: bool = False


# ---------------------------------------------------------------- the table


def content_of(path: Path) -> bytes:
    """Return what is in a file. Raises InputError."""
    if path.is_char_device():
        raise InputError(f"{path} cannot be read as a cone test: it is a device")
    return disk.read_bytes(path)


def lines_of(path: Path, content: bytes) -> list[str]:
    """Return the printable lines of a text: in UTF-8, or as Western European programs
    write it. Raises InputError."""
    if content.startswith(b"\xd0\xcf\x11\xe0"):
        raise InputError(
            f"{path} is a workbook of an old form (.xls): save it as .xlsx or CSV"
        )
    if b"\0" in content:
        raise InputError(
            f"{path} cannot be read as a cone test: it is no text, or in UTF-16; save"
            " it as CSV in UTF-8"
        )
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = content.decode("latin-1")
    return [printable(line) for line in text.splitlines()]


def refuse_options(path: Path, how: How, allowed: str, form: str) -> None:
    """Refuse options that do not belong to the form of a file. Raises InputError."""
    for name in ("location", "sheet", "columns"):
        if getattr(how, name) and name not in allowed:
            of = {"location": "AGS 4 and BRO-XML", "sheet": "workbooks (.xlsx)"}
            raise InputError(
                f"--{name} is for {of.get(name, 'tables')}; {path} is {form}"
            )


def table_of(path: Path, wanted: list[str], how: How) -> Table:
    """Return the table of a file. Raises InputError."""
    content = content_of(path)
    if content.startswith(ARCHIVE):
        rows = cone_grid.grid_of_workbook(path, how.sheet, bool(how.columns))
        return table_of_grid(path, rows, None, wanted, how, "a workbook")
    lines = lines_of(path, content)
    if cone_formats.is_ags(lines):
        refuse_options(path, how, "location", "AGS 4")
        groups = cone_formats.ags_groups(path, lines)
        return cone_formats.ags(path, groups, wanted, how.location)
    if cone_formats.is_xml(lines):
        refuse_options(path, how, "location", "XML")
        return cone_formats.bro(path, lines, wanted, how.location)
    if cone_formats.is_gef(lines):
        refuse_options(path, how, "", "GEF")
        return cone_formats.gef(path, lines, wanted)
    grid, divider = cone_grid.grid_of_text(lines)
    return table_of_grid(path, grid, divider, wanted, how, "a table of text")


def table_of_grid(
    path: Path, rows: Rows, divider: str | None, wanted: list[str], how: How, form: str
) -> Table:
    """Return the table of rows of cells, which may be the group SCPT of AGS 4. form:
    of the file, in words. Raises InputError."""
    sheet = "sheet " if form == "a workbook" else ""
    if not how.columns and cone_formats.is_ags_group(rows):
        refuse_options(path, how, f"{sheet}location", f"{form} with a group of AGS 4")
        group, said = cone_formats.group_of_table(rows)
        found = cone_formats.ags(path, {"SCPT": group}, wanted, how.location)
        found.remarks += said
        return found
    refuse_options(path, how, f"{sheet}columns", form)
    return cone_grid.table(path, rows, divider, wanted, how.columns)


def is_plain(path: Path, how: How = How()) -> bool:
    """Return whether a file is a table of text that begins with its heads, so that any
    command reads it without an option."""
    content = content_of(path)
    if how.is_said or content.startswith(ARCHIVE):
        return False
    lines = lines_of(path, content)
    forms = cone_formats.is_ags, cone_formats.is_xml, cone_formats.is_gef
    if any(form(lines) for form in forms):
        return False
    rows = cone_grid.grid_of_text(lines)[0]
    if cone_formats.is_ags_group(rows) or cone_grid.heads_in(rows) != 0:
        return False
    try:
        return not read(path).was_zeroed
    except InputError:  # of a column that is not needed
        return True


# --------------------------------------------------------------- the values


def wrong_in(cells: list[str], has_points: bool) -> str:
    """Return what is wrong with the numbers of a row, "" for nothing. has_points:
    numbers of the file have a decimal point, so that a comma is none."""
    for text in cells:
        if has_points and COMMA.fullmatch(text):
            return (
                f"{text!r} has a comma where other rows have a decimal point; write all"
                " numbers with a point"
            )
        try:
            value_of(text)
        except ValueError:
            return f"{text!r} is no number; leave a cell empty that has no value"
    return ""


def rows_of_numbers(path: Path, table: Table) -> Rows:
    """Return the rows without lines of text, as heads on a new page or "End of test",
    which are named. Raises InputError."""
    places = [column.place for column in table.columns.values()]
    depth = table.columns.get("depth") or table.columns["rods"]
    depths = [cell_of(cells, depth.place) for _, cells in table.rows]
    end = max((i for i, x in enumerate(depths) if cone_grid.is_number(x)), default=-1)

    def is_text(i: int) -> bool:
        texts = [cell_of(table.rows[i][1], place) for place in places]
        if i > end and wrong_in(depths[i : i + 1], False):
            return True
        return any(texts) and not any(re.match(r"[+-]?[.,]?\d", x) for x in texts)

    words = [i for i in range(len(table.rows)) if is_text(i)]
    if words:
        row, cells = table.rows[words[0]]
        table.remarks.append(
            f"lines of text between and below the rows, left out: {len(words)}, the"
            f" first is row {row}, {' '.join(cells).strip()[:40]!r}"
        )
    left_out = set(words)
    kept = [row for i, row in enumerate(table.rows) if i not in left_out]
    if len(kept) < 2:
        raise InputError(
            f"{path}: a cone test needs two rows with a depth and a cone resistance;"
            f" there are {len(kept)}"
        )
    return kept


def numbers_of(path: Path, table: Table) -> Readings:
    """Return the numbers of a table in m and Pa, nan for none. Raises InputError."""
    rows = rows_of_numbers(path, table)
    columns = table.columns.values()
    texts = [[cell_of(cells, column.place) for column in columns] for _, cells in rows]
    has_points = any("." in text for row in texts for text in row)
    wrong = [
        (row, why)
        for (row, _), cells in zip(rows, texts)
        if (why := wrong_in(cells, has_points))
    ]
    refuse(path, wrong)
    values = [[value_of(text) for text in cells] for cells in texts]
    with np.errstate(over="ignore"):  # what is too large is refused in a moment
        array = np.array(values) * [column.unit for column in columns]
    number = np.array([row for row, _ in rows])
    pushes = np.zeros(len(rows), dtype=int)
    if table.pushes:
        names = list(dict.fromkeys(table.pushes))
        by_row = dict(zip((row for row, _ in table.rows), table.pushes))
        pushes = np.array([names.index(by_row[row]) for row, _ in rows])
    return Readings(path, table, number, dict(zip(table.columns, array.T)), pushes)


def above_of(text: str) -> dict[str, float]:
    """Return the values (Pa) that --above gives. Raises InputError."""
    found: dict[str, float] = {}
    try:
        for part in parts_of(text):
            name, _, value = (word.strip() for word in part.partition("="))
            if name not in ("qc", "fs") or name in found:
                raise ValueError(f"{name!r} is neither qc nor fs")
            found[name] = quantity_of(value, "Pa")
            if found[name] and re.fullmatch(NUMBER, value):
                unit = "MPa" if name == "qc" else "kPa"
                raise ValueError(f"{value!r} has no unit: {value} {unit}?")
            if not 0 <= found[name] <= RANGES[name][1]:
                raise ValueError(f"{value!r} is no {QUANTITIES[name].name}")
        if text and "qc" not in found:
            raise ValueError("qc is missing")
    except ValueError as error:
        raise InputError(
            f'--above {text!r}: {error}; write --above "qc = 2 MPa, fs = 20 kPa"'
        ) from error
    return found


def depth_of_water(text: str) -> float | None:
    """Return the depth (m) that --zeroed-on-deck gives, None for none. Raises
    InputError."""
    try:
        found = quantity_of(text, "m") if text else None
        if found is not None and not 0 <= found <= DEEPEST_WATER:
            raise ValueError(f"{text!r} is no depth of water")
    except ValueError as error:
        raise InputError(f"--zeroed-on-deck: {error}; write 20m") from error
    return found


@disk.reads
def read(path: Path, with_friction: bool = True, how: How = How()) -> Test:
    """Return the test of a file. Without friction only depth and q_c are read, and
    nothing else is looked at. Raises InputError, with the row."""
    table = table_of(path, list(EVERY if with_friction else NEEDED), how)
    found = numbers_of(path, table)
    found.check_units()
    found.make_depths()
    found.turn_round()
    found.make_friction()
    found.join_pushes()
    found.leave_out_hole()
    found.leave_out_values()
    found.leave_out_no_load()
    found.check_order()
    found.check_ranges()
    ratio = how.area_ratio or table.facts.area_ratio
    was_zeroed = found.zero_at_mudline(depth_of_water(how.zeroed_on_deck), ratio)
    found.complete_friction()
    found.complete_pressure()
    gaps = found.gaps()
    start, above = found.reach_up(above_of(how.above))
    found.say_rest()
    values = found.values
    return Test(
        values["depth"],
        values["qt" if "qt" in values else "qc"],
        values.get("fs"),
        values.get("u2"),
        tuple(dict.fromkeys(found.remarks)),
        table.facts.area_ratio,
        start,
        above,
        "qt" in values,
        gaps,
        was_zeroed,
    )


def text_of(test: Test) -> str:
    """Return a test as a table of text, with nothing that needs an option."""
    head = "qt_kPa" if test.is_corrected else "qc_kPa"
    columns = {
        "depth_m": test.depth,
        head: test.resistance / 1e3,
        "fs_kPa": None if test.friction is None else test.friction / 1e3,
        "u2_kPa": None if test.pore_pressure is None else test.pore_pressure / 1e3,
    }
    there = {name: values for name, values in columns.items() if values is not None}
    rows = [",".join(f"{x:.8g}" for x in row) for row in zip(*there.values())]
    return "\n".join([",".join(there), *rows, ""])
