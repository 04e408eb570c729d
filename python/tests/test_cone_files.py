# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests in AGS 4, in GEF, and in tables of other countries: read, or refused with
the row."""
import argparse
import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np

from caisson import __main__ as program
from caisson.cpt import command
from caisson_design import InputError, cone, cone_file, interpretation

HEADS = '"HEADING","LOCA_ID","SCPG_TESN","SCPT_DPTH","SCPT_RES","SCPT_FRES","SCPT_PWP2"'
UNITS = '"UNIT","","","m","MN/m2","kN/m2","kPa"'
AGS = f""""GROUP","PROJ"
"HEADING","PROJ_ID"
"UNIT",""
"TYPE","ID"
"DATA","7"

"GROUP","SCPT"
{HEADS}
{UNITS}
"TYPE","ID","X","2DP","2DP","1DP","1DP"
"DATA","CPT01","1","0.50","1.00","5.0","10"
"DATA","CPT01","1","1.00","2.50","",""
"DATA","CPT01","1","1.50","4.00","20.0","15"
"""
OTHER = (
    '"DATA","CPT02","1","0.50","9.00","50.0","1"\n"DATA","CPT02","1","1","9","50","1"\n'
)

GEF = """#GEFID= 1, 1, 0
#REPORTCODE= GEF-CPT-Report, 1, 1, 0
#COLUMN= 5
#COLUMNINFO= 1, m, Sondeerlengte, 1
#COLUMNINFO= 2, MPa, Conusweerstand, 2
#COLUMNINFO= 3, MPa, Plaatselijke wrijving, 3
#COLUMNINFO= 4, kPa, Waterspanning, 6
#COLUMNINFO= 5, m, Gecorrigeerde diepte, 11
#COLUMNVOID= 2, -9999.000
#COLUMNVOID= 4, -1
#COLUMNSEPARATOR= ;
#RECORDSEPARATOR= !
#EOH=
0.50;1.00;0.005;-1;0.49;!
1.00;-9999;0.006;-1;0.98;!
1.50;4.00;2.0E-002;-1;1.47;!
"""


class Reading(unittest.TestCase):
    """Has a directory for a file."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name, "mine.txt")

    def read(self, text: str, location: str = "") -> cone_file.Test:
        """Return the test of a file with this text."""
        self.path.write_text(text, encoding="utf-8")
        return cone_file.read(self.path, location=location)

    def refused(self, text: str, words: str) -> None:
        """Expect words in the refusal of a text."""
        with self.assertRaisesRegex(InputError, words):
            self.read(text)


class Ags(Reading):
    """AGS 4."""

    def test_good(self) -> None:
        """Units of the row UNIT; a row without a value is left out, and said."""
        test = self.read(AGS)
        np.testing.assert_allclose(test.depth, [0.5, 1.5])
        np.testing.assert_allclose(test.resistance, [1e6, 4e6])
        assert test.friction is not None and test.pore_pressure is not None
        np.testing.assert_allclose(test.friction, [5e3, 20e3])
        np.testing.assert_allclose(test.pore_pressure, [10e3, 15e3])
        self.assertIn("left out: 1, those of number 12", " ".join(test.remarks))
        # the methods need no friction, and so have all rows
        np.testing.assert_allclose(cone.read(self.path).depth[-3:], [0.5, 1, 1.5])

    def test_several_tests(self) -> None:
        """Of two locations, or of two pushes at one of them."""
        self.refused(AGS + OTHER, "2 tests: CPT01, CPT02; choose one by --location")
        self.assertEqual(self.read(AGS + OTHER, "CPT02").resistance[0], 9e6)
        with self.assertRaisesRegex(InputError, "no test 'CPT03'.* CPT01, CPT02"):
            self.read(AGS + OTHER, "CPT03")
        pushes = AGS + OTHER.replace('"CPT02","1"', '"CPT01","2"')
        self.refused(pushes, "CPT01/1, CPT01/2")
        self.assertEqual(self.read(pushes, "CPT01/2").resistance[0], 9e6)

    def test_pore_pressure_stops(self) -> None:
        """The other columns count; and is hydrostatic: 9.81 kPa each meter."""
        test = self.read(AGS.replace('"20.0","15"', '"20.0",""'))
        np.testing.assert_allclose(test.depth, [0.5, 1.5])
        assert test.pore_pressure is not None
        np.testing.assert_allclose(test.pore_pressure, [10e3, 1.5 * 9.81e3])
        self.assertIn("hydrostatic there: 1, the first at 1.5 m", str(test.remarks))

    def test_area_ratio(self) -> None:
        """Of the test that is read."""
        group = (
            '"GROUP","SCPG"\n"HEADING","LOCA_ID","SCPG_TESN","SCPG_CAR"\n'
            '"UNIT","","",""\n"DATA","CPT02","1","0.6"\n"DATA","CPT01","1","0.75"\n'
        )
        self.assertEqual(self.read(group + AGS).area_ratio, 0.75)
        self.assertEqual(self.read(group + AGS + OTHER, "CPT02").area_ratio, 0.6)
        self.assertIsNone(self.read(AGS).area_ratio)

    def test_blanks_and_no_rows(self) -> None:
        """Blanks behind commas; a group that is empty."""
        test = self.read(AGS.replace(",", ", "))
        np.testing.assert_allclose(test.resistance, [1e6, 4e6])
        self.refused('"GROUP","SCPT"\n', "the group SCPT, .*, is empty")

    def test_wrong_units(self) -> None:
        """One that is not known, none at all, and megapascals below kilopascals."""
        self.refused(AGS.replace("MN/m2", "tsf"), "row 9: the unit 'tsf' of SCPT_RES")
        self.refused(AGS.replace(UNITS + "\n", ""), "row 8: .* has no row UNIT")
        small = UNITS.replace("MN/m2", "Pa")
        self.refused(AGS.replace(UNITS, small), "row 11: .*both units in the row UNIT")

    def test_wrong_groups(self) -> None:
        self.refused(AGS.replace('"SCPT"', '"GEOL"'), "no group SCPT.* are PROJ, GEOL")
        self.refused(AGS.replace("SCPT_RES", "SCPT_QT"), "row 8: .* heading SCPT_RES")
        self.refused('"**PROJ"\n"*PROJ_ID"\n"7"\n', r"row 1: '\*\*PROJ' .* of AGS 3")

    def test_wrong_rows(self) -> None:
        self.refused(AGS.replace('"1.00","2.50"', '"1.00,2.50"'), "row 12: 6 cells, an")
        self.refused(
            AGS.replace('"1.50"', '"0.25"'), "row 13: the depth of 0.25 m is n"
        )
        self.refused(AGS.replace('"4.00"', '"4,00"'), "row 13: '4,00' has a comma")
        self.refused(AGS.replace('"4.00"', '"x"'), "row 13: 'x' is no number")


