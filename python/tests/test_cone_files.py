# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of cone tests: those of others, and what commands do with them."""
import contextlib
import io
import unittest
from collections.abc import Callable
from pathlib import Path

import numpy as np

from caisson import __main__ as program
from caisson.design import cone, cone_file, interpretation
from caisson.design.cone_options import How
from made_up_cone import AGS, GEF, WithFiles, options

Rows = list[list[float]]


class OfOthers(WithFiles):
    """Features that decide whether files of others are read, each made anew here: GEF
    of pygef, GEOLib-Plus and groundhog, AGS 4 of a wind farm, tables of liquepy,
    groundhog and others."""

    def sounding(self, name: str, change: Callable[[Rows], object]) -> str:
        """Return a GEF file with columns of a register, and changed rows of length, q_c
        (MPa), depth and f_s (MPa)."""
        unit, stress = ("m (meter)", "MPa (megaPascal)")
        if "plain" in name:
            unit, stress = "m", "MPa"
        rows = [[0.02 + z / 50, 1 + z / 50, 0.02 + z / 50, 0.012] for z in range(120)]
        change(rows)
        heads = "#GEFID= 1, 1, 0\n#COLUMN= 4\n" + "".join(
            f"#COLUMNINFO= {i}, {u}, {text}, {number}\n"
            for i, (u, text, number) in enumerate(
                (
                    (unit, "sondeertrajectlengte", 1),
                    (stress, "conusweerstand", 2),
                    (unit, "diepte", 11 if "length" not in name else 12),
                    (stress, "plaatselijke wrijving", 3),
                ),
                1,
            )
        )
        hole = "#MEASUREMENTVAR= 13, 1.10, m (meter), voorgeboord tot\n"
        heads += hole if "hole" in name else ""
        table = "".join(" ".join(f"{x:g}" for x in row) + "\n" for row in rows)
        return f"{heads}#COLUMNVOID= 4, -99999\n#EOH=\n{table}"

    def test_gef(self) -> None:
        """All of them, with the rows that count."""

        def each(i: int, value: Callable[[float], float]) -> Callable[[Rows], object]:
            def change(rows: Rows) -> None:
                for row in rows:
                    row[i] = value(row[0])

            return change

        def first(*values: float) -> Callable[[Rows], object]:
            return lambda rows: rows.insert(0, [0.0, values[0], 0.0, values[1]])

        def below(start: float, friction: float) -> Callable[[Rows], object]:
            def change(rows: Rows) -> None:
                rows[:] = [row for row in rows if row[0] > start]
                for row in rows[5:11]:
                    row[3] = friction

            return change

        for name, change, begin in (
            ("units of the register", lambda rows: None, 0.02),
            ("with a hole", lambda rows: None, 1.1),
            ("a hole, and no rows in it", below(1.19, 0.012), 1.2),
            ("no hole, and no rows above", below(2.09, 0.012), 2.1),
            ("plain length, negative", each(0, lambda z: -z), 0.02),
            ("corrected, negative", each(2, lambda z: -z), 0.02),
            ("first row without load", first(0, 0.002), 0.02),
            ("first row void", first(-9999, -9999), 0.02),
            ("friction below 0 and a hole", below(1.69, -0.011), 1.7),
            ("void friction", each(3, lambda z: -99999 if z < 1.05 else 0.01), 0.02),
        ):
            with self.subTest(name=name):
                test = self.read(self.sounding(name, change))
                assert test.friction is not None
                self.assertTrue(np.isfinite(test.friction).all())
                measured = test.depth[test.depth >= test.measured_from - 1e-9]
                self.assertAlmostEqual(measured[0], begin)
                self.assertAlmostEqual(float(test.depth[-1]), 2.4)
        mechanical = self.sounding("", each(3, lambda z: -99999))
        self.assertIsNone(self.read(mechanical).friction)
        status, said = Command.call_on(self.path)
        self.assertEqual(status, 1)
        self.assertIn("no sleeve friction (fs_kPa)", said)
        words = "--soil", "sand", "--unit-weight", "19"
        self.assertEqual(Command.call_on(self.path, *words)[0], 0)

    def test_ags(self) -> None:
        """A test at the seabed, one push from 3 m, and 19 of them down a borehole."""
        lines = AGS.splitlines()[:10]
        row = '"DATA","W","{}","{:.2f}","{}","100","9"'
        pushes = [
            row.format(i, 1.6 * i + z / 20, 9) for i in range(19) for z in range(30)
        ]
        for rows, begin in ((pushes[:30], 0), (pushes[60:90], 3.2), (pushes, 0)):
            test = self.read("\n".join([*lines, *rows, ""]))
            self.assertEqual(test.measured_from, begin)
            self.assertAlmostEqual(test.depth[-1], float(rows[-1].split('"')[7]))
        self.assertEqual(len(test.depth), 570)
        self.assertIn("19 pushes were joined, gaps at 1.45 to 1.6 m", str(test.remarks))

    def test_tables(self) -> None:
        """As they come, or with the columns that the message asks for."""
        above = "CPT data;;;\nOperator:;X;;\nAssumed GWL:;2;;\naratio;0,8;;\n"
        head = "Depth (m);qc (MPa);fs (MPa);u2 (MPa)\n"
        rows = [f"{z / 50:g};{1 + z / 50:g};0.012;0.001\n" for z in range(120)]
        table = "".join(rows)
        no_load = "0;0.002;0.005;0\n0.02;0.5;-0.001;-0.08\n" + "".join(rows[2:])
        for name, text, columns in (
            ("lines above", above + head + table, ""),
            ("a hole", above + "Pre-Drill:;1.2;;\n" + head + "".join(rows[63:]), ""),
            ("Dutch", "Diepte[m];Conuswaarden[MN/m2];;\n" + table, ""),
            ("no heads", table.replace(";", "\t"), "depth,qc,fs (MPa),u2 (MPa)"),
            ("no load, a drift", head + no_load, ""),
        ):
            with self.subTest(name=name):
                test = self.read(text, columns=columns)
                self.assertAlmostEqual(float(test.depth[-1]), 2.38)
                self.assertAlmostEqual(float(test.resistance[-1]), 3.38e6)


