#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Suction beneath the lid of a caisson in undrained clay."""
import math
import unittest
from pathlib import Path

import numpy as np
from program import SUCCESS, Entries, ProgramTest, history, summary, user_scene

import caisson

INNER_RADIUS = 2.8  # m, of simulation/jack.prm
STRENGTH = 5e3  # Pa
WEIGHT = 6e4  # N, of water/suction.prm
CLAY: Entries = {
    "Rigid body/Friction angle of the outer wall": 0,
    "Rigid body/Friction angle of the inner wall": 0,
    "Rigid body/Friction angle of the tip": 0,
    "Soil/Layer 1/Youngs modulus": 300 * STRENGTH,
    "Soil/Layer 1/Poisson ratio": 0.49,
    "Soil/Layer 1/Friction angle": 0,
    "Soil/Layer 1/Cohesion": STRENGTH,
    "Soil/Layer 1/K0": 1,
    "Soil/Layer 1/Adhesion factor of the walls": 1,
    "Water/Water depth": 100,
    "Water/Suction control": "required",
    "Output/Frame interval": "never",
}
TOTAL_STRESS: Entries = {**CLAY, "Water/Level": "drained"}
LEVELS: dict[str, Entries] = {
    "drained": {},
    "undrained": {"Water/Bulk modulus": 5e7},
    "seepage": {"Soil/Layer 1/Permeability": 1e-10},
    "coupled": {
        "Soil/Layer 1/Permeability": 1e-10,
        "Material points/Per direction in path": 4,
    },
}
# so much suction draws in the plug of this scene before the caisson
LIFTED: Entries = {
    **TOTAL_STRESS,
    "Rigid body/Initial penetration": 1.5,
    "Rigid body/Submerged weight": 0,
    "Soil/Layer 1/Cohesion": "if(d < 1, 20e3, 1e3)",
    "Soil/Layer 1/Youngs modulus": 1e6,
    "Time/End penetration": 1.9,
}


class Lift(ProgramTest):
    """A caisson that is held, whose plug a growing suction lifts."""

    def suction_at(self, heave: float, name: str, entries: Entries) -> float:
        """Return the suction (Pa) at which the plug has risen so far (m)."""
        path = self.directory(name)
        held: Entries = {
            **CLAY,
            "Rigid body/Velocity": 1e-9,
            "Rigid body/Initial penetration": 1,
            "Water/Suction control": "table",
            "Water/Suction table": "0:0, 4:100e3",
            "Time/End penetration": "never",
            "Time/End time": 3,
            "Output/Record interval": 0.05,
        }
        self.run_scene("suction", path, entries={**held, **entries})
        rows = history(path)
        before = max(i for i, row in enumerate(rows) if row["plug_heave_m"] < heave)
        (s, h), (s_1, h_1) = (
            (row["suction_Pa"], row["plug_heave_m"]) for row in rows[before:][:2]
        )
        return s + (s_1 - s) * (heave - h) / (h_1 - h)

    def test_all_levels_agree(self) -> None:
        """Total stress, undrained water, and water that flows too slowly to count."""
        found = {
            level: self.suction_at(0.05, level, {"Water/Level": level, **entries})
            for level, entries in LEVELS.items()
        }
        # the adhesion of the inner wall, and at least what clay on a smooth wall bears
        adhesion = STRENGTH * 2 / INNER_RADIUS
        for level, suction in found.items():
            with self.subTest(level=level):
                self.assertAlmostEqual(suction / found["undrained"], 1, delta=0.05)
                self.assertGreater(suction, adhesion + 5 * STRENGTH)
                self.assertLess(suction, adhesion + 10 * STRENGTH)

    def test_tension_cut_off_does_not_count(self) -> None:
        """The suction takes the total stress of the plug, but no gap opens."""
        found = [
            self.suction_at(
                0.05,
                f"of_{cut_off:g}",
                {"Water/Level": "drained", "Soil/Layer 1/Tension cut-off": cut_off},
            )
            for cut_off in (0, 1e9)
        ]
        self.assertAlmostEqual(found[1] / found[0], 1, delta=0.02)


