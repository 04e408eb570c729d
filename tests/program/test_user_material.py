#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laws of the user: UMATs that are compiled here, beside the laws of the program."""
import math
import os
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

from program import (
    BAD_INPUT,
    HERE,
    STOPPED,
    SUCCESS,
    Entries,
    ProgramTest,
    Rows,
    caisson,
    history,
    scene,
    set_options,
    summary,
)

SOURCES = HERE / "materials/umat"
LAYER = "Soil/Layer 1"
COMPONENTS = ("rr", "zz", "tt", "rz")
ELASTIC = [5e6, 0.3]
# Young's modulus, Poisson's ratio, phi, psi, c, tension cut-off
SAND = [5e6, 0.3, 30, 0, 0, 0]
COHESIVE = [5e6, 0.3, 30, 15, 5e3, 1e3]
# what else follows from the law: its step has a margin, and FLIP its damping
SAME_STEPS = {
    "Time/Time step": 16e-4,
    "Method/FLIP fraction": 0.9,
    "Time/End penetration": 0.55,
    "Output/Record interval": 0.1,
    "Grid/Outer radius": 5,
    "Grid/Bottom": -3,
}


def compile_law(path: Path, name: str, text: str) -> Path:
    """Write a source into a directory, and compile it as the manual says."""
    compiler = {".cc": "g++", ".c": "gcc"}.get(Path(name).suffix, "gfortran")
    if not shutil.which(compiler):
        raise FileNotFoundError(f"{compiler} is missing: scripts/setup tests")
    (path / name).write_text(text, encoding="utf-8")
    words = [compiler, "-shared", "-fPIC", "-O2", "-g", "-o", "law.so", name]
    if compiler == "gfortran":
        words += ["-cpp", "-ffixed-line-length-none", "-ffree-line-length-none"]
        words += ["-I", str(HERE.parent / "include/abaqus")]
    subprocess.run(words, cwd=path, check=True)
    return path / "law.so"


class UserMaterialTest(ProgramTest):
    """A test that compiles a UMAT."""

    def compiled(self, name: str, more: str = "", *, folder: str = "umat") -> Path:
        """Compile a UMAT of the tests, with more statements at its end."""
        text = (SOURCES / name).read_text(encoding="utf-8")
        end = text.rindex("end subroutine" if name.endswith(".f90") else "}")
        text = text[:end] + more + "\n" + text[end:]
        return compile_law(self.made_directory(folder), name, text)

    @staticmethod
    def law(library: Path, properties: list[float], **more: object) -> Entries:
        """Return the entries of the law."""
        return {
            f"{LAYER}/Law": "user material",
            f"{LAYER}/Library": library,
            f"{LAYER}/Properties": ", ".join(map(str, properties)),
            f"{LAYER}/Friction angle": 0,
            **{
                f"{LAYER}/{key.replace('_', ' ')}": value for key, value in more.items()
            },
        }


