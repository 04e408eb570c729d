# SPDX-License-Identifier: LGPL-2.1-or-later
"""Consolidation of a column that settles by a large part of its height.

The reference of consolidation_large.prm: the theory of Gibson, England & Hussey (1967,
Geotechnique 17, 261-273) with the law that the program integrates in uniaxial strain.
Let a be the initial height of a soil layer above the base, w = dz/da its stretch, M the
modulus and q the load. Then

    sigma' = M ln w,   p = q + M ln w,   dw/dt = d/da (k / (gamma_w w) dp/da),

with p = 0 at the top and no flow at the base. The weight of the soil cancels,
because that of a layer does not change while it is compressed. Lengths are in
units of the height H, times in H^2 / c_v with c_v = k M / gamma_w, and stresses
in M.

From the root of the project, with PYTHONPATH=python:. this prints the checks of the
scene:

    python3 -m lab.verification.consolidation
"""
import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_banded

Array = np.ndarray
GAMMA = 2 - np.sqrt(2)  # of TR-BDF2
TOLERANCE = 1e-12
# of the scene: Pa, and H^2 / c_v in s
MODULUS = 2e6 * 0.7 / (1.3 * 0.4)
TIME = 9810 / (1e-4 * MODULUS)
TENTH = 0.1  # the observed parts at the top and at the base
DEGREE = 8  # of the polynomials in sqrt(t)
BEGIN = 1.2  # of the checks, over the time of the ramp


def constant(stretch: Array) -> Array:
    """Return a permeability of 1 at each stretch."""
    return np.ones_like(stretch)


def kozeny_carman(void_ratio: float) -> Callable[[Array], Array]:
    """Return the permeability over the initial one as a function of the stretch, for
    soil with this initial void ratio."""

    def permeability(stretch: Array) -> Array:
        e = (1 + void_ratio) * stretch - 1
        ratio: Array = (e / void_ratio) ** 3 / stretch
        return ratio

    return permeability


@dataclass(frozen=True)
class Column:
    """A column of n_cells layers of the same initial height, from the base up, under
    a load that grows evenly until ramp and is constant then; 0 for one at once."""

    load: float = 0.5  # over M
    ramp: float = 0.05  # over H^2 / c_v
    permeability: Callable[[Array], Array] = constant
    n_cells: int = 200

    def load_at(self, time: float) -> float:
        """Return the load over M."""
        return self.load * (min(time / self.ramp, 1) if self.ramp > 0 else 1)

    def rate(self, w: Array, time: float) -> Array:
        """Return dw/dt [n_cells]."""
        top = np.exp(-self.load_at(time))
        ends = np.append(w, top)
        middle = (ends[1:] + ends[:-1]) / 2
        distance = np.full(self.n_cells, 1 / self.n_cells)
        distance[-1] /= 2
        flow = self.permeability(middle) / middle * np.diff(np.log(ends)) / distance
        return np.diff(flow, prepend=0) * self.n_cells

    def derivative(self, w: Array, time: float) -> Array:
        """Return the derivative of rate(), its three diagonals as solve_banded() has
        them [3, n_cells]. Differences of three sets of cells give it, because a rate
        knows its neighbors only."""
        result = np.zeros((3, self.n_cells))
        step = 1e-7
        for color in range(3):
            change = np.zeros(self.n_cells)
            change[color::3] = step
            slope = self.rate(w + change, time) - self.rate(w - change, time)
            cells = np.arange(color, self.n_cells, 3)
            for diagonal, neighbor in enumerate((cells - 1, cells, cells + 1)):
                inside = (0 <= neighbor) & (neighbor < self.n_cells)
                found = slope[neighbor[inside]] / (2 * step)
                result[diagonal, cells[inside]] = found
        return result

    def implicit(self, known: Array, factor: float, time: float) -> Array:
        """Return the w that solves w - factor * rate(w) = known, by Newton."""
        unit = np.array([[0.0], [1.0], [0.0]])
        w = known.copy()
        matrix = unit - factor * self.derivative(w, time)
        for _ in range(50):
            rest = known + factor * self.rate(w, time) - w
            change = solve_banded((1, 1), matrix, rest)
            w += change
            if np.abs(change).max() < TOLERANCE:
                return w
            if np.abs(change).max() > 1e-3:
                matrix = unit - factor * self.derivative(w, time)
        raise ArithmeticError("Newton's iteration does not converge")

    def step(self, w: Array, time: float, dt: float) -> Array:
        """Return w after a step of TR-BDF2 (Bank et al. 1985), of second order."""
        half = GAMMA * dt / 2
        middle = self.implicit(w + half * self.rate(w, time), half, time + 2 * half)
        known = (middle - (1 - GAMMA) ** 2 * w) / (GAMMA * (2 - GAMMA))
        return self.implicit(known, (1 - GAMMA) / (2 - GAMMA) * dt, time + dt)

    def stretches(self, times: Sequence[float], n_steps: int = 2) -> Array:
        """Return the stretch of all layers at growing times [n_times, n_cells]. From
        one time to the next there are n_steps; the end of the ramp must be one of the
        times, or later than all."""
        w, time, result = np.ones(self.n_cells), 0.0, []
        for end in times:
            dt = (end - time) / n_steps
            for i in range(n_steps):
                w = self.step(w, time + i * dt, dt)
            time = end
            result.append(w)
        return np.array(result)

    def settlement(self, w: Array) -> float:
        """Return the settlement of the top over H."""
        return float(1 - w.mean())

    def pressure(self, w: Array, time: float) -> Array:
        """Return the excess pore pressure of all layers over M [n_cells]."""
        result: Array = self.load_at(time) + np.log(w)
        return result

    def observed(self, w: Array, time: float) -> tuple[float, float]:
        """Return the mean displacement of what was the top tenth, over H, and the mean
        pressure of the lowest one, over M; means over the mass."""
        n = round(TENTH * self.n_cells)
        center = (np.cumsum(w) - w / 2) / self.n_cells
        start = (np.arange(self.n_cells) + 0.5) / self.n_cells
        return (
            float(np.mean((center - start)[-n:])),
            float(np.mean(self.pressure(w, time)[:n])),
        )