class Heave(ProgramTest):
    """The rise of the plug does not hang on Poisson's ratio: clay keeps its volume."""

    def test_compressed_clay(self) -> None:
        """With a ratio of 0.3 the plug is compressed by half of what it has risen; that
        volume is not taken from the heave."""
        heave = {}
        for ratio in (0.3, 0.49):
            path = self.directory(f"{ratio}")
            entries: Entries = {
                **TOTAL_STRESS,
                "Soil/Layer 1/Poisson ratio": ratio,
                "Rigid body/Initial penetration": 1.5,
                "Rigid body/Submerged weight": 0,
                "Time/End penetration": 1.9,
                "Output/Record interval": 0.5,
            }
            self.run_scene("suction", path, entries=entries)
            rows = history(path)
            self.assertGreater(min(row["plug_dilation_m3"] for row in rows), -1e-9)
            heave[ratio] = rows[-1]["plug_heave_m"]
        self.assertGreater(heave[0.3], 0.75 * heave[0.49])


class Stress(ProgramTest):
    """What frames and wall.csv show of a long skirt that is held, while a suction pulls
    at its plug that is far below the one that lifts it."""

    SUCTION, DEPTH, RADIUS = 30e3, 6, 15.0  # Pa, m, m
    HELD: Entries = {
        **TOTAL_STRESS,
        "Rigid body/Skirt length": 7,
        "Rigid body/Wall thickness": 0.4,
        "Rigid body/Initial penetration": DEPTH,
        "Rigid body/Velocity": 1e-9,
        "Soil/Layer 1/Youngs modulus": 6e6,
        "Soil/Layer 1/Cohesion": 2e4,
        "Water/Suction control": "table",
        "Water/Suction table": f"0:0, 1:{SUCTION}",
        "Grid/Outer radius": RADIUS,
        "Grid/Bottom": -18,
        "Grid/Top": 7.5,
        "Grid/Cell width": 1.5,
        "Grid/Cell height": 1.5,
        "Grid/Growth ratio": 1.5,
        "Grid/Fine width": 0.4,
        "Grid/Fine height": 0.4,
        "Grid/Moving zone below tip": 2,
        "Material points/Per direction in path": 2,
        "Material points/Per direction near": 2,
        "Time/Mass scaling": 10,
        "Time/End penetration": "never",
        "Time/End time": 1,
        "Output/Record interval": 1,
        "Output/Frame interval": 1,
    }

    def test_total_stress(self) -> None:
        """Far away nothing changes, in the plug the stress is less by the suction, and
        no field is shown as a pore pressure that is none."""
        path = self.directory()
        self.run_scene("suction", path, entries=self.HELD)
        run = caisson.load(path)
        self.assertTrue(run.results.scene["layers"][0]["total_stress"])
        frame = run.frame(index=-1)
        self.assertNotIn("pore_pressure_Pa", {**frame.point_data, **frame.cell_data})
        ratio = frame.cell_data["vertical_stress_over_stress_at_rest"]
        stress = frame.cell_data["stress_Pa"][:, 1]
        r, z = frame.corners.mean(axis=1).T
        outer = np.isfinite(ratio) & (r > self.RADIUS - 1)
        at_tip = outer & (np.abs(z + self.DEPTH) < 0.5)
        bottom = np.isfinite(ratio) & (z < -17)
        for where in (at_tip, bottom):
            self.assertGreater(where.sum(), 0)
            np.testing.assert_allclose(ratio[where], 1, atol=0.01)
        top = (r < 1) & (z < 0) & (z > -1)
        self.assertAlmostEqual(
            float(stress[top].mean() - stress[outer & (z < 0) & (z > -1)].mean()),
            self.SUCTION,
            delta=0.1 * self.SUCTION,
        )
        walls = run.results.walls
        self.assertNotIn("inner_pore_pressure_Pa", walls)
        near = np.argmin(np.abs(walls["depth_m"] - 1))
        self.assertLess(walls["inner_normal_stress_Pa"][near], -0.3 * self.SUCTION)

    def test_sand_on_clay(self) -> None:
        """In one frame, the sand has the pressure of its water, and the clay none."""
        path = self.directory()
        entries: Entries = {
            **self.HELD,
            "Water/Level": "seepage",
            "Soil/Number of layers": 2,
            "Soil/Layer 1/Friction angle": 30,
            "Soil/Layer 1/Cohesion": 0,
            "Soil/Layer 2/Law": "Mohr-Coulomb",
            "Soil/Layer 2/Top depth": 3,
            "Soil/Layer 2/Youngs modulus": 6e6,
            "Soil/Layer 2/Poisson ratio": 0.49,
            "Soil/Layer 2/Friction angle": 0,
            "Soil/Layer 2/Dilatancy angle": 0,
            "Soil/Layer 2/Cohesion": 2e4,
            "Soil/Layer 2/K0": 1,
            "Soil/Layer 2/Porosity": 0.4,
            "Soil/Layer 2/Solid density": 2500,
            "Soil/Layer 2/Permeability": 1e-9,
            "Soil/Layer 2/Adhesion factor of the walls": 1,
            "Time/End time": 0.2,
            "Water/Suction table": f"0:0, 0.2:{self.SUCTION / 5}",
        }
        self.run_scene("suction", path, entries=entries)
        run = caisson.load(path)
        total = [layer["total_stress"] for layer in run.results.scene["layers"]]
        self.assertEqual(total, [False, True])
        frame = run.frame(index=-1)
        r, z = frame.positions.T
        pressure, layer = (frame.point_data[n] for n in ("pore_pressure_Pa", "layer"))
        self.assertFalse(pressure[layer == 2].any())
        in_plug = (r < INNER_RADIUS) & (z < -0.5) & (z > -2)
        np.testing.assert_allclose(pressure[in_plug], -self.SUCTION / 5, rtol=0.02)
        outside = (r > 4) & (layer == 1)
        self.assertLess(np.abs(pressure[outside]).max(), 0.02 * self.SUCTION / 5)
        # the total stress goes on through the boundary
        stress = frame.point_data["stress_Pa"][:, 1] - pressure
        above, below = (
            float(stress[(r < 2) & (z > low) & (z < low + 0.6)].mean())
            for low in (-3, -3.6)
        )
        self.assertAlmostEqual(above - below, 0.6 * 8829, delta=0.2 * self.SUCTION / 5)


