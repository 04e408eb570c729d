# SPDX-License-Identifier: LGPL-2.1-or-later
"""The picture that compares runs."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

from caisson.plot import comparison
from caisson.results import ResultsError


def made_up(directory: Path, depths: list[float]) -> Path:
    """Write a history in which the force follows the depth, without water."""
    directory.mkdir()
    rows = [f"{i},{depth},{1e6 * depth}" for i, depth in enumerate(depths)]
    text = "\n".join(["time_s,penetration_m,total_force_N", *rows]) + "\n"
    (directory / "history.csv").write_text(text, encoding="utf-8")
    return directory


class Comparison(unittest.TestCase):
    """What pushes the body, and the picture."""

    def test_water_pushes_too(self) -> None:
        """What suction does on the lid need not be pushed; what it takes from the
        pressure at the tip, neither."""
        history = {
            "total_force_N": np.array([100.0, -50.0]),
            "suction_force_N": np.array([30.0, 30.0]),
            "tip_water_force_N": np.array([-5.0, -5.0]),
        }
        self.assertEqual(list(comparison.pushing_force(history)), [65, -85])

    def test_picture(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            path = Path(name)
            runs = [
                made_up(path / "down", [0.5, 1, 2]),
                made_up(path / "up", [0.5, 2, 1]),
            ]
            picture = comparison.draw(path / "both.png", runs)
            self.assertGreater(picture.stat().st_size, 1000)
            still = made_up(path / "still", [1, 1])
            with self.assertRaises(ResultsError):
                comparison.draw(path / "none.png", [*runs, still])


if __name__ == "__main__":
    unittest.main()
