#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What run.json has for scripts, and the columns of history.csv: program.py."""
import html
import importlib.util
import json
import re
import time
import unittest
from typing import Any

import numpy as np

from program import (
    HERE,
    STOPPED,
    SUCCESS,
    Entries,
    ProgramTest,
    Results,
    history,
    scene,
    summary,
    user_scene,
)

from caisson import evaluation, report
from caisson.verdict import acceptance, limits, outcome, retrieval

SCHEMA = HERE.parent / "doc/how_to/run.schema.json"
SMALL: Entries = {
    "Rigid body/Outer diameter": 2.2,
    "Rigid body/Skirt length": 2,
    "Rigid body/Submerged weight": 6e4,
    "Rigid body/Cells across the wall": 2,
    "Grid/Outer radius": 5,
    "Grid/Bottom": -4,
    "Grid/Top": 3.5,
    "Time/End penetration": 1.3,
    "Water/Largest suction": 200e3,
    "Design/Factor on pump": 1.25,
    "Output/Record interval": 0.05,
    "Output/Frame penetrations": "0.5, 3",
    "Output/Frame interval": 100,
    "Output/Terminal": "full",
}
MARKED = """include {scene}
subsection Soil
  subsection Layer 1
    set Poisson ratio = 0.3 # ASSUMED
    set Friction angle = 30 # measured
  end
end
"""


def errors_of(data: Any) -> list[str]:
    """Return what the schema says against a run.json."""
    import jsonschema

    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    found = jsonschema.Draft202012Validator(schema).iter_errors(data)
    return [f"{'/'.join(map(str, error.path))}: {error.message}" for error in found]


@unittest.skipUnless(importlib.util.find_spec("jsonschema"), "needs jsonschema")
class Schema(ProgramTest):
    """The schema of the manual, against what the program writes."""

    def test_suction(self) -> None:
        """All that a run with suction has; results agree with history.csv."""
        path = self.directory()
        file = self.made_directory() / "mine.prm"
        marked = MARKED.format(scene=user_scene("suction"))
        file.write_text(marked, encoding="utf-8")
        said = self.run_program(
            SUCCESS, file, "--output-directory", path, entries=SMALL
        )
        found, rows = summary(path), history(path)
        self.assertEqual(errors_of(found), [])
        self.assertEqual(found["assumed"], ["Soil/Layer 1/Poisson ratio"])
        self.assertEqual(found["defaults"]["Rigid body/Tip"], "triangular")
        run = Results(path)
        results, table = outcome.results_of(run), evaluation.at_depths(run)
        last = results["at_depths"][-1]
        self.assertAlmostEqual(last["penetration_m"], 1.3, places=6)
        # half of the wall goes in under the weight, and all of it under suction
        rest, scene = results["rest_penetration_m"], found["scene"]
        inner = scene["diameter_m"] - 2 * scene["wall_thickness_m"]
        by_wall = ((scene["diameter_m"] / inner) ** 2 - 1) * (1.3 - rest / 2)
        expected = max(last["plug_heave_m"], by_wall)
        self.assertAlmostEqual(last["room_below_lid_m"], 2 - 1.3 - expected, delta=2e-3)
        depths = [r["penetration_m"] for r in rows[1:]]
        half = (depths[-1] - depths[0]) / 20  # of a tenth of a short way
        near = [r for r in rows[1:] if abs(r["penetration_m"] - 1) <= half + 1e-9]
        mean = sum(row["tip_force_N"] for row in near) / len(near)
        (at_1,) = [row for row in results["at_depths"] if row["penetration_m"] == 1]
        self.assertAlmostEqual(at_1["tip_force_N"] / mean, 1, places=6)
        zero = [r["penetration_m"] for r in rows if r["suction_Pa"] <= 0]
        self.assertAlmostEqual(results["rest_penetration_m"], zero[-1], places=6)
        # the terminal, too, says where suction begins
        self.assertRegex(said, r"suction +begins at a penetration of [\d.]+ m")
        self.assertRegex(said, r"\| suction +[\d.]+ kPa, gradient +\d+ % of critical")
        most = results["largest_suction"]["required_suction_Pa"]
        end = outcome.depth_of(run)
        assert end is not None, "piping is expected below it"
        down = table["penetration_m"] <= end
        self.assertGreaterEqual(most, max(table["required_suction_Pa"][down]))
        self.assertLess(most, max(table["required_suction_Pa"]))
        # section Design reaches Python, which knows its names
        names = {f"Factor on {x.entry}" for x in limits.LIMITS.values()}
        given = {k for k in found["defaults"] if k.startswith("Design/")}
        more = *limits.STEEL, *acceptance.ENTRIES, retrieval.SET_UP
        names = {f"Design/{name}" for name in (*names, *more)}
        self.assertEqual(given | {"Design/Factor on pump"}, names)
        pump = limits.limits_of(run, np.array([1.2]))[limits.PUMP]
        self.assertAlmostEqual(pump[0], 160)
        margins = results["margins"]
        self.assertAlmostEqual(margins["pump"]["least"], 1 - most / 200e3, places=6)
        self.assertLess(margins["piping"]["least"], 1)
        ranks = {w["rank"]: w["text"] for w in found["results"]["warnings"]}
        self.assertIn("the body does not come to 3 m", ranks["cosmetic"])

    def test_sealed_lid(self) -> None:
        """It has no pump, and the force is the one that the caisson feels."""
        path = self.directory()
        entries: Entries = {
            "Water/Level": "coupled",
            "Water/Suction control": "sealed",
            "Water/Lid leak": 1e-6,
            "Soil/Layer 1/Permeability": 1e-5,
            "Rigid body/Initial penetration": 1,
            "Rigid body/Velocity table": "0:0, 0.2:5e-3, 0.6:5e-3, 1:-5e-3, 3:-5e-3",
            "Time/End penetration": 1.1,
            "Time/End time": 2,
            "Method/Local damping": 0.3,
            "Output/Record interval": 0.02,
            "Output/Terminal": "full",
        }
        said = self.run_scene("jack", path, entries=entries)
        found, rows = summary(path), history(path)
        self.assertEqual(errors_of(found), [])
        pump = {"required_suction_Pa", "pumped_volume_m3", "gas_expansion_m3"}
        self.assertFalse(pump & set(rows[0]))
        results = outcome.results_of(Results(path))
        self.assertFalse({"largest_suction", "margins"} & set(results))
        name = "total_force_with_water_N"
        largest = results["largest_force"][name]
        self.assertGreater(
            largest, max(row[name] for row in results["at_depths"]) / 1.01
        )
        self.assertGreater(
            largest, 3 * max(row["total_force_N"] for row in results["at_depths"])
        )
        self.assertFalse(results["largest_pull"]["is_capacity"])
        # the body works on soil and water, and loses little beside that
        work = sum(
            row[name] * (row["penetration_m"] - before["penetration_m"])
            for before, row in zip(rows, rows[1:])
        )
        last = rows[-1]["external_work_J"] + rows[-1]["water_work_J"]
        self.assertAlmostEqual(last / work, 1, delta=2e-3)
        self.assertNotIn("has lost", said)

    def test_without_a_body(self) -> None:
        """It has no columns of a body."""
        path = self.directory()
        self.run_scene("compaction", path)
        found = summary(path)
        self.assertEqual(errors_of(found), [])
        self.assertEqual(outcome.results_of(Results(path)), {})
        self.assertNotIn("tip_force_N", history(path)[0])

    def test_the_schema_refuses(self) -> None:
        """A rank that is none, and results that it does not have."""
        path = self.directory()
        self.run_scene("compaction", path)
        found = summary(path)
        found["results"]["warnings"] = [{"rank": "grave", "text": ""}]
        self.assertIn("'grave' is not one of", errors_of(found)[0])
        found["results"] = {"warnings": [], "at_depths": []}
        self.assertTrue(errors_of(found))


