# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an exported state says of itself: signs, balance and forces."""
from caisson.export.exported import Exported, force_of_run
from caisson.export.state import STIFFNESS, State

SIGNS = (
    "in Pa, positive in tension: rr radial, zz vertical, tt hoop, rz shear. Excess pore"
    " pressure is positive in compression.",
    "r is the distance from the axis, z is upward from the surface of the ground at the"
    " start (m). Forces are for the whole circumference.",
)
TOTAL = (
    "Stress here is the total stress less the hydrostatic pressure, which buoyant"
    " weight balances: without excess pore pressure, it is the effective stress."
)
NOT_BALANCED = (
    "The stress is interpolated between the points of the run. The first step of the"
    " other program must find its equilibrium."
)
POINTS = (
    "No balance is known of single points: near a wall they may be far from what bears"
    " it; --mesh or a grid shows how far."
)
# shares above which the stress does not stand for the forces of the run
LARGEST_OF_WALL, LARGEST_OF_WEIGHT = 0.1, 0.02
LEAST_WALL = 0.1  # of all forces on the body; smaller ones count as this


def percent(share: float) -> str:
    """Return a share in percent: two digits, and no power of ten where it is large."""
    return f"{float(f'{100 * share:.2g}'):.9g} %"


def total_layers(state: State) -> str:
    """Return the numbers of the layers whose stress is total."""
    return ", ".join(str(layer.number) for layer in state.layers if layer.total)


def about_signs(state: State) -> list[str]:
    """Return the lines on kind, unit and sign of the stress."""
    numbers, kind = total_layers(state), "effective"
    if numbers:
        is_all = all(layer.total for layer in state.layers)
        kind = "total" if is_all else f"effective, but total in layer {numbers}"
    return [f"Stresses are {kind}, {SIGNS[0]}", *SIGNS[1:]]


def about_total_stress(state: State) -> list[str]:
    """Return the line on layers whose stress is total."""
    numbers = total_layers(state)
    if not numbers:
        return []
    return [
        f"Layer {numbers}: undrained clay by total stress. Its stress is"
        " the total one less the hydrostatic pressure; its pore pressure is not known,"
        " and 0 here."
    ]


def about_state(state: State) -> list[str]:
    """Return what run and frame it is."""
    depth = f", penetration {state.penetration:.6g} m" if state.wall else ""
    where = f"at {state.time:.6g} s{depth}"
    lines = [f"caisson_mpm: {state.title}", where, *about_signs(state)]
    return [*lines, *about_total_stress(state), NOT_BALANCED]


def about_balance(state: Exported) -> list[str]:
    """Return the lines on the balance of the whole, and on the forces on the wall."""
    lines = [
        judged(state),
        f"Vertical balance: the weight of the soil is {state.weight / 1e3:.6g} kN, and"
        f" the stress on its boundary carries {state.boundary / 1e3:.6g} kN, which"
        f" differs by {percent(abs(state.boundary / state.weight - 1))}.",
    ]
    for name, force in state.wall.items():
        run = force_of_run(state.state, name)
        known = "unknown" if run is None else f"{run / 1e3:.5g}"
        lines.append(
            f"{name}: vertical force of the soil, upward: run {known}, of the"
            f" interpolated stress {force / 1e3:.5g} kN."
        )
    volumes = state.mesh.volumes
    tension = state.values.stress[:, :3].sum(axis=1) > 0
    share = percent(volumes[tension].sum() / volumes.sum())
    return [*lines, f"Mean stress is tensile in {share} of the volume."]


def differences(state: Exported) -> dict[str, float]:
    """Return by how much the stress differs from the weight of the soil, and from the
    forces of the run on the walls and the tip, as shares of 1."""
    known = {name: force_of_run(state.state, name) for name in state.wall}
    runs = {name: force for name, force in known.items() if force is not None}
    least = LEAST_WALL * sum(abs(force) for force in runs.values())
    found = {
        name: abs(state.wall[name] - force) / max(abs(force), least)
        for name, force in runs.items()
        if force or least
    }
    return {"the weight": abs(state.boundary / state.weight - 1), **found}


def judged(state: Exported) -> str:
    """Return what the stress is good for, in a line."""
    good = "It is a state to begin with, once the other program has found equilibrium"
    beyond = [
        f"{percent(share)} at {name}"
        for name, share in differences(state).items()
        if share > (LARGEST_OF_WEIGHT if name == "the weight" else LARGEST_OF_WALL)
    ]
    limits = (
        f"{percent(LARGEST_OF_WALL)} at a wall or tip, {percent(LARGEST_OF_WEIGHT)}"
    )
    if not beyond:
        return f"{good}: it differs by at most {limits} of the weight."
    return (
        f"WARNING: the stress differs from the run by {', '.join(beyond)}; limits:"
        f" {limits} of the weight. {good}; take no force or capacity of the caisson"
        " from it without that: history.csv has the forces."
    )


def about_stiffness(state: State) -> list[str]:
    """Return the lines on Young's moduli that are assumed."""
    return [
        f"Layer {layer.number}: its law has no Young's modulus. Input files assume"
        f" {layer.youngs_modulus:.3g} Pa, {STIFFNESS:g} times the norm of its stress."
        for layer in state.layers
        if layer.assumed
    ]


def about(state: Exported) -> list[str]:
    """Return all lines on a state on a mesh."""
    lines = [*about_state(state.state), *about_stiffness(state.state)]
    return [*lines, *filter(None, [state.mesh.remark]), *about_balance(state)]