def times_to(end: float, ramp: float, n: int = 60) -> list[float]:
    """Return times that lie close to each other after the start and after the end of
    the ramp, which is one of them."""
    x = (np.arange(n) + 1) / n
    return [*(ramp * x**2), *(ramp + (end - ramp) * x**2)]


@functools.lru_cache(maxsize=2)
def observations(column: Column, end: float) -> tuple[Array, Array, Array]:
    """Return times and what observed() gives for them [n_times]."""
    times = times_to(end, column.ramp)
    rows = zip(column.stretches(times), times)
    found = np.array([column.observed(w, time) for w, time in rows])
    return np.array(times), found[:, 0], found[:, 1]


def polynomial(time: Array, value: Array) -> str:
    """Return the polynomial in sqrt(t) with the least squares of the error, as an
    expression of the program. Units: s for t, those of value."""
    x = np.sqrt(time)
    center = round((x[0] + x[-1]) / 2, 2)
    fit = np.polynomial.Chebyshev.fit(  # type: ignore[no-untyped-call]
        x - center, value, DEGREE
    ).convert(kind=np.polynomial.Polynomial)
    text = f"{fit.coef[-1]:.6g}"
    for coefficient in fit.coef[-2::-1]:
        text = f"({text})*(sqrt(t)-{center}){coefficient:+.6g}"
    return text


def checks(column: Column, end: float) -> str:
    """Return the checks of the scene, from a moment after the ramp on."""
    times, top, base = observations(column, end)
    after = times >= BEGIN * column.ramp
    begin = f"{BEGIN * column.ramp * TIME:.4g}"
    return "; ".join(
        f"trace {name} from {begin} : {polynomial(TIME * times[after], value)} : 0.01"
        for name, value in (("top", top[after]), ("base", MODULUS * base[after]))
    )


def main() -> None:
    """Print the checks of the scene, without and with Kozeny-Carman."""
    for permeability, end in ((constant, 0.3), (kozeny_carman(1.5), 1)):
        print(checks(Column(permeability=permeability), end), end="\n\n")


if __name__ == "__main__":
    main()
