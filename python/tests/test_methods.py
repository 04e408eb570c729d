# SPDX-License-Identifier: LGPL-2.1-or-later
"""Design methods, most of them from a cone test, against numbers worked out by hand."""
import tempfile
import unittest
from math import isnan, pi
from pathlib import Path

import numpy as np

from caisson.design import andersen, clay, cone, dnv, layered, senders_randolph
from caisson.design import unified
from caisson.design import houlsby_byrne
from caisson.disk import InputError
from caisson.design.houlsby_byrne import UNDISTURBED, Assumptions, Layer
from caisson.design.method import Forces

# 6 m with a wall of 0.1 m: the tip has pi 5.9 0.1 = 1.853540 m2
SKIRT = cone.Skirt(6, 0.1, 20, 20)
# 2 MPa per meter: at 4 m 8 MPa, and an integral of 16 MN/m
LINEAR = cone.Profile([0, 10], [0, 20e6])


def assert_forces(found: Forces, kilonewtons: tuple[float, float, float]) -> None:
    """Compare tip, inner and outer friction with values in kN, six digits."""
    np.testing.assert_allclose(np.array(found) / 1e3, kilonewtons, rtol=2e-6)


def dnv_beside(of_clay: clay.Clay) -> layered.Layered:
    """Return DNV in the sand between clay, by the names of the cases of clay."""
    soils = [(x.top, "" if x.strength else "sand") for x in of_clay.layers]
    sand = dnv.method(of_clay.skirt, LINEAR, soils)
    return layered.Layered(of_clay, sand, dict(zip(clay.CASES, dnv.CASES)))


