# SPDX-License-Identifier: LGPL-2.1-or-later
"""A caisson that is pulled: how much it bears, what bears it, and the pull over the
rise."""
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from caisson import curves
from caisson.evaluation import DEPTH, is_pull, is_sealed
from caisson.plot.charts import COLORS, WATER_COLOR, column_of
from caisson.results import Results
from caisson.shown import Units
from caisson.table import in_units
from caisson.template import say, say_rows
from caisson.verdict.installation import trimmed
from caisson.verdict.outcome import results_of
from caisson.verdict.retrieval import Retrieval, is_retrieval, retrieval_of

SENTENCES = Path(__file__).with_name("verdict.jinja")
PULL, WATER = "pull", "water beneath lid and tip"


def largest_pull(run: Results) -> Mapping[str, Any]:
    """Return the largest pull; nothing of another run."""
    return results_of(run).get("largest_pull", {}) if is_pull(run) else {}


def cards_of(run: Results) -> list[list[str]]:
    """Return (name, value, remark) of what bears the largest pull; nothing without. The
    water that pushes a body out bears nothing of it."""
    if not (most := largest_pull(run)):
        return []
    is_pushed = is_retrieval(run)
    has_water = curves.WITH_WATER in run.history and not is_pushed
    what = run.shown, most, is_pushed, has_water
    return say_rows(SENTENCES, "pull_cards", *what, cells=3)


def sentence_of(run: Results) -> str:
    """Return the retrieval by water, or the largest pull and what fails, in a sentence;
    nothing without either."""
    if found := retrieval_of(run):
        begin = float(run.history[DEPTH].max())
        return say(SENTENCES, "retrieved", run.shown, found, begin, run.weight)
    most = largest_pull(run)
    return say(SENTENCES, "pulled", run.shown, most, run.weight) if most else ""


def retrieval_table(found: Retrieval, shown: Units) -> dict[str, Any]:
    """Return the table of a retrieval from its deepest place up: the required
    overpressure, each limit, the least of them, and what a crane takes."""
    up = slice(None, None, -1)
    limits = {f"{name} (kPa)": x[up] / 1e3 for name, x in found.limits.items()}
    columns: dict[str, Any] = {
        "depth (m)": [trimmed(shown.depth(float(h))) for h in found.depth[up]],
        "required overpressure (kPa)": found.required[up] / 1e3,
        **limits,
    }
    if limits:
        columns["allowable (kPa)"] = found.allowable[up] / 1e3
        columns["for a crane (kN)"] = found.missing[up] / 1e3
    return in_units(columns, shown)


def pull_parts(run: Results) -> tuple[np.ndarray, dict[str, tuple[str, np.ndarray]]]:
    """Return the rise above the deepest place [n_rows] (mm), and color and values
    [n_rows] (kN) of the pull and of its parts, by their names; with an open lid from
    where it begins to be pulled on, behind the unloading of the soil."""
    history = run.history
    total = history["total_force_N"]
    borne = history.get(curves.WITH_WATER, total)
    parts = {PULL: ("black", -borne / 1e3)}
    for name in ("outer friction", "inner friction", "tip"):
        parts[name] = (COLORS[name], -history[column_of(name)] / 1e3)
    if curves.WITH_WATER in history:
        parts[WATER] = (WATER_COLOR, (total - borne) / 1e3)
    depth = history["penetration_m"]
    rise = 1e3 * (depth.max() - depth)
    if is_sealed(run):
        return rise, parts
    begin = int(np.argmax(depth))  # a way down before it is an installation
    pulls = np.flatnonzero(borne[begin:] < 0)
    begin += max(int(pulls[0]) - 1, 0) if len(pulls) else 0
    return rise[begin:], {k: (color, x[begin:]) for k, (color, x) in parts.items()}
