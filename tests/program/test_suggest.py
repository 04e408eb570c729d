#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""caisson suggest: scenes for one's own caisson."""
import argparse
import re
import tomllib
import unittest
from pathlib import Path
from unittest import mock

from program import SUCCESS, HERE, ProgramTest, caisson, history, summary

from caisson import density_law, disk
from caisson.runner import read_parameters
from caisson.suggest.soil import LAWS
from caisson.design import cone_file
from lab.stability import suggested

EXAMPLE = HERE.parent / "prm/cpt_example.csv"
SAND = "0: Friction angle = 33, Youngs modulus = 20e6"


class SuggestTest(ProgramTest):
    """Calls the command as a user does. The page by hand methods is made where a test
    is about it."""

    has_page = False

    def setUp(self) -> None:
        if not self.has_page:
            patch = mock.patch("caisson.suggest.by_hand", return_value="")
            self.enterContext(patch)

    def suggest(
        self,
        path: Path,
        *words: str,
        status: int = 0,
        layers: tuple[str, ...] = (SAND,),
    ) -> str:
        """Run the command, for a coarse mesh unless its error is given; return what it
        says."""
        given = [w for layer in layers for w in ("--layer", layer)]
        given += [] if "--error" in words else ["--error", "20"]
        return self.caisson("suggest", str(path), *given, *words, status=status)

    def assert_without_doubt(self, said: str) -> None:
        """Ask that the program, which the command has asked about the scene, has
        accepted it without a likely mistake."""
        self.assertIn("is valid", said)
        self.assertNotIn("warning", said)

    def caisson(self, *words: str, status: int = 0) -> str:
        """Run a command for a caisson of 10 m, unless other sizes are given."""
        sizes = {"--diameter": "10", "--skirt": "8", "--wall": "40mm"}
        given = [w for k, v in sizes.items() if k not in words for w in (k, v)]
        done = caisson(*words, *given)
        text = done.stdout + done.stderr
        self.assertEqual(done.returncode, status, text)
        return text


class Sizes(SuggestTest):
    """Caissons of all sizes."""

    def test_scenes_are_accepted(self) -> None:
        """By the program, without a likely mistake; the cost is reported."""
        cases = [
            ("10", "8", "40mm", "2"),
            ("20", "20", "5cm", "10"),
            ("150mm", "200mm", "1.6mm", "20"),
            ("0.2", "2", "8mm", "20"),  # ten diameters
        ]
        for number, (diameter, skirt, wall, error) in enumerate(cases):
            with self.subTest(diameter=diameter, wall=wall):
                path = self.made_directory() / f"own{number}.prm"
                sizes = ["--diameter", diameter, "--skirt", skirt, "--wall", wall]
                text = self.suggest(path, *sizes, "--error", error)
                self.assertRegex(text, r"duration +about \d")
                self.assert_without_doubt(text)

    def test_drawn_at_random(self) -> None:
        """In growing clay and in layers: the first such scenes of the laboratory run
        without a warning of what the tool has chosen."""
        options = argparse.Namespace(
            results=self.made_directory(), validate=False, walls=0.02, limit=1000
        )
        for number in range(3, suggested.QUICK):
            case = suggested.case_of(suggested.SEED, number)
            with self.subTest(case.soil):
                file = options.results / f"scene_{number:02d}.prm"
                self.assertTrue(suggested.write_scene(case, file), case.faults)
                self.assertEqual(suggested.try_case(case, options).faults, [])


