# SPDX-License-Identifier: LGPL-2.1-or-later
"""Equilibrium of the exported stress on its mesh: residual and correction.

A cell has one stress, as other programs take it. The forces of nodes are, for the whole
circumference,

  R = f - integral of B^T (sigma' - p 1) dV,

where f is the buoyant weight, the pressure on the surface and the vertical force of
walls and tip, as history.csv has it. The residual is the sum of |R| over the nodes that
can move, over the weight of the mesh. Where it exceeds what is allowed, an elastic
displacement u with K u = R gives the correction of the stress, its mean over each cell.
As the mean does not take all of the force, this repeats as conjugate gradients,
preconditioned by K. Young's modulus follows the stress, so that small stresses are
corrected by little. Sides, bottom and wall are held: their forces are reactions.
"""
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.linalg import splu

from caisson.results import ResultsError
from caisson.export.interpolate import Values, interpolate
from caisson.export.mesh import Mesh
from caisson.export.state import STIFFNESS, State

# residuals over the weight: what is left as it is, and where a correction stops. What
# remains then alternates from cell to cell, and would only bring such a stress
ALLOWED, WANTED = 1e-3, 7e-3
MOST_TIMES = 100
MOST_OFF = 0.05  # of a force of the run on wall or tip: more is refused
LEAST = (
    1e-5  # of the weight: forces on walls need no smaller an error than a share of it
)
POISSON = 0.25
# vertical forces of history.csv; those of water are there with pore water only
FORCES = {
    "TIP": ("tip_force_N", "tip_water_force_N"),
    "INNER_WALL": ("inner_friction_N",),
    "OUTER_WALL": ("outer_friction_N",),
}


class Forces:
    """The axisymmetric integrals over a mesh, by 2 x 2 Gauss points."""

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        s = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
        corners = mesh.nodes[mesh.cells]
        strains, volumes, shapes = [], [], []
        for xi, eta in ((a, b) for a in (-1, 1) for b in (-1, 1)):
            x, y = xi / np.sqrt(3), eta / np.sqrt(3)
            shape = (1 + s[0] * x) * (1 + s[1] * y) / 4
            local = np.stack([s[0] * (1 + s[1] * y), s[1] * (1 + s[0] * x)]) / 4
            jacobian = np.einsum("ia,nab->nib", local, corners)
            gradient = np.linalg.solve(
                jacobian, np.broadcast_to(local, (len(corners), 2, 4))
            )
            r = corners[:, :, 0] @ shape
            strain = np.zeros((len(corners), 4, 8))  # rr, zz, tt, 2 rz
            strain[:, 0, 0::2] = strain[:, 3, 1::2] = gradient[:, 0]
            strain[:, 1, 1::2] = strain[:, 3, 0::2] = gradient[:, 1]
            strain[:, 2, 0::2] = shape / r[:, np.newaxis]
            strains.append(strain)
            volumes.append(2 * np.pi * r * np.linalg.det(jacobian))
            shapes.append(shape)
        self.strain, self.part = np.array(strains), np.array(volumes)
        self.volume = self.part.sum(axis=0)
        self.integral = np.einsum("gn,gnij->nij", self.part, self.strain)
        self.share = np.einsum("gn,ga->na", self.part, np.array(shapes))
        self.unknowns = np.stack([2 * mesh.cells, 2 * mesh.cells + 1], axis=2)
        self.unknowns = self.unknowns.reshape(-1, 8)

    def sum_of(self, values: np.ndarray) -> np.ndarray:
        """Return the sum at nodes [2 n_nodes] of values of cells [m, 8]."""
        size = 2 * len(self.mesh.nodes)
        return np.bincount(self.unknowns.ravel(), values.ravel(), minlength=size)

    def internal(self, stress: np.ndarray) -> np.ndarray:
        """Return the integral of B^T sigma of stresses of cells [m, 4]."""
        return self.sum_of(np.einsum("nij,ni->nj", self.integral, stress))

    def weight(self, unit_weight: np.ndarray) -> np.ndarray:
        """Return the forces of weight, of unit weights of cells [m]."""
        values = np.zeros((len(self.share), 8))
        values[:, 1::2] = -unit_weight[:, np.newaxis] * self.share
        return self.sum_of(values)

    def of_surface(self, pressure: np.ndarray) -> np.ndarray:
        """Return the forces of a pressure of nodes [n_nodes] on the surface."""
        force = np.zeros(2 * len(self.mesh.nodes))
        on = np.zeros(len(self.mesh.nodes), dtype=bool)
        on[self.mesh.sets.get("SURFACE", [])] = True
        edges = self.mesh.edges()
        for a, b in edges[on[edges].all(axis=1)]:
            (ra, za), (rb, zb) = self.mesh.nodes[[a, b]]
            inward = np.array([za - zb, rb - ra])
            for node, share in ((a, 2 * ra + rb), (b, ra + 2 * rb)):
                mean = (pressure[a] + pressure[b]) / 2
                force[[2 * node, 2 * node + 1]] += 2 * np.pi * mean * share / 6 * inward
        return force

    def stiffness(self, modulus: np.ndarray) -> tuple[csr_matrix, np.ndarray]:
        """Return the stiffness, of Young's moduli of cells [m], and their elasticity
        [m, 4, 4]."""
        lame = modulus * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
        shear = modulus / (2 * (1 + POISSON))
        elastic = np.zeros((len(modulus), 4, 4))
        elastic[:, :3, :3] = lame[:, np.newaxis, np.newaxis]
        elastic[:, [0, 1, 2], [0, 1, 2]] += 2 * shear[:, np.newaxis]
        elastic[:, 3, 3] = shear
        b = self.strain
        cells = np.einsum(
            "gn,gnki,nkl,gnlj->nij", self.part, b, elastic, b, optimize=True
        )
        rows = np.repeat(self.unknowns, 8, axis=1)
        columns = np.tile(self.unknowns, (1, 8))
        size = 2 * len(self.mesh.nodes)
        entries = (cells.ravel(), (rows.ravel(), columns.ravel()))
        return coo_matrix(entries, shape=(size, size)).tocsr(), elastic


