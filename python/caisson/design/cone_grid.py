# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cone tests as tables: of text, or a sheet of a workbook (.xlsx).

The row of heads is the first that names a depth and a cone resistance, as depth_m,
"qc (MPa)" or "Tiefe in m"; units may stand in the row below. Lines above it may say the
area ratio of the cone, the depth of a hole and that of the water. Cells are divided by
semicolons, tabs, commas or blanks, whichever gives the most rows of numbers. Rows that
are empty or begin with "#" are left out, but count.
"""
import csv
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from caisson.disk import InputError
from caisson.terminal import printable
from caisson.design.cone_options import EXAMPLE
from caisson.design.cone_table import Facts, Head, Rows, Table, cell_of
from caisson.design.cone_table import is_number, naming, refuse
from caisson.design.cone_words import EVERY_UNIT, QUANTITIES
from caisson.design.cone_words import fact_of, head_of, is_level, unit_in

DIVIDERS = (";", "\t", ",", None)  # None: blanks
SAMPLE = 400  # lines that tell what divides cells
# of a sheet; a day of readings each second has 86,400 rows
MOST_ROWS, MOST_COLUMNS, MOST_CELLS = 200_000, 256, 1_000_000
MOST_BYTES = 100e6  # of a workbook, unpacked


def divided(line: str, divider: str | None) -> list[str]:
    """Return the cells of a line."""
    if divider is None:
        return line.split()
    return next(csv.reader([line], delimiter=divider, skipinitialspace=True), [])


def joined(lines: Sequence[str]) -> list[tuple[int, str]]:
    """Return the lines with their numbers; one with a quotation mark that is open, as
    in a head of two lines, with those that follow to where it is closed."""
    found, begin = list[tuple[int, str]](), 0
    while begin < len(lines):
        some = (lines[begin : begin + n] for n in (1, 2, 3))
        block = next(
            (b for b in some if "".join(b).count('"') % 2 == 0), [lines[begin]]
        )
        found.append((begin + 1, " ".join(block)))
        begin += len(block)
    return found


def numeric(cells: Sequence[str]) -> float:
    """Return the share of numbers in the cells of a row that are not empty, 0 where
    there are fewer than two."""
    numbers = sum(map(is_number, cells))
    return numbers / sum(map(bool, cells)) if numbers > 1 else 0.0


def grid_of_text(lines: Sequence[str]) -> tuple[Rows, str | None]:
    """Return the rows of a table of text, and what divides its cells."""
    kept = [
        (row, line)
        for row, line in joined(lines)
        if line.strip(" \t,;") and not line.startswith("#")
    ]
    if kept and kept[0][1].lower().startswith("sep=") and len(kept[0][1]) > 4:
        divider: str | None = kept[0][1][4]
        kept = kept[1:]
    else:
        sample = [line for _, line in kept[-SAMPLE:]]
        score = {m: sum(numeric(divided(x, m)) for x in sample) for m in DIVIDERS}
        # of text alone, what divides the heads
        divider = max(
            DIVIDERS, key=lambda m: (score[m], any((m or " ") in x for x in sample))
        )
    return [(row, divided(line, divider)) for row, line in kept], divider


def sheet_rows(sheet: Any) -> Iterator[tuple[Any, ...]]:
    """Return the values of the rows of a sheet. Cells far from all others, which are
    blanks by mistake, are not read."""
    most = {"max_row": MOST_ROWS + 1, "max_col": MOST_COLUMNS}
    return iter(sheet.iter_rows(values_only=True, **most))


def rows_of(sheet: Any) -> Rows:
    """Return the rows of a sheet as texts, without the empty cells at their ends.
    Raises InputError where there are too many."""
    found, number = Rows(), 0
    for row, values in enumerate(sheet_rows(sheet), 1):
        if values.count(None) == len(values):
            continue
        cells = [
            "" if x is None else printable(" ".join(str(x).split())) for x in values
        ]
        while cells and not cells[-1]:
            cells.pop()
        number += len(cells)
        if cells and row > MOST_ROWS or number > MOST_CELLS:
            raise InputError(
                f"the sheet {printable(sheet.title)} has more than {MOST_ROWS} rows or"
                f" {MOST_CELLS} cells; save what counts as CSV"
            )
        if cells:
            found.append((row, cells))
    if found and all(len(cells) == 1 for _, cells in found):  # as lines of a text
        lines = {row: cells[0] for row, cells in found}
        grid = grid_of_text([lines.get(i, "") for i in range(1, found[-1][0] + 1)])[0]
        if sum(numeric(cells) > 0 for _, cells in grid) > len(grid) / 2:
            return grid
    return found


def first_without_value(values: Any, formulas: Any) -> int:
    """Return the first row of a sheet with a formula where no formula has a stored
    value, else 0. formulas: the same sheet, read with them."""
    found = 0
    rows = zip(sheet_rows(values), sheet_rows(formulas))
    for row, (stored, written) in enumerate(rows, 1):
        if written.count(None) == len(written):
            continue
        for value, text in zip(stored, written):
            if isinstance(text, str) and text.startswith("="):
                if value is not None:
                    return 0
                found = found or row
    return found


def check_size(path: Path) -> None:
    """Refuse a workbook that unpacks to more than any log has. Raises InputError."""
    with zipfile.ZipFile(path) as archive:  # all but pictures
        parts = [
            x for x in archive.infolist() if x.filename.endswith((".xml", ".rels"))
        ]
    if (size := sum(part.file_size for part in parts)) > MOST_BYTES:
        raise InputError(
            f"the sheets of the workbook unpack to {size / 1e6:.0f} MB, and at most"
            f" {MOST_BYTES / 1e6:.0f} MB are read; save what counts as CSV"
        )


def grid_of_workbook(path: Path, sheet: str, has_names: bool) -> Rows:
    """Return the rows of a sheet, "" for the only one that has the heads of a test, or
    of numbers if the columns have names. Raises InputError."""
    with naming(path):
        try:
            import openpyxl  # which no other file needs

            check_size(path)
            with path.open("rb") as file:  # its name may end as it likes
                book = openpyxl.load_workbook(file, read_only=True, data_only=True)
                names = [name for name in book.sheetnames if sheet in ("", name)]
                sheets = {name: rows_of(book[name]) for name in names}
                name = chosen_of(sheets, sheet, book.sheetnames, has_names)
                formulas = openpyxl.load_workbook(file, read_only=True)
                empty = first_without_value(book[name], formulas[name])
        except InputError:
            raise
        except ModuleNotFoundError as error:
            raise InputError(
                "a workbook needs openpyxl: apt-get install python3-openpyxl, or save"
                " the sheet as CSV"
            ) from error
        except Exception as error:  # openpyxl hands on whatever its parts raise
            raise InputError(
                "this is no workbook that can be read (.xlsx), but another archive or a"
                " damaged one: save it as .xlsx, or as CSV in UTF-8"
            ) from error
        if empty:
            raise InputError(
                f"row {empty} of sheet {printable(name)}: a formula without a stored"
                " value; open the workbook in a spreadsheet program and save it"
            )
    return sheets[name]


def chosen_of(
    sheets: Mapping[str, Rows], sheet: str, names: Sequence[str], has_names: bool
) -> str:
    """Return the name of the sheet that is read. sheet: the one wanted, "" for any;
    names: of all sheets. Raises InputError where there is none, or a choice."""
    every = list(map(printable, names))
    if sheet and not sheets:
        raise InputError(
            f"there is no sheet {sheet!r}; the sheets are {', '.join(every)}"
        )
    there = [name for name, rows in sheets.items() if rows]
    known = [name for name in there if heads_in(sheets[name]) is not None]
    some = known if known and not has_names else there
    if len(some) != 1:
        words = ", ".join(list(map(printable, some)) or every)
        raise InputError(
            f"{len(some)} sheets may be the test, {words}; choose one by --sheet"
        )
    return some[0]


def with_units(row: int, texts: Sequence[str], below: Sequence[str]) -> list[Head]:
    """Return the heads in a row; units are those of the row below where a head has
    none."""
    found = []
    for place, text in enumerate(texts):
        quantity, unit = head_of(text)
        under = below[place] if place < len(below) else ""
        if unit_in(unit) not in EVERY_UNIT and unit_in(under) in EVERY_UNIT:
            unit = under
        found.append(Head(place, text.strip(), quantity, unit, row))
    return found


def heads_in(rows: Rows) -> int | None:
    """Return the place of the first row that names depth and cone resistance, None for
    none."""
    for i, (_, cells) in enumerate(rows):
        found = {head_of(cell)[0] for cell in cells if cell and not is_number(cell)}
        if found & {"depth", "rods"} and found & {"qc", "qt"}:
            return i
    return None


def named(columns: str) -> list[Head]:
    """Return the heads that --columns gives, of a file without. Raises InputError."""
    found = []
    for place, text in enumerate(columns.replace(";", ",").split(",")):
        quantity, unit = head_of(text)
        if text.strip() not in ("", "-") and not quantity:
            raise InputError(
                f"--columns: {text.strip()!r} is no column that is known; an example is"
                f" {EXAMPLE}, with - for a column that is not to be read"
            )
        if quantity and not unit:
            unit = QUANTITIES[quantity].usual
        found.append(Head(place, text.strip().strip("-"), quantity, unit, 1))
    return found


def facts_of(above: Rows) -> tuple[Facts, list[str]]:
    """Return what the lines above the heads say, and in words what was made of it."""
    said: dict[str, set[float]] = {}
    texts = []
    for _, cells in above:
        if fact := fact_of(cells):
            said.setdefault(fact[0], set()).add(fact[1])
        else:
            texts.append(" ".join(" ".join(cells).split())[:40])
    known = {x.replace(" ", "_"): v.pop() for x, v in said.items() if len(v) == 1}
    unsure = [
        f"the lines above the heads have two values: {x}" for x in said if said[x]
    ]
    if texts:
        words = "; ".join(texts[:4] + ["..."] * (len(texts) > 4))
        unsure.append(
            f"lines above the heads that were not read: {len(texts)}: {words}"
        )
    return Facts(**known), unsure


def without_heads(rows: Rows) -> InputError:
    """Return the refusal of a file whose heads are not known."""
    for row, cells in rows[:SAMPLE]:
        for text in cells:
            if is_level(text) and not fact_of(cells):
                return InputError(
                    f"row {row}: the column {text.strip()!r} is a level above a datum;"
                    " subtract it from the level of the ground, and name the column"
                    " depth_m"
                )
    row, cells = rows[0]
    return InputError(
        f"no row names a column of depth and one of cone resistance, as {EXAMPLE} or in"
        f" one of twelve languages; row {row} is {', '.join(cells)[:60]!r}. Name the"
        f" columns: --columns {EXAMPLE}, with - for one that is not to be read"
    )


def refuse_wide(rows: Rows, number: int, divider: str | None) -> None:
    """Refuse rows with more cells than heads, as decimal commas make them. Raises
    InputError."""
    advice = "each column needs a head"
    if divider == ",":
        advice = "where numbers have commas, divide cells by semicolons"
    refuse(
        [
            (row, f"{len(cells)} cells, and {number} columns; {advice}")
            for row, cells in rows
            if any(cell_of(cells, i) for i in range(number, len(cells)))
        ]
    )


def table(rows: Rows, divider: str | None, columns: str) -> Table:
    """Return the table of a test in rows of cells. columns: their names and units in
    place of the heads. Raises InputError."""
    if len(rows) < 2:
        raise InputError(
            f"a cone test needs a row of heads, as {EXAMPLE}, and two rows of numbers"
        )
    place = heads_in(rows)
    if columns:
        heads, where = named(columns), "--columns"
        begin = next((i for i, (_, x) in enumerate(rows) if numeric(x)), len(rows))
        above = rows[:begin]
    elif place is None:
        raise without_heads(rows)
    else:
        (row, texts), (_, below) = rows[place], (rows[place + 1 :] or [(0, [])])[0]
        heads, where = with_units(row, texts, below), "the heads"
        units = [cell for cell in below if unit_in(cell) in EVERY_UNIT]
        begin = place + 1 + (bool(units) and not any(map(is_number, below)))
        above = rows[:place]
    refuse_wide(rows[begin:], len(heads), divider)
    lengths = [h for h in heads if h.quantity in ("depth", "rods") and not h.unit]
    heads = [h._replace(unit="m") if h in lengths else h for h in heads]
    facts, said = facts_of(above)
    said += [f"ASSUMED: {head.text!r} is in m" for head in lengths]
    if columns and not all(head_of(h.text)[1] for h in heads if h.quantity):
        said.append(
            "ASSUMED: units of --columns that has none: m, q_c in MPa, f_s and u_2 in"
            " kPa"
        )
    advice = f"heads that are read are {EXAMPLE} and their like"
    found = Table(heads, rows[begin:], where, advice, facts, said)
    found.begins_with_heads = place == 0
    return found
