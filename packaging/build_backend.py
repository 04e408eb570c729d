# SPDX-License-Identifier: LGPL-2.1-or-later
"""setuptools for pip, where possible that of Debian: `pip install -e .` then needs no
network.

pip builds in an environment of its own, which does not see the packages of the system,
and downloads into it what the build needs. This module finds Debian's setuptools from
there. Where there is none, it asks pip to download one.
"""
import importlib.util
import sys
from typing import Any

DEBIAN = "/usr/lib/python3/dist-packages"
NEEDED = ["setuptools>=64", "wheel"]  # editable packages by pyproject.toml

if importlib.util.find_spec("setuptools") is None:
    sys.path.append(DEBIAN)


def get_requires_for_build_editable(settings: Any = None) -> list[str]:
    """Return what pip has to download."""
    is_there = all(importlib.util.find_spec(name) for name in ("setuptools", "wheel"))
    return [] if is_there else NEEDED


get_requires_for_build_sdist = get_requires_for_build_editable
get_requires_for_build_wheel = get_requires_for_build_editable


def __getattr__(name: str) -> Any:
    """Return any other step of a build, which is that of setuptools."""
    from setuptools import build_meta

    return getattr(build_meta, name)
