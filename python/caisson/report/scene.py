# SPDX-License-Identifier: LGPL-2.1-or-later
"""What was computed: the caisson with all its numbers, those that equal a default
included, and which of them the scene marks ASSUMED."""
import math
import re
from typing import NamedTuple

from caisson.results import Results
from caisson.design.reasons import text_of
from caisson.evaluation import is_sealed
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


def with_unit(value: float, unit: str) -> str:
    """Return a number with its unit, as an engineer writes it."""
    factor, name = scale_of([value], unit)
    space = "" if name == "degrees" else " "
    return f"{value / factor:.4g}{space}{readable(name)}".rstrip()


def entry_with_unit(value: str, unit: str) -> str:
    """Return the value of an entry with its unit, a word as it is."""
    try:
        number = float(value)
    except ValueError:
        is_list = re.fullmatch(r"[-+\d.eE, ]+", value) and unit
        return f"{value} {readable(unit)}" if is_list else value
    return with_unit(number, unit) if unit else value


def entries_of(run: Results) -> dict[str, str]:
    """Return the entries that the scene sets, with their units; those of older files
    have none."""
    summary = run.summary
    units = summary.get("units", {})
    return {
        entry: entry_with_unit(value, units.get(entry, ""))
        for entry, value in summary.get("entries", {}).items()
    }


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


def end_of(run: Results) -> float | None:
    """Return the penetration at which the scene ends (m), None where it has none."""
    try:
        return float(run.entry("Time/End penetration"))
    except ValueError:
        return None


def caisson_of(run: Results) -> list[Item]:
    """Return the numbers of the caisson; nothing for other bodies."""
    scene = run.scene
    if not scene.get("diameter_m") or not scene.get("wall_thickness_m"):
        return []
    outer, wall = float(scene["diameter_m"]), float(scene["wall_thickness_m"])
    found = [
        Item("Outer diameter", run.shown.length(outer)),
        Item("Wall thickness", f"{1000 * wall:g} mm"),
    ]
    start = run.summary.get("start_penetration_m", scene.get("initial_penetration_m"))
    for name, length in (
        ("Skirt length", scene.get("skirt_length_m")),
        ("Penetration at the start", start),  # after an installation, where that ended
    ):
        if length is not None:
            found.append(Item(name, run.shown.length(float(length))))
    for name in ("Wall steps", "Rings"):
        if text := run.entry(f"{BODY}/{name}"):
            found.append(Item(f"{name} (m)", text))
    tip = math.pi / 4 * outer**2 - plug_area(scene)
    found += [
        Item("Area inside, of the lid", f"{plug_area(scene):.4g} m²"),
        Item("Area of the tip", f"{tip:.3g} m²"),
    ]
    found += tip_of(run)
    by_layer = any(WALLS & set(layer) for layer in scene.get("layers", []))
    for side in ("outer", "inner"):
        angle = scene.get(f"{side}_wall_friction_angle_deg")
        if angle is not None and not (by_layer and not float(angle)):
            entry = f"{BODY}/Friction angle of the {side} wall"
            name = f"Friction angle of the {side} wall"
            found.append(Item(name, f"{float(angle):g}°", is_assumed(run, entry)))
        adhesion = float(scene.get(f"{side}_wall_adhesion_Pa") or 0)
        if adhesion:
            name = f"Adhesion of the {side} wall"
            found.append(Item(name, with_unit(adhesion, "Pa")))
    return found + installation_of(run)


def tip_of(run: Results) -> list[Item]:
    """Return shape and friction of the tip; nothing of older files."""
    found, shape = [], run.entry(f"{BODY}/Tip")
    if shape:
        slope = run.entry(f"{BODY}/Tip angle")
        words = f"{shape}, {slope}°" if shape == "triangular" else shape
        entries = [f"{BODY}/Tip", f"{BODY}/Tip angle"]
        assumed = any(is_assumed(run, entry) for entry in entries)
        found.append(Item("Shape of the tip", words, assumed))
    entry = f"{BODY}/Friction angle of the tip"
    if angle := run.entry(entry):
        words = f"{float(angle):g}°"
        found.append(Item("Friction angle of the tip", words, is_assumed(run, entry)))
    return found


def installation_of(run: Results) -> list[Item]:
    """Return how the caisson is installed: its weight, the water, and the speed of
    the computation."""
    found, weight = [], run.scene.get("submerged_weight_N")
    if weight is not None:
        entry = f"{BODY}/Submerged weight"
        text = run.shown.words(float(weight) / 1e3, "kN", ".4g")
        found.append(Item("Weight in water", text, is_assumed(run, entry)))
    for name, path, unit in (
        ("Depth of the water", "Water/Water depth", "m"),
        ("Largest suction of the pump", "Water/Largest suction", "Pa"),
        ("Velocity of the computation", f"{BODY}/Velocity", "m/s"),
        ("End of the computation", "Time/End penetration", "m"),
    ):
        if path.startswith("Water/") and unit and weight is None:
            continue
        if "pump" in name and is_sealed(run):
            continue
        if value := run.entry(path):
            text = entry_with_unit(value, unit)
            if path == "Time/End penetration" and end_of(run) is not None:
                text = run.shown.length(float(value))
            found.append(Item(name, text, is_assumed(run, path)))
    return found
