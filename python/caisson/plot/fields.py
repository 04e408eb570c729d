# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields in the soil about the caisson, mirrored on the axis."""
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, PolyCollection, TriMesh
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.tri import Triangulation

from caisson.verdict.outcome import depth_of
from caisson.plot.cells import CellMeans
from caisson.plot.small import in_units
from caisson.results import Results, ResultsError
from caisson import curves, disk
from caisson import frame as recorded

Window = tuple[float, float, float]  # radius, bottom, top (m)
Box = tuple[float, float, float, float]  # left, right, bottom, top (m)
Style = dict[str, Any]
Sides = tuple[int, ...]  # of the axis: -1 left, 1 right
Field = tuple[str, Sequence[np.ndarray], Style]  # label, means [frame][cell], colors

MOST_FRAMES = 3  # of a picture
PAGE = 7.2  # inches, the width of a picture: that of a page, so that 9 pt are 9 pt
SLENDEREST = 0.3  # width over height of a picture on one side of the axis, at least
RIGID, NO_VALUE = "#8c8c8c", "0.88"
CLOSEST, CLOSE = 6, 1.0  # points that show a boundary, and how close one must be (m)
NEEDED = {"whole_volume_m3", "stress_Pa", "displacement_m"}  # of a point
RATIO, PRESSURE = "vertical_stress_over_stress_at_rest", "pore_pressure_Pa"


def stress_in_words(scene: dict[str, Any], which: str) -> str:
    """Return what the "vertical" or "normal" stress in the files of a run is: the total
    one less the hydrostatic pressure u_0 in undrained clay whose pore pressure is not
    computed, and else the effective one."""
    total = [bool(layer.get("total_stress")) for layer in scene.get("layers") or []]
    if not any(total):
        return f"{which} effective stress"
    return f"{which} {'total stress $- u_0$' if all(total) else 'stress (clay: total)'}"


class Frame:
    """The soil and the rigid body at one recorded time."""

    def __init__(self, found: recorded.Frame, run: Results) -> None:
        """Raises ResultsError where a field is missing."""
        points, cells = found.point_data, found.cell_data
        if missing := (NEEDED - points.keys()) | ({RATIO} - cells.keys()):
            raise ResultsError(
                f"{points.path} has no field {', '.join(sorted(missing))}: it is of"
                " another version of the program"
            )
        self.position, self.soil, rigid = found.positions, points, cells["material_id"]
        if PRESSURE in points:  # not known where the stress is total
            layers = run.scene.get("layers") or [{}]
            total = np.array([bool(layer.get("total_stress")) for layer in layers])
            material = points.get("material", np.zeros(len(self.position)))
            unknown = total[material.astype(int)]
            points[PRESSURE] = np.where(unknown, np.nan, points[PRESSURE])
        self.body = found.corners[rigid == 1]
        volume = points["whole_volume_m3"]
        is_round = run.entry("Grid/Geometry") != "plane strain"
        of_grid = found.corners, rigid == 1, is_round
        self.means = CellMeans(self.position, volume, *of_grid)
        self.ratio = cells[RATIO][self.means.used].astype(float)
        self.tops = tops_of(run.scene)
        self.time, self.shown = found.time, run.shown
        self.label, self.mark = f"t = {found.time:.3g} s", ""
        if curves.penetration(run.history) is not None:
            self.label = f"penetration {self.shown.depth(found.penetration)}"
            if (end := depth_of(run)) is not None and found.penetration > end:
                self.mark = "not feasible"


def chosen(positions: np.ndarray, wanted: Sequence[float]) -> list[int]:
    """Return the numbers of the frames to draw, MOST_FRAMES at most.

    positions: the penetrations of all (m), or their times; wanted: the penetrations at
    which the scene asks for frames (m). Without any, and where a run has not come to
    the last of them, frames are taken evenly. The last frame is always among them.
    """
    low, high = positions.min(), positions.max()
    goals = [x for x in wanted if low - 1e-3 <= x <= high + 1e-3]
    evenly = list(np.linspace(positions[0], positions[-1], MOST_FRAMES))
    for goals in (goals if len(goals) >= max(len(wanted), 2) else evenly, evenly):
        picks = {int(np.argmin(np.abs(positions - x))) for x in goals}
        picks.add(len(positions) - 1)
        if len(picks) <= MOST_FRAMES:
            break
    return sorted(picks)


