# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the way down ends by hand methods, against calculations by hand."""
import unittest
from math import exp, pi

import numpy as np
from test_by_hand import AREA, CLAY, D, END, INNER, QC, SAND, Scene, TIP, WALLS, WATER
from test_by_hand import bisected, in_clay, parts_in_sand, suction_in_sand

from caisson.design import shell
from caisson.evaluation import GRADIENT
from caisson.report import low_and_high, verdict
from caisson.results import ResultsError
from caisson.verdict import (
    acceptance,
    by_hand,
    limits,
    outcome,
    run_review,
    suction_methods,
)
from caisson.verdict import theory


class Ends(Scene):
    """What ends it in places where few rows stand."""

    def test_above_the_first_row(self) -> None:
        """A light caisson in sand meets piping at the first depth at which the mean of
        the methods needs more than 10 h / (1 - a) kPa, where the tip bears nearly all:
        far above half a meter. Under twenty times its weight it does not there."""

        def excess(h: float, weight: float) -> float:
            found = suction_in_sand(h, parts_in_sand(h).mean(axis=0), weight)
            a = 0.45 - 0.36 * (1 - np.exp(-h / D / 0.48))
            return found - 10e3 * h / (1 - a)

        end = bisected(excess, 0.0, 5e4, end=0.1)
        self.assertGreater(excess(0.1, 5e4), 0)
        run = self.scene(SAND, weight=5e4)
        self.assertAlmostEqual(outcome.feasible_to(run), end, delta=0.05)
        self.assertGreater(outcome.feasible_to(self.scene(SAND, weight=1e6)), 0.5)

    def test_a_short_cone_test(self) -> None:
        """In clay below sand no cone resistance counts, and the test may end there; in
        sand below the test no method knows the force."""
        layers = [SAND, {**CLAY, "top_depth_m": 3.0}]
        self.scene(*layers, weight=1.2e6)
        test = "depth_m,qc_MPa\n0,2\n4,2\n"
        forces = list[np.ndarray]()
        for text in ("", test):
            run = self.scene(*layers, weight=1.2e6)
            if text:
                (self.path / "cone.csv").write_text(text, encoding="utf-8")
            forces.append(run.columns_at(np.array([2.0, 3.5, 7.0]))["total_force_N"])
        self.assertTrue(np.isfinite(forces[1]).all())
        np.testing.assert_allclose(forces[1], forces[0])
        run = self.scene(*layers, {**SAND, "top_depth_m": 6.0}, weight=1.2e6)
        (self.path / "cone.csv").write_text(test, encoding="utf-8")
        with self.assertRaisesRegex(ResultsError, "below 4 m, where the cone test end"):
            run.columns_at(np.array([2.0]))

    def test_a_cone_test_that_ends_early(self) -> None:
        """It goes on as sand of the same density: by the share that its last half meter
        has of what is assumed there. In a layer that begins below it, it does not."""
        run = self.scene(SAND, weight=1.25e6)
        rows = "depth_m,qc_MPa\n0,2\n6,2\n"
        (self.path / "cone.csv").write_text(rows, encoding="utf-8")
        run = by_hand.ByHand(run.directory)
        found = theory.cone_of(run.site, END)
        assumed = theory.cone_of(run.site._replace(cone=None), END)
        share = QC / float(np.mean([assumed.at(z) for z in np.linspace(5.5, 6.0, 51)]))
        for z in (6.1, 7.0, END):
            self.assertAlmostEqual(found.at(z) / assumed.at(z) / share, 1, places=3)
        self.assertEqual((found.at(6.0), found.at(3.0)), (QC, QC))
        names = [x.name for x in by_hand.answers_of(run.site, np.array([END]))]
        self.assertEqual([theory.ASSUMED_CONE in x for x in names], [False, True, True])
        self.assertIn("Below 6 m, where the cone test ends, its", self.text(run))
        run = self.scene(SAND, {**SAND, "top_depth_m": 7.0}, weight=1.25e6)
        (self.path / "cone.csv").write_text(rows, encoding="utf-8")
        with self.assertRaisesRegex(ResultsError, "below 6 m, where the cone test end"):
            by_hand.ByHand(run.directory).columns_at(np.array([2.0]))

    def test_deeper_into_clay(self) -> None:
        """Whatever lies below, a caisson gets as far in the sand above, in all of the
        estimates; high resistance has piping by Houlsby & Byrne there, too."""
        sand = {**SAND, "friction_angle_deg": 41.0}
        at = np.array([2.0, 5.0, 7.5])
        alone = self.scene(sand, weight=5e5)
        columns = {x: r.by_hand(at) for x, r in alone.estimates.items() if r.by_hand}
        end = outcome.depth_of(alone)
        assert end is not None
        above = self.scene(sand, {**CLAY, "top_depth_m": 7.6}, weight=5e5)
        for estimate, run in above.estimates.items():
            assert run.by_hand is not None
            for name, values in run.by_hand(at).items():
                np.testing.assert_allclose(values, columns[estimate][name])
        self.assertAlmostEqual(outcome.depth_of(above) or 0, end, delta=0.02)

    def test_a_wall_that_buckles_by_weight(self) -> None:
        """A thin wall that bears the smaller one of weight and resistance, which here
        push it in without suction; a thick one bears it."""
        thin, weight = {"wall_thickness_m": 0.005}, 3e7
        run = self.scene(CLAY, weight=weight, body=thin)
        self.assertLess(run.columns_at(np.array([END]))["total_force_N"][0], weight)

        def bears(h: float) -> float:
            wall = limits.wall_of(run)
            assert wall is not None
            borne = float(run.columns_at(np.array([h]))["total_force_N"][0])
            return -shell.limit_suction(wall, h, borne, 0.0, 1.3)

        end = bisected(bears, -1e-9)
        self.assertLess(end, END - 0.5)
        said = verdict.verdict_of(run)
        self.assertAlmostEqual(said.end or 0, end, delta=0.1)
        self.assertIn(
            "there the wall does not bear the weight (wall buckles", said.text
        )
        text = verdict.verdict_of(self.scene(CLAY, weight=weight)).text
        self.assertIn("no suction is needed", text)

    def test_plug_that_meets_the_lid(self) -> None:
        """It ends the way also of a caisson whose weight suffices there: the plug has
        half of the area of the tip."""
        run = self.scene(CLAY, weight=1.1 * in_clay(END, 9))
        run.scene["skirt_length_m"] = END + 0.01
        end = outcome.feasible_to(run)
        room = END + 0.01 - (1 + (np.pi / 4 * D**2 - AREA) / AREA / 2) * end
        self.assertLess(end, END - 0.01)
        self.assertAlmostEqual(room, 0, delta=0.1)
        said = "no suction is needed, and none helps (plug meets the lid)"
        self.assertIn(said, verdict.verdict_of(run).text)

    def test_lid_above_the_sea(self) -> None:
        """Water boils beneath a lid 3 m over a mudline at which 30 kPa boil it: 0.6 kPa
        are left there, and none higher up."""
        run = self.scene(CLAY)
        run.scene["boiling_suction_at_mudline_Pa"] = 30e3
        found = run.boiling_at(np.array([5.0, 6.0, 8.0]))["cavitation_suction_Pa"]
        np.testing.assert_allclose(found, [0, 30e3 - 3 * WATER, 30e3 - WATER])
        weight, end = 2e6, outcome.depth_of(run) or 0
        needed = (in_clay(end, 8.25) - weight) / AREA
        self.assertAlmostEqual(needed, max(30e3 - WATER * (9 - end), 0), delta=4e3)

    def test_lid_that_stands_out_of_the_sea(self) -> None:
        """9 m of skirt that rest in clay stand out of 5 m of water, not out of 10 m."""
        for depth, is_said in ((5.0, True), (10.0, False)):
            run = self.scene(CLAY)
            run.summary["entries"]["Water/Water depth"] = str(depth)
            above = 9.0 - (run.rest or 0.0) - depth
            said = run_review.review_of(run)
            self.assertEqual(len(said), is_said)
            self.assertEqual(f"{above:.2g} m above the sea" in str(said), is_said)

    def test_gap_in_a_cone_test(self) -> None:
        """What was not measured counts where the tip goes there and a step is wide, or
        the test ends above."""
        for top, bottom, last, said_of in (
            (3.0, 4.0, 12.0, "3 to 4 m:"),
            (3.8, 4.0, 12.0, ""),
            (END, END + 2, END + 3, ""),
            (3.0, 4.0, 7.0, f"3 to 4 m, 7 to {END:.3g} m:"),
        ):
            run = self.scene(SAND)
            ranges = (0.0, top + 0.05), (bottom, last + 0.05)
            depth = np.concatenate([np.arange(*ends, 0.1) for ends in ranges])
            rows = "".join(f"{z:.2f},2\n" for z in depth)
            (self.path / "cone.csv").write_text("depth_m,qc_MPa\n" + rows, "utf-8")
            said = str(run_review.review_of(by_hand.ByHand(run.directory)))
            self.assertIn(f"measured nothing from {said_of}" if said_of else "", said)
            self.assertEqual("ASSUMED" in said, bool(said_of))

    def test_suction_that_ends_where_it_rests(self) -> None:
        """The page has the penetration by weight and the limits that end suction; the
        depth is not rounded above that of the rest."""
        run = self.scene(CLAY, weight=2.44e6)
        run.summary["entries"]["Water/Largest suction"] = "1"
        rest = self.rest_of(run)
        self.assertEqual(outcome.depth_of(run), rest)
        text = self.text(run)
        self.assertIn(f"Self-weight penetration {rest:.2f} m", text)
        self.assertRegex(text, rf"limit of the suction \(kPa\) .*feasible: {rest:.2f}")
        self.assertNotIn("more than", text)
        self.assertNotIn("Water to vent", text)

    def test_flow_that_is_not_steady(self) -> None:
        """v D / c_v at 1 m/h, with c_v = k 1.35 E / 9810 N/m3, is above 1."""
        for k, is_steady in ((1e-5, True), (1e-7, False)):
            layer = {**SAND, "permeability_m_s": k, "youngs_modulus_Pa": 20e6}
            run = self.scene(layer)
            run.summary["entries"]["Water/Level"] = "seepage"
            (said,) = run_review.review_of(run) or ("",)
            self.assertEqual(not said, is_steady)
            ratio = D / 3600 / (k * 1.35 * 20e6 / WATER)
            self.assertIn("" if is_steady else f"vD/c_v is {ratio:.2g} at 1 m/h", said)
            words = low_and_high.unsteady_in_words(run)
            found = outcome.whole_way(run)
            assert found is not None
            plain = np.maximum(found.force - 2e3, 0) / AREA
            self.assertEqual(bool(words), not is_steady)
            if words:
                np.testing.assert_allclose(found.required, plain, atol=1e-9)
                self.assertIn(
                    "so that 0 % of what it takes from the forces is counted", words
                )
            else:
                self.assertLess(found.required[-1], 0.9 * plain[-1])
            run = self.scene(CLAY, {**layer, "top_depth_m": 3.0})
            run.summary["entries"]["Water/Level"] = "seepage"
            self.assertEqual(run_review.review_of(run), ())


