#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `cmake --install` puts into a prefix: it works from anywhere, without the
sources, and writes nothing into the prefix."""
import re
import subprocess
import unittest
from pathlib import Path
from typing import Any

from program import HERE, SUCCESS, ProgramTest, summary

from caisson.__main__ import COMMANDS

# what a login gives, and neither the sources nor another program
ENVIRONMENT = {
    "PATH": "/usr/bin:/bin",
    "HOME": "/nonexistent",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
}
SHORT = ["--set", "Time/End time=0.05", "--set", "Verification/Checks="]
STUDY = """kind = "parameters"
title = "Two friction angles"
scene = "jack_coarse.prm"
depths = [0.53]
set = {"Time/End penetration" = 0.56, "Time/Inertia tolerance" = 2}
[parameters."Soil/Layer 1/Friction angle"]
values = [31, 33]
"""
# of all commands, in one process
HELP = """from caisson.__main__ import COMMANDS, main
for name in COMMANDS:
    try:
        main([name, "--help"])
    except SystemExit as end:
        print(name, "ends with", end.code)
"""


def contents(prefix: Path) -> dict[str, tuple[int, int]]:
    """Return all files and folders of an installation, with size and time."""
    return {
        str(path.relative_to(prefix)): (path.stat().st_size, path.stat().st_mtime_ns)
        for path in prefix.rglob("*")
    }


class Prefix(ProgramTest):
    """An installation that has been moved and may not be written to."""

    prefix: Path

    @classmethod
    def setUpClass(cls) -> None:
        """Install what the build directory of the program has, and move it."""
        folder = cls.results / "prefix"
        subprocess.run(["rm", "-rf", str(folder)], check=True)
        made, cls.prefix = folder / "made", folder / "moved"
        words = ["cmake", "--install", str(cls.program.parent), "--prefix", str(made)]
        subprocess.run(words, check=True, capture_output=True)
        made.rename(cls.prefix)
        subprocess.run(["chmod", "-R", "a-w", str(cls.prefix)], check=True)
        cls.before = contents(cls.prefix)

    @classmethod
    def tearDownClass(cls) -> None:
        """Let it be deleted."""
        subprocess.run(["chmod", "-R", "u+w", str(cls.prefix)], check=True)

    before: dict[str, tuple[int, int]]

    def setUp(self) -> None:
        """Go to an empty directory."""
        self.here = self.made_directory("here")

    def installed(self, name: str, *words: Any, status: int = SUCCESS) -> str:
        """Run a program of the installation; return its words. What it does to the
        prefix is seen also where root may write anywhere."""
        done = subprocess.run(
            [str(self.prefix / "bin" / name), *map(str, words)],
            cwd=self.here,
            env=ENVIRONMENT,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self.assertEqual(done.returncode, status, done.stdout)
        self.assertEqual(contents(self.prefix), self.before)
        return done.stdout

    def python(self, code: str) -> str:
        """Let Python run a code with the package of the installation; return what it
        prints."""
        package = self.prefix / "share/caisson_mpm/python"
        done = subprocess.run(
            ["/usr/bin/python3", "-B", "-c", code],
            cwd=self.here,
            env={**ENVIRONMENT, "PYTHONPATH": str(package)},
            text=True,
            capture_output=True,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(contents(self.prefix), self.before)
        return done.stdout

    def test_run(self) -> None:
        """A scene of the installation, by its name, into the current directory."""
        said = self.installed("caisson", "run", "column.prm", *SHORT)
        results = self.here / "results/column"
        self.assertTrue((results / "history.csv").is_file())
        self.assertEqual(
            summary(results)["scene_file"],
            str(self.prefix / "share/caisson_mpm/prm/column.prm"),
        )
        self.assertIn(f"report: {Path('results/column/report.html')}", said)
        (results / "report.html").unlink()
        self.installed("caisson", "report", "results/column")
        self.assertIn(
            "settles under its own weight", (results / "report.html").read_text()
        )

    def test_completion(self) -> None:
        """bash finds it in the prefix, and what it asks for."""
        file = self.prefix / "share/bash-completion/completions/caisson"
        self.assertEqual(self.installed("caisson", "--completion"), file.read_text())
        self.assertEqual(self.installed("caisson", "--complete", "sug"), "suggest\n")

    def test_package(self) -> None:
        """Python finds the package, with its types, and it finds program and scenes."""
        package = self.prefix / "share/caisson_mpm/python"
        self.assertTrue((package / "caisson/py.typed").is_file())
        for name in ("ABA_PARAM.INC", "aba_param.inc"):  # of UMATs
            self.assertTrue((package.parent / "abaqus" / name).is_file(), name)
        code = (
            "import caisson\nrun = caisson.run('column.prm', {'Time/End time': 0.05,"
            " 'Verification/Checks': ''})\nprint(caisson.__version__, run.status)"
        )
        self.assertRegex(self.python(code), r"^\d+\.\d+\.\d+ finished$")

    def test_program(self) -> None:
        """The program itself, with a scene that includes another and an error bar."""
        scene = self.prefix / "share/caisson_mpm/prm/suction.prm"
        said = self.installed("caisson_mpm", scene, "--validate", "--strict")
        self.assertIn("suction", said)

    def test_copied_scenes(self) -> None:
        """Copies may be written to, and are run instead of the originals."""
        listed = self.installed("caisson", "scenes")
        self.assertIn("a soil column settles under its own weight", listed)
        self.installed("caisson", "scenes", "--copy", "mine")
        scene = self.here / "mine/column.prm"
        scene.write_text(scene.read_text().replace("results/column", "other"))
        self.installed("caisson", "run", "mine/column.prm", *SHORT)
        self.assertEqual(summary(self.here / "other")["scene_file"], "mine/column.prm")
        said = self.installed("caisson", "scenes", "--copy", "mine", status=1)
        self.assertIn("mine: it is there already", said)

    def test_study(self) -> None:
        """Its results go to the current directory; a second time nothing is run."""
        self.installed("caisson", "scenes", "--copy", "mine")
        (self.here / "mine/angles.toml").write_text(STUDY)
        said = self.installed("caisson", "study", "mine/angles.toml")
        self.assertRegex(said, r"angles Friction angle 33: \d+ s")
        table = self.here / "results/parameters/angles/table.csv"
        self.assertIn("Friction angle", table.read_text())
        said = self.installed("caisson", "study", "mine/angles.toml")
        self.assertNotRegex(said, r"Friction angle 33: \d+ s")

    def test_plot_without_results(self) -> None:
        said = self.installed("caisson", "plot", "nothing", status=1)
        self.assertIn("nothing", said)

    def test_commands(self) -> None:
        """All are there, and each has its help."""
        said = self.installed("caisson", "--help")
        for name in COMMANDS:
            self.assertRegex(said, rf"(?m)^  {name} ")
        said = self.python(HELP)
        for name in COMMANDS:
            self.assertRegex(said, rf"(?m)^usage: caisson {name}\b")
            self.assertIn(f"{name} ends with 0\n", said)

    def test_neither_laboratory_nor_workshop(self) -> None:
        names = {path.name for path in self.prefix.rglob("*")}
        self.assertEqual(names & {"lab", "tools", "caisson_workshop"}, set())


class Pages(ProgramTest):
    """The manual pages name what there is, and nothing else."""

    def page(self, name: str) -> str:
        """Return the words of a page."""
        page = (HERE.parent / "doc/man" / name).read_text(encoding="utf-8")
        return re.sub(r"\\f.", "", page.replace("\\-", "-"))

    def test_options(self) -> None:
        help_text = self.run_program(SUCCESS, "--help")
        options = set(re.findall(r"--[\w-]+", help_text))
        self.assertIn("--output-directory", options)
        self.assertEqual(
            options, set(re.findall(r"--[\w-]+", self.page("caisson_mpm.1")))
        )

    def test_commands(self) -> None:
        named = re.findall(r"(?m)^\.TP\n\.BI? \"?([a-z-]+)", self.page("caisson.1"))
        self.assertEqual(set(named), set(COMMANDS))


if __name__ == "__main__":
    unittest.main()
