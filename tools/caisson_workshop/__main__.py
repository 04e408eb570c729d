# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of the workshop: tools/workshop COMMAND ..."""
from collections.abc import Sequence

from caisson.command_line import Groups, commands_of, end_process, run_command

THIS = "caisson_workshop"
GROUPS: Groups = {
    "tests": {
        "test-parts": (f"{THIS}.parts", "run all parts of the test, as scripts/test"),
        "faults": (f"{THIS}.faults", "try to break the program"),
        "mutate": (f"{THIS}.mutate", "try whether the tests notice wrong expressions"),
        "sanitize": (f"{THIS}.shell", "build with sanitizers and run the tests there"),
        "cross-arm": (f"{THIS}.shell", "run the tests of the kernels as for ARM"),
        "bare-debian": (
            f"{THIS}.clean_install",
            "try the commands of the README on a bare Debian",
        ),
    },
    "checks": {
        "check-floors": (f"{THIS}.floors", "check the order of the sources"),
        "check-documents": (
            f"{THIS}.document_names",
            "check the names in the documents",
        ),
    },
    "manual": {
        "parameter-page": (
            f"{THIS}.parameter_page",
            "write the parameter reference of the manual",
        ),
        "draw-sketches": (
            f"{THIS}.draw_sketches",
            "draw doc/pictures/architecture.svg and zones.svg",
        ),
    },
}
COMMANDS = commands_of(GROUPS)


def main(argv: Sequence[str]) -> int:
    """Run one command."""
    description = "Tools for those who change caisson_mpm."
    return run_command(argv, "workshop", description, GROUPS)


if __name__ == "__main__":
    end_process(main)
