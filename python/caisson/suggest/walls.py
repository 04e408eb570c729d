# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction and adhesion of the walls: of all sand the same friction, and where clay and
sand lie above each other those of each layer. Whether the wall bears the weight."""
from collections.abc import Sequence

from caisson.design import shell
from caisson.suggest import clay, sand
from caisson.suggest.entry import ASSUMPTION, Entry, Layer, SuggestError, number_in
from caisson.suggest.sizes import Body
from caisson.suggest.soil import LEAST_DRAINED, NGI_ADP

FRICTION, ADHESION = "Friction angle of the walls", "Adhesion factor of the walls"
STEEL = 355e6, 210e9, 0.5  # section Design: strength, modulus (Pa), fixity over D
ADHESION_OF_CLAY = Entry(
    ADHESION,
    clay.ADHESION_FACTOR,
    f"{ASSUMPTION}: sensitivity 2, remoulded (DNV-RP-E303)",
)


class NoAngle(SuggestError):
    """A layer has no friction angle from which that of the walls would follow."""


def is_by_density(layer: Layer) -> bool:
    """Return whether the strength of a layer follows from its density."""
    return layer.value("Law") in sand.LAWS.values()


def angle_of(layer: Layer) -> str:
    """Return the friction angle of a layer (degrees); 0 of undrained clay."""
    return "0" if layer.value("Law") == NGI_ADP else layer.value("Friction angle")


def is_clay(layer: Layer) -> bool:
    """Return whether a layer is undrained clay."""
    return angle_of(layer) == "0"


def is_quick_clay(layer: Layer) -> bool:
    """Return whether strength is that of clay in a quick test, a cohesion with a small
    angle: drained soil has a larger one."""
    angle, cohesion = number_in(angle_of(layer)) or 0.0, layer.value("Cohesion")
    return 0 < angle < LEAST_DRAINED and cohesion not in ("", "0")


def friction_of(layer: Layer) -> Entry:
    """Return the friction angle between the walls and a layer. Raises SuggestError
    where the soil has no angle."""
    if is_clay(layer):
        return Entry(FRICTION, "0", " # clay adheres")
    if is_by_density(layer):
        return Entry(FRICTION, sand.WALL_FRICTION.value, sand.WALL_FRICTION.remark)
    if not (angle := angle_of(layer)):
        raise NoAngle(
            f"the soil from {layer.top:g} m has no friction angle from which that of"
            " the walls would follow: give --wall-friction"
        )
    number = number_in(angle)
    value = f"2/3*({angle})" if number is None else f"{2 / 3 * number:.3g}"
    return Entry(FRICTION, value, f"{ASSUMPTION}: 2/3 of the friction angle")


def without_friction(layers: Sequence[Layer]) -> list[Layer]:
    """Return the layers whose wall friction is not given with them."""
    return [layer for layer in layers if not layer.value(FRICTION)]


def have_own(layers: Sequence[Layer]) -> bool:
    """Return whether each layer needs a wall friction of its own: clay adheres and
    sand rubs, or an angle changes with depth."""
    values = [friction_of(layer).value for layer in without_friction(layers)]
    return len({value == "0" for value in values}) > 1 or any("*" in v for v in values)


def wall_friction_of(given: float | None, layers: Sequence[Layer]) -> Entry:
    """Return the friction angle of the walls where a layer has none of its own. given:
    that of sand. Raises SuggestError."""
    layers = without_friction(layers)
    if given and layers and all(map(is_clay, layers)):
        raise SuggestError(
            "--wall-friction is for sand, and all of the soil is undrained clay, which"
            " adheres: give alpha in its --layer, as in alpha = 0.5"
        )
    if given is not None or not layers:
        return Entry("", f"{given or 0:g}")
    if have_own(layers):
        return Entry("", "0", " # each layer has its own")
    least = min(map(friction_of, layers), key=lambda entry: float(entry.value))
    if least.value == "0":
        return Entry("", "0")
    why = least.remark.replace("of the friction angle", "of the smallest of the soil")
    return Entry("", least.value, why)


def with_walls(
    layers: Sequence[Layer], given: float | None, reached: Sequence[Layer]
) -> list[Layer]:
    """Return the layers with the friction angle and the adhesion factor of the walls
    that they need beside those of the body. reached: by the skirt; given: the friction
    angle of sand, with 0 of all soil. Raises SuggestError."""
    if given == 0:
        return list(layers)
    own = have_own(reached) if given is None else False
    has_friction = bool(given) or not all(map(is_clay, reached))
    found = []
    for layer in layers:
        added, has_wall = list[Entry](), layer.value(FRICTION) or layer.value(ADHESION)
        adheres = is_clay(layer) and has_friction
        if (own or adheres) and not layer.value(FRICTION):
            added.append(friction_of(layer))
        if is_clay(layer) and not has_wall:
            added.append(ADHESION_OF_CLAY)
        found.append(Layer(layer.top, [*layer.entries, *added], layer.warning))
    return found


def words_on_weight(body: Body, begin: float, weight: float | None) -> str:
    """Return what is wrong with a weight in water (N) where the run begins (m)."""
    wall = shell.Wall(body.diameter, body.wall, body.skirt, *STEEL)
    if (check := shell.check_at(wall, begin, 0.0, weight or 0.0)) < 1:
        return ""
    return (
        "the wall buckles under the weight alone, by DNV-RP-C202 at"
        f" {check:.2g} times its design strength without stiffeners"
    )
