# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests as tables of other countries, as workbooks, and the rules for any rows."""
import tracemalloc
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

from caisson import needed
from caisson.command_line import Parser
from caisson.design import cone, cone_file, cone_grid, cone_options
from caisson.disk import InputError
from caisson.design.cone_options import How
from made_up_cone import AGS, GEF, OTHER, WithFiles


class Tables(WithFiles):
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

    def test_columns_that_repeat(self) -> None:
        """A column that is there twice counts once, where it has the same values."""
        text = "depth_m,qc_MPa,Depth (m),Ic\n0.5,1,0.5,2\n1,4,1.0,2\n"
        self.refused(text, "two columns are the depth, 'depth_m' and 'Depth .m.'; leav")
        test = self.read(text.replace("1.0", "1"))
        np.testing.assert_allclose(test.depth, [0.5, 1])
        self.assertIn("were not read: Depth (m), Ic", str(test.remarks))

    def test_other_names(self) -> None:
        """Short ones, and those of one maker of cones."""
        for head in ("u (MPa)", "Pore shoulder [MPa]"):
            text = f"Depth (m),qc (MPa),Shaft friction (kPa),{head}\n"
            test = self.read(text + "0.5,1,9,0.004\n1,4,9,0.009\n")
            assert test.friction is not None and test.pore_pressure is not None
            np.testing.assert_allclose(test.friction, 9e3)
            np.testing.assert_allclose(test.pore_pressure, [4e3, 9e3])
        self.refused("depth,qc\n0.5,1\n1,4\n", "known, but 'none'; write one of Pa, k")

    def test_friction_ratio(self) -> None:
        """It stands for a friction that is not there, in any format."""
        for head in (
            "prof. (m)\tqc (MPa)\tRf (%)",
            "Tiefe [m]\tqc [MPa]\tFriction ratio (%)",
        ):
            test = self.read(head + "\n0,1\t2\t0,5\n0,2\t4\t1\n")
            assert test.friction is not None
            np.testing.assert_allclose(test.friction, [10e3, 40e3])
            self.assertIn("f_s = R_f q_c / 100", str(test.remarks))
        test = self.read("depth_m,qc_MPa,fs_kPa,Rf (%)\n0.1,2,20,9\n0.2,4,20,9\n")
        assert test.friction is not None
        np.testing.assert_allclose(test.friction, [20e3, 20e3])
        ratio = GEF.replace("MPa, Plaatselijke wrijving, 3", "%, Wrijvingsgetal, 4")
        ratio = ratio.replace(";0.005;", ";0.5;").replace("2.0E-002", "2")
        test = self.read(ratio)
        assert test.friction is not None
        np.testing.assert_allclose(test.friction, [5e3, 80e3])

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
        """Of twelve languages; what is no measured resistance or friction is left
        out."""
        for head in (
            "Profondità dal p.c. (m);Resistenza alla punta Rp (MPa);Rl (kPa);t (s)",
            "Profundidad [m];Resistencia de punta, qc [MPa];Fricción lateral [kPa];x",
            "Profundidade (m);Resistência de ponta (MPa);Atrito lateral (kPa);x",
            "Dybde under sjøbunn (m);Målt spissmotstand (MPa);Sidefriksjon (kPa);x",
            "Djup (m);Spetstryck qc (MPa);Mantelfriktion fs (kPa);Lutning (gr)",
            "Głębokość [m];Opór stożka qc [MPa];Tarcie na tulei fs [kPa];x",
            "Tiefe [m];Spitzendruck qc [MN/m²];Mantelreibung fs [kPa];u1 [kPa]",
            "Tiefe in m;Spitzenwiderstand (MPa);lokale Mantelreibung (kN/m²);Rf (%)",
            "Diepte (m);Conusweerstand (MPa);Plaatselijke wrijving (kPa);Helling (gr)",
            "Profondeur (m);Résistance de pointe (MPa);Frottement latéral (kPa);t (s)",
            "Depth, m;Cone resistance (MPa);Sleeve friction (kPa);qt (MPa)",
            "Tiefe;Spitzendruck;Mantelreibung;Zeit\nm;MPa;kPa;s",
        ):
            for encoding in ("utf-8", "latin-1"):
                if "ł" in head and encoding == "latin-1":  # has no such letter
                    continue
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
        with self.assertRaisesRegex(InputError, "is a device"):
            cone_file.read(Path("/dev/zero"))

    def test_lines_above_and_below(self) -> None:
        """What they say of the test is used or named."""
        rows = "0.5,1,5,0\n1.5,1,5,9\n2,4,,\n2.5,,5,9\n3,4,20,9\nEnd of test,20.3 m,,\n"
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
            "row 12, 'End of test 20.3 m'",
            "above the pre-excavated depth of 1.2 m, left out: 1",
            "water level of the file, 1.2 m, is not used",
            "without a depth or a cone resistance, left out: 1",
        ):
            self.assertIn(words, said)
        plain = above.replace("Pre-Drill:,1.2 m", "Voorgeboord tot [m] : 120 cm")
        self.assertEqual(self.read(plain + head + rows).measured_from, 1.5)
        self.assertIn("not read: 1: Contractor: X", said)
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
            '"Test depth\n(m)",Depth (ft),"qc\n(MPa)"\n0.2,1,1\n1.5,5,4\n',
        ):
            test = self.read(text)
            np.testing.assert_allclose(test.depth, [0.2, 1.5], err_msg=text)
            np.testing.assert_allclose(test.resistance, [1e6, 4e6], err_msg=text)
            self.assertEqual(test.is_corrected, "qt" in text)
        no_unit = self.read("Depth,qc_MPa\n0.2,1\n1.5,4\n")
        self.assertIn("ASSUMED: 'Depth' is in m", str(no_unit.remarks))
        both = "depth_m,qc_MPa,qt_MPa\n0.2,1,2\n1.5,4,5\n"
        self.assertEqual(self.read(both).resistance[0], 1e6)
        ratio = "depth_m,qc_MPa,Sleeve friction ratio (MPa)\n0.2,1,2\n1.5,4,5\n"
        self.assertIsNone(self.read(ratio).friction)

    def test_other_units(self) -> None:
        """By their definitions: 0.3048 m, 9.80665 N and 4.4482216 N."""
        for length, stress, meter, pascal in (
            ("ft", "tsf", 0.3048, 95760.518),
            ("feet", "ksf", 0.3048, 47880.259),
            ("ft", "psi", 0.3048, 6894.7573),
            ("m", "kg/cm²", 1, 98066.5),
            ("m", "kgf/cm^2", 1, 98066.5),
            ("m", "kg/cmq", 1, 98066.5),
            ("cm", "t/m2", 0.01, 9806.65),
        ):
            head = f"Depth ({length}),qt ({stress}),fs [{stress}]\n"
            test = self.read(head + "10,12.5,0.1\n12,40,0.4\n")
            measured = test.depth >= test.measured_from
            np.testing.assert_allclose(test.depth[measured], [10 * meter, 12 * meter])
            found = test.resistance[measured]
            np.testing.assert_allclose(found, [12.5 * pascal, 40 * pascal])
            assert test.friction is not None
            np.testing.assert_allclose(test.friction[-1], 0.4 * pascal)
        both = "Depth (ft),Depth (m),qc (tsf),qc (MPa)\n1,0.3,10,1\n2,0.6,40,4\n"
        np.testing.assert_allclose(self.read(both).depth, [0.3, 0.6])

    def test_columns_that_begin_with_none(self) -> None:
        """--columns -,... is no option of its own."""
        parser = Parser()
        cone_options.add_arguments(parser)
        for words in (["--columns", "-,-,depth_m"], ["--columns=-,-,depth_m"]):
            self.assertEqual(parser.parse_args(words).columns, "-,-,depth_m")

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
        timed = "".join(f"10:20:0{i} 0,{i + 1} {i + 1},5 x\n" for i in range(9))
        test = self.read("Test 1\n" + timed, columns="-,depth (m),qc (MPa),-")
        np.testing.assert_allclose(test.resistance[:2], [1.5e6, 2.5e6])
        self.refused(rows, "'rubbish' is no column", columns="depth,rubbish")
        self.refused(GEF, "--columns is for tables; .* is GEF", columns="depth,qc")


