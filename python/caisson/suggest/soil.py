# SPDX-License-Identifier: LGPL-2.1-or-later
"""Layers of soil as they are given in words: "TOP: ENTRY = VALUE, ENTRY = VALUE". Sand
may be given by its density: "TOP: Sand = dense", "TOP: Relative density = 0.85"."""
import difflib
from collections.abc import Iterable, Sequence

from caisson.suggest import sand
from caisson.suggest.entry import ASSUMPTION, Entry, Layer, SuggestError

MOHR_COULOMB = "Mohr-Coulomb"
BY_STRESS = "Mohr-Coulomb with stiffness by stress"
# what soil of a law of Mohr-Coulomb has where nothing is given
ASSUMED = {
    "Law": MOHR_COULOMB,
    "Poisson ratio": "0.3",
    "Dilatancy angle": "0",
    "Cohesion": "0",
    "Porosity": "0.4",
    "Solid density": "2650",
}
NEEDED = ("Friction angle", "Youngs modulus")


def name_of(word: str, known: Sequence[str]) -> str:
    """Return the entry meant. Raises SuggestError."""
    by_lower = {name.lower(): name for name in (*known, sand.SAND)}
    if word.lower() in by_lower:
        return by_lower[word.lower()]
    near = difflib.get_close_matches(word.lower(), by_lower, n=3, cutoff=0.4)
    hint = "; did you mean " + " or ".join(by_lower[n] for n in near) if near else ""
    raise SuggestError(
        f"--layer: a layer has no entry {word!r}{hint}?".replace("??", "?")
    )


def parts_of(text: str) -> list[str]:
    """Return the parts of a text between commas; those within parentheses, as in
    min(5, d), divide nothing."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter == "(") - (letter == ")")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip()]


def layer_of(text: str, known: Sequence[str], law: str) -> Layer:
    """Return a layer. known: the names of all entries of a layer; law: of sand by its
    density, a name of sand.LAWS. Raises SuggestError."""
    head, colon, rest = text.partition(":")
    try:
        top = float(head)
    except ValueError:
        top = -1.0
    if not colon or top < 0:
        raise SuggestError(
            f"--layer {text!r} must begin with the depth of its top in meters and a"
            ' colon, as in "0: Friction angle = 33, Youngs modulus = 20e6"'
        )
    given = {}
    for part in parts_of(rest):
        word, equals, value = map(str.strip, part.partition("="))
        if not equals or not value:
            raise SuggestError(f"--layer: {part!r} is not of the form ENTRY = VALUE")
        given[name_of(word, known)] = value
    if sand.is_by_density(given):
        return Layer(top, sand.sand_of(given, law))
    return Layer(top, entries_of(given, text))


def entries_of(given: dict[str, str], text: str) -> list[Entry]:
    """Return the entries given and, for Mohr-Coulomb soil, those assumed. Raises
    SuggestError where one is missing that cannot be assumed."""
    if not given.get("Law", MOHR_COULOMB).startswith(MOHR_COULOMB):
        return [Entry(*pair) for pair in given.items()]
    missing = [name for name in NEEDED if name not in given]
    if missing:
        raise SuggestError(
            f"--layer {text!r} needs {' and '.join(missing)}; or, of sand,"
            f' "{sand.SAND} = dense"'
        )
    assumed = {n: v for n, v in ASSUMED.items() if n not in given}
    return [
        *(Entry(n, v, "" if n == "Law" else ASSUMPTION) for n, v in assumed.items()),
        *(Entry(*pair) for pair in given.items()),
    ]


def layers_of(texts: Iterable[str], known: Sequence[str], law: str) -> list[Layer]:
    """Return all layers. law: of sand by its density. Raises SuggestError."""
    layers = [layer_of(text, known, law) for text in texts]
    tops = [layer.top for layer in layers]
    if tops[:1] != [0.0]:
        raise SuggestError("the first --layer must begin at 0")
    if any(a >= b for a, b in zip(tops, tops[1:])):
        raise SuggestError("each --layer must begin deeper than the one before")
    return layers
