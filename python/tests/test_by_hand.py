# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a scene before any run, against calculations by hand."""
import json
import re
import shutil
import tempfile
import unittest
from collections.abc import Callable, Mapping
from math import atan, exp, pi, radians, tan
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
from synthetic import write_columns, write_run

from caisson.evaluation import HEAVE, rest_of_run
from caisson.report import before, low_and_high, methods, page, verdict
from caisson.results import Results, ResultsError
from caisson.runner import FAILS
from caisson.verdict import by_hand, outcome, run_review, suction_methods
from caisson.verdict.installation import Rate

D, T, LENGTH, END = 8.0, 0.04, 9.0, 8.0
INNER = D - 2 * T
AREA, TIP, WALLS = pi / 4 * INNER**2, pi * (D - T) * T, pi * (D + INNER)
WATER = 9810.0  # N/m3
PUMP = {"Water/Largest suction": "20e3"}
QC = 2e6  # Pa, of the cone test
SCENE: dict[str, Any] = {
    "diameter_m": D,
    "wall_thickness_m": T,
    "skirt_length_m": LENGTH,
    "initial_penetration_m": 0.5,
    "inner_wall_friction_angle_deg": 24.0,
    "outer_wall_friction_angle_deg": 24.0,
    "inner_wall_adhesion_Pa": 0.0,
    "outer_wall_adhesion_Pa": 0.0,
}
SAND: dict[str, Any] = {
    "law": "Mohr-Coulomb",
    "submerged_unit_weight_N_m3": 10e3,
    "K0": 0.5,
    "friction_angle_deg": 35.0,
    "cohesion_Pa": 0.0,
    "permeability_m_s": 1e-4,
    "law_entries": [],
}
CLAY: dict[str, Any] = {
    **SAND,
    "submerged_unit_weight_N_m3": 8e3,
    "friction_angle_deg": 0.0,
    "cohesion_Pa": 40e3,
    "wall_adhesion_Pa": 20e3,
    "permeability_m_s": 1e-9,
}


def bisected(
    force: Callable[..., float], weight: float, *more: float, end: float = END
) -> float:
    """Return the depth (m) above an end at which a force is a weight; more: of its
    arguments."""
    low, high = 0.0, end
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if force(middle, *more) < weight else (low, middle)
    return low


def in_clay(h: float, n_c: float) -> float:
    """Return the resistance in clay alone (N)."""
    return WALLS * 20e3 * h + TIP * (8e3 * h + n_c * 40e3)


def by_cone(h: float, tip: float, wall: float) -> float:
    """Return the resistance (N) by coefficients of q_c."""
    return TIP * tip * QC + WALLS * wall * QC * h


def senders(c: float) -> float:
    """Return k_f of Senders & Randolph."""
    return float(c * (1 - (INNER / D) ** 2) ** 0.3 * tan(radians(24)))


def houlsby(h: float, k: float) -> tuple[float, float, float]:
    """Return tip, inner and outer friction (N) by Houlsby & Byrne, with enhanced
    stress, K tan(delta) = k and m = 1.5."""
    stress, friction = [], []
    for diameter, z in ((INNER, INNER / 4 / k), (D, D * (1.5**2 - 1) / 4 / k)):
        growth = exp(h / z) - 1
        stress.append(10e3 * z * growth)
        friction.append(k * pi * diameter * 10e3 * z**2 * (growth - h / z))
    n_q = exp(pi * tan(radians(35))) * tan(radians(62.5)) ** 2
    n_gamma, (outer, inner) = 34.476, sorted(stress)
    x = T / 2 + (inner - outer) * n_q / (4 * 10e3 * n_gamma)
    if x < T:
        end = inner * n_q + 10e3 * n_gamma * (T - 2 * x**2 / T)
    else:
        end = outer * n_q + 10e3 * T * n_gamma
    return TIP * end, friction[0], friction[1]


