# SPDX-License-Identifier: LGPL-2.1-or-later
"""The layers of a report, a row for each, and the page of a caisson that is pulled."""
import json
import unittest
from typing import Any
from unittest import mock

import numpy as np
from synthetic import write_run
from test_report import leave_run, SCENE, SUMMARY, WithPage

import caisson.report as report
from caisson.report import content, layers, pull, sketch
from caisson.results import Results


SAND: dict[str, Any] = {
    "layer": 2,
    "top_depth_m": 10.0,
    "law": "Mohr-Coulomb by density and stress",
    "relative_density": 0.95,
    "friction_angle_deg": 33,
}


def clay(curve: float = 0.0) -> list[dict[str, Any]]:
    """Return the 100 parts of a layer with s_u = 2 + 1.5 d kPa, each of its middle, and
    a quadratic part."""
    middles = [0.05 + 0.1 * i for i in range(100)]
    return [
        {
            "layer": 1,
            "top_depth_m": d - 0.05,
            "law": "Mohr-Coulomb",
            "friction_angle_deg": 0,
            "cohesion_Pa": 2e3 + 1.5e3 * d + curve * d**2,
            "law_entries": [
                {
                    "entry": "Cohesion",
                    "value": 2e3 + 1.5e3 * d + curve * d**2,
                    "unit": "Pa",
                }
            ],
        }
        for d in middles
    ]


class Layers(WithPage):
    """A caisson in clay on dense sand."""

    def run_of(self, soil: list[dict[str, Any]], level: str = "drained") -> Results:
        """Leave a run in a soil, and return it."""
        scene = {**SCENE, "layers": soil, "skirt_length_m": 5.0}
        defaults = {"Water/Level": level}
        leave_run(self.path, {**SUMMARY, "scene": scene, "defaults": defaults})
        return Results(self.path)

    def rows(self, run: Results) -> list[dict[str, str]]:
        """Return the texts of the table of the layers by heads."""
        table = layers.soil_table(run)
        rows = [[text for text, _ in row] for row in table["rows"]]
        return [dict(zip(table["heads"], row)) for row in rows]

    def test_one_row_for_each_layer(self) -> None:
        """Not 101; the range of the clay is down to the skirt of 5 m."""
        clay_row, sand_row = self.rows(self.run_of([*clay(), SAND], "seepage"))
        self.assertEqual(clay_row["strength"], "s_u = 2 + 1.5 d kPa (2 to 9.5 kPa)")
        self.assertEqual(clay_row["soil"], "clay, undrained (total stress)")
        self.assertEqual(sand_row["strength"], "D_r = 95 %")
        self.assertEqual(sand_row["soil"], "sand, seepage")
        self.assertEqual(sand_row["from (m)"], "10")
        table = layers.layers_table(Results(self.path))
        self.assertEqual(table["heads"], ["layer", "1", "2"])

    def test_assumed_strength(self) -> None:
        """Only what decides it counts: sand with a given angle has the cohesion 0."""
        sand = {"top_depth_m": 0, "law": "Mohr-Coulomb", "friction_angle_deg": 34}
        run = self.run_of([sand, {**sand, "top_depth_m": 5.0, "cohesion_Pa": 2e3}])
        for entry, marks in (
            ("Cohesion", [False, True]),
            ("Friction angle", [True] * 2),
        ):
            every = [f"Soil/Layer {i}/{entry}" for i in (1, 2)]
            with mock.patch.dict(run.summary, {"assumed": every}):
                table = layers.soil_table(run)
            place = table["heads"].index("strength")
            self.assertEqual([row[place][1] for row in table["rows"]], marks)

    def test_curve_over_depth(self) -> None:
        """Only the range is said, down to the skirt."""
        (row,) = self.rows(self.run_of(clay(100.0)))
        self.assertRegex(row["strength"], r"^s_u = 2\.0\d to 1[12]\.?\d? kPa$")

    def test_clay_is_never_drained(self) -> None:
        page = self.run_of(clay())
        self.assertIn("undrained clay (total stress)", layers.use_of(page))
        self.assertNotIn("drained,", layers.use_of(page).replace("undrained", ""))
        mixed = self.run_of([*clay(), SAND])
        words = "clay undrained (total stress), sand drained"
        self.assertEqual(layers.drainage_of_run(mixed), words)
        coupled = self.run_of([*clay(), SAND], "coupled")
        self.assertEqual(layers.drainage_of_run(coupled), "coupled")

    def test_sketch(self) -> None:
        """Two bands, and the density of sand."""
        run = self.run_of([*clay(), {**SAND, "top_depth_m": 2.0}])
        drawn = sketch.of_run(run, 4.5, None)
        self.assertEqual(drawn.count('<rect class="soil'), 2)
        self.assertIn("Dᵣ = 95 %", drawn)
        self.assertIn("sᵤ = 2 + 1.5 d kPa", drawn)
        self.assertNotIn("<line", drawn.partition("<text")[2])  # across no text

    def test_narrow_sketch(self) -> None:
        """Where the words on the rest are wider than the caisson there are fewer."""
        run = self.run_of(clay())
        self.assertIn("rests by weight at 2.00 m", sketch.of_run(run, 4.5, 2.0))
        with mock.patch.dict(run.scene, {"diameter_m": 3.0, "skirt_length_m": 12.0}):
            self.assertIn(">rests at 2.00 m<", sketch.of_run(run, 11.0, 2.0))


