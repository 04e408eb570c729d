# SPDX-License-Identifier: LGPL-2.1-or-later
"""A caisson that water beneath its lid pushes out: the overpressure that it takes at
each depth of the way up, and the least of what the ground and the wall allow
(design/retrieval)."""
from typing import Any, NamedTuple

import numpy as np

from caisson import evaluation
from caisson.curves import way_up
from caisson.design import retrieval
from caisson.evaluation import DEPTH, SUCTION
from caisson.results import Results
from caisson.verdict import limits, suction_methods, theory
from caisson.verdict.installation import around_tops, plug_area

SUCTION_COLUMN = "suction_Pa"
SET_UP = "Factor on set-up"
LEAST = 1.0  # Pa; less is no overpressure


class Retrieval(NamedTuple):
    """Depths [n] (m) on the way up, the required overpressure there and the limits of
    it by their names, [n] each (Pa); the area inside (m2), and the factor of set-up on
    the friction that is in the required one."""

    depth: np.ndarray
    required: np.ndarray
    limits: dict[str, np.ndarray]
    area: float
    set_up: float = 1.0

    @property
    def allowable(self) -> np.ndarray:
        """The least limit, [n]; infinite without any."""
        return limits.least_of(self.limits, len(self.depth))

    @property
    def missing(self) -> np.ndarray:
        """What a crane has to take, [n] (N)."""
        return np.maximum(self.required - self.allowable, 0) * self.area

    @property
    def most(self) -> int:
        """The row of the largest required overpressure."""
        return int(np.argmax(self.required))

    @property
    def share(self) -> np.ndarray:
        """The required overpressure over the allowable one, [n]; 0 where none is
        required."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.nan_to_num(self.required / self.allowable, posinf=np.inf)

    @property
    def worst(self) -> int:
        """The row where a crane has to take most or, where water suffices, where it is
        nearest to what is allowed."""
        return int(np.argmax(self.missing if self.missing.any() else self.share))

    def governing(self, i: int) -> str:
        """Return the name of the least limit of a row, or nothing."""
        return limits.governing(self.limits, i)

    def rows(self) -> list[dict[str, Any]]:
        """Return the rows for verdict.json."""
        return [
            {
                DEPTH: float(h),
                "required_overpressure_Pa": float(self.required[i]),
                "allowable_overpressure_Pa": float(self.allowable[i]),
                "governed_by": self.governing(i),
            }
            for i, h in enumerate(self.depth)
        ]


def is_retrieval(run: Results) -> bool:
    """Return whether an overpressure beneath the lid pushes the body up."""
    pressure = run.history.get(SUCTION_COLUMN)
    is_pushed = pressure is not None and bool(pressure.min() < -LEAST)
    return is_pushed and not evaluation.is_sealed(run) and evaluation.is_pull(run)


def limits_of(run: Results, at: np.ndarray) -> dict[str, np.ndarray]:
    """Return the limits of the overpressure (Pa) at depths [n]; none where the ground
    or the wall is not known."""
    site, deepest = theory.site_of(run), float(at.max())
    layers, wall = suction_methods.known_layers_of(site, deepest), limits.wall_of(run)
    ratios = [entry.get("K0") for _, entry in site.layers(np.inf)][: len(layers)]
    if not layers or wall is None or None in ratios:
        return {}
    known = [float(ratio) for ratio in ratios if ratio is not None]
    assumed = theory.assumptions_of(site.scene).plug_permeability_ratio
    return retrieval.allowable(theory.skirt_of(site), layers, known, wall, at, assumed)


def retrieval_of(run: Results) -> Retrieval | None:
    """Return the retrieval of a run, at multiples of half a meter or of less on a short
    way and around the tops of layers; None where nothing is retrieved."""
    if not is_retrieval(run):
        return None
    way = evaluation.way_of(run, way_up(run.history[DEPTH])[1:])
    at_most = way.largest(-way.columns[SUCTION])[1]
    rows = -evaluation.depths_of(-way.depth)
    tops = around_tops(run, float(way.depth.min()), float(way.depth.max()))
    at = np.union1d(rows, np.append(tops, at_most))
    factor = limits.number_of(run, SET_UP)
    friction = -sum(way.mean(f"{side}_friction_N", at) for side in ("inner", "outer"))
    area = plug_area(run.scene)
    set_up = (factor - 1) * friction / area
    required = np.maximum(set_up - way.mean(SUCTION, at), 0)
    return Retrieval(at, required, limits_of(run, at), area, factor)
