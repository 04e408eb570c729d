#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A caisson with a sealed lid, pulled and held after its installation."""
import math
import unittest
from pathlib import Path

import numpy as np
from program import SUCCESS, Entries, ProgramTest, Rows, history

AREA = math.pi * 2.8**2  # m2, of the lid of simulation/jack.prm
DEPTH = 1.0  # m, where the installation ends
FLOWS = 10.0  # m/s, of soil that drains
TIGHT = 1e-5  # m/s, of soil that does not
PERMEABILITY = "Soil/Layer 1/Permeability"
TABLE = "Rigid body/Velocity table"
COMPRESSION = "Water/Time compression"
END = "Time/End time"
SLOW = "0:0, 0.2:-0.01"  # s : m/s
FAST = "0:0, 0.2:0, 0.4:-0.02"
WATER: Entries = {
    "Water/Level": "coupled",
    PERMEABILITY: TIGHT,
    "Soil/Layer 1/Permeability ratio": 1,
}
SEALED: Entries = {
    **WATER,
    "Water/Suction control": "sealed",
    "Rigid body/Ramp time": 0,
    "Method/Local damping": 0.4,
    "Time/End penetration": "never",
    "Output/Record interval": 0.05,
}


def pulls(rows: Rows) -> list[float]:
    """Return the pull that soil and water bear (N)."""
    return [
        row["suction_force_N"] - row["total_force_N"] - row["tip_water_force_N"]
        for row in rows
    ]


def mean_pull(rows: Rows) -> float:
    """Return the mean pull from 8 to 22 mm of rise: undrained, it swings."""
    start = rows[0]["penetration_m"]
    found = zip(rows, pulls(rows))
    return float(
        np.mean([x for row, x in found if 8 < 1e3 * (start - row["penetration_m"])])
    )


