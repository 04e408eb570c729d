#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the program says of scenes that it could run, but that are hardly meant."""
import os
import pathlib
import subprocess
import unittest

from program import BAD_INPUT, SUCCESS, Entries, ProgramTest, environment, user_scene

BODY = "Rigid body"
LAYER = "Soil/Layer 1"
WEIGHT: Entries = {f"{BODY}/Motion": "lowered", "Time/End time": 1}
SUCTION: Entries = {"Water/Suction control": "table"}
CLAY: Entries = {
    f"{LAYER}/Friction angle": 0,
    f"{LAYER}/Dilatancy angle": 0,
    f"{LAYER}/Cohesion": 5e3,
    f"{LAYER}/Friction angle of the walls": 0,
    f"{BODY}/Friction angle of the tip": 0,
}
LAW = "hypoplastic sand with intergranular strain"
HYPOPLASTIC: Entries = {f"{LAYER}/Law": LAW, f"{LAYER}/Porosity": 0.36}
SEEPS: Entries = {
    "Water/Level": "seepage",
    f"{LAYER}/Dilatancy angle": 0,
    f"{LAYER}/Friction angle of the walls": 0,
    f"{BODY}/Friction angle of the tip": 0,
}
NGI_ADP: Entries = {f"{LAYER}/Law": "NGI-ADP", f"{LAYER}/Poisson ratio": 0.49}
UNIFORM: Entries = {"Soil/Gravity": "0, 0", "Soil/Initial stress": "uniform"}
DENSITY: Entries = {
    f"{LAYER}/Law": "Mohr-Coulomb by density and stress",
    f"{LAYER}/Minimum void ratio": 0.5,
    f"{LAYER}/Maximum void ratio": 0.9,
}

