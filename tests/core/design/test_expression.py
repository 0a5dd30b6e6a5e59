# SPDX-License-Identifier: LGPL-2.1-or-later
"""Formulas against Python's own arithmetic, and everything that is no formula refused."""

import math
import operator
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from volfrep.design.expression import (
    FUNCTIONS,
    MAX_CHARACTERS,
    MAX_DEPTH,
    MAX_NODES,
    SAMPLES,
    check_finite,
    compile_expression,
)
from volfrep.util.errors import VolfrepError

#: Its text, and its value at s, where every function that is rounded differently by different
#: libraries is off by a small number.
Formula = tuple[str, Callable[[float, float], float]]


def value(text: str, s: float = 0.0) -> float:
    return float(compile_expression(text)(s))


@pytest.mark.parametrize(
    ("text", "s", "expected"),
    [
        ("1 + 2 * s", 0.25, 1.5),
        ("2 ** 3 ** 2", 0, 512),
        ("-2 ** 2", 0, -4),
        ("-s ** 2", 0.5, -0.25),
        ("(-s) ** 2", 0.5, 0.25),
        ("7 // 2", 0, 3),
        ("-7 // 2", 0, -4),
        ("-7 % 3", 0, 2),
        ("1 if s < 0.5 else 2", 0.5, 2),
        ("0.2 < s < 0.4", 0.3, 1),
        ("0.2 < s < 0.4", 0.4, 0),
        ("1 if s < 0.1 or s > 0.9 else 2", 0.95, 1),
        ("s > 0.2 and not s > 0.5", 0.3, 1),
        ("s != 0.25", 0.25, 0),
        ("sin(pi / 6)", 0, 0.5),
        ("atan2(1, -1)", 0, 0.75 * math.pi),
        ("log(e)", 0, 1),
        ("log10(1000)", 0, 3),
        ("sqrt(abs(-16))", 0, 4),
        ("min(3, s, 2)", 1, 1),
        ("max(s, 3)", 1, 3),
        ("floor(-1.5) + ceil(1.5)", 0, 0),
        ("clip(s, 0.2, 0.8)", 0.9, 0.8),
        ("step(0.5, s)", 0.5, 1),
        ("step(0.5, s)", 0.4999, 0),
        ("smoothstep(0, 2, s)", 0.5, 5 / 32),  # 3 t2 - 2 t3 at t = 1/4
        ("smoothstep(0.2, 0.4, s)", 0.5, 1),
        ("through(s, 0, 1, 0.5, 3, 1, 2)", 0.25, 2),
        ("through(s, 0, 1, 0.5, 3, 1, 2)", 0.75, 2.5),
        ("through(s, 0.2, 1, 0.8, 3)", 0.1, 1),
        ("through(s, 0.2, 1, 0.8, 3)", 0.9, 3),
        ("(1 +\n s)", 1, 2),
    ],
)
def test_what_a_formula_means(text: str, s: float, expected: float) -> None:
    assert value(text, s) == pytest.approx(expected, rel=1e-15)


BINARY: dict[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "//": operator.floordiv,
    "%": operator.mod,
    "**": operator.pow,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}
UNARY: dict[str, Callable[[float], float]] = {
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "asin": math.asin,
    "acos": math.acos,
    "atan": math.atan,
    "sinh": math.sinh,
    "cosh": math.cosh,
    "tanh": math.tanh,
    "exp": math.exp,
    "log": math.log,
    "log10": math.log10,
    "sqrt": math.sqrt,
    "abs": abs,
    "floor": math.floor,
    "ceil": math.ceil,
}


#: What every library rounds alike.
EXACT = BINARY.keys() - {"**"} | {"abs", "floor", "ceil", "sqrt"}


def moved(name: str, value: float, off: float) -> float:
    """The value of a function as another library might round it."""
    return value if name in EXACT else value * (1.0 + off) + off


