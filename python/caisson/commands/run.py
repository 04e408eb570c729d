# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a scene on as many ranks as pay, or on those of --ranks, and draws its pictures.

A scene with Installation/Phases is run with all of them, each in a folder inside the
one of the scene; those that are complete are not repeated.
With --error it first finds the coarsest mesh whose error bar is small enough, and runs
the scene on that one.
With --band it runs FILE_low.prm and FILE_high.prm, too, at the same time, one core
each, and the page of FILE.prm has all three; complete runs are not repeated. Of the
options of caisson_mpm it takes --set, --restart and --overwrite.
The exit status is the program's: 0 success, 1 bad input, 2 failure, 3 stopped on
request. Options of caisson_mpm follow the file. A scene that is not a file here is
one of the project, see `caisson scenes`.
"""
import argparse
import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

from caisson import disk, needed, ranks
from caisson.command_line import Parser
from caisson.commands import run_several
from caisson.paths import INSTALLED, PROGRAM, SCENES, scene_or_study, short
from caisson.runner import (
    RunError,
    Status,
    query,
    environment,
    mpi_command,
    read_parameters,
    refuse_ranks,
    refuse_missing,
    size_in,
)

PACKAGES = Path(__file__).parents[2]
RENEWAL = 20.0  # s, in which the report of a run is renewed, if there is a new row


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson run`."""
    parser.usage = (
        "%(prog)s [--ranks N | --band] [--error 5%% [--budget TIME]] FILE.prm"
        " [option of caisson_mpm]..."
    )
    add_own(parser)
    parser.add_argument("arguments", nargs=argparse.REMAINDER, metavar="FILE.prm ...")


def add_own(parser: argparse.ArgumentParser) -> None:
    """Add the options that the program does not have."""
    text = "MPI ranks, default: as many as pay on this machine"
    parser.add_argument("--ranks", type=int, metavar="N", help=text)
    text = "run the estimates of low and high resistance, too"
    parser.add_argument("--band", action="store_true", help=text)
    text = "refine the mesh until the error bar of the total force is that small"
    parser.add_argument("--error", metavar="5%", help=text)
    text = "with --error: time of all runs on one core, such as 30min (default: 2h)"
    parser.add_argument("--budget", metavar="TIME", help=text)


def take_own(options: argparse.Namespace) -> None:
    """Take the options that the program does not have from the words after the file,
    where they may stand as well."""
    parser = Parser(prog="caisson run", add_help=False, allow_abbrev=False)
    add_own(parser)
    _, options.arguments = parser.parse_known_args(options.arguments, options)


def entries_of(arguments: list[str]) -> dict[str, str]:
    """Return all entries in effect; none of bad input, which the program explains
    itself, or of options that only print."""
    try:
        return read_parameters(arguments)
    except (RunError, KeyError):
        return {}


def places_of(
    arguments: list[str], entries: dict[str, str]
) -> tuple[Path | None, Path | None]:
    """Return where the program will write, and the file that stops it; None where there
    is none. entries: those in effect."""
    parser = Parser(prog="caisson run", add_help=False, allow_abbrev=False)
    parser.add_argument("--output-directory", type=Path)
    chosen: Path | None = parser.parse_known_args(arguments)[0].output_directory
    if not entries:
        return chosen, None
    directory = chosen or Path(entries["Output/Directory"])
    name = entries["Run control/Stop file"]
    return directory, directory / name if name else None


def choose_ranks(arguments: list[str], given: int | None = None) -> int:
    """Return the number of ranks that is given, or that which pays for a run, and say
    why. It is one where there will be no run: the program itself says what is wrong
    with the input."""
    if "--validate" in arguments:
        return 1
    if given:
        return given
    try:
        points = size_in(query([*arguments, "--validate"])).points
    except RunError:
        points = 0
    if not points:
        return 1
    chosen, why = ranks.choose(points)
    plural = "" if chosen == 1 else "s"
    text = f"run: {chosen} rank{plural} ({why}); --ranks N overrules"
    print(text, file=sys.stderr, flush=True)
    return chosen


