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
    **dict.fromkeys(("ft", "feet", "foot"), 0.3048),
}
POUND, KILOPOND = 4.4482216152605, 9.80665  # N
SQUARE_FOOT = 0.3048**2  # m2
STRESS = {
    **dict.fromkeys(("pa", "n/m2"), 1.0),
    **dict.fromkeys(("kpa", "kn/m2"), 1e3),
    **dict.fromkeys(("mpa", "mn/m2", "n/mm2"), 1e6),
    **dict.fromkeys(("bar", "dan/cm2"), 1e5),
    **dict.fromkeys(("mbar", "hpa"), 1e2),
    **dict.fromkeys(("kg/cm2", "kgf/cm2", "kp/cm2", "kg/cmq"), 1e4 * KILOPOND),
    **dict.fromkeys(("t/m2", "tf/m2"), 1e3 * KILOPOND),  # metric tons
    **dict.fromkeys(
        ("tsf", "tonf/ft2", "tons/ft2", "ton/ft2"), 2e3 * POUND / SQUARE_FOOT
    ),
    **dict.fromkeys(("ksf", "kip/ft2", "kips/ft2"), 1e3 * POUND / SQUARE_FOOT),
    **dict.fromkeys(("psf", "lb/ft2", "lbf/ft2"), POUND / SQUARE_FOOT),
    **dict.fromkeys(("psi", "lb/in2", "lbf/in2"), 144 * POUND / SQUARE_FOOT),
}
# where a file has a quantity twice, in metric units, too, these are left
CUSTOMARY = frozenset(
    unit for unit in (*LENGTH, *STRESS) if re.search("f(ee|oo)?t|in2|[kpt]s[if]", unit)
)
RATIO = {"%": 1e-2}
EVERY_UNIT = LENGTH | STRESS | RATIO


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
    r"|vor(ge)?bohr|avant[ -]?trou|preforage|preforo|forbor",
    "water": r"\bgw[lt]\b|water ?(level|table)|ground ?water|grund ?wasser|grond ?water"
    r"|waterstand|\bnappe\b",
}
BY_WORD = {word: key for key, q in QUANTITIES.items() for word in q.words.split()}
BY_WORD |= {q.ags.replace("_", "").lower(): k for k, q in QUANTITIES.items() if q.ags}
LONGEST_SYMBOL = 2  # letters: qc, u2, Rp
INSTEAD = {"depth": "rods", "qc": "qt"}  # where a file has no column of the first
NEEDED = ("depth", "qc")
# a head with one of these counts from a datum, and not from the ground
DATUMS = frozenset(
    "nap nhn nn taw ngf lat msl elevation kote hoogte hohe quota cota rzedna".split()
)
FILLERS = frozenset(
    "in en the of measured gemessen gemeten mesuree misurata medida malt".split()
)
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
    words = re.findall(r"[a-z0-9/%°]+", plain(text))
    return words[0] if words else ""


def quantity_of(name: str) -> str:
    """Return the quantity of a name, "" if none: in words, with or without its symbol,
    as in "Spitzendruck qc"."""
    words = [w for w in re.split(r"[^a-z0-9]+", name) if w and w not in FILLERS]
    if found := BY_WORD.get("".join(words)):
        return found
    is_symbol = [w in BY_WORD and len(w) <= LONGEST_SYMBOL for w in words]
    symbols = {BY_WORD[w] for w, is_it in zip(words, is_symbol) if is_it}
    rest = "".join(w for w, is_it in zip(words, is_symbol) if not is_it)
    found = BY_WORD.get(rest, "")
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
