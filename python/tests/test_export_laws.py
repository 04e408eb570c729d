# SPDX-License-Identifier: LGPL-2.1-or-later
"""Zones of exported states, and what follows from the laws of the soil."""
import unittest
from typing import Any

import numpy as np
from made_up_state import K0, WEDGE, WEIGHT, Temporary, on_mesh, made_up

from caisson.results import read_table
from caisson.export import tables
from caisson.export.laws import vertical_over_yield_stress, youngs_modulus
from caisson.export.mesh import Mesh, Window, regular
from caisson.export.springs import shear_modulus
from caisson.export.state import State, Wall
from caisson.export.tables import Zone, zones_of


def entries(**numbers: float) -> list[dict[str, Any]]:
    """Return the list of the numbers of a law, as in run.json."""
    return [{"entry": k.replace("_", " "), "value": v} for k, v in numbers.items()]


def cam_clay(**more: Any) -> dict[str, Any]:
    """Return a layer of modified Cam clay."""
    numbers = entries(
        Slope_of_swelling=0.04,
        Poisson_ratio=0.25,
        Critical_friction_angle=30.0,
        Smallest_stress_of_stiffness=1e3,
    )
    return {"law": "modified Cam clay", "law_entries": numbers, **more}


class Zones(Temporary):
    """Zones for PLAXIS."""

    def zones(self, state: State, window: Window) -> tuple[Mesh, list[Zone]]:
        """Return the mesh of a window and its zones."""
        mesh = regular(state, window)
        return mesh, zones_of(on_mesh(state, mesh))

    def test_cover_the_ground_once(self) -> None:
        """At any penetration and spacing, each place of the ground is in one zone,
        and each zone has cells."""
        for depth in (0.115, 0.5, 2.0):
            flat = np.array([1.9, 2.0]), np.array([-depth, -depth])
            wall = Wall(1.9, 2.0, *flat)
            state = made_up(wall=wall)
            for spacing in (0.05, 0.11, 0.4):
                with self.subTest(depth=depth, spacing=spacing):
                    mesh, zones = self.zones(state, Window(4.0, 4.0, spacing))
                    self.assert_cover(wall, mesh, zones)

    def assert_cover(self, wall: Wall, mesh: Mesh, zones: list[Zone]) -> None:
        """Ask for each place of the ground, and the whole volume."""
        random = np.random.default_rng(2)
        place = random.uniform([0, -4.0], [4.0, 0.0], (4000, 2))
        place = place[~wall.contains(place)]
        r, z = place.T
        found = sum(
            ((r >= x.inner) & (r < x.outer) & (z >= x.low) & (z < x.high)).astype(int)
            for x in zones
        )
        near = (abs(z) < 1e-6) | (abs(z - wall.tip) < 1e-6)
        np.testing.assert_array_equal(np.asarray(found)[~near], 1)
        areas = [(x.outer**2 - x.inner**2) * (x.high - x.low) for x in zones]
        ground = 4.0**2 * 4.0 + (2.0**2 - 1.9**2) * wall.tip
        self.assertAlmostEqual(sum(areas) / ground, 1, delta=1e-6)
        self.assertTrue(all(x.cells.any() for x in zones))
        counted = np.sum([x.cells for x in zones], axis=0)
        np.testing.assert_array_equal(counted, np.ones(len(mesh.cells)))

    def test_rows_without_a_cell(self) -> None:
        """The rows beside them meet in the middle, or at the tip."""
        edges = np.arange(6.0)
        for tip, z, expected in (
            (0.0, [0.5, 1.5, 4.5], [0, 1, 3, 5]),
            (2.0, [0.5, 1.5, 4.5], [0, 1, 2, 5]),
            (1.0, [3.5], [0, 5]),
            (1.0, [2.5, 3.5], [0, 3, 5]),
        ):
            found = tables.rows_of_ring(edges, np.array(z), tip)
            np.testing.assert_array_equal(found, expected)

    def test_soil_beside_a_slope_of_the_tip(self) -> None:
        """Its cells count in the zone below."""
        state = made_up(wall=WEDGE)
        mesh, zones = self.zones(state, Window(4.0, 4.0, 0.2))
        counted = np.sum([x.cells for x in zones], axis=0)
        np.testing.assert_array_equal(counted, np.ones(len(mesh.cells)))

    def test_yield_stress(self) -> None:
        """Clay that was three times as heavily loaded has OCR 3, wherever the stress
        is that of rest; other layers keep their lower bound of 1."""
        state = made_up(wall=None)
        share = vertical_over_yield_stress(cam_clay())
        yielding = -3 * WEIGHT * state.position[:, 1]
        yielding[state.position[:, 1] < -3] = np.nan
        state.fields["vertical_yield_stress_Pa"] = yielding
        state.fields["yield_stress_Pa"] = yielding / share
        tables.write_plaxis(self.path / "a.csv", on_mesh(state))
        lines = (self.path / "a.csv").read_text(encoding="utf-8").splitlines()
        rows = [one.split(",", 1)[1] for one in lines if one[0] != "#"]
        (self.path / "b.csv").write_text("\n".join(rows), encoding="utf-8")
        table = read_table(self.path / "b.csv")
        clay, deep = table["z_bottom_m"] > -2.5, table["z_top_m"] < -3.3
        self.assertTrue(clay.sum() > 3 and deep.any())
        np.testing.assert_allclose(table["OCR"][clay], 3, rtol=0.02)
        np.testing.assert_allclose(table["OCR"][deep], 1, rtol=1e-3)
        stress = table["vertical_stress_kPa"][clay] * 3 / share
        np.testing.assert_allclose(table["yield_stress_kPa"][clay], stress, rtol=0.02)
        self.assertTrue(np.isnan(table["yield_stress_kPa"][deep]).all())


