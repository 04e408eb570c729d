# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs, results, studies and pictures of caisson_mpm: what its users need.

For scripts and notebooks (doc/how_to/python.md):

    import caisson

    run = caisson.run("jack_coarse.prm", set={"Time/Inertia tolerance": 0.1})
    run = caisson.load("results/jack")  # or one that is there
    run.history                         # a pandas.DataFrame; attrs["units"]
    run.frame(penetration=2.5).mesh     # a mesh for VTK and PyVista

The modules of the core, each above those that it uses:

    disk, paths, table      files, where things are, how tables look
    units, shown            units in names and constants; units of results
    scenes, lock            the scenes that come with the program; the lock of a run
    runner                  Run: one call of the program with entries set
    results                 Results: what a run has left in its directory
    curves                  means over windows and other numbers of a curve
    frame                   meshes and tables of a moment of a run
    progress                how far a study is
    study                   the format of all studies, and how they are run
    completion              what a shell completes
    command_line            a command line with subcommands in groups

The folders, each above those that it uses; the core imports none of them, and api, with
run() and load(), is above all:

    design                  design methods, and cone tests as files
    verdict                 what is decided about a run: limits, end, outcome; load()
    plot                    pictures of a run
    error                   error bars of scenes
    parameters              studies of uncertain or varied entries
    export, report          the state for other programs, a page on a run
    suggest                 scenes for one's own caisson
    commands                those that use several folders: run and cpt

scripts/caisson is the command line; __main__ knows all commands by name, and loads the
one that is called. Needed besides Python 3.11: numpy, SciPy, matplotlib, VTK and
Jinja2, as Debian packages them; pandas for history.
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
    from caisson.verdict.loaded import LoadedRun, load
    from caisson.results import ResultsError
    from caisson.runner import RunError

    __version__: str

__all__ = ["Frame", "LoadedRun", "ResultsError", "RunError", "load", "run"]

# the module of each name, which is loaded when the name is used: commands, and an
# import alone, need none of them
MODULES = {
    "run": "caisson.api",
    "Frame": "caisson.frame",
    "LoadedRun": "caisson.verdict.loaded",
    "load": "caisson.verdict.loaded",
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
