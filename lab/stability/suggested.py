# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes that `caisson suggest` writes for caissons and soils drawn at random.

Diameters of 50 mm to 25 m, walls of 0.1 to 5 % of them, skirts of 0.1 to 10 of them,
sand by angle and by density, clay of 2 to 200 kPa that is uniform or grows with depth,
two and three layers, an embedment that is left open, 0 or given, jacked or with a
weight and suction. The same seed gives the same scenes. Each must be written, be
accepted by --validate --strict, and run to a tenth of its skirt, or as far as --seconds
of its estimate go, with status 0, without a warning that is of the tool's own choice
(energy, transfer, a tip force that falls) where it goes two thicknesses of the wall or
more, in at most three times its estimate. Runs that are complete are not repeated.
table.csv and table.md have what each did.
"""
import argparse
import contextlib
import io
import itertools
import math
import random
import re
import shlex
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path

from caisson import __main__ as program
from caisson.paths import RESULTS
from caisson.results import Results, ResultsError
from caisson.runner import Run, RunError, Status, query, read_parameters
from caisson.verdict import run_review
from lab import outcome

NUMBER, QUICK, SEED = 80, 6, 63
SHARE = 0.1  # of the skirt, to which a run goes
SLOWEST = 3.0  # times the estimate
OF_THE_END = "at the end of the way"  # which is not that of the scene
START = 2.0  # thicknesses of the wall, over which forces and energies mean nothing
OWN_CHOICE = re.compile("energy|transfer|falls|limiter|inertia", re.I)
SOILS = (
    "sand by angle",
    "clay",
    "sand by density",
    "growing clay",
    "two layers",
    "three layers",
)
EMBEDMENTS = ("open", "zero", "given")
COLUMNS = [
    "scene",
    "soil",
    "D (m)",
    "skirt (m)",
    "t/D (%)",
    "embedment",
    "weight",
    "verdict",
    "steps",
    "CPU (s)",
    "estimate (s)",
    "note",
    "words",
]


@dataclass
class Case:
    """A caisson in its ground, the words of the command, and what came of them."""

    number: int
    soil: str
    diameter: float
    skirt: float
    wall: float
    embedment: str
    weight: str
    words: list[str]
    faults: list[str] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    steps: str = "-"
    used: float = math.nan
    estimate: float = math.nan

    def line(self) -> list[str]:
        """Return its line of the table."""
        return [
            f"{self.number:02d}",
            self.soil,
            f"{self.diameter:g}",
            f"{self.skirt:g}",
            f"{100 * self.wall / self.diameter:.2g}",
            self.embedment,
            self.weight,
            "FAILS" if self.faults else "passes",
            self.steps,
            *("-" if math.isnan(x) else f"{x:.3g}" for x in (self.used, self.estimate)),
            "; ".join([*self.faults, *self.notes]),
            shlex.join(self.words),
        ]


class Draw:
    """Numbers drawn at random that read well."""

    def __init__(self, seed: str) -> None:
        self.next = random.Random(seed).random

    def between(self, least: float, most: float, digits: int = 2) -> float:
        """Return a number with some digits, its logarithm drawn evenly."""
        value = least * (most / least) ** self.next()
        return min(max(float(f"{value:.{digits}g}"), least), most)

    def choice(self, words: Sequence[str]) -> str:
        """Return one of some words."""
        return words[int(self.next() * len(words))]

    def skirt(self, diameter: float) -> float:
        """Return the length of a skirt: one in ten is the longest or the shortest."""
        ends = 0.1, 10.0
        share = self.next()
        ratio = ends[share < 0.05] if share < 0.1 else self.between(*ends)
        return min(
            max(float(f"{diameter * ratio:.2g}"), ends[0] * diameter),
            ends[1] * diameter,
        )

    def angle_sand(self) -> str:
        """Return sand by its friction angle."""
        return f"phi = {self.between(28, 42):g}, E = {self.between(5, 80):g} MPa"

    def density_sand(self) -> str:
        """Return sand by a word or a number."""
        word = self.choice(("loose", "medium dense", "dense", "very dense", ""))
        return f"Sand = {word}" if word else f"Dr = {self.between(15, 95):g}%"

    def clay(self, grows: bool) -> str:
        """Return undrained clay; E is assumed."""
        if not grows:
            return f"su = {self.between(2, 200):g} kPa"
        top, growth = self.between(2, 50), self.between(0.5, 4)
        return self.choice(
            (
                f"su = ({top:g} + {growth:g}*d) kPa",
                f"su = {top:g} kPa + {growth:g} kPa*z",
            )
        )

    def material(self) -> str:
        """Return any of them."""
        every = (self.angle_sand, self.density_sand)
        clays = tuple(lambda g=g: self.clay(g) for g in (False, True))
        return (every + clays)[int(self.next() * 4)]()

    def layers(self, soil: str, skirt: float) -> list[str]:
        """Return the layers; tops of deeper ones are within the skirt."""
        if soil == "sand by angle":
            return [f"0: {self.angle_sand()}"]
        if soil == "sand by density":
            return [f"0: {self.density_sand()}"]
        if soil in ("clay", "growing clay"):
            return [f"0: {self.clay(soil != 'clay')}"]
        depth, tops = 0.0, ["0"]
        for _ in range(1 if soil == "two layers" else 2):
            depth += self.between(0.04, 0.4) * skirt
            tops.append(f"{depth:.3g}")
        return [f"{top}: {self.material()}" for top in tops]


def case_of(seed: int, number: int) -> Case:
    """Return a case, which depends on nothing but seed and number."""
    draw = Draw(f"{seed}/{number}")
    soil = SOILS[number % len(SOILS)]
    diameter = draw.between(0.05, 25)
    wall = float(f"{diameter * draw.between(0.001, 0.05):.2g}")
    skirt = draw.skirt(diameter)
    embedment = EMBEDMENTS[(number // len(SOILS)) % len(EMBEDMENTS)]
    layers = draw.layers(soil, skirt)
    words = ["--diameter", f"{diameter:g}", "--skirt", f"{skirt:g}"]
    words += ["--wall", f"{1e3 * wall:g}mm", "--error", "20"]
    if embedment != "open":
        share = draw.between(0.01, 0.2) if embedment == "given" else 0.0
        words += ["--embedment", f"{share * skirt:.2g}"]
    weight = "-"
    if embedment != "zero" and draw.next() < 0.7:
        steel = math.pi * diameter * wall * skirt * 68e3  # N, in water
        weight = f"{steel * draw.between(1, 4) / 1e3:.2g}kN"
        words += ["--weight", weight]
        if draw.next() < 0.5:
            words += ["--water-depth", f"{draw.between(1, 100):g}"]
    for layer in layers:
        words += ["--layer", layer]
    return Case(number, soil, diameter, skirt, wall, embedment, weight, words)


def write_scene(case: Case, file: Path) -> bool:
    """Let suggest write the scene; return whether it does."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
        status = program.main(["suggest", *case.words, str(file), "--overwrite"])
    if status != 0:
        case.faults.append("refused: " + " ".join(said.getvalue().split()))
    case.notes += re.findall(r"^warning: (.*)", said.getvalue(), re.M)
    return status == 0


