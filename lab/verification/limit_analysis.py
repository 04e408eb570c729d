# SPDX-License-Identifier: LGPL-2.1-or-later
"""Limit loads of undrained clay around an axis, by finite elements.

Clay of Tresca's law with the strength su does not change its volume and dissipates
2 su max |e| per volume, where e are the principal strain rates. The limit load is the
least dissipation of the velocities v on which the load has the power 1. Around an axis,
with the hoop strain rate -2 m and the radius |q| of Mohr's circle in the plane of r
and z, the other two rates are m + |q| and m - |q|, so that

    2 su max |e| = 2 su (|m| + max(|m|, |q|)),

and a wall with the adhesion a on which clay slips with v dissipates a |v| per area.
Both are the largest power of stresses: of two numbers in [-1, 1] on m, one of which, b,
has beside it a vector c on q with |c| <= 1 - |b|; and of one number on v. These are
cones of second order, |c| <= 1 - b and |c| <= 1 + b. A primal and dual method with an
interior point solves the problem exactly, with the scaling of Nesterov and Todd
(Andersen, Roos and Terlaky 2003).

The cells have nine nodes; in each, the change of volume vanishes on average, and so do
its moments in r and z, which does not lock. The strain rates are deviators at three by
three places of Gauss. Such a load is an upper bound but for the quadrature and the
change of volume within cells. Velocities jump at walls alone: the fans at an edge and
the lines of slip in the soil are as wide as cells, so that the error is of first order.

SI units; z is downwards from the surface, and volumes and areas are those over 2 pi.
"""
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

# places and weights of Gauss between -1 and 1
PLACES = np.sqrt(0.6) * np.array([-1.0, 0.0, 1.0])
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9
# the quadratic functions of the nodes -1, 0 and 1 there, and their slopes
SHAPES = np.stack(
    [PLACES * (PLACES - 1) / 2, 1 - PLACES**2, PLACES * (PLACES + 1) / 2], axis=1
)
SLOPES = np.stack([PLACES - 0.5, -2 * PLACES, PLACES + 0.5], axis=1)

# of the method with an interior point: the largest number of its steps, and the gap
# between both bounds over the load
STEPS = 60
PRECISION = 1e-5


class Rows(NamedTuple):
    """Rows of a matrix that acts on velocities, by elements."""

    dofs: Integers  # [element, column], -1 where the velocity is zero
    values: Array  # [element, row, column]

    def matrix(self, size: int) -> sparse.csr_matrix:
        """Return the matrix, with this many columns."""
        n, rows, columns = self.values.shape
        row = np.broadcast_to(
            np.arange(n * rows).reshape(n, rows, 1), self.values.shape
        )
        column = np.broadcast_to(self.dofs[:, None], self.values.shape)
        free = column >= 0
        entries = self.values[free], (row[free], column[free])
        return sparse.csr_matrix(entries, shape=(n * rows, size))


