# SPDX-License-Identifier: LGPL-2.1-or-later
"""Low, best and high estimate: their layers, and the page that has all of them."""
import argparse
import re
import unittest
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from synthetic import write_columns
from test_report import SUMMARY, WithPage, leave_run

import caisson.report as report
from caisson.band import BEST, HIGH, LOW, band_of, left_out, member_of
from caisson.commands import run_several
from caisson.plot import charts
from caisson.report import verdict
from caisson.report.low_and_high import required_at
from caisson.results import Results
from caisson.runner import RunError
from caisson.suggest import low_and_high
from caisson.suggest.entry import Layer, SuggestError
from caisson.suggest.soil import layers_of

KNOWN = {
    **dict.fromkeys(("Friction angle", "Critical friction angle"), "degrees"),
    **dict.fromkeys(("Cohesion", "Youngs modulus", "Tension cut-off"), "Pa"),
    **{"Relative density": "", "Permeability": "m/s", "Void ratio": "", "Law": ""},
}
SOIL = ["0: Sand = medium dense", "2: su = (4 + 2*d) kPa, E = 300 su"]


class Estimates(unittest.TestCase):
    """The layers of the low and the high estimate."""

    def ends(self, texts: list[str], **given: object) -> dict[str, list[Layer]]:
        """Return them, by the options of the command."""
        default: dict[str, object] = {"low": [], "high": [], "spread": None}
        default["cpt"] = None
        options = argparse.Namespace(**{**default, **given})
        low_and_high.check(options)
        return low_and_high.of_texts(texts, KNOWN, "density", options)

    def test_current_folder(self) -> None:
        """It has no name of its own."""
        here = Path.cwd()
        self.assertEqual(member_of(Path("."), LOW), here.with_name(f"{here.name}_low"))

    def test_only_what_differs(self) -> None:
        """The rest, also of other layers, is that of the best estimate; what is
        assumed follows."""
        found = self.ends(SOIL, low=["2: su = 3 kPa"], high=["0: Dr = 70%"])
        best = layers_of(SOIL, KNOWN, "density")
        self.assertEqual(found["low"][0], best[0])
        self.assertEqual(found["high"][1], best[1])
        self.assertEqual(found["low"][1].value("Cohesion"), "3000")
        self.assertEqual(found["low"][1].value("Youngs modulus"), "300*(3000)")
        self.assertEqual(found["high"][0].value("Relative density"), "0.7")
        modulus = float(found["high"][0].value("Youngs modulus"))
        self.assertGreater(modulus, float(best[0].value("Youngs modulus")))

    def test_spread_is_that_of_a_normal_distribution(self) -> None:
        """At its points of 5 and 95 %, of words, numbers and expressions; a relative
        density is at most 1."""
        found = self.ends(SOIL, spread="Dr 20%, su 10%")
        density = [
            float(found[x][0].value("Relative density")) for x in low_and_high.SIGNS
        ]
        self.assertEqual(density, [0.3355, 0.6645])
        strength = [found[x][1].value("Cohesion") for x in low_and_high.SIGNS]
        words = [f"{factor}*(1000*(4 + 2*d))" for factor in (0.8355, 1.1645)]
        self.assertEqual(strength, words)
        dense = self.ends(["0: Dr = 90%"], spread="Dr 10%")
        self.assertEqual(float(dense["high"][0].value("Relative density")), 1)

    def test_refusals(self) -> None:
        """A line says what to do."""
        cases: list[tuple[str, dict[str, object]]] = [
            ("no layer begins there; the tops are 0, 2 m", {"low": ["1: Dr = 50%"]}),
            ("names the top 0 m twice", {"high": ["0: Dr = 70%", "0: phi = 3"]}),
            ("from 0 m has more .*; exchange", {"low": ["0: Dr = 70%"]}),
            ("from 0 m has less .*; exchange", {"high": ["0: loose"]}),
            ("from 2 m has less .*; exchange", {"high": ["2: su = (3 + 2*d) kPa"]}),
            ("from 2 m has more .*; exchange", {"low": ["2: E = 400 su"]}),
            ("no layer gives phi", {"spread": "phi 5%"}),
            ("of a larger one give --low and --high", {"spread": "su 60%"}),
            ("each once", {"spread": "su"}),
            ("no higher resistance", {"spread": "k 20%"}),
            ("or --low and --high, not both", {"spread": "su 9%", "low": ["0: Dr=1"]}),
            ("its own low and high", {"spread": "su 9%", "cpt": "test.csv"}),
        ]
        for words, given in cases:
            with self.subTest(words), self.assertRaisesRegex(SuggestError, words):
                self.ends(SOIL, **given)


