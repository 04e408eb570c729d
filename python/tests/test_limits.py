# SPDX-License-Identifier: LGPL-2.1-or-later
"""The limits of the suction, each of which governs once in a made-up run, and their
factors."""
import html
import json
import re
import unittest
from typing import Any

import numpy as np
from synthetic import write_columns
from test_report import SCENE, SUMMARY, WithPage, leave_run

import caisson.report as report
from caisson import plot
from caisson.verdict import limits, outcome
from caisson.report import page, verdict
from caisson.verdict import installation
from caisson.results import Results
from caisson.shown import USUAL
from caisson.template import say

SAND = SCENE["layers"][0]
CLAY = {**SAND, "friction_angle_deg": 0, "cohesion_Pa": 5e3, "wall_adhesion_Pa": 1e3}
SKIRT = {**SCENE, "skirt_length_m": 7.0}


class Governing(WithPage):
    """A required suction of 10 kPa for each meter below 1.5 m, to 4.5 m: the heave is
    5 % of the way, and the exit gradient 0.1 of 0.9 for each meter."""

    def run_of(
        self,
        scene: dict[str, Any] = {},
        entries: dict[str, str] = {},
        columns: dict[str, float] = {},
    ) -> Results:
        """Leave a run whose scene, entries and columns (by factors) are changed."""
        summary = {**SUMMARY, "scene": {**SKIRT, **scene}}
        leave_run(self.path, {**summary, "entries": entries})
        history = dict(Results(self.path).history)
        history["cavitation_suction_Pa"] = 400e3 * np.ones(len(history["time_s"]))
        for name, factor in columns.items():
            values = history.pop(name)
            if factor:
                history[name] = factor * values
        write_columns(self.path / "history.csv", history)
        return Results(self.path)

    def installation(self, run: Results) -> installation.Installation:
        found = installation.installation_of(run, installation.Rate())
        assert found is not None
        return found

    def check(self, run: Results, name: str, depth: float, words: str) -> None:
        """The suction ends at a depth (m) by a limit, in table, page and run.json."""
        said, depth = verdict.verdict_of(run), limits.rounded_down(depth)
        self.assertEqual(said.reason, words)
        self.assertAlmostEqual(said.end or 0, depth, places=6)
        page = report.write(self.path).read_text(encoding="utf-8")
        text = html.unescape(re.sub("<[^>]*>", " ", page.split("<script")[0]))
        self.assertRegex(text, rf"governed by[^0-9]*{re.escape(name)}")
        known = json.loads((self.path / "verdict.json").read_text(encoding="utf-8"))
        self.assertEqual(known["limits"][-1]["governed_by"], name)
        self.assertAlmostEqual(known["limits"][-1]["penetration_m"], depth, places=6)
        colors = [limit.color for limit in limits.LIMITS.values()]
        self.assertEqual(len(set(colors)), len(colors))

    def test_exit_gradient(self) -> None:
        """0.24 for each meter is 0.9 at 3.75 m."""
        columns = {f"exit_gradient_{place}": 2.4 for place in ("wall", "axis")}
        self.check(self.run_of(columns=columns), limits.COMPUTED, 3.75, "piping")

    def test_houlsby_byrne(self) -> None:
        """Soil of 4 kN/m3 pipes early; the computed gradient does not."""
        layer = {**SAND, "submerged_unit_weight_N_m3": 4000.0}
        run = self.run_of({"layers": [layer]})
        found = self.installation(run)
        limit, required = found.limits[limits.PIPING], found.required
        meets = float(np.interp(0, required - limit, found.depth))
        words = "piping by Houlsby & Byrne"
        self.check(run, limits.PIPING, meets, words)

    def clay(self, layers: list[dict[str, Any]], factors: dict[str, str]) -> Results:
        nothing = "exit_gradient_wall", "exit_gradient_axis", "critical_gradient"
        gone = dict.fromkeys(nothing, 0.0)
        return self.run_of({"layers": layers}, factors, gone)

    def test_reverse_bearing(self) -> None:
        """At the depth h the plug bears 30 (1 + 0.02 h) + 4 h / 9.92 kPa over 1.5: 20 +
        0.669 h, which is 10 (h - 1.5) at h = 3.75 m; and 2 as the factor leaves 15 +
        0.502 h, at 3.16 m."""
        given = {"Design/Factor on plug failure": "2"}
        for factor, depth in (("1.5", 3.751), ("2", 3.158)):
            factors = given if factor == "2" else {}
            run = self.clay([CLAY], factors)
            words = f"reverse bearing of the plug, factor {factor}"
            self.check(run, limits.REVERSE_BEARING, depth, words)

    def test_crust(self) -> None:
        """Of 20 kPa over 2 kPa at 3 m, a block of 20 (3 - h) 4 / 9.92 and 12.72 kPa
        below it, with h 4 / 9.92, bear 10 (h - 1.5) kPa 1.5 times down to 2.62 m; the
        soft clay is named in the verdict, in the tables, and in run.json."""
        soft = {**CLAY, "cohesion_Pa": 2e3, "top_depth_m": 3.0}
        run = self.clay([{**CLAY, "cohesion_Pa": 20e3}, soft], {})
        below = "the soft layer below governs, from 3 m"
        words = f"reverse bearing of the plug, factor 1.5: {below}"
        self.check(run, limits.REVERSE_BEARING, 2.62, words)
        self.assertIn(f"({words})", verdict.verdict_of(run).text)
        page = (self.path / "report.html").read_text(encoding="utf-8")
        self.assertGreaterEqual(page.split("<script")[0].count(below), 4)
        known = json.loads((self.path / "verdict.json").read_text(encoding="utf-8"))
        self.assertEqual(known["limits"][-1]["soft_layer_top_m"], 3)
        found = self.installation(run)
        self.assertIn(below, found.governing_in_words(2))
        self.assertNotIn("soft", found.governing_in_words(-1))

    def test_end_in_the_first_row(self) -> None:
        """Suction that is too much from the first row on ends there, and not at the
        decimeter above."""
        run = self.run_of(entries={"Water/Largest suction": "1e3"})
        at = np.array([2.36, 2.5])
        found = installation.installation_of(run, installation.Rate(), at)
        assert found is not None
        ended = outcome.end_of_suction(run, found)
        self.assertEqual(ended, (2.36, limits.PUMP))

    def test_lift(self) -> None:
        """3 m of clay of 2 kN/m3 are lifted off the sand by 6 kPa, the adhesion of 4 *
        1 kPa / 9.92 m for each meter above 3 m, and the strength of 5 kPa below the
        tip: 6 + 0.403 h + 2.016 (3 - h), which is 10 (h - 1.5) at 2.33 m, and its half
        at 1.95 m."""
        light = {**CLAY, "submerged_unit_weight_N_m3": 2000.0}
        layers = [light, {**SAND, "top_depth_m": 3.0}]
        self.check(self.clay(layers, {}), limits.LIFT, 27.048 / 11.613, limits.LIFT)
        run = self.clay(layers, {"Design/Factor on plug lift": "2"})
        self.check(run, limits.LIFT, 21.024 / 10.8065, f"{limits.LIFT}, factor 2")

    def test_boiling(self) -> None:
        """12 kPa at 2.7 m; 8 kPa by a factor of 1.5, at 2.3 m."""
        few = {"cavitation_suction_Pa": 0.03}
        words = "boiling below the lid"
        self.check(self.run_of(columns=few), limits.BOILING, 2.7, words)
        run = self.run_of(entries={"Design/Factor on boiling": "1.5"}, columns=few)
        self.check(run, limits.BOILING, 2.3, f"{words}, factor 1.5")

    def test_pump(self) -> None:
        run = self.run_of(entries={"Water/Largest suction": "11e3"})
        self.check(run, limits.PUMP, 2.6, "pump")

    def test_lid(self) -> None:
        """Of 4 m of skirt, 5 % of heave leave 4 / 1.05 m; three times as much by a
        factor leaves 4 / 1.15 m."""
        short = {"skirt_length_m": 4.0}
        self.check(self.run_of(short), limits.LID, 4 / 1.05, "plug meets the lid")
        run = self.run_of(short, {"Design/Factor on plug heave": "3"})
        words = "plug meets the lid, factor 3"
        self.check(run, limits.LID, 4 / 1.15, words)

    def test_without_run_json(self) -> None:
        """No reason is made up for what is not known."""
        self.assertGreater(len(limits.absent_of(self.run_of(), {})), 3)
        (self.path / "run.json").unlink()
        found = limits.absent_of(Results(self.path), {})
        self.assertEqual(found, ["limits: not known without run.json"])

    def test_around_tops(self) -> None:
        """A row at each top of a layer on the way, and one just below; none beyond."""
        tops = [{**SAND, "top_depth_m": top} for top in (0, 2.2, 5)]
        found = installation.around_tops(self.run_of({"layers": tops}), 0.5, 4.5)
        np.testing.assert_allclose(found, [2.2, 2.204])

    def test_lid_by_the_wall(self) -> None:
        """Where less heave is computed, 0.5 % of the way, than the wall of 0.2 m takes
        up, (10 / 9.6)^2 - 1 = 8.507 % of the way, half of it down to 1.5 m, room is
        kept for the latter: (4 + 0.75 * 0.08507) / 1.08507 = 3.745 m."""
        scene = {"skirt_length_m": 4.0, "wall_thickness_m": 0.2}
        run = self.run_of(scene, columns={"plug_heave_m": 0.1})
        self.check(run, limits.LID, 3.745, "plug meets the lid")
        found = self.installation(run)
        at = float(found.depth[-1])
        self.assertAlmostEqual(found.heave[-1], 0.005 * at, delta=1e-3)
        self.assertAlmostEqual(found.expected[-1], 0.08507 * (at - 0.75), delta=2e-3)
        self.assertAlmostEqual(found.room[-1], 4 - at - found.expected[-1])
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertRegex(page, r"all of it under suction; computed\s+0\.02 m")
        self.assertRegex(page, r"plug heave computed \(m\).*plug heave expected \(m\)")

    def test_shell(self) -> None:
        """10 mm for 10 m of diameter buckle; a lower factor and rings help."""
        thin = {"wall_thickness_m": 0.01}
        run = self.run_of(thin)
        found = self.installation(run)
        limit, required = found.limits[limits.SHELL], found.required
        meets = float(np.interp(0, required - limit, found.depth))
        self.assertLess(meets, 3.0)
        words = "wall buckles (DNV-RP-C202), factor 1.3"
        self.check(run, limits.SHELL, meets, words)
        for entry, value in (
            ("Factor on shell buckling", "1"),
            ("Ring stiffener spacing", "1"),
            ("Fixity depth over diameter", "0.1"),
        ):
            run = self.run_of(thin, {f"Design/{entry}": value})
            more = self.installation(run).limits[limits.SHELL]
            higher = found.depth > 2  # a shallower fixity is above the tip from there
            self.assertTrue((more > 1.1 * limit)[higher].all(), entry)

    def test_rings_and_steps(self) -> None:
        """A ring of the scene divides the wall if it is stiff enough, which is said;
        the thinnest part of the wall counts."""
        thin = {"wall_thickness_m": 0.01}
        step = {"wall_step_1_above_tip_m": 1.0, "wall_step_1_thickness_m": 0.01}
        ring = {**thin, "ring_1_above_tip_m": 4.0, "ring_1_height_m": 0.04}
        found, rings, at = list[float](), list[tuple[int, int]](), np.array([2.0])
        for scene in (
            thin,
            {"wall_thickness_m": 0.02, **step},
            {**ring, "ring_1_width_m": 0.05},
            {**ring, "ring_1_width_m": 0.3},
        ):
            run = self.run_of(scene)
            found.append(float(limits.limits_of(run, at)[limits.SHELL][0]))
            rings.append(limits.rings_counted(run, at))
        plain, stepped, weak, stiff = found
        self.assertEqual((weak, rings[:2]), (plain, [(0, 0), (0, 0)]))
        below = {**thin, **step, "wall_step_1_thickness_m": 0.02}
        below["wall_step_1_above_tip_m"] = 1.5  # 6 and 3.5 m below the lid buckle
        fixed, at = {"Design/Fixity depth over diameter": "0.1"}, np.array([2.0, 4.5])
        thick, mixed, slim = (
            limits.limits_of(self.run_of(x, fixed), at)[limits.SHELL]
            for x in ({"wall_thickness_m": 0.02}, below, thin)
        )
        np.testing.assert_allclose(mixed, [slim[0], thick[1]], rtol=0.02)
        self.assertAlmostEqual(stepped / plain, 1, delta=0.01)
        self.assertEqual(rings[2], (1, 0))
        self.assertGreater(stiff, 1.2 * plain)
        self.assertEqual(rings[3], (1, 1))
        for counted, words in zip(rings[2:], ("are not counted where", "divide")):
            said = say(page.SENTENCES, "factors", USUAL, [], counted, [])
            self.assertIn(f"Rings {words} the wall", said)

    def test_all_kinds_have_a_row(self) -> None:
        """Those of which a run has none say why."""
        run = self.run_of()
        rows = installation.quarters_of(run, self.installation(run), None, 4.5)["rows"]
        names = [row[0] for row in rows]
        for kind in ("pump: Water/Largest suction not given", "plug of clay: no clay"):
            self.assertIn(kind, names)
        for name in (limits.COMPUTED, limits.PIPING, limits.BOILING):
            self.assertIn(name, names)
        self.assertIn("plug meets the lid: at about 6.7 m", names)

    def test_stopped_before_a_quarter_under_suction(self) -> None:
        """A run to 2.4 m, of which the first quarter is 1.25 m, where the weight
        suffices, or 5 m, has its limits at 2.4 m, and denies none of its entries."""
        layers = [SAND, {**CLAY, "top_depth_m": 12.0}]
        pump = {"Water/Largest suction": "90e3"}
        for planned, n in ((5.0, 1), (20.0, 0)):
            run = self.run_of({"layers": layers}, pump)
            down = run.history["penetration_m"] < 2.401
            table = {name: values[down] for name, values in run.history.items()}
            write_columns(self.path / "history.csv", table)
            run = Results(self.path)
            found = self.installation(run)
            answer = installation.quarters_of(run, found, None, planned)
            self.assertEqual(answer["heads"][1 + n], "reached: 2.4 m")
            rows = {row[0]: row[1:] for row in answer["rows"]}
            for name in (limits.COMPUTED, limits.BOILING, limits.PUMP):
                self.assertGreater(float(rows[name][n]), 9.0, name)
            self.assertTrue(any(name.startswith(limits.LID) for name in rows))
            self.assertTrue(any(name.startswith(limits.SHELL) for name in rows))
            absent = [name for name in rows if ": " in name and "lid" not in name]
            self.assertEqual(absent, ["plug of clay: none at these depths"])

    def test_load_of_a_shell(self) -> None:
        """wall_pressure.csv has 25 kPa down to the mudline at 4 m, and 20 below."""
        self.no_pictures.stop()
        run = self.run_of()
        z = np.linspace(0.1, 4.0, 9)
        walls = {"time_s": 4.0 + 0 * z, "penetration_m": 4.0 + 0 * z, "depth_m": z}
        walls |= {f"{side}_area_m2": 1 + 0 * z for side in ("inner", "outer")}
        walls |= {
            "inner_normal_stress_Pa": 5e3 + 0 * z,
            "outer_normal_stress_Pa": 0 * z,
        }
        walls |= {"inner_pore_pressure_Pa": -25e3 + 0 * z}
        walls |= {f"{side}_shear_stress_Pa": 0 * z for side in ("inner", "outer")}
        walls["horizontal_stress_at_rest_Pa"] = 0 * z
        write_columns(self.path / "wall.csv", walls)
        plot.draw(self.path)
        found = Results(self.path).table("wall_pressure.csv", "below_lid_m")
        self.assertEqual(found["below_lid_m"][:2].tolist(), [0, 3])
        net = found["net_external_pressure_Pa"]
        self.assertTrue(np.allclose(net[:2], 25e3) and np.allclose(net[2:], 20e3))
        self.assertTrue(run.history)


class LidDepth(unittest.TestCase):
    """Where the plug meets the lid."""

    def test_beyond_the_run(self) -> None:
        """As over the last meter, in which the room falls by 1.2 m; a room that falls
        by a twentieth only is taken to fall by a tenth."""
        depth = np.array([3.0, 3.5, 4.0])
        found = limits.lid_depth(depth, np.array([1.8, 1.2, 0.6]))
        self.assertAlmostEqual(found or 0, 4.5)
        found = limits.lid_depth(depth, np.array([0.65, 0.625, 0.6]))
        self.assertAlmostEqual(found or 0, 10.0)

    def test_between_rows(self) -> None:
        depth, room = np.array([3.0, 3.5, 4.0]), np.array([0.4, 0.1, -0.3])
        self.assertAlmostEqual(limits.lid_depth(depth, room) or 0, 3.625)


if __name__ == "__main__":
    unittest.main()