@dataclass
class Balanced:
    """A balanced state on a mesh of n nodes and m cells.

    stress [m, 4] (Pa, effective); correction [m, 4] (Pa): what was added to the
    interpolated values; before, after: the residuals over the weight (N); volume [m]
    (m3); unit_weight [m] (N/m3); applied [n, 2]: forces on the soil besides weight and
    reactions (N, whole circumference), of wall and tip and of water on the surface;
    held [n, 2]: the components with reactions; wall_before, wall: vertical forces of
    the soil on the walls and the tip (N, upward) by the names of their nodes.
    """

    state: State
    mesh: Mesh
    values: Values
    stress: np.ndarray
    correction: np.ndarray
    before: float
    after: float
    weight: float
    volume: np.ndarray
    unit_weight: np.ndarray
    applied: np.ndarray
    held: np.ndarray
    wall_before: dict[str, float]
    wall: dict[str, float]

    @property
    def exceeds(self) -> np.ndarray:
        """Whether the correction of a cell exceeds the scatter of its points: [m]."""
        scatter = np.linalg.norm(self.values.scatter, axis=1)
        return np.linalg.norm(self.correction, axis=1) > scatter

    @property
    def size_of_correction(self) -> float:
        """The correction over the stress, both in the mean of squares by volume."""
        parts = [
            (x**2).sum(axis=1) @ self.volume for x in (self.correction, self.stress)
        ]
        return float(np.sqrt(parts[0] / parts[1])) if parts[1] else 0.0

    @property
    def total(self) -> np.ndarray:
        """The stress less the excess pore pressure, which balances buoyant weight."""
        return with_pressure(self.stress, self.values.pressure)


