# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of parameters: distributions, formulas, sampling, and what is refused."""
import math
import tempfile
import unittest
from pathlib import Path
from typing import Any

import numpy as np
from scipy import stats

from caisson import study_command
from caisson.uncertain import effects
from caisson.uncertain.distributions import Distribution
from caisson.uncertain.formula import Formula
from caisson.uncertain.sampling import correlations_of
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError

SHARES = (np.arange(20000) + 0.5) / 20000
PHI = '[parameters."Soil/Friction angle"]\n'
FAKE_PROGRAM = Path(__file__).resolve().parent / "fake_program.py"


class Distributions(unittest.TestCase):
    """Quantiles of a distribution against its moments."""

    def moments(self, name: str, **keys: float) -> tuple[float, float]:
        """Return mean and standard deviation of equally likely values."""
        values = Distribution(name, keys).quantiles(SHARES)
        return float(values.mean()), float(values.std())

    def assert_near(self, found: tuple[float, float], mean: float, sd: float) -> None:
        """Ask for both moments."""
        np.testing.assert_allclose(found, (mean, sd), rtol=2e-3)

    def test_moments(self) -> None:
        """Mean and deviation are those of the quantity, also of a lognormal one."""
        found = self.moments("normal", mean=33, standard_deviation=2)
        self.assert_near(found, 33, 2)
        found = self.moments("normal", mean=-20, coefficient_of_variation=0.1)
        self.assert_near(found, -20, 2)
        found = self.moments("lognormal", mean=6e6, coefficient_of_variation=0.5)
        self.assert_near(found, 6e6, 3e6)
        found = self.moments("uniform", min=2, max=5)
        self.assert_near(found, 3.5, 3 / math.sqrt(12))
        found = self.moments("triangular", min=0, mode=1, max=5)
        self.assert_near(found, 2, math.sqrt((25 + 1 - 5) / 18))
        found = self.moments("beta", min=10, max=30, mean=15, standard_deviation=3)
        self.assert_near(found, 15, 3)

    def test_quantiles(self) -> None:
        """The median of a log-uniform and of a lognormal quantity, and a normal one
        that is cut off at its mean: half of a normal distribution."""
        middle = np.array([0.5])
        found = Distribution("log-uniform", {"min": 1e-6, "max": 1e-4})
        self.assertAlmostEqual(found.quantiles(middle)[0] / 1e-5, 1)
        found = Distribution("lognormal", {"mean": 10, "standard_deviation": 10})
        self.assertAlmostEqual(found.quantiles(middle)[0], 10 / math.sqrt(2))
        keys = {"mean": 30, "standard_deviation": 2, "min": 30, "max": 36}
        values = Distribution("normal", keys).quantiles(SHARES)
        self.assertTrue(np.all((values >= 30) & (values <= 36)))
        self.assertAlmostEqual(values.mean(), 30 + 2 * math.sqrt(2 / math.pi), 1)


class Formulas(unittest.TestCase):
    """Values that follow from others."""

    def test_values(self) -> None:
        values = {"phi": 33, "e": 1e6}
        for text, expected in {
            "2/3 * phi": 22,
            "max(0, phi - 30)": 3,
            "1 - sin(30)": 0.5,
            "-e**0.5 + 2*(phi - 1)": -1000 + 64,
            "atan(tan(phi))": 33,
        }.items():
            self.assertAlmostEqual(Formula(text).value(values), expected)
        self.assertEqual(Formula("max(a, sin(b))").names, {"a", "b"})

    def test_refused(self) -> None:
        for text, words in {
            "1 +": "cannot be read",
            "phi.real": "not understood",
            "__import__('os')": "not understood",
            "phi if phi else 1": "not understood",
            "'a' * 2": "not understood",
            "1 / (phi - 33)": "division by zero",
            "sqrt(-phi)": "math domain",
            "kind + 1": "kind is no number",
        }.items():
            with self.subTest(text), self.assertRaisesRegex(StudyError, words):
                Formula(text).value({"phi": 33, "kind": "sand"})


