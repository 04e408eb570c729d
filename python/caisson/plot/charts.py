# SPDX-License-Identifier: LGPL-2.1-or-later
"""The curves of a run as data, for the page and for pictures.

A curve has a label, a color, and x over depth y, None where it has no value. With "to"
it is a band between x and that and, with "bars", an error bar at some depths. Further
keys say how it looks: "thick" of the run itself, "full" the widest, "shade" a band
without edges; "far" does not widen the axis, "hidden" waits on the page for a click.
"""
import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from caisson import curves
from caisson.band import band_of
from caisson.results import Results
from caisson.table import NOTHING
from caisson.template import say
from caisson.verdict import design, suction_methods, theory
from caisson.verdict.installation import Installation
from caisson.verdict.limits import BOILING, LID, LIMITS
from caisson.verdict.outcome import feasible_to
from caisson.verdict.uncertainty import over_depth

CAPTIONS = Path(__file__).with_name("captions.jinja")
COLORS = {
    "total": "black",
    "tip": "#c0392b",
    "inner friction": "#2166ac",
    "outer friction": "#2e8b57",
}
RED, BLUE, GREEN = (COLORS[x] for x in ("tip", "inner friction", "outer friction"))
WITH_WATER, WATER_COLOR = "total with water", "#7b3294"
GRAY = "#aaaaaa"  # what is deeper than suction reaches
SHOWN = ("tip", "total")  # parts of the methods at first sight
LIGHT = {  # of Houlsby & Byrne
    "total": "#7f7f7f",
    "tip": "#e59a90",
    "inner friction": "#8fb4dc",
    "outer friction": "#93c4a6",
}
COLOR_OF = {suction_methods.HOULSBY_BYRNE: BLUE}
COLOR_OF |= {m.name: m.color for m in suction_methods.BY_CONE}
# column of design.csv: author and color of a critical suction; piping is a limit
CRITICAL = {
    suction_methods.PIPING: ("Houlsby & Byrne (2005)", "#b35806"),
    suction_methods.CRITICAL_SENDERS_RANDOLPH: ("Senders & Randolph (2009)", "#e08214"),
}
ALLOWABLE, WIDE_COLOR = "allowable, the least of the limits", "#f4b6b6"
LOW_TO_HIGH = "low to high resistance"
MANY = 1500  # points of a curve that a screen can show
OF_RANGE = 200  # points of the range between low and high resistance
BARS = 12  # over the depth of an error bar, in a picture

Curve = dict[str, Any]
Range = tuple[np.ndarray, np.ndarray, np.ndarray]  # depth (m), least, most: each [n]


def column_of(force: str) -> str:
    """Return the column of history.csv with a force."""
    is_long = force in ("total", "tip")
    return f"{force}_force_N" if is_long else f"{force.replace(' ', '_')}_N"


def window_of(depth: np.ndarray) -> float:
    """Return the width of the window of a running mean in m."""
    return curves.window_of(float(curves.path_of(depth)[-1]))