class Band(SuggestTest):
    """Scenes of low and high resistance beside the best one."""

    has_page = True

    def test_scenes_are_accepted(self) -> None:
        """In words, and by a spread with its study; each run has its own directory, and
        the low one the lower strength. test_cone_test.py has those of a cone test."""
        cases: list[tuple[list[str], tuple[str, ...]]] = [
            (["--low", "0: phi = 30", "--high", "0: phi = 36"], (SAND,)),
            (["--spread", "phi 5%, su 20%"], (SAND, "2: su = (10 + 2*d) kPa")),
        ]
        for words, layers in cases:
            path = self.made_directory(f"{len(layers)}") / "own.prm"
            study = path.with_suffix(".toml")
            words += ["--study", str(study)]
            text = self.suggest(path, *words, layers=layers)
            self.assertRegex(text, "own_high.prm, .*own.html; next: .* --band")
            self.assert_without_doubt(text)
            values = []
            for end in ("_low", "", "_high"):
                scene = path.with_name(f"own{end}.prm")
                if end:
                    self.run_program(SUCCESS, scene, "--validate", "--strict")
                entries = read_parameters([str(scene)])
                self.assertEqual(entries["Output/Directory"], f"results/own{end}")
                values.append(float(entries["Soil/Layer 1/Friction angle"]))
            self.assertEqual(values, sorted(set(values)))
            page = path.with_suffix(".html").read_text(encoding="utf-8")
            self.assertIn("By hand methods, not computed: jacked to", page)
            self.assertRegex(page, r"It takes about \d.*<code>.*run --band ")
            self.caisson_study(study)

    @mock.patch("caisson.suggest.by_hand", return_value="")
    def test_band_of_a_scene_before(self, _: mock.Mock) -> None:
        """Its scenes are no band of a new one without such: they are refused, and put
        aside with --overwrite, though the user may have changed them."""
        path = self.made_directory() / "own.prm"
        self.suggest(path, "--low", "0: phi = 30", "--high", "0: phi = 36")
        low, high = (path.with_name(f"own_{end}.prm") for end in ("low", "high"))
        path.unlink()
        text = self.suggest(path, "--high", "0: phi = 37", status=1)
        self.assertIn(f"{low} exists; --overwrite moves it away", text)
        text = self.suggest(path, "--high", "0: phi = 37", "--overwrite")
        kept = path.parent / "earlier_1" / low.name
        self.assertIn(f"kept: {low} is now {kept}", text)
        self.assertTrue(kept.is_file() and high.is_file() and not low.exists())

    def caisson_study(self, file: Path) -> None:
        """Let the program read the runs of a study."""
        study = tomllib.loads(file.read_text(encoding="utf-8"))
        if study.get("sampling") != "Latin hypercube":
            return
        changes = [
            word
            for parameter in study["parameters"].values()
            for entry, value in parameter["times"].items()
            for word in ("--set", f"{entry}=1.05*({value})")
        ]
        self.assertGreater(len(changes), 2)
        self.run_program(SUCCESS, file.with_suffix(".prm"), *changes, "--validate")


