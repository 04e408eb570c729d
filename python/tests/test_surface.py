# SPDX-License-Identifier: LGPL-2.1-or-later
"""The response surface of a study: P5, P50 and P95 of made-up functions."""
import contextlib
import io
import math
import unittest
from unittest.mock import MagicMock

import numpy as np
from scipy import stats
from scipy.stats import qmc
from test_uncertain_runs import FAKE_PROGRAM, PHI, WithFiles

from caisson import __main__ as program
from caisson import needed
from caisson.evaluation import rest_of_run
from caisson.uncertain import surface
from caisson.uncertain.outcome import COMPLETE, Outcome
from caisson.uncertain.surface import Refusal

HAS_SKLEARN = needed.is_there("sklearn")
SPREAD = 0.2  # standard deviation of the first factor, of 1
LATIN = 'sampling = "Latin hypercube"\nsamples = {}\n'


def points(n: int, seed: int) -> np.ndarray:
    """Return samples [n, 3] of a normal and two uniform distributions."""
    shares = qmc.LatinHypercube(d=3, seed=seed).random(n)
    strength = stats.norm(1, SPREAD).ppf(shares[:, 0])
    return np.column_stack([strength, 1 + shares[:, 1], 10 * shares[:, 2]])


def suction(at: np.ndarray) -> np.ndarray:
    """Return what a required suction may look like (Pa): strength over sensitivity,
    less what the weight carries; the third parameter has no effect."""
    return 40e3 * at[:, 0] ** 1.3 * (0.5 + 0.5 / at[:, 1]) - 10e3


@unittest.skipUnless(HAS_SKLEARN, "python3-sklearn is missing")
class MadeUp(unittest.TestCase):
    """Functions instead of runs."""

    def test_twenty_are_enough(self) -> None:
        """Within 2 % of all soil, for several samples of twenty; 200 runs themselves
        miss its P5 by more."""
        everywhere = points(surface.SAMPLES, 99)
        many = np.quantile(suction(points(200, 50)), surface.SHARES)
        exact = np.quantile(suction(points(100_000, 1)), surface.SHARES)
        self.assertGreater(abs(many[0] / exact[0] - 1), 0.02)
        for seed in range(3):
            few = points(20, seed)
            found = surface.spread_of("s", 1.0, few, suction(few), everywhere)
            assert found is not None
            share = np.array(found.quantiles) / exact - 1
            self.assertLess(np.abs(share).max(), 0.02)
            self.assertEqual(found.runs, 20)

    def test_error_is_that_of_the_runs(self) -> None:
        """The scatter of runs is in the error by leave-one-out, and hardly in the
        quantiles; of none there is next to none."""
        few, everywhere = points(20, 3), points(surface.SAMPLES, 98)
        scatter = 1e3 * np.random.default_rng(0).standard_normal(20)
        exact = surface.spread_of("s", 1.0, few, suction(few), everywhere)
        rough = surface.spread_of("s", 1.0, few, suction(few) + scatter, everywhere)
        assert exact is not None and rough is not None
        self.assertLess(exact.error, 300)
        self.assertGreater(rough.error, 700)
        self.assertLess(rough.error, 2500)

    def test_runs_without_a_result(self) -> None:
        """They are left out; too few are no surface, and values have their least."""
        few, everywhere = points(20, 4), points(500, 97)
        values = suction(few)
        values[:6] = math.nan
        found = surface.spread_of("s", 1.0, few, values, everywhere, 25e3)
        assert found is not None
        self.assertEqual((found.runs, found.quantiles[0]), (14, 25e3))
        values[:11] = math.nan
        self.assertEqual(surface.spread_of("s", 1.0, few, values, everywhere), None)

    def test_no_quantile_of_what_is_refused(self) -> None:
        """Where 10 % of all soil are refused there is no P95, but a P50."""
        few, everywhere = points(20, 4), points(500, 97)
        found = surface.spread_of("s", 1.0, few, suction(few), everywhere, reached=0.9)
        assert found is not None
        self.assertEqual(found.quantiles[2], math.inf)
        middle = np.quantile(suction(everywhere), 0.5)
        self.assertAlmostEqual(found.quantiles[1] / middle, 1, delta=0.02)

    def test_refusal(self) -> None:
        """Where the suction is above a limit, in 15 % of all soil; where no run is
        refused it is a bound."""
        few, everywhere = points(20, 5), points(surface.SAMPLES, 96)
        limit = float(np.quantile(suction(everywhere), 0.85))
        found = surface.refusal_of(few, suction(few) > limit, everywhere)
        self.assertAlmostEqual(found.probability, 0.15, delta=0.05)
        self.assertLess(found.wrong or 0, 3)
        one = suction(few) == suction(few).max()
        rare = surface.in_words(surface.refusal_of(few, one, everywhere))
        self.assertIn("1 of 20 runs; one of a kind is too few", rare)
        none = surface.refusal_of(few, suction(few) > 1e9, everywhere)
        self.assertAlmostEqual(none.probability, 0.139, places=3)
        self.assertIn("of at most 14 % (95 % sure)", surface.in_words(none))
        every = Refusal(0.861, 20, 20, None)
        self.assertIn(
            "20 of 20 runs; a probability of at least 86", surface.in_words(every)
        )


