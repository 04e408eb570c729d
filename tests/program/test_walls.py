#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""wall.csv: the stresses along the walls, which add up to the forces on them."""
import math
import signal
import subprocess
import time
import unittest
from pathlib import Path

import numpy as np
from program import ALONE, STOPPED, SUCCESS, Entries, ProgramTest, scene

from caisson.verdict.loaded import load
from caisson.results import Results, Table
from caisson.export.springs import springs_of

TAN_DELTA = math.tan(math.radians(20))  # the default
ENTRIES: Entries = {
    "Verification/Checks": "",
    "Output/Record interval": 0.1,
    "Output/Frame penetrations": "0.6, 0.65, 0.7",
}
RADII = {"inner": 2.8, "outer": 3.0}  # m


class WallsTest(ProgramTest):
    """A test of wall.csv."""

    def walls_of(self, name: str, ranks: int = 1, **entries: object) -> Path:
        """Run a scene; return its directory."""
        path = self.directory(f"{name}_{ranks}")
        words = {
            key.replace("__", "/").replace("_", " "): v for key, v in entries.items()
        }
        self.run_scene(name, path, entries={**ENTRIES, **words}, ranks=ranks)
        return path

    def assert_sums(self, path: Path, walls: tuple[str, ...], n: int) -> Table:
        """Ask for the forces of history.csv as sums over n times; return the table."""
        run = Results(path)
        table, history = run.walls, run.history
        times = np.unique(table["time_s"])
        self.assertEqual(len(times), n)
        for t in times:
            rows = table["time_s"] == t
            (record,) = np.flatnonzero(history["time_s"] == t)
            depth = table["penetration_m"][rows]
            self.assertTrue((depth == history["penetration_m"][record]).all())
            for wall in walls:
                area, stress = [
                    table[f"{wall}_{name}"][rows]
                    for name in ("area_m2", "shear_stress_Pa")
                ]
                force = history[f"{wall}_friction_N"][record]
                self.assertGreater(abs(force), 100)
                np.testing.assert_allclose((area * stress).sum(), force, rtol=1e-6)
        return table


