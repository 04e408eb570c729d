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
from collections import defaultdict
from collections.abc import Mapping, Sequence
from math import isclose
from xml.etree import ElementTree

from caisson.disk import InputError
from caisson.design.cone_table import Facts, Head, Rows, Table, refuse
from caisson.design.cone_table import is_number, value_of
from caisson.design.cone_words import LENGTH, NEEDED, QUANTITIES, unit_in

BY_GEF = {quantity.gef: key for key, quantity in QUANTITIES.items()}
BY_AGS = {q.ags: key for key, q in QUANTITIES.items() if q.ags}
GEF_AREA_RATIO, GEF_PREDRILLED = "3", "13"  # of #MEASUREMENTVAR
LOCATION, PUSH, DEPTH = "LOCA_ID", "SCPG_TESN", QUANTITIES["depth"].ags
MOST = 30  # names in a message
FEW = 0.02  # of the rows of GEF may have another number of cells
DECIMAL = r"([+-]?(?:\d+(?:[.,]\d+)?|[.,]\d+)\.?(?:[eE][+-]?\d+)?)"
# values of GEF: a column has a number from 1, and what the message says
GEF = {
    "COLUMNINFO": (
        r"([1-9]\d*)\s*,([^,]*),(?:(.*),)?\s*(\d+)[\s,]*",
        "number (from 1), unit, name and quantity of a column",
    ),
    "COLUMNVOID": (
        rf"([1-9]\d*)\s*,\s*{DECIMAL}\s*(?:,.*)?",
        "the number of a column, from 1, and a number",
    ),
}
Keys = dict[str, list[tuple[int, str]]]


def listed(names: Sequence[str]) -> str:
    """Return names for a message, not all of very many."""
    return ", ".join(names[:MOST]) + (", ..." if len(names) > MOST else "")


def chosen_of(names: Sequence[str], location: str, example: str) -> str:
    """Return the name of the test that is read. example: of --location. Raises
    InputError where it is not there or has to be chosen."""
    if location and location not in names:
        raise InputError(
            f"there is no test {location!r}; the tests are {listed(names)}"
        )
    if not location and len(names) > 1:
        raise InputError(
            f"there are {len(names)} tests: {listed(names)}; choose one by --location,"
            f" as in --location {example!r}"
        )
    return location or names[0]


# --------------------------------------------------------------------- GEF


def unquoted(line: str) -> str:
    """Return a line without the quotation marks of a spreadsheet program, and without
    blanks in front of a key."""
    line = line.lstrip() if line.lstrip().startswith(("#", '"')) else line
    if match := re.fullmatch(r'"(.*)"[\s,;]*', line):
        return match[1].replace('""', '"')
    return line


def gef_keys(lines: Sequence[str]) -> tuple[Keys, int]:
    """Return the rows with each key above the table, with its value, and the number of
    the last one. Raises InputError."""
    found: Keys = defaultdict(list)
    for row, line in enumerate(lines, 1):
        if match := re.match(r"#\s*(\w+)\s*=?(.*)", line):
            if match[1].upper() == "EOH":
                return found, row
            found[match[1].upper()].append((row, match[2].strip()))
    raise InputError("there is no line #EOH=, below which the table begins")


def gef_values(keys: Keys, key: str) -> list[tuple[int, tuple[str, ...]]]:
    """Return the rows with a key, and the parts of its values. Raises InputError."""
    (pattern, what), found = GEF[key], []
    for row, text in keys[key]:
        match = re.fullmatch(pattern, text)
        if not match:
            raise InputError(f"row {row}: #{key} must have {what}; it is {text!r}")
        found.append((row, match.groups("")))
    return found


def gef_facts(keys: Keys) -> Facts:
    """Return what #MEASUREMENTVAR says of the whole test; a value that is no number
    says nothing."""
    found: dict[str, float] = {}
    for _, text in keys["MEASUREMENTVAR"]:
        if match := re.match(rf"(\d+)\s*,\s*{DECIMAL}\s*(?:,([^,]*)|$)", text):
            name, value = match[1], float(match[2].replace(",", "."))
            factor = LENGTH.get(unit_in(match[3] or ""), 1.0)
            found[name] = abs(value) * factor if name == GEF_PREDRILLED else value
    return Facts(found.get(GEF_AREA_RATIO), found.get(GEF_PREDRILLED))


def gef_rows(lines: Sequence[str], keys: Keys, last: int) -> Rows:
    """Return the rows of the table, below the last line of the keys, with empty cells
    where a column has no value. Raises InputError."""
    voids = [
        (int(number) - 1, float(void.replace(",", ".")))
        for _, (number, void) in gef_values(keys, "COLUMNVOID")
    ]
    marks = {key: found[-1][1] for key, found in keys.items() if found}
    divider = marks.get("COLUMNSEPARATOR") or None
    end = marks.get("RECORDSEPARATOR")
    rows: Rows = []
    for row, line in enumerate(lines[last:], last + 1):
        for record in line.split(end) if end else [line]:
            record = record.strip().removesuffix(divider or "\n")
            cells = [cell.strip() for cell in record.split(divider)]
            if any(cells):
                rows.append((row, cells))
            for place, void in voids:
                if place < len(cells) and is_number(cells[place]):
                    if isclose(value_of(cells[place]), void, rel_tol=1e-6):
                        cells[place] = ""
    return rows