def leaves() -> st.SearchStrategy[Formula]:
    numbers = st.integers(0, 40).map(lambda n: n / 8)
    return st.one_of(
        st.just(("s", lambda s, off: s)),
        st.sampled_from([("pi", lambda s, off: math.pi), ("e", lambda s, off: math.e)]),
        numbers.map(lambda n: (repr(n), lambda s, off: n)),
    )


def grow(inner: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
    def binary(op: str, a: Formula, b: Formula) -> Formula:
        return f"({a[0]} {op} {b[0]})", lambda s, off: moved(
            op, float(BINARY[op](a[1](s, off), b[1](s, off))), off
        )

    def unary(name: str, a: Formula) -> Formula:
        return f"{name}({a[0]})", lambda s, off: moved(name, float(UNARY[name](a[1](s, off))), off)

    def choice(test: Formula, a: Formula, b: Formula) -> Formula:
        text = f"({a[0]} if {test[0]} else {b[0]})"
        return text, lambda s, off: a[1](s, off) if test[1](s, off) else b[1](s, off)

    return st.one_of(
        st.builds(binary, st.sampled_from(sorted(BINARY)), inner, inner),
        st.builds(unary, st.sampled_from(sorted(UNARY)), inner),
        st.builds(choice, inner, inner, inner),
        inner.map(lambda a: (f"(-{a[0]})", lambda s, off: -a[1](s, off))),
    )


FORMULAS = st.recursive(leaves(), grow, max_leaves=8)


@settings(max_examples=30)
@given(formula=FORMULAS, s=st.integers(0, 64).map(lambda n: n / 64))
def test_random_formulas_agree_with_python(formula: Formula, s: float) -> None:
    text, by_python = formula
    assume(len(text) <= MAX_CHARACTERS)
    try:
        expected = by_python(s, 0.0)
    except (ArithmeticError, ValueError, TypeError):  # no value, or a complex one
        expected = math.nan
    # Beyond a million, and where an operation amplifies it, rounding is compared with rounding:
    # in s, and in what a function gives (exp(1) may be e or its neighbour).
    nearby = [by_python_or_nan(by_python, s + d, 0.0) for d in (-1e-12, 1e-12)]
    nearby += [by_python_or_nan(by_python, s, off) for off in (-1e-12, 1e-12)]
    assume(math.isfinite(expected) and abs(expected) < 1e6)
    assume(all(abs(n - expected) <= 1e-6 * (1 + abs(expected)) for n in nearby))
    found = compile_expression(text)(np.array([s]))
    assert found[0] == pytest.approx(expected, rel=1e-7, abs=1e-7)


def by_python_or_nan(formula: Callable[[float, float], float], s: float, off: float) -> float:
    try:
        return float(formula(s, off))
    except (ArithmeticError, ValueError, TypeError):
        return math.nan


@pytest.mark.parametrize("shape", [(), (1,), (5,), (0,), (2, 3, 4)])
@pytest.mark.parametrize("text", ["3", "s", "1 + s", "s > 0", "min(1, 2)", "1 if s else 2"])
def test_values_have_the_shape_of_s(text: str, shape: tuple[int, ...]) -> None:
    values = compile_expression(text)(np.full(shape, 0.5))
    assert values.shape == shape
    assert values.dtype == np.float64
    assert values.flags.writeable


def test_a_formula_leaves_its_argument_alone() -> None:
    s = np.array([0.0, 0.5])
    compile_expression("s")(s)[:] = 7.0
    np.testing.assert_array_equal(s, [0.0, 0.5])


def test_formulas_of_one_text_are_equal_and_travel() -> None:
    first, second = compile_expression(" 1 + s "), compile_expression("1 + s")
    assert first == second
    assert hash(first) == hash(second)
    assert first.text == "1 + s"
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(first))([0.0, 1.0]), [1.0, 2.0])