class ByHand(unittest.TestCase):
    """Forces at 4 m under a cone resistance of 2 MPa per meter."""

    def test_dnv_in_sand(self) -> None:
        """0.3 8 MPa 1.853540 m2; 0.001 16 MN/m on pi 5.8 m and on pi 6 m."""
        method = dnv.method(SKIRT, LINEAR, [(0, "sand")])
        probable = method.forces(4, "most probable")
        assert_forces(probable, (4448.495, 291.5398, 301.5929))
        self.assertAlmostEqual(probable.total / 5041.628e3, 1, places=6)
        assert_forces(method.forces(4, "highest"), (8896.990, 874.6194, 904.7787))

    def test_dnv_in_clay_over_sand(self) -> None:
        """Clay down to 1 m has 1 MN/m of the 16: 0.03 1 + 0.001 15 = 0.045 MN/m."""
        method = dnv.method(SKIRT, LINEAR, [(0, "clay"), (1, "sand")])
        found = method.forces(4, "most probable")
        assert_forces(found, (4448.495, 45 * pi * 5.8, 45 * pi * 6))
        # at its lower boundary the tip is still in the clay: 0.6 2 MPa 1.853540 m2
        found = method.forces(1, "highest")
        assert_forces(found, (2224.248, 50 * pi * 5.8, 50 * pi * 6))

    def test_layers_of_sand_and_clay(self) -> None:
        """Clay of 20 kPa and 9 kN/m3 down to 1 m, with an adhesion of 10 kPa inside and
        8 kPa outside; below, sand has 0.001 or 0.003 of 15 MN/m on both walls. Where
        the clay is below, 1 MN/m of the 16 are in the sand."""
        of_clay, of_sand = (9e3, 20e3, 10e3, 8e3), (10e3, 0, 0, 0)
        layers = [clay.Layer(0, *of_clay), clay.Layer(1, *of_sand)]
        method = dnv_beside(clay.Clay(SKIRT, layers))
        for case, tip, wall in (("strip", 4448.495, 15), ("circle", 8896.990, 45)):
            walls = (10 + wall) * pi * 5.8, (8 + wall) * pi * 6
            assert_forces(method.forces(4, case), (tip, *walls))
        tip = 1.853540 * (9 + 7.5 * 20)
        assert_forces(method.forces(1, "strip"), (tip, 10 * pi * 5.8, 8 * pi * 6))
        layers = [clay.Layer(0, *of_sand), clay.Layer(1, *of_clay)]
        method = dnv_beside(clay.Clay(SKIRT, layers))
        tip = 1.853540 * (10 + 9 + 9 * 20)
        walls = (3 + 10) * pi * 5.8, (3 + 8) * pi * 6
        assert_forces(method.forces(2, "circle"), (tip, *walls))

    def test_senders_randolph(self) -> None:
        """1 - (5.8 / 6)^2 = 0.0655556, to the power of 0.3 0.441554; times
        tan 20 = 0.363970 and 0.012: k_f = 0.00192855."""
        method = senders_randolph.method(SKIRT, LINEAR)
        low, high = [method.forces(4, case) for case in method.cases]
        for found, factor in ((low, 1), (high, 0.0212132 / 0.012)):
            self.assertAlmostEqual(found.tip / 2965.663e3, 1, places=6)
            walls = np.array(found[1:]) / factor
            np.testing.assert_allclose(walls, [562.248e3, 581.636e3], rtol=3e-6)

    def test_unified(self) -> None:
        """A ring of half of q_c, and tan 27.1 and 32.1 degrees over 44."""
        method = unified.method(SKIRT, LINEAR)
        ratio = (1 - (5.8 / 6) ** 2) ** 0.3 / 44
        integral, q_c = LINEAR.integral(4.0), LINEAR.at(4.0)
        for case, tangent in (("low", 0.51173), ("high", 0.62730)):
            found = method.forces(4.0, case)
            self.assertAlmostEqual(found.tip / (0.5 * q_c * SKIRT.tip_area), 1, 9)
            wall = ratio * tangent * integral * np.pi
            self.assertAlmostEqual(found.outer_friction / wall / 6, 1, 4)
            self.assertAlmostEqual(found.inner_friction / wall / 5.8, 1, 4)

    def test_senders_randolph_in_layers(self) -> None:
        """Layers with a friction angle of the walls of their own, in the place of that
        of the skirt: q_c grows by the depth, so that 2 of 4 m have 1/4 of the force
        above a first row at the mudline."""
        linear = cone.Profile([0.0, 10.0], [0.0, 20e6])
        rough = senders_randolph.method(SKIRT, linear).forces(4, "low")
        bare = cone.Skirt(6, 0.1, 0, 0)
        every: list[tuple[cone.Skirt, list[tuple[float, float | None]], float]] = [
            (bare, [(0.0, 20.0)], 1.0),
            (bare, [(0.0, 20.0), (2.0, None)], 1 / 4),
            (SKIRT, [(0.0, 0.0), (2.0, None)], 3 / 4),
        ]
        for skirt, walls, share in every:
            found = senders_randolph.method(skirt, linear, walls).forces(4, "low")
            self.assertAlmostEqual(found.tip, rough.tip)
            np.testing.assert_allclose(np.divide(found[1:], rough[1:]), share)

    def test_senders_randolph_has_two_walls(self) -> None:
        """A smooth wall has no friction, and the tip does not feel it."""
        smooth = senders_randolph.method(cone.Skirt(6, 0.1, 0, 20), LINEAR)
        rough = senders_randolph.method(SKIRT, LINEAR)
        for case in smooth.cases:
            found, whole = smooth.forces(3, case), rough.forces(3, case)
            self.assertEqual(found, (whole.tip, 0, whole.outer_friction))

    def test_andersen(self) -> None:
        """0.01 and 0.55 8 MPa 1.853540 m2; 0.0015 16 MN/m."""
        method = andersen.method(SKIRT, LINEAR)
        assert_forces(method.forces(4, "low"), (148.2832, 437.3097, 452.3893))
        assert_forces(method.forces(4, "high"), (8155.574, 437.3097, 452.3893))

    def test_houlsby_byrne(self) -> None:
        """The same caisson has 1518 kN on the tip and 378.6 kN on the outer wall at 5 m
        in undisturbed ground, and 1962 and 448 kN with stress enhancement (TABLE of
        test_design): K tan(delta) is 0.5 tan(20)."""
        same = (0.1819851, 0.1819851)
        method = houlsby_byrne.method(
            6, 0.1, [Layer(0, 8829, 30, 0.5)], (20, 20), Assumptions(same, same)
        )
        for case, tip, outer in ((UNDISTURBED, 1518, 378.6), ("low", 1962, 448)):
            found = method.forces(5, case)
            np.testing.assert_allclose(found.tip / 1e3, tip, rtol=2e-3)
            np.testing.assert_allclose(found.outer_friction / 1e3, outer, rtol=2e-3)
            parts = found.tip + found.inner_friction + found.outer_friction
            self.assertEqual(found.total, parts)


