# SPDX-License-Identifier: LGPL-2.1-or-later
"""Houlsby and Byrne, and cavity expansion, against values computed independently."""
import unittest
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.optimize import minimize

from caisson.design.houlsby_byrne import (
    UNDISTURBED,
    Assumptions,
    Caisson,
    Layer,
    Seepage,
    bearing_factor_weight,
    method,
)
from lab.verification.cavity_expansion import (
    MohrCoulomb,
    Tresca,
    comparison,
)
from lab.verification.bearing_capacity import (
    Footing,
    Mesh,
    RoughNet,
    converged,
    factors,
    pressure,
)
from lab.verification import tip_capacity as wall_tip
from lab.verification.tip_capacity import Side, Tip, weightless_tip

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


def caisson(
    wall: float,
    *layers: Layer,
    angles: tuple[float, float] = (20, 20),
    enhanced: bool = False,
) -> Any:
    """Return a caisson of 6 m."""
    return Caisson(6, wall, layers or [SAND], *angles, 1.5 if enhanced else None)


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
        self.assertAlmostEqual(smooth[2], self.gradient(2.0, False, 20), delta=0.01)

    @staticmethod
    def gradient(k: float, rough: bool, lines: int = 40) -> float:
        """Return the pressure on a strip on clay of the strength 1 + k z."""
        footing = Footing(0.0, False, rough, cohesion=1.0, gradient=k)
        return converged(footing, lines)

    def test_surcharge(self) -> None:
        for (circular, rough), exact in NQ.items():
            found = factors(Footing(30, circular, rough), 40, False)
            np.testing.assert_allclose(found["Nq"], exact, rtol=2e-4)
            np.testing.assert_allclose(found["Nc"], (exact - 1) * np.sqrt(3), rtol=2e-4)

    def test_prandtl_at_all_angles(self) -> None:
        for phi in np.radians([20, 25, 35, 40, 45]):
            exact = np.exp(np.pi * np.tan(phi)) * np.tan(np.pi / 4 + phi / 2) ** 2
            footing = Footing(np.degrees(phi), False, False, surcharge=1)
            np.testing.assert_allclose(pressure(footing, 20), exact, rtol=1e-9)

    def test_weight(self) -> None:
        for rough, lines in ((False, 60), (True, 40)):
            heavy = Footing(30, False, rough, surcharge=1e-6, weight=1)
            np.testing.assert_allclose(
                converged(heavy, lines),
                NGAMMA[rough],
                rtol=3e-3 if rough else 1e-3,
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


class TipOfAWall(unittest.TestCase):
    """What the tip of a wall bears between unequal surcharges."""

    @staticmethod
    def upper_bound(phi: float, ratio: float) -> float:
        """Return the least load of a wedge of soil that goes down between two fans,
        over sigma_o, by the work of the surcharges: over the angles of its faces."""
        angle = np.radians(phi)

        def load(faces: np.ndarray) -> float:
            work = 0.0
            for sigma, face, other in zip((1, ratio), faces, faces[::-1]):
                length = np.sin(other) / np.sin(sum(faces))
                velocity = np.cos(face - angle) / np.cos(angle)
                turn = 0.75 * np.pi + angle / 2 - face
                growth = np.exp(2 * np.tan(angle) * turn)
                work += sigma * length * velocity * (1 + np.sin(angle)) * growth
            return float(work)

        start = np.array([1.2, 0.8]) * (np.pi / 4 + angle / 2)
        return float(minimize(load, start, method="Nelder-Mead").fun)

    def test_nets_and_upper_bound(self) -> None:
        for phi, ratio in ((20, 0.6), (30, 1), (30, 0.5), (30, 0.2), (40, 0.1)):
            exact = weightless_tip(phi, 1.0, ratio)
            tip = Tip(phi, Side(1.0), Side(ratio))
            self.assertAlmostEqual(wall_tip.tip_pressure(tip, 10) / exact, 1, places=9)
            self.assertAlmostEqual(self.upper_bound(phi, ratio) / exact, 1, places=6)

    def test_one_sided(self) -> None:
        """All soil slips inwards, from a ratio of stresses on."""
        angle = np.radians(30)
        limit = np.exp(-(np.pi + 2 * angle) * np.tan(angle))
        near = weightless_tip(30, 1, limit * 1.0001) / limit
        self.assertAlmostEqual(near, wall_tip.one_sided_factor(30), places=2)
        one = wall_tip.one_sided(Tip(30, Side(1.0), Side(0.05)), 20)
        self.assertAlmostEqual(one, weightless_tip(30, 1, 0.05), places=6)
        self.assertEqual(weightless_tip(30, 1, 0), 0)

    def test_equal_sides_are_a_footing(self) -> None:
        tip = Tip(30, Side(10, 1), Side(10, 1))
        half = Footing(30, False, True, surcharge=10, weight=0.5)
        np.testing.assert_allclose(
            wall_tip.tip_pressure(tip, 14), pressure(half, 14), rtol=2e-4
        )

    def test_little_weight(self) -> None:
        """It adds the work of gravity in the mechanism of Prandtl, with fans of
        r = exp(theta tan phi) and faces of the width of the tip: for 30 degrees."""
        k, start = np.sqrt(3), np.pi / 3
        theta = np.linspace(0, np.pi / 2, 2001)
        rising = -0.5 * np.exp(k * theta) * np.cos(start + theta)
        fan = np.sum(0.5 * (rising[1:] + rising[:-1]) * np.diff(theta))
        wedge, passive = np.sqrt(3) / 4, np.exp(k * np.pi / 2) * 3 / 8
        exact = 2 * (fan + passive) - wedge
        tip = Tip(30, Side(1e3, 1), Side(1e3, 1))
        found = wall_tip.converged(tip, 20) - weightless_tip(30, 1e3, 1e3)
        self.assertAlmostEqual(found / exact, 1, delta=2e-3)

    def test_weight_of_one_side(self) -> None:
        """Nets converge with the second order, and each side's weight counts."""
        tip = wall_tip.flowing(30, 5, 0.5)
        loads = [wall_tip.tip_pressure(tip, n) for n in (10, 20, 40)]
        self.assertAlmostEqual(
            (loads[0] - loads[1]) / (loads[1] - loads[2]), 4, delta=1
        )
        light = Tip(30, Side(tip.outer.surcharge), Side(tip.inner.surcharge))
        inner = Tip(30, light.outer, tip.inner)
        found = [wall_tip.tip_pressure(x, 20) for x in (light, inner)]
        self.assertLess(found[0], found[1])
        self.assertLess(found[1], loads[1])

    def test_wedge(self) -> None:
        """The faces of the wedge of Prandtl are those of a rough wedge of steel; the
        two ways to fail have one load where they change."""
        self.assertAlmostEqual(
            wall_tip.weightless_wedge(30, 30, 60, 1, 1), wall_tip.prandtl(30)
        )
        omega = 0.5 * (np.radians(20) + np.arcsin(2 * np.sin(np.radians(20))))
        change = np.exp(-4 * np.tan(np.radians(30)) * (np.pi / 4 - omega))
        at = [wall_tip.weightless_wedge(30, 20, 45, 1, change * x) for x in (0.999, 1)]
        self.assertAlmostEqual(at[0] / at[1], 1, delta=1e-3)

    def test_a_net_that_is_too_short(self) -> None:
        with self.assertRaisesRegex(ValueError, "longer surface"):
            RoughNet(
                Footing(30, False, True, surcharge=10, weight=0.5), Mesh(20, 5.0, 60.0)
            ).pressure()


class HoulsbyByrne(unittest.TestCase):
    """Resistance of a caisson."""

    def test_table(self) -> None:
        for h, (tips, frictions) in TABLE.items():
            bodies = [
                caisson(wall, enhanced=e)
                for wall in (0.05, 0.1, 0.2)
                for e in (False, True)
            ]
            found = [body.forces(h).tip for body in bodies]
            found += [body.forces(h).outer_friction for body in bodies[:2]]
            np.testing.assert_allclose(
                np.array(found) / 1e3, tips + frictions, rtol=2e-3
            )

    def test_equal_layers_are_one(self) -> None:
        halves = [Layer(top, 8829, 30, 0.5) for top in (0, 1.3, 3.1)]
        for e in (False, True):
            one, many = caisson(0.2, enhanced=e), caisson(0.2, *halves, enhanced=e)
            for h in (0.5, 1.3, 2, 5):
                found, expected = many.forces(h), one.forces(h)
                np.testing.assert_allclose(found, expected, rtol=1e-12)

    def test_two_layers_by_hand(self) -> None:
        """Plain: stress 10 kPa at 1 m, 30 kPa at 2 m; K tan(delta) 0.5 and 0.25."""
        body = Caisson(
            6, 0.2, [Layer(0, 10e3, 30, 0.5), Layer(1, 20e3, 40, 0.25)], 45, 45
        )
        friction = np.pi * 6 * (0.5 * 5e3 + 0.25 * (10e3 + 10e3))
        self.assertAlmostEqual(body.forces(2).outer_friction, friction, places=6)
        strong = caisson(0.2, Layer(0, 10e3, 40, 0.5), angles=(45, 45))
        # the tip is in the second layer: its angle counts, under 30 kPa
        self.assertGreater(body.forces(2).tip, strong.forces(2).tip)
        self.assertLess(body.forces(1).tip, 0.5 * strong.forces(1).tip)

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
            friction = body.forces(4, flow).outer_friction
            self.assertAlmostEqual(body.k_tan_delta_of(friction, 4, flow), 0.7)
        self.assertTrue(np.isnan(body.k_tan_delta_of(0, 0, Seepage())))

    def test_each_wall_has_its_friction(self) -> None:
        body = caisson(0.2, angles=(0, 20), enhanced=True).forces(3)
        self.assertEqual(body.inner_friction, 0)
        both = caisson(0.2, enhanced=True).forces(3)
        self.assertAlmostEqual(body.outer_friction, both.outer_friction)

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

    def test_contraction(self) -> None:
        """With nu = 0.5 and psi = 0 no volume changes, and of a radius R of new yield
        the share u/a and the pressure have a closed form; before it, p - 2 G u/a."""
        soil, start, shear = MohrCoulomb(0, 15e6, 0.5, 0, 30, 0), 6e5, 5e6
        self.assertAlmostEqual(soil.contracted(start, 0.01), 5e5)
        for radius in (1.5, 4.0):
            edge = start * radius ** (-2 / 3)  # alpha is 3
            share = edge * 2 / 3 * radius**2 / (2 * shear)
            pressure = edge / 3 / radius**2
            found = soil.contracted(start, share)
            self.assertAlmostEqual(found / pressure, 1, places=5)

    def test_contraction_with_cohesion(self) -> None:
        """c cot(phi) shifts all pressures; of a small angle it is Tresca's law."""
        sand, soil = (MohrCoulomb(0, 13e6, 0.3, c, 30, 10) for c in (0, 1e4))
        shift = 1e4 / np.tan(np.radians(30))
        for share in (0.02, 0.08):
            found = soil.contracted(6e5 - shift, share) + shift
            self.assertAlmostEqual(found / sand.contracted(6e5, share), 1, places=9)
        clay, tresca = MohrCoulomb(0, 15e6, 0.5, 1e5, 0.01, 0), Tresca(0, 5e6, 1e5)
        for share in (0.01, 0.1):
            exact = tresca.contracted(5e5, share)
            self.assertAlmostEqual(clay.contracted(5e5, share), exact, delta=300)

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
