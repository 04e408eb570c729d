#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Caissons that are pulled: drained, and with water beneath a sealed lid."""
import math
import unittest
from pathlib import Path

import numpy as np
from program import (
    BAD_INPUT,
    SUCCESS,
    Entries,
    ProgramTest,
    Results,
    Rows,
    history,
)
from caisson.verdict import outcome


LIMIT = "Rigid body/Largest Mach number"
MASS = "Time/Mass scaling"
END = "Time/End penetration"
STRENGTH = 2e4  # Pa, of the clay
RADIUS = 1.5  # m, of the body in it
AREA = math.pi * 2.8**2  # m2, of the lid of simulation/jack.prm
PULL: Entries = {
    "Rigid body/Velocity": -0.2,
    "Rigid body/Ramp time": 0,
    LIMIT: 1e-3,
    "Method/Local damping": 0.4,
}
SEALED: Entries = {
    "Water/Level": "coupled",
    "Water/Suction control": "sealed",
    "Soil/Layer 1/Permeability": 1e-4,
    "Rigid body/Initial penetration": 1,
    "Rigid body/Velocity": -0.01,
    "Output/Record interval": 0.05,
}
CLAY: Entries = {
    "Rigid body/Outer diameter": 2 * RADIUS,
    "Rigid body/Skirt length": 2.5,
    "Rigid body/Friction angle of the outer wall": 0,
    "Rigid body/Adhesion of the outer wall": STRENGTH,
    "Soil/Layer 1/Youngs modulus": 4e6,
    "Soil/Layer 1/Friction angle": 0,
    "Soil/Layer 1/Cohesion": STRENGTH,
    "Grid/Outer radius": 8,
    "Grid/Bottom": -8,
    "Grid/Top": 3,
    "Grid/Cell width": 0.5,
    "Grid/Cell height": 0.4,
    "Grid/Fine width": 0.15,
    "Grid/Fine height": 0.15,
    END: 1.35,
    "Output/Record interval": 0.05,
}


def largest_tension(path: Path) -> float:
    """Return the largest pull of a drained run (N)."""
    return -min(row["total_force_N"] for row in history(path))


def pull(row: dict[str, float]) -> float:
    """Return the pull of a caisson with a sealed lid (N), besides its weight."""
    return row["suction_force_N"] - row["total_force_N"] - row["tip_water_force_N"]


class Drained(ProgramTest):
    """The drained pull is that of a slow one."""

    def test_after_an_installation(self) -> None:
        """The velocity does not matter, and without the limit inertia would."""
        before = self.directory("before")
        self.run_scene("jack", before, entries={END: 0.75})
        tension = {}
        runs: dict[str, Entries] = {
            "fast": {},
            "slow": {"Rigid body/Velocity": -0.05},
            "unlimited": {LIMIT: "unlimited"},
        }
        for name, entries in runs.items():
            path = self.directory(name)
            more: Entries = {
                **PULL,
                END: 0.69,
                "Installation/Directory": before,
                "Output/Record interval": 0.01 if name == "unlimited" else 0.1,
            }
            self.run_scene("jack", path, entries={**more, **entries})
            tension[name] = largest_tension(path)
        self.assertAlmostEqual(tension["fast"] / tension["slow"], 1, 6)
        self.assertGreater(tension["unlimited"], 1.4 * tension["fast"])

    def test_mass_scaling(self) -> None:
        """From the same state, soil of any inertia gives the same."""
        tension = []
        for scaling in (4, 100):
            path = self.directory(f"{scaling}")
            entries: Entries = {
                **PULL,
                MASS: scaling,
                END: 0.99,
                "Rigid body/Initial penetration": 1,
                "Output/Record interval": 0.02 * math.sqrt(scaling),
            }
            self.run_scene("jack", path, entries=entries)
            tension.append(largest_tension(path))
        self.assertAlmostEqual(tension[0] / tension[1], 1, delta=0.03)

    def test_water_takes_its_time(self) -> None:
        text = self.run_scene(
            "jack",
            self.directory(),
            BAD_INPUT,
            entries={**PULL, "Water/Level": "coupled"},
        )
        self.assert_words([LIMIT, "unlimited"], text)


