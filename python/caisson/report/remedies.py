# SPDX-License-Identifier: LGPL-2.1-or-later
"""What would help where suction does not install a caisson: amounts, by arithmetic.

A remedy has to do at all depths down to the planned one. The required suction and the
limits of the run go on by straight lines, as over the last meter or quarter of what is
feasible; piping and the plug of clay have the numbers of their methods. Tip and walls
keep their shares of the resistance; what water that flows takes from it in a run is not
known under another suction. With another wall or diameter the stress on them stays, on
their new areas, the methods and the check of the wall have the new sizes, and the
weight changes by the steel of the skirt. Where no size suffices, the depth stands there
that one of TRIED would reach.
"""
import functools
from collections.abc import Callable
from math import ceil, floor, inf, log10, pi
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from caisson.design import shell
from caisson.design.suction_installation import bisect
from caisson.units import GRAVITY
from caisson.verdict import limits, outcome, suction_methods, theory
from caisson.verdict.by_hand import suction_of
from caisson.verdict.installation import NOTHING, Installation, Rate, has_begun
from caisson.verdict.installation import installation_of
from caisson.results import Results
from caisson.template import say, say_rows

OF_WAY = 0.25  # of the feasible way, over which a trend is taken, and at least this:
LEAST_WAY, LEAST_ROWS = 1.0, 3  # m, and rows
STEEL_WEIGHT = (7850 - 1025) * GRAVITY / 1e3  # kN/m3, in water
THINNEST, THICKEST, WIDEST = 0.25, 2.0, 2.0  # of the wall, and of the diameter
TRIED = 0.8, 1.2  # of the wall, and of the diameter
STEPS = 0.001, 0.25  # m, of the wall and of the diameter
ROOM = 0.01  # of the diameter, that a shorter skirt leaves above the plug
SENTENCES = Path(__file__).with_name("remedies.jinja")
NOT_KNOWN = "not known: another layer begins above the planned depth"
RELIEVED = (
    "not known: less suction leaves more of tip and inner friction, by an amount that"
    " only another run shows"
)


class Sizes(NamedTuple):
    """What a remedy changes: diameter and wall (m), and the weight in water (kN)."""

    diameter: float
    wall: float
    weight: float

    @property
    def inner(self) -> float:
        """The inner diameter (m)."""
        return self.diameter - 2 * self.wall

    @property
    def area(self) -> float:
        """The area that suction acts on (m2)."""
        return pi / 4 * self.inner**2

    @property
    def tip(self) -> float:
        """The area of the tip (m2)."""
        return pi * (self.diameter - self.wall) * self.wall


