# SPDX-License-Identifier: LGPL-2.1-or-later
"""What exports need of the laws of a run: Young's modulus. A layer is an entry of the
list "layers" in run.json."""
from math import nan
from typing import Any

POISSON = 0.3  # of soil whose law does not say it


def poisson_ratio(layer: dict[str, Any]) -> float:
    """Return Poisson's ratio of the law, or POISSON where it has none."""
    entries = {one["entry"]: one["value"] for one in layer.get("law_entries", [])}
    known = layer.get("poisson_ratio", entries.get("Poisson ratio", POISSON))
    return float(known)


def youngs_modulus(layer: dict[str, Any]) -> float:
    """Return Young's modulus (Pa), nan where the law has none. That of a user material
    follows from the p-wave modulus of DDSDDE at the start."""
    if "p_wave_modulus_Pa" in layer:
        nu = poisson_ratio(layer)
        ratio = (1 + nu) * (1 - 2 * nu) / (1 - nu)
        return ratio * float(layer["p_wave_modulus_Pa"])
    return float(layer.get("youngs_modulus_Pa", nan))
