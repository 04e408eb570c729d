# SPDX-License-Identifier: LGPL-2.1-or-later
"""suction.png and design.csv of a made-up run."""
import argparse
import csv
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
from matplotlib.figure import Figure
from synthetic import write_columns, write_run
from test_suction_design import CRITICAL_SUCTIONS

from caisson import evaluation, plot
from caisson.plot import charts, suction
from caisson.verdict import design, limits, theory
from caisson.verdict import suction_methods as methods
from caisson.verdict.installation import Installation
from caisson.verdict.outcome import whole_way
from caisson.results import Results
from caisson.design import dnv, seepage, senders_randolph, unified
from caisson.design import suction_installation as installation
from caisson.design.assumed_cone import Sand, assumed_cone
from caisson.design.cone import Profile, Skirt
from caisson.design.houlsby_byrne import Caisson, Layer

BAR = "required, error bar"
GAMMA, WEIGHT, D = 8829.0, 1e6, 6.0
SAND: dict[str, Any] = {
    "top_depth_m": 0,
    "law": "Mohr-Coulomb",
    "submerged_unit_weight_N_m3": GAMMA,
    "K0": 0.5,
    "friction_angle_deg": 30,
    "cohesion_Pa": 0,
}
SCENE: dict[str, Any] = {
    "diameter_m": D,
    "wall_thickness_m": 0.1,
    "inner_wall_friction_angle_deg": 20,
    "outer_wall_friction_angle_deg": 20,
    "layers": [SAND],
    "submerged_weight_N": WEIGHT,
}
SITE = theory.Site(SCENE)
GEOMETRY = (D, 0.1, [Layer(0, GAMMA, 30, 0.5)], 20, 20)
UNDISTURBED = Caisson(*GEOMETRY)
CASES = {  # of the columns
    "low": Caisson(*GEOMETRY, 1.5, (0.45, 0.45)),
    "high": Caisson(*GEOMETRY, 1.5, (0.8, 0.8)),
    "undisturbed": UNDISTURBED,
}
ASSUMED = [
    column.replace("_cone", "_assumed_cone")
    for columns in methods.CONE_COLUMNS.values()
    for column in columns
]
PARTS = ("tip_force", "inner_friction", "outer_friction")
REST = 2.0  # m, of the made-up run
# no suction draws it in: it has no weight, and its outer wall much friction
LIGHT: dict[str, Any] = {
    "submerged_weight_N": 1,
    "design_methods": {"k_tan_delta_inside": [2, 2], "k_tan_delta_outside": [2, 2]},
    "outer_wall_friction_angle_deg": 45,
    "layers": [{**SAND, "K0": 2}],
}


def by_assumed_cone(h: float) -> list[float]:
    """Return the required suctions of ASSUMED (Pa)."""
    cone = assumed_cone((Sand(0, GAMMA, 0.5, None, 30),), 4.5)
    skirt = Skirt(D, 0.1, 20, 20)
    every = (
        dnv.method(skirt, cone, [(0.0, "sand")]),
        senders_randolph.method(skirt, cone),
        unified.method(skirt, cone),
    )
    area, critical = np.pi * 5.8**2 / 4, installation.critical_suction(UNDISTURBED, h)
    return [
        installation.relieved_suction(method.forces(h, case), WEIGHT, area, critical)
        for method in every
        for case in method.cases
    ]


def synthetic() -> dict[str, np.ndarray]:
    """Return columns of history.csv: required suction 10 kPa for each meter."""
    depth = np.linspace(0.5, 4.53, 32)
    required = 1e4 * (depth - REST)
    table = {
        "time_s": depth,
        "penetration_m": depth,
        "total_force_N": WEIGHT + 26 * required,
        **{f"{part}_N": WEIGHT / 4 + 8 * required for part in PARTS},
        "suction_Pa": np.maximum(required, 0),
        "required_suction_Pa": required,
        "cavitation_suction_Pa": 3e5 + 9810 * depth,
        "exit_gradient_wall": 0.2 * depth,
        "exit_gradient_axis": 0.1 * depth,
        "critical_gradient": np.full(32, 0.9),
        "plug_heave_m": 0.05 * depth,
        "pumped_volume_m3": 26 * depth,
        "seepage_volume_m3": 0.01 * depth,
    }
    return table


