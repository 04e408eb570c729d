# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values that follow from those of other parameters: 2/3 * phi, max(0, phi - 30).

A formula has numbers, names of parameters, + - * / **, brackets, and the functions
abs, min, max, sqrt, exp, log, log10, sin, cos, tan, asin, acos and atan; angles are in
degrees.
"""
import ast
import math
import operator
from collections.abc import Callable, Mapping
from typing import Any

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
OPERATORS: dict[type, Callable[..., float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: math.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}


class FormulaError(Exception):
    """What is wrong with a formula; the text is for the user."""


class Formula:
    """A formula, which is read once and computed for many values."""

    def __init__(self, text: str) -> None:
        """Raises FormulaError where it cannot be read."""
        self.text = text
        try:
            self.tree = ast.parse(text, mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            raise FormulaError(f"the formula {text!r:.80} cannot be read") from error

    @property
    def names(self) -> set[str]:
        """The parameters that occur in it."""
        found = {n.id for n in ast.walk(self.tree) if isinstance(n, ast.Name)}
        return found - set(FUNCTIONS)

    def value(self, values: Mapping[str, Any]) -> float:
        """Return its value. Raises FormulaError where it has none."""
        try:
            result = float(self._value(self.tree, values))
        except (ArithmeticError, ValueError, TypeError, RecursionError) as error:
            raise FormulaError(f"the formula {self.text!r:.80}: {error}") from error
        if not math.isfinite(result):
            raise FormulaError(f"the formula {self.text!r} gives {result}")
        return result

    def _value(self, node: ast.AST, values: Mapping[str, Any]) -> float:
        """Return the value of a part."""
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return float(node.value)
        if isinstance(node, ast.Name) and node.id in values:
            if isinstance(values[node.id], (int, float)):
                return float(values[node.id])
            raise FormulaError(f"the formula {self.text!r}: {node.id} is no number")
        if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
            sides = (self._value(side, values) for side in (node.left, node.right))
            return OPERATORS[type(node.op)](*sides)
        if isinstance(node, ast.UnaryOp) and type(node.op) in OPERATORS:
            return OPERATORS[type(node.op)](self._value(node.operand, values))
        if isinstance(node, ast.Call) and not node.keywords:
            name = node.func.id if isinstance(node.func, ast.Name) else ""
            if name in FUNCTIONS:
                return FUNCTIONS[name](*(self._value(a, values) for a in node.args))
        part = ast.unparse(node)
        raise FormulaError(f"the formula {self.text!r}: {part!r} is not understood")
