# SPDX-License-Identifier: LGPL-2.1-or-later
"""One picture of the forces that push or pull the caissons of several runs."""
import argparse
import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from caisson.plot.forces import penetration
from caisson.results import Results, ResultsError, Table

LINES = ("black", "#c0392b", "#2166ac", "#2e8b57", "#8c510a", "#7b3294")


def pushing_force(history: Table) -> np.ndarray:
    """Return what pushes the body besides the suction, in N, negative where it
    pulls: the force of the soil less that of the water on lid and tip."""
    force = history["total_force_N"]
    if "suction_force_N" in history:
        force = force - history["suction_force_N"] + history["tip_water_force_N"]
    return force


def draw(picture: Path, directories: list[Path]) -> Path:
    """Write the picture; raises ResultsError where a run has no penetration."""
    figure = Figure(figsize=(7, 7))
    axes = figure.subplots()
    for i, directory in enumerate(directories):
        history = Results(directory).history
        depth = penetration(history)
        if depth is None:
            raise ResultsError(f"the body of {directory} does not move")
        axes.plot(
            pushing_force(history) / 1e3,
            depth,
            color=LINES[i % len(LINES)],
            linewidth=1.4,
            label=directory.name,
        )
    axes.axvline(0, color="0.6", linewidth=0.8)
    axes.grid(color="0.9")
    axes.set_axisbelow(True)
    axes.invert_yaxis()
    axes.set_xlabel("force that pushes the body (kN), negative: pulls")
    axes.set_ylabel("penetration of the tip (m)")
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(picture, dpi=150)
    return picture


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson compare`."""
    parser.add_argument("picture", type=Path, metavar="PICTURE.png")
    parser.add_argument(
        "directories",
        nargs="+",
        type=Path,
        metavar="DIR",
        help="the output directory of a run, whose name is its label",
    )


def main(options: argparse.Namespace) -> int:
    """Draw the picture."""
    try:
        print(f"compare: {draw(options.picture, options.directories)}")
    except (ResultsError, OSError) as error:
        print(f"compare: {error}", file=sys.stderr)
        return 1
    return 0
