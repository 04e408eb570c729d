# SPDX-License-Identifier: LGPL-2.1-or-later
"""Why a computed resistance is not that of a design method, in sentences for a report.

Forces are N, suctions Pa, depths m. A method has a lower and an upper case. What a run
has beyond a factor of LIKE of both cases needs a reason.
"""
import math
from typing import NamedTuple

from caisson.design.method import Forces
from caisson.shown import units_for
from caisson.table import text_of

LIKE = (0.8, 1.25)  # computed over method; within it nobody asks why
RAISED = 1.5  # K tan(delta) over that of undisturbed ground, beyond which a wall grips
K_TAN = "K tan \N{GREEK SMALL LETTER DELTA}"


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


def is_beyond(computed: float, low: float, high: float) -> bool:
    """Return whether computed over method is beyond LIKE in both cases. A method may
    have 0 (no suction is needed), or nan in its upper case (none suffices)."""
    if not computed > 0 or math.isnan(low):
        return False
    most = computed / low if low > 0 else math.inf
    least = computed / high if high > 0 else (0.0 if math.isnan(high) else math.inf)
    return least > LIKE[1] or most < LIKE[0]


def head(h: float, ends: tuple[float, float, float], what: str, name: str) -> str:
    """Return the beginning of a sentence. ends: computed, and both cases."""
    ratio = ratio_in_words(*ends)
    if not ratio:
        return f"At {depth_of(h)} the run needs a suction, and {name} needs none:"
    return f"At {depth_of(h)} the run has {ratio} times the {what} of {name}:"


# ------------------------------------------------------- Houlsby & Byrne


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


def depth_of(h: float) -> str:
    """Return a depth (m) in words."""
    return units_for(math.inf, math.inf, h).length(float(f"{h:.6g}"))


def beside(computed: float, low: float, high: float, mark: str = "") -> str:
    """Return a force of the run, and that of the method in brackets."""
    largest = max(filter(math.isfinite, (computed, low, high)))
    shown = units_for(largest, math.inf, math.inf)
    factor = shown.factor("kN") / 1e3
    ends = [text_of(factor * end) for end in (low, high)]
    value = f"{text_of(factor * computed)} {shown.name('kN')}"
    return f"{value} ({mark}{' to '.join(dict.fromkeys(ends))})"


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
    if k > RAISED * k0:
        return (
            f"; the sand that the wall has pushed aside has raised {K_TAN} outside from"
            f" {k0:.2f} in undisturbed ground to {k:.2f}"
        )
    return (
        f"; the walls do not grip yet, and {K_TAN} outside is {k:.2f}, where"
        f" undisturbed ground has {k0:.2f}"
    )


def of_houlsby_byrne(found: Compared) -> str:
    """Return where a run is beside the method, and why."""
    by_part = zip(found.computed, found.low, found.high)
    tip, inner, outer = (
        beside(*forces, mark) for forces, mark in zip(by_part, ("method: ", "", ""))
    )
    what = "force"
    if found.suction > 0:
        what = "suction"
        tip += f" under its suction of {text_of(found.suction / 1e3)} kPa"
    return (
        f"At {depth_of(found.h)} the run has {found.ratio} times the {what}"
        f" of Houlsby & Byrne (2005): its tip bears {tip}{cause_of_tip(found)} and its"
        f" walls {inner} inside and {outer} outside{state_of_walls(found)}."
    )


def of_undisturbed(h: float, computed: float, bound: float, what: str) -> str:
    """Return why a run is not at the bound of Houlsby & Byrne; what: force or suction.
    Nothing where it is."""
    if not is_beyond(computed, bound, bound):
        return ""
    name = f"undisturbed ground (K0 {K_TAN[2:]})"
    return (
        f"{head(h, (computed, bound, bound), what, name)} no installation has"
        " confirmed this lower bound. It leaves out that the wall pushes sand"
        " aside, which raises the stress on it up to the passive limit, and that the"
        " friction of the walls adds to the stress at the tip."
    )


# ------------------------------------------------------------- from a cone


ASSUMED_CONE = (
    "The methods from a cone were fitted to measured resistances of dense sand; here"
    " the resistance is ASSUMED, and a cone test may change these ratios"
    " considerably."
)


class ByCone(NamedTuple):
    """A run beside a method from a cone at one depth; with suction the method's forces
    are those under the suction of the run."""

    name: str
    h: float  # m
    what: str  # force or suction
    ends: tuple[float, float, float]  # computed, low, high: of what is compared
    computed: Forces
    low: Forces
    high: Forces
    relief: float | None  # 1 - s / s_cr of the run, None where it is jacked


class Walls(NamedTuple):
    """Horizontal over vertical stress at rest on the walls of a run, means over them,
    and its ends in the layers that the skirt reaches."""

    inner: float
    outer: float
    at_rest: tuple[float, float]  # K0
    passive: tuple[float, float]  # Rankine, of a smooth wall


AT_TIP = "most of the difference is at the tip"
AT_WALLS = "most of the difference is at the walls"


def cause_by_cone(found: ByCone) -> str:
    """Return which part makes most of the difference."""
    above = found.ends[0] > max(found.ends[1:])
    side = found.high if above else found.low
    tip = abs(found.computed.tip - side.tip)
    inner = abs(found.computed.inner_friction - side.inner_friction)
    walls = inner + abs(found.computed.outer_friction - side.outer_friction)
    if tip >= walls and found.relief is not None:
        return (
            "the method leaves the tip 1 - s/s_cr ="
            f" {max(found.relief, 0):.2f} of its force, and the run does not follow it"
        )
    if tip >= walls:
        return AT_TIP
    return AT_WALLS if above else f"{AT_WALLS}, which do not grip yet in the run"


def of_cause(cause: str, h: float, walls: Walls | None) -> str:
    """Return why a part is not like in methods from a cone, once for all of them;
    nothing where its cause says all."""
    if cause == AT_TIP:
        return "The methods give the tip a fixed share of the cone resistance."
    if cause != AT_WALLS:
        return ""
    little = "the methods give the walls a small share of the cone resistance"
    if walls is None:
        return (
            "The walls have pushed sand aside, which raises the stress on them;"
            f" {little}."
        )
    at_rest, passive = (
        " to ".join(
            dict.fromkeys(f"{end:.2f}" if end < 1 else f"{end:.1f}" for end in ends)
        )
        for ends in (walls.at_rest, walls.passive)
    )
    return (
        f"At {depth_of(h)} the mean K on the walls is {walls.outer:.1f} outside and"
        f" {walls.inner:.1f} inside; at rest it is {at_rest}, and at the passive limit"
        f" {passive}; {little}."
    )


def of_cone(found: ByCone) -> str:
    """Return why a run is not like a method from a cone; nothing where it is."""
    if not is_beyond(*found.ends):
        return ""
    by_part = zip(found.computed, found.low, found.high)
    tip, inner, outer = (
        beside(*forces, mark) for forces, mark in zip(by_part, ("method: ", "", ""))
    )
    return (
        f"{head(found.h, found.ends, found.what, found.name)} its tip bears {tip}, its"
        f" walls {inner} inside and {outer} outside;"
        f" {cause_by_cone(found)}."
    )


# ---------------------------------------------------------- under suction


def relieved(jacking: Forces, relief: float) -> Forces:
    """Return forces under suction by Senders & Randolph. relief: 1 - s / s_cr."""
    left = min(max(relief, 0.0), 1.0)
    tip, inner = jacking.tip * left, jacking.inner_friction * left
    return Forces(tip, inner, jacking.outer_friction)
