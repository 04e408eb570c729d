# SPDX-License-Identifier: LGPL-2.1-or-later
"""Installation by suction in sand, against formulas worked out by hand."""
import unittest
from collections.abc import Callable
from collections.abc import Sequence
from itertools import pairwise
from math import exp, isnan, pi, radians, sqrt, tan

import numpy as np

from caisson.design.houlsby_byrne import Caisson, Layer, Seepage
from caisson.design.method import Forces
from caisson.design import seepage as fits
from caisson.design import senders_randolph, unified
from caisson.design.cone import Profile, Skirt
from caisson.design.seepage import houlsby_byrne, pressure_factor
from caisson.design.suction_installation import (
    critical_suction,
    piping_suction,
    share_at_tip,
    relieved_suction,
    required_suction,
    self_weight_penetration,
)

DO, T, GAMMA, K = 6.0, 0.05, 9e3, 0.8
DI, K_TAN = DO - 2 * T, K * tan(radians(25))
RIM = pi * (DO - T) * T  # area of the end of the wall
AREA = pi * DI**2 / 4
CRITICAL_SUCTIONS: dict[str, Callable[[float, float, float], float]] = {
    "Houlsby & Byrne (2005)": fits.houlsby_byrne,
    "Senders & Randolph (2009)": fits.senders_randolph,
}
N_Q, N_GAMMA = 18.4011, 14.754  # of 30 degrees
SAND = Layer(0, GAMMA, 30, K)
WEIGHT = 600e3


def caisson(
    enhanced: bool, layers: Sequence[Layer] = (SAND,), angle: float = 25
) -> Caisson:
    """Return a caisson of 6 m with a wall of 0.05 m."""
    return Caisson(DO, T, layers, angle, angle, 1.5 if enhanced else None)


def stress_and_friction(
    weight: float, h: float, diameter: float, z: float
) -> tuple[float, float]:
    """Return the vertical stress at h and the friction down to it, in one layer.

    z: length of Houlsby and Byrne over which the stress grows; 0: plain.
    """
    if z == 0:
        return weight * h, weight * h**2 / 2 * K_TAN * pi * diameter
    stress = weight * z * (exp(h / z) - 1)
    integral = weight * z**2 * (exp(h / z) - 1 - h / z)
    return stress, integral * K_TAN * pi * diameter


def residual(
    suction: float, weight: float, h: float, kf: float, enhanced: bool
) -> float:
    """Return the resistance less V' + s A_i, where the soil flows all inwards."""
    a1 = 0.45 - 0.36 * (1 - exp(-h / DO / 0.48))
    a = a1 * kf / ((1 - a1) + a1 * kf)
    inside, outside = GAMMA - (1 - a) * suction / h, GAMMA + a * suction / h
    z_i, z_o = DI / (4 * K_TAN), DO * (1.5**2 - 1) / (4 * K_TAN)
    stress_i, friction_i = stress_and_friction(inside, h, DI, enhanced * z_i)
    stress_o, friction_o = stress_and_friction(outside, h, DO, enhanced * z_o)
    # the whole end of the wall yields to the inside
    assert stress_o - stress_i > 2 * T * inside * N_GAMMA / N_Q
    tip = (stress_i * N_Q + inside * T * N_GAMMA) * RIM
    return friction_o + friction_i + tip - weight - suction * AREA


class Fits(unittest.TestCase):
    """Functions of h / D."""

    def test_pressure_factor(self) -> None:
        self.assertAlmostEqual(pressure_factor(0), 0.45)
        self.assertAlmostEqual(pressure_factor(100), 0.09)
        # 0.45 - 0.36 (1 - exp(-1)), and three times the permeability inside
        self.assertAlmostEqual(pressure_factor(0.48), 0.222437, places=6)
        self.assertAlmostEqual(pressure_factor(0.48, 1.0), 0.222437, places=6)
        self.assertAlmostEqual(pressure_factor(0.48, 3.0), 0.461847, places=6)
        self.assertLess(pressure_factor(0.48, 0.5), 0.222437)

    def test_critical_suctions(self) -> None:
        """Over gamma' h at h / D = 0.5, where 0.5^0.85 is 0.554785."""
        by_hand = {
            "Houlsby & Byrne (2005)": 1.27719,  # 1 / (1 - 0.217032)
            "Senders & Randolph (2009)": 1.47168,  # pi - 1.22480 1.363380
        }
        self.assertEqual(set(by_hand), set(CRITICAL_SUCTIONS))
        for name, ratio in by_hand.items():
            found = CRITICAL_SUCTIONS[name](10e3, 4, 8) / 40e3
            self.assertAlmostEqual(found, ratio, places=4, msg=name)

    def test_limits_of_the_critical_suction(self) -> None:
        """Senders and Randolph: pi at the surface, 1 in a long column."""
        found = CRITICAL_SUCTIONS["Senders & Randolph (2009)"]
        self.assertAlmostEqual(found(10e3, 1e-9, 1) / 1e-5, pi, places=5)
        self.assertAlmostEqual(found(10e3, 1e9, 1) / 1e13, 1, places=5)


