# SPDX-License-Identifier: LGPL-2.1-or-later
"""What run.json has, as far as it is read: doc/how_to/run.schema.json in short."""
from collections.abc import Iterator
from typing import Any

NUMBER: Any = (int, float)
OR_NONE: Any = (*NUMBER, type(None))  # where there is no finite one
ANY = "*"  # every other name
TEXTS = {ANY: str}
LAYER: dict[str, Any] = {
    **dict.fromkeys(("law", "library_checksum"), str),
    "law_entries": [{"entry": str, "value": OR_NONE, "unit": str}],
    ANY: NUMBER,
}
RESULTS: dict[str, Any] = {"warnings": [{"rank": str, "text": str}]}
RUN: dict[str, Any] = {
    **dict.fromkeys(("version", "dealii_version", "scene_file", "title"), str),
    **dict.fromkeys(("command", "written", "status", "failure", "installation"), str),
    **dict.fromkeys(("fingerprint", "time_step_limit"), str),
    **dict.fromkeys(("entries", "units", "defaults"), TEXTS),
    **dict.fromkeys(("assumed", "warnings"), [str]),
    **dict.fromkeys(("energies", "progress"), {ANY: OR_NONE}),
    **dict.fromkeys(("ranks", "cells", "steps", "material_points"), NUMBER),
    **dict.fromkeys(("wall_time_s", "time_step_s", "start_penetration_m"), NUMBER),
    **dict.fromkeys(("peak_memory_bytes", "max_points_in_body"), NUMBER),
    "mass_scaling": [NUMBER],
    "results": RESULTS,
    "tip": {"interface_depths_m": [NUMBER], ANY: NUMBER},
    "scene": {
        "end_reason": str,
        "infeasible": {"penetration_m": NUMBER, "reason": str},
        "design_methods": {"load_spread": OR_NONE},
        "frame_penetrations_m": [NUMBER],
        "layers": [LAYER],
        ANY: OR_NONE,
    },
}
# of a run that finished; earlier versions wrote neither "written" nor all of these
NEEDED = "entries", "units", "defaults", "assumed", "results", "energies", "scene"


def faults(found: Any, shape: Any = RUN, key: str = "") -> Iterator[str]:
    """Yield the keys whose values are of another type, and what they should be."""
    if isinstance(shape, dict):
        if not isinstance(found, dict):
            yield f"{key} is {found!r:.60}, and no object {{...}}"
            return
        for name, value in found.items():
            if (inner := shape.get(name, shape.get(ANY))) is not None:
                yield from faults(value, inner, f"{key}/{name}".lstrip("/"))
    elif isinstance(shape, list):
        if not isinstance(found, list):
            yield f"{key} is {found!r:.60}, and no list [...]"
            return
        for number, value in enumerate(found, 1):
            yield from faults(value, shape[0], f"{key}/{number}")
    elif not isinstance(found, shape):
        what = "text" if shape is str else "number"
        yield f"{key} is {found!r:.60}, and no {what}"
