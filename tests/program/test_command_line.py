#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The options of the program, and the parameters that it prints."""
import os
import re
import subprocess
import unittest

from program import BAD_INPUT, FAILURE, SUCCESS, Entries, ProgramTest, scene, summary


class Options(ProgramTest):
    """The command line."""

    def test_help_and_version(self) -> None:
        text = self.run_program(SUCCESS, "--help")
        options = (
            "set output-directory print-parameters explain validate strict restart"
            " overwrite"
        )
        for option in [*options.split(), "version", "help"]:
            self.assertIn(f"--{option}", text)
        self.assertRegex(self.run_program(SUCCESS, "--version"), r"caisson_mpm \d")
        self.assertIn("No parameter file", self.run_program(BAD_INPUT))
        text = self.run_program(BAD_INPUT, "--outptu-directory", "x")
        self.assertIn("--output-directory", text, "nearest option")

    def test_parameters_can_be_read_again(self) -> None:
        path = self.made_directory() / "all.prm"
        path.write_text(self.run_program(SUCCESS, scene("jack"), "--print-parameters"))
        self.assertIn("is valid", self.run_program(SUCCESS, path, "--validate"))
        again = self.run_program(SUCCESS, path, "--print-parameters")
        self.assertEqual(path.read_text(), again)
        self.assertIn("Units: ", again)

    def test_a_list_that_is_cut_off(self) -> None:
        """It is a failure, as on a full disk."""
        for words in (f"{scene('jack')} --print-parameters", "--help", "--version"):
            for output in (">/dev/full", ">&-"):
                done = subprocess.run(
                    f"{self.program} {words} {output}",
                    shell=True,
                    text=True,
                    capture_output=True,
                )
                self.assertEqual(done.returncode, FAILURE)
                self.assertRegex(
                    done.stderr, r"\Afailure: standard output takes no .*\n\Z"
                )

    def test_files_of_the_current_folder(self) -> None:
        """Those that the call does not name are not opened: neither the settings of
        libraries, one of which is a pipe on which all would wait, nor libraries."""
        folder = self.made_directory("stranger")
        (folder / ".petscrc").write_text("-log_view :RAN\n", encoding="utf-8")
        os.mkfifo(folder / ".adolcrc")
        for name in ("libz.so.1", "libm.so.6", "libdeal.ii.so.9.4.1"):
            (folder / name).write_text("no library", encoding="utf-8")
        before = sorted(folder.iterdir())
        text = subprocess.check_output(
            [str(self.program), "--version"], cwd=folder, text=True, timeout=600
        )
        self.assertRegex(text, r"^caisson_mpm .*\n$")
        self.assertEqual(sorted(folder.iterdir()), before)

    def test_entries_with_a_word(self) -> None:
        """One layer stands for those that have the defaults."""
        text = self.run_program(
            SUCCESS,
            scene("jack"),
            "--explain",
            "FRICTION ANGLE",
            entries={"Soil/Layer 3/Friction angle": 33},
        )
        self.assertEqual(text.count("  set Friction angle ="), 2)
        self.assertIn("subsection Layer 3", text)
        self.assertNotIn("subsection Layer 2", text)
        self.assertIn("set Friction angle of the tip", text)
        self.assertNotIn("subsection Grid", text)
        section = self.run_program(SUCCESS, "--explain", "Layer 1")
        self.assertIn("set Friction angle", section)
        self.assertIn("No entry has", self.run_program(BAD_INPUT, "--explain", "xyz"))
        for word, words in (
            ("density and stress", ["set Law =", "NGI-ADP"]),
            ("tension", ["See also Water/Suction control.", "Tension cut-off ="]),
            ("sealed", ["set Suction control ="]),
            ("pull", ["See also Water/Suction control.", "set Phases ="]),
            ("Trapped", ["delays", "pump takes it"]),
        ):
            self.assert_words(words, self.run_program(SUCCESS, "--explain", word))
        for word, entry in (
            ("CFL", "Courant number"),
            ("cavitation", "Water depth"),
            ("suA", "Active strength"),
            ("sD/suA", "Direct shear strength ratio"),
        ):
            said = self.run_program(BAD_INPUT, "--explain", word)
            self.assert_words(["Did you mean", entry], said)

    def test_validate_tells_the_cost(self) -> None:
        """Without writing a file."""
        path = self.directory()
        text = self.run_scene("jack", path, SUCCESS, "--validate")
        self.assertRegex(text, r"points +\d+\n")
        self.assertRegex(text, r"time step +[\de.-]+ s, limited by the cell at")
        for words in (r"steps +about \d", r"memory +about \d", r"duration +about \d"):
            self.assertRegex(text, words)
        self.assertFalse((path / "history.csv").exists())

    def test_validate_tells_what_would_be_cheaper(self) -> None:
        """Of a long run; and nothing of one that is short anyway."""
        entries = {"Time/End penetration": 0.9}
        short = self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)
        self.assertNotIn("cheaper", short)
        entries.update({"Time/Time step": 1e-8, "Time/Mass scaling": 25})
        long = self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)
        self.assertIn("Time/Mass scaling = 100 takes 0.5 times as many steps", long)
        self.assertIn("Grid/Refinement levels", long)
        first = re.search(r"cheaper +Material points/Split and merge.*?(\d+) .*", long)
        assert first, long
        self.assertLess(long.index(first[0]), long.index("Mass scaling = 100"))
        fewer = self.run_program(
            SUCCESS,
            scene("jack"),
            "--validate",
            entries={**entries, "Material points/Split and merge": "true"},
        )
        self.assertRegex(fewer, rf"points +{first[1]} at the start")
        self.assertNotIn("Split and merge", fewer)
        entries["Time/Mass scaling"] = 100
        long = self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)
        self.assertNotIn("Mass scaling", long)

    def test_strict(self) -> None:
        """Warnings of likely mistakes become errors, each by its name; known
        limits of the program do not."""
        mistakes: Entries = {
            "Soil/Layer 2/Friction angle": 40,
            "Rigid body/Apex angle": 70,
        }
        path = self.directory()
        self.run_program(SUCCESS, scene("jack"), "--validate", entries=mistakes)
        for option in ("--validate", f"--output-directory={path}"):
            with self.subTest(option):
                said = self.run_program(
                    BAD_INPUT, scene("jack"), "--strict", option, entries=mistakes
                )
                for words in ("2 warnings", "--strict", *mistakes):
                    self.assertIn(words, said)
        self.assertFalse(path.exists(), "nothing was written")
        said = self.run_scene("jack_cohesion", path, SUCCESS, "--validate", "--strict")
        self.assertIn("warning: Soil/Layer 1: Mohr-Coulomb sand with", said)

    def test_a_run_keeps_its_warnings(self) -> None:
        """--validate, the terminal and run.json have the same ones."""
        entries: Entries = {
            "Soil/Layer 2/Friction angle": 40,
            "Time/End penetration": 0.505,
        }
        path = self.directory()
        first = self.run_scene(
            "jack_cohesion", path, SUCCESS, "--validate", entries=entries
        )
        said = self.run_scene("jack_cohesion", path, entries=entries)
        found = re.findall("^warning: (.*)$", first, re.M)
        self.assertEqual(len(found), 2, first)
        for warning in found:
            self.assertIn(f"warning: {warning}", said)
        self.assertEqual(summary(path)["warnings"][:2], found)

    def test_validate_refuses_what_a_run_refuses(self) -> None:
        """Files and directories that cannot be used; nothing is written."""
        path = self.made_directory()
        (path / "file").write_text("")
        cases: tuple[tuple[str, list[str], Entries], ...] = (
            ("a file is in its place", ["--output-directory", f"{path}/file"], {}),
            ("name too long", ["--output-directory", f"{path}/{'x' * 300}"], {}),
            ("checkpoint", ["--restart", f"--output-directory={path}/new"], {}),
        )
        for words, options, entries in cases:
            with self.subTest(words, options=options[:1]):
                said = self.run_program(
                    BAD_INPUT, scene("jack"), "--validate", *options, entries=entries
                )
                self.assertIn(words, said)
                if words == "a file is in its place":
                    self.assertIn("Directory is set by --output-directory", said)
        self.assertEqual([file.name for file in path.iterdir()], ["file"])

    def test_set_overrides(self) -> None:
        text = self.run_program(
            SUCCESS,
            scene("jack"),
            "--print-parameters",
            entries={"Soil/Layer 1/Friction angle": 33},
        )
        self.assertRegex(text, r"set Friction angle\s*= 33")


if __name__ == "__main__":
    unittest.main()