def parts_in_sand(h: float) -> np.ndarray:
    """Return tip, inner and outer friction (N) of both cases of Houlsby & Byrne, DNV
    and Senders & Randolph: [6, 3]."""
    found = [houlsby(h, k) for k in (0.45, 0.8)]
    for tip, wall in (
        *((0.3, 0.001), (0.6, 0.003)),
        *((0.2, senders(0.012)), (0.2, senders(0.03 / 2**0.5))),
    ):
        inner, outer = (wall * QC * pi * d * h for d in (INNER, D))
        found.append((tip * QC * TIP, inner, outer))
    return np.array(found)


def suction_in_sand(h: float, parts: np.ndarray, weight: float) -> float:
    """Return the suction (Pa) of which Senders & Randolph relieve tip and inner
    friction."""
    angle = atan(5 * (h / D) ** 0.85)
    critical = 10e3 * h * (pi - angle * (2 - 2 / pi))
    found = (parts.sum() - weight) / (AREA + parts[:2].sum() / critical)
    return float(found if found < critical else (parts[2] - weight) / AREA)


class Scene(unittest.TestCase):
    """A scene of which the program has made a step."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)

    def scene(
        self,
        *layers: dict[str, Any],
        weight: float | None = 2e6,
        cone: bool = True,
        assumed: str = "",
        body: Mapping[str, float] = {},
    ) -> by_hand.ByHand:
        """Return it with layers of soil, and a cone test of 2 MPa. assumed: an entry
        that the scene marks so; body: sizes of its wall."""
        first = {"penetration_m": 0.5, "time_s": 0.0}
        scene: dict[str, Any] = {**SCENE, **body, "layers": list(layers)}
        scene["boiling_suction_at_mudline_Pa"] = 3e5 + 8.5 * WATER
        if weight:
            scene["submerged_weight_N"] = weight
        warnings = [
            {"rank": "result", "text": "no rest"},
            {"rank": "input", "text": "x"},
        ]
        summary = {
            "title": "own, on a mesh for an error of about 20 %",
            "scene_file": "own.prm",
            "version": "0",
            "dealii_version": "9",
            "cells": 1,
            "steps": 1,
            "status": "finished",
            "entries": {"Time/End penetration": str(END), "Time/End time": "1e-9"},
            "results": {"warnings": warnings},
            "assumed": [assumed],
            "scene": scene,
            "tip": {"width_m": T, "initial_penetration_m": 0.5},
        }
        write_run(self.path, {k: np.array([v]) for k, v in first.items()}, summary)
        if cone:
            rows = "depth_m,qc_MPa\n0,2\n20,2\n"
            (self.path / "cone.csv").write_text(rows, encoding="utf-8")
        facts = {"scene_file": "own.prm", "cost": "about 2 min", "next": "run own.prm"}
        return by_hand.band_of({"best": by_hand.ByHand(self.path, facts=facts)})

    def rest_of(self, run: Results) -> float:
        """Return its penetration by weight (m)."""
        rest = rest_of_run(run.history)
        assert rest is not None
        return rest

    def text(self, run: Results) -> str:
        """Return the words and numbers of its page."""
        found = page.html(run, Rate()).partition('<script type="application/json"')[0]
        found = re.sub(r"<style>.*?</style>", "", found, flags=re.S)
        return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", found))

    def row(self, run: Results, begin: str) -> list[str]:
        """Return the cells of a row of the table of methods."""
        found = outcome.whole_way(run)
        assert found is not None
        rows = methods.overview(run, found, END)["rows"]
        return next(row[1:] for row in rows if row[0].startswith(begin))


class Clay(Scene):
    """Uniform clay."""

    def test_forces_and_suction(self) -> None:
        """Strip and circle: N_c of 7.5 and 9; the best estimate has 8.25."""
        run, at = self.scene(CLAY), np.array([2.0, 5.0, 8.0])
        for (estimate, member), n_c in zip(run.estimates.items(), (7.5, 8.25, 9.0)):
            assert member.by_hand is not None
            found = member.by_hand(at)
            for h, force, s in zip(
                at, found["total_force_N"], found["required_suction_Pa"]
            ):
                expected = in_clay(h, n_c)
                self.assertAlmostEqual(force / expected, 1, places=9, msg=estimate)
                self.assertAlmostEqual(s / ((expected - 2e6) / AREA), 1, places=9)
            rest = bisected(in_clay, 2e6, n_c)
            self.assertAlmostEqual(self.rest_of(member), rest, places=5)

    def test_page(self) -> None:
        """Its numbers are those of a calculation by hand."""
        run = self.scene(CLAY)
        text, rest = self.text(run), bisected(in_clay, 2e6, 8.25)
        self.assertIn(f"Self-weight penetration {rest:.2f} m", text)
        needs = (in_clay(8, 8.25) - 2e6) / AREA / 1e3
        self.assertIn("By hand methods, not computed: feasible to 8 m", text)
        self.assertIn(f"suction up to {needs:.3g} kPa", text)
        adhesion = 4 / INNER * 20e3 * 8
        reverse = (6 * (1 + 0.2 * 8 / D) * 40e3 + adhesion) / 1.5 / 1e3
        self.assertRegex(
            text, rf"reverse bearing of the plug, factor 1.5.*? {reverse:.0f} "
        )
        boils = (3e5 + WATER * (8 - 0.5)) / 1e3
        self.assertRegex(text, rf"water boils .*? {boils:.0f} ")
        heave = TIP / AREA * (0.5 * rest + (8 - rest))
        self.assertIn(f"heave of the plug {heave:.2f} m", text)
        self.assertNotIn("without loosening of the sand", text)
        self.assertIn(f"Room below the lid {LENGTH - 8 - heave:.2f} m", text)
        self.assertIn("Nothing is computed yet", text)
        self.assertIn("It takes about 2 min: run own.prm", text)
        for words in ("Status:", "Error bar not known", "Pictures", "of the run (kN)"):
            self.assertNotIn(words, text)

    def test_table_of_methods(self) -> None:
        """Low to high; DNV from the cone stands beside them."""
        run = self.scene(CLAY)
        ends = [in_clay(8, n_c) for n_c in (7.5, 9.0)]
        rests = [bisected(in_clay, 2e6, n_c) for n_c in (9.0, 7.5)]
        rest, force, plain, needs = self.row(run, "Strength of clay")
        self.assertEqual(force, " to ".join(f"{x / 1e3:.0f}" for x in ends))
        suctions = [f"{(x - 2e6) / AREA / 1e3:.3g}" for x in ends]
        self.assertEqual((plain, needs), (" to ".join(suctions),) * 2)
        self.assertEqual(rest, " to ".join(f"{x:.3g}" for x in rests))
        _, force, _, needs = self.row(run, "DNV *")
        ends = [by_cone(8, 0.4, 0.03), by_cone(8, 0.6, 0.05)]
        self.assertEqual(force, " to ".join(f"{x / 1e3:.0f}" for x in ends))
        self.assertEqual(needs, "-")


class Sand(Scene):
    """Uniform sand, with a cone test."""

    def test_forces_and_suction(self) -> None:
        """The mean of all cases of three methods, the least and the most of them."""
        run, at = self.scene(SAND, weight=1.25e6), np.array([2.0, 5.0, 8.0])
        suctions = suction_methods.answers_of(run.site, at).suctions
        for estimate, member in run.estimates.items():
            assert member.by_hand is not None

            def parts(h: float, which: str = estimate) -> np.ndarray:
                every = parts_in_sand(h)
                cases = every[::2] if which == "low" else every[1::2]
                total = cases.sum(axis=1)
                if which == "best":
                    return np.asarray(every.mean(axis=0))
                return np.asarray(
                    cases[total.argmin() if which == "low" else total.argmax()]
                )

            found = member.by_hand(at)
            for i, h in enumerate(at):
                expected = parts(h)
                for column, part in zip(by_hand.COLUMNS, expected):
                    self.assertAlmostEqual(found[column][i] / part, 1, places=3)
                s = suction_in_sand(h, expected, 1.25e6)
                if estimate == "high":  # as the table of methods has it
                    s = max(s, suctions[suction_methods.HIGH][i])
                if s > 0:
                    ratio = found["required_suction_Pa"][i] / s
                    self.assertAlmostEqual(ratio, 1, places=3, msg=estimate)
            rest = bisected(lambda h: float(parts(h).sum()), 1.25e6)
            self.assertAlmostEqual(self.rest_of(member), rest, places=3)

    def test_piping_in_the_high_case(self) -> None:
        """High resistance ends where Houlsby & Byrne find none below piping."""
        run = self.scene({**SAND, "friction_angle_deg": 38.0}, weight=0.5e6)
        needed = suction_methods.answers_of(run.site, np.array([END])).suctions
        self.assertTrue(np.isnan(needed[suction_methods.HIGH][0]))
        high = run.estimates["high"]
        assert high.by_hand is not None
        s = high.by_hand(np.array([END]))["required_suction_Pa"][0]
        piping = 10e3 * END / (1 - (0.45 - 0.36 * (1 - exp(-END / D / 0.48))))
        self.assertGreaterEqual(s, piping * (1 - 1e-9))
        end = outcome.end_of(high)
        assert end is not None
        self.assertLess(end[0], END)

    def test_flow(self) -> None:
        """k (1 - a) s A / (gamma_w h), and s over gamma' h / (1 - a)."""
        run = self.scene(SAND, weight=1.25e6)
        found = run.columns_at(np.array([4.0]))
        left = 1 - (0.45 - 0.36 * (1 - exp(-0.5 / 0.48)))
        s = found["required_suction_Pa"][0]
        flow = 1e-4 * left * s * AREA / (WATER * 4)
        self.assertAlmostEqual(found["seepage_flow_m3_s"][0] / flow, 1, places=3)
        share = s / (10e3 * 4 / left)
        name = "exit_gradient_over_critical"
        self.assertAlmostEqual(found[name][0] / share, 1, places=9)

    def test_flow_of_a_loosened_plug(self) -> None:
        """k_f = 3 at h = D/2: a_1 = 0.21703 gives a = 0.65109 / (0.78297 + 0.65109) =
        0.45402, and 3e-4 (1 - a) 1 kPa 49.27 m2 / 39.24 kPa are 0.20566 l/s."""
        text = '{"plug_permeability_ratio": 3}'
        (self.path / "design_methods.json").write_text(text, encoding="utf-8")
        run = self.scene(SAND, weight=1.25e6)
        found = run.flow_at(np.array([4.0]), np.array([1e3]))["seepage_flow_m3_s"]
        np.testing.assert_allclose(found, 0.20566e-3, rtol=1e-4)

    def test_table_of_methods(self) -> None:
        """DNV and the unified method without flow, too: (R - W) / A."""
        run = self.scene(SAND, weight=1.25e6)
        area_ratio = (1 - (INNER / D) ** 2) ** 0.3
        walls = [area_ratio * tan(radians(x)) / 44 for x in (27.1, 32.1)]
        for name, ends in {
            "DNV": [by_cone(8, 0.3, 0.001), by_cone(8, 0.6, 0.003)],
            "ISO 19901-4 (unified), for piles *": [by_cone(8, 0.5, x) for x in walls],
        }.items():
            _, force, plain, needs = self.row(run, name)
            self.assertEqual(force, " to ".join(f"{x / 1e3:.0f}" for x in ends), name)
            suctions = [f"{(x - 1.25e6) / AREA / 1e3:.3g}" for x in ends]
            self.assertEqual(plain, " to ".join(suctions), name)
            self.assertNotEqual(needs, "-")
        mean = parts_in_sand(8).mean(axis=0).sum()
        self.assertEqual(self.row(run, "best")[1], f"{mean / 1e3:.0f}")

    def test_what_does_not_count(self) -> None:
        """An assumed cone beside a model."""
        run = self.scene(SAND, cone=False)
        for depth, n in ((0.5, 1), (8.0, 3)):
            found = by_hand.answers_of(run.site, np.array([depth]))
            self.assertEqual(len(found), n)


