# SPDX-License-Identifier: LGPL-2.1-or-later
"""The file and the table of the scenes' results."""
import unittest
from dataclasses import replace

import numpy as np

from lab.studies import scene_results
from lab.studies.scene_results import WHOLE, Number


class Files(unittest.TestCase):
    """What the manual says is what the file says."""

    def test_page(self) -> None:
        """The table of the manual is that of the file."""
        self.assertTrue(scene_results.page_is_true(scene_results.read()))

    def test_scenes(self) -> None:
        """Every number is of a scene of the README, with its commit."""
        scenes = scene_results.scenes_of_readme()
        self.assertGreater(len(scenes), 10)
        for number in scene_results.read():
            self.assertIn(number.scene, scenes)
            self.assertNotEqual(number.commit, "")


class Numbers(unittest.TestCase):
    """Comparison and key numbers."""

    NUMBER = Number("jack", WHOLE, "tip_force_N", 1.0, 100.0)

    def test_differences(self) -> None:
        """More than 3 %, and what is not known."""
        old = [self.NUMBER]
        for value, n in ((102.9, 0), (97.1, 0), (103.1, 1), (float("nan"), 1)):
            new = [replace(self.NUMBER, value=value)]
            self.assertEqual(len(scene_results.differences(new, old)), n, value)
        other = [replace(self.NUMBER, penetration_m=2.0)]
        self.assertIn("is not in", scene_results.differences(other, old)[0])

    def test_small_numbers(self) -> None:
        """A number near 0 is compared with the largest of its kind."""
        old = [self.NUMBER, replace(self.NUMBER, penetration_m=2.0, value=0.1)]
        for value, n in ((0.15, 0), (0.2, 1)):
            new = [replace(old[1], value=value)]
            self.assertEqual(len(scene_results.differences(new, old)), n, value)

    def test_key_numbers(self) -> None:
        """Means at each meter on the way down, and the tension on the way up."""
        depth = np.concatenate([np.linspace(0.5, 2.5, 201), np.linspace(2.49, 1, 150)])
        force = 10 * depth
        force[201:] = -5.0
        history = {"penetration_m": depth, "total_force_N": force, "tip_force_N": force}
        numbers = scene_results.key_numbers(history)
        self.assertAlmostEqual(numbers["total_force_N", 1.0], 10)
        self.assertAlmostEqual(numbers["tip_force_N", 2.0], 20)
        self.assertAlmostEqual(numbers["largest_tension_N", 2.5], 5)
        self.assertEqual(len(numbers), 5)


if __name__ == "__main__":
    unittest.main()
