#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""When the program warns that the water lifts the soil of the plug."""
import unittest

from program import Entries, ProgramTest, history

LAYER = "Soil/Layer 1"
GAMMA_W = 9810.0  # N/m3
EMBEDMENT = 0.5  # m, of simulation/jack.prm
WEIGHT = 0.9  # gradient that the weight of its soil withstands
NEAR = 0.9  # share from which on the program warns
AT_REST: Entries = {
    "Rigid body/Velocity": 0,
    "Rigid body/Ramp time": 0,
    "Water/Suction control": "table",
    "Time/End penetration": "never",
    "Time/End time": 0.5,
    "Output/Record interval": 0.1,
}


def layers(thickness: float, upper: float, lower: float) -> Entries:
    """Return the entries of two layers with these cohesions."""
    soil: Entries = {"Soil/Number of layers": 2, "Soil/Layer 2/Top depth": thickness}
    for i, cohesion in enumerate((upper, lower), 1):
        soil[f"Soil/Layer {i}/Cohesion"] = cohesion
        soil[f"Soil/Layer {i}/Permeability"] = 2e-4
    return soil


class Piping(ProgramTest):
    """The body rests, and the suction is raised within half a second."""

    def raised(self, suction: float, entries: Entries) -> tuple[str, dict[str, float]]:
        """Return what the program says, and its last record."""
        path = self.directory(f"{suction:g}")
        table = {"Water/Suction table": f"0:0, 0.4:{suction}"}
        text = self.run_scene("suction", path, entries={**AT_REST, **table, **entries})
        return text, history(path)[-1]

    def assert_reported_from(self, withstood: float, entries: Entries) -> None:
        """Ask for the warning just above this gradient, and for none just below."""
        per_pascal = self.raised(1e3, entries)[1]["exit_gradient_wall"] / 1e3
        for share, is_told in ((0.9, False), (1.1, True)):
            suction = share * NEAR * withstood / per_pascal
            text, last = self.raised(suction, entries)
            self.assertAlmostEqual(
                last["exit_gradient_wall"], share * NEAR * withstood, delta=0.02
            )
            self.assertEqual("piping" in text.lower(), is_told, text)

    def test_sand(self) -> None:
        self.assert_reported_from(WEIGHT, {})
        text, last = self.raised(3e4, {})
        self.assert_words(["exit gradient", "90 % of the critical one"], text)
        self.assertGreater(last["exit_gradient_wall"], last["critical_gradient"])

    def test_elastic_soil(self) -> None:
        """A law without strength holds nothing but its weight."""
        text, _ = self.raised(3e4, {f"{LAYER}/Law": "linear elastic"})
        self.assert_words(["exit gradient exceeds"], text)

    def test_cohesion(self) -> None:
        """A little cohesion holds a little: 4 c / (gamma_w w) with the width w / 2 of
        the block that is lifted. Clay of 10 kPa holds what no suction reaches."""
        for cohesion in (1, 100, 1000):
            with self.subTest(cohesion=cohesion):
                strength = 2 * cohesion / EMBEDMENT / GAMMA_W
                entries: Entries = {f"{LAYER}/Cohesion": cohesion}
                self.assert_reported_from(WEIGHT + strength, entries)
        text, last = self.raised(3e4, {f"{LAYER}/Cohesion": 1e4})
        self.assertGreater(last["exit_gradient_wall"], 2 * WEIGHT)
        self.assertNotIn("piping", text.lower())

    def test_tension(self) -> None:
        """The soil below the deepest block bears its tension, at most c cot(phi)."""
        for angle, cohesion, tension in ((30, 500, 300), (5, 400, 3000)):
            entries: Entries = {
                f"{LAYER}/Friction angle": angle,
                f"{LAYER}/Cohesion": cohesion,
                f"{LAYER}/Tension cut-off": tension,
            }
            strength = (2 * cohesion + tension) / EMBEDMENT / GAMMA_W
            with self.subTest(tension=tension):
                self.assert_reported_from(WEIGHT + strength, entries)

    def test_layers(self) -> None:
        """A weak layer is lifted off a strong one, however thin it is; a strong one
        holds what is beneath it as far as its own strength goes."""
        self.assert_reported_from(WEIGHT, layers(0.1, 0, 1e4))
        mean = 0.1 / EMBEDMENT * 2e3
        strength = 2 * mean / EMBEDMENT / GAMMA_W
        self.assert_reported_from(WEIGHT + strength, layers(0.1, 2e3, 0))

    def test_coupled_water(self) -> None:
        """The flow out of clay is noise, and cohesion holds it together."""
        for cohesion, k, is_told in ((1e4, 1e-9, False), (0, 1e-4, True)):
            text = self.run_scene(
                "suction",
                self.directory(f"cohesion_{cohesion:g}"),
                entries={
                    f"{LAYER}/Cohesion": cohesion,
                    f"{LAYER}/Permeability": k,
                    "Water/Level": "coupled",
                    "Water/Suction control": "table",
                    "Water/Suction table": "0:2e4",
                    "Time/End penetration": 0.52,
                    "Output/Record interval": 0.01,
                },
            )
            self.assertEqual("piping" in text.lower(), is_told, text)


class Pulled(ProgramTest):
    """The body leaves the ground."""

    def test_plug_beside_displaced_soil(self) -> None:
        """A thick wall leaves the ground without suction: the plug rises by more than
        the wall displaces once the volume that it leaves is that of a rise by 2 % of
        its radius."""
        path = self.directory()
        entries: Entries = {
            "Rigid body/Wall thickness": 0.8,
            "Rigid body/Cells across the wall": 4,
            "Rigid body/Velocity": -0.1,
            "Rigid body/Ramp time": 0,
            "Rigid body/Initial penetration": 0.8,
            "Grid/Bottom": -8,
            "Grid/Moving zone below tip": 3,
            "Time/End penetration": 0.71,
            "Output/Record interval": 0.1,
        }
        text = self.run_scene("suction", path, entries=entries)
        inner, outer = 2.2, 3.0  # m
        rise_per_travel = (outer**2 - inner**2) / inner**2
        first = next(
            row["penetration_m"]
            for row in history(path)
            if row["plug_heave_m"] + (0.8 - row["penetration_m"]) * rise_per_travel
            > 0.02 * outer
        )
        words = f"rises by more than the wall displaces at a penetration of {first:g} m"
        self.assert_words([words], text)


if __name__ == "__main__":
    unittest.main()
