# SPDX-License-Identifier: LGPL-2.1-or-later
"""A user's numbers, checked: finite, in a range that makes sense, named where they are not."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from numbers import Real
from typing import TYPE_CHECKING, Any

from .errors import VolfrepError, brief

if TYPE_CHECKING:
    from .types import Floats, Ints

#: The least and the most that a number of each unit may be. Files hold single precision: what lies
#: farther than a kilometre from the origin would be known to a tenth of a millimetre.
RANGES = {
    "mm": (1e-9, 1e6),
    "degrees": (1e-9, 1e6),
    "g/cm3": (1e-6, 1e3),
    "MPa": (1e-6, 1e9),
    "g": (1e-9, 1e12),
    "": (1e-6, 1e6),
}


def number(name: str, value: float, unit: str, *, positive: bool | None) -> float:
    """`value` as a finite float; `positive` True: above 0, False: not below 0, None: any.

    Raises:
        VolfrepError: it is none, or out of the unit's range (`RANGES`); the text begins with the
            name.
    """
    of, within = (f" {unit}", f" in {unit}") if unit else ("", "")
    try:
        result = float(value)
    except (TypeError, ValueError) as error:
        raise VolfrepError(f"The {name} must be a number{within}, not {brief(value)}.") from error
    except OverflowError:  # a whole number
        result = math.inf
    if not math.isfinite(result):
        raise VolfrepError(f"The {name} must be a finite number{within}, not {result}.")
    if positive and result <= 0:
        raise VolfrepError(f"The {name} must be above 0{of}, not {result:g}.")
    if positive is False and result < 0:
        raise VolfrepError(f"The {name} must not be negative, not {result:g}{of}.")
    least, most = RANGES.get(unit, (0.0, math.inf))
    if positive is None:
        if abs(result) > most:
            raise VolfrepError(
                f"The {name} must be from {-most:g} to {most:g}{of}, not {result:g}."
            )
    elif result and not least <= result <= most:
        nothing = "" if positive else "0 or "
        raise VolfrepError(
            f"The {name} must be {nothing}from {least:g} to {most:g}{of}, not {result:g}."
        )
    return result


def whole(name: str, value: Any, least: int, most: int) -> int:
    """`value` as a whole number of a range.

    Raises:
        VolfrepError: it is none; the text begins with the name.
    """
    if not isinstance(value, Real) and getattr(value, "shape", None) != ():
        raise VolfrepError(
            f"The {name} must be a whole number from {least} to {most}, not {brief(value)}."
        )
    if not least <= value <= most or value != int(value):
        text = f"{value:.6g}" if abs(value) < 1e300 else "beyond 1e300"
        raise VolfrepError(f"The {name} must be a whole number from {least} to {most}, not {text}.")
    return int(value)


def point(name: str, values: Sequence[float]) -> None:
    """Raise a `VolfrepError` where three numbers are no place, in mm."""
    if not hasattr(values, "__len__") or len(values) != 3:
        raise VolfrepError(f"The {name} must be three coordinates, not {brief(values)}.")
    for value in values:
        number(name, value, "mm", positive=None)


def direction(name: str, values: Sequence[float]) -> None:
    """Raise a `VolfrepError` where three numbers have no direction; their length is free.

    So it is within a range: beyond that, products of them would be lost.
    """
    least, most = RANGES[""]
    is_three = hasattr(values, "__len__") and len(values) == 3
    try:
        length = math.hypot(*values) if is_three else math.nan
    except TypeError:
        length = math.nan
    if not math.isfinite(length):
        raise VolfrepError(f"The {name} must be three finite numbers.")
    if not any(values):
        raise VolfrepError(f"The {name} must not be zero.")
    if not least <= length <= most:
        raise VolfrepError(
            f"The {name} must have a length from {least:g} to {most:g}, not {length:g}."
        )


def number_rows(
    value: object, width: int, noun: str, where: str, most: int | None = None
) -> Floats:
    """(n, width) finite numbers of a table that a file or a user gives.

    Args:
        value: the rows.
        width: numbers in each.
        noun: what a row is, such as "node".
        where: what the table belongs to.
        most: rows that there may be.

    Raises:
        VolfrepError: it is none, has no rows, or too many.
    """
    import numpy as np  # the table of parameters is read without it

    try:
        rows = np.array(value, float)
    except (TypeError, ValueError, OverflowError) as error:
        raise VolfrepError(
            f"In the {where}, every {noun} must be a list of {width} numbers."
        ) from error
    if rows.ndim != 2 or rows.shape[1] != width or not len(rows):
        raise VolfrepError(f"In the {where}, every {noun} must be a list of {width} numbers.")
    if most is not None and len(rows) > most:
        raise VolfrepError(f"The {where} has {len(rows)} {noun}s: the limit is {most}.")
    if not np.isfinite(rows).all():
        raise VolfrepError(f"In the {where}, a {noun} holds a number that is not finite.")
    return rows


def strut_rows(pairs: Floats, nodes: int, where: str) -> Ints:
    """(m, 2) numbers of nodes from 0, of (m, 2) that a file or a user gives.

    Raises:
        VolfrepError: naming the first strut that has none of the nodes.
    """
    import numpy as np  # as above

    with np.errstate(invalid="ignore"):  # a number too large for an index is none of the nodes
        index: Ints = pairs.astype(np.int64)
    bad = np.flatnonzero(((index != pairs) | (index < 0) | (index >= nodes)).any(axis=1))
    if len(bad):
        raise VolfrepError(
            f"In the {where}, strut {bad[0]} must name two nodes by whole numbers from 0 to "
            f"{nodes - 1}."
        )
    return index


def round_off(value: float) -> str:
    """Two significant figures, written out."""
    return f"{float(f'{value:.2g}'):,.15g}"


def duration(seconds: float) -> str:
    """A time in s, min or h, to two figures."""
    if seconds < 90.0:
        return f"{round_off(max(1.0, seconds))} s"
    if seconds < 5400.0:
        return f"{round_off(seconds / 60.0)} min"
    return f"{round_off(seconds / 3600.0)} h"


def place_text(point: Iterable[float]) -> str:
    """A point for a message."""
    return "({:.4g}, {:.4g}, {:.4g})".format(*point)


def plural(count: int, one: str, many: str = "") -> str:
    """The count with its noun, as in '1 hole' and '2 holes'."""
    return f"{count:,} {one if count == 1 else many or one + 's'}"


def round_values(low: float, high: float, lines: int) -> list[float]:
    """About so many multiples of 1, 2 or 5 times a power of ten from one number to a larger one."""
    step = (high - low) / lines
    decade = 10.0 ** math.floor(math.log10(step))
    step = min((m * decade for m in (1.0, 2.0, 5.0, 10.0)), key=lambda s: abs(s - step))
    return [k * step for k in range(math.ceil(low / step), math.floor(high / step) + 1)]
