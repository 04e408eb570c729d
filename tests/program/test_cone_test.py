#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""caisson cpt, and scenes of caisson suggest from a cone test."""
import functools
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

from test_suggest import EXAMPLE, SuggestTest

from caisson.plot import draw
from caisson.band import ESTIMATES, member_of
from caisson.commands import round_trip
from caisson.results import read_table
from caisson.runner import Run, read_parameters

# of the round trip: from where the cone is soon as deep as it must be, in less ground
FAST = {
    "Rigid body/Initial penetration": 0.8,
    "Time/Inertia tolerance": 6.4,
    "Grid/Outer radius": 3,
    "Grid/Bottom": -3.5,
    "Grid/Cell width": 0.6,
    "Material points/Per direction in path": 3,
    "Material points/Per direction near": 2,
}


def draw_the_best(directory: Path) -> list[Path]:
    """Draw the best run of a band, and not the two beside it."""
    return draw(directory) if directory.name == "scene" else []


class ConeTests(SuggestTest):
    """Layers that come from a cone test."""

    has_page = True

    def test_layers_of_a_cone_test(self) -> None:
        """The scenes are accepted, with the estimates and where they are from; the cone
        test is beside them, and on the page before any run."""
        path = self.made_directory()
        scene = path / "own.prm"
        words = ["--cpt", str(EXAMPLE), "--tops", "0,3"]
        said = self.suggest(scene, *words, layers=())
        self.assertIn("layer 1 has silt from", said)
        self.assert_without_doubt(said)
        self.assertIn("# FROM CPT (own-cone)", scene.read_text("utf-8"))
        densities = []
        for estimate in ESTIMATES:
            entries = read_parameters([str(member_of(scene, estimate))])
            self.assertEqual(entries["Soil/Layer 2/Top depth"], "3")
            densities.append(float(entries["Soil/Layer 2/Relative density"]))
        self.assertEqual(densities, sorted(set(densities)))
        test = read_table(path / "own_cone.csv")
        self.assertEqual(test["depth_m"][-1], 20)
        page = (path / "own.html").read_text("utf-8")
        self.assertIn("By hand methods, not computed: jacked to", page)
        self.assertNotIn("cone ASSUMED", page)
        study = ["--study", str(path / "own.toml"), "--overwrite"]
        said = self.suggest(scene, *words, *study, layers=(), status=1)
        self.assertIn("run --band", said)
        refused = "either --layer, or a cone test by --cpt, or sand by --sand"
        both, neither = ["--cpt", str(EXAMPLE)], list[str]()
        other = path / "other.prm"
        self.assertIn(refused, self.suggest(other, *both, status=1))
        self.assertIn(refused, self.suggest(other, *neither, status=1, layers=()))

    def test_from_a_cone_test_to_a_report(self) -> None:
        """By one command: a page before any run, and three runs on one page."""
        out = self.made_directory() / "out"
        words = ["--wall", "0.4", "--penetration", "0.53", "--out", str(out), "--run"]
        with mock.patch("caisson.plot.draw", draw_the_best):
            said = self.caisson("cpt", str(EXAMPLE), *words)
        self.assertIn("scene/report.html", said)
        self.assertIn("By hand methods, not computed", (out / "scene.html").read_text())
        with (out / "scene.prm").open("a", encoding="utf-8") as file:
            file.write("# mine\n")
        with mock.patch("caisson.suggest.by_hand", return_value=""):
            refused = self.caisson("cpt", str(EXAMPLE), *words, status=1)
        self.assertRegex(refused, "(?m)^cpt: .*scene.prm exists, and differs")
        self.assertIn("# mine", (out / "scene.prm").read_text("utf-8"))
        page = (out / "scene/report.html").read_text("utf-8")
        for words_of_page in ("DNV", "low to high resistance", "Computed / method"):
            self.assertIn(words_of_page, page)
        self.assertNotIn("cone ASSUMED", page)
        self.assertNotIn("By hand methods", page)
        for name in ("scene", "scene_low", "scene_high"):
            self.assertTrue((out / name / "report.html").is_file())
            self.assertTrue((out / name / "cone.csv").is_file())
        head = (out / "scene/design.csv").read_text("utf-8").splitlines()[0]
        for method in ("houlsby_byrne", "dnv", "senders_randolph", "andersen"):
            self.assertIn(f"{method}_", head)


class RoundTrip(SuggestTest):
    """A cone that is pushed into the ground of a cone test."""

    def test_round_trip(self) -> None:
        """The cone goes in once, and what it met is in a table and a picture; another
        ground has another cone."""
        run = functools.partial(Run, entries=FAST)
        self.enterContext(mock.patch.object(round_trip, "Run", run))
        path, words = self.made_directory(), ["--diameter", "2", "--skirt", "1.17"]
        rows = [
            f"{z:.2f},{1 + 2 * z:.3f},{6 + 12 * z:.2f}" for z in np.arange(0, 2, 0.05)
        ]
        test = path / "test.csv"
        test.write_text("\n".join(["depth_m,qc_MPa,fs_kPa", *rows]), encoding="utf-8")
        words += ["--round-trip", "--out", str(path / "out")]
        first = self.caisson("cpt", str(test), *words)
        self.assertRegex(
            first, r"meets (0\.[89]|1\.[01])\d times the measured resistance"
        )
        self.assertIn("a cone goes into this ground", first)
        for name in ("csv", "png", "prm"):
            self.assertTrue((path / f"out/round_trip.{name}").is_file())
        again = self.caisson("cpt", str(test), *words)
        self.assertNotIn("a cone goes into this ground", again)
        refused = self.caisson("cpt", str(test), *words, "--skirt", "0.4", status=1)
        self.assertIn("fewer layers by --tops", refused)


if __name__ == "__main__":
    unittest.main()
