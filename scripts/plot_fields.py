# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields in the soil about the caisson, mirrored on the axis."""
import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.figure import Figure

import plot_forces
from cell_means import CellMeans
from read_vtu import read_cells, read_points, read_series

PENETRATIONS = [None, 2.5, 5.0, 6.5]  # frames of stress.png; None: the first
RIGID = "#8c8c8c"


class Frame:
    """The soil and the rigid body at one recorded time."""

    def __init__(self, time, files, grid_series, history):
        points = read_points(files)
        material = points.get("material", np.zeros(len(points["position"])))
        self.soil = {name: values[material >= 0]
                     for name, values in points.items()}
        nearest = min(grid_series, key=lambda entry: abs(entry[0] - time))
        corners, material = read_cells(nearest[1])
        self.body = corners[material == 1]
        self.means = CellMeans(self.soil["position"], self.soil["volume"],
                               corners, material == 1)
        self.label = f"t = {time:.3g} s"
        if plot_forces.penetration(history) is not None:
            self.label = f"penetration {depth_at(time, history):.2f} m"


def depth_at(time, history):
    return np.interp(time, history["time_s"], history["penetration_m"])


def chosen(series, history):
    """Four frames at the given penetrations, or evenly over a shorter run."""
    if plot_forces.penetration(history) is not None:
        depths = np.array([depth_at(time, history) for time, _ in series])
        wanted = [depths[0] if x is None else x for x in PENETRATIONS]
        if depths.max() > wanted[-1] - 0.3 and depths[0] < wanted[1] - 0.3:
            picks = [int(np.argmin(np.abs(depths - x))) for x in wanted]
            return [series[i] for i in sorted(set(picks))]
    picks = np.linspace(0, len(series) - 1, min(4, len(series)))
    return [series[int(round(i))] for i in picks]


def window_of(first, last, scene):
    """(radius, bottom, top) of the picture about the caisson."""
    cells = np.concatenate([first.means.polygons, last.means.polygons])
    radius, bottom = cells[..., 0].max(), cells[..., 1].min()
    surface = cells[..., 1].max()
    if len(last.body):
        diameter = scene.get("diameter_m") or 2 * last.body[..., 0].max()
        depth = surface - last.body[..., 1].min()
        radius = min(radius, diameter)
        bottom = max(bottom, surface - max(1.6 * depth, diameter))
    top = surface + 0.08 * (surface - bottom)
    return radius, bottom, top


def inside(frame, window):
    """Which painted cells lie at least partly in the window."""
    radius, bottom, top = window
    lower, upper = [f(frame.means.polygons, axis=1) for f in (np.min, np.max)]
    return ((lower[:, 0] < radius) & (upper[:, 1] > bottom) &
            (lower[:, 1] < top))


def paint_cells(axes, polygons, values, style, sides=(1, -1)):
    """Cells in the colour of their values, on both sides of the axis."""
    painted = PolyCollection(
        np.concatenate([polygons * [side, 1] for side in sides]),
        array=np.tile(values, len(sides)), cmap=style["cmap"],
        edgecolors="face", linewidths=0.4)
    painted.set_clim(style["vmin"], style["vmax"])
    axes.add_collection(painted)
    return painted


def draw_body(axes, frame):
    """The rigid body, exactly: its cells."""
    for side in (1, -1):
        axes.add_collection(PolyCollection(
            frame.body * [side, 1], facecolors=RIGID, edgecolors=RIGID,
            linewidths=0.5, zorder=3))


def draw_mirrored(axes, frame, values, window, style):
    """Cell means on both sides of the axis, and the body."""
    radius, bottom, top = window
    painted = paint_cells(axes, frame.means.polygons, values, style)
    draw_body(axes, frame)
    axes.axvline(0, color="0.4", linewidth=0.5, dashes=(8, 4, 2, 4))
    axes.set_aspect("equal")
    axes.set_xlim(-radius, radius)
    axes.set_ylim(bottom, top)
    if 3 * radius < top - bottom:  # no room for more labels
        axes.set_xticks([0, radius])
    axes.set_xlabel("r (m)")
    axes.set_title(frame.label, fontsize=10)
    return painted


def nice_above(value):
    """The least of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is
    not below the value."""
    if not np.isfinite(value) or value <= 0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    steps = [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10]
    return next(s * power for s in steps if s * power >= value * (1 - 1e-9))


