# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is assumed: by Houlsby and Byrne, and as cone resistance without a test."""
import argparse
import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np
from scipy.integrate import trapezoid
from scipy.optimize import brentq
from synthetic import write_run

from caisson.design import assumed, density
from caisson.design.assumed_cone import Sand, SandGround, assumed_cone
from caisson.design.houlsby_byrne import Assumptions
from caisson.disk import InputError
from caisson.verdict import theory
from caisson.results import Results


class Assumed(unittest.TestCase):
    """From the command line to the methods beside a run."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        write_run(self.path, {}, {"entries": {}, "scene": {"diameter_m": 6.0}})

    def keep(self, *words: str) -> bool:
        """Keep options with the run; return whether there are any."""
        parser = argparse.ArgumentParser()
        assumed.add_arguments(parser)
        return assumed.keep(parser.parse_args(words), self.path)

    def assumptions(self) -> Assumptions:
        """Return what the methods assume beside the run."""
        return theory.assumptions_of(theory.site_of(Results(self.path)).scene)

    def test_options_hold_until_they_are_given_again(self) -> None:
        self.assertFalse(self.keep())
        self.assertEqual(self.assumptions(), Assumptions())
        words = ("--k-tan-delta-inside", "0.6,0.5", "--k-tan-delta-outside", "0.7")
        self.assertTrue(self.keep(*words, "--load-spread", "none"))
        self.keep("--plug-permeability-ratio", "3")
        self.assertEqual(
            self.assumptions(), Assumptions((0.5, 0.6), (0.7, 0.7), 3.0, None)
        )
        self.keep("--load-spread", "2")
        self.assertEqual(self.assumptions().load_spread, 2)

    def test_what_cannot_be_meant(self) -> None:
        """Each option refuses what is no number of its range."""
        for option, value in (
            ("--k-tan-delta-inside", "0.4,0.6,0.8"),
            ("--k-tan-delta-outside", "2.5"),
            ("--plug-permeability-ratio", "0"),
            ("--load-spread", "1"),
            ("--load-spread", "2,3"),
        ):
            said = io.StringIO()
            with self.subTest(option), contextlib.redirect_stderr(said):
                with self.assertRaises(SystemExit):
                    self.keep(option, value)
                self.assertIn(option, said.getvalue())

    def test_damaged_file(self) -> None:
        (self.path / assumed.NAME).write_text("[1", encoding="utf-8")
        with self.assertRaisesRegex(InputError, "design_methods.json cannot be"):
            self.assumptions()


# 10 kN/m3 and K0 = 0.4: sigma'_m = 6 kPa per meter
DENSE = Sand(0, 10e3, 0.4, 0.85, 33)


class Formulas(unittest.TestCase):
    """Both directions, and numbers worked out by hand."""

    def test_by_hand(self) -> None:
        """2494 kPa 0.18^0.46 exp(2.96 0.85) at 3 m: 0.454385, and 12.3801 times."""
        found = assumed_cone((DENSE,), 5).at(3)
        np.testing.assert_allclose(found, 14.0293e6, rtol=1e-4)

    def test_inverse(self) -> None:
        for share in (0.0, 0.3, 1.0):
            resistance = density.cone_resistance(share, 20e3)
            again = density.density_of_resistance(resistance, 20e3)
            self.assertAlmostEqual(again, share, places=12)

    def test_density_of_a_friction_angle(self) -> None:
        """Sand of this density has the angle under its own tip, as `caisson cpt` finds
        it; 33 degrees and less have I_R = 0, and no sand is denser than 1."""
        for z in (0.5, 2.0):
            for angle in (36.0, 39.0):
                sand = DENSE._replace(density=None, friction_angle=angle)
                found = SandGround([sand]).density_at(z)

                def error(share: float) -> float:
                    cone = 2.494e6 * (0.06 * z) ** 0.46 * np.exp(2.96 * share)
                    p = np.sqrt(cone * 10e3 * z) / 1e3
                    return float(30 + 3 * share * (10 - np.log(p)) - angle)

                self.assertAlmostEqual(found, brentq(error, 0, 1.5), places=9)
        loose = [DENSE._replace(density=None, friction_angle=a) for a in (33, 25)]
        at_most = [SandGround([sand]).density_at(2) for sand in loose]
        self.assertEqual(at_most[0], at_most[1])
        self.assertAlmostEqual(at_most[0], 1 / (10 - np.log(193.0)), delta=2e-3)
        strong = DENSE._replace(density=None, friction_angle=50)
        self.assertEqual(SandGround([strong]).density_at(8), 1)


class Profiles(unittest.TestCase):
    """Layers, ends and words."""

    def test_layers(self) -> None:
        """The cone jumps at the top of a denser layer; the integral is that of the
        formula."""
        loose = DENSE._replace(density=0.3)
        found = assumed_cone(
            (
                loose,
                DENSE._replace(top=2),
            ),
            4,
        )
        self.assertAlmostEqual(
            found.at(2.01) / found.at(1.99), np.exp(1.628), delta=0.05
        )
        z = np.linspace(0, 1.9, 20001)
        exact = trapezoid(density.cone_resistance(0.3, 6e3 * z), z)
        np.testing.assert_allclose(found.integral(1.9), exact, rtol=2e-4)
        self.assertEqual(found.at(0), 0)
        self.assertTrue(np.isnan(found.at(4.1)))

    def test_boundary(self) -> None:
        """At 3 m, where looser sand begins, q_c is still that of the upper layer, 14.03
        MPa; below it is exp(-2.96 0.55) = 0.19632 times as large."""
        found = assumed_cone((DENSE, DENSE._replace(top=3, density=0.3)), 5)
        for z, mpa in ((3 - 1e-9, 14.0293), (3.0, 14.0293), (3 + 1e-5, 2.75425)):
            self.assertAlmostEqual(found.at(z) / 1e6, mpa, delta=1e-3)

    def test_words(self) -> None:
        """They say where it is from and where it was not fitted; they name densities of
        the layers that the tip reaches, and what a small angle leaves open."""
        known = assumed_cone(
            (
                DENSE,
                DENSE._replace(top=9, density=0.2),
            ),
            5,
        ).assumed
        for words in (
            "ASSUMED",
            "Jamiolkowski",
            "relative density of the sand,",
            ": 85 % from 0 m.",
            "near the mudline",
        ):
            self.assertIn(words, known)
        self.assertNotIn("20 %", known)
        angle = assumed_cone((DENSE._replace(density=None, friction_angle=40),), 5)
        self.assertIn("from the friction angle by Bolton (1986)", angle.assumed)
        self.assertNotIn("looser sands", angle.assumed)
        self.assertIn("100 % is the densest", angle.assumed)
        shallow = assumed_cone((DENSE._replace(density=None, friction_angle=40),), 1)
        self.assertNotIn("100 % is the densest", shallow.assumed)
        small = assumed_cone((DENSE._replace(density=None, friction_angle=30),), 5)
        self.assertIn("33 degrees or less does not", small.assumed)
        two = assumed_cone(
            (
                DENSE._replace(density=0.2),
                DENSE._replace(top=3),
            ),
            5,
        )
        self.assertIn(": 20 % from 0 m, 85 % from 3 m.", two.assumed)


if __name__ == "__main__":
    unittest.main()