@unittest.skipUnless(needed.is_there("openpyxl"), "openpyxl is missing")
class Workbooks(WithFiles):
    """Sheets of .xlsx."""

    def test_sheets(self) -> None:
        import openpyxl

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
        self.assertFalse(test.is_plain)
        book["CPT 1"]["B4"] = "=1+1"  # whose value no spreadsheet program has stored
        book.save(self.path)
        with self.assertRaisesRegex(InputError, "row 4 of sheet CPT 1: a formula"):
            cone_file.read(self.path, how=How(sheet="CPT 1"))

    def test_a_row_in_each_cell(self) -> None:
        """Text that was pasted into one column is divided as text."""
        import openpyxl

        book = openpyxl.Workbook()
        for line in ("Job: 1", None, "Depth   qc   fs", "[m] [MPa] [MPa]"):
            book.active.append([line])
        for z in range(1, 9):
            book.active.append([f"{z / 10:g}   {z}   0.0{z}"])
        book.active["A9"] = "0.5  5  none"
        book.save(self.path)
        test = cone_file.read(self.path)
        np.testing.assert_allclose(test.depth, np.arange(1, 9) / 10)
        np.testing.assert_allclose(test.resistance, 1e6 * np.arange(1, 9))
        book.active["A10"] = "0.6  six  0.06"
        book.save(self.path)
        with self.assertRaisesRegex(InputError, "row 10: 'six' is no number"):
            cone_file.read(self.path)

    def test_far_cells_and_too_many(self) -> None:
        """A blank in the last cell is not read; what unpacks to very much, neither."""
        import openpyxl

        book = openpyxl.Workbook()
        for row in (["depth_m", "qc_MPa"], [0.1, 1], [0.3, 4]):
            book.active.append(row)
        book.active["XFD1048576"] = " "
        book.save(self.path)
        tracemalloc.start()
        rows = cone_grid.grid_of_workbook(self.path, "", False)
        self.assertLess(tracemalloc.get_traced_memory()[1], 50e6)
        tracemalloc.stop()
        self.assertEqual(rows[-1], (3, ["0.3", "4"]))
        for name, value in (("MOST_ROWS", 2), ("MOST_CELLS", 5), ("MOST_BYTES", 5e3)):
            with mock.patch.object(cone_grid, name, value):
                with self.assertRaisesRegex(InputError, "save what counts as CSV"):
                    cone_file.read(self.path)