def panels(n, window):
    """A figure of n panels with the shape of the window, in pairs."""
    columns = min(n, 2)
    rows = -(-n // columns)
    height = 4.4 * (window[2] - window[1]) / (2 * window[0])
    height = min(max(height, 2.6 / rows), 7)
    figure = Figure(figsize=(4.7 * columns + 1.2, (height + 0.4) * rows + 0.3),
                    constrained_layout=True)
    axes = figure.subplots(rows, columns, squeeze=False, sharex=True,
                           sharey=True)
    for panel in axes.flat[n:]:
        panel.set_visible(False)
    return figure, axes


def draw_frames(path, frames, window, fields, style, label):
    """Cell means [frame][cell] of a field, on one colour scale."""
    figure, axes = panels(len(frames), window)
    for panel, frame, field in zip(axes.flat, frames, fields):
        painted = draw_mirrored(panel, frame, field, window, style)
        panel.label_outer()
    for panel in axes[:, 0]:
        panel.set_ylabel("z (m)")
    figure.colorbar(painted, ax=axes, extend="both" if style["vmin"] else
                    "max", shrink=0.7, pad=0.02, label=label)
    figure.savefig(path, dpi=150)
    return path


def shown_values(frames, fields, window):
    """The values of all cells in the window."""
    return np.concatenate([field[inside(frame, window)]
                           for frame, field in zip(frames, fields)])


def draw_stress(path, frames, window):
    """The vertical effective stress at each frame."""
    fields = [frame.means.of(-frame.soil["effective_stress_zz"] / 1e3)
              for frame in frames]
    highest = np.percentile(shown_values(frames, fields, window), 99)
    style = {"cmap": "turbo", "vmin": 0, "vmax": nice_above(highest)}
    return draw_frames(path, frames, window, fields, style,
                       "vertical effective stress (kPa),\n"
                       "compression positive, mean of each cell")


def draw_void_ratio(path, frames, window):
    """The void ratio at each frame; None where it hardly changes."""
    if "void_ratio" not in frames[0].soil:
        return None
    fields = [frame.means.of(frame.soil["void_ratio"]) for frame in frames]
    low, high = np.percentile(shown_values(frames, fields, window), [1, 99])
    if high - low < 0.05:
        return None
    style = {"cmap": "viridis", "vmin": low, "vmax": high}
    return draw_frames(path, frames, window, fields, style,
                       "void ratio (-), mean of each cell")


def draw_tip(axes, frame, values, box, style):
    """A field on a small part: a disc of its own area for every material
    point, on the means of the cells."""
    left, right, bottom, top = box
    position, size = frame.soil["position"], np.sqrt(frame.means.area)
    shown = ((position[:, 0] > left - size) & (position[:, 0] < right + size) &
             (position[:, 1] > bottom - size) & (position[:, 1] < top + size))
    style = dict(style, vmin=0, vmax=nice_above(
        np.percentile(values[shown], 99.5)) if shown.any() else 1)
    paint_cells(axes, frame.means.polygons, frame.means.of(values), style, [1])
    discs = EllipseCollection(size[shown], size[shown], np.zeros(shown.sum()),
                              units="x", offsets=position[shown],
                              transOffset=axes.transData, linewidths=0,
                              cmap=style["cmap"])
    discs.set_array(values[shown])
    discs.set_clim(style["vmin"], style["vmax"])
    axes.add_collection(discs)
    draw_body(axes, frame)
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_aspect("equal")
    axes.set_xlabel("r (m)")
    axes.set_title("at the tip", fontsize=10)
    return discs


def tip_box(frame, window, scene):
    """A square about the tip: (left, right, bottom, top); None: no body."""
    if len(frame.body) == 0:
        return None
    corners = frame.body.reshape(-1, 2)
    tip = corners[np.argmin(corners[:, 1])]
    side = min(0.16 * window[0],
               5 * scene.get("wall_thickness_m", window[0]))
    left = max(tip[0] - side, 0)
    return left, left + 2 * side, tip[1] - 1.1 * side, tip[1] + 0.9 * side


def draw_displacement(path, frame, window, scene):
    """Displacement of the soil, and displacement and plastic strain at the
    tip."""
    moved = np.linalg.norm(frame.soil["displacement"][:, :2], axis=1)
    box = tip_box(frame, window, scene)
    fields = []
    if box:
        fields.append(("displacement (m)", moved, {"cmap": "viridis"}))
    if box and "plastic_strain" in frame.soil:
        fields.append(("plastic deviatoric strain (-)",
                       frame.soil["plastic_strain"], {"cmap": "magma_r"}))
    n = 1 + len(fields)
    figure = Figure(figsize=(5.3 * n, 4.5), constrained_layout=True)
    axes = figure.subplots(1, n, squeeze=False)[0]
    means = frame.means.of(moved)
    style = {"cmap": "viridis", "vmin": 0, "vmax": nice_above(
        np.percentile(means[inside(frame, window)], 99))}
    painted = draw_mirrored(axes[0], frame, means, window, style)
    axes[0].set_ylabel("z (m)")
    figure.colorbar(painted, ax=axes[0], extend="max", shrink=0.8,
                    label="displacement (m), mean of each cell")
    for panel, (label, values, style) in zip(axes[1:], fields):
        discs = draw_tip(panel, frame, values, box, style)
        figure.colorbar(discs, ax=panel, extend="max", shrink=0.8, label=label)
    figure.savefig(path, dpi=150)
    return path


def draw(directory, history, scene):
    """Writes stress.png, displacement.png and, where volume changes,
    void_ratio.png; returns their paths, None for none."""
    series = read_series(directory / "points.pvd")
    grids = read_series(directory / "grid.pvd")
    if not series or not grids:
        print(f"plot: points.pvd or grid.pvd of {directory} names no file that "
              "is there, so forces only")
        return []
    frames = [Frame(time, files, grids, history)
              for time, files in chosen(series, history)]
    window = window_of(frames[0], frames[-1], scene)
    return [draw_stress(directory / "stress.png", frames, window),
            draw_displacement(directory / "displacement.png", frames[-1],
                              window, scene),
            draw_void_ratio(directory / "void_ratio.png", frames, window)]
