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
import concurrent.futures
import json
import math
import re
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from caisson import disk, plot, report, study_command
from caisson.band import BEST, ESTIMATES, HIGH, LOW, band_of, member_of
from caisson.commands import park_rows
from caisson.commands.park_rows import Position
from caisson.disk import InputError
from caisson.paths import RESULTS, short
from caisson.ranks import cores
from caisson.report import low_and_high, verdict
from caisson.results import Results
from caisson.runner import Run
from caisson.runs import COMPLETE, StudyRun
from caisson.study import file_name
from caisson.suggest import percent
from caisson.suggest.sizes import LEVELS
from caisson.table import digits, write_csv
from caisson.template import template
from caisson.verdict import installation, outcome, uncertainty

HERE = Path(__file__).parent
KNOWN = "positions.json"  # what the scenes rest on, by the name of a position
EVERY, USUAL_ERROR = "", 5  # in the place of a name; %
PAGE, TABLE, PICTURE = "overview.html", "overview.csv", "overview.png"
COLORS = ("#2166ac", "#d95f02", "#1b9e77", "#7570b3", "#a6761d", "#e7298a", "#666666")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson park`."""
    add = parser.add_argument
    add("positions", type=Path, metavar="positions.csv", help="the table")
    text = "wanted, in %%, of rows that have none; default: as last time, or 5"
    add("--error", type=percent, choices=LEVELS, help=text)
    add("--out", type=Path, metavar="DIR", help="of the results")
    add("--check", action="store_true", help="write the scenes, and run nothing")
    study_command.add_running_arguments(parser)


def cost_of(name: str, scene: Path) -> str:
    """Return how long the runs of a position take and how many warnings its scene has,
    by what `caisson suggest` has said of it."""
    file = scene.with_suffix(".txt")
    runs = sum(member_of(scene, estimate).is_file() for estimate in ESTIMATES)
    each = f" for each of {runs}" if runs > 1 else ""
    said = disk.read_text(file) if file.is_file() else ""
    time = re.search(r"^ *duration +([^:\n]+)", said, re.M)
    n = len(re.findall(r"^ *warning\b", said, re.I | re.M))
    warnings = "1 warning" if n == 1 else f"{n} warnings"
    how_long = time[1] if time else "duration not known"
    return f"{name}: {how_long}{each}, {warnings}: {short(file)}"


def prepare(table: Path, error: int | None, folder: Path) -> list[Position]:
    """Write the scenes of a table into a folder, as far as they are not there; return
    its positions. error: None for that of the call before. Raises InputError."""
    known = folder / KNOWN
    try:
        before = dict(json.loads(disk.read_text(known)))
        error = error or int(before[EVERY]["error"])
    except (InputError, *disk.DAMAGE):  # there is none, or a broken one
        before = {}
    positions = park_rows.read(table, error or USUAL_ERROR)
    wrong = park_rows.wrong_names(table, positions)
    if wrong:
        raise InputError("\n".join(wrong))
    disk.claim(folder, table, "give another folder by --out DIR")
    for name in (KNOWN, PAGE, TABLE, PICTURE):
        disk.refuse_input(folder / name)
    records = {p.name: park_rows.record_of(table, p) for p in positions}
    scenes = folder / "scenes"
    new = [
        p
        for p in positions
        if before.get(p.name) != records[p.name]
        or not (scenes / f"{file_name(p.name)}.prm").is_file()
    ]
    park_rows.write_scenes(table, new, scenes)
    every = {EVERY: {"error": str(error or USUAL_ERROR)}}
    disk.write(known, json.dumps(records | every, indent=1))
    print(f"positions: {len(positions)}, of which new or changed: {len(new)}")
    for position in positions:
        print(cost_of(position.name, scenes / f"{file_name(position.name)}.prm"))
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


class Row(NamedTuple):
    """A position, as overview.csv has it: what is said of it, numbers that are nan
    where they are not known, and its page from the folder of the overview, "" for
    none. utilization: the largest share of the allowable suction that is required;
    with_uncertainty_to_m: how deep it is feasible with low and high resistance and the
    upper value of its uncertainty, if that is less."""

    position: str
    utilization: float = math.nan
    governed_by: str = ""
    feasible_to_m: float = math.nan
    with_uncertainty_to_m: float = math.nan
    planned_m: float = math.nan
    self_weight_penetration_m: float = math.nan
    largest_suction_kPa: float = math.nan
    verdict: str = ""
    page: str = ""
    is_complete: bool = True

    @property
    def reached(self) -> float:
        """The share of the planned way that is feasible; 1 where it is not known."""
        ends = self.feasible_to_m, self.with_uncertainty_to_m
        share = np.nanmin([*ends, math.inf]) / (self.planned_m or math.nan)
        return min(share, 1.0) if math.isfinite(share) else 1.0

    @property
    def is_feasible(self) -> bool:
        """Whether it goes in, with its uncertainty, too."""
        return not (self.utilization >= 1 or self.with_uncertainty_to_m > 0)

    @property
    def rank(self) -> tuple[bool, float, float]:
        """Its place: runs without a result, and then the worst, come first."""
        share = self.utilization if math.isfinite(self.utilization) else -1.0
        return self.is_complete, self.reached, -share


def page_of(directory: Path) -> str:
    """Draw the pictures and write the page of a run, if it has none as new as its
    results and those of its band; return why there is none, "" where there is."""
    if report.is_up_to_date(*(member_of(directory, x) for x in (BEST, LOW, HIGH))):
        return ""
    try:
        plot.draw(directory)
        report.write(directory)
    except Exception as error:  # whatever it is, the run was good
        return f"no page of {directory}: {type(error).__name__}: {error}"
    return ""


def row_of(run: StudyRun, folder: Path) -> Row:
    """Return what has become of a position."""
    page = run.run.directory / report.NAME
    link = str(page.relative_to(folder.resolve())) if page.is_file() else ""
    name = run.settings["position"]
    try:
        if run.outcome[0] == COMPLETE:
            return with_numbers(Row(name, page=link), run.results)
        why = run.words
    except Exception as error:  # whatever it is, there are other positions
        why = disk.words_of(error)
    return Row(name, verdict=f"No result ({why}).", page=link, is_complete=False)


def with_numbers(row: Row, run: Results) -> Row:
    """Return a row with what a run says."""
    said = verdict.verdict_of(run)
    found = installation.installation_of(run, installation.Rate())
    words = f"{said.text} {low_and_high.sentence_of(run)}".strip()
    row = row._replace(verdict=words or "The run says nothing.")
    if found is None:
        return row
    part = verdict.feasible_part(run, found, said.end)
    end, members = said.end or float(found.depth[-1]), band_of(run)
    upper = uncertainty.end_of_upper(run, members) or math.inf
    least = min(upper, *map(outcome.feasible_to, members.values()))
    row = row._replace(
        feasible_to_m=end,
        with_uncertainty_to_m=least if least < end else math.nan,
        planned_m=run.planned or math.nan,
        self_weight_penetration_m=math.nan if found.rest is None else found.rest,
    )
    if not len(part.required):
        return row
    with np.errstate(invalid="ignore", divide="ignore"):
        # where nothing is allowed, as where the plug meets the lid, suction ends
        shares = np.nan_to_num(part.utilization, posinf=1.0)
    i = int(np.argmax(shares))
    share = max(1.0, float(shares[i])) if said.end is not None else float(shares[i])
    name = said.reason or (part.governing(i) if share > 0 else "")
    most = float(part.required.max())
    return row._replace(utilization=share, governed_by=name, largest_suction_kPa=most)


def draw(path: Path, rows: Sequence[Row]) -> Path:
    """Draw the utilization of the positions, the worst above; return the path."""
    figure = Figure(figsize=(8, 1.6 + 0.3 * len(rows)))
    axes = figure.subplots()
    limits = list(dict.fromkeys(row.governed_by for row in rows if row.governed_by))
    for i, row in enumerate(rows):
        if math.isfinite(row.utilization):
            number = limits.index(row.governed_by) if row.governed_by else -1
            axes.barh(i, row.utilization, color=COLORS[number % len(COLORS)])
        place = row.utilization if math.isfinite(row.utilization) else 0.0
        text = f"{place:.2f}" if row.is_complete else "no result"
        if row.is_complete and not math.isfinite(row.utilization):
            text = "no suction"
        if row.is_complete and row.reached < 1:
            text += f", to {row.feasible_to_m:.3g} of {row.planned_m:.3g} m"
        axes.text(place, i, f" {text}", va="center", fontsize=8)
    for number, name in enumerate(limits):
        axes.barh(0, 0, color=COLORS[number % len(COLORS)], label=name)
    axes.axvline(1, color="#c0392b", linestyle="--", label="allowable")
    axes.set_yticks(range(len(rows)), [row.position for row in rows], fontsize=8)
    axes.set_ylim(len(rows) - 0.4, -0.6)
    axes.set_xlim(
        0,
        1.45 * max(1.0, *(row.utilization for row in rows if row.utilization > 0), 1.0),
    )
    axes.set_xlabel("required suction / allowable suction, the largest on the way")
    axes.legend(fontsize=8, loc="lower right")
    figure.set_layout_engine("tight")
    return disk.save(figure, path)


def write_table(path: Path, rows: Sequence[Row]) -> Path:
    """Write overview.csv; return its path."""

    def cell(head: str, value: float | str) -> str:
        if isinstance(value, str):
            return value
        return digits(value, 3 if head == "utilization" else 4)

    heads = Row._fields[:-1]
    cells = [[cell(head, getattr(row, head)) for head in heads] for row in rows]
    return write_csv(path, heads, cells)


def evaluate(title: str, runs: Sequence[StudyRun], folder: Path, minutes: float) -> int:
    """Write pages and overview; return 1 where a position has no result."""
    done = [run.run.directory for run in runs if run.outcome[0] == COMPLETE]
    with concurrent.futures.ProcessPoolExecutor(cores()) as pool:
        for trouble in filter(None, pool.map(page_of, done)):
            print(trouble)
    best = [run for run in runs if run.settings["estimate"] == BEST]
    rows = sorted((row_of(run, folder) for run in best), key=lambda row: row.rank)
    complete = [row for row in rows if row.is_complete]
    write_table(folder / TABLE, rows)
    draw(folder / PICTURE, rows)
    css = Path(report.__file__).parent / "page.css"
    text = template(HERE / "overview.html.jinja", digits=digits).render(
        title=disk.one_line(title),
        rows=rows,
        complete=len(complete),
        feasible=sum(row.is_feasible for row in complete),
        style=css.read_text(encoding="utf-8"),
        picture=PICTURE,
        table=TABLE,
    )
    disk.write(folder / PAGE, text)
    for row in rows:
        print(f"{row.position}: {row.verdict}")
    print(f"park: {len(complete)} of {len(rows)} positions in {minutes:.1f} min")
    print(f"next: open {short(folder / PAGE)}")
    return 0 if (len(done), len(complete)) == (len(runs), len(rows)) else 1


def main(options: argparse.Namespace) -> int:
    """Write scenes, run what is missing, and write the overview."""
    folder: Path = options.out or RESULTS / "park" / file_name(options.positions.stem)
    begin = time.monotonic()
    positions = prepare(options.positions, options.error, folder)
    if options.check:
        print(f"park: {short(folder / 'scenes')}")
        return 0
    program = options.program.resolve()
    runs = [run for p in positions for run in runs_of(p, folder, program)]
    status = study_command.run_missing(runs, options)
    if status is not None:
        return status
    minutes = (time.monotonic() - begin) / 60
    return evaluate(options.positions.name, runs, folder, minutes)
