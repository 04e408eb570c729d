# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where suction ends: the depth at which the required suction reaches the allowable.

What a run has behind that depth belongs to a plug that is lifted, or to a pump that
nobody has: it stands in no card, no maximum and no margin.
"""
import functools

import numpy as np

from caisson import curves
from caisson.evaluation import is_pull
from caisson.results import Results
from caisson.verdict import installation, limits
from caisson.verdict.installation import NOTHING, Installation, Rate
from caisson.verdict.limits import BOILING, COMPUTED, PIPING

REASONS = {
    COMPUTED: "piping",
    PIPING: "piping by Houlsby & Byrne",
    BOILING: "boiling below the lid",
}
IN_PROGRAM = {"boiling": REASONS[BOILING]}  # reasons of run.json by other names
FINER = 21  # rows between two of the tables


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


@functools.lru_cache(maxsize=16)
def end_of(run: Results) -> tuple[float, str] | None:
    """Return the depth (m) where suction ends in a run, and why; None where it does
    not, and of a body without a weight or on its way out."""
    if is_pull(run) or not run.scene.get("submerged_weight_N"):
        return None
    found = installation.installation_of(run, Rate())
    if found is None or not len(found.required):
        return None
    return end_of_suction(run, found)


def depth_of(run: Results) -> float | None:
    """Return the depth (m) where suction ends in a run, None where it does not."""
    found = end_of(run)
    return found[0] if found else None


def feasible_part(
    run: Results, found: Installation, end: float | None, rate: Rate = Rate()
) -> Installation:
    """Return the installation down to a depth (m), with a row there; else all of it."""
    if end is None:
        return found
    at = curves.down_to(end, found.depth)
    return installation.installation_of(run, rate, at) or found
