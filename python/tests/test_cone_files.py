# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests in AGS 4, GEF, BRO-XML, workbooks and tables of other countries: read with
a remark on what was made of them, or refused in a line with the row."""
import argparse
import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np
import openpyxl

from caisson import __main__ as program
from caisson.cpt import command
from caisson_design import InputError, cone, cone_file, cone_grid, interpretation
from caisson_design.cone_options import How

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

    def read(self, text: str, location: str = "", **how: str) -> cone_file.Test:
        """Return the test of a file with this text."""
        self.path.write_text(text, encoding="utf-8")
        return cone_file.read(self.path, how=How(location, **how))

    def refused(self, text: str, words: str, **how: str) -> None:
        """Expect words in the refusal of a text, which is one line."""
        with self.assertRaisesRegex(InputError, words) as caught:
            self.read(text, **how)
        self.assertNotIn("\n", str(caught.exception))


class Ags(Reading):
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
            np.testing.assert_allclose(test.depth, [0.5, 1, 1.5, 1.7, 3, 3.2])
            said = " ".join(test.remarks)
            self.assertIn("3 pushes were joined, gaps at 1.7 to 3 m", said)
            self.assertIn("has reached, left out: 1, those of", said)
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
            AGS.replace("MN/m2", "tsf"), "row 9: the column 'SCPT_RES', .*'tsf'"
        )
        self.refused(AGS.replace(UNITS + "\n", ""), "row 8: .* has no row UNIT")
        small = UNITS.replace("MN/m2", "Pa")
        self.refused(AGS.replace(UNITS, small), "row 11: .*both units in the row UNIT")

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

    def test_area_ratio(self) -> None:
        for text in ("0.59", "0,59"):
            head = f"#MEASUREMENTVAR= 1, 1000, mm2, x\n#MEASUREMENTVAR= 3, {text}, -\n"
            self.assertEqual(self.read(head + GEF).area_ratio, 0.59)
        self.assertIsNone(self.read(GEF).area_ratio)

    def test_wrong_heads(self) -> None:
        for old, new, words in (
            ("#EOH=\n", "", "no line #EOH="),
            ("Conusweerstand, 2", "Conusweerstand, 99", "no column is the cone resist"),
            ("2, MPa", "2, tsf", "row 5: the column 'Conusweerstand', .* 'tsf'"),
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
        self.refused("depth_m;qc_MPa\n0;1;2\n3;4\n", "row 2: .* column needs a head")
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
        """An archive, an old workbook, and the UTF-16 of Windows."""
        for content, words in (
            (b"PK\x03\x04", "no workbook that can be read .*save it as .xlsx"),
            (b"\xd0\xcf\x11\xe0\0", "old form .*: save it as .xlsx or CSV"),
            ("depth_m,qc_MPa\n".encode("utf-16"), "save it as CSV in UTF-8"),
        ):
            self.path.write_bytes(content)
            with self.assertRaisesRegex(InputError, words):
                cone_file.read(self.path)

    def test_lines_above_and_below(self) -> None:
        """What they say of the test is used or named."""
        rows = "0.5,1,5,0\n1.5,1,5,9\n2,4,,\n2.5,,5,9\n3,4,20,9\nEnd of test,,,\n"
        head = "Depth (m),qc (MPa),fs (kPa),u2 (kPa)\n"
        above = (
            "Contractor:,X,,\nAssumed GWL:,1.2,,\naratio,0.8,,\nPre-Drill:,1.2 m,,\n"
        )
        test = self.read(above + ",,,\n" + head + rows)
        said = " ".join(test.remarks)
        self.assertEqual((test.area_ratio, test.measured_from), (0.8, 1.5))
        np.testing.assert_allclose(test.depth[-3:], [1.5, 2, 3])
        assert test.friction is not None
        np.testing.assert_allclose(test.friction[-3:], [5e3, 20e3, 20e3])
        for words in (
            "above the heads that were not read: 1",
            "row 12, 'End of test'",
            "above the pre-excavated depth of 1.2 m, left out: 1",
            "water level of the file, 1.2 m, is not used",
            "without a depth or a cone resistance, left out: 1",
        ):
            self.assertIn(words, said)
        self.assertIn(
            "two values: area ratio",
            str(self.read("aratio,0.8\narea ratio,0.6\n" + head + rows).remarks),
        )

    def test_heads_of_others(self) -> None:
        """Units in any bracket or below, a corrected resistance alone, any divider."""
        for text in (
            "Diepte[m];Maaiveld[m];Conuswaarden[MN/m²]\n0,2;-0,2;1\n1,5;-1,5;4\n",
            "sep=;\nz [m];qc [MPa]\n0,2;1\n1,5;4\n",
            "z [m]\tqt [MPa]\n0.2\t1\n1.5\t4\n",
            "Depth  qc\n m  MPa\n0.2 1\n1.5 4\n",
            "Tiefe {m u. GOK};Spitzendruck / MPa\n0,2;1\n1,5;4\n",
            "Penetration length (m),Measured cone resistance [MPa]\n-0.2,1\n-1.5,4\n",
            "z_mm,Tip Resistance (kN / m2),qc/pa\n200,1000,1\n1500,4000,1\n",
        ):
            test = self.read(text)
            np.testing.assert_allclose(test.depth, [0.2, 1.5], err_msg=text)
            np.testing.assert_allclose(test.resistance, [1e6, 4e6], err_msg=text)
            self.assertEqual(test.is_corrected, "qt" in text)
        both = "depth_m,qc_MPa,qt_MPa\n0.2,1,2\n1.5,4,5\n"
        self.assertEqual(self.read(both).resistance[0], 1e6)
        ratio = "depth_m,qc_MPa,Sleeve friction ratio (MPa)\n0.2,1,2\n1.5,4,5\n"
        self.assertIsNone(self.read(ratio).friction)

    def test_without_heads(self) -> None:
        """The message says how columns are named, and that works."""
        rows = "0\t0.5\t0\t-1.6\n0.01\t1\t1\t-70\n0.02\t2\t20\t3\n"
        self.refused(rows, "row 1 is '0, 0.5, 0, -1.6'. Name the columns: --columns d")
        for columns in (cone_grid.EXAMPLE, "depth,qc,fs,u2"):
            test = self.read(rows, columns=columns)
            assert test.friction is not None and test.pore_pressure is not None
            np.testing.assert_allclose(test.resistance, [0.5e6, 1e6, 2e6])
            np.testing.assert_allclose(test.friction, [0, 1e3, 20e3])
            np.testing.assert_allclose(test.pore_pressure, [-1600, -70e3, 3e3])
            self.assertEqual("ASSUMED" in str(test.remarks), "_" not in columns)
        test = self.read("x\n" + rows, columns="z_m,qc_MPa,-,-")
        np.testing.assert_allclose(test.resistance, [0.5e6, 1e6, 2e6])
        self.refused(rows, "'rubbish' is no column", columns="depth,rubbish")
        self.refused(GEF, "--columns is for tables; .* is GEF", columns="depth,qc")


class Workbooks(Reading):
    """Sheets of .xlsx."""

    def test_sheets(self) -> None:
        book = openpyxl.Workbook()
        book.active.title = "about"
        book.active.append(["Contractor", "X"])
        sheet = book.create_sheet("CPT 1")
        for row in (
            ["Pre-Drill:", None],
            ["z\n[m]", "qc\n[MPa]", None, "fs [kPa]"],
            [0.1, 1, None, 10.5],
            [0.3, 4, None, None],
        ):
            sheet.append(row)
        book.save(self.path)
        test = cone_file.read(self.path)
        np.testing.assert_allclose(test.resistance, [1e6, 4e6])
        assert test.friction is not None
        np.testing.assert_allclose(test.friction, [10.5e3, 42e3])
        with self.assertRaisesRegex(InputError, "no sheet 'x'; .* are about, CPT 1"):
            cone_file.read(self.path, how=How(sheet="x"))
        book.copy_worksheet(sheet)
        book.save(self.path)
        with self.assertRaisesRegex(InputError, "2 sheets .*, CPT 1, CPT 1 Copy; cho"):
            cone_file.read(self.path)
        self.assertEqual(
            len(cone_file.read(self.path, how=How(sheet="CPT 1")).depth), 2
        )
        self.assertFalse(cone_file.is_plain(self.path))


class Bro(Reading):
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

    def test_refusals(self) -> None:
        good = self.text(self.record(0.6, 1, 0.01, 0), self.record(0.7, 1, 0.01, 0))
        self.refused(good.replace("CPT_O", "BHR_O"), "no cone test of the Dutch reg")
        self.refused(good[:-9], "no complete XML")
        self.refused(good.replace("\n", "<!DOCTYPE x []>"), "definitions of its own")
        self.refused(good.replace("cptResult", "y"), "no values within cptResult")
        self.refused(good, "no test 'CPT8'; the tests are CPT7", location="CPT8")


class Rules(Reading):
    """What rows must be, in any format; here in one that is short."""

    HEAD = "depth_m,qc_MPa,fs_kPa,u2_kPa\n"

    @staticmethod
    def rows(begin: float = 0.02, number: int = 200) -> list[list[float]]:
        """Return rows each 2 cm of sand."""
        return [[begin + i / 50, 2 + i / 100, 12, 0.2 * i] for i in range(number)]

    def of(self, rows: list[list[float]], **how: str) -> cone_file.Test:
        """Return the test of rows."""
        text = "\n".join(",".join(f"{x:g}" for x in row) for row in rows)
        return self.read(self.HEAD + text, **how)

    def test_small_readings_below_zero(self) -> None:
        """A drift is taken as 0, and counted; more is refused."""
        rows = self.rows()
        rows[7][2], rows[9][2] = -2, -11
        test = self.of(rows)
        assert test.friction is not None
        self.assertEqual(list(test.friction[6:10]), [12e3, 0, 12e3, 0])
        self.assertIn("down to -11 kPa, taken as 0: 2, those of nu", str(test.remarks))
        rows[9][2] = -60
        with self.assertRaisesRegex(InputError, "row 11: the sleeve .* is -0.06 MPa"):
            self.of(rows)
        rows[9][2:] = [12, -80]
        self.assertIn("kept, 1, down to -80 kPa", str(self.of(rows).remarks))
        rows[9][3] = -900
        with self.assertRaisesRegex(InputError, "row 11: the pore pressure is -0.9"):
            self.of(rows)

    def test_rows_without_load(self) -> None:
        """At the start, or few, they are left out; else a unit is wrong."""
        rows = self.rows()
        for row in rows[:30]:
            row[1:3] = [0, 0.6]
        rows[90][1] = -0.01
        test = self.of(rows)
        self.assertEqual((len(test.depth), test.measured_from), (200 - 31 + 31, 0.62))
        self.assertIn("without load (q_c below 0 or below f_s)", str(test.remarks))
        for row in rows:
            row[1:3] = [0.1, 500]
        with self.assertRaisesRegex(InputError, r"row 2: .* \(199 more rows are wrong"):
            self.of(rows)

    def test_depths(self) -> None:
        """All of them negative; a few that repeat; a corrected one that is a level."""
        rows = self.rows()
        test = self.of([[-z, *rest] for z, *rest in rows])
        np.testing.assert_allclose(test.depth, [z for z, *_ in rows])
        self.assertIn("negative downward: taken by their amount", str(test.remarks))
        rows[50][0] = rows[49][0]
        self.assertIn("repeat a depth, left out: 1, tho", str(self.of(rows).remarks))
        rows[50][0] -= 1
        with self.assertRaisesRegex(InputError, "row 52: the depth of 0 m is not bel"):
            self.of(rows)
        rows = self.rows()
        rows[3][0] = -0.5
        self.assertIn("above the ground, left out: 1", str(self.of(rows).remarks))
        head = "Depth (m),Penetration length (m),qc (MPa)\n"
        for shift, depth in ((0.0, 0.4), (-4.0, 0.42)):
            text = [f"{shift - 0.4 - i:g},{0.42 + i:g},2" for i in range(9)]
            test = self.read(head + "\n".join(text))
            self.assertEqual(test.depth[0], depth)

    def test_soil_above(self) -> None:
        """Of a test that begins below the mudline: ASSUMED, or as it is given."""
        test = self.of(self.rows(1.62))
        self.assertEqual((test.measured_from, test.above), (1.62, "ASSUMED"))
        self.assertEqual(test.depth[0], 0)
        first = test.resistance[test.depth < 1.62]
        np.testing.assert_allclose(first, 2.125e6)  # the median of half a meter
        test = self.of(self.rows(1.62), above="qc = 1 MPa, fs = 20 kPa")
        self.assertEqual(test.above, "GIVEN")
        assert test.friction is not None
        self.assertEqual((test.resistance[0], test.friction[80]), (1e6, 20e3))
        self.assertEqual(self.of(self.rows(0.4)).above, "")
        for words, said in (
            ("fs = 20 kPa", "qc is missing"),
            ("qc = 1 MPa, fr = 1", "'fr' is neither qc nor fs"),
            ("qc = 1 m", "no unit of it"),
            ("qc = -1 MPa", "is no cone resistance"),
        ):
            with self.assertRaisesRegex(InputError, said):
                self.of(self.rows(1.62), above=words)
        with self.assertRaisesRegex(
            InputError, "--above is for a test that begins bel"
        ):
            self.of(self.rows(), above="qc = 1 MPa")

    def test_hole_below_the_test(self) -> None:
        text = GEF.replace("#EOH=", "#MEASUREMENTVAR= 13, {}, x\n#EOH=")
        text = text.replace("-9999;0", "2;0")
        for hole, unit in (("0.9", "m (meter)"), ("900", "mm"), ("0,9", "m")):
            test = self.read(text.format(hole).replace("x\n#EOH", f"{unit}\n#EOH"))
            self.assertIn(
                "pre-excavated depth of 0.9 m, left out: 1", str(test.remarks)
            )
        self.refused(text.format("7"), "hole above the test is 7 m .* at 1.47 m: corr")

    def test_nothing_reaches_a_terminal(self) -> None:
        """Names of a file cannot command one, in messages and in remarks."""
        self.refused(
            AGS + OTHER.replace("CPT02", "C\x1b[31m2"), r"CPT01, C\\x1b\[31m2;"
        )
        head = "depth_m,qc_MPa,\x1b]0;x\x07\u202e\n"
        said = str(self.read(head + "0.5,1,1\n1,4,1\n").remarks)
        self.assertIn("not read: \\\\x1b]0;x\\\\x07\\\\u202e", said)


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
