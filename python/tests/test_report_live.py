# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.html of made-up runs that have not ended."""
import fcntl
import os
import time
import unittest
from unittest import mock

import numpy as np
from synthetic import write_run
from test_report import SUMMARY, WithPage, leave_run

import caisson.report as report
from caisson.commands import run as launch
from caisson.report import page as page_module
from caisson.results import Results


class Live(WithPage):
    """The page while the program computes."""

    def test_run_that_goes_on(self) -> None:
        """Its page reloads itself, also where an old run.json is left."""
        self.assertIn('http-equiv="refresh"', self.page())
        with (self.path / ".lock").open("w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertIn('http-equiv="refresh"', self.page(SUMMARY))
        self.assertNotIn('http-equiv="refresh"', self.page(SUMMARY))

    def test_report_of_a_run_in_progress_is_renewed(self) -> None:
        """`caisson run` writes it while the program runs."""
        leave_run(self.path, {**SUMMARY, "status": "running"})
        page, end = self.path / report.NAME, time.monotonic() + 120
        with mock.patch.object(launch, "RENEWAL", 0.1), launch.reporting(self.path):
            while not page.is_file() and time.monotonic() < end:
                time.sleep(0.1)
        self.assertIn("sand &lt;b&gt;", page.read_text(encoding="utf-8"))

    def test_renewed_whatever_it_costs(self) -> None:
        """Each RENEWAL, also where a renewal takes nearly as long, while there are new
        rows."""
        leave_run(self.path, {**SUMMARY, "status": "running"})
        begins = []

        def write(*_: object, **__: object) -> None:
            begins.append(time.monotonic())
            time.sleep(0.15)
            with (self.path / "history.csv").open("a", encoding="utf-8") as file:
                file.write("\n" if len(begins) < 4 else "")

        with mock.patch.object(launch.subprocess, "run", write):
            with mock.patch.object(launch, "RENEWAL", 0.2), launch.reporting(self.path):
                time.sleep(2.0)
        self.assertEqual(len(begins), 4)
        self.assertLess(max(np.diff(begins)), 0.5)

    def test_remaining_time(self) -> None:
        """200 steps of 0.01 s for each unit of the square root of the depth, from 0.5
        to 4.5 m; half is done at 2.5 m."""
        progress = {"fraction_done": 0.5}
        summary = {**SUMMARY, "status": "running", "progress": progress}
        leave_run(self.path, summary)
        history = dict(Results(self.path).history)
        half = history["penetration_m"] <= 2.5
        history = {name: values[half] for name, values in history.items()}
        depth = history["penetration_m"]
        history["time_s"] = depth - depth[0]
        history["step"] = 200 * (np.sqrt(depth) - np.sqrt(0.5))
        write_run(self.path, history, summary)
        (self.path / ".lock").touch()
        (self.path / "grid_0.vtu").touch()
        frame = '<VTKFile><DataSet timestep="0" file="grid_0.vtu"/></VTKFile>'
        (self.path / "grid.pvd").write_text(frame, encoding="utf-8")
        run = Results(self.path)
        begin = (self.path / "grid_0.vtu").stat().st_mtime
        end = begin + 0.01 * float(history["step"][-1])
        os.utime(self.path / "history.csv", (end, end))
        expected = 0.01 * 200 * (np.sqrt(4.5) - np.sqrt(2.5)) * 1.125
        left = page_module.remaining_of(run, 0.5)
        self.assertAlmostEqual(left or 0, expected, delta=0.02)
        os.utime(self.path / ".lock", (begin + 5, begin + 5))  # after a restart
        self.assertIsNone(page_module.remaining_of(run, 0.5))


if __name__ == "__main__":
    unittest.main()
