#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laws of the user as people have them: six components, other units and names, SDVINI;
and what laws keep of a point: its stress without strain, STATEV."""
import unittest
from pathlib import Path

import numpy as np
from program import BAD_INPUT, caisson, Entries, history, scene, SUCCESS, summary
from test_paraview_frames import files, read
from test_user_material import compile_law, COUNT, ELASTIC, LAYER, UserMaterialTest


ARGUMENTS = """stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, \
stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname, ndi, nshr, ntens, \
nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, noel, npt, layer, \
kspt, kstep, kinc"""
HEAD = f"""      SUBROUTINE {{name}}({ARGUMENTS})
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(*),DDSDDE(NTENS,NTENS),DSTRAN(NTENS),STRAN(NTENS)
      DIMENSION PROPS(NPROPS),COORDS(3),DROT(3,3),S(6),PS(3),AN(3,3)
"""
ELASTIC_BODY = """
      G=E/2.6D0
      DDSDDE=0
      DDSDDE(1:3,1:3)=E*.3D0/(1.3D0*.4D0)
      DO I=1,NTENS
        DDSDDE(I,I)=DDSDDE(I,I)+MERGE(2,1,I.LE.NDI)*G
      END DO
      STRESS=STRESS+MATMUL(DDSDDE,DSTRAN)
"""
# subroutines as people have them: fixed form with long lines, and their entries
ROUTINES: dict[str, tuple[str, str, Entries]] = {
    "turns": (
        "STRESS=-STRESS; DSTRAN=-DSTRAN; STRAN=-STRAN",
        "STRESS=-STRESS; DSTRAN=-DSTRAN",
        {},
    ),
    "six": (
        "IF(NTENS.NE.6.OR.NSHR.NE.3.OR.ANY(DSTRAN(5:6).NE.0)) CALL XIT\n"
        "      DSTRAN(4:6)=DSTRAN(6:4:-1); STRESS(4:6)=STRESS(6:4:-1)",
        "STRESS(4:6)=STRESS(6:4:-1)",
        {"Stress components": 6},
    ),
    "named": ("IF(CMNAME(1:6).NE.'SAND-1') CALL XIT", "", {"Material name": "Sand-1"}),
    "kilo": ("E=E/1D3", "", {"Unit of stress": "kPa"}),
    "mega": ("E=E/1D6", "", {"Unit of stress": "MPa"}),
    "laws::inside": ("", "", {}),
    "helped": (
        "",
        """CALL SPRIND(STRESS,PS,AN,1,NDI,NSHR)
      CALL ROTSIG(STRESS,AN,S,1,NDI,NSHR)
      IF(ANY(ABS(S(1:3)-PS)+ABS(S(4)).GT.1D-9*ABS(PS(3)))) CALL XIT
      CALL SINV(STRESS,S(1),S(2),NDI,NSHR)
      IF(ABS(S(1)-SUM(PS)/3).GT.1D-9*ABS(PS(3))) CALL XIT
      IF(ABS(S(2)**2-.5D0*SUM((PS-CSHIFT(PS,1))**2)).GT.1D-9*S(2)**2) CALL XIT
      CALL SPRINC(DSTRAN,PS,2,NDI,NSHR)
      S(1)=SUM(DSTRAN(1:3)**2)+.5D0*DSTRAN(4)**2
      IF(ABS(SUM(PS**2)-S(1)).GT.1D-9*S(1)) CALL XIT""",
        {},
    ),
    "started": ("E=E*STATEV(1)/3", "", {"State variables": 3}),
}
SDVINI = """
      SUBROUTINE SDVINI(STATEV,COORDS,NSTATV,NCRDS,NOEL,NPT,LAYER,KSPT)
      INCLUDE 'ABA_PARAM.INC'
      DIMENSION STATEV(NSTATV),COORDS(NCRDS)
      IF(NCRDS.NE.2) CALL XIT
      STATEV(1)=3
      STATEV(2)=COORDS(2)
      STATEV(3)=MERGE(NSTATV,0,MIN(NOEL,NPT,LAYER,KSPT).GE.1)
      END
