# SPDX-License-Identifier: LGPL-2.1-or-later
"""The error bar of a run: error_bar.csv, and the bounds that follow from it,
history_error.csv.

The errors come from a study of the scene (`caisson error-bar`), as a file beside it:
mine_error_bar.csv of mine.prm. They hold for the scene of the study only, which the
file names by its fingerprint. The columns of the file are penetration_m and, of each
quantity, how far it may be too high and too low (below, above), and what leads to the
limit of all meshes (shift), 0 where they have none.
"""
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson import curves, disk, table
from caisson.results import Results, ResultsError, Table, read_table

NAME, HISTORY = "error_bar.csv", "history_error.csv"
DEPTH = "penetration_m"
# the bounds of a value, and the parts of the error that lead to them
BOUNDS = {"low": ("below", -1), "high": ("above", 1), "limit": ("shift", 1)}


class Quantity(NamedTuple):
    """A quantity of history.csv that has an error bar: its name and unit there, how the
    columns of the bar begin, and whether its errors are shares of it; tables show it in
    shown_unit, times scale, with some digits."""

    name: str
    unit: str
    bar: str
    is_relative: bool
    shown_unit: str
    scale: float
    digits: int

    def column(self, bound: str = "") -> str:
        """Return its column in history.csv, or that of a bound."""
        return "_".join(filter(None, (self.name, bound, self.unit)))

    def bar_column(self, *parts: str) -> str:
        """Return its column in the file of errors."""
        unit = "" if self.is_relative else self.unit
        return "_".join(filter(None, (self.bar, *parts, unit)))

    def text(self, value: float) -> str:
        """Return a value for a table."""
        return f"{value * self.scale:.{self.digits}f}"


FORCES = tuple(
    Quantity(name, "N", name.split("_")[0], True, "kN", 1e-3, 0)
    for name in ("tip_force", "inner_friction", "outer_friction", "total_force")
)
# The required suction crosses zero, where the weight no longer suffices, so that it and
# what follows from it have absolute errors.
SUCTION = (
    Quantity("required_suction", "Pa", "required_suction", False, "kPa", 1e-3, 2),
    Quantity("exit_gradient_axis", "", "exit_gradient_axis", False, "", 1, 3),
    Quantity("plug_heave", "m", "plug_heave", False, "mm", 1e3, 1),
)
QUANTITIES = {quantity.bar: quantity for quantity in FORCES + SUCTION}
# those of which the bounds are kept with a run
BOUNDED = [q for q in QUANTITIES.values() if not q.name.endswith("friction")]


def beside(scene: Path) -> Path:
    """Return where the error bar of a scene is."""
    return scene.with_name(f"{scene.stem}_error_bar.csv")


def adopt(directory: Path, bar: Path | None = None) -> None:
    """Keep an error bar with a run, and write its bounds: this one, or that beside its
    scene if it is for this run, or the one kept before. Raises ResultsError where the
    given one cannot be used."""
    run = Results(directory)
    if not (run.scene and (directory / "history.csv").is_file()):
        return
    scene = Path(str(run.summary.get("scene_file") or "scene"))
    chosen = [bar] if bar else [beside(scene), directory / NAME]
    known = (path for path in chosen if bar or path.is_file())
    file = next((path for path in known if is_of(run, path)), None)
    if file is None:
        if bar is not None:
            raise ResultsError(
                f"the error bar {bar} was computed for other parameters than those of"
                f" {directory}: compute it with caisson error-bar"
            )
        if is_of_another(run) and (directory / HISTORY).is_file():
            disk.remove(directory / HISTORY)
        return
    text = disk.read_text(file, ResultsError)
    columns = bounds_of(run.history, read_table(file))
    disk.write(directory / NAME, text)
    rows = [[f"{value:.10g}" for value in row] for row in zip(*columns.values())]
    table.write_csv(directory / HISTORY, list(columns), rows)


def is_of(run: Results, bar: Path) -> bool:
    """Return whether an error bar was computed for the parameters of a run. Raises
    ResultsError where it cannot be read."""
    text = disk.read_text(bar, ResultsError)
    found = re.search(r"^# fingerprint: (\S+)", text, re.M)
    return found is not None and found[1] == run.known.get("fingerprint")


def is_of_another(run: Results) -> bool:
    """Return whether a run has the error bar of other parameters, which is not used.
    Raises ResultsError where it cannot be read."""
    bar = run.directory / NAME
    return bar.is_file() and not is_of(run, bar)


def changes(bar: Table, q: Quantity, values: np.ndarray, at: np.ndarray) -> Table:
    """Return the bounds of values [n] of a quantity at depths [n] by an error bar."""
    found: Table = {}
    for bound, (part, sign) in BOUNDS.items():
        if (errors := bar.get(q.bar_column(part))) is not None:
            error = sign * np.interp(at, bar[DEPTH], errors)
            change = error * values if q.is_relative else error
            found[q.column(bound)] = values + change
    return found


def is_inside(bar: Table, depth: np.ndarray) -> np.ndarray:
    """Return which depths [n] an error bar covers."""
    return (depth >= bar[DEPTH][0] - curves.EDGE) & (
        depth <= bar[DEPTH][-1] + curves.EDGE
    )


def bounds_of(history: Table, bar: Table) -> Table:
    """Return the rows of a history within the depths of an error bar: of each of its
    quantities the values and their bounds."""
    rows = is_inside(bar, history[DEPTH])
    depth = history[DEPTH][rows]
    found = {DEPTH: depth}
    for q in BOUNDED:
        if q.bar_column("below") in bar and q.column() in history:
            found[q.column()] = values = history[q.column()][rows]
            found |= changes(bar, q, values, depth)
    return found


def at_depths(run: Results, depth: np.ndarray, means: Table) -> Table:
    """Return the bounds of means [n] of a run at depths [n], nan beyond its error bar;
    empty without one, and with that of other parameters."""
    if not (run.directory / NAME).is_file() or is_of_another(run):
        return {}
    bar = read_table(run.directory / NAME)
    found: Table = {}
    for q in BOUNDED:
        if q.column() in means:
            found |= changes(bar, q, means[q.column()], depth)
    inside = is_inside(bar, depth)
    return {name: np.where(inside, values, np.nan) for name, values in found.items()}
