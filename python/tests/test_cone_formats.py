# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests in AGS 4, GEF and BRO-XML: read, or refused in a line with the row."""
import unittest

import numpy as np

from caisson.disk import InputError
from made_up_cone import AGS, GEF, OTHER, UNITS, WithFiles


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

    def test_refusals(self) -> None:
        good = self.text(self.record(0.6, 1, 0.01, 0), self.record(0.7, 1, 0.01, 0))
        self.refused(good.replace("CPT_O", "BHR_O"), "no cone test of the Dutch reg")
        self.refused(good[:-9], "no complete XML")
        self.refused(good.replace("\n", "<!DOCTYPE x []>"), "definitions of its own")
        self.refused(good.replace("cptResult", "y"), "no values within cptResult")
        self.refused(good, "no test 'CPT8'; the tests are CPT7", location="CPT8")


if __name__ == "__main__":
    unittest.main()
