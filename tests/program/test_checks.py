#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The checks and observations of a scene."""
import re
import unittest

from program import FAILURE, ProgramTest, checks, history, summary


class Checks(ProgramTest):
    """The sections Verification/Checks and Observations."""

    def test_a_check_that_fails(self) -> None:
        path = self.directory()
        text = self.run_scene(
            "wave_xpic",
            path,
            FAILURE,
            entries={
                "Time/End time": 0.02,
                "Verification/Checks": "max displacement_r : 0 : 1e-9;"
                " mean velocity_z : 1 : 0.1",
            },
        )
        self.assertIn("within 1e-09: yes", text)
        self.assertIn("within 0.1: no", text)
        self.assertEqual([check["pass"] for check in checks(path)], [True, False])

    def test_observations(self) -> None:
        """Of every step."""
        path = self.directory()
        self.run_scene("wave_series", path)
        rows = history(path, "observations")
        self.assertEqual(list(rows[0]), ["time_s", "top", "mode", "half", "side"])
        self.assertEqual(len(rows), summary(path)["steps"] + 1)
        self.assertEqual(len(rows), len(history(path)))
        lowest = min(row["top"] for row in rows)
        self.assertLess(lowest, 1.9 * rows[-1]["half"] * 1.31e-5, "the wave")
        self.assertGreater(len(checks(path)), 5)

    def test_each_kind_of_check_can_fail(self) -> None:
        failing = (
            "final half : 5 : 0.1",
            "trace top : 0 : 1e-6",
            "average top : 0 : 1e-6",
            "below half : -6",
            "above half : -4",
            "between half : -4 : -3",
            "drift top : 0.1",
            "spread stress_zz : 0.1",
            "rms displacement_z : 1 : 0.5",
        )
        text = self.run_scene(
            "wave_series",
            self.directory(),
            FAILURE,
            entries={"Verification/Checks": ";".join(failing)},
        )
        self.assertEqual(len(re.findall(": no\n", text)), len(failing), text)


if __name__ == "__main__":
    unittest.main()
