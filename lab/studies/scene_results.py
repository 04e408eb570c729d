# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the scenes of prm/ and compares them with what the manual says of them.

doc/scene_results.csv has the key numbers of each scene: of the whole run, and of a
short way. Its rows say with which commit and on which processor they were made, and how
much time of one core that took. Runs that are complete are not repeated. A number that
differs by more than 3 % is a failure. --write takes new numbers into the file. What
pages quote is in QUOTES, and is compared with the file.
"""
import argparse
import csv
import re
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np

from caisson import curves, evaluation, table
from caisson.paths import PROGRAM, RESULTS, ROOT, SCENES
from caisson.results import Results, Table
from caisson.runner import Entries, Run, RunError, Status
from lab import outcome
from lab.checks import checks_of
from lab.curves import final_mean

FILE = ROOT / "doc/scene_results.csv"
PAGE = ROOT / "doc/results.md"
TOLERANCE = 0.03  # of a number
NUMBER = r"(\d[\d.,]*)"
SMALL = 0.02  # of the largest number of its kind; below it, this is the scale
SHORT_SHARE = 0.004  # of the way, in a short run
WHOLE, SHORT = "whole", "short"
QUANTITIES = "total_force_N", "tip_force_N", "required_suction_Pa"
AT_END = ("jack", "suction")  # scenes whose numbers at the end are quoted, too
# what pages say of a scene: page, words with # for the number, scene, quantity,
# penetration (m), and the unit of the number
TOTAL, TIP, NEEDED, PULL = (*QUANTITIES, "largest_tension_N")
CLAY, LAYERS, TENSION = "tutorial_clay.md", "tutorial_suction.md", "tutorial_tension.md"
QUOTES: list[tuple[str, str, str, str, float, float]] = [
    ("quick_start.md", "Jacked to 6.5 m: # MN", "jack", TOTAL, 6.5, 1e6),
    ("quick_start.md", "pen 2.015 m | tip # inner", "jack", TIP, 2, 1e3),
    ("tutorial.md", "At 2 m, the tip force falls from # to", "tutorial", TIP, 2, 1e3),
    ("how_to/after_installation.md", "reports # kN", "pull_out_after", PULL, 2, 1e3),
    ("how_to/after_installation.md", "and # MN undrained", "tension", PULL, 2, 1e6),
    (TENSION, "Pulled from 2 m: # MN", "tension", PULL, 2, 1e6),
    (TENSION, "from 0.4 on | # MN", "tension", PULL, 2, 1e6),
    (TENSION, "| wished in place | 107 | # |", "tension", PULL, 2, 1e3),
    (TENSION, "| installed | 209 | # |", "tension_after", PULL, 2, 1e3),
    (LAYERS, "ends at # kPa at 6.5 m", "suction", NEEDED, 6.5, 1e3),
    (LAYERS, "at 1 m falls from # to", "jack", TOTAL, 1, 1e3),
    (CLAY, "| 5 m | # kN", "suction_clay", TOTAL, 5, 1e3),
    (CLAY, "| 8 m | # kN", "suction_clay", TOTAL, 8, 1e3),
    (CLAY, "600 to 622 kN | # kPa", "suction_clay", NEEDED, 5, 1e3),
    (CLAY, "1222 to 1255 kN | # kPa", "suction_clay", NEEDED, 8, 1e3),
    (CLAY, "| 2 m | clay | # kN", "suction_layers", TOTAL, 2, 1e3),
    (CLAY, "| 3 m | clay | # kN", "suction_layers", TOTAL, 3, 1e3),
    (CLAY, "2248 kN | # kPa", "suction_layers", NEEDED, 3, 1e3),
]
# how many other numbers with a unit of force or stress pages have: what is given, by
# hand, of a study, or of a part of a run that the file has not
OTHERS = {
    "tutorial.md": 3,
    "tutorial_clay.md": 29,
    "tutorial_suction.md": 2,
    "tutorial_tension.md": 6,
    "how_to/after_installation.md": 1,
    "how_to/cpt.md": 6,
    "how_to/own_caisson.md": 6,
    "how_to/restart.md": 1,
    "how_to/results.md": 1,
    "how_to/scenes.md": 1,
}
# what comes before a scene: runs of other scenes, each after the one before it
AFTER: dict[str, list[tuple[str, Entries]]] = {
    "pull_out_after": [("jack", {"Time/End penetration": 2.0})],
    "springs": [("jack", {"Time/End penetration": 2.0})],
    "tension_after": [
        (
            "suction_coupled",
            {
                "Time/End penetration": 2.0,
                "Time/Inertia tolerance": "none",
                "Time/Mass scaling": 100,
            },
        ),
        (
            "tension_after",
            {
                "Rigid body/Velocity": 0,
                "Rigid body/Ramp time": 0,
                "Water/Time compression": 1000,
                "Time/End penetration": "never",
                "Time/End time": 5,
            },
        ),
    ],
}


@dataclass
class Number:
    """A key number of a scene, and how it was found."""

    scene: str
    way: str  # WHOLE or SHORT
    quantity: str
    penetration_m: float
    value: float
    commit: str = ""
    processor: str = ""
    processor_s: float = 0.0

    @property
    def key(self) -> tuple[str, str, str, float]:
        """What it is."""
        return self.scene, self.way, self.quantity, round(self.penetration_m, 3)


def listed_scenes() -> list[str]:
    """Return the names of the scenes in the table of the manual, in its order."""
    text = (ROOT / "doc/how_to/scenes.md").read_text(encoding="utf-8")
    return re.findall(r"^\| `prm/(\w+)\.prm`", text, re.MULTILINE)


def key_numbers(history: Table) -> dict[tuple[str, float], float]:
    """Return {(quantity, penetration): value} of a whole run: means over 0.2 m at each
    meter on the way down, and the largest tension of a run that pulls."""
    depth = history["penetration_m"]
    meters = np.arange(np.ceil(depth[0]), depth.max() + 1e-9)
    numbers = {}
    for quantity in filter(history.__contains__, QUANTITIES):
        means = curves.forces_at(history, quantity, meters)
        for x, mean in zip(meters, means):
            if np.isfinite(mean):
                numbers[quantity, float(x)] = float(mean)
    total = history.get(curves.WITH_WATER, history["total_force_N"])
    if total.min() < -0.1 * abs(total.max()):
        deepest = float(history["penetration_m"].max())
        numbers["largest_tension_N", deepest] = float(-total.min())
    return numbers


def short_numbers(history: Table) -> dict[tuple[str, float], float]:
    """Return the same of a short way: means over its last half."""
    depth = history["penetration_m"]
    length = (depth[-1] - depth[0]) / 2
    return {
        (quantity, float(depth[-1])): final_mean(depth, history[quantity], length)
        for quantity in ("total_force_N", "tip_force_N")
    }


def short_way(run: Run) -> Entries | None:
    """Return the entries that make a run of a scene short, None where the end is no
    penetration."""
    end = run.in_effect["Time/End penetration"]
    if run.scene.stem in AFTER or end == "never":
        return None
    start = float(run.in_effect["Rigid body/Initial penetration"])
    if float(end) < start:  # it is pulled
        return None
    way = float(end) - start
    ramp = min(0.03, way / 10)  # m, until the velocity is constant
    return {"Time/End penetration": start + ramp + SHORT_SHARE * way}


def run_of(scene: str, way: str, results: Path, program: Path) -> Run | None:
    """Return the run of a scene, None where it has no such way; what must come first
    has been run."""
    entries: dict[str, object] = {
        "Output/Frame interval": "never",
        "Output/Frame penetrations": "",
    }
    file = SCENES / f"{scene}.prm"
    if scene in AFTER and way == WHOLE:
        start: dict[str, object] = {}
        for name, changes in AFTER[scene]:
            before = results / way / f"{name}_before_{scene}"
            run = Run(
                SCENES / f"{name}.prm", {**changes, **start}, before, program=program
            )
            if not run.is_complete():
                run.execute()
            start = {"Installation/Directory": str(before)}
        entries.update(start)
    if way == SHORT:
        short = short_way(Run(file, entries, results, program=program))
        if short is None:
            return None
        entries.update(short)
    return Run(file, entries, results / way / scene, program=program)


def numbers_of(
    scene: str, way: str, results: Path, program: Path, commit: str = ""
) -> list[Number]:
    """Run a scene and return its numbers. Raises RuntimeError where it fails."""
    run = run_of(scene, way, results, program)
    if run is None:
        return []
    if not run.is_complete():
        run.execute()
    record = run.completion_record()
    if record is None or record["status"] != Status.SUCCESS:
        raise RuntimeError(f"{run.directory / 'log'} says why {scene} failed")
    results_of_run = Results(run.directory)
    if "total_force_N" in results_of_run.history and (
        results_of_run.history["penetration_m"].max() > 0
    ):
        find = key_numbers if way == WHOLE else short_numbers
        found = find(results_of_run.history)
        if scene in AT_END and way == WHOLE:
            end = {k: x[-1] for k, x in evaluation.at_depths(results_of_run).items()}
            at = float(end[evaluation.DEPTH])
            found |= {(k, at): float(end[k]) for k in QUANTITIES if k in end}
    else:
        found = {
            (check["check"], 0.0): float(check["computed"])
            for check in checks_of(results_of_run)
            if check["exact"] != 0  # else it is noise
        }
    return [
        Number(
            scene,
            way,
            quantity,
            depth,
            value,
            commit,
            outcome.processor(),
            record["cpu_s"],
        )
        for (quantity, depth), value in found.items()
    ]


def read(path: Path = FILE) -> list[Number]:
    """Return the numbers of the file; none where there is no file."""
    if not path.is_file():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return [
            Number(
                row["scene"],
                row["way"],
                row["quantity"],
                float(row["penetration_m"]),
                float(row["value"]),
                row["commit"],
                row["processor"],
                float(row["processor_s"]),
            )
            for row in csv.DictReader(file)
        ]


def write(numbers: list[Number], path: Path = FILE) -> None:
    """Write the file."""
    rows = []
    for number in numbers:
        row = asdict(number)
        row["value"] = f"{number.value:.5g}"
        row["processor_s"] = f"{number.processor_s:.1f}"
        row["penetration_m"] = f"{number.penetration_m:.5g}"
        rows.append(list(row.values()))
    table.write_csv(path, [field.name for field in fields(Number)], rows)


def differences(new: list[Number], old: list[Number]) -> list[str]:
    """Return what differs by more than the tolerance, or is missing, in words."""
    known = {number.key: number.value for number in old}
    scale: dict[tuple[str, str, str], float] = {}
    for number in old:
        key = number.key[:3]
        scale[key] = max(scale.get(key, 0.0), abs(number.value))
    found = []
    for number in new:
        where = f"{number.scene} ({number.way}): {number.quantity}"
        where += f" at {number.penetration_m:.4g} m"
        if number.key not in known:
            found.append(f"{where} is not in {FILE.name}")
            continue
        was = known[number.key]
        allowed = TOLERANCE * max(abs(was), SMALL * scale[number.key[:3]])
        if not abs(number.value - was) <= allowed:
            found.append(f"{where} is {number.value:.5g}, and was {was:.5g}")
    return found


def pages() -> list[Path]:
    """Return the pages on which a user finds numbers of scenes."""
    doc = ROOT / "doc"
    tutorials = sorted(doc.glob("tutorial*.md"))
    return [doc / "quick_start.md", *tutorials, *sorted((doc / "how_to").glob("*.md"))]


def pattern_of(words: str) -> str:
    """Return the regular expression of words of QUOTES."""
    found = r"\s+".join(map(re.escape, words.split()))
    return found.replace(r"\#", NUMBER)


def stale_quotes(numbers: list[Number]) -> list[str]:
    """Return the quotes that are not on their page, or differ by more than the
    tolerance from the numbers, in words."""
    known, found = {n.key: n.value for n in numbers if n.way == WHOLE}, list[str]()
    for page_name, words, scene, quantity, depth, unit in QUOTES:
        text = (ROOT / "doc" / page_name).read_text(encoding="utf-8")
        said = re.findall(pattern_of(words), text)
        value = known[scene, WHOLE, quantity, depth] / unit
        where = f"{page_name}, {words!r}"
        if len(said) != 1:
            found.append(f"{where}: {len(said)} times on the page, instead of once")
        elif not abs(float(said[0]) - value) <= TOLERANCE * abs(value):
            found.append(f"{where}: {said[0]} on the page, and {value:.4g} in the file")
    return found


def others_of(path: Path) -> int:
    """Return how many numbers with a unit of force or stress, or of steps, a page has
    outside of code and of QUOTES."""
    text = re.sub(
        r"```.*?```|`[^`]*`", " ", path.read_text(encoding="utf-8"), flags=re.S
    )
    name = str(path.relative_to(ROOT / "doc"))
    quoted = [
        match.span()
        for quote in QUOTES
        if quote[0] == name
        for match in re.finditer(pattern_of(quote[1]), text)
    ]
    numbers = re.finditer(rf"{NUMBER}\s+(?:kN|MN|kPa|MPa|steps)\b(?![/·])", text)
    return sum(
        not any(begin <= match.start() < end for begin, end in quoted)
        for match in numbers
    )


def merged(old: list[Number], new: list[Number]) -> list[Number]:
    """Return the numbers with the scenes and ways of new replaced, in the order of
    the table."""
    ways = {(number.scene, number.way) for number in new}
    numbers = [n for n in old if (n.scene, n.way) not in ways] + new
    order = {name: i for i, name in enumerate(listed_scenes())}
    return sorted(numbers, key=lambda n: (n.way != WHOLE, order.get(n.scene, 99)))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab scene-results`."""
    parser.add_argument("--only", default="", metavar="REGEX", help="scenes that fit")
    parser.add_argument("--short", action="store_true", help="a short way of each")
    parser.add_argument("--write", action="store_true", help="take the numbers over")
    parser.add_argument("--results", type=Path, default=RESULTS / "scenes")
    parser.add_argument("--program", type=Path, default=PROGRAM)


def main(options: argparse.Namespace) -> int:
    """Run the scenes; return 1 where a number differs or a scene fails."""
    way = SHORT if options.short else WHOLE
    complaints, commit = [], outcome.commit()
    for scene in listed_scenes():
        if not re.search(options.only, scene):
            continue
        try:
            new = numbers_of(scene, way, options.results, options.program, commit)
        except (RuntimeError, RunError) as error:
            complaints.append(str(error))
            continue
        old = read()
        complaints += [] if options.write else differences(new, old)
        took = f"{new[0].processor_s:.0f} s" if new else "left out"
        print(f"{scene}: {took}", flush=True)
        if options.write:
            write(merged(old, new))
    complaints += stale_quotes(read())
    print("\n".join(complaints) or "scenes: all numbers are as the manual has them")
    return 1 if complaints else 0
