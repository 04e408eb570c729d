# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values that follow from those of other parameters: 2/3 * phi, max(0, phi - 30).

A formula has numbers, names of parameters, + - * / **, brackets, and the functions
abs, min, max, sqrt, exp, log, log10, sin, cos, tan, asin, acos and atan; angles are in
degrees.
"""
import ast
import math
from collections.abc import Callable, Mapping
from typing import Any

from caisson.study import StudyError

FUNCTIONS: dict[str, Callable[..., float]] = {
    "abs": abs,
    "min": min,
    "max": max,
    "sqrt": math.sqrt,
    "exp": math.exp,
    "log": math.log,
    "log10": math.log10,
    "sin": lambda x: math.sin(math.radians(x)),
    "cos": lambda x: math.cos(math.radians(x)),
    "tan": lambda x: math.tan(math.radians(x)),
    "asin": lambda x: math.degrees(math.asin(x)),
    "acos": lambda x: math.degrees(math.acos(x)),
    "atan": lambda x: math.degrees(math.atan(x)),
}
PARTS = (
    *(ast.Expression, ast.BinOp, ast.UnaryOp, ast.Call, ast.Name, ast.Load),
    *(ast.Add, ast.Sub, ast.Mult, ast.Div, ast.Pow, ast.USub, ast.UAdd),
)


class Formula:
    """A formula, which is read once and computed for many values."""

    def __init__(self, text: str) -> None:
        """Raises StudyError where it cannot be read."""
        self.text = text
        try:
            tree = ast.parse(text, mode="eval")
            parts = list(ast.walk(tree))
            for part in parts:
                if isinstance(part, ast.Constant) and type(part.value) in (int, float):
                    part.value = float(part.value)  # whole ones have no largest power
                elif not isinstance(part, PARTS):
                    words = f"{ast.unparse(part)!r} is not understood"
                    raise StudyError(f"the formula {text!r:.80}: {words}")
            self.code = compile(tree, "", "eval")
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            raise StudyError(f"the formula {text!r:.80} cannot be read") from error
        found = {part.id for part in parts if isinstance(part, ast.Name)}
        self.names = found - set(FUNCTIONS)  # of parameters

    def value(self, values: Mapping[str, Any]) -> float:
        """Return its value. Raises StudyError where it has none."""
        used = {name: values[name] for name in self.names & set(values)}
        try:
            if words := [k for k, v in used.items() if not isinstance(v, (int, float))]:
                raise TypeError(f"{words[0]} is no number")
            scope: dict[str, Any] = {"__builtins__": {}, **FUNCTIONS, **used}
            result = float(eval(self.code, scope))  # noqa: S307
        except (
            ArithmeticError,
            LookupError,
            NameError,
            TypeError,
            ValueError,
        ) as error:
            raise StudyError(f"the formula {self.text!r:.80}: {error}") from error
        if not math.isfinite(result):
            raise StudyError(f"the formula {self.text!r} gives {result}")
        return result
