# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the parameter reference of the manual from what the program prints."""
import argparse
import re
from dataclasses import dataclass, field
from pathlib import Path

HEAD = """# Parameter reference

This page is generated from the output of `caisson_mpm --print-parameters`. It lists
every entry that a parameter file may set, by section, with its default value. The
[tutorial](../tutorial.md) introduces the entries that every scene needs. The same list,
with the values of a scene, is printed by

```
caisson_mpm prm/jack.prm --print-parameters
```

On the command line, an entry is addressed by its path, for example
`--set "Rigid body/Wall thickness=0.05"`.

"""


@dataclass
class Entry:
    """One entry: its name, default, explanation and allowed values."""

    name: str
    default: str
    text: str
    allowed: str

    @property
    def units(self) -> str:
        """The unit, empty where there is none."""
        found = re.search(r"Units: ([^.]*)\.?$", self.text)
        return "" if not found or found[1] == "none" else found[1]

    def markdown(self) -> str:
        """The entry as an item of a definition list."""
        units = f" {self.units}" if self.units else ""
        text = re.sub(r"\s*Units: [^.]*\.?$", "", self.text)
        value = f"`{self.default}`{units}" if self.default else "empty"
        return (
            f"`{self.name}` = {value}\n"
            f": {escaped(text)} *Allowed: {escaped(self.allowed)}.*\n\n"
        )


@dataclass
class Section:
    """A section with its entries and the sections in it."""

    name: str
    entries: list[Entry] = field(default_factory=list)
    sections: list["Section"] = field(default_factory=list)

    def same_entries(self, other: "Section") -> bool:
        """Whether the other section describes the same entries."""
        mine = [entry.name for entry in self.entries]
        return mine == [entry.name for entry in other.entries]

    def markdown(self, level: int) -> str:
        """The section as Markdown, with a heading of this level."""
        page = f"{'#' * level} {self.name}\n\n" if level > 1 else HEAD
        page += "".join(entry.markdown() for entry in self.entries)
        for section in with_repeated_ones_once(self.sections):
            page += section.markdown(level + 1)
        return page


def escaped(text: str) -> str:
    """The text without characters that mean something in Markdown."""
    return re.sub(r"([*_<>\[\]`$\\])", r"\\\1", text)


def with_repeated_ones_once(sections: list[Section]) -> list[Section]:
    """The sections, with 'Layer 1', of which there may be any number, as 'Layer k'."""
    shown: list[Section] = []
    for section in sections:
        word = re.sub(r" \d+$", "", section.name)
        if word == section.name:
            shown.append(section)
        elif section.name.endswith(" 1"):
            name = f"{word} k, with k = 1, 2, ..."
            shown.append(Section(name, section.entries, section.sections))
        else:
            first = next(s for s in sections if s.name == f"{word} 1")
            if not first.same_entries(section):
                raise SystemExit(f"parameters: {first.name} and {section.name} differ")
    return shown


def parsed(printed: str) -> Section:
    """The tree of sections that the program printed."""
    path = [Section("")]
    comment: list[str] = []
    for line in (line.strip() for line in printed.splitlines()):
        if line.startswith("#"):
            comment.append(line[1:].strip())
        elif line.startswith("subsection "):
            path.append(Section(line.split(" ", 1)[1]))
            path[-2].sections.append(path[-1])
        elif line == "end":
            path.pop()
        elif line.startswith("set "):
            path[-1].entries.append(entry_of(line[4:], " ".join(comment)))
        if not line.startswith("#"):
            comment = []
    return path[0]


def entry_of(assignment: str, comment: str) -> Entry:
    """The entry of one 'set' line and the comment above it."""
    text, _, rest = comment.partition(" Allowed: ")
    allowed, _, default = rest.partition(" Default: ")
    if not allowed:
        raise SystemExit(f"parameters: no allowed values stand above '{assignment}'")
    name = assignment.split("=", 1)[0].strip()
    return Entry(name, default.strip(), text, allowed.rstrip("."))


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop parameter-page`."""
    add = parser.add_argument
    add("printed", type=Path, help="output of caisson_mpm --print-parameters")
    add("page", type=Path, help="the page to write, as Markdown")


def main(options: argparse.Namespace) -> int:
    """Write the page."""
    page = parsed(options.printed.read_text()).markdown(1)
    options.page.write_text(page.rstrip() + "\n")
    return 0
