# SPDX-License-Identifier: LGPL-2.1-or-later
"""Design methods for the penetration of skirts and caissons, and cone tests as files.

Nothing here needs the program caisson_mpm or the package caisson around it: a method
takes the caisson, the soil or a cone test, and returns forces or suctions over depth.
"""
import unicodedata


class InputError(Exception):
    """A file or a number that cannot be used; the text is for the user."""


def printable(text: str) -> str:
    """Return a text of a file as it may reach a terminal, a picture or a page: what no
    printer prints, such as the escape that begins a command of a terminal, becomes
    \\x1b; other blanks become spaces, and tabs stay."""
    if text.isprintable():
        return text
    letters = (" " if unicodedata.category(c) == "Zs" else c for c in text)
    return "".join(
        c if c.isprintable() or c == "\t" else c.encode("unicode_escape").decode()
        for c in letters
    )
