# SPDX-License-Identifier: LGPL-2.1-or-later
"""All that a cell's lattice does, for people and for programs."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ..design.cells import UnitCell, find_cell
from ..design.kinds.strut_cells import MOST_CROSSING, crossing_struts
from ..design.spec_parts import Grid, Struts
from ..util.arguments import three_numbers
from ..util.errors import VolfrepError
from ..util.packages import make_frame
from ..util.showing import Shown
from ..util.types import Floats
from .conductance import conductance
from .density import radius_of_density, relative_density
from .homogenise import Homogenised, homogenise
from .materials import SolidMaterial, find_material
from .strength import STRESSES, stresses
from .tensor import moduli, young

if TYPE_CHECKING:
    import pandas

#: Poisson's ratio of the solid where no material is given.
POISSON = 0.3
#: The moduli of a summary, in the order they are told.
MODULI = ("E100", "E110", "E111", "G", "bulk")
RATIOS = ("nu", "zener")
#: What moduli and ratios are called in tables for people; others by their names.
CALLED = {"E100": "E along [100]", "E110": "E along [110]", "E111": "E along [111]",
          "G": "shear modulus", "bulk": "bulk modulus", "nu": "Poisson's ratio",
          "zener": "Zener anisotropy"}  # fmt: skip
#: Entries of a stiffness that differ by less than this part of the largest are alike.
_CUBIC = 1e-3
#: A modulus below this part of the largest stiffness is that of what carries nothing.
_CARRIES = 1e-6
#: Cells of more struts are refused: all copies near each body are looked at together.
MOST_STRUTS = 500
_NOTHING = "0: it carries nothing that way"


@dataclass(frozen=True, eq=False, repr=False)
class CellProperties(Shown):
    """The properties of the endless lattice of a cell, each with its error.

    Moduli and stresses are in units of the solid's Young's modulus and yield stress, or in MPa
    where a material was given. Tensors are in Voigt's order (xx, yy, zz, yz, xz, xy) with
    engineering shear strains.

    Attributes:
        cell: its name, or its surface's.
        cell_size: L, mm.
        strut_radius: r, mm; 0 of walls.
        fillet: mm.
        relative_density: solid volume over the cell's.
        material: the solid; None for one with E = 1 and nu = `POISSON`.
        stiffness: (6, 6).
        values: E100, E110, E111, G, bulk, nu, zener; strength: the least macroscopic stress along
            x, y or z at which the solid yields (all but a hundredth of it stays below);
            shear_strength: likewise in the planes of the faces; conductivity: mean, over the
            solid's.
        errors: by how much each may be off, by the same names, and relative_density and stiffness.
        von_mises: the solid's stress per unit of each macroscopic stress, by its name.
        along: voxels along L of the finest grid; 0 where the catalogue was read.

    >>> import volfrep
    >>> found = volfrep.properties("Octet", 10, 0.5)
    >>> found.cell, round(found.relative_density, 3), found.stiffness.shape
    ('Octet', 0.114, (6, 6))
    """

    cell: str
    cell_size: float
    strut_radius: float
    fillet: float
    relative_density: float
    material: SolidMaterial | None
    stiffness: Floats
    values: dict[str, float]
    errors: dict[str, Any]
    von_mises: dict[str, float]
    along: int

    def young(self, direction: ArrayLike) -> float:
        """Young's modulus along a direction, such as (1, 2, 0), in the unit of the moduli.

        Raises:
            VolfrepError: it is no direction.

        >>> import volfrep
        >>> octet = volfrep.properties("Octet", 10, 0.5)
        >>> round(octet.young((1, 1, 1)) / octet.values["E111"], 6)
        1.0
        """
        way = np.array(three_numbers("direction", direction))
        if not 0.0 < np.linalg.norm(way) < np.inf:
            raise VolfrepError(f"A direction is three numbers, not all 0, not {direction!r}.")
        return float(young(self.stiffness, way))

    def to_frame(self) -> pandas.DataFrame:
        """A row for each figure, by its name: its value and its error; needs pandas.

        Raises:
            VolfrepError: pandas is missing.

        >>> import volfrep
        >>> volfrep.properties("Octet", 10, 0.5).to_frame().loc["E100", "value"]  # doctest: +SKIP
        0.0173
        """
        values = {"relative_density": self.relative_density, **self.values}
        columns = {"value": list(values.values()), "error": [self.errors[n] for n in values]}
        return make_frame(columns, list(values))

    def as_dict(self) -> dict[str, Any]:
        """The figures as plain JSON values; the errors under ``errors``, by the same names.

        >>> import volfrep
        >>> volfrep.properties("Octet", 10, 0.5).as_dict()["unit"]
        "the solid's Young's modulus"
        """
        solid = self.material
        return {
            "cell": self.cell,
            "cell_size_mm": self.cell_size,
            **self._size(),
            "relative_density": self.relative_density,
            "material": None if solid is None else solid.as_dict(),
            "unit": "the solid's Young's modulus" if solid is None else "MPa",
            "strength_unit": "the solid's yield stress"
            if solid is None or solid.yield_stress is None
            else "MPa",
            "poisson_of_solid": POISSON if solid is None else solid.poisson,
            "stiffness": self.stiffness.tolist(),
            **self.values,
            "von_mises": {
                name: value if np.isfinite(value) else None
                for name, value in self.von_mises.items()
            },
            "density_g_per_cm3": None if solid is None else self.relative_density * solid.density,
            "voxels_along_cell": self.along,
            "errors": {
                name: value.tolist() if isinstance(value, np.ndarray) else value
                for name, value in self.errors.items()
            },
        }

    def _size(self) -> dict[str, Any]:
        """What says how thick it is."""
        return {"strut_radius_mm": self.strut_radius, "fillet_mm": self.fillet}

    def _sized(self) -> str:
        return f"r = {self.strut_radius:.5g} mm"

    def rows(self) -> list[tuple[str, str]]:
        """Names and values, for people.

        >>> import volfrep
        >>> volfrep.properties("Octet", 10, 0.5).rows()[0]
        ('cell', 'Octet, L = 10 mm, r = 0.5 mm')
        """
        solid = self.material
        unit = "E of the solid" if solid is None else "MPa"
        share = self.errors["relative_density"]
        rows = [
            ("cell", f"{self.cell}, L = {self.cell_size:g} mm, {self._sized()}"),
            ("relative density", f"{100 * self.relative_density:.3f} +- {100 * share:.3f} %"),
        ]
        if solid is not None:
            density = self.relative_density * solid.density
            rows.append(("material", f"{solid.name}, {solid.source}"))
            rows.append(("density", f"{density:.4g} g/cm3"))
        names: tuple[str, ...] = (*MODULI, *RATIOS, "strength", "shear_strength", "conductivity")
        if not is_cubic(self.stiffness):
            # Means over the axes, and 2 C44 / (C11 - C12), say nothing of such a cell.
            rows += [(f"E along {axis}", self._along(axis, unit)) for axis in "xyz"]
            names = ("E110", "E111", "conductivity")
            if self.von_mises:
                rows += [(f"strength along {axis}", self._strength_along(axis)) for axis in "xyz"]
            else:  # the catalogue keeps the least of them
                is_none = self.values["strength"] <= _CARRIES
                text = _NOTHING if is_none else self._strength_text("strength")
                rows.append(("least strength along x, y, z", text))
        least = _CARRIES * float(np.abs(self.stiffness).max())
        for name in names:
            value, error = self.values[name], self.errors[name]
            text = _with_error(value, error)
            if name in MODULI:
                text = f"{text} {unit}" if value > least else _NOTHING
            elif "strength" in name:
                text = self._strength_text(name)
            elif name == "conductivity":
                text += " of the solid's"
            rows.append((CALLED.get(name, name.replace("_", " ")), text))
        return rows

    @property
    def _yields(self) -> bool:
        """Whether strengths are in MPa."""
        return self.material is not None and self.material.yield_stress is not None

    def _strength_text(self, name: str) -> str:
        unit = "MPa" if self._yields else "of the solid's yield stress"
        return f"{_with_error(self.values[name], self.errors[name])} {unit}"

    def _strength_along(self, axis: str) -> str:
        """The macroscopic stress along an axis at which the solid yields."""
        stress = self.von_mises[2 * axis]
        if not (np.isfinite(stress) and stress > 0.0):
            return _NOTHING
        limit = self.material.yield_stress if self.material is not None else None
        return f"{(limit or 1.0) / stress:.3g} " + (
            "MPa" if limit else "of the solid's yield stress"
        )

    def _along(self, axis: str, unit: str) -> str:
        """Young's modulus along an axis, and its error, which is that of the stiffness there."""
        row = "xyz".index(axis)
        modulus = self.young(np.eye(3)[row])
        if modulus <= _CARRIES * float(np.abs(self.stiffness).max()):
            return _NOTHING
        error = modulus * float(self.errors["stiffness"][row][row] / self.stiffness[row, row])
        return f"{_with_error(modulus, error)} {unit}"


