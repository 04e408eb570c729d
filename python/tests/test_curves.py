# SPDX-License-Identifier: LGPL-2.1-or-later
"""Means of curves, and the forces that are compared, against values by hand."""
import unittest

import numpy as np

from caisson import curves
from caisson.verdict import design
from lab import curves as lab_curves


class WindowMean(unittest.TestCase):
    """The one definition of a mean."""

    def test_both_ends_count(self) -> None:
        x = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
        f = np.array([1.0, 2.0, 4.0, 8.0, 16.0])
        self.assertEqual(curves.window_mean(x, f, 2, 2), (2 + 4 + 8) / 3)
        self.assertEqual(curves.window_mean(x, f, 2, 1.9), 4)
        self.assertEqual(curves.window_mean(x, f, 2, 4), 31 / 5)

    def test_rounding_does_not_decide(self) -> None:
        """Records every 0.01 m: 21 rows at every depth."""
        x = np.array([float(f"{0.5 + 0.01 * i:.10g}") for i in range(601)])
        for at in (1, 1.5, 2, 3, 4, 5, 6, 6.4):
            self.assertEqual(curves.in_window(x, at, 0.2).sum(), 21, at)

    def test_edge_is_a_tolerance_only(self) -> None:
        x = np.array([0.0, 0.9, 1.0 + 5e-10, 1.0 + 5e-9, 2.0])
        near = curves.in_window(x, 0.5, 1)
        self.assertEqual(list(near), [True, True, True, False, False])

    def test_nan_where_the_window_is_not_whole(self) -> None:
        x, f = np.array([0.0, 1.0, 2.0]), np.array([1.0, 2.0, 3.0])
        self.assertTrue(np.isnan(curves.window_mean(x, f, 0.4, 1)))
        self.assertTrue(np.isnan(curves.window_mean(x, f, 1.6, 1)))
        self.assertEqual(curves.window_mean(x, f, 1.5, 1), 2.5)

    def test_values_that_are_not_finite_are_left_out(self) -> None:
        x = np.array([0.0, 1.0, 2.0])
        f = np.array([1.0, np.nan, 3.0])
        self.assertEqual(curves.window_mean(x, f, 1, 2), 2)
        self.assertTrue(np.isnan(curves.window_mean(x, f * np.nan, 1, 2)))

    def test_running_mean_follows_the_path(self) -> None:
        """Down and up again: the way back does not mix with the way down."""
        x = np.array([0.0, 1.0, 2.0, 1.0, 0.0])
        f = np.array([0.0, 3.0, 6.0, 9.0, 12.0])
        mean = curves.running_mean(x, f, 2)
        np.testing.assert_array_equal(mean, [np.nan, 3, 6, 9, np.nan])
        np.testing.assert_array_equal(curves.path_of(x), [0, 1, 2, 3, 4])

    def test_rms_takes_the_part_that_there_is(self) -> None:
        x, f = np.array([0.0, 1.0, 2.0]), np.array([3.0, 4.0, 0.0])
        rms = curves.window_rms(x, f, 2)
        np.testing.assert_allclose(
            rms, [np.sqrt(25 / 2), np.sqrt(25 / 3), np.sqrt(16 / 2)]
        )

    def test_smoothed(self) -> None:
        """Of a line all means lie on it, up to both ends, beyond which they stay; those
        of a zigzag are means within, and the line through the last window at the end.
        A curve that goes up has the same."""
        x = np.linspace(1, 3, 201)
        at = np.array([0.5, 1, 1.03, 2, 2.97, 3, 3.5])
        line = np.array([2, 2, 2.06, 4, 5.94, 6, 6])
        for order in (slice(None), slice(None, None, -1)):
            found = curves.smoothed_at(x[order], 2 * x[order], at)
            np.testing.assert_allclose(found, line)
        y = 10 + (-1.0) ** np.arange(201)
        last = np.polyfit(x[-21:] - 3, y[-21:], 1)[1]
        found = curves.smoothed_at(x, y, np.array([2, 3.0]))
        np.testing.assert_allclose(found, [y[90:111].mean(), last])
        inside = curves.smoothed_within(x, 2 * x, at)
        np.testing.assert_allclose(inside, [np.nan, *line[1:-1], np.nan])

    def test_smoothed_of_a_short_way(self) -> None:
        """The window is a tenth of the way, and of few rows between them."""
        self.assertEqual(curves.window_of(0.04), 0.004)
        self.assertEqual(curves.window_of(8.0), 0.2)
        x = np.linspace(0, 0.04, 41)
        y = np.where(x > 0.0205, 1.0, 0.0)
        found = curves.smoothed_at(x, y, np.array([0.01, 0.02, 0.03]))
        np.testing.assert_allclose(found, [0, 2 / 5, 1])
        few = np.array([0.0, 1.0, np.nan, 4.0])
        found = curves.smoothed_at(np.array([0.0, 1, 2, 3]), few, np.array([0.5, 2, 3]))
        np.testing.assert_allclose(found, [0.5, 2.5, 4])

    def test_ways(self) -> None:
        """Down with a step back, and up with another."""
        x = np.array([0.0, 2.0, 1.0, 3.0, 2.0, 2.5, 1.0])
        self.assertEqual(list(curves.way_down(x)), [0, 1, 3])
        self.assertEqual(list(curves.way_up(x)), [3, 4, 6])

    def test_common_depths(self) -> None:
        """Rounding does not leave a depth out."""
        positions = [np.array([0.3 + 1e-9, 0.55]), np.array([0.5, 0.7 - 1e-9])]
        depths = curves.common_depths(positions, 0.1)
        np.testing.assert_array_equal(depths, [0.3, 0.4, 0.5, 0.6, 0.7])


class Shape(unittest.TestCase):
    """Roughness, energy and errors."""

    def test_roughness(self) -> None:
        """A straight line has none; a zigzag of height 1 about 10 has 0.1, but for
        the running mean that follows it a little."""
        x = np.linspace(0, 3, 301)
        self.assertLess(curves.roughness(x, 5 + x), 1e-12)
        zigzag = 10 + (-1.0) ** np.arange(len(x))
        self.assertAlmostEqual(curves.roughness(x, zigzag), 0.1, delta=0.006)
        self.assertAlmostEqual(curves.roughness(0.1 * x, zigzag), 0.1, delta=0.006)
        self.assertTrue(np.isnan(curves.roughness(x[::30], 5 + x[::30])))

    def test_relative_error(self) -> None:
        error = lab_curves.relative_error(np.array([1.1, 1.8]), np.array([1.0, 2.0]))
        self.assertAlmostEqual(error, 0.1)


class Gradients(unittest.TestCase):
    """The exit gradient of a run."""

    def test_larger_of_wall_and_axis(self) -> None:
        """Over the critical one; none below 0, nor where none is critical."""
        history = {
            "exit_gradient_wall": np.array([0.45, 0.1, -0.2, 0.3]),
            "exit_gradient_axis": np.array([0.09, 0.36, -0.1, 0.3]),
            "critical_gradient": np.array([0.9, 0.9, 0.9, 0.0]),
        }
        shares = curves.gradient_share(history)
        np.testing.assert_allclose(shares, [0.5, 0.4, 0.0, 0.0])


class WayDown(unittest.TestCase):
    """The rows of a way down."""

    def test_rows_that_rest_are_left_out(self) -> None:
        position = np.array([0.0, 1.0, 1.0, 0.5, 2.0])
        self.assertEqual(curves.way_down(position).tolist(), [0, 1, 4])


class WithWater(unittest.TestCase):
    """The force that a body feels where water presses on its tip: undrained and coupled
    runs have it, others do not."""

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
