# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cells by what they do: those of the catalogue that have a modulus or a density."""

from __future__ import annotations

import numpy as np

from ...design.cells import LIBRARY
from ...design.spec_parts import Grid
from ...design.target import read_direction
from ...mechanics.catalogue import CatalogueCell, catalogue, known_properties
from ...mechanics.materials import SolidMaterial, find_material
from ...mechanics.summary import CellProperties
from ...mechanics.tensor import young
from ...util.arguments import check_kind, three_numbers
from ...util.errors import VolfrepError, brief
from ...util.numbers import number
from ...util.types import Floats

#: Places between a cell's thinnest and thickest struts at which its modulus is looked at.
_PLACES = 49
_AXES = {"x": "1,0,0", "y": "0,1,0", "z": "0,0,1"}


def find_lattices(
    *,
    modulus: float | None = None,
    relative_density: float | None = None,
    direction: str | tuple[float, float, float] = "100",
    material: str | SolidMaterial | None = None,
    cell_size: float = 10.0,
) -> list[CellProperties]:
    """The catalogue's cells that have a modulus or a density, each at the radius that gives it.

    Args:
        modulus: Young's along `direction`, MPa with a material, else in units of the solid's.
        relative_density: of the lattice. With a modulus too, each cell has this density, and those
            whose modulus comes nearest are first.
        direction: of the cell: "x", "y", "z", "100", "110", "111" or three numbers.
        material: as of `properties`.
        cell_size: L, mm.

    Returns:
        The lightest first; with a density alone the stiffest. Cells that cannot have it are left
        out. Poisson's ratio of the solid is taken as 0.3, as everywhere in the catalogue.

    Raises:
        VolfrepError: neither a modulus nor a density is given, or a value makes no sense.

    >>> best = find_lattices(modulus=50, material="PA12")[0]
    >>> round(best.young((1, 0, 0))), best.relative_density < 0.1
    (50, True)
    """
    if modulus is None and relative_density is None:
        raise VolfrepError("Say what the lattice is to have: a modulus or a relative density.")
    for name, value in (("modulus", modulus), ("relative density", relative_density)):
        if value is not None:
            number(name, value, "", positive=True)
    size = Grid(cell_size).size
    solid = find_material(material) if isinstance(material, str) else material
    check_kind("material", solid, (SolidMaterial, type(None)), "a material's name or file")
    way = direction_of(direction)
    found = []
    for name, cell in catalogue().items():
        if relative_density is not None:
            radius = cell.radius_of_density(relative_density, size)
        else:
            assert modulus is not None
            radius = _radius_of_modulus(cell, modulus, way, solid, size)
        if radius is not None:
            made = known_properties(LIBRARY[name], size, radius, solid)
            found += [] if made is None else [made]
    if relative_density is None:
        return sorted(found, key=lambda one: one.relative_density)
    if modulus is None:
        return sorted(found, key=lambda one: -one.young(way))
    return sorted(found, key=lambda one: abs(np.log(max(one.young(way), 1e-300) / modulus)))


def cell_curves(
    direction: str | tuple[float, float, float] = "100",
) -> dict[str, tuple[Floats, Floats]]:
    """What each cell of the catalogue can have, for a chart.

    Args:
        direction: as of `find_lattices`.

    Returns:
        Relative densities and Young's moduli along the direction, over the solid's, by cell.

    Raises:
        VolfrepError: the direction is none.

    >>> densities, moduli = cell_curves("z")["Octet"]
    >>> len(densities) == len(moduli) > 5
    True
    """
    way = np.array(direction_of(direction))
    found = {}
    for name, cell in catalogue().items():
        moduli = np.array([young(cell.tensor(ratio), way) for ratio in cell.ratios])
        found[name] = (cell.values[:, 0], moduli)
    return found


def direction_of(direction: str | tuple[float, float, float]) -> tuple[float, float, float]:
    """Three numbers of what `find_lattices` takes for a direction.

    Raises:
        VolfrepError: it is none.
    """
    word = _AXES.get(direction, direction) if isinstance(direction, str) else direction
    try:
        way = read_direction(word) if isinstance(word, str) else word
    except ValueError as error:
        raise VolfrepError(f"{brief(direction)} is no direction: write 100, 110 or 111.") from error
    return three_numbers("direction", way)


def _radius_of_modulus(
    cell: CatalogueCell,
    modulus: float,
    way: tuple[float, float, float],
    solid: SolidMaterial | None,
    size: float,
) -> float | None:
    """mm; None where the catalogue's radii have smaller or larger moduli only."""
    ratios = np.geomspace(cell.ratios[0], cell.ratios[-1] * (1.0 - 1e-12), _PLACES)
    ratios[0] = cell.ratios[0]
    own = 1.0 if solid is None else solid.young
    moduli = own * np.array([young(cell.tensor(ratio), np.array(way)) for ratio in ratios])
    if not moduli.min() <= modulus <= moduli.max() or moduli.min() <= 0.0:
        return None
    return float(size * np.exp(np.interp(np.log(modulus), np.log(moduli), np.log(ratios))))


def error_along(found: CellProperties) -> float:
    """By how much a modulus along any direction may be off: the largest share of the known ones."""
    return float(max(found.errors[k] / found.values[k] for k in ("E100", "E110", "E111")))
