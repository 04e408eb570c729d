# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves of a report, and what it says of the numbers in plain words."""
import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from caisson import curves
from caisson.evaluation import depths_of
from caisson.band import band_of
from caisson.curves import error_band
from caisson.plot import forces
from caisson.verdict import design, run_review, suction_methods, theory
from caisson.plot.soil_range import LABEL, range_of
from caisson.verdict.limits import BOILING, LID, LIMITS
from caisson.plot.suction import ALLOWABLE, CRITICAL, WIDE_COLOR, color_of
from caisson.results import Results, Table
from caisson.table import NOTHING, in_units
from caisson.template import say, say_rows
from caisson.shown import Units, units_for
from caisson.verdict.installation import Installation
from caisson.verdict.uncertainty import over_depth
from caisson.evaluation import is_pull
from caisson.report.pull import PULL, pull_parts

SENTENCES = Path(__file__).with_name("page.jinja")
GRAY = "#aaaaaa"  # what is deeper than suction reaches
SHOWN = ("tip", "total")  # parts of the methods in the interactive picture
LIGHT = {  # of Houlsby & Byrne
    "total": "#7f7f7f",
    "tip": "#e59a90",
    "inner friction": "#8fb4dc",
    "outer friction": "#93c4a6",
}
CRITICAL_COLORS = ("#b35806", "#e08214", "#8c6d31", "#bd9e39")  # as CRITICAL
FIRST = 6  # curves of a chart at first sight; a click shows the others
MANY = 1500  # points of a curve that a screen can show

Curve = dict[str, Any]  # label, color, kind, x, y; see page.js


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
    return {
        "label": label,
        "color": color,
        "x": listed(x[rows]),
        "y": listed(depth[rows]),
        **more,
    }


def band(
    label: str, color: str, low: np.ndarray, high: np.ndarray, depth: np.ndarray
) -> Curve:
    """Return an area between two curves."""
    return line(label, color, low, depth, to=listed(high[thinned(depth)]))


def down_to(end: float | None, *columns: np.ndarray) -> list[np.ndarray]:
    """Return the rows of columns [n], the first of which is a depth, above an end."""
    rows = columns[0] <= (math.inf if end is None else end)
    return [column[rows] for column in columns]


def own(
    label: str, color: str, x: np.ndarray, depth: np.ndarray, end: float | None
) -> list[Curve]:
    """Return a curve of the run, gray behind the depth where suction ends (m)."""
    if end is None or end >= depth.max():
        return [line(label, color, x, depth, thick=True)]
    rows = depth <= end
    behind = line(f"{label}, not feasible", GRAY, x[~rows], depth[~rows], far=True)
    return [line(label, color, x[rows], depth[rows], thick=True), behind]


def mark_of(run: Results) -> str:
    """Return what stands behind the name of a curve that no run has computed."""
    return ", best by hand" if run.by_hand else ""


def method_curves(run: Results, deepest: float) -> list[Curve]:
    """Return the ranges of the design methods (kN) over depth (m). Only tip and total
    by Houlsby & Byrne are shown at first; nothing where there is suction, as they are
    forces of jacking."""
    found: list[Curve] = []
    if forces.has_suction(run) and not run.by_hand:
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


def range_curve(run: Results, column: str, name: str) -> list[Curve]:
    """Return the area between low and high resistance, within that of all parts of the
    uncertainty; nothing without a band."""
    found, whole = range_of(run, column), over_depth(band_of(run), column)
    if found is None:
        return []
    depth, low, high = found
    areas = [band(f"{name}, {LABEL}", "black", low, high, depth)]
    if whole is not None:
        ends = whole.low / 1e3, whole.high / 1e3
        words = " and ".join(part.name for part in whole.parts)
        areas.insert(0, band(f"{name}, {words}", "black", *ends, whole.depth))
    return [area | {"shade": True} for area in areas]


def force_curves(run: Results, end: float | None = None) -> list[Curve]:
    """Return the forces (kN) over depth (m) with their error bars and the range of
    Houlsby & Byrne."""
    history, depth = run.history, run.history["penetration_m"]
    found = []
    for name, color in forces.COLORS.items():
        bar = error_band(
            run.error_bounds, forces.column_of(name).removesuffix("_N"), "N"
        )
        if bar is not None:
            at, low, high = down_to(end, *bar)
            label = f"{name}, error bar"
            area = band(label, color, low / 1e3, high / 1e3, at)
            found.append(area | {"bars": True})
    found += method_curves(run, max(depth.max(), 0))
    found += range_curve(run, forces.column_of("total"), "total")
    for name, color in forces.COLORS.items():
        if forces.column_of(name) in history:
            column = history[forces.column_of(name)]
            force = column / 1e3 if run.by_hand else forces.smooth(depth, column)
            found += own(f"{name}{mark_of(run)}", color, force, depth, end)
    if (total := history.get(curves.WITH_WATER)) is not None:
        mean = forces.smooth(depth, total)
        found.append(
            line(forces.WITH_WATER, forces.WATER_COLOR, mean, depth, thick=True)
        )
    return found


