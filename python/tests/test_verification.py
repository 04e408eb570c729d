# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the verification computes itself: a damped wave, consolidation at large strain,
limit loads of clay by finite elements, and the suction that lifts a plug."""
import functools
import math
import unittest

import numpy as np
from scipy import sparse

from caisson.paths import ROOT
from lab.verification import damped_wave, ring_bearing as ring
from lab.verification.bearing_capacity import Footing, pressure
from lab.verification.consolidation import (
    checks,
    Column,
    constant,
    kozeny_carman,
    observations,
    TIME,
    times_to,
)
from lab.verification.limit_analysis import (
    graded,
    join,
    limit_load,
    Mesh,
    soil_of,
    Strength,
)
from lab.verification.plug_lift import (
    bearing_factor,
    by_hand,
    Caisson,
    extrapolated,
    lift,
)


class DampedWave(unittest.TestCase):
    """Its frequency and damping are found from 100 values in 2.2 periods."""

    def test_any_phase(self) -> None:
        for w, g, phase, offset in (
            (1400, 0, 0, 0),
            (1400, 7, 0, 0),
            (0.3, 0.006, 1, -10),
            (2, -0.01, 2.5, 3),
        ):
            with self.subTest(w=w, g=g):
                t = 0.022 * np.arange(100) * 2 * math.pi / w
                values = offset + np.exp(-g * t) * np.cos(w * t + phase)
                found = damped_wave.fit(5 + t, values)
                np.testing.assert_allclose(found, (w, g), rtol=1e-6, atol=1e-6 * w)


SCENE = ROOT / "lab/verification/consolidation_large.prm"
LADDER = ROOT / "lab/verification/ladder.toml"


def neumann(load: float) -> float:
    """Return the settlement over sqrt(c_v t) of an infinitely high column under a load
    over M that comes at once: the density of the grains diffuses evenly in space
    (1/w)_t = (1/w)_zz below a surface at z = -2 b sqrt(t), as in Stefan's problem."""
    density = math.exp(load)
    low, high = 0.0, 5.0
    while high - low > 1e-14:
        b = (low + high) / 2
        flow = (density - 1) / math.erfc(b) * math.exp(-b * b) / math.sqrt(math.pi)
        low, high = (b, high) if b * density < flow else (low, b)
    return 2 * b