class BuiltInLaws(UserMaterialTest):
    """The curves of the built-in laws, to 1e-6."""

    def rows(self, name: str, entries: Entries) -> Rows:
        """Return the history of a short run."""
        path = self.directory("run")
        self.run_scene(name, path, entries={**SAME_STEPS, **entries})
        return history(path)

    def assert_same(self, name: str, own: Entries, *users: Entries) -> None:
        """Ask for the same history with the entries of laws of users and our own."""
        expected = self.rows(name, own)
        self.assertGreater(len(expected), 5)
        self.assertGreater(max(abs(row["total_force_N"]) for row in expected), 1e4)
        for number, user in enumerate(users):
            with self.subTest(number):
                self.assert_same_history(self.rows(name, user), expected, 1e-6)

    def test_elastic(self) -> None:
        """In Fortran and in C, in soil that a caisson is jacked into."""
        own = {f"{LAYER}/Law": "linear elastic", f"{LAYER}/K0": 0.5}
        users = [
            self.law(self.compiled(name, folder=name[-1]), ELASTIC, K0=0.5)
            for name in ("elastic.f90", "elastic.c")
        ]
        self.assert_same("jack", own, *users)

    def test_sand(self) -> None:
        """Sand that keeps its volume in shear."""
        user = self.law(
            self.compiled("mohr_coulomb.f90"),
            SAND,
            Friction_angle=30,
            Volume_in_shear="kept",
        )
        self.assert_same("jack", {}, user)

    def test_cohesive_soil(self) -> None:
        """Dilatant soil with cohesion and a tension cut-off, which is pulled."""
        user = self.law(
            self.compiled("mohr_coulomb.f90"),
            COHESIVE,
            Friction_angle=30,
            Volume_in_shear="gained",
        )
        self.assert_same("jack_cohesion", {}, user)

    def test_element_paths(self) -> None:
        """All planes, edges and corners of the yield surface, in uniform strain."""
        library = self.compiled("mohr_coulomb.f90")
        paths = {
            "torn to the corner": "0.5*r ; 0.3*z",
            "torn along an edge": "0.5*r ; -0.2*z",
            "pulled along the axis": "-0.01*r ; 0.2*z",
            "pressed with shear": "-0.05*r ; -0.3*z + 0.4*r",
            "pressed from the side": "-0.2*r ; 0.1*z + 0.1*r",
            "sheared": "0 ; 0.5*r",
        }
        soils = [
            [5e6, 0.3, 30, 0, 0, 0],
            [5e6, 0.3, 35, 10, 5e3, 1e9],
            [5e6, 0.2, 25, 25, 5e3, 2e3],
            [5e6, 0.45, 0, 0, 2e4, 1e3],
        ]
        for name, velocity in paths.items():
            with self.subTest(name):
                self.assert_same_path(library, velocity, soils)

    def assert_same_path(
        self, library: Path, velocity: str, soils: list[list[float]]
    ) -> None:
        """Ask for the same stress after a uniform strain, of each soil by both laws: in
        layers of one scene, all of whose nodes move as they are told."""
        names = [
            "Youngs modulus",
            "Poisson ratio",
            "Friction angle",
            "Dilatancy angle",
            "Cohesion",
            "Tension cut-off",
        ]
        entries: Entries = {
            "Soil/Initial stress": "uniform",
            "Soil/Uniform stress": "-2e4, -3e4, -2.5e4, 3e3",
            "Soil/Initial velocity": velocity,
            "Soil/Number of layers": 2 * len(soils),
            "Boundary conditions/Prescribed velocity": velocity,
            "Time/Time step": 5e-4,
            "Time/End time": 0.05,
            "Grid/Cell width": 0.2,
            "Grid/Cell height": 0.2,
            "Grid/Bottom": -0.4 * len(soils),
            "Method/Stress filter": 0,  # of cells with points of two layers
            "Verification/Checks": "",
        }
        observed = []
        for number, soil in enumerate(soils):
            own: Entries = {f"{LAYER}/{n}": value for n, value in zip(names, soil)}
            own[f"{LAYER}/Law"] = "Mohr-Coulomb"
            for place, layer in enumerate((self.law(library, soil), own)):
                i = 2 * number + place
                layer |= {f"{LAYER}/Porosity": 0, f"{LAYER}/Solid density": 1000}
                if i > 0:
                    layer[f"{LAYER}/Top depth"] = f"{0.2 * i:g}"
                for entry, value in layer.items():
                    entries[entry.replace(LAYER, f"Soil/Layer {i + 1}")] = value
                observed += [
                    f"{x}_{i} = rms stress_{x} where abs(z + {0.2 * i + 0.1:g}) < 0.1"
                    for x in COMPONENTS
                ]
        entries["Verification/Observations"] = "; ".join(observed)
        path = self.directory("laws")
        self.run_scene("patch_stretching", path, entries=entries)
        last = history(path, "observations")[-1]
        largest = max(last[f"{x}_6"] for x in COMPONENTS)
        self.assertGreaterEqual(largest, 1e3, "the tension of a cohesive soil")
        for i in range(0, 2 * len(soils), 2):
            with self.subTest(soil=soils[i // 2]):
                largest = max(last[f"{x}_{i + 1}"] for x in COMPONENTS)
                for x in COMPONENTS:
                    self.assertAlmostEqual(
                        last[f"{x}_{i}"],
                        last[f"{x}_{i + 1}"],
                        delta=1e-6 * max(largest, 1.0),
                        msg=x,
                    )

    def test_time_step(self) -> None:
        """Without a given step it is the one of elasticity: DDSDDE is constant."""
        steps = []
        for folder, entries in (
            ("user", self.law(self.compiled("elastic.f90"), ELASTIC, K0=0.5)),
            ("own", {f"{LAYER}/Law": "linear elastic", f"{LAYER}/K0": 0.5}),
        ):
            path = self.directory(folder)
            self.run_scene(
                "jack", path, entries={**entries, "Time/End penetration": 0.51}
            )
            steps.append(history(path)[-2]["time_step_s"])
        self.assertAlmostEqual(steps[0] / steps[1], 1.0, delta=1e-9)


COUNT = """
  statev(1) = statev(1) + 1
  statev(2) = statev(2) + dtime
  statev(3) = time(2) + dtime
  statev(4) = sum(stran(1:3) + dstran(1:3))
  statev(5) = dfgrd1(3, 3) * (dfgrd1(1, 1) * dfgrd1(2, 2) - dfgrd1(1, 2) * dfgrd1(2, 1))
  statev(6) = coords(1)
  statev(7:8) = matmul(drot(1:2, 1:2), statev(7:8))
  if (npt /= 1 .or. cmname /= 'SOIL-LAYER-1') statev(1) = -1e6
  statev(40) = statev(40) + statev(1)
"""


class States(UserMaterialTest):
    """What a UMAT is given, and what the program keeps for it."""

    entries = {
        "Time/End penetration": 0.6,
        "Material points/Split and merge": True,
        "Output/Record interval": 0.1,
        "Verification/Observations": "; ".join(
            f"{kind}_{i} = {kind} statev_{i}"
            for i in (1, 2, 3, 40)
            for kind in ("min", "max")
        ),
    }

    def counting(self) -> Entries:
        """Return the entries of a UMAT that counts."""
        return self.law(
            self.compiled("elastic.f90", COUNT),
            ELASTIC,
            K0=0.5,
            State_variables=40,
            State_at_the_start="0, 0, 0, 0, 0, 0, 1, 0",
        )

    def assert_counted(self, path: Path, steps: int) -> None:
        """Ask for one call of each point in each step."""
        last = history(path, "observations")[-1]
        time = last["time_s"]
        for kind in ("min", "max"):
            self.assertEqual(last[f"{kind}_1"], steps)
            self.assertAlmostEqual(last[f"{kind}_2"], time, delta=1e-9)
            self.assertAlmostEqual(last[f"{kind}_3"], time, delta=1e-9)
            self.assertEqual(last[f"{kind}_40"], steps * (steps + 1) / 2)

    def test_counted_once(self) -> None:
        """Also where points are split and merged, and change ranks."""
        entries = {**self.counting(), **self.entries}
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                path = self.directory(f"ranks_{ranks}")
                self.run_scene("jack", path, entries=entries, ranks=ranks)
                self.assertGreater(history(path)[-1]["points_split"], 0)
                self.assert_counted(path, summary(path)["steps"])

    def test_restart(self) -> None:
        """State is in the checkpoint; a library that was changed is refused."""
        entries = {**self.counting(), **self.entries}
        path = self.directory("pieces")
        first = {**entries, "Time/End penetration": 0.55}
        self.run_scene("jack", path, entries=first)
        self.run_scene("jack", path, SUCCESS, "--restart", entries=entries)
        self.assert_counted(path, summary(path)["steps"])
        self.compiled("elastic.f90", COUNT + "  ddsdde = 1.01d0 * ddsdde\n")
        later = {**entries, "Time/End penetration": 0.61}
        text = self.run_scene("jack", path, BAD_INPUT, "--restart", entries=later)
        self.assert_words(["Library (checksum)", "Set it back"], text)

    def test_rotation(self) -> None:
        """The turn, the strain and the deformation of a disc that turns by 45
        degrees, and its stress."""
        entries = self.law(
            self.compiled("elastic.f90", COUNT),
            [1e6, 0.25],
            State_variables=40,
            State_at_the_start="0, 0, 0, 0, 0, 0, 1, 0",
        )
        checks = [
            "max statev_7 : sqrt(0.5) : 1e-7",
            "max statev_8 : -sqrt(0.5) : 1e-7",
            "max stress_rr : -1.5e5 : 1e-6",
            "max stress_rz : -1e5 : 1e-6",
            "max statev_4 : 0 : 1e-9",
        ]
        path = self.directory()
        self.run_scene(
            "rigid_rotation",
            path,
            entries={
                **entries,
                "Time/End time": 0.125,
                "Verification/Checks": "; ".join(checks),
            },
        )

    def test_strain_of_compression(self) -> None:
        """The sum of the strain increments, and the volume by DFGRD1."""
        entries = self.law(
            self.compiled("elastic.f90", COUNT), [4e7, 0.3], State_variables=40
        )
        checks = [
            "pointwise statev_4 : -0.02 : 1e-3",
            "pointwise statev_5 : exp(-0.02) : 1e-4",
        ]
        self.run_scene(
            "oedometer_density",
            self.directory(),
            entries={**entries, "Verification/Checks": "; ".join(checks)},
        )


class Input(UserMaterialTest):
    """Entries and files that are wrong or missing."""

    def test_library(self) -> None:
        """No such file, no library, no UMAT, a routine that is missing."""
        folder = self.made_directory("bad")
        (folder / "text.so").write_text("no library")
        (folder / "empty.so").write_text("")
        (folder / "folder.so").mkdir()
        library = bytearray(self.compiled("elastic.f90").read_bytes())
        library[18:20] = (243).to_bytes(2, sys.byteorder)  # e_machine of ELF
        (folder / "foreign.so").write_bytes(library)
        (folder / "none.c").write_text("int nothing = 0;")
        (folder / "lacks.c").write_text("void f(void); void umat_(void) { f(); }")
        (folder / "crashes.c").write_text(
            "void umat_(void) {} __attribute__((constructor)) static void f(void)"
            "{ *(volatile int *)0 = 1; }"
        )
        words = ["gcc", "-c", "-o", "object.so", "none.c"]
        subprocess.run(words, cwd=folder, check=True)
        (folder / "throws.c").write_text(
            'int f() { throw 1; } int x = f(); extern "C" void umat_() {}'
        )
        for name in ("none", "lacks", "crashes", "throws"):
            compiler = "g++" if name == "throws" else "gcc"
            words = [compiler, "-shared", "-fPIC", "-o", f"{name}.so", f"{name}.c"]
            subprocess.run(words, cwd=folder, check=True)
        for name, words in {
            "missing": ["there is no file", "relative to the file", "gfortran"],
            "text": ["no shared library", "gfortran -shared"],
            "empty": ["empty.so: file too short", "Compile it here"],
            "folder": ["folder.so, but something else of this name"],
            "foreign": ["no shared library that this machine can load"],
            "object": ["object.so: only ET_DYN", "no shared library"],
            "none": ["no subroutine umat", "Set Routine", "MODULE::NAME"],
            "throws": ["while it is loaded", "SIGABRT"],
            "lacks": ["undefined symbol: f", "XIT"],
            "crashes": ["while it is loaded", "SIGSEGV"],
        }.items():
            with self.subTest(name):
                self.refused(
                    ["bad input", f"{LAYER}/Library", *words],
                    entries=self.law(folder / f"{name}.so", ELASTIC),
                )

    def test_entries(self) -> None:
        """PROPS, STATEV and entries that a UMAT cannot serve."""
        good = self.law(self.compiled("elastic.f90"), ELASTIC)
        for entry, value, words in (
            ("Library", "", ["needs", "Library"]),
            ("Properties", "", ["needs", "Properties", "none"]),
            ("Properties", "none", ["outside its 0 Properties"]),
            ("Properties", "5e6", ["outside its 1 Properties"]),
            ("Material name", 81 * "x", ["Material name", "80 characters"]),
            ("Properties", "5e6, much", ["5e6, much", "list of numbers"]),
            ("State at the start", "1, 2", ["has 2 numbers", "State variables = 0"]),
            ("Stress measure", "Kirchhoff", ["Stress measure", "user material"]),
        ):
            with self.subTest(entry=entry, value=value):
                wrong = {**good, f"{LAYER}/{entry}": value}
                self.refused(["bad input", *words], entries=wrong)

    def test_path_of_the_scene(self) -> None:
        """The library lies beside the scene's file, wherever the program runs."""
        library = self.compiled("elastic.f90")
        file = library.parent / "own.prm"
        file.write_text(
            f"include {scene('jack')}\nsubsection Soil\nsubsection Layer 1\n"
            "set Law = user material\nset Library = law.so\n"
            "set Properties = 5e6, 0.3\nend\nend\n"
        )
        for name in (file, Path(os.path.relpath(file))):
            self.assertIn("is valid", self.run_program(SUCCESS, name, "--validate"))

    def test_path_in_an_included_file(self) -> None:
        """The library lies beside the file that sets it; a layer that is like this
        one finds it, too."""
        library = self.compiled("elastic.f90")
        (library.parent / "soil.prm").write_text(
            f"include {scene('jack')}\nsubsection Soil\nsubsection Layer 1\n"
            "set Law = user material\nset Library = law.so\n"
            "set Properties = 5e6, 0.3\nend\nend\n"
        )
        file = library.parent.parent / "top.prm"
        file.write_text(
            f"include {library.parent.name}/soil.prm\nsubsection Soil\n"
            "set Number of layers = 2\nsubsection Layer 2\n"
            "set Like layer = 1\nset Top depth = 2\nend\nend\n"
        )
        self.run_program(SUCCESS, file, "--validate")
        # of --set it is beside the scene
        text = self.run_program(
            BAD_INPUT, file, "--validate", entries={f"{LAYER}/Library": "law.so"}
        )
        self.assert_words(["there is no file", str(file.parent / "law.so")], text)

    def test_entries_of_other_laws(self) -> None:
        """A library without the law is reported."""
        more = {f"{LAYER}/Library": "law.so", "Time/End penetration": 0.5005}
        text = self.run_scene("jack", self.directory(), entries=more)
        self.assert_words([f"{LAYER}/Library", "not used"], text)

    def above_elastic(self) -> Entries:
        """Return the entries of a user material above a law of the program."""
        library = self.compiled("elastic.f90", COUNT)
        return {
            **self.law(library, ELASTIC, State_variables=40),
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 1,
            "Soil/Layer 2/Law": "linear elastic",
        }

    def test_layers(self) -> None:
        """A user material above a law of the program, stopped and resumed."""
        # a stop waits for the 400th step
        short = {"Time/End penetration": 0.52, "Time/Courant number": 0.2}
        entries = {**self.above_elastic(), **short}
        path = self.directory()
        self.run_scene("jack", path, entries=entries)
        stopped = self.directory("stopped")
        stop = {**entries, "Run control/Wall time limit": 1e-3}
        self.run_scene("jack", stopped, STOPPED, entries=stop)
        self.run_scene("jack", stopped, SUCCESS, "--restart", entries=entries)
        self.assert_same_history(history(path)[-1:], history(stopped)[-1:], 1e-5)

    def test_state_of_other_layers(self) -> None:
        """Points of a layer whose law keeps no STATEV are left out."""
        entries = {
            **self.above_elastic(),
            "Time/End penetration": 0.51,
            "Verification/Observations": "least = min statev_1; "
            "mean = mean statev_1; deep = point statev_1 at 1 -3",
        }
        path = self.directory()
        self.run_scene("jack", path, entries=entries)
        last, steps = history(path, "observations")[-1], summary(path)["steps"]
        self.assertEqual(last["least"], steps)
        self.assertAlmostEqual(last["mean"], steps, places=6)
        self.assertTrue(math.isnan(last["deep"]), last)
        entries["Verification/Observations"] = "a = max statev_41"
        self.refused(["none there has the quantity"], entries=entries)

    def test_command(self) -> None:
        """caisson run makes tables, pictures and the page of such a run."""
        library = self.compiled("elastic.f90")
        path = self.directory()
        entries = {**self.law(library, ELASTIC), "Time/End penetration": 0.52}
        words = ["--output-directory", path, *set_options(entries)]
        done = caisson("run", scene("jack"), *words)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        page = (path / "report.html").read_text(encoding="utf-8")
        self.assertIn("user material", page)


if __name__ == "__main__":
    unittest.main()
