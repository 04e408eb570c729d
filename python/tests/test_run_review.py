# SPDX-License-Identifier: LGPL-2.1-or-later
"""What records say against a run: made-up records with known faults."""
import json
import tempfile
import unittest
from pathlib import Path
from typing import Any

import numpy as np
from synthetic import write_columns

from caisson.results import Results, Table
from caisson.verdict import run_review

WALL = 0.1  # m
LAYERS: list[dict[str, Any]] = [
    {"layer": 1, "top_depth_m": 0.0, "law": "Mohr-Coulomb", "law_entries": []}
]
CUT_OFF: list[dict[str, Any]] = [
    {"entry": "Tension cut-off", "value": 1e3, "unit": "Pa"}
]


def tip(*interfaces: float) -> dict[str, Any]:
    """Return the tip of run.json above interfaces at these depths (m)."""
    sizes = {"width_m": WALL, "initial_penetration_m": 0.5}
    radii = {"inner_radius_m": 2.9, "outer_radius_m": 3.0}
    return {**sizes, **radii, "interface_depths_m": list(interfaces)}


def soil(**change: Any) -> dict[str, Any]:
    """Return the scene of run.json, with changes."""
    scene = {
        "wall_thickness_m": WALL,
        "initial_penetration_m": 0.5,
        "inner_wall_adhesion_Pa": 0.0,
        "outer_wall_adhesion_Pa": 2e3,
        "layers": LAYERS,
    }
    return {**scene, **change}


def records(**change: Any) -> Table:
    """Return a sound history at 0.1 m/s to 3.5 m, whose tip bears 100 kN/m."""
    time = np.arange(0, 30.0001, 0.05)
    depth = 0.5 + 0.1 * time
    tip = 1e5 * depth
    work = np.cumsum(tip) * 0.005
    zeros = np.zeros_like(time)
    table = {"time_s": time, "penetration_m": depth, "tip_force_N": tip}
    table |= {"total_force_N": tip, "external_work_J": work, "suction_Pa": zeros}
    table |= {"kinetic_energy_J": 1e-4 * work, "water_work_J": zeros}
    table |= {"inner_friction_N": zeros, "outer_friction_N": zeros}
    return {**table, **change}


