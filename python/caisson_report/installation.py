# SPDX-License-Identifier: LGPL-2.1-or-later
"""The installation in numbers: what it takes at each half meter and at the end, what
is allowed, and the pump.

The allowable suction is the least of the suction at which the exit gradient that was
computed becomes critical, of that at which Houlsby & Byrne (2005) expect piping, of
the boiling of water below the lid, and of Water/Largest suction. No safety factor is
in it. The pump moves the water that the lid displaces at a stated rate of penetration
and that which seeps through the plug; a run is usually far faster than a caisson.
"""
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from caisson import curves
from caisson.plot import design, suction_methods, theory
from caisson.plot.forces import penetration
from caisson.plot.suction import rest_of_run
from caisson.results import Results
from caisson_design.reasons import text_of
from caisson_report.scene import entry_of, plug_area

INTERVAL = 0.5  # m, between the depths of the table
HOUR = 3600.0
COMPUTED = "exit gradient computed"
PIPING, BOILING, PUMP = "piping, Houlsby & Byrne", "water boils", "pump"


class Rate(NamedTuple):
    """The rate of penetration that the pump is made for."""

    meters_per_hour: float = 1.0
    assumed: bool = True

    @property
    def words(self) -> str:
        """The rate in words."""
        mark = " (ASSUMED; --rate sets another)" if self.assumed else ""
        return f"{self.meters_per_hour:g} m/h{mark}"


@dataclass
class Installation:
    """Columns [n] at depths [n] (m) of the way down: forces in kN, suctions in kPa;
    those of suction are empty in a jacked run."""

    depth: np.ndarray
    forces: dict[str, np.ndarray]
    force_bounds: tuple[np.ndarray, np.ndarray] | None = None
    required: np.ndarray = field(default_factory=lambda: np.empty(0))
    required_bounds: tuple[np.ndarray, np.ndarray] | None = None
    limits: dict[str, np.ndarray] = field(default_factory=dict)
    gradient: np.ndarray = field(default_factory=lambda: np.empty(0))  # over critical
    heave: np.ndarray = field(default_factory=lambda: np.empty(0))  # m
    room: np.ndarray = field(default_factory=lambda: np.empty(0))  # m, below the lid
    flow: np.ndarray = field(default_factory=lambda: np.empty(0))  # m3/h
    seepage: np.ndarray = field(default_factory=lambda: np.empty(0))  # m3/h, of it
    rest: float | None = None  # m

    @property
    def has_suction(self) -> bool:
        """Whether the caisson goes in by suction."""
        return len(self.required) > 0

    @property
    def allowable(self) -> np.ndarray:
        """The least limit (kPa), [n], nan without any."""
        found = np.array(list(self.limits.values()))
        return np.where(np.isnan(found), np.inf, found).min(axis=0)

    def governing(self, i: int) -> str:
        """Return which limit is the least at a depth."""
        known = {k: v[i] for k, v in self.limits.items() if np.isfinite(v[i])}
        return min(known, key=lambda name: known[name]) if known else ""


def depths_of(position: np.ndarray, interval: float = INTERVAL) -> np.ndarray:
    """Return the multiples of the interval (m) that a curve passes, and its end; the
    rounder ones of curves.round_depths() where it is shorter than two of them."""
    if np.ptp(position) < 2 * interval:
        found = curves.round_depths(position)
    else:
        found = curves.common_depths([position], interval)
        found = found[found > position.min() + 1e-9]
    end = float(position.max())
    if len(found) and end - found[-1] < 1e-3:
        return found
    return np.append(found, end)


def bounds_at(
    run: Results, quantity: str, unit: str, at: np.ndarray, values: np.ndarray
) -> tuple[np.ndarray, np.ndarray] | None:
    """Return the lower and the upper bound of values [n] of history.csv at depths [n],
    nan beyond the depths of the error bar; None where the run has none."""
    bounds = run.error_bounds
    if f"{quantity}_low_{unit}" not in bounds:
        return None
    depth, known = bounds["penetration_m"], bounds[f"{quantity}_{unit}"]
    inside = (at >= depth.min() - 1e-3) & (at <= depth.max() + 1e-3)
    found = []
    for side in ("low", "high"):
        change = bounds[f"{quantity}_{side}_{unit}"] - known
        changed = values + np.interp(at, depth, change)
        found.append(np.where(inside, changed, np.nan))
    return found[0], found[1]


def pump_limit(run: Results) -> float | None:
    """Return Water/Largest suction in kPa, None without one."""
    if run.is_running and not run.scene:
        return None
    try:
        return float(entry_of(run, "Water/Largest suction")) / 1e3
    except ValueError:
        return None


