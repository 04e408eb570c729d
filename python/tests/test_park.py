# SPDX-License-Identifier: LGPL-2.1-or-later
"""The overview of a park, and runs on the workers of Dask."""
import contextlib
import csv
import io
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
from synthetic import write_run
from test_log import END, SCENE, WEIGHT, history_of, AREA, BEST, DEPTH

from caisson import needed, runs
from caisson.commands import park, park_rows
from caisson.results import Results
from caisson.runner import Run, RunError
from caisson.runs import How, StudyRun, make
from caisson.verdict import outcome

FAKE_PROGRAM = Path(__file__).resolve().parent / "fake_program.py"


class WithRuns(unittest.TestCase):
    """Positions in a folder."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        (self.path / "a.prm").touch()

    def run_of(self, name: str) -> StudyRun:
        """Return the run of a position."""
        run = Run(
            self.path / "a.prm", {}, self.path / "runs" / name, program=FAKE_PROGRAM
        )
        settings = {"position": name, "estimate": "best"}
        return StudyRun("runs", name, run, settings, seconds=1.0)


class Overview(WithRuns):
    """Made-up results."""

    def write(self, name: str, boiling: float, force: np.ndarray = BEST) -> StudyRun:
        """Write the results of a position whose water boils at a suction (Pa)."""
        run = self.run_of(name)
        entries = {"Time/End penetration": f"{END:g}"}
        entries["Design/Steel yield strength"] = "1e12"  # water boils first
        entries["Design/Steel Youngs modulus"] = "1e13"
        summary: dict[str, Any] = {"title": name, "scene": SCENE, "entries": entries}
        write_run(run.run.directory, history_of(force, boiling), summary)
        record = {"key": "", "entries": {}, "status": 0, "wall_s": 1, "cpu_s": 1}
        (run.run.directory / Run.RECORD).write_text(json.dumps(record))
        (run.run.directory / "report.html").touch()
        return run

    def test_the_worst_first(self) -> None:
        """By utilization; a run without a result comes before all."""
        most = (BEST[-1] - WEIGHT) / AREA
        runs = [
            self.write("fair", 1.5 * most),
            self.write("good", 4 * most),
            self.write("refused", (BEST[200] - WEIGHT) / AREA),
            self.run_of("missing"),
        ]
        with contextlib.redirect_stdout(io.StringIO()) as said:
            status = park.evaluate("positions.csv", runs, self.path, 1.0)
        self.assertEqual(status, 1)
        self.assertIn("3 of 4 positions", said.getvalue())
        with (self.path / "overview.csv").open(encoding="utf-8") as file:
            rows = {row["position"]: row for row in csv.DictReader(file)}
        self.assertEqual(list(rows), ["missing", "refused", "fair", "good"])
        shares = [float(rows[x]["utilization"]) for x in ("refused", "fair", "good")]
        np.testing.assert_allclose(shares, [1, 1 / 1.5, 1 / 4], rtol=0.01)
        refused = float(rows["refused"]["feasible_to_m"])
        self.assertLess(refused, DEPTH[200])
        self.assertGreater(refused, DEPTH[200] - 0.1)
        self.assertEqual(rows["good"]["feasible_to_m"], "9")
        self.assertEqual(rows["good"]["governed_by"], "water boils")
        page = (self.path / "overview.html").read_text(encoding="utf-8")
        self.assertIn('<a href="runs/fair/report.html">fair</a>', page)
        self.assertIn("4 positions, 3 computed, 2 of them feasible\nwith", page)
        self.assertGreater((self.path / "overview.png").stat().st_size, 5000)

    def test_high_resistance(self) -> None:
        """A position that high resistance stops is not feasible, and comes before one
        with a larger share; its words are those of its page."""
        most = (BEST[-1] - WEIGHT) / AREA
        runs = [self.write("stiff", 1.5 * most), self.write("fair", 1.2 * most)]
        self.write("stiff_high", 1.5 * most, 2 * BEST - BEST[0])
        with contextlib.redirect_stdout(io.StringIO()) as said:
            park.evaluate("positions.csv", runs, self.path, 1.0)
        with (self.path / "overview.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["position"] for row in rows], ["stiff", "fair"])
        end = outcome.feasible_to(Results(self.path / "runs/stiff_high"))
        self.assertEqual(rows[0]["with_uncertainty_to_m"], f"{end:.4g}")
        self.assertEqual(rows[0]["feasible_to_m"], "9")
        page = (self.path / "overview.html").read_text(encoding="utf-8")
        self.assertIn("2 computed, 1 of them feasible\nwith their uncertainty", page)
        self.assertIn("With high resistance to", said.getvalue())

    def test_nothing_is_allowed(self) -> None:
        """As where the plug meets the lid: suction ends there, as at any other limit,
        and the picture is drawn."""
        run = self.write("shut", 1e9)
        part = mock.Mock(required=np.array([1, 2]), utilization=np.array([0.2, np.inf]))
        part.governing.return_value = "plug meets the lid"
        with mock.patch.object(park.verdict, "feasible_part", return_value=part):
            row = park.row_of(run, self.path)
        self.assertEqual((row.utilization, row.governed_by), (1, "plug meets the lid"))
        park.draw(self.path / "overview.png", [row])

    def test_damaged_results(self) -> None:
        """A position without history.csv, or whose numbers cannot be read, gets a row
        that says so, as the others do."""
        runs = [self.write(name, 1e9) for name in ("gone", "odd", "good")]
        (runs[0].run.directory / "history.csv").unlink()
        numbers = park.with_numbers

        def fail(row: park.Row, run: Results) -> park.Row:
            if row.position == "odd":
                raise ValueError("a number")
            return numbers(row, run)

        with (
            contextlib.redirect_stdout(io.StringIO()) as said,
            mock.patch.object(park, "with_numbers", fail),
        ):
            self.assertEqual(park.evaluate("p.csv", runs, self.path, 1.0), 1)
        path = runs[0].run.directory / "history.csv"
        self.assertIn(
            f"gone: No result (no result: there is no {path})", said.getvalue()
        )
        self.assertIn("odd: No result (ValueError: a number)", said.getvalue())
        self.assertIn("park: 1 of 3 positions", said.getvalue())

    def test_page_is_renewed(self) -> None:
        """After a change of the results, also of low resistance."""
        run = self.write("own", 1e9).run.directory
        for directory in (run, self.write("own_low", 1e9).run.directory):
            os.utime(run / "report.html")
            with mock.patch.object(park, "plot"), mock.patch(
                "caisson.report.write"
            ) as new:
                park.page_of(run)
                new.assert_not_called()
                later = (run / "report.html").stat().st_mtime + 1
                os.utime(directory / "history.csv", (later, later))
                park.page_of(run)
                new.assert_called_once_with(run)
            os.utime(directory / "history.csv", (1, 1))

    def test_heads(self) -> None:
        for head, found in {
            "wall (mm)": ("wall", "mm"),
            "Water depth_m": ("water-depth", "m"),
            "cone test": ("cpt", ""),
            "error_%": ("error", "%"),
            "Layers": ("layers", ""),
        }.items():
            self.assertEqual(park_rows.column_of(head), found)


class Dask(WithRuns):
    """Runs on its workers."""

    def test_without_it(self) -> None:
        with mock.patch.dict(sys.modules, {"distributed": None}):
            with self.assertRaisesRegex(RunError, "--dask: distributed missing: `"):
                make([self.run_of("a")], How(dask="tcp://127.0.0.1:1"))

    @unittest.skipUnless(needed.is_there("distributed"), "needs python3-distributed")
    def test_two_workers(self) -> None:
        """All runs are made, and no run twice; one that fails says why."""
        from distributed import LocalCluster

        found = [self.run_of(name) for name in "abcd"]
        found[-1].run.entries["Soil/Nothing"] = 1
        with (
            LocalCluster(
                n_workers=2,
                threads_per_worker=1,
                processes=False,
                protocol="tcp://",
                dashboard_address=None,
            ) as cluster,
            contextlib.redirect_stdout(io.StringIO()) as said,
        ):
            how = How(dask=cluster.scheduler_address)
            make(found, how)
            make(found[:3], how)
        self.assertIn("runs to do: 4, 2 at a time by Dask", said.getvalue())
        calls = (self.path / "runs/calls").read_text().split()
        self.assertEqual(sorted(calls), ["a", "b", "c"])
        self.assertTrue(all(run.run.is_complete() for run in found[:3]))
        self.assertIn("exit status 1, see", str(found[-1].trouble))

    @unittest.skipUnless(needed.is_there("distributed"), "needs python3-distributed")
    def test_nobody_answers(self) -> None:
        with (
            mock.patch.object(runs, "WAIT", 1),
            self.assertRaisesRegex(RunError, "no scheduler answers at tcp"),
        ):
            make([], How(dask="tcp://127.0.0.1:1"))


if __name__ == "__main__":
    unittest.main()