class Runs(unittest.TestCase):
    """The runs that a file makes."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
        (self.path / "a.prm").touch()

    def study(self, text: str) -> Study:
        """Return the study of a file that begins with the usual keys."""
        file = self.path / "s.toml"
        head = 'kind = "parameters"\nscene = "a.prm"\n'
        file.write_text(head + text, encoding="utf-8")
        options = Options(results=self.path / "results", program=FAKE_PROGRAM)
        module = study_command.module_of(file)
        (study,) = study_command.reader_of(file, options, module).studies()
        return study

    def entries(self, runs: list[StudyRun], entry: str) -> list[Any]:
        """Return an entry of all runs."""
        return [run.run.entries.get(entry) for run in runs]

    def test_list(self) -> None:
        """A single list needs no sampling; a run keeps its name when another value is
        added."""
        study = self.study(PHI + "values = [28, 31.5]")
        self.assertEqual(
            [run.name for run in study.runs],
            ["Friction angle 28", "Friction angle 31.5"],
        )
        self.assertEqual(self.entries(study.runs, "Soil/Friction angle"), [28, 31.5])
        more = self.study(PHI + "values = [25, 28, 31.5]")
        places = [run.run.directory for run in study.runs]
        self.assertEqual([run.run.directory for run in more.runs[1:]], places)

    def test_entries_of_the_same_name(self) -> None:
        """Layers are distinguished."""
        layers = [f'[parameters."Soil/Layer {i}/E"]\nvalues = [{i}]' for i in (1, 2)]
        (run,) = self.study('sampling = "grid"\n' + "\n".join(layers)).runs
        self.assertEqual(run.name, "Layer 1/E 1, Layer 2/E 2")
        self.assertEqual(run.run.directory.name, "Layer_1_E_1_Layer_2_E_2")

    def test_grid_with_formula(self) -> None:
        """All combinations; a formula follows, whatever the order of the file; several
        entries of one parameter."""
        study = self.study(
            """
sampling = "grid"
[parameters.wall]
entries = ["Body/Inner", "Body/Outer"]
formula = "2/3 * phi"
[parameters.phi]
entry = "Soil/Friction angle"
range = {from = 30, to = 36, n = 3}
[parameters."Soil/Stiffness"]
range = {from = 1e6, to = 1e8, n = 3, logarithmic = true}
"""
        )
        self.assertEqual(len(study.runs), 9)
        run = study.run("phi 33, Stiffness 1e+07")
        expected = {"Soil/Friction angle": 33, "Soil/Stiffness": 1e7}
        expected |= {"Body/Inner": 22, "Body/Outer": 22}
        self.assertEqual(run.run.entries, expected)

    def test_choices(self) -> None:
        """Named sets of entries, beside the base of the scene."""
        study = self.study(
            """
sampling = "one at a time"
[parameters.sand.choices]
loose = {"Soil/Porosity" = 0.44, "Soil/Friction angle" = 29}
dense = {"Soil/Porosity" = 0.38}
"""
        )
        self.assertEqual(
            [(run.name, run.run.entries) for run in study.runs],
            [
                ("base", {}),
                ("sand loose", {"Soil/Porosity": 0.44, "Soil/Friction angle": 29}),
                ("sand dense", {"Soil/Porosity": 0.38}),
            ],
        )

    def test_one_at_a_time(self) -> None:
        """The base is the value of the scene, the median, or what is given; a value
        that is the base makes no run of its own; a distribution is taken at 5 and
        95 %."""
        study = self.study(
            """
