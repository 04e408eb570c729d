# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cards, error bars and ends of runs in report.html of made-up runs, runs that have not
ended, where the numbers of a page come from, and who answers for them."""
import argparse
import contextlib
import fcntl
import hashlib
import html
import io
import re
import signal
import subprocess
import sys
import time
import unittest
import unittest.mock
from typing import Any
from unittest import mock

import numpy as np
from synthetic import DESIGN, write_columns, write_run
from test_report import leave_run, SCENE, SUMMARY, WithPage

import caisson.report as report
from caisson import run_error_bar
from caisson.commands import run as launch
from caisson.plot import charts
from caisson.report import content, layers, methods, page, sketch, trace
from caisson.results import Results
from caisson.run_error_bar import NAME as ERROR
from caisson.shown import USUAL
from caisson.verdict import installation, limits, suction_methods, theory


class Cards(WithPage):
    """What a page says first."""

    def installation(self) -> installation.Installation:
        """Return the numbers of the run."""
        found = installation.installation_of(Results(self.path), installation.Rate())
        assert found is not None
        return found

    def leave_bar(
        self, end: float, half: float, shift: tuple[float, float] = (0, 0)
    ) -> None:
        """Leave an error bar of the suction and the exit gradient down to a depth."""
        columns = {"penetration_m": (1.0, end)}
        for side in ("below", "above"):
            columns[f"required_suction_{side}_Pa"] = (2e3, 2e3)
            columns[f"exit_gradient_axis_{side}"] = (half, half)
        columns |= {"required_suction_shift_Pa": shift} if any(shift) else {}
        lines = [",".join(map(str, row)) for row in zip(*columns.values())]
        text = "\n".join(["# fingerprint: f00d", ",".join(columns), *lines])
        (self.path / run_error_bar.NAME).write_text(text, encoding="utf-8")

    def test_error_bar_that_ends_above_the_run(self) -> None:
        """30 kPa at 4.5 m, of a bar of 2 kPa that ends at 4.4 m; far above the end it
        says nothing of it."""
        leave_run(self.path, SUMMARY)
        self.leave_bar(4.4, 0.1)
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("suction up to 30 kPa (about 28 to 32 kPa), at most 57 %", page)
        self.assertIn("The error bar reaches to 4 m.", page)
        takes, _ = installation.tables_of(self.installation())
        cells = [
            row[takes["heads"].index("required suction (kPa)")] for row in takes["rows"]
        ]
        self.assertEqual(cells[-2:], ["25 (23 to 27)", "30 (about 28 to 32)"])
        self.leave_bar(2.0, 0.1)
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("suction up to 30 kPa, at most 57 %", page)
        self.assertIn("The error bar reaches to 2 m.", page)

    def test_error_bar_of_another_scene(self) -> None:
        """It is not used, nor are its bounds; the page says so."""
        leave_run(self.path, {**SUMMARY, "fingerprint": "beef"})
        self.leave_bar(4.4, 0.1)
        (self.path / run_error_bar.HISTORY).write_text("penetration_m\n1\n", "utf-8")
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("suction up to 30 kPa, at most 57 %", page)
        self.assertIn("computed for other parameters and is not used: remove it", page)
        self.assertEqual(Results(self.path).error_bounds, {})

    def test_best_estimate(self) -> None:
        """The limit of the meshes is 1 kPa below the run, which needs 30 kPa."""
        leave_run(self.path, SUMMARY)
        self.leave_bar(4.4, 0.1, (-1e3, -1e3))
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("suction up to 30 kPa (about 28 to 32, best 29 kPa)", page)

    def test_caisson_that_needs_no_suction(self) -> None:
        """4500 kN of resistance under 7000 kN."""
        scene = {**SCENE, "submerged_weight_N": 7e6}
        leave_run(self.path, {**SUMMARY, "scene": scene})
        history = dict(Results(self.path).history)
        history["required_suction_Pa"] = -1e4 * (9 - history["penetration_m"])
        history["suction_Pa"] = np.zeros(len(history["time_s"]))
        history["seepage_flow_m3_s"] = np.zeros(len(history["time_s"]))
        write_columns(self.path / "history.csv", history)
        page = report.write(self.path).read_text(encoding="utf-8")
        text = html.unescape(page)
        self.assertIn("more than 4.5 m", text)
        self.assertIn("exceeds the resistance by 2500 kN: no suction needed", text)
        self.assertIn("water to vent (m³/h)", text)
        for words in ("required suction (kPa)", "Required and critical", "allowable"):
            self.assertNotIn(f'<th scope="col">{words}', text)
            self.assertNotIn(f"<h3>{words}", text)

    def test_small_body(self) -> None:
        """A model of 1/50 of the size in N, Pa and mm: cards, tables and charts."""
        leave_run(self.path, SUMMARY)
        history = dict(Results(self.path).history)
        factors = {"_m": 0.02, "_N": 2e-5, "_Pa": 0.02, "_m3": 8e-6}
        for name in history:
            end = name[name.rfind("_") :]
            history[name] = factors.get(end, 1.0) * history[name]
        sizes = {k: 0.02 * v for k, v in SCENE.items() if k.endswith("_m") and v}
        summary = {**SUMMARY, "scene": {**SCENE, **sizes, "submerged_weight_N": 20.0}}
        write_run(self.path, history, summary)
        run = Results(self.path)
        self.assertEqual(run.shown.smaller, {"kN", "kPa", "m"})
        text = html.unescape(report.write(self.path).read_text(encoding="utf-8"))
        words = text.split("<script")[0]
        for expected in (
            "Feasible to 90 mm by weight 20 N and suction up to 600 Pa, at most 57 %",
            "resistance (N)",
            "depth (mm)",
            "required suction (Pa)",
            "plug heave (mm)",
            "D = 200 mm",
            "h = 90.0 mm",
        ):
            self.assertTrue(expected in words, expected)
        for wrong in ("(kN)", "(m)", " kN", "0.09 m"):
            found = re.findall(".{40}" + re.escape(wrong), words.replace("kN/m³", ""))
            self.assertEqual(found, [], wrong)
        tables = {table["title"]: table for table in methods.methods_of(run)["tables"]}
        table = tables["Required and critical suction (Pa)"]
        cells = dict(zip(table["heads"], table["rows"][-1]))
        low = cells["required, Houlsby & Byrne (2005), low to high"].split()[0]
        by_hand = suction_methods.answers_of(theory.site_of(run), np.array([0.09]))
        needed = by_hand.suctions[suction_methods.LOW][0]
        self.assertAlmostEqual(float(low) / needed, 1, 2)
        charts = content.figures_of(run, self.installation())
        self.assertEqual([c["axis"] for c in charts], ["suction (Pa)", "force (N)"])
        self.assertEqual({c["depth"] for c in charts}, {"mm"})
        total = [c for c in charts[1]["curves"] if c["label"] == "total"][0]
        self.assertAlmostEqual(total["y"][-1], 90.0, delta=1)
        self.assertAlmostEqual(total["x"][len(total["x"]) // 2], 50.0, delta=2)

    def test_run_that_was_stopped(self) -> None:
        """At 4.5 of 6 m; of one that failed the last rows are not to be used."""
        entries = {"Time/End penetration": "6"}
        known = {**SUMMARY, "entries": entries}
        page = self.page({**known, "status": "stopped"})
        self.assertIn("Stopped at 4.5 m (planned 6 m); all values refer to 4.5 m", page)
        self.assertIn("Feasible to 4.5 m, as far as the run is (planned 6 m), by", page)
        self.assertIn("end of the scene at 6.00 m", page)
        self.assertNotIn("The run failed: do not use the last rows.", page)
        page = self.page({**known, "status": "failed", "failure": "no time step"})
        self.assertIn("The run failed: do not use the last rows.", page)

    def test_pictures_on_a_dark_page(self) -> None:
        """Charts are turned dark, and fields keep their colors."""
        leave_run(self.path, SUMMARY)
        for name in ("stress", "walls", "forces"):
            (self.path / f"{name}.png").write_bytes(b"")
        images = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn(
            '<img class="chart" src="data:image/png;base64," alt="Stresses', images
        )
        self.assertIn('<img src="data:image/png;base64," alt="Vertical stress', images)
        self.assertNotIn('alt="Forces"', images)  # the interactive curves have them

    def test_suction_beyond_which_a_method_ends(self) -> None:
        """The last rows have no answer; a hole above them is only empty."""
        values = np.array([1.0, np.nan, 3.0, np.nan, np.nan])
        texts = ["1", "", "3", "none (piping)", "none (piping)"]
        self.assertEqual(methods.or_piping(values), texts)

    def test_limits_beyond_the_chart(self) -> None:
        """The axis ends at 1.03 times 1.5 times the 30 kPa of the run."""
        shown = [
            charts.line("run", "black", np.array([0, 30.0]), np.arange(2.0), thick=True)
        ]
        found = installation.Installation(
            np.arange(2.0), {}, required=np.array([0, 30.0])
        )
        shown.append(charts.line("far", "red", np.full(2, 90.0), np.arange(2.0)))
        self.assertAlmostEqual(charts.axis_end(shown), 46.35)
        found.absent = ["pump: not given", "plug of clay: no clay"]
        for limit, words in ((46.0, ""), (47.0, "water boils at 47 kPa")):
            found.limits = {limits.BOILING: np.full(2, limit)}
            said = charts.beyond_the_chart(found, shown, 1.0)
            self.assertIn(words, said)
            self.assertEqual("Beyond" in said, bool(words))
            for kind in found.absent:
                self.assertIn(kind, said)
        found.lid = 1.4
        self.assertIn("lid at about 1.4 m", charts.beyond_the_chart(found, shown, 1.0))
        allowable = np.full(2, 60.0), np.arange(2.0)
        shown.append(charts.line("allowable", "red", *allowable, full=True))
        self.assertAlmostEqual(charts.axis_end(shown), 61.8)

    def test_card_of_the_methods(self) -> None:
        """The first ratio that there is at the end."""
        heads, title = ["depth (m)", *"ABC"], "Computed / method: total force (kN)"
        rows = [["4", "1", "2", "3"], ["4.5", "", "0.5 to 2", "3"]]
        table = {"title": title, "heads": heads, "rows": rows}
        found: dict[str, Any] = {"tables": [{}, table]}
        card = ["Computed / method", "0.5 to 2", "of B at 4.5 m"]
        self.assertEqual(methods.card_of(found), [card])
        heads[1] = "undisturbed"
        table["rows"] = [["4", "1", "2", "3"], ["4.5", "5", "", ""]]
        card = ["Computed / method", "2", "of B at 4 m"]
        self.assertEqual(methods.card_of(found), [card])
        self.assertEqual(methods.card_of({"tables": []}), [])

    def test_tables_of_a_page(self) -> None:
        """Cases are a range, and ratios a table of their own."""
        depth, nan = {"depth (m)": np.array([1.0, 2.0])}, np.nan
        cases = {"low": np.array([2e3, 4e3]), "high": np.array([3e3, 4e3])}
        a = theory.Beside("A", cases, {"undisturbed": np.array([1e3, nan])})
        found = methods.beside("Force (kN)", depth, np.full(2, 9e3), [a], USUAL)
        heads = [table["heads"][1:] for table in found]
        self.assertEqual(heads[0], ["computed", "A, low to high", "A, undisturbed"])
        self.assertEqual(heads[1], ["A", "undisturbed"])
        self.assertEqual(found[0]["rows"][0], ["1", "9", "2 to 3", "1"])
        self.assertEqual(found[0]["rows"][1], ["2", "9", "4", ""])
        self.assertEqual(found[1]["title"], "Computed / method: force (kN)")
        self.assertEqual(
            found[1]["rows"], [["1", "3.00 to 4.50", "9.00"], ["2", "2.25", ""]]
        )

    def test_stress_on_the_walls(self) -> None:
        """Of the frame at a depth: 30 and 60 kPa of 10 and 20 kPa at rest, and not
        above the mudline; none far from a frame."""
        leave_run(self.path, SUMMARY)
        self.assertIsNone(methods.walls_of(Results(self.path), 4.5))
        table = {
            "time_s": np.array([4.0, 4.5, 4.5, 4.5]),
            "penetration_m": np.array([4.0, 4.5, 4.5, 4.5]),
            "depth_m": np.array([1.0, -0.1, 1.0, 2.0]),
            "vertical_stress_at_rest_Pa": np.array([1e4, 0, 1e4, 2e4]),
        }
        for side, k in (("inner", 3.0), ("outer", 2.0)):
            table[f"{side}_area_m2"] = np.ones(4)
            stress = k * table["vertical_stress_at_rest_Pa"]
            table[f"{side}_normal_stress_Pa"] = stress + [9e9, 9e9, 0, 0]
        write_columns(self.path / "wall.csv", table)
        found = methods.walls_of(Results(self.path), 4.5)
        assert found is not None
        self.assertAlmostEqual(found.inner, 3.0)
        self.assertAlmostEqual(found.outer, 2.0)
        self.assertEqual(found.at_rest, (0.5, 0.5))
        self.assertAlmostEqual(found.passive[0], 3.25, delta=0.01)  # of 32 degrees
        self.assertIsNone(methods.walls_of(Results(self.path), 3.0))

    def test_sketch(self) -> None:
        """A triangular tip has its point in the middle of the wall; a text of a layer
        is not wider than the caisson."""
        for tip, corners in (("triangular", 5), ("flat", 4)):
            leave_run(self.path, {**SUMMARY, "defaults": {"Rigid body/Tip": tip}})
            drawn = sketch.of_run(Results(self.path), 4.5, None)
            points = re.findall(r'<polygon class="steel" points="([^"]*)"', drawn)
            self.assertEqual([len(x.split()) for x in points], [corners] * 2)
        run = Results(self.path)
        words = sketch.about_layer(run, layers.layers_of(run.scene)[0], 130)
        self.assertEqual(words, "layer 1, φ = 32°")

    def test_sketch_of_steps_and_rings(self) -> None:
        """The wall has its thickness above and below a step, and a ring lies on its
        inner face, to scale, but for a wall thinner than 67 mm."""
        at = {"above_tip": 1.0, "thickness": 0.2}
        scene = {**SCENE, **{f"wall_step_1_{k}_m": v for k, v in at.items()}}
        at = {"above_tip": 2.0, "width": 0.4, "height": 0.5}
        scene |= {f"ring_1_{k}_m": v for k, v in at.items()}
        thin, thick = SCENE["wall_thickness_m"], 0.2
        for face, inner in (("outer", 5 - thick), ("inner", 5 - thin)):
            entries = {"Rigid body/Flush face": face}
            leave_run(self.path, {**SUMMARY, "scene": scene, "entries": entries})
            drawn = sketch.of_run(Results(self.path), 4.5, None)
            named = [rf'{x}="([-.\d]+)"' for x in ("x", "y", "width", "height")]
            found = re.findall(rf'"steel" {" ".join(named)}', drawn)
            boxes = np.array([[float(x) for x in box] for box in found])
            scale = boxes[-1][2] / 10  # of the lid
            middle = boxes[-1][0] + 5 * scale
            wall, ring = boxes[1], boxes[3]
            low = (ring[1] + ring[3] - wall[1] - wall[3]) / scale
            self.assertAlmostEqual(low, -1.0, delta=0.01)
            for box, left, width in ((wall, inner, thick), (ring, inner - 0.4, 0.4)):
                self.assertAlmostEqual((box[0] - middle) / scale, left, delta=0.03)
                self.assertAlmostEqual(box[2] / scale, width, delta=0.01)

    def test_force_without_an_error_bar(self) -> None:
        """The command for the error of the mesh in the title."""
        title = "a caisson, on a mesh for an error of about 20 %"
        scene = {**SCENE, "skirt_length_m": 5.0}
        leave_run(self.path, {**SUMMARY, "title": title, "scene": scene})
        history = dict(Results(self.path).history)
        for name in [n for n in history if "suction" in n]:
            del history[name]
        history["total_force_N"] = 1.23456e6 * history["penetration_m"]
        write_columns(self.path / "history.csv", history)
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("Error bar not known: scripts/run", page)
        self.assertIn("--error 20% mine.prm computes it", page)
        self.assertIn("Jacked to 4.5 m: 5.56 MN, of which tip 2.25 MN, friction", page)
        self.assertNotIn("brackets the error bar", page)

    def test_error_bar_of_the_suction(self) -> None:
        """A band of means in kPa, which does not go below zero."""
        leave_run(self.path, SUMMARY)
        depth = np.linspace(1, 2, 101)
        low = 6e3 * (depth - 1) - 2e3
        bounds = {
            "penetration_m": depth,
            "required_suction_Pa": low + 1e3,
            "required_suction_low_Pa": low,
            "required_suction_high_Pa": low + 3e3,
        }
        write_columns(self.path / "history_error.csv", bounds)
        run, numbers = Results(self.path), self.installation()
        found = charts.suction_curves(run, numbers, 1.5)  # where suction ends
        bars = [curve for curve in found if curve["label"] == "required, error bar"]
        self.assertEqual(max(bars[0]["y"]), 1.5)
        found = charts.suction_curves(run, numbers)
        (bar,) = [curve for curve in found if curve["label"] == "required, error bar"]
        for i, expected in ((20, (0, 2.2)), (50, (1, 4))):
            self.assertAlmostEqual(bar["x"][i], expected[0])
            self.assertAlmostEqual(bar["to"][i], expected[1])

    def test_end_above_the_depths_of_the_error_bar(self) -> None:
        """Its file has no row, and the page says that none is known."""
        leave_run(self.path, SUMMARY)
        head = "penetration_m,total_force_N,total_force_low_N,total_force_high_N\n"
        (self.path / "history_error.csv").write_text(head, encoding="utf-8")
        page = report.write(self.path).read_text(encoding="utf-8")
        self.assertIn("Error bar not known: scripts/run --error 10% mine.prm", page)

    def test_plug_that_does_not_balance(self) -> None:
        """Heave without soil that came in or dilated is an error, and is said."""
        for share, is_said in ((0.54, True), (0.01, False)):
            run = unittest.mock.Mock(is_running=False, summary={}, scene={})
            run.history = {"plug_balance_error": np.array([0.0, share])}
            found = " ".join(content.remarks_on_numbers(run))
            self.assertEqual("54 % of the volume that the plug" in found, is_said)


class Live(WithPage):
    """The page while the program computes."""

    def test_run_that_goes_on(self) -> None:
        """Its page reloads itself, also where an old run.json is left."""
        self.assertIn('http-equiv="refresh"', self.page())
        with (self.path / ".lock").open("w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertIn('http-equiv="refresh"', self.page(SUMMARY))
        self.assertNotIn('http-equiv="refresh"', self.page(SUMMARY))

    def test_report_of_a_run_in_progress_is_renewed(self) -> None:
        """`caisson run` writes it while the program runs."""
        leave_run(self.path, {**SUMMARY, "status": "running"})
        page, end = self.path / report.NAME, time.monotonic() + 120
        with mock.patch.object(launch, "RENEWAL", 0.1), launch.reporting(self.path):
            while not page.is_file() and time.monotonic() < end:
                time.sleep(0.1)
        self.assertIn("sand &lt;b&gt;", page.read_text(encoding="utf-8"))

    def test_only_a_run_that_wrote_is_drawn(self) -> None:
        """Not the one of another terminal, where the program refused this one, or where
        the other one still writes."""
        words = ["--output-directory", str(self.path)]
        options = {"ranks": 1, "band": False, "error": None, "budget": None}

        def run(_: list[str]) -> int:
            leave_run(self.path, SUMMARY)
            return status

        with (
            mock.patch.multiple(launch, refuse_missing=mock.Mock(), run_alone=run),
            mock.patch.object(launch, "entries_of", return_value={}),
            mock.patch.object(launch, "draw") as draw,
            (self.path / ".lock").open("w", encoding="utf-8") as lock,
        ):
            for status, is_taken in ((0, False), (1, False), (3, False), (0, True)):
                fcntl.flock(lock, fcntl.LOCK_EX if is_taken else fcntl.LOCK_UN)
                given = argparse.Namespace(**options, arguments=[*words])
                draw.reset_mock()
                self.assertEqual(launch.main(given), status)
                self.assertEqual(draw.called, status != 1 and not is_taken)

    def test_interrupted_drawing(self) -> None:
        """It is said what makes the page."""
        said = io.StringIO()
        with (
            contextlib.redirect_stderr(said),
            mock.patch.object(launch, "draw", side_effect=KeyboardInterrupt),
            self.assertRaises(KeyboardInterrupt),
        ):
            launch.try_to_draw(self.path, None)
        self.assertIn(f"caisson report {self.path}", said.getvalue())

    def test_signals_are_handed_on(self) -> None:
        """To the program on one rank, that of the key for quitting, too."""
        program = "import signal as s; s.pthread_sigmask(s.SIG_BLOCK, {n});"
        program += "print('on', flush=True); exit(s.sigtimedwait({n}, 60) is None)"
        python, word = [sys.executable, "-c"], "from caisson.commands import run;"
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
            inner = [*python, program.format(n=f"{{{number:d}}}")]
            outer = [*python, f"{word} raise SystemExit(run.run_alone({inner!r}))"]
            with subprocess.Popen(outer, stdout=subprocess.PIPE) as process:
                assert process.stdout
                process.stdout.readline()
                process.send_signal(number)
            self.assertEqual(process.returncode, 0, number)

    def test_renewed_whatever_it_costs(self) -> None:
        """Each RENEWAL, also where a renewal takes nearly as long, while there are new
        rows."""
        leave_run(self.path, {**SUMMARY, "status": "running"})
        begins = []

        def write(*_: object, **__: object) -> None:
            begins.append(time.monotonic())
            time.sleep(0.15)
            with (self.path / "history.csv").open("a", encoding="utf-8") as file:
                file.write("\n" if len(begins) < 4 else "")

        with mock.patch.object(launch.subprocess, "run", write):
            with mock.patch.object(launch, "RENEWAL", 0.2), launch.reporting(self.path):
                time.sleep(2.0)
        self.assertEqual(len(begins), 4)
        self.assertLess(max(np.diff(begins)), 0.5)


class Trace(WithPage):
    """Checksums, mesh error, and signatures at the foot of the page."""

    def test_checksums(self) -> None:
        """That of the results is what sha256sum says of history.csv; that of the scene
        does not know where the results are."""
        leave_run(self.path, SUMMARY)
        found = trace.trace_of(Results(self.path))
        assert found is not None
        history = (self.path / "history.csv").read_bytes()
        self.assertEqual(found.results, hashlib.sha256(history).hexdigest())
        entries = DESIGN | {"Rigid body/Outer diameter": "10"}
        lines = "".join(f"{k} = {entries[k]}\n" for k in sorted(entries))
        self.assertEqual(found.scene, hashlib.sha256(lines.encode()).hexdigest())
        self.assertEqual(found.mesh, "not known")
        for name, changes in (("Output/Directory", False), ("Soil/Submerged", True)):
            leave_run(self.path, {**SUMMARY, "defaults": {name: "x"}})
            other = trace.sum_of_scene(Results(self.path))
            self.assertEqual(other != found.scene, changes)

    def test_mesh_error(self) -> None:
        """20 % where the title asks for them, and the error bar where there is one."""
        leave_run(self.path, {**SUMMARY, "title": "mine, for an error of about 20 %"})
        found = trace.trace_of(Results(self.path))
        assert found is not None
        self.assertEqual(found.mesh, "-20 to +20 % (asked for, not computed)")
        lines = ["# fingerprint: f00d", "penetration_m,total_below,total_above"]
        lines += ["1,0.05,0.1", "5,0.05,0.1"]
        (self.path / ERROR).write_text("\n".join(lines), encoding="utf-8")
        report.write(self.path)
        found = trace.trace_of(Results(self.path))
        assert found is not None
        self.assertEqual(found.mesh, "-5 to +10 % (error bar)")

    def command(self, *words: str) -> str:
        """Call `caisson report` for the run; return the page."""
        parser = argparse.ArgumentParser()
        report.add_arguments(parser)
        with contextlib.redirect_stdout(io.StringIO()):
            report.main(parser.parse_args([*words, str(self.path)]))
        return (self.path / report.NAME).read_text(encoding="utf-8")

    def test_signatures(self) -> None:
        """They stand on the page and at its foot until the results change."""
        leave_run(self.path, SUMMARY)
        text = self.command("--author", "A. Ng")
        self.assertTrue("Author: <i>A. Ng</i> Checked: <i></i>" in text)
        foot = page.css_text("author A. Ng; not checked")
        self.assertTrue(foot in text)
        text = self.command("--checked", "B </style>")
        self.assertTrue(page.css_text("author A. Ng; checked by B </style>") in text)
        self.assertFalse("B </style>" in text)
        history = self.path / "history.csv"
        history.write_text(history.read_text(encoding="utf-8") + "\n")
        self.assertTrue("Author: <i></i>" in self.command())
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.command("--author", "A. Ng", "--rate", "-1")
        self.assertIn("--rate -1: give m/h above 0", said.getvalue())
        self.assertEqual(trace.signed_of(self.path), trace.Signed())
        (self.path / trace.NAME).write_text("{")
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.command()
        self.assertIn("signed.json cannot be read", said.getvalue())

    def test_run_that_goes_on(self) -> None:
        """It has no checksum yet."""
        leave_run(self.path, None)
        self.assertIsNone(trace.trace_of(Results(self.path)))


if __name__ == "__main__":
    unittest.main()
