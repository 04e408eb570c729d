# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is said of a scene before it is written: what the program says of it, and what
hand methods say, on its page."""
import concurrent.futures
import re
import shlex
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

from caisson import disk
from caisson.design import cone as cone_test
from caisson.paths import INSTALLED
from caisson.results import ResultsError
from caisson.runner import RunError, query
from caisson.suggest.entry import SuggestError

FAILS = "the first steps of the run fail"  # of --validate
DURATION = re.compile(r"^ *duration +(about [^:]+):", re.M)  # of it, too
STEP = re.compile(r"^ *time step +([\d.e-]+) s", re.M)
FEW_STEPS = 4  # which show that a scene runs


def said_of(text: str, file: Path, copy: Path, said: str) -> str:
    """Return what the program says of a refused scene, of which no file is left: its
    lines in the place of their numbers."""
    lines = text.splitlines()

    def line(match: re.Match[str]) -> str:
        return f"“{lines[int(match[1]) - 1].strip()}”"

    said = re.sub(rf"(?:in )?{re.escape(str(copy))}:(\d+)", line, said)
    return said.replace("is set in “", "is “").replace(str(copy), str(file))


def cost_of(file: Path, text: str) -> str:
    """Return what the program says of a scene, which is going to be this file, and of
    its cost. Raises SuggestError where it refuses it."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, file.name)
        copy.write_text(text, encoding="utf-8")
        try:
            said = query([str(copy), "--validate"]).replace(str(copy), str(file))
        except RunError as error:
            said = said_of(text, file, copy, str(error))
            raise SuggestError(
                f"the program refuses the scene, which is not written:\n{said}"
            ) from error
    if FAILS in said:
        raise SuggestError(f"the scene, which is not written, does not run:\n{said}")
    return said


def page_of(scene: Path) -> Path:
    """Return the page of a scene before any run."""
    return scene.with_suffix(".html")


def run_of(scene: Path, estimates: Sequence[str], *options: str) -> str:
    """Return the command that runs a scene, with these estimates beside it, as a shell
    reads it; options: further ones."""
    run = "caisson run" if INSTALLED else "scripts/run"
    name = shlex.quote(str(scene)) if scene.name[0] != "-" else f"./{scene}"
    return " ".join([run, *["--band"] * bool(estimates), *options, name])


def by_hand(
    file: Path,
    texts: Mapping[str, str],
    cost: str,
    estimates: Sequence[str],
    test: str = "",
) -> str:
    """Return the page of the scene of a file before any run, and say its verdict;
    nothing where no hand method knows the ground. texts: the scenes by estimate; cost:
    what the program says of it; estimates: of which scenes are to be written; test: the
    table of a cone test. Raises SuggestError where a scene does not run."""
    from caisson.report import low_and_high as ends
    from caisson.report import page, verdict
    from caisson.verdict import by_hand as methods
    from caisson.verdict.installation import Rate

    duration, step = DURATION.search(cost), STEP.search(cost)
    seconds = FEW_STEPS * float(step[1]) if step else 0.0
    to_come = {
        "scene_file": str(file),
        "cost": duration[1] if duration else "",
        "next": run_of(file, estimates),
    }

    def made(estimate: str) -> methods.ByHand:
        directory = Path(folder, estimate)
        directory.mkdir()
        scene = disk.keep(directory / file.name, texts[estimate])
        try:
            methods.step(scene, directory, seconds)
        except RunError as error:
            said = said_of(texts[estimate], file, scene, str(error))
            raise SuggestError(
                f"the scene of {estimate} resistance, which is not written, does not"
                f" run:\n{said}"
            ) from error
        if test:
            disk.keep(directory / cone_test.NAME, test)
        return methods.ByHand(directory, estimate, to_come)

    with tempfile.TemporaryDirectory() as folder:
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            members = dict(zip(texts, pool.map(made, texts)))
        best = methods.band_of(members)
        try:
            found = page.html(best, Rate())
        except ResultsError as error:
            print(f"no page: {error}")
            return ""
        for line in filter(None, [*verdict.lines_of(best), ends.sentence_of(best)]):
            print(line)
    return found
