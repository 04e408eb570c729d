# SPDX-License-Identifier: LGPL-2.1-or-later
"""What Houlsby and Byrne assume: options, and the file that keeps them."""
import argparse
import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from synthetic import write_run

from caisson.plot import theory
from caisson.results import Results
from caisson.design import assumed
from caisson.disk import InputError
from caisson.design.houlsby_byrne import Assumptions


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


if __name__ == "__main__":
    unittest.main()
