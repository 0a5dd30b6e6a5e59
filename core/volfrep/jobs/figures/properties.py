# SPDX-License-Identifier: LGPL-2.1-or-later
"""What an endless lattice does, of struts or of walls."""

from __future__ import annotations

from collections.abc import Callable

from ...design.cells import UnitCell, find_cell
from ...design.spec_parts import Grid
from ...design.tpms import KINDS, PeriodicSurface, TpmsSheet, find_surface
from ...mechanics.catalogue import known_properties
from ...mechanics.materials import SolidMaterial, find_material
from ...mechanics.summary import CellProperties, cell_properties
from ...util.errors import VolfrepError
from ..tpms.properties import tpms_properties


def lattice_properties(
    cell: str | UnitCell | PeriodicSurface,
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
) -> CellProperties:
    """What the endless lattice of a cell does.

    Args:
        cell: a library cell's name, the path of a cell's file, or the cell; for walls the name of
            a surface, or the surface.
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

    Raises:
        VolfrepError: a value makes no sense, or the cell carries no load.

    >>> found = lattice_properties("Schwarz P", 10, wall_thickness=1, along=16)
    >>> round(found.relative_density, 2), found.stiffness.shape
    (0.23, (6, 6))
    """
    surface = find_surface(cell, wall_formula) if isinstance(cell, str) else None
    surface = cell if isinstance(cell, PeriodicSurface) else surface
    sizes = {
        "strut radius": strut_radius, "wall thickness": wall_thickness, "wall offset": wall_offset,
        "relative density": relative_density,
    }  # fmt: skip
    given = [name for name, value in sizes.items() if value is not None]
    if surface is None:
        if given not in (["strut radius"], ["relative density"]) or wall_kind or wall_formula:
            raise VolfrepError("Of struts give either a strut radius or a relative density.")
        assert not isinstance(cell, PeriodicSurface)
        if cell_values:
            if not isinstance(cell, str):
                raise VolfrepError("Values are for a cell that is given by its name or file.")
            cell = find_cell(cell, cell_values)
        if strut_radius is not None and not (exact or fillet or along):
            solid = find_material(material) if isinstance(material, str) else material
            named = find_cell(cell) if isinstance(cell, str) else cell
            if (known := known_properties(named, cell_size, strut_radius, solid)) is not None:
                return known
        return cell_properties(
            cell, cell_size, strut_radius, relative_density=relative_density, fillet=fillet,
            material=material, along=along, told=told,
        )  # fmt: skip
    if cell_values:
        raise VolfrepError("Surfaces have no values of their own: they are for cells of struts.")
    kind = wall_kind or KINDS[0]
    wall = TpmsSheet(
        kind,
        1.0 if wall_thickness is None else wall_thickness,
        0.0 if wall_offset is None else wall_offset,
    )
    if given not in ([wall.called], ["relative density"]) or fillet:
        raise VolfrepError(f"Of a {kind} give the {wall.called} or the relative density alone.")
    solid = find_material(material) if isinstance(material, str) else material
    return tpms_properties(
        surface, Grid(cell_size).size, wall, relative_density=relative_density, material=solid,
        along=along,
    )  # fmt: skip
