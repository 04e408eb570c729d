# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page of a report: contents, pictures and scripts in one file."""
import base64
import json
import time
from pathlib import Path
from typing import Any

import jinja2

from caisson import plot
from caisson.needed import JAVASCRIPT, SCRIPTS
from caisson_report import content, methods
from caisson.results import Results

HERE = Path(__file__).parent
REFRESH = 30  # s, of the page of a run that has not ended
# name of a picture without its suffix: what it shows
PICTURES = {
    "stress": "Vertical effective stress",
    "pore_pressure": "Excess pore pressure and flow lines, beside effective stress",
    "suction": "Suction, exit gradients and heave of the plug",
    "displacement": "Displacement",
    "void_ratio": "Void ratio",
    "forces": "Forces",
}


def script(name: str) -> str:
    """Return a script of Debian's for the page."""
    text = (JAVASCRIPT / name).read_text(encoding="utf-8")
    return text.replace("</script", "<\\/script")


def pictures_of(run: Results) -> list[dict[str, str]]:
    """Return the run's pictures as data, each with what it shows; drawn where the run
    has left none."""
    if not (run.directory / "forces.png").is_file():
        plot.draw(run.directory)
    found = []
    for name, shows in PICTURES.items():
        path = run.directory / f"{name}.png"
        if path.is_file():
            data = base64.b64encode(path.read_bytes()).decode("ascii")
            found.append({"name": name, "shows": shows, "data": data})
    return found


def facts_of(run: Results) -> list[tuple[str, str]]:
    """Return versions, sizes and times; of a run that failed, those that are known."""
    if run.is_running:
        return []
    summary = run.summary
    points = summary.get("material_points", "not known")
    facts = [
        (
            "Program",
            f"caisson_mpm {summary['version']}, deal.II {summary['dealii_version']}",
        ),
        ("Scene", str(summary["scene_file"])),
        ("Results", str(run.directory)),
        ("Cells, material points", f"{summary['cells']}, {points}"),
        ("Steps", f"{summary['steps']} of {summary['time_step_s']:.3g} s"),
        ("Limit of the step", str(summary["time_step_limit"])),
        ("Ranks", str(summary["ranks"])),
        ("Time", f"{summary['wall_time_s']:.0f} s"),
        ("Fingerprint of the scene", str(summary["fingerprint"])),
    ]
    if "peak_memory_bytes" in summary:
        facts.append(("Memory", f"{summary['peak_memory_bytes'] / 1e6:.0f} MB"))
    ended = time.localtime((run.directory / "run.json").stat().st_mtime)
    return [("Ended", time.strftime("%Y-%m-%d %H:%M", ended)), *facts]


def status_of(run: Results) -> str:
    """Return how the run ended, in words."""
    if run.is_running:
        return (
            f"The run has not ended; this page reloads itself every {REFRESH} seconds."
        )
    if failure := run.summary.get("failure"):
        return f"Failed: {failure}"
    reason = run.scene.get("end_reason")
    status = str(run.summary.get("status", "finished"))
    return f"Ended early: {reason}." if reason else f"Status: {status}."


def html(run: Results) -> str:
    """Return the page. Raises ResultsError or OSError."""
    loader = jinja2.FileSystemLoader(HERE)
    environment = jinja2.Environment(
        loader=loader, autoescape=True, undefined=jinja2.StrictUndefined
    )
    data: dict[str, Any] = {
        "figures": content.figures_of(run),
        "csv": content.csv_of(run.history),
        "name": run.directory.resolve().name,
    }
    summary = {} if run.is_running else run.summary
    return environment.get_template("page.html").render(
        title=summary.get("title") or run.directory.resolve().name,
        status=status_of(run),
        refresh=REFRESH if run.is_running else 0,
        key_values=content.key_values(run),
        error=content.error_remark(run),
        figures=data["figures"],
        table=content.table_of(run),
        methods=methods.methods_of(run),
        pictures=pictures_of(run),
        remarks=content.remarks_on_numbers(run),
        warnings=summary.get("warnings", []),
        entries=summary.get("entries", {}),
        facts=facts_of(run),
        style=(HERE / "page.css").read_text(encoding="utf-8"),
        scripts=[script(name) for name in SCRIPTS],
        own_script=(HERE / "page.js").read_text(encoding="utf-8"),
        data=json.dumps(data, allow_nan=False).replace("<", "\\u003c"),
    )
