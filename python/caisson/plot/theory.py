# SPDX-License-Identifier: LGPL-2.1-or-later
"""The range of Houlsby and Byrne (2005) for the scene of a run, where it holds."""
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from caisson.design.houlsby_byrne import Caisson, Layer

Scene = Mapping[str, Any]
# The laws whose strength is one friction angle; run.json names the law of a layer.
LAWS = ("Mohr-Coulomb",)


class NotApplicable(Exception):
    """Why the theory says nothing about a scene; the text is for the picture."""


def layer_of(entry: Scene, number: int) -> Layer:
    """Return a layer of run.json. Raises NotApplicable where the theory, which is
    made for sand without cohesion and with one friction angle, does not know it."""
    law = entry.get("law", LAWS[0])
    if law not in LAWS:
        raise NotApplicable(f"layer {number} is {law}")
    if not entry.get("friction_angle_deg"):
        raise NotApplicable(f"layer {number} has no friction angle")
    if (entry.get("cohesion_Pa") or 0) > 0:
        raise NotApplicable(f"layer {number} has cohesion")
    if entry.get("K0") is None:
        raise NotApplicable(f"layer {number} has no K0")
    return Layer(
        top=float(entry.get("top_depth_m") or 0),
        unit_weight=float(entry["submerged_unit_weight_N_m3"]),
        friction_angle=float(entry["friction_angle_deg"]),
        lateral_stress_ratio=float(entry["K0"]),
    )


def caisson_of(scene: Scene) -> Caisson:
    """Return the caisson of the scene of run.json. Raises NotApplicable.

    Older files have no list of layers, but what counts for the only layer.
    """
    missing = [n for n in ("diameter_m", "wall_thickness_m") if scene.get(n) is None]
    if missing:
        raise NotApplicable("the body is no caisson")
    layers = scene.get("layers", [scene])
    try:
        return Caisson(
            float(scene["diameter_m"]),
            float(scene["wall_thickness_m"]),
            [layer_of(entry, i) for i, entry in enumerate(layers, 1)],
            *(wall_friction(scene, side) for side in ("inner", "outer")),
        )
    except KeyError as error:
        raise NotApplicable(f"run.json does not tell {error.args[0]}") from error


def wall_friction(scene: Scene, side: str) -> float:
    """Return the friction angle of a wall in degrees."""
    both = scene.get("wall_friction_angle_deg")
    value = scene.get(f"{side}_wall_friction_angle_deg", both)
    if value is None:
        raise NotApplicable(f"run.json does not tell the friction of the {side} wall")
    return float(value)


@dataclass(frozen=True)
class Bands:
    """The theory over depth: forces [n] (N) at embedments depth [n] (m), each
    without and with stress enhancement; none, and why not."""

    depth: np.ndarray
    forces: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    why_not: str = ""


def bands_of(scene: Scene, deepest: float) -> Bands:
    """Return the bands of tip, inner and outer friction down to an embedment."""
    h = np.linspace(0, deepest, 100)
    try:
        caisson = caisson_of(scene)
    except NotApplicable as reason:
        return Bands(h, why_not=str(reason))
    forces = {
        "tip": caisson.tip,
        "inner friction": caisson.inner_friction,
        "outer friction": caisson.outer_friction,
    }
    found = {
        name: (
            np.array([force(x, False) for x in h]),
            np.array([force(x, True) for x in h]),
        )
        for name, force in forces.items()
    }
    return Bands(h, found)
