#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of doc/how_to/after_installation.md, on a coarse mesh."""
import re
import shlex
import subprocess
import unittest
from pathlib import Path

from program import ALONE, Entries, ProgramTest, caisson

from caisson.paths import ROOT
from caisson.results import Results
from caisson.runner import set_options

PAGE = ROOT / "doc/how_to/after_installation.md"
COARSE: Entries = {
    "Rigid body/Cells across the wall": 2,
    "Grid/Outer radius": 9,
    "Grid/Bottom": -8,
    "Grid/Fine width": 0.3,
    "Grid/Fine height": 0.3,
}
# prm/springs.prm has a smaller one, for the first millimeter
QUICK: Entries = {"Time/Inertia tolerance": 0.4}


def commands() -> list[list[str]]:
    """Return the words of all commands of the page."""
    blocks = re.findall(
        r"^```\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.S | re.M
    )
    text = "".join(blocks).replace("\\\n", " ")
    return [shlex.split(line, comments=True) for line in text.splitlines()]


class Page(ProgramTest):
    """A designer's five questions."""

    def run_command(self, words: list[str], directory: Path) -> None:
        """Run one of them as it stands, but for the mesh."""
        if words[0] == "scripts/run":
            scene = str(ROOT / words[1])
            entries = COARSE | (QUICK if "springs" in scene else {})
            called = [str(self.program), scene, *words[2:], *set_options(entries)]
            done = subprocess.run(
                called, cwd=directory, text=True, capture_output=True, env=ALONE
            )
        else:
            self.assertEqual(words[0], "scripts/caisson", words)
            done = caisson(*words[1:], cwd=directory)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}{done.stderr}")

    def test_commands(self) -> None:
        """They all work, and leave what the page says."""
        directory = self.made_directory()
        found = commands()
        self.assertGreater(len(found), 8)
        for words in found:
            self.run_command(words, directory)
        results = directory / "results"
        pull = Results(results / "pull_out_after").history["total_force_N"]
        self.assertLess(pull.min(), -5e4)
        tension = Results(results / "tension").history
        self.assertGreater(tension["suction_Pa"].max(), 1e3)
        for name in ("springs/springs.csv", "springs/springs.png"):
            self.assertTrue((results / name).is_file(), name)
        for name in ("springs_opensees.py",):
            self.assertTrue((results / "springs" / name).is_file(), name)
        for name in ("report.html", "walls.png", "stress.png", "state_abaqus.inp"):
            self.assertTrue((results / "jack_2m" / name).is_file(), name)


if __name__ == "__main__":
    unittest.main()
