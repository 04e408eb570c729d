# SPDX-License-Identifier: LGPL-2.1-or-later
"""Options of commands that are numbers."""
import argparse
from typing import Any


def declare(parser: argparse.ArgumentParser, **options: tuple[Any, str]) -> None:
    """Declare options by their default and their help: a float, an int, or a list of
    floats, of which the command takes any number."""
    add = parser.add_argument
    for name, (default, text) in options.items():
        if isinstance(default, list):
            add(f"--{name}", type=float, nargs="+", default=default, help=text)
        else:
            add(f"--{name}", type=type(default), default=default, help=text)
