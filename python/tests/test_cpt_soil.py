# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the soil of a cone test is: by I_c, friction and pore pressure, or as told."""
import contextlib
import csv
import io
import unittest
from collections.abc import Callable

import numpy as np
from scipy.ndimage import gaussian_filter1d

from caisson.design import cone_texts as tables
from caisson.suggest import cone
from caisson.design import cone_file, interpretation
from caisson.disk import InputError
from caisson.design.cone_estimates import REFERENCE, RESISTANCE, Estimate
from caisson.design.correlations import DENSITY, STRENGTH
from caisson.design.expression import value_at
from caisson.design.ground import behavior_of, ground_of, kinds_of, porosity_of
from made_up_cone import HEAD, WithFiles, options


class Kinds(WithFiles):
    """What soil is, by I_c, friction and pore pressure, or as it is told."""

    STIFF = ((2.0, 5.0, 0.6), (5.0, 3.2, 4.2, 250.0), (12.0, 18.0, 0.7))

    def kinds(self, *words: str) -> list[tuple[float, str]]:
        """Return tops and kinds of layers of the file."""
        self.found = interpretation.interpret(self.path, options(*words))
        return [(e.layer.top, e.layer.kind) for e in self.found.layers]

    def said(self) -> str:
        """Return the remarks."""
        return "\n".join(tables.remarks(self.found))

    def test_by_hand(self) -> None:
        """100 (54 + 10) / (54 4.7 + 70), below 22; (268 - 18) kPa over 1.3 MPa."""
        behavior = behavior_of(np.array([54.0]), np.array([4.7]))
        np.testing.assert_allclose(behavior, [19.7654], rtol=1e-5)
        z = np.array([2.0, 3.0])
        tip, pressure = np.array([1.338e6, 1e6]), np.array([269620.0, 29430.0])
        found = ground_of(cone_file.Test(z, tip, tip / 50, pressure, ()), 1.0, 19e3)
        np.testing.assert_allclose(found.pressure_ratio, [0.25 / 1.3, 0])
        index, behaviors, pressures = map(
            np.array, zip((2.5, 30, 0), (2.5, 20, 0), (2.5, 30, 0.15), (2.7, 30, 0.3))
        )
        wanted = ["sand", "clay", "silt", "clay"]
        self.assertEqual(list(kinds_of(index, behaviors, pressures)), wanted)

    def test_stiff_clay_is_no_sand(self) -> None:
        """I_c alone takes it for sand; friction and pore pressure do not, and either
        tells it alone; all agree on the sand."""
        for excess, ratio, kind, words in (
            (
                250,
                4.6,
                "clay",
                "(I_B of 20) is that of clay and its u_2 is 250 kPa abo",
            ),
            (0, 4.2, "clay", "(I_B of 21) is that of clay; --soil 2=sand overrules"),
            (
                250,
                2.4,
                "silt",
                "though its I_c of 2.38 is that of sand: its u_2 is 250",
            ),
        ):
            sand, (bottom, tip, *_), dense = self.STIFF
            self.layered(sand, (bottom, tip, ratio, excess), dense)
            kinds = self.kinds("--tops", "0,2,5")
            self.assertEqual([k for _, k in kinds], ["sand", kind, "sand"], ratio)
            self.assertIn(words, self.said())
            self.assertNotIn("layer 3 is", self.said())

    def test_boundary_by_friction(self) -> None:
        """Where Q_tn does not change."""
        self.layered((4, 2.4, 0.6), (8, 2.4, 4.6))
        tops, kinds = zip(*self.kinds())
        self.assertEqual((kinds[0], kinds[-1]), ("sand", "clay"))
        self.assertTrue(any(abs(top - 4) <= 0.1 for top in tops))

    def test_clay_that_does_not_show_pressure(self) -> None:
        self.layered((5, 15, 0.5), (12, 0.6, 4.5))
        self.kinds("--tops", "0,5")
        self.assertIn(
            "layer 2 is clay by its friction, but its u_2 is not", self.said()
        )

    def test_pressure_that_was_not_set_to_zero(self) -> None:
        """It is taken off, and the first that is said: sand is sand, and clay clay."""
        self.layered(
            *(
                (bottom, tip, ratio, 400.0)
                for bottom, tip, ratio in ((2.0, 5.0, 0.6), (8.0, 9.0, 0.7))
            )
        )
        self.assertEqual({kind for _, kind in self.kinds()}, {"sand"})
        self.assertIn("ASSUMED: readings were set to 0 on deck", self.said()[:50])
        rows = [
            f"{z:.2f},{0.0138 * (5 + 2 * z) + 0.15 + 0.0034 * z:.4f},{2.5 + z:.2f},"
            f"{196 + 9.81 * z + 7 * (5 + 2 * z):.1f}"
            for z in np.arange(0, 10, 0.02)
        ]
        self.written("depth_m,qc_MPa,fs_kPa,u2_kPa\n" + "\n".join(rows))
        self.assertEqual({kind for _, kind in self.kinds()}, {"clay"})

    def test_soil_that_is_given(self) -> None:
        """Of all, of a layer, and of depths, whose ends are boundaries then."""
        self.layered(*self.STIFF)
        tops = ["--tops", "0,2,5"]
        for words, wanted in (
            (["2=sand"], [(0, "sand"), (2, "sand"), (5, "sand")]),
            (["clay", "2=silt"], [(0, "clay"), (2, "silt"), (5, "clay")]),
            (
                ["3.0-6.5=clay", "sand"],
                [(0, "sand"), (2, "sand"), (3, "clay"), (5, "clay"), (6.5, "sand")],
            ),
        ):
            told = [x for word in words for x in ("--soil", word)]
            self.assertEqual(self.kinds(*tops, *told), wanted)
        self.assertIn("layer 2 is taken as sand by --soil; its F_r of 4", self.said())
        tops_found = [top for top, _ in self.kinds("--soil", "4.8 - 6.5m = clay")]
        self.assertIn(4.8, tops_found)
        self.assertFalse([top for top in tops_found if 4.8 < top < 5.3])
        with self.assertRaisesRegex(InputError, "--soil 4=clay: the test has 3 layers"):
            self.kinds(*tops, "--soil", "4=clay")
        for first, second, refusal in (
            ("20-30=clay", "sand", "20-30=clay: the test ends at "),
            ("4-7=sand", "3-6=clay", "4-7=sand overlaps --soil 3-6=clay"),
        ):
            with self.assertRaisesRegex(InputError, refusal):
                self.kinds("--soil", first, "--soil", second)
        self.kinds("--soil", "3-5=clay", "--soil", "5-20=sand")
        for word in ("mud", "0=clay", "2=", "6-3=clay", "x=clay"):
            with contextlib.redirect_stderr(io.StringIO()) as said:
                with self.assertRaises(SystemExit):
                    options("--soil", word)
            self.assertIn("as in 2=clay for layer 2", said.getvalue())

    def test_without_friction(self) -> None:
        """Each layer needs a kind."""
        rows = "".join(f"{z / 20:g},{1 if z < 60 else 9}\n" for z in range(120))
        self.written("depth_m,qc_MPa\n" + rows)
        words = ["--unit-weight", "19", "--tops", "0,3", "--soil", "1=clay"]
        with self.assertRaisesRegex(InputError, "3 to 5.95 m; give .* --soil 1=sand"):
            self.kinds(*words)
        kinds = self.kinds(*words, "--soil", "2=sand")
        self.assertEqual(kinds, [(0, "clay"), (3, "sand")])

    def test_cone_factor(self) -> None:
        self.layered((5, 0.6, 4.5))
        self.kinds()
        first = self.found.layers[0].values[STRENGTH]
        self.kinds("--nkt", "17.5")
        second = self.found.layers[0].values[STRENGTH]
        self.assertAlmostEqual(first.best / second.best, 1.25)
        self.assertAlmostEqual(first.low / second.low, 1.25)
        self.assertIn("undrained strength: nkt, N_kt = 17.5", self.said())
        with self.assertRaisesRegex(InputError, "--nkt 2 is not between 5 and 40"):
            self.kinds("--nkt", "2")

    def test_strength_at_the_rate_of_a_wall(self) -> None:
        """N = 3.4 + 1.6 ln(300/2.9) = 10.822. A wall of 40 mm at 1 mm/s shears at 0.025
        and a cone at 0.5602 1/s: 1 + 0.144 log10 of their ratio is 0.8055."""
        path = self.layered((5, 0.6, 4.5))
        usual = interpretation.interpret(path, options())
        chosen = options()
        chosen.wall = 0.04
        own = interpretation.interpret(path, chosen)
        strengths = [x.layers[0].values[STRENGTH].best for x in (own, usual)]
        expected = 14 * 0.80553 / 10.8224
        self.assertAlmostEqual(strengths[0] / strengths[1], expected, places=4)
        for found, words in (
            (own, "1 mm/s, ASSUMED, meets 0.81 of the strength at that rate"),
            (usual, "has 10.8 for the strength at its rate"),
        ):
            self.assertIn(words, "\n".join(tables.sources(found)))
        for word in ("--uncalibrated", "--nkt=14"):
            chosen = options(word)
            chosen.wall = 0.04
            same = interpretation.interpret(path, chosen).layers[0].values[STRENGTH]
            self.assertAlmostEqual(same.best, strengths[1])


