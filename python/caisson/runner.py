# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls of the program: the only place that knows its command line."""
import collections
import contextlib
import enum
import functools
import hashlib
import json
import math
import os
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from caisson.paths import INSTALLED, PROGRAM, WORK
from caisson.ranks import Size
from caisson.units import SECONDS
from caisson import disk
from caisson.disk import InputError, is_locked

Entries = Mapping[str, Any]
# what batch systems set, which may give a run several hosts
RANKS_PER_CORE = 4  # at most
BATCH = ("SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "PE_HOSTFILE")


class Status(enum.IntEnum):
    """The exit statuses of the program."""

    SUCCESS = 0
    BAD_INPUT = 1
    FAILURE = 2
    STOPPED = 3


class RunError(InputError):
    """A run that could not be made, or not be finished; the text is for the user."""


def in_words(value: object) -> str:
    """Return the value of an entry as a .prm file has it; a list with commas."""
    if isinstance(value, (list, tuple)):
        return ", ".join(map(in_words, value))
    return str(value).lower() if isinstance(value, bool) else str(value)


def set_options(entries: Entries) -> list[str]:
    """Return the options that set these entries, {"Section/Entry": value}."""
    options = []
    for entry, value in entries.items():
        options += ["--set", f"{entry}={in_words(value)}"]
    return options


def refuse_ranks(ranks: int) -> None:
    """Refuse a number of ranks on which no run can go well; a batch system, which may
    have other machines, knows its own. Raises RunError."""
    most: float = RANKS_PER_CORE * (os.cpu_count() or 1)
    if set(BATCH) & set(os.environ):
        most = math.inf
    if ranks != int(ranks) or not 1 <= ranks <= most:
        raise RunError(
            f"--ranks must be a whole number from 1 to {most}, not {ranks}: this"
            f" machine has {most // RANKS_PER_CORE} cores"
        )


def mpi_command(ranks: int, binding: str = "none") -> list[str]:
    """Return what stands before the program to run it on several ranks.

    Ranks that wait let others compute. That costs nothing that could be measured, and
    where other work takes the cores, ranks that do not are five times as slow.
    """
    refuse_ranks(ranks)
    if ranks == 1:
        return []
    start = ["mpirun", "-np", str(ranks), "--bind-to", binding]
    if binding == "none":
        start += ["--oversubscribe", "--mca", "mpi_yield_when_idle", "1"]
    return start


def environment() -> dict[str, str]:
    """Return the environment of a run: one thread for each rank, MPI also as
    root (as in a container). Variables that are set already keep their value."""
    defaults = {
        "OMP_NUM_THREADS": "1",
        "DEAL_II_NUM_THREADS": "1",
        "OMPI_ALLOW_RUN_AS_ROOT": "1",
        "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
        # where /sys is not mounted hwloc complains into the output
        "HWLOC_HIDE_ERRORS": "2",
        # mpirun need not explain an exit status that is not 0: the program has. Open
        # MPI 5 does not know this, and has no such choice.
        "OMPI_MCA_orte_execute_quiet": "1",
    }
    if not set(BATCH) & set(os.environ):
        # ranks of one host share memory: without a network Open MPI complains of TCP,
        # and its libraries for networks take longer to start than many runs
        defaults["OMPI_MCA_btl"] = "^tcp,ofi,openib"
        defaults["OMPI_MCA_pml"] = "ob1"
    return {**defaults, **os.environ}


def refuse_missing(program: Path) -> None:
    """Refuse a program that is not there. Raises RunError."""
    if shutil.which(program) is None:
        raise RunError(
            f"no program {program}: `scripts/build` builds it, and the environment"
            " variable CAISSON_MPM_PROGRAM names another one"
        )


STOPPING = threading.Lock()  # between a request to stop and the end of a program
FAILS = "the first steps of the run fail"  # what --validate warns of


def query(arguments: Sequence[str], program: Path = PROGRAM) -> str:
    """Return what the program says without a run, as with --validate. Raises RunError
    with that where it refuses the input."""
    refuse_missing(program)
    for path in filter(Path.is_file, map(Path, arguments)):
        disk.note_reading(path)
    done = subprocess.run(
        [str(program), *arguments],
        text=True,
        errors="surrogateescape",  # of a path
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env=environment(),
    )
    if done.returncode != Status.SUCCESS:
        raise RunError(done.stdout.strip())
    return done.stdout.strip()


def command_for(scene: Path, estimates: Sequence[str], *options: str) -> str:
    """Return the command that runs a scene, with these estimates beside it, as a shell
    reads it; options: further ones."""
    run = "caisson run" if INSTALLED else "scripts/run"
    name = shlex.quote(str(scene)) if scene.name[0] != "-" else f"./{scene}"
    return " ".join([run, *["--band"] * bool(estimates), *options, name])


def size_in(output: str) -> Size:
    """Return the size of a run of which --validate has said this."""
    points = re.search(r"^ *points +(\d+)\b", output, re.M)
    found = re.search(
        r"^ *duration +about ([\d.]+) to ([\d.]+) (s|min|h)\b", output, re.M
    )
    least, most = (
        float(found[i]) * SECONDS[found[3]] if found else 0.0 for i in (1, 2)
    )
    return Size(int(points[1]) if points else 0, most, least)


def read_parameters(
    arguments: Sequence[str], program: Path = PROGRAM
) -> dict[str, str]:
    """Return all entries in effect, {"Section/Entry": value}.

    arguments: a .prm file and options of the program. The program itself reads
    them and prints all entries, so that included files, options and defaults
    count as they do in a run. Raises RunError with what the program says where
    it refuses the input.
    """
    output = query([*arguments, "--print-parameters"], program)
    entries, sections = {}, list[str]()
    for line in map(str.strip, output.splitlines()):
        if line.startswith("subsection "):
            sections.append(line.split(maxsplit=1)[1])
        elif line == "end":
            sections.pop()
        elif line.startswith("set "):
            name, _, value = line[4:].partition("=")
            entries["/".join([*sections, name.strip()])] = value.strip()
    if sections or "Output/Directory" not in entries:
        raise RunError(f"{program} has not printed all entries: ...{output[-200:]}")
    return entries


def content_of(path: Path) -> str:
    """Return a hash of a file as it is now, nothing where there is none."""
    return hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""


digest = functools.lru_cache(content_of)  # of a file that is read once


class Run:
    """One call of the program: a scene with some entries set, in a directory of
    its own.

    A finished run leaves run_key.json there: a hash of all that its result
    depends on (the program's file, all entries in effect, the ranks that it asks for,
    but not those that execute() lends it: they change the last digits), the entries
    that it set, the exit status and the times. is_complete() compares the hash, so
    that a study repeats only what has changed, is gone or damaged. A directory with
    this file is the run's own, and its results there are replaced. Elsewhere the
    program puts earlier results aside, and everywhere those that have finished in a run
    of the user (is_of_user), who may overwrite them, and who repeats what has failed.
    Files with other names stay.
    """

    RECORD = "run_key.json"
    CHECKPOINT = "checkpoint.info"
    BESIDE = ("Output/Directory", "Installation/Phases")  # the result is the same
    BEFORE = "Installation/Directory"

    def __init__(
        self,
        scene: Path,
        entries: Entries | None = None,
        directory: Path | None = None,
        *,
        ranks: int = 1,
        binding: str = "none",
        program: Path = PROGRAM,
    ) -> None:
        """scene: a .prm file; entries: {"Section/Entry": value}; directory: of
        the results, that of the scene if None; ranks and their binding
        ("none" or "core") as of mpirun."""
        self.scene, self.entries = scene, dict(entries or {})
        self.ranks, self.binding, self.program = ranks, binding, program
        self.restarts = False  # from its checkpoint
        self.is_of_user = self.overwrites = False  # and not of a study
        # of the program, or of mpirun, while it runs
        self.process_id: int | None = None
        self.asked_to_stop: int | None = None
        self.directory = directory or Path(self.in_effect["Output/Directory"])

    @functools.cached_property
    def in_effect(self) -> dict[str, str]:
        """All entries in effect. Raises RunError where the program refuses the
        input."""
        return read_parameters(
            [str(self.scene), *set_options(self.entries)], self.program
        )

    def command(self, ranks: int | None = None) -> list[str]:
        """Return the command line; ranks: others than those of the run."""
        return [
            *mpi_command(ranks or self.ranks, self.binding),
            str(self.program),
            *self.arguments(),
        ]

    def arguments(self) -> list[str]:
        """Return the scene and the options."""
        options = ["--output-directory", str(self.directory)]
        return [str(self.scene), *options, *set_options(self.entries)]

    def validate(self) -> Size:
        """Let the program check the input without running it; return the size of the
        run. Raises RunError with what it says where it refuses the input."""
        return size_in(query([*self.arguments(), "--validate"], self.program))

    def resume(self) -> None:
        """Let the run go on from the checkpoint of one that has not ended, if there is
        one that the program accepts for these entries, and that is not of an earlier
        installation."""
        if (
            self.has_checkpoint
            and not self.left(self.RECORD)  # else it has ended
            and self.completion_record() is None
            and not self.is_before_its_start(self.CHECKPOINT)
        ):
            try:
                query([*self.arguments(), "--restart", "--validate"], self.program)
            except RunError:
                return
            self.restarts = True

    @property
    def has_checkpoint(self) -> bool:
        """Whether there is a checkpoint, of whatever run."""
        return (self.directory / self.CHECKPOINT).is_file()

    @functools.cached_property
    def begins_from(self) -> Path | None:
        """The directory of the installation that it goes on from, if it has one."""
        before = self.in_effect.get(self.BEFORE)
        return (WORK / before).resolve() if before else None

    def begins_anew(self, status: Status | None) -> bool:
        """Let a run of a study that was to go on from its checkpoint begin anew where
        it has not, by its exit status, as its results are lost; return whether it is to
        be executed again."""
        is_refused = status == Status.BAD_INPUT or (
            status == Status.SUCCESS and self.completion_record() is None
        )
        if not (self.restarts and is_refused) or self.is_of_user:
            return False
        self.restarts, self.overwrites = False, True
        return True

    def is_before_its_start(self, name: str) -> bool:
        """Return whether a file of results is older than the installation that it goes
        on from, which then is another one."""
        history = self.begins_from and self.begins_from / "history.csv"
        if not history or not history.is_file():
            return False
        return (self.directory / name).stat().st_mtime < history.stat().st_mtime

    @functools.cached_property
    def key(self) -> str:
        """A hash of what the result depends on. Raises RunError where the program
        refuses the input."""
        entries = {k: v for k, v in self.in_effect.items() if k not in self.BESIDE}
        if place := self.begins_from:  # both may be moved together
            where = os.path.relpath(place, self.directory.resolve())
            entries[self.BEFORE] = f"{where}: {content_of(place / 'history.csv')}"
        text = json.dumps([entries, self.ranks, digest(self.program)], sort_keys=True)
        return hashlib.sha256(text.encode()).hexdigest()

    def entry_texts(self) -> dict[str, str]:
        """Return the entries that are set, as a .prm file has them."""
        return {entry: in_words(value) for entry, value in self.entries.items()}

    def completion_record(self) -> dict[str, Any] | None:
        """Return what a finished run has left: key, entries, status, wall_s and
        cpu_s. None where there is none, or a broken one, or where its results are."""
        from caisson.results import damage_of  # by numpy, which may be missing

        left, keys = self.left(self.RECORD), "key entries status wall_s cpu_s".split()
        found = left if set(keys) <= set(left) else self.record_of_user()
        is_good = found is not None and found["status"] == Status.SUCCESS
        return None if is_good and damage_of(self.directory) else found

    def is_of_another_scene(self) -> bool:
        """Return whether an entry in effect has another value in run.json there: the
        scene has changed since."""
        summary = self.left("run.json")
        known = {**summary.get("defaults", {}), **summary.get("entries", {})}
        try:
            common = (known.keys() & self.in_effect.keys()) - {
                *self.BESIDE,
                self.BEFORE,
            }
        except RunError:
            return bool(known)
        return any(known[name] != self.in_effect[name] for name in common)

    def record_of_user(self) -> dict[str, Any] | None:
        """Return the record of a finished run of these entries that the user has called
        himself, with this program; None where there is none."""
        summary = self.left("run.json")
        try:
            known = {**summary["defaults"], **summary["entries"]}
            names = ({*known} | {*self.in_effect}) - {*self.BESIDE}
            # the program leaves out layers that are not there
            names = {k for k in names if k in known or "Soil/Layer" not in k}
            same = all(self.in_effect[k] == known[k] for k in names)
            files = self.directory / "run.json", self.program
            written, built = (file.stat().st_mtime for file in files)
            is_earlier = written < built or self.is_before_its_start("run.json")
        except (RunError, OSError, LookupError, TypeError):
            return None
        if summary.get("status") != "finished" or not same or is_earlier:
            return None
        found = dict.fromkeys(("wall_s", "cpu_s"), summary.get("wall_time_s", 0.0))
        found |= {"entries": self.entry_texts(), "status": Status.SUCCESS}
        return found | {"key": self.key}

    def left(self, name: str) -> dict[str, Any]:
        """Return what a file of JSON in the directory holds, nothing of a broken
        one."""
        try:
            found = json.loads((self.directory / name).read_text("utf-8"))
        except (OSError, ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}

    def share_done(self, elapsed: float) -> float:
        """Return what part of the time of a run is over after so many seconds, by the
        time that it expects to need still; 0 where it says none."""
        try:
            with open(self.directory / "log", "rb") as log:
                log.seek(-min(log.seek(0, os.SEEK_END), 1000), os.SEEK_END)
                found = re.findall(rb"\| ETA (\d+):(\d+):(\d+)", log.read())
        except OSError:
            return 0.0
        if not found:
            return 0.0
        hours, minutes, seconds = map(int, found[-1])
        left = 3600 * hours + 60 * minutes + seconds
        return elapsed / max(elapsed + left, 1e-9)

    def is_complete(self) -> bool:
        """Return whether the results there are those of this run."""
        record = self.completion_record()
        if record is None or (self.is_of_user and record["status"] != Status.SUCCESS):
            return False
        try:
            return bool(record["key"] == self.key)
        except RunError:
            return False

    def call(self, overwrite: bool = False, echo: bool = False) -> None:
        """Run the program as its user does: it keeps earlier results in the directory
        unless it is to overwrite them.

        echo: print its lines as they come. An interrupt (Ctrl-C) stops the run with a
        checkpoint. Raises RunError with what the program says where it does not
        succeed; a run that is stopped otherwise is no error.
        """
        command = [*self.command(), *(["--overwrite"] if overwrite else [])]
        with (
            tempfile.TemporaryFile("w+", errors="surrogateescape") as errors,
            subprocess.Popen(
                command,
                text=True,
                errors="surrogateescape",
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=errors,
                start_new_session=True,  # an interrupt comes to us alone
                env=environment(),
            ) as process,
        ):
            self.process_id = process.pid
            last = collections.deque[str](maxlen=1)
            assert process.stdout
            try:
                for line in process.stdout:
                    last.append(line)
                    if echo:
                        print(line, end="", flush=True)
            except KeyboardInterrupt:
                self.stop()
                process.communicate()
                raise
            finally:
                self.forget_stop()
            status = process.wait()
            errors.seek(0)
            said = errors.read().strip() or "".join(last).strip()
        if status not in (Status.SUCCESS, Status.STOPPED):
            raise RunError(f"{said}\n(exit status {status}, results: {self.directory})")

    @property
    def stop_file(self) -> Path | None:
        """The file that stops it, None where it has none."""
        try:
            name = self.in_effect["Run control/Stop file"]
        except RunError:  # it will not run
            return None
        return self.directory / name if name else None

    def stop(self, at_once: bool = False) -> None:
        """Ask the program, if it runs, to stop with a checkpoint: by the stop file, as
        mpirun ends ranks that get a signal before they have written theirs. at_once:
        by a signal all the same. Asked for again, it does nothing."""
        with STOPPING:
            process = self.process_id
            if process is None or (process == self.asked_to_stop and not at_once):
                return
            self.asked_to_stop = process
            if not at_once and (file := self.stop_file) and self.directory.is_dir():
                with contextlib.suppress(OSError):
                    file.touch()
                    return
            with contextlib.suppress(ProcessLookupError):
                os.kill(process, signal.SIGTERM)

    def forget_stop(self) -> None:
        """Remove the stop file of a program that has ended, if it has not done so."""
        with STOPPING:
            self.process_id = None
            if self.asked_to_stop and (file := self.stop_file):
                file.unlink(missing_ok=True)

    def make_room(self) -> list[str]:
        """Make the directory; return the options with which the program goes on there,
        or begins and removes what is there. Its record begins anew, and then its log.
        """
        record = self.directory / self.RECORD
        is_own = record.is_file()
        has_ended = self.left(self.RECORD).get("status") == Status.SUCCESS
        disk.make_directory(self.directory, RunError)
        record.unlink(missing_ok=True)
        if is_own and not self.restarts:
            (self.directory / "log").unlink(missing_ok=True)
        is_kept = self.restarts or (self.is_of_user and has_ended)
        how = ["--restart"] if self.restarts else []
        return how + ["--overwrite"] * (self.overwrites or (is_own and not is_kept))

    def execute(
        self, time_limit: float | None = None, ranks: int | None = None
    ) -> Status | None:
        """Run the program, its output in the file log; ranks: lent to it, others than
        those of the run.

        Returns the exit status, None if it took longer than time_limit (s) and
        was ended, or was ended by a signal. Raises RunError where another process
        computes in the directory.
        """
        if is_locked(self.directory):
            raise RunError(f"another process computes in {self.directory}")
        with contextlib.suppress(RunError):  # which the program says in the log
            _ = self.key  # as the input is now, which may change while it runs
        command = [*self.command(ranks), *self.make_room()]
        begin = time.monotonic()
        with open(self.directory / "log", "a", encoding="utf-8") as log:
            process = subprocess.Popen(
                command,
                stdout=log,
                stderr=log,
                cwd=WORK,
                env=environment(),
                start_new_session=True,  # signals come to us alone
            )
            self.process_id = process.pid
            clock = threading.Timer(time_limit or 0, process.kill)
            if time_limit is not None:
                clock.start()
            _, code, used = os.wait4(process.pid, 0)
            clock.cancel()
            self.forget_stop()
        status = process.returncode = os.waitstatus_to_exitcode(code)
        if status not in (Status.SUCCESS, Status.FAILURE):
            return Status(status) if status in list(Status) else None
        record = {
            "key": self.key,
            "entries": self.entry_texts(),
            "status": status,
            "wall_s": time.monotonic() - begin,
            "cpu_s": used.ru_utime + used.ru_stime,
        }
        disk.write(self.directory / self.RECORD, json.dumps(record))
        return Status(status)
