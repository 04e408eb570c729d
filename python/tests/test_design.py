# SPDX-License-Identifier: LGPL-2.1-or-later
"""Houlsby and Byrne, and cavity expansion, against values computed independently."""
import unittest
from itertools import pairwise
from typing import Any

import numpy as np

from caisson_design.houlsby_byrne import (
    UNDISTURBED,
    Assumptions,
    Caisson,
    Layer,
    Seepage,
    bearing_factor_weight,
    method,
)
from lab.verification.cavity_mohr_coulomb.cavity_expansion import (
    MohrCoulomb,
    Tresca,
    comparison,
)
from lab.verification.footing_sand.bearing_capacity import (
    Footing,
    converged,
    factors,
    pressure,
)

SAND = Layer(top=0, unit_weight=8829, friction_angle=30, lateral_stress_ratio=0.5)
# kN, D = 6 m: {h: (tip of walls of 0.05, 0.1, 0.2 m, outer friction)}, each without
# and with stress enhancement
TABLE: dict[float, tuple[list[float], list[float]]] = {
    2: ([307, 341, 614, 685, 1232, 1374], [60.6, 64.7]),
    5: ([762, 983, 1518, 1962, 3008, 3905], [378.6, 448]),
    6.5: ([990, 1382, 1969, 2752, 3896, 5459], [639.8, 799]),
}
# limit pressure over p0 of (G/p0, dilatancy angle)
LIMITS = {(50, 0): 6.312, (50, 30): 11.641, (100, 0): 7.914, (100, 30): 16.194}


def caisson(wall: float, *layers: Layer, angles: tuple[float, float] = (20, 20)) -> Any:
    """Return a caisson of 6 m."""
    return Caisson(6, wall, layers or [SAND], *angles)


# bearing capacity of weightless soil by Martin (2005), Proc. 11th IACMAG, and of
# clay by Eason and Shield (1960): (phi, circular, rough): factor
NC = {(False, False): 5.1416, (True, False): 5.689, (True, True): 6.048}
NQ = {(False, False): 18.401, (True, False): 29.455, (True, True): 37.205}
# Ngamma of a smooth and a rough strip, 30 degrees (Martin 2005)
NGAMMA = {False: 7.653, True: 14.754}


class BearingCapacity(unittest.TestCase):
    """Factors of footings, to four digits of the published ones."""

    def test_clay(self) -> None:
        for (circular, rough), exact in NC.items():
            found = factors(Footing(0, circular, rough), 40)["Nc"]
            np.testing.assert_allclose(found, exact, rtol=2e-4)

    def test_strength_that_grows(self) -> None:
        """A strip on 1 + k z, of half-width 1. For small k, the mechanism of Hill
        dissipates 2 + pi + 2 k: its slip lines at 45 degrees bear 0.25 k each, the arc
        k, and the fan k / 2. The rough strip bears more."""
        smooth = [self.gradient(k, rough=False) for k in (0.0, 0.01, 2.0)]
        self.assertAlmostEqual(smooth[0], 2 + np.pi, places=4)
        self.assertAlmostEqual((smooth[1] - smooth[0]) / 0.01, 2.0, delta=0.03)
        self.assertLess(smooth[2], self.gradient(2.0, rough=True))
        self.assertAlmostEqual(smooth[2], self.gradient(2.0, False, 40), delta=0.01)

    @staticmethod
    def gradient(k: float, rough: bool, lines: int = 80) -> float:
        """Return the pressure on a strip on clay of the strength 1 + k z."""
        footing = Footing(0.0, False, rough, cohesion=1.0, gradient=k)
        return converged(footing, lines)

    def test_surcharge(self) -> None:
        for (circular, rough), exact in NQ.items():
            found = factors(Footing(30, circular, rough), 60, False)
            np.testing.assert_allclose(found["Nq"], exact, rtol=2e-4)
            np.testing.assert_allclose(found["Nc"], (exact - 1) * np.sqrt(3), rtol=2e-4)

    def test_prandtl_at_all_angles(self) -> None:
        for phi in np.radians([20, 25, 35, 40, 45]):
            exact = np.exp(np.pi * np.tan(phi)) * np.tan(np.pi / 4 + phi / 2) ** 2
            footing = Footing(np.degrees(phi), False, False, surcharge=1)
            np.testing.assert_allclose(pressure(footing, 20), exact, rtol=1e-9)

    def test_weight(self) -> None:
        for rough, lines in ((False, 120), (True, 40)):
            heavy = Footing(30, False, rough, surcharge=1e-6, weight=1)
            np.testing.assert_allclose(
                converged(heavy, lines),
                NGAMMA[rough],
                rtol=1e-3 if lines > 40 else 3e-3,
            )

    def test_order_of_the_differences(self) -> None:
        footing = Footing(30, True, False, surcharge=1)
        error = [pressure(footing, n) / 29.4541 - 1 for n in (40, 80, 160)]
        self.assertGreater(np.log2(error[0] / error[1]), 1.7)
        self.assertGreater(np.log2(error[1] / error[2]), 1.7)

    def test_a_load_that_is_shared(self) -> None:
        """Cohesion is a pressure on all sides: one net answers for both."""
        angle = np.radians(30)
        both = Footing(30, True, False, cohesion=2, surcharge=3)
        one = Footing(30, True, False, surcharge=3 + 2 / np.tan(angle))
        self.assertAlmostEqual(
            pressure(both, 40) + 2 / np.tan(angle), pressure(one, 40), places=8
        )


