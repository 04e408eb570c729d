# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of the table of a validation."""
import math
from dataclasses import dataclass

from caisson.table import number

COLUMNS = ["comparison", "quantity", "computed", "asked", "verdict"]


@dataclass(frozen=True)
class Row:
    """A quantity, which should lie between two bounds."""

    comparison: str
    quantity: str
    computed: float
    least: float = -math.inf
    largest: float = math.inf
    known: str = ""  # why it falls short, if that is known

    @property
    def is_met(self) -> bool:
        """Whether it lies within its bounds; false for nan."""
        return self.least <= self.computed <= self.largest

    @property
    def fails(self) -> bool:
        """Whether it falls short, and the reason is not known."""
        return not self.is_met and not self.known

    def asked(self) -> str:
        """Return the bounds in words."""
        if math.isinf(self.least) and math.isinf(self.largest):
            return "shown"
        if math.isinf(self.least):
            return f"at most {number(self.largest)}"
        if math.isinf(self.largest):
            return f"at least {number(self.least)}"
        return f"{number(self.least)} to {number(self.largest)}"

    def texts(self) -> list[str]:
        """Return the cells of the table."""
        verdict = "met" if self.is_met else f"short: {self.known or 'NOT KNOWN WHY'}"
        if self.asked() == "shown":
            verdict = ""
        computed = number(self.computed)
        return [self.comparison, self.quantity, computed, self.asked(), verdict]
