# SPDX-License-Identifier: LGPL-2.1-or-later
"""The installation in numbers: what it takes at each half meter and at the end, what
is allowed, and the pump.

The allowable suction is the least of the limits of limits.py, each by its factor.
The pump moves the water that the lid displaces at a stated rate of penetration and that
which seeps through the plug; a run is usually far faster than a caisson.
"""
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from caisson import curves
from caisson.evaluation import DEPTH, EXPECTED_HEAVE, GRADIENT, HEAVE
from caisson.evaluation import at_depths, rest_of
from caisson.runner import command_for
from caisson.verdict import design, limits, suction_methods, theory
from caisson.results import Results, Table
from caisson.table import NOTHING, in_units, text_of
from caisson.shown import USUAL, Units

HOUR = 3600.0
PIECES = 100  # of a way, between which a peak of the suction is looked for
JUST_BELOW = 1e-3  # of the way: there the tip stands on the next layer
STIFFENERS = "Ring stiffener spacing"
LITTLE = 0.1  # of the largest suction
PEAK = 1.02  # times the largest value of the rows, that a peak exceeds
HELD = 0.7  # m, below the error bar, over which its last width still stands


ORDER = list(limits.LIMITS)  # of the rows


def plug_area(scene: Mapping[str, Any]) -> float:
    """Return the area that suction acts on (m2)."""
    inner = float(scene["diameter_m"]) - 2 * float(scene["wall_thickness_m"])
    return math.pi / 4 * inner**2


def has_begun(required: np.ndarray, is_exact: bool = False) -> np.ndarray:
    """Return where a required suction [n] (kPa) counts, [n]: where that of a run, which
    is not exact, begins, its share of a limit is a ratio of small numbers."""
    least = 0.0 if is_exact else LITTLE * float(required.max())
    return np.asarray(required > max(NOTHING, least))


class Rate(NamedTuple):
    """The rate of penetration that the pump is made for."""

    meters_per_hour: float = 1.0
    assumed: bool = True

    @property
    def words(self) -> str:
        """The rate in words."""
        mark = " (ASSUMED)" if self.assumed else ""
        return f"{self.meters_per_hour:g} m/h{mark}"


class Bounds(NamedTuple):
    """Error bar of values [n], and best estimates; below the depth end (m) as there."""

    low: np.ndarray
    high: np.ndarray
    best: np.ndarray
    end: float

    def is_known(self, i: int) -> bool:
        """Return whether a row has an error bar."""
        return bool(np.isfinite([self.low[i], self.high[i]]).all())

    def scaled(self, factor: float, least: float = -np.inf) -> "Bounds":
        """Return them times a factor, and not below the least one."""
        low, high, best = (np.maximum(factor * x, least) for x in self[:3])
        return Bounds(low, high, best, self.end)


