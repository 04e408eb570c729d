# SPDX-License-Identifier: LGPL-2.1-or-later
"""Consolidation at large strain, against its limits and in the scene."""
import math
import unittest

import numpy as np

from caisson.paths import ROOT
from lab.verification.consolidation import (
    TIME,
    Column,
    checks,
    constant,
    kozeny_carman,
    observations,
    times_to,
)

SCENE = ROOT / "lab/verification/consolidation_large.prm"
LADDER = ROOT / "lab/verification/ladder.toml"


def neumann(load: float) -> float:
    """Return the settlement over sqrt(c_v t) of an infinitely high column under a load
    over M that comes at once: the density of the grains diffuses evenly in space
    (1/w)_t = (1/w)_zz below a surface at z = -2 b sqrt(t), as in Stefan's problem."""
    density = math.exp(load)
    low, high = 0.0, 5.0
    while high - low > 1e-14:
        b = (low + high) / 2
        flow = (density - 1) / math.erfc(b) * math.exp(-b * b) / math.sqrt(math.pi)
        low, high = (b, high) if b * density < flow else (low, b)
    return 2 * b


class LargeStrain(unittest.TestCase):
    """The reference itself."""

    def test_similarity(self) -> None:
        """Until the base feels it, the settlement is that of Neumann's solution."""
        times = list(0.02 * np.arange(1, 41) ** 2 / 1600)
        errors = []
        for n_cells in (50, 100):
            column = Column(load=0.5, ramp=0, n_cells=n_cells)
            w = column.stretches(times, n_steps=4)[-1]
            exact = neumann(0.5) * math.sqrt(0.02)
            errors.append(abs(column.settlement(w) / exact - 1))
        self.assertLess(errors[1], 3e-4)
        self.assertGreater(errors[0] / errors[1], 3.2)

    def test_small_strain_is_terzaghi(self) -> None:
        times = list(0.3 * np.arange(1, 41) ** 2 / 1600)
        column = Column(load=1e-4, ramp=0, n_cells=100)
        w = column.stretches(times)[-1]
        m = (2 * np.arange(20) + 1) * math.pi / 2
        degree = 1 - float(np.sum(2 / m**2 * np.exp(-(m**2) * 0.3)))
        self.assertAlmostEqual(column.settlement(w) / (1e-4 * degree), 1, delta=3e-4)

    def test_converges_with_order_2(self) -> None:
        """Cells and steps halved; the law of the permeability is the strong one."""
        values = []
        for n in (40, 80, 160):
            column = Column(permeability=kozeny_carman(1.5), n_cells=n)
            w = column.stretches(times_to(0.3, column.ramp, n // 2))[-1]
            base = column.observed(w, 0.3)[1]
            values.append(np.array([column.settlement(w), base]))
        ratio = (values[0] - values[1]) / (values[1] - values[2])
        self.assertTrue(np.all(ratio > 3.5), ratio)

    def test_end(self) -> None:
        """In the end all layers have the stretch that bears the load."""
        column = Column(n_cells=40)
        w = column.stretches([*times_to(1, column.ramp), 10, 20], n_steps=8)[-1]
        self.assertAlmostEqual(column.settlement(w), 1 - math.exp(-0.5), 6)


class Scene(unittest.TestCase):
    """The polynomials that the program is compared with."""

    def assert_checks(self, text: str, column: Column, end: float) -> None:
        """The checks in the text are those of the reference, but for rounding."""
        times, top, base = observations(column, end)
        expected = checks(column, end).split("; ")
        found = [part for part in text.split(";") if "trace" in part]
        self.assertEqual(len(found), 2)
        for own, other in zip(found, expected):
            self.assertEqual(own.split()[:4], other.split()[:4])
            formulas = [eval_at(part.split(":")[1], times) for part in (own, other)]
            after = times > 1.2 * column.ramp
            scale = np.abs(formulas[1]).max()
            self.assertLess(
                np.abs(formulas[0] - formulas[1])[after].max(), 1e-5 * scale
            )
        # and the polynomial is close to the reference itself
        error = np.abs(eval_at(found[0].split(":")[1], times) - top)[after].max()
        self.assertLess(error, 1e-4 * np.abs(top).max())

    def test_constant(self) -> None:
        text = SCENE.read_text(encoding="utf-8").replace("\\\n", "")
        line = next(line for line in text.splitlines() if "set Checks" in line)
        self.assert_checks(line.split("=", 1)[1], Column(permeability=constant), 0.3)

    def test_kozeny_carman(self) -> None:
        text = LADDER.read_text(encoding="utf-8").split("consolidation_large_kozeny")[1]
        entry = text.split('"Verification/Checks" = "')[1].split('"')[0]
        column = Column(permeability=kozeny_carman(1.5))
        self.assert_checks(entry, column, 1)


def eval_at(expression: str, times: np.ndarray) -> np.ndarray:
    """Return an expression of the program at times over H^2 / c_v. [n_times]"""
    names = {"t": TIME * times, "sqrt": np.sqrt}
    return np.asarray(eval(expression.strip(), {"__builtins__": {}}, names))


if __name__ == "__main__":
    unittest.main()