class Surface(ProgramTest):
    """The plug of a caisson rises: its clay enters cells from below."""

    def test_cells_with_little_clay_are_stable(self) -> None:
        """The stiff water in a thin layer of clay at the bottom of a cell moves the
        nodes above it, which have hardly any mass."""
        path = self.directory()
        self.run_program(
            SUCCESS,
            user_scene("suction_clay"),
            "--output-directory",
            path,
            entries={
                "Rigid body/Wall thickness": 0.25,
                "Rigid body/Skirt length": 4,
                "Grid/Outer radius": 9,
                "Grid/Bottom": -9,
                "Grid/Top": 5,
                "Grid/Refinement levels": 0,
                "Grid/Moving zone below tip": 2,
                "Material points/Per direction near": 2,
                "Material points/Per direction far": 2,
                "Water/Level": "undrained",
                "Time/End penetration": 1.1,
                "Output/Frame interval": "never",
                "Output/Frame penetrations": "",
            },
        )
        rows = history(path)
        self.assertLess(abs(rows[-1]["energy_residual"]), 0.01)
        self.assertGreater(min(row["pore_pressure_smallest_Pa"] for row in rows), -2e4)


class Installation(ProgramTest):
    """A caisson that suction draws into clay."""

    def run_clay(self, name: str, *options: str, **more: int | str) -> Path:
        """Return the results of a run, ranks and entries given."""
        path = self.directory(name)
        ranks = int(more.pop("ranks", 1))
        entries: Entries = {
            **TOTAL_STRESS,
            "Output/Record interval": 0.05,
            **{key.replace("_", " "): value for key, value in more.items()},
        }
        self.run_scene("suction", path, SUCCESS, *options, entries=entries, ranks=ranks)
        return path

    def test_equilibrium(self) -> None:
        """Weight and suction bear the soil's force; nothing flows, so that the pump
        takes what the lid and the plug displace."""
        path = self.run_clay("whole")
        self.assertNotIn("infeasible", summary(path)["scene"])
        rows = history(path)
        area = math.pi * INNER_RADIUS**2
        self.assertGreater(rows[-1]["suction_Pa"], 2e3)
        for name in ("exit_gradient_wall", "seepage_flow_m3_s", "critical_gradient"):
            self.assertNotIn(name, rows[0])
        for row in rows[-3:]:
            loads = WEIGHT + area * row["suction_Pa"]
            self.assertAlmostEqual(
                loads / row["total_force_with_water_N"], 1, delta=0.05
            )
            self.assertAlmostEqual(
                row["pumped_volume_m3"],
                area * (row["penetration_m"] - 0.5 + row["plug_heave_m"]),
                delta=1e-3,
            )
        # water that flows from here on begins with a field that is no pressure
        after: Entries = {
            **TOTAL_STRESS,
            "Installation/Directory": path,
            "Water/Level": "coupled",
            "Water/Suction control": "sealed",
            "Soil/Layer 1/Permeability": 1e-9,
            "Rigid body/Velocity": -0.01,
            "Time/End penetration": "never",
            "Time/End time": 0.01,
        }
        text = self.run_scene("suction", self.directory("after"), entries=after)
        self.assert_words(["no pore pressure", "Level = coupled, too"], text)

    def test_ranks_and_restart(self) -> None:
        whole = history(self.run_clay("one"))[-1]
        shared = history(self.run_clay("two", ranks=2))[-1]
        path = self.directory("restarted")
        runs: list[tuple[float, list[str]]] = [(0.62, []), (0.75, ["--restart"])]
        for end, options in runs:
            self.run_scene(
                "suction",
                path,
                SUCCESS,
                *options,
                entries={
                    **TOTAL_STRESS,
                    "Output/Record interval": 0.05,
                    "Time/End penetration": end,
                },
            )
        again = history(path)[-1]
        for name in ("suction_Pa", "total_force_N", "plug_heave_m"):
            self.assertAlmostEqual(shared[name] / whole[name], 1, delta=0.01, msg=name)
            self.assertAlmostEqual(again[name] / whole[name], 1, delta=1e-3, msg=name)

    def test_end_where_infeasible(self) -> None:
        """Stiff clay on soft: the suction that the friction of the upper clay takes
        lifts the plug, whose base bears little. The run says so, and ends."""
        path = self.directory()
        entries: Entries = {**LIFTED, "Installation/End where infeasible": 0.05}
        text = self.run_scene("suction", path, entries=entries)
        self.assert_words(["not been feasible", "plug lift", "0.05 m"], text)
        found = summary(path)["scene"]["infeasible"]
        self.assertEqual(found["reason"], "plug lift")
        last = history(path)[-1]["penetration_m"]
        self.assertGreaterEqual(last, found["penetration_m"] + 0.05)
        self.assertLess(last, 1.85)


class BadInput(ProgramTest):
    """Scenes without an answer."""

    def test_messages(self) -> None:
        cases: list[tuple[Entries, list[str]]] = [
            ({"Soil/Layer 1/Friction angle": 5}, ["Layer 1", "undrained strength"]),
            ({"Grid/Geometry": "plane strain"}, ["suction", "plane strain"]),
            ({"Rigid body/Initial penetration": 0}, ["Initial penetration"]),
            ({"Water/Suction control": "sealed"}, ["sealed", "Level = coupled"]),
        ]
        for entries, words in cases:
            with self.subTest(entries=entries):
                self.assert_invalid(words, "suction", {**TOTAL_STRESS, **entries})

    def test_no_suction_unless_asked(self) -> None:
        path = self.directory()
        entries: Entries = {**TOTAL_STRESS, "Water/Suction control": "automatic"}
        text = self.run_scene("suction", path, entries=entries)
        self.assertNotIn("suction_Pa", history(path)[-1])
        self.assert_words(["Submerged weight", "not used"], text)


if __name__ == "__main__":
    unittest.main()
