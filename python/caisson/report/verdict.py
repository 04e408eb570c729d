# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether a caisson goes in, in a sentence: the first line of a report, the last one of
a run on the terminal, and "verdict" in run.json.

Suction is feasible down to the depth where the required one reaches the allowable one.
What a run has behind that depth belongs to a plug that is lifted, or to a pump that
nobody has: it stands in no card and no maximum.
"""
import functools
import json
from typing import Any, NamedTuple

import numpy as np

from caisson import curves, disk, evaluation
from caisson.report import installation, pull, remedies
from caisson.plot import limits
from caisson.plot.limits import BOILING, COMPUTED, PIPING
from caisson.report.installation import NOTHING, Installation, Rate
from caisson.report.scene import end_of
from caisson.results import Results

KEY, END, LIMITS = "verdict", "feasible_to_m", "limits"  # in run.json
REASONS = {
    COMPUTED: "piping",
    PIPING: "piping by Houlsby & Byrne",
    BOILING: "boiling below the lid",
}
IN_PROGRAM = {"boiling": REASONS[BOILING]}  # reasons of run.json by other names
NEAR = 0.9  # of the allowable suction: a required one that reaches it
FINER = 21  # rows between two of the tables


class Verdict(NamedTuple):
    """The sentence, and the depth (m) where suction ends, None where it does not."""

    text: str
    end: float | None = None
    reason: str = ""


def reached(found: Installation, limit: np.ndarray) -> tuple[float, int] | None:
    """Return the depth (m) where the required suction reaches a limit [n] (kPa), and
    the row at or below it; None where it does not."""
    beyond = (found.required >= limit) & (found.required > NOTHING)
    if not beyond.any():
        return None
    i = int(np.argmax(beyond))
    if i and np.isfinite(limit[i - 1]) and limit[i] > 0:  # 0 is the lid
        excess = (found.required - limit)[i - 1 : i + 1]
        return float(np.interp(0, excess, found.depth[i - 1 : i + 1])), i
    return float(found.depth[i]), i


def end_by_program(run: Results) -> tuple[float, str] | None:
    """Return the depth (m) where the program itself found that suction ends, and why;
    None where it did not."""
    if not (ended := run.scene.get("infeasible")):
        return None
    reason = str(ended["reason"])
    return limits.rounded_down(ended["penetration_m"]), IN_PROGRAM.get(reason, reason)


def end_of_suction(run: Results, found: Installation) -> tuple[float, str] | None:
    """Return the depth (m) where the required suction reaches the allowable one, and
    why; None where it does not."""
    if not found.has_suction:
        return None
    if (end := reached(found, found.allowable)) is None:
        return end_by_program(run)
    if i := end[1]:  # rows are far apart where a tip comes into another layer
        between = np.linspace(found.depth[i - 1], found.depth[i], FINER)
        finer = installation.installation_of(run, Rate(), between)
        if finer and (sharper := reached(finer, finer.allowable)):
            found, end = finer, sharper
    name = found.governing(end[1])
    words = found.named(name).replace(name, REASONS.get(name, name))
    depth = max(limits.rounded_down(end[0]), float(found.depth[0]))
    return depth, words + found.remark(name, end[1])


def beside_gradient(run: Results) -> str:
    """Return where the exit gradient of the run itself becomes critical, in words."""
    found = installation.installation_of(run, Rate())
    limit = found.limits.get(COMPUTED) if found else None
    if found is None or limit is None or not np.isfinite(limit).any():
        return ""
    if (end := reached(found, limit)) is None:
        place = found.shown.place(found.depth[-1])
        return f"; the computed exit gradient allows {place}"
    place = found.shown.place(end[0], 1)
    return f"; the computed exit gradient is critical at {place}"


def feasible_part(
    run: Results, found: Installation, end: float | None, rate: Rate = Rate()
) -> Installation:
    """Return the installation down to a depth (m), with a row there; else all of it."""
    if end is None:
        return found
    at = curves.down_to(end, found.depth)
    return installation.installation_of(run, rate, at) or found


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
    shown, depth, planned = found.shown, float(found.depth[-1]), end_of(run)
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
        ends = [shown.force(float(side[-1])) for side in (bounds.low, bounds.high)]
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
    if pull.is_pull(run):
        return Verdict(pull.sentence_of(run))
    found = installation.installation_of(run, Rate())
    if found is None:
        return Verdict("")
    if not len(found.required) or not run.scene.get("submerged_weight_N"):
        return Verdict(of_force(run, found))
    ended = end_of_suction(run, found)
    if ended is None:
        return Verdict(of_suction(run, found, None))
    part = feasible_part(run, found, ended[0])
    return Verdict(of_suction(run, part, ended), *ended)


def lines_of(run: Results) -> list[str]:
    """Return the verdict and the penetration by weight, for the terminal."""
    rest = evaluation.results_of(run).get("rest_penetration_m")
    by_weight = ""
    if rest is not None:
        place = installation.rest_in_words(run, rest)
        at = "" if place.startswith("at most") else "at "
        by_weight = f"Rests by weight {at}{place}."
        if ways := installation.sinks_on_in_words(run):
            by_weight += f" {ways[0].upper()}{ways[1:]}."
    return [line for line in (verdict_of(run).text, by_weight) if line]


def soft_layer_of(found: Installation, i: int) -> dict[str, float]:
    """Return the top of the soft layer below the tip (m) if that governs at a depth."""
    governs = bool(found.remark(found.governing(i), i))
    return {"soft_layer_top_m": float(found.soft_below[i])} if governs else {}


def rows_of_limits(run: Results, end: float | None) -> list[dict[str, Any]]:
    """Return required and allowable suction (Pa) and what governs it, by depth (m)."""
    found = installation.installation_of(run, Rate())
    if found is None or not found.limits:
        return []
    found = feasible_part(run, found, end)
    return [
        {
            evaluation.DEPTH: float(h),
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
    """Write the verdict of a run that has ended into its run.json, with the depth where
    suction ends and the limits over depth; return it."""
    found, path = verdict_of(run), run.directory / "run.json"
    if run.is_running or not found.text:
        return found.text
    known: dict[str, Any] = json.loads(disk.read_text(path))
    more: dict[str, Any] = {KEY: found.text} | (
        {END: found.end} if found.end is not None else {}
    )
    if rows := rows_of_limits(run, found.end):
        more[LIMITS] = rows
    new = {k: v for k, v in known.items() if k not in (KEY, END, LIMITS)} | more
    if new != known:
        disk.update(path, json.dumps(new, indent=2, ensure_ascii=False) + "\n")
    return found.text
