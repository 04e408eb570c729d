# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields on the material points about the caisson, mirrored on the axis."""
import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.figure import Figure

import plot_forces
from raster import raster, sizes
from read_vtu import read_points, read_rigid_cells, read_series

PENETRATIONS = [None, 2.5, 5.0, 6.5]  # frames of stress.png; None: the first
RIGID = "#8c8c8c"


class Frame:
    """The soil and the rigid body at one recorded time."""

    def __init__(self, time, files, grid_series, history):
        points = read_points(files)
        material = points.get("material")
        rigid = (np.zeros(len(points["position"]), bool) if material is None
                 else material < 0)
        self.soil = {name: values[~rigid] for name, values in points.items()}
        self.rigid = {name: values[rigid] for name, values in points.items()}
        self.cells = np.empty((0, 4, 2))
        if grid_series:
            nearest = min(grid_series, key=lambda entry: abs(entry[0] - time))
            self.cells = read_rigid_cells(nearest[1])
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
    position = first.soil["position"]
    surface = position[:, 1].max()
    body = np.concatenate([last.cells.reshape(-1, 2),
                           last.rigid["position"]])
    radius, bottom = position[:, 0].max(), position[:, 1].min()
    if "diameter_m" in scene or len(body):
        diameter = scene.get("diameter_m") or 2 * body[:, 0].max()
        depth = surface - body[:, 1].min() if len(body) else diameter
        radius = min(radius, diameter)
        bottom = max(bottom, surface - max(1.6 * depth, diameter))
    top = surface + 0.08 * (surface - bottom)
    return radius, bottom, top


def draw_body(axes, frame):
    """The rigid body: its cells, or where there are none its points."""
    cells = frame.cells
    if len(cells) == 0 and len(frame.rigid["position"]):
        half = sizes(frame.rigid)[:, np.newaxis, np.newaxis] / 2
        square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        cells = frame.rigid["position"][:, np.newaxis, :] + half * square
    for side in (1, -1):
        axes.add_collection(PolyCollection(
            cells * [side, 1], facecolors=RIGID, edgecolors=RIGID,
            linewidths=0.8, zorder=3))


def draw_mirrored(axes, frame, picture, extent, window, style):
    """A raster on both sides of the axis, and the body."""
    radius, bottom, top = window
    image = axes.imshow(picture, origin="lower", interpolation="nearest",
                        extent=extent, **style)
    draw_body(axes, frame)
    axes.axvline(0, color="0.4", linewidth=0.5, dashes=(8, 4, 2, 4))
    axes.set_xlim(-radius, radius)
    axes.set_ylim(bottom, top)
    if 3 * radius < top - bottom:  # no room for more labels
        axes.set_xticks([0, radius])
    axes.set_xlabel("r (m)")
    axes.set_title(frame.label, fontsize=10)
    return image


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
    height = min(4.4 * (window[2] - window[1]) / (2 * window[0]), 7)
    figure = Figure(figsize=(4.7 * columns + 1.2, (height + 0.4) * rows + 0.3),
                    constrained_layout=True)
    axes = figure.subplots(rows, columns, squeeze=False, sharex=True,
                           sharey=True)
    for panel in axes.flat[n:]:
        panel.set_visible(False)
    return figure, axes


def draw_stress(path, frames, window):
    """The vertical effective stress at each frame, on one colour scale."""
    rasters = [raster(frame.soil, -frame.soil["effective_stress_zz"] / 1e3,
                      window) for frame in frames]
    highest = np.nanpercentile([picture for picture, _ in rasters], 99.5)
    style = {"cmap": "turbo", "vmin": 0, "vmax": nice_above(highest)}
    figure, axes = panels(len(frames), window)
    for panel, frame, (picture, extent) in zip(axes.flat, frames, rasters):
        image = draw_mirrored(panel, frame, picture, extent, window, style)
        panel.label_outer()
    for panel in axes[:, 0]:
        panel.set_ylabel("z (m)")
    figure.colorbar(image, ax=axes, extend="max", shrink=0.7, pad=0.02,
                    label="vertical effective stress (kPa), "
                          "compression positive")
    figure.savefig(path, dpi=150)
    return path


