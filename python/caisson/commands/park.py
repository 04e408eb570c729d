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
import json
import re
import time
from collections.abc import Iterator
from pathlib import Path

from caisson import disk, study_command
from caisson.band import ESTIMATES, member_of
from caisson.commands import park_rows, park_study
from caisson.commands.park_rows import Position
from caisson.disk import InputError
from caisson.paths import RESULTS, short
from caisson.runner import Run
from caisson.runs import StudyRun
from caisson.study import file_name
from caisson.suggest import percent
from caisson.suggest.sizes import LEVELS

KNOWN = "positions.json"  # what the scenes rest on, by the name of a position


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson park`."""
    add = parser.add_argument
    add("positions", type=Path, metavar="positions.csv", help="the table")
    text = "wanted, in %%, of positions whose row has none"
    add("--error", type=percent, choices=LEVELS, default=5, help=text)
    add("--out", type=Path, metavar="DIR", help="of the results")
    add("--check", action="store_true", help="write the scenes, and run nothing")
    study_command.add_running_arguments(parser)


def cost_of(name: str, file: Path) -> str:
    """Return how long the run of a position takes and how many warnings it has, by what
    `caisson suggest` has said of it."""
    said = disk.read_text(file) if file.is_file() else ""
    time = re.search(r"^ *duration +([^:\n]+)", said, re.M)
    n = len(re.findall(r"^ *warning\b", said, re.I | re.M))
    warnings = "1 warning" if n == 1 else f"{n} warnings"
    how_long = time[1] if time else "duration not known"
    return f"{name}: {how_long}, {warnings}: {short(file)}"


def prepare(table: Path, error: int, folder: Path) -> list[Position]:
    """Write the scenes of a table into a folder, as far as they are not there; return
    its positions. Raises InputError."""
    positions, known = park_rows.read(table, error), folder / KNOWN
    wrong = park_rows.wrong_names(table, positions)
    if wrong:
        raise InputError("\n".join(wrong))
    disk.claim(folder, table, "give another folder by --out DIR")
    for name in (KNOWN, park_study.PAGE, park_study.TABLE, park_study.PICTURE):
        disk.refuse_input(folder / name)
    try:
        before = json.loads(disk.read_text(known))
    except (InputError, ValueError):  # there is none, or a broken one
        before = {}
    records = {p.name: park_rows.record_of(table, p) for p in positions}
    scenes = folder / "scenes"
    new = [
        p
        for p in positions
        if before.get(p.name) != records[p.name]
        or not (scenes / f"{file_name(p.name)}.prm").is_file()
    ]
    park_rows.write_scenes(table, new, scenes)
    disk.write(known, json.dumps(records, indent=1))
    print(f"positions: {len(positions)}, of which new or changed: {len(new)}")
    for position in positions:
        print(cost_of(position.name, scenes / f"{file_name(position.name)}.txt"))
    return positions


def runs_of(position: Position, folder: Path, program: Path) -> Iterator[StudyRun]:
    """Yield the run of a position, and those of its low and high estimate."""
    best = folder / "scenes" / f"{file_name(position.name)}.prm"
    for estimate in ESTIMATES:
        if (scene := member_of(best, estimate)).is_file():
            place = folder / "runs" / scene.stem
            run = Run(scene.resolve(), directory=place.resolve(), program=program)
            known = {"position": position.name, "estimate": estimate}
            yield StudyRun("runs", scene.stem, run, known)


def main(options: argparse.Namespace) -> int:
    """Write scenes, run what is missing, and write the overview."""
    folder: Path = options.out or RESULTS / "park" / file_name(options.positions.stem)
    begin, positions = time.monotonic(), prepare(
        options.positions, options.error, folder
    )
    if options.check:
        print(f"park: {short(folder / 'scenes')}")
        return 0
    program = options.program.resolve()
    runs = [run for p in positions for run in runs_of(p, folder, program)]
    status = study_command.run_missing(runs, options)
    if status is not None:
        return status
    minutes = (time.monotonic() - begin) / 60
    return park_study.evaluate(options.positions.name, runs, folder, minutes)
