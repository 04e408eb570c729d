# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a made-up caisson that is pulled."""
import unittest
from typing import Any

import numpy as np
from synthetic import write_run
from test_report import SUMMARY, WithPage

import caisson.report as report
from caisson import curves
from caisson.results import Results
from caisson.report import content, pull


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
        self.assertTrue("Averaged over 0.024 m of penetration. Unit" in page)

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
        self.assertIn("This is no design pull-out capacity.", said)

    def test_open_lid(self) -> None:
        """Drained there is no water, and no mechanism beyond friction."""
        run = self.leave_pull(sealed=False)
        names = [name for name, _, _ in pull.cards_of(run)]
        self.assertEqual(names, ["Of which friction outside"])

    def test_begins_where_it_is_pulled(self) -> None:
        """Behind the unloading of 1000 kN, over the first 20 mm; and no kinetic energy
        is negative."""
        run = self.leave_pull(sealed=False)
        history = dict(run.history)
        rise = 2 - history["penetration_m"]
        history["total_force_N"] = 1e6 - 5e7 * np.minimum(rise, 0.026)
        history["kinetic_energy_J"] = np.full(len(rise), -1.0)
        write_run(self.path, history, dict(run.summary))
        run = Results(self.path)
        self.assertEqual(curves.largest_energy_ratio(run.history), 0)
        (figure,) = content.figures_of(run, None)
        pulled = [c for c in figure["curves"] if c["label"] == "pull"][0]
        self.assertAlmostEqual(pulled["x"][0], 0, delta=101)
        self.assertAlmostEqual(pulled["y"][0], 20, delta=2.1)


if __name__ == "__main__":
    unittest.main()
