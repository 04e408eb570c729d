#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The velocity limiter, the mass floor, split points, instruction sets, energy, soil
that hardly changes its volume, and runs that end because a point is lost."""
import unittest

import numpy as np
from program import (
    BAD_INPUT,
    Entries,
    FAILURE,
    history,
    ProgramTest,
    scene,
    SUCCESS,
    summary,
    user_scene,
)


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


class Limits(ProgramTest):
    """The velocity limiter and the mass floor."""

    def limiter_count(self, factor: float | str) -> float:
        """Return the firings in a short push."""
        path = self.directory()
        self.run_scene(
            "jack",
            path,
            entries={
                "Time/End penetration": 0.52,
                "Output/Record interval": 0.1,
                "Method/Limiter factor": factor,
            },
        )
        count = summary(path)["limiter_count"]
        self.assertEqual(count, history(path)[-1]["limiter_count"])
        return count

    def test_limiter_does_not_fire_needlessly(self) -> None:
        self.assertEqual(self.limiter_count("none"), 0)
        self.assertEqual(self.limiter_count(0.75), 0)

    def test_limiter_counts(self) -> None:
        """With a small k it fires beside the body, and is counted."""
        self.limiter_count(0.01)

    def test_limiter_holds_points(self) -> None:
        """A block hits the plane with 1 m/s: limited to 0.1 * 0.05 / 0.01 = 0.5."""
        path = self.directory()
        self.run_scene(
            "block_slides",
            path,
            entries={
                "Time/End time": 0.1,
                "Time/Time step": 2e-4,
                "Method/Limiter factor": 0.01,
                "Soil/Gravity": "50, -87",
                "Output/Record interval": 0.02,
                "Verification/Checks": "",
            },
        )
        self.assertGreater(history(path)[-1]["limiter_count"], 100)

    def test_mass_floor(self) -> None:
        """A block slides into empty cells, where its nodes have little mass. With
        USL that is unstable, unless the mass floor is on."""
        text = self.run_scene(
            "block_mass_floor",
            self.directory(),
            FAILURE,
            entries={"Method/Mass floor": "false"},
        )
        self.assertRegex(text, "passed more than a cell in a step|finite")
        path = self.directory()
        self.run_scene(
            "block_mass_floor", path, entries={"Output/Record interval": 0.02}
        )
        self.assertGreater(max(row["added_mass_kg"] for row in history(path)), 0.0)


class Points(ProgramTest):
    """Points that are split and merged."""

    def test_a_thin_row_comes_to_large_points(self) -> None:
        """The row between a layer and the end of the moving zone is thinner than
        points of the cells below it, and still bears the soil."""
        path = self.directory()
        self.run_scene(
            "jack",
            path,
            entries={
                "Soil/Number of layers": 2,
                "Soil/Layer 2/Top depth": 1.45,
                "Material points/Split and merge": "true",
                "Grid/Cell height": 1,
                "Output/Record interval": 0.05,
            },
        )
        # 49 kJ where the row is empty at times
        self.assertLess(max(row["kinetic_energy_J"] for row in history(path)), 1e3)


class Step(ProgramTest):
    """Kernels and energy."""

    def test_instruction_sets_agree(self) -> None:
        rows = {}
        for name in ("SSE2", "AVX2", "AVX-512"):
            path = self.directory(name)
            done = self.call(
                scene("jack"),
                "--output-directory",
                path,
                entries={
                    "Method/Instruction set": name,
                    "Output/Record interval": 0.05,
                    "Time/End penetration": 0.52,
                },
            )
            if done.returncode == BAD_INPUT and name != "SSE2":
                self.assertIn("does not have it", done.stdout)
                continue
            self.assertEqual(done.returncode, SUCCESS, done.stdout)
            rows[name] = history(path)
        for name, other in rows.items():
            self.assertEqual(len(other), len(rows["SSE2"]), name)
            for a, b in zip(rows["SSE2"], other):
                for key in ("total_force_N", "kinetic_energy_J", "external_work_J"):
                    error = abs(a[key] - b[key]) / max(1.0, abs(a[key]))
                    self.assertLess(error, 1e-7, f"{name} {key}")

    def test_energy(self) -> None:
        """Work of the body, and little kinetic energy."""
        path = self.directory()
        self.run_scene("jack", path, entries={"Output/Record interval": 0.05})
        rows, work = history(path), 0.0
        for a, b in zip(rows, rows[1:]):
            work += b["total_force_N"] * (b["penetration_m"] - a["penetration_m"])
        self.assertAlmostEqual(rows[-1]["external_work_J"] / work, 1.0, delta=0.02)
        self.assertLess(rows[-1]["kinetic_energy_J"], 0.03 * work)

    def test_dilated_sand_keeps_its_energy(self) -> None:
        """It gets lighter at the same stiffness, and needs shorter steps or more
        inertia. Without them the residual is -29 %."""
        path = self.directory()
        entries: Entries = {
            "Soil/Layer 1/Dilatancy angle": 30,
            "Time/Courant number": 1,
            "Time/Inertia tolerance": 0.4,
            "Time/End penetration": 0.6,
        }
        words = ("--output-directory", path)
        self.run_program(SUCCESS, user_scene("jack"), *words, entries=entries)
        self.assertAlmostEqual(history(path)[-1]["energy_residual"], 0, delta=0.02)


class Lost(ProgramTest):
    """Runs that cannot go on."""

    def test_point_leaves_the_mesh(self) -> None:
        path = self.directory()
        text = self.run_scene(
            "block_slides",
            path,
            FAILURE,
            entries={
                "Time/End time": 2,
                "Output/Record interval": 0.1,
                "Boundary conditions/Side": "free",
            },
        )
        self.assert_words(
            ["material point", "left the mesh", "began at", "Likely cause"], text
        )
        self.assertGreater(len(history(path)), 3, "the rows so far are lost")

    def test_not_finite(self) -> None:
        path = self.directory()
        text = self.run_scene(
            "jack", path, FAILURE, entries={"Soil/Layer 1/Solid density": 1e307}
        )
        self.assert_words(
            ["not finite", "step", "material point", "began at", "Likely cause"], text
        )
        self.assertEqual(len(history(path)), 1, "the first row is lost")


class PoissonRatio(ProgramTest):
    """Frictional soil with one shear modulus and different Poisson ratios."""

    def tip_force(self, nu: float) -> float:
        """Return the mean tip force from 0.9 to 1.1 m. Units: N."""
        path = self.directory(f"nu_{nu}")
        self.run_program(
            SUCCESS,
            user_scene("jack_coarse"),
            "--output-directory",
            path,
            entries={
                **SMALL,
                "Time/Mass scaling": 100,
                "Time/End penetration": 1.1,
                "Output/Frame interval": "never",
                "Output/Frame penetrations": "",
                "Soil/Layer 1/Poisson ratio": nu,
                "Soil/Layer 1/Youngs modulus": 5e6 * (1 + nu) / 1.3,
            },
        )
        rows = [row for row in history(path) if row["penetration_m"] >= 0.9]
        return float(np.mean([row["tip_force_N"] for row in rows]))

    def test_strength_is_kept(self) -> None:
        """Nearly incompressible soil bears more in a small domain, and not half."""
        usual, incompressible = self.tip_force(0.3), self.tip_force(0.49)
        self.assertGreater(incompressible, usual)
        self.assertLess(incompressible, 1.3 * usual)


if __name__ == "__main__":
    unittest.main()
