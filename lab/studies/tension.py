# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "tension": the pull of a caisson with a sealed lid over its rate.

The runs differ in their permeability, and so in v D / c_v. Prints the largest pull of
each and what bears it, and draws them over v D / c_v. Keys of a study beside the usual
ones:

    width      the length D of v D / c_v (m)
    velocity   v of the body (m/s)
"""
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.figure import Figure

from caisson import evaluation
from caisson.results import ResultsError
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError
from lab import outcome

from .drainage import group_of

NAME = "tension"
STUDY_KEYS = set("width velocity".split())
PARTS = {  # name: member of the largest pull
    "water beneath lid and tip": "water_N",
    "outer friction": "outer_friction_N",
    "inner friction": "inner_friction_N",
    "tip": "tip_N",
}
COLUMNS = [
    "study",
    "v D / c_v",
    "pull (kN)",
    *(f"{part} (kN)" for part in PARTS),
    "at (mm)",
    "plug follows",
    "water balance",
]


class Pull(NamedTuple):
    """The largest pull of a run."""

    group: float  # v D / c_v
    total: float  # N
    parts: tuple[float, ...]  # N, of PARTS
    way: float  # m, upward
    follows: float  # rise of the plug over that of the lid
    balance: float  # of the water beneath the lid


def largest_pull(study: Study, run: StudyRun) -> Pull:
    """Return the largest pull of a run. Raises StudyError where there is none."""
    if run.status is None or run.trouble:
        raise StudyError(f"{study.id} {run.name}: {run.trouble}")
    try:
        history = run.results.history
    except ResultsError as error:
        raise StudyError(str(error)) from error
    found = evaluation.largest_pull(run.results.history)
    if not found:
        raise StudyError(f"{study.id} {run.name}: the caisson is not pulled")
    return Pull(
        group_of(study, run),
        found["pull_N"],
        tuple(found[key] for key in PARTS.values()),
        found["rise_m"],
        found["plug_follows"],
        float(np.abs(history["lid_water_balance"]).max()),
    )


def evaluate(studies: Sequence[Study], options: Options, _: float) -> int:
    """Write tension.png, table.md and table.csv, and print the table."""
    figure = Figure(figsize=(4.6 * len(studies) + 2.4, 4))
    all_axes = figure.subplots(1, len(studies), squeeze=False)[0]
    rows = []
    for axes, study in zip(all_axes, studies):
        pulls = sorted(largest_pull(study, run) for run in study.runs)
        groups = [pull.group for pull in pulls]
        axes.semilogx(
            groups, [1e-3 * p.total for p in pulls], "ko-", ms=5, lw=1.5, label="pull"
        )
        for i, part in enumerate(PARTS):
            values = [1e-3 * pull.parts[i] for pull in pulls]
            axes.semilogx(groups, values, ".-", color=f"C{i}", lw=1, label=part)
        axes.set(xlabel="v D / c$_v$", ylabel="kN", title=study.title)
        axes.title.set_fontsize(10)
        axes.grid(color="0.9")
        for pull in pulls:
            forces = [f"{1e-3 * force:.4g}" for force in (pull.total, *pull.parts)]
            rows.append(
                [
                    study.id,
                    f"{pull.group:.3g}",
                    *forces,
                    f"{1e3 * pull.way:.3g}",
                    f"{pull.follows:.2f}",
                    f"{pull.balance:.1e}",
                ]
            )
    all_axes[0].legend(fontsize=8)
    outcome.write(NAME, options.results, figure, COLUMNS, rows)
    return 0
