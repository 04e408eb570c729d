# SPDX-License-Identifier: LGPL-2.1-or-later
"""A short way of the scenes of prm/ beside doc/scene_results.csv: program.py."""
import unittest

from program import ProgramTest

from lab.studies import scene_results


class SceneTest(ProgramTest):
    """What both groups share."""

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


class Drained(SceneTest):
    """Scenes without water."""

    def test_jacked(self) -> None:
        """Sand and clay, coarse and fine."""
        coarse = ["jack_refined", "jack_coarse", "jack_rings"]
        self.compare(["jack", *coarse, "jack_clay", "tutorial"])


class ThinOrDense(SceneTest):
    """Scenes that take longer for each step or meter."""

    def test_jacked(self) -> None:
        """A wall of 30 mm, and hypoplastic sand."""
        self.compare(["jack_thin", "jack_dense_sand"])


class Water(SceneTest):
    """Scenes with water that flows."""

    def test_suction(self) -> None:
        """Seepage and coupled water."""
        self.compare(["suction", "suction_coupled"])


class WaterInOtherSoils(SceneTest):
    """The same in dense sand and in silt."""

    def test_suction(self) -> None:
        """Dilatant sand, and silt that hardly drains."""
        self.compare(["suction_dense_sand", "jack_silt"])


class SuctionInClay(SceneTest):
    """The same in clay, and in clay over sand."""

    def test_suction(self) -> None:
        """A total stress, and seepage below clay."""
        self.compare(["suction_clay", "suction_layers"])


if __name__ == "__main__":
    unittest.main()
