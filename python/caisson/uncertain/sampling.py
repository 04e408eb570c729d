# SPDX-License-Identifier: LGPL-2.1-or-later
"""The runs of a study of parameters: grid, one at a time, Latin hypercube.

A Latin hypercube takes each parameter once from each of n equally likely parts of its
distribution (McKay, Beckman & Conover 1979, doi:10.2307/1268522), by scipy.stats.qmc.
Its values are then paired so that their rank correlations are those of the study, or
nearly none, by the method of Iman & Conover (1982, doi:10.1080/03610918208812265).
"""
import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from scipy import stats
from scipy.stats import qmc

from caisson.uncertain.distributions import is_number
from caisson.uncertain.entry import Parameter, Sample, Value, read_all, text_of
from caisson.runner import Run, RunError
from caisson.study import StudyError, file_name

GRID, ONE, LATIN = "grid", "one at a time", "Latin hypercube"
SAMPLINGS = (GRID, ONE, LATIN)
BASE = "base"  # the name of the run with which others are compared
AS_IN_SCENE = "as in the scene"  # value of choices at the base of the scene
FEWEST = 5  # samples
LONGEST = 100  # characters of the name of a run


def sampling_of(study: Mapping[str, Any], parameters: Sequence[Parameter]) -> str:
    """Return how the study samples. Raises StudyError."""
    free = [p for p in parameters if p.formula is None]
    uncertain = [p.name for p in free if p.distribution is not None]
    default = GRID if len(free) == 1 and not uncertain else None
    found = study.get("sampling", default)
    if found not in SAMPLINGS:
        words = ", ".join(f'"{name}"' for name in SAMPLINGS)
        says = "is missing" if found is None else f"is {found!r}"
        raise StudyError(f"sampling {says}; choose one of {words}")
    if found == GRID and uncertain:
        raise StudyError(
            f"a grid needs values, a range or choices, and {uncertain[0]!r} has a"
            f' distribution; choose sampling = "{LATIN}"'
        )
    for key in ("samples", "seed", "correlations"):
        if found != LATIN and key in study:
            raise StudyError(f'{key} is for sampling = "{LATIN}", not for {found!r}')
    return str(found)


def whole_number(study: Mapping[str, Any], key: str, default: int | None) -> int:
    """Return a whole number of the study, 0 or more. Raises StudyError."""
    found = study.get(key, default)
    if not isinstance(found, int) or isinstance(found, bool) or found < 0:
        says = "is missing" if found is None else f"is {found!r}"
        raise StudyError(f"{key} {says}; give a whole number, such as {key} = 50")
    return found


def numbers_of(study: Mapping[str, Any], key: str) -> list[float]:
    """Return a list of numbers, or one, of the study. Raises StudyError."""
    found = study[key] if isinstance(study[key], list) else [study[key]]
    if not found or not all(is_number(x) for x in found):
        raise StudyError(
            f"{key} is {study[key]!r}; give depths in m, such as [1, 2, 4]"
        )
    return [float(x) for x in found]


def correlations_of(study: Mapping[str, Any], names: Sequence[str]) -> np.ndarray:
    """Return the rank correlations [n_parameters, n_parameters] of a study. Raises
    StudyError."""
    found = np.eye(len(names))
    given = study.get("correlations", [])
    for item in given if isinstance(given, list) else [given]:
        is_list = isinstance(item, list) and len(item) == 3 and is_number(item[2])
        if not is_list or item[0] == item[1] or not -1 < item[2] < 1:
            raise StudyError(
                f'correlations has {item!r}; give [["phi", "E", 0.5]]: two parameters'
                " and their rank correlation, between -1 and 1"
            )
        if not {item[0], item[1]} <= set(names):
            raise StudyError(
                f"correlations has {item!r}; the parameters are {', '.join(names)}"
            )
        i, j = names.index(item[0]), names.index(item[1])
        # of normal distributions with this rank correlation
        found[i, j] = found[j, i] = 2 * math.sin(math.pi / 6 * item[2])
    if np.linalg.eigvalsh(found)[0] <= 0:
        raise StudyError("correlations contradict each other: no samples have them all")
    return found


