# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs, results, studies and pictures of caisson_mpm: what its users need.

For scripts and notebooks (doc/how_to/python.md):

    import caisson

    run = caisson.run("jack_coarse.prm", set={"Time/Inertia tolerance": 0.1})
    run = caisson.load("results/jack")  # or one that is there
    run.history                         # a pandas.DataFrame; attrs["units"]
    run.frame(penetration=2.5).mesh     # a mesh for VTK and PyVista

The modules, each above those that it uses:

    paths, table, units     where things are, how tables look, units in names
    scenes, lock            the scenes that come with the program; the lock of a run
    runner                  Run: one call of the program with entries set
    results                 Results: what a run has left in its directory
    curves                  means over windows and other numbers of a curve
    frame, loaded, api      what the names above are: meshes, tables, run() and load()
    plot, report            pictures of a run, and a page on it
    progress                how far a study is
    study                   the format of all studies, and how they are run
    parameters              studies of uncertain or varied entries
    cpt, suggest            layers from a cone test, and scenes for one's own caisson
    completion              what a shell completes
    command_line            a command line with subcommands in groups

scripts/caisson is the command line. Needed besides Python 3.11: numpy,
SciPy, matplotlib, VTK and Jinja2, as Debian packages them; pandas for history.
The folder design has the design methods, error the error bars, report the page on a
run, and export the state for other programs.
The laboratory (lab) and the workshop (tools) import the package; it imports
nothing of them.

Units are SI, angles in degrees, unless a name says otherwise (wall_kN). Arrays
are given with their shapes, as in [n_rows].
"""
import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from caisson.api import run
    from caisson.frame import Frame
    from caisson.loaded import LoadedRun, load
    from caisson.results import ResultsError
    from caisson.runner import RunError

    __version__: str

__all__ = ["Frame", "LoadedRun", "ResultsError", "RunError", "load", "run"]

# the module of each name, which is loaded when the name is used: commands, and an
# import alone, need none of them
MODULES = {
    "run": "caisson.api",
    "Frame": "caisson.frame",
    "LoadedRun": "caisson.loaded",
    "load": "caisson.loaded",
    "ResultsError": "caisson.results",
    "RunError": "caisson.runner",
}


def __getattr__(name: str) -> Any:
    """Load what a name of __all__, or __version__, stands for."""
    if name == "__version__":
        return importlib.import_module("caisson.paths").version()
    if name in MODULES:
        return getattr(importlib.import_module(MODULES[name]), name)
    raise AttributeError(f"module 'caisson' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the names for completion in a notebook."""
    return sorted([*globals(), *__all__, "__version__"])
