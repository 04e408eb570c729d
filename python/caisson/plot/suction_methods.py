# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the design methods say about a run with suction, over depth: design.csv.

The ratio of the permeabilities inside and outside is 1. In layers, fits of a
critical suction take the mean unit weight down to the tip.
"""
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import numpy as np

from caisson.design import suction_installation as installation
from caisson.design.houlsby_byrne import Caisson
from caisson.design.seepage import feld, ibsen_thilsted
from caisson.plot.theory import NotApplicable, Scene, caisson_of
from caisson.results import Results, Table
from caisson.table import write_csv

INTERVAL = 0.1  # m, between the rows of design.csv
PLAIN, ENHANCED = "houlsby_byrne_plain_Pa", "houlsby_byrne_enhanced_Pa"
SENDERS_RANDOLPH = "senders_randolph_Pa"
CRITICAL_FELD = "critical_feld_Pa"
CRITICAL_SENDERS_RANDOLPH = "critical_senders_randolph_Pa"
CRITICAL_IBSEN_THILSTED = "critical_ibsen_thilsted_Pa"
PIPING = "critical_houlsby_byrne_Pa"
METHODS = (
    PLAIN,
    ENHANCED,
    SENDERS_RANDOLPH,
    CRITICAL_FELD,
    CRITICAL_SENDERS_RANDOLPH,
    CRITICAL_IBSEN_THILSTED,
    PIPING,
)
COLUMNS = ("penetration_m", "required_suction_Pa", *METHODS)


@dataclass(frozen=True)
class Answers:
    """The methods over depth.

    suctions: [n] (Pa) at embedments depth [n] (m) by column of design.csv, nan
    where a method has no answer; rest: the penetration (m) by the weight alone,
    by column, where the weight comes to rest; neither of them, and why not.
    """

    depth: np.ndarray
    suctions: dict[str, np.ndarray] = field(default_factory=dict)
    rest: dict[str, float] = field(default_factory=dict)
    why_not: str = ""


def weight_of(scene: Scene) -> float:
    """Return the submerged weight of the caisson in N. Raises NotApplicable."""
    if scene.get("submerged_weight_N") is None:
        raise NotApplicable("run.json does not tell submerged_weight_N")
    return float(scene["submerged_weight_N"])


def suctions_at(caisson: Caisson, weight: float, h: float) -> dict[str, float]:
    """Return the suctions of all methods at an embedment, in Pa."""
    required = partial(installation.required_suction, caisson, weight, h)
    mean, diameter = installation.mean_unit_weight(caisson, h), caisson.outer_diameter
    return {
        PLAIN: required(False),
        ENHANCED: required(True),
        SENDERS_RANDOLPH: installation.required_suction_senders_randolph(
            caisson, weight, h
        ),
        CRITICAL_FELD: feld(mean, h, diameter),
        CRITICAL_SENDERS_RANDOLPH: installation.critical_suction(caisson, h),
        CRITICAL_IBSEN_THILSTED: ibsen_thilsted(mean, h, diameter),
        PIPING: installation.piping_suction(caisson, h),
    }


def rest_of(caisson: Caisson, weight: float, deepest: float) -> dict[str, float]:
    """Return the penetrations by weight that are not deeper than deepest."""
    found = {}
    for name, enhanced in ((PLAIN, False), (ENHANCED, True)):
        try:
            found[name] = installation.self_weight_penetration(
                caisson, weight, enhanced, deepest
            )
        except ValueError:  # it sinks in deeper
            continue
    return found


def answers_of(scene: Scene, depth: np.ndarray) -> Answers:
    """Return what the methods say at embedments [n]."""
    try:
        caisson, weight = caisson_of(scene), weight_of(scene)
    except NotApplicable as reason:
        return Answers(depth, why_not=str(reason))
    rows = [suctions_at(caisson, weight, float(h)) for h in depth]
    suctions = {name: np.array([row[name] for row in rows]) for name in METHODS}
    return Answers(depth, suctions, rest_of(caisson, weight, float(depth.max())))


def on_the_way_down(history: Table) -> np.ndarray:
    """Return the rows [n] that are deeper than all before them."""
    depth = history["penetration_m"]
    before = np.maximum.accumulate(depth)[:-1]
    return np.concatenate([[True], depth[1:] > before])


def depths_of(history: Table) -> np.ndarray:
    """Return the depths of design.csv, from the start of a run to its deepest."""
    depth = history["penetration_m"]
    n = int((depth.max() - depth[0]) / INTERVAL + 1e-6)
    return np.round(depth[0] + INTERVAL * np.arange(n + 1), 9)


def computed_at(history: Table, depth: np.ndarray) -> np.ndarray:
    """Return the required suction of a run, linear between its records, [n]."""
    rows = on_the_way_down(history)
    known = history["penetration_m"][rows], history["required_suction_Pa"][rows]
    return np.interp(depth, *known)


def write(path: Path, run: Results) -> Path:
    """Write design.csv, with empty cells where a method has no answer."""
    depth = depths_of(run.history)
    columns: Mapping[str, np.ndarray] = {
        "penetration_m": depth,
        "required_suction_Pa": computed_at(run.history, depth),
        **answers_of(run.scene, depth).suctions,
    }
    nothing = np.full(len(depth), np.nan)
    values = [columns.get(name, nothing).tolist() for name in COLUMNS]
    rows = [["" if np.isnan(v) else v for v in row] for row in zip(*values)]
    write_csv(path, COLUMNS, rows)
    return path
