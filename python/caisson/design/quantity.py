# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers with units, as they are typed: 40mm, "45 MPa", 2500kN, "8.5 kN/m3", 85%."""
import argparse
import math
import re
from collections.abc import Callable, Mapping

# the unit of a number without one, and those that may be given
UNITS: dict[str, Mapping[str, float]] = {
    "m": {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "ft": 0.3048},
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}
    | {"N/m2": 1.0, "kN/m2": 1e3, "MN/m2": 1e6, "N/mm2": 1e6, "bar": 1e5, "mbar": 1e2}
    | {"psi": 6894.757, "ksf": 47880.26, "tsf": 95760.52, "kgf/cm2": 98066.5},
    "N": {"N": 1.0, "kN": 1e3, "MN": 1e6},
    "kN/m3": {"kN/m3": 1.0, "N/m3": 1e-3, "MN/m3": 1e3},
    "kg/m3": {"kg/m3": 1.0, "t/m3": 1e3, "g/cm3": 1e3},
    "m/s": {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3},
    "degrees": dict.fromkeys(("degrees", "degree", "deg", "°"), 1.0),
    "": {"%": 1e-2},
}
EVERY = {word for units in UNITS.values() for word in units}
UNSIGNED = r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
LEAST_ANGLE = 1.0  # degrees; a smaller number may be a tangent
NUMBER = rf"[+-]?{UNSIGNED}"


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


def refuse_tangent(text: str) -> None:
    """Refuse an angle of friction without a unit that is so small that it may be the
    tangent. Raises ValueError with what to write."""
    if re.fullmatch(NUMBER, text) and 0 < (value := float(text)) < LEAST_ANGLE:
        angle = math.degrees(math.atan(value))
        raise ValueError(
            f"{text}: if this is the tangent write {angle:.3g}; if it is an angle"
            f" append deg, as in {text}deg"
        )


def angle_of_friction(text: str) -> float:
    """Return an angle of friction (degrees), as an option is read."""
    try:
        refuse_tangent(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error
    return number("degrees")(text)


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
