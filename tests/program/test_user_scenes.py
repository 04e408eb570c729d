#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scenes of users, prm/*.prm, and of the laboratory: program.py."""
import itertools
import re
import unittest

from program import (
    checks,
    Entries,
    history,
    ProgramTest,
    SCENES,
    SUCCESS,
    summary,
    user_scene,
)

from caisson import run_error_bar
from caisson.results import Results
from lab import LAB
from lab.studies import scene_results


WITHOUT_A_WARNING = ("jack", "jack_coarse", "jack_dense_sand", "jack_model", "column")
VERTICAL_STRESS = "8829*z"
AT_REST = {
    "Time/Inertia tolerance": "none",
    "Rigid body/Velocity": 0,
    "Rigid body/Ramp time": 0,
    "Time/End penetration": 0,
    "Output/Frame penetrations": "",
    "Output/Frame interval": 0,
    "Output/Record interval": 100,
}


class UserScenes(ProgramTest):
    """They are valid, and their checks pass."""

    def step(self, tip: str, tolerance: str) -> float:
        """Return the first time step of prm/jack.prm (s)."""
        changed = (f"Rigid body/Tip={tip}", f"Time/Inertia tolerance={tolerance}")
        options = [word for entry in changed for word in ("--set", entry)]
        text = self.run_program(SUCCESS, user_scene("jack"), "--validate", *options)
        found = re.search(r"time step +(\S+) s", text)
        assert found is not None
        return float(found[1])

    def test_a_pointed_tip_costs_no_steps(self) -> None:
        """It bends cells, which with the same inertia shorten the step by a quarter;
        with a tolerance they carry more of it."""
        pointed, flat = (self.step(tip, "none") for tip in ("triangular", "flat"))
        self.assertLess(pointed, 0.8 * flat)
        pointed, flat = (self.step(tip, "0.4") for tip in ("triangular", "flat"))
        self.assertGreater(pointed, 0.95 * flat)

    def test_every_user_scene_is_valid(self) -> None:
        """Those that users begin with have no likely mistake, and some no warning. The
        ladder runs its own, lab/verification."""
        others = LAB.glob("[!v]*/**/*.prm"), LAB.glob("validation/**/*.prm")
        for path in sorted({*SCENES.rglob("*.prm"), *itertools.chain(*others)}):
            if "subsection Installation" not in path.read_text():
                with self.subTest(path.name):
                    options = ["--strict"] if path.parent == SCENES else []
                    text = self.run_program(SUCCESS, path, "--validate", *options)
                    if path.parent == SCENES and path.stem in WITHOUT_A_WARNING:
                        self.assertNotIn("warning", text)

    def test_error_bars_are_those_of_today(self) -> None:
        """Each file of errors was computed for the scene as it is now."""
        for name in ("jack", "suction", "suction_coupled"):
            with self.subTest(name):
                path = self.directory(name)
                self.run_program(
                    SUCCESS,
                    user_scene(name),
                    "--output-directory",
                    path,
                    entries={"Time/End time": 0.02},
                )
                bar = run_error_bar.beside(SCENES / f"{name}.prm")
                self.assertTrue(run_error_bar.is_of(Results(path), bar))

    def test_pull_out_after_is_valid(self) -> None:
        """After a short piece of its installation; some steps pull."""
        before, after = self.directory("before"), self.directory("after")
        short: Entries = {"Time/End penetration": "never", "Time/End time": 0.02}
        words = ("--output-directory", before)
        self.run_program(SUCCESS, user_scene("jack"), *words, entries=short)
        entries = {**short, "Installation/Directory": before, "Time/End time": 0.2}
        words = ("--output-directory", after)
        text = self.run_program(
            SUCCESS, user_scene("pull_out_after"), *words, entries=entries
        )
        self.assertIn("Rigid body/Velocity = -0.1, there 0.1", text)
        self.assertNotIn("warning", text)

    def test_tension_after_is_valid(self) -> None:
        """After a short piece of its installation, which rests at once."""
        before, after = self.directory("before"), self.directory("after")
        entries: Entries = {
            "Time/End penetration": "never",
            "Time/End time": 0.02,
            "Time/Inertia tolerance": "none",
            "Time/Mass scaling": 100,
        }
        words = ("--output-directory", before)
        self.run_program(
            SUCCESS, user_scene("suction_coupled"), *words, entries=entries
        )
        entries |= {
            "Installation/Directory": before,
            "Rigid body/Velocity": 0,
            "Rigid body/Ramp time": 0,
            "Water/Time compression": 1000,
            "Time/End time": 0.1,
        }
        words = ("--output-directory", after)
        text = self.run_program(
            SUCCESS, user_scene("tension_after"), *words, entries=entries
        )
        self.assertIn("Water/Suction control = sealed, there automatic", text)

    def test_column(self) -> None:
        path = self.directory()
        self.run_program(SUCCESS, user_scene("column"), "--output-directory", path)
        found = {(check["mode"], check["quantity"]): check for check in checks(path)}
        self.assertLess(found["max", "displacement_z"]["relative_error"], 0.005)
        self.assertLess(found["pointwise", "stress_ratio"]["relative_error"], 0.01)


