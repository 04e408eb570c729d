# SPDX-License-Identifier: LGPL-2.1-or-later
"""Penetration resistance by DNV, from a cone test: most probable and highest.

DNV Classification Notes 30.4 (1992), Foundations, later DNV-RP-E303: the tip bears
k_p q_c, and both walls k_f q_c, with coefficients by soil that rest on skirts in dense
sand and stiff clay of the North Sea. The coefficients were read in K. Duffy, Offshore
Geotechnics, lecture notes of Delft University of Technology, section 8.4, which also
give silt; no scene says that its soil is silt, so it is not here.

In other soils the method may be far off: skirts in soft clay have met much less.
"""
from collections.abc import Sequence

from caisson.design.cone import Coefficients, ConeMethod, Layer, Profile, Skirt

CASES = ("most probable", "highest")
# soil: (k_p, k_f) of each case; none of what another method treats
COEFFICIENTS = {
    "": ((0.0, 0.0), (0.0, 0.0)),
    "sand": ((0.3, 0.001), (0.6, 0.003)),
    "clay": ((0.4, 0.03), (0.6, 0.05)),
}


def method(
    skirt: Skirt, profile: Profile, layers: Sequence[tuple[float, str]]
) -> ConeMethod:
    """Return the method. layers: (top below the mudline in m, soil) of each."""
    found = []
    for top, soil in layers:
        pairs = dict(zip(CASES, COEFFICIENTS[soil]))
        k = {name: Coefficients(p, f, f) for name, (p, f) in pairs.items()}
        found.append(Layer(top, k))
    return ConeMethod(CASES, skirt, profile, found)
