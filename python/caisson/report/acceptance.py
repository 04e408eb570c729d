# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a certifier asks beside the verdict, as tables of the page: rows with formula
and source, when the vessel stops, the load of a shell model, and the factors."""
from functools import partial
from pathlib import Path
from typing import Any

from caisson import template
from caisson.report import pull
from caisson.results import Results
from caisson.verdict import acceptance, disturbed, limits, outcome
from caisson.verdict.installation import Installation, Rate

SENTENCES = Path(__file__).with_name("acceptance.jinja")
HEADS = ["row", "value", "formula", "source"]
say = partial(template.say, SENTENCES)
say_rows = partial(template.say_rows, SENTENCES)


def table(heads: list[str], rows: list[list[str]]) -> dict[str, Any]:
    """Return a table as the macro `marked` takes it: no cell is assumed."""
    return {"heads": heads, "rows": [[(cell, False) for cell in row] for row in rows]}


def rows_of(run: Results, found: Installation) -> list[list[str]]:
    """Return (row, value, formula, source)."""
    known: dict[str, tuple[Any, ...]] = {
        "seal": (acceptance.seal_of(run, found),),
        "grout": (acceptance.grout_of(run, found),),
        "scour": (acceptance.scour_of(run, found),),
        "level": (acceptance.level_of(run, found), acceptance.lacking(run)),
        "ground": (disturbed.disturbed_of(run, float(found.depth[-1])),),
    }
    rows = (say_rows(name, run.shown, *x, cells=4) for name, x in known.items())
    return [row for some in rows for row in some]


def stop_rows(run: Results, found: Installation, rate: Rate) -> list[list[str]]:
    """Return (criterion, number, what it rests on) of the vessel."""
    stop = acceptance.stop_of(run, found, run.planned or float(found.depth[-1]))
    flows = [template.say(pull.SENTENCES, "of_flow", x, 3) for x in stop.flow]
    more = outcome.depth_of(run) is not None, run.assumes("Permeability")
    return say_rows("stop", run.shown, stop, rate.words, flows, *more, cells=3)


def load_of(run: Results, found: Installation) -> dict[str, Any]:
    """Return table and note of the load of a shell model; nothing without one."""
    if (load := acceptance.load_of(run, found)) is None:
        return {}
    shown = run.shown
    rows = [
        [name, shown.depth(z), shown.words(p, "kPa", ".3g")]
        for name, z, p in load.along
    ]
    heads = ["place", "depth", "net pressure from outside"]
    return {"note": say("load", shown, load), **table(heads, rows)}


def factors_of(run: Results, found: Installation) -> dict[str, Any]:
    """Return the table of the factors, and what is missing for a design basis where
    piping limits the suction."""
    chosen = limits.chosen(run, limits.LIMITS)
    document = run.entry(f"Design/{acceptance.DOCUMENT}")
    every = [(entry, *rest) for entry, rest in chosen.items()]
    rows = say_rows("factors", every, document, cells=4)
    is_default = chosen[limits.LIMITS[limits.PIPING].entry] == (1, False)
    has_piping = not {limits.PIPING, limits.COMPUTED}.isdisjoint(found.limits)
    heads = ["factor on", "value", "what it acts on", "source"]
    return {
        **table(heads, rows),
        "note": say("no_basis") if is_default and has_piping else "",
    }


def tables_of(run: Results, found: Installation, rate: Rate) -> dict[str, Any]:
    """Return what the page shows to a certifier of a caisson that suction draws in;
    nothing of another run."""
    if not len(found.required) or not run.weight:
        return {}
    heads = ["stop at", "number", "what it rests on"]
    return {
        "rows": table(HEADS, rows_of(run, found)),
        "stop": table(heads, stop_rows(run, found, rate)),
        "load": load_of(run, found),
        "factors": factors_of(run, found),
    }
