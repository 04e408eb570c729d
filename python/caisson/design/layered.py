# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance in layers of sand and clay.

Clay has the adhesion and N_c s_u (clay), and sand what a method for sand says: friction
is summed over the layers, and the tip is in one of them, at a boundary in the upper
one. Beside the lower case of the method for sand clay is a strip, and beside the upper
one a circle. A tip feels a layer before it is there, which is left out, so that a thin
layer bears as a thick one does.

The forces are those of jacking. Suction takes from them in sand through which water
flows up to the lid, not in sand below clay.
"""
from collections.abc import Mapping
from typing import Any

from caisson.design.clay import CASES, Clay
from caisson.design.method import Forces


class Layered:
    """The method for one caisson."""

    def __init__(self, clay: Clay, sand: Any, cases: Mapping[str, str]) -> None:
        """clay: of all layers; sand: a method that has nothing in clay; cases: what its
        cases are called here, the lower and the upper one, and any others."""
        self.clay, self.sand = clay, sand
        lower, upper, *_ = cases
        self.cases = lower, upper
        pairs = dict(zip(sand.cases, CASES))
        self.pairs = {x: (pairs.get(y, CASES[0]), y) for x, y in cases.items()}

    def forces(self, h: float, case: str) -> Forces:
        """Return the forces at an embedment."""
        of_clay, of_sand = self.pairs[case]
        pair = self.clay.forces(h, of_clay), self.sand.forces(h, of_sand)
        return Forces(*(a + b for a, b in zip(*pair)))