class HoulsbyByrne(unittest.TestCase):
    """Resistance of a caisson."""

    def test_table(self) -> None:
        for h, (tips, frictions) in TABLE.items():
            bodies = [caisson(wall) for wall in (0.05, 0.1, 0.2)]
            found = [body.tip(h, e) for body in bodies for e in (False, True)]
            found += [bodies[0].outer_friction(h, e) for e in (False, True)]
            np.testing.assert_allclose(
                np.array(found) / 1e3, tips + frictions, rtol=2e-3
            )

    def test_equal_layers_are_one(self) -> None:
        halves = [Layer(top, 8829, 30, 0.5) for top in (0, 1.3, 3.1)]
        one, many = caisson(0.2), caisson(0.2, *halves)
        for h in (0.5, 1.3, 2, 5):
            for e in (False, True):
                self.assertAlmostEqual(many.tip(h, e) / one.tip(h, e), 1, places=12)
                self.assertAlmostEqual(
                    many.inner_friction(h, e) / one.inner_friction(h, e), 1, places=12
                )

    def test_two_layers_by_hand(self) -> None:
        """Plain: stress 10 kPa at 1 m, 30 kPa at 2 m; K tan(delta) 0.5 and 0.25."""
        body = Caisson(
            6, 0.2, [Layer(0, 10e3, 30, 0.5), Layer(1, 20e3, 40, 0.25)], 45, 45
        )
        friction = np.pi * 6 * (0.5 * 5e3 + 0.25 * (10e3 + 10e3))
        self.assertAlmostEqual(body.outer_friction(2, False), friction, places=6)
        strong = caisson(0.2, Layer(0, 10e3, 40, 0.5), angles=(45, 45))
        # the tip is in the second layer: its angle counts, under 30 kPa
        self.assertGreater(body.tip(2, False), strong.tip(2, False))
        self.assertLess(body.tip(1, False), 0.5 * strong.tip(1, False))

    def test_range_by_integration(self) -> None:
        """The stress and the friction of each K tan(delta), by small steps in depth;
        two layers, whose K0 and friction angles of the wall do not count."""
        layers = [Layer(0, 8e3, 30, 0.5), Layer(1.5, 10e3, 35, 0.4, 25)]
        byrne = method(6, 0.1, layers, (20, 20), Assumptions())
        n, h = 20000, 4.0
        for case, k in (("low", 0.45), ("high", 0.8)):
            found, ends = byrne.forces(h, case), []
            for wall, reach in ((5.8, 5.8 / 4), (6.0, 6 * (1.5**2 - 1) / 4)):
                stress = friction = 0.0
                for z in (np.arange(n) + 0.5) * h / n:
                    slope = (8e3 if z < 1.5 else 10e3) + stress * k / reach
                    middle = stress + slope * h / n / 2
                    friction += k * middle * np.pi * wall * h / n
                    stress += slope * h / n + (slope * h / n) * k / reach * h / n / 2
                ends.append((stress, friction))
            (inner, friction_in), (outer, friction_out) = ends
            np.testing.assert_allclose(found.inner_friction, friction_in, rtol=1e-3)
            np.testing.assert_allclose(found.outer_friction, friction_out, rtol=1e-3)
            # the lower stress bears all: N_q of 35 degrees is 33.296
            self.assertGreater(abs(outer - inner) * 33.296, 2 * 0.1 * 10e3 * 34.476)
            tip = min(inner, outer) * 33.296 + 0.1 * 10e3 * 34.476
            np.testing.assert_allclose(found.tip, tip * np.pi * 5.9 * 0.1, rtol=1e-3)

    def test_range_by_hand(self) -> None:
        """Without enhancement at 2 m: 0.45 and 0.8 8829 2^2 / 2 pi 6 N on the outer
        wall; 0.5 tan(20) in undisturbed ground, where a smooth wall has nothing."""
        plain = Assumptions(load_spread=None, k_tan_delta_inside=(0.3, 0.3))
        byrne = method(6, 0.1, [SAND], (20, 20), plain)
        stress = 8829 * 2**2 / 2 * np.pi
        for case, k in (("low", 0.45), ("high", 0.8), (UNDISTURBED, 0.1819851)):
            found = byrne.forces(2, case)
            self.assertAlmostEqual(found.outer_friction / (k * stress * 6), 1, 6)
            k_in = k if case == UNDISTURBED else 0.3
            self.assertAlmostEqual(found.inner_friction / (k_in * stress * 5.8), 1, 6)
            self.assertAlmostEqual(found.tip / 614e3, 1, delta=2e-3)
        smooth = method(6, 0.1, [SAND], (0, 20), Assumptions())
        for case in (*smooth.cases, UNDISTURBED):
            self.assertEqual(smooth.forces(2, case).inner_friction, 0)

    def test_friction_as_k_tan_delta(self) -> None:
        """The inverse of the plain friction, also under flow and in layers."""
        layers = [Layer(0, 8e3, 30, 0.5), Layer(1.5, 10e3, 35, 0.5)]
        body = Caisson(6, 0.1, layers, 20, 20, k_tan_delta=(0.6, 0.7))
        for flow in (Seepage(), Seepage(3e3, -2e3)):
            friction = body.outer_friction(4, False, flow)
            self.assertAlmostEqual(body.k_tan_delta_of(friction, 4, flow), 0.7)
        self.assertTrue(np.isnan(body.k_tan_delta_of(0, 0, Seepage())))

    def test_each_wall_has_its_friction(self) -> None:
        body = caisson(0.2, angles=(0, 20))
        self.assertEqual(body.inner_friction(3, True), 0)
        self.assertAlmostEqual(
            body.outer_friction(3, True), caisson(0.2).outer_friction(3, True)
        )

    def test_bearing_factor(self) -> None:
        """Between entries it grows, outside the table it is 0."""
        angles = np.linspace(15, 45, 61)
        factors = [bearing_factor_weight(angle) for angle in angles]
        self.assertTrue(all(a < b for a, b in pairwise(factors)))
        self.assertEqual(bearing_factor_weight(50), 0)


