# SPDX-License-Identifier: LGPL-2.1-or-later
"""The charts of a report, and what it says of the numbers in plain words."""
import math
from pathlib import Path
from typing import Any

import numpy as np

from caisson import curves
from caisson.evaluation import depths_of, is_pull
from caisson.plot import charts
from caisson.plot.charts import GRAY, Curve, line
from caisson.report.pull import PULL, pull_parts
from caisson.results import Results, Table
from caisson.shown import Units, units_for
from caisson.table import in_units
from caisson.template import say, say_rows
from caisson.verdict import outcome, run_review
from caisson.verdict.installation import Installation

SENTENCES = Path(__file__).with_name("page.jinja")
FIRST = 6  # curves of a chart at first sight; a click shows the others


def rank_of(curve: Curve) -> int:
    """Return the place of a curve among those that are seen first: of the run, the
    allowable suction, low to high, the error bar, bands of methods, and the rest."""
    marks = "thick", "full", "shade", "bars", "to"
    return next((i for i, mark in enumerate(marks) if curve.get(mark)), len(marks))


def with_points(every: list[Curve]) -> list[Curve]:
    """Return the curves that have a point to draw; hide all but the first ones, and
    what is behind the end of these."""
    found = list(filter(charts.has_points, every))
    seen = [c for c in found if not c.get("hidden") and c["color"] != GRAY]
    for curve in sorted(seen, key=rank_of)[FIRST:]:
        curve["hidden"] = True
    return found


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
        suctions = with_points(charts.suction_curves(run, found, end))
        bottom = float(run.history["penetration_m"].max())
        figures.append(
            {
                "id": "suction",
                "title": "Installation chart: required suction and its limits",
                "axis": "suction (kPa)",
                "note": charts.beyond_the_chart(found, suctions, bottom),
                "curves": suctions,
            }
        )
    figures.append(
        {
            "id": "forces",
            "title": "Forces on the caisson",
            "axis": "force (kN)",
            "note": "",
            "curves": with_points(charts.force_curves(run, end)),
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
    if curves.penetration(history) is None or not scene.get("wall_thickness_m"):
        return {}
    way = curves.main_way(history["penetration_m"])
    if len(way) < 2:
        return {}
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


def window_in(run: Results) -> float:
    """Return over how much penetration the numbers of a run are averaged (m)."""
    depth = run.history.get("penetration_m", np.zeros(1))
    way = depth[curves.main_way(depth)]
    return curves.window_of(float(np.ptp(way))) if len(way) else 0.0


def averaged(run: Results) -> str:
    """Return over how much penetration the numbers of the tables are averaged."""
    return say(SENTENCES, "averaged", run.shown, window_in(run))


def scatter_of(run: Results) -> float:
    """Return the scatter of the force about its mean down to where suction ends, nan
    where it is not known."""
    depth = curves.penetration(run.history)
    if depth is None or "total_force_N" not in run.history:
        return math.nan
    rows = depth <= outcome.feasible_to(run)
    found = curves.roughness(depth[rows], run.history["total_force_N"][rows])
    return abs(found) if math.isfinite(found) else math.nan


def remarks_on_numbers(run: Results) -> list[str]:
    """Return what energy, points and steps say of the run, in plain words."""
    if run.is_running:
        return []
    residual = (run.summary.get("energies") or {}).get("energy_residual")
    numbers = (
        None if residual is None else abs(residual),
        abs(run.history.get("plug_balance_error", np.zeros(1))[-1]),
        scatter_of(run),
        run.shown.words(window_in(run), "m", ".2g"),
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
