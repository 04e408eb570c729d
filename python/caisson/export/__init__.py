# SPDX-License-Identifier: LGPL-2.1-or-later
"""The state of the soil after a run for other programs: balanced on their meshes."""
