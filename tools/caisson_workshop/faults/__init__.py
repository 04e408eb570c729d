# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tries to break the program, as scripts/test --faults does:

    fuzz         scenes with one to three mutations, validated
    fuzzed-runs  the same, most of them milder, run for a moment
    kills        runs that are killed at any moment and continued
    damages      checkpoints and tables that are damaged, and continued

No input may end the program by a signal, or with words of another program or of
C++, or take longer than 20 s; a continued run must end with the same bits as one
that was left alone, or say why not. Each trial follows from the seed and its
number: --only N makes it again and keeps its files, in results/faults. The exit
status is 1 if a trial goes wrong.
"""
import argparse
import os
import shutil
from pathlib import Path

from caisson.paths import PROGRAM, RESULTS
from caisson_workshop.faults.campaign import Campaign, Part
from caisson_workshop.faults.damages import Damages
from caisson_workshop.faults.fuzz import Fuzz, FuzzedRuns
from caisson_workshop.faults.kills import Kills

PARTS: dict[str, type[Part]] = {
    "fuzz": Fuzz,
    "fuzzed-runs": FuzzedRuns,
    "kills": Kills,
    "damages": Damages,
}
COUNTS = {"fuzz": 3000, "fuzzed-runs": 200, "kills": 40, "damages": 400}
SHORT = {"fuzz": 60, "fuzzed-runs": 6, "kills": 4, "damages": 20}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop faults`."""
    parser.add_argument("parts", nargs="*", metavar="PART", help="default: all of them")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, help="trials of each part")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--only", type=int, metavar="N", help="this trial alone")
    parser.add_argument("--short", action="store_true", help="a minute's worth")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--directory", type=Path, default=RESULTS / "faults")


def main(options: argparse.Namespace) -> int:
    """Make the trials; return 1 where something is wrong."""
    unknown = set(options.parts) - set(PARTS)
    if unknown or not PROGRAM.exists():
        print(
            f"faults: no part {sorted(unknown)[0]!r}: choose from {', '.join(PARTS)}"
            if unknown
            else f"faults: there is no program {PROGRAM}; build it by scripts/build"
        )
        return 1
    lines, n_wrong = [], 0
    for name in options.parts or PARTS:
        count = options.count or (SHORT if options.short else COUNTS)[name]
        numbers = range(options.first, options.first + count)
        if options.only is not None:
            numbers = range(options.only, options.only + 1)
        directory = options.directory.resolve() / f"{name}_{options.seed}"
        part = PARTS[name](options.seed, directory)
        campaign = Campaign(part, options.only is not None)
        campaign.run(numbers, options.workers)
        lines.append(campaign.summary())
        n_wrong += len(campaign.complaints)
        if options.only is None and not campaign.complaints:
            shutil.rmtree(directory)
    print("\n".join(lines))
    print("faults: OK" if n_wrong == 0 else f"faults: {n_wrong} trials went wrong")
    return 1 if n_wrong else 0
