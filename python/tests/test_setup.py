# SPDX-License-Identifier: LGPL-2.1-or-later
"""scripts/setup never removes a package, repeats what apt said, and is the only script
that calls apt; modules that can be imported count, whichever package brings them."""
import ast
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from caisson import needed
from caisson.paths import ROOT

PARAVIEW, VTK = "python3-paraview", "python3-vtk9"
# apt and dpkg on a system whose packages are the lines of a file; the two above exclude
# each other, and FAILURE is what apt ends with
APT = f"""#!/usr/bin/env bash
echo "$*" >>"$SYSTEM/apt"
case "$*" in
  update) exit 0 ;;
  *{VTK}*)
    if grep -qx {PARAVIEW} "$SYSTEM/packages"; then
      case "$*" in
        *--simulate*) echo "Remv {PARAVIEW} [5.11]"; exit 0 ;;
        *--no-remove*)
          echo "E: Packages need to be removed but remove is disabled." >&2
          exit 100 ;;
      esac
      sed -i /{PARAVIEW}/d "$SYSTEM/packages"
    fi ;;
esac
[ -z "${{FAILURE:-}}" ] || {{ echo "$FAILURE" >&2; exit 100; }}
for word in "$@"; do [[ $word == -* ]] || echo "$word" >>"$SYSTEM/packages"; done
"""
DPKG_QUERY = """#!/usr/bin/env bash
grep -qx -- "${!#}" "$SYSTEM/packages" && echo -n installed
"""
# in the place of caisson.needed: the packages of $LACKS that are not installed
NEEDED = """
import os
packages = open(os.environ["SYSTEM"] + "/packages").read().split()
for name in os.environ["LACKS"].split():
    if name not in packages:
        print(name)
"""
LOCK = (
    "E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 1 (apt)\n"
    "N: Be aware that removing the lock file is not a solution\n"
    "E: Unable to acquire the dpkg frontend lock, is another process using it?"
)
# scripts, and the group of which they say that it is missing
OTHERS = {
    "scripts/build": "build",
    "scripts/caisson suggest": "build",
    "scripts/caisson study": "build",
    "scripts/lab verify": "build pictures",
    "tools/docs": "docs",
    "tools/package": "build docs package",
    "tools/caisson_workshop/sanitize.sh": "build pictures",
}


