# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run leaves, of made-up numbers."""
import json
import re
from pathlib import Path
from typing import Any

from caisson import disk
from caisson.paths import ROOT
from caisson.results import Table
from caisson.table import write_csv

disk.DPI = 40  # of pictures, at which nobody looks


def write_columns(path: Path, table: Table) -> None:
    """Write the columns [n_rows] to a .csv file."""
    rows = list(zip(*(column.tolist() for column in table.values())))
    write_csv(path, list(table), rows)


SETTINGS = (ROOT / "source/water/design_settings.cc").read_text(encoding="utf-8")
# entries of section Design with their defaults, as the program has them in run.json
DESIGN = {
    f"Design/{name}": value
    for name, value in re.findall(r'\{"([^"]+)",\s*([\d.e]+),', SETTINGS)
}


def write_run(directory: Path, history: Table, summary: dict[str, Any] | None) -> None:
    """Write history.csv and, unless the run goes on, run.json."""
    directory.mkdir(parents=True, exist_ok=True)
    write_columns(directory / "history.csv", history)
    if summary is not None:
        if "scene" in summary:
            summary = {**summary, "defaults": DESIGN | summary.get("defaults", {})}
        (directory / "run.json").write_text(json.dumps(summary), encoding="utf-8")
