# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of the positions of a park, and the scene of each of them.

A column is an option of `caisson suggest` by its name, which may have its unit behind
it: diameter_m, wall (mm), weight_kN, "water depth". Beside them there are the name of
the position, and its soil: the column layers, with what --layer takes, divided by
semicolons, as in low and high, or the column cpt, the file of a cone test.
"""
import argparse
import contextlib
import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple, NoReturn

from caisson import disk, paths, suggest
from caisson.band import ESTIMATES, HIGH, LOW, member_of
from caisson.design import cone_file, cone_grid
from caisson.design.quantity import EVERY, NUMBER
from caisson.disk import InputError
from caisson.study import file_name

NAMES = {"layer": "layers", "cone": "cpt", "cone-test": "cpt", "position": "name"}
BY_LAYER = ("layers", "low", "high")  # columns whose parts are options
NOT_HERE = {"help", "overwrite", "study", "file"}  # options that are no columns
UNIT = "|".join(re.escape(x) for x in sorted(EVERY, key=len, reverse=True))
EXAMPLE = "name,diameter_m,skirt_m,wall_mm,weight_kN,water_depth_m,layers"


class Position(NamedTuple):
    """A row of the table: its number, its name, and the texts of its cells by
    column."""

    row: int
    name: str
    cells: dict[str, str]


class Words(argparse.ArgumentParser):
    """The options of `caisson suggest`; what is wrong with them is an InputError."""

    def error(self, message: str) -> NoReturn:
        """Raise InputError."""
        raise InputError(message.removeprefix("argument "))


def parser() -> Words:
    """Return what reads the options of a position."""
    found = Words(add_help=False, allow_abbrev=False)
    suggest.add_arguments(found)
    return found


def columns() -> list[str]:
    """Return the columns that a table may have."""
    options = [x for a in parser()._actions for x in a.option_strings]
    names = {x.removeprefix("--") for x in options} - NOT_HERE
    return ["name", *sorted(NAMES.get(name, name) for name in names)]


def column_of(head: str) -> tuple[str, str]:
    """Return the column that a head names, and its unit, "" for none."""
    found = re.fullmatch(rf"(.+?)[\s_\[(]+({UNIT})[\])]?", head.strip())
    name, unit = (found[1], found[2]) if found else (head, "")
    name = re.sub(r"[\s_-]+", "-", name.strip().lower())
    return NAMES.get(name, name), unit


def cells_of(path: Path) -> list[tuple[int, list[str]]]:
    """Return the rows of a table of text or a workbook, with their numbers. Raises
    InputError."""
    content = disk.read_bytes(path)
    if content.startswith(cone_file.ARCHIVE):
        return cone_grid.grid_of_workbook(path, "", True)
    lines = cone_file.lines_of(path, content)
    head = next((x for x in lines if x.strip() and not x.startswith("#")), "")
    divider = max(",;\t", key=head.count)
    rows = enumerate(csv.reader(lines, delimiter=divider, skipinitialspace=True), 1)
    return [(n, row) for n, row in rows if any(row) and not row[0].startswith("#")]


@disk.reads
def read(path: Path, error: int) -> list[Position]:
    """Return the positions of a table. error: wanted, in %, where a row has none.
    Raises InputError."""
    rows = cells_of(path)
    if len(rows) < 2:
        raise InputError(f"{path} has no position below its heads, such as {EXAMPLE}")
    heads = [column_of(text) for text in rows[0][1]]
    names, known = [name for name, _ in heads if name], columns()
    for name in names:
        if name not in known or names.count(name) > 1:
            why = "twice" if name in known else "and it is not known"
            raise InputError(
                f"{path}, row {rows[0][0]}: there is a column {name} {why}; the columns"
                f" are {', '.join(known)}"
            )
    if "name" not in names:
        raise InputError(f"{path}: there is no column name; an example is {EXAMPLE}")
    found = []
    for row, texts in rows[1:]:
        cells = {"error": str(error)}
        for (name, unit), text in zip(heads, texts):
            if name and text.strip():
                is_bare = unit and re.fullmatch(NUMBER, text.strip())
                cells[name] = text.strip() + (unit if is_bare else "")
        found.append(Position(row, cells.get("name", ""), cells))
    return found


def words_of(position: Position, folder: Path, scene: Path) -> list[str]:
    """Return the words of `caisson suggest` of a position. folder: of its table."""
    words = [str(scene)]
    for name, text in position.cells.items():
        if name in BY_LAYER:
            option = "layer" if name == "layers" else name
            words += [f"--{option}={part}" for part in text.split(";") if part.strip()]
        elif name == "cpt":
            words.append(f"--cpt={folder / text}")
        elif name != "name":
            words.append(f"--{name}={text}")
    return words


def complaint(path: Path, position: Position, said: str) -> str:
    """Return in a line what is wrong with a row: its number and column, and what to
    do."""
    text = disk.one_line(said)
    text = text.replace("the following arguments are required: ", "fill in ")
    found = next(iter(re.findall(r"--([a-z-]+)", text)), "")
    if not found and "cpt" in position.cells:
        found = "cpt"
    if text.lower().startswith("layer"):
        found = "layer"
    column = NAMES.get(found, found)
    text = re.sub(rf"^--{found}:? ", "", text).replace("--", "")
    where = f", column {column}" if column else ""
    return f"{path}, row {position.row}{where}: {text}"


def wrong_names(path: Path, positions: Sequence[Position]) -> list[str]:
    """Return what is wrong with the names."""
    found, seen = list[str](), dict[str, int]()
    for position in positions:
        where = f"{path}, row {position.row}, column name"
        try:
            place = file_name(position.name).casefold()
        except InputError as error:
            found.append(f"{where}: {error}")
            continue
        if not place:
            found.append(f"{where}: it is empty; give the position a name")
        elif place in seen:
            found.append(
                f"{where}: {position.name!r} has the results of row {seen[place]}, too;"
                " give it another name"
            )
        seen.setdefault(place, position.row)
    for place, row in seen.items():
        for estimate in (LOW, HIGH):
            if (other := seen.get(f"{place}_{estimate}")) is not None:
                found.append(
                    f"{path}, row {other}, column name: it is that of the {estimate}"
                    f" estimate of row {row}; give it another name"
                )
    return found


def suggested(path: Path, position: Position, scene: Path) -> str:
    """Write the scene of a position; return what `caisson suggest` says. Raises
    InputError."""
    said = io.StringIO()
    words = words_of(position, path.parent, scene)
    with contextlib.redirect_stdout(said):
        options = parser().parse_args(words)
        options.overwrite = True
        suggest.write_all(options)
    return said.getvalue()


def write_scenes(path: Path, positions: Sequence[Position], folder: Path) -> None:
    """Write the scenes of positions into a folder, or none of them. Raises InputError
    with a line for each row that is wrong."""
    wrong, said = list[str](), dict[Path, str]()
    folder.mkdir(parents=True, exist_ok=True)
    with disk.all_or_none():
        for position in positions:
            scene = folder / f"{file_name(position.name)}.prm"
            try:
                said[scene] = suggested(path, position, scene)
            except (InputError, OSError, ValueError) as error:
                wrong.append(complaint(path, position, str(error)))
        if wrong:
            raise InputError("\n".join(wrong))
        for estimate in (LOW, HIGH):  # of another band than that of now
            for scene in said:
                disk.remove(member_of(scene, estimate))
    names = {f"{file_name(p.name)}.prm": p.name for p in positions}
    for scene, text in said.items():
        disk.write(scene.with_suffix(".txt"), text)
        for found in filter(Path.is_file, (member_of(scene, e) for e in ESTIMATES)):
            lines, title = disk.read_text(found), "set Title = "
            own = f"{title}{disk.one_line(names[scene.name])}, "
            disk.write(found, lines.replace(title, own, 1))


def record_of(path: Path, position: Position) -> dict[str, str]:
    """Return what the scene of a position rests on: its cells, the cone test that they
    name, and the version of the program."""
    found = {**position.cells, "version": paths.version()}
    if "cpt" in position.cells:
        test = path.parent / position.cells["cpt"]
        found["cpt_stamp"] = str(test.stat().st_mtime_ns) if test.is_file() else ""
    return found
