# SPDX-License-Identifier: LGPL-2.1-or-later
"""Element tests of the hypoplastic sand by an independent integration.

The rate equation of von Wolffersdorff (1996), written with 3 x 3 tensors and
compression positive, is integrated by Runge-Kutta's fourth order with small
steps; the lateral strain rate of a drained triaxial test solves a quadratic
equation. Nothing is taken from the C++ kernels.

`scripts/lab element-tests table` prints the values for
tests/kernels/hypoplastic_element_tests.cc, `scripts/lab element-tests cycles` those
for tests/kernels/intergranular_cycles.cc, with the intergranular strain of Niemunis &
Herle (1997), and `scripts/lab element-tests plot FILE` draws them with the results
of the kernels in tests/kernels/hypoplastic_element_tests.output.

Units: Pa, degrees; strains are compression positive.
"""
import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from caisson.paths import ROOT
from caisson import disk

KERNELS = ROOT / "tests/kernels/hypoplastic_element_tests.output"
# phi_c, h_s, n, e_d0, e_c0, e_i0, alpha, beta
SANDS = {
    # Herle & Gudehus (1999)
    "Karlsruhe": (30.0, 5.8e9, 0.28, 0.53, 0.84, 1.00, 0.13, 1.05),
    # von Wolffersdorff (1996)
    "Hochstetten": (33.0, 1.0e9, 0.25, 0.55, 0.95, 1.05, 0.25, 1.5),
}


class Test(NamedTuple):
    """An element test."""

    name: str
    sand: str
    kind: str  # triaxial (compression), extension or oedometer
    void_ratio: float  # at the start
    stress: float  # at the start, Pa, the same in all directions
    end: float  # largest axial strain

    def title(self) -> str:
        """Return the name that hypoplastic_element_tests.output gives it."""
        return f"{self.sand} sand, {self.kind}, {self.name}"


TESTS = [
    Test("dense", "Karlsruhe", "triaxial", 0.56, 1e5, 0.60),
    Test("medium", "Karlsruhe", "triaxial", 0.66, 1e5, 0.60),
    Test("loose", "Karlsruhe", "triaxial", 0.88, 1e5, 0.60),
    Test("dense, 1 MPa", "Karlsruhe", "triaxial", 0.56, 1e6, 0.60),
    Test("extension", "Karlsruhe", "extension", 0.56, 1e5, 0.15),
    Test("dense", "Hochstetten", "triaxial", 0.65, 1e5, 0.60),
    Test("dense", "Karlsruhe", "oedometer", 0.56, 1e4, 0.02),
    Test("loose", "Karlsruhe", "oedometer", 0.88, 1e4, 0.06),
]
POINTS = 6  # of each test in the table
# R, m_R, m_T, beta_r, chi of Niemunis & Herle (1997), Hochstetten sand
MEMORY = (1e-4, 5.0, 2.0, 0.5, 6.0)
AMPLITUDES = (1e-5, 1e-4, 1e-3)  # of cycles of strain, from peak to peak


class Sand:
    """The rate equation; compression positive."""

    def __init__(
        self,
        phi_c: float,
        h_s: float,
        n: float,
        e_d0: float,
        e_c0: float,
        e_i0: float,
        alpha: float,
        beta: float,
    ) -> None:
        """phi_c: degrees; h_s: granular hardness; e_*0: limiting void ratios at
        no stress."""
        self.h_s, self.n = h_s, n
        self.e_d0, self.e_c0, self.e_i0 = e_d0, e_c0, e_i0
        self.alpha, self.beta = alpha, beta
        sine = np.sin(np.radians(phi_c))
        self.a = np.sqrt(3.0) * (3.0 - sine) / (2.0 * np.sqrt(2.0) * sine)

    def limits(self, p: float) -> tuple[float, float, float]:
        """Return e_d, e_c, e_i at the mean stress p (Bauer 1996)."""
        factor = np.exp(-((3.0 * p / self.h_s) ** self.n))
        return self.e_d0 * factor, self.e_c0 * factor, self.e_i0 * factor

    def operators(self, stress: np.ndarray, e: float) -> tuple[np.ndarray, np.ndarray]:
        """Return L [3, 3, 3, 3] and N [3, 3] of the rate L : D - N |D|."""
        trace = np.trace(stress)
        e_d, e_c, e_i = self.limits(trace / 3.0)
        hat = stress / trace
        star = hat - np.eye(3) / 3.0
        norm = np.sqrt(np.tensordot(star, star))
        tangent = np.sqrt(3.0) * norm
        cosine = 1.0
        if norm > 1e-12:
            cosine = -np.sqrt(6.0) * np.trace(star @ star @ star) / norm**3
        F = np.sqrt(
            tangent**2 / 8.0
            + (2.0 - tangent**2) / (2.0 + np.sqrt(2.0) * tangent * cosine)
        ) - tangent / (2.0 * np.sqrt(2.0))
        f_d = (max(e - e_d, 0.0) / (e_c - e_d)) ** self.alpha
        f_e = (e_c / e) ** self.beta
        a = self.a
        f_b = (
            self.h_s
            / self.n
            * (self.e_i0 / self.e_c0) ** self.beta
            * (1.0 + e_i)
            / e_i
            * (trace / self.h_s) ** (1.0 - self.n)
            / (
                3.0
                + a**2
                - a
                * np.sqrt(3.0)
                * ((self.e_i0 - self.e_d0) / (self.e_c0 - self.e_d0)) ** self.alpha
            )
        )
        f_s = f_b * f_e / np.tensordot(hat, hat)
        identity = np.einsum("ik,jl->ijkl", np.eye(3), np.eye(3))
        L = f_s * (F**2 * identity + a**2 * np.multiply.outer(hat, hat))
        return L, f_s * f_d * a * F * (hat + star)


