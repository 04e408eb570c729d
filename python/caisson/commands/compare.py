# SPDX-License-Identifier: LGPL-2.1-or-later
"""Several runs beside each other: a picture of the forces that push or pull their
caissons and, where suction draws them in, of the required suction; and a .csv file with
all their forces at common depths. Of two runs it prints what differs in the scene and
in what their pages say first.

The file has a row for each depth, and a column for each force of each run, as in
total_force_N [jack]; cells where a run has not been are empty. Where a body goes down
and up again the way up has columns of its own, total_force_N [jack up]. A value is a
mean over 0.2 m, as everywhere; see curves.
"""
import argparse
from collections.abc import Iterator

import numpy as np

from caisson.plot import comparison
from caisson.report import scene, trace, verdict
from caisson.report.low_and_high import cards_of, sentence_of
from caisson.results import Results
from caisson.verdict import installation, outcome
from caisson.verdict.installation import Rate

add_arguments = comparison.add_arguments
NONE = "none"  # of what one of them does not have
Words = dict[str, str]  # by the name of an entry or a card


def part_of(run: Results) -> installation.Installation | None:
    """Return the installation of a run down to where suction ends."""
    if (found := outcome.whole_way(run)) is None:
        return None
    return outcome.feasible_part(run, found, outcome.depth_of(run))


def page_of(
    run: Results, part: installation.Installation | None, common: float
) -> Words:
    """Return what the page of a run says first: its verdict, the cards of its part down
    to where suction ends, and the limits of the suction at a depth (m) that other runs
    have, too."""
    said = {"verdict": f"{verdict.verdict_of(run).text} {sentence_of(run)}".strip()}
    if part is not None:
        for name, *words in cards_of(run, verdict.cards_of(run, part, Rate())):
            said[name] = ", ".join(filter(None, words))
        here = installation.installation_of(run, Rate(), np.array([common])) or part
        for name, values in here.limits.items():
            if np.isfinite(values[-1]):
                most = run.shown.words(float(values[-1]), "kPa", ".3g")
                said[f"{here.named(name)}, at {run.shown.place(common)}"] = most
    return {name: text for name, text in said.items() if text}


def changes(title: str, one: Words, other: Words) -> Iterator[str]:
    """Yield in lines what differs, both values below each other."""
    names = [x for x in {**one, **other} if one.get(x) != other.get(x)]
    yield f"{title}: {'differs in' if names else 'the same'}"
    for name in names:
        yield f"  {name}"
        yield f"    {one.get(name, NONE)}"
        yield f"    {other.get(name, NONE)}"


def differences(runs: list[Results]) -> Iterator[str]:
    """Yield in lines what differs between two runs that have left a run.json."""
    if all(run.known for run in runs):
        names = comparison.names_of([run.directory for run in runs])
        yield "of each pair, the upper is {}, the lower {}".format(*names)
        scenes = (scene.with_units(run, trace.entries_of(run)) for run in runs)
        yield from changes("scene", *scenes)
        parts = [*map(part_of, runs)]
        ends = (float(part.depth[-1]) for part in parts if part and len(part.depth))
        common = min(ends, default=0.0)
        pages = (page_of(*pair, common) for pair in zip(runs, parts))
        yield from changes("verdict, cards and limits", *pages)


def main(options: argparse.Namespace) -> int:
    """Compare the runs, and say of two of them what differs."""
    status = comparison.main(options)
    directories = comparison.directories_of(options.words)
    if len(directories) == 2:
        for line in differences([*map(Results, directories)]):
            print(line)
    return status