class Mesh:
    """Rectangles with nine nodes. Nodes are on twice as many lines as cells."""

    def __init__(self, r: Array, z: Array) -> None:
        """r, z: lines of the mesh (m), z downwards from the surface."""
        self.r, self.z = r, z
        n, m = len(r) - 1, len(z) - 1
        self.rows = 2 * m + 1
        i, j = (x.ravel() for x in np.meshgrid(range(n), range(m), indexing="ij"))
        local = np.add.outer(self.rows * np.arange(3), np.arange(3)).ravel()
        self.cells = (2 * i * self.rows + 2 * j)[:, None] + local
        self.corner = np.stack([r[i], z[j]], axis=1)
        self.size = np.stack([np.diff(r)[i], np.diff(z)[j]], axis=1)
        self.place = np.stack(
            [x.ravel() for x in np.meshgrid(middles(r), middles(z), indexing="ij")], 1
        )
        self.dofs = np.zeros((len(self.place), 2), dtype=np.int64)

    def remove(self, cells: NDArray[np.bool_]) -> None:
        """Leave out these cells."""
        self.cells, self.corner, self.size = (
            x[~cells] for x in (self.cells, self.corner, self.size)
        )

    def slit(self, radius: float, depth: float) -> None:
        """Double the nodes on a line from the surface to the depth."""
        first = len(self.place)
        twin = np.arange(first)
        on = np.flatnonzero((self.place[:, 0] == radius) & (self.place[:, 1] < depth))
        twin[on] = first + np.arange(len(on))
        self.place = np.concatenate([self.place, self.place[on]])
        self.dofs = np.concatenate([self.dofs, self.dofs[on]])
        outside = self.corner[:, 0] >= radius
        self.cells[outside] = twin[self.cells[outside]]

    def fix(self, nodes: NDArray[np.bool_], component: int) -> None:
        """Let a component of the velocity of these nodes be zero."""
        self.dofs[nodes, component] = -1

    def number(self, tied: NDArray[np.bool_] | None = None) -> int:
        """Number the free components; that of tied nodes downwards is one. Return how
        many there are."""
        used = np.zeros(len(self.place), dtype=bool)
        used[self.cells] = True
        self.dofs[~used] = -1
        if tied is not None:
            self.fix(tied, 1)
        free = self.dofs >= 0
        count = int(np.count_nonzero(free))
        self.dofs[free] = np.arange(count)
        if tied is not None:
            self.dofs[tied, 1] = count
            count += 1
        return count

    def on_edges(
        self, nodes: NDArray[np.bool_], component: int, strength: "Strength | None"
    ) -> Rows:
        """Return a component of the velocity at the places of Gauss on the edges of
        cells between these nodes, times area over 2 pi and strength (1 if None)."""
        sides = np.array([[0, 1, 2], [6, 7, 8], [0, 3, 6], [2, 5, 8]])
        edges = self.cells[:, sides].reshape(-1, 3)
        edges = np.unique(edges[nodes[edges].all(axis=1)], axis=0)
        ends = self.place[edges[:, 2]] - self.place[edges[:, 0]]
        at = self.place[edges[:, :1]] + ends[:, None] * (1 + PLACES[:, None]) / 2
        weight = at[..., 0] * np.linalg.norm(ends, axis=1)[:, None] / 2 * WEIGHTS
        if strength is not None:
            weight = weight * strength.at(at[..., 1])
        return Rows(self.dofs[edges, component], weight[..., None] * SHAPES)

    def flux(self, nodes: NDArray[np.bool_], component: int, size: int) -> Array:
        """Return a row that acts on the free components of the velocity: the integral
        of a component over the edges of cells between these nodes."""
        rows = self.on_edges(nodes, component, None).matrix(size)
        return np.asarray(rows.sum(axis=0)).ravel()


def graded(start: float, end: float, cells: int, growth: float) -> Array:
    """Return lines whose distance grows from the start to the end by this factor."""
    x = np.linspace(0, 1, cells + 1)
    x = np.expm1(np.log(growth) * x) / (growth - 1)
    return np.append(start + (end - start) * x[:-1], end)


def towards(places: Array, end: float, cells: float, scale: float) -> Array:
    """Return lines from 0 to the end (m) that contain all places [n] (m) and are dense
    around each: there are as many cells over a length of this scale (m) as graded() has
    with a growth of 20."""
    steepness = np.log(20.0) / cells
    found = [np.zeros(1)]
    ends = np.unique([0.0, *places, end])
    for start, stop in zip(ends, ends[1:]):
        z = np.linspace(start, stop, 2001)
        away = np.abs(z[:, None] - places).min(axis=1)
        dense = 1 / (steepness * (scale / 19 + away))
        number = np.append(0.0, np.cumsum((dense[1:] + dense[:-1]) / 2 * np.diff(z)))
        count = max(round(number[-1]), 1)
        lines = np.interp(np.linspace(0, number[-1], count + 1), number, z)
        found.append(np.append(lines[1:-1], stop))
    return np.concatenate(found)


def join(*parts: Array) -> Array:
    """Return sorted lines without those that repeat."""
    lines = np.sort(np.concatenate(parts))
    return lines[np.append(True, np.diff(lines) > 1e-9 * lines[-1])]


def middles(x: Array) -> Array:
    """Return the lines and the middles between them."""
    return np.interp(np.arange(2 * len(x) - 1) / 2, np.arange(len(x)), x)


@dataclass(frozen=True)
class Strength:
    """The undrained strength of clay."""

    surface: float = 1.0  # Pa
    gradient: float = 0.0  # Pa/m
    # (top in m, strength in Pa) of the layers below, from the top down
    layers: tuple[tuple[float, float], ...] = ()

    def at(self, depth: Array) -> Array:
        """Return the strength there (Pa), at a boundary that of the upper layer."""
        found = self.surface + self.gradient * depth
        for top, strength in self.layers:
            found = np.where(depth > top, strength, found)
        return found


