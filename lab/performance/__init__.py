# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "speed": how fast kernels and program are, as ratios taken in one
run. Variants take turns, and medians of the ratios in each round are shown.

The studies of speed.toml make the sections of a report, by the first word of their id:
kernels, step, size, ranks, agreement, needs, refinement, roofline. Keys beside the
usual ones:

    repeats      rounds
    base         the run that the others are compared with (section size)
    steps        rows that are compared (section agreement)
    points, repetitions, sizes   of kernel_benchmark (kernels, roofline)

Tables (table.md and a .csv each) and pictures go to results/speed. A section that
is not run keeps what it had there. The machine must do nothing else, so runs are
never made side by side, and always repeated. `scripts/lab publish-speed` copies
the tables into speed.md beside this module, and one picture into doc/pictures.
"""
import time
from collections.abc import Callable, Sequence

from caisson.paths import short
from caisson.study import Options, Study, StudyError
from caisson import disk
from lab.performance.kernels import measure_kernels, measure_roofline
from lab.performance.program import (
    measure_agreement,
    measure_needs,
    measure_ranks,
    measure_size,
    measure_step,
)
from lab.performance.refinement import measure_refinement
from lab.performance.report import Report

NAME = "speed"
STUDY_KEYS = set("repeats base steps points repetitions sizes".split())

Studies = dict[str, Study]
SECTIONS: dict[str, Callable[[Studies, Report], None]] = {
    "kernels": measure_kernels,
    "step": measure_step,
    "size": measure_size,
    "ranks": measure_ranks,
    "agreement": measure_agreement,
    "needs": measure_needs,
    "refinement": measure_refinement,
    "roofline": measure_roofline,
}


def measure(studies: Sequence[Study], options: Options, evaluate: bool) -> int:
    """Run the sections and write the report. Raises StudyError."""
    by_section: dict[str, Studies] = {}
    for study in studies:
        by_section.setdefault(study.id.split("_")[0], {})[study.id] = study
    for name, members in by_section.items():
        if name not in SECTIONS or name not in members:
            raise StudyError(f"study {name} of the section {name} is missing")
        if not evaluate:
            start = time.monotonic()
            report = Report(name, members[name].title, options.results)
            SECTIONS[name](members, report)
            report.write()
            print(f"speed: {name}, {time.monotonic() - start:.0f} s", flush=True)
    texts = [options.results / f"{name}.md" for name in SECTIONS]
    parts = [text.read_text(encoding="utf-8") for text in texts if text.exists()]
    table = options.results / "table.md"
    disk.write(table, "\n".join(parts))
    print(f"speed: {short(table)}")
    return 0
