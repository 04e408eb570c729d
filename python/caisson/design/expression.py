# SPDX-License-Identifier: LGPL-2.1-or-later
"""Expressions in the depth as engineers write them, with units in them: "2 kPa +
1.5 kPa*z", "(2 + 1.5 d) kPa", "200 su". The program takes numbers in SI units, the
signs of products, and d for the depth below the mudline in m."""
import ast
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from caisson.design import quantity
from caisson.design.quantity import EVERY, NUMBER, UNSIGNED, factor_of, plain, value_of

DEPTHS = ("d", "z")  # the program's name first
STRESSES = ("s", "p")  # Pa
VARIABLES = ("d", *STRESSES, "pi")
HELP = (
    "d, or z, is the depth below the mudline (m), s and p are the vertical and the mean"
    " effective stress at the start (Pa)"
)
FUNCTIONS: dict[str, Callable[..., Any]] = {
    "min": min,
    "max": max,
    "abs": abs,
    "if": lambda condition, yes, no: yes if condition else no,
}
OF_MATH = "sqrt exp log log10 tanh sin cos tan pow".split()
FUNCTIONS |= {name: getattr(math, name) for name in OF_MATH}
UNITS_OF_NUMBERS = [unit for unit in quantity.UNITS if unit]
OF_TERMS = ("min", "max", "abs", "if")  # their arguments have the same unit
UNITS = "|".join(map(re.escape, sorted(EVERY, key=len, reverse=True)))
TOKEN = re.compile(
    rf"(\s*)(?:(?P<number>{UNSIGNED})"
    rf"|(?P<unit>{UNITS})(?!\w)(?P<rate>/m(?!\w))?"
    r"|(?P<name>[^\W\d]\w*)|(?P<sign>\S))"
)


@dataclass(frozen=True)
class Token:
    """A part of an expression: kind is number, unit, symbol, name or sign."""

    kind: str
    text: str
    space: str = ""

    @property
    def ends_value(self) -> bool:
        """Whether a value ends with it."""
        return self.kind != "sign" or self.text == ")"


def tokens_of(text: str, symbols: Mapping[str, str] = {}) -> list[Token]:
    """Return the parts of an expression, with the sign of each product. Raises
    ValueError for a name that is neither a variable nor a function nor a symbol."""
    found, place = list[Token](), 0
    text = re.sub(r"(?<=[A-Za-z])[²³]", lambda m: plain(m[0]), text.strip())
    is_call = False
    while match := TOKEN.match(text, place):
        kind, place = str(match.lastgroup), match.end()
        if kind == "rate":
            check_gradient(text, match.start(), place)
            kind = "unit"
        token = Token(kind, match[kind], match[1])
        if kind == "unit" and not (found and found[-1].ends_value):
            token = replace(token, kind="name")
        if token.kind == "name":
            token = named(token, text, symbols)
        begins = token.kind in ("number", "symbol", "name") or token.text == "("
        if found and found[-1].ends_value and begins and not is_call:
            found.append(Token("sign", "*"))
            token = replace(token, space="")
        is_call = token.kind == "name" and token.text in FUNCTIONS
        found.append(token)
    return found


def check_gradient(text: str, start: int, end: int) -> None:
    """Refuse a unit per m, at a place of a text, whose term does not have the depth.
    Raises ValueError."""
    term = re.split(r"[+-]", text[:start])[-1] + re.split(r"[+-]", text[end:])[0]
    if not re.search(r"(?<![A-Za-z])[dz]\b|[()]", term):
        raise ValueError(f"{text!r}: {text[start:end].strip()} needs *z, the depth")


def named(token: Token, text: str, symbols: Mapping[str, str]) -> Token:
    """Return the variable, function or symbol that a name stands for. Raises
    ValueError."""
    if token.text in DEPTHS:
        return replace(token, text=DEPTHS[0])
    if token.text in symbols:
        return replace(token, kind="symbol")
    if token.text in VARIABLES or token.text in FUNCTIONS:
        return token
    raise ValueError(f"{text!r}: {token.text!r} is no variable; {HELP}")


def text_of(tokens: Sequence[Token], unit: str, symbols: Mapping[str, str]) -> str:
    """Return the text in the unit of an entry, a unit within it as a factor. Raises
    ValueError."""
    found, number = "", ""
    for token in tokens:
        piece = token.space + token.text
        if token.kind == "unit":
            factor = factor_of(token.text, token.text, unit)
            piece = f"*{factor:g}"
            if number:
                found = found.removesuffix(number)
                piece = f"{float(f'{float(number) * factor:.12g}'):.10g}"
        elif token.kind == "symbol":
            piece = f"{token.space}({symbols[token.text]})"
        found += piece
        number = token.text if token.kind == "number" else ""
    return found


def tree_of(text: str) -> ast.expr | None:
    """Return an expression as a tree, None where it has another form than ours."""
    try:
        return ast.parse(
            text.replace("^", "**").replace("if(", "if_("), mode="eval"
        ).body
    except SyntaxError:
        return None


def name_of(node: ast.Call) -> str:
    """Return the function that is called."""
    return getattr(node.func, "id", "").rstrip("_")