def method_suctions(run: Results) -> list[Curve]:
    """Return the required and the other critical suctions of the methods (kPa) over
    depth."""
    site, depth = theory.site_of(run), design.depths_of(run.history)
    answers = suction_methods.answers_of(site, depth)
    found = []
    for method in answers.required:
        color = color_of(method.name)
        low, high = (end / 1e3 for end in method.band)
        found.append(band(f"required, {method.name}", color, low, high, depth))
        for bound in method.bounds.values():
            label = f"required, {theory.LOWER_BOUND}"
            found.append(line(label, color, bound / 1e3, depth))
    for color, (column, (name, _)) in zip(CRITICAL_COLORS, CRITICAL.items()):
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


def axis_end(shown: list[Curve]) -> float:
    """Return where the axis of the suction ends (kPa), as in limits() of page.js."""

    def most(curves_: list[Curve]) -> float:
        ends = [[*curve["x"], *curve.get("to", [])] for curve in curves_]
        return max((x for end in ends for x in end if x is not None), default=0.0)

    seen = [c for c in shown if not c.get("hidden") and not c.get("far")]
    own = most([c for c in seen if c.get("thick") or c.get("shade")])
    full = most([c for c in seen if c.get("full")])
    wide = (2.0 if full else 1.5) * own
    return 1.03 * (max(min(most(seen), wide), full) if own > 0 else most(seen))


def beyond_the_chart(found: Installation, shown: list[Curve], bottom: float) -> str:
    """Return which limits are beyond the axis of the curves, or are none, and the depth
    of the lid where it is below a bottom (m), in sentences."""
    beyond, end = [], axis_end(shown)
    for name, values in found.limits.items():
        known = found.shown.factor("kPa") * values[np.isfinite(values)]
        if name != LID and len(known) and known.min() > found.shown.factor("kPa") * end:
            beyond.append((found.named(name), (known.min(), known.max())))
    lid = found.lid if found.lid is not None and found.lid > bottom else None
    return say(SENTENCES, "beyond", found, beyond, lid)


def suction_curves(
    run: Results, found: Installation, end: float | None = None
) -> list[Curve]:
    """Return the required suction (kPa) over depth (m), beside methods and limits."""
    history, depth = run.history, run.history["penetration_m"]
    shown = [*limit_curves(found, float(depth.max())), *method_suctions(run)]
    shown += range_curve(run, "required_suction_Pa", "required")
    bar = error_band(run.error_bounds, "required_suction", "Pa")
    if bar is not None:
        at, *ends = down_to(end, *bar)
        low, high = (np.maximum(bound, 0) / 1e3 for bound in ends)
        area = band("required, error bar", "black", low, high, at)
        shown.append(area | {"bars": True})
    required = np.maximum(history["required_suction_Pa"], 0) / 1e3
    label = f"required{mark_of(run) or ', computed'}"
    return shown + own(label, "black", required, depth, end)


def rank_of(curve: Curve) -> int:
    """Return the place of a curve among those that are seen first: of the run, the
    allowable suction, low to high, the error bar, bands of methods, and the rest."""
    marks = "thick", "full", "shade", "bars", "to"
    return next((i for i, mark in enumerate(marks) if curve.get(mark)), len(marks))


def at_first_sight(found: list[Curve]) -> list[Curve]:
    """Hide all curves but the first ones, and what is behind the end of these."""
    seen = [c for c in found if not c.get("hidden") and c["color"] != GRAY]
    for curve in sorted(seen, key=rank_of)[FIRST:]:
        curve["hidden"] = True
    return found


def with_points(found: list[Curve]) -> list[Curve]:
    """Return the curves that have a point to draw."""
    return at_first_sight(
        [
            curve
            for curve in found
            if any(x is not None for x in [*curve["x"], *curve.get("to", [])])
        ]
    )


def figure_in_units(figure: dict[str, Any], shown: Units) -> dict[str, Any]:
    """Return an interactive figure in the units of a run; that of its depths is its
    key depth, and a rise is in mm anyway."""
    is_pull = bool(figure.get("upward"))
    across = shown.factor_of(figure["axis"])
    down = 1.0 if is_pull else shown.factor("m")

    def scaled(values: list[float | None], factor: float) -> list[float | None]:
        return [None if x is None else factor * x for x in values]

    factors = {"x": across, "to": across, "y": down}
    found = [
        curve | {k: scaled(curve[k], f) for k, f in factors.items() if k in curve}
        for curve in figure["curves"]
    ]
    axis, depth = shown.named(figure["axis"]), "mm" if is_pull else shown.name("m")
    return figure | {"axis": axis, "depth": depth, "curves": found}


