# SPDX-License-Identifier: LGPL-2.1-or-later
"""Clay under suction, against numbers worked out by hand: resistance, required suction,
and the suction at which the plug gives way; and a retrieval by overpressure."""
import math
import unittest
from math import inf, nan
from types import SimpleNamespace
from typing import Any
from unittest import mock

import numpy as np

from caisson import curves, evaluation
from caisson.design import retrieval, suction_installation as installation
from caisson.design.clay import Clay, Layer, strength_at
from caisson.design.cone import Skirt
from caisson.design.plug_stability import (
    allowable,
    bearing_factor,
    failure,
    LIFT,
    REVERSE_BEARING,
    reverse_bearing,
    uncovered,
)
from caisson.report import pull
from caisson.shown import USUAL
from caisson.verdict.retrieval import Retrieval

SKIRT = Skirt(6, 0.1, 0, 0)  # 4 / D_i = 0.689655 1/m
# an anchor of 5 m in clay of 2 kPa + 1.5 kPa/m with an adhesion of half of it
ANCHOR, DEEP = Skirt(5, 0.035, 0, 0), 14.1


def growing(height: float = 0.01) -> list[Layer]:
    """Return the layers of the anchor, of this height (m) each."""
    found = []
    for top in np.arange(0, 15, height):
        strength = 2e3 + 1.5e3 * (top + height / 2)
        found.append(Layer(top, 6e3, strength, strength / 2, strength / 2))
    return found


class Plug(unittest.TestCase):
    """A caisson of 6 m with a wall of 0.1 m."""

    def test_bearing_factor(self) -> None:
        """6 (1 + 0.2 h / D), and 9 from two and a half diameters on."""
        found = [bearing_factor(h, 6) for h in (0, 3, 15, 20)]
        np.testing.assert_allclose(found, [6, 6.6, 9, 9])

    def test_uniform_clay(self) -> None:
        """20 kPa and an adhesion of 10 kPa: at 3 m 6.6 20 + 10 3 0.689655, at 15 m
        9 20 + 10 15 0.689655. No sand is there to lift it."""
        found = allowable(SKIRT, [Layer(0, 6e3, 20e3, 10e3, 10e3)], np.array([3, 15]))
        self.assertEqual(list(found), [REVERSE_BEARING])
        values = found[REVERSE_BEARING] / 1e3
        np.testing.assert_allclose(values, [152.690, 283.448], rtol=1e-5)

    def test_clay_between_sand(self) -> None:
        """At 2 m 6.4 40 + 20 0.689655 fail, and 10 + 14 kPa of weight, 20 0.689655 of
        adhesion and 40 0.689655 of the clay below are lifted; from 3 m on, 24 kPa and
        20 2 0.689655."""
        sand, clay = (10e3, 0, 0, 0), (7e3, 40e3, 20e3, 20e3)
        layers = [Layer(0, *sand), Layer(1, *clay), Layer(3, *sand)]
        found = allowable(SKIRT, layers, np.array([0.5, 2, 3, 4]))
        np.testing.assert_allclose(
            found[REVERSE_BEARING] / 1e3, [nan, 269.793, 291.586, nan], rtol=1e-5
        )
        lifted = found[LIFT] / 1e3
        np.testing.assert_allclose(lifted, [nan, 65.379, 51.586, 51.586], rtol=1e-4)

    def test_crust(self) -> None:
        """The block below the tip comes out of the crust: at 2.35 m 30 2.35 + 60 0.4
        over its side, 4 / 5.2 m, and 6 (1 + 0.2 2.75 / 5.4) 10 kPa below it. Limit
        analysis has 185 kPa. In the soft clay the crust does not matter to N_c."""
        skirt = Skirt(5.4, 0.1, 0, 0)
        layers = [Layer(0, 0, 60e3, 30e3, 30e3), Layer(2.75, 0, 10e3, 5e3, 5e3)]
        suction, top = failure(skirt, layers, 2.35)
        self.assertAlmostEqual(suction / 1e3, 94.5 * 4 / 5.2 + 66.111, places=2)
        self.assertEqual(top, 2.75)
        suction, top = failure(skirt, layers, 2.8)
        self.assertAlmostEqual(suction / 1e3, 82.75 * 4 / 5.2 + 66.222, places=2)
        self.assertTrue(np.isnan(top))

    def test_limit_analysis(self) -> None:
        """Suctions over the strength at the tip, by scripts/lab plug-lift --cells 8
        --extent 8, for a thin wall: never more than 5 % above."""
        for h, adhesion, ratio, below, limit in (
            *((0.5, 1, 0.1, 0, 3.22), (0.5, 1, 0.25, 0.1, 5.12)),
            *((0.5, 1, 0.5, 0.5, 8.96), (0.5, 1, 0.8, 0.25, 9.65)),
            *((0.5, 1, 0.1, 1, 7.73), (0.5, 0, 0.1, 0, 1.13)),
            *((0.5, 0, 0.25, 0.5, 4.92), (0.5, 0, 0.8, 0.25, 7.31)),
            *((0.5, 1, 1.25, 0, 12.16), (0.5, 1, 6, 0.25, 11.73)),
            # soft clay above a tip that is just in stiff clay does not hold that down
            *((1, 0, 10, -0.05, 6.74), (2.5, 0, 10, -0.05, 7.04)),
            *((2.5, 0, 10, -0.25, 7.91), (2.5, 0, 2, -0.05, 9.27)),
        ):
            at_tip, other = (1, ratio) if below >= 0 else (1 / ratio, 1)
            layers = [
                Layer(0, 0, at_tip, adhesion * at_tip, 0),
                Layer(h + below, 0, other, adhesion * other, 0),
            ]
            found = reverse_bearing(Skirt(1, 0, 0, 0), layers, h) / limit
            self.assertTrue(0.5 < found < 1.05, (h, adhesion, ratio, below, found))

    def test_clay_below_sand(self) -> None:
        """Within a diameter below a tip in sand, it is covered by no limit."""
        layers = [Layer(0, 1e4, 0, 0, 0), Layer(4, 6e3, 9e3, 0, 0)]
        for depth, tops in ((1.0, []), (3.0, [4]), (5.0, [])):
            found = uncovered(Skirt(2, 0, 0, 0), layers, np.array([depth]))
            self.assertEqual(found, tops)

    def test_the_last_clay_counts(self) -> None:
        """Clay that does not reach down to sand, and sand that has none above it."""
        sand, clay = (10e3, 0, 0, 0), (5e3, 8e3, 0, 0)
        layers = [Layer(z, *(clay if z % 2 else sand)) for z in range(4)]
        found = allowable(SKIRT, layers, np.array([0.5, 1.5, 2.5, 3.5]))
        np.testing.assert_allclose(
            found[LIFT] / 1e3, [nan, 15 + 8 * 0.5 * 0.689655, 15, nan], rtol=1e-5
        )
        self.assertEqual(allowable(SKIRT, layers[:1], np.array([1.0])), {})


