# SPDX-License-Identifier: LGPL-2.1-or-later
"""The limits of the suction, each divided by a factor of its own: section Design of a
scene, whose numbers the program hands on in run.json.

Piping: the suction at which the exit gradient that was computed becomes critical, and
that of Houlsby & Byrne (2005). The plug of clay: reverse bearing, and lift by the water
below (design/plug_stability). Water boils below the lid. The pump. The plug meets the
lid: no suction helps from that depth on. The wall buckles (design/shell).
"""
import math
from collections.abc import Collection
from math import inf
from pathlib import Path
from typing import NamedTuple

import numpy as np

from caisson import curves
from caisson.design import plug_stability, shell
from caisson import evaluation
from caisson.evaluation import (
    DEPTH,
    EXPECTED_HEAVE,
    HEAVE,
    TOTAL,
    at_depths,
    pump_limit,
)
from caisson.ledges import parts_of_wall
from caisson.verdict import suction_methods, theory
from caisson.results import Results, ResultsError
from caisson.shown import Units
from caisson.table import write_columns

LEAST_SHARE = 0.02  # of the critical gradient, below which the gradient is noise
COMPUTED, PIPING = "exit gradient computed", "piping, Houlsby & Byrne"
REVERSE_BEARING, LIFT = plug_stability.REVERSE_BEARING, plug_stability.LIFT
BOILING, PUMP = "water boils", "pump"
LID, SHELL = "plug meets the lid", "wall buckles (DNV-RP-C202)"


class Limit(NamedTuple):
    """A limit: its kind, the entry of its factor in section Design, and its color in
    charts."""

    kind: str
    entry: str
    color: str
    source: str = ""  # of a default other than 1


LIMITS = {
    COMPUTED: Limit("piping", "piping", "#e6550d"),
    PIPING: Limit("piping", "piping", "#a63603"),
    REVERSE_BEARING: Limit(
        "plug of clay", "plug failure", "#6a51a3", "custom, DNV-RP-E303"
    ),
    LIFT: Limit("plug of clay", "plug lift", "#dd1c77"),
    BOILING: Limit("water boils", "boiling", "#cb181d"),
    PUMP: Limit("pump", "pump", "#00838f"),
    LID: Limit(LID, "plug heave", "#5d4037"),
    SHELL: Limit("wall buckles", "shell buckling", "#1a1aff", "on loads, DNV-OS-C101"),
}
NONE_HERE = "none at these depths"  # where the scene has what it takes
STEEL = (  # entries of section Design, as shell.Wall has them
    *("Steel yield strength", "Steel Youngs modulus"),
    *("Fixity depth over diameter", "Ring stiffener spacing"),
)


def number_of(run: Results, name: str) -> float:
    """Return an entry of section Design. Raises ResultsError of an earlier version."""
    if not (text := run.entry(f"Design/{name}")):
        raise ResultsError(
            f"{run.directory / 'run.json'} has no entry Design/{name}: it is of an"
            " earlier version of the program; run the scene again"
        )
    return float(text)


def factors_of(run: Results) -> dict[str, float]:
    """Return the factor on each limit; empty where a run has left no run.json yet."""
    limits = LIMITS.items() if run.scene else ()
    return {name: number_of(run, f"Factor on {x.entry}") for name, x in limits}


def soft_in_words(tops: np.ndarray, shown: Units) -> str:
    """Return which soft layers below the tip govern reverse bearing, by their tops [n]
    (m), nan where the clay at the tip does; nothing where none does."""
    places = dict.fromkeys(shown.place(top) for top in tops[np.isfinite(tops)])
    if not places:
        return ""
    return f"the soft layer below governs, from {' and '.join(places)}"


def why_absent(run: Results, kind: str) -> str:
    """Return why a run has no limit of a kind: what its scene lacks, else that there is
    none at the depths that are asked for."""
    if kind == LIMITS[COMPUTED].kind and "critical_gradient" not in run.history:
        return "no water flows through the plug"
    if kind == LIMITS[REVERSE_BEARING].kind:
        try:
            site = theory.site_of(run)
            soils = theory.soils_of(site, inf)
        except theory.NotApplicable as reason:
            return str(reason)
        if theory.below_cover(site)[1]:
            share = 100 * theory.COVER
            return (
                f"clay on top thinner than {share:g} % of the diameter is none (custom)"
            )
        return NONE_HERE if "clay" in dict(soils).values() else "no clay"
    if kind == LIMITS[PUMP].kind and pump_limit(run) is None:
        return "Water/Largest suction not given"
    if kind == LID and not run.scene.get("skirt_length_m"):
        return "the body has no skirt with a lid"
    if kind == LIMITS[SHELL].kind and wall_of(run) is None:
        return "the body has no wall of steel"
    return NONE_HERE