class Soil(NamedTuple):
    """What acts on the velocities in the soil. m is half of the hoop strain rate
    without its sign, and q are the two others that make up the radius of Mohr's circle
    in the plane of r and z; all are deviators, times 2 su and the volume over 2 pi."""

    m: sparse.csr_matrix
    m_and_q: sparse.csr_matrix  # three rows for each place
    volume: sparse.csr_matrix  # moments of the change of volume, three for each cell


def soil_of(mesh: Mesh, size: int, strength: Strength) -> Soil:
    """Integrate with three by three places of Gauss in each cell."""
    n = len(mesh.cells)
    x, y = (p.ravel() for p in np.meshgrid(PLACES, PLACES, indexing="ij"))
    shape = np.einsum("ai,bj->abij", SHAPES, SHAPES).reshape(9, 9)
    slope_r = np.einsum("ai,bj->abij", SLOPES, SHAPES).reshape(9, 9)
    slope_z = np.einsum("ai,bj->abij", SHAPES, SLOPES).reshape(9, 9)
    r = mesh.corner[:, :1] + mesh.size[:, :1] * (1 + x) / 2
    z = mesh.corner[:, 1:] + mesh.size[:, 1:] * (1 + y) / 2
    volume = r * (mesh.size[:, 0] * mesh.size[:, 1] / 4)[:, None]
    volume = volume * np.outer(WEIGHTS, WEIGHTS).ravel()
    of_r = slope_r * (2 / mesh.size[:, 0])[:, None, None]
    of_z = slope_z * (2 / mesh.size[:, 1])[:, None, None]
    hoop = shape / r[..., None]
    # columns: nine radial velocities, then nine downwards
    parts = {
        "m": (of_r - 2 * hoop, of_z),
        "shear": (of_z, of_r),
        "difference": (of_r, -of_z),
        "divergence": (of_r + hoop, of_z),
    }
    e = {key: np.concatenate(pair, axis=2) for key, pair in parts.items()}
    weight = (2 * strength.at(z) * volume)[..., None]
    m = e["m"] / 6 * weight
    q = [e[key] / 2 * weight for key in ("difference", "shear")]
    moments = np.stack([np.ones(9), x, y])
    change = np.einsum("ka,na,nac->nkc", moments, volume, e["divergence"])
    dofs = mesh.dofs[mesh.cells].transpose(0, 2, 1).reshape(n, 18)
    both = np.stack([m, *q], axis=2).reshape(n, 27, 18)
    return Soil(*(Rows(dofs, x).matrix(size) for x in (m, both, change)))


class Cones:
    """Cones |x1| <= x0 in as many dimensions as x has columns, one in each row."""

    def __init__(self, s: Array, z: Array) -> None:
        """Take the scaling of Nesterov and Todd: s = W W z."""
        self.sign = np.where(np.arange(s.shape[1]) == 0, 1.0, -1.0)
        norm_s, norm_z = self.norm(s), self.norm(z)
        self.beta = np.sqrt(norm_s / norm_z)[:, None]
        s, z = s / norm_s[:, None], z / norm_z[:, None]
        gamma = np.sqrt((1 + np.sum(s * z, axis=1)) / 2)[:, None]
        self.middle = (s + self.sign * z) / (2 * gamma)
        half = self.middle.copy()
        half[:, 0] += 1
        self.half = half / np.sqrt(2 * half[:, :1])

    def norm(self, x: Array) -> Array:
        """Return the square root of x0^2 - |x1|^2."""
        inner = np.linalg.norm(x[:, 1:], axis=1)
        return np.sqrt(np.maximum((x[:, 0] - inner) * (x[:, 0] + inner), 1e-300))

    def times(self, x: Array) -> Array:
        """Return W x."""
        along = np.sum(self.half * x, axis=1)[:, None]
        return self.beta * (2 * along * self.half - self.sign * x)

    def divided(self, x: Array) -> Array:
        """Return the inverse of W, times x."""
        half = self.sign * self.half
        along = np.sum(half * x, axis=1)[:, None]
        return (2 * along * half - self.sign * x) / self.beta

    def inverse_square(self) -> Array:
        """Return the inverse of W W, a matrix for each row."""
        w = self.sign * self.middle
        outer = 2 * w[:, :, None] * w[:, None] - np.diag(self.sign)
        return outer / self.beta[..., None] ** 2


