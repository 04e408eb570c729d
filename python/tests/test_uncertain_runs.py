# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of parameters with a stand-in for the program: checked, run, resumed in
parts, and evaluated."""
import contextlib
import csv
import fcntl
import io
import json
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
from synthetic import write_run

from caisson import __main__ as program
from caisson import progress, run_error_bar, runs, study_command, uncertain
from caisson.uncertain import effects, pictures, tables
from caisson.uncertain.outcome import Outcomes
from caisson.ranks import cores
from caisson.results import read_table
from caisson.runner import Run
from caisson.runs import execute
from caisson.study import Options, Study, StudyError

FAKE_PROGRAM = Path(__file__).resolve().parent / "fake_program.py"
HEAD = 'kind = "parameters"\nscene = "a.prm"\n'
PHI = '[parameters."Soil/Friction angle"]\n'
# starts one process only, and keeps the words of the call
MPIRUN = """#!/bin/sh
echo "$*" >>{}
while [ "$1" != -np ]; do shift; done
shift 8
exec "$@"
"""
PUSHED = np.linspace(0.5, 4.5, 401)


class WithFiles(unittest.TestCase):
    """A directory with a scene and a study."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        (self.path / "a.prm").touch()

    def write(self, text: str) -> Path:
        """Write the study."""
        file = self.path / "s.toml"
        file.write_text(HEAD + text, encoding="utf-8")
        return file

    def rows(self, name: str) -> list[dict[str, str]]:
        """Return the rows of a file of the study."""
        with open(self.path / "results/s" / name, encoding="utf-8") as file:
            return list(csv.DictReader(file))


