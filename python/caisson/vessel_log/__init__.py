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
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from caisson import disk, evaluation
from caisson.paths import short
from caisson.results import Results, ResultsError

if TYPE_CHECKING:
    from caisson.vessel_log.expected import Expected
    from caisson.vessel_log.forecast import Bins, Forecast
    from caisson.vessel_log.measured import Log

HERE = Path(__file__).parent
PAGE, PICTURE, TABLE = "vessel.html", "vessel.png", "vessel.csv"
FORECASTS = "forecast_low_kPa", "forecast_kPa", "forecast_high_kPa"
EXTRAPOLATED = "extrapolated"  # the column that names the lines that are


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of `caisson log`."""
    add = parser.add_argument
    add("directory", type=Path, metavar="DIR", help="results of the best estimate")
    add("measured", type=Path, nargs="?", metavar="measured.csv", help="the log")
    add("--blank", action="store_true", help="write a log sheet to print")


def columns_of(
    expected: "Expected", bins: "Bins", forecast: "Forecast | None"
) -> dict[str, np.ndarray]:
    """Return the columns [n] of the table at each half meter and at the end: suctions
    in kPa, nan where there is none."""
    from caisson.vessel_log.steps import suction_in

    depth = expected.depth
    at = np.unique([*evaluation.depths_of(depth), bins.depth[-1]])

    def within(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return np.asarray(np.interp(at, x, y, left=np.nan, right=np.nan))

    measured, ahead = suction_in(bins, expected), [at * np.nan] * 3
    if forecast:
        lines = forecast.low, forecast.best, forecast.high
        ahead = [within(forecast.depth, line) for line in lines]
    return {
        "depth_m": at,
        **{
            f"expected_{name}_kPa": within(depth, suction)
            for name, suction in expected.suctions.items()
        },
        "measured_kPa": within(bins.depth, measured),
        **dict(zip(FORECASTS, ahead)),
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


class Answer(NamedTuple):
    """What a log is compared with, and what it says."""

    expected: "Expected"
    log: "Log"
    bins: "Bins"
    forecast: "Forecast | None"
    said: list[str]


def answer_of(directory: Path, measured: Path) -> Answer:
    """Return what a log says beside the run of a directory. Raises InputError."""
    from caisson.vessel_log import forecast, words
    from caisson.vessel_log.expected import expected_of
    from caisson.vessel_log.measured import read
    from caisson.vessel_log.steps import FEWEST, bins_of, weight_of

    log, expected = read(measured), expected_of(Results(directory))
    found, ahead = None, words.no_forecast(expected, log)
    # one step shows a refusal where suction begins
    bins = bins_of(measured, log, expected, 1 if ahead else FEWEST)
    if not ahead:
        found = forecast.forecast_of(expected, bins, weight_of(log, expected))
        ahead = words.of_forecast(expected, found)
    fit = forecast.fit_of(expected, bins)
    said = [ahead, *words.said(expected, log, bins, fit)]
    return Answer(expected, log, bins, found, said)


def write(directory: Path, found: Answer) -> list[Path]:
    """Write page, picture and table of a log into the directory of a run; return the
    files. Raises InputError."""
    from caisson.vessel_log import picture
    from caisson.table import digits, write_csv

    expected, log, bins, forecast, said = found
    columns = columns_of(expected, bins, forecast)
    beyond = [expected.extrapolated_at(depth) for depth in columns["depth_m"]]
    numbers = [[digits(x, 4) for x in column] for column in columns.values()]
    rows = list(zip(*numbers, beyond))
    return [  # the table first, whose name the log may have
        write_csv(directory / TABLE, [*columns, EXTRAPOLATED], rows),
        picture.draw(directory / PICTURE, expected, log, bins, forecast),
        write_page(directory / PAGE, expected, said, columns, beyond),
    ]


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

        files = sheet.write(options.directory)
    else:
        found = answer_of(options.directory, options.measured)
        for line in found.said:  # first, as the disk may be full
            print(line, flush=True)
        files = write(options.directory, found)
    for file in files:
        print(f"log: {short(file)}")
    return 0
