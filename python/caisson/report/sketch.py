# SPDX-License-Identifier: LGPL-2.1-or-later
"""A section through caisson and ground, to scale and with dimensions, as SVG."""
import html
import math

from caisson.ledges import parts_of_wall
from caisson.results import Results
from caisson.report.layers import Layer, layers_of, number_in_words, strength_of
from caisson.report.scene import BODY

LETTER = 7.2  # pixels, the width of a letter
WIDTH, MARGIN = 560.0, 52.0  # of the drawing, and of each side (pixels)
TALL, LEAST_BAND = 420.0, 15.0  # largest height, lowest layer with a text (pixels)
LEAST_WALL = 1.6  # pixels


class Drawing:
    """Shapes and texts in meters, depth downward from the mudline."""

    def __init__(self, half_width: float, top: float, bottom: float) -> None:
        room = WIDTH - 2 * MARGIN
        self.scale = min(room / (2 * half_width), TALL / (bottom - top))
        self.top, self.half_width, self.bottom = top, half_width, bottom
        self.parts: list[str] = []
        self.texts: list[str] = []  # above all lines
        self.taken: dict[str, list[float]] = {"left": [], "middle": []}  # pixels

    def x(self, r: float) -> float:
        """Return the pixel of a distance from the axis."""
        return WIDTH / 2 + self.scale * r

    def y(self, depth: float) -> float:
        """Return the pixel of a depth."""
        return 26 + self.scale * (depth - self.top)

    def add(self, tag: str, words: str = "", **attributes: str | float) -> None:
        """Add an element, with D_r and s_u as they are written; numbers are pixels."""
        texts = {
            name.strip("_").replace("_", "-"): x if isinstance(x, str) else f"{x:.1f}"
            for name, x in attributes.items()
        }
        inside = " ".join(f'{name}="{text}"' for name, text in texts.items())
        words = html.escape(words.replace("_r", "ᵣ").replace("_u", "ᵤ"))
        parts = self.texts if tag == "text" else self.parts
        parts.append(f"<{tag} {inside}>{words}</{tag}>")

    def box(self, kind: str, left: float, top: float, right: float, low: float) -> None:
        """Add a rectangle."""
        x, y = self.x(left), self.y(top)
        width, height = self.x(right) - x, self.y(low) - y
        self.add("rect", class_=kind, x=x, y=y, width=width, height=height)

    def wall(
        self, left: float, top: float, width: float, depth: float, slope: float
    ) -> None:
        """Add a wall from left, down to the depth of its tip (m), where faces of a
        slope (tangent of their angle to the horizontal) meet, 0 of a flat one."""
        shoulder, right = depth - slope * width / 2, left + width
        lowest = [(left + width / 2, depth)] if slope else []
        corners = [(left, top), (left, shoulder), *lowest, (right, shoulder)]
        points = [
            f"{self.x(r):.1f},{self.y(z):.1f}" for r, z in [*corners, (right, top)]
        ]
        self.add("polygon", class_="steel", points=" ".join(points))

    def line(self, kind: str, *ends: float) -> None:
        """Add a line between two pixels."""
        x1, y1, x2, y2 = ends
        self.add("line", class_=kind, x1=x1, y1=y1, x2=x2, y2=y2)

    def text(self, x: float, y: float, words: str, anchor: str = "start") -> None:
        """Add a text at a pixel."""
        self.add("text", words, x=x, y=y, text_anchor=anchor)

    def free(self, column: str, y: float) -> float:
        """Return the place (pixel) nearest to y where a column has no text yet, and
        take it."""
        places = [y + step * LEAST_BAND for step in (0, 1, -1, 2, -2, 3, -3)]
        taken = self.taken[column]
        free = (p for p in places if all(abs(p - t) > LEAST_BAND - 1 for t in taken))
        taken.append(next(free, y))
        return taken[-1]

    def height(self, x: float, top: float, low: float, words: str) -> None:
        """Add a dimension line of a depth range beside the pixel x."""
        for depth in (top, low):
            self.line("dimension", x - 4, self.y(depth), x + 4, self.y(depth))
        self.line("dimension", x, self.y(top), x, self.y(low))
        middle = (self.y(top) + self.y(low)) / 2 + 4
        side = -1 if x < WIDTH / 2 else 1
        middle = self.free("left", middle) if side < 0 else middle
        self.text(x + 6 * side, middle, words, "end" if side < 0 else "start")

    def rest(self, radius: float, depth: float, *texts: str) -> None:
        """Add a line between the walls with the first of texts that is not wider than
        the caisson, or else the last one, not on another text."""
        y, room = self.y(depth), 2 * self.scale * radius
        self.line("rest", self.x(-radius), y, self.x(radius), y)
        words = next((x for x in texts if LETTER * len(x) < room), texts[-1])
        self.text(self.x(0), self.free("middle", y - 4), words, "middle")

    def svg(self, words: str) -> str:
        """Return the drawing; words say what it shows."""
        height, inside = self.y(self.bottom) + 22, "".join(self.parts + self.texts)
        return (
            f'<svg class="sketch" viewBox="0 0 {WIDTH:g} {height:.0f}" role="img"'
            f' aria-label="{html.escape(words)}">{inside}</svg>'
        )


