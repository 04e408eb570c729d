# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a report: contents, pictures and scripts in one file."""
import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from caisson.design import plug_stability
from caisson.template import picture_of, say, say_rows, template
from caisson import evaluation, plot
from caisson.band import BEST
from caisson.verdict import by_hand, installation, limits, outcome, retrieval
from caisson.verdict import run_review, suction_methods, theory
from caisson.disk import is_locked
from caisson.progress import duration
from caisson.needed import JAVASCRIPT, SCRIPTS
from caisson.results import Results, ResultsError
from caisson.report import acceptance, content, layers, low_and_high, methods, pull
from caisson.report import remedies
from caisson.report import phases, scene, sketch, trace, verdict
from caisson.report.content import SENTENCES
from caisson.verdict.installation import Installation, Rate

HERE = Path(__file__).parent
# of a page: a card is left out where nothing stands for what it shows
MISSING = dict.fromkeys(
    "job verdict status incomplete progress refresh cards quarters uncertainty bar"
    " next overview factors remedies warnings computed tables has_bar has_suction"
    " averaged rate pictures units methods remarks entries defaults facts acceptance"
    " signed phases retrieval more".split(),
    "",
)
REFRESH = 20  # s, of the page of a run that has not ended
# name of a picture without its suffix: what it shows
PICTURES = {
    "stress": "Vertical stress",
    "pore_pressure": "Excess pore pressure, beside the vertical stress",
    "walls": "Stresses along the walls",
    "displacement": "Displacement",
    "void_ratio": "Void ratio",
}
CHARTS = ("walls",)  # pictures of lines, not of fields


def pictures_of(run: Results) -> list[dict[str, str]]:
    """Return the run's pictures as data, each with what it shows; drawn where the run
    has left none since its last row."""
    history, drawn = (run.directory / x for x in ("history.csv", "forces.png"))
    is_old = not drawn.is_file() or drawn.stat().st_mtime < history.stat().st_mtime
    if is_old and not run.is_running:
        plot.draw(run.directory)
    found = []
    for name, shows in PICTURES.items():
        path = run.directory / f"{name}.png"
        if path.is_file():
            found.append({"name": name, "shows": shows, "data": picture_of(path)})
    return found


def facts_of(run: Results) -> list[list[str]]:
    """Return versions, sizes and times; of a run that failed, those that are known."""
    if run.is_running:
        return []
    steps = run.history.get("time_step_s", np.array([run.summary["time_step_s"]]))
    steps = steps[np.isfinite(steps) & (steps > 0)]
    ends = steps.min(), steps.max()
    how = scene.mass_scaling_of(run), trace.trace_of(run)
    return say_rows(SENTENCES, "facts", run, ends, *how)


def progress_of(run: Results) -> float:
    """Return how much of a run is done (%)."""
    return 100 * float((run.known.get("progress") or {}).get("fraction_done") or 0)


def status_of(run: Results) -> str:
    """Return how the run ended, in words."""
    if run.is_running:
        left = (run.known.get("progress") or {}).get("remaining_s")
        words = duration(left) if left else ""
        how = progress_of(run), words, is_locked(run.directory), REFRESH
        return say(SENTENCES, "going_on", *how)
    if run.by_hand:
        return say(SENTENCES, "to_come", run.summary)
    last = float(run.history.get("penetration_m", np.zeros(1)).max())
    return say(SENTENCES, "status", run, last, verdict.verdict_of(run).end)


def what_was_computed(run: Results, found: Installation | None) -> dict[str, Any]:
    """Return sketch and tables of caisson and soil; nothing before they are known."""
    if not run.scene:
        return {}
    depth = float(np.max(run.history.get("penetration_m", np.zeros(1))))
    depth = min(depth, verdict.verdict_of(run).end or depth)
    caisson, every = scene.caisson_of(run), layers.layers_table(run)
    cells = [cell for row in every["rows"] for cell in row]
    assumed = [assumed for _, assumed in cells] + [item.assumed for item in caisson]
    return {
        "sketch": sketch.of_run(run, depth, found.rest if found else None),
        "caisson": caisson,
        "soil": layers.soil_table(run),
        "layers": every,
        "by_depth": any(re.search(r"\bd\b", text) for text, _ in cells),
        "assumed": any(assumed),
    }


def incomplete_of(run: Results) -> str:
    """Return what a run that did not come to its end is good for; nothing of others,
    and where suction ends before it."""
    depth = run.history.get("penetration_m")
    failed = not run.is_running and run.summary.get("failure")
    is_early = failed or run.scene.get("end_reason") or not run.is_finished
    if run.is_running:
        is_early = not is_locked(run.directory)
    if not is_early or depth is None or verdict.verdict_of(run).end:
        return ""
    end = depth[-1] if evaluation.is_pull(run) else depth.max()
    how = run.shown, end, run.planned, failed
    return say(SENTENCES, "incomplete", *how)


def css_text(words: str) -> str:
    """Return a text for a string of a style sheet."""
    return "".join(c if c.isalnum() else f"\\{ord(c):x} " for c in words)


