# SPDX-License-Identifier: LGPL-2.1-or-later
"""The suction that lifts the plug of a caisson in undrained clay, by limit analysis.

A rigid caisson is held in a half-space of clay of Tresca's law, whose strength su is
uniform, grows with depth, or is another one from a boundary below the tip on. The wall
is smooth or has an adhesion, and may be thin as a blade; its tip, if it has an area,
has the same adhesion, and no gap opens anywhere. The suction s pulls the surface of the
plug upwards. The plug cannot slide alone: the clay below has to follow, and flows in
around the tip. So there is one limit load for both, which limit_analysis.py finds
without a choice of mechanism. By hand it is written as

    s = Nc su + 4 a (h / D) su_mean,

with su at the depth h of the tip, su_mean above it, the adhesion factor a and the
diameter D inside. The wall counts with its full strength on the inside, and the outside
of a rough wall is in Nc. The method of caisson/design/plug_stability.py stands beside
the limit.

**Weight does not matter.** The power of the weight on velocities without change of
volume is that of the pressure of a fluid of the same weight on the surface, which is
zero where the surface is level, inside and outside. Strength does not depend on the
mean stress, nor does adhesion on the normal one.

**Suction by the flow of water** has the same limit. Water with any pressure p that is
-s on the plug and zero outside pulls at the clay with -grad p. Where the volume does
not change and nothing crosses the wall, the power of this on v is that of -p on the
normal velocity of the surface, which is that of s on the plug. A program that computes
the flow thus has to find the same load, if tension neither breaks the clay nor opens a
gap.

Meshes are graded towards the tip and have n / 4, n / 2 and n cells inside, at the
surface and at the wall. The order of the differences is between one and two.
"""
import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from scipy import sparse

from caisson.design.clay import Layer
from caisson.design.cone import Skirt
from caisson.design.plug_stability import reverse_bearing
from lab.verification.limit_analysis import (
    Mesh,
    Strength,
    extrapolated,
    graded,
    join,
    limit_load,
    soil_of,
    towards,
)
from lab.verification.options import declare


@dataclass(frozen=True)
class Caisson:
    """A caisson that is held in clay."""

    depth: float  # of the tip (m)
    adhesion: float = 1.0  # of wall and tip, over the strength of the clay
    thickness: float = 0.0  # of the wall (m)
    radius: float = 1.0  # inside (m)


