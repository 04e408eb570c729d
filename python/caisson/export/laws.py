# SPDX-License-Identifier: LGPL-2.1-or-later
"""What exports need of the laws of a run: Young's modulus. A layer is an entry of the
list "layers" in run.json."""
from math import nan
from typing import Any

NGI_ADP = "NGI-ADP"
POISSON = 0.3  # of soil whose law does not say it


def entries_of(layer: dict[str, Any]) -> dict[str, float]:
    """Return the numbers of the law of a layer by their entries."""
    return {one["entry"]: float(one["value"]) for one in layer.get("law_entries", [])}


def poisson_ratio(layer: dict[str, Any]) -> float:
    """Return Poisson's ratio of the law, or POISSON where it has none."""
    known = layer.get("poisson_ratio", entries_of(layer).get("Poisson ratio", POISSON))
    return float(known)


def youngs_modulus(layer: dict[str, Any]) -> float:
    """Return Young's modulus (Pa), nan where the law has none. NGI-ADP has
    G = (G_ur / s_uA) s_uA, and a user material the p-wave modulus of DDSDDE at the
    start."""
    entries, nu = entries_of(layer), poisson_ratio(layer)
    if layer.get("law") == NGI_ADP:
        ratio = entries["Unloading shear modulus ratio"]
        return 2 * (1 + nu) * ratio * entries["Active strength"]
    if "p_wave_modulus_Pa" in layer:
        ratio = (1 + nu) * (1 - 2 * nu) / (1 - nu)
        return ratio * float(layer["p_wave_modulus_Pa"])
    return float(layer.get("youngs_modulus_Pa", nan))
