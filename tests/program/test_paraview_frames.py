#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the frames for ParaView contain: points, means of cells, the body."""
import math
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.image import imread
from program import FAILURE, SUCCESS, Entries, ProgramTest, history, summary

from caisson import plot
from caisson.paths import ROOT
from caisson.plot.cells import cell_of
from caisson.vtu import corners_of, named_arrays, positions_of, read_grid
from caisson.results import Results

Arrays = dict[str, np.ndarray]
CELLS = {"material_id", "zone", "material_points"}
RATIO = "vertical_stress_over_stress_at_rest"
VERTICAL = "vertical_effective_stress_kPa"
STRESS = {"stress_Pa", VERTICAL, RATIO, "layer"}
POINTS = STRESS | {
    *("id", "velocity_m_s", "displacement_m", "mean_stress_Pa", "deviator_Pa"),
    *("plastic_deviatoric", "plastic_volumetric", "material", "void_ratio"),
    "whole_volume_m3",
}
START: Entries = {"Time/End penetration": 0.5}  # where simulation/jack.prm begins
TIP = 0.2 * 0.2 / 2 / 2  # m2, what the wedge of simulation/jack.prm lacks of a flat tip


def read(file: Path) -> tuple[np.ndarray, Arrays]:
    """Return the vertices [n, 2] of a file of points, or the middles of the cells,
    and the arrays of one of them by their names."""
    grid = read_grid(file)
    of_points, of_cells = grid.GetPointData(), grid.GetCellData()
    assert 0 in (of_points.GetNumberOfArrays(), of_cells.GetNumberOfArrays())
    if of_points.GetNumberOfArrays() > 0:
        return positions_of(grid), named_arrays(of_points)
    return corners_of(grid).mean(axis=1), named_arrays(of_cells)


def files(path: Path, series: str) -> list[Path]:
    """Return the files that a series lists, one for each frame."""
    frames = Results(path).frames(series)
    assert all(len(names) == 1 for _, names in frames), frames
    return [names[0] for _, names in frames]


def area(file: Path) -> float:
    """Return the area of all cells of a file (m2)."""
    x, y = np.moveaxis(corners_of(read_grid(file)), -1, 0)
    twice = x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)
    return float(np.abs(twice.sum(axis=1)).sum() / 2)


class FramesTest(ProgramTest):
    """A test of the frames of a short run."""

    def frames_of(self, name: str, entries: Entries, **more: Any) -> Path:
        """Run a scene of this directory, without its checks; where its results
        are."""
        path = self.directory(more.pop("directory", "results"))
        entries = {"Verification/Checks": "", **entries}
        self.run_scene(name, path, entries=entries, **more)
        return path

    jack: Path | None = None

    def frames_of_jack(self) -> Path:
        """Return where the results of simulation/jack.prm are, which is run once."""
        if FramesTest.jack is None:
            FramesTest.jack = self.frames_of("jack", {})
        return FramesTest.jack


