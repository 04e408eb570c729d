# SPDX-License-Identifier: LGPL-2.1-or-later
"""Layers of soil as they are given in words: "TOP: ENTRY = VALUE, ENTRY = VALUE", with
symbols and units as engineers write them: "0: phi = 33, E = 20 MPa". Sand may be given
by its density: "TOP: Sand = dense", "TOP: Dr = 85%"."""
import difflib
import re
from collections.abc import Callable, Collection, Iterable, Mapping

from caisson import density_law as names
from caisson.units import QUARTZ_DENSITY
from caisson.suggest.entry import ASSUMPTION, Entry, Layer, SuggestError, number_in
from caisson.suggest import clay, sand
from caisson.design import expression, quantity
from caisson.design.ground import porosity_of

MOHR_COULOMB = "Mohr-Coulomb"
# what soil of a law of Mohr-Coulomb has where nothing is given
ASSUMED = {
    "Law": MOHR_COULOMB,
    "Poisson ratio": "0.3",
    "Dilatancy angle": "0",
    "Cohesion": "0",
    "Porosity": "0.4",
    "Solid density": f"{QUARTZ_DENSITY:g}",
}
NEEDED = ("Friction angle", "Youngs modulus")
# what is not assumed, by what is given in its place
REPLACED = {
    "Void ratio": "Porosity",
    names.DENSITY: "Porosity",
    "Dry density": "Solid density",
}

# how engineers write them
WRITTEN = {
    "Friction angle": "phi phi' φ",
    names.CRITICAL_ANGLE: "phi_c",
    "Dilatancy angle": "psi ψ",
    "Cohesion": "c c'",
    "Youngs modulus": "E",
    "Poisson ratio": "nu ν",
    names.DENSITY: "Dr D_r",
    "Overconsolidation ratio": "OCR",
    "Permeability": "k",
    "Void ratio": "e",
    "Porosity": "n",
    "Friction angle of the walls": "delta",
    "Adhesion factor of the walls": "alpha",
}
NGI_ADP = "NGI-ADP"
# of other laws: how their entries are written, and what is assumed; "" is needed
LAWS = {
    NGI_ADP: {
        "Active strength": ("suA s_uA", ""),
        "Direct shear strength ratio": ("suD/suA suDSS/suA sD/suA", "0.7"),
        "Passive strength ratio": ("suP/suA sP/suA", "0.5"),
        "Active failure strain": ("gamma_fA", "0.02"),
        "Direct shear failure strain": ("gamma_fD", "0.04"),
        "Passive failure strain": ("gamma_fP", "0.06"),
        "Unloading shear modulus ratio": ("Gur/suA", "500"),
        "Poisson ratio": ("nu ν", clay.POISSON),
    },
}
# their strength, in place of phi, psi, c and su
INSTEAD = {NGI_ADP: "suA and suD/suA"}
OF_EACH = ("Poisson ratio", "Porosity", "Solid density")  # are assumed there, too
STRENGTH, WEIGHT = "su", "gamma"  # of undrained clay, and the unit weight
DERIVED = {
    **dict.fromkeys((STRENGTH, "s_u", "cu", "c_u"), STRENGTH),
    **dict.fromkeys((WEIGHT, "gamma'", "γ", "γ'", "unit weight"), WEIGHT),
}
UNITS_OF_DERIVED = {STRENGTH: "Pa", WEIGHT: "kN/m3"}
ANGLES_OF_FRICTION = (
    "Friction angle",
    names.CRITICAL_ANGLE,
    "Friction angle of the walls",
)
LIGHTEST_WET = 13.0  # kN/m3; a smaller unit weight is that in water
LEAST_DRAINED = 10.0  # degrees; undrained clay may have less
DOUBTFUL = 11.5, 14.0  # kN/m3; between them it may be either
POROSITIES = (0.1, 0.9)

