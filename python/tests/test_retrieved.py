# SPDX-License-Identifier: LGPL-2.1-or-later
"""A retrieval by overpressure, by numbers worked out by hand."""
import math
import unittest
from types import SimpleNamespace
from typing import Any
from unittest import mock

import numpy as np

from caisson import curves
from caisson.design import retrieval
from caisson.design.clay import Layer
from caisson.design.cone import Skirt
from caisson.report import pull
from caisson.shown import USUAL
from caisson.verdict.retrieval import Retrieval

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


class Piping(unittest.TestCase):
    """Sand outside that loses its weight."""

    def test_permeability_ratio(self) -> None:
        """A plug that conducts three times as much leaves the tip a = 3 a1/(1 + 2 a1)
        of the overpressure, and p = gamma' h / a; as the grout has it."""
        sand, skirt = [Layer(0.0, 9e3, 0.0, 0.0, 0.0)], Skirt(6.0, 0.1, 20.0, 20.0)
        a1 = 0.45 - 0.36 * (1 - math.exp(-(2 / 6) / 0.48))
        for ratio, a in ((1.0, a1), (3.0, 3 * a1 / (1 + 2 * a1))):
            found = retrieval.outward(skirt, sand, 2.0, ratio)
            self.assertAlmostEqual(found, 18e3 / a, delta=1e-6 * found)


class Depths(unittest.TestCase):
    """The table of the way up."""

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


class Cards(unittest.TestCase):
    """What bears the largest pull."""

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
