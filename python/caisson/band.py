# SPDX-License-Identifier: LGPL-2.1-or-later
"""The band of a scene: the same caisson in soil of low, best and high resistance.

Three scenes NAME_low.prm, NAME.prm and NAME_high.prm lie beside each other, and so do
their results. The one without a suffix is the best estimate; the others may be absent.
It may also be called NAME_best, as the run of a study. Low and high count as long as
they are of the same scene: one that was changed later may leave them behind.
"""
import re
from pathlib import Path

import numpy as np

from caisson import evaluation
from caisson.evaluation import DEPTH, TOTAL
from caisson.results import Results

LOW, BEST, HIGH = "low", "best", "high"
ESTIMATES = (LOW, BEST, HIGH)
SCENE = ".prm"
# what low and high do not change
SAME = re.compile(
    "Rigid body/(Outer diameter|Skirt length|Wall |Rings|Submerged weight)"
    "|Water/(Water depth|Largest suction)|Design/"
    r"|Soil/(Number of layers|Layer \d+/Top depth)"
)
PARTS, POINTS = 4, 50  # of the common way, and of each part of it
SCATTER = 0.03  # of the mean force over such a part


def member_of(best: Path, estimate: str) -> Path:
    """Return the scene, or the directory of results, of an estimate."""
    if estimate == BEST:
        return best
    best = best if best.name.strip(".") else best.resolve()  # not "." or ".."
    name = best.name.removesuffix(SCENE)
    stem, ending = name.removesuffix(f"_{BEST}"), best.name[len(name) :]
    return best.with_name(f"{stem}_{estimate}{ending}")


def why_not(best: Results, member: Results, estimate: str) -> str:
    """Return why a run is not the low or the high estimate of the scene of a best one,
    after "it", and "" where it is: its caisson and its layers are the same, and its
    force is on its side over each part of their common way, within the scatter."""
    common = best.entries.keys() & member.entries.keys()
    for name in sorted(filter(SAME.match, common)):
        if best.entries[name] != member.entries[name]:
            return f"has another {name} than the best estimate"
    if not all({DEPTH, TOTAL} <= run.history.keys() for run in (best, member)):
        return ""
    ways = [evaluation.way_down(run) for run in (best, member)]
    if min(len(way.depth) for way in ways) < 2:
        return ""
    begin, end = max(w.depth[0] for w in ways), min(w.depth[-1] for w in ways)
    at = np.linspace(begin, end, PARTS * POINTS).reshape(PARTS, POINTS)
    forces = [np.interp(at, w.depth, w.columns[TOTAL]).mean(axis=1) for w in ways]
    less, more = forces[::-1] if estimate == LOW else forces
    wrong = at[less - more > SCATTER * np.abs(forces[0])]
    if end <= begin or not len(wrong):
        return ""
    than, place = "more" if estimate == LOW else "less", best.shown.place
    ends = f"from {place(wrong.min(), 2)} to {place(wrong.max(), 2)}"
    return f"has {than} resistance than the best estimate {ends}"


def band_of(run: Results) -> dict[str, Results]:
    """Return the runs of the band around a best estimate that exist, by estimate, that
    run included. Those of another scene are none of them, see left_out()."""
    if run.estimates:
        return run.estimates
    found = {BEST: run}
    for estimate in (LOW, HIGH):
        directory = member_of(run.directory, estimate)
        if (directory / "history.csv").is_file():
            member = Results(directory)
            if why := why_not(run, member, estimate):
                run.left_out[estimate] = f"{directory.resolve().name} {why}"
            else:
                found[estimate] = member
    run.estimates = {x: found[x] for x in ESTIMATES if x in found}
    return run.estimates


def left_out(run: Results) -> dict[str, str]:
    """Return which runs beside a best estimate are none of its band, and why."""
    band_of(run)
    return run.left_out
