# SPDX-License-Identifier: LGPL-2.1-or-later
"""Copies the table of results/speed into lab/performance/speed.md, and the pictures
into doc/pictures."""
import argparse
import shutil

from caisson.paths import PICTURES, RESULTS, ROOT
from caisson import disk

DOCUMENT = ROOT / "lab/performance/speed.md"
BEGIN, END = "<!-- speed: begin -->", "<!-- speed: end -->"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab publish-speed`: none."""


def main(_: argparse.Namespace) -> int:
    """Replace what stands between the two marks."""
    before, rest = DOCUMENT.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    table = (RESULTS / "speed/table.md").read_text(encoding="utf-8")
    table = table.replace("](pictures/", "](../../doc/pictures/")
    disk.write(DOCUMENT, f"{before}{BEGIN}\n{table}\n{END}{after}")
    for picture in (RESULTS / "speed").glob("speed_*.png"):
        shutil.copy(picture, PICTURES)
    return 0
