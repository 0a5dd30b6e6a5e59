# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of the table of parameters that are about walls in place of struts."""

from __future__ import annotations

from ..walls.library import FORMULA, SURFACES
from .parameter import Need, Parameter

#: Cells of walls; and what is for all other cells.
WALLS = (*SURFACES, FORMULA)
#: What says how thick they are.
SIZES = ("wall_thickness", "wall_offset")
OF_WALLS = Need(("cell",), WALLS)
OF_STRUTS = Need(("cell",), WALLS, absent=True)

WALL = (
    Parameter(
        "wall_kind", "choice", "Walls",
        "sheet: a wall about the surface; skeleton: all where its formula is negative; "
        "complement: all where it is positive",
        default="sheet", choices=("sheet", "skeleton", "complement"), needs=(OF_WALLS,),
        in_panel=True,
    ),
    Parameter(
        "wall_thickness", "length", "Walls",
        "Thickness of a sheet, measured across it",
        default=1.0, needs=(OF_WALLS, Need(("wall_kind",), ("sheet",))), in_panel=True,
        instead_of=("relative_density", "mass"),
    ),
    Parameter(
        "wall_offset", "number", "Walls",
        "By how many mm a skeleton or complement is thicker than up to the surface; negative for "
        "a thinner one",
        default=0.0, needs=(OF_WALLS, Need(("wall_kind",), ("skeleton", "complement"))),
        in_panel=True, instead_of=("relative_density", "mass"),
    ),
    Parameter(
        "wall_formula", "text", "Walls",
        "The surface of the cell Formula: zero on it, of x, y and z, which run from 0 to 2 pi "
        "over a cell",
        needs=(Need(("cell",), (FORMULA,)),), required=True, initial="cos(x) + cos(y) + cos(z)",
        in_panel=True,
    ),
)  # fmt: skip