class LargeStrain(unittest.TestCase):
    """The reference itself."""

    def test_similarity(self) -> None:
        """Until the base feels it, the settlement is that of Neumann's solution."""
        times = list(0.02 * np.arange(1, 41) ** 2 / 1600)
        errors = []
        for n_cells in (50, 100):
            column = Column(load=0.5, ramp=0, n_cells=n_cells)
            w = column.stretches(times, n_steps=4)[-1]
            exact = neumann(0.5) * math.sqrt(0.02)
            errors.append(abs(column.settlement(w) / exact - 1))
        self.assertLess(errors[1], 3e-4)
        self.assertGreater(errors[0] / errors[1], 3.2)

    def test_small_strain_is_terzaghi(self) -> None:
        times = list(0.3 * np.arange(1, 41) ** 2 / 1600)
        column = Column(load=1e-4, ramp=0, n_cells=100)
        w = column.stretches(times)[-1]
        m = (2 * np.arange(20) + 1) * math.pi / 2
        degree = 1 - float(np.sum(2 / m**2 * np.exp(-(m**2) * 0.3)))
        self.assertAlmostEqual(column.settlement(w) / (1e-4 * degree), 1, delta=3e-4)

    def test_converges_with_order_2(self) -> None:
        """Cells and steps halved; the law of the permeability is the strong one."""
        values = []
        for n in (40, 80, 160):
            column = Column(permeability=kozeny_carman(1.5), n_cells=n)
            w = column.stretches(times_to(0.3, column.ramp, n // 2))[-1]
            base = column.observed(w, 0.3)[1]
            values.append(np.array([column.settlement(w), base]))
        ratio = (values[0] - values[1]) / (values[1] - values[2])
        self.assertTrue(np.all(ratio > 3.5), ratio)

    def test_end(self) -> None:
        """In the end all layers have the stretch that bears the load."""
        column = Column(n_cells=40)
        w = column.stretches([*times_to(1, column.ramp), 10, 20], n_steps=8)[-1]
        self.assertAlmostEqual(column.settlement(w), 1 - math.exp(-0.5), 6)


class ConsolidationScene(unittest.TestCase):
    """The polynomials that the program is compared with."""

    def assert_checks(self, text: str, column: Column, end: float) -> None:
        """The checks in the text are those of the reference, but for rounding."""
        times, top, base = observations(column, end)
        expected = checks(column, end).split("; ")
        found = [part for part in text.split(";") if "trace" in part]
        self.assertEqual(len(found), 2)
        for own, other in zip(found, expected):
            self.assertEqual(own.split()[:4], other.split()[:4])
            formulas = [eval_at(part.split(":")[1], times) for part in (own, other)]
            after = times > 1.2 * column.ramp
            scale = np.abs(formulas[1]).max()
            self.assertLess(
                np.abs(formulas[0] - formulas[1])[after].max(), 1e-5 * scale
            )
        # and the polynomial is close to the reference itself
        error = np.abs(eval_at(found[0].split(":")[1], times) - top)[after].max()
        self.assertLess(error, 1e-4 * np.abs(top).max())

    def test_constant(self) -> None:
        text = SCENE.read_text(encoding="utf-8").replace("\\\n", "")
        line = next(line for line in text.splitlines() if "set Checks" in line)
        self.assert_checks(line.split("=", 1)[1], Column(permeability=constant), 0.3)

    def test_kozeny_carman(self) -> None:
        text = LADDER.read_text(encoding="utf-8").split("consolidation_large_kozeny")[1]
        entry = text.split('"Verification/Checks" = "')[1].split('"')[0]
        column = Column(permeability=kozeny_carman(1.5))
        self.assert_checks(entry, column, 1)


def eval_at(expression: str, times: np.ndarray) -> np.ndarray:
    """Return an expression of the program at times over H^2 / c_v. [n_times]"""
    names = {"t": TIME * times, "sqrt": np.sqrt}
    return np.asarray(eval(expression.strip(), {"__builtins__": {}}, names))


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
            exact = pressure(Footing(0, True, rough, 1, gradient=gradient), 40)
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
        coarse, fine = (ring.bearing_factor(ring.Ring(0.05, 0), n) for n in (3, 6))
        self.assertTrue(2 + np.pi < fine < coarse)
        self.assertAlmostEqual((2 * fine - coarse) / (2 + np.pi), 1, delta=0.01)

    def test_column(self) -> None:
        """Clay that stands in the opening adds to the load, until it is high enough."""
        loads = [ring.bearing_factor(ring.Ring(0.25, h), 3) for h in (0, 0.1, 0.3, 0.6)]
        self.assertGreater(loads[1], 1.05 * loads[0])
        self.assertAlmostEqual(loads[3] / loads[2], 1, delta=1e-3)


@functools.cache
def lifted(adhesion: float, thickness: float, extent: float) -> float:
    """Return the suction (Pa) by four cells inside; extent: of the soil (radii)."""
    return lift(Caisson(1, adhesion, thickness), Strength(), 4, extent)


class PlugLift(unittest.TestCase):
    """The suction that lifts the plug."""

    def test_adhesion(self) -> None:
        """Friction on the wall adds less than its strength: the clay below the tip of
        a smooth wall has to fail as well."""
        loads = [lifted(a, 0, 4) for a in (0, 1)]
        np.testing.assert_allclose(loads, [8.346, 10.736], rtol=1e-3)
        factor = bearing_factor(10.5, Caisson(1, 1), Strength())
        self.assertAlmostEqual(factor, 8.5)

    def test_domain_and_wall(self) -> None:
        """A thicker wall resists more; soil farther away does not matter."""
        thin, thick = (lifted(1, t, 4) for t in (0, 0.05))
        self.assertTrue(1 < thick / thin < 1.02)
        near, far = (lifted(1, 0, x) for x in (3, 4))
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


if __name__ == "__main__":
    unittest.main()
