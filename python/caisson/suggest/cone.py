# SPDX-License-Identifier: LGPL-2.1-or-later
"""Layers of a scene, and low, best and high estimates for a study, from a cone test."""
from caisson import density_law
from caisson.band import BEST
from caisson.design.cone_texts import SHOWN, text_of
from caisson.units import QUARTZ_DENSITY
from caisson.suggest import clay, sand
from caisson.suggest.entry import ASSUMPTION, Entry, Layer, SuggestError
from caisson.suggest.soil import ASSUMED
from caisson.suggest.walls import ADHESION_OF_CLAY
from caisson.design import correlations
from caisson.design.cone_estimates import K0, REFERENCE, WEIGHT, Estimates
from caisson.design.cone_estimates import is_answered
from caisson.design.correlations import DENSITY, MODULUS, STRENGTH
from caisson.design.cone_rules import GIVEN
from caisson.design.ground import CLAY, SAND, SILT
from caisson.design.interpretation import Interpretation

REACH = 1.5  # times the skirt: the test counts to this depth
GOES_ON = 4.0  # times the end of the test: the deepest mesh there


def refuse_silt(found: Interpretation, end: float) -> None:
    """Refuse silt that the skirt reaches. Raises SuggestError."""
    silt = [
        number
        for number, e in enumerate(found.layers, 1)
        if e.layer.kind == SILT and e.layer.top < end
    ]
    if silt:
        layers = [found.layers[number - 1].layer for number in silt]
        where = [
            f"layer {number}, {layer.top:g} to {layer.bottom:g} m"
            for number, layer in zip(silt, layers)
        ]
        sand, clay = (
            " ".join(f"--soil {number}={kind}" for number in silt)
            for kind in (SAND, CLAY)
        )
        raise SuggestError(
            f"{found.name}: {'; '.join(where)}, is silt, of which a cone test does not"
            f" tell how far it drains while the skirt passes. Say it: {sand} if it"
            f" drains, {clay} if it does not"
        )


def refuse_no_strength(found: Interpretation) -> None:
    """Refuse clay and silt in which the cone met nothing. Raises SuggestError."""
    for number, e in enumerate(found.layers, 1):
        if e.layer.kind != SAND and e.values[STRENGTH].low <= 0:
            raise SuggestError(
                f"{found.name}: layer {number}, {e.layer.top:g} to"
                f" {e.layer.bottom:g} m, has no strength: its cone resistance does not"
                " exceed the total vertical stress. Check the zero of the test,"
                f" --unit-weight and the kind of soil, as --soil {number}={SAND}"
            )


def end_of_test(found: Interpretation, end: float) -> str:
    """Return a warning where a test ends above the end of a run (m), else nothing."""
    deepest = float(found.ground.depth[-1])
    if deepest >= end:
        return ""
    return (
        f"warning: {found.name} ends at {deepest:g} m, and the tip goes to {end:g} m:"
        " the last layer is taken to go on"
    )


def remark(found: Interpretation, e: Estimates, name: str) -> str:
    """Return where the value of a parameter comes from."""
    names = found.names | {REFERENCE: found.names[MODULUS], WEIGHT: found.weight}
    source, shown = names[name], SHOWN[name]
    if source == correlations.OWN_CONE and not is_answered(found.ground, e, names):
        source = correlations.IN_CHAMBERS
    words = text_of(e.values[name], shown, e.layer.top)
    text = f" # FROM CPT ({source}): {shown.head} {words}"
    start, layer = found.ground.measured_from, e.layer
    if layer.top < start and found.ground.above == GIVEN:
        return text.replace("CPT", "--above", 1)
    where = [f"above {start:g} m"] if layer.top < start else []
    where += [
        f"from {max(a, layer.top):g} to {min(b, layer.bottom):g} m"
        for a, b in found.ground.gaps
        if a < layer.bottom and b > layer.top
    ]
    if not where:
        return text
    places = " and ".join(where)
    return f"{ASSUMPTION} {places}, where nothing was measured;{text[2:]}"


