# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tries the commands of the README on a Debian that has nothing but its base.

Makes the tree of a release with debootstrap in DIR, from the mirror that this
machine's apt uses, clones the last commit into it, and runs both commands there as
root. A tree that is there is used again, so delete it for a bare one. The log of
each command is DIR/root/N.log. To be run before every release, with trixie and
with bookworm; it takes about half an hour, 6 GB and a network.

Needs root, debootstrap, git and unshare (util-linux). All mounts are made in a
mount namespace of their own, and so end with the command, however it ends.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

from caisson.paths import ROOT

RELEASES = ("trixie", "bookworm")
COMMANDS = ["scripts/run prm/jack.prm", "scripts/test"]
NEEDED = ("debootstrap", "git", "unshare", "chroot", "mount")
# git: to clone the project; ca-certificates: for mirrors with https
INCLUDED = "git,ca-certificates"
CLONE = "root/caisson_mpm"
MOUNT = """
set -e
mount -t proc proc "$1/proc"
mount -t sysfs -o ro sysfs "$1/sys" || echo "bare_debian: no /sys" >&2
mount --rbind /dev "$1/dev"
exec chroot "$1" /bin/sh -c "cd /root/caisson_mpm && $2"
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
    words = ["debootstrap", "--variant=minbase", f"--include={INCLUDED}"]
    subprocess.run([*words, release, str(tree), url], check=True)
    finished.write_text(release, encoding="utf-8")


def clone(tree: Path) -> None:
    """Put a fresh clone of the last commit into the tree."""
    shutil.copy("/etc/resolv.conf", tree / "etc/resolv.conf")
    place = tree / CLONE
    shutil.rmtree(place, ignore_errors=True)
    words = ["git", "clone", "--quiet", "--no-hardlinks", str(ROOT), str(place)]
    subprocess.run(words, check=True)
    changes = subprocess.run(
        ["git", "status", "--porcelain"], cwd=ROOT, capture_output=True, text=True
    )
    if changes.stdout:
        print("bare_debian: changes that are not committed are left out")


def environment() -> dict[str, str]:
    """Return what a new user has, and the way to the network."""
    own = {"HOME": "/root", "TERM": "dumb", "PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}
    return own | {k: v for k, v in os.environ.items() if k.lower().endswith("_proxy")}


def run_inside(tree: Path, command: str, log: Path) -> int:
    """Run a command in the clone; return its status."""
    words = ["unshare", "--mount", "--propagation", "private", "sh", "-c", MOUNT, "sh"]
    with open(log, "w", encoding="utf-8") as file:
        return subprocess.run(
            [*words, str(tree), command], stdout=file, stderr=file, env=environment()
        ).returncode


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson bare-debian`."""
    parser.add_argument("release", choices=RELEASES)
    parser.add_argument("directory", type=Path, metavar="DIR")
    parser.add_argument("--mirror", default=mirror(), help="default: that of apt")
    parser.add_argument(
        "--command",
        action="append",
        help="instead of both commands of the README; may be repeated",
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
        clone(tree)
    except subprocess.CalledProcessError as error:
        print(f"bare_debian: {error}", file=sys.stderr)
        return 1
    worst = 0
    for number, command in enumerate(options.command or COMMANDS, 1):
        begin, log = time.monotonic(), tree / f"root/{number}.log"
        status = run_inside(tree, command, log)
        worst = max(worst, abs(status))
        minutes = (time.monotonic() - begin) / 60
        print(
            f"bare_debian: {options.release}: {command}: status {status},"
            f" {minutes:.0f} minutes, {log}",
            flush=True,
        )
    return 1 if worst else 0
