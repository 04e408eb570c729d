# SPDX-License-Identifier: LGPL-2.1-or-later
"""Installation of a caisson by suction: how much suction it takes, in layers of sand.

Under its effective weight V' the caisson comes to rest where its resistance is V'.
From there on, suction s beneath the lid pulls it down:

    V' + s A_i = F_o + F_i + Q,    A_i = pi D_i^2 / 4,

with the friction F on both walls and the force Q on the tip. Two methods say how
suction changes these forces:

    Houlsby and Byrne (2005), doi:10.1680/geng.2005.158.3.135: the forces are those
    of jacking, but flow changes the unit weight by a s / h outside and by
    -(1 - a) s / h inside and at the tip.
    Senders and Randolph (2009), J. Geotech. Geoenviron. Eng. 135(1): F_o is that of
    jacking, and F_i and Q decrease in proportion to 1 - s / s_cr. They take the
    forces of jacking from a cone test (senders_randolph).

The formulas are those of one unit weight. With several layers the gradient is the
same in all of them, and s_cr follows from the mean unit weight down to the tip.
Houlsby and Byrne's limit is then reached, on the safe side, when the lightest layer
down to the tip has no weight left inside; or, if that is earlier, when the water lifts
all layers above the base of one: the head that is lost inside is shared among the
layers as d / k by their thickness d and permeability k. The forces take one
permeability. The pressure of the water on the end of the wall is left out.

Ground at or a distance z below the tip that is n times as permeable as the plug, whose
permeability is h over the sum of d / k, feeds the plug, so that more of the head is
lost inside. Where z is 0 the share a is that of Houlsby and Byrne for a plug with 1 / n
of the permeability of the ground; of what that takes from a, exp(-z / 0.3 D) is left.
What lies between counts with the thickness that has its d / k in the ground at the tip,
if this is more (custom: 0 to 0.15 below own finite differences, whose mean over the
base of the plug is 0.04 where sand stands 0.1 m over gravel a hundred times as
permeable).

Through clay hardly any water flows, so that suction leaves the forces as they are.

SI units; h is the embedment of the tip (m), forces are N, suctions are Pa.
"""
from collections.abc import Callable, Iterable
from math import exp, inf, nan, pi

import numpy as np
from scipy.optimize import brentq

from caisson.design.houlsby_byrne import Caisson, Seepage
from caisson.design.method import Forces, vertical_stress
from caisson.design.seepage import pressure_factor, senders_randolph


AT_TOP = 1e-5  # m, below the top of a layer on which a tip rests
REACH = 0.3  # of the diameter, over which permeable ground below the tip counts
ROUNDS = 40  # of a bisection, which leave 1e-12 of a depth
PARTS = (*np.linspace(0, 1, 25)[1:-1], 1 - 1e-6, 1)  # of a layer, asked one by one


def bisect(
    is_beyond: Callable[[float], bool], low: float, high: float, rounds: int = 100
) -> tuple[float, float]:
    """Return the ends between which is_beyond turns from False, at low, to True."""
    for _ in range(rounds):
        middle = (low + high) / 2
        low, high = (low, middle) if is_beyond(middle) else (middle, high)
    return low, high


def plug_area(caisson: Caisson) -> float:
    """Return the area that suction acts on (m2)."""
    return pi * caisson.inner.diameter**2 / 4


def suction_without_flow(
    resistance: np.ndarray, weight: float, area: float
) -> np.ndarray:
    """Return the suction that bears what the weight does not, [n] (Pa), where no water
    flows: (R - V') / A_i, at least 0. resistance: [n] (N)."""
    return np.maximum(resistance - weight, 0.0) / area


def self_weight_penetration(
    resistance: Callable[[float], float],
    weight: float,
    deepest: float,
    tops: Iterable[float] = (),
) -> float:
    """Return the embedment at which a caisson first stands without suction; nan where
    it sinks in deeper than deepest (m).

    resistance: by the embedment (N); weight: effective, V'; tops: of the layers (m),
    from the mudline down. The resistance may fall from layer to layer, and near the
    bottom of one, so that each is asked at some depths and just above its bottom.
    """

    def stands(h: float) -> bool:
        return resistance(h) >= weight

    if stands(0):
        return 0.0
    above = top = 0.0
    for bottom in [*(x for x in tops if 0 < x < deepest), deepest]:
        for part in PARTS:
            below = top + part * (bottom - top)
            if stands(below):
                found = bisect(stands, above, below, ROUNDS)[1]
                return top if 0 < top and found - top < AT_TOP else found
            above = below
        top = bottom
    return nan


