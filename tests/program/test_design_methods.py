#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The section Design methods: from the scene to run.json, and from there to the
methods beside the run."""
import unittest
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from program import BAD_INPUT, SUCCESS, ProgramTest, history, scene, summary

from caisson.plot import theory
from caisson.results import Results
from caisson.design import houlsby_byrne

SECTION = "Design methods"
SHORT = {"Time/End penetration": 0.51}
GIVEN = {
    f"{SECTION}/K tan delta inside": "0.6, 0.5",
    f"{SECTION}/K tan delta outside": 0.7,
    f"{SECTION}/Load spread": "none",
}
DEFAULTS = {
    "k_tan_delta_inside": [0.45, 0.8],
    "k_tan_delta_outside": [0.45, 0.8],
    "plug_permeability_ratio": 1,
    "load_spread": 1.5,
}


class DesignMethods(ProgramTest):
    """What they assume beside a short run."""

    def run_short(self, name: str, *words: Any, entries: dict[str, Any]) -> Path:
        """Run the scene for 10 mm; return its directory."""
        path = self.directory(name)
        self.run_program(
            SUCCESS,
            scene("jack"),
            "--output-directory",
            path,
            *words,
            entries={**SHORT, **entries},
        )
        return path

    def test_from_the_scene_to_the_methods(self) -> None:
        """Outer friction at 1 m without enhancement: 0.7 gamma' / 2 pi D; the run is
        the same as without the entries."""
        path = self.run_short("given", entries=GIVEN)
        known = summary(path)["scene"]["design_methods"]
        self.assertEqual(
            known,
            {
                "k_tan_delta_inside": [0.5, 0.6],
                "k_tan_delta_outside": [0.7, 0.7],
                "plug_permeability_ratio": 1,
                "load_spread": None,
            },
        )
        site = theory.site_of(Results(path))
        answer = theory.answers_of(site, np.array([1.0]))[0]
        weight = site.scene["layers"][0]["submerged_unit_weight_N_m3"]
        whole = weight / 2 * pi * site.scene["diameter_m"]
        for friction in answer.band("outer friction"):
            self.assertAlmostEqual(float(friction[0]) / whole, 0.7)
        default = self.run_short("default", entries={})
        self.assertEqual(summary(default)["scene"]["design_methods"], DEFAULTS)
        self.assertEqual(summary(default)["fingerprint"], summary(path)["fingerprint"])
        self.assertEqual(
            history(default)[-1]["tip_force_N"], history(path)[-1]["tip_force_N"]
        )

    def test_defaults_are_those_of_python(self) -> None:
        """An older run.json, without the section, has the same."""
        found = houlsby_byrne.Assumptions()._asdict()
        for name, value in DEFAULTS.items():
            value = tuple(value) if isinstance(value, list) else value
            self.assertEqual(found.pop(name), value)
        self.assertEqual(found, {})

    def test_a_run_may_go_on_with_others(self) -> None:
        """They do not change its state: a restart accepts them."""
        path = self.run_short("first", entries={})
        self.run_program(
            SUCCESS,
            scene("jack"),
            "--output-directory",
            path,
            "--restart",
            entries={"Time/End penetration": 0.512, **GIVEN},
        )
        known = summary(path)["scene"]["design_methods"]
        self.assertEqual(known["k_tan_delta_outside"], [0.7, 0.7])

    def test_what_cannot_be_meant(self) -> None:
        for entry, value in (
            ("K tan delta inside", "0.4, 0.6, 0.8"),
            ("K tan delta outside", "2.5"),
            ("Plug permeability ratio", "0"),
            ("Load spread", "1"),
        ):
            text = self.run_program(
                BAD_INPUT,
                scene("jack"),
                "--validate",
                entries={f"{SECTION}/{entry}": value},
            )
            self.assert_words([entry, value], text)

    def test_entries_without_effect(self) -> None:
        """A jacked caisson has no flow, and a cone no method of caissons."""
        entries = {f"{SECTION}/Plug permeability ratio": 3}
        text = self.run_program(SUCCESS, scene("jack"), "--validate", entries=entries)
        self.assert_words(["not used", "Plug permeability ratio", "no suction"], text)
        text = self.run_program(
            SUCCESS, scene("equilibrium_cone"), "--validate", entries=GIVEN
        )
        self.assert_words(["not used", "2 more entries", "Kind is not caisson"], text)
        text = self.run_program(
            SUCCESS, scene("suction"), "--validate", entries=entries
        )
        self.assertNotIn("not used", text)


if __name__ == "__main__":
    unittest.main()
