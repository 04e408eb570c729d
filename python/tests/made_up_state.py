# SPDX-License-Identifier: LGPL-2.1-or-later
"""Made-up soil at rest around a wall, for the tests of exported states."""
import tempfile
import unittest
from pathlib import Path

import numpy as np

from caisson.export.exported import Exported, exported
from caisson.export.mesh import Mesh, Window, regular
from caisson.export.state import Layer, State, Wall

WEIGHT, K0 = 9e3, 0.5  # N/m3, 1
WINDOW = Window(4.0, 4.0, 0.2)
WEDGE = Wall(1.9, 2.0, np.array([1.9, 1.95, 2.0]), np.array([-1.95, -2.0, -1.95]))
FORCES = {"tip_force_N": 2e5, "inner_friction_N": 2e4, "outer_friction_N": 3e4}


def made_up(
    noise: float = 0.0, wall: Wall | None = WEDGE, surface: float = 0.0
) -> State:
    """Return soil at rest whose points are wider than high, as beside a wall, with
    noise in the stress as a share of it."""
    r, z = np.meshgrid(np.arange(0.02, 5, 0.04), np.arange(-5 + 0.065, 0, 0.13))
    position = np.column_stack([r.ravel(), z.ravel()])
    if wall is not None:
        position = position[~wall.contains(position)]
    vertical = WEIGHT * position[:, 1]
    stress = np.outer(vertical, [K0, 1, K0, 0])
    random = np.random.default_rng(1)
    stress *= 1 + noise * random.standard_normal(stress.shape)
    stress[:, 3] += noise * vertical * random.standard_normal(len(vertical))
    return State(
        title="made up",
        time=1.0,
        penetration=2.0,
        position=position + [0, surface],
        stress=stress,
        volume=2 * np.pi * position[:, 0] * 0.04 * 0.13,
        pressure=None,
        displacement=np.tile([0.0, surface], (len(position), 1)),
        fields={"void_ratio": 0.7 + 0.01 * position[:, 1]},
        layer=np.zeros(len(position), dtype=int),
        unit_weight=np.full(len(position), WEIGHT),
        layers=[Layer(1, WEIGHT, 1e7)],
        wall=wall,
        forces={} if wall is None or not noise else dict(FORCES),
        outer_radius=5.0,
        bottom=-5.0,
    )


def on_mesh(state: State, mesh: Mesh | None = None) -> Exported:
    """Return a state on a mesh, or else on the regular grid."""
    return exported(state, mesh or regular(state, WINDOW))


class Temporary(unittest.TestCase):
    """A directory for the files of a test."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.path = Path(temporary.name)