# least and most of any soil, in the unit of the entry; of a modulus and a strength also
# what is usual, to tell what a number was meant to be
PLAUSIBLE = {
    "Youngs modulus": (5e4, 1e11),
    "Cohesion": (50.0, 1e8),
    "Active strength": (50.0, 1e8),
    "Permeability": (1e-14, 1.0),
    "Solid density": (1500.0, 6000.0),
    "Overconsolidation ratio": (1.0, 200.0),
    "Void ratio": (0.1, 20.0),
    "Porosity": (0.05, 0.95),
    "Friction angle": (0.0, 60.0),
    names.CRITICAL_ANGLE: (0.0, 60.0),
    "Friction angle of the walls": (0.0, 60.0),
    "Dilatancy angle": (-30.0, 45.0),
}
LEAST_OF_SAND = 5e5  # Pa, Youngs modulus of soil with a friction angle
LEAST_RATIO = 10.0  # Youngs modulus over s_u
USUAL = {"Youngs modulus": (2e6, 2e9), "Cohesion": (1e3, 1e6)}
DEEPEST_TOP = 1e3  # m, of a layer
LOOKED_AT = (0.0, 1.0, 3.0, 10.0, 30.0)  # m, depths of an expression
USUAL_GRADIENT = 9e3  # Pa/m, of the vertical effective stress

# texts of a layer by the names of entries, and what their values are multiplied by
Given = tuple[dict[str, str], dict[str, float]]
Change = Callable[[float, dict[str, str]], Given]  # top of a layer (m) and its texts


def law_named(text: str) -> str:
    """Return a law by its name, in which case, spaces and hyphens do not matter."""
    every = (MOHR_COULOMB, *LAWS, *sand.LAWS.values())
    plain = {re.sub(r"[\W_]", "", name).lower(): name for name in every}
    return plain.get(re.sub(r"[\W_]", "", text).lower(), text)


def name_of(word: str, known: Collection[str], law: str) -> str:
    """Return the entry of a law meant, or one of DERIVED. Raises SuggestError."""
    written = WRITTEN | {name: text for name, (text, _) in LAWS.get(law, {}).items()}
    symbols = DERIVED | {s: n for n, text in written.items() for s in text.split()}
    if word in symbols:  # E and e are not the same
        return symbols[word]
    by_lower = {name.lower(): name for name in (*known, sand.SAND)}
    by_lower |= {s.lower(): name for s, name in symbols.items() if len(s) > 1}
    if word.lower() in by_lower:
        return by_lower[word.lower()]
    near = difflib.get_close_matches(word.lower(), by_lower, n=3, cutoff=0.4)
    hint = (
        f"; did you mean {' or '.join(dict.fromkeys(by_lower[n] for n in near))}?"
        if near
        else "; caisson_mpm --explain 'Layer 1' lists them"
    )
    if law not in LAWS and (near := difflib.get_close_matches(law, LAWS)):
        hint += f"; the law may be {near[0]}"
    raise SuggestError(f"--layer: a layer of {law} has no entry {word!r}{hint}")


def value_of(
    name: str, text: str, known: Mapping[str, str], symbols: Mapping[str, str]
) -> str:
    """Return the value of an entry in its own unit. Raises SuggestError."""
    unit = (known | UNITS_OF_DERIVED).get(name, "")
    try:
        value = expression.without_unit(text, unit, symbols if unit == "Pa" else {})
        if name in UNITS_OF_DERIVED and not any(
            map(expression.has_unit, expression.tokens_of(text))
        ):
            number, of_it = ("8.5", "kN/m3") if name == WEIGHT else ("20", "kPa")
            is_number = re.fullmatch(quantity.NUMBER, text)
            example = number if is_number else f"({text})"
            raise ValueError(f"{text}: give its unit, as in {name} = {example} {of_it}")
        if name in ANGLES_OF_FRICTION:
            quantity.refuse_tangent(text)
    except ValueError as error:
        raise SuggestError(f"--layer: {name} = {error}") from error
    if name in ANGLES_OF_FRICTION:
        if re.fullmatch(quantity.NUMBER, value) and float(value) == 0:
            return "0"  # which is asked for where clay is told from sand
    return value


def hint_for(part: str) -> str:
    """Return what may be meant by a part of a layer without an equals sign."""
    if re.fullmatch(rf"\d+\s*({'|'.join(quantity.EVERY)})?", part):
        return "; decimals have a point, as 33.5"
    if "clay" in part.lower():
        return "; clay is given by its strength, as in su = 20 kPa"
    near = difflib.get_close_matches(sand.word_of(part), sand.WORDS, n=1)
    return f"; did you mean {near[0]}?" if near else ""


