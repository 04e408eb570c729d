#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies with the program: verdicts of the verification ladder."""
import csv
import re
import subprocess
import unittest
from pathlib import Path
from unittest import mock

from program import HERE, ProgramTest, caisson, scene, user_scene

from caisson import disk
from caisson.runner import read_parameters
from caisson.study_command import module_of
from lab.study import Options
from lab.study_command import KINDS, files, reader_of

CHECKS = '"Verification/Checks"'
LADDER = f"""
kind = "verification"
[[study]]
id = "wave"
title = "wave"
scene = "{scene('wave_xpic')}"
runs = [
  {{h = 1.0, set = {{{CHECKS} = "rms stress_rz : 1 : 0.5; spread density : 1"}}}},
  {{h = 0.5, set = {{{CHECKS} = "rms stress_rz : 0 : 0.5; spread density : 1"}}}}]
checks = [
  {{check = "spread density"}},
  {{check = "spread density", error = 1e-9}},
  {{check = "spread density", error = 1e-9, known_error = 0.1, why = "a file"}},
  {{check = "spread speed"}},
  {{check = "rms stress_rz", run = 0}},
  {{check = "rms stress_rz", run = 0, error = 0.3, known_error = 1.0}},
  {{check = "rms stress_rz", run = 1, error = 1e-9, known_error = 1e-9}},
  {{check = "spread density", order = 99.0}},
  {{check = "spread density", order = 99.0, known_order = -9.0}}]
[[study]]
id = "refused"
title = "refused"
scene = "{scene('wave_xpic')}"
runs = [{{set = {{"Time/Courant number" = 7}}}}]
checks = [{{check = "max displacement_r"}}]
"""
VERDICTS = "pass FAIL short FAIL FAIL short pass FAIL short FAIL".split()


class Ladder(ProgramTest):
    """scripts/lab study."""

    def verify(self, path: Path, *options: str) -> "subprocess.CompletedProcess[str]":
        """Run the ladder above."""
        ladder = path / "ladder.toml"
        ladder.write_text(LADDER, encoding="utf-8")
        words = [
            str(HERE.parent / "scripts/lab"),
            "study",
            str(ladder),
            "--program",
        ]
        words += [str(self.program), "--results", str(path / "results"), *options]
        return subprocess.run(
            words, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
        )

    def test_verdicts(self) -> None:
        """Rows that pass, fall short as known, fail, and a run that is refused;
        orders over two runs."""
        path = self.made_directory()
        done = self.verify(path)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("10 rows: 2 pass, 3 fall", done.stdout)
        with open(path / "results/table.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        verdicts = [row["verdict"].split(" ")[0].strip(",") for row in rows]
        self.assertEqual(verdicts, VERDICTS, done.stdout)
        self.assertIn("a file", rows[2]["verdict"])
        self.assertIn("spread speed", rows[3]["computed"])
        self.assertIn("status 1", rows[-1]["computed"])

    def test_list(self) -> None:
        done = self.verify(self.made_directory(), "--only", "refused", "--list")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertNotIn("wave:", done.stdout)


PARAMETERS = f"""
kind = "parameters"
scene = "{HERE.parent / 'python/tests/tiny_run.prm'}"
sampling = "one at a time"
set = {{"Output/Frame penetrations" = ""}}
[parameters."Soil/Layer 1/Friction angle"]
values = [VALUES]
[parameters."wall"]
entries = ["Rigid body/Friction angle of the inner wall",
           "Rigid body/Friction angle of the outer wall"]
values = [30]
"""


class Parameters(ProgramTest):
    """A study of kind "parameters"."""

    def study(
        self, path: Path, values: str, *options: str
    ) -> "subprocess.CompletedProcess[str]":
        """Run the study above with these friction angles."""
        file = path / "angles.toml"
        file.write_text(PARAMETERS.replace("VALUES", values), encoding="utf-8")
        words = ["--program", self.program, "--results", path, *options]
        done = caisson("study", file, *words)
        done.stdout += done.stderr
        return done

    def test_angles(self) -> None:
        """The base is the scene's; a stronger soil and rougher walls resist more; a
        value that is added later costs one run."""
        self.enterContext(mock.patch.object(disk, "DPI", 150))  # that of users
        path = self.made_directory()
        done = self.study(path, "26")
        self.assertEqual(done.returncode, 0, done.stdout)
        marks = {p: p.stat().st_mtime_ns for p in path.rglob("run_key.json")}
        self.assertEqual(len(marks), 3, done.stdout)
        done = self.study(path, "26, 30, 36")
        self.assertEqual(done.returncode, 0, done.stdout)
        after = {p: p.stat().st_mtime_ns for p in path.rglob("run_key.json")}
        self.assertEqual(marks, {p: after[p] for p in marks})
        self.assertEqual(len(after), 4)
        with open(path / "angles/table.csv", encoding="utf-8") as file:
            rows = {row["run"]: row for row in csv.DictReader(file)}
        force = {n: float(row["total_force_N at 1.2 m"]) for n, row in rows.items()}
        self.assertLess(1.1 * force["Friction angle 26"], force["base"])
        self.assertLess(1.1 * force["base"], force["Friction angle 36"])
        self.assertLess(force["base"], force["wall 30"])
        base = rows["base"]
        self.assertEqual(
            (base["Soil/Layer 1/Friction angle"], base["wall"]), ("30", "20")
        )
        for picture in ("fan.png", "tornado.png"):
            self.assertGreater((path / "angles" / picture).stat().st_size, 10000)

    def test_refused(self) -> None:
        """A value that the program refuses is reported in its words before a run."""
        path = self.made_directory()
        done = self.study(path, "26, 75")
        self.assertEqual(done.returncode, 1, done.stdout)
        words = ["'Friction angle 75' is refused", "Allowed: a number from 0 to 60"]
        self.assert_words(words, done.stdout)
        self.assertEqual(list(path.rglob("history.csv")), [])


class ShippedStudies(ProgramTest):
    """The studies of users and of the laboratory."""

    def test_entries_are_declared(self) -> None:
        """Each entry that a study sets is one of the program: a misspelled one
        would be refused only when the study runs."""
        declared = set(read_parameters([user_scene("jack")], self.program))
        for file in files():
            module = module_of(file, KINDS)
            for quick in (False, True):
                reader = reader_of(file, Options(quick=quick), module)
                for run in (run for study in reader.studies() for run in study.runs):
                    # all layers have the entries of the first
                    entries = {
                        re.sub(r"^Soil/Layer \d+/", "Soil/Layer 1/", entry)
                        for entry in run.run.entries
                    }
                    with self.subTest(file=file.name, study=run.study, run=run.name):
                        self.assertEqual(entries - declared, set())


if __name__ == "__main__":
    unittest.main()