# words of the warning, entries of a scene that have it, entries that do not
DOUBTS: tuple[tuple[list[str], Entries, Entries], ...] = (
    (["Youngs modulus = 5 Pa", "1e6 Pa"], {f"{LAYER}/Youngs modulus": 5}, {}),
    (["Youngs modulus", "Check the unit"], {f"{LAYER}/Youngs modulus": 1e14}, {}),
    (
        ["Reference stress = 100 Pa", "1 kPa is 1000 Pa"],
        {**DENSITY, f"{LAYER}/Reference stress": 100},
        {**DENSITY, f"{LAYER}/Reference stress": 1e5},
    ),
    (
        ["Smallest stress of stiffness is not below Reference"],
        {**DENSITY, f"{LAYER}/Smallest stress of stiffness": 2e5},
        DENSITY,
    ),
    (
        ["Smallest stress of strength is usually 1.5e5 Pa: check its unit"],
        {**DENSITY, f"{LAYER}/Smallest stress of strength": 150},
        DENSITY,
    ),
    # in kPa or MPa; small numbers that help a computation are no doubt
    (["Cohesion = 6e+07 Pa is not the strength"], {f"{LAYER}/Cohesion": 6e7}, {}),
    (["is it in kPa"], {f"{LAYER}/Cohesion": 60}, {f"{LAYER}/Cohesion": 100}),
    (["Cohesion = 500 Pa"], {**CLAY, f"{LAYER}/Cohesion": 500}, CLAY),
    (
        ["Cohesion = 28", "is not the strength of a soil: is it in kPa"],
        {**CLAY, f"{LAYER}/Cohesion": "2 + 1.5*d"},
        {**CLAY, f"{LAYER}/Cohesion": "1500*d"},
    ),
    (["Active strength = 60 Pa"], {**NGI_ADP, f"{LAYER}/Active strength": 60}, {}),
    (
        ["strength of undrained clay, 6e+04 Pa with a friction angle of 1 degrees"],
        {**SEEPS, f"{LAYER}/Friction angle": 1, f"{LAYER}/Cohesion": 60e3},
        {**SEEPS, f"{LAYER}/Friction angle": 25, f"{LAYER}/Cohesion": 10e3},
    ),
    (["Surcharge = 20 Pa"], {"Soil/Surcharge": 20}, {"Soil/Surcharge": 2e3}),
    (
        ["cut-off = 12 Pa"],
        {f"{LAYER}/Tension cut-off": 12},
        {f"{LAYER}/Tension cut-off": 1e9},
    ),
    (
        ["Adhesion of the outer wall = 5 Pa"],
        {f"{BODY}/Adhesion of the outer wall": 5},
        {f"{BODY}/Adhesion of the outer wall": 2e3},
    ),
    (
        ["Uniform stress is 50 Pa", "the weight of the soil above is"],
        {"Soil/Initial stress": "uniform", "Soil/Uniform stress": "-50, -50, -50, 0"},
        {
            "Soil/Initial stress": "uniform",
            "Soil/Uniform stress": "-5e4, -5e4, -5e4, 0",
        },
    ),
    (
        ["Solid density = 2.65", "t/m3"],
        {f"{LAYER}/Solid density": 2.65, "Soil/Fluid density": 1},
        {f"{LAYER}/Solid density": 2650, "Soil/Fluid density": 1025},
    ),
    (
        ["Fluid density = 10", "kN/m3"],
        {f"{LAYER}/Solid density": 26.5, "Soil/Fluid density": 10},
        {},
    ),
    (
        ["points upward"],
        {"Soil/Gravity": "0, 9.81", "Soil/Initial stress": "none"},
        {"Soil/Gravity": "0, -9.81", "Soil/Initial stress": "none"},
    ),
    (["Gravity", "centrifuge"], {"Soil/Gravity": "0, -9810"}, {}),
    (["Density = 7.85", "steel"], {f"{BODY}/Density": 7.85}, {f"{BODY}/Density": 2400}),
    (
        ["outer wall = 45 degrees", "layer 1, 30 degrees", "Set at most"],
        {f"{BODY}/Friction angle of the outer wall": 45},
        {f"{BODY}/Friction angle of the outer wall": 30},
    ),
    (
        ["outer wall = 20", "friction angle of layer 2, 15", "of the other wall"],
        {
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 2,
            "Soil/Layer 2/Friction angle": 15,
        },
        {
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 8,
            "Soil/Layer 2/Friction angle": 15,
        },
    ),
    (
        ["Layer 2/Friction angle of the walls = 16 degrees", "layer 2, 15 degrees"],
        {
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 2,
            "Soil/Layer 2/Friction angle": 15,
            "Soil/Layer 2/Friction angle of the walls": 16,
        },
        {
            # the tip is rougher than this layer, and smoother than the other
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 2,
            "Soil/Layer 2/Friction angle": 15,
            "Soil/Layer 2/Friction angle of the walls": 15,
        },
    ),
    (
        ["of the tip = 31 degrees", "at most 30 degrees"],
        {f"{BODY}/Friction angle of the tip": 31},
        {f"{BODY}/Friction angle of the tip": 30},
    ),
    (["Cohesion = 0 Pa", "no strength at all"], {**CLAY, f"{LAYER}/Cohesion": 0}, CLAY),
    (
        ["adhesion of 5500 Pa", "the cohesion, 5000 Pa"],
        {**CLAY, f"{LAYER}/Adhesion factor of the walls": 1.1},
        {**CLAY, f"{LAYER}/Adhesion factor of the walls": 1},
    ),
    (
        ["rest is 1 Pa", "at 0.1 m/s, 19 Pa", "thrown about", "Soil/Layer 1"],
        {**UNIFORM, "Soil/Uniform stress": "-1, -1, -1, 0"},
        {**UNIFORM, "Soil/Uniform stress": "-20, -20, -20, 0"},
    ),
    (
        ["Poisson ratio = 0.3", "lets undrained clay change its volume"],
        {f"{LAYER}/Law": "NGI-ADP", f"{LAYER}/Active strength": "60e3 + 5e3*d"},
        {},
    ),
    (
        ["Overconsolidation ratio", "not used", "without a friction angle. Set K0."],
        {**CLAY, f"{LAYER}/Overconsolidation ratio": 4},
        {f"{LAYER}/Overconsolidation ratio": 4},
    ),
    (
        ["layer 2 only 0.05 m thick", "time step"],
        {
            "Soil/Number of layers": 3,
            "Soil/Layer 2/Top depth": 10,
            "Soil/Layer 3/Top depth": 10.05,
        },
        {
            "Soil/Number of layers": 3,
            "Soil/Layer 2/Top depth": 10,
            "Soil/Layer 3/Top depth": 10.5,
        },
    ),
    (
        ["below the soil surface", "Skirt length"],
        {f"{BODY}/Skirt length": 6},
        {f"{BODY}/Skirt length": 6.5},
    ),
    (
        ["Outer radius", "11.9 m from the wall", "at least 15 m"],
        {"Grid/Outer radius": 14.9},
        {"Grid/Outer radius": 15},
    ),
    (
        ["Bottom", "8.9 m below the tip", "at most -15.5 m"],
        {"Grid/Bottom": -15.4},
        {"Grid/Bottom": -15.5},
    ),
    (
        ["Outer radius", "2 m from the wall", "at least 6 m"],
        {
            "Grid/Outer radius": 5,
            "Time/End penetration": 1.5,
            "Output/Frame penetrations": "",
        },
        {
            "Grid/Outer radius": 6,
            "Time/End penetration": 1.5,
            "Output/Frame penetrations": "",
        },
    ),
    (
        ["Fine cell size = 0.12 m", "of the body, 0.2 m", "are 0.1 m wide"],
        {"Grid/Fine cell size": 0.12},
        {"Grid/Fine cell size": 0.1},
    ),
    (
        ["Frame penetrations", "50 m"],
        {"Output/Frame penetrations": "3, 50"},
        {"Output/Frame penetrations": "3, 6.5"},
    ),
    (["moves at 100 m/s", "wave speed"], {f"{BODY}/Velocity": 100}, {}),
    (["6e+13 steps"], {"Time/Time step": 1e-12}, {}),
    (
        ["frames", "Frame interval"],
        {"Time/Time step": 1e-3, "Output/Frame interval": 2e-3},
        {"Time/Time step": 1e-3, "Output/Frame interval": 1},
    ),
    (
        ["rows", "Record interval"],
        {"Time/Time step": 1e-5, "Output/Record interval": 1e-5},
        {"Time/Time step": 1e-5},
    ),
)

