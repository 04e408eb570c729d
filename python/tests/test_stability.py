# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is judged of a hard scene, on walls that are made up."""
import unittest
from types import SimpleNamespace
from typing import Any

import numpy as np

from lab import stability


class Lean(unittest.TestCase):
    """The stress on the inner wall beside that on the outer one."""

    def test_lean(self) -> None:
        """Only rows near the tip and the end of the way count."""
        penetration, height = np.meshgrid([1.0, 1.5, 1.6], [0.0, 0.1, 0.2, 0.3])
        counts = (penetration > 1.4) & (height > 0.05) & (height < 0.25)
        walls: dict[str, Any] = {
            "penetration_m": penetration.ravel(),
            "depth_m": (penetration - height).ravel(),
            "inner_normal_stress_Pa": np.where(counts, 9e3, 1e6).ravel(),
            "outer_normal_stress_Pa": np.where(counts, 10e3, 0).ravel(),
            "inner_area_m2": np.full(12, 2.0),
            "outer_area_m2": np.full(12, 3.0),
        }
        results: Any = SimpleNamespace(walls=walls)
        self.assertAlmostEqual(stability.lean_of(results), -0.1)


if __name__ == "__main__":
    unittest.main()