class Fields(FramesTest):
    """points.pvd and grid.pvd."""

    def test_names_have_units(self) -> None:
        """The pictures are drawn of them, too."""
        path = self.frames_of_jack()
        names = {s: set(read(files(path, s)[0])[1]) for s in ("points", "grid", "body")}
        self.assertEqual(names["points"], POINTS)
        self.assertEqual(names["grid"], CELLS | STRESS | {"void_ratio"})
        self.assertEqual(names["body"], {"penetration_m"})
        pictures = [picture.name for picture in plot.draw(path)]
        self.assertIn("stress.png", pictures)
        self.assertIn("displacement.png", pictures)

    def test_pore_pressure(self) -> None:
        path = self.frames_of(
            "../lab/verification/consolidation",
            {"Time/End time": 0.1, "Grid/Cell width": 0.1, "Grid/Cell height": 0.1},
        )
        for series, names in (("points", POINTS), ("grid", CELLS | STRESS)):
            with self.subTest(series=series):
                arrays = read(files(path, series)[-1])[1]
                expected = names | {"void_ratio", "pore_pressure_Pa"}
                self.assertEqual(set(arrays), expected)
                largest = np.nanmax(arrays["pore_pressure_Pa"])
                self.assertTrue(5e3 < largest < 2e4, largest)  # the load is 10 kPa

    def test_cell_means(self) -> None:
        """They are the means of the points by volume, and not a number where no
        point is."""
        path = self.frames_of("jack_refined", {"Time/End penetration": 0.6})
        position, points = read(files(path, "points")[-1])
        file = files(path, "grid")[-1]
        corners, cells = corners_of(read_grid(file)), read(file)[1]
        n = cells["material_points"].astype(int)
        cell = cell_of(position, corners)
        # in single precision a point at a side may lie in the next cell
        sure = (np.bincount(cell, minlength=len(corners)) == n) & (n > 0)
        self.assertGreater(sure.sum(), 0.95 * (n > 0).sum())
        volume = np.bincount(cell, points["whole_volume_m3"], len(corners))[sure]
        pairs = {x: (points[x], cells[x]) for x in ("void_ratio", VERTICAL)}
        for i, name in enumerate(("rr", "zz", "tt", "rz")):
            pairs[name] = points["stress_Pa"][:, i], cells["stress_Pa"][:, i]
        for name, (of_points, found) in pairs.items():
            np.testing.assert_array_equal(np.isnan(found), n == 0, name)
            weighted = points["whole_volume_m3"] * of_points
            expected = np.bincount(cell, weighted, len(corners))[sure] / volume
            error = np.abs(found[sure] - expected).max()
            self.assertLess(error, 2e-6 * np.abs(of_points).max(), name)

    def test_tensor_and_stress_at_rest(self) -> None:
        """Six components in the order of VTK, of which the last are 0; the vertical
        stress is that of the tensor, and its ratio is 1 at the start, where the soil
        has its weight, of 8829 N/m3."""
        path = self.frames_of_jack()
        for series in ("points", "grid"):
            first, last = [read(files(path, series)[i]) for i in (0, -1)]
            stress = last[1]["stress_Pa"]
            self.assertEqual(stress.shape[1], 6)
            self.assertTrue((stress[:, 4:] == 0).all())
            vertical = last[1]["vertical_effective_stress_kPa"]
            np.testing.assert_allclose(-stress[:, 1] / 1e3, vertical, rtol=1e-6)
            soil = np.isfinite(first[1]["vertical_effective_stress_kPa"])
            np.testing.assert_allclose(first[1][RATIO][soil], 1, atol=1e-4)
            depth = -last[0][:, 1]
            sure = np.isfinite(vertical) & (depth > 1)
            expected = vertical[sure] / (8.829 * depth[sure])
            # the means of a cell are over its points, not at its middle
            tolerance = 1e-4 if series == "points" else 0.2
            found = last[1][RATIO][sure]
            np.testing.assert_allclose(found, expected, rtol=tolerance)
            self.assertGreater(found.max(), 2)

    def test_layers(self) -> None:
        """Each point and cell knows its layer, from 1."""
        path = self.frames_of("equilibrium_layers", {})
        layers = set(np.unique(read(files(path, "points")[0])[1]["layer"]))
        self.assertEqual(layers, {1, 2})
        depth, cells = read(files(path, "grid")[0])
        known = np.isfinite(cells["layer"])
        upper, lower = [depth[cells["layer"] == i, 1] for i in (1, 2)]
        self.assertGreater(upper.min(), lower.max())
        self.assertEqual(known.sum(), len(upper) + len(lower))

    def test_void_ratios_that_mean_nothing(self) -> None:
        """Below 0, and where the volume has more than doubled. The change of volume
        follows from the volumes of the first frame."""
        cases = (
            # sinks by up to 16 %, more than all its pores
            ("compaction", {"Soil/Layer 1/Porosity": 0.05}, 0.05, True),
            # the volume grows by exp(0.8)
            ("patch_stretching", {"Soil/Layer 1/Porosity": 0.4}, 0.4, False),
        )
        for name, entries, porosity, some in cases:
            with self.subTest(scene=name):
                entries = {**entries, "Output/Frame interval": 0.5}
                path = self.frames_of(name, entries, directory=name)
                frames = [read(file)[1] for file in files(path, "points")]
                order = [np.argsort(frame["id"]) for frame in frames]
                first = frames[0]["whole_volume_m3"][order[0]].astype(float)
                n_unknown = 0
                for frame, rank in zip(frames, order):
                    ratio = frame["whole_volume_m3"][rank] / first
                    expected = ratio / (1 - porosity) - 1
                    found = frame["void_ratio"][rank]
                    clear = (np.abs(expected) > 1e-5) & (np.abs(ratio - 2) > 1e-5)
                    unknown = (expected < 0) | (ratio > 2)
                    np.testing.assert_array_equal(
                        np.isnan(found)[clear], unknown[clear]
                    )
                    known = clear & ~unknown
                    np.testing.assert_allclose(
                        found[known], expected[known], rtol=0, atol=1e-5
                    )
                    n_unknown = unknown.sum()
                n = len(first)
                self.assertTrue(0 < n_unknown < n if some else n_unknown == n)
                means = read(files(path, "grid")[-1])[1]
                self.assertEqual(np.isnan(means["void_ratio"]).all(), not some)
                self.assertFalse(np.isnan(means["stress_Pa"]).all())

    def test_loosest_state(self) -> None:
        """Sand that dilates beside a wall: where it bears it is nowhere looser than
        Largest void ratio, and a gap is no part of the void ratio."""
        layer, largest = "Soil/Layer 1", 0.75
        entries: Entries = {
            f"{layer}/Friction angle": 40,
            f"{layer}/Dilatancy angle": 15,
            f"{layer}/Largest void ratio": largest,
        }
        points = files(self.frames_of("jack", entries), "points")
        first, last = (read(points[i])[1] for i in (0, -1))
        volume = [f["whole_volume_m3"][np.argsort(f["id"])] for f in (first, last)]
        with_gaps = volume[1].astype(float) / volume[0] / (1 - 0.4) - 1
        pressure = -last["mean_stress_Pa"][np.argsort(last["id"])]
        self.assertLess(with_gaps[pressure > 1].max(), largest + 1e-5)
        self.assertLess(np.nanmax(last["void_ratio"]), largest + 1e-5)
        self.assertGreater((last["void_ratio"] > 0.99 * largest).sum(), 100)

    def test_no_void_ratio_without_pores(self) -> None:
        path = self.frames_of("compaction", {"Soil/Layer 1/Porosity": 0})
        self.assertTrue(
            np.isnan(read(files(path, "points")[-1])[1]["void_ratio"]).all()
        )
        self.assertNotIn("void_ratio.png", [p.name for p in plot.draw(path)])


