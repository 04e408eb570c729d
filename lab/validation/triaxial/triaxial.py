# SPDX-License-Identifier: LGPL-2.1-or-later
"""Drained triaxial tests, measured and computed: peak strength, its strain, dilatancy.

A test is a run of a single cell, which the soil fills in part: its stress is then the
same everywhere, and in equilibrium with the cell pressure.
"""
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from caisson.results import Table, read_table
from caisson.runs import StudyRun
from caisson.study import Study
from lab.validation import Row

HEIGHT = 0.01  # m, of the sample in lab/validation/triaxial/triaxial.prm
WINDOW = 0.01  # of strain, for the dilatancy
NAMES = {
    "q_peak_kPa": "largest deviator q (kPa)",
    "phi_peak_deg": "friction angle (degrees)",
    "strain_at_peak_percent": "axial strain at the peak (%)",
    "psi_max_deg": "largest dilatancy (degrees)",
}
# of the only test that may miss
STRONG = "test 11 was stronger than its neighbors, see doc/validation.md"


class Asked(NamedTuple):
    """What is asked of a law: rms errors, and whether each test is to be met."""

    of_q: float
    of_angle: float  # degrees
    each: bool


ASKED = {
    "triaxial": Asked(0.06, 1.0, True),
    "triaxial_quick": Asked(0.06, 1.0, True),
    "triaxial_density": Asked(0.08, 1.5, False),
}


class Peak(NamedTuple):
    """What is compared; angles in degrees, strain in percent."""

    q_peak_kPa: float
    phi_peak_deg: float
    strain_at_peak_percent: float
    psi_max_deg: float


def measured_tests(measured: Path) -> Table:
    """Return the columns of the measurements, nan where a cell is empty."""
    lines = measured.read_text(encoding="utf-8").splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    cells = [[float(cell or "nan") for cell in row] for row in rows[1:]]
    return dict(zip(rows[0], np.array(cells).T))


def runs_of(measured: Path) -> list[dict[str, Any]]:
    """Return a run for each test."""
    tests = measured_tests(measured)
    runs = []
    for name, p0, e0 in zip(tests["test"], tests["p0_kPa"], tests["e0"]):
        pressure = 1e3 * p0
        entries = {
            "Soil/Uniform stress": ", ".join([f"{-pressure:g}"] * 3 + ["0"]),
            "Loads/Surrounding pressure": pressure,
            "Soil/Layer 1/Porosity": e0 / (1 + e0),
        }
        runs.append({"name": f"{name:.0f}", "set": entries})
    return runs


def friction_angle(q: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the mobilized friction angle in triaxial compression (degrees)."""
    return np.degrees(np.arcsin(3 * q / (6 * p + q)))


def dilatancy(strain: np.ndarray, volume: np.ndarray) -> float:
    """Return the largest angle of dilatancy (degrees), over windows of strain.

    strain: axial [n], compression positive; volume: over that at the start [n].
    """
    ends = np.arange(strain[0] + WINDOW, strain[-1], WINDOW / 4)
    growth = np.interp(ends, strain, volume) - np.interp(ends - WINDOW, strain, volume)
    rate = float(max(0, np.max(growth / WINDOW)))
    return float(np.degrees(np.arcsin(rate / (2 + rate))))


def curve_of(run: StudyRun) -> Table:
    """Return axial strain, deviator q and mean stress p (Pa), and volume of a run."""
    rows = read_table(run.run.directory / "observations.csv")
    depth = np.interp(
        rows["time_s"],
        run.results.history["time_s"],
        run.results.history["penetration_m"],
    )
    axial, radial = -rows["axial"], -rows["radial"]
    return {
        "strain": depth / HEIGHT,
        "q": axial - radial,
        "p": (axial + 2 * radial) / 3,
        "volume": rows["volume"],
    }


def peak_of(curve: Table) -> Peak:
    """Return what is compared of a curve."""
    q, p, strain = curve["q"], curve["p"], curve["strain"]
    return Peak(
        float(q.max() / 1e3),
        float(friction_angle(q, p).max()),
        float(100 * strain[np.argmax(q)]),
        dilatancy(strain, curve["volume"]),
    )


def compare(study: Study, measured: Path, figure: Figure) -> list[Row]:
    """Draw computed over measured, and return the rows."""
    names, tests = {run.name for run in study.runs}, measured_tests(measured)
    is_run = np.array([f"{number:.0f}" in names for number in tests["test"]])
    tests = {name: values[is_run] for name, values in tests.items()}
    peaks = np.array([peak_of(curve_of(run)) for run in study.runs]).T
    found = dict(zip(Peak._fields, peaks))
    draw(figure, tests, found)
    ratio = found["q_peak_kPa"] / tests["q_peak_kPa"] - 1
    angle = found["phi_peak_deg"] - tests["phi_peak_deg"]
    strain = found["strain_at_peak_percent"] / tests["strain_at_peak_percent"]
    psi = found["psi_max_deg"] / tests["psi_max_deg"]
    dense = tests["psi_max_deg"] > 10
    asked = ASKED[study.id]

    def rms(x: np.ndarray) -> float:
        return float(np.sqrt(np.mean(x**2)))

    def row(quantity: str, value: float, largest: float = np.inf) -> Row:
        return Row(study.id, quantity, value, largest=largest)

    def within(quantity: str, error: np.ndarray, bound: float) -> Row:
        count = int((np.abs(error) <= bound).sum())
        if not asked.each:
            return row(quantity, count)
        known = STRONG if count == len(error) - 1 else ""
        return Row(study.id, quantity, count, least=len(error), known=known)

    return [
        within("peak q: tests within 10 %", ratio, 0.10),
        row("peak q: rms error", rms(ratio), asked.of_q),
        within("friction angle: tests within 1.5 degrees", angle, 1.5),
        row("friction angle: rms error (degrees)", rms(angle), asked.of_angle),
        row("strain at the peak over measured: mean", float(strain.mean())),
        row("dilatancy of dense sand over measured: mean", float(psi[dense].mean())),
    ]


def draw(figure: Figure, tests: Table, found: Table) -> None:
    """Draw a panel for each quantity."""
    figure.set_size_inches(12, 3.4)
    for axes, (key, name) in zip(figure.subplots(1, len(NAMES)), NAMES.items()):
        x, y = tests[key], found[key]
        both = np.concatenate([x[~np.isnan(x)], y])
        ends = np.array([0.9 * both.min(), 1.05 * both.max()])
        axes.plot(ends, ends, color="0.3", lw=1)
        if key == "q_peak_kPa":
            axes.fill_between(ends, 0.9 * ends, 1.1 * ends, color="0.9")
        if key == "phi_peak_deg":
            axes.fill_between(ends, ends - 1.5, ends + 1.5, color="0.9")
        points = axes.scatter(x, y, c=tests["e0"], s=14, cmap="viridis")
        axes.set(title=name, xlabel="measured", xlim=ends, ylim=ends)
        axes.title.set_fontsize(9)
    figure.axes[0].set_ylabel("computed")
    figure.colorbar(points, ax=figure.axes, label="void ratio at the start")