class AtRest(ProgramTest):
    """The scenes of users start in equilibrium."""

    def assert_at_rest(
        self, name: str, split: bool, error: float = 0.005, end: float = 0.15
    ) -> None:
        """Ask that with the body held still 1,000 steps and more change nothing; split:
        points in cells that the tip bends, which changes their stress a little."""
        path = self.directory()
        checks = ["max speed : 0 : 0.002"]
        for part, ratio in (("zz", 1), ("rr", 0.5), ("tt", 0.5)):
            exact = f"{ratio}*{VERTICAL_STRESS}"
            checks.append(f"pointwise stress_{part} : {exact} : {error}")
        entries: Entries = {
            **AT_REST,
            "Time/End time": end,
            "Material points/Split and merge": str(split).lower(),
            "Verification/Checks": "; ".join(checks),
        }
        text = self.run_program(
            SUCCESS, user_scene(name), "--output-directory", path, entries=entries
        )
        self.assertEqual(text.count(": yes"), 4, text)
        self.assertGreaterEqual(summary(path)["steps"], 1000)

    def test_jack_coarse_at_rest(self) -> None:
        self.assert_at_rest("jack_coarse", split=False, end=0.6)

    def test_jack_at_rest_with_split_points(self) -> None:
        self.assert_at_rest("jack", split=True, error=0.014)

    def test_jack_refined_at_rest(self) -> None:
        self.assert_at_rest("jack_refined", split=False)


class HalvedCells(ProgramTest):
    """Cells that are halved around the tip, against lines that are as fine."""

    def tip_force(self, name: str, levels: int) -> float:
        """Return the mean over the last 0.1 m of a short push (N)."""
        path = self.directory(name)
        entries = {
            "Grid/Refinement levels": levels,
            "Grid/Refinement levels along wall": 0,
            "Output/Record interval": 0.05,
        }
        self.run_scene("jack_refined", path, entries=entries)
        forces = [
            row["tip_force_N"] for row in history(path) if row["penetration_m"] > 0.65
        ]
        return sum(forces) / len(forces)

    def test_forces_are_those_of_lines(self) -> None:
        lines, halved = self.tip_force("lines", 0), self.tip_force("halved", 2)
        self.assertAlmostEqual(halved / lines, 1, delta=0.03)


class ShortWay(ProgramTest):
    """The numbers of the manual, of a scene of each kind: before a release,
    `scripts/lab scene-results --short` compares those of all scenes."""

    def compare(self, scenes: list[str]) -> None:
        """Ask for the numbers of the file, within 3 %."""
        known = scene_results.read()
        for scene in scenes:
            with self.subTest(scene=scene):
                new = scene_results.numbers_of(
                    scene, scene_results.SHORT, self.directory(scene), self.program
                )
                self.assertTrue(new, "no numbers")
                self.assertEqual(scene_results.differences(new, known), [])

    def test_drained(self) -> None:
        """Sand, clay, rings, and a wall of 30 mm."""
        self.compare(["jack", "jack_clay", "jack_rings", "jack_thin"])

    def test_water(self) -> None:
        """Seepage below clay, coupled water, and soil that hardly drains."""
        self.compare(["suction_layers", "suction_coupled", "jack_silt"])


if __name__ == "__main__":
    unittest.main()
