# SPDX-License-Identifier: LGPL-2.1-or-later
"""Comparisons of results with exact solutions (lab/checks.py), on numbers that can be
worked out by hand."""
import argparse
import json
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np

from caisson.results import Results
from lab import checks
from lab.checks import BOUNDS, OF_POINTS, OF_SERIES, CheckError, Samples


def samples(computed: list[float], exact: list[float], **more: list[float]) -> Samples:
    """Return values; more: weight, otherwise 1, and upper."""
    arrays = {name: np.array(values) for name, values in more.items()}
    return Samples(
        np.array(computed),
        np.array(exact),
        arrays.get("weight", np.ones(len(computed))),
        arrays.get("upper", np.array(exact)),
    )


# two points; that of volume 3 is wrong by 1, the other by -0.2
POINTS = samples([5, 0.8], [4, 1], weight=[3, 1])
ZERO = samples([0.5, -0.25], [0, 0])
SERIES = samples([1, 2.5, 4], [1, 2, 5], upper=[1, 2, 6])


class Modes(unittest.TestCase):
    """The errors of all modes: computed, exact, error."""

    def assert_found(
        self, mode: str, s: Samples, found: tuple[float, float, float]
    ) -> None:
        """Ask for the numbers of a mode."""
        with self.subTest(mode=mode):
            error = (OF_POINTS | OF_SERIES)[mode](s)
            np.testing.assert_allclose(error, found, rtol=1e-5)

    def test_points(self) -> None:
        self.assert_found("max", POINTS, (5, 4, 0.25))
        self.assert_found("pointwise", POINTS, (5, 4, 0.25))
        self.assert_found("mean", POINTS, (3.95, 3.25, 0.7 / 3.25))
        self.assert_found("rms", POINTS, (0.871780, 0, 0.871780 / 4))
        self.assert_found("spread", POINTS, (4.2, 0, 4.2 / 3.95))

    def test_where_the_exact_value_is_zero(self) -> None:
        self.assert_found("max", ZERO, (0.5, 0, 0.5))
        self.assert_found("pointwise", ZERO, (0.5, 0, 0.5))
        self.assert_found("mean", ZERO, (0.125, 0, 0.125))
        self.assert_found("rms", ZERO, (0.395285, 0, 0.395285))
        self.assert_found("spread", ZERO, (0.75, 0, 6))

    def test_what_is_no_number_passes_nothing(self) -> None:
        for mode in OF_POINTS:
            for values in ([math.nan, 1], [1, math.nan]):
                error = OF_POINTS[mode](samples(values, [1, 1]))[2]
                self.assertFalse(error <= 1e9, mode)

    def test_series(self) -> None:
        self.assert_found("trace", SERIES, (4, 5, 0.2))
        self.assert_found("final", SERIES, (4, 5, 0.2))
        self.assert_found("average", SERIES, (2.5, 8 / 3, 0.0625))
        self.assert_found("drift", SERIES, (4, 1, 0.75))

    def test_bounds(self) -> None:
        for value, below, above, between in (
            (4.0, 0, 0.2, 0.2),
            (5.5, 0.1, 0, 0),
            (7.5, 0.5, 0, 0.25),
        ):
            s = samples([value], [5], upper=[6])
            errors = [BOUNDS[mode](s)[2] for mode in ("below", "above", "between")]
            np.testing.assert_allclose(errors, [below, above, between], atol=1e-12)


class Checks(unittest.TestCase):
    """Checks as they are written, and what they take from results."""

    def setUp(self) -> None:
        """Make results: r from 1 to 3 m, x = r at the end (t = 2 s); y = t^2."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = Path(folder.name)
        self.write(
            "points",
            "initial_position_r,initial_position_z,volume,x,statev_1",
            2,
            range(1, 4),
        )
        rows = "".join(f"{t},{t * t},{t}\n" for t in (0, 1, 2))
        (self.path / "history.csv").write_text("time_s,y,step\n" + rows, "utf-8")

    def write(self, name: str, columns: str, time: float, radii: range) -> None:
        """Write points, of which the first one has no state variable."""
        rows = "".join(f"{time},{r},-1,1,{r},{r if r > 1 else 'nan'}\n" for r in radii)
        (self.path / f"{name}.csv").write_text(f"time_s,{columns}\n{rows}", "utf-8")

    def find(self, text: str) -> dict[str, float]:
        """Make one check."""
        return checks.compare(text, Results(self.path))

    def test_expressions_and_regions(self) -> None:
        self.assertTrue(self.find("max x : r*if(z < 0, 1, 2)^2 + t - 2 : 1e-9")["pass"])
        self.assertEqual(self.find("mean x where r > 1 : 0 : 1")["computed"], 2.5)
        self.assertEqual(self.find("mean statev_1 : 0 : 1")["computed"], 2.5)
        with self.assertRaisesRegex(CheckError, "no material point"):
            self.find("max x where r > 9 : 0 : 1")

    def test_series(self) -> None:
        self.assertEqual(self.find("final y : t^2 : 1e-9")["relative_error"], 0)
        self.assertEqual(self.find("average y from 1 : 0 : 1")["computed"], 2.5)
        self.assertEqual(self.find("final y to 1 : 1 : 1")["computed"], 1)
        found = self.find("final y until y 2 : 0 : 9")
        self.assertAlmostEqual(found["computed"], 2)  # a third of the way
        self.assertEqual(
            self.find("between y : 1 : t*2")["line"], "between y 1 and t*2: yes"
        )
        self.assertEqual(self.find("drift y : 0.5")["line"], "drift y: within 0.5: no")

    def test_what_cannot_be_understood(self) -> None:
        for text, words in (
            ("maxx x : 0 : 1", "no mode 'maxx', only max"),
            ("max x", "is written as"),
            ("max : 0 : 1", "is written as"),
            ("between y : 0", "is written as"),
            ("max x : 0 : 0", "must be a positive number"),
            ("max x : 0 : x", "must be a positive number"),
            ("max x in r > 1 : 1 : 1", "only where REGION"),
            ("max x : 1 + : 1", "no expression"),
            ("max x : q : 1", "no expression"),
            ("final y where r > 1 : 1 : 1", "only from T"),
            ("final y from z : 1 : 1", "only from T"),
            ("final y from 3 : 1 : 1", "no record"),
            ("final y until y 9 : 1 : 1", "not reached"),
            ("final force : 0 : 1", "no observation or column .* only time_s, y"),
        ):
            with self.subTest(text), self.assertRaisesRegex(CheckError, words):
                self.find(text)

    def test_of_a_run(self) -> None:
        """All checks of its scene, once it has finished."""
        summary = {
            "status": "finished",
            "entries": {checks.ENTRY: "final y : 4 : 1e-9 ; drift y : 0.5;"},
        }
        for status in ("finished", "stopped"):
            summary["status"] = status
            (self.path / "run.json").write_text(json.dumps(summary), "utf-8")
            if status == "finished":
                found = checks.checks_of(Results(self.path))
                self.assertEqual([check["pass"] for check in found], [True, False])
                options = argparse.Namespace(directory=[self.path])
                self.assertEqual(checks.main(options), 1)
        with self.assertRaisesRegex(CheckError, "is stopped"):
            checks.checks_of(Results(self.path))


if __name__ == "__main__":
    unittest.main()
