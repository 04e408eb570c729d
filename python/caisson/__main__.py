# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line: scripts/caisson COMMAND ..., or caisson COMMAND ... where the
program is installed."""
from collections.abc import Sequence
from typing import NoReturn

from caisson import completion
from caisson.command_line import Groups, commands_of, end_process, run_command

GROUPS: Groups = {
    "set up": {
        "suggest": ("caisson.suggest", "write a scene for your own caisson"),
        "cpt": ("caisson.commands.cpt", "derive soil layers from a cone test"),
        "scenes": ("caisson.scenes", "list the scenes that come with the program"),
    },
    "compute": {
        "run": (
            "caisson.commands.run",
            "run a scene, draw its pictures, write its report",
        ),
        "study": ("caisson.study_command", "run and evaluate many runs of a scene"),
        "park": ("caisson.commands.park", "run many positions, each with its page"),
        "error-bar": ("caisson.error_bars.command", "compute the error bar of a scene"),
    },
    "results": {
        "plot": ("caisson.plot", "draw the pictures of runs"),
        "report": ("caisson.report", "write an HTML page on each run"),
        "compare": (
            "caisson.commands.compare",
            "draw or print several runs, and what differs between two",
        ),
        "export": ("caisson.export.command", "give the soil to other programs"),
        "log": ("caisson.vessel_log", "compare a run with the log of the vessel"),
    },
}
COMMANDS = commands_of(GROUPS)
# those that import what they need only after they have computed or read something
LATE = {"cpt", "park", "plot", "report", "export", "log"}
ELSEWHERE = (
    "Verification, validation, stability and speed are commands of scripts/lab, and"
    " tools for developers of tools/workshop."
)


def main(argv: Sequence[str]) -> int:
    """Run one command."""
    if argv and argv[0] in ("--complete", "--completion"):
        return completion.main(argv, COMMANDS)
    description = "Set up, run and evaluate installations of suction caissons."
    return run_command(argv, "caisson", description, GROUPS, LATE, ELSEWHERE)


def run() -> NoReturn:
    """Run the command of this process, and end it."""
    end_process(main)


if __name__ == "__main__":
    run()
