# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report says of the design methods: their numbers beside those of the run,
computed over method, and why the run is where it is."""
import math
from typing import Any, NamedTuple

import numpy as np

from caisson import curves
from caisson.plot import design, suction_methods, theory
from caisson.plot.forces import penetration
from caisson.results import Results
from caisson_design import suction_installation as installation
from caisson_design.houlsby_byrne import STILL, UNDISTURBED
from caisson_design.method import Forces

RAISED = 1.5  # K tan(delta) over that of undisturbed ground, beyond which a wall grips
UNDISTURBED_IS = (
    f"{UNDISTURBED}: K0 tan \N{GREEK SMALL LETTER DELTA} without stress enhancement, a"
    " lower bound"
)
NOTHING: dict[str, Any] = {"tables": [], "why": "", "reasons": [], "notes": []}


def text_of(value: float) -> str:
    """Return three digits, more before the point."""
    if not math.isfinite(value):
        return ""
    if abs(value) >= 100:
        return f"{value:.0f}"
    return f"{value:.3g}"


def ratio_in_words(computed: float, low: float, high: float) -> str:
    """Return computed over method, from that of the upper to that of the lower case;
    an end is open where the method has 0 or no answer."""
    if not computed > 0:
        return ""
    least = computed / high if math.isfinite(high) and high > 0 else None
    most = computed / low if low > 0 else None
    ends = [
        f"{end:.2f}" if end < 10 else f"{end:.0f}"
        for end in (least, most)
        if end is not None
    ]
    if least is None or most is None:
        words = "at least " if most is None else "at most "
        return words + ends[0] if ends else ""
    return " to ".join(dict.fromkeys(ends))


def ratios(computed: np.ndarray, low: np.ndarray, high: np.ndarray) -> list[str]:
    """Return ratio_in_words() of each row."""
    return [ratio_in_words(*map(float, row)) for row in zip(computed, low, high)]


def table(title: str, columns: dict[str, Any]) -> dict[str, Any]:
    """Return title, heads and rows of columns of numbers or words [n]."""
    texts = [
        [cell if isinstance(cell, str) else text_of(float(cell)) for cell in values]
        for values in columns.values()
    ]
    return {
        "title": title,
        "heads": list(columns),
        "rows": [list(row) for row in zip(*texts)],
    }


def forces_beside(
    computed: np.ndarray | None, at: np.ndarray, answers: list[theory.Answer]
) -> dict[str, Any]:
    """Return the table of the total force (kN); computed: of a run without suction."""
    columns: dict[str, Any] = {"depth (m)": at}
    if computed is not None:
        columns["computed"] = computed
    for answer in answers:
        for case, forces in answer.forces.items():
            columns[f"{answer.name}, {case}"] = forces["total"] / 1e3
        if answer.forces and computed is not None:
            low, high = [force / 1e3 for force in answer.band("total")]
            name = f"computed / {answer.name}"
            columns[name] = ratios(computed, low, high)
    title = "Force of jacking (kN)" if computed is None else "Total force (kN)"
    return table(title, columns)


def required_at(run: Results, at: np.ndarray) -> np.ndarray:
    """Return the required suction of a run (Pa), means over 0.2 m as all numbers of a
    report, [n]."""
    depth = run.history["penetration_m"]
    rows = curves.way_down(depth)
    return curves.smoothed_at(depth[rows], run.history[design.SUCTION][rows], at)


def suctions_beside(run: Results, at: np.ndarray, site: theory.Site) -> dict[str, Any]:
    """Return the table of required and critical suctions (kPa)."""
    computed = np.maximum(required_at(run, at), 0) / 1e3
    answers = suction_methods.answers_of(site, at)
    found, senders = answers.suctions, answers.senders_randolph
    columns: dict[str, Any] = {"depth (m)": at, "computed": computed}
    byrne = "Houlsby & Byrne (2005)"
    for name, cases in (
        (byrne, suction_methods.CASES),
        (
            senders,
            {suction_methods.CONE_LOW: "low", suction_methods.CONE_HIGH: "high"},
        ),
    ):
        kilopascals = [found[c] / 1e3 for c in cases if c in found]
        if not any(np.isfinite(values).any() for values in kilopascals):
            continue
        for case, values in zip(cases.values(), kilopascals):
            columns[f"required, {name}, {case}"] = values
        low, high = kilopascals[:2]
        columns[f"computed / {name}"] = ratios(computed, low, high)
    for name, column in (
        (byrne, suction_methods.PIPING),
        (
            suction_methods.SENDERS_RANDOLPH,
            suction_methods.CRITICAL_SENDERS_RANDOLPH,
        ),
    ):
        if column in found:
            columns[f"critical, {name}"] = found[column] / 1e3
    return table("Required and critical suction (kPa)", columns)


# ------------------------------------------------------------------ why


class Compared(NamedTuple):
    """A run beside Houlsby & Byrne at one depth; the method's forces are those under
    the suction of the run."""

    h: float  # m
    suction: float  # of the run (Pa), 0 where it is jacked
    ratio: str  # computed over method: of the suction, or of the force of jacking
    computed: Forces
    low: Forces
    high: Forces
    enhanced: bool  # whether the method has stress enhancement
    k_tan_delta: float  # of the outer wall in the run
    undisturbed: float  # the same of undisturbed ground


def compared(run: Results, h: float) -> Compared | None:
    """Return the run beside Houlsby & Byrne at a depth, None where the method has no
    answer there or the run lacks a force."""
    site, at = theory.site_of(run), np.array([h])
    known = design.forces_at(run.history, at)
    try:
        byrne = theory.houlsby_byrne_of(site, h)
    except theory.NotApplicable:
        return None
    if set(known) != set(design.FORCES):
        return None
    computed = Forces(*(float(known[name][0]) for name in design.FORCES[:3]))
    suction, flow, mine = 0.0, STILL, computed.total
    ends = [byrne.forces(h, case).total for case in byrne.cases]
    caisson, _ = byrne.by_name[UNDISTURBED]
    if design.SUCTION in run.history:
        suction = mine = float(required_at(run, at)[0])
        found = suction_methods.answers_of(site, at).suctions
        ends = [float(found[name][0]) for name in suction_methods.RANGE if found]
        flow = installation.seepage(
            caisson, max(suction, 0.0), h, byrne.permeability_ratio
        )
    ratio = ratio_in_words(mine, *ends) if ends else ""
    if not ratio:
        return None
    low, high = (byrne.forces_under(flow, h, case) for case in byrne.cases)
    frictions = computed.outer_friction, caisson.outer_friction(h, False, flow)
    walls = (caisson.k_tan_delta_of(friction, h, flow) for friction in frictions)
    enhanced = byrne.by_name["low"].enhanced
    return Compared(h, suction, ratio, computed, low, high, enhanced, *walls)


def beside(computed: float, low: float, high: float, mark: str = "") -> str:
    """Return a force of the run in kN, and that of the method in brackets."""
    ends = [text_of(end / 1e3) for end in (low, high)]
    return f"{text_of(computed / 1e3)} kN ({mark}{' to '.join(dict.fromkeys(ends))})"


def cause_of_tip(found: Compared) -> str:
    """Return why the tip force is not that of the method; nothing within its range."""
    if found.low.tip <= found.computed.tip <= found.high.tip:
        return ""
    if found.computed.tip < found.low.tip:
        cause = "the stress enhancement of the method grows exponentially with depth"
        return f", because {cause}," if found.enhanced else ""
    if found.suction > 0:
        return (
            ", because the method counts only the stress of the plug, which the flow"
            " takes away, and no strength of the sand beside the wall,"
        )
    return (
        ", because a footing at the surface leaves out the strength of the sand beside"
        " the wall,"
    )


def state_of_walls(found: Compared) -> str:
    """Return what the friction on the outer wall says of the stress on it."""
    k, k0 = found.k_tan_delta, found.undisturbed
    if not (math.isfinite(k) and k0 > 0):
        return ""
    name = "K tan \N{GREEK SMALL LETTER DELTA}"
    if k > RAISED * k0:
        return (
            f"; the sand that the wall has pushed aside has raised {name} outside from"
            f" {k0:.2f} in undisturbed ground to {k:.2f}"
        )
    return (
        f"; the walls do not grip yet, and {name} outside is {k:.2f}, where undisturbed"
        f" ground has {k0:.2f}"
    )


def why_of(run: Results, at: np.ndarray) -> str:
    """Return a sentence on where the run is beside Houlsby & Byrne, and why, at the
    deepest of depths [n] (m) with an answer; nothing without one."""
    answers = (compared(run, float(h)) for h in at[::-1])
    found = next((answer for answer in answers if answer), None)
    if found is None:
        return ""
    by_part = zip(found.computed, found.low, found.high)
    tip, inner, outer = (
        beside(*forces, mark) for forces, mark in zip(by_part, ("method: ", "", ""))
    )
    what = "force"
    if found.suction > 0:
        what = "suction"
        tip += f" under its suction of {text_of(found.suction / 1e3)} kPa"
    return (
        f"At {found.h:g} m the run has {found.ratio} times the {what} of Houlsby &"
        f" Byrne (2005): its tip bears {tip}{cause_of_tip(found)} and its walls {inner}"
        f" inside and {outer} outside{state_of_walls(found)}."
    )


# ------------------------------------------------------------------ all


def methods_of(run: Results) -> dict[str, Any]:
    """Return the tables of the design methods at each meter, (methods, why they say
    nothing), and sentences on them; nothing for a run without a way down."""
    history = run.history
    if penetration(history) is None or not design.goes_down(history):
        return NOTHING
    rows_down = curves.way_down(history["penetration_m"])
    site = theory.site_of(run)
    at = curves.round_depths(history["penetration_m"][rows_down])
    if not len(at):
        return NOTHING
    answers = theory.answers_of(site, at)
    with_suction, total = design.SUCTION in history, design.FORCES[-1]
    computed = None
    if total in history and not with_suction:
        computed = design.forces_at(history, at)[total] / 1e3
    tables = [suctions_beside(run, at, site)] if with_suction else []
    tables.append(forces_beside(computed, at, answers))
    notes = [theory.about_cone(site, float(at.max()))]
    if answers[0].forces:
        assumed = theory.assumptions_in_words(site.scene)
        notes.insert(0, f"{assumed}; {UNDISTURBED_IS}.")
    return {
        "tables": [table for table in tables if len(table["heads"]) > 2],
        "why": why_of(run, at),
        "reasons": theory.reasons(answers),
        "notes": [note for note in notes if note],
    }
