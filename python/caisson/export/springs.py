# SPDX-License-Identifier: LGPL-2.1-or-later
"""Springs along the walls (t-z) and below the tip (q-z) of a caisson that a run has
pulled or pushed.

Displacement begins where the forces of the soil are in balance with the weight, so
that what the run does before, such as unloading, does not count. The resistance of a
spring is the change of its stress since then, against the motion: springs of a
structural program begin without a load, too. The soil is in the curves as a whole: its
slip at the wall and its deformation farther away.

Soil beyond the waves of the motion is at rest, and what the waves have reached is too
stiff. Around a skirt, the shear strain falls with 1 / r to the radius of influence of
Randolph & Wroth (1978), so that the stiffness goes with 1 / ln(1 + reach / radius),
where the reach is the way of a shear wave from the wall.

M. F. Randolph, C. P. Wroth (1978), Analysis of deformation of vertically loaded piles.
  J. Geotech. Eng. Div. ASCE 104, 1465-1488.
"""
import math
import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from caisson.verdict.loaded import LoadedRun
from caisson.units import GRAVITY, WATER_DENSITY
from caisson.paths import without_user
from caisson.results import ResultsError, Table
from caisson.export.state import POISSON, poisson_ratio, youngs_modulus

SAME = 1e-9  # m, of penetrations
SAME_ROW = 1e-6  # m, of heights on the wall
WALLS = ("inner", "outer")
WATER = ("suction_force_N", "tip_water_force_N")
SEGMENTS = 8  # of each wall
# of the diameter, at which the stiffness is stated
SMALL = (1e-4, 1e-3, 1e-2)
TOO_STIFF = 0.1  # by which waves that have not gone far may raise a stiffness
STILL_GROWS = 0.02  # of the force at the end, by which the last tenth raises it
# the wall, its mean depth (m), its area (m2) and its stress over time [n] (Pa)
Segment = tuple[str, float, float, np.ndarray]


@dataclass
class Spring:
    """A part of the body: its place ("inner", "outer", "tip" or "lid"), its mean depth
    where the displacement begins (m), its area (m2), its stress there (Pa, upward on
    the body), and its resistance at the displacements of the curve [n] (Pa)."""

    place: str
    depth: float
    area: float
    before: float
    resistance: np.ndarray

    @property
    def ultimate(self) -> float:
        """The largest resistance (Pa); 0 where there is none."""
        return max(0.0, float(self.resistance.max()))


@dataclass
class Springs:
    """All springs of a run.

    direction: 1 of a push, -1 of a pull. depth: of the tip where the displacement
    begins (m). walls: the areas of the walls above the tip there (m2). displacement:
    [n], from 0 (m). force: resistance of the whole body [n]
    (N). missing: the force by which the body is out of balance at the beginning (N).
    reach: how far a shear wave has gone since the motion began [n] (m), inf where the
    soil is not known, and nan where a law has no Young's modulus.
    """

    title: str
    direction: int
    depth: float
    diameter: float
    weight: float
    walls: dict[str, float]
    displacement: np.ndarray
    force: np.ndarray
    springs: list[Spring]
    missing: float
    reach: np.ndarray

    @property
    def needed_reach(self) -> float:
        """The way of a wave (m) from which on the stiffness is right but for
        TOO_STIFF."""
        influence = 2.5 * self.depth * (1 - POISSON)
        radius = self.diameter / 2
        return radius * ((1 + influence / radius) ** (1 / (1 + TOO_STIFF)) - 1)

    @property
    def reach_at_first(self) -> float:
        """How far a wave has gone (m) at the first of SMALL."""
        first = SMALL[0] * self.diameter
        return float(np.interp(first, self.displacement, self.reach))

    @property
    def growth(self) -> float:
        """By what the last tenth of the motion raises the resistance, over that at the
        end; of a hyperbola it is a tenth of what the end lacks of the ultimate."""
        before = np.interp(0.9 * self.displacement[-1], self.displacement, self.force)
        end = float(self.force[-1])
        return 1 - float(before) / end if end > 0 else 0.0

    def stiffness(self, share: float) -> float:
        """Return force over displacement at a share of the diameter (N/m), or nan
        where the run ends before."""
        at = share * self.diameter
        if at > self.displacement[-1]:
            return np.nan
        return float(np.interp(at, self.displacement, self.force)) / at


