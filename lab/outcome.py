# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a study of the laboratory leaves: a picture, its table in two formats, and what
a published number must stand with, the commit and the processor."""
import os
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from caisson import table
from caisson.paths import ROOT, short
from caisson import disk

CPU_INFO = Path("/proc/cpuinfo")
# the kernels of the program, and the flag that a processor has for each
INSTRUCTION_SETS = {"SSE2": "sse2", "AVX2": "avx2", "AVX-512": "avx512dq"}


def write_picture(kind: str, path: Path, figure: Figure) -> None:
    """Write a picture, and say where it is."""
    disk.save(figure, path, dpi=130)
    print(f"{kind}: {short(path)}")


def write_table(
    results: Path,
    columns: Sequence[str],
    rows: Sequence[Sequence[Any]],
    heading: str = "",
) -> None:
    """Write table.csv and, below the heading, table.md; print the table."""
    table.write_csv(results / "table.csv", columns, rows)
    text = table.markdown(columns, rows)
    disk.write(results / "table.md", f"{heading}{text}\n")
    print(text)


def write(
    kind: str,
    results: Path,
    figure: Figure,
    columns: Sequence[str],
    rows: Sequence[Sequence[Any]],
) -> None:
    """Write KIND.png, table.csv and table.md, and print the table."""
    figure.set_layout_engine("tight")
    write_picture(kind, results / f"{kind}.png", figure)
    write_table(results, columns, rows)


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
