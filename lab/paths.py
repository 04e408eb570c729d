# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the parts of the laboratory are."""
from pathlib import Path

LAB = Path(__file__).resolve().parent


def scene_of(kind: str, name: str) -> Path:
    """Return a scene, as in scene_of("verification", "piston")."""
    return LAB / kind / f"{name}.prm"