def absent_of(run: Results, found: dict[str, np.ndarray]) -> list[str]:
    """Return the kinds of limits that found lacks, each with its reason."""
    if not run.known:
        return ["limits: not known without run.json"]
    known = {LIMITS[name].kind for name in found}
    kinds = dict.fromkeys(limit.kind for limit in LIMITS.values())
    return [f"{x}: {why_absent(run, x)}" for x in kinds if x not in known]


def chosen(run: Results, names: Collection[str]) -> dict[str, tuple[float, bool]]:
    """Return the factors on limits of these names, by entry, each with whether the
    scene sets it."""
    factors, given = factors_of(run) if names else {}, run.known.get("entries", {})
    pairs = [(LIMITS[x].entry, factors[x]) for x in names]
    return {e: (factor, f"Design/Factor on {e}" in given) for e, factor in pairs}


def sources_of(run: Results, names: Collection[str]) -> list[tuple[str, float, str]]:
    """Return entry and value of the factors on limits that are not 1, and where each
    comes from."""
    source = {limit.entry: limit.source for limit in LIMITS.values()}
    return [
        (entry, factor, "given" if is_given else source[entry])
        for entry, (factor, is_given) in chosen(run, names).items()
        if factor != 1
    ]


def wall_of(run: Results) -> shell.Wall | None:
    """Return the steel wall of a caisson, with its rings as flat bars; None where the
    run does not know it."""
    sizes = ("diameter_m", "wall_thickness_m", "skirt_length_m")
    known = [run.scene.get(name) for name in sizes]
    if None in known:
        return None
    outer, thickness, length = (float(x or 0) for x in known)
    steps = parts_of_wall(run.scene, "wall_step", "above_tip", "thickness")
    ends = [*(length - begin for begin, _ in steps), 0.0]
    parts = tuple(zip(ends, [thickness, *(step for _, step in steps)]))
    strength, modulus, fixity, spacing = (number_of(run, name) for name in STEEL)
    steel = strength, modulus, fixity, spacing or inf
    rings = parts_of_wall(run.scene, "ring", "above_tip", "width", "height")
    stiffeners = tuple(
        shell.Ring(length - place - height / 2, width, height)
        for place, width, height in reversed(rings)
    )
    return shell.Wall(outer, thickness, length, *steel, stiffeners, parts)


def critical_by_gradient(run: Results, at: np.ndarray) -> np.ndarray:
    """Return the suction (kPa) at which the exit gradient of the run becomes critical,
    at depths [n], nan where there is no suction, and where hardly any water flows,
    as with the tip in clay. The flow is linear in the suction."""
    history = run.history
    if "critical_gradient" not in history:
        return np.full(len(at), np.nan)
    rows = curves.way_down(history["penetration_m"])[1:]
    depth, suction = history["penetration_m"][rows], history["suction_Pa"][rows]
    share = curves.gradient_share(history)[rows]
    pulled = (suction > 0) & (share > LEAST_SHARE)
    if not pulled.any():
        return np.full(len(at), np.nan)
    found = suction[pulled] / share[pulled] / 1e3
    means = curves.smoothed_at(depth[pulled], found, at)
    away = np.abs(at[:, np.newaxis] - depth[pulled]).min(axis=1)
    near = (away <= curves.window_of(np.ptp(depth))) & (at >= depth[pulled][0])
    return np.where(near, means, np.nan)


def shell_limit(
    run: Results, at: np.ndarray, borne: np.ndarray, factor: float
) -> np.ndarray:
    """Return the suction (kPa) at which the wall buckles at depths [n] (m), where it
    bears some of the weight, [n] (N), by the pressures on it that the run has at its
    frames."""
    if (wall := wall_of(run)) is None:
        return np.full(len(at), np.nan)
    more = shell.beyond_suction(shell.pressures_of(run, wall), wall, at)
    found = [
        shell.limit_suction(wall, float(h), float(w), float(p), factor)
        for h, w, p in zip(at, borne, more)
    ]
    return np.array(found) / 1e3