def smooth(depth: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Return the running mean of a force in kN."""
    return curves.running_mean(depth, force, window_of(depth)) / 1e3


# ------------------------------------------------------------- the schema


def thinned(depth: np.ndarray) -> np.ndarray:
    """Return the numbers of the rows that a curve shows."""
    return np.unique(np.linspace(0, len(depth) - 1, MANY).astype(int))


def listed(values: Iterable[float]) -> list[float | None]:
    """Return values for JSON, which has no nan."""
    return [float(f"{v:.6g}") if math.isfinite(v) else None for v in values]


def line(
    label: str, color: str, x: np.ndarray, depth: np.ndarray, **more: Any
) -> Curve:
    """Return a curve x over depth."""
    rows = thinned(depth)
    places = {"x": listed(x[rows]), "y": listed(depth[rows])}
    return {"label": label, "color": color, **places, **more}


def band(
    label: str, color: str, low: np.ndarray, high: np.ndarray, depth: np.ndarray
) -> Curve:
    """Return an area between two curves."""
    return line(label, color, low, depth, to=listed(high[thinned(depth)]))


def bars(
    run: Results,
    quantity: tuple[str, str],
    curve: tuple[str, str],
    end: float | None = None,
    scale: Callable[[np.ndarray], Any] = lambda _: 1e-3,
) -> list[Curve]:
    """Return the error bar of a quantity, by its name and unit, down to where suction
    ends (m), if the run has one; no suction is below 0. curve: label and color; scale:
    of the values at depths [n] (m)."""
    if (found := curves.error_band(run.error_bounds, *quantity)) is None:
        return []
    rows = found[0] <= (math.inf if end is None else end)
    least, depth = 0 if quantity[1] == "Pa" else -math.inf, found[0][rows]
    low, high = (np.maximum(x[rows], least) * scale(depth) for x in found[1:])
    label, color = curve
    return [band(f"{label}, error bar", color, low, high, depth) | {"bars": True}]


def own(
    label: str, color: str, x: np.ndarray, depth: np.ndarray, end: float | None
) -> list[Curve]:
    """Return a curve of the run, gray behind the depth where suction ends (m)."""
    if end is None or end >= depth.max():
        return [line(label, color, x, depth, thick=True)]
    rows = depth <= end
    behind = line(f"{label}, not feasible", GRAY, x[~rows], depth[~rows], far=True)
    return [line(label, color, x[rows], depth[rows], thick=True), behind]


def has_points(curve: Curve) -> bool:
    """Return whether a curve has a point to draw."""
    return any(x is not None for x in [*curve["x"], *curve.get("to", [])])


def axis_end(shown: list[Curve]) -> float:
    """Return where the axis of the suction ends (kPa), as in limits() of page.js."""

    def most(some: list[Curve]) -> float:
        ends = [[*curve["x"], *curve.get("to", [])] for curve in some]
        return max((x for end in ends for x in end if x is not None), default=0.0)

    seen = [c for c in shown if not c.get("hidden") and not c.get("far")]
    run = most([c for c in seen if c.get("thick") or c.get("shade")])
    full = most([c for c in seen if c.get("full")])
    wide = (2.0 if full else 1.5) * run
    return 1.03 * (max(min(most(seen), wide), full) if run > 0 else most(seen))


def draw(axes: Axes, shown: Iterable[Curve]) -> None:
    """Draw curves into a picture; the lower edge of a band is dashed, the upper one
    dotted."""
    for curve in filter(has_points, shown):
        x, to, y = (
            np.array(curve.get(k, curve["x"]), dtype=float) for k in ("x", "to", "y")
        )
        color, label = curve["color"], curve["label"]
        if color == GRAY:  # the area says what that is
            label = None
        if "to" not in curve:
            width = 6 if curve.get("full") else 1.8 if curve.get("thick") else 1.0
            style = {"linewidth": width, "solid_capstyle": "butt"}
            axes.plot(x, y, color=color, label=label, **style)
        elif curve.get("bars"):
            known = np.flatnonzero(np.isfinite(x + to))
            at = known[np.unique(np.linspace(0, len(known) - 1, BARS).astype(int))]
            middle, half = (x + to)[at] / 2, np.abs(to - x)[at] / 2
            style = {"fmt": "none", "ecolor": color, "elinewidth": 1.2, "capsize": 2.5}
            axes.errorbar(middle, y[at], xerr=half, label=label, **style)
        else:
            axes.fill_betweenx(y, x, to, color=color, alpha=0.16, lw=0, label=label)
            edges = {} if curve.get("shade") else {"--": x, ":": to}
            for dashes, edge in edges.items():
                axes.plot(edge, y, dashes, color=color, linewidth=0.8)


# ------------------------------------------------------- of low and high


def curve_of(run: Results, column: str, at: np.ndarray) -> np.ndarray:
    """Return the means of a column on the way down at depths [n] (m), nan where the run
    has not been, or is not feasible: [n]."""
    rows = curves.way_down(run.history["penetration_m"])[1:]
    depth = run.history["penetration_m"][rows]
    if len(depth) < 2 or column not in run.history:
        return np.full(len(at), np.nan)
    values = curves.smoothed_within(depth, run.history[column][rows], at)
    return np.where(at <= feasible_to(run), values, np.nan)


def range_of(run: Results, column: str) -> Range | None:
    """Return the range of a column (kN or kPa, and none below 0) among the estimates of
    a run, as deep as all of them go; None without any but the best one."""
    members = list(band_of(run).values())
    if len(members) < 2:
        return None
    depth = run.history["penetration_m"]
    at = np.linspace(float(depth.min()), float(depth.max()), OF_RANGE)
    values = np.array([curve_of(member, column, at) / 1e3 for member in members])
    known = np.isfinite(values).all(axis=0)
    if not known.any():
        return None
    values = np.maximum(values[:, known], 0)
    return at[known], values.min(axis=0), values.max(axis=0)


def range_curve(run: Results, column: str, name: str) -> list[Curve]:
    """Return the area between low and high resistance, within that of all parts of the
    uncertainty; nothing without a band."""
    found, whole = range_of(run, column), over_depth(band_of(run), column)
    if found is None:
        return []
    depth, low, high = found
    areas = [band(f"{name}, {LOW_TO_HIGH}", "black", low, high, depth)]
    if whole is not None:
        ends = whole.low / 1e3, whole.high / 1e3
        words = " and ".join(part.name for part in whole.parts)
        areas.insert(0, band(f"{name}, {words}", "black", *ends, whole.depth))
    return [area | {"shade": True} for area in areas]


# ---------------------------------------------------------------- forces


def has_suction(run: Results) -> bool:
    """Return whether a run has suction: its forces are not those of jacking, beside
    which methods stand."""
    return "required_suction_Pa" in run.history


def mark_of(run: Results) -> str:
    """Return what stands behind the name of a curve that no run has computed."""
    return ", best by hand" if run.by_hand else ""


def method_curves(run: Results, deepest: float) -> list[Curve]:
    """Return the ranges of the design methods (kN) over depth (m). Only tip and total
    by Houlsby & Byrne are shown at first; nothing where there is suction, as they are
    forces of jacking."""
    found: list[Curve] = []
    if has_suction(run) and not run.by_hand:
        return found
    for answer in theory.answers_to(theory.site_of(run), deepest):
        first = answer.method is theory.METHODS[0]
        for part in reversed(theory.PARTS if first else SHOWN) if answer.forces else ():
            low, high = [force / 1e3 for force in answer.band(part)]
            label = f"{part}, {answer.name}"
            color = LIGHT[part] if first else answer.method.color
            curve = band(label, color, low, high, answer.depth)
            found.append(curve | {"hidden": not first or part not in SHOWN})
            for bound in answer.method.bound if part == "total" else ():
                force = answer.forces[bound][part] / 1e3
                label = f"{part}, {theory.LOWER_BOUND}"
                found.append(line(label, color, force, answer.depth))
    return found


def force_curves(run: Results, end: float | None = None) -> list[Curve]:
    """Return the forces (kN) over depth (m) with their error bars and the range of
    Houlsby & Byrne. end: where suction ends (m)."""
    history, depth = run.history, run.history["penetration_m"]
    found = list[Curve]()
    for name, color in COLORS.items():
        quantity = column_of(name).removesuffix("_N"), "N"
        found += bars(run, quantity, (name, color), end)
    found += method_curves(run, max(depth.max(), 0))
    found += range_curve(run, column_of("total"), "total")
    for name, color in COLORS.items():
        if column_of(name) in history:
            column = history[column_of(name)]
            force = column / 1e3 if run.by_hand else smooth(depth, column)
            found += own(f"{name}{mark_of(run)}", color, force, depth, end)
    if (total := history.get(curves.WITH_WATER)) is not None:
        mean = smooth(depth, total)
        found.append(line(WITH_WATER, WATER_COLOR, mean, depth, thick=True))
    return found


# ----------------------------------------------------------------- suction


def method_suctions(answers: suction_methods.Answers) -> list[Curve]:
    """Return the required and the other critical suctions of the methods (kPa) over
    depth."""
    found, depth = list[Curve](), answers.depth
    for method in answers.required:
        name = method.name.removesuffix(theory.ASSUMED_CONE)
        color = COLOR_OF.get(name, GREEN)
        low, high = (end / 1e3 for end in method.band)
        found.append(band(f"required, {method.name}", color, low, high, depth))
        for bound in method.bounds.values():
            label = f"required, {theory.LOWER_BOUND}"
            found.append(line(label, color, bound / 1e3, depth))
    for column, (name, color) in CRITICAL.items():
        if column in answers.suctions and column != suction_methods.PIPING:
            critical, label = answers.suctions[column] / 1e3, f"critical, {name}"
            found.append(line(label, color, critical, depth, hidden=True))
    return found


def limit_curves(found: Installation, bottom: float) -> list[Curve]:
    """Return the limits of the suction, the least of them where suction is needed, and
    where the caisson rests; the depth of the lid where it is above a bottom (m)."""
    most, depth = float(found.required.max()), found.depth

    def across(label: str, color: str, place: float) -> Curve:
        ends = np.array([0.0, most])
        return line(label, color, ends, np.full(2, place), far=True)

    needed = found.required > NOTHING
    needed[:-1] |= needed[1:]
    allowable = np.where(needed, found.allowable, np.nan)
    shown = [line(ALLOWABLE, WIDE_COLOR, allowable, depth, full=True)]
    for name, values in found.limits.items():
        if name != LID:
            label, color = found.named(name), LIMITS[name].color
            shown.append(line(label, color, values, depth, far=name == BOILING))
    if found.lid is not None and found.lid <= bottom:
        label = f"{found.named(LID)} at {found.shown.depth(found.lid)}"
        shown.append(across(label, LIMITS[LID].color, found.lid))
    if found.rest is not None:
        label = f"rests by weight at {found.shown.depth(found.rest)}"
        shown.append(across(label, "#888888", found.rest))
    return shown


def suction_curves(
    run: Results,
    found: Installation | None,
    end: float | None = None,
    answers: suction_methods.Answers | None = None,
) -> list[Curve]:
    """Return the required suction (kPa) over depth (m), beside methods and limits. end:
    where suction ends (m); answers: of the methods, at the depths of design.csv."""
    history, depth = run.history, run.history["penetration_m"]
    shown = limit_curves(found, float(depth.max())) if found else []
    if answers is None:
        at = design.depths_of(history)
        answers = suction_methods.answers_of(theory.site_of(run), at)
    shown += method_suctions(answers)
    shown += range_curve(run, "required_suction_Pa", "required")
    shown += bars(run, ("required_suction", "Pa"), ("required", "black"), end)
    required = np.maximum(history["required_suction_Pa"], 0) / 1e3
    label = f"required{mark_of(run) or ', computed'}"
    return shown + own(label, "black", required, depth, end)


def limits_beyond(
    found: Installation | None, shown: list[Curve]
) -> dict[str, tuple[float, float]]:
    """Return the least and the largest value (kPa) of the limits that are beyond the
    axis of the curves, by their names."""
    end, beyond = axis_end(shown), dict[str, tuple[float, float]]()
    for name, values in found.limits.items() if found else ():
        known = values[np.isfinite(values)]
        if name != LID and len(known) and known.min() > end:
            assert found
            beyond[found.named(name)] = float(known.min()), float(known.max())
    return beyond


def beyond_the_chart(found: Installation, shown: list[Curve], bottom: float) -> str:
    """Return which limits are beyond the axis of the curves, or are none, and the depth
    of the lid where it is below a bottom (m), in sentences."""
    factor, limits = found.shown.factor("kPa"), limits_beyond(found, shown)
    beyond = [(name, (factor * a, factor * b)) for name, (a, b) in limits.items()]
    lid = found.lid if found.lid is not None and found.lid > bottom else None
    return say(CAPTIONS, "beyond", found, beyond, lid)