def pull_figure(run: Results) -> dict[str, Any]:
    """Return the interactive figure of a pull: its parts (kN) over the rise (mm)."""
    rise, parts = pull_parts(run)
    shown = [
        line(name, color, force, rise, thick=name == PULL)
        for name, (color, force) in parts.items()
    ]
    return {
        "id": "pull",
        "title": "Pull, and what bears it, over the rise",
        "axis": "force (kN)",
        "upward": True,  # the other axis, which is in mm
        "note": "What soil and water bear, without the weight. The curve begins"
        f" where the caisson is pulled, {rise[0]:.3g} mm above its deepest place.",
        "curves": with_points(shown),
    }


def figures_of(
    run: Results, found: Installation | None, end: float | None = None
) -> list[dict[str, Any]]:
    """Return the interactive figures: id, title, axis, note and curves that have
    points; the suction, where there is any, before the forces. end: the depth where
    suction ends (m)."""
    if curves.penetration(run.history) is None:
        return []
    if is_pull(run):
        return [figure_in_units(pull_figure(run), run.shown)]
    figures = []
    if found is not None and found.has_suction:
        suctions = with_points(suction_curves(run, found, end))
        bottom = float(run.history["penetration_m"].max())
        figures.append(
            {
                "id": "suction",
                "title": "Installation chart: required suction and its limits",
                "axis": "suction (kPa)",
                "note": beyond_the_chart(found, suctions, bottom),
                "curves": suctions,
            }
        )
    figures.append(
        {
            "id": "forces",
            "title": "Forces on the caisson",
            "axis": "force (kN)",
            "note": "",
            "curves": with_points(force_curves(run, end)),
        }
    )
    place = None if end is None else run.shown.factor("m") * end
    return [figure_in_units(figure, run.shown) | {"end": place} for figure in figures]


def unit_table(run: Results, end: float | None = None) -> dict[str, Any]:
    """Return the unit resistances at each half meter: heads and rows of text.

    They are those of the way down, or of the way up where there is none. Friction is
    over the wall below the mudline of the start, the tip force over the area of the
    flat tip.
    """
    history, scene = run.history, run.scene
    nothing: dict[str, Any] = {"heads": [], "rows": []}
    if curves.penetration(history) is None or not scene.get("wall_thickness_m"):
        return nothing
    way = curves.main_way(history["penetration_m"])
    if len(way) < 2:
        return nothing
    depth = history["penetration_m"][way]
    at = curves.down_to(end, depths_of(depth))
    at = at[at > 0]

    def mean(column: str) -> np.ndarray:
        return curves.smoothed_at(depth, history[column][way], at)

    outer, wall = float(scene["diameter_m"]), float(scene["wall_thickness_m"])
    inner = outer - 2 * wall
    tip_area = math.pi / 4 * (outer**2 - inner**2)
    tip = mean("tip_force_N") / 1e3 / tip_area
    columns = {"tip depth (m)": at, "tip (kPa)": tip}
    for side, width in (("inner", inner), ("outer", outer)):
        friction = mean(f"{side}_friction_N") / 1e3
        columns[f"mean {side} friction over the embedded wall (kPa)"] = friction / (
            math.pi * width * at
        )
    stress = 1e3 * max(float(np.abs(x).max()) for x in list(columns.values())[1:])
    of_length = run.shown.smaller & {"m"}
    shown = Units(units_for(np.inf, stress, np.inf).smaller | of_length)
    return in_units(columns, shown)


def averaged(run: Results) -> str:
    """Return over how much penetration the numbers of the tables are averaged."""
    depth = run.history.get("penetration_m", np.zeros(1))
    way = depth[curves.main_way(depth)]
    window = curves.window_of(float(np.ptp(way))) if len(way) else 0.0
    return say(SENTENCES, "averaged", run.shown, window)


def scatter_of(history: Table) -> float:
    """Return the scatter of the force about its mean, nan where it is not known."""
    depth = curves.penetration(history)
    if depth is None or "total_force_N" not in history:
        return math.nan
    if (depth >= curves.FROM).sum() <= 10:
        return math.nan
    found = curves.roughness(depth, history["total_force_N"])
    return found if math.isfinite(found) else math.nan


def remarks_on_numbers(run: Results) -> list[str]:
    """Return what energy, points and steps say of the run, in plain words."""
    if run.is_running:
        return []
    residual = (run.summary.get("energies") or {}).get("energy_residual")
    numbers = (
        None if residual is None else abs(residual),
        abs(run.history.get("plug_balance_error", np.zeros(1))[-1]),
        scatter_of(run.history),
        curves.FORCE_WINDOW,
        run_review.kinetic_share_of(run),
        run.summary.get("max_points_in_body", 0),
    )
    return [words for _, words in say_rows(SENTENCES, "remarks", *numbers)]


def csv_of(history: Table) -> str:
    """Return history.csv as it is, for the download."""
    names = list(history)
    rows = zip(*(history[name].tolist() for name in names))
    lines = [",".join(names), *(",".join(f"{v:.10g}" for v in row) for row in rows)]
    return "\n".join(lines) + "\n"