class Setup(unittest.TestCase):
    """A copy of the scripts on a synthetic system."""

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.system = Path(temporary.name)
        self.packages, self.apt = self.system / "packages", self.system / "apt"
        self.root = self.system / "project"
        for folder in ("scripts", "tools"):
            shutil.copytree(ROOT / folder, self.root / folder)
        package = self.root / "python/caisson"
        package.mkdir(parents=True)
        (package / "__init__.py").touch()
        (package / "needed.py").write_text(NEEDED, encoding="utf-8")
        (self.root / "CMakeLists.txt").touch()
        tools = self.system / "bin"
        tools.mkdir()
        for name, text in {
            "apt-get": APT,
            "dpkg-query": DPKG_QUERY,
            "id": "#!/bin/sh\necho 0\n",  # root
        }.items():
            (tools / name).write_text(text, encoding="utf-8")
            (tools / name).chmod(0o755)

    def call(
        self, words: str, packages: str = "", lacks: str = "", failure: str = ""
    ) -> "subprocess.CompletedProcess[str]":
        """Call a script on a system with these packages."""
        self.packages.write_text("\n".join(packages.split()) + "\n", encoding="utf-8")
        self.apt.write_text("", encoding="utf-8")
        name, *options = words.split()
        script = name if "/" in name else f"scripts/{name}"
        return subprocess.run(
            [str(self.root / script), *options],
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env={
                "PATH": f"{self.system / 'bin'}:/usr/bin:/bin",
                "SYSTEM": str(self.system),
                "LACKS": lacks,
                "FAILURE": failure,
            },
        )

    def installed(self) -> list[str]:
        """Return the packages of the system."""
        return self.packages.read_text(encoding="utf-8").split()

    def test_nothing_is_missing(self) -> None:
        """Where ParaView brings the modules, apt has nothing to do."""
        done = self.call("setup pictures", PARAVIEW)
        self.assertEqual((done.returncode, done.stdout), (0, ""))
        self.assertEqual(self.apt.read_text(encoding="utf-8"), "")

    def test_what_is_missing_is_installed(self) -> None:
        done = self.call("setup pictures", lacks=f"python3-numpy {VTK}")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(
            {"python3-numpy", VTK} - {*self.installed()}, set(), done.stdout
        )

    def test_no_package_is_removed(self) -> None:
        """What excludes one is not installed, and both are named."""
        done = self.call("setup pictures", PARAVIEW, lacks=VTK)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertEqual(self.installed(), [PARAVIEW])
        self.assertIn(f"could not install {VTK}", done.stdout)
        self.assertIn(f"exclude {PARAVIEW} of yours", done.stdout)
        self.assertNotIn("network", done.stdout)

    def test_a_lock_is_a_lock(self) -> None:
        done = self.call("setup build", failure=LOCK)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"{LOCK.splitlines()[-1]}\n", done.stdout.split("setup: ")[-2])
        self.assertIn("another program installs packages", done.stdout)
        self.assertNotIn("network", done.stdout)

    def test_no_network(self) -> None:
        for failure in (
            "E: Unable to fetch some archives, maybe run apt-get update",
            "E: Unable to locate package libdeal.ii-dev",
        ):
            with self.subTest(failure=failure):
                done = self.call("setup build", failure=failure)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertIn(failure, done.stdout.split("setup: ")[-2])
                self.assertIn("is there a network?", done.stdout)

    def test_others_only_say_what_is_missing(self) -> None:
        """In one line, with the command that installs it, before they do anything."""
        for words, groups in OTHERS.items():
            with self.subTest(words=words):
                done = self.call(words, lacks=VTK)
                self.assertEqual(done.returncode, 1, done.stdout)
                self.assertEqual(len(done.stdout.splitlines()), 1, done.stdout)
                self.assertRegex(done.stdout, rf"`scripts/setup {groups}\b")
                self.assertEqual(self.apt.read_text(encoding="utf-8"), "")

    def test_run_installs_before_it_builds(self) -> None:
        """A system that cannot have the libraries of pictures still runs scenes."""
        for name in ("build", "caisson"):
            script = self.root / "scripts" / name
            script.write_text(f'#!/bin/sh\necho "{name} $*" >>$SYSTEM/apt\n', "utf-8")
        scene = self.root / "a.prm"
        scene.touch()
        for packages in ("", PARAVIEW):
            with self.subTest(packages=packages):
                done = self.call(f"run {scene}", packages, lacks=VTK)
                self.assertEqual(done.returncode, 0, done.stdout)
                called = self.apt.read_text(encoding="utf-8").splitlines()
                self.assertEqual(called[-2:], ["build ", f"caisson run {scene}"])
                for line in called[:-2]:
                    self.assertRegex(line, "^update|--no-remove|--simulate")

    def test_copied_build_folder(self) -> None:
        """A build folder that cmake made elsewhere is configured anew."""
        cmake = self.system / "bin/cmake"
        cmake.write_text("#!/bin/sh\n", encoding="utf-8")
        cmake.chmod(0o755)
        build = self.root / "build/release"
        build.mkdir(parents=True)
        cache = build / "CMakeCache.txt"
        text = "CMAKE_CACHEFILE_DIR:INTERNAL={}\nCMAKE_HOME_DIRECTORY:INTERNAL={}\n"
        packages = "libdeal.ii-dev g++ cmake ninja-build nlohmann-json3-dev python3"
        for home, place, is_own in (
            (self.root, build, True),
            ("/elsewhere/project", build, False),
            (self.root, "/elsewhere/build", False),
        ):
            cache.write_text(text.format(place, home), encoding="utf-8")
            done = self.call("build", packages)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertEqual(cache.exists(), is_own)
            self.assertEqual("configured anew" not in done.stdout, is_own, done.stdout)


