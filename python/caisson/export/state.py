# SPDX-License-Identifier: LGPL-2.1-or-later
"""The state of the soil at one frame: points with stress, layers, wall and forces."""
from dataclasses import dataclass
from typing import Any

import numpy as np

from caisson.frame import Arrays, Frame
from caisson.verdict.loaded import LoadedRun
from caisson.results import ResultsError, Table

STRESS = ("rr", "zz", "tt", "rz")  # the order of the components, in frames too
# fields that other ones contain, or that are no state of the soil
LEFT_OUT = {"id", "velocity_m_s", "whole_volume_m3", "material", "displacement_m"}
LEFT_OUT |= {"mean_stress_Pa", "deviator_Pa"}
# these follow from the exported stress (files.py)
LEFT_OUT |= {"vertical_effective_stress_kPa", "vertical_stress_over_stress_at_rest"}
TOLERANCE = 1e-6  # m
# Young's modulus over the norm of the stress, of soil whose law has none
STIFFNESS = 1e3
POISSON = 0.3  # of soil whose law does not say it


@dataclass
class Wall:
    """The wall of a rigid body in the ground (m).

    inner, outer: radii; inner is 0 of a body without a plug. profile_r, profile_z: the
    lower end, from the inside to the outside. shoulder: where the vertical walls end.
    """

    inner: float
    outer: float
    profile_r: np.ndarray
    profile_z: np.ndarray

    @property
    def shoulder(self) -> float:
        """The height of the lower end of the vertical walls."""
        ends = self.profile_z[[0, -1]] if self.inner > 0 else self.profile_z[[-1]]
        return float(ends.max())

    @property
    def tip(self) -> float:
        """The height of the lowest point."""
        return float(self.profile_z.min())

    @property
    def middle(self) -> float:
        """The radius of the lowest point: the barrier stands there."""
        lowest = self.profile_r[self.profile_z < self.tip + TOLERANCE]
        return float(lowest.mean())

    def lower_end(self, r: np.ndarray) -> np.ndarray:
        """Return the height of the lower end at radii within the wall."""
        return np.interp(r, self.profile_r, self.profile_z)

    def contains(self, points: np.ndarray) -> np.ndarray:
        """Return whether points lie in the wall or above it: [n]."""
        r, z = points.T
        return (r > self.inner) & (r < self.outer) & (z > self.lower_end(r))


@dataclass
class Layer:
    """A layer of soil: its number in the scene, its submerged unit weight (N/m3) and
    Young's modulus (Pa), means over its points, and the depth of its top (m).
    assumed: its law has no Young's modulus, so that this one follows its stress.
    total: its stress is the total one less the hydrostatic pressure, and its pore
    pressure is not known."""

    number: int
    unit_weight: float
    youngs_modulus: float
    top: float = 0.0
    assumed: bool = False
    total: bool = False


@dataclass
class State:
    """The points of a frame, and what acts on them.

    position [n, 2] (m), stress [n, 4] (Pa, effective, or total in layers that say so,
    tension positive), volume [n] (m3, whole circumference), pressure [n] (Pa, excess,
    compression positive; None where none is computed), fields: other values [n] by
    name, displacement [n, 2] (m), layer [n]: index in layers, unit_weight [n] (N/m3).
    forces: of the soil on the body at that time (N, upward), by their columns in
    history.csv; empty where the run has none yet. surcharge: on the surface (Pa).
    suction: beneath the lid (Pa).
    outer_radius, bottom: of the domain of the run (m).
    """

    title: str
    time: float
    penetration: float
    position: np.ndarray
    stress: np.ndarray
    volume: np.ndarray
    pressure: np.ndarray | None
    displacement: np.ndarray
    fields: Arrays
    layer: np.ndarray
    unit_weight: np.ndarray
    layers: list[Layer]
    wall: Wall | None
    forces: dict[str, float]
    outer_radius: float
    bottom: float
    surcharge: float = 0.0
    suction: float = 0.0

    @property
    def lid_pressure(self) -> float:
        """The mean pressure of the lid on the plug (Pa)."""
        if self.wall is None or not self.wall.inner:
            return 0.0
        return self.forces.get("lid_force_N", 0.0) / (np.pi * self.wall.inner**2)

    def at_rest(self, z: np.ndarray) -> np.ndarray:
        """Return the vertical stress of the ground before the body came, at heights
        [n] (m), positive in compression: [n] (Pa)."""
        layers = sorted(self.layers, key=lambda layer: layer.top)
        tops = [layer.top for layer in layers]
        stress = np.full(len(z), self.surcharge)
        for layer, end in zip(layers, [*tops[1:], np.inf]):
            stress += layer.unit_weight * np.clip(-z - layer.top, 0, end - layer.top)
        return stress


def wall_of(frame: Frame) -> Wall | None:
    """Return the wall, from the body of the frame or else the cells that it fills;
    None where no part of it is below the surface."""
    if frame.body is not None:
        from caisson.vtu import positions_of

        corners = positions_of(frame.body)
    else:
        corners = frame.corners[frame.cell_data["material_id"] == 1].reshape(-1, 2)
    if not len(corners) or corners[:, 1].min() > -TOLERANCE:
        return None
    r = np.unique(corners[:, 0].round(6))
    z = np.array([corners[abs(corners[:, 0] - x) < 2e-6, 1].min() for x in r])
    if r[0] < TOLERANCE:
        return Wall(0.0, float(r[-1]), r, z)
    return Wall(float(r[0]), float(r[-1]), r, z)


