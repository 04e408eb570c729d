# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `import caisson` offers: run() and load(); caisson/__init__.py has the names."""
import os
from pathlib import Path
from typing import Any

from caisson import ranks as cores
from caisson.verdict.loaded import LoadedRun, load
from caisson.paths import PROGRAM, scene_or_study
from caisson.runner import Entries, Run, RunError


def run(
    scene: str | Path,
    set: Entries | None = None,
    *,
    output_directory: str | Path | None = None,
    ranks: int | None = None,
    overwrite: bool = False,
    echo: bool = False,
    program: str | Path = PROGRAM,
) -> LoadedRun:
    """Run a scene to its end and return the run.

    scene: a .prm file, or the name of a scene that comes with the program.
    set: entries in the place of those of the scene, {"Section/Entry": value}; a value
        is a number, a word, True or False, or a list of them.
    output_directory: of the results, relative to the current folder; default: the
        entry Output/Directory of the scene. Results that are there already are kept
        in earlier_1, earlier_2, ..., or removed with overwrite.
    ranks: MPI ranks, default: as many as pay on this machine.
    echo: print the lines of the program while it runs.
    program: default: that of CAISSON_MPM_PROGRAM, of the build, or on PATH.

    Raises RunError, with what the program says, where it refuses the scene or the run
    fails, also if one of its checks does. An interrupt (Ctrl-C, or that of a notebook)
    stops the run with a checkpoint.
    """
    if not os.access(program, os.X_OK):
        raise RunError(
            f"no program {program}: `scripts/build` builds it, and the environment"
            " variable CAISSON_MPM_PROGRAM names another one"
        )
    if ranks is not None and ranks < 1:
        raise RunError(f"ranks is {ranks}: a run needs 1 or more")
    if (ranks or 1) > 1 and not cores.can_start_ranks():
        raise RunError("mpirun is missing; the package mpi-default-bin has it")
    call = Run(
        scene_or_study(str(scene)),
        dict[str, Any](set or {}),
        None if output_directory is None else Path(output_directory),
        program=Path(program),
    )
    call.ranks = ranks or cores.choose(call.validate().points)[0]
    call.call(overwrite, echo)
    return load(call.directory)
