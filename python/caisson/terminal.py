# SPDX-License-Identifier: LGPL-2.1-or-later
"""What reaches the terminal: text that may come from a file, and no commands to it."""
import unicodedata
from typing import Any, TextIO

MOST = 250  # characters in a line of a picture
CLEAR = "\r\x1b[K"  # goes back to the beginning of the line, and clears it


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


def set_literally(figure: Any) -> None:
    """Let matplotlib draw the texts of a figure letter by letter, as they may be a
    user's, and no line that is longer than a page. Only the labels of axes, and numbers
    that matplotlib writes, may have formulas."""
    labels = {axis.label for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)}
    for text in {*figure.findobj(lambda x: hasattr(x, "set_parse_math"))} - labels:
        words = text.get_text()
        if words and not words.startswith("$\\mathdefault"):
            text.set_parse_math(False)
            text.set_text("\n".join(line[:MOST] for line in words.split("\n")))


class PlainText:
    """Writes to a stream, after a CLEAR at the beginning, what a printer prints."""

    def __init__(self, stream: TextIO) -> None:
        self.stream = stream

    def write(self, text: str) -> int:
        """Write it with other commands as \\x1b."""
        start = CLEAR if text.startswith(CLEAR) else ""
        lines = text[len(start) :].split("\n")
        return self.stream.write(start + "\n".join(map(printable, lines)))

    def __getattr__(self, name: str) -> Any:
        return getattr(self.stream, name)
