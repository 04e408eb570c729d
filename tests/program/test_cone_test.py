#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""caisson cpt, and scenes of caisson suggest from a cone test."""
import tomllib
import unittest

import numpy as np

from test_suggest import EXAMPLE, SuggestTest

from caisson.design.expression import value_at
from caisson.runner import read_parameters


class ConeTests(SuggestTest):
    """Layers that come from a cone test."""

    def test_layers_of_a_cone_test(self) -> None:
        """The scene is accepted, with the best estimates and where they are from; the
        study has low, best and high."""
        path = self.made_directory()
        scene, study = path / "own.prm", path / "own_study.toml"
        words = ["--cpt", str(EXAMPLE), "--study", str(study), "--tops", "0,3"]
        said = self.suggest(scene, *words, layers=())
        self.assertIn("layer 1 has silt from", said)
        self.assert_without_doubt(said)
        self.assertIn("# FROM CPT (own-cone)", scene.read_text("utf-8"))
        entries = read_parameters([str(scene)])
        with open(study, "rb") as file:
            content = tomllib.load(file)
        choices = content["parameters"]["soil"]["choices"]
        self.assertEqual(list(choices), ["low", "best", "high"])
        for entry, value in choices["best"].items():
            written, chosen = (
                value_at(str(text), 2.0, 0.0) or 0.0 for text in (entries[entry], value)
            )
            self.assertAlmostEqual(written / chosen, 1, places=2)
        self.assertEqual(entries["Soil/Layer 2/Top depth"], "3")
        self.assertTrue((path / content["cone"]).samefile(EXAMPLE))
        refused = "either --layer, or a cone test by --cpt, or sand by --sand"
        both, neither = ["--cpt", str(EXAMPLE)], list[str]()
        other = path / "other.prm"
        self.assertIn(refused, self.suggest(other, *both, status=1))
        self.assertIn(refused, self.suggest(other, *neither, status=1, layers=()))

    def test_from_a_cone_test_to_a_report(self) -> None:
        """By one command: three runs, all methods, one page."""
        out = self.made_directory() / "out"
        words = ["--wall", "0.4", "--penetration", "0.53", "--out", str(out), "--run"]
        said = self.caisson("cpt", str(EXAMPLE), *words)
        self.assertIn("report.html", said)
        with (out / "scene.prm").open("a", encoding="utf-8") as file:
            file.write("# mine\n")
        refused = self.caisson("cpt", str(EXAMPLE), *words, status=1)
        self.assertRegex(refused, "(?m)^cpt: .*scene.prm exists, and differs")
        self.assertIn("# mine", (out / "scene.prm").read_text("utf-8"))
        page = (out / "report.html").read_text("utf-8")
        for words_of_page in ("own-cone", "DNV", "layer 1 has silt"):
            self.assertIn(words_of_page, page)
        for named in (
            r"Caisson: <b>diameter \S+ m, skirt \S+ m, wall 400 mm; tip to 0.53 m<",
            "Ground: <b>cone test cpt_example.csv<",
            r"Computed: <b>20\d\d-\d\d-\d\d \d\d:\d\d<",
        ):
            self.assertRegex(page, named)
        for name in ("low", "best", "high"):
            run = out / f"study/soil_{name}"
            self.assertTrue((run / "report.html").is_file())
            self.assertIn(f"study/soil_{name}/report.html", page)
            self.assertTrue((run / "cone.csv").is_file())
        head = (out / "study/methods.csv").read_text("utf-8").splitlines()[0]
        self.assertIn("total_force_N [best]", head)
        self.assertIn("_total_N [best]", head)
        for method in ("houlsby_byrne", "dnv", "senders_randolph", "andersen"):
            self.assertIn(f"{method}_", head)

    def test_round_trip(self) -> None:
        """The cone goes in once, and what it met is in a table and a picture; another
        ground has another cone."""
        path, words = self.made_directory(), ["--diameter", "2", "--skirt", "1.25"]
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