def pair_of(part: str) -> tuple[str, str]:
    """Return the words around the equals sign. Sand may be named by its state alone.
    Raises SuggestError."""
    word, equals, value = map(str.strip, part.partition("="))
    if not equals and sand.word_of(part) in sand.WORDS:
        return sand.SAND, part
    if not equals or not value:
        raise SuggestError(
            f"--layer: {part!r} is not of the form ENTRY = VALUE{hint_for(part)}"
        )
    return word, value


def texts_in(text: str, known: Mapping[str, str], law: str = "") -> dict[str, str]:
    """Return what is given of a layer as it is written, by names of entries. law: of
    the layer whose entries these change, "" for a layer of its own. Raises
    SuggestError."""
    found = re.search(r"(?:^|,)\s*law\s*=\s*([^,]+)", text, re.I)
    law = law_named(found[1].strip()) if found else law or MOHR_COULOMB
    texts: dict[str, str] = {}
    for word, value in map(pair_of, quantity.parts_of(text)):
        name = name_of(word, known, law)
        if name in texts:
            raise SuggestError(f"--layer {text!r} gives {name} twice")
        if law in LAWS and name in (*sand.FOREIGN[:3], STRENGTH):
            raise SuggestError(f"--layer: {law} takes no {word}; give {INSTEAD[law]}")
        texts[name] = law if name == "Law" else value
    return texts


def values_in(
    texts: Mapping[str, str], known: Mapping[str, str], factors: Mapping[str, float]
) -> dict[str, str]:
    """Return what is given of a layer in the units of the entries. factors: of those
    that are not as they are given. Raises SuggestError."""
    symbols: dict[str, str] = {}

    def value(name: str) -> str:
        found = value_of(name, texts[name], known, symbols)
        if (factor := factors.get(name)) is None:
            return found
        number = number_in(found)
        return f"{factor:.6g}*({found})" if number is None else f"{factor * number:.6g}"

    if STRENGTH in texts:  # other entries may be multiples of it
        strength = value(STRENGTH)
        symbols = {s: strength for s, n in DERIVED.items() if n == STRENGTH}
    return {name: value(name) for name in texts}


def head_of(text: str) -> tuple[float, str]:
    """Return the top of a layer (m), and what is given of it. Raises SuggestError."""
    head, colon, rest = text.partition(":")
    try:
        top = quantity.value_of(head, "m")
    except ValueError:
        top = -1.0
    if top > DEEPEST_TOP:
        raise SuggestError(
            f"--layer {text!r} begins at {top:g} m; append mm to a depth in millimeters"
        )
    if not colon or top < 0:
        raise SuggestError(
            f"--layer {text!r} must begin with the depth of its top in meters and a"
            ' colon, as in "0: phi = 33, E = 20 MPa"'
        )
    return top, rest


def layer_of(
    text: str, known: Mapping[str, str], law: str, change: Change | None = None
) -> Layer:
    """Return a layer. known: the units of all entries of a layer by their names; law:
    of sand by its density, a name of sand.LAWS. Raises SuggestError."""
    top, rest = head_of(text)
    texts, factors = texts_in(rest, known), dict[str, float]()
    if change:
        texts, factors = change(top, texts)
    given = values_in(texts, known, factors)
    as_cohesion = {"Cohesion": given[STRENGTH]} if STRENGTH in given else {}
    refuse_implausible({**given, **as_cohesion}, known)
    weight, strength = given.pop(WEIGHT, ""), given.pop(STRENGTH, "")
    if is_clay_by_angle(given):
        strength = given.pop("Cohesion")
        del given["Friction angle"]
    derived = (undrained(strength, given) if strength else []) + (
        weight_of(weight, given) if weight else []
    )
    is_by_density = sand.is_by_density(given)
    if derived and is_by_density:
        raise SuggestError(
            f"--layer {text!r}: unit weight and strength of sand by its density follow"
            f" from that: leave out {' and '.join(e.name for e in derived)}"
        )
    if is_by_density:
        return Layer(top, sand.sand_of(given, law))
    angle, modulus = given.get("Friction angle", ""), "Youngs modulus"
    is_plain = given.get("Law", MOHR_COULOMB).startswith(MOHR_COULOMB)
    if is_plain and angle and not strength and modulus not in given:
        if names.DENSITY in given and names.DENSEST not in given:
            raise SuggestError(
                f"--layer {text!r} gives friction angle and relative density: leave"
                " out either; the angle follows from the density"
            )
        derived += filter(None, [sand.modulus_of(angle)])
    remarks = {entry.name: entry for entry in derived}
    entries = entries_of(given | {e.name: e.value for e in derived}, text)
    warning = doubt_of(weight, given) if weight else ""
    return Layer(top, [remarks.get(e.name, e) for e in entries], warning)


