# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `import caisson` offers for scripts and notebooks: run() and load(), and the
commands suggest, cpt, error_bar, report and log of scripts/caisson as functions.

A function that has **options takes all options of its command under their names:
water_depth=30 is --water-depth 30, run=True is --run, and a list gives an option
several times. Numbers are in SI units and degrees; "40mm" or "2500kN" have theirs.
Files are relative to the current folder. What is wrong with the input is raised as
caisson.InputError, whose text is that of the command.
"""
import argparse
import importlib
import os
from pathlib import Path
from typing import Any, NoReturn

from caisson import disk, run_error_bar
from caisson import ranks as cores
from caisson.__main__ import COMMANDS
from caisson.command_line import Parser, paths_in
from caisson.disk import InputError
from caisson.verdict.loaded import LoadedRun, load
from caisson.paths import PROGRAM, scene_or_study
from caisson.runner import Entries, Run, RunError, refuse_missing


class Strict(Parser):
    """Raises InputError where the command line would end the process."""

    def exit(self, status: int = 0, message: str | None = None) -> NoReturn:
        """Raise what the command line would print, without its advice on --help."""
        raise InputError((message or self.prog).splitlines()[0])


def options_of(
    command: str, places: list[str | Path], given: dict[str, Any]
) -> argparse.Namespace:
    """Return the options of a command as its command line has them. Raises
    InputError."""
    name = f"caisson.{command.replace('-', '_')}"
    parser = Strict(prog=name, add_help=False, allow_abbrev=False)
    importlib.import_module(COMMANDS[command][0]).add_arguments(parser)
    for place in places:
        if not isinstance(place, (str, os.PathLike)):
            raise InputError(f"{name}: {place!r} is no path of a file or directory")
    words = list(map(str, places))
    for key, value in given.items():
        option = f"--{key.replace('_', '-')}"
        value = value.tolist() if hasattr(value, "tolist") else value
        for x in value if isinstance(value, (list, tuple)) else [value]:
            if x is not None and x is not False:
                words.append(option if x is True else f"{option}={x}")
    return parser.parse_args(words)


def call(command: str, *places: str | Path, **given: Any) -> argparse.Namespace:
    """Call a command with its options, and return these. It prints what it always
    does. Raises InputError, and RunError where a run of it fails."""
    options = options_of(command, list(places), given)
    disk.begin(paths_in(options))
    if importlib.import_module(COMMANDS[command][0]).main(options):
        raise RunError(f"{command}: a run failed; what is printed above says why")
    return options


def suggest_scene(
    file: str | Path,
    *,
    diameter: float | str,
    skirt: float | str,
    wall: float | str,
    **options: Any,
) -> Path:
    """Write a scene for your own caisson; return its file.

    file: the .prm file to write.
    diameter, skirt, wall: outer diameter, length and thickness of the skirt (m).
    options: those of `caisson suggest`, such as
        layer: ["0: phi = 33, E = 20 MPa", ...], a text for each layer from its top (m);
        sand: "dense", or density: 0.85, in the place of layers;
        cpt: the file of a cone test, in the place of layers;
        weight: in water (N): the rest takes suction; water_depth: of the sea (m);
        error: wanted, 20, 10, 5 or 2 %; study: a .toml file to write, too.

    Prints the layers and what the run will cost. Raises InputError where something is
    missing or cannot be meant, and RunError where the program refuses the scene.

        scene = caisson.suggest_scene("own.prm", diameter=10, skirt=8, wall="40mm",
                                      layer=["0: phi = 33, E = 20 MPa"], error=20)
        run = caisson.run(scene)
    """
    call("suggest", file, diameter=diameter, skirt=skirt, wall=wall, **options)
    return Path(file)


def cpt(file: str | Path, out: str | Path, **options: Any) -> Path:
    """Derive layers of soil from a cone test; return the directory of the results.

    file: GEF, AGS 4, BRO-XML, a workbook, or a table with the columns depth_m and
        qc_MPa and, where they were measured, fs_kPa and u2_kPa.
    out: the directory for layers.csv (low, best and high value of each parameter and
        layer) and cpt.png; of a caisson also its scenes, and scene.html, their page
        before any run.
    options: those of `caisson cpt`, such as diameter, skirt, wall (m) and weight (N) of
        a caisson; run=True, which computes low, best and high (scene/report.html);
        soil: "clay", or ["2=clay", ...]; round_trip=True.

    Prints the layers. Raises InputError where the file cannot be read or holds no cone
    test, and RunError where a run fails.

        caisson.cpt("cpt_1.gef", "results/cpt_1")
        layers = pandas.read_csv("results/cpt_1/layers.csv")
    """
    call("cpt", file, out=out, **options)
    return Path(out)


def error_bar(scene: str | Path, budget: str | None = None, **options: Any) -> Path:
    """Compute the error bar of a scene on similar meshes; return its file, which
    write_report() finds beside the scene.

    scene: a .prm file, or the name of a scene that comes with the program.
    budget: time of all runs on one core, such as "30min" or "2h"; default: twice that
        of the scene.
    options: those of `caisson error-bar`: whole, list, again and overwrite (True), and
        output (a .csv file).

    The file has the relative errors of forces, and the errors of suction (Pa) and heave
    (m), at depths (m). Prints the runs and their times. Raises InputError where the
    budget allows no second mesh, and RunError where a run fails.

        caisson.error_bar("own.prm", budget="30min")
        caisson.write_report("results/own")
    """
    found = call("error-bar", scene, budget=budget, **options)
    return Path(found.output or run_error_bar.beside(found.scene))


def write_report(directory: str | Path, rate: float | None = None) -> Path:
    """Write the page on a run, report.html in its directory; return its path.

    directory: the output directory of a run, which may go on.
    rate: of penetration that the pump is made for (m/h); 1 is assumed.

    The verdict of the page is also in verdict.json there. Raises ResultsError where
    there is no run, or a file of it cannot be read.

        page = caisson.write_report("results/own")
        webbrowser.open(page.absolute().as_uri())
    """
    from caisson.report import write

    return write(Path(directory), rate)


def compare_log(directory: str | Path, measured: str | Path) -> list[str]:
    """Compare a run with the log of the vessel; return what the comparison says, a
    sentence each.

    directory: the output directory of the run of the best estimate; those of low and
        high resistance beside it, such as results/own_low, are its band.
    measured: a .csv file with a row for each reading and the columns depth_m and
        suction_kPa (or resistance_kN); others, such as time_s, may be there.

    vessel.html, vessel.png and vessel.csv go to the directory. Raises InputError where
    one of the two cannot be read.

        for sentence in caisson.compare_log("results/own", "measured.csv"):
            print(sentence)
    """
    from caisson.vessel_log import answer_of, write

    found = answer_of(Path(directory), Path(measured))
    write(Path(directory), found)
    return found.said


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
    """Run a scene to its end and return the run, as load() does.

    scene: a .prm file, or the name of a scene that comes with the program.
    set: entries in the place of those of the scene, {"Section/Entry": value}; a value
        is a number, a word, True or False, or a list of them. Units are SI, and angles
        in degrees.
    output_directory: of the results, relative to the current folder; default: the
        entry Output/Directory of the scene. Results that are there already are kept
        in earlier_1, earlier_2, ..., or removed with overwrite.
    ranks: MPI ranks, default: as many as pay on this machine.
    echo: print the lines of the program while it runs.
    program: default: that of CAISSON_MPM_PROGRAM, of the build, or on PATH.

    Raises RunError, with what the program says, where it refuses the scene or the run
    fails, also if one of its checks does. An interrupt (Ctrl-C, or that of a notebook)
    stops the run with a checkpoint.

        run = caisson.run("jack_coarse.prm", {"Time/End penetration": 2},
                          output_directory="results/quick")
        run.outcome["largest_force"]
    """
    refuse_missing(Path(program))
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