def gef(lines: Sequence[str], _: str) -> Table:
    """Return the table of a file in GEF. Raises InputError."""
    lines = list(map(unquoted, lines))
    keys, last = gef_keys(lines)
    for row, text in keys["REPORTCODE"] + keys["PROCEDURECODE"]:
        if "BORE" in (code := text.split(",")[0]).upper():
            raise InputError(f"row {row}: {code} is a borehole, no cone test")
    heads = [
        Head(
            int(number) - 1, name.strip(), BY_GEF.get(int(what), ""), unit.strip(), row
        )
        for row, (number, unit, name, what) in gef_values(keys, "COLUMNINFO")
    ]
    if not heads:
        raise InputError("no line #COLUMNINFO says what a column is")
    every = gef_rows(lines, keys, last)
    number = max(head.place for head in heads) + 1
    wrong = [
        (row, f"{len(cells)} cells, and {number} columns in #COLUMNINFO")
        for row, cells in every
        if len(cells) < number or any(map(is_number, cells[number:]))
    ]
    if len(wrong) > FEW * len(every):
        refuse(wrong)
    left_out = {row for row, _ in wrong}
    rows = [(row, cells) for row, cells in every if row not in left_out]
    said = [
        f"rows with another number of cells, left out: {len(wrong)}, the first is row"
        f" {row}: {why}"
        for row, why in wrong[:1]
    ]
    texts = [(row, cells[number:]) for row, cells in rows if any(cells[number:])]
    said += [
        f"texts at the ends of rows, not read: {len(texts)}, the first is in row {row},"
        f" {' '.join(cells)[:40]!r}"
        for row, cells in texts[:1]
    ]
    depth, rods, tip = (QUANTITIES[name].gef for name in ("depth", "rods", "qc"))
    advice = (
        f"#COLUMNINFO has quantity {depth} or {rods} for the depth, and {tip} for the"
        " cone resistance"
    )
    return Table(heads, rows, "#COLUMNINFO", advice, gef_facts(keys), said)


# ------------------------------------------------------------------- AGS 4


def group_of_table(rows: Rows) -> tuple[Rows, list[str]]:
    """Return the group SCPT of a table with its headings, as programs write it, with
    the rows HEADING, UNIT and DATA, and in words what is assumed; no rows of another
    table."""
    places = (i for i, (_, cells) in enumerate(rows[:MOST]) if DEPTH in cells)
    if (place := next(places, None)) is None:
        return [], []
    row, heads = rows[place]
    if heads[0] == "HEADING":
        return rows[place:], []
    depth, below = heads.index(DEPTH), rows[place + 1 :]
    units = [QUANTITIES[BY_AGS[x]].usual if x in BY_AGS else "" for x in heads]
    said = ["ASSUMED: the units of AGS 4: m, q_c in MPa, f_s and u_2 in kPa"]
    while below and not is_number("".join(below[0][1][depth : depth + 1])):
        (row, cells), *below = below
        if unit_in("".join(cells[depth : depth + 1])) in LENGTH:
            units, said = cells, []
    data = [(number, ["DATA", *cells]) for number, cells in below]
    return [(row, ["HEADING", *heads]), (row, ["UNIT", *units]), *data], said


def ags_of_lines(lines: Sequence[str], where: str) -> Table:
    """Return the table of the test at a location in the lines of a file. Raises
    InputError."""
    found: dict[str, Rows] = {}
    name = ""
    for row, line in enumerate(lines, 1):
        cells = next(csv.reader([line], skipinitialspace=True), [""]) or [""]
        if cells[0].startswith("**"):
            raise InputError(
                f"row {row}: {cells[0]!r} is a group of AGS 3; only AGS 4 is read:"
                " export the file as that"
            )
        if cells[0] == "GROUP":
            name = "".join(cells[1:2])
            found.setdefault(name, [])
        elif name and any(cells):
            found[name].append((row, cells))
    if not found.get("SCPT"):
        raise InputError(
            "there is no group SCPT with the readings of a cone test; the groups are"
            f" {listed(list(found))}"
        )
    return ags(found, where)


def ags_row(rows: Rows, name: str) -> tuple[int, list[str]]:
    """Return the row HEADING or UNIT of a group, which is the same wherever the group
    goes on. Raises InputError."""
    found = [(row, cells) for row, cells in rows if cells[0] == name]
    if not found:
        raise InputError(f"row {rows[0][0]}: the group SCPT has no row {name}")
    why = f"the group SCPT has a row {name} unlike that in row {found[0][0]}; divide it"
    refuse([(row, why) for row, cells in found if cells != found[0][1]])
    return found[0]


