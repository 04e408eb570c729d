# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests as tables of text.

The first row names quantity and unit of each column: depth_m, qc_MPa (cone resistance),
fs_kPa (sleeve friction) and u2_kPa (pore pressure behind the cone), also as "depth (m)"
or "qc [MPa]", in words, and in German, Dutch or French; or the second row has the
units. Cells are divided by commas, semicolons or tabs. Rows that are empty or begin
with "#" are left out, but count.
"""
import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path

from caisson_design import InputError
from caisson_design.cone_table import NEEDED, UNITS, Column, Table, plain

HEADS = "depth_m and qc_MPa (or qc_kPa, qc_Pa)"
MORE_HEADS = "fs_kPa and u2_kPa (or in Pa or MPa)"
# names without blanks and accents, in English, German, Dutch and French
WORDS = {
    "depth": "depth tiefe teufe sondiertiefe diepte sondeerdiepte"
    " gecorrigeerdediepte profondeur"
    " depthbelowmudline depthbelowseabed depthbelowground depthbelowgroundlevel"
    " tiefeuntergok tiefeugok tiefeuntergelande tiefeuntergelandeoberkante"
    " dieptetovmaaiveld dieptetovmv diepteondermaaiveld profondeursouslesol",
    "rods": "penetration penetrationdepth sondeerlengte",  # where there is no depth
    "qc": "qc coneresistance tipresistance conetipresistance spitzendruck"
    " spitzenwiderstand conusweerstand puntweerstand resistancedepointe"
    " resistancedecone resistanceducone resistanceaucone",
    "fs": "fs sleevefriction sleeveresistance mantelreibung lokalemantelreibung"
    " plaatselijkewrijving plaatselijkekleef mantelwrijving kleef frottementlateral"
    " frottementlateralunitaire frottementlaterallocal",
    "u2": "u2 porepressure porewaterpressure porenwasserdruck porendruck waterspanning"
    " poriewaterspanning poriendruk waterdruk pressioninterstitielle"
    " pressiondeleau",
}
BY_WORD = {word: quantity for quantity, w in WORDS.items() for word in w.split()}
# a head with one of these counts from a datum, and not from the ground
DATUMS = frozenset("nap nhn nn taw ngf lat msl elevation kote hoogte hohe".split())
FILLERS = ("in", "en")  # between name and unit: "Tiefe in m"


def quantity_of(words: Sequence[str]) -> str:
    """Return the quantity of a head, "" if none: in words, with or without its symbol,
    as in "Spitzendruck qc"."""
    for text in ("".join(words), "".join(w for w in words if w not in UNITS)):
        if text in BY_WORD:
            found = BY_WORD[text]
            return found if {w for w in words if w in UNITS} <= {found} else ""
    return ""


def head_of(text: str) -> tuple[str, str]:
    """Return quantity and unit of a head such as depth_m, "qc (MPa)" or "Tiefe in m";
    each "" where it is not known."""
    every = {unit for units in UNITS.values() for unit in units}
    found = re.fullmatch(r"([^(\[]*)[(\[]([^)\]]*)[)\]]\W*", plain(text))
    name, unit = found.groups() if found else (plain(text), "")
    words = [word for word in re.split(r"[^a-z0-9/]+", name) if word]
    if not found and len(words) > 1 and words[-1] in every:
        unit = words.pop()
    words = [word for word in words if word not in FILLERS]
    # the last word may be a unit that is not known
    quantity = quantity_of(words) or ("" if unit else quantity_of(words[:-1]))
    return quantity, re.sub(r"\s", "", unit)


def refuse_levels(path: Path, heads: Sequence[str]) -> None:
    """Refuse heads of levels above a datum in place of depths. Raises InputError."""
    for head in heads:
        if DATUMS & set(re.split(r"[^a-z0-9]+", plain(head))):
            raise InputError(
                f"{path}: the column {head.strip()!r} is a level above a datum;"
                " subtract it from the level of the ground, and name the column depth_m"
            )


def columns_of(
    path: Path, heads: Sequence[str], wanted: Sequence[str]
) -> dict[str, Column]:
    """Return the columns of the quantities that are wanted and there; depth and q_c
    must be there."""
    found: dict[str, Column] = {}
    named = [head_of(head) for head in heads]
    has_depth = any(quantity == "depth" for quantity, _ in named)
    for place, (head, (quantity, unit)) in enumerate(zip(heads, named)):
        if quantity == "rods" and not has_depth:
            quantity = "depth"
        if quantity not in wanted:
            continue
        if unit not in UNITS[quantity] and quantity != "depth" and wanted[2:]:
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
    if "depth" not in found:
        refuse_levels(path, heads)
    if not set(NEEDED) <= set(found):
        raise InputError(
            f"{path}: the first row must name one column of depth and one of cone"
            f" resistance, {HEADS}, in English, German, Dutch or French; it is"
            f" {', '.join(heads)!r}"
        )
    return found


def with_units(heads: Sequence[str], below: Sequence[str]) -> list[str] | None:
    """Return the heads with the units of the row below; None where that has none."""
    every = {unit for units in UNITS.values() for unit in units}
    cells = [re.sub(r"[\s()\[\]]", "", cell) for cell in below]
    if not any(plain(cell) in every for cell in cells):
        return None
    cells += [""] * (len(heads) - len(cells))
    return [f"{head} ({cell})" if cell else head for head, cell in zip(heads, cells)]


def table_of(path: Path, lines: Sequence[str], wanted: Sequence[str]) -> Table:
    """Return the table of a file. Raises InputError."""
    kept = [
        (row, line)
        for row, line in enumerate(lines, 1)
        if line.strip(" \t,;") and not line.startswith("#")
    ]
    if len(kept) < 3:
        raise InputError(
            f"{path}: a cone test needs a row of heads, {HEADS}, and two rows of"
            " numbers"
        )
    divider = next((mark for mark in ";\t" if mark in kept[0][1]), ",")
    text = io.StringIO("\n".join(line for _, line in kept))
    (_, heads), *rows = zip(
        (row for row, _ in kept), csv.reader(text, delimiter=divider)
    )
    if two_rows := with_units(heads, rows[0][1]):
        heads, rows = two_rows, rows[1:]
    columns = columns_of(path, heads, wanted)
    places = {column.place for column in columns.values()}
    unread = tuple(h.strip() for i, h in enumerate(heads) if i not in places)
    advice = "each column needs a head in the first row"
    if divider == ",":
        advice = "where numbers have commas, divide cells by semicolons"
    return Table(columns, rows, len(heads), unread, "the first row", advice)
