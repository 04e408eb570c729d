#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""States of runs of the program, exported and read back by other programs."""
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import numpy as np
from program import HERE, SUCCESS, Entries, ProgramTest, history, user_scene

from caisson.results import read_table

sys.path.append(str(HERE.parent / "python/tests"))
from plain_solver import Deck, forces_of, read_deck  # noqa: E402

SHORT: Entries = {
    "Time/End penetration": 1.2,
    "Output/Frame penetrations": 0.5,
}
WALLS = {
    "TIP": "tip_force_N",
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
        script = HERE.parent / "scripts/caisson"
        call = [str(script), "export", str(run), "--to", form, "--output", str(path)]
        call.append("--overwrite")  # one form after the other
        done = subprocess.run([*call, *words], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return path

    def assert_friction(self, deck: Deck, run: Path) -> None:
        """Ask for the forces of the last row of the history on the wall."""
        forces, last = forces_of(deck), history(run)[-1]
        self.assertLess(forces.residual(deck), 0.01)
        for name, column in WALLS.items():
            force = forces.on_body(deck, name)
            self.assertAlmostEqual(force / last[column], 1, delta=0.02, msg=name)

    def test_installed(self) -> None:
        """The residual is below 1 % of the weight, the forces on the wall within 2 % of
        the run; CalculiX finds hardly another stress in equilibrium."""
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
        self.assertLess(change, 0.005)

    def test_wished_in_place(self) -> None:
        """At rest, the exported stress is that of the weight and K0."""
        run = self.directory("run")
        entries = {**SHORT, "Time/End penetration": 0.51}
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
            "Time/End penetration": 1.6,
            "Rigid body/Submerged weight": 2e5,
        }
        self.compute("suction", run, entries)
        table = read_table(self.export(run, "csv"))
        self.assertLess(table["pore_pressure_Pa"].min(), -1e3)
        deck = read_deck(self.export(run, "abaqus", "--spacing", "0.3"))
        self.assertLess(forces_of(deck).residual(deck), 0.01)


if __name__ == "__main__":
    unittest.main()
