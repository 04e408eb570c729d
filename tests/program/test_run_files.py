#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The files that a run writes, but for frames and checkpoints."""
import re
import unittest
import xml.etree.ElementTree as ElementTree

from program import SUCCESS, ProgramTest, history, scene, summary


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

    def test_forces_at_the_end(self) -> None:
        """The last lines have the forces of history.csv, with their error."""
        path = self.made_directory()
        done = self.run_scene("jack", path, entries={"Output/Terminal": "full"})
        key = summary(path)["fingerprint"]
        (path / "error.csv").write_text(
            f"# fingerprint: {key}\n"
            "penetration_m,tip_below,tip_above,total_below,total_above\n"
            "0.5,0.2,0.2,0.1,0.01\n0.65,0.2,0.2,0.04,0.04\n"
        )
        rows = history(path)
        done = self.run_scene(
            "jack",
            path,
            SUCCESS,
            "--overwrite",
            entries={"Output/Terminal": "full", "Output/Error bar": path / "error.csv"},
        )
        found = re.findall(r"^at ([\d.]+) m .*total ([-\d.]+) kN(.*)$", done, re.M)
        self.assertEqual([depth for depth, *_ in found], ["0.6", "0.7", "0.75"])
        # a row is the mean since the row before
        ends = [row["penetration_m"] for row in rows]
        depths = [(a + b) / 2 for a, b in zip(ends, ends[1:])]
        forces = [row["total_force_N"] / 1e3 for row in rows[1:]]
        self.assertAlmostEqual(float(found[-1][1]) / forces[-1], 1.0, delta=1e-3)
        for depth, force, error in found[:-1]:
            (expected,) = [
                a + (float(depth) - x) / (y - x) * (b - a)
                for x, y, a, b in zip(depths, depths[1:], forces, forces[1:])
                if x < float(depth) <= y
            ]
            self.assertAlmostEqual(float(force) / expected, 1.0, delta=1e-3)
            self.assertEqual(error, " -6 % +3 %" if depth == "0.6" else "")
        largest = max(forces, key=abs)
        words = re.search(r"^largest force +([-\d.]+) kN", done, re.M)
        assert words, done
        self.assertAlmostEqual(float(words[1]) / largest, 1.0, delta=1e-3)

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


if __name__ == "__main__":
    unittest.main()
