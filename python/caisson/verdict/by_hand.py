# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene before its run: what hand methods say in the place of what is computed.

The program makes one step of the scene, so that run.json has the body and the layers as
it reads them. The columns of history.csv follow from the methods of design: Houlsby &
Byrne, DNV and Senders & Randolph, each of them with the strength of clay in clay. The
best estimate of each force is the mean of both cases of all of them; low and high are
the forces of the least and of the largest case, in soil of low and of high resistance.
The unified method, which is for piles long after driving, and Andersen et al., whose
range is a scatter, stand beside them only.

Suction s bears what the weight W does not. While the tip is in sand above any clay, it
takes from tip Q and inner friction F_i what Senders & Randolph say, else nothing:

    s = (R - W) / (A + (Q + F_i) / s_cr),  R = Q + F_i + F_o,  or  s = (R - W) / A.

Where flow is not steady, a share of v D / c_v of what it takes is left out, and all of
it from 1 on (custom; run_review.unsteady_flow).
High resistance takes no less than the high case of Houlsby & Byrne by their own flow:
where no suction below piping suffices for them, it ends there.

Half of the wall in the soil lifts the plug while the weight pushes it, and all of it
under suction (assumed); that the sand loosens is left out. By Darcy, with the
gradient of Houlsby & Byrne, k_f k (1 - a) s A / (gamma_w h) seeps through the plug,
which is k_f times as permeable as the ground.
"""
import functools
from collections.abc import Mapping
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from caisson.band import BEST, ESTIMATES, HIGH, LOW, member_of, why_not
from caisson.design import suction_installation as suction
from caisson.design.own_cone import DIAMETER
from caisson.design.houlsby_byrne import UNDISTURBED, HoulsbyByrne
from caisson.evaluation import BOILING, DEPTH, GRADIENT, HEAVE, SUCTION, TOTAL
from caisson.evaluation import UNDER_WEIGHT, heave_of_ledges
from caisson.results import Results, ResultsError, Table
from caisson.runner import query, set_options
from caisson.units import WATER
from caisson.verdict import suction_methods, theory

COLUMNS = dict(
    zip(("tip_force_N", "inner_friction_N", "outer_friction_N"), theory.PARTS)
)
DEEP = 20 * DIAMETER  # m, from where on a cone is deep
ROWS = 150  # over the way
STEP = {
    "Time/End time": "",
    "Output/Frame interval": "never",
    "Output/Frame penetrations": "",
}


def step(scene: Path, directory: Path, seconds: float = 0.0) -> None:
    """Let the program make the first steps of a scene, of so many seconds, or one of
    them, which leave run.json in a directory. Raises RunError with what it says where
    it refuses the scene, or fails."""
    entries = STEP | {"Time/End time": f"{max(seconds, 1e-9):g}"}
    query([str(scene), "--output-directory", str(directory), *set_options(entries)])


def answers_of(site: theory.Site, depth: np.ndarray) -> list[theory.Answer]:
    """Return the methods that count, with their forces of jacking at embedments [n]
    (m): none where the cone test of one of them ends above the deepest. An assumed cone
    does not count beside another method where it would not be deep, as beside a model.
    """
    methods = [x for x in theory.METHODS if x.in_mean or x == theory.OF_CLAY]
    found = [theory.answer_of(method, site, depth) for method in methods]
    known = [x for x in found if x.forces]
    if found[-1].forces:  # where there is clay: DNV counts with its strength
        known = [x for x in known if x.beside or x is found[-1]]
    if site.cone is None and depth.max() < DEEP:
        known = [x for x in known if not x.assumed] or known
    is_known = all(np.isfinite(x.band("total")).all() for x in known)
    return known if is_known else []


def forces_of(answers: list[theory.Answer], estimate: str) -> dict[str, np.ndarray]:
    """Return an estimate of the forces by part, [n] (N)."""
    parts = {part: np.array([a.band(part) for a in answers]) for part in theory.PARTS}
    if estimate == BEST:
        return {part: values.mean(axis=(0, 1)) for part, values in parts.items()}
    side = (LOW, HIGH).index(estimate)
    total = parts["total"][:, side]
    rows = total.argmin(axis=0) if estimate == LOW else total.argmax(axis=0)
    n = np.arange(total.shape[1])
    return {part: values[rows, side, n] for part, values in parts.items()}


def suction_of(
    forces: Mapping[str, np.ndarray], weight: float, area: float, critical: np.ndarray
) -> np.ndarray:
    """Return the suction [n] (Pa) that bears what a weight (N) does not, below 0 where
    that suffices. critical: s_cr [n] (Pa), infinite where flow takes nothing."""
    missing = forces["total"] - weight
    relieved = forces["tip"] + forces["inner friction"]
    loss = np.divide(
        relieved, critical, out=np.zeros_like(critical), where=critical > 0
    )
    found = missing / (area + loss)
    found = np.where(missing < 0, missing / area, found)
    # beyond s_cr neither tip nor inner friction is left
    return np.where(found > critical, (missing - relieved) / area, found)


class ByHand(Results):
    """A scene of which a directory has the run.json of a first step, or of a run, with
    a history by hand methods. Raises ResultsError where none of them knows the ground.
    """

    def __init__(
        self, directory: Path, estimate: str = BEST, facts: Mapping[str, str] = {}
    ) -> None:
        """facts: in the place of those in run.json, as the file of the scene, and
        beside them the cost of its run, and the command that is next."""
        super().__init__(directory)
        self.estimate, self.facts = estimate, facts
        self.by_hand = self.columns_at
        self.known_columns: dict[bytes, Table] = {}

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """run.json, without what only the one step, or a run, has changed or said."""
        found = dict(super().summary)
        entries = found.get("entries", {}).items()
        found["entries"] = {k: v for k, v in entries if k not in STEP}
        results = found.get("results") or {}
        said = [x for x in results.get("warnings", []) if x["rank"] != "result"]
        found["results"] = {"warnings": said}
        scene = found.get("scene") or {}
        found["scene"] = {k: v for k, v in scene.items() if k != "infeasible"}
        found["title"] = str(found.get("title") or "").partition(", on a mesh")[0]
        return found | {"written": ""} | dict(self.facts)

    @property
    def is_running(self) -> bool:
        """No: it has not begun."""
        return False

    @functools.cached_property
    def walls(self) -> Table:
        """No stresses are known."""
        return {}

    @functools.cached_property
    def site(self) -> theory.Site:
        """What the methods know."""
        return theory.site_of(self)

    @functools.cached_property
    def end(self) -> float:
        """The planned penetration (m)."""
        if self.planned is None:
            raise ResultsError("the scene has no Time/End penetration")
        return self.planned

    @functools.cached_property
    def sand_end(self) -> float:
        """The depth (m) down to which water flows around the tip."""
        return theory.flows_to(self.site, self.end)

    @functools.cached_property
    def byrne(self) -> HoulsbyByrne | None:
        """Houlsby & Byrne, whose flow it is; None where it does not apply."""
        try:
            site, cover = theory.below_cover(self.site)
            return theory.houlsby_byrne_of(site, self.sand_end - cover)
        except theory.NotApplicable:
            return None

    def forces_at(self, depth: np.ndarray) -> dict[str, np.ndarray]:
        """Return the forces of jacking at embedments [n] (m), by part (N). What applies
        is decided by the layers down to the end."""
        every = answers_of(self.site, np.append(depth, self.end))
        if not every:
            raise ResultsError(self.why_not())
        found = forces_of(every, self.estimate)
        return {part: values[:-1] for part, values in found.items()}

    def why_not(self) -> str:
        """Return why no method knows the forces."""
        every = theory.answers_of(self.site, np.array([self.end]))
        cone = self.site.cone
        if cone is None or cone.depth[-1] >= self.end:
            return theory.reasons_in_words(every)
        return (
            f"no hand method knows the sand below {cone.depth[-1]:g} m, where the cone"
            " test ends: set a Time/End penetration above it"
        )

    @functools.cached_property
    def rest(self) -> float | None:
        """The penetration by weight (m): where the resistance first is the weight; None
        where it is not down to the end."""
        tops = [theory.top_of(entry) for _, entry in self.site.layers(self.end)]

        def resistance(h: float) -> float:
            return float(self.forces_at(np.array([h]))["total"][0])

        found = suction.self_weight_penetration(resistance, self.weight, self.end, tops)
        return found if np.isfinite(found) else None

    def suction_at(
        self, depth: np.ndarray, forces: Mapping[str, np.ndarray]
    ) -> np.ndarray:
        """Return the required suction [n] (Pa), below 0 where the weight suffices."""
        area = pi / 4 * theory.skirt_of(self.site).inner_diameter ** 2
        critical, piping = suction_methods.flow_above_clay(self.site, depth)
        found = suction_of(forces, self.weight, area, critical)
        if self.estimate != HIGH or self.byrne is None:
            return found
        case = self.byrne, suction_methods.HIGH, self.weight
        cover = theory.below_cover(self.site)[1]
        for i in np.flatnonzero((depth > cover) & (depth <= self.sand_end)):
            at = float(depth[i]) - cover, self.site.unsteady
            most = suction_methods.by_byrne(*case, *at)
            found[i] = max(found[i], piping[i] if np.isnan(most) else most)
        return found

    def heave_at(self, depth: np.ndarray) -> np.ndarray:
        """Return the heave of the plug [n] (m), by the wall that goes into it."""
        skirt = theory.skirt_of(self.site)
        rest = self.end if self.rest is None or not self.weight else self.rest
        by_weight = UNDER_WEIGHT * np.minimum(depth, rest)
        share = skirt.tip_area / (pi / 4 * skirt.inner_diameter**2)
        by_tip = share * (by_weight + np.maximum(depth - rest, 0.0))
        return by_tip + heave_of_ledges(self, depth)

    def permeability_at(self, h: float) -> float:
        """Return the permeability (m/s) of the plug down to an embedment (m) below a
        thin cover of clay for the flow across its layers, 0 where one has none."""
        site, _ = theory.below_cover(self.site)
        layers = [entry for _, entry in site.layers(h)]
        tops = [theory.top_of(entry) for entry in layers]
        k = [float(entry.get("permeability_m_s") or 0) for entry in layers]
        if not all(k) or h <= 0:
            return 0.0
        return h / float(np.diff([*tops, h]) @ (1 / np.array(k)))

    def flow_at(self, depth: np.ndarray, required: np.ndarray) -> Table:
        """Return the exit gradient over the critical one, and the seepage (m3/s), under
        a suction [n] (Pa), 0 below the first clay; nothing where no water flows."""
        if self.byrne is None or not self.sand_end:
            return {}
        caisson = self.byrne.by_name[UNDISTURBED]
        ratio, flow, share = self.byrne.permeability_ratio, [], []
        flowing = np.where(depth <= self.sand_end, np.maximum(required, 0.0), 0.0)
        below = np.maximum(depth - theory.below_cover(self.site)[1], 0.0)
        for h, s in zip(map(float, below), flowing):
            left = 1 - suction.share_at_tip(caisson, h, ratio)
            gradient = left * s / (WATER * h) if h > 0 else 0.0
            area = suction.plug_area(caisson)
            flow.append(ratio * self.permeability_at(h) * gradient * area)
            piping = suction.piping_suction(caisson, h, ratio)
            share.append(s / piping if piping > 0 else 0.0)
        return {GRADIENT: np.array(share), "seepage_flow_m3_s": np.array(flow)}

    def boiling_at(self, depth: np.ndarray) -> Table:
        """Return the suction at which water boils beneath the lid, [n] (Pa): less than
        at the mudline by its height, and none high above the sea."""
        if (at_mudline := self.scene.get("boiling_suction_at_mudline_Pa")) is None:
            return {}
        height = float(self.scene.get("skirt_length_m") or 0) - depth
        found = float(at_mudline) - WATER * height
        return {BOILING: np.maximum(found, 0.0)}

    def columns_at(self, depth: np.ndarray) -> Table:
        """Return the columns of a history at embedments [n] (m), to be read only: many
        ask for the same ones."""
        key = depth.tobytes()
        if key not in self.known_columns:
            self.known_columns[key] = self.new_columns_at(depth)
        return dict(self.known_columns[key])

    def new_columns_at(self, depth: np.ndarray) -> Table:
        """Return what columns_at() has not answered yet."""
        forces = self.forces_at(depth)
        found = {DEPTH: depth, TOTAL: forces["total"]}
        found |= {column: forces[part] for column, part in COLUMNS.items()}
        if not self.weight:
            return found
        required = self.suction_at(depth, forces)
        found |= {SUCTION: required, HEAVE: self.heave_at(depth)}
        return found | self.flow_at(depth, required) | self.boiling_at(depth)

    @functools.cached_property
    def history(self) -> Table:
        """The columns from the mudline to the end, with a row where it rests."""
        depth = np.linspace(0.0, self.end, ROWS)
        rest = self.rest if self.weight else None
        if rest is not None:
            depth = np.union1d(depth, [rest])
        found = self.columns_at(depth)
        if SUCTION in found:
            found["suction_Pa"] = np.where(depth > (rest or 0.0), found[SUCTION], 0.0)
            found["suction_Pa"] = np.maximum(found["suction_Pa"], 0.0)
        return found | {"time_s": np.arange(len(depth), dtype=float)}


def band_of(members: Mapping[str, ByHand]) -> ByHand:
    """Return the best estimate of a scene with its band. members: the scene in soil of
    low, best and high resistance, of which low and high may be the best one's, as they
    are where the soil is not that of the band. Raises ResultsError."""
    best = members[BEST]
    for x, at in members.items():
        soil = ByHand(at.directory, BEST, at.facts)
        if x != BEST and (why := why_not(best, soil, x)):
            scene = Path(str(best.summary.get("scene_file")))
            best.left_out[x] = f"{member_of(scene, x).name} {why}"
    places = {x: at for x, at in members.items() if x not in best.left_out}
    best.estimates = {
        x: ByHand((at := places.get(x, best)).directory, x, at.facts) for x in ESTIMATES
    } | {BEST: best}
    return best
