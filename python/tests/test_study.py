# SPDX-License-Identifier: LGPL-2.1-or-later
"""The format of studies, verdicts that need no run, and the bar of a study, which is on
a terminal only, and never within a line of a log file."""
import contextlib
import io
import math
import tempfile
import time
import types
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

from caisson import progress, study_command
from caisson.paths import SCENES
from caisson.progress import Progress
from caisson.runner import Run
from caisson.study import read_toml, Study, StudyError
from lab import study_command as lab_studies, verification
from lab.study import LabReader, Options

HEAD = """
kind = "forces"
set = {"A/a" = 1, "A/b" = 1}
[variants]
other = {"A/d" = 4}
"""


KIND = types.ModuleType("a kind")
vars(KIND)["STUDY_KEYS"] = {"mine"}


class Format(unittest.TestCase):
    """What a file means."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)

    def read(self, text: str, **options: Any) -> list[Study]:
        """Return the studies of a file; "mine" is the key of the kind."""
        file = self.path / "test.toml"
        file.write_text(text, encoding="utf-8")
        asked = Options(results=self.path / "results", **options)
        return LabReader(file, asked, KIND).studies()

    def test_a_file_is_one_study(self) -> None:
        (study,) = self.read('kind = "forces"\nscene = "a.prm"\nmine = 3')
        self.assertEqual((study.id, study.title), ("test", "test"))
        self.assertEqual(study.keys, {"mine": 3})
        (run,) = study.runs
        self.assertEqual(run.run.scene, self.path.resolve() / "a.prm")
        self.assertEqual(run.run.directory, (self.path / "results/test").resolve())

    def test_order_of_entries(self) -> None:
        text = (
            HEAD
            + """
[[study]]
id = "s"
scene = "a.prm"
set = {"A/b" = 2, "A/c" = 2}
runs = [{name = "x", set = {"A/c" = 3, "A/d" = 3}}, {}]
variants = ["default", "other"]
meshes = {fine = {"A/e" = 5}, coarse = {}}
reference = {"A/f" = 6}
"""
        )
        (study,) = self.read(text)
        names = [run.name for run in study.runs]
        self.assertEqual(
            names[:3], ["default_fine_x", "default_coarse_x", "other_fine_x"]
        )
        self.assertEqual(names[-1], "reference")
        self.assertEqual(len(names), 2 * 2 * 2 + 1)
        entries = study.run("other_fine_x").run.entries
        self.assertEqual([entries[f"A/{c}"] for c in "abcde"], [1, 2, 3, 4, 5])
        entries = study.run("default_coarse_1").run.entries
        self.assertEqual(entries, {"A/a": 1, "A/b": 2, "A/c": 2})
        self.assertEqual(study.run("reference").run.entries["A/f"], 6)

    def test_variants_of_a_single_study(self) -> None:
        text = 'kind = "forces"\nscene = "a.prm"\n[variants]\np = {"A/a" = 1}\nq = {}'
        (study,) = self.read(text)
        self.assertEqual([run.name for run in study.runs], ["p", "q"])

    def test_variants_of_a_run(self) -> None:
        """A run has its own list in the place of that of its study."""
        text = (
            HEAD
            + """
[[study]]
id = "s"
scene = "a.prm"
variants = ["default"]
runs = [{name = "x"}, {name = "y", variants = ["", "other"]}]
"""
        )
        (study,) = self.read(text)
        names = [run.name for run in study.runs]
        self.assertEqual(names, ["default_x", "y", "other_y"])
        self.assertNotIn("A/d", study.run("y").run.entries)
        self.assertEqual(study.run("other_y").run.entries["A/d"], 4)

    def test_quick(self) -> None:
        text = """
