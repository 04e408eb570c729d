# SPDX-License-Identifier: LGPL-2.1-or-later
"""The force that a body feels where water presses on its tip."""
import unittest

import numpy as np

from caisson import curves
from caisson.plot import design

NAMES = [
    "total_force_N",
    "tip_water_force_N",
    "total_force_with_water_N",
    "lid_water_balance",
]


class WithWater(unittest.TestCase):
    """Undrained and coupled runs have it, others do not."""

    def test_sum(self) -> None:
        history = {
            "total_force_N": np.array([0, 114.0]),
            "tip_water_force_N": np.array([0, 190.0]),
        }
        self.assertIsNone(curves.with_water(history))
        history["total_force_with_water_N"] = np.array([0, 300.0])  # of the last step
        found = curves.with_water(history)
        assert found is not None
        np.testing.assert_allclose(found, [0, 304])

    def test_sealed_lid(self) -> None:
        """A pressure beneath it is borne by the caisson, too."""
        history = {name: np.ones(2) for name in NAMES}
        history["suction_force_N"] = np.array([0, -1500.0])
        found = curves.with_water(history)
        assert found is not None
        np.testing.assert_allclose(found, [2, 1502])

    def test_compared_with_methods(self) -> None:
        """Methods of undrained clay know no effective stress."""
        depth = np.linspace(0, 2, 21)
        history = {"penetration_m": depth, "tip_force_N": 1e3 * depth}
        history |= {"inner_friction_N": 0 * depth, "outer_friction_N": 0 * depth}
        history |= {"total_force_N": 1e3 * depth, "tip_water_force_N": 2e3 * depth}
        at = np.array([1.0])
        drained = design.compared_at(history, at)
        history["total_force_with_water_N"] = 3e3 * depth
        undrained = design.compared_at(history, at)
        for name in ("tip_force_N", "total_force_N"):
            self.assertAlmostEqual(drained[name][0], 1e3)
            self.assertAlmostEqual(undrained[name][0], 3e3)


if __name__ == "__main__":
    unittest.main()
