# SPDX-License-Identifier: LGPL-2.1-or-later
"""The bar of a study: on a terminal only, and never within a line of a log file."""
import contextlib
import io
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

from caisson import progress
from caisson.progress import Progress
from caisson.runner import Run


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self) -> bool:
        """It is."""
        return True


class Bars(unittest.TestCase):
    """What is written where."""

    def setUp(self) -> None:
        interval = mock.patch("caisson.progress.INTERVAL", 0.01)
        interval.start()
        self.addCleanup(interval.stop)
        names = {"TERM": "xterm", "COLUMNS": "70"}
        environment = mock.patch.dict("os.environ", names)
        environment.start()
        self.addCleanup(environment.stop)

    def run_two(self, stream: io.StringIO) -> str:
        """Return the lines about two runs, whose bar goes to a stream."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            with Progress([1.0, 1.0], stream) as shown:
                for number in range(2):
                    shown.start(number)
                    time.sleep(0.1)
                    shown.end(number)
                    shown.say(f"run {number}: 1 s")
        return said.getvalue()

    def test_terminal(self) -> None:
        """The bar is cleared before each line and at the end."""
        stream = Terminal()
        self.assertEqual(self.run_two(stream), "run 0: 1 s\nrun 1: 1 s\n")
        bars = stream.getvalue().split("\r\x1b[K")
        self.assertIn("[............", bars[1])
        self.assertIn("1 of 2 runs, 50 %", stream.getvalue())
        self.assertEqual(bars[-1], "")

    def test_log_file(self) -> None:
        stream = io.StringIO()
        self.assertEqual(self.run_two(stream), "run 0: 1 s\nrun 1: 1 s\n")
        self.assertEqual(stream.getvalue(), "")
        with mock.patch.dict("os.environ", {"TERM": "dumb"}):
            self.run_two(terminal := Terminal())
        self.assertEqual(terminal.getvalue(), "")

    def test_lines_in_a_log_file(self) -> None:
        """Whole ones, after each twentieth of the work, by what runs say themselves."""
        told = iter([0.0, 0.02, 0.4, 0.41, 0.9])
        stream = io.StringIO()
        shown = Progress([1e3], stream, lambda _: share)
        shown.start(0)
        shown.begin -= 60.0
        with mock.patch("caisson.progress.SILENCE", 0.0):
            for share in told:
                shown._draw()
        self.assertRegex(
            stream.getvalue(),
            r"^0 of 1 runs, 40 %, about 9\d s|1.5 min left\n"
            r"0 of 1 runs, 90 %, about 6\.\d s left\n$",
        )
        self.assertEqual(len(stream.getvalue().splitlines()), 2)

    def test_share(self) -> None:
        """By durations; one that is not known counts as the mean of the others, and one
        that takes longer than expected is not done."""
        shown = Progress([30.0, 10.0, 0.0])
        shown.start(2)
        shown.begins[2] -= 1000.0
        self.assertAlmostEqual(shown.share, 0.95 * 20 / 60)
        self.assertEqual(shown.line(80), f"[{'#' * 7}{'.' * 17}] 0 of 3 runs, 32 %")
        self.assertEqual(len(shown.line(20)), 19)

    def test_time_left(self) -> None:
        """From the runs that have ended, which may take longer than expected."""
        shown = Progress([30.0, 10.0, 20.0])
        shown.begin -= 90.0
        shown.start(0)
        shown.begins[0] -= 60.0
        shown.end(0)
        shown.start(2)
        shown.begins[2] -= 30.0
        self.assertAlmostEqual(shown.scale, 2.0, places=2)
        self.assertAlmostEqual(shown.share, (30 + 15) / 60, places=2)
        self.assertRegex(shown.line(80), "] 1 of 3 runs, 75 %, about 30 s left$")

    def test_share_of_a_run(self) -> None:
        """By the time that it expects to need still, not by its depth."""
        with tempfile.TemporaryDirectory() as folder:
            run = Run(Path("a.prm"), directory=Path(folder))
            self.assertEqual(run.share_done(30.0), 0.0)
            line = "pen 1 m | total 8 kN |  12.0 % | ETA 00:01:30\n"
            (run.directory / "log").write_text(f"{line}a warning\n", encoding="utf-8")
            self.assertAlmostEqual(run.share_done(30.0), 0.25)

    def test_durations(self) -> None:
        words = [progress.duration(x) for x in (4.56, 600, 7200)]
        self.assertEqual(words, ["4.6 s", "10 min", "2 h"])


if __name__ == "__main__":
    unittest.main()
