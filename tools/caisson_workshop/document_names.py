# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks the names in the documents: files, entries of scenes, classes, functions.

A word in backticks that looks like a path of the source tree must exist. One
that begins with the name of a section, such as `Grid/Top`, must be an entry.
One that looks like the name of a class or a function must occur in the sources.
"`Grid/Top` is 8 by default" must be true, and the glossary, which readers take
numbers from, states a default in this form only. A line outside tables and code may
have at most 100 characters. A table begins with its heads and a line below them, so
that a blank line in it cuts it in two. All pages together have a limit of words, and so
has the manual: what is new should take the place of something else.
"""
import argparse
import re
from pathlib import Path

from caisson.paths import ROOT
from caisson_workshop.parameter_page import Section, parsed

# Folders of the tree, and those of the C++ sources, which are named without the
# folders "source" and "include/caisson_mpm" above them.
FOLDERS = "prm lab scripts tools tests doc python source include".split()
FLOORS = "base kernels materials bodies domain operators water output restart".split()
# Pages that are generated, or that name what is gone.
GENERATED_OR_PAST = {"parameters.md", "CHANGELOG.md"}
NOTES = ROOT / "lab/notes"  # dated: they name what was there then
SUFFIXES = {".h", ".cc", ".py", ".prm", ".toml", ".txt", ""}
# Code, formulas, and what `scripts/lab publish-speed` writes.
NOT_WRAPPED = r"```.*?```|\$\$.*?\$\$|<!-- speed: begin.*speed: end -->"
STATED_DEFAULT = re.compile(r"`([^`/]+/[^`]+)`\s+is\s+`?([^`\s]+)`?\s+by\s+default")
GLOSSARY = "glossary.md"
MOST_WORDS = 56_200  # of all pages but the generated one
MOST_WORDS_OF_MANUAL = 42_000  # of README.md and doc/
BRITISH = re.compile(
    r"\b(metres?|neighbours?\w*|centres?|centred|colour\w*|behaviour|modell(?:ed|ing)"
    r"|licence|regularis\w*|normalis\w*|localis\w*|grey|fulfil|programme)\b",
    re.IGNORECASE,
)


def entries_of(section: Section, path: str = "") -> set[str]:
    """The paths of all entries and sections in a section."""
    found = {path + entry.name for entry in section.entries}
    for inner in section.sections:
        found.add(path + inner.name)
        found |= entries_of(inner, f"{path}{inner.name}/")
    return found


def defaults_of(section: Section, path: str = "") -> dict[str, str]:
    """The defaults of all entries in a section by their paths."""
    found = {path + entry.name: entry.default for entry in section.entries}
    for inner in section.sections:
        found |= defaults_of(inner, f"{path}{inner.name}/")
    return found


def wrong_defaults(page: Path, defaults: dict[str, str]) -> list[str]:
    """What a page says wrongly, or without the entry, of defaults."""
    text = page.read_text()
    faults = [
        f"{entry} is {defaults.get(entry, 'no entry')} by default, not {value}"
        for entry, value in STATED_DEFAULT.findall(text)
        if defaults.get(entry) != value
    ]
    if page.name == GLOSSARY:
        rest = STATED_DEFAULT.sub("", text)
        faults += [
            f"a default or a share without its entry: {line.strip()}"
            for line in rest.splitlines()
            if re.search(r"\bdefault|\d %", line)
        ]
    return faults


def exists(name: str) -> bool:
    """Whether a path of the tree or of the C++ sources exists. NAME, GROUP and ROOM in
    it stand for any name."""
    if (ROOT / name).exists():
        return True
    pattern = re.sub("NAME|GROUP|ROOM", "*", name).rstrip("/")
    places = (ROOT, ROOT / "source", ROOT / "include/caisson_mpm")
    return any(any(place.glob(pattern)) for place in places)


def is_path(word: str) -> bool:
    """Whether a word names a file or a folder of the tree."""
    if not re.fullmatch(r"[\w.*/-]+", word):
        return False
    folder, slash, _ = word.partition("/")
    return bool(slash) and folder in FOLDERS + FLOORS + ["simulation"]


def words_of_sources() -> set[str]:
    """All words of the sources, scripts and scenes."""
    words = set(re.findall(r"\w+", (ROOT / "CMakeLists.txt").read_text()))
    for folder in FOLDERS:
        for file in (ROOT / folder).rglob("*"):
            words.add(file.stem)
            if file.is_file() and file.suffix in SUFFIXES and folder != "doc":
                words |= set(re.findall(r"\w+", file.read_text(errors="replace")))
    return words


def is_name(word: str) -> bool:
    """Whether a word looks like a name in the sources, and not like plain text."""
    return bool(re.fullmatch(r"[A-Za-z_][\w:]*(\(\))?", word)) and (
        "::" in word
        or word.endswith("()")
        or bool(re.search(r"[a-z]_[a-z]|[a-z][A-Z]", word))
    )


def headless_tables(text: str) -> list[str]:
    """Return the first lines of tables that have no heads."""
    lines = ["", *text.splitlines(), ""]
    return [
        line
        for before, line, after in zip(lines, lines[1:], lines[2:])
        if line.startswith("|")
        and not before.startswith("|")
        and not re.fullmatch(r"\|[-:| ]+\|", after)
    ]


def faults_of(page: Path, entries: set[str], names: set[str]) -> list[str]:
    """What is wrong in one page."""
    faults = []
    text = page.read_text()
    code = re.findall(r"(?<!`)`([^`\n]+)`(?!`)", text)
    for word in (word.strip() for word in code):
        path, section = word.split("=")[0].strip(), word.split("/")[0]
        if is_path(word.split(" ")[0]) and not exists(word.split(" ")[0]):
            faults.append(f"there is no file {word}")
        elif "/" in path and section in entries and "Layer k" not in path:
            if path.rstrip("/") not in entries:
                faults.append(f"there is no entry {path}")
    for word in filter(is_name, code):
        faults += [
            f"nothing is called {part} in the sources ({word})"
            for part in re.findall(r"\w+", word)
            if part not in names
        ]
    own_words = text.split("## References")[0]  # titles of papers stay as they are
    faults += [f"British spelling: {word}" for word in set(BRITISH.findall(own_words))]
    outside = re.sub(NOT_WRAPPED, "", text, flags=re.DOTALL)
    faults += [f"a table without heads: {x[:40]}" for x in headless_tables(outside)]
    for line in outside.splitlines():
        if len(line) > 100 and "|" not in line and "http" not in line:
            faults.append(f"a line of {len(line)} characters: {line[:40]}...")
        if line.startswith("%"):
            faults.append(f"a line that is a comment for its percent sign: {line[:40]}")
    return faults


def too_many_words(what: str, pages: list[Path], most: int) -> list[str]:
    """What is wrong with the number of words of these pages."""
    count = sum(len(page.read_text().split()) for page in pages)
    return [f"{what} has {count} words, at most {most}"] if count > most else []


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop check-documents`."""
    text = "output of caisson_mpm --print-parameters"
    parser.add_argument("printed", type=Path, help=text)


def main(options: argparse.Namespace) -> int:
    """Print what is wrong in all pages; return 1 where something is."""
    root = parsed(options.printed.read_text())
    entries, defaults = entries_of(root), defaults_of(root)
    names = words_of_sources()
    patterns = ("*.md", "doc/**/*.md", "lab/**/*.md")
    pages = [page for pattern in patterns for page in sorted(ROOT.glob(pattern))]
    written = [page for page in pages if page.name != "parameters.md"]
    of_manual = (ROOT / "README.md", *(ROOT / "doc").rglob("*.md"))
    manual = [page for page in written if page in of_manual]
    faults = too_many_words("the text of all pages", written, MOST_WORDS)
    faults += too_many_words("the manual", manual, MOST_WORDS_OF_MANUAL)
    faults += [
        f"{page.relative_to(ROOT)}: {fault}"
        for page in pages
        if page.name not in GENERATED_OR_PAST and page.parent != NOTES
        for fault in faults_of(page, entries, names) + wrong_defaults(page, defaults)
    ]
    print("\n".join(faults), end="\n" if faults else "")
    return 1 if faults else 0
