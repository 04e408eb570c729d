# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables as Markdown and as .csv."""
import csv
import io
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from caisson import disk

if TYPE_CHECKING:
    from caisson.shown import Units

NOTHING = 5e-4  # of a unit of a table


def number(value: float | None, digits: int = 5) -> str:
    """Return a number with some digits, "-" for none."""
    return "-" if value is None else f"{value:.{digits}g}"


def text_of(value: float) -> str:
    """Return three digits, more before the point; nothing for what is no number."""
    if not math.isfinite(value):
        return ""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def cell(value: object) -> str:
    """Return what a cell shows: text, or a number with three digits and all that
    are before the point."""
    if not isinstance(value, float):
        return str(value).replace("|", "\\|")
    if abs(value) >= 100:
        return f"{value:.0f}"
    return f"{value:.2e}" if 0 < abs(value) < 1e-3 else f"{value:.3g}"


def markdown(columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """Return a table whose columns stand below each other in the source too."""
    lines = [list(columns)] + [[cell(value) for value in row] for row in rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(columns))]

    def text(line: Sequence[str]) -> str:
        padded = [entry.ljust(width) for entry, width in zip(line, widths)]
        return "| " + " | ".join(padded) + " |"

    rule = "|" + "|".join("-" * (width + 2) for width in widths) + "|"
    return "\n".join([text(lines[0]), rule, *map(text, lines[1:])])


def by_rows(columns: Mapping[str, Iterable[str]]) -> dict[str, Any]:
    """Return columns of text as heads and rows, as pages take them."""
    return {"heads": list(columns), "rows": list(map(list, zip(*columns.values())))}


def shown_text(value: Any, factor: float) -> str:
    """Return a word as it is, and a number times a factor; next to nothing is 0."""
    if isinstance(value, str):
        return value
    number = factor * float(value)
    return text_of(0.0 if abs(number) < NOTHING else number)


def in_units(columns: Mapping[str, Any], shown: "Units") -> dict[str, Any]:
    """Return columns of words or numbers [n], whose heads name their units, as heads
    and rows in the units shown; those that are empty are left out."""
    return by_rows(
        {
            shown.named(head): [shown_text(x, shown.factor_of(head)) for x in values]
            for head, values in columns.items()
            if len(values)
        }
    )


def text_cell(value: Any) -> Any:
    """Return a cell that a spreadsheet does not take for a formula: a text that begins
    as one gets a mark for text before it."""
    if not isinstance(value, str) or not re.match(r"\s*[=+\-@]\s*\S", value):
        return value
    try:
        float(value)
    except ValueError:
        return f"'{value}"
    return value


def write_csv(
    path: Path,
    columns: Sequence[str],
    rows: Sequence[Sequence[Any]],
    remarks: Sequence[str] = (),
) -> Path:
    """Write a table with all digits, below remarks; return its path."""
    text = io.StringIO(newline="")
    text.writelines(f"{line}\n" for line in disk.remarks("#", remarks))
    cells = ([text_cell(value) for value in row] for row in [columns, *rows])
    csv.writer(text, lineterminator="\n").writerows(cells)
    return disk.write(path, text.getvalue())


def digits(value: float | None, number: int = 6) -> str:
    """Return a number for a cell, empty for what is not known."""
    return "" if value is None or not math.isfinite(value) else f"{value:.{number}g}"


def write_columns(
    path: Path, columns: Mapping[str, Iterable[float]], number: int = 6
) -> Path:
    """Write columns of numbers with so many digits; return the path."""
    rows = zip(*columns.values())
    texts = [[digits(float(value), number) for value in row] for row in rows]
    return write_csv(path, list(columns), texts)
