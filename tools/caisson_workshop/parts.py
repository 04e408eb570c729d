# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs all parts of the test, as scripts/test does, and prints one table at the end.

A part that fails does not keep the others from being run, but for those that need
what it makes; these are left out. The output of each part is kept in build/test. The
exit status is 1 if anything failed.
"""
import argparse
import os
import re
import shlex
import subprocess
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from caisson.paths import BUILD, ROOT

# one more than cores, as some tests wait for what they have started
TESTS_AT_A_TIME = str(len(os.sched_getaffinity(0)) + 1)


@dataclass(frozen=True)
class Part:
    """A command, and how its output says what it has checked."""

    name: str
    command: Sequence[str]
    needs: str = ""  # the part that makes what it needs
    is_beside: bool = False  # of the next part that is not, mostly on one core
    # regular expressions with groups "all", "failed" or "skipped", for each match;
    # otherwise the part is one check
    counts: Sequence[str] = ()


@dataclass
class Result:
    """What a part has checked, and how long it took."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0
    seconds: float = 0.0


CTEST = ["ctest", "--output-on-failure", "--test-dir", str(BUILD), "-j"]
PARTS = (
    Part("lint", ["tools/lint"], is_beside=True),
    Part("build", ["scripts/build", "build_tests"]),
    Part(
        "documents",
        ["tools/docs", "--program", str(BUILD / "caisson_mpm")],
        "build",
        is_beside=True,
    ),
    Part(
        "tests",
        [*CTEST, TESTS_AT_A_TIME],
        "build",
        counts=[
            r"tests passed, (?P<failed>\d+) tests? failed out of (?P<all>\d+)$",
            r"(?P<skipped>)\*\*\*(?:Skipped|Not Run \(Disabled\))",
        ],
    ),
    Part(
        "validation",
        ["scripts/lab", "validate", "--quick"],
        "build",
        is_beside=True,
        counts=[r"^validation: (?P<all>\d+) rows,", "(?P<failed>)NOT KNOWN WHY"],
    ),
    Part(
        "faults",
        ["tools/workshop", "faults", "--short"],
        "build",
        is_beside=True,
        counts=[
            r"^[a-z ]+ (?P<all>\d+) in [\d.]+ min: ",
            r"^faults: (?P<failed>\d+) trials went wrong$",
        ],
    ),
    Part(
        "verification",
        ["scripts/lab", "verify", "--quick"],
        "build",
        counts=[r"^(?P<all>\d+) rows: .*, (?P<failed>\d+) fail$"],
    ),
)


def count(part: Part, status: int, output: str) -> Result:
    """Return what a part with this exit status and this output has checked."""
    sums = {"all": 0, "failed": 0, "skipped": 0}
    for pattern in part.counts:
        for match in re.finditer(pattern, output, re.M):
            for key, value in match.groupdict().items():
                sums[key] += int(value or 1)
    if not sums["all"]:  # it is one check, or has not come to an end
        sums = {"all": 1, "failed": int(status != 0), "skipped": 0}
    failed = max(sums["failed"], int(status != 0))
    passed = max(0, sums["all"] - failed - sums["skipped"])
    return Result(passed, failed, sums["skipped"])


def run(part: Part, directory: Path, is_silent: bool = False) -> Result:
    """Run a part; its output goes to directory/NAME.log and is printed."""
    begin, output = time.monotonic(), list[str]()
    with (
        open(directory / f"{part.name}.log", "w", encoding="utf-8") as log,
        subprocess.Popen(
            part.command,
            cwd=ROOT,
            env={**os.environ, "CAISSON_MPM_PROGRAM": str(BUILD / "caisson_mpm")},
            text=True,
            errors="replace",
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        ) as process,
    ):
        assert process.stdout
        for line in process.stdout:
            output.append(line)
            log.write(line)
            log.flush()
            if not is_silent:
                print(line, end="", flush=True)
    result = count(part, process.returncode, "".join(output))
    result.seconds = time.monotonic() - begin
    return result


def run_all(parts: Sequence[Part], directory: Path) -> dict[str, Result]:
    """Run the parts in their order; return their results."""
    directory.mkdir(parents=True, exist_ok=True)
    begin, results = time.monotonic(), {part.name: Result(skipped=1) for part in parts}
    beside: list[tuple[Part, threading.Thread]] = []

    def run_one(part: Part, is_silent: bool) -> None:
        results[part.name] = run(part, directory, is_silent)

    for part in parts:
        prefix = f"test: after {time.monotonic() - begin:.0f} s: "
        if part.needs and (results[part.needs].failed or results[part.needs].skipped):
            print(
                f"{prefix}left out {part.name}, which needs: {part.needs}", flush=True
            )
            continue
        print(f"{prefix}{shlex.join(part.command)}", flush=True)
        if part.is_beside:
            thread = threading.Thread(target=run_one, args=(part, True))
            thread.start()
            beside.append((part, thread))
            continue
        run_one(part, False)
        for other, thread in beside:
            thread.join()
            print(f"test: {other.name} beside it:")
            print((directory / f"{other.name}.log").read_text("utf-8"), end="")
        beside.clear()
    return results


def table(results: dict[str, Result], seconds: float) -> str:
    """Return the table, with the closing line of all parts."""
    total = Result(seconds=seconds)
    lines = [f"{'part':16}{'passed':>8}{'failed':>8}{'skipped':>8}{'seconds':>9}"]
    for name, result in [*results.items(), ("all", total)]:
        if result is not total:
            total.passed += result.passed
            total.failed += result.failed
            total.skipped += result.skipped
        lines.append(
            f"{name:16}{result.passed:8}{result.failed:8}{result.skipped:8}"
            f"{result.seconds:9.0f}"
        )
    return "\n".join(
        [
            *lines,
            "",
            f"test: {total.passed} passed, {total.failed} failed,"
            f" {total.skipped} skipped",
        ]
    )


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop test-parts`."""
    parser.add_argument("--directory", type=Path, default=ROOT / "build/test")


def main(options: argparse.Namespace) -> int:
    """Run all parts; return 1 where something failed."""
    begin = time.monotonic()
    results = run_all(PARTS, options.directory)
    print(f"\n{table(results, time.monotonic() - begin)}")
    return int(any(result.failed for result in results.values()))
