# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks the order of the sources and prints each violation as file:line.

- A file includes headers of its own floor or of lower ones only, and no header
  includes itself through others.
- The kernels' headers, and what they include of ours, use neither deal.II nor
  std containers: they are compiled once per instruction set.
- Every source names its license (SPDX) in the first lines.
- A CMakeLists.txt names every source/**/*.cc.
- Words that are not used in sources: BANNED.
- A file has at most 600 lines, a function 60, a script 40 (lengths.py).
- Python files of users are written by caisson.disk only.
- The top level of the project holds nothing but TOP_LEVEL.
"""
import argparse
import re
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

from caisson.paths import ROOT
from caisson_workshop.lengths import check_lengths

Violations = Iterator[tuple[int, str]]  # (line, text)

FLOORS = """base kernels materials bodies domain operators water output restart
    simulation""".split()
NOT_IN_KERNELS = re.compile(
    r"deal\.II/.*|vector|map|string|array|functional|memory|unordered_map|"
    r"unordered_set|set|list|deque|algorithm"
)
INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')
LICENSE = "SPDX-License-Identifier: LGPL-2.1-or-later"
TOP_LEVEL = set(
    ".ci .clang-format .dockerignore .gitignore CHANGELOG.md CITATION.cff"
    " CMakeLists.txt CMakePresets.json CONTRIBUTING.md LICENSE README.md doc include"
    " lab packaging prm pyproject.toml python scripts setup.cfg source tests"
    " tools".split()
)
# regular expression: why, and what to use
BANNED: dict[str, str] = {
    r"\bstd::to_string\b": "1.2e-7 would become 0.000000; use to_text() (base/text.h)",
}
# of python and lab, where copy is a temporary file
WRITES = {
    r"(?<!\bcopy)\.write_(text|bytes)\(|savefig\(|rmtree\(|\bopen\([^)]*\"[wx]b?\"": (
        "a file of a user is written whole or not at all: use caisson.disk"
    )
}
MAY_WRITE = {"disk.py", "timed.py"}  # the latter the log of a process


def lines_of(path: Path) -> list[str]:
    """Return the lines of a file."""
    return path.read_text(encoding="utf-8", errors="replace").splitlines()


def includes(path: Path) -> Iterator[tuple[int, str]]:
    """Yield (line number, header) of each include of a file."""
    for number, line in enumerate(lines_of(path), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1)


def floor_of(path: Path) -> int | None:
    """Return the floor of a file, None on none; a file above all folders
    (main.cc) is on top."""
    parts = path.relative_to(ROOT).parts
    folders = parts[2:-1] if parts[0] == "include" else parts[1:-1]
    if not folders:
        return len(FLOORS)
    return FLOORS.index(folders[0]) if folders[0] in FLOORS else None


def check_floor(path: Path) -> Violations:
    """Yield violations of the order of the floors."""
    own = floor_of(path)
    if own is None:
        yield 1, f"not in a folder of a floor ({', '.join(FLOORS)})"
        return
    for line, header in includes(path):
        parts = header.split("/")
        if parts[0] != "caisson_mpm":
            continue
        if len(parts) < 3 or parts[1] not in FLOORS:
            yield line, f"{header} is on no floor"
        elif FLOORS.index(parts[1]) > own:
            yield line, f"{header} is on a higher floor"


def own_headers(path: Path) -> Iterator[tuple[int, Path]]:
    """Yield (line, path) of the headers of ours that a file includes."""
    for line, header in includes(path):
        inner = ROOT / "include" / header
        if header.startswith("caisson_mpm/") and inner.is_file():
            yield line, inner


def check_cycles(path: Path) -> Violations:
    """Yield the includes by which a header includes itself."""
    for line, first in own_headers(path):
        seen, rest = set[Path](), [first]
        while rest:
            header = rest.pop()
            if header == path:
                yield line, f"{first.name} includes this file again"
                break
            if header not in seen:
                seen.add(header)
                rest += [inner for _, inner in own_headers(header)]


def foreign(path: Path, seen: set[Path]) -> Violations:
    """Yield (line, header) not allowed in kernels, through our headers."""
    seen.add(path)
    for line, header in includes(path):
        if NOT_IN_KERNELS.fullmatch(header):
            yield line, header
    for line, inner in own_headers(path):
        if inner not in seen:
            for _, name in foreign(inner, seen):
                yield line, f"{name} (through {inner.name})"


def check_kernel(path: Path) -> Violations:
    """Yield violations of the purity of the kernels' headers."""
    if path.parent == ROOT / "include/caisson_mpm/kernels":
        for line, header in foreign(path, set()):
            yield line, f"a kernel header may not include {header}"