def about_layer(run: Results, layer: Layer, width: float) -> str:
    """Return the most important numbers of a layer, as many as are not wider (pixels):
    the table beside it has all."""
    strength = ", ".join(strength_of(run, layer).values())
    words = [f"layer {layer.number}", strength.partition(" (")[0]]
    weight = number_in_words(run, layer, "Submerged unit weight", "N/m3")
    words = [word for word in (*words, f"γ′ {weight}" if weight else "") if word]
    while len(words) > 1 and LETTER * len(", ".join(words)) > width:
        words.pop()
    return ", ".join(words)


def draw_ground(drawing: Drawing, run: Results, radius: float) -> None:
    """Draw the layers, with their depths at the right and their numbers between the
    walls of the caisson, where no dimension is, or those of a seam at the left."""
    side, written = drawing.half_width, -1e9
    for i, layer in enumerate(layers_of(run.scene)):
        low = min(layer.bottom or drawing.bottom, drawing.bottom)
        if layer.top >= drawing.bottom:
            break
        drawing.box(f"soil soil{i % 2}", -side, layer.top, side, low)
        if drawing.y(layer.top) - written >= LEAST_BAND:
            written = drawing.y(layer.top)
            place = run.shown.length(layer.top) if i else ""
            drawing.text(drawing.x(side) + 6, written + 4, place)
        if drawing.scale * (low - layer.top) > LEAST_BAND:
            words = about_layer(run, layer, 2 * drawing.scale * radius - 8)
            y = drawing.free("middle", drawing.y(low) - 5)
            drawing.text(drawing.x(0), y, words, "middle")
        else:
            words = about_layer(run, layer, drawing.scale * (side - radius) - 8)
            y = drawing.free("left", (drawing.y(layer.top) + drawing.y(low)) / 2 + 4)
            drawing.text(drawing.x(-side) + 4, y, words)


def draw_walls(drawing: Drawing, run: Results, lid: float, depth: float) -> None:
    """Draw both walls from the lid (m) down to the tip at a depth (m), with their steps
    and rings."""
    outer, thinnest = float(run.scene["diameter_m"]) / 2, LEAST_WALL / drawing.scale
    at_tip = max(float(run.scene["wall_thickness_m"]), thinnest)
    steps = [(0.0, at_tip)]
    for place, width in parts_of_wall(run.scene, "wall_step", "above_tip", "thickness"):
        steps.append((place, max(width, thinnest)))
    angle = float(run.entry(f"{BODY}/Tip angle") or 45)
    is_flat = run.entry(f"{BODY}/Tip") != "triangular"  # that of older files is
    slope = 0.0 if is_flat else math.tan(math.radians(angle))
    is_flush_inside = run.entry(f"{BODY}/Flush face") == "inner"

    def faces(thickness: float) -> tuple[float, float]:
        """Return the radii of the inner and the outer face (m)."""
        inner = outer - (at_tip if is_flush_inside else thickness)
        return inner, inner + thickness

    tops = [depth - place for place, _ in steps[1:]] + [lid]
    for (place, thickness), top in zip(steps, tops):
        inner, right = faces(thickness)
        for left in (-right, inner):
            if place == 0:
                drawing.wall(left, top, thickness, depth, slope)
            else:
                drawing.box("steel", left, top, left + thickness, depth - place)
    for place, width, height in parts_of_wall(
        run.scene, "ring", "above_tip", "width", "height"
    ):
        inner, _ = faces([t for at, t in steps if at <= place][-1])
        for left in (-inner, inner - width):
            drawing.box(
                "steel", left, depth - place - height, left + width, depth - place
            )


def of_run(run: Results, depth: float, rest: float | None) -> str:
    """Return the section with the tip at a depth (m), and where the caisson rests by
    its weight (m); nothing for other bodies than caissons."""
    scene, shown = run.scene, run.shown
    if not scene.get("diameter_m") or not scene.get("wall_thickness_m"):
        return ""
    outer, wall = float(scene["diameter_m"]), float(scene["wall_thickness_m"])
    length = float(scene.get("skirt_length_m") or depth)
    radius, lid = outer / 2, depth - length
    planned = run.planned or depth
    bottom = max(depth, planned, 0.1 * length) * 1.3
    drawing = Drawing(0.95 * outer, min(lid, 0.0) - 0.06 * length, bottom)
    draw_ground(drawing, run, radius)
    thick = max(wall, LEAST_WALL / drawing.scale)
    draw_walls(drawing, run, lid, depth)
    drawing.box("steel", -radius, lid - thick, radius, lid)
    y, x = drawing.y(lid - thick) - 8, (drawing.x(-radius), drawing.x(radius))
    drawing.line("dimension", x[0], y, x[1], y)
    for end in x:
        drawing.line("dimension", end, y - 4, end, y + 4)
    words = f"D = {shown.length(outer)}, t = {1000 * wall:g} mm"
    drawing.text(WIDTH / 2, y - 5, words, "middle")
    drawing.height(drawing.x(-radius) - 14, lid, depth, f"L = {shown.length(length)}")
    drawing.height(drawing.x(radius) + 14, 0, depth, f"h = {shown.depth(depth)}")
    axis = WIDTH / 2
    drawing.line("axis", axis, drawing.y(lid), axis, drawing.y(bottom))
    if rest is not None and 0 < rest < depth:
        place = shown.depth(rest)
        drawing.rest(radius, rest, f"rests by weight at {place}", f"rests at {place}")
    if planned > depth + 0.01 * min(length, 1.0):
        place = shown.depth(planned)
        drawing.rest(radius, planned, f"end of the scene at {place}", f"end, {place}")
    return drawing.svg("section through caisson and ground, to scale")
