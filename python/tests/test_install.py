# SPDX-License-Identifier: LGPL-2.1-or-later
"""`pip install -e .` in a fresh virtual environment, without a network."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from caisson.paths import ROOT, version

FILES = [
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
        for name in FILES:
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


if __name__ == "__main__":
    unittest.main()