class Layers(SuggestTest):
    """Layers, and the study of their angles."""

    def test_layers_that_change_with_depth(self) -> None:
        """Expressions are kept whole, with the commas between their parentheses."""
        path = self.made_directory() / "layered.prm"
        layers = (
            SAND + ", Overconsolidation ratio = min(5, 1 + 1e5/max(s, 1))",
            "2: Friction angle = 0, Cohesion = max(5e3, 2e3*d), Youngs modulus = 6e6,"
            " Poisson ratio = 0.45, K0 = 1, Friction angle of the walls = 0,"
            " Adhesion factor of the walls = 1, Sensitivity = 3",
        )
        self.suggest(path, layers=layers)
        said = self.run_program(SUCCESS, path, "--print-parameters", "--strict")
        self.assertIn("Overconsolidation ratio = min(5, 1 + 1e5/max(s, 1))", said)
        self.assertIn("Cohesion = max(5e3, 2e3*d)", said)

    def test_other_laws(self) -> None:
        """What is marked ASSUMED is the default of the program, which takes all."""
        defaults = read_parameters(["--set", "Soil/Number of layers=1"])
        undrained = {("NGI-ADP", "Poisson ratio")}  # of which the program warns
        for law, entries in LAWS.items():
            for name, (_, value) in entries.items():
                if value and (law, name) not in undrained:
                    default = defaults[f"Soil/Layer 1/{name}"]
                    self.assertEqual(float(value), float(default), name)
        path = self.made_directory() / "laws.prm"
        layers = (
            "0: Law = ngi-adp, suA = 30 kPa, K0 = 0.9",
            "5: phi = 33, E = 60 MPa, OCR = 2",
        )
        said = self.suggest(path, "--wall-friction", "15", layers=layers)
        self.assert_without_doubt(said)
        text = path.read_text(encoding="utf-8")
        self.assertIn("set Direct shear strength ratio = 0.7 # ASSUMED\n", text)
        self.assertIn("set Active strength = 30000\n", text)

    def test_undrained_clay_of_another_law(self) -> None:
        """NGI-ADP has adhesion alone, its tip too, and suction without a flow."""
        path = self.made_directory() / "own.prm"
        layers = ("0: Law = NGI-ADP, suA = (20 + 1.5*d) kPa, alpha = 0.4",)
        self.suggest(path, "--weight", "300kN", layers=layers)
        self.assertIn("set Suction control = required", path.read_text("utf-8"))
        self.assert_without_doubt(self.suggest(path, "--overwrite", layers=layers))
        entries = read_parameters([str(path)])
        for place in ("outer wall", "inner wall", "tip"):
            self.assertEqual(
                float(entries[f"Rigid body/Friction angle of the {place}"]), 0
            )
        self.assertEqual(entries["Soil/Layer 1/Adhesion factor of the walls"], "0.4")

    def test_study_of_the_friction_angle(self) -> None:
        """It is read, and has five runs with angles of walls that follow."""
        path = self.made_directory()
        study = path / "own_study.toml"
        layers = (SAND, "3: Friction angle = 37, Youngs modulus = 4e7")
        said = self.suggest(path / "own.prm", "--study", str(study), layers=layers)
        self.assertIn(str(study), said)
        angles = {}
        with open(study, "rb") as file:
            choices = tomllib.load(file)["parameters"]["friction angle"]["choices"]
        for name, entries in choices.items():
            angles[name] = [entries[f"Soil/Layer {i}/Friction angle"] for i in (1, 2)]
            wall = entries["Rigid body/Friction angle of the inner wall"]
            self.assertAlmostEqual(wall, 2 / 3 * angles[name][0], delta=0.1)
        self.assertEqual(list(angles), [f"{a}, {a + 4}" for a in range(29, 38, 2)])
        self.assertEqual(angles["33, 37"], [33, 37])
        listed = caisson("study", study, "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertIn("friction angle of layers 1 and 2 of own.prm", listed.stdout)
        for words in (
            ["--overwrite", "--study", str(path / "study.txt")],
            ["--study", str(study)],
        ):
            self.suggest(path / "new.prm", *words, status=1, layers=layers)

    def test_no_thin_cell_above_a_layer(self) -> None:
        """Where the moving zone ends close to the top of a layer, here 5 cm below it,
        the soil collapsed: 230 kJ at 0.6 m, and no force at the tip."""
        path = self.made_directory()
        layers = (
            "0: Friction angle = 38, Youngs modulus = 5e6",
            "2.95: Friction angle = 43, Youngs modulus = 4e7",
        )
        self.suggest(path / "own.prm", layers=layers)
        zone = read_parameters([str(path / "own.prm")])["Grid/Moving zone below tip"]
        self.assertAlmostEqual(float(zone), 2.45)
        entries = {"Time/End penetration": 0.6, "Output/Frame penetrations": ""}
        entries |= {f"Material points/Per direction {at}": 2 for at in ("near", "far")}
        where = ["--output-directory", path / "run"]
        self.run_program(SUCCESS, path / "own.prm", *where, entries=entries)
        last = history(path / "run")[-1]
        self.assertGreater(last["tip_force_N"], 1e5)
        self.assertLess(last["kinetic_energy_J"], 1e3)

    def test_what_is_left_out(self) -> None:
        """A part of the skirt and the suction are said; tip and K0 are assumed, and
        the number of points, which splitting doubles, is that of the start."""
        path = self.made_directory() / "own.prm"
        said = self.suggest(path)
        self.assertIn("ends at 7.5 m, and the skirt is 8 m long: --penetration 8", said)
        self.assertIn("without suction. For suction add --weight", said)
        self.assertRegex(said, r"points +\d+ at the start, and about \d+ at the end")
        self.assertRegex(said, r"frames +9, ")
        assumed = re.findall(r"set (.*?) *=.*# ASSUMED", path.read_text("utf-8"))
        names = {"Tip", "Tip angle", "Friction angle of the tip", "K0"}
        self.assertEqual(names - set(assumed), set())
        words = ["--weight", "2e6", "--penetration", "8", "--overwrite"]
        said = self.suggest(path, *words, layers=(SAND + ", K0 = 0.5",))
        self.assertNotIn("skirt is", said)
        self.assertNotIn("For suction", said)
        assumed = re.findall(r"set (.*?) *=.*# ASSUMED", path.read_text("utf-8"))
        self.assertNotIn("K0", assumed)

    def test_what_is_given_is_in_effect(self) -> None:
        path = self.made_directory() / "own.prm"
        layers = (SAND, "3.5: friction angle = 37, Youngs modulus=4e7, porosity=0.35")
        words = ["--wall-friction", "25", "--weight", "2e6", "--water-depth", "30"]
        self.suggest(path, *words, "--penetration", "6", layers=layers)
        entries = read_parameters([str(path)])
        for name, value in {
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 3.5,
            "Soil/Layer 2/Porosity": 0.35,
            "Soil/Layer 2/Friction angle": 37,
            "Rigid body/Friction angle of the inner wall": 25,
            "Rigid body/Submerged weight": 2e6,
            "Rigid body/Wall thickness": 0.04,
            "Water/Water depth": 30,
            "Time/End penetration": 6,
        }.items():
            self.assertAlmostEqual(float(entries[name]), value, msg=name)
        self.assertEqual(entries["Water/Level"], "seepage")
        assumed = re.findall(r"set (.*?) *=.*# ASSUMED", path.read_text("utf-8"))
        self.assertIn("Poisson ratio", assumed)
        self.assertIn("Permeability", assumed)
        self.assertNotIn("Friction angle", assumed)


class Words(SuggestTest):
    """Symbols and units of engineers."""

    def test_they_mean_the_same(self) -> None:
        """As the long names in SI units; a scene of undrained clay is accepted."""
        path = self.made_directory()
        pairs = {
            "short.prm": "0: phi = 33, E = 20 MPa, c = 1 kPa, nu = 0.25, OCR = 2",
            "long.prm": "0: Friction angle = 33, Youngs modulus = 20e6,"
            " Cohesion = 1000, Poisson ratio = 0.25, Overconsolidation ratio = 2",
        }
        found = []
        for name, layer in pairs.items():
            weight = "2500kN" if name == "short.prm" else "2.5e6"
            words = ["--weight", weight, "--error", "20%"]
            self.suggest(path / name, *words, layers=(layer,))
            found.append(read_parameters([str(path / name)]))
        short, long = found
        for entry in ("Friction angle", "Youngs modulus", "Cohesion", "Poisson ratio"):
            name = f"Soil/Layer 1/{entry}"
            self.assertEqual(float(short[name]), float(long[name]), name)
        for name in ("Overconsolidation ratio", "Porosity", "Permeability"):
            self.assertEqual(*(entries[f"Soil/Layer 1/{name}"] for entries in found))
        self.assertEqual(float(short["Rigid body/Submerged weight"]), 2.5e6)
        clay = "0: su = 20 kPa, E = 4 MPa, gamma = 17 kN/m3"
        self.assert_without_doubt(self.suggest(path / "clay.prm", layers=(clay,)))
        light = "0: phi = 33, E = 20 MPa, gamma = 12 kN/m3"
        said = self.suggest(path / "light.prm", layers=(light,))
        self.assertIn("warning: layer from 0 m: gamma = 12 kN/m3 is taken as", said)

    def test_a_refused_scene_is_not_in_the_way(self) -> None:
        """Where the program refuses it, neither scene nor study is left."""
        path = self.made_directory()
        words = ["--study", str(path / "s.toml")]
        wrong = SAND + ", nu = 0.7"
        said = self.suggest(path / "own.prm", *words, status=1, layers=(wrong,))
        self.assertIn("the program refuses the scene, which is not written:", said)
        self.assertEqual(list(path.iterdir()), [])
        self.suggest(path / "own.prm", *words, layers=(SAND,))

    def test_law_before_walls(self) -> None:
        """What the program refuses of a law is said before a wall friction is asked
        for."""
        file = self.made_directory() / "own.prm"
        said = self.suggest(file, status=1, layers=("0: Law = hypoplastic sand",))
        self.assertIn("Set hypoplastic sand with intergranular strain", said)
        self.assertNotIn("--wall-friction", said)
        elastic = "0: Law = linear elastic, E = 20 MPa"
        said = self.suggest(file, status=1, layers=(elastic,))
        self.assertIn("has no friction angle from which", said)

    def test_scene_of_an_ags_file(self) -> None:
        """It has the chosen test as a table beside it."""
        path = self.made_directory()
        rows = EXAMPLE.read_text("utf-8").splitlines()
        cells = [r.split(",") for r in rows if r[:1].isdigit()]
        heads = "LOCA_ID,SCPT_DPTH,SCPT_RES,SCPT_FRES,SCPT_PWP2"
        lines = [["GROUP", "SCPT"], ["HEADING", *heads.split(",")]]
        lines.append(["UNIT", "", "m", "MPa", "kPa", "kPa"])
        lines += [["DATA", name, *row] for name in ("A", "B") for row in cells]
        text = "\n".join(",".join(f'"{cell}"' for cell in line) for line in lines)
        (path / "site.ags").write_text(text, "utf-8")
        words = ["--cpt", str(path / "site.ags")]
        said = self.suggest(path / "own.prm", *words, status=1, layers=())
        self.assertIn("2 tests: A, B; choose one by --location", said)
        self.suggest(path / "own.prm", *words, "--location", "B", layers=())
        files = path / "own_cone.csv", EXAMPLE
        kept, given = map(cone_file.read, files)
        self.assertEqual(list(kept.depth), list(given.depth))
        self.assertLess(abs(kept.resistance / given.resistance - 1).max(), 1e-6)


class SandByDensity(SuggestTest):
    """Sand that is given by its density alone; the text is in python/tests."""

    def accepted(self, *words: str) -> dict[str, str]:
        """Return the entries of a scene that the program accepts without a likely
        mistake."""
        path = self.made_directory() / "own.prm"
        sizes = ["--diameter", "4", "--skirt", "2.5", "--wall", "20mm"]
        said = self.suggest(path, *sizes, *words, "--error", "20", layers=())
        self.assertRegex(said, r"assumed: \d+ lines of .*own.prm are marked ASSUMED")
        self.assert_without_doubt(said)
        return read_parameters([str(path)])

    def test_hypoplastic_sand(self) -> None:
        """By a word or a number, jacked or with suction; a cone test refuses it."""
        law = ("--law", "hypoplastic")
        entries = self.accepted("--sand", "dense", "--weight", "1e5", *law)
        self.assertEqual(entries["Soil/Layer 1/Law"], density_law.HYPOPLASTIC)
        self.assertEqual(float(entries["Soil/Layer 1/Relative density"]), 0.75)
        self.assertEqual(float(entries["Soil/Layer 1/K0"]), 0.5)
        self.accepted("--density", "0.3", *law)
        path, words = self.made_directory() / "own.prm", ["--cpt", str(EXAMPLE), *law]
        said = self.suggest(path, *words, status=1, layers=())
        self.assertIn("answers a cone with 0.4 of the resistance", said)

    def test_law_by_density(self) -> None:
        """That of words and of cone tests where no law is asked for."""
        for words in (
            ["--sand", "dense", "--weight", "1e5"],
            ["--layer", "0: Sand = loose", "--layer", "1: Relative density = 0.85"],
            ["--cpt", str(EXAMPLE)],
        ):
            entries = self.accepted(*words)
            self.assertEqual(entries["Soil/Layer 1/Law"], density_law.LAW)

    def test_density_in_run_json(self) -> None:
        """From there the design methods take it: that of the scene or, of hypoplastic
        sand, that between its void ratios: (0.84 - 0.6) / 0.31."""
        path = self.made_directory()
        short = {"Time/End penetration": 0.51, "Output/Frame penetrations": ""}
        given = {
            f"Soil/Layer 1/{name}": value
            for name, value in (
                ("Relative density", 0.6),
                ("Minimum void ratio", 0.5),
                ("Maximum void ratio", 0.9),
            )
        }
        cases: list[tuple[str, dict[str, float], float | None]] = [
            ("jack_coarse", {}, None),
            ("jack_coarse", given, 0.6),
            ("jack_dense_sand", {}, 0.7741935),
        ]
        for name, entries, expected in cases:
            where = path / f"{name}{len(entries)}"
            words = [HERE.parent / f"prm/{name}.prm", "--output-directory", where]
            self.run_program(SUCCESS, *words, entries={**short, **entries})
            (layer,) = summary(where)["scene"]["layers"]
            if expected is None:
                self.assertNotIn("relative_density", layer)
            else:
                self.assertAlmostEqual(layer["relative_density"], expected, places=6)

    def test_what_cannot_be_meant(self) -> None:
        """A line each, and no file."""
        path = self.made_directory() / "own.prm"
        for words, said in (
            (["--sand", "dens"], "did you mean dense?"),
            (["--density", "85"], "Did you mean 0.85?"),
            (["--sand", "clay"], "clay is given by its strength"),
        ):
            text = self.suggest(path, *words, status=1, layers=())
            self.assertIn(said, text)
            self.assertNotIn("Traceback", text)
            self.assertFalse(path.exists())


class Files(SuggestTest):
    """What is written and said."""

    def test_it_runs(self) -> None:
        path = self.made_directory()
        self.suggest(path / "own.prm", "--error", "10")
        self.run_program(
            SUCCESS,
            path / "own.prm",
            "--output-directory",
            path / "run",
            entries={"Time/End penetration": 0.51, "Output/Frame penetrations": ""},
        )
        self.assertGreater(history(path / "run")[-1]["tip_force_N"], 1e4)

    def test_edge_at_a_face(self) -> None:
        """The reach of the halved cells follows such a tip, which is twice as high."""
        path = self.made_directory() / "own.prm"
        words = ["--wall", "50mm", "--diameter", "6", "--error", "20"]
        self.suggest(path, *words, "--density", "0.75", layers=())
        for edge in (0, 1):
            edges = {"Rigid body/Edge of the tip": edge}
            self.run_program(SUCCESS, path, "--validate", entries=edges)

    def test_no_study_no_scene(self) -> None:
        """Where the study cannot be written, no scene is left either."""
        path = self.made_directory()
        loose = ("0: Friction angle = 3, Youngs modulus = 20e6",)
        for study, layers, why in (
            ("study.toml", loose, "-1 degrees"),
            ("missing/study.toml", (SAND,), "no directory"),
        ):
            with self.subTest(study=study):
                words = ["--study", str(path / study)]
                said = self.suggest(path / "own.prm", *words, status=1, layers=layers)
                self.assertIn(why, said)
                self.assertEqual(list(path.iterdir()), [])

    def test_angle_is_enough(self) -> None:
        """The modulus of sand grows with its angle, as with its density."""
        moduli = []
        for angle in (30, 35, 40):
            path = self.made_directory(f"of_{angle}") / "own.prm"
            self.suggest(path, layers=(f"0: phi = {angle}",))
            entries = read_parameters([str(path)])
            moduli.append(float(entries["Soil/Layer 1/Youngs modulus"]))
            self.assertRegex(path.read_text("utf-8"), "Youngs modulus .*ASSUMED: D_r")
        self.assertLess(10e6, moduli[0])
        self.assertLess(moduli[0], moduli[1])
        self.assertLess(moduli[1], moduli[2])
        self.assertLess(moduli[2], 130e6)

    def test_refusals(self) -> None:
        """One clear line each, and no file."""
        path = self.made_directory() / "own.prm"
        refusals: list[tuple[list[str], tuple[str, ...], str]] = [
            (["--wall", "40"], (SAND,), "append mm"),
            (["--wall", "4 inch"], (SAND,), "no length"),
            (["--penetration", "9"], (SAND,), "length of the skirt"),
            (["--water-depth", "9"], (SAND,), "give --weight"),
            (["--weight", "-1"], (SAND,), "must be positive"),
            ([], (SAND.replace("20e6", "20"),), "did you mean 20 MPa"),
            ([], (SAND + ", K0 = 0.2",), "K0"),
            (["--wall-friction", "0.5"], (SAND,), "if this is the tangent write 26.6"),
            (["--tops", "0,3"], (SAND,), "--tops is for a cone test"),
            ([], ("0: Friction angle = 33 + 0.1*d",), "needs Youngs modulus"),
            ([], ("0: Youngs modulus = 1e7",), "needs Friction angle"),
            ([], ("0: phi = 33, Dr = 60%",), "leave out either"),
            ([], ("0: su = 0 kPa",), "su = 0 Pa must be positive"),
            ([], ("0: su = -20 kPa",), "must be positive"),
            ([], ("0: Frction angel = 33",), "did you mean Friction angle"),
            ([], ("1: Friction angle = 33, Youngs modulus = 1e7",), "begin at 0"),
            ([], (SAND, SAND), "deeper than the one before"),
            ([], ("Friction angle = 33",), "must begin with the depth"),
            ([], ("0: Friction angle",), "ENTRY = VALUE"),
            (["--embedment", "0", "--weight", "1MN"], (SAND,), "without --weight"),
            (["--embedment", "9"], (SAND,), "less than 7.5 m"),
            (
                ["--weight", "1e6"],
                (SAND, "2: " + SAND[3:] + ", Permeability=1e-5"),
                "all",
            ),
        ]
        for words, layers, said in refusals:
            with self.subTest(said=said):
                status = 2 if said.startswith(("no length", "if this")) else 1
                text = self.suggest(path, *words, status=status, layers=layers)
                self.assertIn(said, text)
                self.assertFalse(path.exists())
        self.suggest(path)
        self.assertIn("--overwrite", self.suggest(path, status=1))


class Page(SuggestTest):
    """What `caisson report` makes of a scene."""

    def test_page_of_a_changed_scene(self) -> None:
        """A factor that is added to the scene is on its page, in the place of the page
        before; what only a run has is refused."""
        path = self.made_directory() / "own.prm"
        sizes = ["--diameter", "15", "--skirt", "9", "--wall", "50mm"]
        words = [*sizes, "--weight", "9MN", "--error", "20", "--density", "0.85"]
        self.suggest(path, *words, layers=())
        page = path.with_suffix(".html")
        disk.write(page, "of the scene before")
        design = "subsection Design\n  set Factor on piping = 1.5\nend\n"
        path.write_text(path.read_text() + design)
        done = caisson("report", "--k-tan-delta-inside", "0.3,0.5", str(path))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("(piping by Houlsby & Byrne, factor 1.5)", done.stdout)
        self.assertIn("factor 1.5", page.read_text())
        self.assertIn("K tan δ = 0.3 to 0.5", page.read_text())
        self.assertEqual(list(path.parent.glob("earlier_*")), [])
        done = caisson("report", "--author", "A. Smith", str(path))
        self.assertIn("own.prm has no run yet: leave --author out", done.stderr)
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