kind = "forces"
[[study]]
id = "slow"
scene = "a.prm"
[[study]]
id = "quick"
scene = "a.prm"
seconds = 9
quick = {seconds = 1, mine = "fast"}
"""
        self.assertEqual(len(self.read(text)), 2)
        (study,) = self.read(text, quick=True)
        self.assertEqual((study.id, study.runs[0].seconds), ("quick", 1))
        self.assertEqual(study.keys["mine"], "fast")
        self.assertEqual([s.id for s in self.read(text, only="^slow$")], ["slow"])

    def test_unknown_keys_are_refused(self) -> None:
        with self.assertRaisesRegex(StudyError, "no key secnds; known: .*seconds"):
            self.read('kind = "forces"\nscene = "a.prm"\nsecnds = 1')
        with self.assertRaisesRegex(StudyError, "a run of study test has no key sett"):
            self.read('kind = "forces"\nscene = "a.prm"\nruns = [{sett = 1}]')
        with self.assertRaisesRegex(StudyError, "no variant 'v'"):
            self.read('[[study]]\nid = "s"\nscene = "a.prm"\nvariants = ["v"]')
        with self.assertRaisesRegex(StudyError, "has no scene"):
            self.read('[[study]]\nid = "s"')

    def test_directories(self) -> None:
        """Each run has its own, below that of the results."""
        one = '[[study]]\nscene = "a.prm"\nid = '
        for name in ('".."', '"."', '"..."', '""', "5", '"a\\nb"'):
            with self.assertRaisesRegex(StudyError, "no name for a directory|no id"):
                self.read(one + name)
        with self.assertRaisesRegex(StudyError, "2 runs would write into .*/a_b"):
            self.read(f'{one}"a b"\n{one}"a/b"')

    def test_files_that_cannot_be_read(self) -> None:
        (self.path / "latin.toml").write_bytes(b'kind = "x"\ntitle = "Gr\xfcndung"')
        with self.assertRaisesRegex(StudyError, "latin.toml, line 2: the byte 0xfc"):
            read_toml(self.path / "latin.toml")
        with self.assertRaisesRegex(StudyError, "deep.toml: "):
            (self.path / "deep.toml").write_text("a = " + "[" * 9999)
            read_toml(self.path / "deep.toml")
        with self.assertRaisesRegex(StudyError, "test.toml"):
            self.read("kind = ")
        with self.assertRaisesRegex(StudyError, "kind is 'x', not one of"):
            file = self.path / "kind.toml"
            file.write_text('kind = "x"')
            study_command.module_of(file)


class OwnStudies(unittest.TestCase):
    """The studies of users and of the laboratory."""

    def studies(self, file: Path) -> list[Study]:
        """Return the studies of a file."""
        module = study_command.module_of(file, lab_studies.KINDS)
        options = Options(results=Path("results"))
        return lab_studies.reader_of(file, options, module).studies()

    def test_all_can_be_read(self) -> None:
        """And name scenes that there are, each run a directory of its own."""
        files = lab_studies.files()
        self.assertLessEqual(set(lab_studies.STUDIES.values()), set(files))
        for file in files:
            runs = [run for study in self.studies(file) for run in study.runs]
            for run in runs:
                self.assertTrue(run.run.scene.is_file(), run.run.scene)
            places = {run.run.directory for run in runs}
            self.assertEqual(len(places), len(runs), file)

    def test_users_need_no_laboratory(self) -> None:
        """Only a study that makes an error bar does, and the message says so."""
        for file in sorted(SCENES.rglob("*.toml")):
            if read_toml(file)["kind"] != "error bar":
                self.assertTrue(study_command.module_of(file).STUDY_KEYS, file)
        with self.assertRaisesRegex(StudyError, "error bar.*scripts/lab study"):
            study_command.module_of(SCENES / "jack_study.toml")

    def test_every_stability_scene_is_judged(self) -> None:
        file = lab_studies.STUDIES["stability"]
        runs = [run for study in self.studies(file) for run in study.runs]
        scenes = {run.run.scene.name for run in runs}
        self.assertLessEqual({path.name for path in file.parent.glob("*.prm")}, scenes)


class Verdicts(unittest.TestCase):
    """What the ladder says of a value."""

    def test_judge(self) -> None:
        judge = verification.judge
        self.assertEqual(judge(0.01, 0.01, None, False), verification.PASS)
        self.assertEqual(judge(0.02, 0.01, None, False), verification.FAIL)
        self.assertEqual(judge(0.02, 0.01, 0.02, False), verification.KNOWN)
        self.assertEqual(judge(0.0203, 0.01, 0.02, False), verification.KNOWN)
        self.assertEqual(judge(0.0205, 0.01, 0.02, False), verification.FAIL)
        self.assertEqual(judge(1.9, 1.8, None, True), verification.PASS)
        self.assertEqual(judge(1.3, 1.8, 1.3, True), verification.KNOWN)
        self.assertEqual(judge(1.2, 1.8, 1.3, True), verification.FAIL)
        self.assertEqual(judge(None, 1, 1, True), verification.FAIL)
        self.assertEqual(judge(math.nan, 1, 1, False), verification.FAIL)

    def test_slope(self) -> None:
        self.assertAlmostEqual(verification.slope([0, 1, 2], [1, 3, 5]), 2)


class Terminal(io.StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self) -> bool:
        """It is."""
        return True


class Bars(unittest.TestCase):
    """What is written where."""

    def setUp(self) -> None:
        interval = mock.patch("caisson.progress.INTERVAL", 0.01)
        interval.start()
        self.addCleanup(interval.stop)
        names = {"TERM": "xterm", "COLUMNS": "70"}
        environment = mock.patch.dict("os.environ", names)
        environment.start()
        self.addCleanup(environment.stop)

    def run_two(self, stream: io.StringIO) -> str:
        """Return the lines about two runs, whose bar goes to a stream."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            with Progress([1.0, 1.0], stream) as shown:
                for number in range(2):
                    shown.start(number)
                    time.sleep(0.1)
                    shown.end(number)
                    shown.say(f"run {number}: 1 s")
        return said.getvalue()

    def test_terminal(self) -> None:
        """The bar is cleared before each line and at the end."""
        stream = Terminal()
        self.assertEqual(self.run_two(stream), "run 0: 1 s\nrun 1: 1 s\n")
        bars = stream.getvalue().split("\r\x1b[K")
        self.assertIn("[............", bars[1])
        self.assertIn("1 of 2 runs, 50 %", stream.getvalue())
        self.assertEqual(bars[-1], "")

    def test_log_file(self) -> None:
        stream = io.StringIO()
        self.assertEqual(self.run_two(stream), "run 0: 1 s\nrun 1: 1 s\n")
        self.assertEqual(stream.getvalue(), "")
        with mock.patch.dict("os.environ", {"TERM": "dumb"}):
            self.run_two(terminal := Terminal())
        self.assertEqual(terminal.getvalue(), "")

    def test_lines_in_a_log_file(self) -> None:
        """Whole ones, after each twentieth of the work, by what runs say themselves."""
        told = iter([0.0, 0.02, 0.4, 0.41, 0.9])
        stream = io.StringIO()
        shown = Progress([1e3], stream, lambda _: share)
        shown.start(0)
        shown.begin -= 60.0
        with mock.patch("caisson.progress.SILENCE", 0.0):
            for share in told:
                shown._draw()
        self.assertRegex(
            stream.getvalue(),
            r"^0 of 1 runs, 40 %, about 9\d s|1.5 min left\n"
            r"0 of 1 runs, 90 %, about 6\.\d s left\n$",
        )
        self.assertEqual(len(stream.getvalue().splitlines()), 2)

    def test_share(self) -> None:
        """By durations; one that is not known counts as the mean of the others, and one
        that takes longer than expected is not done."""
        shown = Progress([30.0, 10.0, 0.0])
        shown.start(2)
        shown.begins[2] -= 1000.0
        self.assertAlmostEqual(shown.share, 0.95 * 20 / 60)
        self.assertEqual(shown.line(80), f"[{'#' * 7}{'.' * 17}] 0 of 3 runs, 32 %")
        self.assertEqual(len(shown.line(20)), 19)

    def test_time_left(self) -> None:
        """From the runs that have ended, which may take longer than expected."""
        shown = Progress([30.0, 10.0, 20.0])
        shown.begin -= 90.0
        shown.start(0)
        shown.begins[0] -= 60.0
        shown.end(0)
        shown.start(2)
        shown.begins[2] -= 30.0
        self.assertAlmostEqual(shown.scale, 2.0, places=2)
        self.assertAlmostEqual(shown.share, (30 + 15) / 60, places=2)
        self.assertRegex(shown.line(80), "] 1 of 3 runs, 75 %, about 30 s left$")

    def test_share_of_a_run(self) -> None:
        """By the time that it expects to need still, not by its depth."""
        with tempfile.TemporaryDirectory() as folder:
            run = Run(Path("a.prm"), directory=Path(folder))
            self.assertEqual(run.share_done(30.0), 0.0)
            line = "pen 1 m | total 8 kN |  12.0 % | ETA 00:01:30\n"
            (run.directory / "log").write_text(f"{line}a warning\n", encoding="utf-8")
            self.assertAlmostEqual(run.share_done(30.0), 0.25)

    def test_durations(self) -> None:
        words = [progress.duration(x) for x in (4.56, 600, 7200)]
        self.assertEqual(words, ["4.6 s", "10 min", "2 h"])


if __name__ == "__main__":
    unittest.main()
