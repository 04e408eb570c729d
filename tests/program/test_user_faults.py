#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""UMATs that fail, or leave something behind that the program must not see."""
import unittest
from pathlib import Path

from program import BAD_INPUT, FAILURE, SUCCESS, Entries, Status, history, scene
from test_user_material import (
    ELASTIC,
    LAYER,
    SOURCES,
    UserMaterialTest,
    compile_law,
)


# what goes wrong, and what the message says of it
FAULTS = {
    "stress[0] = 0. / (stress[1] - stress[1]);": ["STRESS", "nan"],
    "statev[0] = 1.;": ["written outside its 0 State variables. Raise"],
    "statev[20] = 1.;": ["written outside its 0 State variables"],
    "stress[4] = 1.;": ["4 components of STRESS", "Stress components = 6"],
    "stress[-3] = 1.;": ["written outside the 4 components of STRESS"],
    "ddsdde[35] = 1.;": ["written outside the 4 components of DDSDDE"],
    "for (int i = 0; i < 40; ++i) ddsddt[i] = 1.;": ["components of DDSDDT"],
    "((char *)cmname)[80] = 'x';": ["written outside CMNAME"],
    "((double *)coords)[-1] = 1.;": ["written outside COORDS"],
    "ddsdde[15] += props[4];": ["read outside its 4 Properties"],
    "ddsdde[15] += statev[3];": ["read outside its 0 State variables"],
    "ddsdde[15] *= stran[4];": ["read outside the 4 components of STRAN"],
    "stress[0] -= dstran[5];": ["read outside the 4 components of DSTRAN"],
    "stress[0] += props[-1];": ["read outside its 4 Properties"],
    "*(volatile int *)0 = 1;": ["crashed with SIGSEGV"],
    "recurse(props);": ["crashed with SIGSEGV"],
    "__builtin_trap();": ["crashed with SIGILL"],
    "std::abort();": ["crashed with SIGABRT"],
    "feenableexcept(FE_DIVBYZERO); stress[0] = 1. / drot[2];": ["SIGFPE"],
    "xit_();": ["XIT", "Material name"],
    "std::exit(0);": ["STOP or exit"],
    'throw std::runtime_error("no way");': ["std::runtime_error: no way"],
    "std::vector<int>().at(3);": ["std::out_of_range"],
    "stress[0] = *new (::operator new(1ul << 62)) double;": ["std::bad_alloc"],
    "throw 7;": ["no std::exception"],
    "*pnewdt = .25;": ["PNEWDT = 0.25"],
    "ddsdde[5] = 0. / (stress[1] - stress[1]);": ["DDSDDE", "nan"],
    "__builtin_memset((char *)stress - 64, 0, 64);": ["SIGSEGV"],
    "__builtin_memset((char *)stress + 4096, 0, 64);": ["SIGSEGV"],
    "stress[99999] = 1.;": ["SIGSEGV"],
    "stress[-99999] = 1.;": ["SIGSEGV"],
    "principal(0. / (stress[1] - stress[1]), 3);": ["SPRINC", "stress that", "nan, 1"],
    "principal(1., 300);": ["SPRINC with NDI = 300"],
}
# does no harm: the third property is the fault, the fourth the first step of it
HARMLESS = {
    "((double *)dstran)[1] *= -1.; ((double *)props)[1] = 2.;": "changes its input",
    "((int *)ntens)[0] = 6; ((char *)cmname)[0] = 'x';": "changes its input",
}
FAULTY = """#include <cstdlib>
#include <fenv.h>
#include <stdexcept>
#include <vector>
extern "C" void xit_(void);
static double
recurse(const volatile double *x)
{{
  volatile double y[99] = {{*x}};
  return recurse(y) + y[1];
}}
extern "C" void sprinc_(const double *, double *, int *, int *, int *);
static void
principal(const double first, int n_direct)
{{
  double s[6] = {{first, 1.}}, values[3];
  int stress = 1, n_shear = 3;
  sprinc_(s, values, &stress, &n_direct, &n_shear);
}}
extern "C" {{
{elastic}
  if (*kinc >= props[3] && (*kinc == 0 || coords[0] < 1.))
    switch ((int)props[2])
      {{
{cases}
      }}
}}
}}
"""


