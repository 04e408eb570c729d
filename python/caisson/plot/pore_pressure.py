# SPDX-License-Identifier: LGPL-2.1-or-later
"""Excess pore pressure with flow lines, beside the share of the stress at rest."""
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from caisson.plot import fields
from caisson.plot.flow import Flow
from caisson.results import Results, Table
from caisson import disk

N_LINES = 12
LEAST = 0.03  # of the largest pressure; flow lines of less are not drawn
LINE = {"color": "0.1", "linewidth": 0.9, "zorder": 2}


def style_of(low: float, high: float) -> fields.Style:
    """Return colors for pressures from low to high: blue below that of the open
    water, red above it, and white where both are the same."""
    most = max(-low, high)
    low = -fields.nice_above(-low) if -low > 0.02 * most else 0.0
    high = fields.nice_above(high) if high > 0.02 * most or low == 0 else 0.0
    shares = 0.5 + np.linspace(low, high, 256) / (2 * max(-low, high))
    colors = ListedColormap(colormaps["RdBu_r"](shares))
    return {"cmap": colors, "vmin": low, "vmax": high}


def title_of(frame: fields.Frame, history: Table) -> str:
    """Return where the frame is, and the suction there."""
    if "suction_Pa" not in history:
        return frame.label
    suction = float(np.interp(frame.time, history["time_s"], history["suction_Pa"]))
    words = f"suction {frame.shown.words(suction / 1e3, 'kPa', '.1f')}"
    return f"{frame.label}\n{', '.join(filter(None, (words, frame.mark)))}"


def level_of(frame: fields.Frame, window: fields.Window) -> float:
    """Return the height at which flow lines share the water: half the embedment."""
    surface = frame.means.polygons[..., 1].max()
    tip = frame.body[..., 1].min() if len(frame.body) else surface
    return min((surface + tip) / 2, surface - 0.05 * (surface - window[1]))


def draw_arrows(axes: Axes, line: np.ndarray, window: fields.Window) -> None:
    """Draw the direction of the flow on the part that is shown."""
    radius, bottom, _ = window
    shown = line[(line[:, 0] < radius) & (line[:, 1] > bottom)]
    along = np.cumsum(np.linalg.norm(np.diff(shown, axis=0), axis=1))
    if len(along) == 0 or along[-1] < 0.1 * radius:
        return
    for share in (0.4, 0.85):
        place = int(np.searchsorted(along, share * along[-1]))
        start, end = shown[[place, place + 1]] * [-1, 1]
        arrow = {"arrowstyle": "-|>", "mutation_scale": 8, **LINE}
        axes.annotate("", xy=end, xytext=start, arrowprops=arrow)


def draw_flow(
    axes: Axes, flow: Flow, frame: fields.Frame, window: fields.Window
) -> None:
    """Draw flow lines to the left of the axis."""
    starts = flow.starts(N_LINES, level_of(frame, window), window[0])
    for line in flow.lines(starts):
        axes.plot(-line[:, 0], line[:, 1], **LINE)
        draw_arrows(axes, line, window)


def caption(frames: Sequence[fields.Frame]) -> str:
    """Return what the lines mean."""
    level = "half the depth of the tip" if len(frames[-1].body) else "the mudline"
    return (
        f"Between two flow lines flows 1/{N_LINES} of the water that rises at"
        f" {level};\nthe permeability is taken to be the same in all directions."
    )


def is_flowing(
    flow: Flow, frame: fields.Frame, window: fields.Window, least: float
) -> bool:
    """Return whether water flows: not where the pressure is below the least (kPa), and
    not where clay beneath the plug lets so little through that the pressure in the
    plug is the same everywhere."""
    pressure = frame.soil[fields.PRESSURE]
    most = np.nanmax(np.abs(pressure), initial=0)
    level = level_of(frame, window)
    if most / 1e3 <= least or np.isfinite(pressure).all():
        return bool(most / 1e3 > least)
    starts = flow.starts(N_LINES, level, window[0])
    depth = frame.means.polygons[..., 1].max() - level
    rise = np.abs(flow.at(starts)[0][:, 1])
    return bool(rise.max(initial=0) > LEAST * most / depth)


def draw_water(
    axes: Axes,
    flow: Flow,
    frame: fields.Frame,
    window: fields.Window,
    flows: bool | None,
) -> None:
    """Draw flow lines where the water flows, or that it hardly does, and where the soil
    ends, with white above it; flows: None where no flow is computed."""
    if flows:
        draw_flow(axes, flow, frame, window)
    elif flows is not None:
        place = (-window[0] / 2, window[1] / 2)
        axes.text(*place, "hardly\nany flow", ha="center", fontsize=9)
    for r, z in (part.T for part in flow.mudline(frame.body)):
        for side in (-1, 1):
            axes.fill_between(side * r, z, window[2], facecolor="white", zorder=2.2)
            axes.plot(side * r, z, color="0.3", linewidth=0.8, zorder=2.3)


def draw(
    run: Results, frames: Sequence[fields.Frame], window: fields.Window
) -> Path | None:
    """Write pore_pressure.png; return its path, None where there is no pressure."""
    if any(fields.PRESSURE not in frame.soil for frame in frames):
        return None
    pressures = [frame.means.of(frame.soil[fields.PRESSURE] / 1e3) for frame in frames]
    shown = fields.shown_values(frames, pressures, window)
    if not len(shown):
        return None
    low, high = np.percentile(shown, [0.2, 99.8])
    if max(-low, high) < 1e-3:
        return None
    style = style_of(low, high)
    found = [Flow(frame.means, frame.soil[fields.PRESSURE]) for frame in frames]
    flows: list[bool | None] = [None] * len(frames)
    if "flow_iterations" in run.history and run.entry("Water/Level") != "undrained":
        least = LEAST * max(-style["vmin"], style["vmax"])
        flows = [is_flowing(*one, window, least) for one in zip(found, frames)]
    pressure = ("left halves: excess pore pressure (kPa)", pressures, style)
    label = "right halves: ratio to stress at rest (gray: none)"
    sides = [pressure, fields.ratio_of(label, frames)]
    figure, axes = fields.figure_of(frames, window, sides, 0.4 if any(flows) else 0.0)
    for panel, flow, frame, is_seen in zip(axes.flat, found, frames, flows):
        draw_water(panel, flow, frame, window, is_seen)
        panel.set_title(title_of(frame, run.history))
    if any(flows):
        figure.supxlabel(caption(frames), fontsize=9, color="0.3")
    path = run.directory / "pore_pressure.png"
    return disk.save(figure, path)
