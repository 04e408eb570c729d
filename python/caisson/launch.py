# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a scene on one or more ranks and draws its pictures.

The exit status is the program's: 0 success, 1 bad input, 2 failure, 3 stopped on
request. Options of caisson_mpm follow the file. A scene that is not a file here is
one of the project, see `caisson scenes`.
"""
import argparse
import signal
import subprocess
import sys
import time
from pathlib import Path

from caisson import needed
from caisson.paths import INSTALLED, PROGRAM, SCENES, scene_or_study, short
from caisson.run import (
    RunError,
    Status,
    environment,
    mpi_command,
    read_parameters,
)


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson run`."""
    parser.usage = "%(prog)s [--ranks N] FILE.prm [option of caisson_mpm]..."
    parser.add_argument("--ranks", type=int, default=1, metavar="N")
    parser.add_argument("arguments", nargs=argparse.REMAINDER, metavar="FILE.prm ...")


def directory_of(arguments: list[str]) -> Path | None:
    """Return where the program will write, None where it will not: of bad input,
    which it explains itself, or of options that only print."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("--output-directory", type=Path)
    chosen: Path | None = parser.parse_known_args(arguments)[0].output_directory
    if chosen is not None:  # counts before the entry
        return chosen
    try:
        return Path(read_parameters(arguments)["Output/Directory"])
    except (RunError, KeyError):
        return None


def draw(directory: Path) -> None:
    """Draw the pictures and write the report; the results do not need them."""
    from caisson import plot, report

    for picture in plot.draw(directory):
        print(f"plot: {picture}")
    print(f"report: {report.write(directory)}")


def wait_for(process: "subprocess.Popen[bytes]") -> int:
    """Return the exit status of the program, as a shell would.

    The program ends with a checkpoint when it is asked to stop, so it is waited
    for. Ctrl-C reaches it without our help; other signals are handed on.
    """
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda caught, _: process.send_signal(caught))
    while True:
        try:
            status = process.wait()
            return status if status >= 0 else 128 - status
        except KeyboardInterrupt:
            continue


def main(options: argparse.Namespace) -> int:
    """Run the program, then draw what it wrote; return its status."""
    if options.ranks < 1 or not options.arguments:
        scenes = SCENES if INSTALLED else f"{short(SCENES)}/"
        print(
            f"run: give a parameter file; the scenes are in {scenes}", file=sys.stderr
        )
        return 1
    arguments = [
        str(scene_or_study(word)) if word.endswith(".prm") else word
        for word in options.arguments
    ]
    directory, begin = directory_of(arguments), time.time()
    words = [*mpi_command(options.ranks), str(PROGRAM), *arguments]
    status = wait_for(subprocess.Popen(words, env=environment()))
    if status not in list(Status):
        print(
            f"run: the program did not end in order (exit status {status}; above 128,"
            " 128 and the number of a signal). If there is a checkpoint, --restart"
            " continues from it",
            file=sys.stderr,
        )
    history = directory / "history.csv" if directory else None
    # only what this run wrote is drawn: --validate, say, writes nothing
    if directory and history and history.exists() and history.stat().st_mtime >= begin:
        try:
            draw(directory)
        except Exception as error:  # whatever it is, the run was good
            print(
                f"run: no pictures of {directory}: {error}; the results are not"
                " affected",
                file=sys.stderr,
            )
    return status