def is_cubic(stiffness: Floats) -> bool:
    """Whether a (6, 6) stiffness is alike along x, y and z."""
    mean = stiffness.copy()
    for block in (slice(0, 3), slice(3, 6)):
        mean[block, block] = np.eye(3) * np.trace(stiffness[block, block]) / 3.0
    off = ~np.eye(3, dtype=bool)
    mean[:3, :3][off] = stiffness[:3, :3][off].mean()
    mean[:3, 3:] = mean[3:, :3] = 0.0
    return bool(np.abs(stiffness - mean).max() < _CUBIC * np.abs(stiffness).max())


def _with_error(value: float, error: float) -> str:
    """Both to the place of the error's first figure.

    >>> _with_error(10253.2, 118.0), _with_error(0.0035123, 2.1e-5)
    ('10,253 +- 118', '0.00351 +- 0.00002')
    """
    places = max(0, -math.floor(math.log10(error))) if error > 0.0 else 6
    if places > 9:
        return f"{value:.4g} +- {error:.1g}"
    return f"{value:,.{places}f} +- {error:,.{places}f}"


def cell_properties(
    cell: str | UnitCell,
    cell_size: float,
    strut_radius: float | None = None,
    *,
    relative_density: float | None = None,
    fillet: float = 0.0,
    material: str | SolidMaterial | None = None,
    along: int | None = None,
    on_estimate: Callable[[float], None] = lambda seconds: None,
) -> CellProperties:
    """What the endless lattice of a cell of struts does.

    Args:
        cell: a library cell's name, the path of a cell's file, or the cell.
        cell_size: L, mm.
        strut_radius: r, mm; or give `relative_density`.
        relative_density: in place of the radius, which is then found.
        fillet: radius of the round between struts, mm.
        material: the solid, by name, file or itself; None: figures in units of the solid's.
        along: voxels along L of the finest of three grids; None for what the radius asks for.
        on_estimate: given how many seconds are left, about, as soon as that is known.

    Raises:
        VolfrepError: a value makes no sense, the cell carries no load, or it has too many struts.

    >>> found = cell_properties("BCC", 10, 1, material="PA12", along=16)
    >>> round(found.relative_density, 3), found.stiffness.shape
    (0.243, (6, 6))
    >>> 70 < found.values["E100"] < 100  # MPa, on grids as coarse as these
    True
    """
    unit_cell = find_cell(cell) if isinstance(cell, str) else cell
    if (strut_radius is None) == (relative_density is None):
        raise VolfrepError("Give either a strut radius or a relative density.")
    solid = find_material(material) if isinstance(material, str) else material
    size = Grid(cell_size).size
    _refuse_crowded(unit_cell, None if strut_radius is None else strut_radius / size)
    if strut_radius is None:
        _check(size, size * 1e-3, fillet)
        assert relative_density is not None
        strut_radius = size * radius_of_density(unit_cell, float(relative_density), fillet / size)
    _check(size, strut_radius, fillet)
    return _summary(unit_cell, size, float(strut_radius), float(fillet), solid, along, on_estimate)


