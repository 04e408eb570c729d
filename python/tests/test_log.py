# SPDX-License-Identifier: LGPL-2.1-or-later
"""The log of a vessel beside made-up runs: what it says, and how often it is right."""
import csv
import tempfile
import unittest
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from synthetic import write_run

import caisson
from caisson import vessel_log
from caisson.disk import InputError
from caisson.vessel_log import (
    expected,
    forecast,
    measured,
    picture,
    sheet,
    steps,
    words,
)
from caisson.results import Results

WEIGHT, DIAMETER, WALL, END = 1.5e6, 8.0, 0.03, 9.0
AREA = np.pi / 4 * (DIAMETER - 2 * WALL) ** 2
DEPTH = np.linspace(0.5, END, 400)
TIP, FRICTION = 2.5e5 * DEPTH, 0.9e5 * DEPTH**2
BEST = TIP + FRICTION  # N
HALF = 0.25  # of the band, as a logarithm
BOILING = 2.5e5
SCENE: dict[str, Any] = {
    "diameter_m": DIAMETER,
    "wall_thickness_m": WALL,
    "skirt_length_m": END + 1,
    "layers": [],
    "submerged_weight_N": WEIGHT,
}


def history_of(force: np.ndarray, boiling: float = BOILING) -> dict[str, np.ndarray]:
    """Return history.csv of a resistance (N) at DEPTH."""
    required = (force - WEIGHT) / AREA
    return {
        "time_s": DEPTH,
        "penetration_m": DEPTH,
        "tip_force_N": 0.3 * force,
        "inner_friction_N": 0.3 * force,
        "outer_friction_N": 0.4 * force,
        "total_force_N": force,
        "suction_Pa": np.maximum(required, 0),
        "required_suction_Pa": required,
        "cavitation_suction_Pa": np.full(len(DEPTH), boiling),
        "plug_heave_m": 0.02 * DEPTH,
    }


