# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cards of a page beside the verdict: the penetration by weight, the pump, and the
room below the lid."""
import numpy as np

from caisson.evaluation import DEPTH, sinks_on
from caisson.results import Results
from caisson.verdict.end import depth_of
from caisson.verdict.installation import NOTHING, Installation, Rate

NEARLY = 0.01  # of the largest flow
LEAST_FLOW = 0.5  # m3/h, below which a flow is in l/min


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
    shown, end = run.shown, depth_of(run) or np.inf
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
