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

from caisson import disk, evaluation, template
from caisson.band import band_of
from caisson.evaluation import DEPTH, sinks_on
from caisson.report import pull, remedies
from caisson.results import Results
from caisson.verdict import outcome, retrieval, run_review, theory, uncertainty
from caisson.verdict.outcome import REASONS, feasible_part, reached
from caisson.verdict.installation import NOTHING, Installation, Rate, bar_at
from caisson.verdict.limits import COMPUTED, LID, PIPING, REVERSE_BEARING, SHELL

NAME = "verdict.json"
NEAR = 0.9  # of the allowable suction: a required one that reaches it
NEARLY = 0.01  # of the largest flow
REST = "Self-weight penetration"  # a card


class Verdict(NamedTuple):
    """The sentence, and the depth (m) where suction ends, None where it does not."""

    text: str
    end: float | None = None
    reason: str = ""


say = functools.partial(template.say, pull.SENTENCES)


def by_gradient(run: Results) -> tuple[float, bool] | None:
    """Return the depth (m) where the exit gradient of the run itself becomes critical,
    and True, or that to which it does not in sand, and False; None where it is not
    known."""
    if (ended := outcome.end_by_program(run)) and ended[1] == outcome.PIPING_IN_RUN:
        return ended[0], True
    found = outcome.whole_way(run)
    limit = found.limits.get(COMPUTED) if found else None
    if found is None or limit is None or not np.isfinite(limit).any():
        return None
    if end := reached(found, limit):
        return end[0], True
    deepest = min(float(found.depth[-1]), ended[0] if ended else np.inf)
    return theory.above_clay(theory.site_of(run), deepest) or deepest, False


def of_suction(
    run: Results, found: Installation, ended: tuple[float, str] | None
) -> str:
    """Return the verdict on a caisson with a weight, to a depth (m), by a reason."""
    planned = run.planned
    if ended is not None:
        gradient = by_gradient(run) if ended[1] == REASONS[PIPING] else None
        more = remedies.sentence_of(run, found, planned or float(found.depth[-1]))
        holds = "" if found.required[-1] else ended[1]
        without = holds.startswith(SHELL), holds.startswith(LID)
        text = say("ends", found, ended[1], NEAR, gradient, *without)
        return f"{text} {more}".strip()
    shares = found.utilization
    nearest = int(np.nanargmax(shares)) if (shares > 0).any() else None
    most = int(np.argmax(found.required))
    bar = bar_at(found, found.required_bounds, most, "kPa")
    return say("goes_in", run, found, planned, most, bar, nearest)


@functools.lru_cache(maxsize=16)
def verdict_of(run: Results) -> Verdict:
    """Return the verdict on a run, or on a scene by hand methods, in so many words; an
    empty one where nothing goes in or out."""
    found = said_of(run)
    if run.by_hand:
        return found._replace(text=say("by_hand", found.text))
    if found.text and (ended := outcome.end_before(run)):
        words = say("after_end", run.shown, *ended)
        return found._replace(text=f"{words} {found.text}")
    return found


def said_of(run: Results) -> Verdict:
    """Return the verdict without a word of where its numbers come from."""
    if evaluation.is_pull(run):
        return Verdict(pull.sentence_of(run))
    found = outcome.whole_way(run)
    if found is None:
        return Verdict("")
    if not len(found.required) or not run.weight:
        is_jacked = run.entry("Rigid body/Motion") in ("", "prescribed")
        how = "Jacked" if is_jacked else "Sunk"
        length = float(run.scene.get("skirt_length_m") or np.inf)
        lid = evaluation.lid_contact(run.history)
        return Verdict(say("pushed", found, how, length, lid))
    ended = outcome.end_of(run)
    if ended is None:
        return Verdict(of_suction(run, found, None))
    part = feasible_part(run, found, ended[0])
    return Verdict(of_suction(run, part, ended), *ended)


def begins_at_rest(run: Results, rest: float) -> bool:
    """Return whether the resistance only builds up above a penetration by weight (m):
    that is within half a wall thickness of the start."""
    thickness = float(run.scene.get("wall_thickness_m") or 0)
    return not run.by_hand and rest - float(run.history[DEPTH][0]) < thickness / 2


