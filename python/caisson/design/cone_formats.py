# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests in the formats that have a standard: GEF, AGS 4 and BRO-XML.

GEF-CPT-Report, the Dutch Geotechnical Exchange Format: lines #KEY = VALUE, of which
#COLUMNINFO has number, unit, name and quantity of a column, #COLUMNVOID what stands
where a column has no value, #MEASUREMENTVAR values of the whole test by number, and
#COLUMNSEPARATOR and #RECORDSEPARATOR what divides cells (default: blanks) and ends rows
(default: the line). The table begins below #EOH.

AGS 4, of the Association of Geotechnical and Geoenvironmental Specialists: groups with
rows HEADING, UNIT and TYPE, then a row DATA for each reading, all cells in quotation
marks. The readings of cone tests are the group SCPT. Each belongs to a location,
LOCA_ID, and to a push there, SCPG_TESN.

BRO-XML, the form of the Dutch register of the subsurface (CPT_O): records of 25 values
in an order and in units (m, MPa) that its catalog fixes, with -999999 for none.
"""
import csv
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

from caisson.disk import InputError
from caisson.design.cone_table import Facts, Head, Rows, Table, refuse, table_of
from caisson.design.cone_table import is_number, value_of
from caisson.design.cone_words import LENGTH, NEEDED, QUANTITIES, unit_in

BY_GEF = {quantity.gef: key for key, quantity in QUANTITIES.items()}
BY_AGS = {q.ags: key for key, q in QUANTITIES.items() if q.ags}
GEF_AREA_RATIO, GEF_PREDRILLED = 3, 13  # of #MEASUREMENTVAR
LOCATION, PUSH, DEPTH = "LOCA_ID", "SCPG_TESN", QUANTITIES["depth"].ags
MOST = 30  # names in a message
FEW = 0.02  # of the rows of GEF may have another number of cells
Keys = list[tuple[int, str, list[str]]]


def listed(names: Sequence[str]) -> str:
    """Return names for a message, not all of very many."""
    return ", ".join(names[:MOST]) + (", ..." if len(names) > MOST else "")


def chosen_of(path: Path, names: Sequence[str], location: str, example: str) -> str:
    """Return the name of the test that is read. example: of --location. Raises
    InputError where it is not there or has to be chosen."""
    if location and location not in names:
        raise InputError(
            f"{path} has no test {location!r}; the tests are {listed(names)}"
        )
    if not location and len(names) > 1:
        raise InputError(
            f"{path} has {len(names)} tests: {listed(names)}; choose one by"
            f" --location, as in --location {example!r}"
        )
    return location or names[0]


# --------------------------------------------------------------------- GEF


def is_gef(lines: Sequence[str]) -> bool:
    """Return whether the lines of a file are in GEF."""
    keys = r'\s*"?#\s*(GEFID|COLUMNINFO)\b'
    return any(re.match(keys, line, re.I) for line in lines)


def unquoted(line: str) -> str:
    """Return a line without the quotation marks of a spreadsheet program, and without
    blanks in front of a key."""
    line = line.lstrip() if line.lstrip().startswith(("#", '"')) else line
    if match := re.fullmatch(r'"(.*)"[\s,;]*', line):
        return match[1].replace('""', '"')
    return line


def gef_keys(path: Path, lines: Sequence[str]) -> tuple[Keys, int]:
    """Return row, key and value, divided at its commas, of the lines above the table,
    and the number of the last one. Raises InputError."""
    found: Keys = []
    for row, line in enumerate(lines, 1):
        if match := re.match(r"#\s*(\w+)\s*=?(.*)", line):
            if match[1].upper() == "EOH":
                return found, row
            parts = [part.strip() for part in match[2].split(",")]
            found.append((row, match[1].upper(), parts))
    raise InputError(f"{path}: there is no line #EOH=, below which the table begins")


def place_of(text: str) -> int:
    """Return the place of a column, from 0, by its number, from 1. Raises
    ValueError."""
    if int(text) < 1:
        raise ValueError(f"the first column has the number 1, not {text}")
    return int(text) - 1


def decimal_of(parts: Sequence[str]) -> tuple[float, str]:
    """Return the number at the beginning of a value that was divided at its commas, one
    of which may be a decimal comma, and what comes next. Raises ValueError or
    IndexError."""
    has_comma = len(parts) > 1 and re.fullmatch(r"[+-]?\d+", parts[0])
    if has_comma and re.fullmatch(r"\d+([eE][+-]?\d+)?", parts[1]):
        return float(f"{parts[0]}.{parts[1]}"), "".join(parts[2:3])
    return float(parts[0]), "".join(parts[1:2])


def gef_head(row: int, value: list[str]) -> Head:
    """Return what #COLUMNINFO says of a column. Raises ValueError or IndexError."""
    while value and not value[-1]:
        value = value[:-1]
    quantity = BY_GEF.get(int(value[-1]), "")
    return Head(place_of(value[0]), ", ".join(value[2:-1]), quantity, value[1], row)