class Gef(Reading):
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
        self.assertIn("not read: Sondeerlengte", said)

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

    def test_decimal_commas(self) -> None:
        """In the table and in #COLUMNVOID; 0,99900 is the void 0.999."""
        table = GEF.replace("0.006", "0.99900").replace("-9999;", "3.0;")
        for void in ("0.999", "0,999", "0,9990, friction"):
            head, rows = table.replace("2, -9999.000", f"3, {void}").split("#EOH=")
            test = self.read(f"{head}#EOH={rows.replace('.', ',')}")
            np.testing.assert_allclose(test.depth, [0.49, 1.47])
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

    def test_area_ratio(self) -> None:
        for text in ("0.59", "0,59"):
            head = f"#MEASUREMENTVAR= 1, 1000, mm2, x\n#MEASUREMENTVAR= 3, {text}, -\n"
            self.assertEqual(self.read(head + GEF).area_ratio, 0.59)
        self.assertIsNone(self.read(GEF).area_ratio)

    def test_wrong_heads(self) -> None:
        for old, new, words in (
            ("#EOH=\n", "", "no line #EOH="),
            ("Conusweerstand, 2", "Conusweerstand, 13", "quantity 2, the cone resist"),
            ("2, MPa", "2, tsf", "row 5: the unit 'tsf' of 'Conusweerstand'"),
            ("wrijving, 3", "wrijving, x", "row 6: #COLUMNINFO must have number"),
            ("wrijving, 3", "wrijving, 2", "row 6: a second column of the quantity 2"),
            ("= 1, m, S", "= 0, m, S", r"row 4: #COLUMNINFO must have number \(from"),
            ("2, -9999.000", "0, -9999.000", "row 9: .* a column, from 1, and"),
            ("2, -9999.000", "2", "row 9: #COLUMNVOID must have the number"),
            ("GEF-CPT-Report", "GEF-BORE-Report", "row 2: .* is a borehole"),
        ):
            self.assertIn(old, GEF)
            self.refused(GEF.replace(old, new), words)

    def test_wrong_units(self) -> None:
        self.refused(GEF.replace("2, MPa", "2, GPa"), "row 5: the unit 'GPa'")
        self.refused(GEF.replace("2, MPa", "2, kPa"), "row 14: .* units in #COLUMNINFO")

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
            ("-9999;", "-999;", "row 15: the cone resistance is -999 MPa"),
            (";0.49;!", ";0.49;7;!", "row 14: 6 .*, and 5 .* a line #COLUMNINFO"),
        ):
            self.assertIn(old, GEF)
            self.refused(GEF.replace(old, new), words)