def values_at_depths(text: str) -> list[float]:
    """Return an entry at some depths; none where its form is not known."""
    values = (
        expression.value_at(text, d, max(USUAL_GRADIENT * d, 1.0)) for d in LOOKED_AT
    )
    return [value for value in values if value is not None]


def meant_by(name: str, value: float, unit: str) -> str:
    """Return what a number may have been meant to be, or nothing."""
    least, most = USUAL.get(name, USUAL["Cohesion"])
    words = (
        {"kPa": 1e3, "MPa": 1e6} if unit == "Pa" else {"%": 0.01} if not unit else {}
    )
    if unit != "Pa":
        least, most = PLAUSIBLE[name]
    for word, factor in words.items():
        if least <= value * factor <= most:
            return f": did you mean {value:g}{'' if word == '%' else ' '}{word}?"
    return ""


def refuse_implausible(given: Mapping[str, str], known: Mapping[str, str]) -> None:
    """Refuse values that no soil has: their unit is missing or another one. given: what
    is given of a layer, in the units of the entries. Raises SuggestError."""
    for name, text in given.items():
        found = values_at_depths(text) if name in PLAUSIBLE else []
        if not found or name == "Cohesion" and max(found) <= 0:
            continue
        least, most = PLAUSIBLE[name]
        if name == "Youngs modulus":
            (angle,) = values_at_depths(given.get("Friction angle", "0"))[:1] or (0.0,)
            strength = values_at_depths(given.get("Cohesion", "0")) or [0.0]
            if angle >= LEAST_DRAINED and max(strength) == 0:
                least = LEAST_OF_SAND
            elif angle == 0:
                least = max(least, LEAST_RATIO * max(strength))
        if max(found) < least or min(found) > most:
            value, unit = (max if max(found) < least else min)(found), known.get(
                name, ""
            )
            raise SuggestError(
                f"--layer: {name} = {value:g} {unit}".rstrip()
                + f" is outside {least:g} to {most:g}, the range of soil"
                + meant_by(name, value, unit)
            )


def is_clay_by_angle(given: Mapping[str, str]) -> bool:
    """Return whether Mohr-Coulomb soil is undrained clay because its angle is 0."""
    is_plain = given.get("Law", MOHR_COULOMB) == MOHR_COULOMB
    return is_plain and given.get("Friction angle") == "0" and "Cohesion" in given


def undrained(strength: str, given: Mapping[str, str]) -> list[Entry]:
    """Return the entries of clay with an undrained strength (Pa), beside those given.
    Raises SuggestError."""
    if wrong := [name for name in ("Friction angle", "Cohesion") if name in given]:
        raise SuggestError(
            f"--layer: {STRENGTH} is the strength of undrained clay, which has no"
            f" {' and no '.join(wrong)} of its own; leave out either"
        )
    if re.fullmatch(r"-.*|0*\.?0*(e.*)?", strength.strip()):
        raise SuggestError(f"--layer: {STRENGTH} = {strength} Pa must be positive")
    found = [
        Entry("Friction angle", "0", " # undrained"),
        Entry("Cohesion", strength, " # s_u"),
        # with none, clay that opens at the tip gains volume and the plug heaves too
        # much; with s_u, soft clay comes off the wall
        Entry("Tension cut-off", f"0.25*({strength})", f"{ASSUMPTION}: s_u / 4"),
        Entry("Poisson ratio", clay.POISSON, f"{ASSUMPTION}: undrained"),
        clay.modulus_of(strength),
    ]
    return [entry for entry in found if entry.name not in given]