sampling = "one at a time"
set = {"Soil/Stiffness" = 7e6}
[parameters."Soil/Friction angle"]
values = [28, 30, 32]
[parameters."Soil/Stiffness"]
values = [1e6, 9e6]
[parameters."Soil/Dilatancy"]
distribution = "uniform"
min = 0
max = 10
[parameters."Soil/Kind"]
values = ["sand", "gravel"]
base = "gravel"
"""
        )
        base = study.runs[0].run.entries
        self.assertEqual(study.runs[0].name, "base")
        self.assertEqual(
            [base[f"Soil/{n}"] for n in ("Friction angle", "Stiffness", "Dilatancy")],
            [30, 7e6, 5],
        )
        names = [run.name for run in study.runs[1:]]
        expected = ["Friction angle 28", "Friction angle 32", "Stiffness 1e+06"]
        expected += ["Stiffness 9e+06", "Dilatancy 0.5", "Dilatancy 9.5", "Kind sand"]
        self.assertEqual(names, expected)
        changed = study.run("Dilatancy 9.5").run.entries
        self.assertEqual(changed, {**base, "Soil/Dilatancy": 9.5})

    def latin(self, seed: int) -> list[StudyRun]:
        """Return ten runs of three parameters."""
        return self.study(
            f"""
sampling = "Latin hypercube"
samples = 10
seed = {seed}
{PHI}distribution = "uniform"
min = 30
max = 40
[parameters."Soil/Kind"]
values = ["a", "b"]
[parameters."Soil/Stiffness"]
distribution = "lognormal"
mean = 1e7
standard_deviation = 3e6
"""
        ).runs

    def test_latin_hypercube(self) -> None:
        """One value in each tenth, each word as often; the same of the same seed."""
        runs = self.latin(1)
        self.assertEqual([run.name for run in runs][::9], ["sample 01", "sample 10"])
        angles = self.entries(runs, "Soil/Friction angle")
        self.assertEqual(sorted(int(x - 30) for x in angles), list(range(10)))
        self.assertEqual(self.entries(runs, "Soil/Kind").count("a"), 5)
        again = self.entries(self.latin(1), "Soil/Friction angle")
        self.assertEqual(again, angles)
        other = self.entries(self.latin(2), "Soil/Friction angle")
        self.assertNotEqual(other, angles)

    def test_correlations(self) -> None:
        """Values are paired as asked for, and otherwise as if nothing linked them;
        each parameter keeps its values."""
        text = 'sampling = "Latin hypercube"\nsamples = 200\nCORRELATIONS'
        for name in "abc":
            text += f'\n[parameters.{name}]\nentry = "Soil/{name}"\n'
            text += 'distribution = "lognormal"\nmean = 3\nstandard_deviation = 2'
        found, values = {}, {}
        for given in ("", 'correlations = [["a", "c", -0.7]]'):
            runs = self.study(text.replace("CORRELATIONS", given)).runs
            columns = [self.entries(runs, f"Soil/{name}") for name in "abc"]
            values[given] = [sorted(column) for column in columns]
            found[given] = stats.spearmanr(np.array(columns).T)[0]
        none, some = found.values()
        np.testing.assert_allclose(none, np.eye(3), atol=0.05)
        np.testing.assert_allclose(some[0], [1, 0, -0.7], atol=0.05)
        self.assertEqual(*values.values())

    def assert_refused(self, head: str, cases: dict[str, str]) -> None:
        """Ask that each study, its text after this head, is refused with these words
        and the name of the file."""
        for text, words in cases.items():
            with self.subTest(text), self.assertRaisesRegex(StudyError, words) as seen:
                self.study(head + text)
            self.assertIn("s.toml", str(seen.exception))

    def test_wrong_values(self) -> None:
        self.assert_refused(
            PHI,
            {
                "": "give one of values, range",
                "values = [1]\nrange = {from=1, to=2, n=2}": "only one",
                "values = [1]\nmean = 3": "no key mean; known: base, entries",
                "values = []": "not a list such as",
                "values = [28, nan]": "nan in values",
                "values = [28, 28]": "28 is in values twice",
                "range = {from=3, to=2, n=2}": "from is 3 and must be below to, 2",
                "range = {from=1, to=2, n=1}": "n is 1 and must be",
                "range = {from=0, to=2, n=2, logarithmic=true}": "begins above 0",
                "range = {from=0, n=2}": "give {from = 28",
                'choices = ["loose"]': "give {loose = {",
            },
        )

    def test_wrong_distributions(self) -> None:
        spread = "standard_deviation = "
        self.assert_refused(
            PHI + "distribution = ",
            {
                '"gauss"': "'gauss', not one of normal, lognormal",
                '"triangular"\nmin = 0\nmode = 3\nmax = 2': "mode is 3",
                '"log-uniform"\nmin = 0\nmax = 1': "min is 0 and must be above 0",
                '"lognormal"\nmean = 0\n' + spread + "1": "mean is 0 and must be",
                '"beta"\nmin = 0\nmax = 1\nmean = 0.5\n'
                + spread
                + "0.5": "must be below 0.5",
            },
        )
        self.assert_refused(
            PHI + 'distribution = "normal"\nmean = 33\n',
            {
                "": "needs standard_deviation",
                spread + "-2": "is -2 and must be above 0",
                spread + "0": "is 0 and must be above 0",
                spread + "'2'": "is '2', not a number",
                spread + "2\nmode = 3": "has no mode",
                spread + "2\nmin = 40\nmax = 30": "must be below max, 30",
                spread + "2\nmin = 60": "hardly any",
                spread + "2\ncoefficient_of_variation = 1": "not both",
            },
        )

    def test_wrong_studies(self) -> None:
        two = PHI + "values = [1, 2]\n[parameters.b]\nentry = "
        normal = 'distribution = "normal"\nmean = 33\nstandard_deviation = 2'
        latin = 'sampling = "Latin hypercube"\n'
        pair = PHI + normal + '\n[parameters.b]\nentry = "B/b"\n' + normal
        pair = 'samples = 9\ncorrelations = [["b", {}]]\n' + pair
        self.assert_refused(
            latin,
            {
                pair.format('"b", 0.5'): "give .*two parameters",
                pair.format('"c", 0.5'): "the parameters are Soil/Friction angle, b",
                pair.format('"Soil/Friction angle", 1'): "between -1 and 1",
            },
        )
        with self.assertRaisesRegex(StudyError, "contradict each other"):
            given = [["a", "b", 0.9], ["b", "c", 0.9], ["a", "c", -0.9]]
            correlations_of({"correlations": given}, ["a", "b", "c"])
        self.assert_refused(
            "",
            {
                "": "at least one",
                "[parameters.phi]\nvalues = [1]": "'phi': it says no entry",
                two + '"Soil/Friction angle"\nvalues = [3]': "set the same entry",
                two + '"B/b"\nvalues = [3]': "sampling is missing; choose one of",
                two + '"B/b"\nformula = "2 * c"': "needs c, which no other",
                'sampling = "random"\n' + two + '"B/b"\nvalues = [3]': "'random'",
                'sampling = "grid"\n' + PHI + normal: "a grid needs values",
                "samples = 9\n" + PHI + "values = [3]": "samples is for sampling",
                latin + PHI + normal: "samples is missing",
                latin + "samples = 4\n" + PHI + normal: "too few for 1 parameter",
                "runs = [{}]\n" + PHI + "values = [1]": "has no key runs",
                'sampling = "one at a time"\n[parameters."Soil/x"]\nvalues = [1]': (
                    "the program has no entry Soil/x"
                ),
                "[parameters.a]\nentry='A/a'\nformula='1'": "none varies",
            },
        )


class Chance(unittest.TestCase):
    """The range of rank correlations without any."""

    def test_both_sides(self) -> None:
        """Of ten runs: Student's t of 8 degrees, 2.5 % on each side, is 2.306."""
        self.assertAlmostEqual(effects.chance(10), 2.306 / math.sqrt(8 + 2.306**2), 4)
        self.assertEqual(effects.chance(3), 1.0)


if __name__ == "__main__":
    unittest.main()
