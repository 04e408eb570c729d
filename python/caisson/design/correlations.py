# SPDX-License-Identifier: LGPL-2.1-or-later
"""Published correlations between a cone test and parameters of the soil.

Each gives a value for each row of a test, for its best estimate and at the ends of the
scatter that its source states, about one standard deviation. p_a is 100 kPa, q_t the
cone resistance, sigma_v and sigma'_v the total and the effective vertical stress, and
sigma'_m = sigma'_v (1 + 2 K_0)/3. Formulas are those of the papers as two published
programs and commercial manuals quote them, not copied from the papers.

Relative density D_r of silica sand
    own-cone           D_r in which a cone that the program pushes into the ground of
        the scene meets the measured resistance (caisson.design.own_cone); scatter: the
        error of a cone, 4 %, and of the table, 10 % in q_c
    jamiolkowski-2003  D_r = ln(q_c/p_a / (24.94 (sigma'_m/p_a)^0.46)) / 2.96
        Jamiolkowski, Lo Presti & Manassero (2003), ASCE GSP 119, p. 201; chamber tests
        on dry Ticino, Toyoura and Hokksund sand, sigma'_v 50 to 400 kPa, K_0 0.4 to
        1.5; saturated sand is up to a tenth denser
    baldi-1986         D_r = ln(q_c / (157 sigma'_v^0.55)) / 2.41, in kPa
        Baldi et al. (1986), 4th Int. Geotech. Seminar, Singapore; normally consolidated
        Ticino sand
    Scatter of both: a factor of 1.3 in q_c. No source states it: it is the difference
    of the two formulas

Friction angle of sand, in degrees
    bolton-1986-tip    phi = 33 + 3 (D_r (10 - ln p) - 1) with p = sqrt(q_t sigma'_v)
        in kPa, 33 to 45; Bolton (1986), doi 10.1680/geot.1986.36.1.65; quartz
        sand in triaxial compression; scatter 2 degrees, and that of D_r. Sand under a
        tip fails under a stress between that of the tip and that of the ground; the
        geometric mean is that of Randolph, Dolwin & Beck (1994), Geotechnique 44, 427,
        for piles; quoted, and unconfirmed. From it follows K_0; the law of a scene
        finds the angle of each point itself

Young's modulus of sand
    brinkgreve-2010    E = 60 MPa D_r sqrt(sigma'_m/p_a), the E_50 of a triaxial test
        Brinkgreve, Engin & Engin (2010), Numerical Methods in Geotechnical Engineering,
        p. 137; read in a published program, not in the paper. The exponent of the
        stress is that of the law; the source has 0.7 - D_r/3.2. It states no scatter; a
        factor of 1.5 is assumed. A modulus in proportion to q_c would count the density
        twice, as the strength has it, too: the cone would then find up to twice the
        resistance in dense sand

Undrained strength of clay and silt
    own-cone-clay      s_u = (q_t - sigma_v)/(N/f), with N = 3.4 + 1.6 ln(G/s_u) of a
        smooth cone in Tresca clay (Lu et al. 2004), which cones computed with the
        program have within 3 %, and the factor f of the strength at the slower rate of
        a wall: 1 + 0.144 log10 of its rate over that of the cone, velocity over
        thickness or diameter, as 61 soundings at 5 to 65 mm/s in clay have it (Tiller,
        doi 10.5281/zenodo.14838136). A wall goes in at 1 mm/s, ASSUMED. For the soil
        of a caisson only, as this strength is not that of the laboratory. Scatter as
        nkt
    nkt                s_u = (q_t - sigma_v)/N_kt, N_kt = 14, from 10 to 18; another
        N_kt has the same scatter
        Robertson & Cabal (2015), Guide to cone penetration testing; CPT'18 has 8 to 25
        (Mayne & Peuchen 2018)

SI units; D_r is a share of 1, angles are in degrees.
"""
from collections.abc import Callable, Iterable
from math import exp, hypot, log, log10
from typing import NamedTuple

import numpy as np

from caisson.design.density import bolton_angle, density_of_resistance
from caisson.design.density import reference_modulus
from caisson.design import own_cone
from caisson.design.ground import Ground

