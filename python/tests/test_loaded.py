# SPDX-License-Identifier: LGPL-2.1-or-later
"""caisson.load() and caisson.run(): tables, meshes, and what they refuse."""
import contextlib
import fcntl
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import caisson
from caisson.frame import Frame, choose
from caisson.paths import ROOT, find_program, version

HERE = Path(__file__).resolve().parent
FAKE_PROGRAM = HERE / "fake_program.py"


class Directory(unittest.TestCase):
    """A test with a copy of a run, which is in the current folder."""

    def setUp(self) -> None:
        folder = self.enterContext(tempfile.TemporaryDirectory())
        self.enterContext(contextlib.chdir(folder))
        self.path = Path(shutil.copytree(HERE / "tiny_run", Path("run")))
        self.run_there = caisson.load("run")


class Package(unittest.TestCase):
    """import caisson."""

    def python(self, code: str) -> str:
        """Return what a new process prints."""
        words = [sys.executable, "-B", "-c", code]
        return subprocess.run(
            words, text=True, capture_output=True, check=True, cwd=ROOT / "python"
        ).stdout.strip()

    def test_import_loads_no_large_package(self) -> None:
        large = "{'numpy', 'pandas', 'matplotlib', 'vtkmodules', 'scipy'}"
        code = f"import sys, caisson; print(sorted({large} & sys.modules.keys()))"
        self.assertEqual(self.python(code), "[]")

    def test_commands_do_not_hide_the_function(self) -> None:
        """No module of the package has its name."""
        code = "import caisson.commands.run; print(callable(caisson.run))"
        self.assertEqual(self.python(code), "True")

    def test_names(self) -> None:
        for name in caisson.__all__:
            self.assertTrue(getattr(caisson, name).__doc__, name)
            self.assertIn(name, dir(caisson))
        with self.assertRaisesRegex(AttributeError, "'caisson' has no attribute 'x'"):
            getattr(caisson, "x")

    def test_version(self) -> None:
        """The one of pyproject.toml is that of all files that name one."""
        self.assertEqual(caisson.__version__, version())
        self.assertRegex(version(), r"^\d+\.\d+\.\d+$")
        cite = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
        self.assertIn(f"\nversion: {version()}\n", cite)
        changes = (ROOT / "packaging/debian/changelog").read_text(encoding="utf-8")
        self.assertTrue(changes.startswith(f"caisson-mpm ({version()}-"))