def paired(shares: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Return the columns of shares [n_samples, n_parameters], each in the order that
    gives them these correlations [n_parameters, n_parameters]."""
    scores = stats.norm.ppf(shares)
    present = np.linalg.cholesky(
        np.corrcoef(scores, rowvar=False).reshape(wanted.shape)
    )
    scores = scores @ np.linalg.inv(present).T @ np.linalg.cholesky(wanted).T
    ranks = scores.argsort(axis=0).argsort(axis=0)
    return np.take_along_axis(np.sort(shares, axis=0), ranks, axis=0)


def latin(study: Mapping[str, Any], free: Sequence[Parameter]) -> Iterator[Sample]:
    """Yield the samples of a Latin hypercube. Raises StudyError."""
    n = whole_number(study, "samples", None)
    fewest = max(FEWEST, len(free) + 2)
    if n < fewest:
        raise StudyError(
            f"samples = {n} are too few for {len(free)} parameters: at least {fewest},"
            " and 20 or more for quantiles of 5 and 95 %"
        )
    seed = np.random.default_rng(whole_number(study, "seed", 0))
    shares = qmc.LatinHypercube(d=len(free), seed=seed).random(n)
    shares = paired(shares, correlations_of(study, [p.name for p in free]))
    picked = [parameter.picked(shares[:, i]) for i, parameter in enumerate(free)]
    for values in zip(*picked):
        yield {parameter.name: value for parameter, value in zip(free, values)}


def value_in(scene: Run, entry: str) -> Value:
    """Return the value of an entry of a scene, which the program reads when it is first
    asked for. Raises StudyError."""
    try:
        text = scene.in_effect.get(entry)
    except RunError as error:
        raise StudyError(f"the scene is refused: {error}") from error
    if text is None:
        raise StudyError(f"the program has no entry {entry}")
    try:
        return float(text)
    except ValueError:
        return {"true": True, "false": False}.get(text, text)


def base_of(parameter: Parameter, scene: Run) -> Value:
    """Return the value of a parameter at the base: what it says, or the median of its
    distribution, or the value of the scene. Raises StudyError."""
    if parameter.base is not None:
        if parameter.choices and parameter.base not in parameter.choices:
            raise StudyError(
                f"parameter {parameter.name!r}: base is {parameter.base!r}, not one of"
                f" {', '.join(parameter.choices)}"
            )
        return parameter.base
    if parameter.distribution is not None:
        return parameter.picked(np.array([0.5]))[0]
    if parameter.choices:
        return AS_IN_SCENE
    if parameter.times:
        return 1.0
    found = {entry: value_in(scene, entry) for entry in parameter.entries}
    if len(set(found.values())) > 1:
        text = ", ".join(f"{entry} = {value}" for entry, value in found.items())
        raise StudyError(
            f"parameter {parameter.name!r}: its entries differ in the scene ({text});"
            " give base"
        )
    return next(iter(found.values()))


def one_at_a_time(free: Sequence[Parameter], scene: Run) -> Iterator[Sample]:
    """Yield the base, and it with one parameter changed, for each of its values."""
    base = {parameter.name: base_of(parameter, scene) for parameter in free}
    yield base
    for parameter in free:
        for value in parameter.ends():
            if value != base[parameter.name]:
                yield {**base, parameter.name: value}


def grid(free: Sequence[Parameter]) -> Iterator[Sample]:
    """Yield each combination of all values."""
    for values in itertools.product(*(parameter.values for parameter in free)):
        yield {parameter.name: value for parameter, value in zip(free, values)}


def with_formulas(sample: Sample, parameters: Sequence[Parameter]) -> Sample:
    """Return a sample with the values of formulas. Raises StudyError."""
    for parameter in (p for p in parameters if p.formula is not None):
        assert parameter.formula
        try:
            value = parameter.formula.value(sample)
        except StudyError as error:
            raise StudyError(f"parameter {parameter.name!r}: {error}") from error
        sample = {**sample, parameter.name: float(f"{value:.6g}")}
    return sample


def names_of(
    sampling: str, free: Sequence[Parameter], samples: list[Sample]
) -> list[str]:
    """Return the names of the runs [n_samples]. Those of a grid and of one parameter
    at a time are made of values, so that a run keeps its name when others are added."""
    digits = len(str(len(samples)))
    numbers = [f"sample {i + 1:0{digits}}" for i in range(len(samples))]
    if sampling == LATIN:
        return numbers
    names = []
    for i, sample in enumerate(samples):
        if sampling == ONE and i == 0:
            names.append(BASE)
            continue
        changed = [
            f"{p.label} {text_of(sample[p.name])}"
            for p in free
            if sampling == GRID or sample[p.name] != samples[0][p.name]
        ]
        names.append(", ".join(changed))
    is_clear = len({file_name(name) for name in names}) == len(names)
    return names if is_clear and max(map(len, names)) <= LONGEST else numbers


def runs_of(study: Mapping[str, Any], scene: Run) -> list[dict[str, Any]]:
    """Return the runs of a study as a list of their keys: name, set, sample. Raises
    StudyError."""
    for key in {"depths", "tornado_depth"} & set(study):
        numbers_of(study, key)
    parameters = read_all(study.get("parameters"))
    free = [p for p in parameters if p.formula is None]
    sampling = sampling_of(study, parameters)
    if sampling == LATIN:
        samples = list(latin(study, free))
    else:
        samples = list(one_at_a_time(free, scene) if sampling == ONE else grid(free))
    runs = []
    for name, sample in zip(names_of(sampling, free, samples), samples):
        sample = with_formulas(sample, parameters)
        entries: dict[str, Any] = {}
        for parameter in parameters:
            entries |= parameter.set(sample[parameter.name])
        runs.append({"name": name, "set": entries, "sample": sample})
    return runs
