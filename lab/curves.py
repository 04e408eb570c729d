# SPDX-License-Identifier: LGPL-2.1-or-later
"""Numbers of a curve that only the laboratory needs; the others: caisson.curves."""
import numpy as np


def final_mean(position: np.ndarray, values: np.ndarray, length: float) -> float:
    """Return the mean of values [n] over the last length of the positions [n]."""
    return float(values[position > position[-1] - length].mean())


def relative_error(values: np.ndarray, reference: np.ndarray) -> float:
    """Return the root of the mean square of values / reference - 1."""
    return float(np.sqrt(np.mean((values / reference - 1) ** 2)))
