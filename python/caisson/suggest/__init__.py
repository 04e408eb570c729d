# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes a scene for your own caisson: domain, mesh, points and inertia tolerance for
the error that you want, and what it will cost.

    caisson suggest --diameter 10 --skirt 8 --wall 40mm --error 5 \\
      --layer "0: phi = 33, E = 20 MPa" \\
      --layer "3: phi = 37, E = 40 MPa" own.prm

Numbers without a unit are in SI units, and angles in degrees; others have theirs: 40mm,
"45 MPa", 2500kN, 85%. The entries of a layer have symbols, too: phi, c, E, nu, psi,
gamma (unit weight), su, K0, Dr, OCR, k (permeability), e and n; NGI-ADP has its own,
such as suA. With --weight the caisson sinks by its weight and is then drawn in by
suction; without, it is jacked. In place of layers a cone test may be given,

    caisson suggest --diameter 10 --skirt 8 --wall 40mm --cpt FILE.csv own.prm

or, of sand, no more than its density:

    caisson suggest --diameter 4 --skirt 2.5 --wall 20mm --sand dense own.prm

A cone test also gives own_low.prm and own_high.prm, the same caisson in soil of low and
of high resistance, and so do --low and --high, with what differs from a layer, or
--spread. `caisson run --band own.prm` runs all three:

    caisson suggest --diameter 4 --skirt 2.5 --wall 20mm --weight 100kN \\
      --layer "0: Dr = 60%" --low "0: Dr = 50%" --high "0: Dr = 70%" own.prm

