# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the design methods say about the suction of a run, over depth.

In layers of sand, fits of a critical suction take the mean unit weight down to the tip.
Of the methods from a cone, suction takes what Senders and Randolph say: they give this
for their own forces, and it is ASSUMED for those of the others.
In clay, and in sand and clay, the required suction is what the weight does not bear of
the forces of jacking. While the tip is in sand above the first clay, water flows around
it: piping by Houlsby & Byrne limits the suction, and flow takes from the forces what
Senders & Randolph say, as if the clay were sand (assumed).
"""
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from math import inf, nan, pi
from typing import TypeVar

import numpy as np

from caisson.verdict import theory
from caisson.design import plug_stability
from caisson.design import suction_installation as installation
from caisson.design.clay import Layer
from caisson.design.cone import ConeMethod, Skirt
from caisson.design.houlsby_byrne import UNDISTURBED, HoulsbyByrne
from caisson.design.method import Forces, Method

Of = TypeVar("Of")
WEIGHT = "submerged_weight_N"  # of run.json
HOULSBY_BYRNE = "Houlsby & Byrne (2005)"
LOW, HIGH = "houlsby_byrne_low_Pa", "houlsby_byrne_high_Pa"
LOWER_BOUND = "houlsby_byrne_undisturbed_Pa"
RANGE = (LOW, HIGH)
CASES = dict(zip((*RANGE, LOWER_BOUND), (*HoulsbyByrne.cases, UNDISTURBED)))
BY_CONE = [method for method in theory.METHODS if method.has_suction]
ENDS = ("low", "high")
CRITICAL_SENDERS_RANDOLPH = "critical_senders_randolph_Pa"
PIPING = "critical_houlsby_byrne_Pa"
CONE_COLUMNS = {
    method.key: tuple(f"{method.key}_cone_{end}_Pa" for end in ENDS)
    for method in BY_CONE
}
METHODS = (
    *CASES,
    *(column for columns in CONE_COLUMNS.values() for column in columns),
    CRITICAL_SENDERS_RANDOLPH,
    PIPING,
)


@dataclass(frozen=True)
class Answers:
    """The methods over depth.

    suctions: [n] (Pa) at embedments depth [n] (m) by column of design.csv, nan
    where a method has no answer; rest: the penetration (m) by the weight alone,
    by column, where the weight comes to rest; neither of them, and why not.
    in_clay: the required suctions of ground with clay, and with rest those of its
    method, rest_by.
    """

    depth: np.ndarray
    suctions: dict[str, np.ndarray] = field(default_factory=dict)
    rest: dict[str, float] = field(default_factory=dict)
    why_not: str = ""
    assumed: str = ""  # of the cone resistance: what it rests on
    in_clay: theory.Beside | None = None
    rest_by: str = "Houlsby & Byrne"

    @property
    def required(self) -> list[theory.Beside]:
        """The required suctions of the methods that have any."""
        return [method for method in self.every if method.is_known]

    @property
    def every(self) -> list[theory.Beside]:
        """Those of all methods for suction, nan where none suffices."""
        found = self.suctions
        if not found:
            return [self.in_clay] if self.in_clay else []
        byrne = {case: found[column] for column, case in CASES.items()}
        bound = {UNDISTURBED: byrne.pop(UNDISTURBED)}
        limit = found[CRITICAL_SENDERS_RANDOLPH]
        mark = theory.ASSUMED_CONE if self.assumed else ""
        every = [
            theory.Beside(HOULSBY_BYRNE, byrne, bound, found[PIPING], may_end=True)
        ]
        for method in BY_CONE:
            cases = dict(zip(ENDS, map(found.__getitem__, CONE_COLUMNS[method.key])))
            every.append(theory.Beside(method.name + mark, cases, {}, limit))
        return every


def weight_of(scene: theory.Scene) -> float:
    """Return the submerged weight of the caisson in N. Raises NotApplicable."""
    if scene.get(WEIGHT) is None:
        raise theory.NotApplicable(f"run.json has no {WEIGHT}")
    return float(scene[WEIGHT])


def by_byrne(
    byrne: HoulsbyByrne, column: str, weight: float, h: float, unsteady: float = 0.0
) -> float:
    """Return the suction (Pa) that Houlsby & Byrne require in the case of a column at
    an embedment (m), nan where none below piping suffices. unsteady: as of a Site."""
    case = byrne.by_name[CASES[column]]
    missing = max(case.resistance(h) - weight, 0.0)
    plain = missing / installation.plug_area(case)
    if unsteady == 1:
        return plain
    found = installation.required_suction(case, weight, h, byrne.permeability_ratio)
    return found + unsteady * (plain - found)


def suctions_at(
    byrne: HoulsbyByrne,
    cones: Mapping[str, Method],
    weight: float,
    h: float,
    unsteady: float = 0.0,
) -> dict[str, float]:
    """Return the suctions of the methods at an embedment, in Pa. cones: those by cone
    that apply; unsteady: as of a Site."""
    ratio = byrne.permeability_ratio
    caisson = byrne.by_name[UNDISTURBED]
    critical = installation.critical_suction(caisson, h)
    counted = critical / (1 - unsteady) if unsteady < 1 else inf
    loads = weight, installation.plug_area(caisson), counted
    at = weight, h, unsteady
    required = {column: by_byrne(byrne, column, *at) for column in CASES}
    for key, method in cones.items():
        for column, case in zip(CONE_COLUMNS[key], method.cases):
            forces = method.forces(h, case)
            required[column] = installation.relieved_suction(forces, *loads)
    return required | {
        CRITICAL_SENDERS_RANDOLPH: critical,
        PIPING: installation.piping_suction(caisson, h, ratio),
    }


def rests_of(
    method: theory.Description, site: theory.Site, deepest: float
) -> dict[str, float]:
    """Return the penetration by weight (m) in each case of a method, nan where it is
    deeper than deepest."""
    known = theory.of_site(method, site, deepest)
    weight = weight_of(site.scene)
    tops = [theory.top_of(entry) for _, entry in site.layers(deepest)]

    def rest(case: str) -> float:
        def resistance(h: float) -> float:
            return known.forces(h, case).total

        return installation.self_weight_penetration(resistance, weight, deepest, tops)

    return {case: rest(case) for case in method.cases}


def known_layers_of(site: theory.Site, deepest: float) -> list[Layer]:
    """Return the layers of clay and sand as far down as they are known; none where not
    all are known down to a depth (m), or of no caisson."""
    tops = [theory.top_of(entry) for _, entry in site.layers(np.inf)]
    with suppress(theory.NotApplicable):
        theory.skirt_of(site)
        theory.soils_of(site, deepest)
        below = sorted(filter(deepest.__lt__, tops), reverse=True)
        for end in [np.inf, *below, deepest]:
            # far below the tip they may be unknown
            with suppress(theory.NotApplicable):
                return theory.clay_layers_of(site, end)
    return []


def of_plug(
    site: theory.Site,
    depth: np.ndarray,
    of: Callable[[Skirt, list[Layer], np.ndarray], Of],
) -> Of | None:
    """Return what a function of plug_stability says of a plug of clay at embedments [n]
    (m), below a thin cover of clay; None without clay."""
    site, cover = theory.below_cover(site)
    depth = np.maximum(depth - cover, 0.0)
    layers = known_layers_of(site, float(depth.max()))
    return of(theory.skirt_of(site), layers, depth) if layers else None


def plug_limits(site: theory.Site, depth: np.ndarray) -> dict[str, np.ndarray]:
    """Return the suctions (Pa) at which a plug of clay gives way, [n] at embedments
    [n]; none without clay."""
    return of_plug(site, depth, plug_stability.allowable) or {}


def soft_below(site: theory.Site, depth: np.ndarray) -> np.ndarray:
    """Return the top of the soft layer below the tip that governs reverse bearing (m),
    [n] at embedments [n]; nan where the clay at the tip does, or where there is none.
    """
    found = of_plug(site, depth, plug_stability.soft_below)
    cover = theory.below_cover(site)[1]
    return np.full(len(depth), np.nan) if found is None else found + cover


def flow_above_clay(
    site: theory.Site, depth: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return what flow does at embedments [n] (m): s_cr of Senders & Randolph, infinite
    where no water flows, and the suction of piping by Houlsby & Byrne, nan there, [n]
    (Pa). Water flows while the tip is in sand above the first clay. Below a thin cover
    of clay it may, or may not: it pipes, and takes nothing from the forces. Where flow
    is not steady, it takes a share less."""
    critical, piping = np.full(len(depth), inf), np.full(len(depth), nan)
    site, cover = theory.below_cover(site)
    depth = np.maximum(depth - cover, 0.0)
    if end := theory.above_clay(site, float(depth.max())):
        with suppress(theory.NotApplicable):
            byrne = theory.houlsby_byrne_of(site, end)
            caisson, ratio = byrne.by_name[UNDISTURBED], byrne.permeability_ratio
            for i in np.flatnonzero(depth <= end):
                h = float(depth[i])
                if not cover and site.unsteady < 1:
                    found = installation.critical_suction(caisson, h)
                    critical[i] = found / (1 - site.unsteady)
                piping[i] = installation.piping_suction(caisson, h, ratio)
    return critical, piping


