# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of exported states: the regular grid, and files of Gmsh."""
import math
import unittest

import numpy as np
from made_up_state import WEDGE, WINDOW, Temporary, balanced, made_up
from plain_solver import forces_of, read_deck
from scipy.spatial import cKDTree

from caisson.results import ResultsError
from caisson_export import decks
from caisson_export.balance import balance
from caisson_export.gmsh import read_gmsh
from caisson_export.interpolate import interpolate
from caisson_export.mesh import (
    Mesh,
    Window,
    default_window,
    regular,
    with_sets,
)
from caisson_export.state import Wall


class Grid(unittest.TestCase):
    """The regular grid."""

    def test_it_follows_the_surface(self) -> None:
        state = made_up(surface=-0.3)
        mesh = regular(state, WINDOW)
        surface = mesh.nodes[mesh.sets["SURFACE"]]
        np.testing.assert_allclose(surface[:, 1], -0.3, atol=1e-9)

    def test_no_cracks(self) -> None:
        """Parts of the grid share their nodes, whatever the spacing."""
        state = made_up()
        for spacing in np.linspace(0.1, 0.4, 16):
            mesh = regular(state, Window(4.1, 4.3, spacing))
            self.assertFalse(cKDTree(mesh.nodes).query_pairs(1e-3), spacing)
            ends = mesh.nodes[mesh.sets["SURFACE"], 1]
            np.testing.assert_allclose(ends, 0, atol=1e-9)

    def test_sets(self) -> None:
        mesh = regular(made_up(), WINDOW)
        tip = mesh.nodes[mesh.sets["TIP"]]
        np.testing.assert_allclose(
            tip[np.argsort(tip[:, 0])], [[1.9, -1.95], [1.95, -2], [2, -1.95]]
        )
        for name, r in (("INNER_WALL", 1.9), ("OUTER_WALL", 2.0)):
            wall = mesh.nodes[mesh.sets[name]]
            np.testing.assert_allclose(wall[:, 0], r)
            self.assertAlmostEqual(wall[:, 1].max(), 0)
        self.assertFalse(WEDGE.contains(mesh.centers).any())

    def test_window(self) -> None:
        state = made_up()
        usual = default_window(state)
        self.assertEqual((usual.radius, usual.spacing), (5.0, 0.1))
        with self.assertRaisesRegex(ResultsError, "does not reach beyond the wall"):
            regular(state, Window(4, 1.9, 0.2))

    def test_pile_and_cone(self) -> None:
        """Bodies without a plug, with a flat and a pointed end."""
        r = np.array([0.0, 0.3])
        for z in (np.array([-2.0, -2.0]), np.array([-2.5, -2.0])):
            state = made_up(wall=Wall(0.0, 0.3, r, z))
            found = balanced(state)
            self.assertNotIn("INNER_WALL", found.mesh.sets)
            self.assertLess(found.before, 2e-3)
            whole = math.pi * 4**2 * 4 - math.pi * 0.3**2 * (2 + (z[1] - z[0]) / 3)
            self.assertAlmostEqual(found.volume.sum() / whole, 1, delta=1e-3)

    def test_without_a_wall(self) -> None:
        found = balanced(made_up(wall=None))
        self.assertNotIn("TIP", found.mesh.sets)
        self.assertLess(found.before, 1e-3)


MSH_2 = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0 -4 0
2 2 -4 0
3 4 -4 0
4 0 0 0
7 2 0 0
8 4 0 0
$EndNodes
$Elements
4
1 1 2 9 1 1 2
2 3 2 5 1 1 2 7 4
3 2 2 6 1 2 7 3
4 2 2 6 1 3 8 7
$EndElements
"""
MSH_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
1 1 2 0
1 0 0 0 0
1 0 0 0 1 0 0 0 0
1 0 -4 0 2 0 0 1 5 0
2 2 -4 0 4 0 0 1 6 0
$EndEntities
$Nodes
2 6 1 8
2 1 0 4
1
2
4
7
0 -4 0
2 -4 0
0 0 0
2 0 0
2 2 0 2
3
8
4 -4 0
4 0 0
$EndNodes
$Elements
3 4 1 4
1 1 1 1
1 1 2
2 1 3 1
2 1 2 7 4
2 2 2 2
3 2 7 3
4 3 8 7
$EndElements
"""


class Gmsh(Temporary):
    """Meshes of Gmsh."""

    def read(self, text: str, wall: Wall | None = None) -> Mesh:
        """Return the mesh of a file."""
        path = self.path / "a.msh"
        path.write_text(text, encoding="utf-8")
        return read_gmsh(path, wall)

    def test_both_formats(self) -> None:
        """Quadrilaterals and triangles, one of which is clockwise."""
        for text in (MSH_2, MSH_4):
            mesh = self.read(text)
            assert mesh.groups is not None
            self.assertEqual(mesh.groups.tolist(), [5, 6, 6])
            self.assertEqual(mesh.is_triangle.tolist(), [False, True, True])
            found = balanced(made_up(wall=None), mesh)
            self.assertAlmostEqual(found.volume.sum(), math.pi * 4**2 * 4)
            self.assertGreater(found.volume.min(), 0)
            decks.write(self.path / "a.inp", decks.abaqus(found))
            deck = read_deck(self.path / "a.inp")
            self.assertEqual(deck.element_sets["GROUP_6"], [2, 3])
            self.assertAlmostEqual(forces_of(deck).whole / found.weight, 1, delta=1e-6)

    def test_what_is_refused(self) -> None:
        for text, words in (
            ("", "is no text file of Gmsh"),
            (MSH_2.replace("2.2 0", "2.2 1"), "save it as text"),
            (MSH_2.replace("2.2 0", "3 0"), "save it as text"),
            (MSH_2.replace("8 4 0 0", "8 4 0 1"), "not in the plane"),
            (MSH_2.replace("1 0 -4", "1 -1 -4"), "nodes at r < 0"),
            (MSH_2.replace("1 2 7 3", "1 2 7 33"), "node 33, which is not among"),
            (MSH_2.split("$Elements")[0] + "$Elements\n0\n", "no triangles"),
        ):
            with self.subTest(words), self.assertRaisesRegex(ResultsError, words):
                self.read(text)
        with self.assertRaisesRegex(ResultsError, "no edges on the wall"):
            self.read(MSH_2, WEDGE)
        mesh = regular(made_up(), WINDOW)
        r, z = mesh.centers.T
        mesh.cells = mesh.cells[(r < 3.5) | (z > -3.5)]
        with self.assertRaisesRegex(ResultsError, "neither on the axis"):
            with_sets(mesh, WEDGE)

    def test_a_piece_that_is_not_held(self) -> None:
        """The plug alone, whose wall slides."""
        state = made_up(noise=0.02)
        mesh = regular(state, WINDOW)
        r, z = mesh.centers.T
        mesh.cells = mesh.cells[(r > 1.9) | (z > -1.5) | (z < -1.9)]
        values = interpolate(state, mesh.centers)
        with self.assertRaisesRegex(ResultsError, "not held"):
            balance(state, mesh, values)


if __name__ == "__main__":
    unittest.main()