def with_pressure(stress: np.ndarray, pressure: np.ndarray) -> np.ndarray:
    """Return effective stress less the pressure: [m, 4]."""
    return stress - pressure[:, np.newaxis] * [1, 1, 1, 0]


def residual(force: np.ndarray, free: np.ndarray, weight: float) -> float:
    """Return the sum of the forces at the free nodes over the weight."""
    return float(np.hypot(*np.where(free, force, 0).reshape(-1, 2).T).sum() / weight)


def held(mesh: Mesh) -> np.ndarray:
    """Return the unknowns that are held: [2 n_nodes]."""
    result = np.zeros((len(mesh.nodes), 2), dtype=bool)
    result[mesh.sets.get("AXIS", []), 0] = True
    for name in ("BOTTOM", "OUTER", *FORCES):
        result[mesh.sets.get(name, [])] = True
    return result.ravel()


def on_wall(mesh: Mesh, force: np.ndarray) -> dict[str, float]:
    """Return the vertical forces on the walls and the tip (N) of forces of nodes."""
    return {
        name: float(force[2 * mesh.sets[name] + 1].sum())
        for name in FORCES
        if name in mesh.sets
    }


def force_of_run(state: State, name: str) -> float | None:
    """Return the vertical force of the soil on the wall or the tip in the run (N)."""
    known = [state.forces[c] for c in FORCES[name] if c in state.forces]
    return sum(known) if known else None


