# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene that is far too large is refused at once, with the reason."""
import resource
import unittest

from program import BAD_INPUT, Entries, ProgramTest, user_scene

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
            "Grid/Refinement": 8,
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


if __name__ == "__main__":
    unittest.main()
