# SPDX-License-Identifier: LGPL-2.1-or-later
"""The estimates as a table on the terminal and as layers.csv."""
from collections.abc import Sequence
from math import floor, log10
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson.table import markdown, write_csv
from caisson.terminal import printable
from caisson.design.cone_estimates import CAN, ENDS, Estimate, Estimates
from caisson.design.cone_estimates import INDEX, K0, REFERENCE, RESISTANCE, WEIGHT
from caisson.design.cone_estimates import answer_of, is_answered, mean_stress_of
from caisson.design.cone_layers import BAND, Layer
from caisson.design.cone_rules import ASSUMED, GIVEN
from caisson.design.correlations import ANGLE, DENSITY, EVERY, MODULUS, STRENGTH
from caisson.design.correlations import CLAY_RATIOS, IN_CHAMBERS, OWN_CLAY, OWN_CONE
from caisson.design.correlations import PER_DECADE, WALL_VELOCITY
from caisson.design.correlations import computed_cone_factor
from caisson.design.ground import CLAY, CLAY_LIKE, CONE_FACTOR, DRAINED, SAND
from caisson.design.ground import Ground, kind_of
from caisson.design.interpretation import Interpretation
from caisson.design.own_cone import DEEP, is_known
from caisson.design.density import reference_modulus

DIGITS = 2  # of a small value, at least
DOES_NOT_ANSWER = 0.1  # of the resistance of its own cone


class Shown(NamedTuple):
    """How a quantity is shown: its head, the column of the file, and what it is
    multiplied by for both."""

    head: str
    column: str
    scale: float
    digits: int


SHOWN = {
    RESISTANCE: Shown("q_c (MPa)", "qc_MPa", 1e-6, 1),
    INDEX: Shown("I_c", "Ic", 1.0, 2),
    WEIGHT: Shown("unit weight (kN/m3)", "unit_weight_kN_m3", 1e-3, 1),
    DENSITY: Shown("D_r (%)", "relative_density_percent", 100.0, 0),
    ANGLE: Shown("phi (deg)", "friction_angle_deg", 1.0, 1),
    MODULUS: Shown("E (MPa)", "youngs_modulus_MPa", 1e-6, 1),
    REFERENCE: Shown("E at 100 kPa (MPa)", "modulus_at_100_kPa_MPa", 1e-6, 1),
    STRENGTH: Shown("s_u (kPa)", "undrained_strength_kPa", 1e-3, 0),
    K0: Shown("K_0", "K0", 1.0, 2),
}


def plain(value: float) -> str:
    """Return a number with three digits or more, without a power of ten."""
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.3g}"


def text_of(estimate: Estimate | None, shown: Shown, top: float) -> str:
    """Return low, best and high for the terminal; of a line over the depth d below the
    mudline (m) as "1.5 + 1.35 d". top: of the layer (m)."""
    if estimate is None:
        return ""
    lines = [estimate.line(end, top) for end in ENDS]
    if estimate.growth:
        ends = [(a * shown.scale, abs(b) * shown.scale) for a, b in lines]
        sign = "+" if estimate.growth > 0 else "-"
        return " / ".join(f"{plain(a)} {sign} {plain(b)} d" for a, b in ends)
    size = (estimate.best or estimate.high) * shown.scale
    digits = DIGITS - 1 - floor(log10(size)) if size > 0 else 0
    digits = min(max(digits, shown.digits), shown.digits + DIGITS)
    return " / ".join(f"{a * shown.scale:.{digits}f}" for a, _ in lines)


def quantities_of(every: Sequence[Estimates]) -> list[str]:
    """Return the quantities that a layer has, in their order."""
    return [name for name in SHOWN if any(name in e.values for e in every)]