class Body(FramesTest):
    """body.pvd."""

    def test_area(self) -> None:
        """Of the section of each kind of body, from its dimensions."""
        wall, radius, length = "Rigid body/Cells across the wall", 0.2, 2.0
        cone = radius * math.sqrt(3)
        bevel = {wall: 4, "Rigid body/Shoulder bevel": 0.5}  # half a cell of 0.05 m
        cases: list[tuple[str, Entries, float]] = [
            ("jack", START, 0.2 * 3 - TIP),
            ("jack", {**START, "Rigid body/Tip": "flat"}, 0.2 * 3),
            (
                "jack",
                {**START, "Rigid body/Lid thickness": 0.3},
                0.2 * 3 - TIP + 0.3 * 2.8,
            ),
            ("jack", {**START, **bevel}, 0.2 * 3 - TIP - 0.025 * 0.05),
            ("jack_refined", START, 0.2 * 3 - TIP),
            (
                "equilibrium_cone",
                {"Time/End time": 1e-3},
                radius * (length - cone) + radius * cone / 2,
            ),
            ("block_slides", {"Time/End time": 1e-3}, 2 * 0.1),
        ]
        for name, entries, expected in cases:
            with self.subTest(scene=name, entries=entries):
                path = self.frames_of(name, entries)
                for file in files(path, "body"):
                    self.assertAlmostEqual(area(file), expected, delta=1e-5)

    def test_moves_with_the_penetration(self) -> None:
        path = self.frames_of("jack", {"Output/Frame penetrations": "0.5, 0.6, 0.7"})
        by_depth = Results(path).frames("body_by_penetration")
        times = [time for time, _ in Results(path).frames("body")]
        self.assertEqual([f for _, f in by_depth], [[f] for f in files(path, "body")])
        self.assertEqual(times, [time for time, _ in Results(path).frames()])
        self.assertGreater(len(times), 3)
        rows = history(path)
        columns = [[row[key] for row in rows] for key in ("time_s", "penetration_m")]
        depths = np.interp(times, columns[0], columns[1])
        first, _ = read(files(path, "body")[0])
        lowest = corners_of(read_grid(files(path, "body")[0]))[..., 1].min()
        self.assertAlmostEqual(lowest, -0.5, delta=1e-6)
        marks = [depth for depth, _ in by_depth]
        for file, depth in zip(files(path, "body"), depths):
            vertices, arrays = read(file)
            moved = vertices.astype(float) - first
            np.testing.assert_allclose(moved[:, 0], 0, atol=1e-6)
            np.testing.assert_allclose(moved[:, 1], 0.5 - depth, atol=2e-6)
            self.assertAlmostEqual(dict(zip(files(path, "body"), marks))[file], depth)
            np.testing.assert_allclose(arrays["penetration_m"], depth, atol=2e-6)
        self.assertAlmostEqual(depths[-1], 0.75)

    def test_cylinder_widens(self) -> None:
        """It is as high as the mesh, and begins at r = 0.4 m, where it widens, too."""
        path = self.frames_of("cavity", {})
        growth = history(path)[-1]["penetration_m"]
        self.assertGreater(growth, 4e-4)
        first, last = [area(files(path, "body")[i]) for i in (0, -1)]
        self.assertAlmostEqual(first, 0.1 * 0.05, delta=1e-7)
        self.assertAlmostEqual(last, 0.1 * (1 + growth / 0.5) * 0.05, delta=1e-7)

    def test_no_body(self) -> None:
        path = self.frames_of("compaction", {"Time/End time": 1e-3})
        self.assertEqual(len(files(path, "grid")), 2)
        self.assertEqual(list(path.glob("body*")), [])