class Command(WithFiles):
    """caisson cpt, and what is kept with a run."""

    @staticmethod
    def call_on(path: Path, *words: str) -> tuple[int, str]:
        """Return status and words of `caisson cpt`."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            out = str(path.parent / "out")
            status = program.main(["cpt", str(path), "--out", out, *words])
        return status, said.getvalue()

    def call(self, *words: str) -> tuple[int, str]:
        """Return the same of the file."""
        return self.call_on(self.path, *words)

    @staticmethod
    def say(*words: str) -> tuple[int, str]:
        """Return status and words of another command of `caisson`."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            status = program.main(list(words))
        return status, said.getvalue()

    def deep(self) -> str:
        """Return AGS of two tests with enough rows for layers."""
        rows = [
            f'"DATA","{name}","1","{z / 20:.2f}","{q * (1 + z / 20):.3f}","30","0"'
            for name, q in (("CPT01", 5), ("CPT02", 9))
            for z in range(1, 90)
        ]
        return "\n".join([*AGS.splitlines()[:10], *rows, ""])

    def test_location(self) -> None:
        self.path.write_text(self.deep(), encoding="utf-8")
        status, said = self.call()
        self.assertEqual(status, 1)
        self.assertIn("choose one by --location", said)
        status, said = self.call("--location", "CPT02")
        self.assertEqual(status, 0, said)
        self.assertIn("to 4.45 | sand", said)
        self.path.write_text(GEF, encoding="utf-8")
        status, said = self.call("--location", "CPT02")
        self.assertIn("--location is for AGS 4", said)

    def test_area_ratio(self) -> None:
        """That of the file counts, and is said, where none is given."""
        group = '"GROUP","SCPG"\n"HEADING","LOCA_ID","SCPG_CAR"\n"DATA","CPT02","{}"\n'
        for text, words in (("0.6", "0.6, from the file"), ("59", "59, is not")):
            self.written(group.format(text) + self.deep())
            for given, number in ((list[str](), 1), (["--area-ratio", "0.7"], 0)):
                told = options("--location", "CPT02", *given)
                remarks = interpretation.interpret(self.path, told).test.remarks
                said = [r for r in remarks if "net area ratio of the cone:" in r]
                self.assertEqual(len(said), number)
                self.assertIn(words if number else "", "".join(said))
        for text, ratio in (("0.6", 0.6), ("59", 0.8)):
            self.path.write_text(group.format(text) + self.deep(), encoding="utf-8")
            test = cone_file.read(self.path, how=How("CPT02"))
            self.assertEqual(interpretation.area_ratio_of(test, None)[0], ratio)
            self.assertEqual(interpretation.area_ratio_of(test, 0.7), (0.7, ()))

    def test_location_of_pictures(self) -> None:
        """Pictures and report of a run take one of several tests, too."""
        self.path.write_text(self.deep(), encoding="utf-8")
        run = self.path.parent / "run"
        run.mkdir()
        for name in ("plot", "report"):
            words = name, "--cpt", str(self.path), str(run)
            self.assertIn("choose one by --location", self.say(*words)[1])
            said = self.say(*words, "--location", "CPT03")[1]
            self.assertIn("no test 'CPT03'; the tests are CPT01, CPT02", said)
            self.assertFalse((run / cone.NAME).exists())
            self.say(*words, "--location", "CPT02")  # there is nothing else to draw
            kept = cone.of_run(run)
            assert kept is not None
            self.assertAlmostEqual(kept.at(4.45), 9e6 * 5.45)
            (run / cone.NAME).unlink()
            said = self.say(name, str(run), "--location", "CPT02")[1]
            self.assertIn("--location is for a cone test, --cpt", said)

    def test_kept_as_a_table(self) -> None:
        """With a run, and read again from there."""
        self.path.write_text(GEF, encoding="utf-8")
        cone.adopt(self.path, self.path.parent)
        kept = self.path.with_name(cone.NAME)
        self.assertEqual(kept.read_text("utf-8").splitlines()[0], "depth_m,qc_kPa")
        profile = cone.of_run(self.path.parent)
        assert profile is not None
        np.testing.assert_allclose(profile.resistance[-2:], [1e6, 4e6])


if __name__ == "__main__":
    unittest.main()