def dimension(node: ast.expr) -> int:
    """Return how many units, here named U, an expression is multiplied with. Raises
    ValueError where the terms of a sum differ."""
    if isinstance(node, ast.Name):
        return int(node.id in ("U", *STRESSES))
    if isinstance(node, ast.UnaryOp):
        return dimension(node.operand)
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub)):
        return dimension_of_terms([node.left, node.right])
    if isinstance(node, ast.BinOp):
        left, right = dimension(node.left), dimension(node.right)
        sign = {ast.Mult: 1, ast.Div: -1}.get(type(node.op), 0)
        return left + sign * right
    if isinstance(node, ast.Call) and name_of(node) in OF_TERMS:
        return dimension_of_terms(node.args[name_of(node) == "if" :])
    return 0


def dimension_of_terms(nodes: Sequence[ast.expr]) -> int:
    """Return the dimension that all terms have; a zero has any. Raises ValueError."""
    terms = [n for n in nodes if not (isinstance(n, ast.Constant) and n.value == 0)]
    found = {dimension(node): node for node in terms}
    if len(found) > 1:
        term = (
            ast.unparse(min(found.items())[1]).replace(" ** ", "^").replace(" * ", "*")
        )
        raise ValueError(term)
    return next(iter(found), 0)


def has_unit(token: Token) -> bool:
    """Return whether a part has a unit: a symbol and a stress have theirs."""
    return token.kind in ("unit", "symbol") or token.text in STRESSES


def refuse_no_expression(text: str, tokens: Sequence[Token]) -> None:
    """Refuse parentheses without their other one, signs without a value and numbers
    without an end. Raises ValueError."""
    body = "".join(t.text for t in tokens if t.kind != "unit")
    if re.search(r"[?&|!=]", body):  # forms that only the program reads
        return
    nodes = list(ast.walk(tree)) if (tree := tree_of(body)) else []
    if not nodes or any(isinstance(node, ast.Tuple) for node in nodes):
        raise ValueError(f"{text!r} is no expression: check parentheses and signs")
    for node in nodes:
        if isinstance(node, ast.Constant) and not abs(float(node.value)) < math.inf:
            raise ValueError(f"{text!r} has a number that is too large")


def in_unit(text: str, unit: str, symbols: Mapping[str, str] = {}) -> str:
    """Return an expression in the unit of its entry. A unit that is the only one and
    the last word counts for all of it. symbols: {name: expression in this unit}. Raises
    ValueError with what is wrong."""
    if unit == "Pa":  # a unit weight is a gradient of stress
        text = re.sub(r"N/m[3³](?!\w)", "N/m2/m", text)
    tokens = tokens_of(text, symbols)
    refuse_no_expression(text, tokens)
    if all(token.kind not in ("unit", "symbol") for token in tokens):
        return text_of(tokens, unit, symbols)
    last = tokens[-1]
    if [t for t in tokens if has_unit(t)] == [last] and last.kind == "unit":
        body = text_of(tokens[:-1], unit, symbols)
        whole = body if re.fullmatch(r"\([^()]*\)", body) else f"({body})"
        return f"{factor_of(text, last.text, unit):g}*{whole}"
    units = {"unit": Token("sign", "*U"), "symbol": Token("name", "U")}
    tree = tree_of(text_of([units.get(t.kind, t) for t in tokens], unit, symbols))
    try:
        power = 1 if tree is None else dimension(tree)
    except ValueError as term:
        raise ValueError(
            f"{text!r}: {term} has no unit and other terms have; give it a unit, or"
            f" all terms together, as in (20 + 2*d) kPa"
        ) from term
    if power != 1:
        raise ValueError(
            f"{text!r} must have its unit once in each term, or at its end"
        )
    return text_of(tokens, unit, symbols)


def without_unit(text: str, unit: str, symbols: Mapping[str, str] = {}) -> str:
    """Return the value of an entry, a number, an expression or a word, in the unit of
    the entry. Raises ValueError with what is wrong."""
    if re.fullmatch(NUMBER, text):
        return text
    word = re.fullmatch(rf"{NUMBER}\s*(.*?)(?:/m)?", text)
    if word and plain(word[1]) in EVERY:
        return f"{value_of(text, unit):.10g}"
    if not re.search(r"\d|[*^(]", text) and text not in (*DEPTHS, *STRESSES, *symbols):
        return text
    try:
        found = in_unit(text, unit, symbols)
        words = set(re.findall(r"[^\W\d]\w*", text)) & set(symbols)
        if words or re.search(r"[A-Za-z]", re.sub(NUMBER, "", found)):
            return found
        value = value_at(found, 0.0, 0.0)  # no variable: a number
        return found if value is None else f"{value:.10g}"
    except ValueError:
        if unit in UNITS_OF_NUMBERS:
            raise
        return text  # the program knows what it may be


def value_at(text: str, depth: float, stress: float) -> float | None:
    """Return an expression of the program at a depth (m) and an effective stress (Pa);
    None where its form is not known."""
    try:
        names = {"d": depth, "s": stress, "p": stress, "pi": math.pi}
        functions = {
            name + ("_" if name == "if" else ""): f for name, f in FUNCTIONS.items()
        }
        tokens_of(text)  # refuses other names
        tree = tree_of(text)
        assert tree is not None
        code = compile(ast.Expression(tree), "", "eval")
        return float(eval(code, {"__builtins__": {}}, names | functions))  # noqa: S307
    except (AssertionError, ValueError, TypeError, ArithmeticError, NameError):
        return None
