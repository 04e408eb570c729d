# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the program says against its own results, and against meshes at a tip that
would spoil them: program.py."""
import re
import unittest

from program import BAD_INPUT, SUCCESS, Entries, ProgramTest, user_scene

# a short way of a small caisson in a small domain
SMALL: Entries = {
    "Time/Inertia tolerance": "none",
    "Rigid body/Outer diameter": 2.2,
    "Rigid body/Skirt length": 2,
    "Grid/Outer radius": 5,
    "Grid/Bottom": -4,
    "Grid/Top": 3.5,
    "Time/End penetration": 1.3,
}
# In coupled soil with three fixed points in each direction, a cell beneath the tip
# has lost most of its points by 1.5 m, and the water bears what the soil should.
COUPLED: Entries = {
    **SMALL,
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
FALL = "the tip force falls by"
LOST = "has lost"
ONE_CELL = "Cells across the wall = 1 makes the tip far too strong"
FEW_POINTS = "lets cells beneath the tip run out of points"


class RunReview(ProgramTest):
    """Warnings of what the run itself shows, and of what spoils it."""

    def words_of_run(self, entries: Entries) -> str:
        """Return what a run of prm/jack_coarse.prm says."""
        output = {"Frame interval": "never", "Frame penetrations": ""}
        return self.run_program(
            SUCCESS,
            user_scene("jack_coarse"),
            "--output-directory",
            self.directory(),
            entries={**{f"Output/{k}": v for k, v in output.items()}, **entries},
        )

    def test_sound_run(self) -> None:
        """A run without a fault has none of these warnings."""
        text = self.words_of_run({**SMALL, "Time/Mass scaling": 25})
        for words in (FALL, LOST, ONE_CELL, FEW_POINTS):
            self.assertNotIn(words, text)

    def test_fall_of_tip(self) -> None:
        """Sand that dilates, on two cells across the wall."""
        text = self.words_of_run(
            {
                **SMALL,
                "Time/Mass scaling": 100,
                "Soil/Layer 1/Dilatancy angle": 15,
                "Soil/Layer 1/Largest void ratio": 10,
            }
        )
        self.assert_words([FALL, "at a penetration of 0.9", "compare"], text)

    def test_fall_at_a_layer(self) -> None:
        """Where a soft layer begins, the tip force may fall."""
        soft = {
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 0.9,
            "Soil/Layer 2/Friction angle": 15,
            "Soil/Layer 2/Friction angle of the walls": 10,
        }
        text = self.words_of_run({**SMALL, **soft, "Time/Mass scaling": 100})
        self.assertNotIn(FALL, text)

    def test_fall_for_a_reason(self) -> None:
        """A body that slows down, is pulled up and pushed again, or is sucked in
        has less at its tip."""
        velocity = "Rigid body/Velocity table"
        suction: Entries = {
            "Soil/Layer 1/Permeability": 1e-4,
            "Water/Level": "seepage",
            "Water/Suction control": "table",
            "Water/Suction table": "0:0,5:0,6:12000",
            "Rigid body/Submerged weight": 1e5,
        }
        cases: tuple[Entries, ...] = (
            {velocity: "0:0.1,5:0.1,5.01:0.02"},
            {velocity: "0:0.1,6:0.1,6.1:-0.1,8:-0.1,8.1:0.1"},
            suction,
        )
        for entries in cases:
            with self.subTest(entries=entries):
                text = self.words_of_run({**SMALL, "Time/Mass scaling": 100, **entries})
                self.assertNotIn(FALL, text)

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

    def test_lost_work(self) -> None:
        """A viscous transfer takes more than a tenth of the work."""
        text = self.words_of_run(
            {
                **SMALL,
                "Time/Mass scaling": 100,
                "Time/End penetration": 0.9,
                "Method/FLIP fraction": 0,
                "Method/XPIC order": 1,
            }
        )
        self.assert_words([LOST, "of the work of the body", "Mass scaling"], text)

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
