# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the parts of the project are."""
import os
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SCENES = ROOT / "prm"
BUILD = ROOT / "build/release"
# another program for the tests
PROGRAM = Path(os.environ.get("CAISSON_MPM_PROGRAM", BUILD / "caisson_mpm"))
RESULTS = ROOT / "results"
PICTURES = ROOT / "doc/pictures"


def short(path: Path) -> str:
    """Return the path as seen from the project's folder, if it lies there."""
    try:
        return str(path.resolve().relative_to(ROOT))
    except ValueError:
        return str(path)