class Anchor(unittest.TestCase):
    """At 14.1 m: s_u = 23.15 kPa, and 2 14.1 + 0.75 14.1^2 = 177.3075 kN/m over the
    depth, of which half is the adhesion."""

    def test_plug(self) -> None:
        """9 23.15 + 88.654 4 / 4.93 = 208.35 + 71.93 kPa."""
        found = allowable(ANCHOR, growing(), np.array([DEEP]))
        self.assertAlmostEqual(found[REVERSE_BEARING][0] / 280.28e3, 1, delta=1e-3)

    def test_strength_between_rows(self) -> None:
        """Rows of 0.4 m have the strength of the profile at each depth; a layer of its
        own keeps its strength, however thin it is."""
        rows = growing(0.4)
        for h in np.linspace(1, 13.9, 40):
            self.assertAlmostEqual(strength_at(rows, h), 2e3 + 1.5e3 * h, delta=1)
        for top, strength in ((4.0, 22e3), (0.4, 30e3)):
            layers = [Layer(0, 6e3, 20e3, 0, 0), Layer(top, 6e3, strength, 0, 0)]
            layers.append(Layer(2 * top, 6e3, 20e3, 0, 0))
            self.assertEqual(strength_at(layers, 1.1 * top), strength)

    def test_required_suction(self) -> None:
        """The tip has pi 4.965 0.035 = 0.545929 m2 and 6 14.1 + 7.5 23.15 kPa, 141.0
        kN; the walls 88.654 pi 4.93 = 1373.1 and 88.654 pi 5 = 1392.6 kN. Of these
        2906.6 kN the weight bears 700, and the suction the rest on 19.089 m2."""
        forces = Clay(ANCHOR, growing()).forces(DEEP, "strip")
        kilonewtons = np.array(forces) / 1e3
        np.testing.assert_allclose(kilonewtons, [141.0, 1373.1, 1392.6], rtol=1e-3)
        total = np.array([forces.total, 600e3])
        suction = installation.suction_without_flow(total, 700e3, 19.089)
        np.testing.assert_allclose(suction, [115.6e3, 0], rtol=1e-3)

    def test_rest(self) -> None:
        """Between the depths where the resistance is less than the weight and more."""

        def force(h: float) -> float:
            return float(np.interp(h, [0.0, 2, 4, 6], [1e5, 3e5, 5e5, 1e6]))

        rest_of = installation.self_weight_penetration
        for weight, rest in ((4e5, 3), (5e5, 4), (1e4, 0), (7.5e5, 5)):
            self.assertAlmostEqual(rest_of(force, weight, 6.0), rest)
        self.assertTrue(np.isnan(rest_of(force, inf, 6.0)))


FRICTION, WATER = "Friction outside", "Of which water beneath lid and tip"


def said(found: Retrieval) -> str:
    """Return what a page says of a retrieval."""
    return pull.say(pull.SENTENCES, "retrieved", USUAL, found, 14.0, None)


