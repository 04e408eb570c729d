# SPDX-License-Identifier: LGPL-2.1-or-later
"""Entries of sand that is given by its density: a word, or the relative density.

What is not given is that of quartz sand of the sea bed, with its source in a few words.
The modulus is one of triaxial tests on sand of this density (caisson.design.density):
one in proportion to the cone resistance would count the density twice.
"""
import difflib
import math
import re
from collections.abc import Iterable, Mapping

from caisson import density_law as names
from caisson.units import GRAVITY, QUARTZ_DENSITY, WATER_DENSITY
from caisson.suggest.entry import ASSUMPTION, Entry, SuggestError, number_in
from caisson.design.density import ATMOSPHERE, CRITICAL_ANGLE, density_of_angle
from caisson.design.density import reference_modulus

# relative density in the middle of a class, and its ends in % (ISO 14688-2)
WORDS = {
    "very loose": (0.075, "0 to 15 %"),
    "loose": (0.25, "15 to 35 %"),
    "medium dense": (0.5, "35 to 65 %"),
    "dense": (0.75, "65 to 85 %"),
    "very dense": (0.925, "85 to 100 %"),
}
LEAST_PERCENT = 10.0  # a relative density that may be meant in %
LAWS = {"density": names.LAW, "hypoplastic": names.HYPOPLASTIC}
LAW_REMARKS = {
    names.LAW: " # phi and psi of each point follow from both (Bolton 1986)",
    names.HYPOPLASTIC: " # of Karlsruhe sand; its tip is too strong if very dense",
}
SAND = "Sand"  # in place of an entry: one of WORDS
KARLSRUHE = (0.53, 0.84)  # void ratios of the relative densities 1 and 0
OF_START = " # that of the start: sand that dilates becomes softer (Hardin)"
OF_KARLSRUHE = f"{ASSUMPTION}: Karlsruhe sand (Herle & Gudehus 1999)"
OF_DENSITY = "60 MPa D_r (Brinkgreve, Engin & Engin 2010)"
# of tan = 0.55, the largest of UWA-05 for steel piles in sand; quoted, unconfirmed
WALL_FRICTION = Entry("", "29", f"{ASSUMPTION}: steel in sand, UWA-05, any density")
# what no law by density has
FOREIGN = ("Friction angle", "Dilatancy angle", "Cohesion", "Porosity")


def word_of(text: str) -> str:
    """Return a word of WORDS as it may be written: "Medium-dense sand" or "medium";
    other texts as they are."""
    word = " ".join(re.sub(r"[-_]", " ", text.lower()).removesuffix("sand").split())
    return "medium dense" if word == "medium" else word


def density_of_word(text: str) -> Entry:
    """Return the relative density of a word. Raises SuggestError."""
    word = word_of(text)
    if word not in WORDS:
        near = difflib.get_close_matches(word, WORDS, n=1)
        hint = f"; did you mean {near[0]}?" if near else ""
        raise SuggestError(
            f"{text!r} is no density of sand, which is one of {', '.join(WORDS)}{hint}"
            ' (clay is given by its strength, --layer "0: su = 20 kPa")'
        )
    density, ends = WORDS[word]
    remark = f"{ASSUMPTION}: middle of {word!r}, {ends} (ISO 14688-2)"
    return Entry(names.DENSITY, f"{density:g}", remark)


def density_of_number(text: str) -> Entry:
    """Return a relative density that is given. Raises SuggestError."""
    if (value := number_in(text)) is None:
        value = -1.0
    if 1 < value <= 100:
        hint = f". Did you mean {value / 100:g}?" if value >= LEAST_PERCENT else ""
        raise SuggestError(
            f"a relative density of {text} is not from 0 to 1: it is a share of 1{hint}"
        )
    if not 0 <= value <= 1:
        raise SuggestError(f"a relative density of {text} is no number from 0 to 1")
    return Entry(names.DENSITY, text)


def is_by_density(given: Mapping[str, str]) -> bool:
    """Return whether a layer is sand by its density, from the entries given."""
    if SAND in given or given.get("Law") == names.LAW:
        return True
    has_law = given.get("Law", names.LAW) in LAWS.values()
    return names.DENSITY in given and has_law and not set(FOREIGN) & set(given)