DENSITY, ANGLE = "relative density", "friction angle"
MODULUS, STRENGTH = "Young's modulus", "undrained strength"
SCATTER_OF_RESISTANCE = 1.3  # a factor of q_c, for D_r
SCATTER_OF_BOLTON = 2.0  # degrees
CONE_FACTORS = (18 / 14, 1.0, 10 / 14)  # times N_kt, for low, best and high strength
SCATTER_OF_MODULUS = 1.5  # a factor
OWN_CONE, IN_CHAMBERS = "own-cone", "jamiolkowski-2003"
OWN_CLAY, NKT = "own-cone-clay", "nkt"
UNCALIBRATED = IN_CHAMBERS, NKT
PER_DECADE = 0.144  # of the resistance of clay, for ten times the rate
CONE_RATE = 0.02 / own_cone.DIAMETER  # 1/s: 20 mm/s over the diameter
WALL_VELOCITY = 1e-3  # m/s
# E / s_u of clay, for the low, the best and the high estimate. Duncan & Buchignani
# (1976) have about 300 for a plasticity of 30 to 50 % and an OCR below 3, and less for
# more of either; quoted from memory, not checked against the report
CLAY_RATIOS = (150.0, 300.0, 600.0)
CLAY_POISSON = 0.45  # hardly any change of volume, as without drainage
ANGLES = 25.0, 50.0  # between which an angle is held
# between which K_0 = 0.1 (q_t - sigma_v)/sigma'_v of clay (Kulhawy & Mayne 1990) is
RESTS_OF_CLAY = 0.4, 1.5
ROUNDS = 20

LOW, BEST, HIGH = -1, 0, 1
# ground, K_0 [n], and one of LOW, BEST, HIGH to D_r [n]
Density = Callable[[Ground, np.ndarray, int], np.ndarray]


class Correlation(NamedTuple):
    """A correlation: what it gives, its name, its source and where it holds."""

    quantity: str
    name: str
    source: str
    holds: str


LAB = "silica sand, vertical effective stress 50 to 400 kPa"
AT_TIP = "Bolton (1986) at the mean stress of Randolph, Dolwin & Beck (1994)"
OF_OWN_CLAY = "a cone computed in clay, and the rate of the wall"
DEEP = "the law of the scene; below 30 cone diameters"
MOBILIZED = "silica sand, half of its strength mobilized"
UNDRAINED = "clay, and silt without drainage"
EVERY = [
    Correlation(DENSITY, OWN_CONE, "cones computed with the program", DEEP),
    Correlation(
        DENSITY, IN_CHAMBERS, "Jamiolkowski, Lo Presti & Manassero (2003)", LAB
    ),
    Correlation(
        DENSITY, "baldi-1986", "Baldi et al. (1986)", "normally consolidated sand"
    ),
    Correlation(
        ANGLE,
        "bolton-1986-tip",
        AT_TIP,
        "quartz sand under a tip, from relative density",
    ),
    Correlation(
        MODULUS, "brinkgreve-2010", "Brinkgreve, Engin & Engin (2010)", MOBILIZED
    ),
    Correlation(STRENGTH, OWN_CLAY, OF_OWN_CLAY, UNDRAINED),
    Correlation(STRENGTH, NKT, "Robertson & Cabal (2015)", UNDRAINED),
]
BY_NAME = {correlation.name: correlation for correlation in EVERY}


def chosen(names: Iterable[str]) -> dict[str, str]:
    """Return the name for each quantity: the first of EVERY, or the one in names."""
    found = {c.quantity: c.name for c in reversed(EVERY)}
    return found | {BY_NAME[name].quantity: name for name in names}


def mean_stress(ground: Ground, k0: np.ndarray) -> np.ndarray:
    """Return sigma'_m (Pa) [n]."""
    return ground.stress * (1 + 2 * k0) / 3


def jamiolkowski(ground: Ground, k0: np.ndarray, end: int) -> np.ndarray:
    """Return D_r [n] of Jamiolkowski et al. (2003)."""
    resistance = ground.resistance * SCATTER_OF_RESISTANCE**end
    found = density_of_resistance(resistance, mean_stress(ground, k0))
    return np.clip(found, 0.0, 1.0)