class Flow(unittest.TestCase):
    """Forces of Caisson under flow."""

    def test_two_layers_by_hand(self) -> None:
        """Flow adds 4 kPa/m outside to 6 and 16, and takes 8 inside, but not
        below 0; K tan(delta) is 0.5 and 0.25."""
        layers = [Layer(0, 6e3, 30, 0.5), Layer(1, 16e3, 30, 0.25)]
        body, flow = caisson(False, layers, 45), Seepage(4e3, -8e3)
        outer = pi * DO * (0.5 * 5e3 + 0.25 * (10e3 + 10e3))
        self.assertAlmostEqual(body.forces(2, flow).outer_friction / outer, 1)
        inner = pi * DI * 0.25 * 4e3
        self.assertAlmostEqual(body.forces(2, flow).inner_friction / inner, 1)
        # 30 kPa outside, 8 kPa inside: the soil flows inwards
        tip = (8e3 * N_Q + 8e3 * T * N_GAMMA) * RIM
        self.assertAlmostEqual(body.forces(2, flow).tip / tip, 1, places=5)

    def test_tip_that_yields_to_both_sides(self) -> None:
        """At 1 m: 9.1 kPa outside, 8.7 kPa inside."""
        flow, weight = Seepage(100, -300), 8.7e3
        x = T / 2 + 400 * N_Q / (4 * weight * N_GAMMA)
        end = 9.1e3 * N_Q + weight * N_GAMMA * (T - 2 * x**2 / T)
        self.assertLess(x, T)
        self.assertAlmostEqual(
            caisson(False).forces(1, flow).tip / (end * RIM), 1, places=5
        )

    def test_no_weight_at_the_tip(self) -> None:
        flow = Seepage(3e3, -GAMMA)
        self.assertEqual(caisson(True).forces(2, flow).tip, 0)
        self.assertEqual(caisson(True).forces(2, flow).inner_friction, 0)

    def test_resistance_is_the_sum(self) -> None:
        flow = Seepage(3e3, -4e3)
        for body in (caisson(False), caisson(True)):
            total = body.forces(2, flow).total
            self.assertAlmostEqual(body.resistance(2, flow) / total, 1)


def rest_of(body: Caisson, weight: float, deepest: float) -> float:
    """Return the penetration by weight (m)."""
    tops = [layer.top for layer in body.layers]
    return self_weight_penetration(body.resistance, weight, deepest, tops)


class SelfWeight(unittest.TestCase):
    """Penetration without suction."""

    def test_resistance_is_the_weight(self) -> None:
        for body in (caisson(False), caisson(True)):
            h = rest_of(body, WEIGHT, 6)
            self.assertAlmostEqual(body.resistance(h) / WEIGHT, 1)

    def test_by_hand(self) -> None:
        """Plain: a h^2 + b h + c = V'."""
        a = GAMMA / 2 * K_TAN * pi * (DO + DI)
        b, c = GAMMA * N_Q * RIM, GAMMA * T / 2 * N_GAMMA * RIM
        h = (-b + np.sqrt(b**2 + 4 * a * (WEIGHT - c))) / (2 * a)
        found = rest_of(caisson(False), WEIGHT, 6)
        self.assertAlmostEqual(found, h, places=4)

    def test_it_stands_above_the_bottom_of_a_layer(self) -> None:
        """There the resistance of a tip falls, at 1 m to half; or within a layer."""
        for force, rest in (
            (lambda h: 10 * h * (1 if h < 1 else 0.5), 0.9),
            (lambda h: 10 * h if h < 0.97 else 5 * h, 0.9),
        ):
            found = self_weight_penetration(force, 9, 3, [0, 1])
            self.assertAlmostEqual(found, rest, places=9)

    def test_it_stands_on_the_first_strong_layer(self) -> None:
        """The resistance rises at 1 m and falls at 1.5 m without reaching it again
        before 3 m."""
        layers = [
            Layer(0, 9e3, 20, 0.5),
            Layer(1, 9e3, 40, 0.5),
            Layer(1.5, 9e3, 20, 0.5),
        ]
        body = caisson(False, layers)
        weight = (body.resistance(1) + body.resistance(1.01)) / 2
        self.assertGreater(weight, body.resistance(1.51))
        found = rest_of(body, weight, 3)
        self.assertAlmostEqual(found, 1, places=9)

    def test_none(self) -> None:
        self.assertTrue(np.isnan(rest_of(caisson(False), 1e8, 1)))
        self.assertEqual(rest_of(caisson(False), 0, 1), 0)


