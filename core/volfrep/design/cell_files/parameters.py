# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parameters of a cell: numbers with ranges, of which its file's coordinates may be formulas."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass
from typing import Any

from ...util.errors import VolfrepError

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


def read_parameters(data: Any, where: str, taken: Collection[str]) -> tuple[CellParameter, ...]:
    """The parameters of a cell's file: ``{"t": {"usual": 0.2, "least": 0.1, "most": 0.4}}``.

    Args:
        data: of the file.
        where: which that is, in errors.
        taken: names that formulas know anyway.

    Raises:
        VolfrepError: naming what is wrong.
    """
    if not isinstance(data, dict) or len(data) > MOST_PARAMETERS:
        raise VolfrepError(
            f"In the {where}, 'parameters' must be an object of up to {MOST_PARAMETERS} names."
        )
    found = []
    for name, row in data.items():
        if not name.isidentifier() or name in taken:
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
            _finite(row[key], f"parameter '{name}' of the {where}")
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
            has = ", ".join(f"{one.name} ({one.least:g} to {one.most:g})" for one in parameters)
            raise VolfrepError(
                f"The cell '{cell}' has no value '{name}' to choose: "
                + (f"it has {has}." if has else "it has none; leave the cell values out.")
            )
        chosen, one = _finite(value, f"cell value '{name}'"), known[name]
        if not one.least <= chosen <= one.most:
            raise VolfrepError(
                f"The cell value '{name}' must be from {one.least:g} to {one.most:g} for "
                f"'{cell}', not {chosen:g}."
            )
        values[name] = chosen
    return values


def _finite(value: Any, what: str) -> float:
    try:
        result = math.nan if isinstance(value, bool) else float(value)
    except (TypeError, ValueError, OverflowError):
        result = math.nan
    if not math.isfinite(result):
        raise VolfrepError(f"The {what} must be a finite number, not {value!r}.")
    return result
