# SPDX-License-Identifier: LGPL-2.1-or-later
"""How many ranks a run takes, and how the runs of a study share the cores."""
import argparse
import contextlib
import io
import os
import signal
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from caisson import ranks
from caisson.commands import run as launch
from caisson.paths import ROOT
from caisson.ranks import Size
from caisson.runner import RunError, environment, mpi_command, size_in

VALID = """jack.prm is valid
  grid       57 x 97 cells, axisymmetric
  points     36504 at the start, and about 73000 at the end by splitting
  duration   about 2.9 to 8.7 min on one core: by the speed of the first steps"""


class WithMpirun(unittest.TestCase):
    """A machine that can start ranks, whatever this one can."""

    def setUp(self) -> None:
        """Let there be an mpirun."""
        replaced = mock.patch.object(ranks, "can_start_ranks", return_value=True)
        self.mpirun = replaced.start()
        self.addCleanup(replaced.stop)


class Choice(WithMpirun):
    """What pays."""

    def chosen(self, points: int, cores: int) -> tuple[int, str]:
        """Return what is chosen on a machine with so many cores."""
        with mock.patch.object(ranks, "cores", return_value=cores):
            return ranks.choose(points)

    def test_ranks_of_a_run(self) -> None:
        for points, cores, n in [
            (640, 2, 1),
            (4_999, 2, 1),
            (5_000, 2, 2),
            (36_504, 2, 2),
            (36_504, 64, 14),
            (36_504, 1, 1),
        ]:
            self.assertEqual(self.chosen(points, cores)[0], n, (points, cores))

    def test_a_rank_pays(self) -> None:
        """As many ranks as are chosen are faster than fewer."""
        for points in (5_000, 36_504, 1_000_000):
            n = ranks.ranks_for(points, 64)
            for fewer in range(1, n):
                self.assertLess(
                    ranks.speed_up(points, fewer), ranks.speed_up(points, n)
                )

    def test_without_mpirun(self) -> None:
        self.mpirun.return_value = False
        n, why = self.chosen(36_504, 2)
        self.assertEqual(n, 1)
        self.assertIn("mpirun is missing", why)

    def test_processors_of_one_core(self) -> None:
        """Two threads of a core are one core; a container may allow less."""
        with tempfile.TemporaryDirectory() as folder:
            for number in range(4):
                place = Path(folder, f"cpu{number}/topology")
                place.mkdir(parents=True)
                (place / "physical_package_id").write_text("0\n")
                (place / "core_id").write_text(f"{number // 2}\n")
            limit = Path(folder, "cpu.max")
            with mock.patch.object(ranks, "CPUS", Path(folder)), mock.patch.object(
                ranks, "QUOTA", limit
            ), mock.patch("os.sched_getaffinity", return_value={0, 1, 2, 3, 9}):
                self.assertEqual(ranks.physical_cores({0, 1}), 1)
                self.assertEqual(ranks.physical_cores({0, 1, 2}), 2)
                self.assertEqual(ranks.cores(), 3)  # nothing is known of the last
                for text, n in ("max 100000", 3), ("150000 100000", 1):
                    limit.write_text(text)
                    self.assertEqual(ranks.cores(), n)

    def test_size(self) -> None:
        self.assertEqual(size_in(VALID), Size(36504, 522, 174))
        self.assertEqual(size_in("subsection Grid"), Size())

    def test_ranks_that_wait_let_others_compute(self) -> None:
        self.assertIn("mpi_yield_when_idle", mpi_command(2))
        self.assertEqual(mpi_command(1), [])


