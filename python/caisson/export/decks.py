# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exported states as input of finite element programs: Abaqus, CalculiX, OpenSees."""
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from caisson import disk
from caisson.export.balance import Balanced
from caisson.export.state import GRAVITY
from caisson.export.text import TOTAL, about

POISSON = 0.3  # of the elastic soil in the files, which stands for the user's
HALF_ANGLE = np.radians(1)  # of the sector of bricks for OpenSees
NEAR_AXIS = 1e-3  # of the shortest radius: nodes of bricks do not lie on the axis


def numbers_by_eight(numbers: Iterable[int]) -> Iterator[str]:
    """Yield lines of numbers with commas."""
    some = list(numbers)
    for begin in range(0, len(some), 8):
        yield ", ".join(map(str, some[begin : begin + 8]))


def mesh_lines(state: Balanced) -> Iterator[str]:
    """Yield nodes, elements and their sets."""
    mesh = state.mesh
    yield "*NODE, NSET=ALL_NODES"
    for number, (r, z) in enumerate(mesh.nodes, 1):
        yield f"{number}, {r:.10g}, {z:.10g}"
    for kind, size, these in (
        ("CAX4", 4, ~mesh.is_triangle),
        ("CAX3", 3, mesh.is_triangle),
    ):
        if these.any():
            yield f"*ELEMENT, TYPE={kind}, ELSET=SOIL"
        for cell in np.flatnonzero(these):
            corners = ", ".join(str(node + 1) for node in mesh.cells[cell, :size])
            yield f"{cell + 1}, {corners}"
    for i, layer in enumerate(state.state.layers):
        yield f"*ELSET, ELSET=LAYER_{layer.number}"
        yield from numbers_by_eight(np.flatnonzero(state.values.layer == i) + 1)
    if mesh.groups is not None:
        for group in np.unique(mesh.groups):
            yield f"*ELSET, ELSET=GROUP_{group}"
            yield from numbers_by_eight(np.flatnonzero(mesh.groups == group) + 1)
    for name, nodes in mesh.sets.items():
        yield f"*NSET, NSET={name}"
        yield from numbers_by_eight(nodes + 1)


def soil_lines(state: Balanced) -> Iterator[str]:
    """Yield an elastic material and a section for each layer."""
    for layer in used_layers(state):
        yield f"*MATERIAL, NAME=SOIL_{layer.number}"
        yield "*ELASTIC"
        yield f"{layer.youngs_modulus:.6g}, {POISSON}"
        yield "*DENSITY"
        yield f"{layer.unit_weight / GRAVITY:.10g}"
        number = layer.number
        yield f"*SOLID SECTION, ELSET=LAYER_{number}, MATERIAL=SOIL_{number}"


def used_layers(state: Balanced) -> list:
    """Return the layers that have cells."""
    return [state.state.layers[i] for i in np.unique(state.values.layer)]


def held_lines(state: Balanced) -> Iterator[str]:
    """Yield what nodes are held, by sets."""
    yield "*BOUNDARY"
    for name, nodes in state.mesh.sets.items():
        for component in (0, 1):
            if name != "SURFACE" and state.held[nodes, component].all():
                yield f"{name}, {component + 1}, {component + 1}"


def load_lines(state: Balanced) -> Iterator[str]:
    """Yield the weight, and the forces of the wall and of water on the surface."""
    yield "*DLOAD"
    yield f"SOIL, GRAV, {GRAVITY}, 0., -1., 0."
    loaded = [
        f"{node + 1}, {component + 1}, {state.applied[node, component]:.9g}"
        for node, component in zip(*np.nonzero(state.applied * ~state.held))
    ]
    if loaded:
        yield "*CLOAD"
        yield from loaded


def abaqus(state: Balanced) -> Iterator[str]:
    """Yield the lines of an input file for Abaqus."""
    yield "*HEADING"
    yield "State of the soil of a run of caisson_mpm, SI units"
    yield from disk.remarks("**", [*about(state), TOTAL])
    yield "** Replace the elastic materials by your own before a step of loading."
    yield from mesh_lines(state)
    yield from soil_lines(state)
    yield "** element, S11 = rr, S22 = zz, S33 = tt, S12 = rz"
    yield "*INITIAL CONDITIONS, TYPE=STRESS"
    for number, stress in enumerate(state.total, 1):
        yield f"{number}, " + ", ".join(f"{value:.9g}" for value in stress)
    yield from held_lines(state)
    yield "*STEP, NAME=GEOSTATIC, NLGEOM=NO"
    yield "*GEOSTATIC"
    yield from load_lines(state)
    yield "*OUTPUT, FIELD, VARIABLE=PRESELECT"
    yield "*END STEP"


def calculix(state: Balanced) -> Iterator[str]:
    """Yield the lines of an input file for CalculiX, with stresses of all 8 points of
    the brick into which it expands an element."""
    yield "*HEADING"
    yield "State of the soil of a run of caisson_mpm, SI units"
    yield from disk.remarks("**", [*about(state), TOTAL])
    yield from mesh_lines(state)
    yield from soil_lines(state)
    yield "** element, point, rr, zz, tt, rz, 0, 0"
    yield "*INITIAL CONDITIONS, TYPE=STRESS"
    for number, stress in enumerate(state.total, 1):
        values = ", ".join(f"{value:.9g}" for value in (*stress, 0.0, 0.0))
        for point in range(1, 3 if state.mesh.is_triangle[number - 1] else 9):
            yield f"{number}, {point}, {values}"
    yield from held_lines(state)
    yield "*STEP"
    yield "*STATIC"
    yield from load_lines(state)
    yield "*NODE PRINT, NSET=ALL_NODES"
    yield "U, RF"
    yield "*EL PRINT, ELSET=SOIL"
    yield "S"
    yield "*END STEP"


