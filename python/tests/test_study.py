# SPDX-License-Identifier: LGPL-2.1-or-later
"""The format of studies, and verdicts that need no run."""
import math
import tempfile
import types
import unittest
from pathlib import Path
from typing import Any

from caisson import study_command
from caisson.paths import SCENES
from caisson.study import Study, StudyError, read_toml
from lab import study_command as lab_studies
from lab import verification
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


if __name__ == "__main__":
    unittest.main()
