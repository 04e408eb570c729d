# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lists the scenes that come with the program, or copies them.

`caisson run jack.prm` runs a scene as it is. To change one, copy all of them into a
folder that is not there yet: scenes include each other.
"""
import argparse
import re
import shutil
import tempfile
from pathlib import Path

from caisson.paths import SCENES
from caisson import disk
from caisson.disk import InputError


def title_of(scene: Path) -> str:
    """Return the title of a scene, or nothing."""
    text = disk.read_text(scene)
    found = re.search(r"^\s*set Title\s*=\s*(.*)$", text, re.MULTILINE)
    return found.group(1) if found else ""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson scenes`."""
    text = "copy scenes and studies into DIR"
    parser.add_argument("--copy", type=Path, metavar="DIR", help=text)


def main(options: argparse.Namespace) -> int:
    """List or copy. Raises InputError where DIR cannot be made."""
    if options.copy is None:
        print(f"Scenes in {SCENES}:")
        for scene in sorted(SCENES.glob("*.prm")):
            print(f"  {scene.name:24}{title_of(scene)}")
        return 0
    if options.copy.exists():
        raise InputError(f"no copy into {options.copy}: it is there already")
    try:
        with tempfile.TemporaryDirectory(dir=options.copy.parent) as folder:
            new = Path(folder, "scenes")
            shutil.copytree(SCENES, new, copy_function=shutil.copyfile)
            new.rename(options.copy)
    except OSError as error:
        reason = error.strerror or "not all files can be copied"
        raise InputError(f"no copy into {options.copy}: {reason}") from error
    print(f"scenes: copied into {options.copy}")
    return 0