def wall_forces(
    state: State, mesh: Mesh, own: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the vertical forces of wall and tip in the run on the soil, [2 n_nodes]
    (N), and the unknowns of walls where they are known. They are spread over the nodes
    as that of the stress, own, is, or by the normal force where that has another sign;
    over the tip they may be spread in any way."""
    result, known = np.zeros(len(own)), np.zeros(len(own), dtype=bool)
    for name in FORCES:
        force = force_of_run(state, name)
        nodes = mesh.sets.get(name, np.zeros(0, dtype=int))
        if force is None or not len(nodes):
            continue
        spread = np.maximum(own[2 * nodes + 1] * np.sign(force), 0)
        if spread.sum() < 0.2 * abs(force):
            spread = abs(own[2 * nodes])
        if spread.sum() == 0:
            spread = np.ones(len(nodes))
        result[2 * nodes + 1] = -force * spread / spread.sum()
        known[2 * nodes + 1] = name != "TIP"
    return result, known


def unknowns(mesh: Mesh, free: np.ndarray, moves_tip: bool) -> csr_matrix:
    """Return what takes the unknowns of the solution to those of the nodes, [2 n_nodes,
    k]: the free ones, and one for the tip, which moves as a whole under its force."""
    rows = np.flatnonzero(free)
    columns = np.arange(len(rows))
    size = len(rows)
    if moves_tip:
        tip = 2 * mesh.sets["TIP"] + 1
        rows = np.concatenate([rows, tip])
        columns = np.concatenate([columns, np.full(len(tip), size)])
        size += 1
    entries = (np.ones(len(rows)), (rows, columns))
    return coo_matrix(entries, shape=(len(free), size)).tocsr()


def corrected(
    forces: Forces,
    stress: np.ndarray,
    external: np.ndarray,
    free: csr_matrix,
    residual_of: Callable[[np.ndarray], float],
) -> np.ndarray:
    """Return the correction [m, 4] that balances a stress (Pa) with the forces; free:
    what unknowns() returns; residual_of: of forces [2 n_nodes]."""
    level = np.linalg.norm(stress, axis=1)
    mean_level = forces.volume @ level / forces.volume.sum()
    matrix, elastic = forces.stiffness(STIFFNESS * np.maximum(level, 0.05 * mean_level))
    try:
        factors = splu((free.T @ matrix @ free).tocsc())
    except RuntimeError as error:
        raise ResultsError(
            "a part of the mesh is not held: it must be one piece, from the axis to a"
            " vertical side"
        ) from error
    mean = forces.integral / forces.volume[:, np.newaxis, np.newaxis]
    correction = np.zeros_like(stress)
    rest = external - forces.internal(stress)
    direction, product = np.zeros(free.shape[1]), np.inf
    for _ in range(MOST_TIMES):
        if residual_of(rest) < WANTED:
            break
        better = factors.solve(free.T @ rest)
        before, product = product, (free.T @ rest) @ better
        direction = better + product / before * direction
        strain = np.einsum("nij,nj->ni", mean, (free @ direction)[forces.unknowns])
        more = np.einsum("nij,nj->ni", elastic, strain)
        change = forces.internal(more)
        length = product / (direction @ (free.T @ change))
        correction += length * more
        rest -= length * change
    return correction


def balance(state: State, mesh: Mesh, values: Values) -> Balanced:
    """Return the balanced state."""
    forces = Forces(mesh)
    unit_weight = state.weight_of_layers[values.layer]
    weight = float(unit_weight @ forces.volume)
    loads = forces.weight(unit_weight)
    surface = forces.of_surface(surface_pressure(state, mesh))
    stress = with_pressure(values.stress, values.pressure)
    own = loads + surface - forces.internal(stress)
    of_wall, known = wall_forces(state, mesh, own)
    moves_tip = "TIP" in mesh.sets and force_of_run(state, "TIP") is not None
    is_held = held(mesh) & ~known
    external, free = loads + surface + of_wall, ~is_held

    def out_of_balance(rest: np.ndarray) -> float:
        """Return the residual, or the error of the force on a wall."""
        errors = [residual(rest, free, weight)]
        for name, force in on_wall(mesh, rest).items():
            if known[2 * mesh.sets[name] + 1].any():
                size = max(abs(force_of_run(state, name) or 0), LEAST * weight)
                errors.append(abs(force) / size)
        return max(errors)

    before = residual(external - forces.internal(stress), free, weight)
    correction = np.zeros_like(values.stress)
    if before > ALLOWED:
        some = unknowns(mesh, free, moves_tip)
        correction = corrected(forces, stress, external, some, out_of_balance)
    inner = forces.internal(stress + correction)
    return Balanced(
        state=state,
        mesh=mesh,
        values=values,
        stress=values.stress + correction,
        correction=correction,
        before=before,
        after=residual(external - inner, free, weight),
        weight=weight,
        volume=forces.volume,
        unit_weight=unit_weight,
        applied=(surface + of_wall).reshape(-1, 2),
        held=is_held.reshape(-1, 2),
        wall_before=on_wall(mesh, own),
        wall=on_wall(mesh, loads + surface - inner),
    )


def check_forces(state: Balanced, advice: str) -> None:
    """Raise ResultsError, with the advice, where the exported force on a wall or the
    tip differs from that of the run by more than MOST_OFF, and the allowed residual."""
    for name, force in state.wall.items():
        run = force_of_run(state.state, name)
        if run is None:
            continue
        if abs(force - run) > max(MOST_OFF * abs(run), ALLOWED * state.weight):
            raise ResultsError(
                f"the vertical force on {name} is {force / 1e3:.5g} kN on this mesh,"
                f" and {run / 1e3:.5g} kN in the run: they differ by more than"
                f" {100 * MOST_OFF:g} %. The mesh is too coarse at the wall: {advice}"
            )


def surface_pressure(state: State, mesh: Mesh) -> np.ndarray:
    """Return the pressure of water, surcharge and lid on the nodes of the surface, 0
    elsewhere: [n] (Pa)."""
    pressure = np.zeros(len(mesh.nodes))
    surface = mesh.sets.get("SURFACE", np.zeros(0, dtype=int))
    if not len(surface):
        return pressure
    pressure[surface] = state.surcharge
    if state.pressure is not None:
        pressure[surface] += interpolate(state, mesh.nodes[surface]).pressure
    if state.wall is not None:
        plug = surface[mesh.nodes[surface, 0] < state.wall.inner * (1 + 1e-6)]
        pressure[plug] += state.lid_pressure
    return pressure