def render(
    title: str,
    figures: list[dict[str, Any]],
    csv: str,
    footer: str = "",
    signature: str = "",
    **known: Any,
) -> str:
    """Return a page with the cards whose data are known, and without the others. footer
    and signature: at the foot of each page of paper; the title without them."""
    name = known.pop("name", title)
    scripts = [(JAVASCRIPT / x).read_text(encoding="utf-8") for x in SCRIPTS]
    data = json.dumps({"figures": figures, "csv": csv, "name": name}, allow_nan=False)
    return template(HERE / "page.html").render(
        MISSING,
        title=title,
        footer=css_text(footer or title),
        signature=css_text(f"{signature} "),
        figures=figures,
        charts=CHARTS,
        style=(HERE / "page.css").read_text(encoding="utf-8"),
        scripts=[text.replace("</script", "<\\/script") for text in scripts],
        own_script=(HERE / "page.js").read_text(encoding="utf-8"),
        data=data.replace("<", "\\u003c"),
        **known,
    )


def not_begun(run: Results) -> Results:
    """Return a run or, as long as it has not begun its way down, what hand methods say
    of its scene, of an installation."""
    if run.by_hand or not run.is_running or not run.scene or outcome.whole_way(run):
        return run
    moves_up = run.entry("Rigid body/Velocity").strip().startswith("-")
    if moves_up or run.entry("Installation/Directory").strip():  # a pull, a retrieval
        return run
    try:
        hand = by_hand.band_of({BEST: by_hand.ByHand(run.directory)})
        return hand if hand.history else run
    except (ResultsError, theory.NotApplicable):
        return run


def html(run: Results, rate: Rate) -> str:
    """Return the page of a run, or of a scene before it. Raises ResultsError or
    OSError."""
    name, known = run.directory.resolve().name, dict[str, Any]()
    if run.is_running:
        known |= {"progress": progress_of(run), "refresh": REFRESH}
    known |= {"status": status_of(run), "incomplete": incomplete_of(run)}
    run = not_begun(run)
    end, found = verdict.verdict_of(run).end, None
    if evaluation.is_pull(run):
        known |= {"verdict": verdict.verdict_of(run), "cards": pull.cards_of(run)}
        if retrieved := retrieval.retrieval_of(run):
            known["retrieval"] = pull.retrieval_table(retrieved, run.shown)
    else:
        if (found := outcome.whole_way(run, rate)) is not None:
            found = verdict.feasible_part(run, found, end, rate)
            known |= of_installation(run, found, end, rate)
        beside = methods.methods_of(run, end)
        own = verdict.cards_of(run, found, rate) if found else []
        known |= {
            "verdict": verdict.verdict_of(run),
            "more": low_and_high.sentence_of(run),
            "cards": low_and_high.cards_of(run, own) + methods.card_of(beside),
            "methods": beside,
        }
    if run.scene or not run.is_running:
        known |= of_scene(run, end)
    title = str(known.pop("title", "") or name)
    return render(
        title,
        content.figures_of(run, found, end),
        content.csv_of(run.history),
        name=name,
        computed=what_was_computed(run, found),
        rate=rate.words,
        **({} if run.by_hand else of_records(run, end, title)),
        **known,
    )


def of_records(run: Results, end: float | None, title: str) -> dict[str, Any]:
    """Return what only the records of a run say; end: where suction ends (m); title: of
    the page."""
    return trace.foot_of(run, title) | {
        "averaged": content.averaged(run),
        "units": content.unit_table(run, end),
        "pictures": pictures_of(run),
        "remarks": content.remarks_on_numbers(run),
        "facts": facts_of(run),
    }


def of_scene(run: Results, end: float | None) -> dict[str, Any]:
    """Return what run.json says of the scene; end: where suction ends (m)."""
    return {
        "title": run.summary.get("title"),
        "next": run.summary.get("next"),
        "job": say_rows(SENTENCES, "job", run, scene.file_of(run), layers.use_of(run)),
        "warnings": run_review.warnings_of(run, end),
        "entries": scene.with_units(run, run.summary.get("entries", {})),
        "defaults": scene.defaults_of(run),
        "phases": phases.rows_of(run),
    }


def of_installation(
    run: Results, found: Installation, end: float | None, rate: Rate
) -> dict[str, Any]:
    """Return what the page says of the installation; end: where suction ends (m)."""
    planned = run.planned or float(found.depth[-1])
    sources = limits.sources_of(run, found.limits)
    rings = limits.rings_counted(run, found.depth)
    site = theory.site_of(run)
    tops = suction_methods.of_plug(site, found.depth, plug_stability.uncovered) or []
    tops = [top + theory.below_cover(site)[1] for top in tops]
    bounds = found.required_bounds if found.has_suction else found.force_bounds
    reach = bounds.end if bounds else None, found.depth[-1]
    way = installation.way_to_an_error(run)
    return {
        "has_suction": found.has_suction,
        "has_bar": found.has_bar,
        "bar": "" if run.by_hand else say(SENTENCES, "bar", run.shown, *reach, way),
        "uncertainty": low_and_high.uncertainty_of(run),
        "factors": say(SENTENCES, "factors", run.shown, sources, rings, tops),
        "overview": methods.overview(run, found, planned),
        "quarters": low_and_high.quarters_of(run, found, end, planned),
        "remedies": remedies.table_of(run, found, end),
        "acceptance": acceptance.tables_of(run, found, rate),
        "tables": installation.tables_of(found),
    }
