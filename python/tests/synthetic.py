# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run leaves, of made-up numbers."""
import json
from pathlib import Path
from typing import Any

from caisson.results import Table
from caisson.table import write_csv


def write_columns(path: Path, table: Table) -> None:
    """Write the columns [n_rows] to a .csv file."""
    rows = list(zip(*(column.tolist() for column in table.values())))
    write_csv(path, list(table), rows)


def write_run(directory: Path, history: Table, summary: dict[str, Any] | None) -> None:
    """Write history.csv and, unless the run goes on, run.json."""
    directory.mkdir(parents=True, exist_ok=True)
    write_columns(directory / "history.csv", history)
    if summary is not None:
        (directory / "run.json").write_text(json.dumps(summary), encoding="utf-8")