def lateral_rate(sand: Sand, stress: np.ndarray, e: float, axial: float) -> float:
    """Return the lateral strain rate that keeps the lateral stress."""
    L, N = sand.operators(stress, e)
    # L_00zz axial + (L_0000 + L_0011) x = N_00 sqrt(axial^2 + 2 x^2)
    b, c = L[0, 0, 2, 2] * axial, L[0, 0, 0, 0] + L[0, 0, 1, 1]
    n = N[0, 0]
    roots = np.roots([c**2 - 2.0 * n**2, 2.0 * b * c, b**2 - n**2 * axial**2])
    valid = [
        x.real for x in roots if abs(x.imag) < 1e-12 and (b + c * x.real) * n > 0.0
    ]
    return min(valid, key=abs)


def rate(sand: Sand, test: str, state: np.ndarray) -> np.ndarray:
    """Return d(state) / d(axial strain); state: lateral, axial stress, e."""
    stress = np.diag([state[0], state[0], state[1]])
    axial = -1.0 if test == "extension" else 1.0
    lateral = 0.0
    if test != "oedometer":
        lateral = lateral_rate(sand, stress, state[2], axial)
    D = np.diag([lateral, lateral, axial])
    L, N = sand.operators(stress, state[2])
    change = np.tensordot(L, D) - N * np.sqrt(np.tensordot(D, D))
    return np.array([change[0, 0], change[2, 2], -(1.0 + state[2]) * np.trace(D)])


