#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What follows an installation: the commands of doc/how_to/after_installation.md, and
states that are exported and read back by other programs."""
import re
import shlex
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from program import (
    ALONE,
    caisson,
    Entries,
    HERE,
    history,
    ProgramTest,
    SUCCESS,
    user_scene,
)

from caisson.paths import ROOT
from caisson.results import read_table, Results
from caisson.runner import set_options


PAGE = ROOT / "doc/how_to/after_installation.md"
COARSE: Entries = {
    "Rigid body/Wall thickness": 0.2,
    "Rigid body/Cells across the wall": 2,
    "Grid/Outer radius": 6,
    "Grid/Bottom": -6,
    "Grid/Fine width": 0.3,
    "Grid/Fine height": 0.3,
    "Material points/Per direction in path": 2,
    "Material points/Per direction near": 2,
    "Material points/Per direction far": 2,
}
END = "Time/End penetration"
# of some scenes: the first part of their way; prm/springs.prm has a smaller tolerance,
# for the first millimeter
SHORTER: dict[str, Entries] = {
    "prm/springs.prm": {"Time/Inertia tolerance": 0.4},
    "prm/pull_out_after.prm": {END: 1.95},
    "prm/tension.prm": {END: 1.99},
}


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
        """Run one of them as it stands, but for wall and mesh, and the way of some."""
        if words[0] == "scripts/run":
            scene = str(ROOT / words[1])
            more = set_options(COARSE | SHORTER.get(words[1], {}))
            if "suction_clay" in scene:  # test_scene_phases.py computes phases
                more = ["--validate"]
            called = [str(self.program), scene, *words[2:], *more]
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
        for name in ("report.html", "walls.png", "stress.png", "state_abaqus.inp"):
            self.assertTrue((results / "jack_2m" / name).is_file(), name)


sys.path.append(str(HERE.parent / "python/tests"))
from plain_solver import Deck, read_deck  # noqa: E402

SHORT: Entries = {
    END: 1.2,
    "Output/Frame penetrations": 0.5,
}
WALLS = {
    "INNER_WALL": "inner_friction_N",
    "OUTER_WALL": "outer_friction_N",
}
CCX = shutil.which("ccx")


class Export(ProgramTest):
    """scripts/caisson export of a run."""

    def compute(self, scene: str, run: Path, entries: Entries) -> None:
        """Run a scene of prm/."""
        words = (user_scene(scene), "--output-directory", run)
        self.run_program(SUCCESS, *words, entries=entries)

    def export(self, run: Path, form: str, *words: str) -> Path:
        """Export a state; return the file."""
        path = run / "exported"
        call = ["export", run, "--to", form, "--output", path]
        call.append("--overwrite")  # one form after the other
        done = caisson(*call, *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return path

    def assert_friction(self, deck: Deck, run: Path) -> None:
        """Ask for the forces of the last row of the history on the wall."""
        last = history(run)[-1]
        for name, column in WALLS.items():
            force = -sum(deck.loads.get((n, 2), 0) for n in deck.node_sets[name])
            self.assertAlmostEqual(force / last[column], 1, delta=1e-6, msg=name)

    def test_installed(self) -> None:
        """The forces on the wall are those of the run; CalculiX finds equilibrium with
        a stress near to that of the file."""
        run = self.directory("run")
        self.compute("jack_coarse", run, SHORT)
        self.assert_friction(read_deck(self.export(run, "abaqus")), run)
        deck = read_deck(self.export(run, "calculix", "--spacing", "0.3"))
        self.assert_friction(deck, run)
        if CCX is None:
            self.skipTest("CalculiX: needs ccx of the package calculix-ccx")
        shutil.copy(run / "exported", run / "deck.inp")
        call = [CCX, "deck"]
        done = subprocess.run(call, cwd=run, text=True, capture_output=True)
        self.assertNotIn("*ERROR", done.stdout)
        text = (run / "deck.dat").read_text(encoding="utf-8").split("stresses")[1]
        rows = [line.split() for line in text.splitlines()[2:] if line.strip()]
        stress = np.array([[float(word) for word in row[2:6]] for row in rows])
        given = np.repeat(list(deck.stress.values()), 8, axis=0)
        change = np.linalg.norm(stress - given) / np.linalg.norm(given)
        self.assertLess(change, 0.03)

    def test_wished_in_place(self) -> None:
        """At rest, the exported stress is that of the weight and K0."""
        run = self.directory("run")
        entries = {**SHORT, END: 0.51}
        self.compute("jack_coarse", run, entries)
        table = read_table(self.export(run, "csv", "--penetration", "0.5"))
        vertical = 8829 * table["z_m"]
        for name, value in (
            ("zz", vertical),
            ("rr", vertical / 2),
            ("tt", vertical / 2),
        ):
            error = table[f"stress_{name}_Pa"] - value
            self.assertLess(abs(error).max(), 1e-6 * abs(vertical).max(), name)
        self.assertLess(abs(table["stress_rz_Pa"]).max(), 1e-6 * abs(vertical).max())

    def test_seepage(self) -> None:
        """Water flows, and the lid takes it from the plug."""
        run = self.directory("run")
        entries = {
            **SHORT,
            **COARSE,
            END: 0.8,
            "Rigid body/Submerged weight": 2e5,
        }
        self.compute("suction", run, entries)
        table = read_table(self.export(run, "csv"))
        self.assertLess(table["pore_pressure_Pa"].min(), -1e3)
        text = self.export(run, "abaqus", "--spacing", "0.3").read_text("utf-8")
        weight, stress = map(float, re.findall(r" ([\d.]+) kN[:,]", text)[:2])
        self.assertAlmostEqual(stress / weight, 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
