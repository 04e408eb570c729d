# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance of a caisson from a cone penetration test (CPT).

The methods from a cone take the forces as proportional to the cone resistance q_c:

    tip = k_p q_c(h) A,                  A = pi (D_o - t) t,     and so on ledges,
    friction = pi D integral of k_f q_c dz from 0 to h, on each wall,

with D = D_o outside and D_i inside, the wall thickness t, and k_p and k_f of the layer
at the depth. The methods differ in these coefficients: dnv, senders_randolph,
andersen.

Between two rows of a test q_c is linear. Above the first row it is that of the first
row; below the last row there is no answer (nan).

SI units; z is the depth below the mudline (m), q_c is in Pa.
"""
import contextlib
from collections.abc import Mapping, Sequence
from math import inf, nan, pi
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson import disk
from caisson.band import HIGH, LOW
from caisson.design import cone_file
from caisson.disk import InputError
from caisson.design.cone_options import How
from caisson.design.method import Forces, with_ledges
from caisson.ledges import Ledge

NAME = "cone.csv"  # of the test in the directory of a run


class Profile:
    """The cone resistance over depth; assumed: of one that was not measured, what it
    rests on, in a sentence."""

    assumed = ""

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
    ledges: tuple[Ledge, ...] = ()

    @property
    def inner_diameter(self) -> float:
        """D_i (m)."""
        return self.outer_diameter - 2 * self.wall_thickness

    @property
    def tip_area(self) -> float:
        """The area of the end of the wall (m2)."""
        return pi * (self.outer_diameter - self.wall_thickness) * self.wall_thickness


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
        found = self.plain_forces(h, case)
        return with_ledges(
            found, self.skirt.ledges, h, lambda _, z: self.pressure(z, case)
        )

    def pressure(self, z: float, case: str) -> float:
        """Return what bears on a face that looks down at a depth (Pa): k_p q_c."""
        above = [layer for layer in self.layers if layer.top < z] or self.layers[:1]
        tip = above[-1].coefficients[case].tip
        return tip * self.profile.at(z) if tip else 0.0

    def plain_forces(self, h: float, case: str) -> Forces:
        """Return the forces on the tip and on the walls at an embedment."""
        bottoms = [layer.top for layer in self.layers[1:]] + [inf]
        inner = outer = 0.0
        for layer, bottom in zip(self.layers, bottoms):
            if layer.top >= h:
                break
            k = layer.coefficients[case]
            if not k.inner and not k.outer:  # no cone resistance needs to be known
                continue
            part = self.profile.integral(min(bottom, h))
            part -= self.profile.integral(layer.top)
            inner, outer = inner + k.inner * part, outer + k.outer * part
        return Forces(
            self.pressure(h, case) * self.skirt.tip_area,
            inner * pi * self.skirt.inner_diameter,
            outer * pi * self.skirt.outer_diameter,
        )


# ------------------------------------------------------------------- files


def read(path: Path) -> Profile:
    """Return depth and resistance of the test in a file (caisson.design.cone_file).
    Raises InputError, with the rows that are wrong."""
    test = cone_file.read(path, with_friction=False)
    return Profile(test.depth.tolist(), test.resistance.tolist())


def adopt(path: Path, directory: Path, how: How = How()) -> tuple[str, ...]:
    """Keep a test in the directory of a run, where pictures and report find it: as it
    is, or as a table if it is none with heads. how: what options say of the file.
    Return in words what was made of it. Raises InputError where it cannot be read."""
    test = cone_file.read(path, with_friction=False, how=how)
    with contextlib.suppress(InputError):  # of a column that is not needed
        whole = cone_file.read(path, how=how)
        test = whole if whole.was_zeroed else test
    if not directory.is_dir():
        raise InputError(f"no directory {directory}")
    target = directory / NAME
    if test.is_plain and not test.was_zeroed:
        disk.keep(target, disk.read_bytes(path))
    else:
        disk.keep(target, cone_file.text_of(test))
    return test.remarks


def beside(scene: Path) -> Path:
    """Return where the cone test of a scene is, also of the low or high one."""
    stem = scene.stem.removesuffix(f"_{LOW}").removesuffix(f"_{HIGH}")
    return scene.with_name(f"{stem}_{NAME}")


def adopt_beside(directory: Path, scene: Path) -> None:
    """Keep the cone test beside a scene with its run, unless that has one."""
    if beside(scene).is_file() and not (directory / NAME).exists():
        adopt(beside(scene), directory)


def of_run(directory: Path) -> Profile | None:
    """Return the test in the directory of a run, None where there is none."""
    path = directory / NAME
    return read(path) if path.is_file() else None
