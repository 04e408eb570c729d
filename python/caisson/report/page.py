# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a report: contents, pictures and scripts in one file."""
import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from caisson.template import picture_of, template
from caisson import evaluation, plot
from caisson.verdict import installation, limits, run_review
from caisson.lock import is_locked
from caisson.progress import duration
from caisson.needed import JAVASCRIPT, SCRIPTS
from caisson.results import Results
from caisson.report import (
    band,
    content,
    layers,
    methods,
    pull,
    remedies,
    scene,
    sketch,
    verdict,
)
from caisson.verdict.installation import Installation, Rate

HERE = Path(__file__).parent
REFRESH = 20  # s, of the page of a run that has not ended
# name of a picture without its suffix: what it shows
PICTURES = {
    "stress": "Vertical stress",
    "pore_pressure": "Excess pore pressure, beside the vertical stress",
    "walls": "Stresses along the walls",
    "displacement": "Displacement",
    "void_ratio": "Void ratio",
}
AT_PENETRATION = re.compile(r"at a penetration of ([\d.]+) m")  # in a warning
CHARTS = ("walls",)  # pictures of lines, not of fields
LAST_ROWS = "The run failed: do not use the last rows."


def script(name: str) -> str:
    """Return a script of Debian's for the page."""
    text = (JAVASCRIPT / name).read_text(encoding="utf-8")
    return text.replace("</script", "<\\/script")


def pictures_of(run: Results) -> list[dict[str, str]]:
    """Return the run's pictures as data, each with what it shows; drawn where the run
    has left none."""
    if not (run.directory / "forces.png").is_file() and not run.is_running:
        plot.draw(run.directory)
    found = []
    for name, shows in PICTURES.items():
        path = run.directory / f"{name}.png"
        if path.is_file():
            found.append({"name": name, "shows": shows, "data": picture_of(path)})
    return found


def facts_of(run: Results) -> list[tuple[str, str]]:
    """Return versions, sizes and times; of a run that failed, those that are known."""
    if run.is_running:
        return []
    summary = run.summary
    points = summary.get("material_points", "not known")
    facts = [
        ("Results", run.directory.resolve().name),
        ("Cells, material points", f"{summary['cells']}, {points}"),
        ("Steps", steps_of(run)),
        ("Limit of the step", str(summary["time_step_limit"])),
        ("Ranks", str(summary["ranks"])),
        ("Time", f"{summary['wall_time_s']:.0f} s"),
        ("Fingerprint of the scene", str(summary["fingerprint"])),
    ]
    if words := scene.mass_scaling_of(run):
        facts.insert(3, ("Mass scaling", words))
    if command := summary.get("command"):
        facts.insert(1, ("Command", str(command)))
    if "peak_memory_bytes" in summary:
        facts.append(("Memory", f"{summary['peak_memory_bytes'] / 1e6:.0f} MB"))
    return facts


def steps_of(run: Results) -> str:
    """Return the number of steps, and their range of lengths."""
    steps = run.history.get("time_step_s", np.array([run.summary["time_step_s"]]))
    steps = steps[np.isfinite(steps) & (steps > 0)]
    ends = dict.fromkeys(f"{end:.2g}" for end in (steps.min(), steps.max()))
    return f"{run.summary['steps']} of {' to '.join(ends)} s"


def progress_of(run: Results) -> tuple[float, str]:
    """Return how much of a run is done (%), and in words how long it takes still."""
    known = run.known.get("progress") or {}
    done = float(known.get("fraction_done") or 0)
    left = known.get("remaining_s")
    words = f"{100 * done:.0f} % done"
    return 100 * done, words + (f", about {duration(left)} left" if left else "")


def status_of(run: Results) -> str:
    """Return how the run ended, in words."""
    if run.is_running:
        done, words = progress_of(run)
        if not is_locked(run.directory) and done:
            return f"The run was ended before it was finished: {words.split(',')[0]}."
        said = f"Running: {words}. " if done else "The run has not ended. "
        return f"{said}This page reloads itself every {REFRESH} seconds."
    if failure := run.summary.get("failure"):
        return f"Failed: {failure}"
    if (end := verdict.verdict_of(run).end) is not None:
        last = run.shown.place(run.history["penetration_m"].max())
        return f"Computed to {last}, of which {run.shown.place(end, 1)} are feasible."
    reason = run.scene.get("end_reason")
    status = str(run.summary.get("status", "finished"))
    return f"Ended early: {reason}." if reason else f"Status: {status}."


def job_of(run: Results, summary: dict[str, Any]) -> list[tuple[str, str]]:
    """Return what a first page must name: scene, program and date."""
    if not summary:
        return []
    written = str(summary.get("written", ""))[:16].replace("T", " ")
    version, library = summary["version"], summary["dealii_version"]
    return [
        ("Scene", str(summary["scene_file"])),
        ("Computed", written or "not known"),
        ("Program", f"caisson_mpm {version}, deal.II {library}"),
    ] + ([("Use", use)] if (use := layers.use_of(run)) else [])


def warnings_of(run: Results, end: float | None = None) -> dict[str, list[str]]:
    """Return the warnings by their rank, without those about what is deeper than the
    end of suction (m)."""

    def counts(text: str) -> bool:
        place = AT_PENETRATION.search(text)
        return end is None or place is None or float(place[1]) <= end

    found = run_review.warnings_of(run)
    return {rank: list(filter(counts, texts)) for rank, texts in found.items()}