class Crane(unittest.TestCase):
    """What a crane has to take, over all of the way."""

    def test_most(self) -> None:
        """On 15 m2, (190 - 76) kPa are 1.71 MN at 14 m. At 2 m the share of what is
        allowed is larger, and (55 - 12) kPa are only 645 kN."""
        limits = {"plug pushed out": np.array([12e3, 76e3])}
        needs = np.array([55e3, 190e3])
        found = Retrieval(np.array([2.0, 14.0]), needs, limits, 15.0)
        self.assertEqual(found.worst, 1)
        self.assertIn("at 14 m the ground and the wall bear 76 kPa", said(found))
        self.assertIn("a crane has to take 1.71 MN", said(found))

    def test_water_alone(self) -> None:
        """The largest share, not the largest overpressure; none of 0 / 0."""
        limits = {"plug pushed out": np.array([0.0, 50e3, 300e3])}
        needs = np.array([0.0, 40e3, 190e3])
        found = Retrieval(np.array([0.0, 2.0, 14.0]), needs, limits, 15.0)
        self.assertIn("at most 80 % of what the ground", said(found))


class PipingOutside(unittest.TestCase):
    """Sand that loses its weight."""

    def test_permeability_ratio(self) -> None:
        """A plug that conducts three times as much leaves the tip a = 3 a1/(1 + 2 a1)
        of the overpressure, and p = gamma' h / a; as the grout has it."""
        sand, skirt = [Layer(0.0, 9e3, 0.0, 0.0, 0.0)], Skirt(6.0, 0.1, 20.0, 20.0)
        a1 = 0.45 - 0.36 * (1 - math.exp(-(2 / 6) / 0.48))
        for ratio, a in ((1.0, a1), (3.0, 3 * a1 / (1 + 2 * a1))):
            found = retrieval.outward(skirt, sand, 2.0, ratio)
            self.assertAlmostEqual(found, 18e3 / a, delta=1e-6 * found)

    def test_cracks(self) -> None:
        """By the least stress at rest, which is the vertical one where K0 is above 1:
        0.5 or 1 times 4 m of 6 kPa/m, and 20 kPa."""
        clay = [Layer(0.0, 6e3, 20e3, 10e3, 10e3)]
        for ratio, least in ((0.5, 12e3), (1.5, 24e3)):
            found = retrieval.fracture(clay, [ratio], 4.0)
            self.assertAlmostEqual(found, least + 20e3)


class WayUp(unittest.TestCase):
    """The table of a retrieval."""

    def test_rows(self) -> None:
        """From the deepest place: 190 kPa, of which the plug bears 76; the rest on 15
        m2 is for a crane."""
        limits = {"plug pushed out": np.array([60e3, 76e3])}
        found = Retrieval(np.array([2.0, 13.96]), np.array([55e3, 190e3]), limits, 15.0)
        table = pull.retrieval_table(found, USUAL)
        self.assertEqual(table["rows"][0], ["13.96", "190", "76", "76", "1710"])
        self.assertEqual(table["rows"][1], ["2", "55", "60", "60", "0"])
        unknown = pull.retrieval_table(found._replace(limits={}), USUAL)
        self.assertEqual(unknown["rows"][0], ["13.96", "190"])


class PullCards(unittest.TestCase):
    """What bears the largest pull."""

    def test_first_row(self) -> None:
        """The first row of a way up is a mean over the turn of the motion: its forces
        are not those of the largest pull, which are of one row."""
        pull_of_rows = np.array([-9.0, 3.0, 11.0, 11.5, 10.0, 9.0, 9.2, 9.1, 8.8])
        parts = {f"{part}_N": -pull_of_rows for part in ("outer_friction", "tip_force")}
        zero = np.zeros(len(pull_of_rows))
        depth = 5.0 - 0.1 * np.arange(len(pull_of_rows))
        history = {"total_force_N": -pull_of_rows, "inner_friction_N": zero, **parts}
        found = evaluation.largest_pull({**history, "penetration_m": depth})
        self.assertEqual(found["pull_N"], found["outer_friction_N"])
        self.assertGreaterEqual(found["pull_N"], 10.0)
        self.assertLess(found["pull_N"], 11.5)

    def test_water(self) -> None:
        """It bears a part of a pull on a sealed lid. That which pushes a body out bears
        nothing."""
        forces = ("outer_friction_N", "inner_friction_N", "tip_N", "water_N")
        most = dict.fromkeys(forces, 1e6)
        run: Any = SimpleNamespace(shown=USUAL, history={curves.WITH_WATER: 0})
        pairs = (False, ["Of which friction outside", WATER]), (True, [FRICTION])
        for is_retrieval, names in pairs:
            with (
                mock.patch.object(pull, "largest_pull", return_value=most),
                mock.patch.object(pull, "is_retrieval", return_value=is_retrieval),
            ):
                self.assertEqual([row[0] for row in pull.cards_of(run)], names)


if __name__ == "__main__":
    unittest.main()