class RunReview(unittest.TestCase):
    """Each fault is found, and nothing that has a reason."""

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)

    def run_of(self, table: Table, **change: Any) -> Results:
        """Leave a finished run with this history, and return it."""
        write_columns(self.path / "history.csv", table)
        known = {
            "status": "finished",
            "entries": {"Grid/Geometry": "axisymmetric", "Water/Level": "drained"},
            "energies": {"external_work_J": 1e6, "numerical_dissipation_J": 2e4},
            "results": {"warnings": [{"rank": "input", "text": "coarse"}]},
            "scene": soil(),
            "tip": tip(),
        }
        text = json.dumps({**known, **change})
        (self.path / "run.json").write_text(text, encoding="utf-8")
        return Results(self.path)

    def words(self, table: Table, **change: Any) -> str:
        """Return all warnings of a run, a line each."""
        return "\n".join(run_review.review_of(self.run_of(table, **change)))

    @staticmethod
    def fallen(share: float, way: float, at: float = 2.0) -> Table:
        """Return records whose tip force falls by a share over a way (m) at a depth."""
        table = records()
        gone = np.clip((table["penetration_m"] - at) / way, 0, 1)
        return {**table, "tip_force_N": table["tip_force_N"] * (1 - share * gone)}

    def test_sound_run(self) -> None:
        run = self.run_of(records())
        found = {"result": [], "input": ["coarse"], "cosmetic": []}
        self.assertEqual(run_review.warnings_of(run), found)

    def test_short_way(self) -> None:
        """Forces build up over a few wall thicknesses."""
        for walls, is_said in ((2, True), (4, False)):
            table = records()
            rows = table["penetration_m"] < 0.5 + walls * WALL
            said = self.words({name: x[rows] for name, x in table.items()})
            self.assertEqual("less than 3 wall thicknesses" in said, is_said, said)

    def test_fall_of_tip(self) -> None:
        """By 10 % less what the depth adds, within a quarter of the width of the tip;
        not within three."""
        text = self.words(self.fallen(0.1, WALL / 4))
        self.assertRegex(text, r"^the tip force falls by 8\.6 % within half")
        self.assertRegex(text, r"at a penetration of 2\.0\d+ m")
        self.assertEqual(self.words(self.fallen(0.04, WALL / 4)), "")
        self.assertEqual(self.words(self.fallen(0.1, 3 * WALL)), "")
        self.assertEqual(self.words(self.fallen(0.1, WALL / 4, at=0.6)), "")

    def test_falls_with_a_reason(self) -> None:
        """Another layer, a suction that begins, and a slower body."""
        table = self.fallen(0.2, WALL / 4)
        for top, is_warned in ((2.7, False), (3.0, True)):
            text = self.words(table, tip=tip(top))
            self.assertEqual("falls" in text, is_warned, top)
        self.assertIn("falls", self.words(table, scene={}))  # of a pile
        suction = np.where(table["penetration_m"] > 2, 1e4, 0.0)
        self.assertEqual(self.words({**table, "suction_Pa": suction}), "")
        table = self.fallen(0.2, 1e-3)
        slow = np.where(table["penetration_m"] > 2, 2.0, 1.0)
        time = np.cumsum(0.05 * slow)
        self.assertEqual(self.words({**table, "time_s": time}), "")

    def test_pulled_up(self) -> None:
        """Nothing counts from there on."""
        table = records()
        depth = table["penetration_m"]
        depth = np.where(depth > 2, 4 - depth, depth)
        tip = np.where(table["penetration_m"] > 2, 0, table["tip_force_N"])
        changed = {**table, "penetration_m": depth, "tip_force_N": tip}
        self.assertEqual(run_review.way_down(changed, 0.01)["depth"].max().round(1), 2)
        self.assertNotIn("falls", self.words(changed))

    def test_bare_wall(self) -> None:
        """Adhesion 2 kPa on the outer wall of 3 m; the shape of the tip takes 0.1 m."""
        table = records()
        depth = table["penetration_m"]
        due = 2e3 * 2 * np.pi * 3 * (depth - WALL)
        may_come_off = soil(layers=[{**LAYERS[0], "law_entries": CUT_OFF}])
        for share, words in ((0.8, "is 20 % below"), (0.95, "")):
            changed = {**table, "outer_friction_N": share * due}
            text = self.words(changed, scene=may_come_off)
            self.assertEqual("friction on the outer wall" in text, bool(words))
            self.assertIn(words, text)
        bare = {**table, "outer_friction_N": 0.5 * due}
        self.assertEqual(self.words(bare), "")
        layers = [{**may_come_off["layers"][0], "wall_adhesion_Pa": 1e3}]
        text = self.words(bare, scene=soil(layers=layers))
        self.assertIn("friction on the inner wall is 100 % below", text)
        self.assertNotIn("outer wall", text)

    def test_lost_work(self) -> None:
        """More than 3 % of the work, and than 10 % where water follows the soil."""
        for level, share, is_warned in (
            ("drained", 0.02, False),
            ("drained", 0.061, True),
            ("undrained", 0.061, False),
            ("coupled", 0.12, True),
        ):
            energies = {"external_work_J": 8e5, "water_work_J": 2e5}
            energies["numerical_dissipation_J"] = 1e6 * share
            entries = {"Water/Level": level}
            text = self.words(records(), energies=energies, entries=entries)
            words = f"has lost {100 * share:.2g} % of the work of the body"
            self.assertEqual(words in text, is_warned, (level, share))

    def test_fast_soil(self) -> None:
        table = records()
        work = table["external_work_J"]
        text = self.words({**table, "kinetic_energy_J": 0.02 * work})
        self.assertIn("is 2 % of the work of the body at a penetration of 3.5 m", text)

    def test_damaged_numbers(self) -> None:
        """What is no number takes no part, and is no fault of the program."""
        table = self.fallen(0.1, WALL / 4)
        table["kinetic_energy_J"] = np.where(table["time_s"] > 9, np.nan, 0.0)
        energies = {"external_work_J": None, "numerical_dissipation_J": 1.0}
        text = self.words(table, energies=energies)
        self.assertRegex(text, "^the tip force falls[^\n]*$")
        share = run_review.kinetic_share_of(self.run_of(table))
        assert share is not None
        self.assertEqual(share.share, 0)

    def test_earlier_version(self) -> None:
        """Its run.json has warnings of its own, and no tip."""
        run = self.run_of(self.fallen(0.1, WALL / 4))
        del run.summary["tip"]
        self.assertEqual(run_review.review_of(run), ())
        self.assertIsNotNone(run_review.kinetic_share_of(run))

    def test_waves_of_the_start(self) -> None:
        """Those of 60 and 2 % do not count once they are gone."""
        depth = np.array([0.5, 0.6, 0.7, 0.8, 0.9, 1.0])
        work = np.array([0.0, 1, 10, 50, 90, 140])
        table = {"penetration_m": depth, "external_work_J": work}
        table["total_force_N"] = np.zeros(6)
        for kinetic, start, found in (
            ([0, 0.6, 0.2, 0.1, 0.3, 0.2], 0.6, (0.3 / 90, 0.9)),
            ([0, 0.6, 0.2, 0.1, 9, 0.2], 0.6, (0.1, 0.9)),
            ([0, 0.6, 1, 2, 3, 7], 0.6, (0.05, 1.0)),
        ):
            table["kinetic_energy_J"] = np.array(kinetic)
            share = run_review.kinetic_share(table, start)
            assert share is not None
            np.testing.assert_allclose((share.share, share.penetration), found)
        self.assertIsNone(run_review.kinetic_share(table, 2.0))

    def test_share_of_a_pull(self) -> None:
        """The work is negative, and the release of the tip is no pull."""
        table = {
            "penetration_m": np.array([2, 1.98, 1.96, 1.94]),
            "total_force_N": np.array([1e6, 1e6, -1e3, -1e3]),
            "kinetic_energy_J": np.array([9, 5, 1, 0.5]),
            "external_work_J": np.array([0.0, -1, -100, -50]),
        }
        share = run_review.kinetic_share(table, 0.7)
        assert share is not None
        self.assertAlmostEqual(share.share, 0.01)


if __name__ == "__main__":
    unittest.main()
