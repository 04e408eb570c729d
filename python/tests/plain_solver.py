# SPDX-License-Identifier: LGPL-2.1-or-later
"""A plain reader of exported input files, and forces of nodes from them.

It shares nothing with caisson.export: loops over elements and Gauss points, with the
formulas of a textbook (Zienkiewicz and Taylor, axisymmetric stress analysis)."""
import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))
POINT = 1 / math.sqrt(3)


@dataclass
class Deck:
    """An input file of Abaqus or CalculiX: numbers begin with 1."""

    nodes: dict[int, tuple[float, float]] = field(default_factory=dict)
    elements: dict[int, list[int]] = field(default_factory=dict)
    node_sets: dict[str, list[int]] = field(default_factory=dict)
    element_sets: dict[str, list[int]] = field(default_factory=dict)
    density: dict[str, float] = field(default_factory=dict)
    section: dict[str, str] = field(default_factory=dict)
    stress: dict[int, list[float]] = field(default_factory=dict)
    held: set[tuple[int, int]] = field(default_factory=set)
    loads: dict[tuple[int, int], float] = field(default_factory=dict)
    gravity: float = 0.0


def options_of(line: str) -> dict[str, str]:
    """Return the parameters of a line with a keyword; the keyword is under ""."""
    words = [word.strip() for word in line[1:].split(",")]
    pairs = [word.split("=") for word in words[1:] if "=" in word]
    return {"": words[0], **{a.strip(): b.strip() for a, b in pairs}}


def read_deck(path: Path) -> Deck:
    """Return what a file says."""
    deck, options, material = Deck(), {"": ""}, ""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            options = options_of(line)
            if options[""] == "MATERIAL":
                material = options["NAME"]
            if options[""] == "SOLID SECTION":
                deck.section[options["ELSET"]] = options["MATERIAL"]
            continue
        take_line(deck, options, material, [word.strip() for word in line.split(",")])
    return deck


def take_line(
    deck: Deck, options: dict[str, str], material: str, words: list[str]
) -> None:
    """Take one line of data."""
    keyword = options[""]
    if keyword == "NODE":
        deck.nodes[int(words[0])] = (float(words[1]), float(words[2]))
    elif keyword == "ELEMENT":
        deck.elements[int(words[0])] = [int(word) for word in words[1:]]
    elif keyword == "NSET":
        deck.node_sets.setdefault(options["NSET"], []).extend(map(int, words))
    elif keyword == "ELSET":
        deck.element_sets.setdefault(options["ELSET"], []).extend(map(int, words))
    elif keyword == "DENSITY":
        deck.density[material] = float(words[0])
    elif keyword == "INITIAL CONDITIONS":
        first = 2 if len(words) > 5 else 1  # the number of a point is before them
        deck.stress[int(words[0])] = [float(x) for x in words[first : first + 4]]
    elif keyword == "BOUNDARY":
        for node in deck.node_sets[words[0]]:
            for component in range(int(words[1]), int(words[2]) + 1):
                deck.held.add((node, component))
    elif keyword == "CLOAD":
        deck.loads[int(words[0]), int(words[1])] = float(words[2])
    elif keyword == "DLOAD":
        deck.gravity = float(words[2])


def points_of(
    corners: np.ndarray,
) -> list[tuple[np.ndarray, np.ndarray, float, float]]:
    """Return N, its gradient [2, n], r and the volume of the circumference at the
    points of an element with 3 or 4 corners [n, 2]."""
    if len(corners) == 3:
        (x1, y1), (x2, y2), (x3, y3) = corners
        area = ((x2 - x1) * (y3 - y1) - (x3 - x1) * (y2 - y1)) / 2
        gradient = np.array([[y2 - y3, y3 - y1, y1 - y2], [x3 - x2, x1 - x3, x2 - x1]])
        result = []
        for k in range(3):
            shape = np.full(3, 1 / 6)
            shape[k] = 2 / 3
            r = float(shape @ corners[:, 0])
            volume = 2 * math.pi * r * area / 3
            result.append((shape, gradient / (2 * area), r, volume))
        return result
    result = []
    for x, y in CORNERS:
        shape, local = np.zeros(4), np.zeros((2, 4))
        for k, (a, b) in enumerate(CORNERS):
            shape[k] = (1 + a * x * POINT) * (1 + b * y * POINT) / 4
            local[:, k] = a * (1 + b * y * POINT) / 4, b * (1 + a * x * POINT) / 4
        jacobian = local @ corners
        r = float(shape @ corners[:, 0])
        volume = 2 * math.pi * r * float(np.linalg.det(jacobian))
        result.append((shape, np.linalg.solve(jacobian, local), r, volume))
    return result


@dataclass
class NodeForces:
    """Forces of nodes by number and component 1 or 2 (N): of the stress, and of the
    weight; the whole weight (N)."""

    inner: dict[tuple[int, int], float]
    weight: dict[tuple[int, int], float]
    whole: float

    def residual(self, deck: Deck) -> float:
        """Return the sum of |R| without held components over the weight."""
        total = 0.0
        for node in deck.nodes:
            parts = [
                self.inner.get(key, 0)
                - self.weight.get(key, 0)
                - deck.loads.get(key, 0)
                for key in ((node, 1), (node, 2))
                if key not in deck.held
            ]
            total += math.hypot(*parts)
        return total / self.whole

    def on_body(self, deck: Deck, name: str) -> float:
        """Return the upward force of the soil on the wall with these nodes (N)."""
        return -sum(
            self.inner[node, 2] - self.weight[node, 2] for node in deck.node_sets[name]
        )


def forces_of(deck: Deck) -> NodeForces:
    """Return the forces of all nodes."""
    unit_weight = {
        element: deck.gravity * deck.density[material]
        for name, material in deck.section.items()
        for element in deck.element_sets[name]
    }
    inner: dict[tuple[int, int], float] = {}
    weight: dict[tuple[int, int], float] = {}
    whole = 0.0
    for number, nodes in deck.elements.items():
        rr, zz, tt, rz = deck.stress[number]
        corners = np.array([deck.nodes[node] for node in nodes])
        for shape, gradient, r, volume in points_of(corners):
            whole += unit_weight[number] * volume
            for k, node in enumerate(nodes):
                n_r, n_z = gradient[:, k]
                force = n_r * rr + n_z * rz + shape[k] / r * tt, n_z * zz + n_r * rz
                for component in (1, 2):
                    key = node, component
                    inner[key] = inner.get(key, 0) + volume * force[component - 1]
                key = node, 2
                lost = unit_weight[number] * volume * shape[k]
                weight[key] = weight.get(key, 0) - lost
    return NodeForces(inner, weight, whole)