# words of the message, entries
REFUSED: tuple[tuple[list[str], Entries], ...] = (
    (
        ["looser than the loosest", "check Granulate hardness"],
        {**HYPOPLASTIC, f"{LAYER}/Granulate hardness": 1.3e6},
    ),
    (["upward", "in tension", "0, -9.81"], {"Soil/Gravity": "0, 9.81"}),
    (["depends on r or z"], {"Loads/Surrounding pressure": "100 + r"}),
    (["Region = 1/0 is inf"], {"Material points/Region": "1/0"}),
    (["Region", "nan"], {"Material points/Region": "sqrt(r - 3)"}),
    (
        ["Prescribed region = 0/0 is", "nan"],
        {"Boundary conditions/Prescribed region": "0/0"},
    ),
    (
        ["Prescribed velocity", "inf"],
        {
            "Boundary conditions/Prescribed region": "r - 14",
            "Boundary conditions/Prescribed velocity": "1/0; 0",
        },
    ),
    (["Initial velocity is"], {"Soil/Initial velocity": "0/0; 0"}),
    (
        ["Passive strength ratio", "from 0.05 to 1"],
        {f"{LAYER}/Law": "NGI-ADP", f"{LAYER}/Passive strength ratio": 1.2},
    ),
    (
        ["Passive strength ratio", "1.2"],
        {f"{LAYER}/Law": "NGI-ADP", f"{LAYER}/Passive strength ratio": "1.2+0*d"},
    ),
    (["Initial velocity", "wave speed"], {"Soil/Initial velocity": "0; 1e200"}),
    (["stability limit", "stiffness"], {f"{LAYER}/Youngs modulus": 1.7e308}),
    (["never end", "stiffness"], {f"{LAYER}/Youngs modulus": 1e308}),
    (
        ["in its region at the start"],
        {"Verification/Observations": "a = mean speed where 0"},
    ),
)

# entries on which warnings of others depend
ALONE = {f"{BODY}/Velocity", "Time/Time step"}


def joined(
    cases: list[tuple[list[str], Entries]]
) -> list[tuple[list[list[str]], Entries]]:
    """Return the words and the entries of scenes that have several cases: those of one
    entry that changes nothing of another one are joined, as long as each sets another
    entry; cases without entries are left out."""
    scenes = list[tuple[list[list[str]], Entries]]()
    for words, entries in cases:
        for others, known in scenes if len(entries) == 1 else ():
            if (known.keys() | entries.keys()) & ALONE:
                continue
            if len(known) == len(others) and not known.keys() & entries.keys():
                others.append(words)
                known.update(entries)
                break
        else:
            if entries:
                scenes.append(([words], dict(entries)))
    return scenes