def run_of(file: Path, directory: Path, walls: float | None, share: float = 1) -> Run:
    """Return the run over a share of the way to a tenth of the skirt, or as far again
    below its start; or over so many thicknesses of the wall."""
    entries = read_parameters([str(file)])
    skirt, start, wall = (
        float(entries[f"Rigid body/{name}"])
        for name in ("Skirt length", "Initial penetration", "Wall thickness")
    )
    end = max(SHARE * skirt, start + SHARE / 2 * skirt)
    if walls is not None:
        end = start + walls * wall
    end = start + share * (end - start)
    changes = {"Time/End penetration": f"{end:.6g}", "Output/Frame penetrations": ""}
    return Run(file, {**changes, "Output/Frame interval": "never"}, directory)


def look_at(case: Case, run: Run, is_timed: bool) -> None:
    """Take what a run did into its case, and its time where that counts."""
    lines = (run.directory / "log").read_text("utf-8").strip().splitlines()
    last = lines[-1] if lines else "no log"
    record = run.completion_record()
    if record is None:
        case.faults.append(f"did not end in time: {last}")
        return
    case.used = record["cpu_s"]
    if is_timed and case.used > SLOWEST * case.estimate:
        times = case.used / case.estimate
        case.faults.append(f"took {times:.2g} times its estimate")
    if record["status"] != Status.SUCCESS:
        case.faults.append(f"status {record['status']}: {last}")
        return
    try:
        results = Results(run.directory)
        summary, warnings = results.summary, run_review.warnings_of(results)
    except ResultsError as error:
        case.faults.append(str(error))
        return
    case.steps = f"{summary['steps']}"
    way = (
        float(run.entries["Time/End penetration"])
        - summary["scene"]["initial_penetration_m"]
    )
    is_long = way >= START * case.wall
    for warning in itertools.chain(*warnings.values()):
        is_own = OWN_CHOICE.search(warning) and OF_THE_END not in warning
        kind = case.faults if is_own and is_long else case.notes
        kind.append(warning)


