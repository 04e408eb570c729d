#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies with the program: verdicts of the verification ladder."""
import csv
import subprocess
import unittest
from pathlib import Path

from program import HERE, ProgramTest, scene, user_scene

from caisson.paths import SCENES
from caisson.run import read_parameters
from caisson.study import Options, Reader
from caisson.study_command import module_of

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
    """scripts/caisson study."""

    def verify(self, path: Path, *options: str) -> "subprocess.CompletedProcess[str]":
        """Run the ladder above."""
        ladder = path / "ladder.toml"
        ladder.write_text(LADDER, encoding="utf-8")
        words = [
            str(HERE.parent / "scripts/caisson"),
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


class ShippedStudies(ProgramTest):
    """The studies of prm/."""

    def test_entries_are_declared(self) -> None:
        """Each entry that a study sets is one of the program: a misspelled one
        would be refused only when the study runs."""
        declared = set(read_parameters([user_scene("jack")], self.program))
        files = sorted(SCENES.rglob("*.toml"))
        self.assertGreater(len(files), 0)
        for file in files:
            module = module_of(file)
            for quick in (False, True):
                reader = Reader(
                    file, Options(quick=quick), module.STUDY_KEYS, module.RUN_KEYS
                )
                for run in (run for study in reader.studies() for run in study.runs):
                    with self.subTest(file=file.name, study=run.study, run=run.name):
                        self.assertEqual(set(run.run.entries) - declared, set())


if __name__ == "__main__":
    unittest.main()