OF_OTHER_SCENES = {"pore_pressure_Pa", "statev_1"}


class Manual(FramesTest):
    """doc/how_to/paraview.md."""

    page = (ROOT / "doc/how_to/paraview.md").read_text(encoding="utf-8")

    def test_arrays(self) -> None:
        """The tables have all arrays but the strains of single laws, and no other."""
        path = self.frames_of_jack()
        for series, known in (("points", POINTS), ("grid", CELLS | STRESS)):
            table = self.page.split(f"| array of `{series}.pvd`")[1].split("\n\n")[0]
            rows = [row.split("|")[1] for row in table.splitlines()[2:]]
            names = set(re.findall("`([^`]+)`", " ".join(rows)))
            there = set(read(files(path, series)[-1])[1])
            self.assertEqual(names - OF_OTHER_SCENES, there)
            self.assertEqual(there - {"void_ratio"}, known - {"void_ratio"})

    @unittest.skipUnless(shutil.which("pvpython"), "ParaView is not installed")
    def test_picture(self) -> None:
        """The command of the page draws soil in many colors on white, and the body."""
        (words,) = re.findall("^pvpython .*$", self.page, re.M)
        folder = self.made_directory()
        (folder / "python").symlink_to(ROOT / "python")
        self.frames_of("jack", {}, directory="files/results/jack")
        display = [] if os.environ.get("DISPLAY") else ["xvfb-run", "-a"]
        subprocess.run([*display, *words.split()], cwd=folder, check=True)
        picture = imread(folder / "results/jack/paraview.png")[..., :3]
        colors = np.round(picture * 255).astype(int)
        for corner in (colors[0, -1], colors[60, 5]):
            self.assertEqual(corner.tolist(), [255] * 3)
        gray = np.ptp(colors, axis=-1) < 3
        self.assertGreater((gray & (abs(colors[..., 0] - 115) < 3)).mean(), 0.005)
        for half in np.array_split(colors, 2, axis=1):
            soil = half[300:700].reshape(-1, 3)
            soil = soil[np.ptp(soil, axis=1) > 10]
            self.assertGreater(len(soil), 0.3 * 400 * half.shape[1])
            self.assertGreater(len(np.unique(soil, axis=0)), 20)


