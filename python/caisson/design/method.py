# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all methods for the penetration resistance of a caisson have in common.

A method knows the caisson and the layers of the soil, and returns the forces at each
embedment for two cases: a lower one, which is the first, and an upper one. What the
cases mean is the method's own: without and with stress enhancement, most probable and
highest, or the ends of a range of coefficients.

SI units; forces are those of the whole circumference, upward positive.
"""
from collections.abc import Callable, Iterable, Sequence
from math import inf
from typing import Any, NamedTuple, Protocol

import numpy as np

from caisson.ledges import Ledge


class Forces(NamedTuple):
    """The forces at one embedment (N)."""

    tip: float
    inner_friction: float
    outer_friction: float

    @property
    def total(self) -> float:
        """The penetration resistance (N)."""
        return self.tip + self.inner_friction + self.outer_friction


def with_ledges(
    forces: Forces,
    ledges: Iterable[Ledge],
    h: float,
    pressure: Callable[[Ledge, float], float],
) -> Forces:
    """Return forces at an embedment (m) with what bears on the ledges that are in the
    soil: inside it is a part of the tip force, and outside one of the outer friction.
    pressure: on a ledge at a depth (Pa)."""
    more = {True: 0.0, False: 0.0}
    for x in ledges:
        if (z := h - x.height) > 0:
            more[x.is_inside] += x.area * pressure(x, z)
    tip, inner, outer = forces
    return Forces(tip + more[True], inner, outer + more[False])


class Method(Protocol):
    """A design method for one caisson in one soil."""

    cases: tuple[str, str]

    def forces(self, h: float, case: str) -> Forces:
        """Return the forces at the embedment h (m) of the tip in one of the cases;
        nan where the method has no answer at this embedment."""


def between(layers: Sequence[Any], top: float, bottom: float) -> np.ndarray:
    """Return how much of each layer, from the mudline down, is between two depths (m),
    [n]."""
    tops = np.array([layer.top for layer in layers])
    bottoms = np.append(tops[1:], inf)
    return np.maximum(np.minimum(bottoms, bottom) - np.maximum(tops, top), 0.0)


def vertical_stress(layers: Sequence[Any], h: float) -> float:
    """Return the effective vertical stress at rest at a depth (m) in layers with a unit
    weight (Pa)."""
    weights = np.array([layer.unit_weight for layer in layers])
    return float(weights @ between(layers, 0.0, h))