def window_of(first: Frame, last: Frame, scene: dict[str, Any]) -> Window:
    """Return what the picture shows about the caisson."""
    cells = np.concatenate([first.means.polygons, last.means.polygons])
    radius, bottom = cells[..., 0].max(), cells[..., 1].min()
    surface = cells[..., 1].max()
    if len(last.body):
        diameter = scene.get("diameter_m") or 2 * last.body[..., 0].max()
        depth = surface - last.body[..., 1].min()
        bottom = max(bottom, surface - max(1.6 * depth, diameter))
        radius = min(radius, max(diameter, SLENDEREST * (surface - bottom)))
    top = surface + 0.08 * (surface - bottom)
    return radius, bottom, top


def inside(frame: Frame, window: Window) -> np.ndarray:
    """Return which painted cells lie at least partly in the window."""
    radius, bottom, top = window
    lower, upper = [f(frame.means.polygons, axis=1) for f in (np.min, np.max)]
    return (lower[:, 0] < radius) & (upper[:, 1] > bottom) & (lower[:, 1] < top)


def paint_smoothly(
    axes: Axes, frame: Frame, values: np.ndarray, style: Style, sides: Sides = (1, -1)
) -> ScalarMappable:
    """Draw a field between the means of the cells [n], on both sides of the axis; gray
    where the soil has no value."""
    polygons = frame.means.polygons
    known, cmap = np.isfinite(values), style["cmap"]
    axes.add_collection(
        PolyCollection(
            np.concatenate([polygons[~known] * [side, 1] for side in sides]),
            facecolors=NO_VALUE,
            edgecolors=NO_VALUE,
            linewidths=0.4,
        ),
        autolim=False,
    )
    norm = style.get("norm") or Normalize(style["vmin"], style["vmax"])
    if not known.any():
        return ScalarMappable(norm, cmap)
    at_corners = frame.means.at_corners(values)[known]
    corners, n = polygons[known], int(known.sum())
    place = np.concatenate([corners, corners.mean(axis=1)[:, None]], axis=1)
    number = 5 * np.arange(n)[:, None]  # of the first corner; the middle is the fifth
    triangles = np.concatenate([number + [k, (k + 1) % 4, 4] for k in range(4)])
    field = np.column_stack([at_corners, values[known]]).ravel()
    place = place.reshape(-1, 2)
    painted = TriMesh(
        Triangulation(
            np.concatenate([side * place[:, 0] for side in sides]),
            np.concatenate([place[:, 1] for _ in sides]),
            np.concatenate([triangles + i * len(place) for i in range(len(sides))]),
        ),
        array=np.tile(field, len(sides)),
        cmap=cmap,
        norm=norm,
    )
    # Axes.tripcolor() would also make a path of each triangle, for the limits
    axes.add_collection(painted, autolim=False)
    return painted


def tops_of(scene: dict[str, Any]) -> list[float]:
    """Return the z (m) at which another layer began; not those within a layer that
    changes with depth."""
    layers = scene.get("layers") or []
    return [
        -float(below["top_depth_m"])
        for above, below in zip(layers, layers[1:])
        if above.get("layer") != below.get("layer")
    ]


def boundary_now(
    position: np.ndarray, displacement: np.ndarray, z: float, edges: np.ndarray
) -> np.ndarray:
    """Return where a boundary that was at z is now, [n, 2] in the strips between
    edges [n + 1]: it has moved as the material points [n_points, 2] that were closest
    to it; nan where none was close."""
    off = position[:, 1] - displacement[:, 1] - z
    strip = np.searchsorted(edges, position[:, 0]) - 1
    found = np.full((len(edges) - 1, 2), np.nan)
    found[:, 0] = (edges[:-1] + edges[1:]) / 2
    for i in range(len(found)):
        points = np.flatnonzero(strip == i)
        points = points[np.argsort(np.abs(off[points]))[:CLOSEST]]
        if len(points) and np.abs(off[points[0]]) < CLOSE:
            found[i, 1] = z + displacement[points, 1].mean()
    return found


