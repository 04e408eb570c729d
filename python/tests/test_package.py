# SPDX-License-Identifier: LGPL-2.1-or-later
"""All modules can be imported, the user's package stands alone, and the checks of the
sources see what they must; `pip install -e .` in a fresh virtual environment, without a
network, and what bash completes of the command line."""
import argparse
import ast
import contextlib
import graphlib
import importlib
import os
import pkgutil
import shlex
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import caisson
import caisson.__main__
import caisson_workshop.__main__
import lab.__main__
from caisson.completion import candidates, SCRIPT
from caisson.paths import ROOT, version
from caisson_workshop.floors import committed, strangers

# command line: its commands
COMMANDS = {
    "scripts/caisson": caisson.__main__.COMMANDS,
    "scripts/lab": lab.__main__.COMMANDS,
    "tools/workshop": caisson_workshop.__main__.COMMANDS,
}
MOST_COMMANDS, MOST_LINES = 12, 30_100  # of the user's package


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


PIP_NEEDS = [
    "CMakeLists.txt",
    "README.md",
    "packaging/build_backend.py",
    "prm/column.prm",
    "pyproject.toml",
]


class Install(unittest.TestCase):
    """A copy of the project, which pip writes into."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.here = Path(temporary.name)
        self.project, self.venv = self.here / "project", self.here / "venv"
        for name in PIP_NEEDS:
            (self.project / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, self.project / name)
        shutil.copytree(ROOT / "python/caisson", self.project / "python/caisson")

    def call(self, *words: str | Path) -> str:
        """Return what a call says; there is no network, and no other package."""
        environment = {**os.environ, "PIP_NO_INDEX": "1", "PIP_CONFIG_FILE": os.devnull}
        for name in ("PYTHONPATH", "PIP_FIND_LINKS"):
            environment.pop(name, None)
        done = subprocess.run(
            list(map(str, words)),
            cwd=self.here,
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout.strip()

    def test_editable(self) -> None:
        """Packages of the system serve, and the command runs in any folder."""
        self.call("/usr/bin/python3", "-m", "venv", "--system-site-packages", self.venv)
        pip = self.venv / "bin/pip"
        self.call(pip, "install", "-e", self.project)
        code = "import caisson; print(caisson.__version__, caisson.__file__)"
        said = self.call(self.venv / "bin/python", "-c", code)
        file = self.project / "python/caisson/__init__.py"
        self.assertEqual(said, f"{version()} {file}")
        said = self.call(self.venv / "bin/caisson", "scenes")
        self.assertIn("a soil column settles under its own weight", said)


CAISSON = ROOT / "scripts/caisson"


class Completion(unittest.TestCase):
    """In a folder with a scene, a table and results."""

    def setUp(self) -> None:
        folder = self.enterContext(tempfile.TemporaryDirectory())
        self.enterContext(contextlib.chdir(folder))
        for name in ("mine.prm", "mine.csv", "notes", "a b.prm"):
            Path(name).touch()
        Path("my_results/jack").mkdir(parents=True)

    def found(self, *words: str) -> list[str]:
        """Return what the last word may become."""
        return candidates(words, caisson.__main__.COMMANDS)

    def in_bash(self, *words: str) -> list[str]:
        """Return what bash finds for a line of words."""
        line = " ".join(map(shlex.quote, [str(CAISSON), *words]))
        code = f"""
            source {shlex.quote(str(SCRIPT))}
            COMP_WORDS=({line}) COMP_CWORD={len(words)}
            _caisson 2>/dev/null
            for word in "${{COMPREPLY[@]}}"; do echo "found: $word"; done"""
        said = subprocess.run(
            ["bash", "-c", code], text=True, capture_output=True, check=True
        ).stdout
        return [line.removeprefix("found: ") for line in said.splitlines()]

    def test_commands(self) -> None:
        self.assertEqual(self.found("re"), ["report"])
        self.assertLessEqual(set(caisson.__main__.COMMANDS), set(self.found("")))
        self.assertEqual(self.found("none", ""), [])

    def test_options(self) -> None:
        self.assertIn("--jobs", self.found("study", "--"))
        self.assertEqual(self.found("run", "--ra"), ["--ranks"])

    def test_files(self) -> None:
        """Those that a command takes, directories, and scenes of the project."""
        self.assertEqual(self.found("run", "m"), ["mine.prm", "my_results"])
        self.assertEqual(self.found("cpt", "mi"), ["mine.csv"])
        self.assertEqual(self.found("plot", "m"), ["my_results"])
        self.assertEqual(self.found("plot", "my_results/"), ["my_results/jack"])
        self.assertIn("jack_coarse.prm", self.found("run", "jack"))

    def test_bash(self) -> None:
        self.assertEqual(self.in_bash("sug"), ["suggest"])
        self.assertEqual(self.in_bash("run", "mi"), ["mine.prm"])
        self.assertEqual(self.in_bash("run", "a"), ["a b.prm"])
        self.assertEqual(self.in_bash("run", "no such"), [])

    def test_script(self) -> None:
        """The command prints it, for those who have no completion installed."""
        done = subprocess.run(
            [CAISSON, "--completion"], text=True, capture_output=True, check=True
        )
        self.assertEqual(done.stdout, SCRIPT.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
