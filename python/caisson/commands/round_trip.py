# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pushes a cone into the ground that was derived from a cone test: what it meets, over
what was measured, says how far the ground of the scene is the ground of the test."""
from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from caisson import curves, disk
from caisson.design.interpretation import Interpretation
from caisson.paths import short
from caisson.results import read_table
from caisson.runner import Run, RunError, Status
from caisson.suggest import cone
from caisson.suggest import HERE as TEMPLATES
from caisson.table import write_csv
from caisson.template import template

DIAMETER = 2 * 0.0357  # m, for a quarter of the time of the usual cone
FRICTION = 10.4  # degrees, as of the computed cones (caisson.design.own_cone)
DEEP = 20 * DIAMETER  # m from the surface and from a boundary, where a cone is deep
STEP = 0.5  # m, over which resistances are compared
SCENE, RESULTS = "round_trip.prm", "round_trip"


@dataclass(frozen=True)
class Answer:
    """Resistances (Pa) over each STEP [n], about a depth (m); counts: where the cone is
    deep, and no boundary is near."""

    depth: np.ndarray
    measured: np.ndarray
    computed: np.ndarray
    counts: np.ndarray

    @property
    def ratios(self) -> np.ndarray:
        """Computed over measured resistance where it counts."""
        return (self.computed / self.measured)[self.counts]

    def words(self) -> str:
        """Return what is found, in a sentence."""
        if not self.counts.any():
            return (
                f"no {STEP:g} m are {DEEP:.2g} m, 20 diameters of the cone, away from"
                " the surface and from the boundaries of layers: nothing to compare"
            )
        mean = np.exp(np.log(self.ratios).mean())
        return (
            f"a cone pushed into this ground meets {mean:.2f} times the measured"
            f" resistance in the mean, and {self.ratios.min():.2f} to"
            f" {self.ratios.max():.2f} times it over each {STEP:g} m that is"
            f" {DEEP:.2g} m, 20 diameters of that cone, away from the surface and from"
            " the boundaries of layers"
        )


def scene_of(found: Interpretation, end: float) -> str:
    """Return the text of the scene of a cone down to a depth (m)."""
    return template(TEMPLATES / "round_trip.prm.jinja").render(
        name=found.name,
        diameter=DIAMETER,
        friction=FRICTION,
        deep=DEEP,
        end=end,
        layers=cone.layers_of(found, end),
    )


def answer_of(found: Interpretation, run: Path) -> Answer:
    """Return what the cone of a run met beside what was measured."""
    history = read_table(run / "history.csv")
    way, force = history["penetration_m"], history["tip_force_N"]
    ground, edges = found.ground, [e.layer.top for e in found.layers]
    depth = np.arange(STEP, min(way[-1], ground.depth[-1]) - STEP / 2 + 1e-6, STEP)
    computed = curves.window_means(way, force / (pi * DIAMETER**2 / 4), depth, STEP)
    in_layers = np.any([e.layer.rows for e in found.layers], axis=0)  # and in no lens
    resistance = np.where(in_layers, ground.resistance, np.nan)
    measured = curves.window_means(ground.depth, resistance, depth, STEP)
    far = np.abs(depth[:, np.newaxis] - edges).min(axis=1)
    counts = (far >= DEEP) & np.isfinite(computed / measured)
    return Answer(depth, measured, computed, counts)


def write(answer: Answer, found: Interpretation, directory: Path) -> list[Path]:
    """Write table and picture into a directory; return the files."""
    heads = ["depth_m", "measured_qc_MPa", "computed_qc_MPa", "ratio", "counts"]
    columns = answer.depth, answer.measured / 1e6, answer.computed / 1e6
    rows = [
        [f"{z:g}", f"{q:.4g}", f"{c:.4g}", f"{c / q:.3f}", str(int(counts))]
        for z, q, c, counts in zip(*columns, answer.counts)
    ]
    table, picture = (directory / f"round_trip.{end}" for end in ("csv", "png"))
    write_csv(table, heads, rows)
    figure = Figure(figsize=(5, 6), layout="tight")
    axes = figure.subplots()
    ground, end = found.ground, answer.depth[-1] + STEP
    shown = ground.depth <= end
    axes.plot(ground.resistance[shown] / 1e6, ground.depth[shown], color="0.6", lw=0.8)
    axes.plot(columns[1], answer.depth, "o-", color="0.35", ms=4, label="measured")
    axes.plot(columns[2], answer.depth, "s-", color="C0", ms=4, label="computed")
    for e in found.layers[1:]:
        axes.axhline(e.layer.top, color="0.8", lw=0.8, zorder=0)
    axes.set(xlabel="cone resistance $q_c$ (MPa)", ylabel="depth (m)", xlim=(0, None))
    axes.set_ylim(end, 0)
    axes.legend()
    axes.grid(color="0.93")
    return [table, disk.save(figure, picture)]


def write_scene(found: Interpretation, end: float, directory: Path) -> Path:
    """Write the scene of a cone down to a depth (m); return its file."""
    return disk.write(directory / SCENE, scene_of(found, end))


def run_of(directory: Path) -> Run:
    """Return the run of the cone of a directory."""
    return Run(directory / SCENE, directory=directory / RESULTS)


def known(found: Interpretation, directory: Path) -> Answer | None:
    """Return what a cone met in the ground of a directory; None where none was pushed
    into it."""
    run = run_of(directory)
    if not run.scene.is_file() or not run.is_complete():
        return None
    return answer_of(found, run.directory)


def run(found: Interpretation, directory: Path) -> list[Path]:
    """Push the cone, unless that is done; say what it met, and return the files. Raises
    RunError where the run fails."""
    cone_run = run_of(directory)
    if not cone_run.is_complete():
        log = short(cone_run.directory / "log")
        print(
            f"cpt: a cone goes into this ground; {log} says how far it is", flush=True
        )
        if cone_run.execute() != Status.SUCCESS:
            raise RunError(f"the cone of {cone_run.scene} did not arrive: see {log}")
    answer = answer_of(found, cone_run.directory)
    print(f"cpt: {answer.words()}")
    return write(answer, found, directory)