class Page(WithPage):
    """The page of a caisson whose required suction is 10 kPa for each meter below
    1.5 m, with 0.7 times that force in soft soil and 1.5 times that in hard soil."""

    FACTORS = {LOW: 0.7, BEST: 1.0, HIGH: 1.5}
    PUMP = {"Water/Largest suction": "40e3", "Time/End penetration": "4.4"}

    def leave_band(self) -> Results:
        """Leave three runs; return the best one."""
        best = self.path / "own"
        for estimate, factor in self.FACTORS.items():
            directory = member_of(best, estimate)
            leave_run(directory, {**SUMMARY, "entries": self.PUMP})
            history = dict(Results(directory).history)
            depth = history["penetration_m"]
            for name in history:
                history[name] = history[name] * (factor if name.endswith("_N") else 1)
            history["required_suction_Pa"] = 1e4 * (factor * depth - 1.5)
            history["suction_Pa"] = np.maximum(history["required_suction_Pa"], 0)
            write_columns(directory / "history.csv", history)
            if estimate != BEST:
                verdict.keep(Results(directory))
        return Results(best)

    def test_verdict_and_penetration_by_weight(self) -> None:
        """40 kPa of the pump are needed at 3.67 m in hard soil, which is said as 3.6 m,
        and nowhere else."""
        run = self.leave_band()
        page = report.write(run.directory).read_text(encoding="utf-8")
        (text,) = re.findall('<p class="verdict">(.*?)</p>', page)
        self.assertIn("Feasible to 4.5 m by weight 1 MN and suction up to 30", text)
        ends = (
            "With low resistance to 4.5 m, suction up to 16.5 kPa; with high"
            " resistance to 3.6 m (pump)."
        )
        self.assertTrue(text.endswith(f"{ends}</span>"), text)
        self.assertTrue("low resistance: 2.14 m; high resistance: 1.00 m" in page)

    def test_quarters(self) -> None:
        """At 1.1, 2.2, 3.3 and 4.4 m, each by its own run."""
        run = self.leave_band()
        page = report.write(run.directory).read_text(encoding="utf-8")
        (table,) = re.findall('<table class="quarters">(.*?)</table>', page, re.S)
        rows = [re.findall("<td>(.*?)</td>", row) for row in table.split("<tr>")[2:]]
        name = "required suction (kPa)"
        self.assertEqual(rows[0], [f"{name}, low", "0", "0.4", "8.1", "15.8"])
        best = ["0 (weight suffices)", "7", "18", "29"]
        self.assertEqual(rows[1], [f"{name}, best", *best])
        high = ["1.5", "18", "34.5", "not feasible"]
        self.assertEqual(rows[2], [f"{name}, high", *high])

    def test_row_where_suction_ends(self) -> None:
        """With a pump for 25 kPa that is 4 m, between the quarters, and 2.6 m in hard
        soil; soft soil needs 13 kPa there."""
        self.PUMP = {**self.PUMP, "Water/Largest suction": "25e3"}
        run = self.leave_band()
        page = report.write(run.directory).read_text(encoding="utf-8")
        (table,) = re.findall('<table class="quarters">(.*?)</table>', page, re.S)
        heads = re.findall("<th.*?>(.*?)</th>", table)
        rows = [re.findall("<td>(.*?)</td>", row) for row in table.split("<tr>")[2:]]
        self.assertEqual(len(heads), 6)
        self.assertIn("feasible: ", heads[4])
        cells = [row[4] for row in rows[:3]]
        self.assertEqual(cells[0::2], ["13", "not feasible"])
        self.assertAlmostEqual(float(cells[1]), 25, delta=0.6)

    def test_area_of_the_charts(self) -> None:
        """It has the ends of all three, down to where the first of them ends."""
        run = self.leave_band()
        for column, slope, by_weight in (
            ("required_suction_Pa", 10, 15),
            ("total_force_N", 1e3, 0),
        ):
            depth, low, high = charts.range_of(run, column) or [np.empty(0)] * 3
            self.assertAlmostEqual(depth[-1], 3.6, delta=0.02)
            expected = [
                np.maximum(slope * factor * depth - by_weight, 0)
                for factor in (self.FACTORS[LOW], self.FACTORS[HIGH])
            ]
            inner = depth > 0.7  # means end at the ends of a curve
            for values, known in zip((low, high), expected):
                error = np.abs(values - known)[inner].max()
                self.assertLess(error, 1e-2 * slope)
        areas, axes = (
            charts.range_curve(run, "total_force_N", "total"),
            Figure().subplots(),
        )
        self.assertTrue(areas[1]["shade"])
        charts.draw(axes, areas)
        self.assertEqual((len(axes.collections), len(axes.lines)), (2, 0))

    def test_of_a_study(self) -> None:
        """The runs of low, best and high in a study are a band, too."""
        run = self.leave_band()
        for estimate in (LOW, HIGH):
            member = member_of(run.directory, estimate)
            member.rename(self.path / f"soil_{estimate}")
        run.directory.rename(self.path / "soil_best")
        best = Results(self.path / "soil_best")
        self.assertEqual(list(band_of(best)), [LOW, BEST, HIGH])
        low = Results(self.path / "soil_low")
        self.assertEqual(list(band_of(low)), [BEST])

    def test_only_of_this_scene(self) -> None:
        """Another caisson of that name counts as none, and the page says so."""
        run = self.leave_band()
        entry = "Rigid body/Outer diameter"
        for estimate, size in ((BEST, "10"), (HIGH, "5"), (LOW, "5")):
            summary = {**SUMMARY, "entries": {**self.PUMP, entry: size}}
            leave_run(member_of(run.directory, estimate), summary)
        page = report.write(run.directory).read_text(encoding="utf-8")
        self.assertNotIn("With low resistance", page)
        why = f"has another {entry} than the best estimate"
        self.assertIn(
            f"The soil of low resistance is left out, as own_low {why}; the soil of"
            f" high resistance is left out, as own_high {why}: change its scene as"
            " mine.prm was changed, and then `caisson run --band mine.prm`.",
            page,
        )
        best = Results(run.directory)
        self.assertEqual(charts.range_of(best, "total_force_N"), None)
        (why_low, _) = left_out(best).values()
        self.assertEqual(why_low, f"own_low {why}")

    def test_only_on_its_side(self) -> None:
        """A high estimate that has less resistance than the best one over a part of the
        way, as that was changed since, counts as none, and so does a low one with more;
        the scatter of runs does not count."""
        less = "own_high has less resistance than the best estimate from 0.5"
        for factors, words in (
            ((0.7, 1.0, 0.9), less),
            ((1.1, 1.0, 1.5), "own_low has more resistance than the best estimate"),
            ((1.02, 1.0, 0.98), ""),
        ):
            self.FACTORS = dict(zip((LOW, BEST, HIGH), factors))
            found = list(left_out(self.leave_band()).values())
            self.assertEqual(len(found), bool(words))
            self.assertIn(words, " ".join(found))
        run = self.leave_band()
        history = dict(run.history)
        history["total_force_N"] = history["total_force_N"] + 1e6 * (
            history["penetration_m"] > 4
        )
        write_columns(run.directory / "history.csv", history)
        self.assertRegex(
            left_out(Results(run.directory))[HIGH], "from 3.5[0-9]? m to 4.5 m"
        )

    def test_stopped(self) -> None:
        """A run that was stopped says nothing of its resistance."""
        run = self.leave_band()
        high = member_of(run.directory, HIGH)
        leave_run(high, {**SUMMARY, "entries": self.PUMP, "status": "stopped"})
        page = report.write(run.directory).read_text(encoding="utf-8")
        words = "with high resistance not known: its run was stopped at 4.5 m."
        self.assertTrue(words in page)

    def test_depth_out_of_reach(self) -> None:
        """Before the start, and below the end."""
        run = self.leave_band()
        words = [required_at(run, depth, run.shown) for depth in (0.4, 4.6)]
        self.assertEqual(words, ["before the start", "not reached"])


class Runs(unittest.TestCase):
    """caisson run --band."""

    def test_refusals(self) -> None:
        """A line says what to do."""
        with self.assertRaisesRegex(RunError, "takes --set, --restart and --overwrite"):
            run_several.options_of(["--restart", "--output-directory", "there"])
        with self.assertRaisesRegex(RunError, "caisson suggest --spread, or --low"):
            run_several.scenes_of(Path(__file__))


if __name__ == "__main__":
    unittest.main()
