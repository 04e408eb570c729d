# SPDX-License-Identifier: LGPL-2.1-or-later
"""The picture and the file that compare runs."""
import contextlib
import csv
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np
from synthetic import write_run
from test_report import SCENE, SUMMARY, WithPage, leave_run

from caisson import __main__ as program
from caisson.plot import comparison


def synthetic(directory: Path, depths: list[float]) -> Path:
    """Write a history in which the force follows the depth, without water."""
    directory.mkdir()
    rows = [f"{i},{depth},{1e6 * depth}" for i, depth in enumerate(depths)]
    text = "\n".join(["time_s,penetration_m,total_force_N", *rows]) + "\n"
    (directory / "history.csv").write_text(text, encoding="utf-8")
    return directory


class Comparison(unittest.TestCase):
    """What pushes the body, and the picture."""

    def test_water_pushes_too(self) -> None:
        """What suction does on the lid need not be pushed; what it takes from the
        pressure at the tip, neither."""
        history = {
            "total_force_N": np.array([100.0, -50.0]),
            "suction_force_N": np.array([30.0, 30.0]),
            "tip_water_force_N": np.array([-5.0, -5.0]),
        }
        self.assertEqual(list(comparison.pushing_force(history)), [65, -85])

    def test_panels(self) -> None:
        """The required suction where it draws a caisson in, and the resistance; the
        weight that pushes it is no curve."""
        depth = np.array([0.5, 1.0, 1.5])
        jacked = {"penetration_m": depth, "total_force_N": 1e6 * depth}
        suction = {
            **jacked,
            "required_suction_Pa": np.array([-1e4, 0.0, 1e4]),
            "suction_force_N": np.array([0.0, 0.0, 2e5]),
            "tip_water_force_N": np.zeros(3),
        }
        panels = comparison.panels_of({"jacked": jacked, "drawn": suction})
        required, forces = panels.values()
        self.assertEqual(list(panels)[0], "required suction (kPa)")
        self.assertEqual(list(required["drawn"]), [0, 0, 10])
        self.assertNotIn("jacked", required)
        self.assertEqual(list(forces["drawn"]), [500, 1000, 1500])
        self.assertEqual(len(comparison.panels_of({"jacked": jacked})), 1)


