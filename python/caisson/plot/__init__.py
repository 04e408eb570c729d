# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a run, written into its directory; no display is needed."""
import argparse
from pathlib import Path

from caisson import run_error_bar
from caisson.command_line import for_each
from caisson.results import Results, ResultsError
from caisson.design import assumed, cone_options


SMALL = 9  # pt, of all texts of pictures that are as wide as a page


def draw(directory: Path) -> list[Path]:
    """Write all pictures of a run; return their paths.

    forces.png, with suction also suction.png, for a caisson that goes down also
    design.csv, walls.png and, with suction, wall_pressure.csv, and where there are
    frames stress.png, displacement.png and, where the soil changes its volume,
    void_ratio.png, and with excess pore pressure pore_pressure.png. Raises
    ResultsError.
    """
    from matplotlib import rc_context

    if not directory.is_dir():
        raise ResultsError(f"no directory {directory}")
    adopt_what_is_beside(directory)
    with rc_context({"font.size": SMALL, "axes.titlesize": SMALL}):
        return _drawn(directory, Results(directory))


def adopt_what_is_beside(directory: Path) -> None:
    """Keep the error bar and the cone test beside its scene with a run."""
    run_error_bar.adopt(directory)
    if scene := str(Results(directory).known.get("scene_file") or ""):
        from caisson.design import cone

        cone.adopt_beside(directory, Path(scene))


def _drawn(directory: Path, run: Results) -> list[Path]:
    """Write the pictures of a run; return their paths."""
    from caisson.plot import fields, forces, pore_pressure, suction
    from caisson.verdict import design, limits
    from caisson.plot import walls

    pictures = [forces.draw(directory / "forces.png", run)]
    pictures += suction.draw(directory, run)
    pictures.append(design.write(directory / "design.csv", run))
    load = directory / "wall_pressure.csv"
    pictures.append(limits.write_pressures(load, run))
    pictures.append(walls.draw(directory / "walls.png", run))
    if (directory / "points.pvd").is_file():
        frames = fields.frames_of(run)
        if frames:
            window = fields.window_of(frames[0], frames[-1], run.scene)
            pictures += fields.draw(run, frames, window)
            pictures.append(pore_pressure.draw(run, frames, window))
    else:
        print(f"plot: no points.pvd in {directory}, so forces only")
    return [picture for picture in pictures if picture is not None]


def add_method_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the design methods: a cone test, and what they assume."""
    text = "a cone test for the design methods; kept as cone.csv in the directory"
    parser.add_argument("--cpt", type=Path, metavar="FILE", help=text)
    cone_options.add_arguments(parser)
    assumed.add_arguments(parser)


def keep_methods(options: argparse.Namespace, directory: Path) -> bool:
    """Keep what is given of them with a run; return whether there is anything. Raises
    InputError."""
    is_new = assumed.keep(options, directory) or options.cpt is not None
    how = cone_options.how_of(options)
    if options.cpt is not None:
        from caisson.design import cone

        for remark in cone.adopt(options.cpt, directory, how):
            print(f"{options.cpt}: {remark}")
    else:
        how.refuse()
    return is_new


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson plot`."""
    add_method_arguments(parser)
    text = "the output directory of a run"
    parser.add_argument("directories", nargs="+", type=Path, metavar="DIR", help=text)


def main(options: argparse.Namespace) -> int:
    """Draw the pictures of each run; a run that cannot be drawn is named."""

    def draw_one(directory: Path) -> None:
        keep_methods(options, directory)
        for picture in draw(directory):
            print(f"plot: {picture}")

    return for_each("plot", options.directories, draw_one)