def draw_tip(axes, frame, values, box, style):
    """A field as discs, one per material point, on a small part."""
    left, right, bottom, top = box
    position, size = frame.soil["position"], sizes(frame.soil)
    inside = ((position[:, 0] > left - size) & (position[:, 0] < right + size) &
              (position[:, 1] > bottom - size) & (position[:, 1] < top + size))
    diameter = 0.95 * size[inside]
    discs = EllipseCollection(diameter, diameter, np.zeros(len(diameter)),
                              units="x", offsets=position[inside],
                              transOffset=axes.transData, linewidths=0,
                              cmap=style["cmap"])
    discs.set_array(values[inside])
    visible = values[inside]
    discs.set_clim(0, nice_above(np.percentile(visible, 99.5))
                   if len(visible) else 1)
    axes.add_collection(discs)
    draw_body(axes, frame)
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_aspect("equal")
    axes.set_xlabel("r (m)")
    return discs


def tip_box(frame, window):
    """A square about the tip of the wall: (left, right, bottom, top)."""
    body = np.concatenate([frame.cells.reshape(-1, 2),
                           frame.rigid["position"]])
    if len(body) == 0:
        return None
    tip = body[np.argmin(body[:, 1])]
    side = 0.16 * window[0]
    return (max(tip[0] - side, 0), max(tip[0] - side, 0) + 2 * side,
            tip[1] - 1.1 * side, tip[1] + 0.9 * side)


def draw_displacement(path, frame, window):
    """Displacement of the soil, and displacement and plastic strain at the
    tip."""
    moved = np.linalg.norm(frame.soil["displacement"][:, :2], axis=1)
    box = tip_box(frame, window)
    fields = [("displacement (m)", moved, {"cmap": "viridis"})]
    if box and "plastic_strain" in frame.soil:
        fields.append(("plastic deviatoric strain (-)",
                       frame.soil["plastic_strain"], {"cmap": "magma_r"}))
    n = 1 + len(fields) if box else 1
    figure = Figure(figsize=(5.3 * n, 4.5), constrained_layout=True)
    axes = figure.subplots(1, n, squeeze=False)[0]
    picture, extent = raster(frame.soil, moved, window)
    style = {"cmap": "viridis", "vmin": 0,
             "vmax": nice_above(np.nanpercentile(picture, 99.5))}
    image = draw_mirrored(axes[0], frame, picture, extent, window, style)
    axes[0].set_ylabel("z (m)")
    figure.colorbar(image, ax=axes[0], extend="max", shrink=0.8,
                    label="displacement (m)")
    for panel, (label, values, style) in zip(axes[1:], fields):
        discs = draw_tip(panel, frame, values, box, style)
        panel.set_title("at the tip", fontsize=10)
        figure.colorbar(discs, ax=panel, extend="max", shrink=0.8, label=label)
    figure.savefig(path, dpi=150)
    return path


def draw(directory, history, scene):
    """Writes stress.png and displacement.png; returns their paths."""
    series = read_series(directory / "points.pvd")
    if not series:
        print(f"plot: {directory}/points.pvd names no file that is there")
        return []
    grids = read_series(directory / "grid.pvd")
    frames = [Frame(time, files, grids, history)
              for time, files in chosen(series, history)]
    window = window_of(frames[0], frames[-1], scene)
    pictures = []
    if all("effective_stress_zz" in frame.soil for frame in frames):
        pictures.append(draw_stress(directory / "stress.png", frames, window))
    if "displacement" in frames[-1].soil:
        pictures.append(draw_displacement(directory / "displacement.png",
                                          frames[-1], window))
    return pictures
