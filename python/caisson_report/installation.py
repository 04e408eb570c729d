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
from caisson.plot.suction import pump_limit, rest_of_run
from caisson.results import Results, Table
from caisson_design.reasons import text_of
from caisson_report.scene import plug_area

INTERVAL = 0.5  # m, between the depths of the table
HOUR = 3600.0
LEAST_SHARE = 0.02  # of the critical gradient, below which the gradient is noise
COMPUTED = "exit gradient computed"
PIPING, BOILING, PUMP = "piping, Houlsby & Byrne", "water boils", "pump"


class Rate(NamedTuple):
    """The rate of penetration that the pump is made for."""

    meters_per_hour: float = 1.0
    assumed: bool = True

    @property
    def words(self) -> str:
        """The rate in words."""
        mark = " (ASSUMED)" if self.assumed else ""
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


def critical_by_gradient(run: Results, at: np.ndarray) -> np.ndarray:
    """Return the suction (kPa) at which the exit gradient of the run becomes critical,
    at depths [n], nan before there is suction. The flow is linear in the suction."""
    history = run.history
    rows = curves.way_down(history["penetration_m"])
    depth, suction = history["penetration_m"][rows], history["suction_Pa"][rows]
    share = gradient_share(history)[rows]
    pulled = (suction > 0) & (share > LEAST_SHARE)
    if not pulled.any():
        return np.full(len(at), np.nan)
    found = suction[pulled] / share[pulled] / 1e3
    means = curves.smoothed_at(depth[pulled], found, at)
    return np.where(at >= depth[pulled][0], means, np.nan)


def gradient_share(history: Table) -> np.ndarray:
    """Return the larger exit gradient over the critical one, [n_rows]."""
    larger = np.maximum(history["exit_gradient_wall"], history["exit_gradient_axis"])
    return np.maximum(larger, 0) / history["critical_gradient"]


def limits_of(run: Results, at: np.ndarray, boiling: np.ndarray) -> dict[str, Any]:
    """Return the limits of the suction (kPa) at depths [n]."""
    limits = {COMPUTED: critical_by_gradient(run, at)}
    answers = suction_methods.answers_of(theory.site_of(run), at)
    if answers.suctions:
        limits[PIPING] = answers.suctions[suction_methods.PIPING] / 1e3
    limits[BOILING] = boiling
    pump = pump_limit(run)
    if pump is not None:
        limits[PUMP] = np.full(len(at), pump)
    return limits


def installation_of(run: Results, rate: Rate) -> Installation | None:
    """Return the installation; None for a run that does not go down."""
    history = run.history
    if penetration(history) is None or not design.goes_down(history):
        return None
    rows = curves.way_down(history["penetration_m"])
    if len(rows) < 3 or not set(design.FORCES) <= set(history):
        return None
    at = depths_of(history["penetration_m"][rows])
    forces = {k: v / 1e3 for k, v in design.forces_at(history, at).items()}
    found = Installation(at, forces)
    total = forces["total_force_N"] * 1e3
    bars = bounds_at(run, "total_force", "N", at, total)
    if bars:
        found.force_bounds = bars[0] / 1e3, bars[1] / 1e3
    if design.SUCTION in history:
        add_suction(found, run, rate)
    return found


def add_suction(found: Installation, run: Results, rate: Rate) -> None:
    """Add the columns of a run with suction."""
    history, scene, at = run.history, run.scene, found.depth
    rows = curves.way_down(history["penetration_m"])

    def mean(values: np.ndarray) -> np.ndarray:
        return curves.smoothed_at(history["penetration_m"][rows], values[rows], at)

    raw = mean(history[design.SUCTION])
    found.required = np.maximum(raw, 0) / 1e3
    bars = bounds_at(run, "required_suction", "Pa", at, raw)
    if bars:
        low, high = (np.maximum(bar, 0) / 1e3 for bar in bars)
        found.required_bounds = low, high
    found.gradient = mean(gradient_share(history))
    found.heave = mean(history["plug_heave_m"])
    if length := scene.get("skirt_length_m"):
        found.room = float(length) - at - found.heave
    boiling = history.get("cavitation_suction_Pa")
    boils = np.full(len(at), np.nan) if boiling is None else mean(boiling) / 1e3
    found.limits = limits_of(run, at, boils)
    found.rest = rest_of_run(history)
    if scene.get("diameter_m") and "seepage_flow_m3_s" in history:
        found.seepage = HOUR * np.maximum(mean(history["seepage_flow_m3_s"]), 0)
        rise = np.gradient(found.heave, at) if len(at) > 1 else np.zeros(len(at))
        speed = rate.meters_per_hour * (1 + rise)
        found.flow = plug_area(scene) * speed + found.seepage


def deepest_bar(bounds: tuple[np.ndarray, np.ndarray] | None) -> int | None:
    """Return the number of the deepest row with an error bar, None without any."""
    if bounds is None:
        return None
    known = np.flatnonzero(np.isfinite(bounds[0]) & np.isfinite(bounds[1]))
    return int(known[-1]) if len(known) else None


def bar_in_words(
    found: Installation, bounds: tuple[np.ndarray, np.ndarray] | None, unit: str
) -> str:
    """Return where the end is, and the deepest error bar that is known."""
    place, i = f"at {found.depth[-1]:.2f} m", deepest_bar(bounds)
    if bounds is None or i is None:
        return f"{place}; error bar not known for this scene"
    words = f"error bar {text_of(bounds[0][i])} to {text_of(bounds[1][i])} {unit}"
    if i < len(found.depth) - 1:
        words += f" at {found.depth[i]:g} m"
    return f"{place}; {words}"