class Files(FramesTest):
    """The same files on any number of ranks, and for any number of points."""

    def test_ranks(self) -> None:
        entries = {**START, "Time/End penetration": 0.6}
        one, two = [
            self.frames_of("jack", entries, ranks=n, directory=f"ranks_{n}")
            for n in (1, 2)
        ]
        for pattern in ("*.vtu", "*.pvd", "*.pvtu"):
            names = [sorted(f.name for f in p.glob(pattern)) for p in (one, two)]
            self.assertEqual(*names)
        for series in ("points", "grid", "body"):
            with self.subTest(series=series):
                found = [read(files(path, series)[-1]) for path in (one, two)]
                self.assert_same_frames(*found)
        texts = [files(path, "body")[-1].read_text() for path in (one, two)]
        bodies = [text[text.index("<VTKFile") :] for text in texts]
        self.assertEqual(*bodies)  # but for the date

    def test_ranks_without_points(self) -> None:
        """One of three ranks has the only cell."""
        entries: Entries = {
            **{"Grid/Cell width": 1, "Grid/Cell height": 1, "Time/End time": 1e-3},
            "Soil/Layer 1/Porosity": 0.4,
        }
        one, many = [
            self.frames_of("two_fields", entries, ranks=n, directory=f"ranks_{n}")
            for n in (1, 3)
        ]
        for series in ("points", "grid"):
            found = [read(files(path, series)[-1]) for path in (one, many)]
            self.assert_same_frames(*found)
        self.assertEqual(files(many, "grid")[-1].read_text().count("<Piece "), 1)

    def assert_same_frames(
        self, a: tuple[np.ndarray, Arrays], b: tuple[np.ndarray, Arrays]
    ) -> None:
        """Ask for the same values at the same places, which are in another order."""
        self.assertEqual(a[1].keys(), b[1].keys())
        orders = []
        for vertices, arrays in (a, b):
            keys = np.round(vertices, 5).T
            orders.append(np.lexsort([arrays["id"]] if "id" in arrays else keys))
        np.testing.assert_allclose(a[0][orders[0]], b[0][orders[1]], atol=1e-6)
        for name, values in a[1].items():
            known = values[np.isfinite(values)]
            np.testing.assert_allclose(
                values[orders[0]],
                b[1][name][orders[1]],
                rtol=0,
                atol=2e-6 * np.abs(known).max(initial=1),
                equal_nan=True,
                err_msg=name,
            )

    def test_restart(self) -> None:
        """All series go on after the checkpoint; frames of later times are dropped,
        as a run that was killed may have left them."""
        path = self.directory()
        entries: Entries = {
            "Output/Record interval": 0.02,
            "Output/Frame penetrations": "0.52, 0.54, 0.56",
            "Time/End penetration": 0.53,
        }
        self.run_scene("jack", path, entries=entries)
        for series in ("points", "grid", "body"):
            self.assertEqual(len(files(path, series)), 3)
            last = files(path, series)[-1].name
            text = (path / f"{series}.pvd").read_text()
            line = f'<DataSet timestep="99" group="" part="0" file="{last}"/>'
            text = text.replace("</Collection>", f"{line}</Collection>")
            (path / f"{series}.pvd").write_text(text)
        entries["Time/End penetration"] = 0.57
        self.run_scene("jack", path, SUCCESS, "--restart", entries=entries)
        rows = history(path)
        depth, time = [[row[k] for row in rows] for k in ("penetration_m", "time_s")]
        for series in ("points", "grid", "body"):
            with self.subTest(series=series):
                frames = Results(path).frames(series)
                depths = np.interp([t for t, _ in frames], time, depth)
                expected = [0.5, 0.52, 0.53, 0.54, 0.56, 0.57]
                np.testing.assert_allclose(depths, expected, atol=1e-3)
                numbers = [f"{series}_000{i}.vtu" for i in range(6)]
                self.assertEqual([f.name for f in files(path, series)], numbers)

    def test_frame_that_cannot_be_written(self) -> None:
        """As on a full disk: no series lists a frame of which a file is missing."""
        for ranks in (1, 2):
            path = self.made_directory()
            (path / "body_0001.vtu" / "in_the_way").mkdir(parents=True)
            entries = {"Time/End penetration": 0.51}
            text = self.run_scene("jack", path, FAILURE, entries=entries, ranks=ranks)
            (failure,) = [line for line in text.splitlines() if "failure: " in line]
            self.assert_words(["body_0001.vtu", "frames so far are kept"], failure)
            for series in ("points", "grid", "body"):
                self.assertEqual(
                    [file.name for file in files(path, series)], [f"{series}_0000.vtu"]
                )
            self.assertEqual(list(path.glob("*.tmp")), [])

    def test_many_points(self) -> None:
        """More than 100,000 on a rank are two pieces of one file."""
        per_direction = [f"Material points/Per direction {s}" for s in ("near", "far")]
        path = self.frames_of(
            "jack",
            {
                **START,
                **{entry: 16 for entry in per_direction},
                "Material points/Per direction in path": 16,
                "Time/Time step": 1e-5,
            },
        )
        n = summary(path)["material_points"]
        self.assertGreater(n, 100_000)
        self.assertEqual(list(path.glob("*.pvtu")), [])
        (file,) = files(path, "points")
        self.assertEqual(file.read_text().count("<Piece "), 2)
        self.assertEqual(set(read(file)[1]["id"]), set(range(n)))


if __name__ == "__main__":
    unittest.main()
