# SPDX-License-Identifier: LGPL-2.1-or-later
"""The band of a scene: the same caisson in soil of low, best and high resistance.

Three scenes NAME_low.prm, NAME.prm and NAME_high.prm lie beside each other, and so do
their results. The one without a suffix is the best estimate; the others may be absent.
It may also be called NAME_best, as the run of a study.
"""
from pathlib import Path

from caisson.results import Results

LOW, BEST, HIGH = "low", "best", "high"
ESTIMATES = (LOW, BEST, HIGH)
SCENE = ".prm"
SAME = ("diameter_m", "skirt_length_m", "wall_thickness_m", "submerged_weight_N")


def member_of(best: Path, estimate: str) -> Path:
    """Return the scene, or the directory of results, of an estimate."""
    if estimate == BEST:
        return best
    best = best if best.name.strip(".") else best.resolve()  # not "." or ".."
    name = best.name.removesuffix(SCENE)
    stem, ending = name.removesuffix(f"_{BEST}"), best.name[len(name) :]
    return best.with_name(f"{stem}_{estimate}{ending}")


def caisson_of(run: Results) -> list[object]:
    """Return what the runs of a band have in common: sizes and weight."""
    return [run.scene.get(name) for name in SAME]


def band_of(run: Results) -> dict[str, Results]:
    """Return the runs of the band around a best estimate that exist, by estimate, that
    run included; one of another caisson is none of them."""
    if run.estimates:
        return run.estimates
    found = {BEST: run}
    for estimate in (LOW, HIGH):
        directory = member_of(run.directory, estimate)
        if (directory / "history.csv").is_file():
            member = Results(directory)
            if caisson_of(member) == caisson_of(run):
                found[estimate] = member
    return {estimate: found[estimate] for estimate in ESTIMATES if estimate in found}
