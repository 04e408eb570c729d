# SPDX-License-Identifier: LGPL-2.1-or-later
"""`pip install -e .` in a fresh virtual environment, without a network, and what bash
completes of the command line."""
import contextlib
import os
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from caisson.__main__ import COMMANDS
from caisson.completion import candidates, SCRIPT
from caisson.paths import ROOT, version


FILES = [
    "CMakeLists.txt",
    "README.md",
    "packaging/build_backend.py",
    "prm/column.prm",
    "pyproject.toml",
]


class Install(unittest.TestCase):
    """A copy of the project, which pip writes into."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.here = Path(temporary.name)
        self.project, self.venv = self.here / "project", self.here / "venv"
        for name in FILES:
            (self.project / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.project / name)
        shutil.copytree(ROOT / "python/caisson", self.project / "python/caisson")

    def call(self, *words: str | Path) -> str:
        """Return what a call says; there is no network, and no other package."""
        environment = {**os.environ, "PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull}
        for name in ("PYTHONPATH", "PIP_FIND_LINKS"):
            environment.pop(name, None)
        done = subprocess.run(
            list(map(str, words)),
            cwd=self.here,
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout.strip()

    def test_editable(self) -> None:
        """Packages of the system serve, and the command runs in any folder."""
        self.call("/usr/bin/python3", "-m", "venv", "--system-site-packages", self.venv)
        pip = self.venv / "bin/pip"
        self.call(pip, "install", "-e", self.project)
        code = "import caisson; print(caisson.__version__, caisson.__file__)"
        said = self.call(self.venv / "bin/python", "-c", code)
        file = self.project / "python/caisson/__init__.py"
        self.assertEqual(said, f"{version()} {file}")
        said = self.call(self.venv / "bin/caisson", "scenes")
        self.assertIn("a soil column settles under its own weight", said)


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
