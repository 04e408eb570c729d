# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line: scripts/caisson COMMAND ..., or caisson COMMAND ... where the
program is installed."""
import argparse
import importlib
import os
import sys
from typing import NoReturn

from caisson import completion, needed
from caisson.paths import INSTALLED

STUDY = "caisson.study_command"
# command: module with declare(parser) and main(options), and what it does
COMMANDS = {
    "suggest": ("caisson.suggest", "write a scene for your own caisson"),
    "cpt": ("caisson.cpt.command", "take layers and parameters from a cone test"),
    "run": ("caisson.launch", "run a scene and draw its pictures"),
    "scenes": ("caisson.scenes", "list the scenes that come with the program"),
    "plot": ("caisson.plot", "draw the pictures of runs"),
    "report": ("caisson.report", "write a page on each run: report.html"),
    "compare": (
        "caisson.plot.comparison",
        "draw the forces of several runs in one picture, and write them to one table",
    ),
    "curve": ("caisson.curve", "print forces and other numbers of runs"),
    "study": (STUDY, "run any study and evaluate it"),
    "verify": (STUDY, "run the verification ladder"),
    "validate": (STUDY, "hold runs against measurements"),
    "stability": (STUDY, "run the hard scenes of prm/stability"),
    "accuracy": (STUDY, "measure error against time over meshes and methods"),
    "error-bar": (STUDY, "make the error bar of prm/jack.prm"),
    "suction-error-bar": (STUDY, "make those of the scenes with suction"),
    "tip": (STUDY, "study the tip force of prm/jack_coarse.prm"),
    "drainage": (STUDY, "study the resistance between the limits of drainage"),
    "cavity-expansion": (
        "caisson.design.cavity_expansion",
        "compare a growing cavity with its exact pressure",
    ),
    "capacity": (
        "caisson.design.bearing_capacity",
        "compute exact bearing capacities of strip and circular footings",
    ),
    "manufactured": (
        "caisson.design.manufactured",
        "check the manufactured solutions against first principles",
    ),
}
# those that need the sources of the program
SOURCE_COMMANDS = {
    "speed": (STUDY, "measure the speed of kernels and program, as ratios"),
    "scaling": (
        "caisson.speed.scaling",
        "estimate the time of a step on up to 1,000 ranks",
    ),
    "publish-speed": ("caisson.speed.publish", "take the speed into doc/benchmarks.md"),
    "element-tests": (
        "caisson.design.hypoplastic_sand",
        "integrate element tests of hypoplastic sand independently",
    ),
    "parameter-page": (
        "caisson.docs.parameters",
        "write the parameter reference of the manual",
    ),
    "check-documents": ("caisson.docs.names", "check the names in the documents"),
    "draw-architecture": (
        "caisson.docs.architecture",
        "draw doc/pictures/architecture.svg",
    ),
    "draw-zones": ("caisson.docs.zones", "draw doc/pictures/zones.svg"),
    "draw-blocks": ("caisson.plot.blocks", "draw doc/pictures/blocks.png"),
    "scene-results": (
        "caisson.scene_results",
        "run the scenes of the README, and compare them with the manual",
    ),
    "bare-debian": (
        "caisson.developer.bare_debian",
        "try the commands of the README on a bare Debian",
    ),
    "faults": ("caisson.developer.faults", "try to break the program"),
    "test-parts": (
        "caisson.developer.parts",
        "run all parts of the test, as scripts/test does",
    ),
    "two-hosts": (
        "caisson.developer.two_hosts",
        "run on two hosts and count their messages",
    ),
    "check-floors": ("caisson.developer.floors", "check the order of the sources"),
}
if not INSTALLED:
    COMMANDS |= SOURCE_COMMANDS
# those that load what they need only when they have computed or read something
LATE = {"cpt", "plot", "report"}


def main(words: list[str]) -> int:
    """Run one command; only its own module is loaded."""
    parser = argparse.ArgumentParser(
        prog="caisson",
        description="Runs, results, studies and checks of caisson_mpm.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="\n".join(f"  {name:18}{text}" for name, (_, text) in COMMANDS.items()),
    )
    parser.add_argument("command", choices=COMMANDS, metavar="COMMAND ...")
    if words and words[0] in ("--complete", "--completion"):
        return completion.main(words, COMMANDS)
    if not words:
        parser.print_help()
        return 1
    name = parser.parse_args(words[:1]).command
    try:
        if name in LATE and (complaint := needed.complaint()):
            raise ModuleNotFoundError(complaint)
        module = importlib.import_module(COMMANDS[name][0])
    except ModuleNotFoundError as error:
        print(f"caisson {name}: {needed.complaint() or error}", file=sys.stderr)
        return 1
    own = argparse.ArgumentParser(
        prog=f"caisson {name}",
        description=module.__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    module.declare(own)
    return int(module.main(own.parse_args(words[1:])))


def run() -> NoReturn:
    """Run the command of this process, and end it."""
    try:
        sys.exit(main(sys.argv[1:]))
    except (BrokenPipeError, KeyboardInterrupt):  # as of `| head`
        os._exit(1)


if __name__ == "__main__":
    run()
