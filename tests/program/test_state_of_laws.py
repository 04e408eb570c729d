#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What laws keep of a point: its stress without strain, its yield stress, STATEV."""
import math
import unittest

import numpy as np
from program import BAD_INPUT, SUCCESS, caisson, scene, summary
from test_paraview_frames import files, read
from test_user_material import COUNT, ELASTIC, LAYER, UserMaterialTest

SINE = math.sin(math.radians(30))
M = 6 * SINE / (3 - SINE)
START = {"Time/End penetration": 0.51, "Verification/Checks": ""}
CLAY = {
    f"{LAYER}/Law": "modified Cam clay",
    f"{LAYER}/Critical friction angle": 30,
    f"{LAYER}/Yield stress ratio": 2,
    f"{LAYER}/Void ratio": 1.1,
    f"{LAYER}/K0": 0.6,
}


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
    """Yield stress and STATEV of points in frames and exports."""

    def test_yield_stress_of_clay(self) -> None:
        """At rest p_c is twice that of the yield surface through the stress, below
        the laws that have none; it goes through the export."""
        path = self.directory()
        more = {
            "Soil/Number of layers": 2,
            "Soil/Layer 2/Top depth": 2,
            "Soil/Layer 2/Law": "linear elastic",
        }
        self.run_scene("jack", path, entries={**START, **CLAY, **more})
        arrays = read(files(path, "points")[0])[1]
        stress, found = arrays["stress_Pa"], arrays["yield_stress_Pa"]
        p, q = -stress[:, :3].mean(axis=1), abs(stress[:, 1] - stress[:, 0])
        clay = arrays["layer"] == 1
        np.testing.assert_allclose(
            found[clay], 2 * (p + q**2 / (M**2 * p))[clay], rtol=1e-4
        )
        self.assertTrue(np.isnan(found[~clay]).all() and (~clay).any())
        last = read(files(path, "points")[-1])[1]
        self.assertTrue((last["yield_stress_Pa"][clay[: len(last["layer"])]] > 0).all())

    def test_yield_stress_of_sand(self) -> None:
        """NorSand without coupling: p_i = p exp(q / (M p) - 1)."""
        path = self.directory()
        sand = {
            f"{LAYER}/Law": "NorSand",
            f"{LAYER}/Critical friction angle": 30,
            f"{LAYER}/Volumetric coupling": 0,
            f"{LAYER}/Yield stress ratio": 1.5,
            f"{LAYER}/Void ratio": 0.7,
            f"{LAYER}/K0": 0.6,
        }
        self.run_scene("jack", path, entries={**START, **sand})
        arrays = read(files(path, "points")[0])[1]
        stress = arrays["stress_Pa"]
        p, q = -stress[:, :3].mean(axis=1), abs(stress[:, 1] - stress[:, 0])
        image = 1.5 * p * np.exp(q / (M * p) - 1)
        deep = p > 2e3  # above the smallest stress of stiffness
        np.testing.assert_allclose(
            arrays["yield_stress_Pa"][deep], image[deep], rtol=1e-4
        )

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