class Faults(UserMaterialTest):
    """UMATs that fail are named, with the place and the step."""

    library: Path
    kinds = [*FAULTS, *HARMLESS]

    @classmethod
    def setUpClass(cls) -> None:
        """Compile one library with all faults."""
        path = cls.results / "faulty"
        path.mkdir(parents=True, exist_ok=True)
        source = (SOURCES / "elastic.c").read_text(encoding="utf-8")
        cases = (f"case {i}: {{ {kind} }} break;" for i, kind in enumerate(cls.kinds))
        text = FAULTY.format(
            elastic=source[: source.rindex("}")], cases="\n".join(cases)
        )
        cls.library = compile_law(path, "faulty.cc", text)

    def faulty(self, kind: str, step: int, **entries: object) -> Entries:
        """Return the entries of a law with this fault from a step on; 0: before the
        run."""
        law = self.law(self.library, [*ELASTIC, self.kinds.index(kind), step])
        return {**law, **entries}

    def assert_fault(self, words: list[str], status: Status, text: str) -> None:
        """Ask for one line that names the library."""
        lines = [line for line in text.splitlines() if f"{LAYER}/Library = " in line]
        self.assertEqual(len(lines), 1, text)
        begin = {BAD_INPUT: "bad input: ", FAILURE: "failure: "}[status]
        self.assertTrue(lines[0].startswith(begin), text)
        self.assert_words(["law.so", *words], lines[0])

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
        for kind, words in FAULTS.items():
            with self.subTest(kind):
                path = self.directory("results")
                law = self.faulty(kind, 0)
                text = self.run_scene("jack", path, BAD_INPUT, entries=law)
                self.assert_fault([*words, "element test"], BAD_INPUT, text)
                self.assertFalse((path / "history.csv").exists())

    def test_in_the_run(self) -> None:
        """What happens later, of every second kind, names the point and the step."""
        for kind, words in list(FAULTS.items())[::2]:
            with self.subTest(kind):
                path, law = self.directory("results"), self.faulty(kind, 4)
                text = self.run_scene("jack", path, FAILURE, entries=law)
                place = ["in step 3 at t = ", "at r = 0."]
                self.assert_fault([*words, *place], FAILURE, text)

    def test_no_faults(self) -> None:
        """What a UMAT does to its own copy of the input."""
        rows = []
        for kind, step in (("throw 7;", 9**9), *((kind, 0) for kind in HARMLESS)):
            path = self.directory("results")
            law = self.faulty(kind, step)
            law["Time/End penetration"] = 0.502
            self.run_scene("jack", path, entries=law)
            rows.append(history(path))
        self.assertGreater(rows[0][-1]["total_force_N"], 0)
        for row in rows[1:]:
            self.assert_same_history(row, rows[0], 0)

    def test_stiffness_that_stress_contradicts(self) -> None:
        """A wrong sign, and a DDSDDE or units that are far off."""
        for factors, words in (
            ((-1, 1), ["falls as the strain grows"]),
            ((1, 1e8), ["no more than", "correct it"]),
            ((1e-6, 1e-6), ["less than the stress at the start", "Unit of stress"]),
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
        self.assertNotIn("is valid", text)

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
        """The end of one rank is that of all."""
        path, law = self.directory("results"), self.faulty("std::exit(0);", 4)
        text = self.run_scene("jack", path, FAILURE, entries=law, ranks=2)
        self.assert_words(["law.so", "STOP or exit", "in step 3"], text)

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


if __name__ == "__main__":
    unittest.main()
