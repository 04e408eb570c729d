#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Soil that no water leaves, with the water as a bulk modulus."""
import shutil
import unittest
from itertools import pairwise
from pathlib import Path

from program import (
    FAILURE,
    SUCCESS,
    Entries,
    ProgramTest,
    Status,
    history,
    user_scene,
)

UNDRAINED: Entries = {"Water/Level": "undrained"}
NO_FRAMES: Entries = {"Output/Frame interval": 0}
MODULUS = 5e6 * 0.7 / (1.3 * 0.4)  # lambda + 2 mu of the column, Pa
LOAD = 1e4  # Pa
DEPTH = "Time/End penetration"


class Column(ProgramTest):
    """A column of elastic soil that cannot expand sideways, under a load."""

    def load(
        self, water: float, share: float, entries: Entries, status: Status = SUCCESS
    ) -> Path:
        """Run it with this bulk modulus of the water (Pa), which is to bear this
        share of the load."""
        path = self.directory(f"of_{water:g}_{len(entries)}")
        self.run_program(
            status,
            user_scene("verification/consolidation"),
            "--output-directory",
            path,
            entries={
                **UNDRAINED,
                "Grid/Cell width": 0.1,
                "Grid/Cell height": 0.1,
                "Method/Local damping": 0.3,
                "Time/End time": 0.6,
                "Verification/Checks": f"max pore_pressure : {share * LOAD} : 0.002",
                "Water/Bulk modulus": water,
                **entries,
            },
        )
        return path

    def test_share_of_load(self) -> None:
        """Water and soil are compressed alike: each bears what its modulus is."""
        for water in (2e7, 1e8, 1e9):
            with self.subTest(water=water):
                path = self.load(water, water / (water + MODULUS), {})
                # the compressed water holds the work of the load
                self.assertLess(abs(history(path)[-1]["energy_residual"]), 0.01)

    def test_modulus_decides(self) -> None:
        self.load(2e7, 1e8 / (1e8 + MODULUS), {}, FAILURE)

    def test_boiling_is_told(self) -> None:
        """A pull of 200 kPa at the surface: water that bears its share of it boils
        where no more than the atmosphere presses on it."""
        water = 1e9
        share = water / (water + MODULUS)
        path = self.load(
            water,
            -20 * share,
            {
                "Loads/Surrounding pressure": -20 * LOAD,
                "Water/Water depth": 0,
                "Verification/Checks": "",
            },
        )
        last = history(path)[-1]
        margin = 101.3e3 - 1.2e3 + 9810 * 0.05 - 20 * LOAD * share
        self.assertAlmostEqual(last["cavitation_margin_Pa"] / margin, 1, delta=0.02)

    def test_step_is_shorter(self) -> None:
        """The wave is faster by the root of all that resists."""
        steps = [
            history(self.load(water, water / (water + MODULUS), {}))[0]["time_step_s"]
            for water in (1e8, 1e9)
        ]
        ratio = ((1e9 + MODULUS) / (1e8 + MODULUS)) ** 0.5
        # steps are shortened a little to end on records
        self.assertAlmostEqual(steps[0] / steps[1], ratio, delta=0.01)


class Rest(ProgramTest):
    """Soil at rest stays so."""

    def test_layers(self) -> None:
        path = self.directory()
        self.run_scene("equilibrium_layers", path, entries=UNDRAINED)
        last = history(path)[-1]
        self.assertLess(last["max_speed_m_s"], 1e-9)
        self.assertLess(abs(last["pore_pressure_largest_Pa"]), 1e-3)