def _check(size: float, radius: float, fillet: float) -> None:
    """Refuse what no lattice can be made of; the number of facets does not matter here."""
    Struts(radius, fillet).refuse_too_thick(size)


def _refuse_crowded(cell: UnitCell, ratio: float | None) -> None:
    """Refuse a cell of very many struts, or that cross very often with that r / L, if it is known.

    Raises:
        VolfrepError: it is one.
    """
    struts, why = len(cell.struts), f"more than {MOST_STRUTS:,}"
    if struts <= MOST_STRUTS:
        crossing = 0 if ratio is None else crossing_struts(cell, ratio)
        if crossing <= MOST_CROSSING:
            return
        why = f"which run into each other beside their nodes at {crossing:,} places"
    raise VolfrepError(
        f"The cell '{cell.name}' has {struts:,} struts, {why}: its properties are not computed. "
        "Leave struts out, or put nodes where they cross."
    )


def _summary(
    cell: UnitCell,
    size: float,
    radius: float,
    fillet: float,
    solid: SolidMaterial | None,
    along: int | None,
    on_estimate: Callable[[float], None],
) -> CellProperties:
    poisson = POISSON if solid is None else solid.poisson
    density = relative_density(cell, radius / size, fillet / size)
    found = homogenise(
        cell,
        radius / size,
        fillet / size,
        poisson=poisson,
        along=along,
        density=density.value,
        on_estimate=on_estimate,
    )
    whole = figures_of(found, solid)
    whole.errors["relative_density"] = density.error
    return CellProperties(
        cell.name, size, radius, fillet, density.value, solid, whole.stiffness, whole.values,
        whole.errors, whole.von_mises, found.along[-1],
    )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Figures:
    """What follows from the homogenised solid, as `CellProperties` has it."""

    stiffness: Floats
    values: dict[str, float]
    errors: dict[str, Any]
    von_mises: dict[str, float]


