# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "drainage": a resistance between its drained and undrained limits.

A study has a run called drained, one called undrained, and others with
Water/Level = coupled that differ in their permeability. The resistance is the mean
force of soil and water on the body over a range of depths, less that at rest.
Prints it over the drained one, and draws it over v D / c_v beside the backbone curve
of DeJong & Randolph (2012, doi:10.1061/(ASCE)GT.1943-5606.0000631). Keys of a study
beside the usual ones:

    width      the length D of v D / c_v (m)
    velocity   v of the body (m/s)
    depths     the first and the last penetration of the mean (m)
    at_rest    the force of the initial stress (N), 0 if left out
"""
import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.results import ResultsError
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError
from lab import outcome

NAME = "drainage"
STUDY_KEYS = set("width velocity depths at_rest".split())
DRAINED, UNDRAINED = "drained", "undrained"
V50, POWER = 3.0, 1.0  # of the backbone curve, for cones
COLUMNS = ["study", "run", "v D / c_v", "resistance (N)", "over drained", "backbone"]
COEFFICIENT = re.compile(r"drainage of layer 1 +c_v = (\S+) m2/s")


class Point(NamedTuple):
    """A run between the limits."""

    group: float  # v D / c_v
    resistance: float  # N


def backbone(group: np.ndarray, undrained: float) -> np.ndarray:
    """Return the resistance over the drained one, [n] for the groups v D / c_v [n],
    if the undrained one is the given share of it."""
    return undrained + (1 - undrained) / (1 + (group / V50) ** POWER)


def resistance(study: Study, run: StudyRun) -> float:
    """Return the mean force (N). Raises StudyError where there is none."""
    if run.status is None or run.trouble:
        raise StudyError(f"{study.id} {run.name}: {run.trouble}")
    try:
        history = run.results.history
    except ResultsError as error:
        raise StudyError(str(error)) from error
    force = history["tip_force_N"] + history.get("tip_water_force_N", 0.0)
    first, last = study.keys["depths"]
    depth = history["penetration_m"]
    inside = (depth >= first) & (depth <= last)
    if not inside.any():
        raise StudyError(f"{study.id} {run.name}: no row from {first} to {last} m")
    return float(force[inside].mean()) - study.keys.get("at_rest", 0.0)


def group_of(study: Study, run: StudyRun) -> float:
    """Return v D / c_v, with the c_v that the program prints at the beginning."""
    log = (run.run.directory / "log").read_text(encoding="utf-8")
    found = COEFFICIENT.search(log)
    if found is None:
        raise StudyError(f"{study.id} {run.name}: the run is not coupled")
    return float(study.keys["velocity"] * study.keys["width"] / float(found.group(1)))


def between(study: Study) -> list[Point]:
    """Return the runs between the limits, the best drained first."""
    return sorted(
        Point(group_of(study, run), resistance(study, run))
        for run in study.runs
        if run.name not in (DRAINED, UNDRAINED)
    )


def draw(
    axes: Axes, study: Study, points: Sequence[Point], limits: list[float]
) -> None:
    """Draw the points, both limits, and the backbone curve between them."""
    groups = np.array([point.group for point in points])
    drained, undrained = limits
    shares = np.array([point.resistance for point in points]) / drained
    axes.semilogx(groups, shares, "o-", color="C0", ms=5, lw=1, label="coupled")
    curve = np.geomspace(groups[0], groups[-1], 200)
    axes.semilogx(
        curve,
        backbone(curve, undrained / drained),
        color="0.3",
        ls="--",
        lw=1,
        label=f"DeJong & Randolph (2012), V₅₀ = {V50:g}, c = {POWER:g}",
    )
    axes.axhline(1, color="C2", lw=1, label="Level = drained")
    axes.axhline(undrained / drained, color="C3", lw=1, label="Level = undrained")
    axes.set(xlabel="v D / c$_v$", title=study.title, ylim=(0, 1.1))
    axes.title.set_fontsize(10)
    axes.grid(color="0.9")


def evaluate(studies: Sequence[Study], options: Options, _: float) -> int:
    """Write drainage.png, table.md and table.csv, and print the table."""
    figure = Figure(figsize=(9, 4))
    all_axes = figure.subplots(1, len(studies), sharey=True, squeeze=False)[0]
    rows = []
    for axes, study in zip(all_axes, studies):
        limits = [resistance(study, study.run(n)) for n in (DRAINED, UNDRAINED)]
        points = between(study)
        draw(axes, study, points, limits)
        for name, force in zip((DRAINED, UNDRAINED), limits):
            share = f"{force / limits[0]:.3f}"
            rows.append([study.id, name, "", f"{force:.4g}", share, ""])
        for group, force in points:
            expected = backbone(np.array(group), limits[1] / limits[0])
            share = f"{force / limits[0]:.3f}"
            numbers = [f"{group:.3g}", f"{force:.4g}", share, f"{expected:.3f}"]
            rows.append([study.id, "coupled", *numbers])
    all_axes[0].set_ylabel("resistance over the drained one")
    all_axes[0].legend(fontsize=8, loc="lower left")
    outcome.write(NAME, options.results, figure, COLUMNS, rows)
    return 0
