# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a shell completes: commands, their options, and files that a command takes.

`caisson --completion` prints what bash needs; completion.bash then asks `caisson
--complete WORD...`, whose last word is the one to complete.
"""
import argparse
import glob
import importlib
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from caisson.paths import SCENES
from caisson.runner import RunError, query

SCRIPT = Path(__file__).with_name("completion.bash")
# the ends of the files that a command takes; all others take directories
FILES: dict[str, str | tuple[str, ...]] = {
    "run": ".prm",
    "suggest": ".prm",
    "study": ".toml",
    "cpt": (".csv", ".ags", ".gef", ".xml", ".xlsx", ".txt"),
}
Commands = Mapping[str, tuple[str, str]]


def options_of(command: str, commands: Commands) -> dict[str, list[str]]:
    """Return the options of a command, each with its choices; of `run` also those of
    the program, if there is one."""
    module = importlib.import_module(commands[command][0])
    parser = argparse.ArgumentParser(prog=f"caisson {command}")
    module.add_arguments(parser)
    found = {
        word: list(map(str, action.choices or []))
        for action in parser._actions
        for word in action.option_strings
        if word.startswith("--")
    }
    if command == "run":
        try:
            words = re.findall(r"^ +(?:-h \[ )?(--[\w-]+)", query(["--help"]), re.M)
        except (RunError, OSError):
            words = []
        found |= {word: [] for word in words}
    return found


def paths(begin: str, end: str | tuple[str, ...]) -> Iterator[str]:
    """Yield the directories, and the files with this end, whose paths begin so."""
    pattern = glob.escape(os.path.expanduser(begin)) + "*"
    for path in sorted(glob.glob(pattern)):
        if os.path.isdir(path) or (end and path.endswith(end)):
            yield path


def candidates(words: Sequence[str], commands: Commands) -> list[str]:
    """Return what the last word may become; the words follow `caisson`."""
    *before, begin = words or [""]
    if not before:
        found = [*commands, "--help", "--version"]
    elif before[0] not in commands:
        found = []
    elif begin.startswith("-"):
        found = list(options_of(before[0], commands))
    else:
        last, end = before[-1], FILES.get(before[0], "")
        if last.startswith("--"):
            if chosen := options_of(before[0], commands).get(last):
                return [word for word in chosen if word.startswith(begin)]
        found = list(paths(begin, end))
        if before[0] in ("run", "study"):  # those that come with the program
            found += [path.name for path in sorted(SCENES.glob(f"*{end}"))]
    return [word for word in dict.fromkeys(found) if word.startswith(begin)]


def main(words: Sequence[str], commands: Commands) -> int:
    """Print what `--completion`, or `--complete` and the words of a line, ask for."""
    if words[0] == "--completion":
        print(SCRIPT.read_text(encoding="utf-8"), end="")
    else:
        for word in candidates(words[1:], commands):
            print(word)
    return 0