def figures_of(found: Homogenised, solid: SolidMaterial | None) -> Figures:
    """What a homogenised solid does, of a material or of one with E = 1 and yield stress 1."""
    poisson = POISSON if solid is None else solid.poisson
    young = 1.0 if solid is None else solid.young
    limit = 1.0 if solid is None or solid.yield_stress is None else solid.yield_stress
    names = (*MODULI, *RATIOS)

    def figures(tensor: Floats) -> Floats:
        figure = moduli(tensor)
        return np.array([getattr(figure, name) for name in names])

    scale = np.where([name in MODULI for name in names], young, 1.0)
    values = dict(zip(names, (scale * figures(found.tensor)).tolist(), strict=True))
    errors: dict[str, Any] = dict(
        zip(names, (scale * found.error_of(figures)).tolist(), strict=True)
    )
    for name, (value, error) in _limits(found, poisson).items():
        values[name], errors[name] = limit * value, limit * error
    values["conductivity"], errors["conductivity"] = _mean_conductivity(found)
    errors["stiffness"] = young * found.error_of(lambda tensor: tensor)
    stressed = stresses(found.finest, poisson)
    von_mises = dict(zip(stressed.names, stressed.largest.tolist(), strict=True))
    return Figures(young * found.tensor, values, errors, von_mises)


def _limits(found: Homogenised, poisson: float) -> dict[str, tuple[float, float]]:
    """Strength and shear strength, over the solid's yield stress, and their errors."""
    fine, coarse = (stresses(grid, poisson) for grid in (found.finest, found.coarser))
    is_axial = [name in STRESSES[:3] for name in fine.names]
    result = {}
    for name, which in (("strength", np.array(is_axial)), ("shear_strength", ~np.array(is_axial))):
        best, before = (1.0 / part.largest[which].max() for part in (fine, coarse))
        result[name] = (float(best), float(abs(best - before) + 5e-3 * best))
    return result


def _mean_conductivity(found: Homogenised) -> tuple[float, float]:
    """The mean conductivity over the solid's and its error."""
    fine, coarse = (np.trace(conductance(grid)) / 3.0 for grid in (found.finest, found.coarser))
    (coarser, finer) = found.along[1:]
    # Two grids tell the first-order limit.
    best = fine - (coarse - fine) / (finer / coarser - 1.0) / 2.0
    return float(best), float(abs(fine - coarse) / 2.0 + 1e-3 * best)