def check_license(path: Path) -> Violations:
    """Yield a missing SPDX line."""
    if LICENSE not in "\n".join(lines_of(path)[:5]):
        yield 1, f"no line with {LICENSE}"


def check_words(path: Path, banned: dict[str, str]) -> Violations:
    """Yield words that are not used."""
    for number, line in enumerate(lines_of(path), 1):
        for pattern, reason in banned.items():
            if re.search(pattern, line):
                yield number, reason


def strangers(paths: Iterable[str]) -> list[str]:
    """Return what does not belong to the top level of the project, of paths there."""
    return sorted({path.split("/")[0] for path in paths} - TOP_LEVEL)


def committed() -> list[str]:
    """Return the paths of all files that git knows or would take; none where there is
    no repository."""
    git = ["git", "-C", str(ROOT), "ls-files", "--cached", "--others"]
    done = subprocess.run(
        [*git, "--exclude-standard"], text=True, capture_output=True, check=False
    )
    return [path for path in done.stdout.splitlines() if (ROOT / path).exists()]


def named_in_cmake() -> set[Path]:
    """Return the absolute paths of all .cc names in the CMakeLists.txt files."""
    names = set()
    for file in [ROOT / "CMakeLists.txt", *ROOT.glob("source/**/CMakeLists.txt")]:
        text = file.read_text(encoding="utf-8") if file.is_file() else ""
        text = re.sub(r"#.*", "", text)
        text = re.sub(r"\$\{(CMAKE_CURRENT|CMAKE|PROJECT)_SOURCE_DIR\}/", "", text)
        for name in re.findall(r"[\w./+-]+\.cc\b", text):
            names.add((file.parent / name).resolve())
    return names


def files(*patterns: str) -> list[Path]:
    """Return the files of the project that fit."""
    found = {path for pattern in patterns for path in ROOT.glob(pattern)}
    return sorted(path for path in found if path.is_file())


def is_user_code(path: Path) -> bool:
    """Return whether a Python file writes files of users only by the module disk."""
    parts = path.relative_to(ROOT).parts
    is_tool = parts[0] not in ("python", "lab") or parts[1] == "tests"
    return path.suffix == ".py" and not is_tool and path.name not in MAY_WRITE


def check_source(path: Path, listed: set[Path]) -> Violations:
    """Yield all violations of a source of the program."""
    for check in (check_floor, check_cycles, check_kernel):
        yield from check(path)
    yield from check_words(path, BANNED)
    if path.suffix == ".cc" and path.resolve() not in listed:
        yield 1, "not named in any CMakeLists.txt"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop check-floors`: none."""


def main(_: argparse.Namespace) -> int:
    """Check all files."""
    listed = named_in_cmake()
    sources = files("include/**/*.h", "source/**/*.h", "source/**/*.cc")
    tests = files("tests/**/*.h", "tests/**/*.cc", "lab/**/*.h", "lab/**/*.cc")
    folders = ("python", "lab", "tools", "tests")
    python = files(*(f"{folder}/**/*.py" for folder in folders))
    scripts = files("scripts/*", "tools/*")
    violations = [
        f"{name}: does not belong to the top level: remove it, or add it to TOP_LEVEL"
        for name in strangers(committed())
    ]
    for path in sources + tests + python + scripts:
        found = [*check_license(path), *check_lengths(path)]
        if path in sources:
            found += check_source(path, listed)
        if is_user_code(path):
            found += check_words(path, WRITES)
        name = path.relative_to(ROOT)
        violations += [f"{name}:{line}: {text}" for line, text in found]
    print(
        "\n".join(violations)
        or f"floors: OK ({len(sources)} sources, {len(tests)} of tests,"
        f" {len(python) + len(scripts)} of Python and scripts)"
    )
    return 1 if violations else 0
