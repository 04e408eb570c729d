# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the files of cone penetration tests have in common: a table whose columns are
quantities with units."""
import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

from caisson_design import InputError

LENGTH = {"m": 1.0, "meter": 1.0, "metre": 1.0, "cm": 1e-2, "mm": 1e-3}
STRESS = {
    **dict.fromkeys(("pa", "n/m2"), 1.0),
    **dict.fromkeys(("kpa", "kn/m2"), 1e3),
    **dict.fromkeys(("mpa", "mn/m2", "n/mm2"), 1e6),
    "bar": 1e5,
}
UNITS: dict[str, Mapping[str, float]] = {
    "depth": LENGTH,
    "qc": STRESS,
    "fs": STRESS,
    "u2": STRESS,
}
NAMES = {
    "depth": "depth",
    "qc": "cone resistance",
    "fs": "sleeve friction",
    "u2": "pore pressure",
}
NEEDED = ("depth", "qc")
MOST = 10  # rows that a message names


class Column(NamedTuple):
    """Where a quantity is, and its unit in m or Pa."""

    place: int
    unit: float


@dataclass(frozen=True)
class Table:
    """The rows of a test with their numbers in the file, and the columns by quantity.

    n_cells: of a row; unread: heads that were not read; units_are: where the units
    stand; advice: for a row with more cells; may_be_empty: whether a cell without a
    value is no mistake; area_ratio: of the cone, net, where the file has one.
    """

    columns: Mapping[str, Column]
    rows: Sequence[tuple[int, list[str]]]
    n_cells: int
    unread: tuple[str, ...]
    units_are: str
    advice: str
    may_be_empty: bool = False
    area_ratio: float | None = None


def plain(text: str) -> str:
    """Return a text in small letters, without accents and powers: mn/m2 of MN/m²."""
    letters = unicodedata.normalize("NFKD", text.casefold())
    return "".join(c for c in letters if not unicodedata.combining(c) and c != "^")


def unit_of(path: Path, row: int, head: str, quantity: str, text: str) -> float:
    """Return a unit in m or Pa. Raises InputError."""
    units = UNITS[quantity]
    word = re.sub(r"\s", "", plain(text))
    if word not in units:
        raise InputError(
            f"{path}, row {row}: the unit {text!r} of {head}, the {NAMES[quantity]}, is"
            f" not known; known are {', '.join(units)}"
        )
    return units[word]


def refuse(path: Path, wrong: Sequence[tuple[int, str]]) -> None:
    """Raise InputError with all rows that are wrong, if there are some."""
    if not wrong:
        return
    texts = [f"{path}, row {row}: {why}" for row, why in wrong[:MOST]]
    if len(wrong) > MOST:
        rows = ", ".join(str(row) for row, _ in wrong[MOST : 3 * MOST])
        more = ", ..." if len(wrong) > 3 * MOST else ""
        texts.append(f"{path}: {len(wrong) - MOST} more rows are wrong: {rows}{more}")
    raise InputError("\n".join(texts))