class Layered(Scene):
    """3 m of sand over clay."""

    def test_forces_and_suction(self) -> None:
        """As in sand alone down to the clay, whose friction comes to that of the sand;
        flow only above it: s = (R - W) / (A + (Q + F_i) / s_cr), then (R - W) / A."""
        run = self.scene(SAND, {**CLAY, "top_depth_m": 3.0}, weight=1.2e6)

        def best(h: float) -> float:
            parts = parts_in_sand(min(h, 3.0)).mean(axis=0)
            if h <= 3:
                return float(parts.sum())
            in_it = 10e3 * 3 + 8e3 * (h - 3) + 8.25 * 40e3
            return float(parts[1:].sum() + WALLS * 20e3 * (h - 3) + TIP * in_it)

        at = np.array([2.0, 5.0, 8.0])
        found = run.columns_at(at)
        for i, h in enumerate(at):
            self.assertAlmostEqual(found["total_force_N"][i] / best(h), 1, places=3)
            s = (best(h) - 1.2e6) / AREA
            if h < 3:
                s = suction_in_sand(h, parts_in_sand(h).mean(axis=0), 1.2e6)
            self.assertAlmostEqual(found["required_suction_Pa"][i] / s, 1, places=3)
        self.assertAlmostEqual(
            self.rest_of(run), bisected(best, 1.2e6, end=3.0), places=3
        )
        text = " ".join(self.text(run).split())
        for name in ("Houlsby &amp; Byrne (2005)", "Senders &amp; Randolph (2009)"):
            self.assertIn(f"{name}, clay by its strength", text)

    def test_thin_seam(self) -> None:
        """A seam of a centimeter changes the resistance by no more than its own: its
        tip bears nothing of the sand only in it, and DNV, Houlsby & Byrne and Senders &
        Randolph go on below it. No water flows through it."""
        seam = {**CLAY, "top_depth_m": 4.0}
        below = {**SAND, "top_depth_m": 4.01}
        at = np.array([3.9, 4.5, 6.0, 8.0])
        plain = self.scene(SAND, weight=1.2e6).columns_at(at)
        run = self.scene(SAND, seam, below, weight=1.2e6)
        found = run.columns_at(at)
        ratio = found["total_force_N"] / plain["total_force_N"]
        np.testing.assert_allclose(ratio, 1, atol=0.01)
        s = (found["total_force_N"] - 1.2e6)[1:] / AREA
        np.testing.assert_allclose(found["required_suction_Pa"][1:], s, rtol=1e-6)

    def test_thin_cover(self) -> None:
        """Mud of two centimeters is no plug of clay that water could lift: piping
        limits the suction as in sand alone, and flow does not help. Mud of 20 cm is."""
        at = np.array([2.0, 6.0])
        plain = self.scene(SAND, weight=1.2e6)
        for mud, name in ((0.02, limits.PIPING), (0.2, limits.LIFT)):
            run = self.scene(CLAY, {**SAND, "top_depth_m": mud}, weight=1.2e6)
            found = limits.limits_of(run, at)
            self.assertEqual({limits.PIPING, limits.LIFT} & set(found), {name})
            columns = run.columns_at(at)
            s = (columns["total_force_N"] - 1.2e6) / AREA
            np.testing.assert_allclose(columns["required_suction_Pa"], s)
            if name == limits.PIPING:
                wanted = limits.limits_of(plain, at)[name]
                np.testing.assert_allclose(found[name], wanted)
                self.assertIn("clay on top thinner than 2 %", self.text(run))

    def test_piping_above_clay(self) -> None:
        """Piping limits the suction down to the clay, at 10 h / (1 - a) kPa, on the
        page of a run, too; below it no water flows."""
        run = self.scene(SAND, {**CLAY, "top_depth_m": 3.0}, weight=1.2e6)
        at = np.array([2.0, 2.9, 5.0])
        piping = limits.limits_of(run, at)[limits.PIPING]
        for h, found in zip(at[:2], piping):
            a = 0.45 - 0.36 * (1 - exp(-h / D / 0.48))
            self.assertAlmostEqual(found, 10 * h / (1 - a), places=9)
        self.assertTrue(np.isnan(piping[2]))
        share = run.columns_at(at)[GRADIENT]
        needs = run.columns_at(at)["required_suction_Pa"] / 1e3
        self.assertAlmostEqual(share[0], needs[0] / piping[0], places=9)
        self.assertEqual(share[2], 0)
        both = self.scene({**CLAY}, {**SAND, "top_depth_m": 3.0}, weight=1.2e6)
        self.assertNotIn(limits.PIPING, limits.limits_of(both, at))

    def test_methods_above_clay(self) -> None:
        """The range of the method has the same flow as the best estimate."""
        run = self.scene(SAND, {**CLAY, "top_depth_m": 3.0}, weight=8e5)
        at = np.array([2.0, 5.0])
        found = suction_methods.answers_of(run.site, at).in_clay
        assert found is not None
        ends = ((0.3, 0.001), (0.6, 0.003))
        for (tip, wall), values in zip(ends, found.cases.values()):
            k = QC * pi * 2.0 * wall
            parts = np.array([TIP * tip * QC, k * INNER, k * D])
            s = max(suction_in_sand(2.0, parts, 8e5), 0.0)
            self.assertAlmostEqual(values[0], s, places=4)

    def test_seal_above_clay(self) -> None:
        """A caisson that rests in sand above clay has a seal."""
        run = self.scene(SAND, {**CLAY, "top_depth_m": 3.0}, weight=1.2e6)
        self.assertIn("Seal", self.text(run))

    def test_seal_with_high_resistance(self) -> None:
        """The seal is held against where high resistance lets it rest, too."""
        run = self.scene(SAND, weight=4e6)
        members = {x: by_hand.ByHand(run.directory, x) for x in ("low", "high")}
        best = by_hand.band_of({**members, "best": by_hand.ByHand(run.directory)})
        assert (found := outcome.whole_way(best)) is not None
        assert (seal := acceptance.seal_of(best, found)) is not None
        rest, allowed = seal.shallow
        self.assertEqual(rest, members["high"].rest)
        self.assertLess(rest, seal.rest)
        left = 1 - (0.45 - 0.36 * (1 - exp(-rest / D / 0.48)))
        self.assertAlmostEqual(allowed, 10 * rest / left, places=3)
        text = " ".join(self.text(best).split())
        self.assertIn(f"with high resistance it rests at {rest:.2f} m: ", text)

    def test_pump(self) -> None:
        """The card has the largest flow, in sand, and that at the largest suction."""
        run = self.scene(SAND, {**CLAY, "top_depth_m": 3.0}, weight=8e5)
        words = " ".join(self.text(run).split())
        self.assertRegex(words, r"m³/h at 3.00 m and .*against 15.2 kPa, of which")
        self.assertRegex(
            words, r"; 50.3 m³/h at 8.00 m, against the largest suction, 1"
        )

    def test_basis_of_piping(self) -> None:
        """That a factor on piping is missing counts where water flows."""
        words = "a default and no design basis"
        run = self.scene(SAND, {**CLAY, "top_depth_m": 3.0}, weight=8e5)
        self.assertIn(words, self.text(run))
        self.assertNotIn(words, self.text(self.scene(CLAY)))


if __name__ == "__main__":
    unittest.main()