class Planned:
    """The caisson at depths [n] (m), down to one that it does not reach; forces in kN,
    suctions in kPa, [n] each."""

    def __init__(self, run: Results, found: Installation, at: np.ndarray) -> None:
        """found: what is feasible, whose trend goes on below it."""
        self.run, self.found, self.at, self.depth = run, found, at, float(at[-1])
        scene = run.scene
        size, weight = float(scene["diameter_m"]), run.weight / 1e3
        self.sizes = Sizes(size, float(scene["wall_thickness_m"]), weight)
        # hand methods know the depths themselves
        self.there = installation_of(run, Rate(), at) if run.by_hand else None
        self.required = self.value(lambda x: x.required)
        self.expected = self.value(lambda x: x.expected)
        self.by_methods = functools.cache(self._by_methods)
        self.critical, self.piping, _ = self.by_methods(*self.sizes[:2])
        self.forces = self._jacking()
        wall = limits.wall_of(run)
        self.pressures = shell.pressures_of(run, wall) if wall else {}

    @property
    def rows(self) -> np.ndarray:
        """The rows of the installation whose trend goes on."""
        depth = self.found.depth
        way = max(LEAST_WAY, OF_WAY * (depth[-1] - depth[0]))
        rows = depth >= depth[-1] - way
        rows |= np.arange(len(depth)) >= len(depth) - LEAST_ROWS
        return np.asarray(rows & (self.found.required > NOTHING))

    def value(self, of: Callable[[Installation], np.ndarray]) -> np.ndarray:
        """Return a column of the installation at the depths; nan without a trend."""
        if self.there is not None:
            return of(self.there)
        values, depth = of(self.found), self.found.depth
        below = np.full(len(self.at), np.nan)
        rows = self.rows & np.isfinite(values)
        if rows.sum() > 1:
            line = np.polyfit(depth[rows], values[rows], 1)
            below = np.polyval(line, self.at)
        within = self.at <= depth[-1]
        return np.where(within, np.interp(self.at, depth, values), below)

    def _jacking(self) -> list[np.ndarray]:
        """Return the forces on tip, inner and outer wall without suction; below a run,
        they keep their shares."""
        names = list(self.found.forces)[:3]
        if self.there is not None:
            return [self.there.forces[name] for name in names]
        depth = self.found.depth
        parts = [np.interp(self.at, depth, self.found.forces[x]) for x in names]
        total = self.required * self.sizes.area + self.sizes.weight
        scale = np.where(self.required > NOTHING, total / sum(parts), 1.0)
        return [part * scale for part in parts]

    @property
    def is_relieved(self) -> bool:
        """Whether flow takes from the forces of a run, which more weight or another
        size would change by what only another run shows."""
        flows = np.isfinite(self.critical[has_begun(self.required)])
        return self.there is None and bool(flows.any())

    def _by_methods(
        self, diameter: float, wall: float
    ) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
        """Return the suction that leaves nothing of tip and inner friction, infinite
        without flow, that of piping, nan without, and those of the plug: what does not
        depend on the weight."""
        site = theory.site_of(self.run)
        new = {"diameter_m": diameter, "wall_thickness_m": wall}
        site = site._replace(scene={**site.scene, **new})
        critical, piping, every = suction_methods.limits_at(site, self.at)
        plug = {name: values / 1e3 for name, values in every.items()}
        return critical / 1e3, piping / 1e3, plug

    def resists(self, sizes: Sizes) -> dict[str, np.ndarray]:
        """Return the forces of jacking, by part."""
        old, (tip, inner, outer) = self.sizes, self.forces
        forces = {
            "tip": tip * (sizes.tip / old.tip),
            "inner friction": inner * (sizes.inner / old.inner),
            "outer friction": outer * (sizes.diameter / old.diameter),
        }
        return {**forces, "total": np.sum(list(forces.values()), axis=0)}

    def needs(self, sizes: Sizes) -> np.ndarray:
        """Return the required suction, at least 0: less of it takes less from tip and
        inner friction."""
        forces = self.resists(sizes)
        critical, *_ = self.by_methods(*sizes[:2])
        found = suction_of(forces, sizes.weight, sizes.area, critical)
        return np.maximum(found, 0.0)

    def allows(self, sizes: Sizes) -> dict[str, np.ndarray]:
        """Return the limits of the suction, by their factors."""
        _, piping, plug = self.by_methods(*sizes[:2])
        factors, same = self.found.factors, (self.there or self.found).limits
        known = {limits.PIPING: piping, **plug}
        found = {name: value / factors[name] for name, value in known.items()}
        for name in (limits.COMPUTED, limits.BOILING, limits.PUMP):
            if name in same:
                found[name] = self.value(lambda x: x.limits[name])
        if limits.COMPUTED in found:
            ratio = np.where(np.isfinite(self.piping), piping / self.piping, 1.0)
            found[limits.COMPUTED] = found[limits.COMPUTED] * ratio
        if limits.SHELL in same and (wall := limits.wall_of(self.run)) is not None:
            share = sizes.wall / self.sizes.wall
            parts = tuple((begin, share * thickness) for begin, thickness in wall.parts)
            wall = wall._replace(diameter=sizes.diameter, parts=parts)
            more = shell.beyond_suction(self.pressures, wall, list(self.at))
            borne = 1e3 * np.minimum(sizes.weight, self.resists(sizes)["total"])
            buckles = [
                shell.limit_suction(wall, float(h), w, float(x), factors[limits.SHELL])
                for h, w, x in zip(self.at, borne, more)
            ]
            found[limits.SHELL] = np.array(buckles) / 1e3
        return {k: np.where(np.isnan(x), inf, x) for k, x in found.items()}

    def has_room(self, sizes: Sizes) -> bool:
        """Return whether the plug, which the wall lifts, stays below the lid."""
        if not len(self.found.room):
            return True
        share = sizes.tip / sizes.area / (self.sizes.tip / self.sizes.area)
        rise = self.found.factors.get(limits.LID, 1.0) * share * self.expected
        return not (self.at + rise > self.run.scene["skirt_length_m"]).any()

    def suffices(self, sizes: Sizes) -> bool:
        """Return whether the required suction is below all limits, but for where it
        begins, as in Installation.share, and the plug below the lid."""
        endless, allowed = np.full(len(self.at), inf), self.allows(sizes)
        least, needed = np.min([endless, *allowed.values()], 0), self.needs(sizes)
        counts = has_begun(needed, self.there is not None)
        counts |= allowed.get(limits.SHELL, endless) <= 0
        return self.has_room(sizes) and bool((needed < least)[counts].all())

    def steel(self, sizes: Sizes) -> float:
        """Return the weight (kN) with another skirt of steel."""
        length = float(self.run.scene.get("skirt_length_m") or 0)
        more = STEEL_WEIGHT * length * (sizes.tip - self.sizes.tip)
        return self.sizes.weight + more