class HoulsbyByrne(unittest.TestCase):
    """Required suction with the flow in the unit weights."""

    def test_equilibrium(self) -> None:
        for h in (2.5, 4, 6):
            for kf in (1, 3):
                for enhanced in (False, True):
                    s = required_suction(caisson(enhanced), WEIGHT, h, kf)
                    left = residual(s, WEIGHT, h, kf, enhanced)
                    self.assertLess(abs(left) / (s * AREA), 1e-5, (h, kf, enhanced))

    def test_it_begins_at_the_self_weight_penetration(self) -> None:
        for body in (caisson(False), caisson(True)):
            h = rest_of(body, WEIGHT, 6)
            at = [
                required_suction(body, WEIGHT, f * h)
                for f in (0.5, 0.9999, 1.0001, 1.01, 1.1)
            ]
            self.assertEqual(at[:2], [0, 0])
            self.assertTrue(0 < at[2] < 20 < at[3] < at[4], at)

    def test_more_weight_takes_less_suction(self) -> None:
        found = [
            required_suction(caisson(True), weight, 5)
            for weight in np.linspace(0, 3e6, 20)
        ]
        self.assertTrue(all(a > b or a == b == 0 for a, b in pairwise(found)), found)
        self.assertGreater(found[0], found[-1])

    def test_equal_layers_are_one(self) -> None:
        layers = [Layer(top, GAMMA, 30, K) for top in (0, 1.3, 3.1)]
        for enhanced in (False, True):
            one = required_suction(caisson(enhanced), WEIGHT, 5)
            many = required_suction(caisson(enhanced, layers), WEIGHT, 5)
            self.assertAlmostEqual(many / one, 1)

    def test_piping(self) -> None:
        """At piping only the outer friction is left: without weight, the plain
        forces allow h up to D_i^2 / (2 K tan(delta) D_o) for any permeability."""
        body, deepest = caisson(False), DI**2 / (2 * K_TAN * DO)
        for kf in (0.5, 1, 3):
            s = required_suction(body, 0, 0.999 * deepest, kf)
            most = houlsby_byrne(GAMMA, 0.999 * deepest, DO, kf)
            self.assertTrue(0.99 * most < s < most, (s, most))
            beyond = required_suction(body, 0, 1.001 * deepest, kf)
            self.assertTrue(isnan(beyond))
        self.assertTrue(isnan(required_suction(body, 0, 0)))

    def test_piping_of_the_lightest_layer(self) -> None:
        body = caisson(False, [Layer(0, 10e3, 30, K), Layer(2, 8e3, 30, K)])
        self.assertAlmostEqual(piping_suction(body, 2), houlsby_byrne(10e3, 2, DO))
        self.assertAlmostEqual(piping_suction(body, 3), houlsby_byrne(8e3, 3, DO))

    def test_piping_above_silt(self) -> None:
        """2 m of sand, 1 m of silt with a hundredth of its permeability and 3 m of
        sand: 102 of 105 parts of the head are lost above the base of the silt at 3 m,
        where 30 kPa lie above; at h / D = 1 this is 30 * 105 / 102 / (1 - a), with the
        a of a plug that has 6 / 105 of 1 / 1e-4 s. Where all have one permeability, or
        one is not known, it is 60 kPa / (1 - a)."""
        whole = 0.45 - 0.36 * (1 - exp(-1 / 0.48))
        less = whole * 6 / 105 / (1 - whole + whole * 6 / 105)
        for silt, kilopascals, a in (
            (1e-6, 30.88235, less),
            (1e-4, 60, whole),
            (0, 60, whole),
        ):
            layers = [
                Layer(top, 10e3, 30, K, permeability=k)
                for top, k in ((0, 1e-4), (2, silt), (3, 1e-4))
            ]
            found = piping_suction(caisson(False, layers), 6)
            self.assertAlmostEqual(found / 1e3, kilopascals / (1 - a), places=4)

    def test_permeable_ground_below(self) -> None:
        """The share at the tip against finite differences of own, whose share is the
        mean over the base of the plug: never more, and at most 0.15 less. Gravel below
        clay does not count."""
        ground: list[tuple[float, float, list[tuple[float, float]], float]] = [
            (10, 4.9, [(0, 1e-4), (5, 1e-2)], 0.038),
            (10, 5.1, [(0, 1e-4), (5, 1e-2)], 0.014),
            (10, 7.0, [(0, 1e-5), (3, 1e-4)], 0.083),
            (9, 6.0, [(0, 1e-4), (6.5, 1e-3)], 0.120),
            (10, 7.0, [(0, 1e-4), (6, 3e-4)], 0.143),
            (10, 5.0, [(0, 1e-4), (5.1, 5e-4)], 0.144),
            (10, 2.0, [(0, 1e-4), (7.0, 1e-2)], 0.524),
            (6, 6.0, [(0, 1e-4), (2, 1e-6), (3, 1e-4)], 0.023),
            (8, 4.0, [(0, 1e-4), (4.5, 1e-2), (5, 1e-4)], 0.138),
            (10, 3.0, [(0, 1e-4), (3.05, 9.9e-5), (3.15, 1e-2)], 0.094),
            (10, 3.0, [(0, 1e-4), (3.05, 2e-5), (3.15, 1e-2)], 0.19),
            (10, 3.0, [(0, 1e-4), (3.05, 1e-6), (3.15, 1e-2)], 0.68),
        ]
        for diameter, h, rows, wanted in ground:
            layers = [Layer(top, 10e3, 30, K, permeability=k) for top, k in rows]
            known = [layer for layer in layers if layer.top < h]
            below = rows[len(known) :]
            body = Caisson(diameter, T, known, 25, 25, below=below)
            found = share_at_tip(body, h)
            plain = pressure_factor(h / diameter)
            self.assertTrue(found <= min(wanted, plain), (rows, found))
            self.assertGreater(found, min(wanted, plain) - 0.15)
            below = [(h + 0.01, 1e-12), *((top + 1, k) for top, k in below)]
            body = Caisson(diameter, T, layers[:1], 25, 25, below=below)
            self.assertEqual(share_at_tip(body, h), plain)


