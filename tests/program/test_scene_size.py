# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene that is far too large is refused at once, with the reason; of others the
number of steps is known in advance."""
import re
import resource
import unittest

from program import BAD_INPUT, SUCCESS, Entries, ProgramTest, scene_and_entries
from program import summary, user_scene

# words of the message, entries
TOO_MANY_CELLS: tuple[tuple[list[str], Entries], ...] = (
    (["Rigid body/Wall thickness = 1e-09 m"], {"Rigid body/Wall thickness": 1e-9}),
    (["Grid/Top (z = 1e+09 m)", "Cell height"], {"Grid/Top": 1e9}),
    (["Grid/Bottom (z = -1e+09 m)", "Cell height"], {"Grid/Bottom": -1e9}),
    (["Grid/Fine cell size = 1e-06 m"], {"Grid/Fine cell size": 1e-6}),
    (["Grid/Bottom (z = -18000 m)", "in meters"], {"Grid/Bottom": -18000}),
    (["Refinement = 256"], {"Grid/Refinement": 256}),
    (
        ["more than Grid/Largest number of cells = 100"],
        {"Grid/Largest number of cells": 100},
    ),
)
TOO_MANY_POINTS: tuple[tuple[list[str], Entries], ...] = (
    (
        ["more than Material points/Largest number of points = 1000"],
        {"Material points/Largest number of points": 1000},
    ),
    (
        ["Per direction far = 16", "Split and merge"],
        {
            "Material points/Per direction far": 16,
            "Grid/Refinement": 5,
        },
    ),
)
MEMORY = 2_000_000  # kB, half of which the libraries with sanitizers take


def memory_used() -> int:
    """Return the most that a program that has ended has had (kB)."""
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss


class Limits(ProgramTest):
    """--validate and a run refuse alike, before anything is made."""

    def check(self, words: list[str], entries: Entries, *options: str) -> None:
        """Ask for these words before anything is made."""
        said = self.run_program(
            BAD_INPUT, user_scene("jack_coarse"), *options, entries=entries
        )
        self.assertLess(memory_used(), MEMORY)
        for word in [*words, "GB of memory"]:
            self.assertIn(word, said)

    def test_cells(self) -> None:
        """More cells than memory holds."""
        for words, entries in TOO_MANY_CELLS:
            with self.subTest(**entries):
                self.check(words, entries, "--validate")

    def test_points(self) -> None:
        """More material points than memory holds."""
        for words, entries in TOO_MANY_POINTS:
            with self.subTest(**entries):
                self.check(words, entries, "--validate")

    def test_run(self) -> None:
        """A run, not only --validate."""
        directory = str(self.directory())
        for words, entries in (TOO_MANY_CELLS[1], TOO_MANY_POINTS[0]):
            with self.subTest(**entries):
                self.check(words, entries, "--output-directory", directory)


class Steps(ProgramTest):
    """How many are expected, before a run and of one that is made."""

    def expected(self, scene: object, entries: Entries) -> float:
        """Return the number that --validate says."""
        said = self.run_program(SUCCESS, scene, "--validate", entries=entries)
        found = re.search(r"^ *steps +about (\d+)", said, re.M)
        assert found is not None, said
        return float(found[1])

    def test_sand_that_stiffens_under_a_tip(self) -> None:
        """Dense sand, whose first steps are 1.5 times as long as the others."""
        path = self.directory()
        self.run_scene("jack_density", path)
        expected = self.expected(*scene_and_entries("jack_density"))
        self.assertLess(abs(expected / summary(path)["steps"] - 1), 0.25)

    def test_stiffer_layer(self) -> None:
        """Waves of twice the speed take half as long steps, over half of the way."""
        entries: Entries = {
            "Time/Inertia tolerance": "none",
            "Time/Mass scaling": 25,
            "Time/End penetration": 2.5,
        }
        one = self.expected(user_scene("jack_coarse"), entries=entries)
        entries |= {
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Like layer": 1,
            "Soil/Layer 2/Top depth": 1.5,
            "Soil/Layer 2/Youngs modulus": 20e6,
        }
        two = self.expected(user_scene("jack_coarse"), entries=entries)
        self.assertAlmostEqual(two / one, 1.5, delta=0.05)


if __name__ == "__main__":
    unittest.main()
