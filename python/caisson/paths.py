# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the parts of the project are: in its folder, or where `cmake --install` has
put them, which is PREFIX/bin for the programs and PREFIX/share/caisson_mpm for this
package and the scenes. An installation may be read-only."""
import importlib.metadata
import os
import shutil
import tomllib
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
INSTALLED = not (ROOT / "CMakeLists.txt").is_file()
SCENES = ROOT / "prm"
BUILD = ROOT / "build/release"
# where runs start and results go if nothing else is said
WORK = Path.cwd() if INSTALLED else ROOT
RESULTS = WORK / "results"
PICTURES = ROOT / "doc/pictures"


def find_program() -> Path:
    """Return the program: that of CAISSON_MPM_PROGRAM, that of the build or of the
    installation, or one on PATH. Without any, where the second one would be."""
    if named := os.environ.get("CAISSON_MPM_PROGRAM"):
        return Path(shutil.which(named) or named)
    own = (ROOT.parent.parent / "bin" if INSTALLED else BUILD) / "caisson_mpm"
    on_path = None if own.is_file() else shutil.which("caisson_mpm")
    return Path(on_path) if on_path else own


PROGRAM = find_program()


def version() -> str:
    """Return the version of the project: pyproject.toml has it, also that of an
    installation."""
    file = ROOT / "pyproject.toml"
    if file.is_file():
        project = tomllib.loads(file.read_text(encoding="utf-8"))["project"]
        return str(project["version"])
    return importlib.metadata.version("caisson-mpm")


def short(path: Path) -> str:
    """Return the path as seen from the project's folder, or from that of the results
    of an installation, if it lies there."""
    path = path.resolve()
    for folder in (ROOT, WORK):
        if path.is_relative_to(folder):
            return str(path.relative_to(folder))
    return str(path)


def without_user(path: Path) -> str:
    """Return the path as short() has it, and only the last name of one elsewhere."""
    found = short(path)
    return path.resolve().name if Path(found).is_absolute() else found


def seen(path: Path) -> str:
    """Return the path from the current folder, or the whole one where it is shorter."""
    return min(os.path.relpath(path), str(path.resolve()), key=len)


def distinct_ends(parts: Sequence[Sequence[str]]) -> list[str]:
    """Return the last part of each name, or as many parts as distinguish it."""
    names = list[str]()
    for length in range(1, max(map(len, parts)) + 1):
        names = ["/".join(part[-length:]) for part in parts]
        if len(set(names)) == len(names):
            break
    return names


def scene_or_study(name: str) -> Path:
    """Return the file of this name, or that of the project where there is none here:
    jack.prm and prm/jack.prm both name prm/jack.prm of the project."""
    for path in (Path(name), SCENES / name, SCENES.parent / name):
        if path.is_file():
            return path
    return Path(name)
