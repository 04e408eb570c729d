# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a run: those of its ways down and up at depths, where suction acts, and
the largest pull. verdict/outcome.py has what came out of a run.

All of them follow from history.csv. They are means of curves.smoothed_at(), except the
largest pull: that is the largest median over neighboring rows of a way up.
"""
from typing import Any, NamedTuple

import numpy as np

from caisson import curves, run_error_bar
from caisson.results import Results, Table

INTERVAL = 0.5  # m, between the depths
LEAST_RISE = 1e-3  # m, below which a way up says nothing
DEPTH, TOTAL, SUCTION = "penetration_m", "total_force_N", "required_suction_Pa"
HEAVE, ROOM, BOILING = "plug_heave_m", "room_below_lid_m", "cavitation_suction_Pa"
EXPECTED_HEAVE = "expected_heave_m"
UNDER_WEIGHT = 0.5  # of the wall goes into the plug, and all of it under suction
OPEN = 0.5  # of the way of a ring in clay
GRADIENT = "exit_gradient_over_critical"
COLUMNS = (
    "tip_force_N",
    "inner_friction_N",
    "outer_friction_N",
    TOTAL,
    curves.WITH_WATER,
    "suction_Pa",
    SUCTION,
    BOILING,
    "seepage_flow_m3_s",
    HEAVE,
)
FEW = 25  # rows of a way up, with fewer of which a median is over three of them
FRICTION_RISE = 5e-3  # m, which mobilizes friction
# of the rise to the largest pull: how much further a capacity is followed, and the
# part of it at which the pull is nearly reached
FURTHER, BEFORE, NEARLY = 0.2, 0.7, 0.93
ON_LID = 0.01  # of the resistance, from which on the lid bears on the soil
LEAST_HELD = 0.02  # of all of the way, over which suction must act to count
LITTLE, JUMP = 0.1, 0.1  # of a pull


class Way(NamedTuple):
    """The rows of a way down or up: their depths [n] (m) and columns [n]."""

    depth: np.ndarray
    columns: Table

    def mean(self, name: str, at: np.ndarray) -> np.ndarray:
        """Return the means of a column at depths [m] (m): [m]."""
        return curves.smoothed_at(self.depth, self.columns[name], at)

    def largest(self, values: np.ndarray) -> tuple[float, float]:
        """Return the largest mean of values [n], and its depth (m)."""
        at = np.concatenate([depths_of(self.depth), self.depth])
        means = curves.smoothed_at(self.depth, values, at)
        return float(means.max()), float(at[np.argmax(means)])


def multiples_of(position: np.ndarray, interval: float = INTERVAL) -> np.ndarray:
    """Return the multiples of the interval (m) that a growing curve passes after its
    start, or the rounder ones of curves.round_depths() where it is shorter than two of
    them."""
    if np.ptp(position) < 2 * interval:
        return curves.round_depths(position)
    found = curves.common_depths([position], interval)
    return found[found > position.min() + 1e-6 * interval]


def depths_of(position: np.ndarray, interval: float = INTERVAL) -> np.ndarray:
    """Return the same depths, and the end of the way down."""
    found = multiples_of(position, interval)
    end = float(position.max())
    near = 2e-3 * (found[1] - found[0] if len(found) > 1 else interval)
    if len(found) and end - found[-1] <= near:
        return found
    return np.append(found, end)


def heave_of_wall(run: Results, depth: np.ndarray, required: np.ndarray) -> np.ndarray:
    """Return the heave of the plug by the wall [n] (m) at depths on the way down [n]
    (m): half of it goes into the plug under the weight, and all of it under a required
    suction [n] (Pa) (DNV-RP-E303). 0 where the sizes are not known."""
    outer, wall = (run.scene.get(x) for x in ("diameter_m", "wall_thickness_m"))
    if not outer or not wall:
        return np.zeros(len(depth))
    share = (float(outer) / (float(outer) - 2 * float(wall))) ** 2 - 1
    part = np.where(required > 0, 1.0, UNDER_WEIGHT)
    by_tip = share * np.cumsum(part * np.diff(depth, prepend=0.0))
    return by_tip + heave_of_ledges(run, depth)


def heave_of_ledges(run: Results, depth: np.ndarray) -> np.ndarray:
    """Return the heave of the plug by the ledges inside [n] (m) at embedments [n] (m):
    by the steel above them that is in the soil or, if that is more, by half of their
    way in clay, which leaves a gap above a ring (custom; 0.4 to 0.5 in a run)."""
    layers = run.scene.get("layers", [run.scene])
    tops = [float(layer.get("top_depth_m") or 0) for layer in layers]
    ends, volume = zip(tops, [*tops[1:], np.inf]), np.zeros(len(depth))
    clays = [x for x, layer in zip(ends, layers) if not layer.get("friction_angle_deg")]
    for ledge in (x for x in run.ledges if x.is_inside):
        below = np.maximum(depth - ledge.height, 0.0)
        open_in = (np.clip(below, top, bottom) - top for top, bottom in clays)
        steel = np.minimum(below, ledge.steel)
        volume += ledge.area * np.maximum(OPEN * sum(open_in), steel)
    inner = [float(run.scene[x]) for x in ("diameter_m", "wall_thickness_m")]
    return volume / (np.pi / 4 * (inner[0] - 2 * inner[1]) ** 2)


def way_of(run: Results, rows: np.ndarray) -> Way:
    """Return a way along rows of history.csv."""
    history = run.history
    columns = {name: history[name][rows] for name in COLUMNS if name in history}
    depth = history[DEPTH][rows]
    if SUCTION in history:
        if "critical_gradient" in history:  # not in clay
            columns[GRADIENT] = curves.gradient_share(history)[rows]
        if length := run.scene.get("skirt_length_m"):
            by_wall = heave_of_wall(run, depth, columns[SUCTION])
            columns[EXPECTED_HEAVE] = np.maximum(columns[HEAVE], by_wall)
            columns[ROOM] = float(length) - depth - columns[EXPECTED_HEAVE]
    return Way(depth, columns)


def way_down(run: Results) -> Way:
    """Return the way down without the row where it begins."""
    return way_of(run, curves.way_down(run.history[DEPTH])[1:])


def at_depths(run: Results, at: np.ndarray | None = None) -> Table:
    """Return the numbers of the way down at depths (m), or at each half meter and at
    the end, with the bounds of those that have an error bar: columns [n]; empty without
    a way down."""
    if DEPTH not in run.history or len((way := way_down(run)).depth) < 2:
        return {}
    at = depths_of(way.depth) if at is None else at
    if run.by_hand:
        return run.by_hand(at)
    means = {name: way.mean(name, at) for name in way.columns}
    return {DEPTH: at, **means, **run_error_bar.at_depths(run, at, means)}


def rows_of(table: Table) -> list[dict[str, float]]:
    """Return a table by its rows, without what is no number."""
    rows = (dict(zip(table, map(float, row))) for row in zip(*table.values()))
    return [{k: v for k, v in row.items() if np.isfinite(v)} for row in rows]


def changes_of_suction(history: Table) -> list[float]:
    """Return the penetrations (m) from which on suction acts, acts no longer, acts
    again, and so on. A change for a short way does not count, but for one at the end.
    """
    depth, acts = history[DEPTH], history["suction_Pa"] > 0
    least, starts = LEAST_HELD * np.ptp(depth), np.flatnonzero(np.diff(acts)) + 1
    for first, end in zip([0, *starts], [*starts, len(depth)]):
        is_last = end == len(depth) and acts[first]
        if depth[end - 1] - depth[max(first - 1, 0)] < least and not is_last:
            acts[first:end] = acts[first - 1] if first else False
    changes = np.flatnonzero(np.diff(acts))
    begins = [float(depth[0])] if acts[0] else []
    return begins + [float(depth[i]) for i in changes]


def rest_of_run(history: Table) -> float | None:
    """Return the penetration by weight alone (m), where suction begins; None where
    there is none, or where it acts from the first row on."""
    changes = changes_of_suction(history)
    return changes[0] if changes and changes[0] > history[DEPTH][0] else None


def rest_of(run: Results) -> float | None:
    """Return the penetration by weight alone (m), that of a run or by hand methods."""
    return run.rest if run.by_hand else rest_of_run(run.history)


def sinks_on(history: Table) -> list[tuple[float, float]]:
    """Return the ways (m) below the penetration by weight over which the weight
    suffices again: there the caisson sinks on by itself."""
    changes = [*changes_of_suction(history), float(history[DEPTH][-1])]
    return list(zip(changes[1::2], changes[2::2]))


def lid_contact(history: Table) -> tuple[float, float] | None:
    """Return the depth (m) from which on the lid bears on the soil on the way down, and
    its force at the end (N); None where it does not."""
    rows = curves.way_down(history[DEPTH])[1:]
    if "lid_force_N" not in history or not len(rows):
        return None
    bears = history["lid_force_N"][rows] > ON_LID * history[TOTAL][rows]
    if not bears[-1]:
        return None
    first = rows[np.flatnonzero([True, *~bears])[-1]]  # after the last that does not
    return float(history[DEPTH][first]), float(history["lid_force_N"][rows[-1]])


def pump_limit(run: Results) -> float | None:
    """Return Water/Largest suction in kPa, None without one."""
    try:
        return float(run.entry("Water/Largest suction")) / 1e3
    except ValueError:
        return None


def is_sealed(run: Results) -> bool:
    """Return whether no pump takes water from beneath the lid."""
    return "lid_water_balance" in run.history


def is_pull(run: Results) -> bool:
    """Return whether a run is about the pull: whether the body ends higher than it
    began, or rises with a sealed lid, as in cycles."""
    depth = run.history.get("penetration_m", np.zeros(1))
    rises = bool((np.diff(depth) < 0).any())
    return bool(depth[-1] < depth[0]) or (is_sealed(run) and rises)


def medians(pull: np.ndarray) -> np.ndarray:
    """Return the pull [n] of each row of a way up as the lower median over it and two
    rows on either side, one where there are few rows: a single jump does not count."""
    beside = 1 if len(pull) < FEW else 2
    near = (pull[max(i - beside, 0) : i + beside + 1] for i in range(len(pull)))
    return np.array([np.sort(x)[(len(x) - 1) // 2] for x in near])


class Pull(NamedTuple):
    """A way up: the row before it, the pull of its rows, and the medians over it."""

    begin: int
    pull: np.ndarray
    medians: np.ndarray

    @property
    def most(self) -> int:
        """The row of the largest median, or the nearest one that bears it where that
        row bears another pull, as a mean over the turn of the motion does."""
        center = int(np.argmax(self.medians))
        most = self.medians[center]
        if abs(self.pull[center] - most) > JUMP * most:
            rows = np.flatnonzero(self.pull == most)
            center = int(rows[np.argmin(np.abs(rows - center))])
        return self.begin + 1 + center


def pulls_of(pull: np.ndarray, depth: np.ndarray) -> list[Pull]:
    """Return all ways up. pull, depth: [n_rows]."""
    rises = np.concatenate([[False], np.diff(depth) < 0, [False]])
    ends = np.flatnonzero(np.diff(rises.astype(int)))
    return [
        Pull(int(begin), way, medians(way))
        for begin, end in zip(ends[::2], ends[1::2])
        for way in [pull[begin + 1 : end + 1]]
    ]


def is_capacity(way: Pull, depth: np.ndarray) -> bool:
    """Return whether friction is mobilized, and the pull does not increase: the body
    has risen further by a fifth, or bore nearly as much before."""
    rises = depth[way.begin] - depth[way.begin + 1 :][: len(way.medians)]
    rise, end = rises[way.most - way.begin - 1], rises[-1]
    if end < FRICTION_RISE:
        return False
    if end - rise > max(FURTHER * rise, FRICTION_RISE):
        return True
    before = way.medians[rises <= BEFORE * rise]
    return bool(
        rise >= FRICTION_RISE
        and len(before)
        and before.max() > NEARLY * way.medians.max()
    )


def mechanism_of(history: Table, most: int, growth: dict[str, float]) -> str:
    """Return how a caisson with a sealed lid fails, by what has filled the space
    beneath it up to a row. growth: of columns on the way up, in m3."""
    if history["lid_cavity_m3"][most] > 0:
        return "cavitation beneath the lid"
    pull = -history.get(curves.WITH_WATER, history[TOTAL])[most]
    if pull + history[TOTAL][most] < LITTLE * pull:
        return "drained: friction on both walls"
    ways = {
        "plug_rise_m3": "reverse bearing: the plug rises with the caisson",
        "seepage_volume_m3": "water flows in through the plug",
        "lid_leak_m3": "water flows in through the leak",
        "lid_expansion_m3": "what is beneath the lid expands",
    }
    largest = max(ways, key=lambda name: growth[name])
    mark = "" if largest == "plug_rise_m3" else "partly drained: passive suction, and "
    return mark + ways[largest]


def largest_pull(history: Table) -> dict[str, Any]:
    """Return the largest pull over the rows in which the body rises, and what bears it;
    empty where nothing pulls. Forces are upward on the soil, and contain no weight."""
    force = history.get(curves.WITH_WATER, history[TOTAL])
    depth = history[DEPTH]
    ways = [way for way in pulls_of(-force, depth) if way.medians.max() > 0]
    if not ways:
        return {}
    way = max(ways, key=lambda way: float(way.medians.max()))
    most = way.most
    found: dict[str, Any] = {
        "pull_N": -float(force[most]),
        DEPTH: float(depth[most]),
        "rise_m": float(depth[way.begin] - depth[most]),
        "water_N": float(history[TOTAL][most] - force[most]),
        "outer_friction_N": -float(history["outer_friction_N"][most]),
        "inner_friction_N": -float(history["inner_friction_N"][most]),
        "tip_N": -float(history["tip_force_N"][most]),
        "is_capacity": is_capacity(way, depth),
    }
    if "lid_growth_m3" in history:
        growth = {
            name: float(values[most] - values[way.begin])
            for name, values in history.items()
            if name.endswith("_m3")
        }
        found["plug_follows"] = growth["plug_rise_m3"] / growth["lid_growth_m3"]
        if found["is_capacity"]:
            found["mechanism"] = mechanism_of(history, most, growth)
    return found