def times(matrices: Array, vectors: Array) -> Array:
    """Return the product of each matrix with its vector."""
    return np.array(np.einsum("nij,nj->ni", matrices, vectors))


def product(x: Array, y: Array) -> Array:
    """Return the product of Jordan of rows."""
    first = np.sum(x * y, axis=1)[:, None]
    return np.hstack([first, x[:, :1] * y[:, 1:] + y[:, :1] * x[:, 1:]])


def quotient(x: Array, y: Array) -> Array:
    """Return what has the product x with y."""
    inner = np.linalg.norm(y[:, 1:], axis=1)
    norm = (y[:, 0] - inner) * (y[:, 0] + inner)
    first = (y[:, 0] * x[:, 0] - np.sum(y[:, 1:] * x[:, 1:], axis=1)) / norm
    rest = (x[:, 1:] - first[:, None] * y[:, 1:]) / y[:, :1]
    return np.hstack([first[:, None], rest])


def longest(x: Array, step: Array) -> float:
    """Return how many steps lead from x to the first boundary of the cones."""
    inner = np.linalg.norm(x[:, 1:], axis=1)
    norm = np.sqrt((x[:, 0] - inner) * (x[:, 0] + inner))[:, None]
    x, step = x / norm, step / norm
    first = 2 * x[:, :1] * step[:, :1] - np.sum(x * step, axis=1)[:, None]
    rest = step[:, 1:] - (first + step[:, :1]) / (x[:, :1] + 1) * x[:, 1:]
    most = np.max(np.linalg.norm(rest, axis=1) - first[:, 0])
    return 1 / float(most) if most > 0 else np.inf