def what_was_computed(run: Results, found: Installation | None) -> dict[str, Any]:
    """Return sketch and tables of caisson and soil."""
    if not run.scene:
        nothing: dict[str, Any] = {"heads": [], "rows": []}
        empty = {"sketch": "", "caisson": [], "assumed": False, "by_depth": False}
        return empty | {"soil": nothing, "layers": nothing}
    depth = float(np.max(run.history.get("penetration_m", np.zeros(1))))
    depth = min(depth, verdict.verdict_of(run).end or depth)
    caisson, all_numbers = scene.caisson_of(run), layers.layers_table(run)
    numbers = [cell for row in all_numbers["rows"] for cell in row]
    cells = [assumed for _, assumed in numbers]
    return {
        "sketch": sketch.of_run(run, depth, found.rest if found else None),
        "caisson": caisson,
        "soil": layers.soil_table(run),
        "layers": all_numbers,
        "by_depth": any(re.search(r"\bd\b", text) for text, _ in numbers),
        "assumed": any([*cells, *(item.assumed for item in caisson)]),
    }


def has_ended_early(run: Results) -> bool:
    """Return whether a run was stopped, or failed, before its end."""
    if run.is_running:
        return not is_locked(run.directory)
    ended = run.summary.get("failure") or run.scene.get("end_reason")
    return bool(ended) or run.summary.get("status", "finished") != "finished"


def incomplete_of(run: Results) -> str:
    """Return what a run that did not come to its end is good for; nothing of others,
    and where suction ends before it."""
    depth = run.history.get("penetration_m")
    if not has_ended_early(run) or depth is None or verdict.verdict_of(run).end:
        return ""
    wanted = scene.end_of(run)
    end = run.shown.place(depth.max())
    of_end = f" (planned {run.shown.place(wanted)})" if wanted else ""
    words = f"Stopped at {end}{of_end}; all values refer to {end}"
    failed = not run.is_running and run.summary.get("failure")
    return f"{words}. {LAST_ROWS}" if failed else f"{words}."


def css_text(words: str) -> str:
    """Return a text for a string of a style sheet."""
    return "".join(c if c.isalnum() else f"\\{ord(c):x} " for c in words)


def html(run: Results, rate: Rate) -> str:
    """Return the page. Raises ResultsError or OSError."""
    is_pulled = evaluation.is_pull(run)
    said = verdict.verdict_of(run)
    found = None if is_pulled else installation.installation_of(run, rate)
    if found is not None:
        found = verdict.feasible_part(run, found, said.end, rate)
    beside = methods.NOTHING if is_pulled else methods.methods_of(run, said.end)
    own = [] if found is None else verdict.cards_of(run, found, rate)
    data: dict[str, Any] = {
        "figures": content.figures_of(run, found, said.end),
        "csv": content.csv_of(run.history),
        "name": run.directory.resolve().name,
    }
    summary = run.summary if run.scene or not run.is_running else {}
    title = str(summary.get("title") or run.directory.resolve().name)
    shown_cards = (
        pull.cards_of(run)
        if is_pulled
        else band.cards_of(run, own) + methods.card_of(beside)
    )
    return template(HERE / "page.html").render(
        title=title,
        footer=css_text(title),
        job=job_of(run, summary),
        verdict=said if is_pulled else band.verdict_with(run),
        status=status_of(run),
        progress=progress_of(run)[0] if run.is_running else 0,
        refresh=REFRESH if run.is_running else 0,
        incomplete=incomplete_of(run),
        cards=shown_cards,
        computed=what_was_computed(run, found),
        averaged=content.averaged(run),
        rate=rate.words,
        figures=data["figures"],
        units=content.unit_table(run, said.end),
        methods=beside,
        method_tables=[t for x in beside["tables"] for t in methods.for_a_page(x)],
        pictures=pictures_of(run),
        charts=CHARTS,
        remarks=content.remarks_on_numbers(run),
        warnings=warnings_of(run, said.end),
        entries=scene.entries_of(run) if summary else {},
        defaults=scene.defaults_of(run) if summary else {},
        facts=facts_of(run),
        style=(HERE / "page.css").read_text(encoding="utf-8"),
        scripts=[script(name) for name in SCRIPTS],
        own_script=(HERE / "page.js").read_text(encoding="utf-8"),
        data=json.dumps(data, allow_nan=False).replace("<", "\\u003c"),
        **of_installation(run, found, said.end),
    )


def of_installation(
    run: Results, found: Installation | None, end: float | None
) -> dict[str, Any]:
    """Return what the page says of the installation; end: where suction ends (m)."""
    if found is None:
        names = ("tables", "quarters", "bar", "uncertainty", "factors", "remedies")
        return dict.fromkeys(names, "")
    planned = scene.end_of(run) or float(found.depth[-1])
    return {
        "has_suction": found.has_suction,
        "has_bar": found.has_bar,
        "bar": installation.bar_in_words(run, found),
        "uncertainty": band.uncertainty_of(run),
        "factors": " ".join(
            filter(
                None,
                (
                    limits.sources_of(run, found.limits),
                    limits.rings_in_words(run, found.depth),
                    limits.uncovered_in_words(run, found.depth),
                ),
            )
        ),
        "quarters": band.quarters_of(run, found, end, planned),
        "remedies": remedies.table_of(run, found, end),
        "tables": installation.tables_of(found),
    }
