# SPDX-License-Identifier: LGPL-2.1-or-later
"""What follows an installation: the phases of the entry Installation/Phases, such as
"rest 30 d, retrieval to 0.5 m", and the entries of the run that computes each of them.

Each phase begins where the one before it ended. All but a rest move the body by a share
of the velocity of the scene (SHARES, as the scenes of prm do), with damping. Without a
depth they move it by 3 % of its diameter: friction needs 1 % (API RP 2GEO), and a plug
beneath a sealed lid about 2 % (prm/tension.prm).

A rest takes 5 s in the run, as that of prm/tension_after.prm, in which the water flows
as in its time (Water/Time compression). Without Time/Mass scaling, steps are ten times
as short, but the ground swings ten times as fast, too: 2 s are enough.
"""
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from caisson.results import Results
from caisson.runner import Entries, RunError
from caisson.units import SECONDS

ENTRY = "Installation/Phases"
END = "Time/End penetration"
LIST = "phases.txt"  # in the folder of the scene: the phases that were asked for last
REST, DRAINED, UNDRAINED = "rest", "pull drained", "pull undrained"
PUSH, RETRIEVAL = "push", "retrieval"
# of the velocity of the scene, positive downward
SHARES = {REST: 0.0, DRAINED: -0.2, UNDRAINED: -0.05, PUSH: 0.2, RETRIEVAL: -0.2}
LEAST_WAY, LARGEST_OVERSHOOT = 0.03, 1e-3  # of the diameter
NUMBER = r"\d{1,6}(?:\.\d*)?"
REST_RUN, LIGHT_REST_RUN = 5.0, 2.0  # s
LARGEST_SCALING = 100.0  # below a sealed lid, as in prm/tension.prm
RECORDS = 200  # rows of a phase
FORM = re.compile(
    rf"(?:{REST} +(?P<time>{NUMBER}) *(?P<unit>{'|'.join(SECONDS)})"
    rf"|(?P<word>{'|'.join(list(SHARES)[1:])})(?: +to +(?P<depth>{NUMBER})(?: *m)?)?)"
)
KNOWN = (
    f"{REST} TIME (such as 30 d, 12 h, 5 min), {DRAINED}, {UNDRAINED}, {PUSH} and"
    f" {RETRIEVAL}; all but a rest may end with to DEPTH, in m"
)
SCALING, TOLERANCE = "Time/Mass scaling", "Time/Inertia tolerance"
LID, WEIGHT = "Water/Suction control", "Rigid body/Submerged weight"
TABLES = ("Rigid body/Velocity table", "Water/Suction table", "Water/Pumped flow table")


class Phase(NamedTuple):
    """A phase: as it was written, its word, its depth (m), None where none is given,
    and of a rest the time (s)."""

    text: str
    word: str
    depth: float | None = None
    time: float = 0.0


def phase_of(text: str) -> Phase:
    """Return the phase that a text names. Raises RunError."""
    text = " ".join(text.split())
    if not (found := FORM.fullmatch(text)):
        raise RunError(f"{ENTRY}: {text!r} is no phase; known are {KNOWN}")
    if not found["word"]:
        return Phase(text, REST, None, float(found["time"]) * SECONDS[found["unit"]])
    depth = None if found["depth"] is None else float(found["depth"])
    return Phase(text, found["word"], depth)


def phases_in(text: str) -> list[Phase]:
    """Return the phases of a list with commas. Raises RunError."""
    return [phase_of(part) for part in text.split(",") if part.strip()]


def folder_of(phase: Phase, number: int) -> str:
    """Return the folder of a phase, in that of the scene, which is phase 1."""
    return f"phase_{number}_{phase.word.replace(' ', '_')}"


def title_of(title: str, phases: Sequence[Phase]) -> str:
    """Return the title of the last of some phases. It names those before it, too, so
    that a run is another one where they have changed."""
    return f"{title}: {'; '.join(phase.text for phase in phases)}"


