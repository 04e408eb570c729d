# SPDX-License-Identifier: LGPL-2.1-or-later
"""Low, best and high estimate: their layers, and the page that has all of them."""
import argparse
import unittest

from caisson.suggest import band
from caisson.suggest.entry import Layer, SuggestError
from caisson.suggest.soil import layers_of

KNOWN = {
    **dict.fromkeys(("Friction angle", "Critical friction angle"), "degrees"),
    **dict.fromkeys(("Cohesion", "Youngs modulus", "Tension cut-off"), "Pa"),
    **{"Relative density": "", "Permeability": "m/s", "Void ratio": "", "Law": ""},
}
SOIL = ["0: Sand = medium dense", "2: su = (4 + 2*d) kPa, E = 300 su"]


class Estimates(unittest.TestCase):
    """The layers of the low and the high estimate."""

    def ends(self, texts: list[str], **given: object) -> dict[str, list[Layer]]:
        """Return them, by the options of the command."""
        options = argparse.Namespace(
            **{"low": [], "high": [], "spread": None, "cpt": None, **given}
        )
        band.check(options)
        options.estimates = band.estimates_of(options)
        return band.of_texts(texts, KNOWN, "density", options)

    def test_only_what_differs(self) -> None:
        """The rest, also of other layers, is that of the best estimate; what is
        assumed follows."""
        found = self.ends(SOIL, low=["2: su = 3 kPa"], high=["0: Dr = 70%"])
        best = layers_of(SOIL, KNOWN, "density")
        self.assertEqual(found["low"][0], best[0])
        self.assertEqual(found["high"][1], best[1])
        self.assertEqual(found["low"][1].value("Cohesion"), "3000")
        self.assertEqual(found["low"][1].value("Youngs modulus"), "300*(3000)")
        self.assertEqual(found["high"][0].value("Relative density"), "0.7")
        modulus = float(found["high"][0].value("Youngs modulus"))
        self.assertGreater(modulus, float(best[0].value("Youngs modulus")))

    def test_spread_is_that_of_a_normal_distribution(self) -> None:
        """At its points of 5 and 95 %, of words, numbers and expressions; a relative
        density is at most 1."""
        found = self.ends(SOIL, spread="Dr 20%, su 10%")
        density = [float(found[x][0].value("Relative density")) for x in band.SIGNS]
        self.assertEqual(density, [0.3355, 0.6645])
        strength = [found[x][1].value("Cohesion") for x in band.SIGNS]
        words = [f"{factor}*(1000*(4 + 2*d))" for factor in (0.8355, 1.1645)]
        self.assertEqual(strength, words)
        dense = self.ends(["0: Dr = 90%"], spread="Dr 10%")
        self.assertEqual(float(dense["high"][0].value("Relative density")), 1)

    def test_of_a_cone_test(self) -> None:
        """The entries of its study stand in the place of the best ones."""
        best = layers_of(["0: phi = 33, E = 20 MPa"], KNOWN, "density")
        choices = {x: {"Soil/Layer 1/Friction angle": 30.0} for x in band.SIGNS}
        (low,) = band.of_choices(best, choices)["low"]
        self.assertEqual(low.value("Friction angle"), "30")
        self.assertEqual(low.value("Youngs modulus"), "20000000")

    def test_refusals(self) -> None:
        """A line says what to do."""
        cases: list[tuple[str, dict[str, object]]] = [
            ("no layer begins there; the tops are 0, 2 m", {"low": ["1: Dr = 50%"]}),
            ("names the top 0 m twice", {"high": ["0: Dr = 70%", "0: phi = 3"]}),
            ("no layer gives phi", {"spread": "phi 5%"}),
            ("of a larger one give --low and --high", {"spread": "su 60%"}),
            ("each once", {"spread": "su"}),
            ("no higher resistance", {"spread": "k 20%"}),
            ("or --low and --high, not both", {"spread": "su 9%", "low": ["0: Dr=1"]}),
            ("its own low and high", {"spread": "su 9%", "cpt": "test.csv"}),
        ]
        for words, given in cases:
            with self.subTest(words), self.assertRaisesRegex(SuggestError, words):
                self.ends(SOIL, **given)


if __name__ == "__main__":
    unittest.main()
