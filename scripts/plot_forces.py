# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces on the caisson against its penetration, depth downward."""
import numpy as np
from matplotlib.figure import Figure

from houlsby_byrne import Caisson

WINDOW = 0.2  # running mean, m of penetration
FORCES = [  # column, label, colour
    ("total_force_N", "total", "black"),
    ("tip_force_N", "tip", "#c0392b"),
    ("inner_friction_N", "inner friction", "#2166ac"),
    ("outer_friction_N", "outer friction", "#2e8b57")]
SCENE = ["diameter_m", "wall_thickness_m", "submerged_unit_weight_N_m3",
         "friction_angle_deg", "wall_friction_angle_deg", "K0"]


def penetration(history):
    """The penetration of each row, or None where it does not change."""
    depth = history.get("penetration_m")
    if depth is None or not np.all(np.isfinite(depth)) or np.ptp(depth) < 1e-9:
        return None
    return depth


def running_mean(position, values, window):
    """The mean over half a window of travelled path to either side, nan where
    that is not there; the window is at most a quarter of the path."""
    path = np.concatenate([[0], np.cumsum(np.abs(np.diff(position)))])
    finite = np.isfinite(values)
    sums = np.concatenate([[0], np.cumsum(np.where(finite, values, 0))])
    counts = np.concatenate([[0], np.cumsum(finite)])
    half = min(window, path[-1] / 4) / 2
    first = np.searchsorted(path, path - half - 1e-12, "left")
    last = np.searchsorted(path, path + half + 1e-12, "right")
    count = counts[last] - counts[first]
    count[(path < half) | (path > path[-1] - half)] = 0
    return np.where(count > 0, (sums[last] - sums[first]) /
                    np.maximum(count, 1), np.nan)


def draw_curve(axes, position, force, label, colour):
    """A thin raw line and its running mean, in kN."""
    axes.plot(force / 1e3, position, color=colour, linewidth=0.5, alpha=0.35)
    axes.plot(running_mean(position, force, WINDOW) / 1e3, position,
              color=colour, linewidth=1.8, label=label)


def draw_bands(axes, scene, depth, friction_only):
    """The range between plain and enhanced stress of Houlsby and Byrne."""
    if any(scene.get(name) is None for name in SCENE):
        return
    caisson = Caisson(*[float(scene[name]) for name in SCENE])
    h = np.linspace(0, max(depth.max(), 0), 100)
    bands = [("inner friction", caisson.inner_friction, "#2166ac"),
             ("outer friction", caisson.outer_friction, "#2e8b57")]
    if not friction_only:
        bands = [("tip", caisson.tip, "#c0392b")]
    for label, force, colour in bands:
        plain, enhanced = [np.array([force(x, e) for x in h]) / 1e3
                           for e in (False, True)]
        axes.fill_betweenx(h, plain, enhanced, color=colour, alpha=0.15,
                           linewidth=0,
                           label=f"{label}, Houlsby & Byrne (2005)")
        axes.plot(plain, h, color=colour, linewidth=0.8, linestyle="--")
        axes.plot(enhanced, h, color=colour, linewidth=0.8, linestyle=":")


def draw_error_bars(axes, bounds):
    """The bounds of total and tip force from history_error.csv."""
    for column, label, colour in FORCES:
        low, high = [column.replace("_N", f"_{side}_N")
                     for side in ("low", "high")]
        if low in bounds:
            depth = bounds["penetration_m"]
            axes.fill_betweenx(
                depth, *[running_mean(depth, bounds[c], WINDOW) / 1e3
                         for c in (low, high)],
                color=colour, alpha=0.3, linewidth=0,
                label=f"{label}, error bar")


def limits(axes, curves):
    """Force limits from the running means, so that no spike hides them."""
    values = np.concatenate([c for c in curves] + [np.zeros(1)])
    for line in axes.lines:
        if line.get_linestyle() in ("--", ":"):
            values = np.append(values, line.get_xdata())
    values = values[np.isfinite(values)]
    span = max(np.ptp(values), 1e-3)
    axes.set_xlim(values.min() - 0.02 * span, values.max() + 0.08 * span)


def draw_panel(axes, history, scene, bounds, friction_only):
    """One panel over the penetration; all forces, or those of the walls."""
    depth = penetration(history)
    means = []
    for column, label, colour in FORCES:
        if column in history and ("friction" in column or not friction_only):
            draw_curve(axes, depth, history[column], label, colour)
            means.append(running_mean(depth, history[column], WINDOW) / 1e3)
    draw_bands(axes, scene, depth, friction_only)
    if not friction_only:
        draw_error_bars(axes, bounds)
    limits(axes, means)
    axes.set_ylim(1.02 * max(depth.max(), 0), min(depth.min(), 0))
    axes.xaxis.set_label_position("top")
    axes.xaxis.tick_top()
    axes.set_xlabel("wall friction (kN)" if friction_only else "force (kN)")
    axes.set_ylabel("penetration of the skirt tip (m)")
    axes.legend(fontsize=8, framealpha=0.9, loc="upper right")


def draw_over_time(axes, history):
    """Where nothing penetrates: what forces there are, against time."""
    for column, label, colour in FORCES:
        if column in history:
            axes.plot(history["time_s"], history[column] / 1e3, color=colour,
                      label=label)
    axes.set_xlabel("time (s)")
    axes.set_ylabel("force (kN)")
    axes.legend(fontsize=8)


def caption(scene):
    """What the lines mean."""
    text = f"thin: raw, thick: mean over {WINDOW} m"
    if all(scene.get(name) is not None for name in SCENE):
        text += (";  band: Houlsby & Byrne (2005), dashed without, dotted with "
                 "stress enhancement (m = 1.5)")
    return text


def draw(path, history, scene, bounds):
    """Writes the picture; returns its path, or None without any force. The
    bounds are those of history_error.csv, or empty."""
    if not any(column in history for column, _, _ in FORCES):
        print("plot: no forces in history.csv, so no forces.png")
        return None
    moving = penetration(history) is not None
    figure = Figure(figsize=(11 if moving else 7, 6.5 if moving else 4))
    axes = figure.subplots(1, 2 if moving else 1, squeeze=False)[0]
    for panel in axes:
        panel.grid(color="0.9")
        panel.set_axisbelow(True)
    if moving:
        draw_panel(axes[0], history, scene, bounds, friction_only=False)
        draw_panel(axes[1], history, scene, bounds, friction_only=True)
        figure.text(0.5, 0.012, caption(scene), ha="center", fontsize=8,
                    color="0.3")
    else:
        draw_over_time(axes[0], history)
    figure.tight_layout(rect=(0, 0.03 if moving else 0, 1, 1))
    figure.savefig(path, dpi=150)
    return path
