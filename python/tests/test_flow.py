# SPDX-License-Identifier: LGPL-2.1-or-later
"""Flow lines of fields with known ones, and pore_pressure.png."""
import json
import shutil
import tempfile
import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np

from caisson import disk, plot
from caisson.plot import fields, pore_pressure
from caisson.plot.cells import CellMeans
from caisson.plot.flow import Flow
from caisson.plot.pore_pressure import style_of
from caisson.results import Results

disk.DPI = 40  # of pictures, at which nobody looks
TINY = Path(__file__).resolve().parent / "tiny_run"
SIZE, RADIUS, DEPTH = 0.125, 4.0, 3.0  # m
N, LEVEL = 8, -1.0
UNDRAINED, SEEPAGE = {"Water/Level": "undrained"}, {"Water/Level": "seepage"}


def soil(points: int = 2, plane: bool = False) -> CellMeans:
    """Return square cells with points * points points in each, from the axis to RADIUS
    and from z = -DEPTH to 0; plane: in plane strain."""
    r, z = np.meshgrid(np.arange(0, RADIUS, SIZE), np.arange(-DEPTH, 0, SIZE))
    lower = np.column_stack([r.ravel(), z.ravel()])
    corners = lower[:, None] + SIZE * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    share = (np.arange(points) + 0.5) / points
    places = SIZE * np.stack(np.meshgrid(share, share), axis=-1).reshape(-1, 2)
    position = (lower[:, None] + places).reshape(-1, 2)
    length = np.ones(len(position)) if plane else 2 * np.pi * position[:, 0]
    volume = length * (SIZE / points) ** 2
    rigid = np.zeros(len(corners), dtype=bool)
    return CellMeans(position, volume, corners, rigid, not plane)


class Gradients(unittest.TestCase):
    """The affine fit in a cell."""

    def test_affine_field_is_exact(self) -> None:
        means = soil()
        r, z = means.position.T
        found = means.gradients(7 + 3 * r - 5 * z)
        np.testing.assert_allclose(found, np.tile([3, -5], (len(found), 1)), atol=1e-8)

    def test_one_point_tells_none(self) -> None:
        means = soil(points=1)
        self.assertTrue(np.isnan(means.gradients(means.position[:, 0])).all())


class Lines(unittest.TestCase):
    """Lines and the water between them."""

    def test_uniform_upward_flow(self) -> None:
        means = soil()
        flow = Flow(means, -2.0 * means.position[:, 1])
        np.testing.assert_allclose(
            flow.at(np.array([[1.3, -2]]))[0], [[0, 2]], atol=1e-9
        )
        lines = flow.lines(flow.starts(N, LEVEL, RADIUS))
        self.assertEqual(len(lines), N)
        for i, line in enumerate(lines):
            wanted = RADIUS * np.sqrt((i + 0.5) / N)  # rings of the same area
            np.testing.assert_allclose(line[:, 0], wanted, atol=SIZE / 50)
            np.testing.assert_allclose(line[:, 0], line[0, 0], atol=1e-6)
            self.assertLess(line[0, 1], -DEPTH + SIZE, "comes from the bottom")
            self.assertGreater(line[-1, 1], -SIZE, "goes to the mudline")

    def test_plane_strain(self) -> None:
        means = soil(plane=True)
        starts = Flow(means, -2.0 * means.position[:, 1]).starts(N, LEVEL, RADIUS)
        wanted = RADIUS * (np.arange(N) + 0.5) / N
        np.testing.assert_allclose(starts[:, 0], wanted, atol=SIZE / 50)

    def test_downward_flow(self) -> None:
        means = soil()
        flow = Flow(means, 2.0 * means.position[:, 1])
        line = flow.lines(flow.starts(N, LEVEL, RADIUS))[0]
        self.assertGreater(line[0, 1], line[-1, 1])

    def test_radial_flow_has_no_line_that_rises(self) -> None:
        means = soil()
        flow = Flow(means, -np.log(means.position[:, 0]))
        lines = flow.lines(np.array([[1.0, LEVEL]]))
        np.testing.assert_allclose(lines[0][:, 1], LEVEL, atol=1e-6)
        self.assertGreater(np.ptp(lines[0][:, 0]), RADIUS - 3 * SIZE)
        self.assertTrue((np.diff(lines[0][:, 0]) > 0).all(), "outward")
        self.assertLess(abs(flow.at(np.array([[2.0, LEVEL]]))[0][0, 0] - 0.5), 0.005)

    def test_stream_function(self) -> None:
        """p = 2 z^2 - r^2 has the stream function -2 z r^2."""
        means = soil()
        r, z = means.position.T
        flow = Flow(means, 2 * z**2 - r**2)
        found = flow.at(np.array([[1.26, -1.01], [1.36, -1.11]]))[0]
        wanted = [[2.52, 4.04], [2.72, 4.44]]
        np.testing.assert_allclose(found, wanted, rtol=3e-3)
        lines = flow.lines(flow.starts(N, LEVEL, RADIUS))
        total = -2 * LEVEL * RADIUS**2
        for i, line in enumerate(lines):
            psi = -2 * line[:, 1] * line[:, 0] ** 2
            well = (line[:, 1] < -2 * SIZE) & (line[:, 0] > 2 * SIZE)
            np.testing.assert_allclose(psi[well], (i + 0.5) / N * total, rtol=0.02)
            self.assertLess(np.ptp(psi[well]), 0.02 * total)

    def test_lines_end_where_no_pressure_is_known(self) -> None:
        """In clay by total stress there is none, above z = -2 here."""
        means = soil()
        z = means.position[:, 1]
        flow = Flow(means, np.where(z < -2, -2.0 * z, np.nan))
        lines = flow.lines(flow.starts(N, -2.5, RADIUS))
        self.assertEqual(len(lines), N)
        self.assertLess(max(line[:, 1].max() for line in lines), -2 + SIZE / 100)
        self.assertEqual(len(flow.starts(N, LEVEL, RADIUS)), 0)

    def test_no_flow_has_no_lines(self) -> None:
        means = soil()
        flow = Flow(means, np.zeros(len(means.position)))
        starts = flow.starts(N, LEVEL, RADIUS)
        self.assertEqual((len(starts), flow.lines(starts)), (0, []))

    def test_skirt_parts_the_mudline(self) -> None:
        full = soil()
        middle = full.polygons.mean(axis=1)
        skirt = (abs(middle[:, 0] - 2.125) < 0.125) & (middle[:, 1] > -1.5)
        means = CellMeans(full.position, full.volume, full.polygons, skirt)
        flow = Flow(means, -2.0 * means.position[:, 1])
        inner, outer = flow.mudline(full.polygons[skirt])
        self.assertTrue(1.9 < inner[:, 0].max() < 2.0)
        self.assertTrue(2.25 < outer[:, 0].min() < 2.35)
        np.testing.assert_allclose(inner[:, 1], 0, atol=1e-9)
        places = np.array([[2.1, -1.0], [2.1, -2.0], [1.9, -1.0], [1.9, 0.1]])
        outside = np.isnan(flow.at(places)[0][:, 1])
        self.assertEqual(list(outside), [True, False, False, True])


