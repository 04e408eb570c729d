# SPDX-License-Identifier: LGPL-2.1-or-later
"""The quantities of cone penetration tests, and what files call them and their units,
in all formats: the only reader of cone_words.toml, which has the words."""
import re
import tomllib
import unicodedata
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple


class Quantity(NamedTuple):
    """What a column can be: its name, its units, its heading in AGS 4, its number in
    GEF, its place in a record of BRO-XML from 0, the unit without one, and its names in
    twelve languages, without blanks and accents."""

    name: str
    units: Mapping[str, float]
    ags: str
    gef: int
    bro: int
    usual: str
    words: str


FILE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
# factors to m, Pa and a share of 1, by the kind of a unit and by its word
UNITS = {
    kind: {word: factor for words, factor in some.items() for word in words.split()}
    for kind, some in FILE["units"].items()
}
LENGTH = UNITS["length"]
EVERY_UNIT = {
    word: factor for units in UNITS.values() for word, factor in units.items()
}
# where a file has a quantity twice, in metric units, too, these are left
CUSTOMARY = {
    unit for unit in EVERY_UNIT if re.search("f(ee|oo)?t|in2|[kpt]s[if]", unit)
}
QUANTITIES = {
    key: Quantity(**found | {"units": UNITS[found["units"]]})
    for key, found in FILE["quantities"].items()
}
BY_WORD = {word: key for key, q in QUANTITIES.items() for word in q.words.split()}
BY_WORD |= {q.ags.replace("_", "").lower(): k for k, q in QUANTITIES.items() if q.ags}
DATUMS, FILLERS = (set(FILE["words"][name].split()) for name in ("datums", "fillers"))
LONGEST_SYMBOL = 2  # letters: qc, u2, Rp
INSTEAD = {"depth": "rods", "qc": "qt"}  # where a file has no column of the first
NEEDED = ("depth", "qc")
# letters that have no accent to be taken off
LETTERS = str.maketrans({"ø": "o", "æ": "ae", "ł": "l", "œ": "oe", "’": "'"})
BRACKETS = re.compile(r"[\[({<]([^\])}>]*)[\])}>]?")
UNIT_AT_END = re.compile(
    rf"(.*[a-z0-9])[\s_,;:/]+({'|'.join(sorted(EVERY_UNIT, key=len, reverse=True))})\W*"
)


def plain(text: str) -> str:
    """Return a text in small letters, without accents and powers: mn/m2 of MN / m²."""
    text = text.casefold().replace("_", " ").translate(LETTERS)
    letters = unicodedata.normalize("NFKD", text)
    letters = "".join(c for c in letters if not unicodedata.combining(c) and c != "^")
    return re.sub(r"\s*/\s*", "/", letters).strip()


def unit_in(text: str) -> str:
    """Return the unit that a text begins with, "m" of "m (meter)" or "[m below NAP]",
    or its first word."""
    return next(iter(re.findall(r"[a-z0-9/%°]+", plain(text))), "")


def quantity_of(name: str) -> str:
    """Return the quantity of a name, "" if none: in words, with or without its symbol,
    as in "Spitzendruck qc"."""
    words = [w for w in re.split(r"[^a-z0-9]+", name) if w and w not in FILLERS]
    if found := BY_WORD.get("".join(words)):
        return found
    symbols = [w for w in words if w in BY_WORD and len(w) <= LONGEST_SYMBOL]
    rest = BY_WORD.get("".join(w for w in words if w not in symbols), "")
    said = {BY_WORD[w] for w in symbols}
    return said.pop() if said in ({rest}, {INSTEAD.get(rest)}) else ""


def head_of(text: str) -> tuple[str, str]:
    """Return quantity and unit of a head such as depth_m, "qc (MPa)" or "Tiefe in m";
    each "" where it is not known or not there."""
    low = plain(text)
    if is_level(low):
        return "", ""
    units = [unit_in(inside) for inside in BRACKETS.findall(low)]
    name = BRACKETS.sub(" ", low)
    unit = next((u for u in reversed(units) if u in EVERY_UNIT), "")
    if not unit and (ends := UNIT_AT_END.fullmatch(name)) and "/pa" not in name:
        name, unit = ends[1], ends[2]
    quantity = quantity_of(name)
    if not quantity and not unit:  # the last word may be a unit that is not known
        name, _, last = re.sub(r"\W+$", "", name).rpartition(" ")
        quantity, units = quantity_of(name), [last]
    return quantity, unit or (units[-1] if units else "")


def is_level(text: str) -> bool:
    """Return whether a head counts from a datum."""
    return bool(DATUMS & set(re.split(r"[^a-z0-9]+", plain(text))))


def fact_of(cells: Sequence[str]) -> tuple[str, float] | None:
    """Return what a line says of the whole test, a key of FACTS and its value, "water"
    and 1.2 of "Assumed GWL:, 1.2 m"; None where it says nothing known."""
    text = " ".join(cell.strip() for cell in cells if cell.strip())
    found = re.fullmatch(r"(\D*?)[\s:=,]*([+-]?\d+(?:[.,]\d+)?)\s*(\D*)", text)
    if not found:
        return None
    name = plain(found[1])
    fact = next((x for x, words in FILE["facts"].items() if re.search(words, name)), "")
    units = map(unit_in, (found[3], *BRACKETS.findall(found[1])))
    factor = next((LENGTH[unit] for unit in units if unit in LENGTH), 1.0)
    return (fact, float(found[2].replace(",", ".")) * factor) if fact else None
