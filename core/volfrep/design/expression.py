# SPDX-License-Identifier: LGPL-2.1-or-later
"""Formulas of one variable, or of a few, that a user types; their syntax tree is evaluated.

Nothing is ever handed to Python to run: the text is parsed, every node of the tree is checked
against what is listed here, and the nodes are evaluated as numpy operations on float64. So a
formula can reach no name, attribute or file, and ``9**9**9`` is infinity at once instead of a
number with 369 million digits.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..util.errors import VolfrepError
from ..util.types import Floats

MAX_CHARACTERS = 500
MAX_NODES = 200
#: Of nested operations; the tree is walked by recursion.
MAX_DEPTH = 50
#: Thousandths, thirds and 32nds are among these values of s, exactly as a user writes them.
SAMPLES: Floats = np.arange(12001) / 12000.0

VARIABLE = "s"
CONSTANTS = {"pi": math.pi, "e": math.e}


def _step(edge: Floats, x: Floats) -> Floats:
    return np.asarray(x >= edge, dtype=np.float64)


def _smoothstep(first: Floats, last: Floats, x: Floats) -> Floats:
    t: Floats = np.clip((x - first) / (last - first), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def _least(*values: Floats) -> Floats:
    return np.asarray(np.minimum.reduce(np.broadcast_arrays(*values)))


def _largest(*values: Floats) -> Floats:
    return np.asarray(np.maximum.reduce(np.broadcast_arrays(*values)))


def _clip(x: Floats, low: Floats, high: Floats) -> Floats:
    return _least(_largest(x, low), high)


def _through(x: Floats, *points: Floats) -> Floats:
    """Straight from point to point, level beyond the first and the last: a sum of ramps."""
    at, values = points[0::2], points[1::2]
    result = np.asarray(values[0], dtype=np.float64)
    for k in range(len(at) - 1):
        share = np.clip((x - at[k]) / (at[k + 1] - at[k]), 0.0, 1.0)
        result = result + share * (values[k + 1] - values[k])
    return result


class _Function(NamedTuple):
    usage: str
    fewest: int
    most: int
    evaluate: Callable[..., Any]
    #: Whether pairs follow upon the first argument.
    in_pairs: bool = False


#: A new function is one more line here (and in docs/grading.md).
FUNCTIONS: dict[str, _Function] = {
    "sin": _Function("sin(x)", 1, 1, np.sin),
    "cos": _Function("cos(x)", 1, 1, np.cos),
    "tan": _Function("tan(x)", 1, 1, np.tan),
    "asin": _Function("asin(x)", 1, 1, np.arcsin),
    "acos": _Function("acos(x)", 1, 1, np.arccos),
    "atan": _Function("atan(x)", 1, 1, np.arctan),
    "atan2": _Function("atan2(y, x)", 2, 2, np.arctan2),
    "sinh": _Function("sinh(x)", 1, 1, np.sinh),
    "cosh": _Function("cosh(x)", 1, 1, np.cosh),
    "tanh": _Function("tanh(x)", 1, 1, np.tanh),
    "exp": _Function("exp(x)", 1, 1, np.exp),
    "log": _Function("log(x)", 1, 1, np.log),
    "log10": _Function("log10(x)", 1, 1, np.log10),
    "sqrt": _Function("sqrt(x)", 1, 1, np.sqrt),
    "abs": _Function("abs(x)", 1, 1, np.abs),
    "min": _Function("min(x, y, ...)", 2, MAX_NODES, _least),
    "max": _Function("max(x, y, ...)", 2, MAX_NODES, _largest),
    "floor": _Function("floor(x)", 1, 1, np.floor),
    "ceil": _Function("ceil(x)", 1, 1, np.ceil),
    "clip": _Function("clip(x, low, high)", 3, 3, _clip),
    "step": _Function("step(edge, x)", 2, 2, _step),
    "smoothstep": _Function("smoothstep(first, last, x)", 3, 3, _smoothstep),
    "through": _Function("through(x, x1, y1, x2, y2, ...)", 5, MAX_NODES, _through, True),
}

_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: np.add,
    ast.Sub: np.subtract,
    ast.Mult: np.multiply,
    ast.Div: np.divide,
    ast.FloorDiv: np.floor_divide,
    ast.Mod: np.mod,
    ast.Pow: np.power,
}
_UNARY: dict[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.UAdd: np.positive,
    ast.USub: np.negative,
    ast.Not: np.logical_not,
}
_COMPARISON: dict[type[ast.cmpop], Callable[[Any, Any], Any]] = {
    ast.Lt: np.less,
    ast.LtE: np.less_equal,
    ast.Gt: np.greater,
    ast.GtE: np.greater_equal,
    ast.Eq: np.equal,
    ast.NotEq: np.not_equal,
}
_BOOLEAN: dict[type[ast.boolop], Callable[[Any, Any], Any]] = {
    ast.And: np.logical_and,
    ast.Or: np.logical_or,
}


def _allowed(variables: tuple[str, ...]) -> str:
    return (
        f"use numbers, {', '.join(variables)}, pi, e, + - * / // % **, comparisons, 'and', 'or', "
        f"'not', 'a if b else c', and the functions {', '.join(FUNCTIONS)}"
    )


@dataclass(frozen=True)
class Expression:
    """A formula that has passed `compile_expression`; two of the same text are equal.

    Attributes:
        text: the formula as it was given, without the blanks about it.
        variables: what it is a formula of.
    """

    text: str
    variables: tuple[str, ...] = (VARIABLE,)
    _tree: ast.expr = field(kw_only=True, repr=False, compare=False)

    def __call__(self, *at: ArrayLike) -> Floats:
        """The formula's values: float64 of the shape that its variables have in common.

        A comparison is 1 where it holds and 0 elsewhere. Where the formula has no value (a
        division by zero, the logarithm of a negative number) the result is nan or infinite.
        """
        values = [np.asarray(value, dtype=np.float64) for value in at]
        shape = np.broadcast_shapes(*(value.shape for value in values))
        known = dict(zip(self.variables, values, strict=True))
        with np.errstate(all="ignore"):  # what is not finite is the caller's to judge
            return np.array(np.broadcast_to(_evaluate(self._tree, known), shape))


def compile_expression(text: str, variables: tuple[str, ...] = (VARIABLE,)) -> Expression:
    """Parse and check a formula.

    Args:
        text: up to 500 characters, for instance ``1 + 0.5 * sin(2 * pi * s)``. Besides numbers
            it may hold its variables, pi and e, + - * / // % **, comparisons, ``and``, ``or``,
            ``not``, ``a if b else c``, and the `FUNCTIONS`.
        variables: what it is a formula of.

    Raises:
        VolfrepError: naming the part that cannot be read or is not allowed, and what is.

    >>> compile_expression("2 - s ** 2")([0, 0.5, 1]).tolist()
    [2.0, 1.75, 1.0]
    """
    if not isinstance(text, str):
        raise VolfrepError(f"A formula must be a text such as '1 + s', not {text!r}.")
    text = text.strip()
    if not text:
        raise VolfrepError("The formula is empty: write one such as '1 + s'.")
    if len(text) > MAX_CHARACTERS:
        raise VolfrepError(
            f"The formula has {len(text)} characters: the limit is {MAX_CHARACTERS}."
        )
    try:
        tree = ast.parse(text, mode="eval").body
    except SyntaxError as error:
        raise VolfrepError(
            f"The formula '{_short(text)}' cannot be read at character "
            f"{min(error.offset or 1, len(text))} ({error.msg}): write one such as '1 + 2 * s'."
        ) from error
    except ValueError as error:
        raise VolfrepError(
            "The formula holds a character that cannot be written in a file: type it again."
        ) from error
    except (RecursionError, MemoryError) as error:
        raise VolfrepError(
            f"The formula '{_short(text)}' is nested too deeply: the limit is {MAX_DEPTH} levels."
        ) from error
    for count, (node, depth) in enumerate(_walk(tree), start=1):
        if count > MAX_NODES:
            raise VolfrepError(
                f"The formula '{_short(text)}' has more than {MAX_NODES} numbers, names and "
                "operations: shorten it."
            )
        if depth > MAX_DEPTH:
            raise VolfrepError(
                f"The formula '{_short(text)}' is nested too deeply: the limit is {MAX_DEPTH} "
                "levels."
            )
        complaint = _complaint(node, variables)
        if complaint:
            part = ast.get_source_segment(text, node) or text
            raise VolfrepError(f"In the formula, '{_short(part)}' {complaint}.")
    return Expression(text, variables, _tree=tree)


def evaluate_numbers(data: Any, values: Mapping[str, float], where: str) -> Any:
    """Lists of numbers and formulas with the numbers that the formulas come to.

    Args:
        data: of a file: numbers, texts, and lists of them.
        values: of what the formulas are formulas of; none: texts stay.
        where: what holds them, in errors.

    Raises:
        VolfrepError: a formula cannot be read, or has no value.
    """
    if not values:
        return data
    if isinstance(data, list):
        return [evaluate_numbers(item, values, where) for item in data]
    if not isinstance(data, str):
        return data
    try:
        result = float(compile_expression(data, tuple(values))(*values.values()))
    except VolfrepError as error:
        raise VolfrepError(f"In the {where}: {error}") from error
    if not np.isfinite(result):
        raise VolfrepError(f"In the {where}, the formula '{data}' has no value.")
    return result


def check_finite(expression: Expression) -> None:
    """Make sure that a formula has a finite value everywhere on [0, 1], as far as samples tell.

    Raises:
        VolfrepError: naming the first of the `SAMPLES` of s where it has none.
    """
    values = expression(SAMPLES)
    bad = np.flatnonzero(~np.isfinite(values))
    if len(bad):
        raise VolfrepError(
            f"The formula '{_short(expression.text)}' has no finite value at "
            f"s = {SAMPLES[bad[0]]:.6g}: it must have one everywhere from s = 0 to s = 1."
        )


def _walk(tree: ast.expr) -> Iterator[tuple[ast.expr, int]]:
    """Every expression of the tree and its depth, parents first, without recursion.

    A called function's name is not one of them: the call answers for it.
    """
    waiting = [(tree, 1)]
    while waiting:
        node, depth = waiting.pop()
        yield node, depth
        children = [c for c in ast.iter_child_nodes(node) if isinstance(c, ast.expr)]
        if isinstance(node, ast.Call):
            children = node.args
        waiting.extend((child, depth + 1) for child in reversed(children))


def _complaint(node: ast.expr, variables: tuple[str, ...]) -> str:
    """What is wrong with a node by itself, or nothing."""
    allowed = _allowed(variables)
    if isinstance(node, ast.Constant):
        return _complaint_of_number(node.value, allowed)
    if isinstance(node, ast.Name):
        if node.id in variables or node.id in CONSTANTS:
            return ""
        if node.id in FUNCTIONS:
            return f"is a function: write {FUNCTIONS[node.id].usage}"
        return f"is not known: {allowed}"
    if isinstance(node, ast.Call):
        return _complaint_of_call(node)
    if isinstance(node, ast.BinOp):
        if isinstance(node.op, ast.BitXor):
            return "uses '^': write ** for a power"
        return "" if type(node.op) in _BINARY else f"is not allowed: {allowed}"
    if isinstance(node, ast.UnaryOp):
        return "" if type(node.op) in _UNARY else f"is not allowed: {allowed}"
    if isinstance(node, ast.Compare):
        known = all(type(op) in _COMPARISON for op in node.ops)
        return "" if known else f"is not allowed: {allowed}"
    if isinstance(node, ast.Tuple):
        return "is more than one value: write decimals with a point and one formula only"
    if isinstance(node, ast.BoolOp | ast.IfExp):
        return ""
    return f"is not allowed: {allowed}"


def _complaint_of_number(value: object, allowed: str) -> str:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return f"is not allowed: {allowed}"
    # Compared before the conversion, which an integer of 400 digits would not survive.
    return "" if value <= 1e300 else "is too large a number: keep it below 1e300"


def _complaint_of_call(call: ast.Call) -> str:
    function = FUNCTIONS.get(call.func.id) if isinstance(call.func, ast.Name) else None
    if function is None:
        return f"is not a function of formulas: use {', '.join(FUNCTIONS)}"
    count = len(call.args)
    fits = function.fewest <= count <= function.most and not (function.in_pairs and count % 2 == 0)
    if call.keywords or not fits:
        return f"has the wrong arguments: write {function.usage}"
    return ""


def _evaluate(node: ast.expr, s: Mapping[str, Floats]) -> Any:
    """The value of a checked node, broadcastable to the shape of the variables."""
    match node:
        case ast.Constant(value=int() | float() as number):
            return np.float64(number)
        case ast.Name(id=name):
            return s[name] if name in s else np.float64(CONSTANTS[name])
        case ast.BinOp(left=left, op=op, right=right):
            return _BINARY[type(op)](_evaluate(left, s), _evaluate(right, s))
        case ast.UnaryOp(op=op, operand=operand):
            return np.float64(1) * _UNARY[type(op)](_evaluate(operand, s))
        case ast.Compare(left=left, ops=ops, comparators=comparators):
            return _compare([_evaluate(n, s) for n in (left, *comparators)], ops)
        case ast.BoolOp(op=op, values=values):
            truth = _evaluate(values[0], s)
            for value in values[1:]:
                truth = _BOOLEAN[type(op)](truth, _evaluate(value, s))
            return np.float64(1) * truth
        case ast.IfExp(test=test, body=body, orelse=orelse):
            chosen = _evaluate(test, s) != 0
            return np.where(chosen, _evaluate(body, s), _evaluate(orelse, s))
        case ast.Call(func=ast.Name(id=name), args=args):
            return FUNCTIONS[name].evaluate(*(_evaluate(a, s) for a in args))
    raise AssertionError(f"{type(node).__name__} passed the check of the formula")


def _compare(values: list[Any], ops: list[ast.cmpop]) -> Any:
    """``a < b <= c`` as Python means it: both hold."""
    holds: Any = np.float64(1)
    for left, op, right in zip(values, ops, values[1:], strict=False):
        holds = holds * _COMPARISON[type(op)](left, right)
    return holds


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 40 else line[:37] + "..."