class Picture(unittest.TestCase):
    """pore_pressure.png of the stored tiny run."""

    def test_colors(self) -> None:
        for low, high, expected in (
            (-9.4, 0.0, (-10, 0)),
            (-0.01, 12.9, (0, 15)),
            (-3.4, 12.9, (-4, 15)),
        ):
            style = style_of(low, high)
            self.assertEqual((style["vmin"], style["vmax"]), expected)
            low, high = expected
            white = style["cmap"](-low / (high - low))
            self.assertGreater(min(white[:3]), 0.93, "white is 0")

    def run_with_pressure(self) -> Path:
        """Return a copy of the run, with deviators as pore pressures."""
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        path = Path(shutil.copytree(TINY, Path(temporary.name) / "run"))
        for file in path.glob("points_*.vtu"):
            text = file.read_text(encoding="utf-8")
            file.write_text(text.replace('"deviator_Pa"', '"pore_pressure_Pa"'))
        return path

    def test_drawn_where_points_have_the_field(self) -> None:
        path = self.run_with_pressure()
        with mock.patch("builtins.print"):
            pictures = plot.draw(path)
        self.assertIn("pore_pressure.png", [picture.name for picture in pictures])
        self.assertGreater((path / "pore_pressure.png").stat().st_size, 10_000)

    def test_lines_where_water_flows(self) -> None:
        """Undrained soil has pressures, but no flow: no solver has found one."""
        path = self.run_with_pressure()
        table = path / "history.csv"
        rows = table.read_text(encoding="utf-8").splitlines()
        ends = [",flow_iterations"] + [",1"] * (len(rows) - 1)
        flowing = "".join(f"{row}{end}\n" for row, end in zip(rows, ends))
        name = "caisson.plot.pore_pressure.draw_flow"
        with mock.patch(name) as draw_flow:
            self.assertIsNotNone(self.draw(path))
            self.assertEqual(draw_flow.call_count, 0)
            table.write_text(flowing, encoding="utf-8")
            self.change(path, lambda known: known["entries"].update(UNDRAINED))
            self.assertIsNotNone(self.draw(path))
            self.assertEqual(draw_flow.call_count, 0, "suction on undrained water")
            self.change(path, lambda known: known["entries"].update(SEEPAGE))
            self.assertIsNotNone(self.draw(path))
            self.assertGreater(draw_flow.call_count, 0)

    def draw(self, path: Path) -> Path | None:
        """Draw this picture alone; return it, if there is one."""
        run = Results(path)
        frames = fields.frames_of(run)
        window = fields.window_of(frames[0], frames[-1], run.scene)
        return pore_pressure.draw(run, frames, window)

    def change(self, path: Path, how: Callable[[dict[str, Any]], None]) -> None:
        """Change what run.json of a run knows."""
        file = path / "run.json"
        known = json.loads(file.read_text(encoding="utf-8"))
        how(known)
        file.write_text(json.dumps(known), encoding="utf-8")

    def test_total_stress_has_no_picture(self) -> None:
        """Nor has it a pressure, whatever the frames of an earlier version say."""
        path = self.run_with_pressure()
        self.change(
            path, lambda known: known["scene"]["layers"][0].update(total_stress=True)
        )
        self.assertIsNone(self.draw(path))
        scene = Results(path).scene
        self.assertIn("total stress", fields.stress_in_words(scene, "vertical"))


if __name__ == "__main__":
    unittest.main()