def cells_of(every: Sequence[Estimates]) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows of the table: low / best / high."""
    names = quantities_of(every)
    heads = ["layer", "from to (m)", "soil", *(SHOWN[name].head for name in names)]
    rows = []
    for number, e in enumerate(every, 1):
        where = f"{e.layer.top:g} to {e.layer.bottom:.4g}"
        cells = [text_of(e.values.get(x), SHOWN[x], e.layer.top) for x in names]
        rows.append([str(number), where, e.layer.kind, *cells])
    return heads, rows


def text_of_test(test: Interpretation) -> str:
    """Return table and remarks for the terminal."""
    text = markdown(*cells_of(test.layers))
    return "\n".join(
        [f"{printable(str(test.file))}: low / best / high", text, *remarks(test)]
    )


def signs(ground: Ground, number: int, layer: Layer) -> list[str]:
    """Return where I_c, friction ratio and pore pressure of a layer do not agree with
    each other, or with the kind that is given."""
    index, friction, behavior, pressure, excess = (
        ground.median(values, layer.rows)
        for values in (
            ground.index,
            ground.friction_ratio,
            ground.behavior,
            ground.pressure_ratio,
            ground.excess,
        )
    )
    if not np.isfinite(index):
        return []
    own, by_index = ground.kind(layer.rows), kind_of(index)
    why = []
    if behavior < CLAY_LIKE:
        why.append(
            f"its F_r of {friction:.1f} % (I_B of {behavior:.0f}) is that of clay"
        )
    if pressure >= DRAINED:
        why.append(
            f"its u_2 is {excess / 1e3:.0f} kPa above water at rest (B_q of"
            f" {pressure:.2f}), as in soil that does not drain"
        )
    of_index = f"its I_c of {index:.2f}"
    if layer.is_given:
        text = " and ".join(why) or f"{of_index} is that of {own}"
        taken = f"layer {number} is taken as {layer.kind} by --soil; {text}"
        return [taken] if own != layer.kind else []
    if own != by_index:
        return [
            f"layer {number} is taken as {own}, though {of_index} is that of"
            f" {by_index}: {' and '.join(why)}; --soil {number}={SAND} overrules this"
        ]
    measured = ground.pore_pressure is not None
    if own == CLAY and measured and pressure < DRAINED / 2:
        return [
            f"layer {number} is clay by its friction, but its u_2 is not above water at"
            " rest, as in soil that drains or in stiff clay: the two do not agree;"
            f" --soil {number}=sand takes it as sand"
        ]
    return []


def on_cone_factor(factor: float, is_own: bool) -> str:
    """Return what a computed cone says of a cone factor; is_own: of OWN_CLAY."""
    computed = computed_cone_factor()
    found = f"N_kt: a cone computed in clay with this stiffness has {computed:.3g}"
    if not is_own or factor == computed:
        return f"{found} for the strength at its rate"
    return (
        f"{found} ({CONE_FACTOR:g} is usual for tests in the laboratory), and a wall at"
        f" {1e3 * WALL_VELOCITY:g} mm/s, ASSUMED, meets {computed / factor:.2f} of the"
        f" strength at that rate ({100 * PER_DECADE:.3g} % for ten times the rate)"
    )


def sources(test: Interpretation) -> list[str]:
    """Return what the numbers of the table rest on."""
    have = {name for e in test.layers for name in e.values}
    kinds = {e.layer.kind for e in test.layers}
    found = [f"{WEIGHT}: {test.weight}"]
    for c in EVERY:
        is_there = c.quantity in have if c.quantity != MODULUS else SAND in kinds
        if test.names[c.quantity] == c.name and is_there:
            factor = test.ground.cone_factor
            name = (
                f"{c.name}, N_kt = {factor:.3g}" if c.quantity == STRENGTH else c.name
            )
            found.append(f"{c.quantity}: {name}, {c.source}; {c.holds}")
            if c.quantity == STRENGTH:
                found.append(on_cone_factor(factor, c.name == OWN_CLAY))
    if kinds - {SAND}:
        low, best, high = CLAY_RATIOS
        fine = " and ".join(sorted(kinds - {SAND}))
        found.append(
            f"{MODULUS} of {fine}: {best:g} s_u, from {low:g} to {high:g}; Duncan &"
            " Buchignani (1976)"
        )
    if any(x.growth for e in test.layers for x in e.values.values()):
        found.append("d is the depth below the mudline in m")
    return found


def on_its_cone(test: Interpretation, number: int, e: Estimates) -> list[str]:
    """Return where the density of a layer of sand does not answer its cone test."""
    if e.layer.kind != SAND or test.names[DENSITY] != OWN_CONE:
        return []
    if not is_answered(test.ground, e, test.names):
        return [
            f"layer {number} has no row below {DEEP:g} m, where a cone is deep: its"
            f" relative density is that of {IN_CHAMBERS}"
        ]
    found, density = list[str](), e.values[DENSITY].best
    ratio = e.values[REFERENCE].best / float(reference_modulus(density))
    if abs(ratio - 1) > DOES_NOT_ANSWER:
        found.append(
            f"layer {number}: with a relative density of {100 * density:.0f} % alone a"
            f" cone does not meet the measured resistance; its modulus is {ratio:.2f}"
            " times that by density"
        )
    ratio = answer_of(test.ground, e)
    if abs(ratio - 1) > DOES_NOT_ANSWER:
        found.append(
            f"layer {number}: no sand of this law answers its cone; a computed cone"
            f" meets {ratio:.2f} times the measured resistance, and low and high"
            " estimate may be the same"
        )
    mean = float(np.median(mean_stress_of(test.ground, e)))
    if not is_known(density, mean):
        found.append(
            f"layer {number}: no cone was computed at a relative density of"
            f" {100 * density:.0f} % and a mean stress of {mean / 1e3:.3g} kPa: the"
            " table goes on in a straight line"
        )
    return found


def remarks_on(test: Interpretation, number: int, e: Estimates) -> list[str]:
    """Return lenses, bands and doubts of a layer, and what can be done with other soil
    than sand."""
    found, ground = list[str](), test.ground
    if e.layer.is_seam:
        found.append(
            f"layer {number} is a thin seam, which the cone feels together with the"
            " soil around it: its estimates are those of the lowest quarter of its"
            " readings"
        )
    lenses = []
    for a, b, kind in e.layer.lenses:
        inside = (ground.depth >= a) & (ground.depth <= b)
        tip = ground.median(ground.resistance, inside) / 1e6
        lenses.append(f"{kind} from {a:g} to {b:g} m with a q_c of {tip:.2g} MPa")
    if lenses:
        found.append(
            f"layer {number} has {', '.join(lenses)}: no layer of its own, and left"
            " out of its estimates and of a scene; --tops makes other layers"
        )
    bands = [f"{name} soil from {a:g} to {b:g} m" for a, b, name in e.layer.bands]
    if bands:
        found.append(
            f"layer {number} has {', '.join(bands)}: more than a factor of {BAND:g}"
            " from its usual resistance, and not in a scene; --tops makes other"
            " layers"
        )
    found += signs(ground, number, e.layer)
    found += on_its_cone(test, number, e)
    if e.layer.kind != SAND:
        found.append(f"layer {number} is {e.layer.kind}: {CAN[e.layer.kind]}")
    if STRENGTH in e.values and e.values[STRENGTH].low <= 0:
        found.append(
            f"layer {number} has a low strength of 0: its resistance does not exceed"
            " the total vertical stress; check the zero of the test"
        )
    return found


def remarks(test: Interpretation) -> list[str]:
    """Return what is assumed of the test, what the table rests on, what is to be said
    of each layer, and what was made of the file."""
    of_file = test.test.remarks
    first = [text for text in of_file if text.startswith((ASSUMED, GIVEN))]
    of_layers = [
        text
        for number, e in enumerate(test.layers, 1)
        for text in remarks_on(test, number, e)
    ]
    rest = [text for text in of_file if text not in first]
    return [*first, *sources(test), *of_layers, *rest]


def write(path: Path, every: Sequence[Estimates]) -> Path:
    """Write layers.csv: a row for each layer, empty cells where it has no value. What
    grows with depth has its values at the top of the layer, and its gradients."""
    names = quantities_of(every)
    heads = ["layer", "top_m", "bottom_m", "soil"]
    grows = [
        n for n in names if any(n in e.values and e.values[n].growth for e in every)
    ]
    for name in names:
        heads += [f"{SHOWN[name].column}_{end}" for end in ENDS]
        if name in grows:
            heads += [f"{SHOWN[name].column}_per_m_{end}" for end in ENDS]
    rows = []
    for number, e in enumerate(every, 1):
        row = [str(number), f"{e.layer.top:g}", f"{e.layer.bottom:g}", e.layer.kind]
        for name in names:
            estimate = e.values.get(name)
            for of in (1.0, estimate.growth if estimate else 0.0)[
                : 1 + (name in grows)
            ]:
                for end in ENDS:
                    value = estimate and estimate.at(end) * SHOWN[name].scale * of
                    row.append("" if value is None else f"{value:.4g}")
        rows.append(row)
    write_csv(path, heads, rows)
    return path
