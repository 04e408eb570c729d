# SPDX-License-Identifier: LGPL-2.1-or-later
"""The sentence that says whether a caisson goes in, of made-up runs."""
import html
import json
import re
import unittest
from typing import Any

import numpy as np
from synthetic import write_columns
from test_report import SCENE, SUMMARY, WithPage, leave_run

import caisson.report as report
from caisson import evaluation
from caisson.plot.charts import GRAY
from caisson.report import content, page, verdict
from caisson.verdict import installation, outcome, run_review
from caisson.results import Results

PUMP = {"Water/Largest suction": "20e3", "Time/End penetration": "4.5"}


class Verdicts(WithPage):
    """A required suction of 10 kPa for each meter below 1.5 m, on 77.29 m2."""

    def run_of(self, **change: Any) -> Results:
        """Leave a run, and return it."""
        leave_run(self.path, {**SUMMARY, **change})
        return Results(self.path)

    def change_history(self, **columns: float) -> None:
        """Multiply columns with factors; those times 0 are gone."""
        history = dict(Results(self.path).history)
        for name, factor in columns.items():
            values = history.pop(name)
            if factor:
                history[name] = factor * values
        write_columns(self.path / "history.csv", history)

    def test_feasible(self) -> None:
        text = (
            "Feasible to 4.5 m by weight 1 MN and suction up to 30 kPa, at most 57 % of"
            " the allowable one (piping, Houlsby & Byrne)."
        )
        self.assertEqual(verdict.verdict_of(self.run_of()), (text, None, ""))

    def test_no_suction_at_a_quarter(self) -> None:
        """Of a run to 2.9 m, of 5.8 m planned, the weight suffices at the quarter."""
        run = self.run_of(entries={"Time/End penetration": "5.8"})
        history = dict(run.history)
        down = history["penetration_m"] < 2.85
        columns = {name: values[down] for name, values in history.items()}
        write_columns(self.path / "history.csv", columns)
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("0 (weight suffices)", page)

    def test_end_of_suction(self) -> None:
        """20 kPa of the pump are reached at 3.5 m; at 4.5 m 10 kPa are missing."""
        found = verdict.verdict_of(self.run_of(entries=PUMP))
        self.assertAlmostEqual(found.end or 0, 3.5, places=3)
        self.assertTrue(found.text.startswith("Feasible to 3.5 m: "))
        self.assertIn("reaches the allowable one (pump).", found.text)
        words = "More weight helps; how much in the soil down to 4.5 m is not known."
        self.assertIn(words, found.text)

    def test_end_between_two_rows(self) -> None:
        """The exit gradient of 0.225 for each meter reaches 0.9 at 4 m, and that of
        0.24 at 3.75 m, of which whole decimeters are said."""
        for factor, depth in ((2.25, 4.0), (2.4, 3.7)):
            run = self.run_of()
            self.change_history(exit_gradient_wall=factor, exit_gradient_axis=factor)
            run = Results(self.path)
            found = verdict.verdict_of(run)
            self.assertEqual(found.end, depth)
            self.assertEqual(found.reason, "piping")

    def test_nothing_of_what_is_deeper(self) -> None:
        """No table, no curve but a gray one, and no card has a number from below, nor
        is the end of the run called a refusal."""
        ended = {**SCENE, "end_reason": "the plug fills the caisson (refusal)"}
        run = self.run_of(entries=PUMP, scene=ended)
        page = report.write(self.path).read_text(encoding="utf-8")
        words = html.unescape(re.sub("<[^>]*>", " ", page.split("<script")[0]))
        self.assertNotIn("refusal", words)
        self.assertIn("Computed to 4.5 m, of which 3.5 m are feasible.", words)
        self.assertRegex(words, r"75 %: 3.38 m\s+feasible: 3.5 m\s+100 %: 4.5 m")
        self.assertRegex(words, r"suffices\)\s+7.5\s+18.8\s+20\s+not feasible")
        self.assertRegex(words, r"governed by\s+pump\s+pump\s+pump\s")
        rate = installation.Rate()
        whole = installation.installation_of(run, rate)
        assert whole is not None
        part = verdict.feasible_part(run, whole, 3.5, rate)
        self.assertEqual(part.depth.tolist(), [1, 1.5, 2, 2.5, 3, 3.5])
        for figure in content.figures_of(run, part, 3.5):
            for curve in figure["curves"]:
                if curve.get("thick"):
                    self.assertLessEqual(max(curve["y"]), 3.5)
            gray = [c for c in figure["curves"] if c["color"] == GRAY]
            self.assertTrue(gray and all(min(c["y"]) > 3.5 for c in gray))

    def test_no_warning_of_what_is_deeper(self) -> None:
        """A warning that names a penetration below the end of suction is left out."""
        texts = [f"it rises at a penetration of {h:g} m: soil" for h in (3.2, 4.25)]
        ranked = [{"rank": "result", "text": text} for text in [*texts, "slow"]]
        found = run_review.warnings_of(self.run_of(results={"warnings": ranked}), 3.5)
        self.assertEqual(found["result"], [texts[0], "slow"])

    def test_end_that_the_program_knows(self) -> None:
        """It is taken where the curves do not know better."""
        known = {"penetration_m": 4.2, "reason": "plug lift"}
        scene = {**SCENE, "infeasible": known}
        found = verdict.verdict_of(self.run_of(scene=scene))
        self.assertEqual(found[1:], (4.2, "plug lift"))
        found = verdict.verdict_of(self.run_of(scene=scene, entries=PUMP))
        self.assertEqual(found.reason, "pump")
        scene = {**SCENE, "infeasible": {"penetration_m": 4.4999, "reason": "boiling"}}
        found = verdict.verdict_of(self.run_of(scene=scene))
        self.assertIn("allowable one (boiling below the lid).", found.text)

    def test_critical_gradient_that_the_program_knows(self) -> None:
        """Means over a window may hide it."""
        scene = {**SCENE, "infeasible": {"penetration_m": 4.2, "reason": "piping"}}
        self.assertEqual(verdict.by_gradient(self.run_of(scene=scene)), (4.2, True))
        self.assertEqual(verdict.by_gradient(self.run_of()), (4.5, False))
        clay = {**SCENE["layers"][0], "top_depth_m": 3.0, "friction_angle_deg": 0.0}
        clay["cohesion_Pa"] = 4e4
        both: dict[str, Any] = {**SCENE, "layers": [*SCENE["layers"], clay]}
        self.assertEqual(verdict.by_gradient(self.run_of(scene=both)), (3.0, False))

    def test_end_before_the_planned_one(self) -> None:
        """The sentence says why the run ended there."""
        reason = "the plug fills the caisson: it has reached the lid (refusal)"
        entries = {"Time/End penetration": "6"}
        cases: list[tuple[dict[str, Any], str]] = [
            ({}, "Feasible to 4.5 m, as far as the run is (planned 6 m), by"),
            ({"end_reason": reason}, "There the plug fills the caisson, short of"),
        ]
        for scene, words in cases:
            run = self.run_of(scene={**SCENE, **scene}, entries=entries)
            self.assertIn(words, verdict.verdict_of(run).text)

    def test_rest_at_the_start(self) -> None:
        """Where resistance only builds up, the weight has not pushed anything in."""
        run = self.run_of()
        begin = float(run.history[evaluation.DEPTH][0])
        near, far = (verdict.rest_in_words(run, begin + w) for w in (0.01, 0.5))
        place = run.shown.depth(begin)
        self.assertEqual(near, f"at most {place}, where the run begins")
        self.assertEqual(far, run.shown.depth(begin + 0.5))

    def test_no_weight_for_another_layer(self) -> None:
        """What suction would do in soil that it has not reached is not known."""
        layers = [*SCENE["layers"], {**SCENE["layers"][0], "top_depth_m": 4}]
        run = self.run_of(scene={**SCENE, "layers": layers}, entries=PUMP)
        text = verdict.verdict_of(run).text
        self.assertIn("how much in the soil down to 4.5 m is not known", text)
        self.assertNotIn("MN of weight", text.partition("there")[2])

    def test_clay(self) -> None:
        """A run without exit gradients has a page and tables."""
        self.no_pictures.stop()
        self.run_of()
        self.change_history(
            exit_gradient_wall=0, exit_gradient_axis=0, critical_gradient=0
        )
        run = Results(self.path)
        self.assertIn("suction up to 30 kPa", verdict.verdict_of(run).text)
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertNotIn("exit gradient / critical", page.split("<script")[0])
        self.assertTrue((self.path / "suction.png").is_file())

    def test_jacked(self) -> None:
        self.run_of()
        self.change_history(suction_Pa=0, required_suction_Pa=0)
        text = verdict.verdict_of(Results(self.path)).text
        parts = "tip 2.25 MN, friction inside 1.13 MN, outside 1.13 MN."
        self.assertEqual(text, f"Jacked to 4.5 m: 4.5 MN, of which {parts}")

    def test_jacked_with_flow(self) -> None:
        """No suction acts on a body without a weight, and none is compared."""
        run = self.run_of(scene={**SCENE, "submerged_weight_N": 0.0}, entries=PUMP)
        self.assertRegex(verdict.verdict_of(run).text, "^Jacked to 4.5 m: 4.5 MN")
        found = outcome.whole_way(run)
        assert found is not None
        self.assertEqual((len(found.required), found.limits), (0, {}))
        verdict.keep(run)
        known = json.loads((self.path / "verdict.json").read_text("utf-8"))
        self.assertEqual(list(known), ["verdict", "uncertainty"])
        self.assertEqual(len(known["uncertainty"]), 1)  # of the force

    def test_stopped_on_its_way_out(self) -> None:
        """A retrieval has come to where it is, and not to where it began."""
        self.run_of(status="stopped")
        rows = {k: v[::-1] for k, v in Results(self.path).history.items()}
        rows["time_s"] = rows["time_s"][::-1]
        write_columns(self.path / "history.csv", {k: v[:300] for k, v in rows.items()})
        run = Results(self.path)
        depth = run.history["penetration_m"][-1]
        self.assertIn(f"Stopped at {depth:g} m", page.incomplete_of(run))
        self.assertLess(depth, 2)

    def test_jacked_beyond_the_lid(self) -> None:
        """The lid touches the soil once in passing, and bears on it from 4.2 m on."""
        self.run_of()
        self.change_history(suction_Pa=0, required_suction_Pa=0)
        history = dict(Results(self.path).history)
        depth = history["penetration_m"]
        loads = np.where(depth > 4.195, 1e6, 0.0)
        loads[np.argmin(abs(depth - 3.0))] = 1e6
        write_columns(self.path / "history.csv", {**history, "lid_force_N": loads})
        text = verdict.verdict_of(Results(self.path)).text
        words = "The lid bears on the soil from 4.2 m on, with 1 MN at the end."
        self.assertIn(words, text)
        self.run_of(scene={**SCENE, "skirt_length_m": 4.0})
        self.change_history(suction_Pa=0, required_suction_Pa=0)
        text = verdict.verdict_of(Results(self.path)).text
        self.assertIn("The skirt is 4 m long: below that depth a lid would bear", text)

    def test_kept(self) -> None:
        """In a file of its own: run.json is that of the program, and what came out of
        the run is the same before and after."""
        run = self.run_of()
        before = (self.path / "run.json").read_bytes()
        for _ in range(2):
            text = verdict.keep(run)
        self.assertEqual((self.path / "run.json").read_bytes(), before)
        known = json.loads((self.path / "verdict.json").read_text(encoding="utf-8"))
        self.assertEqual(known.pop("verdict"), text)
        rows, ends = known.pop("limits"), known.pop("uncertainty")
        self.assertEqual(known, {})
        self.assertAlmostEqual(ends[-1]["value_Pa"], 30e3, delta=50)
        last = rows[-1]
        self.assertEqual((last["penetration_m"], last["factor"]), (4.5, 1.0))
        self.assertEqual(last["governed_by"], "piping, Houlsby & Byrne")
        self.assertAlmostEqual(last["required_suction_Pa"], 30e3, delta=50)
        self.assertAlmostEqual(last["required_suction_Pa"] / 0.57, 52.6e3, delta=500)
        self.assertAlmostEqual(last["allowable_suction_Pa"], 52.6e3, delta=500)

    def test_outcome_before_a_report(self) -> None:
        """Nothing below it is in a maximum, whether a report was made or not."""
        self.run_of(entries=PUMP)
        before = outcome.results_of(Results(self.path))
        verdict.keep(Results(self.path))
        known = json.loads((self.path / "verdict.json").read_text(encoding="utf-8"))
        self.assertEqual(known["feasible_to_m"], 3.5)
        self.assertEqual(outcome.results_of(Results(self.path)), before)
        most = before["largest_suction"]
        self.assertAlmostEqual(most["required_suction_Pa"], 20e3, delta=50)


if __name__ == "__main__":
    unittest.main()
