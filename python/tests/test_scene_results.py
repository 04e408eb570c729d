# SPDX-License-Identifier: LGPL-2.1-or-later
"""The file of the scenes' results, and what pages quote of it."""
import re
import unittest
from dataclasses import replace

import numpy as np

from caisson.paths import ROOT
from lab.studies import scene_results
from lab.studies.scene_results import WHOLE, Number


class Files(unittest.TestCase):
    """What the manual says is what the file says."""

    def test_page(self) -> None:
        """Forces beside theory, and the suctions, are those of the file, within 1 %
        of the deepest."""
        known = {
            (n.scene, n.quantity, n.penetration_m): n.value / 1e3
            for n in scene_results.read()
            if n.way == WHOLE
        }
        text = scene_results.PAGE.read_text(encoding="utf-8")
        forces = re.findall(r"^\| (\d) m \| (\d+) \|[^|]*\| (\d+) \|", text, re.M)
        self.assertEqual(len(forces), 4)
        for depth, *values in forces:
            for name, value in zip(("total_force_N", "tip_force_N"), values):
                self.assertAlmostEqual(
                    float(value), known["jack", name, float(depth)], delta=1
                )
        for head, scene in (("required", "suction"), ("the same", "suction_coupled")):
            (row,) = re.findall(rf"^\| {head}.*?\)`?\)? \|(.*)\|$", text, re.M)[:1]
            for depth, value in zip(range(2, 7), row.split("|")):
                expected = known[scene, "required_suction_Pa", float(depth)]
                self.assertAlmostEqual(float(value), expected, delta=0.6)

    def test_quotes(self) -> None:
        """What pages quote of scenes is what the file has; another number with a unit
        is quoted in QUOTES, or counted as one that is not of the file."""
        numbers = scene_results.read()
        self.assertEqual(scene_results.stale_quotes(numbers), [])
        others = {
            str(page.relative_to(ROOT / "doc")): scene_results.others_of(page)
            for page in scene_results.pages()
        }
        found = {name: n for name, n in others.items() if n}
        self.assertEqual(found, scene_results.OTHERS)

    def test_stale_quote(self) -> None:
        """A number that is 4 % larger in the file than on a page is named."""
        page, words, scene, quantity, depth, _ = scene_results.QUOTES[0]
        key = scene, WHOLE, quantity, depth
        new = [
            replace(n, value=1.04 * n.value) if n.key == key else n
            for n in scene_results.read()
        ]
        (said,) = scene_results.stale_quotes(new)
        self.assertTrue(said.startswith(f"{page}, {words!r}: "), said)

    def test_scenes(self) -> None:
        """Every number is of a listed scene, with its commit."""
        scenes = scene_results.listed_scenes()
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
