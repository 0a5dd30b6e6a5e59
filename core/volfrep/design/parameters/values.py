# SPDX-License-Identifier: LGPL-2.1-or-later
"""Values of parameters: read from an option's text or a file's entry, with or without a unit."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...util.errors import VolfrepError, listed
from .parameter import REPEATED, SHAPES, Parameter

if TYPE_CHECKING:
    from ..grading import Field

#: So many of the table's unit is one of these.
SCALES: dict[str, dict[str, float]] = {
    "length": {"mm": 1.0, "um": 1e-3, "cm": 10.0, "m": 1e3, "in": 25.4, "ft": 304.8},
    "angle": {"degrees": 1.0, "deg": 1.0, "rad": math.degrees(1.0)},
    "mass": {"g": 1.0, "kg": 1e3, "mg": 1e-3},
    "density": {"g/cm3": 1.0, "kg/m3": 1e-3, "g/cm^3": 1.0, "kg/m^3": 1e-3},
}
#: How many numbers a list may have, and an example.
LENGTHS: dict[str, tuple[tuple[int, ...], str]] = {
    "direction": ((3,), "0,0,1"),
    "point": ((3,), "-5,0,0"),
    "rotation": ((4,), "0,0,1,30"),
    "planes": ((6,), "0,0,10,0,0,1"),
    "places": ((3, 6), "0,0,10"),
    "thick_faces": ((4, 7), "0,0,10,3"),
    "solids": ((4, 7), "0,0,10,3"),
}
#: Other words for a choice.
ALIASES = {"expression": "formula", "polynomial": "quadratic"}
_QUANTITY = re.compile(
    r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+]?(?:nan|inf))\s*(.*?)\s*"
)


def from_text(parameter: Parameter, text: str) -> Any:
    """The value that an option's text stands for.

    Raises:
        VolfrepError: it is none; the sentence says what one looks like, and names nothing.
    """
    kind = parameter.kind
    if kind == "solids" and _is_named(text):
        return text
    if kind in LENGTHS:
        return _numbers(parameter, text.split(","))
    if kind == "flag":
        raise VolfrepError("It takes no value.")
    if kind in ("integer", "number") or kind in SCALES:
        return _quantity(parameter, text)
    return _word(parameter, text)


def value_from_json(parameter: Parameter, value: Any) -> Any:
    """The value that an entry of a file stands for: a number, text, truth or list of these.

    Raises:
        VolfrepError: it is none; the sentence says what one looks like, and names nothing.
    """
    kind = parameter.kind
    if kind in REPEATED:
        either = (list, str) if kind == "solids" else list
        if not isinstance(value, list) or not all(isinstance(item, either) for item in value):
            raise VolfrepError(f"{value!r} is no list of lists such as {_example(parameter)}.")
        return tuple(item if isinstance(item, str) else _numbers(parameter, item) for item in value)
    if kind in LENGTHS:
        if isinstance(value, str) and "," in value:  # as an option has it
            value = value.split(",")
        if not isinstance(value, list):
            raise VolfrepError(f"{value!r} is no list such as {_example(parameter)}.")
        return _numbers(parameter, value)
    if kind == "flag":
        if not isinstance(value, bool):
            raise VolfrepError(f"{value!r} is neither true nor false.")
        return value
    if isinstance(value, bool) or not isinstance(value, (str, int, float)):
        raise VolfrepError(f"{value!r} is no {_kind_text(parameter)}.")
    if kind in ("integer", "number") or kind in SCALES:
        return _quantity(parameter, value)
    if not isinstance(value, str):
        raise VolfrepError(f"{value!r} is no text: put it between quotation marks.")
    return _word(parameter, value)


def value_to_json(parameter: Parameter, value: Any) -> Any:
    """What `value_from_json` makes the value of."""
    if parameter.kind in REPEATED:
        return [
            item if isinstance(item, str) else [float(number) for number in item] for item in value
        ]
    if parameter.kind in LENGTHS:
        return [float(number) for number in value]
    if parameter.kind == "number" or parameter.kind in SCALES:
        return float(value)
    return value


def option_type(parameter: Parameter) -> Callable[[str], Any]:
    """`from_text` of a parameter, with the errors that argparse expects of a type."""
    from argparse import ArgumentTypeError

    def read(text: str) -> Any:
        try:
            return from_text(parameter, text)
        except VolfrepError as error:
            raise ArgumentTypeError(str(error).rstrip(".")) from error

    return read


def _quantity(parameter: Parameter, value: Any) -> float | int:
    """A number, with a unit where the kind has units; whole where it is one."""
    kind, unit = parameter.kind, ""
    number: float = math.nan
    if isinstance(value, str):
        match = _QUANTITY.fullmatch(value)
        if match is None:
            raise VolfrepError(f"'{value}' is no {_kind_text(parameter)}.")
        number, unit = float(match[1]), match[2]
    else:
        try:
            number = float(value)
        except OverflowError as error:  # of a whole number
            raise VolfrepError("It is too large a number.") from error
    scales = SCALES.get(kind, {})
    if unit and unit not in scales:
        known = f"use {', '.join(scales)}" if scales else "it is a plain number"
        raise VolfrepError(f"'{value}' has the unit '{unit}', which is no unit of it: {known}.")
    if kind != "integer":
        return number * scales.get(unit, 1.0)
    if not math.isfinite(number) or number != int(number):
        raise VolfrepError(f"'{value}' is no whole number.")
    return int(number)


def _numbers(parameter: Parameter, items: list[Any]) -> tuple[float, ...]:
    lengths, example = LENGTHS[parameter.kind]
    shape = SHAPES[parameter.kind]
    try:
        if any(isinstance(item, bool) for item in items):
            raise ValueError
        numbers = tuple(float(item) for item in items)
    except (TypeError, ValueError, OverflowError) as error:
        text = ",".join(str(item) for item in items)
        raise VolfrepError(
            f"'{text}' is not numbers with commas, {shape}, as {example}."
        ) from error
    if len(numbers) not in lengths:
        wanted = listed([str(length) for length in lengths])
        raise VolfrepError(
            f"It takes {wanted} numbers with commas between them and no blanks, {shape}, such as "
            f"{example}, not {len(numbers)}."
        )
    return numbers


def _word(parameter: Parameter, text: str) -> str:
    if not parameter.choices:
        return text
    word = ALIASES.get(text.lower(), text.lower())
    if word not in parameter.choices:
        near = get_close_matches(word, parameter.choices, 1)
        hint = f"did you mean '{near[0]}'? There are" if near else "choose"
        raise VolfrepError(f"There is no '{text}': {hint} {', '.join(parameter.choices)}.")
    return word


def _kind_text(parameter: Parameter) -> str:
    """A kind with its article left out, and an example."""
    if parameter.kind in SCALES:
        return f"{parameter.kind} such as 10 or '10 {parameter.unit}'"
    return {"integer": "whole number", "number": "number"}.get(parameter.kind, "text")


def _example(parameter: Parameter) -> str:
    example = f"[{LENGTHS[parameter.kind][1].replace(',', ', ')}]"
    return f"[{example}]" if parameter.kind in REPEATED else example


def _is_named(text: str) -> bool:
    """Whether a text names a file, and no list of numbers."""
    return any(letter.isalpha() for letter in text.replace("e", "").replace("E", ""))


def is_file(source: str) -> bool:
    """Whether there is a file of that name."""
    return Path(source).is_file()


def field_file(field: Field, what: str) -> str:
    """The file that a field is from; `what` says in an error what follows it.

    Raises:
        VolfrepError: it is from none.
    """
    if not field.source or not is_file(field.source):
        raise VolfrepError(
            f"The field that {what} has no file that could be named: save it as a table of points "
            "and values first."
        )
    return field.source
