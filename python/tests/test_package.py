# SPDX-License-Identifier: LGPL-2.1-or-later
"""All modules can be imported, and the checks of the sources see what they must."""
import argparse
import importlib
import os
import pkgutil
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import caisson
from caisson.__main__ import COMMANDS
from caisson.paths import ROOT
from caisson_workshop.lengths import cpp_functions

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
            found.add_arguments(argparse.ArgumentParser(prog=f"caisson {name}"))
            self.assertTrue(callable(found.main))

    def test_command_line(self) -> None:
        done = subprocess.run(
            [str(ROOT / "scripts/caisson"), "--help"], text=True, capture_output=True
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in COMMANDS:
            self.assertIn(name, done.stdout)


class Command(unittest.TestCase):
    """scripts/caisson, beside scripts that only say their names."""

    def called(self, command: str, program: str) -> list[str]:
        """Return what is called for a command, with CAISSON_MPM_PROGRAM set so."""
        with tempfile.TemporaryDirectory() as folder:
            scripts, package = Path(folder, "scripts"), Path(folder, "python/caisson")
            scripts.mkdir()
            package.mkdir(parents=True)
            shutil.copy(ROOT / "scripts/caisson", scripts)
            for name in ("setup", "build"):
                (scripts / name).write_text(f"#!/bin/sh\necho {name} $*\n", "utf-8")
                (scripts / name).chmod(0o755)
            (package / "__init__.py").touch()
            (package / "__main__.py").write_text("print('package')\n", "utf-8")
            return subprocess.run(
                [scripts / "caisson", command],
                cwd=folder,  # whose package comes first
                env={**os.environ, "CAISSON_MPM_PROGRAM": program},
                text=True,
                stdout=subprocess.PIPE,
                check=True,
            ).stdout.splitlines()

    def test_what_is_missing_is_made(self) -> None:
        """No program is built where another one is named, nor before it is known that
        nothing else is missing."""
        made = ["setup --check build pictures", "build", "package"]
        self.assertEqual(self.called("study", ""), made)
        self.assertEqual(self.called("study", "/bin/true"), ["package"])
        self.assertEqual(self.called("report", ""), ["package"])
        self.assertEqual(self.called("scenes", ""), ["package"])


class Lengths(unittest.TestCase):
    """Functions of C++ are found."""

    def test_cpp_functions(self) -> None:
        found = list(cpp_functions(CPP))
        self.assertEqual(found, [("S", 6, 12), ("operator==", 18, 22)])


if __name__ == "__main__":
    unittest.main()
