#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs on several ranks."""
import shutil
import unittest
from typing import Any

from program import (
    BAD_INPUT,
    FAILURE,
    STOPPED,
    SUCCESS,
    Entries,
    ProgramTest,
    Rows,
    checks,
    flip_a_bit,
    history,
    scene,
    scene_and_entries,
    summary,
)

SAME = """material_points body_points cells steps held_back_count limiter_count
    points_split points_merged""".split()
HALVED: Entries = {
    "Rigid body/Cells across the wall": 4,
    "Grid/Refinement levels": 2,
    "Grid/Refinement levels along wall": 1,
    "Material points/Split and merge": "true",
}
DIFFERENCES_OF_WORKS = ("gravity_work_J", "energy_residual_J")


class Ranks(ProgramTest):
    """The results are those of one rank."""

    def assert_same_on_ranks(self, one: Rows, several: Rows) -> None:
        """Ask that histories differ by rounding only: 1e-9 of the largest value
        of a column, or of the work for what is a difference of works."""
        self.assertEqual(len(one), len(several), "rows")
        work = max(row["external_work_J"] for row in one)
        for key in one[0]:
            scale = max(abs(row[key]) for row in one)
            if key in DIFFERENCES_OF_WORKS:
                scale = max(scale, work)
            elif key == "energy_residual":
                scale = 1.0
            error = max(abs(a[key] - b[key]) for a, b in zip(one, several))
            self.assertLessEqual(error, 1e-9 * scale, key)

    def compare_ranks(
        self,
        n: int,
        least_repartitions: int,
        entries: Entries,
    ) -> dict[str, Any]:
        """Run the same scene on one rank and on n; return the summary of one rank."""
        whole = self.directory("ranks_1")
        self.run_scene("jack", whole, entries=entries)
        one = summary(whole)
        self.assertGreaterEqual(one["steps"], 1000)
        path = self.directory(f"ranks_{n}")
        text = self.run_scene("jack", path, entries=entries, ranks=n)
        self.assertEqual(text.count("100 %"), 1, "all ranks print")
        self.assert_same_on_ranks(history(whole), history(path))
        several = summary(path)
        for key in SAME:
            self.assertEqual(one[key], several[key], key)
        self.assertEqual(several["ranks"], n)
        self.assertGreaterEqual(several["repartitions"], least_repartitions)
        return one

    def test_agree(self) -> None:
        """The caisson travels over several rows, so that points change their
        ranks, and the mesh is partitioned again."""
        self.compare_ranks(2, 2, {"Time/End penetration": 1})

    def test_hanging_nodes_and_changing_points(self) -> None:
        """Three ranks, which on two cores wait for each other in each step."""
        one = self.compare_ranks(3, 1, {**HALVED, "Time/End penetration": 0.68})
        self.assertGreater(one["points_split"], 100)
        self.assertGreater(one["points_merged"], 100)


class Restart(ProgramTest):
    """Checkpoints are for any number of ranks."""

    def test_restart(self) -> None:
        """A checkpoint of two ranks is continued on three, with hanging nodes, and
        points that split and merge."""
        whole, stopped = self.directory("whole"), self.directory("stopped")
        entries = {**HALVED, "Output/Record interval": 0.05}
        entries["Time/End penetration"] = 0.63
        self.run_scene("jack", whole, entries=entries)
        limited = {**entries, "Run control/Wall time limit": 0.1}
        self.run_scene("jack", stopped, STOPPED, entries=limited, ranks=2)
        path = self.directory("restart")
        shutil.copytree(stopped, path)
        self.run_scene("jack", path, SUCCESS, "--restart", entries=entries, ranks=3)
        self.assert_same_history(history(whole), history(path), 1e-6)
        self.assertEqual(
            summary(path)["material_points"], summary(whole)["material_points"]
        )
        flip_a_bit(stopped)
        text = self.run_scene(
            "jack", stopped, BAD_INPUT, "--restart", entries=entries, ranks=2
        )
        self.assertEqual(text.count("is damaged"), 1, text)


class OtherScenes(ProgramTest):
    """Scenes without a body."""

    def test_verification(self) -> None:
        """Checks have the same numbers; one that fails is a failure."""
        paths = [self.directory(f"verify_{n}") for n in (1, 2)]
        name, wrong = "Verification/Checks", "final half : -4 : 0.03"
        given = scene_and_entries("wave_series")[1][name]
        self.run_scene("wave_series", paths[0])
        more: Entries = {name: f"{given}; {wrong}"}
        self.run_scene("wave_series", paths[1], FAILURE, entries=more, ranks=2)
        one, two = map(checks, paths)
        self.assertEqual([check["pass"] for check in two], [*[True] * len(one), False])
        self.assertGreater(len(one), 5)
        for a, b in zip(one, two):
            for key in a:
                if isinstance(a[key], float):
                    self.assertAlmostEqual(a[key], b[key], delta=1e-9, msg=key)
                else:
                    self.assertEqual(a[key], b[key], key)
        for x, y in zip(*[history(path, "observations") for path in paths]):
            for key in x:
                self.assertAlmostEqual(x[key], y[key], delta=1e-9, msg=key)

    def test_more_ranks_than_cells(self) -> None:
        text = self.run_scene(
            "two_fields",
            self.directory(),
            ranks=3,
            entries={
                "Grid/Cell width": 1,
                "Grid/Cell height": 1,
                "Verification/Checks": "",
            },
        )
        self.assertIn("100.0 %", text)


class Messages(ProgramTest):
    """One rank speaks for all."""

    def test_failure_ends_all(self) -> None:
        """One rank loses a point, and does not leave the others waiting."""
        text = self.run_scene(
            "block_slides",
            self.directory(),
            FAILURE,
            ranks=2,
            entries={
                "Time/End time": 2,
                "Grid/Outer radius": 1.4,
                "Rigid body/Box right": 1.4,
                "Output/Record interval": 0.1,
                "Boundary conditions/Side": "free",
            },
        )
        self.assertEqual(text.count("failure: material point"), 1, text)

    def test_bad_input_is_told_once(self) -> None:
        text = self.run_program(
            BAD_INPUT,
            scene("jack"),
            ranks=2,
            entries={"Soil/Layer 1/Frction angle": 31},
        )
        self.assertEqual(text.count("bad input"), 1, text)
        self.assertIn("Friction angle", text)
        text = self.run_scene(
            "jack", self.directory(), BAD_INPUT, ranks=2, entries={"Time/Time step": 1}
        )
        self.assertEqual(text.count("bad input"), 1, text)
        self.assertIn("stability limit", text)


if __name__ == "__main__":
    unittest.main()
