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
    ALONE,
    BAD_INPUT,
    FAILURE,
    HERE,
    STOPPED,
    SUCCESS,
    Entries,
    ProgramTest,
    Status,
    history,
    scene,
    set_options,
    summary,
)

SOURCES = HERE / "materials/umat"
LAYER = "Soil/Layer 1"
ELASTIC = [5e6, 0.3]
# Young's modulus, Poisson's ratio, phi, psi, c, tension cut-off
SAND = [5e6, 0.3, 30, 0, 0, 0]
COHESIVE = [5e6, 0.3, 30, 15, 5e3, 1e3]
# what else follows from the law: its step has a margin, and FLIP its damping
SAME_STEPS = {
    "Time/Time step": 4e-4,
    "Method/FLIP fraction": 0.9,
    "Time/End penetration": 0.6,
    "Output/Record interval": 0.1,
}


class UserMaterialTest(ProgramTest):
    """A test that compiles a UMAT."""

    def compiled(self, name: str, more: str = "", *, folder: str = "umat") -> Path:
        """Compile a UMAT of the tests, with more statements at its end."""
        compiler = "gfortran" if name.endswith(".f90") else "gcc"
        if not shutil.which(compiler):
            self.fail(f"{compiler} is missing: scripts/setup tests installs it")
        path = self.made_directory(folder)
        text = (SOURCES / name).read_text(encoding="utf-8")
        end = text.rindex("end subroutine" if compiler == "gfortran" else "}")
        (path / name).write_text(text[:end] + more + "\n" + text[end:], "utf-8")
        words = [compiler, "-shared", "-fPIC", "-O2", "-g", "-o", "law.so", name]
        subprocess.run(words, cwd=path, check=True)
        return path / "law.so"

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

    def assert_same(self, name: str, user: Entries, own: Entries) -> None:
        """Ask for the same history with the entries of both laws."""
        rows = []
        for folder, entries in (("user", user), ("own", own)):
            path = self.directory(folder)
            self.run_scene(name, path, entries={**SAME_STEPS, **entries})
            rows.append(history(path))
        self.assertGreater(len(rows[0]), 5)
        self.assertGreater(max(abs(row["total_force_N"]) for row in rows[0]), 1e4)
        self.assert_same_history(rows[0], rows[1], 1e-6)

    def test_elastic(self) -> None:
        """In Fortran and in C, in soil that a caisson is jacked into."""
        own = {f"{LAYER}/Law": "linear elastic", f"{LAYER}/K0": 0.5}
        for name in ("elastic.f90", "elastic.c"):
            with self.subTest(name):
                user = self.law(self.compiled(name), ELASTIC, K0=0.5)
                self.assert_same("jack", user, own)

    def test_sand(self) -> None:
        """Sand that keeps its volume in shear."""
        user = self.law(
            self.compiled("mohr_coulomb.f90"),
            SAND,
            Friction_angle=30,
            Volume_in_shear="kept",
        )
        self.assert_same("jack", user, {})

    def test_cohesive_soil(self) -> None:
        """Dilatant soil with cohesion and a tension cut-off, which is pulled."""
        user = self.law(
            self.compiled("mohr_coulomb.f90"),
            COHESIVE,
            Friction_angle=30,
            Volume_in_shear="gained",
        )
        self.assert_same("jack_cohesion", user, {})

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
            for soil in soils:
                with self.subTest(name, soil=soil):
                    self.assert_same_path(library, velocity, soil)

    def assert_same_path(self, library: Path, velocity: str, soil: list[float]) -> None:
        """Ask for the same stress after a uniform strain."""
        names = [
            "Youngs modulus",
            "Poisson ratio",
            "Friction angle",
            "Dilatancy angle",
            "Cohesion",
            "Tension cut-off",
        ]
        own: Entries = {f"{LAYER}/{n}": value for n, value in zip(names, soil)}
        own[f"{LAYER}/Law"] = "Mohr-Coulomb"
        user = self.law(library, soil)
        more = {
            "Soil/Initial stress": "uniform",
            "Soil/Uniform stress": "-2e4, -3e4, -2.5e4, 3e3",
            "Soil/Initial velocity": velocity,
            "Boundary conditions/Prescribed velocity": velocity,
            "Time/Time step": 5e-4,
            "Time/End time": 0.05,
            "Grid/Cell width": 0.2,
            "Grid/Cell height": 0.2,
            "Verification/Checks": "",
            "Verification/Observations": "; ".join(
                f"{i} = rms stress_{i}" for i in ("rr", "zz", "tt", "rz")
            ),
        }
        last = []
        for folder, entries in (("user", user), ("own", own)):
            path = self.directory(folder)
            self.run_scene("patch_stretching", path, entries={**entries, **more})
            last.append(history(path, "observations")[-1])
        largest = max(last[1][i] for i in ("rr", "zz", "tt", "rz"))
        for i in ("rr", "zz", "tt", "rz"):
            self.assertAlmostEqual(
                last[0][i], last[1][i], delta=1e-6 * max(largest, 1.0), msg=i
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
        steps = summary(path)["steps"]
        self.run_scene("jack", path, SUCCESS, "--restart", entries=entries)
        self.assert_counted(path, steps + summary(path)["steps"])
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
            "oedometer_stiffening",
            self.directory(),
            entries={**entries, "Verification/Checks": "; ".join(checks)},
        )


