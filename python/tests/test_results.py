# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of a run, tables, and pictures of a stored tiny run."""
import contextlib
import io
import os
import shutil
import tempfile
import unittest
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from caisson import disk, plot, table, units
from caisson.frame import frames_of
from caisson.plot import fields, forces
from caisson.plot.cells import CellMeans, cell_of
from caisson.plot.fields import boundary_now, chosen, tops_of, window_of
from caisson.plot.walls import draw as draw_walls
from caisson.plot.walls import shown_times
from caisson.results import Results, ResultsError, read_table
from lab.studies import forces as forces_study

disk.DPI = 40  # of pictures, at which nobody looks
TINY = Path(__file__).resolve().parent / "tiny_run"
PICTURES = [
    "design.csv",
    "displacement.png",
    "forces.png",
    "stress.png",
    "void_ratio.png",
    "walls.png",
]


class Directory(unittest.TestCase):
    """A test with a directory of its own."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)

    def write(self, text: str, name: str = "history.csv") -> Path:
        """Write a file and return its path."""
        (self.path / name).write_text(text, encoding="utf-8")
        return self.path / name


class Files(Directory):
    """Reading history.csv and the others."""

    def test_torn_rows_and_comments_are_left_out(self) -> None:
        path = self.write("# c\ntime_s,b\n0,1\n1,inf\n\n2,3\n4,")
        found = read_table(path)
        np.testing.assert_array_equal(found["time_s"], [0, 1, 2])
        np.testing.assert_array_equal(found["b"], [1, np.inf, 3])

    def test_errors_name_the_file(self) -> None:
        with self.assertRaisesRegex(ResultsError, "no history.csv in .*output direc"):
            Results(self.path).history
        self.write("time_s,b\n")
        with self.assertRaisesRegex(ResultsError, "no complete row"):
            Results(self.path).history
        self.write("a,b\n1,2\n")
        with self.assertRaisesRegex(ResultsError, "no column time_s"):
            Results(self.path).history
        self.write("{", "run.json")
        with self.assertRaisesRegex(ResultsError, "run.json cannot be read"):
            Results(self.path).summary

    def test_history_that_is_cut_off(self) -> None:
        """A finished run knows its last step; a row that is not whole is none."""
        self.write('{"status": "finished", "steps": 20}', "run.json")
        for end in ("", "20,2", "20,2,\n"):
            self.write(f"time_s,step,b\n0,0,1\n1,10,1\n{end}")
            with self.assertRaisesRegex(ResultsError, "history.csv is cut .*10, .* 20"):
                Results(self.path).history
        self.write("time_s,step,b\n0,0,1\n1,20,1\n")
        self.assertEqual(len(Results(self.path).history["step"]), 2)
        self.write('{"status": "running", "steps": 30}', "run.json")
        self.assertEqual(len(Results(self.path).history["step"]), 2)

    def test_values_of_another_type(self) -> None:
        """The file and the key are named, and what stands there."""
        for text, words in (
            ('{"entries": [1]}', r"entries is \[1\], and no object"),
            ('{"defaults": null}', "defaults is None, and no object"),
            ('{"energies": {"a_J": "x"}}', "energies/a_J is 'x', and no number"),
            ('{"results": {"warnings": 5}}', "results/warnings is 5, and no list"),
            ('{"results": {"warnings": [{}, 1]}}', "warnings/2 is 1, and no object"),
            ('{"scene": {"diameter_m": "a"}}', "diameter_m is 'a', and no number"),
            ('{"scene": {"layers": [{"law": 2}]}}', "layers/1/law is 2, and no text"),
        ):
            self.write(text, "run.json")
            with self.assertRaisesRegex(ResultsError, f"run.json: .*{words}"):
                Results(self.path).summary

    def test_keys_that_are_missing(self) -> None:
        """Of a finished run, unless an earlier version wrote the file."""
        self.write('{"status": "finished", "written": "", "entries": {}}', "run.json")
        with self.assertRaisesRegex(ResultsError, "run.json has no units"):
            Results(self.path).summary
        self.write('{"status": "finished"}', "run.json")
        self.assertEqual(len(Results(self.path).summary), 1)

    def test_frames_that_are_gone_are_left_out(self) -> None:
        run = Results(shutil.copytree(TINY, self.path / "run"))
        times = [time for time, _ in run.frames()]
        self.assertEqual((len(times), times[0]), (3, 0.0))
        (self.path / "run/points_0001.vtu").unlink()
        self.assertEqual(len(run.frames()), 2)
        self.assertEqual(Results(self.path).frames(), [])

    def test_path_that_is_no_text(self) -> None:
        """A frame is read whatever bytes its path has."""
        path = self.path / os.fsdecode(b"\xff")
        frames = frames_of(Results(shutil.copytree(TINY, path)))
        self.assertGreater(len(frames[0].positions), 0)


class Tables(Directory):
    """Markdown and .csv."""

    def test_markdown(self) -> None:
        text = table.markdown(["a", "long"], [["x|y", 0.123456], [7, 1234.5]])
        lines = text.splitlines()
        self.assertEqual(lines[0], "| a    | long  |")
        self.assertEqual(lines[1], "|------|-------|")
        self.assertEqual(lines[2], "| x\\|y | 0.123 |")
        self.assertEqual(lines[3], "| 7    | 1234  |")

    def test_cells(self) -> None:
        self.assertEqual(table.cell(1.23e-5), "1.23e-05")
        self.assertEqual(table.cell(0.0), "0")
        self.assertEqual(table.number(None), "-")
        self.assertEqual(table.number(3.14159, 3), "3.14")

    def test_csv_has_all_digits(self) -> None:
        table.write_csv(self.path / "t.csv", ["a"], [[0.1234567890123]])
        self.assertIn("0.1234567890123", (self.path / "t.csv").read_text())


class Pictures(Directory):
    """scripts/caisson plot, and the numbers of a study of forces."""

    def test_tiny_run(self) -> None:
        path = Path(shutil.copytree(TINY, self.path / "run"))
        files = plot.draw(path)
        self.assertEqual(sorted(p.name for p in files), PICTURES)
        for picture in [file for file in files if file.suffix == ".png"]:
            self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
            self.assertGreater(picture.stat().st_size, 10_000)

    def test_forces_of_a_pile(self) -> None:
        """A pile has no inner wall, and its base penetrates."""
        for kind, has_wall, lowest in (
            ("caisson", True, "skirt tip"),
            ("pile", False, "pile base"),
        ):
            run = Results(shutil.copytree(TINY, self.path / kind))
            run.summary["entries"] = {"Rigid body/Kind": kind}
            panels = forces.draw_over_depth(run, run.history["penetration_m"]).axes
            names = [line.get_label() for panel in panels for line in panel.lines]
            self.assertEqual("inner friction" in names, has_wall)
            self.assertIn("outer friction", names)
            for panel in panels:
                self.assertEqual(panel.get_ylabel(), f"penetration of the {lowest} (m)")

    def test_order_of_raw_lines(self) -> None:
        """It is that of the legend, so that a picture is the same in each process."""
        run = Results(TINY)
        panel = forces.draw_over_depth(run, run.history["penetration_m"]).axes[0]
        raw = [line.get_color() for line in panel.lines if line.get_linewidth() == 0.5]
        self.assertEqual(raw, list(forces.COLORS.values()))

    def test_frames_of_another_version(self) -> None:
        path = Path(shutil.copytree(TINY, self.path / "run"))
        for file in path.glob("points_*.vtu"):
            text = file.read_text(encoding="utf-8")
            file.write_text(text.replace('"stress_Pa"', '"other"'), encoding="utf-8")
        with self.assertRaisesRegex(ResultsError, "no field stress_Pa"):
            plot.draw(path)

    def test_history_alone(self) -> None:
        shutil.copy(TINY / "history.csv", self.path)
        with contextlib.redirect_stdout(io.StringIO()) as words:
            pictures = plot.draw(self.path)
        self.assertEqual([p.name for p in pictures], ["forces.png"])
        self.assertIn("forces only", words.getvalue())

    def test_no_directory(self) -> None:
        with self.assertRaisesRegex(ResultsError, "no directory"):
            plot.draw(self.path / "none")

    def test_frames_of_the_scene_are_drawn(self) -> None:
        depths = partial(chosen, np.arange(11.0))
        self.assertEqual(depths([0, 2, 10]), [0, 2, 10])
        self.assertEqual(depths([2, 7]), [2, 7, 10], "the last state")
        self.assertEqual(depths([]), [0, 5, 10])
        self.assertEqual(depths([0, 2, 17]), [0, 5, 10], "not reached")
        self.assertEqual(depths([0, 1, 2, 3, 4]), [0, 5, 10], "too many")

    def test_undisturbed_ground_is_not_drawn(self) -> None:
        """Of the three frames of the run the last two."""
        labels = [frame.label for frame in fields.frames_of(Results(TINY))]
        self.assertEqual(len(Results(TINY).frames()), 3)
        self.assertEqual(len(labels), 2)

    def test_window_about_a_slender_body(self) -> None:
        """A cone stands in soil as wide as the picture needs; a caisson has its
        diameter to each side."""

        def frame(radius: float, tip: float) -> SimpleNamespace:
            cells = np.array([[[0, -20], [9, -20], [9, 0], [0, 0]]], dtype=float)
            body = np.array([[[0, tip], [radius, tip], [radius, 1], [0, 1]]])
            return SimpleNamespace(means=SimpleNamespace(polygons=cells), body=body)

        def window(radius: float, tip: float) -> list[float]:
            made: Any = frame(radius, tip)
            return np.round(window_of(made, made, {}), 2).tolist()

        self.assertEqual(window(0.1, -5), [2.4, -8, 0.64])
        self.assertEqual(window(2, -5), [4, -8, 0.64])
        self.assertEqual(window(6, -5), [9, -12, 0.96], "to the end of the mesh")

    def test_halved_cells(self) -> None:
        """A cell lies beside four, beneath two, and above two smaller ones."""

        def square(r: float, z: float, size: float) -> list[list[float]]:
            return [[r, z], [r + size, z], [r + size, z + size], [r, z + size]]

        halves = [square(r, z, 0.5) for z in (1, 1.5) for r in (0, 0.5)]
        cells = np.array([square(0, 0, 1), *halves, square(0, 2, 1), square(1, 1, 1)])
        middles = cells.mean(axis=1)
        self.assertEqual(list(cell_of(middles, cells)), list(range(7)))
        self.assertEqual(
            list(cell_of(np.array([[2.5, 0.5], [1.5, 5]]), cells)), [-1, 6]
        )
        area = np.array([1, 0.25, 0.25, 0.25, 0.25, 1, 1])
        volume = area * 2 * np.pi * middles[:, 0] * 0.8
        means = CellMeans(middles, volume, cells, np.zeros(7, dtype=bool))
        tops = means.polygons[:, 2:, 1].mean(axis=1)
        self.assertEqual(list(tops[:5]), list(cells[:5, 2, 1]), "not at the surface")
        expected = [[2.3, 2.8], [1.8, 2.3]]  # 2.8 and 1.8, which meet
        found = means.polygons[5:, 2:, 1]
        self.assertTrue(np.allclose(found, expected), "at the surface")

    def test_between_the_means_of_cells(self) -> None:
        """A corner has the mean of the cells that meet there and have a value."""
        cells = np.array(
            [[[r, 0], [r + 1, 0], [r + 1, 1], [r, 1]] for r in (0, 1, 2, 3)], float
        )
        middles = cells.mean(axis=1)
        volume = 2 * np.pi * middles[:, 0]
        means = CellMeans(middles, volume, cells, np.zeros(4, dtype=bool))
        found = means.at_corners(np.array([1.0, 3.0, np.nan, np.nan]))
        np.testing.assert_allclose(found[0], [1, 2, 2, 1])
        np.testing.assert_allclose(found[1], [2, 3, 3, 2])
        np.testing.assert_allclose(found[2], [3, np.nan, np.nan, 3])

    def test_boundaries_between_layers(self) -> None:
        """They move with the points beside them, not with the cells, and are unknown
        where there is no point. Pieces of a layer have no boundary."""
        r, z = (x.ravel() for x in np.meshgrid([0.5, 1.5, 3.5], [-1.5, -2.5, -3.5]))
        move = np.column_stack([0 * r, -0.1 * r])
        now = np.column_stack([r, z]) + move
        found = boundary_now(now, move, -2.0, np.array([0.0, 1, 2, 3, 4]))
        np.testing.assert_allclose(found[:, 1], [-2.05, -2.15, np.nan, -2.35])
        np.testing.assert_allclose(found[:, 0], [0.5, 1.5, 2.5, 3.5])
        depths = ((1, 0.0), (1, 2.0), (2, 3.0))
        layers = [{"layer": n, "top_depth_m": top} for n, top in depths]
        self.assertEqual(tops_of({"layers": layers}), [-3.0])

    def test_walls(self) -> None:
        """At most three times, the last among them; no picture without a wall."""
        walls = Results(TINY).walls
        self.assertEqual(walls["time_s"].max(), shown_times(walls)[-1])
        time = np.repeat(np.arange(9.0), 5)
        table = {"time_s": time, "penetration_m": 0.5 * time}
        self.assertEqual(shown_times(table).tolist(), [0, 4, 8])
        wanted = [0.01, 2.5, 4.0]  # as of the pictures of fields
        self.assertEqual(shown_times(table, wanted).tolist(), [0, 5, 8])
        self.assertEqual(shown_times(table, [9.0]).tolist(), [0, 4, 8])
        self.assertIsNone(draw_walls(self.path / "walls.png", Results(self.path)))

    def test_means_pass_over_what_is_unknown(self) -> None:
        corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
        cells = np.array([corners, corners + [1, 0]])
        position = np.array([[0.2, 0.5], [0.5, 0.5], [0.8, 0.5], [1.5, 0.5]])
        volume = np.array([1.0, 2.0, 3.0, 10.0])
        means = CellMeans(position, volume, cells, np.zeros(2, dtype=bool))
        np.testing.assert_allclose(means.of(np.array([6, 3, 2, 7])), [3, 7])
        values = np.array([6, np.nan, 2, np.nan])
        np.testing.assert_allclose(means.of(values), [3, np.nan])

    def test_names_of_quantities(self) -> None:
        """Those of earlier versions have no units."""
        for name in ("stress_zz", "velocity", "displacement", "whole_volume"):
            unit = {"s": "Pa", "v": "m_s", "d": "m", "w": "m3"}[name[0]]
            self.assertEqual(units.split(f"{name}_{unit}")[0], name)
            self.assertEqual(units.split(name), (name, units.NONE))
        self.assertEqual(units.unit_of("seepage_flow_m3_s"), "m3/s")
        self.assertEqual(units.unit_of("max_speed_m_s"), "m/s")

    def test_curve(self) -> None:
        lines = list(forces_study.describe(TINY, [1.0, 9.0]))
        self.assertRegex(lines[1], r"1\.00 m: tip +\d+\.\d  friction +\d+\.\d kN")
        self.assertRegex(lines[2], r"9\.00 m: not reached \(ends at \d\.\d\d m\)")
        self.assertEqual(len(lines), 5)

    def test_curve_under_suction(self) -> None:
        """2 kPa are required at 2 m, where the gradient is 0.2 of 0.8."""
        depth = np.linspace(0.5, 3.0, 251)
        history = {
            "penetration_m": depth,
            "required_suction_Pa": 1e3 * depth,
            "exit_gradient_wall": 0.1 * depth,
            "exit_gradient_axis": np.zeros(len(depth)),
            "critical_gradient": np.full(len(depth), 0.8),
        }
        (words,) = forces_study.suction_words(history, np.array([2.0]))
        self.assertIn("suction   2.0 kPa, margin to piping  75 %", words)


if __name__ == "__main__":
    unittest.main()
