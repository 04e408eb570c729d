# SPDX-License-Identifier: LGPL-2.1-or-later
"""One page on a run, report.html in its directory: curves, tables, pictures, and what
the program warned of. It needs no other file and no network. Until the run ends, the
page reloads itself, and `caisson run` renews it. Of a scene, FILE.prm, it is FILE.html
beside it, by hand methods, before any run."""
import argparse
import functools
import shutil
import subprocess
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING

from caisson import disk, run_error_bar
from caisson.band import SCENE
from caisson.command_line import for_each
from caisson.plot import add_method_arguments, adopt_what_is_beside, draw, keep_methods
from caisson.results import FILES, Results, ResultsError

if TYPE_CHECKING:
    from caisson.verdict.installation import Rate

NAME = "report.html"
OF_A_RUN = ("jacked", "error_bar", "author", "checked")  # options
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def write(directory: Path, rate: float | None = None) -> Path:
    """Write the report of a run, with a pump for a rate of penetration (m/h), or an
    assumed one; return its path. Raises ResultsError."""
    from caisson.report import page, verdict

    pump = rate_of(rate)
    if not directory.is_dir():
        raise ResultsError(f"no directory {directory}")
    adopt_what_is_beside(directory)
    verdict.keep(Results(directory))
    text = page.html(Results(directory), pump)
    return disk.write(directory / NAME, text)


def is_up_to_date(directory: Path, *beside: Path) -> bool:
    """Return whether a run has a page that is as new as its results, and as those of
    runs beside it."""
    page = directory / NAME
    files = [place / name for place in (directory, *beside) for name in FILES]
    times = [file.stat().st_mtime for file in files if file.is_file()]
    return page.is_file() and page.stat().st_mtime >= max(times, default=inf)


def beside(scene: Path) -> Path:
    """Return the page of a scene before any run."""
    return scene.with_suffix(".html")


def rate_of(rate: float | None) -> "Rate":
    """Return the rate of penetration (m/h) that is given, or an assumed one. Raises
    ResultsError where it is none."""
    from caisson.verdict.installation import Rate

    if rate is not None and not (isinstance(rate, (int, float)) and 0 < rate < inf):
        given = f"{rate:g}" if isinstance(rate, (int, float)) else repr(rate)
        raise ResultsError(f"--rate {given}: give m/h above 0")
    return Rate() if rate is None else Rate(rate, False)


def find_browser() -> str:
    """Return the path of a browser that can run without a window, or nothing."""
    return next(filter(None, map(shutil.which, BROWSERS)), "")


def print_pdf(path: Path) -> Path:
    """Print a report to a file of the same name. Raises ResultsError."""
    browser = find_browser()
    if not browser:
        raise ResultsError(
            "--pdf needs a browser: install the package chromium, or print"
            f" {path} from yours"
        )
    new, pdf = path.with_name(".report.pdf"), path.with_suffix(".pdf")
    subprocess.run(
        [
            browser,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--no-pdf-header-footer",
            "--virtual-time-budget=10000",  # ms, in which the curves are drawn
            f"--print-to-pdf={new}",
            path.resolve().as_uri(),
        ],
        check=True,
        capture_output=True,
    )
    disk.write(pdf, disk.read_bytes(new))
    new.unlink()
    return pdf


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson report`."""
    add_method_arguments(parser)
    add = parser.add_argument
    text = (
        "the scene of a run under suction, jacked: it tells what suction leaves of tip"
        " and friction; its history is kept as jacked.csv"
    )
    add("--jacked", type=Path, metavar="DIR", help=text)
    text = "the results of a run, or a scene, FILE.prm, before any run"
    add("directories", nargs="+", type=Path, metavar="DIR", help=text)
    text = (
        "the error bar of the scene, by caisson error-bar; default: that beside"
        " FILE.prm, FILE_error_bar.csv"
    )
    add("--error-bar", type=Path, metavar="CSV", help=text)
    text = "rate of penetration that the pump is made for, in m/h; 1 is assumed"
    add("--rate", type=float, metavar="M/H", help=text)
    text = "who computed; it stands on each page of paper until the results change"
    add("--author", metavar="NAME", help=text)
    add("--checked", metavar="NAME", help="who checked, in the same way")
    add("--pdf", action="store_true", help="print it to report.pdf too")


def write_before(scene: Path, options: argparse.Namespace) -> None:
    """Write the page of a scene before any run. Raises ResultsError."""
    from caisson.report import before

    if unused := [x for x in OF_A_RUN if getattr(options, x)]:
        name = unused[0].replace("_", "-")
        raise ResultsError(f"{scene} has no run yet: leave --{name} out")
    rate = rate_of(options.rate)
    text = before.html(scene, rate, functools.partial(keep_methods, options))
    if text:
        say_written(disk.write(beside(scene), text), options.pdf)


def say_written(path: Path, pdf: bool) -> None:
    """Say where a page is, and print it to a file if that is wanted."""
    print(f"report: {path}")
    if pdf:
        print(f"report: {print_pdf(path)}")


def main(options: argparse.Namespace) -> int:
    """Write the report of each run; a run that has none is named."""
    from caisson.report import relief, trace

    def write_one(directory: Path) -> None:
        rate_of(options.rate)  # before anything is kept
        if directory.suffix == SCENE and not directory.is_dir():
            return write_before(directory, options)
        if keep_methods(options, directory):
            draw(directory)
        if options.jacked is not None:
            relief.adopt(options.jacked, directory)
        if options.error_bar is not None:
            run_error_bar.adopt(directory, options.error_bar)
        trace.keep(directory, options.author, options.checked)
        say_written(write(directory, options.rate), options.pdf)

    return for_each("report", options.directories, write_one)
