# SPDX-License-Identifier: LGPL-2.1-or-later
"""The fit of a damped wave in lab/verification."""
import math
import unittest

import numpy as np

from lab.verification import damped_wave


class Fit(unittest.TestCase):
    """Frequency and damping are found from 100 values in 2.2 periods."""

    def test_any_phase(self) -> None:
        for w, g, phase, offset in (
            (1400, 0, 0, 0),
            (1400, 7, 0, 0),
            (0.3, 0.006, 1, -10),
            (2, -0.01, 2.5, 3),
        ):
            with self.subTest(w=w, g=g):
                t = 0.022 * np.arange(100) * 2 * math.pi / w
                values = offset + np.exp(-g * t) * np.cos(w * t + phase)
                found = damped_wave.fit(5 + t, values)
                np.testing.assert_allclose(found, (w, g), rtol=1e-6, atol=1e-6 * w)


if __name__ == "__main__":
    unittest.main()
