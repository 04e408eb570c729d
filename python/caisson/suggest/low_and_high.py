# SPDX-License-Identifier: LGPL-2.1-or-later
"""Low, best and high estimate of the soil that is given: each is a scene of its own.

Low and high have either the numbers that are given for them, --low and --high in the
form of --layer, or those of --spread, a coefficient of variation V of each number: the
best estimate times 1 - 1.645 V and 1 + 1.645 V, which are the points of 5 and 95 % of a
normal distribution about it. Of a cone test they are its own estimates. All layers are
low, or high, together.
"""
import argparse
import os
from collections.abc import Mapping, Sequence
from math import radians, tan
from pathlib import Path

import numpy as np

from caisson import density_law
from caisson.band import HIGH, LOW
from caisson.design import quantity
from caisson.suggest import clay, sand
from caisson.suggest.entry import Layer, SuggestError
from caisson.suggest.soil import ANGLES_OF_FRICTION, DERIVED, STRENGTH, Change, Given
from caisson.suggest.soil import head_of, layers_of, name_of, texts_in
from caisson.suggest.walls import is_by_density, wall_friction_of
from caisson.template import template

WIDTH = 1.645  # standard deviations from the mean to the points of 5 and 95 %
CUT = 2.5  # standard deviations below the mean, where a study cuts off
LEAST_FACTOR = 0.1
MOST = 0.5  # coefficient of variation, of which low is a fifth of best
OF_STRENGTH = ("Cohesion", "Tension cut-off", "Youngs modulus")
DEPTH_OF_LAST = 10.0  # m of the deepest layer, over which estimates are compared
WALL = "Rigid body/Friction angle of the {} wall"
SIGNS = {LOW: -1, HIGH: 1}
OF_RESISTANCE = (
    density_law.DENSITY,
    "Active strength",
    density_law.CRITICAL_ANGLE,
    "Adhesion factor of the walls",
    "Friction angle of the walls",
    "Overconsolidation ratio",
    "K0",
    "Youngs modulus",
)
INVERSE = ("Void ratio", "Porosity", "Permeability", "Poisson ratio", "Solid density")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add = parser.add_argument_group("low and high estimate, NAME_low and NAME_high.prm")
    for estimate in SIGNS:
        add.add_argument(
            f"--{estimate}",
            action="append",
            default=[],
            metavar='"TOP: ENTRY = VALUE, ..."',
            help=f"a layer in the {estimate} estimate of resistance: what differs from"
            " its --layer",
        )
    add.add_argument(
        "--spread",
        metavar='"Dr 10%, su 20%"',
        help="in place of both: a coefficient of variation V for each number; low and"
        f" high are best times 1 -/+ {WIDTH} V, the 5 and 95 %% points of a normal"
        " distribution",
    )


def spread_of(text: str) -> dict[str, float]:
    """Return the coefficients of variation by symbol, of "Dr 10%, su 20%". Raises
    SuggestError."""
    found: dict[str, float] = {}
    for part in quantity.parts_of(text):
        word, _, share = part.replace("=", " ").rpartition(" ")
        try:
            value = quantity.value_of(share, "")
        except ValueError:
            value = -1.0
        if not word or word.strip() in found:
            raise SuggestError(f'--spread {text!r}: give "Dr 10%, su 20%", each once')
        if not 0 < value <= MOST:
            raise SuggestError(
                f"--spread: {part!r} is no coefficient of variation from 0 to"
                f" {MOST:.0%}, as in Dr 10%; of a larger one give --low and --high"
            )
        found[word.strip()] = value
    return found


def weakest(text: str) -> float:
    """Return the least factor of s_u in the study of a spread. Raises SuggestError."""
    spread = spread_of(text)
    most = max((v for w, v in spread.items() if DERIVED.get(w) == STRENGTH), default=0)
    return max(LEAST_FACTOR, 1 - CUT * most)


