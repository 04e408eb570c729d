# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which design methods answer in a scene, and why the others do not."""
import unittest
from math import nan
from pathlib import Path
from typing import Any

import numpy as np

from caisson.verdict import suction_methods, theory
from caisson.results import Read
from caisson.design.cone import Profile

LINEAR = Profile([0, 10], [0, 20e6])  # 2 MPa per meter
SCENE: dict[str, Any] = {
    "diameter_m": 6,
    "wall_thickness_m": 0.2,
    "inner_wall_friction_angle_deg": 20,
    "outer_wall_friction_angle_deg": 20,
}
LAYER: dict[str, Any] = {
    "top_depth_m": 0,
    "law": "Mohr-Coulomb",
    "submerged_unit_weight_N_m3": 8829,
    "friction_angle_deg": 30,
    "cohesion_Pa": 0,
    "K0": 0.5,
}
CLAY: dict[str, Any] = {**LAYER, "friction_angle_deg": 0, "cohesion_Pa": 20e3}


NOT_CLAY = "layer 1 is sand, and the method is for clay"


class Applicability(unittest.TestCase):
    """Answers in the scene of run.json."""

    def site(self, *layers: dict[str, Any], level: str = "drained") -> theory.Site:
        """Return a site with a cone test."""
        return theory.Site({**SCENE, "layers": list(layers)}, level, LINEAR)

    def why(self, site: theory.Site, deepest: float = 2) -> list[str]:
        """Return why each method says nothing; "" where it answers."""
        answers = theory.answers_to(site, deepest)
        for answer in answers:
            self.assertEqual(bool(answer.forces), not answer.why_not)
        return [answer.why_not for answer in answers]

    def test_sand(self) -> None:
        self.assertEqual(self.why(self.site(LAYER)), [""] * 5 + [NOT_CLAY])
        without = self.site(LAYER)._replace(cone=None)
        self.assertEqual(self.why(without), [""] * 5 + [NOT_CLAY])
        for answer in theory.answers_to(without, 2)[:5]:
            marked = answer.method.key != "houlsby_byrne"
            self.assertEqual("ASSUMED" in answer.name, marked)
        for answer in theory.answers_to(self.site(LAYER), 2):
            self.assertNotIn("ASSUMED", answer.name)

    def test_no_cone_is_assumed(self) -> None:
        """Of clay above or below sand, of sand whose density is not known, or of soil
        without numbers."""
        clay = {**CLAY, "top_depth_m": 1}
        unknown = {**LAYER, "law": "hypoplastic sand with intergranular strain"}
        bare = {k: v for k, v in LAYER.items() if not k.startswith("submerged")}
        for layers, words in (
            ((LAYER, clay), "none is assumed: layer 2 is clay"),
            ((unknown,), f"none is assumed: layer 1 is {unknown['law']}, and run.json"),
            (
                (Read(Path("run.json"), bare),),
                "run.json has no submerged_unit_weight_N_m3",
            ),
        ):
            site = self.site(*layers)._replace(cone=None)
            self.assertIn(words, self.why(site)[1])
        # the tip does not reach the clay
        shallow = self.site(LAYER, clay)._replace(cone=None)
        self.assertEqual(self.why(shallow, 0.9), [""] * 5 + [NOT_CLAY])

    def test_clay(self) -> None:
        """Its strength answers, and DNV has coefficients, undrained or not."""
        for level in ("drained", "undrained", "coupled"):
            byrne, *others = self.why(self.site(CLAY, level=level))
            self.assertIn("layer 1 has no friction angle", byrne)
            only = "layer 1 is clay, and the method is for sand"
            self.assertEqual(others, ["", only, only, only, ""])

    def test_forces_in_clay(self) -> None:
        """In two layers; the second has an adhesion of its own, the first the
        body's."""
        soft = {**CLAY, "cohesion_Pa": 10e3}
        stiff = {**CLAY, "layer": 7, "top_depth_m": 1.5, "wall_adhesion_Pa": 5e3}
        scene = {**SCENE, "layers": [soft, stiff], "outer_wall_adhesion_Pa": 2e3}
        answer = theory.answers_of(theory.Site(scene), np.array([1.0, 3.0]))[-1]
        tip, inner, outer = [answer.band(part) for part in theory.PARTS[:3]]
        area = np.pi * 5.8 * 0.2
        for n_c, found in zip((7.5, 9.0), tip):
            expected = [area * (8829 * h + n_c * s) for h, s in ((1, 10e3), (3, 20e3))]
            np.testing.assert_allclose(found, expected)
        np.testing.assert_allclose(inner[0], [0, np.pi * 5.6 * 7.5e3])
        np.testing.assert_allclose(outer[0], [np.pi * 6 * 2e3, np.pi * 6 * 10.5e3])

    def test_sand_and_clay(self) -> None:
        """The method of clay takes sand from a cone that is given or assumed; below
        clay the cone feels its weight. Clay and sand far below limit the suction, and
        soil that nobody knows there does not."""
        below: dict[str, Any] = {**LAYER, "top_depth_m": 3, "relative_density": 0.8}
        layers = LAYER, {**CLAY, "top_depth_m": 1}, below
        site = self.site(*layers)
        for known, name in (
            (site, "Strength of clay, DNV in sand"),
            (site._replace(cone=None), "Strength of clay, DNV in sand (cone ASSUMED)"),
        ):
            answer = theory.answer_of(theory.OF_CLAY, known, np.array([2.0, 4.0]))
            self.assertEqual((answer.name, answer.why_not), (name, ""))
        stress = 8829 * 4 * 2 / 3
        cone = 2.494e6 * (stress / 1e5) ** 0.46 * np.exp(2.96 * 0.8)
        tip = answer.forces["strip"]["tip"] / np.pi / 5.8 / 0.2
        np.testing.assert_allclose(tip, [8829 * 2 + 7.5 * 20e3, 0.3 * cone], rtol=1e-3)
        self.assertNotIn("from 1 m", answer.assumed)
        at = np.array([2.0])
        for bottom, n in ((below, 2), ({**below, "law": "linear elastic"}, 1)):
            found = suction_methods.plug_limits(self.site(*layers[:2], bottom), at)
            self.assertEqual(len(found), n)
        self.assertEqual(suction_methods.plug_limits(self.site(LAYER), at), {})
        self.assertEqual(suction_methods.plug_limits(theory.Site({}), at), {})

    def test_undrained_sand(self) -> None:
        for found in self.why(self.site(LAYER, level="undrained")):
            self.assertIn("the run is undrained", found)

    def test_hypoplastic_sand(self) -> None:
        """A cone answers for it; it has no single friction angle, unless its density
        gives one."""
        for law in theory.BY_DENSITY:
            byrne, *others = self.why(self.site({**LAYER, "law": law}))
            self.assertIn(f"{law}, and run.json has no density", byrne)
            self.assertEqual(others, [""] * 4 + [NOT_CLAY])
            dense = {**LAYER, "law": law, "relative_density": 0.85}
            site = self.site(dense)._replace(cone=None)
            self.assertEqual(self.why(site), [""] * 5 + [NOT_CLAY])
            self.assertIn("friction angle ASSUMED", theory.about_cone(site, 2))

    def test_friction_angle_by_density(self) -> None:
        """phi = 30 + 3 (0.8 (10 - ln sqrt(q_c sigma'_v)) - 1) in the middle of pieces
        of 0.25 m, whatever the depth that is asked for; in the second layer sigma'_v
        is that of both."""
        dense: dict[str, Any] = {**LAYER, "law": theory.BY_DENSITY[0]}
        dense["relative_density"] = 0.8
        below = {**dense, "top_depth_m": 1.1, "submerged_unit_weight_N_m3": 11e3}
        site = self.site(dense, below)
        found = theory.layers_of(site, 2)
        self.assertEqual(found, theory.layers_of(site, 2.1)[: len(found)])
        tops = [0, 0.25, 0.5, 0.75, 1, 1.1, 1.35, 1.6, 1.85]
        np.testing.assert_allclose([layer.top for layer in found], tops)
        stress = 8829 * 1.1 + 11e3 * 0.375  # at 1.475 m
        cone = 2.494e6 * (stress * 2 / 3 / 1e5) ** 0.46 * np.exp(2.96 * 0.8)
        angle = 30 + 3 * (0.8 * (10 - np.log(np.sqrt(cone * stress) / 1e3)) - 1)
        self.assertAlmostEqual(found[6].friction_angle, angle, places=9)
        self.assertEqual(found[6].unit_weight, 11e3)

    def test_soils_that_nobody_knows(self) -> None:
        changes: list[tuple[dict[str, Any], str]] = [
            ({"cohesion_Pa": 5e3}, "cohesion"),
            ({"law": "linear elastic"}, "elastic"),
            ({"friction_angle_deg": 0}, "no"),
        ]
        for change, words in changes:
            for found in self.why(self.site({**LAYER, **change})):
                self.assertIn(words, found)
        clay: dict[str, Any] = {**LAYER, "cohesion_Pa": 5e3}
        clay.update(law=theory.ANISOTROPIC, friction_angle_deg=None)
        self.assertEqual(theory.soil_of(clay, 1), "clay")

    def test_layers_that_the_tip_does_not_reach(self) -> None:
        site = self.site(LAYER, {**CLAY, "top_depth_m": 3})
        self.assertEqual(self.why(site, 2.9), [""] * 5 + [NOT_CLAY])
        found = self.why(site, 3.1)
        self.assertEqual([found[i] for i in (0, 1, 2, 5)], [""] * 4)
        self.assertIn("layer 2 is clay, and the method is for sand", found[3])

    def test_bodies(self) -> None:
        """A cone or a cylinder is no caisson; a run that continues does not say."""
        found = theory.answers_to(theory.Site({}, cone=LINEAR), 2)
        self.assertEqual(
            theory.reasons(found),
            [(", ".join(m.name for m in theory.METHODS), "the body is no caisson")],
        )
        running = theory.Site({}, is_running=True)
        self.assertIn("no run.json", self.why(running)[0])

    def test_layers_of_sand(self) -> None:
        """The tip of Houlsby and Byrne is in the stronger layer from 1 m on."""
        strong = {**LAYER, "top_depth_m": 1, "friction_angle_deg": 40}
        answer = theory.answers_to(self.site(LAYER, strong), 2)[0]
        low, high = answer.band("tip")
        bound = answer.forces["undisturbed"]["tip"]
        self.assertTrue((bound <= low).all() and (low <= high).all())
        self.assertGreater(low[-1], 3 * low[45])

    def test_range_is_not_that_of_undisturbed_ground(self) -> None:
        """Houlsby & Byrne back-figured K tan(delta) = 0.45 to 0.8; undisturbed ground
        has 0.5 tan(20) = 0.182. Without enhancement at 1 m: 8829 / 2 pi 6 N each."""
        plain = {"design_methods": {"load_spread": None}}
        site = self.site(LAYER)
        site = site._replace(scene={**site.scene, **plain})
        answer = theory.answers_of(site, np.array([1.0]))[0]
        low, high = answer.band("outer friction")
        bound = answer.forces["undisturbed"]["outer friction"]
        per_k = 8829 / 2 * np.pi * 6
        for found, k in ((low, 0.45), (high, 0.8), (bound, 0.1819851)):
            self.assertAlmostEqual(float(found[0]) / per_k, k, places=6)
        enhanced = theory.answers_of(self.site(LAYER), np.array([1.0]))[0]
        self.assertGreater(enhanced.band("total")[0][0], answer.band("total")[0][0])

    def test_entries_of_a_newer_program(self) -> None:
        """What is not known is left out, and what is missing is the default."""
        assumed = theory.assumptions_of(
            {"design_methods": {"load_spread": 2, "unknown": 1}}
        )
        self.assertEqual(assumed, theory.Assumptions(load_spread=2))
        self.assertEqual(theory.assumptions_of({}), theory.Assumptions())

    def test_file_without_layers(self) -> None:
        old = theory.Site({**SCENE, **LAYER, "wall_friction_angle_deg": 20})
        a, b = [theory.answers_to(s, 2)[0] for s in (old, self.site(LAYER))]
        np.testing.assert_array_equal(a.band("tip"), b.band("tip"))

    def test_walls_of_layers(self) -> None:
        """A layer may have the friction of the walls, and the body none, in all of the
        methods that have it."""
        own = {**LAYER, "wall_friction_angle_deg": 20}
        bare = {f"{side}_wall_friction_angle_deg": 0 for side in ("inner", "outer")}
        site = self.site(own)
        smooth = site._replace(scene={**site.scene, **bare})
        for a, b in zip(*(theory.answers_to(s, 2) for s in (smooth, self.site(LAYER)))):
            for part in theory.PARTS if a.forces else ():
                np.testing.assert_allclose(a.band(part), b.band(part))
        found = theory.wall_angles_at(smooth, "inner", np.array([0.0, 2.0]))
        np.testing.assert_array_equal(found, [20, 20])

    def test_end_of_the_cone_test(self) -> None:
        """It ends at 10 m."""
        site = self.site(LAYER)
        self.assertEqual(theory.about_cone(site, 10), "")
        self.assertIn("ends at 10 m", theory.about_cone(site, 10.1))
        last = theory.answers_of(site, np.array([10.0, 10.1]))[1].band("total")[0]
        self.assertGreater(last[0], 0)
        np.testing.assert_equal(last[1], nan)


if __name__ == "__main__":
    unittest.main()
