# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs the study of a cone test, and writes report.html: the test, layers, and the
forces of all estimates beside the design methods, on one page."""
import argparse
import html
import re
from itertools import chain
from pathlib import Path

import numpy as np

from caisson.commands.round_trip import Cone
from caisson.template import picture_of, template
from caisson import disk, plot, report, study_command
from caisson.band import BEST, ESTIMATES
from caisson.design import cone_texts
from caisson.parameters import methods
from caisson.parameters.methods import TOTAL, Answers
from caisson.parameters.outcome import Outcomes, words_of
from caisson.report import band
from caisson.verdict import run_review, theory
from caisson.results import ResultsError
from caisson.study import Options, Study, file_name
from caisson.table import text_of

HERE = Path(__file__).parent
NAME = "report.html"
WIDEST = 5  # layers side by side


def run_study(file: Path, directory: Path, jobs: int | None) -> int:
    """Run what is missing of a study, into a directory; return its status."""
    parser = argparse.ArgumentParser(prog="caisson study")
    study_command.add_arguments(parser, file)
    parser.set_defaults(results=directory, jobs=jobs)
    return study_command.main(parser.parse_args([]))


def study_of(file: Path, directory: Path) -> Study:
    """Return the study of a file with results in a directory. Raises StudyError."""
    module = study_command.module_of(file)
    options = Options(results=directory.resolve())
    return study_command.reader_of(file, options, module).studies()[0]


def forces_of(found: Answers) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows of the total force (kN) at each meter and at the end: of
    each run, and the range of each method."""
    meters = np.arange(1, int(found.depth[-1] + 1e-6) + 1)
    at = np.searchsorted(found.depth, meters - 1e-6)
    at = np.unique([*at, len(found.depth) - 1])
    heads = ["Depth (m)", *(f"Computed, {name}" for name in found.names)]
    columns = [[text_of(depth) for depth in found.depth[at]]]
    for force in found.computed:
        columns.append([text_of(value / 1e3) for value in force[at]])
    for i, method in enumerate(theory.METHODS):
        band = found.band(i)
        if band is None:
            continue
        heads.append(method.name)
        low, high = (end[at] / 1e3 for end in band)
        columns.append([range_of(a, b) for a, b in zip(low, high)])
    return heads, [list(row) for row in zip(*columns)]


def uncertainty_of(found: Answers) -> str:
    """Return how far the force, or the required suction, of the best estimate may be
    wrong, in words; nothing where an estimate is missing."""
    runs = {x: run.run.results for x, run in zip(found.names, found.runs)}
    return band.uncertainty_of(runs[BEST]) if set(runs) == set(ESTIMATES) else ""


def range_of(low: float, high: float) -> str:
    """Return two ends, nothing where there are none."""
    if not np.isfinite(low + high):
        return ""
    return f"{text_of(low)} to {text_of(high)}"


def by_layer(
    heads: list[str], rows: list[list[str]]
) -> list[tuple[list[str], list[list[str]]]]:
    """Return a table of layers as tables with a column for each layer and few of them,
    which fit on a page."""
    found = []
    for first in range(0, len(rows), WIDEST):
        columns = [heads, *rows[first : first + WIDEST]]
        # a head is a title, but for symbols
        lines = [
            [re.sub("^[a-z]{4,}", lambda word: word[0].capitalize(), head), *rest]
            for head, *rest in zip(*columns)
        ]
        found.append((lines[0], lines[1:]))
    return found


def with_subscripts(text: str) -> str:
    """Return a text as HTML, with q_c and its like as one writes them."""
    safe = html.escape(text).replace("phi (deg)", "φ (°)")
    return re.sub(r"\b([A-Za-z])_(\w+)", r"\1<sub>\2</sub>", safe)


def reports_of(outcomes: Outcomes, directory: Path) -> list[tuple[str, str]]:
    """Draw pictures and report of each run; return (name, path from the page)."""
    found = []
    for outcome in outcomes.complete:
        of_run = outcome.run.run.directory
        plot.draw(of_run)
        path = report.write(of_run)
        found.append((outcome.name, str(path.relative_to(directory.resolve()))))
    return found


def troubles_of(outcomes: Outcomes) -> list[str]:
    """Return what has failed, and the warnings of the runs."""
    found = [outcome.trouble for outcome in outcomes.all if not outcome.is_complete]
    warnings: dict[str, list[str]] = {}
    for outcome in outcomes.complete:
        for warning in chain(*run_review.warnings_of(outcome.run.results).values()):
            warnings.setdefault(warning, []).append(outcome.name)
    return found + [f"{', '.join(names)}: {text}" for text, names in warnings.items()]


def job_of(facts: list[tuple[str, str]], outcomes: Outcomes) -> list[tuple[str, str]]:
    """Return what a first page must name: facts, and when the last run was computed and
    by what."""
    summaries = [outcome.run.results.summary for outcome in outcomes.complete]
    last = max(summaries, key=lambda summary: str(summary.get("written", "")))
    written = str(last.get("written", ""))[:16].replace("T", " ")
    program = f"caisson_mpm {last.get('version', '')}".rstrip()
    return [*facts, ("Computed", written or "not known"), ("Program", program)]


def write(cone: Cone, file: Path, facts: list[tuple[str, str]]) -> Path:
    """Write the page of a study with a cone test, into the directory of its cone.
    facts: what it names first. Raises ResultsError where no run has an answer."""
    test, directory = cone.found, cone.directory
    study = study_of(file, directory)
    outcomes = Outcomes(study)
    if not outcomes.complete:
        raise ResultsError(f"no run of {file} is complete: see their logs")
    answers = methods.answers_of(outcomes)
    results = directory / file_name(study.id)
    answer = cone.known()
    css = Path(report.__file__).parent / "page.css"
    path = directory / NAME
    disk.write(
        path,
        template(HERE / "cpt_page.html.jinja", sub=with_subscripts).render(
            title=study.title,
            job=job_of(facts, outcomes),
            test=test.name,
            troubles=troubles_of(outcomes),
            soil=by_layer(*cone_texts.cells_of(test.layers)),
            remarks=cone_texts.remarks(test),
            uncertainty=uncertainty_of(answers),
            forces=forces_of(answers),
            reasons=theory.reasons(answers.answers[0]),
            profile=picture_of(directory / "cpt.png"),
            methods=picture_of(results / "methods.png"),
            cone=answer and answer.words(),
            cone_picture=answer and picture_of(cone.write(answer)[1]),
            observed="" if outcomes.column == TOTAL else words_of(outcomes.column),
            fan=picture_of(results / "fan.png"),
            reports=reports_of(outcomes, directory),
            style=css.read_text(encoding="utf-8"),
        ),
    )
    return path