def is_enough(planned: Planned, name: str, size: float) -> bool:
    """Return whether the caisson goes in with another diameter or wall (m)."""
    sizes = planned.sizes._replace(**{name: size})
    return planned.suffices(sizes._replace(weight=planned.steel(sizes)))


def nearest(planned: Planned, name: str) -> float | None:
    """Return the diameter, a wider one, or the wall (m) that is nearest to the present
    one and suffices; None without one."""
    is_wide, old = name == "diameter", planned.sizes._asdict()[name]
    step, signs = STEPS[is_wide], (1,) if is_wide else (-1, 1)
    n = (WIDEST - 1) * old / step if is_wide else np.ceil((THICKEST - 1) * old / step)
    found = (old + step * i * sign for i in range(1, int(n) + 1) for sign in signs)
    enough = (x for x in found if x >= THINNEST * old and is_enough(planned, name, x))
    return next(enough, None)


def reach(planned: Planned, name: str, size: float) -> float:
    """Return the depth (m) to which the caisson goes in with another diameter or
    wall (m)."""
    run, found, every = planned.run, planned.found, planned.at

    def is_beyond(depth: float) -> bool:
        down = Planned(run, found, np.append(every[every < depth], depth))
        return not is_enough(down, name, size)

    return bisect(is_beyond, float(found.depth[-1]), planned.depth, 12)[0]


def rounded_up(value: float) -> float:
    """Return a number above 0 with two digits, and not less."""
    step = 10.0 ** (floor(log10(value)) - 1)
    return float(ceil(value / step - 1e-6) * step)


def weight_of(planned: Planned) -> float | None:
    """Return the weight (kN) that suffices; None where none does, as the wall buckles
    under it, or the plug meets the lid."""
    sizes, whole = planned.sizes, float(np.max(sum(planned.forces)))

    def suffices(weight: float) -> bool:
        return planned.suffices(sizes._replace(weight=weight))

    if not suffices(whole):
        return None
    return rounded_up(bisect(suffices, sizes.weight, whole, 30)[1])


class Size(NamedTuple):
    """Another diameter or wall (m): the present one, the one that suffices, the range
    that was searched and, where none suffices, one of TRIED with the depth (m) that it
    reaches, if that is deeper."""

    old: float
    enough: float | None
    least: float
    most: float
    tried: float
    reach: float | None


def size_of(planned: Planned, name: str) -> Size:
    """Return what another diameter or wall does."""
    is_wide, old = name == "diameter", planned.sizes._asdict()[name]
    unit = 1.0 if is_wide else 1e-3
    tried, depth = unit * float(f"{TRIED[is_wide] * old / unit:.3g}"), None
    if (enough := nearest(planned, name)) is None:
        depth = reach(planned, name, tried)
        depth = depth if depth > planned.found.depth[-1] + 0.05 else None
    most = (WIDEST if is_wide else THICKEST) * old
    return Size(old, enough, THINNEST * old, most, tried, depth)


