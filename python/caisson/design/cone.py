# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance of a caisson from a cone penetration test (CPT).

The methods from a cone take the forces as proportional to the cone resistance q_c:

    tip = k_p q_c(h) A,                  A = pi (D_o - t) t,
    friction = pi D integral of k_f q_c dz from 0 to h, on each wall,

with D = D_o outside and D_i inside, the wall thickness t, and k_p and k_f of the layer
at the depth. The methods differ in these coefficients: dnv, senders_randolph,
andersen.

Between two rows of a test q_c is linear. Above the first row it is that of the first
row; below the last row there is no answer (nan).

SI units; z is the depth below the mudline (m), q_c is in Pa.
"""
import csv
import io
import re
import shutil
from collections.abc import Mapping, Sequence
from math import inf, isfinite, nan, pi, radians, tan
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson.design.method import Forces
from caisson.results import ResultsError

NAME = "cone.csv"  # of the test in the directory of a run
LARGEST = 200e6  # Pa; more than any cone can bear
HIGHEST_START = 1.0  # m, of the first row
PASCAL = {"pa": 1.0, "kpa": 1e3, "mpa": 1e6}
HEADS = "depth_m and qc_MPa (or qc_kPa, qc_Pa)"


class Profile:
    """The cone resistance over depth."""

    def __init__(self, depth: Sequence[float], resistance: Sequence[float]) -> None:
        """depth: [n] (m), growing; resistance: [n] (Pa)."""
        first = [0.0] if depth[0] > 0 else []
        self.depth = np.array([*first, *depth])
        self.resistance = np.array([resistance[0]] * len(first) + list(resistance))
        means = (self.resistance[1:] + self.resistance[:-1]) / 2
        steps = means * np.diff(self.depth)
        self._integral = np.concatenate([[0.0], np.cumsum(steps)])

    def at(self, z: float) -> float:
        """Return q_c at a depth (Pa), nan below the last row."""
        return float(np.interp(z, self.depth, self.resistance, right=nan))

    def integral(self, z: float) -> float:
        """Return the integral of q_c from 0 to z (N/m), nan below the last row."""
        if not 0 <= z <= self.depth[-1]:
            return nan
        i = min(int(np.searchsorted(self.depth, z, "right")), len(self.depth) - 1) - 1
        rest = (z - self.depth[i]) * (self.resistance[i] + self.at(z)) / 2
        return float(self._integral[i] + rest)


class Skirt(NamedTuple):
    """The wall of a caisson."""

    outer_diameter: float  # m
    wall_thickness: float  # m
    inner_friction_angle: float  # with the soil, degrees
    outer_friction_angle: float

    @property
    def inner_diameter(self) -> float:
        """D_i (m)."""
        return self.outer_diameter - 2 * self.wall_thickness

    @property
    def tip_area(self) -> float:
        """The area of the end of the wall (m2)."""
        return pi * (self.outer_diameter - self.wall_thickness) * self.wall_thickness

    @property
    def tan_inner(self) -> float:
        """The friction coefficient of the inner wall."""
        return tan(radians(self.inner_friction_angle))

    @property
    def tan_outer(self) -> float:
        """The friction coefficient of the outer wall."""
        return tan(radians(self.outer_friction_angle))


class Coefficients(NamedTuple):
    """k_p, and k_f of both walls."""

    tip: float
    inner: float
    outer: float


class Layer(NamedTuple):
    """A layer down to the top of the next one, with its coefficients by case."""

    top: float  # m below the mudline
    coefficients: Mapping[str, Coefficients]


class ConeMethod:
    """A method with coefficients k_p and k_f."""

    def __init__(
        self,
        cases: tuple[str, str],
        skirt: Skirt,
        profile: Profile,
        layers: Sequence[Layer],
    ) -> None:
        """layers: from the mudline down."""
        self.cases, self.skirt, self.profile = cases, skirt, profile
        self.layers = sorted(layers, key=lambda layer: layer.top)

    def forces(self, h: float, case: str) -> Forces:
        """Return the forces at an embedment."""
        bottoms = [layer.top for layer in self.layers[1:]] + [inf]
        inner = outer = 0.0
        tip = self.layers[0].coefficients[case].tip
        for layer, bottom in zip(self.layers, bottoms):
            if layer.top >= h:
                break
            k = layer.coefficients[case]
            part = self.profile.integral(min(bottom, h))
            part -= self.profile.integral(layer.top)
            inner, outer, tip = inner + k.inner * part, outer + k.outer * part, k.tip
        return Forces(
            tip * self.profile.at(h) * self.skirt.tip_area,
            inner * pi * self.skirt.inner_diameter,
            outer * pi * self.skirt.outer_diameter,
        )


# ------------------------------------------------------------------- files


def head_of(text: str) -> tuple[str, str]:
    """Return quantity and unit of a head such as depth_m, "qc (MPa)" or qc [kPa]."""
    words = re.findall(r"[a-z]+", text.lower())
    return ("".join(words[:-1]), words[-1]) if words else ("", "")


def columns_of(path: Path, heads: Sequence[str]) -> tuple[int, int, float]:
    """Return the columns of depth and q_c, and the unit of q_c in Pa."""
    names = [head_of(head) for head in heads]
    depths = [i for i, name in enumerate(names) if name == ("depth", "m")]
    cones = [i for i, (name, u) in enumerate(names) if name == "qc" and u in PASCAL]
    if len(depths) != 1 or len(cones) != 1:
        raise ResultsError(
            f"{path}: the first row must name one column of depth and one of cone"
            f" resistance, {HEADS}; it is {', '.join(heads)!r}"
        )
    return depths[0], cones[0], PASCAL[names[cones[0]][1]]


def number_of(path: Path, row: int, cells: Sequence[str], column: int) -> float:
    """Return a cell as a number."""
    text = cells[column].strip() if column < len(cells) else ""
    try:
        value = float(text)
    except ValueError:
        value = nan
    if not isfinite(value):
        raise ResultsError(
            f"{path}, row {row}: {text!r} is no number; write numbers with a point and"
            " leave out rows without one"
        )
    return value


def check_row(path: Path, row: int, z: float, above: float | None, q: float) -> None:
    """Refuse a row that cannot be meant. above: the depth of the row before."""
    wrong = ""
    if above is None and not 0 <= z <= HIGHEST_START:
        wrong = (
            f"the test begins at a depth of {z:g} m; it must begin between 0 and"
            f" {HIGHEST_START:g} m, with depth positive downward"
        )
    elif above is not None and z <= above:
        wrong = f"the depth of {z:g} m is not below that of the row before, {above:g} m"
    elif not 0 <= q <= LARGEST:
        wrong = (
            f"the cone resistance is {q / 1e6:g} MPa, which is not between 0 and"
            f" {LARGEST / 1e6:g} MPa; check the unit in the first row"
        )
    if wrong:
        raise ResultsError(f"{path}, row {row}: {wrong}")


def read(path: Path) -> Profile:
    """Return the test of a .csv file.

    The first row names the columns with their units; others than depth and q_c are
    not read. Cells are divided by commas, semicolons or tabs. Rows that are empty or
    begin with "#" are left out, but count. Raises ResultsError, with the row.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ResultsError(f"{path} cannot be read as a cone test: {error}") from error
    lines = [
        (row, line)
        for row, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.startswith("#")
    ]
    if len(lines) < 3:
        raise ResultsError(
            f"{path}: a cone test needs a row of heads, {HEADS}, and two"
        )
    divider = next((mark for mark in ";\t" if mark in lines[0][1]), ",")
    cells = list(
        csv.reader(io.StringIO("\n".join(line for _, line in lines)), delimiter=divider)
    )
    depth_column, cone_column, unit = columns_of(path, cells[0])
    depth: list[float] = []
    resistance: list[float] = []
    for (row, _), entries in zip(lines[1:], cells[1:]):
        z = number_of(path, row, entries, depth_column)
        q = unit * number_of(path, row, entries, cone_column)
        check_row(path, row, z, depth[-1] if depth else None, q)
        depth.append(z)
        resistance.append(q)
    return Profile(depth, resistance)


def adopt(path: Path, directory: Path) -> None:
    """Copy a test into the directory of a run, where pictures and report find it.
    Raises ResultsError where it cannot be read."""
    read(path)
    if not directory.is_dir():
        raise ResultsError(f"no directory {directory}")
    target = directory / NAME
    if not (target.exists() and target.samefile(path)):
        shutil.copyfile(path, target)


def of_run(directory: Path) -> Profile | None:
    """Return the test in the directory of a run, None where there is none."""
    path = directory / NAME
    return read(path) if path.is_file() else None
