#!/usr/bin/python3 -B
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Compares what a test writes with a reference: words must be the same, and numbers
equal within a tolerance.

Usage: reference.py ROOM/NAME COMMAND [WORD]...

runs the command in the current directory. It must end with status 0 and write what is
in ROOM/NAME.output beside this file or, where there is no such file, a verdict ": yes"
at least, and none that is ": no". What it wrote is left in the file output.
"""
import itertools
import os
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
# absolute, relative; a number differs that is equal within neither
Tolerance = tuple[float, float]
USUAL: Tolerance = (1e-6, 1e-8)
# element tests are printed with four decimals
OTHERS = {"kernels/hypoplastic_element_tests": (2e-4, 1e-3)}
# Open MPI 4 on one rank: no daemon, no network, and files where no other test is
ALONE = {
    "OMPI_MCA_ess_singleton_isolated": "1",
    "OMPI_MCA_orte_tmpdir_base": os.getcwd(),
    "OMPI_MCA_pml": "ob1",
    "OMPI_MCA_btl": "self",
    "OMPI_MCA_sharedfp": "^sm",
}


def is_same(a: str, b: str, tolerance: Tolerance) -> bool:
    """Return whether two words are the same, or numbers that are nearly equal."""
    if a == b:
        return True
    try:
        x, y = float(a), float(b)
    except ValueError:
        return False
    difference = abs(x - y)
    return difference <= max(tolerance[0], tolerance[1] * min(abs(x), abs(y)))


def differences(expected: str, found: str, tolerance: Tolerance) -> list[str]:
    """Return the lines of two texts that differ."""
    result = []
    lines = itertools.zip_longest(expected.splitlines(), found.splitlines())
    for number, (a, b) in enumerate(lines, 1):
        words = [re.split(r"[\s=,:;<>\[\](){}^]+", line or "") for line in (a, b)]
        if len(words[0]) != len(words[1]) or not all(
            is_same(x, y, tolerance) for x, y in zip(*words)
        ):
            result += [f"line {number}: expected {a}", f"line {number}: found    {b}"]
    return result


def main(name: str, *command: str) -> int:
    """Run the command; return 0 where it passes."""
    done = subprocess.run(
        command,
        env={**os.environ, **ALONE},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    Path("output").write_text(done.stdout, "utf-8")
    file = HERE / f"{name}.output"
    if done.returncode:
        print(done.stdout, f"{name} ended with status {done.returncode}", sep="\n")
        return 1
    if file.is_file():
        tolerance = OTHERS.get(name, USUAL)
        wrong = differences(file.read_text("utf-8"), done.stdout, tolerance)
    else:
        verdicts = set(re.findall(r": (yes|no)(?=,|$)", done.stdout.lower(), re.M))
        wrong = [] if verdicts == {"yes"} else [done.stdout]
    print(*wrong, sep="\n")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