def draw_layers(axes: Axes, frame: Frame) -> None:
    """Draw the boundaries between layers where they are now, for all colors; not at a
    wall that has passed, which has dragged a skin of soil with it."""
    edges = np.unique(frame.means.polygons[:, :2, 0])
    move = frame.soil["displacement_m"]
    for top in frame.tops:
        line = boundary_now(frame.position, move, top, edges)
        if len(frame.body) and frame.body[..., 1].min() < top:
            wall = frame.body[frame.body[..., 1].min(axis=1) < top][..., 0]
            skin = np.ptp(wall) if wall.min() > 0 else 0.0
            is_near = (line[:, 0] > wall.min() - skin) & (
                line[:, 0] < wall.max() + skin
            )
            line[is_near, 1] = np.nan
        # to the axis and to the side of the mesh
        line[[0, -1], 0] = edges[[0, -1]]
        for side in (1, -1):
            for color, width in (("0.2", 1.8), ("white", 0.9)):
                style: Style = {"color": color, "linewidth": width, "zorder": 2.4}
                axes.plot(side * line[:, 0], line[:, 1], **style)


def draw_body(axes: Axes, frame: Frame) -> None:
    """Draw the rigid body, exactly: its cells."""
    for side in (1, -1):
        axes.add_collection(
            PolyCollection(
                frame.body * [side, 1],
                facecolors=RIGID,
                edgecolors=RIGID,
                linewidths=0.5,
                zorder=3,
            )
        )


def draw_about(axes: Axes, frame: Frame, window: Window) -> None:
    """Draw what is about a field: the body, the axis and the frame of the panel."""
    radius, bottom, top = window
    draw_layers(axes, frame)
    draw_body(axes, frame)
    axes.axvline(0, color="0.4", linewidth=0.5, dashes=(8, 4, 2, 4))
    axes.set_aspect("equal")
    axes.set_xlim(-radius, radius)
    axes.set_ylim(bottom, top)
    if 4 * radius < top - bottom:  # no room for more labels
        axes.set_xticks([0, radius])
    axes.set_xlabel("r (m)")
    axes.set_title("\n".join(filter(None, (frame.label, frame.mark))))


def nice_above(value: float) -> float:
    """Return the least of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is
    not below the value."""
    if not np.isfinite(value) or value <= 0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    steps = [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10]
    return next(s * power for s in steps if s * power >= value * (1 - 1e-9))


def panels(
    n: int, window: Window, bars: int, note: float
) -> tuple[Figure, np.ndarray, list[Axes]]:
    """Return a figure of n panels beside each other with the shape of the window, as
    wide as a page or narrower, and the places of color bars below them. note: the
    height of a text below these (inches)."""
    left, gap, above, foot = 0.55, 0.2, 0.45, note + 1.25  # inches
    most = 3.6 if n > 1 else 4.8  # which the names of two color bars take
    width = min((PAGE - left - 0.1 - (n - 1) * gap) / n, most)
    height = width * (window[2] - window[1]) / (2 * window[0])
    height = min(max(height, 1.2), 5.0)
    across, high = left + n * (width + gap) - gap + 0.1, foot + height + above
    figure = Figure(figsize=(across, high))

    def place(x: float, y: float, w: float, h: float, **more: Any) -> Axes:
        rectangle = (x / across, y / high, w / across, h / high)
        return figure.add_axes(rectangle, **more)

    axes: list[Axes] = []
    for i in range(n):
        shared = {"sharex": axes[0], "sharey": axes[0]} if axes else {}
        axes.append(place(left + i * (width + gap), foot, width, height, **shared))
        axes[i].tick_params(labelleft=i == 0)
    side = (across - left) / bars
    places = [
        place(left / 2 + i * side, note + 0.67, side - 0.3, 0.13) for i in range(bars)
    ]
    return figure, np.array([axes]), places


