# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run has left in its directory: the only reader of its files."""
import csv
import functools
import io
import json
import math
import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from caisson import disk, paths, run_shape
from caisson.disk import InputError, is_locked
from caisson.ledges import FLUSH, Ledge, ledges_of
from caisson.shown import Units, units_of

Table = dict[str, np.ndarray]
FILES = ("history.csv", "run.json")  # that every run leaves which has succeeded


class ResultsError(InputError):
    """What is wrong with the files of a run; the text is for the user."""


class Read(dict[str, Any]):
    """What a file has, by name: a name that it lacks raises ResultsError."""

    def __init__(self, path: Path, content: Mapping[str, Any]) -> None:
        """content: by name; path: of the file."""
        super().__init__(content)
        self.path = path

    def __missing__(self, name: str) -> NoReturn:
        arrays = [k for k, values in self.items() if isinstance(values, np.ndarray)]
        others = f"; it has {', '.join(arrays)}" if arrays else ""
        raise ResultsError(f"{self.path} has no {name}{others}")


def read_table(path: Path) -> Table:
    """Return the columns [n_rows] of a .csv file by name, as in
    read_table(Path("results/jack/history.csv"))["time_s"].

    Lines that begin with "#" are left out, and so are rows that are not whole,
    as the last one of a run that was killed. Raises ResultsError where there is
    no file, no column or no row.
    """
    if not path.is_file():
        raise ResultsError(
            f"no {path.name} in {path.parent}: is it the output directory of a run?"
        )
    text = io.StringIO(disk.read_text(path, ResultsError), newline="")
    try:
        lines = list(csv.reader(line for line in text if not line.startswith("#")))
    except csv.Error as error:
        raise ResultsError(f"{path} is no table: {error}") from error
    names = [name.strip() for name in lines[0]] if lines else []
    rows = []
    for line in lines[1:]:
        try:
            row = [float(entry) for entry in line]
        except ValueError:
            continue
        if len(row) == len(names):
            rows.append(row)
    if not rows:
        raise ResultsError(f"{path} has no complete row")
    return Read(path, dict(zip(names, np.array(rows).T)))


@functools.lru_cache(maxsize=None)
def _damage_of(directory: Path, *_: object) -> str:
    """Return what is wrong with results whose files have these sizes and times."""
    run = Results(directory)
    try:
        _ = run.summary, run.history
    except InputError as error:
        return str(error)
    return ""


def damage_of(directory: Path) -> str:
    """Return why the results of a run that has succeeded cannot be read, "" where they
    can: history.csv and run.json are there, and whole."""
    files = [directory / name for name in FILES]
    if missing := [file for file in files if not file.is_file()]:
        return f"there is no {missing[0]}"
    stamps = [(x.st_size, x.st_mtime_ns) for x in map(Path.stat, files)]
    return _damage_of(directory, *stamps)


