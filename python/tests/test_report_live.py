# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.html of made-up runs that have not ended."""
import fcntl
import time
import unittest
from unittest import mock

import numpy as np
from test_report import SUMMARY, WithPage, leave_run

import caisson.report as report
from caisson.commands import run as launch


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


if __name__ == "__main__":
    unittest.main()