class Pulled(WithPage):
    """Friction of 300 kN, and water of 600 kN beneath a sealed lid."""

    def leave_pull(self, sealed: bool, rise: float = 0.05) -> Results:
        """Leave a run that sinks a little, and rises from 2 to 1.9 m. rise: over which
        the pull grows (m)."""
        depth = np.linspace(2, 1.9, 51)
        depth[:2] = 1.999, 2
        share = np.minimum((2 - depth) / rise, 1.0)
        table: dict[str, np.ndarray] = {"time_s": 2 - depth, "penetration_m": depth}
        parts = {"outer_friction": 2e5, "inner_friction": 1e5, "tip_force": 0.0}
        for name, most in {**parts, "total_force": 3e5}.items():
            table[f"{name}_N"] = -most * share
        if sealed:
            table["total_force_with_water_N"] = -9e5 * share
            for name in ("lid_growth", "seepage_volume", "lid_leak", "lid_expansion"):
                table[f"{name}_m3"] = 0.1 * (2 - depth)
            table["plug_rise_m3"] = 0.9 * (2 - depth)
            table["lid_cavity_m3"] = 0.0 * share
            table["tip_water_force_N"] = table["lid_water_balance"] = 0.0 * share
        table["external_work_J"] = 1e5 * share + 1
        table["kinetic_energy_J"] = 0.0 * share
        summary: dict[str, Any] = {**SUMMARY}
        summary["start_penetration_m"] = 1.999
        summary["entries"] = {"Water/Level": "coupled" if sealed else "drained"}
        write_run(self.path, table, summary)
        return Results(self.path)

    def test_cards_and_curves(self) -> None:
        """The page begins with the pull and what fails, and draws no installation."""
        run = self.leave_pull(sealed=True)
        cards = {name: (value, remark) for name, value, remark in pull.cards_of(run)}
        self.assertEqual(cards["Of which friction outside"][0], "200 kN")
        self.assertEqual(cards["Of which water beneath lid and tip"][0], "600 kN")
        said = pull.sentence_of(run)
        self.assertIn("900 kN after a rise of 50 mm (reverse bearing: ", said)
        (figure,) = content.figures_of(run, None)
        ends = {c["label"]: (c["x"][-1], c["y"][-1]) for c in figure["curves"]}
        self.assertEqual(ends["pull"], (900, 100))
        self.assertEqual(ends["water beneath lid and tip"], (600, 100))
        self.assertEqual(ends["outer friction"], (200, 100))
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertTrue("h = 2.00 m" in page)
        self.assertTrue("coupled, sealed lid, pulled up" in page)
        self.assertFalse("nan %" in page)
        # where it begins, and the window of a rise of 0.1 m
        self.assertTrue("<td>Penetration at the start</td><td>1.999 m</td>" in page)
        self.assertTrue("Averaged over 0.0096 m of penetration. Unit" in page)

    def test_no_capacity(self) -> None:
        """A load that the caisson holds is no capacity."""
        run = self.leave_pull(sealed=True, rise=0.1)
        said = pull.sentence_of(run)
        self.assertTrue(
            said.startswith("Pulled from 2 m: 900 kN after a rise of 100 mm")
        )
        self.assertIn(
            "not the capacity). The submerged weight of 1 MN adds to it", said
        )
        self.assertIn("This is no design pull-out capacity: no factor is in it.", said)

    def test_open_lid(self) -> None:
        """Drained there is no water, and no mechanism beyond friction."""
        run = self.leave_pull(sealed=False)
        names = [name for name, _, _ in pull.cards_of(run)]
        self.assertEqual(names, ["Of which friction outside"])
        self.assertEqual(layers.use_of(run), "drained, open lid, pulled up")

    def test_clay_is_not_drained(self) -> None:
        """Neither by an open lid, nor where water pushes the caisson out."""
        self.leave_pull(sealed=False)
        known: dict[str, Any] = json.loads((self.path / "run.json").read_text("utf-8"))
        known["scene"]["layers"] = clay()
        (self.path / "run.json").write_text(json.dumps(known), encoding="utf-8")
        run = Results(self.path)
        words = "undrained clay (total stress), "
        self.assertEqual(layers.use_of(run), words + "open lid, pulled up")
        run.history["suction_Pa"] = np.full(51, -1e4)
        self.assertEqual(layers.use_of(run), words + "pushed out by water")

    def test_begins_where_it_is_pulled(self) -> None:
        """Behind the unloading of 1000 kN, over the first 20 mm."""
        run = self.leave_pull(sealed=False)
        history = dict(run.history)
        rise = 2 - history["penetration_m"]
        history["total_force_N"] = 1e6 - 5e7 * np.minimum(rise, 0.026)
        write_run(self.path, history, dict(run.summary))
        run = Results(self.path)
        (figure,) = content.figures_of(run, None)
        pulled = [c for c in figure["curves"] if c["label"] == "pull"][0]
        self.assertAlmostEqual(pulled["x"][0], 0, delta=101)
        self.assertAlmostEqual(pulled["y"][0], 20, delta=2.1)


if __name__ == "__main__":
    unittest.main()
