# SPDX-License-Identifier: LGPL-2.1-or-later
"""How far many runs are: a bar at the foot of a terminal, and nothing elsewhere, so
that a log file has whole lines only."""
import os
import shutil
import sys
import threading
import time
from collections.abc import Sequence
from typing import Self, TextIO

INTERVAL = 1.0  # s
BAR = 24  # characters
ALMOST = 0.95  # a run that takes longer than expected counts so much until its end


def duration(seconds: float) -> str:
    """Return a time as an estimate, with two digits."""
    if seconds < 90:
        return f"{seconds:.2g} s"
    return f"{seconds / 60:.2g} min" if seconds < 5400 else f"{seconds / 3600:.2g} h"


def is_terminal(stream: TextIO) -> bool:
    """Return whether a line on the stream can be written over."""
    return stream.isatty() and os.environ.get("TERM", "dumb") != "dumb"


class Progress:
    """What is done of some runs, drawn each INTERVAL on a terminal.

    Safe to use from several threads. A context: the bar is gone at its end.
    """

    def __init__(self, durations: Sequence[float], stream: TextIO | None = None):
        """durations: of the runs (s); those of 0 are not known and count as the mean of
        the others. stream: of the bar, default: the errors of this process."""
        known = [x for x in durations if x > 0] or [1.0]
        mean = sum(known) / len(known)
        self.expected = [x if x > 0 else mean for x in durations]
        self.stream = stream or sys.stderr
        self.begin = time.monotonic()
        self.begins: dict[int, float] = {}  # of the runs that are running
        self.took: dict[int, float] = {}  # those that have ended (s)
        self.lock = threading.RLock()
        self.is_over = threading.Event()
        self.thread = threading.Thread(target=self._draw_repeatedly, daemon=True)

    def __enter__(self) -> Self:
        """Begin to draw."""
        if self.expected and is_terminal(self.stream):
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
            work += min((now - begin) / scale, ALMOST * self.expected[number])
        return work / sum(self.expected)

    def line(self, width: int) -> str:
        """Return the bar for a terminal of so many characters."""
        with self.lock:
            share, n_done = self.share, len(self.took)
        full = int(BAR * share)
        text = f"[{'#' * full}{'.' * (BAR - full)}] {n_done} of {len(self.expected)}"
        text += f" runs, {100 * share:.0f} %"
        if n_done:  # before, it is not known how good the expectations are
            left = (time.monotonic() - self.begin) * (1 - share) / share
            text += f", about {duration(left)} left"
        return text[: width - 1]

    def _clear(self) -> None:
        """Remove the bar from a terminal."""
        if self.thread.is_alive():
            self.stream.write("\r\x1b[K")
            self.stream.flush()

    def _draw(self) -> None:
        """Write the bar over the last one."""
        width = shutil.get_terminal_size().columns
        self.stream.write(f"\r\x1b[K{self.line(width)}")
        self.stream.flush()

    def _draw_repeatedly(self) -> None:
        """Draw until it is over."""
        while not self.is_over.wait(INTERVAL):
            with self.lock:
                self._draw()
        with self.lock:
            self._clear()