class Thin(WithFiles):
    """Strips, seams, and layers without rows."""

    def test_begins_below_a_boundary(self) -> None:
        """A boundary that would leave a layer without rows is none."""
        rows = "".join(
            f"{0.5 + z / 50:g},{0.05 if z < 4 else 5},0.5\n" for z in range(99)
        )
        path = self.written("depth_m,qc_MPa,fs_kPa\n" + rows.replace("5,0.5", "5,45"))
        found = interpretation.interpret(path, options())
        for e in found.layers:
            self.assertTrue(e.layer.rows.any())
        self.assertAlmostEqual(found.layers[-1].values[RESISTANCE].best, 5e6)

    def test_thin_strips_count(self) -> None:
        """Strips of other soil below 0.1 m stay in the estimate; a lens is named with
        its resistance."""
        for width, low, best in ((4, 10e6, 16e6), (10, 10e6, 10e6)):
            rows = []
            for i in range(300):
                is_strip = i > 100 and i % (2 * width) < width + (width == 4)
                q, ratio = (16, 0.05) if is_strip else (10, 0.008)
                rows.append(f"{i / 50:g},{q},{1e3 * q * ratio:g}")
            path = self.written("depth_m,qc_MPa,fs_kPa\n" + "\n".join(rows))
            found = interpretation.interpret(path, options("--tops", "0,2"))
            value = found.layers[1].values[RESISTANCE]
            self.assertAlmostEqual(value.best, best)
            said = "\n".join(tables.remarks(found))
            self.assertEqual("m with a q_c of 16 MPa" in said, width == 10)

    def test_seam_of_clay(self) -> None:
        """It is a layer, of the trough of its readings, and the same layers are found
        for a caisson that does not reach the end of the test."""
        z = np.arange(0, 10, 0.02)
        for top, bottom, spread, strength in (
            (3.2, 3.55, 4, 60),
            (3.2, 3.4, 2, 60),
            (5.02, 5.62, 5, 35),
        ):
            is_clay = (z >= top) & (z < bottom)
            sand = 22.5e3 * (np.maximum(5.7 * z, 1) / 100) ** 0.46
            tip = np.where(is_clay, 14 * strength + 19.3 * z, sand)
            tip = np.exp(gaussian_filter1d(np.log(tip), spread))
            ratio = gaussian_filter1d(np.where(is_clay, 4.5, 0.6), spread) / 100
            rows = zip(z, tip / 1e3, tip * ratio)
            text = "\n".join(",".join(f"{x:.5g}" for x in row) for row in rows)
            path = self.written("depth_m,qc_MPa,fs_kPa\n" + text)
            whole, part = (
                interpretation.interpret(path, options(), end) for end in (None, 7.5)
            )
            [seam] = [e for e in whole.layers if e.layer.kind == "clay"]
            self.assertAlmostEqual(seam.layer.top, top, delta=0.1)
            self.assertAlmostEqual(seam.layer.bottom, bottom, delta=0.1)
            found = seam.values[STRENGTH].best / 1e3
            self.assertAlmostEqual(found / strength, 1, delta=0.15)
            self.assertEqual({e.layer.kind for e in whole.layers}, {"sand", "clay"})
            for one, other in zip(whole.layers, part.layers):
                # the density of sand is that of the rows that count
                for name in set(one.values) - {DENSITY, REFERENCE}:
                    self.assertEqual(one.values[name], other.values[name])
                self.assertEqual(one.layer.top, other.layer.top)
            self.assertTrue(all(e.layer.top < 7.5 for e in part.layers))


