#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Options, printed parameters, files of a run, checks and observations."""
import re
import unittest
import xml.etree.ElementTree as ElementTree

from program import (
    BAD_INPUT,
    FAILURE,
    SUCCESS,
    Entries,
    ProgramTest,
    checks,
    history,
    scene,
    summary,
)


class Options(ProgramTest):
    """The command line."""

    def test_help_and_version(self) -> None:
        text = self.run_program(SUCCESS, "--help")
        options = (
            "set output-directory print-parameters explain validate strict restart"
            " overwrite"
        )
        for option in [*options.split(), "version", "help"]:
            self.assertIn(f"--{option}", text)
        self.assertRegex(self.run_program(SUCCESS, "--version"), r"caisson_mpm \d")
        self.assertIn("No parameter file", self.run_program(BAD_INPUT))
        text = self.run_program(BAD_INPUT, "--outptu-directory", "x")
        self.assertIn("--output-directory", text, "nearest option")

    def test_parameters_can_be_read_again(self) -> None:
        path = self.made_directory() / "all.prm"
        path.write_text(self.run_program(SUCCESS, scene("jack"), "--print-parameters"))
        self.assertIn("is valid", self.run_program(SUCCESS, path, "--validate"))
        again = self.run_program(SUCCESS, path, "--print-parameters")
        self.assertEqual(path.read_text(), again)
        self.assertIn("Units: ", again)

    def test_entries_with_a_word(self) -> None:
        """One layer stands for those that have the defaults."""
        text = self.run_program(
            SUCCESS,
            scene("jack"),
            "--explain",
            "FRICTION ANGLE",
            entries={"Soil/Layer 3/Friction angle": 33},
        )
        self.assertEqual(text.count("  set Friction angle ="), 2)
        self.assertIn("subsection Layer 3", text)
        self.assertNotIn("subsection Layer 2", text)
        self.assertIn("set Friction angle of the tip", text)
        self.assertNotIn("subsection Grid", text)
        section = self.run_program(SUCCESS, "--explain", "Layer 1")
        self.assertIn("set Friction angle", section)
        self.assertIn("No entry has", self.run_program(BAD_INPUT, "--explain", "xyz"))

    def test_validate_tells_the_cost(self) -> None:
        """Without writing a file."""
        path = self.directory()
        text = self.run_scene("jack", path, SUCCESS, "--validate")
        self.assertRegex(text, r"points +\d+\n")
        self.assertRegex(text, r"time step +[\de.-]+ s, limited by the cell at")
        for words in (r"steps +about \d", r"memory +about \d", r"duration +about \d"):
            self.assertRegex(text, words)
        self.assertFalse((path / "history.csv").exists())

    def test_validate_tells_what_would_be_cheaper(self) -> None:
        """Of a long run; and nothing of one that is short anyway."""
        entries = {"Time/End penetration": 0.9}
        short = self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)
        self.assertNotIn("cheaper", short)
        entries.update({"Time/Time step": 1e-8, "Time/Mass scaling": 25})
        long = self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)
        self.assertIn("Time/Mass scaling = 100 takes 0.5 times as many steps", long)
        self.assertIn("Grid/Refinement levels", long)
        entries["Time/Mass scaling"] = 100
        long = self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)
        self.assertNotIn("Mass scaling", long)

    def test_strict(self) -> None:
        """Warnings of likely mistakes become errors, each by its name; known
        limits of the program do not."""
        mistakes: Entries = {
            "Soil/Layer 2/Friction angle": 40,
            "Rigid body/Apex angle": 70,
        }
        path = self.directory()
        self.run_program(SUCCESS, scene("jack"), "--validate", entries=mistakes)
        for option in ("--validate", f"--output-directory={path}"):
            with self.subTest(option):
                said = self.run_program(
                    BAD_INPUT, scene("jack"), "--strict", option, entries=mistakes
                )
                for words in ("2 warnings", "--strict", *mistakes):
                    self.assertIn(words, said)
        self.assertFalse(path.exists(), "nothing was written")
        said = self.run_program(
            SUCCESS, scene("jack_softening"), "--validate", "--strict"
        )
        self.assertIn("warning: Soil/Layer 1: softening needs", said)

    def test_a_run_keeps_its_warnings(self) -> None:
        """--validate, the terminal and run.json have the same ones."""
        entries: Entries = {
            "Soil/Layer 2/Friction angle": 40,
            "Time/End penetration": 0.505,
        }
        path = self.directory()
        first = self.run_scene(
            "jack_softening", path, SUCCESS, "--validate", entries=entries
        )
        said = self.run_scene("jack_softening", path, entries=entries)
        found = re.findall("^warning: (.*)$", first, re.M)
        self.assertEqual(len(found), 2, first)
        for warning in found:
            self.assertIn(f"warning: {warning}", said)
        self.assertEqual(summary(path)["warnings"][:2], found)

    def test_validate_refuses_what_a_run_refuses(self) -> None:
        """Files and directories that cannot be used; nothing is written."""
        path = self.made_directory()
        (path / "file").write_text("")
        cases: tuple[tuple[str, list[str], Entries], ...] = (
            ("a file is in its place", ["--output-directory", f"{path}/file"], {}),
            ("name too long", ["--output-directory", f"{path}/{'x' * 300}"], {}),
            ("cannot be read", [], {"Output/Error bar": "missing.csv"}),
            ("cannot be read", [], {"Output/Error bar": ".."}),
            ("checkpoint", ["--restart", f"--output-directory={path}/new"], {}),
        )
        for words, options, entries in cases:
            with self.subTest(words, options=options[:1]):
                said = self.run_program(
                    BAD_INPUT, scene("jack"), "--validate", *options, entries=entries
                )
                self.assertIn(words, said)
        self.assertEqual([file.name for file in path.iterdir()], ["file"])

    def test_set_overrides(self) -> None:
        text = self.run_program(
            SUCCESS,
            scene("jack"),
            "--print-parameters",
            entries={"Soil/Layer 1/Friction angle": 33},
        )
        self.assertRegex(text, r"set Friction angle\s*= 33")


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
            f"# fingerprint: {key}\npenetration_m,tip_error,total_error\n"
            "0.5,0.2,0.1\n0.65,0.2,0.04\n"
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
        self.assertEqual([depth for depth, *_ in found], ["0.6", "0.7"])
        # a row is the mean since the row before
        ends = [row["penetration_m"] for row in rows]
        depths = [(a + b) / 2 for a, b in zip(ends, ends[1:])]
        forces = [row["total_force_N"] / 1e3 for row in rows[1:]]
        for depth, force, error in found:
            (expected,) = [
                a + (float(depth) - x) / (y - x) * (b - a)
                for x, y, a, b in zip(depths, depths[1:], forces, forces[1:])
                if x < float(depth) <= y
            ]
            self.assertAlmostEqual(float(force) / expected, 1.0, delta=1e-3)
            self.assertEqual(error, " +- 6 %" if depth == "0.6" else "")
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