# what goes wrong, and what the message says of it
FAULTS = {
    "stress[0] = 0. / (stress[1] - stress[1]);": ["STRESS", "nan"],
    "((double *)dstran)[1] = 1.;": ["written to DSTRAN"],
    "((double *)props)[1] = .2;": ["written to PROPS"],
    "((int *)ntens)[0] = 6;": ["written to NTENS"],
    "((double *)dfgrd1)[8] = 1.;": ["written to DFGRD1"],
    "statev[0] = 1.;": ["beyond its 0 State variables"],
    "statev[100000] = 1.;": ["beyond its 0 State variables"],
    "stress[4] = 1.;": ["beyond the 4 components of STRESS", "NTENS is 4"],
    "ddsdde[16] = 1.;": ["beyond the 4 components of DDSDDE"],
    # what is read decides nothing
    "if (props[2] == 7.) ddsdde[15] *= 1.01;": ["beyond its 2 Properties"],
    "if (statev[3] == 7.) ddsdde[15] *= 1.01;": ["beyond its 0 State variables"],
    "if (stran[4] == 7.) ddsdde[15] *= 1.01;": ["4 components of STRAN"],
    "if (dstran[5] == 7.) ddsdde[15] *= 1.01;": ["4 components of DSTRAN"],
    "if (stress[4] == 7.) ddsdde[15] *= 1.01;": ["4 components of STRESS"],
    "stress[0] += props[-1];": ["STRESS", "nan"],
    "*(volatile int *)0 = 1;": ["crashed with SIGSEGV"],
    "__builtin_trap();": ["crashed with SIGILL"],
    "__builtin_abort();": ["crashed with SIGABRT"],
    "extern void xit_(void); xit_();": ["XIT"],
    "extern void exit(int); exit(0);": ["STOP or exit"],
    "*pnewdt = .25;": ["PNEWDT = 0.25"],
    "ddsdde[5] = 0. / (stress[1] - stress[1]);": ["DDSDDE", "nan"],
}