class Vessel(unittest.TestCase):
    """A run with its band, and logs of hidden soils."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        self.own = self.path / "own"
        self.file = self.path / "measured.csv"

    def write_runs(self, half: float = HALF, boiling: float = BOILING) -> None:
        """Write the best estimate and, with a half width, its band."""
        names = {"": 0.0, "_low": -half, "_high": half} if half else {"": 0.0}
        for name, change in names.items():
            entries = {"Time/End penetration": f"{END:g}"}
            entries["Design/Steel yield strength"] = "1e12"  # water boils first
            entries["Design/Steel Youngs modulus"] = "1e13"
            entries["Design/Largest tilt"] = "0.5"
            summary = {"title": "made up", "scene": SCENE, "entries": entries}
            history = history_of(BEST * np.exp(change), boiling)
            write_run(self.path / f"own{name}", history, summary)

    def write_log(self, force: np.ndarray, last: float, seed: int = 1) -> None:
        """Write the log of a resistance (N) at DEPTH down to a depth: noise, a gap, a
        stop, a spike, and rows that are repeated and out of order."""
        rng = np.random.default_rng(seed)
        depth = np.arange(0.6, last, 0.01)
        stop = 0.6 * last
        depth = depth[np.abs(depth - 0.8 * last) > 0.15]  # the gap
        rest = np.full(300, stop)
        depth = np.sort(np.concatenate([depth, rest]))
        suction = np.maximum(np.interp(depth, DEPTH, force) - WEIGHT, 0) / AREA / 1e3
        suction *= 1 + rng.uniform(0.03, 0.05) * rng.normal(size=len(depth))
        suction[depth == stop] *= 0.4
        suction[len(depth) // 2] *= 8
        noisy = depth + 0.01 * rng.normal(size=len(depth))
        rows = [
            f"{10 * i},{d:.4f},{s:.4f},20,{0.1 * d:.3f}"
            for i, (d, s) in enumerate(zip(noisy, suction))
        ]
        rows[50], rows[70] = rows[70], rows[50]
        rows += rows[100:120]
        head = "time_s,depth_m,suction_kPa,flow_m3/h,tilt_deg"
        self.file.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")

    def answer(self) -> tuple[Any, forecast.Bins, forecast.Forecast]:
        """Return what runs and log come to."""
        found = expected.expected_of(Results(self.own))
        log = measured.read(self.file)
        bins = steps.bins_of(self.file, log, found)
        weight = steps.weight_of(log, found)
        return found, bins, forecast.forecast_of(found, bins, weight)

    def test_soil_between_the_runs(self) -> None:
        """The factor is found in spite of noise, gap, stop and spike."""
        self.write_runs()
        for factor in (0.85, 1.0, 1.15):
            self.write_log(factor * BEST, 6.0)
            found, bins, ahead = self.answer()
            fit = forecast.fit_of(found, bins)
            self.assertAlmostEqual(fit.factor[0], factor, delta=0.02)
            self.assertLess(fit.factor[1], factor)
            self.assertGreater(fit.factor[2], factor)
            self.assertAlmostEqual(fit.share[0], np.log(factor) / HALF, delta=0.1)
            self.assertIn("within the band, down to 5.9", words.of_band(found, bins))
            true = (factor * BEST[-1] - WEIGHT) / AREA / 1e3
            self.assertLess(ahead.low[-1], true)
            self.assertGreater(ahead.high[-1], true)

    def test_function(self) -> None:
        """caisson.compare_log() says what the command prints."""
        self.write_runs()
        self.write_log(BEST, 6.0)
        said = caisson.compare_log(self.own, self.file)
        self.assertEqual(said, vessel_log.answer_of(self.own, self.file).said)
        self.assertIn("within the band", " ".join(said))

    def test_soil_outside(self) -> None:
        """It is said where the log leaves the band, also in the soil of a layer."""
        self.write_runs()
        layered = BEST * np.where(DEPTH > 4, 1.6, 1.0)
        self.write_log(layered, 6.0)
        found, bins, ahead = self.answer()
        self.assertRegex(
            words.of_band(found, bins), r"from 4(\.[01])? m on above the high estimate"
        )
        self.write_log(BEST / 1.6, 6.0)
        found, bins, ahead = self.answer()
        self.assertIn("below the low estimate", words.of_band(found, bins))
        true = (BEST[-1] / 1.6 - WEIGHT) / AREA / 1e3
        self.assertLess(ahead.low[-1], true)
        self.assertGreater(ahead.high[-1], true)

    def test_refusal(self) -> None:
        """Where the allowable suction is reached, as a range of depths."""
        boiling = (BEST[300] - WEIGHT) / AREA
        self.write_runs(boiling=boiling)
        self.write_log(BEST, 5.0)
        found, bins, ahead = self.answer()
        first, middle, last = words.outcome_of(found, ahead)
        assert first and middle and last
        self.assertLess(first, DEPTH[300])
        self.assertGreater(last, DEPTH[300])
        self.assertAlmostEqual(middle, DEPTH[300], delta=0.15)
        said = words.of_forecast(found, ahead)
        self.assertRegex(said, r"refusal between 6.* and 8.* m, most likely at 6\.9 m")

    def test_above_the_allowable(self) -> None:
        """It is said from where on the measured suction was more than allowed, and
        nothing of a refusal where the log ends with that."""
        self.write_runs(boiling=(BEST[300] - WEIGHT) / AREA)
        for last, wanted in ((5.0, "^$"), (8.0, r"from (6\.[5-9]|7) m on")):
            self.write_log(BEST, last)
            found, bins, ahead = self.answer()
            log = measured.read(self.file)
            self.assertRegex(words.of_allowable(found, log), wanted)
        said = words.no_forecast(found, log)
        self.assertRegex(said, r"^No forecast: already at (7\.9|8) m, where the log")

    def test_nine_of_ten(self) -> None:
        """The band of the forecast holds, over all of its way, in nine of ten soils of
        layers, waves, trends and jumps, of which the band of the runs is nine in ten.
        """
        self.write_runs()
        inside = [self.stays_inside(seed) for seed in range(20)]
        for first in (0, 10):
            self.assertGreaterEqual(sum(inside[first : first + 10]), 9, inside)

    def stays_inside(self, seed: int) -> bool:
        """Return whether a hidden soil stays within the band of its forecast."""
        rng = np.random.default_rng(seed)
        force = hidden(rng, seed % 5)
        self.write_log(force, rng.uniform(4.5, 7.5), seed)
        _, _, ahead = self.answer()
        true = np.maximum(np.interp(ahead.depth, DEPTH, force) - WEIGHT, 0) / AREA / 1e3
        return bool(np.all((true >= ahead.low) & (true <= ahead.high)))

    def test_without_a_band(self) -> None:
        self.write_runs(half=0.0)
        self.write_log(1.1 * BEST, 6.0)
        found, _, ahead = self.answer()
        self.assertIn("20 % to either side (ASSUMED)", found.source)
        self.assertGreater(ahead.high[-1], ahead.best[-1])

    def test_spikes(self) -> None:
        """Two readings of 9.99 bar in a log are named, and nothing else is left out:
        the line still begins with the first reading."""
        self.write_runs()
        depth = np.arange(3.0, 6.0, 0.02)
        suction = (np.interp(depth, DEPTH, BEST) - WEIGHT) / AREA / 1e3
        suction = np.maximum(suction, 0)
        begin = float(depth[np.argmax(suction > 8.0)])
        suction[[100, 130]] = 999.0
        rows = [
            f"{20 * i},{d:.2f},{s:.3f}" for i, (d, s) in enumerate(zip(depth, suction))
        ]
        text = "\n".join(["time_s,depth_m,suction_kPa", *rows])
        self.file.write_text(text, encoding="utf-8")
        said = caisson.compare_log(self.own, self.file)
        found, bins, _ = self.answer()
        self.assertLess(bins.depth[0], begin)
        self.assertAlmostEqual(forecast.fit_of(found, bins).factor[0], 1, delta=0.01)
        text = "2 spikes of suction are left out: 999 kPa at 5 m, 999 kPa at 5.6 m."
        self.assertIn(text, said)
        self.assertIn(text, (self.own / "vessel.html").read_text(encoding="utf-8"))

    def test_extrapolated(self) -> None:
        """What lies below the end of the runs of low and high is named as such in the
        forecast, the page and the tables, and drawn dashed."""
        self.write_runs()
        for name, rows in (("low", 250), ("high", 300)):
            change = HALF if name == "high" else -HALF
            history = history_of(BEST * np.exp(change))
            cut = {key: values[:rows] for key, values in history.items()}
            write_run(self.path / f"own_{name}", cut, Results(self.own).summary)
        self.write_log(BEST, 5.0)
        said = caisson.compare_log(self.own, self.file)
        text = "This rests on extrapolation: low from 5.8 m on and high from 6.86 m on."
        self.assertIn(text, said[0])
        page = (self.own / "vessel.html").read_text(encoding="utf-8")
        self.assertEqual(page.count("low from 5.8 m on and high from 6.86 m on"), 2)
        sheet.write(self.own)
        for name, depth, lines in (
            ("vessel.csv", "9", "low high"),
            ("vessel.csv", "6.5", "low"),
            ("vessel.csv", "5.5", ""),
            ("log_sheet.csv", "6.5", "low"),
        ):
            with (self.own / name).open(encoding="utf-8") as file:
                found = {row["depth_m"]: row for row in csv.DictReader(file)}
            self.assertEqual(found[depth]["extrapolated"], lines)
        axes = Figure().subplots()
        picture.draw_expected(axes, expected.expected_of(Results(self.own)))
        dashed = [
            np.nanmin(np.where(np.isnan(x), np.nan, y))
            for x, y in (line.get_data() for line in axes.lines)
            if len(x) and np.isnan(x[0]) and np.isfinite(x[-1])
        ]
        np.testing.assert_allclose(sorted(dashed), [5.8, 6.86], atol=0.1)

    def write_rows(self, head: str, *columns: np.ndarray) -> None:
        """Write a log with columns [n]."""
        rows = [",".join(f"{x:.6g}" for x in row) for row in zip(*columns)]
        self.file.write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")

    def said(self) -> str:
        """Return what the log says."""
        return "\n".join(caisson.compare_log(self.own, self.file))

    def test_refused_by_the_ground(self) -> None:
        """A caisson that rests or creeps while suction rises to more than is allowed is
        a refusal, with or without times, with a noisy depth, and where suction is taken
        off after it; so is one under a suction that is allowed."""
        usual = np.maximum(np.interp(5.0, DEPTH, BEST) - WEIGHT, 0) / AREA / 1e3
        rng = np.random.default_rng(1)
        cases = [
            (2.5 * float(usual) * 1e3, 3.0, "No forecast: already at 5"),
            (1e6, 3.0, "No forecast: the log ends at 5"),
            (1e6, 1.5, "No forecast: the log ends at 5"),
        ]
        for boiling, rise, first in cases:
            self.write_runs(boiling=boiling)
            for noise, creep, rows, has_time in (
                *((0, 0, 60, True), (0, 0, 60, False), (5e-3, 0, 60, True)),
                *((0, 0.04, 200, True), (0, 0.04, 200, False), (3e-3, 0.02, 60, False)),
            ):
                end = np.linspace(5.0, 5.0 + creep, rows)
                depth = np.append(np.arange(1.0, 5.0, 0.01), end)
                suction = np.maximum(np.interp(depth, DEPTH, BEST) - WEIGHT, 0)
                suction /= AREA * 1e3
                suction[400:] = usual * np.linspace(1, rise, rows)
                after = rows // 3 if rows == 200 and boiling == 1e6 else 0
                depth = np.append(depth, np.full(after, depth[-1]))
                suction = np.append(suction, np.full(after, 1.0))
                depth += noise * rng.normal(size=len(depth))
                columns = [depth, suction]
                head = "depth_m,suction_kPa"
                if has_time:
                    head = f"time_s,{head}"
                    columns.insert(0, 30.0 * np.arange(len(depth)))
                self.write_rows(head, *columns)
                said = self.said()
                what = boiling, rise, noise, creep, has_time
                self.assertTrue(said.startswith(first), f"{what}: {said}")
            with (self.own / "vessel.csv").open(encoding="utf-8") as file:
                cells = {row["forecast_kPa"] for row in csv.DictReader(file)}
            self.assertEqual(cells, {""})

    def test_refused_where_suction_begins(self) -> None:
        """A caisson that rests by its weight, and that suction does not move."""
        self.write_runs(boiling=1e6)
        depth = np.append(np.arange(1.0, 2.6, 0.01), np.full(60, 2.6))
        suction = np.append(np.zeros(160), np.linspace(0, 40, 60))
        self.write_rows("depth_m,suction_kPa", depth, suction)
        self.assertTrue(self.said().startswith("No forecast: the log ends at 2.6 m"))

    def test_refusal_that_is_overcome(self) -> None:
        """It is named, and the log is not within the band there; a log of little more
        than a refusal has one, too."""
        self.write_runs()
        depth = np.insert(np.arange(2.8, 6.0, 0.01), 120, np.full(60, 4.0))
        usual = np.maximum(np.interp(depth, DEPTH, BEST) - WEIGHT, 0) / AREA / 1e3
        usual[120:180] *= np.linspace(1, 3, 60)
        self.write_rows("depth_m,suction_kPa", depth, usual)
        said = self.said()
        self.assertIn("rested under growing suction at 4 m", said)
        self.assertRegex(said, r"is from (3\.9|4) m to (4|4\.1) m above the high")
        self.assertTrue(said.startswith("Forecast"))
        self.write_rows("depth_m,suction_kPa", depth[105:180], usual[105:180])
        self.assertTrue(self.said().startswith("No forecast: the log ends at 4"))

    def test_weight_in_some_rows(self) -> None:
        """The last weight that is written counts until the next one."""
        self.write_runs()
        depth = np.arange(2.8, 6.0, 0.01)
        weight = np.where(depth > 4, 2000.0, 1500.0)
        suction = (np.interp(depth, DEPTH, BEST) / 1e3 - weight) / AREA
        head = "depth_m,suction_kPa,weight_kN"
        self.write_rows(head, depth, suction, weight)
        said = self.said()
        lines = self.file.read_text(encoding="utf-8").splitlines()
        for i in range(len(lines)):
            if i and i % 10 != 1:
                lines[i] = lines[i].rpartition(",")[0] + ","
        self.file.write_text("\n".join(lines), encoding="utf-8")
        self.assertEqual(self.said().splitlines()[1:3], said.splitlines()[1:3])

    def test_last_readings(self) -> None:
        """A single reading above the allowable suction at the end of a log ends the
        forecast."""
        self.write_runs(boiling=1e5)
        depth = np.arange(1.0, 6.0, 0.02)
        suction = np.maximum(np.interp(depth, DEPTH, BEST) - WEIGHT, 0) / AREA / 1e3
        for n in (1, 2, 4):
            suction[-n:] = 150.0
            self.write_rows("depth_m,suction_kPa", depth, suction)
            said = self.said()
            self.assertTrue(said.startswith("No forecast: already at"), said)
            self.assertIn(f"{n} of 250 readings have more suction than", said)

    def test_below_the_runs(self) -> None:
        """Readings below the end of the runs are counted, and end the forecast."""
        self.write_runs()
        depth = np.arange(1.0, 9.8, 0.02)
        suction = (
            np.maximum(2.5e5 * depth + 0.9e5 * depth**2 - WEIGHT, 0) / AREA / 1e3
        )
        self.write_rows("depth_m,suction_kPa", depth, suction)
        said = self.said()
        self.assertIn(
            "No forecast: the log goes to 9.78 m, and the runs end at 9", said
        )
        self.assertIn("35 readings below 9 m, where the runs end", said)

    def test_not_of_this_caisson(self) -> None:
        """Units that are wrong and another caisson are refused, and nothing written."""
        self.write_runs()
        depth = np.arange(1.0, 7.0, 0.02)
        suction = np.maximum(np.interp(depth, DEPTH, BEST) - WEIGHT, 0) / AREA / 1e3
        weight = np.full(len(depth), WEIGHT)
        force = np.interp(depth, DEPTH, BEST)
        for head, columns, text in (
            ("depth_m,suction_Pa", (depth, suction), "the suction is 0.001 times"),
            (
                "depth_m,suction_MPa",
                (depth, suction),
                "the suction is .* times that",
            ),
            (
                "depth_m,suction_kPa,weight_kN",
                (depth, suction, weight),
                "the weight is 1",
            ),
            ("depth_m,resistance_kN", (depth, force), "the resistance is 1e.03 times"),
            ("depth_m,suction_kPa", (3 * depth, suction), "the skirt is 10 m long"),
            ("depth_m,suction_kPa", (-depth, suction), "the depth is negative"),
        ):
            self.write_rows(head, *columns)
            with self.assertRaisesRegex(InputError, text):
                self.said()
        self.assertFalse((self.own / "vessel.csv").exists())

    def test_columns_that_contradict(self) -> None:
        """Suction and resistance: the allowable one is compared with the suction."""
        self.write_runs(boiling=4e4)
        depth = np.arange(1.0, 6.0, 0.02)
        force = np.interp(depth, DEPTH, BEST) / 1e3
        suction = np.full(len(depth), 50.0)
        self.write_rows("depth_m,suction_kPa,resistance_kN", depth, suction, force)
        said = self.said()
        self.assertIn("250 of 250 readings have more suction than is allowed", said)
        self.assertIn("The column of the resistance differs by -", said)

    def test_gauges(self) -> None:
        """Tilt and flow are held against what stops the vessel."""
        self.write_runs()
        depth = np.arange(1.0, 6.0, 0.02)
        suction = np.maximum(np.interp(depth, DEPTH, BEST) - WEIGHT, 0) / AREA / 1e3
        head = "depth_m,suction_kPa,tilt_deg"
        for tilt, text in (
            (0.3, "tilt 0.3° at 1 m."),
            (-2.1, "tilt 2.1° at 1 m, above the 0.5° at which"),
        ):
            tilts = np.append(tilt, np.full(len(depth) - 1, tilt / 2))
            self.write_rows(head, depth, suction, tilts)
            self.assertIn(text, self.said())

    def test_stops_of_the_pump(self) -> None:
        """A stop of the pump is no refusal, in the middle of a log and at its end, and
        the fit takes what the ground has held before it; few readings, with a gap and
        in whole minutes, have none."""
        self.write_runs()
        for step, rest, where in (
            *((0.02, 0, 0.3), (0.3, 0, 0.3)),
            *((0.05, 200, 0.3), (0.05, 200, 1.0), (0.01, 1000, 1.0)),
        ):
            depth = np.arange(3.0, 7.0, step)
            depth = depth[(depth < 4.4) | (depth > 5.2)]
            middle = int(where * (len(depth) - 1))
            depth = np.insert(depth, middle, np.full(rest, depth[middle]))
            usual = np.maximum(np.interp(depth, DEPTH, BEST) - WEIGHT, 0) / AREA / 1e3
            usual[middle : middle + rest] *= 0.3
            gap = np.where(depth > 5, 0.8 / step, 0)
            minutes = np.floor(0.5 * (np.arange(len(depth)) + gap))
            self.write_rows("time_min,depth_m,suction_kPa", minutes, depth, usual)
            self.assertTrue(self.said().startswith("Forecast"), (step, rest))
            found, bins, _ = self.answer()
            best = np.interp(bins.depth, found.depth, found.best)
            np.testing.assert_allclose(bins.resistance / best, 1, atol=0.06)

    def test_last_steps(self) -> None:
        """The factor of the end of a log is said where it is not that of all of it."""
        self.write_runs()
        self.write_log(BEST * np.where(DEPTH > 5.6, 2.0, 1.0), 6.0)
        self.assertIn("Where the log ends it is 1.9", self.said())
        self.write_log(BEST, 6.0)
        self.assertNotIn("Where the log ends", self.said())

    def test_command(self) -> None:
        """Page, picture and table; and the blank sheet."""
        self.write_runs()
        self.write_log(1.1 * BEST, 6.0)
        found = vessel_log.answer_of(self.own, self.file)
        files, said = vessel_log.write(self.own, found), found.said
        self.assertTrue(all(file.stat().st_size > 500 for file in files))
        page = (self.own / "vessel.html").read_text(encoding="utf-8")
        for text in (*said, "Largest flow 20 m³/h", "20 repeated rows"):
            self.assertTrue(text in page, text)
        with (self.own / "vessel.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        last = rows[-1]
        self.assertEqual(last["depth_m"], "9")
        self.assertEqual(last["measured_kPa"], "")
        self.assertLess(float(last["forecast_low_kPa"]), float(last["forecast_kPa"]))
        for path in sheet.write(self.own):
            self.assertGreater(path.stat().st_size, 500)
        with (self.own / "log_sheet.csv").open(encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([float(row["depth_m"]) for row in rows[:2]], [1.0, 1.5])
        self.assertEqual({row["suction_kPa"] for row in rows}, {""})
        criteria = " ".join(sheet.criteria_of(expected.expected_of(Results(self.own))))
        self.assertRegex(
            criteria, r"allowable one \(water boils\).*rest between 2\.. m"
        )
        self.assertIn("the tilt reaches 0.5 degrees", criteria)


def hidden(rng: np.random.Generator, kind: int) -> np.ndarray:
    """Return a resistance (N) at DEPTH of a soil whose total scatters as the band of
    the runs says: in layers of other strength, with waves, with a trend, with jumps at
    layers, or far outside."""
    sd = HALF / 1.645
    site = 0.7 * sd * rng.normal()
    layer = np.searchsorted(np.cumsum(rng.uniform(0.8, 3.0, 12)), DEPTH)
    of_layer = rng.normal(size=13)[layer]
    wave = np.sin(2 * np.pi * (DEPTH / rng.uniform(2, 6) + rng.uniform()))
    if kind == 0:
        strength, step = np.exp(site + 0.85 * sd * of_layer), DEPTH[1] - DEPTH[0]
        friction = np.cumsum(np.gradient(FRICTION, step) * strength) * step
        return np.asarray(TIP * strength + friction)
    change = {
        1: site + sd * wave,
        2: site + sd * rng.normal() * (DEPTH - 4.5) / 6,
        3: site + 0.7 * sd * of_layer,
        4: 2.2 * sd * rng.choice([-1, 1]) + 0.4 * sd * wave,
    }
    return np.asarray(BEST * np.exp(change[kind]))


class ByHand(unittest.TestCase):
    """Logs of few steps in a band of one width, without noise of their own."""

    def setUp(self) -> None:
        best = BEST / 1e3
        self.expected = expected.Expected(
            run=None,  # type: ignore[arg-type]
            depth=DEPTH,
            low=best * np.exp(-HALF),
            best=best,
            high=best * np.exp(HALF),
            allowable=np.full(len(DEPTH), BOILING),
            governing=[""] * len(DEPTH),
            weight=0.0,
            area=AREA,
            source="",
            planned=END,
            extrapolated={},
        )

    def bins_of(self, depth: np.ndarray, share: np.ndarray) -> forecast.Bins:
        """Return a log at depths [n] (m) of shares [n] of the band."""
        resistance = self.expected.resistance(depth, share)
        nothing = np.zeros(len(depth))
        return forecast.Bins(depth, resistance, nothing, nothing)

    def test_interval_of_a_rough_log(self) -> None:
        """Half of the steps at low and half at high: the interval is that of a median
        deviation of 1, over as many independent steps as lengths of CORRELATION."""
        depth, share = np.linspace(1, 5.5, 20), np.tile([-1.0, 1.0], 10)
        fit = forecast.fit_of(self.expected, self.bins_of(depth, share))
        error = 1.645 * np.hypot(1.4826, 0.15) / np.sqrt(1 + 4.5 / (0.1 * END))
        self.assertAlmostEqual(fit.share[0], 0, delta=1e-3)
        self.assertAlmostEqual(fit.share[2] - fit.share[0], error, delta=0.01)

    def test_band_of_a_log_far_outside(self) -> None:
        """One step at three times the band: the process is as much wider as the square
        of the step over its variance, and far below half of the variance is known."""
        bins = self.bins_of(np.array([1.0]), np.array([3.0]))
        ahead = forecast.forecast_of(self.expected, bins, 0.0)
        of_soil = 1 / 1.645**2
        of_step = of_soil + 0.15**2
        left = 9 / of_step * (of_soil - (0.5 * of_soil) ** 2 / of_step)
        reach = 2.05 * np.sqrt(left + 0.15**2)
        middle, high = np.log(ahead.best[-1]), np.log(ahead.high[-1])
        self.assertAlmostEqual((high - middle) / HALF, reach, delta=0.01)
        mean = 3 * 0.5 * of_soil / of_step
        self.assertAlmostEqual(
            (middle - np.log(BEST[-1] / 1e3 / AREA)) / HALF, mean, delta=0.01
        )


if __name__ == "__main__":
    unittest.main()