class CavityExpansion(unittest.TestCase):
    """Pressure in a growing cavity."""

    def test_limit_pressures(self) -> None:
        for (stiffness, psi), limit in LIMITS.items():
            soil = MohrCoulomb(1, 2.6 * stiffness, 0.3, 0, 30, psi)
            self.assertAlmostEqual(soil.pressure(1e9) / limit, 1, delta=2e-4)

    def test_pressure_and_ratio_are_inverse(self) -> None:
        soil = MohrCoulomb(1e5, 13e6, 0.3, 0, 30, 0)
        for ratio in (1.5, 2, 4):
            self.assertAlmostEqual(soil.ratio(soil.pressure(ratio)), ratio, places=9)

    def test_tresca(self) -> None:
        """su (1 + ln(G / su)) beyond p0 in the limit, G (1 - 1/r^2) before yield."""
        soil = Tresca(1e5, 5e6, 1e5)
        limit = 1e5 + 1e5 * (1 + np.log(50))
        self.assertAlmostEqual(soil.pressure(1e9), limit, places=3)
        elastic = 1e5 + 5e6 * (1 - 1.001**-2)
        self.assertAlmostEqual(soil.pressure(1.001), elastic, places=6)

    def test_comparison(self) -> None:
        """Rows are compared in the middle of their interval."""
        soil = Tresca(0, 5e6, 1e5)
        history = {
            "penetration_m": np.array([0.0, 0.5]),
            "cavity_pressure_Pa": np.array([0.0, 1.1 * soil.pressure(1.5)]),
        }
        ((ratio, _, exact, error),) = comparison(history, soil, 0.5)
        self.assertEqual((ratio, exact), (1.5, soil.pressure(1.5)))
        self.assertAlmostEqual(error, 0.1)


if __name__ == "__main__":
    unittest.main()
