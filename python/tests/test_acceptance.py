# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a certifier asks beside the verdict, each row beside a calculation by hand."""
import html
import math

import numpy as np
from synthetic import write_columns
from test_report import SCENE, SUMMARY, WithPage, leave_run

import caisson.report as report
from caisson.design import buckets, retrieval, sealing
from caisson.report import acceptance as shown
from caisson.results import Results
from caisson.verdict import acceptance, disturbed, limits, outcome
from caisson.verdict.installation import Installation, Rate

SKIRT = {**SCENE, "skirt_length_m": 7.0}
AREA = math.pi / 4 * 9.92**2  # 77.29 m2


def wall_rows(depth: float, net: float = 0.0) -> dict[str, np.ndarray]:
    """Return wall.csv of one frame at a depth (m): 5 kPa of horizontal stress at rest
    for each meter, twice that outside with another pressure (Pa), half of it inside,
    and a shear outside of a tenth of the stress at rest."""
    z = np.array([0.5, 1.5, 2.5, 3.5])
    rest, same = 5e3 * z, np.ones(4)
    columns = {
        "time_s": depth * same,
        "penetration_m": depth * same,
        "depth_m": z,
        "vertical_stress_at_rest_Pa": 2 * rest,
        "horizontal_stress_at_rest_Pa": rest,
    }
    for side, factor, more in (("inner", 0.5, 0.0), ("outer", 2.0, net)):
        columns[f"{side}_area_m2"] = 31.0 * same
        columns[f"{side}_normal_stress_Pa"] = factor * rest + more
        columns[f"{side}_shear_stress_Pa"] = 0.1 * rest
    return columns


class WithRun(WithPage):
    """Of a caisson of 10 m with a wall of 40 mm, a skirt of 7 m and 1 MN in sand of 9
    kN/m3: it rests at 1.5 m, and at 4.5 m it takes 30 kPa; the plug heaves by 5 % of
    the way."""

    def run_of(self, **entries: str) -> tuple[Results, Installation]:
        """Leave the run with entries of section Design, and return it with what is
        feasible."""
        given = {f"Design/{k.replace('_', ' ')}": v for k, v in entries.items()}
        leave_run(self.path, {**SUMMARY, "scene": SKIRT, "entries": given})
        write_columns(self.path / "wall.csv", wall_rows(4.0))
        run = Results(self.path)
        assert (found := outcome.whole_way(run)) is not None
        return run, found

    def says(self, words: str) -> None:
        """The page of the run that is there has these words."""
        self.assertTrue(words in self.words(), words)

    def words(self) -> str:
        """Return the words of the tables of the run that is there."""
        run = Results(self.path)
        assert (found := outcome.whole_way(run)) is not None
        tables = shown.tables_of(run, found, Rate()).values()
        cells = [
            c for table in tables if table for row in table["rows"] for c, _ in row
        ]
        return " ".join([*cells, *(table.get("note", "") for table in tables)])


