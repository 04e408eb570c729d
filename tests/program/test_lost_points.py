#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that end because a point is lost or a number is not finite."""
import unittest

from program import FAILURE, ProgramTest, history


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


if __name__ == "__main__":
    unittest.main()