class Caisson(ProgramTest):
    """The caisson of water/suction.prm, jacked."""

    def jack(self, name: str, entries: Entries, *words: str) -> Path:
        path = self.directory(name)
        self.run_scene(
            "suction", path, SUCCESS, *words, entries={**NO_FRAMES, **entries}
        )
        return path

    def test_water_bears_the_tip(self) -> None:
        """Loose sand that wants to contract leaves its load to the water."""
        rows = {}
        for level in ("drained", "undrained"):
            path = self.jack(level, {"Water/Level": level})
            rows[level] = history(path)[-1]
        drained, undrained = rows["drained"], rows["undrained"]
        water = undrained["tip_water_force_N"]
        self.assertGreater(water, 0.2 * undrained["total_force_with_water_N"])
        self.assertLess(undrained["tip_force_N"], 0.7 * drained["tip_force_N"])
        self.assertLess(abs(undrained["energy_residual"]), 0.02)

    def test_force_with_water_is_a_mean(self) -> None:
        """A row that is ten times as long has the mean of ten rows."""
        rows = []
        for interval in (0.005, 0.05):
            entries: Entries = {
                "Water/Level": "undrained",
                "Output/Record interval": interval,
                "Time/End penetration": 0.6,
            }
            rows.append(history(self.jack(f"{interval}", entries)))
        self.assertGreater(len(rows[0]), 5 * len(rows[1]))
        name, water = "total_force_with_water_N", "tip_water_force_N"
        last_steps = []
        for before, row in pairwise(rows[1]):
            begin, end = before["time_s"] + 1e-6, row["time_s"] + 1e-6
            inside = [x for x in rows[0] if begin < x["time_s"] < end]
            mean = sum(x[name] for x in inside) / len(inside)
            self.assertAlmostEqual(row[name] / mean, 1, delta=1e-3)
            last_steps.append((row["total_force_N"] + row[water]) / mean)
        self.assertGreater(max(abs(ratio - 1) for ratio in last_steps), 0.02)

    def test_open_lid_is_told(self) -> None:
        """A pull whose lid holds no water is no capacity where soil keeps its own."""
        up: Entries = {
            "Rigid body/Velocity": -0.05,
            "Rigid body/Ramp time": 0,
            "Time/End penetration": 0.499,
        }
        held: Entries = {
            "Water/Level": "coupled",
            "Water/Suction control": "table",
            "Water/Suction table": "0:1e3",
        }
        cases: list[tuple[Entries, bool]] = [
            ({**UNDRAINED, **up}, True),
            ({"Water/Level": "coupled", **up}, True),
            ({**held, **up}, False),
            ({"Water/Level": "seepage", **up}, False),
            ({**UNDRAINED, "Time/End penetration": 0.501}, False),
        ]
        for i, (entries, is_told) in enumerate(cases):
            with self.subTest(entries=entries):
                path = self.directory(f"open_{i}")
                text = self.run_scene("suction", path, entries=entries)
                self.assertEqual("open lid" in text, is_told)

    def test_water_does_not_damp(self) -> None:
        """A stiffer water makes the steps shorter, and no more damping of them."""
        losses = []
        for water in (8e7, 3.2e8):
            entries: Entries = {"Water/Bulk modulus": water, DEPTH: 0.56}
            path = self.jack(f"of_{water:g}", {**UNDRAINED, **entries})
            losses.append(history(path)[-1]["numerical_dissipation_J"])
        self.assertAlmostEqual(losses[1] / losses[0], 1, delta=0.15)

    def test_restart_and_ranks(self) -> None:
        """The points carry the pressure through checkpoints and ranks."""
        entries: Entries = {**UNDRAINED, "Time/End time": 0.3}
        begin = self.jack("begin", entries)
        entries["Time/End time"] = 0.32
        rows = [history(self.jack("whole", entries))[-1]]
        for ranks in (1, 2):
            path = self.directory(f"of_{ranks}")
            shutil.copytree(begin, path)
            self.run_scene(
                "suction",
                path,
                SUCCESS,
                "--restart",
                entries={**NO_FRAMES, **entries},
                ranks=ranks,
            )
            rows.append(history(path)[-1])
        whole, of_one, of_two = rows
        for name in ("tip_water_force_N", "tip_force_N"):
            self.assertAlmostEqual(of_two[name] / of_one[name], 1, 6, msg=name)
        # that of the last step; the steps are chosen again
        name = "tip_water_force_N"
        self.assertAlmostEqual(of_one[name] / whole[name], 1, 3, msg=name)


class BadInput(ProgramTest):
    """Scenes without an answer, and answers that are in doubt."""

    def test_messages(self) -> None:
        cases: list[tuple[Entries, list[str]]] = [
            ({"Soil/Submerged": "false"}, ["undrained", "dry", "Submerged"]),
            ({"Method/Mean volume change": "false"}, ["Mean volume change"]),
            ({"Water/Bulk modulus": 0}, ["Water/Bulk modulus"]),
        ]
        for entries, words in cases:
            with self.subTest(entries=entries):
                self.assert_invalid(
                    words, "verification/consolidation", {**UNDRAINED, **entries}
                )

    def test_warnings(self) -> None:
        cases: list[tuple[Entries, list[str]]] = [
            (
                {**UNDRAINED, "Water/Bulk modulus": 1e7},
                ["not undrained", "Bulk modulus"],
            ),
            (UNDRAINED, ["Permeability", "not used", "undrained"]),
            ({"Water/Bulk modulus": 1e7}, ["Bulk modulus", "not used"]),
        ]
        for entries, words in cases:
            with self.subTest(entries=entries):
                self.assert_reported(
                    words,
                    "verification/consolidation",
                    {
                        "Grid/Cell width": 0.1,
                        "Grid/Cell height": 0.1,
                        "Time/End time": 0.01,
                        "Verification/Checks": "",
                        **entries,
                    },
                )


if __name__ == "__main__":
    unittest.main()
