# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws forces.png, stress.png and displacement.png from a run's output, and
void_ratio.png where the soil changes its volume.

Usage: scripts/plot DIR (which finds the right python3 for this file).
"""
import csv
import json
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np

import plot_fields
import plot_forces


class BadInput(Exception):
    """What is wrong with the directory, for the user."""


def read_table(path, column):
    """The columns of history.csv, or of its companion, by name, with this one
    among them; a torn last row is left out."""
    if not path.is_file():
        raise BadInput(f"no {path.name} in {path.parent}: is it the output "
                       "directory of a run?")
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [name.strip() for name in rows[0]] if rows else []
    values = []
    for row in rows[1:]:
        try:
            numbers = [float(entry) for entry in row]
        except ValueError:
            continue
        if len(numbers) == len(names):
            values.append(numbers)
    if column not in names or not values:
        raise BadInput(f"{path} has no column {column} or no complete row")
    return dict(zip(names, np.array(values).T))


def read_scene(path):
    """The entry "scene" of run.json; empty where there is none."""
    if not path.is_file():
        return {}
    try:
        return json.loads(path.read_text(encoding="utf-8")).get("scene") or {}
    except ValueError as error:
        print(f"plot: {path} is not read: {error}", file=sys.stderr)
        return {}


def main(directory):
    if not directory.is_dir():
        raise BadInput(f"no directory {directory}")
    history = read_table(directory / "history.csv", "time_s")
    bounds_file = directory / "history_error.csv"
    bounds = (read_table(bounds_file, "penetration_m")
              if bounds_file.is_file() else {})
    scene = read_scene(directory / "run.json")
    pictures = [plot_forces.draw(directory / "forces.png", history, scene,
                                 bounds)]
    if (directory / "points.pvd").is_file():
        pictures += plot_fields.draw(directory, history, scene)
    else:
        print(f"plot: no points.pvd in {directory}, so forces only")
    for picture in filter(None, pictures):
        print(f"plot: {picture}")


if __name__ == "__main__":
    try:
        main(Path(sys.argv[1]))
    except (BadInput, OSError, ElementTree.ParseError) as bad:
        sys.exit(f"plot: {bad}")