CELLS = re.compile(r"<t[hd][^>]*>(.*?)</t[hd]>", re.S)


def rows_of_page(page: str) -> list[dict[str, str]]:
    """Return the rows of both tables of the installation by depth, by their heads."""
    part = page.split("The installation by depth</summary>")[1].split("</details>")[0]
    found: dict[str, dict[str, str]] = {}
    for table in part.split("<table")[1:]:
        plain = [
            [html.unescape(re.sub("<[^>]*>", "", cell)) for cell in CELLS.findall(row)]
            for row in table.split("<tr")[1:]
        ]
        for row in plain[1:]:
            found.setdefault(row[0], {}).update(zip(plain[0], row))
    return list(found.values())


class SameNumbers(ProgramTest):
    """One run says the same number wherever it says it."""

    def assert_near(self, text: str, value: float) -> None:
        """Ask for a number of three digits at least, before any bracket."""
        shown = float(text.split(" (")[0])
        self.assertAlmostEqual(shown, value, delta=5e-3 * abs(value) + 1e-9)

    def test_page_python_and_verdict(self) -> None:
        """At three depths, of a run that was continued; the page changes nothing."""
        path = self.directory()
        words = [user_scene("suction"), "--output-directory", path]
        first: Entries = {**SMALL, "Time/End penetration": 0.9}
        self.run_program(SUCCESS, *words, entries=first)
        said = self.run_program(SUCCESS, *words, "--restart", entries=SMALL)
        run, kept = Results(path), (path / "run.json").read_bytes()
        before = outcome.results_of(run)
        report.write(path)
        after = outcome.results_of(Results(path))
        self.assertEqual(before, after)
        self.assertEqual((path / "run.json").read_bytes(), kept)
        known = json.loads((path / "verdict.json").read_text(encoding="utf-8"))
        rows = rows_of_page((path / "report.html").read_text(encoding="utf-8"))
        limits_there = {row["penetration_m"]: row for row in known["limits"]}
        self.assertGreaterEqual(len(rows), 3)
        for row in rows[-3:]:
            depth = float(row["depth (m)"])
            table = evaluation.at_depths(run, np.array([depth]))
            numbers = {name: float(values[0]) for name, values in table.items()}
            limit = limits_there[depth]
            self.assert_near(row["resistance (kN)"], 1e-3 * numbers["total_force_N"])
            self.assert_near(row["tip (kN)"], 1e-3 * numbers["tip_force_N"])
            suction = max(numbers["required_suction_Pa"], 0.0)
            self.assertAlmostEqual(limit["required_suction_Pa"], suction, places=3)
            self.assert_near(row["required suction (kPa)"], 1e-3 * suction)
            allowable = 1e-3 * limit["allowable_suction_Pa"]
            self.assert_near(row["allowable (kPa)"], allowable)
            self.assertEqual(row["governed by"], limit["governed_by"])
        last = history(path)[-1]
        shown = re.findall(r"pen +([\d.]+) m .* total +([\d.]+) kN", said)[-1]
        for text, value in zip(shown, ("penetration_m", "total_force_N")):
            factor = 1e-3 if value.endswith("_N") else 1.0
            self.assertAlmostEqual(float(text), factor * last[value], delta=0.06)


