# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the design methods say of the resistance in the scene of a run, where they
hold, and why not where they do not.

Layers that the tip does not reach do not count.
"""
import functools
import itertools
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple, cast

import numpy as np

from caisson.density_law import BY_DENSITY
from caisson.verdict.run_review import unsteady_flow
from caisson.results import Results, ResultsError
from caisson.template import say
from caisson.design import andersen, assumed, clay, dnv, houlsby_byrne, layered
from caisson.design import senders_randolph, unified
from caisson.design.assumed_cone import STEP, Sand, SandGround, assumed_cone
from caisson.design.cone import ConeMethod, Profile, Skirt, of_run
from caisson.design.houlsby_byrne import UNDISTURBED, Assumptions, HoulsbyByrne, Layer
from caisson.design.method import Method
from caisson.ledges import FLUSH, ledges_of

Scene = Mapping[str, Any]
SENTENCES = Path(__file__).with_name("words.jinja")
# The law whose strength is one friction angle; run.json names the law of a layer.
MOHR_COULOMB = "Mohr-Coulomb"
OF_WALLS = "wall_friction_angle_deg"  # in a layer in the place of that of the body
ANISOTROPIC = "NGI-ADP"  # cohesion_Pa is its strength in direct simple shear
SIZES = ("diameter_m", "wall_thickness_m")
PARTS = ("tip", "inner friction", "outer friction", "total")
ASSUMED_CONE = " (cone ASSUMED)"  # behind the name of a method
CONTINUED = 0.5  # m, at the end of a cone test
IN_SAND = ", DNV in sand"
IN_CLAY = ", clay by its strength"
COVER = 0.02  # of the diameter: clay on top that is no plug, and that water lifts off
# in pictures, of Houlsby & Byrne with K0 tan(delta) and without enhancement
LOWER_BOUND = "undisturbed ground (K0), a lower bound"


class NotApplicable(Exception):
    """Why a method says nothing about a scene: what the method does not know, in a
    part of a sentence."""


class Site(NamedTuple):
    """What methods know of a run."""

    scene: Scene  # of run.json
    level: str = "drained"  # Water/Level
    cone: Profile | None = None  # a cone test, if the user has given one
    is_running: bool = False  # and has left no run.json yet
    unsteady: float = 0.0  # share of its relief that flow does not give

    def layers(self, deepest: float) -> list[tuple[int, Scene]]:
        """Return the layers that begin above a depth (m), with their numbers; a
        layer whose numbers change with depth is several. Older files have no list of
        layers, but what counts for the only layer."""
        pairs = enumerate(self.scene.get("layers", [self.scene]), 1)
        return [
            (int(e.get("layer", i)), e)
            for i, e in pairs
            if i == 1 or top_of(e) < deepest
        ]


@functools.lru_cache(maxsize=16)
def site_of(run: Results) -> Site:
    """Return the site of a run, whose files are read once. Raises ResultsError where
    its cone test is wrong."""
    test = of_run(run.directory)
    if not run.scene and run.is_running:
        return Site({}, cone=test, is_running=True)
    given = {**(run.scene.get("design_methods") or {}), **assumed.of_run(run.directory)}
    flush = run.entry("Rigid body/Flush face")
    scene = {**run.scene, "design_methods": given, FLUSH: flush}
    found = unsteady_flow(run)
    share = min(found[1], 1.0) if found else 0.0
    site = Site(scene, run.entry("Water/Level") or "drained", test, unsteady=share)
    if test is None or run.by_hand is None or run.planned is None:
        return site
    return site._replace(cone=continued(site, test, run.planned))


def top_of(entry: Scene) -> float:
    """Return the depth of the top of a layer (m)."""
    return float(entry.get("top_depth_m") or 0)


def sand_of(entry: Scene, number: int) -> Sand:
    """Return what a cone resistance follows from in a layer of run.json. Raises
    NotApplicable."""
    density, angle = entry.get("relative_density"), entry.get("friction_angle_deg")
    if density is None and (entry.get("law") in BY_DENSITY or not angle):
        law = entry.get("law", MOHR_COULOMB)
        raise NotApplicable(f"layer {number} is {law}, and run.json has no density")
    weight = float(entry["submerged_unit_weight_N_m3"])
    k0 = entry.get("K0")
    return Sand(top_of(entry), weight, 0.5 if k0 is None else k0, density, angle or 0)


def layers_of(site: Site, deepest: float, with_clay: bool = False) -> list[Layer]:
    """Return the layers of run.json down to a depth (m); one whose strength follows
    from its density in pieces, with the friction angle of their middle. with_clay: one
    of clay has neither that nor friction. Raises NotApplicable."""
    found, above = list[Layer](), list[Sand]()
    entries = site.layers(deepest)
    bottoms = [top_of(entry) for _, entry in entries[1:]] + [deepest]
    for (number, entry), bottom in zip(entries, bottoms):
        top, weight = top_of(entry), float(entry["submerged_unit_weight_N_m3"])
        if with_clay and soil_of(entry, number) == "clay":
            found.append(Layer(top, weight, 0.0, 0.0, 0.0))
            above.append(Sand(top, weight, 0.5, 0.0, 0.0, is_clay=True))
            continue
        layer = layer_of(entry, number)
        above.append(sand_of(entry, number))
        n = max(int(np.ceil((bottom - top) / STEP - 1e-9)), 1)
        if entry.get("law") not in BY_DENSITY:
            found.append(layer)
            continue
        angle_at = SandGround(above).angle_at
        for z in (top + STEP * i for i in range(n)):
            angle = angle_at(z + STEP / 2)
            found.append(replace(layer, top=z, friction_angle=angle))
    return found


def layer_of(entry: Scene, number: int) -> Layer:
    """Return a layer of run.json. Raises NotApplicable where the theory, which is
    made for sand without cohesion and with one friction angle, does not know it."""
    law = entry.get("law", MOHR_COULOMB)
    if law not in (MOHR_COULOMB, *BY_DENSITY):
        raise NotApplicable(f"layer {number} is {law}")
    if not entry.get("friction_angle_deg"):
        raise NotApplicable(f"layer {number} has no friction angle")
    if (entry.get("cohesion_Pa") or 0) > 0:
        raise NotApplicable(f"layer {number} has cohesion")
    if entry.get("K0") is None:
        raise NotApplicable(f"layer {number} has no K0")
    return Layer(
        top=top_of(entry),
        unit_weight=float(entry["submerged_unit_weight_N_m3"]),
        friction_angle=float(entry["friction_angle_deg"]),
        lateral_stress_ratio=float(entry["K0"]),
        wall_friction_angle=entry.get(OF_WALLS),
        permeability=float(entry.get("permeability_m_s") or 0),
    )


def is_caisson(scene: Scene) -> bool:
    """Return whether the body of run.json is a caisson."""
    return all(scene.get(name) is not None for name in SIZES)


def skirt_of(site: Site) -> Skirt:
    """Return the wall of the caisson of run.json. Raises NotApplicable."""
    scene = site.scene
    if site.is_running:
        raise NotApplicable("there is no run.json, which a run leaves at its end")
    if not is_caisson(scene):
        raise NotApplicable("the body is no caisson")
    both, frictions = scene.get(OF_WALLS), list[float]()
    for side in ("inner", "outer"):
        angle = scene.get(f"{side}_{OF_WALLS}", both)
        if angle is None:
            raise NotApplicable(
                f"run.json does not have the friction of the {side} wall"
            )
        frictions.append(float(angle))
    sizes = [float(scene[name]) for name in SIZES]
    return Skirt(sizes[0], sizes[1], frictions[0], frictions[1], ledges_of(scene))


def wall_angles_at(site: Site, side: str, depth: np.ndarray) -> np.ndarray:
    """Return the friction angle of the "inner" or "outer" wall at depths [n] (m) in the
    layers there (degrees); nan where none is known."""
    of_body = site.scene.get(f"{side}_{OF_WALLS}", np.nan)
    layers = [layer for _, layer in site.layers(np.inf)] or [site.scene]
    tops = [top_of(layer) for layer in layers]
    angles = np.array([layer.get(OF_WALLS, of_body) for layer in layers], dtype=float)
    return angles[np.maximum(np.searchsorted(tops, depth, "right") - 1, 0)]


def assumptions_of(scene: Scene) -> Assumptions:
    """Return what Houlsby and Byrne assume, by the options of the report or, in the
    run.json of earlier versions, the scene."""
    given = scene.get("design_methods") or {}
    known = {name: given[name] for name in Assumptions._fields if name in given}
    return Assumptions(
        **{k: tuple(v) if isinstance(v, list) else v for k, v in known.items()}
    )


def soil_of(entry: Scene, number: int) -> str:
    """Return whether a layer is sand or clay. Raises NotApplicable."""
    law = entry.get("law", MOHR_COULOMB)
    if law in BY_DENSITY:
        return "sand"
    if law not in (MOHR_COULOMB, ANISOTROPIC):
        raise NotApplicable(f"layer {number} is {law}, neither sand nor clay")
    frictional = (entry.get("friction_angle_deg") or 0) > 0
    cohesive = (entry.get("cohesion_Pa") or 0) > 0
    if frictional and cohesive:
        raise NotApplicable(f"layer {number} has both friction and cohesion")
    if not frictional and not cohesive:
        raise NotApplicable(f"layer {number} has no strength")
    return "sand" if frictional else "clay"


def refuse_undrained(site: Site) -> None:
    """Raise NotApplicable where pore water cannot leave the sand."""
    if site.level == "undrained":
        raise NotApplicable("the run is undrained, and the method is for drained sand")


def layers_with_soils(site: Site, deepest: float) -> list[tuple[int, Scene, str]]:
    """Return (number, layer, soil) of all layers. Raises NotApplicable."""
    found = [(i, entry, soil_of(entry, i)) for i, entry in site.layers(deepest)]
    if any(soil == "sand" for *_, soil in found):
        refuse_undrained(site)
    return found


def soils_of(site: Site, deepest: float) -> list[tuple[float, str]]:
    """Return (top, soil) of all layers. Raises NotApplicable."""
    return [(top_of(x), soil) for _, x, soil in layers_with_soils(site, deepest)]


def below_cover(site: Site) -> tuple[Site, float]:
    """Return a site without clay from the mudline down that is too thin for a plug, and
    the thickness of that (m), by which its depths are less; 0 without such clay.
    Suction breaks the clay, and then water flows."""
    with suppress(NotApplicable):
        diameter = skirt_of(site).outer_diameter
        tops = [top for top, soil in soils_of(site, np.inf) if soil == "sand"]
        if tops and 0 < tops[0] <= COVER * diameter:
            every = [x for _, x in site.layers(np.inf) if top_of(x) >= tops[0]]
            layers = [{**x, "top_depth_m": top_of(x) - tops[0]} for x in every]
            return site._replace(scene={**site.scene, "layers": layers}), tops[0]
    return site, 0.0


def flows_to(site: Site, deepest: float) -> float:
    """Return the depth (m), at most deepest, down to which water flows around the tip:
    to the first clay, but for a thin cover; 0 where it does not."""
    below, cover = below_cover(site)
    found = above_clay(below, deepest - cover)
    return found + cover if found > 0 else 0.0


def above_clay(site: Site, deepest: float) -> float:
    """Return the depth (m), at most deepest, down to which all layers are sand: as long
    as the tip is above it, water flows around it into the plug."""
    with suppress(NotApplicable):
        tops = [top for top, soil in soils_of(site, deepest) if soil != "sand"]
        return min([*tops, deepest])
    return 0.0


def only(site: Site, deepest: float, soil: str) -> None:
    """Raise NotApplicable where a layer is another soil."""
    for i, _, found in layers_with_soils(site, deepest):
        if found != soil:
            raise NotApplicable(f"layer {i} is {found}, and the method is for {soil}")


CONE_NEEDED = "a cone test is needed (--cpt FILE)"


def continued(site: Site, cone: Profile, deepest: float) -> Profile:
    """Return a cone test that goes on below its end, in the layer there, as is assumed
    for sand, of which it has the share that it has over its last CONTINUED (m)."""
    end = float(cone.depth[-1])
    numbers = [dict(site.layers(h)).keys() for h in (end, deepest)]
    if end >= deepest - 1e-9 or numbers[0] != numbers[1]:
        return cone
    try:
        assumed = cone_of(site._replace(cone=None), deepest, with_clay=True)
    except NotApplicable:
        return cone
    begin = max(end - CONTINUED, 0.0)
    last, of_assumed = (x.integral(end) - x.integral(begin) for x in (cone, assumed))
    if not of_assumed > 0:  # as in clay
        return cone
    below = assumed.depth > end
    values = last / of_assumed * assumed.resistance[below]
    found = Profile(
        [*cone.depth, *assumed.depth[below]], [*cone.resistance, *values.tolist()]
    )
    found.assumed = say(SENTENCES, "continued", end)
    return found


def cone_of(site: Site, deepest: float, with_clay: bool = False) -> Profile:
    """Return the cone test or, without one, what is assumed for sand down to a depth
    (m). with_clay: none is needed there. Raises NotApplicable."""
    if site.cone is not None:
        return site.cone
    sands = list[Sand]()
    try:
        for i, entry, soil in layers_with_soils(site, deepest):
            if soil == "sand":
                sands.append(sand_of(entry, i))
            elif with_clay:
                weight = float(entry["submerged_unit_weight_N_m3"])
                sands.append(Sand(top_of(entry), weight, 0.5, 0.0, 0.0, is_clay=True))
            else:
                raise NotApplicable(f"layer {i} is {soil}")
    except ResultsError as error:  # run.json lacks something
        raise NotApplicable(str(error)) from error
    except NotApplicable as reason:
        raise NotApplicable(f"{CONE_NEEDED}; none is assumed: {reason}") from reason
    return assumed_cone(tuple(sands), deepest)


def houlsby_byrne_of(
    site: Site, deepest: float, with_clay: bool = False
) -> HoulsbyByrne:
    """Return Houlsby and Byrne for a site, with the layers down to deepest (m).
    with_clay: with nothing in layers of clay. Raises NotApplicable."""
    skirt = skirt_of(site)
    try:
        layers = layers_of(site, deepest, with_clay)
    except ResultsError as error:  # run.json lacks something
        raise NotApplicable(str(error)) from error
    refuse_undrained(site)
    return houlsby_byrne.method(
        skirt.outer_diameter,
        skirt.wall_thickness,
        layers,
        (skirt.inner_friction_angle, skirt.outer_friction_angle),
        assumptions_of(site.scene),
        skirt.ledges,
        permeabilities_below(site, deepest),
    )


def permeabilities_below(site: Site, deepest: float) -> list[tuple[float, float]]:
    """Return (top, permeability) of the layers below a depth (m), down to the first
    whose permeability is not known."""
    every = [x for _, x in site.layers(np.inf) if top_of(x) >= deepest]
    pairs = [(top_of(x), float(x.get("permeability_m_s") or 0)) for x in every]
    return list(itertools.takewhile(lambda pair: pair[1] > 0, pairs))


def dnv_of(site: Site, deepest: float, with_clay: bool = False) -> Method:
    """Return DNV for a site. with_clay: with nothing in layers of clay. Raises
    NotApplicable."""
    skirt, soils = skirt_of(site), soils_of(site, deepest)
    if with_clay:
        soils = [(top, "" if soil == "clay" else soil) for top, soil in soils]
    return dnv.method(skirt, cone_of(site, deepest, with_clay), soils)


def senders_of(site: Site, deepest: float, with_clay: bool = False) -> Method:
    """Return Senders and Randolph for a site, where layers may have a friction angle of
    the walls of their own. with_clay: with nothing in layers of clay. Raises
    NotApplicable."""
    skirt = skirt_of(site)
    if not with_clay:
        only(site, deepest, "sand")
    clay_tops = [top for top, soil in soils_of(site, deepest) if soil == "clay"]
    walls = [(top_of(x), x.get(OF_WALLS)) for _, x in site.layers(deepest)]
    cone = cone_of(site, deepest, with_clay)
    return senders_randolph.method(skirt, cone, walls, clay_tops)


OfSite = Callable[..., Method]  # of a site with layers down to a depth (m)
IN_LAYERS = {"houlsby_byrne": houlsby_byrne_of, "senders_randolph": senders_of}


def clay_layers_of(site: Site, deepest: float) -> list[clay.Layer]:
    """Return the layers of clay and sand down to a depth (m). Raises NotApplicable."""
    found = []
    for _, entry, soil in layers_with_soils(site, deepest):
        weight = float(entry["submerged_unit_weight_N_m3"])
        numbers = [0.0] * 3
        if soil == "clay":
            numbers[0] = float(entry["cohesion_Pa"])
            for i, side in enumerate(("inner", "outer"), 1):
                of_body = site.scene.get(f"{side}_wall_adhesion_Pa", 0.0)
                numbers[i] = float(entry.get("wall_adhesion_Pa", of_body))
        found.append(clay.Layer(top_of(entry), weight, *numbers))
    return found


def clay_of(site: Site, deepest: float) -> Method:
    """Return the method of clay for a site, in which there may be sand, too. Raises
    NotApplicable."""
    skirt, soils = skirt_of(site), {soil for _, soil in soils_of(site, deepest)}
    if "clay" not in soils:
        only(site, deepest, "clay")
    if soils == {"clay"}:
        return clay.Clay(skirt, clay_layers_of(site, deepest))
    return in_layers(site, deepest, dnv_of, dict(zip(clay.CASES, dnv.CASES)))


def in_layers(
    site: Site, deepest: float, of_sand: OfSite, cases: Mapping[str, str]
) -> layered.Layered:
    """Return a method for sand in layers of sand and clay, where clay has its strength.
    cases: what its cases are called here. Raises NotApplicable."""
    of_clay = clay.Clay(skirt_of(site), clay_layers_of(site, deepest))
    return layered.Layered(of_clay, of_sand(site, deepest, with_clay=True), cases)


class Description(NamedTuple):
    """A method: its name, the beginning of its columns, and its color in pictures; a
    case below the range of the others; whether it counts in the mean by hand, and has a
    required suction as Senders and Randolph; what stands behind its name."""

    name: str
    key: str
    color: str
    cases: tuple[str, str]
    of_site: OfSite
    bound: tuple[str, ...] = ()
    in_mean: bool = False
    has_suction: bool = False
    remark: str = ""

    @property
    def all_cases(self) -> tuple[str, ...]:
        """The cases of the range, and the bound below it."""
        return (*self.cases, *self.bound)


def from_cone(name: str, key: str, color: str, module: Any, **more: Any) -> Description:
    """Return the method from a cone of a module, which is for sand alone."""

    def of_site(site: Site, deepest: float) -> Method:
        """Return the method. Raises NotApplicable."""
        skirt = skirt_of(site)
        only(site, deepest, "sand")
        return cast(Method, module.method(skirt, cone_of(site, deepest)))

    return Description(name, key, color, module.CASES, of_site, **more)


BYRNE = "Houlsby & Byrne (2005)", "houlsby_byrne", "#2166ac"
SENDERS = "Senders & Randolph (2009)", "senders_randolph", "#2e8b57"
UNIFIED = "ISO 19901-4 (unified)", "unified", "#c51b7d"
ANDERSEN = "Andersen et al. (2008)", "andersen", "#7b3294"
METHODS = (
    Description(*BYRNE, HoulsbyByrne.cases, houlsby_byrne_of, (UNDISTURBED,), True),
    Description("DNV", "dnv", "#8c510a", dnv.CASES, dnv_of, (), True, True),
    Description(*SENDERS, senders_randolph.CASES, senders_of, (), True, True),
    from_cone(*UNIFIED, unified, has_suction=True, remark=", for piles"),
    from_cone(*ANDERSEN, andersen, remark=", a scatter"),
    Description("Strength of clay", "clay", "#666666", clay.CASES, clay_of),
)
OF_CLAY = METHODS[-1]


@dataclass(frozen=True)
class Beside:
    """What a method says of one quantity over depth, beside which a run stands: its
    lower and its upper case, and a bound below them, [n] each (N or Pa); the limit
    beyond which no suction suffices, and whether the cases end there, by piping."""

    name: str
    cases: dict[str, np.ndarray]
    bounds: dict[str, np.ndarray] = field(default_factory=dict)
    limit: float | np.ndarray = np.nan
    may_end: bool = False

    @property
    def is_known(self) -> bool:
        """Whether there is anything to show."""
        return any(np.isfinite(values).any() for values in self.cases.values())

    @property
    def band(self) -> tuple[np.ndarray, np.ndarray]:
        """Both ends; where only the upper case has none, the limit."""
        low, high = self.cases.values()
        return low, np.where(np.isfinite(low) & np.isnan(high), self.limit, high)


@dataclass(frozen=True)
class Answer:
    """What a method says over depth: forces by case and part, [n] (N) at embedments
    depth [n] (m), nan where it has no answer; none, and why not."""

    method: Description
    depth: np.ndarray
    forces: dict[str, dict[str, np.ndarray]] = field(default_factory=dict)
    why_not: str = ""
    assumed: str = ""  # of a cone resistance: what it rests on
    beside: str = ""  # behind the name: what the other soil has, sand or clay

    @property
    def name(self) -> str:
        """The name of the method, marked where its cone resistance is assumed."""
        return self.method.name + self.beside + (ASSUMED_CONE if self.assumed else "")

    @property
    def total(self) -> Beside:
        """The total force; no case without an answer."""
        totals = {case: forces["total"] for case, forces in self.forces.items()}
        bounds = {b: totals.pop(b) for b in self.method.bound if b in totals}
        return Beside(self.name, totals, bounds)

    def band(self, part: str) -> tuple[np.ndarray, np.ndarray]:
        """Return a part in the lower and in the upper case (N)."""
        low, high = [self.forces[case][part] for case in self.method.cases]
        return low, high


def assumptions_in_words(scene: Scene) -> str:
    """Return what the cases of Houlsby and Byrne are."""
    assumed = assumptions_of(scene)
    return say(SENTENCES, "assumptions", *assumed[:2], assumed.load_spread)


def of_site(method: Description, site: Site, deepest: float) -> Method:
    """Return a method for a site; one for sand that knows layers of clay beside it with
    these. Raises NotApplicable."""
    with suppress(NotApplicable):
        soils = {soil for _, soil in soils_of(site, deepest)}
        if soils == {"sand", "clay"} and method.key in IN_LAYERS:
            cases = {x: x for x in method.all_cases}
            return in_layers(site, deepest, IN_LAYERS[method.key], cases)
    return method.of_site(site, deepest)


def answer_of(method: Description, site: Site, depth: np.ndarray) -> Answer:
    """Return what a method says at embedments [n] (m)."""
    try:
        known = of_site(method, site, float(depth.max()))
    except NotApplicable as reason:
        return Answer(method, depth, why_not=str(reason))
    forces = dict[str, dict[str, np.ndarray]]()
    for case in method.all_cases:
        rows = [known.forces(float(h), case) for h in depth]
        columns = np.array([[*row, row.total] for row in rows]).T
        forces[case] = dict(zip(PARTS, columns))
    beside = ""
    if isinstance(known, layered.Layered):
        beside, known = IN_SAND if method == OF_CLAY else IN_CLAY, known.sand
    assumed = known.profile.assumed if isinstance(known, ConeMethod) else ""
    return Answer(method, depth, forces, assumed=assumed, beside=beside)


def answers_of(site: Site, depth: np.ndarray) -> list[Answer]:
    """Return what each method says at embedments [n] (m)."""
    return [answer_of(method, site, depth) for method in METHODS]


def answers_to(site: Site, deepest: float) -> list[Answer]:
    """Return what each method says down to an embedment, for pictures."""
    return answers_of(site, np.linspace(0, deepest, 100))


def reasons(answers: list[Answer]) -> list[tuple[str, str]]:
    """Return (methods, why they say nothing), each reason once. That the method of clay
    is not for sand, of which another one has an answer, needs no words."""
    found: dict[str, list[str]] = {}
    is_sand = any(answer.forces for answer in answers if answer.method != OF_CLAY)
    for answer in answers:
        if answer.why_not and not (is_sand and answer.method == OF_CLAY):
            found.setdefault(answer.why_not, []).append(answer.method.name)
    return [(", ".join(names), reason) for reason, names in found.items()]


def reasons_in_words(answers: list[Answer]) -> str:
    """Return which methods have no answer, and why, in one line."""
    return say(SENTENCES, "no_answers", reasons(answers))


def about_cone(site: Site, deepest: float) -> str:
    """Return a sentence where the cone test ends above an embedment (m), or what a
    cone resistance that is assumed rests on; with the friction angle of sand whose
    strength follows from its density."""
    end, angles = None, list[float]()
    answers = answers_of(site, np.array([deepest]))
    assumed = next((a.assumed for a in answers if a.assumed), "")
    if not assumed and site.cone and site.cone.depth[-1] < deepest - 1e-9:
        end = float(site.cone.depth[-1])
    if any(e.get("law") in BY_DENSITY for _, e in site.layers(deepest)):
        with suppress(NotApplicable):
            found = [layer.friction_angle for layer in layers_of(site, deepest)]
            angles = [round(min(found), 1), round(max(found), 1)]
    return say(SENTENCES, "about_cone", end, assumed, angles)
