# SPDX-License-Identifier: LGPL-2.1-or-later
"""Error bars of a scene: from runs on similar meshes and with other numerics."""
