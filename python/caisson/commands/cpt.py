# SPDX-License-Identifier: LGPL-2.1-or-later
"""Layers of soil and their parameters, low, best and high, from a cone test; of a
caisson also its scenes, and what hand methods say of them.

    caisson cpt FILE
    caisson cpt FILE --diameter 10 --skirt 8 --wall 40mm --run
    caisson cpt FILE --round-trip

The file is GEF, AGS 4, BRO-XML, a workbook (.xlsx) or a table with the columns depth_m
and qc_MPa and, where they were measured, fs_kPa and u2_kPa. Results go to
results/cpt/NAME: layers.csv and cpt.png; of a caisson scene.prm, its page scene.html
before any run, and scene_low.prm and scene_high.prm in soil of low and of high
resistance. --run runs all three, whose page is scene/report.html. With --round-trip a
cone is pushed into the ground of the scene, and round_trip.csv and .png have what it
meets beside what was measured.
"""
import argparse
from math import inf
from pathlib import Path

from caisson import disk, report, suggest
from caisson.band import ESTIMATES, HIGH, LOW, member_of
from caisson.commands import round_trip, run
from caisson.design import cone_picture, cone_texts, interpretation
from caisson.paths import RESULTS, scene_or_study, seen, short
from caisson.study import file_name
from caisson.suggest.cone import REACH
from caisson.disk import InputError
from caisson.terminal import printable
from caisson.design.correlations import EVERY
from caisson.design.interpretation import Interpretation

SIZES = ("diameter", "skirt", "wall")
SCENE = "scene.prm"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson cpt`."""
    add = parser.add_argument
    add("cpt", type=scene_or_study, nargs="?", metavar="FILE", help="the test")
    add("--out", type=Path, metavar="DIR", help="of the results")
    add("--list", action="store_true", help="list the correlations, and do no more")
    add("--overwrite", action="store_true", help="replace files that were changed")
    text = "run the scenes of a caisson, also in soil of low and of high resistance"
    add("--run", action="store_true", help=text)
    text = "push a cone into the ground found, and compare it with the test"
    add("--round-trip", action="store_true", help=text)
    suggest.add_caisson_arguments(parser, required=False)
    interpretation.add_arguments(parser)


def check(options: argparse.Namespace) -> bool:
    """Return whether there is a caisson. Raises InputError."""
    if options.cpt is None:
        raise InputError("give the file of a cone test, or --list")
    suggest.check_law_of_cone(options)
    given = [name for name in SIZES if getattr(options, name) is not None]
    if given and len(given) < len(SIZES):
        missing = [f"--{name}" for name in SIZES if name not in given]
        raise InputError(f"of the caisson, {' and '.join(missing)} are missing")
    if options.run and not given:
        raise InputError("--run needs a caisson: --diameter, --skirt and --wall")
    return bool(given)


def write(
    found: Interpretation, directory: Path, tip: float | None, location: str
) -> list[Path]:
    """Write table and picture into a directory; return the files. tip: the depth to
    which a skirt goes (m); location: of the test, in a file of several."""
    disk.make_directory(directory)
    title = f"Cone test {found.name} {printable(location)}".rstrip()
    return [
        cone_texts.write(directory / "layers.csv", found.layers),
        cone_picture.draw(
            directory / "cpt.png", title, found.ground, found.layers, found.names, tip
        ),
    ]


def write_scenes(options: argparse.Namespace, scene: Path) -> str:
    """Write the scenes of a caisson; return their page."""
    options.file, options.results = scene, seen(scene.parent)
    options.layer = options.sand = options.density = options.study = None
    options.overwrite = True
    return suggest.write(options, [LOW, HIGH])  # which prints the table


def say_written(files: list[Path]) -> None:
    """Say what has been written."""
    for file in files:
        print(f"cpt: {short(file)}")


def main(options: argparse.Namespace) -> int:
    """Write layers, picture and, of a caisson, scene, study and report."""
    if options.list:
        for c in EVERY:
            print(f"{c.name:20}{c.quantity:20}{c.source}; {c.holds}")
        return 0
    has_caisson = check(options)
    deepest = REACH * options.skirt if has_caisson else None
    found = interpretation.interpret(options.cpt, options, deepest)
    name = f"{options.cpt.stem} {options.location}".rstrip()
    directory: Path = options.out or RESULTS / "cpt" / file_name(name)
    if not has_caisson:
        print(cone_texts.text_of_test(found))
    tip = suggest.end_of(options) if has_caisson else None
    cone_end = min(deepest or inf, float(found.ground.depth[-1]))
    cone = round_trip.Cone(found, directory, cone_end, tip or inf)
    if options.round_trip:
        cone.check()
    scene, page = directory / SCENE, ""
    with disk.all_or_none(options.overwrite):
        files = write(found, directory, tip, options.location)
        if options.round_trip:
            files.append(cone.write_scene())
        if has_caisson:
            page = write_scenes(options, scene)
            files += [member_of(scene, estimate) for estimate in ESTIMATES]
    if page:
        files.append(disk.write(report.beside(scene), page))
    say_written(files)
    if options.round_trip:
        say_written(cone.run())
    if not options.run:
        return 0
    return run.run_band([str(scene)])