def check(options: argparse.Namespace) -> None:
    """Refuse what does not go together. Raises SuggestError."""
    has_ends = bool(options.low or options.high)
    if options.cpt and (has_ends or options.spread):
        raise SuggestError(
            "a cone test has its own low and high estimates: leave out --low, --high"
            " and --spread"
        )
    if has_ends and options.spread:
        raise SuggestError("give --spread, or --low and --high, not both")


def estimates_of(options: argparse.Namespace) -> list[str]:
    """Return which estimates there are beside the best one."""
    if options.cpt or options.spread:
        return list(SIGNS)
    return [estimate for estimate in SIGNS if getattr(options, estimate)]


def changed_by(
    texts: Sequence[str], ends: Sequence[str], option: str, known: Mapping[str, str]
) -> Change:
    """Return what sets the entries that are given of low or high layers. Raises
    SuggestError."""
    tops = [head_of(text)[0] for text in texts]
    by_top: dict[float, str] = {}
    for text in ends:
        top, rest = head_of(text)
        if top in by_top or top not in tops:
            why = "twice" if top in by_top else "and no layer begins there"
            raise SuggestError(
                f"--{option} {text!r} names the top {top:g} m {why}; the tops are"
                f" {', '.join(f'{x:g}' for x in tops)} m"
            )
        by_top[top] = rest

    def change(top: float, texts: dict[str, str]) -> Given:
        new = texts_in(by_top.get(top, ""), known, texts.get("Law", ""))
        density = {sand.SAND, density_law.DENSITY}
        gone = density if density & set(new) else set()
        return {k: v for k, v in texts.items() if k not in gone} | new, {}

    return change


def spread_by(
    spread: Mapping[str, float], sign: int, known: Mapping[str, str], used: set[str]
) -> Change:
    """Return what multiplies the numbers of a layer; used: the symbols that a layer
    has, which are added. Raises SuggestError."""

    def change(_: float, texts: dict[str, str]) -> Given:
        factors: dict[str, float] = {}
        if sand.SAND in texts:
            word = texts.pop(sand.SAND)
            texts[density_law.DENSITY] = sand.density_of_word(word).value
        for word, variation in spread.items():
            name = name_in(word, known, texts.get("Law", ""))
            if name in INVERSE:
                raise SuggestError(
                    f"--spread: a larger {word} is no higher resistance; give --low"
                    " and --high"
                )
            if name in texts:
                factors[name] = 1 + sign * WIDTH * variation
                used.add(word)
        if density_law.DENSITY in factors:
            most = 1 / quantity.value_of(texts[density_law.DENSITY], "")
            factors[density_law.DENSITY] = min(factors[density_law.DENSITY], most)
        return texts, factors

    return change


def of_texts(
    texts: Sequence[str],
    known: Mapping[str, str],
    law: str,
    options: argparse.Namespace,
) -> dict[str, list[Layer]]:
    """Return the layers of the low and the high estimate beside those that are given
    in words. Raises SuggestError."""
    found, used = dict[str, list[Layer]](), set[str]()
    spread = spread_of(options.spread) if options.spread else {}
    for estimate in estimates_of(options):
        if spread:
            change = spread_by(spread, SIGNS[estimate], known, used)
        else:
            change = changed_by(texts, getattr(options, estimate), estimate, known)
        found[estimate] = layers_of(texts, known, law, change)
        if not spread:
            best = layers_of(texts, known, law)
            refuse_exchanged(best, found[estimate], estimate)
    if missing := [word for word in spread if word not in used]:
        raise SuggestError(
            f"--spread: no layer gives {' or '.join(missing)}; it counts for numbers"
            " of --layer, and what is assumed follows them"
        )
    return found


