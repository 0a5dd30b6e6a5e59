# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameters of a cell: numbers with ranges, of which its file's coordinates may be formulas."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...util.errors import VolfrepError
from ...util.numbers import number
from ..expression import CONSTANTS, FUNCTIONS, compile_expression

MOST_PARAMETERS = 12


@dataclass(frozen=True)
class CellParameter:
    """A number that a user may choose for a cell.

    Attributes:
        name: in its formulas.
        usual: where nothing is chosen.
        least, most: that may be chosen.
        about: what it is, in a few words.
    """

    name: str
    usual: float
    least: float
    most: float
    about: str = ""


def read_parameters(data: Any, where: str) -> tuple[CellParameter, ...]:
    """The parameters of a cell's file: ``{"t": {"usual": 0.2, "least": 0.1, "most": 0.4}}``.

    Raises:
        VolfrepError: naming what is wrong; `where` says in which file.
    """
    if not isinstance(data, dict) or len(data) > MOST_PARAMETERS:
        raise VolfrepError(
            f"In the {where}, 'parameters' must be an object of up to {MOST_PARAMETERS} names."
        )
    found = []
    for name, row in data.items():
        if not name.isidentifier() or name in FUNCTIONS or name in CONSTANTS:
            raise VolfrepError(
                f"In the {where}, the parameter '{name}' must have another name: letters and "
                "digits, and none that formulas know."
            )
        if not isinstance(row, dict) or not {"usual", "least", "most"} <= row.keys():
            raise VolfrepError(
                f"In the {where}, the parameter '{name}' must be an object with 'usual', 'least' "
                "and 'most'."
            )
        usual, least, most = (
            number(f"parameter '{name}' of the {where}", row[key], "degrees", positive=None)
            for key in ("usual", "least", "most")
        )
        if not least <= usual <= most:
            raise VolfrepError(
                f"In the {where}, the parameter '{name}' is {usual:g}, not from {least:g} to "
                f"{most:g}."
            )
        found.append(CellParameter(name, usual, least, most, str(row.get("about", ""))))
    return tuple(found)


def chosen_values(parameters: tuple[CellParameter, ...], text: str, cell: str) -> dict[str, float]:
    """The value of each parameter, after a text such as ``angle = 60, t = 0.2``.

    Args:
        parameters: that there are.
        text: the chosen ones; the others have their usual values.
        cell: what it is called in errors.

    Raises:
        VolfrepError: the text cannot be read, or names what there is not.

    >>> chosen_values((CellParameter("t", 0.2, 0.1, 0.4),), "t = 0.3", "mine")
    {'t': 0.3}
    """
    values = {one.name: one.usual for one in parameters}
    known = {one.name: one for one in parameters}
    for part in filter(None, (part.strip() for part in text.split(","))):
        name, equals, value = (word.strip() for word in part.partition("="))
        if not equals:
            raise VolfrepError(
                f"The cell values '{text}' must be like 'name = number, name = number'."
            )
        if name not in known:
            told = ", ".join(f"{one.name} ({one.least:g} to {one.most:g})" for one in parameters)
            raise VolfrepError(
                f"The cell '{cell}' has no value '{name}' to choose: "
                + (f"it has {told}." if told else "it has none; leave the cell values out.")
            )
        chosen, one = number(f"cell value '{name}'", value, "degrees", positive=None), known[name]
        if not one.least <= chosen <= one.most:
            raise VolfrepError(
                f"The cell value '{name}' must be from {one.least:g} to {one.most:g} for "
                f"'{cell}', not {chosen:g}."
            )
        values[name] = chosen
    return values


def with_values(data: Any, values: Mapping[str, float], where: str) -> Any:
    """Lists of numbers and formulas with the numbers that the formulas come to.

    Args:
        data: of a file: numbers, texts, and lists of them.
        values: of the parameters.
        where: the file, in errors.

    Raises:
        VolfrepError: a formula cannot be read, or has no value.
    """
    if not values:
        return data
    if isinstance(data, list):
        return [with_values(item, values, where) for item in data]
    if not isinstance(data, str):
        return data
    try:
        result = float(compile_expression(data, tuple(values))(*values.values()))
    except VolfrepError as error:
        raise VolfrepError(f"In the {where}: {error}") from error
    if not np.isfinite(result):
        raise VolfrepError(f"In the {where}, the formula '{data}' has no value.")
    return result
