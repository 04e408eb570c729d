# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading the log of a vessel: units, order, clocks, spikes, and what is refused."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

from caisson.disk import InputError
from caisson.vessel_log import measured


class Reading(unittest.TestCase):
    """Files of logs."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.file = Path(temporary.name) / "log.csv"

    def read(self, *lines: str) -> measured.Log:
        """Return the log of some lines."""
        self.file.write_text("\n".join(lines) + "\n", encoding="utf-8")
        return measured.read(self.file)

    def test_units(self) -> None:
        log = self.read(
            "Date;Time;Penetration (cm);Differential pressure [mbar];Flow (l/s);Heel",
            "2026-05-01;10:00:00;120,5;15,0;2;0,1",
            "2026-05-01;10:00:30;121,5;16,0;2;0,1",
        )
        np.testing.assert_allclose(log.depth, [1.205, 1.215])
        np.testing.assert_allclose(log.suction, [1.5, 1.6])
        np.testing.assert_allclose(log.flow, [7.2, 7.2])
        self.assertTrue(np.isnan(log.resistance).all())

    def test_more_units(self) -> None:
        for head, cell, found in (
            ("dP (mbar)", "150", 15.0),
            ("Underpressure, hPa", "150", 15.0),
            ("suction_psi", "2", 13.789514),
            ("\u0394p [bar]", "0.15", 15.0),
            ("differential pressure (MPa)", "0.015", 15.0),
            ("vacuum_mH2O", "2", 19.6133),
        ):
            log = self.read(f"depth_ft,{head.replace(',', ' ')}", *[f"10,{cell}"] * 2)
            np.testing.assert_allclose(log.depth, 3.048)
            np.testing.assert_allclose(log.suction, found)

    def test_tilt(self) -> None:
        """The resultant of two axes, or the one that there is."""
        both = np.degrees(np.arctan(np.hypot(*np.tan(np.radians([0.3, 0.4])))))
        for heads, cells, found in (
            ("Pitch (deg),Roll (deg)", "0.3,-0.4", both),
            ("tilt_x_deg,tilt_y_deg", "0.3,0.4", both),
            ("Trim [\u00b0],List [\u00b0]", "-0.3,0.4", both),
            ("inclination x (rad),inclination y (rad)", "0.00523599,0.00698132", both),
            ("Heel", "0.4", 0.4),
            ("tilt_deg,pitch_deg,roll_deg", "0.7,0.3,0.4", 0.7),
        ):
            log = self.read(f"depth_m,suction_kPa,{heads}", f"1,2,{cells}")
            np.testing.assert_allclose(log.tilt, found, rtol=1e-5, err_msg=heads)

    def test_spikes(self) -> None:
        """A few readings that exceed all around them, and nothing else."""
        rng = np.random.default_rng(1)
        ramp = np.linspace(5, 100, 60) * (1 + 0.05 * rng.normal(size=60))
        steps = np.repeat([0.0, 5.0, 20.0, 60.0], 15)
        pulses = np.tile(np.repeat([0.0, 50.0], [6, 2]), 8)
        for name, values, at, to in (
            ("one", ramp, [30], 999),
            ("two", ramp, [10, 40], 999),
            ("three in a row", ramp, [30, 31, 32], 500),
            ("near each other", ramp, [30, 34], 999),
            ("below zero", ramp, [30], -999),
            ("the first", ramp, [0, 1], 999),
            ("the last", ramp, [57, 58, 59], 999),
            ("in a low part", ramp, [2], 60),
            ("a dead sensor", np.full(20, 7.0), [9], 999),
            ("while nothing is pumped", steps, [5], 999),
            ("beside a step", steps, [29], 999),
            ("of a short log", ramp[:6], [3], 999),
            ("no spike: a ramp", ramp, [], 0),
            ("no spike: steps", steps, [], 0),
            ("no spike: a step at the end", steps[:47], [], 0),
            ("no spike: a constant sensor", np.full(20, 7.0), [], 0),
            ("no spike: zeros", np.zeros(20), [], 0),
            ("no spike: growth", np.geomspace(1, 1000, 20), [], 0),
            ("no spike: pulses of the pump", pulses, [], 0),
            ("no spike: a pulse of six", ramp, [], 0),
        ):
            changed = values.copy()
            changed[at] = to
            changed[30:36] *= 4 if "six" in name else 1
            found = np.flatnonzero(measured.spikes_in(changed))
            self.assertEqual(found.tolist(), at, name)

    def test_order_and_remarks(self) -> None:
        log = self.read(
            "time_min,depth_m,suction_kPa,weight_MN",
            *("2,1.2,12,1", "1,1.1,11,1", "1,1.1,11,1", "3,,13,1", "4,1.4,14,1.1"),
        )
        np.testing.assert_allclose(log.time, [60, 120, 240])
        np.testing.assert_allclose(log.weight, [1000, 1000, 1100])
        self.assertNotIn("spike", " ".join(log.remarks))
        self.assertIn("1 rows without depth and suction", log.remarks[0])
        self.assertIn("1 repeated rows", log.remarks[1])
        self.assertIn("were sorted", log.remarks[2])

    def test_clock_that_starts_anew(self) -> None:
        """The rows stay in their order where a clock starts anew; rows from the last
        one to the first are turned about."""
        depth, head = np.linspace(1, 3, 21), "time_s,depth_m,suction_kPa"
        time = 10.0 * np.arange(21)
        for times, way in (
            (np.append(time[:12], time[:9]), 1),
            (time, -1),
        ):
            rows = [f"{t:g},{z:g},10" for t, z in zip(times, depth)][::way]
            log = self.read(head, *rows)
            np.testing.assert_allclose(log.depth, depth)
            self.assertTrue((np.diff(log.time) >= 0).all())
            self.assertEqual("starts anew at 1 of" in " ".join(log.remarks), way > 0)

    def test_past_midnight(self) -> None:
        """A clock without a date goes on on the next day; rows that are not in order
        by less than half a day are sorted."""
        rows = ("23:40,1,10", "23:55,1.1,11", "23:50,1.05,10.5", "00:10,1.2,12")
        log = self.read("time,depth_m,suction_kPa", *rows)
        np.testing.assert_allclose(log.depth, [1, 1.05, 1.1, 1.2])
        np.testing.assert_allclose(np.diff(log.time), [600, 300, 900])

    def test_refused(self) -> None:
        for lines, text in (
            (("depth_m,qc_MPa", "1,2"), "no row names a column of depth and one of"),
            (("depth_m,suction", "1,2"), "'suction' has no unit that is known"),
            (
                ("depth_m,dp (torr)", "1,2"),
                r"'dp \(torr\)' has the unit 'torr', .* in one of kPa, Pa, .*psi",
            ),
            (("depth_m,druck_mbar", "1,2"), "resistance, only depth_m, druck_mbar; "),
            (("depth_m,suction_kPa,dp_kPa", "1,2,3"), "one column of suction"),
            (("depth_m,suction_kPa", "1,-5", "2,-6"), "suction is negative"),
            (("depth_m,suction_kPa", "1,x", "2,"), "0 rows have a number"),
        ):
            with self.assertRaisesRegex(InputError, text):
                self.read(*lines)
        self.assertRaisesRegex(InputError, "as a table: it is no", self.read, "\0")


if __name__ == "__main__":
    unittest.main()
