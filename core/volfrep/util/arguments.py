# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a script gives, looked at where it comes in: a wrong kind of value is one sentence."""

from __future__ import annotations

import os
from typing import Any

from .errors import VolfrepError, brief


def check_kind(name: str, value: object, kinds: type | tuple[type, ...], what: str) -> None:
    """Refuse a value that is of none of the kinds.

    Args:
        name: the parameter's.
        value: what was given.
        kinds: classes.
        what: these in words, such as "a text".

    Raises:
        VolfrepError: naming the parameter, what it takes and what was given.
    """
    if not isinstance(value, kinds):
        raise VolfrepError(f"'{name}' is {what}, not {brief(value)}.")


def check_path(name: str, value: object) -> None:
    """Refuse what is no path of a file or a folder.

    Raises:
        VolfrepError: naming the parameter.
    """
    check_kind(name, value, (str, os.PathLike), "a path")


def three_numbers(name: str, value: Any) -> tuple[float, float, float]:
    """Three numbers of a sequence or an array.

    Raises:
        VolfrepError: it is none.
    """
    try:
        x, y, z = (float(number) for number in value)
    except (TypeError, ValueError, OverflowError) as error:
        raise VolfrepError(f"The {name} is three numbers, not {brief(value)}.") from error
    return x, y, z
