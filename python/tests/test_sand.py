# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sizes of caissons, and sand by its density, in `caisson suggest`: the text of scenes
and studies. That the program accepts them is in tests/program/test_suggest.py."""
import argparse
import contextlib
import io
import re
import tempfile
import tomllib
import unittest
import unittest.mock
from itertools import product
from pathlib import Path

import numpy as np

from caisson import density_law, suggest
from caisson.paths import SCENES
from caisson.suggest import clay, cone, sand, sizes, trial, walls
from caisson.suggest.entry import Layer, SuggestError
from caisson.suggest.soil import layers_of
from caisson.design import interpretation
from caisson.design.assumed_cone import Sand, assumed_cone
from caisson.design.cone_estimates import K0
from caisson.design.correlations import DENSITY

EXAMPLE = SCENES / "cpt_example.csv"
KNOWN = ["Cohesion", "Friction angle", "K0", "Permeability", "Youngs modulus"]
KNOWN += [
    "Poisson ratio",
    "Solid density",
    "Dilatancy angle",
    "Law",
    "Porosity",
    density_law.DENSITY,
    density_law.DENSEST,
]
UNITS = dict.fromkeys(KNOWN, "") | {"Cohesion": "Pa", "Youngs modulus": "Pa"}
# not that of a user, who may have an own.prm where the tests run
SCENE = "scene_of_test_sand.prm"
SIZES = ["--diameter", "4", "--skirt", "2.5", "--wall", "20mm", SCENE]


def how_to_read(*words: str) -> argparse.Namespace:
    """Return the options that say how a cone test is read."""
    parser = argparse.ArgumentParser()
    interpretation.add_arguments(parser)
    return parser.parse_args(words)


READ = how_to_read()


def options_of(*words: str) -> argparse.Namespace:
    """Return the options of the command for a caisson of 4 m."""
    parser = argparse.ArgumentParser()
    suggest.add_arguments(parser)
    options = parser.parse_args([*SIZES, *words])
    suggest.check(options)
    return options


def layers_in(*words: str) -> list[Layer]:
    """Return the layers of the command."""
    options = options_of(*words)
    return layers_of(suggest.texts_of(options), UNITS, suggest.law_of(options))


def scene_in(*words: str) -> dict[str, str]:
    """Return the lines of a scene by entry."""
    text = suggest.scene_of(options_of(*words), layers_in(*words), Path("own.prm"))
    pairs = re.findall(r"set (.*?) *= (.*)", text)
    return {name: value for name, value in pairs}


class Bodies(unittest.TestCase):
    """Caissons of all sizes: their mesh, and sizes that cannot be meant."""

    def test_rows_that_the_travel_compresses(self) -> None:
        """The program finds 0.00398305 m after a travel of 0.53 m, below its limit, in
        a mesh 0.9 m deep for a diameter of 0.2 m, a skirt of 0.6 m and a wall of 8 mm.
        The mesh is so deep now that a third of each row is left. Where rows grow, with
        a wall of 40 mm, a travel of 5.5 m and a moving zone of 0.3 or 0.8 m, its rows
        are a little higher than those of suggest."""
        (row,) = sizes.rows_between([0.1, 0.865], 0.008, 0.013)
        self.assertAlmostEqual(row * (1 - 0.53 / 0.765), 0.00398305, delta=1e-8)
        for zone, known in ((0.3, 0.0188521), (0.8, 0.0674451)):
            (row,) = sizes.rows_between([zone, 8.5], 0.04, 0.4)
            self.assertTrue(0.8 < row * (1 - 5.5 / (8.5 - zone)) / known < 1)
        for ratio, share, error in product((0.1, 3, 6, 10), (1e-3, 0.1), sizes.LEVELS):
            for diameter in (0.05, 0.2, 3, 25):
                body = sizes.Body(diameter, ratio * diameter, share * diameter)
                sizes.check(body, None)
                end, level = 0.94 * body.skirt, sizes.LEVELS[error]
                tops = [0.0, body.skirt / 3]
                mesh = sizes.mesh_of(body, 0.0, end, level, tops)
                depth = -mesh.bottom - mesh.moving_zone
                self.assertLess(end / depth, 0.667, body)
                cell = max(mesh.cell_height, body.wall)
                self.assertLess(mesh.smallest_row, cell * (1 - end / depth))

    def test_the_bounds_themselves_are_allowed(self) -> None:
        """Ten diameters and a tenth of one, as decimals are rounded."""
        for d, skirt, wall in (
            ("0.2", "2", "8mm"),
            ("0.7", "0.07", "70mm"),
            ("0.3", "3", "0.03"),
            ("1.1", "11", "110mm"),
            ("0.6", "0.06", "6cm"),
        ):
            words = ["--diameter", d, "--skirt", skirt, "--wall", wall]
            options_of(*words, "--sand", "dense")
        options_of("--skirt", "810mm", "--penetration", "0.81", "--sand", "dense")
        for words in (["--skirt", "40.1"], ["--skirt", "0.399"], ["--wall", "401mm"]):
            with self.assertRaises(SuggestError):
                options_of(*words, "--sand", "dense")

    def test_sizes_that_cannot_be_meant(self) -> None:
        """Their unit is missing, or is another one."""
        steel = "the skirt alone weighs 42 kN"
        for words, said in (
            (["--wall", "0.02mm"], "below 1/5000 of the diameter"),
            (["--weight", "120"], steel),
            (["--weight", "120000kN"], steel),
            (["--weight", "40kN", "--water-depth", "30000"], "below 12000 m"),
            (["--diameter", "4mm"], "is not from 0.01 to 100 m"),
        ):
            with self.subTest(words), self.assertRaisesRegex(SuggestError, said):
                options_of(*words, "--sand", "dense")

    def test_layers_and_the_mesh(self) -> None:
        """What lies below the mesh is left out; what is too thin for it is refused."""
        words = [
            f"--layer={x}" for x in ("0: phi = 33", "3: su = 9 kPa", "30: phi = 33")
        ]
        with contextlib.redirect_stdout(io.StringIO()) as said:
            number = suggest.within_mesh(options_of(*words), layers_in(*words))
        self.assertEqual(number, 2)
        self.assertIn("from 30 m on lies below the mesh", said.getvalue())
        words = [
            f"--layer={x}" for x in ("0: phi = 33", "3: su = 9 kPa", "3.001: phi=33")
        ]
        with self.assertRaisesRegex(SuggestError, "from 3 to 3.001 m is thinner than"):
            scene_in(*words)

    def test_words_on_the_weight(self) -> None:
        """30 MN on a bucket of 8 m buckle a wall of 3 mm; 3 MN do not with 30 mm."""
        thin, thick = (sizes.Body(8, 6, wall) for wall in (3e-3, 30e-3))
        said = walls.words_on_weight(thin, 0.4, 30e6)
        self.assertRegex(said, "the wall buckles under the weight alone")
        self.assertEqual(walls.words_on_weight(thick, 0.4, 3e6), "")

    def test_a_trial_that_fails(self) -> None:
        """Nothing says that such a scene is valid, and none is written."""
        said = "a.prm has no wrong entry\nwarning: the first steps of the run fail: why"
        with unittest.mock.patch.object(trial, "query", return_value=said):
            with self.assertRaisesRegex(
                SuggestError, "first steps of the run fail: why"
            ):
                trial.cost_of(Path("own.prm"), "")


class Entries(unittest.TestCase):
    """What a scene has."""

    def test_dense(self) -> None:
        """e = 0.84 - 0.75 0.31 = 0.6075; 1650 9.81 / 1.6075 = 10.07 kN/m3; E is 60 MPa
        times 0.75."""
        lines = scene_in("--sand", "dense", "--weight", "1e5")
        expected = {
            "Law": density_law.LAW,
            density_law.DENSITY: "0.75",
            density_law.DENSEST: "0.53",
            density_law.LOOSEST: "0.84",
            density_law.CRITICAL_ANGLE: "33",
            density_law.MODULUS: "4.5e+07",
            density_law.REFERENCE_STRESS: "100000",
            density_law.EXPONENT: "0.5",
            density_law.REFERENCE_VOID_RATIO: "0.6075",
            "K0": "0.46",
            "Permeability": "1e-4",
            "Permeability by void ratio": "true",
            "Friction angle of the outer wall": "29",
            "Friction angle of the inner wall": "29",
        }
        for name, value in expected.items():
            self.assertEqual(lines[name].split(" # ")[0], value, name)
        self.assertIn("10.1 kN/m3", lines["Solid density"])
        for name in ("Porosity", "Cohesion", "Friction angle", "Dilatancy angle"):
            self.assertNotIn(name, lines)
        for name in expected:
            if name not in ("Law", density_law.REFERENCE_STRESS):
                marks = lines[name].partition("# ")[2]
                self.assertRegex(marks, "ASSUMED|that of the start", name)

    def test_what_is_given_is_not_assumed(self) -> None:
        (layer,) = layers_in("--layer", "0: sand = Very  Dense, K0 = 0.8")
        self.assertEqual(layer.value("K0"), "0.8")
        self.assertEqual(layer.value(density_law.DENSITY), "0.925")
        remarks = {entry.name: entry.remark for entry in layer.entries}
        self.assertEqual(remarks["K0"], "")
        (layer,) = layers_in("--density", "0.85")
        remarks = {entry.name: entry.remark for entry in layer.entries}
        self.assertEqual(remarks[density_law.DENSITY], "")

    def test_states_in_words(self) -> None:
        """In any spelling, and as all of a layer."""
        for text, density in (
            ("Sand = medium", "0.5"),
            ("Medium-dense", "0.5"),
            ("sand = very_loose", "0.075"),
            ("very dense sand, K0 = 0.8", "0.925"),
        ):
            (layer,) = layers_in("--layer", f"0: {text}")
            self.assertEqual(layer.value(density_law.DENSITY), density, text)

    def test_hypoplastic(self) -> None:
        lines = scene_in("--sand", "loose", "--law", "hypoplastic")
        self.assertTrue(lines["Law"].startswith(density_law.HYPOPLASTIC))
        self.assertTrue(lines[density_law.DENSITY].startswith("0.25"))
        self.assertNotIn(density_law.MODULUS, lines)
        self.assertNotIn(density_law.CRITICAL_ANGLE, lines)

    def test_denser_is_stiffer_and_heavier(self) -> None:
        found = [layers_in("--sand", word)[0] for word in sand.WORDS]
        moduli = [float(layer.value(density_law.MODULUS)) for layer in found]
        self.assertTrue(all(np.diff(moduli) > 0))

    def test_layers(self) -> None:
        """Words and numbers by layer, beside soil with one friction angle, of which the
        walls take the smaller friction."""
        other = "2: Friction angle = 30, Youngs modulus = 2e7"
        words = ["--layer", "0: Sand = loose", "--layer", "1: Relative density = 0.85"]
        layers = layers_in(*words, "--layer", other)
        laws = [layer.value("Law") for layer in layers]
        self.assertEqual(laws, [density_law.LAW] * 2 + ["Mohr-Coulomb"])
        self.assertEqual(walls.wall_friction_of(None, layers[:2]).value, "29")
        self.assertEqual(walls.wall_friction_of(None, layers).value, "20")
        self.assertEqual(walls.wall_friction_of(25, layers).value, "25")
        # a density that goes with a friction angle is only that of the start
        text = f"0: Relative density = 0.7, {other[3:]}"
        self.assertEqual(layers_in("--layer", text)[0].value("Law"), "Mohr-Coulomb")

    def test_scene_and_design_methods_have_the_same_sand(self) -> None:
        """A cone test of the resistance that is assumed for dense sand says that it is
        dense. K0 = 1 - sin phi of the test is not that of the scene."""
        assumed = assumed_cone((Sand(0, 10.07e3, 0.35, 0.75, 33),), 6)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "cone.csv")
            rows = zip(assumed.depth, assumed.resistance / 1e6)
            lines = [f"{z:.6f},{q:.6f}" for z, q in rows if z > 0.3]
            path.write_text("\n".join(["depth_m,qc_MPa", *lines]), encoding="utf-8")
            words = ["--soil", "sand", "--unit-weight", "19.88", "--tops", "0"]
            words.append("--uncalibrated")
            found = interpretation.interpret(path, how_to_read(*words))
        self.assertAlmostEqual(found.layers[0].values[DENSITY].best, 0.75, delta=0.01)


class FromACone(unittest.TestCase):
    """Sand by its density from the example of a cone test."""

    def test_sand_by_its_density(self) -> None:
        """Density, modulus, K0 and unit weight are those of the test."""
        found = interpretation.interpret(EXAMPLE, READ, 12.0)
        best = found.layers[0]
        layer = cone.layers_of(found, 8.0)[0]
        self.assertEqual(layer.value("Law"), density_law.LAW)
        self.assertEqual(layer.value("Friction angle"), "")
        names = density_law.DENSITY, density_law.DENSEST, density_law.LOOSEST
        share, densest, loosest = (float(layer.value(name)) for name in names)
        self.assertAlmostEqual(share, best.values[DENSITY].best, places=4)
        self.assertAlmostEqual(loosest - densest, 0.31, places=3)
        void_ratio = loosest - share * (loosest - densest)
        self.assertAlmostEqual(void_ratio / (1 + void_ratio), best.porosity(), places=3)
        start = float(layer.value(density_law.REFERENCE_VOID_RATIO))
        self.assertAlmostEqual(start, void_ratio, places=5)
        modulus = float(layer.value("Youngs modulus"))
        self.assertAlmostEqual(modulus / (60e6 * share), 1, places=3)
        self.assertAlmostEqual(float(layer.value("K0")), best.values[K0].best, places=3)
        remarks = {entry.name: entry.remark for entry in layer.entries}
        self.assertIn("FROM CPT (own-cone)", remarks[density_law.DENSITY])
        self.assertIn("FROM CPT (brinkgreve-2010)", remarks["Youngs modulus"])

    def test_estimates_of_density(self) -> None:
        """Density and modulus grow, and what they do not decide is the same."""
        found = interpretation.interpret(EXAMPLE, READ, 12.0)
        every = [cone.layers_of(found, 8.0, x) for x in ("low", "best", "high")]
        own = (density_law.DENSITY, density_law.REFERENCE_VOID_RATIO, "Youngs modulus")
        for layers in zip(*every):
            for name in (density_law.DENSITY, "Youngs modulus"):
                low, best, high = (float(layer.value(name)) for layer in layers)
                self.assertTrue(0 < low < best < high, name)
            others = [
                {e.name: e.value for e in x.entries if e.name not in own}
                for x in layers
            ]
            self.assertEqual(others[0], others[1])
            self.assertEqual(others[2], others[1])


class UnderSuction(unittest.TestCase):
    """With --weight."""

    def scene(self, *texts: str) -> dict[str, str]:
        """Return the entries of a scene under suction."""
        layers = [word for text in texts for word in ("--layer", text)]
        return scene_in("--weight", "100kN", "--water-depth", "20", *layers)

    def test_all_clay(self) -> None:
        """No water flows through it, so that it needs no permeability."""
        found = self.scene("0: su = 2 kPa + 1.5 kPa*z", "2: su = 5 kPa")
        self.assertEqual(found["Suction control"].split()[0], "required")
        self.assertEqual(found["Water depth"].split()[0], "20")
        self.assertEqual(found["End where infeasible"].split()[0], "0.25")
        for name in ("Level", "Permeability", "Drained outer side"):
            self.assertNotIn(name, found)

    def test_assumed_water_depth(self) -> None:
        """It is the default of the program, and marked."""
        found = scene_in("--weight", "100kN", "--layer", "0: su = 5 kPa")
        self.assertRegex(found["Water depth"], "^30 # ASSUMED")

    def test_clay_and_sand(self) -> None:
        """Also sand that only lies below the skirt is drained from its far side."""
        for texts in (
            ("0: dense", "1: su = 60 kPa", "2: dense"),
            ("0: su = 60 kPa", "9: dense"),
        ):
            found = self.scene(*texts)
            self.assertEqual(found["Level"].split()[0], "seepage")
            self.assertEqual(found["Drained outer side"].split()[0], "true")
            self.assertNotIn("Suction control", found)
        found = self.scene("0: dense")
        self.assertEqual(found["Level"].split()[0], "seepage")
        self.assertNotIn("Drained outer side", found)

    def test_permeability(self) -> None:
        """That of clay is assumed, also where that of sand is given."""
        soil = layers_in("--layer", "0: dense, k = 1e-3", "--layer", "1: su = 6 kPa")
        found = suggest.with_permeability(soil)
        self.assertEqual([x.value("Permeability") for x in found], ["1e-3", "1e-9"])
        soil = layers_in("--layer", "0: dense, k = 1e-3", "--layer", "1: loose")
        with self.assertRaisesRegex(SuggestError, "for all layers of sand, or for"):
            suggest.with_permeability(soil)


class Studies(unittest.TestCase):
    """Of the density."""

    def test_study(self) -> None:
        """It stays within 0 and 1, and the walls do not follow."""
        layers = layers_in("--density", "0.85")
        options = options_of("--density", "0.85", "--study", "study_of_test_sand.toml")
        content = tomllib.loads(suggest.study_of(options, layers))
        choices = content["parameters"]["relative density"]["choices"]
        self.assertEqual(list(choices), ["0.65", "0.75", "0.85", "0.95", "1"])
        entry = f"Soil/Layer 1/{density_law.DENSITY}"
        self.assertEqual(choices["0.65"], {entry: 0.65})
        self.assertIn("relative density", content["title"])

    def test_study_of_clay(self) -> None:
        """Clay becomes stronger and stiffer, alone or in step with sand."""
        clays = ["--layer", "0: su = 2 kPa + 1.5 kPa*z, E = 4 MPa"]
        options = options_of(*clays, "--study", "study_of_test_sand.toml")
        content = tomllib.loads(suggest.study_of(options, layers_in(*clays)))
        choices = content["parameters"]["strength"]["choices"]
        self.assertEqual(list(choices)[::2], ["0.7 su", "1 su", "1.3 su"])
        self.assertEqual(
            choices["0.7 su"],
            {
                "Soil/Layer 1/Cohesion": "0.7*(2000 + 1500*d)",
                "Soil/Layer 1/Youngs modulus": "0.7*(4000000)",
            },
        )
        both = [*clays, "--layer", "3: Dr = 85%"]
        content = tomllib.loads(suggest.study_of(options, layers_in(*both)))
        choices = content["parameters"]["relative density"]["choices"]
        self.assertEqual(len(choices["0.65"]), 3)


class Refusals(unittest.TestCase):
    """One clear line each."""

    def test_words_and_numbers(self) -> None:
        for words, said in (
            (["--sand", "densse"], "did you mean dense?"),
            (["--sand", "85"], "one of very loose, loose, medium dense, dense, very"),
            (["--sand", "clay"], 'clay is given by its strength, --layer "0: su ='),
            (["--density", "85"], "share of 1. Did you mean 0.85?"),
            (["--density", "-0.1"], "no number from 0 to 1"),
            (["--layer", "0: Relative density = 85"], "Did you mean 0.85?"),
            (["--layer", "0: Sand = dense, Cohesion = 2e4"], "has no Cohesion"),
            (["--layer", "0: Sand = dense, Friction angle = 40"], "no Friction angle"),
            (["--layer", "0: Sand = dense, Relative density = 0.8"], "needs one of"),
            (["--layer", "0: Law = Mohr-Coulomb, Sand = dense"], "goes with the laws"),
            (["--layer", f"0: Law = {density_law.LAW}"], "needs one of"),
            (["--layer", "0: Youngs modulus = 1e7"], '"Sand = dense"'),
            (["--sand", "dense", "--density", "0.8"], "give the soil: either"),
            (["--sand", "dense", "--layer", "0: Sand = loose"], "give the soil"),
            (["--sand", "dense", "--tops", "0,1"], "--tops is for a cone test"),
        ):
            with self.subTest(words=words), self.assertRaises(SuggestError) as caught:
                layers_in(*words)
            self.assertIn(said, str(caught.exception))


class Bounds(unittest.TestCase):
    """Where a mesh ends, and K0 of clay."""

    def test_bottom(self) -> None:
        """A diameter and a half below the tip, in whole meters."""
        body = sizes.Body(8.0, 20.0, 0.05)
        self.assertEqual(sizes.bottom_of(body, 19.0, 20.0, 1.0), 32.0)

    def test_rest_within_the_strength(self) -> None:
        """Clay of 10 kPa bears 95 % of 20 kPa beside 100 kPa: K0 is 0.81 at least."""
        self.assertEqual(clay.held(0.82, "10e3", [(5.0, 1e5)]), "0.82")
        bound = clay.held(0.80, "10e3", [(5.0, 1e5)])
        self.assertEqual(bound, "max(0.8, 1 - 1.9*(10e3)/s)")
        bound = clay.held(1.25, "10e3", [(5.0, 1e5)])
        self.assertEqual(bound, "min(1.2, 1 + 1.9*(10e3)/s)")


if __name__ == "__main__":
    unittest.main()
