# SPDX-License-Identifier: LGPL-2.1-or-later
"""The force that a body feels where water presses on its tip."""
import unittest

import numpy as np

from caisson import curves
from caisson.verdict import design


class WithWater(unittest.TestCase):
    """Undrained and coupled runs have it, others do not."""

    def test_compared_with_methods(self) -> None:
        """Methods of undrained clay know no effective stress."""
        depth = np.linspace(0, 2, 21)
        history = {"penetration_m": depth, "tip_force_N": 1e3 * depth}
        history |= {"inner_friction_N": 0 * depth, "outer_friction_N": 0 * depth}
        history |= {"total_force_N": 1e3 * depth, "tip_water_force_N": 2e3 * depth}
        at = np.array([1.0])
        drained = design.compared_at(history, at)
        history[curves.WITH_WATER] = 3e3 * depth
        undrained = design.compared_at(history, at)
        for name in ("tip_force_N", "total_force_N"):
            self.assertAlmostEqual(drained[name][0], 1e3)
            self.assertAlmostEqual(undrained[name][0], 3e3)


if __name__ == "__main__":
    unittest.main()
