# SPDX-License-Identifier: LGPL-2.1-or-later
"""One call of the program within limits of time and memory, and what is wrong
with how it ended."""
import os
import re
import resource
import signal
import subprocess
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from caisson.runner import Status, environment

# s; of processor time, since the machine may do other things, and of wall time
PROCESSOR_LIMIT, WALL_LIMIT = 20.0, 600.0
# bytes of address space; what the libraries map is about 1 GB of it
MEMORY_LIMIT = 6 * 2**30
# what a user cannot make anything of: other programs' words, and C++'s
FOREIGN = re.compile(
    r"std::|terminate called|what\(\)|vector::|basic_string|map::at|_M_\w+|bad_alloc"
    r"|\bsto[dilu]+\b|regex_error|filesystem error|iostream"
    r"|An error occurred in line|violated condition|ExcMessage|Additional information"
    r"|Stacktrace|Errc:|Parsing Error|HDF5-DIAG|H5[A-Z]\w+\(|MPI_ABORT"
    r"|Segmentation|Process received signal|core dumped|runtime error:|Assertion"
)
OWN_WORDS = {
    Status.BAD_INPUT: re.compile(r"^bad input: \S", re.M),
    Status.FAILURE: re.compile(r"^failure: \S", re.M),
}


@dataclass(frozen=True)
class Outcome:
    """How a call has ended."""

    status: int  # below 0: the signal
    words: str
    wall_s: float
    processor_s: float
    memory: int  # bytes, the most it had
    is_ended: bool  # by us, since it took too long

    def complaint(self) -> str:
        """Return what is wrong with it, nothing where all is well."""
        if self.is_ended or self.processor_s > PROCESSOR_LIMIT:
            return f"took {self.processor_s:.0f} s of processor time"
        if self.status < 0:
            return f"died of {signal.Signals(-self.status).name}"
        if self.status not in list(Status):
            return f"exit status {self.status}"
        foreign = FOREIGN.search(self.words)
        if foreign:
            return f"says {foreign.group()!r}"
        own = OWN_WORDS.get(Status(self.status))
        if own and not own.search(self.words):
            return f"exit status {self.status} without a message"
        return ""


def call(
    words: Sequence[object],
    directory: Path,
    *,
    kill_after: float | None = None,
    wall_limit: float = WALL_LIMIT,
) -> Outcome:
    """Run the program in a directory to its end.

    kill_after: the wall time after which it gets SIGKILL (s), if it still runs;
    wall_limit: the same for a run that hangs.
    """
    begin = time.monotonic()
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(
            list(map(str, words)),
            cwd=directory,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            env=environment(),
        )
        try:
            limits = (MEMORY_LIMIT, MEMORY_LIMIT)
            resource.prlimit(process.pid, resource.RLIMIT_AS, limits)
            resource.prlimit(process.pid, resource.RLIMIT_CORE, (0, 0))
        except ProcessLookupError:
            pass  # it has ended already
        limit = begin + (wall_limit if kill_after is None else kill_after)
        is_ended, code, used = wait(process.pid, limit)
        process.returncode = os.waitstatus_to_exitcode(code)
        output.seek(0)
        text = output.read().decode("utf-8", errors="replace")
    return Outcome(
        process.returncode,
        text,
        time.monotonic() - begin,
        used.ru_utime + used.ru_stime,
        used.ru_maxrss * 1024,
        is_ended and kill_after is None,
    )


def wait(pid: int, limit: float) -> tuple[bool, int, resource.struct_rusage]:
    """Wait for a process, and kill it at this time of the monotonic clock. Return
    whether that was needed, its code and what it has used."""
    pause = 0.002
    while time.monotonic() < limit:
        found, code, used = os.wait4(pid, os.WNOHANG)
        if found:
            return False, code, used
        time.sleep(min(pause, max(0.0, limit - time.monotonic())))
        pause = min(1.2 * pause, 0.05)
    os.kill(pid, signal.SIGKILL)
    _, code, used = os.wait4(pid, 0)
    return True, code, used
