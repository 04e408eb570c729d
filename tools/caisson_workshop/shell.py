# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls the shell script beside this module that has the name of the command; its
head says how it is used."""
import argparse
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments that the script gets."""
    command = parser.prog.split()[-1]
    parser.set_defaults(script=HERE / f"{command.replace('-', '_')}.sh")
    parser.prefix_chars = "\0"  # all options are those of the script
    parser.add_argument("arguments", nargs="*")


def main(options: argparse.Namespace) -> int:
    """Run the script; return its exit status."""
    return subprocess.run([str(options.script), *options.arguments]).returncode
