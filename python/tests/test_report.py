# SPDX-License-Identifier: LGPL-2.1-or-later
"""report.html of made-up runs, as text and in a browser."""
import argparse
import contextlib
import fcntl
import html
import io
import json
import os
import re
import subprocess
import tempfile
import unittest
import unittest.mock as mock
from pathlib import Path
from typing import Any

import numpy as np
from synthetic import write_columns, write_run

import caisson.report as report
from caisson.results import Results, ResultsError
from caisson.design import reasons
from caisson.design.seepage import senders_randolph
from caisson.verdict import limits
from caisson.report import content, methods
from caisson.verdict import installation

BROWSER = report.find_browser()
SCENE: dict[str, Any] = {
    "diameter_m": 10.0,
    "wall_thickness_m": 0.04,
    "inner_wall_friction_angle_deg": 20,
    "outer_wall_friction_angle_deg": 20,
    "layers": [
        {
            "top_depth_m": 0,
            "law": "Mohr-Coulomb",
            "submerged_unit_weight_N_m3": 9000.0,
            "K0": 0.5,
            "friction_angle_deg": 32,
            "cohesion_Pa": 0,
        }
    ],
    "submerged_weight_N": 1e6,
    "cavitation_suction_Pa": 394e3,
}
RATIO = "Computed / method: required"
SUMMARY: dict[str, Any] = {
    "version": "0.1.0",
    "dealii_version": "9.4.1",
    "scene_file": "mine.prm",
    "title": "sand <b>& silt",
    "status": "finished",
    "cells": 5000,
    "material_points": 60000,
    "steps": 40000,
    "time_step_s": 1e-3,
    "time_step_limit": "the cell at the tip",
    "ranks": 2,
    "wall_time_s": 63.0,
    "peak_memory_bytes": 3e8,
    "fingerprint": "f00d",
    "max_points_in_body": 0,
    "energies": {"energy_residual": 0.004},
    "results": {"warnings": [{"rank": "result", "text": "the suction lifts the plug"}]},
    "entries": {"Rigid body/Outer diameter": "10"},
    "scene": SCENE,
}
# What a user does, and what the page then shows: put into the title.
VISIT = """
<script>
const shown = [];
HTMLAnchorElement.prototype.click = function () { shown.push(this.download); };
const hover = (section) => {
  const overlay = section.querySelector("canvas.flot-overlay");
  const box = overlay.getBoundingClientRect();
  const at = { bubbles: true, clientX: box.left + 0.5 * box.width,
               clientY: box.top + 0.5 * box.height };
  overlay.dispatchEvent(new MouseEvent("mousemove", at));
};
const section = document.getElementById("suction");
hover(section);
section.querySelector("[data-do=csv]").click();
section.querySelector("[data-do=png]").click();
const boxes = section.querySelectorAll(".legend input");
shown.push("curves " + boxes.length);
setTimeout(() => {
  shown.push(section.querySelector(".value").textContent);
  document.title = shown.join("; ");
}, 1000);
</script>
"""


def leave_run(path: Path, summary: dict[str, Any] | None) -> None:
    """Leave what a run of a caisson with suction leaves; without run.json, and with
    its lock, it still runs."""
    depth = np.linspace(0.5, 4.5, 401)
    table = {"time_s": depth, "penetration_m": depth}
    for name, share in (("total", 1.0), ("tip", 0.5)):
        table[f"{name}_force_N"] = 1e6 * share * depth
    for name in ("inner", "outer"):
        table[f"{name}_friction_N"] = 0.25e6 * depth
    table["external_work_J"] = 1e6 * depth
    table["kinetic_energy_J"] = 1e3 * np.ones(len(depth))
    table["required_suction_Pa"] = 1e4 * (depth - 1.5)
    table["suction_Pa"] = np.maximum(table["required_suction_Pa"], 0)
    table["exit_gradient_wall"] = table["exit_gradient_axis"] = 0.1 * depth
    table["critical_gradient"] = 0.9 * np.ones(len(depth))
    table["plug_heave_m"] = 0.05 * depth
    table["pumped_volume_m3"] = table["seepage_volume_m3"] = depth
    write_run(path, table, summary)