def rings_counted(run: Results, at: np.ndarray) -> tuple[int, int]:
    """Return at how many of depths [n] (m) the wall has rings where it buckles, and at
    how many of these its check counts them."""
    wall = wall_of(run)
    within = [h for h in map(float, at) if wall and wall.stiffeners_at(h)]
    if not wall or not within:
        return 0, 0
    factor = factors_of(run)[SHELL]
    more = shell.beyond_suction(shell.pressures_of(run, wall), wall, within)
    pairs = [
        shell.limits_at(wall, h, run.weight, float(p), factor)
        for h, p in zip(within, more)
    ]
    return len(within), sum(plain < with_rings for plain, with_rings in pairs)


def write_pressures(path: Path, run: Results) -> Path | None:
    """Write the pressure from outside along the wall at the frames of a run with
    suction, the load of a model of the shell; return its path, None without any."""
    wall = wall_of(run) if "suction_Pa" in run.history else None
    found = shell.pressures_of(run, wall) if wall else {}
    return write_columns(path, found) if found else None


def rounded_down(depth: float) -> float:
    """Return a depth (m) in whole decimeters, or with two digits below 1 m; a
    twentieth less than one of them counts as that one."""
    step = min(0.1, 10.0 ** (math.floor(math.log10(depth)) - 1)) if depth > 0 else 0.1
    return round(step * math.floor(depth / step + 0.05), 9)


def lid_depth(depth: np.ndarray, room: np.ndarray) -> float | None:
    """Return the depth (m) at which the plug meets the lid, by the room below it at
    depths [n]: as over the last meter, if it would go on so; None without any rise."""
    if len(met := np.flatnonzero(room <= 0)):
        i = max(int(met[0]), 1)
        ends = slice(i - 1, i + 1)
        return float(np.interp(0, -room[ends], depth[ends]))
    last = depth >= depth[-1] - 1.0
    if last.sum() < 2:
        return None
    slope = (room[last][0] - room[-1]) / (depth[-1] - depth[last][0])
    return float(depth[-1] + room[-1] / max(slope, 0.1))


def limits_of(run: Results, at: np.ndarray) -> dict[str, np.ndarray]:
    """Return the limits of the suction (kPa) at depths [n], nan or infinite where one
    is none, each by its factor; only those that there are. That of the lid is 0 from
    where the plug meets it."""
    numbers = at_depths(run, at)
    if not (factors := factors_of(run)):
        return {}
    found: dict[str, np.ndarray] = {}
    if "critical_gradient" in run.history:
        found[COMPUTED] = critical_by_gradient(run, at)
    _, piping, plug = suction_methods.limits_at(theory.site_of(run), at)
    found[PIPING] = piping / 1e3
    found |= {name: values / 1e3 for name, values in plug.items()}
    if evaluation.BOILING in numbers:
        found[BOILING] = numbers[evaluation.BOILING] / 1e3
    if (pump := pump_limit(run)) is not None:
        found[PUMP] = np.full(len(at), pump)
    found = {name: values / factors[name] for name, values in found.items()}
    if (length := run.scene.get("skirt_length_m")) and HEAVE in numbers:
        rows = at_depths(run)
        depth = rows[DEPTH]
        heave = factors[LID] * rows.get(EXPECTED_HEAVE, rows[HEAVE])
        lid = lid_depth(depth, float(length) - depth - heave)
        met = np.inf if lid is None or lid > depth[-1] else rounded_down(lid)
        found[LID] = np.where(at < met - 1e-9, inf, 0.0)
    borne = np.minimum(run.weight, numbers[TOTAL])
    found[SHELL] = shell_limit(run, at, borne, factors[SHELL])
    return {k: values for k, values in found.items() if not np.isnan(values).all()}


def least_of(limits: dict[str, np.ndarray], n: int) -> np.ndarray:
    """Return the least of limits [n]; infinite without any."""
    found = np.array([np.full(n, inf), *limits.values()])
    return np.asarray(np.where(np.isnan(found), inf, found).min(axis=0))


def governing(limits: dict[str, np.ndarray], i: int) -> str:
    """Return which of limits [n] is the least in a row; nothing without any."""
    known = {name: v[i] for name, v in limits.items() if np.isfinite(v[i])}
    return min(known, key=lambda name: known[name]) if known else ""
