# SPDX-License-Identifier: LGPL-2.1-or-later
"""Springs of a caisson as a table of t-z curves, and what is said of them."""
from pathlib import Path

import numpy as np

from caisson import table
from caisson.export.springs import SMALL, STILL_GROWS, WALLS, Springs

ROWS = 25  # of a curve in the table
SAME_DEPTH = 0.03  # of the depth, by which two runs beside each other may differ


def about_springs(found: Springs) -> list[str]:
    """Return what run and motion it is, and what the whole body does."""
    down = found.direction > 0
    largest = int(np.argmax(found.force))
    is_missing = found.missing > 0.02 * found.force.max()
    begin = f"the soil bears the submerged weight of {found.weight / 1e3:.5g} kN"
    if not found.weight:
        begin = "the soil bears nothing, as no submerged weight is given (--weight)"
    if is_missing:
        begin = "the motion begins"
    lines = [
        f"caisson_mpm: {found.title}",
        f"{'Pushed' if down else 'Pulled'} by {1e3 * found.displacement[-1]:.4g} mm"
        f" from {found.depth:.5g} m, where {begin}.",
        about_parts(found),
        f"Largest resistance {found.force[largest] / 1e3:.4g} kN at"
        f" {1e3 * found.displacement[largest]:.3g} mm.",
    ]
    for share in SMALL:
        if np.isfinite(stiffness := found.stiffness(share)):
            lines.append(
                f"Secant stiffness at {1e3 * share * found.diameter:.3g} mm"
                f" ({100 * share:g} % of the diameter): {stiffness / 1e6:.4g} MN/m."
            )
    if found.growth > STILL_GROWS:
        lines.append(
            f"WARNING: the resistance still grows at the end, by"
            f" {100 * found.growth:.2g} % in the last tenth of the motion: the largest"
            " one is no ultimate. Move the caisson farther."
        )
    if is_missing:
        lines.append(
            f"WARNING: at the beginning the soil bears {found.missing / 1e3:.4g} kN"
            f" {'more' if down else 'less'} than the weight, so that the curves lack"
            f" this part. Let the run {'un' if down else ''}load the caisson to its"
            " weight first, or give its --weight."
        )
    return lines + about_waves(found)


def about_parts(found: Springs) -> str:
    """Return how many springs the walls have, and what area and depth they cover."""
    texts = []
    for wall in WALLS:
        parts = [spring for spring in found.springs if spring.place == wall]
        if parts:
            depths = [spring.depth for spring in parts]
            texts.append(
                f"{len(parts)} on {sum(spring.area for spring in parts):.4g} of the"
                f" {found.walls[wall]:.4g} m2 of the {wall} wall, with mean depths from"
                f" {min(depths):.2g} to {max(depths):.2g} m"
            )
    return f"Springs: {'; '.join(texts) or 'none on the walls'}."


def about_waves(found: Springs) -> list[str]:
    """Return a warning where the waves have not gone far at the smallest displacement
    whose stiffness is stated, or where this is not known."""
    reach, needed = found.reach_at_first, found.needed_reach
    first = 1e3 * SMALL[0] * found.diameter
    if reach >= needed or first > 1e3 * found.displacement[-1]:
        return []
    if np.isnan(reach):
        return [
            "WARNING: a layer above the tip has a law without a Young's modulus, so"
            " that nothing says whether waves have gone far enough. Compare with a run"
            " that moves at half the speed."
        ]
    far = found.reach >= needed
    curve = "the whole curve contains"
    if far.any():
        end = 1e3 * found.displacement[np.argmax(far)]
        curve = f"the curve below {end:.2g} mm contains"
    return [
        f"WARNING: when the caisson has moved by {first:.3g} mm, a shear wave has gone"
        f" {reach:.2g} m from the wall, and the soil within {needed:.2g} m must take"
        f" part: {curve} its inertia. Multiply Time/Inertia tolerance or Time/Mass"
        f" scaling by {(reach / needed) ** 2:.1g}, or move the caisson more slowly."
    ]


def about_both(found: Springs, other: Springs | None) -> list[str]:
    """Return what the run is, and the one beside it."""
    lines = about_springs(found)
    if other is None:
        return lines
    lines += ["Beside it:", *about_springs(other)]
    if abs(other.depth - found.depth) > SAME_DEPTH * found.depth:
        lines.append(
            f"WARNING: the tips are at {found.depth:.4g} m and {other.depth:.4g} m: a"
            " part of these differences is that of the depths."
        )
    return lines


def rows_of(found: Springs) -> np.ndarray:
    """Return the records for a table: close to each other where the curves begin."""
    last = len(found.displacement) - 1
    shares = np.linspace(0, 1, ROWS) ** 2
    wanted = np.searchsorted(found.displacement, shares * found.displacement[-1])
    return np.unique(np.minimum(wanted, last))


def beside(found: Springs, other: Springs, number: int) -> np.ndarray:
    """Return the resistance of the other run's nearest spring at the displacements
    [n] (Pa); nan where it has none, or ends before."""
    mine = found.springs[number]
    near = [s for s in other.springs if s.place == mine.place]
    if not near:
        return np.full(len(found.displacement), np.nan)
    nearest = min(near, key=lambda s: abs(s.depth - mine.depth))
    at = found.displacement
    values = np.interp(at, other.displacement, nearest.resistance)
    return np.where(at <= other.displacement[-1], values, np.nan)


def write_csv(path: Path, found: Springs, other: Springs | None) -> None:
    """Write one row for each spring and displacement."""
    names = ["place", "depth_m", "area_m2", "displacement_mm"]
    names += ["displacement_over_diameter", "resistance_kPa"]
    names += ["resistance_over_ultimate", "stress_kPa"]
    names += ["beside_resistance_kPa"] * (other is not None)
    lines = []
    for number, spring in enumerate(found.springs):
        compared = None if other is None else beside(found, other, number)
        for row in rows_of(found):
            z, t = found.displacement[row], spring.resistance[row]
            values = [spring.depth, spring.area, 1e3 * z, z / found.diameter]
            values.append(t / 1e3)
            values.append(t / spring.ultimate if spring.ultimate else np.nan)
            values.append((spring.before + found.direction * t) / 1e3)
            if compared is not None:
                values.append(compared[row] / 1e3)
            lines.append([spring.place, *(f"{v:.6g}" for v in values)])
    table.write_csv(path, names, lines, [*about_both(found, other), *SIGNS])


SIGNS = (
    "t of a wall and q of the tip: the resistance is the change of the stress since the"
    " displacement began, against the motion; stress_kPa is the stress itself, upward"
    " on the caisson. Both are effective. The ultimate is the largest of the curve.",
)
