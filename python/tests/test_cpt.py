# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests: files, formulas against numbers worked out by hand, layers, estimates,
and what goes into a scene."""
import contextlib
import csv
import io
import itertools
import re
import unittest
import warnings
from typing import TextIO, cast
from math import inf, log10

import numpy as np
from scipy.optimize import brentq

from caisson import __main__ as program
from caisson.terminal import PlainText
from caisson.design import cone_texts as tables
from caisson.paths import SCENES
from caisson.suggest import cone
from caisson.suggest.entry import SuggestError
from caisson.disk import InputError
from caisson.design import cone_file
from caisson.design import cone_layers as layers
from caisson.design import correlations
from caisson.design import interpretation
from caisson.design.cone_estimates import K0, REFERENCE, WEIGHT
from caisson.design.correlations import (
    ANGLE,
    BEST,
    DENSITY,
    HIGH,
    LOW,
    STRENGTH,
)
from caisson.design.density import bolton_angle
from caisson.design.expression import value_at
from caisson.design.ground import (
    ATMOSPHERE,
    Ground,
    ground_of,
    index_of,
    normalize,
    unit_weight_of,
)
from made_up_cone import HEAD, WithFiles, options

EXAMPLE = SCENES / "cpt_example.csv"


def uniform(resistance: float, stress: float, index: float = 1.8) -> Ground:
    """Return ground of one row with a resistance and a vertical effective stress (Pa),
    the total stress of which is twice that."""
    one = np.ones(1)
    return Ground(
        depth=one,
        resistance=resistance * one,
        friction=None,
        pore_pressure=None,
        remarks=(),
        tip=resistance * one,
        unit_weight=19e3 * one,
        total_stress=2 * stress * one,
        effective_stress=stress * one,
        normalized=one,
        friction_ratio=one,
        index=index * one,
    )


class Files(WithFiles):
    """Columns and rows of a file."""

    def test_units(self) -> None:
        """Each column in its own unit; what is not read is reported."""
        test = cone_file.read(
            self.written(
                "# mine\ndepth [m];fs (MPa);tilt_deg;qc_kPa;u2_Pa\n"
                "0;0;1;500;0\n1;0.02;1;4e3;9.8e3\n"
            )
        )
        np.testing.assert_allclose(test.depth, [0, 1])
        np.testing.assert_allclose(test.resistance, [0.5e6, 4e6])
        assert test.friction is not None and test.pore_pressure is not None
        np.testing.assert_allclose(test.friction, [0, 2e4])
        np.testing.assert_allclose(test.pore_pressure, [0, 9.8e3])
        self.assertEqual(test.remarks, ("columns that were not read: tilt_deg",))

    def test_wrong_rows(self) -> None:
        """One line, with the first and the numbers of others."""
        good = [f"{z / 20:g},1,5,0" for z in range(40)]
        for wrong, words in {
            "{},x,3,0": "'x' is no number",
            "{},-2,3,0": "cone resistance is -2 MPa",
            "{},5000,30,0": "check the unit in the heads",
            "0.2,5,30,0": "not below that of the row before",
            "500,5,30,0": "no length in meters",
        }.items():
            for places, others in (([10], r"\w$"), ([10, 20, 21], "2 more .*: 22, 23")):
                rows = list(good)
                for place in places:
                    rows[place] = wrong.format(place / 20)
                path = self.written(HEAD + "\n".join(rows))
                with self.assertRaises(InputError) as caught:
                    cone_file.read(path)
                said = str(caught.exception)
                self.assertRegex(said, r"mine.csv, row \d+: ")
                self.assertIn(words, said)
                self.assertNotIn("\n", said)
                self.assertRegex(said, others)

    def test_values_that_cannot_be_meant(self) -> None:
        """A few are left out, alone and with their number; many are refused."""
        for column, value, words in (
            ("fs", -50, "sleeve friction is -0.05 MPa"),
            ("fs", 1500, "sleeve friction of 1500 kPa is more than the cone resist"),
            ("u2", 30000, "pore pressure is 30 MPa"),
        ):
            for number in (1, 4, 5):
                rows = [[z / 20, 1, 5, 2] for z in range(40)]
                for row in rows[-number:]:
                    row[2 if column == "fs" else 3] = value
                text = "\n".join(",".join(f"{x:g}" for x in row) for row in rows)
                path = self.written(HEAD + text)
                if number > 4:
                    with self.assertRaisesRegex(InputError, f"row 37: .*{words}"):
                        cone_file.read(path)
                    continue
                test = cone_file.read(path)
                self.assertEqual(len(test.depth), 40)
                assert test.friction is not None and test.pore_pressure is not None
                np.testing.assert_allclose(test.friction, 5e3)
                self.assertLess(test.pore_pressure.max(), 20e3)
                self.assertIn(f"{value} kPa, which cannot be meant", str(test.remarks))
                self.assertIn(f"left out: {number}, those of", str(test.remarks))
        deep = "".join(f"{z / 20:g},9,50,-1200\n" for z in range(40))
        self.assertIn(
            "kept, 40", str(cone_file.read(self.written(HEAD + deep)).remarks)
        )

    def test_many_wrong_rows_are_counted(self) -> None:
        text = HEAD + "0,1,1,0\n" + "1,x,1,0\n" * 13
        with self.assertRaisesRegex(
            InputError, "12 more rows are wrong: 4, 5, 6, 7, .."
        ):
            cone_file.read(self.written(text))

    def test_wrong_heads(self) -> None:
        for head, words in {
            "depth_m,qc_lbs,fs_kPa": "'qc_lbs', the cone resistance, has no unit that",
            "depth_m,qc_MPa,fs": "'fs', the sleeve friction, has no unit",
            "depth_m,qc_MPa,qc_kPa": "two columns are the cone resistance",
            "depth_yd,qc_MPa,fs_kPa": "'depth_yd', the depth, has no unit .*'yd'",
        }.items():
            with self.assertRaisesRegex(InputError, words):
                cone_file.read(self.written(head + "\n0,1,1\n1,2,1\n"))

    def test_a_test_in_the_wrong_unit(self) -> None:
        """Megapascals below a head of pascals."""
        with self.assertRaisesRegex(InputError, "largest cone resistance is 12 Pa"):
            cone_file.read(self.written("depth_m,qc_Pa\n0,1\n1,12\n"))
        for friction in (0, 0.02):
            rows = "".join(f"{z / 10:g},{z + 1},{friction},0\n" for z in range(9))
            with self.assertRaisesRegex(InputError, "less than in any soil"):
                cone_file.read(self.written(HEAD + rows))

    def test_decimal_commas_among_commas(self) -> None:
        with self.assertRaisesRegex(InputError, "row 3: 5 cells, and 4 columns"):
            cone_file.read(self.written(HEAD + "0,1,5,0\n1,2,20,4,0\n"))
        # cells without a number at the end of rows, and rows of them, are no mistake
        test = cone_file.read(self.written(HEAD + "0,1,5,0,\n,,,\n1,2,20,4,,\n"))
        self.assertEqual(list(test.depth), [0, 1])


class ByHand(unittest.TestCase):
    """Formulas against numbers worked out on paper."""

    def test_relative_density(self) -> None:
        """D_r = 0.5 at 100 kPa: 2494 kPa 0.66667^0.46 exp(1.48) = 9.0917 MPa with
        K_0 = 0.5; 157 kPa 100^0.55 exp(1.205) = 6.5952 MPa."""
        k0 = np.array([0.5])
        for function, resistance in (
            (correlations.jamiolkowski, 9.0917e6),
            (correlations.baldi, 6.5952e6),
        ):
            found = function(uniform(resistance, 100e3), k0, BEST)
            np.testing.assert_allclose(found, [0.5], atol=5e-5)
        # ln 1.3 / 2.96 = 0.08864
        high = correlations.jamiolkowski(uniform(9.0917e6, 100e3), k0, HIGH)
        np.testing.assert_allclose(high, [0.58864], atol=5e-5)

    def test_friction_angle(self) -> None:
        """33 + 3 (0.8 (10 - ln 100) - 1)."""
        density = np.array([0.8])
        found = bolton_angle(density, np.array([100e3]))
        np.testing.assert_allclose(found, [42.94759], atol=1e-5)

    def test_friction_angle_at_a_tip(self) -> None:
        """D_r of 10 MPa and 100 kPa is that of K_0 = 1 - sin phi; the mean stress is
        the root of both, 1 MPa: phi = 33 + 3 (D_r (10 - ln 1000) - 1)."""
        ground = uniform(10e6, 100e3)
        names = correlations.chosen([])
        density = correlations.densities_of(ground, names, BEST)
        found = correlations.angles_of(ground, names, BEST)
        np.testing.assert_allclose(found, 30 + 3 * density * 3.0922447, atol=1e-5)
        # at least 2 degrees from the source, more with the scatter of D_r
        high = correlations.angles_of(ground, names, HIGH)
        self.assertGreater(float(high[0] - found[0]), 2.1)

    def test_modulus_by_density(self) -> None:
        """60 MPa times the density, at a mean stress of 100 kPa; low and high go with
        the density that answers the cone."""
        ground = uniform(10e6, 100e3)
        names = correlations.chosen(correlations.UNCALIBRATED)
        density = correlations.densities_of(ground, names, BEST)
        for end, factor in ((LOW, 1 / 1.5), (BEST, 1.0), (HIGH, 1.5)):
            found = correlations.reference_moduli(ground, names, end)
            np.testing.assert_allclose(found, factor * 60e6 * density)
        names = correlations.chosen([])
        for end in (LOW, BEST, HIGH):
            density = correlations.densities_of(ground, names, end)
            found = correlations.reference_moduli(ground, names, end)
            np.testing.assert_allclose(found, 60e6 * density)

    def test_undrained_strength(self) -> None:
        """(1 - 0.2) MPa over 18, 14 and 10."""
        ground = uniform(1e6, 100e3)
        found = [correlations.strengths_of(ground, {}, e)[0] for e in (LOW, BEST, HIGH)]
        np.testing.assert_allclose(found, [44444.44, 57142.86, 80000.0], rtol=1e-6)

    def test_unit_weight(self) -> None:
        """q_t = 10 MPa with 1 %: 9.81 (0.36 2 + 1.236) kN/m3."""
        found = unit_weight_of(np.array([10e6]), np.array([100e3]))
        np.testing.assert_allclose(found, [19188.36])

    def test_index(self) -> None:
        """sqrt(1.47^2 + 1.22^2) of Q_tn = 100 and F_r = 1 %; at 1 bar n does not
        matter; at half of that n is found, here by a solver for I_c."""
        np.testing.assert_allclose(index_of(np.array([100.0]), np.ones(1)), 1.910314)
        q, index = normalize(np.array([10e6]), np.array([ATMOSPHERE]), np.ones(1))
        np.testing.assert_allclose(q, [100])
        np.testing.assert_allclose(index, [1.910314], rtol=1e-6)

        def residual(ic: float) -> float:
            n = min(0.381 * ic + 0.05 * 0.5 - 0.15, 1)
            logarithm = log10(100 * 2**n)
            return float(ic - np.hypot(3.47 - logarithm, 1.22))

        _, index = normalize(np.array([10e6]), np.array([ATMOSPHERE / 2]), np.ones(1))
        np.testing.assert_allclose(index, [brentq(residual, 1, 4)], atol=1e-5)

    def test_stress_of_a_given_weight(self) -> None:
        """19 and 9.19 kN/m3 times 4 m; q_t has a fifth of u_2 more."""
        z = np.array([0.0, 1.0, 4.0])
        test = cone_file.Test(z, 1e6 + 0 * z, None, 1e5 * z, ())
        found = ground_of(test, 0.8, 19e3)
        np.testing.assert_allclose(found.total_stress, [0, 19e3, 76e3])
        np.testing.assert_allclose(found.effective_stress, [0, 9190, 36760])
        np.testing.assert_allclose(found.tip, [1e6, 1.02e6, 1.08e6])


class Layers(WithFiles):
    """Boundaries and kinds."""

    def test_the_division_is_the_best(self) -> None:
        """Of all that there are, tried one by one."""
        x = np.array([1.0, 1.1, 0.9, 1.6, 1.5, 1.7, 1.6, 0.8, 0.9, 0.7, 1.0, 1.2])
        shortest, most = 2, 4
        best, places = inf, [0]
        for count in range(most):
            for cuts in itertools.combinations(range(1, len(x)), count):
                edges = [0, *cuts, len(x)]
                if min(np.diff(edges)) < shortest:
                    continue
                parts = [x[a:b] for a, b in zip(edges, edges[1:])]
                total = sum(float(((p - p.mean()) ** 2).sum()) for p in parts)
                total += len(parts) * shortest * layers.STEP**2 / 2
                if total < best:
                    best, places = total, edges[:-1]
        self.assertEqual(
            layers.divide(layers.costs(x, shortest), shortest, most), places
        )
        self.assertEqual(places, [0, 3, 7, 10])

    def test_step_that_counts(self) -> None:
        """Two layers of the least thickness differ by STEP or are one."""
        for share, starts in ((0.9, [0]), (1.1, [0, 10])):
            x = np.repeat([1.0, 1.0 + share * layers.STEP], 10)
            found = layers.divide(layers.costs(x, 10), 10, 5)
            self.assertEqual(found, starts)

    def test_example(self) -> None:
        """Loose sand, from 3 m dense sand, with a lens of silt."""
        found = interpretation.interpret(EXAMPLE, options())
        first, second = (e.layer for e in found.layers)
        self.assertAlmostEqual(second.top, 3, delta=0.1)
        self.assertEqual((first.kind, second.kind), ("sand", "sand"))
        [(top, bottom, kind)] = first.lenses
        self.assertEqual(kind, "silt")
        self.assertTrue(1.7 <= top < bottom <= 2.05)
        self.assertEqual((second.lenses, first.bands, second.bands), ([], [], []))
        # the densities that it was made of, by Jamiolkowski et al.
        made = interpretation.interpret(EXAMPLE, options("--uncalibrated"))
        for e, density in zip(made.layers, (0.40, 0.78)):
            self.assertAlmostEqual(e.values[DENSITY].best, density, delta=0.04)

    def test_kinds(self) -> None:
        """Dense sand, clay, and silt between the two."""
        path = self.layered((4, 15, 0.5), (8, 0.6, 4.5), (12, 2.5, 3.0))
        found = interpretation.interpret(path, options())
        kinds = [e.layer.kind for e in found.layers]
        self.assertEqual(kinds, ["sand", "clay", "silt"])
        for e, top in zip(found.layers, (0, 4, 8)):
            self.assertAlmostEqual(e.layer.top, top, delta=0.1)
        sand, clay, silt = (e.values for e in found.layers)
        self.assertNotIn(STRENGTH, sand)
        self.assertNotIn(ANGLE, clay)
        self.assertTrue({ANGLE, STRENGTH} <= set(silt))

    def test_bands(self) -> None:
        """Cemented and soft sand in sand are reported, though they are no lens."""
        path = self.layered((4, 12, 0.5), (4.3, 90, 0.5), (8, 12, 0.5), (8.3, 2.5, 0.3))
        found = interpretation.interpret(path, options("--tops", "0"))
        self.assertEqual(found.layers[0].layer.lenses, [])
        bands = found.layers[0].layer.bands
        self.assertEqual([name for _, _, name in bands], ["hard", "soft"])
        for (top, bottom, _), wanted in zip(bands, ((4.05, 4.3), (8.05, 8.3))):
            self.assertAlmostEqual(top, wanted[0], delta=0.01)
            self.assertAlmostEqual(bottom, wanted[1], delta=0.01)
        text = tables.text_of_test(found)
        self.assertIn(
            "hard soil from 4.05 to 4.3 m, soft soil from 8.05 to 8.3 m", text
        )

    def test_gaps(self) -> None:
        """No layer lies in one: those beside it meet in its middle; scene and remarks
        say what was not measured."""
        for above, below in ((5, 15), (2, 15), (15, 4)):
            rows = [
                f"{z / 20:g},{above if z < 60 else below},{30 if above > 2 else 12},0"
                for z in (*range(1, 60), *range(90, 160))
            ]
            path = self.written(HEAD + "\n".join(rows))
            found = interpretation.interpret(path, options())
            tops = [e.layer.top for e in found.layers]
            self.assertEqual([t for t in tops if 2.9 < t < 4.6], [3.73])
            wanted = "ASSUMED: nothing was measured from 2.95 to 4.5 m; the soil"
            self.assertTrue(tables.remarks(found)[0].startswith(wanted))
            scene = cone.layers_of(found, 2.0)
            for i, (layer, top) in enumerate(zip(scene, tops)):
                words = " ".join(entry.remark for entry in layer.entries)
                is_beside = 3.73 in tops[i : i + 2]
                wanted = "ASSUMED from .* m, where nothing was measured; FROM CPT"
                self.assertEqual(re.search(wanted, words) is not None, is_beside, top)

    def test_given_soil(self) -> None:
        """Another kind than the test says is reported."""
        found = interpretation.interpret(EXAMPLE, options("--soil", "clay"))
        remarks = [
            r for r in tables.remarks(found) if "is taken as clay by --soil" in r
        ]
        self.assertEqual(len(remarks), len(found.layers))
        self.assertTrue(all(r.endswith("is that of sand") for r in remarks))

    def test_tops_below_the_test(self) -> None:
        """They are refused below its end, and do not count below what counts."""
        with self.assertRaisesRegex(InputError, "--tops 50: the test ends at"):
            interpretation.interpret(EXAMPLE, options("--tops", "0,50"))
        found = interpretation.interpret(EXAMPLE, options("--tops", "0,2,9"), 6.0)
        self.assertEqual([e.layer.top for e in found.layers], [0, 2])

    def test_given_tops(self) -> None:
        found = interpretation.interpret(EXAMPLE, options("--tops", "0,1,5.5"))
        self.assertEqual([e.layer.top for e in found.layers], [0, 1, 5.5])
        sparse = self.written(HEAD + "0.1,2,20,0\n10,5,30,0\n20,9,40,0\n")
        with self.assertRaisesRegex(InputError, "no row .* choose other --tops"):
            interpretation.interpret(sparse, options("--tops", "0,3,7"))
        for e in interpretation.interpret(sparse, options()).layers:
            self.assertTrue(e.layer.rows.any())
        many = ",".join(str(i) for i in range(21))
        for text in ("1,2", "0,3,2", many, "0,a"):
            with contextlib.redirect_stderr(io.StringIO()):
                with self.assertRaises(SystemExit):
                    options("--tops", text)


class Estimates(WithFiles):
    """Low, best and high."""

    def test_they_are_in_order(self) -> None:
        """For all correlations; low and high are not closer than the scatter."""
        for names in (list[str](), ["baldi-1986"]):
            words = [word for name in names for word in ("--correlation", name)]
            found = interpretation.interpret(EXAMPLE, options(*words), 9.0)
            for e in found.layers:
                for name, value in e.values.items():
                    self.assertLessEqual(value.low, value.best, name)
                    self.assertLessEqual(value.best, value.high, name)
                if names:
                    modulus = e.values[REFERENCE]
                    self.assertGreater(modulus.high / modulus.best, 1.3)
            if not names:
                angle = found.layers[0].values[ANGLE]
                # 2 degrees from the source, more with the scatter of D_r
                self.assertGreaterEqual(angle.high - angle.best, 2.2)
                rest = found.layers[0].values[K0]
                expected = 1 - np.sin(np.radians(angle.best))
                self.assertAlmostEqual(rest.best, expected, places=2)

    def test_no_variation_leaves_the_errors(self) -> None:
        """In ground of one density low and high answer 11 % less and more."""
        rows = [f"{z:.2f},{(0.0919 * z) ** 0.46 * 9:.5f}" for z in np.arange(1, 9, 0.1)]
        path = self.written("depth_m,qc_MPa\n" + "\n".join(rows))
        words = ["--soil", "sand", "--unit-weight", "19", "--tops", "0"]
        [one] = interpretation.interpret(path, options(*words)).layers
        density = one.values[DENSITY]
        for end in (density.low, density.high):
            self.assertTrue(0.02 < abs(end - density.best) < 0.05, density)
        # 25.9965 (1 - n) + 9.81 n = 19, in kN/m3, of quartz with 2650 kg/m3
        self.assertAlmostEqual(one.porosity(), 0.43224, places=4)
        self.assertAlmostEqual(one.values[WEIGHT].best, 19e3)

    def test_what_must_be_said(self) -> None:
        path = self.written("depth_m,qc_MPa\n0,1\n1,2\n2,3\n")
        for words, said in (
            (list[str](), "no sleeve friction .* --soil sand and --unit-weight 19"),
            (["--soil", "sand"], "give it, or --unit-weight 19"),
            (["--soil", "sand", "--unit-weight", "9"], "wet soil in kN/m3"),
        ):
            with self.assertRaisesRegex(InputError, said):
                interpretation.interpret(path, options(*words))
        with self.assertRaisesRegex(InputError, "--area-ratio 2 is not"):
            interpretation.interpret(EXAMPLE, options("--area-ratio", "2"))
        density = ["--correlation", "baldi-1986"]
        for other in (["--uncalibrated"], ["--correlation", "own-cone"]):
            with self.assertRaisesRegex(InputError, "the same quantity twice"):
                interpretation.interpret(EXAMPLE, options(*density, *other))


class Scenes(WithFiles):
    """What goes into a scene and into its study."""

    def test_entries_say_where_they_come_from(self) -> None:
        found = interpretation.interpret(EXAMPLE, options(), 12.0)
        first = cone.layers_of(found, 8.0)[0]
        modulus = found.layers[0].values[REFERENCE].best
        at_top = value_at(first.value("Youngs modulus"), 0.0, 0.0) or 0.0
        self.assertAlmostEqual(at_top / modulus, 1, 3)
        remarks = {entry.name: entry.remark for entry in first.entries}
        self.assertIn("FROM CPT (own-cone)", remarks["Relative density"])
        self.assertIn("ASSUMED", remarks["Solid density"])
        others = interpretation.interpret(EXAMPLE, options("--uncalibrated"), 12.0)
        remarks = {e.name: e.remark for e in cone.layers_of(others, 8.0)[0].entries}
        self.assertIn("FROM CPT (jamiolkowski-2003)", remarks["Relative density"])

    def test_silt_is_refused(self) -> None:
        """Where the skirt reaches it, with a way out that the command has."""
        path = self.layered((5, 15, 0.5), (12, 2.5, 3.0))
        found = interpretation.interpret(path, options("--tops", "0,5"))
        said = "layer 2, 5 to 12 m, is silt.* Say it: --soil 2=sand .* does not$"
        with self.assertRaisesRegex(SuggestError, said):
            cone.layers_of(found, 6.0)
        cone.layers_of(found, 4.0)
        for kind in ("sand", "clay"):
            told = options("--tops", "0,5", "--soil", f"2={kind}")
            found = interpretation.interpret(path, told)
            self.assertEqual(found.layers[1].layer.kind, kind)
            self.assertEqual(len(cone.layers_of(found, 6.0)), 2)

    def test_no_strength_is_refused(self) -> None:
        """Clay whose cone resistance is below the total vertical stress."""
        path = self.layered((5, 15, 0.5), (12, 0.03, 4.5))
        words = ["--tops", "0,5"]
        found = interpretation.interpret(path, options(*words))
        with self.assertRaisesRegex(
            SuggestError, "layer 2, 5 to 12 m, has no strength"
        ):
            cone.layers_of(found, 4.0)

    def test_end_of_test(self) -> None:
        found = interpretation.interpret(EXAMPLE, options())
        self.assertEqual(cone.end_of_test(found, 8.0), "")
        self.assertIn("ends at 20 m", cone.end_of_test(found, 21.0))

    def test_clay_is_never_sand(self) -> None:
        """It is undrained, and its walls have adhesion in the place of friction."""
        path = self.layered((5, 15, 0.5), (12, 0.6, 4.5))
        found = interpretation.interpret(path, options("--tops", "0,5"))
        _, clay = cone.layers_of(found, 6.0)
        self.assertEqual(clay.value("Friction angle of the walls"), "0")
        self.assertEqual(clay.value("Adhesion factor of the walls"), "0.5")
        self.assertEqual(clay.value("Friction angle"), "0")
        value = value_at(clay.value("Cohesion"), 5.0, 1.0)
        assert value is not None
        strength = found.layers[1].values[STRENGTH].best  # at the top
        self.assertAlmostEqual(value, strength, delta=100)
        low, high = (
            value_at(cone.layers_of(found, 6.0, x)[1].value("Cohesion"), 8.0, 1.0) or 0
            for x in ("low", "high")
        )
        self.assertLess(low, high)


class Command(WithFiles):
    """The command without a caisson."""

    def call(self, *words: str) -> tuple[int, str]:
        """Return status and words of `caisson cpt`."""
        said = io.StringIO()
        plain = cast(TextIO, PlainText(said))  # as end_process() sets it
        with contextlib.redirect_stdout(plain), contextlib.redirect_stderr(plain):
            status = program.main(["cpt", *words])
        return status, said.getvalue()

    def test_files(self) -> None:
        out = self.path.parent / "out"
        named = self.path.parent / "a\x1b[31m.csv"  # which would color the terminal
        named.write_bytes(EXAMPLE.read_bytes())
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # as of letters that no picture has
            status, said = self.call(str(named), "--out", str(out))
        self.assertEqual(status, 0, said)
        self.assertIn(r"a\x1b[31m.csv: low", said)
        self.assertNotIn("\x1b", said + self.call("none\x1b[31m.csv")[1])
        self.assertIn("bolton-1986-tip", said)
        self.assertIn("layer 1 has silt from", said)
        self.assertGreater((out / "cpt.png").stat().st_size, 20000)
        with open(out / "layers.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["layer"] for row in rows], ["1", "2"])
        low, best, high = (
            float(rows[1][f"friction_angle_deg_{end}"])
            for end in ("low", "best", "high")
        )
        self.assertTrue(low < best < high)

    def test_refusals(self) -> None:
        wrong = self.written(HEAD + "0.1,1,1,0\n0,2,1,0\n1,2,1,0\n")
        for words, said in (
            ([str(wrong)], "row 3: the depth of 0 m"),
            (list[str](), "give the file"),
            ([str(EXAMPLE), "--run"], "--run needs a caisson"),
            ([str(EXAMPLE), "--wall", "40mm"], "--diameter and --skirt are missing"),
            (["none.csv"], "none.csv cannot be read"),
        ):
            status, text = self.call(*words)
            self.assertEqual(status, 1)
            self.assertIn(said, text)
        self.assertIn("bolton-1986-tip", self.call("--list")[1])


if __name__ == "__main__":
    unittest.main()
