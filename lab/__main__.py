# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of the laboratory: scripts/lab COMMAND ..."""
from collections.abc import Sequence

from caisson.command_line import Groups, commands_of, end_process, run_command

STUDY = "lab.study_command"
REFERENCES = "lab.verification"
GROUPS: Groups = {
    "verification": {
        "verify": (STUDY, "run the verification ladder: problems with exact solutions"),
        "checks": ("lab.checks", "compare results with what their scene states"),
        "accuracy": (STUDY, "measure error against time over meshes and methods"),
        "capacity": (
            f"{REFERENCES}.bearing_capacity",
            "compute exact bearing capacities of strip and circular footings",
        ),
        "tip-capacity": (
            f"{REFERENCES}.tip_capacity",
            "compute what the tip of a wall bears between unequal surcharges",
        ),
        "plug-lift": (
            f"{REFERENCES}.plug_lift",
            "compute the suction that lifts the plug of a caisson in clay",
        ),
        "ring-bearing": (
            f"{REFERENCES}.ring_bearing",
            "compute what a ring inside a caisson bears in clay",
        ),
        "cavity-expansion": (
            f"{REFERENCES}.cavity_expansion",
            "compare an expanding cavity with its exact pressure",
        ),
        "manufactured": (
            f"{REFERENCES}.manufactured",
            "check the manufactured solutions against first principles",
        ),
        "element-tests": (
            f"{REFERENCES}.hypoplastic_sand",
            "integrate element tests of hypoplastic sand independently",
        ),
    },
    "validation": {
        "validate": (STUDY, "compare runs with measurements"),
    },
    "stability": {
        "stability": (STUDY, "run the hard scenes"),
        "suggested": (
            "lab.stability.suggested",
            "run scenes that caisson suggest writes for caissons drawn at random",
        ),
    },
    "performance": {
        "speed": (STUDY, "measure the speed of kernels and program, as ratios"),
        "publish-speed": (
            "lab.performance.report",
            "copy the measured speed into lab/performance/speed.md",
        ),
    },
    "studies": {
        "error-bar": (STUDY, "compute the error bar of prm/jack.prm"),
        "suction-error-bar": (STUDY, "compute those of the scenes with suction"),
        "tip": (STUDY, "study the tip force of prm/jack_coarse.prm"),
        "drainage": (STUDY, "study the resistance between the limits of drainage"),
        "tension": (STUDY, "study the pull of a sealed caisson over its rate"),
        "surface": (STUDY, "compare quantiles of twenty runs with those of 200"),
        "study": (STUDY, "run and evaluate a study of any kind from its file"),
        "scene-results": (
            "lab.studies.scene_results",
            "run the scenes of prm/ and compare them with the manual",
        ),
    },
}
COMMANDS = commands_of(GROUPS)


def main(argv: Sequence[str]) -> int:
    """Run one command."""
    description = "Verification, validation, stability and speed of caisson_mpm."
    return run_command(argv, "lab", description, GROUPS)


if __name__ == "__main__":
    end_process(main)
