# SPDX-License-Identifier: LGPL-2.1-or-later
"""The units in which results are shown: kN, kPa, m, and of small bodies N, Pa, mm.

Pages and pictures compute in the larger ones; a table, a card or an axis shows all of
its numbers of one kind in the same unit.
"""
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

SMALLER = {"kN": ("N", 1e3), "kPa": ("Pa", 1e3), "m": ("mm", 1e3)}


@dataclass(frozen=True)
class Units:
    """The unit in the place of each of SMALLER; none stands for itself."""

    smaller: frozenset[str] = frozenset()

    def name(self, usual: str) -> str:
        """Return the unit in the place of a usual one."""
        return SMALLER[usual][0] if usual in self.smaller else usual

    def factor(self, usual: str) -> float:
        """Return what a number in the usual unit is multiplied with."""
        return SMALLER[usual][1] if usual in self.smaller else 1.0

    def named(self, text: str) -> str:
        """Return a head or a label with its unit in brackets, as "force (kN)"."""
        for usual in self.smaller:
            text = text.replace(f"({usual})", f"({self.name(usual)})")
        return text

    def factor_of(self, text: str) -> float:
        """Return what the numbers below a head or along an axis are multiplied with."""
        return float(
            np.prod([self.factor(u) for u in self.smaller if f"({u})" in text])
        )

    def words(self, value: float, usual: str, digits: str) -> str:
        """Return a number in a usual unit in words, with these digits: "35.1 kPa"."""
        return f"{self.factor(usual) * value:{digits}} {self.name(usual)}"

    def depth(self, meters: float) -> str:
        """Return a depth in words: "4.50 m", "45.0 mm"."""
        digits = 1 if "m" in self.smaller else 2
        value = round(self.factor("m") * float(meters), digits) + 0.0  # no -0.00
        return f"{value:.{digits}f} {self.name('m')}"

    def place(self, meters: float, digits: int = 2) -> str:
        """Return a depth in words without zeros at its end: "4.5 m", "45 mm"."""
        fewer = round(
            self.factor("m") * float(meters), digits - 1 * ("m" in self.smaller)
        )
        return f"{fewer:g} {self.name('m')}"

    def force(self, kilonewtons: float) -> str:
        """Return a force in words, with three digits, also in MN: "6.5 MN"."""
        if "kN" not in self.smaller and abs(kilonewtons) >= 1e3:
            return f"{kilonewtons / 1e3:.3g} MN"
        return self.words(float(f"{kilonewtons:.3g}"), "kN", "g")

    def length(self, meters: float) -> str:
        """Return a length in words, with the digits that it has: "0.5 m"."""
        return self.words(meters, "m", ".6g")


USUAL = Units()


def units_for(force: float, stress: float, length: float) -> Units:
    """Return the units for the largest force (N) and stress (Pa), and a size (m)."""
    sizes = {"kN": force / 1e3, "kPa": stress / 1e3, "m": length}
    small = {unit for unit, size in sizes.items() if abs(size) < 1}
    return Units(frozenset(small))


def units_of(history: Mapping[str, Any], scene: Mapping[str, Any]) -> Units:
    """Return the units of a run, from the columns of its history and what run.json says
    of the body."""

    def largest(name: str) -> float:
        values = np.abs(history.get(name, np.full(1, np.inf)))
        finite = values[np.isfinite(values)]
        return float(finite.max()) if len(finite) else np.inf

    length = scene.get("skirt_length_m") or scene.get("diameter_m") or np.inf
    return units_for(
        largest("total_force_N"), largest("required_suction_Pa"), float(length)
    )
