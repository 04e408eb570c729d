# SPDX-License-Identifier: LGPL-2.1-or-later
"""What scenes of suggest are made of."""
from dataclasses import dataclass

from caisson.disk import InputError

ASSUMPTION = " # ASSUMED"


class SuggestError(InputError):
    """What is wrong with what was given; the text is for the user."""


def number_in(text: str) -> float | None:
    """Return the number that a text is, None of an expression."""
    try:
        return float(text)
    except ValueError:
        return None


@dataclass(frozen=True)
class Entry:
    """An entry of a layer; remark says in the file where it comes from."""

    name: str
    value: str
    remark: str = ""


@dataclass(frozen=True)
class Layer:
    """A layer of soil from top (m below the surface) down to the next one; warning:
    what is doubtful in what was given, "" if nothing is."""

    top: float
    entries: list[Entry]
    warning: str = ""

    def value(self, name: str) -> str:
        """Return an entry, "" where the layer has none of this name."""
        return next((e.value for e in self.entries if e.name == name), "")