class SealedLid(ProgramTest):
    """Water beneath a sealed lid, whose pressure follows from its volume."""

    def assert_balanced(self, rows: Rows) -> None:
        """The books of the water and of the energy, and the plug by its points."""
        for row in rows:
            self.assertLess(abs(row["lid_water_balance"]), 1e-8)
            self.assertLess(abs(row["water_balance"]), 1e-8)
        self.assertLess(abs(rows[-1]["energy_residual"]), 0.01)
        rise = max(abs(row["plug_rise_m3"]) for row in rows)
        for row in rows:
            by_points = row["plug_heave_volume_m3"]
            self.assertAlmostEqual(row["plug_rise_m3"], by_points, delta=0.02 * rise)

    def test_drained_limit(self) -> None:
        """Soil that conducts well bears the pull by friction, as with an open lid."""
        drained, sealed = self.directory("drained"), self.directory("sealed")
        entries: Entries = {
            **SEALED,
            "Soil/Layer 1/Permeability": 10,
            END: 0.99,
        }
        self.run_scene("jack", sealed, entries=entries)
        most = outcome.results_of(Results(sealed))["largest_pull"]
        self.assertEqual(most["mechanism"], "drained: friction on both walls")
        entries |= {"Water/Level": "drained", "Water/Suction control": "automatic"}
        self.run_scene("jack", drained, entries=entries)
        rows = history(sealed)
        self.assert_balanced(rows)
        most = max(map(pull, rows))
        self.assertAlmostEqual(most / largest_tension(drained), 1, delta=0.05)
        self.assertLess(rows[-1]["suction_force_N"], 0.05 * most)

    def test_undrained_limit(self) -> None:
        """In clay, the plug rises with the caisson, and what bears both at the tip is
        the strength of a pile that is pushed as far, to the same depth: less the
        stress of rest, the same with the other sign."""
        path, pile = self.directory("caisson"), self.directory("pile")
        faster: Entries = {"Time/Mass scaling": 400}
        entries: Entries = {
            **SEALED,
            **CLAY,
            "Soil/Layer 1/Permeability": 1e-9,
            "Rigid body/Initial penetration": 1.5,
            "Rigid body/Wall thickness": 0.1,
            "Rigid body/Friction angle of the inner wall": 0,
            "Rigid body/Adhesion of the inner wall": STRENGTH,
            "Rigid body/Velocity": -0.02,
            **faster,
        }
        self.run_scene("jack", path, entries=entries)
        most = outcome.results_of(Results(path))["largest_pull"]
        self.assertIn("reverse bearing", most["mechanism"])
        self.run_program(
            SUCCESS,
            self.pile_scene(),
            "--output-directory",
            pile,
            entries={**CLAY, **faster, "Rigid body/Velocity": 0.02},
        )
        rows = history(path)
        self.assert_balanced(rows)
        last = rows[-1]
        self.assertAlmostEqual(last["plug_rise_m3"] / last["lid_growth_m3"], 1, 2)

        at_tip = [pull(row) + row["outer_friction_N"] for row in rows]
        unit_weight = 8829.0 * math.pi * RADIUS**2
        of_pile = [
            row["tip_force_N"]
            + row["tip_water_force_N"]
            - unit_weight * row["penetration_m"]
            for row in history(pile)
        ]
        n = len(rows) // 5  # the last fifth of the way
        factor = math.pi * RADIUS**2 * STRENGTH
        found, expected = (float(np.mean(x[-n:])) for x in (at_tip, of_pile))
        self.assertGreater(found / factor, 6)
        self.assertAlmostEqual(found / expected, 1, delta=0.05)

    def pile_scene(self) -> Path:
        """Write the scene of a pile that is 1.2 m deep in the clay."""
        path = self.made_directory() / "pile.prm"
        path.write_text(
            "subsection Rigid body\n"
            "set Kind = pile\n"
            "set Cells across the wall = 10\n"
            "set Initial penetration = 1.2\n"
            "set Friction angle of the tip = 0\n"
            f"set Adhesion of the tip = {STRENGTH}\n"
            "set Ramp time = 0.5\n"
            "end\n"
            "subsection Soil\nsubsection Layer 1\n"
            "set Poisson ratio = 0.3\nset Porosity = 0.4\nset Solid density = 2500\n"
            "end\nend\n"
            "subsection Grid\nset Growth ratio = 1.3\n"
            "set Moving zone below tip = 1\nend\n"
            "subsection Time\nset Mass scaling = 25\nend\n"
            "subsection Water\nset Level = undrained\nset Bulk modulus = 2e8\nend\n"
            "subsection Output\nset Terminal = plain\n"
            "set Frame interval = never\nend\n",
            encoding="utf-8",
        )
        return path

    def test_cycles(self) -> None:
        """Twenty cycles of tension and compression leave the books in order, and the
        lid is held: after them it has moved by less than in each."""
        path = self.directory()
        table = ["0:0", "0.5:0"]
        for cycle in range(20):
            start = 0.5 + 0.25 * cycle
            table += [f"{start + 0.0625}:-3e5", f"{start + 0.1875}:1e5"]
        entries: Entries = {
            **SEALED,
            "Rigid body/Motion": "dropped",
            "Rigid body/Submerged weight": 2e5,
            "Rigid body/Release time": 0.3,
            "Rigid body/Force table": ", ".join([*table, "5.5:0"]),
            END: 1.2,
            "Time/End time": 6,
            "Output/Record interval": 0.0125,
        }
        self.run_scene("jack", path, entries=entries)
        rows = history(path)
        self.assert_balanced(rows)
        suction = [row["suction_Pa"] for row in rows if 0.5 < row["time_s"] < 5.5]
        self.assertGreater(max(suction) - min(suction), 4e5 / 24.6 / 2)
        for row in rows:
            self.assertLess(abs(row["energy_residual"]), 0.01)
        most = outcome.results_of(Results(path))["largest_pull"]
        self.assertFalse(most["is_capacity"])
        self.assertGreater(most["pull_N"], 0.8e5)  # 3e5 less the weight

    def test_push_and_pull_that_is_held(self) -> None:
        """Only the way up counts, and a pull that is held is no capacity."""
        path = self.directory()
        times = "0:0, 0.2:0.02, 0.4:0.02, 0.8:-0.01, 1.8:-0.01, 2:0, 3:0"
        entries: Entries = {
            **SEALED,
            "Rigid body/Velocity table": times,
            "Method/Local damping": 0.4,
            "Output/Record interval": 0.02,
            END: 1.1,
            "Time/End time": 3,
        }
        self.run_scene("jack", path, entries=entries)
        rows = history(path)
        results = outcome.results_of(Results(path))
        most = results["largest_pull"]
        up = [row["penetration_m"] for row in results["at_depths_up"]]
        self.assertAlmostEqual(up[-1], min(row["penetration_m"] for row in rows[20:]))
        self.assertFalse(most["is_capacity"])
        self.assertNotIn("mechanism", most)
        depths = [row["penetration_m"] for row in rows]
        deepest = depths.index(max(depths))
        rise = depths[deepest] - most["penetration_m"]
        self.assertAlmostEqual(most["rise_m"], rise, 9)
        name = "total_force_with_water_N"
        pulls = [-row[name] for row in rows[deepest + 1 :] if row["time_s"] < 2]
        self.assertGreater(most["pull_N"], 0.8 * max(pulls))
        self.assertLess(most["pull_N"], 1.01 * max(pulls))

    def test_cavity(self) -> None:
        """In shallow water, the water boils, and the pull ends in a cavity. A push in
        another run closes it before the suction falls, and a pull opens it again."""
        first, cycle = self.directory("first"), self.directory("cycle")
        entries: Entries = {
            **SEALED,
            "Water/Water depth": 0,
            "Water/Lid leak": 1e-7,
            "Soil/Layer 1/Cohesion": 1e5,
            "Soil/Layer 1/Permeability": 1e-6,
            "Method/Local damping": 0.4,
        }
        pulled: Entries = {**entries, "Rigid body/Velocity": -0.05, END: 0.97}
        text = self.run_scene("jack", first, entries=pulled)
        self.assert_words(["boils beneath the sealed lid"], text)
        last = history(first)[-1]
        self.assertGreater(last["lid_cavity_m3"], 0)
        entries |= {
            "Installation/Directory": first,
            "Rigid body/Velocity table": "0:-0.05, 0.05:0.05, 0.55:0.05, 0.65:-0.05",
            END: "never",
            "Time/End time": 1.25,
            "Output/Record interval": 0.01,
        }
        self.run_scene("jack", cycle, entries=entries)
        rows = history(cycle)
        self.assertAlmostEqual(rows[0]["lid_cavity_m3"] / last["lid_cavity_m3"], 1, 6)
        for row in history(first)[1:] + rows:
            cap = row["suction_Pa"] / row["cavitation_suction_Pa"]
            self.assertLess(cap, 1 + 1e-9)
            if row["lid_cavity_m3"] > 0:
                self.assertAlmostEqual(cap, 1, 9)
            self.assertLess(abs(row["lid_water_balance"]), 1e-8)
        is_open = [row["lid_cavity_m3"] > 0 for row in rows]
        changes = sum(a != b for a, b in zip(is_open, is_open[1:]))
        self.assertTrue(is_open[0] and is_open[-1])
        self.assertGreaterEqual(changes, 2)  # more where the plug bounces
        leaked = sum(
            0.01 * 1e-7 * (a["suction_Pa"] + b["suction_Pa"]) / 2
            for a, b in zip(rows, rows[1:])
        )
        self.assertAlmostEqual(rows[-1]["lid_leak_m3"] / leaked, 1, delta=0.03)

    def test_gas(self) -> None:
        """Gas expands at constant temperature by what lid, plug and seepage leave."""
        path, gas, ambient = self.directory(), 1.0, 101.3e3 + 9810 * 5
        entries: Entries = {
            **SEALED,
            "Water/Trapped gas": gas,
            "Water/Water depth": 5,
            "Soil/Layer 1/Permeability": 1e-9,
            END: 0.98,
        }
        self.run_scene("jack", path, entries=entries)
        rows = history(path)
        self.assertGreater(rows[-1]["suction_Pa"], 0.15 * ambient)
        of_water = AREA * 2 / 2.2e9  # m3/Pa, of 2 m beneath the lid
        for row in rows[1:]:
            left = row["lid_growth_m3"] - row["plug_rise_m3"] - row["seepage_volume_m3"]
            s = row["suction_Pa"]
            expected = gas * s / (ambient - s) + of_water * s
            self.assertAlmostEqual(left / expected, 1, 5)

    def test_gap_at_the_tip(self) -> None:
        """Water opens a gap below the rising tip. Nodes at its sides have the mass of
        a few points, but no pressure throws these about, at any step."""
        plateau = []
        for courant in (0.6, 0.3):
            path = self.directory(f"{courant}")
            entries: Entries = {
                **SEALED,
                "Soil/Layer 1/Permeability": 3e-3,
                "Material points/Split and merge": "true",
                "Method/Local damping": 0.4,
                "Time/Courant number": courant,
                END: 0.92,
            }
            self.run_scene("jack", path, entries=entries)
            rows = history(path)
            self.assertLess(max(row["max_speed_m_s"] for row in rows), 0.2)
            late = [pull(row) for row in rows if row["penetration_m"] < 0.94]
            self.assertLess(max(late), max(map(pull, rows)))
            plateau.append(float(np.mean(late)))
        self.assertAlmostEqual(plateau[1] / plateau[0], 1, delta=0.02)

    def test_steady_seepage(self) -> None:
        """All that the rising lid makes room for flows through the plug, and the
        suction for it is that of Darcy's law."""
        suction = []
        for permeability in (10, 1):
            path = self.directory(f"{permeability}")
            entries: Entries = {
                **SEALED,
                "Water/Level": "seepage",
                "Soil/Layer 1/Permeability": permeability,
                "Method/Local damping": 0.4,
                END: 0.97,
            }
            self.run_scene("jack", path, entries=entries)
            rows = [row for row in history(path) if row["penetration_m"] < 0.985]
            flow = [row["seepage_flow_m3_s"] / (AREA * 0.01) for row in rows]
            self.assertAlmostEqual(float(np.mean(flow)), 1, delta=0.02)
            for row in rows:
                self.assertLess(abs(row["lid_water_balance"]), 1e-8)
            suction.append(float(np.mean([row["suction_Pa"] for row in rows])))
        self.assertAlmostEqual(suction[1] / suction[0], 10, delta=0.3)

    def test_soft_water_beneath_the_lid(self) -> None:
        """Water with gas in it gives way, and the suction lags behind."""
        suction = []
        for modulus in (2.2e9, 1e5):
            path = self.directory(f"{modulus:.0f}")
            entries: Entries = {**SEALED, "Water/Lid water modulus": modulus, END: 0.99}
            self.run_scene("jack", path, entries=entries)
            suction.append(history(path)[-1]["suction_Pa"])
        self.assertGreater(suction[1], 0)
        self.assertLess(suction[1], 0.8 * suction[0])

    def test_restart_and_ranks(self) -> None:
        """A run that is resumed on two ranks has the history of one that was not
        stopped: at the step at which both build their caches again, to the last
        digit."""
        whole, part = self.directory("whole"), self.directory("part")
        entries: Entries = {**SEALED, "Water/Lid leak": 1e-6, END: 0.991}
        stop = 400 * 0.002  # s, of the steps between two such ones
        self.run_scene("jack", whole, entries=entries)
        self.run_scene("jack", part, entries={**entries, "Time/End time": stop})
        self.run_scene("jack", part, SUCCESS, "--restart", entries=entries, ranks=2)
        expected, rows = history(whole), history(part)
        self.assertEqual(len(rows), len(expected))
        self.assertIn(400, [row["step"] for row in expected])
        for x, y in zip(expected, rows):
            self.assertLess(abs(y["lid_water_balance"]), 1e-8)
            for key in ("suction_Pa", "plug_rise_m3", "lid_leak_m3", "total_force_N"):
                delta = 1e-9 * abs(x[key])
                self.assertAlmostEqual(x[key], y[key], delta=delta, msg=key)


if __name__ == "__main__":
    unittest.main()
