#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The output directory, and how a run ends that is not asked to."""
import resource
import signal
import subprocess
import time
import unittest

from program import (
    ALONE,
    BAD_INPUT,
    FAILURE,
    STOPPED,
    SUCCESS,
    ProgramTest,
    scene,
    summary,
)

from caisson import disk, plot, report

# many minutes, with a row soon
SLOW = {"Output/Record interval": 1e-4, "Time/Courant number": 1e-3}


class Directory(ProgramTest):
    """Runs that write to the same directory."""

    def test_second_run_is_refused(self) -> None:
        path = self.directory()
        first = self.start(scene("jack"), "--output-directory", path, entries=SLOW)
        assert first.stdout
        with first.stdout as words:
            words.readline()
            text = self.run_scene("jack", path, BAD_INPUT)
            self.assertIn("in use by another run", text)
            self.assertIn(str(first.pid), text)
            first.kill()
            words.read()
        first.wait()
        self.run_scene("jack", path, SUCCESS, "--validate")
        self.run_scene("jack", path, entries={"Time/End penetration": 0.5})

    def test_no_directory(self) -> None:
        """An empty name is bad input, whoever checks it."""
        for options in ((), ("--validate",)):
            text = self.run_program(
                BAD_INPUT, scene("jack"), *options, entries={"Output/Directory": ""}
            )
            self.assert_words(["Output/Directory is empty", "for instance"], text)

    def test_old_results_are_not_lost(self) -> None:
        """They are put aside; with --overwrite too, where no run has written them."""
        path, history = self.made_directory(), "time_s\n0\n1\n"
        entries = {"Time/End penetration": 0.51, "Output/Terminal": "full"}
        for number in (1, 2, 3):
            options = ["--overwrite"] if number == 3 else []
            with self.subTest(number=number):
                for name in (
                    "points_0009.vtu",
                    "body_0009.vtu",
                    "forces.png",
                    "vessel.html",
                    "notes.txt",
                ):
                    (path / name).write_text("old")
                (path / "history.csv").write_text(history)
                text = self.run_scene("jack", path, SUCCESS, *options, entries=entries)
                self.assertEqual(list(path.glob("*_0009.vtu")), [])
                self.assertTrue((path / "notes.txt").exists())
                aside = path / f"earlier_{number}"
                self.assertIn(str(aside), text)
                names = {file.name for file in aside.iterdir()}
                self.assertLessEqual({"vessel.html", "history.csv"}, names)
                self.assertEqual("points_0009.vtu" in names, number < 3)
                self.assertEqual("run.json" in names, number == 2)
                self.assertEqual((aside / "history.csv").read_text(), history)

    def test_overwrite(self) -> None:
        """No picture or table of the run before stays beside a new one; those of a user
        do, as a measured log of any name, and what a user has changed or written with
        the name of a result is put aside, which a line says."""
        path = self.directory()
        entries = {"Time/End penetration": 0.501, "Output/Terminal": "full"}
        self.run_scene("jack", path, entries=entries)
        plot.draw(path)
        report.write(path)
        made = {file.name for file in path.iterdir()}
        disk.write(path / "log_sheet.csv", "blank")
        with (path / "history.csv").open("a", encoding="utf-8") as table:
            table.write("# of interest\n")
        mine = {"wall_pressure.csv", "jacked.csv", "points.csv", "observations.csv"}
        mine |= {"phases.txt", "suction.png", "report.html", "vessel.html", "state.csv"}
        for name in mine | {"mine.png", "vessel.csv", "verification.json"}:
            (path / name).write_text("mine")
        text = self.run_scene("jack", path, SUCCESS, "--overwrite", entries=entries)
        stay = {file.name for file in path.iterdir() if file.is_file()}
        self.assertLessEqual({"mine.png", "vessel.csv", "verification.json"}, stay)
        aside = {file.name: file for file in (path / "earlier_1").iterdir()}
        self.assertEqual({*aside}, mine | {"history.csv"})
        self.assertEqual({aside[name].read_text() for name in mine}, {"mine"})
        self.assertIn("# of interest", aside["history.csv"].read_text())
        self.assert_words(["files of an earlier run", f"to {path}/earlier_1"], text)
        plotted = {x for x in made if x.endswith((".png", ".html"))} | {"design.csv"}
        self.assertGreater(len(plotted), 3)
        self.assertEqual(stay & (plotted | mine | {"log_sheet.csv"}), set())
        (path / "log_sheet.csv").write_text("filled in")
        self.run_scene("jack", path, entries=entries)
        self.assertEqual((path / "log_sheet.csv").read_text(), "filled in")
        self.assertEqual((path / "vessel.csv").read_text(), "mine")

    def test_what_is_kept(self) -> None:
        """Frames without a table, and a run stopped before its second row; what
        cannot be moved stays, and the run is refused."""
        path = self.made_directory()
        (path / "points_0009.vtu").write_text("old")
        (path / "earlier_3").mkdir()
        short = {"Time/End penetration": 0.51}
        self.run_scene("jack", path, entries=short)
        self.assertTrue((path / "earlier_4" / "points_0009.vtu").exists())
        for name in ("history.csv", "checkpoint.info"):
            (path / name).write_text("time_s\n0\n")
        self.run_scene("jack", path, entries=short)
        self.assertEqual(
            (path / "earlier_5" / "history.csv").read_text(), "time_s\n0\n"
        )
        before = (path / "run.json").read_text()
        for number in (999_999, 999_999_999):  # the latter is no run's
            (path / f"earlier_{number}").mkdir()
        for target in ("nowhere", "earlier_3"):
            link = path / "earlier_1000000"
            link.unlink(missing_ok=True)
            link.symlink_to(target)
            text = self.run_scene("jack", path, BAD_INPUT, entries=short)
            self.assertIn("cannot be moved", text)
            self.assertEqual((path / "run.json").read_text(), before)
        self.assertEqual(list((path / "earlier_3").iterdir()), [])