class Needed(unittest.TestCase):
    """caisson.needed, in a Python without the packages of Debian."""

    def missing(self, *modules: str) -> list[str]:
        """Return the packages that are missing where only these modules are there."""
        with tempfile.TemporaryDirectory() as folder:
            for module in modules:
                path = Path(folder, *module.split(".")).with_suffix(".py")
                path.parent.mkdir(parents=True, exist_ok=True)
                path.touch()
            return subprocess.run(
                [sys.executable, "-S", "-B", "-m", "caisson.needed"],
                env={**os.environ, "PYTHONPATH": f"{ROOT / 'python'}:{folder}"},
                text=True,
                capture_output=True,
                check=True,
            ).stdout.split()

    def test_modules_count(self) -> None:
        """A module that is there asks for no package, and one of two is not enough."""
        self.assertIn(VTK, self.missing())
        modules = [m for m, package in needed.MODULES.items() if package == VTK]
        self.assertIn(VTK, self.missing(modules[0]))
        self.assertNotIn(VTK, self.missing(*modules))
        self.assertEqual(
            {*self.missing(*needed.MODULES)} & {*needed.MODULES.values()}, set()
        )

    def test_all_imports_are_known(self) -> None:
        """Each library that the package imports is looked for."""
        modules = [*needed.MODULES, *needed.TABLES, *needed.WORKBOOKS]
        modules += [*needed.SURFACES, *needed.DASK]
        known = {module.split(".")[0] for module in modules}
        others = ("design", "error", "export", "report")
        own = {"caisson", *(f"caisson_{name}" for name in others)}
        for path in (p for name in own for p in (ROOT / "python" / name).rglob("*.py")):
            found = set()
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Import):
                    found |= {alias.name.split(".")[0] for alias in node.names}
                elif isinstance(node, ast.ImportFrom) and node.module:
                    found.add(node.module.split(".")[0])
            libraries = found - sys.stdlib_module_names - own
            self.assertEqual(libraries - known, set(), path)

    def test_packages_of_an_installation(self) -> None:
        """The Debian package depends on all of them, and accepts ParaView's VTK."""
        control = ROOT / "packaging/debian/control"
        text = control.read_text(encoding="utf-8").split("Package: caisson-mpm\n")[1]
        depends = re.split(r",\s+", text.split("Depends: ")[1].split("\nSuggests")[0])
        names = {part.split()[0] for part in depends}
        every = needed.MODULES, needed.WORKBOOKS, needed.SURFACES, needed.SCRIPTS
        brought = {package for some in every for package in some.values()}
        self.assertEqual(brought - names, set())
        self.assertIn(f"{VTK} | {PARAVIEW}", depends)

    def test_commands_say_it_at_once(self) -> None:
        """In one line, before they look at what they were given."""
        for words in ("report nowhere", "plot nowhere", "cpt nowhere", "suggest a"):
            with self.subTest(words=words):
                done = subprocess.run(
                    [sys.executable, "-S", "-B", "-m", "caisson", *words.split()],
                    env={**os.environ, "PYTHONPATH": str(ROOT / "python")},
                    text=True,
                    capture_output=True,
                )
                self.assertEqual(done.returncode, 1)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn("`scripts/setup pictures`", done.stderr)


class Sources(unittest.TestCase):
    """What is written in scripts and in the package."""

    def test_no_remove(self) -> None:
        """Wherever apt is not asked about, it may not remove."""
        files = [
            path
            for folder in ("scripts", "tools", "python", "lab")
            for path in (ROOT / folder).rglob("*")
            if path.suffix in ("", ".py", ".sh")
        ]
        found = 0
        for path in files:
            if path == Path(__file__).resolve() or not path.is_file():
                continue
            for line in path.read_text(encoding="utf-8").splitlines():
                if "apt-get" in line and "--yes" in line:
                    found += 1
                    self.assertIn("--no-remove", line, path)
        self.assertGreater(found, 1)


if __name__ == "__main__":
    unittest.main()
