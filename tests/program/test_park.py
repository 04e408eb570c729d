# SPDX-License-Identifier: LGPL-2.1-or-later
"""caisson park: rows, runs that are killed and resumed, and the overview. The scenes
are those of the program; the runs are made by the stand-in of python/tests."""
import contextlib
import csv
import os
import signal
import subprocess
import tempfile
import time
import unittest
from collections.abc import Iterator
from pathlib import Path
from unittest import mock

from program import HERE
from test_user_commands import CommandTest

FAKE_PROGRAM = HERE.parent / "python/tests/fake_program.py"
HEADS = "name,diameter_m,skirt_m,wall_mm,weight_kN,water_depth_m,layers"
ROW = '{},4,2,40,60,30,"0: su = {} kPa"'
WAIT = 300  # s, at most, for what takes seconds


class Park(CommandTest):
    """A table of positions."""

    def setUp(self) -> None:
        super().setUp()
        # the page before a run, which test_suggest.py looks at
        page = mock.patch("caisson.suggest.by_hand", return_value="")
        self.enterContext(page)
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        self.table = self.path / "positions.csv"
        self.out = self.path / "out"

    def write(self, *rows: str) -> None:
        """Write the table."""
        self.table.write_text("\n".join([HEADS, *rows]) + "\n", encoding="utf-8")

    def words_of(self, *options: str) -> list[str]:
        """Return the words of a call with the stand-in."""
        words = ["park", str(self.table), "--error", "20", "--out", str(self.out)]
        return [*words, "--program", str(FAKE_PROGRAM), *options]

    def calls(self) -> list[str]:
        """Return the runs that were begun, in the order of their names."""
        path = self.out / "runs/calls"
        return sorted(path.read_text().split()) if path.exists() else []

    def overview(self) -> dict[str, dict[str, str]]:
        """Return the rows of overview.csv by position."""
        with (self.out / "overview.csv").open(encoding="utf-8") as file:
            return {row["position"]: row for row in csv.DictReader(file)}

    def is_done(self, name: str) -> bool:
        """Return whether a run has left its record."""
        return (self.out / "runs" / name / "run_key.json").is_file()

    @contextlib.contextmanager
    def begun(self, done: list[str]) -> Iterator["subprocess.Popen[str]"]:
        """Start the park, and wait until it has done some runs and makes P2, which does
        not end by itself."""
        self.caisson(*self.words_of("--check"))  # here, where no page is written
        with subprocess.Popen(
            self.words(*self.words_of("--jobs", "2")),
            env={**self.environment(), "FAKE_PROGRAM_HOLDS": "P2"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        ) as process:
            end = time.monotonic() + WAIT
            while not ("P2" in self.calls() and all(map(self.is_done, done))):
                self.assertIsNone(process.poll(), "it ended before it was stopped")
                self.assertLess(time.monotonic(), end)
                time.sleep(0.05)
            yield process

    def test_a_signal_stops_what_runs(self) -> None:
        """What runs ends with a checkpoint, and nothing further begins."""
        self.write(*(ROW.format(name, 20) for name in ("P1", "P2")))
        with self.begun(["P1"]) as process:
            process.send_signal(signal.SIGTERM)
            said = process.communicate(timeout=WAIT)[0]
        self.assertEqual(process.returncode, 1, said)
        self.assertIn("P2: stopped", said)
        self.assertIn("interrupted; what is finished is kept", said)
        self.assertTrue((self.out / "runs/P2/checkpoint.info").is_file())
        self.assertFalse((self.out / "runs/P2/stop").exists(), "nobody has seen it")

    def test_a_kill_loses_no_run(self) -> None:
        """What has ended stays as it is, and what was begun goes on from its
        checkpoint; a row that is changed or added then takes a run, and no other one
        does."""
        names = ["P1", "P2", "P3"]
        self.write(*(ROW.format(name, 20) for name in names))
        others = ["P1", "P3"]
        with self.begun(others) as process:
            os.killpg(process.pid, signal.SIGKILL)
        self.assertFalse((self.out / "overview.csv").exists())
        before = {x: self.record(x).stat().st_mtime_ns for x in others}
        said, _ = self.caisson(*self.words_of())
        self.assertIn("of which new or changed: 0", said)
        self.assertIn("3 of 3 positions", said)
        self.assertIn("P2: goes on from its checkpoint", said)
        self.assertEqual(self.calls(), sorted([*names, "P2+"]))
        after = {x: self.record(x).stat().st_mtime_ns for x in others}
        self.assertEqual(after, before)
        self.assertEqual(sorted(self.overview()), names)
        for row in self.overview().values():
            self.assertTrue((self.out / row["page"]).is_file())
            self.assertTrue((self.out / row["page"]).with_name("forces.png").is_file())
        self.write(*(ROW.format(name, 20) for name in [*names, "P/4"]))
        said, _ = self.caisson(*self.words_of())
        self.assertIn("positions: 4, of which new or changed: 1", said)
        self.assertEqual(self.calls(), sorted([*names, "P2+", "P_4"]))
        self.assertIn("P/4", self.overview())

    def record(self, name: str) -> Path:
        """Return the record of a run."""
        return self.out / "runs" / name / "run_key.json"

    @mock.patch("caisson.plot.draw")  # which another test looks at
    def test_parts(self, drawn: mock.Mock) -> None:
        """Each job of an array makes its runs; the overview names what is missing, and
        what a row that has changed since does not stand for."""
        self.write(*(ROW.format(name, 20) for name in ("A", "B")))
        self.caisson(*self.words_of("--part", "1/2"))
        self.assertEqual(len(self.calls()), 1)
        missing = ({"A", "B"} - set(self.calls())).pop()
        self.caisson(*self.words_of("--evaluate"), status=1)
        rows = self.overview()
        self.assertEqual(next(iter(rows)), missing, "it comes first")
        self.assertIn("No result (not run)", rows[missing]["verdict"])
        self.caisson(*self.words_of("--part", "2/2"))
        self.caisson(*self.words_of("--evaluate"))
        self.assertEqual(self.calls(), ["A", "B"])
        text = '{"entries": {"Soil/Stiffness": "4e6"}}'  # of the row before a change
        self.record("A").with_name("run.json").write_text(text, encoding="utf-8")
        self.caisson(*self.words_of("--evaluate"), status=1)
        self.assertIn("out of date", self.overview()["A"]["verdict"])

    def test_rows_that_are_wrong(self) -> None:
        """Each is named in a line, with its column, and nothing is written or run."""
        self.write(
            ROW.format("A", 20),
            'B,4,2,4000,60,30,"0: su = 20 kPa"',
            'C,4,,40,60,30,"0: su = 20 kPa"',
            'D,4,2,40,60 t,30,"0: su = 20 kPa"',
            'E,4,2,40,60,30,"0: sux = 20 kPa"',
            'F,4,2,40,60,30,"1: su = 20 kPa"',
            "G,4,2,40,60,30,",
        )
        _, said = self.caisson(*self.words_of(), status=1)
        lines = said.splitlines()
        self.assertEqual(len(lines), 6, said)
        for line, text in zip(
            lines,
            (
                "row 3, column wall: 4 m is more than a tenth of the diameter",
                "row 4, column skirt: fill in skirt",
                "row 5, column weight: '60 t': 't' is no unit of it; known: N, kN",
                "row 6, column layers: a layer of Mohr-Coulomb has no entry 'sux'",
                "row 7, column layers: the first layer must begin at 0",
                "row 8, column layers: give the soil",
            ),
        ):
            self.assertIn(text, line)
        self.assertEqual(list((self.out / "scenes").iterdir()), [])
        self.assertEqual(self.calls(), [])
        self.write(ROW.format("A", 20), ROW.format("A", 30), ROW.format("", 30))
        _, said = self.caisson(*self.words_of(), status=1)
        self.assertIn("row 3, column name: 'A' has the results of row 2, too", said)
        self.assertIn("row 4, column name: it is empty", said)

    def test_tables_that_are_wrong(self) -> None:
        for text, why in (
            (
                "name,diamter_m\nA,4",
                "a column diamter and it is not known; the columns",
            ),
            ("diameter_m\n4", "there is no column name"),
            ("name,skirt_m,skirt\nA,4,4", "a column skirt twice"),
            ("name", "has no position below its heads, such as name,diameter_m"),
        ):
            self.table.write_text(text, encoding="utf-8")
            _, said = self.caisson(*self.words_of(), status=1)
            self.assertIn(why, said)

    def test_scenes(self) -> None:
        """They have the name of the position, and the units of the heads; the error is
        that of the call before where none is given."""
        self.write(ROW.format("North 1", 20))
        self.caisson(*self.words_of("--check"))
        text = (self.out / "scenes/North_1.prm").read_text(encoding="utf-8")
        self.assertIn(
            "set Title = North 1, a caisson of 4 m with a wall of 40 mm", text
        )
        self.assertRegex(text, r"Submerged weight += 60000")
        words = self.words_of("--check")
        words.remove("--error")
        words.remove("20")  # as last time
        said, _ = self.caisson(*words)
        self.assertIn("positions: 1, of which new or changed: 0", said)
        for damage in ("[]", "null", "3", '{"North 1": 3}', "{"):
            (self.out / "positions.json").write_text(damage, encoding="utf-8")
            said, _ = self.caisson(*self.words_of("--check"))
            self.assertIn("positions: 1, of which new or changed: 1", said)
        self.assertEqual(self.calls(), [])

    @mock.patch("caisson.plot.draw")  # which another test looks at
    def test_band(self, drawn: mock.Mock) -> None:
        """A row with a spread has three runs, and stands in the overview once."""
        row = ROW.format("A", 20)
        text = f"{HEADS},spread\n{row},su 15%\n{ROW.format('B', 20)},\n"
        self.table.write_text(text, encoding="utf-8")
        said, _ = self.caisson(*self.words_of())
        self.assertRegex(said, r"A: about \d.* on one core for each of 3, 0 warnings:")
        self.assertRegex(said, r"B: about \d.* on one core, 0 warnings:")
        self.assertEqual(self.calls(), ["A", "A_high", "A_low", "B"])
        self.assertEqual(sorted(self.overview()), ["A", "B"])
        self.table.write_text(f"{HEADS}\n{row}\n", encoding="utf-8")
        said, _ = self.caisson(*self.words_of())
        self.assertIn("1 of 1 positions", said)
        self.assertEqual(
            [path.name for path in (self.out / "scenes").glob("A*.prm")], ["A.prm"]
        )


if __name__ == "__main__":
    unittest.main()
