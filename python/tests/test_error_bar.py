# SPDX-License-Identifier: LGPL-2.1-or-later
"""The error bar of made-up runs that differ by known amounts."""
import argparse
import contextlib
import io
import tempfile
import unittest
import unittest.mock
from pathlib import Path
from typing import Any

import numpy as np
from synthetic import write_run

from caisson import curves, run_error_bar, study_command
from caisson.ranks import Size
from caisson.results import Results, ResultsError, Table, read_table
from caisson.runner import Entries, Run, RunError, Status
from caisson.runs import How, StudyRun, make
from caisson.study import Study, StudyError
from caisson.error_bars import command, bar_study, windows
from caisson.error_bars.mesh_error import mesh_error
from lab import verification
from lab.study import LabReader, Options

STUDY = """
kind = "error bar"
scene = "a.prm"
output = "bar.csv"
depths = [1.0, 3.0, 0.1]
runs = [{name = "default"}, {name = "refined"}, {name = "little_mass"}]
[[errors]]
name = "mesh"
from = "default"
to = "refined"
factor = 1
[[errors]]
name = "mass scaling"
from = "default"
to = "little_mass"
factor = 2
"""
SUCTION = 1e4  # Pa for each meter


def synthetic(force: float, suction: float | None) -> Table:
    """Return a history whose forces are larger by this share, and whose suction is
    larger by this amount (Pa) and zero at 2 m; None: drained."""
    depth = np.linspace(0.5, 3.5, 301)
    table = {"time_s": depth, "penetration_m": depth}
    for quantity in run_error_bar.FORCES:
        table[quantity.column()] = (1 + force) * 1e5 * depth
    if suction is not None:
        table["required_suction_Pa"] = SUCTION * (depth - 2) + suction
        table["exit_gradient_axis"] = 0.1 * depth
        table["plug_heave_m"] = 0.05 * depth + suction / 1e6
    return table


