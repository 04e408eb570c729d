# SPDX-License-Identifier: LGPL-2.1-or-later
"""Buckling of the wall under suction: by hand, and with the pressures of a run."""
import unittest
from math import inf, pi
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from synthetic import write_columns, write_run

from caisson.design import shell
from caisson.design.shell import Ring, Wall
from caisson.results import Results

STEEL = (355e6, 210e9, 0.5)
BUCKET = Wall(9.5, 0.03, 9.0, *STEEL)


class ByHand(unittest.TestCase):
    """DNV-RP-C202 with f_y = 355 MPa, E = 210 GPa and nu = 0.3, line by line."""

    def check(self, found: float, by_hand: float) -> None:
        self.assertAlmostEqual(found, by_hand, delta=0.01 * by_hand)

    def test_bucket(self) -> None:
        """D = 9.5 m, t = 30 mm, l = 5 m, 80 kPa, 12.16 MN: r = 4.735 m, Z = 0.9539 *
        25 / 0.14205 = 167.9, pi^2 E / 10.92 (t / l)^2 = 6.833 MPa.

        Axial: xi = 117.9, rho = 0.5 / sqrt(1 + 157.8 / 150) = 0.3490, C = 41.15, 281.2
        MPa. Pressure: xi = 13.48, C = 4 sqrt(1 + 2.021^2) = 9.021, 61.64 MPa.
        sigma_h = 12.63, sigma_a = 13.62, sigma_j = 13.15 MPa;
        lambda^2 = 355 / 13.15 (13.62 / 281.2 + 12.63 / 61.64) = 6.837, gamma_M = 1.45,
        f_d = 355 / sqrt(1 + 46.74) / 1.45 = 35.43 MPa; 13.15 / 35.43 = 0.371."""
        axial, hoop = shell.elastic_strengths(BUCKET, 5.0)
        self.check(axial, 281.2e6)
        self.check(hoop, 61.64e6)
        self.check(shell.unity_check(BUCKET, 5.0, 80e3, 12.16e6), 0.371)

    def test_stocky(self) -> None:
        """D = 3 m, t = 40 mm, l = 2 m, 1.5 MPa, 2 MN: r = 1.48 m, Z = 64.46, the factor
        is 75.92 MPa; f_Ea = 20.29 * 75.92 = 1540 MPa, f_Eh = 6.411 * 75.92 = 486.7 MPa.
        sigma_h = 55.5, sigma_a = 5.377, sigma_j = 53.02 MPa; lambda^2 = 6.696
        (0.003491 + 0.1140) = 0.7869, lambda = 0.8871, gamma_M = 0.85 + 0.6 * 0.8871 =
        1.382, f_d = 355 / sqrt(1 + 0.6193) / 1.382 = 201.8 MPa; 0.2627."""
        self.check(shell.unity_check(Wall(3, 0.04, 2, *STEEL), 2.0, 1.5e6, 2e6), 0.2627)

    def test_long(self) -> None:
        """D = 1 m, t = 2 mm, l = 40 m, 200 Pa, 1 kN: l / r = 80.2 > 2.25 sqrt(249.5) =
        35.5, so f_Eh = 0.25 E / 249.5^2 = 0.8434 MPa. sigma_h = 49.9 kPa, sigma_a =
        159.5 kPa, sigma_j = 141.3 kPa, f_Ea = 156.1 MPa; lambda^2 = 2512 (0.001022 +
        0.05917) = 151.2, f_d = 355 / 151.2 / 1.45 = 1.619 MPa; 0.0873."""
        wall = Wall(1, 0.002, 40, *STEEL)
        self.check(shell.elastic_strengths(wall, 40.0)[1], 0.8434e6)
        self.check(shell.unity_check(wall, 40.0, 200.0, 1e3), 0.0873)

    def test_lengths(self) -> None:
        """9 m of skirt at 4 m: 5 m are free and 4 m, not 4.75 m, in the soil."""
        self.assertAlmostEqual(BUCKET.buckling_length(4.0), 9.0)
        self.assertAlmostEqual(BUCKET.buckling_length(8.0), 1 + 4.75)
        self.assertAlmostEqual(BUCKET._replace(rings=2.0).buckling_length(8.0), 2.0)

    def test_limit(self) -> None:
        """Under the limit times the factor the unity check is 1; weight counts."""
        weight, h = 6.5e6, 6.0
        for factor in (0.1, 1.0, 1.3):
            limit = shell.limit_suction(BUCKET, h, weight, 5e3, factor)
            loads = (factor * x for x in (limit, weight, 5e3))
            self.assertAlmostEqual(shell.check_at(BUCKET, h, *loads), 1.0, places=4)
        light = shell.limit_suction(BUCKET, h, 0.0, 0.0)
        self.assertGreater(light, shell.limit_suction(BUCKET, h, weight, 0.0))
        self.assertEqual(shell.limit_suction(BUCKET, h, 500e6), 0.0)
        deep, shallow = (shell.limit_suction(BUCKET, x, weight) for x in (8.5, 5.0))
        self.assertGreater(deep, 1.2 * shallow)

    def test_ring(self) -> None:
        """A flat bar of 300 x 40 mm on D = 8 m, t = 30 mm, l = 3 m, at 100 kPa and 10
        MN: r = 3.985 m, Z = 0.9539 * 9 / 0.11955 = 71.81, A = (2 / 71.81^2 + 0.06) 0.09
        = 5.435e-3 m2 of 12e-3.

        l_ef = 1.56 * 0.3458 / 1.0903 = 0.4947 m, 14.84e-3 m2; the centroid is 12 * 165
        / 26.84 = 73.77 mm from the middle of the wall: I = 90.0e-6 + 12e-3 * 0.09123^2
        + 1.11e-6 + 14.84e-3 * 0.07377^2 = 271.8e-6 m4.
        sigma_a = 10 / (2 pi 0.11955) = 13.31 MPa; beta = 3 / 0.5394 = 5.562, l_e0 =
        0.5394 m, sigma_hR = (13.28 - 3.99) / (1 + 12 / 16.18) * 3.985 / 3.67 = 5.79
        MPa. r_0 = 3.911 m, z_t = 315 - 73.77 = 241.2 mm: 3 * 210e3 * 0.2412 * 0.019925
        / (15.297 * (177.5 - 5.79)) = 1.153, so that the pressure needs 0.1 * 3.985 *
        15.297 * 3 / 630e3 * 2.653 = 77.0e-6 and the axial stress 13.31 * 0.03 * 234.0
        / (500 * 210e3 * 3) = 0.30e-6 m4. 300 mm of 0.4 * 24.32 * 40 = 389 mm: 0.771."""
        near, ring = (Wall(8.0, 0.03, 9.0, *STEEL), 3.0), Ring(3.0, 0.3, 0.04)
        self.check(shell.needed_area(*near), 5.435e-3)
        inertia, inward = shell.section(*near, ring)
        self.check(inertia, 271.8e-6)
        self.check(inward, 73.77e-3)
        self.check(shell.edge_stress(*near, ring, 100e3, 13.31e6), 5.79e6)
        self.check(shell.needed_inertia(*near, ring, 100e3, 10e6), 77.3e-6)
        self.check(shell.demand(*near, ring, 100e3, 10e6), 0.771)
        self.check(shell.demand(*near, Ring(3.0, 0.1, 0.04), 0.0, 0.0), 5.435 / 4)
        self.assertEqual(shell.needed_inertia(*near, ring, 20e6, 0.0), inf)

    def test_ring_divides_the_wall(self) -> None:
        """One that suffices, in the part that buckles, is as the spacing of rings
        that are known; a weak one does not count, nor one below, nor one among
        rings that are known."""
        h, weight = 5.0, 6.5e6  # 4 m are free and 4.75 m in the soil
        plain = shell.limit_suction(BUCKET, h, weight)
        for ring, counts in (
            (Ring(4.375, 0.4, 0.05), True),
            (Ring(4.375, 0.05, 0.05), False),
            (Ring(8.9, 0.4, 0.05), False),
        ):
            wall = BUCKET._replace(stiffeners=(ring,))
            found = shell.limit_suction(wall, h, weight)
            beside = BUCKET._replace(stiffeners=(Ring(2.0, 0.05, 0.05), ring))
            self.assertEqual(shell.limit_suction(beside, h, weight), found)
            if counts:
                half = BUCKET._replace(rings=4.375)
                self.check(found, shell.limit_suction(half, h, weight))
                self.assertGreater(found, 1.5 * plain)
            else:
                self.assertEqual(found, plain)
        known = BUCKET._replace(rings=2.0)
        more = known._replace(stiffeners=(Ring(1.0, 0.4, 0.05),))
        limits = [shell.limit_suction(wall, h, weight) for wall in (known, more)]
        self.assertEqual(*limits)

    def test_tension(self) -> None:
        """Without compression there is nothing that buckles, but steel yields."""
        wall, hoop = BUCKET, 100e6
        check = shell.unity_check(wall, 5.0, -hoop * 0.03 / wall.radius, 0.0)
        self.assertAlmostEqual(check, hoop / (355e6 / 1.15))
        self.assertEqual(shell.unity_check(wall, 5.0, 0.0, 0.0), 0.0)


