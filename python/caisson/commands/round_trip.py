# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pushes a cone into the ground that was derived from a cone test: what it meets, over
what was measured, says how far the ground of the scene is the ground of the test."""
from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from caisson import disk
from caisson.curves import window_means
from caisson.disk import InputError
from caisson.design import own_cone
from caisson.design.interpretation import Interpretation
from caisson.paths import short
from caisson.results import read_table
from caisson.runner import Run, RunError, Status
from caisson.suggest import HERE as TEMPLATES
from caisson.suggest.cone import layers_of
from caisson.table import write_csv
from caisson.template import template

DIAMETER = 2 * own_cone.DIAMETER  # m, for a quarter of the time
DEEP = 20 * DIAMETER  # m from the surface and from a boundary, where a cone is deep
STEP = 0.5  # m, over which resistances are compared
SCENE, RESULTS, HISTORY = "round_trip.prm", "round_trip", "history.csv"


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
            return "nothing was measured where this cone could be compared"
        mean = np.exp(np.log(self.ratios).mean())
        return (
            f"a cone pushed into this ground meets {mean:.2f} times the measured"
            f" resistance in the mean, and {self.ratios.min():.2f} to"
            f" {self.ratios.max():.2f} times it over each {STEP:g} m that is"
            f" {DEEP:.2g} m, 20 diameters of that cone, away from the surface and from"
            " the boundaries of layers"
        )


@dataclass(frozen=True)
class Cone:
    """A cone that goes down to a depth (m) into the ground of a test; its files are in
    a directory. skirt: the depth (m) above which silt is not known to be drained."""

    found: Interpretation
    directory: Path
    end: float
    skirt: float

    @property
    def depth(self) -> np.ndarray:
        """The middles of the steps that are compared (m) [n]."""
        return np.arange(STEP, self.end - STEP / 2 + 1e-6, STEP)

    def counts(self) -> np.ndarray:
        """Return which of them are away from the surface and from boundaries [n]."""
        edges = [e.layer.top for e in self.found.layers]
        far = np.abs(self.depth[:, np.newaxis] - edges).min(axis=1)
        return np.asarray(far >= DEEP)

    def check(self) -> None:
        """Refuse a cone that could not be compared. Raises InputError."""
        if not self.counts().any():
            raise InputError(
                f"--round-trip: no {STEP:g} m down to {self.end:g} m are {DEEP:.2g} m,"
                " 20 diameters of its cone, away from the surface and from the"
                " boundaries of layers; leave it out, or give fewer layers by --tops"
            )

    def scene(self) -> str:
        """Return the text of its scene."""
        return template(TEMPLATES / "round_trip.prm.jinja").render(
            name=self.found.name,
            diameter=DIAMETER,
            friction=own_cone.FRICTION,
            deep=DEEP,
            end=self.end,
            layers=layers_of(self.found, min(self.skirt, self.end)),
        )

    def write_scene(self) -> Path:
        """Write its scene; return the file."""
        return disk.write(self.directory / SCENE, self.scene())

    @property
    def of_program(self) -> Run:
        """Its run."""
        directory = self.directory.resolve()
        return Run(directory / SCENE, directory=directory / RESULTS)

    def answer(self) -> Answer:
        """Return what it met beside what was measured."""
        history, ground = (
            read_table(self.of_program.directory / HISTORY),
            self.found.ground,
        )
        way, force = history["penetration_m"], history["tip_force_N"]
        computed = window_means(way, force / (pi * DIAMETER**2 / 4), self.depth, STEP)
        # in no lens, which is not in the scene
        in_layers = np.any([e.layer.rows for e in self.found.layers], axis=0)
        resistance = np.where(in_layers, ground.resistance, np.nan)
        measured = window_means(ground.depth, resistance, self.depth, STEP)
        counts = self.counts() & np.isfinite(computed / measured)
        return Answer(self.depth, measured, computed, counts)

    def run(self) -> list[Path]:
        """Push the cone, unless that is done; say what it met, and return the files.
        Raises RunError where the run fails."""
        run = self.of_program
        if not run.is_complete():
            log = short(run.directory / "log")
            print(f"cpt: a cone goes into this ground; {log} says how far", flush=True)
            if run.execute() != Status.SUCCESS:
                raise RunError(f"the cone of {run.scene} did not arrive: see {log}")
        answer = self.answer()
        print(f"cpt: {answer.words()}")
        return self.write(answer)

    def write(self, answer: Answer) -> list[Path]:
        """Write table and picture; return the files."""
        heads = ["depth_m", "measured_qc_MPa", "computed_qc_MPa", "ratio", "counts"]
        columns = answer.depth, answer.measured / 1e6, answer.computed / 1e6
        rows = [
            [f"{z:g}", f"{q:.4g}", f"{c:.4g}", f"{c / q:.3f}", str(int(counts))]
            for z, q, c, counts in zip(*columns, answer.counts)
        ]
        table, picture = (self.directory / f"round_trip.{x}" for x in ("csv", "png"))
        write_csv(table, heads, rows)
        return [table, disk.save(self.draw(*columns), picture)]

    def draw(
        self, depth: np.ndarray, measured: np.ndarray, computed: np.ndarray
    ) -> Figure:
        """Return a picture of resistances (MPa) at depths (m), [n] each."""
        figure = Figure(figsize=(5, 6), layout="tight")
        axes, ground, end = figure.subplots(), self.found.ground, depth[-1] + STEP
        shown = ground.depth <= end
        resistance = ground.resistance[shown] / 1e6
        axes.plot(resistance, ground.depth[shown], color="0.6", lw=0.8)
        axes.plot(measured, depth, "o-", color="0.35", ms=4, label="measured")
        axes.plot(computed, depth, "s-", color="C0", ms=4, label="computed")
        for e in self.found.layers[1:]:
            axes.axhline(e.layer.top, color="0.8", lw=0.8, zorder=0)
        label = "cone resistance $q_c$ (MPa)"
        axes.set(xlabel=label, ylabel="depth (m)", xlim=(0, None))
        axes.set_ylim(end, 0)
        axes.legend()
        axes.grid(color="0.93")
        return figure
