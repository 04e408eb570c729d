# SPDX-License-Identifier: LGPL-2.1-or-later
"""What was computed: the caisson with all its numbers, those that equal a default
included, and which of them the scene marks ASSUMED."""
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from caisson.paths import without_user
from caisson.results import Results
from caisson.table import text_of
from caisson.evaluation import is_sealed
from caisson.report.content import SENTENCES
from caisson.template import say_rows
from caisson.verdict.installation import plug_area

WALLS = {"wall_friction_angle_deg", "wall_adhesion_Pa"}  # of a layer
BODY, SOIL = "Rigid body", "Soil/Layer"
SCALES = ((1e9, "G"), (1e6, "M"), (1e3, "k"))
SCALED = ("Pa", "N", "N/m3")  # units that are written with a prefix
READABLE = {"degrees": "°", "m3": "m³", "m2": "m²", "Youngs": "Young's"}


class Item(NamedTuple):
    """A number with its name, and whether the scene marks it as assumed."""

    name: str
    value: str
    assumed: bool = False


def scale_of(values: list[float], unit: str) -> tuple[float, str]:
    """Return what values are divided by, and the unit with its prefix."""
    largest = max((abs(value) for value in values), default=0.0)
    if unit in SCALED:
        for factor, prefix in SCALES:
            if largest >= factor:
                return factor, prefix + unit
    return 1.0, unit


def readable(text: str) -> str:
    """Return a name or a unit as an engineer writes it."""
    for plain, written in READABLE.items():
        text = re.sub(rf"\b{plain}\b", written, text)
    return text


def in_units(value: str | float, unit: str) -> str:
    """Return the value of an entry with its unit, a word as it is."""
    try:
        number = float(value)
    except ValueError:
        is_list = re.fullmatch(r"[-+\d.eE, ]+", str(value)) and unit
        return f"{value} {readable(unit)}" if is_list else str(value)
    factor, name = scale_of([number], unit)
    space = "" if name == "degrees" else " "
    return f"{number / factor:.4g}{space}{readable(name)}" if unit else str(value)


def file_of(run: Results) -> str:
    """Return the file of the scene as it was named; of a whole path, as phases and
    bands have it, no folder of a user, as pages are passed on."""
    path = Path(str(run.summary.get("scene_file") or ""))
    return without_user(path) if path.is_absolute() else str(path)


def with_units(run: Results, entries: Mapping[str, Any]) -> dict[str, str]:
    """Return entries with their units; those of older files have none."""
    units = run.known.get("units", {})
    return {name: in_units(x, units.get(name, "")) for name, x in entries.items()}


def mass_scaling_of(run: Results) -> str:
    """Return the mass scaling found by an inertia tolerance, in words; nothing without
    one, and of older files."""
    scaling = run.summary.get("mass_scaling")
    tolerance = run.entry("Time/Inertia tolerance")
    if not scaling or tolerance in ("", "none"):
        return ""
    least, most = (text_of(float(f"{x:.2g}")) for x in scaling)
    return f"{least} to {most}, by Inertia tolerance {tolerance}"


def defaults_of(run: Results) -> dict[str, str]:
    """Return the entries with their defaults."""
    found = dict(run.summary.get("defaults", {}))
    if words := mass_scaling_of(run):
        found["Time/Mass scaling"] = words
    return found


def is_assumed(run: Results, entry: str) -> bool:
    """Return whether the scene marks an entry as assumed."""
    return entry in run.summary.get("assumed", [])


def caisson_of(run: Results) -> list[Item]:
    """Return the numbers of the caisson; nothing for other bodies."""
    scene = run.scene
    if not scene.get("diameter_m") or not scene.get("wall_thickness_m"):
        return []
    plug = plug_area(scene)
    tip = math.pi / 4 * float(scene["diameter_m"]) ** 2 - plug
    by_layer = any(WALLS & set(layer) for layer in scene.get("layers", []))
    how = run, plug, tip, by_layer, run.planned, is_sealed(run), in_units
    return [
        Item(name, value, any(is_assumed(run, x) for x in entries.split(", ")))
        for name, value, entries in say_rows(SENTENCES, "caisson", *how, cells=3)
    ]
