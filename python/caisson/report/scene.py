# SPDX-License-Identifier: LGPL-2.1-or-later
"""What was computed: the caisson and the layers of the soil with all their numbers,
those that equal a default included, and which of them the scene marks ASSUMED."""
import math
import re
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from caisson.results import Results
from caisson.design.reasons import text_of

ASSUMED = "ASSUMED"
BODY, SOIL = "Rigid body", "Soil/Layer"
SCALES = ((1e9, "G"), (1e6, "M"), (1e3, "k"))
SCALED = ("Pa", "N", "N/m3")  # units that are written with a prefix
READABLE = {"degrees": "°", "m3": "m³", "m2": "m²", "Youngs": "Young's"}
# number of a layer in run.json: its name, its unit, and the entry that sets it
OF_LAYER = {
    "submerged_unit_weight_N_m3": ("Submerged unit weight", "N/m3", ""),
    "K0": ("K0", "", "K0"),
    "porosity": ("Porosity", "", "Porosity"),
    "solid_density_kg_m3": ("Solid density", "kg/m3", "Solid density"),
    "relative_density": ("Relative density", "", "Relative density"),
    "permeability_m_s": ("Permeability", "m/s", "Permeability"),
    "permeability_ratio": (
        "Horizontal over vertical permeability",
        "",
        "Permeability ratio",
    ),
    "wall_friction_angle_deg": (
        "Friction angle of the walls",
        "degrees",
        "Friction angle of the walls",
    ),
    "wall_adhesion_Pa": (
        "Adhesion of the walls",
        "Pa",
        "Adhesion factor of the walls",
    ),
}
FIRST = ("submerged_unit_weight_N_m3", "K0", "relative_density")
FEW = 5  # layers that have a column each
# older files have no list of the numbers of a law
OF_LAW = {
    "friction_angle_deg": ("Friction angle", "degrees"),
    "cohesion_Pa": ("Cohesion", "Pa"),
    "youngs_modulus_Pa": ("Youngs modulus", "Pa"),
}


class Item(NamedTuple):
    """A number with its name, and whether the scene marks it as assumed."""

    name: str
    value: str
    assumed: bool = False


class Column(NamedTuple):
    """A quantity of the layers: values by layer, None where a layer has none."""

    name: str
    unit: str
    values: list[float | None]
    assumed: list[bool]


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
    tolerance = entry_of(run, "Time/Inertia tolerance")
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


def use_of(run: Results) -> str:
    """Return what the numbers of a run are for: drainage, and how it is installed."""
    level = entry_of(run, "Water/Level")
    if not caisson_of(run) or not level:
        return ""
    has_weight = run.scene.get("submerged_weight_N") is not None
    depth = run.history["penetration_m"]
    if is_sealed(run) or depth[-1] < depth[0]:
        lid = "sealed lid" if is_sealed(run) else "open lid"
        return f"{level}, {lid}{', pulled up' if depth[-1] < depth[0] else ''}"
    how = "by weight and suction" if has_weight else "jacked, no suction"
    return f"{level}, {how}"


def is_sealed(run: Results) -> bool:
    """Return whether no pump takes water from beneath the lid."""
    return "lid_water_balance" in run.history


def is_assumed(run: Results, entry: str) -> bool:
    """Return whether the scene marks an entry as assumed."""
    return entry in run.summary.get("assumed", [])


def entry_of(run: Results, path: str) -> str:
    """Return the value of an entry, set or default; nothing in older files."""
    summary = run.summary if run.scene else {}
    known = {**summary.get("defaults", {}), **summary.get("entries", {})}
    return str(known.get(path, ""))


def end_of(run: Results) -> float | None:
    """Return the penetration at which the scene ends (m), None where it has none."""
    if not run.scene:
        return None
    try:
        return float(entry_of(run, "Time/End penetration"))
    except ValueError:
        return None


