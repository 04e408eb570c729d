#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pore water whose pressure follows from the motion of the soil."""
import shutil
import unittest
from pathlib import Path

from program import (
    BAD_INPUT,
    FAILURE,
    SUCCESS,
    Entries,
    ProgramTest,
    Status,
    history,
    user_scene,
)

COARSE: Entries = {"Grid/Cell width": 0.1, "Grid/Cell height": 0.1}
COUPLED: Entries = {"Water/Level": "coupled"}
AT_REST: Entries = {
    "Rigid body/Velocity": 0,
    "Rigid body/Ramp time": 0,
    "Water/Suction control": "table",
    "Water/Suction table": "0:0, 0.5:2000",
    "Time/End penetration": "never",
    "Time/End time": 1,
}
NO_SUCTION: Entries = {
    "Water/Suction control": "table",
    "Water/Suction table": "0:0, 1:0",
}


class Column(ProgramTest):
    """Columns of soil that have a known answer."""

    def run_column(self, name: str, entries: Entries, status: Status = SUCCESS) -> Path:
        path = self.directory()
        self.run_program(
            status,
            user_scene(f"verification/{name}"),
            "--output-directory",
            path,
            entries=entries,
        )
        return path

    def test_consolidation(self) -> None:
        path = self.run_column("consolidation", COARSE)
        last = history(path)[-1]
        self.assertAlmostEqual(last["pore_pressure_largest_Pa"] / 9490.5, 1, 2)
        self.assertLess(last["water_balance"], 1e-8)

    def test_permeability_decides(self) -> None:
        entries = {**COARSE, "Soil/Layer 1/Permeability": 1.1e-4}
        self.run_column("consolidation", entries, FAILURE)

    def test_time_compression(self) -> None:
        """Ten times faster with a tenth of the permeability is the same."""
        entries = {
            **COARSE,
            "Soil/Layer 1/Permeability": 1e-5,
            "Water/Time compression": 10,
        }
        self.run_column("consolidation", entries)

    def test_old_pressure_must_be_kept(self) -> None:
        """Without it, soil that conducts badly drains by error."""
        left = {}
        for kept in (0, 0.95):
            entries = {
                **COARSE,
                "Soil/Layer 1/Permeability": 1e-7,
                "Time/Mass scaling": 1,
                "Water/Kept pressure": kept,
                "Verification/Checks": "",
                "Verification/Observations": "p = mean pore_pressure",
                "Time/End time": 0.3,
                "Output/Record interval": 0.1,
            }
            path = self.run_column("consolidation", entries)
            left[kept] = history(path, "observations")[-1]["p"]
        self.assertGreater(left[0.95], 0.91e4)
        self.assertLess(left[0], 0.86e4)

    def test_upward_flow(self) -> None:
        """Just below the critical gradient nothing moves; just above, all does."""
        self.run_column("updraft", {})
        entries = {
            "Water/Bottom pressure": "1.05*8829*min(t, 1)",
            "Verification/Checks": "",
            "Output/Record interval": 1,
        }
        path = self.run_column("updraft", entries)
        self.assertGreater(history(path, "observations")[-1]["bottom"], 1e-3)


class Rest(ProgramTest):
    """Soil at rest stays so, whatever its layers."""

    def test_layers(self) -> None:
        path = self.directory()
        entries = {**COUPLED, **NO_SUCTION, "Soil/Layer 2/Permeability": 1e-9}
        self.run_scene("equilibrium_layers", path, entries=entries)
        self.assertLess(abs(history(path)[-1]["pore_pressure_largest_Pa"]), 1e-6)


class Caisson(ProgramTest):
    """The caisson of tests/suction.prm."""

    def test_much_permeability_is_seepage(self) -> None:
        """Where water moves freely, its flow is steady at each time."""
        rows = {}
        for level in ("seepage", "coupled"):
            path = self.directory(level)
            entries = {
                **AT_REST,
                "Water/Level": level,
                "Soil/Layer 1/Permeability": 0.1,
                "Soil/Layer 1/Permeability ratio": 1,
            }
            self.run_scene("suction", path, entries=entries)
            rows[level] = history(path)[-1]
        for name in ("tip_water_force_N", "seepage_flow_m3_s"):
            self.assertAlmostEqual(
                rows["coupled"][name] / rows["seepage"][name], 1, delta=0.01, msg=name
            )

    def test_little_permeability_has_excess_pressure(self) -> None:
        path = self.directory()
        entries = {**COUPLED, **NO_SUCTION, "Soil/Layer 1/Permeability": 1e-7}
        self.run_scene("suction", path, entries=entries)
        last = history(path)[-1]
        self.assertGreater(last["tip_water_force_N"], 1e3)
        self.assertLess(last["water_balance"], 1e-7)

    def test_restart_and_ranks(self) -> None:
        """A checkpoint has the pressure, for any number of ranks."""
        begin = self.directory("begin")
        entries = {**COUPLED, "Time/End time": 0.3}
        self.run_scene("suction", begin, entries=entries)
        entries["Time/End time"] = 0.32
        rows = []
        for ranks in (1, 2):
            path = self.directory(f"of_{ranks}")
            shutil.copytree(begin, path)
            self.run_scene(
                "suction", path, SUCCESS, "--restart", entries=entries, ranks=ranks
            )
            rows.append(history(path)[-2:])
        for name in ("total_force_N", "tip_water_force_N", "required_suction_Pa"):
            self.assertAlmostEqual(rows[0][1][name] / rows[1][1][name], 1, 6, msg=name)
        # the pressure goes on where it was
        before, after = (row["tip_water_force_N"] for row in rows[0])
        self.assertAlmostEqual(after / before, 1, delta=0.3)


class BadInput(ProgramTest):
    """Scenes without an answer."""

    def test_warnings(self) -> None:
        """What is known to be wrong is told, and only where it is."""
        cases: list[tuple[Entries, list[str]]] = [
            ({"Soil/Layer 1/Permeability": 1e-8}, ["drains by error", "0.99"]),
            ({"Water/Kept pressure": 1}, ["alternate", "Kept pressure"]),
            ({"Water/Bottom pressure": "1e4"}, ["Drained bottom is false"]),
            ({"Water/Suction table": "0:0, 1:1"}, ["no caisson"]),
        ]
        for entries, words in cases:
            with self.subTest(entries=entries):
                text = self.run_program(
                    SUCCESS,
                    user_scene("verification/consolidation"),
                    "--output-directory",
                    self.directory(),
                    entries={
                        **COARSE,
                        **entries,
                        "Time/End time": 0.01,
                        "Verification/Checks": "",
                    },
                )
                self.assert_words(words, text)
                self.assertEqual(
                    "drains by error" in text, "Soil/Layer 1/Permeability" in entries
                )

    def test_messages(self) -> None:
        cases: list[tuple[Entries, list[str]]] = [
            ({"Soil/Submerged": "false"}, ["Submerged", "dry"]),
            ({"Water/Level": "seepage"}, ["caisson", "coupled"]),
            ({"Water/Drained surface": "false"}, ["nowhere", "Drained bottom"]),
            ({"Water/Bottom pressure": "1e4*x"}, ["Water/Bottom pressure", "x"]),
            ({"Method/Mean volume change": "false"}, ["Mean volume change"]),
        ]
        for entries, words in cases:
            with self.subTest(entries=entries):
                text = self.run_program(
                    BAD_INPUT,
                    user_scene("verification/consolidation"),
                    "--validate",
                    entries=entries,
                )
                self.assert_words(words, text)


if __name__ == "__main__":
    unittest.main()