class Limits(unittest.TestCase):
    """Layers, ends of the test, and nothing at all."""

    def test_equal_layers_are_one(self) -> None:
        one = dnv.method(SKIRT, LINEAR, [(0, "sand")])
        many = dnv.method(SKIRT, LINEAR, [(0, "sand"), (1.3, "sand"), (3, "sand")])
        for h in (0.4, 1.3, 2, 3, 7):
            np.testing.assert_allclose(
                many.forces(h, "highest"), one.forces(h, "highest"), rtol=1e-12
            )

    def test_nothing_at_the_mudline(self) -> None:
        for method in (
            dnv.method(SKIRT, LINEAR, [(0, "sand")]),
            senders_randolph.method(SKIRT, LINEAR),
            andersen.method(SKIRT, LINEAR),
        ):
            for case in method.cases:
                self.assertEqual(method.forces(0, case), (0, 0, 0))

    def test_profile_between_and_beyond_its_rows(self) -> None:
        """4 MPa at 0.5 m and 12 at 2.5 m: 4 above; 8 at 1.5 m, and 2 + 6 MN/m."""
        profile = cone.Profile([0.5, 2.5], [4e6, 12e6])
        at = [profile.at(z) for z in (0, 0.2, 1.5, 2.5)]
        np.testing.assert_allclose(at, [4e6, 4e6, 8e6, 12e6])
        found = [profile.integral(z) for z in (0, 0.5, 1.5, 2.5)]
        np.testing.assert_allclose(found, [0, 2e6, 8e6, 18e6])
        self.assertTrue(isnan(profile.at(2.51)) and isnan(profile.integral(2.51)))
        deep = andersen.method(SKIRT, profile).forces(2.51, "low")
        self.assertTrue(all(map(isnan, (*deep, deep.total))))

    def test_linear_resistance_has_a_closed_integral(self) -> None:
        """a z + b: a z^2 / 2 + b z, also from many uneven rows."""
        depth = [0.0, 0.01, 0.3, 0.35, 1.9, 2, 6]
        profile = cone.Profile(depth, [3e6 * z + 1e6 for z in depth])
        for z in (0.005, 0.32, 1.95, 5.9, 6):
            exact = 1.5e6 * z**2 + 1e6 * z
            self.assertAlmostEqual(profile.integral(z) / exact, 1, places=12)


class Files(unittest.TestCase):
    """Tests in files."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name) / "mine.csv"

    def read(self, text: str) -> cone.Profile:
        """Return the test of a file with this text."""
        self.path.write_text(text, encoding="utf-8")
        return cone.read(self.path)

    def test_units_and_dividers(self) -> None:
        for text in (
            "depth_m,qc_MPa\n0,1\n2,5\n",
            "# of site 3\n\nfs_kPa,Depth [m],qc (kPa)\n9,0,1000\n,2,5e3\n",
            "\ufeffdepth (m);qc (Pa)\r\n0;1e6\r\n2;5e6\r\n",
            "qc_MPa\tdepth_m\n1.0\t0\n5.0\t2.0",
        ):
            profile = self.read(text)
            np.testing.assert_array_equal(profile.depth, [0, 2], text)
            np.testing.assert_allclose(profile.resistance, [1e6, 5e6], err_msg=text)

    def test_wrong_rows_are_named(self) -> None:
        """Comments and empty rows count, as in an editor."""
        head = "# comment\ndepth_m,qc_MPa\n0,1\n\n"
        for rows, row, words in (
            ("1,x\n2,3", 5, "'x' is no number"),
            ("1,2\n0.5,3", 6, "not below that of the row before"),
            ("1,2\n2,-0.1", 6, "-0.1 MPa is below 0"),
            ("1,2\n2,5000", 6, "5000 MPa.* check the unit"),
        ):
            expected = rf"mine.csv, row {row}: .*{words}"
            with self.assertRaisesRegex(InputError, expected):
                self.read(head + rows)
        for rows in ("3,1\n4,2", "-3,1\n-4,2"):  # nothing is known above
            self.assertEqual(self.read("depth_m,qc_MPa\n" + rows).at(1.5), 1e6)

    def test_wrong_heads_and_files(self) -> None:
        for heads, words in (
            ("z,q", "no row names .* as depth_m,qc_MPa,.* row 1 is 'z, q'"),
            ("depth_m,qc", "'qc', the cone resistance, has no unit"),
            ("depth_yd,qc_MPa", "'depth_yd', the depth, has no unit .* 'yd'"),
        ):
            with self.assertRaisesRegex(InputError, words):
                self.read(f"{heads}\n0,1\n1,2")
        with self.assertRaisesRegex(InputError, "needs two rows with a depth"):
            self.read("depth_m,qc_MPa\n0,1\n")
        with self.assertRaisesRegex(InputError, "none.csv cannot be read"):
            cone.read(self.path.parent / "none.csv")
        self.path.write_bytes(b"\xff\xfe\x00")
        with self.assertRaisesRegex(InputError, "cannot be read as a table"):
            cone.read(self.path)

    def test_kept_with_a_run(self) -> None:
        """Only a good file is kept, and it may be the kept one itself."""
        directory = self.path.parent / "run"
        with self.assertRaises(InputError):
            self.read("depth_m,qc_MPa\n0,1\n2,5\n")
            cone.adopt(self.path, directory)
        directory.mkdir()
        self.assertIsNone(cone.of_run(directory))
        cone.adopt(self.path, directory)
        kept = cone.of_run(directory)
        assert kept is not None
        self.assertEqual(kept.at(1), 3e6)
        cone.adopt(directory / cone.NAME, directory)
        self.path.write_text("nothing", encoding="utf-8")
        with self.assertRaises(InputError):
            cone.adopt(self.path, directory)
        self.assertIsNotNone(cone.of_run(directory))


if __name__ == "__main__":
    unittest.main()
