# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far many runs are: a bar at the foot of a terminal; elsewhere a line now and
then, so that a log file has whole lines only."""
import os
import shutil
import sys
import threading
import time
from collections.abc import Callable, Sequence
from typing import Self, TextIO

from caisson.terminal import CLEAR

INTERVAL = 1.0  # s
# of lines in a log file: the least time (s), and the least part of the work
SILENCE, STEP = 10.0, 0.05
BAR = 24  # characters
ALMOST = 0.95  # a run that takes longer than expected counts so much until its end


def duration(seconds: float) -> str:
    """Return a time as an estimate, with two digits."""
    if seconds < 90:
        return f"{seconds:.2g} s"
    return f"{seconds / 60:.2g} min" if seconds < 5400 else f"{seconds / 3600:.2g} h"


def span(least: float, most: float) -> str:
    """Return a range of times: "3 to 6 min"."""
    first, last = duration(least), duration(most)
    unit = " " + last.split()[1]
    return last if first == last else f"{first.removesuffix(unit)} to {last}"


class Progress:
    """What is done of some runs, drawn each INTERVAL on a terminal, and said elsewhere
    after each STEP.

    Safe to use from several threads. A context: the bar is gone at its end.
    """

    def __init__(
        self,
        durations: Sequence[float],
        stream: TextIO | None = None,
        share_of: Callable[[int], float] = lambda _: 0.0,
    ):
        """durations: of the runs (s); those of 0 are not known and count as the mean of
        the others. stream: of the bar, default: the errors of this process. share_of:
        what part of a run is done, as far as that run says it, else 0."""
        known = [x for x in durations if x > 0] or [1.0]
        mean = sum(known) / len(known)
        self.expected = [x if x > 0 else mean for x in durations]
        self.stream = stream or sys.stderr
        is_dumb = os.environ.get("TERM", "dumb") == "dumb"
        self.has_bar = self.stream.isatty() and not is_dumb
        self.share_of = share_of
        self.said = 0.0, time.monotonic()  # share and time of the last line
        self.begin = time.monotonic()
        self.begins: dict[int, float] = {}  # of the runs that are running
        self.took: dict[int, float] = {}  # those that have ended (s)
        self.lock = threading.RLock()
        self.is_over = threading.Event()
        self.thread = threading.Thread(target=self._draw_repeatedly, daemon=True)

    def __enter__(self) -> Self:
        """Begin to draw."""
        if self.expected:
            self.thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        """Remove the bar."""
        self.is_over.set()
        if self.thread.is_alive():
            self.thread.join()

    def start(self, number: int) -> None:
        """Say that the run of this number, from 0, begins."""
        with self.lock:
            self.begins[number] = time.monotonic()

    def end(self, number: int) -> None:
        """Say that a run has ended."""
        with self.lock:
            self.took[number] = time.monotonic() - self.begins.pop(number)
            if self.thread.is_alive():
                self._draw()

    def say(self, text: str) -> None:
        """Print a line in the place of the bar, which comes back below it."""
        with self.lock:
            self._clear()
            print(text, flush=True)

    @property
    def scale(self) -> float:
        """The time that runs take over the time that was expected of them; 1 before one
        has ended."""
        expected = sum(self.expected[i] for i in self.took)
        return sum(self.took.values()) / expected if expected else 1.0

    @property
    def share(self) -> float:
        """The part of the work that is done, from 0 to 1."""
        now, work = time.monotonic(), sum(self.expected[i] for i in self.took)
        scale = max(self.scale, 1e-9)
        for number, begin in self.begins.items():
            expected = self.expected[number]
            told = self.share_of(number) * expected
            work += told or min((now - begin) / scale, ALMOST * expected)
        return work / sum(self.expected)

    def words(self) -> tuple[float, str]:
        """Return the share, and in words how far the runs are."""
        with self.lock:
            share, n_done = self.share, len(self.took)
            is_told = any(self.share_of(number) > STEP for number in self.begins)
        text = f"{n_done} of {len(self.expected)} runs, {100 * share:.0f} %"
        if n_done or is_told:  # else it is not known how good the expectations are
            left = (time.monotonic() - self.begin) * (1 - share) / share
            text += f", about {duration(max(left, 0))} left"
        return share, text

    def line(self, width: int) -> str:
        """Return the bar for a terminal of so many characters."""
        share, text = self.words()
        full = int(BAR * share)
        return f"[{'#' * full}{'.' * (BAR - full)}] {text}"[: width - 1]

    def _clear(self) -> None:
        """Remove the bar from a terminal."""
        if self.has_bar and self.thread.is_alive():
            self.stream.write(CLEAR)
            self.stream.flush()

    def _draw(self) -> None:
        """Write the bar over the last one, or a line where there is something to say
        that is new."""
        if not self.has_bar:
            share, text = self.words()
            now = time.monotonic()
            if share >= self.said[0] + STEP and now >= self.said[1] + SILENCE:
                self.said = share, now
                print(text, file=self.stream, flush=True)
            return
        width = shutil.get_terminal_size().columns
        self.stream.write(f"{CLEAR}{self.line(width)}")
        self.stream.flush()

    def _draw_repeatedly(self) -> None:
        """Draw until it is over."""
        while not self.is_over.wait(INTERVAL):
            with self.lock:
                self._draw()
        with self.lock:
            self._clear()
