#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Piles, and bodies that start on the surface."""
import unittest

from program import SUCCESS, Entries, ProgramTest, history, user_scene

BODY = "Rigid body"


class Start(ProgramTest):
    """Bodies that start on the surface or just below."""

    def tip_force(self, name: str, entries: Entries) -> float:
        """Return the tip force (N) at a penetration of 0.06 m."""
        path = self.directory(name)
        more: Entries = {
            "Rigid body/Ramp time": 0.1,
            "Time/End penetration": 0.06,
            "Output/Frame interval": "never",
            "Output/Frame penetrations": "",
            "Output/Error bar": "",
        }
        self.run_program(
            SUCCESS,
            user_scene("jack"),
            "--output-directory",
            path,
            entries={**more, **entries},
        )
        return history(path)[-1]["tip_force_N"]

    def test_depth_of_the_start(self) -> None:
        """The force hardly depends on where the tip began."""
        cone: Entries = {
            f"{BODY}/Kind": "cone",
            f"{BODY}/Outer diameter": 0.3,
            f"{BODY}/Apex angle": 150,
        }
        bodies: dict[str, Entries] = {
            "flat": {f"{BODY}/Tip": "flat"},
            "triangular": {f"{BODY}/Tip": "triangular"},
            "cone": cone,
        }
        for name, body in bodies.items():
            forces = [
                self.tip_force(
                    f"{name}_{depth}", {**body, f"{BODY}/Initial penetration": depth}
                )
                for depth in (0, 0.01)
            ]
            self.assertLess(max(forces), 1.15 * min(forces), (name, forces))
            self.assertGreater(min(forces), 0)


if __name__ == "__main__":
    unittest.main()