class Checks(ProgramTest):
    """The sections Verification/Checks and Observations."""

    def test_checks(self) -> None:
        path = self.directory()
        entries = {
            "Output/Terminal": "full",
            "Time/End time": 0.02,
            "Verification/Checks": "max displacement_r : 0 : 1e-9;"
            " mean velocity_z : 1 : 0.1",
        }
        text = self.run_scene("wave_xpic", path, FAILURE, entries=entries)
        self.assertIn("within 1e-09: yes", text)
        self.assertIn("within 0.1: no", text)
        self.assertIn("1 of 2 checks failed", text)
        entries["Output/Terminal"] = "silent"
        text = self.run_scene("wave_xpic", path, FAILURE, entries=entries)
        self.assertEqual(text.strip(), "1 of 2 checks failed")
        found = checks(path)
        self.assertEqual([check["pass"] for check in found], [True, False])
        for key in "quantity computed exact relative_error tolerance".split():
            self.assertIn(key, found[0])

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
            "frequency mode : 1 : 0.01",
            "amplitude mode : 0.5 : 0.1",
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

    def test_check_of_no_point(self) -> None:
        text = self.run_scene(
            "wave_series",
            self.directory(),
            FAILURE,
            entries={"Verification/Checks": "max speed where r > 9 : 0 : 1"},
        )
        self.assertIn("no material point", text)


if __name__ == "__main__":
    unittest.main()