class WithPage(unittest.TestCase):
    """A made-up run, and its page: without pictures, which take seconds, unless a test
    stops `no_pictures`."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        self.no_pictures = mock.patch("caisson.report.page.plot.draw")
        self.no_pictures.start()
        self.addCleanup(self.no_pictures.stop)

    def page(self, summary: dict[str, Any] | None = None) -> str:
        leave_run(self.path, summary)
        return report.write(self.path).read_text(encoding="utf-8")


class Report(WithPage):
    """The page of a run."""

    def test_all_is_in_the_page(self) -> None:
        """Nothing is loaded from elsewhere, and a title cannot break the page."""
        self.no_pictures.stop()
        page = self.page(SUMMARY)
        tags = re.findall("<(?!script>)[a-z][^>]*>", page.split("<script", 1)[0])
        links = re.findall(r"""(?:src|href)=["']?([^"' >]{1,20})""", "".join(tags))
        self.assertTrue(links)
        for link in links:
            self.assertTrue(link.startswith("data:"), link)
        self.assertTrue("sand &lt;b&gt;&amp; silt" in page)
        for text in (
            "the suction lifts the plug",
            "Rigid body/Outer diameter",
            "Energy error: 0.4 % of the work, of the steps in time alone",
            "deal.II 9.4.1",
        ):
            self.assertTrue(text in page, text)
        self.assertNotIn('http-equiv="refresh"', page)
        self.assertNotIn(str(self.path), page)  # the disk of a user is no result

    def test_old_pictures_are_drawn_again(self) -> None:
        """Those of before a run that went on by --restart; not newer ones."""
        leave_run(self.path, SUMMARY)
        (self.path / "forces.png").touch()
        for at, is_drawn in ((0, True), (2**32, False)):
            os.utime(self.path / "forces.png", (at, at))
            with mock.patch("caisson.report.page.plot.draw") as draw:
                report.write(self.path)
            self.assertEqual(draw.called, is_drawn)

    def test_paper_has_no_defaults(self) -> None:
        """They are folded, and what is not to be printed is not opened for it."""
        page = self.page({**SUMMARY, "defaults": {"Water/Level": "drained"}})
        folded = r"<details>\s*<summary>Entries that have their defaults"
        self.assertRegex(page, folded)
        self.assertIn('querySelectorAll("details.print")', page)
        self.assertIn("counter(page)", page)

    def installation(self) -> installation.Installation:
        """Return the numbers of the run."""
        found = installation.installation_of(Results(self.path), installation.Rate())
        assert found is not None
        return found

    def test_unit_resistances(self) -> None:
        """4 MN at 4 m are 2 MN on a tip of 1.2516 m2, and 1 MN on each side."""
        leave_run(self.path, SUMMARY)
        table = content.unit_table(Results(self.path))
        row = dict(zip(table["heads"], table["rows"][6]))
        self.assertEqual(row["tip depth (m)"], "4")
        self.assertEqual(row["tip (kPa)"], "1598")
        friction = "mean {} friction over the embedded wall (kPa)"
        self.assertEqual(row[friction.format("inner")], "8.02")
        self.assertEqual(row[friction.format("outer")], "7.96")

    def test_unit_resistances_of_a_run_that_pulls(self) -> None:
        """-3 MN at 3 m on the way from 4.5 to 0.5 m, on the tip of 1.2516 m2."""
        depth = np.linspace(4.5, 0.5, 401)
        table = {"time_s": 4.5 - depth, "penetration_m": depth}
        for name in ("total", "tip"):
            table[f"{name}_force_N"] = -1e6 * depth
        for name in ("inner", "outer"):
            table[f"{name}_friction_N"] = np.zeros(len(depth))
        table["kinetic_energy_J"] = table["external_work_J"] = np.ones(len(depth))
        write_run(self.path, table, SUMMARY)
        found = content.unit_table(Results(self.path))
        rows = {row[0]: row for row in found["rows"]}
        self.assertEqual(rows["3"][1], "-2397")
        self.assertNotIn("installation by depth", report.write(self.path).read_text())

    def test_installation_by_depth(self) -> None:
        """Each half meter and the end; at 4 m 25 kPa are required, the exit gradient is
        0.4 of 0.9, and so critical at 56.25 kPa; the lid of 77.28 m2 displaces 1.05
        times its way, as the plug heaves, and nothing seeps."""
        skirt = {**SCENE, "skirt_length_m": 5.0}
        entries = {"Water/Largest suction": "20e3"}
        leave_run(self.path, {**SUMMARY, "scene": skirt, "entries": entries})
        takes, margins = installation.tables_of(self.installation())
        depths = [row[0] for row in takes["rows"]]
        self.assertEqual(depths, ["1", "1.5", "2", "2.5", "3", "3.5", "4", "4.5"])
        row = dict(zip(takes["heads"], takes["rows"][6]))
        self.assertEqual(row["resistance (kN)"], "4000")
        self.assertEqual(row["required suction (kPa)"], "25")
        row = dict(zip(margins["heads"], margins["rows"][6]))
        self.assertEqual(row["allowable (kPa)"], "20")
        self.assertEqual(row["governed by"], "pump")
        self.assertEqual(row["required / allowable"], "1.25")
        self.assertEqual(row["room below the lid (m)"], "0.8")
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("Feasible to 3.5 m: there the required suction reaches the", page)
        limit = self.installation().limits[limits.COMPUTED]
        self.assertAlmostEqual(limit[6], 56.25, delta=0.1)

    def test_pump(self) -> None:
        """At 2 m/h the lid of 77.28 m2 displaces 162.3 m3/h with a plug that heaves by
        5 % of the way, and 0.01 m3/s seep."""
        leave_run(self.path, SUMMARY)
        history = dict(Results(self.path).history)
        history["seepage_flow_m3_s"] = np.full(len(history["time_s"]), 0.01)
        write_run(self.path, history, SUMMARY)
        self.assertEqual(self.command("--rate", "2", "."), 0)
        page = (self.path / report.NAME).read_text(encoding="utf-8")
        self.assertIn("198 m³/h", page)
        self.assertIn(
            "a penetration of 2 m/h, against 30.0 kPa, of which seepage 36", page
        )
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("a penetration of 1 m/h (ASSUMED)", page)
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.assertEqual(self.command("--rate", "0", "."), 1)
        self.assertIn("--rate 0: give m/h above 0", said.getvalue())

    def test_what_was_computed(self) -> None:
        """Diameter and soil are there although only one entry is no default, and
        what the scene marks as assumed is marked."""
        law = [
            {"entry": "Youngs modulus", "value": 25e6, "unit": "Pa"},
            {"entry": "Friction angle", "value": 32, "unit": "degrees"},
        ]
        scene = {**SCENE, "layers": [{**SCENE["layers"][0], "law_entries": law}]}
        assumed = ["Soil/Layer 1/Youngs modulus", "Rigid body/Tip"]
        defaults = {
            "Rigid body/Tip": "triangular",
            "Rigid body/Tip angle": "45",
            "Rigid body/Friction angle of the tip": "20",
            "Time/Inertia tolerance": "0.4",
            "Time/Mass scaling": "1",
            "Water/Level": "drained",
        }
        summary = {
            **SUMMARY,
            "entries": {"Soil/Layer 1/Youngs modulus": "25e6"},
            "units": {"Soil/Layer 1/Youngs modulus": "Pa"},
            "defaults": defaults,
            "mass_scaling": [14.6411, 2233.2],
            "scene": scene,
            "assumed": assumed,
            "scene_file": "/home/me/mine.prm",
        }
        page = self.page(summary)
        body = html.unescape(re.sub("<[^>]*>", " ", page.split("</style>")[1]))
        text = re.sub(r"\s+", " ", body)
        for words in (
            "Scene: mine.prm Computed",
            "Outer diameter 10 m",
            "Wall thickness 40 mm",
            "Weight in water 1000 kN",
            "Young's modulus 25 MPa ASSUMED",
            "Friction angle 32° ",
            "Submerged unit weight 9 kN/m³ ",
            "1 0 sand, drained φ = 32° 9 kN/m³ 0.5 25 MPa ASSUMED",
            "Shape of the tip triangular, 45° ASSUMED",
            "Friction angle of the tip 20°",
            "Use: drained, by weight and suction",
            "Soil/Layer 1/Youngs modulus 25 MPa",
            "Time/Mass scaling 15 to 2200, by Inertia tolerance 0.4",
            "D = 10 m",
            "t = 40 mm",
            "rests by weight at 1.50 m",
        ):
            self.assertIn(words, text)
        self.assertNotIn("32° ASSUMED", text)

    def test_ranks_of_warnings(self) -> None:
        """What matters for the results stands first, a remark far below."""
        ranked = [
            {"rank": "result", "text": "the suction lifts the plug"},
            {"rank": "cosmetic", "text": "the body does not come to 9 m"},
        ]
        page = self.page({**SUMMARY, "results": {"warnings": ranked}})
        first, second = page.split("The installation by depth")
        self.assertIn("the suction lifts the plug", first)
        self.assertNotIn("the body does not come to 9 m", first)
        self.assertIn("the body does not come to 9 m (no effect on", second)

    def test_run_in_progress(self) -> None:
        """Title, progress and methods are there before the end; a run that was killed
        does not go on."""
        progress = {"fraction_done": 0.25, "remaining_s": 600}
        summary = {**SUMMARY, "status": "running", "progress": progress}
        leave_run(self.path, summary)
        with (self.path / ".lock").open("w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("sand &lt;b&gt;&amp; silt", page)
        self.assertIn("Running: 25 % done, about 10 min left.", page)
        self.assertIn("Force of jacking", page)
        self.assertIn("was ended before it was finished: 25 %", self.page(summary))

    def test_run_that_failed(self) -> None:
        """Its run.json has no results; the page has the reason."""
        unknown = ("material_points", "peak_memory_bytes", "energies")
        known = {k: v for k, v in SUMMARY.items() if k not in unknown}
        reason = "Time/Time step exceeds the stability limit."
        page = self.page({**known, "status": "failed", "failure": reason})
        self.assertIn(f"Failed: {reason}", page)
        self.assertIn("5000, not known", page)

    def rows(self, found: dict[str, Any], title: str) -> list[dict[str, str]]:
        """Return the rows of a table of the design methods by heads."""
        (table,) = [t for t in found["tables"] if t["title"].startswith(title)]
        return [dict(zip(table["heads"], row)) for row in table["rows"]]

    def test_design_methods(self) -> None:
        """DNV with 2 MPa per meter and a tip of 1.2516 m2 at 3 m: 0.3 6 MPa 1.2516 m2 =
        2252.9 kN, and 0.001 9 MN/m on pi 19.92 m of wall = 563.2 kN; without a cone
        test, by a cone that is assumed, and marked."""
        leave_run(self.path, SUMMARY)
        found = methods.methods_of(Results(self.path))
        self.assertEqual(found["reasons"], [])  # nor that sand is no clay
        name = "DNV (cone ASSUMED), most probable to highest"
        self.assertIn(name, self.rows(found, "Force")[0])
        name = "Senders & Randolph (2009)"
        self.assertIn(f"{name} (cone ASSUMED)", self.rows(found, RATIO)[0])
        self.assertNotIn(name, self.rows(found, RATIO)[0])
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("The cone resistance is ASSUMED, as no cone test is given", page)
        self.assertIn("not near the mudline", page)
        self.assertIn("K tan \N{GREEK SMALL LETTER DELTA} = 0.45 to 0.8", page)
        (self.path / "cone.csv").write_text("depth_m,qc_kPa\n0,0\n3.5,7000\n")
        found = methods.methods_of(Results(self.path))
        self.assertEqual(found["reasons"], [])
        rows = self.rows(found, "Force of jacking")
        self.assertNotIn("computed", rows[2])
        self.assertEqual(rows[2]["DNV, most probable to highest"], "2816 to 6195")
        self.assertEqual(rows[3]["DNV, most probable to highest"], "")
        low = rows[3]["Houlsby & Byrne (2005), low to high"].split()[0]
        self.assertGreater(float(low), 0)
        self.assertIn("Senders & Randolph (2009)", self.rows(found, RATIO)[2])
        page = report.write(self.path).read_text()
        self.assertIn("ends at 3.5 m", page)
        self.assertNotIn("(cone ASSUMED)", page)
        self.assertIn("in the folder of the results, cone.csv", page)

    def test_computed_over_method(self) -> None:
        """3000 kN at 3 m over 2816 and 6195 kN; 15 kPa required at 3 m."""
        leave_run(self.path, SUMMARY)
        history = dict(Results(self.path).history)
        for name in [n for n in history if "suction" in n]:
            del history[name]
        write_run(self.path / "jacked", history, SUMMARY)
        for path in (self.path, self.path / "jacked"):
            (path / "cone.csv").write_text("depth_m,qc_kPa\n0,0\n3.5,7000\n")
        found = methods.methods_of(Results(self.path / "jacked"))
        row = self.rows(found, "Total force")[2]
        self.assertEqual(row["computed"], "3000")
        row = self.rows(found, "Computed / method: total")[2]
        self.assertEqual(row["DNV"], "0.48 to 1.07")
        found = methods.methods_of(Results(self.path))
        row, name = self.rows(found, "Required")[2], "Houlsby & Byrne (2005)"
        self.assertEqual(row["computed"], "15")
        ends = row[f"required, {name}, low to high"].split(" to ")[::-1]
        for text, end in zip(self.rows(found, RATIO)[2][name].split(" to "), ends):
            self.assertAlmostEqual(float(text), 15 / float(end), delta=0.02)
        self.assertGreater(float(row["critical, Houlsby & Byrne (2005)"]), 0)

    def test_ratio_in_words(self) -> None:
        """Open where the method needs no suction, or none suffices."""
        cases: list[tuple[tuple[float, float], str]] = [
            ((1, 4), "0.50 to 2.00"),
            ((2, 2), "1.00"),
            ((0, 4), "at least 0.50"),
            ((1, float("nan")), "at most 2.00"),
            ((0.1, 0.1), "20"),
            ((0, float("nan")), ""),
        ]
        for ends, words in cases:
            self.assertEqual(reasons.ratio_in_words(2, *ends), words)
        self.assertEqual(reasons.ratio_in_words(0, 1, 2), "")

    def why(self, tip: float, outer: float, change: dict[str, Any]) -> str:
        """Return why a jacked run with these forces (N) at 4 m is where it is."""
        depth = np.linspace(0.5, 4.5, 401)
        table = {"time_s": depth, "penetration_m": depth}
        parts = {"tip_force": tip, "inner_friction": 1.0e6, "outer_friction": outer}
        for name, force in parts.items():
            table[f"{name}_N"] = force * depth / 4
        table["total_force_N"] = sum(parts.values()) * depth / 4
        write_run(self.path, table, {**SUMMARY, "scene": {**SCENE, **change}})
        return methods.why_of(Results(self.path), np.array([1.0, 4.0]))

    def test_why(self) -> None:
        """The tip of 0.04 m has 1085 kN at 4 m without enhancement. On the outer wall
        of 10 m, 9000 4^2 / 2 pi 10 N are K tan(delta) = 1, and 0.182 is undisturbed."""
        plain = {"design_methods": {"load_spread": None}}
        outer = 9000 * 4**2 / 2 * np.pi * 10
        raised = self.why(1.5e6, 0.6 * outer, plain)
        self.assertIn("At 4 m the run has", raised)
        self.assertIn("leaves out the strength of the sand beside", raised)
        self.assertIn("from 0.18 in undisturbed ground to 0.60", raised)
        self.assertIn(f"{0.6 * outer / 1e3:.0f} kN (1018 to 1810) outside", raised)
        weak = self.why(1.0e6, 0.2 * outer, plain)
        self.assertNotIn("because", weak)
        self.assertIn("do not grip yet, and", weak)
        self.assertIn("is 0.20, where undisturbed ground has 0.18", weak)
        self.assertIn("grows exponentially", self.why(1.0e6, 0.6 * outer, {}))
        layers = [{**SCENE["layers"][0], "cohesion_Pa": 5e3}]
        self.assertEqual(self.why(1e6, outer, {"layers": layers}), "")

    def test_why_under_suction(self) -> None:
        """The method's forces are those under the suction of the run."""
        leave_run(self.path, SUMMARY)
        found = methods.why_of(Results(self.path), np.array([1.0, 4.0, 4.5]))
        self.assertRegex(found, r"At 4\.5 m .* times the suction of .* of 30 kPa")
        self.assertEqual(methods.why_of(Results(self.path), np.array([1.0])), "")

    def test_why_not_like_the_other_methods(self) -> None:
        """4 MN at 4 m: beyond undisturbed ground and a cone that is assumed, of which
        the report says so; with a cone test that is like the run it does not ask."""
        leave_run(self.path / "suction", SUMMARY)
        history = dict(Results(self.path / "suction").history)
        for name in [n for n in history if "suction" in n]:
            del history[name]
        write_run(self.path / "jacked", history, SUMMARY)
        jacked = methods.methods_of(Results(self.path / "jacked"))
        self.assertIn("undisturbed", self.rows(jacked, "Computed / method: total")[0])
        said = "\n".join(jacked["why"])
        self.assertRegex(said, r"At 4.5 m the run has [\d.]+ times the force of undist")
        self.assertIn("times the force of Senders & Randolph (2009) (cone ASS", said)
        self.assertIn("a cone test may change these ratios considerably", said)
        rows = "depth_m,qc_MPa\n0,0\n4.5,9.4\n"
        (self.path / "jacked/cone.csv").write_text(rows)
        said = "\n".join(methods.methods_of(Results(self.path / "jacked"))["why"])
        self.assertNotIn("DNV", said)
        self.assertNotIn("ASSUMED", said)
        # seepage beside seepage: no method without suction is compared
        under = "\n".join(methods.methods_of(Results(self.path / "suction"))["why"])
        self.assertIn("times the suction of undisturbed", under)
        self.assertNotIn("times the force of", under)
        self.assertIn("times the suction of DNV (cone ASSUMED)", under)

    def test_what_suction_leaves(self) -> None:
        """Half of a jacked run's tip, a quarter of its inner friction, and twice its
        outer friction."""
        leave_run(self.path / "own", SUMMARY)
        run = Results(self.path / "own")
        titles = [table["title"] for table in methods.methods_of(run)["tables"]]
        self.assertFalse([x for x in titles if x.startswith("What suction leaves")])
        history = {n: v for n, v in run.history.items() if "suction" not in n}
        for part, factor in (("tip_force", 2), ("inner_friction", 4)):
            history[f"{part}_N"] = factor * history[f"{part}_N"]
        history["outer_friction_N"] = history["outer_friction_N"] / 2
        write_run(self.path / "jacked", history, SUMMARY)
        self.assertEqual(self.command("--jacked", "jacked", "own"), 0)
        found = methods.methods_of(Results(self.path / "own"))
        rows = self.rows(found, "What suction leaves")
        self.assertEqual([row["depth (m)"] for row in rows], ["2", "3", "4", "4.5"])
        critical = senders_randolph(9000, 4, 10)
        self.assertAlmostEqual(
            float(rows[2]["1 - s / s_cr (Senders & Randolph)"]),
            1 - 25e3 / critical,
            places=3,
        )
        row = rows[1]
        shares = [row[f"{part} / jacked"] for part in ("tip", "inner friction")]
        self.assertEqual(shares, ["0.5", "0.25"])
        self.assertEqual(row["outer friction / jacked"], "2")

    def command(self, *words: str) -> int:
        """Call `caisson report` with directories below that of the test."""
        parser = argparse.ArgumentParser()
        report.add_arguments(parser)
        given = [
            w if w.startswith("-") or w.isdigit() else str(self.path / w) for w in words
        ]
        with contextlib.redirect_stdout(io.StringIO()):
            return report.main(parser.parse_args(given))

    def test_jacked_run_that_is_not_the_same(self) -> None:
        """Of another soil, or with suction itself; none is kept."""
        leave_run(self.path / "own", SUMMARY)
        history = dict(Results(self.path / "own").history)
        jacked = {n: v for n, v in history.items() if "suction" not in n}
        other = [{**SCENE["layers"][0], "friction_angle_deg": 33}]
        changed = {**SUMMARY, "scene": {**SCENE, "layers": other}}
        write_run(self.path / "other", jacked, changed)
        for name, words in (
            ("other", "layers in its run.json is not that of"),
            ("own", "this run has suction, too"),
        ):
            said = io.StringIO()
            with contextlib.redirect_stderr(said):
                self.assertEqual(self.command("--jacked", name, "own"), 1)
            self.assertIn(words, said.getvalue())
            self.assertFalse((self.path / "own/jacked.csv").exists())

    def test_curves_without_a_point(self) -> None:
        """The run begins at 0.5 m, and the cone test ends at 0.3 m: no suction follows
        from it, but forces down to there."""
        leave_run(self.path, SUMMARY)
        (self.path / "cone.csv").write_text("depth_m,qc_kPa\n0,0\n0.3,700\n")
        figures = content.figures_of(Results(self.path), self.installation())
        labels = [[c["label"] for c in figure["curves"]] for figure in figures]
        self.assertFalse([name for name in labels[1] if "DNV" in name])
        self.assertFalse([name for name in labels[0] if "by cone" in name])
        self.assertEqual(len(labels[0]), 8)

    def test_run_of_an_earlier_version(self) -> None:
        """Without section Design, whose factors limit the suction, it is refused in a
        line; one that is jacked needs none."""
        leave_run(self.path, SUMMARY)
        (self.path / "run.json").write_text(json.dumps(SUMMARY), encoding="utf-8")
        parser, errors = argparse.ArgumentParser(), io.StringIO()
        report.add_arguments(parser)
        options = parser.parse_args([str(self.path)])
        with contextlib.redirect_stderr(errors):
            self.assertEqual(report.main(options), 1)
        words = r"^report: \S+/run.json has no entry Design/.*; run the scene again\n$"
        self.assertRegex(errors.getvalue(), words)
        history = dict(Results(self.path).history)
        del history["required_suction_Pa"], history["suction_Pa"]
        write_columns(self.path / "history.csv", history)
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(report.main(options), 0)

    def test_no_run(self) -> None:
        with self.assertRaisesRegex(ResultsError, "no history.csv"):
            report.write(self.path)
        with self.assertRaisesRegex(ResultsError, "no directory"):
            report.write(self.path / "none")

    @unittest.skipUnless(BROWSER, "needs chromium")
    def test_in_a_browser(self) -> None:
        """No error on the console; curves are drawn, read, shown and saved, also with a
        cone test."""
        visited, curves = self.path / "visited.html", 11
        for width in (400, 1200):
            if width == 1200:
                (self.path / "cone.csv").write_text("depth_m,qc_MPa\n0,0\n9,18\n")
            page = self.page(SUMMARY).replace("</body>", VISIT + "</body>")
            visited.write_text(page, encoding="utf-8")
            with self.subTest(width=width):
                result = subprocess.run(
                    [
                        BROWSER,
                        "--headless",
                        "--no-sandbox",
                        "--disable-gpu",
                        "--enable-logging=stderr",
                        "--virtual-time-budget=10000",
                        f"--window-size={width},900",
                        "--dump-dom",
                        visited.as_uri(),
                    ],
                    capture_output=True,
                    text=True,
                    check=True,
                )
                self.assertNotIn("CONSOLE", result.stderr)
                self.assertEqual(result.stdout.count('<canvas class="flot-overlay"'), 2)
                found = re.search("<title>(.*)</title>", result.stdout)
                assert found is not None
                name = self.path.name
                downloads, value = html.unescape(found[1]).rsplit("; ", 1)
                self.assertEqual(
                    sorted(downloads.split("; ")),
                    [f"curves {curves}", f"{name}_history.csv", f"{name}_suction.png"],
                )
                self.assertRegex(value, r"^[a-z ,&A-Z]+: [\d.]+ at [\d.]+ m")


if __name__ == "__main__":
    unittest.main()
