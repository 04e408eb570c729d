# SPDX-License-Identifier: LGPL-2.1-or-later
"""What follows an installation, on the page of its scene: a row for each phase."""
from pathlib import Path
from typing import NamedTuple

from caisson import disk, phases
from caisson.disk import InputError
from caisson.phases import ENTRY, LIST, REST
from caisson.report import verdict
from caisson.report.content import SENTENCES
from caisson.results import Results
from caisson.template import say

PRESSURES = [f"pore_pressure_{end}_Pa" for end in ("smallest", "largest")]


class Row(NamedTuple):
    """A phase, what it came to in a sentence, and the folder of its page in that of the
    scene, "" where there is none yet."""

    text: str
    said: str
    folder: str


def said_of(run: Results, before: Results, is_rest: bool) -> str:
    """Return what a phase came to, after another run; of one that failed, goes on, or
    was stopped, only that."""
    if failure := run.known.get("failure"):
        return say(SENTENCES, "of_phase", f"failed: {failure}")
    if run.is_running or not run.is_finished:
        return say(SENTENCES, "of_phase", "")
    if not is_rest:
        text = verdict.verdict_of(run).text or "finished"
        reason = str(run.scene.get("end_reason") or "")
        if reason.partition(":")[0] not in text:
            text = f"{text.rstrip('.')}. Ended early: {reason}."
        return say(SENTENCES, "of_phase", text)
    ends = [[x.history.get(p, [0.0])[-1] for p in PRESSURES] for x in (before, run)]
    return say(SENTENCES, "rested", run.shown, *ends)


def is_after(of_phase: Results, before: Results, title: str) -> bool:
    """Return whether a folder has the results of a phase with a title, and not of other
    ones, nor such that are older than the run where it begins."""
    times = [str(run.known.get("written", "")) for run in (before, of_phase)]
    return of_phase.known.get("title") == title and times == sorted(times)


def rows_of(run: Results) -> list[Row]:
    """Return a row for each phase; none of a scene without. Raises InputError."""
    path = run.directory / LIST  # those that were asked for last
    asked = disk.read_text(path, InputError) if path.is_file() else run.entry(ENTRY)
    every = phases.phases_in(asked)
    title = run.known.get("title") or Path(str(run.known.get("scene_file"))).stem
    rows, before, counts = list[Row](), run, True
    for number, phase in enumerate(every, 2):
        folder = phases.folder_of(phase, number)
        of_phase = Results(run.directory / folder)
        part = every[: number - 1]  # behind one that does not count, none does
        counts = counts and is_after(of_phase, before, phases.title_of(title, part))
        said = say(SENTENCES, "not_run")
        if counts:
            said = said_of(of_phase, before, phase.word == REST)
        rows.append(Row(phase.text, said, folder if counts else ""))
        before = of_phase
    return rows