def gef_lines(path: Path, keys: Keys, key: str, read: Callable, what: str) -> list:
    """Return what a function reads of the values of all lines with a key. what: the
    line must have. Raises InputError."""
    found = []
    for row, name, value in keys:
        if name == key:
            try:
                found.append(read(row, value))
            except (ValueError, IndexError) as error:
                raise InputError(
                    f"{path}, row {row}: #{key} must have {what}; it is"
                    f" {', '.join(value)!r}"
                ) from error
    return found


def gef_facts(keys: Keys) -> Facts:
    """Return what #MEASUREMENTVAR says of the whole test; a value that is no number
    says nothing."""
    found: dict[str, float] = {}
    for _, key, value in keys:
        try:
            if key == "MEASUREMENTVAR":
                number, unit = decimal_of(value[1:])
                found[value[0]] = number
                if int(value[0]) == GEF_PREDRILLED:
                    found[value[0]] = abs(number) * LENGTH.get(unit_in(unit), 1.0)
        except (ValueError, IndexError):
            continue
    return Facts(found.get(str(GEF_AREA_RATIO)), found.get(str(GEF_PREDRILLED)))


def gef_rows(path: Path, lines: Sequence[str], keys: Keys, last: int) -> Rows:
    """Return the rows of the table, below the last line of the keys, with empty cells
    where a column has no value. Raises InputError."""
    what = "the number of a column, from 1, and a number"
    voids = gef_lines(
        path,
        keys,
        "COLUMNVOID",
        lambda _, value: (place_of(value[0]), decimal_of(value[1:])[0]),
        what,
    )
    # a value is divided at its commas: of a comma two empty parts are left
    marks = {key: "," if value[:2] == ["", ""] else value[0] for _, key, value in keys}
    divider = marks.get("COLUMNSEPARATOR") or None
    end = marks.get("RECORDSEPARATOR")
    rows: Rows = []
    for row, line in enumerate(lines[last:], last + 1):
        for record in line.split(end) if end else [line]:
            record = record.strip().removesuffix(divider or "\n")
            cells = [cell.strip() for cell in record.split(divider)]
            if not any(cells):
                continue
            for place, void in voids:
                if place < len(cells) and is_void(cells[place], void):
                    cells[place] = ""
            rows.append((row, cells))
    return rows


def is_void(text: str, void: float) -> bool:
    """Return whether a cell has no value."""
    try:
        return abs(value_of(text) - void) <= 1e-6 * abs(void)
    except ValueError:
        return False


def gef(path: Path, lines: Sequence[str], wanted: Sequence[str]) -> Table:
    """Return the table of a file in GEF. Raises InputError."""
    lines = list(map(unquoted, lines))
    keys, last = gef_keys(path, lines)
    for row, key, value in keys:
        if key in ("REPORTCODE", "PROCEDURECODE") and "BORE" in value[0].upper():
            raise InputError(
                f"{path}, row {row}: {value[0]} is a borehole, no cone test"
            )
    what = "number (from 1), unit, name and quantity of a column"
    heads = gef_lines(path, keys, "COLUMNINFO", gef_head, what)
    if not heads:
        raise InputError(f"{path}: no line #COLUMNINFO says what a column is")
    rows = gef_rows(path, lines, keys, last)
    number = max(head.place for head in heads) + 1
    wrong = [
        (row, f"{len(cells)} cells, and {number} columns in #COLUMNINFO")
        for row, cells in rows
        if len(cells) < number or any(map(is_number, cells[number:]))
    ]
    if len(wrong) > FEW * len(rows):
        refuse(path, wrong)
    left_out = {row for row, _ in wrong}
    rows = [(row, cells) for row, cells in rows if row not in left_out]
    numbers = {key: QUANTITIES[key].gef for key in QUANTITIES}
    advice = (
        f"#COLUMNINFO has quantity {numbers['depth']} or {numbers['rods']} for the"
        f" depth, and {numbers['qc']} for the cone resistance"
    )
    found = table_of(path, heads, rows, wanted, "#COLUMNINFO", advice)
    found.facts = gef_facts(keys)
    if wrong:
        row, why = wrong[0]
        found.remarks.append(
            f"rows with another number of cells, left out: {len(wrong)}, the first is"
            f" row {row}: {why}"
        )
    if texts := [(row, cells[number:]) for row, cells in rows if any(cells[number:])]:
        found.remarks.append(
            f"texts at the ends of rows, not read: {len(texts)}, the first is in row"
            f" {texts[0][0]}, {' '.join(texts[0][1])[:40]!r}"
        )
    return found


