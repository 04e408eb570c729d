# SPDX-License-Identifier: LGPL-2.1-or-later
"""From the file of a cone test to layers with estimates, as options choose it."""
import argparse
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from caisson.disk import InputError
from caisson.terminal import printable
from caisson.design import cone_file, cone_options, correlations
from caisson.design import cone_layers as layers
from caisson.design.cone_estimates import Estimates, estimates_of
from caisson.design.cone_file import Test
from caisson.design.cone_rules import AREA_RATIO, GIVEN
from caisson.design.correlations import BY_NAME
from caisson.design.ground import CLAY, CONE_FACTOR, SAND, SILT, WATER
from caisson.design.ground import Ground, ground_of
from caisson.design.quantity import length, number

KINDS = (SAND, SILT, CLAY)


@dataclass(frozen=True)
class Interpretation:
    """A test: its ground, the correlations by quantity, and its layers with their
    estimates; weight: where the unit weight comes from."""

    file: Path
    ground: Ground
    names: dict[str, str]
    layers: list[Estimates]
    weight: str

    @property
    def name(self) -> str:
        """The name of the file, for terminal, picture and page."""
        return printable(self.file.name)


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


class Soil(NamedTuple):
    """The kind of soil that is given, of a layer by its number, of depths (m) from top
    to bottom, or of all."""

    kind: str
    layer: int = 0
    top: float = 0.0
    bottom: float = inf


