# SPDX-License-Identifier: LGPL-2.1-or-later
"""Templates of Jinja for files, pages and sentences, in the folders that use them."""
import base64
import functools
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jinja2

from caisson import disk
from caisson.table import text_of


def environment(folder: Path, is_page: bool, **more: Any) -> jinja2.Environment:
    """Return what reads the templates of a folder."""
    found = jinja2.Environment(
        loader=jinja2.FileSystemLoader(folder),
        autoescape=is_page,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=jinja2.StrictUndefined,
        **more,
    )
    found.filters["quoted"] = disk.quoted
    found.filters["number"] = number
    found.filters["short"] = text_of
    found.filters["ends"] = ends
    found.filters["sentence"] = sentence
    return found


@functools.cache
def template(path: Path, **filters: Callable[..., str]) -> jinja2.Template:
    """Return a template, compiled once. In a page, whose name has .html, no text is
    code; in other files no text of a user, as the name of a file, ends a line."""
    is_page = ".html" in path.name
    finalize = None if is_page else in_one_line
    found = environment(path.parent, is_page, finalize=finalize)
    found.filters.update(filters)
    return found.get_template(path.name)


def number(value: float, digits: int = 6) -> str:
    """Return a number with some digits, below a million without an exponent."""
    text = f"{float(value):.{digits}g}"
    return f"{float(text):.0f}" if 1 <= abs(float(text)) < 1e6 and "e" in text else text


def ends(values: list[float], form: str = "g", word: str = " to ") -> str:
    """Return both ends of a range, or the only number where they look the same."""
    return word.join(dict.fromkeys(f"{value:{form}}" for value in values))


@functools.cache
def macros(path: Path) -> Any:
    """Return the macros of a template of sentences."""
    return environment(path.parent, False).get_template(path.name).module


def sentence(text: str) -> str:
    """Return a sentence of a template in one line. Ends of lines are blanks there, and
    nothing before a comma or another mark, or behind a bracket."""
    text = re.sub(r" *\n[ \n]*(?=[,.;:)])|(?<=\() *\n[ \n]*", "", text)
    return re.sub(r"[ \n]+", " ", text).strip(" ")


def say(path: Path, name: str, *data: Any, **more: Any) -> str:
    """Return the sentence that a macro of a template makes of data."""
    return sentence(str(getattr(macros(path), name)(*data, **more)))


def say_rows(path: Path, name: str, *data: Any, cells: int = 2) -> list[list[str]]:
    """Return the rows that a macro of a template makes of data, with some cells each: a
    blank line ends a row, and | a cell. A row whose second cell is empty is left out.
    """
    text = str(getattr(macros(path), name)(*data))
    found = [
        [sentence(cell) for cell in re.split(r"(?<!\S)\|(?!\S)", row, cells - 1)]
        for row in re.split(r"\n\s*\n", text)
    ]
    return [row for row in found if len(row) == cells and row[1]]


def picture_of(path: Path) -> str:
    """Return a picture as data for a page."""
    return base64.b64encode(path.read_bytes()).decode("ascii")


def in_one_line(value: object) -> object:
    """Return a text without ends of lines, and anything else as it is."""
    return disk.in_one_line(value) if isinstance(value, str) else value
