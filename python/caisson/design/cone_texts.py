# SPDX-License-Identifier: LGPL-2.1-or-later
"""The estimates as a table on the terminal and as layers.csv."""
from collections.abc import Sequence
from functools import partial
from math import floor, log10
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from caisson import template
from caisson.table import markdown, text_of as number_text, write_csv
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
from caisson.design.ground import CLAY_LIKE, CONE_FACTOR, DRAINED, SAND, Ground, kind_of
from caisson.design.interpretation import Interpretation
from caisson.design.own_cone import DEEP, is_known
from caisson.design.density import reference_modulus

SENTENCES = Path(__file__).with_suffix(".jinja")
DIGITS = 2  # of a small value, at least
DOES_NOT_ANSWER = 0.1  # of the resistance of its own cone


say = partial(template.say, SENTENCES)


def say_rows(name: str, *data: Any) -> list[str]:
    """Return the remarks that a macro makes of data."""
    return [text for _, text in template.say_rows(SENTENCES, name, *data)]


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


def text_of(estimate: Estimate | None, shown: Shown, top: float) -> str:
    """Return low, best and high for the terminal; of a line over the depth d below the
    mudline (m) as "1.5 + 1.35 d". top: of the layer (m)."""
    if estimate is None:
        return ""
    lines = [estimate.line(end, top) for end in ENDS]
    if estimate.growth:
        ends = [(a * shown.scale, abs(b) * shown.scale) for a, b in lines]
        sign = "+" if estimate.growth > 0 else "-"
        return " / ".join(
            f"{number_text(a)} {sign} {number_text(b)} d" for a, b in ends
        )
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


def signs(ground: Ground, number: int, layer: Layer) -> str:
    """Return where I_c, friction ratio and pore pressure of a layer do not agree with
    each other, or with the kind that is given."""
    columns = {
        "index": ground.index,
        "friction": ground.friction_ratio,
        "behavior": ground.behavior,
        "pressure": ground.pressure_ratio,
        "excess": ground.excess,
    }
    of = {name: ground.median(x, layer.rows) for name, x in columns.items()}
    if not np.isfinite(of["index"]):
        return ""
    kinds = ground.kind(layer.rows), kind_of(of["index"])
    limits = CLAY_LIKE, DRAINED, ground.pore_pressure is not None
    return say("signs", number, layer, *kinds, of, *limits)


def sources(test: Interpretation) -> list[str]:
    """Return what the numbers of the table rest on."""
    have = {name for e in test.layers for name in e.values}
    kinds = {e.layer.kind for e in test.layers}
    # the modulus of clay and silt is a ratio to s_u
    have = have - {MODULUS} | ({MODULUS} if SAND in kinds else set())
    used = [c for c in EVERY if c.quantity in have]
    taken = [c for c in used if test.names[c.quantity] == c.name]
    factors = test.ground.cone_factor, computed_cone_factor(), CONE_FACTOR
    is_own = test.names[STRENGTH] == OWN_CLAY
    rate, fine = (1e3 * WALL_VELOCITY, 100 * PER_DECADE), sorted(kinds - {SAND})
    grows = any(x.growth for e in test.layers for x in e.values.values())
    how = STRENGTH, *factors, is_own, rate, fine, CLAY_RATIOS, grows
    return say_rows("sources", test.weight, taken, *how)


def on_its_cone(test: Interpretation, number: int, e: Estimates) -> list[str]:
    """Return where the density of a layer of sand does not answer its cone test."""
    if e.layer.kind != SAND or test.names[DENSITY] != OWN_CONE:
        return []
    deep, density, stiffer, meets, mean = DEEP, e.values[DENSITY].best, 1.0, 1.0, 0.0
    if is_answered(test.ground, e, test.names):
        deep, meets = 0.0, answer_of(test.ground, e)
        stiffer = e.values[REFERENCE].best / float(reference_modulus(density))
        mean = float(np.median(mean_stress_of(test.ground, e)))
        mean = 0.0 if is_known(density, mean) else mean
    ratios = density, stiffer, meets, DOES_NOT_ANSWER, mean
    return say_rows("on_its_cone", number, deep, IN_CHAMBERS, *ratios)


def remarks_on(test: Interpretation, number: int, e: Estimates) -> list[str]:
    """Return lenses, bands and doubts of a layer, and what can be done with other soil
    than sand."""
    ground, layer, lenses = test.ground, e.layer, []
    for a, b, kind in layer.lenses:
        inside = (ground.depth >= a) & (ground.depth <= b)
        lenses.append((kind, a, b, ground.median(ground.resistance, inside) / 1e6))
    doubts = signs(ground, number, layer), on_its_cone(test, number, e)
    can = CAN[layer.kind] if layer.kind != SAND else ""
    is_weak = STRENGTH in e.values and e.values[STRENGTH].low <= 0
    return say_rows("layer", number, layer, lenses, BAND, *doubts, can, is_weak)


def remarks(test: Interpretation) -> list[str]:
    """Return what is assumed of the test, what the table rests on, what is to be said
    of each layer, and what was made of the file."""
    of_file = test.ground.remarks
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
    grows = {n for e in every for n, estimate in e.values.items() if estimate.growth}
    columns = [
        (name, per_m, end)
        for name in names
        for per_m in ("", "_per_m")[: 1 + (name in grows)]
        for end in ENDS
    ]
    heads = ["layer", "top_m", "bottom_m", "soil"]
    heads += [f"{SHOWN[name].column}{per_m}_{end}" for name, per_m, end in columns]
    rows = []
    for number, e in enumerate(every, 1):
        row = [str(number), f"{e.layer.top:g}", f"{e.layer.bottom:g}", e.layer.kind]
        for name, per_m, end in columns:
            estimate = e.values.get(name)
            of = estimate.growth if estimate and per_m else 1.0
            value = estimate and estimate.at(end) * SHOWN[name].scale * of
            row.append("" if value is None else f"{value:.4g}")
        rows.append(row)
    write_csv(path, heads, rows)
    return path