class SendersRandolph(unittest.TestCase):
    """Required suction with inner friction and tip in proportion to 1 - s / s_cr."""

    def test_equilibrium(self) -> None:
        """2 MN on the tip, 1 MN and 1.5 MN on inner and outer wall."""
        jacking = Forces(2e6, 1e6, 1.5e6)
        s = relieved_suction(jacking, WEIGHT, AREA, 90e3)
        self.assertTrue(0 < s < 90e3)
        left = 3e6 * (1 - s / 90e3) + 1.5e6
        np.testing.assert_allclose(left, WEIGHT + s * AREA)

    def test_limits(self) -> None:
        """0 where the weight suffices; nan where F_o exceeds V' + s_cr A_i."""
        jacking = Forces(2e6, 1e6, 1.5e6)
        self.assertEqual(relieved_suction(jacking, 4.5e6, AREA, 90e3), 0)
        for factor, expected in ((1.01, False), (0.99, True)):
            critical = factor * (1.5e6 - WEIGHT) / AREA
            s = relieved_suction(jacking, WEIGHT, AREA, critical)
            self.assertEqual(isnan(s), expected)
        self.assertTrue(isnan(relieved_suction(jacking, 0, AREA, 0)))

    def test_mean_unit_weight(self) -> None:
        """10 kN/m3 over 2 m and 7 over 1 m are 9 over 3 m."""
        body = caisson(False, [Layer(0, 10e3, 30, K), Layer(2, 7e3, 30, K)])
        self.assertAlmostEqual(
            critical_suction(body, 3), critical_suction(caisson(False), 3)
        )


class ByCone(unittest.TestCase):
    """Forces from q_c = 10 MPa on a wall of 40 mm and 8 m diameter to 2 m depth."""

    def test_forces(self) -> None:
        skirt = Skirt(8.0, 0.04, 24.0, 28.0)
        profile = Profile([0.0, 5.0], [10e6, 10e6])
        ring, ratio = pi / 4 * (8**2 - 7.92**2), 1 - (7.92 / 8) ** 2
        senders = senders_randolph.method(skirt, profile).forces(2.0, "high")
        self.assertAlmostEqual(senders.tip / (0.2 * 10e6 * ring), 1, places=6)
        k_f = 0.03 / sqrt(2) * ratio**0.3 * tan(radians(28.0))
        outer = pi * 8 * 2 * k_f * 10e6
        self.assertAlmostEqual(senders.outer_friction / outer, 1, places=6)
        joined = unified.method(skirt, profile).forces(2.0, "low")
        self.assertAlmostEqual(joined.tip / (0.5 * 10e6 * ring), 1, places=6)
        outer = pi * 8 * 2 * ratio**0.3 * tan(radians(27.1)) / 44 * 10e6
        self.assertAlmostEqual(joined.outer_friction / outer, 1, places=6)


if __name__ == "__main__":
    unittest.main()
