# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers with units, symbols of layers, and what the command line says of mistakes."""
import argparse
import contextlib
import io
import unittest

from caisson import paths, suggest
import caisson.__main__
from caisson.suggest import clay, walls
from caisson.suggest.entry import Layer, SuggestError
from caisson.suggest.soil import LAWS, layer_of
from caisson.design.expression import value_at, without_unit
from caisson.design.quantity import angle_of_friction, length, number, value_of

KNOWN = {
    "Law": "",
    "Friction angle": "degrees",
    "Dilatancy angle": "degrees",
    "Cohesion": "Pa",
    "Youngs modulus": "Pa",
    "Poisson ratio": "",
    "Porosity": "",
    "Void ratio": "",
    "Solid density": "kg/m3",
    "Dry density": "kg/m3",
    "Relative density": "",
    "Overconsolidation ratio": "",
    "Permeability": "m/s",
    "K0": "",
    **{name: "" for entries in LAWS.values() for name in entries},
    "Active strength": "Pa",
    "Youngs modulus": "Pa",
}


class Numbers(unittest.TestCase):
    """Numbers and expressions with units."""

    def test_units(self) -> None:
        for text, unit, value in (
            ("40mm", "m", 0.04),
            ("0.04", "m", 0.04),
            ("45 MPa", "Pa", 45e6),
            ("25e6", "Pa", 25e6),
            ("2.5e1MN/m²", "Pa", 25e6),
            ("2500kN", "N", 2.5e6),
            ("8500 N/m3", "kN/m3", 8.5),
            ("85 %", "", 0.85),
            ("33°", "degrees", 33.0),
            ("1e-3 cm/s", "m/s", 1e-5),
            ("-.5", "", -0.5),
            ("10 ft", "m", 3.048),
            ("2 tsf", "Pa", 191521.04),
            ("100 mbar", "Pa", 1e4),
        ):
            self.assertEqual(value_of(text, unit), value, text)

    def test_refusals(self) -> None:
        for text, unit, words in (
            ("0,75", "", "decimal comma; write 0.75"),
            ("9,5 m", "m", "write 9.5 m"),
            ("45 MPa", "N", "'MPa' is no unit of it; known: N, kN, MN"),
            ("45 pis", "Pa", "'pis' is no unit"),
            ("4 5", "Pa", "is no number"),
            ("x", "Pa", "is no number"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                value_of(text, unit)
        with self.assertRaisesRegex(argparse.ArgumentTypeError, "no unit of it"):
            number("N")("3 t")
        with self.assertRaisesRegex(argparse.ArgumentTypeError, "no length"):
            length("4 inch")

    def test_expressions(self) -> None:
        """A unit behind one multiplies all of it; without one nothing changes."""
        for text, expected in (
            ("45 MPa", "45000000"),
            ("(20 + 5*d) MPa", "1e+06*(20 + 5*d)"),
            ("20 + 5*d + 3 kPa", "1000*(20 + 5*d + 3)"),
            ("max(5e3, 2e3*d) kPa", "1000*(max(5e3, 2e3*d))"),
            ("max(5e3, 2e3*d)", "max(5e3, 2e3*d)"),
            ("2e3*d", "2e3*d"),
            ("25e6", "25e6"),
            ("Mohr-Coulomb", "Mohr-Coulomb"),
        ):
            self.assertEqual(without_unit(text, "Pa"), expected)
        with self.assertRaisesRegex(ValueError, "'kN' is no unit of it"):
            without_unit("(20 + 5*d) kN", "Pa")

    def test_units_within_an_expression(self) -> None:
        """Of a sum each term has its unit, or one at the end is that of all; z is d,
        and products need no sign."""
        of_clay = {"su": "1000*(2+1.5*d)"}
        for text, expected in (
            ("20+2*d kPa", "1000*(20+2*d)"),
            ("20 kPa + 1.5*d kPa", "20000 + 1.5*d*1000"),
            ("20 kN/m² + 1.5 kN/m2 * z", "20000 + 1500 * d"),
            ("2 kPa + 1.5 kPa/m z", "2000 + 1500*d"),
            ("(2 + 1.5z) kPa", "1000*(2 + 1.5*d)"),
            ("2 kPa + 1.5*z kPa/m", "2000 + 1.5*d*1000"),
            ("1.5 kN/m3*z", "1500*d"),
            ("2 kPa + z * 1.5 kN/m³", "2000 + d * 1500"),
            ("2 kPa + 3 kPa", "5000"),
            ("(2 + 3) kPa", "5000"),
            ("5 kPa + max(0, z - 2)*1.5 kPa", "5000 + max(0, d - 2)*1500"),
            ("max(5 kPa, 0.25 s)", "max(5000, 0.25*s)"),
            ("200 su", "200*(1000*(2+1.5*d))"),
            ("3 MPa + 100*su", "3000000 + 100*(1000*(2+1.5*d))"),
        ):
            self.assertEqual(without_unit(text, "Pa", of_clay), expected, text)
        for text, said in (
            ("max(20 kPa, 2*d) kPa", "2[*]d has no unit"),
            ("20 kPa + 2*d", "2[*]d has no unit"),
            ("(2 + 0.25*s) kPa", "2 has no unit"),
            ("su*su", "once in each term"),
            ("(d^() kPa", r"'\(d\^\(\) kPa' is no expression"),
            ("2 kPa + (3 kPa", "is no expression"),
            ("2 kPa + d*", "is no expression"),
            ("(1e999) kPa", "has a number that is too large"),
            ("2 kPa + 1.5 kPa/m", "kPa/m needs [*]z"),
            ("2 kPa + 1.5 kPa*h", "'h' is no variable; d, or z, is the depth below"),
        ):
            with self.assertRaisesRegex(ValueError, said):
                without_unit(text, "Pa", of_clay)
        for text in ("by porosity", "auto", "1e6, 0.3, q"):
            self.assertEqual(without_unit(text, ""), text)

    def test_values_of_expressions(self) -> None:
        """At 4 m under 30 kPa."""
        for text, value in (
            ("1000*(2 + 1.5*d)", 8e3),
            ("max(5e3, 0.25*s)", 7.5e3),
            ("if(d < 2, 1, 3)^2", 9.0),
            ("d ? 1 : 2", None),
            ("1/(d - 4)", None),
        ):
            self.assertEqual(value_at(text, 4, 30e3), value, text)

    def test_tangents(self) -> None:
        """A friction angle of 0.5 without a unit is asked for."""
        self.assertEqual(
            [angle_of_friction(x) for x in ("25", "0.5deg", "0")], [25, 0.5, 0]
        )
        with self.assertRaisesRegex(
            argparse.ArgumentTypeError, "write 26.6; .* 0.5deg"
        ):
            angle_of_friction("0.5")


class Layers(unittest.TestCase):
    """Entries of a layer as engineers write them."""

    def layer(self, text: str) -> Layer:
        """Return the layer of a text."""
        return layer_of(text, KNOWN, "density")

    def test_symbols(self) -> None:
        """E is not e, and long names stay."""
        layer = self.layer(
            "2.5 m: phi' = 39, E = 45 MPa, nu=0.3, psi = 5, c = 1kPa, k = 1e-3 cm/s,"
            " OCR = 2, k0 = 0.5, e = 0.6"
        )
        self.assertEqual(layer.top, 2.5)
        for name, value in {
            "Friction angle": "39",
            "Youngs modulus": "45000000",
            "Poisson ratio": "0.3",
            "Dilatancy angle": "5",
            "Cohesion": "1000",
            "Permeability": "1e-05",
            "Overconsolidation ratio": "2",
            "K0": "0.5",
            "Void ratio": "0.6",
        }.items():
            self.assertEqual(layer.value(name), value, name)
        self.assertEqual(self.layer("0: Dr = 85%").value("Relative density"), "0.85")

    def test_symbols_of_other_laws(self) -> None:
        """The same symbol is another entry in another law, with its unit."""
        for text, expected in (
            (
                "suA = 0.02 MPa, gamma_fD = 3 %, suP/suA = 0.4, law = NGI-ADP",
                {
                    "Active strength": "20000",
                    "Direct shear failure strain": "0.03",
                    "Passive strength ratio": "0.4",
                },
            ),
            (
                "Law = NGI-ADP, suA = 20 kPa, Gur/suA = 400, gamma = 9 kN/m3",
                {"Unloading shear modulus ratio": "400", "Porosity": "0.4440"},
            ),
        ):
            layer = self.layer(f"0: {text}")
            for name, value in expected.items():
                self.assertEqual(layer.value(name), value, name)
        with self.assertRaisesRegex(SuggestError, "no entry 'suA'"):
            self.layer("0: phi = 33, E = 20 MPa, suA = 20 kPa")
        with self.assertRaisesRegex(
            SuggestError, "Active strength = '20 m': 'm' is no unit"
        ):
            self.layer("0: Law = NGI-ADP, suA = 20 m")

    def test_assumed_of_other_laws(self) -> None:
        """What is not given is in the scene, and marked; what must be given is not."""
        layer = self.layer("0: Law = NGI-ADP, suA = 20 kPa, e = 1.1")
        marks = {entry.name: entry.remark for entry in layer.entries}
        self.assertEqual(layer.value("Direct shear strength ratio"), "0.7")
        self.assertEqual(layer.value("Poisson ratio"), "0.45")
        for name in ("Direct shear strength ratio", "Poisson ratio", "K0"):
            self.assertIn("ASSUMED", marks[name])
        for name in ("Active strength", "Void ratio", "Law"):
            self.assertEqual(marks[name], "")
        self.assertNotIn("Porosity", marks)
        with self.assertRaisesRegex(SuggestError, "needs Active strength$"):
            self.layer("0: Law = NGI-ADP")

    def test_names_of_laws(self) -> None:
        """Case, spaces and hyphens do not matter; symbols are those of the law."""
        for word, law in (
            ("NGI ADP", "NGI-ADP"),
            ("ngiadp", "NGI-ADP"),
            ("mohr-coulomb", "Mohr-Coulomb"),
        ):
            given = "E = 50 MPa, phi = 30, e = 0.7"
            if law == "NGI-ADP":
                given = "suA = 20 kPa, sD/suA = 0.8, sP/suA = 0.6"
            self.assertEqual(self.layer(f"0: Law = {word}, {given}").value("Law"), law)
        stiff = self.layer("0: Gur/suA = 50*(1+2*d), suA = 20 kPa, Law = ngi-adp")
        name = "Unloading shear modulus ratio"
        self.assertEqual(stiff.value(name), "50*(1+2*d)")
        with self.assertRaisesRegex(SuggestError, "of NGI-ADB .*law may be NGI-ADP"):
            self.layer("0: Law = NGI-ADB, suA = 20 kPa")

    def test_foreign_strength(self) -> None:
        """Clay by anisotropic strength takes no other."""
        for text, said in (
            ("su = 15 kPa", "takes no su; give suA and suD/suA"),
            ("phi = 5", "takes no phi; give suA"),
            ("c = 2 kPa", "takes no c; give suA"),
        ):
            with self.assertRaisesRegex(SuggestError, said):
                self.layer(f"0: Law = NGI-ADP, suA = 20 kPa, {text}")

    def test_walls_of_other_laws(self) -> None:
        """NGI-ADP is undrained clay."""
        clay = self.layer("0: Law = NGI-ADP, suA = 20 kPa")
        sand = self.layer("0: phi = 33, E = 50 MPa")
        self.assertEqual(walls.wall_friction_of(None, [sand]).value, "22")
        self.assertEqual(walls.wall_friction_of(None, [clay]).value, "0")
        found = suggest.with_permeability([clay, sand])
        conduct = [layer.value("Permeability") for layer in found]
        self.assertEqual(conduct, ["1e-9", "1e-4"])
        self.assertEqual(suggest.angle_after(sand, -4), 29)
        with self.assertRaisesRegex(SuggestError, "no friction angle"):
            suggest.angle_after(clay, 4)

    def test_walls_of_mixed_ground(self) -> None:
        """Clay adheres and sand rubs, each by itself; --wall-friction is that of sand,
        and 0 that of all."""
        clay = self.layer("0: su = 20 kPa")
        other = self.layer("0: su = 20 kPa, alpha = 0.3")
        sand = self.layer("0: phi = 36, E = 20 MPa")
        grows = self.layer("0: phi = 30 + d, E = 20 MPa")
        dense = self.layer("0: dense sand")
        mixed = [clay, other, sand, grows, dense]
        self.assertEqual(walls.wall_friction_of(None, mixed).value, "0")
        for given, angles, factors in (
            (None, ["0", "0", "24", "2/3*(30 + d)", "29"], ["0.5", "0.3", "", "", ""]),
            (25.0, ["0", "0", "", "", ""], ["0.5", "0.3", "", "", ""]),
            (0.0, ["", "", "", "", ""], ["", "0.3", "", "", ""]),
        ):
            found = walls.with_walls(mixed, given, mixed)
            self.assertEqual([x.value(walls.FRICTION) for x in found], angles)
            self.assertEqual([x.value(walls.ADHESION) for x in found], factors)
        # of clay alone the body has the angle 0, and of sand alone one for all
        for layers, angles, angle in (
            ([clay, other], ["", ""], "0"),
            ([sand, dense], ["", ""], "24"),
            ([grows], ["2/3*(30 + d)"], "0"),
        ):
            found = walls.with_walls(layers, None, layers)
            self.assertEqual([x.value(walls.FRICTION) for x in found], angles)
            self.assertEqual(walls.wall_friction_of(None, layers).value, angle)
        # clay below the planned depth adheres, too
        found = walls.with_walls([sand, clay], None, [sand])
        self.assertEqual([x.value(walls.FRICTION) for x in found], ["", "0"])
        with self.assertRaisesRegex(SuggestError, "clay, which adheres: give alpha"):
            walls.wall_friction_of(25, [clay])

    def test_quick_clay_under_suction(self) -> None:
        """A small angle does not make sand of clay, and the message has the way out."""
        quick = self.layer("0: phi = 1, c = 60 kPa, E = 12 MPa")
        with self.assertRaisesRegex(SuggestError, "undrained clay as su = 60000 Pa"):
            suggest.refuse_quick_clay([quick])
        for text in (
            "phi = 25, c = 5 kPa, E = 2 MPa",
            "phi = 30, E = 2 MPa",
            "su = 6 kPa",
        ):
            suggest.refuse_quick_clay([self.layer(f"0: {text}")])

    def test_unit_weight(self) -> None:
        """In water or of the wet soil: 1 - 8.5 / (2.65 - 1) / 9.81."""
        for weight in ("8.5 kN/m3", "18.31 kN/m³", "8500 N/m3"):
            layer = self.layer(f"0: phi = 33, E = 20 MPa, gamma = {weight}")
            self.assertAlmostEqual(float(layer.value("Porosity")), 0.4749, 4)
        remark = [e.remark for e in layer.entries if e.name == "Porosity"][0]
        self.assertEqual(remark, " # 8.5 kN/m3 in water")

    def test_doubtful_unit_weight(self) -> None:
        """That of light wet soil, or of dense soil in water: 16.19 kN/m3 (1 - n)."""
        for weight, taken, other in (
            ("12", "in water, with a porosity of 0.26", "Porosity = 0.86"),
            ("13.5", "wet soil, with a porosity of 0.77", "Porosity = 0.17"),
        ):
            layer = self.layer(f"0: phi = 33, E = 2 MPa, gamma = {weight} kN/m3")
            self.assertRegex(layer.warning, f"{taken}; if .*, give {other}")
        for weight in ("11.4", "14.1"):
            layer = self.layer(f"0: phi = 33, E = 2 MPa, gamma = {weight} kN/m3")
            self.assertEqual(layer.warning, "")

    def test_not_assumed(self) -> None:
        """What another entry replaces."""
        for given, replaced in (
            ("e = 0.6", "Porosity"),
            ("Dr = 0.6", "Porosity"),
            ("Dry density = 1600", "Solid density"),
        ):
            plain = "0: phi = 33, E = 2 MPa"
            self.assertTrue(self.layer(plain).value(replaced))
            self.assertEqual(self.layer(f"{plain}, {given}").value(replaced), "")

    def test_undrained_strength(self) -> None:
        grows = self.layer("0: su = (20+2*d) kPa, E = 4 MPa")
        self.assertEqual(grows.value("Cohesion"), "1000*(20+2*d)")
        layer = self.layer("0: su = 20 kPa, E = 4 MPa")
        self.assertEqual(layer.value("Cohesion"), "20000")
        self.assertEqual(layer.value("Friction angle"), "0")
        self.assertEqual(layer.value("Poisson ratio"), "0.45")
        for text in ("su = 2 kPa + 1.5 kPa*z", "phi = 0, c = 2 kPa + 1.5 kPa*z"):
            layer = self.layer(f"0: {text}")
            self.assertEqual(layer.value("Cohesion"), "2000 + 1500*d")
            self.assertEqual(layer.value("Youngs modulus"), "300*(2000 + 1500*d)")
        for text in ("E = 300 su, su = 20 kPa", "cu = 20 kPa, E = 300*cu"):
            self.assertEqual(
                self.layer(f"0: {text}").value("Youngs modulus"), "300*(20000)"
            )

    def test_values_that_no_soil_has(self) -> None:
        """Their unit is missing, or another one: what may be meant is said."""
        for text, said in (
            ("phi = 33, E = 20", "did you mean 20 MPa"),
            ("phi = 33, E = 30000", "did you mean 30000 kPa"),
            ("su = 60 kPa, E = 30", "did you mean 30 MPa"),
            ("su = 60 Pa, E = 200", "Youngs modulus = 200 Pa is outside"),
            ("su = 20 Pa", "did you mean 20 kPa"),
            ("phi = 33, E = 20 MPa, c = 5", "did you mean 5 kPa"),
            ("phi = 33, E = 20 MPa, n = 40", "did you mean 40%"),
            ("phi = 33, E = 20 MPa, k = 1e3", "Permeability = 1000 m/s is outside"),
            ("phi = 33, E = 20 MPa, OCR = 0.5", "is outside 1 to 200"),
            ("phi = 33, E = 20 MPa, Solid density = 2.65", "is outside 1500 to 6000"),
        ):
            with self.subTest(text), self.assertRaisesRegex(SuggestError, said):
                self.layer(f"0: {text}")
        for text in ("su = 0.1 kPa", "phi = 33, E = (1 + 2*d) MPa, c = 100"):
            self.layer(f"0: {text}")

    def states(self, end: float, floor: float, *texts: str) -> list[tuple[float, str]]:
        """Return unit weight in water (kN/m3) and K0 of each layer."""
        layers = [self.layer(text) for text in texts]
        return [
            ((1 - float(layer.value("Porosity"))) * 1.65 * 9.81, layer.value("K0"))
            for layer in clay.with_states(layers, end, floor)
        ]

    def test_state_of_clay(self) -> None:
        """Soft clay is light and has a K0 of about 0.6; stiff clay has more of both. K0
        is not that which the strength does not bear."""
        ((weight, k0),) = self.states(5, 8, "0: su = 1 kPa + 1.4 kPa*d")
        self.assertTrue(5 <= weight <= 7, weight)
        self.assertAlmostEqual(float(k0), 0.72, delta=0.08)
        ((stiff, k0),) = self.states(5, 8, "0: su = 100 kPa")
        self.assertTrue(7 < stiff < 10, stiff)
        self.assertEqual(k0, "1.5")
        # su/sigma'_v of 0.22 is normally consolidated: 1 - sin 24 degrees
        ((_, k0),) = self.states(5, 8, "0: su = 0.22*s, gamma = 6 kN/m3")
        self.assertEqual(k0, "0.59")
        ((_, k0),) = self.states(5, 8, "0: su = 20 kPa, gamma = 6 kN/m3, OCR = 4")
        self.assertEqual(k0, f"{0.5933 * 4**0.4067:.2g}")
        # 60 kPa rest on clay of 3 kPa
        layers = "0: phi = 33, E = 20 MPa", "6: su = 3 kPa"
        self.assertEqual(
            self.states(8, 20, *layers)[1][1], "max(0.59, 1 - 1.9*(3000)/s)"
        )
        # weak in the middle of the layer alone
        ((_, k0),) = self.states(5, 8, "0: su = (0.3 + 2*abs(d - 6)) kPa")
        self.assertRegex(k0, r"^m(ax|in)\(.*, 1 [-+] 1.9\*\(.*\)/s\)$")
        # held for the weakest clay of a study, too
        (layer,) = clay.with_states([self.layer("0: su = 0.22*s")], 5, 8, 0.7)
        expected = "max(0.59, 1 - 1.9*(0.7*(0.22*s))/s)"
        self.assertEqual(layer.value("K0"), expected)
        ((weight, k0),) = self.states(5, 8, "0: su = 20 kPa, n = 0.5, K0 = 0.8")
        self.assertEqual((round(weight, 2), k0), (8.09, "0.8"))

    def test_refusals(self) -> None:
        sand = "0: phi = 33, E = 20 MPa, "
        for text, words in (
            (sand + "gamma = 8.5", "gamma = 8.5: give its unit"),
            (sand + "gamma = 40 kN/m3", "porosity is -0.87"),
            (sand + "gamma = 8 kN/m3, e = 0.6", "give gamma or Void ratio"),
            ("0: su = 20000, E = 4 MPa", "give its unit, as in su = 20 kPa"),
            ("0: su = 20+2*d, E = 4 MPa", r"su = \(20\+2\*d\) kPa"),
            ("0: phi = 0.6, E = 4 MPa", "write 31"),
            ("0: soft clay", "ENTRY = VALUE; clay is given by its strength, as in su"),
            ("0: densse sand", "did you mean dense?"),
            ("0: su = 2,5 kPa", "'5 kPa' is not .* decimals have a point"),
            ("0: su = 20 kPa + 2 kPa*h", "'h' is no variable; d, or z"),
            ("0: gama = 8 kN/m3", r"did you mean gamma or Adhesion"),
            ("0: Dr = 1.2", "it is a share of 1$"),
            ("0: Dr = 85", "a share of 1. Did you mean 0.85"),
            (sand + "Friction angle = 34", "gives Friction angle twice"),
            (sand + "su = 20 kPa", "which has no Friction angle"),
            ("0: phi = 33,5, E = 20 MPa", "'5' is not .* decimals have a point"),
            ("0: phi = 33 kPa, E = 2", "'kPa' is no unit of it; known: degrees"),
            ("0: Dr = 0.8, su = 3 kPa", "leave out"),
            ("0: Frction = 33", r"did you mean Friction angle"),
            ("0: xyzzy = 3", "--explain 'Layer 1' lists them"),
        ):
            with self.assertRaisesRegex(SuggestError, words):
                self.layer(text)


class CommandLine(unittest.TestCase):
    """Mistakes and the version."""

    def call(self, *words: str) -> tuple[int, str]:
        """Return the exit status and the words of a call."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            try:
                status = caisson.__main__.main(words)
            except SystemExit as end:
                status = int(end.code or 0)
        return status, said.getvalue()

    def test_version(self) -> None:
        self.assertEqual(
            self.call("--version"), (0, f"caisson of caisson_mpm {paths.version()}\n")
        )

    def test_nearest(self) -> None:
        """Of a command or an option, in a line or two."""
        self.assertIn("Did you mean suggest?", self.call("sugest")[1])
        status, said = self.call("cpt", "--skrt", "3")
        self.assertEqual(status, 2)
        self.assertIn("did you mean --skirt?", said)
        self.assertEqual(len(said.splitlines()), 2)
        said = self.call("suggest", "--weight", "2500t")[1]
        self.assertIn("--weight: '2500t': 't' is no unit of it; known: N, kN, MN", said)


if __name__ == "__main__":
    unittest.main()
