# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether a caisson goes in, in a sentence: the first line of a report, the last one of
a run on the terminal, and that of verdict.json. The cards beside it are the penetration
by weight, the pump, and the room below the lid.

Suction is feasible down to the depth where the required one reaches the allowable one:
see verdict/outcome.py.
"""
import functools
import json
from typing import Any, NamedTuple

import numpy as np

from caisson import disk, evaluation
from caisson.band import band_of
from caisson.evaluation import DEPTH, sinks_on
from caisson.report import pull, remedies
from caisson.report.scene import end_of as planned_end
from caisson.results import Results
from caisson.verdict import installation, outcome, run_review, uncertainty
from caisson.verdict.outcome import REASONS, feasible_part, reached
from caisson.verdict.installation import NOTHING, Installation, Rate
from caisson.verdict.limits import COMPUTED, PIPING

NAME = "verdict.json"
NEAR = 0.9  # of the allowable suction: a required one that reaches it
NEARLY = 0.01  # of the largest flow
LEAST_FLOW = 0.5  # m3/h, below which a flow is in l/min


class Verdict(NamedTuple):
    """The sentence, and the depth (m) where suction ends, None where it does not."""

    text: str
    end: float | None = None
    reason: str = ""


def beside_gradient(run: Results) -> str:
    """Return where the exit gradient of the run itself becomes critical, in words."""
    found = outcome.whole_way(run)
    limit = found.limits.get(COMPUTED) if found else None
    if found is None or limit is None or not np.isfinite(limit).any():
        return ""
    if (end := reached(found, limit)) is None:
        place = found.shown.place(found.depth[-1])
        return f"; the computed exit gradient allows {place}"
    place = found.shown.place(end[0], 1)
    return f"; the computed exit gradient is critical at {place}"


def share_of_allowable(found: Installation) -> str:
    """Return the largest share of the allowable suction, and what limits it."""
    shares = found.utilization
    if not (shares > 0).any():
        return ""
    i = int(np.nanargmax(shares))
    name = found.governing(i)
    name = found.named(name) + found.remark(name, i)
    return f", at most {100 * shares[i]:.0f} % of the allowable one ({name})"


def of_suction(
    run: Results, found: Installation, ended: tuple[float, str] | None
) -> str:
    """Return the verdict on a caisson with a weight, to a depth (m), by a reason."""
    shown, depth, planned = found.shown, float(found.depth[-1]), planned_end(run)
    weight = f"weight {shown.force(float(run.scene['submerged_weight_N']) / 1e3)}"
    if ended is not None:
        place = shown.place(depth, 1)
        reason = ended[1] + (
            beside_gradient(run) if ended[1] == REASONS[PIPING] else ""
        )
        reaches = "there the required suction reaches"
        if found.required[-1] < NEAR * found.allowable[-1]:  # as at a layer
            reaches = "just below, the required suction passes"
        words = f"Feasible to {place}: {reaches} the allowable one ({reason})."
        return words + remedies.sentence_of(run, found, planned or depth)
    by = f"by {weight} alone: no suction is needed"
    if found.has_suction:
        most = int(np.argmax(found.required))
        text = shown.words(float(found.required[most]), "kPa", ".3g")
        by = f"by {weight} and suction up to {text}"
        if bar := installation.bar_at(found, found.required_bounds, most, "kPa"):
            by += f" ({bar})"
        by += share_of_allowable(found)
    place = shown.place(depth)
    if planned and planned > depth + 1e-3 * max(planned, 1e-3):
        if reason := str(run.scene.get("end_reason") or "").partition(":")[0]:
            end = f"There {reason}, short of the planned {shown.place(planned)}."
            return f"Feasible to {place} {by}. {end}"
        place += f", as far as the run is (planned {shown.place(planned)}),"
    return f"Feasible to {place} {by}."


def of_force(run: Results, found: Installation) -> str:
    """Return the verdict on a body that is pushed in."""
    shown, total = found.shown, found.forces["total_force_N"]
    parts = [f"{shown.force(float(found.forces[k][-1]))}" for k in found.forces][:3]
    names = ("tip", "friction inside", "outside")
    of_which = ", ".join(f"{name} {part}" for name, part in zip(names, parts))
    how = "Jacked" if run.entry("Rigid body/Motion") in ("", "prescribed") else "Sunk"
    force, effective = total, ""
    if len(found.with_water):
        force, effective = (
            found.with_water,
            f" with water, {shown.force(total[-1])} eff.",
        )
    text = shown.force(float(force[-1])) + effective
    bounds = found.force_bounds
    if installation.bar_at(found, bounds, -1, "kN") and bounds is not None:
        ends = [shown.force(float(side[-1])) for side in bounds[:2]]
        place = found.shown.place(bounds.end)
        held = f" as at {place}," if found.depth[-1] > bounds.end + 1e-2 else ""
        text += f" (error bar{held} {' to '.join(ends)})"
    largest, most = float(force.max()), int(np.argmax(force))
    later = ""
    if largest > 1.02 * float(force[-1]):
        later = f" The largest force is {shown.force(largest)} at"
        later += f" {shown.place(float(found.depth[most]))}."
    place = shown.place(float(found.depth[-1]))
    return f"{how} to {place}: {text}, of which {of_which}.{later}"


@functools.lru_cache(maxsize=16)
def verdict_of(run: Results) -> Verdict:
    """Return the verdict on a run; an empty one where nothing goes in or out."""
    if evaluation.is_pull(run):
        return Verdict(pull.sentence_of(run))
    found = outcome.whole_way(run)
    if found is None:
        return Verdict("")
    if not len(found.required) or not run.scene.get("submerged_weight_N"):
        return Verdict(of_force(run, found))
    ended = outcome.end_of(run)
    if ended is None:
        return Verdict(of_suction(run, found, None))
    part = feasible_part(run, found, ended[0])
    return Verdict(of_suction(run, part, ended), *ended)


def rest_in_words(run: Results, rest: float) -> str:
    """Return the penetration by weight: at most that of the start where the resistance
    only builds up below it, within half a wall thickness."""
    begin = float(run.history[DEPTH][0])
    thickness = float(run.scene.get("wall_thickness_m") or 0)
    if rest - begin < thickness / 2:
        return f"at most {run.shown.depth(begin)}, where the run begins"
    return run.shown.depth(rest)


def sinks_on_in_words(run: Results) -> str:
    """Return where the weight suffices again below the penetration by weight."""
    shown, end = run.shown, outcome.depth_of(run) or np.inf
    ways = [
        f"{shown.place(top)} to {shown.place(bottom)}"
        for top, bottom in sinks_on(run.history)
        if top < end
    ]
    if not ways:
        return ""
    where = " and from ".join(ways)
    return f"the weight suffices again from {where}: the caisson may run down there"


def cards_of(run: Results, found: Installation, rate: Rate) -> list[tuple[str, ...]]:
    """Return (name, value, remark) of what matters beside the verdict."""
    cards: list[tuple[str, ...]] = []
    if not len(found.required):
        return cards
    weight = float(run.scene.get("submerged_weight_N") or 0) / 1e3
    shown = found.shown
    if not found.has_suction:
        remark = "no suction needed to this depth"
        if found.excess is not None:
            more = shown.words(found.excess, "kN", ".0f")
            remark = f"the weight exceeds the resistance by {more}: {remark}"
        value = f"more than {shown.place(found.depth[-1])}"
        cards.append(("Self-weight penetration", value, remark))
        return cards + pump_cards(run, found, rate)
    if found.rest is not None:
        remark = f"under {shown.force(weight)} in water" if weight else ""
        if ways := sinks_on_in_words(run):
            remark += f"; {ways}"
        place = rest_in_words(run, found.rest)
        cards.append(("Self-weight penetration", place, remark))
    return cards + pump_cards(run, found, rate)


def flow_of(flow: float, form: str) -> str:
    """Return a flow (m3/h) in words, in l/min where it is that of a model."""
    if abs(flow) < LEAST_FLOW:
        return f"{flow * 1000 / 60:{form}} l/min"
    return f"{flow:{form}} m³/h"


def flow_card(found: Installation, rate: Rate) -> tuple[str, ...]:
    """Return the largest flow, under suction where there is any."""
    pumped = (
        found.required > NOTHING
        if found.has_suction
        else np.full(len(found.flow), True)
    )
    flow = np.where(pumped, found.flow, -np.inf)
    # of flows that are nearly the largest one, that against the most suction
    most = int(np.flatnonzero(flow >= flow.max() - NEARLY * abs(flow.max()))[-1])
    words = (
        f"at {found.shown.depth(found.depth[most])} and a penetration of {rate.words}"
    )
    if found.has_suction:
        words += f", against {found.shown.words(found.required[most], 'kPa', '.1f')}"
        if len(found.seepage):
            words += f", of which seepage {flow_of(found.seepage[most], '.2g')}"
    name = "Pump" if found.has_suction else "Water to vent"
    return name, flow_of(found.flow[most], ".3g"), words


def room_card(run: Results, found: Installation) -> tuple[str, ...]:
    """Return the room below the lid and, from half the skirt on, where heave would use
    it up if it went on as over the last meter."""
    depth, heave, room = found.depth, found.heave, float(found.room[-1])
    shown = found.shown
    remark = f"at {shown.depth(depth[-1])}; heave of the plug {shown.depth(heave[-1])}"
    length = float(run.scene["skirt_length_m"])
    if found.lid and room > 0 and length / 2 < depth[-1] and found.lid < length - 5e-3:
        remark += (
            f"; it would meet the lid at about {shown.depth(found.lid).split()[0]} of"
            f" {shown.length(length)}"
        )
    return "Room below the lid", shown.depth(room), remark


def pump_cards(run: Results, found: Installation, rate: Rate) -> list[tuple[str, ...]]:
    """Return the cards of the pump and of the room below the lid."""
    cards = [flow_card(found, rate)] if len(found.flow) else []
    return [*cards, room_card(run, found)] if len(found.room) else cards


def lines_of(run: Results) -> list[str]:
    """Return the verdict and the penetration by weight, for the terminal."""
    rest = outcome.results_of(run).get("rest_penetration_m")
    by_weight = ""
    if rest is not None:
        place = rest_in_words(run, rest)
        at = "" if place.startswith("at most") else "at "
        by_weight = f"Rests by weight {at}{place}."
        if ways := sinks_on_in_words(run):
            by_weight += f" {ways[0].upper()}{ways[1:]}."
    return [line for line in (verdict_of(run).text, by_weight) if line]


def soft_layer_of(found: Installation, i: int) -> dict[str, float]:
    """Return the top of the soft layer below the tip (m) if that governs at a depth."""
    governs = bool(found.remark(found.governing(i), i))
    return {"soft_layer_top_m": float(found.soft_below[i])} if governs else {}


def rows_of_limits(run: Results, end: float | None) -> list[dict[str, Any]]:
    """Return required and allowable suction (Pa) and what governs it, by depth (m)."""
    found = outcome.whole_way(run)
    if found is None or not found.limits:
        return []
    found = feasible_part(run, found, end)
    return [
        {
            DEPTH: float(h),
            evaluation.SUCTION: 1e3 * float(found.required[i]),
            "allowable_suction_Pa": 1e3 * float(found.allowable[i]),
            "governed_by": found.governing(i),
            "factor": found.factors[found.governing(i)],
        }
        | soft_layer_of(found, i)
        for i, h in enumerate(found.depth)
        if found.governing(i)
    ]


def keep(run: Results) -> str:
    """Write verdict.json of a run that has ended: the verdict, the depth where suction
    ends and the limits over depth; return the verdict."""
    found = verdict_of(run)
    if run.is_running or not found.text:
        return found.text
    known: dict[str, Any] = {"verdict": found.text}
    if found.end is not None:
        known["feasible_to_m"] = found.end
    if rows := rows_of_limits(run, found.end):
        known["limits"] = rows
    if warnings := list(run_review.review_of(run)):
        known["warnings"] = warnings
    if parts := [x.as_json() for x in uncertainty.at_end(band_of(run))]:
        known["uncertainty"] = parts
    text = json.dumps(known, indent=2, ensure_ascii=False) + "\n"
    disk.write(run.directory / NAME, text)
    return found.text
