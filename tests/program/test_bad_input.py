#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bad input is refused with a message that says what to do, and entries that have no
effect are reported."""
import os
import re
import unittest

from program import BAD_INPUT, Entries as Values, ProgramTest, scene, SUCCESS


LAYER = "Soil/Layer 1"
BODY = "Rigid body"
MOVES_UP: Values = {f"{BODY}/Velocity": -0.5, "Time/End penetration": 0}
HYPOPLASTIC: Values = {f"{LAYER}/Law": "hypoplastic sand with intergranular strain"}
DENSITY: Values = {
    f"{LAYER}/Law": "Mohr-Coulomb by density and stress",
    f"{LAYER}/Minimum void ratio": 0.5,
    f"{LAYER}/Maximum void ratio": 0.9,
}
CYLINDER: Values = {f"{BODY}/Kind": "cylinder"}

# words of the message, entries
CONTRADICTIONS: tuple[tuple[list[str], Values], ...] = (
    (["Dilatancy angle", "40", "Lower"], {f"{LAYER}/Dilatancy angle": 40}),
    (["Bolton Q = 5 and", "no critical"], {**DENSITY, f"{LAYER}/Bolton Q": 5}),
    (
        ["angle = 20 and", "index = 0 give", "create energy"],
        {
            **DENSITY,
            f"{LAYER}/Critical friction angle": 20,
            f"{LAYER}/Degrees per dilatancy index": 0,
        },
    ),
    (
        ["Stress measure", "intergranular strain has no elasticity", "Cauchy"],
        {**HYPOPLASTIC, f"{LAYER}/Stress measure": "Kirchhoff"},
    ),
    (
        ["Stiffness factor of turns = 6 exceeds", "reversals = 5"],
        {**HYPOPLASTIC, f"{LAYER}/Stiffness factor of turns": 6},
    ),
    (["Porosity", "0.346405", "0.5"], {**HYPOPLASTIC, f"{LAYER}/Porosity": 0.3}),
    (
        ["Critical void ratio", "order"],
        {**HYPOPLASTIC, f"{LAYER}/Critical void ratio": 0.5},
    ),
    (["Solid density", "float"], {f"{LAYER}/Solid density": 900}),
    (
        ["Cohesion = 5e3 - 4e3*d", "a depth of 1.", "at least 0"],
        {f"{LAYER}/Cohesion": "5e3 - 4e3*d"},
    ),
    (
        ["Youngs modulus", "5 MPa", "expression in d"],
        {f"{LAYER}/Youngs modulus": "5 MPa"},
    ),
    (
        ["Cohesion = 1e3*rand() calls rand()", "at each call and on each rank"],
        {f"{LAYER}/Cohesion": "1e3*rand()"},
    ),
    (
        ["Loads/Body force", "calls rand_seed()"],
        {"Loads/Body force": "rand_seed(1)*r ; 0"},
    ),
    (["Number of layers = 3", "no Soil/Layer 2"], {"Soil/Number of layers": 3}),
    (["Surcharge", "K0"], {"Soil/Surcharge": 1e4, "Soil/Initial stress": "none"}),
    (
        ["Stress expression", "four expressions"],
        {"Soil/Initial stress": "expression", "Soil/Stress expression": "1*z ; 2*z"},
    ),
    (
        ["Outer radius = 1e-09 m", "a cell"],
        {
            f"{BODY}/Kind": "none",
            "Grid/Outer radius": 1e-9,
            "Time/End penetration": 0,
            "Time/End time": 1,
        },
    ),
    (["Frame interval", "at least 1e-09"], {"Output/Frame interval": 1e-300}),
    (["K0", "holds K0 from 0.3337 to 2.999"], {f"{LAYER}/K0": 9}),
    (
        ["Top depth", "layers"],
        {"Soil/Number of layers": 2, "Soil/Layer 2/Porosity": 0.4},
    ),
    (
        ["Layer 2/Top depth = 5 m is not above", "lower the bottom"],
        {"Soil/Number of layers": 2, "Soil/Layer 2/Top depth": 5},
    ),
    (["Wall thickness", "plug"], {f"{BODY}/Wall thickness": 3.5}),
    (["even number"], {f"{BODY}/Cells across the wall": 3}),
    (["Tip angle", "Reduce"], {f"{BODY}/Skirt length": 0.05}),
    (["End penetration", "0.4"], {"Time/End penetration": 0.4}),
    (["no end"], {"Time/End penetration": 0, "Time/End time": 0}),
    (
        ["Stress update = MUSL is unstable", "Set it to auto, or the tolerance"],
        {"Method/Stress update": "MUSL", "Time/Inertia tolerance": 0.4},
    ),
    (["no end"], {f"{BODY}/Velocity": 0}),
    (
        ["moves up", "0.375 m", "stretch"],
        {**MOVES_UP, "Time/End time": 1, "Grid/Moving zone below tip": 10},
    ),
    (
        ["lid", "below the soil surface", "-1"],
        {f"{BODY}/Lid thickness": 3, f"{BODY}/Skirt length": 2.5},
    ),
    (
        ["Lid thickness", "only a caisson"],
        {f"{BODY}/Lid thickness": 0.1, f"{BODY}/Kind": "box"},
    ),
    (["height of the cone", "Skirt length"], {f"{BODY}/Kind": "cone"}),
    (
        ["only grow"],
        {
            **CYLINDER,
            f"{BODY}/Velocity": -0.1,
            "Time/End penetration": 0,
            "Time/End time": 1,
        },
    ),
    (
        ["Outer radius", "column", "0.1 m"],
        {**CYLINDER, "Time/End penetration": 4.9, "Grid/Smallest row height": 0.1},
    ),
    (["cylinder", "Inner radius"], {**CYLINDER, "Grid/Inner radius": 3.5}),
    (["cylinder", "Adhesion"], {**CYLINDER, f"{BODY}/Adhesion of the outer wall": 5}),
    (["Velocity table", "increasing"], {f"{BODY}/Velocity table": "0:0, 2:0.1, 1:0.1"}),
    (["Inner radius", "Outer radius"], {"Grid/Inner radius": 8}),
    (["does not fit", "Outer radius"], {f"{BODY}/Outer diameter": 20}),
    (["does not fit", "Top"], {f"{BODY}/Skirt length": 6}),
    (["Bottom"], {"Grid/Bottom": 1}),
    (["Axis", "roller"], {"Boundary conditions/Axis": "free"}),
    (["Gravity", "none"], {"Soil/Gravity": "1, -9"}),
)


class Entries(ProgramTest):
    """Values of entries."""

    def test_mistyped_entry(self) -> None:
        self.refused(
            [f"{LAYER}/Friction angle"], entries={f"{LAYER}/Friction angel": 30}
        )

    def test_out_of_range(self) -> None:
        self.refused(
            ["Poisson ratio", "0.7", "from 0 to 0.4999"],
            entries={f"{LAYER}/Poisson ratio": 0.7},
        )
        self.refused(["Courant number"], entries={"Time/Courant number": 1.5})
        self.refused(["Velocity table"], entries={f"{BODY}/Velocity table": "0:1, 0.5"})

    def test_contradictions(self) -> None:
        for words, entries in CONTRADICTIONS:
            with self.subTest(words=words):
                self.refused(words, entries=entries)

    def test_checks_and_observations(self) -> None:
        """All messages: output/observations.cc."""
        self.refused(
            ["Verification/Checks", "no quantity", "speed"],
            entries={"Verification/Checks": "max sped : 0 : 1"},
        )
        self.refused(
            ["Verification/Observations", "no quantity", "speed"],
            entries={"Verification/Observations": "a = mean sped"},
        )

    def test_step_too_large(self) -> None:
        text = self.run_scene(
            "jack", self.directory(), BAD_INPUT, entries={"Time/Time step": 1}
        )
        self.assert_words(["Time/Time step", "stability limit", "Reduce"], text)

    def test_no_soil(self) -> None:
        region = "Material points/Region"
        text = self.run_scene(
            "block_slides",
            self.directory(),
            BAD_INPUT,
            entries={f"{region} left": 1.9, f"{region} right": 1.9},
        )
        self.assertIn("No material point", text)


class Mesh(ProgramTest):
    """Meshes that cannot hold the travel."""

    def test_mesh_cannot_hold_the_travel(self) -> None:
        # too short a compressing zone: -5 + 0.5 + 1 leaves 3.5 m
        self.refused(
            ["3.5 m", "3.7 m", "Bottom", "-5.2"],
            entries={"Time/End penetration": 4.2, "Grid/Top": 9},
        )
        self.refused(
            ["Smallest row height", "0.4"],
            entries={"Grid/Smallest row height": 0.4, "Time/End penetration": 2.5},
        )
        self.refused(
            ["Moving zone below tip", "at least"],
            entries={"Grid/Moving zone below tip": 0.2},
        )

    def test_advice_is_good(self) -> None:
        """With the bottom that the message names it runs."""
        entries = {"Grid/Smallest row height": 0.2, "Time/End penetration": 3.2}
        text = self.run_program(BAD_INPUT, scene("jack"), "--validate", entries=entries)
        advice = re.search(r"Grid/Bottom to about (\S+) m", text)
        assert advice, text
        entries["Grid/Bottom"] = float(advice.group(1)) - 0.3
        self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)


class Paths(ProgramTest):
    """Files and directories that are not what they should be."""

    def test_files(self) -> None:
        directory = self.made_directory()
        text = self.run_program(BAD_INPUT, "nowhere.prm")
        self.assertIn("nowhere.prm", text)
        text = self.run_program(BAD_INPUT, directory)
        self.assertIn("directory", text.lower())
        blocked = directory / "a_file"
        blocked.write_text("not a directory")
        text = self.run_scene("jack", blocked / "results", BAD_INPUT)
        self.assertIn("a_file", text)
        if os.geteuid() != 0:  # root may write everywhere
            self.run_program(
                BAD_INPUT, scene("jack"), "--output-directory", "/proc/nothing"
            )


class Unused(ProgramTest):
    """Entries that are set and have no effect."""

    def warning(self, words: list[str], entries: dict[str, object]) -> None:
        """Ask for these words in the warning of a scene with these entries."""
        text = self.run_scene(
            "jack_cohesion", self.directory(), SUCCESS, "--validate", entries=entries
        )
        self.assert_words(["warning", "not used", *words], text)

    def test_layer_that_is_not_there(self) -> None:
        self.warning(
            ["Friction angle", "Number of layers is 1"],
            {"Soil/Layer 2/Friction angle": 40},
        )

    def test_entry_of_another_law(self) -> None:
        self.warning(
            ["Loosest void ratio", "Law is Mohr-Coulomb"],
            {f"{LAYER}/Loosest void ratio": 1.1},
        )

    def test_entry_of_another_kind(self) -> None:
        self.warning(["Apex angle", "Kind is caisson"], {"Rigid body/Apex angle": 70})

    def test_entries_that_another_one_replaces(self) -> None:
        self.warning(["Tip is flat"], {f"{BODY}/Tip": "flat", f"{BODY}/Tip angle": 30})
        self.warning(
            ["Velocity table", "one more entry"],
            {
                f"{BODY}/Velocity": 1,
                f"{BODY}/Ramp time": 1,
                f"{BODY}/Velocity table": "0 : 0.1",
            },
        )

    def test_entries_of_another_method(self) -> None:
        self.warning(
            ["XPIC order", "FLIP fraction is 1"],
            {"Method/FLIP fraction": 1, "Method/XPIC order": 3},
        )

    def test_entries_without_their_condition(self) -> None:
        self.warning(
            ["Random positions is 0"],
            {"Material points/Random seed": 7},
        )
        self.warning(
            ["Prescribed region is empty"],
            {"Boundary conditions/Prescribed velocity": "0 ; 1"},
        )

    def test_printed_parameters_are_silent(self) -> None:
        path = self.made_directory() / "printed.prm"
        path.write_text(self.run_program(SUCCESS, scene("jack"), "--print-parameters"))
        self.assertNotIn("warning", self.run_program(SUCCESS, path, "--validate"))

    def test_section_without_a_kind(self) -> None:
        text = self.run_program(
            BAD_INPUT, scene("jack"), "--validate", entries={f"{BODY}/Kind": "none"}
        )
        self.assert_words(["Kind is none", "no body", "has no end"], text)


class Places(ProgramTest):
    """A message says where the entries that it names were set."""

    def test_places_of_a_check(self) -> None:
        path = self.made_directory() / "mine.prm"
        path.write_text(
            f"include {scene('jack')}\n"
            "subsection Soil\nsubsection Layer 1\n"
            "  set Solid density = 900\nend\nend\n"
        )
        text = self.run_program(BAD_INPUT, path, "--validate")
        self.assert_words(
            [
                f"{LAYER}/Solid density is set in {path}:4.",
                "Soil/Fluid density has its default.",
            ],
            text,
        )

    def test_place_in_an_included_file(self) -> None:
        path = self.made_directory()
        (path / "base.prm").write_text("subsection Soil\n  set Number = 1\nend\n")
        (path / "mine.prm").write_text("include base.prm\n")
        text = self.run_program(BAD_INPUT, path / "mine.prm")
        self.assertIn(f"{path}/base.prm:2, included by {path}/mine.prm:1: ", text)


class Removed(ProgramTest):
    """Entries of earlier versions: what to write instead."""

    def test_removed_entries(self) -> None:
        """On the command line, and in a file, also in a section that is gone."""
        file = self.made_directory() / "old.prm"
        for entry, words in (
            ("Grid/Upper zone", "the mesh above the body moves with it"),
            ("Rigid body/Friction coefficient of the tip", "Set the Friction angle"),
            ("Method/Full cell fraction inside", "Remove it: it is 0.4"),
            ("Water/Suction delay", "Remove it: it is 0.02 s"),
            ("Material points/Path below final depth", "Remove it: it is 0.5 m"),
            ("Output/Error bar", "finds the error bar of FILE.prm in FILE_error_bar"),
            ("Design methods/Load spread", "report --load-spread X DIR"),
            ("Method/Velocity transfer", "Set FLIP fraction: 1 is FLIP"),
            ("Method/Velocity limiter", "Set Limiter factor = none"),
        ):
            section, name = entry.split("/")
            file.write_text(
                f"include {scene('jack')}\nsubsection {section}\n  set {name} = 1\n"
                "end\n",
                encoding="utf-8",
            )
            for call in ((file,), (scene("jack"), "--set", f"{entry}=1")):
                with self.subTest(entry, call=call):
                    text = self.run_program(BAD_INPUT, *call, "--validate")
                    self.assert_words([f'no entry "{entry}" any more', words], text)

    def test_removed_laws(self) -> None:
        """And their entries, in any layer."""
        for entry, value, words in (
            ("Law", "Mohr-Coulomb with softening", "Set Mohr-Coulomb by density and"),
            ("Law", "NorSand", "Set Mohr-Coulomb by density and stress, or hypo"),
            ("Law", "modified Cam clay", "Set Mohr-Coulomb with the undrained"),
            ("Law", "Mohr-Coulomb with stiffness by stress", "expression in p"),
            (
                "Law",
                "hypoplastic sand",
                "Set hypoplastic sand with intergranular strain",
            ),
            ("Residual cohesion", 0, "Remove it. Strength falls"),
        ):
            with self.subTest(entry, value=value):
                text = self.run_program(
                    BAD_INPUT,
                    scene("jack"),
                    "--validate",
                    entries={f"Soil/Layer 2/{entry}": value},
                )
                self.assert_words(["there is no", "any more", words], text)


class Words(ProgramTest):
    """Texts that are parsed once."""

    def test_mistake_in_an_expression_is_one_line(self) -> None:
        text = self.run_program(
            BAD_INPUT,
            scene("jack"),
            "--validate",
            entries={"Soil/Initial velocity": "0; r+*z"},
        )
        self.assertNotIn("Message:", text)
        self.assertIn("at column 3", text)

    def test_old_number_for_a_word(self) -> None:
        text = self.run_program(
            SUCCESS, scene("jack"), "--validate", entries={f"{LAYER}/K0": -1}
        )
        self.assert_words(["warning", 'is now written "auto"'], text)


if __name__ == "__main__":
    unittest.main()
