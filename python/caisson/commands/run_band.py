# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of low, best and high resistance at the same time, one core each, and the page
of the best one with all three."""
import argparse
import sys
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from pathlib import Path

from caisson.band import BEST, ESTIMATES, HIGH, LOW, member_of
from caisson.command_line import Parser
from caisson.progress import span
from caisson.ranks import cores
from caisson.runner import Run, RunError, Status
from caisson.runs import How, StudyRun, make, survey


def options_of(
    words: Sequence[str], taker: str = "--band", further: Sequence[str] = ()
) -> argparse.Namespace:
    """Return the options of the program that a band takes, or another one that makes
    several runs, with further ones. Raises RunError."""
    parser = Parser(prog="caisson run", add_help=False, allow_abbrev=False)
    for name in further:
        parser.add_argument(name)
    for name in ("--restart", "--overwrite"):
        parser.add_argument(name, action="store_true")
    parser.add_argument("--set", action="append", default=[])
    found, other = parser.parse_known_args(words)
    if other:
        raise RunError(
            f"{taker} takes {', '.join([*further, '--set'])}, --restart and"
            f" --overwrite, not {other[0]}. Write the entries that you change into the"
            " scenes"
        )
    return found


def scenes_of(best: Path) -> dict[str, Path]:
    """Return the scenes of a band by estimate, as far as there are such. Raises
    RunError without any beside the best one."""
    members = {estimate: member_of(best, estimate) for estimate in ESTIMATES}
    found = {e: path for e, path in members.items() if path.is_file()}
    if BEST not in found:
        raise RunError(f"there is no scene {best}")
    if len(found) == 1:
        raise RunError(
            f"beside {best} there is neither {members[LOW].name} nor"
            f" {members[HIGH].name}: caisson suggest --spread, or --low and --high,"
            " writes them"
        )
    return found


def runs_of(best: Path, entries: dict[str, str]) -> dict[str, StudyRun]:
    """Return the runs of a band by estimate. Their directories are named after that of
    the best one. Raises RunError."""
    directory = Run(best, entries).directory
    found = {}
    for estimate, scene in scenes_of(best).items():
        place = member_of(directory, estimate).resolve()
        run = Run(scene.resolve(), entries, place)
        found[estimate] = StudyRun("run:", scene.stem, run)
    return found


def what_becomes_of(member: StudyRun, is_to_do: bool) -> str:
    """Return in words whether a run is computed, and from where."""
    if not is_to_do:
        ended = "complete" if member.status == Status.SUCCESS else "failed before"
        return f"{ended}, and not repeated; --overwrite repeats it"
    run, size = member.run, member.size
    about = f", {span(size.least, size.seconds)}" if size.seconds else ""
    if run.restarts:
        return f"from its checkpoint{about}"
    hint = "; --restart resumes it" if run.has_checkpoint else ""
    return f"from its start{about}{hint}"


def compute(runs: dict[str, StudyRun], options: argparse.Namespace) -> bool:
    """Compute what is missing, one core each; return whether that was stopped. Raises
    RunError where the program refuses a run."""
    to_do = survey(list(runs.values()), options.overwrite, asks_all=True)
    for member in to_do:
        if member.refusal:
            raise RunError(member.refusal)
        member.run.restarts = options.restart and member.run.has_checkpoint
    for member in runs.values():
        text = what_becomes_of(member, member in to_do)
        print(f"run: {member.name}: {text}", flush=True)
    try:
        make(to_do, How(again=True, jobs=min(3, cores())))
    except KeyboardInterrupt:
        print("run: stopped; --restart resumes", file=sys.stderr)
        return True
    return False


def status_of(member: StudyRun) -> Status:
    """Return the exit status of a run, a failure where it has left no record."""
    if member.is_stopped:
        return Status.STOPPED
    return Status.FAILURE if member.status is None else member.status


def main(
    words: Sequence[str],
    draw: Callable[[Path, None, bool], None],
    reporting: Callable[[Path], AbstractContextManager[None]],
) -> int:
    """Run a band and draw it, the best run last and in full; return the largest exit
    status. words: the best scene, and options of the program; draw: draws a run;
    reporting: renews the page of the best one as long as it runs."""
    options = options_of(words[1:])
    entries = dict(text.split("=", 1) for text in options.set if "=" in text)
    runs = runs_of(Path(words[0]), {k.strip(): v.strip() for k, v in entries.items()})
    with reporting(runs[BEST].run.directory):
        if compute(runs, options):
            return Status.STOPPED
    for estimate in (LOW, HIGH, BEST):
        if estimate in runs and runs[estimate].status is not None:
            draw(runs[estimate].run.directory, None, estimate == BEST)
    for member in runs.values():
        if member.trouble:
            hint = "; --restart resumes it" if member.run.has_checkpoint else ""
            print(f"run: {member.name}: {member.trouble}{hint}", file=sys.stderr)
    return max(map(status_of, runs.values()))