def needed_beside_clay(
    forces: Mapping[str, np.ndarray], weight: float, area: float, critical: np.ndarray
) -> np.ndarray:
    """Return the suction [n] (Pa) that bears what the weight (N) does not of the forces
    [n] (N) of the method of clay, nan where no suction up to critical [n] (Pa) does."""
    found = installation.suction_without_flow(forces["total"], weight, area)
    parts = [forces[part] for part in theory.PARTS[:3]]
    for i in np.flatnonzero(np.isfinite(critical)):
        at = Forces(*(float(part[i]) for part in parts))
        found[i] = installation.relieved_suction(at, weight, area, float(critical[i]))
    return found


def needed_by(site: theory.Site, answer: theory.Answer) -> dict[str, np.ndarray]:
    """Return the required suctions [n] (Pa) of a method in ground with clay, by its
    cases; none of one without an answer, or without a weight."""
    if not answer.forces or site.scene.get(WEIGHT) is None:
        return {}
    critical, _ = flow_above_clay(site, answer.depth)
    weight = weight_of(site.scene)
    area = pi / 4 * theory.skirt_of(site).inner_diameter ** 2
    return {
        case: needed_beside_clay(answer.forces[case], weight, area, critical)
        for case in answer.total.cases
    }


def in_clay(site: theory.Site, depth: np.ndarray, why_not: str) -> Answers:
    """Return what the method of clay says at embedments [n]. why_not: of the others."""
    answer = theory.answer_of(theory.OF_CLAY, site, depth)
    if not (needed := needed_by(site, answer)):
        return Answers(depth, why_not=why_not)
    rests = rests_of(theory.OF_CLAY, site, float(depth.max()))
    return Answers(
        depth,
        rest={case: h for case, h in rests.items() if np.isfinite(h)},
        why_not=why_not,
        assumed=answer.assumed,
        in_clay=theory.Beside(answer.name, needed),
        rest_by=answer.method.name,
    )


