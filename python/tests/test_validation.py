# SPDX-License-Identifier: LGPL-2.1-or-later
"""What runs are compared with, and how."""
import math
import unittest

import numpy as np

from lab.paths import LAB
from lab.validation.triaxial import triaxial
from lab.validation.verdict import Row

TESTS = LAB / "validation/triaxial/triaxial.csv"


class Rows(unittest.TestCase):
    """The verdicts."""

    def test_bounds(self) -> None:
        self.assertTrue(Row("a", "b", 2, 1, 3).is_met)
        self.assertTrue(Row("a", "b", 4, 1, 3).fails)
        self.assertTrue(Row("a", "b", math.nan, 1, 3).fails)
        known = Row("a", "b", 4, 1, 3, known="because")
        self.assertFalse(known.fails)
        self.assertEqual(known.texts()[-2:], ["1 to 3", "short: because"])


class Triaxial(unittest.TestCase):
    """The numbers of a triaxial test."""

    def test_friction_angle(self) -> None:
        """sin phi = (s1 - s3) / (s1 + s3)."""
        phi = triaxial.friction_angle(np.array([200.0]), np.array([100 + 200 / 3]))
        self.assertAlmostEqual(phi[0], math.degrees(math.asin(200 / 400)))

    def test_dilatancy(self) -> None:
        """Soil that contracts and then grows by 0.3 of the axial strain."""
        strain = np.linspace(0, 0.2, 401)
        volume = 1 + 0.3 * np.maximum(strain - 0.05, 0) - 0.1 * np.minimum(strain, 0.05)
        sine = math.sin(math.radians(triaxial.dilatancy(strain, volume)))
        self.assertAlmostEqual(sine, 0.3 / 2.3, places=6)

    def test_runs(self) -> None:
        """25 tests, each with its pressure and porosity."""
        runs = triaxial.runs_of(TESTS)
        self.assertEqual([run["name"] for run in runs], [str(i) for i in range(1, 26)])
        entries = runs[5]["set"]
        self.assertEqual(entries["Soil/Uniform stress"], "-50000, -50000, -50000, 0")
        self.assertAlmostEqual(entries["Soil/Layer 1/Porosity"], 0.88 / 1.88)


if __name__ == "__main__":
    unittest.main()
