# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls the program as a user does: what all test_*.py share.

Each file test_GROUP.py is a test program/GROUP of ctest. By hand, all tests of a group,
or those of a class or that fit a word:

    cd tests/program && python3 -B -m unittest -v test_stop_and_restart
    cd tests/program && python3 -B -m unittest -v test_stop_and_restart -k file

CAISSON_MPM_PROGRAM names another program than that of build/release, and
CAISSON_MPM_TEST_DIRECTORY where the results go.
"""
import atexit
import contextlib
import ctypes
import functools
import io
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import tomllib
import unittest
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent.parent  # tests
sys.path[:0] = [str(HERE.parent / folder) for folder in ("python", "tools", ".")]

from caisson import __main__ as command_line  # noqa: E402
from caisson import disk, runner  # noqa: E402
from caisson.paths import BUILD, PROGRAM, SCENES  # noqa: E402
from caisson.results import Results  # noqa: E402
from caisson.runner import Status, environment, mpi_command, set_options  # noqa: E402
from lab.checks import checks_of  # noqa: E402

SUCCESS = Status.SUCCESS
BAD_INPUT = Status.BAD_INPUT
FAILURE = Status.FAILURE
STOPPED = Status.STOPPED
Rows = list[dict[str, float]]
Entries = dict[str, Any]
ALONE = environment()  # of a program on one rank
# program_server.cc, which ctest names; of use where it is not older than the
# program
SERVER = os.environ.get("CAISSON_MPM_TEST_SERVER")
START = Path.cwd()  # where the server runs
PR_SET_CHILD_SUBREAPER = 36  # of Linux
ONE_CALL = threading.Lock()  # at a time, of all threads


def scene(name: str) -> str:
    """Return a scene of the tests, whose names are unique over all rooms, or of the
    verification, or one by its path from tests."""
    found = HERE.glob(f"{name}.prm" if "/" in name else f"*/{name}.prm")
    return str(next(found, HERE.parent / f"lab/verification/{name}.prm"))


def start_of(scenes: dict[str, Any], name: str) -> tuple[str, Entries]:
    """Return the .prm of a test of a scenes.toml (tests/scenes.py), from its room, and
    the entries that are changed."""
    base = scenes[name].get("scene", name)
    is_other = base in scenes and base != name
    file, entries = start_of(scenes, base) if is_other else (f"{base}.prm", {})
    return file, {**entries, **scenes[name].get("set", {})}


@functools.cache
def scene_and_entries(name: str) -> tuple[str, Entries]:
    """Return a scene of scene(), or one that scenes.toml of a room makes of another,
    with the entries that are changed."""
    if os.path.isfile(scene(name)):
        return scene(name), {}
    for file in HERE.glob("*/scenes.toml"):
        scenes = tomllib.loads(file.read_text(encoding="utf-8"))
        if name in scenes:
            base, entries = start_of(scenes, name)
            return str((file.parent / base).resolve()), entries
    raise ValueError(f"there is no scene {name}")


def user_scene(name: str) -> str:
    """Return a scene of prm/, or PART/NAME of the laboratory."""
    folder = HERE.parent / "lab" if "/" in name else SCENES
    return str(folder / f"{name}.prm")


def history(path: Path, name: str = "history") -> Rows:
    """Return the rows of NAME.csv of a run."""
    columns = Results(path).table(f"{name}.csv", "time_s")
    rows = zip(*columns.values())
    return [dict(zip(columns, map(float, row))) for row in rows]


def summary(path: Path) -> dict[str, Any]:
    """Return run.json of a run."""
    return Results(path).summary


def checks(path: Path) -> list[dict[str, Any]]:
    """Return what the checks of a run find."""
    return checks_of(Results(path))


def judged(
    done: "subprocess.CompletedProcess[str]", path: Path
) -> "subprocess.CompletedProcess[str]":
    """Add the checks of the scene to what its run has said; a run whose checks fail
    fails."""
    if done.returncode != SUCCESS or not (path / "run.json").is_file():
        return done
    found = checks(path)
    done.stdout += "".join(f"{check['line']}\n" for check in found)
    if not all(check["pass"] for check in found):
        done.returncode = FAILURE
    return done


def flip_a_bit(path: Path) -> None:
    """Damage the checkpoint that is valid, in its middle; twice repairs it."""
    info = (path / "checkpoint.info").read_text(encoding="utf-8")
    found = re.search(r"^file (.*)$", info, re.M)
    assert found, info
    with open(path / found.group(1), "r+b") as file:
        middle = file.seek(0, os.SEEK_END) // 2
        file.seek(middle)
        byte = file.read(1)[0]
        file.seek(middle)
        file.write(bytes([byte ^ 1]))


@functools.cache
def server() -> "subprocess.Popen[str] | None":
    """Return the process that makes short calls cheap, if there is one."""
    if not SERVER or os.path.getmtime(SERVER) < os.path.getmtime(PROGRAM):
        return None
    # what it starts and does not wait for becomes a child of this process
    ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    process = subprocess.Popen(
        [SERVER],
        text=True,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=ALONE,
    )
    assert process.stdin and process.stdout
    for pipe in (process.stdout, process.stdin):
        atexit.register(pipe.close)  # the end of its input is its end
    return process


def ask_server(words: list[str], output: str, waits: bool) -> int | None:
    """Let the server make a call, whose words go to the end of a file; return its exit
    status, or at once the number of its process. None where the server cannot."""
    if Path.cwd() != START:
        return None
    with ONE_CALL:
        process = server()
        if process is None:
            return None
        assert process.stdin and process.stdout
        for word in (output, str(int(waits)), str(len(words) - 1), *words[1:]):
            process.stdin.write(word + "\0")
        process.stdin.flush()
        return int(process.stdout.readline())


def query_server(words: list[str]) -> "subprocess.CompletedProcess[str] | None":
    """Let the server make a call; return nothing where it cannot."""
    with tempfile.NamedTemporaryFile("r", encoding="utf-8") as output:
        status = ask_server(words, output.name, waits=True)
        if status is None:
            return None
        return subprocess.CompletedProcess(words, status, output.read())


class Started:
    """A process that the server has started: what a run asks of a subprocess.Popen."""

    def __init__(self, pid: int) -> None:
        self.pid, self.returncode = pid, 0

    def kill(self) -> None:
        """End it."""
        os.kill(self.pid, signal.SIGKILL)


class ThroughServer:
    """The module subprocess, but that the server makes the calls of the program: those
    whose words are waited for, and those whose words go to a file."""

    def __getattr__(self, name: str) -> Any:
        return getattr(subprocess, name)

    def run(self, words: list[str], **more: Any) -> "subprocess.CompletedProcess[str]":
        """Run a program to its end."""
        is_query = words[0] == str(PROGRAM) and more.get("stderr") == subprocess.STDOUT
        done = query_server(words) if is_query else None
        return done or subprocess.run(words, **more)

    def Popen(self, words: list[str], **more: Any) -> Any:  # noqa: N802, its name there
        """Start a program."""
        is_run = words[0] == str(PROGRAM) and isinstance(
            more.get("stdout"), io.TextIOBase
        )
        log = os.path.abspath(more["stdout"].name) if is_run else ""
        pid = ask_server(words, log, waits=False) if is_run else None
        return Started(pid) if pid else subprocess.Popen(words, **more)


setattr(runner, "subprocess", ThroughServer())
disk.DPI = 40  # of pictures, at which nobody looks


def caisson(*words: Any, cwd: Path | None = None) -> "subprocess.CompletedProcess[str]":
    """Run a command of the user to its end, whatever its status. It runs in this
    process, which has loaded Python's packages; cwd: where, otherwise here."""
    said, complained = io.StringIO(), io.StringIO()
    with (
        contextlib.chdir(cwd or Path.cwd()),
        contextlib.redirect_stdout(said),
        contextlib.redirect_stderr(complained),
    ):
        try:
            status = command_line.main([*map(str, words)])
        except SystemExit as end:  # of --help, or a wrong option
            status = int(end.code or 0)
    return subprocess.CompletedProcess(
        words, status, said.getvalue(), complained.getvalue()
    )