def limits_at(
    site: theory.Site, depth: np.ndarray
) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Return what flow does, as flow_above_clay() has it, and the suctions at which a
    plug of clay gives way, [n] (Pa) at embedments [n] (m): what answers_of() has of
    them, in less time."""
    critical, piping = flow_above_clay(site, depth)
    is_all = np.isfinite(piping).all()
    return critical, piping, {} if is_all else plug_limits(site, depth)


def answers_of(site: theory.Site, depth: np.ndarray) -> Answers:
    """Return what the methods say at embedments [n]."""
    deepest = float(depth.max())
    try:
        byrne, weight = theory.houlsby_byrne_of(site, deepest), weight_of(site.scene)
    except theory.NotApplicable as reason:
        return in_clay(site, depth, str(reason))
    cones = dict[str, Method]()
    for method in BY_CONE:
        with suppress(theory.NotApplicable):
            cones[method.key] = method.of_site(site, deepest)
    known = byrne, cones, weight
    rows = [suctions_at(*known, float(h), site.unsteady) for h in depth]
    suctions = {x: np.array([row.get(x, nan) for row in rows]) for x in METHODS}
    profiles = [x.profile for x in cones.values() if isinstance(x, ConeMethod)]
    assumed = profiles[0].assumed if profiles else ""
    rests = rests_of(theory.METHODS[0], site, deepest)
    rest = {x: rests[CASES[x]] for x in RANGE if np.isfinite(rests[CASES[x]])}
    return Answers(depth, suctions, rest, assumed=assumed)