class Strength(WithFiles):
    """Of clay over the depth."""

    def clay(
        self, strength: Callable[[float], float], noise: float = 0.0, end: float = 25.0
    ) -> interpretation.Interpretation:
        """Return a test in clay of a strength (kPa) over the depth (m)."""
        z = np.arange(0, end + 0.01, 0.05)
        chance = np.random.default_rng(1).standard_normal(len(z))
        s = np.array([strength(x) for x in z]) * (1 + noise * chance)
        u = 9.81 * z + 0.5 * 14 * s
        tip = 14 * s + 15.8 * z - 0.2 * u
        rows = [
            f"{a:.2f},{b:.5f},{c:.3f},{d:.2f}"
            for a, b, c, d in zip(z, tip / 1e3, s / 2, u)
        ]
        return interpretation.interpret(
            self.written(HEAD + "\n".join(rows)), options("--unit-weight", "15.8")
        )

    def test_lines(self) -> None:
        """Clay whose strength grows is one layer with a line, a crust another; clay of
        one strength has none; noise does not matter."""
        soils: list[tuple[Callable[[float], float], list[float]]] = [
            (lambda z: 1.5 + 1.35 * z, []),
            (lambda z: max(40 - 12 * z, 5 + 1.3 * z), [2.6]),
            (lambda z: 5 + 2 * z if z < 5 else 40 if z < 10 else 10 + 3 * z, [5, 10]),
            (lambda z: 60.0, []),
        ]
        for noise in (0.0, 0.1):
            for strength, edges in soils:
                found = self.clay(strength, noise)
                self.assertEqual({e.layer.kind for e in found.layers}, {"clay"})
                tops = [e.layer.top for e in found.layers][1:]
                np.testing.assert_allclose(np.array(tops), edges, atol=0.5)
                for e in found.layers:
                    value, gradient = e.values[STRENGTH].line("best", e.layer.top)
                    for share in (0.15, 0.5, 0.9):
                        z = e.layer.top + share * (e.layer.bottom - e.layer.top)
                        ratio = (value + gradient * z) / 1e3 / strength(z)
                        self.assertAlmostEqual(ratio, 1, delta=0.03 + 0.5 * noise)
        self.assertEqual(found.layers[0].values[STRENGTH].growth, 0)

    def test_crust_does_not_go_on(self) -> None:
        """A caisson that ends in it has the layer below it, too."""
        self.clay(lambda z: max(40 - 12 * z, 5 + 1.3 * z))
        told = options("--unit-weight", "15.8")
        layers = interpretation.interpret(self.path, told, 1.5).layers
        growths = [e.values[STRENGTH].growth for e in layers]
        self.assertLess(growths[0], 0)
        self.assertGreater(growths[1], 0)

    def test_texts(self) -> None:
        """Table, file and remarks have the line, and the modulus that a scene takes."""
        found = self.clay(lambda z: 1.5 + 1.35 * z)
        said = tables.text_of_test(found)
        self.assertIn("1.17 + 1.05 d / 1.5 + 1.35 d / 2.1 + 1.89 d", said)
        self.assertIn("0.45 + 0.405 d", said)
        self.assertIn("Young's modulus of clay: 300 s_u, from 150 to 600", said)
        self.assertNotIn("Schmertmann", said)
        self.assertRegex(said, r"\| 0\.\d\d / 0\.\d\d / 0\.\d\d +\|")  # q_c (MPa)
        tables.write(self.path, found.layers)
        with open(self.path, encoding="utf-8") as file:
            [row] = csv.DictReader(file)
        self.assertEqual(row["undrained_strength_kPa_best"], "1.5")
        self.assertEqual(row["undrained_strength_kPa_per_m_best"], "1.35")

    def test_small_digits(self) -> None:
        shown = tables.SHOWN[RESISTANCE]
        for value, text in (
            (17e3, "0.017 / 0.017 / 0.017"),
            (0.16e6, "0.16 / 0.16 / 0.16"),
            (12.34e6, "12.3 / 12.3 / 12.3"),
            (0.0, "0.0 / 0.0 / 0.0"),
        ):
            self.assertEqual(
                tables.text_of(Estimate(value, value, value), shown, 0), text
            )

    def test_scene(self) -> None:
        """Lines of strength and modulus, of all three estimates, and a K0 that the
        strength bears."""
        found = self.clay(lambda z: 1.5 + 1.35 * z)
        [layer] = cone.layers_of(found, 20.0)
        for depth in (0.0, 1.0, 13.0, 25.0):
            stress = max((15.8e3 - 9.81e3) * depth, 1.0)

            def at(name: str) -> float:
                value = value_at(layer.value(name), depth, stress)
                assert value is not None
                return value

            self.assertAlmostEqual(at("Cohesion"), 1500 + 1350 * depth, delta=60)
            self.assertAlmostEqual(at("Youngs modulus") / at("Cohesion"), 300, delta=3)
            low = 14 / 18 * at("Cohesion")
            self.assertLessEqual(abs(1 - at("K0")) * stress, 2 * low)
        for name, strength in (("low", 14 / 18), ("best", 1), ("high", 1.4)):
            [layer] = cone.layers_of(found, 20.0, name)
            value = value_at(layer.value("Cohesion"), 10.0, 1.0)
            assert value is not None
            self.assertAlmostEqual(value / 15e3 / strength, 1, delta=0.03)


