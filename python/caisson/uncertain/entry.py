# SPDX-License-Identifier: LGPL-2.1-or-later
"""A parameter of a study: which entries it sets, and to what."""
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from caisson.uncertain.distributions import (
    ALL_KEYS,
    Distribution,
    is_number,
    require,
)
from caisson.uncertain.formula import Formula
from caisson.paths import distinct_ends
from caisson.runner import Entries
from caisson.study import StudyError

Value = float | str | bool
Sample = dict[str, Value]  # by the name of the parameter
WAYS = ("values", "range", "distribution", "choices", "formula")
WHERE = {"entry", "entries", "times"}
RANGE_KEYS = {"from", "to", "n", "logarithmic"}
UNCERTAIN = (0.05, 0.95)  # shares of a distribution whose values are taken one by one


@dataclass(frozen=True)
class Parameter:
    """What a study varies.

    It has values (of a list, a range, or the names of choices), or a distribution, or
    a formula of other parameters. entries: all those that it sets to its value;
    choices: what each of its values sets instead; times: entries that it sets to its
    value times what stands there. base: its value in the run that
    others are compared with, None where that of the scene counts. label: its name in
    pictures, without the sections before that of an entry.
    """

    name: str
    entries: tuple[str, ...] = ()
    values: tuple[Value, ...] = ()
    distribution: Distribution | None = None
    choices: Mapping[str, Entries] = field(default_factory=dict)
    times: Mapping[str, str] = field(default_factory=dict)
    formula: Formula | None = None
    base: Value | None = None
    label: str = ""

    def set(self, value: Value) -> dict[str, Any]:
        """Return the entries that it sets to take this value."""
        if self.choices:
            return dict(self.choices.get(str(value), {}))
        products = {e: product(value, text) for e, text in self.times.items()}
        return dict.fromkeys(self.entries, value) | products

    def picked(self, shares: np.ndarray) -> list[Value]:
        """Return the values at shares [n] from 0 to 1 of its distribution; those of a
        list are equally likely."""
        if self.distribution is not None:
            return [rounded(x) for x in self.distribution.quantiles(shares)]
        numbers = np.minimum(shares * len(self.values), len(self.values) - 1)
        return [self.values[i] for i in numbers.astype(int)]

    def ends(self) -> list[Value]:
        """Return the values that it takes one at a time."""
        if self.distribution is not None:
            return self.picked(np.array(UNCERTAIN))
        return list(self.values)


def rounded(value: float) -> float:
    """Return a value with the digits that matter, so that it is read easily and is
    the same on each machine."""
    return float(f"{value:.6g}")


def product(factor: Value, text: str) -> Value:
    """Return a factor times a number, or times an expression."""
    try:
        return rounded(float(factor) * float(text))
    except ValueError:
        return f"{text_of(factor)}*({text})"


def text_of(value: Value) -> str:
    """Return a value for names and tables."""
    return f"{value:.6g}" if is_number(value) else str(value)


def check_values(values: Any) -> tuple[Value, ...]:
    """Return the values of a list."""
    require(
        isinstance(values, list) and len(values) > 0,
        f"values is {values!r}, not a list such as [28, 31, 34]",
    )
    for value in values:
        require(
            is_number(value) or isinstance(value, (bool, str)),
            f"{value!r} in values is neither a finite number nor a word",
        )
        require(values.count(value) == 1, f"{value!r} is in values twice")
    return tuple(values)


def check_range(given: Any) -> tuple[Value, ...]:
    """Return the values of a range, both ends among them."""
    require(
        isinstance(given, dict) and {"from", "to", "n"} <= set(given) <= RANGE_KEYS,
        f"range is {given!r}; give {{from = 28, to = 36, n = 5}}, and logarithmic ="
        " true for equal ratios",
    )
    first, last, n = given["from"], given["to"], given["n"]
    require(is_number(first) and is_number(last), "from and to are not both numbers")
    require(first < last, f"from is {first:g} and must be below to, {last:g}")
    is_count = isinstance(n, int) and not isinstance(n, bool) and n >= 2
    require(is_count, f"n is {n!r} and must be a whole number, 2 or more")
    if not given.get("logarithmic", False):
        return tuple(rounded(x) for x in np.linspace(first, last, n))
    require(first > 0, f"from is {first:g}; a logarithmic range begins above 0")
    return tuple(rounded(x) for x in np.geomspace(first, last, n))


