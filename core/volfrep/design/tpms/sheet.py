# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is made solid beside a surface: a sheet of some thickness, or all of one side of it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from ...util.arguments import check_kind
from ...util.errors import VolfrepError
from ...util.numbers import number

#: A sheet about the surface; or all on the side where its formula is negative, or positive.
SIDES = ("skeleton", "complement")
KINDS = ("sheet", *SIDES)
#: Facets along a cell where the user says nothing. The sheet is at least so many of them thick, as
#: its sides are found to within less; and its facets stray by no more than this part of that.
AUTOMATIC_FACETS = 30
FACETS_ACROSS = 0.25
STRAYING = 0.2
#: Facets of edge e stray by so much of e2 times the curvature at most: of the library's surfaces by
#: 0.15 to 0.3 of it, and by a third of that in the mean.
BOW = 0.2


@dataclass(frozen=True)
class TpmsSheet:
    """What is made solid beside a surface.

    Attributes:
        kind: ``sheet``, ``skeleton`` (all where the surface's formula is negative) or
            ``complement`` (all where it is positive).
        thickness: of a sheet, measured across it, mm.
        offset: by which a skeleton or complement is thicker than up to the surface, measured
            across it; negative for a thinner one, mm.

    >>> TpmsSheet("sheet", 0.8)
    TpmsSheet(kind='sheet', thickness=0.8, offset=0.0)
    """

    kind: str = "sheet"
    thickness: float = 1.0
    offset: float = 0.0

    def __post_init__(self) -> None:
        check_kind("wall_kind", self.kind, str, f"one of {', '.join(KINDS)}")
        if self.kind not in KINDS:
            raise VolfrepError(
                f"There is no kind of wall '{self.kind}': choose one of {', '.join(KINDS)}."
            )
        number("wall thickness", self.thickness, "mm", positive=True)
        number("wall offset", self.offset, "mm", positive=None)

    @property
    def is_sheet(self) -> bool:
        """Whether it is a sheet and not a side."""
        return self.kind == "sheet"

    @property
    def called(self) -> str:
        """How a user calls what says how thick it is."""
        return "wall thickness" if self.is_sheet else "wall offset"

    def as_json(self) -> dict[str, Any]:
        """What counts of it as plain JSON values."""
        size = {"thickness": self.thickness} if self.is_sheet else {"offset": self.offset}
        return {"kind": self.kind, **size}

    def identity(self) -> dict[str, Any]:
        """What counts of it for `util.content.digest_of`."""
        return self.as_json()

    def coarsest(self, cell_size: float, thinnest: float, curvature: float) -> int:
        """Facets along a cell below which a sheet of so many mm would not have its thickness.

        `curvature` is the strongest one of its surface, over L.
        """
        if not self.is_sheet:
            return 8
        across = math.ceil(FACETS_ACROSS * cell_size / thinnest)
        return max(8, across, wanted_facets(cell_size, STRAYING * thinnest, curvature))


def wanted_facets(cell_size: float, deviation: float | None, curvature: float) -> int:
    """Facets along a cell for a deviation in mm; None: as many as the user leaves to us.

    `curvature` is the strongest one, over L.
    """
    if deviation is None:
        return AUTOMATIC_FACETS
    return math.ceil(math.sqrt(BOW * curvature * cell_size / deviation))
