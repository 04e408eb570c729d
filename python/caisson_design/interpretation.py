# SPDX-License-Identifier: LGPL-2.1-or-later
"""From the file of a cone test to layers with estimates, as options choose it."""
import argparse
from dataclasses import dataclass
from pathlib import Path

from caisson_design import InputError
from caisson_design import cone_file
from caisson_design import cone_layers as layers
from caisson_design import correlations
from caisson_design.cone_estimates import Estimates, estimates_of
from caisson_design.cone_file import Test
from caisson_design.correlations import BY_NAME
from caisson_design.ground import CLAY, SAND, SILT, WATER, Ground, ground_of
from caisson_design.quantity import length, number

AREA_RATIO = 0.8


@dataclass(frozen=True)
class Interpretation:
    """A test: its ground, the correlations by quantity, and its layers with their
    estimates; weight: where the unit weight comes from."""

    file: Path
    test: Test
    ground: Ground
    names: dict[str, str]
    layers: list[Estimates]
    weight: str


def depths(text: str) -> list[float]:
    """Return the depths of a list such as 0,3,7.5."""
    found = [float(word) for word in text.split(",")]
    if found[:1] != [0.0] or any(a >= b for a, b in zip(found, found[1:])):
        raise argparse.ArgumentTypeError(
            f"{text!r} must begin with 0 and grow, as 0,3,7.5 does"
        )
    if len(found) > layers.MOST:
        raise argparse.ArgumentTypeError(
            f"{text!r} has {len(found)} layers; at most {layers.MOST} are taken"
        )
    return found


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that say how a test is read."""
    add = parser.add_argument_group("how the cone test is read").add_argument
    add(
        "--location",
        default="",
        metavar="NAME",
        help="one of the tests in a file of AGS",
    )
    add(
        "--tops",
        type=depths,
        metavar="0,M,...",
        help="tops of the layers (m), instead of those found",
    )
    add(
        "--thinnest",
        type=length,
        default=layers.THINNEST,
        metavar="M",
        help="thickness of the thinnest layer, default %(default)g m",
    )
    add(
        "--correlation",
        action="append",
        default=[],
        choices=BY_NAME,
        metavar="NAME",
        help=f"one of {', '.join(BY_NAME)}; give one option for each",
    )
    add(
        "--soil",
        choices=(SAND, SILT, CLAY),
        help="kind of all the soil; needed where the test has no sleeve friction",
    )
    add(
        "--unit-weight",
        type=number("kN/m3"),
        metavar="KN/M3",
        help="of the wet soil; needed where the test has no sleeve friction",
    )
    add(
        "--area-ratio",
        type=number(""),
        metavar="A",
        help="net area ratio of the cone, for u2; default: that of an AGS or GEF file,"
        f" or {AREA_RATIO:g}",
    )


def check(file: Path, test: Test, options: argparse.Namespace) -> None:
    """Refuse what the options leave open or cannot mean. Raises InputError."""
    if test.friction is None:
        missing = [
            word
            for word, value in (
                ("--soil sand", options.soil),
                ("--unit-weight 19", options.unit_weight),
            )
            if value is None
        ]
        if missing:
            raise InputError(
                f"{file} has no sleeve friction (fs_kPa), from which the kind of soil"
                f" and its unit weight follow; give it, or {' and '.join(missing)}"
            )
        if "robertson-2009" in options.correlation:
            raise InputError(f"robertson-2009 needs a sleeve friction, not in {file}")
    weight = options.unit_weight
    if weight is not None and not WATER < 1e3 * weight < 25e3:
        raise InputError(
            f"--unit-weight {weight:g}: give the unit weight of the wet soil in kN/m3,"
            f" between {WATER / 1e3:g} and 25"
        )
    if options.tops and options.tops[-1] >= test.depth[-1]:
        raise InputError(
            f"--tops {options.tops[-1]:g}: the test ends at {test.depth[-1]:g} m; give"
            " tops above it"
        )
    if options.area_ratio is not None and not 0 < options.area_ratio <= 1:
        raise InputError(f"--area-ratio {options.area_ratio:g} is not from 0 to 1")


def area_ratio_of(test: Test, given: float | None) -> tuple[float, tuple[str, ...]]:
    """Return the net area ratio of the cone: the one given, or that of the file, and in
    words which one it is where it has a choice."""
    of_file = test.area_ratio
    if given is not None or of_file is None or test.pore_pressure is None:
        return AREA_RATIO if given is None else given, ()
    if not 0 < of_file <= 1:
        return AREA_RATIO, (
            f"net area ratio of the cone: {AREA_RATIO:g}; that of the file,"
            f" {of_file:g}, is not between 0 and 1",
        )
    return of_file, (f"net area ratio of the cone: {of_file:g}, from the file",)


def interpret(
    file: Path, options: argparse.Namespace, deepest: float | None = None
) -> Interpretation:
    """Return what a test says. deepest: below it (m) it does not count. Raises
    InputError."""
    whole = cone_file.read(file, location=options.location)
    check(file, whole, options)
    area_ratio, said = area_ratio_of(whole, options.area_ratio)
    whole = whole._replace(remarks=(*whole.remarks, *said))
    test = whole if deepest is None else whole.down_to(deepest)
    weight = options.unit_weight
    ground = ground_of(test, area_ratio, weight and 1e3 * weight)
    names = correlations.chosen(options.correlation)
    tops = [top for top in options.tops or () if top < test.depth[-1]]
    tops = tops or layers.tops_of(ground, options.thinnest)
    try:
        found = layers.layers_of(ground, tops, options.soil or "")
    except ValueError as error:
        tops_are = "choose other --tops" if options.tops else "give --tops of your own"
        raise InputError(f"{file}: {error}; {tops_are}") from error
    return Interpretation(
        file,
        whole,
        ground,
        names,
        estimates_of(ground, found, names),
        "robertson-cabal-2010" if weight is None else "--unit-weight",
    )