class Pump(NamedTuple):
    """What is needed and the present pump (kPa) or, if another limit stops any pump,
    the suction that is needed, that limit, and its name."""

    needed: float
    limit: float
    stopped_by: str = ""


def pump_of(planned: Planned) -> Pump | None:
    """Return what another pump does; None where there is nothing to say of it."""
    others = planned.allows(planned.sizes)
    pump = others.pop(limits.PUMP, np.array([inf]))[-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = {k: np.nan_to_num(planned.required / x) for k, x in others.items()}
    name = max(shares, key=lambda x: float(shares[x].max()), default="")
    if not name or shares[name].max() < 1:
        if pump == inf:
            return None
        factor = planned.found.factors[limits.PUMP]
        most = factor * float(planned.required.max())
        return Pump(rounded_up(most), factor * float(pump))
    i = int(shares[name].argmax())
    needed, least = float(planned.required[i]), float(others[name][i])
    return Pump(needed, least, planned.found.named(name))


def skirt_of(planned: Planned) -> tuple[float, float] | None:
    """Return the skirt that leaves room for the heave of the plug, and the present one
    (m), if it is longer."""
    found, length = planned.found, planned.run.scene.get("skirt_length_m")
    if not length or not len(found.room):
        return None
    rise = found.factors.get(limits.LID, 1.0) * float(planned.expected[-1])
    needed = planned.depth + max(rise, 0.0)
    return (needed, float(length)) if needed > float(length) else None


def planned_of(run: Results, found: Installation, target: float) -> Planned | str:
    """Return the caisson at a depth (m), or why nothing is known of it."""
    scene = run.scene
    sizes = scene.get("diameter_m"), scene.get("wall_thickness_m")
    if None in sizes or not run.weight:
        return "sizes and weight are not known"
    every = (run.by_hand and outcome.whole_way(run)) or found
    way = every.depth[(every.depth > 0) & (every.depth < target)]
    planned = Planned(run, found, np.append(way, target))
    if not np.isfinite(planned.required[-1]):
        return "too few numbers above"
    if run.by_hand:
        return planned
    if planned.is_relieved:
        return RELIEVED
    above = found.depth[planned.rows][0]
    tops = [layer.get("top_depth_m", 0) for layer in scene.get("layers", [])]
    return NOT_KNOWN if any(above < top < target for top in tops) else planned


def sentence_of(run: Results, found: Installation, target: float) -> str:
    """Return which weight, or pump, would be needed at a depth (m)."""
    planned = planned_of(run, found, target)
    if planned in (NOT_KNOWN, RELIEVED):
        return say(SENTENCES, "not_known", found.shown, target)
    if isinstance(planned, str) or (weight := weight_of(planned)) is None:
        return ""
    pump = pump_of(planned)
    helps = pump if pump and not pump.stopped_by else None
    return say(SENTENCES, "needed", found.shown, target, weight, helps)


def table_of(run: Results, found: Installation, end: float | None) -> dict[str, Any]:
    """Return heads and rows of remedies for a caisson that goes in to an end (m) only;
    found: down to there. Empty where it goes in, or the planned depth is not known."""
    target, shown = run.planned, found.shown
    if end is None or target is None or target <= end:
        return {}
    planned, trend = planned_of(run, found, target), None
    if isinstance(planned, str):
        amounts = [["weight, wall, diameter, pump", planned]]
    else:
        sizes = size_of(planned, "wall"), size_of(planned, "diameter")
        more = *sizes, pump_of(planned), skirt_of(planned)
        known = shown, planned.sizes, weight_of(planned), *more
        amounts = say_rows(SENTENCES, "amounts", *known)
        trend = None if planned.there else found.depth[planned.rows][[0, -1]]
    heads = ["one of these", say(SENTENCES, "head", shown, target, trend)]
    room = ROOM * float(run.scene.get("diameter_m") or 0)
    others = say_rows(SENTENCES, "others", found, end, room)
    return {"heads": heads, "rows": amounts + others}