def options_for_error(
    options: argparse.Namespace, directory: Path
) -> tuple[list[str], Path]:
    """Return the options of the program with which the scene has the error that is
    wanted, and its error bar. The runs for it go beside the output directory. Raises
    RunError, StudyError and ArgumentTypeError."""
    from caisson.error_bars import wanted
    from caisson.error_bars.command import seconds_of

    scene, *more = options.arguments
    if more and more[0] != "--output-directory":
        raise RunError(
            f"--error goes with --output-directory only, not with {more[0]}. Write the"
            " entries that you change into a file"
        )
    budget = seconds_of(options.budget) if options.budget else wanted.BUDGET
    error = wanted.error_of(options.error)
    meshes = directory.with_name(f"{directory.name}_meshes")
    entries, bar = wanted.mesh_for(scene_or_study(scene), error, budget, meshes)
    return [w for k, v in entries.items() for w in ("--set", f"{k}={v}")], bar


def draw(directory: Path, error_bar: Path | None, in_full: bool = True) -> None:
    """Draw the pictures, write the report and say whether it works; the results do not
    need them. error_bar: of the run, None for that beside the scene; in_full: say all
    of it, and not only where the report is."""
    from caisson import run_error_bar, plot, report
    from caisson.report import low_and_high, verdict
    from caisson.results import Results
    from caisson.verdict import run_review

    run_error_bar.adopt(directory, error_bar)
    run = Results(directory)
    verdict.keep(run)
    for picture in plot.draw(directory):
        if in_full:
            print(f"plot: {picture}")
    print(f"report: {report.write(directory)}")
    said = run_review.down_to(verdict.verdict_of(run).end, run_review.review_of(run))
    lines = [
        *(f"warning: {text}" for text in said),
        *verdict.lines_of(run),
        low_and_high.sentence_of(run),
    ]
    for line in filter(None, lines if in_full else []):
        print(line)


def try_to_draw(directory: Path, error_bar: Path | None) -> None:
    """Draw a run, and say so where that fails."""
    try:
        draw(directory, error_bar)
    except KeyboardInterrupt:
        text = f"run: the results are whole; `caisson report {short(directory)}`"
        print(f"\n{text} makes the page", file=sys.stderr)
        raise
    except Exception as error:  # whatever it is, it says nothing of the run
        print(
            f"run: no pictures of {directory}: {error}; `caisson report"
            f" {short(directory)}` makes them when that is mended",
            file=sys.stderr,
        )


@contextlib.contextmanager
def reporting(directory: Path | None) -> Iterator[None]:
    """Renew the report of a run from time to time as long as it runs and has more to
    show."""
    ended = threading.Event()

    def renew() -> None:
        size, wait = -1, RENEWAL
        while directory is not None and not ended.wait(wait):
            begin, history = time.monotonic(), directory / "history.csv"
            before, size = size, history.stat().st_size if history.is_file() else -1
            if size != before:
                python = ["nice", sys.executable, "-P", "-m", "caisson"]
                subprocess.run(
                    [*python, "report", str(directory)],
                    env={**os.environ, "PYTHONPATH": str(PACKAGES)},
                    stdout=subprocess.DEVNULL,
                    stderr=subprocess.DEVNULL,
                )
            wait = max(RENEWAL - (time.monotonic() - begin), RENEWAL / 20)

    thread = threading.Thread(target=renew, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


def wait_for(process: "subprocess.Popen[bytes]") -> int:
    """Return the exit status of the program, as a shell would. It ends with a
    checkpoint when it is asked to stop, so it is waited for."""
    while True:
        try:
            status = process.wait()
            return status if status >= 0 else 128 - status
        except KeyboardInterrupt:
            continue


def run_alone(command: list[str]) -> int:
    """Run the program on one rank; return its exit status. Ctrl-C reaches it without
    our help; other signals are handed on."""
    process = subprocess.Popen(command, env=environment())
    for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, lambda caught, _: process.send_signal(caught))
    return wait_for(process)


