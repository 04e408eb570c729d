# SPDX-License-Identifier: LGPL-2.1-or-later
"""A command line with subcommands in groups: that of the user, of the laboratory and
of the workshop.

Each subcommand is a module with add_arguments(parser) and main(options). Only the
module of the subcommand that is called is loaded.
"""
import argparse
import contextlib
import difflib
import importlib
import os
import re
import subprocess
import sys
import traceback
from collections.abc import Callable, Collection, Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn, TextIO, cast

from caisson import disk, needed, paths
from caisson.disk import InputError
from caisson.terminal import PlainText

# group: subcommand: its module, and what it does
Groups = Mapping[str, Mapping[str, tuple[str, str]]]


def words_on(error: Exception) -> str:
    """Return in one line what a fault of the program is, and what it had read."""
    place = traceback.extract_tb(error.__traceback__)[-1]
    where = f"{Path(place.filename).name}:{place.lineno}"
    files = f" with {', '.join(map(str, disk.read_last))}" if disk.read_last else ""
    return (
        f"a fault of the program itself, at {where}: {disk.words_of(error)}."
        f" {disk.TRACEBACK}=1 shows more; please report it{files}"
    )


def commands_of(groups: Groups) -> dict[str, tuple[str, str]]:
    """Return all subcommands."""
    return {name: entry for group in groups.values() for name, entry in group.items()}


def help_of(groups: Groups) -> str:
    """Return the list of subcommands in their groups."""
    width = max(map(len, commands_of(groups))) + 2
    return "\n\n".join(
        "\n".join(
            [f"{group}:", *(f"  {name:{width}}{text}" for name, (_, text) in c.items())]
        )
        for group, c in groups.items()
    )


class Parser(argparse.ArgumentParser):
    """Says in a line what is wrong, with the nearest option to one that is not known,
    and not all options beside it."""

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Return the options, of which a value may begin with "-,", as in --columns
        -,depth_m,qc_MPa: argparse takes it for an option."""
        words = list[str]()
        for word in sys.argv[1:] if args is None else args:
            if re.match("-[,;]", word) and words and words[-1].startswith("--"):
                words[-1] += f"={word}"
            else:
                words.append(word)
        return super().parse_known_args(words, namespace)

    def error(self, message: str) -> NoReturn:
        """End the process."""
        options = [word for action in self._actions for word in action.option_strings]
        unknown = re.search(r"unrecognized arguments: (--[\w-]+)", message)
        near = difflib.get_close_matches(unknown[1], options, n=1) if unknown else []
        hint = f"; did you mean {near[0]}?" if near else ""
        self.exit(2, f"{self.prog}: {message}{hint}\n(--help lists all options)\n")


def run_command(
    argv: Sequence[str],
    program: str,
    description: str,
    groups: Groups,
    late: Collection[str] = (),
    elsewhere: str = "",
) -> int:
    """Run one subcommand; return its exit status. late: those that import what they
    need only after they have computed or read something; elsewhere: where other
    commands are, for who asks for one of them."""
    commands = commands_of(groups)
    if argv and argv[0] not in commands and not argv[0].startswith("-"):
        near = difflib.get_close_matches(argv[0], commands, n=1)
        hint = f" Did you mean {near[0]}?" if near else f" {elsewhere}".rstrip()
        print(
            f"{program}: there is no command {argv[0]}.{hint} --help lists all.",
            file=sys.stderr,
        )
        return 1
    parser = argparse.ArgumentParser(
        prog=program,
        description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog=help_of(groups),
    )
    version = f"{program} of caisson_mpm {paths.version()}"
    parser.add_argument("--version", action="version", version=version)
    parser.add_argument("command", choices=commands, metavar="COMMAND ...")
    if not argv:
        parser.print_help()
        return 1
    name = parser.parse_args(argv[:1]).command
    try:
        if name in late and (complaint := needed.complaint()):
            raise ModuleNotFoundError(complaint)
        module = importlib.import_module(commands[name][0])
    except ModuleNotFoundError as error:
        print(f"{program} {name}: {needed.complaint() or error}", file=sys.stderr)
        return 1
    own = Parser(
        prog=f"{program} {name}",
        description=module.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    module.add_arguments(own)
    disk.begin(paths_in(options := own.parse_args(argv[1:])))
    try:
        return int(module.main(options))
    except BrokenPipeError:  # as of `| head`
        raise
    except (InputError, OSError) as error:
        print(f"{name}: {error}", file=sys.stderr)
    except MemoryError:
        print(f"{name}: there is not enough memory", file=sys.stderr)
    except Exception as error:
        if disk.TRACEBACK in os.environ:
            raise
        print(f"{name}: {words_on(error)}", file=sys.stderr)
    return 1


def paths_in(options: argparse.Namespace) -> list[Path]:
    """Return the paths that a command line names."""
    values = vars(options).values()
    words = (x for value in values for x in (value if type(value) is list else [value]))
    return [word for word in words if isinstance(word, Path)]


def for_each(name: str, places: Sequence[Path], do: Callable[[Path], None]) -> int:
    """Do something for each place; say what fails, and return 1 then, else 0."""
    status = 0
    for place in places:
        try:
            do(place)
        except (InputError, OSError, subprocess.CalledProcessError) as error:
            print(f"{name}: {error}", file=sys.stderr)
            status = 1
    return status


def end_process(main: Callable[[Sequence[str]], int]) -> NoReturn:
    """Run the command of this process, and end it. A text that standard output does not
    take as a whole is a failure."""
    # where a standard stream is closed, a file of results would get its number and text
    while (number := os.open("/dev/full", os.O_RDWR)) < 3:
        os.set_inheritable(number, True)
    os.close(number)
    sys.stdout = cast(TextIO, PlainText(sys.stdout or os.fdopen(1, "w", closefd=False)))
    sys.stderr = cast(TextIO, PlainText(sys.stderr or os.fdopen(2, "w", closefd=False)))
    status: Any = 1
    try:
        if Path("matplotlibrc").exists() and needed.is_there("matplotlib"):
            with contextlib.chdir("/"):  # where it finds no settings
                importlib.import_module("matplotlib")
        try:
            status = main(sys.argv[1:])
        except SystemExit as end:  # of argparse
            status = end.code
        sys.stdout.flush()
    except BrokenPipeError:  # as of `| head`
        os._exit(1)
    except KeyboardInterrupt:
        print("\ninterrupted; what is finished is kept", file=sys.stderr)
        os._exit(1)
    except OSError as error:
        text = "standard output takes no more text: is it closed, or a disk full?"
        print(f"{text} ({error.strerror})", file=sys.stderr)
        os._exit(1)
    sys.exit(status)