class Program(unittest.TestCase):
    """Which program is called."""

    def test_places(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            there = Path(folder, "caisson_mpm")
            there.write_text("#!/bin/sh\n")
            there.chmod(0o755)
            with mock.patch.dict("os.environ", {"PATH": folder}) as environment:
                environment.pop("CAISSON_MPM_PROGRAM", None)
                with mock.patch("caisson.paths.BUILD", Path(folder, "none")):
                    self.assertEqual(find_program(), there)
                with mock.patch("caisson.paths.BUILD", Path(folder)):
                    self.assertEqual(find_program(), there)
                environment["CAISSON_MPM_PROGRAM"] = "/other"
                self.assertEqual(find_program(), Path("/other"))


class Load(Directory):
    """Directories, run.json and history.csv."""

    def test_no_run(self) -> None:
        with self.assertRaisesRegex(caisson.ResultsError, "no directory .*/none: give"):
            caisson.load("none")
        Path("empty").mkdir()
        with self.assertRaisesRegex(caisson.ResultsError, "no history.csv in .*/empty"):
            caisson.load("empty")

    def test_history(self) -> None:
        """A table over the time, with units."""
        table, arrays = self.run_there.history, self.run_there.results.history
        self.assertEqual(table.index.name, "time_s")
        self.assertNotIn("time_s", table.columns)
        self.assertEqual(table.shape, (len(arrays["time_s"]), len(arrays) - 1))
        np.testing.assert_array_equal(table["tip_force_N"], arrays["tip_force_N"])
        units = table.attrs["units"]
        self.assertEqual(units.keys(), arrays.keys())
        for name, unit in {
            "time_s": "s",
            "penetration_m": "m",
            "tip_force_N": "N",
            "max_speed_m_s": "m/s",
            "cavity_pressure_Pa": "Pa",
            "step": "1",
            "energy_residual": "1",
        }.items():
            self.assertEqual(units[name], unit, name)

    def test_without_pandas(self) -> None:
        with mock.patch.dict("sys.modules", {"pandas": None}):
            with self.assertRaisesRegex(
                ModuleNotFoundError, "pandas missing: .*setup python"
            ):
                self.run_there.history

    def test_summary(self) -> None:
        self.assertEqual(self.run_there.summary["steps"], 370)
        self.assertEqual(self.run_there.status, "finished")
        self.assertRegex(repr(self.run_there), "<run in .*/run: finished, 3 frames>")

    def test_a_run_that_has_not_ended(self) -> None:
        """Its history can be read, and not its summary."""
        (self.path / "run.json").unlink()
        self.assertEqual(self.run_there.status, "unfinished")
        words = "the run in .*/run is unfinished, .* no run.json"
        with self.assertRaisesRegex(caisson.ResultsError, words):
            self.run_there.summary
        self.assertGreater(len(self.run_there.history), 10)
        with (self.path / ".lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertEqual(self.run_there.status, "running")


class Frames(Directory):
    """Meshes, and which one is meant."""

    def test_choices(self) -> None:
        run = self.run_there
        self.assertEqual([frame.index for frame in run.frames], [0, 1, 2])
        self.assertIs(run.frame(penetration=0.8), run.frames[1])
        self.assertIs(run.frame(time=1.85), run.frame(index=-1))
        self.assertIs(run.frame(penetration=1.1, tolerance=0.3), run.frames[2])
        self.assertEqual(run.frame(index=0).penetration, 0.5)
        for wrong in ({}, {"time": 1.0, "index": 1}):
            with self.assertRaisesRegex(TypeError, "one of penetration, time and"):
                run.frame(**wrong)  # type: ignore[arg-type]

    def test_no_such_frame(self) -> None:
        """The message names the nearest ones."""
        words = r"penetration of 1 m: .* 3 frames are at 0\.8 m \(index 1\) and 1\.3 m"
        with self.assertRaisesRegex(caisson.ResultsError, words):
            self.run_there.frame(penetration=1)
        with self.assertRaisesRegex(caisson.ResultsError, r"at 0\.85 s \(index 1\)"):
            self.run_there.frame(time=1)
        with self.assertRaisesRegex(caisson.ResultsError, "it has 3, from 0 to 2"):
            self.run_there.frame(index=3)
        for file in self.path.glob("*.pvd"):
            file.unlink()
        with self.assertRaisesRegex(caisson.ResultsError, "has no frames: .*interval"):
            caisson.load("run").frame(index=0)

    def test_first_of_two_at_one_depth(self) -> None:
        """As of a caisson that is pulled out again."""
        depths = [1.0, 2.0, 1.0]
        frames = [Frame(Path("a"), i, i, depth, {}) for i, depth in enumerate(depths)]
        self.assertEqual(choose(frames, "penetration", 1.0, 0.01).index, 0)

    def test_cells(self) -> None:
        frame = self.run_there.frame(index=1)
        self.assertEqual(frame.mesh.GetClassName(), "vtkUnstructuredGrid")
        self.assertEqual(frame.mesh.GetNumberOfCells(), 196)
        self.assertEqual(frame.mesh.GetPointData().GetNumberOfArrays(), 0)
        count = frame.cell_data["material_points"]
        self.assertEqual(count.shape, (196,))
        self.assertEqual(frame.corners.shape, (196, 4, 2))
        width = frame.corners[:, 1, 0] - frame.corners[:, 0, 0]
        height = frame.corners[:, 3, 1] - frame.corners[:, 0, 1]
        self.assertGreater(min(width.min(), height.min()), 0)

    def test_arrays_are_those_of_the_mesh(self) -> None:
        frame = self.run_there.frame(index=1)
        frame.cell_data["zone"][7] = 42
        self.assertEqual(frame.mesh.GetCellData().GetArray("zone").GetValue(7), 42)

    def test_points(self) -> None:
        frame = self.run_there.frame(index=1)
        n = frame.points.GetNumberOfPoints()
        self.assertEqual(frame.positions.shape, (n, 2))
        self.assertEqual(frame.point_data["stress_Pa"].shape, (n, 6))
        self.assertEqual(frame.point_data["velocity_m_s"].shape, (n, 3))
        self.assertEqual(frame.units["void_ratio"], "1")

    def test_files_that_are_gone(self) -> None:
        (self.path / "grid_0001.vtu").unlink()
        frame = caisson.load("run").frame(index=1)
        self.assertIsNone(frame.body)
        with self.assertRaisesRegex(caisson.ResultsError, r"no grid_\*.vtu at 0.85 s"):
            frame.mesh

    def test_without_vtk(self) -> None:
        broken = mock.patch.dict("sys.modules", {"caisson.vtu": None})
        with broken, mock.patch("caisson.needed.complaint", return_value="VTK missing"):
            with self.assertRaisesRegex(ModuleNotFoundError, "VTK missing"):
                self.run_there.frame(index=1).mesh


class Runs(Directory):
    """caisson.run() with a program that stands in."""

    def run_to(self, name: str, **entries: object) -> caisson.LoadedRun:
        """Run with entries of the section Soil."""
        words = {f"Soil/{k.replace('_', ' ')}": v for k, v in entries.items()}
        Path("a.prm").touch()
        return caisson.run("a.prm", words, output_directory=name, program=FAKE_PROGRAM)

    def test_results(self) -> None:
        run = self.run_to("new", Friction_angle=35)
        self.assertEqual(run.directory, Path("new").absolute())
        self.assertEqual(run.history["total_force_N"].iloc[0], 0.5 * (35e3 + 5e3))

    def test_directory_of_the_scene(self) -> None:
        Path("a.prm").touch()
        run = caisson.run("a.prm", program=FAKE_PROGRAM)
        self.assertEqual(run.directory, Path("results").absolute())

    def test_what_the_program_says(self) -> None:
        with self.assertRaisesRegex(caisson.RunError, "there is no entry Soil/Stif"):
            self.run_to("new", Stifness=1)
        with self.assertRaisesRegex(caisson.RunError, "angle must be positive"):
            self.run_to("new", Friction_angle=-1)
        words = "(?s)failure: the soil is too strong.*status 2, results: new"
        with self.assertRaisesRegex(caisson.RunError, words):
            self.run_to("new", Friction_angle=41)
        self.assertEqual(caisson.load("new").status, "unfinished")

    def test_no_program(self) -> None:
        with self.assertRaisesRegex(caisson.RunError, "no program none: .*PROGRAM"):
            caisson.run("a.prm", program="none")
        with self.assertRaisesRegex(caisson.RunError, "ranks is 0"):
            caisson.run("a.prm", program=FAKE_PROGRAM, ranks=0)


if __name__ == "__main__":
    unittest.main()
