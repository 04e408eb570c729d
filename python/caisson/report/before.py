# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a scene before any run, by hand methods: FILE.html beside FILE.prm."""
import re
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

from caisson.band import BEST, ESTIMATES, member_of
from caisson.design import cone as cone_test
from caisson.report import low_and_high, page, verdict
from caisson.results import ResultsError
from caisson.runner import FAILS, RunError, command_for, query
from caisson.verdict import by_hand
from caisson.verdict.installation import Rate

DURATION = re.compile(r"^ *duration +(about [^:]+):", re.M)  # of --validate
STEP = re.compile(r"^ *time step +([\d.e-]+) s", re.M)
FEW_STEPS = 4  # which show that a scene runs


def seconds_of(cost: str) -> float:
    """Return how long the few steps are that show that a scene runs (s). cost: what the
    program says of it."""
    step = STEP.search(cost)
    return FEW_STEPS * float(step[1]) if step else 0.0


def to_come(scene: Path, cost: str) -> dict[str, str]:
    """Return what the page says of the run that is to come, but how to start it. cost:
    what the program says of the scene."""
    duration = DURATION.search(cost)
    return {"scene_file": str(scene), "cost": duration[1] if duration else ""}


def page_of(members: Mapping[str, by_hand.ByHand], rate: Rate = Rate()) -> str:
    """Return the page of a scene, and say its verdict; nothing where no hand method
    knows the ground. members: the scene in soil of low, best and high resistance."""
    try:
        best = by_hand.band_of(members)
        beside = [x for x in members if x != BEST and x not in best.left_out]
        scene = Path(best.summary["scene_file"])
        best.summary["next"] = command_for(scene, beside)
        found = page.html(best, rate)
    except ResultsError as error:
        print(f"no page: {error}")
        return ""
    for line in [*verdict.lines_of(best), low_and_high.sentence_of(best)]:
        if line:
            print(line)
    return found


def html(scene: Path, rate: Rate, prepare: Callable[[Path], object]) -> str:
    """Return the page of a scene as it is now, with those of low and high resistance
    beside it, as page_of() does. prepare: keeps what is given of the methods with the
    directory of a step. Raises ResultsError with what the program says where it refuses
    a scene."""
    with tempfile.TemporaryDirectory() as folder:
        members = dict[str, by_hand.ByHand]()
        try:
            cost = query([str(scene), "--validate"])
            if FAILS in cost:
                raise RunError(cost)
            files = {x: member_of(scene, x) for x in ESTIMATES}
            files = {x: file for x, file in files.items() if file.is_file()}
            facts = to_come(scene, cost)
            for estimate, file in files.items():
                directory = Path(folder, estimate)
                by_hand.step(file, directory, seconds_of(cost))
                members[estimate] = by_hand.ByHand(directory, estimate, facts)
        except RunError as error:
            raise ResultsError(str(error)) from error
        for member in members.values():
            cone_test.adopt_beside(member.directory, scene)
            prepare(member.directory)
        return page_of(members, rate)