def quantities_of(layer: Layer, bottom: float) -> list[list[float]]:
    """Return what gives a layer its resistance, at some depths, from the strength to
    what counts less; all grow with it."""
    depths = np.linspace(layer.top, bottom, 5).tolist()

    def at_depths(name: str, sign: float = 1.0) -> list[float]:
        found = (clay.number_of(layer, name, depth) for depth in depths)
        return [sign * value for value in found if value is not None]

    strengths = [at_depths(name) for name in OF_RESISTANCE[:-1]]
    angle, cohesion = at_depths("Friction angle"), at_depths("Cohesion")
    if angle and cohesion:  # together they are one strength
        stresses = [max(clay.USUAL_WEIGHT * depth, 1.0) for depth in depths]
        together = [
            c + s * tan(radians(a)) for c, s, a in zip(cohesion, stresses, angle)
        ]
        strengths.insert(0, together)
    return [
        *strengths,
        *(at_depths(name, -1.0) for name in ("Void ratio", "Porosity")),
        at_depths(OF_RESISTANCE[-1]),
    ]


def refuse_exchanged(
    best: Sequence[Layer], layers: Sequence[Layer], estimate: str
) -> None:
    """Refuse a layer that has more resistance in the low estimate than in the best one,
    or less in the high one, by the first quantity in which they differ. Raises
    SuggestError."""
    sign = SIGNS[estimate]
    bottoms = [layer.top for layer in best[1:]] + [best[-1].top + DEPTH_OF_LAST]
    for one, other, bottom in zip(best, layers, bottoms):
        if one.value("Law") != other.value("Law"):
            continue
        for a, b in zip(quantities_of(one, bottom), quantities_of(other, bottom)):
            if len(a) != len(b) or not (change := sign * (sum(b) - sum(a))):
                continue
            if change < 0:
                more = "more" if sign < 0 else "less"
                raise SuggestError(
                    f"--{estimate}: the layer from {one.top:g} m has {more} resistance"
                    " than its --layer; exchange --low and --high, or the values"
                )
            break


def study_of(
    options: argparse.Namespace,
    texts: Sequence[str],
    layers: Sequence[Layer],
    deep: Sequence[Layer],
    known: Mapping[str, str],
) -> str:
    """Return the text of a study of twenty runs in soil of --spread. texts, layers: of
    the best estimate; deep: those that the skirt reaches. Raises SuggestError."""
    follows = options.wall_friction is None and not any(map(is_by_density, deep))
    wall = wall_friction_of(None, deep).value if follows else ""
    spread = spread_of(options.spread)
    return template(Path(__file__).with_name("spread_study.toml.jinja")).render(
        scene=os.path.relpath(options.file, options.study.parent),
        spread=options.spread,
        cut=CUT,
        least=LEAST_FACTOR,
        factors=factors_of(texts, layers, known, spread, "" if wall == "0" else wall),
    )


def factors_of(
    texts: Sequence[str],
    layers: Sequence[Layer],
    known: Mapping[str, str],
    spread: Mapping[str, float],
    wall: str,
) -> dict[str, tuple[float, str, dict[str, str]]]:
    """Return for each symbol of a spread its coefficient of variation, the largest
    factor ("" for any), and the entries that it multiplies, of all layers. wall: the
    friction angle of the walls (degrees), "" where it does not follow that of soil."""
    found = {}
    for word, variation in spread.items():
        entries, most = dict[str, str](), ""
        for i, (text, layer) in enumerate(zip(texts, layers), 1):
            given = texts_in(head_of(text)[1], known)
            name = name_in(word, known, given.get("Law", ""))
            if name not in given and not (
                name == density_law.DENSITY and sand.SAND in given
            ):
                continue
            for entry in OF_STRENGTH if name == STRENGTH else [name]:
                if value := layer.value(entry):
                    entries[f"Soil/Layer {i}/{entry}"] = value
            if name == density_law.DENSITY:
                largest = 0.9999 / float(layer.value(name))
                most = f"{min(largest, float(most or largest)):.6g}"
            if name in ANGLES_OF_FRICTION[:2] and wall:
                sides = [f"{WALL.format(side)}" for side in ("outer", "inner")]
                entries |= dict.fromkeys(sides, wall)
        found[word] = variation, most, entries
    return found


def name_in(word: str, known: Mapping[str, str], law: str) -> str:
    """Return the entry that a symbol names in a layer of a law, "" for none."""
    try:
        return name_of(word, known, law)
    except SuggestError:  # an entry of another law
        return ""