def forces_at(history: Table, time: float) -> dict[str, float]:
    """Return the forces on the body at a time: the means of the row that contains it.
    None where they are all zero, as in the first row."""
    times = history["time_s"]
    row = int(np.searchsorted(times, time - 1e-6 * max(1.0, time)))
    row = min(row, len(times) - 1)
    names = [n for n in history if n.endswith(("_force_N", "friction_N"))]
    forces = {name: float(history[name][row]) for name in names}
    return forces if any(forces.values()) else {}


def poisson_ratio(layer: dict[str, Any]) -> float:
    """Return Poisson's ratio of the law of a layer in run.json, or POISSON where it has
    none."""
    entries = {one["entry"]: one["value"] for one in layer.get("law_entries", [])}
    known = layer.get("poisson_ratio", entries.get("Poisson ratio", POISSON))
    return float(known)


def youngs_modulus(layer: dict[str, Any]) -> float:
    """Return Young's modulus (Pa) of a layer in run.json, nan where its law has none.
    That of a user material follows from the p-wave modulus of DDSDDE at the start."""
    if "p_wave_modulus_Pa" in layer:
        nu = poisson_ratio(layer)
        ratio = (1 + nu) * (1 - 2 * nu) / (1 - nu)
        return ratio * float(layer["p_wave_modulus_Pa"])
    return float(layer.get("youngs_modulus_Pa", np.nan))


def layers_of(
    scene: dict[str, Any], data: Arrays, volume: np.ndarray, stress: np.ndarray
) -> tuple[np.ndarray, np.ndarray, list[Layer]]:
    """Return for each point the index of its layer [n] and its unit weight [n] (N/m3),
    and the layers. A point keeps its mass: its weight follows its void ratio."""
    known = scene.get("layers")
    if not known:
        raise ResultsError(
            "run.json does not list the layers of the soil: only runs of a caisson are"
            " exported, not those of a pile, a cone or soil alone. Run the scene of a"
            " caisson again if it has not finished, or is of an earlier version"
        )
    material = data["material"].astype(int)
    numbers = np.array([one["layer"] for one in known])[material]
    weight = np.array([one["submerged_unit_weight_N_m3"] for one in known])[material]
    n = np.array([one["porosity"] for one in known])[material]
    void = data["void_ratio"].astype(float) if "void_ratio" in data else n / (1 - n)
    with np.errstate(invalid="ignore"):
        ratio = np.where(void > 0, (1 + n / (1 - n)) / (1 + void), 1.0)
    given = np.array(list(map(youngs_modulus, known)))[material]
    assumed = np.isnan(given)
    modulus = np.where(assumed, STIFFNESS * np.linalg.norm(stress, axis=1), given)
    which, index = np.unique(numbers, return_inverse=True)
    layers = [
        Layer(
            int(number),
            float(np.average((weight * ratio)[index == i], weights=volume[index == i])),
            float(np.average(modulus[index == i], weights=volume[index == i])),
            min(one["top_depth_m"] for one in known if one["layer"] == number),
            bool(assumed[index == i].any()),
            any(one.get("total_stress") for one in known if one["layer"] == number),
        )
        for i, number in enumerate(which)
    ]
    return index, weight * ratio, layers


def read_state(run: LoadedRun, frame: Frame) -> State:
    """Return the state of a frame. Raises ResultsError where something is missing."""
    entries = run.summary.get("entries", {})
    if entries.get("Grid/Geometry", "axisymmetric") != "axisymmetric":
        raise ResultsError(
            f"{run.directory} is in plane strain: only axisymmetric runs"
        )
    data = frame.point_data
    needed = {"whole_volume_m3", "material", "displacement_m"}
    if missing := sorted(needed - data.keys()):
        raise ResultsError(
            f"{run.directory} has no {missing[0]} in its frames: run the scene again"
            " with this version"
        )
    position = frame.positions
    volume = data["whole_volume_m3"].astype(float)
    stress = data["stress_Pa"][:, : len(STRESS)].astype(float)
    index, weight, layers = layers_of(run.results.scene, data, volume, stress)
    pressure = data.get("pore_pressure_Pa")
    fields = {
        name: values.astype(float)
        for name, values in data.items()
        if values.ndim == 1
        and name not in LEFT_OUT
        and not name.startswith(("stress_", "pore_pressure"))
    }
    history = run.results.history
    suction = history.get("suction_Pa", np.zeros(len(history["time_s"])))
    return State(
        title=run.results.title,
        time=frame.time,
        penetration=frame.penetration,
        position=position,
        stress=stress,
        volume=volume,
        pressure=None if pressure is None else pressure.astype(float),
        displacement=data["displacement_m"][:, :2].astype(float),
        fields=fields,
        layer=index,
        unit_weight=weight,
        layers=layers,
        wall=wall_of(frame),
        forces=forces_at(history, frame.time),
        outer_radius=float(frame.corners[..., 0].max()),
        bottom=float(frame.corners[..., 1].min()),
        surcharge=float(entries.get("Soil/Surcharge", 0)),
        suction=float(np.interp(frame.time, history["time_s"], suction)),
    )
