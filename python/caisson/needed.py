# SPDX-License-Identifier: LGPL-2.1-or-later
"""What pictures, reports and studies need beside Python: which of it is missing, and
which Debian package brings it.

What is looked for are the modules that are imported, and not packages: python3-paraview
brings those of VTK as python3-vtk9 does, and the two exclude each other.

    python3 -m caisson.needed    prints the packages that scripts/setup has to install
"""
import importlib.util
from pathlib import Path

from caisson.paths import INSTALLED

MODULES = {
    "numpy": "python3-numpy",
    "scipy.ndimage": "python3-scipy",
    "scipy.stats": "python3-scipy",
    "matplotlib.figure": "python3-matplotlib",
    "vtkmodules.util.numpy_support": "python3-vtk9",
    "vtkmodules.vtkIOXML": "python3-vtk9",
    "jinja2": "python3-jinja2",
}
# of tables in Python (caisson.load), which no command needs
TABLES = {"pandas": "python3-pandas"}
# of cone tests in workbooks (.xlsx), without which all else works
WORKBOOKS = {"openpyxl": "python3-openpyxl"}
# of studies on many machines (caisson.runs)
DASK = {"distributed": "python3-distributed"}
# of the response surface of a study, without which its quantiles are those of its runs
SURFACES = {"sklearn": "python3-sklearn"}
JAVASCRIPT = Path("/usr/share/javascript")
# of a report, which has a copy of them
SCRIPTS = {
    "jquery/jquery.min.js": "libjs-jquery",
    "jquery-mousewheel/jquery.mousewheel.min.js": "libjs-jquery-mousewheel",
    "jquery-flot/jquery.flot.min.js": "libjs-jquery-flot",
}


def is_there(module: str) -> bool:
    """Return whether a module can be found; only the packages above it are loaded."""
    try:
        return importlib.util.find_spec(module) is not None
    except ImportError:
        return False


def missing() -> dict[str, str]:
    """Return the modules and scripts that are missing, each with its package."""
    modules = {m: package for m, package in MODULES.items() if not is_there(m)}
    scripts = {s: p for s, p in SCRIPTS.items() if not (JAVASCRIPT / s).is_file()}
    return modules | scripts


def sentence(found: dict[str, str], group: str) -> str:
    """Return in one line what is missing, with its packages, and which command installs
    it: that of a group of scripts/setup."""
    packages = " ".join(sorted(set(found.values())))
    how = f"apt-get install {packages}" if INSTALLED else f"scripts/setup {group}"
    return f"{', '.join(found)} missing: `{how}` installs what is needed"


def complaint() -> str:
    """Return in one line what is missing and which command installs it, nothing where
    all is there."""
    found = missing()
    return sentence(found, "pictures") if found else ""


if __name__ == "__main__":
    others = WORKBOOKS | SURFACES
    wanted = {m: package for m, package in others.items() if not is_there(m)}
    for package in sorted({*missing().values(), *wanted.values()}):
        print(package)
