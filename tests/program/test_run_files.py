#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files that a run writes, but for frames and checkpoints; and its checks."""
import re
import unittest
import xml.etree.ElementTree as ElementTree
from typing import Any

import numpy as np
from program import (
    FAILURE,
    Entries,
    ProgramTest,
    Results,
    Rows,
    checks,
    history,
    scene,
    summary,
)

from caisson import run_error_bar
from caisson.verdict import design
from caisson.table import text_of
from caisson.report import verdict
from caisson.verdict import installation
from caisson.report import page as page_module
from caisson.verdict import outcome


class Files(ProgramTest):
    """What a run writes."""

    def test_output_files(self) -> None:
        path = self.directory()
        self.run_scene(
            "jack",
            path,
            entries={
                "Time/End penetration": 0.53,
                "Output/Record interval": 0.1,
                "Output/Frame penetrations": 0.51,
            },
        )
        head = (path / "history.csv").read_text().splitlines()[0]
        self.assertTrue(
            head.startswith(
                "time_s,penetration_m,tip_force_N,inner_friction_N,"
                "outer_friction_N,total_force_N,"
            ),
            head,
        )
        rows = history(path)
        self.assertEqual(rows[0]["penetration_m"], 0.5)
        self.assertAlmostEqual(rows[-1]["penetration_m"], 0.53, delta=1e-9)
        forces = "tip_force_N inner_friction_N outer_friction_N top_force_N".split()
        for row in rows:
            parts = sum(row[force] for force in forces)
            self.assertAlmostEqual(parts, row["total_force_N"], delta=1e-3)
        about = summary(path)
        (layer,) = about["scene"]["layers"]
        self.assertEqual(layer["law"], "Mohr-Coulomb")
        self.assertEqual(layer["friction_angle_deg"], 30)
        for key in (
            "version dealii_version ranks material_points cells steps wall_time_s"
            " point_steps_per_second peak_memory_bytes limiter_count"
            " sections"
        ).split():
            self.assertIn(key, about)
        self.assertEqual(about["max_points_in_body"], 0)
        self.assertEqual(about["steps"], rows[-1]["step"])
        for name in ("points.pvd", "grid.pvd", "body.pvd"):
            root = ElementTree.parse(path / name).getroot()
            frames = [
                (float(d.attrib["timestep"]), path / d.attrib["file"])
                for d in root.iter("DataSet")
            ]
            times = sorted({time for time, _ in frames})
            self.assertEqual((len(times), times[0]), (3, 0.0), name)
            self.assertAlmostEqual(times[-1], rows[-1]["time_s"], delta=1e-6)
            for _, file in frames:
                self.assertGreater(file.stat().st_size, 1000, file)
                self.assertIn(b"<VTKFile", file.read_bytes()[:500], file)

    def test_one_number_everywhere(self) -> None:
        """Results, report and design.csv have the same forces and the same error bars
        at each depth, the last one too, and the terminal the last force."""
        path = self.made_directory()
        entries: Entries = {"Output/Record interval": 0.05}
        self.run_scene("jack", path, entries=entries)
        key = summary(path)["fingerprint"]
        (path / "error.csv").write_text(
            f"# fingerprint: {key}\n"
            "penetration_m,tip_below,tip_above,total_below,total_above\n"
            "0.5,0.2,0.2,0.1,0.01\n0.73,0.2,0.2,0.04,0.04\n"
        )
        run_error_bar.adopt(path, path / "error.csv")
        run = Results(path)
        rows = outcome.results_of(run)["at_depths"]
        known = {round(row["penetration_m"], 6): row for row in rows}
        self.assertEqual([*known], [0.6, 0.7, 0.75])
        page = page_module.html(run, installation.Rate())
        columns = design.columns_of(run)
        for depth, row in known.items():
            total = row["total_force_N"]
            x = (depth - 0.5) / 0.23
            below, above = 0.1 - 0.06 * x, 0.01 + 0.03 * x
            cell = f"<td>{depth}</td><td>{text_of(total / 1e3)}"
            if depth == 0.75:
                self.assertNotIn("total_force_low_N", row)
                self.assertIn(f"{cell} (about ", page)
                continue
            bounds = [row[f"total_force_{side}_N"] for side in ("low", "high")]
            self.assertAlmostEqual(bounds[0] / total, 1 - below, 6)
            self.assertAlmostEqual(bounds[1] / total, 1 + above, 6)
            words = " to ".join(text_of(bound / 1e3) for bound in bounds)
            self.assertIn(f"{cell} ({words})</td>", page)
            (i,) = np.flatnonzero(np.isclose(columns["penetration_m"], depth))
            self.assertAlmostEqual(columns["total_force_N"][i] / total, 1, 6)
        end = known[0.75]["total_force_N"] / 1e3
        (said,) = verdict.lines_of(run)
        self.assertTrue(
            said.startswith(f"Jacked to 0.75 m: {end:.3g} kN (error bar "), said
        )
        self.check_by_hand(history(path)[1:], known)

    def check_by_hand(self, rows: Rows, known: dict[float, dict[str, Any]]) -> None:
        """A mean over a tenth of the way, and a line at its end."""
        window = (rows[-1]["penetration_m"] - rows[0]["penetration_m"]) / 10
        near = [r for r in rows if abs(r["penetration_m"] - 0.6) <= window / 2 + 1e-9]
        mean = sum(row["tip_force_N"] for row in near) / len(near)
        self.assertAlmostEqual(known[0.6]["tip_force_N"] / mean, 1, 9)
        last = [r for r in rows if r["penetration_m"] >= 0.75 - window - 1e-9]
        line = np.polyfit(
            [row["penetration_m"] - 0.75 for row in last],
            [row["tip_force_N"] for row in last],
            1,
        )
        self.assertAlmostEqual(known[0.75]["tip_force_N"] / line[1], 1, 6)

    def test_scene_in_run_json(self) -> None:
        """What pictures take from there."""
        path = self.directory()
        layer = "Soil/Layer 2"
        entries = {
            "Time/End penetration": 0.505,
            "Output/Frame penetrations": "0.502, 0.6",
            "Soil/Number of layers": 2,
            f"{layer}/Top depth": 1.5,
            f"{layer}/Friction angle": 40,
            f"{layer}/Cohesion": 1000,
            f"{layer}/K0": 0.7,
            "Rigid body/Friction angle of the inner wall": 15,
        }
        self.run_scene("jack", path, entries=entries)
        about = summary(path)
        self.assertEqual(about["scene_file"], scene("jack"))
        self.assertIn("caisson", about["title"])
        seen = about["scene"]
        self.assertEqual(seen["frame_penetrations_m"], [0.502, 0.6])
        self.assertEqual(seen["inner_wall_friction_angle_deg"], 15)
        self.assertEqual(seen["outer_wall_friction_angle_deg"], 20)
        first, second = seen["layers"]
        self.assertEqual((first["top_depth_m"], second["top_depth_m"]), (0, 1.5))
        self.assertEqual(second["friction_angle_deg"], 40)
        self.assertEqual(second["cohesion_Pa"], 1000)
        self.assertEqual((first["K0"], second["K0"]), (0.5, 0.7))
        self.assertEqual(first["law"], "Mohr-Coulomb")


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
