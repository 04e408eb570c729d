# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance in layers of sand and clay.

Clay has the adhesion and N_c s_u (clay), and sand k_p q_c and k_f q_c (dnv): friction
is summed over the layers, and the tip is in one of them, at a boundary in the upper
one. The lower case is the strip with the most probable coefficients, the upper one the
circle with the highest. A tip feels a layer before it is there, which is left out.

The forces are those of jacking. Suction takes from them in sand through which water
flows up to the lid, not in sand below clay.
"""
from caisson.design import dnv
from caisson.design.clay import CASES, Clay
from caisson.design.cone import Profile
from caisson.design.method import Forces


class Layered:
    """The method for one caisson."""

    cases = CASES

    def __init__(self, clay: Clay, profile: Profile) -> None:
        """clay: of all layers; profile: the cone resistance in those of sand."""
        self.clay, self.profile = clay, profile
        soils = [(x.top, "" if x.strength else "sand") for x in clay.layers]
        self.sand = dnv.method(clay.skirt, profile, soils)

    def forces(self, h: float, case: str) -> Forces:
        """Return the forces at an embedment."""
        clay = self.clay.forces(h, case)
        sand = self.sand.forces(h, dnv.CASES[CASES.index(case)])
        return Forces(*(a + b for a, b in zip(clay, sand)))