class Faults(UserMaterialTest):
    """UMATs that fail are named, with the place and the step."""

    def run_fault(
        self, status: Status, source: str, more: str, **entries: object
    ) -> str:
        """Run a scene with a faulty UMAT; return what the program says."""
        law = self.law(self.compiled(source, more), ELASTIC, **entries)
        path = self.directory("results")
        text = self.run_scene("jack", path, status, entries=law)
        self.assert_words([f"{LAYER}/Library", "law.so"], text)
        self.assertEqual((path / "history.csv").exists(), status == FAILURE)
        return text

    def test_before_the_run(self) -> None:
        """The element test finds what is wrong at once."""
        for more, words in FAULTS.items():
            with self.subTest(more):
                text = self.run_fault(BAD_INPUT, "elastic.c", "  " + more)
                self.assert_words([*words, "element test"], text)

    def test_in_the_run(self) -> None:
        """What happens later names the point and the step."""
        for more, words in FAULTS.items():
            with self.subTest(more):
                later = f"  if (*kinc == 4 && coords[0] < 1.) {{ {more} }}"
                text = self.run_fault(FAILURE, "elastic.c", later)
                self.assert_words([*words, "in step 3 at t = ", "at r = 0."], text)

    def test_stiffness_that_stress_contradicts(self) -> None:
        """A wrong sign, and a DDSDDE or units that are far off."""
        for factors, words in (
            ((-1, 1), ["falls as the strain grows"]),
            ((1, 1e8), ["no more than", "correct it"]),
            ((1e-6, 1e-6), ["less than the stress at the start", "in Pa"]),
        ):
            with self.subTest(factors):
                more = "  for (int i = 0; i < 4; ++i) for (int j = 0; j < 4; ++j) {"
                more += f" stress[i] += {factors[0] - 1} * ddsdde[i + 4 * j]"
                more += " * dstran[j]; }\n"
                more += f"  for (int i = 0; i < 16; ++i) ddsdde[i] *= {factors[1]};"
                text = self.run_fault(BAD_INPUT, "elastic.c", more)
                self.assert_words(words, text)

    def test_validate(self) -> None:
        """--validate takes some steps, and a UMAT that fails in them is invalid."""
        later = "  if (*kinc == 3) stress[0] = 0. / (*dtime - *dtime);"
        law = self.law(self.compiled("elastic.c", later), ELASTIC)
        text = self.run_program(BAD_INPUT, scene("jack"), "--validate", entries=law)
        self.assert_words(["first steps of the run fail", "law.so", "step 2"], text)
        self.assertNotIn("is valid", text)
        # another failure is a warning: the entries may be as they should
        self.compiled("elastic.c", "  if (*kinc == 1) stress[0] *= 1e30;")
        text = self.run_program(SUCCESS, scene("jack"), "--validate", entries=law)
        self.assert_words(["warning: the first steps", f"({LAYER}/Library)"], text)

    def test_cause_of_a_lost_point(self) -> None:
        """A run that breaks says that the law may be the cause."""
        breaks = "  if (*kinc > 20) for (int i = 0; i < 4; ++i)\n"
        breaks += "    stress[i] += 1e4 * ddsdde[5 * i] * dstran[i];"
        law = self.law(self.compiled("elastic.c", breaks), ELASTIC)
        cause = [f"user material ({LAYER}/Library)", "DDSDDE"]
        text = self.run_scene("jack", self.directory(), FAILURE, entries=law)
        self.assert_words(["material point", *cause], text)
        law["Time/Time step"] = 1.0
        self.refused(["exceeds the stability limit", *cause], entries=law)

    def test_message_of_abaqus(self) -> None:
        """STDB_ABQERR prints, and ends the run where it is an error."""
        later = (
            "  if (kinc == 4) call stdb_abqerr(-3, 'angle %R of %S in %I', [noel], &\n"
            "    [30.5d0], 'SAND    ')"
        )
        text = self.run_fault(FAILURE, "elastic.f90", later)
        self.assert_words(["angle 30.5 of SAND", "XIT", "in step 3"], text)

    def test_stop_of_fortran(self) -> None:
        """On two ranks all end."""
        later = "  if (kinc == 4) stop 3"
        law = self.law(self.compiled("elastic.f90", later), ELASTIC)
        for ranks in (1, 2):
            path = self.directory(f"ranks_{ranks}")
            text = self.run_scene("jack", path, FAILURE, entries=law, ranks=ranks)
            self.assert_words(["law.so", "STOP or exit", "in step 3"], text)

    def test_one_rank_fails(self) -> None:
        """A crash that only one of two ranks sees."""
        later = "  if (*kinc == 4 && coords[0] < .3) *(volatile int *)0 = 1;"
        law = self.law(self.compiled("elastic.c", later), ELASTIC)
        text = self.run_scene(
            "jack", self.directory("results"), FAILURE, entries=law, ranks=2
        )
        self.assert_words(["law.so", "SIGSEGV", "in step 3"], text)

    def test_answers_of_no_use(self) -> None:
        """Not reproducible, and a DDSDDE that says nothing or too little."""
        faults = {
            "static int n = 0; stress[0] += n++;": ["two answers", "STATEV"],
            "for (int i = 0; i < 16; ++i) ddsdde[i] = 0.;": ["at least the elastic"],
            "for (int i = 0; i < 16; ++i) ddsdde[i] *= .001;": ["DDSDDE", "STRESS"],
        }
        for more, words in faults.items():
            with self.subTest(more):
                text = self.run_fault(BAD_INPUT, "elastic.c", "  " + more)
                self.assert_words(words, text)

    def test_stiffness_that_grows(self) -> None:
        """The time step follows DDSDDE."""
        grows = "  if (*kinc > 400) { for (int i = 0; i < 16; ++i) ddsdde[i] *= 4.; }"
        law = self.law(self.compiled("elastic.c", grows), ELASTIC)
        path = self.directory("results")
        more = {"Time/End penetration": 0.6, "Output/Record interval": 0.05}
        self.run_scene("jack", path, entries={**law, **more})
        steps = [row["time_step_s"] for row in history(path)]
        self.assertAlmostEqual(steps[1] / steps[-2], 5**0.5, delta=0.05)


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
        for name in ("none", "lacks", "crashes"):
            words = ["gcc", "-shared", "-fPIC", "-o", f"{name}.so", f"{name}.c"]
            subprocess.run(words, cwd=folder, check=True)
        for name, words in {
            "missing": ["there is no file", "relative to the file", "gfortran"],
            "text": ["text.so is no compiled library", "gfortran -shared"],
            "empty": ["empty.so is empty", "Compile"],
            "folder": ["folder.so is a directory", "Name the file"],
            "foreign": ["for RISC-V, and this program runs on", "Compile it"],
            "object": ["object.so is an object file", "shared library"],
            "none": ["no symbol umat_"],
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
            ("Properties", "none", ["beyond its 0 Properties"]),
            ("Properties", "5e6", ["beyond its 1 Properties"]),
            ("Properties", "5e6, much", ["5e6, much", "list of numbers"]),
            ("State at the start", "1, 2", ["has 2 numbers", "State variables = 0"]),
            ("Internal length", 0.01, ["Internal length", "user material"]),
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
        entries = {**self.above_elastic(), "Time/End penetration": 0.52}
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
        words = [str(HERE.parent / "scripts/caisson"), "run", scene("jack")]
        words += ["--output-directory", str(path), *set_options(entries)]
        done = subprocess.run(words, env=ALONE, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        page = (path / "report.html").read_text(encoding="utf-8")
        self.assertIn("user material", page)


if __name__ == "__main__":
    unittest.main()
