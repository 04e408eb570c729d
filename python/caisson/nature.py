# SPDX-License-Identifier: LGPL-2.1-or-later
"""Constants of nature and of usual soil, in SI units."""

GRAVITY = 9.81
ATMOSPHERE = 100e3  # the stress by which correlations are normalized
WATER_DENSITY, QUARTZ_DENSITY = 1000.0, 2650.0
WATER = WATER_DENSITY * GRAVITY  # its unit weight
