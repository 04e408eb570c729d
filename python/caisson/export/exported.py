# SPDX-License-Identifier: LGPL-2.1-or-later
"""The state of the soil on a mesh, and what acts on it: weight, water, and the forces
of the run on wall and tip.

The stress of a cell is interpolated, and is not in equilibrium on another mesh: the
first step of the other program finds that with its own elements. What is stated is the
balance of the whole mesh: the vertical force of the stress on its boundary beside the
weight, and beside the forces of the run.
"""
from dataclasses import dataclass

import numpy as np

from caisson.export.interpolate import Values, interpolate
from caisson.export.mesh import Mesh
from caisson.export.state import State

# vertical forces of history.csv; those of water are there with pore water only
FORCES = {
    "TIP": ("tip_force_N", "tip_water_force_N"),
    "INNER_WALL": ("inner_friction_N",),
    "OUTER_WALL": ("outer_friction_N",),
}
LEAST_SHARE = 0.2  # of a force in the vertical stress beside it that spreads like it


@dataclass
class Exported:
    """A state on a mesh of n nodes and m cells.

    unit_weight [m] (N/m3); applied [n, 2]: forces on the soil besides weight and
    reactions (N, whole circumference), of the wall and of water on the surface;
    held [n, 2]: the components with reactions; wall: vertical forces of the soil on the
    walls and the tip (N, upward) by the names of their nodes, as interpolated;
    boundary: that of the stress on all of the boundary.
    """

    state: State
    mesh: Mesh
    values: Values
    unit_weight: np.ndarray
    applied: np.ndarray
    held: np.ndarray
    wall: dict[str, float]
    boundary: float

    @property
    def weight(self) -> float:
        """The buoyant weight of the mesh (N)."""
        return float(self.unit_weight @ self.mesh.volumes)


def at_ends(mesh: Mesh, edges: np.ndarray, forces: np.ndarray) -> np.ndarray:
    """Return forces of edges [k, 2] (N) at the nodes: half at each end [n, 2]."""
    result = np.zeros_like(mesh.nodes)
    np.add.at(result, edges.ravel(), np.repeat(forces / 2, 2, axis=0))
    return result


def on_boundary(state: State, mesh: Mesh) -> np.ndarray:
    """Return the forces of the interpolated stress on the boundary of a mesh, at its
    nodes: [n, 2] (N, whole circumference)."""
    edges = mesh.edges()
    middle = mesh.nodes[edges].mean(axis=1)
    rr, zz, _, rz = interpolate(state, middle).total.T
    outward = inward(mesh, edges) * -1
    tensor = np.array([[rr, rz], [rz, zz]])
    force = np.einsum("ijk,kj->ki", tensor, outward)
    return at_ends(mesh, edges, force)


def inward(mesh: Mesh, edges: np.ndarray) -> np.ndarray:
    """Return the areas of edges as vectors into the soil, which is on their left:
    [k, 2] (m2)."""
    first, last = mesh.nodes[edges[:, 0]], mesh.nodes[edges[:, 1]]
    (r, z), radius = (last - first).T, (first + last)[:, 0] / 2
    return 2 * np.pi * np.column_stack([-z * radius, r * radius])


def on_surface(state: State, mesh: Mesh) -> np.ndarray:
    """Return the forces of water, surcharge and lid on the surface: [n, 2] (N). The
    suction acts on the total stress of clay, whose pore pressure is not known."""
    on = np.zeros(len(mesh.nodes), dtype=bool)
    on[mesh.sets.get("SURFACE", [])] = True
    edges = mesh.edges()
    edges = edges[on[edges].all(axis=1)]
    middle = mesh.nodes[edges].mean(axis=1)
    pressure = np.full(len(edges), float(state.surcharge))
    if state.wall is not None:
        pressure[middle[:, 0] < state.wall.inner] += state.lid_pressure
    if len(edges):
        at = interpolate(state, middle)
        total = np.array([layer.total for layer in state.layers])[at.layer]
        if state.wall is not None:
            total &= middle[:, 0] < state.wall.inner
        pressure += np.where(total, -state.suction, at.pressure)
    return at_ends(mesh, edges, pressure[:, np.newaxis] * inward(mesh, edges))


def force_of_run(state: State, name: str) -> float | None:
    """Return the vertical force of the soil on the wall or the tip in the run (N)."""
    known = [state.forces[c] for c in FORCES[name] if c in state.forces]
    return sum(known) if known else None


def spread_of(force: float, stress: np.ndarray) -> np.ndarray:
    """Return how a vertical force is spread over nodes: like that of the stress there,
    [n, 2], or like the normal one where most of that has another sign."""
    spread = np.maximum(-stress[:, 1] * np.sign(force), 0)
    if spread.sum() < LEAST_SHARE * abs(force):
        spread = abs(stress[:, 0])
    if spread.sum() == 0:
        spread = np.ones(len(spread))
    return spread / spread.sum()


def held(mesh: Mesh) -> np.ndarray:
    """Return the components that are held where no force of a wall is known: [n, 2]."""
    result = np.zeros(mesh.nodes.shape, dtype=bool)
    result[mesh.sets.get("AXIS", []), 0] = True
    for name in ("BOTTOM", "OUTER", *FORCES):
        result[mesh.sets.get(name, [])] = True
    return result


def exported(state: State, mesh: Mesh) -> Exported:
    """Return a state on a mesh."""
    values = interpolate(state, mesh.centers)
    stress = on_boundary(state, mesh)
    applied, is_held, wall = on_surface(state, mesh), held(mesh), dict[str, float]()
    for name in FORCES:
        nodes, force = mesh.sets.get(name), force_of_run(state, name)
        if nodes is None:
            continue
        wall[name] = -float(stress[nodes, 1].sum())
        if force is not None and name != "TIP":  # the tip is held
            applied[nodes, 1] -= force * spread_of(force, stress[nodes])
            is_held[nodes, 1] = False
    weight = np.array([layer.unit_weight for layer in state.layers])[values.layer]
    boundary = float(stress[:, 1].sum())
    return Exported(state, mesh, values, weight, applied, is_held, wall, boundary)
