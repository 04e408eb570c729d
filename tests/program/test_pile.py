#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Piles, and bodies that start on the surface."""
import unittest
from typing import Any

from program import SUCCESS, ProgramTest, history, scene, user_scene

BODY = "Rigid body"
LAYER = "Soil/Layer 1"


class Start(ProgramTest):
    """Bodies that start on the surface or just below."""

    def tip_force(self, name: str, entries: dict[str, Any]) -> float:
        """Return the tip force (N) at a penetration of 0.06 m."""
        path = self.directory(name)
        more: dict[str, Any] = {
            "Rigid body/Skirt length": 3,
            "Rigid body/Wall thickness": 0.15,
            "Grid/Outer radius": 7,
            "Grid/Bottom": -5,
            "Grid/Top": 3.5,
            "Rigid body/Ramp time": 0.1,
            "Time/End penetration": 0.06,
            "Output/Frame interval": "never",
            "Output/Frame penetrations": "",
        }
        self.run_program(
            SUCCESS,
            user_scene("jack"),
            "--output-directory",
            path,
            entries={**more, **entries},
        )
        return history(path)[-1]["tip_force_N"]

    def test_depth_of_the_start(self) -> None:
        """The force hardly depends on where the tip began."""
        cone: dict[str, Any] = {
            f"{BODY}/Kind": "cone",
            f"{BODY}/Outer diameter": 0.3,
            f"{BODY}/Apex angle": 150,
        }
        bodies: dict[str, dict[str, Any]] = {
            "flat": {f"{BODY}/Tip": "flat"},
            "triangular": {f"{BODY}/Tip": "triangular"},
            "cone": cone,
        }
        for name, body in bodies.items():
            forces = [
                self.tip_force(
                    f"{name}_{depth}", {**body, f"{BODY}/Initial penetration": depth}
                )
                for depth in (0, 0.01)
            ]
            self.assertLess(max(forces), 1.15 * min(forces), (name, forces))
            self.assertGreater(min(forces), 0)


class SoilAndWalls(ProgramTest):
    """Other numbers for the same soil and the same wall."""

    def rows(self, name: str, entries: dict[str, Any]) -> list[dict[str, float]]:
        """Return the history of a run."""
        path = self.directory(name)
        more = {"Time/End penetration": 0.52, **entries}
        self.run_scene("jack", path, SUCCESS, entries=more)
        return history(path)

    def test_void_ratio_and_dry_density(self) -> None:
        """They give the forces of porosity and solid density."""
        usual = self.rows(
            "usual",
            {
                f"{LAYER}/Porosity": 0.375,
                f"{LAYER}/Solid density": 2560,
            },
        )
        other = self.rows(
            "other",
            {
                f"{LAYER}/Void ratio": 0.6,
                f"{LAYER}/Dry density": 1600,
            },
        )
        for a, b in zip(usual, other):
            for force in ("tip_force_N", "outer_friction_N"):
                self.assertAlmostEqual(a[force], b[force], delta=1e-4 * abs(a[force]))
        self.assertGreater(usual[-1]["tip_force_N"], 0)

    def test_contradictions(self) -> None:
        """Two densities are refused, and what has no effect is warned of."""
        self.refused(
            ["Relative density = 0.5", "Void ratio = 0.6", "Remove one"],
            entries={
                f"{LAYER}/Void ratio": 0.6,
                f"{LAYER}/Relative density": 0.5,
                f"{LAYER}/Minimum void ratio": 0.5,
                f"{LAYER}/Maximum void ratio": 0.8,
            },
        )
        said = self.run_program(
            SUCCESS,
            user_scene("jack_coarse"),
            "--validate",
            entries={
                f"{LAYER}/Void ratio": 0.6,
                f"{LAYER}/Porosity": 0.3,
                f"{LAYER}/Dry density": 1.6,
                f"{LAYER}/Solid density": 2600,
                "Soil/Submerged": "false",
            },
        )
        for words in (
            "Void ratio is set",
            "Dry density is set",
            "Dry density = 1.6 kg/m3 makes a solid density of 2.56 kg/m3",
            "t/m3",
        ):
            self.assertIn(words, said)


class LikeLayer(ProgramTest):
    """A layer that takes the entries of another."""

    def printed(self, entries: dict[str, Any]) -> str:
        """Return layer 2 as --print-parameters has it."""
        said = self.run_program(
            SUCCESS, scene("jack"), "--print-parameters", entries=entries
        )
        return said.split("subsection Layer 2")[1].split("  end\n")[0]

    def test_entries_are_taken_over(self) -> None:
        """But for the depth, what the layer sets, and what says the same."""
        entries: dict[str, Any] = {
            "Soil/Number of layers": 2,
            f"{LAYER}/Friction angle": 33,
            f"{LAYER}/Youngs modulus": 7e6,
            f"{LAYER}/Porosity": 0.44,
            f"{LAYER}/K0": 0.6,
            "Soil/Layer 2/Top depth": 2,
            "Soil/Layer 2/Youngs modulus": 9e6,
            "Soil/Layer 2/Void ratio": 0.7,
            "Soil/Layer 2/Like layer": 1,
        }
        layer = self.printed(entries)
        for name, value in (
            ("Friction angle", "33"),
            ("Youngs modulus", "9e6|9000000.0"),
            ("Void ratio", "0.7"),
            ("K0", "0.6"),
            ("Top depth", "2"),
        ):
            self.assertRegex(layer, rf"set {name} += ({value})\n")
        self.assertNotRegex(layer, r"set Porosity += 0.44\n")
        said = self.run_scene(
            "jack", self.directory(), SUCCESS, "--validate", entries=entries
        )
        self.assertNotIn("warning", said)

    def test_refusals(self) -> None:
        for number in (2, 7):
            self.refused(
                [f"Soil/Layer 2/Like layer = {number}", "a layer above", "--set"],
                entries={
                    "Soil/Number of layers": 2,
                    "Soil/Layer 2/Top depth": 2,
                    "Soil/Layer 2/Like layer": number,
                },
            )


if __name__ == "__main__":
    unittest.main()
