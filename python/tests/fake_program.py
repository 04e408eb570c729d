#!/usr/bin/python3 -SEB
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stands in for caisson_mpm in tests of studies: the same options, a formula for the
force, and a file `calls` beside the results that counts the runs.

Entries: Soil/Friction angle (30), Soil/Stiffness (5e6), Soil/Kind (sand). It refuses an
angle below 0 with --validate, and breaks off at 3 m where it is above 40. The variable
FAKE_PROGRAM_POINTS makes --validate report a number of points, and FAKE_PROGRAM_HOLDS
names the directory of a run that leaves a checkpoint and goes on until it is stopped or
who has started it is gone. A run with --restart has a + in calls; --overwrite removes
forces.png, as the program does.
"""
import argparse
import os
import sys
import time
from pathlib import Path

ENTRIES = {
    "Soil/Friction angle": "30",
    "Soil/Stiffness": "5e6",
    "Soil/Kind": "sand",
    "Output/Directory": "results",
    "Run control/Stop file": "stop",
}


def force(entries: dict[str, str], depth: float) -> float:
    """Return the total force in N, at a depth in m."""
    strength = float(entries["Soil/Friction angle"])
    kind = 2.0 if entries["Soil/Kind"] == "gravel" else 1.0
    return kind * depth * (1e3 * strength + 1e-3 * float(entries["Soil/Stiffness"]))


def print_parameters(entries: dict[str, str]) -> None:
    """Print all entries as a .prm file."""
    for path, value in entries.items():
        section, name = path.split("/")
        print(f"subsection {section}\n  set {name} = {value}\nend")


def run(entries: dict[str, str], directory: Path, mark: str) -> int:
    """Write history.csv; return the exit status. mark: of the run in calls."""
    directory.mkdir(parents=True, exist_ok=True)
    if directory.name == os.environ.get("FAKE_PROGRAM_HOLDS"):
        (directory / "checkpoint.info").touch()
    with open(directory.parent / "calls", "a", encoding="utf-8") as calls:
        calls.write(f"{directory.name}{mark}\n")
    if directory.name == os.environ.get("FAKE_PROGRAM_HOLDS"):
        begun_by, stop = os.getppid(), directory / entries["Run control/Stop file"]
        while os.getppid() == begun_by:
            if stop.exists():
                stop.unlink()
                return 3
            time.sleep(0.05)
    breaks_off = float(entries["Soil/Friction angle"]) > 40
    depths = [0.5 + 0.01 * i for i in range(251 if breaks_off else 401)]
    rows = [f"{d},{d:.2f},{force(entries, d)}" for d in depths]
    head = "time_s,penetration_m,total_force_N"
    (directory / "history.csv").write_text("\n".join([head, *rows]) + "\n")
    (directory / "run.json").write_text('{"status": "running"}')  # to need no more
    if breaks_off:
        print("failure: the soil is too strong", file=sys.stderr)
        return 2
    return 0


def main() -> int:
    """Do what the words of the call ask for."""
    parser = argparse.ArgumentParser()
    parser.add_argument("scene", type=Path)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--output-directory", default="results", type=Path)
    parser.add_argument("--print-parameters", action="store_true")
    parser.add_argument("--validate", action="store_true")
    parser.add_argument("--overwrite", action="store_true")
    parser.add_argument("--restart", action="store_true")
    words = parser.parse_args()
    entries = dict(ENTRIES)
    for text in words.set:
        path, value = text.split("=", 1)
        if path not in entries:
            print(f"bad input: there is no entry {path}", file=sys.stderr)
            return 1
        entries[path] = value
    if words.print_parameters:
        print_parameters(entries)
        return 0
    if float(entries["Soil/Friction angle"]) < 0:
        print("bad input: Friction angle must be positive\n  Set it", file=sys.stderr)
        return 1
    if not words.validate:
        if words.overwrite:
            (words.output_directory / "forces.png").unlink(missing_ok=True)
        return run(entries, words.output_directory, "+" * words.restart)
    print("a.prm is valid")
    if points := os.environ.get("FAKE_PROGRAM_POINTS"):
        print(f"  points     {points}")
    print(
        "  duration   about 1.5 to 4.5 min on one core: by the speed of the first steps"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