class Review(ProgramTest):
    """Scenes of which one entry is hardly meant."""

    def validate(self, name: str, entries: Entries) -> str:
        """Return what --validate says of a valid scene."""
        return self.run_program(
            SUCCESS, user_scene(name), "--validate", entries=entries
        )

    def test_hardness_in_kilopascals(self) -> None:
        """Of sand that is dense enough to exist at all with such a hardness."""
        for hardness, is_doubtful in ((5e6, True), (5e9, False)):
            said = self.validate(
                "jack_coarse", {**HYPOPLASTIC, f"{LAYER}/Granulate hardness": hardness}
            )
            words = "Granulate hardness = 5e+06 Pa is not that of a soil"
            self.assertEqual(words in said, is_doubtful, said)

    def test_closed_body(self) -> None:
        """A pile needs more room than a caisson, and has no inner wall."""
        pile = "validation/pile/pile"
        self.assertNotIn("warning", self.validate(pile, {}))
        cases: tuple[tuple[Entries, list[str]], ...] = (
            ({"Grid/Outer radius": 7}, ["6.7 m from the wall", "at least 7.5 m"]),
            ({"Grid/Bottom": -13.5}, ["4.5 m below the tip", "at most -13.8 m"]),
            (
                {f"{BODY}/Adhesion of the inner wall": 1e3},
                ["is set but not used", "no inner wall", "Kind is pile"],
            ),
        )
        for entries, words in cases:
            with self.subTest(entries=entries):
                said = self.validate(pile, entries)
                self.assert_words(["warning: ", *words], said)

    def test_factors_without_suction(self) -> None:
        """Section Design is for a caisson that suction draws in."""
        words = '"Design/Factor on boiling" is set but not used: Water/Level is drained'
        entries: Entries = {"Design/Factor on boiling": 2}
        self.assertIn(words, self.validate("jack_coarse", entries))
        self.assertNotIn("not used", self.validate("suction", entries))

    def test_density_not_given(self) -> None:
        """A law by density, in a scene that does not say how dense the sand is."""
        words = "Porosity = 0.4 is only the default"
        laws: tuple[Entries, ...] = ({f"{LAYER}/Law": LAW}, DENSITY)
        for law in laws:
            for given in (False, True):
                sand = dict(law)
                if given:
                    sand[f"{LAYER}/Porosity"] = 0.4
                said = self.validate("verification/seepage_skirt", sand)
                self.assertEqual(words in said, not given, said)

    def test_stress_that_is_given(self) -> None:
        """A law is held against it, and not against K0, which is not used."""
        sand: Entries = {
            **UNIFORM,
            **DENSITY,
            f"{LAYER}/Void ratio": 0.864,
            "Soil/Uniform stress": "-1e5, -1e5, -1e5, 0",
        }
        self.validate("jack_coarse", sand)
        self.validate("jack_coarse", {**sand, f"{LAYER}/K0": 0.1})
        sand["Soil/Uniform stress"] = "-3e4, -1e5, -5e4, 0"
        rest: tuple[Entries, ...] = ({}, {f"{LAYER}/K0": 1})
        for given in rest:
            said = self.run_program(
                BAD_INPUT,
                user_scene("jack_coarse"),
                "--validate",
                entries={**sand, **given},
            )
            self.assert_words(
                ["Soil/Initial stress gives -3e+04, -1e+05", "more than the strength"],
                said,
            )

    def test_body_begins_below_the_surface(self) -> None:
        """Which no travel brings about."""
        deep: Entries = {
            f"{BODY}/Initial penetration": 7.2,
            "Time/End penetration": "never",
            "Time/End time": 1,
            "Output/Frame penetrations": "",
        }
        said = self.validate("jack_coarse", deep)
        words = ["the top of the body begins at z = -0.2 m", "Initial penetration"]
        self.assert_words(words, said)
        self.assertNotIn("the travel of", said)

    def test_doubts(self) -> None:
        """A warning, and none where the entry is just as it should be."""
        for doubts, entries in joined([(w, entries) for w, entries, _ in DOUBTS]):
            said = self.validate("jack_coarse", entries)
            lines = [x for x in said.splitlines() if x.startswith("warning: ")]
            for words in doubts:
                with self.subTest(words=words):
                    found = [x for x in lines if all(word in x for word in words)]
                    self.assertEqual(len(found), 1, said)
        for doubts, entries in joined([(w, entries) for w, _, entries in DOUBTS]):
            with self.subTest(good=doubts):
                self.assertNotIn("warning", self.validate("jack_coarse", entries))

    def test_places(self) -> None:
        """The warning says where the entry was set."""
        said = self.validate(
            "jack_coarse", {f"{BODY}/Friction angle of the outer wall": 45}
        )
        self.assertIn("Friction angle of the outer wall is set by --set.", said)

    def test_units_of_suction(self) -> None:
        """A suction in kPa, and a weight in kN."""
        table = {**WEIGHT, **SUCTION, "Water/Suction table": "0 : 0, 10 : 90"}
        self.assert_words(
            ["Suction table is 90 Pa", "1 kPa is 1000 Pa"],
            self.validate("suction", table),
        )
        said = self.validate("suction", {"Water/Largest suction": 200})
        self.assert_words(["Largest suction is 200 Pa"], said)
        said = self.validate("suction", {f"{BODY}/Submerged weight": 1000})
        self.assert_words(["Submerged weight = 1000 N", "1 kN is 1000 N"], said)
        table["Water/Suction table"] = "0 : 0, 10 : 9e4"
        said = self.validate("suction", {**table, "Water/Largest suction": 2e5})
        self.assertNotIn("kPa is", said)

    def test_what_cannot_be_meant(self) -> None:
        """It is refused by --validate."""
        for words, entries in REFUSED:
            with self.subTest(words=words):
                self.assert_invalid(words, "jack_coarse", entries)

    def test_end(self) -> None:
        """Of two ends, the earlier one counts."""
        said = self.validate("jack_coarse", {"Time/End time": 1})
        self.assertIn("end        1 s, by Time/End time\n", said)
        said = self.validate("jack_coarse", {"Time/End time": 100})
        self.assertIn("end        60.25 s, by Time/End penetration\n", said)


