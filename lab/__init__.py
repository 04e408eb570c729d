# SPDX-License-Identifier: LGPL-2.1-or-later
"""The laboratory: what shows that the numbers of caisson_mpm are right, and how fast
it is.

    verification    problems with exact solutions; the ladder has what is asked of each
    validation      runs beside measurements
    stability       hard scenes that must run to their end
    performance     the speed of kernels and program
    studies         what numerics and drainage do to the forces of a scene

Each case has a folder with its scene, its README and, where it has them, measurements,
an independent reference or the evaluation. The module of a folder (__init__.py)
evaluates all its cases. scripts/lab is the command line.

The laboratory imports the user's package, caisson, which imports nothing of it.
"""
from pathlib import Path

LAB = Path(__file__).resolve().parent


def scene_of(kind: str, name: str) -> Path:
    """Return a scene, as in scene_of("verification", "piston")."""
    return LAB / kind / f"{name}.prm"