class Sharing(WithMpirun):
    """Runs of a study."""

    def plan(self, durations: list[float], cores: int, points: int = 40_000) -> str:
        """Return the plan in words."""
        return str(ranks.plan([Size(points, s) for s in durations], cores))

    def test_network(self) -> None:
        """On one host ranks do without TCP; in a job of a batch system, which may have
        several, and where the user has chosen, they do not."""
        for known, expected in (
            ({}, "^tcp,ofi,openib"),
            ({"SLURM_JOB_ID": "1"}, None),
            ({"OMPI_MCA_btl": "self,vader"}, "self,vader"),
        ):
            with mock.patch.dict("os.environ", known, clear=True):
                self.assertEqual(environment().get("OMPI_MCA_btl"), expected)

    def test_plans(self) -> None:
        alone = "2 at a time on one rank each"
        last = "1 at a time on 2 ranks each"
        self.assertEqual(self.plan([9], 2), last)
        self.assertEqual(self.plan([9, 9], 2), alone)
        self.assertEqual(self.plan([9] * 5, 2), f"4 of them {alone}, then {last}")
        self.assertEqual(self.plan([9] * 5, 2, points=900), alone)
        self.assertEqual(self.plan([9, 1], 2), last)  # the long one would be alone
        self.assertEqual(
            self.plan([9] * 3, 8, points=10_000), "4 at a time on 2 ranks each"
        )
        self.assertEqual(self.plan([0, 0, 0], 2), alone)  # nothing is known
        self.mpirun.return_value = False
        self.assertEqual(self.plan([9], 2), alone)

    def test_time(self) -> None:
        """Side by side, the last of five runs waits for its turn."""
        found = ranks.plan([Size(900, 9.0)] * 5, 2)
        self.assertEqual(found.seconds, 27)
        found = ranks.plan([Size(40_000, 9.0)] * 5, 2)
        self.assertAlmostEqual(found.seconds, 18 + 9 / ranks.speed_up(40_000, 2))


# a program on ranks that ends in order where the file is made, within a second
RANKS = """#!/usr/bin/env python3
import pathlib, sys, time
stop = pathlib.Path(sys.argv[1])
print("begun", flush=True)
for _ in range(600):
    if stop.exists():
        stop.unlink()
        sys.exit(3)
    time.sleep(.1)
"""
STOPPED = """
import sys
from pathlib import Path
from caisson.commands.run import run_on_ranks
sys.exit(run_on_ranks(sys.argv[1:3], Path(sys.argv[2])))
"""


class Launch(unittest.TestCase):
    """caisson run."""

    def choose(self, answer: str, *arguments: str) -> tuple[int, str]:
        """Return what is chosen where the program answers so, and what is said."""
        said = io.StringIO()
        with mock.patch.object(launch, "query", return_value=answer), mock.patch.object(
            ranks, "cores", return_value=2
        ), mock.patch.object(ranks, "can_start_ranks", return_value=True):
            with contextlib.redirect_stderr(said):
                return launch.choose_ranks(["jack.prm", *arguments]), said.getvalue()

    def test_ranks_are_said(self) -> None:
        """In one line, and only where there is a run."""
        n, said = self.choose(VALID)
        self.assertEqual(n, 2)
        self.assertRegex(
            said, r"^run: 2 ranks \(36504 points, 2 cores; .*--ranks N.*\n$"
        )
        self.assertEqual(self.choose(VALID, "--restart")[0], 2)
        self.assertEqual(self.choose(VALID, "--validate"), (1, ""))
        self.assertEqual(self.choose("subsection Grid"), (1, ""))

    def test_ranks_that_would_hang(self) -> None:
        """Four for each core at most, by the command and the function."""
        for n in (-1, 0, 1.5, 4 * (os.cpu_count() or 1) + 1):
            with self.assertRaisesRegex(RunError, "whole number from 1 to"):
                mpi_command(n)  # type: ignore[arg-type]
        words = ["--ranks", "999", "jack.prm"]
        options = argparse.Namespace(
            ranks=None, band=False, error=None, arguments=words
        )
        with self.assertRaisesRegex(RunError, "not 999"):
            launch.main(options)

    def test_ctrl_c_stops_in_order(self) -> None:
        """The first signal makes the file that stops the ranks, whose status counts;
        mpirun would end them a few seconds after it got the signal."""
        with tempfile.TemporaryDirectory() as folder:
            program, stop = Path(folder, "ranks"), Path(folder, "stop")
            program.write_text(RANKS)
            program.chmod(program.stat().st_mode | stat.S_IXUSR)
            for number in (signal.SIGINT, signal.SIGTERM):
                process = subprocess.Popen(
                    [sys.executable, "-c", STOPPED, str(program), str(stop)],
                    cwd=ROOT / "python",
                    stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL,
                    text=True,
                )
                assert process.stdout is not None
                self.assertEqual(process.stdout.readline(), "begun\n")
                process.send_signal(number)
                self.assertEqual(process.wait(60), 3)
                process.stdout.close()
                self.assertFalse(stop.exists())


if __name__ == "__main__":
    unittest.main()
