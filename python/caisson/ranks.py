# SPDX-License-Identifier: LGPL-2.1-or-later
"""How many ranks a run takes, and how the runs of a study share the cores.

A rank pays where it has 2,500 points. Measured with scripts at a time that the machine
did nothing else (AMD EPYC with AVX-512, two cores, Open MPI 4.1), steps per second of
two ranks over those of one, and what speed_up() gives:

    scene                             points     two ranks     speed_up()
    prm/column.prm                       640     0.9 to 1.0          0.7
    tests/simulation/jack.prm          3,760     1.1 to 1.4          1.2
    the same, Refinement = 2          13,800     1.5 to 1.6          1.6
    prm/jack_refined.prm              27,100     1.5 to 1.7          1.7
    prm/suction_coupled.prm           37,900     1.4 to 1.8          1.7
    prm/jack.prm                      42,000     1.6 to 1.8          1.7
    tests/simulation/jack.prm, x 4    54,300     1.9                 1.8

Two ranks thus are faster than one from about 2,000 points on, and with 5,000 by a
quarter. More than two ranks have not been measured. Results differ in the last digits.

A step of N points on one rank costs as much as N + STEP points, and on P ranks as much
as IMBALANCE N / P + MESSAGES.
"""
import heapq
import math
import os
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

POINTS_PER_RANK = 2500
STEP, MESSAGES, IMBALANCE = 1000, 1900, 1.1
CPUS = Path("/sys/devices/system/cpu")
QUOTA = Path("/sys/fs/cgroup/cpu.max")


def physical_cores(allowed: set[int]) -> int:
    """Return how many cores these processors are: two of them may share one."""
    found = set()
    for number in allowed:
        topology = CPUS / f"cpu{number}/topology"
        try:
            names = ("physical_package_id", "core_id")
            found.add(tuple((topology / name).read_text() for name in names))
        except OSError:  # /sys is not there
            found.add((str(number), ""))
    return len(found)


def quota() -> float:
    """Return how many processors the container allows, infinite without a limit."""
    try:
        most, period = QUOTA.read_text(encoding="ascii").split()
        return int(most) / int(period)
    except (OSError, ValueError):  # there is none, or it is called max
        return math.inf


def cores() -> int:
    """Return the number of cores that this process may use."""
    return int(max(1, min(physical_cores(os.sched_getaffinity(0)), quota())))


def speed_up(points: float, ranks: int) -> float:
    """Return the speed on some ranks over that on one."""
    if ranks == 1:
        return 1.0
    return (points + STEP) / (IMBALANCE * points / ranks + MESSAGES)


def can_start_ranks() -> bool:
    """Return whether there is a command that starts several ranks."""
    return shutil.which("mpirun") is not None


def ranks_for(points: float, most: int) -> int:
    """Return the number of ranks that pays, of at most so many."""
    return int(max(1, min(most, points // POINTS_PER_RANK)))


def choose(points: int) -> tuple[int, str]:
    """Return the number of ranks of a single run, and why, in words."""
    most = cores()
    ranks = ranks_for(points, most)
    if most == 1:
        return 1, "one core is available"
    if ranks == 1:
        return 1, f"{points} points are too few for more: {POINTS_PER_RANK} a rank pay"
    if not can_start_ranks():
        return 1, "mpirun is missing; the package mpi-default-bin has it"
    return ranks, f"{points} points, {most} cores; {POINTS_PER_RANK} points a rank pay"


@dataclass(frozen=True)
class Size:
    """What a run is going to take: its points, and the most and the least seconds on
    one core, all 0 where they are not known."""

    points: int = 0
    seconds: float = 0.0
    least: float = 0.0


@dataclass(frozen=True)
class Plan:
    """How runs share the cores, the longest first: so many of them on a rank each, and
    then the others on several ranks; seconds: until all have ended."""

    runs: int
    alone: int
    cores: int
    ranks: int  # of the others
    seconds: float

    def __str__(self) -> str:
        """Say it."""
        alone = f"{self.cores} at a time on one rank each"
        last = f"{self.cores // self.ranks} at a time on {self.ranks} ranks each"
        if self.alone == self.runs:
            return alone
        return f"{self.alone} of them {alone}, then {last}" if self.alone else last


def time_of(seconds: Sequence[float], at_a_time: int) -> float:
    """Return when the last of some runs has ended, which begin in this order."""
    ends = [0.0] * at_a_time
    for duration in seconds:
        heapq.heappush(ends, heapq.heappop(ends) + duration)
    return max(ends)


def plan(sizes: Sequence[Size], most: int) -> Plan:
    """Return the fastest plan for runs, the longest first, on so many cores.

    Runs side by side waste nothing, so that several ranks pay only for the last runs,
    which are fewer than the cores.
    """
    n, seconds = len(sizes), [size.seconds for size in sizes]
    best = Plan(n, n, most, 1, time_of(seconds, most))
    most_last = min(n, most) if can_start_ranks() else 0
    for last in range(1, most_last + 1):
        begin = time_of(seconds[: n - last], most)
        bearable = min(ranks_for(size.points, most) for size in sizes[n - last :])
        for side_by_side in range(1, last + 1):
            ranks = min(most // side_by_side, bearable)
            if ranks < 2:
                continue
            times = [s.seconds / speed_up(s.points, ranks) for s in sizes[n - last :]]
            end = begin + time_of(times, most // ranks)
            if end < best.seconds:
                best = Plan(n, n - last, most, ranks, end)
    return best
