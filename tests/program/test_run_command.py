#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""scripts/caisson run: the directory of the results, signals and statuses."""
import html
import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

from program import BAD_INPUT, HERE, STOPPED, SUCCESS, ProgramTest
from program import caisson, history, scene, summary
from caisson.commands.run import draw
from caisson.runner import Run as Call, set_options

SHORT = ["--set", "Time/End penetration=0.52"]


# the command line as a user calls it, but without pictures
WITHOUT_PICTURES = """
import sys
from unittest import mock
from caisson.__main__ import main
with mock.patch("caisson.commands.run.draw"):
    sys.exit(main(sys.argv[1:]))
"""


def draw_in_full(directory: Path, error_bar: Path | None, in_full: bool = True) -> None:
    """Draw the best run of a band, and not the two beside it."""
    if in_full:
        draw(directory, error_bar)


class Run(ProgramTest):
    """What scripts/run does after the build."""

    def start_run(self, *words: Any, draws: bool = True) -> "subprocess.Popen[str]":
        """Start it in a process group of its own, as a terminal does."""
        python = [sys.executable, "-B", "-c", WITHOUT_PICTURES]
        return subprocess.Popen(
            [
                *([str(HERE.parent / "scripts/caisson")] if draws else python),
                "run",
                *map(str, words),
            ],
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            env={
                **os.environ,
                "CAISSON_MPM_PROGRAM": str(self.program),
                "PYTHONPATH": str(HERE.parent / "python"),
            },
        )

    def run_scene_and_draw(self, status: int, *words: Any) -> str:
        """Run to the end, ask for this status, and return its words."""
        process = self.start_run(*words)
        text = process.communicate()[0]
        self.assertEqual(process.returncode, status, text)
        return text

    def run_here(self, status: int, *words: Any) -> str:
        """Run in this process, ask for this status, and return what Python says."""
        done = caisson("run", *words)
        text = done.stdout + done.stderr
        self.assertEqual(done.returncode, status, text)
        return text

    def run_without_pictures(self, status: int, *words: Any) -> str:
        """Run to the end, ask for this status, and return its words."""
        process = self.start_run(*words, draws=False)
        text = process.communicate()[0]
        self.assertEqual(process.returncode, status, text)
        return text

    def assert_drawn(self, path: Path) -> None:
        """Ask for the pictures of a run."""
        for name in ("forces.png", "stress.png", "displacement.png"):
            self.assertTrue((path / name).is_file(), name)

    def test_report_has_the_warnings(self) -> None:
        """What has no effect is reported in the terminal, run.json and the page. The
        directory is that of an entry; the other tests name it by its option. So on
        several ranks."""
        path = self.directory()
        ranks = ["--ranks", 2]
        unused = ["--set", "Water/Renewal=0.125", "--set", f"Output/Directory={path}"]
        text = self.run_scene_and_draw(SUCCESS, *ranks, scene("jack"), *SHORT, *unused)
        self.assertIn("warning: ", text)
        self.assertEqual(summary(path)["ranks"], 2)
        (warning,) = summary(path)["warnings"]
        self.assertIn("Water/Renewal", warning)
        entries = summary(path)["entries"]
        self.assertEqual(entries["Water/Renewal"], "0.125")
        self.assertNotIn("Water/Level", entries)
        page = html.unescape((path / "report.html").read_text(encoding="utf-8"))
        for part in (warning, "<td>0.125</td>", "Status: finished"):
            self.assertTrue(part in page, part)  # the page is long
        self.assert_drawn(path)

    def test_several_ranks_are_stopped(self) -> None:
        """mpirun does not make a failure of it, where it has an option for it."""
        path = self.directory()
        words = ["--ranks", 2, scene("jack"), "--output-directory", path]
        words += ["--set", "Run control/Wall time limit=0.01"]
        text = self.run_without_pictures(STOPPED, *words)
        self.assertIn("stopped: wall time limit", text)
        version = subprocess.run(
            ["mpirun", "--version"], capture_output=True, text=True
        )
        if "(Open MPI) 4" in version.stdout:
            self.assertNotIn("mpirun", text)
            self.assertNotIn("non-zero", text)

    def test_only_what_was_written_is_drawn(self) -> None:
        path = self.directory()
        words = [scene("jack"), *SHORT, "--output-directory", path]
        self.run_here(SUCCESS, *words)
        self.assert_drawn(path)
        (path / "forces.png").unlink()
        self.run_here(SUCCESS, *words, "--validate")
        self.assertFalse((path / "forces.png").exists())
        text = self.run_scene_and_draw(BAD_INPUT, *words, "--set", "Grid/Tip=1")
        self.assertEqual(text.count("bad input"), 1)
        self.assertFalse((path / "forces.png").exists())

    def band(self) -> Path:
        """Write the scenes of a band; return the best one, own.prm."""
        path = self.made_directory()
        for end, angle in (("", 33), ("_low", 30), ("_high", 36)):
            lines = [
                f"include {scene('jack')}",
                f"subsection Output\nset Directory = {path}/own{end}\nend",
                "subsection Time\nset End penetration = 0.56\nend",
                f"subsection Soil\nsubsection Layer 1\nset Friction angle = {angle}",
                "end\nend",
            ]
            (path / f"own{end}.prm").write_text("\n".join(lines), encoding="utf-8")
        return path / "own.prm"

    def test_band(self) -> None:
        """Three runs, one page of the best one; complete runs are not repeated, and
        each is told what becomes of it."""
        best = self.band()
        path = best.parent
        with mock.patch("caisson.commands.run.draw", draw_in_full):
            text = self.run_here(SUCCESS, "--band", best)
        self.assertEqual(text.count("from its start"), 3)
        self.assertRegex(text, "With low resistance .* at 0.56 m; with high resistance")
        self.assert_drawn(path / "own")
        page = (path / "own/report.html").read_text(encoding="utf-8")
        self.assertTrue("total, low to high resistance" in page)
        low, high = (history(path / f"own_{end}") for end in ("low", "high"))
        self.assertGreater(high[-1]["total_force_N"], low[-1]["total_force_N"])
        for name in ("run_key.json", "run.json"):
            (path / "own_low" / name).unlink()
        with mock.patch("caisson.commands.run.draw") as drawn:
            text = self.run_here(SUCCESS, best, "--band")
        self.assertEqual(drawn.call_count, 3)
        self.assertEqual(text.count("complete, and not repeated; --overwrite"), 2)
        self.assertIn("own_low: from its start", text)
        self.assertEqual(history(path / "own_low"), low)
        text = self.run_here(BAD_INPUT, "--band", best, "--ranks", 2)
        self.assertIn("--band takes --set, --restart and --overwrite", text)

    def test_band_is_stopped(self) -> None:
        """By its stop files; its runs then go on from their checkpoints, as those of a
        park do: those of the same entries that have not ended."""
        best = self.band()
        slow: dict[str, float] = {"Time/Courant number": 1e-3}
        process = self.start_run("--band", best, *set_options(slow), draws=False)
        left = {best.parent / f"own{end}" for end in ("", "_low", "_high")}
        while left and process.poll() is None:  # one after the other on few cores
            for path in {path for path in left if (path / "history.csv").exists()}:
                (path / "stop").touch()
                left.remove(path)
            time.sleep(0.05)
        text = process.communicate()[0]
        self.assertEqual(process.returncode, STOPPED, text)
        self.assertEqual(text.count("--restart resumes it"), 3, text)
        for entries in (slow, dict[str, float]()):
            run = Call(best, entries, best.parent / "own", program=self.program)
            run.resume()
            self.assertEqual(run.restarts, entries == slow)
        with mock.patch("caisson.commands.run.draw"):
            self.run_here(SUCCESS, "--band", best, "--overwrite")
        run = Call(best, {}, best.parent / "own", program=self.program)
        run.resume()
        self.assertTrue(run.has_checkpoint)
        self.assertFalse(run.restarts, "it has ended")

    def test_ctrl_c_leaves_a_checkpoint(self) -> None:
        """The terminal sends it to all; nothing may kill the program meanwhile."""
        path = self.directory()
        words = [scene("jack"), "--output-directory", path]
        # many minutes
        words += ["--set", "Time/Courant number=1e-3"]
        process = self.start_run(*words, draws=False)
        while not (path / "history.csv").exists() and process.poll() is None:
            time.sleep(0.05)
        os.killpg(process.pid, signal.SIGINT)
        text = process.communicate()[0]
        self.assertEqual(process.returncode, STOPPED, text)
        self.assertIn("--restart", text)
        self.assertTrue((path / "checkpoint.info").is_file(), text)


if __name__ == "__main__":
    unittest.main()
