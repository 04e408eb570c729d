# SPDX-License-Identifier: LGPL-2.1-or-later
"""Springs of made-up runs with known curves."""
import contextlib
import csv
import io
import json
import math
import re
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
from made_up_state import Temporary

from caisson import __main__ as program
from caisson.verdict.loaded import load
from caisson.results import ResultsError, read_table
from caisson.export.springs import Springs, last_motion, segments_of, springs_of
from caisson.export.springs import wave_velocity

DIAMETER, WALL = 4.0, 0.1
RADII = {"inner": 1.9, "outer": 2.0}
HEIGHTS = (0.25, 0.75, 1.25, 1.75, 2.25)  # over the tip; the last one is in water
AREA_OF_TIP = math.pi * (2.0**2 - 1.9**2)
HALF = 4e-3  # m, at which half of the friction is mobilized


def ultimate(wall: str, depth: float) -> float:
    """Return the friction of the made-up soil (Pa)."""
    return (2e3 if wall == "inner" else 5e3) * depth


def mobilized(z: np.ndarray) -> np.ndarray:
    """Return the share of the friction that is mobilized."""
    return z / (HALF + z)


class MadeUp(Temporary):
    """Runs of a caisson at 2 m whose friction is a hyperbola of the displacement."""

    def write(
        self,
        name: str,
        direction: int,
        tip: float = 0.0,
        unloading: int = 0,
        **scene: Any,
    ) -> Path:
        """Write a run that rests, is unloaded by a tip stress over some records, and
        moves by 40 mm in the direction; return its directory."""
        path = self.path / name
        path.mkdir()
        # the ends of the records, and what is mobilized in their middle
        ends = np.concatenate([np.zeros(3), np.linspace(0, 0.2, 81)[1:] ** 2])
        middle = (ends[:-1] + ends[1:]) / 2
        begin = middle[2 + unloading] if unloading else 0.0
        z = np.maximum(middle - begin, 0.0)
        stress = np.interp(middle, [0, begin], [tip, 0.0]) if unloading else 0 * z
        rows, walls, time = [[0.0, 2.0, 0, 0, 0, 0, 0]], [], 0.1 * np.arange(len(ends))
        for i, share in enumerate(mobilized(z)):
            total = {"inner": 0.0, "outer": 0.0}
            depth_of_tip = 2.0 + direction * ends[i + 1]
            for height in HEIGHTS:
                row = [time[i + 1], depth_of_tip, depth_of_tip - height]
                for wall, radius in RADII.items():
                    area = 2 * math.pi * radius * 0.5
                    depth = 2.0 - height
                    shear = direction * share * max(0, ultimate(wall, depth))
                    row += [area, shear]
                    total[wall] += area * shear
                walls.append(row)
            q = stress[i] * AREA_OF_TIP
            rows.append(
                [
                    time[i + 1],
                    depth_of_tip,
                    q,
                    *total.values(),
                    0,
                    q + sum(total.values()),
                ]
            )
        self.table(path / "history.csv", HISTORY, rows)
        self.table(path / "wall.csv", WALLS, walls)
        summary = {"title": name, "status": "finished", "entries": {}}
        sizes = {"diameter_m": DIAMETER, "wall_thickness_m": WALL} | scene
        text = json.dumps(summary | {"scene": sizes})
        (path / "run.json").write_text(text, encoding="utf-8")
        return path

    @staticmethod
    def table(path: Path, names: list[str], rows: list[list[float]]) -> None:
        with path.open("w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([names, *rows])

    def setUp(self) -> None:
        super().setUp()
        self.without_pictures = self.enterContext(contextlib.ExitStack())
        draw = mock.patch("caisson.export.spring_files.draw")
        self.without_pictures.enter_context(draw)

    def export(self, *words: object) -> tuple[int, str]:
        """Return the status of the command, and what it prints."""
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            status = program.main(["export", "--overwrite", *map(str, words)])
        return status, out.getvalue()


LAYER = {
    "top_depth_m": 0,
    "submerged_unit_weight_N_m3": 9000.0,
    "youngs_modulus_Pa": 5e6,
}
HISTORY = ["time_s", "penetration_m", "tip_force_N", "inner_friction_N"]
HISTORY += ["outer_friction_N", "lid_force_N", "total_force_N"]
WALLS = ["time_s", "penetration_m", "depth_m", "inner_area_m2", "inner_shear_stress_Pa"]
WALLS += ["outer_area_m2", "outer_shear_stress_Pa"]


class Curves(MadeUp):
    """Resistance over displacement."""

    def assert_hyperbolas(self, found: Springs) -> None:
        """Ask for the made-up curves on both walls, at the nodes in the ground."""
        walls = [s for s in found.springs if s.place in RADII]
        self.assertEqual(len(walls), 8)
        for spring in walls:
            expected = ultimate(spring.place, spring.depth)
            curve = expected * mobilized(found.displacement)
            np.testing.assert_allclose(spring.resistance, curve, atol=0.01 * expected)

    def test_push_and_pull(self) -> None:
        for direction in (1, -1):
            found = springs_of(load(self.write(f"run{direction}", direction)), 0.0)
            self.assertEqual(found.direction, direction)
            self.assert_hyperbolas(found)
            of_body = sum(s.area * s.resistance for s in found.springs)
            np.testing.assert_allclose(found.force, of_body, rtol=1e-6, atol=1)
            first = sum(s.area * ultimate(s.place, s.depth) for s in found.springs)
            stiffness = found.stiffness(1e-3)
            self.assertLess(abs(stiffness / (first / (HALF + 4e-3)) - 1), 0.01)
            self.assertTrue(math.isnan(found.stiffness(0.1)))

    def test_unloading_does_not_count(self) -> None:
        """The displacement begins where the forces of the soil are the weight."""
        found = springs_of(load(self.write("pull", -1, 5e5, 20)), 0.0)
        self.assert_hyperbolas(found)
        self.assertAlmostEqual(found.depth, 2.0 - 2.5e-3, delta=3e-4)
        self.assertEqual(found.missing, 0.0)
        weight = 0.25 * 5e5 * AREA_OF_TIP
        earlier = springs_of(load(self.path / "pull"), weight)
        self.assertGreater(earlier.depth, found.depth + 5e-4)
        (tip,) = [s for s in earlier.springs if s.place == "tip"]
        self.assertAlmostEqual(tip.before / 1.25e5, 1.0, delta=0.01)
        self.assertAlmostEqual(tip.ultimate / 1.25e5, 1.0, delta=0.01)

    def test_last_motion(self) -> None:
        for depths, expected in (
            ([0, 1, 2], (0, 1)),
            ([0, 1, 1, 0.5, 0.2, 0.2], (2, -1)),
            ([0, 1, 0.5, 0.7], (2, 1)),
        ):
            self.assertEqual(last_motion(np.array(depths, dtype=float)), expected)


class Files(MadeUp):
    """The command."""

    def test_table(self) -> None:
        """It has the curves, and those of another run beside them, and a picture."""
        self.without_pictures.close()
        path, other = self.write("one", -1), self.write("other", -1)
        status, text = self.export(path, "--to", "tz", "--beside", other)
        self.assertEqual(status, 0, text)
        self.assertIn("Pulled by 39.", text)
        self.assertIn("Secant stiffness at 4 mm (0.1 % of the diameter)", text)
        self.assertNotIn("WARNING", text)
        self.assertGreater((path / "springs.png").stat().st_size, 10_000)
        with (path / "springs.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if line[0] != "#"))
        outer = [r for r in rows if r["place"] == "outer" and r["depth_m"] == "1.75"]
        self.assertGreater(len(outer), 20)
        z, t, beside, over = [
            np.array([float(r[name]) for r in outer])
            for name in (
                "displacement_mm",
                "resistance_kPa",
                "beside_resistance_kPa",
                "resistance_over_ultimate",
            )
        ]
        np.testing.assert_allclose(t, 8.75 * mobilized(z / 1e3), atol=0.01)
        np.testing.assert_allclose(beside, t, atol=1e-3)
        self.assertEqual((z[0], over[-1]), (0, 1))
        self.assertEqual(read_table(path / "wall.csv").keys(), set(WALLS))

    def test_parts(self) -> None:
        """What the springs cover: four nodes of 0.5 m below the ground."""
        said = self.export(self.write("one", 1), "--to", "tz")[1]
        for wall, radius in RADII.items():
            area = 2 * math.pi * radius * 2
            words = (
                f"4 on {area:.4g} of the {area:.4g} m2 of the {wall} wall, with mean"
            )
            self.assertIn(words, said)

    def test_beside_another_motion(self) -> None:
        """A pull is not compared with a push, and another depth is reported."""
        pull, push = self.write("pull", -1), self.write("push", 1)
        status, text = self.export(pull, "--to", "tz", "--beside", push)
        self.assertEqual(status, 1)
        self.assertRegex(text, "is pulled in .*pull and pushed in .*push: --beside")
        deeper = self.write("deeper", -1)
        for depth, is_reported in ((2.05, False), (2.1, True)):
            rows = [line.split(",") for line in self.lines(deeper / "history.csv")]
            shift = depth - float(rows[1][1])
            for row in rows[1:]:
                row[1] = repr(float(row[1]) + shift)
            text = "\n".join(map(",".join, rows))
            (deeper / "history.csv").write_text(text, encoding="utf-8")
            text = self.export(pull, "--to", "tz", "--beside", deeper)[1]
            self.assertEqual("the tips are at 2 m and" in text, is_reported, text)

    @staticmethod
    def lines(path: Path) -> list[str]:
        """Return the lines of a file."""
        return path.read_text(encoding="utf-8").splitlines()

    def test_a_motion_that_is_too_short(self) -> None:
        """The largest resistance of a hyperbola is no ultimate where it ends at twice
        the displacement of half of it."""
        path = self.write("one", -1)
        said = self.export(path, "--to", "tz")[1]
        self.assertNotIn("still grows", said)
        rows = self.lines(path / "history.csv")
        ends = [2.0 - float(row.split(",")[1]) for row in rows[1:]]
        n = sum(end < 2 * HALF for end in ends)
        (path / "history.csv").write_text("\n".join(rows[: n + 1]), encoding="utf-8")
        found = springs_of(load(path), 0.0)
        last = found.displacement[-1]
        growth = 1 - mobilized(0.9 * last) / mobilized(last)
        self.assertAlmostEqual(found.growth, growth, delta=3e-3)
        said = self.export(path, "--to", "tz")[1]
        self.assertIn("WARNING: the resistance still grows at the end", said)

    def test_refusals(self) -> None:
        """Each says what to do."""
        path = self.write("one", 1)
        for words, expected in (
            ("tz --spacing 1", "--spacing is not for --to tz"),
            ("csv --weight 3kN", "--weight is for --to tz"),
            ("tz --weight 9MN", "does not pass its weight"),
        ):
            status, text = self.export(path, "--to", *words.split())
            self.assertEqual(status, 1)
            self.assertIn(expected, text)
        rows = (path / "wall.csv").read_text(encoding="utf-8").splitlines()
        (path / "wall.csv").write_text("\n".join(rows[:30]), encoding="utf-8")
        self.assertIn("Walls at each record=true", self.export(path, "--to", "tz")[1])
        (path / "wall.csv").unlink()
        self.assertIn("no wall.csv", self.export(path, "--to", "tz")[1])
        with self.assertRaisesRegex(ResultsError, "does not move"):
            last_motion(np.zeros(4))

    def test_water(self) -> None:
        """A part of the force is no answer."""
        path = self.write("pull", -1)
        text = (path / "history.csv").read_text(encoding="utf-8").splitlines()
        text = [f"{text[0]},suction_force_N", *(f"{row},5e4" for row in text[1:])]
        (path / "history.csv").write_text("\n".join(text), encoding="utf-8")
        self.assertIn("Take a drained run", self.export(path, "--to", "tz")[1])

    def test_waves(self) -> None:
        """Heavy soil resists the first millimeter by its inertia. By hand: the motion
        of (t / 8 s)2 times 40 mm is 0.4 mm at 0.8 s, and at most 9.94 mm/s fast."""
        stiff = 5e6 / 2.6
        influence = 2.5 * 2 * 0.7
        needed = 2 * ((1 + influence / 2) ** (1 / 1.1) - 1)
        for name, value, share in (
            ("Inertia tolerance", 0.4, 0.4 * 2 * 9e3 / 0.00994**2),
            ("Inertia tolerance", 5e-4, 5e-4 * 2 * 9e3 / 0.00994**2),
            ("Inertia tolerance", 2e-3, 2e-3 * 2 * 9e3 / 0.03**2),
            ("Mass scaling", 900, 900 * (9e3 / 9.81 + 1000)),
            ("Mass scaling", 1, 9e3 / 9.81 + 1000),
        ):
            path = self.write(f"{name} {value}", -1, layers=[LAYER])
            summary = json.loads((path / "run.json").read_text(encoding="utf-8"))
            summary["entries"] = {f"Time/{name}": str(value)}
            if value == 2e-3:  # the run ends before it reaches this speed
                summary["entries"]["Rigid body/Velocity table"] = "0:0, 24:-0.03"
            (path / "run.json").write_text(json.dumps(summary), encoding="utf-8")
            reach = math.sqrt(stiff / share) * 0.8
            found = springs_of(load(path), 0.0)
            self.assertAlmostEqual(found.needed_reach / needed, 1, delta=0.01)
            self.assertAlmostEqual(found.reach_at_first / reach, 1, delta=0.15)
            said = self.export(path, "--to", "tz")[1]
            self.assertEqual("a shear wave has gone" in said, reach < needed, said)
            if reach < needed:
                far = 40 * (0.8 * needed / reach / 8) ** 2
                pattern = r"the (?:whole curve|curve below ([\d.]+) mm) contains its"
                end = re.search(pattern, said)
                assert end is not None, said
                if far < 40:
                    self.assertAlmostEqual(float(end[1]) / far, 1, delta=0.1)
                else:
                    self.assertIsNone(end[1])
                self.assertIn(f" by {(reach / needed) ** 2:.1g}, or move", said)

    def test_waves_of_other_laws(self) -> None:
        """The modulus is that of the law; without one, the check is not possible. By
        hand: NGI-ADP has G = 100 x 20 kPa, and a user material that of its p-wave
        modulus."""
        clay: dict[str, Any] = {key: LAYER[key] for key in list(LAYER)[:2]}
        listed = [{"entry": "Poisson ratio", "value": 0.45}]
        ngi: dict[str, Any] = {**clay, "law": "NGI-ADP", "law_entries": listed}
        ngi["youngs_modulus_Pa"] = 2 * 1.45 * 2e6
        user: dict[str, Any] = {**clay, "law": "user material", "poisson_ratio": 0.4}
        user["p_wave_modulus_Pa"] = 6 * 2e6  # of G = 2 MPa
        density = 9e3 / 9.81 + 1000
        for name, layer in (("ngi", ngi), ("user", user)):
            path = self.write(name, -1, layers=[layer])
            found = wave_velocity(load(path), 2.0)
            self.assertAlmostEqual(found / math.sqrt(2e6 / density), 1, places=6)
        path = self.write("none", -1, layers=[{**clay, "law": "hypoplastic"}])
        said = self.export(path, "--to", "tz")[1]
        self.assertIn("a layer above the tip has a law without a Young's modulus", said)

    def test_no_weight(self) -> None:
        """It is not a weight of 0 kN."""
        path = self.write("pull", -1)
        self.assertIn(
            "no submerged weight is given", self.export(path, "--to", "tz")[1]
        )
        said = self.export(path, "--to", "tz", "--weight", "1kN")[1]
        self.assertIn("bears the submerged weight of 1 kN", said)

    def test_a_load_that_is_missing(self) -> None:
        """The run begins where the soil bears less than the weight."""
        status, text = self.export(
            self.write("pull", -1), "--to", "tz", "--weight=50kN"
        )
        self.assertEqual(status, 0, text)
        self.assertIn("WARNING: at the beginning the soil bears 50", text)
        self.assertIn("from 2 m, where the motion begins.", text)
        self.assertNotIn("bears the submerged weight", text)


class Segments(unittest.TestCase):
    """The parts of a wall."""

    def test_means_by_area(self) -> None:
        """Of two nodes of 1 and 3 m2 in the lowest eighth of a wall of 8 m."""
        walls = {
            "time_s": np.zeros(2),
            "penetration_m": np.full(2, 8.0),
            "depth_m": np.array([7.2, 7.6]),
        }
        for wall, stress in (("inner", (10.0, 20.0)), ("outer", (0.0, 4.0))):
            walls[f"{wall}_area_m2"] = np.array([1.0, 3.0])
            walls[f"{wall}_shear_stress_Pa"] = np.array(stress)
        means = {"inner": 17.5, "outer": 3.0}
        found = segments_of(walls, np.zeros(1), 8.0)
        self.assertEqual([part[0] for part in found], list(means))
        for wall, depth, area, shear in found:
            self.assertAlmostEqual(depth, 7.5)
            self.assertAlmostEqual(area, 4.0)
            self.assertAlmostEqual(float(shear[0]), means[wall])


if __name__ == "__main__":
    unittest.main()
