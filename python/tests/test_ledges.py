# SPDX-License-Identifier: LGPL-2.1-or-later
"""What rings and steps of the wall bear by hand methods, and the heave by them."""
import unittest
from math import pi
from typing import Any

import numpy as np
from test_by_hand import AREA, CLAY, END, INNER, SAND, TIP, Scene, in_clay
from test_methods import LINEAR, SKIRT, assert_forces, dnv_beside

from caisson.design import clay, dnv, houlsby_byrne
from caisson.design.houlsby_byrne import UNDISTURBED, Assumptions, Layer
from caisson.evaluation import heave_of_wall
from caisson.ledges import ledges_of


class Forces(unittest.TestCase):
    """A wall of 0.1 m that is 0.2 m thick from 1 m above the tip on, with a ring of
    0.25 m at 2 m: the step has pi (2.9^2 - 2.8^2) = 1.790708 m2, and the ring pi (2.8^2
    - 2.55^2) = 4.201880 m2. At 4 m they are at 3 and 2 m."""

    scene: dict[str, Any] = {
        "diameter_m": 6.0,
        "wall_thickness_m": 0.1,
        "wall_step_1_above_tip_m": 1.0,
        "wall_step_1_thickness_m": 0.2,
        "ring_1_above_tip_m": 2.0,
        "ring_1_width_m": 0.25,
        "ring_1_height_m": 0.06,
    }
    skirt = SKIRT._replace(ledges=ledges_of(scene))
    of_clay = 9e3, 20e3, 10e3, 8e3

    def test_areas(self) -> None:
        """A step that grows outward has pi (3.1^2 - 3^2), and the ring then pi (2.9^2 -
        2.65^2); a wall that becomes thinner has no face that looks down."""
        outward = {**self.scene, "flush_face": "inner"}
        for scene, step, ring in (
            (self.scene, 1.790708, 4.201880),
            (outward, 1.916372, 4.358960),
        ):
            found = ledges_of(scene)
            np.testing.assert_allclose([x.area for x in found], [step, ring], rtol=1e-6)
        self.assertEqual([x.is_inside for x in found], [False, True])
        thinner = {**self.scene, "wall_step_1_thickness_m": 0.05}
        self.assertEqual([x.height for x in ledges_of(thinner)], [2.0])
        self.assertEqual(ledges_of({}), ())

    def test_clay(self) -> None:
        """9 kPa per meter and N_c 20 kPa on each; in the lower case the inner wall has
        10 kPa only on the 2 m below the ring. At a depth of one width N_c is 1.2 / 1.5
        of that at depth."""
        method = clay.Clay(self.skirt, [clay.Layer(0, *self.of_clay)])
        tip = 1.853540 * 186 + 1.790708 * 177 + 4.201880 * 168
        walls = 10 * 2 * pi * 5.8, 8 * 4 * pi * 6
        assert_forces(method.forces(4, "strip"), (tip, *walls))
        tip = 1.853540 * 216 + 1.790708 * 207 + 4.201880 * 198
        assert_forces(method.forces(4, "circle"), (tip, 2 * walls[0], walls[1]))
        found = method.pressure(0.25, "strip", 0.25)
        self.assertAlmostEqual(found, 9e3 * 0.25 + 6 * 20e3)
        assert_forces(
            method.forces(1, "strip"), (1.853540 * 159, 10 * pi * 5.8, 8 * pi * 6)
        )

    def test_sand(self) -> None:
        """0.3 q_c, which is 6 and 4 MPa there; in layers of which the upper one is clay
        down to 2.5 m, the ring has 168 kPa."""
        tip, step, ring = 4448.495, 0.3 * 6e3 * 1.790708, 0.3 * 4e3 * 4.201880
        method = dnv.method(self.skirt, LINEAR, [(0, "sand")])
        found = method.forces(4, "most probable")
        assert_forces(found, (tip + step + ring, 291.5398, 301.5929))
        layers = [clay.Layer(0, *self.of_clay), clay.Layer(2.5, 10e3, 0, 0, 0)]
        both = dnv_beside(clay.Clay(self.skirt, layers))
        found = both.forces(4, "strip")
        np.testing.assert_allclose(found.tip / 1e3, tip + step + 168 * 4.20188, 2e-6)

    def test_houlsby_byrne(self) -> None:
        """Undisturbed ground of 8.829 kN/m3 and 30 degrees, with N_q = 18.4011 and
        N_gamma = 14.754: 26.487 N_q + 8.829 0.05 N_gamma = 493.903 kPa on the step,
        17.658 N_q + 8.829 0.125 N_gamma = 341.209 kPa on the ring. A step outside adds
        to the friction outside."""
        ground = [Layer(0, 8829, 30, 0.5)], (20.0, 20.0), Assumptions()
        plain = houlsby_byrne.method(6, 0.1, *ground).forces(4, UNDISTURBED)
        for flush, areas in (
            ("outer", (1.790708, 4.201880, 0)),
            ("inner", (0, 4.358960, 1.916372)),
        ):
            ledges = ledges_of({**self.scene, "flush_face": flush})
            method = houlsby_byrne.method(6, 0.1, *ground, ledges)
            more = np.array(method.forces(4, UNDISTURBED)) - plain
            tip = 493.903 * areas[0] + 341.209 * areas[1]
            wanted = np.array([tip, 0, 493.903 * areas[2]])
            np.testing.assert_allclose(more / 1e3, wanted, rtol=2e-5, atol=1e-9)


class Heave(Scene):
    """On the page of a scene, and of a run."""

    def test_ring_and_step(self) -> None:
        """A ring at 1.5 m has pi (3.96^2 - 3.71^2) = 6.02400 m2, a step to 80 mm at 1 m
        pi (3.96^2 - 3.92^2) = 0.99023 m2. At 8 m half of the way of the ring, 3.25 m,
        lifts the plug of 49.2652 m2 by 0.39740 m in clay; its 60 mm of steel are
        0.00734 m in sand, and 2 m of clay over it 0.12228 m. The step fills 7 m."""
        ring = dict(zip(("above_tip_m", "width_m", "height_m"), (1.5, 0.25, 0.06)))
        ring = {f"ring_1_{name}": x for name, x in ring.items()}
        step = {"wall_step_1_above_tip_m": 1.0, "wall_step_1_thickness_m": 0.08}
        below = {**SAND, "top_depth_m": 2.0}
        at, no_suction = np.array([8.0]), np.array([-1.0])
        for layers, body, more in (
            ([CLAY], ring, 0.39740),
            ([SAND], ring, 0.00734),
            ([CLAY, below], ring, 0.12228),
            ([SAND], step, 0.14070),
        ):
            plain = TIP / AREA * 4
            run = self.scene(*layers, body=body)
            found = heave_of_wall(run, at, no_suction) - plain
            self.assertAlmostEqual(float(found[0]), more, places=4)
            rest = run.rest or END
            by_tip = TIP / AREA * (0.5 * rest + END - rest)
            self.assertAlmostEqual(float(run.heave_at(at)[0]) - by_tip, more, places=4)
        force = self.scene(CLAY, body=ring).forces_at(at)["total"][0]
        bears = 6.02400 * (8e3 * 6.5 + 8.25 * 40e3) - pi * INNER * 20e3 * 6.5 / 2
        self.assertAlmostEqual(force / (in_clay(8, 8.25) + bears), 1, places=5)
        self.assertIn(
            "Rings and steps of the wall bear as the tip does", self.text(run)
        )


if __name__ == "__main__":
    unittest.main()