class Rules(WithFiles):
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
        rows[9][3] = -80
        self.assertIn("kept, 1, down to -80 kPa", str(self.of(rows).remarks))

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

    def test_soft_soil_is_no_missing_load(self) -> None:
        """Peat of a q_c of about 0, or below by a drift, counts, in sand and at the
        mudline; a rod change in sand does not."""
        for begin, end, kept in ((50, 100, True), (0, 60, True), (90, 92, False)):
            rows = self.rows(0.0)
            for i in range(begin, end):
                rows[i][1:3] = [(0.04, -0.03, 0.002)[i % 3], 3]
            for i in range(end, end + (40 if begin == 0 else 0)):
                rows[i][1] = 0.1
            test = self.of(rows)
            self.assertEqual(len(test.depth), 200 if kept else 199)
            if kept:
                peat = test.resistance[begin:end]
                self.assertEqual((peat.min(), np.median(peat)), (0, 2e3))
                self.assertIn(
                    "rows of soft soil with a q_c of about 0", str(test.remarks)
                )

    def test_zeroed_on_deck(self) -> None:
        """The water at the mudline is found, or given, and taken off: of u_2, and of
        q_c where that has it, too."""
        depth, ratio = 20.0, 0.8
        for strength, share in ((5, 0.55), (0.5, 0.4), (400, 0.0)):
            rows = []
            for i in range(400):
                z = i / 50
                s = strength + 2 * z * (strength < 100)
                u = 9.81 * (z + depth) + share * 14 * s
                total = 14 * s + 15.8 * z + 9.81 * depth
                friction = s / 2 if share else 0.005 * total
                rows.append([z, (total - (1 - ratio) * u) / 1e3, friction, u])
            true = [row[1] - ratio * 9.81 * depth / 1e3 for row in rows]
            for how in ({"zeroed_on_deck": "20m"}, {"zeroed_on_deck": ""}):
                test = self.of(rows, **how)
                assert test.pore_pressure is not None
                given = bool(how["zeroed_on_deck"])
                near = 0.2e3 if given else 8e3
                np.testing.assert_allclose(
                    test.resistance, 1e6 * np.array(true), atol=near
                )
                wanted = [1e3 * (row[3] - 9.81 * depth) for row in rows]
                np.testing.assert_allclose(test.pore_pressure, wanted, atol=near)
                first = "GIVEN" if given else "ASSUMED"
                said = f"{first}: readings were set to 0 on deck"
                self.assertTrue(test.remarks[0].startswith(said), test.remarks)
            cone.adopt(self.path, self.path.parent)
            kept = cone.of_run(self.path.parent)
            assert kept is not None
            np.testing.assert_allclose(kept.resistance, test.resistance, rtol=1e-6)
            raw = self.of(rows, zeroed_on_deck="0")
            self.assertAlmostEqual(raw.resistance[9], 1e6 * rows[9][1], delta=200)
        for row, x in zip(rows, true):
            row[1] = x  # of which only u_2 was not set to 0
        for row in rows[:200]:
            row[1:3] = [0.05, 1]
        test = self.of(rows)
        self.assertAlmostEqual(test.resistance[9], 0.05e6, delta=1)
        self.assertNotIn("from q_c", test.remarks[0])
        for words in ("deep", "-3", "20 kPa"):
            with self.assertRaisesRegex(InputError, "--zeroed-on-deck: .*; write 20m"):
                self.of(rows, zeroed_on_deck=words)
        plain = self.of(self.rows(0.0))
        self.assertEqual(plain.remarks, ())
        stiff = [[z / 50, 0.9, 30, 420 + 0.2 * z] for z in range(400)]
        test = self.of(stiff)
        self.assertAlmostEqual(test.resistance[0], 0.9e6)
        self.assertIn("is that of clay; if readings were set to 0", test.remarks[0])

    def test_cells_beside_their_heads(self) -> None:
        """Where u_2 stands in the column of f_s, the cell of u_2 is another reading."""
        rows = self.rows()
        for row in rows[-5:]:
            row[2:] = [-74, 3707]
        test = self.of(rows)
        assert test.pore_pressure is not None
        self.assertLess(test.pore_pressure.max(), 50e3)
        self.assertIn("the pore pressure of these rows, too", str(test.remarks))

    def test_pore_pressure_in_another_unit(self) -> None:
        rows = [[z, q, f, u / 1e3] for z, q, f, u in self.rows()]
        said = "is 0.1 % of water at rest in the median; check the unit in the heads"
        self.assertIn(said, str(self.of(rows).remarks))

    def test_friction_in_few_rows(self) -> None:
        """It says nothing of the others."""
        rows = self.rows()
        for row in rows[20:]:
            row[2] = -9999
        test = self.of(rows)
        self.assertIsNone(test.friction)
        self.assertIn("friction has values in only 20 of 200 rows", str(test.remarks))

    def test_depths(self) -> None:
        """All of them negative; some that repeat; the deepest first; a corrected one
        that is a level."""
        rows = self.rows()
        test = self.of([row for row in rows for _ in range(2)][::-1])
        np.testing.assert_allclose(test.depth, [z for z, *_ in rows])
        self.assertIn("the deepest row comes first", str(test.remarks))
        self.assertIn("a row before, left out: 200, ", str(test.remarks))
        test = self.of([[-z, *rest] for z, *rest in rows])
        np.testing.assert_allclose(test.depth, [z for z, *_ in rows])
        self.assertIn("negative downward: taken by their amount", str(test.remarks))
        rows[50][0] = rows[49][0]
        self.assertIn(
            "repeat the depth of a row before, left out: 1, ",
            str(self.of(rows).remarks),
        )
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
            ("qc = 2", "'2' has no unit: 2 MPa[?]; write --above"),
            ("qc = 2 MPa, fs = 20", "'20' has no unit"),
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


if __name__ == "__main__":
    unittest.main()
