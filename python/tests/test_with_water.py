# SPDX-License-Identifier: LGPL-2.1-or-later
"""The force that a body feels where water presses on its tip."""
import unittest

import numpy as np

from caisson import curves


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


if __name__ == "__main__":
    unittest.main()