class Commands(WithFiles):
    """caisson study FILE."""

    def study(self, *options: str) -> tuple[int, str]:
        """Run the command; return its status and all that it says."""
        words = [str(self.path / "s.toml"), "--program", str(FAKE_PROGRAM)]
        words += ["--results", str(self.path / "results"), *options]
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            status = program.main(["study", *words])
        return status, said.getvalue()

    def calls(self) -> list[str]:
        """Return the runs that the stand-in has made, in the order of their names."""
        path = self.path / "results/s/calls"
        return sorted(path.read_text().split()) if path.exists() else []

    def test_resumed_with_a_failure(self) -> None:
        """A run that breaks off is in the table as far as it went, and in the status;
        values that are added are run, the others are not run again."""
        self.write(PHI + "values = [30, 42]")
        status, said = self.study()
        self.assertEqual(status, 1)
        self.assertIn("Friction angle 42: failed, the soil is too strong", said)
        self.write("depths = [1, 4]\n" + PHI + "values = [30, 34, 42]")
        status, said = self.study("--jobs", "3")
        self.assertIn("runs to do: 1, about 30 s to 1.5 min, 3 at a time", said)
        made = ["Friction_angle_30", "Friction_angle_34", "Friction_angle_42"]
        self.assertEqual(self.calls(), made)
        rows = self.rows("table.csv")
        at = [[row[f"total_force_N at {x} m"] for x in (1, 4)] for row in rows]
        self.assertEqual(at, [["35000", "140000"], ["39000", "156000"], ["47000", ""]])
        states = [row["status"] for row in rows]
        self.assertEqual(states, ["complete", "complete", "failed"])
        self.assertEqual(rows[2]["largest_penetration_m"], "3")
        self.assertEqual(rows[0]["largest_total_force_N"], "157500")
        self.assertGreater(float(rows[0]["wall_time_s"]), 0)
        curves = read_table(self.path / "results/s/fan.csv")
        force = curves["total_force_N [Friction angle 34]"]
        np.testing.assert_allclose(force, 39000 * curves["penetration_m"])
        self.assertEqual(len(curves), 3, "two runs that count")
        fan = self.path / "results/s/fan.png"
        self.assertGreater(fan.stat().st_size, 10000)

    def test_parts(self) -> None:
        """Two parts make all runs, each its own; what is there is evaluated without
        the program."""
        self.write(
            'sampling = "one at a time"\n'
            + PHI
            + 'values = [28, 34]\n[parameters."Soil/Kind"]\nvalues = ["gravel"]'
        )
        self.assertEqual(self.study("--part", "2/3")[0], 0)
        self.assertEqual(self.calls(), ["Friction_angle_28"])
        status, said = self.study("--evaluate")
        self.assertEqual(status, 1)
        self.assertIn("Friction angle 34: not run", said)
        self.assertIn("base: not run", said)
        status, said = self.study("--part", "1/3")
        self.assertEqual(status, 0)
        self.assertIn("part 1 of 3: 2 of 2 runs are complete", said)
        self.assertEqual(self.study("--part", "3/3")[0], 0)
        self.assertEqual(len(self.calls()), 4)
        status, said = self.study("--evaluate", "--program", "/nowhere")
        self.assertEqual(status, 1, "the base is read from the scene")
        self.assertIn("no program /nowhere", said)
        status, said = self.study("--evaluate")
        self.assertEqual(status, 0)
        self.assertIn("148.5 kN (-6 %) at 28", said)
        self.assertIn("s: next: open", said)
        self.assertTrue((self.path / "results/s/tornado.png").exists())
        for part in ("0/3", "4/3", "3"):
            with self.assertRaises(SystemExit):
                self.study("--part", part)

    def test_checked_before_the_first_run(self) -> None:
        self.write(PHI + "values = [30, -1, -2]")
        status, said = self.study()
        self.assertEqual(status, 1)
        self.assertIn("'Friction angle -1' is refused: bad input", said)
        self.assertIn("(so is 1 of the other runs)", said)
        self.write(PHI + 'values = [30]\nentry = "Soil/Frction angle"')
        status, said = self.study()
        self.assertIn("there is no entry Soil/Frction angle", said)
        self.assertEqual((status, self.calls()), (1, []))

    def test_all_fail(self) -> None:
        """There is a table of how far they came, and no picture."""
        self.write(PHI + "values = [41, 42]")
        status, said = self.study()
        self.assertEqual(status, 1)
        self.assertIn("Friction angle 42: failed, the soil is too strong", said)
        self.assertEqual(self.rows("table.csv")[1]["total_force_N at 2 m"], "94000")
        self.assertFalse((self.path / "results/s/fan.png").exists())

    def test_changed_study(self) -> None:
        """Results of other values under the same name do not count."""
        text = 'sampling = "Latin hypercube"\nsamples = 5\nseed = {}\n' + PHI
        text += 'distribution = "uniform"\nmin = 30\nmax = 35'
        self.write(text.format(1))
        self.assertEqual(self.study()[0], 0)
        self.write(text.format(2))
        status, said = self.study("--evaluate")
        self.assertEqual(status, 1)
        self.assertIn("no run has results (out of date", said)

    def test_a_run_that_is_computed_elsewhere(self) -> None:
        """Its directory is left alone; what is not its own stays in any case."""
        self.write(PHI + "values = [30, 34]")
        place = self.path / "results/s/Friction_angle_30"
        place.mkdir(parents=True)
        (place / "precious").touch()
        (place.parent / "table.csv").write_text("precious")
        (place / "log").write_text("pen 0.1 m | tip 1 kN")
        with open(place / ".lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            status, said = self.study()
        self.assertEqual(status, 1)
        self.assertIn("s Friction angle 30: another process computes in", said)
        self.assertIn("Friction angle 30: no result, another process computes", said)
        self.assertIn("kept: ", said)
        kept = place.parent / "earlier_1/table.csv"
        self.assertEqual(kept.read_text(encoding="utf-8"), "precious")
        self.assertTrue((place / "precious").exists())
        self.assertEqual(self.calls(), ["Friction_angle_34"])
        (place / "forces.png").touch()  # not of this run, which has not been made
        self.assertEqual(self.study("--again")[0], 0)
        self.assertTrue((place / "forces.png").exists())
        self.assertEqual(self.study("--again")[0], 0)
        self.assertTrue((place / "precious").exists())
        self.assertFalse((place / "forces.png").exists())

    def test_a_run_that_was_stopped(self) -> None:
        """It goes on from its checkpoint, but with --again from its start."""
        self.write(PHI + "values = [30, 34]")
        place = self.path / "results/s/Friction_angle_30"
        place.mkdir(parents=True)
        (place / "checkpoint.info").touch()
        self.assertIn("s Friction angle 30: goes on from its", self.study()[1])
        self.assertEqual(self.calls(), ["Friction_angle_30+", "Friction_angle_34"])
        (place / "run_key.json").unlink()
        self.study("--again")
        self.assertEqual(self.calls().count("Friction_angle_30+"), 1)
        self.assertEqual(len(self.calls()), 4)

    def test_damaged_results_are_computed_again(self) -> None:
        """Those without history.csv, and with a run.json that is no list, from their
        start, though there is a checkpoint; the evaluation alone says what is wrong."""
        self.write(PHI + "values = [30, 34]")
        self.study()
        for number, name in enumerate(("history.csv", "run.json"), 3):
            place = self.path / "results/s/Friction_angle_30"
            (place / "checkpoint.info").touch()
            (place / name).write_bytes(b"")
            self.assertIn(str(place / name), self.study("--evaluate")[1])
            self.assertEqual(self.study()[0], 0)
            self.assertEqual(self.calls().count("Friction_angle_30"), number - 1)
            self.assertEqual(len(self.calls()), number)

    def test_a_checkpoint_that_is_of_no_use(self) -> None:
        """Where the program refuses to go on, or has nothing to do and leaves no
        results, the run begins anew; that of a user leaves that to him."""
        for status, is_of_user in ((1, False), (0, False), (1, True), (3, False)):
            run = Run(self.path / "s.prm", {}, self.path, program=FAKE_PROGRAM)
            run.restarts, run.is_of_user = True, is_of_user
            with mock.patch.object(run, "execute", return_value=status) as execute:
                runs.StudyRun("s", "", run).execute(again=True)
            anew = status != 3 and not is_of_user
            self.assertEqual(execute.call_count, 1 + anew)
            self.assertEqual((run.restarts, run.overwrites), (not anew, anew))

    def test_a_resumed_run_keeps_its_ranks(self) -> None:
        """Those of its checkpoint, whatever the cores allow now."""
        run = Run(self.path / "s.prm", {}, self.path, program=FAKE_PROGRAM)
        (self.path / "run.json").write_text('{"ranks": 3}', encoding="utf-8")
        run.restarts = True
        of_study = runs.StudyRun("s", "", run)
        with mock.patch.object(run, "command", side_effect=RuntimeError) as command:
            self.assertRaises(RuntimeError, of_study.execute, True, None, 1)
        command.assert_called_once_with(3)
        (self.path / "run.json").write_text("no list", encoding="utf-8")
        self.assertIsNone(of_study.ranks_before)

    def jobs_of(self, study: Study) -> int:
        """Return how many runs of a study are made at a time."""
        with contextlib.redirect_stdout(io.StringIO()):
            return runs.shares_of(study.runs, None)[0][1]

    def test_jobs(self) -> None:
        """As many runs at a time as there are cores for their ranks."""
        self.write("ranks = 1000\n" + PHI + "values = [30]")
        options = Options(program=FAKE_PROGRAM)
        file = self.path / "s.toml"
        module = study_command.module_of(file)
        (study,) = study_command.reader_of(file, options, module).studies()
        self.assertEqual(self.jobs_of(study), 1)
        self.write(PHI + "values = [30]")
        (study,) = study_command.reader_of(file, options, module).studies()
        self.assertEqual(self.jobs_of(study), cores())

    def test_last_runs_get_more_ranks(self) -> None:
        """Of three long runs on two cores, the last one is lent the core that is free;
        that is no reason to run it again."""
        tools = self.path / "bin"
        tools.mkdir()
        mpirun = tools / "mpirun"
        mpirun.write_text(MPIRUN.format(self.path / "started"), encoding="utf-8")
        mpirun.chmod(0o755)
        path = f"{tools}:{os.environ['PATH']}"
        self.write(PHI + "values = [30, 32, 34]")
        with mock.patch.object(runs, "cores", return_value=2), mock.patch.dict(
            os.environ, {"PATH": path, "FAKE_PROGRAM_POINTS": "40000"}
        ):
            status, said = self.study()
            self.assertEqual(status, 0, said)
            how = "2 of them 2 at a time on one rank each, then 1 at a time on 2 ranks"
            self.assertIn("runs to do: 3, about 2.4 to 7.1 min, " + how, said)
            started = (self.path / "started").read_text(encoding="utf-8")
            self.assertEqual(started.count("-np 2"), 1, started)
            self.assertEqual(len(started.splitlines()), 1, started)
            self.assertIn("runs to do: 0\n", self.study()[1])

    def test_progress_of_all_shares(self) -> None:
        """Runs that are made one after the other are counted with those at a time."""
        self.write(PHI + "values = [30, 32, 34]")
        file = self.path / "s.toml"
        options = Options(program=FAKE_PROGRAM, results=self.path / "results")
        module = study_command.module_of(file)
        (study,) = study_command.reader_of(file, options, module).studies()
        seen = []
        with mock.patch.object(
            progress.Progress, "end", autospec=True, side_effect=progress.Progress.end
        ) as end:
            execute([(study.runs[:2], 2, None), (study.runs[2:], 1, None)])
            for call in end.call_args_list:
                seen.append(call.args[0].words()[1].split(",")[0])
        self.assertEqual(seen, ["3 of 3 runs"] * 3)

    def test_list(self) -> None:
        """Where the file does not say how long runs take, the program does."""
        self.write(PHI + "values = [30, 32, 34, 36, 38]")
        words = (
            "5 runs, about 7.5 to 22 min on one core, by the speed of the first steps\n"
        )
        self.assertEqual(self.study("--list")[1], f"s: s, {words}")
        self.write("seconds = 30\n" + PHI + "values = [30, 32]")
        self.assertIn("2 runs, about 60 s on one core\n", self.study("--list")[1])
        self.write(PHI + "values = [-1]")
        self.assertIn("1 runs, duration not known", self.study("--list")[1])


class Edited(WithFiles):
    """A scene that its user edits while it runs."""

    def test_its_result_is_of_the_scene_before(self) -> None:
        """So that the next call runs it again."""
        text, value = self.path / "program", self.path / "value"
        head = "subsection Output\n  set Directory = x\n  set Value = %s\nend\n"
        text.write_text(
            f'#!/bin/sh\ncase "$*" in *--print*) printf "{head}" $(cat {value});;'
            f" *) echo 2 >{value};; esac\n"
        )
        text.chmod(0o755)
        value.write_text("1")
        table = {"time_s": np.arange(2.0)}
        write_run(self.path / "r", table, {})
        for is_complete in (False, True):  # the second one is of the new scene
            run = Run(self.path / "a.prm", {}, self.path / "r", program=text)
            self.assertEqual(run.execute(), 0)
            again = Run(self.path / "a.prm", {}, self.path / "r", program=text)
            self.assertEqual(again.is_complete(), is_complete)


class Evaluation(WithFiles):
    """Effects and quantiles of made-up results."""

    def outcomes(self, text: str, force: str, summary: dict[str, object]) -> Outcomes:
        """Return the outcomes of a study whose forces, in N, are an expression of the
        penetration d, the number i of the run and its sample s."""
        file = self.write(text)
        options = Options(results=self.path / "results", program=FAKE_PROGRAM)
        module = study_command.module_of(file)
        study: Study
        (study,) = study_command.reader_of(file, options, module).studies()
        for i, run in enumerate(study.runs):
            names = {"d": PUSHED, "i": i, "s": run.settings["sample"]}
            table = {"time_s": PUSHED, "penetration_m": PUSHED}
            table["total_force_N"] = eval(force, names) + 0 * PUSHED
            write_run(run.run.directory, table, summary)
            record = {
                "key": "",
                "entries": run.run.entry_texts(),
                "status": 0,
                "wall_s": 1,
                "cpu_s": 1,
            }
            (run.run.directory / "run_key.json").write_text(json.dumps(record))
        return Outcomes(study)

    def test_one_at_a_time(self) -> None:
        """An effect that is largest between the ends of its parameter, and the larger
        effect first."""
        found = self.outcomes(
            'sampling = "one at a time"\n'
            + PHI
            + "values = [28, 31, 34]\nbase = 30\n"
            + '[parameters."Soil/Stiffness"]\nvalues = [1e6, 9e6]\nbase = 5e6',
            'd * (9 - (s["Soil/Friction angle"] - 30)**2 + s["Soil/Stiffness"] / 1e6)',
            {},
        )
        base, (first, second) = effects.effects_of(found, 2.0)
        self.assertAlmostEqual(base, 28)
        self.assertEqual(first.parameter.name, "Soil/Friction angle")
        self.assertEqual(first.ends, (34, 30))
        self.assertAlmostEqual(first.low, -4)
        self.assertFalse(first.rises)
        self.assertEqual(second.ends, (1e6, 9e6))
        np.testing.assert_allclose((second.low, second.high), (20, 36))
        self.assertTrue(second.rises)

    def test_warnings(self) -> None:
        """What a run says against its results is in the table, on the terminal and
        below the picture; what it says of its input is not."""
        texts = {"result": "the mesh is too coarse", "input": "a small angle"}
        ranked = [{"rank": rank, "text": text} for rank, text in texts.items()]
        known: dict[str, object] = {"results": {"warnings": ranked}}
        found = self.outcomes(PHI + "values = [30, 32]", "1.23456e7 * d + i", known)
        self.assertIn("see table.csv: Friction", pictures.caption(found, ""))
        tables.write_runs(self.path / "table.csv", found)
        for text in (
            (self.path / "table.csv").read_text(encoding="utf-8"),
            said := "\n".join(tables.lines(found, 4.0)),
        ):
            self.assertIn("the mesh is too coarse", text)
            self.assertNotIn("a small angle", text)
        self.assertIn("numbers of ranks differ by about 1 %", said)
        self.assertIn("| 49380 | 55560 |", said)

    def test_grid(self) -> None:
        """Main effects: means over the other parameter."""
        found = self.outcomes(
            'sampling = "grid"\n'
            + PHI
            + "values = [30, 32]\n"
            + '[parameters."Soil/Kind"]\nvalues = ["a", "b", "c"]',
            's["Soil/Friction angle"] + 100 * "cab".index(s["Soil/Kind"])',
            {},
        )
        base, (kind, angle) = effects.effects_of(found, found.tornado_depth())
        self.assertAlmostEqual(base, 131)
        self.assertEqual((kind.ends, angle.ends), (("c", "b"), (30, 32)))
        np.testing.assert_allclose((kind.low, kind.high), (31, 231))
        np.testing.assert_allclose((angle.low, angle.high), (130, 132))
        self.assertFalse(kind.rises, "the order of the list")

    LATIN = (
        'sampling = "Latin hypercube"\nsamples = {}\n'
        + PHI
        + 'distribution = "normal"\nmean = 33\nstandard_deviation = 2\n'
        + '[parameters."Soil/Stiffness"]\ndistribution = "uniform"\nmin = 1\nmax = 2'
    )

    def test_latin_hypercube(self) -> None:
        """A force that falls with the angle alone: any monotonic one has a rank
        correlation of -1. Quantiles of many runs, and of few."""
        falling = 'd * 2.0**(40 - s["Soil/Friction angle"])'
        found = self.outcomes(self.LATIN.format(12), falling, {})
        _, (angle, other) = effects.effects_of(found, 3.0)
        self.assertAlmostEqual(angle.high, -1)
        self.assertLess(abs(other.high), effects.chance(12))
        self.assertAlmostEqual(effects.chance(12), 0.576, 3)
        few = self.outcomes(self.LATIN.format(11), "1e3 * d * (i + 1)", {})
        names, values = effects.spread(few.matrix(np.array([2.0])))
        self.assertEqual((names[0], names[-1]), ("smallest", "largest"))
        np.testing.assert_allclose(values[[0, 2, 4], 0], [2e3, 12e3, 22e3])
        many = self.outcomes(self.LATIN.format(21), "1e3 * d * (i + 1)", {})
        names, values = effects.spread(many.matrix(np.array([2.0])))
        self.assertEqual(names, ["5 %", "25 %", "50 %", "75 %", "95 %"])
        np.testing.assert_allclose(values[:, 0], [4e3, 12e3, 22e3, 32e3, 40e3])

    def test_error_bar(self) -> None:
        """That of the scene, relative to the force."""
        found = self.outcomes(PHI + "values = [30]", "1e3 * d", {})
        bar = run_error_bar.beside(found.study.runs[0].run.scene)
        bar.write_text(
            "# fingerprint: x\npenetration_m,total_below,total_above\n"
            "1,0.1,0\n3,0.2,0.1\n"
        )
        depths = np.array([1.0, 2.0, 4.0])
        error = found.error(depths, np.array([10.0, -10.0, 10.0]))
        assert error is not None
        np.testing.assert_allclose(error, [[1, 1.5, np.nan], [0, 0.5, np.nan]])
        bar.unlink()
        self.assertIsNone(found.error(depths, depths))

    def test_suction(self) -> None:
        """The required suction is observed where there is one, from the weight that
        suffices to 2 m; the table has both. A printed table has kPa."""
        found = self.outcomes(PHI + "values = [30, 33]", "1e3 * d", {})
        for run in found.study.runs:
            suction = np.maximum(PUSHED - 2, 0) * 1e4
            table = read_table(run.run.directory / "history.csv")
            table |= {"suction_Pa": suction, "required_suction_Pa": 1e4 * (PUSHED - 2)}
            write_run(run.run.directory, table, {})
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            options = Options(results=self.path / "results")
            self.assertEqual(uncertain.evaluate([found.study], options, 0), 0)
        row = self.rows("table.csv")[1]
        self.assertAlmostEqual(float(row["penetration_by_weight_m"]), 2)
        self.assertAlmostEqual(float(row["required_suction_Pa at 1 m"]), -1e4)
        self.assertIn("required suction (kPa)", said.getvalue())
        self.assertRegex(said.getvalue(), r"angle 33 +\| -10 +\|")

    def test_observed(self) -> None:
        """What there is; what there is not is refused with the columns there are."""
        found = self.outcomes(PHI + "values = [30]", "1e3 * d", {})
        self.assertEqual(found.column, "total_force_N")
        np.testing.assert_array_equal(found.depths, [1, 2, 3, 4, 4.5])
        for text, words in {
            'observe = "tip_force"': "choose one of time_s, penetration_m, total_force",
            'depths = "all"': "depths is 'all'; give depths in m",
        }.items():
            with self.assertRaisesRegex(StudyError, words):
                self.outcomes(text + "\n" + PHI + "values = [30]", "d", {})
        with self.assertRaisesRegex(StudyError, "all forces are 0"):
            self.outcomes(PHI + "values = [30]", "0 * d", {})
        deep = self.outcomes("tornado_depth = 9\n" + PHI + "values = [30]", "d", {})
        with self.assertRaisesRegex(StudyError, "tornado_depth = 9 m: no run"):
            deep.tornado_depth()


if __name__ == "__main__":
    unittest.main()
