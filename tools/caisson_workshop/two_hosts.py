# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a scene on two hosts and counts what they send each other.

The hosts are two network namespaces of this machine, joined by a cable of their own
(veth). Each has its own name, its own System V memory and its own /dev/shm, and Open
MPI may use nothing but TCP. The output directory is the same for both, as on a
cluster.

The history of the run is compared with that of the same ranks on one host, and a
longer run gives the volume of a step: the difference of both runs, over that of
their steps, is free of what is sent once. Bytes and packets of the cable contain
everything, headers and acknowledgments, too; messages and bytes of MPI are counted
by Open MPI's component "monitoring".

Needs root, for the namespaces, and ip (iproute2). Both namespaces end with the
command, however it ends.
"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from caisson.paths import PROGRAM, RESULTS, SCENES
from caisson.results import Results
from caisson.runner import Status, environment, mpi_command, set_options

NEEDED = ("ip", "mpirun", "unshare", "mount", "hostname")
ADDRESSES = ("10.97.83.1", "10.97.83.2")
CABLE = "cable0"
TCP_ONLY = """--mca btl tcp,self --mca pml ^ucx,cm --mca btl_tcp_if_include cable0
    --mca oob_tcp_if_include cable0""".split()
ONE_HOST = ("OMPI_MCA_btl", "OMPI_MCA_pml")  # of environment()
COUNT_MESSAGES = "--mca pml_monitoring_enable 2 --mca pml_monitoring_enable_output 3"
# a host: its name, and no memory that it shares with the other one
HOST = 'hostname "$0"; mount -t tmpfs tmpfs /dev/shm; exec "$@"'
AGENT = """#!/bin/sh
# what mpirun calls in place of ssh: HOST COMMAND...
shift
exec ip netns exec {namespace} unshare --uts --ipc --mount \\
  sh -c '{host}' host-2 sh -c "$*"
"""
QUIET: dict[str, object] = {
    "Output/Terminal": "silent",
    "Output/Frame interval": "never",
    "Output/Frame penetrations": "",
}
TOLERANCE = 1e-9  # of the columns of history.csv


@dataclass
class Traffic:
    """What the ranks of a run have sent."""

    steps: int
    packets: int  # over the cable, in both directions
    cable_bytes: int  # the same
    messages: Counter[int] = field(default_factory=Counter)  # by rank, to one other
    message_bytes: Counter[int] = field(default_factory=Counter)
    collectives: Counter[int] = field(default_factory=Counter)  # calls, by rank


def ip(*arguments: str) -> str:
    """Call ip. Raises CalledProcessError."""
    return subprocess.run(
        ["ip", *arguments], check=True, stdout=subprocess.PIPE, text=True
    ).stdout


@contextmanager
def two_namespaces() -> Iterator[tuple[str, str]]:
    """Make two network namespaces with a cable between them; yield their names."""
    first, second = (f"caisson-{os.getpid()}-{i}" for i in (1, 2))
    names = (first, second)
    try:
        for name in names:
            ip("netns", "add", name)
        ends = ["type", "veth", "peer", "name", CABLE, "netns", second]
        ip("link", "add", CABLE, "netns", first, *ends)
        for name, address in zip(names, ADDRESSES):
            ip("-n", name, "address", "add", f"{address}/30", "dev", CABLE)
            for device in ("lo", CABLE):
                ip("-n", name, "link", "set", device, "up")
        yield names
    finally:
        for name in names:
            subprocess.run(["ip", "netns", "delete", name], stderr=subprocess.DEVNULL)


def cable_counts(namespace: str) -> tuple[int, int]:
    """Return packets and bytes that went through the cable, in both directions."""
    text = ip("-n", namespace, "-s", "-j", "link", "show", CABLE)
    counts = json.loads(text)[0]["stats64"].values()
    sides = [side for side in counts if "packets" in side]
    return sum(s["packets"] for s in sides), sum(s["bytes"] for s in sides)


def read_profile(text: str, rank: int, traffic: Traffic) -> None:
    """Add what Open MPI has counted on a rank: lines E (messages of the program to
    one other rank) and, for each communicator, of three kinds of collectives."""
    for kind, n_bytes, n in re.findall(
        r"^(E|O2A|A2O|A2A)\t.*?(\d+) bytes\t(\d+) msgs sent", text, re.M
    ):
        if kind == "E":
            traffic.messages[rank] += int(n)
            traffic.message_bytes[rank] += int(n_bytes)
        else:
            traffic.collectives[rank] += int(n)


def run_on_two(
    namespaces: tuple[str, str], command: Sequence[str], per_host: int, scratch: Path
) -> tuple[int, int, list[str]]:
    """Run the program; return packets, bytes, and Open MPI's counts of each rank.
    Raises CalledProcessError."""
    for old in scratch.glob("count.*"):
        old.unlink()
    agent = scratch / "agent"
    agent.write_text(AGENT.format(namespace=namespaces[1], host=HOST))
    agent.chmod(0o700)
    hosts = ",".join(f"{address}:{per_host}" for address in ADDRESSES)
    start = ["ip", "netns", "exec", namespaces[0]]
    start += ["unshare", "--uts", "--ipc", "--mount", "sh", "-c", HOST, "host-1"]
    start += ["mpirun", "--host", hosts, "-np", str(2 * per_host), "--bind-to", "none"]
    start += ["--mca", "plm_rsh_agent", str(agent), *TCP_ONLY, *COUNT_MESSAGES.split()]
    start += ["--mca", "pml_monitoring_filename", str(scratch / "count")]
    start += ["--mca", "mpi_yield_when_idle", "1"]
    before = cable_counts(namespaces[0])
    # two hosts need TCP, which a run on one host does without
    with_network = {k: v for k, v in environment().items() if k not in ONE_HOST}
    subprocess.run([*start, *command], check=True, env=with_network)
    after = cable_counts(namespaces[0])
    counts = [
        (scratch / f"count.{rank}.prof").read_text(encoding="utf-8")
        for rank in range(2 * per_host)
    ]
    return after[0] - before[0], after[1] - before[1], counts