def mesh_of(
    caisson: Caisson, n: int, extent: float, tops: Sequence[float] = ()
) -> Mesh:
    """Return the mesh around a caisson, whose cells are small at the tip and at the
    tops (m) of layers.

    n: cells inside, at the surface; extent: of the soil outside and below the tip, over
    the radius.
    """
    inner, tip, growth = caisson.radius, caisson.depth, 20.0
    outer, far = inner + caisson.thickness, extent * caisson.radius
    r = join(
        graded(inner, 0.0, n, growth),
        np.linspace(inner, outer, max(n // 4, 2) + 1),
        graded(outer, outer + far, 3 * n // 2, 3 * growth),
    )
    z = join(
        graded(tip, 0.0, n, growth),
        graded(tip, tip + far, 3 * n // 2, 3 * growth),
    )
    if tops:
        places = [tip, *(x for x in tops if x < tip + far)]
        z = towards(np.unique(places), tip + far, n, inner)
    mesh = Mesh(r, z)
    if caisson.thickness > 0:
        center = mesh.corner + mesh.size / 2
        wall = (center[:, 0] > inner) & (center[:, 0] < outer) & (center[:, 1] < tip)
        mesh.remove(wall)
    else:
        mesh.slit(inner, tip)
    return mesh


def lift(caisson: Caisson, strength: Strength, n: int, extent: float = 4.0) -> float:
    """Return the suction that lifts the plug (Pa), by a mesh of n cells inside."""
    tops = [top for top, _ in strength.layers]
    mesh = mesh_of(caisson, n, extent, tops)
    r, z = mesh.place.T
    inner, tip = caisson.radius, caisson.depth
    outer = inner + caisson.thickness
    wall = ((r == inner) | (r == outer)) & (z <= tip)
    base = (r >= inner) & (r <= outer) & (z == tip)
    end = (r == r.max()) | (z == z.max())
    mesh.fix(wall | end | (r == 0), 0)
    mesh.fix((base & (outer > inner)) | end, 1)
    size = mesh.number()
    soil = soil_of(mesh, size, strength)
    scalars = [soil.m]
    if caisson.adhesion > 0:
        slips = [mesh.on_edges(wall, 1, strength)]
        if outer > inner:
            slips.append(mesh.on_edges(base, 0, strength))
        scalars += [caisson.adhesion * rows.matrix(size) for rows in slips]
    rows = [(sparse.vstack(scalars).tocsr(), 1), (soil.m_and_q, 3)]
    # suction pulls upwards, and its power does not depend on where the plug rises
    load = -mesh.flux((z == 0) & (r <= inner), 1, size)
    return limit_load(rows, soil.volume, load)[0]


def bearing_factor(load: float, caisson: Caisson, strength: Strength) -> float:
    """Return Nc of the load Nc su + 4 a h su_mean / D; su is that at the tip."""
    at_tip, mean = strength.at(caisson.depth * np.array([1.0, 0.5]))
    friction = caisson.adhesion * 2 * caisson.depth / caisson.radius * mean
    return float((load - friction) / at_tip)


def by_hand(caisson: Caisson, strength: Strength) -> float:
    """Return the suction of the design method (Pa)."""
    depth, adhesion = caisson.depth, caisson.adhesion
    outer = 2 * (caisson.radius + caisson.thickness)
    at_tip, mean = strength.at(depth * np.array([1.0, 0.5]))
    layers = [Layer(0, 0, float(at_tip), adhesion * float(mean), 0)]
    layers += [Layer(top, 0, s_u, adhesion * s_u, 0) for top, s_u in strength.layers]
    return reverse_bearing(Skirt(outer, caisson.thickness, 0, 0), layers, depth)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of scripts/lab plug-lift."""
    declare(
        parser,
        depth=([0.25, 0.5, 1.0], "of the tip (D inside)"),
        adhesion=([0, 0.5, 1.0], "over strength"),
        gradient=([0, 2.0], "of the strength (su0/D)"),
        ratio=([1.0], "of the strength below a boundary to that at the tip"),
        boundary=([0.0], "below the tip (D inside)"),
        thickness=(0.0, "of the wall (radii inside)"),
        cells=(16, "of the finest mesh, inside (none)"),
        extent=(4.0, "of the soil beyond the tip (radii)"),
    )


def cases_of(options: argparse.Namespace) -> Iterator[tuple[Caisson, Strength]]:
    """Return the caissons and the clay of a table."""
    for gradient, h, adhesion, ratio, below in product(
        *(options.gradient, options.depth, options.adhesion),
        *(options.ratio, options.boundary),
    ):
        strength = Strength(1.0, gradient / 2)
        if ratio != 1:
            layer = 2 * (h + below), ratio * float(strength.at(np.array(2 * h)))
            strength = replace(strength, layers=(layer,))
        if ratio != 1 or below == options.boundary[0]:
            yield Caisson(2 * h, adhesion, options.thickness), strength


def main(options: argparse.Namespace) -> int:
    """Print the suction that lifts the plug, the bearing factor, and the method."""
    n = options.cells
    print("s / su at the tip, on three meshes and extrapolated; ratio: of the strength")
    print("below a boundary, which is this far below the tip")
    heads = (
        "k D/su0   h/D adhesion   ratio  below/D   coarse   medium     fine    limit"
    )
    print(f"{heads}      Nc  method  method/limit")
    for caisson, strength in cases_of(options):
        meshes = (n // 4, n // 2, n)
        loads = [lift(caisson, strength, cells, options.extent) for cells in meshes]
        limit, at_tip = extrapolated(loads), float(strength.at(np.array(caisson.depth)))
        top, below = next(iter(strength.layers), (caisson.depth, at_tip))
        shown = f"{2 * strength.gradient:7g}{caisson.depth / 2:6g}{caisson.adhesion:9g}"
        shown += f"{below / at_tip:8g}{(top - caisson.depth) / 2:9.3g}"
        shown += "".join(f"{x / at_tip:9.3f}" for x in [*loads, limit])
        factor = bearing_factor(limit, caisson, strength)
        method = by_hand(caisson, strength)
        shown += f"{factor:8.2f}{method / at_tip:8.3f}{method / limit:14.2f}"
        print(shown, flush=True)
    return 0