def value_of(e: Estimates, name: str, end: str) -> str:
    """Return low, best or high of a parameter: a number, or a line over the depth d."""
    estimate = e.values[name]
    if not estimate.growth:
        return f"{estimate.at(end):.4g}"
    value, gradient = estimate.line(end, e.layer.top)  # whose difference counts
    return f"{value:.6g} {'+' if gradient > 0 else '-'} {abs(gradient):.6g}*d"


def void_ratios_of(e: Estimates) -> tuple[float, float]:
    """Return the void ratios of the densest and the loosest sand: those of Karlsruhe
    sand, moved so that the layer has the unit weight of the test."""
    densest, loosest = sand.KARLSRUHE
    void_ratio = e.porosity() / (1 - e.porosity())
    shift = void_ratio - loosest + e.values[DENSITY].best * (loosest - densest)
    return round(densest + shift, 4), round(loosest + shift, 4)


def sand_of(found: Interpretation, e: Estimates, end: str) -> list[Entry]:
    """Return the entries of sand whose strength follows from its density, low, best or
    high. Relative density, unit weight and modulus are those of the test."""
    share, modulus = (f"{e.values[x].at(end):.4g}" for x in (DENSITY, REFERENCE))
    densest, loosest = void_ratios_of(e)
    start = loosest - (loosest - densest) * float(share)
    why = f"{ASSUMPTION}: the range of Karlsruhe sand, about the unit weight FROM CPT"
    known = [
        Entry("K0", f"{e.values[K0].best:.4g}", " # FROM CPT"),
        Entry(density_law.DENSEST, f"{densest:g}", why),
        Entry(density_law.LOOSEST, f"{loosest:g}", why),
        Entry(density_law.MODULUS, modulus, remark(found, e, REFERENCE)),
        Entry(density_law.REFERENCE_VOID_RATIO, f"{start:.6g}", sand.OF_START),
    ]
    density = Entry(density_law.DENSITY, share, remark(found, e, DENSITY))
    return sand.entries_of(density, density_law.LAW, known)


def at_rest_of(found: Interpretation, e: Estimates) -> Entry:
    """Return K0 of clay within what its low strength bears, so that it holds for all
    estimates."""
    ground, rows = found.ground, e.layer.rows
    points = list(zip(map(float, ground.depth[rows]), map(float, ground.stress[rows])))
    deep, stress = points[-1]
    if e is found.layers[-1]:  # goes on below the test
        points.append((GOES_ON * deep, GOES_ON * stress))
    low = value_of(e, STRENGTH, "low")
    text = clay.held(float(f"{e.values[K0].best:.4g}"), low, points)
    within = "" if "s" not in text else ", within what the low strength bears"
    return Entry("K0", text, f" # FROM CPT{within}")


def entries_of(found: Interpretation, e: Estimates, end: str) -> list[Entry]:
    """Return the entries of a layer: low, best or high density or strength, and
    stiffness, and what all have in common. Clay, and silt below the skirt, are
    undrained."""
    if e.layer.kind == SAND:
        return sand_of(found, e, end)
    return [
        Entry("Law", ASSUMED["Law"]),
        Entry("Friction angle", "0", f" # {e.layer.kind}, undrained"),
        Entry("Cohesion", value_of(e, STRENGTH, end), remark(found, e, STRENGTH)),
        Entry("Youngs modulus", value_of(e, MODULUS, end), clay.MODULUS_REMARK),
        Entry("Poisson ratio", clay.POISSON, ASSUMPTION),
        at_rest_of(found, e),
        Entry("Friction angle of the walls", "0"),
        ADHESION_OF_CLAY,
        Entry("Dilatancy angle", ASSUMED["Dilatancy angle"], ASSUMPTION),
        Entry("Porosity", f"{e.porosity():.3f}", remark(found, e, WEIGHT)),
        Entry("Solid density", f"{QUARTZ_DENSITY:g}", ASSUMPTION),
    ]


def layers_of(found: Interpretation, end: float, estimate: str = BEST) -> list[Layer]:
    """Return the layers of a scene whose skirt ends at a depth (m): all low, best or
    high together. Raises SuggestError."""
    refuse_silt(found, end)
    refuse_no_strength(found)
    return [Layer(e.layer.top, entries_of(found, e, estimate)) for e in found.layers]
