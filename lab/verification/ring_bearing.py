# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a ring inside a caisson bears in undrained clay, by limit analysis.

A rigid ring of the width w at the wall of a smooth tube of the radius R is pushed into
clay of Tresca's law with the strength su, which fills the tube below. The ring and the
wall are smooth. The clay that the ring displaces rises through the opening of the
radius R - w: beneath a ring that is d below the first surface, the clay stands

    h = d R^2 / (R - w)^2

above the lower face of the ring, or more where the tip of the tube displaces clay, too.
The gap behind the ring is open. With the area A of the ring's lower face, the bearing
factor is Nc = F / (A su); weight would add the pressure of the column of clay.

The velocities are relative to the ring: it is fixed, the clay comes from below with
the velocity one across the whole tube, and its lower end lies a radius below the ring.
The power of the force of the clay on the ring is then that of the pressure on this end,
F = p pi R^2, as the clay above is free. Nothing but the ring resists in a smooth tube.

Meshes have n / 4, n / 2 and n cells beneath the ring and are graded towards its edge.
"""
import argparse
from dataclasses import dataclass

import numpy as np

from lab.verification.limit_analysis import (
    Mesh,
    Strength,
    extrapolated,
    graded,
    join,
    limit_load,
    soil_of,
)
from lab.verification.options import declare


@dataclass(frozen=True)
class Ring:
    """A ring at the wall of a tube, whose inner radius is one."""

    width: float  # over the radius of the tube
    column: float  # height of the clay above the lower face, over that radius
    height: float = 0.05  # of the ring itself, over that radius


def bearing_factor(ring: Ring, n: int) -> float:
    """Return Nc by a mesh of n cells beneath the ring."""
    edge, growth = 1 - ring.width, 20.0
    r = join(graded(edge, 1.0, n, growth), graded(edge, 0.0, 2 * n, 2 * growth))
    below = graded(ring.column, ring.column + 1, 2 * n, 2 * growth)
    above = [ring.column - min(ring.height, ring.column), ring.column]
    if ring.column > ring.height:
        above = [
            *graded(above[0], 0.0, n, growth),
            *graded(ring.column, above[0], n, 4),
        ]
    z = join(np.array(above), below)
    mesh = Mesh(r, z)
    center = mesh.corner + mesh.size / 2
    mesh.remove((center[:, 0] > edge) & (center[:, 1] < ring.column))
    at_r, at_z = mesh.place.T
    face = np.isclose(at_z, ring.column) & (at_r >= edge)
    side = np.isclose(at_r, edge) & (at_z <= ring.column)
    side &= at_z >= ring.column - ring.height - 1e-9
    end = at_z == at_z.max()
    mesh.fix((at_r == 0) | (at_r == at_r.max()) | side, 0)
    mesh.fix(face, 1)
    size = mesh.number(end)
    soil = soil_of(mesh, size, Strength())
    rows = [(soil.m, 1), (soil.m_and_q, 3)]
    # the pressure on the end has the power one, and its area is 1 / 2 over 2 pi
    force = limit_load(rows, soil.volume, -mesh.flux(end, 1, size))[0] / 2
    return force / ((1 - edge**2) / 2)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of scripts/lab ring-bearing."""
    declare(
        parser,
        width=([0.25], "of the ring (inner radii of the tube)"),
        column=(
            [0.0, 0.1, 0.3, 0.6],
            "of clay above the lower face of the ring (inner radii of the tube)",
        ),
        cells=(16, "of the finest mesh, at the ring (none)"),
    )


def main(options: argparse.Namespace) -> int:
    """Print the bearing factor of rings."""
    n = options.cells
    print("Nc on three meshes and extrapolated")
    print("   w/R     h/R   coarse   medium     fine    limit")
    for width in options.width:
        for column in options.column:
            ring = Ring(width, column)
            factors = [bearing_factor(ring, k) for k in (n // 4, n // 2, n)]
            shown = "".join(f"{x:9.3f}" for x in [*factors, extrapolated(factors)])
            print(f"{width:6g}{column:8g}{shown}", flush=True)
    return 0