def seepage(
    caisson: Caisson, suction: float, h: float, permeability_ratio: float = 1.0
) -> Seepage:
    """Return what the flow under this suction adds to the unit weights."""
    a = pressure_factor(h / caisson.outer_diameter, permeability_ratio)
    return Seepage(outer=a * suction / h, inner=-(1 - a) * suction / h)


def share_at_tip(caisson: Caisson, h: float, permeability_ratio: float = 1.0) -> float:
    """Return a, the pressure at the tip over the suction, with permeable ground below.
    permeability_ratio: of the sand inside to that outside."""
    share = pressure_factor(h / caisson.outer_diameter, permeability_ratio)
    pieces = caisson.pieces(h)
    layers = [(x.top, x.permeability) for x in caisson.layers] + [*caisson.below]
    if not pieces or not all(layer.permeability for layer, _ in pieces):
        return share
    plug = h / sum(d / layer.permeability for layer, d in pieces)
    at_tip, below = pieces[-1][0].permeability, layers[len(pieces) - 1 :]
    ends = [max(top - h, 0.0) for top, _ in below[1:]]
    found, above, distance = share, 0.0, 0.0
    for (_, permeability), end in zip(below, [*ends, inf]):
        ratio = permeability_ratio * min(plug / permeability, 1.0)
        least = pressure_factor(h / caisson.outer_diameter, ratio)
        left = exp(-distance / (REACH * caisson.outer_diameter))
        found = min(found, share + (least - share) * left)
        # ground that is less permeable than that at the tip is as if it were thicker
        distance += (end - above) * max(at_tip / permeability, 1.0)
        above = end
    return found


def piping_suction(
    caisson: Caisson, h: float, permeability_ratio: float = 1.0
) -> float:
    """Return the suction at which a layer inside has lost its weight, or the water
    lifts those above the base of one, beyond which the equations of Houlsby and Byrne
    do not hold."""
    if not (pieces := caisson.pieces(h)):
        return 0.0
    rows = [(layer.unit_weight, d, layer.permeability) for layer, d in pieces]
    unit_weights, thicknesses, permeabilities = np.array(rows).T
    if not permeabilities.all():  # as if it were one
        permeabilities = np.ones(len(rows))
    weight = np.cumsum(unit_weights * thicknesses)
    loss = np.cumsum(thicknesses / permeabilities)
    lifted = weight * loss[-1] / (loss * h)  # as a unit weight
    least = float(min(unit_weights.min(), lifted.min()))
    return least * h / (1 - share_at_tip(caisson, h, permeability_ratio))


def required_suction(
    caisson: Caisson, weight: float, h: float, permeability_ratio: float = 1.0
) -> float:
    """Return the suction by Houlsby and Byrne that moves the tip on at h.

    It is 0 where the weight suffices, and nan where no suction up to piping does.
    The resistance less the pull is a concave function of the suction up to piping,
    so that its sign at piping shows which is the case, and the root is the only
    one. permeability_ratio: of the sand inside to that outside.
    """
    if caisson.resistance(h) <= weight:
        return 0.0
    area = plug_area(caisson)

    def missing(suction: float) -> float:
        flow = seepage(caisson, suction, h, permeability_ratio)
        return caisson.resistance(h, flow) - weight - suction * area

    most = piping_suction(caisson, h, permeability_ratio)
    if h <= 0 or not missing(most) <= 0:
        return nan
    return float(brentq(missing, 0.0, most, xtol=1e-9, rtol=1e-14))


def mean_unit_weight(caisson: Caisson, h: float) -> float:
    """Return the mean effective unit weight down to h, 0 at the surface."""
    return vertical_stress(caisson.layers, h) / h if h > 0 else 0.0


def critical_suction(caisson: Caisson, h: float) -> float:
    """Return s_cr of Senders and Randolph."""
    return senders_randolph(mean_unit_weight(caisson, h), h, caisson.outer_diameter)


def relieved_suction(
    jacking: Forces, weight: float, area: float, critical: float
) -> float:
    """Return the suction by Senders and Randolph that moves the tip on.

    jacking: the forces without suction; area: that suction acts on (m2); critical:
    s_cr. It is 0 where the weight suffices, and nan where no suction up to s_cr does.
    """
    missing = jacking.total - weight
    if missing <= 0:
        return 0.0
    relieved = jacking.inner_friction + jacking.tip
    loss = relieved / critical if critical > 0 else inf
    suction = missing / (area + loss)
    return suction if 0 < suction <= critical else nan
