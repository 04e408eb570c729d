# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page on a cone test."""
import unittest

import numpy as np

from caisson.commands import cpt_page as page
from caisson.parameters.methods import depths_of_bars


class Page(unittest.TestCase):
    """What the page and its picture of the methods show."""

    def test_layers_side_by_side(self) -> None:
        """Few in a table, which fit on a page; heads are titles, but for symbols."""
        rows = [[str(n), "sand", f"{n}.5"] for n in range(1, 8)]
        found = page.by_layer(["layer", "soil", "q_c (MPa)"], rows)
        self.assertEqual(found[0][0], ["Layer", "1", "2", "3", "4", "5"])
        self.assertEqual(found[1][0], ["Layer", "6", "7"])
        last = [["Soil", "sand", "sand"], ["q_c (MPa)", "6.5", "7.5"]]
        self.assertEqual(found[1][1], last)

    def test_subscripts(self) -> None:
        for text, shown in {
            "q_c (MPa)": "q<sub>c</sub> (MPa)",
            "its I_c of 2 <b>": "its I<sub>c</sub> of 2 &lt;b&gt;",
            "phi (deg)": "φ (°)",
            "houlsby_byrne": "houlsby_byrne",
        }.items():
            self.assertEqual(page.with_subscripts(text), shown)

    def test_depths_of_bars(self) -> None:
        """Round ones and the last, none just above it."""
        cases: list[tuple[float, list[float]]] = [
            (4.7, [1, 2, 3, 4, 4.7]),
            (4.2, [1, 2, 3, 4.2]),
            (0.6, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]),
            (12.0, [2, 4, 6, 8, 10, 12]),
        ]
        for deepest, expected in cases:
            np.testing.assert_allclose(depths_of_bars(deepest), expected)


if __name__ == "__main__":
    unittest.main()