def shown_values(
    frames: Sequence[Frame], fields: Sequence[np.ndarray], window: Window
) -> np.ndarray:
    """Return the values of all cells in the window that have one."""
    values = np.concatenate(
        [field[inside(frame, window)] for frame, field in zip(frames, fields)]
    )
    return values[np.isfinite(values)]


def ratio_of(label: str, frames: Sequence[Frame]) -> Field:
    """Return the vertical stress over that at rest, white where it is 1."""
    shown = [np.maximum(frame.ratio, 1e-6) for frame in frames]  # none is below 0
    return label, shown, {"cmap": "BrBG_r", "norm": LogNorm(0.1, 10)}


def figure_of(
    frames: Sequence[Frame], window: Window, fields: Sequence[Field], note: float = 0.0
) -> tuple[Figure, np.ndarray]:
    """Return a figure with a panel for each frame and the color bars below: of one
    field, or of the fields of the left and the right halves."""
    figure, axes, places = panels(len(frames), window, len(fields), note)
    both: tuple[Sides, ...] = ((-1,), (1,)) if len(fields) > 1 else ((-1, 1),)
    for i, (panel, frame) in enumerate(zip(axes.flat, frames)):
        painted = [
            paint_smoothly(panel, frame, means[i], style, sides)
            for (_, means, style), sides in zip(fields, both)
        ]
        draw_about(panel, frame, window)
    for panel in axes[:, 0]:
        panel.set_ylabel("z (m)")
    for artist, (label, _, style), place in zip(painted, fields, places):
        bar: Style = {
            "orientation": "horizontal",
            "label": label.replace(": ", ":\n", 1),
        }
        extend = "max" if style.get("vmin") == 0 else "both"
        colors = figure.colorbar(artist, cax=place, extend=extend, **bar)
        if "norm" in style:
            colors.set_ticks(steps := [0.1, 0.2, 0.5, 1, 2, 5, 10], labels=steps)
    in_units(figure, frames[0].shown)
    return figure, axes


def draw_stress(path: Path, frames: Sequence[Frame], window: Window, name: str) -> Path:
    """Draw the vertical stress at each frame, compression positive, and its ratio to
    that at rest. name: of this stress."""
    fields = [frame.means.of(-frame.soil["stress_Pa"][:, 1] / 1e3) for frame in frames]
    highest = np.percentile(shown_values(frames, fields, window), 99)
    style: Style = {"cmap": "turbo", "vmin": 0, "vmax": nice_above(highest)}
    ratio = ratio_of("right halves: ratio to stress at rest (gray: none)", frames)
    sides = [(f"left halves: {name} (kPa)", fields, style), ratio]
    return disk.save(figure_of(frames, window, sides)[0], path)


def draw_void_ratio(path: Path, frames: Sequence[Frame], window: Window) -> Path | None:
    """Draw the void ratio at each frame; return None where it hardly changes."""
    if "void_ratio" not in frames[0].soil:
        return None
    fields = [frame.means.of(frame.soil["void_ratio"]) for frame in frames]
    shown = shown_values(frames, fields, window)
    if len(shown) == 0:  # soil without pores
        return None
    low, high = np.percentile(shown, [1, 99])
    if high - low < 0.05:
        return None
    style = {"cmap": "viridis", "vmin": low, "vmax": high}
    field = ("void ratio (-)", fields, style)
    return disk.save(figure_of(frames, window, [field])[0], path)


def draw_tip(
    axes: Axes, frame: Frame, values: np.ndarray, box: Box, style: Style
) -> EllipseCollection:
    """Draw a field on a small part: a disc of its own area for every material
    point, on the means of the cells."""
    left, right, bottom, top = box
    position, size = frame.position, np.sqrt(frame.means.area)
    middle, half = np.array([left + right, bottom + top]) / 2, (right - left) / 2
    shown = (np.abs(position - middle).max(axis=1) < half + size) & (size > 0)
    highest = nice_above(np.percentile(values[shown], 99.5)) if shown.any() else 1
    style = {**style, "vmin": 0, "vmax": highest}
    paint_smoothly(axes, frame, frame.means.of(values), style, (1,))
    discs = EllipseCollection(
        size[shown],
        size[shown],
        np.zeros(shown.sum()),
        units="x",
        offsets=position[shown],
        transOffset=axes.transData,
        linewidths=0,
        cmap=style["cmap"],
    )
    discs.set_array(values[shown])
    discs.set_clim(style["vmin"], style["vmax"])
    axes.add_collection(discs)
    draw_layers(axes, frame)
    draw_body(axes, frame)
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_aspect("equal")
    axes.set_xlabel("r (m)")
    axes.set_title("at the tip")
    return discs