def in_range(value: float, bounds: tuple[np.ndarray, np.ndarray] | None, i: int) -> str:
    """Return a value with its bounds, where it has any."""
    if bounds is None or not np.isfinite([bounds[0][i], bounds[1][i]]).all():
        return text_of(value)
    low, high = text_of(float(bounds[0][i])), text_of(float(bounds[1][i]))
    return f"{text_of(value)} ({low} to {high})"


def rows_of(columns: dict[str, list[str]]) -> dict[str, Any]:
    """Return heads and rows of columns that are not empty."""
    known = {head: texts for head, texts in columns.items() if texts}
    return {"heads": list(known), "rows": [list(row) for row in zip(*known.values())]}


def texts_of(values: np.ndarray) -> list[str]:
    """Return numbers as text."""
    return [text_of(float(value)) for value in values]


def tables_of(found: Installation) -> list[dict[str, Any]]:
    """Return the tables of the installation, each with heads and rows of text: what it
    takes and, with suction, what is allowed."""
    n = range(len(found.depth))
    depth = [f"{depth:.2f}".rstrip("0").rstrip(".") for depth in found.depth]
    total = found.forces["total_force_N"]
    takes = {
        "depth (m)": depth,
        "resistance (kN)": [in_range(total[i], found.force_bounds, i) for i in n],
    }
    for name in design.FORCES[:3]:
        words = name.removesuffix("_N").removesuffix("_force").replace("_", " ")
        takes[f"{words} (kN)"] = texts_of(found.forces[name])
    if not found.has_suction:
        return [rows_of(takes)]
    takes["required suction (kPa)"] = [
        in_range(found.required[i], found.required_bounds, i) for i in n
    ]
    takes["pump flow (m³/h)"] = texts_of(found.flow)
    if len(found.flow):
        takes["of which seepage (m³/h)"] = texts_of(found.seepage)
        power = found.flow / HOUR * found.required
        takes["power of the water (kW)"] = texts_of(power)
    allowable = found.allowable
    margins = {
        "depth (m)": depth,
        "required suction (kPa)": texts_of(found.required),
        "allowable (kPa)": texts_of(allowable),
        "governed by": [found.governing(i) for i in n],
        "required / allowable": texts_of(found.required / allowable),
        "exit gradient / critical": texts_of(found.gradient),
        "margin to piping (%)": texts_of(100 * (1 - found.gradient)),
        "plug heave (m)": texts_of(found.heave),
        "room below the lid (m)": texts_of(found.room),
    }
    return [rows_of(takes), rows_of(margins)]


def cards_of(run: Results, found: Installation, rate: Rate) -> list[tuple[str, ...]]:
    """Return (name, value, remark) of what matters most."""
    end, depth = len(found.depth) - 1, float(found.depth[-1])
    at_end = f"at {depth:.2f} m"
    total = found.forces["total_force_N"]
    cards: list[tuple[str, ...]] = []
    if not found.has_suction:
        cards.append(
            (
                "Force at the end",
                f"{total[end]:.0f} kN",
                bar_in_words(found, found.force_bounds, "kN"),
            )
        )
        most = int(np.argmax(total))
        if most != end:
            remark = f"at {found.depth[most]:.2f} m"
            cards.append(("Largest force", f"{total[most]:.0f} kN", remark))
        tip, inner, outer = (
            f"{found.forces[k][end]:.0f} kN" for k in design.FORCES[:3]
        )
        remark = f"friction inside {inner}, outside {outer}"
        cards.append(("Of which tip", tip, remark))
        return [*cards, ("Penetration reached", f"{depth:.2f} m", "")]
    cards.append(
        (
            "Required suction",
            f"{found.required[end]:.1f} kPa",
            bar_in_words(found, found.required_bounds, "kPa"),
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
                f"{ratio[worst]:.2f}" + (", exceeded" if ratio[worst] > 1 else ""),
                f"at {found.depth[worst]:.2f} m: {found.required[worst]:.1f} of"
                f" {found.allowable[worst]:.1f} kPa ({found.governing(worst)})",
            )
        )
    return cards


def pump_cards(found: Installation, rate: Rate, at_end: str) -> list[tuple[str, ...]]:
    """Return the cards of plug, pump and boiling."""
    cards: list[tuple[str, ...]] = []
    if len(found.flow):
        most = int(np.argmax(found.flow))
        cards.append(
            (
                "Pump",
                f"{found.flow[most]:.3g} m³/h",
                f"at a penetration of {rate.words}, of which seepage"
                f" {found.seepage[most]:.2g} m³/h; against"
                f" {found.required.max():.1f} kPa",
            )
        )
    boiling = found.limits[BOILING][-1]
    if np.isfinite(boiling):
        pump = found.limits.get(PUMP)
        words = "no pump limit is set" if pump is None else f"pump: {pump[-1]:.4g} kPa"
        cards.append(("Water boils at", f"{boiling:.0f} kPa", f"{at_end}; {words}"))
    if len(found.room):
        value, remark = f"{found.room[-1]:.2f} m", f"{at_end}; heave of the plug"
        cards.append(("Room below the lid", value, f"{remark} {found.heave[-1]:.2f} m"))
    return cards