class Columns(ProgramTest):
    """history.csv has no columns of what a scene lacks."""

    def test_jacked(self) -> None:
        path = self.directory()
        entries = {
            "Time/End penetration": 0.52,
            "Material points/Split and merge": "false",
        }
        self.run_scene("jack", path, entries=entries)
        names = set(history(path)[0])
        self.assertTrue({"tip_force_N", "lid_force_N", "held_back_count"} <= names)
        absent = {"cavity_pressure_Pa", "prescribed_force_z_N", "points_split"}
        self.assertFalse(names & (absent | {"suction_Pa"}))


class Progress(ProgramTest):
    """run.json of a run that has not ended."""

    def test_stopped_and_killed(self) -> None:
        """It says how far the run is; a run that is stopped writes it whole."""
        path = self.directory()
        process = self.start(scene("jack"), "--output-directory", path)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        file = path / "run.json"
        while not file.is_file() and process.poll() is None:
            time.sleep(0.005)
        found = json.loads(file.read_text(encoding="utf-8"))
        self.assertEqual(found["status"], "running")
        self.assertLess(found["progress"]["fraction_done"], 1)
        self.assertEqual(found["scene"]["wall_thickness_m"], 0.2)
        (path / "stop").touch()
        self.assertIn(process.wait(), (STOPPED, SUCCESS))
        self.assertNotIn("progress", summary(path))

    def test_time_left(self) -> None:
        """By the steps that are left, which an inertia tolerance makes longer and
        longer: the first part of the way takes more than its share of the time."""
        path = self.directory()
        entries = {
            "Time/Mass scaling": 1,
            "Time/Inertia tolerance": 0.4,
            "Output/Record interval": "every step",
        }
        where = ["--output-directory", path]
        process = self.start(user_scene("jack_coarse"), *where, entries=entries)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        done, left, ran = 0.0, None, 0.0
        while process.poll() is None and not (left and done > 0.01):
            time.sleep(0.05)
            if (path / "run.json").is_file():
                found = summary(path)
                ran = found["wall_time_s"]
                done, left = found.get("progress", {}).values() or (1.0, None)
        assert left
        self.assertLess(left / ran, 0.7 * (1 - done) / done)
        (path / "stop").touch()
        process.wait()
        least, most = summary(path)["mass_scaling"]
        self.assertGreater(most, 1.01 * least)
        self.assertIn("jack_coarse.prm --output-directory", summary(path)["command"])
        self.assertEqual(summary(path)["units"]["Output/Record interval"], "s")


class Inertia(ProgramTest):
    """The factors of the inertia of a run."""

    def test_inertia_of_dilatant_sand(self) -> None:
        """Sand that dilates moves faster where it fails, and bears less inertia."""
        least = []
        for psi in (0, 30):
            entries: Entries = {
                "Time/Inertia tolerance": 1.6,
                "Time/End penetration": 0.51,
                "Soil/Layer 1/Dilatancy angle": psi,
            }
            path = self.directory(f"{psi}")
            where = ["--output-directory", path]
            self.run_program(
                SUCCESS, user_scene("jack_coarse"), *where, entries=entries
            )
            least.append(summary(path)["mass_scaling"][0])
        speed = np.exp(np.pi / 2 * np.tan(np.radians(30)))
        self.assertAlmostEqual(least[0] / least[1], speed, delta=1e-3 * speed)


if __name__ == "__main__":
    unittest.main()