#: Everything that Python can say and a formula must not.
NO_FORMULAS = [
    "__import__('os').system('true')",
    "open('/etc/passwd')",
    "eval('1')",
    "().__class__.__bases__[0].__subclasses__()",
    "s.__class__",
    "s.tofile('x')",
    "sin.__globals__",
    "np.load('x')",
    "s[0]",
    "s[:]",
    "lambda: 1",
    "(lambda: 1)()",
    "(lambda s: s)(s)",
    "[x for x in s]",
    "{x for x in s}",
    "{x: x for x in s}",
    "sum(x for x in s)",
    "f'{s}'",
    "f'{s.__class__}'",
    "(t := s)",
    "'text'",
    "b'text'",
    "'a' * 9",
    "[1, 2]",
    "(1, 2)",
    "{1}",
    "{1: 2}",
    "{**s}",
    "sin(*s)",
    "sin(**s)",
    "sin(x=s)",
    "clip(s, low=0, high=1)",
    "sin(sin)",
    "sin",
    "sin()",
    "sin(s)(s)",
    "min(s)",
    "1j",
    "True",
    "None",
    "...",
    "s @ s",
    "~s",
    "s << 2",
    "s & 1",
    "s | 1",
    "s is s",
    "s in s",
    "s not in s",
    "__builtins__",
    "exit",
    "t",
    "S",
    "await s",
    "1e999",
    "9" * 400,
]
NO_SYNTAX = [
    "import os",
    "yield s",
    "s = 1",
    "s; s",
    "1 +",
    "2s",
    "(",
    ")",
    "'",
    "s\0",
    "def f(): pass",
    "print s",
    "\\",
    "s\n1",
]


@pytest.mark.parametrize("text", NO_FORMULAS)
def test_what_is_no_formula_is_refused(text: str) -> None:
    with pytest.raises(VolfrepError, match=r"^In the formula, '.*' (is|has|uses) .*\.$"):
        compile_expression(text)


@pytest.mark.parametrize("text", NO_SYNTAX)
def test_what_cannot_be_read_is_refused(text: str) -> None:
    with pytest.raises(VolfrepError, match=r"^The formula "):
        compile_expression(text)


@given(
    bad=st.sampled_from(NO_FORMULAS),
    place=st.sampled_from(
        ["1 + ({})", "sin({})", "s if ({}) else 1", "max(1, 2, {})", "-({})", "0 < ({}) < 1"]
    ),
)
def test_nor_is_it_allowed_inside_of_one(bad: str, place: str) -> None:
    with pytest.raises(VolfrepError):
        compile_expression(place.format(bad))


@pytest.mark.costly
@settings(max_examples=500)
@given(
    text=st.text(max_size=40) | st.text("s0123456789.+-*/%()<>=,^ einfmaxsort[]'_:{}", max_size=60)
)
def test_any_text_is_a_formula_or_one_sentence(text: str) -> None:
    refusal = ""
    try:
        formula = compile_expression(text)
    except VolfrepError as error:
        refusal = str(error)
    else:
        assert formula(np.array([0.0, 0.5, 1.0])).shape == (3,)
    assert "\n" not in refusal


class Tripwire:
    """Stands for s; anything but its conversion to an array shows."""

    touched: list[str] = []  # noqa: RUF012

    def __array__(self, dtype: Any = None) -> np.ndarray:
        return np.array([0.5])

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("__array"):
            self.touched.append(name)
        raise AttributeError(name)


def test_the_argument_is_only_ever_an_array_of_numbers() -> None:
    assert compile_expression("2 * s")(Tripwire())[0] == 1.0
    assert Tripwire.touched == []


@pytest.mark.parametrize("text", ["9**9**9", "9**9**9**9**9", "10**300 * 10**300", "exp(exp(9))"])
def test_huge_powers_are_infinite_at_once(text: str) -> None:
    assert value(text) == math.inf


