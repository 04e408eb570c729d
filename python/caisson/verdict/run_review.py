# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the records of a run say against it: a tip force that falls suddenly, a wall
from which clay has come off, work that the transfer between points and nodes has lost,
and soil that moves too fast."""
import functools
import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from caisson import run_error_bar, template
from caisson.evaluation import DEPTH, is_pull, rest_of
from caisson.results import Results, Table
from caisson.units import WATER
from caisson.design import cone
from caisson.design.cone_rules import gaps_in

say = partial(template.say, Path(__file__).with_name("words.jinja"))
# A fall counts if it takes less than this way, in widths of the tip. The stretches of
# the way, over which forces are averaged, are an eighth of that: single rows scatter.
SHORT_WAY, STRETCH = 0.5, 0.5 / 8
# Within so many widths of the start, or of an interface between layers, forces change
# for a reason.
START_TAKES, INTERFACE_TAKES = 2.0, 8.0
LARGEST_FALL = 0.05  # without a fault below 2 % of the tip force (doc/limitations.md)
SAME_SPEED = 0.1  # the speeds of two stretches that are compared differ by less
# Clay that stays at the wall bears 0.93 of adhesion times area and more from this depth
# on, in widths of the tip.
LEAST_OF_ADHESION, ADHESION_FROM = 0.9, 3.0
# With 3 % lost, the tip force of prm/jack_coarse.prm is 6 % too large, and with 6 to
# 18 % lost, 12 to 55 %. Waves of undrained water lose more, which the force does not
# contain.
LARGEST_LOST, LARGEST_LOST_UNDRAINED = 0.03, 0.1
LARGEST_KINETIC = 0.01  # of the work, in a run whose forces are those of slow motion
WORK = {"external_work_J", "kinetic_energy_J", "total_force_N"}
AT_PENETRATION = re.compile(r"at a penetration of ([\d.]+) m")  # in a warning
# m/s, that of a pump; P-wave over Young's modulus, with a Poisson's ratio of 0.3
USUAL_RATE, P_WAVE = 1.0 / 3600, 1.35
FEWEST_WALLS = 3  # thicknesses of the wall, over which forces build up
LEAST_ABOVE = 0.1  # m, of a lid above the sea
FASTER = 100.0  # times c_v, by which ground drains what it lies above or below
UNSTEADY = 0.1  # v D / c_v, below which flow counts as steady
LEAST_WORK_OF_PULL = 0.1  # of the largest work, in rows of a pull that count


@dataclass(frozen=True)
class KineticShare:
    """The largest kinetic energy of the soil over the work of the body, and the
    penetration there (m)."""

    share: float
    penetration: float

    @property
    def is_small(self) -> bool:
        """Whether the forces are those of slow motion."""
        return self.share <= LARGEST_KINETIC


def kinetic_share(history: Table, start: float) -> KineticShare | None:
    """Return the share from a penetration (m) on, once the waves of the start have
    decayed: from the first row on that has no more than is allowed, or in the last row
    where there is none. Of a body that is pulled up, only rows with a pull count, as
    soil springs up when the load on it goes. None where no row counts."""
    depth, work = history["penetration_m"], history["external_work_J"]
    work = abs(work + history.get("water_work_J", 0.0))
    force = history.get("total_force_with_water_N", history["total_force_N"])
    if depth[-1] < depth[0]:
        counts = (force < 0) & (work > LEAST_WORK_OF_PULL * work.max())
    else:
        counts = depth >= start
    kinetic = history["kinetic_energy_J"]
    rows = np.flatnonzero(counts & (work > 0) & np.isfinite(kinetic))
    if not len(rows):
        return None
    shares = np.maximum(kinetic[rows], 0) / work[rows]
    decayed = np.flatnonzero(shares <= LARGEST_KINETIC)
    first = decayed[0] if len(decayed) else len(rows) - 1
    worst = first + int(np.argmax(shares[first:]))
    return KineticShare(float(shares[worst]), float(depth[rows[worst]]))


def percent(share: float) -> str:
    """Return a share in percent, with two digits."""
    return f"{template.number(100 * share, 2)} %"


def tip_of(run: Results) -> dict[str, Any]:
    """Return what run.json has of the tip; empty without one. Earlier versions have it
    of a caisson alone, as the thickness of its wall."""
    names = "wall_thickness_m", "initial_penetration_m"
    wall, first = (run.scene.get(name) for name in names)
    earlier = {"width_m": wall, "initial_penetration_m": first or 0.0} if wall else {}
    return run.known.get("tip") or earlier


def start_of(tip: dict[str, Any]) -> float:
    """Return the penetration (m) from which forces are not those of the start."""
    return float(tip["initial_penetration_m"] + START_TAKES * tip["width_m"])


def kinetic_share_of(run: Results) -> KineticShare | None:
    """Return the share of a run; None without a body that has a tip."""
    tip = tip_of(run)
    if not tip or not WORK <= set(run.history):
        return None
    return kinetic_share(run.history, start_of(tip))


def way_down(history: Table, length: float) -> Table:
    """Return means over stretches of a length (m) of the way down, until the body is
    first pulled up: depth and speed, and the forces and suction of the history, each
    [n_stretches]. A row of the history holds the mean since the row before."""
    moved = np.diff(history["penetration_m"])
    passed = np.diff(history["time_s"])
    up = np.flatnonzero(moved < 0)
    end = up[0] if len(up) else len(moved)
    rows = np.flatnonzero((moved[:end] > 0) & (passed[:end] > 0))
    depth = history["penetration_m"][1:][rows] - 0.5 * moved[rows]
    firsts: list[int] = []  # rows with which stretches begin
    for row, middle in enumerate(depth):
        if not firsts or middle >= depth[firsts[-1]] + length:
            firsts.append(row)

    def means(values: np.ndarray) -> np.ndarray:
        if not firsts:
            return np.zeros(0)
        sizes = np.diff([*firsts, len(values)])
        return np.asarray(np.add.reduceat(values, firsts) / sizes)

    zeros = np.zeros_like(history["time_s"])
    columns = "tip_force_N", "suction_Pa", "inner_friction_N", "outer_friction_N"
    return {"depth": means(depth), "speed": means(moved[rows] / passed[rows])} | {
        name: means(history.get(name, zeros)[1:][rows]) for name in columns
    }


class Review:
    """A run that has ended, and what speaks against its results."""

    def __init__(self, run: Results) -> None:
        self.run = run
        self.tip = tip_of(run)
        self.width = self.tip["width_m"]
        self.way = way_down(run.history, STRETCH * self.width)
        self.layers: list[dict[str, Any]] = run.scene.get("layers", [])

    def warnings(self) -> list[str]:
        """Return a warning for each fault that is seen."""
        walls = [self.bare_wall(side) for side in ("inner", "outer")]
        found = [self.fall_of_tip(), *walls, self.lost_work(), self.fast_soil()]
        return [text for text in found if text]

    def falls(self) -> Iterator[tuple[float, float]]:
        """Yield by how much the tip force falls over a short way, relative to what it
        was, and where (m), at speeds that agree and without a suction, which unloads
        the tip, and where no layer begins."""
        depth, tip, speed = (
            self.way[name] for name in ("depth", "tip_force_N", "speed")
        )
        away = depth[:, np.newaxis] - np.array(self.tip["interface_depths_m"])
        near = np.abs(away) <= INTERFACE_TAKES * self.width
        pumps = self.way["suction_Pa"] > 0
        counts = (depth >= start_of(self.tip)) & ~near.any(axis=1) & ~pumps
        firsts = np.searchsorted(depth, depth - (1 + 1e-6) * SHORT_WAY * self.width)
        for after in np.flatnonzero(counts):
            for before in range(firsts[after], after):
                close = abs(speed[before] - speed[after]) <= SAME_SPEED * speed[before]
                if close and tip[before] > 0 and not pumps[before]:
                    yield 1 - tip[after] / tip[before], depth[after]

    def fall_of_tip(self) -> str:
        """Return a warning of a tip force that falls suddenly."""
        share, depth = max(self.falls(), default=(0.0, 0.0))
        return say("fall", percent(share), depth) if share > LARGEST_FALL else ""

    def has_cut_off(self) -> bool:
        """Return whether a layer has a tension cut-off, so that it may come off."""
        return any(
            item["entry"] == "Tension cut-off" and (item["value"] or 0) > 0
            for layer in self.layers
            for item in layer["law_entries"]
        )

    def adhesion_down_to(self, depth: np.ndarray, side: str) -> np.ndarray:
        """Return adhesion times area of a wall (N) down to depths [n] (m), for the
        whole circumference: [n]."""
        tops = [layer["top_depth_m"] for layer in self.layers]
        of_body = self.run.scene[f"{side}_wall_adhesion_Pa"]
        sums = np.zeros_like(depth)
        for layer, top, end in zip(self.layers, tops, [*tops[1:], np.inf]):
            adhesion = layer.get("wall_adhesion_Pa", of_body)
            sums += adhesion * np.maximum(np.minimum(end, depth) - top, 0)
        radius = self.tip[f"{side}_radius_m"]
        return np.asarray(2 * np.pi * radius * sums)

    def bare_wall(self, side: str) -> str:
        """Return a warning of clay that has come off a wall; the shape of the tip takes
        up to a width of the wall."""
        is_round = self.run.entry("Grid/Geometry") == "axisymmetric"
        if not is_round or not self.has_cut_off():
            return ""
        rows = self.way["depth"] >= ADHESION_FROM * self.width
        borne = self.way[f"{side}_friction_N"][rows].sum()
        depth = self.way["depth"][rows] - self.width
        due = self.adhesion_down_to(depth, side).sum()
        if due <= 0 or borne >= LEAST_OF_ADHESION * due:
            return ""
        return say("bare", side, percent(1 - borne / due))

    def lost_work(self) -> str:
        """Return a warning of work that the transfer has lost."""
        energy = self.run.known.get("energies", {})
        work = sum(energy.get(f"{n}_work_J") or 0 for n in ("external", "water"))
        lost = energy.get("numerical_dissipation_J") or 0
        undrained = self.run.entry("Water/Level") in ("undrained", "coupled")
        allowed = LARGEST_LOST_UNDRAINED if undrained else LARGEST_LOST
        is_much = work > 0 and lost > allowed * work
        return say("lost", percent(lost / work)) if is_much else ""

    def fast_soil(self) -> str:
        """Return a warning of forces of which inertia is a part."""
        found = kinetic_share_of(self.run)
        if found is None or found.is_small:
            return ""
        most = percent(LARGEST_KINETIC)
        return say("fast", percent(found.share), found.penetration, most)


def consolidation_of(layer: dict[str, Any]) -> float:
    """Return c_v = k M / gamma_w of a layer of sand (m2/s); 0 of another one."""
    names = "permeability_m_s", "youngs_modulus_Pa", "friction_angle_deg"
    k, modulus, angle = (float(layer.get(name) or 0) for name in names)
    return k * P_WAVE * modulus / WATER if angle > 0 else 0.0


def thickness_of(tops: list[float], c_v: list[float], i: int) -> float:
    """Return the thickness (m) of the ground about a layer that drains no faster than
    it does: down to a layer on either side that does, or without end."""
    first = last = i
    while first > 0 and c_v[first - 1] < FASTER * c_v[i]:
        first -= 1
    while last + 1 < len(tops) and c_v[last + 1] < FASTER * c_v[i]:
        last += 1
    return [*tops, math.inf][last + 1] - tops[first]


def unsteady_flow(run: Results) -> tuple[int, float] | None:
    """Return the layer of sand in which the flow is least steady as a pump moves the
    caisson, and v D / c_v there, if that is above UNSTEADY. Ground that is thinner than
    D drains as much faster as its thickness squared is smaller."""
    diameter = float(run.scene.get("diameter_m") or 0)
    if not run.weight or not diameter or run.entry("Water/Level") != "seepage":
        return None
    layers = run.scene.get("layers", [])
    tops = [float(layer.get("top_depth_m") or 0) for layer in layers]
    c_v, found = [consolidation_of(layer) for layer in layers], dict[int, float]()
    for i, layer in enumerate(layers):
        if tops[i] >= (run.planned or 0) or not layer.get("friction_angle_deg"):
            break  # below clay no water flows
        share = min(thickness_of(tops, c_v, i) / diameter, 1.0)
        ratio = share**2 * USUAL_RATE * diameter / c_v[i] if c_v[i] > 0 else 0.0
        found[int(layer.get("layer", i + 1))] = ratio
    number, most = max(found.items(), key=lambda x: x[1], default=(0, 0.0))
    return (number, most) if most > UNSTEADY else None


def lid_above_sea(run: Results) -> str:
    """Return a warning of a lid that stands above the sea where suction begins."""
    length = float(run.scene.get("skirt_length_m") or 0)
    water = run.entry("Water/Water depth")
    if not run.weight or not water or run.assumes("Water depth"):
        return ""
    rest = rest_of(run) or 0.0
    above = length - rest - float(water)
    return say("above_sea", above, rest) if above > LEAST_ABOVE else ""


def gaps_in_test(run: Results) -> str:
    """Return a warning of what its cone test has not measured on the way down."""
    test = cone.of_run(run.directory)
    if test is None or run.planned is None:
        return ""
    end = float(test.depth[-1])
    gaps = *gaps_in(test.depth), (end, max(end, run.planned))
    found = [gap for gap in gaps if gap[0] < run.planned]
    return say("gaps_in_test", found) if found else ""


def short_way(run: Results) -> str:
    """Return a warning of a way down on which the forces only build up."""
    wall, depth = float(run.scene.get("wall_thickness_m") or 0), run.history[DEPTH]
    way = float(depth.max() - depth[0])
    begins = run.is_finished and not run.entry("Installation/Directory")
    is_short = begins and not is_pull(run) and 0 < way < FEWEST_WALLS * wall
    return say("short_way", way, FEWEST_WALLS) if is_short else ""


def down_to(end: float | None, texts: Iterable[str]) -> list[str]:
    """Return the warnings without those about what is deeper than the end of suction
    (m)."""
    places = [(AT_PENETRATION.search(text), text) for text in texts]
    return [t for at, t in places if end is None or at is None or float(at[1]) <= end]


@functools.lru_cache(maxsize=32)
def review_of(run: Results) -> tuple[str, ...]:
    """Return what the records of a run that has ended say against it, but of one by an
    earlier version of the program, whose run.json has that itself; and whether its
    flow is steady, its lid in the water, its cone test without gaps, and its error bar
    that of another scene."""
    other_bar = say("other_bar") if run_error_bar.is_of_another(run) else ""
    found, is_by_hand = unsteady_flow(run), bool(run.by_hand)
    unsteady = say("unsteady", *found, is_by_hand) if found else ""
    texts = [unsteady, lid_above_sea(run), gaps_in_test(run), other_bar]
    of_all = tuple(filter(None, texts))
    if (
        run.by_hand
        or run.is_running
        or "tip" not in run.known
        or "tip_force_N" not in run.history
    ):
        return of_all
    return *Review(run).warnings(), *filter(None, [short_way(run)]), *of_all


def warnings_of(run: Results, end: float | None = None) -> dict[str, list[str]]:
    """Return what the program has warned of, and what the records say against the run,
    down to the end of suction (m), by rank: "result", "input" and "cosmetic". Raises
    ResultsError."""
    found: dict[str, list[str]] = {"result": [], "input": [], "cosmetic": []}
    for warning in (run.known.get("results") or {}).get("warnings", []):
        found.setdefault(warning["rank"], []).append(warning["text"])
    found["result"] += review_of(run)
    return {rank: down_to(end, texts) for rank, texts in found.items()}