def doubt_of(weight: str, given: Mapping[str, str]) -> str:
    """Return a warning where a unit weight (kN/m3) may be that in water or that of the
    wet soil, else nothing."""
    value = float(weight)
    if not DOUBTFUL[0] <= value <= DOUBTFUL[1]:
        return ""
    grains = float(given.get("Solid density", ASSUMED["Solid density"]))
    words = ["in water", "of the wet soil"]
    is_wet = value > LIGHTEST_WET
    taken, other = reversed(words) if is_wet else words
    porosities = [porosity_of(value, grains, wet) for wet in (is_wet, not is_wet)]
    return (
        f"{WEIGHT} = {weight} kN/m3 is taken as the unit weight {taken}, with a"
        f" porosity of {porosities[0]:.2f}; if it is that {other}, give Porosity ="
        f" {porosities[1]:.2f} instead"
    )


def weight_of(weight: str, given: Mapping[str, str]) -> list[Entry]:
    """Return the porosity that a unit weight (kN/m3) stands for, with the density of
    the grains. Raises SuggestError."""
    if wrong := [name for name in ("Porosity", *REPLACED) if name in given]:
        raise SuggestError(f"--layer: give {WEIGHT} or {', '.join(wrong)}, not both")
    solid = given.get("Solid density", ASSUMED["Solid density"])
    try:
        value, grains = float(weight), float(solid)
    except ValueError as error:
        raise SuggestError(f"--layer: {WEIGHT} must be a number: {error}") from error
    is_wet = value > LIGHTEST_WET
    porosity = porosity_of(value, grains, is_wet)
    if not POROSITIES[0] < porosity < POROSITIES[1]:
        raise SuggestError(
            f"--layer: with a unit weight of {weight} kN/m3 and grains of {grains:g}"
            f" kg/m3 the porosity is {porosity:.2f}: check both"
        )
    how = "of the wet soil" if is_wet else "in water"
    found = [Entry("Porosity", f"{porosity:.4f}", f" # {weight} kN/m3 {how}")]
    if "Solid density" not in given:
        found.append(Entry("Solid density", solid, ASSUMPTION))
    return found


def entries_of(given: dict[str, str], text: str) -> list[Entry]:
    """Return the entries given and those assumed. Raises SuggestError where one is
    missing that cannot be assumed."""
    is_plain = (law := given.get("Law", MOHR_COULOMB)).startswith(MOHR_COULOMB)
    if not is_plain and law not in LAWS:
        return [Entry(*pair) for pair in given.items()]
    usual = ASSUMED | dict.fromkeys(NEEDED, "")
    if not is_plain:
        usual = {name: ASSUMED[name] for name in OF_EACH}
        usual |= {name: value for name, (_, value) in LAWS[law].items()}
    known = {*given, *(REPLACED.get(name, name) for name in given)}
    if is_clay_by_angle(given):  # follow from the strength: clay.with_states
        known |= {"Porosity", "K0"}
    assumed = {n: v for n, v in usual.items() if n not in known}
    if missing := [name for name, value in assumed.items() if not value]:
        or_sand = f'; or, of sand, "{sand.SAND} = dense"' if is_plain else ""
        needed = " and ".join(missing)
        raise SuggestError(f"--layer {text!r} needs {needed}{or_sand}")
    remarks = {"Law": "", "K0": f"{ASSUMPTION}: that of the law"}
    if not {"K0", "Overconsolidation ratio"} & known:
        assumed["K0"] = "auto"
    return [
        *(Entry(n, v, remarks.get(n, ASSUMPTION)) for n, v in assumed.items()),
        *(Entry(*pair) for pair in given.items()),
    ]


def layers_of(
    texts: Iterable[str],
    known: Mapping[str, str],
    law: str,
    change: Change | None = None,
) -> list[Layer]:
    """Return all layers. law: of sand by its density; change: what is given of each of
    them, before it is read. Raises SuggestError."""
    layers = [layer_of(text, known, law, change) for text in texts]
    tops = [layer.top for layer in layers]
    if tops[:1] != [0.0]:
        raise SuggestError("the first --layer must begin at 0")
    if any(a >= b for a, b in zip(tops, tops[1:])):
        raise SuggestError("each --layer must begin deeper than the one before")
    return layers
