#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Ground whose numbers change with depth, and what it is to the walls of a body."""
import json
import unittest
from math import pi
from pathlib import Path

from program import SUCCESS, Entries, ProgramTest, history, summary

LAYER = "Soil/Layer 1"
BODY = "Rigid body"
FORCES = ("tip_force_N", "inner_friction_N", "outer_friction_N")
CLAY: Entries = {
    f"{BODY}/Friction angle of the outer wall": 0,
    f"{BODY}/Friction angle of the inner wall": 0,
    f"{BODY}/Friction angle of the tip": 0,
    f"{LAYER}/Friction angle": 0,
    f"{LAYER}/K0": 1,
}
STRENGTH = "6e3 + 2e3*d"


class Walls(ProgramTest):
    """Friction and adhesion by layer."""

    def forces(
        self, name: str, entries: Entries, *options: str, ranks: int = 1
    ) -> list[list[float]]:
        """Return the forces in the rows of a run."""
        path = self.results / self.id().split(".")[-1] / name
        self.run_scene("jack", path, SUCCESS, *options, entries=entries, ranks=ranks)
        return [[row[force] for force in FORCES] for row in history(path)]

    def test_layer_replaces_the_body(self) -> None:
        """Adhesion and friction of a layer are those that the body could have."""
        strong = {**CLAY, f"{LAYER}/Cohesion": 12e3}
        adhesion = {f"{BODY}/Adhesion of the {s} wall": 3e3 for s in ("inner", "outer")}
        friction = {
            f"{BODY}/Friction angle of the {s} wall": 10 for s in ("inner", "outer")
        }
        self.assertEqual(
            self.forces("body", {**strong, **adhesion}, "--overwrite"),
            self.forces(
                "layer",
                {
                    **strong,
                    f"{LAYER}/Adhesion factor of the walls": 0.75,
                    f"{LAYER}/Sensitivity": 3,
                },
                "--overwrite",
            ),
        )
        self.assertEqual(
            self.forces("rough_body", friction, "--overwrite"),
            self.forces(
                "rough_layer",
                {f"{LAYER}/Friction angle of the walls": 10},
                "--overwrite",
            ),
        )

    def test_adhesion_grows_with_depth(self) -> None:
        """The friction is the adhesion over the area, on two ranks as on one."""
        entries = {
            **CLAY,
            f"{LAYER}/Cohesion": STRENGTH,
            f"{LAYER}/Youngs modulus": f"300*({STRENGTH})",
            f"{LAYER}/Adhesion factor of the walls": 0.5,
            f"{BODY}/Initial penetration": 1.5,
            "Time/End penetration": 1.7,
        }
        found = self.forces("one", entries, "--overwrite")
        h = 1.7
        for diameter, force in ((5.6, found[-1][1]), (6.0, found[-1][2])):
            exact = pi * diameter * 0.5 * (6e3 * h + 1e3 * h**2)
            # a cell more than the wall takes part, at its tip
            self.assertGreater(force, 0.95 * exact)
            self.assertLess(force, 1.15 * exact)
        for a, b in zip(
            found[-1], self.forces("two", entries, "--overwrite", ranks=2)[-1]
        ):
            self.assertAlmostEqual(a, b, delta=1e-6 * abs(a))

    def test_layer_out_of_reach(self) -> None:
        """A layer below the tip is nothing to the walls."""
        below = {
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 2,
            "Soil/Layer 2/Porosity": 0.4,
            "Soil/Layer 2/Solid density": 2500,
        }
        self.assertEqual(
            self.forces("smooth", below, "--overwrite"),
            self.forces(
                "rough",
                {**below, "Soil/Layer 2/Friction angle of the walls": 5},
                "--overwrite",
            ),
        )

    def test_refusals(self) -> None:
        factor = {f"{LAYER}/Adhesion factor of the walls": 0.5}
        self.refused(
            ["linear elastic has no undrained strength", "of the body"],
            entries={**factor, f"{LAYER}/Law": "linear elastic"},
        )
        self.refused(
            ["cylinder", "Remove"],
            entries={
                f"{BODY}/Kind": "cylinder",
                f"{LAYER}/Friction angle of the walls": 5,
            },
        )


class Records(ProgramTest):
    """What a run says of its ground."""

    def run_clay(self) -> Path:
        path = self.directory()
        entries = {
            **CLAY,
            f"{LAYER}/Cohesion": STRENGTH,
            "Time/End penetration": "never",
            "Time/End time": 0.1,
        }
        self.run_scene("jack", path, entries=entries)
        return path

    def test_materials_are_listed(self) -> None:
        """With the number of their layer, and numbers of their own."""
        layers = summary(self.run_clay())["scene"]["layers"]
        self.assertGreater(len(layers), 5)
        self.assertEqual({layer["layer"] for layer in layers}, {1})
        strength = [layer["cohesion_Pa"] for layer in layers]
        self.assertEqual(strength, sorted(strength))
        json.dumps(layers)


if __name__ == "__main__":
    unittest.main()
