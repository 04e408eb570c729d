# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stresses along the walls at the frames, beside those at rest."""
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.plot import fields
from caisson.plot.fields import MOST_FRAMES, PAGE
from caisson.plot.small import in_units
from caisson.results import Results, Table
from caisson import disk
from caisson.shown import Units
from caisson.verdict import theory

# part of the name of a column: its label, empty where that depends on the soil, and
# what stands beside it
STRESSES = {
    "normal_stress": ("", "K₀ σ′ᵥ₀"),
    "shear_stress": ("shear stress, upward", "K₀ σ′ᵥ₀ tan δ"),
}
AT_FRAME = 0.05  # m, between a penetration and its frame
AT_REST: dict[str, Any] = {"color": "0.35", "linewidth": 1.4, "linestyle": "--"}


def shown_times(walls: Table, wanted: Sequence[float] = ()) -> np.ndarray:
    """Return the times to draw, MOST_FRAMES at most, the last among them: those at the
    penetrations that the scene asks for (m), as in the pictures of fields, or evenly.
    """
    times = np.unique(walls["time_s"])
    depths = [walls["penetration_m"][walls["time_s"] == time][0] for time in times]
    near = [int(np.argmin(np.abs(np.array(depths) - goal))) for goal in wanted]
    picks = {i for i, goal in zip(near, wanted) if abs(depths[i] - goal) < AT_FRAME}
    picks.add(len(times) - 1)
    if not 2 <= len(picks) <= MOST_FRAMES:
        evenly = np.linspace(0, len(times) - 1, min(MOST_FRAMES, len(times)))
        picks = set(np.round(evenly).astype(int))
    return times[sorted(picks)]


def draw_panel(
    axes: Axes,
    walls: Table,
    times: np.ndarray,
    column: str,
    beside: tuple[np.ndarray, str],
    shown: Units,
) -> None:
    """Draw a column over depth at times, and a multiple [n_rows] of the horizontal
    stress at rest with its label."""
    factor, label = beside
    for time, share in zip(times, np.linspace(0.85, 0, len(times))):
        rows = walls["time_s"] == time
        name = shown.depth(float(walls["penetration_m"][rows][0]))
        style = {"color": colormaps["viridis"](share), "label": name}
        axes.plot(walls[column][rows] / 1e3, walls["depth_m"][rows], **style)
    # the rows of the last time, which are the deepest in an installation
    stress = (factor * walls["horizontal_stress_at_rest_Pa"])[rows] / 1e3
    axes.plot(stress, walls["depth_m"][rows], label=label, **AT_REST)
    axes.grid(color="0.9")


def draw(path: Path, run: Results) -> Path | None:
    """Write the picture of the walls; return its path, None where there is no wall."""
    walls = run.walls
    names = [n for n in ("inner", "outer") if f"{n}_area_m2" in walls]
    if not names:
        return None
    times = shown_times(walls, run.scene.get("frame_penetrations_m") or ())
    figure = Figure(figsize=(PAGE, 4.8), layout="constrained")
    site = theory.site_of(run)
    axes = figure.subplots(2, len(names), squeeze=False, sharey=True, sharex="row")
    for row, (stress, (label, beside)) in zip(axes, STRESSES.items()):
        label = label or fields.stress_in_words(run.scene, "normal")
        for panel, name in zip(row, names):
            factor = np.ones(len(walls["depth_m"]))
            if stress == "shear_stress":
                angles = theory.wall_angles_at(site, name, walls["depth_m"])
                factor = np.tan(np.radians(angles))
            column = f"{name}_{stress}_Pa"
            draw_panel(panel, walls, times, column, (factor, beside), run.shown)
            panel.set_xlabel(f"{label} (kPa)")
            panel.set_title(f"{name} wall")
        row[0].set_ylabel("depth (m)")
        row[0].legend(title="penetration")
    axes[0, 0].invert_yaxis()  # that of all
    in_units(figure, run.shown)
    return disk.save(figure, path)
