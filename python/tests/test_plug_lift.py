# SPDX-License-Identifier: LGPL-2.1-or-later
"""Limit loads of clay by finite elements, and the suction that lifts a plug."""
import unittest

import numpy as np
from scipy import sparse

from lab.verification import ring_bearing as ring
from lab.verification.bearing_capacity import Footing, pressure
from lab.verification.limit_analysis import (
    Mesh,
    Strength,
    graded,
    join,
    limit_load,
    soil_of,
)
from lab.verification.plug_lift import (
    Caisson,
    bearing_factor,
    by_hand,
    extrapolated,
    lift,
)


def footing(rough: bool, gradient: float, n: int) -> float:
    """Return the pressure that a circle of the radius 1 bears, by n cells in it."""
    far = graded(0, 2.5, n, 150)
    mesh = Mesh(join(graded(1, 0, n, 50), 1 + far), far)
    r, z = mesh.place.T
    base, end = (z == 0) & (r <= 1), (r == r.max()) | (z == z.max())
    mesh.fix(end | (r == 0) | (base & rough), 0)
    mesh.fix(end, 1)
    size = mesh.number(base)
    soil = soil_of(mesh, size, Strength(1, gradient))
    rows = [(soil.m, 1), (soil.m_and_q, 3)]
    return limit_load(rows, soil.volume, mesh.flux(base, 1, size))[0]


class ExactLimitLoads(unittest.TestCase):
    """Finite elements and exact solutions."""

    def test_footings(self) -> None:
        for rough, gradient in ((False, 0), (True, 0), (False, 2)):
            exact = pressure(Footing(0, True, rough, 1, gradient=gradient), 80)
            coarse, fine = (footing(rough, gradient, n) / exact for n in (4, 8))
            self.assertTrue(1 < fine < coarse)
            self.assertLess(fine, 1.018)

    def test_extrapolation(self) -> None:
        for order in (1, 1.5, 2):
            loads = [5 + (1 / n) ** order for n in (4, 8, 16)]
            self.assertAlmostEqual(extrapolated(loads), 5)

    def test_cylinder(self) -> None:
        """Pressure widens a thick cylinder that keeps its length."""
        mesh = Mesh(np.linspace(1, 3, 17), np.array([0.0, 1.0]))
        mesh.fix(mesh.place[:, 0] > 0, 1)
        size = mesh.number()
        soil = soil_of(mesh, size, Strength())
        load = mesh.flux(mesh.place[:, 0] == 1, 0, size)
        rows = [(soil.m, 1), (soil.m_and_q, 3)]
        found, _ = limit_load(rows, soil.volume, load)
        self.assertAlmostEqual(found / (2 * np.log(3)), 1, delta=5e-4)

    def test_tube(self) -> None:
        """In a tube that is open below, the plug slides as a whole."""
        mesh = Mesh(np.linspace(0, 1, 4), np.linspace(0, 3, 7))
        r, z = mesh.place.T
        mesh.fix((r == 0) | (r == 1), 0)
        size, strength = mesh.number(), Strength(1, 2)
        soil = soil_of(mesh, size, strength)
        slip = 0.5 * mesh.on_edges(r == 1, 1, strength).matrix(size)
        rows = [(sparse.vstack([soil.m, slip]).tocsr(), 1), (soil.m_and_q, 3)]
        found, v = limit_load(rows, soil.volume, -mesh.flux(z == 0, 1, size))
        self.assertAlmostEqual(found, 0.5 * 2 * 3 * (1 + 2 * 1.5), places=4)
        self.assertAlmostEqual(v[mesh.dofs[0, 1]], -2, places=4)


class RingBearing(unittest.TestCase):
    """What a ring inside a tube bears."""

    def test_strip(self) -> None:
        """A narrow ring on the surface, at the smooth wall, is half a smooth strip."""
        coarse, fine = (ring.bearing_factor(ring.Ring(0.05, 0), n) for n in (4, 8))
        self.assertTrue(2 + np.pi < fine < coarse)
        self.assertAlmostEqual((2 * fine - coarse) / (2 + np.pi), 1, delta=0.01)

    def test_column(self) -> None:
        """Clay that stands in the opening adds to the load, until it is high enough."""
        loads = [ring.bearing_factor(ring.Ring(0.25, h), 4) for h in (0, 0.1, 0.3, 0.6)]
        self.assertGreater(loads[1], 1.05 * loads[0])
        self.assertAlmostEqual(loads[3] / loads[2], 1, delta=1e-3)


class PlugLift(unittest.TestCase):
    """The suction that lifts the plug."""

    def test_adhesion(self) -> None:
        """Friction on the wall adds less than its strength: the clay below the tip of
        a smooth wall has to fail as well."""
        loads = [lift(Caisson(1, a), Strength(), 4) for a in (0, 1)]
        np.testing.assert_allclose(loads, [8.346, 10.736], rtol=1e-3)
        factor = bearing_factor(10.5, Caisson(1, 1), Strength())
        self.assertAlmostEqual(factor, 8.5)

    def test_domain_and_wall(self) -> None:
        """A thicker wall resists more; soil farther away does not matter."""
        thin, thick = (lift(Caisson(1, 1, t), Strength(), 4) for t in (0, 0.05))
        self.assertTrue(1 < thick / thin < 1.02)
        near, far = (lift(Caisson(1, 1), Strength(), 4, x) for x in (3, 4))
        self.assertAlmostEqual(near / far, 1, delta=0.01)

    def test_crust(self) -> None:
        """60 kPa over 10 kPa, 0.4 m below the tip: the design method is below."""
        caisson = Caisson(2.35, 0.5, thickness=0.1, radius=2.6)
        crust = Strength(60, layers=((2.75, 10),))
        found = lift(caisson, crust, 4)
        self.assertTrue(192 < found < 203, found)
        self.assertTrue(0.6 < by_hand(caisson, crust) / found < 1)

    def test_strength_that_grows(self) -> None:
        """Strength is a scale."""
        once, twice = (lift(Caisson(1), Strength(x, x), 3) for x in (1, 2))
        self.assertAlmostEqual(twice / once, 2, places=4)
