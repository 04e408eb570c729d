# SPDX-License-Identifier: LGPL-2.1-or-later
"""What reaches the terminal: text that may come from a file, and no commands to it."""
from typing import Any, TextIO

from caisson.design import printable

CLEAR = "\r\x1b[K"  # goes back to the beginning of the line, and clears it


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