own.html is the page of the scene before any run: what hand methods say of it.
"""
import argparse
import functools
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import inf
from pathlib import Path
from typing import Any

from caisson import density_law, disk, report
from caisson.band import BEST, HIGH, LOW, member_of
from caisson.design import cone as cone_test
from caisson.design import cone_file, cone_options, cone_texts, interpretation
from caisson.design import own_cone
from caisson.template import template
from caisson.paths import INSTALLED
from caisson.runner import command_for, query
from caisson.suggest import clay, cone, low_and_high, sand, sizes, walls
from caisson.suggest.entry import ASSUMPTION, Entry, Layer, SuggestError
from caisson.suggest.soil import layers_of
from caisson.suggest.trial import by_hand, cost_of
from caisson.design.interpretation import Interpretation
from caisson.design.quantity import angle_of_friction, length, number
from caisson.shown import units_for

# of a study: of the friction angle (degrees), or of the relative density
HERE = Path(__file__).parent
CHANGES = (-4, -2, 0, 2, 4)
CHANGES_OF_DENSITY = (-0.2, -0.1, 0, 0.1, 0.2)
FACTORS_OF_STRENGTH = (0.7, 0.85, 1, 1.15, 1.3)  # and of the stiffness of clay
VELOCITY = 0.1  # m/s
RAMP_SHARE = 0.05  # of the way, at most, until the velocity is reached
LEAST_RECORDS = 100


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add = parser.add_argument
    add("file", type=Path, help="the scene to write, a .prm file")
    add_caisson_arguments(parser, required=True)
    text = "a layer of soil; give one option for each, from the surface down"
    add("--layer", action="append", metavar='"TOP: ENTRY = VALUE, ..."', help=text)
    text = "a cone test that gives the layers, in place of --layer"
    add("--cpt", type=Path, metavar="FILE", help=text)
    add("--sand", metavar="WORD", help=f"all of it sand: {', '.join(sand.WORDS)}")
    text = "all of it sand of this relative density, as 0.85 or 85%%"
    add("--density", type=number(""), metavar="D", help=text)
    text = (
        "write a study, too: of angle or density, or with --spread of twenty runs for"
        " P5, P50 and P95"
    )
    add("--study", type=Path, metavar="FILE.toml", help=text)
    add("--overwrite", action="store_true", help="replace files that exist")
    low_and_high.add_arguments(parser)
    interpretation.add_arguments(parser)


def add_caisson_arguments(parser: argparse.ArgumentParser, required: bool) -> None:
    """Add the options of the caisson and of its run."""
    add = parser.add_argument
    for name, what in {
        "diameter": "outer diameter",
        "skirt": "length of the skirt",
        "wall": "thickness of its wall",
    }.items():
        add(f"--{name}", type=length, required=required, metavar="M", help=what)
    text = "of sand, on both sides"
    add("--wall-friction", type=angle_of_friction, metavar="DEGREES", help=text)
    add("--penetration", type=length, metavar="M", help="where the run ends")
    text = "where it begins (default: at 6 %% of the skirt)"
    add("--embedment", type=number("m"), metavar="M", help=text)
    text = "in water; the rest takes suction"
    add("--weight", type=number("N"), metavar="N", help=text)
    text = "bounds the suction by boiling (default: 30, ASSUMED)"
    add("--water-depth", type=number("m"), metavar="M", help=text)
    text = (
        "of sand given by its density: by density and stress (default), or hypoplastic;"
        " a cone test takes the first, which answers it"
    )
    add("--law", choices=sand.LAWS, help=text)
    add("--error", type=percent, choices=sizes.LEVELS, default=5, help="wanted, in %%")


def percent(text: str) -> int:
    """Return a number of percent, which may be named."""
    return int(text.removesuffix("%"))


def check_law_of_cone(options: argparse.Namespace) -> None:
    """Refuse a law whose ground does not answer the cone test. Raises SuggestError."""
    if sand.LAWS.get(options.law) == density_law.HYPOPLASTIC:
        raise SuggestError(
            "--law hypoplastic: its ground answers a cone with 0.4 of the resistance"
            " measured; leave --law out, and take the law by density and stress"
        )


def check(options: argparse.Namespace, estimates: Sequence[str] = ()) -> None:
    """Refuse what cannot be meant. Raises SuggestError."""
    body, end = body_of(options), options.penetration
    soils = options.layer, options.cpt, options.sand, options.density
    if sum(soil is not None for soil in soils) != 1:
        raise SuggestError(
            "give the soil: either --layer, or a cone test by --cpt, or sand by --sand"
            " or --density"
        )
    if options.cpt:
        check_law_of_cone(options)
    if not options.cpt:
        cone_options.how_of(options).refuse()
    for name in ("tops", "correlation", "uncalibrated", "soil", "unit_weight", "nkt"):
        if not options.cpt and getattr(options, name):
            raise SuggestError(f"--{name.replace('_', '-')} is for a cone test, --cpt")
    sizes.check(body_of(options), options.weight)
    begin, most = begin_of(options), end_of(options)
    if begin < 0 or end is None and begin >= most:
        raise SuggestError(f"--embedment must be from 0 to less than {most:g} m")
    if options.weight and begin == 0:
        raise SuggestError(
            "--embedment 0 goes without --weight: suction needs a skirt that is in the"
            " soil; begin at some wall thicknesses"
        )
    if end is not None and not begin < end <= body.skirt * (1 + sizes.ROUNDING):
        raise SuggestError(
            f"--penetration must be between {begin:g} m, where the caisson begins, and"
            f" the length of the skirt, {body.skirt:g} m"
        )
    if (depth := options.water_depth) is not None and not 0 < depth < sizes.DEEPEST:
        raise SuggestError(
            f"--water-depth {depth:g} m must be above 0 and below {sizes.DEEPEST:g} m"
        )
    if options.water_depth and not options.weight:
        raise SuggestError("--water-depth bounds the suction: give --weight, too")
    if options.wall_friction is not None and not 0 <= options.wall_friction < 89:
        raise SuggestError("--wall-friction must be between 0 and 89 degrees")
    check_files(options, estimates)
    if options.study and options.cpt:
        raise SuggestError(
            "--study: low and high of a cone test are scenes, too, which"
            f" `{command_for(options.file, [LOW, HIGH])}` runs; leave it out"
        )


def check_files(options: argparse.Namespace, estimates: Sequence[str]) -> None:
    """Refuse files that cannot be written, or are there. Raises SuggestError."""
    if options.file.suffix != ".prm":
        raise SuggestError(f"the scene {options.file}: its name must end with .prm")
    if options.study and options.study.suffix != ".toml":
        raise SuggestError(f"--study {options.study}: its name must end with .toml")
    files: list[Path] = [f for f in (options.file, options.study) if f]
    files.append(report.beside(options.file))
    files += [cone_test.beside(options.file)] * bool(options.cpt)
    files += [member_of(options.file, estimate) for estimate in (LOW, HIGH)]
    for file in files:
        if not file.parent.is_dir():
            raise SuggestError(f"there is no directory {file.parent}")
        if not file.exists() or options.overwrite:
            continue
        if options.cpt and options.cpt.exists() and file.samefile(options.cpt):
            raise SuggestError(
                f"{file} is the cone test, and a scene {options.file} gets its table in"
                " a file of this name: give the scene another name"
            )
        how = (
            "moves it away" if file in others_of(options, estimates) else "replaces it"
        )
        raise SuggestError(f"{file} exists; --overwrite {how}")


def others_of(options: argparse.Namespace, estimates: Sequence[str]) -> list[Path]:
    """Return the scenes of low and high resistance that are not to be written: of a
    scene before, and none of the new band."""
    return [member_of(options.file, x) for x in (LOW, HIGH) if x not in estimates]


def refuse_quick_clay(layers: Sequence[Layer]) -> None:
    """Refuse clay with the strength of a quick test where water flows: it would flow
    through it as through sand. Raises SuggestError."""
    for i, layer in enumerate(layers, 1):
        if walls.is_quick_clay(layer):
            raise SuggestError(
                f"layer {i}: phi = {walls.angle_of(layer)} beside a cohesion is no"
                " drained strength, and water would flow through it as through sand."
                f" Give undrained clay as su = {layer.value('Cohesion')} Pa"
            )


def with_permeability(layers: Sequence[Layer]) -> list[Layer]:
    """Return the layers with a permeability, which follows the density in sand by
    density. Raises SuggestError where only some layers of sand have one."""
    tight = list(map(walls.is_clay, layers))
    sands = [bool(x.value("Permeability")) for x, t in zip(layers, tight) if not t]
    if any(sands) and not all(sands):
        raise SuggestError(
            "give Permeability (m/s) for all layers of sand, or for none of them"
        )
    assumed = {
        False: Entry("Permeability", "1e-4", " # ASSUMED: sand; scales the flow"),
        True: Entry("Permeability", "1e-9", " # ASSUMED: clay; hardly any flow"),
    }
    name = "Permeability by void ratio"
    follows = Entry(name, "true", " # ASSUMED: a loosened plug conducts more")
    found = []
    for layer, is_tight in zip(layers, tight):
        added = [] if layer.value("Permeability") else [assumed[is_tight]]
        if walls.is_by_density(layer) and not layer.value(name):
            added.append(follows)
        found.append(Layer(layer.top, [*layer.entries, *added]))
    return found


def flow_of(
    options: argparse.Namespace, layers: Sequence[Layer], soil: Sequence[Layer]
) -> dict[str, Any]:
    """Return what the template takes of weight and water. Where all of the soil is
    undrained clay no water flows. soil: the layers with all of their entries."""
    if not options.weight:
        return {"weight": None, "layers": soil}
    clays = list(map(walls.is_clay, layers))
    if not all(clays):
        refuse_quick_clay(reached(options, layers))
        soil = with_permeability(soil)
    return {
        "weight": options.weight,
        "water_depth": options.water_depth,
        "seeps": not all(clays),
        "has_clay": any(clays),
        "layers": soil,
    }


def body_of(options: argparse.Namespace) -> sizes.Body:
    """Return the sizes of the caisson."""
    return sizes.Body(options.diameter, options.skirt, options.wall)


def begin_of(options: argparse.Namespace) -> float:
    """Return where the run begins (m)."""
    given = options.embedment
    return sizes.start_of(options.skirt) if given is None else float(given)


def end_of(options: argparse.Namespace) -> float:
    """Return where the run ends (m): without --penetration where there is room left
    for the soil that rises inside."""
    return float(options.penetration or options.skirt - sizes.start_of(options.skirt))


def law_of(options: argparse.Namespace) -> str:
    """Return the law of sand, a name of sand.LAWS."""
    return options.law or next(iter(sand.LAWS))


def texts_of(options: argparse.Namespace) -> list[str]:
    """Return the layers in words."""
    if options.sand:
        return [f"0: {sand.SAND} = {options.sand}"]
    if options.density is not None:
        return [f"0: {density_law.DENSITY} = {options.density:g}"]
    return list(options.layer)


def reached(options: argparse.Namespace, layers: Sequence[Layer]) -> list[Layer]:
    """Return the layers that the skirt reaches."""
    return [layer for layer in layers if layer.top < end_of(options)]


def study_of(options: argparse.Namespace, layers: Sequence[Layer]) -> str:
    """Return the text of a study with five friction angles or, of sand by its density,
    relative densities of each layer; clay becomes stronger in step. Raises SuggestError
    where a layer has neither."""
    sands = [layer for layer in layers if not clay.is_undrained(layer)]
    by_density = bool(sands) and all(map(walls.is_by_density, sands))
    quantity = "relative density" if by_density else "friction angle"
    changes = CHANGES_OF_DENSITY if by_density else CHANGES
    follows = options.wall_friction is None and len(sands) == len(layers)
    follows = follows and not by_density
    choices = {}
    for change, factor in zip(changes, FACTORS_OF_STRENGTH):
        entries, numbers = dict[str, float | str](), list[float]()
        for i, layer in enumerate(layers, 1):
            if clay.is_undrained(layer):
                for name in ("Cohesion", "Youngs modulus"):
                    stronger = f"{factor:g}*({layer.value(name)})"
                    entries[f"Soil/Layer {i}/{name}"] = stronger
                continue
            change_of = density_after if by_density else angle_after
            name = density_law.DENSITY if by_density else "Friction angle"
            numbers.append(change_of(layer, change))
            entries[f"Soil/Layer {i}/{name}"] = numbers[-1]
        if follows:
            least = min(numbers[: len(reached(options, layers))])
            wall = float(f"{2 / 3 * least:.3g}")
            for side in ("outer", "inner"):
                entries[f"Rigid body/Friction angle of the {side} wall"] = wall
        words = [f"{number:g}" for number in numbers] or [f"{factor:g} su"]
        choices[", ".join(words)] = entries
    return template(HERE / "study.toml.jinja").render(
        scene=os.path.relpath(options.file, options.study.parent),
        follows=follows,
        choices=choices,
        quantity=quantity if sands else "strength",
        has_clay=len(sands) < len(layers),
        layers=len(layers),
    )


def angle_after(layer: Layer, change: float) -> float:
    """Return the friction angle of a layer with a change. Raises SuggestError."""
    try:
        angle = float("" if walls.is_clay(layer) else walls.angle_of(layer)) + change
    except ValueError as error:
        raise SuggestError("--study: a layer has no friction angle") from error
    if not 0 < angle < 60:
        raise SuggestError(f"--study: {angle:g} degrees is no friction angle")
    return angle


def density_after(layer: Layer, change: float) -> float:
    """Return the relative density of a layer with a change, within 0 and 1."""
    share = float(layer.value(density_law.DENSITY)) + change
    return round(min(max(share, 0.0), 1.0), 4)


def weakest_of(options: argparse.Namespace) -> float:
    """Return the least factor of the strength of clay in what is written."""
    if not options.study or options.cpt:
        return 1.0
    spread = getattr(options, "spread", None)
    return low_and_high.weakest(spread) if spread else FACTORS_OF_STRENGTH[0]


def within_mesh(options: argparse.Namespace, layers: Sequence[Layer]) -> int:
    """Return how many of the layers the mesh has; say which it has not."""
    tops, body = [layer.top for layer in layers], body_of(options)
    deepest = sizes.deepest_top(body, begin_of(options), end_of(options))
    found = sum(top < deepest for top in tops)
    if found < len(tops):
        print(f"The soil from {tops[found]:g} m on lies below the mesh: left out")
    return found


def scene_of(
    options: argparse.Namespace, layers: Sequence[Layer], file: Path, of_band: str = ""
) -> str:
    """Return the text of the scene of a file. of_band: which estimate it is, with a
    comma before it."""
    level = sizes.LEVELS[options.error]
    body = body_of(options)
    start, end = begin_of(options), end_of(options)
    mesh = sizes.mesh_of(body, start, end, level, [layer.top for layer in layers])
    how = "by weight and suction" if options.weight else "jacked"
    smallest = body.wall / level.cells
    size = units_for(inf, inf, body.skirt)
    ramp = sizes.to_two_digits(min(0.5, RAMP_SHARE * (end - start) / VELOCITY))
    deep = reached(options, layers)
    soil = walls.with_walls(
        clay.with_states(layers, end, -mesh.bottom, weakest_of(options)),
        options.wall_friction,
        deep,
    )
    return template(HERE / "scene.prm.jinja").render(
        title=f"a caisson of {size.length(body.diameter)} with a wall of"
        f" {body.wall * 1e3:g} mm, {how}{of_band}",
        body=body,
        level=level,
        mesh=mesh,
        smallest_mm=f"{smallest * 1e3:.3g}",
        start=start,
        end=end,
        ramp=ramp,
        record=sizes.to_two_digits(min(0.1, (end - start) / VELOCITY / LEAST_RECORDS)),
        velocity=VELOCITY,
        wall_friction=walls.wall_friction_of(options.wall_friction, deep),
        interfaces=len(deep) > 1,
        is_clay=all(map(walls.is_clay, deep)),
        smooth_tip=all(map(walls.is_clay, deep)) or options.wall_friction == 0,
        tip_friction=own_cone.FRICTION,
        default_row=sizes.DEFAULT_ROW,
        directory=f"{getattr(options, 'results', 'results')}/{file.stem}",
        frames=sizes.frames_of(start, end),
        **flow_of(options, layers, soil),
    )


def best_scene(options: argparse.Namespace, layers: Sequence[Layer]) -> str:
    """Return the text of the scene of the best estimate. Where it lacks a wall friction
    the program says first what it refuses, as a law that it does not know. Raises
    SuggestError."""
    try:
        return scene_of(options, layers, options.file)
    except walls.NoAngle:
        smooth = argparse.Namespace(**{**vars(options), "wall_friction": 0.0})
        cost_of(options.file, scene_of(smooth, layers, options.file))
        raise


@functools.lru_cache
def entries_of_layers() -> dict[str, str]:
    """Return the units of all entries of a layer by their names, "" for none, as the
    program knows them. Raises RunError."""
    said = query(["--set", "Soil/Number of layers=1", "--print-parameters"])
    section = said.partition("subsection Layer 1\n")[2]
    found, remark = {}, ""
    for line in map(str.strip, section.splitlines()):
        if line == "end":
            break
        if line.startswith("set "):
            unit = re.search(r"Units: (.+?)\.( |$)", remark)
            found[line[4:].partition("=")[0].strip()] = unit[1] if unit else ""
            remark = ""
        else:
            remark += line.strip("#")
    return found


def remarks_on(options: argparse.Namespace) -> list[str]:
    """Return what the scene leaves out: a part of the skirt, and the suction."""
    end, skirt, found = end_of(options), options.skirt, list[str]()
    if end < skirt - 1e-9:
        found.append(
            f"The run ends at {end:g} m, and the skirt is {skirt:g} m long:"
            f" --penetration {skirt:g} pushes all of it in, until the lid may press on"
            " the plug"
        )
    if not options.weight:
        found.append(
            "Without --weight the caisson is jacked, without suction. For suction add"
            " --weight and --water-depth"
        )
    return found


def soil_of(
    options: argparse.Namespace, known: Mapping[str, str]
) -> tuple[list[Layer], Interpretation | None]:
    """Return the layers that the mesh has, and the cone test that they are from; say
    what is doubtful. known: the units of entries. Raises SuggestError or InputError."""
    found = None
    if options.cpt:
        deepest = cone.REACH * options.skirt
        found = interpretation.interpret(options.cpt, options, deepest)
        print(cone_texts.text_of_test(found))
        layers = cone.layers_of(found, end_of(options))
        if warning := cone.end_of_test(found, end_of(options)):
            print(warning)
    else:
        layers = layers_of(texts_of(options), known, law_of(options))
        for layer in layers:
            if layer.warning:
                print(f"warning: layer from {layer.top:g} m: {layer.warning}")
        if options.law and not any(map(walls.is_by_density, layers)):
            raise SuggestError("--law is for sand by its density: no layer is")
    n = within_mesh(options, layers)
    return layers[:n], found and replace(found, layers=found.layers[:n])


def write(options: argparse.Namespace, estimates: Sequence[str] = ()) -> str:
    """Write the scene, those of these estimates, and the study if there is to be one;
    say what the scene will cost. Return its page, which has that cost, and so is never
    the same twice; "" where no hand method knows the ground. Raises SuggestError,
    RunError, InputError or OSError."""
    check(options, estimates)
    known = {} if options.cpt else entries_of_layers()
    layers, found = soil_of(options, known)
    if words := walls.words_on_weight(
        body_of(options), begin_of(options), options.weight
    ):
        print(f"warning: {words}")
    scenes = {BEST: best_scene(options, layers)}
    ends = dict[str, list[Layer]]()
    if estimates and found:
        ends = {x: cone.layers_of(found, end_of(options), x) for x in (LOW, HIGH)}
    elif estimates:
        law = law_of(options)
        ends = low_and_high.of_texts(texts_of(options), known, law, options)
    for estimate, soil in ends.items():
        file, words = member_of(options.file, estimate), f", {estimate} estimate"
        scenes[estimate] = scene_of(options, soil[: len(layers)], file, words)
    texts = {member_of(options.file, x): text for x, text in scenes.items()}
    cost = cost_of(options.file, scenes[BEST])  # alone, as it is timed
    if options.study:
        if estimates and options.spread:
            given = texts_of(options)
            deep = reached(options, layers)
            texts[options.study] = low_and_high.study_of(
                options, given, layers, deep, known
            )
        else:
            texts[options.study] = study_of(options, layers)
    if found:
        texts[cone_test.beside(options.file)] = cone_file.text_of(found.ground)
    print(cost)
    test = texts.get(cone_test.beside(options.file), "")
    page = by_hand(options.file, scenes, cost, test)
    with disk.all_or_none(options.overwrite):
        for file, text in texts.items():
            disk.write(file, text)
    assumed = texts[options.file].count(ASSUMPTION)
    print(f"assumed: {assumed} lines of {options.file} are marked ASSUMED: check them")
    for remark in remarks_on(options):
        print(remark)
    return page


def write_all(options: argparse.Namespace) -> tuple[list[str], str]:
    """Write the scene with those of its band; return which estimates these are, and the
    page. Raises SuggestError, RunError, InputError or OSError."""
    low_and_high.check(options)
    estimates = low_and_high.estimates_of(options)
    return estimates, write(options, estimates)


def main(options: argparse.Namespace) -> int:
    """Write the scene, and say what it will cost."""
    estimates, page = write_all(options)
    for scene in others_of(options, estimates):
        disk.remove(scene)
    study = "caisson study" if INSTALLED else "scripts/caisson study"
    files = [options.file, *(member_of(options.file, e) for e in estimates)]
    if page:
        files.append(disk.write(report.beside(options.file), page))
    run = command_for(options.file, estimates)
    print(f"written: {', '.join(map(str, files))}; next: {run}")
    way = command_for(options.file, [], f"--error {options.error}%")
    print(
        f"The mesh is an estimate for {options.error} %. To find the one that has this"
        f" error, with its error bar: {way}"
    )
    if options.study:
        print(f"written: {options.study}; next: {study} {options.study}")
    return 0
