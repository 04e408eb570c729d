# SPDX-License-Identifier: LGPL-2.1-or-later
"""What exports need of the laws of a run: Young's modulus. A layer is an entry of the
list "layers" in run.json."""
from typing import Any

import numpy as np

CAM_CLAY, NGI_ADP = "modified Cam clay", "NGI-ADP"
POISSON = 0.3  # of soil whose law does not say it


def entries_of(layer: dict[str, Any]) -> dict[str, float]:
    """Return the numbers of the law of a layer by their entries."""
    return {one["entry"]: float(one["value"]) for one in layer.get("law_entries", [])}


def poisson_ratio(layer: dict[str, Any]) -> float:
    """Return Poisson's ratio of the law, or POISSON where it has none."""
    known = layer.get("poisson_ratio", entries_of(layer).get("Poisson ratio", POISSON))
    return float(known)


def youngs_modulus(
    layer: dict[str, Any], pressure: np.ndarray, void_ratio: np.ndarray
) -> np.ndarray:
    """Return Young's modulus (Pa) at mean effective stresses [n] (Pa, compression
    positive) and void ratios [n]: nan where the law has none.

    NGI-ADP has G = (G_ur / s_uA) s_uA, modified Cam clay K = (1 + e) p / kappa, and a
    user material the p-wave modulus of DDSDDE at the start.
    """
    entries, nu = entries_of(layer), poisson_ratio(layer)
    constant = float(layer.get("youngs_modulus_Pa", np.nan))
    if layer.get("law") == NGI_ADP:
        ratio = entries["Unloading shear modulus ratio"]
        constant = 2 * (1 + nu) * ratio * entries["Active strength"]
    elif "p_wave_modulus_Pa" in layer:
        ratio = (1 + nu) * (1 - 2 * nu) / (1 - nu)
        constant = ratio * float(layer["p_wave_modulus_Pa"])
    elif layer.get("law") == CAM_CLAY:
        least = entries["Smallest stress of stiffness"]
        bulk = (1 + void_ratio) * np.maximum(pressure, least)
        return 3 * (1 - 2 * nu) * bulk / entries["Slope of swelling"]
    return np.full(len(pressure), constant)
