# SPDX-License-Identifier: LGPL-2.1-or-later
"""The quantities of cone penetration tests, and what files call them: the only table of
names and units, for all formats."""
import re
import tomllib
import unicodedata
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

LENGTH = {
    **dict.fromkeys(("m", "meter", "metre", "metres", "meters"), 1.0),
    **dict.fromkeys(("mbgl", "mbsf", "mbml"), 1.0),
    "cm": 1e-2,
    "mm": 1e-3,
}
STRESS = {
    **dict.fromkeys(("pa", "n/m2"), 1.0),
    **dict.fromkeys(("kpa", "kn/m2"), 1e3),
    **dict.fromkeys(("mpa", "mn/m2", "n/mm2"), 1e6),
    "bar": 1e5,
}
RATIO = {"%": 1e-2}
EVERY_UNIT = LENGTH | STRESS | RATIO


class Quantity(NamedTuple):
    """What a column can be: its name, its units, its heading in AGS 4, its number in
    GEF, its place in a record of BRO-XML from 0, the unit without one, and its names in
    English, German, Dutch and French, without blanks and accents."""

    name: str
    units: Mapping[str, float]
    ags: str
    gef: int
    bro: int
    usual: str
    words: str


WORDS = Path(__file__).with_suffix(".toml")
KINDS = {"length": LENGTH, "stress": STRESS, "ratio": RATIO}
QUANTITIES = {
    key: Quantity(units=KINDS[found.pop("units")], **found)
    for key, found in tomllib.loads(WORDS.read_text(encoding="utf-8")).items()
}
# what lines above the heads may say of the whole test
FACTS = {
    "area ratio": r"(?<!sleeve )(?<!friction )\ba(rea)?[ -]?ratio|oppervlaktequotient",
    "predrilled": r"pre[ -]?(drill|dug|bor|excavat)|voorge(boord|graven)|voorbor"
    r"|vor(ge)?bohr|avant[ -]?trou|preforage",
    "water": r"\bgw[lt]\b|water ?(level|table)|ground ?water|grund ?wasser|grond ?water"
    r"|waterstand|\bnappe\b",
}
BY_WORD = {word: key for key, q in QUANTITIES.items() for word in q.words.split()}
INSTEAD = {"depth": "rods", "qc": "qt"}  # where a file has no column of the first
NEEDED = ("depth", "qc")
# a head with one of these counts from a datum, and not from the ground
DATUMS = frozenset("nap nhn nn taw ngf lat msl elevation kote hoogte hohe".split())
FILLERS = frozenset("in en the of measured gemessen gemeten mesuree".split())
BRACKETS = re.compile(r"[\[({<]([^\])}>]*)[\])}>]?")
UNIT_AT_END = re.compile(
    rf"(.*[a-z0-9])[\s_,;:/]+({'|'.join(sorted(EVERY_UNIT, key=len, reverse=True))})\W*"
)


def plain(text: str) -> str:
    """Return a text in small letters, without accents and powers: mn/m2 of MN / m²."""
    letters = unicodedata.normalize("NFKD", text.casefold().replace("_", " "))
    letters = "".join(c for c in letters if not unicodedata.combining(c) and c != "^")
    return re.sub(r"\s*/\s*", "/", letters).strip()


def unit_in(text: str) -> str:
    """Return the unit that a text begins with, "m" of "m (meter)" or "[m below NAP]",
    or its first word."""
    words = re.findall(r"[a-z0-9/%°]+", plain(text))
    return words[0] if words else ""


def quantity_of(name: str) -> str:
    """Return the quantity of a name, "" if none: in words, with or without its symbol,
    as in "Spitzendruck qc"."""
    words = [w for w in re.split(r"[^a-z0-9]+", name) if w and w not in FILLERS]
    if found := BY_WORD.get("".join(words)):
        return found
    symbols = {w for w in words if w in QUANTITIES}
    found = BY_WORD.get("".join(w for w in words if w not in QUANTITIES), "")
    if len(symbols) == 1 and found:
        symbol = symbols.pop()
        return symbol if symbol in (found, INSTEAD.get(found)) else ""
    return ""


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
    for fact, words in FACTS.items() if found else ():
        assert found is not None
        if re.search(words, plain(found[1])):
            units = map(unit_in, (found[3], *BRACKETS.findall(found[1])))
            factor = next((LENGTH[unit] for unit in units if unit in LENGTH), 1.0)
            return fact, float(found[2].replace(",", ".")) * factor
    return None
