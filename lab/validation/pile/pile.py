# SPDX-License-Identifier: LGPL-2.1-or-later
"""A closed pile jacked into hypoplastic sand, beside runs of another group with another
program: base resistance and shaft friction over depth, for two densities; and what
cells, inertia and the width of the mesh change."""
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from caisson.results import Table, read_table
from caisson.runs import StudyRun
from caisson.study import Study
from lab.validation import Row

DIAMETER = 0.6  # m
VOID_RATIOS = {"low": 0.669, "med": 0.587}
DEPTH = 4.0  # m, at which bases are compared
FACTOR = 0.15  # of the base resistance, either way
SCATTER = 0.01  # about a line from 3.6 to 4.86 m
WINDOW = 0.2  # m
# of medium density: the entries and the time (s) of runs with another method
OTHERS: dict[str, tuple[dict[str, Any], float]] = {
    "R/5": ({"Rigid body/Cells across the wall": 5}, 500),
    "R/8": ({"Rigid body/Cells across the wall": 8}, 2200),
    "mass scaling 25": ({"Time/Mass scaling": 25}, 400),
    "width 30 m": ({"Grid/Outer radius": 30}, 250),
}
SHORT = 4.15  # m, where these end


def sand(void_ratio: float) -> dict[str, Any]:
    """Return the entries of a density."""
    return {"Soil/Layer 1/Void ratio": void_ratio}


def runs_of(_: Path) -> list[dict[str, Any]]:
    """Return a run for each density, and those with another method."""
    runs: list[dict[str, Any]] = [
        {"name": name, "seconds": 420, "set": sand(e)}
        for name, e in VOID_RATIOS.items()
    ]
    for name, (entries, seconds) in OTHERS.items():
        more = {**entries, "Time/End penetration": SHORT}
        runs.append({"name": name, "seconds": seconds, "set": more})
    return runs


def curves_of(history: Table) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return depth (m), base resistance (MPa) and mean shaft friction (kPa), [n]."""
    depth = history["penetration_m"]
    base = history["tip_force_N"] / (np.pi * DIAMETER**2 / 4) / 1e6
    with np.errstate(divide="ignore", invalid="ignore"):
        shaft = history["outer_friction_N"] / (np.pi * DIAMETER * depth) / 1e3
    return depth, base, shaft


def mean_at(run: StudyRun, depth: float) -> tuple[float, float]:
    """Return base resistance (MPa) and shaft friction (kPa) about a depth (m)."""
    at, base, shaft = curves_of(run.results.history)
    near = np.abs(at - depth) <= WINDOW / 2
    return float(base[near].mean()), float(shaft[near].mean())


def scatter_of(run: StudyRun) -> float:
    """Return the standard deviation about a line, relative to the mean."""
    at, base, _ = curves_of(run.results.history)
    rows = (at >= 3.6) & (at <= 4.86)
    line = np.polyval(np.polyfit(at[rows], base[rows], 1), at[rows])
    return float(np.std(base[rows] - line) / base[rows].mean())


def compare(study: Study, measured: Path, figure: Figure) -> list[Row]:
    """Draw, and return the rows: each density, and each other method."""
    table = read_table(measured)
    rows = []
    for name, e in VOID_RATIOS.items():
        run = study.run(name)
        found = table["void_ratio"] == e
        for depth, base, shaft in zip(
            *(table[c][found] for c in ("depth_m", "base_MPa", "shaft_kPa"))
        ):
            own_base, own_shaft = mean_at(run, depth)
            about = f"at {depth:g} m, void ratio {e:g}"
            row = Row(study.id, f"base over theirs {about}", own_base / base)
            if depth == DEPTH:
                row = replace(row, least=1 - FACTOR, largest=1 + FACTOR)
            rows.append(row)
            if np.isfinite(shaft):
                what = f"shaft over theirs {about}"
                rows.append(Row(study.id, what, own_shaft / shaft))
        what = f"scatter of the base, void ratio {e:g}"
        rows.append(Row(study.id, what, scatter_of(run), largest=SCATTER))
        what = f"base at 8.9 m (MPa), void ratio {e:g}, no reference"
        rows.append(Row(study.id, what, mean_at(run, 8.9)[0]))
        residual = float(run.results.history["energy_residual"][-1])
        what = f"energy residual, void ratio {e:g}"
        rows.append(Row(study.id, what, residual))
    own = mean_at(study.run("med"), DEPTH)[0]
    for name in OTHERS:
        what = f"base at {DEPTH:g} m over that of R/3, {name}"
        rows.append(Row(study.id, what, mean_at(study.run(name), DEPTH)[0] / own))
    draw(figure, study, table)
    return rows


def draw(figure: Figure, study: Study, table: Table) -> None:
    """Draw both resistances over depth, beside those of the other group."""
    figure.set_size_inches(8.5, 5)
    panels = figure.subplots(1, 2)
    for i, (name, e) in enumerate(VOID_RATIOS.items()):
        depth, base, shaft = curves_of(study.run(name).results.history)
        found = table["void_ratio"] == e
        for axes, own, column in zip(panels, (base, shaft), ("base_MPa", "shaft_kPa")):
            label = f"void ratio {e:g}"
            axes.plot(own[1:], depth[1:], f"C{i}", lw=1, label=f"{label}, here")
            axes.plot(
                table[column][found],
                table["depth_m"][found],
                f"C{i}o",
                mfc="none",
                label=f"{label}, theirs",
            )
    for axes, what in zip(
        panels, ("base resistance (MPa)", "mean shaft friction (kPa)")
    ):
        axes.set(xlabel=what, ylabel="depth of the base (m)")
        axes.invert_yaxis()
        axes.grid(color="0.9")
    panels[0].legend(fontsize=7)
