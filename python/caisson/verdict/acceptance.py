# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a certifier asks of an installation by suction beside its verdict: the seal, the
grout, a reserve for scour, the levelness of several buckets, the load case of a shell
model, and when the vessel stops. Each is None where a run does not have it.

Depths are in m, suctions and pressures in kPa, forces in kN. Entries of section Design
that are 0 or empty are not given.
"""
from math import nan
from typing import NamedTuple

import numpy as np

from caisson.band import BEST, band_of
from caisson.design import buckets, retrieval, sealing, shell
from caisson.design.houlsby_byrne import UNDISTURBED
from caisson.design.suction_installation import share_at_tip
from caisson.evaluation import DEPTH, SUCTION, at_depths, rest_of
from caisson.results import Results, Table
from caisson.verdict import disturbed, limits, suction_methods, theory
from caisson.verdict import retrieval as overpressures
from caisson.verdict.installation import NOTHING, Installation, plug_area

START, SCOUR, TILT = "Suction at the start", "Scour depth", "Largest tilt"
NUMBER, DISTANCE = "Number of buckets", "Distance of buckets"
SPREAD, DOCUMENT = "Spread of buckets", "Source of factors"
ENTRIES = START, SCOUR, TILT, NUMBER, DISTANCE, SPREAD, DOCUMENT  # of section Design
ROWS = 80  # of a grid of depths
# shares of the embedment, at which a load is given
DOWN = {"mudline": 0.0, "1/4": 0.25, "1/2": 0.5, "3/4": 0.75, "tip": 1.0}
MORE_HEAVE = 2.0  # times the expected one, at which the vessel stops
FURTHER = 3.0  # times the penetration by weight, to which a seal is looked for


def given(run: Results, name: str) -> float:
    """Return an entry of section Design; 0 where it is not given."""
    return float(run.entry(f"Design/{name}") or 0)


def factor_of(run: Results, depth: float) -> float:
    """Return a, the pressure at the tip over the suction, by Houlsby & Byrne. Raises
    NotApplicable."""
    site, cover = theory.below_cover(theory.site_of(run))
    depth = depth - cover
    byrne = theory.houlsby_byrne_of(site, depth)
    caisson = byrne.by_name[UNDISTURBED]
    return share_at_tip(caisson, depth, byrne.permeability_ratio)


class Seal(NamedTuple):
    """Where the caisson rests by its weight: the first suction that the seal allows by
    its factor, the one that is applied (0 if it is not given), the exit gradient under
    it, or else under the one that is allowed, the critical one, and the least embedment
    for it, nan where it is not known; the way of the water along both walls; and where
    it rests with high resistance, with what is allowed there, nan without that. Where
    it rests in clay, it is that of high resistance, which rests in sand."""

    rest: float
    allowed: float
    applied: float
    gradient: float
    critical: float
    least: float
    path: float
    shallow: tuple[float, float]
    of_high: bool


def least_rest(run: Results, rest: float) -> float:
    """Return the least penetration by weight (m) of a run, which is known, and of low
    and high resistance."""
    rests = map(rest_of, band_of(run).values())
    return min([rest, *(h for h in rests if h is not None)])


def seal_of(run: Results, found: Installation) -> Seal | None:
    """Return the seal in sand by Houlsby & Byrne."""
    if not (rest := found.rest):
        return None
    site, shallow = theory.site_of(run), least_rest(run, rest)
    if not theory.flows_to(site, rest) >= rest:  # in clay, but high resistance in sand
        rest = shallow
    end = min(FURTHER * rest, float(found.depth[-1]))
    depth = np.union1d(np.linspace(end / ROWS, end, ROWS), [rest, shallow])
    _, piping, _ = suction_methods.limits_at(site, depth)
    at_rest = depth == rest
    if rest <= theory.below_cover(site)[1] or not np.isfinite(piping[at_rest]).all():
        return None
    allowed, applied = piping / found.factors[limits.PIPING], given(run, START)
    suction = applied or float(allowed[at_rest][0])
    a, embedment = factor_of(run, rest), rest - theory.below_cover(site)[1]
    gradient = sealing.exit_gradient(suction, embedment, a)
    critical = gradient * float(piping[at_rest][0]) / suction
    least = sealing.least_embedment(depth, allowed, applied) if applied else nan
    parts = float(allowed[at_rest][0]) / 1e3, applied / 1e3, gradient, critical, least
    high = nan, nan
    if shallow < rest:
        high = shallow, float(allowed[depth == shallow][0]) / 1e3
    return Seal(rest, *parts, 2 * embedment, high, rest < found.rest)


class Grout(NamedTuple):
    """The space beneath the lid at a depth: its volume (m3), mean, least and largest
    gap, the tilt of the lid (degrees, 0 if it is not given), and the excess pressures
    at which something gives way, each by its factor, from the least one on."""

    depth: float
    volume: float
    gap: float
    ends: tuple[float, float]
    tilt: float
    pressures: dict[str, float]


LIFTED = "the caisson is lifted"
GROUT_FACTORS = {
    retrieval.OUTWARD: limits.PIPING,
    retrieval.PLUG: limits.REVERSE_BEARING,
}


def grout_of(run: Results, found: Installation) -> Grout | None:
    """Return the space for grout; None where the room below the lid is not known. Its
    pressure is limited as that of a retrieval is, and by the weight."""
    if not len(found.room):
        return None
    depth, room = float(found.depth[-1]), float(found.room[-1])
    gap = room + float(found.expected[-1] - found.heave[-1])
    area, tilt = plug_area(run.scene), given(run, TILT)
    inner = float(run.scene["diameter_m"]) - 2 * float(run.scene["wall_thickness_m"])
    pressures = {LIFTED: run.weight / area}
    for name, values in overpressures.limits_of(run, np.array([depth])).items():
        factor = found.factors.get(GROUT_FACTORS.get(name, ""), 1.0)
        pressures[name] = float(values[0]) / factor
    least = {
        k: pressures[k] / 1e3 for k in sorted(pressures, key=pressures.__getitem__)
    }
    ends = sealing.gaps(room, inner, tilt)[0], sealing.gaps(gap, inner, tilt)[1]
    return Grout(depth, area * max(gap, 0.0), gap, ends, tilt, least)


class Scour(NamedTuple):
    """A depth of scour, the embedment at the end without and with it, and the share of
    the friction outside that the soil above it has, nan where it is not known."""

    scour: float
    embedment: float
    counts: float
    share: float


def scour_of(run: Results, found: Installation) -> Scour | None:
    """Return what scour leaves; None where no depth of it is given."""
    if not (scour := given(run, SCOUR)):
        return None
    end, share = float(found.depth[-1]), nan
    if rows := disturbed.last_rows(run.walls, end):
        friction = rows["outer_area_m2"] * np.nan_to_num(rows["outer_shear_stress_Pa"])
        if (total := float(friction.sum())) > 0:
            share = float(friction[rows["depth_m"] <= scour].sum()) / total
    return Scour(scour, end, max(end - scour, 0.0), share)


class Level(NamedTuple):
    """Of several buckets: their number, the least and the largest resistance of each
    over that of the run, at the end, and where that is from; the largest differential
    of suctions that keeps the frame level, with its depth; the largest tilt under one
    suction for all (degrees), with its depth, and that which is allowed (0 if it is not
    given); and where the strongest bucket first needs more than the allowable suction,
    if it does: the depth above, to which the frame can be kept level (0 for none), that
    depth, what the bucket needs, and what is allowed."""

    number: int
    ends: list[tuple[float, float]]
    of_band: bool
    differential: tuple[float, float]
    tilt: tuple[float, float]
    allowed: float
    beyond: tuple[float, ...] = ()


def resistance_at(run: Results, at: np.ndarray) -> np.ndarray:
    """Return the resistance of the ground at depths [n]: what weight and suction have
    to overcome, with what seepage takes from it (N)."""
    needs = at_depths(run, at)[SUCTION]
    way = run.history[DEPTH]
    found = run.weight + plug_area(run.scene) * needs
    return np.where((at >= way.min()) & (at <= way.max() + 1e-6), found, nan)


def shares_of_band(run: Results, at: np.ndarray) -> np.ndarray:
    """Return low and high resistance over that of the run at depths [n]: [n, 2], nan
    without these runs."""
    others = [member for name, member in band_of(run).items() if name != BEST]
    if len(others) < 2:
        return np.full((len(at), 2), nan)
    best = resistance_at(run, at)
    ratios = [resistance_at(member, at) / best for member in others]
    return np.column_stack([np.min(ratios, axis=0), np.max(ratios, axis=0)])


def spreads_of(run: Results) -> list[float]:
    """Return how far the resistance of each bucket may be from that of the run, as a
    share: one number stands for all, and none for what is not given."""
    words = run.entry(f"Design/{SPREAD}").split(",")
    return [float(word) for word in words if word.strip()]


def shares_at(run: Results, at: np.ndarray, number: int) -> np.ndarray:
    """Return the least and the largest resistance of each bucket over that of the run
    at depths [n]: [n, number, 2], nan where it is not known."""
    if spreads := spreads_of(run):
        ends = np.array([[1 - x, 1 + x] for x in spreads])
        return np.broadcast_to(ends, (len(at), number, 2))
    return np.repeat(shares_of_band(run, at)[:, np.newaxis], number, axis=1)


def lacking(run: Results) -> str:
    """Return what keeps several buckets from having a levelness, in words; nothing of
    one caisson, and where nothing is lacking."""
    number, spreads = int(given(run, NUMBER)), spreads_of(run)
    if number not in buckets.NUMBERS:
        return ""
    if not given(run, DISTANCE):
        return f"not given: Design/{DISTANCE}"
    if len(spreads) not in (0, 1, number):
        return f"Design/{SPREAD} has {len(spreads)} numbers, not {number}"
    no_band = not spreads and len(band_of(run)) < 3
    words = f"not given: Design/{SPREAD}, nor runs of low and high resistance"
    return words if no_band else ""


def level_of(run: Results, found: Installation) -> Level | None:
    """Return the levelness of several buckets; None of one, and where lacking() has
    words."""
    number, at = int(given(run, NUMBER)), found.depth
    if number not in buckets.NUMBERS or lacking(run) or len(at) < 2:
        return None
    force, ends = resistance_at(run, at), shares_at(run, at, number)
    slope, weight = np.gradient(force, at), run.weight
    loads, distance = (weight, plug_area(run.scene)), given(run, DISTANCE)
    known = np.isfinite(ends).all(axis=(1, 2)) & (force > weight)
    if not (rows := np.flatnonzero(known)).size:
        return None
    apart = max(
        (buckets.differential(ends[i], float(force[i]), *loads) / 1e3, float(at[i]))
        for i in rows
    )
    turned = max(
        (buckets.largest_tilt(ends[i], distance, force[i], slope[i]), float(at[i]))
        for i in rows
    )
    last = [(float(low), float(high)) for low, high in ends[rows[-1]]]
    needs = (ends[..., 1].max(axis=1) * force - weight) / loads[1] / 1e3
    parts = apart, turned, given(run, TILT), beyond_allowable(found, needs)
    return Level(number, last, not spreads_of(run), *parts)


def beyond_allowable(found: Installation, needs: np.ndarray) -> tuple[float, ...]:
    """Return Level.beyond. needs: of the strongest bucket, [n] (kPa), nan where it is
    not known."""
    over = np.flatnonzero(needs > found.allowable)
    if not len(over):
        return ()
    i, depth = int(over[0]), found.depth
    numbers = depth[i - 1] if i else 0, depth[i], needs[i], found.allowable[i]
    return tuple(map(float, numbers))


class Load(NamedTuple):
    """The load case where the suction is nearest to that which buckles the wall: that
    depth, the suction, the axial force (kN) on the top of the wall, the depths of the
    frames around, and places along the wall with their depth below the mudline and the
    net pressure from outside; and the largest suction, with its depth."""

    depth: float
    suction: float
    axial: float
    frames: list[float]
    along: list[tuple[str, float, float]]
    most: tuple[float, float]


def beyond_suction(pressures: Table, depth: float) -> np.ndarray:
    """Return what the net pressure from outside has beyond the suction at DOWN shares
    of the embedment, at a depth: linear between the frames, and as at the last one
    below it (kPa)."""
    at = np.unique(pressures[DEPTH])
    found = list[np.ndarray]()
    for h in at:
        rows = pressures[DEPTH] == h
        z, net = (pressures[x][rows] for x in ("depth_m", "net_external_pressure_Pa"))
        more = net - pressures["suction_Pa"][rows]
        found.append(np.interp(h * np.array(list(DOWN.values())), z, more) / 1e3)
    return np.array([np.interp(depth, at, column) for column in np.array(found).T])


def load_of(run: Results, found: Installation) -> Load | None:
    """Return the load case for a model of the shell; None without frames."""
    wall = limits.wall_of(run) if found.has_suction else None
    pressures = shell.pressures_of(run, wall) if wall else {}
    if not wall or not pressures:
        return None
    buckling = found.limits.get(limits.SHELL, np.full(len(found.depth), np.nan))
    row = largest = int(np.argmax(found.required))
    if np.isfinite(buckling).any():
        row = int(np.nanargmax(found.required / buckling))
    depth, suction = float(found.depth[row]), float(found.required[row])
    more = beyond_suction(pressures, depth)
    along = [("lid", -wall.free_length(depth), suction)]
    for (name, share), change in zip(DOWN.items(), more):
        along.append((name, share * depth, suction + float(change)))
    at = np.unique(pressures[DEPTH])
    around = [*at[at <= depth][-1:], *at[at > depth][:1]]
    axial = run.weight / 1e3 + suction * wall.area_inside
    most = float(found.required[largest]), float(found.depth[largest])
    return Load(depth, suction, axial, [float(h) for h in around], along, most)


class Stop(NamedTuple):
    """When the vessel stops, with numbers of a depth end: the allowable suction from
    where the caisson rests on, at the first and the last depth and where it is least,
    with what governs there; the heave at which it stops, the one expected, and that
    which fills the skirt at the planned depth; the flow under the allowable suction
    (m3/h), and the one computed; the tilt (degrees, 0 if it is not given). nan stands
    for what is not known."""

    end: float
    suctions: list[tuple[float, float, str]]
    heave: tuple[float, float, float]
    flow: tuple[float, float]
    tilt: float


def stop_of(run: Results, found: Installation, planned: float) -> Stop:
    """Return when the vessel stops on the way to a planned depth."""

    def words(i: int) -> str:
        name = found.governing(i)
        return f"{found.named(name)}{found.remark(name, i)}"

    known = np.isfinite(found.allowable)
    needed = np.flatnonzero((found.required > NOTHING) & known)
    rows = set[int]()
    if len(needed):  # from the row above the depth of rest, where suction begins
        at_rest = known & (found.depth <= least_rest(run, found.rest or 0.0))
        first = (
            min(needed[0], np.flatnonzero(at_rest)[-1]) if at_rest.any() else needed[0]
        )
        between = np.where(known, found.allowable, np.inf)[first : needed[-1] + 1]
        rows = {int(first), int(first + between.argmin()), int(needed[-1])}
    suctions = [
        (float(found.depth[i]), float(found.allowable[i]), words(i))
        for i in sorted(rows)
    ]
    heave, end = (nan, nan, nan), float(found.depth[-1])
    if len(found.room):
        expected = float(found.expected[-1])
        fills = float(run.scene["skirt_length_m"]) - planned
        heave = min(fills, MORE_HEAVE * max(expected, 0.0) or fills), expected, fills
    tilt = given(run, TILT)
    return Stop(end, suctions, heave, flows_of(found), tilt)


def flows_of(found: Installation) -> tuple[float, float]:
    """Return the flow at the end with the seepage under the allowable suction in place
    of the computed one, as it is linear in the suction, and the computed flow
    (m3/h)."""
    if not len(found.seepage) or not len(found.flow):
        return nan, nan
    flow, seepage = float(found.flow[-1]), float(found.seepage[-1])
    if not found.required[-1] > NOTHING:
        return nan, flow
    more = float(found.allowable[-1]) / float(found.required[-1])
    return flow - seepage + seepage * more, flow