class Rows(WithRun):
    """A row each."""

    def test_seal(self) -> None:
        """h/D = 0.15: a = 0.45 - 0.36 (1 - exp(-0.3125)) = 0.35338, so that 9 * 1.5 /
        0.64662 = 20.88 kPa are critical, with a gradient of 0.917; half of it by a
        factor of 2. 5 kPa times 2 = 9 h / (1 - a) at h = 0.6617 m: there a = 0.4037,
        and 9 * 0.6617 / 0.5963 = 9.99."""
        run, found = self.run_of(**{"Factor_on_piping": "2"})
        assert found.rest is not None
        self.assertAlmostEqual(found.rest, 1.5, delta=0.02)
        seal = acceptance.seal_of(run, found)
        assert seal is not None
        self.assertAlmostEqual(seal.allowed, 10.44, delta=0.1)
        self.assertAlmostEqual(seal.critical, 9000 / 9810, delta=1e-3)
        self.says("not given: Design/Suction at the start")
        self.says("at the allowed one, the mean exit gradient is 0.46")
        run, found = self.run_of(Factor_on_piping="2", Suction_at_the_start="5e3")
        seal = acceptance.seal_of(run, found)
        assert seal is not None
        self.assertAlmostEqual(seal.least, 0.6617, delta=0.01)
        # (1 - a) s / (9.81 h) = 0.6466 * 5 / 14.715
        self.assertAlmostEqual(seal.gradient, 0.2197, delta=3e-3)
        self.assertAlmostEqual(seal.path, 3.0, delta=0.04)
        words = "needs 0.66 m for a first suction of 5 kPa, and rests at 1.5"
        self.says(words)
        self.run_of(Suction_at_the_start="50e3")
        self.says("and rests at 1.50 m: margin -2.73 m, no seal")
        self.run_of(Suction_at_the_start="60e3")
        self.says("a first suction of 60 kPa is too much at 1.50 m")

    def test_grout(self) -> None:
        """7 - 4.5 - 0.225 + 0.025 m are free (the heave is counted from the mudline):
        2.275 m of 77.29 m2 are 175.8 m3, and a tilt of 0.5 degrees changes the gap by
        4.96 tan = 0.0433 m. h/D = 0.45: a = 0.45 - 0.36 (1 - exp(-0.9375)) = 0.2310,
        so that grout pipes outside at 9 * 4.5 / 0.2310 = 175.3 kPa, and the weight of
        1 MN is lifted by 12.94 kPa."""
        run, found = self.run_of(Largest_tilt="0.5")
        grout = acceptance.grout_of(run, found)
        assert grout is not None
        self.assertAlmostEqual(grout.gap, 7 - 4.5 - 0.225, delta=1e-3)
        self.assertAlmostEqual(grout.volume, 175.8, delta=0.2)
        self.assertAlmostEqual(grout.ends[0], 2.275 - 0.0433, delta=1e-3)
        self.assertAlmostEqual(grout.ends[1], 2.275 + 0.0433, delta=1e-3)
        pressures = grout.pressures
        self.assertEqual([*pressures][:2], [acceptance.LIFTED, retrieval.OUTWARD])
        self.assertAlmostEqual(pressures[retrieval.OUTWARD], 175.3, delta=0.3)
        self.assertAlmostEqual(pressures[acceptance.LIFTED], 12.94, delta=0.01)
        page = self.words()
        words = "176 m³ at 4.5 m, in a gap of 2.27 m, 2.23 m to 2.32 m"
        self.assertIn(words, page)
        words = "at most 12.9 kPa (the caisson is lifted); beyond that: piping outside"
        self.assertIn(words, page)

    def test_grout_in_clay(self) -> None:
        """Beside the tip the ground cracks at K0 sigma'_v + s_u: 0.5 * 9 * 4.5 + 10
        = 30.25 kPa, below the 38.8 kPa that lift 3 MN."""
        of_clay = {"friction_angle_deg": 0.0, "cohesion_Pa": 1e4}
        layers = [{**layer, **of_clay} for layer in SCENE["layers"]]
        scene = {**SKIRT, "layers": layers, "submerged_weight_N": 3e6}
        leave_run(self.path, {**SUMMARY, "scene": scene, "entries": {}})
        run = Results(self.path)
        assert (found := outcome.whole_way(run)) is not None
        grout = acceptance.grout_of(run, found)
        assert grout is not None
        depth = grout.depth
        crack = 0.5 * 9 * depth + 10
        self.assertAlmostEqual(grout.pressures[retrieval.FRACTURE], crack, delta=0.1)
        self.assertEqual(next(iter(grout.pressures)), retrieval.FRACTURE)

    def test_scour(self) -> None:
        """2 of 4.5 m; of the friction outside, 0.1 * 5 kPa * 31 m2 (0.5 + 1.5 + 2.5 +
        3.5) m, the upper two rows have 2 / 8."""
        run, found = self.run_of(Scour_depth="2")
        scour = acceptance.scour_of(run, found)
        self.assertEqual(scour, (2.0, 4.5, 2.5, 0.25))
        self.says("2.5 m of 4.5 m count as embedment")
        self.run_of()
        self.says("not given: Design/Scour depth")

    def test_ground(self) -> None:
        """Twice the stress at rest outside, half of it inside; no frame is there."""
        run, _ = self.run_of()
        effect = disturbed.disturbed_of(run, 4.5)
        assert effect is not None
        self.assertEqual(effect.walls, (0.5, 2.0))
        self.assertEqual((effect.voids, effect.depth), ({}, 4.0))
        self.assertIsNone(disturbed.disturbed_of(run, 3.0))
        self.says("normal stress 0.5 (inside) and 2 (outside) times")

    def test_load(self) -> None:
        """Suction is nearest to buckling at 4.5 m: 30 kPa on the lid, 1 MN + 30
        * 77.29 = 3319 kN on the wall. The frame at 4 m has 2 * 5 z and 3 kPa outside
        and 0.5 * 5 z inside, 10.5 kPa at 1 m, 14.5 less than its suction of 25 kPa: at
        a quarter of 4.5 m remain 15.5 kPa."""
        run, found = self.run_of()
        write_columns(self.path / "wall.csv", wall_rows(4.0, 3e3))
        load = acceptance.load_of(Results(self.path), found)
        assert load is not None
        self.assertEqual((load.depth, load.frames), (4.5, [4.0]))
        self.assertAlmostEqual(load.suction, 30, delta=0.1)
        self.assertAlmostEqual(load.axial, 3319, delta=5)
        along = {name: (z, p) for name, z, p in load.along}
        self.assertEqual(along["lid"][0], -2.5)
        self.assertEqual(along["1/4"][0], 1.125)
        self.assertAlmostEqual(along["1/4"][1], 15.5, delta=0.1)
        self.assertAlmostEqual(along["mudline"][1], 30, delta=0.1)
        self.says("pressures, from the frame at 4 m in wall_pressure.csv")

    def test_load_where_it_buckles(self) -> None:
        """Where the wall is nearest to buckling, not where the plug is nearest to its
        failure."""
        run, found = self.run_of()
        write_columns(self.path / "wall.csv", wall_rows(4.0, 3e3))
        found.required = np.linspace(0, 30, len(found.depth))
        found.limits = {limits.REVERSE_BEARING: np.linspace(60, 31, len(found.depth))}
        found.limits[limits.SHELL] = np.full(len(found.depth), 60.0)
        found.limits[limits.SHELL][1] = 1.2 * found.required[1]
        load = acceptance.load_of(Results(self.path), found)
        assert load is not None
        self.assertAlmostEqual(load.depth, found.depth[1])
        self.says("nearest to that which buckles the wall")

    def test_load_between_frames(self) -> None:
        """-2 and -4 kPa at the tip at 1 and 3 m: -2.5 at 1.5 m."""
        names = "penetration_m", "depth_m", "net_external_pressure_Pa", "suction_Pa"
        rows = [(1, 0, 9, 9), (1, 1, 7, 9), (3, 0, 9, 9), (3, 3, 5, 9)]
        table = dict(zip(names, np.array(rows, dtype=float).T))
        for name in names[2:]:
            table[name] *= 1e3
        more = acceptance.beyond_suction(table, 1.5)
        self.assertAlmostEqual(more[-1], -2.5)
        self.assertAlmostEqual(more[2], -1.25)

    def test_stop(self) -> None:
        """At 4.5 m of planned 6 m: 1 m of heave fills the skirt, and twice that
        computed is less. 0.01 m3/s, 36 m3/h, seep under the required suction, and more
        in proportion under the allowable one."""
        entries = {"Time/End penetration": "6"}
        leave_run(self.path, {**SUMMARY, "scene": SKIRT, "entries": entries})
        history = dict(Results(self.path).history)
        history["seepage_flow_m3_s"] = np.full(len(history["time_s"]), 0.01)
        write_columns(self.path / "history.csv", history)
        run = Results(self.path)
        assert (found := outcome.whole_way(run)) is not None
        stop = acceptance.stop_of(run, found, 6.0)
        self.assertAlmostEqual(stop.heave[2], 1.0)
        self.assertAlmostEqual(stop.heave[1], 0.225, delta=1e-3)
        self.assertAlmostEqual(stop.heave[0], 0.45, delta=1e-3)
        flow = 1.05 * AREA + 36
        self.assertAlmostEqual(stop.flow[1], flow, delta=0.2)
        more = found.allowable[-1] / found.required[-1] - 1
        self.assertGreater(more, 0.2)
        self.assertAlmostEqual(stop.flow[0], flow + 36 * more, delta=0.4)
        # from the depth of rest on
        self.assertEqual([depth for depth, *_ in stop.suctions], [1.5, 4.5])
        self.assertEqual(found.rest, 1.5)
        self.says("without a factor it is the limit itself, with no margin")
        self.says("tilt not given: Design/Largest tilt")

    def test_factors(self) -> None:
        """A factor that is given stands with its document; 1 by default on piping is
        said to be none."""
        self.run_of()
        page = self.words()
        self.assertTrue("a default and no design basis" in page)
        self.assertTrue("plug failure 1.5 suction of reverse bearing" in page)
        given = {"Factor_on_piping": "1.6", "Factor_on_pump": "1"}
        known = self.run_of(**given, Source_of_factors="Basis B, 2026")
        rows = {row[0][0]: row for row in shown.factors_of(*known)["rows"]}
        self.assertEqual(rows["piping"][1][0], "1.6")
        self.assertEqual(rows["piping"][3][0], "Basis B, 2026")
        self.assertEqual(rows["pump"][3][0], "Basis B, 2026")
        self.assertIn("default", rows["plug lift"][3][0])
        self.assertFalse("no design basis" in self.words())
        known = self.run_of(Factor_on_piping="1")
        rows = {row[0][0]: row for row in shown.factors_of(*known)["rows"]}
        self.assertIn("not given: Design/Source of factors", rows["piping"][3][0])

    def test_page(self) -> None:
        """All of it is on the page of the run, below its title."""
        self.run_of()
        page = html.unescape(report.write(self.path).read_text(encoding="utf-8"))
        text = page.split("<script")[0]
        self.assertRegex(text, r"<summary>For the certifier</summary>\s*<div")
        for words in ("a default and no design basis", "Stop, and ask the designer"):
            self.assertTrue(words in text, words)
        self.assertTrue('<td data-head="row">Seal</td>' in text)

    def test_jacked(self) -> None:
        """It has no suction that somebody would have to sign."""
        run, found = self.run_of()
        found.required = np.empty(0)
        self.assertEqual(shown.tables_of(run, found, Rate()), {})


