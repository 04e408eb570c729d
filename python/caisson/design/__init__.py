# SPDX-License-Identifier: LGPL-2.1-or-later
"""Design methods for the penetration of skirts and caissons, and cone tests as files.

Nothing here needs the program caisson_mpm or a run: a method takes the caisson, the
soil or a cone test, and returns forces or suctions over depth.
"""