def ags_ratio(group: Rows, keys: set[tuple[str, str]]) -> tuple[Facts, list[str]]:
    """Return the net area ratio of the cone of pushes in the group SCPG, and in words
    that it is not the same for all. keys: LOCA_ID and SCPG_TESN."""
    heads: list[str] = []
    found = []
    for _, cells in group:
        heads = cells if cells[0] == "HEADING" else heads
        values = dict(zip(heads, cells))
        is_it = any(
            values.get(LOCATION, place) == place and values.get(PUSH, push) == push
            for place, push in keys
        )
        if cells[0] == "DATA" and is_it and is_number(values.get("SCPG_CAR", "")):
            found.append(value_of(values["SCPG_CAR"]))
    said = []
    if len(set(found)) > 1:
        text = f"the pushes have area ratios of {min(found):g} to {max(found):g}"
        said = [f"{text}: the first, {found[0]:g}, is taken"]
    return Facts(next(iter(found), None)), said


def ags(groups: Mapping[str, Rows], where: str) -> Table:
    """Return the table of the test at a location, "" for that of the file if it has
    only one; the pushes of a location are one test. groups: their rows by name. Raises
    InputError."""
    _, texts = ags_row(groups["SCPT"], "HEADING")
    row_of_units, units = ags_row(groups["SCPT"], "UNIT")
    rows = [(row, cells) for row, cells in groups["SCPT"] if cells[0] == "DATA"]
    refuse(
        [
            (row, f"{len(cells)} cells, and {len(texts)} in the row HEADING")
            for row, cells in rows
            if len(cells) < len(texts) or any(cells[len(texts) :])
        ]
    )
    heads = [
        Head(place, text, BY_AGS.get(text, ""), unit, row_of_units)
        for place, (text, unit) in enumerate(zip(texts, units + [""] * len(texts)))
        if text not in ("HEADING", LOCATION, PUSH)
    ]
    by_head = [dict(zip(texts, cells)) for _, cells in rows]
    keys = [(cells.get(LOCATION, ""), cells.get(PUSH, "")) for cells in by_head]
    every = list(dict.fromkeys(keys))
    places = [place for place, _ in every]
    if where not in places and len({*places}) > 1 or where not in ("", *places):
        every.sort(key=lambda key: places.index(key[0]))
        # a location, or a push of one that has several
        names = [x if places.count(x) == 1 else f"{x}/{push}" for x, push in every]
        where = chosen_of(names, where, places[0])
    chosen = [i for i, key in enumerate(keys) if where in ("", key[0], "/".join(key))]
    advice = f"the headings are {' and '.join(QUANTITIES[n].ags for n in NEEDED)}"
    facts, said = ags_ratio(groups.get("SCPG", []), {keys[i] for i in chosen})
    pushes, of_test = ["/".join(keys[i]) for i in chosen], [rows[i] for i in chosen]
    return Table(heads, of_test, "the row UNIT", advice, facts, said, pushes)


# ----------------------------------------------------------------- BRO-XML


def first_of(element: ElementTree.Element, name: str) -> ElementTree.Element:
    """Return the first element of a name within one, in any name space; an empty one
    where there is none."""
    found = element.find(f".//{{*}}{name}")
    return ElementTree.Element(name) if found is None else found


def number_in(element: ElementTree.Element, name: str) -> float | None:
    """Return the number of the first element of this name, None for none."""
    try:
        return float(first_of(element, name).text or "")
    except ValueError:
        return None


def bro(lines: Sequence[str], where: str) -> Table:
    """Return the table of a file of BRO-XML; where: its number in the register, needed
    in a file of several. Raises InputError."""
    text = "\n".join(lines)
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise InputError("XML with definitions of its own is not read")
    try:
        # without the declaration: the text is no longer in its encoding
        root = ElementTree.fromstring(re.sub(r"^\s*<\?xml.*?\?>", "", text, flags=re.S))
    except ElementTree.ParseError as error:
        raise InputError(f"this is no complete XML: {error}") from error
    every = [x for x in root.iter() if str(x.tag).rpartition("}")[2] == "CPT_O"]
    tests = {
        first_of(test, "broId").text or str(number): test
        for number, test in enumerate(every, 1)
    }
    if not tests:
        raise InputError(
            "the XML has no cone test of the Dutch register, CPT_O; other XML is not"
            " read: export the test as GEF, AGS 4 or CSV"
        )
    names = list(tests)
    test = tests[chosen_of(names, where, names[0])]
    result = first_of(test, "cptResult")
    values = (first_of(result, "values").text or "").strip()
    if not values:
        raise InputError("the test has no values within cptResult")
    marks = first_of(result, "TextEncoding").attrib
    comma, end = marks.get("tokenSeparator", ","), marks.get("blockSeparator", ";")
    records = [r.split(comma) for r in values.split(end) if r.strip()]
    heads = [
        Head(q.bro, q.name, key, q.usual.replace("kPa", "MPa"), 1)
        for key, q in QUANTITIES.items()
    ]
    return Table(
        heads,
        [(row, [x.strip() for x in cells]) for row, cells in enumerate(records, 1)],
        "the standard",
        "record 4 of 25 is q_c",
        Facts(
            number_in(test, "coneSurfaceQuotient"), number_in(test, "predrilledDepth")
        ),
        is_register=True,
    )