def limits_of(run: Results, found: Installation, boiling: np.ndarray) -> None:
    """Add the limits of the suction."""
    share = found.gradient
    pulled = (found.required > 0) & (share > 0.01)
    own = np.full(len(share), np.nan)
    own[pulled] = found.required[pulled] / share[pulled]
    found.limits[COMPUTED] = own
    answers = suction_methods.answers_of(theory.site_of(run), found.depth)
    if answers.suctions:
        found.limits[PIPING] = answers.suctions[suction_methods.PIPING] / 1e3
    found.limits[BOILING] = boiling
    limit = pump_limit(run)
    if limit is not None:
        found.limits[PUMP] = np.full(len(share), limit)


def installation_of(run: Results, rate: Rate) -> Installation | None:
    """Return the installation; None for a run that does not go down."""
    history = run.history
    if penetration(history) is None or not design.goes_down(history):
        return None
    rows = curves.way_down(history["penetration_m"])
    known = history["penetration_m"][rows]
    at = depths_of(known)
    if len(rows) < 3 or not set(design.FORCES) <= set(history):
        return None

    def mean(values: np.ndarray) -> np.ndarray:
        return curves.smoothed_at(known, values[rows], at)

    forces = {k: v / 1e3 for k, v in design.forces_at(history, at).items()}
    found = Installation(at, forces)
    total = forces["total_force_N"] * 1e3
    bars = bounds_at(run, "total_force", "N", at, total)
    if bars:
        found.force_bounds = bars[0] / 1e3, bars[1] / 1e3
    if design.SUCTION not in history:
        return found
    raw = mean(history[design.SUCTION])
    found.required = np.maximum(raw, 0) / 1e3
    bars = bounds_at(run, "required_suction", "Pa", at, raw)
    if bars:
        found.required_bounds = tuple(np.maximum(bar, 0) / 1e3 for bar in bars)
    gradient = np.maximum(history["exit_gradient_wall"], history["exit_gradient_axis"])
    found.gradient = mean(np.maximum(gradient, 0) / history["critical_gradient"])
    found.heave = mean(history["plug_heave_m"])
    if length := run.scene.get("skirt_length_m"):
        found.room = float(length) - at - found.heave
    boiling = history.get("cavitation_suction_Pa")
    boils = np.full(len(at), np.nan) if boiling is None else mean(boiling) / 1e3
    limits_of(run, found, boils)
    found.rest = rest_of_run(history)
    if run.scene.get("diameter_m") and "seepage_flow_m3_s" in history:
        found.seepage = HOUR * np.maximum(mean(history["seepage_flow_m3_s"]), 0)
        rise = np.gradient(found.heave, at) if len(at) > 1 else np.zeros(len(at))
        speed = rate.meters_per_hour * (1 + rise)
        found.flow = plug_area(run.scene) * speed + found.seepage
    return found


def in_range(value: float, bounds: tuple[np.ndarray, np.ndarray] | None, i: int) -> str:
    """Return a value with its bounds, where it has any."""
    if bounds is None or not np.isfinite([bounds[0][i], bounds[1][i]]).all():
        return text_of(value)
    low, high = text_of(float(bounds[0][i])), text_of(float(bounds[1][i]))
    return f"{text_of(value)} ({low} to {high})"


def table_of(found: Installation) -> dict[str, Any]:
    """Return the table of the installation: heads and rows of text."""
    n = range(len(found.depth))
    heads = ["depth (m)", "resistance (kN)"]
    total = found.forces["total_force_N"]
    columns = [
        [f"{depth:.2f}".rstrip("0").rstrip(".") for depth in found.depth],
        [in_range(total[i], found.force_bounds, i) for i in n],
    ]

    def add(head: str, values: np.ndarray) -> None:
        if len(values):
            heads.append(head)
            columns.append([text_of(float(value)) for value in values])

    for name in design.FORCES[:3]:
        words = name.removesuffix("_N").removesuffix("_force").replace("_", " ")
        add(f"{words} (kN)", found.forces[name])
    if found.has_suction:
        heads += ["required suction (kPa)", "allowable (kPa)", "governed by"]
        allowable = found.allowable
        columns += [
            [in_range(found.required[i], found.required_bounds, i) for i in n],
            [text_of(float(value)) for value in allowable],
            [found.governing(i) for i in n],
        ]
        add("required / allowable", found.required / allowable)
        add("exit gradient / critical", found.gradient)
        add("margin to piping (%)", 100 * (1 - found.gradient))
        add("plug heave (m)", found.heave)
        add("room below the lid (m)", found.room)
        add("pump flow (m³/h)", found.flow)
        if len(found.flow):
            power = found.flow / HOUR * found.required
            add("power of the water (kW)", power)
    return {"heads": heads, "rows": [list(row) for row in zip(*columns)]}


