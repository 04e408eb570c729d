# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tries the commands of the README on a Debian that has nothing but its base.

Makes the tree of a release with debootstrap in DIR, from the mirror that this
machine's apt uses, clones the last commit into it, and runs both commands there as
root. A tree that is there is used again, so delete it for a bare one. The log of
each command is DIR/root/N.log. To be run before every release, with trixie and
with bookworm; it takes about half an hour, 6 GB and a network.

With --day, the commands are those of doc/how_to/own_caisson.md: a scene for one's own
caisson, its run and report, a study of the friction angle, and a comparison.

With --user, the commands are those of an ordinary user with sudo, whom the tree then
has, as Windows makes it (WSL). With --install, packages that tools/package has
built for this release are installed instead of the clone, and an ordinary user runs
two scenes with them.

With --with, these packages are there before the first command, as on the machine of a
user who has them. A command that removes a package, whichever, is a failure.

Needs root, debootstrap, git and unshare (util-linux). All mounts are made in a
mount namespace of their own, and so end with the command, however it ends.
"""
import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
import time
from pathlib import Path

from caisson.paths import ROOT

RELEASES = ("trixie", "bookworm")
COMMANDS = ["scripts/run prm/jack.prm", "scripts/test"]
DAY = [
    "scripts/setup build pictures",
    "scripts/caisson suggest --diameter 10 --skirt 8 --wall 40mm --error 20"
    " --layer '0: phi = 33, E = 20 MPa'"
    " --layer '3: phi = 37, E = 40 MPa'"
    " own.prm --study own_study.toml",
    "scripts/run own.prm",
    "scripts/caisson study own_study.toml",
    "scripts/caisson compare own.png results/own results/parameters/own_study/*/",
]
# of an installed package, in an empty directory
INSTALLED_COMMANDS = [
    "caisson scenes",
    "caisson run column.prm --strict && test -s results/column/report.html",
    "caisson run --ranks 2 jack_coarse.prm --set 'Time/End penetration=0.7'"
    " && caisson report results/jack_coarse && ls -l results/jack_coarse",
    "caisson_mpm --version",
]
USER = "engineer"
NEEDED = ("debootstrap", "git", "unshare", "chroot", "mount")
# git: to clone the project; ca-certificates: for mirrors with https
INCLUDED = "git,ca-certificates"
NAME = "caisson_mpm"
INSTALL = (
    "apt-get update && DEBIAN_FRONTEND=noninteractive"
    " apt-get install --yes --no-remove --no-install-recommends"
)
MOUNT = """
set -e
mount -t proc proc "$1/proc"
mount -t sysfs -o ro sysfs "$1/sys" || echo "bare_debian: no /sys" >&2
mount --rbind /dev "$1/dev"
exec chroot "$1" /bin/sh -c "$2"
"""


def mirror() -> str:
    """Return where this machine's apt gets Debian from."""
    found = []
    for file in [Path("/etc/apt/sources.list"), *Path("/etc/apt").rglob("*.d/*")]:
        if file.is_file() and file.suffix in (".list", ".sources"):
            text = file.read_text(encoding="utf-8", errors="replace")
            pattern = r"^(?:URIs:|deb(?:\s+\[.*?\])?)\s+(https?://\S+)"
            found += re.findall(pattern, text, re.MULTILINE)
    debian = [url for url in found if re.search(r"/debian/?$", url)]
    return debian[0] if debian else "http://deb.debian.org/debian"


def make_tree(release: str, tree: Path, url: str) -> None:
    """Make the tree of a release if it is not there. Raises CalledProcessError."""
    finished = tree / "root/.bare_debian"
    if finished.exists():
        return
    print(f"bare_debian: {release} from {url} into {tree}", flush=True)
    command = ["debootstrap", "--variant=minbase", f"--include={INCLUDED}"]
    subprocess.run([*command, release, str(tree), url], check=True)
    finished.write_text(release, encoding="utf-8")


def clone(place: Path) -> None:
    """Put a fresh clone of the last commit there."""
    shutil.rmtree(place, ignore_errors=True)
    command = ["git", "clone", "--quiet", "--no-hardlinks", str(ROOT), str(place)]
    subprocess.run(command, check=True)
    changes = subprocess.run(
        ["git", "status", "--porcelain"], cwd=ROOT, capture_output=True, text=True
    )
    if changes.stdout:
        print("bare_debian: changes that are not committed are left out")


def make_user(tree: Path, with_sudo: bool) -> None:
    """Make the ordinary user, who owns what is in the home directory."""
    commands = f"id {USER} || useradd --create-home --shell /bin/bash {USER}"
    if with_sudo:
        commands += (
            f" && {{ which sudo || {{ {INSTALL} sudo; }}; }}"
            f" && echo '{USER} ALL=(ALL) NOPASSWD: ALL' > /etc/sudoers.d/{USER}"
        )
    commands += f" && chown -R {USER}: /home/{USER}"
    if run_inside(tree, commands, tree / "root/user.log") != 0:
        raise OSError(f"no user {USER}, see {tree / 'root/user.log'}")


