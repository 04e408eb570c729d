# SPDX-License-Identifier: LGPL-2.1-or-later
"""What low and high resistance of the soil change on the page of the best estimate: the
verdict, the penetration by weight, and the required suction at the quarters; and how
far the result may be wrong in all."""
from typing import Any

import numpy as np

from caisson.band import BEST, HIGH, LOW, band_of
from caisson.design.reasons import text_of
from caisson.verdict import installation
from caisson.verdict.installation import NOTHING, Installation, Rate
from caisson.report.verdict import Verdict, verdict_of
from caisson.report.verdict import cards_of as own_cards_of
from caisson.evaluation import SUCTION
from caisson.results import Results
from caisson.shown import Units
from caisson.verdict.uncertainty import (
    GROUND,
    MESH,
    NAMES,
    PROGRAM,
    Part,
    Uncertainty,
    at_end,
)

REST = "Self-weight penetration"  # the card
IN_WORDS = {MESH: "mesh and steps", GROUND: "the ground", PROGRAM: "the model"}


def ends_of(run: Results) -> dict[str, Results]:
    """Return the runs of low and high resistance beside a run, as far as there are."""
    return {e: member for e, member in band_of(run).items() if e != BEST}


def outcome_of(member: Results, shown: Units, best: Verdict) -> str:
    """Return what has become of a run, in words that follow "with low resistance"; a
    reason only where it is not that of the best estimate."""
    found = installation.installation_of(member, Rate())
    if found is None or member.is_running:
        return "not known: its run has not ended"
    said = verdict_of(member)
    if said.end is not None:
        reason = f" ({said.reason})" if said.reason != best.reason else ""
        return f"to {shown.place(said.end, 1)}{reason}"
    place = shown.place(float(found.depth[-1]))
    if member.summary.get("status", "finished") != "finished":
        return f"not known: its run was stopped at {place}"
    if not member.scene.get("submerged_weight_N"):
        total = found.forces["total_force_N"]
        total = found.with_water if len(found.with_water) else total
        return f"{shown.force(float(total[-1]))} at {place}"
    if not found.has_suction:
        return f"to {place} by weight alone"
    most = shown.words(float(found.required.max()), "kPa", ".3g")
    return f"to {place}, suction up to {most}"


def sentence_of(run: Results) -> str:
    """Return what low and high resistance come to; nothing without a band."""
    if not (best := verdict_of(run)).text:
        return ""
    words = [
        f"with {estimate} resistance {outcome_of(member, run.shown, best)}"
        for estimate, member in ends_of(run).items()
    ]
    text = "; ".join(words)
    return f"{text[0].upper()}{text[1:]}." if text else ""


def verdict_with(run: Results) -> Verdict:
    """Return the verdict on a run with that on low and high resistance."""
    best, ends = verdict_of(run), sentence_of(run)
    if not ends:
        return best
    return best._replace(text=f"{best.text} {ends}")


def cards_of(run: Results, cards: list[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """Return the cards of a run, where the penetration by weight has its range in place
    of the weight, which the verdict names."""
    ends = []
    for estimate, member in ends_of(run).items():
        found = installation.installation_of(member, Rate())
        own = [] if found is None else own_cards_of(member, found, Rate())
        ends += [f"{estimate} resistance: {c[1]}" for c in own if c[0] == REST]
    if not ends:
        return cards
    return [(*c[:2], "; ".join(ends)) if c[0] == REST else c for c in cards]


def part_in_words(part: Part, found: Uncertainty, shown: Units) -> str:
    """Return by how much a part changes the value at the last depth: a force in %."""
    below, above = part.below[-1], part.above[-1]
    if found.column == SUCTION:
        factor, unit = shown.factor("kPa") / 1e3, shown.name("kPa")
    else:
        factor, unit = 100 / found.values[-1], "%"
    low, high = (text_of(float(f"{factor * x:.2g}")) for x in (below, above))
    change = f"±{high} {unit}" if low == high else f"−{low} and +{high} {unit}"
    source = part.source
    if found.column == SUCTION and part.share is not None:
        source = f"{100 * part.share:.0f} % of the force; {source}"
    return f"{IN_WORDS[part.name]} {change} ({source})"


def uncertainty_in_words(found: Uncertainty, shown: Units) -> str:
    """Return in two sentences how far the value at the last depth may be wrong; nothing
    of a value of 0."""
    name, unit = NAMES[found.column]
    value, low, high = (x[-1] / 1e3 for x in (found.values, found.low, found.high))
    if value <= NOTHING:
        return ""

    def text(x: float) -> str:
        return shown.force(x) if unit == "N" else shown.words(x, "kPa", ".3g")

    ends = [text(low), text(high)]
    if len({end.rpartition(" ")[2] for end in ends}) == 1:
        ends[0] = ends[0].rpartition(" ")[0]
    parts = ", ".join(part_in_words(part, found, shown) for part in found.parts)
    missing = " and ".join(IN_WORDS[name] for name in found.missing)
    without = f" Not in it: {missing}." if missing else ""
    return (
        f"At {shown.place(found.depth[-1])} the {name} is {text(value)}, and"
        f" {' to '.join(ends)} with its uncertainty: {parts}; the root of the sum of"
        f" squares.{without}"
    )


def uncertainty_of(run: Results) -> str:
    """Return how far the required suction of a run, or its force where there is none,
    may be wrong where the ways of all estimates end."""
    found = [uncertainty_in_words(x, run.shown) for x in at_end(band_of(run))]
    return next(filter(None, reversed(found)), "")


def required_at(member: Results, depth: float, shown: Units) -> str:
    """Return the required suction of a run at a depth (m), in words."""
    found, end = installation.installation_of(member, Rate()), verdict_of(member).end
    if found is None or depth > (end or float(found.depth[-1]) + 1e-3 * depth):
        return "not reached" if end is None else "not feasible"
    if depth <= member.history["penetration_m"][0]:
        return "before the start"
    known = installation.installation_of(member, Rate(), np.array([depth]))
    if known is None or not len(known.required):
        return ""
    needs = float(known.required[0])
    return "0" if needs <= NOTHING else text_of(shown.factor("kPa") * needs)


def quarters_of(
    run: Results, found: Installation, end: float | None, planned: float
) -> dict[str, Any]:
    """Return the table of the suction at quarters of the planned penetration (m), with
    rows for low and high resistance. end: where suction ends (m), or None."""
    table, ends = installation.quarters_of(run, found, end, planned), ends_of(run)
    if not table or not ends:
        return table
    (name, *needs), *rows = table["rows"]
    required = {BEST: needs} | {
        estimate: [required_at(member, x, run.shown) for x in table["depths"]]
        for estimate, member in ends.items()
    }
    sides = [e for e in (LOW, BEST, HIGH) if e in required]
    names = " and ".join(member.directory.resolve().name for member in ends.values())
    of_all = [[f"{name}, {estimate}", *required[estimate]] for estimate in sides]
    return table | {"rows": of_all + rows, "ends": names}