class Tables(Reading):
    """Tables of text as other countries write them."""

    def test_decimal_commas(self) -> None:
        test = self.read("depth_m;qc_MPa\n0,5;1,25\n1;2,5\n")
        np.testing.assert_allclose(test.resistance, [1.25e6, 2.5e6])
        mixed = "depth_m;qc_kPa\n0.5;1250\n1.0;1,300\n"
        self.refused(mixed, "row 3: '1,300' has a comma where other rows")

    def test_thousands(self) -> None:
        """With separators, which would be decimals; weak clay is a remark."""
        for rows in ("0,5;1,424\n1;15,250\n", "0.5;712\n1;1.148\n"):
            self.refused(f"depth_m;qc_kPa\n{rows}", "row .: .* of thousands.* write 1")
        test = self.read("depth_m;qc_kPa\n0.5;95.25\n1;120.5\n")
        self.assertIn("is only 120.5 kPa: check the unit in the", str(test.remarks))
        for rows in ("0.5;712.5\n1;99\n", "0.5;712\n1;815.125\n"):
            self.assertEqual(self.read(f"depth_m;qc_kPa\n{rows}").remarks, ())

    def test_depths(self) -> None:
        """Below the ground; not a level, and not below a hole."""
        rows = "0.5;1\n1;4\n"
        for head in ("Tiefe unter GOK (m)", "Teufe [m]", "Penetration (m)"):
            self.assertEqual(self.read(f"{head};qc_MPa\n{rows}").depth[0], 0.5)
        both = "Sondeerlengte (m);Diepte (m);qc_MPa\n0.5;0.4;1\n1;0.9;4\n"
        self.assertEqual(self.read(both).depth[0], 0.4)
        for head in ("Diepte t.o.v. NAP (m)", "Höhe (m)"):
            self.refused(f"{head};qc_MPa\n{rows}", "is a level above a datum; subtract")
        self.refused("depth_m;qc_MPa\n2;1\n3;4\n", "row 2: .* 2 m, .* add rows above")
        self.refused("depth_m;qc_MPa\n0;1;2\n3;4\n", "row 2: .* needs a head in the f")
        self.refused("depth_m,qc_MPa\n0,1,2\n3,4\n", "row 2: .* divide cells by semi")

    def test_heads(self) -> None:
        """German, Dutch, French and English; what is no measured resistance or friction
        is left out."""
        for head in (
            "Tiefe [m];Spitzendruck qc [MN/m²];Mantelreibung fs [kPa];u1 [kPa]",
            "Tiefe in m;Spitzenwiderstand (MPa);lokale Mantelreibung (kN/m²);Rf (%)",
            "Diepte (m);Conusweerstand (MPa);Plaatselijke wrijving (kPa);Helling (gr)",
            "Profondeur (m);Résistance de pointe (MPa);Frottement latéral (kPa);t (s)",
            "Depth, m;Cone resistance (MPa);Sleeve friction (kPa);qt (MPa)",
            "Tiefe;Spitzendruck;Mantelreibung;Zeit\nm;MPa;kPa;s",
        ):
            for encoding in ("utf-8", "latin-1"):
                self.path.write_text(head + "\n0;1;5;7\n1,5;4;20;7\n", encoding)
                test = cone_file.read(self.path)
                np.testing.assert_allclose(test.depth, [0, 1.5])
                np.testing.assert_allclose(test.resistance, [1e6, 4e6], err_msg=head)
                assert test.friction is not None
                np.testing.assert_allclose(test.friction, [5e3, 20e3], err_msg=head)
                self.assertIsNone(test.pore_pressure)

    def test_pore_pressure(self) -> None:
        for head in ("Porenwasserdruck u2 (kPa)", "Waterspanning u2 (kPa)", "u2_kPa"):
            test = self.read(f"depth_m;qc_MPa;{head}\n0;1;5\n1;4;20\n")
            assert test.pore_pressure is not None
            np.testing.assert_allclose(test.pore_pressure, [5e3, 20e3])

    def test_no_text(self) -> None:
        """A spreadsheet, and the UTF-16 of Windows."""
        for content in (b"PK\x03\x04", "depth_m,qc_MPa\n".encode("utf-16")):
            self.path.write_bytes(content)
            with self.assertRaisesRegex(InputError, "save it as CSV in UTF-8"):
                cone_file.read(self.path)


class Command(Reading):
    """caisson cpt, and what is kept with a run."""

    def call(self, *words: str) -> tuple[int, str]:
        """Return status and words of `caisson cpt`."""
        parser = argparse.ArgumentParser()
        command.add_arguments(parser)
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            out = str(self.path.parent / "out")
            words = (str(self.path), "--out", out, *words)
            status = command.main(parser.parse_args(words))
        return status, said.getvalue()

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
        for text, said_of_it in (("0.6", "0.6, from the file"), ("59", "59, is not")):
            self.path.write_text(group.format(text) + self.deep(), encoding="utf-8")
            said = self.call("--location", "CPT02")[1]
            self.assertRegex(said, f"net area ratio of the cone: .*{said_of_it}")
            said = self.call("--location", "CPT02", "--area-ratio", "0.7")[1]
            self.assertNotIn("net area ratio", said)
        for text, ratio in (("0.6", 0.6), ("59", 0.8)):
            self.path.write_text(group.format(text) + self.deep(), encoding="utf-8")
            test = cone_file.read(self.path, location="CPT02")
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
