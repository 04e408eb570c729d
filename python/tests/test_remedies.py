# SPDX-License-Identifier: LGPL-2.1-or-later
"""Remedies for a caisson that suction does not install: amounts of made-up runs; and
why a resistance is not that of a design method, in sentences."""
import unittest
from math import nan
from typing import Any

import numpy as np
from test_by_hand import CLAY, END, SAND, Scene
from test_report import leave_run, SCENE, SUMMARY, WithPage

import caisson.report as report
from caisson.design import reasons
from caisson.design.method import Forces
from caisson.design.reasons import Compared
from caisson.verdict import by_hand, limits, outcome
from caisson.report import remedies, verdict
from caisson.verdict import installation
from caisson.report.remedies import Planned, Sizes
from caisson.results import Results


PUMP = {"Water/Largest suction": "20e3", "Time/End penetration": "4.5"}


class Remedies(WithPage):
    """Clay that takes 10 kPa for each meter below 1.5 m, on 77.29 m2 under 1 MN; the
    resistance has 2 parts of the tip and 1 of each wall; the pump has 20 kPa, which end
    at 3.5 m."""

    def run_of(
        self, scene: dict[str, Any] = {}, entries: dict[str, str] = {}
    ) -> Results:
        """Leave a run with a skirt of 5 m, and return it."""
        known = {**SCENE, "layers": [CLAY], "skirt_length_m": 5.0, **scene}
        summary = {**SUMMARY, "entries": {**PUMP, **entries}, "scene": known}
        leave_run(self.path, summary)
        return Results(self.path)

    def part(self, run: Results) -> installation.Installation:
        found = installation.installation_of(run, installation.Rate())
        assert found is not None
        return verdict.feasible_part(run, found, verdict.verdict_of(run).end)

    def planned_of(self, run: Results) -> Planned:
        """Return the caisson at 4.5 m."""
        return Planned(run, self.part(run), np.array([4.5]))

    def rows(self, run: Results) -> dict[str, str]:
        """Return the remedies by name."""
        end = verdict.verdict_of(run).end
        table = remedies.table_of(run, self.part(run), end)
        return {name: words for name, words in table.get("rows", [])}

    def test_weight_and_pump(self) -> None:
        """At 4.5 m 30 kPa are needed: 773 kN more of weight, or a pump for them."""
        rows = self.rows(self.run_of())
        words = "about 1.8 MN in all instead of 1 MN"
        self.assertEqual(rows["weight in water"], words)
        self.assertEqual(rows["pump"], "a pump for 30 kPa instead of 20 kPa")
        double = {"Water/Largest suction": "40e3", "Design/Factor on pump": "2"}
        rows_of_double = self.rows(self.run_of(entries=double))
        self.assertEqual(rows_of_double["pump"], "a pump for 60 kPa instead of 40 kPa")
        self.assertIn("at 3.5 m: a skirt of 3.77 m leaves 0.10 m", rows["stop earlier"])
        self.assertIn("end a run at 3.43 m", rows["cycles of force"])

    def test_sizes_by_hand(self) -> None:
        """At 4.5 m the resistance is 1000 + 30 * 77.29 = 3319 kN, of which the tip has
        half. A wall of 20 instead of 40 mm halves the tip to 831 kN, as its area goes
        from 1.2516 to 0.6271 m2, has 10 * 9.96 / 9.92 on the inner wall and loses
        66.95 kN/m3 * 5 m * 0.6245 m2 = 209.1 kN of steel; 77.91 m2 bear the rest."""
        planned = self.planned_of(self.run_of())
        self.assertAlmostEqual(planned.required[0], 30, delta=0.05)
        sizes = Sizes(10, 0.02, 0)
        sizes = sizes._replace(weight=planned.steel(sizes))
        self.assertAlmostEqual(sizes.weight, 1000 - 209.1, delta=0.5)
        force = 831.5 + 829.7 * (9.96 / 9.92) + 829.7
        self.assertAlmostEqual(
            planned.needs(sizes)[0], (force - 790.9) / 77.91, delta=0.1
        )
        wide = Sizes(12, 0.04, 1000)
        force = 3319 * (0.5 * 11.96 / 9.96 + 0.25 * (11.92 / 9.92 + 1.2))
        area = np.pi / 4 * 11.92**2
        self.assertAlmostEqual(planned.needs(wide)[0], (force - 1000) / area, delta=0.1)

    def test_wall_that_suffices(self) -> None:
        """It is the thickest one below the present that does, by mm."""
        run = self.run_of(entries={"Design/Factor on shell buckling": "0.1"})
        rows, planned = self.rows(run), self.planned_of(run)
        new, old = rows["wall"].split(" mm instead of ")
        self.assertEqual(old, "40 mm")
        for thinner, enough in ((0.0, True), (1.0, False)):
            wall = (float(new) + thinner) / 1e3
            self.assertEqual(remedies.is_enough(planned, "wall", wall), enough)

    def test_none_suffices(self) -> None:
        """8 kPa of the pump are too few for any wall, and for any diameter; the page
        has what would be gained."""
        run = self.run_of(entries={"Water/Largest suction": "8e3"})
        rows = self.rows(run)
        self.assertTrue(rows["wall"].startswith("none from 10 to 80 mm suffices"))
        self.assertRegex(rows["wall"], r"; 32 mm would reach 2\.\d\d m$")
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("32 mm would reach 2.", page)

    def test_pump_alone(self) -> None:
        """A plug that gives way stops the caisson whatever the pump."""
        run = self.run_of(entries={"Design/Factor on plug failure": "20"})
        words = self.rows(run)["pump"]
        self.assertTrue(
            words.startswith("no pump alone: reverse bearing of the plug, f")
        )

    def test_sand_in_which_water_flows(self) -> None:
        """What another suction would take from the forces is not known from one run."""
        run = self.run_of({"layers": SCENE["layers"]})
        rows = self.rows(run)
        self.assertEqual(rows["weight, wall, diameter, pump"], remedies.RELIEVED)
        self.assertIn("stop earlier", rows)
        text = verdict.verdict_of(run).text
        self.assertIn("how much in the soil down to 4.5 m is not known", text)

    def test_rounded_up(self) -> None:
        """Two digits, and not less than what suffices."""
        for value, found in ((3010.0, 3100.0), (3000.0, 3000.0), (1.031, 1.1)):
            self.assertAlmostEqual(remedies.rounded_up(value), found)

    def test_skirt(self) -> None:
        """4.5 m and 5 % of heave need more than 4.6 m, and the plug meets that lid."""
        run = self.run_of({"skirt_length_m": 4.6})
        self.assertTrue(
            self.rows(run)["skirt"].startswith("longer than 4.72 m instead")
        )
        self.assertNotIn("skirt", self.rows(self.run_of()))

    def test_nothing_to_mend(self) -> None:
        """A feasible scene has no table, and one with another layer no amounts."""
        entries = {"Water/Largest suction": "200e3"}
        self.assertEqual(self.rows(self.run_of(entries=entries)), {})
        layers = [CLAY, {**CLAY, "top_depth_m": 4}]
        rows = self.rows(self.run_of({"layers": layers}))
        self.assertEqual(rows["weight, wall, diameter, pump"], remedies.NOT_KNOWN)

    def test_wall_that_buckles(self) -> None:
        """25 mm buckle above 4.5 m by a factor of 5; a thicker wall does not."""
        entries = {"Design/Factor on shell buckling": "5"}
        entries["Water/Largest suction"] = "90e3"
        run = self.run_of({"wall_thickness_m": 0.025}, entries)
        self.assertEqual(self.part(run).governing(-1), limits.SHELL)
        rows, planned = self.rows(run), self.planned_of(run)
        self.assertEqual(rows["wall"], "27 mm instead of 25 mm")
        self.assertTrue(remedies.is_enough(planned, "wall", 0.027))
        self.assertFalse(remedies.is_enough(planned, "wall", 0.026))
        self.assertIn("no pump alone: wall buckles", rows["pump"])


