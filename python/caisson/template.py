# SPDX-License-Identifier: LGPL-2.1-or-later
"""Templates of Jinja for files and pages, each in the folder that uses it."""
import base64
from collections.abc import Callable
from pathlib import Path

import jinja2

from caisson import disk


def template(path: Path, **filters: Callable[..., str]) -> jinja2.Template:
    """Return a template. In a page, whose name has .html, no text is code; in other
    files no text of a user, as the name of a file, ends a line."""
    is_page = ".html" in path.name
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(path.parent),
        autoescape=is_page,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=jinja2.StrictUndefined,
        finalize=None if is_page else in_one_line,
    )
    environment.filters["quoted"] = disk.quoted
    environment.filters["number"] = lambda value, digits=6: f"{float(value):.{digits}g}"
    environment.filters.update(filters)
    return environment.get_template(path.name)


def picture_of(path: Path) -> str:
    """Return a picture as data for a page."""
    return base64.b64encode(path.read_bytes()).decode("ascii")


def in_one_line(value: object) -> object:
    """Return a text without ends of lines, and anything else as it is."""
    return disk.in_one_line(value) if isinstance(value, str) else value
