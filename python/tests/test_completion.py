# SPDX-License-Identifier: LGPL-2.1-or-later
"""What bash completes of the command line."""
import contextlib
import shlex
import subprocess
import tempfile
import unittest
from pathlib import Path

from caisson.__main__ import COMMANDS
from caisson.completion import SCRIPT, candidates
from caisson.paths import ROOT

CAISSON = ROOT / "scripts/caisson"


class Completion(unittest.TestCase):
    """In a folder with a scene, a table and results."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        here = contextlib.chdir(temporary.name)
        here.__enter__()
        self.addCleanup(here.__exit__)
        for name in ("mine.prm", "mine.csv", "notes", "a b.prm"):
            Path(name).touch()
        Path("my_results/jack").mkdir(parents=True)

    def found(self, *words: str) -> list[str]:
        """Return what the last word may become."""
        return candidates(words, COMMANDS)

    def in_bash(self, *words: str) -> list[str]:
        """Return what bash finds for a line of words."""
        line = " ".join(map(shlex.quote, [str(CAISSON), *words]))
        code = f"""
            source {shlex.quote(str(SCRIPT))}
            COMP_WORDS=({line}) COMP_CWORD={len(words)}
            _caisson 2>/dev/null
            for word in "${{COMPREPLY[@]}}"; do echo "found: $word"; done"""
        said = subprocess.run(
            ["bash", "-c", code], text=True, capture_output=True, check=True
        ).stdout
        return [line.removeprefix("found: ") for line in said.splitlines()]

    def test_commands(self) -> None:
        self.assertEqual(self.found("re"), ["report"])
        self.assertLessEqual(set(COMMANDS), set(self.found("")))
        self.assertEqual(self.found("none", ""), [])

    def test_options(self) -> None:
        self.assertIn("--jobs", self.found("study", "--"))
        self.assertEqual(self.found("run", "--ra"), ["--ranks"])

    def test_files(self) -> None:
        """Those that a command takes, directories, and scenes of the project."""
        self.assertEqual(self.found("run", "m"), ["mine.prm", "my_results"])
        self.assertEqual(self.found("cpt", "mi"), ["mine.csv"])
        self.assertEqual(self.found("plot", "m"), ["my_results"])
        self.assertEqual(self.found("plot", "my_results/"), ["my_results/jack"])
        self.assertIn("jack_coarse.prm", self.found("run", "jack"))

    def test_bash(self) -> None:
        self.assertEqual(self.in_bash("sug"), ["suggest"])
        self.assertEqual(self.in_bash("run", "mi"), ["mine.prm"])
        self.assertEqual(self.in_bash("run", "a"), ["a b.prm"])
        self.assertEqual(self.in_bash("run", "no such"), [])

    def test_script(self) -> None:
        """The command prints it, for those who have no completion installed."""
        done = subprocess.run(
            [CAISSON, "--completion"], text=True, capture_output=True, check=True
        )
        self.assertEqual(done.stdout, SCRIPT.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