def layer_with(is_undrained: bool, entries: Mapping[str, str]) -> int:
    """Return the number of the first layer whose strength is undrained, or of the first
    one whose strength is not; 0 of none."""
    for i in range(1, int(entries.get("Soil/Number of layers", "1")) + 1):
        law = entries.get(f"Soil/Layer {i}/Law", "")
        friction = entries.get(f"Soil/Layer {i}/Friction angle", "30")
        has_none = not friction.strip("0.")  # which may be an expression
        has_clay = law == "NGI-ADP" or (law == "Mohr-Coulomb" and has_none)
        if has_clay == is_undrained:
            return i
    return 0


def fault_of(phase: Phase, entries: Mapping[str, str]) -> str:
    """Return why a scene with these entries cannot have a phase, and what to do;
    nothing where it can."""
    level = entries.get("Water/Level", "drained")
    is_coupled = level == "coupled"
    if phase.word == REST and level == "undrained":
        return (
            "excess pressure does not flow with Water/Level = undrained; set Level ="
            " coupled, and a permeability of each layer"
        )
    if phase.word == REST and not is_coupled:
        return (
            f"nothing changes in a rest with Water/Level = {level}, which has no excess"
            " pressure that dissipates; leave it out and give Design/Factor on set-up,"
            " or set Level = coupled"
        )
    if phase.word == REST and not phase.time:
        return "give a time above 0"
    if phase.depth == 0:
        return "no run ends at the mudline; give a depth above 0, such as to 0.1 m"
    if phase.word != REST and not float(entries.get("Rigid body/Velocity", "0.1")):
        return "its velocity is a share of Rigid body/Velocity, which is 0; set it"
    if phase.word == UNDRAINED and not is_coupled:
        return (
            f"its sealed lid needs water that flows, and Water/Level is {level}; set"
            " Level = coupled, and a permeability of each layer"
        )
    if phase.word == DRAINED and (layer := layer_with(True, entries)):
        return (
            f"the strength of layer {layer} is undrained, and so is each pull; give"
            f" it a law with a drained friction angle, or write {RETRIEVAL}"
        )
    if phase.word == DRAINED and level == "undrained":
        return (
            "the excess pressure of Water/Level = undrained would become effective"
            " stress; set Level = coupled, and a permeability of each layer, and write"
            f" {REST} TIME before it"
        )
    is_dry = phase.word == RETRIEVAL and level == "drained"
    if is_dry and (layer := layer_with(False, entries)):
        return (
            f"water beneath the lid flows through layer {layer}, and Water/Level is"
            " drained; set Level = seepage, and a permeability of each layer, or write"
            f" {DRAINED}"
        )
    return ""


def refuse_depth(phase: Phase, at: float, entries: Mapping[str, str]) -> None:
    """Refuse a phase that cannot begin at a depth (m), as its own lies behind that.
    Raises RunError."""
    end = end_of(phase, at, entries)
    if phase.word == REST or (end > 0 and (end - at) * SHARES[phase.word] > 0):
        return
    where = "below" if phase.word == PUSH else "above"
    fault = f"give a depth {where} {at:g} m, where the phase before it ends"
    if phase.depth is None:
        fault += (
            f": the way of {100 * LEAST_WAY:g} % of the diameter ends at the mudline"
        )
    raise RunError(f"{ENTRY}: {phase.text}: {fault}")


def refuse_faults(phases: Sequence[Phase], entries: Mapping[str, str]) -> float:
    """Refuse phases that the scene cannot have, before anything is run; entries: those
    in effect. Return the largest depth that they reach (m). Raises RunError."""
    end = entries.get(END, "never")
    at, deepest = None if end == "never" else float(end), 0.0
    for phase in phases:
        if fault := fault_of(phase, entries):
            raise RunError(f"{ENTRY}: {phase.text}: {fault}")
        if at is not None:
            refuse_depth(phase, at, entries)
            at = end_of(phase, at, entries)
        deepest = max(deepest, at or phase.depth or 0.0)
    return deepest


def end_of(phase: Phase, at: float, entries: Mapping[str, str]) -> float:
    """Return the depth (m) at which a phase that begins at a depth (m) ends."""
    if phase.depth is not None or phase.word == REST:
        return at if phase.depth is None else phase.depth
    way = LEAST_WAY * float(entries["Rigid body/Outer diameter"])
    return max(round(at + (way if phase.word == PUSH else -way), 6), 0.0)