class Installation(WallsTest):
    """A caisson that is jacked, or drawn in by suction."""

    def test_sums(self) -> None:
        """On any number of ranks the walls add up, and have their area and stresses."""
        for name in ("jack", "suction"):
            tables = []
            for ranks in (1, 2):
                with self.subTest(scene=name, ranks=ranks):
                    path = self.walls_of(name, ranks)
                    tables.append(self.assert_sums(path, ("inner", "outer"), 4))
            one, two = tables
            self.assertEqual(one.keys(), two.keys())
            self.assertEqual("inner_pore_pressure_Pa" in one, name == "suction")
            np.testing.assert_allclose(one["depth_m"], two["depth_m"], atol=1e-3)
            for wall, radius in RADII.items():
                with self.subTest(scene=name, wall=wall):
                    self.assert_stresses(one, wall, radius)
                    normal = [t[f"{wall}_normal_stress_Pa"] for t in tables]
                    difference = np.abs(normal[0] - normal[1]).mean()
                    self.assertLess(difference, 0.1 * np.abs(normal[0]).mean())

    def assert_stresses(self, table: Table, wall: str, radius: float) -> None:
        """Ask for what holds at a smooth straight wall that slides down."""
        last = table["time_s"] == table["time_s"].max()
        column = {n: v[last] for n, v in table.items()}
        depth, area = column["depth_m"], column[f"{wall}_area_m2"]
        self.assertTrue((np.diff(depth) > 0).all(), "from above")
        # half of what lies between the rows beside each, but for both ends
        height = (depth[2:] - depth[:-2]) / 2
        np.testing.assert_allclose(area[1:-1], 2 * np.pi * radius * height, rtol=1e-6)
        normal, shear = [column[f"{wall}_{n}_stress_Pa"] for n in ("normal", "shear")]
        pressed = normal > 100  # not where suction has loosened the plug
        self.assertGreater(pressed.sum(), 2)
        mobilized = column[f"{wall}_mobilized_friction"][pressed]
        np.testing.assert_allclose(
            mobilized, shear[pressed] / (TAN_DELTA * normal[pressed]), rtol=1e-6
        )
        self.assertGreater(np.median(mobilized), 0.95)
        self.assertLess(mobilized.max(), 1.1)
        below = depth > 0
        at_rest = column["vertical_stress_at_rest_Pa"][below]
        np.testing.assert_allclose(at_rest, 8829 * depth[below], rtol=1e-6)
        np.testing.assert_allclose(
            column[f"{wall}_K"][below], normal[below] / at_rest, rtol=1e-6
        )
        np.testing.assert_allclose(
            column["horizontal_stress_at_rest_Pa"][below], at_rest / 2, rtol=1e-6
        )

    def test_tip_and_pressure(self) -> None:
        """The tip stress is the force over the area, and the pore pressure at the
        inner wall falls with the suction."""
        path = self.walls_of("suction")
        run, table = Results(path), Results(path).walls
        area = np.pi * (RADII["outer"] ** 2 - RADII["inner"] ** 2)
        last, history = table["time_s"] == table["time_s"].max(), run.history
        stress = history["tip_force_N"][-1] / area
        np.testing.assert_allclose(table["tip_stress_Pa"][last], stress, rtol=1e-6)
        pressure = table["inner_pore_pressure_Pa"][last & (table["depth_m"] > 0)]
        suction = history["suction_Pa"][-1]
        self.assertTrue((pressure > -suction).all() and (pressure < 0).all())
        self.assertLess(pressure[0], 0.7 * -suction)
        self.assertGreater(pressure[-1], pressure[0])

    def test_restart(self) -> None:
        """A run that is stopped within an interval goes on with the means over all of
        it, and without the frame that shows where it was stopped."""
        path = self.directory()
        entries: Entries = {
            **ENTRIES,
            "Output/Record interval": 100,
            "Output/Frame penetrations": "0.51, 1.15",
            "Time/End penetration": 1.2,
        }
        words = self.command(scene("jack"), "--output-directory", path, entries=entries)
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, env=ALONE) as process:
            while process.poll() is None and not (path / "points_0001.vtu").exists():
                time.sleep(0.01)
            time.sleep(0.3)  # some steps more
            process.send_signal(signal.SIGTERM)
        self.assertEqual(process.returncode, STOPPED)
        self.assertEqual(len(Results(path).frames()), 3)
        self.assertEqual(Results(path).walls, {})
        self.run_scene("jack", path, SUCCESS, "--restart", entries=entries)
        self.assert_sums(path, ("inner", "outer"), 1)
        self.assertEqual(len(Results(path).history["time_s"]), 2)
        self.assertEqual(len(Results(path).frames()), 4)


class Pull(WallsTest):
    """A caisson that is pulled after its installation."""

    def test_springs(self) -> None:
        """wall.csv has each record, and the springs add up to the forces."""
        path = self.walls_of(
            "jack",
            Output__Walls_at_each_record="true",
            Output__Record_interval=0.02,
            Output__Frame_penetrations="",
            Rigid_body__Velocity_table="0:0.1, 2:0.1, 2.1:0, 2.2:0, 4:-0.1",
            Time__End_penetration="never",
            Time__End_time=4,
        )
        run = load(path)
        times = run.results.history["time_s"]
        np.testing.assert_array_equal(np.unique(run.results.walls["time_s"]), times[1:])
        found = springs_of(run, 0.0)
        self.assertEqual(found.direction, -1)
        self.assertGreater(found.force.max(), 1e3)
        together = sum(s.area * s.resistance for s in found.springs)
        largest = found.force.max()
        np.testing.assert_allclose(together, found.force, atol=0.05 * largest)


class Others(WallsTest):
    """Bodies with one wall, and none."""

    def test_pile(self) -> None:
        """It has no inner wall."""
        path = self.walls_of(
            "equilibrium_pile",
            Rigid_body__Velocity=0.1,
            Time__End_time=0.3,
            Output__Frame_interval=0.2,
            Output__Frame_penetrations="",
        )
        table = self.assert_sums(path, ("outer",), 2)
        self.assertEqual([name for name in table if name.startswith("inner")], [])

    def test_no_wall(self) -> None:
        for name in ("compaction", "cavity"):
            path = self.walls_of(
                name, Time__End_time=1e-3, Output__Frame_penetrations=""
            )
            self.assertFalse((path / "wall.csv").exists())


if __name__ == "__main__":
    unittest.main()