class OfRun(unittest.TestCase):
    """A made-up run: 50 kPa of suction at 4 m, 60 kPa at 8 m."""

    def run_with(self, folder: str, excess: float) -> Results:
        """Leave a run whose soil presses from outside by an excess (Pa) beyond the
        suction."""
        t = np.array([0.0, 1.0, 2.0])
        s = np.array([0.0, 50e3, 60e3])
        history = {"time_s": t, "penetration_m": 4 * t, "suction_Pa": s}
        write_run(Path(folder), history, None)
        rows = [(1.0, 4.0, z) for z in np.linspace(-0.1, 4, 42)]
        rows += [(2.0, 8.0, z) for z in np.linspace(0.1, 8, 80)]
        time, h, z = np.array(rows).T
        pressure = np.interp(time, t, s)
        walls = {
            "time_s": time,
            "penetration_m": h,
            "depth_m": z,
            "inner_normal_stress_Pa": 9e3 * z,
            "inner_pore_pressure_Pa": -pressure,
            "outer_normal_stress_Pa": 9e3 * z + excess,
            "outer_pore_pressure_Pa": 0 * z,
        }
        write_columns(Path(folder, "wall.csv"), walls)
        return Results(Path(folder))

    def test_pressures(self) -> None:
        """The suction above the mudline, and what both sides leave below it."""
        with TemporaryDirectory() as folder:
            found = shell.pressures_of(self.run_with(folder, 7e3), BUCKET)
        last = found["time_s"] == 2
        at = dict[str, Any]({k: v[last] for k, v in found.items()})
        self.assertAlmostEqual(at["depth_m"][0], -1.0)
        self.assertAlmostEqual(at["below_lid_m"][-1], 9.0)
        p = at["net_external_pressure_Pa"]
        self.assertTrue(np.allclose(p[:2], 60e3))
        self.assertTrue(np.allclose(p[2:], 67e3))

    def test_mean(self) -> None:
        """At 8 m the part from 1 to 5.75 m has 7 kPa more; its weight is one less the
        integral of 2 sin^2 over the first 1/5.75, less what the jump needs."""
        share = 1 / 5.75
        exact = 7e3 * (1 - share + np.sin(2 * pi * share) / (2 * pi))
        with TemporaryDirectory() as folder:
            run = self.run_with(folder, 7e3)
            pressures = shell.pressures_of(run, BUCKET)
        more = shell.beyond_suction(pressures, BUCKET, [2.0, 6.0, 8.0, 9.0])
        self.assertAlmostEqual(more[2], exact, delta=0.02 * exact)
        self.assertEqual(more[2], more[3])
        self.assertTrue(more[0] < more[1] < more[2])
        self.assertEqual(shell.beyond_suction({}, BUCKET, [1.0]).tolist(), [0.0])

    def test_no_run_with_suction(self) -> None:
        with TemporaryDirectory() as folder:
            run = self.run_with(folder, 0.0)
            (Path(folder) / "wall.csv").unlink()
            self.assertEqual(shell.pressures_of(run, BUCKET), {})


if __name__ == "__main__":
    unittest.main()
