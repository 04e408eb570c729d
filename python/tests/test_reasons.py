# SPDX-License-Identifier: LGPL-2.1-or-later
"""Why a computed resistance is not that of a design method, in sentences."""
import unittest
from math import nan

from caisson.design import reasons
from caisson.design.method import Forces
from caisson.design.reasons import ByCone

RUN = Forces(900e3, 50e3, 150e3)
NAME = "DNV (cone ASSUMED)"


class Beyond(unittest.TestCase):
    """What asks for a reason."""

    def test_ratios(self) -> None:
        for low, high, is_beyond in (
            (50.0, 79.0, True),  # 1.27 to 2
            (50.0, 81.0, False),  # the upper case is like the run
            (126.0, 300.0, True),
            (124.0, 300.0, False),
            (0.0, 79.0, True),  # the lower case needs no suction
            (0.0, 0.0, True),  # none needs any
            (50.0, nan, False),  # none suffices in the upper case
            (126.0, nan, True),
            (nan, nan, False),
        ):
            self.assertIs(reasons.is_beyond(100, low, high), is_beyond, (low, high))
        self.assertFalse(reasons.is_beyond(0, 1, 2))

    def test_undisturbed_ground(self) -> None:
        said = reasons.of_undisturbed(4, 3e6, 1e6, "force")
        self.assertIn("At 4 m the run has 3.00 times the force of undisturbed", said)
        for words in ("no installation has", "passive limit", "at the tip"):
            self.assertIn(words, said)
        self.assertEqual(reasons.of_undisturbed(4, 1.2e6, 1e6, "force"), "")
        none = reasons.of_undisturbed(2, 1e4, 0, "suction")
        self.assertIn("needs a suction, and undisturbed ground", none)
        self.assertIn("needs none", none)


class FromACone(unittest.TestCase):
    """The part that makes most of the difference."""

    def said(self, low: Forces, high: Forces, relief: float | None = None) -> str:
        """Return the sentence of a run of 1100 kN."""
        ends = RUN.total, low.total, high.total
        what = "force" if relief is None else "suction"
        return reasons.of_cone(ByCone(NAME, 2, what, ends, RUN, low, high, relief))

    def test_tip(self) -> None:
        low = Forces(300e3, 50e3, 150e3)
        said = self.said(low, low)
        self.assertIn(f"At 2 m the run has 2.20 times the force of {NAME}", said)
        self.assertIn("its tip bears 900 kN (method: 300), its walls 50 kN (50)", said)
        self.assertIn("most of the difference is at the tip.", said)
        self.assertIn("leaves the tip 1 - s/s_cr = 0.20", self.said(low, low, 0.2))
        self.assertIn("1 - s/s_cr = 0.00", self.said(low, low, -0.2))

    def test_walls(self) -> None:
        low = Forces(850e3, 5e3, 10e3)
        self.assertIn("is at the walls.", self.said(low, low, 0.2))
        high = Forces(950e3, 500e3, 900e3)
        self.assertIn("walls, which do not grip yet", self.said(high, high))

    def test_why(self) -> None:
        """With K of the run where it is known, and nothing where all is said."""
        walls = reasons.Walls(3.32, 2.04, (0.398, 0.455), (3.39, 4.02))
        said = reasons.of_cause(reasons.AT_WALLS, 7.5, walls)
        self.assertIn("At 7.5 m the mean K on the walls is 2.0 outside and 3.3", said)
        self.assertIn("at rest it is 0.40 to 0.46, and at the passive limit 3.4", said)
        unknown = reasons.of_cause(reasons.AT_WALLS, 7.5, None)
        self.assertNotIn("passive", unknown)
        self.assertIn("small share", unknown)
        self.assertIn("fixed share", reasons.of_cause(reasons.AT_TIP, 7.5, walls))
        self.assertEqual(reasons.of_cause(f"{reasons.AT_WALLS}, which", 7.5, walls), "")

    def test_like(self) -> None:
        low, high = Forces(300e3, 50e3, 150e3), Forces(800e3, 50e3, 150e3)
        self.assertEqual(self.said(low, high), "")

    def test_relieved(self) -> None:
        """Senders & Randolph: all but the outer friction, and nothing below 0."""
        self.assertEqual(reasons.relieved(RUN, 0.25), (225e3, 12.5e3, 150e3))
        self.assertEqual(reasons.relieved(RUN, -1), (0, 0, 150e3))


if __name__ == "__main__":
    unittest.main()
