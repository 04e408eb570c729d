# SPDX-License-Identifier: LGPL-2.1-or-later
"""All modules can be imported, the user's package stands alone, and the checks of the
sources see what they must."""
import argparse
import ast
import graphlib
import importlib
import os
import pkgutil
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import caisson
import caisson.__main__
import caisson_workshop.__main__
import lab.__main__
from caisson.paths import ROOT
from caisson_workshop.floors import committed, strangers

# command line: its commands
COMMANDS = {
    "scripts/caisson": caisson.__main__.COMMANDS,
    "scripts/lab": lab.__main__.COMMANDS,
    "tools/workshop": caisson_workshop.__main__.COMMANDS,
}
MOST_COMMANDS, MOST_LINES = 12, 28_661  # of the user's package


# of the package, in the order in which one may import another one
FOLDERS = "design verdict plot error_bars uncertain".split()
FOLDERS += "export report vessel_log suggest commands".split()


FILES = sorted((ROOT / "python/caisson").rglob("*.py"))


def modules() -> list[str]:
    """Return the names of all modules of the packages."""
    packages = (caisson, lab, caisson_workshop)
    names = [
        m.name
        for package in packages
        for m in pkgutil.walk_packages(package.__path__, f"{package.__name__}.")
    ]
    # folders of cases are no packages
    cases = (ROOT / "lab").glob("*/*/*.py")
    names += [".".join(path.relative_to(ROOT).with_suffix("").parts) for path in cases]
    return [name for name in names if not name.endswith("__main__")]


def module_name(path: Path) -> str:
    """Return the name of a module of the product."""
    parts = path.relative_to(ROOT / "python").with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


def floor(module: str) -> int:
    """Return the place of a module in FOLDERS, -1 of the core, and that above all of
    what `import caisson` offers."""
    if module in ("caisson", "caisson.api"):
        return len(FOLDERS)
    folder = (*module.split("."), "")[1]
    return FOLDERS.index(folder) if folder in FOLDERS else -1


def imported(path: Path) -> set[str]:
    """Return the names of all modules that a module imports."""
    names = set[str]()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            for alias in node.names:
                name = f"{node.module}.{alias.name}"
                names.add(name if name in NAMES else str(node.module))
    return names


NAMES = set(map(module_name, FILES))


class TopLevel(unittest.TestCase):
    """What lies beside the sources."""

    def test_strangers(self) -> None:
        found = ["doc/a.md", "comparison.csv", "README.md", "scripts/x", "old/x"]
        self.assertEqual(strangers(found), ["comparison.csv", "old"])
        self.assertEqual(strangers(committed()), [])


class Imports(unittest.TestCase):
    """The packages."""

    def test_all_modules(self) -> None:
        names = modules()
        self.assertGreater(len(names), 100)
        for name in names:
            self.assertTrue(importlib.import_module(name).__doc__, name)

    def test_all_commands(self) -> None:
        """Each adds its options and has a main()."""
        for program, commands in COMMANDS.items():
            for name, (module, _) in commands.items():
                found = importlib.import_module(module)
                found.add_arguments(argparse.ArgumentParser(prog=f"{program} {name}"))
                self.assertTrue(callable(found.main))

    def test_command_lines(self) -> None:
        for program, commands in COMMANDS.items():
            done = subprocess.run(
                [str(ROOT / program), "--help"], text=True, capture_output=True
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            for name in commands:
                self.assertRegex(done.stdout, rf"(?m)^  {name} ")


class Product(unittest.TestCase):
    """The user's package: small, and without laboratory and workshop."""

    def test_imports(self) -> None:
        """No import goes to a folder further on in FOLDERS, and none of the core, which
        is no folder, to any of them, but in the command line."""
        graph = {}
        for path in FILES:
            found = graph[module_name(path)] = imported(path)
            tops = {name.split(".")[0] for name in found}
            self.assertFalse(tops & {"lab", "caisson_workshop"}, path)
            for name in found:
                self.assertLessEqual(floor(name), floor(module_name(path)), path)
        del graph["caisson"]  # loads its modules when their names are used
        tuple(graphlib.TopologicalSorter(graph).static_order())

    def test_folders(self) -> None:
        names = {path.name for path in (ROOT / "python/caisson").iterdir()}
        folders = {n for n in names if "." not in n and n != "__pycache__"}
        self.assertEqual(folders, set(FOLDERS))

    def test_laboratory_needs_no_workshop(self) -> None:
        for path in (ROOT / "lab").rglob("*.py"):
            self.assertNotIn("caisson_workshop", path.read_text(encoding="utf-8"))

    def test_size(self) -> None:
        self.assertLessEqual(len(caisson.__main__.COMMANDS), MOST_COMMANDS)
        lines = sum(len(path.read_bytes().splitlines()) for path in FILES)
        self.assertLessEqual(lines, MOST_LINES)


class CurrentFolder(unittest.TestCase):
    """Nothing is taken from the current folder that the command does not name."""

    def test_nothing_is_imported(self) -> None:
        """Neither modules, by an empty entry of PYTHONPATH too, nor settings."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for module in ("numbers", "csv", "caisson/__init__", "sitecustomize"):
                path = folder / f"{module}.py"
                path.parent.mkdir(exist_ok=True)
                path.write_text("open('RAN', 'w')\\n", encoding="utf-8")
            (folder / "matplotlibrc").write_text("nonsense: 1\\n", encoding="utf-8")
            for command, path_of_python in (
                ("scripts/caisson cpt", ""),
                ("scripts/caisson cpt", ":/nowhere::"),
                ("scripts/lab", "/nowhere:"),
                ("tools/workshop", ":"),
            ):
                done = subprocess.run(
                    f"{ROOT}/{command} --help".split(),
                    cwd=folder,
                    env={**os.environ, "PYTHONPATH": path_of_python},
                    capture_output=True,
                    text=True,
                )
                self.assertEqual((done.returncode, done.stderr), (0, ""), command)
                self.assertFalse((folder / "RAN").exists(), command)


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


if __name__ == "__main__":
    unittest.main()
