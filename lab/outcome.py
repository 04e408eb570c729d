# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a study of the laboratory leaves: a picture, and its table in two formats."""
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from caisson import table
from caisson.paths import short
from caisson import disk


def write_picture(kind: str, path: Path, figure: Figure) -> None:
    """Write a picture, and say where it is."""
    disk.save(figure, path, dpi=130)
    print(f"{kind}: {short(path)}")


def write_table(
    results: Path,
    columns: Sequence[str],
    rows: Sequence[Sequence[Any]],
    heading: str = "",
) -> None:
    """Write table.csv and, below the heading, table.md; print the table."""
    table.write_csv(results / "table.csv", columns, rows)
    text = table.markdown(columns, rows)
    disk.write(results / "table.md", f"{heading}{text}\n")
    print(text)


def write(
    kind: str,
    results: Path,
    figure: Figure,
    columns: Sequence[str],
    rows: Sequence[Sequence[Any]],
) -> None:
    """Write KIND.png, table.csv and table.md, and print the table."""
    figure.set_layout_engine("tight")
    write_picture(kind, results / f"{kind}.png", figure)
    write_table(results, columns, rows)
