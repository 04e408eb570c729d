#!/usr/bin/python3 -B
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the scenes of a room, and compares what the program says with ROOM/scenes.toml:

    tolerance = [1e-3, 1e-3]       # of the whole room, if it is another than usual

    [NAME]                         # of the test
    scene = "../simulation/jack"   # another test of this file, or the .prm; otherwise
                                   # NAME.prm of the room
    set."Section/Entry" = 1        # an entry that is changed
    tolerance = [1e-6, 1e-2]       # absolute and relative: a number differs that is
                                   # equal within neither
    output = '''                   # what the program says
    '''

A scene whose checks (lab/checks.py) fail, fails here, too. They are the last lines of
the output.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import reference

sys.path.append(str(reference.HERE / "program"))
from program import ALONE, BUILD, PROGRAM, judged  # noqa: E402
from program import query_server, set_options, start_of  # noqa: E402

Scenes = dict[str, dict[str, Any]]
BEGIN, END = "output = '''\n", "'''\n"


def run(room: Path, scenes: Scenes, name: str) -> tuple[int, str]:
    """Run a scene; return its status and what the program says."""
    directory = BUILD / f"tests/{room.name}/{name}"
    shutil.rmtree(directory, ignore_errors=True)
    file, entries = start_of(scenes, name)
    words = [str(PROGRAM.resolve()), file, "--output-directory", str(directory)]
    words += set_options({"Output/Terminal": "plain", **entries})
    done = query_server(words) or subprocess.run(
        words, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=ALONE
    )
    done = judged(done, directory)
    return done.returncode, done.stdout


def update(file: Path, name: str, said: str) -> None:
    """Make what the program has said the reference."""
    text = file.read_text("utf-8")
    begin = text.index(BEGIN, text.index(f"\n[{name}]\n")) + len(BEGIN)
    file.write_text(text[:begin] + said + text[text.index(END, begin) :], "utf-8")


def main() -> int:
    """Run the scenes; return 1 where one differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("room")
    parser.add_argument("name", nargs="*", help="of a scene, otherwise all")
    text = "make what the program says the reference; the commit says why"
    parser.add_argument("--update", action="store_true", help=text)
    options = parser.parse_args()
    room = reference.HERE / options.room
    os.chdir(room)
    content = tomllib.loads((room / "scenes.toml").read_text("utf-8"))
    usual = content.pop("tolerance", reference.USUAL)
    if unknown := set(options.name) - set(content):
        parser.error(f"{room / 'scenes.toml'} has no {', '.join(unknown)}")
    failed = []
    for name in options.name or content:
        scene = content[name]
        status, said = run(room, content, name)
        tolerance = scene.get("tolerance", usual)
        wrong = reference.differences(scene["output"], said, tolerance)
        if status == 0 and options.update:
            update(room / "scenes.toml", name, said)
        elif status or wrong:
            failed.append(name)
            print(f"{name}: status {status}", *wrong[:20], sep="\n")
    print(f"{options.room}: {len(failed)} of {len(options.name or content)} fail")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