def try_case(case: Case, options: argparse.Namespace) -> Case:
    """Validate and run a case whose scene is written."""
    file = options.results / f"scene_{case.number:02d}.prm"
    directory = options.results / f"scene_{case.number:02d}"
    run = run_of(file, directory, options.walls)
    try:
        query([str(file), "--validate", "--strict"], run.program)
        case.estimate = run.validate().seconds  # of the way to a tenth
        if options.walls is None and case.estimate > options.seconds:
            share = options.seconds / case.estimate
            run = run_of(file, directory, None, share)
            case.estimate = run.validate().seconds
    except RunError as error:
        case.faults.append("refused: " + " ".join(str(error).split()))
        return case
    if not options.validate:
        if not run.is_complete():
            run.execute(options.limit * case.estimate + 60)
        look_at(case, run, options.walls is None)
    return case


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab suggested`."""
    add = parser.add_argument
    add("--quick", action="store_true", help=f"{QUICK} scenes, one of each soil")
    add("--validate", action="store_true", help="write and check scenes, run none")
    add("--walls", type=float, metavar="N", help="run over N thicknesses of the wall")
    add("--number", type=int, default=NUMBER, help="of scenes")
    add("--seed", type=int, default=SEED)
    add("--only", type=int, action="append", metavar="N", help="scenes of this number")
    add("--jobs", type=int, default=1, help="runs at a time")
    text = "of its estimate, to which a run is shortened"
    add("--seconds", type=float, default=30.0, metavar="S", help=text)
    text = "end a run after so many times its estimate, and a minute"
    add("--limit", type=float, default=5.0, help=text)
    add("--results", type=Path, default=RESULTS / "suggested")


def main(options: argparse.Namespace) -> int:
    """Write, check and run the scenes; return 1 where one fails."""
    options.results.mkdir(parents=True, exist_ok=True)
    numbers = options.only or range(QUICK if options.quick else options.number)
    cases = [case_of(options.seed, number) for number in numbers]
    written = []
    for case in cases:
        if write_scene(case, options.results / f"scene_{case.number:02d}.prm"):
            written.append(case)
    with ThreadPoolExecutor(options.jobs) as pool:
        for case in pool.map(lambda c: try_case(c, options), written):
            verdict = "; ".join(case.faults) or "passes"
            print(f"scene {case.number:02d}, {case.soil}: {verdict}", flush=True)
    heading = f"{outcome.machine()}\n\n"
    outcome.write_table(options.results, COLUMNS, [c.line() for c in cases], heading)
    failed = sum(bool(case.faults) for case in cases)
    print(f"suggested: {len(cases) - failed} of {len(cases)} pass")
    return 1 if failed else 0
