# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of cone tests: AGS 4, GEF, BRO-XML and those of others, read, or refused in a
line with the row, and what commands do with them."""
import contextlib
import io
import unittest
from collections.abc import Callable
from pathlib import Path

import numpy as np
from made_up_cone import AGS, GEF, options, OTHER, UNITS, WithFiles

from caisson import __main__ as program
from caisson.design import cone, cone_file, interpretation
from caisson.design.cone_options import How
from caisson.disk import InputError


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
        self.assertEqual(len(test.depth), 570 - 18 * 5)
        self.assertIn("19 pushes were joined", str(test.remarks))
        self.assertIn("its first 0.25 m, left out: 90, those of", str(test.remarks))
        self.assertIn("nothing was measured from 1.45 to 1.85 m", str(test.remarks))
        self.assertEqual(len(test.gaps), 18)

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
                remarks = interpretation.interpret(self.path, told).ground.remarks
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


class Formats(unittest.TestCase):
    """What a text is, by its lines."""

    def test_a_key_is_in_one_line(self) -> None:
        """Blank lines before it, of which a file may have many, do not count."""
        for lines, form in (
            (["", "GROUP,SCPT"], "AGS 4"),
            (["", ' "GROUP","SCPT"'], "AGS 4"),
            (["**PROJ"], "AGS 4"),
            (["", " <a>"], "XML"),
            (["x", "", ' "# gefid = 1'], "GEF"),
            (["#", "GEFID = 1"], ""),
            (["x", "GROUP,SCPT"], ""),
            (["x", "<a>"], ""),
        ):
            self.assertEqual(cone_file.format_of(lines), form, lines)


class Ags(WithFiles):
    """AGS 4."""

    def test_good(self) -> None:
        """Units of the row UNIT; where only f_s is missing, it has its share of q_c."""
        test = self.read(AGS)
        np.testing.assert_allclose(test.depth, [0.5, 1, 1.5])
        np.testing.assert_allclose(test.resistance, [1e6, 2.5e6, 4e6])
        assert test.friction is not None and test.pore_pressure is not None
        np.testing.assert_allclose(test.friction, [5e3, 12.5e3, 20e3])
        np.testing.assert_allclose(test.pore_pressure, [10e3, 9.81e3, 15e3])
        self.assertIn("the rows next to them have: 1, from 1 to 1 m", str(test.remarks))
        void = self.read(AGS.replace('"2.50"', '""'))
        np.testing.assert_allclose(void.depth, [0.5, 1.5])
        self.assertIn("left out: 1, those of number 12", str(void.remarks))

    def test_several_tests(self) -> None:
        """Of two locations, or of two pushes at one of them."""
        self.refused(AGS + OTHER, "2 tests: CPT01, CPT02; choose one by --location")
        self.assertEqual(self.read(AGS + OTHER, "CPT02").resistance[0], 9e6)
        with self.assertRaisesRegex(InputError, "no test 'CPT03'.* CPT01, CPT02"):
            self.read(AGS + OTHER, "CPT03")
        pushes = AGS + OTHER.replace('"CPT02","1"', '"CPT01","2"')
        self.refused(pushes, "CPT01/. and CPT01/. overlap from 0.5 to 1 m: choose one")
        self.assertEqual(self.read(pushes, "CPT01/2").resistance[0], 9e6)

    def test_pushes_of_one_borehole(self) -> None:
        """They are one test, in any order, with the gap named; of two boreholes one is
        chosen; a push alone begins as in a predrilled hole."""
        deep = '"DATA","CPT01","2","1.4","9.00","50","1"\n'
        deep += '"DATA","CPT01","2","1.7","9","50","1"\n'
        deep += '"DATA","CPT01","3","3.0","9","50","1"\n'
        deep += '"DATA","CPT01","3","3.2","9","50","1"\n'
        heads, rows = AGS.split('"DATA","CPT01"', 1)
        turned = heads + deep + '"DATA","CPT01"' + rows
        for text, where in (
            (AGS + deep, ""),
            (turned, ""),
            (AGS + deep + OTHER, "CPT01"),
        ):
            test = self.read(text, where)
            np.testing.assert_allclose(test.depth, [0.5, 1, 1.5, 1.7, 3.2])
            said = " ".join(test.remarks)
            self.assertIn("3 pushes were joined", said)
            self.assertIn("takes load, its first 0.25 m, left out: 2, those of", said)
        self.refused(AGS + deep + OTHER, "4 tests: CPT01/1, .*--location 'CPT01'")
        test = self.read(AGS + deep, "CPT01/3")
        self.assertEqual((test.measured_from, test.above), (3, "ASSUMED"))
        self.assertIn("ASSUMED: the soil above 3 m", str(test.remarks))

    def test_pore_pressure_stops(self) -> None:
        """The other columns count; and is hydrostatic: 9.81 kPa each meter."""
        test = self.read(AGS.replace('"20.0","15"', '"20.0",""'))
        assert test.pore_pressure is not None
        np.testing.assert_allclose(test.pore_pressure, [10e3, 9.81e3, 1.5 * 9.81e3])
        self.assertIn("hydrostatic there: 2, the first at 1 m", str(test.remarks))

    def test_area_ratio(self) -> None:
        """Of the test that is read."""
        group = (
            '"GROUP","SCPG"\n"HEADING","LOCA_ID","SCPG_TESN","SCPG_CAR"\n'
            '"UNIT","","",""\n"DATA","CPT02","1","0.6"\n"DATA","CPT01","1","0.75"\n'
        )
        self.assertEqual(self.read(group + AGS).area_ratio, 0.75)
        self.assertEqual(self.read(group + AGS + OTHER, "CPT02").area_ratio, 0.6)
        self.assertIsNone(self.read(AGS).area_ratio)
        push = AGS + OTHER.replace("CPT02", "CPT01").replace('"1","', '"2","')
        push = push.replace('"0.50","9', '"1.60","9').replace('"1","9"', '"1.8","9"')
        two = group + '"DATA","CPT01","2","0.8"\n' + push
        self.assertIn("area ratios of 0.75 to 0.8", str(self.read(two).remarks))

    def test_blanks_and_no_rows(self) -> None:
        """Blanks behind commas; a group that is empty."""
        test = self.read(AGS.replace(",", ", "))
        np.testing.assert_allclose(test.resistance, [1e6, 2.5e6, 4e6])
        self.refused('"GROUP","SCPT"\n', "no group SCPT with the readings")

    def test_wrong_units(self) -> None:
        """One that is not known, none at all, and megapascals below kilopascals."""
        self.refused(
            AGS.replace("MN/m2", "lbs"), "row 9: the column 'SCPT_RES', .*'lbs'"
        )
        self.refused(AGS.replace(UNITS + "\n", ""), "row 8: .* has no row UNIT")
        small = UNITS.replace("MN/m2", "Pa")
        self.refused(AGS.replace(UNITS, small), "row 11: .*both units in the row UNIT")

    def test_group_as_a_table(self) -> None:
        """As programs write it: with all rows, without HEADING, without units; of one
        of several locations."""
        group = [line.replace('"', "") for line in AGS.splitlines()[7:]]
        bare = [line.split(",", 1)[1] for line in group]
        for lines, units in (
            (group, True),
            (bare, True),
            ([bare[0], *bare[3:]], False),
        ):
            test = self.read("\n".join(lines))
            np.testing.assert_allclose(test.depth, [0.5, 1, 1.5])
            np.testing.assert_allclose(test.resistance, [1e6, 2.5e6, 4e6])
            assert test.friction is not None and test.pore_pressure is not None
            np.testing.assert_allclose(test.friction, [5e3, 12.5e3, 20e3])
            self.assertEqual("units of AGS 4" not in str(test.remarks), units)
            self.assertFalse(test.is_plain)
        two = "\n".join([*group, OTHER.replace('"', "")])
        self.refused(two, "2 tests: CPT01, CPT02; choose one by --location")
        self.assertEqual(self.read(two, "CPT02").resistance[0], 9e6)

    def test_group_that_goes_on(self) -> None:
        """A second group SCPT has the same headings and units, or is refused."""
        begin = AGS.index('"GROUP","SCPT"')
        more = AGS[begin:].replace('"0.50"', '"1.60"').replace('"1.00"', '"1.70"')
        more = more.replace('"1.50"', '"1.80"')
        self.assertEqual(len(self.read(f"{AGS}\n{more}").depth), 6)
        for old, new, row in (
            ('_RES","SCPT_FRES"', '_FRES","SCPT_RES"', "16: .* HEADING unlike .* 8"),
            ("MN/m2", "kPa", "17: .* a row UNIT unlike that in row 9"),
        ):
            self.assertIn(old, more)
            self.refused(f"{AGS}\n{more.replace(old, new)}", f"row {row}; divide it")

    def test_wrong_groups(self) -> None:
        self.refused(AGS.replace('"SCPT"', '"GEOL"'), "no group SCPT.* are PROJ, GEOL")
        self.refused(
            AGS.replace("SCPT_RES", "SCPT_X"), "is the cone resistance; .*SCPT_RES"
        )
        self.refused('"**PROJ"\n"*PROJ_ID"\n"7"\n', r"row 1: '\*\*PROJ' .* of AGS 3")

    def test_wrong_rows(self) -> None:
        self.refused(AGS.replace('"1.00","2.50"', '"1.00,2.50"'), "row 12: 6 cells, an")
        self.refused(
            AGS.replace('"1.50"', '"0.25"'), "row 13: the depth of 0.25 m is n"
        )
        self.refused(AGS.replace('"4.00"', '"4,00"'), "row 13: '4,00' has a comma")
        self.refused(AGS.replace('"4.00"', '"x"'), "row 13: 'x' is no number")


class Gef(WithFiles):
    """GEF."""

    def test_good(self) -> None:
        """The corrected depth counts; a column of voids only is none."""
        test = self.read(GEF)
        np.testing.assert_allclose(test.depth, [0.49, 1.47])
        np.testing.assert_allclose(test.resistance, [1e6, 4e6])
        assert test.friction is not None
        np.testing.assert_allclose(test.friction, [5e3, 20e3])
        self.assertIsNone(test.pore_pressure)
        said = " ".join(test.remarks)
        self.assertIn("the column of pore pressure has no values", said)
        self.assertIn("left out: 1, those of number 15", said)
        unread = self.read(GEF.replace("Sondeerlengte, 1", "Tijd, 12"))
        self.assertIn("not read: Tijd", str(unread.remarks))

    def test_separators(self) -> None:
        """Blanks and lines where nothing is said, records on one line, and a length
        of rods where there is no corrected depth."""
        head, table = GEF.split("#EOH=\n")
        plain = "\n".join(x for x in head.splitlines() if "SEPARATOR" not in x)
        blanks = table.replace(";!", "").replace(";", "  ")
        one = head + "#EOH=\n" + table.replace("\n", "")
        rods = head.replace("diepte, 11", "diepte, 12") + "#EOH=\n" + table
        for text, first in (
            (f"{plain}\n#EOH=\n{blanks}", 0.49),
            (one, 0.49),
            (rods, 0.5),
        ):
            test = self.read(text)
            np.testing.assert_allclose(test.depth[0], first)
            np.testing.assert_allclose(test.resistance, [1e6, 4e6])

    def test_lines_of_a_spreadsheet(self) -> None:
        """In quotation marks, and a few rows with another number of cells."""
        test = self.read("\n".join(f'"{line}",,' for line in GEF.splitlines()))
        np.testing.assert_allclose(test.resistance, [1e6, 4e6])
        test = self.read("\n".join(f"    {line}" for line in GEF.splitlines()))
        np.testing.assert_allclose(test.resistance, [1e6, 4e6])
        some = [f'"{x}"' if "INFO" in x else x for x in GEF.splitlines()]
        some += [f"{i / 5:g};4.00;0.02;-1;{i / 5:g};!" for i in range(8, 200)]
        some[40] += "7;!"
        some[60] = some[60].replace(";-1", "")
        test = self.read("\n".join(some))
        self.assertEqual(len(test.depth), 2 + 192 - 2)
        self.assertIn("number of cells, left out: 2, the first is", str(test.remarks))

    def test_texts_at_the_ends_of_rows(self) -> None:
        """Comments of the crew are no numbers in a column without a name."""
        test = self.read(GEF.replace(";0.49;!", ";0.49;rain at noon!"))
        np.testing.assert_allclose(test.resistance, [1e6, 4e6])
        said = "ends of rows, not read: 1, the first is in row 14, 'rain at noon'"
        self.assertIn(said, str(test.remarks))

    def test_decimal_commas(self) -> None:
        """In the table and in #COLUMNVOID; 0,99900 is the void 0.999."""
        table = GEF.replace("0.006", "0.99900").replace("-9999;", "3.0;")
        for void in ("0.999", "0,999", "0,9990, friction"):
            head, rows = table.replace("2, -9999.000", f"3, {void}").split("#EOH=")
            test = self.read(f"{head}#EOH={rows.replace('.', ',')}")
            self.assertIn("without a sleeve friction", str(test.remarks))
        for void in ("-9999", "-9999,0"):
            head, rows = GEF.replace("-9999.000", void).split("#EOH=")
            rows = rows.replace("-9999;", "-9999.000;").replace(".", ",")
            test = self.read(f"{head}#EOH={rows}")
            np.testing.assert_allclose(test.resistance, [1e6, 4e6])

    def test_corrected_depth_without_values(self) -> None:
        """The length of the rods counts."""
        void = GEF.replace("4, -1", "5, -7").replace("-1;0.98", "1;-7")
        void = void.replace("0.49;!", "-7;!")
        for last in ("-7", "1.47"):  # none, or in one row of three
            test = self.read(void.replace("1.47;!", f"{last};!"))
            np.testing.assert_allclose(test.depth, [0.5, 1.5])
        heads, some = GEF.replace("4, -1", "5, -7"), "4.00;4.00;0.02;-1;3.97;!\n"
        test = self.read(heads.replace("1.47;!", "-7;!") + some)  # in most rows
        np.testing.assert_allclose(test.depth, [0.49, 1.5 - 0.0216666667, 3.97])
        self.assertIn("from the penetration length: 1, those of nu", str(test.remarks))

    def test_area_ratio(self) -> None:
        for text in ("0.59", "0,59"):
            head = f"#MEASUREMENTVAR= 1, 1000, mm2, x\n#MEASUREMENTVAR= 3, {text}, -\n"
            self.assertEqual(self.read(head + GEF).area_ratio, 0.59)
        self.assertIsNone(self.read(GEF).area_ratio)

    def test_wrong_heads(self) -> None:
        for old, new, words in (
            ("#EOH=\n", "", "no line #EOH="),
            ("Conusweerstand, 2", "Conusweerstand, 99", "no column is the cone resist"),
            ("2, MPa", "2, lbs", "row 5: the column 'Conusweerstand', .* 'lbs'"),
            ("wrijving, 3", "wrijving, x", "row 6: #COLUMNINFO must have number"),
            (
                "wrijving, 3",
                "wrijving, 2",
                "row 6: two columns are the cone resistance",
            ),
            ("= 1, m, S", "= 0, m, S", r"row 4: #COLUMNINFO must have number \(from"),
            ("2, -9999.000", "0, -9999.000", "row 9: .* a column, from 1, and"),
            ("2, -9999.000", "2", "row 9: #COLUMNVOID must have the number"),
            ("GEF-CPT-Report", "GEF-BORE-Report", "row 2: .* is a borehole"),
        ):
            self.assertIn(old, GEF)
            self.refused(GEF.replace(old, new), words)

    def test_wrong_units(self) -> None:
        self.refused(GEF.replace("2, MPa", "2, GPa"), "row 5: the column .* 'GPa'")
        self.refused(GEF.replace("2, MPa", "2, kPa"), "row 14: .* units in #COLUMNINFO")

    def test_no_resistance(self) -> None:
        """The resistance is named, and not the friction, which is 0 as well."""
        rows = [f"{0.1 * i:g},0,0" for i in range(1, 41)]
        table = "\n".join(["depth_m,qc_MPa,fs_kPa", *rows])
        self.refused(table, "the cone resistance is 0 in most rows")

    def test_wrong_rows(self) -> None:
        for old, new, words in (
            ("1.00;-9999;", "1.00;", "row 15: 4 cells, and 5 columns"),
            (
                "1.00;-9999;0.006;-1;0.98;!",
                "1.00;2;!",
                "row 15: 2 cells, and 5 columns",
            ),
            (";1.47", ";0.2", "row 16: the depth of 0.2 m is not below"),
            ("4.00", "4.0.0", "row 16: '4.0.0' is no number"),
            ("-9999;", "-998;", "row 15: the cone resistance is -998 MPa"),
            (";0.49;!", ";0.49;7;!", "row 14: 6 cells, and 5 columns in #COLUMNINFO"),
        ):
            self.assertIn(old, GEF)
            self.refused(GEF.replace(old, new), words)


