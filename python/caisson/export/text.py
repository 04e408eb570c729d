# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an exported state says of itself: signs, balance and forces."""
from pathlib import Path

from caisson.export.exported import Exported, force_of_run
from caisson.export.state import STIFFNESS, State
from caisson.template import say, say_rows

WORDS = Path(__file__).with_name("words.jinja")
TOTAL = (
    "Stress here is the total stress less the hydrostatic pressure, which buoyant"
    " weight balances: without excess pore pressure, it is the effective stress."
)
POINTS = (
    "No balance is known of single points: near a wall they may be far from what bears"
    " it; --mesh or a grid shows how far."
)
# shares above which the stress does not stand for the forces of the run
LARGEST_OF_WALL, LARGEST_OF_WEIGHT = 0.1, 0.02
LEAST_WALL = 0.1  # of all forces on the body; smaller ones count as this


def lines(name: str, *data: object) -> list[str]:
    """Return the lines that a macro of WORDS makes of data."""
    return [text for _, text in say_rows(WORDS, name, *data)]


def about_state(state: State) -> list[str]:
    """Return what run and frame it is."""
    total = [str(layer.number) for layer in state.layers if layer.total]
    is_all = len(total) == len(state.layers)
    return [
        f"caisson_mpm: {state.title}",
        *lines("state", state, ", ".join(total), is_all),
    ]


def about_balance(state: Exported) -> list[str]:
    """Return the lines on the balance of the whole, and on the forces on the wall."""
    volumes = state.mesh.volumes
    tension = state.values.stress[:, :3].sum(axis=1) > 0
    forces = {k: (force_of_run(state.state, k), x) for k, x in state.wall.items()}
    share = volumes[tension].sum() / volumes.sum()
    found = lines("balance", state.weight, state.boundary, forces, share)
    return [judged(state), *found]


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
    beyond = {
        name: share
        for name, share in differences(state).items()
        if share > (LARGEST_OF_WEIGHT if name == "the weight" else LARGEST_OF_WALL)
    }
    return say(WORDS, "judged", beyond, (LARGEST_OF_WALL, LARGEST_OF_WEIGHT))


def about(state: Exported) -> list[str]:
    """Return all lines on a state on a mesh."""
    found = about_state(state.state)
    found += lines("stiffness", state.state.layers, STIFFNESS)
    return [*found, *filter(None, [state.mesh.remark]), *about_balance(state)]
