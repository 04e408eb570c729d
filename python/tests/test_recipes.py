# SPDX-License-Identifier: LGPL-2.1-or-later
"""The code of the recipes of doc/extending.md for Python does what the page says."""
import re
import tempfile
import types
import unittest
from pathlib import Path
from typing import Any

import numpy as np
from synthetic import write_run
from test_methods import LINEAR, SKIRT, assert_forces

from caisson.paths import ROOT
from caisson.results import Results
from caisson.verdict import theory


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
