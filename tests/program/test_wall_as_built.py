#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Caissons whose wall has steps, a bevel and rings."""
import math
import unittest
from pathlib import Path

import numpy as np
from program import SUCCESS, Entries, ProgramTest, Rows, history, summary

from caisson.results import Results

RING: Entries = {"Rigid body/Rings": "0.8 : 0.2 : 0.15"}
# of simulation/jack.prm
CLAY: Entries = {
    "Rigid body/Friction angle of the inner wall": 0,
    "Rigid body/Friction angle of the outer wall": 0,
    "Rigid body/Friction angle of the tip": 0,
    "Soil/Layer 1/Friction angle": 0,
    "Soil/Layer 1/Cohesion": 20e3,
    "Soil/Layer 1/Youngs modulus": 8e6,
    "Soil/Layer 1/Poisson ratio": 0.49,
    "Time/Mass scaling": 400,
    "Time/End penetration": 1.2,
}
FASTER: Entries = {"Time/Mass scaling": 100}
FORCES = ("tip", "inner_friction", "outer_friction", "top", "lid", "ring")


def total(row: dict[str, float]) -> float:
    """Return the sum of the forces of a row (N)."""
    columns = (name if "friction" in name else f"{name}_force" for name in FORCES)
    return sum(row[f"{column}_N"] for column in columns)


class Equal(ProgramTest):
    """A wall whose thickness is given more than once."""

    def test_equal_thicknesses(self) -> None:
        """Two equal thicknesses are one, to the last digit."""
        files = []
        for name, steps in (("plain", ""), ("stepped", "1 : 0.2, 2 : 0.2")):
            path = self.directory(name)
            self.run_scene("jack", path, entries={"Rigid body/Wall steps": steps})
            files.append((path / "history.csv").read_text())
        self.assertEqual(*files)
        self.assertNotIn("ring_force_N", files[0])


class AsBuilt(ProgramTest):
    """tests/bodies/wall_as_built.prm: a step, a bevel and a ring in sand."""

    def run_it(self, name: str, entries: Entries, ranks: int = 1) -> Path:
        path = self.directory(name)
        entries = {**FASTER, "Output/Record interval": 0.1, **entries}
        self.run_scene("wall_as_built", path, entries=entries, ranks=ranks)
        return path

    def assert_outside(self, rows: Rows) -> None:
        """Ask for no soil inside the body at any time, and forces that add up."""
        self.assertGreater(len(rows), 20)
        for row in rows:
            self.assertEqual(row["points_in_body"], 0)
            self.assertLess(row["soil_into_body_m3"], 1e-3)  # of 3.2 m3
            self.assertAlmostEqual(total(row), row["total_force_N"], delta=1)

    def test_no_soil_inside(self) -> None:
        """Whichever side is flush or beveled, whether the wall becomes thicker, and
        where points split and merge in halved cells."""
        halved: Entries = {
            "Grid/Refinement levels": 1,
            "Grid/Refined distance": 0.6,
            "Material points/Split and merge": "true",
        }
        scenes: dict[str, Entries] = {
            "halved": halved,
            "thick": {"Rigid body/Wall steps": "0.8 : 0.3"},
            "flush": {
                "Rigid body/Flush face": "inner",
                "Rigid body/Edge of the tip": 1,
            },
        }
        for name, more in scenes.items():
            with self.subTest(name):
                checks: Entries = {"Verification/Checks": ""}
                path = self.run_it(name, {**checks, **more})
                self.assert_outside(history(path))
                self.assertEqual(summary(path)["scene"]["ring_1_width_m"], 0.2)

    def test_ranks_and_walls(self) -> None:
        """On two ranks forces are those on one, and wall.csv adds up to them."""
        more: Entries = {"Output/Walls at each record": "true"}
        rows = []
        for ranks in (1, 2):
            path = self.run_it(f"ranks_{ranks}", more, ranks)
            rows.append(history(path))
            walls, last = Results(path).walls, rows[-1][-1]
            own = walls["time_s"] == last["time_s"]
            for wall in ("inner", "outer"):
                force = np.nansum(
                    walls[f"{wall}_area_m2"][own]
                    * walls[f"{wall}_shear_stress_Pa"][own]
                )
                self.assertAlmostEqual(force, last[f"{wall}_friction_N"], delta=1)
        forces = [
            [{"time_s": row["time_s"], "total": total(row)} for row in of_ranks]
            for of_ranks in rows
        ]
        self.assert_same_history(forces[0], forces[1], 1e-6)

    def test_restart(self) -> None:
        whole = self.run_it("whole", {"Verification/Checks": ""})
        path = self.directory("parts")
        for end, *options in ((0.8,), (1.1, "--restart")):
            entries: Entries = {
                **FASTER,
                "Output/Record interval": 0.1,
                "Time/End penetration": end,
                "Verification/Checks": "",
            }
            self.run_scene("wall_as_built", path, SUCCESS, *options, entries=entries)
        last, other = history(path)[-1], history(whole)[-1]
        for force in ("ring", "tip"):
            name = f"{force}_force_N"
            self.assertAlmostEqual(last[name] / other[name], 1, delta=0.02)


