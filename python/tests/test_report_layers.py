# SPDX-License-Identifier: LGPL-2.1-or-later
"""The layers of a report: one row for each, whatever changes with depth in it."""
import unittest
from typing import Any

from test_report import SCENE, SUMMARY, WithPage, leave_run

from caisson.report import layers, sketch
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
        self.assertIn("D_r = 95 %", drawn)
        self.assertIn("s_u = 2 + 1.5 d kPa", drawn)


if __name__ == "__main__":
    unittest.main()
