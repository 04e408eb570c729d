# SPDX-License-Identifier: LGPL-2.1-or-later
"""Several runs beside each other, in a picture and a .csv file: commands/compare.py
says what they have."""
import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from caisson import curves, disk
from caisson.verdict import design
from caisson.paths import distinct_ends, seen
from caisson.plot.small import in_units, legend_below, over_depth
from caisson.design.quantity import length
from caisson.results import Results, ResultsError, Table
from caisson.table import write_columns
from caisson.shown import USUAL, Units

LINES = ("black", "#c0392b", "#2166ac", "#2e8b57", "#8c510a", "#7b3294")
STYLES = ("-", "--", ":", "-.")
PUSHING, TOTAL = "pushing_force_N", "total_force_N"
# columns of history.csv beside those in N
MORE = ("required_suction_Pa", "suction_Pa", "cavity_pressure_Pa")
DEPTH = "penetration_m"
INTERVAL, INTERVAL_OF_SMALL = 0.1, 0.001  # m
LONGEST = 100  # letters of the names of runs in the name of the picture
PICTURES = {".png", ".pdf", ".svg"}  # what a word ends with that is no directory

Histories = dict[str, Table]  # by the name of the run


def pushing_force(history: Table) -> np.ndarray:
    """Return what pushes the body besides the suction, in N, negative where it
    pulls: the force of the soil less that of the water on lid and tip."""
    force = history[TOTAL]
    if "suction_force_N" in history:
        force = force - history["suction_force_N"] + history["tip_water_force_N"]
    return force


def names_of(directories: Sequence[Path]) -> list[str]:
    """Return a name for each directory: its last part, or as many of its last parts
    as distinguish it from the others."""
    names = distinct_ends([directory.resolve().parts for directory in directories])
    if len(set(names)) < len(names):
        raise ResultsError("the same directory is given twice")
    return names


def directories_of(words: list[Path]) -> list[Path]:
    """Return the directories among the words of the command, without the picture that
    may stand before them."""
    is_picture = words[0].suffix in PICTURES and not words[0].is_dir()
    return words[1:] if is_picture else words


def read(directories: Sequence[Path]) -> Histories:
    """Return the histories of the runs. Raises ResultsError where one has no
    penetration."""
    found = {}
    for name, directory in zip(names_of(directories), directories):
        found[name] = Results(directory).history
        if curves.penetration(found[name]) is None:
            raise ResultsError(f"the body of {directory} does not move")
    return found


def panels_of(histories: Histories) -> dict[str, Table]:
    """Return the curves of each panel by its axis and the name of the run: the
    required suctions, where suction draws bodies down, and the forces."""
    suctions = {
        name: np.maximum(history[design.SUCTION], 0) / 1e3
        for name, history in histories.items()
        if design.SUCTION in history and design.goes_down(history)
    }
    forces = {
        name: (history[TOTAL] if name in suctions else pushing_force(history)) / 1e3
        for name, history in histories.items()
    }
    if not suctions:
        return {"applied force (kN), push positive": forces}
    axis = "resistance; without suction, applied force (kN)"
    return {"required suction (kPa)": suctions, axis: forces}


def draw(picture: Path, histories: Histories, shown: Units = USUAL) -> Path:
    """Write the picture."""
    panels = panels_of(histories)
    figure = Figure(figsize=(7 * len(panels), 7))
    for axes, (label, found) in zip(
        figure.subplots(1, len(panels), squeeze=False)[0], panels.items()
    ):
        for i, (name, history) in enumerate(histories.items()):
            if name not in found:
                continue
            axes.plot(
                found[name],
                history[DEPTH],
                color=LINES[i % len(LINES)],
                linestyle=STYLES[i // len(LINES) % len(STYLES)],
                linewidth=1.4,
                label=name,
            )
        axes.axvline(0, color="0.6", linewidth=0.8)
        axes.invert_yaxis()
        over_depth(axes, label, "penetration of the tip (m)")
        legend_below(axes)
    in_units(figure, shown)
    figure.set_layout_engine("tight")
    return disk.save(figure, picture)


def quantities_of(history: Table) -> Table:
    """Return the columns [n_rows] of the file of one run: all forces, suctions and
    the pressure on a cylinder, but those that are 0 throughout."""
    found = {PUSHING: pushing_force(history)} if "suction_force_N" in history else {}
    forces = (name for name in history if name.endswith("_N"))
    for name in [TOTAL, *forces, *MORE]:
        if name in history and np.any(history[name] != 0):
            found[name] = history[name]
    return found


def ways_of(name: str, depth: np.ndarray) -> dict[str, np.ndarray]:
    """Return the rows of the way down and of the way up by the name of the run, the
    latter marked where there are both; without those where they begin."""
    down, up = curves.way_down(depth)[1:], curves.way_up(depth)[1:]
    if not len(up):
        return {name: down}
    return {name: down, f"{name} up": up} if len(down) else {name: up}


def columns_of(histories: Histories, interval: float) -> Table:
    """Return the columns [n_depths] of the file, those of a quantity beside each
    other."""
    depths = curves.common_depths([h[DEPTH] for h in histories.values()], interval)
    if len(depths) == 0:
        raise ResultsError(f"no run passes a multiple of {interval:g} m")
    found: dict[str, Table] = {}
    for run, history in histories.items():
        for name, rows in ways_of(run, history[DEPTH]).items():
            depth = history[DEPTH][rows]
            for quantity, values in quantities_of(history).items():
                means = curves.smoothed_within(depth, values[rows], depths)
                if np.any(np.isfinite(means)):
                    found.setdefault(quantity, {})[f"{quantity} [{name}]"] = means
    columns = {DEPTH: depths}
    for group in found.values():
        columns |= group
    return columns


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson compare`."""
    parser.usage = "%(prog)s [--interval M] [PICTURE.png] DIR..."
    text = (
        "the output directory of a run, whose name is its label; before the first one"
        " the picture may stand, default comparison_DIR_DIR.png beside the first run;"
        " the .csv file of the same name is written beside it"
    )
    parser.add_argument("words", nargs="+", type=Path, metavar="DIR", help=text)
    text = f"between the depths of the .csv file, in m, default {INTERVAL:g}"
    text += f", or {INTERVAL_OF_SMALL:g} of bodies shorter than 1 m"
    parser.add_argument("--interval", type=length, metavar="M", help=text)
    text = "replace picture and .csv file if they are there"
    parser.add_argument("--overwrite", action="store_true", help=text)


def main(options: argparse.Namespace) -> int:
    """Draw the picture and write the file."""
    directories = directories_of(options.words)
    picture = options.words[0] if directories != options.words else None
    if not directories:
        raise ResultsError("give the output directory of a run")
    histories = read(directories)
    smaller = [Results(directory).shown.smaller for directory in directories]
    shown = Units(frozenset.intersection(*smaller))  # where all are small
    usual = INTERVAL_OF_SMALL if "m" in shown.smaller else INTERVAL
    columns = columns_of(histories, options.interval or usual)
    if picture is None:  # with the names of all: other runs have another one
        names = "_".join(name.replace("/", "-") for name in histories)[:LONGEST]
        picture = directories[0].resolve().parent / f"comparison_{names}.png"
    with disk.all_or_none(options.overwrite):
        written = [draw(picture, histories, shown)]
        written.append(write_columns(picture.with_suffix(".csv"), columns))
    for path in written:
        print(f"compare: {seen(path)}")
    return 0