class RingInClay(ProgramTest):
    """The caisson of jack.prm in clay, with and without a ring."""

    def test_ring_adds_its_bearing(self) -> None:
        """A ring bears nothing before clay reaches it, and then five to eight times
        the strength over its area; tip and outer wall do not notice it."""
        rows: dict[str, Rows] = {}
        entries: dict[str, Entries] = {"plain": CLAY, "ring": {**CLAY, **RING}}
        for name in entries:
            path = self.directory(name)
            self.run_scene("jack", path, entries=entries[name])
            rows[name] = history(path)
        area = math.pi * (2.8**2 - 2.6**2)
        ring = [row["ring_force_N"] / (area * 20e3) for row in rows["ring"]]
        depth = [row["penetration_m"] for row in rows["ring"]]
        self.assertTrue(all(x == 0 for x, d in zip(ring, depth) if d < 0.65))
        self.assertGreater(min(ring[-3:]), 5)
        self.assertLess(max(ring[-3:]), 8)
        with_ring, plain = rows["ring"][-1], rows["plain"][-1]
        ratio = with_ring["tip_force_N"] / plain["tip_force_N"]
        self.assertAlmostEqual(ratio, 1, delta=0.1)
        more = with_ring["total_force_N"] - plain["total_force_N"]
        self.assertAlmostEqual(more / with_ring["ring_force_N"], 1, delta=0.2)


class RingInWater(ProgramTest):
    """Water flows around a ring, and presses on it."""

    def test_seepage(self) -> None:
        """What the plug gives comes from outside; the ring makes the way of the
        water longer, and the force on its faces adds up with that of the suction."""
        still: Entries = {
            "Rigid body/Velocity": 0,
            "Rigid body/Ramp time": 0,
            "Rigid body/Initial penetration": 1.0,
            "Water/Suction control": "table",
            "Water/Suction table": "0:0, 0.1:3000",
            "Time/End penetration": "never",
            "Time/End time": 0.3,
            "Output/Record interval": 0.1,
        }
        last = {}
        for name, rings in (("plain", ""), ("ring", "0.5 : 0.8 : 0.2")):
            path = self.directory(name)
            entries: Entries = {**still, "Rigid body/Rings": rings}
            self.run_scene("suction", path, entries=entries)
            last[name] = history(path)[-1]
        for row in last.values():
            out, into = row["seepage_flow_m3_s"], row["seepage_inflow_m3_s"]
            self.assertAlmostEqual(out, into, delta=1e-9)
        flow = {name: row["seepage_flow_m3_s"] for name, row in last.items()}
        self.assertLess(flow["ring"], 0.97 * flow["plain"])
        # below the ring the suction is smaller than above it: this presses up
        force = {name: row["tip_water_force_N"] for name, row in last.items()}
        self.assertGreater(force["ring"], force["plain"] + 500)

    def test_coupled_is_refused(self) -> None:
        entries: Entries = {**RING, "Water/Level": "coupled"}
        words = ["Water/Level is coupled", "Rings", "seepage or undrained"]
        self.assert_invalid(words, "suction", entries)


if __name__ == "__main__":
    unittest.main()
