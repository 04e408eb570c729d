# SPDX-License-Identifier: LGPL-2.1-or-later
"""Estimates the time of a step on up to 1,000 ranks, from what was measured on two.

A step of N points on P ranks takes

    t = i N t_p / P + t_s                    work of a rank
        + n_m L + 4 m sqrt(N / (q P)) / B    messages to neighbors
        + n_c L ceil(log2 P)                 collective operations

t_p: time of a point; t_s: of a step without points; n_m: number of messages to one
neighbor (those to several neighbors are on their way at the same time); n_c: number of
collective operations; m: bytes sent for each cell on one of the four sides of a part,
which is taken for a square with q points in each cell. These are measured. Assumed
are the imbalance i, and latency L and bandwidth B of the network: see NETWORKS. With
several ranks on a machine, B is the share of one.

What the model leaves out: frames and checkpoints, the time that memory takes away if
all cores of a machine work, noise, and the memory and time of what every rank knows
of the whole mesh (the lines, and which cells are halved).
"""
import argparse
import math
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Network:
    """What lies between two ranks."""

    name: str
    latency: float  # s, of a small message
    bandwidth: float  # bytes/s, of one rank


@dataclass(frozen=True)
class Work:
    """What a step consists of; the defaults are measured, but for the imbalance. See
    lab/notes/two_hosts.md for scenes and commands."""

    seconds_per_point: float = 50e-9
    seconds_per_step: float = 40e-6
    points_per_cell: float = 8.0
    imbalance: float = 1.1
    messages: float = 16.0
    collectives: float = 2.6
    bytes_per_side_cell: float = 870.0


NETWORKS = (
    Network("InfiniBand", 2e-6, 1e9),
    Network("Ethernet", 30e-6, 1e8),
)
RANKS = (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1000)
SIDES = 4


def step_time(points: float, ranks: int, network: Network, work: Work) -> float:
    """Return the time of a step (s)."""
    own = points * work.seconds_per_point / ranks + work.seconds_per_step
    if ranks == 1:
        return own
    own += (work.imbalance - 1) * points * work.seconds_per_point / ranks
    side = math.sqrt(points / (work.points_per_cell * ranks))
    border = SIDES * side * work.bytes_per_side_cell
    neighbors = work.messages * network.latency + border / network.bandwidth
    levels = math.ceil(math.log2(ranks))
    return own + neighbors + work.collectives * network.latency * levels


def table(points: float, ranks: Sequence[int], work: Work) -> str:
    """Return the times, speed-ups and efficiencies (%) as a table of Markdown."""
    head = "| ranks | points per rank |"
    rule = "|---|---|"
    for network in NETWORKS:
        head += f" {network.name} (ms) | speed-up | % |"
        rule += "---|---|---|"
    lines = [head, rule]
    for n in ranks:
        line = f"| {n} | {points / n:,.0f} |"
        for network in NETWORKS:
            seconds = step_time(points, n, network, work)
            gain = step_time(points, 1, network, work) / seconds
            line += f" {1e3 * seconds:.3g} | {gain:.3g} | {100 * gain / n:.0f} |"
        lines.append(line)
    return "\n".join(lines)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab scaling`."""
    sizes = (1e5, 1e7)
    parser.add_argument("--points", type=float, nargs="+", default=sizes, metavar="N")
    parser.add_argument("--ranks", type=int, nargs="+", default=RANKS, metavar="P")


def main(options: argparse.Namespace) -> int:
    """Print the tables."""
    for points in options.points:
        print(f"\n{points:,.0f} points\n\n{table(points, options.ranks, Work())}")
    return 0