def sand_of(given: Mapping[str, str], law: str) -> list[Entry]:
    """Return the entries of a layer of sand: those given, and what is assumed. law: a
    name of LAWS, for a layer that has none. Raises SuggestError."""
    rest = dict(given)
    law = rest.pop("Law", LAWS[law])
    if law not in LAWS.values():
        raise SuggestError(f"{SAND} goes with the laws {', '.join(LAWS.values())} only")
    if foreign := sorted(set(rest) & set(FOREIGN)):
        raise SuggestError(
            f"sand by its density has no {' and no '.join(foreign)} of its own; the law"
            f" {law!r} takes them from the density. Leave out either"
        )
    word, number = rest.pop(SAND, None), rest.pop(names.DENSITY, None)
    if (word is None) == (number is None):
        raise SuggestError(f"sand needs one of {SAND} and {names.DENSITY}")
    density = density_of_word(word) if word else density_of_number(number or "")
    return entries_of(density, law, [Entry(*pair) for pair in rest.items()])


def entries_of(density: Entry, law: str, known: Iterable[Entry]) -> list[Entry]:
    """Return the entries of sand of a relative density: those known, and what is
    assumed."""
    by_name = {entry.name: entry for entry in known}
    limits = [
        by_name.get(name, Entry(name, f"{value:g}", OF_KARLSRUHE))
        for name, value in zip((names.DENSEST, names.LOOSEST), KARLSRUHE)
    ]
    densest, loosest = (float(entry.value) for entry in limits)
    share = float(density.value)
    void_ratio = loosest - share * (loosest - densest)
    assumed = [
        Entry("Law", law, LAW_REMARKS[law]),
        density,
        *limits,
        *numbers_of(law, share, void_ratio, by_name),
    ]
    found = {entry.name: entry for entry in assumed} | by_name
    return list(found.values())


def modulus_of(angle: str) -> Entry | None:
    """Return Youngs modulus of sand that is given by its friction angle (degrees), by
    the density that the design methods take for it; None for an expression."""
    if (degrees := number_in(angle)) is None:
        return None
    density = float(density_of_angle(degrees, ATMOSPHERE, ATMOSPHERE))
    modulus = f"{reference_modulus(density):.3g}"
    why = f"D_r = {density:.2g} by phi (Bolton 1986), {OF_DENSITY}"
    return Entry("Youngs modulus", modulus, f"{ASSUMPTION}: {why}")


def at_rest(angle: str) -> list[Entry]:
    """Return K0 for a critical angle (degrees); nothing for an expression, whose K0 the
    program finds."""
    if (degrees := number_in(angle)) is None:
        return []
    k0 = 1 - math.sin(math.radians(degrees))
    why = f"{ASSUMPTION}: 1 - sin {angle} (Jaky 1948); an old sea bed may have 1"
    return [Entry("K0", f"{k0:.2g}", why)]


def numbers_of(
    law: str, density: float, void_ratio: float, given: Mapping[str, Entry]
) -> list[Entry]:
    """Return what is assumed of sand of a relative density, at the start, beside the
    entries that are given. With an overconsolidation ratio K0 is left to the program.
    """
    weight = (QUARTZ_DENSITY - WATER_DENSITY) * GRAVITY / (1 + void_ratio) / 1e3
    own, angle = list[Entry](), "30"  # of Karlsruhe sand
    if law == names.LAW:
        angle = f"{CRITICAL_ANGLE:g}"
        own = [
            Entry(
                names.CRITICAL_ANGLE,
                angle,
                f"{ASSUMPTION}: quartz (Bolton 1986); the peak follows from density",
            ),
            Entry(
                names.MODULUS,
                f"{reference_modulus(density):.3g}",
                f"{ASSUMPTION}: {OF_DENSITY}",
            ),
            Entry(names.REFERENCE_STRESS, f"{ATMOSPHERE:g}"),
            Entry(names.EXPONENT, "0.5", ASSUMPTION),
            Entry(
                names.REFERENCE_VOID_RATIO,
                f"{void_ratio:.4g}",
                OF_START,
            ),
            Entry(names.POISSON, "0.3", ASSUMPTION),
        ]
    if names.CRITICAL_ANGLE in given:
        angle = given[names.CRITICAL_ANGLE].value
    return [
        *own,
        *([] if "Overconsolidation ratio" in given else at_rest(angle)),
        Entry(
            "Solid density",
            f"{QUARTZ_DENSITY:g}",
            f"{ASSUMPTION}: quartz; the unit weight in water is {weight:.3g} kN/m3",
        ),
    ]
