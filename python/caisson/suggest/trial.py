# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is said of a scene before it is written: what the program says of it, and what
hand methods say, on its page."""
import concurrent.futures
import re
import tempfile
from collections.abc import Mapping
from pathlib import Path

from caisson import disk
from caisson.design import cone as cone_test
from caisson.runner import FAILS, RunError, query
from caisson.suggest.entry import SuggestError


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


def by_hand(
    file: Path,
    texts: Mapping[str, str],
    cost: str,
    test: str = "",
) -> str:
    """Return the page of the scene of a file before any run, and say its verdict;
    nothing where no hand method knows the ground. texts: the scenes by estimate; cost:
    what the program says of it; test: the table of a cone test. Raises SuggestError
    where a scene does not run."""
    from caisson.report import before
    from caisson.verdict import by_hand as methods

    seconds, facts = before.seconds_of(cost), before.to_come(file, cost)

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
        return methods.ByHand(directory, estimate, facts)

    with tempfile.TemporaryDirectory() as folder:
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            members = dict(zip(texts, pool.map(made, texts)))
        return before.page_of(members)
