# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a study and evaluates it: tables, pictures and a verdict.

The format of the file: the module caisson.study. Results, and the log of each run,
go to results/KIND. Runs that are complete there are not repeated while program,
entries and ranks are the same.
"""
import argparse
import functools
import importlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from caisson import disk, needed
from caisson.phases import ENTRY
from caisson.paths import PROGRAM, RESULTS, scene_or_study
from caisson.progress import span
from caisson.runner import Status
from caisson.runs import How, StudyRun, make, survey
from caisson.study import Options, Reader, Study, StudyError, file_name, read_toml

# those of users; the laboratory has more
KINDS = {"parameters": "caisson.uncertain"}
# the options of add_running_arguments() of a call without any
ALL = argparse.Namespace(again=False, evaluate=False, part=None, jobs=None, dask="")


def whole_number(text: str) -> int:
    """Return a number of the command line, 1 or more."""
    if int(text) < 1:
        raise ValueError
    return int(text)


def part_of(text: str) -> tuple[int, int]:
    """Return K and N of K/N."""
    number, of = map(int, text.split("/"))
    if not 1 <= number <= of:
        raise ValueError
    return number, of


def add_arguments(parser: argparse.ArgumentParser, file: Path | None = None) -> None:
    """Add the options of all studies; file: the study, an argument if None."""
    if file is None:
        parser.add_argument("file", type=scene_or_study, help="the study, a .toml file")
    else:
        parser.set_defaults(file=file)
    add = parser.add_argument
    add("--list", action="store_true", help="say what there is, and run nothing")
    add("--results", type=Path, help="directory of the results")
    add_running_arguments(parser)


def add_running_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of which runs are made, and where."""
    add = parser.add_argument
    add("--again", action="store_true", help="repeat also runs that are complete")
    add("--evaluate", action="store_true", help="evaluate what is there, run nothing")
    text = "run only the K-th of N parts, and evaluate nothing: for an array of jobs"
    add("--part", type=part_of, metavar="K/N", help=text)
    text = "runs at a time, default: what is fastest for all of them"
    add("--jobs", type=whole_number, metavar="N", help=text)
    text = "run on the workers of this scheduler of Dask, such as tcp://host:8786"
    add("--dask", default="", metavar="ADDRESS", help=text)
    add("--program", type=Path, default=PROGRAM, help="caisson_mpm")


def module_of(file: Path, kinds: Mapping[str, str] = KINDS) -> ModuleType:
    """Return the module of the kind of study. Raises StudyError."""
    kind = read_toml(file).get("kind", "")
    if kind not in kinds:
        known = ", ".join(kinds)
        more = "" if len(kinds) > len(KINDS) else "; scripts/lab study knows others"
        raise StudyError(f"{file}: kind is {kind!r}, not one of {known}{more}")
    try:
        return importlib.import_module(kinds[kind])
    except ModuleNotFoundError as error:
        raise StudyError(needed.complaint() or str(error)) from error


def reader_of(file: Path, options: Options, module: ModuleType) -> Reader:
    """Return what reads a study of a user of the kind of this module."""
    return Reader(file, options, module.STUDY_KEYS, module.make_runs)


def cost_of(study: Study) -> str:
    """Return how long the runs of a study take on one core, as a range. Where the file
    does not say it, the program is asked for the first, the middle and the last."""
    silent = [run for run in study.runs if not run.seconds]
    asked = silent[:: max(1, (len(silent) - 1) // 2)][:3]
    for run in asked:
        run.query_size()
    found = [run.duration for run in asked]
    if not all(found):
        return "duration not known"
    said = sum(run.seconds for run in study.runs)
    least = said + len(silent) * min((run.size.least for run in asked), default=0)
    most = said + len(silent) * max(found, default=0)
    text = f"about {span(least, most)} on one core"
    return text + (", by the speed of the first steps" if asked else "")


def options_of(arguments: argparse.Namespace, module: ModuleType) -> Options:
    """Return what makes the runs of a kind, and where."""
    results = arguments.results or RESULTS / module.NAME.replace(" ", "_")
    return Options(arguments.program.resolve(), results)


def is_list(arguments: argparse.Namespace, studies: Sequence[Study]) -> bool:
    """Return whether studies are only to be listed, after that. Raises StudyError
    without any."""
    if not studies:
        raise StudyError(f"{arguments.file}: no study fits")
    for study in studies if arguments.list else []:
        n = len(study.runs)
        print(f"{study.id}: {study.title}, {n} runs, {cost_of(study)}", flush=True)
    return bool(arguments.list)


def main(arguments: argparse.Namespace) -> int:
    """Run and evaluate."""
    module = module_of(arguments.file)
    options = options_of(arguments, module)
    studies = reader_of(arguments.file, options, module).studies()
    if is_list(arguments, studies):
        return 0
    for study in studies:  # a user may have several of one name
        way = "choose another --results or another id"
        disk.claim(options.results / file_name(study.id), arguments.file, way)
    runs = [run for study in studies for run in study.runs]
    refuse = functools.partial(module.refuse, studies)
    status = run_missing(runs, arguments, refuse=refuse)
    return int(module.evaluate(studies, options, 0.0)) if status is None else status


def run_missing(
    runs: Sequence[StudyRun],
    arguments: argparse.Namespace,
    is_own: bool = True,
    refuse: Callable[[list[StudyRun]], None] = lambda _: None,
    **how: Any,
) -> int | None:
    """Make the runs that are not complete, as the options of add_running_arguments()
    say; return the exit status of a part, and None where there is to evaluate.

    is_own: of a user, so that all are checked first and go on from their checkpoints;
    refuse: raises StudyError where one of those to do is refused; how: further keys of
    How.
    """
    if arguments.evaluate:
        return None
    to_do = survey(runs, arguments.again, resumes=is_own, asks_all=is_own)
    refuse(to_do)
    if is_own and any(not x.refusal and x.run.in_effect.get(ENTRY) for x in to_do):
        print("note: only caisson run computes the phases of Installation/Phases")
    if arguments.part:
        number, of = arguments.part
        runs = runs[number - 1 :: of]
    chosen = [run for run in to_do if run in runs]
    make(chosen, How(arguments.again, arguments.jobs, arguments.dask, **how))
    if not arguments.part:
        return None
    missing = [run for run in runs if run.status != Status.SUCCESS]
    done = len(runs) - len(missing)
    print(f"part {number} of {of}: {done} of {len(runs)} runs are complete")
    for run in missing:
        print(f"{run.study} {run.name}: {run.words}")
    return 1 if missing else 0
