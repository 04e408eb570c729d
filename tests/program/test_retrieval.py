#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A caisson that water beneath its lid pushes out of clay and of sand."""
import json
import math
import unittest
from typing import Any

import numpy as np
from program import Entries, ProgramTest, history
from scipy.sparse import lil_matrix
from scipy.sparse.linalg import spsolve
from test_undrained_suction import CLAY, INNER_RADIUS, STRENGTH, WEIGHT

from caisson import report
from caisson.results import Results
from caisson.verdict.retrieval import retrieval_of

OUTER_RADIUS, DEPTH = 3.0, 2.0  # m
AREA = math.pi * INNER_RADIUS**2
RISES: Entries = {
    "Rigid body/Initial penetration": DEPTH,
    "Rigid body/Velocity": -0.1,
    "Water/Suction control": "required",
    "Time/End penetration": 1.8,
    "Output/Record interval": 0.05,
    "Output/Frame interval": "never",
}


def flow_at(depth: float, ratio: float = 1.0) -> tuple[float, float]:
    """Return the share of a pressure beneath the lid that is left at the tip, and its
    gradient at the mudline beside the inner wall (1/m), by finite differences of 0.1 m
    around the wall of the scene, in sand with this horizontal over the vertical
    permeability. The gradient is fitted as the program says that it does: by
    a + b d^2 over the distance d < depth from the wall, with the weights
    1 - (d / depth)^2."""
    size, n_r, n_z = 0.1, 70, 50
    wall, rows = range(28, 30), round(depth / size)
    number = np.arange(n_r * n_z).reshape(n_r, n_z)
    solid = np.zeros((n_r, n_z), dtype=bool)
    solid[28:30, :rows] = True
    matrix, right = lil_matrix((n_r * n_z, n_r * n_z)), np.zeros(n_r * n_z)
    for i in range(n_r):
        for j in range(n_z):
            row = number[i, j]
            matrix[row, row] = 1.0
            if solid[i, j]:
                continue
            matrix[row, row] = 0.0
            beside = [(i - 1, j, ratio * i), (i + 1, j, ratio * (i + 1))]
            for k, m, k_r in [*beside, (i, j - 1, i + 0.5), (i, j + 1, i + 0.5)]:
                if m < 0:  # the mudline is half a cell away
                    matrix[row, row] += 2 * k_r
                    right[row] += 2 * k_r * (i < wall[0])
                elif 0 <= k < n_r and m < n_z and not solid[k, m]:
                    matrix[row, row] += k_r
                    matrix[row, number[k, m]] -= k_r
    field = spsolve(matrix.tocsr(), right).reshape(n_r, n_z)
    radii = (np.arange(wall[0]) + 0.5) * size
    gradients = (1 - field[: wall[0], 0]) / (size / 2)
    squares = ((wall[0] * size - radii) / depth) ** 2
    near = squares < 1
    weights = np.sqrt((1 - squares[near]) * radii[near])
    gradient = np.polyfit(squares[near], gradients[near], 1, w=weights)[1]
    return float(field[wall[0] : wall[-1] + 1, rows].mean()), float(gradient)


