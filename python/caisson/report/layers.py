# SPDX-License-Identifier: LGPL-2.1-or-later
"""The layers of the soil, one row for each, whose numbers may change with depth."""
import math
import tomllib
from collections.abc import Iterable, Mapping
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from caisson.table import text_of
from caisson.report.scene import SOIL, caisson_of, is_assumed
from caisson.evaluation import is_sealed
from caisson.report.scene import readable, scale_of
from caisson.results import Results
from caisson.verdict.retrieval import is_retrieval

NAMES = tomllib.loads(Path(__file__).with_name("layers.toml").read_text("utf-8"))
FIRST = ("submerged_unit_weight_N_m3", "K0", "relative_density")
STRENGTH = "Cohesion", "Pa"
LINEAR = 2e-3  # of a number: how far a straight line may be from it

Numbers = dict[tuple[str, str], tuple[float | None, str]]


class Layer(NamedTuple):
    """A layer as the scene has it, and as it was computed: parts over each other."""

    number: int
    parts: list[Mapping[str, Any]]
    bottom: float | None  # m, None for the last one

    @property
    def top(self) -> float:
        """The depth of its top (m)."""
        return float(self.parts[0].get("top_depth_m") or 0)

    @property
    def is_clay(self) -> bool:
        """Whether its strength is undrained: a cohesion without friction."""
        first = self.parts[0]
        clay = float(first.get("cohesion_Pa") or 0) > 0
        return str(first.get("law")) == "NGI-ADP" or (
            clay and not first.get("friction_angle_deg")
        )

    @property
    def is_sand(self) -> bool:
        """Whether it is soil with friction only."""
        first = self.parts[0]
        has_friction = first.get("friction_angle_deg") or first.get("relative_density")
        return bool(has_friction) and not first.get("cohesion_Pa")

    def values(self, name: str, unit: str) -> list[float | None]:
        """Return the number of each part."""
        nothing: tuple[float | None, str] = None, ""
        return [numbers_of(part).get((name, unit), nothing)[0] for part in self.parts]


def layers_of(scene: Mapping[str, Any]) -> list[Layer]:
    """Return the layers; parts that a scene does not number are layers."""
    parts = list(enumerate(scene.get("layers") or [], 1))
    groups = [
        (int(number), [part for _, part in group])
        for number, group in groupby(parts, lambda p: p[1].get("layer", p[0]))
    ]
    tops = [float(group[0].get("top_depth_m") or 0) for _, group in groups]
    return [
        Layer(number, group, bottom)
        for (number, group), bottom in zip(groups, [*tops[1:], None])
    ]


def numbers_of(layer: Mapping[str, Any]) -> Numbers:
    """Return value and entry of each number of a layer by its name and unit; unit
    weight, stress and strength before the others."""
    found: Numbers = {}

    def add(keys: Iterable[str]) -> None:
        for key in (key for key in keys if key in layer):
            (name, unit, entry), value = NAMES["layer"][key], layer[key]
            found[name, unit] = (None if value is None else float(value), entry)

    add(FIRST)
    if "law_entries" not in layer:
        for key, (name, unit) in NAMES["law"].items():
            if layer.get(key) is not None:
                found[name, unit] = (float(layer[key]), "")
    for item in layer.get("law_entries", []):
        found[item["entry"], item["unit"]] = (item["value"], item["entry"])
    add(key for key in NAMES["layer"] if key not in FIRST)
    return found


def line_of(layer: Layer, values: list[float]) -> tuple[float, float] | None:
    """Return value at the mudline and slope over depth of a number of the parts, None
    where it is no straight line. Each part has the number of its middle."""
    tops = [float(part.get("top_depth_m") or 0) for part in layer.parts]
    middles = (np.array(tops[:-1]) + tops[1:]) / 2
    if len(middles) < 2:
        return None
    known = np.array(values[:-1])
    slope, start = (float(x) for x in np.polyfit(middles, known, 1))
    if np.abs(start + slope * middles - known).max() > LINEAR * np.abs(known).max():
        return None
    return start, slope


def changing(run: Results, layer: Layer, values: list[float], unit: str) -> str:
    """Return a number that changes within a layer: how it depends on the depth d (m),
    and its range down to the depth of the caisson: "2 + 1.5 d kPa (2 to 24.5 kPa)"."""
    factor, name = scale_of(values, unit)
    name = readable(name)
    line = line_of(layer, values)
    lengths = (run.scene.get("skirt_length_m"), run.planned)
    deepest = max((float(x) for x in lengths if x), default=math.inf)
    deepest = min(layer.bottom or math.inf, deepest)
    if line is not None and math.isfinite(deepest):
        ends = [line[0] + line[1] * z for z in (layer.top, deepest)]
    else:
        tops = [float(part.get("top_depth_m") or 0) for part in layer.parts]
        ends = [v for v, top in zip(values, tops) if top <= deepest] or values
        ends = [min(ends), max(ends)]
    texts = [text_of(float(f"{end / factor:.3g}")) for end in ends]
    span = f"{' to '.join(dict.fromkeys(texts))} {name}".rstrip()
    if line is None:
        return span
    start, slope = (float(f"{x / factor:.3g}") for x in line)
    sign = "+" if slope > 0 else "\N{MINUS SIGN}"
    head = f"{text_of(start)} {sign} " if abs(start) > 1e-9 else ""
    return f"{head}{text_of(abs(slope))} d {name}".rstrip() + f" ({span})"