class Results:
    """The files of one run, each read when it is asked for, and once.

    Columns of a table are arrays [n_rows]; names carry the units. Raises
    ResultsError where a file is missing or cannot be read. It needs neither pandas nor
    VTK; caisson.load() has it as LoadedRun.results.

        results = Results(Path("results/jack"))
        results.history["tip_force_N"]          # [n_rows], N
        results.entry("Rigid body/Kind")        # "caisson"
    """

    def __init__(self, directory: Path) -> None:
        """directory: the output directory of the run."""
        self.directory = Path(directory)
        # of a scene before its run, as verdict/by_hand.py has it: its columns at depths
        # [n] (m)
        self.by_hand: Callable[[np.ndarray], Table] | None = None
        # in soil of low, best and high resistance, once caisson.band has looked
        self.estimates: dict[str, "Results"] = {}
        self.left_out: dict[str, str] = {}  # of these, and why

    @functools.cached_property
    def rest(self) -> float | None:
        """The penetration by weight (m), where a hand method and not a run finds it."""
        return None

    def table(self, name: str, column: str) -> Table:
        """Return a .csv file of the run that must have this column."""
        path = self.directory / name
        found = read_table(path)
        if column not in found:
            raise ResultsError(f"{path} has no column {column}")
        return found

    @functools.cached_property
    def history(self) -> Table:
        """Forces, energies and counts; a row is the mean since the row before. Columns
        of what a scene lacks are absent."""
        found = self.table("history.csv", "time_s")
        path = self.directory / "history.csv"
        for name in ("time_s", "penetration_m"):
            if not np.isfinite(found.get(name, 0.0)).all():
                raise ResultsError(f"{path} has a {name} that is no number")
        steps = 0 if self.is_running else self.summary.get("steps")
        last = found["step"][-1] if "step" in found else math.inf
        if steps and last < steps and self.summary.get("status") == "finished":
            raise ResultsError(
                f"{path} is cut off: its last whole row is of step {last:.0f}, and the"
                f" run finished with step {steps:.0f}; bring the whole file, or run the"
                " scene again"
            )
        return found

    @functools.cached_property
    def observations(self) -> Table:
        """The series that the entry Verification/Observations asks for."""
        return self.table("observations.csv", "time_s")

    @functools.cached_property
    def walls(self) -> Table:
        """Stresses along the walls at the frames: wall.csv; empty where it has none."""
        try:
            return self.table("wall.csv", "depth_m")
        except ResultsError:
            return {}

    @functools.cached_property
    def error_bounds(self) -> Table:
        """Lower and upper bounds of forces; empty where there are none, as in a run
        that ended above the depths of its error bar."""
        path = self.directory / "history_error.csv"
        if not path.is_file() or len(disk.read_text(path, ResultsError).split()) < 2:
            return {}
        return self.table("history_error.csv", "penetration_m")

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """Sizes, times and counts: run.json."""
        path = self.directory / "run.json"
        if not path.is_file():
            raise ResultsError(f"no {path.name} in {self.directory}")
        text = disk.read_text(path, ResultsError)
        try:
            found = json.loads(
                text,
                object_hook=lambda found: Read(path, found),
                parse_int=lambda digits: int(digits) if len(digits) < 19 else math.inf,
            )
        except (ValueError, RecursionError) as error:
            raise ResultsError(f"{path} cannot be read: {error}") from error
        if not isinstance(found, Read):
            raise ResultsError(f"{path} is no list of results")
        for fault in run_shape.faults(found):
            raise ResultsError(f"{path}: {disk.one_line(fault)}")
        is_whole = found.get("status") == "finished" and "written" in found
        for name in (x for x in run_shape.NEEDED if is_whole and x not in found):
            raise ResultsError(f"{path} has no {name}")
        return found

    @property
    def known(self) -> dict[str, Any]:
        """run.json; empty where a run has left none yet."""
        return self.summary if (self.directory / "run.json").is_file() else {}

    @property
    def entries(self) -> dict[str, str]:
        """The entries in effect, set or default; empty where they are not known."""
        return {**self.known.get("defaults", {}), **self.known.get("entries", {})}

    def entry(self, path: str) -> str:
        """Return an entry in effect, set or default; "" where it is not known."""
        return str(self.entries.get(path, ""))

    def assumes(self, name: str) -> bool:
        """Return whether the scene marks an entry of this name as assumed."""
        found: list[str] = self.known.get("assumed", [])
        return name in {path.rpartition("/")[2] for path in found}

    @property
    def scene(self) -> dict[str, Any]:
        """The body and the layers of the soil; empty where they are not known yet."""
        return self.known.get("scene") or {}

    @property
    def ledges(self) -> tuple[Ledge, ...]:
        """The lower faces of rings and steps of a caisson's wall."""
        return ledges_of({**self.scene, FLUSH: self.entry("Rigid body/Flush face")})

    @property
    def weight(self) -> float:
        """The weight of the body in water (N), 0 where it has none."""
        return float(self.scene.get("submerged_weight_N") or 0)

    @property
    def planned(self) -> float | None:
        """The penetration at which the scene ends (m), None where it has none."""
        try:
            return float(self.entry("Time/End penetration"))
        except ValueError:
            return None

    @property
    def is_finished(self) -> bool:
        """Whether it has come to its end, neither stopped nor failed."""
        return bool(self.known.get("status", "finished") == "finished")

    @property
    def shown(self) -> Units:
        """The units in which pages and pictures show forces, stresses and lengths."""
        return units_of(self.history, self.scene)

    @property
    def body(self) -> str:
        """The kind of the body; a caisson where a run has left no run.json yet."""
        return self.entry("Rigid body/Kind") or "caisson"

    @property
    def title(self) -> str:
        """The scene's title or file, and the folder of the results; no folder of a user
        is in it, as pictures and exported files, which have it, are passed on."""
        if not self.known:
            return paths.without_user(self.directory)
        names = [str(self.known.get(key) or "") for key in ("title", "scene_file")]
        names[0] = re.sub(", on a mesh for an error of about .*", "", names[0])
        names[1] = paths.without_user(Path(names[1])) if names[1] else ""
        names.append(f"results in {paths.without_user(self.directory)}")
        return disk.one_line(", ".join(filter(None, names)))

    @property
    def is_running(self) -> bool:
        """Whether the run has not ended yet, or was killed: run.json is missing, or
        is that of a run in progress."""
        if not (self.directory / "run.json").is_file() or is_locked(self.directory):
            return True
        return self.summary.get("status") == "running"

    def frames(self, series: str = "points") -> list[tuple[float, list[Path]]]:
        """Return [(time, [files])] of points.pvd or grid.pvd, in order; files
        that are gone, as of a run that was stopped, are left out."""
        path = self.directory / f"{series}.pvd"
        if not path.is_file():
            return []
        frames: dict[float, list[Path]] = {}
        try:
            for entry in ElementTree.fromstring(
                disk.read_bytes(path, ResultsError)
            ).iter("DataSet"):
                file = path.parent / entry.get("file", "")
                if file.is_file():
                    frames.setdefault(float(entry.get("timestep", 0)), []).append(file)
        except (ElementTree.ParseError, LookupError, ValueError) as error:
            raise ResultsError(f"{path} cannot be read: {error}") from error
        return sorted(frames.items())