class ProgramTest(unittest.TestCase):
    """A test that runs the program, and what it asks of its results."""

    maxDiff = None
    program = PROGRAM.resolve()
    results = Path(
        os.environ.get("CAISSON_MPM_TEST_DIRECTORY", BUILD / "tests/program")
    ).resolve()

    def directory(self, name: str = "results") -> Path:
        """Return the name of a directory of this test, which is not there yet."""
        path = self.results / self.id().split(".")[-1] / name
        shutil.rmtree(path, ignore_errors=True)
        return path

    def made_directory(self, name: str = "files") -> Path:
        """Return an empty directory of this test."""
        path = self.directory(name)
        path.mkdir(parents=True)
        return path

    def command(
        self, *options: Any, entries: Entries | None = None, ranks: int = 1
    ) -> list[str]:
        """Return the words of a call; options: a file and options."""
        words = [*mpi_command(ranks), str(self.program), *map(str, options)]
        return words + set_options(entries or {})

    def call(
        self, *options: Any, entries: Entries | None = None, ranks: int = 1
    ) -> "subprocess.CompletedProcess[str]":
        """Run the program to its end, whatever its status, and the checks of its scene;
        with its words."""
        words = self.command(*options, entries=entries, ranks=ranks)
        done = query_server(words) if ranks == 1 else None
        several = {**environment(), "OMPI_MCA_mpi_yield_when_idle": "1"}
        done = done or subprocess.run(
            words,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env=ALONE if ranks == 1 else several,
        )
        if "--output-directory" not in options or "--validate" in options:
            return done
        return judged(done, Path(options[options.index("--output-directory") + 1]))

    def run_program(
        self,
        status: Status,
        *options: Any,
        entries: Entries | None = None,
        ranks: int = 1,
    ) -> str:
        """Run the program, ask for this status, and return its words."""
        done = self.call(*options, entries=entries, ranks=ranks)
        self.assertEqual(done.returncode, status, done.stdout)
        return done.stdout

    def start(
        self, *options: Any, entries: Entries | None = None
    ) -> "subprocess.Popen[str]":
        """Start the program; its words can be read line by line."""
        return subprocess.Popen(
            self.command(*options, entries=entries),
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            env=ALONE,
        )

    def run_scene(
        self,
        name: str,
        path: Path,
        status: Status = SUCCESS,
        *options: Any,
        entries: Entries | None = None,
        ranks: int = 1,
    ) -> str:
        """Run a scene of the tests with its results in path."""
        file, changed = scene_and_entries(name)
        return self.run_program(
            status,
            file,
            "--output-directory",
            path,
            *options,
            entries={**changed, **(entries or {})},
            ranks=ranks,
        )

    def refused(self, words: list[str], name: str = "jack", **more: Any) -> str:
        """Ask that the scene is refused with a message that has all the words,
        whatever their case, and that it leaves no results.

        more: entries, and status (default: bad input).
        """
        path = self.directory("refused")
        text = self.run_scene(
            name, path, more.get("status", BAD_INPUT), entries=more["entries"]
        )
        self.assert_words(words, text)
        self.assertFalse((path / "history.csv").exists(), "there are results")
        return text

    def assert_invalid(self, words: list[str], name: str, entries: Entries) -> None:
        """Ask that a scene of prm does not validate, with a message that has all the
        words."""
        text = self.run_program(
            BAD_INPUT, user_scene(name), "--validate", entries=entries
        )
        self.assert_words(words, text)

    def assert_reported(self, words: list[str], name: str, entries: Entries) -> str:
        """Ask that a run of a scene of prm says all the words; return all it says."""
        text = self.run_program(
            SUCCESS,
            user_scene(name),
            "--output-directory",
            self.directory(),
            entries=entries,
        )
        self.assert_words(words, text)
        return text

    def assert_words(self, words: list[str], text: str) -> None:
        """Ask for all the words, whatever their case."""
        for word in words:
            self.assertIn(word.lower(), text.lower())

    def assert_same_history(self, a: Rows, b: Rows, tolerance: float) -> None:
        """Ask for the same rows, but for their last time step; tolerance:
        relative, absolute below 1."""
        self.assertEqual(len(a), len(b), "rows")
        for x, y in zip(a, b):
            for key in x.keys() - {"time_step_s"}:
                self.assertLessEqual(
                    abs(x[key] - y[key]),
                    tolerance * max(1.0, abs(x[key])),
                    f"{key} at t = {x['time_s']}: {x[key]} and {y[key]}",
                )
