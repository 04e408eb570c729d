# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the program says, before a run, against settings that would spoil its results:
program.py."""
import re
import unittest

from program import BAD_INPUT, SUCCESS, Entries, ProgramTest, user_scene

# In coupled soil with three fixed points in each direction, a cell beneath the tip
# has lost most of its points by 1.5 m, and the water bears what the soil should.
COUPLED: Entries = {
    "Time/Inertia tolerance": "none",
    "Grid/Top": 3.5,
    "Rigid body/Outer diameter": 6.2,
    "Rigid body/Skirt length": 2.5,
    "Rigid body/Submerged weight": 1e6,
    "Grid/Outer radius": 6,
    "Grid/Bottom": -5,
    "Grid/Moving zone below tip": 2.5,
    "Grid/Fine width": 0.6,
    "Grid/Fine height": 0.6,
    "Grid/Cell width": 1,
    "Grid/Cell height": 0.25,
    "Material points/Per direction in path": 3,
    "Soil/Layer 1/Cohesion": 100,
    "Soil/Layer 1/Permeability": 1e-4,
    "Water/Level": "coupled",
    "Time/Mass scaling": 100,
    "Time/End penetration": 1.7,
}
ONE_CELL = "Cells across the wall = 1 makes the tip far too strong"
FEW_POINTS = "lets cells beneath the tip run out of points"


class Warnings(ProgramTest):
    """Of settings that spoil the results."""

    def test_volume_of_points(self) -> None:
        """Without a mean volume change, stiff volume is warned of."""
        for nu, is_warned in ((0.3, False), (0.45, True)):
            text = self.run_program(
                SUCCESS,
                user_scene("jack_coarse"),
                "--validate",
                entries={
                    "Soil/Layer 1/Poisson ratio": nu,
                    "Method/Mean volume change": False,
                },
            )
            self.assertEqual("Set Mean volume change = true" in text, is_warned, nu)

    def test_settings_that_change_the_force(self) -> None:
        """They are warned of before the run."""
        points = "Material points/Per direction in"
        cases: tuple[tuple[str, object, str], ...] = (
            ("Method/FLIP fraction", 0, "makes the transfer"),
            ("Method/FLIP fraction", 0.9, "makes the transfer"),
            ("Method/FLIP fraction", 0.95, ""),
            (f"{points} path", 1, "one point per cell"),
            ("Material points/Per direction far", 1, "one point per cell"),
            (f"{points} path", 2, ""),
        )
        for entry, value, words in cases:
            with self.subTest(entry=entry, value=value):
                text = self.run_program(
                    SUCCESS,
                    user_scene("jack_coarse"),
                    "--validate",
                    entries={entry: value},
                )
                self.assertEqual("warning" in text, bool(words), text)
                self.assertIn(words, text)

    def test_surcharge_is_no_strength(self) -> None:
        """The inertia tolerance takes the weight of the soil, not the load on it."""
        steps = []
        for surcharge in (0, 5e5):
            text = self.run_program(
                SUCCESS,
                user_scene("jack_coarse"),
                "--validate",
                entries={"Soil/Surcharge": surcharge},
            )
            steps.append(re.findall(r"time step +(\S+) s", text)[0])
        self.assertEqual(*steps)

    def test_few_points_in_coupled_water(self) -> None:
        """Points that run out beneath the tip would cost half of its force."""
        for split, status in ((False, BAD_INPUT), (True, SUCCESS)):
            text = self.run_program(
                status,
                user_scene("jack_coarse"),
                "--validate",
                entries={**COUPLED, "Material points/Split and merge": split},
            )
            self.assertEqual(FEW_POINTS in text, not split)

    def test_one_cell_across_the_wall(self) -> None:
        """The scene itself is warned of."""
        text = self.run_program(
            SUCCESS,
            user_scene("jack_coarse"),
            "--validate",
            entries={"Rigid body/Cells across the wall": 1, "Rigid body/Tip": "flat"},
        )
        self.assert_words([ONE_CELL, "Set at least 2"], text)


if __name__ == "__main__":
    unittest.main()
