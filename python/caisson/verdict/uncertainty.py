# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far a computed force or suction may be wrong: by mesh and steps, by the ground,
and by the model.

The three act by themselves, so that u^2 = u_mesh^2 + u_ground^2 + u_model^2 (JCGM
100:2008, 5.1.2), below and above the value of the best estimate each. The mesh has the
error bar of the run, or else the error that was asked of it; the ground the runs of low
and high resistance, which are about a standard deviation away where they come from a
cone test, and the scatter of the friction of steel; the model a share of the force by
which the program misses measurements (doc/validation.md).
"""
from collections.abc import Mapping
from dataclasses import replace
from math import hypot
from typing import Any, NamedTuple

import numpy as np

from caisson import evaluation
from caisson.band import BEST
from caisson.evaluation import DEPTH, SUCTION, TOTAL
from caisson.results import Results
from caisson.verdict.installation import Rate, around_tops, bounds_of, error_asked_of
from caisson.verdict.installation import has_begun, installation_of, plug_area
from caisson.verdict.limits import rounded_down
from caisson.verdict.outcome import feasible_to, reached
from caisson.verdict.theory import site_of, wall_angles_at

# shares of the force: a model caisson in sand beside its tests, and the scatter of the
# ring of jacked tubes over a cone, in which the computed ratio lies
OF_CAISSON, OF_RINGS = ("a model caisson", 0.08), ("rings of tubes", 0.12)
OF_STEEL = 0.10  # of the friction of a wall: 29.6 +- 2.5 degrees in 44 tests
NAMES = {TOTAL: ("total force", "N"), SUCTION: ("required suction", "Pa")}
PARTS = MESH, GROUND, PROGRAM = "mesh", "ground", "model"
POINTS = 60  # of a curve
Members = Mapping[str, Results]  # by estimate, the best one among them


class Part(NamedTuple):
    """By how much values [n] may be too high (below) and too low (above), in their
    unit, and whence that is known; share: of the force, where it is one."""

    name: str
    below: np.ndarray
    above: np.ndarray
    source: str
    share: float | None = None


class Uncertainty(NamedTuple):
    """Values [n] of a column of history.csv at depths [n] (m), in its unit, and the
    parts of their uncertainty that are known."""

    column: str
    depth: np.ndarray
    values: np.ndarray
    parts: list[Part]

    @property
    def low(self) -> np.ndarray:
        """The lower end [n], not below 0."""
        squares = sum(part.below**2 for part in self.parts)
        return np.maximum(self.values - np.sqrt(squares), 0)

    @property
    def high(self) -> np.ndarray:
        """The upper end [n], not below 0."""
        squares = sum(part.above**2 for part in self.parts)
        return np.maximum(self.values + np.sqrt(squares), 0)

    def as_json(self) -> dict[str, Any]:
        """Return what there is at the last depth, by names with their units."""
        values = np.maximum(self.values, 0)
        columns = {"low": self.low, "value": values, "high": self.high}
        for part in self.parts:
            sides = {"below": part.below, "above": part.above}
            columns |= {f"{part.name}_{side}": x for side, x in sides.items()}
        unit = NAMES[self.column][1]
        numbers = {f"{name}_{unit}": float(x[-1]) for name, x in columns.items()}
        where = {"quantity": self.column, DEPTH: float(self.depth[-1])}
        return {**where, **numbers, "missing": self.missing}

    @property
    def missing(self) -> list[str]:
        """The parts that are not known."""
        known = [part.name for part in self.parts]
        return [name for name in PARTS if name not in known]


def values_of(run: Results, column: str, at: np.ndarray) -> np.ndarray:
    """Return the means of a column at depths [n] (m), nan where the run has not been,
    or suction is not feasible; a suction is below 0 where the weight suffices."""
    numbers, depth = evaluation.at_depths(run, at), run.history[DEPTH]
    within = (at >= depth.min()) & (at <= min(feasible_to(run), depth.max()) + 1e-6)
    return np.where(within, numbers.get(column, np.nan), np.nan)


def of_mesh(run: Results, column: str, at: np.ndarray, values: np.ndarray) -> Part:
    """Return what the error bar of a run says, also shortly below it; nan without."""
    every = np.union1d(at, evaluation.at_depths(run).get(DEPTH, at))
    bounds = bounds_of(evaluation.at_depths(run, every), *column.rsplit("_", 1))
    rows, none = np.searchsorted(every, at), np.full(len(at), np.nan)
    low, high = (none, none) if bounds is None else (x[rows] for x in bounds[:2])
    below, above = np.maximum(values - low, 0), np.maximum(high - values, 0)
    return Part(MESH, below, above, "error bar")


def of_ground(
    members: Members, column: str, at: np.ndarray, values: np.ndarray
) -> Part:
    """Return what low and high resistance change; nan without their runs."""
    runs = [run for name, run in members.items() if name != BEST]
    ends = [values_of(run, column, at) for run in runs]
    ends = ends if len(ends) == 2 else [np.full(len(at), np.nan)]
    steel = of_steel(members[BEST], column, at)
    below = np.hypot(np.maximum(values - np.min(ends, axis=0), 0), steel)
    above = np.hypot(np.maximum(np.max(ends, axis=0) - values, 0), steel)
    source = "low and high resistance"
    return Part(GROUND, below, above, source + (", steel" if steel.any() else ""))


def has_steel(run: Results) -> bool:
    """Return whether a wall has friction, and not the adhesion of clay alone."""
    depth, site = run.history[DEPTH], site_of(run)
    angles = [wall_angles_at(site, side, depth) for side in ("inner", "outer")]
    return bool((np.nan_to_num(angles) > 0).any())


def of_steel(run: Results, column: str, at: np.ndarray) -> np.ndarray:
    """Return what the scatter of the friction of sand on steel changes [n]."""
    numbers, none = evaluation.at_depths(run, at), np.zeros(len(at))
    inner, outer = (numbers.get(f"{x}_friction_N", none) for x in ("inner", "outer"))
    change = OF_STEEL * (np.abs(inner) + np.abs(outer)) * has_steel(run)
    return np.asarray(change / (plug_area(run.scene) if column == SUCTION else 1.0))


def of_share(
    name: str, run: Results, column: str, values: np.ndarray, share: float, source: str
) -> Part:
    """Return a part that is a share of the force behind values [n]: of a required
    suction, which bears the resistance less the weight, more than that share of it."""
    force = values
    if column == SUCTION:
        force = values + run.weight / plug_area(run.scene)
    return Part(name, share * force, share * force, source, share)


def of_model(run: Results, column: str, values: np.ndarray) -> Part:
    """Return by how much the program may miss the value of a run; clay has no caisson
    to be compared with."""
    known = [OF_CAISSON, OF_RINGS] if has_steel(run) else [OF_RINGS]
    share, words = hypot(*(x for _, x in known)), " and ".join(x for x, _ in known)
    return of_share(PROGRAM, run, column, values, share, words)


def uncertainty_of(members: Members, column: str, at: np.ndarray) -> Uncertainty | None:
    """Return the uncertainty of a column at depths [n] (m), with the parts that are
    known at all of them; None where the best run has no such value."""
    best = members[BEST]
    sucks = bool(best.weight) and "diameter_m" in best.scene
    if column not in best.history or best.by_hand or (column == SUCTION and not sucks):
        return None
    values = values_of(best, column, at)
    if not np.isfinite(values).all():
        return None
    parts = [
        of_mesh(best, column, at, values),
        of_ground(members, column, at, values),
        of_model(best, column, values),
    ]
    if (asked := error_asked_of(best)) and not np.isfinite(parts[0].below).all():
        source = "asked for, not computed"
        parts[0] = of_share(MESH, best, column, values, asked / 100, source)
    known = [p for p in parts if np.isfinite([p.below, p.above]).all()]
    return Uncertainty(column, at, values, known)


def end_of(members: Members) -> float:
    """Return the depth (m) where the way of the first of the estimates ends, or its
    suction."""
    ends = [min(feasible_to(x), x.history[DEPTH].max()) for x in members.values()]
    return float(min(ends))


def at_end(members: Members) -> list[Uncertainty]:
    """Return the uncertainty of the total force and of the required suction there."""
    at = np.array([end_of(members)])
    found = [uncertainty_of(members, name, at) for name in NAMES]
    return [x for x in found if x is not None]


def over_depth(members: Members, column: str) -> Uncertainty | None:
    """Return the uncertainty of a column down to there; None where there is no way."""
    start, end = float(members[BEST].history[DEPTH].min()), end_of(members)
    if end <= start:
        return None
    at = np.linspace(start, end, POINTS)
    at = np.union1d(at, around_tops(members[BEST], start, end))
    return uncertainty_of(members, column, at)


def end_of_upper(run: Results, members: Members) -> float | None:
    """Return the depth (m) above the end of suction where the upper end of the required
    suction of a run that has ended reaches the allowable one; None without."""
    if run.by_hand or run.is_running:
        return None
    ended = {n: x for n, x in members.items() if n == BEST or x.is_finished}
    found = over_depth(ended, SUCTION)
    known = found and installation_of(run, Rate(), found.depth)
    if not found or not known or not known.limits:
        return None
    needed = np.where(has_begun(known.required), found.high / 1e3, 0.0)
    end = reached(replace(known, required=needed), known.allowable)
    depth = rounded_down(end[0]) if end else np.inf
    return depth if depth < feasible_to(run) else None
