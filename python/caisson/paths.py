# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the parts of the project are: in its folder, or where `cmake --install` has
put them, which is PREFIX/bin for the programs and PREFIX/share/caisson_mpm for this
package and the scenes. An installation may be read-only."""
import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
INSTALLED = not (ROOT / "CMakeLists.txt").is_file()
SCENES = ROOT / "prm"
BUILD = ROOT / "build/release"
# where runs start and results go if nothing else is said
WORK = Path.cwd() if INSTALLED else ROOT
RESULTS = WORK / "results"
PICTURES = ROOT / "doc/pictures"
# another program for the tests
PROGRAM = Path(
    os.environ.get("CAISSON_MPM_PROGRAM")
    or (ROOT.parent.parent / "bin" if INSTALLED else BUILD) / "caisson_mpm"
)


def short(path: Path) -> str:
    """Return the path as seen from the project's folder, or from that of the results
    of an installation, if it lies there."""
    path = path.resolve()
    for folder in (ROOT, WORK):
        if path.is_relative_to(folder):
            return str(path.relative_to(folder))
    return str(path)


def scene_or_study(name: str) -> Path:
    """Return the file of this name, or that of the project where there is none here:
    jack.prm and prm/jack.prm both name prm/jack.prm of the project."""
    for path in (Path(name), SCENES / name, SCENES.parent / name):
        if path.is_file():
            return path
    return Path(name)