class Files(unittest.TestCase):
    """What the command leaves of made-up runs."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)

    def test_picture_without_a_name(self) -> None:
        """It stands beside the runs, as said; other runs have another one, and what a
        user has changed stays."""
        runs = [synthetic(self.path / name, [0, 1, 2]) for name in ("a", "b", "c")]
        for pair in (runs[:2], runs[1:], runs[:2]):
            with contextlib.redirect_stdout(io.StringIO()) as said:
                self.assertEqual(program.main(["compare", *map(str, pair)]), 0)
            for line in said.getvalue().splitlines():
                self.assertTrue(Path(line.removeprefix("compare: ")).is_file(), line)
            where = Path(line.removeprefix("compare: ")).resolve().parent
            self.assertEqual(where, self.path.resolve())
        (self.path / "comparison_a_b.csv").write_text("mine")
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(program.main(["compare", *map(str, runs[:2])]), 1)
        self.assertIn("comparison_a_b.csv exists", said.getvalue())

    def compare(self, *words: object, interval: float = 0.1) -> int:
        """Run the command; a picture is given, so that none is left elsewhere."""
        picture = str(self.path / "both.png")
        given = ["--interval", str(interval), picture, *map(str, words)]
        with contextlib.redirect_stdout(io.StringIO()):
            return program.main(["compare", *given])

    def columns(self) -> dict[str, list[str]]:
        """Return the columns of the file as they stand there."""
        with open(self.path / "both.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
        return {name: list(cells) for name, *cells in zip(*rows)}

    def test_common_depths(self) -> None:
        """A force of 1 MN per meter, empty where a run has not been; the columns of
        a quantity beside each other."""
        deep = synthetic(self.path / "deep", [0.3, 0.5, 1.05, 2.3])
        flat = synthetic(self.path / "flat", [0.7, 0.75, 1.25])
        self.assertEqual(self.compare(deep, flat, interval=0.5), 0)
        self.assertGreater((self.path / "both.png").stat().st_size, 1000)
        columns = self.columns()
        names = ["penetration_m", "total_force_N [deep]", "total_force_N [flat]"]
        self.assertEqual(list(columns), names)
        self.assertEqual(columns[names[0]], ["0.5", "1", "1.5", "2"])
        self.assertEqual(columns[names[1]], ["500000", "1e+06", "1.5e+06", "2e+06"])
        self.assertEqual(columns[names[2]], ["", "1e+06", "", ""])

    def test_down_and_up(self) -> None:
        """A pull-out has columns of its own; the mean does not mix both ways."""
        depths = [0.0, 1.0, 2.0, 3.0, 2.0, 1.0]
        rows = {
            "time_s": np.arange(6.0),
            "penetration_m": np.array(depths),
            "total_force_N": np.array([0, 1, 2, 3, -4, -5.0]),
            "lid_force_N": np.zeros(6),
        }
        write_run(self.path / "pull", rows, None)
        self.assertEqual(self.compare(self.path / "pull", interval=1), 0)
        columns = self.columns()
        down, up = columns["total_force_N [pull]"], columns["total_force_N [pull up]"]
        self.assertEqual(down, ["", "1", "2", "3"])
        self.assertEqual(up, ["", "-5", "-4", ""])
        self.assertEqual(len(columns), 3, "a force that is 0 throughout")

    def test_suction_and_names(self) -> None:
        """Runs of the same name are distinguished; the suction is there for that run
        which has one."""
        depth = np.linspace(0, 1, 11)
        table = {"time_s": depth, "penetration_m": depth, "total_force_N": 5 + depth}
        write_run(self.path / "a/run", table, None)
        table |= {name: 0 * depth for name in ("tip_water_force_N", "suction_force_N")}
        table["required_suction_Pa"] = 100 * depth
        write_run(self.path / "b/run", table, None)
        self.assertEqual(self.compare(self.path / "a/run", self.path / "b/run"), 0)
        columns = self.columns()
        self.assertNotIn("required_suction_Pa [a/run]", columns)
        suction = columns["required_suction_Pa [b/run]"]
        self.assertEqual([suction[1], suction[5], suction[10]], ["10", "50", "100"])
        self.assertEqual(columns["pushing_force_N [b/run]"][1], "5.1")

    def test_refused(self) -> None:
        still = synthetic(self.path / "still", [1, 1])
        short = synthetic(self.path / "short", [1.01, 1.02])
        cases: list[tuple[list[Path], str]] = [
            ([still], "still does not move"),
            ([short], "no run passes a multiple of 0.1 m"),
            ([short, short], "given twice"),
            ([], "give the output directory"),
            ([self.path / "none"], "no history.csv"),
        ]
        for words, text in cases:
            said = io.StringIO()
            with contextlib.redirect_stderr(said):
                self.assertEqual(self.compare(*words), 1)
            self.assertIn(text, said.getvalue())
        with self.assertRaises(SystemExit):
            with contextlib.redirect_stderr(io.StringIO()):
                self.compare(short, interval=0)


class Differences(WithPage):
    """`caisson compare` of two runs."""

    def compare(self, *directories: Path) -> str:
        """Return what it prints."""
        with contextlib.redirect_stdout(io.StringIO()) as said:
            words = ["compare", "--overwrite", *map(str, directories)]
            self.assertEqual(program.main(words), 0)
        return said.getvalue()

    def test_two_runs(self) -> None:
        """An entry that differs, with its unit, and the verdict that follows; the files
        are written as ever."""
        one, other = self.path / "one", self.path / "other"
        units = {"Rigid body/Submerged weight": "N"}
        summary = {**SUMMARY, "units": units, "title": "mine"}
        for path, weight in ((one, "1e6"), (other, "2e6")):
            entries = {
                "Rigid body/Submerged weight": weight,
                "Output/Directory": weight,
            }
            scene = {**SCENE, "submerged_weight_N": float(weight)}
            leave_run(path, {**summary, "entries": entries, "scene": scene})
        said = self.compare(one, other)
        self.assertIn("scene: differs in\n  Rigid body/Submerged weight\n", said)
        self.assertIn(
            "\n    1 MN\n    2 MN\nverdict, cards and limits: differs in\n  verdict\n",
            said,
        )
        self.assertIn("    Feasible to 4.5 m by weight 2 MN", said)
        self.assertNotIn("Output", said)
        for path, pump in ((one, "40e3"), (other, "50e3")):
            entries = {"Water/Largest suction": pump}
            leave_run(path, {**summary, "entries": entries})
        said = self.compare(one, other)
        self.assertIn("  pump, at 4.5 m\n    40 kPa\n    50 kPa", said)
        self.assertNotIn("Pump", said)
        leave_run(one, {**summary, "entries": {"Water/Largest suction": "15e3"}})
        said = self.compare(one, other)
        self.assertRegex(said, r"pump, at 3 m\n    15 kPa\n    50 kPa")
        self.assertNotIn("none\n", said.partition("verdict, cards")[2])
        self.assertTrue((self.path / "comparison_one_other.png").is_file())

    def test_the_same(self) -> None:
        one, other = self.path / "one", self.path / "other"
        for path in (one, other):
            leave_run(path, SUMMARY)
        self.assertIn(
            "scene: the same\nverdict, cards and limits: the same\n",
            self.compare(one, other),
        )
        third = self.path / "third"
        leave_run(third, SUMMARY)
        self.assertNotIn("scene", self.compare(one, other, third))


if __name__ == "__main__":
    unittest.main()
