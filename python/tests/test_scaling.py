# SPDX-License-Identifier: LGPL-2.1-or-later
"""The estimate for many ranks."""
import unittest

from lab.performance.scaling import NETWORKS, Network, Work, step_time, table

NO_COST = Network("none", 0.0, float("inf"))


class Scaling(unittest.TestCase):
    """Limits that are known."""

    def test_without_network(self) -> None:
        """The work is divided, and nothing else costs time."""
        work = Work(imbalance=1.0, seconds_per_step=0.0)
        one = step_time(1e6, 1, NO_COST, work)
        self.assertAlmostEqual(one, 1e6 * work.seconds_per_point, 12)
        self.assertAlmostEqual(step_time(1e6, 100, NO_COST, work) * 100, one, 12)

    def test_by_hand(self) -> None:
        """800,000 points on 100 ranks: 1,000 cells on each, at 8 points."""
        work = Work(50e-9, 40e-6, 8.0, 1.2, 16.0, 2.5, 1000.0)
        network = Network("slow", 1e-5, 1e8)
        own = 1.2 * 8000 * 50e-9 + 40e-6
        messages = 16 * 1e-5 + 4 * 1000**0.5 * 1000 / 1e8
        collectives = 2.5 * 1e-5 * 7
        found = step_time(8e5, 100, network, work)
        self.assertAlmostEqual(found / (own + messages + collectives), 1, 12)

    def test_more_points_scale_further(self) -> None:
        for network in NETWORKS:
            gains = [
                step_time(n, 1, network, Work()) / step_time(n, 512, network, Work())
                for n in (1e5, 1e6, 1e7)
            ]
            self.assertEqual(gains, sorted(gains))
            self.assertLess(gains[-1], 512)

    def test_table(self) -> None:
        lines = table(1e5, (1, 2), Work()).splitlines()
        self.assertEqual(len(lines), 4)
        self.assertEqual(len({line.count("|") for line in lines}), 1)


if __name__ == "__main__":
    unittest.main()