def soil(text: str) -> Soil:
    """Return the kind of soil of "clay", "2=clay" or "3.0-6.5=clay"."""
    where, _, kind = text.rpartition("=")
    number = r"\s*(\d+(?:\.\d*)?)\s*m?\s*"
    depths_of = re.fullmatch(f"{number}-{number}", where)
    if kind.strip() in KINDS and where.strip().isdecimal() and int(where):
        return Soil(kind.strip(), int(where))
    if kind.strip() in KINDS and depths_of:
        top, bottom = map(float, depths_of.groups())
        if top < bottom:
            return Soil(kind.strip(), 0, top, bottom)
    if text in KINDS:
        return Soil(text)
    raise argparse.ArgumentTypeError(
        f"{text!r} must be {', '.join(KINDS)}, of all the soil, or as in 2=clay for"
        " layer 2, or as in 3-6.5=clay for depths from 3 to 6.5 m"
    )


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that say how a test is read."""
    group = parser.add_argument_group("how the cone test is read")
    cone_options.add_arguments(group)
    add = group.add_argument
    text = "tops of the layers (m), instead of those found"
    add("--tops", type=depths, metavar="0,M,...", help=text)
    text = "thickness of the thinnest layer, default %(default)g m"
    default = layers.THINNEST
    add("--thinnest", type=length, default=default, metavar="M", help=text)
    text = f"one of {', '.join(BY_NAME)}; give one option for each"
    every: dict[str, Any] = {"action": "append", "default": []}
    add("--correlation", choices=BY_NAME, metavar="NAME", help=text, **every)
    names = " and ".join(correlations.UNCALIBRATED)
    text = f"by {names}, in place of what answers the cone"
    add("--uncalibrated", action="store_true", help=text)
    text = (
        "sand, silt or clay: of all the soil, as needed where the test has no sleeve"
        " friction; of a layer, 2=clay; of depths, 3-6.5=clay; give one option for each"
    )
    add("--soil", type=soil, metavar="KIND", help=text, **every)
    text = f"cone factor N_kt of clay; default {CONE_FACTOR:g}, for a caisson computed"
    add("--nkt", type=number(""), metavar="N", help=text)
    text = "of the wet soil; needed where the test has no sleeve friction"
    add("--unit-weight", type=number("kN/m3"), metavar="KN/M3", help=text)
    text = f"of an AGS or GEF file, or {AREA_RATIO:g}"
    text = f"net area ratio of the cone, for u2; default: that {text}"
    add("--area-ratio", type=number(""), metavar="A", help=text)


def check(file: Path, test: Test, options: argparse.Namespace) -> None:
    """Refuse what the options leave open or cannot mean. Raises InputError."""
    weight = options.unit_weight
    if test.friction is None:
        needed = {"--soil sand": options.soil or None, "--unit-weight 19": weight}
        if missing := [word for word, value in needed.items() if value is None]:
            raise InputError(
                f"{file} has no sleeve friction (fs_kPa), from which the kind of soil"
                f" and its unit weight follow; give it, or {' and '.join(missing)}"
            )
    if weight is not None and not WATER < 1e3 * weight < 25e3:
        raise InputError(
            f"--unit-weight {weight:g}: give the unit weight of the wet soil in kN/m3,"
            f" between {WATER / 1e3:g} and 25"
        )
    if options.nkt is not None and not 5 <= options.nkt <= 40:
        raise InputError(f"--nkt {options.nkt:g} is not between 5 and 40")
    if options.tops and options.tops[-1] >= test.depth[-1]:
        raise InputError(
            f"--tops {options.tops[-1]:g}: the test ends at {test.depth[-1]:g} m; give"
            " tops above it"
        )
    check_soil(options.soil, float(test.depth[-1]))
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
    """Return what a test says. deepest: layers that begin below it (m) do not count;
    the others are those of the whole test, but the density of sand, which is that of
    the rows above it. Raises InputError."""
    test = cone_file.read(file, how=cone_options.how_of(options))
    check(file, test, options)
    area_ratio, said = area_ratio_of(test, options.area_ratio)
    test = replace(test, remarks=(*test.remarks, *said))
    if deepest is not None and deepest <= test.measured_from:
        raise InputError(
            f"{file} begins at {test.measured_from:g} m, below the {deepest:g} m that"
            " count for this skirt"
        )
    weight = options.unit_weight
    ground = ground_of(test, area_ratio, weight and 1e3 * weight)
    wall = getattr(options, "wall", None)
    first = [] if wall else [correlations.NKT]
    given = [BY_NAME[name].quantity for name in options.correlation]
    if len(set(given)) < len(given) or given and options.uncalibrated:
        raise InputError(
            "--correlation and --uncalibrated choose the same quantity twice: leave"
            " all but one out"
        )
    last = correlations.UNCALIBRATED if options.uncalibrated else ()
    if options.nkt:
        last = (*last, correlations.NKT)
    names = correlations.chosen([*first, *options.correlation, *last])
    factor = options.nkt or CONE_FACTOR
    if names[correlations.STRENGTH] == correlations.OWN_CLAY:
        rate = correlations.rate_factor(wall)
        factor = correlations.computed_cone_factor() / rate
    ground = replace(ground, cone_factor=factor)
    tops = tops_for(ground, options)
    try:
        found = layers.layers_of(ground, tops, given_kinds(ground, tops, options.soil))
    except ValueError as error:
        ways = "choose other --tops" if options.tops else "give --tops of your own"
        if "sleeve" in str(error):
            ways = "give its kind, as in --soil 1=sand"
        raise InputError(f"{file}: {error}; {ways}") from error
    every = estimates_of(ground, found, names, inf if deepest is None else deepest)
    number = sum(deepest is None or layer.top < deepest for layer in found)
    while any(x.growth < 0 for x in every[number - 1].values.values()):
        number += 1  # what grows weaker does not go on for ever
    return Interpretation(
        file,
        ground,
        names,
        every[:number],
        "robertson-cabal-2010" if weight is None else "--unit-weight",
    )


def tops_for(ground: Ground, options: argparse.Namespace) -> list[float]:
    """Return the tops of the layers (m): those given or found, and the ends of what is
    given by --soil and --above."""
    last = float(ground.depth[-1])
    edges = [edge for soil in options.soil for edge in (soil.top, soil.bottom)]
    edges += [ground.measured_from] if ground.above == GIVEN else []
    if options.tops:
        return layers.with_edges([t for t in options.tops if t < last], edges, 0, last)
    found = layers.tops_of(ground, options.thinnest)
    return layers.with_edges(found, edges, options.thinnest, last)


def check_soil(given: Sequence[Soil], end: float) -> None:
    """Refuse depths below the end of the test (m), and those that are given two kinds.
    Raises InputError."""
    above = Soil("", 0, 0.0, 0.0)
    parts = [soil for soil in given if soil.bottom < inf]
    for soil in sorted(parts, key=lambda soil: soil.top):
        text = f"--soil {soil.top:g}-{soil.bottom:g}={soil.kind}"
        if soil.top >= end:
            raise InputError(
                f"{text}: the test ends at {end:g} m; give depths above it"
            )
        if soil.top < above.bottom:
            raise InputError(
                f"{text} overlaps --soil {above.top:g}-{above.bottom:g}={above.kind};"
                " give each depth one kind"
            )
        above = soil


def given_kinds(ground: Ground, tops: list[float], given: Sequence[Soil]) -> np.ndarray:
    """Return the kind of soil of each row [n] that is given, "" for none; what is given
    of a part goes before what is given of all. Raises InputError."""
    found = np.full(len(ground.depth), "", dtype="<U4")
    for soil in sorted(given, key=lambda soil: soil.layer > 0 or soil.bottom < inf):
        top, bottom = soil.top, soil.bottom
        if soil.layer > len(tops):
            raise InputError(
                f"--soil {soil.layer}={soil.kind}: the test has {len(tops)} layers"
            )
        if soil.layer:
            top, bottom = [*tops, inf][soil.layer - 1 : soil.layer + 1]
        found[(ground.depth >= top) & (ground.depth < bottom)] = soil.kind
    return found