def entries_of(name: str, given: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the entries that a parameter sets: those it says, or that of its name."""
    found = given.get("entries", given.get("entry", name if "/" in name else None))
    require(
        found is not None,
        'it says no entry: give entry = "Section/Entry", or use that as its name',
    )
    found = [found] if isinstance(found, str) else found
    require(
        isinstance(found, list)
        and len(found) > 0
        and all(isinstance(entry, str) for entry in found),
        f"entries is {found!r}, not a list of entries",
    )
    return tuple(found)


def check_keys(given: Any) -> str:
    """Return the way in which a parameter is given: one of WAYS."""
    require(isinstance(given, dict), f"it is {given!r}, not a table")
    ways = [way for way in WAYS if way in given]
    require(len(ways) == 1, f"give one of {', '.join(WAYS)}, and only one")
    known = {*ways, "base"} | (set() if ways == ["choices"] else WHERE)
    known |= ALL_KEYS if ways == ["distribution"] else set()
    unknown = sorted(set(given) - known)
    require(
        not unknown,
        f"it has no key {', '.join(unknown)}; known: {', '.join(sorted(known))}",
    )
    require(len(WHERE & set(given)) < 2, "give one of entry, entries and times")
    return ways[0]


def read(name: str, given: Any) -> Parameter:
    """Return a parameter of a study. Raises StudyError."""
    way, found = check_keys(given), Parameter(name, base=given.get("base"))
    what = given[way]
    if way == "choices":
        require(
            isinstance(what, dict)
            and len(what) > 0
            and all(isinstance(entries, dict) for entries in what.values()),
            f"choices is {what!r}; give {{loose = {{"
            '"Soil/Layer 1/Porosity" = 0.42}, dense = {...}}',
        )
        return replace(found, choices=what, values=tuple(what))
    if (times := given.get("times")) is not None:
        require(
            isinstance(times, dict) and len(times) > 0,
            f'times is {times!r}; give {{"Soil/Layer 1/Cohesion" = "2e3 + 1.5e3*d"}}',
        )
        times = {str(entry): str(text) for entry, text in times.items()}
        found = replace(found, times=times)
    else:
        found = replace(found, entries=entries_of(name, given))
    if way == "formula":
        return replace(found, formula=Formula(str(what)))
    if way == "distribution":
        keys = {k: v for k, v in given.items() if k in ALL_KEYS}
        return replace(found, distribution=Distribution(what, keys))
    check = check_values if way == "values" else check_range
    return replace(found, values=check(what))


def read_all(tables: object) -> list[Parameter]:
    """Return the parameters of a study by name, formulas after all others, in an
    order in which they can be computed. Raises StudyError."""
    if not isinstance(tables, dict) or not tables:
        raise StudyError(
            'a study of parameters needs at least one [parameters."Section/Entry"]'
        )
    found = []
    for name, table in tables.items():
        try:
            found.append(read(name, table))
        except StudyError as error:
            raise StudyError(f"parameter {name!r}: {error}") from error
    check_entries(found)
    labels = distinct_ends([parameter.name.split("/") for parameter in found])
    found = [replace(p, label=label) for p, label in zip(found, labels)]
    free = [parameter for parameter in found if parameter.formula is None]
    if not free:
        raise StudyError("each parameter has a formula, so that none varies")
    return free + sorted_formulas(free, [p for p in found if p.formula is not None])


def check_entries(parameters: list[Parameter]) -> None:
    """Raise StudyError where two parameters set the same entry."""
    owner: dict[str, str] = {}
    for parameter in parameters:
        chosen = (entry for choice in parameter.choices.values() for entry in choice)
        for entry in {*parameter.entries, *parameter.times, *chosen}:
            if (other := owner.setdefault(entry, parameter.name)) != parameter.name:
                raise StudyError(
                    f"the parameters {other!r} and {parameter.name!r} set the same"
                    f" entry {entry}"
                )


def sorted_formulas(
    known: list[Parameter], formulas: list[Parameter]
) -> list[Parameter]:
    """Return the formulas, each after those that it needs. Raises StudyError."""
    names, done = {parameter.name for parameter in known}, list[Parameter]()
    while left := [parameter for parameter in formulas if parameter not in done]:
        ready = [p for p in left if p.formula and p.formula.names <= names]
        if not ready:
            formula = left[0].formula
            assert formula
            unknown = ", ".join(sorted(formula.names - names))
            raise StudyError(
                f"parameter {left[0].name!r}: the formula {formula.text!r} needs"
                f" {unknown}, which no other parameter gives; known:"
                f" {', '.join(sorted(names))}"
            )
        done += ready
        names |= {parameter.name for parameter in ready}
    return done