class Failures(ProgramTest):
    """Runs that cannot go on."""

    def test_the_reason_is_in_run_json(self) -> None:
        """Of a table that cannot be written, as on a full disk."""
        for ranks in (1, 2):
            path = self.made_directory()
            (path / "history.csv" / "in_the_way").mkdir(parents=True)
            text = self.run_scene("jack", path, FAILURE, ranks=ranks)
            (failure,) = [line for line in text.splitlines() if "failure: " in line]
            found = summary(path)
            self.assertEqual(found["status"], "failed")
            self.assertEqual("failure: " + found["failure"], failure)
            self.assertEqual(found["ranks"], ranks)
            self.assertGreater(found["scene"]["diameter_m"], 0)
            self.assertEqual(list(path.glob("run.json?*")), [])

    def test_long_path(self) -> None:
        """A path longer than 255 characters has checkpoints, of several ranks too."""
        path = self.directory() / ("a" * 200) / ("b" * 200)
        end = {"Time/End penetration": 0.505}
        for ranks in (1, 2):
            self.run_scene("jack", path, entries=end, ranks=ranks)
            self.assertTrue((path / "checkpoint.info").is_file())

    def test_limit_of_file_size(self) -> None:
        """It is met as a full disk is, and not by the end of the process."""
        path = self.directory()
        limit = 60 * 1024
        done = subprocess.run(
            self.command(scene("jack"), "--output-directory", path),
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env=ALONE,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit,) * 2),
        )
        self.assertEqual(done.returncode, FAILURE, done.stdout)
        self.assert_words(["cannot write", "File too large"], done.stdout)
        self.assertEqual(summary(path)["status"], "failed")


class Signals(ProgramTest):
    """Signals other than those of test_stop_and_restart.py."""

    def test_signals_stop_in_order(self) -> None:
        """That of a terminal that is closed, and that of its key for quitting."""
        for sent in (signal.SIGHUP, signal.SIGQUIT):
            with self.subTest(sent.name):
                path = self.directory()
                process = self.start(
                    scene("jack"), "--output-directory", path, entries=SLOW
                )
                assert process.stdout
                with process.stdout as words:
                    for line in words:
                        if line.startswith("pen"):
                            break
                    process.send_signal(sent)
                    text = words.read()
                self.assertEqual(process.wait(), STOPPED, text)
                self.assert_words([sent.name], text)
                self.assertEqual(summary(path)["status"], "stopped")

    def test_a_closed_pipe_does_not_end_the_run(self) -> None:
        path = self.directory()
        command = self.command(
            scene("jack"), "--output-directory", path, entries={**SLOW}
        )
        process = subprocess.Popen(command, text=True, stdout=subprocess.PIPE)
        assert process.stdout
        process.stdout.readline()
        process.stdout.close()
        rows = path / "history.csv"
        while process.poll() is None and not rows.exists():
            time.sleep(0.05)
        size = rows.stat().st_size
        while process.poll() is None and rows.stat().st_size < size + 2000:
            time.sleep(0.05)
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(), STOPPED)


if __name__ == "__main__":
    unittest.main()