def traffic_of_run(
    namespaces: tuple[str, str], command: Sequence[str], per_host: int, directory: Path
) -> Traffic:
    """Run the program on two hosts; return what was sent."""
    with tempfile.TemporaryDirectory() as scratch:
        packets, n_bytes, counts = run_on_two(
            namespaces, command, per_host, Path(scratch)
        )
    steps = int(Results(directory).history["step"][-1])
    traffic = Traffic(steps, packets, n_bytes)
    for rank, text in enumerate(counts):
        read_profile(text, rank, traffic)
    return traffic


def largest_difference(a: Path, b: Path) -> float:
    """Return the largest difference of two histories, relative to the largest value
    of its column; infinite where they have other rows."""
    one, other = Results(a).history, Results(b).history
    worst = 0.0
    for name, x in one.items():
        y = other[name]
        if len(x) != len(y):
            return float("inf")
        scale = max(abs(x).max(), 1e-300)
        worst = max(worst, float(abs(x - y).max() / scale))
    return worst


def describe(short: Traffic, longer: Traffic) -> str:
    """Return the volume of a step."""
    steps = longer.steps - short.steps
    lines = [
        f"{steps} steps, of which each has",
        f"  on the cable, both ways: {(longer.packets - short.packets) / steps:8.1f}"
        f" packets {(longer.cable_bytes - short.cable_bytes) / steps:10.0f} bytes",
    ]
    for rank in sorted(longer.collectives):
        messages, n_bytes, calls = (
            (getattr(longer, name)[rank] - getattr(short, name)[rank]) / steps
            for name in ("messages", "message_bytes", "collectives")
        )
        lines.append(
            f"  rank {rank}: {messages:6.1f} messages to others, {n_bytes:8.0f} bytes,"
            f" {calls:5.1f} collectives"
        )
    return "\n".join(lines)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop two-hosts`."""
    scene = SCENES / "jack_coarse.prm"
    parser.add_argument(
        "scene", type=Path, nargs="?", default=scene, metavar="FILE.prm"
    )
    parser.add_argument("--ranks-per-host", type=int, default=1, metavar="N")
    parser.add_argument(
        "--ends",
        type=float,
        nargs=2,
        default=(0.6, 1.0),
        metavar=("SHORT", "LONG"),
        help="penetrations at the ends of both runs (m); default: 0.6 1",
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="Section/Entry=value",
        help="as of caisson_mpm; may be repeated",
    )
    parser.add_argument("--directory", type=Path, default=RESULTS / "two_hosts")


def missing() -> str:
    """Return what this machine lacks, or nothing."""
    if os.geteuid() != 0:
        return "root is needed, to make network namespaces"
    tools = [tool for tool in NEEDED if shutil.which(tool) is None]
    return f"missing: {', '.join(tools)}" if tools else ""


def command_of_run(
    options: argparse.Namespace, end: float, directory: Path
) -> list[str]:
    """Return the program and what it is called with."""
    shutil.rmtree(directory, ignore_errors=True)
    entries: dict[str, object] = {**QUIET, "Time/End penetration": end}
    command = [str(PROGRAM), str(options.scene.resolve())]
    command += ["--output-directory", str(directory), *set_options(entries)]
    for more in options.set:
        command += ["--set", more]
    return command


def compare_and_count(options: argparse.Namespace) -> bool:
    """Make the runs and print what they show; return whether they agree."""
    n, top = options.ranks_per_host, options.directory.resolve()
    single = top / "one_host"
    command = command_of_run(options, options.ends[0], single)
    subprocess.run([*mpi_command(2 * n), *command], check=True, env=environment())
    with two_namespaces() as namespaces:
        runs = []
        for name, end in zip(("short", "long"), options.ends):
            path = top / name
            command = command_of_run(options, end, path)
            runs.append(traffic_of_run(namespaces, command, n, path))
    worst = largest_difference(single, top / "short")
    cells, points = (Results(single).summary[k] for k in ("cells", "material_points"))
    print(f"two_hosts: {2 * n} ranks, {n} on each host, TCP only")
    print(f"two_hosts: {cells} cells, {points} points")
    print(f"two_hosts: history.csv differs by {worst:.1e} from that of one host")
    print(describe(*runs))
    return worst <= TOLERANCE


def main(options: argparse.Namespace) -> int:
    """Compare and count; return 1 where the histories differ or a run fails."""
    if missing():
        print(f"two_hosts: {missing()}", file=sys.stderr)
        return 1
    try:
        return 0 if compare_and_count(options) else 1
    except subprocess.CalledProcessError as error:
        status = error.returncode
        name = Status(status).name if status in list(Status) else status
        print(f"two_hosts: {error.cmd[0]} ended with {name}", file=sys.stderr)
        return 1
