# SPDX-License-Identifier: LGPL-2.1-or-later
"""What numerics and drainage do to the forces of a scene."""