class Retrieval(ProgramTest):
    """The caisson of water/suction.prm, wished in place at 2 m, rises."""

    def retrieved(self, name: str, entries: Entries) -> tuple[Any, Any]:
        """Return its history and verdict.json."""
        path = self.directory(name)
        self.run_scene("suction", path, entries={**RISES, **entries})
        report.write(path)
        known = json.loads((path / "verdict.json").read_text(encoding="utf-8"))
        return history(path), known

    def test_clay(self) -> None:
        """Both walls slip in clay of s_u from the start, and nothing holds the tip:
        p = (F + W) / A_i. The plug is pushed down, and not torn off."""
        rows, known = self.retrieved("clay", {**CLAY, "Water/Level": "drained"})
        slipping = [row for row in rows if 1.9 < row["penetration_m"] < 1.99]
        self.assertGreater(len(slipping), 10)
        for row in slipping:
            length = row["penetration_m"] - 0.1  # half of the bevel's height
            walls = 2 * math.pi * (OUTER_RADIUS + INNER_RADIUS) * length * STRENGTH
            by_hand = (walls + WEIGHT) / AREA
            self.assertAlmostEqual(-row["suction_Pa"] / by_hand, 1, delta=0.03)
        self.assertLess(slipping[-1]["plug_heave_m"], 0)
        weight = 0.6 * (2500 - 1000) * 9.81
        for row in known["retrieval"]:
            h = row["penetration_m"]
            self.assertEqual(row["governed_by"], "ground cracks beside the tip")
            self.assertAlmostEqual(
                row["allowable_overpressure_Pa"], weight * h + STRENGTH, delta=50
            )
        self.assertIn(
            "From 2 m to 1.8 m, retrieval takes an overpressure", known["verdict"]
        )

    def test_plug_at_the_lid(self) -> None:
        """A plug that fills the caisson stops its way down, and not its way up."""
        entries: Entries = {**CLAY, "Water/Level": "drained"}
        entries |= {"Rigid body/Skirt length": DEPTH, "Time/End penetration": 1.97}
        path = self.directory("lid")
        self.run_scene("suction", path, entries={**RISES, **entries})
        self.assertAlmostEqual(history(path)[-1]["penetration_m"], 1.97, delta=0.01)

    def test_set_up(self) -> None:
        """Twice the friction: the required overpressure grows by it over the area."""
        path = self.directory("set_up")
        entries: Entries = {**RISES, **CLAY, "Water/Level": "drained"}
        entries |= {"Design/Factor on set-up": 2}
        self.run_scene("suction", path, entries=entries)
        run = Results(path)
        found = retrieval_of(run)
        assert found is not None
        walls = run.history["inner_friction_N"] + run.history["outer_friction_N"]
        friction = -float(walls[2:].mean())
        middle = float(np.mean(-run.history["suction_Pa"][2:]))
        self.assertAlmostEqual(
            float(found.required.mean()) / (middle + friction / AREA), 1, delta=0.03
        )

    def test_sand(self) -> None:
        """Water flows down through the plug and up outside. What reaches the tip is
        that of finite differences, and helps to lift it."""
        entries: Entries = {"Soil/Layer 1/Permeability ratio": 1}
        rows, known = self.retrieved("sand", entries)
        last = rows[-1]
        self.assertLess(last["seepage_flow_m3_s"], 0)
        share, gradient = flow_at(last["penetration_m"])
        head = last["suction_Pa"] / 9810
        self.assertAlmostEqual(
            last["exit_gradient_wall"] / (head * gradient), 1, delta=0.03
        )
        self.assertAlmostEqual(last["pore_pressure_factor"] / share, 1, delta=0.05)
        tip = math.pi * (OUTER_RADIUS**2 - INNER_RADIUS**2)
        lifted = -last["suction_Pa"] * (AREA + share * tip)
        self.assertAlmostEqual(lifted / (WEIGHT - last["total_force_N"]), 1, delta=0.05)
        self.assertEqual(
            {x["governed_by"] for x in known["retrieval"]}, {"piping outside"}
        )

    def test_gradient_at_wall(self) -> None:
        """Where water hardly flows sideways, the gradient falls quickly away from the
        wall: its mean within the depth of the tip is a sixth less."""
        path = self.directory("layered")
        entries: Entries = {
            "Soil/Layer 1/Permeability ratio": 0.1,
            "Time/End penetration": 1.9,
        }
        self.run_scene("suction", path, entries={**RISES, **entries})
        last = history(path)[-1]
        gradient = flow_at(last["penetration_m"], 0.1)[1]
        head = last["suction_Pa"] / 9810
        self.assertAlmostEqual(
            last["exit_gradient_wall"] / (head * gradient), 1, delta=0.05
        )


if __name__ == "__main__":
    unittest.main()
