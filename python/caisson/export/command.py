# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exports the state of the soil at a frame of a run to other programs, and springs.

The mesh is a regular grid around the wall, or a text file of Gmsh. The stress is
interpolated from the material points; the first step of the other program finds its
equilibrium with the buoyant weight, the water and the forces of the run on the wall.
What is printed, and written into the file, is the balance of the whole.

Springs along the walls and below the tip (tz) are those of the last motion of a run,
such as a pull after the installation.
"""
import argparse
from functools import partial
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from caisson.verdict.loaded import load
from caisson.paths import short
from caisson.results import ResultsError
from caisson import disk
from caisson.design.quantity import length, number
from caisson.export import files, spring_files
from caisson.export.exported import Exported, exported
from caisson.export.gmsh import read_gmsh
from caisson.export.mesh import Mesh, check_spacing, default_window, regular
from caisson.export.places import read_places
from caisson.export.springs import springs_of
from caisson.export.state import State, read_state
from caisson.export.text import about

Writer = Callable[[Path, Exported], None]
# form: end of the file, and what writes it
FORMS: dict[str, tuple[str, Writer]] = {
    "csv": (".csv", files.write_cells),
    "vtu": (".vtu", files.write_vtu),
    "abaqus": ("_abaqus.inp", partial(files.write_deck, program="abaqus")),
    "calculix": ("_calculix.inp", partial(files.write_deck, program="calculix")),
}
SPRINGS = "tz"
WHERE = ("penetration", "time", "mesh", "points", "spacing", "radius", "depth")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson export`."""
    add = parser.add_argument
    add("directory", type=Path, metavar="DIR", help="output directory of a run")
    add("--to", choices=[*FORMS, SPRINGS], required=True, help="form of the file")
    add("--output", type=Path, metavar="FILE", help="default: state... in DIR")
    add("--overwrite", action="store_true", help="replace the file if it is there")
    frame = parser.add_mutually_exclusive_group()
    text = "the frame at this depth (m); default: the last one"
    frame.add_argument("--penetration", type=number("m"), metavar="M", help=text)
    text = "the frame at this time (s)"
    frame.add_argument("--time", type=float, metavar="S", help=text)
    places = parser.add_mutually_exclusive_group()
    text = "text file of Gmsh, 2.2 or 4.1, without the section of the body"
    places.add_argument("--mesh", type=Path, metavar="FILE.msh", help=text)
    text = "table with columns r_m and z_m: values there (csv)"
    places.add_argument("--points", type=Path, metavar="FILE.csv", help=text)
    text = "cell size of the grid (m), default: a fortieth of the diameter"
    add("--spacing", type=length, metavar="M", help=text)
    text = "radius of the grid (m), default: two diameters"
    add("--radius", type=length, metavar="M", help=text)
    text = "depth of the grid (m), default: a diameter below the tip"
    add("--depth", type=length, metavar="M", help=text)
    text = "of springs: submerged weight of the caisson (N), default: 0"
    add("--weight", type=number("N"), metavar="N", help=text)
    text = "of springs: another run, such as of a wished-in-place caisson"
    add("--beside", type=Path, metavar="DIR", help=text)


def mesh_of(state: State, options: argparse.Namespace) -> Mesh:
    """Return the mesh that is asked for. Raises ResultsError."""
    given = {n: x for n in ("radius", "depth", "spacing") if (x := getattr(options, n))}
    if options.mesh is not None:
        if given:
            raise ResultsError("--radius, --depth and --spacing are not for --mesh")
        mesh = read_gmsh(options.mesh, state)
    else:
        window = replace(default_window(state), **given)
        check_spacing(state, window)
        mesh = regular(state, window)
    radius, low = mesh.nodes[:, 0].max(), mesh.nodes[:, 1].min()
    if radius > state.outer_radius + 1e-6 or low < state.bottom - 1e-6:
        raise ResultsError(
            f"the mesh reaches to r = {radius:g} m and z = {low:g} m, the run only to"
            f" {state.outer_radius:g} m and {state.bottom:g} m"
        )
    return mesh


def export_springs(options: argparse.Namespace) -> tuple[Path, list[str]]:
    """Write the springs; return the file, and what to say of them."""
    if unused := [name for name in WHERE if getattr(options, name) is not None]:
        raise ResultsError(f"--{unused[0]} is not for --to {options.to}")
    weight = options.weight or 0.0
    found = springs_of(load(options.directory), weight)
    other = None
    if options.beside is not None:
        other = springs_of(load(options.beside), weight)
        if other.direction != found.direction:
            names = {1: "pushed", -1: "pulled"}
            raise ResultsError(
                f"the caisson is {names[found.direction]} in {short(options.directory)}"
                f" and {names[other.direction]} in {short(options.beside)}: --beside"
                " takes a run with the same direction"
            )
    path = options.output or options.directory / "springs.csv"
    spring_files.write_csv(path, found, other)
    spring_files.draw(path.with_suffix(".png"), found, other)
    return path, spring_files.about_both(found, other)


def export_state(options: argparse.Namespace) -> tuple[Path, list[str]]:
    """Write the state at a frame; return the file, and what to say of it."""
    for name in ("weight", "beside"):
        if getattr(options, name) is not None:
            raise ResultsError(f"--{name} is for --to {SPRINGS}")
    run = load(options.directory)
    where = {name: getattr(options, name) for name in ("penetration", "time")}
    where = {name: value for name, value in where.items() if value is not None}
    state = read_state(run, run.frame(**(where or {"index": -1})))
    end, write = FORMS[options.to]
    path = options.output or options.directory / f"state{end}"
    if options.points is not None:
        if options.to != "csv":
            raise ResultsError(f"--points is for --to csv, not {options.to}")
        at = read_places(options.points, state)
        return path, files.write_points(path, state, at)
    found = exported(state, mesh_of(state, options))
    write(path, found)
    return path, about(found)


def main(options: argparse.Namespace) -> int:
    """Write the file, and print what it is."""
    export = export_springs if options.to == SPRINGS else export_state
    with disk.all_or_none(options.overwrite):
        path, lines = export(options)
    print("\n".join([*lines, f"written to {short(path)}"]))
    return 0
