#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that go on after the end of another one with another motion."""
import shutil
import unittest
from pathlib import Path

from program import (
    BAD_INPUT,
    SUCCESS,
    Entries,
    ProgramTest,
    flip_a_bit,
    history,
    scene,
    summary,
)

DEPTH = "Time/End penetration"
END = "Time/End time"
TABLE = "Rigid body/Velocity table"
INSTALLATION = "Installation/Directory"
FILES = ("history.csv", "run.json", "points.pvd", "checkpoint.info")

FORCES = ("tip_force_N", "inner_friction_N", "outer_friction_N", "total_force_N")
SHORT: Entries = {"Output/Record interval": 0.05, DEPTH: 0.6}


class Installation(ProgramTest):
    """Installation/Directory."""

    installed: Path | None = None

    def installation(self) -> Path:
        """Return the directory of simulation/jack.prm to 0.6 m, which is run once."""
        cls = type(self)
        if cls.installed is None:
            cls.installed = self.directory("before")
            self.run_scene("jack", cls.installed, entries=SHORT)
        return cls.installed

    def go_on(
        self, before: Path, name: str, entries: Entries, ranks: int = 1
    ) -> tuple[Path, str]:
        """Run simulation/jack.prm after the run in a directory; where, and its text."""
        path = self.directory(name)
        more = {INSTALLATION: before, **entries}
        return path, self.run_scene("jack", path, entries=more, ranks=ranks)

    def assert_same_end(self, whole: Path, part: Path, tolerance: float) -> None:
        """Ask for the forces and depths of the last rows of the whole run, whose
        times are later, in all rows of the part but its first."""
        rows = history(part)[1:]
        self.assertGreater(len(rows), 3)
        for x, y in zip(history(whole)[-len(rows) :], rows):
            for key in ("penetration_m", "max_speed_m_s", *FORCES):
                self.assertAlmostEqual(
                    x[key], y[key], delta=tolerance * max(1.0, abs(x[key])), msg=key
                )

    def test_same_motion(self) -> None:
        """A body that is pushed on does not notice that another run begins, and
        the installation is left as it was."""
        before, whole = self.installation(), self.directory("whole")
        shutil.copytree(before, whole)
        longer = {**SHORT, DEPTH: 0.7}
        self.run_scene("jack", whole, SUCCESS, "--restart", entries=longer)
        files = [(before / name).read_bytes() for name in FILES]
        path, text = self.go_on(before, "after", longer, ranks=2)
        self.assertEqual([(before / name).read_bytes() for name in FILES], files)
        self.assertIn("with the entries of the installation", text)
        self.assert_same_end(whole, path, 1e-6)

        first, last = history(path)[0], history(before)[-1]
        for key in FORCES:
            self.assertAlmostEqual(first[key] / last[key], 1, 6)
        for key in ("time_s", "step", "external_work_J"):
            self.assertEqual(first[key], 0, key)
        work = history(whole)[-1]["external_work_J"] - last["external_work_J"]
        self.assertAlmostEqual(history(path)[-1]["external_work_J"] / work, 1, 6)
        self.assertEqual(summary(path)["installation"], str(before))
        self.assertAlmostEqual(summary(path)["start_penetration_m"], 0.6, 9)

    def test_pulled_out(self) -> None:
        """As by a velocity table that pushes and pulls in one run."""
        push = "0:0, 0.5:0.1, 1.25:0.1, 1.5:0"
        whole, before = self.directory("whole"), self.directory("before")
        entries = {**SHORT, DEPTH: "never"}
        both = {TABLE: push + ", 1.75:-0.1", END: 2}
        self.run_scene("jack", whole, entries={**entries, **both})
        self.run_scene("jack", before, entries={**entries, TABLE: push, END: 1.5})
        pull = {**entries, TABLE: "0:0, 0.25:-0.1", END: 0.5}
        path, text = self.go_on(before, "after", pull, ranks=2)
        self.assert_words([TABLE, "there " + push], text)
        self.assert_same_end(whole, path, 1e-6)
        self.assertLess(history(path)[-1]["total_force_N"], 0)

    def test_dropped_body_falls_on(self) -> None:
        """The momentum of a body goes on, and a stopped run that goes on after
        another one restarts."""
        whole, before = self.directory("whole"), self.directory("before")
        entries = {**SHORT, "Rigid body/Motion": "dropped", DEPTH: 0.75}
        self.run_scene("jack", whole, entries={**entries, END: 0.6})
        self.run_scene("jack", before, entries={**entries, END: 0.2})
        path, _ = self.go_on(before, "after", {**entries, END: 0.2}, ranks=2)
        more = {**entries, INSTALLATION: before, END: 0.4}
        shutil.rmtree(before)  # not needed any more
        self.run_scene("jack", path, SUCCESS, "--restart", entries=more)
        self.assert_same_end(whole, path, 1e-6)

    def test_jacked_body_is_let_go(self) -> None:
        """Under a smaller load than that of the jack, the soil holds it."""
        before = self.installation()
        load = history(before)[-1]["total_force_N"]
        for motion in ("lowered", "dropped"):
            with self.subTest(motion):
                entries = {
                    **SHORT,
                    "Rigid body/Motion": motion,
                    "Rigid body/Submerged weight": load / 2,
                    "Rigid body/Release time": 0.2,
                    DEPTH: 0.7,
                    END: 1,
                }
                path, _ = self.go_on(before, motion, entries)
                last = history(path)[-1]
                self.assertAlmostEqual(last["penetration_m"], 0.6, delta=0.01)
                self.assertAlmostEqual(
                    last["total_force_N"] / (load / 2), 1, delta=0.05
                )

    def test_water_after_a_drained_installation(self) -> None:
        """Soil that can hardly drain holds the body that is pulled."""
        before = self.installation()
        pull: Entries = {
            **SHORT,
            "Rigid body/Velocity": -0.1,
            "Rigid body/Ramp time": 0.1,
            "Output/Record interval": 0.01,
            "Soil/Layer 1/Permeability": 1e-7,
            DEPTH: "never",
            END: 0.15,
        }
        total = []
        for level in ("drained", "coupled"):
            entries = {**pull, "Water/Level": level}
            path, text = self.go_on(before, level, entries)
            self.assert_words(["Layer 1/Permeability = 1e-07, there 0.0001"], text)
            total.append(history(path)[-1])
        self.assertLess(total[1]["pore_pressure_smallest_Pa"], -1e3)
        self.assertLess(
            total[1]["total_force_N"] + total[1]["tip_water_force_N"],
            total[0]["total_force_N"] - 1e5,
        )
        self.assertLess(abs(total[1]["pumped_volume_m3"]), 0.3)

    def test_suction_goes_on(self) -> None:
        before, whole = self.directory("before"), self.directory("whole")
        self.run_scene("suction", before, entries=SHORT)
        shutil.copytree(before, whole)
        longer: Entries = {**SHORT, DEPTH: 0.62}
        self.run_scene("suction", whole, SUCCESS, "--restart", entries=longer)
        path = self.directory("after")
        self.run_scene("suction", path, entries={**longer, INSTALLATION: before})
        self.assert_same_end(whole, path, 1e-6)
        last, end, start = history(path)[-1], history(whole)[-1], history(before)[-1]
        for key in ("suction_Pa", "plug_heave_m", "plug_inflow_m3"):
            self.assertAlmostEqual(last[key] / end[key], 1, 5, key)
        for key in ("seepage_volume_m3", "pumped_volume_m3"):
            self.assertAlmostEqual(last[key] / (end[key] - start[key]), 1, 5, key)
        # a run without a lid knows no plug, which the next one with a lid goes on with
        drained, again = self.directory("drained"), self.directory("again")
        longer |= {DEPTH: 0.605, "Water/Level": "drained", INSTALLATION: before}
        self.run_scene("suction", drained, entries=longer)
        longer |= {DEPTH: 0.61, "Water/Level": "seepage", INSTALLATION: drained}
        self.run_scene("suction", again, entries=longer)
        ends = [rows[-1]["plug_heave_m"] for rows in map(history, (before, whole))]
        heave = history(again)[-1]["plug_heave_m"]
        self.assertTrue(ends[0] < heave < ends[1], (ends, heave))

    def go_on_both_ways(
        self, entries: Entries, tolerance: float = 1e-6
    ) -> tuple[Path, Path, Path]:
        """Run the suction scene to 0.55 m, and from there to 0.57 m by a restart and
        as another run on two ranks; return the directories of the three."""
        before, whole = self.directory("before"), self.directory("whole")
        first: Entries = {**SHORT, **entries, DEPTH: 0.55}
        self.run_scene("suction", before, entries=first)
        shutil.copytree(before, whole)
        longer: Entries = {**first, DEPTH: 0.57}
        self.run_scene("suction", whole, SUCCESS, "--restart", entries=longer)
        path = self.directory("after")
        longer[INSTALLATION] = before
        self.run_scene("suction", path, entries=longer, ranks=2)
        self.assert_same_end(whole, path, tolerance)
        return before, whole, path

    def test_coupled_pressure_goes_on(self) -> None:
        """The solver leaves a tenth of a residual to the next step, and what it leaves
        depends on the ranks."""
        before, whole, path = self.go_on_both_ways(
            {"Water/Level": "coupled", "Soil/Layer 1/Permeability": 1e-5}, 1e-5
        )
        last, end = history(path)[-1], history(whole)[-1]
        # the soil of the water is looked at in other steps
        for key in ("tip_water_force_N", "pore_pressure_smallest_Pa"):
            self.assertAlmostEqual(last[key] / end[key], 1, delta=1e-4)
        first, end = history(path)[0], history(before)[-1]
        for key in ("tip_water_force_N", "total_force_with_water_N"):
            self.assertAlmostEqual(first[key] / end[key], 1, 6, key)

    def test_steady_flow_goes_on_coupled(self) -> None:
        """Coupled water begins with the pressures of the steady flow, on any number of
        ranks."""
        still: Entries = {
            "Rigid body/Velocity": 0,
            "Rigid body/Ramp time": 0,
            "Soil/Layer 1/Permeability": 1e-2,
            "Water/Suction control": "table",
            DEPTH: "never",
        }
        before = self.directory("before")
        rising: Entries = {**still, "Water/Suction table": "0:0, 0.4:2000", END: 0.5}
        self.run_scene("suction", before, entries=rising)
        entries: Entries = {
            **still,
            "Water/Level": "coupled",
            "Water/Suction table": "0:2000, 1:2000",
            INSTALLATION: before,
            END: 0.05,
        }
        steady = history(before)[-1]
        for ranks in (1, 2):
            path = self.directory(f"after_{ranks}")
            self.run_scene("suction", path, entries=entries, ranks=ranks)
            first = history(path)[0]
            ratio = first["tip_water_force_N"] / steady["tip_water_force_N"]
            self.assertAlmostEqual(ratio, 1, delta=0.03)

    def test_undrained_pressure_goes_on(self) -> None:
        """The volumes of the points bring it along."""
        before, whole, path = self.go_on_both_ways({"Water/Level": "undrained"})
        water = ("tip_water_force_N", "total_force_with_water_N")
        # the first row has the pressure one step later than the row before it
        for x, y, delta in ((whole, -1, 1e-6), (before, 0, 0.03)):
            expected, row = history(x)[-1], history(path)[y]
            for key in (*water, "pore_pressure_largest_Pa"):
                self.assertGreater(expected[key], 1e3)
                self.assertAlmostEqual(row[key] / expected[key], 1, delta=delta)

    def test_refused(self) -> None:
        """What decides the state may not differ, and files are kept."""
        before = self.directory("before")
        self.run_scene("jack", before, entries={DEPTH: 0.52})
        rows = history(before)
        cases: list[tuple[list[str], Entries]] = [
            (
                ["Soil/Layer 1/Friction angle = 31, there 30", "again"],
                {"Soil/Layer 1/Friction angle": 31},
            ),
            (["Wall thickness = 0.1, there 0.2"], {"Rigid body/Wall thickness": 0.1}),
            (["no checkpoint", "the installation first"], {INSTALLATION: "nowhere"}),
            (["where the body is"], {DEPTH: 0.52}),
            (["Water/Level was drained", "coupled"], {"Water/Level": "undrained"}),
        ]
        for words, entries in cases:
            self.refused(words, entries={INSTALLATION: before, DEPTH: 0.6, **entries})
        text = self.run_scene(
            "jack", before, BAD_INPUT, entries={INSTALLATION: before, DEPTH: 0.6}
        )
        self.assertIn("is the output directory of this run, too", text)
        self.assertEqual(history(before), rows)
        flip_a_bit(before)
        words = ["is damaged", "the run that wrote it again"]
        self.refused(words, entries={INSTALLATION: before, DEPTH: 0.6})

    def test_body_that_rested(self) -> None:
        """Its mesh has no zone that can move."""
        before = self.directory("before")
        rest = {"Rigid body/Velocity": 0, DEPTH: "never", END: 0.05}
        self.run_scene("jack", before, entries=rest)
        self.refused(["rested", "Moving zone"], entries={INSTALLATION: before})

    def test_validate(self) -> None:
        """Friction may differ."""
        wall = {"Rigid body/Friction angle of the inner wall": 17}
        entries = {INSTALLATION: self.installation(), DEPTH: 0.7, **wall}
        text = self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)
        self.assertIn("is valid", text)


if __name__ == "__main__":
    unittest.main()