class Laws(unittest.TestCase):
    """Moduli and yield stress, by hand."""

    def test_vertical_stress_that_yields(self) -> None:
        """phi_c = 30 degrees: K0 = 0.5, M = 1.2; at 1 Pa, p = 2/3 and q = 1/2."""
        p_c = 2 / 3 + 0.5**2 / (1.2**2 * 2 / 3)
        self.assertAlmostEqual(vertical_over_yield_stress(cam_clay()), 1 / p_c)
        self.assertTrue(np.isnan(vertical_over_yield_stress({"law": "NorSand"})))

    def test_youngs_modulus(self) -> None:
        """K of Cam clay at 50 kPa is 2.1 x 50 kPa / 0.04, and E = 1.5 K."""
        pressure, void = np.array([50e3, 100.0]), np.array([1.1, 1.1])
        bulk = np.array([2.1 * 50e3, 2.1 * 1e3]) / 0.04
        found = youngs_modulus(cam_clay(), pressure, void)
        np.testing.assert_allclose(found, 1.5 * bulk)
        numbers = entries(
            Unloading_shear_modulus_ratio=500.0,
            Active_strength=1e4,
            Poisson_ratio=0.495,
        )
        layer: dict[str, Any] = {"law": "NGI-ADP", "law_entries": numbers}
        found = youngs_modulus(layer, pressure, void)
        np.testing.assert_allclose(found, 2 * 1.495 * 5e6)
        layer = {"p_wave_modulus_Pa": 13.5e6, "poisson_ratio": 0.3}
        found = youngs_modulus(layer, pressure, void)
        np.testing.assert_allclose(found, 13.5e6 * 1.3 * 0.4 / 0.7)
        found = youngs_modulus({"law": "hypoplastic"}, pressure, void)
        self.assertTrue(np.isnan(found).all())

    def test_shear_modulus_above_the_tip(self) -> None:
        """The mean over the materials of a layer: two of 1 m of Cam clay with p = 3
        and 9 kPa in the middle have that of 6 kPa; a stiffer layer does not count."""
        more = {"submerged_unit_weight_N_m3": WEIGHT, "K0": K0, "porosity": 0.5}
        layers = [
            cam_clay(**more, layer=1, top_depth_m=0.0),
            cam_clay(**more, layer=1, top_depth_m=1.0),
            {**more, "layer": 2, "top_depth_m": 2.0, "youngs_modulus_Pa": 1e9},
        ]
        expected = 1.5 * 2 * 6e3 / 0.04 / 2.5
        self.assertAlmostEqual(shear_modulus(layers, 3.0) / expected, 1)


if __name__ == "__main__":
    unittest.main()
