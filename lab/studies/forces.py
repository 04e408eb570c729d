# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "forces": the curves of many runs beside each other.

The only key beside the usual ones is depths: the penetrations (m) at which tip force
and friction (kN, means over 0.2 m, see curves) are printed, then the required suction
and the margin to piping, where there are any, and
  roughness  standard deviation of the curve minus its 0.2 m running mean over
             the mean of the latter, from 1 m on (%), tip and total
  KE/W       largest kinetic energy over external work, once the waves of the
             start have decayed (%)
and the largest counts of points in the body and of limiter firings.
"""
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from caisson import curves
from caisson.results import Results, ResultsError, Table
from caisson.study import Options, Study
from caisson.verdict.run_review import kinetic_share_of

NAME = "forces"
STUDY_KEYS = {"depths"}


def largest(history: Table, column: str) -> str:
    """Return the largest value of a count."""
    return f"{history[column].max():.0f}"


def suction_words(history: Table, at: np.ndarray) -> list[str]:
    """Return required suction and margin to piping at depths [n]; nothing without."""
    if not {"required_suction_Pa", "exit_gradient_axis"} <= set(history):
        return [""] * len(at)
    rows = curves.main_way(history["penetration_m"])
    suctions, shares = (
        curves.smoothed_at(history["penetration_m"][rows], values[rows], at)
        for values in (history["required_suction_Pa"], curves.gradient_share(history))
    )
    return [
        f"  required suction {max(suction, 0) / 1e3:5.1f} kPa, margin to piping"
        f" {100 * (1 - share):3.0f} %"
        for suction, share in zip(suctions, shares)
    ]


def describe(directory: Path, depths: Sequence[float]) -> Iterator[str]:
    """Yield the lines on one run. Raises ResultsError."""
    run = Results(directory)
    history, shown = run.history, run.shown
    depth, tip = history["penetration_m"], history["tip_force_N"]
    friction = history["inner_friction_N"] + history["outer_friction_N"]
    at = np.array([x for x in depths if depth.min() <= x])
    rows, kilonewton = curves.main_way(depth), 1e-3 * shown.factor("kN")
    tips, frictions = (
        kilonewton * curves.smoothed_at(depth[rows], force[rows], at)
        for force in (tip, friction)
    )
    more = suction_words(history, at)
    yield str(directory)
    for x, a, b, words in zip(at, tips, frictions, more):
        where = shown.depth(x).rjust(7)
        if x > depth.max():
            yield f"  {where}: not reached (ends at {shown.depth(depth.max())})"
        else:
            unit = shown.name("kN")
            yield f"  {where}: tip {a:7.1f}  friction {b:7.1f} {unit}{words}"
    rough = [100 * curves.roughness(depth, f) for f in (tip, history["total_force_N"])]
    found: list[str] = []
    if np.isfinite(rough).all():
        found.append("roughness: tip {:.2f} %, total {:.2f} %".format(*rough))
    if kinetic := kinetic_share_of(run):
        found.append(f"KE/W {100 * kinetic.share:.3f} %")
    if found:
        yield "  " + ";  ".join(found)
    yield (
        f"  points in body {largest(history, 'points_in_body')}, limiter"
        f" {largest(history, 'limiter_count')}, steps {largest(history, 'step')}"
    )


def evaluate(studies: Sequence[Study], _: Options, __: float) -> int:
    """Print the numbers of all runs; return 1 where one is missing."""
    status = 0
    for study in studies:
        for run in study.runs:
            print(f"{study.id}, {run.name}:")
            try:
                print("\n".join(describe(run.run.directory, study.keys["depths"])))
            except ResultsError as error:
                print(f"  {error}")
                status = 1
    return status
