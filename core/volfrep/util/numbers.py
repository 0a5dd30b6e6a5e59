# SPDX-License-Identifier: LGPL-2.1-or-later
"""A user's numbers, checked: finite, positive, and named in the sentence where they are not."""

from __future__ import annotations

import math

from .errors import VolfrepError


def number(name: str, value: float, unit: str, *, positive: bool | None) -> float:
    """`value` as a finite float; `positive` True: above 0, False: not below 0, None: any.

    Raises:
        VolfrepError: it is none; the text begins with the name.
    """
    try:
        result = float(value)
    except (TypeError, ValueError) as error:
        raise VolfrepError(f"The {name} must be a number in {unit}, not {value!r}.") from error
    if not math.isfinite(result):
        raise VolfrepError(f"The {name} must be a finite number in {unit}, not {result}.")
    if positive and result <= 0:
        raise VolfrepError(f"The {name} must be above 0 {unit}, not {result:g}.")
    if positive is False and result < 0:
        raise VolfrepError(f"The {name} must not be negative, not {result:g} {unit}.")
    return result