def baldi(ground: Ground, _: np.ndarray, end: int) -> np.ndarray:
    """Return D_r [n] of Baldi et al. (1986)."""
    resistance = ground.resistance * SCATTER_OF_RESISTANCE**end / 1e3
    stress = (ground.stress / 1e3) ** 0.55
    found = np.log(np.maximum(resistance, 1e-9) / (157 * stress)) / 2.41
    return np.clip(found, 0.0, 1.0)


def resistance_at(ground: Ground, end: int) -> np.ndarray:
    """Return the resistance (Pa) [n] that a computed cone is to meet."""
    return np.asarray(ground.resistance * exp(end * hypot(*own_cone.ERRORS)))


def answering(ground: Ground, k0: np.ndarray, end: int) -> np.ndarray:
    """Return D_r [n] that answers the cone; near the surface, where a cone is not deep,
    that of Jamiolkowski et al."""
    stress = mean_stress(ground, k0)
    found = own_cone.densities(resistance_at(ground, end), stress)
    is_deep = own_cone.is_deep(ground.depth)
    return np.where(is_deep, found, jamiolkowski(ground, k0, end))


DENSITIES: dict[str, Density] = {
    OWN_CONE: answering,
    IN_CHAMBERS: jamiolkowski,
    "baldi-1986": baldi,
}


def angles_of(ground: Ground, names: dict[str, str], end: int) -> np.ndarray:
    """Return phi [n] of Bolton (1986) under a tip, with K_0 = 1 - sin phi."""
    density = DENSITIES[names[DENSITY]]
    # under which sand fails at a tip
    stress = np.sqrt(np.maximum(ground.tip, ground.stress) * ground.stress)
    first = jamiolkowski if density is answering else density  # takes less time
    k0 = np.full(len(ground.depth), 0.5)
    for _ in range(ROUNDS):
        k0 = at_rest(bolton_angle(first(ground, k0, BEST), stress))
    angle, other = (bolton_angle(density(ground, k0, e), stress) for e in (BEST, end))
    angle = angle + end * np.hypot(SCATTER_OF_BOLTON, other - angle)
    return np.clip(angle, *ANGLES)


def at_rest(angle: np.ndarray) -> np.ndarray:
    """Return K_0 = 1 - sin phi [n] (Jaky 1948), as the program does by itself."""
    return 1 - np.sin(np.radians(angle))


def densities_of(ground: Ground, names: dict[str, str], end: int) -> np.ndarray:
    """Return D_r [n] by the correlation chosen, with the K_0 of the best angle."""
    k0 = at_rest(angles_of(ground, names, BEST))
    return DENSITIES[names[DENSITY]](ground, k0, end)


def reference_moduli(ground: Ground, names: dict[str, str], end: int) -> np.ndarray:
    """Return E (Pa) [n] of sand at a mean effective stress of 100 kPa: where D_r
    answers the cone it goes with it, also low and high."""
    if names[DENSITY] != OWN_CONE:
        density = densities_of(ground, names, BEST)
        return np.asarray(reference_modulus(density) * SCATTER_OF_MODULUS**end)
    density = densities_of(ground, names, end)
    stress = mean_stress(ground, at_rest(angles_of(ground, names, BEST)))
    ratio = own_cone.ratios(density, resistance_at(ground, end), stress)
    is_deep = own_cone.is_deep(ground.depth)
    return np.asarray(reference_modulus(density) * np.where(is_deep, ratio, 1.0))


def computed_cone_factor() -> float:
    """Return N of a smooth cone in clay of the best stiffness."""
    return 3.4 + 1.6 * log(CLAY_RATIOS[1] / (2 * (1 + CLAY_POISSON)))


def rate_factor(wall: float | None) -> float:
    """Return the strength that a wall of a thickness (m) meets over that of the cone; 1
    without a wall."""
    if not wall:
        return 1.0
    return 1 + PER_DECADE * log10(WALL_VELOCITY / wall / CONE_RATE)


def strengths_of(ground: Ground, _: dict[str, str], end: int) -> np.ndarray:
    """Return s_u (Pa) [n]."""
    return ground.net / (CONE_FACTORS[end + 1] * ground.cone_factor)
