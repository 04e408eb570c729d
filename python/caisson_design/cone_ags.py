# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests in files of AGS 4, the format of the Association of Geotechnical and
Geoenvironmental Specialists.

A file has groups: rows GROUP, HEADING, UNIT and TYPE, then a row DATA for each reading,
all cells in quotation marks. The readings of static cone tests are the group SCPT. Each
belongs to a location, LOCA_ID, and to a push there, SCPG_TESN.
"""
import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

from caisson_design import InputError
from caisson_design.cone_table import NEEDED, Column, Table, refuse, unit_of

HEADINGS = {
    "depth": "SCPT_DPTH",
    "qc": "SCPT_RES",
    "fs": "SCPT_FRES",
    "u2": "SCPT_PWP2",
}
LOCATION, PUSH = "LOCA_ID", "SCPG_TESN"
AREA_RATIO = "SCPG_CAR"  # of the group SCPG, which has a row for each test
Rows = list[tuple[int, list[str]]]


def is_in(lines: Sequence[str]) -> bool:
    """Return whether the lines of a file are in an AGS format."""
    first = next((line for line in lines if line.strip()), "")
    return first.replace('"', "").lstrip().upper().startswith(("GROUP,", "**"))


def groups_of(path: Path, lines: Sequence[str]) -> dict[str, Rows]:
    """Return the rows of each group below its name. Raises InputError."""
    found: dict[str, Rows] = {}
    name = ""
    for row, line in enumerate(lines, 1):
        cells = next(csv.reader([line], skipinitialspace=True)) or [""]
        if cells[0].startswith("**"):
            raise InputError(
                f"{path}, row {row}: {cells[0]!r} is a group of AGS 3; only AGS 4 is"
                " read: export the file as that"
            )
        if cells[0] == "GROUP":
            name = cells[1] if len(cells) > 1 else ""
            found.setdefault(name, [])
        elif name and any(cells):
            found[name].append((row, cells))
    return found


def readings_of(path: Path, groups: Mapping[str, Rows]) -> Rows:
    """Return the rows of the group SCPT. Raises InputError."""
    if "SCPT" not in groups:
        raise InputError(
            f"{path}: there is no group SCPT, which has the readings of a cone test;"
            f" the groups are {', '.join(groups)}"
        )
    if not groups["SCPT"]:
        raise InputError(
            f"{path}: the group SCPT, which has the readings of a cone test, is empty"
        )
    return groups["SCPT"]


def area_ratio_of(groups: Mapping[str, Rows], key: Mapping[str, str]) -> float | None:
    """Return the net area ratio of the cone of a test, None where the file has none.
    key: LOCATION and PUSH of the test, where the file has them."""
    heads: list[str] = []
    for _, cells in groups.get("SCPG", []):
        heads = cells if cells[0] == "HEADING" else heads
        values = dict(zip(heads, cells))
        is_it = all(values.get(head, text) == text for head, text in key.items())
        if cells[0] == "DATA" and is_it:
            try:
                return float(values[AREA_RATIO].replace(",", "."))
            except (KeyError, ValueError):
                return None
    return None


def row_of(path: Path, rows: Rows, name: str) -> tuple[int, list[str]]:
    """Return the row HEADING or UNIT of the group. Raises InputError."""
    for row, cells in rows:
        if cells[0] == name:
            return row, cells
    raise InputError(f"{path}, row {rows[0][0]}: the group SCPT has no row {name}")


def columns_of(path: Path, rows: Rows, wanted: Sequence[str]) -> dict[str, Column]:
    """Return the columns of the quantities that are wanted and there. Raises
    InputError."""
    row, heads = row_of(path, rows, "HEADING")
    row_of_units, units = row_of(path, rows, "UNIT")
    missing = [HEADINGS[name] for name in NEEDED if HEADINGS[name] not in heads]
    if missing:
        raise InputError(
            f"{path}, row {row}: the group SCPT has no heading {' and '.join(missing)}"
        )
    found = {}
    for name in wanted:
        if (head := HEADINGS[name]) in heads:
            place = heads.index(head)
            unit = units[place] if place < len(units) else ""
            found[name] = Column(place, unit_of(path, row_of_units, head, name, unit))
    return found


def names_of(rows: Rows, heads: Sequence[str]) -> list[str]:
    """Return the name of the test of each row: its location, and the push where a
    location has several."""
    places = [heads.index(head) for head in (LOCATION, PUSH) if head in heads]
    keys = [tuple(cells[place] for place in places) for _, cells in rows]
    pushes: dict[str, set[tuple[str, ...]]] = {}
    for key in keys:
        pushes.setdefault(key[0] if key else "", set()).add(key)
    return [
        "/".join(key) if key and len(pushes[key[0]]) > 1 else "".join(key[:1])
        for key in keys
    ]


def table_of(
    path: Path, lines: Sequence[str], wanted: Sequence[str], location: str
) -> Table:
    """Return the table of the test at a location, "" for that of the file if it has
    only one. Raises InputError."""
    groups = groups_of(path, lines)
    group = readings_of(path, groups)
    columns = columns_of(path, group, wanted)
    heads = row_of(path, group, "HEADING")[1]
    rows = [(row, cells) for row, cells in group if cells[0] == "DATA"]
    refuse(
        path,
        [
            (row, f"{len(cells)} cells, and {len(heads)} in the row HEADING")
            for row, cells in rows
            if len(cells) != len(heads)
        ],
    )
    names = names_of(rows, heads)
    every = list(dict.fromkeys(names))
    if location and location not in every:
        raise InputError(
            f"{path} has no test {location!r}; the tests are {', '.join(every)}"
        )
    if not location and len(every) > 1:
        raise InputError(
            f"{path} has {len(every)} tests: {', '.join(every)}; choose one by"
            f" --location, as in caisson cpt {path.name} --location {every[0]!r}"
        )
    chosen = [row for row, name in zip(rows, names) if name == (location or name)]
    known = {*(column.place for column in columns.values()), 0}
    known |= {heads.index(head) for head in (LOCATION, PUSH) if head in heads}
    unread = tuple(head for i, head in enumerate(heads) if i not in known)
    first = dict(zip(heads, chosen[0][1])) if chosen else {}
    key = {head: first[head] for head in (LOCATION, PUSH) if head in first}
    return Table(
        columns,
        chosen,
        len(heads),
        unread,
        "the row UNIT",
        "each column needs a heading",
        may_be_empty=True,
        area_ratio=area_ratio_of(groups, key),
    )