class AfterInstallation(ProgramTest):
    """From the end of an installation by suction in soil that hardly drains."""

    states: dict[str, Path] = {}  # what all tests begin with, by its name

    def setUp(self) -> None:
        if self.states:
            return
        installed = self.directory("installed")
        entries: Entries = {**WATER, "Time/End penetration": DEPTH}
        self.run_scene("suction", installed, entries=entries)
        self.states["installed"] = installed
        self.states["rested"] = self.rest("rested", installed)

    def run_after(
        self, name: str, before: Path | None, entries: Entries, ranks: int = 1
    ) -> Path:
        """Run with a sealed lid after another run, or wished in place."""
        path = self.directory(name)
        start: Entries = {"Rigid body/Initial penetration": DEPTH}
        if before:
            start = {"Installation/Directory": before}
        entries = {**SEALED, **start, **entries}
        self.run_scene("suction", path, entries=entries, ranks=ranks)
        for row in history(path):
            self.assertLess(abs(row["lid_water_balance"]), 1e-8)
            self.assertLess(abs(row.get("water_balance", 0)), 1e-8)
        return path

    def rest(self, name: str, before: Path) -> Path:
        """Hold the body where it is, until water has flowed a thousand times longer."""
        held: Entries = {TABLE: "0:0", COMPRESSION: 1000, END: 3}
        return self.run_after(name, before, held)

    def pull(self, name: str, before: Path | None, entries: Entries) -> Rows:
        """Pull the body, and return the rows."""
        return history(self.run_after(name, before, entries))

    def test_pressure_is_gone_after_a_rest(self) -> None:
        """The water of the installation leaves the plug, which settles by as much."""
        begin = history(self.states["installed"])[-1]
        rows = history(self.states["rested"])
        for key in ("pore_pressure_largest_Pa", "suction_Pa", "tip_water_force_N"):
            self.assertGreater(begin[key], 1e3, key)
            self.assertLess(abs(rows[-1][key]), 0.02 * begin[key], key)
        self.assertAlmostEqual(rows[0]["suction_Pa"] / begin["suction_Pa"], 1, 6)
        for row in rows:
            inflow = row["seepage_volume_m3"] + row["plug_rise_m3"]
            self.assertAlmostEqual(inflow, -row["lid_expansion_m3"], 9)
        self.assertLess(rows[-1]["plug_rise_m3"], -0.01)

    def test_drained_pull(self) -> None:
        """The installation has pressed the soil against the walls."""
        slow: Entries = {PERMEABILITY: FLOWS, TABLE: SLOW, END: 2}
        wished = self.pull("wished", None, slow)
        after = self.pull("after", self.states["rested"], slow)
        for rows in (wished, after):
            self.assertLess(rows[-1]["suction_force_N"], 0.05 * mean_pull(rows))
        self.assertGreater(mean_pull(after), 1.5 * mean_pull(wished))

    def test_undrained_pull(self) -> None:
        """What the soil bears grows with the effective stress: it is least in
        undisturbed soil, more at once after the installation, and most when the
        excess pressure of the installation has become effective stress."""
        found = [
            mean_pull(self.pull(name, before, {TABLE: FAST, END: 1.4}))
            for name, before in (
                ("wished", None),
                ("at_once", self.states["installed"]),
                ("rested", self.states["rested"]),
            )
        ]
        self.assertEqual(found, sorted(found))
        self.assertGreater(found[2], 1.1 * found[1])

    def test_second_pull(self) -> None:
        """A pull takes the stress from the soil beneath the tip. If the body is then
        held in its place, water fills the space beneath it, and the next pull finds
        less; if a load presses it down until the pressure is gone, as much as
        before."""
        fast: Entries = {TABLE: FAST, END: 1.4}
        first = self.run_after("first", self.states["rested"], fast)
        load: Entries = {
            "Rigid body/Motion": "dropped",
            "Rigid body/Submerged weight": 1e5,
            "Rigid body/Release time": 0.3,
            PERMEABILITY: 1e3 * TIGHT,
            "Time/End penetration": 1.2,
            END: 4,
        }
        held = self.rest("held", first)
        loaded = self.run_after("loaded", first, load)
        for path, share in ((held, 0.05), (loaded, 0.02)):
            last = history(path)[-1]["suction_force_N"]
            self.assertLess(abs(last), share * history(first)[-1]["suction_force_N"])
        tips = [history(path)[-1]["tip_force_N"] for path in (held, loaded)]
        self.assertLess(abs(tips[0]), 1e3)
        self.assertGreater(tips[1], 5e4)
        of_first, of_held, of_loaded = (
            mean_pull(rows)
            for rows in (
                history(first),
                self.pull("after_held", held, fast),
                self.pull("after_loaded", loaded, fast),
            )
        )
        self.assertLess(of_held, 0.9 * of_first)
        self.assertGreater(of_loaded, 1.1 * of_held)

    def test_held_by_a_force(self) -> None:
        """Under a tension beyond its friction, the caisson rises as fast as water
        seeps through the plug. By how much for a suction is that of steady flow."""
        tension, weight = 3e5, 1e5  # N
        rows = self.pull(
            "force",
            self.states["rested"],
            {
                "Rigid body/Motion": "dropped",
                "Rigid body/Submerged weight": weight,
                "Rigid body/Release time": 0.3,
                "Rigid body/Force table": f"0:0, 0.5:{-tension}",
                PERMEABILITY: 1e3 * TIGHT,
                "Time/End penetration": 1.2,
                END: 4,
            },
        )
        steady = self.pull(
            "steady",
            self.states["rested"],
            {"Water/Level": "seepage", PERMEABILITY: FLOWS, TABLE: SLOW, END: 1},
        )[-1]
        conductance = steady["seepage_flow_m3_s"] / steady["suction_Pa"]
        conductance *= 1e3 * TIGHT / FLOWS
        late = [row for row in rows if row["time_s"] > 2]
        for x in pulls(late):
            self.assertAlmostEqual(x / (tension - weight), 1, delta=0.03)
        first, last = late[0], late[-1]
        time = last["time_s"] - first["time_s"]
        seeps, grows, rises = (
            (last[key] - first[key]) / time
            for key in ("seepage_volume_m3", "lid_growth_m3", "plug_rise_m3")
        )
        suction = float(np.mean([row["suction_Pa"] for row in late]))
        self.assertAlmostEqual(seeps / (conductance * suction), 1, delta=0.1)
        self.assertAlmostEqual((seeps + rises) / grows, 1, delta=0.01)
        self.assertAlmostEqual(
            AREA * (first["penetration_m"] - last["penetration_m"]) / time / grows, 1, 6
        )

    def test_restart_and_ranks(self) -> None:
        """A pull after an installation, stopped and resumed on two ranks, is that of
        a run that was not stopped."""
        whole, part = self.directory("whole"), self.directory("part")
        entries: Entries = {
            **SEALED,
            "Installation/Directory": self.states["installed"],
            TABLE: FAST,
            END: 0.6,
        }
        self.run_scene("suction", whole, entries=entries)
        self.run_scene("suction", part, entries={**entries, END: 0.45})
        self.run_scene("suction", part, SUCCESS, "--restart", entries=entries, ranks=2)
        expected, rows = history(whole), history(part)
        self.assertEqual(len(rows), len(expected))
        for x, y in zip(expected, rows):
            for key in ("suction_Pa", "lid_growth_m3", "plug_rise_m3"):
                delta = 1e-3 * max(abs(row[key]) for row in expected)
                self.assertAlmostEqual(x[key], y[key], delta=delta, msg=key)
            self.assertLess(abs(y["lid_water_balance"]), 1e-8)


if __name__ == "__main__":
    unittest.main()