def run_on_ranks(command: list[str], stop_file: Path | None) -> int:
    """Run the program on several ranks; return its exit status.

    mpirun ends ranks a few seconds after a signal, whether or not they have written
    their checkpoint. So no signal of the terminal reaches it: the first one makes the
    file that stops a run in order, and the second one is handed on.
    """
    process = subprocess.Popen(
        command, env=environment(), stdin=subprocess.DEVNULL, start_new_session=True
    )
    is_asked = False

    def stop(*_: object) -> None:
        nonlocal is_asked
        if is_asked or stop_file is None or not stop_file.parent.is_dir():
            process.send_signal(signal.SIGTERM)
        else:
            stop_file.touch()
            print("run: stopping; once more ends it at once", file=sys.stderr)
        is_asked = True

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, stop)
    status = wait_for(process)
    if is_asked and stop_file is not None:  # which ranks that were ended have not seen
        stop_file.unlink(missing_ok=True)
    return status


def run_band(arguments: list[str]) -> int:
    """Run a band, then the phases of its best scene, if it has some, which are refused
    before anything is run. Return the exit status."""
    entries, chain = entries_of(arguments), None
    if run_several.phases_asked_for(arguments, entries):
        chain = run_several.Chain(arguments, entries, None, None)
        chain.refuse_way()
    status = run_several.run_band(arguments, draw, reporting)
    if chain is None:
        return status
    if status != Status.SUCCESS:
        print("run: phases follow when all of the band is complete", file=sys.stderr)
        return status
    return chain.main(try_to_draw, reporting, has_scene=True)


def has_written(directory: Path, begin: float) -> bool:
    """Return whether a run that has ended wrote results since a time (s): it has not
    where it only answered something, nor where another run still writes there."""
    history = directory / "history.csv"
    is_new = history.is_file() and history.stat().st_mtime >= begin
    return is_new and not disk.is_locked(directory)


def main(options: argparse.Namespace) -> int:
    """Run the program, then draw what it wrote; return its status."""
    refuse_missing(PROGRAM)
    take_own(options)
    if options.ranks is not None:
        refuse_ranks(options.ranks)
    if not options.arguments:
        scenes = SCENES if INSTALLED else f"{short(SCENES)}/"
        raise RunError(f"give a parameter file; the scenes are in {scenes}")
    arguments = [
        str(scene_or_study(word)) if word.endswith(".prm") else word
        for word in options.arguments
    ]
    if options.budget and not options.error:
        raise RunError("--budget belongs to --error")
    if options.band:
        if options.ranks or options.error:
            other = "--ranks" if options.ranks else "--error"
            raise RunError(
                f"--band takes --set, --restart and --overwrite, not {other}: each"
                " scene has one core"
            )
        return run_band(arguments)
    entries = entries_of(arguments)
    directory, stop_file = places_of(arguments, entries)
    has_phases = bool(run_several.phases_asked_for(arguments, entries))
    error_bar = None
    if options.error and directory:  # else the program says what is wrong
        try:
            more, error_bar = options_for_error(options, directory)
            arguments += more
        except argparse.ArgumentTypeError as error:
            raise RunError(str(error)) from error
    if complaint := needed.complaint():
        print(f"run: {complaint}, for pictures and report", file=sys.stderr)
    if has_phases:
        chain = run_several.Chain(arguments, entries, options.ranks, error_bar)
        return chain.main(try_to_draw, reporting)
    n_ranks = choose_ranks(arguments, options.ranks)
    begin = time.time()
    command = [*mpi_command(n_ranks), str(PROGRAM), *arguments]
    with reporting(directory):
        if n_ranks == 1:
            status = run_alone(command)
        else:
            status = run_on_ranks(command, stop_file)
    if status not in list(Status):
        print(
            f"run: the program did not end in order (exit status {status}; above 128,"
            " 128 and the number of a signal). If there is a checkpoint, --restart"
            " continues from it",
            file=sys.stderr,
        )
    if directory and status != Status.BAD_INPUT and has_written(directory, begin):
        try_to_draw(directory, error_bar)
    return status