class Group:
    """The stresses x that work on the rows of a matrix, with e + x and e - x in cones,
    where e is 1, 0, 0: of one component each, or of three."""

    def __init__(self, matrix: sparse.csr_matrix, size: int) -> None:
        """size: components of each stress."""
        self.matrix = matrix
        self.e = np.zeros((matrix.shape[0] // size, size))
        self.e[:, 0] = 1
        self.x = 0 * self.e
        # distances from the bounds e - x and e + x, and the rates at which they give
        self.s = [self.e.copy(), self.e.copy()]
        self.z = [self.e.copy(), self.e.copy()]
        self.ds: list[Array] = []
        self.dz: list[Array] = []

    def begin(self, v: Array) -> None:
        """Scale, and find what is left of the equations."""
        self.cones = [Cones(s, z) for s, z in zip(self.s, self.z)]
        self.scaled = [cones.times(z) for cones, z in zip(self.cones, self.z)]
        self.squares = [cones.inverse_square() for cones in self.cones]
        self.compliance = np.linalg.inv(self.squares[0] + self.squares[1])
        self.left = [self.s[0] + self.x - self.e, self.s[1] - self.x - self.e]
        rate = (self.matrix @ v).reshape(self.x.shape)
        self.left_rate = self.z[0] - self.z[1] - rate

    def stiffness(self) -> sparse.csr_matrix:
        """Return what all stresses add to the matrix of the velocities."""
        n = len(self.x)
        blocks = (self.compliance, np.arange(n), np.arange(n + 1))
        middle = sparse.bsr_matrix(blocks, shape=(self.x.size, self.x.size))
        return self.matrix.T @ (middle @ self.matrix)

    def aim(self, center: float, with_steps: bool) -> Array:
        """Aim at products s z of this size; return the forces on the velocities."""
        self.targets = []
        for k, y in enumerate(self.scaled):
            wanted = center * self.e - product(y, y)
            if with_steps:
                cones = self.cones[k]
                ds, dz = cones.divided(self.ds[k]), cones.times(self.dz[k])
                wanted = wanted - product(ds, dz)
            goal = self.left[k] + self.cones[k].times(quotient(wanted, y))
            self.targets.append(times(self.squares[k], goal))
        self.push = self.targets[1] - self.targets[0] - self.left_rate
        return self.matrix.T @ times(self.compliance, self.push).ravel()

    def follow(self, dv: Array) -> float:
        """Find the steps that belong to those of the velocities; return how many of
        them the cones allow."""
        rate = (self.matrix @ dv).reshape(self.x.shape)
        self.dx = times(self.compliance, rate + self.push)
        forced = [times(square, self.dx) for square in self.squares]
        self.dz = [forced[0] + self.targets[0], self.targets[1] - forced[1]]
        self.ds = [-self.left[0] - self.dx, self.dx - self.left[1]]
        pairs = zip(self.s + self.z, self.ds + self.dz)
        return min(longest(x, step) for x, step in pairs)

    def move(self, length: float) -> None:
        """Take a part of the steps."""
        self.x = self.x + length * self.dx
        self.s = [s + length * step for s, step in zip(self.s, self.ds)]
        self.z = [z + length * step for z, step in zip(self.z, self.dz)]

    def gap(self, length: float = 0.0) -> float:
        """Return the sum of s z, after a part of the steps."""
        if length == 0:
            return sum(float(np.sum(s * z)) for s, z in zip(self.s, self.z))
        steps = zip(self.s, self.z, self.ds, self.dz)
        return sum(
            float(np.sum((s + length * ds) * (z + length * dz)))
            for s, z, ds, dz in steps
        )


class System:
    """A factorized matrix of velocities and of the forces that constrain them."""

    def __init__(
        self, stiffness: sparse.csr_matrix, constraints: sparse.csr_matrix
    ) -> None:
        n, m = constraints.shape[1], constraints.shape[0]
        whole = sparse.bmat([[stiffness, constraints.T], [constraints, None]])
        self.scale = np.append(1 / np.sqrt(stiffness.diagonal()), np.ones(m))
        scaling = sparse.diags(self.scale)
        self.matrix = (scaling @ whole @ scaling).tocsc()
        # a small shift, which refinement removes, makes every order of the unknowns
        # stable without pivots
        shift = sparse.diags(np.append(np.full(n, 1e-10), np.full(m, -1e-10)))
        self.factors = splu(
            (self.matrix + shift).tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )

    def solve(self, right: Array) -> Array:
        """Return the unknowns, refined."""
        right = self.scale * right
        x = self.factors.solve(right)
        for _ in range(3):
            x = x + self.factors.solve(right - self.matrix @ x)
        return np.array(self.scale * x)


def limit_load(
    rows: list[tuple[sparse.csr_matrix, int]], volume: sparse.csr_matrix, load: Array
) -> tuple[float, Array]:
    """Return the least dissipation of velocities v without change of volume and with
    load v = 1, and these velocities, by Mehrotra's predictor and corrector.

    rows: matrices that act on v, and how many of their rows belong to one stress.
    """
    groups = [Group(*pair) for pair in rows]
    constraints = sparse.vstack([volume, sparse.csr_matrix(-load)]).tocsr()
    m, n = constraints.shape
    v, forces = np.zeros(n), np.zeros(m)  # the last force is the load
    goal = np.append(np.zeros(m - 1), -1.0)
    count = 2 * sum(len(group.x) for group in groups)
    for _ in range(STEPS):
        for group in groups:
            group.begin(v)
        stress = sum(group.matrix.T @ group.x.ravel() for group in groups)
        left = np.append(stress + constraints.T @ forces, constraints @ v - goal)
        gap = sum(group.gap() for group in groups)
        if gap < PRECISION * abs(forces[-1]) and np.abs(left[n:]).max() < 1e-6:
            return float(forces[-1]), v
        system = System(sum(group.stiffness() for group in groups), constraints)
        center = 0.0
        for corrected in (False, True):
            push = sum(group.aim(center, corrected) for group in groups)
            change = system.solve(-left - np.append(push, np.zeros(m)))
            length = min(1.0, *(group.follow(change[:n]) for group in groups))
            after = sum(group.gap(length) for group in groups)
            center = (after / gap) ** 3 * gap / count
        length = min(0.98 * length, 1.0)
        v, forces = v + length * change[:n], forces + length * change[n:]
        for group in groups:
            group.move(length)
    raise ValueError(f"no limit load was found in {STEPS} steps")


def extrapolated(loads: list[float]) -> float:
    """Return the limit of three loads on meshes that are twice as fine each, with the
    order of their differences between one and two."""
    first, second = loads[-3] - loads[-2], loads[-2] - loads[-1]
    ratio = min(max(first / second, 2.0), 4.0) if second > 0 else 4.0
    return loads[-1] - second / (ratio - 1)
