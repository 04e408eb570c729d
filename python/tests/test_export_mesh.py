# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exported states: meshes, the regular grid and files of Gmsh, and what follows from
the laws of the soil."""
import math
import unittest
from typing import Any

import numpy as np
from made_up_state import made_up, on_mesh, Temporary, WEDGE, WINDOW
from plain_solver import forces_of, read_deck
from scipy.spatial import cKDTree

from caisson.export import files
from caisson.export.gmsh import read_gmsh
from caisson.export.mesh import (
    default_window,
    lattice,
    Mesh,
    regular,
    steps,
    Window,
    with_sets,
)
from caisson.export.springs import shear_modulus
from caisson.export.state import Wall, youngs_modulus
from caisson.results import ResultsError


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
            found = on_mesh(state)
            self.assertNotIn("INNER_WALL", found.mesh.sets)
            self.assertAlmostEqual(found.boundary / found.weight, 1, delta=2e-3)
            whole = math.pi * 4**2 * 4 - math.pi * 0.3**2 * (2 + (z[1] - z[0]) / 3)
            self.assertAlmostEqual(found.mesh.volumes.sum() / whole, 1, delta=1e-3)

    def test_without_a_wall(self) -> None:
        found = on_mesh(made_up(wall=None))
        self.assertNotIn("TIP", found.mesh.sets)
        self.assertAlmostEqual(found.boundary / found.weight, 1, delta=1e-3)


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


def msh_2(
    nodes: np.ndarray,
    cells: np.ndarray,
    groups: np.ndarray,
    surfaces: np.ndarray | None = None,
) -> str:
    """Return a file of Gmsh, in which group 7 has a name."""
    tags = np.stack([groups, groups if surfaces is None else surfaces], 1).astype(int)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "1"]
    lines += ['2 7 "body"', "$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{i} {r:.9g} {z:.9g} 0" for i, (r, z) in enumerate(nodes, 1)]
    lines += ["$EndNodes", "$Elements", str(len(cells))]
    for i, (cell, (group, surface)) in enumerate(zip(cells + 1, tags), 1):
        corners = list(dict.fromkeys(cell.tolist()))
        words = [i, len(corners) - 1, 2, group, surface, *corners]
        lines.append(" ".join(map(str, words)))
    return "\n".join([*lines, "$EndElements", ""])


class Gmsh(Temporary):
    """Meshes of Gmsh."""

    def read(self, text: str, wall: Wall | None = None) -> Mesh:
        """Return the mesh of a file."""
        path = self.path / "a.msh"
        path.write_text(text, encoding="utf-8")
        return read_gmsh(path, made_up(wall=wall))

    def test_both_formats(self) -> None:
        """Quadrilaterals and triangles, one of which is clockwise."""
        for text in (MSH_2, MSH_4):
            mesh = self.read(text)
            assert mesh.groups is not None
            self.assertEqual(mesh.groups.tolist(), [5, 6, 6])
            self.assertEqual(mesh.is_triangle.tolist(), [False, True, True])
            found = on_mesh(made_up(wall=None), mesh)
            self.assertAlmostEqual(found.mesh.volumes.sum(), math.pi * 4**2 * 4)
            self.assertGreater(found.mesh.volumes.min(), 0)
            files.write_deck(self.path / "a.inp", found, "abaqus")
            deck = read_deck(self.path / "a.inp")
            self.assertEqual(deck.element_sets["GROUP_6"], [2, 3])
            self.assertAlmostEqual(forces_of(deck).whole / found.weight, 1, delta=1e-6)

    def test_what_is_refused(self) -> None:
        for text, words in (
            ("", "is no text file of Gmsh"),
            (MSH_2.replace("2.2 0", "2.2 1"), "binary .*-format msh41 -o a_text.msh$"),
            (MSH_2.replace("2.2 0", "3 0"), "another version .3 0.: save it as text"),
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

    def test_binary(self) -> None:
        """It is refused before its bytes are taken for text."""
        head = "$MeshFormat\n4.1 1 8\n"
        (self.path / "b.msh").write_bytes(head.encode() + b"\1\0\0\0\xc0\xff")
        with self.assertRaisesRegex(ResultsError, "b.msh is binary .4.1 1.: save it"):
            read_gmsh(self.path / "b.msh", made_up())

    def test_units_and_origin(self) -> None:
        """They are told by how far the mesh reaches."""
        for scale, shift, words in (
            (1e3, 0, "r = 4000 m, and from z = 0 m to -4000 m, .* seems to be in mm"),
            (1e2, 0, "it seems to be in cm; scale it to m"),
            (1e3, -2e4, "it seems to be in mm"),
            (1e-3, 0, "the wall stands at r = 2 m: the file must be in m"),
            (1, -20, "from z = -20 m .* must be at z = 0, .* move the mesh by 20 m$"),
            (1, 4, "move the mesh by -4 m, or turn the sign of z if it points down"),
        ):
            nodes, cells = self.around_the_wall(0.5)
            text = msh_2(scale * nodes + [0, shift], cells, np.ones(len(cells)))
            with self.subTest(words), self.assertRaisesRegex(ResultsError, words):
                self.read(text, WEDGE)

    @staticmethod
    def around_the_wall(size: float) -> tuple[np.ndarray, np.ndarray]:
        """Return quadrilaterals, some of which are a wall with a flat tip."""
        across = steps(1.9, 2, size)
        r = np.unique([*steps(0, 1.9, 0.4), *across, *steps(2, 4, 0.4)])
        z = np.unique([*steps(-4, -2, 0.4), *steps(-2, 0, size)])
        return lattice(r, z)

    def test_a_wall_that_is_meshed(self) -> None:
        """None of its cells is soil, not at the corners of a flat tip either, whether
        it is a group or only a surface of its own; the walls are found."""
        for size in (0.02, 0.05, 0.1):
            nodes, quads = self.around_the_wall(size)
            triangles = np.concatenate([quads[:, [0, 1, 2, 2]], quads[:, [0, 2, 3, 3]]])
            for cells in (quads, triangles):
                r, z = Mesh(nodes, cells).centers.T
                is_wall = (r > 1.9) & (r < 2) & (z > -2)
                for groups in (np.where(is_wall, 7, 1), np.ones(len(cells))):
                    text = msh_2(nodes, cells, groups, np.where(is_wall, 2, 1))
                    mesh = self.read(text, WEDGE)
                    self.assertEqual(len(mesh.cells), np.count_nonzero(~is_wall))
                    words = f"{is_wall.sum()} cells of the mesh are the wall, and left"
                    self.assertIn(words, mesh.remark)
                    self.assertEqual("group body" in mesh.remark, groups.max() == 7)
                    self.assertFalse((mesh.nodes[mesh.sets["SURFACE"], 1] < 0).any())
                    tip = mesh.nodes[mesh.sets["TIP"]]
                    self.assertEqual((tip[:, 0].min(), tip[:, 0].max()), (1.9, 2))


class Laws(unittest.TestCase):
    """Moduli, by hand."""

    def test_youngs_modulus(self) -> None:
        """That of the law, or what follows from a p-wave modulus."""
        layer: dict[str, Any] = {"p_wave_modulus_Pa": 13.5e6, "poisson_ratio": 0.3}
        self.assertAlmostEqual(youngs_modulus(layer) / (13.5e6 * 1.3 * 0.4 / 0.7), 1)
        self.assertEqual(youngs_modulus({"youngs_modulus_Pa": 5e6}), 5e6)
        self.assertTrue(np.isnan(youngs_modulus({"law": "hypoplastic"})))

    def test_shear_modulus_above_the_tip(self) -> None:
        """The mean over the materials of a layer, by their thickness; a stiffer layer
        does not count."""
        numbers = ((1, 0.0, 1e6), (1, 1.0, 4e6), (2, 3.0, 1e9))
        layers = [
            {"layer": number, "top_depth_m": top, "youngs_modulus_Pa": modulus}
            for number, top, modulus in numbers
        ]
        self.assertAlmostEqual(shear_modulus(layers, 4.0) / (3e6 / 2.6), 1)


if __name__ == "__main__":
    unittest.main()
