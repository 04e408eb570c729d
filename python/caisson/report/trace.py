# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the numbers of a page come from, and who answers for them: checksums of scene
and results, the error of the mesh, and who computed and checked.

The checksum of a scene is the SHA-256 of its entries in effect but those of section
Output, as lines "Section/Entry = value" in the order of their names; that of the
results is the one of history.csv. Who computed and who checked is kept in the directory
of the run, with the checksum of the results that they had: others are not signed.
"""
import datetime
import functools
import hashlib
import json
from pathlib import Path
from typing import Any, NamedTuple

from caisson import disk
from caisson.band import band_of
from caisson.disk import InputError
from caisson.evaluation import DEPTH
from caisson.report.content import SENTENCES
from caisson.results import Results
from caisson.table import text_of
from caisson.template import say
from caisson.verdict import uncertainty

NAME, HISTORY = "signed.json", "history.csv"
SHORT = 12  # digits of a checksum at the foot of a page


class Signed(NamedTuple):
    """Who computed and checked, and when the last of them signed; empty for nobody."""

    author: str = ""
    checked: str = ""
    date: str = ""


class Trace(NamedTuple):
    """The checksums of scene and results, and the error of the mesh in words."""

    scene: str
    results: str
    mesh: str


def sum_of(data: bytes) -> str:
    """Return the SHA-256 of data, in hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()


def sum_of_results(directory: Path) -> str:
    """Return the checksum of the results of a run."""
    return sum_of(disk.read_bytes(directory / HISTORY))


def entries_of(run: Results) -> dict[str, str]:
    """Return the entries in effect, in the order of their names, but those that only
    say what is written, and where."""
    every = {**run.known.get("defaults", {}), **run.known.get("entries", {})}
    return {k: str(v) for k, v in sorted(every.items()) if not k.startswith("Output/")}


def sum_of_scene(run: Results) -> str:
    """Return the checksum of the scene of a run."""
    lines = [f"{name} = {value}\n" for name, value in entries_of(run).items()]
    return sum_of("".join(lines).encode())


def mesh_error_of(run: Results) -> str:
    """Return by how much the mesh may change the force at the end, in words."""
    known = uncertainty.at_end(band_of(run)) if DEPTH in run.history else []
    for found in known:
        for part in found.parts:
            if part.name == uncertainty.MESH and found.values[-1] > 0:
                below, above = (100 * x[-1] / found.values[-1] for x in part[1:3])
                return f"-{text_of(below)} to +{text_of(above)} % ({part.source})"
    return "not known"


@functools.lru_cache(maxsize=16)
def trace_of(run: Results) -> Trace | None:
    """Return where the numbers of a run come from; None of one that goes on."""
    if run.is_running:
        return None
    sums = sum_of_scene(run), sum_of_results(run.directory)
    return Trace(*sums, mesh_error_of(run))


def keep(directory: Path, author: str | None, checked: str | None) -> None:
    """Keep who computed and who checked the results that a run has now; None of both
    stays as it was, for the same results."""
    if author is None and checked is None:
        return
    before = signed_of(directory)
    found = {
        "author": before.author if author is None else author,
        "checked": before.checked if checked is None else checked,
        "date": datetime.date.today().isoformat(),
        "results": sum_of_results(directory),
    }
    text = json.dumps(found, indent=2, ensure_ascii=False) + "\n"
    disk.write(directory / NAME, text)


def signed_of(directory: Path) -> Signed:
    """Return who answers for the results of a run; nobody for others than those that
    were signed. Raises InputError."""
    path = directory / NAME
    if not path.is_file():
        return Signed()
    try:
        found: dict[str, Any] = dict(json.loads(disk.read_text(path, InputError)))
    except (TypeError, ValueError) as error:
        raise InputError(f"{path} cannot be read: {error}") from error
    if found.get("results") != sum_of_results(directory):
        return Signed()
    return Signed(*(str(found.get(name, "")) for name in Signed._fields))


def foot_of(run: Results, title: str) -> dict[str, Any]:
    """Return the lines at the left of the foot of each page, and at the right before
    its number; and who signed."""
    signed, left = signed_of(run.directory), [title]
    if trace := trace_of(run):
        left.append(say(SENTENCES, "foot", run.known, trace))
        left.append(say(SENTENCES, "sums", trace, SHORT))
    right = f"{say(SENTENCES, 'signed', signed)}\n{signed.date} page"
    return {"footer": "\n".join(left), "signature": right, "signed": signed}
