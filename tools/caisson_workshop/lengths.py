# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lengths of files, functions and scripts.

The length of a function is counted from the line of its name to its last line.
C++ is not parsed: comments and literals are blanked, and a brace that follows a
parameter list outside a function begins one. The format of the sources, which
is checked, makes that enough.
"""
import ast
import re
from collections.abc import Iterator
from pathlib import Path

from caisson.paths import ROOT

MOST_OF_FILE, MOST_OF_FUNCTION, MOST_OF_SCRIPT = 600, 60, 40
# runs before anything is installed
LONG_SCRIPTS = {"setup"}
# lists of entries or of columns: file, name of the function
LISTS = {("source/simulation/recorder_rows.cc", "columns")}

BLANKED = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'',
    re.DOTALL,
)
SCOPE = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")
NAME = re.compile(r"([~\w]+(?:\s*(?:\(\)|[=!<>+\-*/\[\]&|^%]+))?)\s*$")


def blank(text: str) -> str:
    """Return C++ without comments and literals; all lines stay."""
    return BLANKED.sub(lambda match: "\n" * match.group().count("\n"), text)


def name_before(head: str) -> str:
    """Return the name of the function that is declared by the text before its
    brace: what stands before the first parenthesis."""
    match = NAME.search(head[: head.index("(")])
    return match.group(1) if match else "?"


def is_function(head: str) -> bool:
    """Return whether a brace after this text begins the body of a function."""
    head = re.sub(r"\boperator\s*[^\w\s(]+", "operator", head)
    head = re.sub(r"template\s*<[^{]*?>\s*(?=\w)", "", head)
    before = head.split("(")[0]
    return "(" in head and "=" not in before and not SCOPE.match(before.strip())


def cpp_functions(text: str) -> Iterator[tuple[str, int, int]]:
    """Yield (name, first line, last line) of the functions of a C++ file."""
    text = re.sub(
        r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", preserve_lines, blank(text), flags=re.M
    )
    depth, start, body = 0, 0, None  # depth of braces; body: that of a function
    name, first = "", 0
    for match in re.finditer(r"[{};]", text):
        kind, place = match.group(), match.start()
        if kind == "{":
            head = text[start:place]
            if body is None and is_function(head):
                body, name = depth, name_before(head)
                first = text.count("\n", 0, start + head.index("(")) + 1
            depth += 1
        elif kind == "}":
            depth -= 1
            if depth == body:
                yield name, first, text.count("\n", 0, place) + 1
                body = None
        start = match.end()


def preserve_lines(match: "re.Match[str]") -> str:
    """Return as many empty lines as the match has."""
    return "\n" * match.group().count("\n")


def python_functions(text: str) -> Iterator[tuple[str, int, int]]:
    """Yield (name, first line, last line) of the functions of a Python file."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.lineno, node.end_lineno or node.lineno


def functions_of(path: Path, text: str) -> Iterator[tuple[str, int, int]]:
    """Yield (name, first line, last line) of the functions of a file."""
    if path.suffix in (".h", ".cc"):
        yield from cpp_functions(text)
    elif path.suffix == ".py":
        yield from python_functions(text)


def check_lengths(path: Path) -> Iterator[tuple[int, str]]:
    """Yield (line, text) of what is too long in a file."""
    text = path.read_text(encoding="utf-8", errors="replace")
    n_lines = text.count("\n")
    is_script = not path.suffix and path.parent.parent == ROOT
    most = MOST_OF_SCRIPT if is_script else MOST_OF_FILE
    if n_lines > most and not (is_script and path.name in LONG_SCRIPTS):
        yield most, f"{n_lines} lines, at most {most}"
    file = str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else path.name
    for name, first, last in functions_of(path, text):
        length = last - first + 1
        if length > MOST_OF_FUNCTION and (file, name) not in LISTS:
            yield first, f"{name}: {length} lines, at most {MOST_OF_FUNCTION}"
