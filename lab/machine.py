# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a published number must stand with: the commit and the processor."""
import os
import subprocess
from pathlib import Path

from caisson.paths import ROOT

CPU_INFO = Path("/proc/cpuinfo")
# the kernels of the program, and the flag that a processor has for each
INSTRUCTION_SETS = {"SSE2": "sse2", "AVX2": "avx2", "AVX-512": "avx512dq"}


def commit() -> str:
    """Return the commit of the sources, with "-dirty" where they are changed."""
    try:
        done = subprocess.run(
            ["git", "describe", "--always", "--dirty"],
            cwd=ROOT,
            capture_output=True,
            text=True,
        )
    except OSError:  # no git
        return "no commit"
    return done.stdout.strip() or "no commit"


def processor() -> str:
    """Return the name of the processor."""
    for line in CPU_INFO.read_text(encoding="utf-8").splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return "unknown processor"


def instruction_sets() -> list[str]:
    """Return the instruction sets of the kernels that this processor has."""
    flags = CPU_INFO.read_text(encoding="utf-8").split()
    return [name for name, flag in INSTRUCTION_SETS.items() if flag in flags]


def machine() -> str:
    """Return commit, processor and number of cores in one line."""
    return f"commit {commit()}, {processor()}, {os.cpu_count()} cores"