SCRIPT = """\
ops.wipe()
ops.model("basic", "-ndm", 3, "-ndf", 3)
n = len(NODES)
for i, (r, z) in enumerate(NODES, 1):
    for tag, side in ((i, -1), (i + n, 1)):
        ops.node(tag, r * math.cos(HALF_ANGLE), side * r * math.sin(HALF_ANGLE), z)
held = {}
for i, fixed_r, fixed_z in HELD:
    held[i] = (fixed_r, fixed_z)
slope = math.tan(HALF_ANGLE)
for i in range(1, n + 1):
    fixed_r, fixed_z = held.get(i, (0, 0))
    for tag, side in ((i, -1), (i + n, 1)):
        if fixed_r or fixed_z:
            ops.fix(tag, fixed_r, fixed_r, fixed_z)
        if not fixed_r:  # the motion stays in the plane of the face
            ops.equationConstraint(tag, 2, 1.0, tag, 1, -side * slope)
for tag, (modulus, ratio) in LAYERS.items():
    ops.nDMaterial("ElasticIsotropic", tag, modulus, ratio)
first = max(LAYERS)
for e, (corners, layer, unit_weight, stress) in enumerate(ELEMENTS, 1):
    rr, zz, tt, rz = stress
    modulus, ratio = LAYERS[layer]
    shear = modulus / (2 * (1 + ratio))
    trace = rr + tt + zz
    strain = [((1 + ratio) * s - ratio * trace) / modulus for s in (rr, tt, zz)]
    # strains 11, 22, 33, 12, 23, 13; x is radial, y is along the circumference
    ops.nDMaterial("InitStrain", first + e, layer, *strain, 0.0, 0.0, rz / shear)
    back = [corner + n for corner in corners]
    ops.element("stdBrick", e, *back, *corners, first + e, 0.0, 0.0, -unit_weight)
ops.timeSeries("Linear", 1)
ops.pattern("Plain", 1, 1)
share = HALF_ANGLE / (2 * math.pi)  # of each of the two faces in the circumference
for i, force_r, force_z in LOADS:
    for tag in (i, i + n):
        ops.load(tag, share * force_r, 0.0, share * force_z)
ops.constraints("Transformation")
ops.numberer("RCM")
ops.system("UmfPack")
ops.test("NormDispIncr", 1e-8, 10)
ops.algorithm("Newton")
ops.integrator("LoadControl", 1.0)
ops.analysis("Static")
if __name__ == "__main__":
    ops.analyze(1)
    ops.loadConst("-time", 0.0)
    print("largest displacement of the equilibrium step (m):",
          max(abs(u) for i in range(1, n + 1) for u in ops.nodeDisp(i)))
"""


def opensees(state: Balanced) -> Iterator[str]:
    """Yield the lines of a script of OpenSeesPy: a sector of bricks, as its
    quadrilaterals are not axisymmetric."""
    mesh = state.mesh
    yield from disk.remarks("#", [*about(state), TOTAL])
    yield "# A sector of 2 degrees of bricks: x is radial, z is upward. InitStrain"
    yield "# gives each brick its stress; OpenSees has it since 2024."
    yield "# Replace the elastic soil by your own, in a stage after this one."
    yield "import math\n\nimport openseespy.opensees as ops\n"
    yield f"HALF_ANGLE = {HALF_ANGLE:.12g}  # rad"
    r = mesh.nodes[:, 0]
    least = NEAR_AXIS * r[r > 1e-9].min()
    yield "NODES = [  # r, z (m)"
    yield from (f"    ({max(x, least):.10g}, {z:.10g})," for x, z in mesh.nodes)
    yield "]\nHELD = [  # node, whether r and z are held"
    for node in np.flatnonzero(state.held.any(axis=1)):
        yield f"    ({node + 1}, {state.held[node, 0]:d}, {state.held[node, 1]:d}),"
    yield "]\nLOADS = [  # node, forces r and z for the whole circumference (N)"
    loads = state.applied * ~state.held
    for node in np.flatnonzero(loads.any(axis=1)):
        yield f"    ({node + 1}, {loads[node, 0]:.9g}, {loads[node, 1]:.9g}),"
    yield "]\nLAYERS = {  # Young's modulus (Pa), Poisson's ratio"
    for layer in used_layers(state):
        yield f"    {layer.number}: ({layer.youngs_modulus:.6g}, {POISSON}),"
    yield "}\nELEMENTS = [  # corners, layer, unit weight (N/m3), rr, zz, tt, rz (Pa)"
    for cell, layer, stress in zip(mesh.cells + 1, state.values.layer, state.total):
        number, weight = (
            state.state.layers[layer].number,
            state.state.layers[layer].unit_weight,
        )
        values = ", ".join(f"{value:.9g}" for value in stress)
        corners = ", ".join(map(str, cell))
        yield f"    (({corners}), {number}, {weight:.9g}, ({values})),"
    yield "]"
    yield SCRIPT


def write(path: Path, lines: Iterable[str]) -> None:
    """Write the lines of a file."""
    disk.write(path, "".join(f"{line}\n" for line in lines))
