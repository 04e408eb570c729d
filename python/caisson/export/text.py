# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an exported state says of itself: signs, residual, correction and forces."""
import numpy as np

from caisson.export.balance import WANTED, Balanced, force_of_run
from caisson.export.state import STIFFNESS, State

SIGNS = (
    "Stresses are effective, in Pa, positive in tension: rr radial, zz vertical, tt"
    " hoop, rz shear. Excess pore pressure is positive in compression.",
    "r is the distance from the axis, z is upward from the surface of the ground at the"
    " start (m). Forces are for the whole circumference.",
)
TOTAL = (
    "Stress here is effective stress less excess pore pressure, which buoyant weight"
    " balances: without pore water, it is the effective stress."
)


def percent(share: float) -> str:
    """Return a share in percent: two digits, and no power of ten where it is large."""
    return f"{float(f'{100 * share:.2g}'):.9g} %"


def about_state(state: State) -> list[str]:
    """Return what run and frame it is."""
    depth = f", penetration {state.penetration:.6g} m" if state.wall else ""
    return [f"caisson_mpm: {state.title}", f"at {state.time:.6g} s{depth}"]


def about_points(state: State) -> list[str]:
    """Return the lines on values at given points."""
    return [
        *about_state(state),
        *SIGNS,
        "Values at points are interpolated, and not balanced: that needs a mesh.",
    ]


def largest_correction(state: Balanced) -> str:
    """Return where the correction is largest, and how large."""
    size = np.linalg.norm(state.correction, axis=1)
    cell = int(np.argmax(size))
    r, z = state.mesh.centers[cell]
    stress = np.linalg.norm(state.stress[cell])
    return (
        f"The largest one, {size[cell] / 1e3:.3g} kPa of {stress / 1e3:.3g} kPa, is at"
        f" r = {r:.3g} m, z = {z:.3g} m."
    )


def about_correction(state: Balanced) -> list[str]:
    """Return the lines on residual and correction."""
    lines = [
        f"Residual, the sum of the out-of-balance forces over the weight of"
        f" {state.weight / 1e3:.6g} kN: {percent(state.before)} as interpolated,"
        f" {percent(state.after)} as exported."
    ]
    if not state.correction.any():
        return [*lines, "The interpolated stress is exported without a correction."]
    share = state.volume[state.exceeds].sum() / state.volume.sum()
    lines.append(
        f"The correction of the stress is {percent(state.size_of_correction)} of it"
        f" (mean of squares), and exceeds the scatter of the points in"
        f" {percent(share)} of the volume. {largest_correction(state)}"
    )
    if state.after > WANTED:
        lines.append(
            "WARNING: the residual could not be made small on this mesh: refine it"
            " where the stress changes fast, or avoid slender cells."
        )
    return lines


def about_wall(state: Balanced) -> list[str]:
    """Return the lines on the forces of the soil on the wall."""
    lines = []
    for name, force in state.wall.items():
        run = force_of_run(state.state, name)
        known = "unknown" if run is None else f"{run / 1e3:.5g}"
        lines.append(
            f"{name}: vertical force of the soil, upward: run {known}, interpolated"
            f" {state.wall_before[name] / 1e3:.5g}, exported {force / 1e3:.5g} kN."
        )
    tension = state.stress[:, :3].sum(axis=1) > 0
    share = percent(state.volume[tension].sum() / state.volume.sum())
    return [*lines, f"Mean stress is tensile in {share} of the volume."]


def about_stiffness(state: State) -> list[str]:
    """Return the lines on Young's moduli that are assumed."""
    return [
        f"Layer {layer.number}: its law has no Young's modulus. Input files assume"
        f" {layer.youngs_modulus:.3g} Pa, {STIFFNESS:g} times the norm of its stress,"
        " as the correction does."
        for layer in state.layers
        if layer.assumed
    ]


def about(state: Balanced) -> list[str]:
    """Return all lines on a balanced state."""
    lines = [*about_state(state.state), *SIGNS, *about_stiffness(state.state)]
    lines += filter(None, [state.mesh.remark])
    return [*lines, *about_correction(state), *about_wall(state)]
