# SPDX-License-Identifier: LGPL-2.1-or-later
"""Units of length: what files say, what users say, and what cannot be meant."""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import NDArray

from ...util.arguments import check_kind
from ...util.errors import VolfrepError

#: Millimetres in each unit that a file or a user may name.
UNITS = {"um": 1e-3, "mm": 1.0, "cm": 10.0, "m": 1e3, "inch": 25.4, "ft": 304.8}
_OTHER_NAMES = {
    "micron": "um", "microns": "um", "micrometer": "um", "micrometre": "um",
    "millimeter": "mm", "millimetre": "mm", "centimeter": "cm", "centimetre": "cm",
    "meter": "m", "metre": "m", "in": "inch", "foot": "ft", "feet": "ft",
}  # fmt: skip
_HINT = re.compile(rb"\b(?:file[ _]?)?units?\b\s*[=:]\s*[\"'(]?\s*([a-z]+)", re.IGNORECASE)
#: A part larger than this many cells in one direction is not meant so.
MOST_CELLS = 10_000.0


def unit_named(text: str) -> str | None:
    """The key of `UNITS` for a name such as 'Millimeters', or None."""
    name = text.strip().lower()
    for candidate in (name, name.removesuffix("s"), name.removesuffix("es")):
        unit = _OTHER_NAMES.get(candidate, candidate)
        if unit in UNITS:
            return unit
    return None


def unit_hint(text: bytes) -> str | None:
    """The unit that a header or a comment names, as in ``UNITS=mm``; None where it does not."""
    match = _HINT.search(text)
    return None if match is None else unit_named(match[1].decode("ascii"))


def find_unit(name: str) -> str:
    """The key of `UNITS` that a user means.

    Raises:
        VolfrepError: there is no such unit.
    """
    check_kind("unit", name, str, f"one of {', '.join(UNITS)}")
    unit = unit_named(name)
    if unit is None:
        raise VolfrepError(f"There is no unit '{name}': choose one of {', '.join(UNITS)}.")
    return unit


def refuse_scale(box: NDArray[np.float64], cell_size: float, name: str) -> None:
    """Refuse a part that was taken as mm and cannot be meant so for cells of this size.

    Args:
        box: (2, 3) corners of the part's box, mm.
        cell_size: edge of a cell, mm.
        name: of the file.

    Raises:
        VolfrepError: with the box, asking for the unit, where another one makes sense.
    """
    size = np.ptp(box, axis=0)
    largest = float(size.max())
    if cell_size <= largest <= MOST_CELLS * cell_size:
        return
    how = "small" if largest < cell_size else "large"
    # What makes the part two to two hundred cells long is what is meant most often.
    fitting = [u for u, mm in UNITS.items() if 2.0 <= largest * mm / cell_size <= 200.0]
    example = f" (--unit {fitting[0]}?)" if fitting else " (--unit)"
    raise VolfrepError(
        f"'{name}' names no unit, and taken as mm it measures {size_text(size)}, too {how} for "
        f"cells of {cell_size:g} mm: which unit is it in{example}, or what other cell size is "
        "meant?"
    )


def size_text(size: NDArray[np.float64]) -> str:
    """Three lengths for a message."""
    return "{:.4g} x {:.4g} x {:.4g} mm".format(*size)
