# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lists the scenes that come with the program, or copies them.

`caisson run jack.prm` runs a scene as it is. To change one, copy all of them into a
folder that is not there yet: scenes include each other.
"""
import argparse
import re
import shutil
import sys
from pathlib import Path

from caisson.paths import SCENES


def title_of(scene: Path) -> str:
    """Return the title of a scene, or nothing."""
    text = scene.read_text(encoding="utf-8")
    found = re.search(r"^\s*set Title\s*=\s*(.*)$", text, re.MULTILINE)
    return found.group(1) if found else ""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson scenes`."""
    parser.add_argument(
        "--copy", type=Path, metavar="DIR", help="copy scenes and studies into DIR"
    )


def main(options: argparse.Namespace) -> int:
    """List or copy; return 1 where DIR cannot be made."""
    if options.copy is None:
        print(f"Scenes in {SCENES}:")
        for scene in sorted(SCENES.glob("*.prm")):
            print(f"  {scene.name:24}{title_of(scene)}")
        return 0
    try:
        shutil.copytree(SCENES, options.copy, copy_function=shutil.copyfile)
    except OSError as error:
        reason = "it is there already" if options.copy.exists() else error.strerror
        print(f"scenes: no copy into {options.copy}: {reason}", file=sys.stderr)
        return 1
    print(f"scenes: copied into {options.copy}")
    return 0
