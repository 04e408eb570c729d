# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "parameters": what entries of a scene do to its forces or suction.

Keys of a study beside the usual ones, of which runs, variants and meshes are left out
because the parameters make the runs:

    sampling       "grid" (default of one parameter): each combination of all values;
                   "one at a time": the base, and it with one value changed;
                   "Latin hypercube": of distributions
    samples, seed  of a Latin hypercube: the number of runs, and another choice (0)
    correlations   of a Latin hypercube: [["phi", "E", 0.5]], rank correlations
    observe        a column of history.csv; default: required_suction_Pa,
                   total_force_with_water_N or total_force_N, the first there is
    depths         of the table (m), default each meter and the end
    tornado_depth  of tornado.png (m), default the deepest of depths in all runs
    reference = {} runs the scene as it is, too, for fan.png

The tables [parameters.NAME] are in the manual (doc/how_to/studies.md): values, range,
choices, times, formula or distribution of the entry of this name, or of entry = "..."
or entries = [...]; base is the value of one at a time, by default the median of a
distribution or the value of the scene.

A distribution is taken at its quantiles of 5 and 95 % where one parameter changes at a
time. All runs are checked before the first one starts. Results, besides those of the
runs, go to the directory of the study: table.csv, fan.csv, fan.png, tornado.png and, of
a Latin hypercube, surface.csv: P5, P50 and P95 of the penetration by weight and of what
is observed at the quarters of the planned penetration, and the probability of refusal,
by a response surface (caisson.uncertain.surface).
"""
from collections.abc import Sequence
from pathlib import Path

from caisson.uncertain import pictures, surface, tables
from caisson.uncertain.outcome import Outcomes
from caisson.uncertain.sampling import LATIN, runs_of
from caisson.paths import short
from caisson.runs import StudyRun
from caisson.study import Options, Study, StudyError, file_name

NAME = "parameters"
STUDY_KEYS = set(
    "parameters sampling samples seed correlations observe depths tornado_depth".split()
)
make_runs = runs_of


def refuse(studies: Sequence[Study], runs: Sequence[StudyRun]) -> None:
    """Raise StudyError with what the program says of the first of the runs that it
    refuses, before any of them begins."""
    refused = [run for run in runs if run.refusal]
    if not refused:
        return
    first, others = refused[0], len(refused) - 1
    text = f"{first.study}: the run {first.name!r} is refused: {first.refusal}"
    if others:
        text += f"\n(so {'is' if others == 1 else 'are'} {others} of the other runs)"
    n = sum(len(study.runs) for study in studies)
    if any("samples" in study.keys for study in studies) and len(refused) < n:
        text += "\ncut off a distribution that leaves what is allowed, by min and max"
    raise StudyError(text)


def evaluate(studies: Sequence[Study], options: Options, _: float) -> int:
    """Write and print the results of each study; return 1 where a run is missing."""
    status = 0
    for study in studies:
        directory = options.results / file_name(study.id)
        outcomes = Outcomes(study)
        files: list[Path | None] = [
            tables.write_runs(directory / "table.csv", outcomes)
        ]
        depth = outcomes.tornado_depth()
        if outcomes.complete:
            files += [
                tables.write_fan(directory / "fan.csv", outcomes),
                pictures.draw_fan(directory / "fan.png", outcomes),
                pictures.draw_tornado(directory / "tornado.png", outcomes, depth),
            ]
            if study.keys.get("sampling") == LATIN:
                found = surface.of_study(outcomes)
                place = directory / "surface.csv"
                files += [tables.write_surface(place, found)] if found else []
        print("\n".join(tables.lines(outcomes, depth)))
        for file in filter(None, files):
            print(f"{study.id}: {short(file)}")
        if outcomes.complete:
            print(f"{study.id}: next: open {short(directory / 'fan.png')}")
        if len(outcomes.complete) < len(outcomes.all):
            status = 1
    return status
