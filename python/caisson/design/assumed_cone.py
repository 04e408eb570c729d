# SPDX-License-Identifier: LGPL-2.1-or-later
"""A cone resistance for ground of sand where no cone test is given.

It follows from the relative density D_r of the layers (density.cone_resistance) or,
where that is not known, from a D_r that gives sand its friction angle under a tip
(density.density_of_angle). It is an assumption: methods that were fitted to measured
cone resistances lose a part of their worth with it. The chamber tests had 50 to 400
kPa, so that nothing is fitted near the mudline, where most of a skirt is.

SI units; z is the depth below the mudline (m).
"""
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from caisson.design import density
from caisson.design.cone import Profile
from caisson.design.method import vertical_stress
from caisson.template import ends

SOURCE = "Jamiolkowski et al. (2003)"
LEAST_STRESS = 10.0  # Pa, at the mudline
LEAST_OF_STRENGTH = 150e3  # Pa, that a strength by Bolton follows
STEP = 0.25  # m, of angles that change with depth
JUMP = 1e-6  # m, over which q_c becomes that of the next layer, below its top


class Sand(NamedTuple):
    """A layer of sand down to the top of the next one."""

    top: float  # m
    unit_weight: float  # effective, N/m3
    lateral_stress_ratio: float  # K0
    density: float | None  # D_r, if it is known
    friction_angle: float  # degrees; where D_r is known the critical one
    is_clay: bool = False  # of which no cone resistance is assumed: 0


class SandGround:
    """Stress, density and cone resistance of layers of sand."""

    def __init__(self, layers: Sequence[Sand]) -> None:
        """layers: from the mudline down."""
        self.layers = sorted(layers, key=lambda layer: layer.top)

    def layer_at(self, z: float) -> Sand:
        """Return the layer at a depth, at a boundary the upper one."""
        return [x for i, x in enumerate(self.layers) if i == 0 or x.top < z][-1]

    def stress_at(self, z: float) -> float:
        """Return the effective vertical stress."""
        return max(vertical_stress(self.layers, z), LEAST_STRESS)

    def mean_stress_at(self, z: float) -> float:
        """Return the effective mean stress."""
        return self.stress_at(z) * (1 + 2 * self.layer_at(z).lateral_stress_ratio) / 3

    def density_at(self, z: float) -> float:
        """Return D_r, that of the layer or that of its friction angle."""
        layer = self.layer_at(z)
        if layer.density is not None:
            return min(max(layer.density, 0.0), 1.0)
        stresses = self.stress_at(z), self.mean_stress_at(z)
        return float(density.density_of_angle(layer.friction_angle, *stresses))

    def resistance_at(self, z: float) -> float:
        """Return q_c (Pa)."""
        if self.layer_at(z).is_clay:
            return 0.0
        return float(
            density.cone_resistance(self.density_at(z), self.mean_stress_at(z))
        )

    def angle_at(self, z: float) -> float:
        """Return the peak friction angle by Bolton under a tip; of a layer with a known
        density. Below 150 kPa the stress has no more influence (Bolton 1987), as in the
        law by density and stress."""
        under_tip = np.sqrt(self.resistance_at(z) * self.stress_at(z))
        under_tip = max(under_tip, LEAST_OF_STRENGTH)
        critical = self.layer_at(z).friction_angle
        return float(density.bolton_angle(self.density_at(z), under_tip, critical))


def words(ground: SandGround, rows: np.ndarray, deepest: float) -> str:
    """Return what is assumed of ground at depths [n] (m), in sentences."""
    layers = [x for x in ground.layers if x.top < deepest]
    by_layer = []
    for layer, bottom in zip(layers, [*(x.top for x in layers[1:]), deepest]):
        top = max(layer.top, 0.05 * deepest)  # without what is close to the mudline
        found = [ground.density_at(z) for z in rows if top < z <= bottom]
        if found and not layer.is_clay:
            text = ends([100 * min(found), 100 * max(found)], ".0f")
            by_layer.append(f"{text} % from {layer.top:g} m")
    layers = [x for x in layers if not x.is_clay]
    from_angle = [x for x in layers if x.density is None]
    source = "from the friction angle by Bolton (1986)"
    if not from_angle:
        source = "of the sand"
    elif len(from_angle) < len(layers):
        source = f"of the sand, or {source}"
    more = ""
    if any(x.friction_angle <= density.CRITICAL_ANGLE for x in from_angle):
        more = (
            f" An angle of {density.CRITICAL_ANGLE:g} degrees or less does not tell"
            " looser sands apart, and the largest density is taken."
        )
    elif from_angle and any("100" in text for text in by_layer):
        more = " Sand of 100 % is the densest, and has a smaller angle there."
    return (
        "The cone resistance is ASSUMED, as no cone test is given: relative density"
        f" {source}, cone resistance from it by {SOURCE}: {', '.join(by_layer)}."
        f"{more} The formula was fitted at 50 to 400 kPa, not near the mudline."
    )


@lru_cache(maxsize=32)
def assumed_cone(layers: tuple[Sand, ...], deepest: float) -> Profile:
    """Return the cone resistance of layers of sand down to a depth (m); a report asks
    for it many times."""
    ground = SandGround(layers)
    tops = [x.top for x in ground.layers if 0 < x.top < deepest]
    rows = [deepest * (i / 200) ** 2 for i in range(1, 201)]
    rows += [top + side for top in tops for side in (0.0, JUMP)]
    rows.sort()
    found = Profile([0.0, *rows], [0.0, *map(ground.resistance_at, rows)])
    found.assumed = words(ground, found.depth, deepest)
    return found
