# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the endless wall does: homogenised as the lattices of struts are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ...design.tpms import PeriodicSurface, TpmsSheet
from ...mechanics.homogenise import PER_RADIUS, Homogenised, bounded, homogenise_voxels, three_sizes
from ...mechanics.materials import SolidMaterial
from ...mechanics.summary import POISSON, CellProperties, figures_of
from ...mechanics.voxels import Voxels
from ...tpms.solid import TpmsSolid
from ...util.errors import VolfrepError
from .symmetry import is_cubic, is_mirror_symmetric
from .voxels import cut_into_voxels, of_density, tpms_density

#: Voxels along L for a side of a surface, whose branches are about a third of it thick.
_OF_SIDES = 96


@dataclass(frozen=True, eq=False, repr=False)
class TpmsProperties(CellProperties):
    """What an endless lattice of walls does.

    Attributes:
        sheet: what is solid beside the surface.
    """

    sheet: TpmsSheet

    def _size(self) -> dict[str, Any]:
        kind, *sizes = self.sheet.as_json().items()
        return {"wall_kind": kind[1], **{f"wall_{name}_mm": value for name, value in sizes}}

    def _sized(self) -> str:
        sheet = self.sheet
        if sheet.is_sheet:
            return f"{sheet.kind} {sheet.thickness:.5g} mm thick"
        return f"{sheet.kind}, offset {sheet.offset:.5g} mm"


def tpms_properties(
    surface: PeriodicSurface,
    cell_size: float,
    sheet: TpmsSheet,
    *,
    relative_density: float | None = None,
    material: SolidMaterial | None = None,
    along: int | None = None,
) -> TpmsProperties:
    """What the endless wall along a surface does.

    Args:
        surface: where it goes along.
        cell_size: L, mm.
        sheet: what is solid beside the surface.
        relative_density: in place of the wall's thickness or offset, which is then found.
        material: the solid; None: figures in units of the solid's.
        along: voxels along L of the finest of three grids; None for what the thickness asks for.

    Raises:
        VolfrepError: no wall has that density, or it carries no load.
    """
    poisson = POISSON if material is None else material.poisson
    solid = TpmsSolid.of(surface, sheet, cell_size)
    octant = is_mirror_symmetric(solid)
    if relative_density is not None:
        solid = of_density(solid, relative_density, octant=octant)
        level = cell_size * solid.level
        thick = {"thickness": 2.0 * level} if sheet.is_sheet else {"offset": level}
        sheet = TpmsSheet(sheet.kind, **thick)
    density, error = tpms_density(solid, octant=octant)
    if density >= 1.0:
        raise VolfrepError(
            f"The wall of {surface.name} fills its cell, so that it does what the solid does: take "
            "a thinner one, or larger cells."
        )
    found = homogenise_tpms(solid, density, poisson, octant=octant, along=along, name=surface.name)
    result = figures_of(found, material)
    result.errors["relative_density"] = error
    return TpmsProperties(
        surface.name, cell_size, 0.0, 0.0, density, material, result.stiffness, result.values,
        result.errors, result.von_mises, found.along[-1], sheet,
    )  # fmt: skip


def homogenise_tpms(
    solid: TpmsSolid,
    density: float,
    poisson: float,
    *,
    octant: bool,
    along: int | None = None,
    name: str = "",
) -> Homogenised:
    """The elastic tensor of a wall, extrapolated from three grids.

    Args:
        solid: the wall, in units of L.
        density: its exact relative density, which every grid is filled to.
        poisson: the solid's ratio.
        octant: whether it equals its mirror images (`symmetry.is_mirror_symmetric`).
        along: voxels along L on the finest grid; None for as many as the thickness asks for.
        name: of the surface, for the sentences.

    Raises:
        VolfrepError: the solid is not connected.
    """
    if along is None:
        along = usual_along(solid, density, octant=octant)

    def voxels(size: int) -> Voxels:
        return cut_into_voxels(solid, size, octant=octant, density=density)

    return homogenise_voxels(voxels, three_sizes(along), poisson, cubic=is_cubic(solid), name=name)


def usual_along(solid: TpmsSolid, density: float, *, octant: bool, fineness: float = 1.0) -> int:
    """Voxels along L that a wall's thickness asks for.

    Args:
        solid: the wall, in units of L.
        density: its relative density.
        octant: whether only an octant is cut into voxels.
        fineness: how many times as many.
    """
    # A sheet's half thickness is what a radius is to a strut.
    wanted = PER_RADIUS[octant] / solid.level if solid.kind == "sheet" else _OF_SIDES
    return bounded(fineness * min(wanted, bounded(wanted, density, octant)), density, octant)