class Rest(unittest.TestCase):
    """The penetration by weight of a run of a study."""

    def test_passes_of_rows(self) -> None:
        """Rows whose required suction jumps by 2 kPa about a line through 0 at 1.5 m
        pass 0 again and again from 1 to 2 m: the mean passes it at 1.5 m."""
        depth = np.linspace(0, 5, 251)
        required = 4e3 * (depth - 1.5) + 2e3 * np.cos(20 * np.pi * depth)
        history = {
            "penetration_m": depth,
            "required_suction_Pa": required,
            "suction_Pa": np.maximum(required, 0),
        }
        run = Outcome(MagicMock(), COMPLETE, "", history)
        self.assertGreater(abs((rest_of_run(history) or 0) - 1.5), 0.1)
        self.assertAlmostEqual(run.rest or 0, 1.5, delta=0.02)
        history["suction_Pa"] = np.zeros(251)
        self.assertIsNone(run.rest)


class Study(WithFiles):
    """caisson study, with a stand-in for the program whose force is depth times
    1 kN for each degree and 5 kN more."""

    def study(self) -> tuple[int, str]:
        """Run the study; return its status and all that it says."""
        words = [str(self.path / "s.toml"), "--program", str(FAKE_PROGRAM)]
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            status = program.main(
                ["study", *words, "--results", str(self.path / "results")]
            )
        return status, said.getvalue()

    NORMAL = PHI + 'distribution = "normal"\nmean = 30\nstandard_deviation = 2\n'

    @unittest.skipUnless(HAS_SKLEARN, "python3-sklearn is missing")
    def test_quantiles_of_a_study(self) -> None:
        """At the quarters of the way to 4.5 m, in surface.csv and in what is said."""
        self.write(LATIN.format(12) + self.NORMAL)
        status, said = self.study()
        self.assertEqual(status, 0, said)
        self.assertIn("by 10000 samples of a response surface", said)
        rows = self.rows("surface.csv")
        depths = [1.125, 2.25, 3.375, 4.5]
        for row, depth in zip(rows, depths, strict=True):
            self.assertEqual(row["result"], f"total force at {depth:.4g} m")
            for name, sign in zip(surface.NAMES, (-1, 0, 1)):
                force = depth * (30 + sign * 1.645 * 2 + 5)
                self.assertAlmostEqual(float(row[name]) / force, 1, delta=5e-3)
            self.assertLess(float(row["error"]), 0.02 * force)

    def test_too_few_runs(self) -> None:
        """Then the quantiles are those of the runs, and it is said why."""
        self.write(LATIN.format(8) + self.NORMAL)
        _, said = self.study()
        self.assertIn("| quantile", said)
        if HAS_SKLEARN:
            self.assertIn("8 runs are too few for a response surface: 10 or", said)
        self.assertFalse((self.path / "results/s/surface.csv").exists())


if __name__ == "__main__":
    unittest.main()