@pytest.mark.parametrize(
    ("text", "limit"),
    [
        ("s" + " " * MAX_CHARACTERS + "+ s", MAX_CHARACTERS),
        ("+".join("s" * (MAX_NODES // 2 + 1)), "nested"),
        ("max(" + ",".join("s" * MAX_NODES) + ")", MAX_NODES),
        ("-" * MAX_DEPTH + "s", MAX_DEPTH),
        ("-" * 499 + "s", MAX_DEPTH),
        ("(" * 249 + "s" + ")" * 249, "too many nested parentheses"),
    ],
)
def test_formulas_are_bounded(text: str, limit: object) -> None:
    with pytest.raises(VolfrepError, match=str(limit)):
        compile_expression(text)


def test_the_largest_formulas_still_work() -> None:
    assert value("-" * (MAX_DEPTH - 1) + "s", 1.0) == (-1.0) ** (MAX_DEPTH - 1)
    assert value("max(" + ",".join("s" * (MAX_NODES - 1)) + ")", 3.0) == 3.0


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("s^2", r"write \*\* for a power"),
        ("1,5 * s", "decimals with a point"),
        ("sin", r"write sin\(x\)"),
        ("atan2(s)", r"write atan2\(y, x\)"),
        ("1 + t", "'t' is not known: use numbers, s, pi"),
        ("sine(s)", "'sine.s.' is not a function of formulas: use sin, cos"),
        ("", "is empty"),
        ("1 + * s", "at character 5"),
    ],
)
def test_errors_say_what_to_write(text: str, hint: str) -> None:
    with pytest.raises(VolfrepError, match=hint):
        compile_expression(text)


@pytest.mark.parametrize("text", [None, 3, b"s", ["s"]])
def test_a_formula_is_a_text(text: Any) -> None:
    with pytest.raises(VolfrepError, match="must be a text"):
        compile_expression(text)


@pytest.mark.parametrize(
    ("text", "where"),
    [
        ("1 / s", "s = 0:"),
        ("1 / (s - 1)", "s = 1:"),
        ("1 / (s - 0.1)", "s = 0.1:"),
        ("1 / (3 * s - 1)", "s = 0.333333:"),
        ("1 / (s - 0.123)", "s = 0.123:"),
        ("sqrt(s - 0.5)", "s = 0:"),
        ("log(1 - s)", "s = 1:"),
    ],
)
def test_where_a_formula_has_no_value_is_named(text: str, where: str) -> None:
    with pytest.raises(VolfrepError, match=where):
        check_finite(compile_expression(text))


def test_a_branch_not_taken_may_be_infinite() -> None:
    check_finite(compile_expression("1 / s if s > 0 else 1"))


def test_the_documentation_names_every_function() -> None:
    page = (Path(__file__).parents[3] / "docs" / "grading.md").read_text(encoding="utf-8")
    assert [f.usage for f in FUNCTIONS.values() if f"`{f.usage}`" not in page] == []
    assert all(f.usage.startswith(f"{name}(") for name, f in FUNCTIONS.items())


def test_the_formulas_of_the_documentation_work() -> None:
    page = (Path(__file__).parents[3] / "docs" / "grading.md").read_text(encoding="utf-8")
    formulas = re.findall(r"^\| `([^`]*\bs\b[^`]*)` \|", page, re.MULTILINE)
    assert len(formulas) >= 5
    for formula in formulas:
        assert compile_expression(formula)(SAMPLES).min() > 0.0


def test_a_curve_goes_through_its_points_as_numpy_interpolates() -> None:
    at, values = [0.0, 0.1, 0.45, 0.5, 1.0], [1.0, 0.4, 2.0, 0.7, 0.7]
    numbers = ", ".join(f"{a}, {v}" for a, v in zip(at, values, strict=True))
    places = np.linspace(-0.5, 1.5, 401)
    curve = compile_expression(f"through(s, {numbers})")(places)
    assert curve == pytest.approx(np.interp(places, at, values), abs=1e-14)


@pytest.mark.parametrize("text", ["through(s, 0, 1)", "through(s, 0, 1, 1)"])
def test_points_of_a_curve_come_in_pairs(text: str) -> None:
    with pytest.raises(VolfrepError, match=r"write through\(x, x1, y1, x2, y2, \.\.\.\)"):
        compile_expression(text)
