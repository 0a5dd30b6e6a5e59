# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an endless lattice does, of struts or a TPMS."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ...design.cells import UnitCell, any_cell
from ...design.drawn_cell import DrawnCell
from ...design.parameters.keywords import as_cell
from ...design.spec_parts import Grid
from ...design.tpms import PeriodicSurface
from ...mechanics.materials import SolidMaterial, find_material
from ...mechanics.summary import CellProperties
from ...util.arguments import check_kind
from ...util.errors import VolfrepError
from ..kinds import kind_of_cell
from ..kinds.kind import EndlessRequest


def lattice_properties(
    cell: str | UnitCell | DrawnCell | PeriodicSurface | Mapping[str, Any],
    cell_size: float,
    strut_radius: float | None = None,
    *,
    relative_density: float | None = None,
    fillet: float = 0.0,
    material: str | SolidMaterial | None = None,
    along: int | None = None,
    cell_values: str = "",
    wall_kind: str | None = None,
    wall_thickness: float | None = None,
    wall_offset: float | None = None,
    wall_formula: str = "",
    exact: bool = False,
    told: Callable[[float], None] = lambda seconds: None,
    as_printed: str | None = None,
    build_direction: tuple[float, float, float] = (0.0, 0.0, 1.0),
    note: Callable[[str], None] = lambda sentence: None,
) -> CellProperties:
    """What the endless lattice of a cell does.

    Args:
        cell: a library cell's name, the path of a cell's file, or the cell, as of `fill`; for
            walls the name of a surface, or the surface.
        cell_size: L, mm.
        strut_radius: r, mm; or give `relative_density`.
        relative_density: in place of radius, thickness or offset, which is then found.
        fillet: radius of the round between struts, mm.
        material: the solid, by name, file or itself; None: figures in units of the solid's.
        along: voxels along L of the finest of three grids; None for what the radius asks for.
        cell_values: of a named cell's parameters, such as ``t = 0.3``; empty for the usual ones.
        wall_kind: of walls: ``sheet`` (as without it), ``skeleton`` or ``complement``.
        wall_thickness: of a sheet, mm.
        wall_offset: of a skeleton or complement, mm.
        wall_formula: of the cell ``Formula``.
        exact: homogenise also what the catalogue knows, which it tells at once.
        told: of struts, given how many seconds are left, about, as soon as that is known.
        as_printed: table of printed diameters, as of `fill`: the properties are then those of
            struts of the one radius that takes the volume of all that come out.
        build_direction: from the build plate up, in the cell's axes.
        note: given a sentence on what comes out.

    Raises:
        VolfrepError: a value makes no sense, or the cell carries no load.

    >>> found = lattice_properties("Schwarz P", 10, wall_thickness=1, along=16)
    >>> round(found.relative_density, 2), found.stiffness.shape
    (0.23, (6, 6))
    """
    check_kind("cell_values", cell_values, str, "a text such as 't = 0.3'")
    check_kind("wall_formula", wall_formula, str, "a formula such as 'cos(x) + cos(y) + cos(z)'")
    given = as_cell(cell)
    if isinstance(given, str):
        given = any_cell(given, cell_values, wall_formula)
    elif cell_values:
        raise VolfrepError("Values are for a cell that is given by its name or file.")
    kinds = (SolidMaterial, type(None))
    solid = find_material(material) if isinstance(material, str) else material
    check_kind("material", solid, kinds, "a material's name or file")
    request = EndlessRequest(
        strut_radius, relative_density, fillet, solid, along, cell_values, wall_kind,
        wall_thickness, wall_offset, wall_formula, exact, told, as_printed, build_direction, note,
    )  # fmt: skip
    return kind_of_cell(given).properties(given, Grid(cell_size).size, request)
