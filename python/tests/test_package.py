# SPDX-License-Identifier: LGPL-2.1-or-later
"""All modules can be imported, and the checks of the sources see what they must."""
import argparse
import importlib
import pkgutil
import subprocess
import unittest

import caisson
from caisson.__main__ import COMMANDS
from caisson.developer.lengths import cpp_functions
from caisson.paths import ROOT

CPP = """
namespace N
{
  struct S
  {
    S(int a)
      : b(a)
    {
      // a comment with { and "
      if (a)
        { b = '{'; }
    }
    std::vector<int> list = {f(1), 2};
  };

  template <typename T = S<int>>
  bool
  operator==(const S &a,
             const S &b)
  {
    return [&] { return "}"; }();
  }
} // namespace N
"""


class Imports(unittest.TestCase):
    """The package."""

    def test_all_modules(self) -> None:
        names = [m.name for m in pkgutil.walk_packages(caisson.__path__, "caisson.")]
        self.assertGreater(len(names), 20)
        for name in names:
            if not name.endswith("__main__"):
                self.assertTrue(importlib.import_module(name).__doc__, name)

    def test_all_commands(self) -> None:
        """Each declares its options and has a main()."""
        for name, (module, _) in COMMANDS.items():
            found = importlib.import_module(module)
            found.declare(argparse.ArgumentParser(prog=f"caisson {name}"))
            self.assertTrue(callable(found.main))

    def test_command_line(self) -> None:
        done = subprocess.run(
            [str(ROOT / "scripts/caisson"), "--help"], text=True, capture_output=True
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in COMMANDS:
            self.assertIn(name, done.stdout)


class Lengths(unittest.TestCase):
    """Functions of C++ are found."""

    def test_cpp_functions(self) -> None:
        found = list(cpp_functions(CPP))
        self.assertEqual(found, [("S", 6, 12), ("operator==", 18, 22)])


if __name__ == "__main__":
    unittest.main()
