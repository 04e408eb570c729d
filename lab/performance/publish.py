# SPDX-License-Identifier: LGPL-2.1-or-later
"""Copies the tables of results/speed into lab/performance/speed.md, and the picture of
the manual into doc/pictures."""
import argparse
import re
import shutil

from caisson.paths import PICTURES, RESULTS, ROOT
from caisson import disk

DOCUMENT = ROOT / "lab/performance/speed.md"
PICTURE = "speed_step.png"  # of benchmarks.md
BEGIN, END = "<!-- speed: begin -->", "<!-- speed: end -->"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `scripts/lab publish-speed`: none."""


def main(_: argparse.Namespace) -> int:
    """Replace what stands between the two marks."""
    before, rest = DOCUMENT.read_text(encoding="utf-8").split(BEGIN)
    after = rest.split(END)[1]
    table = (RESULTS / "speed/table.md").read_text(encoding="utf-8")
    table = re.sub(r"!\[.*?\]\(pictures/.*?\)\n\n", "", table)
    disk.write(DOCUMENT, f"{before}{BEGIN}\n{table}\n{END}{after}")
    shutil.copy(RESULTS / "speed" / PICTURE, PICTURES)
    return 0