def last_motion(penetration: np.ndarray) -> tuple[int, int]:
    """Return the row [n] at which the last motion in one direction begins, and the
    direction: 1 down, -1 up. Raises ResultsError where there is none."""
    steps = np.diff(penetration)
    moved = np.flatnonzero(abs(steps) > SAME)
    if not len(moved):
        raise ResultsError("the body does not move in this run: pull or push it")
    direction = int(np.sign(steps[moved[-1]]))
    other = np.flatnonzero(direction * steps[: moved[-1] + 1] <= SAME)
    return (int(other[-1]) + 1 if len(other) else 0), direction


def rows_of_wall(walls: Table, times: np.ndarray) -> dict[float, Table]:
    """Return the rows of wall.csv at these times by their height over the tip; only of
    nodes that all of them have. Raises ResultsError where a time is missing."""
    if not walls:
        raise ResultsError(
            "the run has no wall.csv: only a body with walls has springs"
        )
    known = np.isin(times, walls["time_s"])
    if not known.all():
        raise ResultsError(
            f"wall.csv has no row at {times[~known][0]:g} s: run the scene again with"
            ' --set "Output/Walls at each record=true"'
        )
    chosen = np.isin(walls["time_s"], times)
    height = np.round((walls["penetration_m"] - walls["depth_m"]) / SAME_ROW) * SAME_ROW
    found = {}
    for one in np.unique(height[chosen]):
        row = chosen & (abs(height - one) < SAME_ROW / 2)
        if row.sum() == len(times):
            found[float(one)] = {name: values[row] for name, values in walls.items()}
    return found


def segments_of(walls: Table, times: np.ndarray, depth: float) -> list[Segment]:
    """Return the parts of the walls above a depth of the tip (m) and below the surface
    of the ground, each the mean of its nodes in wall.csv at these times."""
    rows = [(depth - h, row) for h, row in rows_of_wall(walls, times).items()]
    edges = np.linspace(0, depth, SEGMENTS + 1)
    found = []
    for wall in WALLS:
        for low, high in zip(edges[:-1], edges[1:]):
            if nodes := [(at, row) for at, row in rows if low < at <= high]:
                areas = np.array([row[f"{wall}_area_m2"][0] for _, row in nodes])
                stress = [row[f"{wall}_shear_stress_Pa"] for _, row in nodes]
                mean = float(np.average([at for at, _ in nodes], weights=areas))
                over_time = np.average(stress, axis=0, weights=areas)
                found.append((wall, mean, float(areas.sum()), over_time))
    return found


def begin_of(force: np.ndarray) -> tuple[int, float]:
    """Return the row and the share of the way to the next one at which the resistance
    [n] begins. Raises ResultsError where that is at the end."""
    idle = np.flatnonzero(force <= 0)
    if not len(idle):
        return 0, 0.0
    row = int(idle[-1])
    if row > len(force) - 3:
        raise ResultsError(
            "the force on the body does not pass its weight, at which the displacement"
            " begins: move it farther, or give another --weight"
        )
    return row, float(-force[row] / (force[row + 1] - force[row]))


def speed_of_tolerance(run: LoadedRun) -> float:
    """Return the speed (m/s) to which the inertia tolerance refers, the largest of the
    velocity table, which the run need not reach."""
    history, entry = run.results.history, run.results.entry
    steps = np.diff(history["penetration_m"]) / np.diff(history["time_s"])
    speeds = [*abs(steps)]
    # which slows the table down
    if entry("Rigid body/Largest Mach number") in ("", "unlimited"):
        table = entry("Rigid body/Velocity table")
        speeds += [abs(float(v)) for v in re.findall(r":\s*([^,\s]+)", table)]
    return float(max(speeds))