class Above(WithFiles):
    """Soil above the first row that was measured."""

    def setUp(self) -> None:
        super().setUp()
        rows = [
            f"{z / 20:g},{0.5 * z ** 0.5:.4f},{3 * z ** 0.5:.3f}"
            for z in range(30, 160)
        ]
        self.written("depth_m,qc_MPa,fs_kPa\n" + "\n".join(rows))

    def test_assumed(self) -> None:
        """The first layer reaches up, with the estimates of its measured rows; scene
        and remarks say so."""
        found = interpretation.interpret(self.path, options("--tops", "0,4"))
        layer = found.layers[0].layer
        self.assertGreaterEqual(found.ground.depth[layer.rows].min(), 1.5)
        self.assertIn("ASSUMED: the soil above 1.5 m", "".join(tables.remarks(found)))
        entries = cone.layers_of(found, 6.0)
        said = [" ".join(e.remark for e in layer.entries) for layer in entries]
        self.assertIn(
            "ASSUMED above 1.5 m, where nothing was measured; FROM CPT", said[0]
        )
        self.assertNotIn("above", said[1])

    def test_given(self) -> None:
        """It is a layer of its own."""
        words = ["--above", "qc = 1 MPa, fs = 50 kPa"]
        found = interpretation.interpret(self.path, options(*words))
        first, second = (e.layer for e in found.layers[:2])
        self.assertEqual((first.bottom, first.kind, second.kind), (1.5, "clay", "sand"))
        said = " ".join(e.remark for e in cone.layers_of(found, 6.0)[0].entries)
        self.assertIn("FROM --above (nkt)", said)
        self.assertNotIn("FROM CPT (", said)

    def test_skirt_above_the_test(self) -> None:
        with self.assertRaisesRegex(
            InputError, "begins at 1.5 m, below the 1.2 m that"
        ):
            interpretation.interpret(self.path, options(), 1.2)


class Porosity(unittest.TestCase):
    """By the unit weight in water and of the wet soil."""

    def test_by_hand(self) -> None:
        """Half of the volume is grains of 2650 kg/m3: 8.09 kN/m3 in water."""
        grains, water = 2650 * 9.81, 1000 * 9.81
        weight = 0.5 * (grains - water) / 1e3
        self.assertAlmostEqual(porosity_of(weight, 2650, False), 0.5, places=6)
        wet = weight + water / 1e3
        self.assertAlmostEqual(porosity_of(wet, 2650, True), 0.5, places=6)


if __name__ == "__main__":
    unittest.main()