@dataclass
class Installation:
    """Columns [n] at depths [n] (m) of the way down: forces in kN, suctions in kPa;
    those of suction are empty in a jacked run."""

    depth: np.ndarray
    forces: dict[str, np.ndarray]
    shown: Units = USUAL  # in which tables and cards have them
    is_exact: bool = False  # by hand methods
    force_bounds: Bounds | None = None
    required: np.ndarray = field(default_factory=lambda: np.empty(0))
    required_bounds: Bounds | None = None
    excess: float | None = None  # kN, of the weight at the end, without any suction
    limits: dict[str, np.ndarray] = field(default_factory=dict)  # by their factors
    assumes: dict[str, str] = field(default_factory=dict)  # of limits, in words
    factors: dict[str, float] = field(default_factory=dict)
    # m, top of the soft layer below the tip that governs reverse bearing, nan if none
    soft_below: np.ndarray = field(default_factory=lambda: np.empty(0))
    absent: list[str] = field(default_factory=list)  # kinds of limits, and why
    lid: float | None = None  # m, the depth at which the plug would meet it
    gradient: np.ndarray = field(default_factory=lambda: np.empty(0))  # over critical
    heave: np.ndarray = field(default_factory=lambda: np.empty(0))  # m, computed
    # m, at least what the wall takes up, for which room is needed
    expected: np.ndarray = field(default_factory=lambda: np.empty(0))
    room: np.ndarray = field(default_factory=lambda: np.empty(0))  # m, below the lid
    flow: np.ndarray = field(default_factory=lambda: np.empty(0))  # m3/h
    seepage: np.ndarray = field(default_factory=lambda: np.empty(0))  # m3/h, of it
    rest: float | None = None  # m
    # kN, of the whole body, where water presses on its tip, too
    with_water: np.ndarray = field(default_factory=lambda: np.empty(0))

    @property
    def has_suction(self) -> bool:
        """Whether the caisson goes in by suction: its weight alone does not suffice."""
        return bool((self.required > NOTHING).any())

    @property
    def expects_more(self) -> bool:
        """Whether clearly more heave is expected at the end than computed."""
        return len(self.heave) > 0 and self.expected[-1] > 1.05 * self.heave[-1]

    @property
    def force(self) -> np.ndarray:
        """What the body takes, [n]: with the water on its tip, if that is known."""
        return self.with_water if len(self.with_water) else self.forces["total_force_N"]

    @property
    def has_bar(self) -> bool:
        """Whether the tables have an error bar."""
        return bool(self.force_bounds or self.required_bounds)

    @property
    def allowable(self) -> np.ndarray:
        """The least limit (kPa), [n]; infinite without any."""
        return limits.least_of(self.limits, len(self.depth))

    @property
    def utilization(self) -> np.ndarray:
        """The required suction over the allowable one, [n]; where none is allowed
        infinite, or nan if none is required either."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.asarray(self.required / self.allowable)

    @property
    def share(self) -> np.ndarray:
        """The same [n], 0 where nothing bounds it, and where suction begins."""
        known = np.nan_to_num(self.utilization, posinf=1e9)
        return np.where(has_begun(self.required, self.is_exact), known, 0.0)

    @property
    def held_up(self) -> np.ndarray:
        """Where wall or lid hold the caisson up without any suction, [n]."""
        wall, lid = (self.limits.get(x, np.inf) for x in (limits.SHELL, limits.LID))
        return np.asarray(np.minimum(wall, lid) <= np.zeros(len(self.depth)))

    def governing(self, i: int) -> str:
        """Return which limit is the least at a depth."""
        return limits.governing(self.limits, i)

    def governing_in_words(self, i: int) -> str:
        """Return which limit is the least at a depth, and the soft layer below the tip
        if that governs it."""
        name = self.governing(i)
        return f"{name}{self.remark(name, i)}"

    def remark(self, name: str, i: int | None = None) -> str:
        """Return what to add to the name of a limit at a depth, or at all depths: what
        it assumes, or the soft layers below the tip that govern it."""
        if name != limits.REVERSE_BEARING:
            return self.assumes.get(name, "")
        tops = self.soft_below if i is None else self.soft_below[i : i + 1]
        words = limits.soft_in_words(tops, self.shown)
        return f": {words}" if words else ""

    def named(self, name: str) -> str:
        """Return the name of a limit with its factor, if that is not 1."""
        factor = self.factors.get(name, 1.0)
        return name if not name or factor == 1 else f"{name}, factor {factor:g}"


def needs_suction(run: Results) -> bool:
    """Return whether the weight of a caisson does not suffice at any depth of the
    tables; False without suction."""
    required = at_depths(run).get(design.SUCTION, np.empty(0))
    return bool((required > 1e3 * NOTHING).any())


def bounds_of(numbers: Table, quantity: str, unit: str) -> Bounds | None:
    """Return the bounds of a column of at_depths() in its unit, [n]; below the error
    bar, up to HELD, those of the same width; None without an error bar."""
    name = f"{quantity}_{unit}"
    sides = [f"{quantity}_{side}_{unit}" for side in ("low", "high", "limit")]
    if sides[0] not in numbers:
        return None
    values, depth = numbers[name], numbers["penetration_m"]
    known = np.flatnonzero(np.isfinite(numbers[sides[0]]))
    if not len(known):
        return None
    last = int(known[-1])
    held = (depth > depth[last]) & (depth <= depth[last] + HELD)
    found = []
    for side in (numbers.get(side, np.full_like(values, np.nan)) for side in sides):
        ratio, change = side[last] / values[last], side[last] - values[last]
        below = values * ratio if unit == "N" else values + change
        found.append(np.where(held, below, side))
    return Bounds(found[0], found[1], found[2], float(depth[last]))


def installation_of(
    run: Results, rate: Rate, at: np.ndarray | None = None
) -> Installation | None:
    """Return the installation at depths [n] (m), or those of the tables with the peaks
    between them; None for a run that does not go down."""
    found = installation_at(run, rate, at)
    if at is not None or found is None or not len(found.required):
        return found
    return installation_at(run, rate, np.union1d(found.depth, peaks_of(run, found)))


def around_tops(run: Results, first: float, end: float) -> np.ndarray:
    """Return the depths (m) of the tops of layers between two depths, and just below
    them, [n]: what a tip meets changes there."""
    tops = np.array([x.get("top_depth_m", 0) for x in run.scene.get("layers", [])])
    found = np.append(tops, tops + JUST_BELOW * (end - first))
    return found[(found > first) & (found < end)]


def peaks_of(run: Results, found: Installation) -> np.ndarray:
    """Return the depths [n] (m) between rows, or above the first of them, where the
    required suction, or its share of the allowable one, is larger than in all rows, as
    in a thin layer, and where it first reaches the allowable one."""
    first, end = float(run.history[DEPTH][0]), found.depth[-1]
    even = np.linspace(first, end, PIECES + 1)
    at = np.union1d(even, around_tops(run, first, end))
    if (fine := installation_at(run, Rate(), at)) is None:
        return np.empty(0)
    pairs = (fine.required, found.required), (fine.share, found.share)
    peaks = [int(x.argmax()) for x, rows in pairs if x.max() > PEAK * rows.max()]
    beyond, row = np.flatnonzero(fine.share >= 1), np.flatnonzero(found.share >= 1)
    if len(beyond):
        before = found.depth[max(row[0] - 1, 0)] if len(row) else end
        peaks += [int(beyond[0])] if fine.depth[beyond[0]] <= before else []
    return fine.depth[peaks]


def installation_at(
    run: Results, rate: Rate, at: np.ndarray | None
) -> Installation | None:
    """Return the installation at these rows alone."""
    history = run.history
    if curves.penetration(history) is None or not design.goes_down(history):
        return None
    numbers = at_depths(run, at)
    if not numbers or not set(design.FORCES) <= set(numbers):
        return None
    at = numbers["penetration_m"]
    forces = {name: numbers[name] / 1e3 for name in design.FORCES}
    found = Installation(at, forces, run.shown, run.by_hand is not None)
    if bars := bounds_of(numbers, "total_force", "N"):
        found.force_bounds = bars.scaled(1e-3)
    if curves.WITH_WATER in numbers:
        found.with_water = numbers[curves.WITH_WATER] / 1e3
    if design.SUCTION in numbers and (run.weight or run.by_hand):
        add_suction(found, run, numbers, rate)
    return found


def add_suction(found: Installation, run: Results, numbers: Table, rate: Rate) -> None:
    """Add the columns of a run with suction."""
    scene, at, factors = run.scene, found.depth, limits.factors_of(run)
    found.required = np.maximum(numbers[design.SUCTION], 0) / 1e3
    if bars := bounds_of(numbers, "required_suction", "Pa"):
        found.required_bounds = bars.scaled(1e-3, 0.0)
    if weight := scene.get("submerged_weight_N"):
        found.excess = (float(weight) - found.forces["total_force_N"][-1] * 1e3) / 1e3
    found.gradient = numbers.get(GRADIENT, np.empty(0))
    found.heave = numbers[HEAVE]
    found.expected = numbers.get(EXPECTED_HEAVE, found.heave)
    if length := scene.get("skirt_length_m"):
        found.room = float(length) - at - found.expected
        factored = float(length) - at - factors[limits.LID] * found.expected
        found.lid = limits.lid_depth(at, factored)
    found.limits, found.factors = limits.limits_of(run, at), factors
    found.absent = limits.absent_of(run, found.limits)
    if run.assumes("Water depth"):
        found.assumes[limits.BOILING] = ", of a water depth that is ASSUMED"
    if limits.number_of(run, STIFFENERS):
        found.assumes[
            limits.SHELL
        ] = ", whose stiffeners no soil bears on here (Rigid body/Rings has such)"
    found.soft_below = suction_methods.soft_below(theory.site_of(run), at)
    found.rest = rest_of(run)
    if scene.get("diameter_m"):
        if "seepage_flow_m3_s" in numbers:
            found.seepage = HOUR * np.maximum(numbers["seepage_flow_m3_s"], 0)
        rise = np.gradient(found.heave, at) if len(at) > 1 else np.zeros(len(at))
        seeps = found.seepage if len(found.seepage) else np.zeros(len(at))
        found.flow = plug_area(scene) * rate.meters_per_hour * (1 + rise) + seeps


def error_asked_of(run: Results) -> int | None:
    """Return the error (%) for which caisson suggest has made the mesh of a scene, as
    its title says it."""
    said = re.search(r"error of about (\d+) ?%", str(run.known.get("title", "")))
    return int(said[1]) if said else None


def way_to_an_error(run: Results) -> str:
    """Return the command that computes the error bar of a scene."""
    scene = Path(str(run.known.get("scene_file") or "FILE.prm"))
    return command_for(scene, (), f"--error {error_asked_of(run) or 10}%")


def bar_at(found: Installation, bounds: Bounds | None, i: int, unit: str) -> str:
    """Return the error bar of a row and the best estimate in words; nothing where they
    are not known."""
    if bounds is None or not bounds.is_known(i):
        return ""
    low, high, best = (text_of(found.shown.factor(unit) * x[i]) for x in bounds[:3])
    about = "about " if found.depth[i] > bounds.end + 1e-2 else ""
    return f"{about}{low} to {high}{', best ' if best else ''}{best}"


def in_range(
    found: Installation, values: np.ndarray, bounds: Bounds | None, unit: str
) -> list[str]:
    """Return values [n] in the unit shown, with their bounds where they have any:
    about, below the end of these."""
    texts = [text_of(found.shown.factor(unit) * float(value)) for value in values]
    bars = [bar_at(found, bounds, i, unit) for i in range(len(values))]
    return [f"{t} ({b})" if b else t for t, b in zip(texts, bars)]


def trimmed(words: str) -> str:
    """Return the number of "4.50 m" without its last zeros."""
    return words.split()[0].rstrip("0").rstrip(".")


def tables_of(found: Installation) -> list[dict[str, Any]]:
    """Return the tables of the installation, each with heads and rows of text: what it
    takes and, with suction, what is allowed."""
    shown, force = found.shown, found.forces["total_force_N"]
    depth = {"depth (m)": [trimmed(shown.depth(float(h))) for h in found.depth]}
    takes: dict[str, Any] = {
        **depth,
        "resistance (kN)": in_range(found, force, found.force_bounds, "kN"),
        "tip (kN)": found.forces["tip_force_N"],
        "inner friction (kN)": found.forces["inner_friction_N"],
        "outer friction (kN)": found.forces["outer_friction_N"],
        "with water (kN)": found.with_water,
    }
    room = {"plug heave (m)": found.heave, "room below the lid (m)": found.room}
    if found.expects_more:
        heave = "plug heave computed (m)", "plug heave expected (m)"
        known = dict(zip(heave, (found.heave, found.expected)))
        room = {**known, "room below the lid (m)": found.room}
    if not found.has_suction:
        return [in_units(takes | {"water to vent (m³/h)": found.flow} | room, shown)]
    bars = in_range(found, found.required, found.required_bounds, "kPa")
    power = found.flow / HOUR * found.required if len(found.flow) else found.flow
    pump: dict[str, Any] = {
        "required suction (kPa)": bars,
        "pump flow (m³/h)": found.flow,
        "of which seepage (m³/h)": found.seepage,
        "power of the water (kW)": power,
    }
    margins: dict[str, Any] = {
        **depth,
        "required suction (kPa)": found.required,
        "allowable (kPa)": found.allowable,
        "governed by": [found.governing_in_words(i) for i in range(len(found.depth))],
        "required / allowable": found.utilization,
        "exit gradient / critical": found.gradient,
    }
    return [in_units(takes | pump, shown), in_units(margins | room, shown)]


def quarters_of(
    run: Results, found: Installation, end: float | None, planned: float | None
) -> dict[str, Any]:
    """Return the table of required suction and all limits at quarters of the planned
    penetration (m), and at the depth that a run has reached before it; end: where
    suction ends (m), None where it does not."""
    if not (found.has_suction or end is not None) or not planned:
        return {}
    shown, reached = found.shown, float(found.depth[-1])
    quarters = wanted = planned * np.array([0.25, 0.5, 0.75, 1.0])
    deep = wanted <= reached + 1e-3 * planned
    at = wanted[deep & (wanted > run.history[DEPTH][0])]
    last, mark = (reached, "reached") if end is None else (end, "feasible")
    is_new = last < planned and not np.isclose(wanted, last, atol=1e-3 * planned).any()
    if is_new or end is not None:
        at, wanted = np.union1d(at, last), np.union1d(wanted, last)
    known = installation_of(run, Rate(), at) if len(at) else None
    places = [list(at).index(x) if x in at else None for x in wanted]
    if known is None:
        return {}
    needs = in_range(known, known.required, known.required_bounds, "kPa")
    none = "not feasible" if end is not None else "not reached"
    rows, factor = [[shown.named("required suction (kPa)")]], shown.factor("kPa")
    for i, depth in zip(places, wanted):
        if i is None:
            cell = none if depth > reached else "before the start"
        else:
            cell = needs[i] if known.required[i] > NOTHING else "0 (weight suffices)"
        rows[0].append(cell)
    for name, values in sorted(known.limits.items(), key=lambda x: ORDER.index(x[0])):
        label = known.named(name) + known.remark(name)
        if name == limits.LID and found.lid is not None:
            label += f": at about {shown.place(found.lid, 1)}"
        in_rows = (np.nan if i is None else factor * values[i] for i in places)
        rows.append([label, *(text_of(x) or "-" for x in in_rows)])
    rows += [[words] + ["-"] * len(wanted) for words in known.absent]
    least = [
        "" if i is None or known.required[i] <= NOTHING else known.governing_in_words(i)
        for i in places
    ]
    rows.append(["governed by", *least])
    shares = {
        float(x): f"{100 * x / planned:.0f} %: {shown.place(x)}" for x in quarters
    }
    heads = [shares.get(float(x), f"{mark}: {shown.place(x)}") for x in wanted]
    head = shown.named("limit of the suction (kPa)")
    return {"heads": [head, *heads], "rows": rows, "depths": wanted}
