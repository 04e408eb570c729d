# SPDX-License-Identifier: LGPL-2.1-or-later
"""What Houlsby and Byrne (2005) assume beside a run, and no ground investigation gives:
options, which are kept in the directory of the run."""
import argparse
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from caisson import disk
from caisson.disk import InputError

NAME = "design_methods.json"


def reader(low: float, high: float, most: int = 1) -> Callable[[str], Any]:
    """Return what reads a number within these ends or, where there may be two, both
    ends of a range. It raises ArgumentTypeError."""

    def read(text: str) -> Any:
        try:
            found = sorted(map(float, text.split(",")))
        except ValueError:
            found = []
        if len(found) not in (1, 2) or found[0] < low or not found[-1] <= high:
            raise argparse.ArgumentTypeError(
                f"{text!r} is not a number from {low:g} to {high:g}, or a range such as"
                " 0.45,0.8"
            )
        if len(found) > most:
            raise argparse.ArgumentTypeError(f"{text!r} is not one number")
        return [found[0], found[-1]] if most > 1 else found[0]

    return read


friction = reader(0, 2, 2)  # both ends of a range of K tan(delta)


def spread(text: str) -> float:
    """Return the load spread, 0 for none."""
    return 0.0 if text == "none" else float(reader(1.2, 10)(text))


OPTIONS: dict[str, tuple[Any, str, str]] = {
    "k_tan_delta_inside": (
        friction,
        "LOW,HIGH",
        "K tan(delta) of the inner wall, the friction over the vertical stress beside"
        " it: a range or one number; default: 0.45,0.8",
    ),
    "k_tan_delta_outside": (friction, "LOW,HIGH", "that of the outer wall"),
    "plug_permeability_ratio": (
        reader(0.01, 100),
        "X",
        "k_f, the permeability of the plug over that of the sand outside; default: 1",
    ),
    "load_spread": (
        spread,
        "X",
        "m, the radius to which friction enhances the vertical stress over that of the"
        " wall, or none; default: 1.5",
    ),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options, which hold until they are given again."""
    group = parser.add_argument_group("Houlsby & Byrne (2005)")
    for name, (read, metavar, text) in OPTIONS.items():
        option = f"--{name.replace('_', '-')}"
        group.add_argument(option, type=read, metavar=metavar, help=text)


def keep(options: argparse.Namespace, directory: Path) -> bool:
    """Keep the options that are given with a run; return whether there are any."""
    given = {k: v for k in OPTIONS if (v := getattr(options, k)) is not None}
    if given:
        kept = {k: 0 if v is None else v for k, v in of_run(directory).items()}
        found = kept | given
        disk.write(directory / NAME, json.dumps(found, indent=2) + "\n")
    return bool(given)


def of_run(directory: Path) -> dict[str, Any]:
    """Return the options that are kept with a run, by name. Raises InputError."""
    path = directory / NAME
    if not path.is_file():
        return {}
    try:
        found = dict(json.loads(disk.read_text(path, InputError)))
    except (TypeError, ValueError) as error:
        raise InputError(f"{path} cannot be read: {error}") from error
    if found.get("load_spread") == 0:
        found["load_spread"] = None
    return {name: value for name, value in found.items() if name in OPTIONS}