class Levelness(WithRun):
    """Buckets at a distance of 20 m."""

    def test_differential(self) -> None:
        """R = 3319 kN at 4.5 m: 1.2 R of one and 0.9 R of another bucket differ by 0.3
        * 3319 / 77.29 = 12.9 kPa."""
        resistance = 1e6 + 30e3 * AREA
        self.assertAlmostEqual(resistance, 3318.7e3, delta=500)
        ends = [(0.9, 1.1), (0.8, 1.2), (0.95, 1.05)]
        found = buckets.differential(ends, resistance, 1e6, AREA)
        # 1.2 of the second over 0.9 of the first, or 1.1 of the first over 0.8
        self.assertAlmostEqual(found, 0.3 * resistance / AREA, delta=1)
        # a weak bucket that sinks by its weight takes no suction at all
        found = buckets.differential([(0.2, 1.0)] * 3, resistance, 1e6, AREA)
        self.assertAlmostEqual(found, 30e3, delta=1)

    def test_tilt_of_three(self) -> None:
        """Each bucket comes to P = k (R + R' d): one with k = 0.9 goes (1/0.9 - 1) R/R'
        = 0.1111 m deeper, two with 1.1 stay 0.0909 m higher; 0.2020 m over the height
        of the triangle, 17.32 m, are 0.668 degrees."""
        at = buckets.places(3, 20.0)
        self.assertAlmostEqual(math.dist(at[0], at[1]), 20)
        found = buckets.tilt(at, np.array([0.9, 1.1, 1.1]), 3e6, 3e6)
        by_hand = math.degrees(math.atan(0.20202 / 17.3205))
        self.assertAlmostEqual(found, by_hand, delta=1e-4)
        most = buckets.largest_tilt([(0.9, 1.1)] * 3, 20.0, 3e6, 3e6)
        self.assertAlmostEqual(most, by_hand, delta=1e-4)
        self.assertEqual(buckets.largest_tilt([(0.9, 1.1)] * 3, 20, 3e6, -1), math.inf)

    def test_tilt_of_four(self) -> None:
        """Two beside each other with 0.9, two with 1.1: every one meets its P in the
        plane, 0.2020 m over 20 m. With 0.9 and 1.1 at the ends of a diagonal, x =
        +-14.142 m, and R = R': 0 = sum k d = 4 a - 2.828 b, and 2.828 = sum (1 - k) x =
        sum k d x = 400 b - 2.828 a."""
        at = buckets.places(4, 20.0)
        self.assertAlmostEqual(math.dist(at[0], at[1]), 20)
        found = buckets.tilt(at, np.array([0.9, 0.9, 1.1, 1.1]), 3e6, 3e6)
        self.assertAlmostEqual(math.tan(math.radians(found)), 0.20202 / 20, delta=1e-6)
        found = buckets.tilt(at, np.array([0.9, 1.0, 1.1, 1.0]), 3e6, 3e6)
        slope = 2.8284 / (400 - 2.8284**2 / 4)
        self.assertAlmostEqual(math.tan(math.radians(found)), slope, delta=1e-6)

    def test_on_the_page(self) -> None:
        """R = 1 MN + 77.29 m2 10 kPa (h - 1.5): 772.9 kN/m, so that 10 % at 4.5 m tilt
        by 0.2020 * 3319 / 772.9 = 0.868 m over 17.32 m, 2.87 degrees, and 20 % of 3319
        kN are 8.59 kPa; what is lacking is named."""
        given = {"Number_of_buckets": "3", "Distance_of_buckets": "20"}
        run, found = self.run_of(**given, Spread_of_buckets="0.1", Largest_tilt="1")
        level = acceptance.level_of(run, found)
        assert level is not None
        self.assertAlmostEqual(level.differential[0], 8.59, delta=0.05)
        self.assertEqual(level.differential[1], 4.5)
        self.assertAlmostEqual(level.tilt[0], 2.87, delta=0.03)
        self.says("tilt it by up to 2.9° at 4.5 m, more than the allowed 1°")
        self.assertFalse("only to" in self.words())
        self.run_of(**given)
        self.says("not given: Design/Spread of buckets, nor runs of low and high")
        self.run_of(**given, Spread_of_buckets="0.1, 0.2")
        self.says("Design/Spread of buckets has 2 numbers, not 3")
        self.run_of(Number_of_buckets="4")
        self.says("not given: Design/Distance of buckets")
        self.run_of()
        self.assertFalse("Levelness" in self.words())

    def test_allowable_suction(self) -> None:
        """A pump of 32 kPa is enough for the 30 kPa at 4.5 m, but not for the bucket
        with 1.1 times the 3319 kN: (3651 - 1000) / 77.29 = 34.3 kPa; at 4 m it needs
        (1.1 * 2932 - 1000) / 77.29 = 28.8 kPa."""
        given = {"Number_of_buckets": "3", "Distance_of_buckets": "20"}
        self.run_of(**given, Spread_of_buckets="0.1")
        file = self.path / "run.json"
        text = file.read_text(encoding="utf-8")
        pump = '"entries": {"Water/Largest suction": "32e3", '
        file.write_text(text.replace('"entries": {', pump, 1), encoding="utf-8")
        self.says(
            "which is possible only to 4 m: at 4.5 m the strongest bucket needs 34.3"
            " kPa, and 32 kPa are allowed; one suction"
        )

    def test_low_and_high_resistance(self) -> None:
        """Runs with 0.8 and 1.3 times the resistance of 3319 kN at 4.5 m: (1.3 - 0.8)
        3319 / 77.29 = 21.5 kPa."""
        self.path = self.path / "own"
        given = {"Number_of_buckets": "3", "Distance_of_buckets": "20"}
        run, found = self.run_of(**given)
        for name, share in (("low", 0.8), ("high", 1.3)):
            history = dict(run.history)
            force = 1e6 + AREA * history["required_suction_Pa"]
            history["required_suction_Pa"] = (share * force - 1e6) / AREA
            beside = self.path.with_name(f"own_{name}")
            leave_run(beside, run.summary)
            write_columns(beside / "history.csv", history)
        level = acceptance.level_of(Results(self.path), found)
        assert level is not None
        self.assertTrue(level.of_band)
        self.assertAlmostEqual(level.ends[0][0], 0.8, delta=1e-3)
        self.assertAlmostEqual(level.differential[0], 21.5, delta=0.1)


class Formulas(WithPage):
    """What no run is needed for."""

    def test_least_embedment(self) -> None:
        depth = np.array([1.0, 2.0, 3.0])
        found = sealing.least_embedment(depth, 10 * depth, 15.0)
        self.assertAlmostEqual(found, 1.5)
        self.assertTrue(math.isnan(sealing.least_embedment(depth, 10 * depth, 31.0)))
        self.assertEqual(sealing.least_embedment(depth, 10 * depth, 5.0), 1.0)

    def test_grout_pressure(self) -> None:
        """18 kPa at h = 1 m with a = 0.5 are 9 kN/m3 over 0.5, inside as outside."""
        self.assertAlmostEqual(sealing.grout_pressure(18.0, 0.5), 18.0)
        self.assertAlmostEqual(sealing.grout_pressure(12.0, 0.25), 36.0)
