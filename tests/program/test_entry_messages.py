#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the program says of the entries of a scene: unused ones, places, words."""
import unittest

from program import BAD_INPUT, SUCCESS, ProgramTest, scene

BODY = "Rigid body"
LAYER = "Soil/Layer 1"


class Unused(ProgramTest):
    """Entries that are set and have no effect."""

    def warning(self, words: list[str], entries: dict[str, object]) -> None:
        """Ask for these words in the warning of a scene with these entries."""
        text = self.run_program(
            SUCCESS, scene("jack_softening"), "--validate", entries=entries
        )
        self.assert_words(["warning", "not used", *words], text)

    def test_layer_that_is_not_there(self) -> None:
        self.warning(
            ["Friction angle", "Number of layers is 1"],
            {"Soil/Layer 2/Friction angle": 40},
        )

    def test_entry_of_another_law(self) -> None:
        self.warning(
            ["Loosest void ratio", "Law is Mohr-Coulomb with softening"],
            {f"{LAYER}/Loosest void ratio": 1.1},
        )

    def test_velocity_of_no_length(self) -> None:
        self.warning(
            ["Internal velocity", "Internal length is 0"],
            {f"{LAYER}/Internal velocity": 1},
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