class MadeUpRun(unittest.TestCase):
    """A run directory with nothing but history.csv and run.json."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        printed = mock.patch("builtins.print")
        printed.start()
        self.addCleanup(printed.stop)

    def write(self, history: dict[str, np.ndarray], **change: Any) -> Results:
        """Write a run whose scene has some entries changed."""
        summary = {"title": "synthetic", "scene": {**SCENE, **change}}
        write_run(self.path, history, summary)
        return Results(self.path)

    def design(self) -> list[dict[str, str]]:
        """Return the rows of design.csv."""
        with (self.path / "design.csv").open(encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_files(self) -> None:
        self.write(synthetic())
        names = [path.name for path in plot.draw(self.path)]
        self.assertEqual(names, ["forces.png", "suction.png", "design.csv"])
        picture = (self.path / "suction.png").read_bytes()
        self.assertEqual(picture[:4], b"\x89PNG")
        self.assertGreater(len(picture), 10_000)

    def test_error_bars(self) -> None:
        """Bars of 2 kPa about the required suction are drawn, and no area; without a
        file of bounds there are none."""
        run = self.write(synthetic())
        (axes,) = Figure().subplots(1, 1, squeeze=False)[0]
        answers = methods.answers_of(SITE, np.array([1.0, 4.0]))
        suction.draw_suction(axes, run, whole_way(run), answers)
        self.assertNotIn(BAR, axes.get_legend_handles_labels()[1])
        depth = run.history["penetration_m"]
        required = run.history["required_suction_Pa"]
        bounds = {
            "penetration_m": depth,
            "required_suction_low_Pa": required - 2e3,
            "required_suction_high_Pa": required + 2e3,
        }
        write_columns(self.path / "history_error.csv", bounds)
        suction.draw_suction(axes, (new := Results(self.path)), whole_way(new), answers)
        (bars,) = [c for c in axes.containers if c.get_label() == BAR]
        segments = bars[2][0].get_segments()
        self.assertGreater(len(segments), 8)
        for (low, at), (high, _) in segments:
            needed = float(np.interp(at, depth, required)) / 1e3
            self.assertAlmostEqual(low, max(needed - 2, 0), 4)
            self.assertAlmostEqual(high, max(needed + 2, 0), 4)

    def test_values_at_one_depth(self) -> None:
        design.write(self.path / "design.csv", self.write(synthetic()))
        rows = self.design()
        depths = [float(row["penetration_m"]) for row in rows]
        np.testing.assert_allclose(depths, np.arange(5, 46) / 10)
        h, row = 3.0, rows[25]
        fits = CRITICAL_SUCTIONS
        byrne = {
            f"houlsby_byrne_{case}_Pa": installation.required_suction(
                caisson, WEIGHT, h
            )
            for case, caisson in CASES.items()
        }
        expected = {
            "penetration_m": h,
            "required_suction_Pa": 1e4 * (h - REST),
            **byrne,
            **dict(zip(ASSUMED, by_assumed_cone(h))),
            "critical_senders_randolph_Pa": fits["Senders & Randolph (2009)"](
                GAMMA, h, D
            ),
            "critical_houlsby_byrne_Pa": fits["Houlsby & Byrne (2005)"](GAMMA, h, D),
        }
        suctions = [name for name in row if not name.endswith("_N")]
        suctions.remove("assumed_cone_resistance_Pa")
        self.assertEqual(suctions, list(expected))
        for name, value in expected.items():
            self.assertGreater(value, 0)
            self.assertAlmostEqual(float(row[name]) / value, 1, 9, name)

    def test_cells_without_an_answer_are_empty(self) -> None:
        """Without weight, and with much friction outside, no suction suffices."""
        design.write(self.path / "design.csv", self.write(synthetic(), **LIGHT))
        last = self.design()[-1]
        self.assertEqual(last["houlsby_byrne_low_Pa"], "")
        self.assertGreater(float(last["critical_senders_randolph_Pa"]), 0)

    def test_layers_have_a_mean_weight(self) -> None:
        """6 kN/m3 over 1 m and 10 over 3 m are 9 over 4 m."""
        layers = [
            {**SAND, "submerged_unit_weight_N_m3": 6e3},
            {**SAND, "submerged_unit_weight_N_m3": 10e3, "top_depth_m": 1},
        ]
        site = theory.Site({**SCENE, "layers": layers})
        answers = methods.answers_of(site, np.array([4.0]))
        found = answers.suctions["critical_senders_randolph_Pa"][0]
        self.assertAlmostEqual(found / seepage.senders_randolph(9e3, 4, D), 1)

    def test_penetration_by_weight(self) -> None:
        history = synthetic()
        self.assertAlmostEqual(evaluation.rest_of_run(history) or 0, REST, delta=0.14)
        history["suction_Pa"][0] = 5.0  # not for good
        self.assertAlmostEqual(evaluation.rest_of_run(history) or 0, REST, delta=0.14)
        self.assertEqual(evaluation.sinks_on(history), [])
        depth = history["penetration_m"]
        history["suction_Pa"][(depth > REST + 0.5) & (depth < REST + 1)] = 0.0
        self.assertAlmostEqual(evaluation.rest_of_run(history) or 0, REST, delta=0.14)
        ((top, bottom),) = evaluation.sinks_on(history)
        self.assertAlmostEqual(top, REST + 0.5, delta=0.14)
        self.assertAlmostEqual(bottom, REST + 1, delta=0.14)
        history["suction_Pa"][1:] = 5.0
        self.assertIsNone(evaluation.rest_of_run(history))
        history["suction_Pa"][:] = 0.0
        self.assertIsNone(evaluation.rest_of_run(history))
        answers = methods.answers_of(SITE, np.array([1.0, 6.0]))
        for name in methods.RANGE:
            force = CASES[methods.CASES[name]].resistance(answers.rest[name])
            self.assertAlmostEqual(force / WEIGHT, 1)

    def test_water_boils_later_as_the_lid_comes_down(self) -> None:
        found = self.limited(limits.BOILING)
        (curve,) = self.limit(found, "water boils")
        rise = 9.81 * np.diff(curve["y"])
        np.testing.assert_allclose(np.diff(curve["x"]), rise, rtol=0.2)
        for farthest in (310.0, 300.0):  # kPa; it boils from 310 on
            ends = np.array([0, farthest]), np.array([0, 1])
            shown = [curve, charts.line("run", "black", *ends)]
            said = charts.beyond_the_chart(found, shown, 4.5)
            named = "Beyond the chart: water boils at 310 to 344 kPa."
            self.assertEqual(named in said, farthest < 301)

    def limited(self, name: str, **entries: str) -> Installation:
        """Return the installation of the made-up run with one of its limits."""
        summary = {"entries": entries, "scene": SCENE}
        write_run(self.path, synthetic(), summary)
        found = whole_way(Results(self.path))
        assert found is not None
        return replace(found, limits={name: found.limits[name]})

    def limit(self, found: Installation, label: str) -> list[charts.Curve]:
        """Return the curves of a limit."""
        every = charts.limit_curves(found, 4.5)
        return [curve for curve in every if curve["label"] == label]

    def test_pump_limit(self) -> None:
        """A line at the largest suction of the pump."""
        found = self.limited(limits.PUMP, **{"Water/Largest suction": "150e3"})
        (curve,) = self.limit(found, "pump")
        self.assertEqual(set(curve["x"]), {150.0})

    def test_heavy_caisson(self) -> None:
        site = theory.Site({**SCENE, "submerged_weight_N": 1e9})
        answers = methods.answers_of(site, np.array([1.0, 6.0]))
        self.assertEqual(answers.rest, {})
        self.assertIn("suffices down to 6 m", suction.caption(answers, site))

    def test_clay(self) -> None:
        """The weight of 1 MN rests where the walls and the tip bear it; below, suction
        bears what is more, up to what the plug bears."""
        layer = {**SAND, "friction_angle_deg": 0, "cohesion_Pa": 40e3}
        layer["wall_adhesion_Pa"] = 20e3
        run = self.write(synthetic(), layers=[layer])
        lines = self.drawn(theory.site_of(run), layers=[layer])
        limit = "reverse bearing of the plug, factor 1.5"
        for name in ("required, Strength of clay", limit):
            self.assertIn(name, lines)
        design.write(self.path / "design.csv", run)
        row = self.design()[25]  # 3 m
        tip = np.pi * 5.9 * 0.1 * (3 * GAMMA + 7.5 * 40e3)
        force, area = tip + 3 * 20e3 * np.pi * 11.8, np.pi * 5.8**2 / 4
        self.assertAlmostEqual(float(row["clay_strip_Pa"]) * area / (force - WEIGHT), 1)
        plug = 6.6 * 40e3 + 3 * 20e3 * 4 / 5.8
        self.assertAlmostEqual(float(row["plug_reverse_bearing_Pa"]) / plug, 1)
        answers = methods.answers_of(theory.site_of(run), np.array([3.0]))
        rest = answers.rest["strip"]
        tip = np.pi * 5.9 * 0.1 * (rest * GAMMA + 7.5 * 40e3)
        self.assertAlmostEqual((tip + rest * 20e3 * np.pi * 11.8) / WEIGHT, 1, 3)
        self.assertIn("area inside", suction.caption(answers, SITE))
        for name in ("exit_gradient_wall", "exit_gradient_axis", "critical_gradient"):
            del run.history[name]
        found = limits.limits_of(run, np.array([3.0]))
        self.assertEqual(list(found), [limits.REVERSE_BEARING, limits.BOILING])
        self.assertAlmostEqual(1.5 * found[limits.REVERSE_BEARING][0] / plug, 1e-3)

    def test_drained_run(self) -> None:
        """It has forces in design.csv, and no suction. There is but one record within
        0.1 m of 4 m. The first force is that of the second record."""
        history = synthetic()
        for name in ("suction_Pa", "required_suction_Pa"):
            del history[name]
        history["tip_force_N"] = 1e5 * history["penetration_m"]
        history["tip_force_N"][0] = 0
        self.write(history)
        names = [path.name for path in plot.draw(self.path)]
        self.assertEqual(names, ["forces.png", "design.csv"])
        self.assertFalse((self.path / "suction.png").exists())
        row = self.design()[35]
        pressures = [name for name in row if name.endswith("_Pa")]
        self.assertEqual(pressures, ["assumed_cone_resistance_Pa"])
        self.assertAlmostEqual(float(row["tip_force_N"]), 4e5, delta=1)
        first = float(self.design()[0]["tip_force_N"])
        self.assertAlmostEqual(first, history["tip_force_N"][1])
        for case, caisson in CASES.items():
            tip = caisson.forces(4).tip
            known = float(row[f"houlsby_byrne_{case}_tip_N"])
            self.assertAlmostEqual(known / tip, 1, 9)
            known = float(row[f"houlsby_byrne_{case}_total_N"])
            self.assertAlmostEqual(known / caisson.resistance(4), 1, 9)
        self.assertNotIn("dnv_most_probable_tip_N", row)
        tip = 0.3 * float(row[pressures[0]]) * np.pi * 5.9 * 0.1
        known = float(row["dnv_assumed_cone_most_probable_tip_N"])
        self.assertAlmostEqual(known / tip, 1, 9)

    def test_cone_test(self) -> None:
        """2 MPa per meter down to 4.2 m: 0.3 8 MPa pi 5.9 m 0.1 m at 4 m."""
        run = self.write(synthetic())
        (self.path / "cone.csv").write_text("depth_m,qc_MPa\n0,0\n4.2,8.4\n")
        design.write(self.path / "design.csv", run)
        rows = self.design()
        self.assertFalse([name for name in rows[35] if "assumed" in name])
        self.assertAlmostEqual(float(rows[35]["cone_resistance_Pa"]), 8e6)
        tip = float(rows[35]["dnv_most_probable_tip_N"])
        self.assertAlmostEqual(tip / (2.4e6 * np.pi * 5.9 * 0.1), 1, 9)
        for name in ("senders_randolph_low", "senders_randolph_high", "andersen_low"):
            self.assertGreater(float(rows[35][f"{name}_total_N"]), 0)
            self.assertEqual(rows[-1][f"{name}_total_N"], "")
        names = [path.name for path in plot.draw(self.path)]
        self.assertEqual(names, ["forces.png", "suction.png", "design.csv"])

    def test_required_suction_by_cone(self) -> None:
        """Equilibrium with inner friction and tip in proportion to 1 - s / s_cr."""
        site = SITE._replace(cone=Profile([0, 10], [0, 10e6]))
        answers, h = methods.answers_of(site, np.array([4.0])), 4.0
        critical = CRITICAL_SUCTIONS["Senders & Randolph (2009)"](GAMMA, h, D)
        tip = 0.2 * 4e6 * np.pi * 5.9 * 0.1
        wall = (1 - (5.8 / 6) ** 2) ** 0.3 * np.tan(np.radians(20)) * 8e6 * np.pi
        columns = methods.CONE_COLUMNS["senders_randolph"]
        for column, c in zip(columns, (0.012, 0.0212132)):
            (s,) = answers.suctions[column]
            relieved = (tip + c * wall * 5.8) * (1 - s / critical)
            pull = WEIGHT + s * np.pi * 5.8**2 / 4
            self.assertTrue(0 < s < critical)
            self.assertAlmostEqual((relieved + c * wall * 6) / pull, 1, 6)

    def test_legend_has_no_method_without_a_line(self) -> None:
        """No suction is required of a heavy caisson, and none suffices for a light one
        with much friction outside by Houlsby & Byrne; the critical suctions are drawn
        in both."""
        heavy: dict[str, Any] = {"submerged_weight_N": 1e9}
        for change in (heavy, LIGHT):
            site = theory.Site({**SCENE, **change})
            run = self.write(synthetic(), **change)
            (axes,) = Figure().subplots(1, 1, squeeze=False)[0]
            answers = methods.answers_of(site, np.linspace(4, 6, 5))
            suction.draw_suction(axes, run, whole_way(run), answers)
            labels = axes.get_legend_handles_labels()[1]
            self.assertFalse([n for n in labels if n.startswith("required, H")], change)
            by_cone = [n for n in labels if n.startswith("required, S")]
            self.assertEqual(len(by_cone), change is LIGHT)
            self.assertEqual(len([n for n in labels if "critical" in n]), 1)
            self.assertIn(limits.PIPING, labels)

    def drawn(self, site: theory.Site, **change: Any) -> dict[str, Any]:
        """Return the lines and bands of the suctions down to 4.5 m, by label."""
        (axes,) = Figure().subplots(1, 1, squeeze=False)[0]
        answers = methods.answers_of(site, np.linspace(0, 4.5, 91))
        run = self.write(synthetic(), **change)
        suction.draw_suction(axes, run, whole_way(run), answers)
        handles, labels = axes.get_legend_handles_labels()
        return dict(zip(labels, handles))

    def test_no_line_beyond_the_axis_in_the_legend(self) -> None:
        """A sentence has such a limit; the mark of the rest stands for its line, and
        the gray area for what is not feasible."""
        found = self.drawn(SITE)
        self.assertIn(limits.PIPING, found)
        self.assertNotIn("water boils", found)
        self.assertFalse([x for x in found if "rests by" in x or "not feas" in x])

    def test_no_method_under_the_name_of_another(self) -> None:
        """Senders and Randolph take their forces from a cone: without one, the cone
        is assumed, and everything that rests on it says so."""
        name = "required, Senders & Randolph (2009)"
        self.assertNotIn(name, self.drawn(SITE))
        self.assertIn(f"{name} (cone ASSUMED)", self.drawn(SITE))
        cone = Profile([0, 10], [0, 10e6])
        self.assertIn(name, self.drawn(SITE._replace(cone=cone)))
        design.write(self.path / "design.csv", self.write(synthetic()))
        self.assertNotIn("senders_randolph_Pa", self.design()[0])

    def test_required_and_critical_look_different(self) -> None:
        """Bands in the color of the method, and thin lines of other colors."""
        drawn = self.drawn(SITE._replace(cone=Profile([0, 10], [0, 10e6])))
        critical = {
            line.get_color() for name, line in drawn.items() if "critical" in name
        }
        self.assertEqual(len(critical), 1)
        self.assertTrue(critical.isdisjoint({*charts.COLOR_OF.values(), charts.GREEN}))
        for name in ("Houlsby & Byrne (2005)", "Senders & Randolph (2009)"):
            self.assertTrue(hasattr(drawn[f"required, {name}"], "get_facecolor"))
        self.assertIn("critical, Senders & Randolph (2009)", drawn)
        self.assertIn(f"required, {theory.LOWER_BOUND}", drawn)

    def test_band_ends_at_the_critical_suction(self) -> None:
        """At 4.5 m K tan(delta) = 0.8 has no suction, and 0.45 still has one."""
        answers = methods.answers_of(SITE, np.array([3.0, 4.5]))
        high = answers.suctions[methods.HIGH]
        _, upper = answers.required[0].band
        self.assertTrue(np.isnan(high[1]) and np.isfinite(high[0]))
        self.assertEqual(upper[0], high[0])
        self.assertEqual(upper[1], answers.suctions[methods.PIPING][1])
        self.assertIn("continues to the critical", suction.caption(answers, SITE))

    def test_entries_of_the_scene(self) -> None:
        """Those of the options of the report, in pictures and words."""
        given = {
            "k_tan_delta_inside": [0.5, 0.6],
            "k_tan_delta_outside": [0.7, 0.7],
            "plug_permeability_ratio": 3,
            "load_spread": None,
        }
        site, h = theory.Site({**SCENE, "design_methods": given}), 3.0
        answers = methods.answers_of(site, np.array([h]))
        for name, k_in in zip(methods.RANGE, (0.5, 0.6)):
            caisson = Caisson(*GEOMETRY, k_tan_delta=(k_in, 0.7))
            s = installation.required_suction(caisson, WEIGHT, h, 3)
            self.assertAlmostEqual(answers.suctions[name][0], s)
        piping = seepage.houlsby_byrne(GAMMA, h, D, 3)
        self.assertAlmostEqual(answers.suctions[methods.PIPING][0], piping)
        words = suction.caption(answers, site)
        self.assertIn("0.5 to 0.6 inside and 0.7 outside, no stress", words)
        self.assertIn("outside k_f\N{NO-BREAK SPACE}= 3", words)
        words = suction.caption(answers, SITE)
        self.assertIn("0.45 to 0.8 on both walls, stress enhancement", words)

    def test_cone_test_of_the_command_line(self) -> None:
        """It is kept where it is good; a wrong one is named with its row."""
        self.write(synthetic())
        file = self.path / "mine.csv"
        parser = argparse.ArgumentParser()
        plot.add_arguments(parser)
        options = parser.parse_args(["--cpt", str(file), str(self.path)])
        file.write_text("depth_m,qc_MPa\n0,0\n1,x\n", encoding="utf-8")
        with mock.patch("builtins.print") as printed:
            self.assertEqual(plot.main(options), 1)
        self.assertRegex(
            printed.call_args.args[0], "^plot: .*mine.csv, row 3: 'x' is no number"
        )
        self.assertFalse((self.path / "cone.csv").exists())
        file.write_text("depth_m,qc_MPa\n0,0\n9,18\n", encoding="utf-8")
        self.assertEqual(plot.main(options), 0)
        self.assertTrue((self.path / "cone.csv").exists())
        self.assertGreater(float(self.design()[9]["andersen_high_tip_N"]), 0)

    def test_no_caisson_that_goes_down(self) -> None:
        """A cone, and a caisson that is pulled out, have no design.csv."""
        path = self.path / "design.csv"
        self.assertIsNone(design.write(path, self.write(synthetic(), diameter_m=None)))
        history = synthetic()
        history["penetration_m"] = history["penetration_m"][::-1]
        self.assertIsNone(design.write(path, self.write(history)))
        self.assertFalse(path.exists())

    def test_body_at_rest_has_neither_file(self) -> None:
        history = synthetic()
        history["penetration_m"][:] = 1.0
        run = self.write(history)
        self.assertEqual(suction.draw(self.path, run), [])
        self.assertIsNone(design.write(self.path / "design.csv", run))

    def test_clay_says_why(self) -> None:
        run = self.write(synthetic(), layers=[{**SAND, "cohesion_Pa": 5e3}])
        self.assertEqual(len(suction.draw(self.path, run)), 1)
        design.write(self.path / "design.csv", run)
        row = self.design()[10]
        self.assertEqual({row[name] for name in methods.METHODS}, {""})
        self.assertAlmostEqual(float(row["required_suction_Pa"]), -5e3)
        answers = methods.answers_of(theory.site_of(run), np.array([1.0]))
        text = suction.caption(answers, theory.site_of(run))
        self.assertEqual(text, "no design methods: layer 1 has cohesion")

    def test_file_without_weight_says_why(self) -> None:
        run = self.write(synthetic(), submerged_weight_N=None)
        answers = methods.answers_of(theory.site_of(run), np.array([1.0]))
        self.assertIn("submerged_weight_N", answers.why_not)

    def test_way_back_is_left_out(self) -> None:
        history = synthetic()
        back = {name: np.append(column, -9.0) for name, column in history.items()}
        depth = design.depths_of(back)
        np.testing.assert_allclose(depth, design.depths_of(history))
        expected = 1e4 * (np.maximum(depth, history["penetration_m"][1]) - REST)
        np.testing.assert_allclose(design.suction_at(back, depth), expected, atol=1e-6)


if __name__ == "__main__":
    unittest.main()
