# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parameter reference, what the check of the documents finds, and the code of the
recipes of doc/extending.md for Python, which does what the page says."""
import re
import tempfile
import types
import unittest
from pathlib import Path
from typing import Any

import numpy as np
from synthetic import write_run
from test_methods import assert_forces, LINEAR, SKIRT

from caisson.paths import ROOT
from caisson.results import Results
from caisson.verdict import theory
from caisson_workshop.document_names import (
    defaults_of,
    entries_of,
    faults_of,
    too_many_words,
    wrong_defaults,
)
from caisson_workshop.parameter_page import parsed

PRINTED = """
# All entries.
subsection Soil
  # Whether the soil is submerged. Units: none.
  # Allowed: true or false. Default: true
  set Submerged = true
  subsection Layer 1
    # Depth of the *upper* boundary, below the
    # surface. Units: m.
    # Allowed: a number, at least 0. Default: 0
    set Top depth = 0
  end
  subsection Layer 2
    # Depth of the *upper* boundary, below the
    # surface. Units: m.
    # Allowed: a number, at least 0. Default: 0
    set Top depth = 3
  end
end
"""

GOOD = """# Page
`Soil/Submerged` and `Soil/Layer 1/Top depth = 2` are entries of `prm/jack.prm`;
`MaterialPoints` is a class and `MaterialPoints::relocate` a function.

| wall | force |
|---|---|
| 0.1 m | 2 kN |
"""

BAD = (
    """# Page
`Soil/Sumberged` is in `prm/jakc.prm`, `MaterialDots::relocate` has a colour.
"""
    + "This line is long. " * 6
    + "\n\n| wall | force |\n|---|---|\n| 0.1 m | 2 kN |\n\n| 0.2 m | 3 kN |\n"
)


class Parameters(unittest.TestCase):
    """The page that is made of the program's output."""

    def test_entries(self) -> None:
        soil = parsed(PRINTED).sections[0]
        depth = soil.sections[0].entries[0]
        self.assertEqual(depth.name, "Top depth")
        self.assertEqual(depth.units, "m")
        self.assertEqual(depth.default, "0")
        self.assertEqual(depth.allowed, "a number, at least 0")
        self.assertEqual(soil.entries[0].units, "")

    def test_layers_are_shown_once(self) -> None:
        page = parsed(PRINTED).markdown(1)
        self.assertEqual(page.count("Top depth"), 1)
        self.assertIn("### Layer k, with k = 1, 2, ...", page)
        self.assertIn("Depth of the \\*upper\\* boundary, below the surface.", page)

    def test_layers_must_agree(self) -> None:
        with self.assertRaises(SystemExit):
            parsed(PRINTED.replace("depth = 3", "height = 3")).markdown(1)


class Names(unittest.TestCase):
    """What is found in a page."""

    def faults(self, text: str) -> list[str]:
        """The faults of a page with this text."""
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text(text)
            names = {"MaterialPoints", "relocate"}
            return faults_of(page, entries_of(parsed(PRINTED)), names)

    def test_good_page(self) -> None:
        self.assertEqual(self.faults(GOOD), [])

    def test_bad_page(self) -> None:
        found = " ".join(self.faults(BAD))
        for word in "Sumberged jakc.prm MaterialDots colour characters".split():
            self.assertIn(word, found)
        self.assertEqual(len(self.faults(BAD)), 6)
        self.assertIn("a table without heads: | 0.2 m | 3 kN |", found)
        [comment] = self.faults("The error is 3\n% of the force.\n")
        self.assertIn("percent sign: % of the force", comment)

    def test_words(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.md"
            page.write_text("four words\nin all")
            self.assertEqual(too_many_words("it", [page, page], 8), [])
            [fault] = too_many_words("it", [page, page], 7)
            self.assertEqual(fault, "it has 8 words, at most 7")


class Defaults(unittest.TestCase):
    """Numbers of a page that the program decides."""

    def faults(self, text: str, name: str = "page.md") -> list[str]:
        """What is wrong with the defaults that a page states."""
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / name
            page.write_text(text)
            return wrong_defaults(page, defaults_of(parsed(PRINTED)))

    def test_stated_default(self) -> None:
        text = "`Soil/Submerged` is `true` by default, `Soil/Layer 1/Top depth` is\n"
        self.assertEqual(self.faults(text + "0 by default."), [])
        [fault] = self.faults(text + "0.5 by default.")
        self.assertIn("Top depth is 0 by default, not 0.5", fault)
        [fault] = self.faults("`Soil/Depth` is 2 by default.")
        self.assertIn("no entry", fault)

    def test_glossary(self) -> None:
        """A number without its entry cannot be checked, and is not let through."""
        for text in ("A cell is full from 50 % on.", "Dry soil is the default."):
            self.assertEqual(self.faults(text), [])
            self.assertEqual(len(self.faults(text, "glossary.md")), 1)
        text = "`Soil/Submerged` is `true` by default."
        self.assertEqual(self.faults(text, "glossary.md"), [])


def code_of(file: str) -> str:
    """Return the code that the page has for a file of the package."""
    page = (ROOT / "doc/extending.md").read_text(encoding="utf-8")
    pattern = rf"^```python\n# python/caisson/{re.escape(file)}\n(.*?)^```"
    (code,) = re.findall(pattern, page, re.M | re.S)
    return str(code)


def module_of(file: str, names: dict[str, Any] = {}) -> Any:
    """Return a module with this code, which may use names."""
    module = types.ModuleType(Path(file).stem)
    module.__dict__.update(names)
    exec(compile(code_of(file), file, "exec"), module.__dict__)
    return module


class Recipes(unittest.TestCase):
    """What can be taken into the package as it stands."""

    def test_method(self) -> None:
        """0.5 8 MPa 1.853540 m2; 0.002 16 MN/m on pi 5.8 m and on pi 6 m."""
        module = module_of("design/two_numbers.py")
        assert_forces(
            module.method(SKIRT, LINEAR).forces(4, "high"),
            (7414.159, 583.0796, 603.1858),
        )
        names = {**vars(theory), "two_numbers": module}
        found = module_of("verdict/theory.py", names).TWO_NUMBERS
        self.assertEqual(found.all_cases, ("low", "high"))
        with self.assertRaises(theory.NotApplicable):
            found.of_site(theory.Site({}), 1.0)

    def test_picture(self) -> None:
        draw = module_of("plot/energy.py").draw
        depth = np.linspace(0, 1, 20)
        columns = {"time_s": depth, "penetration_m": depth}
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder)
            write_run(path, columns, {})
            self.assertIsNone(draw(path / "energy.png", Results(path)))
            write_run(path, {**columns, "energy_residual": 1e-3 * depth}, {})
            picture = draw(path / "energy.png", Results(path))
            self.assertGreater(picture.stat().st_size, 1000)


if __name__ == "__main__":
    unittest.main()
