#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""An installation and what follows it as one scene: Installation/Phases."""
import html
import json
import shutil
import unittest
from pathlib import Path
from unittest import mock

from program import BAD_INPUT, FAILURE, SUCCESS, Entries, ProgramTest, caisson
from program import history, scene, set_options, summary
from test_undrained_suction import TOTAL_STRESS

from caisson import phases, report
from caisson.results import Results
from caisson.runner import Run, read_parameters

SHORT: Entries = {
    **TOTAL_STRESS,
    "Water/Suction control": "automatic",
    "Time/End penetration": 0.53,
    "Output/Record interval": 0.02,
}
FOLDER = "phase_2_retrieval"


def draw(directory: Path, *_: object) -> None:
    """Write the page without pictures."""
    (directory / "forces.png").touch()
    report.write(directory)


@mock.patch("caisson.commands.run.draw", draw)
class Phases(ProgramTest):
    """A caisson that is jacked into clay by 3 cm, and pushed out again by water."""

    def run_phases(self, status: int, path: Path, *words: str, **more: str) -> str:
        """Run the scene and its phases; return what is said."""
        entries = {**SHORT, phases.ENTRY: "retrieval to 0.51 m", **more}
        call = ["run", scene("jack"), "--output-directory", path]
        done = caisson(*call, *set_options(entries), *words)
        text = done.stdout + done.stderr
        self.assertEqual(done.returncode, status, text)
        return text

    def test_retrieval(self) -> None:
        """It begins where the installation ended, and a repeated command keeps both.
        Another depth is another phase, after the same installation. One that was
        stopped goes on."""
        path = self.directory()
        self.run_phases(SUCCESS, path)
        rows = history(path / FOLDER)
        self.assertAlmostEqual(rows[0]["penetration_m"], 0.53, delta=1e-4)
        self.assertAlmostEqual(rows[-1]["penetration_m"], 0.51, delta=1e-4)
        self.assertLess(rows[-1]["suction_Pa"], -1e3)
        page = html.unescape((path / "report.html").read_text(encoding="utf-8"))
        self.assertTrue(f'<a href="{FOLDER}/report.html">retrieval to 0.51 m' in page)
        # it goes on by 4 mm before it turns
        self.assertTrue(
            "From 0.54 m to 0.51 m, retrieval takes an overpressure" in page
        )
        own = html.unescape((path / FOLDER / "report.html").read_text(encoding="utf-8"))
        self.assertTrue("undrained clay (total stress), pushed out by water" in own)
        self.assertFalse(">drained, open lid" in own)

        times = [summary(x)["written"] for x in (path, path / FOLDER)]
        text = self.run_phases(SUCCESS, path)
        self.assertEqual(text.count("complete, and not repeated"), 2)
        again = [summary(x)["written"] for x in (path, path / FOLDER)]
        self.assertEqual(again, times)

        text = self.run_phases(SUCCESS, path, **{phases.ENTRY: "retrieval to 0.52"})
        self.assertEqual(text.count("complete, and not repeated"), 1)
        self.assertEqual(summary(path)["written"], times[0])
        end = Results(path / FOLDER).history["penetration_m"][-1]
        self.assertAlmostEqual(end, 0.52, delta=1e-4)

        record = path / FOLDER / "run_key.json"
        before = json.loads(record.read_text(encoding="utf-8"))
        self.stop(path / FOLDER)
        text = self.run_phases(SUCCESS, path, **{phases.ENTRY: "retrieval to 0.52"})
        self.assertIn(f"{FOLDER}: goes on from its checkpoint", text)
        after = json.loads(record.read_text(encoding="utf-8"))
        self.assertEqual(after["key"], before["key"])

    def test_after_an_installation(self) -> None:
        """An installation that the user has run is not repeated. A folder that was
        moved keeps what is complete in it. Phases of an earlier installation do not
        stand for those of a new one, also where they set what it has changed, and do
        not go on after it."""
        path = self.directory()
        self.run_phases(SUCCESS, path, **{phases.ENTRY: ""})
        time = summary(path)["written"]
        text = self.run_phases(SUCCESS, path)
        self.assertEqual(text.count("complete, and not repeated"), 1)
        self.assertEqual(summary(path)["written"], time)
        moved = path.with_name(f"{path.name}_moved")
        shutil.rmtree(moved, ignore_errors=True)
        path.rename(moved)
        text = self.run_phases(SUCCESS, moved)
        self.assertEqual(text.count("complete, and not repeated"), 2, text)
        damped = {"Method/Local damping": "0.3"}
        words = {phases.ENTRY: "", **damped}
        self.run_phases(SUCCESS, moved, "--overwrite", **words)
        text = self.run_phases(SUCCESS, moved, **damped)
        self.assertEqual(text.count("complete, and not repeated"), 1, text)
        self.stop(moved / FOLDER)
        (moved / "history.csv").touch()
        text = self.run_phases(SUCCESS, moved, **damped)
        self.assertNotIn("goes on from its checkpoint", text)

    def test_restart(self) -> None:
        """A finished installation goes on to a later end, and is refused in the words
        of the program with another entry. Without --restart its results are put aside
        then, and those of the phase."""
        path = self.directory()
        self.run_phases(SUCCESS, path)
        deeper = {"Time/End penetration": "0.54"}
        text = self.run_phases(SUCCESS, path, "--restart", **deeper)
        self.assertIn("from its checkpoint", text)
        damped = {**deeper, "Method/Local damping": "0.3"}
        text = self.run_phases(FAILURE, path, "--restart", **damped)
        self.assertIn("was written with Method/Local damping = 0 and cannot", text)
        self.assertFalse((path / "earlier_1").exists())
        self.assertTrue((path / FOLDER / "earlier_1/history.csv").is_file())
        self.run_phases(SUCCESS, path, **damped)
        self.assertTrue((path / "earlier_1/history.csv").is_file())

    @staticmethod
    def stop(phase: Path) -> None:
        """Let a phase that is complete be one that was stopped."""
        (phase / "run_key.json").unlink()
        told = phase / "run.json"
        text = told.read_text(encoding="utf-8")
        told.write_text(text.replace('"finished"', '"stopped"'), encoding="utf-8")

    def test_band(self) -> None:
        """The best scene of a band has phases. They are refused before anything is run,
        repeated after another installation, and kept otherwise."""
        path = self.directory()
        path.mkdir(parents=True)
        for name in ("anchor", "anchor_low"):
            text = Path(scene("jack")).read_text(encoding="utf-8")
            (path / f"{name}.prm").write_text(text, encoding="utf-8")
        entries = {**SHORT, "Output/Directory": path / "results"}
        call = ["run", "--band", path / "anchor.prm"]

        def run(text: str, *words: str) -> str:
            done = caisson(*call, *set_options(entries | {phases.ENTRY: text}), *words)
            return done.stdout + done.stderr

        self.assertIn("'pul' is no phase", run("pul"))
        self.assertFalse((path / "results").exists())
        text = run("retrieval to 0.51 m")
        self.assertEqual(text.count("complete, and not repeated"), 1, text)
        self.assertTrue((path / "results" / FOLDER / "history.csv").is_file(), text)
        text = run("retrieval to 0.51 m")
        self.assertEqual(text.count("complete, and not repeated"), 4, text)
        text = run("retrieval to 0.51 m", "--overwrite")
        self.assertEqual(text.count("complete, and not repeated"), 1, text)

    def test_refused_before_a_run(self) -> None:
        """One line, and no folder."""
        path = self.directory()
        for words, said in {
            "retrieval, pul": "'pul' is no phase; known are",
            "rest 30 d": "leave it out",
            "pull drained": "strength of layer 1 is undrained",
            "push to 99 m": "cannot accommodate a travel of 98.5 m",
        }.items():
            text = self.run_phases(BAD_INPUT, path, **{phases.ENTRY: words})
            self.assertIn(said, text)
            self.assertEqual(len(text.strip().splitlines()), 1, text)
        self.assertFalse(path.exists())

    def test_phase_that_cannot_begin(self) -> None:
        """One line says how to go on: with a file in the place of its folder, without
        the checkpoint. An earlier phase is not drawn as the one that was refused. A
        scene with a damaged record is computed again."""
        path = self.directory()
        path.mkdir(parents=True)
        (path / FOLDER).write_text("mine", encoding="utf-8")
        text = self.run_phases(FAILURE, path)
        self.assertEqual(text.count(f"{FOLDER} is no directory; name another"), 2)
        self.assertNotIn("no pictures", text)
        (path / FOLDER).unlink()
        self.run_phases(SUCCESS, path)
        for name in ("run_key.json", "run.json", "checkpoint.info"):
            (path / FOLDER / name).unlink()
        (path / "checkpoint.info").unlink()
        text = self.run_phases(FAILURE, path)
        self.assertNotIn("retrieval takes", text)
        self.assertIn("--overwrite computes the scene and its phases again", text)
        (path / "run.json").write_text("", encoding="utf-8")  # damaged, and put aside
        self.run_phases(SUCCESS, path)
        self.assertTrue((path / "earlier_1/history.csv").is_file())


class Sealed(ProgramTest):
    """What follows an installation in coupled water below a sealed lid."""

    def test_inertia(self) -> None:
        """The program takes the inertia of a rest and of a pull after an installation
        with a tolerance of it, and after one whose mass is scaled by more than theirs.
        """
        path = self.directory()
        for tolerance, scaling in (("0.8", 1), ("none", 400)):
            entries: Entries = {
                "Water/Level": "coupled",
                "Time/End penetration": 0.505,
                "Time/Inertia tolerance": tolerance,
                "Time/Mass scaling": scaling,
            }
            there = path / tolerance
            self.run_scene("suction", there, entries=entries)
            known = read_parameters([scene("suction"), *set_options(entries)])
            for text in ("rest 1 d", "pull undrained to 0.504"):
                part = phases.phases_in(text)
                own = phases.entries_of(part, there, known, "mine")
                Run(Path(scene("suction")), {**entries, **own}, path / "new").validate()


if __name__ == "__main__":
    unittest.main()
