# SPDX-License-Identifier: LGPL-2.1-or-later
"""design.csv: the forces of a caisson, and with suction its suction, beside what the
design methods say, over the depth of a run."""
from contextlib import suppress
from pathlib import Path

import numpy as np

from caisson import curves
from caisson.design import plug_stability
from caisson.verdict import suction_methods, theory
from caisson.results import Results, Table
from caisson.table import write_columns

INTERVAL, FEW = 0.1, 5  # m between the rows; where they are fewer, a tenth of it
LEAST_INTERVAL = 1e-3  # m
FORCES = ("tip_force_N", "inner_friction_N", "outer_friction_N", "total_force_N")
SUCTION = "required_suction_Pa"
PLUG = {
    plug_stability.REVERSE_BEARING: "plug_reverse_bearing_Pa",
    plug_stability.LIFT: "plug_lift_Pa",
}


def goes_down(history: Table) -> bool:
    """Return whether the body ever goes deeper than where it began."""
    depth = history.get("penetration_m", np.zeros(1))
    return bool(depth.max() > depth[0] + 1e-9)


def depths_of(history: Table) -> np.ndarray:
    """Return the depths of design.csv, from the start of a run to its deepest."""
    depth, interval = history["penetration_m"], INTERVAL
    way = depth.max() - depth[0]
    while 0 < way < FEW * interval and interval > LEAST_INTERVAL:
        interval /= 10
    return np.round(depth[0] + interval * np.arange(int(way / interval + 1e-6) + 1), 9)


def forces_at(history: Table, depth: np.ndarray) -> Table:
    """Return the forces of a run on its way down at depths [n], as columns [n]."""
    return curves.down_at(history, filter(history.__contains__, FORCES), depth)


def compared_at(history: Table, depth: np.ndarray) -> Table:
    """Return the forces at depths [n] that design methods speak of: in undrained and
    coupled runs, tip and total contain the excess pressure of the water on the tip."""
    total = history.get(curves.WITH_WATER)
    if total is None:
        return forces_at(history, depth)
    tip = history["tip_force_N"] + history["tip_water_force_N"]
    more = {"tip_force_N": tip, "total_force_N": total}
    return forces_at(history | more, depth)


def suction_at(history: Table, depth: np.ndarray) -> np.ndarray:
    """Return the required suction of a run on its way down at depths [n]: [n]."""
    return curves.down_at(history, [SUCTION], depth)[SUCTION]


def column_of(answer: theory.Answer, case: str, part: str) -> str:
    """Return the column with a part of the resistance by a method, such as
    houlsby_byrne_low_tip_N or, by a cone that is assumed, dnv_assumed_cone_highest_...
    """
    mark = ["assumed_cone"] if answer.assumed else []
    return "_".join([answer.method.key, *mark, *case.split(), *part.split(), "N"])


def columns_of(run: Results) -> Table:
    """Return the columns of design.csv, [n] each, nan where there is no answer."""
    history, site = run.history, theory.site_of(run)
    depth = depths_of(history)
    nothing = np.full(len(depth), np.nan)
    columns = {"penetration_m": depth, **forces_at(history, depth)}
    for answer in theory.answers_of(site, depth):
        for case in answer.method.all_cases:
            for part in theory.PARTS:
                values = answer.forces[case][part] if answer.forces else nothing
                columns[column_of(answer, case, part)] = values
    with suppress(theory.NotApplicable):
        cone = theory.cone_of(site, float(depth.max()))
        head = "assumed_cone_resistance_Pa" if cone.assumed else "cone_resistance_Pa"
        columns[head] = np.array([cone.at(float(h)) for h in depth])
    if SUCTION in history:
        columns[SUCTION] = suction_at(history, depth)
        found = suction_methods.answers_of(site, depth)
        for name in suction_methods.METHODS:
            head = name.replace("_cone", "_assumed_cone") if found.assumed else name
            columns[head] = found.suctions.get(name, nothing)
        if found.in_clay:
            head = "clay_assumed_cone" if found.assumed else "clay"
            cases = found.in_clay.cases.items()
            columns |= {f"{head}_{case}_Pa": values for case, values in cases}
        *_, plug = suction_methods.limits_at(site, depth)
        columns |= {PLUG[name]: values for name, values in plug.items()}
    return columns


def write(path: Path, run: Results) -> Path | None:
    """Write design.csv, with empty cells where a method has no answer; return its
    path, or None where no caisson goes down."""
    if not theory.is_caisson(run.scene) or not goes_down(run.history):
        return None
    return write_columns(path, columns_of(run), 12)