def velocity_of(phases: Sequence[Phase], entries: Mapping[str, str]) -> float:
    """Return the velocity (m/s) of the last of some phases, or that of the scene."""
    share = SHARES[phases[-1].word] if phases else 1.0
    return share * abs(float(entries["Rigid body/Velocity"]))


def ramp_of(phases: Sequence[Phase], entries: Mapping[str, str]) -> float:
    """Return the time (s) in which the last of some phases comes to its velocity, so
    short that the body hardly goes on as before. A rest has none: a plug that still
    moves would tear at the lid."""
    if phases[-1].word == REST:
        return 0.0
    before = abs(velocity_of(phases[:-1], entries))
    way = LARGEST_OVERSHOOT * float(entries["Rigid body/Outer diameter"])
    return min(1.0, 2 * way / before) if before else 1.0


def motion_of(
    phases: Sequence[Phase], at: float, entries: Mapping[str, str]
) -> Entries:
    """Return the entries of how the body moves in the last of some phases, and where
    its run ends. at: where it begins (m)."""
    velocity, end = velocity_of(phases, entries), end_of(phases[-1], at, entries)
    seconds = abs(end - at) / abs(velocity) if velocity else rest_run(entries)
    return {
        "Rigid body/Motion": "prescribed",
        "Rigid body/Velocity": f"{velocity:.6g}",
        "Rigid body/Ramp time": f"{ramp_of(phases, entries):.3g}",
        "Method/Local damping": 0.4,
        END: end if velocity else "never",
        "Time/End time": "never" if velocity else seconds,
        "Output/Record interval": f"{seconds / RECORDS:.3g}",
    }


def rest_run(entries: Mapping[str, str]) -> float:
    """Return the time (s) of a rest in its run."""
    return REST_RUN if float(entries.get(SCALING, "1")) > 1 else LIGHT_REST_RUN


def inertia_of(phase: Phase, entries: Mapping[str, str], scaling: float) -> Entries:
    """Return the entries of the inertia of the soil below a sealed lid. Time/Mass
    scaling stays, as it must after an installation. A tolerance needs a velocity, and
    becomes that of a slower one. scaling: the largest one of the mass in the
    installation, which is kept, as far as it may be."""
    tolerance = entries.get(TOLERANCE, "none")
    if phase.word not in (REST, UNDRAINED) or tolerance == "none":
        return {}
    share = SHARES[phase.word] ** 2 * min(1, LARGEST_SCALING / scaling)
    return {TOLERANCE: f"{float(tolerance) * share:.3g}" if share else "none"}


def water_of(phase: Phase, entries: Mapping[str, str]) -> Entries:
    """Return the entries of water and lid."""
    level, compression = entries.get("Water/Level", "drained"), "Water/Time compression"
    sealed, automatic = {LID: "sealed"}, {LID: "automatic"}
    vented = {LID: "table", "Water/Suction table": "0:0", WEIGHT: "0"}
    has_flow = level in ("seepage", "coupled")  # where automatic is a required suction
    faster = max(phase.time / rest_run(entries), 1)
    of_word: dict[str, Entries] = {
        REST: {**sealed, compression: f"{faster:.6g}"},
        DRAINED: {"Water/Level": "drained", **automatic},
        UNDRAINED: {**sealed, compression: "1"},
        PUSH: vented if has_flow else automatic,
        RETRIEVAL: {LID: "required"},
    }
    return of_word[phase.word]


def entries_of(
    phases: Sequence[Phase], before: Path, entries: Mapping[str, str], title: str
) -> Entries:
    """Return what the last of some phases sets beside the scene with entries in effect.
    before: the folder of the run where it begins. Raises ResultsError, or RunError
    where that run has ended elsewhere than its scene says."""
    run, phase = Results(before), phases[-1]
    at = float(run.history["penetration_m"][-1])
    refuse_depth(phase, at, entries)
    first = before if len(phases) == 1 else before.parent  # see folder_of
    scaling = max(Results(first).summary.get("mass_scaling") or [1.0])
    return {
        "Title": title_of(title, phases),
        ENTRY: "",
        "Installation/Directory": before,
        "Output/Frame interval": "never",
        "Output/Frame penetrations": "",
        **{name: "" for name in TABLES if entries.get(name)},
        **motion_of(phases, at, entries),
        **water_of(phase, entries),
        **inertia_of(phase, entries, scaling),
    }