def memory_rate(
    sand: Sand, stress: np.ndarray, e: float, h: np.ndarray, D: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the rates of stress and intergranular strain h, both [3, 3], for the
    strain rate D [3, 3]; compression positive."""
    R, m_R, m_T, beta, chi = MEMORY
    L, N = sand.operators(stress, e)
    length = float(np.sqrt(np.tensordot(h, h)))
    rho = min(length / R, 1.0)
    unit = h / length if length > 0 else np.zeros((3, 3))
    along = np.tensordot(unit, D)
    weight = rho**chi
    M = (weight * m_T + (1 - weight) * m_R) * L
    L_unit = np.tensordot(L, unit)
    if along > 0:
        M = M + weight * (1 - m_T) * np.multiply.outer(L_unit, unit)
        M = M - weight * np.multiply.outer(N, unit)
        return np.tensordot(M, D), D - rho**beta * along * unit
    M = M + weight * (m_R - m_T) * np.multiply.outer(L_unit, unit)
    return np.tensordot(M, D), D


def cycles(amplitude: float, n_steps: int = 4000) -> list[float]:
    """Return the axial stress (Pa) [6] at the reversals of three oedometric cycles of
    strain, of Karlsruhe sand with e = 0.6, from 100 and 50 kPa."""
    sand = Sand(*SANDS["Karlsruhe"])
    stress, h, e = np.diag([5e4, 5e4, 1e5]), np.zeros((3, 3)), 0.6
    found = []
    for half in range(6):
        step = np.diag([0, 0, 1.0 if half % 2 == 0 else -1.0]) * amplitude / n_steps
        for _ in range(n_steps):
            # the midpoint rule
            d_stress, d_h = memory_rate(sand, stress, e, h, step)
            middle = e - (1 + e) * np.trace(step) / 2
            d_stress, d_h = memory_rate(
                sand, stress + d_stress / 2, middle, h + d_h / 2, step
            )
            stress, h = stress + d_stress, h + d_h
            e -= (1 + middle) * np.trace(step)
        found.append(float(stress[2, 2]))
    return found


def integrate(case: Test, n_steps: int = 6000) -> np.ndarray:
    """Return rows of axial strain, lateral stress, axial stress, void ratio:
    [n_steps + 1, 4]."""
    sand, test = Sand(*SANDS[case.sand]), case.kind
    state = np.array([case.stress, case.stress, case.void_ratio])
    h = case.end / n_steps
    rows = [[0.0, *state]]
    for i in range(n_steps):
        k1 = rate(sand, test, state)
        k2 = rate(sand, test, state + h / 2.0 * k1)
        k3 = rate(sand, test, state + h / 2.0 * k2)
        k4 = rate(sand, test, state + h * k3)
        state = state + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
        rows.append([(i + 1) * h, *state])
    return np.array(rows)


def table() -> Iterator[str]:
    """Yield the lines of hypoplastic_element_tests.cc."""
    for case in TESTS:
        rows = integrate(case)
        yield f"// {case.title()}"
        for i in range(1, POINTS + 1):
            strain, lateral, axial, ratio = rows[i * (len(rows) - 1) // POINTS]
            yield f"{{{strain:.3f}, {lateral:.6e}, {axial:.6e}, {ratio:.6f}}},"


def kernel_results() -> dict[str, np.ndarray]:
    """Return the rows of the kernels by the title of the test."""
    results: dict[str, list[list[float]]] = {}
    rows: list[list[float]] | None = None
    for line in KERNELS.read_text(encoding="utf-8").splitlines():
        words = line.split()
        if " sand, " in line:
            rows = results[line.strip()] = []
        elif rows is not None and len(words) == 4:
            try:
                rows.append([float(word) for word in words])
            except ValueError:
                rows = None
        else:
            rows = None
    return {name: np.array(rows) for name, rows in results.items() if rows}


def curves(kind: str, rows: np.ndarray) -> list[tuple[int, np.ndarray, np.ndarray]]:
    """Return (number of the panel, x, y) of what is drawn of a test."""
    if kind == "triaxial":
        strain = 100.0 * rows[:, 0]
        return [(0, strain, rows[:, 2] / rows[:, 1]), (1, strain, rows[:, 3])]
    if kind == "oedometer":
        return [(2, rows[:, 2] / 1e3, rows[:, 3])]
    return []


def label(axes: list[Axes]) -> None:
    """Write what the panels show."""
    axes[0].set_ylabel("axial over lateral stress")
    axes[1].set_ylabel("void ratio")
    axes[2].set_ylabel("void ratio")
    for panel in axes[:2]:
        panel.set_xlabel("axial strain (%)")
        panel.set_title("drained triaxial compression")
    axes[2].set_title("oedometer")
    axes[2].set_xlabel("axial stress (kPa)")
    axes[2].set_xscale("log")
    for sand, style in (("Karlsruhe", ":"), ("Hochstetten", "--")):
        sine = np.sin(np.radians(SANDS[sand][0]))
        axes[0].axhline(
            (1.0 + sine) / (1.0 - sine),
            color="grey",
            linestyle=style,
            linewidth=1.0,
            label=f"critical state, {sand}",
        )
    axes[0].legend(fontsize=7)
    axes[2].legend(fontsize=7)


def plot(file: Path) -> None:
    """Draw stress ratio and void ratio over strain, in compression."""
    kernels = kernel_results()
    figure = Figure(figsize=(13, 4.2))
    axes = list(figure.subplots(1, 3))
    for index, case in enumerate(TESTS):
        color = f"C{index % 10}"
        for panel, x, y in curves(case.kind, integrate(case, 1500)):
            axes[panel].plot(x, y, color=color, label=f"{case.name} {case.sand}")
        if case.title() in kernels:
            for panel, x, y in curves(case.kind, kernels[case.title()]):
                axes[panel].plot(x, y, "o", color=color, markersize=4)
    label(axes)
    figure.suptitle(
        "Hypoplastic sand. Lines: reference integration; dots: the kernels", fontsize=10
    )
    figure.set_layout_engine("tight")
    disk.save(figure, file, dpi=110)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab element-tests`."""
    parser.add_argument("what", choices=["table", "cycles", "plot"])
    parser.add_argument("file", nargs="?", type=Path, help="of the picture")


def main(options: argparse.Namespace) -> int:
    """Print the table or draw the picture."""
    if options.what == "table":
        print("\n".join(table()))
    elif options.what == "cycles":
        for amplitude in AMPLITUDES:
            stresses = ", ".join(f"{stress:.6e}" for stress in cycles(amplitude))
            print(f"{{{amplitude:g}, {{{stresses}}}}},")
    else:
        plot(options.file or Path("element_tests.png"))
    return 0
