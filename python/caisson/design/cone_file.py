# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of cone penetration tests: the only reader of them, with one set of rules.

A file is GEF, AGS 4 or BRO-XML (caisson.design.cone_formats), a table of text or a
workbook (cone_grid), which its content tells and not its name. Numbers have a decimal
point, or all of them a decimal comma. What a cone cannot have measured is left out and
counted where it is little, and refused in a line where it is much.
"""
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from caisson import disk
from caisson.design import cone_formats, cone_grid
from caisson.disk import InputError
from caisson.terminal import printable
from caisson.design.cone_options import How
from caisson.design.cone_rules import RANGES, Readings
from caisson.design.cone_table import Rows, Table, naming
from caisson.design.cone_words import NEEDED, QUANTITIES
from caisson.design.quantity import NUMBER, parts_of, value_of

EVERY = ("depth", "qc", "fs", "u2", "rf")  # the last in place of fs
DEEPEST_WATER = 5000.0  # m
ARCHIVE = b"PK\x03\x04"  # a workbook begins with
# how a format begins, or a line of it, what reads it, and the option that it may have
FORMATS: dict[str, tuple[str, Callable[..., Table], str]] = {
    "AGS 4": (r'\A[\s"]*(GROUP"*,|\*\*)', cone_formats.ags_of_lines, "location"),
    "XML": (r"\A\s*<", cone_formats.bro, "location"),
    "GEF": (r'^[^\S\n]*"?#[^\S\n]*(GEFID|COLUMNINFO)\b', cone_formats.gef, ""),
}


@dataclass(frozen=True)
class Test:
    """A test: depth (m), cone resistance, sleeve friction and pore pressure (Pa), [n]
    each, the last two None where the file has none; what was not read, in words; the
    net area ratio of the cone, None where the file has none; the depth (m) above which
    rows were not measured, with how they are known ("ASSUMED" or "GIVEN"); whether the
    resistance is q_t, which has the pore pressure in it; top and bottom (m) of the gaps
    between rows; whether readings were set to 0 on deck, and are no more; and whether
    the file is a table of text that begins with its heads, so that any command reads it
    without an option."""

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
    is_plain: bool = False


# ---------------------------------------------------------------- the table


def lines_of(path: Path, content: bytes) -> list[str]:
    """Return the printable lines of a text: in UTF-8, or as Western European programs
    write it. Raises InputError."""
    if content.startswith(b"\xd0\xcf\x11\xe0"):
        raise InputError(
            f"{path} is a workbook of an old form (.xls): save it as .xlsx or CSV"
        )
    if b"\0" in content:
        raise InputError(
            f"{path} cannot be read as a table: it is no text, or in UTF-16; save it as"
            " CSV in UTF-8"
        )
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = content.decode("latin-1")
    return [printable(line) for line in text.splitlines()]


def refuse_options(how: How, allowed: str, form: str) -> None:
    """Refuse options that do not belong to the form of a file. Raises InputError."""
    of = {"location": "AGS 4 and BRO-XML", "sheet": "workbooks (.xlsx)"}
    for name in ("location", "sheet", "columns"):
        if getattr(how, name) and name not in allowed:
            raise InputError(
                f"--{name} is for {of.get(name, 'tables')}; the file is {form}"
            )


def format_of(lines: Sequence[str]) -> str:
    """Return the format of a text, "" for a table."""
    text = "\n".join(lines)
    every = (
        x for x, (begin, *_) in FORMATS.items() if re.search(begin, text, re.I | re.M)
    )
    return next(every, "")


def table_of(path: Path, content: bytes, how: How) -> Table:
    """Return the table of a file with this content. Raises InputError."""
    if content.startswith(ARCHIVE):
        rows = cone_grid.grid_of_workbook(path, how.sheet, bool(how.columns))
        with naming(path):
            found = table_of_grid(rows, None, how, "a workbook")
            found.begins_with_heads = False
            return found
    lines = lines_of(path, content)
    with naming(path):
        if form := format_of(lines):
            _, read_it, allowed = FORMATS[form]
            refuse_options(how, allowed, form)
            return read_it(lines, how.location)
        return table_of_grid(*cone_grid.grid_of_text(lines), how, "a table of text")


def table_of_grid(rows: Rows, divider: str | None, how: How, form: str) -> Table:
    """Return the table of rows of cells, which may be the group SCPT of AGS 4. form:
    of the file, in words. Raises InputError."""
    sheet = "sheet " if form == "a workbook" else ""
    group, said = cone_formats.group_of_table([] if how.columns else rows)
    if group:
        refuse_options(how, f"{sheet}location", f"{form} with a group of AGS 4")
        found = cone_formats.ags({"SCPT": group}, how.location)
        found.remarks += said
        return found
    refuse_options(how, f"{sheet}columns", form)
    return cone_grid.table(rows, divider, how.columns)


# --------------------------------------------------------------- the values


def above_of(text: str) -> dict[str, float]:
    """Return the values (Pa) that --above gives. Raises InputError."""
    found: dict[str, float] = {}
    try:
        for part in parts_of(text):
            name, _, value = (word.strip() for word in part.partition("="))
            if name not in ("qc", "fs") or name in found:
                raise ValueError(f"{name!r} is neither qc nor fs")
            found[name] = value_of(value, "Pa")
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
        found = value_of(text, "m") if text else None
        if found is not None and not 0 <= found <= DEEPEST_WATER:
            raise ValueError(f"{text!r} is no depth of water")
    except ValueError as error:
        raise InputError(f"--zeroed-on-deck: {error}; write 20m") from error
    return found


@disk.reads
def read(path: Path, with_friction: bool = True, how: How = How()) -> Test:
    """Return the test of a file. Without friction only depth and q_c are read, and
    nothing else is looked at. Raises InputError, with the row."""
    table = table_of(path, disk.read_bytes(path), how)
    above, water = above_of(how.above), depth_of_water(how.zeroed_on_deck)
    with naming(path):
        found = Readings(table, EVERY if with_friction else NEEDED)
        found.refuse_thousands()
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
        was_zeroed = found.zero_at_mudline(water, ratio)
        found.complete_friction()
        found.complete_pressure()
        gaps = found.gaps()
        start, how_known = found.reach_up(above)
        found.say_rest()
    friction, pressure = (
        None if np.isnan(values).any() else values
        for values in (found.friction, found.pressure)
    )
    return Test(
        found.depth,
        found.tip,
        friction,
        pressure,
        tuple(dict.fromkeys(found.remarks)),
        table.facts.area_ratio,
        start,
        how_known,
        found.tip_name == "qt",
        gaps,
        was_zeroed,
        table.begins_with_heads and not any(how),
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