"""


class LawsOfOthers(UserMaterialTest):
    """UMATs as people have them, all in one library."""

    library: Path

    @classmethod
    def setUpClass(cls) -> None:
        """Compile them."""
        path = cls.results / "library"
        path.mkdir(parents=True, exist_ok=True)
        text = ""
        for name, (first, last, _) in ROUTINES.items():
            module, colons, routine = name.rpartition("::")
            begin = f"      E=PROPS(1)\n      {first}{ELASTIC_BODY}      {last}\n"
            whole = HEAD.format(name=routine) + begin + "      END SUBROUTINE\n"
            if colons:
                module = f"      MODULE {module}\n      CONTAINS\n"
                whole = module + whole + "      END MODULE\n"
            text += whole
        cls.library = compile_law(path, "laws.f", text + SDVINI)

    def entries(self, routine: str) -> Entries:
        """Return the entries of a law of the library in uniform strain."""
        velocity = "-0.05*r ; -0.3*z + 0.4*r"
        more = {f"{LAYER}/{k}": v for k, v in ROUTINES[routine][2].items()}
        return {
            **self.law(self.library, [5e6], Routine=routine),
            **more,
            "Soil/Initial stress": "uniform",
            "Soil/Uniform stress": "-2e4, -3e4, -2.5e4, 3e3",
            "Soil/Initial velocity": velocity,
            "Boundary conditions/Prescribed velocity": velocity,
            "Time/Time step": 5e-4,
            "Time/End time": 0.01,
            "Grid/Cell width": 0.2,
            "Grid/Cell height": 0.2,
            "Verification/Checks": "",
            "Verification/Observations": "; ".join(
                f"{i} = rms stress_{i}" for i in ("rr", "zz", "tt", "rz")
            ),
        }

    def test_same_stress(self) -> None:
        """The stress is that of the elastic law of the program."""
        own: Entries = {**self.entries("named"), f"{LAYER}/Law": "linear elastic"}
        own.update({f"{LAYER}/Youngs modulus": 5e6, f"{LAYER}/Poisson ratio": 0.3})
        path = self.directory("own")
        self.run_scene("patch_stretching", path, entries=own)
        right = history(path, "observations")[-1]
        self.assertGreater(right["zz"], 4e4)
        for routine in ROUTINES:
            with self.subTest(routine):
                path = self.directory("user")
                entries = self.entries(routine)
                self.run_scene("patch_stretching", path, entries=entries)
                found = history(path, "observations")[-1]
                for i in ("rr", "zz", "tt", "rz"):
                    self.assertAlmostEqual(found[i] / right[i], 1, delta=1e-6)

    def test_entries_that_lack(self) -> None:
        """What a UMAT needs is named."""
        for routine, words in {
            "six": ["XIT"],
            "named": ["XIT", "CMNAME", "Material name"],
            "kilo": ["less than the stress", "Unit of stress"],
        }.items():
            with self.subTest(routine):
                entries = self.entries(routine)
                for key in ROUTINES[routine][2]:
                    del entries[f"{LAYER}/{key}"]
                self.refused(words, "patch_stretching", entries=entries)

    def test_state_at_the_start(self) -> None:
        """SDVINI sets it by the place and the number of each point, over the entry."""
        entries = self.entries("started")
        entries[f"{LAYER}/State at the start"] = "2, 1"
        entries["Soil/Initial velocity"] = "0 ; 0"
        entries["Boundary conditions/Prescribed velocity"] = "0 ; 0"
        entries["Verification/Checks"] = "; ".join(
            [
                "pointwise statev_1 : 3 : 1e-12",
                "pointwise statev_2 : z : 1e-9",
                "pointwise statev_3 : 3 : 1e-12",
            ]
        )
        path = self.directory()
        text = self.run_scene("patch_stretching", path, entries=entries)
        self.assert_words(["SDVINI", "replaces State at the start"], text)


START = {"Time/End penetration": 0.51, "Verification/Checks": ""}


class StressOfUser(UserMaterialTest):
    """The stress that a UMAT is given."""

    def test_stress_that_is_not_kept(self) -> None:
        """Without a strain increment, a law that forgets the stress at entry or
        scales it is refused; one that returns it to its yield surface is not."""
        for more in (
            "  stress = matmul(ddsdde, stran + dstran)",
            "  stress = 1.01d0 * stress",
        ):
            with self.subTest(more):
                law = self.law(self.compiled("elastic.f90", more), ELASTIC, K0=0.5)
                words = (scene("jack"), "--validate")
                text = self.run_program(BAD_INPUT, *words, entries=law)
                self.assert_words(["increment is zero", "STRESS at entry"], text)
        for earth_pressure, is_reported in ((0.3, True), (0.7, False)):
            numbers = [5e6, 0.3, 20, 0, 0, 0]
            law = self.law(
                self.compiled("mohr_coulomb.f90"), numbers, K0=earth_pressure
            )
            text = self.run_program(SUCCESS, *words, entries=law)
            self.assertEqual("outside of its yield surface" in text, is_reported, text)


class Frames(UserMaterialTest):
    """STATEV of points in frames and exports."""

    def test_state_of_a_user_material(self) -> None:
        """STATEV is in the frames, not a number in other layers, and exported."""
        path = self.directory()
        entries = {
            **self.law(
                self.compiled("elastic.f90", COUNT), ELASTIC, State_variables=40, K0=0.5
            ),
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 2,
            "Soil/Layer 2/Law": "linear elastic",
        }
        self.run_scene("jack", path, entries={**START, **entries})
        arrays = read(files(path, "points")[-1])[1]
        user = arrays["layer"] == 1
        np.testing.assert_array_equal(arrays["statev_1"][user], summary(path)["steps"])
        self.assertTrue(np.isnan(arrays["statev_40"][~user]).all())
        self.assertNotIn("statev_41", arrays)
        layer = summary(path)["scene"]["layers"][0]
        modulus = ELASTIC[0] * 0.7 / (1.3 * 0.4)
        self.assertAlmostEqual(layer["p_wave_modulus_Pa"] / modulus, 1, places=6)
        self.assertAlmostEqual(layer["poisson_ratio"], 0.3, places=9)
        self.assertEqual(caisson("export", path, "--to", "csv").returncode, 0)
        text = (path / "state.csv").read_text(encoding="utf-8")
        names = next(one for one in text.splitlines() if one[0] != "#").split(",")
        self.assertTrue({"statev_1", "statev_40"} <= set(names))


if __name__ == "__main__":
    unittest.main()
