# SPDX-License-Identifier: LGPL-2.1-or-later
"""Studies of kind "forces": the curves of many runs beside each other.

The only key beside the usual ones is depths: the penetrations (m) at which forces,
means over 0.2 m, are printed. What the numbers are: caisson.verdict.key_numbers.
"""
from collections.abc import Sequence

from caisson.verdict.key_numbers import describe
from caisson.results import ResultsError
from caisson.study import Options, Study

NAME = "forces"
STUDY_KEYS = {"depths"}


def evaluate(studies: Sequence[Study], _: Options, __: float) -> int:
    """Print the numbers of all runs; return 1 where one is missing."""
    status = 0
    for study in studies:
        for run in study.runs:
            print(f"{study.id}, {run.name}:")
            try:
                print("\n".join(describe(run.run.directory, study.keys["depths"])))
            except ResultsError as error:
                print(f"  {error}")
                status = 1
    return status