def tip_box(frame: Frame, window: Window, scene: dict[str, Any]) -> Box | None:
    """Return a square about the tip; None: no body."""
    if len(frame.body) == 0:
        return None
    corners = frame.body.reshape(-1, 2)
    tip = corners[np.argmin(corners[:, 1])]
    side = min(0.16 * window[0], 5 * scene.get("wall_thickness_m", window[0]))
    left = max(tip[0] - side, 0)
    return left, left + 2 * side, tip[1] - 1.1 * side, tip[1] + 0.9 * side


def draw_displacement(
    path: Path, frame: Frame, window: Window, scene: dict[str, Any]
) -> Path:
    """Draw the displacement of the soil, and displacement and plastic strain at the
    tip."""
    soil, box = frame.soil, tip_box(frame, window, scene)
    moved = np.linalg.norm(soil["displacement_m"][:, :2], axis=1)
    fields = [("displacement (m)", moved, "viridis")]
    if "plastic_deviatoric" in soil:
        label = "plastic deviatoric strain (-)"
        fields.append((label, soil["plastic_deviatoric"], "magma_r"))
    n = 1 + len(fields) if box else 1
    # the layout takes the titles of panels of unequal height to be lower
    layout = ConstrainedLayoutEngine(rect=(0, 0, 1, 0.94))
    figure = Figure(figsize=(PAGE, 3.05), layout=layout)
    axes = figure.subplots(1, n, squeeze=False)[0]
    means = frame.means.of(moved)
    highest = nice_above(np.percentile(means[inside(frame, window)], 99))
    style = {"cmap": "viridis", "vmin": 0, "vmax": highest}
    painted: list[Any] = [paint_smoothly(axes[0], frame, means, style)]
    draw_about(axes[0], frame, window)
    axes[0].set_ylabel("z (m)")
    if box:
        for panel, (_, values, colors) in zip(axes[1:], fields):
            painted.append(draw_tip(panel, frame, values, box, {"cmap": colors}))
    labels = ["displacement (m)", *[label for label, *_ in fields]]
    for panel, artist, label in zip(axes, painted, labels):
        bar: Style = {"location": "bottom", "extend": "max", "label": label}
        figure.colorbar(artist, ax=panel, **bar)
    in_units(figure, frame.shown)
    return disk.save(figure, path)


def frames_of(run: Results) -> list[Frame]:
    """Return the frames to draw, none where their files are gone."""
    found = [f for f in recorded.frames_of(run) if {"points", "grid"} <= f.files.keys()]
    if not found:
        print(f"plot: the frames of {run.directory} are gone, so forces only")
        return []
    wanted = run.scene.get("frame_penetrations_m") or []
    if len(found) > 1 and not (run.scene and run.summary.get("installation")):
        first, *found = found  # the first one is undisturbed
        wanted = [depth for depth in wanted if depth > first.penetration + 1e-3]
    by_depth = curves.penetration(run.history) is not None
    positions = np.array([f.penetration if by_depth else f.time for f in found])
    return [Frame(found[i], run) for i in chosen(positions, wanted)]


def draw(run: Results, frames: Sequence[Frame], window: Window) -> list[Path | None]:
    """Write stress.png, displacement.png and, where volume changes,
    void_ratio.png; return their paths, None for none."""
    directory, scene = run.directory, run.scene
    return [
        draw_stress(
            directory / "stress.png",
            frames,
            window,
            stress_in_words(scene, "vertical"),
        ),
        draw_displacement(directory / "displacement.png", frames[-1], window, scene),
        draw_void_ratio(directory / "void_ratio.png", frames, window),
    ]
