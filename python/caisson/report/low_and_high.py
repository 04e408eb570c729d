# SPDX-License-Identifier: LGPL-2.1-or-later
"""What low and high resistance of the soil change on the page of the best estimate: the
verdict, the penetration by weight, and the required suction at the quarters; and how
far the result may be wrong in all."""
from typing import Any

import numpy as np

from caisson.band import BEST, HIGH, LOW, band_of, left_out
from caisson.curves import EDGE
from caisson.evaluation import DEPTH, SUCTION
from caisson.table import text_of
from caisson.verdict import installation, outcome
from caisson.verdict.by_hand import ByHand
from caisson.verdict.installation import NOTHING, Installation, Rate
from caisson.verdict.run_review import unsteady_flow
from caisson.report.verdict import REST, say, verdict_of
from caisson.report.verdict import cards_of as own_cards_of
from caisson.results import Results, ResultsError
from caisson.shown import Units
from caisson.verdict.uncertainty import NAMES, at_end, end_of_upper

# of the soil: what the result depends on most, where it is assumed
DOUBTFUL = ("Adhesion factor of the walls", "Permeability", "Relative density")
APART = 0.1  # of the planned penetration: two ends of suction that differ


def ends_of(run: Results) -> dict[str, Results]:
    """Return the runs of low and high resistance beside a run, as far as there are."""
    return {e: member for e, member in band_of(run).items() if e != BEST}


def n_soils(run: Results) -> int:
    """Return in how many soils hand methods have looked at a scene; 0 of a run."""
    return len({x.directory for x in run.estimates.values()}) if run.by_hand else 0


def by_hand_in_words(run: Results) -> str:
    """Return how far a caisson is feasible by hand methods, and what to plan for, where
    the run that has ended says another depth."""
    own, planned, found = verdict_of(run).end, run.planned, outcome.whole_way(run)
    if run.by_hand or run.is_running or not planned or not found or not found.limits:
        return ""
    depth = run.history[DEPTH]
    if own is None and depth.max() < (1 - 1e-3) * planned:
        return ""  # it has not gone that far
    try:
        hand = outcome.depth_of(ByHand(run.directory))
    except ResultsError:
        return ""
    at = hand or planned
    if abs(at - (own or planned)) < APART * planned or at < depth[0]:
        return ""
    needs = np.nanmax(run.history[SUCTION][depth <= at + EDGE]) / 1e3
    needs *= at > (own or planned)
    return say("beside_by_hand", run.shown, at, needs, min(at, depth.max()))


def unsteady_in_words(run: Results) -> str:
    """Return that flow is not steady; nothing where it is."""
    found = outcome.whole_way(run)
    if not (unsteady := unsteady_flow(run)) or not found or not found.has_suction:
        return ""
    return say("not_steady", *unsteady, bool(run.by_hand))


def sentence_of(run: Results) -> str:
    """Return, as far as they are known, where suction ends with the upper value of its
    uncertainty or without steady flow, how far hand methods go, and what low and high
    resistance come to, or why they are left out."""
    if not (best := verdict_of(run)).text:
        return ""
    ends = dict[str, str]()
    for estimate, x in ends_of(run).items():
        found = None if x.is_running else outcome.whole_way(x)
        how = x, found, verdict_of(x), best.reason
        ends[estimate] = say("outcome", run.shown, *how)
    clay = any(x.get("total_stress") for x in run.scene.get("layers", []))
    others = left_out(run)
    band = say("of_band", ends, n_soils(run) == 1 and not others, clay)
    end = end_of_upper(run, band_of(run))
    upper = "" if end is None else say("end_of_upper", run.shown, end)
    gone = say("left_out", others, run.known.get("scene_file") or "FILE.prm")
    parts = upper, unsteady_in_words(run), by_hand_in_words(run), band, gone
    return " ".join(filter(None, parts))


def cards_of(run: Results, cards: list[list[str]]) -> list[list[str]]:
    """Return the cards of a run, where the penetration by weight has its range in place
    of the weight, which the verdict names."""
    ends = []
    for estimate, member in ends_of(run).items():
        found = outcome.whole_way(member)
        own = [] if found is None else own_cards_of(member, found, Rate())
        ends += [f"{estimate} resistance: {c[1]}" for c in own if c[0] == REST]
    if not ends:
        return cards
    return [[*c[:2], "; ".join(ends)] if c[0] == REST else c for c in cards]


def uncertainty_of(run: Results) -> str:
    """Return how far the required suction of a run, or its force where there is none,
    may be wrong where the ways of all estimates end; nothing of a value of 0."""
    for found in reversed(at_end(band_of(run))):
        if found.values[-1] / 1e3 > NOTHING:
            name, unit = NAMES[found.column]
            assumed = list(filter(run.assumes, DOUBTFUL))
            return say("uncertainty", found, run.shown, name, unit == "N", assumed)
    return ""


def required_at(member: Results, depth: float, shown: Units) -> str:
    """Return the required suction of a run at a depth (m), in words."""
    found, end = outcome.whole_way(member), verdict_of(member).end
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
    if run.by_hand:
        names = say("what_ends_are", n_soils(run))
    of_all = [[f"{name}, {estimate}", *required[estimate]] for estimate in sides]
    return table | {"rows": of_all + rows, "ends": names}
