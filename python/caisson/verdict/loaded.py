# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run for those who work with its results in Python: tables with units and frames."""
import functools
from pathlib import Path
from typing import TYPE_CHECKING, Any

from caisson import needed
from caisson.disk import is_locked
from caisson.frame import Frame, choose, frames_of
from caisson.verdict import outcome
from caisson.results import Results, ResultsError, Table
from caisson.units import unit_of

if TYPE_CHECKING:
    import pandas

TOLERANCE = 0.01  # m or s, of the place of a frame


def data_frame(table: Table) -> "pandas.DataFrame":
    """Return a table with the column time_s as a DataFrame, whose index that is.

    attrs["units"] has the unit of each column and of the index, "1" of numbers. Raises
    ModuleNotFoundError where there is no pandas.
    """
    try:
        import pandas
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(needed.sentence(needed.TABLES, "python")) from error
    found = pandas.DataFrame(table).set_index("time_s")
    found.attrs["units"] = {name: unit_of(name) for name in table}
    return found


class LoadedRun:
    """What a run has left in its output directory.

    A file is read when it is asked for, and once; load() again to see what a run that
    goes on has written since. Values are in SI units, which the names of columns and
    fields carry. Raises ResultsError where a file is missing or cannot be read.

    directory: that of the run (a Path).
    status, summary, outcome: how it ended; its sizes and times; its main numbers.
    history, observations: tables over the time.
    frames, frame(): the state of the soil at times.
    """

    def __init__(self, directory: Path) -> None:
        """directory: the output directory of the run."""
        self.directory = directory
        self.results = Results(directory)

    def __repr__(self) -> str:
        """Say which run it is, and how far it is."""
        return f"<run in {self.directory}: {self.status}, {len(self.frames)} frames>"

    @property
    def status(self) -> str:
        """How the run has ended, as run.json has it: "finished", for example.
        "running" until it ends, "unfinished" where it did not come to its end."""
        if is_locked(self.directory):
            return "running"
        if self.results.is_running:
            return "unfinished"
        return str(self.summary.get("status", "finished"))

    @functools.cached_property
    def history(self) -> "pandas.DataFrame":
        """Forces, energies and counts, [n_rows, n_columns], over the time (time_s, s).

        The columns are those of history.csv, such as penetration_m and tip_force_N;
        the manual lists them (doc/how_to/results.md). attrs["units"] has their units.
        Forces are those of the soil on the body, for the whole circumference, positive
        upward, and each is the mean since the row before. Raises ModuleNotFoundError
        where there is no pandas.

            history = run.history
            history.plot(x="penetration_m", y="total_force_N")
        """
        return data_frame(self.results.history)

    @functools.cached_property
    def observations(self) -> "pandas.DataFrame":
        """The series that the entry Verification/Observations asks for, [n_rows,
        n_series], over the time (time_s, s). Needs pandas."""
        return data_frame(self.results.observations)

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """Sizes, times, counts, energies and warnings of the whole run: run.json, as in
        run.summary["material_points"].

        Raises ResultsError where the run has not come to its end.
        """
        if self.results.is_running:
            raise ResultsError(
                f"the run in {self.directory} is {self.status}, so that there is no"
                " run.json: it is written at the end of a run; history and frames are"
                " there before"
            )
        return self.results.summary

    @property
    def outcome(self) -> dict[str, Any]:
        """The largest force, the margins, the largest pull and the numbers at depths,
        by names, in SI units, as in run.outcome["largest_force"]; of a run that goes on
        those so far. The manual lists them (doc/how_to/results.md)."""
        return outcome.results_of(self.results)

    @functools.cached_property
    def frames(self) -> list[Frame]:
        """All frames in their order. Their files are read only when a frame is asked
        for its fields."""
        return frames_of(self.results)

    def frame(
        self,
        *,
        penetration: float | None = None,
        time: float | None = None,
        index: int | None = None,
        tolerance: float = TOLERANCE,
    ) -> Frame:
        """Return one frame. Give exactly one of the first three.

        penetration, time: of the frame (m, s), within the tolerance; of several as near
            the first is taken.
        index: from 0 on, or from the end where it is negative.
        tolerance: of a penetration (m) or time (s).

        Raises ResultsError, which names the nearest frames, where there is none, and
        TypeError where not exactly one is given.

            stress = run.frame(penetration=2.5).cell_data["stress_Pa"]  # [n_cells, 6]
            last = run.frame(index=-1)
        """
        if [penetration, time, index].count(None) != 2:
            raise TypeError("give one of penetration, time and index")
        frames = self.frames
        if not frames:
            raise ResultsError(
                f"the run in {self.directory} has no frames: the entries Output/Frame"
                " interval and Output/Frame penetrations of the scene ask for some"
            )
        if index is not None:
            if not -len(frames) <= index < len(frames):
                raise ResultsError(
                    f"{self.directory} has no frame {index}: it has {len(frames)}, from"
                    f" 0 to {len(frames) - 1}"
                )
            return frames[index]
        if penetration is not None:
            return choose(frames, "penetration", penetration, tolerance)
        assert time is not None
        return choose(frames, "time", time, tolerance)


def load(directory: str | Path) -> LoadedRun:
    """Return a run by its output directory.

    directory: relative to the current folder, such as results/jack. A run that has not
        ended, or was stopped, can be loaded too: its history and frames are those that
        it has written so far.

    Returns a LoadedRun, whose values are in SI units:

        history         a pandas.DataFrame over the time (s): penetration_m,
                        tip_force_N, total_force_N, suction_Pa, ...
        frame(...)      meshes and arrays at a penetration (m) or a time (s)
        outcome         the largest force, margins and numbers at depths, by names
        status, summary "finished", for example; sizes and times, by names

    Raises ResultsError where there is no such directory, no run has written to it, or,
    later, a file is missing or cannot be read.

        run = caisson.load("results/jack")
        run.history["total_force_N"].max()                      # N
        run.frame(penetration=2.5).cell_data["void_ratio"]      # [n_cells]
    """
    path = Path(directory).expanduser().absolute()  # the folder may change later
    if not path.is_dir():
        raise ResultsError(
            f"no directory {path}: give the output directory of a run, such as"
            " results/jack"
        )
    if not (path / "history.csv").is_file():
        raise ResultsError(
            f"no history.csv in {path}: it is not the output directory of a run, or"
            " the run has not begun to compute"
        )
    return LoadedRun(path)
