# SPDX-License-Identifier: LGPL-2.1-or-later
"""The log of the vessel beside a run: the measured line on the chart of the required
suction, where it leaves the band, the factor on the resistance that fits it, and what
is to be expected below it.

    caisson log results/own measured.csv
    caisson log results/own --blank

Results of low and high resistance, results/own_low and results/own_high, are the band;
without them it is the error bar or the range of the design methods. The log has a row
for each reading, and columns such as time_s, depth_m, suction_kPa, flow_m3/h, tilt_deg
and weight_kN (in water, on the soil). Depth and suction are needed, or resistance_kN in
place of the latter. vessel.html, vessel.png and vessel.csv go to the directory of the
run. With --blank a log sheet to print goes there: log_sheet.pdf and log_sheet.csv.
"""
import argparse
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from caisson import disk, evaluation
from caisson.paths import short
from caisson.results import Results, ResultsError

if TYPE_CHECKING:
    from caisson.vessel_log.expected import Expected
    from caisson.vessel_log.forecast import Bins, Forecast

HERE = Path(__file__).parent
PAGE, PICTURE, TABLE = "vessel.html", "vessel.png", "vessel.csv"
EXTRAPOLATED = "extrapolated"  # the column that names the lines that are


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson log`."""
    add = parser.add_argument
    add("directory", type=Path, metavar="DIR", help="results of the best estimate")
    add("measured", type=Path, nargs="?", metavar="measured.csv", help="the log")
    add("--blank", action="store_true", help="write a log sheet to print")


def columns_of(
    expected: "Expected", bins: "Bins", forecast: "Forecast"
) -> dict[str, np.ndarray]:
    """Return the columns [n] of the table at each half meter and at the end: suctions
    in kPa, nan where there is none."""
    depth = expected.depth
    at = np.unique([*evaluation.depths_of(depth), bins.depth[-1]])

    def within(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return np.asarray(np.interp(at, x, y, left=np.nan, right=np.nan))

    measured = expected.suction(bins.resistance, forecast.weight)
    return {
        "depth_m": at,
        **{
            f"expected_{name}_kPa": within(depth, suction)
            for name, suction in expected.suctions.items()
        },
        "measured_kPa": within(bins.depth, measured),
        "forecast_low_kPa": within(forecast.depth, forecast.low),
        "forecast_kPa": within(forecast.depth, forecast.best),
        "forecast_high_kPa": within(forecast.depth, forecast.high),
        "allowable_kPa": within(depth, expected.allowable),
    }


def write_page(
    path: Path,
    expected: "Expected",
    said: list[str],
    columns: dict[str, np.ndarray],
    extrapolated: list[str],
) -> Path:
    """Write the page of a log beside its picture; return its path. extrapolated: which
    lines are so in each row."""
    from caisson import report
    from caisson.vessel_log import words
    from caisson.table import text_of
    from caisson.template import picture_of, template

    shown, texts = expected.run.shown, dict[str, list[str]]()
    for name, values in columns.items():
        quantity, _, unit = name.rpartition("_")
        head = shown.named(f"{quantity.replace('_', ' ')} ({unit})")
        texts[head] = [text_of(shown.factor(unit) * x) for x in values]
    css = Path(report.__file__).parent / "page.css"
    text = template(HERE / "page.html.jinja").render(
        title=expected.title,
        said=said,
        source=words.of_source(expected),
        columns=texts | {EXTRAPOLATED: extrapolated},
        picture=picture_of(path.parent / PICTURE),
        style=css.read_text(encoding="utf-8"),
    )
    return disk.write(path, text)


def write(directory: Path, measured: Path) -> tuple[list[Path], list[str]]:
    """Write page, picture and table of a log into the directory of a run; return the
    files, and what the log says. Raises InputError."""
    from caisson.vessel_log import forecast, picture, words
    from caisson.vessel_log.expected import expected_of
    from caisson.vessel_log.measured import read
    from caisson.vessel_log.steps import bins_of, weight_of
    from caisson.table import digits, write_csv

    log, expected = read(measured), expected_of(Results(directory))
    bins = bins_of(measured, log, expected)
    found = forecast.forecast_of(expected, bins, weight_of(log, expected))
    fit = forecast.fit_of(expected, bins)
    said = words.said(expected, log, bins, fit, found)
    columns = columns_of(expected, bins, found)
    beyond = [expected.extrapolated_at(depth) for depth in columns["depth_m"]]
    numbers = [[digits(x, 4) for x in column] for column in columns.values()]
    rows = list(zip(*numbers, beyond))
    files = [  # the table first, whose name the log may have
        write_csv(directory / TABLE, [*columns, EXTRAPOLATED], rows),
        picture.draw(directory / PICTURE, expected, log, bins, found),
        write_page(directory / PAGE, expected, said, columns, beyond),
    ]
    return files, said


def main(options: argparse.Namespace) -> int:
    """Compare a log with a run, or write a blank one."""
    if options.blank == (options.measured is not None):
        raise ResultsError(
            "give the file of a log, as in `caisson log DIR measured.csv`, or --blank"
            " for a sheet to print"
        )
    if not (options.directory / "history.csv").is_file():
        raise ResultsError(
            f"no history.csv in {options.directory}: give the results of a run"
        )
    if options.blank:
        from caisson.vessel_log import sheet

        files, said = sheet.write(options.directory), list[str]()
    else:
        files, said = write(options.directory, options.measured)
    for line in said:
        print(line)
    for file in files:
        print(f"log: {short(file)}")
    return 0