class ThinLayer(Scene):
    """0.3 m of sand of 30 MPa in clay, between two rows of the tables."""

    def of_weight(self, weight: float) -> by_hand.ByHand:
        """Return it under a weight (N)."""
        tops = {**SAND, "top_depth_m": 4.1}, {**CLAY, "top_depth_m": 4.4}
        run = self.scene(CLAY, *tops, weight=weight)
        rows = "depth_m,qc_MPa\n0,1\n4.05,1\n4.1,30\n4.4,30\n4.45,1\n20,1\n"
        (self.path / "cone.csv").write_text(rows, encoding="utf-8")
        return run

    def test_end_and_weight(self) -> None:
        """The caisson ends at its top, far above what suction allows. The weight that
        would help is by arithmetic: with 2 % more it goes in, and with 2 % less it
        does not, by the methods themselves."""
        run = self.of_weight(2e6)
        found, end = outcome.whole_way(run), outcome.end_of(run)
        assert found is not None and end is not None
        self.assertEqual(end[0], 4.1)
        self.assertGreater(found.share.max(), 1.5)
        planned = remedies.planned_of(run, verdict.feasible_part(run, found, 4.1), END)
        assert not isinstance(planned, str)
        weight = remedies.weight_of(planned)
        assert weight is not None
        self.assertIsNone(outcome.end_of(self.of_weight(1.02e3 * weight)))
        self.assertIsNotNone(outcome.end_of(self.of_weight(0.98e3 * weight)))

    def test_sand_under_less_suction(self) -> None:
        """Where more weight takes less suction, this relieves less, too."""
        run = self.scene(SAND, weight=0.5e6)
        found, end = outcome.whole_way(run), outcome.end_of(run)
        assert found is not None and end is not None
        part = verdict.feasible_part(run, found, end[0])
        planned = remedies.planned_of(run, part, END)
        assert not isinstance(planned, str)
        weight = remedies.weight_of(planned)
        assert weight is not None
        self.assertIsNone(outcome.end_of(self.scene(SAND, weight=1.02e3 * weight)))
        self.assertIsNotNone(outcome.end_of(self.scene(SAND, weight=0.98e3 * weight)))


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
        return reasons.of_cone(Compared(NAME, 2, what, ends, RUN, low, high, relief))

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
        said = reasons.of_cause("walls", 7.5, walls)
        self.assertIn("At 7.5 m the mean K on the walls is 2.0 outside and 3.3", said)
        self.assertIn("at rest it is 0.40 to 0.46, and at the passive limit 3.4", said)
        unknown = reasons.of_cause("walls", 7.5, None)
        self.assertNotIn("passive", unknown)
        self.assertIn("small share", unknown)
        self.assertIn("fixed share", reasons.of_cause("tip", 7.5, walls))
        self.assertEqual(reasons.of_cause("loose", 7.5, walls), "")

    def test_like(self) -> None:
        low, high = Forces(300e3, 50e3, 150e3), Forces(800e3, 50e3, 150e3)
        self.assertEqual(self.said(low, high), "")

    def test_relieved(self) -> None:
        """Senders & Randolph: all but the outer friction, and nothing below 0."""
        self.assertEqual(reasons.relieved(RUN, 0.25), (225e3, 12.5e3, 150e3))
        self.assertEqual(reasons.relieved(RUN, -1), (0, 0, 150e3))


if __name__ == "__main__":
    unittest.main()