class Bro(WithFiles):
    """The XML of the Dutch register."""

    @staticmethod
    def record(z: float, tip: float, friction: float, pressure: float) -> str:
        """Return a record of 25 values."""
        values = ["-999999"] * 25
        values[0], values[1], values[3] = f"{z:g}", f"{z:g}", f"{tip:g}"
        values[18], values[22] = f"{friction:g}", f"{pressure:g}"
        return ",".join(values) + ";"

    def text(self, *records: str) -> str:
        """Return a file with a test of these records, and one of dissipation."""
        return (
            '<?xml version="1.0"?>\n<answer xmlns="urn:x" xmlns:c="urn:y"><CPT_O>'
            "<c:broId>CPT7</c:broId><c:predrilledDepth>0.6</c:predrilledDepth>"
            "<c:coneSurfaceQuotient>0.75</c:coneSurfaceQuotient>"
            "<c:conePenetrationTest><c:cptResult><encoding><TextEncoding"
            ' tokenSeparator="," blockSeparator=";" decimalSeparator="."/></encoding>'
            f"<c:values>{''.join(records)}</c:values></c:cptResult>"
            "</c:conePenetrationTest>"
            "<c:dissipationTest><c:values>1,2;</c:values></c:dissipationTest></CPT_O>"
            "</answer>"
        )

    def test_good(self) -> None:
        """In any order; m and MPa; what has no value; the hole."""
        rows = self.record(1.5, 4, 0.02, -999999), self.record(0.5, 0.1, 0.01, 0)
        test = self.read(self.text(*rows, self.record(0.62, 1, -999999, 0.006)))
        np.testing.assert_allclose(test.depth[-2:], [0.62, 1.5])
        np.testing.assert_allclose(test.resistance[-2:], [1e6, 4e6])
        assert test.friction is not None and test.pore_pressure is not None
        np.testing.assert_allclose(test.friction[-2:], [5e3, 20e3])
        np.testing.assert_allclose(test.pore_pressure[-2:], [6e3, 1.5 * 9.81e3])
        self.assertEqual((test.area_ratio, test.measured_from), (0.75, 0.62))
        archived = self.text(*rows[:2], self.record(0.62, 1, 0.01, 0))
        for z in ("1.5", "0.5", "0.62"):  # the length of the rods, and no depth
            archived = archived.replace(f"{z},{z},", f"{z},-999999,")
        np.testing.assert_allclose(self.read(archived).depth[-2:], [0.62, 1.5])

    def test_friction_ratio(self) -> None:
        """It stands for a sleeve friction without values, which each record has."""
        void = -999999
        for one, expected in ((void, 40e3), (9e-3, 9e3)):
            rows = [
                self.record(z, q, f, 0)
                for z, q, f in ((1, 1, void), (2, 2, one), (3, 4, void))
            ]
            test = self.read(self.text(*rows).replace(f"{void};", "2;"))
            assert test.friction is not None
            np.testing.assert_allclose(test.friction[-3:], [20e3, expected, 80e3])
            self.assertIn("from 'friction ratio', f_s = R_f q_c", str(test.remarks))

    def test_hole_in_length_of_rods(self) -> None:
        """The corrected depth of its first row may be some mm less."""
        rows = [self.record(z, 4, 0.02, 0) for z in (0.599, 0.7, 0.8)]
        self.assertEqual(self.read(self.text(*rows)).measured_from, 0.599)

    def test_refusals(self) -> None:
        good = self.text(self.record(0.6, 1, 0.01, 0), self.record(0.7, 1, 0.01, 0))
        self.refused(good.replace("CPT_O", "BHR_O"), "no cone test of the Dutch reg")
        self.refused(good[:-9], "no complete XML")
        self.refused(good.replace("\n", "<!DOCTYPE x []>"), "definitions of its own")
        self.refused(good.replace("cptResult", "y"), "no values within cptResult")
        self.refused(good, "no test 'CPT8'; the tests are CPT7", location="CPT8")


if __name__ == "__main__":
    unittest.main()
