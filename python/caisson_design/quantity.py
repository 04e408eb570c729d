# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers with units, as they are typed: 40mm, "45 MPa", 2500kN, "8.5 kN/m3", 85%."""
import argparse
import re
from collections.abc import Callable, Mapping

# the unit of a number without one, and those that may be given
UNITS: dict[str, Mapping[str, float]] = {
    "m": {"m": 1.0, "cm": 1e-2, "mm": 1e-3},
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}
    | {"N/m2": 1.0, "kN/m2": 1e3, "MN/m2": 1e6, "N/mm2": 1e6},
    "N": {"N": 1.0, "kN": 1e3, "MN": 1e6},
    "kN/m3": {"kN/m3": 1.0, "N/m3": 1e-3, "MN/m3": 1e3},
    "kg/m3": {"kg/m3": 1.0, "t/m3": 1e3, "g/cm3": 1e3},
    "m/s": {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3},
    "degrees": dict.fromkeys(("degrees", "degree", "deg", "°"), 1.0),
    "": {"%": 1e-2},
}
EVERY = {word for units in UNITS.values() for word in units}
# a unit behind a number or a parenthesis within an expression
WITH_UNIT = re.compile(
    rf"(?<=[\d.)])\s*({'|'.join(map(re.escape, sorted(EVERY, key=len)))})(?![\w/])"
)
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"


def plain(unit: str) -> str:
    """Return a unit without powers."""
    return unit.replace("²", "2").replace("³", "3")


def factor_of(text: str, word: str, unit: str) -> float:
    """Return what a unit multiplies a number with that is wanted in another. Raises
    ValueError."""
    found = UNITS.get(unit, {}).get(plain(word))
    if found is None:
        known = ", ".join(UNITS.get(unit, {})) or "none"
        raise ValueError(f"{text!r}: {word!r} is no unit of it; known: {known}")
    return found


def value_of(text: str, unit: str) -> float:
    """Return a number in this unit; the text may have another one. Raises ValueError
    with what is wrong."""
    if re.match(r"[+-]?\d*,\d", text.strip()):
        point = text.strip().replace(",", ".", 1)
        raise ValueError(f"{text!r} has a decimal comma; write {point}")
    found = re.fullmatch(rf"({NUMBER})\s*([^\d\s].*|)", text.strip())
    if not found:
        raise ValueError(f"{text!r} is no number")
    factor = factor_of(text, found[2], unit) if found[2] else 1.0
    return float(f"{float(found[1]) * factor:.12g}")


def has_unit(text: str) -> bool:
    """Return whether a number or an expression ends with a unit."""
    found = re.fullmatch(r".*?[\d.)]\s*((?![eE][+-]?\d)[A-Za-z%°][^\s(*]*)", text)
    return found is not None and plain(found[1]) in EVERY


def in_parentheses(text: str, body: str, word: str) -> str:
    """Return how an expression that ends with a unit is to be written."""
    if {plain(unit) for unit in WITH_UNIT.findall(body)} - {plain(word)}:
        return f"{text!r}: give all of it in one unit, as in (20 + 2*d) {word}"
    body = WITH_UNIT.sub("", body)
    return f"{text!r}: put what the unit belongs to in parentheses: ({body}) {word}"


def parts_of(text: str) -> list[str]:
    """Return the parts of a text between commas; those within parentheses, as in
    min(5, d), divide nothing."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter == "(") - (letter == ")")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def without_unit(text: str, unit: str) -> str:
    """Return the value of an entry, a number or an expression, in the unit of the
    entry. Raises ValueError where the text ends with another unit than one of it."""
    found = re.fullmatch(r"(.*[\d.)])\s*((?![eE][+-]?\d)[A-Za-z%°].*)", text)
    if re.fullmatch(NUMBER, text):
        return text
    after_word = re.fullmatch(r"(.*[A-Za-z_])\s+(\S+)", text)
    if unit and after_word and plain(after_word[2]) in EVERY:
        raise ValueError(in_parentheses(text, after_word[1], after_word[2]))
    if not found:
        return text
    if re.fullmatch(NUMBER, found[1]):
        return f"{value_of(text, unit):.10g}"
    if plain(found[2]) not in EVERY:
        return text
    if WITH_UNIT.search(found[1]):
        raise ValueError(in_parentheses(text, found[1], found[2]))
    whole = found[1] if re.fullmatch(r"\([^()]*\)", found[1]) else f"({found[1]})"
    return f"{factor_of(text, found[2], unit):g}*{whole}"


def number(unit: str) -> Callable[[str], float]:
    """Return what reads an option in this unit."""

    def read(text: str) -> float:
        try:
            return value_of(text, unit)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return read


def length(text: str) -> float:
    """Return a length in m; the text may end with mm, cm or m."""
    try:
        value = value_of(text, "m")
    except ValueError as error:
        comma = f": {error}" if "," in text else ", as 0.04 or 40mm are"
        raise argparse.ArgumentTypeError(f"{text!r} is no length{comma}") from error
    if not 0 < value < 1e4:
        raise argparse.ArgumentTypeError(f"{text!r} is no length, as 0.04 or 40mm are")
    return value
