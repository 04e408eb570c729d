# SPDX-License-Identifier: LGPL-2.1-or-later
"""Units at the end of names, as in tip_force_N and velocity_m_s: of the columns of
tables and of the arrays of frames; and constants of nature and of usual soil, in SI."""

GRAVITY = 9.81
ATMOSPHERE = 100e3  # the stress by which correlations are normalized
WATER_DENSITY, QUARTZ_DENSITY = 1000.0, 2650.0
WATER = WATER_DENSITY * GRAVITY  # its unit weight

# the end of a name, and the unit; a longer end comes before one that ends like it
UNITS = {
    "m3_s": "m3/s",
    "m_s": "m/s",
    "kg_m3": "kg/m3",
    "J_m3": "J/m3",
    "N_m3": "N/m3",
    "m3": "m3",
    "m2": "m2",
    "kPa": "kPa",
    "Pa": "Pa",
    "kg": "kg",
    "deg": "degree",
    "J": "J",
    "N": "N",
    "m": "m",
    "s": "s",
}
SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0, "d": 86400.0}
NONE = "1"  # of counts, ratios and numbers of materials


def split(name: str) -> tuple[str, str]:
    """Return the quantity and its unit: ("stress_zz", "Pa") from "stress_zz_Pa"; the
    name and NONE where it has no unit."""
    for end, unit in UNITS.items():
        if name.endswith(f"_{end}"):
            return name.removesuffix(f"_{end}"), unit
    return name, NONE


def unit_of(name: str) -> str:
    """Return the unit at the end of a name, NONE where there is none."""
    return split(name)[1]
