#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that are stopped and continued."""
import fcntl
import re
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from program import (
    ALONE,
    BAD_INPUT,
    STOPPED,
    SUCCESS,
    Entries,
    ProgramTest,
    checks,
    flip_a_bit,
    history,
    scene,
    scene_and_entries,
    summary,
)

TWICE = {
    "Output/Record interval": "every step",
    "Time/End penetration": 0.7,
    # the factors of the inertia are searched for in the same steps
    "Time/Mass scaling": 1,
    "Time/Inertia tolerance": 0.4,
    "Verification/Observations": "a = max position_z; b = point stress_zz at 3 -1",
    "Verification/Checks": "average a to 1 : 0 : 0.2; drift b : 1;"
    " drift penetration_m from 0.3 : 0.3",
}
PIPE_SIZE = 4096  # bytes, the smallest


class Stop(ProgramTest):
    """Signals, the stop file and --restart."""

    def run_until(
        self,
        path: Path,
        n_records: int,
        *options: str,
        entries: Entries = TWICE,
        name: str = "jack",
    ) -> tuple[int, str]:
        """Run a scene of the tests, and send SIGTERM after some records. Return the
        exit status and the words after the last record read.

        All records are far more than the pipe holds, so that the program cannot
        come to its end before it gets the signal, however slow this process is.
        """
        file, changed = scene_and_entries(name)
        words = (file, "--output-directory", path, *options)
        command = self.command(*words, entries={**changed, **entries})
        with subprocess.Popen(
            command, bufsize=0, stdout=subprocess.PIPE, env=ALONE
        ) as process:
            assert process.stdout
            fcntl.fcntl(process.stdout, fcntl.F_SETPIPE_SZ, PIPE_SIZE)
            while n_records > 0:
                line = process.stdout.readline()
                self.assertTrue(line, "the program has ended")
                n_records -= line.startswith(b"pen")
            process.send_signal(signal.SIGTERM)
            rest = process.stdout.read().decode()
        return process.returncode, rest

    def run_pieces(self, path: Path, entries: Entries) -> None:
        """Run simulation/jack.prm to an earlier end than it has."""
        self.run_scene("jack", path, entries={**entries, "Time/End penetration": 0.55})

    def test_checkpoints_during_a_run(self) -> None:
        """Those at an interval serve when the run is killed."""
        path = self.directory()
        entries = {"Time/Courant number": 0.05, "Output/Checkpoint interval": 1e-3}
        process = self.start(scene("jack"), "--output-directory", path, entries=entries)
        assert process.stdout
        with process.stdout:
            while process.poll() is None and not (path / "checkpoint.info").exists():
                time.sleep(0.01)
            process.kill()
        self.assertEqual(process.wait(), -signal.SIGKILL)
        entries["Time/End penetration"] = 0.51
        self.run_scene("jack", path, SUCCESS, "--restart", entries=entries)
        self.assertGreater(history(path)[-1]["step"], 400)

    def test_stopped_twice_is_one_run(self) -> None:
        """The history of one run, its checks and its frames."""
        whole, path = self.directory("whole"), self.directory("pieces")
        self.run_scene("jack", whole, entries=TWICE)
        for again in (False, True):
            options = ["--restart"] if again else []
            status, rest = self.run_until(path, 20, *options)
            self.assertEqual(status, STOPPED, rest)
            self.assert_words(["SIGTERM", "--restart"], rest)
            self.assertEqual(summary(path)["status"], "stopped")
        self.run_scene("jack", path, SUCCESS, "--restart", entries=TWICE)
        self.assert_same_results(whole, path)
        self.assertEqual(checks(whole), checks(path))
        for name in ("points.pvd", "grid.pvd", "body.pvd"):
            frames = [
                re.findall("<DataSet.*", (p / name).read_text()) for p in (whole, path)
            ]
            self.assertEqual(frames[0], frames[1], name)
            self.assertGreater(len(frames[0]), 1, name)

    def assert_same_results(self, whole: Path, path: Path) -> None:
        """Ask for the same bits in tables and frames, and for what run.json has of the
        whole run."""
        files = [file for file in whole.iterdir() if file.suffix in (".csv", ".vtu")]
        self.assertGreater(len(files), 4)
        for file in files:
            self.assertEqual(file.read_bytes(), (path / file.name).read_bytes(), file)
        a, b = summary(whole), summary(path)
        for key in "results warnings energies steps point_steps mass_scaling".split():
            self.assertEqual(a[key], b[key], key)
        self.assertEqual(b["steps"], history(path)[-1]["step"])
        self.assertLessEqual(sum(b["sections"].values()), b["wall_time_s"])

    def test_same_bits(self) -> None:
        """Of a law that branches on the points of a register, and of a sealed pull that
        has been warned of."""
        for name, entries in {
            "jack_density": {
                "Output/Record interval": 0.004,
                "Time/End penetration": 0.512,
                "Verification/Checks": "",
            },
            "suction": {
                "Water/Level": "coupled",
                "Water/Suction control": "sealed",
                "Rigid body/Ramp time": 0,
                "Rigid body/Velocity table": "0:0, 0.1:-0.02",
                "Method/Local damping": 0.4,
                "Soil/Layer 1/Permeability": 1e-5,
                "Output/Record interval": 0.01,
                "Time/End penetration": "never",
                "Time/End time": 1,
            },
        }.items():
            with self.subTest(name):
                whole, path = self.directory("whole"), self.directory("pieces")
                self.run_scene(name, whole, entries=entries)
                status, rest = self.run_until(path, 20, entries=entries, name=name)
                self.assertEqual(status, STOPPED, rest)
                self.run_scene(name, path, SUCCESS, "--restart", entries=entries)
                self.assert_same_results(whole, path)
        warnings = " ".join(summary(path)["warnings"])
        self.assertIn("exit gradient exceeds", warnings)

    def test_lost_rows(self) -> None:
        """A restart is refused where history.csv has lost rows since the checkpoint,
        unless the loss is accepted; where it is complete nothing is said."""
        path = self.directory()
        entries: Entries = {"Output/Record interval": 0.1, "Time/End penetration": 0.6}
        self.run_pieces(path, entries)
        rows = (path / "history.csv").read_text().splitlines(keepends=True)
        for kept, words in ((2, "ends at t = 0 s"), (0, "has no rows"), (None, "")):
            with self.subTest(kept=kept):
                copy = self.directory("copy")
                shutil.copytree(path, copy)
                (copy / "history.csv").write_text("".join(rows[:kept]))
                options = ["--restart"]
                if words:
                    refused = self.run_scene(
                        "jack", copy, BAD_INPUT, *options, entries=entries
                    )
                    self.assert_words(
                        ["rows between are lost", words, "--overwrite"], refused
                    )
                    self.assertEqual(
                        (copy / "history.csv").read_text(), "".join(rows[:kept])
                    )
                    options.append("--overwrite")
                said = self.run_scene("jack", copy, SUCCESS, *options, entries=entries)
                self.assertEqual("lost" in said, bool(words), said)

    def test_changed_files(self) -> None:
        """A restart reports that a table, or a list of frames, is not as the run has
        left it."""
        path = self.directory()
        entries: Entries = {
            "Output/Record interval": 0.05,
            "Verification/Observations": "a = max position_z",
            "Time/End penetration": 0.6,
        }
        self.run_pieces(path, entries)
        for name, old, new in (
            ("history.csv", "\n0.1,", "\n0.11,"),
            ("observations.csv", "\n0.05", "\n0.04"),
            ("body.pvd", 'file="body_0000.vtu"', 'file="body_0001.vtu"'),
        ):
            with self.subTest(name=name):
                copy = self.directory("copy")
                shutil.copytree(path, copy)
                text = (copy / name).read_text(encoding="utf-8")
                changed = re.sub(old, new, text)
                self.assertNotEqual(changed, text)
                (copy / name).write_text(changed, encoding="utf-8")
                said = self.run_scene(
                    "jack", copy, SUCCESS, "--restart", entries=entries
                )
                self.assert_words(["warning", name, "been changed since"], said)
        said = self.run_scene("jack", path, SUCCESS, "--restart", entries=entries)
        self.assertNotIn("changed since", said)

    def test_stop_file(self) -> None:
        path = self.made_directory()
        process = self.start(
            scene("jack"),
            "--output-directory",
            path,
            entries={
                "Output/Record interval": 0.05,
                # hours: the file is looked for twice a second
                "Time/Courant number": 1e-4,
            },
        )
        assert process.stdout
        with process.stdout as words:
            for line in words:
                if line.startswith("pen"):
                    break
            (path / "stop").touch()
            text = words.read()
        self.assertEqual(process.wait(), STOPPED, text)
        self.assertFalse((path / "stop").exists(), "the file is left")

    def test_stop_file_of_before(self) -> None:
        """One named stop ends the run; any other one may be a file of the user."""
        path = self.made_directory()
        for name, status in (("notes.txt", BAD_INPUT), ("stop", STOPPED)):
            for ranks in (1, 2):
                (path / name).write_text("mine")
                entries = {"Run control/Stop file": name}
                text = self.run_scene(
                    "jack", path, status, entries=entries, ranks=ranks
                )
                self.assertEqual((path / name).exists(), status == BAD_INPUT, text)
        self.assertEqual((path / "notes.txt").read_text(), "mine")

    def test_finished_run_is_pushed_deeper(self) -> None:
        """A finished run goes on to a later end, in the same files."""
        whole, path = self.directory("whole"), self.directory("pieces")
        depth = "Time/End penetration"
        entries: Entries = {"Output/Record interval": 0.25}
        self.run_scene("jack", whole, entries={**entries, depth: 0.7})
        self.run_scene("jack", path, entries={**entries, depth: 0.6})
        text = self.run_scene(
            "jack", path, SUCCESS, "--restart", entries={**entries, depth: 0.7}
        )
        self.assertNotIn("warning: the error", text)
        self.assertEqual(summary(path)["status"], "finished")
        a, b = history(whole), history(path)
        times = [row["time_s"] for row in b]
        self.assertEqual(times, sorted(set(times)))
        self.assertLessEqual({row["time_s"] for row in a}, set(times))
        for key in ("penetration_m", "external_work_J"):
            self.assertAlmostEqual(a[-1][key] / b[-1][key], 1.0, delta=0.01)

    def test_finished_run_has_nothing_left(self) -> None:
        path = self.directory()
        entries: Entries = {"Time/End penetration": 0.52}
        self.run_scene("jack", path, entries=entries)
        before = summary(path), history(path)
        text = self.run_scene("jack", path, SUCCESS, "--restart", entries=entries)
        self.assertIn("nothing is left to compute", text)
        self.assertEqual((summary(path), history(path)), before)

    def test_restart_without_checkpoint(self) -> None:
        text = self.run_scene("jack", self.directory(), BAD_INPUT, "--restart")
        self.assertIn("no checkpoint", text)

    def test_restart_is_refused(self) -> None:
        """Of another scene, and from a damaged checkpoint."""
        path = self.directory()
        self.run_pieces(path, {})
        text = self.run_scene(
            "jack",
            path,
            BAD_INPUT,
            "--restart",
            entries={"Soil/Layer 1/Friction angle": 31},
        )
        self.assertIn("Friction angle", text)
        info = path / "checkpoint.info"
        words = info.read_text(encoding="utf-8")
        info.write_text(words.replace("_travel ", "_travel 1", 1))
        text = self.run_scene("jack", path, BAD_INPUT, "--restart")
        self.assertIn("is damaged", text)
        info.write_text(words, encoding="utf-8")
        flip_a_bit(path)
        text = self.run_scene("jack", path, BAD_INPUT, "--restart")
        self.assertIn("is damaged", text)
        self.assertNotIn("HDF5", text)
        flip_a_bit(path)
        entries = {"Time/End penetration": 0.56}
        self.run_scene("jack", path, SUCCESS, "--restart", entries=entries)


if __name__ == "__main__":
    unittest.main()