def as_user(command: str) -> str:
    """Return the command as the ordinary user runs it in the home directory."""
    inner = shlex.quote(f"cd && {command}")
    return f"runuser --login {USER} --command {inner}"


def prepare_clone(options: argparse.Namespace, tree: Path) -> list[str]:
    """Clone the project for root or for the ordinary user; return the commands to
    run there."""
    home = f"/home/{USER}" if options.user else "/root"
    place = tree / home[1:] / NAME
    clone(place)
    chosen = options.command or (DAY if options.day else COMMANDS)
    commands = [f"cd {home}/{NAME} && {command}" for command in chosen]
    if options.user:
        make_user(tree, with_sudo=True)
        commands = [as_user(command) for command in commands]
    return commands


def prepare_packages(options: argparse.Namespace, tree: Path) -> list[str]:
    """Put packages into the tree; return the commands to install and to try them."""
    make_user(tree, with_sudo=False)
    for package in options.install:
        shutil.copy(package, tree / "root")
    names = " ".join(f"/root/{package.name}" for package in options.install)
    return [
        f"{INSTALL} --reinstall {names}",
        *map(as_user, options.command or INSTALLED_COMMANDS),
    ]


def prepare(options: argparse.Namespace, tree: Path) -> list[str]:
    """Put into the tree what is to be tried; return the commands."""
    if options.packages:
        log = tree / "root/with.log"
        if run_inside(tree, f"{INSTALL} {' '.join(options.packages)}", log) != 0:
            raise OSError(f"could not install what was given by --with, see {log}")
    return (prepare_packages if options.install else prepare_clone)(options, tree)


def packages_of(tree: Path) -> set[str]:
    """Return the names of the packages that are installed in the tree."""
    text = (tree / "var/lib/dpkg/status").read_text(encoding="utf-8")
    pattern = r"^Package: (.*)\nStatus: \S+ \S+ installed$"
    return set(re.findall(pattern, text, re.MULTILINE))


def environment() -> dict[str, str]:
    """Return what a new user has, and the way to the network."""
    own = {"HOME": "/root", "TERM": "dumb", "PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}
    return own | {k: v for k, v in os.environ.items() if k.lower().endswith("_proxy")}


def run_inside(tree: Path, command: str, log: Path) -> int:
    """Run a command of root in the tree; return its status."""
    start = [
        "unshare",
        "--mount",
        "--propagation",
        "private",
        "sh",
        "-c",
        MOUNT,
        "sh",
    ]
    with open(log, "w", encoding="utf-8") as file:
        return subprocess.run(
            [*start, str(tree), command], stdout=file, stderr=file, env=environment()
        ).returncode


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `tools/workshop bare-debian`."""
    parser.add_argument("release", choices=RELEASES)
    parser.add_argument("directory", type=Path, metavar="DIR")
    parser.add_argument("--mirror", default=mirror(), help="default: that of apt")
    add = parser.add_argument
    add("--day", action="store_true", help="an engineer's first day")
    add("--user", action="store_true", help="as an ordinary user with sudo")
    add("--install", nargs="+", type=Path, metavar="FILE.deb", help="try packages")
    text = "have these beforehand, and let no command remove a package"
    add("--with", nargs="+", dest="packages", metavar="PACKAGE", help=text)
    parser.add_argument(
        "--command",
        action="append",
        help="instead of the usual commands; may be repeated",
    )


def missing() -> str:
    """Return what this machine lacks, or nothing."""
    if os.geteuid() != 0:
        return "root is needed, for debootstrap and chroot"
    tools = [tool for tool in NEEDED if shutil.which(tool) is None]
    return f"missing: {', '.join(tools)}" if tools else ""


def main(options: argparse.Namespace) -> int:
    """Make the tree and run the commands; return 1 where one fails."""
    tree = options.directory.resolve()
    if missing():
        print(f"bare_debian: {missing()}", file=sys.stderr)
        return 1
    try:
        make_tree(options.release, tree, options.mirror)
        shutil.copy("/etc/resolv.conf", tree / "etc/resolv.conf")
        commands = prepare(options, tree)
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"bare_debian: {error}", file=sys.stderr)
        return 1
    worst = 0
    for number, command in enumerate(commands, 1):
        begin, log = time.monotonic(), tree / f"root/{number}.log"
        before = packages_of(tree)
        status = run_inside(tree, command, log)
        if removed := before - packages_of(tree):
            print(f"bare_debian: removed: {' '.join(sorted(removed))}")
            status = status or 1
        worst = max(worst, abs(status))
        minutes = (time.monotonic() - begin) / 60
        print(
            f"bare_debian: {options.release}: {command}: status {status},"
            f" {minutes:.0f} minutes, {log}",
            flush=True,
        )
    return 1 if worst else 0