class Text(ProgramTest):
    """Files and words that were typed or copied with small faults."""

    def refusal(self, *options: str) -> str:
        """Return what is said of bad input."""
        return self.run_program(BAD_INPUT, *options)

    def test_no_break_space(self) -> None:
        """As word processors write them, in a file and on the command line."""
        path = self.made_directory() / "copied.prm"
        path.write_text(
            f"include {user_scene('jack_coarse')}\n"
            "subsection Time\n  set\u00a0Courant\u202fnumber\u00a0= 0.5\nend\n",
            encoding="utf-8",
        )
        entries: Entries = {"Time/Mass\u00a0scaling": 4}
        said = self.run_program(SUCCESS, path, "--print-parameters", entries=entries)
        self.assertIn("set Courant number = 0.5\n", said)
        self.assertIn("set Mass scaling = 4\n", said)

    def test_old_line_ends(self) -> None:
        """A file with carriage returns alone: the line is still found."""
        path = self.made_directory() / "old.prm"
        path.write_text("subsection Time\r  set Tim step = 1\rend\r", newline="")
        self.assertIn(f"{path}:2: ", self.refusal(str(path)))

    def test_endless_file(self) -> None:
        """It is not read to its end."""
        self.assertIn("not a text file", self.refusal("/dev/zero"))
        self.assertIn("/dev/stdin", self.refusal("-"))
        path = self.made_directory() / "long.prm"
        with open(path, "wb") as file:
            for _ in range(17):
                file.write(b" " * 1024 * 1024)
        self.assertIn("more than 16 MB", self.refusal(str(path)))
        os.remove(path)

    def test_standard_input(self) -> None:
        """A scene that comes through a pipe."""
        text = pathlib.Path(user_scene("jack_coarse")).read_text(encoding="utf-8")
        done = subprocess.run(
            self.command("/dev/stdin", "--print-parameters"),
            input=text,
            text=True,
            check=True,
            stdout=subprocess.PIPE,
            env=environment(),
        )
        self.assertIn("set Wall thickness = 0.2\n", done.stdout)

    def test_symbols(self) -> None:
        """The names of symbols of the field."""
        for symbol, name in (
            ("Time/CFL", "Time/Courant number"),
            ("Soil/Layer 2/phi", "Soil/Layer 2/Friction angle"),
            ("E", "Soil/Layer 1/Youngs modulus"),
        ):
            said = self.refusal(user_scene("jack_coarse"), "--set", f"{symbol}=1")
            self.assertIn(f'Did you mean "{name}"?', said)

    def test_nearest_choice(self) -> None:
        """A choice with another case, an option that is like no other."""
        said = self.refusal(user_scene("jack_coarse"), "--set", f"{BODY}/Kind=Caisson")
        self.assertIn('Did you mean "caisson"?', said)
        self.assertNotIn("Did you mean", self.refusal("--foo"))
        self.assertIn('Did you mean "--restart"?', self.refusal("--restrat"))


if __name__ == "__main__":
    unittest.main()