class ErrorBar(unittest.TestCase):
    """The file that a study leaves, and what the ladder makes of it."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)

    def study(self, suctions: tuple[float | None, ...] = (0, 800, -300)) -> Study:
        """Return a study with finished runs; errors of the forces are 3 % and, before
        the factor of 2, 2 %."""
        file = self.path / "study.toml"
        file.write_text(STUDY, encoding="utf-8")
        options = Options(results=self.path / "results")
        (study,) = LabReader(file, options, bar_study).studies()
        for run, force, suction in zip(study.runs, (0, 0.03, -0.02), suctions):
            summary = {"fingerprint": "f00d", "wall_time_s": 60}
            write_run(run.run.directory, synthetic(force, suction), summary)
        return study

    def bars(self, study: Study) -> tuple[Table, str]:
        """Return the file of the study, and what is printed with it."""
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            self.assertEqual(bar_study.evaluate([study], Options(), 0), 0)
        return read_table(self.path / "bar.csv"), printed.getvalue()

    def test_half_widths(self) -> None:
        """Root of 3 % and twice 2 % squared, of 800 and twice 300 Pa, at each depth,
        also where the suction is zero."""
        bars, printed = self.bars(self.study())
        self.assertEqual(len(bars["penetration_m"]), 21)
        for name in ("tip", "inner", "outer", "total"):
            for side in bar_study.SIDES:
                np.testing.assert_allclose(bars[f"{name}_{side}"], 0.05)
                np.testing.assert_allclose(bars[f"{name}_mass_scaling_{side}"], 0.04)
        np.testing.assert_allclose(bars["required_suction_below_Pa"], 1000)
        np.testing.assert_allclose(bars["required_suction_mesh_above_Pa"], 800)
        np.testing.assert_allclose(bars["plug_heave_above_m"], 1e-3)
        np.testing.assert_allclose(bars["exit_gradient_axis_below"], 0)
        expected = SUCTION * (bars["penetration_m"] - 2)
        np.testing.assert_allclose(bars["required_suction_Pa"], expected, atol=1e-3)
        text = (self.path / "bar.csv").read_text(encoding="utf-8")
        self.assertIn("# fingerprint: f00d\n", text)
        row = next(line for line in printed.splitlines() if "| all " in line)
        self.assertEqual(row.split("|")[2].strip(), "+-5.0 %")

    def test_a_term_counts_at_its_depths(self) -> None:
        """Outside them the other term is left; a run that ends before is reported."""
        study = self.study()
        study.keys["errors"][0]["depths"] = [1.0, 2.0]
        bars, _ = self.bars(study)
        shallow = bars["penetration_m"] < 2.05
        self.assertEqual(int(shallow.sum()), 11)
        expected = np.where(shallow, 1000, 600)
        np.testing.assert_allclose(bars["required_suction_below_Pa"], expected)
        study.keys["errors"][0]["depths"] = [1.0, 5.0]
        study.keys["depths"] = [1.0, 5.0, 0.1]
        with self.assertRaisesRegex(StudyError, "'mesh' counts to 5 m.*set its depths"):
            bar_study.evaluate([study], Options(), 0)

    def test_shown_depths(self) -> None:
        """All of a few, as those of windows; else some round ones."""
        few = np.array([1.19, 2.12, 3.06, 4.0])
        self.assertEqual(bar_study.chosen_depths(few), [0, 1, 2, 3])
        self.assertEqual(bar_study.chosen_depths(np.linspace(1, 3, 21)), [10, 20])

    def test_drained_runs_have_forces_only(self) -> None:
        bars, _ = self.bars(self.study((None, None, None)))
        self.assertEqual([name for name in bars if "suction" in name], [])
        np.testing.assert_allclose(bars["total_above"], 0.05)

    def test_missing_run(self) -> None:
        study = self.study()
        (study.run("refined").run.directory / "history.csv").unlink()
        with self.assertRaisesRegex(StudyError, "history.csv"):
            bar_study.evaluate([study], Options(), 0)

    def test_row_of_the_ladder(self) -> None:
        """1000 Pa are 10 % of the suction at 3 m."""
        study = self.study()
        self.bars(study)
        row = {"error_bar": "bar.csv", "quantity": "required_suction", "depth": 3}
        found = verification.error_bar_row({**row, "error": 0.1001}, study)
        self.assertEqual(found["error"], "0.1")
        self.assertEqual(found["verdict"], verification.PASS)
        found = verification.error_bar_row({**row, "error": 0.09}, study)
        self.assertEqual(found["verdict"], verification.FAIL)
        tip = {**row, "quantity": "tip", "error": 0.03, "known_error": 0.05}
        found = verification.error_bar_row(tip, study)
        self.assertEqual(found["verdict"], verification.KNOWN)
        with self.assertRaisesRegex(StudyError, "no depth 4 m"):
            verification.error_bar_row({**row, "depth": 4, "error": 0.1}, study)
        with self.assertRaisesRegex(StudyError, "no quantity 'lid'"):
            verification.error_bar_row({**row, "quantity": "lid", "error": 0.1}, study)
        with self.assertRaises(ResultsError):
            verification.error_bar_row({**row, "error_bar": "x", "error": 0.1}, study)


class MeshError(unittest.TestCase):
    """Made-up runs with known errors."""

    SIZES = np.array([2.0, 1.0, 2 / 3, 0.5])

    def test_first_order(self) -> None:
        """8 % too high with h = 1: the limit, a bar of 10 % on one side, order 1."""
        found = mesh_error(self.SIZES, 100 + 8 * self.SIZES[:, np.newaxis], 1)
        np.testing.assert_allclose(found.limit, 100)
        np.testing.assert_allclose(found.below, 10)
        np.testing.assert_allclose(found.above, 0, atol=1e-9)
        np.testing.assert_allclose(found.order, 1, atol=0.05)
        self.assertFalse(found.failed.any())

    def test_too_low(self) -> None:
        found = mesh_error(self.SIZES, 100 - 8 * self.SIZES[:, np.newaxis], 1)
        np.testing.assert_allclose(found.below, 0, atol=1e-9)
        np.testing.assert_allclose(found.above, 10)

    def test_scatter(self) -> None:
        """Its standard deviation counts on both sides; two parameters are fitted."""
        scatter = np.array([0.2, -0.3, 0.4, -0.3])
        found = mesh_error(
            self.SIZES, (100 + 8 * self.SIZES + scatter)[:, np.newaxis], 1
        )
        line = np.polyfit(self.SIZES, scatter, 1)
        left = scatter - np.polyval(line, self.SIZES)
        deviation = np.sqrt(np.sum(left**2) / 2)
        np.testing.assert_allclose(found.above, deviation)
        np.testing.assert_allclose(found.below, 1.25 * (8 + line[0]) + deviation)

    def test_two_runs(self) -> None:
        """They cannot confirm order or sign: three times the error; of a force, 1.5
        times, and half of it on the side on which the limit is not. The best estimate
        is half of the way to the limit of first order."""
        for sign, is_force, sides in (
            (1, False, [24, 24]),
            (1, True, [12, 4]),
            (-1, True, [4, 12]),
        ):
            runs = 100 + sign * np.array([[16.0], [8.0]])
            found = mesh_error(self.SIZES[:2], runs, 1, is_force)
            np.testing.assert_allclose(found.limit, 100 + sign * 4)
            of_coarser = mesh_error(self.SIZES[:2], runs, 0, is_force)
            np.testing.assert_allclose(of_coarser.limit, found.limit)
            np.testing.assert_allclose([found.below[0], found.above[0]], sides)
            self.assertTrue(np.isnan(found.order).all())

    def test_it_fails(self) -> None:
        """Runs that go to and fro, or of an order near 0: three times the range over
        the ratio of sizes, 4, less one."""
        for values in ([100.0, 109.0, 101.0, 108.0], [109.0, 108.0, 103.0, 100.0]):
            found = mesh_error(self.SIZES, np.array(values)[:, np.newaxis], 1)
            self.assertTrue(found.failed.all())
            self.assertGreaterEqual(found.below[0], 9.0 - 1e-9)
            self.assertGreaterEqual(found.above[0], 9.0 - 1e-9)


class Similar(ErrorBar):
    """A study with similar meshes."""

    def test_mesh_term(self) -> None:
        """Forces that are 8 % too high with h = 1, by order 1; a limit in the file; the
        finest mesh lies in the bar of the others."""
        file = self.path / "study.toml"
        meshes = {"coarse": 0.5, "default": 1, "fine": 1.5, "finest": 2}
        runs = ", ".join(
            f'{{name = "{name}", set = {{"Grid/Refinement" = {number}}}}}'
            for name, number in meshes.items()
        )
        file.write_text(
            'kind = "error bar"\nscene = "a.prm"\noutput = "bar.csv"\n'
            f"depths = [1.0, 3.0, 0.1]\nruns = [{runs}]\n"
            f'[[errors]]\nname = "mesh"\nmeshes = {list(meshes)}\n'.replace("'", '"'),
            encoding="utf-8",
        )
        options = Options(results=self.path / "results")
        (study,) = LabReader(file, options, bar_study).studies()
        for run, number in zip(study.runs, meshes.values()):
            summary = {"fingerprint": "f00d", "wall_time_s": 60}
            write_run(run.run.directory, synthetic(0.08 / number, None), summary)
        bars, printed = self.bars(study)
        np.testing.assert_allclose(bars["tip_below"], 0.1 / 1.08, atol=1e-4)
        np.testing.assert_allclose(bars["tip_above"], bar_study.LEAST)
        np.testing.assert_allclose(bars["tip_shift"], 1 / 1.08 - 1, atol=1e-4)
        self.assertRegex(printed, r"\| total +\| 1.0 +\| 0 % +\| 100 %")


class Plan(unittest.TestCase):
    """The meshes that a budget allows."""

    def test_refinements(self) -> None:
        """Cells across the wall are even, and at least as many as is said."""
        for cells, even, least, first in (
            (4, True, 2, [0.5, 1.0, 1.5, 2.0, 3.0]),
            (2, True, 1, [1.0, 2.0, 3.0]),
            (2, False, 1, [0.5, 1.0, 1.5, 2.0]),
            (2, False, 2, [1.0, 1.5, 2.0, 3.0]),
            (1, False, 2, [1.0, 2.0, 3.0]),
            (0, False, 2, [0.5, 0.75, 1.0]),
        ):
            found = command.refinements(cells, even, least)
            self.assertEqual(found[: len(first)], first)

    def test_budget(self) -> None:
        """The mesh of the scene, then all coarser ones, then finer ones while the cube
        of the refinement is paid for."""
        meshes, changes = [0.5, 1.0, 1.5, 2.0], 6.3
        for budget, number in (300, 2), (700, 3):
            chosen = command.chosen_meshes(meshes, 100.0, budget, changes)
            self.assertEqual(chosen, meshes[:number])
        chosen = command.chosen_meshes([1.0, 2.0], 100.0, 300.0, changes)
        self.assertEqual(chosen, [1.0])

    def test_choice(self) -> None:
        """Meshes with two cells across the wall and more; with one where the budget
        allows no second one else, and then rather three meshes than many windows."""
        plan = command.Plan.__new__(command.Plan)
        plan.size, plan.entries = Size(1000, 100.0, 100.0), dict(Windows.THIN)
        meshes = {1: [0.5, 1.0, 2.0], 2: [1.0, 2.0]}
        known = unittest.mock.patch.object(plan, "meshes", meshes.__getitem__)
        known.start()
        self.addCleanup(known.stop)
        for budget, chosen, number in (
            (200.0, [1.0, 2.0], 4),
            (70.0, [1.0, 2.0], 1),
            (50.0, [0.5, 1.0, 2.0], 1),
            (20.0, [0.5, 1.0], 4),
        ):
            plan.budget = budget
            plan.choose(windows.NUMBERS)
            self.assertEqual((plan.chosen, len(plan.windows)), (chosen, number))

    def test_one_depth(self) -> None:
        """Runs with other numerics are compared where their window has its means."""
        plan = command.Plan.__new__(command.Plan)
        plan.size, plan.seconds = Size(1000, 100.0, 100.0), 10.0
        plan.entries = {**Windows.THIN, "Time/Mass scaling": "1"}
        plan.entries |= {"Time/Courant number": "0.8", "Grid/Bottom": "-9"}
        plan.entries |= {"Grid/Outer radius": "9"}
        zones = ("in path", "near", "far")
        plan.entries |= {f"Material points/Per direction {zone}": "2" for zone in zones}
        with unittest.mock.patch.object(plan, "run"):
            for number in windows.NUMBERS:
                plan.windows = windows.windows_of(plan.entries, number)
                _, terms = plan.changed(1.0, "default")
                self.assertEqual(len(terms), 4)
                for term in terms:
                    self.assertIn(term["at"], plan.depths)

    def test_scenes_without_other_meshes(self) -> None:
        entries = {"Installation/Directory": "", "Time/Time step": "auto"}
        command.check_entries(entries)
        with self.assertRaisesRegex(StudyError, "from an installation"):
            command.check_entries({**entries, "Installation/Directory": "a"})
        with self.assertRaisesRegex(StudyError, "Set Time/Time step = auto"):
            command.check_entries({**entries, "Time/Time step": "0.001"})

    def test_kept_size(self) -> None:
        """A later call takes the time of the scene from the first one, unless the scene
        or the program has changed, or the file is broken."""
        with tempfile.TemporaryDirectory() as folder:
            run = unittest.mock.Mock(key="k")
            run.validate.side_effect = [Size(9, seconds, 1.0) for seconds in (5, 6, 7)]
            plan = command.Plan.__new__(command.Plan)
            plan.results = Path(folder)
            of_plan = unittest.mock.Mock(return_value=unittest.mock.Mock(run=run))
            patch = unittest.mock.patch.object(plan, "run", of_plan)
            patch.start()
            self.addCleanup(patch.stop)
            plan.size = plan.size_of_scene()
            self.assertEqual(plan.size, Size(9, 5, 1.0))
            plan.keep_size()
            self.assertEqual(plan.size_of_scene(), plan.size)
            run.key = "another"
            self.assertEqual(plan.size_of_scene().seconds, 6)
            (plan.results / command.SIZE).write_text("[", encoding="utf-8")
            self.assertEqual(plan.size_of_scene().seconds, 7)

    def test_failed_run(self) -> None:
        """None begins after it, as the bar needs all of them."""
        known = {"is_complete.return_value": False, "restarts": False}
        calls = [unittest.mock.Mock(**known) for _ in "abc"]
        calls[1].execute.side_effect = RunError("a window ended early")
        runs = [StudyRun("s", "", c, seconds=9 - i) for i, c in enumerate(calls)]
        for call in calls:
            call.completion_record.return_value = {"wall_s": 1, "status": 0}
        with contextlib.redirect_stdout(io.StringIO()):
            make(runs, How(jobs=1, needs_all=True))
        self.assertIn("a window ended early", str(runs[1].trouble))
        self.assertEqual([call.execute.called for call in calls], [True, True, False])

    def test_caution_with_suction(self) -> None:
        """Windows do not see what it has done to the soil."""
        plan = unittest.mock.Mock(entries={"Output/Error bar": "a.csv"}, next=0)
        study = unittest.mock.Mock()
        for whether, suction, has in ((True, 5.0, 1), (True, 0.0, 0), (False, 5.0, 0)):
            plan.windows = [windows.Window(1.0, 1.4)] * whether
            history = {"suction_Pa": np.array([0.0, suction])}
            study.run.return_value.results.history = history
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                command.advise(plan, study)
            self.assertEqual(printed.getvalue().count("--whole"), has)

    def test_output(self) -> None:
        """The scene and a directory are not replaced, also with --overwrite."""
        with tempfile.TemporaryDirectory() as folder:
            plan = command.Plan.__new__(command.Plan)
            plan.scene = Path(folder).resolve() / "a.prm"
            plan.output = plan.scene.with_name("a.csv")
            plan.check_output()
            plan.output = Path(folder, ".", "a.prm")
            with self.assertRaisesRegex(StudyError, "is the scene"):
                plan.check_output()
            plan.output = Path(folder)
            with self.assertRaisesRegex(StudyError, "is a directory"):
                plan.check_output()

    def test_size(self) -> None:
        """A finer mesh costs the cube; of a range of times both ends do."""
        plan = command.Plan.__new__(command.Plan)
        plan.size, plan.seconds = Size(1000, 60.0, 10.0), 6.0
        self.assertEqual(plan.sized(2.0), Size(4000, 48.0, 8.0))
        self.assertEqual(plan.sized(1.0, 2.0), Size(1000, 12.0, 2.0))

    def test_options(self) -> None:
        """Those of where runs are made are the same as those of a study."""
        parser = argparse.ArgumentParser()
        command.add_arguments(parser)
        words = ["a.prm", "--jobs", "3", "--dask", "tcp://host:8786"]
        found = parser.parse_args(words)
        self.assertEqual((found.jobs, found.dask), (3, "tcp://host:8786"))

    def test_durations(self) -> None:
        for text, seconds in {
            "90s": 90,
            "30min": 1800,
            "1.5 h": 5400,
            "2h": 7200,
        }.items():
            self.assertEqual(command.seconds_of(text), seconds)
        for text in ("30", "1.2.3min", "0s"):
            with self.assertRaises(argparse.ArgumentTypeError):
                command.seconds_of(text)


class Windows(unittest.TestCase):
    """Short ways instead of a long one."""

    THIN: Entries = {
        "Rigid body/Kind": "caisson",
        "Rigid body/Motion": "prescribed",
        "Rigid body/Outer diameter": "8",
        "Rigid body/Wall thickness": "0.03",
        "Rigid body/Velocity": "0.1",
        "Rigid body/Velocity table": "",
        "Rigid body/Initial penetration": "0.5",
        "Time/End penetration": "7.5",
        "Time/Inertia tolerance": "0.8",
    }

    def test_choice(self) -> None:
        """At four depths, the last of them the end, or one in the middle; none where
        they are no shorter than the way, without a wall, or without a known speed."""
        found = windows.windows_of(self.THIN, 4)
        depths = [window.depth for window in found]
        np.testing.assert_allclose(depths, [2.25, 4, 5.75, 7.5])
        np.testing.assert_allclose(found[0].length, 0.3)
        (single,) = windows.windows_of(self.THIN, 1)
        self.assertEqual(single.depth, 4)
        for other in (
            {"Rigid body/Wall thickness": "0.2"},
            {"Rigid body/Kind": "box"},
            {"Rigid body/Motion": "by loads"},
            {"Rigid body/Velocity table": "0, 0.1 ; 5, 0.2"},
            {"Time/End penetration": "never"},
            {"Rigid body/Wall thickness": "0.003", "Time/End penetration": "1.5"},
        ):
            self.assertEqual(windows.windows_of({**self.THIN, **other}, 4), [])

    def test_inertia(self) -> None:
        """In the middle of the mean it is that of the scene: the program gives a share
        of the way over a third of the radius, at least 0.15, to both of them."""
        (window, *_) = windows.windows_of(self.THIN, 2)
        changed = window.entries(self.THIN)
        share = 0.25 / (4 / 3)
        self.assertAlmostEqual(changed["Time/Inertia tolerance"], 0.8 / share)
        short = windows.Window(2.0, 2.12).entries(self.THIN)
        self.assertAlmostEqual(short["Time/Inertia tolerance"], 0.8 / 0.15)
        wide = window.entries({**self.THIN, "Rigid body/Outer diameter": "40"})
        ratio = (4 - 0.05 - 0.5) / (20 / 3) / 0.15
        self.assertAlmostEqual(wide["Time/Inertia tolerance"], 0.8 * ratio)

    def test_history(self) -> None:
        """Each depth has the means over the last third of its window, of what has
        relative errors."""
        with tempfile.TemporaryDirectory() as folder:
            results = []
            for i, force in enumerate((100.0, 300.0)):
                depth = np.linspace(0.64, 1.0, 37) + i
                rising = np.where(depth > depth[-1] - 0.1201, force, 0)
                history = {"time_s": depth, "penetration_m": depth, "F": rising}
                history |= {q.column(): rising for q in run_error_bar.SUCTION}
                place = Path(folder, str(i))
                write_run(place, history, {"entries": {}, "wall_time_s": 2.0})
                results.append(Results(place))
            run = Run(Path("a.prm"), {}, Path(folder))
            ways = [windows.Window(0.64 + i, 1.0 + i) for i in (0, 1)]
            depths = [1.0, 2.0, 3.0]
            with unittest.mock.patch.object(
                windows, "query", return_value="# fingerprint: f00d"
            ):
                windows.write_means(run, ways, depths, results)
            found = Results(run.directory)
            means = curves.forces_at(found.history, "F", np.array(depths))
            np.testing.assert_allclose(means, [100, 300, 300])
            self.assertEqual(list(found.history), ["time_s", "penetration_m", "F"])
            self.assertEqual(found.summary["wall_time_s"], 4.0)
            self.assertEqual(found.summary["fingerprint"], "f00d")


class Part(Run):
    """A window whose run ends with a status, and is counted."""

    def __init__(self, directory: Path, status: Status | None) -> None:
        self.directory, self.status, self.calls = directory, status, 0
        self.ranks, self.restarts, self.in_effect = 1, False, {}
        self.record: dict[str, Any] | None = None

    def is_complete(self) -> bool:
        return self.record is not None

    def completion_record(self) -> dict[str, Any] | None:
        return self.record

    def execute(
        self, time_limit: float | None = None, ranks: int | None = None
    ) -> Status | None:
        self.calls += 1
        depth = np.linspace(0.64, 1.0, 37)
        history = {"time_s": depth, "penetration_m": depth, "F": depth}
        write_run(self.directory, history, {"entries": {}, "wall_time_s": 2.0})
        if self.status in (Status.SUCCESS, Status.FAILURE):
            self.record = {"status": self.status, "wall_s": 2.0, "cpu_s": 2.0}
        return self.status


class RunsOfWindows(unittest.TestCase):
    """What is run, and what counts as a result."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.plan = command.Plan.__new__(command.Plan)
        self.plan.results = path = Path(temporary.name)
        self.plan.scene = self.plan.program = path / "a.prm"
        self.plan.entries = {}
        self.plan.windows = [windows.Window(0.64, 1.0), windows.Window(1.64, 2.0)]
        self.whole = self.plan.run("default", {}, Size(9, 8.0, 4.0), self.plan.windows)
        self.parts_of = unittest.mock.Mock()
        for patch in (
            unittest.mock.patch.object(self.plan, "parts_of", self.parts_of),
            unittest.mock.patch.object(self.plan, "keep_size"),
            unittest.mock.patch.object(windows, "query", return_value=""),
        ):
            patch.start()
            self.addCleanup(patch.stop)

    def give(self, *statuses: Status | None) -> list[Part]:
        """Let the windows end in this way; return them."""
        place = self.whole.run.directory
        parts = [Part(place / str(i), status) for i, status in enumerate(statuses)]
        known: dict[str, Any] = {"seconds": 1, "size": Size(1)}
        runs = [StudyRun("s", p.directory.name, p, **known) for p in parts]
        self.parts_of.return_value = runs
        return parts

    def execute(self, **changed: Any) -> int | None:
        """Make the runs of the plan."""
        options = argparse.Namespace(
            **{**vars(study_command.ALL), "jobs": 1, **changed}
        )
        study = Study("s", "s", self.plan.scene, [self.whole])
        with contextlib.redirect_stdout(io.StringIO()):
            return self.plan.run_missing(study, options)

    def test_again(self) -> None:
        """What is missing runs; a window with a result is repeated with --again only,
        and the means are there after each of them."""
        first, second = self.give(Status.SUCCESS, Status.SUCCESS)
        first.execute()
        self.execute()
        self.assertEqual((first.calls, second.calls), (1, 1))
        self.assertEqual(self.whole.results.summary["wall_time_s"], 4.0)
        self.execute(again=True)
        self.assertEqual((first.calls, second.calls), (2, 2))

    def test_part(self) -> None:
        """A job of an array makes its windows, and the means wait for all of them."""
        first, second = self.give(Status.SUCCESS, Status.SUCCESS)
        self.assertEqual(self.execute(part=(2, 2)), 0)
        self.assertEqual((first.calls, second.calls), (0, 1))
        self.assertFalse((self.whole.run.directory / "history.csv").exists())
        with self.assertRaisesRegex(StudyError, "not run"):
            self.execute(evaluate=True)
        self.assertEqual(self.execute(part=(1, 2)), 0)
        self.assertEqual(self.execute(evaluate=True), None)
        self.assertEqual(self.whole.results.summary["wall_time_s"], 4.0)

    def test_a_window_that_breaks_off(self) -> None:
        """It is no result, also when the command is given again; the message names the
        log of the window."""
        for status in (Status.FAILURE, Status.STOPPED, None):
            self.give(Status.SUCCESS, status)
            for _ in range(2):
                with self.assertRaisesRegex(StudyError, "/1/log"):
                    self.execute()
                self.assertFalse((self.whole.run.directory / "history.csv").exists())

    def test_parts(self) -> None:
        """Each window has a share of the time, and a folder of its own."""
        self.plan.entries = dict(Windows.THIN)
        parts = command.Plan.parts_of(self.plan, self.whole)
        self.assertEqual([part.duration for part in parts], [4.0, 4.0])
        names = [part.run.directory.name for part in parts]
        self.assertEqual(names, ["to_1_m", "to_2_m"])
        for part, end in zip(parts, (1.0, 2.0)):
            self.assertEqual(part.run.entries["Time/End penetration"], end)
            self.assertEqual(part.run.entries["Output/Frame interval"], "never")
        other = self.plan.run("default", {})
        self.assertEqual(command.Plan.parts_of(self.plan, other), [other])


if __name__ == "__main__":
    unittest.main()