def cards_of(run: Results, found: Installation, rate: Rate) -> list[tuple[str, ...]]:
    """Return (name, value, remark) of what matters most."""
    end, depth = len(found.depth) - 1, float(found.depth[-1])
    at_end = f"at {depth:.2f} m"
    total = found.forces["total_force_N"]
    cards: list[tuple[str, ...]] = []
    if not found.has_suction:
        cards.append(
            ("Force at the end", f"{total[end]:.0f} kN", bar_in_words(total, found, end))
        )
        most = int(np.argmax(total))
        if most != end:
            remark = f"at {found.depth[most]:.2f} m"
            cards.append(("Largest force", f"{total[most]:.0f} kN", remark))
        return [*cards, ("Penetration reached", f"{depth:.2f} m", "")]
    cards.append(
        (
            "Required suction",
            f"{found.required[end]:.1f} kPa",
            suction_in_words(found, end),
        )
    )
    most = int(np.argmax(found.required))
    if found.required[most] > 1.02 * found.required[end]:
        remark = f"at {found.depth[most]:.2f} m"
        value = f"{found.required[most]:.1f} kPa"
        cards.append(("Largest required suction", value, remark))
    if found.rest is not None:
        weight = float(run.scene.get("submerged_weight_N") or 0) / 1e3
        remark = f"under {weight:.4g} kN in water" if weight else ""
        cards.append(("Self-weight penetration", f"{found.rest:.2f} m", remark))
    return cards + margin_cards(found) + pump_cards(found, rate, at_end)


def suction_in_words(found: Installation, i: int) -> str:
    """Return where, and how large the error bar of the required suction is."""
    place, bounds = f"at {found.depth[i]:.2f} m", found.required_bounds
    if bounds is None or not np.isfinite([bounds[0][i], bounds[1][i]]).all():
        return f"{place}; error bar not known for this scene"
    return f"{place}; error bar {bounds[0][i]:.1f} to {bounds[1][i]:.1f} kPa"


def bar_in_words(total: np.ndarray, found: Installation, i: int) -> str:
    """Return where, and how large the error bar of the force is."""
    place, bounds = f"at {found.depth[i]:.2f} m", found.force_bounds
    if bounds is None or not np.isfinite([bounds[0][i], bounds[1][i]]).all():
        return f"{place}; error bar not known for this scene"
    return f"{place}; error bar {bounds[0][i]:.0f} to {bounds[1][i]:.0f} kN"


def margin_cards(found: Installation) -> list[tuple[str, ...]]:
    """Return the cards of the margins."""
    worst = int(np.argmax(found.gradient))
    cards: list[tuple[str, ...]] = [
        (
            "Margin to piping",
            f"{100 * (1 - found.gradient[worst]):.0f} %",
            f"least, at {found.depth[worst]:.2f} m: exit gradient"
            f" {found.gradient[worst]:.2f} of the critical one",
        )
    ]
    ratio = np.nan_to_num(found.required / found.allowable)
    worst = int(np.argmax(ratio))
    if found.governing(worst):
        cards.append(
            (
                "Required / allowable",
                f"{ratio[worst]:.2f}",
                f"at {found.depth[worst]:.2f} m: {found.required[worst]:.1f} of"
                f" {found.allowable[worst]:.1f} kPa ({found.governing(worst)})",
            )
        )
    return cards


def pump_cards(
    found: Installation, rate: Rate, at_end: str
) -> list[tuple[str, ...]]:
    """Return the cards of plug, pump and boiling."""
    cards: list[tuple[str, ...]] = []
    if len(found.flow):
        most = int(np.argmax(found.flow))
        cards.append(
            (
                "Pump",
                f"{found.flow[most]:.3g} m³/h",
                f"at {rate.words}, of which seepage {found.seepage[most]:.2g} m³/h;"
                f" against {found.required.max():.1f} kPa",
            )
        )
    boiling = found.limits[BOILING][-1]
    if np.isfinite(boiling):
        pump = found.limits.get(PUMP)
        words = "no pump limit is set" if pump is None else f"pump: {pump[-1]:.4g} kPa"
        cards.append(("Water boils at", f"{boiling:.0f} kPa", f"{at_end}; {words}"))
    if len(found.room):
        value, remark = f"{found.room[-1]:.2f} m", f"{at_end}; heave of the plug"
        cards.append(
            ("Room below the lid", value, f"{remark} {found.heave[-1]:.2f} m")
        )
    return cards
