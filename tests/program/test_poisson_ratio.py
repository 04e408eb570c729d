# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tip force in soil that hardly changes its volume: program.py."""
import unittest

import numpy as np
from program import SUCCESS, ProgramTest, history, user_scene
from test_result_warnings import SMALL


class PoissonRatio(ProgramTest):
    """Frictional soil with one shear modulus and different Poisson ratios."""

    def tip_force(self, nu: float) -> float:
        """Return the mean tip force from 0.9 to 1.1 m. Units: N."""
        path = self.directory(f"nu_{nu}")
        self.run_program(
            SUCCESS,
            user_scene("jack_coarse"),
            "--output-directory",
            path,
            entries={
                **SMALL,
                "Time/Mass scaling": 100,
                "Time/End penetration": 1.1,
                "Output/Frame interval": "never",
                "Output/Frame penetrations": "",
                "Soil/Layer 1/Poisson ratio": nu,
                "Soil/Layer 1/Youngs modulus": 5e6 * (1 + nu) / 1.3,
            },
        )
        rows = [row for row in history(path) if row["penetration_m"] >= 0.9]
        return float(np.mean([row["tip_force_N"] for row in rows]))

    def test_strength_is_kept(self) -> None:
        """Nearly incompressible soil bears more in a small domain, and not half."""
        usual, incompressible = self.tip_force(0.3), self.tip_force(0.49)
        self.assertGreater(incompressible, usual)
        self.assertLess(incompressible, 1.3 * usual)


if __name__ == "__main__":
    unittest.main()