# ------------------------------------------------------------------- AGS 4


def is_ags(lines: Sequence[str]) -> bool:
    """Return whether the lines of a file are in an AGS format."""
    first = next((line for line in lines if line.strip()), "")
    return first.replace('"', "").lstrip().upper().startswith(("GROUP,", "**"))


def is_ags_group(rows: Rows) -> bool:
    """Return whether a table is the group SCPT: a row has headings of AGS 4."""
    return any(DEPTH in cells for _, cells in rows[:MOST])


def group_of_table(rows: Rows) -> tuple[Rows, list[str]]:
    """Return the group SCPT of a table with its headings, as programs write it, with
    the rows HEADING, UNIT and DATA, and in words what is assumed."""
    place = next(i for i, (_, cells) in enumerate(rows) if DEPTH in cells)
    row, heads = rows[place]
    if heads[0] == "HEADING":
        return rows[place:], []
    below = [(row, ["DATA", *cells]) for row, cells in rows[place + 1 :]]
    depth = 1 + heads.index(DEPTH)
    units = [QUANTITIES[BY_AGS[x]].usual if x in BY_AGS else "" for x in heads]
    said = ["ASSUMED: the units of AGS 4: m, q_c in MPa, f_s and u_2 in kPa"]
    while below and not is_number("".join(below[0][1][depth : depth + 1])):
        (row, (_, *cells)), *below = below
        if unit_in("".join(cells[depth - 1 : depth])) in LENGTH:
            units, said = cells, []
    return [(row, ["HEADING", *heads]), (row, ["UNIT", *units]), *below], said


def ags_groups(path: Path, lines: Sequence[str]) -> dict[str, Rows]:
    """Return the rows of each group below its name. Raises InputError."""
    found: dict[str, Rows] = {}
    name = ""
    for row, line in enumerate(lines, 1):
        cells = next(csv.reader([line], skipinitialspace=True), [""]) or [""]
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
    if not found.get("SCPT"):
        raise InputError(
            f"{path}: there is no group SCPT with the readings of a cone test; the"
            f" groups are {listed(list(found))}"
        )
    return found


def ags_row(path: Path, rows: Rows, name: str) -> tuple[int, list[str]]:
    """Return the row HEADING or UNIT of a group, which is the same wherever the group
    goes on. Raises InputError."""
    found = [(row, cells) for row, cells in rows if cells[0] == name]
    if not found:
        raise InputError(f"{path}, row {rows[0][0]}: the group SCPT has no row {name}")
    why = f"the group SCPT has a row {name} unlike that in row {found[0][0]}; divide it"
    refuse(path, [(row, why) for row, cells in found if cells != found[0][1]])
    return found[0]


def ags_ratio(groups: Mapping[str, Rows], keys: set) -> tuple[float | None, list[str]]:
    """Return the net area ratio of the cone of pushes, None where the file has none,
    and in words that it is not the same for all. keys: LOCA_ID and SCPG_TESN."""
    heads: list[str] = []
    found = []
    for _, cells in groups.get("SCPG", []):
        heads = cells if cells[0] == "HEADING" else heads
        values = dict(zip(heads, cells))
        is_it = any(
            values.get(LOCATION, place) == place and values.get(PUSH, push) == push
            for place, push in keys
        )
        try:
            if cells[0] == "DATA" and is_it:
                found.append(value_of(values.get("SCPG_CAR", "none")))
        except ValueError:
            continue
    if len(set(found)) < 2:
        return next(iter(found), None), []
    text = f"the pushes have area ratios of {min(found):g} to {max(found):g}"
    return found[0], [f"{text}: the first, {found[0]:g}, is taken"]


def ags_names(keys: Sequence[tuple[str, str]]) -> list[str]:
    """Return the names of the tests: locations, and the pushes of each that has
    several."""
    pushes: dict[str, list[str]] = {}
    for place, push in dict.fromkeys(keys):
        pushes.setdefault(place, []).append(push)
    return [
        name
        for place, some in pushes.items()
        for name in ([f"{place}/{p}" for p in some] if len(some) > 1 else [place])
    ]


