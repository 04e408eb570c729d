# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lock that a run has on its output directory while it computes."""
import fcntl
from pathlib import Path


def is_locked(directory: Path) -> bool:
    """Return whether a run computes in the directory; no, where the file system has no
    locks."""
    try:
        with (directory / ".lock").open(encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:  # no such file, or no locks
        return False
    return False
