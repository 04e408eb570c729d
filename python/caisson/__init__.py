# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs, results, studies and pictures of caisson_mpm: what its users need.

For scripts and notebooks (doc/how_to/python.md):

    import caisson

    scene = caisson.suggest_scene("own.prm", diameter=10, skirt=8, wall="40mm")
    run = caisson.run(scene, set={"Time/Inertia tolerance": 0.1})
    run = caisson.load("results/own")   # or one that is there
    run.history                         # a pandas.DataFrame; attrs["units"]
    run.frame(penetration=2.5).mesh     # a mesh for VTK and PyVista
    caisson.write_report("results/own")  # its page

The functions, with help(caisson.load) and so on:

    suggest_scene, cpt         a scene for your own caisson; soil from a cone test
    run, load                  run a scene; the results of a run that is there
    error_bar                  the numerical error of a scene
    write_report, compare_log  the page on a run; a run beside the log of the vessel

Errors are InputError and, of it, RunError and ResultsError: their text says what is
wrong with the input, the run or its files, and what to do.

Units are SI, angles in degrees, unless a name says otherwise (wall_kN). Arrays are
given with their shapes, as in [n_rows]. Needed besides Python 3.11 are numpy, SciPy,
matplotlib, VTK and Jinja2, as Debian packages them, and pandas for history.

The package is also the command line scripts/caisson: __main__ knows all commands by
name, and loads the one that is called. doc/architecture.md has its folders. The
laboratory (lab) and the workshop (tools) import the package; it imports nothing of
them.
"""
import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from caisson.api import (
        compare_log,
        cpt,
        error_bar,
        run,
        suggest_scene,
        write_report,
    )
    from caisson.disk import InputError
    from caisson.frame import Frame
    from caisson.verdict.loaded import LoadedRun, load
    from caisson.results import ResultsError
    from caisson.runner import RunError

    __version__: str

# the module of each name, which is loaded when the name is used: commands, and an
# import alone, need none of them
MODULES = {
    "compare_log": "caisson.api",
    "cpt": "caisson.api",
    "error_bar": "caisson.api",
    "run": "caisson.api",
    "suggest_scene": "caisson.api",
    "write_report": "caisson.api",
    "InputError": "caisson.disk",
    "Frame": "caisson.frame",
    "LoadedRun": "caisson.verdict.loaded",
    "load": "caisson.verdict.loaded",
    "ResultsError": "caisson.results",
    "RunError": "caisson.runner",
}
__all__ = [
    "Frame",
    "InputError",
    "LoadedRun",
    "ResultsError",
    "RunError",
    "compare_log",
    "cpt",
    "error_bar",
    "load",
    "run",
    "suggest_scene",
    "write_report",
]


def __getattr__(name: str) -> Any:
    """Load what a name of __all__, or __version__, stands for."""
    if name == "__version__":
        return importlib.import_module("caisson.paths").version()
    if name in MODULES:
        return getattr(importlib.import_module(MODULES[name]), name)
    raise AttributeError(f"module 'caisson' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the names for completion in a notebook."""
    return sorted({*globals(), *__all__, "__version__"})