def rest_in_words(run: Results, rest: float) -> str:
    """Return the penetration by weight: at most that of the start where the resistance
    only builds up below it."""
    is_start = begins_at_rest(run, rest)
    return say("rest", run.shown, run.history[DEPTH][0] if is_start else rest, is_start)


def ways_down(run: Results) -> list[tuple[float, float]]:
    """Return where the weight suffices again (m) above the end of suction."""
    end = outcome.feasible_to(run)
    return [way for way in sinks_on(run.history) if way[0] < end]


def largest_flow(found: Installation) -> int:
    """Return the row of the largest flow, under suction where there is any; of flows
    that are nearly the largest one, that against the most suction."""
    pumped = (found.required > NOTHING) | (not found.has_suction)
    flow = np.where(pumped, found.flow, -np.inf)
    return int(np.flatnonzero(flow >= flow.max() - NEARLY * abs(flow.max()))[-1])


def cards_of(run: Results, found: Installation, rate: Rate) -> list[list[str]]:
    """Return (name, value, remark) of what matters beside the verdict."""
    if not len(found.required):
        return []
    rest = "" if found.rest is None else rest_in_words(run, found.rest)
    row = largest_flow(found) if len(found.flow) else None
    length = float(run.scene.get("skirt_length_m") or 0)
    what = run.weight / 1e3, rest, ways_down(run), row, rate.words, length, run
    return template.say_rows(pull.SENTENCES, "cards", found, *what, cells=3)


def lines_of(run: Results) -> list[str]:
    """Return the verdict and the penetration by weight, for the terminal."""
    rest = outcome.results_of(run).get("rest_penetration_m")
    by_weight = ""
    if rest is not None:
        words = rest_in_words(run, rest), begins_at_rest(run, rest)
        by_weight = say("rests", run.shown, *words, ways_down(run))
    return [line for line in (verdict_of(run).text, by_weight) if line]


def rows_of_limits(run: Results, end: float | None) -> list[dict[str, Any]]:
    """Return required and allowable suction (Pa) and what governs it, by depth (m)."""
    found = outcome.whole_way(run)
    if found is None or not found.limits:
        return []
    found = feasible_part(run, found, end)
    rows = list[dict[str, Any]]()
    for i, h in enumerate(found.depth):
        if not (name := found.governing(i)):
            continue
        rows.append(
            {
                DEPTH: float(h),
                evaluation.SUCTION: 1e3 * float(found.required[i]),
                "allowable_suction_Pa": 1e3 * float(found.allowable[i]),
                "governed_by": name,
                "factor": found.factors[name],
            }
        )
        if name == REVERSE_BEARING and found.remark(name, i):
            rows[-1]["soft_layer_top_m"] = float(found.soft_below[i])
    return rows


def keep(run: Results) -> str:
    """Write verdict.json of a run that has ended: the verdict, the depth where suction
    ends and the limits over depth; return the verdict."""
    found = verdict_of(run)
    if run.is_running or not found.text:
        if not run.is_running:  # what an earlier history had is no answer
            (run.directory / NAME).unlink(missing_ok=True)
        return found.text
    known: dict[str, Any] = {"verdict": found.text}
    if found.end is not None:
        known["feasible_to_m"] = found.end
    if (upper := uncertainty.end_of_upper(run, band_of(run))) is not None:
        known["feasible_to_by_upper_value_m"] = upper
    is_way_down = not evaluation.is_pull(run)
    if is_way_down and (rows := rows_of_limits(run, found.end)):
        known["limits"] = rows
    if retrieved := retrieval.retrieval_of(run):
        known["retrieval"] = retrieved.rows()
    if warnings := run_review.down_to(found.end, run_review.review_of(run)):
        known["warnings"] = warnings
    parts = [x.as_json() for x in uncertainty.at_end(band_of(run))]
    if is_way_down and parts:
        known["uncertainty"] = parts
    text = json.dumps(known, indent=2, ensure_ascii=False) + "\n"
    disk.write(run.directory / NAME, text)
    return found.text
