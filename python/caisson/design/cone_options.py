# SPDX-License-Identifier: LGPL-2.1-or-later
"""What options say of the file of a cone test: the same of each command that reads
one."""
import argparse
from typing import NamedTuple

from caisson.disk import InputError

EXAMPLE = "depth_m,qc_MPa,fs_kPa,u2_kPa"  # the columns of a table
OPTIONS = {
    "location": ("NAME", "one of the tests in a file of AGS or BRO-XML"),
    "sheet": ("NAME", "the sheet of a workbook"),
    "columns": ("NAMES", f"of a table without heads, as {EXAMPLE}; - for none"),
    "above": (
        '"qc = 2 MPa, fs = 20 kPa"',
        "the soil above a test that begins below the mudline",
    ),
    "zeroed_on_deck": (
        "M",
        "depth of the water, if readings were set to 0 on deck; 0: at the mudline",
    ),
}


class How(NamedTuple):
    """What options say of a file: which test in it, which sheet, the names of the
    columns, the soil above the first row, and the water in which readings were set to 0
    on deck, "" for nothing; and the net area ratio of the cone, None for nothing."""

    location: str = ""
    sheet: str = ""
    columns: str = ""
    above: str = ""
    zeroed_on_deck: str = ""
    area_ratio: float | None = None

    def refuse(self) -> None:
        """Refuse what is said where no file of a cone test is given. Raises
        InputError."""
        for name, value in self._asdict().items():
            if value:
                name = name.replace("_", "-")
                raise InputError(f"--{name} is for a cone test, --cpt")


def add_arguments(parser: argparse.ArgumentParser | argparse._ArgumentGroup) -> None:
    """Add the options that say how a file of a cone test is read."""
    for name, (metavar, text) in OPTIONS.items():
        option = f"--{name.replace('_', '-')}"
        parser.add_argument(option, default="", metavar=metavar, help=text)


def how_of(options: argparse.Namespace) -> How:
    """Return what options say of a file."""
    said = {name: getattr(options, name) for name in OPTIONS}
    return How(**said, area_ratio=getattr(options, "area_ratio", None))
