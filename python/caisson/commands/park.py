# SPDX-License-Identifier: LGPL-2.1-or-later
"""Suggests, runs and reports many positions, and writes an overview of them.

    caisson park positions.csv --error 20

A row of the table is a position. Its columns are options of `caisson suggest` with
their units, and its name and soil:

    name,diameter_m,skirt_m,wall_mm,weight_kN,water_depth_m,layers
    A1,8,6,30,3000,30,"0: Dr = 60%; 3: su = 60 kPa"
    A2,8,6,30,3000,32,"0: Dr = 70%"

In place of layers the column cpt may name a cone test. A row with a cone test, or with
the columns low, high or spread, takes three runs, of low, best and high resistance.

All rows are checked before anything runs. Results go to results/park/NAME:
overview.html, overview.csv and overview.png, and a folder for each position below runs.
What is there is kept: the same command goes on where it was stopped, and a run from its
last checkpoint. On a cluster each job of an array takes a part,

    caisson park positions.csv --part $SLURM_ARRAY_TASK_ID/10
    caisson park positions.csv --evaluate

the latter after all of them; or the workers of Dask take the runs, with --dask
tcp://HOST:8786.
"""
import argparse
import re
from pathlib import Path
from typing import Any

from caisson import disk, study_command
from caisson.commands import park_rows, park_study
from caisson.disk import InputError
from caisson.paths import RESULTS, short
from caisson.study import file_name, read_toml
from caisson.suggest import percent
from caisson.suggest.sizes import LEVELS

STUDY = "park.toml"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson park`."""
    add = parser.add_argument
    add("positions", type=Path, metavar="positions.csv", help="the table")
    text = "wanted, in %%, of positions whose row has none"
    add("--error", type=percent, choices=LEVELS, default=5, help=text)
    add("--out", type=Path, metavar="DIR", help="of the results")
    add("--check", action="store_true", help="write the scenes, and run nothing")
    study_command.add_running_arguments(parser)
    parser.set_defaults(only="", quick=False, list=False, again=False)


def known_in(file: Path) -> dict[str, Any]:
    """Return what the scenes of the positions of an earlier call rest on, by name."""
    if not file.is_file():
        return {}
    runs = read_toml(file).get("runs", [])
    return {run["position"]["name"]: run["position"] for run in runs}


def cost_of(name: str, file: Path) -> str:
    """Return how long the run of a position takes and how many warnings it has, by what
    `caisson suggest` has said of it."""
    said = disk.read_text(file) if file.is_file() else ""
    time = re.search(r"^ *duration +([^:\n]+)", said, re.M)
    n = len(re.findall(r"^ *warning\b", said, re.I | re.M))
    warnings = "1 warning" if n == 1 else f"{n} warnings"
    how_long = time[1] if time else "duration not known"
    return f"{name}: {how_long}, {warnings}: {short(file)}"


def prepare(table: Path, error: int, folder: Path) -> Path:
    """Write the scenes of a table and their study into a folder, as far as they are not
    there; return the study. Raises InputError."""
    positions, study = park_rows.read(table, error), folder / STUDY
    wrong = park_rows.wrong_names(table, positions)
    if wrong:
        raise InputError("\n".join(wrong))
    disk.claim(folder, table, "give another folder by --out DIR")
    for name in (STUDY, park_study.PAGE, park_study.TABLE, park_study.PICTURE):
        disk.refuse_input(folder / name)
    known, scenes = known_in(study), folder / "scenes"
    new = [
        p
        for p in positions
        if known.get(p.name) != park_rows.record_of(table, p)
        or not (scenes / f"{file_name(p.name)}.prm").is_file()
    ]
    park_rows.write_scenes(table, new, scenes)
    print(f"positions: {len(positions)}, of which new or changed: {len(new)}")
    for position in positions:
        print(cost_of(position.name, scenes / f"{file_name(position.name)}.txt"))
    return disk.write(study, park_rows.study_of(table, positions, folder))


def main(options: argparse.Namespace) -> int:
    """Write scenes, run what is missing, and write the overview."""
    folder: Path = options.out or RESULTS / "park" / file_name(options.positions.stem)
    study = prepare(options.positions, options.error, folder)
    if options.check:
        print(f"park: {short(study)}")
        return 0
    options.file, options.results = study, folder
    return study_command.main(options)