def plug_area(scene: Mapping[str, Any]) -> float:
    """Return the area that suction acts on (m2)."""
    inner = float(scene["diameter_m"]) - 2 * float(scene["wall_thickness_m"])
    return math.pi / 4 * inner**2


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
    tip = math.pi / 4 * outer**2 - plug_area(scene)
    found += [
        Item("Area inside, of the lid", f"{plug_area(scene):.4g} m²"),
        Item("Area of the tip", f"{tip:.3g} m²"),
    ]
    found += tip_of(run)
    for side in ("outer", "inner"):
        angle = scene.get(f"{side}_wall_friction_angle_deg")
        if angle is not None:
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
    found, shape = [], entry_of(run, f"{BODY}/Tip")
    if shape:
        slope = entry_of(run, f"{BODY}/Tip angle")
        words = f"{shape}, {slope}°" if shape == "triangular" else shape
        entries = [f"{BODY}/Tip", f"{BODY}/Tip angle"]
        assumed = any(is_assumed(run, entry) for entry in entries)
        found.append(Item("Shape of the tip", words, assumed))
    entry = f"{BODY}/Friction angle of the tip"
    if angle := entry_of(run, entry):
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
        ("Pore water", "Water/Level", ""),
        ("Depth of the water", "Water/Water depth", "m"),
        ("Largest suction of the pump", "Water/Largest suction", "Pa"),
        ("Velocity of the computation", f"{BODY}/Velocity", "m/s"),
        ("End of the computation", "Time/End penetration", "m"),
    ):
        if path.startswith("Water/") and unit and weight is None:
            continue
        if "pump" in name and is_sealed(run):
            continue
        if value := entry_of(run, path):
            text = entry_with_unit(value, unit)
            if path == "Time/End penetration" and end_of(run) is not None:
                text = run.shown.length(float(value))
            found.append(Item(name, text, is_assumed(run, path)))
    return found


def columns_of(run: Results) -> list[Column]:
    """Return the quantities of the layers, each that a layer has."""
    layers = run.scene.get("layers", [])
    names: dict[tuple[str, str], list[tuple[float | None, bool]]] = {}
    for i, layer in enumerate(layers):
        section = f"{SOIL} {layer.get('layer', i + 1)}"
        for (name, unit), (value, entry) in numbers_of(layer).items():
            known = names.setdefault((name, unit), [(None, False)] * len(layers))
            known[i] = (value, is_assumed(run, f"{section}/{entry}"))
    return [
        Column(name, unit, [v for v, _ in found], [a for _, a in found])
        for (name, unit), found in names.items()
    ]


def numbers_of(
    layer: Mapping[str, Any],
) -> dict[tuple[str, str], tuple[float | None, str]]:
    """Return value and entry of each number of a layer by its name and unit; unit
    weight, stress and strength before the others."""
    found: dict[tuple[str, str], tuple[float | None, str]] = {}

    def add(keys: Iterable[str]) -> None:
        for key in (key for key in keys if key in layer):
            (name, unit, entry), value = OF_LAYER[key], layer[key]
            found[name, unit] = (None if value is None else float(value), entry)

    add(FIRST)
    if "law_entries" not in layer:
        for key, (name, unit) in OF_LAW.items():
            if layer.get(key) is not None:
                found[name, unit] = (float(layer[key]), "")
    for item in layer.get("law_entries", []):
        found[item["entry"], item["unit"]] = (item["value"], item["entry"])
    add(key for key in OF_LAYER if key not in FIRST)
    return found


def layers_table(run: Results) -> dict[str, Any]:
    """Return the table of the layers: heads, and rows of (text, assumed). A few layers
    have a column each, many a row each."""
    layers = run.scene.get("layers", [])
    columns: dict[str, list[tuple[str, bool]]] = {
        "layer": [(str(e.get("layer", i)), False) for i, e in enumerate(layers, 1)],
        run.shown.named("from (m)"): [
            (f"{run.shown.factor('m') * float(e.get('top_depth_m') or 0):.6g}", False)
            for e in layers
        ],
        "law": [(str(e.get("law", "")), False) for e in layers],
    }
    for column in columns_of(run):
        known = [value for value in column.values if value is not None]
        factor, unit = scale_of(known, column.unit)
        head = readable(f"{column.name} ({unit})" if unit else column.name)
        columns[head] = [
            ("" if value is None else text_of(value / factor), assumed)
            for value, assumed in zip(column.values, column.assumed)
        ]
    rows = [list(row) for row in zip(*columns.values())]
    if not 0 < len(layers) <= FEW:
        return {"heads": list(columns), "rows": rows, "turned": False}
    turned = [[(head, False), *cells] for head, cells in columns.items()]
    heads = [text for text, _ in turned[0]]
    return {"heads": heads, "rows": turned[1:], "turned": True}