def shear_modulus(layers: list[dict[str, Any]], depth: float) -> float:
    """Return the shear modulus (Pa) of the softest layer above a depth (m); nan where
    the law of one has none. Materials of one layer, whose numbers change with depth,
    count by their thickness."""
    bottoms = [*(float(layer["top_depth_m"]) for layer in layers[1:]), depth]
    sums = dict[int, tuple[float, float]]()
    for layer, bottom in zip(layers, bottoms):
        height = bottom - float(layer["top_depth_m"])
        modulus = youngs_modulus(layer) / (2 * (1 + poisson_ratio(layer)))
        total, part = sums.get(layer.get("layer", 1), (0.0, 0.0))
        sums[layer.get("layer", 1)] = total + height * modulus, part + height
    return float(np.min([total / part for total, part in sums.values()]))


def wave_velocity(run: LoadedRun, depth: float) -> float:
    """Return the velocity of shear waves (m/s) in the softest layer above a depth of
    the tip (m), with the mass scaling or the inertia tolerance of the run; inf where
    the layers are not known, and nan where a law has no Young's modulus."""
    layers = run.results.scene.get("layers") or []
    layers = [layer for layer in layers if layer["top_depth_m"] < depth]
    if not layers:
        return math.inf
    shear = shear_modulus(layers, depth)
    weights = [float(layer["submerged_unit_weight_N_m3"]) for layer in layers]
    density = max(weights) / GRAVITY + WATER_DENSITY
    entries = run.results.summary.get("entries", {})
    inertia = density * float(entries.get("Time/Mass scaling", 1))
    if (tolerance := entries.get("Time/Inertia tolerance", "none")) != "none":
        tops = [*(float(layer["top_depth_m"]) for layer in layers), depth]
        stress = float(np.dot(weights, np.diff(tops)))
        speed = speed_of_tolerance(run)
        inertia = max(density, float(tolerance) * stress / speed**2)
    return math.sqrt(shear / inertia)


def springs_of(run: LoadedRun, weight: float) -> Springs:
    """Return the springs of the last motion of a run, for a submerged weight (N) of
    the caisson. Raises ResultsError where there are none."""
    history, scene = run.results.history, run.results.scene
    if "diameter_m" not in scene:
        raise ResultsError(f"{run.directory} is not a finished run of a caisson")
    if any(history[name].any() for name in WATER if name in history):
        raise ResultsError(
            f"in {run.directory} water presses on the caisson: springs of its walls and"
            " tip are a part of the force only. Take a drained run"
        )
    depth = history["penetration_m"]
    first, direction = last_motion(depth)
    if len(depth) < first + 5:
        raise ResultsError(
            f"the last motion has {len(depth) - first - 1} records, too few: set"
            " Output/Record interval to a hundredth of its time"
        )
    table = {name: values[first + 1 :] for name, values in history.items()}
    # a record is the mean since the one before: its place is in the middle
    middle = (depth[first:-1] + depth[first + 1 :]) / 2
    force = direction * (table["total_force_N"] - weight)
    begin, share = begin_of(force)

    def curve(values: np.ndarray) -> tuple[float, np.ndarray]:
        """Return the value where the displacement begins, and its change."""
        before = float(values[begin] + share * (values[begin + 1] - values[begin]))
        return before, direction * (np.append(before, values[begin + 1 :]) - before)

    at, displacement = curve(middle)
    times = (history["time_s"][first:-1] + history["time_s"][first + 1 :]) / 2
    passed = direction * curve(times)[1] + curve(times)[0] - history["time_s"][first]
    springs = [
        Spring(wall, mean_depth, area, *curve(stress))
        for wall, mean_depth, area, stress in segments_of(
            run.results.walls, table["time_s"], at
        )
    ]
    outer = scene["diameter_m"] / 2
    inner = outer - scene["wall_thickness_m"]
    for place, area in (("tip", outer**2 - inner**2), ("lid", inner**2)):
        if (values := table[f"{place}_force_N"]).any():
            stress = curve(values / (np.pi * area))
            springs.append(Spring(place, at * (place == "tip"), np.pi * area, *stress))
    return Springs(
        f"{run.summary.get('title') or 'a run'}, {without_user(run.directory)}",
        direction,
        at,
        scene["diameter_m"],
        weight,
        {w: 2 * np.pi * r * at for w, r in zip(WALLS, (inner, outer))},
        displacement,
        curve(table["total_force_N"])[1],
        springs,
        float(max(force[begin], 0.0)),
        wave_velocity(run, at) * passed,
    )