def ags(
    path: Path, groups: Mapping[str, Rows], wanted: Sequence[str], where: str
) -> Table:
    """Return the table of the test at a location, "" for that of the file if it has
    only one; the pushes of a location are one test. groups: their rows by name. Raises
    InputError."""
    row_of_heads, texts = ags_row(path, groups["SCPT"], "HEADING")
    row_of_units, units = ags_row(path, groups["SCPT"], "UNIT")
    units = units + [""] * len(texts)
    rows = [(row, cells) for row, cells in groups["SCPT"] if cells[0] == "DATA"]
    refuse(
        path,
        [
            (row, f"{len(cells)} cells, and {len(texts)} in the row HEADING")
            for row, cells in rows
            if len(cells) < len(texts) or any(cells[len(texts) :])
        ],
    )
    heads = [
        Head(place, text, BY_AGS.get(text, ""), units[place], row_of_units)
        for place, text in enumerate(texts)
        if text not in ("HEADING", LOCATION, PUSH)
    ]

    def of_row(cells: list[str]) -> tuple[str, str]:
        place, push = (
            cells[texts.index(head)] if head in texts else ""
            for head in (LOCATION, PUSH)
        )
        return place, push

    keys = [of_row(cells) for _, cells in rows]
    places = list(dict.fromkeys(place for place, _ in keys))
    names = ags_names(keys)
    if where not in places and len(places) > 1 or where not in ("", *places):
        where = chosen_of(path, names, where, places[0])
    chosen = [
        (f"{place}/{push}", row)
        for (place, push), row in zip(keys, rows)
        if where in ("", place, f"{place}/{push}")
    ]
    advice = f"the headings are {' and '.join(QUANTITIES[n].ags for n in NEEDED)}"
    of_test = [row for _, row in chosen]
    found = table_of(path, heads, of_test, wanted, "the row UNIT", advice)
    found.pushes = [push for push, _ in chosen]
    ratio, said = ags_ratio(groups, {of_row(cells) for _, cells in of_test})
    found.facts, found.remarks = Facts(ratio), said
    return found


# ----------------------------------------------------------------- BRO-XML


def is_xml(lines: Sequence[str]) -> bool:
    """Return whether the lines of a file are XML."""
    return next((x for x in lines if x.strip()), "").lstrip().startswith("<")


def tag_of(element: ElementTree.Element) -> str:
    """Return the name of an element without that of its space."""
    return str(element.tag).rpartition("}")[2]


def first_of(element: ElementTree.Element, *names: str) -> ElementTree.Element | None:
    """Return the first element within one that has one of the names."""
    return next((e for e in element.iter() if tag_of(e) in names), None)


def number_in(element: ElementTree.Element, name: str) -> float | None:
    """Return the number of the first element of this name, None for none."""
    found = first_of(element, name)
    try:
        return None if found is None else float(found.text or "")
    except ValueError:
        return None


def bro_records(path: Path, test: ElementTree.Element) -> Rows:
    """Return the records of a test. Raises InputError."""
    survey = first_of(test, "conePenetrationTest")
    result = first_of(test if survey is None else survey, "cptResult")
    values = None if result is None else first_of(result, "values")
    if result is None or values is None or not (values.text or "").strip():
        raise InputError(f"{path}: the test has no values within cptResult")
    encoding = first_of(result, "TextEncoding")
    marks = {} if encoding is None else encoding.attrib
    comma, end = marks.get("tokenSeparator", ","), marks.get("blockSeparator", ";")
    records = (values.text or "").strip().split(end)
    cells = [[x.strip() for x in r.split(comma)] for r in records if r.strip()]
    return list(enumerate(cells, 1))


def bro(path: Path, lines: Sequence[str], wanted: Sequence[str], where: str) -> Table:
    """Return the table of a file of BRO-XML; where: its number in the register, needed
    in a file of several. Raises InputError."""
    text = "\n".join(lines)
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise InputError(f"{path}: XML with definitions of its own is not read")
    try:
        # without the declaration: the text is no longer in its encoding
        root = ElementTree.fromstring(re.sub(r"^\s*<\?xml.*?\?>", "", text, flags=re.S))
    except ElementTree.ParseError as error:
        raise InputError(f"{path} is no complete XML: {error}") from error
    tests = {}
    for number, element in enumerate(e for e in root.iter() if tag_of(e) == "CPT_O"):
        name = first_of(element, "broId")
        tests[str(number + 1) if name is None else name.text or ""] = element
    if not tests:
        raise InputError(
            f"{path}: the XML has no cone test of the Dutch register, CPT_O; other XML"
            " is not read: export the test as GEF, AGS 4 or CSV"
        )
    every = list(tests)
    test = tests[chosen_of(path, every, where, every[0])]
    rows = bro_records(path, test)
    heads = [
        Head(q.bro, q.name, key, q.usual.replace("kPa", "MPa"), 1)
        for key, q in QUANTITIES.items()
    ]
    found = table_of(path, heads, rows, wanted, "the standard", "record 4 of 25 is q_c")
    found.facts = Facts(
        number_in(test, "coneSurfaceQuotient"), number_in(test, "predrilledDepth")
    )
    found.unread, found.is_sorted = (), False
    return found