class Page(Scene):
    """What it is not."""

    def test_records(self) -> None:
        """What the one step has said and set is not on it, and no verdict.json."""
        run = self.scene(SAND)
        self.assertEqual(run_review.warnings_of(run)["result"], [])
        self.assertEqual(run_review.warnings_of(run)["input"], ["x"])
        self.assertNotIn("Time/End time", self.text(run))
        self.assertIn("Computed: nothing yet", self.text(run))
        self.assertFalse((self.path / verdict.NAME).exists())

    def test_low_and_high_in_one_soil(self) -> None:
        """The page says that the soil is not varied, and does not where it is."""
        words, adhesion = "Both are of the methods, in one soil", "with one adhesion"
        clay = self.text(self.scene({**CLAY, "total_stress": True}))
        self.assertIn(f"{words} {adhesion} factor alpha", clay)
        run = self.scene(SAND)
        self.assertIn(f"{words}: --low", self.text(run))
        other = self.path / "high"
        shutil.copytree(self.path, other)
        members = {"best": run, "high": by_hand.ByHand(other)}
        self.assertNotIn(words, self.text(by_hand.band_of(members)))

    @mock.patch("builtins.print")
    def test_high_resistance_of_another_soil(self, said: mock.Mock) -> None:
        """One that has less than the best one is none of the band, nor run with it."""
        high = self.path / "high"
        self.scene({**SAND, "friction_angle_deg": 28.0})
        shutil.copytree(self.path, high)
        best = by_hand.ByHand(self.scene(SAND).directory, facts={"scene_file": "a.prm"})
        text = before.page_of({"best": best, "high": by_hand.ByHand(high)})
        words = (
            "The soil of high resistance is left out, as a_high.prm has less resistance"
            " than the best estimate from 0.05 m to 8 m: change its scene as a.prm was"
            " changed, and then `caisson run --band a.prm`."
        )
        self.assertTrue(words in text and "run a.prm</code>" in text)
        self.assertIn(words, said.call_args.args[0])

    def test_assumed_permeability(self) -> None:
        """Pump and flow at which to stop say so; that a given one follows the void
        ratio may be assumed without a word."""
        for name, is_said in ("Permeability by void ratio", False), ("Permeability", 1):
            run = self.scene(SAND, weight=1.25e6, assumed=f"Soil/Layer 1/{name}")
            text = self.text(run)
            for words in ("(permeability ASSUMED)", "; permeability ASSUMED: compare"):
                self.assertEqual(words in text, bool(is_said), name)

    def test_assumed_water_depth(self) -> None:
        """The limit by boiling says so: 300 kPa at 0.5 m are 373.6 at 8 m."""
        words = "water boils, of a water depth that is ASSUMED"
        self.assertNotIn(words, self.text(self.scene(CLAY)))
        run = self.scene(CLAY, assumed="Water/Water depth")
        self.assertRegex(self.text(run), rf"{words} (\S+ ){{3}}374 ")

    def test_six_curves(self) -> None:
        """At first sight, with what is behind the end of these."""
        html = page.html(self.scene(SAND), Rate())
        data = re.search(
            r'<script type="application/json" id="data">(.*?)</script>', html
        )
        assert data is not None
        for figure in json.loads(data[1])["figures"]:
            seen = [c for c in figure["curves"] if not c.get("hidden")]
            seen = [c for c in seen if "not feasible" not in c["label"]]
            self.assertLessEqual(len(seen), 6)
            self.assertIn("best by hand", " ".join(c["label"] for c in seen))

    def test_jacked(self) -> None:
        run = self.scene(CLAY, weight=None)
        force = in_clay(8, 8.25) / 1e6
        said = f"By hand methods, not computed: jacked to 8 m: {force:.3g} MN"
        self.assertIn(said, self.text(run))

    def test_where_it_ends(self) -> None:
        """A light caisson meets piping; what would help is known at the planned depth,
        though another layer begins above it."""
        layer = {**SAND, "top_depth_m": 7.0, "K0": 0.6}
        run = self.scene(SAND, layer, weight=1e5)
        text = self.text(run)
        self.assertRegex(text, r"By hand methods, not computed: feasible to \S+ m")
        self.assertNotIn("another layer begins", text)
        self.assertIn("without loosening of the sand", text)
        self.assertRegex(text, r"about \S+ kN of weight in all")

    def test_beside_a_run(self) -> None:
        """A pump of 20 kPa ends where (R - W) / A has it. The page of a run in which
        the soil bears twice as much says so, and that of one that agrees does not."""
        self.scene(CLAY)
        file = self.path / "run.json"
        summary = json.loads(file.read_text("utf-8"))
        summary["entries"] = {**PUMP, "Time/End penetration": str(END)}
        file.write_text(json.dumps(summary), "utf-8")
        depth = np.linspace(0.5, END, 76)
        hand = bisected(in_clay, 2e6 + 20e3 * AREA, 8.25)
        own = bisected(lambda h: 2 * in_clay(h, 8.25), 2e6 + 20e3 * AREA)
        for factor in (2, 1):
            total = factor * np.array([in_clay(h, 8.25) for h in depth])
            required = (total - 2e6) / AREA
            columns = {
                "time_s": depth,
                "penetration_m": depth,
                "total_force_N": total,
                "required_suction_Pa": required,
                "suction_Pa": np.maximum(required, 0),
                HEAVE: 0 * depth,
            }
            shares = {"tip_force": 2, "inner_friction": 1, "outer_friction": 1}
            columns |= {f"{name}_N": total * x / 4 for name, x in shares.items()}
            write_columns(self.path / "history.csv", columns)
            run = Results(self.path)
            said = low_and_high.sentence_of(run)
            if factor == 2:
                self.assertAlmostEqual(verdict.verdict_of(run).end or 0, own, delta=0.1)
                form = r"feasible to (\S+) m, but the run needs up to (\S+) kPa down to"
                ((depths, needs),) = re.findall(form, said)
                self.assertAlmostEqual(float(depths), hand, delta=0.1)
                there = (2 * in_clay(float(depths), 8.25) - 2e6) / AREA / 1e3
                self.assertAlmostEqual(float(needs) / there, 1, delta=0.03)
            else:
                self.assertNotIn("By hand methods", said)

    def test_unknown_ground(self) -> None:
        """What no method knows is named."""
        run = self.scene({**SAND, "law": "Modified Cam clay"})
        with self.assertRaisesRegex(ResultsError, "layer 1 is Modified Cam clay"):
            page.html(run, Rate())

    @mock.patch("caisson.report.before.query", return_value=f"warning: {FAILS}: why")
    def test_scene_that_does_not_run(self, _: mock.Mock) -> None:
        """It has no page, and what the program says is the message."""
        with self.assertRaisesRegex(ResultsError, f"{FAILS}: why"):
            before.html(self.path / "a.prm", Rate(), lambda _: None)

    def test_run_that_has_hardly_begun(self) -> None:
        """Its page is that of the scene, until the caisson goes down."""
        run = self.scene(CLAY)
        summary = json.loads((self.path / "run.json").read_text(encoding="utf-8"))
        summary |= {"status": "running", "progress": {"fraction_done": 0.001}}
        (self.path / "run.json").write_text(json.dumps(summary), encoding="utf-8")
        text = self.text(Results(run.directory))
        self.assertIn("By hand methods, not computed: feasible to 8 m", text)
        self.assertNotIn("Nothing is computed yet", text)

    def test_run_after_an_installation(self) -> None:
        """A run that goes up, or on from another one, is no installation."""
        run = self.scene(CLAY)
        summary = json.loads((self.path / "run.json").read_text(encoding="utf-8"))
        summary |= {"status": "running", "progress": {"fraction_done": 0.5}}
        for entry, value in (
            ("Rigid body/Velocity", "-0.02"),
            ("Installation/Directory", "results/before"),
        ):
            summary["entries"] = {entry: value, "Time/End penetration": "8"}
            (self.path / "run.json").write_text(json.dumps(summary), encoding="utf-8")
            text = self.text(Results(run.directory))
            self.assertNotIn("By hand methods", text)
            self.assertIn("50 % done", text)


if __name__ == "__main__":
    unittest.main()