def number_in_words(run: Results, layer: Layer, name: str, unit: str) -> str:
    """Return a number of a layer with its unit; nothing where it has none."""
    known = [value for value in layer.values(name, unit) if value is not None]
    if not known:
        return ""
    if len(known) == len(layer.parts) and np.ptp(known) > 1e-6 * np.abs(known).max():
        return changing(run, layer, known, unit)
    factor, written = scale_of(known[:1], unit)
    space = "" if written == "degrees" else " "
    return f"{text_of(known[0] / factor)}{space}{readable(written)}".rstrip()


def kind_of(run: Results, layer: Layer) -> str:
    """Return what a layer is, and how its water was computed: "sand, drained"."""
    kind = "clay" if layer.is_clay else "sand" if layer.is_sand else "soil"
    how = run.entry("Water/Level")
    if layer.is_clay and how in ("", "drained", "seepage"):
        how = "undrained (total stress)"
    return f"{kind}, {how}" if how else kind


def drainage_of_run(run: Results) -> str:
    """Return how the water of all layers was computed, in words: "undrained clay (total
    stress)"; "sand drained, clay undrained (total stress)"."""
    kinds = dict.fromkeys(kind_of(run, x) for x in layers_of(run.scene))
    if len(kinds) == 1:
        kind, _, how = next(iter(kinds)).partition(", ")
        is_total = how.startswith("undrained (")
        return how.replace("undrained", f"undrained {kind}") if is_total else how
    levels = {kind.partition(", ")[2] for kind in kinds}
    if len(levels) == 1:
        return levels.pop()
    return ", ".join(kind.replace(", ", " ") for kind in kinds)


def use_of(run: Results) -> str:
    """Return what the numbers of a run are for: drainage, and how it is installed."""
    level = run.entry("Water/Level")
    if not caisson_of(run) or not level:
        return ""
    depth, is_closed = run.history["penetration_m"], is_sealed(run)
    goes_up = depth[-1] < depth[0]
    if goes_up and is_retrieval(run):
        how = "pushed out by water"
    elif is_closed or goes_up:
        lid = "sealed lid" if is_closed else "open lid"
        how = f"{lid}, pulled up" if goes_up else lid
    else:
        how = "by weight and suction" if run.weight else "jacked"
    return f"{drainage_of_run(run) or level}, {how}"


def strength_of(run: Results, layer: Layer) -> dict[str, str]:
    """Return what decides the strength of a layer, in words, by its entries."""
    name, found = STRENGTH[0], dict[str, str]()
    cohesion = number_in_words(run, layer, *STRENGTH)
    if layer.is_clay and cohesion:
        return {name: f"s_u = {cohesion}"}
    density = layer.parts[0].get("relative_density")
    if density is not None:
        found["Relative density"] = f"D_r = {100 * float(density):.3g} %"
    elif angle := layer.parts[0].get("friction_angle_deg"):
        found["Friction angle"] = f"φ = {float(angle):.3g}°"
    if layer.parts[0].get("cohesion_Pa"):
        found[name] = f"c = {cohesion}"
    return found


def is_given(run: Results, layer: Layer, *entries: str) -> bool:
    """Return whether the scene marks no entry of a layer as assumed."""
    section = f"{SOIL} {layer.number}"
    return not any(is_assumed(run, f"{section}/{entry}") for entry in entries)


def cell_of(run: Results, layer: Layer, name: str, unit: str) -> tuple[str, bool]:
    """Return a number of a layer in words, and whether it is assumed."""
    entry = numbers_of(layer.parts[0]).get((name, unit), (None, ""))[1]
    is_assumed_here = bool(entry) and not is_given(run, layer, entry)
    return number_in_words(run, layer, name, unit), is_assumed_here


def soil_table(run: Results) -> dict[str, Any]:
    """Return the table with a row for each layer: heads, and rows of (text, whether
    assumed)."""
    shown, rows, columns = run.shown, [], NAMES["columns"]
    for layer in layers_of(run.scene):
        strength = strength_of(run, layer)
        cells = [
            (str(layer.number), False),
            (f"{shown.factor('m') * layer.top:.6g}", False),
            (kind_of(run, layer), False),
            (", ".join(strength.values()), not is_given(run, layer, *strength)),
        ]
        rows.append(cells + [cell_of(run, layer, *key) for key in columns.values()])
    heads = ["layer", shown.named("from (m)"), "soil", "strength", *columns]
    used = [i for i in range(len(heads)) if any(row[i][0] for row in rows)]
    return {
        "heads": [heads[i] for i in used],
        "rows": [[row[i] for i in used] for row in rows],
    }


def layers_table(run: Results) -> dict[str, Any]:
    """Return the table of all numbers of the layers, a row for each and a column for
    each layer: heads, and rows of (text, assumed)."""
    layers = layers_of(run.scene)
    laws = [(str(layer.parts[0].get("law", "")), False) for layer in layers]
    rows = [[("law", False), *laws]]
    for key in {key: None for x in layers for key in numbers_of(x.parts[0])}:
        name = readable(NAMES["entries"].get(key[0], key[0]))
        rows.append([(name, False), *(cell_of(run, layer, *key) for layer in layers)])
    return {"heads": ["layer", *(str(x.number) for x in layers)], "rows": rows}
