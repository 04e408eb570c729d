# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many runs: the engine of studies, parks, bands and error bars.

Each of them plans its runs, a list of StudyRun. survey() finds those that are to be
made, and make() makes them, on the cores at hand or on the workers of Dask
(python3-distributed), which share the folder of the results and can import this
package. A run that is complete is not repeated while the program, all entries in effect
and the ranks are the same (caisson.runner.Run).
"""
import concurrent.futures
import contextlib
import signal
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from caisson import disk
from caisson.needed import DASK, sentence
from caisson.progress import Progress, span
from caisson.ranks import Size, cores, plan
from caisson.results import Results, damage_of
from caisson.runner import Run, RunError, Status

# runs for each core above which several ranks gain nothing that matters, and the
# duration of a run (s) below which it is not worth to ask for its size
FEW, LONG = 4, 20
MOST = 600  # characters of why the program refuses a run
COMPLETE, FAILED, NOT_RUN = "complete", "failed", "not run"  # outcomes
ENDED_EARLY = "ended early"  # by a signal
WAIT = 10  # s, for an answer of the scheduler


@dataclass
class StudyRun:
    """One run, with what its study says of it.

    variant and mesh are "" where the study has none; seconds is 0 where the file does
    not say them, and size has what the program says. trouble says why there is no
    result to evaluate, None if there is one; refusal what the program says where it
    does not accept the input.
    """

    study: str  # its id
    name: str
    run: Run
    settings: dict[str, Any] = field(default_factory=dict)
    variant: str = ""
    mesh: str = ""
    seconds: float = 0.0
    trouble: str | None = None
    size: Size = Size()
    is_stopped: bool = False  # by a stop file, say
    refusal: str = ""

    @property
    def results(self) -> Results:
        """What the run has left."""
        return Results(self.run.directory)

    @property
    def duration(self) -> float:
        """About how long it takes on one core (s), 0 if not known."""
        return self.seconds or self.size.seconds

    @property
    def status(self) -> Status | None:
        """The exit status of the finished run; without one None, and trouble says
        why."""
        record = self.run.completion_record()
        if record is None:
            self.trouble = self.trouble or f"no result in {self.run.directory}"
            return None
        return Status(record["status"])

    @property
    def log(self) -> Path:
        """What the program has said."""
        return self.run.directory / "log"

    @property
    def last_words(self) -> str:
        """What the program has said at its end, in a line: why it refused its input or
        failed, or its last line."""
        try:
            text = self.log.read_text(encoding="utf-8", errors="replace")
        except OSError:
            return ""
        lines = [disk.one_line(line) for line in text.splitlines()]
        for i, line in reversed(list(enumerate(lines))):
            if line.startswith("bad input: "):
                return " ".join(lines[i:]).split(": ", 1)[1]
            if line.startswith("failure: "):
                return line.split(": ", 1)[1]
        return lines[-1] if lines else ""

    @property
    def outcome(self) -> tuple[str, str]:
        """How it ended, and why if it failed. A result of other entries, as of a study
        before a change, does not count."""
        record = self.run.completion_record()
        if record is None:
            is_damaged = self.trouble is None and self.run.left(Run.RECORD)
            why = damage_of(self.run.directory) if is_damaged else self.trouble
            if why is None and not self.log.is_file():
                return NOT_RUN, ""
            return "no result", why or self.last_words
        if record.get("entries") != self.run.entry_texts():
            return "out of date", "the entries of the study have changed since"
        if self.run.is_of_another_scene():
            return "out of date", "the scene has changed since"
        if record["status"] != Status.SUCCESS:
            return FAILED, self.last_words
        return COMPLETE, ""

    @property
    def words(self) -> str:
        """How it ended, and why if it failed, in a line."""
        return disk.one_line(": ".join(filter(None, self.outcome)))

    @property
    def ranks_before(self) -> int | None:
        """The ranks of the run that has left the checkpoint: with others, the soil
        beneath a wall may slip to the other side."""
        ranks = self.run.left("run.json").get("ranks")
        return ranks if isinstance(ranks, int) else None

    def query_size(self) -> None:
        """Ask the program for its size; without one, refusal says why."""
        try:
            self.size = self.run.validate()
        except (RunError, OSError) as error:
            self.refusal = str(error)

    def execute(
        self,
        again: bool = False,
        time_limit: float | None = None,
        ranks: int | None = None,
    ) -> str:
        """Run it unless it is complete; return what it cost, "" of one that is."""
        if not again and self.run.is_complete():
            return ""
        if self.run.restarts:
            ranks = self.ranks_before or ranks
        try:
            status = self.run.execute(time_limit, ranks)
            if self.run.begins_anew(status):
                status = self.run.execute(time_limit, ranks)
        except (RunError, OSError) as error:
            self.trouble = str(error)
            return f"{self.study} {self.name}: {self.trouble}".lstrip()
        self.is_stopped = status == Status.STOPPED
        record = self.run.completion_record()
        if record is None:
            how = ENDED_EARLY if status is None else f"exit status {status}"
            how = "stopped" if self.is_stopped else how
            why = f": {self.last_words[:MOST]}" if status == Status.BAD_INPUT else ""
            self.trouble = f"{how}, see {self.log}{why}"
        cost = f"{record['wall_s']:.0f} s" if record else self.trouble
        if record and record["status"] == Status.FAILURE:
            cost = f"{cost}, ended with a failure"
        return f"{self.study} {self.name}".rstrip() + f": {cost}"


# runs, how many of them at a time, and their ranks, None for their own
Share = tuple[Sequence[StudyRun], int, int | None]


@dataclass(frozen=True)
class How:
    """How runs are made.

    again: those that are complete, too; jobs: at a time, None for what is fastest;
    dask: the address of a scheduler, as tcp://host:8786, "" for the cores at hand;
    time_limit: of each run (s); needs_all: none begins after one without a result.
    """

    again: bool = False
    jobs: int | None = None
    dask: str = ""
    time_limit: float | None = None
    needs_all: bool = False


def longest_first(runs: Sequence[StudyRun]) -> list[StudyRun]:
    """Return the runs in the order in which they begin."""
    return sorted(runs, key=lambda run: -run.duration)


def survey(
    runs: Sequence[StudyRun],
    again: bool = False,
    resumes: bool = False,
    asks_all: bool = False,
) -> list[StudyRun]:
    """Return the runs that are not complete, or all of them again, the longest first,
    with the sizes that are asked for where they are not known: of a few long ones,
    which several ranks may make faster, or of all. resumes: let those that were begun
    go on from their checkpoints, and say it."""
    with concurrent.futures.ThreadPoolExecutor(cores()) as pool:
        chosen = list(pool.map(lambda run: again or not run.run.is_complete(), runs))
        found = [run for run, is_chosen in zip(runs, chosen) if is_chosen]
        if resumes and not again:
            list(pool.map(lambda run: run.run.resume(), found))
        is_few = len(found) <= FEW * cores()
        unknown = [run for run in found if not run.size.points]
        long = [run for run in unknown if is_few and run.seconds >= LONG]
        list(pool.map(StudyRun.query_size, unknown if asks_all else long))
    for run in found:
        if run.run.restarts:
            print(f"{run.study} {run.name}: goes on from its checkpoint", flush=True)
    return longest_first(found)


def shares_of(runs: Sequence[StudyRun], jobs: int | None) -> list[Share]:
    """Return how runs, the longest first, share the cores, and say it; jobs: at a time,
    None for what is fastest. Runs whose study names their ranks have those."""
    times = [run.duration for run in runs]
    shares: list[Share]
    if jobs or any("ranks" in run.settings for run in runs):
        jobs = jobs or max(1, cores() // max(run.run.ranks for run in runs))
        how, seconds = f"{jobs} at a time", sum(times) / jobs
        shares = [(runs, jobs, None)]
    else:
        chosen = plan([Size(r.size.points, r.duration) for r in runs], cores())
        how, seconds, n = str(chosen), chosen.seconds, chosen.alone
        at_a_time = chosen.cores // chosen.ranks
        shares = [(runs[:n], cores(), None), (runs[n:], at_a_time, chosen.ranks)]
    least = sum(run.seconds or run.size.least for run in runs) / (sum(times) or 1)
    about = f", about {span(least * seconds, seconds)}" if all(times) else ""
    text = f"runs to do: {len(runs)}{about}, {how}" if runs else "runs to do: 0"
    print(text, flush=True)
    return shares


def client_of(address: str) -> Any:
    """Return a client of the scheduler at an address. Raises RunError where there is
    none, or no Dask."""
    try:
        from distributed import Client
    except ModuleNotFoundError as error:
        raise RunError(f"--dask: {sentence(DASK, 'python')}") from error
    try:
        client = Client(address, timeout=WAIT)
    except (OSError, ValueError, TimeoutError) as error:
        raise RunError(
            f"--dask: no scheduler answers at {address}; start one by dask-scheduler,"
            " and workers by dask-worker"
        ) from error
    if not client.nthreads():
        client.close()
        raise RunError(
            f"--dask: the scheduler at {address} has no worker; start some by"
            f" `PYTHONPATH=python dask-worker {address}`"
        )
    return client


def made(run: StudyRun, how: How, ranks: int | None) -> tuple[str, str | None, bool]:
    """Make a run; return what it says, its trouble, and whether it was stopped: all
    that comes back from a worker of Dask."""
    return run.execute(how.again, how.time_limit, ranks), run.trouble, run.is_stopped


def make(runs: Sequence[StudyRun], how: How = How()) -> None:
    """Make runs, the longest first. One that cannot be made says why in its trouble.
    Raises RunError where no worker of Dask can be asked."""
    if not how.dask:
        execute(shares_of(runs, how.jobs), how)
        return
    with client_of(how.dask) as client:
        n = sum(client.nthreads().values())
        print(f"runs to do: {len(runs)}, {n} at a time by Dask", flush=True)
        execute([(runs, n, None)], how, client)


@contextlib.contextmanager
def counted_signals() -> Iterator[list[int]]:
    """Give the list of what comes of Ctrl-C, SIGTERM and SIGHUP, which do nothing else
    meanwhile; not of one that is ignored, as by nohup. Only the main thread gets any.
    """
    came, before = list[int](), {}
    if threading.current_thread() is threading.main_thread():
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if signal.getsignal(number) != signal.SIG_IGN:
                before[number] = signal.signal(number, lambda n, _: came.append(n))
    try:
        yield came
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def has_raised(work: Future[None]) -> bool:
    """Return whether a computation has ended with an exception."""
    return work.done() and not work.cancelled() and work.exception() is not None


def wait_for(
    work: Sequence[Future[None]],
    runs: Sequence[StudyRun],
    came: Sequence[int],
    client: Any,
) -> None:
    """Wait for the computations of runs. On a signal that came, those that are computed
    stop with a checkpoint, on a later one at once, and no further one begins; then it
    is a KeyboardInterrupt. No further one begins either after one that has raised."""
    seen = 0
    while concurrent.futures.wait(work, 0.2).not_done:
        if client is not None and len(came) > seen:
            client.close()
        is_later, seen = 0 < seen < len(came), len(came)
        if seen or any(map(has_raised, work)):
            for each in work:
                each.cancel()
        if seen:
            for run in runs:
                run.run.stop(at_once=is_later)
    for each in work:
        if not each.cancelled():
            each.result()
    if came:
        raise KeyboardInterrupt


def execute(shares: Sequence[Share], how: How = How(), client: Any = None) -> None:
    """Make the runs of one share after the other, here or by a client of Dask. A bar,
    or in a log file a line now and then, shows how far all of them are."""
    sorted_shares = [(longest_first(runs), n, ranks) for runs, n, ranks in shares]
    ordered = [run for runs, _, _ in sorted_shares for run in runs]

    def share_of(number: int) -> float:
        begin = progress.begins.get(number, 0.0)
        return ordered[number].run.share_done(time.monotonic() - begin)

    def there(function: Callable[..., Any], *words: Any) -> Any:
        if client is None:
            return function(*words)
        return client.submit(function, *words, pure=False).result()

    def one(number: int, ranks: int | None) -> None:
        run = ordered[number]
        if how.needs_all and any(other.trouble for other in ordered):
            return
        progress.start(number)
        try:
            said, run.trouble, run.is_stopped = there(made, run, how, ranks)
        except Exception as error:  # whatever a worker of Dask hands on
            if client is None:
                raise
            run.trouble = disk.words_of(error)
            said = f"{run.study} {run.name}: {run.trouble}"
        if said:
            progress.say(said)
        progress.end(number)

    progress = Progress([run.duration for run in ordered], share_of=share_of)
    with progress, counted_signals() as came:
        first = 0
        for runs, jobs, ranks in sorted_shares:
            numbers = range(first, first + len(runs))
            with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
                work = [pool.submit(one, number, ranks) for number in numbers]
                wait_for(work, ordered, came, client)
            first += len(runs)
