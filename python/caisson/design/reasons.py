# SPDX-License-Identifier: LGPL-2.1-or-later
"""Why a computed resistance is not that of a design method, in sentences for a report.

Forces are N, suctions Pa, depths m. A method has a lower and an upper case. What a run
has beyond a factor of LIKE of both cases needs a reason.
"""
import math
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import NamedTuple

from caisson import template
from caisson.design.method import Forces
from caisson.shown import units_for
from caisson.table import text_of

LIKE = (0.8, 1.25)  # computed over method; within it nobody asks why
RAISED = 1.5  # K tan(delta) over that of undisturbed ground, beyond which a wall grips
say = partial(template.say, Path(__file__).with_name("reasons.jinja"))


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


def depth_of(h: float) -> str:
    """Return a depth (m) in words."""
    return units_for(math.inf, math.inf, h).length(float(f"{h:.6g}"))


class Compared(NamedTuple):
    """A run beside a method at one depth; with suction the method's forces are those
    under the suction of the run."""

    name: str
    h: float  # m
    what: str  # force or suction
    ends: tuple[float, float, float]  # computed, low, high: of what is compared
    computed: Forces
    low: Forces
    high: Forces
    relief: float | None = None  # 1 - s / s_cr of the run, None where it is jacked

    @property
    def parts(self) -> Iterator[str]:
        """Each force of the run, with those of the method in brackets."""
        for i, forces in enumerate(zip(self.computed, self.low, self.high)):
            shown = units_for(max(filter(math.isfinite, forces)), math.inf, math.inf)
            texts = [text_of(shown.factor("kN") / 1e3 * force) for force in forces]
            ends = " to ".join(dict.fromkeys(texts[1:]))
            mark = "method: " if i == 0 else ""
            yield f"{texts[0]} {shown.name('kN')} ({mark}{ends})"

    @property
    def head(self) -> str:
        """The beginning of a sentence."""
        what = ratio_in_words(*self.ends), self.what, self.name
        return say("head", depth_of(self.h), *what)

    @property
    def cause(self) -> str:
        """Which part makes most of the difference: "tip", what "relief" leaves of it,
        "walls" or, where they bear less than by the method, "loose" ones."""
        above = self.ends[0] > max(self.ends[1:])
        side = self.high if above else self.low
        tip, *walls = (abs(a - b) for a, b in zip(self.computed, side))
        if tip >= sum(walls):
            return "tip" if self.relief is None else "relief"
        return "walls" if above else "loose"


def of_houlsby_byrne(
    found: Compared, suction: float, enhanced: bool, walls: tuple[float, float]
) -> str:
    """Return where a run is beside the method, and why. suction: of the run (Pa), 0
    where it is jacked; enhanced: whether the method has stress enhancement; walls: K
    tan(delta) outside in the run and in undisturbed ground."""
    where = depth_of(found.h), ratio_in_words(*found.ends), found, *found.parts
    return say("byrne", *where, suction, enhanced, *walls, RAISED)


def of_undisturbed(h: float, computed: float, bound: float, what: str) -> str:
    """Return why a run is not at the bound of Houlsby & Byrne; what: force or suction.
    Nothing where it is."""
    name = "undisturbed ground (K0 tan \N{GREEK SMALL LETTER DELTA})"
    none = Forces(0.0, 0.0, 0.0)
    found = Compared(name, h, what, (computed, bound, bound), none, none, none)
    return say("undisturbed", found.head) if is_beyond(*found.ends) else ""


class Walls(NamedTuple):
    """Horizontal over vertical stress at rest on the walls of a run, means over them,
    and its ends in the layers that the skirt reaches."""

    inner: float
    outer: float
    at_rest: tuple[float, float]  # K0
    passive: tuple[float, float]  # Rankine, of a smooth wall


def of_cause(cause: str, h: float, walls: Walls | None) -> str:
    """Return why a part is not like in methods from a cone, once for all of them;
    nothing where its cause says all."""
    ends = [
        " to ".join(dict.fromkeys(f"{k:.2f}" if k < 1 else f"{k:.1f}" for k in some))
        for some in (walls[2:] if walls else ((), ()))
    ]
    return say("of_cause", cause, depth_of(h), walls, *ends)


def of_cone(found: Compared) -> str:
    """Return why a run is not like a method from a cone; nothing where it is."""
    if not is_beyond(*found.ends):
        return ""
    left = f"{max(found.relief or 0, 0):.2f}"
    return say("by_cone", found.head, *found.parts, found.cause, left)


def relieved(jacking: Forces, relief: float) -> Forces:
    """Return forces under suction by Senders & Randolph. relief: 1 - s / s_cr."""
    left = min(max(relief, 0.0), 1.0)
    tip, inner = jacking.tip * left, jacking.inner_friction * left
    return Forces(tip, inner, jacking.outer_friction)
